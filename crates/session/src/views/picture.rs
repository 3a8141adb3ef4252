//! The picture: elements with the things that they picture, and what can be gripped.

use crate::session::{parse_path, thing_at};
use crate::state::State;
use crate::view::{Grip, MovedView, PictureView, SheetUnit};
use crate::views::drawn;
use crate::words;
use base::IdVec;
use kernel::{ClassKind, DOCUMENT, Document, SlotId, ThingId, Values};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// The picture of a state, kept while values change: by a drag, by an edit of values, by undoing that.
pub(crate) struct Shown {
    state: Rc<State>,
    values: Values,
    /// What could move when it was made.
    slots: IdVec<SlotId, plan::SlotState>,
    scene: eval::Scene,
    /// For each grip that is shown, its place among those of the scene.
    grips: Vec<u32>,
    /// The grips of what programs draw; they stand after those.
    drawn: Vec<Grip>,
    /// How often it was made, the first time included.
    made: u32,
    /// How often it was brought up to date, and for each element and grip of the scene at which of these times last.
    times: u32,
    renewed: [Vec<u32>; 2],
    /// What has moved since a drag was pressed, and what is counted with it because it may move as well.
    apart: eval::Moved,
    /// The slots that the drag may change that goes on.
    reach: Vec<SlotId>,
}

impl Shown {
    /// Draws a state.
    pub(crate) fn of(state: &Rc<State>, values: &Values, status: &plan::Status) -> Self {
        let evaluator = state.evaluator(values);
        let scene = evaluator.scene(DOCUMENT);
        let structure = &state.structure;
        // what a view of the structure does not show, cannot be gripped
        let unseen = |part: &ThingId| {
            crate::general::named(state, *part, "structure").is_some_and(|shown| shown.is_empty())
        };
        let unseen: Vec<ThingId> = structure.parts(DOCUMENT).filter(unseen).collect();
        let is_seen = |grip: &eval::Grip| {
            let mut owners =
                std::iter::successors(Some(grip.thing), |&t| structure.things[t].owner);
            unseen.is_empty() || !owners.any(|t| unseen.contains(&t))
        };
        let grips = (0..).zip(&scene.picture.grips).filter(|(_, grip)| is_seen(grip));
        let grips = grips.map(|(at, _)| at).collect();
        let drawn = drawn::grips(state, &evaluator);
        let renewed = [scene.picture.drawing.elements.len(), scene.picture.grips.len()];
        Self {
            state: state.clone(),
            values: values.clone(),
            slots: status.slots.clone(),
            scene,
            grips,
            drawn,
            made: 1,
            times: 0,
            renewed: renewed.map(|n| vec![0; n]),
            apart: eval::Moved::default(),
            reach: Vec::new(),
        }
    }

    /// Brings it up to date. Cost: that of drawing what reads a changed slot, where no more than values are others.
    pub(crate) fn renew(&mut self, state: &Rc<State>, values: &Values, status: &plan::Status) {
        if !self.state.has_form_of(state) || self.slots != status.slots {
            self.make_anew(state, values, status);
            return;
        }
        if !Rc::ptr_eq(&self.state, state) {
            self.state = state.clone();
        }
        let changed: Vec<SlotId> = self.values.changed(values).collect();
        if changed.is_empty() {
            return;
        }
        // a program that has been run for the scene is not run again for its grips
        let evaluator = state.evaluator(values);
        let Some(moved) = evaluator.renew(&mut self.scene, &changed) else {
            let reach = std::mem::take(&mut self.reach);
            self.make_anew(state, values, status);
            self.reach = reach;
            return;
        };
        self.times += 1;
        for (renewed, moved) in self.renewed.iter_mut().zip([&moved.elements, &moved.grips]) {
            moved.iter().for_each(|&at| renewed[at as usize] = self.times);
        }
        self.set_apart(moved);
        self.values.clone_from(values);
        let drawn = drawn::grips(state, &evaluator);
        if drawn.iter().map(|g| &g.path).ne(self.drawn.iter().map(|g| &g.path)) {
            self.made += 1;
        }
        self.drawn = drawn;
    }

    fn make_anew(&mut self, state: &Rc<State>, values: &Values, status: &plan::Status) {
        let made = self.made + 1;
        *self = Self { made, ..Self::of(state, values, status) };
    }

