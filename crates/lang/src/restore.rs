//! Restoring: members with an error are read as they were when they last had none.
//!
//! In: what a text means, its errors, and the text that last had none. Out: the text with every wrong
//! member as it was there, or without it. First only the innermost member around an error is
//! touched; where that does not do, as when a class lost a part, the whole class or thing.

use crate::lower::{Lowered, OWN};
use base::{Name, Severity, Span};
use std::collections::BTreeMap;
use syntax::ast::{AstNode, Member};
use syntax::edit::{apply, body_of};
use syntax::{Parse, SyntaxKind, SyntaxNode, TextEdit};

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

/// How much around an error is restored.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Grain {
    /// The innermost member.
    Inner,
    /// The member of the document.
    Outer,
}

/// Returns the text with every wrong member as it was in `before`, or without it.
pub(crate) fn restore(wrong: &Lowered, before: &Parse, grain: Grain) -> (String, Vec<Patch>) {
    let spans: Vec<Span> = wrong
        .diagnostics
        .iter()
        .filter(|d| d.severity == Severity::Error && d.place.file == OWN)
        .map(|d| d.place.span)
        .collect();
    let mut edits = Vec::new();
    let old = before.syntax();
    mend(&wrong.files[OWN].parse.syntax(), Some(&old), &spans, grain, &mut edits);
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

/// Mends the members of a file or body by those of the one that was there before.
fn mend(
    body: &SyntaxNode,
    before: Option<&SyntaxNode>,
    wrong: &[Span],
    grain: Grain,
    edits: &mut Vec<TextEdit>,
) {
    let old = before.map(keyed).unwrap_or_default();
    for (key, node) in keyed(body) {
        let span = syntax::span_of(&node);
        let errors: Vec<Span> =
            wrong.iter().copied().filter(|s| s.start <= span.end && span.start <= s.end).collect();
        if errors.is_empty() {
            continue;
        }
        let was = old.iter().find(|(k, _)| *k == key).map(|(_, n)| n);
        let has_members =
            grain == Grain::Inner && matches!(node.kind(), SyntaxKind::Class | SyntaxKind::Part);
        let inside =
            body_of(&node).filter(|b| has_members && errors.iter().all(|s| is_inside(b, *s)));
        match inside {
            Some(inner) => mend(&inner, was.and_then(body_of).as_ref(), &errors, grain, edits),
            None => {
                let insert = was.map(|n| n.text().to_string()).unwrap_or_default();
                edits.push(TextEdit { span, insert });
            }
        }
    }
}

/// Returns true if an error stands within one member of a body that is closed.
fn is_inside(body: &SyntaxNode, error: Span) -> bool {
    let closed = body.last_token().is_some_and(|t| t.kind() == SyntaxKind::RBrace);
    closed
        && body.children().any(|member| {
            let span = syntax::span_of(&member);
            span.start <= error.start && error.end <= span.end
        })
}

/// Returns every member of a file or body with its key.
fn keyed(body: &SyntaxNode) -> Vec<(Key, SyntaxNode)> {
    let mut keyed: Vec<(Key, SyntaxNode)> = Vec::new();
    let mut counts: BTreeMap<(u16, Vec<Name>), usize> = BTreeMap::new();
    for node in body.children() {
        let Some(member) = Member::cast(node.clone()) else { continue };
        let names = match &member {
            Member::Part(part) => part.names().map(|w| w.name()).collect(),
            Member::Class(class) => class.name().into_iter().map(|w| w.name()).collect(),
            Member::Constraint(c) => c.name().into_iter().map(|w| w.name()).collect(),
            Member::Merge(m) => m.name().into_iter().map(|w| w.name()).collect(),
            Member::Message(m) => m.name().into_iter().map(|w| w.name()).collect(),
            Member::Assign(a) => {
                a.target().map(|t| Name::new(&t.syntax().text().to_string())).into_iter().collect()
            }
            _ => Vec::new(),
        };
        let kind = node.kind() as u16;
        let count = counts.entry((kind, names.clone())).or_default();
        keyed.push(((kind, names, *count), node));
        *count += 1;
    }
    keyed
}
