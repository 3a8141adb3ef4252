//! A document: classes, the last word of which is the document's own.

use crate::class::{Class, ClassId, ClassKind, Handle, Message, Part};
use crate::classes::Classes;
use crate::path::Path;
use crate::program::Program;
use crate::term::{OriginId, Search};
use base::number::Toward;
use base::{IdVec, Name};
use expr::dimension::Dimension;
use geometry::Made;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// Which way `y` runs on the sheet.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Vertical {
    /// Up, as in mathematics.
    Up,
    /// Down, as on a screen.
    Down,
}

/// Everything that a text says: classes, and the class of the document itself.
#[derive(Clone, PartialEq, Debug)]
pub struct Document {
    /// Every class in scope: the language's own, the libraries', the document's.
    pub classes: Classes,
    /// The unnamed class whose one instance is the document.
    pub root: ClassId,
    /// Which way `y` runs.
    pub vertical: Vertical,
    /// How many base units of length are in a metre: 1000 for `unit mm`, 1 without a unit line.
    pub units_per_metre: f64,
    /// By which powers of two its base units are others than those of SI, or of the sheet.
    pub scale: crate::Scale,
    /// How the unit of the sheet is spelled: `mm` for `unit mm`; nothing without a unit line.
    pub unit: Option<Name>,
    /// True if its text writes lengths with their units and names no unit of the sheet: then bare lengths are metres
    /// to people, too.
    pub writes_lengths: bool,
    /// The units in which the text writes quantities, by what they measure and the sort of their class
    /// ([`crate::Quantity::sort`]); without a sort, where the class is not known.
    pub usual: BTreeMap<(Dimension, Option<Name>), Usual>,
    /// The system of units in which the text counts, where that is not SI.
    pub customary: Option<crate::Customary>,
    /// Quotients of the units that the text writes, by what they measure ([`crate::quotients`]).
    pub quotients: BTreeMap<Dimension, Vec<Name>>,
    /// The units of given numbers as they are written, by where that is; bare numbers have none.
    pub units: BTreeMap<OriginId, Name>,
}

/// The units in which a text writes a sort of quantity: feet, days, litres.
#[derive(Clone, PartialEq, Debug)]
pub struct Usual {
    /// The units, those that it writes most often first, of equals the larger; none where it writes one of SI with a
    /// prefix of a thousand.
    pub units: Vec<Name>,
    /// A smaller number is not shown in one of them.
    pub least: f64,
}

/// Which way a place or a number goes from where two branches meet, and its values do not say it.
#[derive(Clone, PartialEq, Debug)]
pub struct Side {
    /// The place or number, from the thing whose class says it.
    pub path: Path,
    /// Which way.
    pub way: SideWay,
    /// Where it was written.
    pub origin: OriginId,
}

/// The ways that can be written: of a place as on the sheet, of a number by its size.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SideWay {
    /// Its `x` shrinks.
    Left,
    /// Its `x` grows.
    Right,
    /// Up the sheet, whichever way `y` runs.
    Up,
    /// Down the sheet.
    Down,
    /// A number shrinks.
    Less,
    /// A number grows.
    More,
}

impl SideWay {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Left, Self::Right, Self::Up, Self::Down, Self::Less, Self::More];

    /// Returns the word for it in the language.
    pub fn word(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Up => "up",
            Self::Down => "down",
            Self::Less => "less",
            Self::More => "more",
        }
    }
    /// Returns the coordinate of a place that it speaks of; nothing where it speaks of a number.
    pub fn coordinate(self) -> Option<&'static str> {
        match self {
            Self::Left | Self::Right => Some("x"),
            Self::Up | Self::Down => Some("y"),
            Self::Less | Self::More => None,
        }
    }
    /// Returns whether the number that it speaks of grows.
    pub fn toward(self, vertical: Vertical) -> Toward {
        match (self, vertical) {
            (Self::Right | Self::More, _)
            | (Self::Up, Vertical::Up)
            | (Self::Down, Vertical::Down) => Toward::More,
            (Self::Left | Self::Less, _)
            | (Self::Down, Vertical::Up)
            | (Self::Up, Vertical::Down) => Toward::Less,
        }
    }
}

/// A part as an instance has it: whose class it comes from and where in that class.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct PartRef {
    /// The class that declares the part.
    pub class: ClassId,
    /// Its index among that class's parts; for a superclass part, among its superclasses.
    pub index: usize,
    /// Whether it is a declared part or stands for a superclass other than the primary one.
    pub role: PartRole,
}

