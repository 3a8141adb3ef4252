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
#[derive(Clone, Debug, Default)]
pub(crate) struct Pivots {
    /// Rows, in order; those of the tail last.
    pub(crate) rows: Vec<u32>,
    /// Columns, in order; those of the tail last.
    pub(crate) columns: Vec<u32>,
    /// How many are eliminated before the tail.
    pub(crate) sparse: usize,
    /// For every row, by its number, the earlier pivots that are subtracted from it, in order.
    pub(crate) lower: Vec<Vec<u32>>,
    /// For every pivot before the tail, the other columns of its row, by their number.
    pub(crate) upper: Vec<Vec<u32>>,
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
    rows: Vec<Vec<Entry>>,
    /// Those that are gone too: nothing is left in them.
    columns: Vec<Vec<u32>>,
    by_row: Counts,
    by_column: Counts,
    entries: usize,
    left: usize,
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
    let mut out = Pivots { lower: vec![Vec::new(); n], ..Pivots::default() };
    let mut at = vec![NONE; n];
    let mut is_left = (vec![true; n], vec![true; n]);
    let mut take = |rest: &mut Remainder, row: u32, column: u32, out: &mut Pivots| {
        rest.eliminate(row, column, out, &mut at);
        is_left.0[row as usize] = false;
        is_left.1[column as usize] = false;
    };
    if how == How::Paired && n > LARGE {
        rest.each_cheap(&mut |rest, row, column| take(rest, row, column, &mut out));
        if rest.left > LARGE && pair::eliminate(&rest, &mut out) {
            return out;
        }
    }
    while rest.left > SMALL && (rest.entries as f64) < DENSE * (rest.left * rest.left) as f64 {
        let Some((row, column)) = rest.best() else { break };
        take(&mut rest, row, column, &mut out);
    }
    out.sparse = out.rows.len();
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
        let mut columns: Vec<Vec<u32>> = vec![Vec::new(); n];
        let rows: Vec<Vec<Entry>> = (0..n)
            .map(|r| {
                pattern
                    .range(r)
                    .map(|e| {
                        columns[pattern.column(e)].push(r as u32);
                        Entry {
                            column: pattern.column(e) as u32,
                            size: values[e].abs() as f32,
                            value: values[e],
                        }
                    })
                    .collect()
            })
            .collect();
        let by_row = Counts::new(rows.iter().map(|r| r.len() as u32).collect(), n);
        let by_column = Counts::new(columns.iter().map(|c| c.len() as u32).collect(), n);
        Self { rows, columns, by_row, by_column, entries: pattern.len(), left: n }
    }

    /// Visits cheap pivots, going through the rows in rounds as long as many are found.
    fn each_cheap(&mut self, visit: &mut dyn FnMut(&mut Self, u32, u32)) {
        for most in CHEAP {
            loop {
                let before = self.left;
                for row in 0..self.rows.len() as u32 {
                    if let Some(column) = self.cheapest(row, most) {
                        visit(self, row, column);
                    }
                }
                if (before - self.left) * 16 <= before {
                    break;
                }
            }
        }
    }

    /// The column in which a row has a pivot that costs no more than this.
    fn cheapest(&self, row: u32, most: usize) -> Option<u32> {
        let entries = &self.rows[row as usize];
        let others = entries.len().saturating_sub(1);
        let cost = |c: u32| others * (self.by_column.count(c) as usize - 1);
        let &Entry { column, value, .. } = entries.iter().min_by_key(|e| cost(e.column))?;
        if cost(column) > most {
            return None;
        }
        let largest = largest(entries);
        is_pivot(value, CHEAP_THRESHOLD * largest).then_some(column)
    }

    /// The pivot that makes the fewest new entries, among a few candidates.
    fn best(&self) -> Option<(u32, u32)> {
        // what stands alone in its column changes no other row
        let alone = self.by_column.of(1).take(CANDIDATES).find_map(|column| {
            let is_left = |r: &&u32| !self.rows[**r as usize].is_empty();
            let &row = self.columns[column as usize].iter().find(is_left)?;
            self.suits(row, column).then_some((row, column))
        });
        if alone.is_some() {
            return alone;
        }
        let mut best: Option<(usize, f64, u32, u32)> = None;
        let mut looked = 0;
        for count in 1..=self.left {
            for row in self.by_row.of(count) {
                let entries = &self.rows[row as usize];
                let largest = largest(entries);
                for &Entry { column, value, .. } in entries {
                    let cost = (count - 1) * (self.by_column.count(column) as usize - 1);
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
        let entries = &self.rows[row as usize];
        let largest = largest(entries);
        let own = |e: &&Entry| e.column == column;
        entries.iter().find(own).is_some_and(|e| is_pivot(e.value, THRESHOLD * largest))
    }

    fn eliminate(&mut self, row: u32, column: u32, out: &mut Pivots, at: &mut [u32]) {
        let pivot_row = std::mem::take(&mut self.rows[row as usize]);
        let number = out.rows.len() as u32;
        let mut pivot = 0.0;
        let mut pivot_size = 0.0;
        for e in &pivot_row {
            self.by_column.set(e.column, self.by_column.count(e.column) as usize - 1);
            if e.column == column {
                (pivot, pivot_size) = (e.value, e.value.abs() as f32);
            }
        }
        self.entries -= pivot_row.len();
        let below = std::mem::take(&mut self.columns[column as usize]);
        for &r in &below {
            let target = &mut self.rows[r as usize];
            if target.is_empty() {
                continue;
            }
            for (i, e) in target.iter().enumerate() {
                at[e.column as usize] = i as u32;
            }
            let own = at[column as usize] as usize;
            let factor = target[own].value / pivot;
            let size_factor = target[own].size / pivot_size;
            let before = target.len();
            for &Entry { column: c, size, value } in &pivot_row {
                if c == column {
                    continue;
                }
                let (size, value) = (size * size_factor, -factor * value);
                let place = at[c as usize];
                if place == NONE {
                    target.push(Entry { column: c, size, value });
                    self.columns[c as usize].push(r);
                    self.by_column.set(c, self.by_column.count(c) as usize + 1);
                } else {
                    target[place as usize].value += value;
                    target[place as usize].size += size;
                }
            }
            for e in target.iter() {
                at[e.column as usize] = NONE;
            }
            target.swap_remove(own);
            self.entries += target.len();
            self.entries -= before;
            self.by_row.set(r, target.len());
            out.lower[r as usize].push(number);
        }
        self.by_row.unlink(row);
        self.by_column.unlink(column);
        self.left -= 1;
        out.rows.push(row);
        out.columns.push(column);
        out.upper.push(pivot_row.into_iter().map(|e| e.column).filter(|&c| c != column).collect());
    }
}