    /// Counts as apart what has moved now for the first time. Whoever paints what rests has to paint it anew then; so
    /// that this is seldom, all that may move is apart from the second time on, unless it is far more than what does.
    fn set_apart(&mut self, moved: eval::Moved) {
        /// So many times as much as has moved is not far more.
        const TIMES: usize = 4;
        if moved.is_within(&self.apart) {
            return;
        }
        let is_first = self.apart.is_empty();
        self.apart.extend(moved);
        if !is_first {
            let may_move = self.scene.drawn_from(&self.reach);
            if may_move.len() <= TIMES * self.apart.len() {
                self.apart.extend(may_move);
            }
        }
    }

    /// Forgets what has moved so far; a drag begins that may change some slots.
    pub(crate) fn rest(&mut self, reach: Vec<SlotId>) {
        self.apart = eval::Moved::default();
        self.reach = reach;
    }

    /// Returns the whole picture.
    pub(crate) fn view(&self, status: &plan::Status) -> PictureView {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let made = &self.scene.picture;
        let path = |thing: ThingId| structure.path(document, thing).to_string();
        let grip = |&at: &u32| {
            let grip = &made.grips[at as usize];
            let slots = structure.slots_under(grip.thing);
            Grip {
                path: path(grip.thing),
                x: grip.at.x,
                y: grip.at.y,
                anchored: slots.iter().all(|&s| structure.slots[s].anchored),
                drawn: false,
                freedom: words::freedom_of(structure, status, grip.thing),
            }
        };
        let mut view = PictureView {
            drawing: made.drawing.clone(),
            paths: made.things.iter().map(|&t| path(t)).collect(),
            drawn_by: vec![None; made.things.len()],
            freedom: made.things.iter().map(|&t| words::freedom_of(structure, status, t)).collect(),
            grips: self.grips.iter().map(grip).chain(self.drawn.iter().cloned()).collect(),
            unit: document
                .unit
                .as_ref()
                .map(|name| SheetUnit { name: name.to_string(), across: across(document) }),
            millimetres: millimetres(document),
            made: self.made,
            times: self.times,
        };
        self.tag_entities(&mut view);
        self.tag_figures(&mut view);
        self.tag_computed(&mut view);
        view
    }

    /// Gives what the document computes tags of their own, so that each is picked by its name.
    fn tag_computed(&self, view: &mut PictureView) {
        for (name, elements) in self.scene.computed() {
            let Some(&first) = elements.first() else { continue };
            let freedom = view.freedom[view.drawing.elements[first as usize].tag.0 as usize];
            let tag = drawing::Tag(view.paths.len() as u32);
            elements.iter().for_each(|&at| view.drawing.elements[at as usize].tag = tag);
            view.paths.push(name.to_string());
            view.drawn_by.push(None);
            view.freedom.push(freedom);
        }
    }

    /// Gives what programs drew tags of their own, entity by entity: they are drawn in the order of the run.
    fn tag_entities(&self, view: &mut PictureView) {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let evaluator = self.state.evaluator(&self.values);
        for (tag, &thing) in self.scene.picture.things.iter().enumerate() {
            if document.program(structure.things[thing].class).is_none() {
                continue;
            }
            let is_own = |(_, element): &(usize, &drawing::Element)| element.tag.0 == tag as u32;
            let all = view.drawing.elements.iter().enumerate().filter(is_own).map(|(at, _)| at);
            let mut own = all.collect::<Vec<_>>().into_iter().peekable();
            for (path, answer) in drawn::entities(&self.state, &evaluator, thing) {
                let entity = drawing::Tag(view.paths.len() as u32);
                let mut is_seen = false;
                for drawn in evaluator.elements(&answer) {
                    // what is drawn twice stands in the picture once
                    let elements = &mut view.drawing.elements;
                    if let Some(at) = own.next_if(|&at| elements[at].shape == drawn.shape) {
                        elements[at].tag = entity;
                        is_seen = true;
                    }
                }
                if is_seen {
                    view.paths.push(path);
                    view.drawn_by.push(Some(view.paths[tag].clone()));
                    view.freedom.push(view.freedom[tag]);
                }
            }
        }
    }

