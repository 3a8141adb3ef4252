//! Counts that depend on values: `0..sides - 1`, on the course that is taken at a state.
//!
//! In: the ends of a range. Out: its numbers, and as decisions what they follow from. A whole number that counts is as
//! it stands: no rule that speaks of so many things changes how many there are.

use crate::course::{Block, Decided, Decision};
use crate::evaluate::{Answer, Opening};
use crate::fault::Trouble;
use crate::meaning::{Meaning, slots_of_expression};
use expr::Var;
use kernel::{Path, Primitive, SlotId, ThingId};

/// Returns a whole number, if it is one that counts: up to rounding, for 600 mm by 200 mm is one.
pub(crate) fn whole(x: f64) -> Option<i64> {
    let whole = x.round();
    let is_one = (x - whole).abs() <= base::number::ROUNDING * x.abs() && x.abs() < 1e15;
    is_one.then_some(whole as i64)
}

impl<'a> Opening<'a> {
    /// Answers the whole numbers from one to another. Where only values say which, those of the state whose courses
    /// are taken; without such a state the rule waits for one.
    ///
    /// # Errors
    /// An end that is no whole number; more of them than a rule may speak of.
    pub(crate) fn range(&mut self, ends: &[Meaning<'a>; 2]) -> Answer<'a> {
        let [from, to] = match [self.constant(&ends[0]), self.constant(&ends[1])] {
            [Some(from), Some(to)] => [from, to],
            _ => {
                (self.has_courses, self.meets_counts) = (true, true);
                // how many there are no other thing says
                self.reach.looks_around();
                let is_number = |end: &Meaning<'a>| matches!(end, Meaning::Number(_));
                self.awaits_count = self.at.is_none();
                if self.awaits_count || !ends.iter().all(is_number) {
                    return Ok(self.opaque(ends));
                }
                [self.count_at(&ends[0])?, self.count_at(&ends[1])?]
            }
        };
        let (Some(from), Some(to)) = (whole(from), whole(to)) else {
            return Err(Trouble::wrong("the ends of a range are whole numbers"));
        };
        let mut numbers = Vec::new();
        for i in from..=to {
            self.count_term()?;
            numbers.push(self.number(i as f64));
        }
        Ok(Meaning::List(numbers.into()))
    }

    /// Decides what a count is at the state whose courses are taken: by the whole numbers that it follows from, else
    /// as it comes out.
    fn count_at(&mut self, count: &Meaning<'a>) -> Result<f64, Trouble> {
        let id = self.expression(count)?;
        let slots = slots_of_expression(&self.arena, id);
        let first = slots.first().map(|&slot| self.structure.slots[slot].thing);
        let Some(at) = self.at else { return Err(Trouble::wrong("no course")) };
        let value = self.arena.evaluate(id, at.numbers.as_slice());
        // what is decided is noted first: a rule that cannot be opened by it is opened anew where it is otherwise
        let is_whole = |&slot: &SlotId| self.structure.slots[slot].primitive == Primitive::Integer;
        if slots.iter().all(is_whole) {
            slots.into_iter().for_each(|slot| self.note_count(slot, at.numbers[slot]));
        } else {
            let place = Block { of: first, path: String::new(), what: Decided::Count };
            self.decisions.push(Decision { of: id, is: value, place });
        }
        if value.is_nan() {
            let of = first.map(|of| format!(": it follows from {}", self.path_of(of)));
            let message = format!("how many there are has no value{}", of.unwrap_or_default());
            return Err(Trouble::wrong(message));
        }
        Ok(value)
    }

    fn path_of(&self, thing: ThingId) -> Path {
        self.structure.path(self.document, thing)
    }

    /// Notes that a whole number counts something in the rule at hand.
    fn note_count(&mut self, slot: SlotId, is: f64) {
        let of = self.arena.var(Var(slot.0));
        let thing = Some(self.structure.slots[slot].thing);
        let place = Block { of: thing, path: String::new(), what: Decided::Count };
        self.decisions.push(Decision { of, is, place });
        self.counted.insert(slot, is);
    }

    /// Notes what counts in a rule that is opened once more.
    pub(crate) fn take_known_counts(&mut self) {
        for (slot, is) in std::mem::take(&mut self.known_counts) {
            self.reach.looks_around();
            self.note_count(slot, is);
        }
    }
}
