//! Files: the document's text and those that it uses, read and put in order.

use crate::hints;
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use crate::tables;
use base::{Diagnostic, FileId, Name, Place};
use expr::dimension::Dimension;
use kernel::{ClassId, OriginId, Part, Step, Vertical};
use std::cell::LazyCell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use syntax::ast::{self, AstNode, Member};
use syntax::{Parse, SyntaxKind, SyntaxNode, SyntaxToken};

/// A text that a document is made of.
#[derive(Clone, Debug)]
pub struct File {
    /// What `use` calls it; empty for the document itself, and for what every thing answers.
    pub name: String,
    /// The text.
    pub text: Rc<str>,
    /// Its tree; an empty one of a table.
    pub parse: Parse,
    /// What is in it where it is a table and no text of the language, or why it cannot be read.
    pub table: Option<tables::Reading>,
}

/// A text, and one whose things it has by using it.
pub(crate) type Use = (FileId, FileId);

/// The parts that are the things of used texts, by class and name.
pub(crate) type UsedParts = BTreeMap<(ClassId, Name), Use>;

/// What every thing answers, in the language itself.
const OBJECT: &str = include_str!("object.thing");

impl File {
    /// Returns true for a table: what is used is a text of the language.
    pub fn is_table(&self) -> bool {
        self.table.is_some()
    }
    /// Returns the members at the top of the text that are of these kinds.
    pub(crate) fn members_of(&self, kinds: &[SyntaxKind]) -> Vec<Member> {
        let file = self.parse.file();
        let of_kinds = self.parse.outline().filter(|(kind, _)| kinds.contains(kind));
        of_kinds.filter_map(|(_, span)| file.member_at(span)).collect()
    }
}

