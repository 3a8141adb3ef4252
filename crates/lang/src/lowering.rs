//! Lowering in parts: some members at a time, so that whoever waits for a long text goes on between.
//!
//! There is one way through a text. [`crate::lower`] goes it at once.

use crate::checks;
use crate::kept::{OwnMembers, SoFar};
use crate::lower::{Blocks, Lowered, Lowerer, OWN};
use crate::members::Pending;
use crate::scale;
use crate::scope::Scope;
use crate::trails::Trails;
use crate::views;
use std::vec::IntoIter;
use syntax::ast::Member;

/// So many members are gone through in a part.
const MEMBERS: usize = 32;

/// A text that is being lowered, of which no earlier text is known.
pub struct Lowering {
    lowerer: Lowerer<'static>,
    stage: Stage,
}

impl std::fmt::Debug for Lowering {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Lowering").field("done", &self.done()).finish_non_exhaustive()
    }
}

/// How far it is.
pub(crate) enum Stage {
    /// The members at the top of the document's own text are being declared.
    Own(OwnMembers),
    /// What speaks of parts is being lowered: the members of loops inside of one another, the innermost last.
    Pending { of: usize, waiting: Vec<Waiting> },
    /// What can be told only once all members are lowered.
    Ends,
    /// All of it.
    Over(Box<Blocks>),
}

/// Members whose expressions are lowered one after the other.
pub(crate) struct Waiting {
    members: IntoIter<Pending>,
    /// So many of them are merges, which come first, so that what is known of their paths stays true.
    merges: usize,
    pub(crate) trails: Trails,
    /// What there was before the values of the part that they are at.
    pub(crate) noted: SoFar,
}

impl Lowering {
    /// Begins to find out what a text means; reads what it uses. `load` returns the text of what `use` names.
    pub fn of(text: &str, load: &dyn Fn(&str) -> Option<String>) -> Self {
        let mut lowerer = Lowerer::new(None);
        let stage = lowerer.begin(text, load);
        Self { lowerer, stage }
    }
    /// Goes through a part of what is left.
    #[must_use]
    pub fn go_on(self) -> Self {
        let Self { mut lowerer, stage } = self;
        let stage = lowerer.go_on(stage);
        Self { lowerer, stage }
    }
    /// Returns true if nothing is left.
    pub fn is_over(&self) -> bool {
        matches!(self.stage, Stage::Over(_))
    }
    /// Returns how much of it is done, from 0 to 1.
    pub fn done(&self) -> f64 {
        let part = |left: usize, all: usize| 1.0 - left as f64 / all.max(1) as f64;
        match &self.stage {
            Stage::Own(own) => 0.5 * part(own.left(), own.count()),
            Stage::Pending { of, waiting } => {
                let left = waiting.first().map_or(0, |waiting| waiting.members.len());
                0.5 + 0.5 * part(left, *of)
            }
            Stage::Ends | Stage::Over(_) => 1.0,
        }
    }
    /// Goes through what is left; returns what the text means.
    pub fn lowered(self) -> Lowered {
        let Self { mut lowerer, stage } = self;
        let blocks = lowerer.finish(stage);
        lowerer.lowered(blocks)
    }
}

