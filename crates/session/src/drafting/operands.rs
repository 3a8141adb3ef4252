//! The operands of a turn that come from outside of it: what a second turn is asked.

use super::{catalogue, text};
use base::Span;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Expr, Value};
use syntax::{SyntaxNode, WalkEvent};

/// An operand of a step in a turn.
pub(super) struct Occurrence {
    /// The step, by its address in the turn.
    pub(super) step: String,
    /// The label, or the place.
    pub(super) slot: String,
    /// How it is written.
    pub(super) first: String,
    /// Where it stands.
    pub(super) span: Span,
    /// Where the same stands again.
    pub(super) again: Option<Span>,
    /// Whether it is what a block in the turn carries on: `next first`.
    pub(super) is_next: bool,
}

/// Lists the operands of a turn that speak of something that it has not made, those of blocks in it too.
pub(super) fn operands(body: &syntax::ast::Body) -> Vec<Occurrence> {
    let mut all = Vec::new();
    let named = Named::around(body.syntax());
    collect((&text::steps_of(body), &named), "", &mut Vec::new(), &mut all);
    all
}

fn collect(
    (steps, named): (&[text::StepNode], &Named),
    way: &str,
    own: &mut Vec<String>,
    into: &mut Vec<Occurrence>,
) {
    for step in steps {
        let step_way = text::joined(way, &step.segment);
        let Some(value) = &step.value else { continue };
        let mut operands = heads(value, named);
        add(&mut operands, (&step_way, own, false), named, into);
        let known = own.len();
        own.extend(text::carried_names(value));
        for (segment, steps) in text::inner_steps(value) {
            collect((&steps, named), &text::joined(&step_way, segment), own, into);
        }
        let mut operands = tails(value);
        add(&mut operands, (&step_way, own, true), named, into);
        // what a block with a name makes is reached by that name alone
        if step.name.is_some() {
            own.truncate(known);
        }
        own.extend(step.name.clone());
    }
}

/// Keeps of operands those that speak of something from outside.
fn add(
    operands: &mut Vec<(String, Expr)>,
    (step, own, is_tail): (&str, &[String], bool),
    named: &Named,
    into: &mut Vec<Occurrence>,
) {
    let from = into.len();
    for (slot, value) in operands.drain(..) {
        let first = value.syntax().text().to_string().trim().to_string();
        // a place on the sheet may be another one in the next turn: a number that is typed is a constant
        if speaks_of_outside(&value, own, named) || is_place(&value) {
            let span = syntax::ast::span_without_doc(value.syntax());
            let is_next = is_tail && !is_condition(&slot);
            let it = Occurrence { step: step.into(), slot, first, span, again: None, is_next };
            join(into, from, it);
        }
    }
}

/// Adds an operand to those of a step; what stands twice is one.
fn join(into: &mut Vec<Occurrence>, from: usize, it: Occurrence) {
    match into[from..].iter_mut().find(|known| known.slot == it.slot && known.first == it.first) {
        Some(known) => known.again = Some(it.span),
        None => into.push(it),
    }
}

/// Lists what a step says that can be changed by itself: its operands; of a loop what stands before it, what it carries
/// on (`next first`), and what ends it. Those that are read at the end of a turn come with `true`.
pub(super) fn of_step(step: &text::StepNode) -> Vec<(Occurrence, bool)> {
    let Some(value) = &step.value else { return Vec::new() };
    let one = |slot: String, value: &Expr, is_within: bool| {
        let first = value.syntax().text().to_string().trim().to_string();
        let span = syntax::ast::span_without_doc(value.syntax());
        let step = step.segment.clone();
        (Occurrence { step, slot, first, span, again: None, is_next: false }, is_within)
    };
    let mut all = Vec::new();
    heads(value, &Named::around(value.syntax()))
        .into_iter()
        .for_each(|(slot, value)| join(&mut all, 0, one(slot, &value, false).0));
    let heads = all.into_iter().map(|it| (it, false));
    let tails = tails(value).into_iter().map(|(slot, value)| match is_condition(&slot) {
        true => one(slot, &value, true),
        false => one(next(&slot), &value, true),
    });
    heads.chain(tails).collect()
}

