//! Over-constraining: what a person may want instead of a constraint that contradicts others.
//!
//! In: a document, and a command that says something of it. Out: nothing where no more is broken than was;
//! else a question with the ways out, each tried in a copy: a reference dimension that only reads, one of the others
//! replaced, the new one kept switched off, or kept as a conflict.

use crate::apply;
use crate::by_hand::class_at;
use crate::classing::{self, EqualsNumber, ReadValue};
use crate::document::Open;
use crate::host::Host;
use crate::offers;
use crate::recognise;
use crate::rules;
use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::view::{Choice, ContradictionView, Question};
use crate::write_back::settle_places;
use crate::{views, words};
use base::Name;
use kernel::{BinaryOperator, Command, ConstraintInstance, Path, Step, Term, ThingId};
use plan::Plans;
use solve::Level;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Member, Merge};
use syntax::edit::TextEdit;
use syntax::{SyntaxElement, SyntaxKind, SyntaxNode};

/// At most so many others are offered to be replaced.
const MOST_REPLACED: usize = 4;
/// Documents of more things than this are not tried in a copy.
const MOST_THINGS: usize = 20_000;

/// Returns what has to be asked before a command that says something by hand is applied.
pub(crate) fn question(open: &Open, host: &dyn Host, command: &Command) -> Option<Question> {
    let Command::Edit { target, members } = command else { return None };
    if let Some(question) = for_every(&open.state, target, members) {
        return Some(question);
    }
    contradiction(open, host, command)
}

/// Whether what is said of one thing may be meant of its whole class, which is asked.
pub(crate) fn is_for_every(open: &Open, command: &Command) -> bool {
    let Command::Edit { target, members } = command else { return false };
    for_every(&open.state, target, members).is_some()
}

/// The same of what is said in a pane, where it is meant of every one. What writes the pane's own text is no way out.
pub(crate) fn of_prototype(open: &Open, host: &dyn Host, command: &Command) -> Option<Question> {
    let mut question = contradiction(open, host, command)?;
    question.choices.retain(|choice| !matches!(choice.command, Command::Text(_)));
    Some(question)
}

/// How many of the constraints that must hold do not.
fn broken(open: &Open) -> usize {
    open.status.unmet.iter().filter(|unmet| unmet.level == Level::Required).count()
}

/// Asks what is meant by what contradicts what holds.
fn contradiction(open: &Open, host: &dyn Host, command: &Command) -> Option<Question> {
    let Command::Edit { target, members } = command else { return None };
    let things = open.state.structure.things.len();
    if !target.is_empty() || things > MOST_THINGS {
        return None;
    }
    let (was_broken, rule) = (broken(open), members.strip_prefix("constraint "));
    let mut trial = open.trial();
    apply::apply(&mut trial, host, command).ok()?;
    if broken(&trial) <= was_broken {
        return None;
    }
    let was = constraints(&open.state);
    let new: Vec<String> = constraints(&trial.state).difference(&was).cloned().collect();
    let contradictions = views::analysis::view(&mut trial).contradictions;
    // where others contradict each other already, that is not what is asked
    let is_of_new =
        |names: &[String]| was_broken == 0 || names.iter().any(|name| new.contains(name));
    let against = contradictions.iter().map(|c| &c.constraints).filter(|names| is_of_new(names));
    let mut others: Vec<String> = Vec::new();
    for name in against.flatten().filter(|name| was.contains(*name)) {
        if !others.contains(name) {
            others.push(name.clone());
        }
    }
    let others = by_likelihood(&open.state, &others, &measures_of(&trial.state, &new));
    let mut choices = Vec::new();
    if let Some(command) = only_read(open, host, members) {
        let label = "reference dimension: it only reads".into();
        choices.push(Choice { label, command });
    }
    // without a law of its class a thing is none of that class any more
    let own = others.iter().filter(|(_, law)| *law == Law::OfDocument).count();
    let replaced = if own > 0 { own } else { others.len() };
    for (other, _) in others.iter().take(replaced.min(MOST_REPLACED)) {
        let Some(path) = parse_path(other) else { continue };
        let mut replaced = open.trial();
        let gone = apply::apply(&mut replaced, host, &Command::Delete(path));
        let said = gone.and_then(|_| apply::apply(&mut replaced, host, command));
        let is_said = || rule.is_none_or(|rule| offers::holds(&replaced.state, &[rule]));
        if said.is_ok() && broken(&replaced) <= was_broken && is_said() {
            let command = Command::Text(replaced.state.text.clone());
            let label = format!("instead of {}", in_words(&open.state, other));
            choices.push(Choice { label, command });
        }
    }
    let mut off = open.trial();
    let mut done = apply::apply(&mut off, host, command).is_ok();
    for name in &new {
        let Some(path) = parse_path(name) else { continue };
        done &= apply::apply(&mut off, host, &Command::Enable { path, on: false }).is_ok();
    }
    if done && broken(&off) <= was_broken {
        let command = Command::Text(off.state.text.clone());
        choices.push(Choice { label: "keep it switched off".into(), command });
    }
    choices.push(Choice { label: "keep it as a conflict".into(), command: command.clone() });
    let message = match others.is_empty() {
        true => "This cannot hold with what stands fixed.".into(),
        false => {
            let others: Vec<String> =
                others.iter().map(|(o, _)| in_words(&open.state, o)).collect();
            format!("This cannot hold together with {}.", words::listed(&others))
        }
    };
    Some(Question { message, choices })
}

