//! Rules over slots: what constraints and declared stays say, in the slots of the document.
//!
//! A rule is a *shape* and the slots that it speaks of. A constraint of a class has one shape for all
//! instances of the class that are built alike: it says of positions what each instance says of its
//! slots.

use base::number::Tolerance;
use base::{IdVec, define_id};
use expr::{Arena, ExprId};
use kernel::SlotId;
use solve::{Level, PatternId, Patterns, Scratch, Span};
use std::collections::BTreeMap;

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

/// A way to make a constraint hold that only the host can go.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Way {
    /// The written method of this index.
    Written(u32),
    /// The left side of the `=` to which these turns lead takes the value of the right side.
    Left(Turns),
    /// The right side takes the value of the left side.
    Right(Turns),
}

/// How one comes from a rule to an `=` in it: at every `and` and `or` to its first or second part, at every `if` to
/// what holds where the condition is true or where it is false. What a `let` binds and a message answers is gone into.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct Turns {
    /// The turns, the latest lowest; a one is to the second.
    taken: u32,
    count: u8,
}

impl Turns {
    /// None: the rule itself is the `=`.
    pub const NONE: Self = Self { taken: 0, count: 0 };
    /// Adds a turn, to the second or to the first; nothing where there are too many.
    pub(crate) fn then(self, second: bool) -> Option<Self> {
        let Self { taken, count } = self;
        let is_room = u32::from(count) < u32::BITS;
        is_room.then(|| Self { taken: taken << 1 | u32::from(second), count: count + 1 })
    }
    /// Returns the turns in order, true for those to the second.
    pub fn each(self) -> impl Iterator<Item = bool> {
        let Self { taken, count } = self;
        (0..count).rev().map(move |i| taken >> i & 1 == 1)
    }
}

/// A side of a comparison or of an `or` in a rule, or the condition of an `if`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct SideOf {
    /// How one comes to the comparison, the `or` or the `if`.
    pub turns: Turns,
    /// True for the right side; false for a condition.
    pub is_right: bool,
}

define_id!(ShapeId, "h", "What rules of one kind say.");

/// Where a slot stands among those of a rule.
pub(crate) type Position = u32;

/// What a rule says, of slots of the document or of positions among those of a rule.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Shape<S = Position> {
    pub(crate) level: Level,
    pub(crate) body: Body<S>,
    pub(crate) methods: Vec<RuleMethod<S>>,
    pub(crate) derived: bool,
    pub(crate) reads: Vec<S>,
    pub(crate) within: Tolerance,
    /// The conditions under which it holds; always, where there are none.
    pub(crate) when: Vec<When<S>>,
}

/// That a condition is true, or that it is false.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct When<S = Position> {
    pub(crate) condition: Condition<S>,
    pub(crate) truth: bool,
}

/// What is true or not, and decides whether a rule holds.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Condition<S = Position> {
    /// One expression of numbers.
    Numbers(Formula<S>),
    /// What only the host can compute, as whether texts are equal.
    Host(ByHost<S>),
}

/// A truth value that only the host can compute.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ByHost<S = Position> {
    /// The pattern of a lone argument, which that truth value is.
    pub(crate) pattern: PatternId,
    /// The constraint that says it, if that is another than the rule's.
    pub(crate) constraint: Option<u32>,
    /// Where it is said.
    pub(crate) side: SideOf,
    /// The slots that it is computed from.
    pub(crate) reads: Vec<S>,
}

impl<S> ByHost<S> {
    /// Returns the constraint that says it of a rule.
    pub(crate) fn constraint_of(&self, rule: Rule<'_>) -> Option<u32> {
        match (self.constraint, rule.source) {
            (Some(constraint), _) | (None, Source::Constraint(constraint)) => Some(constraint),
            (None, Source::Stay(_) | Source::Wish(_)) => None,
        }
    }
}

impl<S> When<S> {
    /// Notes that it is another constraint than the rule's that says it.
    pub(crate) fn said_by(mut self, constraint: u32) -> Self {
        if let Condition::Host(by) = &mut self.condition {
            by.constraint = Some(constraint);
        }
        self
    }
}

/// What holds where a rule holds.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Body<S = Position> {
    /// Equations that hold together.
    Equations(Vec<Formula<S>>),
    /// The one expression is true: an inequality, alternatives, anything but an equation.
    True(Formula<S>),
    /// The same, with a number in it that the host computes.
    Beside(Beside<S>),
    /// No two of the expressions are equal.
    Different(Formula<S>),
    /// Something that only the host can test.
    Opaque(Vec<S>),
    /// The slots keep the values that they had when the edit began.
    Hold(Vec<S>),
}

