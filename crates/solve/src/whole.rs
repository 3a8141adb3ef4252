//! Whole numbers among real unknowns: which values are worth a trial, the nearest first.
//!
//! In: a [`Conditional`] system in which some unknowns are whole numbers and some are real, compiled once
//! to [`Wholes`]. Out, for any values: the whole numbers with which a trial solves everything else. Boxes
//! of all unknowns are narrowed by every row; what stays open is split, and the box that may hold the
//! nearest whole numbers is looked at first. In a trial the whole numbers are constants, so that the system
//! has a plan of its own ([`Constants`]).
//!
//! Near is the sum of the squared changes of given whole numbers, then that of the others, at last how far
//! from zero those lie that had no value. While something has none, given real numbers count as given whole
//! ones do: a box tells how far they have to go at least, so that looking ends where no other can hold
//! anything nearer. What has a value is held first while something has none, given numbers in any case. Then
//! given whole numbers may change, at last the real ones as well; in an edit given real numbers first, or the
//! whole ones where these have less far to go. Where wishes are left unmet, a few more trials look for whole
//! numbers that leave less of them, and given numbers may change for them too where structure has these
//! yield.
//!
//! **Source:** van Hentenryck, Michel and Deville, *Numerica* (1997), §3, for the narrowing; the order is
//! best-first.

mod near;
mod net;

use crate::conditional::Conditional;
use crate::pattern::Patterns;
use crate::system::{Level, Slot, SlotIndex, Stay};
use base::number::RULE_TOLERANCE;
use near::{Boxes, Near, Open};
use net::Net;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// How many trials are made of what may change, before it is left undecided.
const MOST_TRIALS: usize = 1_000;
/// How many more are made in search of whole numbers that leave less of the wishes unmet.
const IMPROVING: usize = 64;
/// How many boxes are looked at for it, and how many numbers are narrowed for them.
const MOST_BOXES: usize = 20_000;
const MOST_NUMBERS: usize = 2_000_000;
/// Errors whose squares differ by less than this part of them count as equal.
const ALIKE: f64 = 1e-6;
/// The square of what is no change to a number.
const NOTHING: f64 = RULE_TOLERANCE * RULE_TOLERANCE;

/// Which unknowns are constants in a mode.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Constants {
    /// None.
    #[default]
    None,
    /// Whole numbers.
    Whole,
    /// Whole numbers, and given numbers.
    WholeAndGiven,
    /// Whole numbers, and whatever has a value.
    WholeAndValued,
}

impl Constants {
    /// Returns what holds a slot where these are constants.
    pub(crate) fn stay(self, stay: Stay, is_whole: bool) -> Stay {
        let is_constant = match self {
            Self::None => false,
            Self::Whole => is_whole,
            Self::WholeAndGiven => is_whole || stay.is_given(),
            Self::WholeAndValued => is_whole || stay != Stay::Free,
        };
        if is_constant { Stay::Fixed } else { stay }
    }
}

/// How far given numbers went, squared: those that the document gives, then defaults ([`moved`](crate::moved())).
pub type GivenMoved = [f64; 2];

/// Returns true if given numbers go less far, the firmest first.
fn is_nearer(way: GivenMoved, than: GivenMoved) -> bool {
    let is_less = |a: f64, b: f64| a + NOTHING < b * (1.0 - ALIKE);
    let mut pairs = way.into_iter().zip(than);
    let differ = |(a, b)| (is_less(a, b) || is_less(b, a)).then(|| is_less(a, b));
    pairs.find_map(differ).unwrap_or(false)
}

/// For every level that may give way, the sum of the squares of what is missing.
pub type Missing = [f64; Level::SOFT.len()];

/// What came of a trial.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Trial {
    /// Everything required holds; by how much wishes do not, by level, and how far given numbers went.
    Holds(Missing, GivenMoved),
    /// Not everything required holds.
    Fails,
    /// It was given up.
    NotDecided,
    /// It was given up, and so is everything: what may be spent was spent.
    Spent,
}

/// What came of looking for whole numbers.
#[derive(Clone, PartialEq, Debug)]
pub enum Looked {
    /// With these, which are constants and in their slots.
    Found(Constants, Vec<f64>),
    /// There are none.
    Impossible,
    /// None were found among so many choices, and there may be some.
    NotDecided(usize),
}

