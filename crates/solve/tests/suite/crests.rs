//! Places where a row has no slope though no branch ends there, as `q |q|` has none at nothing; and rows that
//! hold only infinitely far away.

use crate::builder::{Sheet, close};
use expr::Unary;
use solve::{NoHost, SlotIndex};

/// A number and its size, times a factor: how much pressure a flow takes.
fn turbulent(s: &mut Sheet, factor: f64, flow: SlotIndex) -> expr::ExprId {
    let q = s.v(flow);
    let size = s.arena.unary(Unary::Abs, q);
    let product = s.mul(q, size);
    let factor = s.c(factor);
    s.mul(factor, product)
}

/// A pipe: its pressure is ten times its flow times the size of that.
fn pipe(pressure: f64, flow: f64) -> (Sheet, [SlotIndex; 2]) {
    let mut s = Sheet::default();
    let (p, q) = (s.given(pressure), s.kept(flow));
    let (left, right) = (s.v(p), turbulent(&mut s, 10.0, q));
    s.require(left, right);
    (s, [p, q])
}

#[test]
fn a_flow_is_turned_round_whatever_it_was() {
    for (pressure, flow) in [(0.0, 0.0), (40.0, 2.0), (10.0, 1.0), (-40.0, -2.0)] {
        for (to, there) in
            [(-40.0, -2.0), (40.0, 2.0), (-39.0, -1.974_841_765_813_150_8), (0.1, 0.1)]
        {
            let (s, [p, q]) = pipe(pressure, flow);
            let (values, outcome, _) = s.set(&[(p, to)]);
            assert!(outcome.is_solved(), "{pressure} to {to}: {outcome:?}");
            close(values[q as usize], there, 1e-9);
        }
    }
}

#[test]
fn a_drag_goes_on_over_a_crest() {
    let (mut s, [p, q]) = pipe(40.0, 2.0);
    let inputs = s.wish(&[p]);
    let plan = s.plan();
    for frames in [1, 2, 3, 16] {
        let mut drag = s.drag(&plan, &inputs);
        for frame in 1..=frames {
            let to = 40.0 - 80.0 * f64::from(frame) / f64::from(frames);
            let outcome = drag.follow(&plan, &[to], &mut NoHost);
            assert!(outcome.is_solved() && outcome.unmet.is_empty(), "{frames}: {outcome:?}");
        }
        close(drag.values()[q as usize], -2.0, 1e-9);
    }
}

#[test]
fn two_pipes_begin_to_flow() {
    let mut s = Sheet::default();
    let total = s.given(0.0);
    let [first, second, pressure] = [0.0; 3].map(|v| s.kept(v));
    let (sum, all) = {
        let (a, b) = (s.v(first), s.v(second));
        (s.add(a, b), s.v(total))
    };
    s.require(sum, all);
    for (factor, flow) in [(2.0, first), (8.0, second)] {
        let (left, right) = (s.v(pressure), turbulent(&mut s, factor, flow));
        s.require(left, right);
    }
    let (values, outcome, _) = s.set(&[(total, 3.0)]);
    assert!(outcome.is_solved(), "{outcome:?}");
    close(values[first as usize], 2.0, 1e-9);
    close(values[second as usize], 1.0, 1e-9);
    close(values[pressure as usize], 8.0, 1e-9);
}

#[test]
fn what_holds_only_infinitely_far_away_is_refused() {
    let mut s = Sheet::default();
    let (voltage, resistance, current) = (s.fixed(5.0), s.kept(1000.0), s.given(0.005));
    let (left, volts, ohms) = (s.v(current), s.v(voltage), s.v(resistance));
    let right = s.div(volts, ohms);
    s.require(left, right);
    let (values, outcome, _) = s.set(&[(current, 0.0)]);
    assert!(!outcome.is_solved(), "{values:?}");
    assert_eq!(values[resistance as usize].to_bits(), 1000.0_f64.to_bits());
}
