//! Blocks in closed form: where two circles meet, a circle and a line, a product and a sum.
//!
//! In: a block that has a closed form, a start, the branch to stay on. Out: the two unknowns, in place; or
//! nothing where Newton's steps have to decide, as where the two solutions nearly meet. The difference of two
//! circles is a line on which both solutions lie, one on each side of the centres: their determinants have
//! different signs, which is how the branch is told. What comes out is corrected by one Newton step, and a
//! start that is a solution to rounding is left as it is.

use super::{Course, Solved, Square, Trust};
use crate::block::{Closed, Conic, Conics, Workspace};
use base::number::sqrt;

/// The sine of the angle between two rows in a solution, below which it nearly is two.
const NEAR: f64 = 1e-3;
/// The sine of the angle between two rows below which it is not told which side a state is on.
const FLAT: f64 = 1e-9;
/// A correction above this, in parts of the extent, is none of rounding.
const CORRECTION: f64 = 1e-7;
/// Numbers that differ by less are the same.
const SAME: f64 = 1e-9;
/// How many roundings of its numbers a row may be off in a solution.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

impl Square {
    /// Solves by the closed form of the block; nothing where it has none or it does not decide.
    pub(super) fn solve_closed(
        &self,
        course: &mut Course<'_>,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
    ) -> Option<Solved> {
        let base = self.base(values, w)?;
        let Base { closed, conics, start } = &base;
        let slots = self.pair();
        let is_branch = course.trust == Trust::Branch;
        let here = match side(conics) {
            Some(side) => side,
            None if is_branch => return None,
            None if course.side.closed != 0 => f64::from(course.side.closed),
            None => return self.solve_undecided(&base, values, scales, w),
        };
        let side = match course.side.closed {
            0 if !is_branch => here,
            0 => side(&self.block.conics(closed, course.last, w))?,
            known => f64::from(known),
        };
        if here == side && conics.is_guarded && is_rounding(conics, *start) {
            return Some(Solved::Regular);
        }
        let first = newton(conics)?;
        let roots = roots(conics)?;
        let own = |p: &&[f64; 2]| determinant(conics, **p) * side > 0.0;
        if is_branch {
            let root = roots.all().iter().find(own);
            let Some(root) = root.filter(|p| !bends(first, **p, slots, scales)) else {
                return Some(Solved::Failed);
            };
            let put = self.put(&base, *root, values, scales, w)?;
            if !put.is_guarded {
                return Some(Solved::Failed);
            }
            course.side.closed = put.side;
            return Some(Solved::Regular);
        }
        // what lies the wrong way of a direction is no solution: then the other one may be
        let (own, other) = (roots.all().iter().find(own), roots.all().iter().find(|p| !own(p)));
        for root in own.into_iter().chain(other) {
            if self.put(&base, *root, values, scales, w)?.is_guarded {
                return Some(Solved::Regular);
            }
        }
        Some(Solved::Failed)
    }

    /// Returns on which side a state lies, as the closed form tells it; zero where that is not told.
    pub(super) fn closed_side(&self, state: &[f64], w: &mut Workspace) -> i8 {
        let closed = self.block.closed();
        closed.and_then(|c| side(&self.block.conics(c, state, w))).map_or(0, |side| side as i8)
    }

    /// Solves from a start that lies on neither side: it takes the nearer solution; of two that are as near that in
    /// which the unknown grows in which they differ more, so that the order of the rows plays no part.
    fn solve_undecided(
        &self,
        base: &Base<'_>,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
    ) -> Option<Solved> {
        let roots = roots(&base.conics)?;
        let slots = self.pair();
        let &[first, second] = roots.all() else { return None };
        let way = [0, 1].map(|i| (second[i] - first[i]) / scales[slots[i]]);
        let apart = size(second, slots, scales) - size(first, slots, scales);
        let larger = if way[1].abs() > way[0].abs() * (1.0 + SAME) { way[1] } else { way[0] };
        let is_same = apart.abs() <= SAME * size(way, [0, 1], &[1.0, 1.0]);
        let second_first = if is_same { larger > 0.0 } else { apart < 0.0 };
        let order = if second_first { [second, first] } else { [first, second] };
        for root in order {
            if self.put(base, root, values, scales, w)?.is_guarded {
                return Some(Solved::Regular);
            }
        }
        Some(Solved::Failed)
    }

