//! A class by example: some things of the document become the parts of a new class, and one thing of it.
//!
//! What speaks of these things alone goes into the class: their constraints, merges and anchors. What speaks of
//! others too stays, and reaches them through the new thing. Of each part, value, constraint, merge and anchor a person
//! decides whether it is of the class, of this one thing only, or, where it says a number, a parameter.

use crate::by_hand::class_at;
use crate::document::Open;
use crate::host::Host;
use crate::recognise;
use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::view::{ClassItem, ClassPlan, ItemKind, Refusal, Scope};
use crate::words;
use base::{Name, Severity, Span};
use kernel::{BinaryOperator, Command, DOCUMENT, Path, Step, Term};
use plan::Plans;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Constraint, Member};
use syntax::edit::{TextEdit, apply, delete_member};
use syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

/// Returns what has to be decided of some things that become the parts of a class, in the order of the text: each
/// part with the values that it is given, and what is said of these things alone.
pub(crate) fn items(open: &Open, paths: &[Path]) -> Vec<ClassItem> {
    let Ok(chosen) = chosen(paths) else { return Vec::new() };
    let known = known(&open.state);
    let file = open.state.file();
    let mut found = Vec::new();
    for member in file.members().filter(|member| goes(member, &chosen, &known) == Ok(true)) {
        let Some(kind) = kind(&member) else { continue };
        let says = member.syntax().text().to_string();
        let says = says.split_whitespace().collect::<Vec<_>>().join(" ");
        let says = says.split(" {").next().unwrap_or_default().to_string();
        let parameter = number_said(&open.state, &member).map(|number| number.name);
        found.push(ClassItem { kind, says, parameter });
        for given in givens(&open.state, &member) {
            let says = format!("{} = {}", given.path, given.shown);
            let parameter = given.class.is_some().then(|| given.name.clone());
            found.push(ClassItem { kind: ItemKind::Value, says, parameter });
        }
    }
    found
}

/// Returns the command that makes a class of some things, and what the one thing of it is called.
///
/// # Errors
/// A path is no thing of the document itself, the name is none for a class, or what would be said has an error.
pub(crate) fn class_of(
    open: &Open,
    host: &dyn Host,
    paths: &[Path],
    plan: &ClassPlan,
) -> Result<(Command, String), Refusal> {
    let state = &open.state;
    let class = plan.name.as_str();
    is_class_name(state, class)?;
    let chosen = chosen(paths)?;
    let thing = recognise::free_name(state, &Name::new(class));
    let text = rewritten(state, &chosen, plan, &thing)?;
    let trial = State::of(text.clone(), Some(state), host, Plans::default()).0;
    refuse_new_errors(state, &trial, "these cannot be the parts of a class")?;
    Ok((Command::Text(text), thing))
}

/// Says whether a class can be called so.
///
/// # Errors
/// It is no name for a class, or another is called so.
pub(crate) fn is_class_name(state: &State, class: &str) -> Result<(), Refusal> {
    let named = class.starts_with(char::is_uppercase) && class.chars().all(char::is_alphanumeric);
    if !named {
        let message = format!("{class}: a class's name is one word that begins with a capital");
        return Err(words::refuse(message));
    }
    match state.lowered.document.class_named(class) {
        Some(_) => Err(words::refuse(format!("there is a class {class} already"))),
        None => Ok(()),
    }
}

/// Refuses a text that has an error which the present one has not, after some words.
///
/// # Errors
/// The first of those.
pub(crate) fn refuse_new_errors(state: &State, trial: &State, what: &str) -> Result<(), Refusal> {
    let errors = |s: &State| -> BTreeSet<String> {
        let wrong = s.diagnostics.iter().filter(|d| d.severity == Severity::Error);
        wrong.map(|d| d.message.clone()).collect()
    };
    match errors(trial).difference(&errors(state)).next() {
        Some(new) => Err(words::refuse(format!("{what}: {new}"))),
        None => Ok(()),
    }
}

/// The names of the chosen things.
fn chosen(paths: &[Path]) -> Result<BTreeSet<String>, Refusal> {
    let mut chosen: BTreeSet<String> = BTreeSet::new();
    for path in paths {
        match path.0.as_slice() {
            [Step::Part(name)] => drop(chosen.insert(name.to_string())),
            _ => return Err(words::refuse(format!("{path} is a part: choose the whole"))),
        }
    }
    match chosen.is_empty() {
        true => Err(words::refuse("nothing is selected".into())),
        false => Ok(chosen),
    }
}

