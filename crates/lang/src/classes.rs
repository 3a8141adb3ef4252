//! Classes: the language's own, those of every text, and those made of others.

use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use expr::dimension::Dimension;
use kernel::{Class, ClassId, ClassKind, Count, MOST_THINGS, OriginId, Primitive, Superclass};
use std::collections::BTreeMap;
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Member, TypeShape};

/// How many superclasses a class may name: what it inherits is looked up in all of them.
const MOST_BESIDE: usize = 200;

/// How many superclasses may stand one above the other: what a class inherits is looked up along them.
const MOST_ABOVE: usize = 1000;

impl Lowerer<'_> {
    /// Makes the language's own classes.
    pub(crate) fn own_classes(&mut self) {
        let nowhere = self.origins.add(Place { file: OWN, span: Span::default() });
        self.object = self.add_class("Object", ClassKind::Composite, &[], nowhere);
        self.visible.add_own("Object".into(), self.object);
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
            (!matches!(name, "Real" | "Angle")).then_some((name, Primitive::Real(dimension)))
        });
        for (name, primitive) in primitives.into_iter().chain(quantities) {
            let object = self.object;
            let class = self.add_class(name, ClassKind::Primitive(primitive), &[object], nowhere);
            self.visible.add_own(name.into(), class);
        }
    }

    pub(crate) fn add_class(
        &mut self,
        name: &str,
        kind: ClassKind,
        supers: &[ClassId],
        origin: OriginId,
    ) -> ClassId {
        let nameless = |&class: &ClassId| Superclass { class, name: Name::new("") };
        let supers = supers.iter().map(nameless).collect();
        let class = Class::new(name.into(), kind, supers, origin);
        self.document.classes.push(class)
    }

    /// Adds a class that no text can name: of one thing, of the document, of a check.
    pub(crate) fn add_unnamed_class(
        &mut self,
        name: &str,
        above: ClassId,
        origin: OriginId,
    ) -> ClassId {
        self.add_class(name, ClassKind::Composite, &[above], origin)
    }

    /// Names every class of every file, then finds superclasses.
    pub(crate) fn declare_classes(&mut self) {
        for file in self.order.clone() {
            let kinds = [SyntaxKind::Class, SyntaxKind::Program, SyntaxKind::Choice];
            for member in self.files[file].members_of(&kinds) {
                let (name, doc) = match &member {
                    Member::Choice(choice) => {
                        self.declare_choice_class(file, choice);
                        continue;
                    }
                    Member::Class(class) => (class.name(), class.doc()),
                    Member::Program(program) => (program.name(), program.doc()),
                    _ => continue,
                };
                let Some(name) = name else { continue };
                let origin = self.origin(file, member.span());
                if self.visible.declared(file, name.text()).is_some() {
                    let message = format!("there is a class {} already", name.text());
                    self.error("duplicate-name", file, name.span(), message);
                    continue;
                }
                let id = self.add_class(name.text(), ClassKind::Composite, &[], origin);
                self.visible.add(file, name.name(), id);
                self.document.classes[id].doc = doc.unwrap_or_default();
                match member {
                    Member::Class(class) => {
                        self.document.classes[id].is_abstract = class.is_abstract();
                        self.declared.push((id, file, class));
                    }
                    Member::Program(program) => {
                        self.document.classes[id].is_abstract = program.is_abstract();
                        self.programs.add(id, file, program);
                    }
                    _ => {}
                }
            }
        }
        for (id, file, program) in self.programs.declared() {
            let supers = program.superclasses().collect::<Vec<_>>();
            if let Some(above) = supers.first() {
                let message = "a program has no superclasses".to_string();
                self.error("primitive-superclass", file, above.span(), message);
            }
            let above = Superclass { class: self.object, name: Name::new("") };
            self.document.classes[id].supers = vec![above];
        }
        for (id, file, class) in self.declared.clone() {
            let mut supers: Vec<Superclass> = Vec::new();
            let only = class.superclasses().count() == 1;
            for above in class.superclasses() {
                if supers.len() >= MOST_BESIDE {
                    let what = class.name().map_or_else(String::new, |w| w.text().to_string());
                    let message = format!("{what} has more than {MOST_BESIDE} superclasses");
                    self.error("too-many-superclasses", file, above.span(), message);
                    break;
                }
                let Some(ty) = above.class() else { continue };
                let Some(class) = self.class_of_type(&Scope::of(file, self.object), &ty) else {
                    continue;
                };
                if self.document.classes[class].kind != ClassKind::Composite {
                    let what = &self.document.classes[class].name;
                    let message = format!("{what} has no parts to inherit: it is a kind of value");
                    self.error("primitive-superclass", file, ty.span(), message);
                    continue;
                }
                let name = match above.alias() {
                    Some(alias) => alias.name(),
                    None if only => Name::new(""),
                    None => small_first(&self.document.classes[class].name),
                };
                if supers.iter().any(|s| s.name == name) {
                    let message = format!("there is a superclass {name} already");
                    let d = Diagnostic::error(
                        "duplicate-name",
                        Place { file, span: above.span() },
                        message,
                    );
                    self.report(d.hint("tell them apart: `is A as a, A as b`"));
                    continue;
                }
                supers.push(Superclass { class, name });
            }
            if supers.is_empty() {
                supers.push(Superclass { class: self.object, name: Name::new("") });
            }
            self.primary_names.extend(supers.first().map(|s| s.name.clone()));
            self.document.classes[id].supers = supers;
        }
        self.break_cycles();
    }

    /// Superclasses in a ring are reported, and the class that closes it is an Object.
    ///
    /// One visit of every class, superclasses first.
    fn break_cycles(&mut self) {
        let declared = self.declared.clone();
        let index: BTreeMap<ClassId, usize> =
            declared.iter().enumerate().map(|(i, (id, _, _))| (*id, i)).collect();
        let mut visits = vec![Visit::Not; declared.len()];
        let mut heights = vec![0; declared.len()];
        for first in 0..declared.len() {
            // each class on the way up, with the superclasses that are still to be visited
            let mut way: Vec<(usize, Vec<usize>)> = Vec::new();
            let mut next = (visits[first] == Visit::Not).then_some(first);
            loop {
                if let Some(i) = next.take() {
                    visits[i] = Visit::OnTheWay;
                    let above = self.document.classes[declared[i].0].supers.iter().rev();
                    way.push((i, above.filter_map(|s| index.get(&s.class).copied()).collect()));
                }
                let Some((at, above)) = way.last_mut() else { break };
                match above.pop().map(|i| (i, visits[i])) {
                    None => {
                        visits[*at] = Visit::Done;
                        heights[*at] = self.height(&declared[*at], &index, &heights);
                        way.pop();
                    }
                    Some((i, Visit::Not)) => next = Some(i),
                    Some((i, Visit::OnTheWay)) => self.break_cycle(&declared[i]),
                    Some((_, Visit::Done)) => {}
                }
            }
        }
    }

    /// Returns how many classes stand one above the other over a class; one with too many is cut off from them.
    fn height(
        &mut self,
        (id, file, class): &(ClassId, FileId, ast::Class),
        index: &BTreeMap<ClassId, usize>,
        heights: &[usize],
    ) -> usize {
        let above = self.document.classes[*id].supers.iter().filter_map(|s| index.get(&s.class));
        let height = above.map(|&i| heights[i] + 1).max().unwrap_or(0);
        if height <= MOST_ABOVE {
            return height;
        }
        // those below it would say the same once more
        if height == MOST_ABOVE + 1 {
            let what = &self.document.classes[*id].name;
            let message =
                format!("{what} has more than {MOST_ABOVE} superclasses one above the other");
            let span = class.name().map_or(class.span(), |n| n.span());
            self.error("too-many-superclasses", *file, span, message);
        }
        let name = Name::new("");
        self.document.classes[*id].supers = vec![Superclass { class: self.object, name }];
        height
    }

    fn break_cycle(&mut self, (id, file, class): &(ClassId, FileId, ast::Class)) {
        let span = class.name().map_or(class.span(), |n| n.span());
        let name = self.document.classes[*id].name.clone();
        let message = format!("{name} is its own superclass, by way of the classes above it");
        self.error("superclass-cycle", *file, span, message);
        let name = Name::new("");
        self.document.classes[*id].supers = vec![Superclass { class: self.object, name }];
    }

    /// Returns the class that a type names; reports what it does not find.
    pub(crate) fn class_of_type(&mut self, scope: &Scope, ty: &ast::Type) -> Option<ClassId> {
        let file = scope.file;
        match ty.shape() {
            TypeShape::Named(words) => self.class_of_words(file, &words),
            TypeShape::List { element, .. } => {
                let element = self.class_of_element(scope, &element?)?;
                Some(self.class_made_of("List of", ClassKind::List(element), element))
            }
            TypeShape::Set(element) => {
                let element = self.class_of_type(scope, &element?)?;
                Some(self.class_made_of("Set of", ClassKind::Set(element), element))
            }
            TypeShape::Path(to) => {
                let to = self.class_of_type(scope, &to?)?;
                Some(self.reference_to(to))
            }
            TypeShape::Placed(master) => {
                let master = self.class_of_type(scope, &master?)?;
                self.placed_class(file, ty.span(), master)
            }
        }
    }

    /// Returns the class that names between dots lead to; reports where there is none.
    pub(crate) fn class_of_words(&mut self, file: FileId, words: &[ast::Word]) -> Option<ClassId> {
        let (word, from) = words.split_last()?;
        if !from.is_empty() {
            return self.class_of_text(file, from, word);
        }
        let found = self.class_meant(file, word)?;
        if found.is_none() {
            let message = format!("there is no class {}", word.text());
            let place = Place { file, span: word.span() };
            let mut d = Diagnostic::error("unknown-class", place, message);
            let names = self.visible.names(file).map(Name::as_str);
            let near = self.nearest(word.text(), names);
            if let Some(near) = called_otherwise(word.text()).or(near) {
                d = d.meant(near);
            } else {
                let is_list =
                    ["list", "array", "vector"].iter().any(|w| word.text().eq_ignore_ascii_case(w));
                let is_unit = expr::units::unit(word.text()).is_some();
                d = d.hint(match is_list {
                    true => "a list is written `List of Real`, `List of 3 Real`",
                    false if is_unit => "a unit stands behind a number, `3 mm`, and that of the sheet in a line of its own: `unit mm`",
                    false => "declare it, or `use` the library that has it",
                });
            }
            self.report(d);
        }
        found
    }

    /// Says of an unknown class of a part, by the unit that its value has, which one there is: `5 kN/m` is a Stiffness.
    pub(crate) fn hint_class(&mut self, before: usize, value: Option<ast::Expr>) {
        let unit = value.as_ref().and_then(crate::numbers::unit_of);
        let known = unit.as_ref().and_then(|unit| expr::units::unit(unit));
        let (Some(unit), Some(known)) = (unit, known) else { return };
        let Some(d) = self.diagnostics.get_mut(before).filter(|d| d.code == "unknown-class") else {
            return;
        };
        let meant =
            d.fixes.first().and_then(|fix| fix.edits.first()).map(|(_, name)| name.as_str());
        if meant.and_then(Dimension::by_name) == Some(known.dimension) {
            return;
        }
        let plain = Diagnostic::error(d.code, d.place, d.message.clone());
        *d = match known.dimension.named() {
            Some(class) => {
                plain.hint(format!("what has the unit `{unit}` is of the class {class}"))
            }
            None => plain.hint(format!(
                "no class is named for the unit `{unit}`: `name => {}` keeps it",
                value.map(|value| value.syntax().text().to_string()).unwrap_or_default()
            )),
        };
    }

    /// Returns the class that a bare name means in a text, if it is one; nothing where several texts that are used
    /// declare it, which is reported.
    pub(crate) fn class_meant(
        &mut self,
        file: FileId,
        word: &ast::Word,
    ) -> Option<Option<ClassId>> {
        let rivals = self.visible.rivals(file, word.text());
        if rivals.is_empty() {
            return Some(self.visible.class(file, word.text()));
        }
        let mut texts: Vec<&str> = rivals.iter().map(|&f| self.files[f].name.as_str()).collect();
        texts.sort_unstable();
        let name = word.text();
        let message = format!("{name} is a class of {}", texts.join(" and of "));
        let written = texts.iter().map(|text| format!("`{text}.{name}`")).collect::<Vec<String>>();
        let hint = format!("say which one: {}", written.join(" or "));
        let place = Place { file, span: word.span() };
        self.report(Diagnostic::error("ambiguous-class", place, message).hint(hint));
        None
    }

    /// Returns the text of this name that a text uses: by the whole of it, or its last word.
    pub(crate) fn text_named(&self, file: FileId, name: &str) -> Option<FileId> {
        let is_named = |f: &FileId| {
            let whole = self.files[*f].name.as_str();
            whole == name || whole.rsplit('.').next() == Some(name)
        };
        self.visible.used(file).find(is_named)
    }

    /// Returns the class of another text: `trusses.Joint`.
    fn class_of_text(
        &mut self,
        file: FileId,
        from: &[ast::Word],
        word: &ast::Word,
    ) -> Option<ClassId> {
        let name = from.iter().map(ast::Word::text).collect::<Vec<&str>>().join(".");
        let first = from.first()?;
        let Some(text) = self.text_named(file, &name) else {
            let message = format!("{name} is no text that is used here");
            let place = Place { file, span: first.span() };
            let d = Diagnostic::error("unknown-class", place, message);
            self.report(d.hint(format!("write `use {name}` first")));
            return None;
        };
        let found = self.visible.declared(text, word.text());
        if found.is_none() {
            let message = format!("{name} has no class {}", word.text());
            let place = Place { file, span: word.span() };
            let mut d = Diagnostic::error("unknown-class", place, message);
            let names: Vec<String> = self.visible.names(text).map(ToString::to_string).collect();
            if let Some(near) = self.nearest(word.text(), names.iter().map(String::as_str)) {
                d = d.meant(near);
            }
            self.report(d);
        }
        found
    }

    /// Returns the class of a list's elements; of lists in it, one that says how long they are.
    pub(crate) fn class_of_element(&mut self, scope: &Scope, ty: &ast::Type) -> Option<ClassId> {
        let class = self.class_of_type(scope, ty)?;
        let count = self.declared_count(scope, ty);
        match (self.document.classes[class].kind.clone(), count) {
            (ClassKind::List(element), Some(Count::Fixed(n))) => Some(self.counted(element, n)),
            _ => Some(class),
        }
    }

    /// Returns the class of lists of so many elements.
    pub(crate) fn counted(&mut self, element: ClassId, count: u32) -> ClassId {
        if let Some(&known) = self.counted.get(&(element, count)) {
            return known;
        }
        let name = format!("List of {count} {}", self.document.classes[element].name);
        let object = self.object;
        let origin = self.document.classes[object].origin;
        let class = self.add_class(&name, ClassKind::List(element), &[object], origin);
        self.document.classes[class].count = Some(count);
        self.counted.insert((element, count), class);
        class
    }

    /// Returns the class of parts that name a thing of a class.
    pub(crate) fn reference_to(&mut self, to: ClassId) -> ClassId {
        self.class_made_of("Path to", ClassKind::Reference(to), to)
    }

    pub(crate) fn class_made_of(
        &mut self,
        word: &'static str,
        kind: ClassKind,
        element: ClassId,
    ) -> ClassId {
        if let Some(&known) = self.made.get(&(word, element)) {
            return known;
        }
        let name = format!("{word} {}", self.document.classes[element].name);
        let object = self.object;
        let origin = self.document.classes[object].origin;
        let class = self.add_class(&name, kind, &[object], origin);
        self.made.insert((word, element), class);
        class
    }

    pub(crate) fn declared_count(&mut self, scope: &Scope, ty: &ast::Type) -> Option<Count> {
        let TypeShape::List { count, .. } = ty.shape() else { return None };
        let Some(count) = count else { return Some(Count::Given) };
        match self.constant(scope, &count).filter(|n| *n >= 0) {
            Some(n) if n <= MOST_THINGS as i64 => Some(Count::Fixed(n as u32)),
            Some(n) => {
                let message = format!("{n} elements are more things than a document may have");
                self.error("too-many-things", scope.file, count.span(), message);
                Some(Count::Fixed(0))
            }
            None => {
                let message =
                    "a list's count is a whole number, known as the text stands".to_string();
                let place = Place { file: scope.file, span: count.span() };
                let d = Diagnostic::error("not-a-count", place, message);
                self.report(d.hint("write a number, or a name that has one: `n: Integer = 3`"));
                Some(Count::Fixed(0))
            }
        }
    }
}

