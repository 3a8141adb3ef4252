//! What of a thing is set by hand, one after the other.

use super::at_place;
use crate::apply;
use crate::document::Open;
use crate::drag;
use crate::host::Host;
use crate::joining;
use crate::offers::words_of;
use crate::session::thing_at;
use crate::state::State;
use base::Name;
use kernel::{Command, Path, SlotId, Step, Structure, ThingId};

/// What is set next; paths begin at the thing.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Stage {
    /// A part that sticks to others, by the place that it is drawn at.
    Place {
        /// What sticks.
        part: Path,
        /// Where it is.
        place: Path,
    },
    /// A number: how far the pointer is from the place that was set last.
    Reach {
        /// The number.
        number: Path,
    },
    /// A place that is computed, opposite of the one that was set last.
    Far {
        /// The place.
        far: Path,
    },
}

impl Stage {
    /// What it sets.
    pub(crate) fn part(&self) -> &Path {
        match self {
            Self::Place { part, .. } => part,
            Self::Reach { number } => number,
            Self::Far { far } => far,
        }
    }

    /// The part that it sets, where that is more than a place.
    pub(crate) fn whole(&self) -> Option<&Path> {
        match self {
            Self::Place { part, place } => Some(part).filter(|part| *part != place),
            Self::Reach { .. } | Self::Far { .. } => None,
        }
    }

    /// The name of the class of what it sets, where that can stick to something.
    pub(crate) fn class(&self, trial: &State, name: &str) -> Option<Name> {
        let Self::Place { part, .. } = self else { return None };
        let path = Path(vec![Step::Part(Name::new(name))]).join(part);
        let class = trial.structure.things[thing_at(trial, &path)?].class;
        let document = &trial.lowered.document;
        Some(document.classes[document.named_class(class)].name.clone())
    }

    /// What the mouse does, in one sentence: for the first place of a thing, and for others of one that a next goes on
    /// from, or not.
    /// `kind` is the class of what it sets.
    pub(crate) fn hint(
        &self,
        class: &str,
        kind: Option<&Name>,
        (is_first, goes_on): (bool, bool),
    ) -> String {
        let what = match self {
            Self::Far { .. } => String::from("the opposite corner"),
            Self::Place { part, .. } => in_words(part, kind),
            Self::Reach { number } => in_words(number, kind),
        };
        let (way, leave) = match (is_first, goes_on) {
            (true, _) => ("click or press", "done"),
            (false, true) => ("click", "end here, again: done"),
            (false, false) => ("click", "give up"),
        };
        format!("{class}: {way} to set {what}; Shift: no joints and guides; Esc: {leave}")
    }
}

/// What people are told of a part of a thing: `its second point` of `p2`, `its center` of `center`.
fn in_words(part: &Path, kind: Option<&Name>) -> String {
    const ORDINALS: [&str; 4] = ["first", "second", "third", "fourth"];
    let Some((Step::Part(name), whole)) = part.0.split_last() else { return "it".into() };
    let of = match whole {
        [] => String::new(),
        whole => format!(" of {}", Path(whole.to_vec())),
    };
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let number = name[stem.len()..].parse::<usize>().ok();
    let ordinal = number.and_then(|n| ORDINALS.get(n.checked_sub(1)?));
    // a letter says nothing
    let noun = match kind {
        Some(kind) if stem.chars().count() == 1 => words_of(kind),
        _ => stem.to_string(),
    };
    match ordinal {
        Some(ordinal) => format!("its {ordinal} {noun}{of}"),
        None if noun != stem => format!("its {noun} {name}{of}"),
        None => format!("its {name}{of}"),
    }
}

