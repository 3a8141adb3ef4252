//! Least change of a large linear block, by elimination.
//!
//! In: the block, x0, a start. Out: the unknowns, in place, or nothing where the rows are dependent for these
//! numbers or leave too much free. Rows are eliminated over what is not given. Sums of them that vanish there
//! bind given numbers alone: those go to the nearest point of x0 that these allow. The pivots are a square
//! system for the rest, whose few free unknowns take what makes the distance of all least; in the end it
//! is refined until its rows hold as well as their numbers are stored. What the rows hardly feel costs
//! nothing here, where steps that are damped would not come to an end.
//!
//! **Source:** Björck, *Numerical Methods for Least Squares Problems*, SIAM (1996), §5.1.

use crate::block::{Block, Local, Workspace};
use crate::dense;
use crate::echelon::{Echelon, Row, Vanishing};
use crate::sparse::{Lu, Pattern, Symbolic};

/// The most unknowns that may be left free, and the most sums that may bind given numbers.
const FREE: usize = 400;
/// The most numbers that what is free may be written down with.
const NUMBERS: usize = 4_000_000;
/// Smaller pivots of what binds given numbers are rounding.
const REGULAR: f64 = 1e-12;
/// How often a solution is refined.
const REFINEMENTS: usize = 10;

/// A block at a state, in scaled unknowns; its rows weighted so that the largest slope of each is one.
struct Stated<'b> {
    block: &'b Block,
    scale: &'b [f64],
    weight: Vec<f64>,
    /// The unknowns that are not given, and those that are.
    open: Vec<usize>,
    given: Vec<usize>,
    over_open: Vec<Row>,
    over_given: Vec<Row>,
}

/// The pivots of the elimination as a square system.
struct Basic {
    rows: Vec<usize>,
    /// Places among the unknowns.
    columns: Vec<usize>,
    symbolic: Symbolic,
    lu: Lu,
}

/// Solves from the values that the unknowns have now; false where that is not possible, whatever they are then.
pub(super) fn solve(
    block: &Block,
    is_given: &[bool],
    scale: &[f64],
    x0: &[f64],
    values: &mut [f64],
    w: &mut Workspace,
    local: &mut Local,
) -> bool {
    block.slopes(values, w, local);
    let stated = Stated::new(block, is_given, scale, local);
    let eliminated = Echelon::new(&stated.over_open, stated.open.len());
    let free: Vec<usize> =
        (0..stated.open.len()).filter(|&c| !eliminated.has_pivot(c as u32)).collect();
    if free.len() > FREE || free.len() * stated.open.len() > NUMBERS {
        return false;
    }
    for &c in &free {
        let slot = stated.slot(stated.open[c]);
        values[slot] = x0[slot];
    }
    let Some(mut basic) = stated.basic(&eliminated) else { return false };
    let vanishing = eliminated.vanishing();
    // once for the numbers, once for what rounding left of the sums
    block.sides(values, w, local);
    for _ in 0..if vanishing.is_empty() { 1 } else { 2 } {
        if !stated.give(&vanishing, x0, values, local) {
            return false;
        }
        block.sides(values, w, local);
        stated.refine(&mut basic, values, w, local);
    }
    stated.free(&mut basic, &free, x0, values);
    block.sides(values, w, local);
    stated.refine(&mut basic, values, w, local);
    true
}

impl<'b> Stated<'b> {
    fn new(block: &'b Block, is_given: &[bool], scale: &'b [f64], local: &Local) -> Self {
        let mut place = vec![0u32; block.unknowns.len()];
        let (mut open, mut given) = (Vec::new(), Vec::new());
        for (i, place) in place.iter_mut().enumerate() {
            let kind = if is_given.get(i) == Some(&true) { &mut given } else { &mut open };
            *place = kind.len() as u32;
            kind.push(i);
        }
        let mut stated = Self {
            block,
            scale,
            weight: Vec::new(),
            open,
            given,
            over_open: Vec::new(),
            over_given: Vec::new(),
        };
        for r in 0..block.height() {
            let (mut over_open, mut over_given) = (Row::new(), Row::new());
            for e in block.pattern.range(r) {
                let column = block.pattern.column(e);
                let slope = local.jacobian[e] * scale[column];
                let own = if is_given.get(column) == Some(&true) {
                    &mut over_given
                } else {
                    &mut over_open
                };
                if slope != 0.0 {
                    own.push((place[column], slope));
                }
            }
            let largest = over_open.iter().fold(0.0f64, |m, e| m.max(e.1.abs()));
            let weight = if largest > 0.0 { 1.0 / largest } else { 1.0 };
            let weighted = over_open.iter_mut().chain(&mut over_given);
            weighted.for_each(|e| e.1 *= weight);
            stated.weight.push(weight);
            stated.over_open.push(over_open);
            stated.over_given.push(over_given);
        }
        stated
    }

    fn slot(&self, unknown: usize) -> usize {
        self.block.unknowns[unknown] as usize
    }
    fn residual(&self, row: usize, local: &Local) -> f64 {
        (local.left[row] - local.right[row]) * self.weight[row]
    }