/// What is true of numbers and of one that the host computes, as of how wide a text is.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Beside<S = Position> {
    /// The one expression; its arguments without that number.
    pub(crate) truth: Formula<S>,
    /// Where that number stands among the arguments.
    pub(crate) place: u32,
    /// What it is.
    pub(crate) side: SideOf,
    /// The slots that it is computed from.
    pub(crate) reads: Vec<S>,
}

/// A way to make a rule hold.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct RuleMethod<S = Position> {
    pub(crate) targets: Vec<S>,
    pub(crate) reads: Vec<S>,
    pub(crate) how: How<S>,
}

/// How a method computes its targets.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum How<S = Position> {
    /// By a pattern of one expression for each target.
    Formulas(Formula<S>),
    /// The host does.
    Host(Way),
    /// The one target takes what is in the one slot that is read.
    Copy,
}

/// A pattern over slots: an equation, or what a method or a wish computes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Formula<S = Position> {
    pub(crate) pattern: PatternId,
    /// Its arguments, in order.
    pub(crate) slots: Box<[S]>,
}

impl Formula<SlotId> {
    /// States expressions whose variables are slots by number.
    pub(crate) fn of(patterns: &mut Patterns, arena: &Arena, roots: &[ExprId]) -> Self {
        let (pattern, variables) = patterns.intern(arena, roots);
        Self { pattern, slots: variables.into_iter().map(|v| SlotId(v.0)).collect() }
    }
    /// Computes the one expression that it is of.
    pub(crate) fn value(&self, patterns: &Patterns, numbers: &IdVec<SlotId, f64>) -> f64 {
        let pattern = patterns.get(self.pattern);
        if pattern.is_argument() {
            return numbers[self.slots[0]];
        }
        let arguments = self.slots.iter().map(|&s| numbers[s]);
        pattern.evaluate(arguments, &mut Scratch::default())[0]
    }
}

/// Up to this many slots one is found by looking at all.
const FEW: usize = 16;

/// Gives slots their positions, in the order in which they are met.
#[derive(Default)]
struct Numbering {
    slots: Vec<SlotId>,
    /// Of all slots, once they are many.
    position: BTreeMap<SlotId, Position>,
}

impl Numbering {
    fn of(slots: &[SlotId]) -> Self {
        let mut numbering = Self::default();
        slots.iter().for_each(|slot| {
            numbering.one(slot);
        });
        numbering
    }
    fn one(&mut self, slot: &SlotId) -> Position {
        let Self { slots, position } = self;
        let known = if slots.len() <= FEW {
            slots.iter().position(|s| s == slot).map(|at| at as Position)
        } else {
            position.get(slot).copied()
        };
        known.unwrap_or_else(|| {
            slots.push(*slot);
            if slots.len() == FEW + 1 {
                position.extend(slots.iter().copied().zip(0..));
            } else if slots.len() > FEW {
                position.insert(*slot, slots.len() as Position - 1);
            }
            slots.len() as Position - 1
        })
    }
    fn all(&mut self, slots: &[SlotId]) -> Vec<Position> {
        slots.iter().map(|s| self.one(s)).collect()
    }
    fn formula(&mut self, formula: &Formula<SlotId>) -> Formula {
        Formula { pattern: formula.pattern, slots: self.all(&formula.slots).into() }
    }
    fn when(&mut self, when: &When<SlotId>) -> When {
        let condition = match &when.condition {
            Condition::Numbers(formula) => Condition::Numbers(self.formula(formula)),
            Condition::Host(by) => {
                let reads = self.all(&by.reads);
                let ByHost { pattern, constraint, side, .. } = *by;
                Condition::Host(ByHost { pattern, constraint, side, reads })
            }
        };
        When { condition, truth: when.truth }
    }
}

impl Shape<SlotId> {
    /// Says the same of positions; returns the slots by position, each once.
    pub(crate) fn numbered(&self) -> (Shape, Vec<SlotId>) {
        let mut numbering = Numbering::default();
        let n = &mut numbering;
        let body = match &self.body {
            Body::Equations(equations) => {
                Body::Equations(equations.iter().map(|e| n.formula(e)).collect())
            }
            Body::True(formula) => Body::True(n.formula(formula)),
            Body::Beside(beside) => Body::Beside(Beside {
                truth: n.formula(&beside.truth),
                place: beside.place,
                side: beside.side,
                reads: n.all(&beside.reads),
            }),
            Body::Different(formula) => Body::Different(n.formula(formula)),
            Body::Opaque(slots) => Body::Opaque(n.all(slots)),
            Body::Hold(slots) => Body::Hold(n.all(slots)),
        };
        let method = |m: &RuleMethod<SlotId>| RuleMethod {
            targets: n.all(&m.targets),
            reads: n.all(&m.reads),
            how: match &m.how {
                How::Formulas(formula) => How::Formulas(n.formula(formula)),
                How::Host(way) => How::Host(*way),
                How::Copy => How::Copy,
            },
        };
        let methods = self.methods.iter().map(method).collect();
        let reads = n.all(&self.reads);
        let when = self.when.iter().map(|w| n.when(w)).collect();
        let Self { level, derived, within, .. } = *self;
        (Shape { level, body, methods, derived, reads, within, when }, numbering.slots)
    }
}