/// Returns what is set of a thing of a class: what its class says that sticks; of what is drawn by places alone
/// every place; of a circle its radius, of a box its far corner.
pub(crate) fn stages(trial: &State, name: &str) -> Vec<Stage> {
    let whole = Path(vec![Step::Part(Name::new(name))]);
    let Some(thing) = thing_at(trial, &whole) else { return Vec::new() };
    let (document, structure) = (&trial.lowered.document, &trial.structure);
    let class = structure.things[thing].class;
    let place = |part: &Path| {
        let inner = structure.follow(thing, part).ok().and_then(|t| place_in(trial, t))?;
        let path = structure.path(document, inner);
        Some(Path(path.0.get(1..)?.to_vec()))
    };
    if document.is_place(class) {
        return vec![Stage::Place { part: Path::default(), place: Path::default() }];
    }
    if document.program(class).is_some() {
        // in the frame of what a program draws nothing is set by hand: it is placed as a whole
        let place = Path(vec![Step::Part(Name::new("at"))]);
        return vec![Stage::Place { part: place.clone(), place }];
    }
    let attachers = joining::attachers(document, class);
    let by_places = attachers.iter().all(|part| place(part).as_ref() == Some(part));
    let own: Vec<Path> = structure
        .parts(thing)
        .filter(|&part| document.is_place(structure.things[part].class))
        .filter_map(|part| Some(Path(structure.path(document, part).0.get(1..)?.to_vec())))
        .collect();
    let parts = if by_places && own.len() >= attachers.len() { own } else { attachers.to_vec() };
    let mut stages: Vec<Stage> = parts
        .into_iter()
        .filter_map(|part| Some(Stage::Place { place: place(&part)?, part }))
        .collect();
    if stages.is_empty() {
        // it is placed as a whole, held by its first place
        let first = place_in(trial, thing).map(|t| structure.path(document, t));
        let first = first.and_then(|path| Some(Path(path.0.get(1..)?.to_vec())));
        stages.extend(first.map(|place| Stage::Place { part: place.clone(), place }));
    }
    let named = |name: &str| Path(vec![Step::Part(Name::new(name))]);
    if stages.len() == 1 && by_places {
        let has = |name: &str| structure.part_named(thing, name).is_some();
        let far = document.find_message(class, &Name::new("far"), None);
        if has("radius") {
            stages.push(Stage::Reach { number: named("radius") });
        } else if far.is_some() && has("width") && has("height") {
            stages.push(Stage::Far { far: named("far") });
        }
    }
    stages
}

/// Where a place of a thing goes whose class leaves all of so many in one spot.
pub(crate) fn spot(places: usize, n: usize) -> (f64, f64) {
    let spots: &[(f64, f64)] = match places {
        2 => &[(0.0, 0.0), (100.0, 0.0)],
        3 => &[(0.0, 40.0), (0.0, -40.0), (90.0, 0.0)],
        _ => &[],
    };
    spots.get(n).copied().unwrap_or((60.0 * n as f64, 0.0))
}

/// Returns where the coordinates are of the first place in a thing.
pub(crate) fn coordinates_in(structure: &Structure, thing: ThingId) -> Option<[SlotId; 2]> {
    let mut waiting = vec![thing];
    while let Some(thing) = waiting.pop() {
        if let Some([(_, x), (_, y)]) = drag::coordinates(structure, thing) {
            return Some([x, y]);
        }
        waiting.extend(structure.parts(thing).rev());
    }
    None
}

/// Returns the first place in a thing: itself, or one of its parts at any depth.
fn place_in(state: &State, thing: ThingId) -> Option<ThingId> {
    let mut waiting = vec![thing];
    while let Some(thing) = waiting.pop() {
        if drag::coordinates(&state.structure, thing).is_some() {
            return Some(thing);
        }
        waiting.extend(state.structure.parts(thing).rev());
    }
    None
}

/// Spreads the places of a new thing that its class leaves in one spot.
pub(crate) fn spread(trial: &mut Open, stages: &[Stage], host: &dyn Host) {
    let state = trial.state.clone();
    let Some(name) = { state.structure.parts(kernel::DOCUMENT) }.next() else { return };
    let whole = state.structure.path(&state.lowered.document, name);
    let places: Vec<&Path> = stages
        .iter()
        .filter_map(|stage| match stage {
            Stage::Place { place, .. } => Some(place),
            Stage::Reach { .. } | Stage::Far { .. } => None,
        })
        .collect();
    let at = |place: &Path| {
        let thing = thing_at(&state, &whole.join(place))?;
        let [(_, x), (_, y)] = drag::coordinates(&state.structure, thing)?;
        Some((state.values.numbers[x], state.values.numbers[y]))
    };
    let first = places.first().and_then(|p| at(p));
    if places.len() < 2 || places.iter().any(|p| at(p) != first) {
        return;
    }
    let targets = places.iter().enumerate();
    let spot = |n: usize| spot(places.len(), n);
    let targets = targets.map(|(n, place)| at_place(whole.join(place), spot(n))).collect();
    // where constraints want them in one spot they stay there
    let _ = apply::apply(trial, host, &Command::Move(targets));
}
