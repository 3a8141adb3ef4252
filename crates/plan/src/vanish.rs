//! What vanishes: an answer in which rows hold only because two places that they speak of have come together, as a
//! line without length is parallel to any, while others have no value where they are one.
//!
//! In: what a run came to. Out: which places came together so, and whether that is sure. It is by two signs. A row
//! that speaks of both is off by a part of what the way between them comes to in it, larger than rounding leaves: it
//! holds because that is nearly nothing. And where the places are one, a row of the component has no value, or quite
//! another. Where least change alone brought them together it is not: the rows that speak of both say something else on
//! every side of where they are one, as an angle does, or nothing, where with the others they leave no direction. Then
//! another answer is better where there is one.

use crate::component::Component;
use crate::holds::counts;
use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::rule::{Body, Rule};
use crate::task::Task;
use base::number::hypot;
use kernel::{SlotId, Values};
use solve::{Level, Scratch, SlotIndex};

/// Places have come together where this part of the way between them is left.
const LEFT: f64 = 1e-6;
/// The same where an answer in which they stay apart is asked for, and where they are on the way to an end of it.
const SHRUNK: f64 = 1e-3;
const SHRINKING: f64 = 0.1;
/// How far one place is put from the other to see what rows say on each side, in parts of the former way, and how
/// nearly two of them may say the same.
const ASIDE: f64 = 1e-7;
const ALIKE: f64 = 1e-6;
/// What is off by less than this part of what it comes to where places are apart says nothing where they are one.
const NOTHING: f64 = 1e-9;
/// What is off by more than this part of what the way between two places comes to in it does not hold by itself.
const UNDONE: f64 = 1e-5;
/// What a row changes by where places are one, more than this part of its sides and so many times the way between
/// them, tells them apart.
const PART: f64 = 1e-3;
const STEEP: f64 = 1e4;
/// So many places of a rule at most are looked at.
const MOST: usize = 8;

/// Two places that came together.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Vanished {
    /// The rule that speaks of both, by its position in the component.
    pub(crate) position: u32,
    /// The coordinates of the first, then of the other.
    pub(crate) slots: [SlotId; 4],
    /// How far they were from each other.
    pub(crate) apart: f64,
}

impl Vanished {
    fn now(&self, values: &Values) -> f64 {
        apart(self.slots, values)
    }
}

/// Two places that a rule speaks of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair {
    /// The rule, by its position in the component.
    position: u32,
    /// The coordinates of the first, then of the other, as slots of the component.
    slots: [SlotIndex; 4],
}

/// Places that came together.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Together {
    pub(crate) pairs: Vec<Vanished>,
    /// True if rows hold by that alone: it is no answer.
    pub(crate) is_none: bool,
}

/// Returns how far the one place is from the other, squared.
fn squared([x1, y1, x2, y2]: [f64; 4]) -> f64 {
    let [dx, dy] = [x2 - x1, y2 - y1];
    dx * dx + dy * dy
}

fn apart([x1, y1, x2, y2]: [SlotId; 4], values: &Values) -> f64 {
    let x = &values.numbers;
    hypot(x[x2] - x[x1], x[y2] - x[y1])
}

/// Returns the places that came together between two states of a task, where the rows hold by that or may. `x0` is
/// the first of these states, in the slots of the system. A place of which something is set
/// is where it shall be.
pub(crate) fn vanished(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    (x0, is_set): (&[f64], &dyn Fn(SlotId) -> bool),
    values: &Values,
    host: &mut dyn Host,
) -> Option<Together> {
    let known = task.component.slots();
    let now = |slot: SlotIndex| values.numbers[known[slot as usize]];
    let shrunk = nearer(planner, task, x0, now, SHRUNK);
    if shrunk.is_empty() {
        return None;
    }
    let mut scratch = Scratch::default();
    let is_left = |pair: &&Vanished| pair.now(values) < LEFT * pair.apart;
    let mut pairs: Vec<Vanished> = Vec::new();
    for pair in shrunk.iter().filter(is_left) {
        let rule = planner.rules.get(task.component.rules()[pair.position as usize]);
        let is_new = pairs.iter().all(|known| known.slots != pair.slots);
        if is_new && is_undone(planner, model, rule, pair, values, host, &mut scratch) {
            pairs.push(*pair);
        }
    }
    if !pairs.is_empty() && is_told_apart(planner, model, task, &pairs, values, host, &mut scratch)
    {
        return Some(Together { pairs, is_none: true });
    }
    pairs.clear();
    // what has come to a place that is set is where it shall be too
    let has_set = |pair: &&Vanished| pair.slots.iter().any(|&s| is_set(s));
    let at_set: Vec<SlotId> = shrunk.iter().filter(has_set).flat_map(|pair| pair.slots).collect();
    let is_free = |pair: &&Vanished| !pair.slots.iter().any(|s| is_set(*s) || at_set.contains(s));
    for pair in shrunk.iter().filter(is_free) {
        let is_new = pairs.iter().all(|known| known.slots != pair.slots);
        if is_new && has_no_direction(planner, model, task, pair, values, host, &mut scratch) {
            pairs.push(*pair);
        }
    }
    (!pairs.is_empty()).then_some(Together { pairs, is_none: false })
}

