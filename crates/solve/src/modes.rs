//! Modes: which inequalities act, which conditions are assumed, which alternatives are taken.
//!
//! In: a [`Conditional`] system. In every [`Mode`] it is a plain system, whose plan is a pure function
//! of it: values only choose the mode. An inequality says nothing while it holds; where the answer
//! would break it, it becomes an equation at its bound. A condition is assumed as the values have it,
//! tested after solving, and switched where it was wrong; where nothing holds so, or a wish is left
//! unmet, what is assumed is an inequality too and acts at its bound. Of alternatives the one that
//! held when the edit began is taken first.
//!
//! A strict inequality stops twice the tolerance of its relation short of the bound; `!=` is tested, never made to
//! hold.

mod bounds;
mod decide;
mod first;
mod nearest;
mod stands;

pub use decide::{
    Decision, Ended, MOST_MODES, Tried, decide, decide_along, decide_nearest_pieces, decide_pieces,
};

use crate::conditional::{Conditional, DemandKind, of_relation};
use crate::pattern::{Pattern, PatternId, Patterns, Scratch};
use crate::system::{Equation, Level, RelationBody, SlotIndex, Span, System};
use crate::truth::{Comparing, Comparison, Truth, truth};
use crate::whole::Constants;
use base::Id;
use base::number::{RULE_TOLERANCE, Tolerance};
use expr::{Arena, Binary, ExprId, Unary, Var, gradient};
use std::cell::RefCell;
use std::collections::BTreeSet;
use std::rc::Rc;

/// What is assumed of a conditional system: in it the system is plain.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub struct Mode {
    /// For every condition, whether it is taken to be true.
    pub assumed: Vec<bool>,
    /// For every choice, the index of the alternative.
    pub taken: Vec<u32>,
    /// The comparisons that act as equations, by index.
    pub active: BTreeSet<u32>,
    /// Which unknowns are constants.
    pub constants: Constants,
}

impl Mode {
    /// Returns true if the same is assumed and taken in another mode, whatever acts.
    fn assumes_as(&self, other: &Self) -> bool {
        self.assumed == other.assumed && self.taken == other.taken
    }
}

/// A conditional system, taken apart.
#[derive(Debug)]
pub struct Modes {
    conditional: Rc<Conditional>,
    wants: Vec<Want>,
    comparisons: Vec<Sides>,
    conditions: Vec<Formula>,
    /// What every condition says where it is false and where it is true, if numbers that are not whole decide
    /// it.
    bounds: Vec<Option<[Tree; 2]>>,
    /// For every choice, the relation that it is of and the number of its alternatives.
    choices: Vec<(u32, u32)>,
    scratch: RefCell<Scratch>,
}

/// What a relation wants, besides equations.
#[derive(Debug)]
struct Want {
    relation: u32,
    tree: Tree,
}

#[derive(Debug)]
enum Tree {
    Holds(u32),
    All(Vec<Tree>),
    Any {
        choice: u32,
        ways: Vec<Tree>,
    },
    /// In a condition: one at least, and it is not asked which.
    Either(Vec<Tree>),
}

/// A comparison over slots of the system.
#[derive(Debug)]
struct Sides {
    /// Which relation it is of: those of conditions count on from those of the system.
    relation: u32,
    comparing: Comparing,
    within: Tolerance,
    sides: Formula,
    /// What holds where it acts as an equation.
    bound: PatternId,
    /// Of which slots.
    arguments: Vec<SlotIndex>,
    /// Of a condition that holds at its bound: the comparison that acts a little short of it where rounding
    /// misses the bound.
    short: Option<u32>,
}

#[derive(Debug)]
struct Formula {
    pattern: Rc<Pattern>,
    arguments: Vec<SlotIndex>,
}

/// Something of a mode that a reader may want to know.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Standing {
    /// An inequality of this relation holds at its bound.
    AtBound {
        /// The relation's index.
        relation: u32,
    },
    /// Rules that are guarded by this condition hold, or those that are guarded by its opposite.
    Assumed {
        /// The first relation that it guards.
        relation: u32,
        /// Whether it is true.
        truth: bool,
    },
    /// An alternative is taken.
    Taken {
        /// The relation's index.
        relation: u32,
        /// Which one, counted from 0.
        way: u32,
        /// How many there are.
        of: u32,
    },
}

