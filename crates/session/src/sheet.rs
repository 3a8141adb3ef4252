//! The unit of a sheet, as the hand says it: the first length that it types with one.
//!
//! Without `unit mm` a bare length is a metre to what has a unit, so that `30 mm` beside a line drawn over 300 units of
//! the sheet would be nothing to see. Who types it means that the sheet is in millimetres. A text that is typed as such
//! is left as it is, and warned of (`mixed-lengths`).

use crate::document::{Direction, Open};
use crate::fixes;
use crate::host::Host;
use crate::session::{Session, thing_at};
use crate::state::State;
use crate::view::{Change, DocumentId, Refusal};
use crate::{apply, by_hand, words};
use base::{FileId, Span};
use kernel::{Command, Literal, Path};
use std::rc::Rc;
use syntax::{SyntaxKind, SyntaxToken};

/// Returns the unit that a sheet takes over from what is written by hand; none where the document names one, or has
/// quantities already to which a bare length is a metre.
pub(crate) fn unit_from(state: &State, written: &str) -> Option<String> {
    if state.lowered.document.unit.is_some() {
        return None;
    }
    let unit = first_unit(written)?;
    (!state.lowered.measures_lengths()).then_some(unit)
}

/// The same, of a whole text that takes the place of the document's: what is new in it tells.
pub(crate) fn unit_from_text(state: &State, text: &str) -> Option<String> {
    if state.lowered.document.unit.is_some() {
        return None;
    }
    unit_from(state, new_lines(&state.text, text))
}

/// Makes a change by hand in a sheet that takes over a unit: one step of the two.
///
/// # Errors
/// Why the change was refused; then the sheet has no unit either.
pub(crate) fn with_unit(
    open: &mut Open,
    host: &dyn Host,
    unit: String,
    act: impl FnOnce(&mut Open) -> Result<Change, Refusal>,
) -> Result<Change, Refusal> {
    let (since, before) = (open.done.len(), open.state.clone());
    let change = open.tried(|open| {
        let text = text_with(&open.state.text, &unit);
        take_anew(open, host, text, format!("unit {unit}"));
        act(open)
    })?;
    open.one_step(since);
    let whole = apply::change(change.label.clone(), &before, &open.state);
    let Change { edits, moved, structure, .. } = whole;
    Ok(Change { edits, moved, structure, unit: Some(unit), ..change })
}

/// Takes a text in which every bare length is another one: nothing is kept from what it was.
fn take_anew(open: &mut Open, host: &dyn Host, text: String, label: String) {
    let plans = open.planner.take_plans();
    let (state, planner) = State::of(text, None, host, plans);
    apply::step_to(open, label, state, planner);
}

/// Returns a text that says what a length without a unit is.
pub(crate) fn text_with(text: &str, unit: &str) -> String {
    let (Span { start, end }, line) = fixes::line_at_head(text, &format!("unit {unit}"));
    format!("{}{line}{}", &text[..start as usize], &text[end as usize..])
}

/// Returns the first unit of a length that a text writes; none for metres, and where the text names that of its sheet.
fn first_unit(text: &str) -> Option<String> {
    let parse = syntax::parse(FileId(0), text);
    if parse.outline().any(|(kind, _)| kind == SyntaxKind::UnitLine) {
        return None;
    }
    let tree = parse.syntax();
    let tokens = std::iter::successors(tree.first_token(), SyntaxToken::next_token);
    let mut units = tokens.filter(|token| token.kind() == SyntaxKind::Unit);
    units.find(|unit| lang::is_unit_of_sheet(unit.text())).map(|unit| unit.text().to_string())
}

/// Returns the lines of a text that another one lacks, from the first to the last of them.
fn new_lines<'t>(old: &str, new: &'t str) -> &'t str {
    let same = |(a, b): &(u8, u8)| a == b;
    let ahead = old.bytes().zip(new.bytes()).take_while(same).count();
    let rest = old.len().min(new.len()) - ahead;
    let behind = old.bytes().rev().zip(new.bytes().rev()).take(rest).take_while(same).count();
    let (from, to) = (ahead, new.len() - behind);
    let bytes = new.as_bytes();
    let is_end = |byte: &u8| *byte == b'\n';
    let start = bytes[..from].iter().rposition(is_end).map_or(0, |at| at + 1);
    let end = bytes[to..].iter().position(is_end).map_or(new.len(), |at| to + at);
    &new[start..end]
}

impl Session {
    /// Sets a value as it is typed where the sheet takes over its unit; nothing where it does not.
    pub(crate) fn set_with_unit(
        &mut self,
        id: DocumentId,
        path: &Path,
        typed: &str,
    ) -> Option<Result<Change, Refusal>> {
        let unit = unit_from(&self.document(self.home(id)).state, typed)?;
        // words in a text have no unit
        if let Ok(Literal::Text(_)) = words::read_typed(&self.document(id).state, path, typed) {
            return None;
        }
        if self.home(id) != id {
            return Some(self.set_in_pane_with_unit(id, unit, (path, typed)));
        }
        let (open, beside) = self.beside_others(id);
        open.drag = None;
        let change = with_unit(open, &beside, unit, |open| {
            let literal = words::read_typed(&open.state, path, typed)?;
            let target = by_hand::anchored_whole(&open.state, path, &literal);
            let target = target.unwrap_or_else(|| (path.clone(), literal));
            apply::apply(open, &beside, &Command::Set(vec![target]))
        });
        Some(change.map(|change| *self.with_reach(id, change)))
    }

