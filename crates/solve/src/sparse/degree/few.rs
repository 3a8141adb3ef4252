//! Minimum degree of a few places: the graph as bits, and degrees as they are.

use super::Elimination;
use crate::lists::Lists;

/// So many places are few.
pub(super) const MOST: usize = u128::BITS as usize;

/// Orders up to [`MOST`] places of which these are joined; of places of one degree the first comes first.
pub(super) fn eliminate(n: usize, joined: impl Iterator<Item = (u32, u32)>) -> Elimination {
    let mut near = [0u128; MOST];
    for (i, j) in joined.filter(|e| e.0 != e.1) {
        near[i as usize] |= 1 << j;
        near[j as usize] |= 1 << i;
    }
    let mut degree = [u32::MAX; MOST];
    for (degree, near) in degree.iter_mut().zip(&near).take(n) {
        *degree = near.count_ones();
    }
    let mut order = Vec::with_capacity(n);
    let mut place = [0u32; MOST];
    let mut entries = 0;
    while order.len() < n {
        let least = (1..n).fold(0, |least, i| if degree[i] < degree[least] { i } else { least });
        entries += degree[least] as usize;
        degree[least] = u32::MAX;
        place[least] = order.len() as u32;
        order.push(least as u32);
        // what is joined to it is joined to one another from now on
        let clique = near[least];
        for i in members(clique) {
            near[i] = (near[i] | clique) & !(1 << i) & !(1 << least);
            degree[i] = near[i].count_ones();
        }
    }
    let mut columns = Lists::with_room(n, entries);
    for &i in &order {
        columns.push_sorted(members(near[i as usize]).map(|j| place[j]));
    }
    Elimination { order, columns }
}

/// Returns the places of the bits that are set.
fn members(mut bits: u128) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let next = (bits != 0).then(|| bits.trailing_zeros() as usize)?;
        bits &= bits - 1;
        Some(next)
    })
}
