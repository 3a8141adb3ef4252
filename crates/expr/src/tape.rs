//! The tape: expressions lowered to a flat list of operations, to be run again and again.
//!
//! In: an arena and the expressions wanted. Out: runs of equal operations, each writing the registers
//! that follow those of the run before (single assignment). The operation is looked up once a run, so
//! that a wide tape costs about as much as its arithmetic; an operation may read what its own run
//! wrote, so that a chain of equal operations is one run too. Where operations take turns, a stretch of
//! them is one mixed run, each with its operands beside it.
//!
//! Every operation is that of [`Unary::apply`] and [`Binary::apply`]: a tape computes the same bits as
//! [`Arena::evaluate`].

mod ready;

use crate::arena::{Arena, ExprId, Node, Places};
use crate::op::{Binary, Unary};
use base::{Id, number};
use ready::{Ready, queue_of};
use std::fmt;

/// What the operations of a run do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Operation {
    /// Reads a value; the operand is the variable.
    Load,
    Unary(Unary),
    Binary(Binary),
    Select,
}

/// What the operations of a run have in common.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Kind {
    /// They are this one; their operands stand among [`Tape::operands`].
    Alike(Operation),
    /// They read values that follow one another; the first of these is their one operand.
    Values,
    /// Nothing; they stand among [`Tape::mixed`].
    Mixed,
}

/// An operation that differs from those around it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Mixed {
    operation: Operation,
    operands: [u32; 3],
}

impl Operation {
    const COUNT: usize = Unary::ALL.len() + Binary::ALL.len() + 1;

    fn from_place(place: usize) -> Self {
        let after_unary = place.wrapping_sub(Unary::ALL.len());
        match (Unary::ALL.get(place), Binary::ALL.get(after_unary)) {
            (Some(&op), _) => Self::Unary(op),
            (None, Some(&op)) => Self::Binary(op),
            (None, None) => Self::Select,
        }
    }
    fn arity(self) -> usize {
        match self {
            Self::Load | Self::Unary(_) => 1,
            Self::Binary(_) => 2,
            Self::Select => 3,
        }
    }
}

/// Operations on registers that follow one another.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Run {
    kind: Kind,
    /// The register that the first operation writes.
    first: u32,
    count: u32,
}

/// The end of a list of those who wait.
const NOBODY: u32 = u32::MAX;

/// Shorter runs than this are mixed with those beside them.
const SHORT: u32 = 4;

/// Up to this many nodes a tape keeps their order: gathering equal operations would make few runs long.
const SMALL: usize = 64;

/// How many sets of values [`Tape::run_lanes`] takes at once where there are many.
pub const LANES: usize = 8;
/// One number of each of several sets.
pub type Lanes<const N: usize = LANES> = [f64; N];

/// Working space has at least so many registers, so that it serves small tapes without growing.
const ROOM: usize = 32;

/// What a register holds: one number, or one of each set.
trait Word: Copy {
    /// True if it is one number.
    const IS_ONE: bool;
    /// The same number in every set.
    fn of(x: f64) -> Self;
    fn map(self, f: impl Fn(f64) -> f64) -> Self;
    fn join(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;
    /// `then` where this is not zero.
    fn choose(self, then: Self, otherwise: Self) -> Self;
}

impl Word for f64 {
    const IS_ONE: bool = true;
    fn of(x: f64) -> Self {
        x
    }
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }
    fn join(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }
    fn choose(self, then: Self, otherwise: Self) -> Self {
        if self != 0.0 { then } else { otherwise }
    }
}

impl<const N: usize> Word for Lanes<N> {
    const IS_ONE: bool = false;
    fn of(x: f64) -> Self {
        [x; N]
    }
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        std::array::from_fn(|i| f(self[i]))
    }
    fn join(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        std::array::from_fn(|i| f(self[i], other[i]))
    }
    fn choose(self, then: Self, otherwise: Self) -> Self {
        std::array::from_fn(|i| if self[i] != 0.0 { then[i] } else { otherwise[i] })
    }
}

