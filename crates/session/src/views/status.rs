//! The status line: whether all holds, and how much is free.

use crate::document::Open;
use crate::state::State;
use crate::view::{Status, Unmet};
use crate::words;
use plan::Source;
use solve::Level;

/// What a note of numbers that gave way begins with: where warnings are told, each is one, `given-yields`.
pub const GAVE_WAY: &str = "given values gave way";
/// How many numbers that gave way are named.
const MOST_NAMED: usize = 3;

/// Returns what the status line says at once: what is superfluous is not looked for.
pub(crate) fn view(open: &Open) -> Status {
    let state = &open.state;
    let status = &open.status;
    let unmet: Vec<Unmet> = status.unmet.iter().filter_map(|u| unmet(open, u)).collect();
    let satisfied = status.unmet.iter().all(|u| u.level != Level::Required);
    let errors = state.errors();
    let notes: Vec<String> = double_roots(state).into_iter().chain(yielded(state)).collect();
    let said: Vec<String> =
        status.unmet.iter().filter_map(|u| crate::rules::told(state, u.source)).collect();
    let is_empty = state.structure.things.len() == 1 && errors == 0;
    let mut message = match is_empty && said.is_empty() {
        true => "the sheet is empty".into(),
        false => sentence(satisfied, &said, open.freedom(), errors),
    };
    // what is not drawn to its end is worse than what is free is good
    if let Some(ended) = state.diagnostics.iter().find(|d| d.code == "run-ended") {
        message = format!("{}; {message}", ended.message);
    }
    for note in &notes {
        message = format!("{message}; {note}");
    }
    Status {
        satisfied,
        freedom: open.freedom().0 as u32,
        counted: status.more.is_some(),
        unmet,
        redundant: Vec::new(),
        notes,
        message,
        undo: open.done.last().map(|s| s.label.clone()),
        redo: open.undone.last().map(|s| s.label.clone()),
    }
}

/// Says where two solutions coincide, in one sentence.
fn double_roots(state: &State) -> Option<String> {
    let mut paths: Vec<String> =
        state.double_roots.iter().map(|&slot| state.slot_path(slot).to_string()).collect();
    paths.dedup();
    match paths.as_slice() {
        [] => None,
        [one] => Some(format!("{one} is a double root: two solutions coincide there")),
        several => {
            let listed = words::listed(several);
            Some(format!("{listed} are double roots: two solutions coincide there"))
        }
    }
}

/// Says which numbers are others than the text gives them, because something had to give way.
fn yielded(state: &State) -> Option<String> {
    let mut given = state.values.clone();
    let named = state.gave_way.iter().take(MOST_NAMED).map(|(slot, was)| {
        given.put(*slot, was.clone());
        let thing = state.structure.slots[*slot].thing;
        let both = words::show_both(state, thing, [&given, &state.values]);
        let [was, is] = both.unwrap_or_default();
        format!("{} is {is}, given as {was}", state.slot_path(*slot))
    });
    let named: Vec<String> = named.collect();
    let more = match state.gave_way.len().saturating_sub(named.len()) {
        0 => String::new(),
        n => format!(", and {n} more"),
    };
    (!named.is_empty()).then(|| format!("{GAVE_WAY}: {}{more}", named.join(", ")))
}

fn unmet(open: &Open, u: &plan::Unmet) -> Option<Unmet> {
    let state = &open.state;
    let Source::Constraint(index) = u.source else { return None };
    let instance = state.structure.constraints[index as usize];
    let document = &state.lowered.document;
    let constraint = &document.classes[instance.class].constraints[instance.index as usize];
    Some(Unmet {
        constraint: words::constraint_path(state, instance),
        rule: state.lowered.source_of(constraint.origin),
        error: u.error.filter(|e| e.is_finite()),
        strength: state.structure.strength(document, instance).word().into(),
        span: state.lowered.own_span(constraint.origin).map(|s| (s.start, s.end)),
    })
}

fn sentence(
    satisfied: bool,
    unmet: &[String],
    (freedom, is_all): (usize, bool),
    errors: usize,
) -> String {
    let holds = match (satisfied, unmet.len()) {
        (true, 0) => "all constraints hold".to_string(),
        (true, 1) => "all required constraints hold, one softer one does not".to_string(),
        (true, n) => format!("all required constraints hold, {n} softer ones do not"),
        (false, 1) => format!("{} does not hold", unmet[0]),
        (false, _) => format!("{} do not hold", words::listed(unmet)),
    };
    let free = match (freedom, is_all) {
        (0, true) => "nothing is free".to_string(),
        (0, false) => "what is free is not counted yet".to_string(),
        (1, true) => "1 degree of freedom".to_string(),
        (1, false) => "at least 1 degree of freedom".to_string(),
        (n, true) => format!("{n} degrees of freedom"),
        (n, false) => format!("at least {n} degrees of freedom"),
    };
    match errors {
        0 => format!("{holds}; {free}"),
        1 => format!("one error in the text, its last good version is in force; {holds}; {free}"),
        n => {
            format!("{n} errors in the text, the last good versions are in force; {holds}; {free}")
        }
    }
}