impl Lowerer<'_> {
    /// Declares what every thing answers.
    pub(crate) fn declare_object(&mut self) {
        let id = self.files.next_id();
        let parse = self.parse(id, "", OBJECT);
        let classes = parse.file().members().filter_map(|m| match m {
            Member::Class(class) => class.body(),
            _ => None,
        });
        let members = classes.flat_map(|body| body.members()).collect();
        self.files.push(File {
            name: String::new(),
            text: OBJECT.into(),
            parse: parse.clone(),
            table: None,
        });
        self.declare_body(&Scope::of(id, self.object), members);
    }

    /// Parses a text; what is as it was before is not parsed again.
    fn parse(&mut self, id: FileId, name: &str, text: &str) -> Parse {
        let Some(before) = self.before else { return syntax::parse(id, text) };
        if id == OWN {
            let again = syntax::reparse(id, &before.effective_parse, &before.effective, text);
            self.changed = again.changed;
            return again.parse;
        }
        let known =
            before.files.get(id).filter(|f| f.name == name && !f.is_table() && *f.text == *text);
        known.map_or_else(|| syntax::parse(id, text), |f| f.parse.clone())
    }

    /// Reads a text and what it uses, whose texts `load` returns by their names; returns its id.
    pub(crate) fn read(
        &mut self,
        load: &dyn Fn(&str) -> Option<String>,
        name: &str,
        text: &str,
    ) -> FileId {
        let id = self.files.next_id();
        let parse = self.parse(id, name, text);
        let parts = LazyCell::new(|| names_of_parts(&parse));
        for diagnostic in parse.diagnostics() {
            self.report(match word_for_unit(&parse, diagnostic) {
                Some(word) => {
                    let place = Place { file: id, span: syntax::span_of_token(&word) };
                    let is_adjacent =
                        word.prev_token().is_some_and(|t| t.kind() == SyntaxKind::Number);
                    let rest = text.get(place.span.end as usize..).unwrap_or_default();
                    let compares = rest.trim_start_matches(' ').starts_with(['<', '>', '=']);
                    match (parts.contains(word.text()), is_adjacent) {
                        (true, true) => hints::product_without_sign(place, word.text()),
                        (true, false) if compares => {
                            hints::comparison_without_and(place, word.text())
                        }
                        _ => hints::unknown_unit(place, word.text()),
                    }
                }
                None => diagnostic.clone(),
            });
        }
        self.warn_of_quotients(id, text, &parse);
        self.files.push(File { name: name.into(), text: text.into(), parse, table: None });
        self.reading.push(id);
        let kinds = [SyntaxKind::Use, SyntaxKind::UnitLine, SyntaxKind::YLine];
        for member in self.files[id].members_of(&kinds) {
            match member {
                Member::Use(used) => self.read_used(load, id, &used),
                Member::Unit(unit) if id == OWN => self.set_unit(&unit),
                Member::Y(y) if id == OWN => {
                    self.document.vertical =
                        if y.is_down() { Vertical::Down } else { Vertical::Up };
                }
                _ => {}
            }
        }
        self.read_tables(load, id);
        self.reading.pop();
        self.order.push(id);
        id
    }

    fn read_used(&mut self, load: &dyn Fn(&str) -> Option<String>, file: FileId, used: &ast::Use) {
        let Some(path) = used.path() else { return };
        let name = name_of(&path);
        if tables::is_name(&name) {
            let place = Place { file, span: path.span() };
            let message = format!("{name} is a table, and no text of the language");
            let hint =
                format!("say a column of it where values are allowed: `d: Length in \"{name}\".d`");
            return self.report(Diagnostic::error("not-a-text", place, message).hint(hint));
        }
        let known = self.files.iter().find(|(_, f)| f.name == name).map(|(id, _)| id);
        if let Some(known) = known {
            if self.reading.contains(&known) {
                let message = format!("{name} uses this text, which uses {name}");
                return self.error("use-cycle", file, path.span(), message);
            }
            return self.visible.add_use(file, known);
        }
        match load(&name) {
            Some(text) => {
                let used = self.read(load, &name, &text);
                self.visible.add_use(file, used);
            }
            None => {
                let message =
                    format!("there is no library and no file beside this one named {name}");
                let place = Place { file, span: path.span() };
                let d = Diagnostic::error("missing-file", place, message);
                self.report(match expr::units::unit(&name) {
                    Some(_) => d.hint(format!("the unit of the sheet is said by `unit {name}`")),
                    None => d,
                });
                self.missing.insert(name);
            }
        }
    }

    /// Declares the things of what a file uses in a class.
    pub(crate) fn declare_used(&mut self, file: FileId, class: ClassId) {
        self.using.push(file);
        for member in self.files[file].members_of(&[SyntaxKind::Use]) {
            let Member::Use(used) = member else { continue };
            let Some(path) = used.path() else { continue };
            let name = name_of(&path);
            let found = self.files.iter().find(|(_, f)| f.name == name).map(|(id, _)| id);
            let (Some(found), Some(last)) = (found, path.segments().last()) else { continue };
            let part = (class, last.name());
            if self.using.contains(&found) || self.parts.contains_key(&part) {
                continue;
            }
            let origin = self.origin(file, path.span());
            let around = self.file_things.get(&file).cloned().unwrap_or_default();
            let things = around.then(Step::Part(last.name()));
            self.file_things.entry(found).or_insert(things);
            if let Some(things) = self.class_of_file(found, origin) {
                let doc = String::new();
                let part = Part {
                    name: last.name(),
                    doc,
                    class: things,
                    count: None,
                    range: None,
                    is_layout: false,
                    origin,
                };
                self.used_parts.insert((class, part.name.clone()), (file, found));
                self.add_part(Place { file, span: last.span() }, class, part);
            }
        }
        self.using.pop();
    }

    /// Notes that a text speaks of the things of one that is used, if a member of a class is those.
    pub(crate) fn speak_of_used(&mut self, by: FileId, name: &Name, class: ClassId) {
        if self.used_parts.is_empty() {
            return;
        }
        if let Some(&used) = self.used_parts.get(&(class, name.clone())) {
            self.spoken.insert((by, used));
        }
    }

    /// Hides the things of used texts of which nothing speaks: they are examples of what their text is for.
    pub(crate) fn hide_unspoken(&mut self) {
        let spoken: BTreeSet<Use> = self.spoken.iter().map(|&(_, used)| used).collect();
        for ((class, name), _) in self.used_parts.iter().filter(|(_, used)| !spoken.contains(used))
        {
            let Some(&index) = self.parts.get(&(*class, name.clone())) else { continue };
            let part = &mut self.document.classes[*class].parts[index];
            part.is_layout = true;
            let things = part.class;
            self.document.classes[things].is_unseen = true;
        }
    }

    /// Makes the class of a file that has things, of its own or by what it uses.
    fn class_of_file(&mut self, file: FileId, origin: OriginId) -> Option<ClassId> {
        if !self.has_things(file) {
            return None;
        }
        let name = self.files[file].name.clone();
        let object = self.object;
        let class = self.add_unnamed_class(&name, object, origin);
        self.document.classes[class].is_of_one = true;
        self.declare_used(file, class);
        let members = self.files[file].parse.file().members().collect();
        self.declare_body(&Scope::of(file, class), members);
        Some(class)
    }

    fn has_things(&self, file: FileId) -> bool {
        let mut members = self.files[file].members_of(&[SyntaxKind::Part]).into_iter();
        members.any(|m| matches!(m, Member::Part(part) if part.definition().is_none()))
    }

    fn set_unit(&mut self, line: &ast::UnitLine) {
        let spelling = line.unit();
        match expr::units::read_quantity("1", &spelling) {
            Some((metres, Dimension::LENGTH)) => {
                // 1 mm is 0.001 m; the factor is exact the other way round.
                self.document.units_per_metre = (1.0 / metres).round().max(1.0 / metres);
                self.document.unit = Some(Name::new(&spelling));
            }
            Some(_) | None => {
                // that there is none is told already
                if spelling.is_empty() {
                    return;
                }
                let message = format!("{spelling} is no unit of length");
                let place = Place { file: OWN, span: line.span() };
                let hint = "write `unit mm`, `unit m`, or leave the line out";
                self.report(Diagnostic::error("unknown-unit", place, message).hint(hint));
            }
        }
    }
}

