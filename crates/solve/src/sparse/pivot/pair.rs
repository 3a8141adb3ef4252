//! Pairs: what remains of a large matrix, each row with a column of its own, ordered as a whole.
//!
//! In: the remainder when no pivot is cheap any more. Out: its pivots, on the pairs, in an order of minimum
//! degree. In each row the column is one of its largest entries, so that a net whose rows and columns
//! are its nodes comes out symmetric.
//!
//! **Source:** Duff and Koster, *The design and use of algorithms for permuting large entries to the diagonal
//! of sparse matrices*, SIAM J. Matrix Anal. Appl. 20 (1999).

use super::{DENSE, Entry, NONE, Pivots, Remainder, THRESHOLD, is_pivot, largest};
use crate::sparse::degree::{self, Elimination};

/// What was summed of most makes the pair even where these numbers nearly cancel, down to this part of the largest.
const CANCELLED: f64 = 1e-5;

/// Eliminates all that remains; returns false where some row finds no column of its own.
pub(super) fn eliminate(rest: &Remainder, out: &mut Pivots) -> bool {
    // a row that is left has entries: without any, the matrix is singular
    let is_left = |&r: &u32| !rest.rows.of(r).is_empty();
    let rows: Vec<u32> = (0..rest.rows.len() as u32).filter(is_left).collect();
    if rows.len() < rest.left {
        return false;
    }
    let Some(pairs) = pair(rest, &rows) else { return false };
    let (column_of, pair_of) = (&pairs.column_of_row, &pairs.row_of_column);
    let mut number = vec![NONE; rest.rows.len()];
    for (i, &r) in rows.iter().enumerate() {
        number[r as usize] = i as u32;
    }
    let joined = rows.iter().zip(0..).flat_map(|(&r, i)| {
        let entries = rest.rows.of(r).iter();
        entries.map(move |e| (i, e.column))
    });
    let joined = joined.map(|(i, c)| (i, number[pair_of[c as usize] as usize]));
    let Elimination { order, columns } = degree::eliminate(rows.len(), joined);
    let before = out.rows.len();
    let row_at = |k: usize| rows[order[k] as usize];
    let dense_from = (0..order.len()).find(|&k| {
        let left = order.len() - k;
        columns.of(k as u32).len() as f64 + 1.0 >= (1.0 - 0.5 * DENSE) * left as f64
    });
    let sparse = dense_from.unwrap_or(order.len());
    for k in 0..order.len() {
        let below = columns.of(k as u32);
        let row = row_at(k);
        out.rows.push(row);
        out.columns.push(column_of[row as usize]);
        if k >= sparse {
            continue;
        }
        for &j in below {
            out.lower.push((row_at(j as usize), (before + k) as u32));
        }
        let upper = below.iter().map(|&j| column_of[row_at(j as usize) as usize]);
        out.upper.push_each(upper);
    }
    out.sparse = before + sparse;
    true
}

struct Pairs {
    column_of_row: Vec<u32>,
    row_of_column: Vec<u32>,
}

/// Finds a column for each row, among its entries that are no smaller than others: the largest, if it is
/// left, else by exchange.
fn pair(rest: &Remainder, rows: &[u32]) -> Option<Pairs> {
    let n = rest.rows.len();
    let mut pairs = Pairs { column_of_row: vec![NONE; n], row_of_column: vec![NONE; n] };
    for &r in rows {
        let entries = rest.rows.of(r);
        let least = CANCELLED * largest(entries);
        let suits = |e: &&Entry| is_pivot(e.value, least);
        let found = entries.iter().filter(suits).max_by(|a, b| a.size.total_cmp(&b.size))?;
        let other = &mut pairs.row_of_column[found.column as usize];
        if *other == NONE {
            *other = r;
            pairs.column_of_row[r as usize] = found.column;
        }
    }
    let mut search = Search { met: vec![Met { by: NONE, from: NONE }; n], queue: Vec::new() };
    for &r in rows {
        if pairs.column_of_row[r as usize] == NONE && !search.exchange(rest, r, &mut pairs) {
            return None;
        }
    }
    Some(pairs)
}

/// What finds ways of exchanges, one after the other.
struct Search {
    /// For every column, when it was last met.
    met: Vec<Met>,
    /// Rows on ways from the row at hand, nearest first.
    queue: Vec<u32>,
}

/// That a column was met.
#[derive(Clone, Copy)]
struct Met {
    /// The row that was to find a column.
    by: u32,
    /// The row in which it was met.
    from: u32,
}

impl Search {
    /// Finds a column for a row along a shortest way of exchanges.
    fn exchange(&mut self, rest: &Remainder, row: u32, pairs: &mut Pairs) -> bool {
        let Self { met, queue } = self;
        queue.clear();
        queue.push(row);
        let mut next = 0;
        while let Some(&r) = queue.get(next) {
            next += 1;
            let entries = rest.rows.of(r);
            let least = THRESHOLD * largest(entries);
            for &Entry { column: c, value, .. } in entries {
                if !is_pivot(value, least) || met[c as usize].by == row {
                    continue;
                }
                met[c as usize] = Met { by: row, from: r };
                let other = pairs.row_of_column[c as usize];
                if other != NONE {
                    queue.push(other);
                    continue;
                }
                let (mut column, mut to) = (c, r);
                loop {
                    let before = std::mem::replace(&mut pairs.column_of_row[to as usize], column);
                    pairs.row_of_column[column as usize] = to;
                    if to == row {
                        return true;
                    }
                    column = before;
                    to = met[column as usize].from;
                }
            }
        }
        false
    }
}
