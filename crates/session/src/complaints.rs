//! Complaints: what the independent checker says of a document.
//!
//! In: an open document. Out: sentences, from the rules alone; none is praise.

use crate::document::{Open, Step};
use crate::texts::Texts;
use eval::checker::{self, Edit};

/// Returns what is wrong with the values, and with what the latest edit of values changed.
pub(crate) fn of(open: &Open) -> Vec<String> {
    let (document, structure) = (&open.state.lowered.document, &open.state.structure);
    match latest_edit(open) {
        Some(step) => {
            let (before, after) = (&step.state.values, step.came.as_ref());
            let after = after.unwrap_or(&open.state.values);
            let (edited, wishes) = (&*step.edited, &*step.wishes);
            let edit = Edit { before, after, edited, wishes };
            let mut complaints = checker::check_edit(document, structure, edit);
            if step.came.is_some() {
                complaints.extend(checker::check_state(document, structure, open.values()));
            }
            complaints
        }
        None => checker::check_state(document, structure, open.values()),
    }
}

/// Returns what speaks against the session itself: an accepted edit that broke what held, or changed
/// what it should not have; a status that says otherwise than the checker.
pub(crate) fn violations(open: &Open) -> Vec<String> {
    let (document, structure) = (&open.state.lowered.document, &open.state.structure);
    let unmet = checker::check_state(document, structure, open.values());
    let mut violations = of(open);
    match latest_edit(open) {
        Some(step) => {
            let before = &step.state;
            let held =
                checker::check_state(&before.lowered.document, &before.structure, &before.values)
                    .is_empty();
            violations.retain(|complaint| held || !unmet.contains(complaint));
        }
        None => violations.clear(),
    }
    if open.status.satisfied != unmet.is_empty() {
        let status = if open.status.satisfied { "all holds" } else { "something does not hold" };
        violations.push(format!("the status says that {status}; the checker: {unmet:?}"));
    }
    violations
}

/// Returns the paths of the values that change where a solved document is solved again.
pub(crate) fn restless(open: &mut Open) -> Vec<String> {
    let state = open.state.clone();
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let mut again = state.values.clone();
    if !open.status.satisfied || !open.planner.satisfy(state.model(), &mut again, &mut texts) {
        return Vec::new();
    }
    again.changed(&state.values).map(|slot| state.slot_path(slot).to_string()).collect()
}

/// Returns the step that led here, if it was an edit of values and nothing is being dragged.
fn latest_edit(open: &Open) -> Option<&Step> {
    open.done.last().filter(|step| !step.edited.is_empty() && open.drag.is_none())
}