/// Who says a constraint.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Law {
    /// The document, of its own things.
    OfDocument,
    /// A class, of each of its things.
    OfClass,
}

/// Orders constraints by which of them a person most likely wants replaced, and tells who says them: what the document
/// says, first what measures the same, then other dimensions, the latest first; last what classes say.
fn by_likelihood(state: &State, names: &[String], measures: &[Name]) -> Vec<(String, Law)> {
    let mut ranked: Vec<_> = { sources(state).zip(state.structure.constraints.iter()) }
        .filter_map(|(source, instance)| {
            let name = words::source_name(state, source).filter(|name| names.contains(name))?;
            let is_own = instance.owner == kernel::DOCUMENT;
            let law = if is_own { Law::OfDocument } else { Law::OfClass };
            let measured = measured(state, *instance);
            let kind = match measured {
                Some(measure) if measures.contains(&measure) => 0,
                Some(_) => 1,
                None => 2,
            };
            Some(((law, kind, std::cmp::Reverse(instance.index)), name))
        })
        .collect();
    ranked.sort();
    ranked.into_iter().map(|((law, ..), name)| (name, law)).collect()
}

/// What constraints by these names measure.
fn measures_of(state: &State, names: &[String]) -> Vec<Name> {
    let all = sources(state).zip(state.structure.constraints.iter());
    let is_meant = |source| words::source_name(state, source).is_some_and(|n| names.contains(&n));
    let meant = all.filter(|&(source, _)| is_meant(source));
    meant.filter_map(|(_, &instance)| measured(state, instance)).collect()
}

/// What a constraint gives as a number: the length of a line, say.
fn measured(state: &State, instance: ConstraintInstance) -> Option<Name> {
    let class = &state.lowered.document.classes[instance.class];
    match &*class.constraints[instance.index as usize].rule {
        Term::Binary(BinaryOperator::Equal, left, right) => match (&**left, &**right) {
            // two places of which nothing is measured are level, upright, or one
            (Term::Send { .. }, Term::Send { arguments, .. }) if arguments.is_empty() => None,
            (Term::Send { name, .. }, _) => Some(name.clone()),
            _ => None,
        },
        _ => None,
    }
}

/// Asks of what is said of one thing's parts alone whether it is meant of its whole class, where the document
/// declares that.
fn for_every(state: &State, target: &Path, members: &str) -> Option<Question> {
    if !target.is_empty() || !members.starts_with("constraint ") {
        return None;
    }
    let spoken = classing::things_spoken_of(state, members);
    let (_, name) = spoken.first()?;
    if spoken.iter().any(|(_, other)| other != name) {
        return None;
    }
    let path = parse_path(name)?;
    let class = words::class_name(state, thing_at(state, &path)?);
    let of_class = state.lowered.document.class_named(&class)?;
    if !state.lowered.declares_class(&class) {
        return None;
    }
    let mut said = members.to_string();
    for (start, name) in spoken.iter().rev() {
        let (start, end) = (*start as usize, *start as usize + name.len() + 1);
        // a thing as a whole has no name in its class
        if said.get(end - 1..end) != Some(".") {
            return None;
        }
        said.replace_range(start..end, "");
    }
    let things = state.structure.things.iter();
    let number = things.filter(|(_, t)| state.lowered.document.is_a(t.class, of_class)).count();
    let only = Command::Edit { target: Path::default(), members: members.into() };
    let every = Command::Edit { target: parse_path(&class)?, members: said };
    Some(Question {
        message: format!("Is this of {name} alone, or of every {class} ({number} here)?"),
        choices: vec![
            Choice { label: format!("only {name}"), command: only },
            Choice { label: format!("every {class}"), command: every },
        ],
    })
}

