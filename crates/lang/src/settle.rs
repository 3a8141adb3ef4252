//! Settling: what can be told only once every class has its members.

use crate::classes::small_first;
use crate::lower::Lowerer;
use base::diagnostic::nearest;
use base::{Diagnostic, Name, Place};
use kernel::{ClassId, Path, Step};
use std::collections::BTreeMap;
use syntax::ast::AstNode;

impl Lowerer<'_> {
    /// Reports what can be told only once every class has its members.
    pub(crate) fn settle(&mut self) {
        self.report_overrides();
        self.report_masks();
        self.report_switches();
        self.report_conflicts();
    }

    /// A part is declared once in a line of classes; a message keeps its parameters.
    fn report_overrides(&mut self) {
        for ((class, name), place) in self.named_at.clone() {
            let above: Vec<ClassId> =
                self.document.primary_line(class).into_iter().skip(1).collect();
            let stored = above.iter().find(|&&c| self.parts.contains_key(&(c, name.clone())));
            if let Some(&above) = stored {
                let before = self.named_at.get(&(above, name.clone())).copied();
                let what = &self.document.classes[above].name;
                let message = format!("{name} is a stored part of {what} already");
                let mut d = Diagnostic::error("duplicate-name", place, message);
                if let Some(before) = before {
                    d = d.label(before, "here");
                }
                self.report(d.hint("give it a value, `name = value`, or another name"));
                continue;
            }
            let parameters = |m: &kernel::Message| m.parameters.len();
            let own = self.defined_message(class, &name).map(parameters);
            let inherited = self.find_message(class, &name, Some(class));
            let (Some(own), Some((from, message))) = (own, inherited) else { continue };
            let wanted = parameters(message);
            if own != wanted {
                let from = &self.document.classes[from].name;
                let said = format!("{name} has {wanted} parameters in {from}, here {own}");
                let d = Diagnostic::error("override-signature", place, said);
                self.report(d.hint("give it the same parameters, or another name"));
            }
        }
    }

    /// What `without` names has to be an inherited constraint or merge.
    fn report_masks(&mut self) {
        for (class, path, place) in std::mem::take(&mut self.masks) {
            let Some((Step::Part(name), before)) = path.0.split_last() else { continue };
            let from = self.class_at(class, &Path(before.to_vec()));
            if let Some(from) = from {
                let start = place.span.end.saturating_sub(name.len() as u32);
                let word = Place { file: place.file, span: base::Span::new(start, place.span.end) };
                self.refer(word, name, from);
            }
            let lineage = from.map(|c| self.document.lineage(c)).unwrap_or_default();
            let names: Vec<&Name> = lineage
                .iter()
                .map(|&c| &self.document.classes[c])
                .flat_map(|c| {
                    let constraints = c.constraints.iter().filter_map(|c| c.name.as_ref());
                    constraints.chain(c.merges.iter().filter_map(|m| m.name.as_ref()))
                })
                .collect();
            if names.contains(&name) {
                continue;
            }
            let message = format!("no constraint or merge called {path} is inherited here");
            let mut d = Diagnostic::error("unknown-name", place, message);
            if let Some(near) = nearest(name, names.iter().map(|n| n.as_str())) {
                d = d.hint(format!("did you mean `{near}`?"));
            } else if !names.is_empty() {
                let names: Vec<&str> = names.iter().map(|n| n.as_str()).collect();
                d = d.hint(format!("there are {}", names.join(", ")));
            }
            self.report(d);
        }
    }

    /// Two unrelated definitions of one message are a conflict that the class must settle.
    fn report_conflicts(&mut self) {
        for (id, file, class) in self.declared.clone() {
            if self.document.classes[id].supers.len() < 2 {
                continue;
            }
            for (name, a, b) in self.conflicts(id) {
                let span = class.name().map_or(class.span(), |n| n.span());
                let names = |c: ClassId| self.document.classes[c].name.clone();
                let message =
                    format!("{name} comes from {} and from {}, which differ", names(a), names(b));
                let supers = &self.document.classes[id].supers;
                let from = supers.iter().find(|s| self.document.is_a(s.class, b));
                let alias = from.map_or_else(|| small_first(&names(b)), |s| s.name.clone());
                let hint =
                    format!("define it here, `{name} => …`, or choose, `{name} => {alias}.{name}`");
                let place = |c: ClassId| {
                    let defined = self.defined_message(c, &name).map(|m| m.origin);
                    self.origins.place(defined.unwrap_or(self.document.classes[c].origin))
                };
                let diagnostic = Diagnostic::error("conflict", Place { file, span }, message)
                    .hint(hint)
                    .label(place(a), "here")
                    .label(place(b), "and here");
                self.report(diagnostic);
            }
        }
    }

    /// Returns the messages that two superclasses of a class define differently, with both classes.
    fn conflicts(&self, id: ClassId) -> Vec<(Name, ClassId, ClassId)> {
        let document = &self.document;
        let mut found: BTreeMap<Name, Vec<ClassId>> = BTreeMap::new();
        for c in document.lineage(id).into_iter().skip(1) {
            for m in &document.classes[c].messages {
                let combined = kernel::builtin::THING_MESSAGES.iter().any(|b| m.name == b.name);
                if !m.is_default && !m.is_combining && !combined {
                    found.entry(m.name.clone()).or_default().push(c);
                }
            }
        }
        let related = |a: ClassId, b: ClassId| document.is_a(a, b) || document.is_a(b, a);
        let answer =
            |c: ClassId, name: &Name| self.defined_message(c, name).map(|m| m.answer.clone());
        let conflict = |(name, classes): (Name, Vec<ClassId>)| {
            let first = *classes.first()?;
            let differs =
                |c: &ClassId| !related(first, *c) && answer(first, &name) != answer(*c, &name);
            let other = *classes.iter().find(|c| differs(c))?;
            self.defined_message(id, &name).is_none().then_some((name, first, other))
        };
        found.into_iter().filter_map(conflict).collect()
    }
}
