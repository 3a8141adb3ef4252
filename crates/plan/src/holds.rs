//! Whether rules hold: both sides of every equation, computed from the values alone.

use crate::host::Host;
use crate::rule::{Body, ByHost, Condition, Formula, How, Rule, Source, When};
use kernel::{Structure, Values};
use solve::modes::is_true_within;
use solve::{Patterns, Scratch};

/// Returns true if the conditions of the rule are as they have to be for it to say anything.
pub(crate) fn counts(
    patterns: &Patterns,
    structure: &Structure,
    rule: Rule<'_>,
    values: &Values,
    host: &mut dyn Host,
    scratch: &mut Scratch,
) -> bool {
    let is_on = |when: &When| {
        let truth = match &when.condition {
            Condition::Numbers(formula) => {
                rule.evaluate(formula, patterns, &values.numbers, scratch)[0] != 0.0
            }
            // what cannot be computed is not so
            Condition::Host(by) => truth(structure, rule, by, values, host).unwrap_or(0.0) != 0.0,
        };
        truth == when.truth
    };
    rule.shape.when.iter().all(is_on)
}

/// Has the host compute whether a condition of a rule is true: 1, or 0.
pub(crate) fn truth(
    structure: &Structure,
    rule: Rule<'_>,
    by: &ByHost,
    values: &Values,
    host: &mut dyn Host,
) -> Result<f64, String> {
    match by.constraint_of(rule) {
        Some(constraint) => {
            host.number(structure.constraints[constraint as usize], by.side, values)
        }
        None => Err("no constraint says this".into()),
    }
}

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
    if !counts(patterns, structure, rule, values, host, scratch) {
        return None;
    }
    match &rule.shape.body {
        Body::Equations(equations) => {
            let mut worst = None;
            for e in equations {
                let sides = rule.evaluate(e, patterns, &values.numbers, scratch);
                let (left, right) = (sides[0], sides[1]);
                let arguments = rule.slots_at(&e.slots).map(|s| values.numbers[s]);
                let sway = || patterns.get(e.pattern).sway(arguments, scratch);
                if !rule.shape.within.is_met_with(left, right, sway) {
                    worst = larger(worst, Some((left - right).abs()));
                } else if !has_value(patterns, rule, e, values) {
                    worst = Some(f64::INFINITY);
                }
            }
            worst.map(Some)
        }
        Body::True(formula) => {
            let arguments: Vec<f64> =
                rule.slots_at(&formula.slots).map(|s| values.numbers[s]).collect();
            let pattern = patterns.get(formula.pattern);
            let (arena, root) = (pattern.arena(), pattern.roots()[0]);
            let holds = is_true_within(arena, root, &arguments, rule.shape.within)
                && pattern.has_value(arguments);
            (!holds).then_some(None)
        }
        Body::Different(formula) => {
            let mut all = rule.evaluate(formula, patterns, &values.numbers, scratch).to_vec();
            all.sort_by(f64::total_cmp);
            all.windows(2).any(|w| rule.shape.within.is_met(w[0], w[1])).then_some(None)
        }
        Body::Opaque(_) | Body::Beside(_) => {
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

/// Returns false where something in a formula has no value with these values, though the formula comes to one.
fn has_value(patterns: &Patterns, rule: Rule<'_>, formula: &Formula, values: &Values) -> bool {
    let arguments = rule.slots_at(&formula.slots).map(|s| values.numbers[s]);
    patterns.get(formula.pattern).has_value(arguments)
}

/// Returns the larger of two errors; one without a number is the smallest.
pub(crate) fn larger(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(if b > a || b.is_nan() { b } else { a }),
        (some, None) | (None, some) => some,
    }
}
