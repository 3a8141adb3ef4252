//! Origins: where every member was written.

use base::{Id, IdVec, Place};
use kernel::OriginId;

/// The table of places.
///
/// What the document itself says of its parts is numbered apart, from the last number down: where such a
/// rule comes or goes, all other origins are as they were, and so are the classes that hold them.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    places: IdVec<OriginId, Place>,
    rules: Vec<Place>,
}

impl Origins {
    /// Makes room for so many places.
    pub(crate) fn reserve(&mut self, more: usize) {
        self.places.reserve(more);
    }
    pub(crate) fn add(&mut self, place: Place) -> OriginId {
        self.places.push(place)
    }
    /// Adds the place of what the document itself says of its parts.
    pub(crate) fn add_rule(&mut self, place: Place) -> OriginId {
        self.rules.push(place);
        OriginId(u32::MAX - self.rules.len() as u32)
    }
    /// Returns where a member was written.
    pub fn place(&self, origin: OriginId) -> Place {
        match self.places.get(origin) {
            Some(place) => *place,
            None => self.rules[(u32::MAX - 1) as usize - origin.index()],
        }
    }
    /// Says of a member that it is written elsewhere.
    pub(crate) fn put(&mut self, origin: OriginId, place: Place) {
        if origin.index() < self.places.len() {
            self.places[origin] = place;
        }
    }
    /// Goes through all places.
    pub(crate) fn each(&mut self, each: impl FnMut(&mut Place)) {
        self.places.iter_mut().map(|(_, place)| place).chain(&mut self.rules).for_each(each);
    }
}
