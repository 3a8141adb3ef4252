//! Writing values: the smallest edits of the text that give parts their values.
//!
//! A value that the thing's own text gives is rewritten where it stands, number by number; any other
//! is added to the thing's own body, never to a class.

use crate::connections::is_bare_path;
use crate::lower::{Lowered, OWN};
use crate::numbers::{unit_of, without_noise, write_number};
use crate::paths::loose_path;
use base::{Name, Span};
use expr::dimension::Dimension;
use indexmap::IndexMap;
use kernel::quantity::{from_bare, from_si};
use kernel::{ClassId, ClassKind, Document, Literal, OriginId, Path, Primitive, Step};
use std::collections::{BTreeMap, BTreeSet};
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::edit::{self, Spot, TextEdit};
use syntax::{SyntaxKind, SyntaxNode};

/// Returns the edits of the text that give these parts, by paths from the document, these values.
///
/// Where the text has an error, what would have to be written inside of it is left out.
pub fn write_values(lowered: &Lowered, writes: &[(Path, Literal)]) -> Vec<TextEdit> {
    in_text(lowered, value_edits(lowered, writes, Digits::All))
}

/// Returns the edits that give these parts these values, as [`write_values`] does, but for digits that only computing
/// has made: those of numbers that are not `meant`, behind the eleventh.
pub fn write_rounded(
    lowered: &Lowered,
    writes: &[(Path, Literal)],
    meant: &BTreeSet<u64>,
) -> Vec<TextEdit> {
    in_text(lowered, value_edits(lowered, writes, Digits::Meant(meant)))
}

/// The digits that numbers are written with.
#[derive(Clone, Copy)]
pub(crate) enum Digits<'m> {
    /// All that reading needs to give the same bits.
    All,
    /// All of those with these bits; of others those that are more than rounding.
    Meant(&'m BTreeSet<u64>),
}

/// Returns the edit by which a number of some class, which a member of the document's own text gives, stands there in
/// another unit; nothing where it does already, or where it is not written as a number.
pub fn write_unit(
    lowered: &Lowered,
    given: OriginId,
    (x, class): (f64, ClassId),
    unit: &str,
) -> Vec<TextEdit> {
    let place = lowered.origins.place(given);
    if place.file != OWN {
        return Vec::new();
    }
    let document = &lowered.document;
    let (edits, added) = (Vec::new(), IndexMap::new());
    let writer = Writer { lowered, document, digits: Digits::All, edits, added };
    let file = lowered.effective_parse.file();
    let within = |e: &Expr| {
        let span = e.span();
        place.span.start <= span.start && span.end <= place.span.end
    };
    let numbers = file.syntax().descendants().filter_map(Expr::cast);
    let mut numbers = numbers.filter(|e| matches!(e, Expr::Number(_) | Expr::Unary(_)));
    let bits = Some((x + 0.0).to_bits());
    let written = numbers.find(|e| within(e) && writer.read(e, Some(class)) == bits);
    let Some(written) = written.filter(|e| unit_of(e).is_none_or(|is| *is != *unit)) else {
        return Vec::new();
    };
    let text = write_number(x, writer.dimension(Some(class)), document, Some(unit));
    in_text(lowered, vec![edit::replace(written.syntax(), &text)])
}

/// Returns the edits of the effective text that give these parts these values.
pub(crate) fn value_edits(
    lowered: &Lowered,
    writes: &[(Path, Literal)],
    digits: Digits<'_>,
) -> Vec<TextEdit> {
    let file = lowered.effective_parse.file();
    let own = Some(lowered.document.root);
    let members = Members::of(about(lowered, &file, writes).into_iter(), lowered, own);
    let document = &lowered.document;
    let mut writer =
        Writer { lowered, document, digits, edits: Vec::new(), added: IndexMap::new() };
    for (path, literal) in writes {
        let root = lowered.document.root;
        if let Some((class, declared, rest)) = prototype(lowered, &file, path) {
            let literal = &in_class(literal, &path.0[..1]);
            let part = Value::of(literal, lowered.class_at(class, &rest));
            let end = Spot::EndOf(declared.syntax().clone());
            let members = declared.body().into_iter().flat_map(|b| b.members());
            let members = Members::of(members, lowered, Some(class));
            writer.write(&Body { owner: Some(class), end }, &members, &rest, part);
            continue;
        }
        let class = lowered.class_at(root, path);
        let part = Value::of(literal, class);
        let body = Body { owner: Some(root), end: Spot::EndOf(file.syntax().clone()) };
        writer.write(&body, &members, path, part);
    }
    let mut edits = writer.edits;
    for (spot, texts) in &writer.added {
        edits.push(edit::insert_member(spot, &joined(texts)));
    }
    edits
}

