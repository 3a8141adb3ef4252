//! Sides: which way things go from where two branches meet, as lines of the document.

use super::home::Home;
use crate::lower::Lowered;
use crate::uses::Text;
use kernel::{Path, SideWay};
use syntax::SyntaxKind;
use syntax::ast::{AstNode, Member};
use syntax::edit::{self, TextEdit};

/// Returns the edits after which the document's own lines say these new sides, and of the others only those
/// that are to be kept. New lines stand in the place of one that goes, if one does.
///
/// A line that says what is wanted stays as it is; where a line that has an error would have to be
/// changed, it stays too. What a body says of its parts is its default, and stays.
pub fn write_sides(
    lowered: &Lowered,
    kept: &[(Path, SideWay)],
    new: &[(Path, SideWay)],
) -> Vec<TextEdit> {
    let text = Text::of(lowered);
    let home = Home::document(&text);
    let mut missing: Vec<&(Path, SideWay)> = new.iter().collect();
    let mut gone = Vec::new();
    for member in home.members() {
        let Member::Side(side) = &member else { continue };
        let says = |(path, way): &(Path, SideWay)| {
            side.target().is_some_and(|t| text.leads_to(&t, path))
                && side.side().is_some_and(|word| *word.name() == *way.word())
        };
        match missing.iter().position(|side| says(side)) {
            Some(known) => {
                missing.remove(known);
            }
            None if kept.iter().any(says) => {}
            None => gone.push(member),
        }
    }
    let lines = missing.iter().map(|(path, way)| format!("side {path}: {}", way.word()));
    let lines = lines.collect::<Vec<_>>().join("\n");
    gone.retain(|line| lowered.in_text(line.span()).is_some());
    let mut edits = Vec::new();
    if !lines.is_empty() {
        match gone.pop() {
            Some(line) => edits.push(edit::replace_member(line.syntax(), &lines)),
            None => edits.extend(text.said_in(&home, SyntaxKind::Anchor, &lines).edits),
        }
    }
    edits.extend(gone.iter().map(|line| edit::delete_member(line.syntax())));
    let carry = |e: TextEdit| Some(TextEdit { span: lowered.in_text(e.span)?, insert: e.insert });
    edit::joined(&lowered.effective, edits).into_iter().filter_map(carry).collect()
}