impl Modes {
    /// Takes a conditional system apart. Values play no part in it.
    pub fn new(conditional: impl Into<Rc<Conditional>>, patterns: &mut Patterns) -> Self {
        let made = Self::with(conditional.into(), Interning::Adding(patterns));
        made.expect("what is not there is added")
    }

    /// Takes a conditional system apart, if all that its demands say has been met.
    pub fn known(conditional: Conditional, patterns: &Patterns) -> Option<Self> {
        Self::with(Rc::new(conditional), Interning::Finding(patterns))
    }

    fn with(conditional: Rc<Conditional>, patterns: Interning<'_>) -> Option<Self> {
        let mut making = Making::new(patterns);
        let mut wants = Vec::new();
        let system = &conditional.system;
        for demand in &conditional.demands {
            let mut arena = Arena::new();
            let slots = system.arguments(demand.arguments);
            let roots = making.patterns.all().get(demand.pattern).write_out(&mut arena, slots);
            let truth = match demand.kind {
                DemandKind::True => truth(&mut arena, roots[0], true),
                DemandKind::Different => all_differ(&roots),
            };
            let relation = demand.relation;
            let within = system.relations[relation as usize].within;
            let tree = making.tree(&mut arena, relation, within, truth)?;
            wants.push(Want { relation, tree });
        }
        let conditions = conditional.conditions.iter().map(|c| Formula {
            pattern: making.patterns.all().get(c.pattern).clone(),
            arguments: system.arguments(c.arguments).to_vec(),
        });
        let conditions: Vec<Formula> = conditions.collect();
        making.is_of_condition = true;
        let relations = system.relations.len() as u32..;
        let bounds =
            relations.zip(&conditions).map(|(relation, c)| making.bounds(system, relation, c));
        let bounds = bounds.collect::<Option<_>>()?;
        let Making { comparisons, choices, .. } = making;
        let scratch = RefCell::default();
        Some(Self { conditional, wants, comparisons, conditions, bounds, choices, scratch })
    }

    /// Returns the mode before any value is known.
    pub fn blank(&self) -> Mode {
        Mode {
            assumed: vec![false; self.conditions.len()],
            taken: vec![0; self.choices.len()],
            active: BTreeSet::new(),
            constants: Constants::None,
        }
    }

    /// Returns true if nothing is assumed and nothing chosen: modes differ by which inequalities act.
    pub fn has_inequalities_alone(&self) -> bool {
        self.conditions.is_empty() && self.choices.is_empty()
    }

    /// Returns the system that was taken apart.
    pub fn conditional(&self) -> &Conditional {
        &self.conditional
    }

    /// Returns the plain system that the system is in a mode. Relations keep their index.
    pub fn system(&self, mode: &Mode) -> System {
        let whole = &self.conditional.system;
        let mut system = System {
            slots: whole.slots.clone(),
            relations: whole.relations.clone(),
            equations: Vec::with_capacity(whole.equations.len()),
            arguments: whole.arguments.clone(),
        };
        for slot in &mut system.slots {
            let is_whole = slot.is_number && slot.is_discrete;
            slot.stay = mode.constants.stay(slot.stay, is_whole);
        }
        for (index, relation) in (0..).zip(&whole.relations) {
            let plain = &mut system.relations[index as usize];
            if !self.counts(index, mode) {
                plain.body = RelationBody::Equations(Span::default());
                plain.methods.clear();
                continue;
            }
            if let RelationBody::Opaque { .. } = relation.body {
                continue;
            }
            let start = system.equations.len() as u32;
            system.equations.extend(whole.equations_of(relation));
            let mut acting = Vec::new();
            for want in of_relation(&self.wants, index, |w| w.relation) {
                self.acting(&want.tree, mode, &mut acting);
            }
            for &c in &acting {
                let sides = &self.comparisons[c as usize];
                let arguments = system.add_arguments(sides.arguments.iter().copied());
                system.equations.push(Equation { pattern: sides.bound, arguments });
            }
            let len = system.equations.len() as u32 - start;
            system.relations[index as usize].body = RelationBody::Equations(Span { start, len });
        }
        self.add_bounds(mode, &mut system);
        system
    }