    /// Returns all solutions of a block in closed form, as a value for each unknown; nothing where it has no
    /// closed form or that does not decide. Leaves the unknowns anywhere.
    pub(crate) fn all_solutions(
        &self,
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
    ) -> Option<Vec<Vec<f64>>> {
        let base = self.base(values, w)?;
        let mut found = Vec::new();
        for p in roots(&base.conics)?.all() {
            if self.put(&base, *p, values, scales, w)?.is_guarded {
                found.push(self.pair().map(|s| values[s]).to_vec());
            }
        }
        Some(found)
    }

    /// Returns its rows around where the unknowns are, if it has a closed form.
    fn base(&self, values: &[f64], w: &mut Workspace) -> Option<Base<'_>> {
        let closed = self.block.closed()?;
        let start = self.pair().map(|s| values[s]);
        Some(Base { closed, conics: self.block.conics(closed, values, w), start })
    }

    /// The slots of its two unknowns.
    fn pair(&self) -> [usize; 2] {
        [0, 1].map(|u| self.block.unknowns[u] as usize)
    }

    /// Puts the unknowns so far from a start and corrects them by Newton's step. Where the correction is more
    /// than that they are put back.
    fn put(
        &self,
        base: &Base<'_>,
        by: [f64; 2],
        values: &mut [f64],
        scales: &[f64],
        w: &mut Workspace,
    ) -> Option<Put> {
        let Base { closed, conics, start } = *base;
        let slots = self.pair();
        let to = [start[0] + by[0], start[1] + by[1]];
        let rows = conics.rows.map(|row| around(&row, by));
        let says = |r: usize| says_enough(&conics.rows[r], &rows[r], by, to);
        let (there, from, by) = if says(0) && says(1) && !closed.guards_move() {
            (Conics { rows, is_guarded: conics.is_guarded }, start, by)
        } else {
            (0..2).for_each(|i| values[slots[i]] = to[i]);
            (self.block.conics(closed, values, w), to, [0.0; 2])
        };
        let step = newton(&there).filter(|&step| size(step, slots, scales) <= CORRECTION);
        for i in 0..2 {
            values[slots[i]] = step.map_or(start[i], |step| from[i] + (by[i] + step[i]));
        }
        step.map(|_| Put {
            is_guarded: there.is_guarded,
            side: side(&there).map_or(0, |side| side as i8),
        })
    }
}

/// Both rows around a start.
struct Base<'a> {
    closed: &'a Closed,
    conics: Conics,
    start: [f64; 2],
}

/// A solution that was put in.
struct Put {
    /// True if it is one.
    is_guarded: bool,
    /// The sign of the determinant there; zero where it is not told.
    side: i8,
}

/// Returns a row around another place.
fn around(row: &Conic, by: [f64; 2]) -> Conic {
    let one = row.one + dot(row.slope, by) + second(row, by);
    Conic { one, slope: slope(row, by), second: row.second }
}

/// Returns true if a row around a start tells as much of a place that is so far from there as one around that
/// place would: no part of the sum is larger than what its own numbers are rounded by.
fn says_enough(row: &Conic, there: &Conic, by: [f64; 2], at: [f64; 2]) -> bool {
    let [u, v] = by.map(f64::abs);
    let [uu, uv, vv] = row.second.map(f64::abs);
    let along = row.slope[0].abs() * u + row.slope[1].abs() * v;
    let parts = row.one.abs() + along + uu * u * u + uv * u * v + vv * v * v;
    parts <= size_of_numbers(there, at)
}

/// Where two rows hold.
enum Roots {
    None,
    One([f64; 2]),
    Two([[f64; 2]; 2]),
}

impl Roots {
    fn all(&self) -> &[[f64; 2]] {
        match self {
            Self::None => &[],
            Self::One(root) => std::slice::from_ref(root),
            Self::Two(roots) => roots,
        }
    }
}

