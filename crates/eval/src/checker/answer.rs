//! Whether an edit has the right answer: who yields, and how much.
//!
//! Only what the rules themselves prove is told, so these are conditions that every answer meets, not all
//! that there are: to first order, at the state after the edit, where no rule is a written method. Where
//! rules are soft, only that those that are not met could not be met better. Components of more than
//! [`MOST`] slots are not looked at.

use super::algebra::{NEARLY, Span, length, rest_of_cone, sign_of_determinant};
use super::blocks::{Block, blocks};
use super::slopes::{Row, only_read, rows, taken};
use super::{Edit, shown, wish};
use crate::evaluator::Evaluator;
use crate::sway::Order;
use kernel::{
    ConstraintInstance, Document, Primitive, SlotId, Strength, Structure, ThingId, Values,
};
use std::collections::BTreeSet;

/// How many slots a component may have to be looked at.
const MOST: usize = 150;
/// How many inequalities may act for their signs to be looked at.
const MOST_ACTING: usize = 8;
/// How far a gradient may be off, as a part of its length: slopes are found by moving numbers.
pub(super) const OFF: f64 = 1e-4;
/// How much of a column may be left that others replace, as a part of its length: what is amplified along a chain
/// shows little at its end. Slopes are found some orders better than what is told of them.
const SPARED: f64 = 1e-7;
/// Slopes so much smaller than a little aside are rounding.
const VANISHED: f64 = 1e-6;

pub(crate) fn complaints(
    document: &Document,
    structure: &Structure,
    edit: Edit<'_>,
    connected: &BTreeSet<SlotId>,
) -> Vec<String> {
    let changed: BTreeSet<SlotId> = edit.before.changed(edit.after).collect();
    // what moved by rounding alone was held
    let moves = |s: &SlotId| {
        let [before, after] = [edit.before, edit.after].map(|v| v.numbers[*s]);
        (after - before).abs() > 1e-9 * before.abs().max(1.0) && !edit.edited.contains(s)
    };
    let moved: Vec<SlotId> = changed.iter().copied().filter(moves).collect();
    let is_wish_missed = wish::is_missed(edit);
    if moved.is_empty() && !is_wish_missed || connected.len() > MOST {
        return Vec::new();
    }
    let after = Evaluator::new(document, structure, edit.after);
    let before = after.in_state(edit.before);
    let Some(Plain { required, soft, stays }) = plain(&after, connected) else {
        return Vec::new();
    };
    let held = |c: &ConstraintInstance| before.test(*c).is_ok_and(|verdict| verdict.holds);
    // what a rule reads and never writes is found before the rest, by a measure of its own
    let follows = |c: &ConstraintInstance| moved.iter().any(|s| only_read(&after, *c).contains(s));
    if !required.iter().all(held) || required.iter().any(follows) {
        return Vec::new();
    }
    let mut own = Answer {
        edit,
        structure,
        path: &|slot| structure.path(document, structure.slots[slot].thing).to_string(),
        wrong: Vec::new(),
    };
    let extent = extents(structure, [edit.before, edit.after], connected);
    let aside = aside(edit.after, &moved, &extent);
    let states = [&after, &after.in_state(&aside)];
    if is_wish_missed && soft.is_empty() && stays.is_empty() {
        own.wish(&after, &required, connected, &extent);
    }
    if soft.is_empty() && stays.is_empty() {
        own.least(states, &required, &moved);
        own.exchange(states, &required, &moved, connected, &extent);
        let columns: Vec<SlotId> = connected.iter().copied().collect();
        // where other bounds act than before, what they let go of may have gone over to another side
        let bounds = |state| -> Option<Vec<Vec<bool>>> {
            let rows = acting(state, &required, &columns)?.into_iter();
            let bounds = rows.filter(|row| row.order == Order::AtMost);
            Some(bounds.map(|row| row.slopes.iter().map(|x| *x != 0.0).collect()).collect())
        };
        // another branch of a condition has sides of its own
        let takes = |state| required.iter().map(|&c| taken(state, c)).collect::<Vec<_>>();
        if bounds(&before).is_some_and(|acted| bounds(&after) == Some(acted))
            && takes(&before) == takes(&after)
        {
            own.orientation([&before, &after], &required, &moved, &extent);
        }
    } else {
        own.compromise(states, &required, &soft, &stays, connected);
    }
    own.wrong
}

