//! Lowering: a text in, a document out, with everything that is wrong.
//!
//! Classes may be used before they are declared, so it goes in rounds: files are read and their
//! classes named; superclasses are found; parts and messages are declared; at last everything that
//! speaks of parts is lowered.

use crate::checks::{self, Check};
use crate::kinds::Kind;
use crate::members::Pending;
use crate::origins::Origins;
use crate::restore::Patch;
use crate::scope::Scope;
use base::{Diagnostic, FileId, IdVec, Name, Place, Severity, Span};
use expr::dimension::Dimension;
use kernel::{
    Class, ClassId, ClassKind, Document, Fault, OriginId, Primitive, Superclass, Vertical,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use syntax::Parse;
use syntax::ast::{self, AstNode, Member};

/// A text that a document is made of.
#[derive(Clone, Debug)]
pub struct File {
    /// What `use` calls it; empty for the document itself.
    pub name: String,
    /// The text.
    pub text: Rc<str>,
    /// Its tree.
    pub parse: Parse,
}

/// What a text means.
#[derive(Clone, Debug)]
pub struct Lowered {
    /// The classes, and the document's own.
    pub document: Document,
    /// The `check` blocks of the document's own text.
    pub checks: Vec<Check>,
    /// Where every member was written.
    pub origins: Origins,
    /// What is wrong, in no particular order.
    pub diagnostics: Vec<Diagnostic>,
    /// What the first `///` of the text says.
    pub doc: String,
    /// The texts; the document's own is the first.
    pub files: IdVec<FileId, File>,
    /// The text with what members with an error said before; equal to the text without errors.
    pub(crate) effective: Rc<str>,
    /// Where the effective text differs from the text.
    pub(crate) patches: Vec<Patch>,
    pub(crate) classes_of_one: BTreeSet<ClassId>,
    /// Where the document's own text declares classes.
    pub(crate) class_spans: Vec<Span>,
}

/// The document's own text.
pub(crate) const OWN: FileId = FileId(0);

/// Finds out what a text means. Never fails: what cannot be lowered is left out and reported.
///
/// `load` returns the text of what `use` names. `before` is what an earlier text meant: where a
/// member has an error, what it said there stays in force.
pub fn lower(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    before: Option<&Lowered>,
) -> Lowered {
    let first = lower_text(text, load);
    let wrong = |l: &Lowered| l.diagnostics.iter().any(|d| d.severity == Severity::Error);
    let Some(before) = before.filter(|_| wrong(&first)) else { return first };
    // Members with an error are read as they were when they last had none.
    let (patched, patches) = crate::restore::restore(&first, &before.effective);
    let mut second = lower_text(&patched, load);
    if wrong(&second) {
        return first;
    }
    second.files[OWN] = first.files[OWN].clone();
    second.diagnostics = first.diagnostics;
    second.patches = patches;
    second
}

pub(crate) fn lower_text(text: &str, load: &dyn Fn(&str) -> Option<String>) -> Lowered {
    let mut l = Lowerer::new(load);
    l.read("", text);
    l.declare_classes();
    l.make_root();
    l.declare_members();
    l.define_members();
    let checks = checks::lower(&mut l);
    l.report_conflicts();
    let own = l.files[OWN].parse.file();
    let doc = own.members().find_map(|m| m.doc()).unwrap_or_default();
    Lowered {
        document: l.document,
        checks,
        origins: l.origins,
        diagnostics: l.diagnostics,
        doc,
        effective: text.into(),
        patches: Vec::new(),
        files: l.files,
        classes_of_one: l.classes_of_one,
        class_spans: own
            .members()
            .filter_map(|m| matches!(m, Member::Class(_)).then(|| m.syntax().clone()))
            .map(|n| syntax::span_of(&n))
            .collect(),
    }
}

pub(crate) struct Lowerer<'l> {
    load: &'l dyn Fn(&str) -> Option<String>,
    pub(crate) files: IdVec<FileId, File>,
    reading: Vec<String>,
    /// Files after those that they use; the document last.
    order: Vec<FileId>,
    pub(crate) document: Document,
    pub(crate) names: BTreeMap<Name, ClassId>,
    pub(crate) origins: Origins,
    pub(crate) diagnostics: Vec<Diagnostic>,
    pub(crate) object: ClassId,
    pub(crate) classes_of_one: BTreeSet<ClassId>,
    /// Members whose expressions are still to be lowered.
    pub(crate) pending: Vec<Pending>,
    /// Definitions of messages, by class and name, with the scope they stand in.
    pub(crate) definitions: BTreeMap<(ClassId, Name), (ast::Expr, Scope)>,
    /// What messages are worth, once known; nothing while it is being found out.
    pub(crate) message_kinds: BTreeMap<(ClassId, Name), Option<Kind>>,
    /// While positive, nothing is reported.
    pub(crate) silent: u32,
    declared: Vec<(ClassId, FileId, ast::Class)>,
}