/// Returns the places that come together on the way from x0 to the `limit` where it ends, but for what is `set`.
pub(crate) fn shrinking(
    planner: &Planner,
    task: &Task,
    (x0, is_set): (&[f64], &dyn Fn(SlotId) -> bool),
    limit: &[f64],
) -> Option<Together> {
    let mut pairs: Vec<Vanished> = Vec::new();
    for pair in nearer(planner, task, x0, |slot| limit[slot as usize], SHRINKING) {
        let is_new = pairs.iter().all(|known| known.slots != pair.slots);
        if is_new && !pair.slots.iter().any(|&s| is_set(s)) {
            pairs.push(pair);
        }
    }
    (!pairs.is_empty()).then_some(Together { pairs, is_none: false })
}

/// Returns the pairs of places that are nearer to each other than so large a part of what they were in x0.
fn nearer(
    planner: &Planner,
    task: &Task,
    x0: &[f64],
    now: impl Fn(SlotIndex) -> f64,
    part: f64,
) -> Vec<Vanished> {
    let known = task.component.slots();
    let before = |slot: SlotIndex| x0[slot as usize];
    // nearly always nothing has come together: that is seen without roots, and without a list
    let has_come = |&&Pair { slots: [x1, y1, x2, y2], .. }: &&Pair| {
        squared([now(x1), now(y1), now(x2), now(y2)])
            < part * part * squared([before(x1), before(y1), before(x2), before(y2)])
    };
    let pairs = task.pairs(|| pairs(planner, &task.component));
    let found = pairs.iter().filter(has_come).map(|&Pair { position, slots }| {
        let [x1, y1, x2, y2] = slots.map(before);
        let apart = hypot(x2 - x1, y2 - y1);
        Vanished { position, slots: slots.map(|slot| known[slot as usize]), apart }
    });
    found.collect()
}

/// Returns true if the way between two places has no direction where they are one: a row that speaks of both has no
/// value there, or says something else on the one side than on the other; or one says nothing there, whatever else
/// is, and with the others it would leave none of them anywhere to go.
fn has_no_direction(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    pair: &Vanished,
    values: &Values,
    host: &mut dyn Host,
    scratch: &mut Scratch,
) -> bool {
    let patterns = planner.plans.patterns();
    let [x1, y1, x2, y2] = pair.slots;
    let step = ASIDE * pair.apart;
    let mut there = values.clone();
    (there.numbers[x2], there.numbers[y2]) = (there.numbers[x1], there.numbers[y1]);
    let rules = task.component.rules().iter().map(|&index| planner.rules.get(index));
    let mut says_nothing = false;
    // how the rows lean that speak of each place
    let mut leaning: [Leaning; 2] = [Leaning::default(); 2];
    for rule in rules.filter(|rule| rule.shape.level == Level::Required) {
        let Body::Equations(equations) = &rule.shape.body else { continue };
        let speaks = [[x1, y1], [x2, y2]].map(|place| place.map(|slot| rule.slots.contains(&slot)));
        let is_of_both = speaks == [[true; 2]; 2];
        if !speaks.as_flattened().contains(&true)
            || !counts(patterns, model.structure, rule, values, host, scratch)
        {
            continue;
        }
        for e in equations {
            let mut size: f64 = 0.0;
            let mut off = |slot: SlotId, by: f64| {
                let here = there.numbers[slot];
                there.numbers[slot] = here + by;
                let sides = rule.evaluate(e, patterns, &there.numbers, scratch);
                there.numbers[slot] = here;
                size = size.max(sides[0].abs()).max(sides[1].abs());
                sides[0] - sides[1]
            };
            let slopes = [[x1, y1], [x2, y2]]
                .map(|place| place.map(|slot| off(slot, step) - off(slot, -step)));
            let steep = slopes.map(|[x, y]| hypot(x, y));
            let jumps = !steep[1].is_finite() || steep[1] > (PART * size).max(STEEP * step);
            if is_of_both && jumps {
                return true;
            }
            for ((own, leaning), steep) in slopes.iter().zip(&mut leaning).zip(steep) {
                if steep > ALIKE * step {
                    leaning.add(own.map(|slope| slope / steep));
                }
            }
            says_nothing = says_nothing
                || is_of_both && {
                    // with all else anywhere it holds as long as they are one
                    let mut anywhere = there.clone();
                    for (i, &slot) in (1..).zip(rule.slots) {
                        let part = (f64::from(i) * 0.618_033_988_749_895).fract() - 0.5;
                        anywhere.numbers[slot] += part * pair.apart;
                    }
                    let mut off = |by: f64| {
                        anywhere.numbers[x2] = anywhere.numbers[x1] + by;
                        anywhere.numbers[y2] = anywhere.numbers[y1] + 0.6 * by;
                        let sides = rule.evaluate(e, patterns, &anywhere.numbers, scratch);
                        (sides[0] - sides[1]).abs()
                    };
                    off(0.0) < NOTHING * off(pair.apart)
                };
        }
    }
    let is_one = pair.now(values) < LEFT * pair.apart;
    is_one && says_nothing && leaning.iter().all(|leaning| leaning.is_everywhere)
}

