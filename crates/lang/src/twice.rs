//! Given twice: one body gives a part two values, of which the later counts. A warning at the earlier.
//!
//! In: what a text means. Out: diagnostics. What a body further out gives in the place of one further in is meant so, and
//! so is what a loop or a condition gives of which something else is an exception.

use crate::lower::{Lowered, OWN};
use base::{Diagnostic, Mixer};
use indexmap::IndexMap;
use kernel::{Given, OriginId, Path};
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
        let root = self.effective_parse.syntax();
        let mut said = BTreeSet::new();
        let mut warnings = Vec::new();
        for (_, class) in self.document.classes.iter() {
            let mut latest: IndexMap<&Path, OriginId, BuildHasherDefault<Mixer>> =
                IndexMap::default();
            for given in class.givens.iter().map(|given| &**given) {
                let Given { path, origin, .. } = given;
                let place = self.place(*origin);
                if place.file != OWN {
                    continue;
                }
                let Some(earlier) = latest.insert(path, *origin) else { continue };
                let before = self.place(earlier);
                let [one, other] = [earlier, *origin].map(|origin| self.repeated(&root, origin));
                if before != place && one == other && said.insert(before) {
                    let message =
                        format!("{path} is given here, and again further on: that counts");
                    let d = Diagnostic::warning(CODE, before, message).label(place, "here");
                    warnings.push(d.hint("give it once; what holds at all times is a constraint"));
                }
            }
        }
        warnings
    }

    /// Returns the innermost loop or condition that a member of the text stands in.
    fn repeated(&self, root: &SyntaxNode, origin: OriginId) -> Option<SyntaxNode> {
        let start = self.origins.place(origin).span.start.into();
        let token = root.token_at_offset(start).right_biased()?;
        token.parent_ancestors().find(|n| matches!(n.kind(), SyntaxKind::For | SyntaxKind::If))
    }
}