impl<'l> Lowerer<'l> {
    fn new(load: &'l dyn Fn(&str) -> Option<String>) -> Self {
        let mut l = Self {
            load,
            files: IdVec::new(),
            reading: Vec::new(),
            order: Vec::new(),
            document: Document {
                classes: IdVec::new(),
                root: ClassId(0),
                vertical: Vertical::Up,
                units_per_metre: 1.0,
            },
            names: BTreeMap::new(),
            origins: Origins::default(),
            diagnostics: Vec::new(),
            object: ClassId(0),
            classes_of_one: BTreeSet::new(),
            pending: Vec::new(),
            definitions: BTreeMap::new(),
            message_kinds: BTreeMap::new(),
            silent: 0,
            declared: Vec::new(),
        };
        l.own_classes();
        l
    }

    /// Makes the language's own classes.
    fn own_classes(&mut self) {
        let nowhere = self.origins.add(Place { file: OWN, span: Span::default() });
        self.object = self.add_class("Object", ClassKind::Composite, &[], nowhere);
        let primitives = [
            ("Real", Primitive::Real(Dimension::NONE)),
            ("Angle", Primitive::Real(Dimension::NONE)),
            ("Integer", Primitive::Integer),
            ("Bool", Primitive::Bool),
            ("Text", Primitive::Text),
            ("Color", Primitive::Color),
        ];
        let quantities = Dimension::names().filter_map(|name| {
            let dimension = Dimension::by_name(name)?;
            (!dimension.is_none()).then_some((name, Primitive::Real(dimension)))
        });
        for (name, primitive) in primitives.into_iter().chain(quantities) {
            let object = self.object;
            self.add_class(name, ClassKind::Primitive(primitive), &[object], nowhere);
        }
    }

    pub(crate) fn add_class(
        &mut self,
        name: &str,
        kind: ClassKind,
        supers: &[ClassId],
        origin: OriginId,
    ) -> ClassId {
        let supers = supers.iter().map(|&class| {
            let name = small_first(&self.document.classes[class].name);
            Superclass { class, name }
        });
        let class = Class {
            name: name.into(),
            doc: String::new(),
            kind,
            supers: supers.collect(),
            is_abstract: false,
            parts: Vec::new(),
            givens: Vec::new(),
            messages: Vec::new(),
            constraints: Vec::new(),
            merges: Vec::new(),
            inserts: Vec::new(),
            stays: Vec::new(),
            attachers: Vec::new(),
            without: Vec::new(),
            origin,
        };
        let id = self.document.classes.push(class);
        self.names.entry(name.into()).or_insert(id);
        id
    }

    pub(crate) fn origin(&mut self, file: FileId, span: Span) -> OriginId {
        self.origins.add(Place { file, span })
    }

    pub(crate) fn report(&mut self, diagnostic: Diagnostic) {
        if self.silent == 0 && !self.diagnostics.contains(&diagnostic) {
            self.diagnostics.push(diagnostic);
        }
    }
    pub(crate) fn error(&mut self, code: &'static str, file: FileId, span: Span, message: String) {
        self.report(Diagnostic::error(code, Place { file, span }, message));
    }
    /// Reports what the language has and this version does not.
    pub(crate) fn not_yet(&mut self, file: FileId, span: Span, what: &str) {
        let d =
            Diagnostic::error("not-yet", Place { file, span }, format!("{what} not supported yet"));
        self.report(d.hint("the rest of the document works without it"));
    }

