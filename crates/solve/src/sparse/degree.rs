//! Minimum degree: an order of elimination that makes few new entries in a symmetric pattern.
//!
//! In: which places are joined. Out: an order, and what the factors look like in it. What was eliminated is
//! kept as *elements*, cliques that stand for the entries that they made; degrees are bounds from
//! above; places joined to the same are one from then on, and go together. A few places are ordered by
//! degrees as they are.
//!
//! **Source:** Amestoy, Davis and Duff, *An approximate minimum degree ordering algorithm*, SIAM J. Matrix
//! Anal. Appl. 17 (1996).

mod few;

use super::pivot::Counts;
use crate::lists::Lists;

/// An order of elimination and what is left of each column when its turn comes.
#[derive(Debug)]
pub(crate) struct Elimination {
    /// The places, in order.
    pub(crate) order: Vec<u32>,
    /// For each in that order, where it stands in the order that is joined to it by then, increasing.
    pub(crate) columns: Lists,
}

/// Orders `n` places of which these are joined; a pair may come twice, either way round.
pub(crate) fn eliminate(n: usize, joined: impl Iterator<Item = (u32, u32)> + Clone) -> Elimination {
    if n <= few::MOST {
        return few::eliminate(n, joined);
    }
    by_degree(&near(n, joined))
}

/// Returns what every place is joined to, some more than once.
fn near(n: usize, joined: impl Iterator<Item = (u32, u32)> + Clone) -> Lists {
    Lists::new(n, joined.filter(|e| e.0 != e.1).flat_map(|(i, j)| [(i, j), (j, i)]))
}

fn by_degree(near: &Lists) -> Elimination {
    let n = near.len();
    let distinct = |i: u32| {
        let mut own = near.of(i).to_vec();
        own.sort_unstable();
        own.dedup();
        own
    };
    let order = order((0..n as u32).map(distinct).collect());
    let columns = columns(&order, near);
    Elimination { order, columns }
}

/// The state of the graph while it is eliminated.
struct Graph {
    /// How many places stand together under this one; none where it stands under another or is gone.
    weight: Vec<u32>,
    /// The places that stand under this one.
    under: Vec<Vec<u32>>,
    /// The places that it is joined to by entries.
    near: Vec<Vec<u32>>,
    /// How many places it is joined to by entries, each with its weight.
    entries: Vec<u32>,
    /// The elements that it belongs to.
    elements: Vec<Vec<u32>>,
    /// The places of an element, by that which was eliminated; those that are gone too.
    members: Vec<Vec<u32>>,
    /// How many places an element has, each with its weight; none where it was absorbed.
    size: Vec<u32>,
    degrees: Counts,
}

fn order(near: Vec<Vec<u32>>) -> Vec<u32> {
    let n = near.len();
    let mut graph = Graph {
        weight: vec![1; n],
        under: vec![Vec::new(); n],
        entries: near.iter().map(|own| own.len() as u32).collect(),
        elements: vec![Vec::new(); n],
        members: vec![Vec::new(); n],
        size: vec![0; n],
        degrees: Counts::new(near.iter().map(|own| own.len() as u32).collect(), n),
        near,
    };
    let mut order = Vec::with_capacity(n);
    let mut mark = vec![u32::MAX; n];
    let mut outside = vec![(u32::MAX, 0u32); n];
    let mut least = 0;
    while order.len() < n {
        let found = (least..n).find_map(|d| graph.degrees.of(d).next().map(|p| (d, p)));
        let (degree, p) = found.expect("as many are left as have not been taken");
        least = degree;
        graph.take(p, n - order.len(), &mut mark, &mut outside, &mut least);
        let mut stack = vec![p];
        while let Some(i) = stack.pop() {
            order.push(i);
            stack.extend(std::mem::take(&mut graph.under[i as usize]));
        }
    }
    order
}

