//! Edges: those that a contour is made of, picked one by one or followed from end to end; and those of contours and
//! regions that are spoken of by what they come from.

use super::Home;
use super::catalogue::{Slot, SlotKind};
use super::scene::{self, Found};
use super::typed;
use crate::state::State;
use crate::view::{Pointer, Refusal};
use crate::words;
use geometry::{NoContour, Side, Source, contour, edges_of, extent, meets};
use std::collections::{BTreeMap, BTreeSet};
use syntax::ast::{AstNode, Expr};

/// Returns edges with those that go on from their ends, as far as a single one does.
pub(crate) fn followed(state: &State, home: &Home, picked: &[String]) -> Vec<String> {
    let all = edges(state, home);
    let known: BTreeMap<&str, usize> =
        all.iter().enumerate().map(|(i, found)| (found.text.as_str(), i)).collect();
    let chain: Option<Vec<usize>> = picked.iter().map(|p| known.get(p.as_str()).copied()).collect();
    // what is typed leads nowhere by itself
    let Some(mut chain) = chain else { return picked.to_vec() };
    let ends: Vec<[[f64; 2]; 2]> =
        all.iter().map(|found| found.curve.ends().unwrap_or_default()).collect();
    let sides: Vec<Side> = ends.iter().map(|&[from, to]| Side { from, to, bulge: 0.0 }).collect();
    let extent = extent(&sides);
    let is_near = |a, b| meets(a, b, extent);
    let mut is_used = vec![false; all.len()];
    let mut open: Vec<[f64; 2]> = Vec::new();
    let mut at = 0;
    loop {
        // the ends of those that are new
        for &edge in &chain[at..] {
            is_used[edge] = true;
            for end in ends[edge] {
                match open.iter().position(|&other| is_near(other, end)) {
                    Some(other) => _ = open.remove(other),
                    None => open.push(end),
                }
            }
        }
        at = chain.len();
        let next = open.iter().rev().find_map(|&end| {
            let goes_on = |&i: &usize| !is_used[i] && ends[i].iter().any(|&e| is_near(e, end));
            let mut next = (0..all.len()).filter(goes_on);
            next.next().filter(|_| next.next().is_none())
        });
        match next {
            Some(next) => chain.push(next),
            None => return chain.into_iter().map(|i| all[i].text.clone()).collect(),
        }
    }
}

/// Whether edges are no contour yet, and may be one with more: it is open, or leads on several ways.
pub(crate) fn waits(state: &State, home: &Home, picked: &[String]) -> bool {
    let all = edges(state, home);
    let side = |text: &String| {
        let found = all.iter().find(|found| found.text == *text)?;
        match found.curve.source() {
            Some(Source::Line(from, to)) => Some(Side { from, to, bulge: 0.0 }),
            Some(Source::Arc(side)) => Some(side),
            Some(Source::Axis(..) | Source::Circle(..)) => None,
            // how it runs between its ends plays no part
            None => found.curve.ends().map(|[from, to]| Side { from, to, bulge: 0.0 }),
        }
    };
    // what is typed may be any number of them
    let sides: Option<Vec<Side>> = picked.iter().map(side).collect();
    sides.is_none_or(|sides| {
        matches!(contour(&sides), Err(NoContour::Open(_) | NoContour::Branches(_)))
    })
}

/// Joins what is typed with the edges that were picked, as one list.
pub(crate) fn joined(picked: &[String], typed: &str) -> String {
    let Some(list) = as_list(typed) else { return typed.into() };
    let Some(Expr::List(elements)) = typed::expression(&list) else { return list };
    let own = elements.elements().map(|e| e.syntax().text().to_string().trim().to_string());
    let mut all = picked.to_vec();
    for text in own {
        if !all.contains(&text) {
            all.push(text);
        }
    }
    format!("[{}]", all.join(", "))
}

/// Writes what is typed as a list, where it is none and can be one: `a, b` as `[a, b]`.
pub(crate) fn as_list(typed: &str) -> Option<String> {
    match typed::expression(typed) {
        Some(Expr::List(_)) => Some(typed.into()),
        _ => Some(format!("[{typed}]")).filter(|list| typed::expression(list).is_some()),
    }
}

