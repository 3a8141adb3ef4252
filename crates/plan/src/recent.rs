//! Recent edits: what was planned for them, so that doing the like again plans nothing.
//!
//! The tasks of an edit depend on the structure and on what the edit speaks of, never on values.

use crate::aim::Aim;
use crate::task::{Task, Wish};
use kernel::SlotId;

/// How many edits are remembered.
const REMEMBERED: usize = 8;

/// The tasks of recent edits of one structure, the latest last.
#[derive(Debug, Default)]
pub(crate) struct Recent(Vec<(About, Vec<Task>)>);

/// What an edit speaks of.
#[derive(PartialEq, Debug)]
struct About {
    fixed: Vec<SlotId>,
    alone: Vec<SlotId>,
    wishes: Vec<Wish>,
}

impl Recent {
    /// Returns what was planned for an edit that spoke of the same.
    pub(crate) fn find(&mut self, aim: &Aim) -> Option<Vec<Task>> {
        let is = |(about, _): &(About, Vec<Task>)| {
            about.wishes == aim.wishes
                && about.fixed.iter().eq(aim.fixed.keys())
                && about.alone.iter().eq(&aim.alone)
        };
        let at = self.0.iter().position(is)?;
        self.0[at..].rotate_left(1);
        self.0.last().map(|(_, tasks)| tasks.clone())
    }
    /// Remembers what was planned for an edit.
    pub(crate) fn add(&mut self, aim: &Aim, tasks: &[Task]) {
        if self.0.len() == REMEMBERED {
            self.0.remove(0);
        }
        let about = About {
            fixed: aim.fixed.keys().copied().collect(),
            alone: aim.alone.iter().copied().collect(),
            wishes: aim.wishes.clone(),
        };
        self.0.push((about, tasks.to_vec()));
    }
}