impl Graph {
    /// Eliminates a place, of so many that are left, with all that stands under it.
    fn take(
        &mut self,
        p: u32,
        left: usize,
        mark: &mut [u32],
        outside: &mut [(u32, u32)],
        least: &mut usize,
    ) {
        let own = p as usize;
        self.degrees.unlink(p);
        mark[own] = p;
        let mut element: Vec<u32> = Vec::new();
        let mut size = 0;
        let near = std::mem::take(&mut self.near[own]);
        let absorbed = std::mem::take(&mut self.elements[own]);
        let through = absorbed.iter().flat_map(|&e| self.members[e as usize].iter().copied());
        for i in near.iter().copied().chain(through) {
            if self.weight[i as usize] > 0 && mark[i as usize] != p {
                mark[i as usize] = p;
                element.push(i);
                size += self.weight[i as usize];
            }
        }
        for &e in &absorbed {
            self.members[e as usize] = Vec::new();
            self.size[e as usize] = 0;
        }
        if let [i] = element[..]
            && near.contains(&i)
        {
            self.entries[i as usize] -= self.weight[own];
        }
        // how much of every other element lies outside this one
        for &i in &element {
            for &e in &self.elements[i as usize] {
                let e = e as usize;
                if outside[e].0 != p {
                    outside[e] = (p, self.size[e]);
                }
                outside[e].1 -= self.weight[i as usize].min(outside[e].1);
            }
        }
        let mut alike: Vec<(u64, u32)> = Vec::with_capacity(element.len());
        for &i in &element {
            let at = i as usize;
            let mut degree = 0;
            let mut sum = 0u64;
            self.elements[at].retain(|&e| {
                let beyond = outside[e as usize].1;
                let stays = self.size[e as usize] > 0 && beyond > 0;
                if stays {
                    degree += beyond;
                    sum += u64::from(e);
                }
                stays
            });
            // an element of one place has no entries within: the hub of a star would read all its rays for each of them
            if element.len() > 1 {
                let (weight, entries) = (&self.weight, &mut self.entries[at]);
                *entries = 0;
                self.near[at].retain(|&j| {
                    let stays = weight[j as usize] > 0 && mark[j as usize] != p;
                    if stays {
                        *entries += weight[j as usize];
                        sum += u64::from(j);
                    }
                    stays
                });
            }
            degree += self.entries[at];
            if degree == 0 {
                // nothing else is joined to it: it goes together with `p`
                size -= self.weight[at];
                self.weight[at] = 0;
                self.degrees.unlink(i);
                self.under[own].push(i);
                continue;
            }
            self.elements[at].push(p);
            let others = size - self.weight[at].min(size);
            let bound = (self.degrees.count(i) + others).min(degree + others);
            self.degrees.set(i, bound.min(left as u32 - 1) as usize);
            alike.push((sum, i));
        }
        self.weight[own] = 0;
        alike.sort_unstable();
        for group in alike.chunk_by(|a, b| a.0 == b.0) {
            self.join_alike(group);
        }
        element.retain(|&i| self.weight[i as usize] > 0);
        for &i in &element {
            *least = (*least).min(self.degrees.count(i) as usize);
        }
        self.size[own] = size;
        self.members[own] = element;
    }

    /// Makes one of places that are joined to the same.
    fn join_alike(&mut self, group: &[(u64, u32)]) {
        for (k, &(_, i)) in group.iter().enumerate() {
            if self.weight[i as usize] == 0 {
                continue;
            }
            for &(_, j) in &group[k + 1..] {
                let (a, b) = (i as usize, j as usize);
                let same = self.weight[b] > 0
                    && self.near[a].len() == self.near[b].len()
                    && self.elements[a].len() == self.elements[b].len()
                    && same_members(&self.near[a], &self.near[b])
                    && same_members(&self.elements[a], &self.elements[b]);
                if same {
                    self.degrees.unlink(j);
                    let weight = std::mem::take(&mut self.weight[b]);
                    self.weight[a] += weight;
                    self.under[a].push(j);
                    let degree = self.degrees.count(i).saturating_sub(weight);
                    self.degrees.set(i, degree as usize);
                    self.near[b] = Vec::new();
                    self.elements[b] = Vec::new();
                }
            }
        }
    }
}

/// Returns true if two lists without repetition have the same members; they are short.
fn same_members(a: &[u32], b: &[u32]) -> bool {
    a == b || a.iter().all(|i| b.contains(i))
}

