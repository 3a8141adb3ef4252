//! Restoring: members with an error are read as they were when they last had none.

use crate::lower::{Lowered, OWN};
use base::{Name, Severity, Span};
use syntax::ast::{AstNode, Member};
use syntax::edit::apply;
use syntax::{SyntaxNode, TextEdit};

/// A stretch of the text that is read as something else.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Patch {
    /// The bytes of the text.
    pub(crate) text: Span,
    /// The bytes of the effective text that stand for them.
    pub(crate) effective: Span,
}

/// What a member is called, and which of several alike.
type Key = (u16, Vec<Name>, usize);

/// Returns the text with every wrong member as it was in `before`, or without it.
pub(crate) fn restore(wrong: &Lowered, before: &str) -> (String, Vec<Patch>) {
    let spans: Vec<Span> = wrong
        .diagnostics
        .iter()
        .filter(|d| d.severity == Severity::Error && d.place.file == OWN)
        .map(|d| d.place.span)
        .collect();
    let old = keyed(&syntax::parse(OWN, before).syntax());
    let mut edits = Vec::new();
    for (key, node) in keyed(&wrong.files[OWN].parse.syntax()) {
        let span = syntax::span_of(&node);
        if !spans.iter().any(|s| s.start <= span.end && span.start <= s.end) {
            continue;
        }
        let was = old.iter().find(|(k, _)| *k == key).map(|(_, n)| n.text().to_string());
        edits.push(TextEdit { span, insert: was.unwrap_or_default() });
    }
    let mut patches = Vec::new();
    let mut shift: i64 = 0;
    for edit in &edits {
        let start = (i64::from(edit.span.start) + shift) as u32;
        let effective = Span::new(start, start + edit.insert.len() as u32);
        patches.push(Patch { text: edit.span, effective });
        shift += edit.insert.len() as i64 - (i64::from(edit.span.end) - i64::from(edit.span.start));
    }
    (apply(&wrong.files[OWN].text, &edits), patches)
}

/// Returns every member of a file with its key.
fn keyed(file: &SyntaxNode) -> Vec<(Key, SyntaxNode)> {
    let mut keyed: Vec<(Key, SyntaxNode)> = Vec::new();
    for node in file.children().filter(|n| Member::cast(n.clone()).is_some()) {
        let names = match Member::cast(node.clone()) {
            Some(Member::Part(part)) => part.names().map(|w| w.name()).collect(),
            Some(Member::Class(class)) => class.name().into_iter().map(|w| w.name()).collect(),
            Some(Member::Constraint(c)) => c.name().into_iter().map(|w| w.name()).collect(),
            Some(Member::Message(m)) => m.name().into_iter().map(|w| w.name()).collect(),
            _ => Vec::new(),
        };
        let kind = node.kind() as u16;
        let alike = keyed.iter().filter(|((k, n, _), _)| *k == kind && *n == names).count();
        keyed.push(((kind, names, alike), node));
    }
    keyed
}