/// Expressions to be run again and again.
///
/// ```
/// use expr::{Arena, Tape, Var};
/// let mut arena = Arena::default();
/// let (x, y) = (arena.var(Var(0)), arena.var(Var(1)));
/// let sum = arena.add(x, y);
/// let product = arena.mul(sum, x);
/// let tape = Tape::compile(&arena, &[sum, product]);
/// let (mut registers, mut out) = (Vec::new(), [0.0; 2]);
/// tape.run(&[3.0, 4.0], &mut registers, &mut out);
/// assert_eq!(out, [7.0, 21.0]);
/// ```
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Tape {
    /// The first registers.
    constants: Vec<f64>,
    runs: Vec<Run>,
    /// The operands of the operations that are alike, one after the other.
    operands: Vec<u32>,
    /// The operations that are not.
    mixed: Vec<Mixed>,
    /// The register of every output.
    outputs: Vec<u32>,
    /// True if these follow one another.
    is_straight: bool,
    registers: usize,
}

impl Tape {
    /// Lowers the nodes that `outputs` are made of.
    pub fn compile(arena: &Arena, outputs: &[ExprId]) -> Self {
        let order = arena.reachable(outputs);
        if order.len() <= SMALL {
            return in_order(arena, &order, outputs);
        }
        let places = Places::of(&order);
        let mut lowering =
            Lowering { tape: Self::default(), register: vec![u32::MAX; order.len()] };
        let (mut loads, mut inner) = (Vec::new(), Vec::new());
        for (i, &id) in order.iter().enumerate() {
            match arena.node(id) {
                Node::Constant(bits) => {
                    lowering.assign(i);
                    lowering.tape.constants.push(f64::from_bits(bits));
                }
                Node::Var(var) => loads.push((i, var)),
                Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => inner.push(i),
            }
        }
        for (i, var) in loads {
            lowering.emit(Operation::Load, i, &[var.index() as u32]);
        }
        // Operands still to be computed, and who waits for each node: the latest, and who before.
        let mut missing = vec![0_u32; order.len()];
        let mut latest = vec![NOBODY; order.len()];
        let mut waiting: Vec<(u32, u32)> = Vec::with_capacity(2 * inner.len());
        let mut ready = Ready::new(order.len());
        for &i in inner.iter().rev() {
            let mut operands = [0; 3];
            let mut count = 0;
            arena.node(order[i]).each_operand(|a| {
                operands[count] = places.place(a);
                count += 1;
            });
            for &a in operands[..count].iter().rev() {
                if lowering.register[a] == u32::MAX {
                    missing[i] += 1;
                    waiting.push((i as u32, latest[a]));
                    latest[a] = waiting.len() as u32 - 1;
                }
            }
            if missing[i] == 0 {
                ready.put_first(queue_of(arena.node(order[i])), i);
            }
        }
        // The longest queue next: it runs dry before another operation is looked up.
        while let Some(queue) = ready.longest() {
            while let Some(i) = ready.take(queue) {
                let (mut operands, mut count) = ([0; 3], 0);
                arena.node(order[i]).each_operand(|a| {
                    operands[count] = lowering.register[places.place(a)];
                    count += 1;
                });
                lowering.emit(Operation::from_place(queue), i, &operands[..count]);
                let mut next = latest[i];
                while next != NOBODY {
                    let (user, before) = waiting[next as usize];
                    next = before;
                    let user = user as usize;
                    missing[user] -= 1;
                    if missing[user] == 0 {
                        ready.put_last(queue_of(arena.node(order[user])), user);
                    }
                }
            }
        }
        lowering.tape.mix();
        let register = &lowering.register;
        lowering.tape.outputs = outputs.iter().map(|&id| register[places.place(id)]).collect();
        let follow = lowering.tape.outputs.windows(2).all(|pair| pair[0] + 1 == pair[1]);
        lowering.tape.is_straight = follow;
        lowering.tape
    }

    /// Makes one mixed run of short runs that follow one another.
    fn mix(&mut self) {
        let runs = std::mem::take(&mut self.runs);
        let all = std::mem::take(&mut self.operands);
        let mut rest = all.as_slice();
        let is_short = |run: &Run| run.count < SHORT && run.kind != Kind::Alike(Operation::Load);
        for some in runs.chunk_by(|a, b| is_short(a) && is_short(b)) {
            if let [Run { kind: Kind::Alike(Operation::Load), first, count }] = some {
                let (mine, others) = rest.split_at(*count as usize);
                rest = others;
                self.load(*first, mine);
                continue;
            }
            let count = some.iter().map(|run| run.count).sum();
            let first = some[0].first;
            if some.len() > 1 {
                self.runs.push(Run { kind: Kind::Mixed, first, count });
            }
            for run in some {
                let Kind::Alike(operation) = run.kind else { continue };
                let (mine, others) = rest.split_at(run.count as usize * operation.arity());
                rest = others;
                if some.len() == 1 {
                    self.runs.push(*run);
                    self.operands.extend(mine);
                    continue;
                }
                for own in mine.chunks_exact(operation.arity()) {
                    let mut operands = [0; 3];
                    operands[..own.len()].copy_from_slice(own);
                    self.mixed.push(Mixed { operation, operands });
                }
            }
        }
    }