/// Finds where both rows hold, from the state that they are around; nothing where that nearly is one place,
/// or the rows are nearly one.
fn roots(conics: &Conics) -> Option<Roots> {
    let [a, b] = conics.rows;
    // the line that both solutions lie on, and a curve that does too
    let largest = |row: &Conic| {
        let larger = |i: usize, than: usize| row.second[i].abs() > row.second[than].abs();
        (0..3).fold(0, |most, i| if larger(i, most) { i } else { most })
    };
    if [a, b].iter().all(|row| row.second == [0.0; 3]) {
        return newton(conics).map(Roots::One);
    }
    let at = if a.second == [0.0; 3] { largest(&b) } else { largest(&a) };
    let [p, q] = [b.second[at], a.second[at]];
    let by = |x: f64, y: f64| p * x - q * y;
    let (line, curve) = match (p == 0.0, q == 0.0) {
        (_, true) => (a, b),
        (true, false) => (b, a),
        (false, false) => {
            let slope = [0, 1].map(|i| by(a.slope[i], b.slope[i]));
            (Conic { one: by(a.one, b.one), slope, second: [0.0; 3] }, a)
        }
    };
    let n = norm(line.slope);
    let steepness = |row: &Conic| row.slope[0].abs().max(row.slope[1].abs());
    let whole = steepness(&a) * p.abs() + steepness(&b) * q.abs();
    if n <= FLAT * whole || n == 0.0 || !n.is_finite() {
        return None;
    }
    let normal = line.slope.map(|s| s / n);
    let (foot, way) = (normal.map(|c| -line.one / n * c), [-normal[1], normal[0]]);
    let place = |t: f64| [foot[0] + t * way[0], foot[1] + t * way[1]];
    // along the line, from its foot: square t² + slope t + one
    let square = second(&curve, way);
    let along = dot(slope(&curve, foot), way);
    let one = curve.one + dot(curve.slope, foot) + second(&curve, foot);
    let middle = -0.5 * along / square;
    let half = middle * middle - one / square;
    // how steep the curve is along the line where they meet, beside how steep it is across
    let rise = 4.0 * square * square * half;
    let steep = slope(&curve, place(middle));
    if !half.is_finite() || rise.abs() <= NEAR * NEAR * (dot(steep, steep) + rise.abs()) {
        return None;
    }
    if half < 0.0 {
        return Some(Roots::None);
    }
    let half = sqrt(half);
    Some(Roots::Two([place(middle + half), place(middle - half)]))
}

/// Returns what the second coefficients of a row make of a place.
fn second(row: &Conic, at: [f64; 2]) -> f64 {
    let [uu, uv, vv] = row.second;
    uu * at[0] * at[0] + uv * at[0] * at[1] + vv * at[1] * at[1]
}

/// Returns the slopes of a row at a place.
fn slope(row: &Conic, at: [f64; 2]) -> [f64; 2] {
    let [uu, uv, vv] = row.second;
    [row.slope[0] + 2.0 * uu * at[0] + uv * at[1], row.slope[1] + uv * at[0] + 2.0 * vv * at[1]]
}

/// Returns the determinant at a place.
fn determinant(conics: &Conics, at: [f64; 2]) -> f64 {
    let [a, b] = conics.rows.map(|row| slope(&row, at));
    cross(a, b)
}

/// Returns the sign of the determinant at the state that the rows are around, where that is told.
fn side(conics: &Conics) -> Option<f64> {
    let [a, b] = conics.rows.map(|row| row.slope);
    let determinant = cross(a, b);
    let told = determinant * determinant > FLAT * FLAT * dot(a, a) * dot(b, b);
    told.then(|| determinant.signum())
}

/// Returns true if a way to a solution bends so much that it has to be taken in several strides: the second
/// of Newton's steps would be more than half as long as the `first`.
fn bends(first: [f64; 2], root: [f64; 2], slots: [usize; 2], scales: &[f64]) -> bool {
    let off = size([root[0] - first[0], root[1] - first[1]], slots, scales);
    off > 0.5 * size(first, slots, scales) && off > 1e-7
}

/// Returns Newton's step from the state that the rows are around.
fn newton(conics: &Conics) -> Option<[f64; 2]> {
    let [a, b] = conics.rows;
    let determinant = cross(a.slope, b.slope);
    let step = [
        (b.one * a.slope[1] - a.one * b.slope[1]) / determinant,
        (a.one * b.slope[0] - b.one * a.slope[0]) / determinant,
    ];
    step.iter().all(|d| d.is_finite()).then_some(step)
}

/// Returns true if no row is off by more than its numbers are rounded.
fn is_rounding(conics: &Conics, at: [f64; 2]) -> bool {
    conics.rows.iter().all(|row| row.one.abs() <= ROUNDINGS * size_of_numbers(row, at))
}

/// Returns how large the numbers are that a row is a sum of, at the place that it is around.
fn size_of_numbers(row: &Conic, at: [f64; 2]) -> f64 {
    let slope = norm(row.slope);
    let second = row.second.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let radius = if second == 0.0 { 0.0 } else { 0.5 * slope / second };
    slope * (radius + at[0].abs() + at[1].abs())
}

/// Returns the larger part of a step, in scaled unknowns.
fn size(step: [f64; 2], slots: [usize; 2], scales: &[f64]) -> f64 {
    (step[0] / scales[slots[0]]).abs().max((step[1] / scales[slots[1]]).abs())
}
fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}
fn norm(a: [f64; 2]) -> f64 {
    sqrt(dot(a, a))
}
