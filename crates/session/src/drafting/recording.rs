//! Recording: each figure that is drawn is a line of the program's text, and one undo step.

use super::blocks::Kind;
use super::catalogue::Call;
use super::dialogue::Operand;
use super::{Dialogue, Home, Recording, blocks, text};
use crate::apply;
use crate::document::Open;
use crate::host::Host;
use crate::recognise;
use crate::sheet;
use crate::state::State;
use crate::view::{Change, Refusal};
use crate::words;
use base::{Name, Severity, Span};
use kernel::{ClassId, Command, DOCUMENT, Path};
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Value};

/// A line of text that makes something.
pub(crate) struct Line {
    /// What it is called.
    pub(crate) name: String,
    /// The line.
    pub(crate) text: String,
    /// What it would take the place of, and which stays, since no step of its block is called so.
    pub(crate) stays: Option<String>,
}

/// Returns the line that makes a figure in a home.
pub(crate) fn line(
    open: &Open,
    home: &Home,
    dialogue: &Dialogue,
    (operands, made): (&[Operand], &str),
) -> Line {
    let state = &open.state;
    let base = &dialogue.tool.base;
    let document = &state.lowered.document;
    match home {
        Home::Document => {
            let name = free_name((state, document.root), base, &BTreeSet::new());
            let operands: Vec<String> = operands.iter().map(|o| o.text.clone()).collect();
            let text = match dialogue.tool.call {
                Call::Placed | Call::Thing => dialogue.tool.thing(&name, &operands),
                // things of a class draw their parts: there it is one that is bound
                _ if open.pane.is_some() => format!("{name}: {} = {made}", dialogue.tool.class),
                Call::Class(_)
                | Call::Make
                | Call::Message(_)
                | Call::Pattern(..)
                | Call::Value => {
                    format!("{name} => {made}")
                }
            };
            Line { name, text, stays: None }
        }
        Home::Program { program, .. } => {
            let of = document.class_named(program).unwrap_or(document.root);
            let taken = text::words_in(&text::Source::now(state), program);
            let name = name_of_other_branch(open, home, base)
                .unwrap_or_else(|| free_name((state, of), base, &taken));
            let of = operands.first().map_or("", |operand| operand.text.as_str());
            // `-line` and `(line)` are drawn by the same step
            let of = of.trim_matches(['-', '(', ')', ' ']);
            let is_in_place = dialogue.tool.is_in_place(state, home, of);
            let before = if is_in_place { step_behind(state, home, of) } else { None };
            // what takes the place of a guide is one
            let is_guide = dialogue.is_guide || before.is_some_and(|before| before.is_guide);
            let guide = if is_guide { "guide " } else { "" };
            let mut text = format!("{guide}{name} = {made}");
            // what is drawn stays where only a guide would be left of it
            let is_erased = before
                .is_some_and(|before| before.is_here && (before.is_guide || !dialogue.is_guide));
            if is_erased {
                text += &format!("\nerase {of}");
            }
            let is_told = is_in_place && !is_erased && !dialogue.is_guide;
            let stays = is_told.then(|| of.to_string());
            Line { name, text, stays }
        }
    }
}

/// The step that drew an operand.
#[derive(Clone, Copy)]
struct Behind {
    /// Whether it draws for construction alone.
    is_guide: bool,
    /// Whether the operand is all of it, and its block the one that is drawn in.
    is_here: bool,
}

/// Finds the step that drew an operand, in the block that is drawn in or around it.
fn step_behind(state: &State, home: &Home, of: &str) -> Option<Behind> {
    let Home::Program { program, .. } = home else { return None };
    let source = text::Source::now(state);
    let name = of.split(['.', '[']).next().unwrap_or_default();
    let own = text::address_of(home);
    let mut address = own.as_str();
    loop {
        let body = text::block(&source, program, address);
        if let Some(is_guide) = body.and_then(|b| guide_among(&text::steps_of(&b), name)) {
            return Some(Behind { is_guide, is_here: address == own && name == of });
        }
        if address.is_empty() {
            return None;
        }
        address = address.rsplit_once('.').map_or("", |(around, _)| around);
    }
}

/// Whether the step of a name is a guide, where it stands or in a branch that makes it there; nothing without one.
fn guide_among(steps: &[text::StepNode], name: &str) -> Option<bool> {
    steps.iter().find_map(|step| match (&step.name, &step.value) {
        (Some(own), _) => (own == name).then_some(step.is_guide),
        (None, Some(choice @ Value::If(_))) => {
            text::inner_steps(choice).iter().find_map(|(_, inner)| guide_among(inner, name))
        }
        (None, _) => None,
    })
}

/// Returns the name that the first branch of an `if` gave to a thing of the same kind, which the second has not made
/// yet: so that steps after both find the one that was made.
fn name_of_other_branch(open: &Open, home: &Home, base: &str) -> Option<String> {
    let Home::Program { program, way, .. } = home else { return None };
    let blocks = &open.recording.as_ref()?.blocks;
    let names = |address: &str| {
        let body = text::block(&text::Source::now(&open.state), program, address);
        body.map(|body| text::names_made(&text::steps_of(&body))).unwrap_or_default()
    };
    let is_alike = |name: &String| {
        let rest = name.strip_prefix(base);
        rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit()))
    };
    // what a branch makes is made where its `if` stands, so that the branches around count, too
    for n in (1..=way.len().min(blocks.len())).rev() {
        let Kind::Choice(choice) = &blocks[n - 1].kind else { return None };
        let address = way[..n].iter().fold(String::new(), |at, w| text::joined(&at, &w.address));
        let (around, own) = address.rsplit_once('.')?;
        let other = text::joined(around, if own == "then" { "else" } else { "then" });
        let made = names(&address);
        let is_free = |name: &String| is_alike(name) && !made.contains(name);
        if choice.is_second()
            && let Some(name) = names(&other).into_iter().find(is_free)
        {
            return Some(name);
        }
    }
    None
}