    /// Reads variables into the registers from `first` on, those together that follow one another.
    fn load(&mut self, mut first: u32, variables: &[u32]) {
        for some in variables.chunk_by(|a, b| a + 1 == *b) {
            let count = some.len() as u32;
            self.runs.push(Run { kind: Kind::Values, first, count });
            self.operands.push(some[0]);
            first += count;
        }
    }

    /// Returns the number of operations, reading of values included.
    pub fn len(&self) -> usize {
        self.registers - self.constants.len()
    }
    /// Returns true if the tape computes nothing: every output is a constant.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Computes every output.
    ///
    /// `registers` is working space, of any content; it grows if it is too small, and serves many
    /// tapes. Nothing is allocated where it is large enough.
    ///
    /// # Panics
    /// If a variable has no value, or `out` has not the length of the outputs.
    pub fn run(&self, values: &[f64], registers: &mut Vec<f64>, out: &mut [f64]) {
        self.run_on(values, registers, out);
    }

    /// Computes every output, where variable `v` has the value that stands at place `places[v]`; the outputs take
    /// the place of what is in `out`.
    ///
    /// # Panics
    /// If a variable has no place, or a place no value.
    pub fn run_at(
        &self,
        places: &[u32],
        values: &[f64],
        registers: &mut Vec<f64>,
        out: &mut Vec<f64>,
    ) {
        let output = self.outputs_at(places, values, registers);
        out.clear();
        out.extend((0..self.outputs.len()).map(output));
    }

    /// Computes every output as [`Tape::run_at`] does, and leaves them where they were computed: what comes back
    /// tells each by its place among the outputs.
    ///
    /// # Panics
    /// As [`Tape::run_at`] does.
    #[inline]
    pub fn outputs_at<'r>(
        &'r self,
        places: &[u32],
        values: &[f64],
        registers: &'r mut Vec<f64>,
    ) -> impl Fn(usize) -> f64 + use<'r> {
        let gather = |own: &mut [f64], from: usize| {
            let places = &places[from..][..own.len()];
            own.iter_mut().zip(places).for_each(|(own, &place)| *own = values[place as usize]);
        };
        let registers = &*self.compute(gather, registers);
        |output| registers[self.outputs[output] as usize]
    }

    /// Computes every output for several sets of values at once, to the bits of [`Tape::run`].
    ///
    /// `values[v][lane]` is variable `v` of one set. Working space is as for [`Tape::run`].
    ///
    /// # Panics
    /// If a variable has no value, or `out` has not the length of the outputs.
    pub fn run_lanes<const N: usize>(
        &self,
        values: &[Lanes<N>],
        registers: &mut Vec<Lanes<N>>,
        out: &mut [Lanes<N>],
    ) {
        self.run_on(values, registers, out);
    }

    fn run_on<W: Word>(&self, values: &[W], registers: &mut Vec<W>, out: &mut [W]) {
        assert_eq!(out.len(), self.outputs.len(), "there is a place for every output");
        let copy = |own: &mut [W], from: usize| own.copy_from_slice(&values[from..][..own.len()]);
        let registers = self.compute(copy, registers);
        match self.outputs[..] {
            [] => {}
            [first, ..] if self.is_straight => {
                out.copy_from_slice(&registers[first as usize..][..out.len()]);
            }
            [..] => {
                for (out, &register) in out.iter_mut().zip(&self.outputs) {
                    *out = registers[register as usize];
                }
            }
        }
    }

    /// Computes every register; `read` gives some the values of the variables from one on.
    fn compute<'r, W: Word>(
        &self,
        read: impl Fn(&mut [W], usize),
        registers: &'r mut Vec<W>,
    ) -> &'r mut [W] {
        if registers.len() < self.registers {
            registers.resize(self.registers.max(ROOM), W::of(0.0));
        }
        let registers = &mut registers[..self.registers];
        for (register, &constant) in registers.iter_mut().zip(&self.constants) {
            *register = W::of(constant);
        }
        let mut operands = self.operands.as_slice();
        let mut mixed = self.mixed.as_slice();
        for run in &self.runs {
            let first = run.first as usize;
            let operation = match run.kind {
                Kind::Alike(operation) => operation,
                Kind::Values => {
                    let from = operands[0] as usize;
                    operands = &operands[1..];
                    read(&mut registers[first..first + run.count as usize], from);
                    continue;
                }
                Kind::Mixed => {
                    let (mine, rest) = mixed.split_at(run.count as usize);
                    mixed = rest;
                    if W::IS_ONE && mine.len() > SMALL {
                        run_mixed::<W, true>(registers, first, mine);
                    } else {
                        run_mixed::<W, false>(registers, first, mine);
                    }
                    continue;
                }
            };
            let (mine, rest) = operands.split_at(run.count as usize * operation.arity());
            operands = rest;
            match operation {
                Operation::Load => unreachable!("values are read in stretches"),
                Operation::Unary(op) => run_unary(op, registers, first, mine),
                Operation::Binary(op) => run_binary(op, registers, first, mine),
                Operation::Select => {
                    for (i, operand) in mine.as_chunks::<3>().0.iter().enumerate() {
                        let [condition, then, otherwise] = operand.map(|r| registers[r as usize]);
                        registers[first + i] = condition.choose(then, otherwise);
                    }
                }
            }
        }
        registers
    }

    /// Returns the tape as text: one line an operation, with its meaning.
    pub fn describe(&self) -> String {
        self.to_string()
    }
}

