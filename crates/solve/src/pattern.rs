//! Patterns: what rows say, each stored once.
//!
//! A pattern is a few expressions over arguments, `Var(i)` being argument `i`: the two sides of an
//! equation, or the values that a method gives to its targets. A row is a pattern and the slots that
//! it speaks of: two thousand distances are one pattern with two thousand lists of arguments.
//! Whatever can be known of a row without its slots is worked out once, for the pattern.

use crate::kernel::Kernel;
use crate::pieces;
use crate::system::{SlotIndex, System};
use base::{Id, Mixer, define_id};
use expr::{Arena, Binary, Excerpt, ExprId, Node, Tape, Unary, Var};
use indexmap::IndexSet;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::hash::{BuildHasherDefault, Hash, Hasher};
use std::rc::Rc;

define_id!(PatternId, "p", "A pattern, by its place among those of one planner.");

/// Up to this many arguments a pattern is compiled as what it says of any two.
const CURVED: usize = 10;

/// Expressions over arguments.
#[derive(Debug)]
pub struct Pattern {
    excerpt: Excerpt,
    arena: OnceCell<Box<Arena>>,
    arity: u32,
    plain: Option<Plain>,
    has_pieces: bool,
    has_angles: bool,
    may_hide: bool,
    values: OnceCell<Rc<Tape>>,
    kernel: OnceCell<Rc<Kernel>>,
    /// Few patterns have some.
    identified: RefCell<Option<Box<ByArguments>>>,
}

/// By which arguments are one.
type ByArguments = BTreeMap<Box<[u32]>, Identified>;

/// Returns true if an operation takes or gives an angle.
fn speaks_of_angles(node: Node) -> bool {
    match node {
        Node::Unary(op, _) => {
            let (from, to) =
                ([Unary::Sin, Unary::Cos, Unary::Tan], [Unary::Asin, Unary::Acos, Unary::Atan]);
            from.contains(&op) || to.contains(&op)
        }
        Node::Binary(op, ..) => op == Binary::Atan2,
        Node::Select { .. } | Node::Constant(_) | Node::Var(_) => false,
    }
}

/// What a pattern says that says next to nothing.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Plain {
    /// Its two arguments are equal.
    Same,
    /// Its argument is a number, given by its bits.
    Number(u64),
}

/// A pattern with some of its arguments made one; which of the old ones the new ones are.
pub(crate) type Identified = (Rc<Pattern>, Rc<[u32]>);

