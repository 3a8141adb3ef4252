//! Copies: things of the document again, a little aside, with the same values.
//!
//! What a thing is called changes, and nothing else of what the text says of it; then the copy is moved in a
//! document of its own, so that what it lies at is written as any move would be.

use super::{member_of, of_classes};
use crate::document::Open;
use crate::drag;
use crate::host::Host;
use crate::recognise;
use crate::session::thing_at;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use base::Name;
use kernel::{Command, Path, Step};
use syntax::ast::{AstNode, Member};
use syntax::edit::TextEdit;

/// How far aside a copy lies, on the sheet.
const ASIDE: f64 = 20.0;

/// Returns the command that copies things of the document, and the first copy's name.
///
/// # Errors
/// A path is no thing of the document itself, or what is said of it speaks of others.
pub(crate) fn duplication(
    open: &Open,
    host: &dyn Host,
    paths: &[Path],
) -> Result<(Command, String), Refusal> {
    let mut text = open.state.text.clone();
    let mut members: Vec<String> = Vec::new();
    let mut first = None;
    for path in paths {
        let [Step::Part(name)] = path.0.as_slice() else {
            return Err(words::refuse(format!(
                "{path} is a part: copy the whole that it is a part of"
            )));
        };
        let state = State::of(text.clone(), Some(&open.state), host, plan::Plans::default()).0;
        let (copy, member) = copy_of(&state, open, host, name)?;
        text = format!("{text}\n{member}\n");
        members.push(member);
        first = first.or(Some(copy));
    }
    let Some(first) = first else { return Err(words::refuse("nothing is selected".into())) };
    Ok((Command::Edit { target: Path::default(), members: members.join("\n") }, first))
}

/// Returns a copy's name, and what the text says of it.
fn copy_of(
    state: &State,
    open: &Open,
    host: &dyn Host,
    name: &Name,
) -> Result<(String, String), Refusal> {
    let thing = thing_at(state, &Path(vec![Step::Part(name.clone())]));
    let Some(thing) = thing else {
        return Err(words::refuse(format!("there is no {name}")));
    };
    let document = &state.lowered.document;
    let class = document.named_class(state.structure.things[thing].class);
    let copy = recognise::free_name(state, &document.classes[class].name);
    let member = renamed(&state.text, name, &copy);
    let Some(member) = member else {
        let message = format!("{name} is declared together with others: it cannot be copied alone");
        return Err(words::refuse(message));
    };
    let mut trial = Open::of(&open.name, format!("{}\n{member}\n", of_classes(&state.text)), host);
    if trial.state.diagnostics.iter().any(|d| d.severity == base::Severity::Error) {
        return Err(words::refuse(format!(
            "{name} speaks of other things: it cannot be copied alone"
        )));
    }
    let path = Path(vec![Step::Part(Name::new(&copy))]);
    let held = thing_at(&trial.state, &path);
    let trial_state = trial.state.clone();
    let pressed =
        held.and_then(|thing| drag::press(&trial_state, &mut trial.planner, thing, path).ok());
    if let Some(mut drag) = pressed {
        let (x, y) = drag.handle();
        drag.to(&trial_state, &mut trial.planner, (x + ASIDE, y + ASIDE));
        // where it cannot be kept the copy lies on its model
        let _ = drag.release(&mut trial, host);
    }
    let moved = member_of(&trial.state.text, &copy);
    Ok((copy, if moved.is_empty() { member } else { moved }))
}

/// Returns what a text says of a thing, of another name; nothing where it is declared with others.
fn renamed(text: &str, name: &Name, to: &str) -> Option<String> {
    let file = syntax::parse(base::FileId(0), text).file();
    let part = file.members().find_map(|member| match member {
        Member::Part(part) if part.names().any(|word| word.text() == &**name) => Some(part),
        _ => None,
    })?;
    let mut words = part.names();
    let (word, None) = (words.next()?, words.next()) else { return None };
    let start = u32::from(part.syntax().text_range().start());
    let span = word.span();
    let span = base::Span::new(span.start - start, span.end - start);
    let whole = part.syntax().text().to_string();
    let edited = syntax::edit::apply(&whole, &[TextEdit { span, insert: to.into() }]);
    Some(edited.trim().to_string())
}
