//! Pivots: an order of elimination that makes few new entries and keeps the numbers tame.
//!
//! In: a square pattern and numbers to judge by. Out: rows and columns in the order of elimination, and
//! what the factors will look like. Of the entries that are not much smaller than the largest in
//! their row, the one whose row and column have the fewest others is next; a few rows are looked
//! at. What is left when it has become dense is one dense tail. Of a large matrix only the cheap pivots
//! are found so: what remains then (the nodes of a net, its branches gone) is ordered as a whole.
//!
//! **Source:** Markowitz, *The elimination form of the inverse*, Management Science 3 (1957);
//! Duff, Erisman and Reid, *Direct Methods for Sparse Matrices*, 2nd ed., §10.2.

mod pair;

use super::pattern::Pattern;
use super::shelves::Shelves;
use crate::lists::Lists;

/// An entry this much smaller than the largest in its row is no pivot.
const THRESHOLD: f64 = 0.1;
/// How many rows are looked at for one pivot.
const CANDIDATES: usize = 4;
/// A remainder with this part of its entries present is dense.
const DENSE: f64 = 0.4;
/// What pivots may cost, round by round, while they are taken wherever they are found.
const CHEAP: [usize; 4] = [0, 1, 2, 4];
/// An entry this much smaller than the largest in its row is no cheap pivot.
const CHEAP_THRESHOLD: f64 = 1e-3;
/// A remainder of more rows is ordered as a whole where no pivot is cheap.
const LARGE: usize = 300;
/// A remainder of so many rows is dense in any case.
const SMALL: usize = 8;

/// The order of elimination, and the entries of the factors.
#[derive(Debug, Default)]
pub(crate) struct Pivots {
    /// Rows, in order; those of the tail last.
    pub(crate) rows: Vec<u32>,
    /// Columns, in order; those of the tail last.
    pub(crate) columns: Vec<u32>,
    /// How many are eliminated before the tail.
    pub(crate) sparse: usize,
    /// Rows, by their number, each with an earlier pivot that is subtracted from it, in order of pivots.
    pub(crate) lower: Vec<(u32, u32)>,
    /// For every pivot before the tail, the other columns of its row, by their number.
    pub(crate) upper: Lists,
}

impl Pivots {
    /// Chooses none yet, with room for so many, and for so many entries beside them.
    fn with_room(pivots: usize, entries: usize) -> Self {
        Self {
            rows: Vec::with_capacity(pivots),
            columns: Vec::with_capacity(pivots),
            sparse: 0,
            lower: Vec::with_capacity(entries),
            upper: Lists::with_room(pivots, entries),
        }
    }
}

/// Numbered things by how many entries each has, to find those with few.
#[derive(Debug)]
pub(crate) struct Counts {
    count: Vec<u32>,
    head: Vec<u32>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// Nothing has fewer than this.
    least: usize,
}

const NONE: u32 = u32::MAX;

impl Counts {
    /// Begins with these counts; none will ever be more than `most`.
    pub(crate) fn new(counts: Vec<u32>, most: usize) -> Self {
        let n = counts.len();
        let mut made = Self {
            head: vec![NONE; most + 1],
            next: vec![NONE; n],
            previous: vec![NONE; n],
            count: counts,
            least: most,
        };
        for i in (0..n as u32).rev() {
            made.link(i);
        }
        made
    }
    fn link(&mut self, i: u32) {
        self.least = self.least.min(self.count[i as usize] as usize);
        let head = &mut self.head[self.count[i as usize] as usize];
        self.next[i as usize] = *head;
        self.previous[i as usize] = NONE;
        if *head != NONE {
            self.previous[*head as usize] = i;
        }
        *head = i;
    }
    pub(crate) fn unlink(&mut self, i: u32) {
        let (next, previous) = (self.next[i as usize], self.previous[i as usize]);
        if previous == NONE {
            self.head[self.count[i as usize] as usize] = next;
        } else {
            self.next[previous as usize] = next;
        }
        if next != NONE {
            self.previous[next as usize] = previous;
        }
    }
    pub(crate) fn set(&mut self, i: u32, count: usize) {
        if self.count[i as usize] != count as u32 {
            self.unlink(i);
            self.count[i as usize] = count as u32;
            self.link(i);
        }
    }
    /// Returns a number that no count is below.
    pub(crate) fn least(&mut self) -> usize {
        while self.least + 1 < self.head.len() && self.head[self.least] == NONE {
            self.least += 1;
        }
        self.least
    }
    pub(crate) fn count(&self, i: u32) -> u32 {
        self.count[i as usize]
    }
    pub(crate) fn of(&self, count: usize) -> impl Iterator<Item = u32> + '_ {
        let mut at = self.head.get(count).copied().unwrap_or(NONE);
        std::iter::from_fn(move || {
            let i = at;
            (i != NONE).then(|| {
                at = self.next[i as usize];
                i
            })
        })
    }
}

/// An entry of what is left.
#[derive(Clone, Copy, Debug)]
struct Entry {
    column: u32,
    /// The size of all that it was summed of: what cancels by chance is large all the same.
    size: f32,
    value: f64,
}

