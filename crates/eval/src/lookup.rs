//! Looking up: what a name means for things of a class, found once for each.

use crate::answer::Answer;
use crate::evaluator::{Evaluator, Result};
use crate::fault::{Fault, FaultKind};
use crate::replay::Routines;
use base::{IdVec, Name};
use geometry::Made;
use kernel::{ClassId, ClassKind, ConstraintInstance, Document, Layout, Message, ThingId};
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::rc::Rc;

/// The class that answers a message, and the message's index there.
type Found = Option<(ClassId, usize)>;

/// Among so many messages one is looked for one by one.
const FEW: usize = 16;

/// What has been looked up so far.
#[derive(Debug)]
pub(crate) struct Tables {
    layouts: RefCell<IdVec<ClassId, Option<Rc<Layout>>>>,
    messages: RefCell<IdVec<ClassId, BTreeMap<Name, Found>>>,
    /// By name, the messages that classes with many of them define.
    own: RefCell<BTreeMap<ClassId, BTreeMap<Name, usize>>>,
    figures: RefCell<IdVec<ClassId, Option<Option<Made>>>>,
    constraints: RefCell<BTreeMap<(ThingId, Name), Option<ConstraintInstance>>>,
    all: RefCell<BTreeMap<ClassId, Rc<[ThingId]>>>,
    /// What is known of runs of programs; nothing where the interpreter alone shall say what they draw.
    pub(crate) routines: Option<Routines>,
    /// Names that the evaluator itself asks for.
    pub(crate) x: Name,
    pub(crate) y: Name,
    pub(crate) picture: Name,
    pub(crate) p1: Name,
    pub(crate) p2: Name,
    pub(crate) center: Name,
    pub(crate) radius: Name,
    pub(crate) bulge: Name,
}

/// What was looked up of a document and its things: evaluators of their states share it.
#[derive(Clone, Debug, Default)]
pub struct Known(OnceCell<Rc<Tables>>);

impl Known {
    /// Returns how many runs of programs were asked for again, and how many of these went by what was noted.
    pub fn replays(&self) -> (u32, u32) {
        let routines = self.0.get().and_then(|tables| tables.routines.as_ref());
        routines.map_or((0, 0), Routines::replays)
    }
    pub(crate) fn tables(&self, document: &Document) -> Rc<Tables> {
        let tables = || Tables { routines: Some(Routines::default()), ..Tables::new(document) };
        self.0.get_or_init(|| Rc::new(tables())).clone()
    }
}

impl Tables {
    pub(crate) fn new(document: &Document) -> Self {
        let n = document.classes.len();
        Self {
            layouts: RefCell::new(IdVec::filled(None, n)),
            messages: RefCell::new(IdVec::filled(BTreeMap::new(), n)),
            own: RefCell::new(BTreeMap::new()),
            figures: RefCell::new(IdVec::filled(None, n)),
            constraints: RefCell::new(BTreeMap::new()),
            all: RefCell::new(BTreeMap::new()),
            routines: None,
            x: Name::new("x"),
            y: Name::new("y"),
            picture: Name::new("picture"),
            p1: Name::new("p1"),
            p2: Name::new("p2"),
            center: Name::new("center"),
            radius: Name::new("radius"),
            bulge: Name::new("bulge"),
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

    /// Returns what things of a class are to a construction, found once.
    pub(crate) fn figure_of_class(&self, class: ClassId) -> Option<Made> {
        if let Some(known) = self.tables.figures.borrow()[class] {
            return known;
        }
        let found = self.document.figure(class);
        self.tables.figures.borrow_mut()[class] = Some(found);
        found
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
        let own = |c: ClassId| self.own_index(c, name).map(|i| message((c, i)));
        let found = document.find_message_by(class, None, &own);
        let found = found.and_then(|(c, message)| Some((c, self.own_index(c, &message.name)?)));
        self.tables.messages.borrow_mut()[class].insert(name.clone(), found);
        found.map(message)
    }

    /// Returns the index of the message that a class itself defines by a name: of several the last.
    fn own_index(&self, class: ClassId, name: &Name) -> Option<usize> {
        let messages = &self.document.classes[class].messages;
        if messages.len() <= FEW {
            return messages.iter().rposition(|m| m.name == *name);
        }
        let mut own = self.tables.own.borrow_mut();
        let by_name = own.entry(class).or_insert_with(|| {
            messages.iter().enumerate().map(|(i, m)| (m.name.clone(), i)).collect()
        });
        by_name.get(name).copied()
    }

    /// Returns the things of a class in order of declaration, merged ones once.
    pub(crate) fn all(&self, class: ClassId) -> Result<Rc<[Answer<'a>]>> {
        let known = self.tables.all.borrow().get(&class).cloned();
        let things = known.unwrap_or_else(|| {
            let all: Rc<[ThingId]> = self.structure.all(self.document, class).into();
            self.tables.all.borrow_mut().insert(class, all.clone());
            all
        });
        things.iter().map(|&t| self.part(t)).collect()
    }

    /// Returns the constraint of a thing that has this name, looked for once.
    pub(crate) fn constraint_named(
        &self,
        thing: ThingId,
        name: &Name,
    ) -> Option<ConstraintInstance> {
        let key = (thing, name.clone());
        if let Some(&known) = self.tables.constraints.borrow().get(&key) {
            return known;
        }
        let found = self.structure.constraint_named(self.document, thing, name);
        self.tables.constraints.borrow_mut().insert(key, found);
        found
    }

    /// Says that a reference names nothing.
    pub(crate) fn names_nothing(&self, reference: ThingId) -> Fault {
        let path = self.structure.path(self.document, reference);
        Fault::new(FaultKind::Reference, format!("`{path}` names nothing"))
    }
}