/// Constraints that are plain equations and inequalities.
#[derive(Default)]
struct Plain {
    required: Vec<ConstraintInstance>,
    soft: Vec<(Strength, ConstraintInstance)>,
    /// Slots that are declared to stay, and how strongly.
    stays: Vec<(Strength, SlotId)>,
}

/// Returns the constraints around these slots; nothing where some are more than plain equations and
/// inequalities.
fn plain(evaluator: &Evaluator<'_>, connected: &BTreeSet<SlotId>) -> Option<Plain> {
    let structure = evaluator.structure;
    let mut plain = Plain::default();
    for (strength, thing) in structure.stays.iter().filter_map(|s| Some((s.strength?, s.thing))) {
        let own = structure.slots_under(thing).into_iter().filter(|s| connected.contains(s));
        plain.stays.extend(own.map(|slot| (strength, slot)));
    }
    for &constraint in structure.constraints.iter() {
        let (is_on, reads) = evaluator.listening(|| {
            let is_on = evaluator.is_on(constraint).unwrap_or(false);
            evaluator.test(constraint).ok();
            is_on
        });
        if reads.is_disjoint(connected) {
            continue;
        }
        let class = &evaluator.document.classes[constraint.class];
        let written = &class.constraints[constraint.index as usize];
        let strength = structure.strength(evaluator.document, constraint);
        let is_conditional = structure.conditions.contains_key(&constraint)
            || evaluator.idle(constraint).is_ok_and(|idle| !idle.is_empty());
        let is_number = reads.iter().all(|s| structure.slots[*s].primitive.is_number());
        if !is_on
            || is_conditional
            || !is_number
            || !written.methods.is_empty()
            || written.within.is_some()
        {
            return None;
        }
        match strength {
            Strength::Required => plain.required.push(constraint),
            Strength::Strong | Strength::Medium | Strength::Weak => {
                plain.soft.push((strength, constraint));
            }
        }
    }
    Some(plain)
}

/// What is found of one edit.
pub(super) struct Answer<'a> {
    pub(super) edit: Edit<'a>,
    pub(super) structure: &'a Structure,
    pub(super) path: &'a dyn Fn(SlotId) -> String,
    pub(super) wrong: Vec<String>,
}