    /// Says what is assumed in a mode, in order of declaration.
    pub fn standings(&self, mode: &Mode) -> Vec<Standing> {
        let mut all = Vec::new();
        for (condition, &truth) in (0..).zip(&mode.assumed) {
            let mut guards = self.conditional.guards.iter();
            if let Some(guard) = guards.find(|g| g.condition == condition) {
                all.push(Standing::Assumed { relation: guard.relation, truth });
            }
        }
        for want in self.wants_in(mode) {
            let mut acting = Vec::new();
            self.acting(&want.tree, mode, &mut acting);
            let mut choices = BTreeSet::new();
            choices_of(&want.tree, &mut choices);
            for &choice in choices.iter().filter(|_| !acting.is_empty()) {
                let (relation, of) = self.choices[choice as usize];
                all.push(Standing::Taken { relation, way: mode.taken[choice as usize], of });
            }
            if acting.iter().any(|c| mode.active.contains(c)) {
                all.push(Standing::AtBound { relation: want.relation });
            }
        }
        all
    }

    /// Returns the modes in which one alternative is taken otherwise, no inequality acting, each with what
    /// is taken then; in order of declaration.
    pub fn other_ways(&self, mode: &Mode) -> Vec<(Mode, Standing)> {
        let mut others = Vec::new();
        for want in self.wants_in(mode) {
            let mut choices = BTreeSet::new();
            choices_of(&want.tree, &mut choices);
            for choice in choices {
                let (relation, of) = self.choices[choice as usize];
                let taken = mode.taken[choice as usize];
                for way in (0..of).filter(|&way| way != taken) {
                    let mut other = Mode { active: BTreeSet::new(), ..mode.clone() };
                    other.taken[choice as usize] = way;
                    others.push((other, Standing::Taken { relation, way, of }));
                }
            }
        }
        others
    }

    /// The demands of relations whose guards are as assumed.
    fn wants_in<'m>(&'m self, mode: &'m Mode) -> impl Iterator<Item = &'m Want> {
        self.wants.iter().filter(|w| self.counts(w.relation, mode))
    }

    /// Returns true for a relation whose guards are as assumed.
    fn counts(&self, relation: u32, mode: &Mode) -> bool {
        let mut guards = self.conditional.guards_of(relation).iter();
        guards.all(|g| mode.assumed[g.condition as usize] == g.truth)
    }

    /// Collects the comparisons that are equations in a mode.
    fn acting(&self, tree: &Tree, mode: &Mode, acting: &mut Vec<u32>) {
        match tree {
            Tree::Holds(c) => {
                let sides = &self.comparisons[*c as usize];
                let acts = match sides.comparing {
                    Comparing::Equal => true,
                    Comparing::AtMost | Comparing::Less => mode.active.contains(c),
                    Comparing::Differ => false,
                };
                match sides.short.filter(|short| mode.active.contains(short)) {
                    Some(short) => acting.push(short),
                    None if acts => acting.push(*c),
                    None => {}
                }
            }
            Tree::All(parts) | Tree::Either(parts) => {
                parts.iter().for_each(|p| self.acting(p, mode, acting));
            }
            Tree::Any { choice, ways } => {
                if let Some(way) = ways.get(mode.taken[*choice as usize] as usize) {
                    self.acting(way, mode, acting);
                }
            }
        }
    }

    fn tree_holds(&self, tree: &Tree, values: &[f64]) -> bool {
        match tree {
            Tree::Holds(c) => self.comparison_holds(*c, values),
            Tree::All(parts) => parts.iter().all(|p| self.tree_holds(p, values)),
            Tree::Any { ways, .. } | Tree::Either(ways) => {
                ways.iter().any(|w| self.tree_holds(w, values))
            }
        }
    }

    fn comparison_holds(&self, index: u32, values: &[f64]) -> bool {
        let sides = &self.comparisons[index as usize];
        let mut scratch = self.scratch.borrow_mut();
        let both = sides.sides.evaluate(values, &mut scratch);
        let (left, right) = (both[0], both[1]);
        let formula = &sides.sides;
        holds_within(sides.comparing, left, right, sides.within, || {
            let arguments = formula.arguments.iter().map(|&s| values[s as usize]);
            formula.pattern.sway(arguments, &mut scratch)
        })
    }

    fn is_true(&self, condition: usize, values: &[f64]) -> bool {
        let mut scratch = self.scratch.borrow_mut();
        self.conditions[condition].evaluate(values, &mut scratch)[0] != 0.0
    }

