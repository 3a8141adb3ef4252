//! Scenes: a picture kept by what draws it, so that what did not move is not drawn again.
//!
//! In: a thing in one state. Out: its [`Picture`], each element with the *source* that drew it, the nearest thing whose
//! class says how it is drawn, and each source with the slots that it read. In another state of the same things the
//! sources that read a slot with another value draw anew, and nothing else does.

use crate::answer::Answer;
use crate::evaluator::Evaluator;
use crate::fault::Fault;
use crate::picture::Picture;
use crate::replay::Asked;
use base::{IdVec, Name};
use drawing::{Color, Drawing, Element, Point, Shape, Tag, Vertical};
use kernel::{ClassKind, DOCUMENT, Message, SlotId, Term, ThingId};
use std::collections::{BTreeMap, BTreeSet};

/// A picture, and what each part of it follows from.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// The picture as of the latest state.
    pub picture: Picture,
    sources: Vec<Source>,
    /// For each element of the picture, how many times it is drawn, alike.
    times: Vec<u32>,
    /// For every slot, the sources that read it.
    readers: IdVec<SlotId, Vec<u32>>,
    /// For every slot, the grips of which it is a coordinate.
    coordinates: IdVec<SlotId, Vec<u32>>,
    grip_slots: Vec<[SlotId; 2]>,
}

/// What draws: a thing, or what it computes by a name.
#[derive(Clone, Debug)]
struct Source {
    thing: ThingId,
    computed: Option<Name>,
    /// For each element that it draws, where that stands in the picture.
    at: Vec<u32>,
    /// How many faults it has.
    faults: usize,
}

/// What is elsewhere, or looks otherwise, in a state than in the one before.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Moved {
    /// Places in the list of elements.
    pub elements: BTreeSet<u32>,
    /// Places in the list of grips.
    pub grips: BTreeSet<u32>,
}

/// What one source draws in one state.
struct Drawn {
    elements: Vec<Element>,
    faults: Vec<Fault>,
    reads: BTreeSet<SlotId>,
}

impl Scene {
    /// What is drawn of what a document computes: each by its name, with the places of its elements.
    pub fn computed(&self) -> impl Iterator<Item = (&Name, &[u32])> {
        let all = self.sources.iter();
        all.filter_map(|source| Some((source.computed.as_ref()?, source.at.as_slice())))
    }

    /// Returns what was drawn from these slots: what moves where they change, unless a picture turns to others.
    pub fn drawn_from(&self, slots: &[SlotId]) -> Moved {
        let read = slots.iter().flat_map(|&slot| &self.readers[slot]);
        let elements = read.flat_map(|&source| &self.sources[source as usize].at).copied();
        let grips = slots.iter().flat_map(|&slot| &self.coordinates[slot]).copied();
        Moved { elements: elements.collect(), grips: grips.collect() }
    }
}

impl Moved {
    /// Whether nothing else has moved than in another.
    pub fn is_within(&self, other: &Moved) -> bool {
        self.elements.is_subset(&other.elements) && self.grips.is_subset(&other.grips)
    }
    /// Adds another's.
    pub fn extend(&mut self, other: Moved) {
        if !other.is_within(self) {
            self.elements.extend(other.elements);
            self.grips.extend(other.grips);
        }
    }
    /// How many there are.
    pub fn len(&self) -> usize {
        self.elements.len() + self.grips.len()
    }
    /// Whether nothing has moved.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Evaluator<'_> {
    /// Draws a thing by its message `picture`, and keeps what each element follows from.
    ///
    /// Cost: that of evaluating every picture below the thing once.
    pub fn scene(&self, thing: ThingId) -> Scene {
        self.begin();
        let mut things = Vec::new();
        self.sources(thing, &mut things);
        let computed = self.computed_figures(thing).into_iter().map(|name| (thing, Some(name)));
        let sources = things.into_iter().map(|thing| (thing, None)).chain(computed);
        let slots = self.structure.slots.len();
        let mut scene = Scene {
            readers: IdVec::filled(Vec::new(), slots),
            coordinates: IdVec::filled(Vec::new(), slots),
            ..Scene::default()
        };
        let mut elements = Distinct::default();
        for (thing, computed) in sources {
            let drawn = self.drawn(thing, computed.as_ref());
            let number = scene.sources.len() as u32;
            for slot in drawn.reads {
                scene.readers[slot].push(number);
            }
            let at: Vec<u32> =
                drawn.elements.into_iter().map(|element| elements.place(element)).collect();
            scene.times.resize(elements.kept.len(), 0);
            for &at in &at {
                scene.times[at as usize] += 1;
            }
            scene.sources.push(Source { thing, computed, at, faults: drawn.faults.len() });
            scene.picture.faults.extend(drawn.faults);
        }
        let vertical = match self.document.vertical {
            kernel::Vertical::Up => Vertical::Up,
            kernel::Vertical::Down => Vertical::Down,
        };
        let mut elements = elements.kept;
        scene.picture.things = retag(&mut elements, self.structure.things.len());
        scene.picture.drawing = Drawing { elements, vertical };
        for (at, (grip, slots)) in (0..).zip(self.grips(thing)) {
            scene.picture.grips.push(grip);
            scene.grip_slots.push(slots);
            for slot in slots {
                scene.coordinates[slot].push(at);
            }
        }
        scene
    }