/// How far a class has been visited on the way up.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Visit {
    Not,
    OnTheWay,
    Done,
}

/// Returns a name with a small first letter.
pub(crate) fn small_first(name: &str) -> Name {
    let mut letters = name.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_lowercase).collect();
    Name::new(&(first + letters.as_str()))
}

/// Returns the primitive class that other languages, or people who speak of what they measure, call by this name.
fn called_otherwise(name: &str) -> Option<&'static str> {
    match name.to_ascii_lowercase().as_str() {
        "boolean" => Some("Bool"),
        "number" | "num" | "float" | "double" | "decimal" | "percent" | "percentage" | "ratio"
        | "fraction" | "probability" | "money" | "currency" | "price" | "strain" => Some("Real"),
        "int" | "count" => Some("Integer"),
        "width" | "height" | "depth" | "thickness" | "radius" | "diameter" => Some("Length"),
        "duration" | "period" => Some("Time"),
        "degree" | "degrees" | "radians" => Some("Angle"),
        "heat" => Some("Energy"),
        "flow" | "flowrate" => Some("VolumeFlow"),
        "amountofsubstance" | "moles" => Some("Amount"),
        "molarity" => Some("Concentration"),
        "string" | "str" => Some("Text"),
        "colour" => Some("Color"),
        _ => None,
    }
}