impl Answer<'_> {
    pub(super) fn is_given(&self, slot: SlotId) -> bool {
        let slot = &self.structure.slots[slot];
        slot.given.is_some() && slot.place.is_none()
    }

    fn distance(&self, slot: SlotId) -> f64 {
        self.edit.after.numbers[slot] - self.edit.before.numbers[slot]
    }

    /// The change of given numbers is least, then that of the others: no direction that the rules leave
    /// open makes it less. Told apart by what numbers measure, since they weigh differently.
    fn least(&mut self, states: [&Evaluator<'_>; 2], of: &[ConstraintInstance], moved: &[SlotId]) {
        let mut measures: Vec<Primitive> = Vec::new();
        for &slot in moved {
            let primitive = self.structure.slots[slot].primitive;
            if matches!(primitive, Primitive::Real(_)) && !measures.contains(&primitive) {
                measures.push(primitive);
            }
        }
        for measure in measures {
            let alike = |s: &&SlotId| self.structure.slots[**s].primitive == measure;
            let all: Vec<SlotId> = moved.iter().filter(alike).copied().collect();
            let kept: Vec<SlotId> = all.iter().copied().filter(|s| !self.is_given(*s)).collect();
            let given_first = |s: SlotId| if self.is_given(s) { self.distance(s) } else { 0.0 };
            let all_gradient: Vec<f64> = all.iter().map(|&s| given_first(s)).collect();
            let kept_gradient: Vec<f64> = kept.iter().map(|&s| self.distance(s)).collect();
            for (columns, gradient, what) in
                [(&all, all_gradient, "given numbers"), (&kept, kept_gradient, "numbers")]
            {
                let size = length(&gradient);
                if size < 1e-6 {
                    continue;
                }
                let [here, aside] = states.map(|state| all_rows(state, of, columns));
                let (Some(here), Some(aside)) = (here, aside) else { continue };
                if here.len() != aside.len() {
                    continue;
                }
                let acts = |of: &[Row]| -> Vec<Row> {
                    let both = of.iter().zip(&here).filter(|(_, here)| here.acts());
                    both.map(|(row, _)| row.clone()).collect()
                };
                // where rules depend on one another only here, as at the end of a reach, slopes prove nothing, nor where
                // one has none, as a variance has none where it is nothing
                let (mut rows, mut others) = (acts(&here), acts(&aside));
                let vanishes = |(here, aside): (&Row, &Row)| {
                    length(&here.slopes) < VANISHED * length(&aside.slopes)
                };
                if rows.iter().zip(&others).any(vanishes) {
                    continue;
                }
                let weights = weights(&rows, columns.len());
                for row in rows.iter_mut().chain(&mut others) {
                    row.slopes
                        .iter_mut()
                        .zip(&weights)
                        .for_each(|(slope, weight)| *slope *= weight);
                }
                if rank(&rows) < rank(&others) {
                    continue;
                }
                let gradient: Vec<f64> =
                    gradient.iter().zip(&weights).map(|(slope, weight)| slope * weight).collect();
                let size = length(&gradient);
                let groups = columns.iter().map(|&s| self.structure.slots[s].place.ok_or(s));
                let rest = unexplained(&rows, &gradient, &groups.collect::<Vec<_>>());
                if rest > OFF * size && !self.turns_round(states[0], of, columns, &rows, &gradient)
                {
                    let paths: Vec<String> = columns.iter().map(|&s| (self.path)(s)).collect();
                    let paths = paths.join(", ");
                    let part = rest / size;
                    self.wrong.push(format!(
                        "{what} changed more than they had to, by {part:.1e} of the change: {paths}"
                    ));
                }
            }
        }
    }

    /// Returns true if what would change less, to first order, turns the way from one place to another round that a rule
    /// speaks of: where the angle of a line turns by more than a right angle, no change is least, but that which brings
    /// its ends together, where it has no angle.
    fn turns_round(
        &self,
        after: &Evaluator<'_>,
        of: &[ConstraintInstance],
        columns: &[SlotId],
        rows: &[Row],
        gradient: &[f64],
    ) -> bool {
        let back = Span::of(rows.iter().map(|row| row.slopes.clone())).rest(gradient);
        let number = |slot: SlotId| {
            let now = self.edit.after.numbers[slot];
            let column = columns.iter().position(|c| *c == slot);
            [now, now - column.map_or(0.0, |column| back[column])]
        };
        of.iter().any(|&constraint| {
            let (_, reads) = after.listening(|| after.test(constraint).is_ok());
            let places: BTreeSet<ThingId> =
                reads.iter().filter_map(|&slot| self.structure.slots[slot].place).collect();
            let places: Vec<[[f64; 2]; 2]> = places
                .into_iter()
                .filter_map(|place| self.structure.slots_under(place).try_into().ok())
                .map(|[x, y]: [SlotId; 2]| [number(x), number(y)])
                .collect();
            let turns = |[a, b]: [[[f64; 2]; 2]; 2]| {
                let [x, y] = [0, 1].map(|i| [0, 1].map(|when| b[i][when] - a[i][when]));
                x[0] * x[1] + y[0] * y[1] < 0.0
            };
            let pairs = places.iter().enumerate();
            pairs.flat_map(|(i, &a)| places[..i].iter().map(move |&b| [a, b])).any(turns)
        })
    }

    /// A wish that is not met could not be met better: what is stronger allows no direction in which it would be.
    /// Told of wishes that are alone at their strength, since how several weigh is not in the rules.
    fn compromise(
        &mut self,
        states: [&Evaluator<'_>; 2],
        required: &[ConstraintInstance],
        soft: &[(Strength, ConstraintInstance)],
        stays: &[(Strength, SlotId)],
        connected: &BTreeSet<SlotId>,
    ) {
        let columns: Vec<SlotId> =
            connected.iter().copied().filter(|&s| self.is_weaker(s)).collect();
        let groups = columns.iter().map(|&s| self.structure.slots[s].place.ok_or(s));
        let groups: Vec<_> = groups.collect();
        let evaluator = states[0];
        for strength in [Strength::Strong, Strength::Medium, Strength::Weak] {
            let unmet = soft.iter().filter(|(own, c)| {
                *own == strength && evaluator.test(*c).is_ok_and(|verdict| !verdict.holds)
            });
            let unmet: Vec<ConstraintInstance> = unmet.map(|(_, c)| *c).collect();
            let [wish] = unmet[..] else { continue };
            let own = rows(evaluator, wish, &columns).unwrap_or_default();
            let [row] = &own[..] else { continue };
            let stronger = soft.iter().filter(|(own, _)| *own < strength).map(|(_, c)| *c);
            let stronger: Vec<ConstraintInstance> = stronger.collect();
            let above = states.map(|state| {
                let acting = acting(state, required, &columns)?;
                let wished = all_rows(state, &stronger, &columns)?;
                let is_plain = wished.iter().all(|r| r.order == Order::Equal);
                is_plain.then(|| [acting, wished].concat())
            });
            let [Some(mut here), Some(aside)] = above else { continue };
            if row.order != Order::Equal || rank(&here) < rank(&aside) {
                continue;
            }
            let stay = |&(own, slot): &(Strength, SlotId)| {
                let column = columns.iter().position(|c| *c == slot).filter(|_| own < strength)?;
                let mut slopes = vec![0.0; columns.len()];
                slopes[column] = 1.0;
                Some(Row { order: Order::Equal, difference: 0.0, slopes, squared: Vec::new() })
            };
            here.extend(stays.iter().filter_map(stay));
            let gradient: Vec<f64> = row.slopes.iter().map(|s| s * row.difference).collect();
            let rest = unexplained(&here, &gradient, &groups);
            if rest > OFF * length(&gradient) {
                let name = super::name(evaluator, wish);
                let part = rest / length(&gradient);
                self.wrong.push(format!("{name} could be met better, by {part:.1e} of its slope"));
            }
        }
    }

    /// Returns true for a number that yields before given ones do.
    fn is_weaker(&self, slot: SlotId) -> bool {
        let own = &self.structure.slots[slot];
        matches!(own.primitive, Primitive::Real(_))
            && !own.anchored
            && !self.is_given(slot)
            && !self.edit.edited.contains(&slot)
    }

    /// What rules determine lies on the side where it lay: the determinant of their slopes has its sign. That is
    /// asked of what has to be found together; where its rows are linear in what is found, with the same slopes
    /// aside, the values decide it and there is no other side. To where several numbers are set at once many ways
    /// lead, and one number alone takes its nearest root there where the straight one does not.
    fn orientation(
        &mut self,
        [before, after]: [&Evaluator<'_>; 2],
        of: &[ConstraintInstance],
        moved: &[SlotId],
        extent: &dyn Fn(SlotId) -> f64,
    ) {
        let square = |state: &Evaluator<'_>| -> Option<Vec<Row>> {
            let rows = acting(state, of, moved)?;
            let is_square = rows.len() == moved.len();
            (is_square && rows.iter().all(|r| r.order == Order::Equal)).then_some(rows)
        };
        let [Some(then), Some(now)] = [before, after].map(square) else { return };
        let speaks = |(a, b): (&Row, &Row)| {
            a.slopes.iter().zip(&b.slopes).map(|(a, b)| *a != 0.0 || *b != 0.0).collect()
        };
        let speaks: Vec<Vec<bool>> = then.iter().zip(&now).map(speaks).collect();
        let is_set_with_others = self.edit.wishes.is_empty() && self.edit.edited.len() > 1;
        for Block { rows, columns } in blocks(&speaks).unwrap_or_default() {
            if is_set_with_others && columns.len() == 1 {
                continue;
            }
            let slots: Vec<SlotId> = columns.iter().map(|&column| moved[column]).collect();
            let aside = aside(self.edit.after, &slots, extent);
            let Some(aside) = square(&after.in_state(&aside)) else { continue };
            let own = |of: &[f64]| -> Vec<f64> { columns.iter().map(|&c| of[c]).collect() };
            let is_same = |(a, b): (&f64, &f64)| (a - b).abs() <= OFF * a.abs().max(b.abs());
            let are_same = |a: &[f64], b: &[f64]| own(a).iter().zip(&own(b)).all(is_same);
            let is_straight = |&row: &usize| {
                let (now, aside) = (&now[row], &aside[row]);
                are_same(&now.slopes, &aside.slopes) || are_same(&now.squared, &aside.squared)
            };
            // a centre as far from all: what their squares differ by is linear
            let beside = |all: &[Row], row: usize| -> Vec<f64> {
                let pairs = all[row].squared.iter().zip(&all[rows[0]].squared);
                pairs.map(|(a, b)| a - b).collect()
            };
            let is_like = |&row: &usize| are_same(&beside(&now, row), &beside(&aside, row));
            if rows.iter().all(is_straight) || rows.len() > 1 && rows.iter().all(is_like) {
                continue;
            }
            let [then, now] = [&then, &now].map(|all| -> Vec<Vec<f64>> {
                rows.iter().map(|&row| own(&all[row].slopes)).collect()
            });
            // where two sides meet slopes vanish, and what is left of them is rounding
            let vanishes = |(a, b): (&Vec<f64>, &Vec<f64>)| {
                let [a, b] = [length(a), length(b)];
                a.min(b) <= NEARLY * a.max(b)
            };
            if then.iter().zip(&now).any(vanishes) {
                continue;
            }
            let signs = [then, now].map(sign_of_determinant);
            if let [Some(then), Some(now)] = signs
                && then != now
            {
                let paths: Vec<String> = slots.iter().map(|&s| (self.path)(s)).collect();
                self.wrong.push(format!("{} lie on another side than before", paths.join(", ")));
            }
        }
    }

    /// A given number yields only where no number that is not given can yield in its place.
    fn exchange(
        &mut self,
        states: [&Evaluator<'_>; 2],
        of: &[ConstraintInstance],
        moved: &[SlotId],
        connected: &BTreeSet<SlotId>,
        extent: &dyn Fn(SlotId) -> f64,
    ) {
        let yielded: Vec<SlotId> = moved.iter().copied().filter(|s| self.is_given(*s)).collect();
        if yielded.is_empty() {
            return;
        }
        let weaker: Vec<SlotId> =
            connected.iter().copied().filter(|&s| self.is_weaker(s)).collect();
        let columns: Vec<SlotId> = weaker.iter().chain(&yielded).copied().collect();
        let spared = states.map(|state| {
            let mut rows = acting(state, of, &columns)?;
            // without units, and of length one: what numbers and rows measure differs by orders of magnitude
            for row in &mut rows {
                row.slopes.iter_mut().zip(&columns).for_each(|(x, &slot)| *x *= extent(slot));
                let size = length(&row.slopes);
                row.slopes.iter_mut().for_each(|x| *x /= size);
            }
            let column = |i: usize| -> Vec<f64> { rows.iter().map(|r| r.slopes[i]).collect() };
            let span = Span::of((0..weaker.len()).map(column));
            let is_spared = |i: usize| {
                let own = column(i);
                // what has no slope, as the condition of an `if`, is out of reach of a test of slopes
                let size = length(&own);
                size > 0.0 && length(&span.rest(&own)) <= SPARED * size
            };
            Some((weaker.len()..columns.len()).map(is_spared).collect::<Vec<bool>>())
        });
        // here and a little aside: who yields is decided where nothing is special
        let [Some(here), Some(aside)] = spared else { return };
        for (i, &slot) in yielded.iter().enumerate() {
            if here[i] && aside[i] {
                let [was, is] = [self.edit.before, self.edit.after].map(|v| shown(v, slot));
                let path = (self.path)(slot);
                self.wrong.push(format!(
                    "{path} is given and went from {was} to {is}, where others could have yielded"
                ));
            }
        }
    }
}

/// Returns what numbers of each kind come to in these states, of those that are connected: one where all are nothing.
fn extents<'a>(
    structure: &'a Structure,
    states: [&Values; 2],
    connected: &BTreeSet<SlotId>,
) -> impl Fn(SlotId) -> f64 + 'a {
    let mut extents: Vec<(Primitive, f64)> = Vec::new();
    for &slot in connected {
        let kind = structure.slots[slot].primitive;
        let size = states.map(|values| values.numbers[slot].abs());
        let size = size[0].max(size[1]);
        match extents.iter_mut().find(|known| known.0 == kind) {
            Some(known) => known.1 = known.1.max(size),
            None => extents.push((kind, size)),
        }
    }
    move |slot| {
        let kind = structure.slots[slot].primitive;
        let known = extents.iter().find(|known| known.0 == kind && known.1 > 0.0);
        known.map_or(1.0, |known| known.1)
    }
}