/// The whole numbers of a system, for any values of what is known.
#[derive(Debug)]
pub struct Wholes {
    net: Net,
    slots: Vec<Slot>,
    /// The unknown whole numbers.
    whole: Vec<SlotIndex>,
}

/// What may change, of what has a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Released {
    Nothing,
    NotGiven,
    GivenWhole,
    GivenReal,
    All,
}

/// Whole numbers with which everything required holds, what are constants then, and what is missing.
struct Best {
    constants: Constants,
    values: Vec<f64>,
    missing: Missing,
    moved: GivenMoved,
}

impl Best {
    fn is_perfect(&self) -> bool {
        self.missing == [0.0; Level::SOFT.len()]
    }
    /// Compares what is missing.
    fn leaves(&self, other: &Self) -> Ordering {
        let mut levels = self.missing.iter().zip(&other.missing);
        let differ = |(a, b): (&f64, &f64)| (a - b).abs() > ALIKE * a.max(*b);
        levels.find(|&pair| differ(pair)).map_or(Ordering::Equal, |(a, b)| a.total_cmp(b))
    }
    fn is_better(&self, other: &Self) -> bool {
        match self.leaves(other) {
            Ordering::Less => true,
            Ordering::Equal => is_nearer(self.moved, other.moved),
            Ordering::Greater => false,
        }
    }
}

impl Wholes {
    /// Compiles a system. Values play no part in it.
    pub fn new(conditional: &Conditional, patterns: &Patterns) -> Self {
        let slots = &conditional.system.slots;
        let is_whole = |&i: &SlotIndex| conditional.is_whole_unknown(i);
        Self {
            net: Net::new(conditional, patterns),
            slots: slots.clone(),
            whole: (0..slots.len() as SlotIndex).filter(is_whole).collect(),
        }
    }

    /// Returns the slots of the unknown whole numbers.
    pub fn slots(&self) -> &[SlotIndex] {
        &self.whole
    }

    /// Looks for the whole numbers nearest to those at the start with which a trial succeeds.
    ///
    /// `start` is the state when the edit began; `values` is the same with what the edit set. Given numbers
    /// change for what is required; where they may yield to wishes as well, for these too.
    pub fn look(
        &self,
        start: &[f64],
        values: &[f64],
        may_yield: bool,
        attempt: &mut dyn FnMut(Constants, &[f64]) -> Trial,
    ) -> Looked {
        let stays = || self.slots.iter().map(|s| s.stay);
        let given = stays().filter(|s| s.is_given()).count();
        let is_given = |i: &&SlotIndex| self.slots[**i as usize].stay.is_given();
        let given_whole = self.whole.iter().filter(is_given).count();
        let (has_whole, has_real) = (given_whole > 0, given > given_whole);
        let opens = stays().any(|s| s == Stay::Free);
        let turns = [
            opens.then_some(Released::Nothing),
            Some(Released::NotGiven),
            (has_real && !opens).then_some(Released::GivenReal),
            has_whole.then_some(Released::GivenWhole),
            (has_real && (opens || has_whole)).then_some(Released::All),
        ];
        let mut looking = Looking {
            wholes: self,
            start,
            values,
            opens,
            attempt,
            boxes: 0,
            narrowed: 0,
            is_spent: false,
        };
        let mut is_complete = true;
        let mut best: Option<Best> = None;
        for released in turns.into_iter().flatten() {
            let is_first = best.is_none();
            let within = best.as_ref().filter(|b| b.is_perfect()).map(|b| b.moved);
            let (found, is_all) = looking.among(released, within);
            is_complete &= is_all;
            if let Some(found) = found
                && best.as_ref().is_none_or(|best| found.is_better(best))
            {
                best = Some(found);
            }
            // whole numbers may have less far to go than real ones had
            let may_be_nearer = released == Released::GivenReal && is_first;
            let is_done = |best: &Best| !may_be_nearer && (!may_yield || best.is_perfect());
            if best.as_ref().is_some_and(is_done) || looking.is_spent {
                break;
            }
        }
        match best {
            Some(best) => Looked::Found(best.constants, best.values),
            None if is_complete => Looked::Impossible,
            None => Looked::NotDecided(looking.boxes),
        }
    }
}