/// Returns the members of the document that may speak of what is written, in the order of the text.
fn about(lowered: &Lowered, file: &ast::File, writes: &[(Path, Literal)]) -> Vec<Member> {
    let root = lowered.document.root;
    let declared = |(path, _): &(Path, Literal)| {
        let Some(Step::Part(name)) = path.0.first() else { return None };
        let part = lowered.parts.get(&(root, name.clone()))?;
        let origin = lowered.document.classes[root].parts.get(*part)?.origin;
        Some(lowered.origins.place(origin).span.end)
    };
    let ends: BTreeSet<u32> = writes.iter().filter_map(declared).collect();
    let speaks = |(kind, span): &(SyntaxKind, Span)| match kind {
        SyntaxKind::Assign | SyntaxKind::For => true,
        // where it begins depends on whether comments count
        SyntaxKind::Part => ends.contains(&span.end),
        _ => false,
    };
    let outline = lowered.effective_parse.outline().filter(speaks);
    outline.filter_map(|(_, span)| file.member_at(span)).collect()
}

/// Finds the class whose prototype a path begins at, where it is declared, and the rest of the path.
fn prototype(
    lowered: &Lowered,
    file: &ast::File,
    path: &Path,
) -> Option<(ClassId, ast::Class, Path)> {
    let (first, rest) = path.0.split_first()?;
    let Step::Part(name) = first else { return None };
    let known = lowered.class_at(lowered.document.root, &Path(vec![first.clone()])).is_some();
    let class = lowered.own_class(name).filter(|_| !known)?;
    let declared = file.members().find_map(|m| match m {
        Member::Class(c) if c.name().is_some_and(|w| w.name() == *name) => Some(c),
        _ => None,
    })?;
    Some((class, declared, Path(rest.to_vec())))
}

/// Returns what a part of a prototype names as its class says it: `Strut.p1` is `p1` there.
fn in_class(literal: &Literal, class: &[Step]) -> Literal {
    match literal {
        Literal::Path(path) if path.0.starts_with(class) => {
            Literal::Path(Path(path.0[1..].to_vec()))
        }
        other => other.clone(),
    }
}

/// Carries edits of the effective text over to the text itself.
fn in_text(lowered: &Lowered, edits: Vec<TextEdit>) -> Vec<TextEdit> {
    let carry = |e: TextEdit| Some(TextEdit { span: lowered.in_text(e.span)?, insert: e.insert });
    edits.into_iter().filter_map(carry).collect()
}

/// A value and the class of the part that it is for.
#[derive(Clone, Copy)]
struct Value<'v> {
    literal: &'v Literal,
    class: Option<ClassId>,
    /// The largest coordinate of the place that it is one of.
    largest: f64,
}

impl<'v> Value<'v> {
    fn of(literal: &'v Literal, class: Option<ClassId>) -> Self {
        Self { literal, class, largest: 0.0 }
    }
}

/// Where the members of a thing stand.
struct Body {
    /// The thing's class, if it is known.
    owner: Option<ClassId>,
    /// Where a new member goes.
    end: Spot,
}

/// The members of a body that speak of values.
struct Members {
    /// Those that say what they speak of, by the path to it.
    by_path: BTreeMap<Path, Vec<Member>>,
    /// What loops give, and the last loop that does.
    repeated: BTreeMap<Path, Member>,
}

