//! Whole numbers among real unknowns: which values are worth a trial, the nearest first.
//!
//! In: a [`Conditional`] system in which some unknowns are whole numbers and some are real, compiled once
//! to [`Wholes`]. Out, for any values: the whole numbers with which a trial solves everything else. Boxes
//! of all unknowns are narrowed by every row; what stays open is split, and the box that may hold the
//! nearest whole numbers is looked at first. In a trial the whole numbers are constants, so that the system
//! has a plan of its own ([`Constants`]).
//!
//! Near is the sum of the squared changes of given whole numbers, then that of the others. What has a value
//! is held first while something has none, given numbers in any case; then given whole numbers may
//! change, at last the real ones as well. Where wishes are left
//! unmet, a few more trials look for whole numbers that leave less of them.
//!
//! **Source:** van Hentenryck, Michel and Deville, *Numerica* (1997), §3, for the narrowing; the order is
//! best-first.

mod near;
mod net;

use crate::conditional::Conditional;
use crate::pattern::Patterns;
use crate::system::{Level, SlotIndex, Stay};
use expr::Interval;
use near::{Boxes, Near, Open};
use net::Net;
use std::collections::BinaryHeap;

/// How many trials are made before the matter is left undecided.
const MOST_TRIALS: usize = 1_000;
/// How many more are made in search of whole numbers that leave less of the wishes unmet.
const IMPROVING: usize = 64;
/// How many boxes are looked at, and how many numbers in all of them.
const MOST_BOXES: usize = 20_000;
const MOST_NUMBERS: usize = 2_000_000;

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
            Self::WholeAndGiven => is_whole || stay == Stay::Given,
            Self::WholeAndValued => is_whole || stay != Stay::Free,
        };
        if is_constant { Stay::Fixed } else { stay }
    }
}

/// For every level that may give way, the sum of the squares of what is missing.
pub type Missing = [f64; Level::SOFT.len()];

/// What came of a trial.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Trial {
    /// Everything required holds; by how much wishes do not, by level.
    Holds(Missing),
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
    stays: Vec<Stay>,
    /// The unknown whole numbers.
    whole: Vec<SlotIndex>,
}

/// What may change, of what has a value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Released {
    Nothing,
    NotGiven,
    GivenWhole,
    All,
}

impl Wholes {
    /// Compiles a system. Values play no part in it.
    pub fn new(conditional: &Conditional, patterns: &Patterns) -> Self {
        let slots = &conditional.system.slots;
        let is_whole = |&i: &SlotIndex| conditional.is_whole_unknown(i);
        Self {
            net: Net::new(conditional, patterns),
            stays: slots.iter().map(|s| s.stay).collect(),
            whole: (0..slots.len() as SlotIndex).filter(is_whole).collect(),
        }
    }

    /// Returns the slots of the unknown whole numbers.
    pub fn slots(&self) -> &[SlotIndex] {
        &self.whole
    }

    /// Looks for the whole numbers nearest to those at the start with which a trial succeeds.
    ///
    /// `start` is the state when the edit began; `values` is the same with what the edit set.
    pub fn look(
        &self,
        start: &[f64],
        values: &[f64],
        attempt: &mut dyn FnMut(Constants, &[f64]) -> Trial,
    ) -> Looked {
        let is_given = |i: &SlotIndex| self.stays[*i as usize] == Stay::Given;
        let given = self.whole.iter().copied().filter(is_given).count();
        let all_given = self.stays.iter().filter(|s| **s == Stay::Given).count();
        let mut looking = Looking { wholes: self, start, values, attempt, tried: 0, boxes: 0 };
        let mut is_complete = true;
        for released in [Released::Nothing, Released::NotGiven, Released::GivenWhole, Released::All]
        {
            let is_new = match released {
                Released::Nothing => self.stays.contains(&Stay::Free),
                Released::NotGiven => true,
                Released::GivenWhole => given > 0,
                Released::All => all_given > given,
            };
            if !is_new {
                continue;
            }
            match looking.among(released) {
                Looked::Impossible => {}
                found @ Looked::Found(..) => return found,
                Looked::NotDecided(_) => is_complete = false,
            }
        }
        if is_complete { Looked::Impossible } else { Looked::NotDecided(looking.boxes) }
    }
}