/// Returns a state a little aside, in which nothing is special.
pub(super) fn aside(values: &Values, moved: &[SlotId], extent: &dyn Fn(SlotId) -> f64) -> Values {
    let mut aside = values.clone();
    for (i, &slot) in (1..).zip(moved) {
        // the fractional parts of multiples of the golden ratio lie evenly
        let part = (f64::from(i) * 0.618_033_988_749_895).fract() - 0.5;
        aside.numbers[slot] += 0.02 * extent(slot) * part;
    }
    aside
}

/// Returns every row of these constraints; nothing where one compares no numbers.
fn all_rows(
    evaluator: &Evaluator<'_>,
    of: &[ConstraintInstance],
    columns: &[SlotId],
) -> Option<Vec<Row>> {
    let each = of.iter().map(|&constraint| rows(evaluator, constraint, columns));
    each.collect::<Option<Vec<_>>>().map(|rows| rows.concat())
}

/// Returns the rows that act and speak of some of the columns; nothing where a rule has none.
pub(super) fn acting(
    evaluator: &Evaluator<'_>,
    of: &[ConstraintInstance],
    columns: &[SlotId],
) -> Option<Vec<Row>> {
    let speaks = |r: &Row| r.slopes.iter().any(|s| *s != 0.0);
    let all = all_rows(evaluator, of, columns)?;
    Some(all.into_iter().filter(|r| r.acts() && speaks(r)).collect())
}

