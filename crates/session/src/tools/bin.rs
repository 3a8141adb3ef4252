//! The bin: the classes that things can be made of, each with the picture of its prototype.

use super::{examples, stages, trial_text};
use crate::document::Open;
use crate::host::Host;
use crate::joining;
use crate::prototype::Lone;
use crate::recognise;
use crate::session::thing_at;
use crate::state::State;
use crate::texts::Texts;
use crate::view::BinEntry;
use base::Name;
use drawing::{Drawing, Element, Shape};
use eval::Evaluator;
use expr::Dimension;
use kernel::{ClassId, Path, Primitive, Scale, SlotId, Step, Usual, Value, Values, Vertical};
use plan::{Model, Planner, Plans};
use std::collections::BTreeMap;
use std::rc::Rc;

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

/// How the classes of libraries look, by file and name: that is the same until one of the files is another, or what
/// the document says of lengths and its sheet.
#[derive(Default)]
pub(crate) struct Tiles {
    of: Option<Said>,
    pictures: BTreeMap<(String, String), Drawing>,
}

/// What tiles of libraries depend on.
#[derive(PartialEq)]
struct Said {
    sheet: (Vertical, f64, Option<Name>, Scale),
    units: (bool, BTreeMap<(Dimension, Option<Name>), Usual>),
    libraries: Vec<(String, Rc<str>)>,
}

impl Said {
    fn of(state: &State) -> Self {
        let document = &state.lowered.document;
        let files = state.lowered.files.iter().map(|(_, file)| file);
        let libraries = files.filter(|file| !file.name.is_empty());
        let unit = document.unit.clone();
        Self {
            sheet: (document.vertical, document.units_per_metre, unit, document.scale),
            units: (document.writes_lengths, document.usual.clone()),
            libraries: libraries.map(|file| (file.name.clone(), file.text.clone())).collect(),
        }
    }
}

impl Tiles {
    /// The picture of a class of a library; of the document's own, which is edited, anew each time.
    fn picture(
        &mut self,
        state: &State,
        class: ClassId,
        library: &str,
        host: &dyn Host,
    ) -> Drawing {
        let look = || exemplified(state, class, host).unwrap_or_else(|| solved(state, class));
        if library.is_empty() {
            return look();
        }
        let name = state.lowered.document.classes[class].name.to_string();
        let known = self.pictures.entry((library.into(), name));
        known.or_insert_with(look).clone()
    }
}

/// Returns what a document can make things of, in the order of the bin.
pub(crate) fn entries(state: &State, tiles: &mut Tiles, host: &dyn Host) -> Vec<BinEntry> {
    let said = Some(Said::of(state));
    if tiles.of != said {
        *tiles = Tiles { of: said, ..Tiles::default() };
    }
    let boxes = &state.lowered.toolboxes;
    let entry = |(id, class, toolbox): Made<'_>| {
        let file = state.lowered.files.get(state.lowered.place(class.origin).file);
        let library = file.map(|file| file.name.clone()).unwrap_or_default();
        BinEntry {
            class: class.name.to_string(),
            doc: class.doc.clone(),
            picture: tiles.picture(state, id, &library, host),
            library,
            toolbox: toolbox.map(|b| boxes[b].title.clone()),
        }
    };
    made(state).into_iter().map(entry).collect()
}

/// The picture of a class's prototype, from what is given alone.
pub(crate) fn picture(state: &State, class: ClassId) -> Drawing {
    let prototype = Lone::of(&state.lowered.document, class);
    prototype.map(|lone| drawn(&lone, &spread(&lone, class))).unwrap_or_default()
}

/// The picture of a thing of a class whose lists have examples; nothing for a class that needs none.
fn exemplified(state: &State, class: ClassId, host: &dyn Host) -> Option<Drawing> {
    const NAME: &str = "lone";
    let document = &state.lowered.document;
    let lists = examples::lists(document, class);
    if lists.is_empty() {
        return None;
    }
    let class = &document.classes[class].name;
    let alone = format!("{NAME}: {class} {{\n    {}\n}}", lists.join("\n    "));
    let trial = Open::of("", trial_text(&state.text, &alone), host);
    let thing = thing_at(&trial.state, &Path(vec![Step::Part(Name::new(NAME))]))?;
    Some(trial.state.evaluator(trial.values()).picture(thing).drawing)
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

/// What a prototype is given; where that leaves all that sticks in one spot, each has a spot of its own: side by side, or,
/// where nothing is drawn of it then, above each other.
fn spread(lone: &Lone, class: ClassId) -> Values {
    let (mut values, _) = eval::given_values(&lone.document, &lone.structure);
    let places: Vec<[SlotId; 2]> = joining::attachers(&lone.document, class)
        .iter()
        .filter_map(|part| lone.structure.follow(lone.thing, part).ok())
        .filter_map(|part| stages::coordinates_in(&lone.structure, part))
        .collect();
    let at = |[x, y]: &[SlotId; 2]| (values.numbers[*x], values.numbers[*y]);
    if places.len() > 1 && places.iter().all(|place| at(place) == at(&places[0])) {
        let mut put = |turned: [usize; 2]| {
            for (n, place) in places.iter().enumerate() {
                let (x, y) = stages::spot(places.len(), n);
                values.put(place[turned[0]], Value::Number(x));
                values.put(place[turned[1]], Value::Number(y));
            }
            drawn(lone, &values).elements.is_empty()
        };
        if put([0, 1]) && put([1, 0]) {
            put([0, 1]);
        }
    }
    if is_blank(&drawn(lone, &values)) { telling(lone, values) } else { values }
}

/// Whether there is nothing to see of a drawing: it has no elements, or texts without words alone.
fn is_blank(drawing: &Drawing) -> bool {
    let is_silent =
        |element: &Element| matches!(&element.shape, Shape::Text { text, .. } if text.is_empty());
    drawing.elements.iter().all(is_silent)
}

/// The same where nothing is drawn of it, as its places lie on each other and its texts are empty: it says something, and
/// its places lie above each other in pairs, or fan out in pairs from one spot, whichever shows anything.
fn telling(lone: &Lone, given: Values) -> Values {
    /// What stands where a text is.
    const WORDS: &str = "Abc";
    let mut values = given.clone();
    let mut places: Vec<[SlotId; 2]> = Vec::new();
    for (id, slot) in lone.structure.slots.iter() {
        if slot.primitive == Primitive::Text && slot.given.is_none() {
            values.put(id, Value::Text(WORDS.into()));
        }
        let own = slot.place.map(|place| lone.structure.slots_under(place)).unwrap_or_default();
        if let Ok(own) = <[SlotId; 2]>::try_from(own)
            && own[0] == id
        {
            places.push(own);
        }
    }
    let shows = |values: &Values| !is_blank(&drawn(lone, values));
    if shows(&values) {
        return values;
    }
    let above = |n: usize| (60.0 * (n % 2) as f64, -20.0 * (n / 2) as f64);
    let fanned = |n: usize| match n {
        1 => (60.0, 0.0),
        n if n % 2 == 1 => (40.0, 20.0 * n as f64),
        _ => (0.0, 0.0),
    };
    let ways: [&dyn Fn(usize) -> (f64, f64); 2] = [&above, &fanned];
    for way in ways {
        for (n, [x, y]) in places.iter().enumerate() {
            let (at_x, at_y) = way(n);
            values.put(*x, Value::Number(at_x));
            values.put(*y, Value::Number(at_y));
        }
        if shows(&values) {
            return values;
        }
    }
    given
}