struct Looking<'a> {
    wholes: &'a Wholes,
    start: &'a [f64],
    values: &'a [f64],
    attempt: &'a mut dyn FnMut(Constants, &[f64]) -> Trial,
    tried: usize,
    boxes: usize,
}

impl Looking<'_> {
    fn among(&mut self, released: Released) -> Looked {
        let constants = match released {
            Released::Nothing => Constants::WholeAndValued,
            Released::NotGiven | Released::GivenWhole => Constants::WholeAndGiven,
            Released::All => Constants::Whole,
        };
        let is_known = |i: usize, stay: Stay| match stay {
            Stay::Fixed => true,
            Stay::Free => false,
            Stay::Kept { .. } => released == Released::Nothing,
            Stay::Given => match released {
                Released::Nothing | Released::NotGiven => true,
                Released::GivenWhole => !self.wholes.whole.contains(&(i as SlotIndex)),
                Released::All => false,
            },
        };
        let stays = self.wholes.stays.iter().copied().enumerate();
        let known = stays.map(|(i, stay)| is_known(i, stay).then(|| self.values[i]));
        let Some(whole) = self.wholes.net.ground(known) else { return Looked::Impossible };
        let near = Near::new(&self.wholes.whole, &self.wholes.stays, self.start);
        let most = MOST_BOXES.min(MOST_NUMBERS / whole.len().max(1));
        let mut open = BinaryHeap::from([Open::new(Boxes::from(whole), &near, 0)]);
        let mut best: Option<(Missing, Vec<f64>)> = None;
        let mut left = MOST_TRIALS;
        let mut is_complete = true;
        let mut made = 0;
        while let Some(Open { boxes, .. }) = open.pop() {
            if self.tried >= MOST_TRIALS || self.boxes >= most || left == 0 {
                is_complete = false;
                break;
            }
            self.boxes += 1;
            let Some((slot, first)) = near.choice(&boxes) else {
                let mut values = self.values.to_vec();
                self.wholes.whole.iter().for_each(|&i| values[i as usize] = boxes[i as usize].low);
                self.tried += 1;
                left -= 1;
                match (self.attempt)(constants, &values) {
                    Trial::Holds(unmet) => {
                        let is_better = best.as_ref().is_none_or(|(b, _)| unmet < *b);
                        if best.is_none() {
                            left = IMPROVING;
                        }
                        if is_better {
                            best = Some((unmet, values));
                        }
                        if unmet == [0.0; Level::SOFT.len()] {
                            break;
                        }
                    }
                    Trial::Fails => {}
                    Trial::NotDecided => is_complete = false,
                    Trial::Spent => {
                        is_complete = false;
                        self.tried = MOST_TRIALS;
                    }
                }
                continue;
            };
            for part in around(boxes[slot as usize], first) {
                if let Some(smaller) = self.wholes.net.with(&boxes, slot, part) {
                    made += 1;
                    open.push(Open::new(Boxes::from(smaller), &near, made));
                }
            }
        }
        match best {
            Some((_, values)) => Looked::Found(constants, values),
            None if is_complete => Looked::Impossible,
            None => Looked::NotDecided(self.boxes),
        }
    }
}

/// Parts an interval of whole numbers at one of them.
fn around(own: Interval, at: f64) -> impl Iterator<Item = Interval> {
    let below = Interval { low: own.low, high: at - 1.0 };
    let above = Interval { low: at + 1.0, high: own.high };
    [above, below, Interval::point(at)].into_iter().filter(|part| !part.is_none())
}
