//! Whether rules hold: both sides of every equation, computed from the values alone.

use crate::host::Host;
use crate::rule::{Body, How, Rule, Source};
use kernel::{Structure, Values};
use solve::{Patterns, Scratch};

/// Returns nothing if the rule holds, else its error, where it has one.
///
/// A declared stay always holds: it only says what was.
pub(crate) fn fails(
    patterns: &Patterns,
    structure: &Structure,
    rule: Rule<'_>,
    values: &Values,
    host: &mut dyn Host,
    scratch: &mut Scratch,
) -> Option<Option<f64>> {
    match &rule.shape.body {
        Body::Equations(equations) => {
            let mut worst = None;
            for e in equations {
                let sides = rule.evaluate(e, patterns, &values.numbers, scratch);
                let (left, right) = (sides[0], sides[1]);
                if !agree(left, right, rule.shape.within) {
                    worst = larger(worst, Some((left - right).abs()));
                }
            }
            worst.map(Some)
        }
        Body::Opaque(_) => {
            let holds = match (rule.shape.methods.as_slice(), rule.source) {
                ([copy, ..], _) if matches!(copy.how, How::Copy) => {
                    let slot = |position: u32| values.get(rule.slots[position as usize]);
                    slot(copy.targets[0]).same_bits(&slot(copy.reads[0]))
                }
                (_, Source::Constraint(c)) => host.holds(structure.constraints[c as usize], values),
                (_, Source::Stay(_) | Source::Wish(_)) => true,
            };
            (!holds).then_some(None)
        }
        Body::Hold(_) => None,
    }
}

/// Returns true if two sides agree to `within` of the larger, at least of the unit.
pub(crate) fn agree(left: f64, right: f64, within: f64) -> bool {
    left == right || (left - right).abs() <= within * left.abs().max(right.abs()).max(1.0)
}

/// Returns the larger of two errors; one without a number is the smallest.
pub(crate) fn larger(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b > a || b.is_nan() { b } else { a }),
        (some, None) | (None, some) => some,
    }
}
