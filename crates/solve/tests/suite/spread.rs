//! Numbers of other orders of magnitude beside one another.

use crate::builder::{Sheet, close};
use solve::SlotIndex;

/// A principal, a rate and `principal * rate^2 - 3.5e-3 * principal = rest`, as it opens.
fn interest(principal: f64) -> (Sheet, [SlotIndex; 3]) {
    let mut s = Sheet::default();
    let [capital, rate] = [principal, 0.06].map(|value| s.given(value));
    let rest = s.kept(1e-4 * principal);
    let (a, b, c) = (s.v(capital), s.v(rate), s.v(rest));
    let cost = s.c(3.5e-3 * principal);
    let square = s.mul(b, b);
    let interest = s.mul(a, square);
    let left = s.sub(interest, cost);
    s.require(left, c);
    (s, [capital, rate, rest])
}

#[test]
fn a_small_given_number_beside_a_large_one_changes_as_little_as_it_has_to() {
    for principal in [1e3, 1e6, 1e9, 1e12] {
        let (s, [capital, rate, rest]) = interest(principal);
        let (values, outcome, _) = s.set(&[(rest, 1.005e-4 * principal)]);
        assert!(outcome.is_solved(), "{principal}: {outcome:?}");
        // of a large principal next to nothing moves: its slope is 2e-6 / principal of the rate's
        close(values[capital as usize] / principal, 1.0, 1e-9);
        let wanted = base::number::sqrt(3.6005e-3);
        close(values[rate as usize], wanted, 1e-9 * wanted + 1e-8 / principal);
    }
}

#[test]
fn a_small_computed_number_beside_a_large_one_changes_as_little_as_it_has_to() {
    // the same of numbers that are not given: x * y^2 = z, x a million times as large
    let mut s = Sheet::default();
    let [x, y, z] = [1e6, 0.06, 3600.0].map(|value| s.kept(value));
    let (a, b, c) = (s.v(x), s.v(y), s.v(z));
    let square = s.mul(b, b);
    let product = s.mul(a, square);
    s.require(product, c);
    let (values, outcome, _) = s.set(&[(z, 3600.5)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    close(values[x as usize], 1e6, 1e-6);
    close(values[y as usize], base::number::sqrt(3600.5e-6), 1e-12);
}
