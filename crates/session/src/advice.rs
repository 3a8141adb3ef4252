//! Advice: a second view that would let a plan go on one step after the other.
//!
//! In: a document whose equations have to be solved together. Out: things of classes in scope which,
//! merged with what the equations are about, say the same once more, but so that each step tells one
//! value. Every one is tried in a copy of the document.

use crate::document::Open;
use crate::host::Host;
use crate::recognise::{free_name, is_candidate};
use crate::view::Advice;
use crate::words;
use kernel::{ClassId, ClassKind, Document, Path, Step, ThingId};
use plan::{PlanKind, Source};

/// So many things are looked at for one view.
const MOST_THINGS: usize = 12;
/// So many views are tried.
const MOST_TRIALS: usize = 8;
/// Of more numbers that are solved together, one view of a few things unties too little.
const MOST_UNKNOWNS: usize = 200;

/// A class with the things that would be its parts.
struct View {
    class: ClassId,
    /// For every part that is no plain value, its name and the thing.
    parts: Vec<(String, ThingId)>,
}

/// Returns the views that make the opening of a document lighter.
pub(crate) fn advice(open: &Open, host: &dyn Host) -> Vec<Advice> {
    let (state, document) = (&open.state, &open.state.lowered.document);
    let classes = document.classes.iter().filter(|&(id, class)| is_candidate(state, id, class));
    // where nothing looks at others nothing is to be tried, and the document is not opened again
    if !{ classes }.any(|(class, _)| lens(document, class).is_some()) {
        return Vec::new();
    }
    let mut now = Open::of(&open.name, open.state.text.clone(), host);
    let kind = now.planner.latest_kind();
    if !matches!(kind, PlanKind::Block | PlanKind::Relaxation) {
        return Vec::new();
    }
    let things = things_solved_together(&now);
    if things.is_empty() {
        return Vec::new();
    }
    let freedom = now.counted();
    let (state, document) = (&now.state, &now.state.lowered.document);
    let mut advice = Vec::new();
    let classes = document.classes.iter().filter(|&(id, class)| is_candidate(state, id, class));
    let lenses = classes.filter_map(|(class, _)| lens(document, class));
    let views = lenses.flat_map(|lens| views(&now, &lens, &things));
    for view in views.take(MOST_TRIALS) {
        let class = &document.classes[view.class].name;
        let name = free_name(state, class);
        let path = |thing: ThingId| state.structure.path(document, thing).to_string();
        let merges = view.parts.iter();
        let merges = merges.map(|(part, t)| format!("merge {} = {name}.{part}\n", path(*t)));
        let members: String = std::iter::once(format!("{name}: {class}\n")).chain(merges).collect();
        let mut trial = Open::of(&open.name, format!("{}\n{members}", state.text), host);
        let is_lighter = trial.planner.latest_kind() < kind;
        let is_harmless =
            trial.state.diagnostics.len() == state.diagnostics.len() && trial.status.satisfied;
        if is_lighter && is_harmless && trial.counted() == freedom {
            let parts: Vec<String> = view.parts.iter().map(|p| path(p.1)).collect();
            let parts = words::listed(&parts);
            let message = format!(
                "equations about {parts} are solved together; with a {class} of them, one after the other"
            );
            advice.push(Advice { message, members });
        }
    }
    advice
}

/// The things whose constraints are solved together, and what those are parts of, in order; none where that
/// is too much for one view.
fn things_solved_together(open: &Open) -> Vec<ThingId> {
    let structure = &open.state.structure;
    let steps = open.planner.explain().into_iter();
    let together: Vec<_> = steps.filter(|s| s.kind.plan_kind() > PlanKind::OnePass).collect();
    if together.iter().map(|s| s.targets.len()).sum::<usize>() > MOST_UNKNOWNS {
        return Vec::new();
    }
    let mut things: Vec<ThingId> = Vec::new();
    for source in together.into_iter().flat_map(|s| s.sources) {
        let Source::Constraint(c) = source else { continue };
        let mut thing = Some(structure.constraints[c as usize].owner);
        while let Some(t) = thing.filter(|t| *t != kernel::DOCUMENT) {
            if !things.contains(&t) && things.len() < MOST_THINGS {
                things.push(t);
            }
            thing = structure.things[t].owner;
        }
    }
    things
}

/// A class that looks at a few things at once: these, by name, and the parts of theirs that it makes one.
struct Lens<'d> {
    class: ClassId,
    fields: Vec<(String, ClassId)>,
    merges: Vec<&'d kernel::Merge>,
}

/// Returns a class as one that looks at others, where it does.
fn lens(document: &Document, class: ClassId) -> Option<Lens<'_>> {
    let fields = document.layout(class).into_iter();
    let fields: Vec<(String, ClassId)> = fields
        .map(|f| (document.field_name(f).to_string(), document.field_class(f)))
        .filter(|(_, of)| !matches!(document.classes[*of].kind, ClassKind::Primitive(_)))
        .collect();
    let merges: Vec<&kernel::Merge> = document
        .primary_line(class)
        .into_iter()
        .flat_map(|c| document.classes[c].merges.iter())
        .collect();
    let looks = !merges.is_empty() && (2..=3).contains(&fields.len());
    looks.then_some(Lens { class, fields, merges })
}

/// Every way in which some of the things, in any order, could be the parts of a class that merges parts
/// of theirs which are one already.
fn views(open: &Open, lens: &Lens<'_>, things: &[ThingId]) -> Vec<View> {
    let (document, structure) = (&open.state.lowered.document, &open.state.structure);
    let Lens { class, fields, merges } = lens;
    let mut chosen: Vec<Vec<ThingId>> = vec![Vec::new()];
    for (_, wanted) in fields {
        let longer = |some: &Vec<ThingId>| {
            let fits = |t: &ThingId| {
                !some.contains(t) && document.is_a(structure.things[*t].class, *wanted)
            };
            let next = things.iter().copied().filter(fits);
            next.map(|t| some.iter().copied().chain([t]).collect()).collect::<Vec<_>>()
        };
        chosen = chosen.iter().flat_map(longer).collect();
    }
    let named = |parts: Vec<ThingId>| {
        fields.iter().map(|f| f.0.clone()).zip(parts).collect::<Vec<(String, ThingId)>>()
    };
    let is_one = |parts: &[(String, ThingId)], merge: &kernel::Merge| {
        let thing = |path: &Path| {
            let Some((Step::Part(first), rest)) = path.0.split_first() else { return None };
            let part = parts.iter().find(|p| *p.0 == **first)?.1;
            structure.follow(part, &Path(rest.to_vec())).ok()
        };
        let mut ends = merge.paths.iter().map(|path| thing(path).map(|t| structure.identity(t)));
        let first = ends.next().flatten();
        first.is_some() && ends.all(|end| end == first)
    };
    let found = chosen.into_iter().map(named);
    let found = found.filter(|parts| merges.iter().all(|merge| is_one(parts, merge)));
    found.map(|parts| View { class: *class, parts }).collect()
}