/// What is left to be eliminated.
struct Remainder {
    rows: Shelves<Entry>,
    /// Those that are gone too: nothing is left in them.
    columns: Shelves<u32>,
    /// For every column, in how many rows that are left it is.
    count: Vec<u32>,
    /// Rows and columns by how many entries they have, once that is asked for.
    ranks: Option<Ranks>,
    entries: usize,
    left: usize,
    /// For every column, where it stands in the row at hand.
    at: Vec<u32>,
    /// The row of the pivot at hand, and the rows that have its column.
    pivot_row: Vec<Entry>,
    below: Vec<u32>,
}

/// Rows and columns by how many entries they have.
struct Ranks {
    by_row: Counts,
    by_column: Counts,
}

/// How pivots are sought where none is cheap any more.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum How {
    /// What remains of a large matrix is ordered as a whole, each row with a column of its own.
    Paired,
    /// One after the other, by the numbers that have come of it.
    Single,
}

/// Chooses the pivots. What is singular for these numbers is left to the tail.
pub(crate) fn choose(pattern: &Pattern, values: &[f64], how: How) -> Pivots {
    let n = pattern.height();
    let mut rest = Remainder::new(pattern, values);
    let mut out = Pivots::with_room(n, pattern.len());
    if how == How::Paired && n > LARGE {
        rest.eliminate_cheap(&mut out);
        if rest.left > LARGE && pair::eliminate(&rest, &mut out) {
            return out;
        }
    }
    rest.rank();
    while rest.left > SMALL && (rest.entries as f64) < DENSE * (rest.left * rest.left) as f64 {
        let Some((row, column)) = rest.best() else { break };
        rest.eliminate(row, column, &mut out);
    }
    out.sparse = out.rows.len();
    let mut is_left = (vec![true; n], vec![true; n]);
    out.rows.iter().for_each(|&r| is_left.0[r as usize] = false);
    out.columns.iter().for_each(|&c| is_left.1[c as usize] = false);
    out.rows.extend((0..n as u32).filter(|&r| is_left.0[r as usize]));
    out.columns.extend((0..n as u32).filter(|&c| is_left.1[c as usize]));
    out
}

/// Returns the size of the largest entry.
fn largest(entries: &[Entry]) -> f64 {
    entries.iter().fold(0.0, |most, e| most.max(e.value.abs()))
}
/// Returns true for a number that can be divided by, and is not smaller than others allow.
fn is_pivot(value: f64, least: f64) -> bool {
    value != 0.0 && value.is_finite() && value.abs() >= least
}

impl Remainder {
    fn new(pattern: &Pattern, values: &[f64]) -> Self {
        let n = pattern.height();
        let row_of = |r: usize| pattern.row(r).iter().map(move |&c| (c, r as u32));
        let columns = Lists::new(pattern.width, (0..n).flat_map(row_of));
        let length = |starts: &[u32]| starts[1] - starts[0];
        let count: Vec<u32> = columns.starts().windows(2).map(length).collect();
        let entry = |e: usize| Entry {
            column: pattern.column(e) as u32,
            size: values[e].abs() as f32,
            value: values[e],
        };
        // there is room for as many that elimination makes
        let mut entries: Vec<Entry> = Vec::with_capacity(2 * pattern.len());
        entries.extend((0..pattern.len()).map(entry));
        Self {
            rows: Shelves::new((0..n).map(|r| pattern.row(r).len() as u32), entries),
            columns: Shelves::new(count.iter().copied(), columns.into_parts().1),
            at: vec![NONE; count.len()],
            count,
            ranks: None,
            entries: pattern.len(),
            left: n,
            pivot_row: Vec::new(),
            below: Vec::new(),
        }
    }

    /// Eliminates by cheap pivots, going through the rows in rounds as long as many are found.
    fn eliminate_cheap(&mut self, out: &mut Pivots) {
        let mut rows: Vec<u32> = (0..self.rows.len() as u32).collect();
        for most in CHEAP {
            loop {
                let before = self.left;
                rows.retain(|&row| {
                    let found = self.cheap(row, most);
                    if let Some(column) = found {
                        self.eliminate(row, column, out);
                    }
                    found.is_none()
                });
                if (before - self.left) * 16 <= before {
                    break;
                }
            }
        }
    }

    /// The column in which a row has a pivot that costs no more than this: of several the one that was summed of
    /// most, which in a net is a node's own, so that it does not vanish for other numbers.
    fn cheap(&self, row: u32, most: usize) -> Option<u32> {
        let entries = self.rows.of(row);
        let others = entries.len().saturating_sub(1);
        let is_cheap = |e: &&Entry| others * (self.count[e.column as usize] as usize - 1) <= most;
        let cheap = entries.iter().filter(is_cheap);
        let &Entry { column, value, .. } = cheap.max_by(|a, b| a.size.total_cmp(&b.size))?;
        is_pivot(value, CHEAP_THRESHOLD * largest(entries)).then_some(column)
    }