impl Members {
    /// Sorts the members of a body whose thing is of a class, if that is known.
    fn of(
        members: impl Iterator<Item = Member>,
        lowered: &Lowered,
        owner: Option<ClassId>,
    ) -> Self {
        let mut by_path: BTreeMap<Path, Vec<Member>> = BTreeMap::new();
        let mut loops: Vec<Member> = Vec::new();
        for member in members {
            if matches!(member, Member::For(_)) {
                loops.push(member);
                continue;
            }
            let paths: Vec<Path> = match &member {
                Member::Assign(assign) => {
                    assign.target().and_then(|t| loose_path(&t)).into_iter().collect()
                }
                Member::Part(part) => {
                    part.names().map(|n| Path(vec![Step::Part(n.name())])).collect()
                }
                _ => continue,
            };
            for path in paths {
                by_path.entry(path).or_default().push(member.clone());
            }
        }
        let gives = |n: SyntaxNode| matches!(n.kind(), SyntaxKind::Assign);
        loops.retain(|each| each.syntax().descendants().any(gives));
        let repeated = if loops.is_empty() { None } else { owner };
        let givens = repeated.map(|class| &lowered.document.classes[class].givens);
        let repeated = givens.into_iter().flatten().filter_map(|given| {
            let place = lowered.origins.place(given.origin);
            let at = Some(place.span.start).filter(|_| place.file == OWN)?;
            let each = loops.iter().find(|each| each.span().range().contains(&(at as usize)))?;
            Some((given.path.clone(), each.clone()))
        });
        Self { by_path, repeated: repeated.collect() }
    }
    /// Returns the loop that gives what a path leads to, or a part of it.
    fn repeated(&self, path: &Path) -> Option<&Member> {
        let around = (1..=path.0.len()).rev().map(|n| Path(path.0[..n].to_vec()));
        let mut around = around.filter_map(|path| self.repeated.get(&path));
        let below = || {
            let next = self.repeated.range(path.clone()..).next();
            next.filter(|(p, _)| p.0.starts_with(&path.0)).map(|(_, each)| each)
        };
        around.next().or_else(below)
    }
    /// Returns the members that speak of what a path leads to, of a whole that it is part of or of a part, in the order
    /// of the text.
    fn about(&self, path: &Path) -> Vec<&Member> {
        let around = (1..path.0.len()).map(|n| Path(path.0[..n].to_vec()));
        let around = around.filter_map(|path| self.by_path.get(&path));
        let below = self.by_path.range(path.clone()..);
        let below = below.take_while(|(p, _)| p.0.starts_with(&path.0)).map(|(_, all)| all);
        let mut found: Vec<&Member> = around.chain(below).flatten().collect();
        found.sort_by_key(|member| member.span().start);
        found
    }
}

struct Writer<'d> {
    lowered: &'d Lowered,
    document: &'d Document,
    digits: Digits<'d>,
    edits: Vec<TextEdit>,
    /// New members by where they go, so that a body is opened once.
    added: IndexMap<Spot, Vec<String>>,
}