    /// Brings given numbers as near to x0 as sums that bind them alone allow; false where these depend on
    /// each other.
    fn give(&self, vanishing: &[Vanishing], x0: &[f64], values: &mut [f64], local: &Local) -> bool {
        let (k, width) = (vanishing.len(), self.given.len());
        if k > FREE || k * width > NUMBERS {
            return false;
        }
        let back: Vec<f64> = self
            .given
            .iter()
            .map(|&i| (x0[self.slot(i)] - values[self.slot(i)]) / self.scale[i])
            .collect();
        // what binds given numbers, and by how much it does not hold
        let mut binds = vec![0.0; k * width];
        let mut right = Vec::with_capacity(k);
        for (own, v) in binds.chunks_exact_mut(width.max(1)).zip(vanishing) {
            let mut off = 0.0;
            for &(r, share) in &v.sum {
                off += share * self.residual(r as usize, local);
                for &(c, slope) in &self.over_given[r as usize] {
                    own[c as usize] += share * slope;
                }
            }
            // of equal weight, whatever they are made of
            let size = dense::norm(own);
            if size == 0.0 {
                return false;
            }
            own.iter_mut().for_each(|x| *x /= size);
            right.push(-off / size - dense::dot(own, &back));
        }
        if right.len() < k {
            return false;
        }
        let row = |i: usize| &binds[i * width..][..width];
        let mut normal: Vec<f64> = Vec::with_capacity(k * k);
        for i in 0..k {
            normal.extend((0..k).map(|j| dense::dot(row(i), row(j))));
        }
        let mut swaps = Vec::new();
        if k > 0 && dense::factorise(&mut normal, k, &mut swaps).ratio < REGULAR {
            return false;
        }
        dense::substitute_back(&normal, k, &swaps, &mut right);
        let mut change = back;
        for (i, factor) in right.iter().enumerate() {
            dense::add(&mut change, *factor, row(i));
        }
        for (&i, d) in self.given.iter().zip(&change) {
            values[self.slot(i)] += d * self.scale[i];
        }
        true
    }

    /// Factorises the rows that have pivots, over these.
    fn basic(&self, eliminated: &Echelon) -> Option<Basic> {
        let mut rows: Vec<usize> = eliminated.pivots().map(|(r, _)| r as usize).collect();
        rows.sort_unstable();
        let mut number = vec![u32::MAX; self.open.len()];
        let mut columns = Vec::with_capacity(rows.len());
        for (c, &i) in self.open.iter().enumerate() {
            if eliminated.has_pivot(c as u32) {
                number[c] = columns.len() as u32;
                columns.push(i);
            }
        }
        let own =
            |&r: &usize| self.over_open[r].iter().filter(|e| number[e.0 as usize] != u32::MAX);
        let places = |r: &usize| own(r).map(|e| number[e.0 as usize]).collect();
        let pattern = Pattern::of_rows(columns.len(), rows.iter().map(places));
        let slopes: Vec<f64> = rows.iter().flat_map(own).map(|e| e.1).collect();
        let mut lu = Lu::default();
        let (symbolic, factors) = Symbolic::suited(&pattern, &slopes, &mut lu);
        (factors?.sign != 0).then_some(Basic { rows, columns, symbolic, lu })
    }

    /// Brings what has pivots to where the rows hold, from where `local` was computed.
    fn refine(&self, basic: &mut Basic, values: &mut [f64], w: &mut Workspace, local: &mut Local) {
        let mut error = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            let mut step: Vec<f64> = basic.rows.iter().map(|&r| -self.residual(r, local)).collect();
            basic.symbolic.solve(&mut basic.lu, &mut step);
            let before: Vec<f64> = basic.columns.iter().map(|&i| values[self.slot(i)]).collect();
            for (&i, d) in basic.columns.iter().zip(&step) {
                values[self.slot(i)] += d * self.scale[i];
            }
            self.block.sides(values, w, local);
            let now = self.block.backward_error(values, local);
            if now >= error {
                for (&i, x) in basic.columns.iter().zip(&before) {
                    values[self.slot(i)] = *x;
                }
                self.block.sides(values, w, local);
                break;
            }
            error = now;
            if now <= f64::EPSILON {
                break;
            }
        }
    }

    /// Moves what is free so that the distance of all from x0 is least, and what has pivots along with it.
    fn free(&self, basic: &mut Basic, free: &[usize], x0: &[f64], values: &mut [f64]) {
        let n = free.len();
        let mut along = vec![Vec::new(); n];
        for (own, &c) in along.iter_mut().zip(free) {
            let slope = |&r: &usize| {
                let row = &self.over_open[r];
                row.binary_search_by_key(&(c as u32), |e| e.0).map_or(0.0, |at| -row[at].1)
            };
            own.extend(basic.rows.iter().map(slope));
            basic.symbolic.solve(&mut basic.lu, own);
        }
        let away: Vec<f64> = basic
            .columns
            .iter()
            .map(|&i| (values[self.slot(i)] - x0[self.slot(i)]) / self.scale[i])
            .collect();
        let mut normal: Vec<f64> = Vec::with_capacity(n * n);
        for i in 0..n {
            normal.extend((0..n).map(|j| {
                let itself = if i == j { 1.0 } else { 0.0 };
                itself + dense::dot(&along[i], &along[j])
            }));
        }
        let mut by: Vec<f64> = along.iter().map(|own| -dense::dot(own, &away)).collect();
        let mut swaps = Vec::new();
        dense::factorise(&mut normal, n, &mut swaps);
        dense::substitute_back(&normal, n, &swaps, &mut by);
        for ((own, &c), by) in along.iter().zip(free).zip(&by) {
            let i = self.open[c];
            values[self.slot(i)] += by * self.scale[i];
            for (&i, d) in basic.columns.iter().zip(own) {
                values[self.slot(i)] += by * d * self.scale[i];
            }
        }
    }
}