/// How what a loop carries on is called.
pub(super) fn next(slot: &str) -> String {
    format!("next {slot}")
}

/// Whether what stands at the end of a block is what ends it.
fn is_condition(slot: &str) -> bool {
    matches!(slot, "while" | "until")
}

/// The operands of a step: those of a construction, or what stands before a block.
fn heads(value: &Value, known: &Named) -> Vec<(String, Expr)> {
    let named = |name: &str, value: Option<Expr>| value.map(|value| (name.to_string(), value));
    let carried = |with: Option<syntax::ast::With>| {
        let bindings: Vec<_> = with.into_iter().flat_map(|with| with.bindings()).collect();
        let one = |b: &syntax::ast::Binding| Some((b.name()?.text().to_string(), b.value()?));
        bindings.iter().filter_map(one).collect::<Vec<_>>()
    };
    match value {
        Value::Expr(value) => operands_of(value, known),
        Value::Repeat(block) => {
            named("times", block.times()).into_iter().chain(carried(block.with())).collect()
        }
        Value::While(block) => carried(block.with()),
        Value::For(block) => {
            named("set", block.range()).into_iter().chain(carried(block.with())).collect()
        }
        Value::If(choice) => named("condition", choice.condition()).into_iter().collect(),
    }
}

/// What ends a loop, and what its next turn begins with.
fn tails(value: &Value) -> Vec<(String, Expr)> {
    let named = |name: &str, value: Option<Expr>| value.map(|value| (name.to_string(), value));
    let (body, condition) = match value {
        Value::Repeat(block) => (block.body(), named("until", block.until())),
        Value::While(block) => (block.body(), named("while", block.condition())),
        Value::For(block) => (block.body(), None),
        Value::Expr(_) | Value::If(_) => (None, None),
    };
    let next = body.into_iter().flat_map(|body| body.members()).filter_map(|m| match m {
        syntax::ast::Member::Next(next) => Some(next),
        _ => None,
    });
    let bindings: Vec<_> = next.flat_map(|next| next.bindings()).collect();
    let one = |b: &syntax::ast::Binding| Some((b.name()?.text().to_string(), b.value()?));
    condition.into_iter().chain(bindings.iter().filter_map(one)).collect()
}

fn operands_of(value: &Expr, named: &Named) -> Vec<(String, Expr)> {
    if let Some(pattern) = catalogue::pattern_of(value) {
        return pattern.parts.into_iter().map(|(slot, value)| (slot.to_string(), value)).collect();
    }
    // a point is a place as a whole: the next one may lie elsewhere
    if is_point(value) {
        return vec![("at".into(), value.clone())];
    }
    let is_class = |text: &str| named.is_class(text.trim());
    let (receiver, list) = match value {
        Expr::Call(call) if call.name().is_some_and(|w| is_class(w.text())) => (None, call.args()),
        Expr::Field(field) => (field.receiver(), field.args()),
        _ => (None, None),
    };
    let Some(list) = list else { return vec![("value".into(), value.clone())] };
    // what goes through places has each of them as an operand
    if let (Expr::Call(_), Some((places, rest))) = (value, places_first(&list)) {
        let places = places.enumerate().map(|(i, place)| (ordinal(i), place));
        return places.chain(rest).collect();
    }
    // `line.mirrored(about: axis)` is sent to what stands before the word
    let receiver = receiver.filter(|r| !is_class(&r.syntax().text().to_string()));
    let receiver = receiver.map(|r| ("what".to_string(), r));
    let one = |(i, argument): (usize, syntax::ast::Arg)| {
        let label = argument.label().map(|word| word.text().to_string());
        Some((label.unwrap_or_else(|| ordinal(i)), argument.value()?))
    };
    receiver.into_iter().chain(list.args().enumerate().filter_map(one)).collect()
}