/// Returns the first error of a state that the one before it has not.
pub(crate) fn new_error(before: &State, after: &State) -> Option<String> {
    let is_new = |d: &&base::Diagnostic| {
        d.severity == Severity::Error && before.diagnostics.iter().all(|b| b.message != d.message)
    };
    after.diagnostics.iter().find(is_new).map(|d| d.message.clone())
}

/// Returns a name that no part and nothing computed of a class has, and that is not taken.
fn free_name((state, of): (&State, ClassId), base: &str, taken: &BTreeSet<String>) -> String {
    let document = &state.lowered.document;
    let is_free = |name: &String| {
        let of = &document.classes[of];
        of.parts.iter().all(|part| *part.name != **name)
            && of.messages.iter().all(|message| *message.name != **name)
            && document.class_named(name).is_none()
            && !taken.contains(name)
    };
    let names = std::iter::once(base.to_string()).chain((2..).map(|i| format!("{base}{i}")));
    { names }.find(is_free).unwrap_or_default()
}

/// Writes a line into a home, as one step.
///
/// # Errors
/// The text would be wrong.
pub(crate) fn write(
    open: &mut Open,
    host: &dyn Host,
    home: &Home,
    line: &Line,
) -> Result<Change, Refusal> {
    match home {
        Home::Document => {
            let edit = Command::Edit { target: Path::default(), members: line.text.clone() };
            apply::apply(open, host, &edit)
        }
        Home::Program { .. } => {
            let text = text::with_members(&text::Source::now(&open.state), home, &line.text)?;
            retext(open, host, text, format!("draw {}", line.name))
        }
    }
}

/// Makes a text the document's own, as one step, unless it is wrong where the present one is not.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn retext(
    open: &mut Open,
    host: &dyn Host,
    text: String,
    label: String,
) -> Result<Change, Refusal> {
    if let Some(unit) = sheet::unit_from_text(&open.state, &text) {
        let text = sheet::text_with(&text, &unit);
        return sheet::with_unit(open, host, unit, |open| retexted(open, host, text, label));
    }
    retexted(open, host, text, label)
}

fn retexted(
    open: &mut Open,
    host: &dyn Host,
    text: String,
    label: String,
) -> Result<Change, Refusal> {
    let before = open.state.clone();
    let plans = open.planner.take_plans();
    let (state, planner) = State::of(text, Some(&before), host, plans);
    let is_error = |d: &&base::Diagnostic| d.severity == Severity::Error;
    let errors = |s: &State| s.diagnostics.iter().filter(is_error).count();
    if errors(&state) > errors(&before) {
        let is_new =
            |d: &&base::Diagnostic| before.diagnostics.iter().all(|b| b.message != d.message);
        let new: Vec<_> =
            state.diagnostics.iter().filter(is_error).filter(is_new).cloned().collect();
        open.give_up(planner);
        return Err(words::refusal_of_text(&state, &new));
    }
    Ok(apply::step_to(open, label, state, planner))
}

/// Begins to record a program.
///
/// # Errors
/// The name is none for a program, or something else is called so.
pub(crate) fn begin(open: &mut Open, host: &dyn Host, name: &str) -> Result<Change, Refusal> {
    let name = name.trim();
    let starts_well = name.chars().next().is_some_and(char::is_uppercase);
    if !starts_well || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
        let message = format!(
            "`{name}` is no name for a program: it begins with a capital and is one word, as Washer"
        );
        return Err(words::refuse(message));
    }
    let program = Name::new(name);
    let change = if text::program(&text::Source::now(&open.state), name).is_some() {
        match example_of(&open.state, &program) {
            Some(_) => Change::default(),
            None => {
                let example = recognise::free_name(&open.state, &program);
                let members = format!("{example}: {name}");
                apply::apply(open, host, &Command::Edit { target: Path::default(), members })?
            }
        }
    } else if open.state.lowered.document.class_named(name).is_some() {
        return Err(words::refuse(format!("there is a class {name} already")));
    } else {
        let example = recognise::free_name(&open.state, &program);
        let members = format!("program {name}() {{\n}}\n{example}: {name}");
        let text = format!("{}\n\n{members}\n", open.state.text.trim_end());
        retext(open, host, text.trim_start().into(), format!("record {name}"))?
    };
    let none = || words::refuse(format!("there is no example of {name}"));
    let example = example_of(&open.state, &program).ok_or_else(none)?;
    open.recording = Some(Recording {
        program,
        example,
        blocks: Vec::new(),
        before: None,
        asks_condition: false,
        replaces: None,
        returns: None,
        removing: None,
        changing: None,
    });
    open.dialogue = None;
    blocks::resume(open);
    Ok(change)
}

/// Returns where the program that is recorded stands in the text.
pub(crate) fn span_recorded(open: &Open) -> Option<Span> {
    let recording = open.recording.as_ref()?;
    Some(text::program(&text::Source::now(&open.state), &recording.program)?.span())
}

/// Returns the first thing of the document that a program draws.
pub(crate) fn example_of(state: &State, program: &Name) -> Option<Name> {
    let document = &state.lowered.document;
    let class = document.class_named(program)?;
    let mut own = state.structure.parts(DOCUMENT);
    let is_placed = |class| document.find_message(class, &Name::new(lang::PLACED), None).is_some();
    let example = own.find(|&part| {
        let of = state.structure.things[part].class;
        document.is_a(of, class) && !is_placed(of)
    })?;
    state.structure.field_name(document, example).cloned()
}
