//! Blocks: rows over unknowns, laid out to be evaluated again and again.
//!
//! In: the rows and unknowns of a block. Out: both sides of every row and the Jacobian, at any state.
//! Rows of one kernel are evaluated together. An unknown that a row states outright (`u = e`, with u
//! on one side alone and not in e) is *defined*: it is computed forward, exactly, and what is
//! iterated is the core, from where it is. Forces between beams, results of operations are such.

mod closed;
mod layout;

pub(crate) use closed::{Closed, Conic, Conics};
pub(crate) use layout::{Layout, Layouts};

use crate::kernel::exact::Exact;
use crate::kernel::{Entry, Kernel, Side};
use crate::lanes::{LaneScratch, Out, Outs, WIDE};
use crate::lower::{Definers, Problem, ProblemRow};
use crate::residue::Residue;
use crate::rows::Point;
use crate::search::{COUNTING, Effort, IMPROVING, Puzzle, Verdict};
use crate::system::SlotIndex;
use expr::{Arena, ExprId, LANES, Var};
use layout::{Group, KNOWN, positions};
use std::ops::Deref;
use std::rc::Rc;

/// Rows over unknowns.
#[derive(Debug)]
pub(crate) struct Block {
    /// The unknowns, in order of slots.
    pub(crate) unknowns: Vec<SlotIndex>,
    /// The slots of all rows, group after group.
    arguments: Vec<SlotIndex>,
    /// What it has in common with blocks that differ in their slots alone.
    layout: Rc<Layout>,
}

impl Deref for Block {
    type Target = Layout;
    fn deref(&self) -> &Layout {
        &self.layout
    }
}

/// A block at one state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Local {
    /// The left side of every row.
    pub(crate) left: Vec<f64>,
    /// The right side of every row.
    pub(crate) right: Vec<f64>,
    /// The entries of the Jacobian of `left - right`, in the order of the pattern.
    pub(crate) jacobian: Vec<f64>,
}

/// A second derivative of a row by two unknowns.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct SecondPlace {
    /// The unknowns, by position.
    pub(crate) i: u32,
    pub(crate) j: u32,
    /// Which of the kernel's it is.
    out: u32,
    /// How often it counts.
    times: f64,
}

impl SecondPlace {
    /// Returns its value, of those of the kernel.
    pub(crate) fn of(&self, out: Out<'_>) -> f64 {
        self.times * out.get(self.out as usize)
    }
}

/// Working space for evaluation; serves any number of blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Workspace {
    pub(crate) registers: Vec<f64>,
    arguments: Vec<f64>,
    out: Vec<f64>,
    /// Where tapes are run for several rows at once.
    pub(crate) lanes: LaneScratch,
    /// What was spent so far, in multiplications, roughly.
    spent: u64,
    /// What may be spent: iteration ends there.
    bound: Option<u64>,
    /// True if any solution will do.
    is_trial: bool,
}

impl Workspace {
    /// Counts what an iteration costs, in multiplications.
    pub(crate) fn spend(&mut self, multiplications: usize) {
        self.spent += multiplications as u64;
    }
    /// Returns what was counted so far.
    pub(crate) fn spent(&self) -> u64 {
        self.spent
    }
    /// Says up to what iteration goes on; without a bound it ends where it ends.
    pub(crate) fn end_at(&mut self, bound: Option<u64>) {
        self.bound = bound;
        self.is_trial = false;
    }
    /// Does the same for trials, of which any solution will do.
    pub(crate) fn try_until(&mut self, bound: Option<u64>) {
        self.bound = bound;
        self.is_trial = bound.is_some();
    }
    /// Returns what may still be spent, where that is bounded.
    pub(crate) fn left(&self) -> Option<u64> {
        self.bound.map(|bound| bound.saturating_sub(self.spent))
    }
    /// Returns true if what may be spent is spent.
    pub(crate) fn is_spent(&self) -> bool {
        self.bound.is_some_and(|bound| self.spent > bound)
    }
    /// Searches, which counts as iterating does.
    pub(crate) fn nearest(&mut self, puzzle: &Puzzle, start: &[f64], values: &[f64]) -> Verdict {
        let improving = if self.is_trial { 0 } else { IMPROVING };
        let most = self.bound.unwrap_or(self.spent + COUNTING);
        let mut effort = Effort { spent: self.spent, most, improving };
        let verdict = puzzle.nearest_within(start, values, &mut effort);
        self.spent = effort.spent;
        verdict
    }
    /// Runs a tape for one row; the outputs are in what is returned.
    pub(crate) fn run(
        &mut self,
        tape: &expr::Tape,
        arguments: &[SlotIndex],
        values: &[f64],
        outs: usize,
    ) -> &mut [f64] {
        tape.run_at(arguments, values, &mut self.registers, &mut self.out);
        debug_assert_eq!(self.out.len(), outs, "the outputs are as many as are asked for");
        &mut self.out
    }