    /// Ranks what is left.
    fn rank(&mut self) {
        let n = self.rows.len();
        let lengths = (0..n as u32).map(|r| self.rows.of(r).len() as u32).collect();
        // what is gone has nothing left, and is not asked for
        self.ranks = Some(Ranks {
            by_row: Counts::new(lengths, n),
            by_column: Counts::new(self.count.clone(), n),
        });
    }

    /// The pivot that makes the fewest new entries, among a few candidates.
    fn best(&self) -> Option<(u32, u32)> {
        let Ranks { by_row, by_column } = self.ranks.as_ref()?;
        // what stands alone in its column changes no other row
        let alone = by_column.of(1).take(CANDIDATES).find_map(|column| {
            let is_left = |r: &&u32| !self.rows.of(**r).is_empty();
            let &row = self.columns.of(column).iter().find(is_left)?;
            self.suits(row, column).then_some((row, column))
        });
        if alone.is_some() {
            return alone;
        }
        let mut best: Option<(usize, f64, u32, u32)> = None;
        let mut looked = 0;
        for count in 1..=self.left {
            for row in by_row.of(count) {
                let entries = self.rows.of(row);
                let largest = largest(entries);
                for &Entry { column, value, .. } in entries {
                    let cost = (count - 1) * (self.count[column as usize] as usize - 1);
                    let size = value.abs();
                    let suits = is_pivot(value, THRESHOLD * largest);
                    let is_better =
                        |b: (usize, f64, u32, u32)| cost < b.0 || cost == b.0 && size > b.1;
                    if suits && best.is_none_or(is_better) {
                        best = Some((cost, size, row, column));
                    }
                }
                looked += 1;
                if best.is_some_and(|b| b.0 <= (count - 1) * (count - 1) || looked >= CANDIDATES) {
                    return best.map(|b| (b.2, b.3));
                }
            }
        }
        best.map(|b| (b.2, b.3))
    }

    /// Returns true if an entry is not much smaller than the largest in its row.
    fn suits(&self, row: u32, column: u32) -> bool {
        let entries = self.rows.of(row);
        let largest = largest(entries);
        let own = |e: &&Entry| e.column == column;
        entries.iter().find(own).is_some_and(|e| is_pivot(e.value, THRESHOLD * largest))
    }

    fn eliminate(&mut self, row: u32, column: u32, out: &mut Pivots) {
        let number = out.rows.len() as u32;
        let mut pivot_row = std::mem::take(&mut self.pivot_row);
        pivot_row.clear();
        pivot_row.extend_from_slice(self.rows.of(row));
        self.rows.clear(row);
        let own = pivot_row.iter().position(|e| e.column == column);
        let pivot = pivot_row.remove(own.expect("the pivot is in its row"));
        self.entries -= pivot_row.len() + 1;
        self.change_count(column, -1);
        pivot_row.iter().for_each(|e| self.change_count(e.column, -1));
        let mut below = std::mem::take(&mut self.below);
        below.clear();
        below.extend_from_slice(self.columns.of(column));
        self.columns.clear(column);
        for &r in &below {
            if !self.rows.of(r).is_empty() {
                self.subtract(pivot, &pivot_row, r);
                out.lower.push((r, number));
            }
        }
        self.count[column as usize] = 0;
        if let Some(ranks) = &mut self.ranks {
            ranks.by_row.unlink(row);
            ranks.by_column.unlink(column);
        }
        self.left -= 1;
        out.rows.push(row);
        out.columns.push(column);
        out.upper.push_each(pivot_row.iter().map(|e| e.column));
        (self.pivot_row, self.below) = (pivot_row, below);
    }

    /// Subtracts so much of a pivot's row, of which these are the other entries, that its column is gone.
    fn subtract(&mut self, pivot: Entry, others: &[Entry], row: u32) {
        let target = self.rows.of_mut(row);
        for (e, i) in target.iter().zip(0..) {
            self.at[e.column as usize] = i;
        }
        let own = self.at[pivot.column as usize] as usize;
        let factor = target[own].value / pivot.value;
        let size_factor = target[own].size / pivot.size;
        let before = target.len();
        for &Entry { column, size, value } in others {
            let (size, value) = (size * size_factor, -factor * value);
            match self.at[column as usize] {
                NONE => {
                    self.rows.add(row, Entry { column, size, value });
                    self.columns.add(column, row);
                    self.change_count(column, 1);
                }
                place => {
                    let entry = &mut self.rows.of_mut(row)[place as usize];
                    entry.value += value;
                    entry.size += size;
                }
            }
        }
        for e in self.rows.of(row) {
            self.at[e.column as usize] = NONE;
        }
        self.rows.take_out(row, own);
        let after = self.rows.of(row).len();
        self.entries = self.entries + after - before;
        if let Some(ranks) = &mut self.ranks {
            ranks.by_row.set(row, after);
        }
    }

    fn change_count(&mut self, column: u32, by: i32) {
        let count = &mut self.count[column as usize];
        *count = count.wrapping_add_signed(by);
        if let Some(ranks) = &mut self.ranks {
            ranks.by_column.set(column, *count as usize);
        }
    }
}
