//! Sides: which way things go from where two branches meet, as lines of the document.

use super::home::Home;
use crate::lower::Lowered;
use crate::uses::Text;
use kernel::{Path, SideWay};
use syntax::SyntaxKind;
use syntax::ast::{AstNode, Member};
use syntax::edit::{self, TextEdit};

/// Returns the edits after which the document's own lines say these new sides, and of the others only those
/// that are to be kept.
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
    let mut edits = Vec::new();
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
            None => edits.push(edit::delete_member(member.syntax())),
        }
    }
    let lines = missing.iter().map(|(path, way)| format!("side {path}: {}", way.word()));
    let lines = lines.collect::<Vec<_>>().join("\n");
    if !lines.is_empty() {
        edits.extend(text.said_in(&home, SyntaxKind::Anchor, &lines).edits);
    }
    let carry = |e: TextEdit| Some(TextEdit { span: lowered.in_text(e.span)?, insert: e.insert });
    let mut edits: Vec<TextEdit> = edits.into_iter().filter_map(carry).collect();
    edits.sort_by_key(|e| e.span.start);
    edits
}