/// Lowers nodes in the order in which they stand.
fn in_order(arena: &Arena, order: &[ExprId], outputs: &[ExprId]) -> Tape {
    let mut tape = Tape::default();
    let places = Places::of(order);
    let mut register = [0_u32; SMALL];
    let mut loads = Vec::with_capacity(order.len());
    for (i, &id) in order.iter().enumerate() {
        if let Node::Constant(bits) = arena.node(id) {
            register[i] = tape.constants.len() as u32;
            tape.constants.push(f64::from_bits(bits));
        }
    }
    let mut next = tape.constants.len() as u32;
    for (i, &id) in order.iter().enumerate() {
        if let Node::Var(var) = arena.node(id) {
            register[i] = next + loads.len() as u32;
            loads.push(var.index() as u32);
        }
    }
    tape.load(next, &loads);
    next += loads.len() as u32;
    let first = next;
    tape.mixed.reserve_exact(order.len() - first as usize);
    for (i, &id) in order.iter().enumerate() {
        let at = |a: ExprId| register[places.place(a)];
        let (operation, operands) = match arena.node(id) {
            Node::Constant(_) | Node::Var(_) => continue,
            Node::Unary(op, a) => (Operation::Unary(op), [at(a), 0, 0]),
            Node::Binary(op, a, b) => (Operation::Binary(op), [at(a), at(b), 0]),
            Node::Select { condition, then, otherwise } => {
                (Operation::Select, [at(condition), at(then), at(otherwise)])
            }
        };
        tape.mixed.push(Mixed { operation, operands });
        register[i] = next;
        next += 1;
    }
    if next > first {
        tape.runs.push(Run { kind: Kind::Mixed, first, count: next - first });
    }
    tape.registers = next as usize;
    tape.outputs.extend(outputs.iter().map(|&id| register[places.place(id)]));
    tape.is_straight = tape.outputs.windows(2).all(|pair| pair[0] + 1 == pair[1]);
    tape
}

/// A tape being written.
struct Lowering {
    tape: Tape,
    /// The register of every node, or `u32::MAX`.
    register: Vec<u32>,
}

impl Lowering {
    fn assign(&mut self, node: usize) -> u32 {
        let register = self.tape.registers as u32;
        self.register[node] = register;
        self.tape.registers += 1;
        register
    }
    fn emit(&mut self, operation: Operation, node: usize, operands: &[u32]) {
        let first = self.assign(node);
        self.tape.operands.extend(operands);
        let kind = Kind::Alike(operation);
        match self.tape.runs.last_mut() {
            Some(run) if run.kind == kind => run.count += 1,
            _ => self.tape.runs.push(Run { kind, first, count: 1 }),
        }
    }
}

