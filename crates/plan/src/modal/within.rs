//! Within bounds: the plan of a mode is run so that inequalities hold without acting, where it has roots and sides with
//! which they do.

use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::run::{Adapter, Ground};
use crate::task::Task;
use kernel::Values;
use solve::{Lean, Mode, Modes, Plan, Tried};
use std::cmp::Ordering;

/// How many other states are looked at where the first breaks an inequality.
const MOST_OTHERS: usize = 16;

/// Runs the plan of a mode from where an edit began, given numbers held where that comes to an end. What opens
/// takes the roots with which the inequalities hold without acting, and conditions are as they are assumed,
/// where there are such; they are looked for from the bounds as well where given numbers would yield to these.
#[expect(clippy::too_many_arguments, reason = "an attempt is all of these")]
pub(crate) fn attempt_in_mode(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    modes: &Modes,
    mode: &Mode,
    ground: &Ground,
    leans: &[Lean],
    values: &mut Values,
    host: &mut dyn Host,
) -> Tried {
    let (system, mut plan) = planner.in_mode(modes, mode);
    let Ground { x0, changed, .. } = ground;
    // how many inequalities a state breaks, and whether a condition is otherwise than assumed
    let amiss =
        |values: &[f64]| (modes.broken(mode, values).len(), modes.contradicts(mode, values));
    let is_within = |values: &[f64]| amiss(values) == (0, false);
    let mut adapter = Adapter { planner, model, task, values, host };
    let mut leans = leans.to_vec();
    leans.extend(within_bounds(modes, mode, &plan, x0, &leans));
    let mut runner = planner.take_runner(leans.clone());
    let mut by_plan = |plan: &Plan| {
        let mut local = ground.local.clone();
        let outcome = solve::run(plan, &mut runner, x0, &mut local, changed, &mut adapter);
        (outcome, local)
    };
    // rows that depend on others here, though not at a generic point, free no given number
    let held = planner.plans.with_given_held(&system, &plan).and_then(|held| {
        let (outcome, local) = by_plan(&held);
        let is_met = outcome.is_solved() && outcome.unmet.is_empty() && is_within(&local);
        is_met.then_some((held, outcome, local))
    });
    let (outcome, mut local) = match held {
        Some((held, outcome, local)) => {
            plan = held;
            (outcome, local)
        }
        None => by_plan(&plan),
    };
    planner.put_back(runner);
    if outcome.is_solved() && plan.is_curved() && changed.is_empty() && !is_within(&local) {
        // one step after another takes another root, as long as less is amiss with it
        let other = |beside: Option<&[f64]>, adapter: &mut Adapter<'_>| {
            let at_first = amiss(&local);
            let (mut least, mut state) = (at_first, local.clone());
            loop {
                let others = solve::others(&plan, &state, beside, MOST_OTHERS, adapter);
                let others = others.into_iter().map(|other| (amiss(&other.values), other.values));
                match others.min_by_key(|other| other.0).filter(|other| other.0 < least) {
                    Some(less) => (least, state) = less,
                    // what another condition allows is found in a mode in which it is assumed
                    None => return (least.0 == 0 && least < at_first).then_some(state),
                }
            }
        };
        let mut found = other(None, &mut adapter);
        // nor does a given number yield to a bound that has a root on its other side, nor does nothing hold then
        if found.is_none()
            && let Some(bounded) = modes.with_broken(mode, &local)
            && let (_, bounded) = planner.in_mode(modes, &bounded)
        {
            let mut beside = ground.local.clone();
            let mut runner = planner.take_runner(leans);
            let at_bound =
                solve::run(&bounded, &mut runner, x0, &mut beside, changed, &mut adapter);
            planner.put_back(runner);
            let yields = bounded.yields() > plan.yields();
            if yields || !at_bound.is_solved() || !at_bound.unmet.is_empty() {
                found = other(Some(&beside), &mut adapter);
            }
        }
        local = found.unwrap_or(local);
    }
    Tried { plan, outcome, values: local }
}

/// Returns which way blocks lean in which two branches meet, where an inequality that is at its bound holds one
/// way alone, and nothing else is written.
pub(super) fn within_bounds(
    modes: &Modes,
    mode: &Mode,
    plan: &Plan,
    x0: &[f64],
    written: &[Lean],
) -> Vec<Lean> {
    if modes.at_bounds(mode, x0).active.is_empty() {
        return Vec::new();
    }
    let broken = |state: &[f64]| modes.broken(mode, state).len();
    let forks = solve::forks(plan, x0).into_iter();
    let open = forks.filter(|[(lean, _), _]| written.iter().all(|w| w.slot != lean.slot));
    let held = open.filter_map(|[more, less]| match broken(&more.1).cmp(&broken(&less.1)) {
        Ordering::Less => Some(more.0),
        Ordering::Greater => Some(less.0),
        Ordering::Equal => None,
    });
    held.collect()
}