impl Writer<'_> {
    /// Writes the value of the part at `path` from the thing that has these members.
    fn write(&mut self, body: &Body, members: &Members, path: &Path, value: Value<'_>) {
        // later values win, so the last that speaks of the part counts
        let repeated = members.repeated(path);
        let after = |each: &Member| Spot::After(each.syntax().clone());
        for member in members.about(path).into_iter().rev() {
            if let Some(each) = repeated.filter(|e| e.span().start > member.span().start) {
                return self.add((after(each), body.owner), path, value);
            }
            match member {
                Member::Assign(assign) => {
                    let Some(target) = assign.target().and_then(|t| loose_path(&t)) else {
                        continue;
                    };
                    let Some(written) = assign.value().and_then(ast::Value::expr) else { continue };
                    if let Some(rest) = path.0.strip_prefix(target.0.as_slice()) {
                        if self.write_inside(
                            &written,
                            self.part(body.owner, &target.0),
                            rest,
                            value,
                        ) {
                            return;
                        }
                        break;
                    }
                    if let (true, Literal::Tuple(items)) =
                        (target.0.starts_with(&path.0), value.literal)
                    {
                        return self.write_coordinates(body, members, path, value, items);
                    }
                }
                Member::Part(part) => {
                    return self.write_part(body, part, part.names().count(), path, value);
                }
                _ => {}
            }
        }
        let spot = repeated.map_or_else(|| body.end.clone(), after);
        self.add((spot, body.owner), path, value);
    }

    /// Writes a value that is all or a coordinate of what an expression says, if that can be told.
    fn write_inside(
        &mut self,
        written: &Expr,
        class: Option<ClassId>,
        rest: &[Step],
        value: Value<'_>,
    ) -> bool {
        let Some((step, rest)) = rest.split_first() else {
            if is_bare_path(written) && matches!(value.literal, Literal::Tuple(_)) {
                // it stays one with what it is connected with
                return false;
            }
            self.write_over(written, value);
            return true;
        };
        match (written, step, class) {
            (Expr::Paren(inner), _, _) => inner.inner().is_some_and(|inner| {
                let rest: Vec<Step> = std::iter::once(step).chain(rest).cloned().collect();
                self.write_inside(&inner, class, &rest, value)
            }),
            (Expr::Tuple(tuple), Step::Part(name), Some(class)) => {
                let layout = self.document.layout(class);
                let at = layout.iter().position(|&f| self.document.field_name(f) == name);
                let Some(element) = at.and_then(|i| tuple.elements().nth(i)) else { return false };
                let class = at.map(|i| self.document.field_class(layout[i]));
                self.write_inside(&element, class, rest, value)
            }
            (Expr::Call(call), Step::Part(name), _) => {
                let made = call.name().and_then(|w| self.document.class_named(w.text()));
                let Some((class, element)) = made.and_then(|c| self.argument(c, call, name)) else {
                    return false;
                };
                self.write_inside(&element, Some(class), rest, value)
            }
            (Expr::List(list), Step::Index(i), _) => {
                let Some(element) = list.elements().nth(*i as usize) else { return false };
                let class = class.and_then(|c| self.lowered.class_at(c, &Path(vec![step.clone()])));
                self.write_inside(&element, class, rest, value)
            }
            _ => false,
        }
    }

    /// Returns what a new thing of a class is given for a part, and the part's class.
    fn argument(
        &self,
        made: ClassId,
        call: &ast::CallExpr,
        name: &Name,
    ) -> Option<(ClassId, Expr)> {
        let layout = self.document.layout(made);
        let at = layout.iter().position(|&f| self.document.field_name(f) == name)?;
        let args: Vec<ast::Arg> = call.args()?.args().collect();
        let labelled = args.iter().find(|a| a.label().is_some_and(|l| l.name() == *name));
        let arg = labelled.or_else(|| args.get(at).filter(|a| a.label().is_none()))?;
        Some((self.document.field_class(layout[at]), arg.value()?))
    }

    fn part(&self, owner: Option<ClassId>, steps: &[Step]) -> Option<ClassId> {
        owner.and_then(|c| self.lowered.class_at(c, &Path(steps.to_vec())))
    }

    fn write_part(
        &mut self,
        body: &Body,
        part: &ast::Part,
        names: usize,
        path: &Path,
        value: Value<'_>,
    ) {
        let class = self.part(body.owner, &path.0[..1]);
        let rest = Path(path.0[1..].to_vec());
        let written = part.value().and_then(ast::Value::expr);
        if names > 1 {
            // the others keep what they share
            return self.add((Spot::After(part.syntax().clone()), body.owner), path, value);
        }
        if let Some(written) = &written {
            if !self.write_inside(written, class, &rest.0, value) {
                self.add((Spot::After(part.syntax().clone()), body.owner), path, value);
            }
            return;
        }
        if let Some(Step::Index(_) | Step::Last | Step::Owner) = rest.0.first() {
            return self.add((body.end.clone(), body.owner), path, value);
        }
        let inner = Body { owner: class, end: Spot::EndOf(part.syntax().clone()) };
        let members = part.body().into_iter().flat_map(|b| b.members());
        let members = Members::of(members, self.lowered, class);
        if !rest.is_empty() {
            return self.write(&inner, &members, &rest, value);
        }
        match value.literal {
            Literal::Tuple(items) if part.body().is_some() => {
                self.write_coordinates(&inner, &members, &rest, value, items);
            }
            Literal::Tuple(_)
            | Literal::Number(_)
            | Literal::Text(_)
            | Literal::Bool(_)
            | Literal::Path(_) => {
                let text = self.text(value);
                self.edits.extend(edit::give_value(part, &text));
            }
        }
    }

    fn write_coordinates(
        &mut self,
        body: &Body,
        members: &Members,
        path: &Path,
        value: Value<'_>,
        items: &[Literal],
    ) {
        let Some(class) = value.class else { return };
        for (field, literal) in self.document.layout(class).into_iter().zip(items) {
            let name = self.document.field_name(field).clone();
            let part = Value {
                literal,
                class: Some(self.document.field_class(field)),
                largest: self.largest(value.class, items),
            };
            self.write(body, members, &path.then(Step::Part(name)), part);
        }
    }

    /// Replaces what an expression says, as little of it as will do.
    fn write_over(&mut self, written: &Expr, value: Value<'_>) {
        match (written, value.literal) {
            (Expr::Paren(inner), _) => {
                if let Some(inner) = inner.inner() {
                    self.write_over(&inner, value);
                }
            }
            (Expr::Tuple(tuple), Literal::Tuple(items)) => {
                let elements: Vec<Expr> = tuple.elements().collect();
                if let (true, Some(class)) = (elements.len() == items.len(), value.class) {
                    let layout = self.document.layout(class);
                    for ((element, literal), field) in elements.iter().zip(items).zip(layout) {
                        let class = Some(self.document.field_class(field));
                        let largest = self.largest(value.class, items);
                        self.write_over(element, Value { literal, class, largest });
                    }
                } else {
                    self.replace(written.syntax(), value);
                }
            }
            (_, Literal::Number(x)) if self.read(written, value.class) == Some(x.to_bits()) => {}
            (Expr::Number(number), Literal::Number(x)) => {
                let unit = number.unit();
                let text = self.number(*x, value, unit.as_ref().map(ast::Word::text));
                self.edits.push(edit::replace(written.syntax(), &text));
            }
            (Expr::Unary(_), Literal::Number(x)) if let Some(unit) = unit_of(written) => {
                let text = self.number(*x, value, Some(&unit));
                self.edits.push(edit::replace(written.syntax(), &text));
            }
            _ => self.replace(written.syntax(), value),
        }
    }

    /// Returns the bits of a number as it is written, sign included.
    fn read(&self, written: &Expr, class: Option<ClassId>) -> Option<u64> {
        let x = match written {
            Expr::Number(n) => match n.unit() {
                Some(unit) => {
                    let digits = n.digits()?;
                    let (si, d) = expr::units::read_quantity(digits.text(), unit.text())?;
                    from_si(self.document, si, d)
                }
                None => from_bare(self.document, n.value()?, self.dimension(class)),
            },
            Expr::Unary(u) if u.op() == Some(ast::UnaryOp::Negate) => {
                -f64::from_bits(self.read(&u.operand()?, class)?)
            }
            _ => return None,
        };
        Some((x + 0.0).to_bits())
    }

    fn replace(&mut self, node: &SyntaxNode, value: Value<'_>) {
        let text = self.text(value);
        if node.text() != text.as_str() {
            self.edits.push(edit::replace(node, &text));
        }
    }

    /// Adds a member to a body of things of a class, if that is known.
    fn add(&mut self, (spot, owner): (Spot, Option<ClassId>), path: &Path, value: Value<'_>) {
        let unit = || self.unit_of_default(owner?, path);
        let text = match value.literal {
            Literal::Number(x) if let Some(unit) = unit() => self.number(*x, value, Some(&unit)),
            _ => self.text(value),
        };
        let text = format!("{path} = {text}");
        self.added.entry(spot).or_default().push(text);
    }

    /// Returns the unit in which a class gives what has none of its own, a share in percent.
    fn unit_of_default(&self, owner: ClassId, path: &Path) -> Option<Name> {
        let mut begins = 0..path.0.len();
        begins.find_map(|at| {
            let (above, below) = path.0.split_at(at);
            let class = self.lowered.class_at(owner, &Path(above.to_vec()))?;
            let mut line = self.document.upwards(class);
            let givens = |class: ClassId| self.document.classes[class].givens.iter();
            let given = line.find_map(|class| givens(class).find(|g| g.path.0 == below))?;
            let written = self.lowered.written(given.origin);
            let unit = written
                .trim_start_matches(|c: char| c == '-' || c == '.' || c.is_ascii_digit())
                .trim();
            let read = expr::units::unit(unit).filter(|_| !unit.is_empty())?;
            read.dimension.is_none().then(|| Name::new(unit))
        })
    }

    fn dimension(&self, class: Option<ClassId>) -> Dimension {
        match class.map(|c| &self.document.classes[c].kind) {
            Some(ClassKind::Primitive(Primitive::Real(d))) => *d,
            Some(_) | None => Dimension::NONE,
        }
    }

    /// Returns the largest of the coordinates of a place, whichever way it goes; zero for whatever else.
    fn largest(&self, class: Option<ClassId>, items: &[Literal]) -> f64 {
        let size = |literal: &Literal| match literal {
            Literal::Number(x) => x.abs(),
            _ => 0.0,
        };
        match class.is_some_and(|class| self.document.is_place(class)) {
            true => items.iter().map(size).fold(0.0, f64::max),
            false => 0.0,
        }
    }

    /// Writes a number, with the unit that was written before, if any.
    fn number(&self, x: f64, value: Value<'_>, unit: Option<&str>) -> String {
        let text = write_number(x, self.dimension(value.class), self.document, unit);
        match self.digits {
            Digits::Meant(meant) if x != 0.0 && !meant.contains(&x.to_bits()) => {
                without_noise(text, (value.largest / x.abs()).max(1.0))
            }
            Digits::Meant(_) | Digits::All => text,
        }
    }

    /// The unit of what is written anew, where its dimension tells none: an angle is read in degrees.
    fn usual_unit(&self, class: Option<ClassId>) -> Option<&'static str> {
        let class = self.document.named_class(class?);
        (*self.document.classes[class].name == *"Angle").then_some("deg")
    }

    /// Writes an option of a choice, as its class tells it apart.
    fn option(&self, class: Option<ClassId>, at: f64) -> Option<String> {
        let ClassKind::Primitive(Primitive::Choice(of)) = self.document.classes[class?].kind else {
            return None;
        };
        Some(self.document.option_at(of, at)?.to_string())
    }

    /// Writes a value in the language.
    fn text(&self, value: Value<'_>) -> String {
        match value.literal {
            Literal::Number(x) if let Some(option) = self.option(value.class, *x) => option,
            Literal::Number(x) => self.number(*x, value, self.usual_unit(value.class)),
            Literal::Bool(b) => b.to_string(),
            Literal::Text(t) => quoted(t),
            Literal::Path(path) => path.to_string(),
            Literal::Tuple(items) => {
                let fields = value.class.map(|c| self.document.layout(c)).unwrap_or_default();
                let item = |(i, literal): (usize, &Literal)| {
                    let class = fields.get(i).map(|&f| self.document.field_class(f));
                    self.text(Value { literal, class, largest: self.largest(value.class, items) })
                };
                let items: Vec<String> = items.iter().enumerate().map(item).collect();
                format!("({})", items.join(", "))
            }
        }
    }
}

/// Writes a text with its quotes.
pub fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '{' => out.push_str("{{"),
            '}' => out.push_str("}}"),
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Puts members in one line; a `;` where a number would take the next name for its unit.
pub(crate) fn joined(texts: &[String]) -> String {
    let mut out = String::new();
    for text in texts {
        if !out.is_empty() {
            out.push_str(if out.ends_with([')', '"']) { "  " } else { "; " });
        }
        out.push_str(text);
    }
    out
}