/// The names of all things of the document, and of the figures that it computes.
pub(crate) fn known(state: &State) -> BTreeSet<String> {
    let document = &state.lowered.document;
    let parts = state.structure.parts(DOCUMENT);
    let name = |part| state.structure.field_name(document, part).map(ToString::to_string);
    let figures = state.evaluator(&state.values).computed_figures(DOCUMENT);
    parts.filter_map(name).chain(figures.iter().map(ToString::to_string)).collect()
}

/// Whether a member is, or speaks of, the chosen things alone.
pub(crate) fn goes(
    member: &Member,
    chosen: &BTreeSet<String>,
    known: &BTreeSet<String>,
) -> Result<bool, Refusal> {
    match member {
        Member::Part(part) => {
            let names: Vec<bool> = part.names().map(|w| chosen.contains(w.text())).collect();
            if names.contains(&true) && names.contains(&false) {
                let message = "things that are declared together are chosen together";
                return Err(words::refuse(message.into()));
            }
            Ok(names.contains(&true))
        }
        Member::Message(message) => {
            Ok(message.name().is_some_and(|name| chosen.contains(name.text())))
        }
        Member::Constraint(_)
        | Member::Merge(_)
        | Member::Anchor(_)
        | Member::Stay(_)
        | Member::Side(_)
        | Member::Assign(_) => {
            let spoken = spoken(member.syntax(), known);
            Ok(!spoken.is_empty() && spoken.iter().all(|(_, name)| chosen.contains(*name)))
        }
        _ => Ok(false),
    }
}

/// What has to be decided of a member, if anything.
fn kind(member: &Member) -> Option<ItemKind> {
    match member {
        Member::Part(_) => Some(ItemKind::Part),
        Member::Constraint(_) => Some(ItemKind::Constraint),
        Member::Merge(_) => Some(ItemKind::Merge),
        Member::Anchor(_) => Some(ItemKind::Anchor),
        _ => None,
    }
}

/// A value that the body of a part gives.
struct Given {
    /// What gets it, from the document.
    path: String,
    /// As it is written, and as it is shown.
    value: String,
    shown: String,
    /// What a parameter would be called.
    name: String,
    /// The class of a parameter for it, where it is a number.
    class: Option<String>,
    node: SyntaxNode,
}

/// The values that the body of a part gives.
fn givens(state: &State, member: &Member) -> Vec<Given> {
    let Member::Part(part) = member else { return Vec::new() };
    let mut names = part.names();
    let (Some(name), None) = (names.next(), names.next()) else { return Vec::new() };
    let assigned = part.body().into_iter().flat_map(|body| body.members());
    let given = |assign: Member| {
        let Member::Assign(assign) = assign else { return None };
        let target = assign.target()?.syntax().text().to_string();
        let value = assign.value()?.syntax().text().to_string();
        let path = format!("{}.{}", name.text(), target.trim());
        let thing = thing_at(state, &parse_path(&path)?)?;
        let structure = &state.structure;
        let slot = structure.slot_of(thing).map(|slot| &structure.slots[slot]);
        let is_number = slot.is_some_and(|s| s.primitive.is_number() && s.place.is_none());
        let class = is_number.then(|| words::class_name(state, thing));
        let name = String::from(target.trim().rsplit('.').next().unwrap_or_default());
        let node = assign.syntax().clone();
        let value = value.trim().to_string();
        let shown = words::show_thing(state, thing, &state.values).unwrap_or(value.clone());
        Some(Given { path, value, shown, name, class, node })
    };
    assigned.filter_map(given).collect()
}

/// A number that a constraint says.
struct NumberSaid {
    /// What a parameter for it would be called, and its class.
    name: String,
    class: String,
    value: String,
    /// Where it stands in the member.
    span: Span,
}

/// What a constraint says that is an equation: as a rule with a number alone on its right.
pub(crate) struct EqualsNumber {
    pub(crate) left: String,
    pub(crate) value: String,
    /// Where the number stands in the text.
    pub(crate) span: Span,
    /// Whether it is a number alone.
    pub(crate) is_number: bool,
}

/// How a constraint is read that gives something a value.
pub(crate) type ReadValue = fn(&State, &Constraint) -> Option<EqualsNumber>;

/// The constraints in the body of a class that a text declares.
pub(crate) fn constraints_of(state: &State, class: &Name) -> impl Iterator<Item = Member> {
    let is_it = |member: &Member| match member {
        Member::Class(declared) => declared.name().is_some_and(|name| name.text() == &**class),
        _ => false,
    };
    let classes: Vec<Member> = state.members(SyntaxKind::Class).filter(is_it).collect();
    let bodies = classes.into_iter().filter_map(|member| match member {
        Member::Class(declared) => declared.body(),
        _ => None,
    });
    bodies.flat_map(|body| body.members())
}

