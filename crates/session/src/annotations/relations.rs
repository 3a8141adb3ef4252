//! Relations that are things: each has one sign, whatever it says of its parts.
//!
//! In: a state. Out: of each thing that draws nothing, and whose parts are those of others, its sign by its class, as
//! `T` of `TangentOutside`; or the dimension that it gives, with what types another.

use super::{in_degrees, in_words, pictured, sign};
use crate::offers::in_degrees as written_in_degrees;
use crate::session::thing_at;
use crate::state::State;
use crate::view::{Annotation, Deed, Offer, Shows};
use crate::words;
use base::Name;
use eval::{Answer, Evaluator};
use expr::Dimension;
use kernel::{ClassKind, ConstraintInstance, Path, Step, ThingId};
use std::collections::BTreeMap;

/// The classes that give a number, each with how it is drawn and what it is called.
const DIMENSIONS: [(&str, Shows, &str); 2] = [
    ("OffsetFromLine", Shows::Length, "offset"),
    ("AngleBetween", Shows::Angle([false; 2]), "angle"),
];

/// Returns the signs of the relations among some things, each with its thing.
pub(super) fn signs<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    is_part: impl Fn(ThingId) -> bool,
) -> Vec<(ThingId, Annotation)> {
    let structure = &state.structure;
    let things = structure.things.iter().map(|(thing, _)| thing).filter(|&thing| {
        is_part(thing) && structure.merged[thing] == thing && structure.slot_of(thing).is_none()
    });
    let mut rules: BTreeMap<ThingId, Rules> = BTreeMap::new();
    for (index, rule) in (0u32..).zip(structure.constraints.iter().copied()) {
        rules.entry(rule.owner).or_default().push((index, rule));
    }
    let own = |thing| rules.get(&thing).map_or(&[][..], Vec::as_slice);
    things.filter_map(|thing| Some((thing, of(state, evaluator, thing, own(thing))?))).collect()
}

/// The constraints of a thing, each with its index.
type Rules = Vec<(u32, ConstraintInstance)>;

fn of<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    thing: ThingId,
    rules: &[(u32, ConstraintInstance)],
) -> Option<Annotation> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let class = structure.things[thing].class;
    let said = &document.classes[class];
    if said.kind != ClassKind::Composite || said.constraints.is_empty() && said.merges.is_empty() {
        return None;
    }
    let path = structure.path(document, thing);
    let parts = document.layout(class).into_iter();
    let parts = parts.filter_map(|f| structure.part_named(thing, document.field_name(f)));
    let parts: Vec<ThingId> = parts.filter(|&part| structure.slot_of(part).is_none()).collect();
    // parts of its own are not what a relation is of
    if parts.is_empty() || !parts.iter().all(|&part| structure.is_merged(part)) {
        return None;
    }
    let of = |part: &ThingId| pictured(state, &structure.path(document, *part));
    let of: Vec<String> = parts.iter().map(of).collect::<Option<_>>()?;
    let drawn = evaluator.ask(thing, &Name::new("picture"));
    if !matches!(drawn, Ok(Answer::Picture(elements)) if elements.is_empty()) {
        return None;
    }
    let is_on = |rule| evaluator.is_on(rule).unwrap_or(false);
    let holds = |rule| evaluator.test(rule).is_ok_and(|verdict| verdict.holds);
    let first = rules.first().map(|(index, _)| *index);
    if first.is_some() && !rules.iter().any(|(_, rule)| is_on(*rule)) {
        return None;
    }
    let annotation = Annotation {
        path: path.to_string(),
        says: first.map(|index| words::rule_alone(state, index)).unwrap_or_default(),
        words: sign(&said.name),
        shows: Shows::Relation,
        of,
        holds: rules.iter().all(|(_, rule)| !is_on(*rule) || holds(*rule)),
        measure: None,
        number: None,
        typed: None,
    };
    let is_it = |(name, ..): &&(&str, Shows, &str)| {
        document.class_named(name).is_some_and(|dimension| document.is_a(class, dimension))
    };
    Some(match DIMENSIONS.iter().find(is_it) {
        Some((_, shows, label)) => dimension(state, evaluator, &path, (*shows, label), annotation)?,
        None => annotation,
    })
}

/// The dimension that a thing gives by its value.
fn dimension<'a>(
    state: &'a State,
    evaluator: &Evaluator<'a>,
    path: &Path,
    (shows, label): (Shows, &str),
    annotation: Annotation,
) -> Option<Annotation> {
    let value = path.then(Step::Part(Name::new("value")));
    let Ok(Answer::Number(x, of)) = evaluator.at(&value) else { return None };
    let slot = thing_at(state, &value).and_then(|thing| state.structure.slot_of(thing))?;
    let (words, written) = match of == Dimension::LENGTH {
        true => (in_words(state, x, of), words::slot_exactly(state, slot, &state.values)),
        false => (in_degrees(x), written_in_degrees(x)),
    };
    let typed = Offer {
        label: label.into(),
        value: Some(written),
        deed: Deed::Give(value),
        ..Offer::default()
    };
    let measure = Some(label.into());
    Some(Annotation { words, shows, measure, number: Some(x), typed: Some(typed), ..annotation })
}