impl Pattern {
    fn new(excerpt: Excerpt) -> Self {
        let arity = excerpt.nodes.iter().filter(|n| matches!(n, Node::Var(_))).count();
        let plain = plain(&excerpt);
        let has_pieces = excerpt.nodes.iter().any(|&node| pieces::has_pieces(node));
        let has_angles = excerpt.nodes.iter().any(|&node| speaks_of_angles(node));
        let may_hide = may_hide(&excerpt);
        Self {
            excerpt,
            arena: OnceCell::new(),
            arity: arity as u32,
            plain,
            has_pieces,
            has_angles,
            may_hide,
            values: OnceCell::new(),
            kernel: OnceCell::new(),
            identified: RefCell::default(),
        }
    }
    /// Returns its expressions, in an arena that holds nothing else.
    pub fn arena(&self) -> &Arena {
        self.arena.get_or_init(|| Box::new(Arena::of_excerpt(&self.excerpt)))
    }
    /// Returns its expressions: of an equation, the left and the right side.
    pub fn roots(&self) -> &[ExprId] {
        &self.excerpt.roots
    }
    /// Returns the number of arguments; each occurs in it.
    pub fn arity(&self) -> usize {
        self.arity as usize
    }
    /// Writes its expressions out over slots.
    pub(crate) fn write_out(&self, arena: &mut Arena, arguments: &[SlotIndex]) -> Vec<ExprId> {
        let mut made: Vec<ExprId> = Vec::with_capacity(self.excerpt.nodes.len());
        for &node in &self.excerpt.nodes {
            let at = |id: ExprId| made[id.index()];
            let id = match node {
                Node::Constant(bits) => arena.constant(f64::from_bits(bits)),
                Node::Var(v) => arena.var(Var(arguments[v.index()])),
                Node::Unary(op, a) => arena.unary(op, at(a)),
                Node::Binary(op, a, b) => arena.binary(op, at(a), at(b)),
                Node::Select { condition, then, otherwise } => {
                    arena.select(at(condition), at(then), at(otherwise))
                }
            };
            made.push(id);
        }
        self.roots().iter().map(|r| made[r.index()]).collect()
    }
    /// Returns true if it is one expression, and that is its argument.
    pub fn is_argument(&self) -> bool {
        self.roots().len() == 1 && matches!(self.excerpt.nodes[..], [Node::Var(_)])
    }
    /// Computes its expressions; the arguments are gathered by `argument`.
    pub fn evaluate<'s>(
        &self,
        arguments: impl IntoIterator<Item = f64>,
        scratch: &'s mut Scratch,
    ) -> &'s [f64] {
        scratch.run(self.values(), arguments.into_iter(), self.roots().len())
    }
    /// Compiles what an equation and its derivatives come to, and its solutions for every argument,
    /// so that no plan has to; of few arguments, also what it says of any two.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub fn compile(&self) {
        self.kernel().complete();
        if self.arity() <= CURVED {
            self.kernel().complete_curves();
        }
    }
    /// Compiles the same where some arguments are one: of each it is told which is the first that it is.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub fn compile_where(&self, first: &[u32]) {
        if self.known_identified(first).is_none() {
            self.identified(first).0.compile();
        }
    }
    /// Returns true if all that it says is that its two arguments are equal.
    pub fn is_equality(&self) -> bool {
        self.plain == Some(Plain::Same)
    }
    /// Returns true if the derivatives of an equation are the same everywhere.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub fn is_linear(&self) -> bool {
        self.kernel().is_linear()
    }
    /// Returns the arguments that an equation depends on, each with whether its derivative by it is the
    /// same everywhere, and so never zero.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub fn dependence(&self) -> impl Iterator<Item = (usize, bool)> + '_ {
        let entries = self.kernel().entries.iter();
        entries.map(|entry| (entry.argument as usize, entry.depends.is_empty()))
    }
    /// Computes the derivatives of an equation's `left - right`, each with its argument; those that
    /// are zero everywhere are left out.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub fn slopes<'s>(
        &'s self,
        arguments: impl IntoIterator<Item = f64>,
        scratch: &'s mut Scratch,
    ) -> impl Iterator<Item = (usize, f64)> + 's {
        let kernel = self.kernel();
        // both sides come first
        let out = scratch.run(&kernel.slopes, arguments.into_iter(), 2 + kernel.entries.len());
        let arguments = kernel.entries.iter().map(|entry| entry.argument as usize);
        arguments.zip(out[2..].iter().copied())
    }
    /// Computes the sway of an equation, as [`base::number::Tolerance`] asks for it.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub fn sway(&self, arguments: impl IntoIterator<Item = f64>, scratch: &mut Scratch) -> f64 {
        scratch.arguments.clear();
        scratch.arguments.extend(arguments);
        self.kernel().sway(&scratch.arguments, &mut scratch.registers, &mut scratch.out)
    }
    /// Returns true if what it says is another expression here than there.
    pub(crate) fn has_pieces(&self) -> bool {
        self.has_pieces
    }
    /// Returns true if some of the numbers that it speaks of are angles.
    pub(crate) fn has_angles(&self) -> bool {
        self.has_angles
    }
    /// Returns false where an operation in it has no value with these arguments, and what is made of that has one: `exp(-1 / x)`
    /// is 0 where `x` is.
    pub fn has_value(&self, arguments: impl IntoIterator<Item = f64>) -> bool {
        if !self.may_hide {
            return true;
        }
        let arguments: Vec<f64> = arguments.into_iter().collect();
        self.roots().iter().all(|&root| self.arena().has_value(root, &arguments))
    }
    /// Returns what it says if that is next to nothing.
    pub(crate) fn plain(&self) -> Option<Plain> {
        self.plain
    }
    /// Returns the tape of its expressions.
    pub(crate) fn values(&self) -> &Rc<Tape> {
        self.values.get_or_init(|| Rc::new(Tape::compile(self.arena(), self.roots())))
    }
    /// Returns what is derived from it, if it is an equation's.
    ///
    /// # Panics
    /// If it has not two expressions.
    pub(crate) fn kernel(&self) -> &Rc<Kernel> {
        self.kernel.get_or_init(|| {
            let [left, right] = self.roots() else { panic!("an equation has two sides") };
            let sides = self.values().clone();
            let arena = Arena::to_derive(&self.excerpt);
            Rc::new(Kernel::compile(arena, *left, *right, self.arity, sides))
        })
    }
    fn known_identified(&self, which: &[u32]) -> Option<Identified> {
        self.identified.borrow().as_ref()?.get(which).cloned()
    }
    /// Returns the pattern with every argument replaced by one before it, or itself.
    pub(crate) fn identified(&self, which: &[u32]) -> Identified {
        if let Some(known) = self.known_identified(which) {
            return known;
        }
        let mut arena = Arena::for_nodes(self.excerpt.nodes.len());
        let roots = self.write_out(&mut arena, which);
        let (excerpt, left) = arena.excerpt(&roots);
        let left = left.into_iter().map(|v| v.0).collect();
        let made = (Rc::new(Self::new(excerpt)), left);
        let mut identified = self.identified.borrow_mut();
        identified.get_or_insert_default().insert(which.into(), made.clone());
        made
    }
}

