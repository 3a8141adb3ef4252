//! Given twice: one body gives a part two values, of which the later counts. A warning at the earlier.
//!
//! In: what a text means. Out: diagnostics. What a body further out gives in the place of one further in is meant so.

use crate::lower::{Lowered, OWN};
use base::{Diagnostic, Place};
use kernel::{Given, Path};
use std::collections::{BTreeMap, BTreeSet};

/// The code of the warning.
const CODE: &str = "given-twice";

impl Lowered {
    /// Returns a warning for every value of the text that another in the same body takes the place of.
    ///
    /// Cost: a look at every given value.
    pub fn given_twice(&self) -> Vec<Diagnostic> {
        let mut said = BTreeSet::new();
        let mut warnings = Vec::new();
        for (_, class) in self.document.classes.iter() {
            let mut latest: BTreeMap<&Path, Place> = BTreeMap::new();
            for given in class.givens.iter().map(|given| &**given) {
                let Given { path, origin, .. } = given;
                let place = self.place(*origin);
                if place.file != OWN {
                    continue;
                }
                let before = latest.insert(path, place).filter(|before| *before != place);
                if let Some(before) = before.filter(|before| said.insert(*before)) {
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