/// Leaves of what is offered to mend contradictions no letting go of a place after which as much is broken as before.
pub(crate) fn keep_helping(open: &Open, host: &dyn Host, contradictions: &mut [ContradictionView]) {
    if open.state.structure.things.len() > MOST_THINGS {
        return;
    }
    let was_broken = broken(open);
    let is_idle = |choice: &Choice| {
        let lets_go = matches!(choice.command, Command::Anchor { held: false, .. });
        lets_go && {
            let mut trial = open.trial();
            let done = apply::apply(&mut trial, host, &choice.command);
            done.is_ok() && broken(&trial) >= was_broken
        }
    };
    for contradiction in contradictions {
        let (idle, helping) = contradiction.choices.drain(..).partition(is_idle);
        contradiction.choices = helping;
        let idle: Vec<Choice> = idle;
        contradiction.repairs.retain(|repair| !idle.iter().any(|choice| choice.label == *repair));
    }
}

/// The paths and names of the constraints of a document.
fn constraints(state: &State) -> BTreeSet<String> {
    sources(state).filter_map(|source| words::source_name(state, source)).collect()
}

fn sources(state: &State) -> impl Iterator<Item = plan::Source> {
    (0u32..).take(state.structure.constraints.len()).map(plan::Source::Constraint)
}

/// Returns the command that gives a dimension another value, where a constraint of the document gives it one that is
/// read so, and the new one holds; nothing where it would be a new one, or contradict others.
pub(crate) fn said_anew(
    open: &Open,
    host: &dyn Host,
    read: ReadValue,
    command: &Command,
) -> Option<Command> {
    let (left, value) = equation(command).filter(|_| open.pane.is_none())?;
    let rule = format!("{left} = {value}");
    let own = open.state.members(SyntaxKind::Constraint);
    // a constraint that is switched off, or yields, says nothing: another one does
    let is_said = |state: &State| offers::holds(state, &[&rule]);
    let said = own.filter_map(|member| said_by(&open.state, member, read));
    with_number(open, host, said.filter(|said| said.left == left), value, is_said)
}

/// The same in the pane of a class, of what its body says. The document is the one that declares it.
pub(crate) fn said_anew_of_class(
    home: &Open,
    host: &dyn Host,
    (class, name): (&Name, &Name),
    read: ReadValue,
    command: &Command,
) -> Option<Command> {
    let (left, value) = equation(command)?;
    let left = left.strip_prefix(&**name)?.strip_prefix('.')?;
    let own = classing::constraints_of(&home.state, class);
    let said = own.filter_map(|member| said_by(&home.state, member, read));
    with_number(home, host, said.filter(|said| said.left == left), value, |_| true)
}

/// What a command says is equal to what.
fn equation(command: &Command) -> Option<(&str, &str)> {
    let Command::Edit { target, members } = command else { return None };
    let is_one = target.is_empty() && !members.contains('\n');
    members.strip_prefix("constraint ").filter(|_| is_one)?.split_once(" = ")
}

fn said_by(state: &State, member: Member, read: ReadValue) -> Option<EqualsNumber> {
    match member {
        Member::Constraint(constraint) => read(state, &constraint),
        _ => None,
    }
}

/// Returns the command by which one of some constraints says another value; nothing where that would not hold.
fn with_number(
    open: &Open,
    host: &dyn Host,
    said: impl Iterator<Item = EqualsNumber>,
    value: &str,
    is_said: impl Fn(&State) -> bool,
) -> Option<Command> {
    let text = &open.state.text;
    said.take(MOST_REPLACED).find_map(|said| {
        // the number alone, so that all that is said beside it stays
        let insert = value.trim().to_string();
        let edited = syntax::edit::apply(text, &[TextEdit { span: said.span, insert }]);
        let (state, planner) = State::of_joined(edited, &open.state, host, Plans::default());
        // what is drawn is given where it lies then
        let (state, mut planner) = settle_places(&open.state, state, planner, host);
        let is_right = !state.has_errors() && state.status(&mut planner).satisfied;
        (is_right && is_said(&state)).then(|| Command::Text(state.text.clone()))
    })
}

