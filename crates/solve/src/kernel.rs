//! Kernels: an equation of numbered arguments, compiled once for all rows that say it of other slots.
//!
//! In: `left = right` over `Var(i)`, argument `i`. Out: tapes for its sides, its gradient, its second
//! derivatives and its solutions for each argument. A row is a kernel and the slots that are its
//! arguments: two thousand distances are one kernel.

pub(crate) mod exact;

use crate::few::Few;
use crate::rows::{Point, generic_number};
use crate::system::SlotIndex;
use base::Id;
use expr::{Arena, Binary, Conic, ExprId, Guard, Node, Tape, Unary, Var, gradient, varying};
use std::rc::Rc;
use std::sync::OnceLock;

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
    shown: OnceLock<Vec<u32>>,
    stated: OnceLock<Vec<(u32, Side)>>,
    second: OnceLock<Second>,
    divisors: OnceLock<Option<Divisors>>,
    solved: Vec<OnceLock<Option<Solved>>>,
    /// What it says of two arguments, or of one and none, the pairs in order.
    curves: Vec<OnceLock<Option<Box<Curve>>>>,
}

/// What an equation says of two of its arguments, where that is of the second degree.
#[derive(Debug)]
pub(crate) struct Curve {
    /// The coefficients of a conic around a state, then its guards.
    pub(crate) tape: Tape,
    /// How many guards there are: what is not negative where the equation holds.
    pub(crate) guards: usize,
    /// True if some of them depend on the two arguments.
    pub(crate) guards_move: bool,
    pub(crate) form: Form,
    /// Where it is a circle, by arguments.
    pub(crate) round: Option<Round>,
}

/// A circle through the place of two arguments, and nothing else: their distance from a centre is a radius.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Round {
    pub(crate) center: [u32; 2],
    pub(crate) radius: u32,
    /// True if the radius may not be negative.
    pub(crate) is_length: bool,
}

impl Round {
    /// Finds the arguments of a circle by what its coefficients are at generic points.
    fn of(tape: &Tape, [first, second]: [u32; 2], arity: usize) -> Option<Self> {
        let (mut registers, mut out) = (Vec::new(), Vec::new());
        let places: Vec<u32> = (0..arity as u32).collect();
        let mut at = |seed: u64| {
            let number = |i: u64| generic_number(seed << 32 | i, Point::Positive);
            let own: Vec<f64> = (0..arity as u64).map(number).collect();
            tape.run_at(&places, &own, &mut registers, &mut out);
            let find = |wanted: f64, of: &dyn Fn(f64) -> f64| {
                let is = |x: &f64| (of(*x) - wanted).abs() <= 1e-12;
                own.iter().position(is).map(|i| i as u32)
            };
            let [x, y] = [first, second].map(|i| own.get(i as usize).copied());
            let (x, y) = (x?, y?);
            let [one, u, v, uu, uv, vv] = out[..6] else { return None };
            let center = [find(x - 0.5 * u, &|x| x)?, find(y - 0.5 * v, &|x| x)?];
            let radius = find(0.25 * (u * u + v * v) - one, &|x| x * x)?;
            let is_length = match out[6..] {
                [] => false,
                [guard] if guard == own[radius as usize] => true,
                _ => return None,
            };
            let is_plain = [uu, uv, vv] == [1.0, 0.0, 1.0];
            is_plain.then_some(Self { center, radius, is_length })
        };
        let found = at(1)?;
        (at(2) == Some(found)).then_some(found)
    }
}

/// What a conic is of, by its terms of the second degree.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Form {
    Line,
    Circle,
    /// Their coefficients are these numbers, by their bits.
    Numbers([u64; 3]),
    Other,
}

impl Form {
    fn of(conic: &Conic, arena: &Arena) -> Self {
        if conic.is_line(arena) {
            return Self::Line;
        }
        if conic.is_round(arena) {
            return Self::Circle;
        }
        let second = [3, 4, 5].map(|i| arena.as_constant(conic.coefficients[i]).map(f64::to_bits));
        match second {
            [Some(a), Some(b), Some(c)] => Self::Numbers([a, b, c]),
            _ => Self::Other,
        }
    }
    /// Returns true if a sum of two such, each with a factor, is a line; the arguments of one may be in the
    /// other order.
    pub(crate) fn is_like(self, other: Self, is_swapped: bool) -> bool {
        match (self, other) {
            (Self::Line, _) | (_, Self::Line) | (Self::Circle, Self::Circle) => true,
            (Self::Numbers([a, b, c]), Self::Numbers(second)) => {
                second == if is_swapped { [c, b, a] } else { [a, b, c] }
            }
            (Self::Circle | Self::Numbers(_) | Self::Other, _) => false,
        }
    }
}