    /// Has the text say a number in the unit that it was typed in, where it stands in another: `2.2 kohm`, not
    /// `2200 ohm`. It is of the step that has just been made.
    pub(crate) fn in_unit_typed(
        &mut self,
        id: DocumentId,
        path: &Path,
        typed: &str,
        change: Change,
    ) -> Change {
        let (open, beside) = self.beside_others(id);
        let state = open.state.clone();
        let given = thing_at(&state, path).and_then(|thing| {
            let slot = state.structure.slot_of(thing)?;
            let given = state.structure.given(slot)?;
            let class = state.structure.things[thing].class;
            let unit = lang::unit_typed(typed, class, &state.lowered.document)?;
            let number = (state.values.numbers[slot], class);
            state.lowered.is_own_given(given.origin).then_some((given.origin, number, unit))
        });
        let (Some((origin, number, unit)), None) = (given, &open.pane) else { return change };
        let edits = lang::write_unit(&state.lowered, origin, number, &unit);
        let Some(before) = open.done.last().filter(|_| !edits.is_empty()) else { return change };
        let before = before.state.clone();
        let latest = open.planner.take_latest();
        let text = syntax::edit::apply(&state.text, &edits);
        let (next, mut planner) = State::written(text, &state, &beside, open.planner.take_plans());
        if next.values.changed(&state.values).next().is_some() || next.has_errors() {
            open.give_up(planner);
            open.planner.restore_latest(latest);
            return change;
        }
        planner.restore_latest(latest);
        (open.state, open.planner) = (Rc::new(next), planner);
        let Change { edits, .. } = apply::change(change.label.clone(), &before, &open.state);
        Change { edits, ..change }
    }

    /// Sets a value as it is typed in the pane of a class: the document that declares it takes over the unit.
    fn set_in_pane_with_unit(
        &mut self,
        pane: DocumentId,
        unit: String,
        (path, typed): (&Path, &str),
    ) -> Result<Change, Refusal> {
        let home = self.home(pane);
        let (open, beside) = self.beside_others(home);
        let (since, before) = (open.done.len(), open.state.clone());
        let undone = std::mem::take(&mut open.undone);
        let text = text_with(&open.state.text, &unit);
        take_anew(open, &beside, text, format!("unit {unit}"));
        self.renew_pane(pane);
        let outcome = self.set_typed(pane, &path.to_string(), typed);
        let open = self.document_mut(home);
        match outcome {
            Ok(change) => {
                open.one_step(since);
                let whole = apply::change(change.label.clone(), &before, &open.state);
                let Change { edits, moved, structure, .. } = whole;
                Ok(Change { edits, moved, structure, unit: Some(unit), ..change })
            }
            Err(refusal) => {
                while open.done.len() > since {
                    open.travel(Direction::Back);
                }
                open.undone = undone;
                self.renew_pane(pane);
                Err(refusal)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{first_unit, new_lines, text_with};

    #[test]
    fn the_first_length_with_a_unit_tells() {
        let unit = |text| first_unit(text);
        assert_eq!(unit("30 mm").as_deref(), Some("mm"));
        assert_eq!(unit("constraint line.length = 2 * 3in").as_deref(), Some("in"));
        assert_eq!(unit("0,0"), None);
        assert_eq!(unit("12, 30 mm<45 deg").as_deref(), Some("mm"));
        assert_eq!(unit("2 m"), None);
        assert_eq!(unit("let far = d > 5 in if far then 1 else 2"), None);
        assert_eq!(unit("constraint a.length = 3 in - gap").as_deref(), Some("in"));
        assert_eq!(unit("r: Length = 3 in\n    x: Length").as_deref(), Some("in"));
        assert_eq!(unit("30 mm^2"), None);
        assert_eq!(unit("t: Text = \"Pipe 5 mm\""), None);
        assert_eq!(unit("unit in\nx: Length = 3 mm"), None);
    }

    #[test]
    fn only_lines_that_are_new_are_looked_at() {
        assert_eq!(new_lines("a = 1\nb = 2\nc = 3\n", "a = 1\nb = 25 mm\nc = 3\n"), "b = 25 mm");
        assert_eq!(new_lines("a = 1\n", "a = 1\nä = 2\n"), "ä = 2\n");
        assert_eq!(new_lines("a = 1\n", "a = 1\n"), "");
        assert_eq!(new_lines("", "x"), "x");
    }

    #[test]
    fn a_unit_stands_behind_what_is_used() {
        assert_eq!(
            text_with("use geometry\np: Point\n", "mm"),
            "use geometry\nunit mm\np: Point\n"
        );
        assert_eq!(text_with("", "mm"), "unit mm\n");
    }
}