/// Runs operations that differ. A long chain waits for what was written last to be read again, so that this
/// may be kept `AT_HAND`; looking whether it is asked for costs those that are no chain a little.
fn run_mixed<W: Word, const AT_HAND: bool>(
    registers: &mut [W],
    first: usize,
    operations: &[Mixed],
) {
    macro_rules! each {
        ($operation:expr, $at:ident, [$($unary:ident)*], [$($binary:ident)*], $select:expr) => {
            match $operation {
                $(Operation::Unary(Unary::$unary) => $at(0).map(|x| Unary::$unary.apply(x)),)*
                $(Operation::Binary(Binary::$binary) => {
                    $at(0).join($at(1), |x, y| Binary::$binary.apply(x, y))
                })*
                Operation::Load => unreachable!("values are read before anything is computed"),
                Operation::Select => $select,
            }
        };
    }
    let (mut written, mut last) = (usize::MAX, W::of(0.0));
    for (i, Mixed { operation, operands }) in operations.iter().enumerate() {
        let at = |operand: usize| match operands[operand] as usize {
            register if AT_HAND && register == written => last,
            register => registers[register],
        };
        last = each!(
            *operation,
            at,
            [Neg Abs Sqrt Sin Cos Tan Asin Acos Atan Exp Ln Log10 Log2 Sinh Cosh Tanh Asinh Acosh Atanh Cbrt
             Floor Round Sign Not],
            [Add Sub Mul Div Pow Atan2 Min Max Remainder Less LessEqual Equal NotEqual And Or],
            at(0).choose(at(1), at(2))
        );
        written = first + i;
        registers[written] = last;
    }
}

fn run_unary<W: Word>(op: Unary, registers: &mut [W], first: usize, operands: &[u32]) {
    macro_rules! each {
        ($($op:ident)*) => {
            match op {
                $(Unary::$op => for (i, &a) in operands.iter().enumerate() {
                    registers[first + i] = registers[a as usize].map(|x| Unary::$op.apply(x));
                })*
            }
        };
    }
    each!(Neg Abs Sqrt Sin Cos Tan Asin Acos Atan Exp Ln Log10 Log2 Sinh Cosh Tanh Asinh Acosh Atanh
        Cbrt Floor Round Sign Not);
}

fn run_binary<W: Word>(op: Binary, registers: &mut [W], first: usize, operands: &[u32]) {
    let operands = operands.as_chunks::<2>().0;
    macro_rules! each {
        ($($op:ident)*) => {
            match op {
                $(Binary::$op => for (i, &[a, b]) in operands.iter().enumerate() {
                    let (a, b) = (registers[a as usize], registers[b as usize]);
                    registers[first + i] = a.join(b, |x, y| Binary::$op.apply(x, y));
                })*
            }
        };
    }
    each!(Add Sub Mul Div Pow Atan2 Min Max Remainder Less LessEqual Equal NotEqual And Or);
}

