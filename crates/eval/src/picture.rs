//! The picture of a document: what its things draw, and where they can be gripped.

use crate::evaluator::Evaluator;
use crate::fault::Fault;
use base::IdVec;
use drawing::{Drawing, Point};
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
        self.scene(thing).picture
    }

    /// Finds every place below a thing, with the slots of its coordinates: what has an `x` and a `y` that are lengths.
    pub(crate) fn grips(&self, below: ThingId) -> Vec<(Grip, [SlotId; 2])> {
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
                let at = Point { x: number(x), y: number(y) };
                grips.push((Grip { thing: first, at, anchored: held(x) && held(y) }, [x, y]));
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