/// How rows lean: along one direction, or in all.
#[derive(Clone, Copy, Default, Debug)]
struct Leaning {
    first: Option<[f64; 2]>,
    is_everywhere: bool,
}

impl Leaning {
    /// Adds a direction, of length one.
    fn add(&mut self, own: [f64; 2]) {
        let [x, y] = *self.first.get_or_insert(own);
        self.is_everywhere |= (x * own[1] - y * own[0]).abs() > ALIKE;
    }
}

/// Returns the places that the required rules of a component speak of, those of each two by two.
fn pairs(planner: &Planner, component: &Component) -> Vec<Pair> {
    let (rules, slots) = (component.rules(), component.slots());
    // where no slot of the document lies between those of the component it is found at once
    let local = |slot: SlotId| {
        let near = slot.0.wrapping_sub(slots[0].0) as usize;
        let is_there = slots.get(near) == Some(&slot);
        let at = if is_there { Some(near) } else { slots.binary_search(&slot).ok() };
        at.map(|at| at as SlotIndex)
    };
    let mut pairs = Vec::with_capacity(rules.len());
    for (position, &index) in (0..).zip(rules) {
        let rule = planner.rules.get(index);
        if rule.slots.len() < 4 || rule.shape.level != Level::Required {
            continue;
        }
        let mut places = [[0; 2]; MOST];
        let mut count = 0;
        for &slot in rule.slots {
            let &[x, y] = planner.net.place_of(slot) else { continue };
            if x != slot || count == MOST || !rule.slots.contains(&y) {
                continue;
            }
            let (Some(x2), Some(y2)) = (local(x), local(y)) else { continue };
            for &[x1, y1] in &places[..count] {
                pairs.push(Pair { position, slots: [x1, y1, x2, y2] });
            }
            places[count] = [x2, y2];
            count += 1;
        }
    }
    pairs
}

/// Returns true if an equation of a rule holds because what is between two places is small: it is off by a part of
/// what that comes to in it.
fn is_undone(
    planner: &Planner,
    model: Model<'_>,
    rule: Rule<'_>,
    pair: &Vanished,
    values: &Values,
    host: &mut dyn Host,
    scratch: &mut Scratch,
) -> bool {
    let Body::Equations(equations) = &rule.shape.body else { return false };
    let patterns = planner.plans.patterns();
    if !counts(patterns, model.structure, rule, values, host, scratch) {
        return false;
    }
    let way = pair.now(values);
    let [_, _, x, y] = pair.slots;
    let mut there = values.clone();
    equations.iter().any(|e| {
        let mut off = |values: &Values| {
            let sides = rule.evaluate(e, patterns, &values.numbers, scratch);
            sides[0] - sides[1]
        };
        let mut size = 0.0;
        for slot in [x, y] {
            let here = there.numbers[slot];
            let [more, less] = [here + way, here - way].map(|to| {
                there.numbers[slot] = to;
                off(&there)
            });
            there.numbers[slot] = here;
            size += 0.5 * (more - less).abs();
        }
        size > 0.0 && off(values).abs() > UNDONE * size
    })
}

/// Returns true if a required row of the component has no value where these places are one, or quite another.
fn is_told_apart(
    planner: &Planner,
    model: Model<'_>,
    task: &Task,
    places: &[Vanished],
    values: &Values,
    host: &mut dyn Host,
    scratch: &mut Scratch,
) -> bool {
    let mut there = values.clone();
    for &Vanished { slots: [x1, y1, x2, y2], .. } in places {
        there.numbers[x2] = there.numbers[x1];
        there.numbers[y2] = there.numbers[y1];
    }
    let way = places.iter().map(|pair| pair.now(values)).fold(0.0, f64::max);
    let patterns = planner.plans.patterns();
    let rules = task.component.rules().iter().map(|&index| planner.rules.get(index));
    rules.filter(|rule| rule.shape.level == Level::Required).any(|rule| {
        let Body::Equations(equations) = &rule.shape.body else { return false };
        counts(patterns, model.structure, rule, values, host, scratch)
            && equations.iter().any(|e| {
                let mut sides = |values: &Values| {
                    let sides = rule.evaluate(e, patterns, &values.numbers, scratch);
                    [sides[0], sides[1]]
                };
                let ([left, right], [a, b]) = (sides(values), sides(&there));
                let off = ((a - b) - (left - right)).abs();
                !off.is_finite() || off > (PART * left.abs().max(right.abs())).max(STEEP * way)
            })
    })
}