/// Writes edges as the list that they are, with whole sets by their names.
pub(crate) fn written(state: &State, home: &Home, picked: &[String]) -> String {
    let all = edges(state, home);
    let of = |text: &String| all.iter().find(|found| found.text == *text).cloned();
    let Some(caught) = picked.iter().map(of).collect::<Option<Vec<Found>>>() else {
        return format!("[{}]", picked.join(", "));
    };
    let (_, sets) = scene::whole_sets(state, home, &caught);
    let mut said: Vec<&String> = Vec::new();
    for found in &caught {
        let set = found.wholes.iter().rev().find(|set| sets.contains(set));
        let text = set.unwrap_or(&found.text);
        if !said.contains(&text) {
            said.push(text);
        }
    }
    let said: Vec<&str> = said.into_iter().map(String::as_str).collect();
    format!("[{}]", said.join(", "))
}

/// Lists the lines, arcs and curves that a contour can be made of, each once.
pub(crate) fn edges(state: &State, home: &Home) -> Vec<Found> {
    let all = scene::scene(state, home).into_iter();
    let mut known = BTreeSet::new();
    let edges = all.filter(|found| found.side.is_none() && found.curve.ends().is_some());
    edges.filter(|found| known.insert(found.text.clone())).collect()
}

/// Names the edge of a contour or region under a pointer, or its corner, by what it comes from; nothing where no such
/// edge lies there, or a slot wants none.
///
/// # Errors
/// It comes from nothing that has a name here.
pub(crate) fn by_origin(
    state: &State,
    slot: &Slot,
    all: &[Found],
    pointer: &Pointer,
) -> Option<Result<String, Refusal>> {
    let document = &state.lowered.document;
    let class_of =
        |found: &Found| document.class_named(if found.side?.bulge == 0.0 { "Line" } else { "Arc" });
    let fits = |found: &&Found| match slot.kind {
        SlotKind::Curve => class_of(found).is_some_and(|class| slot.takes(state, class)),
        SlotKind::Point | SlotKind::Places => found.corner_at(pointer).is_some(),
        SlotKind::Edges | SlotKind::Set | SlotKind::Value => false,
    };
    // what was drawn last lies above
    let found =
        scene::nearest(all.iter().rev().filter(|f| f.side.is_some()).filter(fits), pointer)?;
    let corner = match slot.kind {
        SlotKind::Point | SlotKind::Places => found.corner_at(pointer),
        _ => None,
    };
    let none = || {
        let message = format!(
            "this edge of {} has no name here: pick the figure that it comes from",
            found.text
        );
        words::refuse(message)
    };
    let edge = named(all, found).ok_or_else(none);
    Some(edge.map(|(edge, is_reversed)| match (corner, found.side) {
        (Some(at_end), Some(side)) => {
            let ends = if side.bulge == 0.0 { ["p1", "p2"] } else { ["start", "end"] };
            format!("{edge}.{}", ends[usize::from(at_end != is_reversed)])
        }
        _ => edge,
    }))
}

/// An edge as it is written by what it comes from, and whether it runs the other way then.
fn named(all: &[Found], edge: &Found) -> Option<(String, bool)> {
    let side = edge.side?;
    let sides: Vec<_> = all.iter().filter(|f| f.text == edge.text).filter_map(|f| f.side).collect();
    let sources = all.iter().filter(|found| found.side.is_none() && !found.is_place);
    let named = sources.filter_map(|found| {
        let edges = edges_of(&sides, &found.curve.source()?);
        let at = edges.iter().position(|other| other.is_one_with(&side))?;
        Some((found, edges, at))
    });
    // of several that it could come from the one that fewest edges come from, then the first
    let (found, edges, at) = { named }.min_by_key(|(_, edges, _)| edges.len())?;
    let is_reversed = match side.bulge == 0.0 {
        true => !edges[at].runs_as(&side),
        // an arc that is found runs to the left
        false => side.bulge < 0.0,
    };
    let class = if side.bulge == 0.0 { "Line" } else { "Arc" };
    let nth = if edges.len() > 1 { format!(", nth: {at}") } else { String::new() };
    let text = format!("{class}.edge(of: {}, from: {}{nth})", edge.text, found.text);
    Some((text, is_reversed))
}
