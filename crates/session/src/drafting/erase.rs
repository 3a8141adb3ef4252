//! What a program drew, deleted by hand: erased in the program, so that what speaks of it still can, or its step
//! deleted with all that speaks of that.

use super::{steps, text};
use crate::classing::refuse_new_errors;
use crate::host::{Beside, Host};
use crate::session::{Session, thing_at};
use crate::state::State;
use crate::view::{Choice, DocumentId, Question, Refusal};
use crate::words;
use kernel::{Command, Path, Step};
use plan::Plans;

/// So many steps are named that go with another.
const MOST_NAMED: usize = 6;

impl Session {
    /// Returns what has to be asked where something is to be deleted that a program drew: the ways to do it, each
    /// tried. Nothing where no program drew it.
    ///
    /// # Errors
    /// The program is a library's, or it can be taken out of it in no way.
    pub fn drawn_deletion(&self, id: DocumentId, path: &Path) -> Result<Option<Question>, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        question(&self.document(id).state, &beside, path)
    }
}

fn question(state: &State, host: &dyn Host, path: &Path) -> Result<Option<Question>, Refusal> {
    let document = &state.lowered.document;
    let things = (1..path.0.len()).rev();
    let whole = things.map(|n| Path(path.0[..n].to_vec())).find_map(|whole| {
        let thing = thing_at(state, &whole)?;
        let class = state.structure.things[thing].class;
        document.program(class).is_some().then_some((whole, thing, class))
    });
    // a parameter is a part of its own
    let Some((whole, thing, class)) = whole.filter(|_| thing_at(state, path).is_none()) else {
        return Ok(None);
    };
    let program = steps::program_of(state, &whole.to_string());
    let program = program.map_or_else(|| words::class_name(state, thing), |name| name.to_string());
    let source = &text::Source::now(state);
    if text::program(source, &program).is_none() {
        let message =
            format!("{path} is drawn by the program {program}, which is not this document's");
        return Err(words::refuse(message));
    }
    let Some(address) = address(source, &program, &path.0[whole.0.len()..]) else {
        return Err(words::refuse(format!("{path} is drawn by no step of {program}")));
    };
    let (around, name) = address.rsplit_once('.').unwrap_or(("", &address));
    let along = steps::dependents(source, &program, &address);
    let mut choices = Vec::new();
    let mut refusals = Vec::new();
    let mut offer = |label: String, edited: Result<String, Refusal>| match edited {
        Ok(edited) => {
            let trial = State::of(edited.clone(), Some(state), host, Plans::default()).0;
            match refuse_new_errors(state, &trial, "it cannot go") {
                Ok(()) => choices.push(Choice { label, command: Command::Text(edited) }),
                Err(refusal) => refusals.push(refusal),
            }
        }
        Err(refusal) => refusals.push(refusal),
    };
    let still = match along.len() {
        0 => String::new(),
        1 => String::from("; one step still needs it"),
        n => format!("; {n} steps still need it"),
    };
    let erased = text::block(source, &program, around).map(|body| {
        let blocks = around.split('.').filter(|s| !s.is_empty() && *s != "then" && *s != "else");
        text::with_lines(source, &body, 1 + blocks.count(), &format!("erase {name}"))
    });
    let none = || words::refuse(format!("{program} has no block {around}"));
    offer(format!("erase {name}{still}"), erased.ok_or_else(none));
    let with = match along.len() {
        0 => String::new(),
        n if n <= MOST_NAMED => format!(", and with it {}", words::listed(&along)),
        n => {
            format!(", and with it {} and {} more", along[..MOST_NAMED].join(", "), n - MOST_NAMED)
        }
    };
    let gone = [&along[..], std::slice::from_ref(&address)].concat();
    offer(format!("delete the step {name}{with}"), steps::without(source, &program, &gone));
    if choices.is_empty() {
        return Err(refusals.into_iter().next().unwrap_or_default());
    }
    let alike = state.structure.things.iter().filter(|(_, t)| document.is_a(t.class, class));
    let message = match alike.count() {
        1 => format!("{name} is drawn by the program {program}, which changes then."),
        n => format!("{name} is drawn by the program {program}: all {n} here change with it."),
    };
    Ok(Some(Question { message, choices }))
}

/// Finds the step that made what a path within a thing leads to: the innermost.
fn address(source: &text::Source, program: &str, within: &[Step]) -> Option<String> {
    let named = within.iter().filter_map(|step| match step {
        Step::Part(name) => Some(&**name),
        _ => None,
    });
    let names: Vec<&str> = named.collect();
    // blocks without names are not seen from outside
    let is_seen = |segment: &&str| text::is_name(segment);
    let fits = |address: &String| {
        let seen: Vec<&str> = address.split('.').filter(is_seen).collect();
        let last = address.rsplit('.').next().is_some_and(|last| is_seen(&last));
        last && names.starts_with(&seen)
    };
    let all = steps::addresses(source, program).into_iter().filter(fits);
    all.max_by_key(|address| address.split('.').filter(is_seen).count())
}