impl Lowerer<'_> {
    /// Lowers a text, and returns what it says beside classes and members.
    pub(crate) fn run(&mut self, text: &str, load: &dyn Fn(&str) -> Option<String>) -> Blocks {
        let stage = self.begin(text, load);
        self.finish(stage)
    }

    fn finish(&mut self, mut stage: Stage) -> Blocks {
        loop {
            match stage {
                Stage::Over(blocks) => return *blocks,
                _ => stage = self.go_on(stage),
            }
        }
    }

    /// Reads a text and what it uses, and declares all of it but the members at its top.
    fn begin(&mut self, text: &str, load: &dyn Fn(&str) -> Option<String>) -> Stage {
        self.read(load, "", text);
        let before = self.before.map(|before| before.document.scale);
        let known = self.counting.take();
        let used = || self.files.iter().filter(|(id, file)| *id != OWN && !file.name.is_empty());
        let counting = known.unwrap_or_else(|| {
            scale::of(&self.files[OWN].parse, used().map(|(_, file)| file), before)
        });
        self.document.scale = counting.scale;
        self.document.writes_lengths = counting.writes_lengths;
        self.document.usual = counting.usual;
        self.document.customary = counting.customary;
        self.document.quotients = counting.quotients;
        let scale = self.document.scale;
        // what was read in other units is read anew
        self.before = self.before.filter(|before| before.document.scale == scale);
        self.declare_classes();
        self.declare_counts();
        self.make_root();
        self.declare_members_of_classes();
        let root = self.document.root;
        self.declare_used(OWN, root);
        Stage::Own(self.begin_own(Scope::of(OWN, root)))
    }

    fn go_on(&mut self, stage: Stage) -> Stage {
        match stage {
            Stage::Own(mut own) => {
                if self.declare_own(&mut own, MEMBERS) {
                    return Stage::Own(own);
                }
                self.declare_for_counts();
                self.begin_used();
                self.begin_members();
                let waiting = self.begin_pending();
                Stage::Pending { of: waiting.members.len(), waiting: vec![waiting] }
            }
            Stage::Pending { of, mut waiting } => {
                if self.define_waiting(&mut waiting, MEMBERS) {
                    return Stage::Pending { of, waiting };
                }
                self.given_from.push(self.so_far().givens() as u32);
                self.end_members();
                Stage::Ends
            }
            Stage::Ends => {
                self.next_used = self.keepable_of_used();
                self.hide_unspoken();
                let checks = checks::lower(self);
                let lessons = crate::lessons::lower(self);
                let (views, toolboxes) = (views::lower(self), views::toolboxes(self));
                let families = crate::families::lower(self);
                self.refine_parts();
                self.settle();
                Stage::Over(Box::new(Blocks { checks, lessons, views, toolboxes, families }))
            }
            over @ Stage::Over(_) => over,
        }
    }

    /// Lowers every expression that waits.
    pub(crate) fn define_members(&mut self) {
        self.begin_members();
        let mut waiting = vec![self.begin_pending()];
        while self.define_waiting(&mut waiting, MEMBERS) {}
        self.end_members();
    }

    fn begin_pending(&mut self) -> Waiting {
        let mut pending = std::mem::take(&mut self.pending);
        // what things are merged with decides which names they know; what speaks of a message whose
        // answer is wrong goes with it, and says no more
        pending.sort_by_key(|p| match p {
            Pending::Member(_, Member::Merge(_)) => 0,
            Pending::Answer { .. } => 1,
            _ => 2,
        });
        let is_merge = |p: &Pending| matches!(p, Pending::Member(_, Member::Merge(_)));
        Waiting {
            merges: pending.partition_point(is_merge),
            members: pending.into_iter(),
            trails: Trails::default(),
            noted: self.so_far(),
        }
    }

    /// Lowers so many of the expressions that wait; returns whether any are left.
    fn define_waiting(&mut self, waiting: &mut Vec<Waiting>, most: usize) -> bool {
        for _ in 0..most {
            let Some(of) = waiting.last_mut() else { return false };
            let Some(pending) = of.members.next() else {
                waiting.pop();
                continue;
            };
            if let Some(left) = of.merges.checked_sub(1) {
                of.merges = left;
                if let Pending::Member(scope, member) = pending {
                    self.define(&scope, &member, &mut of.trails);
                }
                continue;
            }
            self.has_merged = true;
            if let Some((scope, each, from)) = self.define_one(pending, of) {
                self.take_turns(&scope, &each, from);
                waiting.push(self.begin_pending());
            }
        }
        !waiting.is_empty()
    }
}
