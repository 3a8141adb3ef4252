//! Counting: of two values that one slot is given, which counts.
//!
//! In: things that are one, each with what it is given. Out: the value that is nearer to whoever wrote the document.
//! What a body connects takes the place of what classes give the part by themselves; then what stands further out
//! counts; of equals what is declared first.

use super::body::Body;
use crate::class::ClassId;
use crate::document::Document;
use crate::structure::{Form, GivenIn, Givens, ThingId};
use crate::term::OriginId;
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// A thing, and what it is given.
pub(super) type GivenTo = (ThingId, GivenIn);

/// The parts that the body of a thing connects, each with how far above the thing's class the nearest class is that
/// says so.
type Connected = Rc<BTreeMap<ThingId, usize>>;

/// What is asked of where values stand. What bodies connect and what classes give is found once, where it is asked for.
pub(super) struct Counting<'s, 'd> {
    document: &'d Document,
    body: &'s Body,
    givens: &'s Givens,
    /// Whether any body connects anything.
    connects: bool,
    connected: RefCell<BTreeMap<ThingId, Connected>>,
    given_by: RefCell<BTreeMap<ClassId, BTreeSet<OriginId>>>,
}

impl<'s, 'd> Counting<'s, 'd> {
    pub(super) fn new(document: &'d Document, body: &'s Body, givens: &'s Givens) -> Self {
        let connects = document.classes.iter().any(|(_, class)| !class.connections.is_empty());
        let (connected, given_by) = Default::default();
        Self { document, body, givens, connects, connected, given_by }
    }

    /// Returns true if the value of the thing that is declared first counts, not that of the other.
    ///
    /// `form` has the layouts. Cost: a look at what the classes of all that is around the two give; what they connect
    /// is found once.
    pub(super) fn is_first(&self, form: &Form, first: GivenTo, other: GivenTo) -> bool {
        let key =
            |(thing, given)| (self.is_replaced(form, thing, given), self.depth_of(form, given));
        key(first) <= key(other)
    }

    /// Tests whether a body connects the thing, or what it is in, in the place of what it is given.
    fn is_replaced(&self, form: &Form, thing: ThingId, given: GivenIn) -> bool {
        if !self.connects {
            return false;
        }
        let origin = self.givens[given.value].origin;
        self.around(given.me).any(|host| {
            let line = self.document.primary_line(self.body.things[host].class);
            if line.iter().all(|&class| self.document.classes[class].connections.is_empty()) {
                return false;
            }
            let connected = self.connected(form, host, &line);
            let nearest = self.around(thing).filter_map(|part| connected.get(&part)).min();
            // what the same body gives, or one nearer, is no default
            let gives = |&class: &ClassId| host == given.me && self.does_give(class, origin);
            nearest.is_some_and(|&at| !line.iter().take(at + 1).any(gives))
        })
    }

    /// Returns the parts that the body of a thing connects whose class has this line.
    fn connected(&self, form: &Form, host: ThingId, line: &[ClassId]) -> Connected {
        if let Some(known) = self.connected.borrow().get(&host) {
            return known.clone();
        }
        let paths = self.body.paths(&form.layouts);
        let mut found = BTreeMap::new();
        for (at, &class) in line.iter().enumerate() {
            for connection in &self.document.classes[class].connections {
                if let Ok(part) = paths.follow(host, &connection.path) {
                    found.entry(part).or_insert(at);
                }
            }
        }
        let found = Rc::new(found);
        self.connected.borrow_mut().insert(host, found.clone());
        found
    }

    /// Returns true if a class itself gives a value.
    fn does_give(&self, class: ClassId, origin: OriginId) -> bool {
        let mut given_by = self.given_by.borrow_mut();
        let givens = || self.document.classes[class].givens.iter().map(|given| given.origin);
        let given = given_by.entry(class).or_insert_with(|| givens().collect());
        given.contains(&origin)
    }

    /// Returns how deep in the document the text stands that gives a value: 0 for what the document itself says, in
    /// the bodies of its parts as well; for what a class says, how deep its thing lies.
    fn depth_of(&self, form: &Form, given: GivenIn) -> usize {
        let Self { document, body, givens, .. } = self;
        let origin = givens[given.value].origin;
        let says = |&class: &ClassId| self.does_give(class, origin);
        let mut thing = given.me;
        let line = document.primary_line(body.things[thing].class).into_iter();
        let mut said = line.filter(|&c| document.classes[c].is_of_one).find(says);
        // the body of a part stands in the text of the class that declares the part
        while let Some(class) = said.filter(|&c| document.classes[c].general.is_none()) {
            let Some(owner) = body.things[thing].owner else { break };
            let field = form.layouts[body.things[owner].class]
                .as_ref()
                .and_then(|layout| layout.fields.get(body.things[thing].field as usize));
            let declares = match field {
                Some(field) => field.class,
                // the element of a list is declared with it
                None => class,
            };
            thing = owner;
            said = document.classes[declares].is_of_one.then_some(declares);
        }
        self.around(thing).skip(1).count()
    }

    /// Returns a thing and all that it is in.
    fn around(&self, thing: ThingId) -> impl Iterator<Item = ThingId> {
        std::iter::successors(Some(thing), |&t| self.body.things[t].owner)
    }
}