/// Returns true if an operation that may have no value stands within one whose result does not show it.
fn may_hide(excerpt: &Excerpt) -> bool {
    let mut may_lack: Vec<bool> = Vec::with_capacity(excerpt.nodes.len());
    let mut is_hidden = false;
    for &node in &excerpt.nodes {
        let mut within = false;
        node.each_operand(|operand| within |= may_lack[operand.index()]);
        let (lacks, hides) = match node {
            Node::Binary(op, ..) => match op {
                Binary::Div | Binary::Pow => (true, true),
                Binary::Add | Binary::Sub | Binary::Mul => (false, false),
                _ => (false, true),
            },
            Node::Unary(op, _) => {
                use Unary::{Atan, Atanh, Exp, Ln, Log2, Log10, Sign, Tanh};
                let lacks = matches!(op, Ln | Log10 | Log2 | Atanh);
                (lacks, matches!(op, Exp | Atan | Tanh | Sign | Unary::Not))
            }
            Node::Select { .. } => (false, true),
            Node::Constant(_) | Node::Var(_) => (false, false),
        };
        is_hidden |= within && hides;
        may_lack.push(within || lacks);
    }
    is_hidden
}

fn plain(excerpt: &Excerpt) -> Option<Plain> {
    let &[left, right] = &excerpt.roots[..] else { return None };
    match (excerpt.nodes[left.index()], excerpt.nodes[right.index()]) {
        (Node::Var(a), Node::Var(b)) if a != b => Some(Plain::Same),
        (Node::Var(_), Node::Constant(bits)) | (Node::Constant(bits), Node::Var(_)) => {
            f64::from_bits(bits).is_finite().then_some(Plain::Number(bits))
        }
        _ => None,
    }
}

/// Working space for evaluating patterns, of any content.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    arguments: Vec<f64>,
    registers: Vec<f64>,
    out: Vec<f64>,
}

impl Scratch {
    /// Runs a tape of so many outputs; the outputs are what is returned.
    pub(crate) fn run(
        &mut self,
        tape: &Tape,
        arguments: impl Iterator<Item = f64>,
        outs: usize,
    ) -> &[f64] {
        self.arguments.clear();
        self.arguments.extend(arguments);
        self.out.clear();
        self.out.resize(outs, 0.0);
        tape.run(&self.arguments, &mut self.registers, &mut self.out);
        &self.out
    }
}

/// A pattern under which it is found again.
#[derive(Debug)]
struct Interned(Rc<Pattern>);

impl PartialEq for Interned {
    fn eq(&self, other: &Self) -> bool {
        self.0.excerpt == other.0.excerpt
    }
}
impl Eq for Interned {}
impl Hash for Interned {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.excerpt.hash(state);
    }
}
impl indexmap::Equivalent<Interned> for Excerpt {
    fn equivalent(&self, key: &Interned) -> bool {
        *self == key.0.excerpt
    }
}

/// Every pattern that was met, each stored once.
#[derive(Debug)]
pub struct Patterns {
    all: IndexSet<Interned, BuildHasherDefault<Mixer>>,
    /// Equations that have pieces, and of which it is not known yet what they are taken apart.
    whole: Vec<PatternId>,
}

