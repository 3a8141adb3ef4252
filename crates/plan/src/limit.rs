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
const WORK: u64 = 200_000_000;
/// What one trial may cost: near its end a way is hard to tell from one that goes on.
const TRIAL: u64 = WORK / 10;
/// With more slots than this a limit is not looked for: every trial is a whole edit.
const LARGEST: usize = 20_000;

/// How far towards its values a refused edit could have gone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limit {
    /// As a part of the way.
    pub part: f64,
    /// What there is.
    pub kind: LimitKind,
}

/// What there is where an edit could have gone no further.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum LimitKind {
    /// The last value that could be had.
    Last,
    /// One that cannot be had, though one comes as near to it as one likes: as the zero of a logarithm.
    Open,
    /// One that can be had; how much further it goes was too dear to find out.
    AtLeast,
}

/// What came of a part of the way.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Trial {
    /// It can be gone.
    Gone,
    /// It cannot.
    Stopped,
    /// It was given up.
    Cut,
}

impl Planner {
    /// Returns how far towards its values a refused edit could go; nothing where it cannot move at all, speaks of
    /// more than real numbers, or not even a part of the way was seen to be possible in the time there is.
    ///
    /// By bisection; each trial is a whole edit from the present values, so that what is told can be
    /// set. `was_unmet` are the constraints that do not hold now. Cost: up to 35 such edits, of
    /// which none may take long.
    pub(crate) fn limit(
        &self,
        model: Model<'_>,
        values: &Values,
        aim: &Aim,
        tasks: &[Task],
        was_unmet: &[Unmet],
        host: &mut dyn Host,
    ) -> Option<Limit> {
        let is_real = |&s: &_| matches!(model.structure.slots[s].primitive, Primitive::Real(_));
        let size: usize = tasks.iter().map(|t| t.component.slots().len()).sum();
        if size > LARGEST || !aim.fixed.keys().all(is_real) {
            return None;
        }
        let until = self.spent() + WORK;
        let mut trial = |at: &Aim| {
            let mut came = values.clone();
            for (&slot, value) in &at.fixed {
                came.put(slot, value.clone());
            }
            let most = self.spent() + TRIAL;
            self.try_until(Some(most));
            for task in tasks {
                run(self, model, task, at, values, &mut came, host);
            }
            self.try_until(None);
            let is_cut = self.spent() >= most;
            let rules = tasks.iter().flat_map(|t| t.component.rules().iter().copied());
            let unmet = self.unmet(model, rules, &came, host);
            match !is_any_new(&unmet, was_unmet) && self.reached(at, &came) {
                true => Trial::Gone,
                false if is_cut => Trial::Cut,
                false => Trial::Stopped,
            }
        };
        // what is known of the least part that was not gone
        let (mut gone, mut beyond, mut end) = (0.0, 1.0, Trial::Stopped);
        for halving in 0..HALVINGS {
            if self.spent() > until {
                return (gone > 0.0).then_some(Limit { part: gone, kind: LimitKind::AtLeast });
            }
            if halving == NOTHING && gone == 0.0 {
                let can_go_back = trial(&self.part_of_the_way(values, aim, BACK)) == Trial::Gone;
                let is_last = can_go_back && end == Trial::Stopped;
                return is_last.then_some(Limit { part: 0.0, kind: LimitKind::Last });
            }
            let part = 0.5 * (gone + beyond);
            match trial(&self.part_of_the_way(values, aim, part)) {
                Trial::Gone => gone = part,
                why @ (Trial::Stopped | Trial::Cut) => (beyond, end) = (part, why),
            }
        }
        // where every part of the way can be gone, no limit stands in it
        if beyond == 1.0 {
            return None;
        }
        let beside = beside(values, aim, gone).map(|at| trial(&at));
        let kind = match (end, beside) {
            (Trial::Cut, _) | (_, Some(Trial::Cut)) => LimitKind::AtLeast,
            (_, Some(Trial::Stopped)) => LimitKind::Open,
            (_, Some(Trial::Gone) | None) => LimitKind::Last,
        };
        Some(Limit { part: gone, kind })
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

/// Returns the aim at the round number that a number comes to next to where it can go, if there is one a little
/// beyond.
fn beside(values: &Values, aim: &Aim, gone: f64) -> Option<Aim> {
    /// How many digits of the way a round number has, and how near it has to be, as a part of the way.
    const DIGITS: f64 = 6.0;
    const NEAR: f64 = 1e-8;
    let mut fixed = aim.fixed.iter();
    let (Some((&slot, Value::Number(wanted))), None) = (fixed.next(), fixed.next()) else {
        return None;
    };
    let from = values.numbers[slot];
    let (way, at) = (wanted - from, between(from, *wanted, gone));
    let digits = (base::number::ln(way.abs()) / base::number::ln(10.0)).floor() - DIGITS;
    let step = base::number::pow(10.0, digits);
    let round = (at / step).round() * step + 0.0;
    let ahead = (round - at) / way;
    let is_beside = aim.wishes.is_empty() && ahead > 0.0 && ahead <= NEAR;
    is_beside.then(|| {
        let mut beside = aim.clone();
        beside.fixed.insert(slot, Value::Number(round));
        beside
    })
}

fn between(from: f64, to: f64, part: f64) -> f64 {
    from + (to - from) * part + 0.0
}