    /// Gives the figures that a thing's class declares, and its picture shows, tags of their own: each side of a rectangle.
    fn tag_figures(&self, view: &mut PictureView) {
        let evaluator = self.state.evaluator(&self.values);
        let declaring: BTreeSet<ThingId> = drawn::declaring(&self.state).into_iter().collect();
        let things = self.scene.picture.things.iter().enumerate();
        let things = things.filter(|(_, thing)| declaring.contains(thing));
        let tags: BTreeMap<u32, ThingId> =
            things.map(|(tag, &thing)| (tag as u32, thing)).collect();
        let mut own: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
        for (at, element) in view.drawing.elements.iter().enumerate() {
            if tags.contains_key(&element.tag.0) {
                own.entry(element.tag.0).or_default().push(at);
            }
        }
        for (tag, mut own) in own {
            for (path, figure) in drawn::figures(&self.state, &evaluator, tags[&tag]) {
                let entity = drawing::Tag(view.paths.len() as u32);
                let shown = evaluator.elements(&figure);
                let elements = &mut view.drawing.elements;
                let is_shown = |at: &usize| shown.iter().any(|e| e.shape == elements[*at].shape);
                let (seen, rest): (Vec<usize>, Vec<usize>) =
                    own.iter().partition(|at| is_shown(at));
                if seen.is_empty() {
                    continue;
                }
                seen.iter().for_each(|&at| elements[at].tag = entity);
                own = rest;
                view.paths.push(path);
                view.drawn_by.push(Some(view.paths[tag as usize].clone()));
                view.freedom.push(view.freedom[tag as usize]);
            }
        }
    }

    /// Brings a view up to date that was made of the same document; returns what moves.
    pub(crate) fn follow(&self, view: &mut PictureView, status: &plan::Status) -> MovedView {
        if view.made != self.made || view.grips.len() != self.grips.len() + self.drawn.len() {
            *view = self.view(status);
            return MovedView::Everything;
        }
        let made = &self.scene.picture;
        let [elements, grips] = &self.renewed;
        let as_of = view.times;
        let since = |renewed: &u32| *renewed > as_of;
        for (at, _) in elements.iter().enumerate().filter(|(_, renewed)| since(renewed)) {
            let now = &made.drawing.elements[at];
            view.drawing.elements[at].shape.clone_from(&now.shape);
        }
        for (shown, &at) in self.grips.iter().enumerate() {
            if since(&grips[at as usize]) {
                let now = made.grips[at as usize].at;
                (view.grips[shown].x, view.grips[shown].y) = (now.x, now.y);
            }
        }
        view.times = self.times;
        view.grips.truncate(self.grips.len());
        view.grips.extend(self.drawn.iter().cloned());
        let shown = |at: &u32| self.grips.binary_search(at).ok();
        let grips = self.apart.grips.iter().filter_map(shown);
        let drawn = self.grips.len()..view.grips.len();
        MovedView::These {
            elements: self.apart.elements.iter().copied().collect(),
            grips: grips.chain(drawn).map(|at| at as u32).collect(),
        }
    }
}

/// Returns the block of each tag for an exchange format: the thing whose program drew it. Sides of a rectangle are none.
fn blocks<'p>(
    state: &'p State,
    picture: &'p PictureView,
) -> impl Fn(drawing::Tag) -> Option<String> + 'p {
    let is_program = |whole: &String| {
        let thing = parse_path(whole).and_then(|path| thing_at(state, &path));
        let class = thing.map(|thing| state.structure.things[thing].class);
        class.is_some_and(|class| state.lowered.document.program(class).is_some())
    };
    move |tag| picture.drawn_by.get(tag.0 as usize).cloned().flatten().filter(is_program)
}

/// Returns the picture for some values of a state.
pub(crate) fn picture(state: &Rc<State>, values: &Values, status: &plan::Status) -> PictureView {
    Shown::of(state, values, status).view(status)
}

/// Says why some things have no picture, each reason once.
pub(crate) fn undrawn(state: &State, values: &Values) -> Vec<String> {
    let mut said: Vec<String> = Vec::new();
    for fault in state.evaluator(values).picture(DOCUMENT).faults {
        if !said.contains(&fault.message) {
            said.push(fault.message);
        }
    }
    said
}