    /// Reads a text and what it uses.
    fn read(&mut self, name: &str, text: &str) {
        let id = self.files.next_id();
        let parse = syntax::parse(id, text);
        self.diagnostics.extend(parse.diagnostics().iter().cloned());
        self.files.push(File { name: name.into(), text: text.into(), parse: parse.clone() });
        self.reading.push(name.into());
        for member in parse.file().members() {
            match member {
                Member::Use(used) => self.read_used(id, &used),
                Member::Unit(unit) if id == OWN => self.set_unit(&unit),
                Member::Y(y) if id == OWN => {
                    self.document.vertical =
                        if y.is_down() { Vertical::Down } else { Vertical::Up };
                }
                _ => {}
            }
        }
        self.reading.pop();
        self.order.push(id);
    }

    fn read_used(&mut self, file: FileId, used: &ast::Use) {
        let Some(path) = used.path() else { return };
        let words: Vec<_> = path.segments().map(|w| w.text().to_string()).collect();
        let name = words.join(".");
        if self.reading.contains(&name) || self.files.iter().any(|(_, f)| f.name == name) {
            return;
        }
        match (self.load)(&name) {
            Some(text) => self.read(&name, &text),
            None => {
                let message =
                    format!("there is no library and no file beside this one named {name}");
                self.error("missing-file", file, path.span(), message);
            }
        }
    }

    fn set_unit(&mut self, line: &ast::UnitLine) {
        let spelling = line.unit();
        match expr::units::read_quantity("1", &spelling) {
            Some((metres, Dimension::LENGTH)) => {
                // 1 mm is 0.001 m; the factor is exact the other way round.
                self.document.units_per_metre = (1.0 / metres).round().max(1.0 / metres);
            }
            Some(_) | None => {
                let message = format!("{spelling} is no unit of length");
                self.error("unknown-unit", OWN, line.span(), message);
            }
        }
    }

    /// Names every class of every file, then finds superclasses.
    fn declare_classes(&mut self) {
        for file in self.order.clone() {
            for member in self.files[file].parse.file().members() {
                let Member::Class(class) = member else { continue };
                let Some(name) = class.name() else { continue };
                let origin = self.origin(file, class.span());
                if let Some(&known) = self.names.get(&name.name()) {
                    let place = self.origins.place(self.document.classes[known].origin);
                    if place.file == file && place.span != Span::default() {
                        let message = format!("there is a class {} already", name.text());
                        self.error("duplicate-name", file, name.span(), message);
                        continue;
                    }
                }
                let id = self.add_class(name.text(), ClassKind::Composite, &[], origin);
                self.names.insert(name.name(), id);
                self.document.classes[id].doc = class.doc().unwrap_or_default();
                self.document.classes[id].is_abstract = class.is_abstract();
                self.declared.push((id, file, class));
            }
        }
        for (id, file, class) in self.declared.clone() {
            let mut supers: Vec<Superclass> = Vec::new();
            for above in class.superclasses() {
                let Some(ty) = above.class() else { continue };
                let Some(class) = self.class_of_type(file, &ty) else { continue };
                let name = match above.alias() {
                    Some(alias) => alias.name(),
                    None => small_first(&self.document.classes[class].name),
                };
                supers.push(Superclass { class, name });
            }
            if supers.is_empty() {
                supers.push(Superclass { class: self.object, name: "object".into() });
            }
            self.document.classes[id].supers = supers;
        }
        self.break_cycles();
    }

    /// Superclasses in a ring are reported, and the class that closes it is an Object.
    fn break_cycles(&mut self) {
        for (id, file, class) in self.declared.clone() {
            let mut above: Vec<ClassId> =
                self.document.classes[id].supers.iter().map(|s| s.class).collect();
            let mut seen = BTreeSet::new();
            while let Some(next) = above.pop() {
                if next == id {
                    let span = class.name().map_or(class.span(), |n| n.span());
                    let name = self.document.classes[id].name.clone();
                    let message =
                        format!("{name} is its own superclass, by way of the classes above it");
                    self.error("superclass-cycle", file, span, message);
                    let name = Name::new("object");
                    self.document.classes[id].supers =
                        vec![Superclass { class: self.object, name }];
                    break;
                }
                if seen.insert(next) {
                    above.extend(self.document.classes[next].supers.iter().map(|s| s.class));
                }
            }
        }
    }