impl Default for Patterns {
    fn default() -> Self {
        let mut patterns = Self { all: IndexSet::default(), whole: Vec::new() };
        let mut arena = Arena::for_nodes(2);
        let (a, b) = (arena.var(Var(0)), arena.var(Var(1)));
        patterns.intern(&arena, &[a, b]);
        let mut arena = Arena::new();
        let [x1, y1, x2, y2, length] = [0, 1, 2, 3, 4].map(|v| arena.var(Var(v)));
        let [across, up] = [(x2, x1), (y2, y1)].map(|(to, from)| {
            let way = arena.sub(to, from);
            arena.mul(way, way)
        });
        let square = arena.add(across, up);
        let apart = arena.sqrt(square);
        patterns.intern(&arena, &[apart, length]);
        patterns
    }
}

impl Patterns {
    /// The pattern that says that two arguments are equal.
    pub const SAME: PatternId = PatternId(0);
    /// The pattern that says how far two places, each of two coordinates, are apart.
    pub const APART: PatternId = PatternId(1);

    /// Finds or adds the pattern of these expressions; returns it and the variables that are its
    /// arguments.
    pub fn intern(&mut self, arena: &Arena, roots: &[ExprId]) -> (PatternId, Vec<Var>) {
        let (excerpt, variables) = arena.excerpt(roots);
        let index = match self.all.get_index_of(&excerpt) {
            Some(index) => index,
            None => {
                let pattern = Pattern::new(excerpt);
                if pattern.has_pieces && pattern.roots().len() == 2 {
                    self.whole.push(PatternId::from_index(self.all.len()));
                }
                self.all.insert_full(Interned(Rc::new(pattern))).0
            }
        };
        (PatternId::from_index(index), variables)
    }
    /// Returns the pattern that says that the one expression of a pattern equals one more argument.
    ///
    /// # Panics
    /// If the pattern has no expression.
    pub fn wanting(&mut self, pattern: PatternId) -> PatternId {
        let pattern = self.get(pattern).clone();
        let mut arena = pattern.arena().clone();
        let wanted = arena.var(Var::from_index(pattern.arity()));
        self.intern(&arena, &[pattern.roots()[0], wanted]).0
    }
    /// Returns a pattern.
    ///
    /// # Panics
    /// If the id is not from here.
    pub fn get(&self, id: PatternId) -> &Rc<Pattern> {
        &self.all[id.index()].0
    }
    /// Finds the pattern of these expressions, if there is one; returns it and the variables that are its
    /// arguments.
    pub(crate) fn find(&self, arena: &Arena, roots: &[ExprId]) -> Option<(PatternId, Vec<Var>)> {
        let (excerpt, variables) = arena.excerpt(roots);
        let index = self.all.get_index_of(&excerpt)?;
        Some((PatternId::from_index(index), variables))
    }
    /// Adds the patterns of what the equations of a system with an `if` are taken apart into, so that
    /// [`crate::pieces::taken_apart`] finds them; of so many that it would take none apart, nothing.
    pub fn take_apart(&mut self, system: &System) {
        if self.whole.is_empty() {
            return;
        }
        let patterns = system.equations.iter().map(|e| e.pattern);
        let own: Vec<PatternId> = patterns.filter(|&p| self.get(p).has_pieces).collect();
        if own.len() > pieces::MOST_EQUATIONS {
            return;
        }
        let own: BTreeSet<PatternId> = own.into_iter().collect();
        let (now, later) = self.whole.iter().copied().partition::<Vec<_>, _>(|p| own.contains(p));
        now.into_iter().for_each(|pattern| pieces::add(self, pattern));
        // their own parts are not taken apart
        self.whole = later;
    }
    /// Returns how many patterns there are.
    pub fn len(&self) -> usize {
        self.all.len()
    }
    /// Returns true if there is no pattern.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_differ_in_their_slots_alone_have_one_pattern() {
        let mut patterns = Patterns::default();
        let mut one = |slots: [u32; 3]| {
            let mut arena = Arena::new();
            let [a, b, c] = slots.map(|s| arena.var(Var(s)));
            let product = arena.mul(a, b);
            patterns.intern(&arena, &[product, c])
        };
        let (p, first) = one([5, 9, 2]);
        let (q, second) = one([4, 0, 7]);
        assert_eq!(p, q);
        assert_eq!((first, second), ([5, 9, 2].map(Var).to_vec(), [4, 0, 7].map(Var).to_vec()));
        assert_ne!(one([1, 1, 7]).0, p, "a square is not a product of two");
        let mut scratch = Scratch::default();
        assert_eq!(patterns.get(p).evaluate([3.0, 4.0, 12.5], &mut scratch), [12.0, 12.5]);
    }
}
