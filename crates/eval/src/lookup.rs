//! Looking up: what a name means for things of a class, found once for each.

use crate::answer::{Answer, Frame};
use crate::evaluator::{Evaluator, Result};
use crate::fault::Fault;
use base::{IdVec, Name};
use kernel::{ClassId, ClassKind, Document, Layout, Message, ThingId};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

/// The class that answers a message, and the message's index there.
type Found = Option<(ClassId, usize)>;

/// What has been looked up so far.
#[derive(Debug)]
pub(crate) struct Tables {
    layouts: RefCell<IdVec<ClassId, Option<Rc<Layout>>>>,
    messages: RefCell<IdVec<ClassId, BTreeMap<Name, Found>>>,
    order: RefCell<Option<Rc<[ThingId]>>>,
    /// Names that the evaluator itself asks for.
    pub(crate) x: Name,
    pub(crate) y: Name,
    pub(crate) picture: Name,
}

impl Tables {
    pub(crate) fn new(document: &Document) -> Self {
        let n = document.classes.len();
        Self {
            layouts: RefCell::new(IdVec::filled(None, n)),
            messages: RefCell::new(IdVec::filled(BTreeMap::new(), n)),
            order: RefCell::new(None),
            x: Name::new("x"),
            y: Name::new("y"),
            picture: Name::new("picture"),
        }
    }
}

impl<'a> Evaluator<'a> {
    pub(crate) fn class_kind(&self, thing: ThingId) -> &'a ClassKind {
        &self.document.classes[self.structure.things[thing].class].kind
    }

    /// Returns the layout of a class, made once.
    pub(crate) fn layout(&self, class: ClassId) -> Rc<Layout> {
        if let Some(layout) = &self.tables.layouts.borrow()[class] {
            return layout.clone();
        }
        let known = self.structure.layout(class).cloned();
        let layout = known.unwrap_or_else(|| Rc::new(Layout::new(self.document, class)));
        self.tables.layouts.borrow_mut()[class] = Some(layout.clone());
        layout
    }

    /// Returns the part of a thing that a bare name means.
    pub(crate) fn part_named(&self, thing: ThingId, name: &Name) -> Option<ThingId> {
        let s = self.structure;
        let own = |thing: ThingId| {
            let t = &s.things[thing];
            let layout = self.layout(t.class);
            match layout.index.get(name) {
                Some(&i) => Some(ThingId(t.first_part.0 + i)),
                None if layout.own_names.is_empty() && layout.superclasses.is_empty() => None,
                None => s.part_named(thing, name),
            }
        };
        own(thing).or_else(|| s.unlike(thing).iter().find_map(|&t| own(t)))
    }

    /// Finds a class's message by the thesis's order, once for every class and name.
    pub(crate) fn class_message(&self, class: ClassId, name: &Name) -> Option<&'a Message> {
        let document = self.document;
        let message = |(c, i): (ClassId, usize)| &document.classes[c].messages[i];
        if let Some(found) = self.tables.messages.borrow()[class].get(name) {
            return found.map(message);
        }
        let found = document.find_message(class, name, None).and_then(|(c, found)| {
            let i = document.classes[c].messages.iter().position(|m| std::ptr::eq(m, found))?;
            Some((c, i))
        });
        self.tables.messages.borrow_mut()[class].insert(name.clone(), found);
        found.map(message)
    }

    /// Returns the things of a class in order of declaration, merged ones once.
    pub(crate) fn all(&self, class: ClassId) -> Rc<[Answer<'a>]> {
        let is: BTreeMap<ClassId, bool> =
            self.structure.classes().map(|c| (c, self.document.is_a(c, class))).collect();
        let of_class = |t: &ThingId| {
            let c = self.structure.things[*t].class;
            self.structure.merged[*t] == *t
                && is.get(&c).copied().unwrap_or_else(|| self.document.is_a(c, class))
        };
        let things = self.in_order();
        things.iter().filter(|t| of_class(t)).filter_map(|&t| self.part(t).ok()).collect()
    }

    /// Returns every thing in order of declaration.
    pub(crate) fn in_order(&self) -> Rc<[ThingId]> {
        if let Some(order) = &*self.tables.order.borrow() {
            return order.clone();
        }
        let mut order = Vec::with_capacity(self.structure.things.len());
        let mut stack: Vec<ThingId> = self.structure.things.ids().take(1).collect();
        while let Some(thing) = stack.pop() {
            order.push(thing);
            stack.extend(self.structure.parts(thing).rev());
        }
        let order: Rc<[ThingId]> = order.into();
        *self.tables.order.borrow_mut() = Some(order.clone());
        order
    }

    /// Follows a reference to the thing that it names.
    pub(crate) fn referent(&self, reference: ThingId) -> Result<Answer<'a>> {
        let document = self.document;
        let t = &self.structure.things[reference];
        let name = self.structure.field_name(document, reference);
        let (Some(owner), Some(name)) = (t.owner, name) else {
            return Err(Fault::wrong("a reference that is no part of a class"));
        };
        let path = kernel::Path::of(&[name]);
        let line = document.primary_line(self.structure.things[owner].class);
        let given = line
            .into_iter()
            .find_map(|c| document.classes[c].givens.iter().rev().find(|g| g.path == path));
        let given = given.ok_or_else(|| Fault::no_answer(format!("`{name}` names nothing yet")))?;
        self.deeper(|| self.term(&given.value, &Frame::of(owner)))
            .map_err(|f| f.within(given.origin))
    }
}
