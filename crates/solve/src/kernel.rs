//! Kernels: an equation of numbered arguments, compiled once for all rows that say it of other slots.
//!
//! In: `left = right` over `Var(i)`, argument `i`. Out: tapes for its sides, its gradient, its second
//! derivatives and its solutions for each argument. A row is a kernel and the slots that are its
//! arguments: two thousand distances are one kernel.

use crate::system::SlotIndex;
use base::Id;
use expr::{Arena, Binary, Conic, ExprId, Guard, Node, Tape, Unary, Var, gradient};
use std::rc::Rc;
use std::sync::OnceLock;

/// From how many rows of a kernel on they are evaluated in lanes.
pub(crate) const WIDE: usize = 3;

/// An equation of numbered arguments, with everything derived from it.
pub(crate) struct Kernel {
    arena: Arena,
    left: ExprId,
    right: ExprId,
    /// The derivatives of `left - right` that are not zero everywhere, by argument.
    pub(crate) entries: Vec<Entry>,
    /// Both sides.
    pub(crate) sides: Rc<Tape>,
    /// Both sides, then the derivatives.
    pub(crate) slopes: Tape,
    derivatives: Vec<ExprId>,
    stated: OnceLock<Vec<(u32, Side)>>,
    second: OnceLock<Second>,
    solved: Vec<OnceLock<Option<Solved>>>,
}

/// A derivative that is not zero everywhere.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Entry {
    /// By which argument.
    pub(crate) argument: u32,
    /// The arguments that it depends on.
    pub(crate) depends: Vec<u32>,
    /// True if it can be zero by a choice: of a sign, of the larger, of a case.
    pub(crate) branches: bool,
}

/// Second derivatives that are not zero everywhere.
#[derive(Debug)]
pub(crate) struct Second {
    /// Both arguments, the first not after the second.
    pub(crate) entries: Vec<(u32, u32)>,
    /// Their values.
    pub(crate) tape: Tape,
}

/// The equation solved for one argument.
#[derive(Debug)]
pub(crate) struct Solved {
    /// Guards and value of each root, in order.
    pub(crate) tape: Tape,
    /// For each root, the kinds of its guards.
    pub(crate) guards: Vec<Vec<GuardKind>>,
}

/// What a guard demands of its value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum GuardKind {
    NonZero,
    NonNegative,
    Positive,
}

impl GuardKind {
    /// Returns true if a value is as demanded.
    pub(crate) fn admits(self, value: f64) -> bool {
        match self {
            Self::NonZero => value.abs() > 1e-30,
            Self::NonNegative => value >= 0.0,
            Self::Positive => value > 0.0,
        }
    }
}

/// A side of an equation.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Side {
    Left,
    Right,
}

impl Kernel {
    /// Returns true if the derivatives are the same everywhere.
    pub(crate) fn is_linear(&self) -> bool {
        self.entries.iter().all(|entry| entry.depends.is_empty())
    }
    /// Compiles an equation whose variables are `Var(0)` to `Var(arity - 1)`; `sides` are its own.
    pub(crate) fn compile(
        mut arena: Arena,
        left: ExprId,
        right: ExprId,
        arity: u32,
        sides: Rc<Tape>,
    ) -> Self {
        let residual = arena.sub(left, right);
        let vars = Reads::of(&arena, arity).variables(&arena, residual).0;
        let gradient = gradient(&mut arena, residual, &vars);
        let reads = Reads::of(&arena, arity);
        let (mut entries, mut derivatives) = (Vec::new(), Vec::new());
        for (var, d) in vars.iter().zip(gradient) {
            if arena.as_constant(d) != Some(0.0) {
                let (depends, branches) = reads.variables(&arena, d);
                let depends = depends.into_iter().map(|v| v.0).collect();
                entries.push(Entry { argument: var.0, depends, branches });
                derivatives.push(d);
            }
        }
        let mut outs = vec![left, right];
        outs.extend(&derivatives);
        let slopes = Tape::compile(&arena, &outs);
        let solved = (0..arity).map(|_| OnceLock::new()).collect();
        let (stated, second) = (OnceLock::new(), OnceLock::new());
        Self { arena, left, right, entries, sides, slopes, derivatives, stated, second, solved }
    }

