//! What an edit comes to otherwise, from where it began: with what its plan holds let go, or with places kept apart that
//! came together.

use super::{Adapter, Ground, Ran, by_course, leans, put_texts, scatter};
use crate::host::Host;
use crate::modal::Stands;
use crate::planner::{Model, Planner};
use crate::task::restated::LETTING_GO;
use crate::task::{Course, Task};
use crate::vanish::{Vanished, shrinking, vanished};
use base::number::close;
use kernel::{SlotId, Values};

/// So often others come together where some are kept apart, at most.
const ROUNDS: usize = 4;

/// Lets the computed numbers go that the plan holds, and then the places, where an edit came to no end with them held.
pub(super) fn or_letting_go(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    ran: Ran,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    if !ran.is_refused() || ground.changed.is_empty() {
        return ran;
    }
    letting_go(planner, model, task, ground, values, host).unwrap_or(ran)
}

/// The same from wherever it came to; nothing, and all is as it was, where it comes to no end so either.
fn letting_go(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    values: &mut Values,
    host: &mut dyn Host,
) -> Option<Ran> {
    let texts = values.texts.clone();
    let numbers: Vec<f64> = task.numbers(&values.numbers).collect();
    let mut free = task.letting_go(&planner.plans);
    while let Some(own) = free {
        put_texts(&ground.texts, values);
        let mut found = by_course(planner, model, &own, ground, values, host);
        if found.is_solved {
            found.stands = found.stands.and_then(|stands| task.stands_as(planner, &stands));
            return Some(found);
        }
        values.texts.clone_from(&texts);
        scatter(task, &numbers, values);
        free = own.letting_go(&planner.plans);
    }
    None
}

/// Goes there at once where several things were set together and the straight way from what they were does not lead
/// there: others may, and what is asked for is where they end.
pub(super) fn or_at_once(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    ran: Ran,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    if !ran.is_refused() || !matches!(task.course, Course::Plan) {
        return ran;
    }
    let Ground { x0, local: began, changed, .. } = ground;
    let mut runner = planner.take_runner(leans(model, task));
    let mut local = began.clone();
    let mut adapter = Adapter { planner, model, task, values, host };
    let outcome = solve::leap(&task.plan, &mut runner, x0, &mut local, changed, &mut adapter);
    planner.put_back(runner);
    if !outcome.is_solved() {
        return ran;
    }
    scatter(task, &local, values);
    super::ran(planner, task, &outcome)
}

/// Has places stay apart that came together, where the answer holds by that alone: what has no answer then has none.
/// Where it may, or they come together where an edit is refused, others are asked for: what lets go, then places that
/// stay apart. If there is none it stands as it was.
pub(super) fn or_kept_apart(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    ground: &Ground,
    ran: Ran,
    values: &mut Values,
    host: &mut dyn Host,
) -> Ran {
    let plan = ran.stands.as_ref().map_or(&task.plan, Stands::plan);
    let is_small = task.component.slots().len() <= LETTING_GO;
    if !(plan.is_curved() || is_small && plan.speaks_of_bends()) {
        return ran;
    }
    let slots = task.component.slots();
    let is_set =
        |slot: SlotId| ground.changed.iter().any(|&at| slots.get(at as usize) == Some(&slot));
    let from: (&[f64], &dyn Fn(SlotId) -> bool) = (&ground.x0, &is_set);
    let together = match &ran.limit {
        _ if ran.is_solved => vanished(planner, model, task, from, values, host),
        Some(limit) if ran.is_refused() => shrinking(planner, task, from, limit),
        Some(_) | None => None,
    };
    let Some(together) = together.filter(|t| t.is_none || !ground.changed.is_empty()) else {
        return ran;
    };
    let texts = values.texts.clone();
    let numbers: Vec<f64> = task.numbers(&values.numbers).collect();
    // given numbers do not yield for a line to have a direction
    let are_given_kept = |values: &Values| {
        let was = task.system.slots.iter().zip(&numbers).zip(task.numbers(&values.numbers));
        was.into_iter().all(|((slot, was), is)| !slot.stay.is_given() || close(*was, is))
    };
    if ran.is_solved && !together.is_none {
        if let Some(found) = letting_go(planner, model, task, ground, values, host)
            && vanished(planner, model, task, from, values, host).is_none()
            && are_given_kept(values)
        {
            return found;
        }
        scatter(task, &numbers, values);
    }
    let Ground { x0, local, texts: before, changed } = ground;
    let mut pairs = together.pairs;
    for _ in 0..ROUNDS {
        let Some(kept) = task.kept_apart(&pairs, &planner.plans) else { break };
        let with_apart = |all: &[f64]| {
            let apart = pairs.iter().map(|pair| pair.apart);
            all.iter().copied().chain(apart).collect()
        };
        let [x0, local] = [x0, local].map(|all| with_apart(all));
        let own = Ground { x0, local, texts: before.clone(), changed: changed.clone() };
        put_texts(&ground.texts, values);
        let found = by_course(planner, model, &kept, &own, values, host);
        let mut found = or_letting_go(planner, model, &kept, &own, found, values, host);
        found.stands = found.stands.and_then(|stands| task.stands_as(planner, &stands));
        if together.is_none {
            return found;
        }
        if !found.is_solved || found.is_missed || !are_given_kept(values) {
            break;
        }
        // others may come together instead
        let Some(others) = vanished(planner, model, task, from, values, host) else { return found };
        let known = pairs.len();
        let is_new = |pair: &Vanished| pairs.iter().all(|known| known.slots != pair.slots);
        let others: Vec<Vanished> = others.pairs.into_iter().filter(is_new).collect();
        pairs.extend(others);
        scatter(task, &numbers, values);
        if pairs.len() == known {
            break;
        }
    }
    values.texts = texts;
    scatter(task, &numbers, values);
    ran
}