impl<S> Shape<S> {
    /// Returns its equations; what is none has none.
    pub(crate) fn equations(&self) -> impl Iterator<Item = &Formula<S>> {
        match &self.body {
            Body::Equations(equations) => equations.iter(),
            Body::True(_)
            | Body::Beside(_)
            | Body::Different(_)
            | Body::Opaque(_)
            | Body::Hold(_) => [].iter(),
        }
    }
}

/// A constraint or a declared stay, over the slots of the document.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rule<'r> {
    pub(crate) source: Source,
    pub(crate) shape: &'r Shape,
    /// Every slot that it mentions, by position, each once.
    pub(crate) slots: &'r [SlotId],
}

impl Rule<'_> {
    /// Returns the slots at these positions.
    pub(crate) fn slots_at(self, positions: &[Position]) -> impl Iterator<Item = SlotId> {
        positions.iter().map(move |&p| self.slots[p as usize])
    }
    /// Computes a formula of its shape.
    pub(crate) fn evaluate<'s>(
        self,
        formula: &Formula,
        patterns: &Patterns,
        numbers: &IdVec<SlotId, f64>,
        scratch: &'s mut Scratch,
    ) -> &'s [f64] {
        let arguments = self.slots_at(&formula.slots).map(|s| numbers[s]);
        patterns.get(formula.pattern).evaluate(arguments, scratch)
    }
}

/// All rules of a structure, in order of declaration: constraints, then stays.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rules {
    shapes: IdVec<ShapeId, Shape>,
    rules: Vec<(Source, ShapeId, Span)>,
    slots: Vec<SlotId>,
}

impl Rules {
    /// Makes room for so many rules of these shapes.
    pub(crate) fn over(shapes: IdVec<ShapeId, Shape>, count: usize) -> Self {
        Self { shapes, rules: Vec::with_capacity(count), slots: Vec::with_capacity(4 * count) }
    }
    pub(crate) fn shapes(&self) -> impl Iterator<Item = &Shape> {
        self.shapes.iter().map(|(_, shape)| shape)
    }
    pub(crate) fn into_shapes(self) -> IdVec<ShapeId, Shape> {
        self.shapes
    }
    /// Adds what a rule says. What the rule before it says as well, as those of a loop do, is one shape.
    pub(crate) fn add_shape(&mut self, shape: Shape) -> ShapeId {
        let last = self.shapes.iter().next_back().filter(|(_, known)| **known == shape);
        let known = last.map(|(id, _)| id);
        known.unwrap_or_else(|| self.shapes.push(shape))
    }
    pub(crate) fn add(
        &mut self,
        source: Source,
        shape: ShapeId,
        slots: impl IntoIterator<Item = SlotId>,
    ) {
        let start = self.slots.len() as u32;
        self.slots.extend(slots);
        let len = self.slots.len() as u32 - start;
        self.rules.push((source, shape, Span { start, len }));
    }
    /// Makes a rule hold under more conditions.
    pub(crate) fn guard(&mut self, index: u32, when: &[When<SlotId>]) {
        let rule = self.get(index);
        let (source, mut shape) = (rule.source, rule.shape.clone());
        let mut numbering = Numbering::of(rule.slots);
        shape.when.extend(when.iter().map(|w| numbering.when(w)));
        let shape = self.add_shape(shape);
        self.add(source, shape, numbering.slots);
        self.rules.swap_remove(index as usize);
    }
    pub(crate) fn len(&self) -> usize {
        self.rules.len()
    }
    pub(crate) fn get(&self, index: u32) -> Rule<'_> {
        let (source, shape, slots) = self.rules[index as usize];
        Rule { source, shape: &self.shapes[shape], slots: &self.slots[slots.range()] }
    }
    /// Returns the slots that every rule mentions.
    pub(crate) fn mentioned(&self) -> impl Iterator<Item = &[SlotId]> {
        self.rules.iter().map(|(_, _, span)| &self.slots[span.range()])
    }
    /// Returns the slots that a rule mentions.
    pub(crate) fn slots_of(&self, index: u32) -> &[SlotId] {
        &self.slots[self.rules[index as usize].2.range()]
    }
    pub(crate) fn iter(&self) -> impl Iterator<Item = Rule<'_>> {
        (0..self.rules.len() as u32).map(|i| self.get(i))
    }
    pub(crate) fn shape(&self, index: u32) -> ShapeId {
        self.rules[index as usize].1
    }
    pub(crate) fn source(&self, index: u32) -> Source {
        self.rules[index as usize].0
    }
}