    /// Runs a tape; what comes back tells each output.
    pub(crate) fn outputs<'w>(
        &'w mut self,
        tape: &'w expr::Tape,
        arguments: &[SlotIndex],
        values: &[f64],
    ) -> impl Fn(usize) -> f64 + use<'w> {
        tape.outputs_at(arguments, values, &mut self.registers)
    }

    /// Exchanges what came out last for another vector.
    pub(crate) fn swap_out(&mut self, other: &mut Vec<f64>) {
        std::mem::swap(&mut self.out, other);
    }

    /// Computes the sway of one row.
    pub(crate) fn sway(&mut self, kernel: &Kernel, arguments: &[SlotIndex], values: &[f64]) -> f64 {
        self.arguments.clear();
        self.arguments.extend(arguments.iter().map(|&s| values[s as usize]));
        kernel.sway(&self.arguments, &mut self.registers, &mut self.out)
    }
}

impl Block {
    /// Lays a block out.
    pub(crate) fn new(problem: &Problem, definers: Definers) -> Self {
        let mut arguments = Vec::new();
        positions(problem, &mut arguments);
        let layout = Rc::new(Layout::new(problem, &arguments, definers));
        Self::over(problem, layout)
    }
    /// Lays a block out, as one was before that differs in its slots alone.
    pub(crate) fn alike(problem: &Problem, definers: Definers, layouts: &mut Layouts) -> Self {
        Self::over(problem, layouts.find(problem, definers))
    }
    fn over(problem: &Problem, layout: Rc<Layout>) -> Self {
        let mut arguments = vec![0; layout.argument_count()];
        for (r, row) in problem.rows.iter().enumerate() {
            arguments[layout.arguments_of_row(r)].copy_from_slice(&row.arguments);
        }
        Self { unknowns: problem.unknowns.clone(), arguments, layout }
    }

    /// Returns the slots of the rows of a group, one row after the other.
    fn arguments_of(&self, group: &Group) -> &[SlotIndex] {
        let count = group.rows.len as usize * group.kernel.arity();
        &self.arguments[group.arguments as usize..][..count]
    }

    /// Computes the Jacobian in a finite field, at a point where nothing is known of any slot, row by row and by
    /// unknown; none where an entry has no counterpart there.
    pub(crate) fn residues(&self) -> Option<Vec<Vec<(u32, Residue)>>> {
        let (mut exact, mut work, mut slopes) = (Vec::new(), Vec::new(), Vec::new());
        let own = |r: usize| {
            let (kernel, arguments) = self.row(r);
            exact.clear();
            exact.extend(arguments.iter().map(|&slot| Exact::generic(slot, Point::Mixed)));
            let is_told = kernel.exact_slopes(&exact, &mut work, &mut slopes);
            let entry = |(e, &slope): (&Entry, &Residue)| {
                let unknown = self.unknowns.binary_search(&arguments[e.argument as usize]).ok()?;
                (!slope.is_zero()).then_some((unknown as u32, slope))
            };
            let mut row: Vec<(u32, Residue)> =
                kernel.entries.iter().zip(&slopes).filter_map(entry).collect();
            row.sort_unstable_by_key(|e| e.0);
            is_told.then_some(row)
        };
        (0..self.height()).map(own).collect()
    }