struct Looking<'a> {
    wholes: &'a Wholes,
    start: &'a [f64],
    values: &'a [f64],
    /// True if something has no value yet.
    opens: bool,
    attempt: &'a mut dyn FnMut(Constants, &[f64]) -> Trial,
    boxes: usize,
    /// How many numbers were narrowed, every time that one was.
    narrowed: usize,
    /// True once a trial has spent what may be spent.
    is_spent: bool,
}

impl Looking<'_> {
    /// Returns the nearest that leave nothing unmet, else those among a few that leave least; and whether
    /// everything was looked at that is nearer than `within`.
    fn among(&mut self, released: Released, within: Option<GivenMoved>) -> (Option<Best>, bool) {
        let constants = match released {
            Released::Nothing => Constants::WholeAndValued,
            Released::NotGiven | Released::GivenWhole => Constants::WholeAndGiven,
            Released::GivenReal | Released::All => Constants::Whole,
        };
        let is_whole = |i: usize| self.wholes.whole.contains(&(i as SlotIndex));
        let is_known = |i: usize, stay: Stay| match stay {
            Stay::Fixed => true,
            Stay::Free => false,
            Stay::Kept { .. } => released == Released::Nothing,
            Stay::Given(_) => match released {
                Released::Nothing | Released::NotGiven => true,
                Released::GivenWhole => !is_whole(i),
                Released::GivenReal => is_whole(i),
                Released::All => false,
            },
        };
        let stays = self.wholes.slots.iter().map(|s| s.stay).enumerate();
        let known = stays.map(|(i, stay)| is_known(i, stay).then(|| self.values[i]));
        let Some(whole) = self.wholes.net.ground(known, &mut self.narrowed) else {
            return (None, true);
        };
        let near = Near::new(&self.wholes.whole, &self.wholes.slots, self.start, self.opens);
        let (most, most_narrowed) = (self.boxes + MOST_BOXES, self.narrowed + MOST_NUMBERS);
        let mut open = BinaryHeap::from([Open::new(Boxes::from(whole), &near, 0)]);
        let mut best: Option<Best> = None;
        let mut left = MOST_TRIALS;
        let mut is_complete = true;
        let mut made = 0;
        while let Some(Open { boxes, distance, .. }) = open.pop() {
            let perfect = best.as_ref().filter(|b| b.is_perfect()).map(|b| b.moved);
            let mut known = within.into_iter().chain(perfect);
            if known.any(|moved| !is_nearer([distance[0], distance[1]], moved)) {
                break;
            }
            if self.is_spent || self.boxes >= most || self.narrowed >= most_narrowed || left == 0 {
                is_complete = false;
                break;
            }
            self.boxes += 1;
            let Some((slot, parts)) = near.parts(&boxes) else {
                let mut values = self.values.to_vec();
                self.wholes.whole.iter().for_each(|&i| values[i as usize] = boxes[i as usize].low);
                left -= 1;
                match (self.attempt)(constants, &values) {
                    Trial::Holds(missing, moved) => {
                        let found = Best { constants, values, missing, moved };
                        if best.is_none() {
                            left = IMPROVING;
                        }
                        let is_last = !self.opens && found.is_perfect();
                        let replaces = |best: &Best| match found.leaves(best) {
                            Ordering::Equal => self.opens && found.is_better(best),
                            other => other == Ordering::Less,
                        };
                        if best.as_ref().is_none_or(replaces) {
                            best = Some(found);
                        }
                        if is_last {
                            break;
                        }
                    }
                    Trial::Fails => {}
                    Trial::NotDecided => is_complete = false,
                    Trial::Spent => {
                        is_complete = false;
                        self.is_spent = true;
                    }
                }
                continue;
            };
            for part in parts.into_iter().filter(|part| !part.is_none()) {
                if let Some(smaller) = self.wholes.net.with(&boxes, slot, part, &mut self.narrowed)
                {
                    made += 1;
                    open.push(Open::new(Boxes::from(smaller), &near, made));
                }
            }
        }
        (best, is_complete)
    }
}
