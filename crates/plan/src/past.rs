//! What came of systems before: a plan that begins with the same bits comes to the same.
//!
//! Opening a document again after an edit runs what the edit changed; everything else is looked up
//! here. Only plain systems of numbers are remembered, of which nothing is to be told but their
//! values: solved, and every rule holds.

use base::Mixer;
use indexmap::IndexMap;
use solve::{Slot, Stay};
use std::hash::{BuildHasherDefault, Hasher};

/// What systems came to, by their plan and the bits that they began with.
#[derive(Debug, Default)]
pub(crate) struct Past {
    /// By a mixture of plan and bits; of several with one mixture, the latest.
    known: IndexMap<u64, Came, BuildHasherDefault<Mixer>>,
    numbers: Vec<f64>,
    /// How many openings there were.
    opening: u32,
    /// How many numbers the present opening uses.
    used: usize,
}

/// What one system came to.
#[derive(Clone, Copy, Debug)]
struct Came {
    /// The number of its plan.
    plan: u32,
    /// Where its numbers begin: what it came to, after what it began with where that tells more.
    start: u32,
    slots: u32,
    has_moved: bool,
    /// The latest opening that used it.
    opening: u32,
    /// The number of the plan at rest of which a status had nothing to tell in this state.
    quiet: Option<u32>,
}

/// What came of one system: where it stands among all.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct CameId(u32);

impl Came {
    fn count(self) -> usize {
        self.slots as usize * (1 + usize::from(self.has_moved))
    }
}

impl Past {
    /// Begins an opening: what the one before it did not use is forgotten, once that is most of it.
    pub(crate) fn begin(&mut self) {
        if self.numbers.len() > 2 * self.used + 1024 {
            let was = std::mem::take(&mut self.numbers);
            self.numbers.reserve(self.used);
            let (numbers, latest) = (&mut self.numbers, self.opening);
            self.known.retain(|_, came| {
                let is_used = came.opening == latest;
                if is_used {
                    let start = came.start as usize;
                    came.start = numbers.len() as u32;
                    numbers.extend_from_slice(&was[start..start + came.count()]);
                }
                is_used
            });
        }
        self.opening += 1;
        self.used = 0;
    }

    /// Returns true if nothing is remembered.
    pub(crate) fn is_empty(&self) -> bool {
        self.known.is_empty()
    }

    /// Puts what a plan came to from these numbers in their place, if that is known.
    pub(crate) fn recall(
        &mut self,
        plan: u32,
        slots: &[Slot],
        local: &mut [f64],
    ) -> Option<CameId> {
        let (index, _, came) = self.known.get_full_mut(&mixture(plan, slots, local))?;
        let numbers = &self.numbers[came.start as usize..][..came.count()];
        let is_same = came.plan == plan
            && came.slots as usize == slots.len()
            && slots.iter().zip(&*local).zip(numbers).all(|((slot, now), was)| {
                let was = if is_empty(slot) && !came.has_moved { 0.0 } else { *was };
                now.to_bits() == was.to_bits()
            });
        if !is_same {
            return None;
        }
        local.copy_from_slice(&numbers[numbers.len() - slots.len()..]);
        if came.opening != self.opening {
            came.opening = self.opening;
            self.used += came.count();
        }
        Some(CameId(index as u32))
    }

    /// Remembers what a plan came to.
    pub(crate) fn keep(
        &mut self,
        plan: u32,
        slots: &[Slot],
        began: &[f64],
        came: &[f64],
    ) -> CameId {
        let start = self.numbers.len() as u32;
        // what is not held begins with nothing, as a rule, and what is held stays as it is
        let has_moved = slots.iter().zip(began.iter().zip(came)).any(|(slot, (a, b))| {
            let usual = if is_empty(slot) { 0.0 } else { *b };
            a.to_bits() != usual.to_bits()
        });
        self.numbers.reserve(came.len() * (1 + usize::from(has_moved)));
        if has_moved {
            self.numbers.extend_from_slice(began);
        }
        self.numbers.extend_from_slice(came);
        let slots_count = slots.len() as u32;
        let opening = self.opening;
        let known = Came { plan, start, slots: slots_count, has_moved, opening, quiet: None };
        self.used += known.count();
        CameId(self.known.insert_full(mixture(plan, slots, began), known).0 as u32)
    }