    /// Returns every slot that the rows speak of, some more than once.
    pub(crate) fn slots(&self) -> impl Iterator<Item = SlotIndex> + '_ {
        self.arguments.iter().chain(&self.unknowns).copied()
    }
    /// Returns a row's kernel and arguments.
    pub(crate) fn row(&self, row: usize) -> (&Rc<Kernel>, &[SlotIndex]) {
        (self.kernel_of_row(row), &self.arguments[self.arguments_of_row(row)])
    }

    /// Returns the rows and unknowns that it was made of.
    pub(crate) fn problem(&self) -> Problem {
        let row = |r: usize| {
            let (kernel, arguments) = self.row(r);
            let (level, within) = (self.levels[r], self.within[r]);
            ProblemRow { kernel: kernel.clone(), arguments: arguments.into(), level, within }
        };
        Problem { rows: (0..self.height()).map(row).collect(), unknowns: self.unknowns.clone() }
    }

    /// Returns the equation of a row with every definition put in, and the slots that it is then of.
    pub(crate) fn substituted(&self, row: usize) -> (Kernel, Vec<SlotIndex>) {
        let mut arena = Arena::new();
        let mut slots: Vec<SlotIndex> = self.slots().collect();
        slots.sort_unstable();
        slots.dedup();
        let mut known: Vec<ExprId> = slots.iter().map(|&s| arena.var(Var(s))).collect();
        let mut put = |row: usize, known: &[ExprId]| {
            let (kernel, arguments) = self.row(row);
            kernel.sides_over(&mut arena, &|a| known[slots.partition_point(|&s| s < arguments[a])])
        };
        for d in &self.definitions {
            let (left, right) = put(d.row as usize, &known);
            let slot = self.unknowns[d.unknown as usize];
            known[slots.partition_point(|&s| s < slot)] = match d.side {
                Side::Left => right,
                Side::Right => left,
            };
        }
        let (left, right) = put(row, &known);
        Kernel::of_slots(&arena, left, right)
    }

    /// Computes every defined unknown from the core.
    pub(crate) fn compute_defined(&self, values: &mut [f64], w: &mut Workspace) {
        for d in &self.definitions {
            let (kernel, arguments) = self.row(d.row as usize);
            let sides = w.run(&kernel.sides, arguments, values, 2);
            let value = match d.side {
                Side::Left => sides[1],
                Side::Right => sides[0],
            };
            values[self.unknowns[d.unknown as usize] as usize] = value;
        }
    }

    /// Returns true if a slope hangs on a choice: of a sign, of the larger, of a case.
    pub(crate) fn has_pieces(&self) -> bool {
        self.groups.iter().any(|group| group.kernel.has_pieces())
    }

    /// Returns true if what a row divides by, and what hangs on an unknown, has another sign in one state than in the
    /// other: between them lies a pole.
    pub(crate) fn changes_divisors(&self, from: &[f64], to: &[f64], w: &mut Workspace) -> bool {
        self.any_divisor([from, to], w, |from, to| from * to < 0.0)
    }
    /// Returns true if what a row divides by, and what hangs on an unknown, has come to nothing from one state to the
    /// other, that is to less than this part.
    pub(crate) fn loses_divisors(
        &self,
        from: &[f64],
        to: &[f64],
        part: f64,
        w: &mut Workspace,
    ) -> bool {
        self.any_divisor([from, to], w, |from, to| to.abs() < part * from.abs())
    }
    fn any_divisor(
        &self,
        [from, to]: [&[f64]; 2],
        w: &mut Workspace,
        is_one: impl Fn(f64, f64) -> bool,
    ) -> bool {
        let divides = |row: usize| {
            let (kernel, arguments) = self.row(row);
            let Some(divisors) = kernel.divisors() else { return false };
            let count = divisors.depends.len();
            let before = w.run(&divisors.tape, arguments, from, count).to_vec();
            let after = w.run(&divisors.tape, arguments, to, count);
            let is_unknown = |a: &u32| self.unknowns.binary_search(&arguments[*a as usize]).is_ok();
            let mut each = before.iter().zip(after).zip(&divisors.depends);
            each.any(|((from, to), of)| is_one(*from, *to) && of.iter().any(is_unknown))
        };
        (0..self.height()).any(divides)
    }

    /// Evaluates both sides of every row.
    pub(crate) fn sides(&self, values: &[f64], w: &mut Workspace, local: &mut Local) {
        self.prepare(local);
        for group in &self.groups {
            let Local { left, right, .. } = local;
            let rows = self.rows_of(group);
            self.each(group, &group.kernel.sides, 2, values, w, &mut |row, out| {
                let at = rows[row] as usize;
                (left[at], right[at]) = (out.get(0), out.get(1));
            });
        }
    }

    /// Evaluates both sides and the Jacobian.
    pub(crate) fn slopes(&self, values: &[f64], w: &mut Workspace, local: &mut Local) {
        self.prepare(local);
        local.jacobian.clear();
        local.jacobian.resize(self.pattern.len(), 0.0);
        for group in &self.groups {
            let count = group.kernel.entries.len();
            let (rows, places) = (self.rows_of(group), self.entries_of(group));
            let Local { left, right, jacobian } = local;
            self.each(group, &group.kernel.slopes, 2 + count, values, w, &mut |row, out| {
                let at = rows[row] as usize;
                (left[at], right[at]) = (out.get(0), out.get(1));
                for (&place, i) in places[row * count..][..count].iter().zip(2..) {
                    if place != KNOWN {
                        jacobian[place as usize] += out.get(i);
                    }
                }
            });
        }
    }

    /// Returns the unknowns, by position and in order, of rows whose slope is others already so near, in parts of
    /// the extents: the distance of two places that lie at one has none.
    pub(crate) fn without_slope(
        &self,
        values: &[f64],
        scales: &[f64],
        near: f64,
        w: &mut Workspace,
    ) -> Vec<usize> {
        let mut local = Local::default();
        self.slopes(values, w, &mut local);
        let scale = |unknown: u32| scales[self.unknowns[unknown as usize] as usize];
        let finite_max = |most: f64, size: f64| size.is_finite().then_some(most.max(size));
        let mut unknowns = Vec::new();
        self.each_second(values, w, &mut |row, places, out| {
            let entries = self.pattern.range(row);
            let slope = |e: usize| local.jacobian[e].abs() * scale(self.pattern.column(e) as u32);
            let bend = |p: &SecondPlace| p.of(out).abs() * scale(p.i) * scale(p.j);
            let slope = entries.clone().map(slope).try_fold(0.0, finite_max);
            let bend = places.iter().map(bend).try_fold(0.0, finite_max);
            if slope.zip(bend).is_none_or(|(slope, bend)| bend * near > slope) {
                unknowns.extend(entries.map(|e| self.pattern.column(e)));
            }
        });
        unknowns.sort_unstable();
        unknowns.dedup();
        unknowns
    }

    /// Returns by what part of themselves the numbers of a linear block would have to be others for these
    /// values to be its solution, in the worst of these rows.
    pub(crate) fn backward_error(
        &self,
        rows: impl Iterator<Item = usize>,
        values: &[f64],
        local: &Local,
    ) -> f64 {
        let mut worst = 0.0f64;
        for r in rows {
            let residual = local.left[r] - local.right[r];
            let (mut sum, mut size) = (0.0, 0.0);
            for e in self.pattern.range(r) {
                let part =
                    local.jacobian[e] * values[self.unknowns[self.pattern.column(e)] as usize];
                sum += part;
                size += part.abs();
            }
            if residual != 0.0 {
                worst = worst.max(residual.abs() / (size + (sum - residual).abs()));
            }
        }
        if worst.is_nan() { f64::INFINITY } else { worst }
    }

    /// Returns every second derivative by unknowns that is not zero everywhere, in the order of
    /// [`Block::each_second`]; found once.
    pub(crate) fn seconds(&self) -> &[SecondPlace] {
        &self.all_seconds().0
    }
    fn all_seconds(&self) -> &(Vec<SecondPlace>, Vec<u32>) {
        self.seconds.get_or_init(|| {
            let count = |g: &Group| g.rows.len as usize * g.kernel.second().entries.len();
            let mut seconds = Vec::with_capacity(self.groups.iter().map(count).sum());
            let mut ends = Vec::with_capacity(self.height());
            let mut unknowns: Vec<u32> = Vec::new();
            for group in &self.groups {
                let entries = &group.kernel.second().entries;
                if entries.is_empty() {
                    ends.extend(std::iter::repeat_n(seconds.len() as u32, group.rows.len as usize));
                    continue;
                }
                // what has a second derivative has a first
                unknowns.clear();
                unknowns.resize(group.kernel.arity(), KNOWN);
                for places in self.entries_of(group).chunks_exact(group.kernel.entries.len()) {
                    for (entry, &place) in group.kernel.entries.iter().zip(places) {
                        unknowns[entry.argument as usize] = match place {
                            KNOWN => KNOWN,
                            place => self.pattern.column(place as usize) as u32,
                        };
                    }
                    for (out, &(a, b)) in (0..).zip(entries) {
                        let (i, j) = (unknowns[a as usize], unknowns[b as usize]);
                        if i != KNOWN && j != KNOWN {
                            // two arguments that are one unknown are their own mirror
                            let times = if a != b && i == j { 2.0 } else { 1.0 };
                            seconds.push(SecondPlace { i, j, out, times });
                        }
                    }
                    ends.push(seconds.len() as u32);
                }
            }
            (seconds, ends)
        })
    }

    /// Calls `visit` for every row with its second derivatives and what they are made of; one by two unknowns
    /// stands for its mirror too.
    pub(crate) fn each_second(
        &self,
        values: &[f64],
        w: &mut Workspace,
        visit: &mut impl FnMut(usize, &[SecondPlace], Out<'_>),
    ) {
        let (seconds, ends) = self.all_seconds();
        let mut first = 0;
        let mut ends = ends.iter();
        for group in &self.groups {
            let second = group.kernel.second();
            let rows = self.rows_of(group);
            let count = second.entries.len();
            if count == 0 {
                ends.by_ref().take(rows.len()).for_each(drop);
                continue;
            }
            self.each(group, &second.tape, count, values, w, &mut |row, out| {
                let end = ends.next().map_or(first, |&end| end as usize);
                visit(rows[row] as usize, &seconds[first..end], out);
                first = end;
            });
        }
    }

    fn prepare(&self, local: &mut Local) {
        local.left.resize(self.height(), 0.0);
        local.right.resize(self.height(), 0.0);
    }

    /// Returns true if a row holds for these values, at which `local` was computed.
    pub(crate) fn row_holds(
        &self,
        local: &Local,
        row: usize,
        values: &[f64],
        w: &mut Workspace,
    ) -> bool {
        let (left, right) = (local.left[row], local.right[row]);
        self.within[row].is_met_with(left, right, || {
            let (kernel, arguments) = self.row(row);
            w.sway(kernel, arguments, values)
        })
    }
}