    /// Brings a scene up to date with the state of this evaluator, which differs from its latest at these slots.
    /// Returns what moved; nothing where other elements are drawn than before, and the scene has to be made anew.
    ///
    /// Cost: that of the sources that read one of the slots.
    pub fn renew(&self, scene: &mut Scene, changed: &[SlotId]) -> Option<Moved> {
        let mut moved = Moved::default();
        let stale: BTreeSet<u32> =
            changed.iter().flat_map(|&slot| &scene.readers[slot]).copied().collect();
        let mut times = vec![0; scene.times.len()];
        let mut elements = Vec::new();
        for &number in &stale {
            self.begin();
            let source = &scene.sources[number as usize];
            let drawn = self.drawn(source.thing, source.computed.as_ref());
            if drawn.elements.len() != source.at.len() || drawn.faults.len() != source.faults {
                return None;
            }
            for slot in drawn.reads {
                let readers = &mut scene.readers[slot];
                if !readers.contains(&number) {
                    readers.push(number);
                }
            }
            for (mut element, &at) in drawn.elements.into_iter().zip(&source.at) {
                let before = &mut scene.picture.drawing.elements[at as usize];
                let thing = scene.picture.things.get(before.tag.0 as usize);
                if thing != Some(&ThingId(element.tag.0))
                    || before.style != element.style
                    || before.layer != element.layer
                {
                    return None;
                }
                element.tag = before.tag;
                let times = &mut times[at as usize];
                *times += 1;
                if *before != element {
                    if *times > 1 {
                        return None;
                    }
                    elements.push(at);
                    *before = element;
                }
            }
        }
        // what several draw alike has to stay alike
        if elements.iter().any(|&at| times[at as usize] != scene.times[at as usize]) {
            return None;
        }
        moved.elements = elements.into_iter().collect();
        let grips = changed.iter().flat_map(|&slot| &scene.coordinates[slot]);
        for &at in grips {
            let number = |slot: SlotId| self.values.numbers[slot];
            let [x, y] = scene.grip_slots[at as usize].map(number);
            scene.picture.grips[at as usize].at = Point { x, y };
            moved.grips.insert(at);
        }
        Some(moved)
    }

    /// Finds what draws below a thing, in order: things that are drawn as the sum of their parts are passed through.
    fn sources(&self, thing: ThingId, found: &mut Vec<ThingId>) {
        let mut open = vec![thing];
        while let Some(thing) = open.pop() {
            match self.parts_drawn(thing) {
                Some(parts) => open.extend(parts.into_iter().rev()),
                None => found.push(thing),
            }
        }
    }

    /// Returns the parts of a thing that is drawn as the sum of these; nothing where its class says otherwise.
    fn parts_drawn(&self, thing: ThingId) -> Option<Vec<ThingId>> {
        let class = self.structure.things[thing].class;
        let is_sum = match self.class_kind(thing) {
            ClassKind::List(_) => true,
            ClassKind::Composite => {
                let said = self.document.find_message(class, &self.tables.picture, None);
                said.is_some_and(|(by, message)| {
                    message.is_default && self.document.classes[by].supers.is_empty()
                })
            }
            ClassKind::Primitive(_) | ClassKind::Set(_) | ClassKind::Reference(_) => false,
        };
        if !is_sum
            || !self.structure.unlike(thing).is_empty()
            || !self.layout(class).superclasses.is_empty()
        {
            return None;
        }
        let parts = self.parts_of(&Answer::Thing(thing)).ok()?;
        let thing = |part: &Answer<'_>| match part {
            Answer::Thing(thing) => Some(*thing),
            _ => None,
        };
        let drawn = parts.iter().filter(|part| self.may_draw(part));
        Some(drawn.filter_map(thing).collect())
    }

    /// Names what a document computes that is drawn with its parts: things that are made, as by a construction.
    ///
    /// Where the document says itself how it is drawn, that is all.
    pub fn computed_figures(&self, thing: ThingId) -> Vec<Name> {
        if thing != DOCUMENT || self.parts_drawn(thing).is_none() {
            return Vec::new();
        }
        let class = &self.document.classes[self.structure.things[thing].class];
        let messages = class.messages.iter().filter(|m| {
            m.parameters.is_empty() && !m.is_of_class() && m.name != self.tables.picture
        });
        let is_figure = |m: &&Message| {
            self.begin();
            match self.ask(thing, &m.name) {
                Ok(Answer::Made(_)) => true,
                Ok(Answer::List(items)) => {
                    !items.is_empty() && items.iter().all(|i| matches!(i, Answer::Made(_)))
                }
                Ok(_) => false,
                Err(_) => makes_a_thing(&m.answer),
            }
        };
        messages.filter(is_figure).map(|m| m.name.clone()).collect()
    }

    /// Lets a thing draw, or what it computes by a name, and listens to what that reads.
    fn drawn(&self, thing: ThingId, computed: Option<&Name>) -> Drawn {
        self.faults.borrow_mut().clear();
        let to = Answer::Thing(thing);
        let (answer, reads) = self.listening(|| match computed {
            None => {
                let look = || self.send(&to, &self.tables.picture, Vec::new(), None, thing);
                match self.document.program(self.structure.things[thing].class) {
                    Some(_) => self.replay(&Asked::Look(thing), &[], look),
                    None => look(),
                }
            }
            Some(name) => {
                let made = self.send(&to, name, Vec::new(), None, thing)?;
                self.join_pictures(&[made], thing)
            }
        });
        let elements = match answer {
            Ok(Answer::Picture(elements)) => elements.to_vec(),
            Ok(other) => {
                let fault =
                    Fault::wrong(format!("{} where a picture is wanted", self.kind(&other)));
                self.faults.borrow_mut().push(fault);
                Vec::new()
            }
            Err(fault) => {
                self.faults.borrow_mut().push(fault);
                Vec::new()
            }
        };
        Drawn { elements, faults: std::mem::take(&mut *self.faults.borrow_mut()), reads }
    }
}

