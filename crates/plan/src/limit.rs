//! Limits: how far towards its values an edit could have gone that was refused.

use crate::aim::Aim;
use crate::host::Host;
use crate::planner::{Model, Planner, Unmet, is_any_new};
use crate::run::run;
use crate::task::Task;
use kernel::{Primitive, Value, Values};

/// How often a way is halved: the limit is known to this power of two of it.
const HALVINGS: u32 = 34;
/// After so many halvings a limit is taken to be where the edit began.
const NOTHING: u32 = 14;
/// A step back, as a part of the way: it can be gone where the edit began at its limit.
const BACK: f64 = -1.0 / 1024.0;
/// After so many multiplications, roughly, it is given up: a refusal is wanted at once.
const WORK: u64 = 100_000_000;
/// With more slots than this a limit is not looked for: every trial is a whole edit.
const LARGEST: usize = 20_000;

impl Planner {
    /// Returns how far towards its values a refused edit could go, as a part of the way; nothing
    /// where it cannot move at all, speaks of more than real numbers, or would take too long.
    ///
    /// By bisection; each trial is a whole edit from the present values, so that what is told can be
    /// set. `was_unmet` are the constraints that do not hold now. Cost: up to 35 such edits.
    pub(crate) fn limit(
        &self,
        model: Model<'_>,
        values: &Values,
        aim: &Aim,
        tasks: &[Task],
        was_unmet: &[Unmet],
        host: &mut dyn Host,
    ) -> Option<f64> {
        let is_real = |&s: &_| matches!(model.structure.slots[s].primitive, Primitive::Real(_));
        let size: usize = tasks.iter().map(|t| t.component.slots().len()).sum();
        if size > LARGEST || !aim.fixed.keys().all(is_real) {
            return None;
        }
        let until = self.spent() + WORK;
        let mut can_go = |part: f64| {
            let at = self.part_of_the_way(values, aim, part);
            let mut trial = values.clone();
            for (&slot, value) in &at.fixed {
                trial.put(slot, value.clone());
            }
            // one that takes longer than there is goes nowhere
            self.try_until(Some(until));
            for task in tasks {
                run(self, model, task, &at, values, &mut trial, host);
            }
            self.try_until(None);
            let rules = tasks.iter().flat_map(|t| t.component.rules().iter().copied());
            let unmet = self.unmet(model, rules, &trial, host);
            !is_any_new(&unmet, was_unmet) && self.reached(&at, &trial)
        };
        let (mut gone, mut beyond) = (0.0, 1.0);
        for halving in 0..HALVINGS {
            if self.spent() > until {
                return None;
            }
            if halving == NOTHING && gone == 0.0 {
                return can_go(BACK).then_some(0.0);
            }
            let part = 0.5 * (gone + beyond);
            if can_go(part) {
                gone = part;
            } else {
                beyond = part;
            }
        }
        // where every part of the way can be gone, no limit stands in it
        (beyond < 1.0).then_some(gone)
    }

    /// Returns an aim that goes a part of the way.
    fn part_of_the_way(&self, values: &Values, aim: &Aim, part: f64) -> Aim {
        let mut at = aim.clone();
        for (&slot, wanted) in &mut at.fixed {
            if let Value::Number(x) = wanted {
                *x = between(values.numbers[slot], *x, part);
            }
        }
        for (wish, wanted) in at.wishes.iter().zip(&mut at.wanted) {
            for (formula, x) in wish.formulas.iter().zip(wanted) {
                let now = formula.value(self.plans.patterns(), &values.numbers);
                *x = between(now, *x, part);
            }
        }
        at
    }
}

fn between(from: f64, to: f64, part: f64) -> f64 {
    from + (to - from) * part + 0.0
}
