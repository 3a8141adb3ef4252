//! The bin: the classes that things can be made of, each with the picture of its prototype.

use super::stages;
use crate::joining;
use crate::prototype::Lone;
use crate::recognise;
use crate::state::State;
use crate::texts::Texts;
use crate::view::BinEntry;
use drawing::Drawing;
use eval::Evaluator;
use kernel::{ClassId, SlotId, Value, Values};
use plan::{Model, Planner, Plans};

/// The class of an entry, and the toolbox that it lies in.
type Made<'s> = (ClassId, &'s kernel::Class, Option<usize>);

/// Returns the classes that a document can make things of, those of toolboxes first, then in order of declaration, its
/// own last.
fn made(state: &State) -> Vec<Made<'_>> {
    let document = &state.lowered.document;
    let classes = document.classes.iter();
    let made = classes.filter(|&(id, class)| recognise::is_candidate(state, id, class));
    // of classes of one name the last counts
    let made = made.filter(|&(id, class)| document.class_named(&class.name) == Some(id));
    let mut made: Vec<_> = made.collect();
    // first what lies in toolboxes, in their order
    let boxes = &state.lowered.toolboxes;
    let place = |id: ClassId| {
        let all =
            boxes.iter().enumerate().flat_map(|(b, t)| t.classes.iter().map(move |c| (b, *c)));
        all.enumerate().find(|(_, (_, class))| *class == id).map(|(order, (b, _))| (order, b))
    };
    made.sort_by_key(|&(id, _)| place(id).map_or(usize::MAX, |(order, _)| order));
    made.into_iter().map(|(id, class)| (id, class, place(id).map(|(_, b)| b))).collect()
}

/// Returns the names of the classes that a document can make things of, in the order of the bin.
pub(crate) fn names(state: &State) -> Vec<String> {
    made(state).into_iter().map(|(_, class, _)| class.name.to_string()).collect()
}

/// Returns what a document can make things of, in the order of the bin.
pub(crate) fn entries(state: &State) -> Vec<BinEntry> {
    let boxes = &state.lowered.toolboxes;
    let entry = |(id, class, toolbox): Made<'_>| {
        let file = state.lowered.place(class.origin).file;
        BinEntry {
            class: class.name.to_string(),
            doc: class.doc.clone(),
            library: state
                .lowered
                .files
                .get(file)
                .map(|file| file.name.clone())
                .unwrap_or_default(),
            toolbox: toolbox.map(|b| boxes[b].title.clone()),
            picture: solved(state, id),
        }
    };
    made(state).into_iter().map(entry).collect()
}

/// The picture of a class's prototype, from what is given alone.
pub(crate) fn picture(state: &State, class: ClassId) -> Drawing {
    let prototype = Lone::of(&state.lowered.document, class);
    prototype.map(|lone| drawn(&lone, &spread(&lone, class))).unwrap_or_default()
}

/// The same as its constraints want it, where it is small enough to be solved for a tile.
fn solved(state: &State, class: ClassId) -> Drawing {
    /// What has more numbers is shown as it is given.
    const MOST: usize = 40;
    let Some(lone) = Lone::of(&state.lowered.document, class) else { return Drawing::default() };
    let given = spread(&lone, class);
    let Lone { document, structure, .. } = &lone;
    let looks = drawn(&lone, &given);
    let evaluator = Evaluator::new(document, structure, &given);
    let mut rules = structure.constraints.iter();
    let holds = rules.all(|&rule| evaluator.test(rule).is_ok_and(|verdict| verdict.holds));
    if holds || looks.elements.is_empty() || structure.slots.len() > MOST {
        return looks;
    }
    let model = Model { document, structure };
    let (mut planner, _) = Planner::new(model, Plans::default());
    let mut values = given.clone();
    match planner.satisfy(model, &mut values, &mut Texts::new(document, structure)) {
        true => drawn(&lone, &values),
        false => looks,
    }
}

fn drawn(lone: &Lone, values: &Values) -> Drawing {
    Evaluator::new(&lone.document, &lone.structure, values).picture(lone.thing).drawing
}

/// What a prototype is given; where that leaves all that sticks in one spot, each has a spot of its own.
fn spread(lone: &Lone, class: ClassId) -> Values {
    let (mut values, _) = eval::given_values(&lone.document, &lone.structure);
    let places: Vec<[SlotId; 2]> = joining::attachers(&lone.document, class)
        .iter()
        .filter_map(|part| lone.structure.follow(lone.thing, part).ok())
        .filter_map(|part| stages::coordinates_in(&lone.structure, part))
        .collect();
    let at = |[x, y]: &[SlotId; 2]| (values.numbers[*x], values.numbers[*y]);
    if places.len() > 1 && places.iter().all(|place| at(place) == at(&places[0])) {
        for (n, [x, y]) in places.iter().enumerate() {
            let (to_x, to_y) = stages::spot(places.len(), n);
            values.put(*x, Value::Number(to_x));
            values.put(*y, Value::Number(to_y));
        }
    }
    values
}
