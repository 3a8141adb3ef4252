//! Second order: what rows say of motions where they depend on one another only here, as where curves touch.
//!
//! In: rows at a state, the sums of them that vanish, the motions that they leave to first order. A sum `λ` of the
//! rows has no slope, `λJ = 0`; along a motion `d` that goes on, the others follow by some `e` to second order,
//! and `½ dᵀ(λH)d + λJe = 0` leaves `dᵀ(λH)d = 0`. Where that form is bent one way, as that of curves that touch is,
//! it vanishes only where `λH d` has no part in what is free. Out: these equations, over the free columns: what is
//! left beside them goes on. Where a form is bent both ways branches meet, and they say too much.
//!
//! **Source:** Connelly and Whiteley, *Second-order rigidity and prestress stability for tensegrity frameworks*, SIAM
//! J. Discrete Math. 9 (1996), §3.

use solve::echelon::{Row, Vanishing};

/// Numbers below this, in parts of the largest, are none: second derivatives are found by differences.
const NONE: f64 = 1e-6;

/// Returns the equations over the free motions, independent of one another.
///
/// `motions` are the free motions, each with its column; `turned` returns the rows of a sum, so much of each, by
/// how much their slopes change along a motion: over all columns. A sum comes with how large its slopes are.
pub(crate) fn equations(
    motions: &[(u32, Row)],
    sums: &[(Vanishing, f64)],
    mut turned: impl FnMut(&Vanishing, &Row) -> Row,
) -> Vec<Row> {
    let mut reduced: Vec<Row> = Vec::new();
    for (sum, size) in sums {
        let mut form: Vec<Vec<f64>> = motions
            .iter()
            .map(|(_, motion)| {
                let turned = turned(sum, motion);
                motions.iter().map(|(_, other)| along(&turned, other)).collect()
            })
            .collect();
        let entries = form.iter().flatten().map(|x| x.abs());
        let least = NONE * entries.fold(*size, f64::max);
        eliminate(&mut form, least);
        for row in form {
            let row = row.into_iter().zip(motions).filter(|(x, _)| x.abs() > NONE);
            let row: Row = row.map(|(x, (column, _))| (*column, x)).collect();
            if !row.is_empty() {
                reduced.push(row);
            }
        }
    }
    reduced
}

/// Returns the sum of the products of what two rows have in the same columns.
fn along(a: &Row, b: &Row) -> f64 {
    let own = |c: u32| b.binary_search_by_key(&c, |e| e.0).map_or(0.0, |at| b[at].1);
    a.iter().map(|&(c, x)| x * own(c)).sum()
}

/// Brings rows into reduced form, each with a pivot of one; what is smaller than `least` is nothing.
fn eliminate(rows: &mut Vec<Vec<f64>>, least: f64) {
    let mut done = 0;
    loop {
        let mut best = (least, None);
        for (r, row) in rows.iter().enumerate().skip(done) {
            for (c, x) in row.iter().enumerate() {
                if x.abs() > best.0 {
                    best = (x.abs(), Some((r, c)));
                }
            }
        }
        let Some((r, c)) = best.1 else { break };
        rows.swap(done, r);
        let pivot = rows[done][c];
        rows[done].iter_mut().for_each(|x| *x /= pivot);
        let own = rows[done].clone();
        for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != done) {
            let factor = row[c];
            row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
        }
        done += 1;
    }
    rows.truncate(done);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_leaves_what_makes_it_nothing() {
        // (y - 3/8 x)², whose second derivatives are 9/32, -3/4 and 2
        let motions = [(4, vec![(4, 1.0)]), (7, vec![(7, 1.0)])];
        let sum = Vanishing { last: 0, sum: vec![(0, 1.0)] };
        let turned = |_: &Vanishing, motion: &Row| match motion[0].0 {
            4 => vec![(4, 9.0 / 32.0), (7, -0.75)],
            _ => vec![(4, -0.75), (7, 2.0)],
        };
        let found = equations(&motions, &[(sum, 1.0)], turned);
        assert_eq!(found, [vec![(4, -0.375), (7, 1.0)]]);
    }
}
