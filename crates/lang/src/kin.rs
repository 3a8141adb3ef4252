//! Kin: things of other classes that things of a class are merged with somewhere.
//!
//! Merged things have the parts and messages of each. A name that a class does not know is looked for
//! in its kin; whether the thing in question is merged so is known once the things are made.

use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::Name;
use kernel::{ClassId, ClassKind, Document};
use std::collections::{BTreeMap, BTreeSet};

/// The kin of classes, as far as merges were lowered.
#[derive(Default)]
pub(crate) struct Kin {
    /// How many merges were looked at.
    merges: usize,
    of: BTreeMap<ClassId, BTreeSet<ClassId>>,
    /// How often it was asked.
    pub(crate) asked: usize,
    /// Whether a used text has asked: what it says depends on what the document merges.
    pub(crate) is_asked_by_used: bool,
}

impl Lowerer<'_> {
    /// Returns the nearest kin of a class that has a part or message of this name.
    pub(crate) fn kin_with(
        &mut self,
        scope: &Scope,
        class: ClassId,
        name: &Name,
    ) -> Option<ClassId> {
        self.kin_that(scope, class, |l, kin| {
            l.class_of_part(kin, name).is_some() || l.find_message(kin, name, None).is_some()
        })
    }

    /// Returns the nearest kin of a class of which something is true.
    ///
    /// Cost: where merges were lowered since it was last asked, a look at all of them.
    pub(crate) fn kin_that(
        &mut self,
        scope: &Scope,
        class: ClassId,
        is_wanted: impl Fn(&Self, ClassId) -> bool,
    ) -> Option<ClassId> {
        self.kin.asked += 1;
        self.kin.is_asked_by_used |= scope.file != OWN;
        let merges = self.document.classes.iter().map(|(_, c)| c.merges.len()).sum();
        if self.kin.merges != merges {
            self.kin = Kin { merges, of: BTreeMap::new(), ..self.kin };
            for owner in self.document.classes.ids().collect::<Vec<_>>() {
                for i in 0..self.document.classes[owner].merges.len() {
                    let paths = &self.document.classes[owner].merges[i].paths;
                    let classes: Vec<ClassId> =
                        paths.iter().filter_map(|p| self.class_at(owner, p)).collect();
                    for pair in classes.windows(2) {
                        relate(&self.document, &mut self.kin.of, pair[0], pair[1]);
                    }
                }
            }
        }
        // what is merged with a kin's kin is merged too
        let mut seen: BTreeSet<ClassId> = BTreeSet::new();
        let mut waiting = self.document.primary_line(class);
        while let Some(next) = waiting.pop() {
            for &kin in self.kin.of.get(&next).into_iter().flatten() {
                if !seen.insert(kin) {
                    continue;
                }
                if is_wanted(self, kin) {
                    return Some(kin);
                }
                waiting.push(kin);
            }
        }
        None
    }
}

/// Notes that things of two classes become one, and so do the parts that they have in common.
fn relate(
    document: &Document,
    kin: &mut BTreeMap<ClassId, BTreeSet<ClassId>>,
    a: ClassId,
    b: ClassId,
) {
    let mut waiting = vec![(a, b)];
    while let Some((a, b)) = waiting.pop() {
        let kinds = [a, b].map(|c| &document.classes[c].kind);
        if let [ClassKind::List(one), ClassKind::List(other)] = kinds {
            waiting.push((*one, *other));
        }
        let composite = kinds.iter().all(|k| **k == ClassKind::Composite);
        let is_new = |a, b| a != b && composite && kin.get(&a).is_none_or(|all| !all.contains(&b));
        if !is_new(a, b) {
            continue;
        }
        kin.entry(a).or_default().insert(b);
        kin.entry(b).or_default().insert(a);
        let lineage = document.lineage(b);
        let common = document.lineage(a).into_iter().find(|c| lineage.contains(c));
        for field in common.map(|c| document.layout(c)).unwrap_or_default() {
            waiting.push((document.refined_class(a, field), document.refined_class(b, field)));
        }
    }
}