    /// Compiles an equation of slots; returns the slots that are its arguments too.
    pub(crate) fn of_slots(from: &Arena, left: ExprId, right: ExprId) -> (Self, Vec<SlotIndex>) {
        let mut arena = Arena::new();
        let (left, right, arguments) = canonical(from, left, right, &mut arena);
        let sides = Rc::new(Tape::compile(&arena, &[left, right]));
        (Self::compile(arena, left, right, arguments.len() as u32, sides), arguments)
    }

    /// Derives all that is otherwise derived when it is first asked for.
    pub(crate) fn complete(&self) {
        self.second();
        self.stated().for_each(drop);
        for argument in 0..self.arity() as u32 {
            self.solved(argument);
        }
    }

    /// Returns both sides in another arena, every argument replaced.
    pub(crate) fn sides_over(
        &self,
        arena: &mut Arena,
        argument: &dyn Fn(usize) -> ExprId,
    ) -> (ExprId, ExprId) {
        let mut over = |id| arena.import(&self.arena, id, &mut |v: Var| argument(v.0 as usize));
        (over(self.left), over(self.right))
    }

    /// Returns what it says of two arguments where that is of the second degree in them, in another arena with
    /// other names.
    pub(crate) fn conic(
        &self,
        arguments: [Var; 2],
        arena: &mut Arena,
        name: &dyn Fn(Var) -> Var,
    ) -> Option<Conic> {
        expr::conic(&self.arena, [self.left, self.right], arguments, arena, name)
    }

    /// Computes how far its sides move apart where every argument moves by its own size.
    pub(crate) fn sway(
        &self,
        arguments: &[f64],
        registers: &mut Vec<f64>,
        out: &mut Vec<f64>,
    ) -> f64 {
        out.clear();
        out.resize(2 + self.entries.len(), 0.0);
        self.slopes.run(arguments, registers, out);
        let moves = self.entries.iter().zip(&out[2..]);
        moves.map(|(e, slope)| (arguments[e.argument as usize] * slope).abs()).sum()
    }

    /// Returns how many arguments it has.
    pub(crate) fn arity(&self) -> usize {
        self.solved.len()
    }

    /// Returns the second derivatives of `left - right`.
    pub(crate) fn second(&self) -> &Second {
        self.second.get_or_init(|| {
            let mut arena = self.arena.clone();
            let (mut entries, mut outs) = (Vec::new(), Vec::new());
            for (entry, &d) in self.entries.iter().zip(&self.derivatives) {
                let from = entry.argument;
                let vars: Vec<Var> =
                    entry.depends.iter().filter(|&&a| a >= from).map(|&a| Var(a)).collect();
                for (var, second) in vars.iter().zip(gradient(&mut arena, d, &vars)) {
                    if arena.as_constant(second) != Some(0.0) {
                        entries.push((from, var.0));
                        outs.push(second);
                    }
                }
            }
            Second { entries, tape: Tape::compile(&arena, &outs) }
        })
    }

    /// Returns the formulas for an argument, in terms of the others; none where there is no rule.
    pub(crate) fn solved(&self, argument: u32) -> Option<&Solved> {
        let solve = || {
            let mut arena = self.arena.clone();
            let roots = expr::isolate(&mut arena, self.left, self.right, Var(argument))?;
            let (mut outs, mut guards) = (Vec::new(), Vec::new());
            for root in &roots {
                let mut kinds = Vec::new();
                for guard in &root.guards {
                    outs.push(guard.subject());
                    kinds.push(match guard {
                        Guard::NonZero(_) => GuardKind::NonZero,
                        Guard::NonNegative(_) => GuardKind::NonNegative,
                        Guard::Positive(_) => GuardKind::Positive,
                    });
                }
                outs.push(root.value);
                guards.push(kinds);
            }
            (!roots.is_empty()).then(|| Solved { tape: Tape::compile(&arena, &outs), guards })
        };
        self.solved[argument as usize].get_or_init(solve).as_ref()
    }