    fn make_root(&mut self) {
        let end = self.files[OWN].text.len() as u32;
        let origin = self.origin(OWN, Span::new(0, end));
        let object = self.object;
        self.document.root = self.document.classes.next_id();
        self.add_class("", ClassKind::Composite, &[object], origin);
        self.names.remove("");
    }

    /// Declares parts and messages of all classes, and of the document.
    fn declare_members(&mut self) {
        for (id, file, class) in self.declared.clone() {
            let members = class.body().into_iter().flat_map(|b| b.members()).collect();
            self.declare_body(&Scope::of(file, id), members);
        }
        let own = self.files[OWN].parse.file().members().collect();
        self.declare_body(&Scope::of(OWN, self.document.root), own);
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
                    let defined = self.message(c, &name).map(|m| m.origin);
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
        let answer = |c: ClassId, name: &Name| self.message(c, name).map(|m| m.answer.clone());
        let conflict = |(name, classes): (Name, Vec<ClassId>)| {
            let first = *classes.first()?;
            let differs =
                |c: &ClassId| !related(first, *c) && answer(first, &name) != answer(*c, &name);
            let other = *classes.iter().find(|c| differs(c))?;
            self.message(id, &name).is_none().then_some((name, first, other))
        };
        found.into_iter().filter_map(conflict).collect()
    }

    /// Returns a class's own definition of a message.
    pub(crate) fn message(&self, class: ClassId, name: &Name) -> Option<&kernel::Message> {
        self.document.classes[class].messages.iter().rev().find(|m| m.name == *name)
    }
}

/// Returns a name with a small first letter.
pub(crate) fn small_first(name: &str) -> Name {
    let mut letters = name.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_lowercase).collect();
    Name::new(&(first + letters.as_str()))
}

impl Lowered {
    /// Turns faults of the structure into diagnostics at the members that they come from.
    pub fn fault_diagnostics(&self, faults: &[Fault]) -> Vec<Diagnostic> {
        let diagnostic =
            |f: &Fault| Diagnostic::error(f.kind.code(), self.place(f.origin), f.message.clone());
        faults.iter().map(diagnostic).collect()
    }
    /// Returns where a member stands; one that is read as it was before, where it stood.
    pub fn place(&self, origin: OriginId) -> Place {
        let place = self.origins.place(origin);
        let span = (place.file == OWN).then(|| self.in_text(place.span)).flatten();
        Place { span: span.unwrap_or(place.span), ..place }
    }
    /// Returns the bytes of the text for bytes of the effective text, unless they were patched.
    pub(crate) fn in_text(&self, span: Span) -> Option<Span> {
        let mut shift: i64 = 0;
        for patch in &self.patches {
            if patch.effective.end <= span.start {
                shift = i64::from(patch.text.end) - i64::from(patch.effective.end);
            } else if patch.effective.start < span.end {
                return None;
            }
        }
        let moved = |at: u32| u32::try_from(i64::from(at) + shift).ok();
        Some(Span::new(moved(span.start)?, moved(span.end)?))
    }
    /// Returns the bytes of a member that stands in the document's own text.
    pub fn own_span(&self, origin: OriginId) -> Option<Span> {
        let place = self.origins.place(origin);
        let own = place.file == OWN && place.span != Span::default();
        own.then(|| self.in_text(place.span)).flatten()
    }
    /// Returns what was written for a member, without its comments.
    pub fn source_of(&self, origin: OriginId) -> String {
        let place = self.origins.place(origin);
        let text = if place.file == OWN { &self.effective } else { &self.files[place.file].text };
        text.get(place.span.range()).unwrap_or_default().trim().to_string()
    }
    /// Returns true if a given value was written for a thing of the document, not for a class.
    pub fn is_own_given(&self, origin: OriginId) -> bool {
        let place = self.origins.place(origin);
        let in_class = |s: &Span| s.start <= place.span.start && place.span.end <= s.end;
        place.file == OWN && !self.class_spans.iter().any(in_class)
    }
    /// Returns true if a class is that of a single part.
    pub fn is_class_of_one(&self, class: ClassId) -> bool {
        self.classes_of_one.contains(&class)
    }
}
