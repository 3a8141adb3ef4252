//! A system: one connected component, as the caller states it.
//!
//! In: relations among slots, each slot with the stay that it has in this edit. The system holds no
//! values: a plan made of it serves all. Two systems that are equal have the same plan.

use crate::pattern::PatternId;
use crate::seldom::Seldom;
use base::number::Tolerance;
use std::hash::{Hash, Hasher};

/// A slot of the system: an unknown or a known. It is also the `expr::Var` of the same number.
pub type SlotIndex = u32;

/// How strongly a relation wants to hold, strongest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Level {
    /// Required constraints, and what is `set` in this edit.
    Required,
    /// `strong`
    Strong,
    /// What is to stay, strongly.
    StrongStay,
    /// The wish of a drag.
    Move,
    /// `medium`
    Medium,
    /// What is to stay, with medium strength.
    MediumStay,
    /// `weak`
    Weak,
    /// What is to stay, weakly.
    WeakStay,
}

impl Level {
    /// The levels that may give way, strongest first.
    ///
    /// A declared stay comes after the constraints of its strength. It is measured from the state in which
    /// an edit began: were it balanced against them, each new edit would give way to them a little further.
    pub const SOFT: [Self; 7] = [
        Self::Strong,
        Self::StrongStay,
        Self::Move,
        Self::Medium,
        Self::MediumStay,
        Self::Weak,
        Self::WeakStay,
    ];

    /// Returns where it stands in [`Level::SOFT`]; nothing for what is required.
    pub fn rank(self) -> Option<usize> {
        Self::SOFT.iter().position(|&level| level == self)
    }
}

/// Who gives a number: the firmest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Giver {
    /// The document itself (level 5).
    Document,
    /// A class, to all its things (level 6): a default yields before what the document says.
    Class,
}

impl Giver {
    /// Both, in the order in which they yield.
    pub(crate) const YIELDING: [Self; 2] = [Self::Class, Self::Document];
}

/// What holds a slot where no relation moves it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Stay {
    /// Known: an anchor, a target of the edit. Never written by the plan.
    Fixed,
    /// A given number (levels 5 and 6): constant unless a relation could not hold otherwise.
    Given(Giver),
    /// Everything else with a value (level 7). Slots with the same `group` are one place and yield
    /// as one; groups are numbered in order of declaration, a lone number is a group of its own.
    Kept {
        /// The place or the lone number.
        group: u32,
    },
    /// No stay: on opening, what is not given. It has no value before the plan has run; where
    /// nothing determines it, it is the nearest to zero.
    Free,
}

/// Where an unknown stands among those whose change is to be least, first come first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(crate) enum Turn {
    /// Given numbers that yield.
    Given(Giver),
    /// Everything else that has a value to stay at.
    Valued,
    /// What has none: it is nearest to zero where the others leave that open.
    Open,
}

impl Turn {
    /// All of them, in order.
    pub(crate) const ALL: [Self; 4] =
        [Self::Given(Giver::Document), Self::Given(Giver::Class), Self::Valued, Self::Open];
}

impl Stay {
    /// Returns true for a given number.
    pub fn is_given(self) -> bool {
        matches!(self, Self::Given(_))
    }
    /// Returns whose change counts along with that of what is held so.
    pub(crate) fn turn(self) -> Turn {
        match self {
            Self::Given(giver) => Turn::Given(giver),
            Self::Fixed | Self::Kept { .. } => Turn::Valued,
            Self::Free => Turn::Open,
        }
    }
}

/// The scale of plain numbers.
pub const PLAIN: u16 = 0;
/// The scale of truth values.
pub const TRUTH: u16 = 1;

/// One slot.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Slot {
    /// What holds it.
    pub stay: Stay,
    /// Slots of one scale have one extent in the measure of distance: all lengths, all voltages, …. Plain numbers have
    /// [`PLAIN`], truth values [`TRUTH`].
    pub scale: u16,
    /// True for a number that the plan can compute; false for a text, known to the host alone.
    pub is_number: bool,
    /// True for a number that can only be whole (or a truth value): it is never moved by degrees.
    pub is_discrete: bool,
}

/// A stretch of one of the lists of a [`System`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Span {
    /// Where it begins.
    pub start: u32,
    /// How long it is.
    pub len: u32,
}

impl Span {
    /// Returns the places in the list.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..(self.start + self.len) as usize
    }
}

/// `left = right`: a pattern of two expressions, and the slots that are its arguments.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Equation {
    /// What it says.
    pub pattern: PatternId,
    /// Of what, in [`System::arguments`]; no slot twice.
    pub arguments: Span,
}

