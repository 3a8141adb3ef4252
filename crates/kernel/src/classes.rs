//! The classes of a document: documents that differ in few of them share the others.

use crate::class::{Class, ClassId};
use base::IdVec;
use std::ops::{Index, IndexMut};
use std::rc::Rc;

/// Every class of a document, by its id.
///
/// A clone shares all of them: a class is copied when one of the two changes it.
///
/// ```
/// let classes = kernel::Classes::default();
/// assert_eq!(classes.len(), 0);
/// ```
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Classes(IdVec<ClassId, Rc<Class>>);

impl Classes {
    /// Makes a collection without a class.
    pub fn new() -> Self {
        Self::default()
    }
    /// Adds a class and returns its id.
    pub fn push(&mut self, class: Class) -> ClassId {
        self.0.push(Rc::new(class))
    }
    /// Returns how many classes there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }
    /// Returns true if there is no class.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
    /// Returns the id that the next class gets.
    pub fn next_id(&self) -> ClassId {
        self.0.next_id()
    }
    /// Returns the class of an id, if there is one.
    pub fn get(&self, id: ClassId) -> Option<&Class> {
        self.0.get(id).map(Rc::as_ref)
    }
    /// Returns every id, in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = ClassId> + ExactSizeIterator + use<> {
        self.0.ids()
    }
    /// Returns every class with its id, in order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (ClassId, &Class)> + ExactSizeIterator {
        self.0.iter().map(|(id, class)| (id, &**class))
    }
}

impl Index<ClassId> for Classes {
    type Output = Class;
    fn index(&self, id: ClassId) -> &Class {
        &self.0[id]
    }
}
impl IndexMut<ClassId> for Classes {
    fn index_mut(&mut self, id: ClassId) -> &mut Class {
        Rc::make_mut(&mut self.0[id])
    }
}
impl FromIterator<Class> for Classes {
    fn from_iter<A: IntoIterator<Item = Class>>(classes: A) -> Self {
        Self(classes.into_iter().map(Rc::new).collect())
    }
}