/// Returns by what columns are multiplied of which every row speaks little beside what else it speaks of, as of what
/// an amplifier puts out: else what they say would be lost in rounding.
fn weights(rows: &[Row], columns: usize) -> Vec<f64> {
    /// How much is little.
    const LITTLE: f64 = 1e-2;
    let part = |row: &Row, column: usize| row.slopes[column].abs() / length(&row.slopes);
    let most = |column| rows.iter().map(|row| part(row, column)).fold(0.0, f64::max);
    let weight = |most: f64| if most > 0.0 && most < LITTLE { 1.0 / most } else { 1.0 };
    (0..columns).map(|column| weight(most(column))).collect()
}

/// Returns how many of some rows are independent.
pub(super) fn rank(rows: &[Row]) -> usize {
    Span::of(rows.iter().map(|r| r.slopes.clone())).rank()
}

/// Returns how much of a gradient no multipliers of the rows explain; those of inequalities have a sign.
///
/// `places` says which columns yield together. Where one of them yields to an inequality alone, another would
/// have moved if that did not act, and its sign says nothing.
fn unexplained<P: PartialEq>(rows: &[Row], gradient: &[f64], places: &[P]) -> f64 {
    let equal: Vec<Vec<f64>> = slopes_of(rows, Order::Equal).collect();
    let span = Span::of(equal.iter().cloned());
    let yields_to_these = |place: &P| {
        let is_own = |column: usize| places[column] == *place;
        let without = equal.iter().map(|row| {
            let slopes = row.iter().enumerate();
            slopes.map(|(i, &s)| if is_own(i) { 0.0 } else { s }).collect()
        });
        Span::of(without).rank() < span.rank()
    };
    if !places.iter().all(yields_to_these) {
        return length(&Span::of(rows.iter().map(|r| r.slopes.clone())).rest(gradient));
    }
    unpushed(rows, gradient)
}

fn slopes_of(rows: &[Row], order: Order) -> impl Iterator<Item = Vec<f64>> {
    rows.iter().filter(move |r| r.order == order).map(|r| r.slopes.clone())
}

/// Returns how much of a gradient no multipliers of the rows explain; those of inequalities push one way.
pub(super) fn unpushed(rows: &[Row], gradient: &[f64]) -> f64 {
    let equal: Vec<Vec<f64>> = slopes_of(rows, Order::Equal).collect();
    let count = rows.len() - equal.len();
    if count == 0 || count > MOST_ACTING {
        return length(&Span::of(rows.iter().map(|r| r.slopes.clone())).rest(gradient));
    }
    let span = Span::of(equal);
    let pushing: Vec<Vec<f64>> = slopes_of(rows, Order::AtMost)
        .map(|slopes| span.rest(&slopes).into_iter().map(|x| 0.0 - x).collect())
        .collect();
    rest_of_cone(&span.rest(gradient), &pushing)
}