/// Who answers a combining message.
#[derive(Clone, Debug)]
pub struct Voices<'m> {
    /// The definition of the thing's own primary line.
    pub own: Option<&'m Message>,
    /// The fields, by index in the layout, of superclasses that add what they say.
    pub others: Vec<u32>,
}

/// What a field of an instance stands for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PartRole {
    /// A declared part.
    Part,
    /// A superclass other than the primary one.
    Superclass,
}

impl Document {
    /// Returns the class and its primary superclasses, from the class upwards.
    pub fn primary_line(&self, class: ClassId) -> Vec<ClassId> {
        self.upwards(class).collect()
    }
    /// Goes through the class and its primary superclasses, from the class upwards.
    pub fn upwards(&self, class: ClassId) -> impl Iterator<Item = ClassId> + '_ {
        let above = |&c: &ClassId| self.classes[c].supers.first().map(|s| s.class);
        // no line is longer than there are classes, even where superclasses stand in a ring
        std::iter::successors(Some(class), above).take(self.classes.len())
    }
    /// Returns what things of a class draw, if the class or one above it is a program.
    pub fn program(&self, class: ClassId) -> Option<&Rc<Program>> {
        self.upwards(class).find_map(|c| self.classes[c].program.as_ref())
    }
    /// Returns true for the name of a constraint or merge that one of the classes nearer to a thing
    /// masks.
    pub fn is_masked(&self, nearer: &[ClassId], name: Option<&Name>) -> bool {
        name.is_some_and(|name| nearer.iter().any(|&c| self.classes[c].without.contains(name)))
    }
    /// Returns the fields of an instance: inherited parts first, superclass parts where declared.
    pub fn layout(&self, class: ClassId) -> Vec<PartRef> {
        let mut layout = Vec::new();
        for class in self.primary_line(class).into_iter().rev() {
            let c = &self.classes[class];
            let supers = (1..c.supers.len()).map(|index| PartRef {
                class,
                index,
                role: PartRole::Superclass,
            });
            let parts =
                (0..c.parts.len()).map(|index| PartRef { class, index, role: PartRole::Part });
            layout.extend(supers.chain(parts));
        }
        layout
    }
    /// Returns the name of a field.
    pub fn field_name(&self, field: PartRef) -> &Name {
        match field.role {
            PartRole::Part => &self.classes[field.class].parts[field.index].name,
            PartRole::Superclass => &self.classes[field.class].supers[field.index].name,
        }
    }
    /// Returns the class that a field has in things of a class: where it is refined, the narrower one.
    pub fn refined_class(&self, class: ClassId, field: PartRef) -> ClassId {
        let refined = |c: ClassId| {
            let own = &self.classes[c].refined;
            own.iter().find(|(f, _)| *f == field).map(|(_, narrower)| *narrower)
        };
        self.upwards(class).find_map(refined).unwrap_or_else(|| self.field_class(field))
    }
    /// Returns the classes that fields have in things of a class, in their order. Cost: linear in the fields and in the
    /// primary line.
    pub fn refined_classes(&self, class: ClassId, fields: &[PartRef]) -> Vec<ClassId> {
        if self.upwards(class).all(|c| self.classes[c].refined.is_empty()) {
            return fields.iter().map(|&f| self.field_class(f)).collect();
        }
        fields.iter().map(|&f| self.refined_class(class, f)).collect()
    }
    /// Returns the class of a field, as it was declared.
    pub fn field_class(&self, field: PartRef) -> ClassId {
        match field.role {
            PartRole::Part => self.classes[field.class].parts[field.index].class,
            PartRole::Superclass => self.classes[field.class].supers[field.index].class,
        }
    }
    /// Returns the declaration of a field that is a declared part.
    pub fn declared(&self, field: PartRef) -> Option<&Part> {
        match field.role {
            PartRole::Part => Some(&self.classes[field.class].parts[field.index]),
            PartRole::Superclass => None,
        }
    }
    /// Returns every class that `class` is: itself, and all superclasses, nearest first, once each.
    pub fn lineage(&self, class: ClassId) -> Vec<ClassId> {
        let mut all = self.primary_line(class);
        let mut known: BTreeSet<ClassId> = all.iter().copied().collect();
        let mut i = 0;
        while i < all.len() {
            for s in self.classes[all[i]].supers.iter().skip(1) {
                let mut next = Some(s.class);
                // what stands above a known class is known
                while let Some(c) = next.filter(|&c| known.insert(c)) {
                    all.push(c);
                    next = self.classes[c].supers.first().map(|s| s.class);
                }
            }
            i += 1;
        }
        all
    }
    /// Returns true if every thing of `class` is a thing of `ancestor`.
    pub fn is_a(&self, class: ClassId, ancestor: ClassId) -> bool {
        let is = |c: ClassId| c == ancestor || self.classes[c].general == Some(ancestor);
        // most classes have one superclass, and so has each of those above them
        let has_others = || self.upwards(class).any(|c| self.classes[c].supers.len() > 1);
        self.upwards(class).any(is) || has_others() && self.lineage(class).into_iter().any(is)
    }
    /// Returns what a whole number is that says how many parts the things of a class have.
    pub fn count(&self, class: ClassId, name: &Name) -> Option<i64> {
        let counts = |c: ClassId| self.classes[c].counts.iter().find(|(n, _)| n == name);
        self.upwards(class).find_map(counts).map(|(_, count)| *count)
    }
    /// Returns the class of this name, the last declared first.
    pub fn class_named(&self, name: &str) -> Option<ClassId> {
        let named = |(_, c): &(ClassId, &Class)| c.name == name && !c.is_of_one;
        self.classes.iter().rev().find(named).map(|(id, _)| id)
    }
    /// Returns the place of an option of this name among those of a choice.
    pub fn option_named(&self, choice: ClassId, name: &str) -> Option<u32> {
        let at = self.classes[choice].options.iter().position(|option| *option == *name)?;
        u32::try_from(at).ok()
    }
    /// Returns the name of the option of a choice that stands in this place; nothing where there is none.
    pub fn option_at(&self, choice: ClassId, at: f64) -> Option<&Name> {
        let is_place = at.fract() == 0.0 && at >= 0.0;
        is_place.then(|| self.classes[choice].options.get(at as usize)).flatten()
    }
    /// Returns the class that is named in the text: of a class of one, the one that it comes from.
    pub fn named_class(&self, class: ClassId) -> ClassId {
        let line = self.primary_line(class);
        let named = |c: ClassId| match self.classes[c].general {
            None => (!self.classes[c].is_of_one).then_some(c),
            general => general,
        };
        line.into_iter().find_map(named).unwrap_or(class)
    }
    /// Returns the classes of which the document itself is the text: its own and those of its parts, as its bodies
    /// refine them.
    ///
    /// Cost: linear in the parts that these declare.
    pub fn own_bodies(&self) -> IdVec<ClassId, bool> {
        let mut is_own = IdVec::filled(false, self.classes.len());
        is_own[self.root] = true;
        let mut open = vec![self.root];
        while let Some(class) = open.pop() {
            let class = &self.classes[class];
            let element = match class.kind {
                ClassKind::List(element) | ClassKind::Set(element) => Some(element),
                ClassKind::Primitive(_) | ClassKind::Composite | ClassKind::Reference(_) => None,
            };
            let parts = class.parts.iter().map(|p| p.class);
            for part in parts.chain(element).chain(class.elements.iter().copied()) {
                let c = &self.classes[part];
                let is_list = matches!(c.kind, ClassKind::List(_) | ClassKind::Set(_));
                let is_body = is_list || c.is_of_one && c.general.is_none();
                if is_body && !is_own[part] {
                    is_own[part] = true;
                    open.push(part);
                }
            }
        }
        is_own
    }
    /// Finds a message by the thesis's order: the class, its primary line, then all others.
    ///
    /// A message marked `default` gives way to others.
    /// **Source:** Borning 1979, chapter 3, "Message Behavior".
    pub fn find_message(
        &self,
        class: ClassId,
        name: &str,
        search: Option<Search>,
    ) -> Option<(ClassId, &Message)> {
        let own = |c: ClassId| self.classes[c].messages.iter().rev().find(|m| m.name == name);
        self.find_message_by(class, search, &own)
    }
    /// Finds a message by the thesis's order, where `own` returns what a class defines itself.
    pub fn find_message_by<'m>(
        &self,
        class: ClassId,
        search: Option<Search>,
        own: &dyn Fn(ClassId) -> Option<&'m Message>,
    ) -> Option<(ClassId, &'m Message)> {
        let lineage = match search {
            Some(Search::As(superclass)) => self.lineage(superclass),
            Some(Search::Above(_)) | None => self.lineage(class),
        };
        let skip = match search {
            Some(Search::Above(a)) => lineage.iter().position(|&c| c == a).map_or(0, |p| p + 1),
            Some(Search::As(_)) | None => 0,
        };
        let mut found = lineage[skip..].iter().filter_map(|&c| Some((c, own(c)?)));
        let first = found.next()?;
        if !first.1.is_default {
            return Some(first);
        }
        Some(found.find(|(_, m)| !m.is_default).unwrap_or(first))
    }
    /// Returns what things of a class are to a construction, by what they answer to.
    ///
    /// An arc is its circle, as long as a curve goes on where it ends.
    pub fn figure(&self, class: ClassId) -> Option<Made> {
        let fields = self.layout(class);
        let has = |name: &str| {
            fields.iter().any(|&f| *self.field_name(f) == *name)
                || self.find_message(class, name, None).is_some()
        };
        let all = |names: [&str; 2]| names.into_iter().all(has);
        [
            (["p1", "p2"], Made::Straight),
            (["center", "radius"], Made::Circle),
            (["x", "y"], Made::Point),
        ]
        .into_iter()
        .find_map(|(names, made)| all(names).then_some(made))
    }
    /// Returns who answers a combining message; nothing for any other message.
    ///
    /// Of the primary line the nearest definition speaks, and classes passed on the way there add what
    /// their other superclasses say. Where only Object defines it, Object's definition speaks alone.
    pub fn voices(&self, class: ClassId, name: &str, search: Option<Search>) -> Option<Voices<'_>> {
        let own = |c: ClassId| self.classes[c].messages.iter().rev().find(|m| m.name == name);
        let line = self.primary_line(class);
        let general = line.last().and_then(|&object| own(object));
        let found = self.find_message(class, name, None).map(|found| found.1);
        if ![found, general].into_iter().flatten().any(|m| m.is_combining) {
            return None;
        }
        let at = |class| line.iter().position(|&c| c == class).unwrap_or(0);
        // where definitions are looked for, and from where other superclasses add theirs
        let (first, adding) = match search {
            Some(Search::Above(class)) => (at(class) + 1, at(class)),
            Some(Search::As(class)) => (at(class), at(class)),
            None => (0, 0),
        };
        let defines = |i: &usize| own(line[*i]).is_some_and(|m| !m.is_default);
        let nearest = (first..line.len()).find(defines);
        if nearest.is_none() && general.is_some() {
            return Some(Voices { own: general, others: Vec::new() });
        }
        let passed = &line[adding..nearest.unwrap_or(line.len())];
        let adds = |field: &PartRef| {
            field.role == PartRole::Superclass
                && passed.contains(&field.class)
                && self.find_message(self.field_class(*field), name, None).is_some()
        };
        let others = (0..).zip(self.layout(class)).filter(|(_, f)| adds(f)).map(|(i, _)| i);
        Some(Voices { own: nearest.and_then(|i| own(line[i])), others: others.collect() })
    }
    /// Returns how many of the first fields of a class's things are one place: all where they are a place
    /// themselves, else those of the nearest primary superclass whose things are. A superclass's things are a
    /// part of it, whatever it adds and asks of them.
    pub fn place_in(&self, class: ClassId) -> Option<usize> {
        let places = self.upwards(class).find(|&c| self.is_place(c));
        places.map(|c| self.layout(c).len())
    }
    /// Returns the handles of a class's things: its own, and of those above it the ones for other places.
    pub fn handles(&self, class: ClassId) -> Vec<&Handle> {
        let all = self.lineage(class).into_iter().filter_map(|c| self.classes.get(c));
        let mut handles: Vec<&Handle> = Vec::new();
        for handle in all.flat_map(|class| &class.handles) {
            if handles.iter().all(|known| known.place != handle.place) {
                handles.push(handle);
            }
        }
        handles
    }
    /// Returns true if things of the class are a *place*: the stored parts `x`, `y` and perhaps `z`, all real numbers
    /// of one dimension, no constraints. A place yields as one; a start and a duration do not. A document is none,
    /// whatever it consists of; nor is what a program draws, whatever it asks for.
    pub fn is_place(&self, class: ClassId) -> bool {
        if class == self.root {
            return false;
        }
        let layout = self.layout(class);
        let dimension = |&f: &PartRef| match self.classes[self.field_class(f)].kind {
            ClassKind::Primitive(crate::class::Primitive::Real(dimension)) => Some(dimension),
            _ => None,
        };
        let coordinates = ["x", "y", "z"].into_iter();
        (2..=3).contains(&layout.len())
            && layout.iter().zip(coordinates).all(|(&f, name)| self.field_name(f) == name)
            && layout
                .iter()
                .all(|f| dimension(f).is_some() && dimension(f) == dimension(&layout[0]))
            && self.lineage(class).iter().all(|&c| self.classes[c].constraints.is_empty())
            && self.program(class).is_none()
    }
}
