//! Random linear systems against a dense reference; random chains.

use crate::builder::{Sheet, bits, close};
use proptest::prelude::*;
use solve::{Level, NoHost};

/// Solves a dense system by elimination with full pivoting, written apart from the solver's.
fn reference(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Option<Vec<f64>> {
    let n = b.len();
    let mut columns: Vec<usize> = (0..n).collect();
    for k in 0..n {
        let mut best = (k, k);
        for i in k..n {
            for j in k..n {
                if a[i][j].abs() > a[best.0][best.1].abs() {
                    best = (i, j);
                }
            }
        }
        if a[best.0][best.1].abs() < 1e-6 {
            return None;
        }
        a.swap(k, best.0);
        b.swap(k, best.0);
        for row in &mut a {
            row.swap(k, best.1);
        }
        columns.swap(k, best.1);
        for i in 0..n {
            if i != k {
                let factor = a[i][k] / a[k][k];
                let pivot = a[k].clone();
                for (entry, by) in a[i].iter_mut().zip(&pivot).skip(k) {
                    *entry -= factor * by;
                }
                b[i] -= factor * b[k];
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in 0..n {
        x[columns[k]] = b[k] / a[k][k];
    }
    Some(x)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn square_linear_systems_agree_with_elimination(
        entries in prop::collection::vec(prop::collection::vec(-3i32..=3, 5), 5),
        right in prop::collection::vec(-9i32..=9, 5),
    ) {
        let a: Vec<Vec<f64>> =
            entries.iter().map(|r| r.iter().map(|&v| f64::from(v)).collect()).collect();
        let b: Vec<f64> = right.iter().map(|&v| f64::from(v)).collect();
        let Some(expected) = reference(a.clone(), b.clone()) else { return Ok(()) };
        let mut s = Sheet::default();
        let slots: Vec<u32> = (0..5).map(|_| s.free(0.0)).collect();
        for (row, &value) in a.iter().zip(&b) {
            let mut sum = s.c(0.0);
            for (&slot, &factor) in slots.iter().zip(row) {
                let (v, f) = (s.v(slot), s.c(factor));
                let term = s.mul(f, v);
                sum = s.add(sum, term);
            }
            let value = s.c(value);
            s.relate(Level::Required, &[(sum, value)]);
        }
        s.open();
        for (&slot, &x) in slots.iter().zip(&expected) {
            close(s.x0[slot as usize], x, 1e-7 * x.abs().max(1.0));
        }
        let plan = s.plan();
        prop_assert_eq!(bits(&s.run(&plan, &[], &mut NoHost).0), bits(&s.x0));
    }

    #[test]
    fn trees_of_sums_and_products_hold_after_every_edit(
        kinds in prop::collection::vec(0u8..3, 1..12),
        targets in prop::collection::vec((0usize..8, 1i32..20), 1..6),
    ) {
        let mut s = Sheet::default();
        let mut slots = vec![s.kept(2.0)];
        for (k, kind) in kinds.iter().enumerate() {
            let other = s.kept(1.5 + k as f64);
            let out = s.free(0.0);
            let (a, b, c) = (s.v(slots[k % slots.len()]), s.v(other), s.v(out));
            let made = match kind {
                0 => s.add(a, b),
                1 => s.mul(a, b),
                _ => s.sub(a, b),
            };
            s.require(made, c);
            slots.extend([other, out]);
        }
        s.open();
        for (at, value) in targets {
            let slot = slots[at % slots.len()];
            let (values, outcome, _) = s.set(&[(slot, f64::from(value))]);
            if outcome.is_solved() {
                prop_assert!(outcome.unmet.is_empty());
                prop_assert_eq!(values[slot as usize], f64::from(value));
                s.x0 = values;
            } else {
                prop_assert_eq!(values[slot as usize], f64::from(value));
            }
        }
    }
}