/// Returns the elements of a picture that look otherwise with these values than with those of the state.
pub(crate) fn changed(state: &State, values: &Values) -> drawing::Drawing {
    let drawn = |values: &Values| state.evaluator(values).picture(DOCUMENT).drawing;
    let now = drawn(&state.values);
    let mut made = drawn(values);
    made.elements.retain(|element| !now.elements.contains(element));
    made
}

/// A picture whose longer side is not within these many pixels at a pixel for a unit of the sheet is scaled.
const READABLE: std::ops::RangeInclusive<f64> = 200.0..=1600.0;
/// So many pixels long is then its longer side.
const FITTED: f64 = 800.0;
/// So many where it is small, and needs no room for dimensions: words that are as large in any picture are not lost.
const ENLARGED: f64 = 400.0;

/// Returns a picture as SVG of a readable size, each element with the path of its thing.
pub(crate) fn svg(picture: &PictureView) -> String {
    svg_at(picture, readable(picture))
}

/// Returns how many pixels a unit of a picture has where it is of a readable size.
pub fn readable(picture: &PictureView) -> f64 {
    let longest = longest(picture);
    let is_readable = READABLE.contains(&longest) || longest <= 0.0 || !longest.is_finite();
    match is_readable {
        true => 1.0,
        false if longest < *READABLE.start() => ENLARGED / longest,
        false => FITTED / longest,
    }
}

/// Returns the same where words that are as large in any picture need room: then none is small.
pub fn roomy(picture: &PictureView) -> f64 {
    let fitted = FITTED / longest(picture);
    if fitted.is_finite() { readable(picture).max(fitted) } else { readable(picture) }
}

/// How long the longer side of a picture is, in units of the sheet.
fn longest(picture: &PictureView) -> f64 {
    drawing::bounds(&picture.drawing).map_or(0.0, |b| b.width().max(b.height()))
}

/// Returns a picture as SVG, with so many pixels for a unit of the drawing.
pub fn svg_at(picture: &PictureView, pixels_per_unit: f64) -> String {
    let path = |tag: drawing::Tag| picture.paths.get(tag.0 as usize).cloned();
    let options =
        drawing::svg::SvgOptions { pixels_per_unit, margin: 16.0, title: None, path: &path };
    drawing::svg::write(&picture.drawing, &options)
}

/// Returns a picture of a document as DXF, in millimetres.
pub(crate) fn dxf(state: &State, picture: &PictureView) -> String {
    let options =
        drawing::dxf::DxfOptions::of(&picture.drawing, state.lowered.millimetres_per_unit());
    drawing::dxf::write_in_blocks(&picture.drawing, &options, &blocks(state, picture))
}

/// Returns the paths of the document's parts that nothing in its picture stands for: those of classes without a
/// picture. A number, a text or a list of them has none and needs none, nor has a library.
pub(crate) fn unpictured(state: &State, picture: &PictureView) -> Vec<String> {
    let (document, structure) = (&state.lowered.document, &state.structure);
    let is_thing = |part: &ThingId| {
        let mut class = structure.things[*part].class;
        while let ClassKind::List(element) = document.classes[class].kind {
            class = element;
        }
        document.classes[class].kind == ClassKind::Composite
    };
    let own = |part: ThingId| structure.path(document, part).to_string();
    let is_pictured = |path: &str| {
        let below = |of: &String| {
            of.strip_prefix(path)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        picture.paths.iter().any(below)
    };
    let parts = structure.parts(DOCUMENT).filter(|&part| structure.merged[part] == part);
    let is_bare = |path: &String| !is_pictured(path) && !super::values::is_of_library(state, path);
    parts.filter(is_thing).map(own).filter(is_bare).collect()
}

/// Returns how many millimetres a unit of a document's drawing is; none where its lengths are units of the sheet alone.
fn millimetres(document: &Document) -> Option<f64> {
    let stored = document.scale.factor(expr::Dimension::LENGTH);
    let is_known = document.unit.is_some() || document.writes_lengths;
    is_known.then(|| 1000.0 / document.units_per_metre / stored)
}

/// Returns how wide a piece of a sheet is looked at while nothing is drawn: some 20 centimetres, as of a sheet of paper,
/// and of a sheet that counts in more or in less than that a good number of its units.
pub(crate) fn across(document: &Document) -> f64 {
    let counted = 0.2 * document.units_per_metre;
    if document.unit.is_some() { counted.clamp(20.0, 200.0) } else { 200.0 }
}