pub(crate) fn name_of(path: &ast::DottedName) -> String {
    path.segments().map(|w| w.text().to_string()).collect::<Vec<String>>().join(".")
}

/// Returns what parts and messages are called in a text, wherever they are.
fn names_of_parts(parse: &Parse) -> BTreeSet<String> {
    let names = |node: SyntaxNode| match Member::cast(node)? {
        Member::Part(part) => Some(part.names().collect()),
        Member::Message(message) => message.name().map(|name| vec![name]),
        _ => None,
    };
    let words: Vec<Vec<ast::Word>> = parse.syntax().descendants().filter_map(names).collect();
    words.iter().flatten().map(|word| word.text().to_string()).collect()
}

/// Returns the word after a number that was to be its unit, where that is what a diagnostic is at.
pub(crate) fn word_for_unit(parse: &Parse, diagnostic: &Diagnostic) -> Option<SyntaxToken> {
    let span = diagnostic.place.span;
    if diagnostic.code == "too-deep" {
        return None;
    }
    let word = syntax::token_from(&parse.syntax(), span.start)?;
    if syntax::span_of_token(&word) != span {
        return None;
    }
    let before = word.prev_token()?;
    let number = if before.kind() == SyntaxKind::Whitespace && !before.text().contains('\n') {
        before.prev_token()?
    } else {
        before
    };
    let is_unit = word.kind() == SyntaxKind::Ident
        && number.kind() == SyntaxKind::Number
        && !syntax::units::follows_operand(word.text());
    is_unit.then_some(word)
}