/// What is left of each column when its turn comes: its own entries, and those of columns that it is the
/// first entry of.
fn columns(order: &[u32], near: &Lists) -> Lists {
    const NONE: u32 = u32::MAX;
    let n = order.len();
    let mut place = vec![0u32; n];
    for (k, &i) in order.iter().enumerate() {
        place[i as usize] = k as u32;
    }
    let mut mark = vec![NONE; n];
    // the latest column of which each is the first entry, and for every column the one before it
    let (mut latest, mut before) = (vec![NONE; n], vec![NONE; n]);
    let mut columns = Lists::default();
    let mut own: Vec<u32> = Vec::new();
    for (k, &i) in (0..).zip(order) {
        mark[k as usize] = k;
        own.clear();
        let mut add = |j: u32| {
            if j > k && mark[j as usize] != k {
                mark[j as usize] = k;
                own.push(j);
            }
        };
        near.of(i).iter().for_each(|&j| add(place[j as usize]));
        let mut earlier = latest[k as usize];
        while earlier != NONE {
            columns.of(earlier).iter().for_each(|&j| add(j));
            earlier = before[earlier as usize];
        }
        own.sort_unstable();
        if let Some(&first) = own.first() {
            before[k as usize] = std::mem::replace(&mut latest[first as usize], k);
        }
        columns.push(&own);
    }
    columns
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(side: u32) -> Vec<(u32, u32)> {
        let mut joined = Vec::new();
        for i in 0..side * side {
            if i % side + 1 < side {
                joined.push((i, i + 1));
            }
            if i + side < side * side {
                joined.push((i + side, i));
            }
        }
        joined
    }
    fn entries(e: &Elimination) -> usize {
        e.columns.all().len()
    }

    #[test]
    fn nothing_and_places_joined_to_nothing_have_an_order() {
        assert_eq!(eliminate(0, [].into_iter()).order, [0u32; 0]);
        let mut order = eliminate(3, [(1, 1)].into_iter()).order;
        order.sort_unstable();
        assert_eq!(order, [0, 1, 2]);
    }

    #[test]
    fn a_tree_makes_no_new_entries() {
        for n in [200, 400] {
            let joined: Vec<(u32, u32)> = (1..n).map(|i| (i, (i * 7 + 3) % i)).collect();
            let tree = eliminate(n as usize, joined.iter().copied());
            assert_eq!(entries(&tree), joined.len());
        }
    }

    /// A sum of many: whoever reads all its rays for each of them takes minutes here.
    #[test]
    fn a_large_star_is_ordered_at_once() {
        let n = 400_000;
        let star = eliminate(n, (1..n as u32).map(|i| (0, i)));
        assert_eq!(entries(&star), n - 1);
    }

    /// Every place once, and every column what elimination by hand leaves of it: of few and of many.
    #[test]
    fn columns_are_those_of_elimination() {
        are_those_of_elimination(9);
        are_those_of_elimination(15);
        are_those_of_elimination(17);
    }
    fn are_those_of_elimination(side: u32) {
        let n = (side * side) as usize;
        assert_eq!(n > few::MOST, side == 17);
        let joined = grid(side);
        let found = eliminate(n, joined.iter().copied());
        let mut seen = found.order.clone();
        seen.sort_unstable();
        assert_eq!(seen, (0..n as u32).collect::<Vec<u32>>());
        let mut matrix = vec![vec![false; n]; n];
        let place = |i: u32| found.order.iter().position(|&o| o == i).expect("each has a place");
        for &(i, j) in &joined {
            matrix[place(i)][place(j)] = true;
            matrix[place(j)][place(i)] = true;
        }
        for k in 0..n {
            let own: Vec<u32> = (k + 1..n).filter(|&j| matrix[k][j]).map(|j| j as u32).collect();
            assert_eq!(found.columns.of(k as u32), own);
            for &i in &own {
                for &j in &own {
                    matrix[i as usize][j as usize] |= i != j;
                }
            }
        }
    }

    /// 31 n log2(n) / 4 entries is what nested dissection promises; minimum degree is not far from that.
    #[test]
    fn a_grid_makes_few_new_entries() {
        let found = eliminate(10_000, grid(100).into_iter());
        assert!(entries(&found) < 300_000, "{}", entries(&found));
    }
}