/// Returns true for a term that is a thing wherever it has an answer.
fn makes_a_thing(term: &Term) -> bool {
    match term {
        Term::Make { .. } | Term::Construct { .. } => true,
        Term::Send { to, .. } => matches!(**to, Term::Class(_)) || makes_a_thing(to),
        Term::Let(_, _, body) => makes_a_thing(body),
        Term::If(_, a, b) => makes_a_thing(a) && makes_a_thing(b),
        _ => false,
    }
}

/// Elements of which no two are alike in everything.
#[derive(Default)]
struct Distinct {
    alike: BTreeMap<(Tag, u64), Vec<u32>>,
    kept: Vec<Element>,
}

impl Distinct {
    /// Returns where an element stands, which joins them if there is none like it.
    fn place(&mut self, element: Element) -> u32 {
        let same = self.alike.entry((element.tag, fingerprint(&element))).or_default();
        if let Some(&at) = same.iter().find(|&&at| self.kept[at as usize] == element) {
            return at;
        }
        let at = self.kept.len() as u32;
        same.push(at);
        self.kept.push(element);
        at
    }
}

/// Mixes an element's points into a number that alike elements share.
fn fingerprint(element: &Element) -> u64 {
    let mut mixed = match element.style.color {
        Color::Ink => 1,
        Color::Faint => 2,
        Color::Accent => 3,
        Color::Named(_) => 4,
    };
    let mut mix = |x: f64| {
        let bits = mixed ^ (x + 0.0).to_bits();
        mixed = bits.wrapping_mul(0x0100_0000_01b3).rotate_left(29);
    };
    let mut point = |p: Point| {
        mix(p.x);
        mix(p.y);
    };
    match &element.shape {
        Shape::Dot(p) | Shape::Circle { center: p, .. } => point(*p),
        Shape::Text { at, turn, .. } => {
            point(*at);
            point(Point { x: *turn, y: 0.0 });
        }
        Shape::Segment(p, q) => {
            point(*p);
            point(*q);
        }
        Shape::Polyline { points, .. } | Shape::Spline(points) => {
            points.iter().for_each(|p| point(*p));
        }
        Shape::Nurbs(curve) => {
            curve.poles().iter().for_each(|p| point(*p));
            let numbers = curve.weights().iter().chain(curve.knots());
            numbers.for_each(|x| point(Point { x: *x, y: 0.0 }));
        }
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            point(*center);
            point(*major);
            point(Point { x: *start, y: *sweep });
            point(Point { x: *ratio, y: 0.0 });
        }
        Shape::Region(rings) => rings.iter().flatten().for_each(|corner| {
            point(corner.at);
            point(Point { x: corner.bulge, y: 0.0 });
            corner.poles.into_iter().flatten().for_each(&mut point);
        }),
        Shape::Arc { center, start, sweep, .. } => {
            point(*center);
            point(Point { x: *start, y: *sweep });
        }
    }
    mixed
}

/// Numbers the tagged things in the order in which they are drawn, and returns them.
fn retag(elements: &mut [Element], things: usize) -> Vec<ThingId> {
    let mut number = IdVec::<ThingId, Option<u32>>::filled(None, things);
    let mut tagged = Vec::new();
    for element in elements {
        let thing = ThingId(element.tag.0);
        let n = *number[thing].get_or_insert_with(|| {
            tagged.push(thing);
            tagged.len() as u32 - 1
        });
        element.tag = Tag(n);
    }
    tagged
}