/// A derivative that is not zero everywhere.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Entry {
    /// By which argument.
    pub(crate) argument: u32,
    /// The arguments that it depends on.
    pub(crate) depends: Few,
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

/// What an equation divides by: where it vanishes there is a pole.
#[derive(Debug)]
pub(crate) struct Divisors {
    /// For each, the arguments that it depends on.
    pub(crate) depends: Vec<Few>,
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

/// The most arguments of an equation of which it is asked what it says of two.
const PAIRED: u32 = 24;

impl Kernel {
    /// Returns true if the derivatives are the same everywhere.
    pub(crate) fn is_linear(&self) -> bool {
        self.entries.iter().all(|entry| entry.depends.is_empty())
    }
    /// Returns true if a derivative hangs on a choice: of a sign, of the larger, of a case.
    pub(crate) fn has_pieces(&self) -> bool {
        self.entries.iter().any(|entry| entry.branches)
    }
    /// Returns true if a derivative that comes to nothing may be that of an exponential, which is nowhere zero: its
    /// number is too small to be written.
    pub(crate) fn may_underflow(&self) -> bool {
        let grows = |node| match node {
            Node::Unary(Unary::Exp | Unary::Sinh | Unary::Cosh | Unary::Tanh, _) => true,
            Node::Binary(Binary::Pow, _, exponent) => self.arena.as_constant(exponent).is_none(),
            _ => false,
        };
        self.arena.nodes().any(grows)
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
        let vars: Vec<Var> = if arity > u64::BITS {
            arena.variables(residual).into_iter().collect()
        } else {
            let (vars, _) = Reads::by(&arena, arity, &[residual]).of(residual);
            vars.iter().map(|&v| Var(v)).collect()
        };
        let gradient = gradient(&mut arena, residual, &vars);
        let told = |d: &ExprId| arena.as_constant(*d) != Some(0.0);
        let (vars, derivatives): (Vec<Var>, Vec<ExprId>) =
            vars.into_iter().zip(gradient).filter(|(_, d)| told(d)).unzip();
        let reads = Reads::by(&arena, arity, &derivatives);
        let entry = |(var, &d): (&Var, &ExprId)| {
            let (depends, branches) = reads.of(d);
            Entry { argument: var.0, depends, branches }
        };
        let entries = vars.iter().zip(&derivatives).map(entry).collect();
        let mut outs = vec![left, right];
        outs.extend(&derivatives);
        let slopes = Tape::compile(&arena, &outs);
        let solved = (0..arity).map(|_| OnceLock::new()).collect();
        let pairs = if arity > PAIRED { 0 } else { arity * (arity + 1) / 2 };
        let curves = (0..pairs).map(|_| OnceLock::new()).collect();
        let (shown, stated, second, divisors) = Default::default();
        Self {
            arena,
            left,
            right,
            entries,
            sides,
            slopes,
            derivatives,
            shown,
            stated,
            second,
            divisors,
            solved,
            curves,
        }
    }

    /// Compiles an equation of slots; returns the slots that are its arguments too.
    pub(crate) fn of_slots(from: &Arena, left: ExprId, right: ExprId) -> (Self, Vec<SlotIndex>) {
        let mut arena = Arena::new();
        let (left, right, arguments) = canonical(from, left, right, &mut arena);
        let sides = Rc::new(Tape::compile(&arena, &[left, right]));
        (Self::compile(arena, left, right, arguments.len() as u32, sides), arguments)
    }

    /// Derives all that it says of every two arguments.
    pub(crate) fn complete_curves(&self) {
        for second in 1..=self.arity() as u32 {
            (0..second).for_each(|first| {
                self.curve([first, second]);
            });
        }
    }

    /// Derives all else that is otherwise derived when it is first asked for.
    pub(crate) fn complete(&self) {
        self.second();
        self.divisors();
        self.stated().for_each(drop);
        self.shown().for_each(drop);
        for argument in 0..self.arity() as u32 {
            self.solved(argument);
        }
    }