impl Block {
    /// Runs a tape for every row of a group; calls `visit` with the row's place there and what comes out.
    fn each(
        &self,
        group: &Group,
        tape: &expr::Tape,
        outs: usize,
        values: &[f64],
        w: &mut Workspace,
        visit: &mut impl FnMut(usize, Out<'_>),
    ) {
        if outs == 0 {
            return;
        }
        let (arity, all) = (group.kernel.arity(), self.arguments_of(group));
        let rows = group.rows.len as usize;
        let of = |row: usize| &all[row * arity..][..arity];
        let mut row = 0;
        while rows - row >= WIDE {
            let count = LANES.min(rows - row);
            let outs = w.lanes.run(tape, count, |lane| of(row + lane), values, outs);
            (0..count).for_each(|lane| visit(row + lane, outs.of(lane)));
            row += count;
        }
        for row in row..rows {
            visit(row, Outs::of_one(w.run(tape, of(row), values, outs)).of(0));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Kernel;
    use crate::lower::ProblemRow;
    use crate::system::Level;
    use base::number::Tolerance;

    fn row(arena: &Arena, level: Level, left: ExprId, right: ExprId) -> ProblemRow {
        let (kernel, arguments) = Kernel::of_slots(arena, left, right);
        let (kernel, arguments) = (Rc::new(kernel), arguments.into());
        ProblemRow { kernel, arguments, level, within: Tolerance::Relative }
    }

    /// z = x², w = z + x, p = w, in x, z and w.
    fn chain() -> Problem {
        let mut arena = Arena::new();
        let [x, z, w, p] = [0, 1, 2, 3].map(|i| arena.var(Var(i)));
        let square = arena.square(x);
        let sum = arena.add(z, x);
        let sides = [(z, square), (w, sum), (p, w)];
        let rows = sides.map(|(left, right)| row(&arena, Level::Required, left, right));
        Problem { rows: rows.to_vec(), unknowns: vec![0, 1, 2] }
    }

    #[test]
    fn what_rows_define_is_computed_forward() {
        let block = Block::new(&chain(), Definers::Any);
        assert_eq!((&block.core[..], &block.core_rows[..]), (&[0][..], &[2][..]));
        let mut values = [3.0, f64::NAN, f64::NAN, 12.0];
        let (mut w, mut local) = (Workspace::default(), Local::default());
        block.compute_defined(&mut values, &mut w);
        assert_eq!(values, [3.0, 9.0, 12.0, 12.0]);
        // p - w = p - x² - x, whose derivative is -2x - 1
        block.slopes(&values, &mut w, &mut local);
        let mut gradients = Vec::new();
        block.gradients(&local, &|_| 1.0, &mut gradients);
        assert_eq!(gradients, [1.0, 6.0, 7.0]);
        // and whose second derivative is -2: that of the row that defines z, with its factor
        let mut factors = [0.0, 0.0, 1.0];
        block.pass_back(&local, &mut factors);
        let mut second = 0.0;
        block.each_second(&values, &mut w, &mut |row, places, out| {
            for place in places {
                let both = gradients[place.i as usize] * gradients[place.j as usize];
                second += factors[row] * place.of(out) * both;
            }
        });
        assert_eq!(second, -2.0);
    }

    #[test]
    fn definitions_put_in_leave_one_equation() {
        let block = Block::new(&chain(), Definers::Any);
        let (kernel, slots) = block.substituted(2);
        assert_eq!(slots, [0, 3]);
        let mut w = Workspace::default();
        let values = [3.0, f64::NAN, f64::NAN, 11.0];
        assert_eq!(w.run(&kernel.sides, &slots, &values, 2), [11.0, 12.0]);
    }

    #[test]
    fn soft_rows_define_nothing_where_they_may_give_way() {
        let mut arena = Arena::new();
        let [x, z] = [0, 1].map(|i| arena.var(Var(i)));
        let square = arena.square(x);
        let rows = vec![row(&arena, Level::Weak, z, square), row(&arena, Level::Required, z, x)];
        let block = Block::new(&Problem { rows, unknowns: vec![0, 1] }, Definers::Required);
        assert_eq!(block.definitions.iter().map(|d| d.row).collect::<Vec<_>>(), [1]);
    }

    #[test]
    fn what_would_define_itself_is_not_defined() {
        let mut arena = Arena::new();
        let [x, y, z] = [0, 1, 2].map(|i| arena.var(Var(i)));
        let product = arena.mul(x, y);
        let rows = vec![
            row(&arena, Level::Required, x, product),
            row(&arena, Level::Required, y, z),
            row(&arena, Level::Required, z, y),
        ];
        let block = Block::new(&Problem { rows, unknowns: vec![0, 1, 2] }, Definers::Any);
        assert_eq!(block.definitions.len(), 1);
        assert_eq!(block.core_rows, [0, 2]);
    }
}
