//! Least change of a large linear block, by elimination.
//!
//! In: the block, x0, a start. Out: the unknowns, in place, or nothing where the rows are dependent for these
//! numbers or leave too much free. Rows are eliminated over what is not given
//! (or, where nothing given yields, what has no value yet), in a finite field, once:
//! which of them and which unknowns make a square system does not hang on the numbers, and doubles lose
//! it in long chains. Rows that are left over depend on that system but for given numbers, and bind those:
//! these go to the nearest point of x0 that is allowed. Of rows that depend on each other the one with the
//! largest share is left over, so that what rounding leaves of the others does not add up in it. The few
//! unknowns that are left over take what makes
//! the distance of all least; in the end the system is refined until its rows hold as well as their
//! numbers are stored. What the rows hardly feel costs nothing here, where steps that are damped would not
//! come to an end. Where numbers are special, so that rows depend that otherwise do not, they are eliminated
//! themselves.
//!
//! **Source:** Björck, *Numerical Methods for Least Squares Problems*, SIAM (1996), §5.1.

use crate::block::{Block, Local, Workspace};
use crate::dense;
use crate::echelon::{Echelon, Row};
use crate::number::Number;
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

/// Which rows and unknowns make a square system.
#[derive(Debug)]
pub(super) struct Structure {
    rows: Vec<usize>,
    /// For every unknown that is not given: it is part of the system.
    is_basic: Vec<bool>,
    /// The rows that depend on those over what is not given.
    over: Vec<usize>,
}

impl Structure {
    /// Finds it by elimination over so many unknowns that are not given; none where too many are left over.
    fn of<N: Number>(over_open: &[Row<N>], open: usize) -> Option<Self> {
        let eliminated = Echelon::new(over_open, open);
        let is_basic: Vec<bool> = (0..open as u32).map(|c| eliminated.has_pivot(c)).collect();
        let mut rows: Vec<usize> = eliminated.pivots().map(|(r, _)| r as usize).collect();
        let mut over: Vec<usize> = eliminated.vanished().iter().map(|&r| r as usize).collect();
        rows.sort_unstable();
        over.sort_unstable();
        let free = open - rows.len();
        let suits = |count: usize, width: usize| count <= FREE && count * width <= NUMBERS;
        (suits(free, open) && suits(over.len(), rows.len())).then_some(Self {
            rows,
            is_basic,
            over,
        })
    }

    /// Finds the structure of a block that does not hang on numbers.
    pub(super) fn of_block(block: &Block, is_given: &[bool]) -> Option<Self> {
        let mut place = vec![None; block.unknowns.len()];
        let mut open = 0;
        for (i, place) in place.iter_mut().enumerate() {
            if is_given.get(i) != Some(&true) {
                *place = Some(open);
                open += 1;
            }
        }
        let over_open = |row: Row<_>| -> Row<_> {
            row.into_iter().filter_map(|(u, slope)| Some((place[u as usize]?, slope))).collect()
        };
        let rows: Vec<Row<_>> = block.residues()?.into_iter().map(over_open).collect();
        Self::of(&rows, open as usize)
    }
}

/// A square system with its factors.
struct Basic {
    rows: Vec<usize>,
    /// Places among the unknowns.
    columns: Vec<usize>,
    symbolic: Symbolic,
    lu: Lu,
}

/// Rows whose sum vanishes over what is not given.
struct Binding {
    /// The row that is left over for it: it is there once, and nowhere else.
    over: usize,
    /// How much there is of each row.
    shares: Vec<f64>,
}