    /// Returns both sides as expressions of the arguments.
    pub(crate) fn expressions(&self) -> (&Arena, [ExprId; 2]) {
        (&self.arena, [self.left, self.right])
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

    /// Returns what it says of two arguments, in order, where that is of the second degree in them; the last
    /// may be one more than there are, for none.
    pub(crate) fn curve(&self, [first, second]: [u32; 2]) -> Option<&Curve> {
        let make = || {
            let mut arena = Arena::for_nodes(64);
            let (sides, vars) = ([self.left, self.right], [Var(first), Var(second)]);
            let conic = expr::conic(&self.arena, sides, vars, &mut arena, &|var| var)?;
            let form = Form::of(&conic, &arena);
            let mut outs = conic.coefficients.to_vec();
            outs.extend(&conic.guards);
            let (tape, guards) = (Tape::compile(&arena, &outs), conic.guards.len());
            let reads = |&guard| arena.variables(guard).iter().any(|var| vars.contains(var));
            let guards_move = conic.guards.iter().any(reads);
            let round = match form {
                Form::Circle => Round::of(&tape, [first, second], self.arity()),
                Form::Line | Form::Numbers(_) | Form::Other => None,
            };
            Some(Box::new(Curve { tape, guards, guards_move, form, round }))
        };
        let before = second * (second - 1) / 2;
        self.curves.get((before + first) as usize)?.get_or_init(make).as_deref()
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

    /// Returns the arguments of which a change shows at a generic point.
    pub(crate) fn shown(&self) -> impl Iterator<Item = u32> + '_ {
        let find = || {
            let (mut registers, mut out) = (Vec::new(), vec![0.0; self.entries.len() + 2]);
            let is_linear = self.is_linear();
            let mut shows = vec![None; self.entries.len()];
            for point in Point::ALL.into_iter().filter(|_| !is_linear) {
                let own: Vec<f64> =
                    (0..self.arity() as u64).map(|i| generic_number(i, point)).collect();
                self.slopes.run(&own, &mut registers, &mut out);
                for (shows, slope) in shows.iter_mut().zip(&out[2..]).filter(|s| s.1.is_finite()) {
                    shows.get_or_insert(*slope != 0.0);
                }
            }
            let of = |(entry, shows): (&Entry, Option<bool>)| {
                let may_be_any = || entry.branches || self.may_underflow();
                (shows != Some(false) || may_be_any()).then_some(entry.argument)
            };
            self.entries.iter().zip(shows).filter_map(of).collect()
        };
        self.shown.get_or_init(find).iter().copied()
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
            let varies = varying(&arena);
            let bends = |d: &ExprId| varies[d.index()];
            for (entry, &d) in self.entries.iter().zip(&self.derivatives).filter(|e| bends(e.1)) {
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

    /// Returns what the sides divide by that is not constant, if they do.
    pub(crate) fn divisors(&self) -> Option<&Divisors> {
        let find = || {
            let mut found = Vec::new();
            let is_negative = |b: ExprId| self.arena.as_constant(b).is_some_and(|b| b < 0.0);
            for id in self.arena.reachable(&[self.left, self.right]) {
                match self.arena.node(id) {
                    Node::Binary(Binary::Div, _, by) => found.push((by, false)),
                    Node::Binary(Binary::Pow, by, exponent) if is_negative(exponent) => {
                        found.push((by, false));
                    }
                    Node::Unary(Unary::Tan, angle) => found.push((angle, true)),
                    Node::Unary(..)
                    | Node::Binary(..)
                    | Node::Constant(_)
                    | Node::Var(_)
                    | Node::Select { .. } => {}
                }
            }
            found.retain(|(by, _)| self.arena.as_constant(*by).is_none());
            if found.is_empty() {
                return None;
            }
            let mut arena = self.arena.clone();
            let by = |(by, is_angle)| if is_angle { arena.unary(Unary::Cos, by) } else { by };
            let outs: Vec<ExprId> = found.into_iter().map(by).collect();
            let depends = outs.iter().map(|&by| arena.variables(by).iter().map(|v| v.0).collect());
            Some(Divisors { depends: depends.collect(), tape: Tape::compile(&arena, &outs) })
        };
        self.divisors.get_or_init(find).as_ref()
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

/// What the nodes of an arena read: of each the variables, and whether its value depends on a choice.
enum Reads {
    /// Of every node, the variables as bits, where these are few.
    Bits(Vec<(u64, bool)>),
    /// Of the nodes that were asked for and what they are made of, in order.
    Lists(Vec<ExprId>, Vec<(Few, bool)>),
}

impl Reads {
    /// Finds what these expressions read.
    fn by(arena: &Arena, arity: u32, roots: &[ExprId]) -> Self {
        if arity > u64::BITS {
            let order = arena.reachable(roots);
            let mut reads: Vec<(Few, bool)> = Vec::with_capacity(order.len());
            for &id in &order {
                let node = arena.node(id);
                let mut own = (Few::default(), chooses(node));
                if let Node::Var(var) = node {
                    own.0 = [var.0][..].into();
                }
                node.each_operand(|operand| {
                    let at = order.binary_search(&operand).expect("operands are reached too");
                    own = (union(&own.0, &reads[at].0), own.1 | reads[at].1);
                });
                reads.push(own);
            }
            return Self::Lists(order, reads);
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
        Self::Bits(reads)
    }
    /// Returns the variables of an expression that was asked for, in order, and true if its value depends on a
    /// choice.
    fn of(&self, id: ExprId) -> (Few, bool) {
        match self {
            Self::Bits(reads) => {
                let (mut variables, chooses) = reads[id.index()];
                let next = || {
                    let next = (variables != 0).then(|| variables.trailing_zeros());
                    variables &= variables.wrapping_sub(1);
                    next
                };
                (std::iter::from_fn(next).collect(), chooses)
            }
            Self::Lists(order, reads) => {
                let at = order.binary_search(&id).expect("it was asked for");
                reads[at].clone()
            }
        }
    }
}

/// Returns what is in either of two lists in order; one that holds the other is shared.
fn union(a: &Few, b: &Few) -> Few {
    let (few, many) = if a.len() < b.len() { (a, b) } else { (b, a) };
    let is_new = |x: &&u32| many.binary_search(x).is_err();
    if few.len() == many.len() && few == many || !few.iter().any(|x| is_new(&x)) {
        return many.clone();
    }
    let mut all: Vec<u32> = many.iter().chain(few.iter().filter(is_new)).copied().collect();
    all.sort_unstable();
    all.into()
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_differs_by_a_line_is_alike() {
        // of x and y: x² + y², x² + 2 y², 2 x² + y², x y, x + y, a x² + y²
        let mut arena = Arena::new();
        let [x, y, a] = [0, 1, 2].map(|v| arena.var(Var(v)));
        let two = arena.constant(2.0);
        let [xx, yy] = [x, y].map(|e| arena.square(e));
        let [xx2, yy2] = [xx, yy].map(|e| arena.mul(two, e));
        let (product, scaled) = (arena.mul(x, y), arena.mul(a, xx));
        let sides = [
            arena.add(xx, yy),
            arena.add(xx, yy2),
            arena.add(xx2, yy),
            product,
            arena.add(x, y),
            arena.add(scaled, yy),
        ];
        let five = arena.constant(5.0);
        let [circle, wide, tall, product, line, scaled] = sides.map(|left| {
            let (kernel, arguments) = Kernel::of_slots(&arena, left, five);
            assert_eq!(arguments[..2], [0, 1]);
            kernel.curve([0, 1]).expect("it is of the second degree").form
        });
        let alike = |a: Form, b: Form| a.is_like(b, false);
        assert!(alike(circle, circle) && alike(wide, wide) && alike(product, product));
        assert!([circle, wide, tall, product, scaled].iter().all(|&f| alike(f, line)));
        assert!(!alike(circle, wide) && !alike(wide, tall) && !alike(product, circle));
        assert!(wide.is_like(tall, true) && product.is_like(product, true));
        // what the factor is of cannot be seen
        assert!(!alike(scaled, scaled));
    }

    /// Which of many is the largest hangs on all of them, and its slope on nothing else.
    #[test]
    fn the_largest_of_many_is_on_a_piece_of_its_own() {
        let mut arena = Arena::new();
        let vars: Vec<ExprId> = (0..101).map(|v| arena.var(Var(v))).collect();
        let join = |a, b| arena.binary(Binary::Max, a, b);
        let largest = base::number::joined(vars[1..].to_vec(), join).expect("there are some");
        let (kernel, _) = Kernel::of_slots(&arena, vars[0], largest);
        let all: Vec<u32> = (1..101).collect();
        assert_eq!(kernel.entries.len(), 101);
        assert!(kernel.entries[0].depends.is_empty() && !kernel.entries[0].branches);
        assert!(kernel.entries[1..].iter().all(|e| e.branches && e.depends[..] == all));
        assert!(!kernel.is_linear());
        assert_eq!(kernel.second().entries, []);
    }
}