    /// Returns the arguments that the equation states outright, each with its side: alone there, and
    /// not on the other.
    pub(crate) fn stated(&self) -> impl Iterator<Item = (u32, Side)> + '_ {
        let find = || {
            let sides = [(self.left, self.right, Side::Left), (self.right, self.left, Side::Right)];
            let stated = sides.map(|(side, other, name)| match self.arena.node(side) {
                Node::Var(var) if !self.arena.variables(other).contains(&var) => {
                    Some((var.0, name))
                }
                Node::Var(_)
                | Node::Constant(_)
                | Node::Unary(..)
                | Node::Binary(..)
                | Node::Select { .. } => None,
            });
            stated.into_iter().flatten().collect()
        };
        self.stated.get_or_init(find).iter().copied()
    }
}

impl std::fmt::Debug for Kernel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.sides)
    }
}

/// Copies an equation of slots with its variables numbered in their order; returns them.
fn canonical(
    from: &Arena,
    left: ExprId,
    right: ExprId,
    into: &mut Arena,
) -> (ExprId, ExprId, Vec<SlotIndex>) {
    let mut slots = from.variables(left);
    slots.append(&mut from.variables(right));
    let arguments: Vec<SlotIndex> = slots.iter().map(|v| v.0).collect();
    let vars: Vec<ExprId> = (0..arguments.len() as u32).map(|i| into.var(Var(i))).collect();
    let at = |v: Var| arguments.partition_point(|&a| a < v.0);
    let [left, right] = [left, right].map(|id| into.import(from, id, &mut |v| vars[at(v)]));
    (left, right, arguments)
}

/// What the nodes of an arena read, where its variables are few: of each the variables as bits, and
/// whether its value depends on a choice.
struct Reads(Vec<(u64, bool)>);

impl Reads {
    fn of(arena: &Arena, arity: u32) -> Self {
        if arity > u64::BITS {
            return Self(Vec::new());
        }
        let mut reads: Vec<(u64, bool)> = Vec::with_capacity(arena.len());
        for node in arena.nodes() {
            let mut own = (0, chooses(node));
            if let Node::Var(var) = node {
                own.0 = 1 << var.0;
            }
            node.each_operand(|operand| {
                let (variables, chooses) = reads[operand.index()];
                own = (own.0 | variables, own.1 | chooses);
            });
            reads.push(own);
        }
        Self(reads)
    }
    /// Returns the variables of an expression, in order, and true if its value depends on a choice.
    fn variables(&self, arena: &Arena, id: ExprId) -> (Vec<Var>, bool) {
        if let Some(&(mut variables, chooses)) = self.0.get(id.index()) {
            let mut vars = Vec::with_capacity(variables.count_ones() as usize);
            while variables != 0 {
                vars.push(Var(variables.trailing_zeros()));
                variables &= variables - 1;
            }
            return (vars, chooses);
        }
        let (mut vars, mut any) = (Vec::new(), false);
        arena.each_node(id, |node| {
            any |= chooses(node);
            if let Node::Var(var) = node {
                vars.push(var);
            }
        });
        vars.sort_unstable();
        (vars, any)
    }
}

/// Returns true if an operation is a choice: of a sign, of the larger, of a case.
fn chooses(node: Node) -> bool {
    match node {
        Node::Constant(_) | Node::Var(_) => false,
        Node::Unary(op, _) => {
            matches!(op, Unary::Abs | Unary::Sign | Unary::Floor | Unary::Round | Unary::Not)
        }
        Node::Binary(op, ..) => matches!(
            op,
            Binary::Min
                | Binary::Max
                | Binary::Less
                | Binary::LessEqual
                | Binary::Equal
                | Binary::NotEqual
        ),
        Node::Select { .. } => true,
    }
}