/// Solves from the values that the unknowns have now, by the structure of the block or that of these numbers;
/// false where that is not possible, whatever they are then. Asked of: which unknowns are given, their scales,
/// x0.
pub(super) fn solve(
    block: &Block,
    (is_given, scale, x0): (&[bool], &[f64], &[f64]),
    structure: Option<&Structure>,
    values: &mut [f64],
    w: &mut Workspace,
    local: &mut Local,
) -> bool {
    block.slopes(values, w, local);
    let stated = Stated::new(block, is_given, scale, local);
    let special;
    let structure = match structure {
        Some(structure) => structure,
        None => {
            let found = Structure::of(&stated.over_open, stated.open.len());
            let Some(found) = found else { return false };
            special = found;
            &special
        }
    };
    let is_free = |c: &usize| !structure.is_basic[*c];
    let free: Vec<usize> = (0..stated.open.len()).filter(is_free).collect();
    for &c in &free {
        let slot = stated.slot(stated.open[c]);
        values[slot] = x0[slot];
    }
    let Some(bindings) = stated.bindings(structure) else { return false };
    let mut is_over = vec![false; block.height()];
    bindings.iter().for_each(|binding| is_over[binding.over] = true);
    let rows = (0..block.height()).filter(|&r| !is_over[r]).collect();
    let Some(mut basic) = stated.basic(rows, structure) else { return false };
    block.sides(values, w, local);
    if !stated.settle(&bindings, &mut basic, x0, values, w, local) {
        return false;
    }
    stated.free(&mut basic, &free, x0, values);
    block.sides(values, w, local);
    stated.settle(&bindings, &mut basic, x0, values, w, local)
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
    fn give(&self, bindings: &[Binding], x0: &[f64], values: &mut [f64], local: &Local) -> bool {
        let (k, width) = (bindings.len(), self.given.len());
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
        for (own, binding) in binds.chunks_exact_mut(width.max(1)).zip(bindings) {
            let mut off = 0.0;
            for (r, &share) in binding.shares.iter().enumerate().filter(|s| *s.1 != 0.0) {
                off += share * self.residual(r, local);
                for &(c, slope) in &self.over_given[r] {
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

    /// For every unknown that is not given, where it stands in the square system.
    fn places(&self, structure: &Structure) -> Vec<Option<u32>> {
        let mut count = 0..;
        structure.is_basic.iter().map(|&is| if is { count.next() } else { None }).collect()
    }

    /// Factorises the square system of these rows.
    fn basic(&self, rows: Vec<usize>, structure: &Structure) -> Option<Basic> {
        let place = self.places(structure);
        let basic = self.open.iter().zip(&structure.is_basic);
        let columns: Vec<usize> = basic.filter(|b| *b.1).map(|b| *b.0).collect();
        let own = |&r: &usize| {
            let row = self.over_open[r].iter();
            row.filter_map(|&(c, slope)| Some((place[c as usize]?, slope)))
        };
        let places = |r: &usize| own(r).map(|e| e.0).collect();
        let pattern = Pattern::of_rows(columns.len(), rows.iter().map(places));
        let slopes: Vec<f64> = rows.iter().flat_map(own).map(|e| e.1).collect();
        let mut lu = Lu::default();
        let (symbolic, factors) = Symbolic::suited(&pattern, &slopes, &mut lu);
        (factors?.sign != 0).then_some(Basic { rows, columns, symbolic, lu })
    }

    /// Finds the sums that vanish, by how much of the system there is in every row that depends on it.
    fn bindings(&self, structure: &Structure) -> Option<Vec<Binding>> {
        if structure.over.is_empty() {
            return Some(Vec::new());
        }
        let place = self.places(structure);
        let n = structure.rows.len();
        // rows and columns change places
        let mut turned: Vec<Row> = vec![Row::new(); n];
        for (&r, i) in structure.rows.iter().zip(0..) {
            for &(c, slope) in &self.over_open[r] {
                if let Some(place) = place[c as usize] {
                    turned[place as usize].push((i, slope));
                }
            }
        }
        let places = |row: &Row| row.iter().map(|e| e.0).collect();
        let pattern = Pattern::of_rows(n, turned.iter().map(places));
        let slopes: Vec<f64> = turned.iter().flatten().map(|e| e.1).collect();
        let mut lu = Lu::default();
        let (symbolic, factors) = Symbolic::suited(&pattern, &slopes, &mut lu);
        factors.filter(|f| f.sign != 0)?;
        let binding = |&over: &usize| {
            let mut own = vec![0.0; n];
            for &(c, slope) in &self.over_open[over] {
                if let Some(place) = place[c as usize] {
                    own[place as usize] = -slope;
                }
            }
            symbolic.solve(&mut lu, &mut own);
            let mut shares = vec![0.0; self.block.height()];
            structure.rows.iter().zip(own).for_each(|(&r, share)| shares[r] = share);
            shares[over] = 1.0;
            Binding { over, shares }
        };
        let mut bindings: Vec<Binding> = structure.over.iter().map(binding).collect();
        leave_largest_over(&mut bindings);
        Some(bindings)
    }

    /// Brings all to where the rows hold, as well as their numbers are stored, from where `local` was computed;
    /// false where what binds given numbers cannot be met.
    fn settle(
        &self,
        bindings: &[Binding],
        basic: &mut Basic,
        x0: &[f64],
        values: &mut [f64],
        w: &mut Workspace,
        local: &mut Local,
    ) -> bool {
        let mut error = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            if !self.give(bindings, x0, values, local) {
                return false;
            }
            self.block.sides(values, w, local);
            self.refine(basic, values, w, local);
            let over = bindings.iter().map(|binding| binding.over);
            let now = self.block.backward_error(over, values, local);
            if now <= f64::EPSILON || now > 0.5 * error {
                break;
            }
            error = now;
        }
        true
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
            let rows = basic.rows.iter().copied();
            let now = self.block.backward_error(rows, values, local);
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

/// Makes each leave over the row that has the largest share in it, and takes that away from the others.
fn leave_largest_over(bindings: &mut [Binding]) {
    for k in 0..bindings.len() {
        let largest = |b: &Binding| {
            let shares = b.shares.iter().map(|share| share.abs()).enumerate();
            shares.fold((0, 0.0), |most, s| if s.1 > most.1 { s } else { most })
        };
        let most = (k..bindings.len()).map(|i| (i, largest(&bindings[i])));
        let most = most.fold((k, (0, 0.0)), |most, b| if b.1.1 > most.1.1 { b } else { most });
        let (i, (over, _)) = most;
        bindings.swap(k, i);
        let (before, rest) = bindings.split_at_mut(k);
        let Some((own, after)) = rest.split_first_mut() else { return };
        let share = own.shares[over];
        own.over = over;
        own.shares.iter_mut().for_each(|x| *x /= share);
        for other in before.iter_mut().chain(after) {
            let factor = other.shares[over];
            if factor != 0.0 {
                dense::add(&mut other.shares, -factor, &own.shares);
                other.shares[over] = 0.0;
            }
        }
    }
}
