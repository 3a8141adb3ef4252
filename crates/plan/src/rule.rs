//! Rules over slots: what constraints and declared stays say, in the slots of the document.

use base::IdVec;
use expr::{Arena, ExprId};
use kernel::SlotId;
use solve::{Level, PatternId, Patterns, Scratch};

/// Where a rule comes from.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Source {
    /// The constraint of this index in the structure.
    Constraint(u32),
    /// The declared stay of this index in the structure.
    Stay(u32),
    /// The wish of this index in the edit.
    Wish(u32),
}

/// A constraint or a declared stay, over the slots of the document.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    pub(crate) source: Source,
    pub(crate) level: Level,
    pub(crate) body: Body,
    pub(crate) methods: Vec<RuleMethod>,
    pub(crate) derived: bool,
    pub(crate) reads: Vec<SlotId>,
    pub(crate) within: f64,
    /// Every slot that it mentions, in order.
    pub(crate) slots: Vec<SlotId>,
}

/// A pattern over slots of the document: an equation, or what a method or a wish computes.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    pub(crate) pattern: PatternId,
    /// Its arguments, in order.
    pub(crate) slots: Box<[SlotId]>,
}

impl Formula {
    /// States expressions whose variables are slots by number.
    pub(crate) fn of(patterns: &mut Patterns, arena: &Arena, roots: &[ExprId]) -> Self {
        let (pattern, variables) = patterns.intern(arena, roots);
        Self { pattern, slots: variables.into_iter().map(|v| SlotId(v.0)).collect() }
    }
    /// Computes its expressions.
    pub(crate) fn evaluate<'s>(
        &self,
        patterns: &Patterns,
        numbers: &IdVec<SlotId, f64>,
        scratch: &'s mut Scratch,
    ) -> &'s [f64] {
        let arguments = self.slots.iter().map(|&s| numbers[s]);
        patterns.get(self.pattern).evaluate(arguments, scratch)
    }
    /// Computes the one expression that it is of.
    pub(crate) fn value(&self, patterns: &Patterns, numbers: &IdVec<SlotId, f64>) -> f64 {
        self.evaluate(patterns, numbers, &mut Scratch::default())[0]
    }
}

/// What a rule says.
#[derive(Clone, Debug)]
pub(crate) enum Body {
    /// Equations that hold together.
    Equations(Vec<Formula>),
    /// Something that only the host can test.
    Opaque(Vec<SlotId>),
    /// The slots keep the values that they had when the edit began.
    Hold(Vec<SlotId>),
}

/// A way to make a rule hold.
#[derive(Clone, Debug)]
pub(crate) struct RuleMethod {
    pub(crate) targets: Vec<SlotId>,
    pub(crate) reads: Vec<SlotId>,
    pub(crate) how: How,
}

/// How a method computes its targets.
#[derive(Clone, Debug)]
pub(crate) enum How {
    /// By a pattern of one expression for each target.
    Formulas(Formula),
    /// The host does.
    Host(Way),
    /// The one target takes what is in the one slot that is read.
    Copy,
}

/// A way to make a constraint hold that only the host can go.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Way {
    /// The written method of this index.
    Written(u32),
    /// The left side of its `=` takes the value of the right side.
    Left,
    /// The right side takes the value of the left side.
    Right,
}