/// Reads a constraint that says of something which number it is.
pub(crate) fn equals_number(state: &State, constraint: &Constraint) -> Option<EqualsNumber> {
    equation(state, constraint).filter(|said| said.is_number)
}

/// Reads a constraint that says of something what it is, by a number or an expression.
pub(crate) fn equation(state: &State, constraint: &Constraint) -> Option<EqualsNumber> {
    let rule = constraint.rule()?;
    let start = u32::from(rule.syntax().text_range().start());
    let text = rule.syntax().text().to_string();
    let (left, right) = text.split_once(" = ")?;
    let value = right.trim();
    let read = lang::read_literal(value, lang::Wanted::Anything, &state.lowered.document);
    let is_number = matches!(read, Ok(kernel::Literal::Number(_)));
    let before = text.len() - right.trim_start().len();
    let at = start + u32::try_from(before).ok()?;
    let span = Span::new(at, at + u32::try_from(value.len()).ok()?);
    Some(EqualsNumber { left: left.trim().into(), value: value.into(), span, is_number })
}

/// The number on the right of a constraint's equation, where there is nothing else.
fn number_said(state: &State, member: &Member) -> Option<NumberSaid> {
    let Member::Constraint(constraint) = member else { return None };
    let EqualsNumber { value, span, .. } = equals_number(state, constraint)?;
    let whole = constraint.syntax().text_range();
    let document = &state.lowered.document;
    let said = document.classes[state.structure.things[DOCUMENT].class].constraints.iter();
    let mut said = said.filter(|c| {
        state.lowered.own_span(c.origin).is_some_and(|span| span.end == u32::from(whole.end()))
    });
    let Term::Binary(BinaryOperator::Equal, measured, _) = &*said.next()?.rule else { return None };
    let Term::Send { name, .. } = &**measured else { return None };
    let evaluator = state.evaluator(&state.values);
    let Ok(eval::Answer::Number(_, dimension)) = evaluator.evaluate(measured, DOCUMENT) else {
        return None;
    };
    let class = String::from(dimension.named().unwrap_or("Real"));
    let start = u32::from(whole.start());
    let span = Span::new(span.start - start, span.end - start);
    Some(NumberSaid { name: name.to_string(), class, value, span })
}

/// What is written of a class and of its one thing.
#[derive(Default)]
struct Written {
    /// The members of the class; parameters stand first.
    parameters: Vec<String>,
    members: Vec<String>,
    /// The members of the one thing's body.
    own: Vec<String>,
    /// The names that the class has.
    names: BTreeSet<String>,
}

impl Written {
    /// Adds a parameter; returns what it is called.
    fn parameter(&mut self, name: &str, class: &str, value: &str) -> String {
        let mut free = String::from(name);
        let mut n = 2;
        while !self.names.insert(free.clone()) {
            free = format!("{name}{n}");
            n += 1;
        }
        self.parameters.push(format!("{free}: {class} = {value}"));
        free
    }
}

/// Returns the text in which the chosen things are the parts of a class.
fn rewritten(
    state: &State,
    chosen: &BTreeSet<String>,
    plan: &ClassPlan,
    thing: &str,
) -> Result<String, Refusal> {
    let (text, class, known) = (&state.text, plan.name.as_str(), known(state));
    let file = syntax::parse(base::FileId(0), text).file();
    let mut written = Written { names: chosen.clone(), ..Written::default() };
    let mut edits: Vec<TextEdit> = Vec::new();
    let mut at = None;
    let mut scopes = plan.scopes.iter().copied();
    for member in file.members() {
        let syntax = member.syntax();
        if matches!(member, Member::Class(_) | Member::Use(_)) {
            continue;
        }
        if goes(&member, chosen, &known)? {
            at = at.or(Some(u32::from(syntax.text_range().start())));
            sort(state, &member, &mut scopes, &mut written);
            edits.push(delete_member(syntax));
        } else {
            let through = |(start, _): (u32, &str)| TextEdit {
                span: Span::new(start, start),
                insert: format!("{thing}."),
            };
            let spoken = spoken(syntax, chosen).into_iter();
            edits.extend(spoken.map(through));
        }
    }
    let Some(at) = at else { return Err(words::refuse("nothing is selected".into())) };
    let Written { parameters, mut members, own, .. } = written;
    if !plan.attachers.is_empty() {
        let paths: Vec<String> = plan.attachers.iter().map(ToString::to_string).collect();
        members.push(format!("attachers {}", paths.join(", ")));
    }
    let indented = |member: &String| {
        member.lines().map(|line| format!("    {line}")).collect::<Vec<_>>().join("\n")
    };
    let body: Vec<String> = parameters.iter().chain(&members).map(indented).collect();
    let own: Vec<String> = own.iter().map(indented).collect();
    let own = match own.is_empty() {
        true => String::new(),
        false => format!(" {{\n{}\n}}", own.join("\n")),
    };
    let said = format!("class {class} {{\n{}\n}}\n\n{thing}: {class}{own}\n", body.join("\n"));
    edits.push(TextEdit { span: Span::new(at, at), insert: said });
    edits.sort_by_key(|edit| (edit.span.start, edit.span.end));
    Ok(apply(text, &edits))
}

