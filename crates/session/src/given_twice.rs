//! Places that a hand has made one and that the text gives twice: it gives them once, where they count.
//!
//! In: the state before an edit by hand, and what the text means after it. Out: the edits of the text that take away what does not count
//! any more. What was given twice before is left alone.

use crate::session::thing_at;
use crate::state::State;
use crate::unlike::around;
use kernel::{Structure, ThingId};
use lang::Lowered;
use std::collections::BTreeSet;
use syntax::ast::AstNode;
use syntax::edit::TextEdit;
use syntax::{SyntaxKind, SyntaxNode};

/// Returns the edits that leave out what of merged places the text gives besides what counts.
pub(crate) fn forgotten(
    before: &State,
    (lowered, structure): (&Lowered, &Structure),
) -> Vec<TextEdit> {
    let merged = structure.merged.iter().filter(|(t, _)| structure.merged_with(*t).len() > 1);
    let is_new = |thing: ThingId| {
        let path = structure.path(&lowered.document, thing);
        let was_double = |was| is_double((&before.lowered, &before.structure), was);
        thing_at(before, &path).is_none_or(|was| !was_double(was))
    };
    let mut doubles: BTreeSet<ThingId> = merged
        .map(|(t, _)| t)
        .filter(|&t| is_double((lowered, structure), t) && is_new(t))
        .collect();
    // where both are anchored neither yields: that is told, and refused
    let anchors = structure.stays.iter().filter(|stay| stay.strength.is_none());
    let anchors: BTreeSet<ThingId> = anchors.map(|stay| stay.thing).collect();
    let is_anchored = |thing| around(structure, thing).any(|t| anchors.contains(&t));
    doubles.retain(|&thing| {
        let others = || structure.merged_with(thing).into_iter().filter(|&other| other != thing);
        !is_anchored(thing) || !others().any(is_anchored)
    });
    if doubles.is_empty() {
        return Vec::new();
    }
    let root = lowered.files[base::FileId(0)].parse.file().syntax().clone();
    let span = |thing: ThingId| {
        let place = lowered.place(structure.given_apart(thing)?.origin);
        (place.file == base::FileId(0)).then_some(place.span)
    };
    let says = |node: &SyntaxNode, span: base::Span| {
        let of = syntax::span_of(node);
        of.start <= span.start && span.end <= of.end
    };
    let mut gone: Vec<SyntaxNode> = Vec::new();
    for span in doubles.iter().filter_map(|&thing| span(thing)) {
        let token = root.token_at_offset(span.start.into()).right_biased();
        let around = token.into_iter().flat_map(|token| token.parent_ancestors());
        let lines = around.filter(|n| n.kind() == SyntaxKind::Assign && says(n, span));
        gone.extend(lines);
    }
    gone.sort_by_key(|node| (node.text_range().start(), node.text_range().end()));
    gone.dedup();
    // a line goes where nothing of it counts
    let given = structure.things.ids().filter(|&t| is_given(structure, t));
    for span in given.filter(|t| !doubles.contains(t)).filter_map(span) {
        gone.retain(|node| !says(node, span));
    }
    let is_gone = |node: &SyntaxNode| gone.contains(node);
    let mut bodies: Vec<SyntaxNode> = Vec::new();
    let mut edits = Vec::new();
    let mut rest: Vec<SyntaxNode> = Vec::new();
    for node in &gone {
        match node.parent().filter(|body| body.kind() == SyntaxKind::Body) {
            Some(body) if body.children().all(|member| is_gone(&member)) => {
                if !bodies.contains(&body) {
                    edits.push(without_body(&body));
                    bodies.push(body);
                }
            }
            _ => rest.push(node.clone()),
        }
    }
    edits.extend(syntax::edit::delete_members(&rest));
    edits
}

/// The edit that takes an empty body away, with the space before it.
fn without_body(body: &SyntaxNode) -> TextEdit {
    let span = syntax::span_of(body);
    let space = body.prev_sibling_or_token().filter(|e| e.kind() == SyntaxKind::Whitespace);
    let start = space.map_or(span.start, |space| u32::from(space.text_range().start()));
    TextEdit { span: base::Span::new(start, span.end), insert: String::new() }
}

fn is_given(structure: &Structure, thing: ThingId) -> bool {
    structure.slot_of(thing).is_some() && structure.given_apart(thing).is_some()
}

/// Whether the document gives a coordinate that counts as another part of the document gives it.
fn is_double((lowered, structure): (&Lowered, &Structure), thing: ThingId) -> bool {
    let Some(slot) = structure.slot_of(thing) else { return false };
    let (Some(given), Some(own)) = (structure.given(slot), structure.given_apart(thing)) else {
        return false;
    };
    let is_own = |origin| lowered.is_own_given(origin);
    structure.slots[slot].place.is_some()
        && given.origin != own.origin
        && is_own(given.origin)
        && is_own(own.origin)
}
