//! Replaced bindings: the document gives a thing's part a number where its class computes it, and something that the
//! class computes it of is given by nobody. The number counts, and nothing follows from it, as was perhaps meant.
//!
//! In: what a text means. Out: warnings at the value. Where all that the class computes of is given, another value is
//! meant so, and so it is where a constraint speaks of what is open.

use crate::lower::{Lowered, OWN};
use base::Diagnostic;
use kernel::{Binding, ClassId, ClassKind, Given, Path, Step, Term};
use std::cell::OnceCell;
use std::collections::BTreeSet;

/// The code of the warning.
const CODE: &str = "replaces-binding";

impl Lowered {
    /// Returns a warning for every number of the text that takes the place of a class's binding and leaves open what
    /// that was to be computed of.
    ///
    /// Cost: a look at every given value; where one takes such a place, one at every constraint.
    pub fn bindings_replaced(&self) -> Vec<Diagnostic> {
        let document = &self.document;
        let mut warnings = Vec::new();
        if document.classes.iter().all(|(_, class)| class.bindings.is_empty()) {
            return warnings;
        }
        let (of, spoken) = (document.root, OnceCell::new());
        let root = &document.classes[of];
        let given: BTreeSet<&Path> = root.givens.iter().map(|given| &given.path).collect();
        for one in root.givens.iter().map(|given| &**given) {
            let place = self.place(one.origin);
            let Some((last, before)) = one.path.0.split_last() else { continue };
            let is_number = matches!(one.value, Term::Number { .. });
            if place.file != OWN || !is_number || before.is_empty() {
                continue;
            }
            let (owner, part) = (Path(before.to_vec()), Path(vec![last.clone()]));
            let Some(thing) = self.class_at(of, &owner) else { continue };
            let Some((binding, by)) = self.binding_of(thing, &part) else { continue };
            let spoken = spoken.get_or_init(|| self.spoken_of());
            let whole = |part: &Path| Path(before.iter().chain(&part.0).cloned().collect());
            let lineage = document.lineage(thing);
            let is_given = |part: &Path| {
                let inside = whole(part);
                let mut from = given.range::<Path, _>(&inside..);
                let of_class = |&c: &ClassId| {
                    let givens = &document.classes[c].givens;
                    givens.iter().any(|given| given.path == *part)
                };
                from.next().is_some_and(|path| path.0.starts_with(&inside.0))
                    || given.contains(&owner)
                    || lineage.iter().any(of_class)
            };
            let is_spoken_of = |part: &Path| {
                let of_class = |&c: &ClassId| spoken.contains(&(c, part.clone()));
                spoken.contains(&(of, whole(part)))
                    || spoken.contains(&(of, owner.clone()))
                    || lineage.iter().any(of_class)
            };
            let is_open = |part: &Path| !is_given(part) && !is_spoken_of(part);
            let Some(open) = self.read_by(thing, by).into_iter().find(is_open) else { continue };
            let message = format!(
                "{} is given here in the place of `{}`, and nothing gives {owner}.{open}",
                one.path,
                self.source_of(binding.value)
            );
            let rule = format!("constraint {} = {}", one.path, self.source_of(one.origin));
            let hint = format!("to have `{open}` follow, write `{rule}` in its place");
            warnings.push(Diagnostic::warning(CODE, place, message).hint(hint));
        }
        warnings
    }

    /// Returns the nearest binding of a part of a class's things, and what it gives.
    fn binding_of(&self, class: ClassId, part: &Path) -> Option<(&Binding, &Given)> {
        self.document.lineage(class).into_iter().find_map(|class| {
            let class = &self.document.classes[class];
            let given = class.givens.iter().rev().find(|given| given.path == *part)?;
            let is_it = |binding: &&Binding| binding.value == given.origin;
            Some((class.bindings.iter().find(is_it)?, &**given))
        })
    }

    /// Returns the stored numbers of a thing itself of which a value is computed.
    fn read_by(&self, class: ClassId, given: &Given) -> Vec<Path> {
        let is_number = |path: &Path| {
            let class = self.class_at(class, path).map(|part| &self.document.classes[part].kind);
            matches!(class, Some(ClassKind::Primitive(primitive)) if primitive.is_number())
        };
        parts_of(&given.value)
            .into_iter()
            .filter(|path| path.0.len() == 1 && is_number(path))
            .collect()
    }

    /// Returns what the constraints and merges of each class speak of, bindings apart.
    fn spoken_of(&self) -> BTreeSet<(ClassId, Path)> {
        let mut spoken = BTreeSet::new();
        for (id, class) in self.document.classes.iter() {
            let merged = class.merges.iter().flat_map(|merge| &merge.paths);
            spoken.extend(merged.map(|path| (id, path.clone())));
            let bound: BTreeSet<u32> = class.bindings.iter().map(|b| b.constraint).collect();
            for (_, constraint) in (0..).zip(&class.constraints).filter(|(i, _)| !bound.contains(i))
            {
                spoken.extend(parts_of(&constraint.rule).into_iter().map(|path| (id, path)));
            }
        }
        spoken
    }
}

/// Returns the paths that a term reads of the thing itself.
fn parts_of(term: &Term) -> Vec<Path> {
    let mut waiting = vec![term];
    let mut found = Vec::new();
    while let Some(term) = waiting.pop() {
        match term.path() {
            Some(path) if matches!(path.0.first(), Some(Step::Part(_))) => found.push(path),
            _ => waiting.extend(term.operands().into_iter().rev()),
        }
    }
    found
}