/// What the document computes as a part that is bound to it, which things of a class draw: `foot => …` is
/// `foot: Point = …`.
fn bound(state: &State, member: &Member) -> Option<String> {
    let Member::Message(message) = member else { return None };
    let name = message.name()?.text().to_string();
    let class = class_at(state, &parse_path(&name)?)?;
    let class = &state.lowered.document.classes[state.lowered.document.named_class(class)].name;
    let whole = member.syntax();
    let arrow = whole.children_with_tokens().find(|e| e.kind() == SyntaxKind::FatArrow)?;
    let within = |at| usize::try_from(u32::from(at) - u32::from(whole.text_range().start())).ok();
    let text = whole.text().to_string();
    let before = text.get(..within(message.name()?.token.text_range().start())?)?;
    // what is said after the arrow stays as it stands there, with its comments
    let after = text.get(within(arrow.text_range().end())?..)?;
    Some(format!("{before}{name}: {class} ={after}").trim().into())
}

/// Writes a member where it belongs.
fn sort(
    state: &State,
    member: &Member,
    scopes: &mut impl Iterator<Item = Scope>,
    written: &mut Written,
) {
    let text = member.syntax().text().to_string();
    let start = u32::from(member.syntax().text_range().start());
    if let Some(bound) = bound(state, member) {
        return written.members.push(bound);
    }
    let Some(kind) = kind(member) else { return written.members.push(text.trim().into()) };
    let scope = scopes.next().unwrap_or(kind.usual());
    let mut changes = Vec::new();
    if let (Scope::Parameter, Some(said)) = (scope, number_said(state, member)) {
        let name = written.parameter(&said.name, &said.class, &said.value);
        changes.push(TextEdit { span: said.span, insert: name });
    }
    let mut merges = Vec::new();
    for given in givens(state, member) {
        let its = scopes.next().unwrap_or(ItemKind::Value.usual());
        let gone = || {
            let gone = delete_member(&given.node);
            let span = Span::new(gone.span.start - start, gone.span.end - start);
            TextEdit { span, insert: gone.insert }
        };
        match (scope, its, &given.class) {
            // it goes where its part goes
            (Scope::Own, ..) | (_, Scope::Class, _) | (_, Scope::Parameter, None) => {}
            (_, Scope::Own, _) => {
                written.own.push(format!("{} = {}", given.path, given.value));
                changes.push(gone());
            }
            (_, Scope::Parameter, Some(class)) => {
                let name = written.parameter(&given.name, class, &given.value);
                merges.push(format!("merge {name} = {}", given.path));
                changes.push(gone());
            }
        }
    }
    let said = apply(&text, &changes).trim().to_string();
    match scope {
        Scope::Own => written.own.push(said),
        Scope::Class | Scope::Parameter => written.members.push(said),
    }
    written.members.extend(merges);
}

/// Returns where some members speak of things of the document by their own names, and these, in order.
pub(crate) fn things_spoken_of(state: &State, members: &str) -> Vec<(u32, String)> {
    let file = syntax::parse(base::FileId(0), members).file();
    let known = known(state);
    let found = spoken(file.syntax(), &known).into_iter();
    found.map(|(start, name)| (start, name.to_string())).collect()
}

/// Returns where a member speaks of things by their own names, and these.
pub(crate) fn spoken<'n>(syntax: &SyntaxNode, names: &'n BTreeSet<String>) -> Vec<(u32, &'n str)> {
    let mut found = Vec::new();
    let mut after_dot = false;
    let tokens = syntax.descendants_with_tokens().filter_map(SyntaxElement::into_token);
    for token in tokens.filter(|token| !token.text().trim().is_empty()) {
        if token.kind() == SyntaxKind::Ident
            && !after_dot
            && let Some(name) = names.get(token.text())
        {
            found.push((u32::from(token.text_range().start()), name.as_str()));
        }
        after_dot = token.kind() == SyntaxKind::Dot;
    }
    found
}
