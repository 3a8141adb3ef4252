//! Restoring: members with an error are read as they were when they last had none.
//!
//! In: what a text means, its errors, and the text that last had none. Out: the text with every wrong
//! member as it was there, or without it. First only the innermost member around an error is
//! touched; where that does not do, as when a class lost a part, the whole class or thing.

use crate::lower::{Lowered, OWN};
use base::{Name, Severity, Span};
use std::collections::{BTreeMap, BTreeSet};
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

/// What a member is called; of several alike the order tells.
type Key = (u16, Vec<Name>);

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
    let around = |node: &SyntaxNode| -> Vec<Span> {
        let span = syntax::span_of(node);
        wrong.iter().copied().filter(|s| s.start <= span.end && span.start <= s.end).collect()
    };
    let members: Vec<SyntaxNode> = body.children().collect();
    let wanted: BTreeSet<Key> =
        members.iter().filter(|n| !around(n).is_empty()).filter_map(key).collect();
    let old = before.map(|before| alike(before.children(), &wanted)).unwrap_or_default();
    let alike = alike(members.into_iter(), &wanted);
    let places =
        alike.iter().flat_map(|(key, nodes)| nodes.iter().enumerate().map(move |n| (key, n)));
    let mut places: Vec<(&Key, (usize, &SyntaxNode))> = places.collect();
    places.sort_by_key(|(_, (_, node))| node.text_range().start());
    for (key, (index, node)) in places {
        let (span, errors) = (syntax::span_of(node), around(node));
        if errors.is_empty() {
            continue;
        }
        let was = old.get(key).and_then(|nodes| nodes.get(index));
        let has_members =
            grain == Grain::Inner && matches!(node.kind(), SyntaxKind::Class | SyntaxKind::Part);
        let inside =
            body_of(node).filter(|b| has_members && errors.iter().all(|s| is_inside(b, *s)));
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

/// Returns the members that are called as some are, in their order.
fn alike(
    members: impl Iterator<Item = SyntaxNode>,
    wanted: &BTreeSet<Key>,
) -> BTreeMap<Key, Vec<SyntaxNode>> {
    let kinds: BTreeSet<u16> = wanted.iter().map(|(kind, _)| *kind).collect();
    let mut alike: BTreeMap<Key, Vec<SyntaxNode>> = BTreeMap::new();
    for node in members.filter(|n| kinds.contains(&(n.kind() as u16))) {
        if let Some(key) = key(&node).filter(|key| wanted.contains(key)) {
            alike.entry(key).or_default().push(node);
        }
    }
    alike
}

/// Returns what a member is called.
fn key(node: &SyntaxNode) -> Option<Key> {
    let names = match &Member::cast(node.clone())? {
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
    Some((node.kind() as u16, names))
}
