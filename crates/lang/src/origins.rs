//! Origins: where every member was written.

use base::{IdVec, Place};
use kernel::OriginId;

/// The table of places.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    places: IdVec<OriginId, Place>,
}

impl Origins {
    pub(crate) fn add(&mut self, place: Place) -> OriginId {
        self.places.push(place)
    }
    /// Returns where a member was written.
    pub fn place(&self, origin: OriginId) -> Place {
        self.places[origin]
    }
}