/// What a relation says.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum RelationBody {
    /// Equations that hold together: one for a number, two for a place, …; in [`System::equations`].
    Equations(Span),
    /// Something that only the host can test (by the relation's `source`), over these slots:
    /// text, or a rule without an error expression. It counts as one row.
    Opaque {
        /// The slots that it speaks of.
        slots: Box<[SlotIndex]>,
    },
}

/// How a method computes its targets.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum MethodBody {
    /// A pattern of one expression for each target.
    Formulas {
        /// The expressions.
        pattern: PatternId,
        /// Of which slots, in [`System::arguments`].
        arguments: Span,
    },
    /// The host computes them (by the relation's `source` and the method's index) from `reads`.
    Opaque {
        /// The slots that the host reads.
        reads: Vec<SlotIndex>,
    },
}

/// A way to make a relation hold by writing some of its slots.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Method {
    /// The slots that it writes; never [`Stay::Fixed`] ones, or it is not possible.
    pub targets: Vec<SlotIndex>,
    /// How.
    pub body: MethodBody,
}

/// A constraint, a wish or a declared stay.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Relation {
    /// How strongly it wants to hold.
    pub level: Level,
    /// What it says.
    pub body: RelationBody,
    /// Written methods, in order of preference. The first that is possible is taken.
    pub methods: Seldom<Method>,
    /// True if it may also be solved in ways that were not written (always so without methods).
    pub derived: bool,
    /// Slots that it never writes, in [`System::arguments`].
    pub reads: Span,
    /// How far its sides may differ.
    pub within: Tolerance,
    /// What the caller calls it: the index of a constraint, a wish or a stay in the caller's table.
    pub source: u32,
    /// True if it holds where the edit begins and speaks of nothing that the edit gives a value: it moves nothing
    /// by itself.
    pub rests: bool,
}

/// One connected component.
///
/// Relations stand in order of declaration; slots too.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct System {
    /// The slots.
    pub slots: Vec<Slot>,
    /// The relations.
    pub relations: Vec<Relation>,
    /// The equations of all relations, one relation's after the other's.
    pub equations: Vec<Equation>,
    /// The arguments of all equations and methods, and what relations only read.
    pub arguments: Vec<SlotIndex>,
}

/// Looks at what tells systems apart as a rule, and at nothing else: large ones are looked up too.
impl Hash for System {
    fn hash<H: Hasher>(&self, state: &mut H) {
        let mut pair = |a: u32, b: u32| state.write_u64(u64::from(a) << 32 | u64::from(b));
        pair(self.slots.len() as u32, self.relations.len() as u32);
        for slot in &self.slots {
            let (kind, group) = match slot.stay {
                Stay::Fixed => (0, 0),
                Stay::Given(giver) => (1, giver as u32),
                Stay::Free => (2, 0),
                Stay::Kept { group } => (3, group),
            };
            pair(kind, group);
        }
        self.relations.iter().for_each(|r| pair(r.level as u32, r.methods.len() as u32));
        self.equations.iter().for_each(|e| pair(e.pattern.0, e.arguments.len));
        let (pairs, rest) = self.arguments.as_chunks::<2>();
        pairs.iter().for_each(|&[a, b]| pair(a, b));
        rest.iter().for_each(|&a| pair(a, 0));
    }
}

impl System {
    /// Adds a list of arguments.
    pub fn add_arguments(&mut self, slots: impl IntoIterator<Item = SlotIndex>) -> Span {
        let start = self.arguments.len() as u32;
        self.arguments.extend(slots);
        Span { start, len: self.arguments.len() as u32 - start }
    }
    /// Adds equations, each by its pattern and its arguments.
    pub fn add_equations<A: IntoIterator<Item = SlotIndex>>(
        &mut self,
        equations: impl IntoIterator<Item = (PatternId, A)>,
    ) -> Span {
        let start = self.equations.len() as u32;
        for (pattern, arguments) in equations {
            let arguments = self.add_arguments(arguments);
            self.equations.push(Equation { pattern, arguments });
        }
        Span { start, len: self.equations.len() as u32 - start }
    }
    /// Returns the slots of a list of arguments.
    pub fn arguments(&self, span: Span) -> &[SlotIndex] {
        &self.arguments[span.range()]
    }
    /// Returns the slots that a relation never writes.
    pub fn reads(&self, relation: &Relation) -> &[SlotIndex] {
        self.arguments(relation.reads)
    }
    /// Returns the equations of a relation; an opaque one has none.
    pub fn equations_of(&self, relation: &Relation) -> &[Equation] {
        match &relation.body {
            RelationBody::Equations(span) => &self.equations[span.range()],
            RelationBody::Opaque { .. } => &[],
        }
    }
}