/// Returns the command that says something in the place of a thing; nothing where it would not hold, or where more would
/// go with the thing: words that speak of it, or merges that others have through it.
pub(crate) fn instead_of(
    open: &Open,
    host: &dyn Host,
    thing: &Path,
    command: &Command,
) -> Option<Command> {
    let Some(Step::Part(name)) = thing.0.last() else { return None };
    if is_spoken_of(&open.state.text, name) {
        return None;
    }
    let joined = joined_by(&open.state, thing_at(&open.state, thing)?);
    let mut trial = open.trial();
    apply::apply(&mut trial, host, command).ok()?;
    apply::apply(&mut trial, host, &Command::Delete(thing.clone())).ok()?;
    let first =
        |path: &Path| thing_at(&trial.state, path).map(|thing| trial.state.structure.merged[thing]);
    let are_one = |all: &Vec<Path>| {
        all.iter().all(|path| first(path).is_some() && first(path) == first(&all[0]))
    };
    let is_right = trial.status.satisfied && joined.iter().all(are_one);
    is_right.then(|| Command::Text(trial.state.text.clone()))
}

/// Whether a text speaks of a name besides where it declares it, and in merges.
fn is_spoken_of(text: &str, name: &Name) -> bool {
    let file = syntax::parse(base::FileId(0), text).file();
    let words = |node: &SyntaxNode| {
        let tokens = node.descendants_with_tokens().filter_map(SyntaxElement::into_token);
        tokens.filter(|token| token.text() == &**name).count()
    };
    let merges = file.syntax().descendants().filter_map(Merge::cast);
    let in_merges: usize = merges.map(|merge| words(merge.syntax())).sum();
    words(file.syntax()) > in_merges + 1
}

/// What each part of a thing is merged with outside of it.
fn joined_by(state: &State, thing: ThingId) -> Vec<Vec<Path>> {
    let structure = &state.structure;
    let others = |part| {
        let all = structure.merged_with(part).into_iter();
        let all = all.filter(|&other| structure.things[other].owner != Some(thing));
        all.map(|other| structure.path(&state.lowered.document, other)).collect()
    };
    structure.parts(thing).map(others).collect()
}

/// What a constraint is called; its rule, where it has no name of its own.
fn in_words(state: &State, name: &str) -> String {
    let is_it = |source: &plan::Source| {
        words::source_name(state, *source).is_some_and(|known| known == name)
    };
    let found = sources(state).find(is_it).and_then(|source| rules::told(state, source));
    found.unwrap_or_else(|| name.to_string())
}

/// Returns the command for a dimension that only reads what another would set; nothing where there is none, or where it
/// would not stand in the document.
pub(crate) fn only_read(open: &Open, host: &dyn Host, members: &str) -> Option<Command> {
    let members = reference(&open.state, members)?;
    let command = Command::Edit { target: Path::default(), members };
    let mut trial = open.trial();
    apply::apply(&mut trial, host, &command).ok()?;
    let errors = |state: &State| {
        let wrong = state.diagnostics.iter();
        wrong.filter(|d| d.severity == base::Severity::Error).count()
    };
    let is_right = errors(&trial.state) <= errors(&open.state);
    (is_right && (trial.status.satisfied || !open.status.satisfied)).then_some(command)
}

/// Returns the members of a dimension that only reads what another would set.
fn reference(state: &State, members: &str) -> Option<String> {
    let named = |class: &str| {
        state.lowered.document.class_named(class)?;
        Some(recognise::free_name(state, &Name::new(class)))
    };
    let rule = members.strip_prefix("constraint ")?;
    let (left, _) = rule.split_once(" = ")?;
    // what is stored becomes one with the dimension's parts, what is computed is read
    let between = |message: &str, class: &str| {
        let (from, to) = left.split_once(message)?;
        let to = to.strip_suffix(')')?;
        Some(format!("{}: {class} {{ from = {from}  to = {to} }}", named(class)?))
    };
    let two = between(".angle(to: ", "ReferenceAngle")
        .or_else(|| between(".distance(to: ", "ReferenceDistance"));
    if two.is_some() {
        return two;
    }
    let (whole, what) = left.rsplit_once('.')?;
    let is_a = |class: &str| {
        let wanted = state.lowered.document.class_named(class);
        let found = parse_path(whole).and_then(|path| class_at(state, &path));
        matches!((found, wanted), (Some(f), Some(w)) if state.lowered.document.is_a(f, w))
    };
    let (class, parts) = match what {
        "length" if is_a("Line") => {
            ("ReferenceDistance", format!("from = {whole}.p1  to = {whole}.p2"))
        }
        "radius" if is_a("Circle") => ("ReferenceRadius", format!("circle = {whole}")),
        _ => return None,
    };
    Some(format!("{}: {class} {{ {parts} }}", named(class)?))
}
