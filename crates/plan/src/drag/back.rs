//! Back: where a drag is let go that stands where a row is off.
//!
//! In: a press, where it came to. Out: where it stands, and all that held at the press holds. Near the end of its way
//! a row may be off by what the last digits leave open: the direction of a line that comes to nothing. The drag is
//! made anew then, at once, to a little before, so that it is not lost.

use super::Press;
use crate::component::{Component, rules_of};
use crate::host::Host;
use crate::planner::{Model, Planner, is_any_new};
use kernel::Values;

/// How far before the end of its way a drag ends instead, in parts of the way.
const BACK: [f64; 6] = [1e-6, 1e-3, 0.1, 0.25, 0.5, 0.75];

impl Planner {
    /// Drags anew to where everything holds, where a row is off that held at the press; to nowhere else if there is no such
    /// place.
    pub(super) fn step_back(
        &mut self,
        model: Model<'_>,
        press: &mut Press,
        start: &Values,
        values: &mut Values,
        host: &mut dyn Host,
    ) {
        let components: Vec<Component> =
            press.pulls.iter().map(|pull| pull.task.component.clone()).collect();
        let rules = rules_of(&components);
        let is_off = |planner: &Self, values: &Values, host: &mut dyn Host| {
            let unmet = planner.unmet(model, rules.iter().copied(), values, host);
            !unmet.is_empty() && {
                let was_unmet = planner.unmet(model, rules.iter().copied(), start, host);
                is_any_new(&unmet, &was_unmet)
            }
        };
        let numbers = |planner: &Self, values: &Values| -> Vec<f64> {
            let formulas = press.aim.wishes.iter().flat_map(|wish| &wish.formulas);
            formulas.map(|f| f.value(planner.plans.patterns(), &values.numbers)).collect()
        };
        let (from, to) = (numbers(self, start), numbers(self, values));
        let limit = values.clone();
        for part in BACK {
            if !is_off(self, values, host) {
                return;
            }
            let back = to.iter().zip(&from).map(|(to, from)| to + part * (from - to));
            // what it came through on its way is behind: it goes there at once
            *values = start.clone();
            *press = self.press_aim(model, start, press.aim.clone());
            self.drag(model, press, values, &back.collect::<Vec<_>>(), host);
        }
        if is_off(self, values, host) {
            *values = limit;
        }
    }
}