impl fmt::Display for Tape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = |register: u32| match self.constants.get(register as usize) {
            Some(&constant) => number::shortest(constant),
            None => format!("r{register}"),
        };
        let (mut operands, mut mixed) = (self.operands.as_slice(), self.mixed.iter());
        for run in &self.runs {
            if run.kind == Kind::Values {
                for i in 0..run.count {
                    writeln!(f, "r{} = v{}", run.first + i, operands[0] + i)?;
                }
                operands = &operands[1..];
                continue;
            }
            for register in run.first..run.first + run.count {
                let next = match run.kind {
                    Kind::Alike(operation) => {
                        let (mine, rest) = operands.split_at(operation.arity());
                        operands = rest;
                        Some((operation, mine))
                    }
                    Kind::Values => None,
                    Kind::Mixed => mixed.next().map(|m| (m.operation, &m.operands[..])),
                };
                let Some((operation, mine)) = next else { continue };
                write!(f, "r{register} = ")?;
                match (operation, &mine[..operation.arity()]) {
                    (Operation::Unary(op), &[a]) => writeln!(f, "{} {}", op.name(), name(a))?,
                    (Operation::Binary(op), &[a, b]) if op.is_infix() => {
                        writeln!(f, "{} {} {}", name(a), op.name(), name(b))?;
                    }
                    (Operation::Binary(op), &[a, b]) => {
                        writeln!(f, "{} {} {}", op.name(), name(a), name(b))?;
                    }
                    (Operation::Select, &[c, a, b]) => {
                        writeln!(f, "if {} then {} else {}", name(c), name(a), name(b))?;
                    }
                    (_, mine) => writeln!(f, "v{}", mine[0])?,
                }
            }
        }
        for (i, &register) in self.outputs.iter().enumerate() {
            writeln!(f, "out {i} = {}", name(register))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Var;

    fn run(tape: &Tape, values: &[f64], outputs: usize) -> Vec<f64> {
        let mut out = vec![0.0; outputs];
        tape.run(values, &mut Vec::new(), &mut out);
        out
    }
    #[test]
    fn nothing_and_constants_only() {
        let mut arena = Arena::new();
        assert_eq!(run(&Tape::compile(&arena, &[]), &[], 0), []);
        let two = arena.constant(2.0);
        let tape = Tape::compile(&arena, &[two, two]);
        assert!(tape.is_empty());
        assert_eq!(run(&tape, &[], 2), [2.0, 2.0]);
    }
    #[test]
    fn what_is_not_reached_is_not_computed() {
        let mut arena = Arena::new();
        let (x, y) = (arena.var(Var(0)), arena.var(Var(7)));
        let unused = arena.mul(x, y);
        let used = arena.sqrt(x);
        assert_ne!(unused, used);
        let tape = Tape::compile(&arena, &[used]);
        assert_eq!(tape.len(), 2);
        assert_eq!(run(&tape, &[9.0], 1), [3.0]);
    }
    #[test]
    fn a_chain_of_equal_operations_is_one_run() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let mut e = x;
        for _ in 0..50_000 {
            e = arena.add(e, x);
        }
        let tape = Tape::compile(&arena, &[e]);
        assert_eq!(tape.runs.len(), 2);
        assert_eq!(run(&tape, &[1.0], 1), [50_001.0]);
    }
    #[test]
    fn operations_that_take_turns_are_one_run() {
        let mut arena = Arena::new();
        let x = arena.var(Var(0));
        let mut e = x;
        let mut wanted = 0.3;
        for i in 0..100 {
            e = if i % 2 == 0 { arena.add(e, x) } else { arena.mul(e, x) };
            wanted = if i % 2 == 0 { wanted + 0.3 } else { wanted * 0.3 };
        }
        let tape = Tape::compile(&arena, &[e]);
        assert_eq!((tape.runs.len(), tape.len()), (2, 101));
        assert_eq!(run(&tape, &[0.3], 1), [wanted]);
    }
    #[test]
    fn a_tape_reads_like_a_page() {
        let mut arena = Arena::new();
        let (x, y, two) = (arena.var(Var(0)), arena.var(Var(1)), arena.constant(2.0));
        let square = arena.square(x);
        let less = arena.binary(Binary::Less, square, y);
        let doubled = arena.mul(two, y);
        let e = arena.select(less, square, doubled);
        let text = Tape::compile(&arena, &[e]).describe();
        let wanted = "r1 = v0\nr2 = v1\nr3 = r1 * r1\nr4 = r3 < r2\nr5 = r2 * 2\n\
                      r6 = if r4 then r3 else r5\nout 0 = r6\n";
        assert_eq!(text, wanted);
    }
    #[test]
    fn lanes_have_the_bits_of_single_runs() {
        let mut arena = Arena::new();
        let (x, y) = (arena.var(Var(0)), arena.var(Var(1)));
        let product = arena.mul(x, y);
        let less = arena.binary(Binary::Less, x, y);
        let root = arena.sqrt(product);
        let sine = arena.unary(Unary::Sin, x);
        let chosen = arena.select(less, root, sine);
        let tape = Tape::compile(&arena, &[chosen, product]);
        let values: [Lanes; 2] = [
            std::array::from_fn(|i| 0.3 * i as f64 - 1.0),
            std::array::from_fn(|i| 1.1 - 0.2 * i as f64),
        ];
        let mut wide = [[0.0; LANES]; 2];
        tape.run_lanes(&values, &mut Vec::new(), &mut wide);
        for lane in 0..LANES {
            let single = run(&tape, &[values[0][lane], values[1][lane]], 2);
            for (out, wide) in single.iter().zip(&wide) {
                assert_eq!(out.to_bits(), wide[lane].to_bits());
            }
        }
    }
    #[test]
    fn old_registers_of_another_tape_do_no_harm() {
        let mut arena = Arena::new();
        let (x, two) = (arena.var(Var(0)), arena.constant(2.0));
        let e = arena.mul(two, x);
        let tape = Tape::compile(&arena, &[e]);
        let (mut registers, mut out) = (vec![f64::NAN; 100], [0.0]);
        tape.run(&[4.0], &mut registers, &mut out);
        assert_eq!((out, registers.len()), ([8.0], 100));
    }
}
