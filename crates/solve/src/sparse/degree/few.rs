//! Minimum degree of a few places: the graph as bits, and degrees as they are.

use super::Elimination;
use crate::lists::Lists;

const WORDS: usize = 2;
/// So many places are few.
pub(super) const MOST: usize = WORDS * u128::BITS as usize;

/// A set of places.
#[derive(Clone, Copy)]
struct Set([u128; WORDS]);

impl Set {
    const EMPTY: Self = Self([0; WORDS]);

    fn insert(&mut self, place: usize) {
        self.0[place / u128::BITS as usize] |= 1 << (place % u128::BITS as usize);
    }
    fn remove(&mut self, place: usize) {
        self.0[place / u128::BITS as usize] &= !(1 << (place % u128::BITS as usize));
    }
    fn insert_all(&mut self, others: &Self) {
        self.0.iter_mut().zip(others.0).for_each(|(own, other)| *own |= other);
    }
    fn len(&self) -> u32 {
        self.0.iter().map(|word| word.count_ones()).sum()
    }
    /// Returns its places, in order.
    fn places(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().zip(0..).flat_map(|(mut word, at)| {
            std::iter::from_fn(move || {
                let next = (word != 0).then(|| word.trailing_zeros() as usize)?;
                word &= word - 1;
                Some(at * u128::BITS as usize + next)
            })
        })
    }
}

/// Orders up to [`MOST`] places of which these are joined; of places of one degree the first comes first.
pub(super) fn eliminate(n: usize, joined: impl Iterator<Item = (u32, u32)>) -> Elimination {
    const GONE: u32 = u32::MAX;
    let mut near = [Set::EMPTY; MOST];
    for (i, j) in joined.filter(|e| e.0 != e.1) {
        near[i as usize].insert(j as usize);
        near[j as usize].insert(i as usize);
    }
    let mut degree = [GONE; MOST];
    degree.iter_mut().zip(&near).take(n).for_each(|(degree, near)| *degree = near.len());
    let mut order = Vec::with_capacity(n);
    let mut place = [0u32; MOST];
    // no degree is less than this
    let mut least = 0;
    let mut entries = 0;
    while order.len() < n {
        let Some(next) = degree[..n].iter().position(|&d| d == least) else {
            least += 1;
            continue;
        };
        entries += least as usize;
        degree[next] = GONE;
        place[next] = order.len() as u32;
        order.push(next as u32);
        // what is joined to it is joined to one another from now on
        let clique = near[next];
        for i in clique.places() {
            near[i].insert_all(&clique);
            near[i].remove(i);
            near[i].remove(next);
            degree[i] = near[i].len();
            least = least.min(degree[i]);
        }
    }
    let mut columns = Lists::with_room(n, entries);
    for &i in &order {
        columns.push_sorted(near[i as usize].places().map(|j| place[j]));
    }
    Elimination { order, columns }
}