    /// Returns true if a status at rest by this plan had nothing to tell where the first slots had
    /// these numbers.
    pub(crate) fn is_quiet(
        &self,
        id: CameId,
        resting: u32,
        now: impl Iterator<Item = f64>,
    ) -> bool {
        let Some((_, came)) = self.known.get_index(id.0 as usize) else { return false };
        came.quiet == Some(resting) && self.came_to(came, now)
    }
    /// Notes that a status at rest by this plan has nothing to tell where the first slots have these
    /// numbers.
    pub(crate) fn note_quiet(&mut self, id: CameId, resting: u32, now: impl Iterator<Item = f64>) {
        let is_at = |(_, came): (&u64, &Came)| self.came_to(came, now);
        if self.known.get_index(id.0 as usize).is_some_and(is_at)
            && let Some((_, came)) = self.known.get_index_mut(id.0 as usize)
        {
            came.quiet = Some(resting);
        }
    }
    fn came_to(&self, came: &Came, mut now: impl Iterator<Item = f64>) -> bool {
        let end = came.start as usize + came.count();
        let mut numbers = self.numbers[end - came.slots as usize..end].iter();
        now.all(|x| numbers.next().is_some_and(|n| n.to_bits() == x.to_bits()))
    }
}

/// Returns true for a slot that begins with nothing.
fn is_empty(slot: &Slot) -> bool {
    slot.stay == Stay::Free
}

fn mixture(plan: u32, slots: &[Slot], numbers: &[f64]) -> u64 {
    let mut mixer = Mixer::default();
    mixer.write_u32(plan);
    for (_, x) in slots.iter().zip(numbers).filter(|(slot, _)| !is_empty(slot)) {
        mixer.write_u64(x.to_bits());
    }
    mixer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use solve::Giver;

    fn slots(stays: &[Stay]) -> Vec<Slot> {
        let slot = |&stay: &Stay| Slot { stay, scale: 0, is_number: true, is_discrete: false };
        stays.iter().map(slot).collect()
    }

    #[test]
    fn what_begins_with_other_bits_is_not_known() {
        let slots = slots(&[Stay::Given(Giver::Document), Stay::Free]);
        let mut past = Past::default();
        past.begin();
        past.keep(7, &slots, &[3.0, 0.0], &[3.0, 6.0]);
        let mut local = [3.0, 0.0];
        assert!(past.recall(7, &slots, &mut local).is_some());
        assert_eq!(local, [3.0, 6.0]);
        for (plan, began) in [(8, [3.0, 0.0]), (7, [3.000_000_000_000_001, 0.0]), (7, [3.0, 1.0])] {
            let mut local = began;
            assert!(past.recall(plan, &slots, &mut local).is_none());
            assert_eq!(local, began, "what is not known changes nothing");
        }
    }
    #[test]
    fn what_was_given_and_yielded_is_found_by_what_it_was() {
        let slots = slots(&[Stay::Given(Giver::Document), Stay::Free]);
        let mut past = Past::default();
        past.begin();
        past.keep(1, &slots, &[3.0, 0.5], &[4.0, 6.0]);
        let mut local = [4.0, 0.5];
        assert!(past.recall(1, &slots, &mut local).is_none());
        local = [3.0, 0.5];
        assert!(past.recall(1, &slots, &mut local).is_some());
        assert_eq!(local, [4.0, 6.0]);
    }
    #[test]
    fn a_state_is_quiet_for_the_plan_and_the_numbers_that_it_was_said_of() {
        let slots = slots(&[Stay::Given(Giver::Document), Stay::Free]);
        let mut past = Past::default();
        past.begin();
        let id = past.keep(1, &slots, &[3.0, 0.0], &[3.0, 6.0]);
        past.note_quiet(id, 2, [3.0, 6.5].into_iter());
        assert!(!past.is_quiet(id, 2, [3.0, 6.5].into_iter()), "it never came to that");
        past.note_quiet(id, 2, [3.0, 6.0].into_iter());
        assert!(past.is_quiet(id, 2, [3.0, 6.0].into_iter()));
        assert!(!past.is_quiet(id, 4, [3.0, 6.0].into_iter()));
        assert!(!past.is_quiet(id, 2, [3.0, 6.5].into_iter()));
    }
    #[test]
    fn what_is_not_used_is_forgotten() {
        let slots = slots(&[Stay::Given(Giver::Document)]);
        let mut past = Past::default();
        past.begin();
        (0..5000).for_each(|i| {
            past.keep(1, &slots, &[f64::from(i)], &[f64::from(i)]);
        });
        past.begin();
        let mut kept = [17.0];
        assert!(past.recall(1, &slots, &mut kept).is_some());
        past.begin();
        assert!(past.recall(1, &slots, &mut kept).is_some(), "the latest opening used it");
        assert!(past.recall(1, &slots, &mut [18.0]).is_none());
        assert_eq!(past.numbers.len(), 1);
    }
}
