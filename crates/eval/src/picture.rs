//! The picture of a document: what its things draw, and where they can be gripped.

use crate::answer::Answer;
use crate::evaluator::Evaluator;
use crate::fault::Fault;
use base::IdVec;
use drawing::{Color, Drawing, Element, Point, Shape, Tag, Vertical};
use expr::dimension::Dimension;
use kernel::{ClassId, ClassKind, Primitive, SlotId, ThingId};
use std::collections::BTreeMap;

/// A drawing, what its tags stand for, and what can be gripped in it.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// What is drawn. Each element is tagged with the nearest thing whose message made it.
    pub drawing: Drawing,
    /// For every tag, its thing: of merged ones the first.
    pub things: Vec<ThingId>,
    /// Every place, merged ones once, in order of declaration.
    pub grips: Vec<Grip>,
    /// Why some things have no picture; the others are drawn without them.
    pub faults: Vec<Fault>,
}

/// A place that can be gripped and dragged.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Grip {
    /// Its thing: of merged ones the first.
    pub thing: ThingId,
    /// Where it is.
    pub at: Point,
    /// True if an anchor holds both its coordinates.
    pub anchored: bool,
}

impl Evaluator<'_> {
    /// Draws a thing by its message `picture`. What is drawn twice alike is drawn once.
    pub fn picture(&self, thing: ThingId) -> Picture {
        self.begin();
        self.faults.borrow_mut().clear();
        let to = Answer::Thing(thing);
        let name = &self.tables.picture;
        let mut elements = match self.send(&to, name, Vec::new(), None, thing) {
            Ok(Answer::Picture(elements)) => elements.to_vec(),
            Ok(other) => {
                let kind = self.kind(&other);
                let fault = Fault::wrong(format!("{kind} where a picture is wanted"));
                self.faults.borrow_mut().push(fault);
                Vec::new()
            }
            Err(fault) => {
                self.faults.borrow_mut().push(fault);
                Vec::new()
            }
        };
        once_each(&mut elements);
        let things = retag(&mut elements, self.structure.things.len());
        let vertical = match self.document.vertical {
            kernel::Vertical::Up => Vertical::Up,
            kernel::Vertical::Down => Vertical::Down,
        };
        Picture {
            drawing: Drawing { elements, vertical },
            things,
            grips: self.grips(thing),
            faults: std::mem::take(&mut *self.faults.borrow_mut()),
        }
    }

    /// Finds every place below a thing: what has an `x` and a `y` that are lengths.
    fn grips(&self, below: ThingId) -> Vec<Grip> {
        let mut classes: BTreeMap<ClassId, Option<(u32, u32)>> = BTreeMap::new();
        let mut seen = IdVec::<ThingId, bool>::filled(false, self.structure.things.len());
        let mut grips = Vec::new();
        let mut stack = vec![below];
        while let Some(thing) = stack.pop() {
            let t = &self.structure.things[thing];
            let xy = *classes.entry(t.class).or_insert_with(|| self.coordinates(t.class));
            stack.extend(self.structure.parts(thing).rev());
            let Some((x, y)) = xy else { continue };
            let first = self.structure.merged[thing];
            if std::mem::replace(&mut seen[first], true) {
                continue;
            }
            let slot = |i: u32| self.structure.slot_of(ThingId(t.first_part.0 + i));
            if let (Some(x), Some(y)) = (slot(x), slot(y)) {
                let number = |s: SlotId| self.values.numbers[s];
                let held = |s: SlotId| self.structure.slots[s].anchored;
                grips.push(Grip {
                    thing: first,
                    at: Point { x: number(x), y: number(y) },
                    anchored: held(x) && held(y),
                });
            }
        }
        grips
    }

    /// Returns the fields that are the coordinates of a class's things, if they are places.
    pub(crate) fn coordinates(&self, class: ClassId) -> Option<(u32, u32)> {
        if self.document.classes[class].kind != ClassKind::Composite {
            return None;
        }
        let layout = self.layout(class);
        let length = ClassKind::Primitive(Primitive::Real(Dimension::LENGTH));
        let field = |name| {
            let i = *layout.index.get(name)?;
            let class = self.document.field_class(layout.fields[i as usize]);
            (self.document.classes[class].kind == length).then_some(i)
        };
        Some((field(&self.tables.x)?, field(&self.tables.y)?))
    }
}

/// Keeps the first of elements that are alike in everything.
fn once_each(elements: &mut Vec<Element>) {
    let mut alike: BTreeMap<(Tag, u64), Vec<usize>> = BTreeMap::new();
    let mut kept: Vec<Element> = Vec::with_capacity(elements.len());
    for element in elements.drain(..) {
        let same = alike.entry((element.tag, fingerprint(&element))).or_default();
        if !same.iter().any(|&i| kept[i] == element) {
            same.push(kept.len());
            kept.push(element);
        }
    }
    *elements = kept;
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
        Shape::Dot(p) | Shape::Circle { center: p, .. } | Shape::Text { at: p, .. } => point(*p),
        Shape::Segment(p, q) => {
            point(*p);
            point(*q);
        }
        Shape::Polyline { points, .. } => points.iter().for_each(|p| point(*p)),
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
