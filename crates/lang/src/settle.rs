//! Settling: what can be told only once every class has its members.

use crate::classes::small_first;
use crate::kinds::Kind;
use crate::lower::Lowerer;
use base::{Diagnostic, Mixer, Name, Place};
use indexmap::IndexSet;
use kernel::{ClassId, Search, Step, builtin};
use std::collections::BTreeMap;
use std::hash::BuildHasherDefault;
use syntax::ast::AstNode;
use syntax::edit::{Spot, insert_member};

impl Lowerer<'_> {
    /// Reports what can be told only once every class has its members.
    pub(crate) fn settle(&mut self) {
        self.report_overrides();
        self.report_general();
        self.report_switches();
        self.report_conflicts();
        self.report_rings();
        self.note_correspondences();
    }

    /// Superclasses that share parts have them twice, until they are merged: worth knowing.
    fn note_correspondences(&mut self) {
        for (id, file, class) in self.declared.clone() {
            let supers = self.document.classes[id].supers.clone();
            if supers.len() < 2 || file != crate::lower::OWN {
                continue;
            }
            let merges = &self.document.classes[id].merges;
            let is_merged = |name: &Name| {
                merges
                    .iter()
                    .flat_map(|m| &m.paths)
                    .any(|p| p.0.first() == Some(&Step::Part(name.clone())))
            };
            let lineages: Vec<Vec<ClassId>> =
                supers.iter().map(|s| self.document.lineage(s.class)).collect();
            let has_parts = |c: &ClassId| !self.document.classes[*c].parts.is_empty();
            // the nearest class with parts that several are, each still on its own
            let shared = lineages.iter().flatten().find(|&c| {
                let several = lineages.iter().filter(|l| l.contains(c)).count();
                several > 1 && has_parts(c)
            });
            let Some(&shared) = shared else { continue };
            let apart = supers.iter().zip(&lineages).filter(|(_, l)| l.contains(&shared));
            let names: Vec<Name> = apart.map(|(s, _)| s.name.clone()).collect();
            if names.iter().any(is_merged) {
                continue;
            }
            let listed = names.iter().map(Name::as_str).collect::<Vec<_>>();
            let what = &self.document.classes[shared].name;
            let message =
                format!("the parts of {what} are here once for each of {}", listed.join(", "));
            let span = class.name().map_or(class.span(), |n| n.span());
            let member = format!("merge {}", listed.join(" = "));
            let edit = insert_member(&Spot::EndOf(class.syntax().clone()), &member);
            let place = Place { file, span: edit.span };
            self.report(
                Diagnostic::note("undeclared-correspondence", Place { file, span }, message)
                    .hint(format!("if they are the same, say so: `{member}`"))
                    .fix(member, [(place, edit.insert)]),
            );
        }
    }

    /// A part is declared once in a line of classes; a message keeps its parameters.
    fn report_overrides(&mut self) {
        let mut line: (Option<ClassId>, Vec<ClassId>) = (None, Vec::new());
        // most names are no message's anywhere
        let messages: IndexSet<Name, BuildHasherDefault<Mixer>> =
            self.messages.keys().map(|(_, name)| name.clone()).collect();
        for index in 0..self.named_at.len() {
            let Some((&(class, ref name), &place)) = self.named_at.get_index(index) else { break };
            if line.0 != Some(class) {
                // the members of a class stand together, as a rule
                line = (Some(class), self.document.primary_line(class));
            }
            let above = &line.1[1..];
            let says = &self.document.classes;
            let mut declares = above.iter().filter(|c| !says[**c].parts.is_empty());
            let stored = declares.find(|&&c| self.parts.contains_key(&(c, name.clone())));
            if stored.is_none() && !messages.contains(name) {
                continue;
            }
            let name = name.clone();
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
            self.report_signature(class, &name, place);
        }
    }

    /// What overrides a message takes what that takes, and answers what that answers.
    fn report_signature(&mut self, class: ClassId, name: &Name, place: Place) {
        let part = self.parts.contains_key(&(class, name.clone()));
        let own = self.defined_message(class, name).map(|m| m.parameters.clone());
        let Some(own) = own.or(part.then(Vec::new)) else { return };
        let inherited = self.find_message(class, name, Some(Search::Above(class)));
        let Some((from, message)) = inherited else { return };
        let wanted = message.parameters.clone();
        let above = self.document.classes[from].name.clone();
        let of = |p: &kernel::Parameter| {
            p.class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c))
        };
        let labels = |all: &[kernel::Parameter]| {
            all.iter().map(|p| p.label.to_string()).collect::<Vec<_>>().join(", ")
        };
        let said = if own.len() != wanted.len() {
            let (wanted, own) = (wanted.len(), own.len());
            let s = if wanted == 1 { "" } else { "s" };
            Some(format!("{name} takes {wanted} argument{s} in {above}, here {own}"))
        } else if labels(&own) != labels(&wanted) {
            let (wanted, own) = (labels(&wanted), labels(&own));
            Some(format!("{name} takes ({wanted}) in {above}, here ({own})"))
        } else {
            let misfit = own.iter().zip(&wanted).find(|(a, b)| !of(a).fits(&of(b), &self.document));
            misfit.map(|(own, wanted)| {
                let kinds = (of(wanted).words(&self.document), of(own).words(&self.document));
                format!("{} of {name} is {} in {above}, here {}", own.label, kinds.0, kinds.1)
            })
        };
        let said = said.or_else(|| {
            let general = from == self.object;
            let wanted = self.message_kind(from, name);
            let found = self.kind_of_part(class, name).unwrap_or(Kind::Unknown);
            let fits = general || found.fits(&wanted, &self.document);
            let kinds = (wanted.words(&self.document), found.words(&self.document));
            (!fits).then(|| format!("{name} is {} in {above}, here {}", kinds.0, kinds.1))
        });
        if let Some(said) = said {
            let d = Diagnostic::error("override-signature", place, said);
            let asked = match from == self.object {
                true => self.as_called(from, name),
                false => None,
            };
            self.report(d.hint(match asked {
                Some(asked) => format!("every thing answers `{asked}`: give this another name"),
                None => "give it the same parameters and the same class, or another name".into(),
            }));
        }
    }

    /// What the lab asks of every thing has to be of a kind that it can show.
    fn report_general(&mut self) {
        for index in 0..self.named_at.len() {
            let Some((&(class, ref name), &place)) = self.named_at.get_index(index) else { break };
            if self.document.classes[class].messages.is_empty() {
                continue;
            }
            let name = name.clone();
            let general = self.defined_message(self.object, &name).is_some();
            if class == self.object || !general || self.defined_message(class, &name).is_none() {
                continue;
            }
            let found = self.message_kind(class, &name);
            let (fits, wanted) = match name.as_str() {
                "picture" => {
                    let known = found.is(builtin::Kind::Pictures, &Kind::Unknown, &self.document);
                    (known, "a picture, a thing, or a list of these")
                }
                "description" => {
                    (matches!(found, Kind::Text | Kind::Color | Kind::Unknown), "a text")
                }
                "accepts" => (matches!(found, Kind::Bool | Kind::Unknown), "a truth value"),
                "structure" | "values" => {
                    (matches!(found, Kind::List(_) | Kind::Unknown), "a list of parts or of rows")
                }
                _ => {
                    let thing = matches!(found, Kind::Thing(_) | Kind::Tuple(_) | Kind::Unknown);
                    (thing, "a thing of the class")
                }
            };
            if !fits {
                let found = found.words(&self.document);
                let message = format!("{name} is {found} here, wanted {wanted}");
                let d = Diagnostic::error("override-kind", place, message);
                self.report(d.hint("every thing has this message; give yours another name"));
            }
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
                let way = |s: &kernel::Superclass| {
                    let member = format!("{name} => {}.{name}", s.name);
                    let spot = Spot::EndOf(class.syntax().clone());
                    let edit = insert_member(&spot, &member);
                    (member, [(Place { file, span: edit.span }, edit.insert)])
                };
                let supers = self.document.classes[id].supers.clone();
                let says = |s: &&kernel::Superclass| {
                    self.document.is_a(s.class, a) || self.document.is_a(s.class, b)
                };
                let diagnostic = Diagnostic::error("conflict", Place { file, span }, message);
                let fixed = supers.iter().filter(says).map(way);
                let diagnostic = fixed.fold(diagnostic, |d, (title, edits)| d.fix(title, edits));
                let diagnostic =
                    diagnostic.hint(hint).label(place(a), "here").label(place(b), "and here");
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
                let general = self.defined_message(self.object, &m.name);
                let combined = general.is_some_and(|m| m.is_combining);
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