/// The elements of a list that a class is given first, and what else it is given by a label: `Spline([start, Point(w, 0)])`.
fn places_first(
    list: &syntax::ast::ArgList,
) -> Option<(impl Iterator<Item = Expr> + use<>, Vec<(String, Expr)>)> {
    let mut all = list.args();
    let first = all.next().filter(|first| first.label().is_none())?;
    let labelled = |a: syntax::ast::Arg| Some((a.label()?.text().to_string(), a.value()?));
    let rest = all.map(labelled).collect::<Option<Vec<_>>>()?;
    match first.value()? {
        Expr::List(list) => Some((list.elements().collect::<Vec<_>>().into_iter(), rest)),
        _ => None,
    }
}

/// What an operand without a label is called.
fn ordinal(i: usize) -> String {
    const NAMES: [&str; 10] = [
        "first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth", "ninth",
        "tenth",
    ];
    NAMES.get(i).map_or_else(|| format!("operand{}", i + 1), |n| (*n).into())
}

/// Whether an expression is a point by its coordinates: `Point(3, d / 2)`.
fn is_point(value: &Expr) -> bool {
    let Expr::Call(call) = value else { return false };
    call.name().is_some_and(|word| word.text() == "Point")
}

/// Whether an operand is a place that is written by numbers: `Point(3, 4)`.
fn is_place(value: &Expr) -> bool {
    let Expr::Call(call) = value else { return false };
    let is_number = |argument: syntax::ast::Arg| {
        argument.value().is_some_and(|x| super::typed::is_number(&x.syntax().text().to_string()))
    };
    is_point(value) && call.args().is_some_and(|list| list.args().all(is_number))
}

/// The parameters and steps of a program whose names begin with capitals, as those of classes do.
struct Named(BTreeSet<String>);

impl Named {
    /// Those of the program that something stands in.
    fn around(node: &SyntaxNode) -> Self {
        let mut all = BTreeSet::new();
        let Some(program) = node.ancestors().find_map(syntax::ast::Program::cast) else {
            return Self(all);
        };
        let mut add = |word: Option<syntax::ast::Word>| {
            all.extend(word.map(|w| w.text().to_string()).filter(|w| is_capital(w)));
        };
        let list = program.params();
        list.into_iter().flat_map(|list| list.params()).for_each(|p| add(p.name()));
        let mut walk = program.syntax().preorder();
        while let Some(event) = walk.next() {
            let WalkEvent::Enter(node) = event else { continue };
            if let Some(assign) = syntax::ast::Assign::cast(node.clone()) {
                if let Some(Expr::Name(word)) = assign.target() {
                    add(word.name());
                }
            } else if Expr::cast(node).is_some() {
                // no step is within an expression
                walk.skip_subtree();
            }
        }
        Self(all)
    }

    /// Whether a word is a class's name.
    fn is_class(&self, word: &str) -> bool {
        is_capital(word) && !self.0.contains(word)
    }
}

fn is_capital(word: &str) -> bool {
    word.starts_with(char::is_uppercase)
}

/// Whether an operand speaks of something that its turn has not made: not a literal, not a class or function.
fn speaks_of_outside(value: &Expr, own: &[String], named: &Named) -> bool {
    let text = value.syntax().text().to_string();
    let text = text.trim();
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut rest = text;
    let mut before = ' ';
    while let Some(start) = rest.find(is_word) {
        if let Some(c) = rest[..start].chars().next_back() {
            before = c;
        }
        let word: String = rest[start..].chars().take_while(|&c| is_word(c)).collect();
        rest = &rest[start + word.len()..];
        let follows = rest.trim_start().chars().next();
        let is_class = named.is_class(&word);
        let is_name = !word.starts_with(|c: char| c.is_ascii_digit()) && !is_class && before != '.';
        let is_unit = before == ' '
            && text[..text.len() - rest.len() - word.len()]
                .trim_end()
                .ends_with(|c: char| c.is_ascii_digit());
        if is_name && !is_unit && !matches!(follows, Some('(' | ':')) && !own.contains(&word) {
            return true;
        }
        before = ' ';
    }
    false
}
