//! Given twice: one body gives a part two values, of which the later counts. A warning at the earlier.
//!
//! In: what a text means. Out: diagnostics. What a body further out gives in the place of one further in is meant so, and
//! so is what a loop or a condition gives of which something else is an exception.

use crate::lower::{Lowered, OWN};
use base::{Diagnostic, Mixer, Span};
use indexmap::IndexMap;
use kernel::{Given, OriginId, Path};
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::hash::BuildHasherDefault;
use syntax::{SyntaxKind, SyntaxNode};

/// The code of the warning.
const CODE: &str = "given-twice";

impl Lowered {
    /// Returns a warning for every value of the text that another in the same body takes the place of.
    ///
    /// Cost: a look at every given value.
    pub fn given_twice(&self) -> Vec<Diagnostic> {
        let blocks = OnceCell::new();
        let blocks = || blocks.get_or_init(|| Blocks::of(&self.effective_parse.syntax()));
        let mut said = BTreeSet::new();
        let mut warnings = Vec::new();
        for (_, class) in self.document.classes.iter() {
            let mut latest: IndexMap<&Path, OriginId, BuildHasherDefault<Mixer>> =
                IndexMap::with_capacity_and_hasher(
                    class.givens.len(),
                    BuildHasherDefault::default(),
                );
            for given in class.givens.iter().map(|given| &**given) {
                let Given { path, origin, .. } = given;
                let place = self.place(*origin);
                if place.file != OWN {
                    continue;
                }
                let Some(earlier) = latest.insert(path, *origin) else { continue };
                let before = self.place(earlier);
                let is_one = || {
                    let starts = [before, place].map(|place| place.span.start);
                    let [one, other] = starts.map(|start| blocks().around(start));
                    one == other
                };
                if before != place && is_one() && said.insert(before) {
                    let message =
                        format!("{path} is given here, and again further on: that counts");
                    let d = Diagnostic::warning(CODE, before, message).label(place, "here");
                    warnings.push(d.hint("give it once; what holds at all times is a constraint"));
                }
            }
        }
        warnings
    }
}

/// The loops and conditions of a text.
struct Blocks {
    /// The range of each in bytes, and the place here of the one around it; by where they start.
    all: Vec<(Span, Option<usize>)>,
}

impl Blocks {
    fn of(root: &SyntaxNode) -> Self {
        let mut all: Vec<(Span, Option<usize>)> = Vec::new();
        let is_block = |n: &SyntaxNode| matches!(n.kind(), SyntaxKind::For | SyntaxKind::If);
        let mut around = None;
        for node in root.descendants().filter(is_block) {
            let range = node.text_range();
            let span = Span::new(range.start().into(), range.end().into());
            while let Some(at) = around.filter(|&at: &usize| all[at].0.end <= span.start) {
                around = all[at].1;
            }
            all.push((span, around));
            around = Some(all.len() - 1);
        }
        Self { all }
    }

    /// Returns the place here of the innermost that a byte stands in.
    fn around(&self, byte: u32) -> Option<usize> {
        let last = self.all.partition_point(|(span, _)| span.start <= byte).checked_sub(1);
        let mut outwards = std::iter::successors(last, |&at| self.all[at].1);
        outwards.find(|&at| byte < self.all[at].0.end)
    }
}
