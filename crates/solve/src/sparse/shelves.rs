//! Shelves: lists that grow and shrink, all in one piece of memory.
//!
//! A list that has no room left moves to the end, with as much room again; what it leaves stays empty.

/// A list for every one of several numbers.
#[derive(Clone, Debug)]
pub(super) struct Shelves<T> {
    places: Vec<Place>,
    items: Vec<T>,
}

/// Where a list stands, and how long it may become there.
#[derive(Clone, Copy, Debug)]
struct Place {
    start: u32,
    len: u32,
    room: u32,
}

impl<T: Copy> Shelves<T> {
    /// Begins with lists of these lengths, whose items come one list after the other.
    pub(super) fn new(lengths: impl Iterator<Item = u32>, items: Vec<T>) -> Self {
        let mut start = 0;
        let place = |len| {
            let own = Place { start, len, room: len };
            start += len;
            own
        };
        let places = lengths.map(place).collect();
        debug_assert_eq!(start as usize, items.len(), "every item is in a list");
        Self { places, items }
    }
    /// Returns how many lists there are.
    pub(super) fn len(&self) -> usize {
        self.places.len()
    }
    /// Returns a list.
    pub(super) fn of(&self, of: u32) -> &[T] {
        let Place { start, len, .. } = self.places[of as usize];
        &self.items[start as usize..][..len as usize]
    }
    /// Returns a list, to change its items.
    pub(super) fn of_mut(&mut self, of: u32) -> &mut [T] {
        let Place { start, len, .. } = self.places[of as usize];
        &mut self.items[start as usize..][..len as usize]
    }
    /// Adds an item to a list, at its end.
    pub(super) fn add(&mut self, to: u32, item: T) {
        let place = &mut self.places[to as usize];
        if place.len == place.room {
            let own = place.start as usize..(place.start + place.len) as usize;
            place.start = self.items.len() as u32;
            place.room = 2 * place.len + 2;
            self.items.extend_from_within(own);
            self.items.resize((place.start + place.room) as usize, item);
        }
        self.items[(place.start + place.len) as usize] = item;
        place.len += 1;
    }
    /// Takes an item out of a list; the last takes its place.
    pub(super) fn take_out(&mut self, of: u32, at: usize) {
        let own = self.of_mut(of);
        own.swap(at, own.len() - 1);
        self.places[of as usize].len -= 1;
    }
    /// Empties a list.
    pub(super) fn clear(&mut self, of: u32) {
        self.places[of as usize].len = 0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_grow_and_shrink_beside_each_other() {
        let mut shelves = Shelves::new([2, 0, 1].into_iter(), vec![1, 2, 3]);
        (4..9).for_each(|i| shelves.add(0, i));
        shelves.add(1, 9);
        shelves.take_out(0, 1);
        assert_eq!(
            [shelves.of(0), shelves.of(1), shelves.of(2)],
            [&[1, 8, 4, 5, 6, 7][..], &[9], &[3]]
        );
        shelves.clear(2);
        shelves.add(2, 10);
        shelves.of_mut(2)[0] += 1;
        assert_eq!((shelves.len(), shelves.of(2)), (3, &[11][..]));
    }
}