    /// Returns true if a condition could be called true as well as false: it is at its bound.
    fn is_on_edge(&self, condition: usize, values: &[f64]) -> bool {
        let formula = &self.conditions[condition];
        let arguments: Vec<f64> = formula.arguments.iter().map(|&s| values[s as usize]).collect();
        let mut arena = formula.pattern.arena().clone();
        let root = formula.pattern.roots()[0];
        let mut nearly = |wanted| {
            let truth = truth(&mut arena, root, wanted);
            holds_nearly(&arena, &truth, &arguments)
        };
        nearly(true) && nearly(false)
    }

    fn is_required(&self, relation: u32) -> bool {
        self.conditional.system.relations[relation as usize].level == Level::Required
    }
}

impl Sides {
    /// Returns by how much the left side is more than where it acts.
    fn excess(&self, values: &[f64], scratch: &mut Scratch) -> f64 {
        let both = self.sides.evaluate(values, scratch);
        let short = match self.comparing {
            Comparing::Less => 2.0 * RULE_TOLERANCE * both[1].abs().max(1.0),
            Comparing::Equal | Comparing::AtMost | Comparing::Differ => 0.0,
        };
        both[0] - both[1] + short
    }
}

impl Formula {
    fn evaluate<'s>(&self, values: &[f64], scratch: &'s mut Scratch) -> &'s [f64] {
        self.pattern.evaluate(self.arguments.iter().map(|&s| values[s as usize]), scratch)
    }
}

/// Compares two sides of a rule: equal, at most and different to a tolerance, less exactly.
fn holds_within(
    comparing: Comparing,
    left: f64,
    right: f64,
    within: Tolerance,
    sway: impl FnOnce() -> f64,
) -> bool {
    match comparing {
        Comparing::Equal => within.is_met_with(left, right, sway),
        Comparing::AtMost => left <= right || within.is_met_with(left, right, sway),
        Comparing::Less => left < right,
        Comparing::Differ => !within.is_met(left, right) && !left.is_nan() && !right.is_nan(),
    }
}

/// Tests the truth that an expression is, comparison by comparison, each to a tolerance.
pub fn is_true_within(arena: &Arena, id: ExprId, values: &[f64], within: Tolerance) -> bool {
    let mut arena = arena.clone();
    let truth = truth(&mut arena, id, true);
    all_hold(&truth, &|c| {
        let (l, r) = (arena.evaluate(c.left, values), arena.evaluate(c.right, values));
        holds_within(c.comparing, l, r, within, || sway(&arena, c, values))
    })
}

fn holds_nearly(arena: &Arena, truth: &Truth, values: &[f64]) -> bool {
    all_hold(truth, &|c| {
        let (l, r) = (arena.evaluate(c.left, values), arena.evaluate(c.right, values));
        c.comparing.holds(l, r) || Tolerance::Relative.is_met(l, r)
    })
}

/// Computes the sway of a comparison.
fn sway(arena: &Arena, c: &Comparison, values: &[f64]) -> f64 {
    let mut arena = arena.clone();
    let difference = arena.sub(c.left, c.right);
    let vars: Vec<Var> = arena.variables(difference).into_iter().collect();
    let slopes = gradient(&mut arena, difference, &vars);
    let moves = vars.iter().zip(slopes);
    moves.map(|(v, slope)| (values[v.index()] * arena.evaluate(slope, values)).abs()).sum()
}

fn all_hold(truth: &Truth, holds: &dyn Fn(&Comparison) -> bool) -> bool {
    match truth {
        Truth::Holds(c) => holds(c),
        Truth::All(parts) => parts.iter().all(|p| all_hold(p, holds)),
        Truth::Any(parts) => parts.iter().any(|p| all_hold(p, holds)),
    }
}

fn all_differ(expressions: &[ExprId]) -> Truth {
    let mut pairs = Vec::new();
    for (i, &left) in expressions.iter().enumerate() {
        for &right in &expressions[i + 1..] {
            pairs.push(Truth::Holds(Comparison { comparing: Comparing::Differ, left, right }));
        }
    }
    Truth::All(pairs)
}

fn choices_of(tree: &Tree, choices: &mut BTreeSet<u32>) {
    match tree {
        Tree::Holds(_) | Tree::Either(_) => {}
        Tree::All(parts) => parts.iter().for_each(|p| choices_of(p, choices)),
        Tree::Any { choice, ways } => {
            choices.insert(*choice);
            ways.iter().for_each(|w| choices_of(w, choices));
        }
    }
}

