//! References: which words of the document's own text speak of which member of which class.
//!
//! The lowerer itself says so, whenever it finds out what a word means; it is asked only when a
//! command has to know, by lowering the text once more. So what is renamed or deleted is found
//! wherever it is spoken of: in bodies, classes, messages, methods and checks.

use crate::lower::{Lowered, Lowerer, OWN};
use base::{Name, Place, Span};
use kernel::ClassId;
use std::collections::BTreeSet;

/// A member of a class by its name: a part, a message, a constraint or a merge.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Symbol {
    /// The class that declares it.
    pub(crate) class: ClassId,
    /// Its name there.
    pub(crate) name: Name,
}

/// Every word of the document's own text that speaks of a member, by place.
pub(crate) type References = BTreeSet<(Span, Symbol)>;

impl Lowerer<'_> {
    /// Notes that a word speaks of a member of a class, or of one above it.
    pub(crate) fn refer(&mut self, place: Place, name: &Name, class: ClassId) {
        if self.references.is_none() || place.file != OWN {
            return;
        }
        let declares = |c: ClassId| {
            let key = (c, name.clone());
            self.named_at.contains_key(&key) || self.rule_names.contains(&key)
        };
        let definer = self.document.lineage(class).into_iter().find(|&c| declares(c));
        if let (Some(class), Some(references)) = (definer, &mut self.references) {
            references.insert((place.span, Symbol { class, name: name.clone() }));
        }
    }
}

impl Lowered {
    /// Finds every word that speaks of a member, in the text as it is in force.
    pub(crate) fn references(&self) -> References {
        let load = |name: &str| {
            let file = self.files.iter().find(|(id, f)| *id != OWN && f.name == name);
            file.map(|(_, f)| f.text.to_string())
        };
        crate::lower::references(&self.effective, &load)
    }
}