/// Adds the patterns of the comparisons that a Bool expression asks for.
pub(crate) fn add(patterns: &mut Patterns, pattern: PatternId) {
    let mut arena = patterns.get(pattern).arena().clone();
    let truth = truth(&mut arena, patterns.get(pattern).roots()[0], true);
    let patterns = Interning::Adding(patterns);
    let mut making = Making::new(patterns);
    making.tree(&mut arena, 0, Tolerance::Relative, truth);
}

/// How patterns are come by.
enum Interning<'p> {
    Adding(&'p mut Patterns),
    /// None is added.
    Finding(&'p Patterns),
}

impl Interning<'_> {
    fn all(&self) -> &Patterns {
        match self {
            Self::Adding(patterns) => patterns,
            Self::Finding(patterns) => patterns,
        }
    }
    fn intern(&mut self, arena: &Arena, roots: &[ExprId]) -> Option<(PatternId, Vec<Var>)> {
        match self {
            Self::Adding(patterns) => Some(patterns.intern(arena, roots)),
            Self::Finding(patterns) => patterns.find(arena, roots),
        }
    }
}

struct Making<'p> {
    patterns: Interning<'p>,
    comparisons: Vec<Sides>,
    choices: Vec<(u32, u32)>,
    /// True while what is made is of a condition: it is compared exactly, and nothing is chosen.
    is_of_condition: bool,
}

impl<'p> Making<'p> {
    fn new(patterns: Interning<'p>) -> Self {
        Self { patterns, comparisons: Vec::new(), choices: Vec::new(), is_of_condition: false }
    }

    /// Returns nothing where a pattern is to be found that is not there.
    fn tree(
        &mut self,
        arena: &mut Arena,
        relation: u32,
        within: Tolerance,
        truth: Truth,
    ) -> Option<Tree> {
        Some(match truth {
            Truth::Holds(c) => Tree::Holds(self.comparison(arena, relation, within, c)?),
            Truth::All(parts) => {
                let parts = parts.into_iter().map(|p| self.tree(arena, relation, within, p));
                Tree::All(parts.collect::<Option<_>>()?)
            }
            Truth::Any(parts) if self.is_of_condition => {
                let parts = parts.into_iter().map(|p| self.tree(arena, relation, within, p));
                Tree::Either(parts.collect::<Option<_>>()?)
            }
            Truth::Any(parts) => {
                let choice = self.choices.len() as u32;
                self.choices.push((relation, parts.len() as u32));
                let ways = parts.into_iter().map(|p| self.tree(arena, relation, within, p));
                Tree::Any { choice, ways: ways.collect::<Option<_>>()? }
            }
        })
    }

    fn comparison(
        &mut self,
        arena: &mut Arena,
        relation: u32,
        within: Tolerance,
        c: Comparison,
    ) -> Option<u32> {
        let (pattern, variables) = self.patterns.intern(arena, &[c.left, c.right])?;
        let sides = Formula {
            pattern: self.patterns.all().get(pattern).clone(),
            arguments: variables.into_iter().map(|v| v.0).collect(),
        };
        let right = match c.comparing {
            Comparing::Less => short_of(arena, c.right, 2.0 * RULE_TOLERANCE),
            Comparing::Equal | Comparing::AtMost | Comparing::Differ => c.right,
        };
        let (bound, variables) = self.patterns.intern(arena, &[c.left, right])?;
        let arguments = variables.into_iter().map(|v| v.0).collect();
        let comparing = c.comparing;
        let short = match comparing {
            Comparing::AtMost if self.is_of_condition => {
                let less = Comparison { comparing: Comparing::Less, ..c };
                Some(self.comparison(arena, relation, within, less)?)
            }
            Comparing::Equal | Comparing::AtMost | Comparing::Less | Comparing::Differ => None,
        };
        let made = Sides { relation, comparing, within, sides, bound, arguments, short };
        self.comparisons.push(made);
        Some(self.comparisons.len() as u32 - 1)
    }
}

/// Returns what is just less than a bound: by a part of it, and of the unit at least.
fn short_of(arena: &mut Arena, bound: ExprId, part: f64) -> ExprId {
    let (one, part) = (arena.constant(1.0), arena.constant(part));
    let size = arena.unary(Unary::Abs, bound);
    let size = arena.binary(Binary::Max, size, one);
    let margin = arena.mul(part, size);
    arena.sub(bound, margin)
}
