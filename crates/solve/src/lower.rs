//! Lowering: blocks become steps with tapes.
//!
//! In: the blocks in order. Out: steps, each with a program that runs without looking at the system
//! again, and the regions, whose soft rows can be approached where they cannot be met.

use crate::block::{Block as Laid, Layouts};
use crate::few::Few;
use crate::follows;
use crate::kernel::Kernel;
use crate::least::Least;
use crate::lists::Lists;
use crate::measure::Measure;
use crate::order::{Block, Blocks};
use crate::pattern::Pattern;
use crate::plan::{Analysis, Step, StepKind};
use crate::rows::{Row, Rows};
use crate::square::Square;
use crate::system::{Level, MethodBody, RelationBody, SlotIndex, System, Turn};
use crate::union::Union;
use base::number::Tolerance;
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::rc::Rc;

/// What a step runs.
#[derive(Debug)]
pub(crate) enum Program {
    /// Its target takes this number.
    Constant(f64),
    /// Its target takes the value of its one read.
    Copy,
    /// A pattern of a value for each target, and its arguments.
    Formulas(Rc<Pattern>, Few),
    /// One equation solved for its target.
    Inverse(Inverse),
    /// As many equations as unknowns.
    Square(Box<Square>),
    /// Fewer equations than unknowns, and the measure for where they cannot all hold, made when it is
    /// first needed.
    Least(Box<(Least, OnceCell<Measure>)>),
    /// Anything else.
    Measure(Box<Measure>),
    /// The host computes.
    Host {
        /// What the caller calls the relation.
        source: u32,
        /// The method's index.
        method: u32,
    },
}

/// One equation solved for one slot.
#[derive(Debug)]
pub(crate) struct Inverse {
    /// The equation.
    pub(crate) row: ProblemRow,
    /// Which argument is the target; the kernel has formulas for it.
    pub(crate) argument: u32,
    /// What solves it where the guards fail; made when it is first needed.
    fallback: OnceCell<Box<Square>>,
}

impl Inverse {
    /// Solves a row by formula, where there is one.
    pub(crate) fn new(row: ProblemRow, target: SlotIndex) -> Option<Self> {
        let mut places = (0..).zip(&*row.arguments).filter(|a| *a.1 == target);
        let (argument, _) = places.next()?;
        let once = places.next().is_none();
        row.kernel.solved(argument).filter(|_| once)?;
        Some(Self { row, argument, fallback: OnceCell::new() })
    }
    /// Returns the number of formulas.
    pub(crate) fn roots(&self) -> u32 {
        self.row.kernel.solved(self.argument).map_or(0, |s| s.guards.len() as u32)
    }
    /// Returns true if its target is one side of the equation, so that this holds once it has run.
    pub(crate) fn is_stated(&self) -> bool {
        self.row.kernel.stated().any(|(argument, _)| argument == self.argument)
    }
    /// Returns what solves it step by step.
    pub(crate) fn fallback(&self) -> &Square {
        self.fallback.get_or_init(|| {
            let target = self.row.arguments[self.argument as usize];
            let problem = Problem { rows: vec![self.row.clone()], unknowns: vec![target] };
            Box::new(Square::new(&problem))
        })
    }
}

/// Unknowns connected by rows, with everything that is needed to approach what cannot be met.
#[derive(Debug, Default)]
pub(crate) struct Region {
    /// True if a row in it is soft and none is opaque.
    pub(crate) can_approach: bool,
    /// The rows of the whole region.
    pub(crate) problem: Problem,
    /// Made when it is first needed.
    pub(crate) approach: OnceCell<Box<Measure>>,
}

/// The largest region with curved rows that is approached: of larger ones it takes longer than a drag has.
const LARGEST_CURVED: usize = 1000;

impl Region {
    /// Returns true if it is not too large to be approached.
    pub(crate) fn is_within_reach(&self) -> bool {
        let mut rows = self.problem.rows.iter();
        is_within_reach(self.problem.unknowns.len(), rows.all(|row| row.kernel.is_linear()))
    }
}

/// Returns true if a region of so many unknowns is not too large to be approached.
pub(crate) fn is_within_reach(unknowns: usize, is_linear: bool) -> bool {
    unknowns <= LARGEST_CURVED || is_linear
}

/// Rows and unknowns before they are laid out.
#[derive(Clone, Debug, Default)]
pub(crate) struct Problem {
    pub(crate) rows: Vec<ProblemRow>,
    pub(crate) unknowns: Vec<SlotIndex>,
}

/// One row of a block: a kernel and what it speaks of.
#[derive(Clone, Debug)]
pub(crate) struct ProblemRow {
    pub(crate) kernel: Rc<Kernel>,
    pub(crate) arguments: Few,
    pub(crate) level: Level,
    pub(crate) within: Tolerance,
}

/// Which rows may define an unknown.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Definers {
    /// None: distance counts every unknown.
    None,
    /// All: every row will hold.
    Any,
    /// Required ones: the others may have to give way.
    Required,
}

/// Steps and regions.
#[derive(Debug, Default)]
pub(crate) struct Lowered {
    pub(crate) steps: Vec<Step>,
    pub(crate) regions: Vec<Region>,
}

/// How many equalities a step names that copies one of many equal slots: in a class of thousands
/// each member would otherwise name them all.
const MOST_TOLD: usize = 64;

/// Lowers every block, then the slots that equal others.
pub(crate) fn lower(analysis: &Analysis<'_>, blocks: &Blocks) -> Lowered {
    let classes = &analysis.classes;
    let copies: usize = classes.members().map(|(_, members)| members.len()).sum();
    let count = classes.constants.len() + blocks.len() + copies;
    let mut steps = Vec::with_capacity(count);
    let has_equalities = copies + classes.constants.len() > 0;
    let equalities = has_equalities.then(|| classes.equalities(&analysis.stated.system));
    let equalities = equalities.unwrap_or_default();
    for &(slot, bits) in &classes.constants {
        let program = Program::Constant(f64::from_bits(bits));
        steps.push(alias(told(&equalities, slot), slot, program, Few::default()));
    }
    // where every row is required nothing is approached
    let is_soft = |r: usize| analysis.rows[r].level != Level::Required;
    let has_soft = (0..analysis.rows.len()).any(is_soft);
    let region_of = if has_soft { regions_of(analysis, blocks) } else { Vec::new() };
    let mut work = Work::default();
    // members of classes that are written before the end, since a host reads them
    let mut early: BTreeSet<SlotIndex> = BTreeSet::new();
    for (b, block) in blocks.iter().enumerate() {
        let first = steps.len();
        lower_block(analysis, block, &mut work, &mut steps);
        if copies > 0 {
            let mut read = read_by_hosts(analysis, &steps[first..]);
            read.retain(|&(_, slot)| early.insert(slot));
            for (before, slot) in read.into_iter().rev() {
                let root = classes.representative[slot as usize];
                steps.insert(first + before, copied(told(&equalities, root), slot, root));
            }
        }
        if let Some(&region) = region_of.get(b) {
            steps[first..].iter_mut().for_each(|step| step.region = region);
        }
    }
    for (root, members) in classes.members() {
        let relations = told(&equalities, root);
        for &m in members.iter().filter(|&&m| m != root && !early.contains(&m)) {
            steps.push(copied(relations.clone(), m, root));
        }
    }
    Lowered { steps, regions: regions(analysis, blocks, &region_of) }
}

/// Returns the first of the relations that make a class of slots one.
fn told(equalities: &Lists, root: SlotIndex) -> Few {
    let own = equalities.of(root);
    let first = &own[..own.len().min(MOST_TOLD)];
    if first.is_sorted_by(|a, b| a < b) {
        return first.into();
    }
    let mut last = None;
    let own = own.iter().copied();
    own.filter(|&r| last.replace(r) != Some(r)).take(MOST_TOLD).collect()
}

/// Names what the hosts' methods among steps read, but for representatives: the place of the step, and the slot.
fn read_by_hosts(analysis: &Analysis<'_>, steps: &[Step]) -> Vec<(usize, SlotIndex)> {
    let representative = &analysis.classes.representative;
    let mut read = Vec::new();
    for (at, step) in steps.iter().enumerate() {
        if let StepKind::Opaque { relation, method } = step.kind
            && let stated = &analysis.stated.system.relations[relation as usize]
            && let MethodBody::Opaque { reads } = &stated.methods[method as usize].body
        {
            let others = reads.iter().filter(|&&s| representative[s as usize] != s);
            read.extend(others.map(|&slot| (at, slot)));
        }
    }
    read
}

/// Returns the step that copies a slot from the one that stands for all that are equal.
fn copied(relations: Few, target: SlotIndex, root: SlotIndex) -> Step {
    alias(relations, target, Program::Copy, [root].into_iter().collect())
}

fn alias(relations: Few, target: SlotIndex, program: Program, reads: Few) -> Step {
    Step {
        kind: StepKind::Alias,
        targets: [target].into_iter().collect(),
        reads,
        relations,
        program,
        region: u32::MAX,
        rows: Few::default(),
    }
}

pub(crate) fn problem_row(system: &System, rows: &Rows, row: usize) -> Option<ProblemRow> {
    let kernel = rows.kernel(row)?.clone();
    let arguments = rows.mentions(row).into();
    let Row { level, relation, .. } = rows[row];
    let within = system.relations[relation as usize].within;
    Some(ProblemRow { kernel, arguments, level, within })
}

/// Numbers the regions by their first block: for every block, that in which it lies.
fn regions_of(analysis: &Analysis<'_>, blocks: &Blocks) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut block_of_slot = vec![NONE; analysis.stated.system.slots.len()];
    for (b, block) in (0..).zip(blocks.iter()) {
        block.unknowns.iter().for_each(|&s| block_of_slot[s as usize] = b);
    }
    let mut union = Union::new(blocks.len());
    for (b, block) in blocks.iter().enumerate() {
        for &r in block.rows {
            for &s in analysis.reads_of_row(r) {
                let other = block_of_slot[s as usize];
                if other != NONE {
                    union.unite(b, other as usize);
                }
            }
        }
    }
    let mut number = vec![NONE; blocks.len()];
    let mut next = 0;
    let mut number_of = |root: usize| {
        if number[root] == NONE {
            number[root] = next;
            next += 1;
        }
        number[root]
    };
    (0..blocks.len()).map(|b| number_of(union.find(b))).collect()
}

/// States the problems of regions that may have to be approached.
fn regions(analysis: &Analysis<'_>, blocks: &Blocks, region_of: &[u32]) -> Vec<Region> {
    let count = region_of.iter().max().map_or(0, |&last| last as usize + 1);
    let mut regions: Vec<Region> = (0..count).map(|_| Region::default()).collect();
    let mut is_opaque = vec![false; count];
    for (block, &region) in blocks.iter().zip(region_of) {
        for &r in block.rows {
            let soft = analysis.rows[r].level != Level::Required;
            regions[region as usize].can_approach |= soft;
            is_opaque[region as usize] |= analysis.rows.kernel(r).is_none();
        }
    }
    for (region, opaque) in regions.iter_mut().zip(is_opaque) {
        region.can_approach &= !opaque;
    }
    for (block, &region) in blocks.iter().zip(region_of) {
        let region = &mut regions[region as usize];
        if region.can_approach {
            region.problem.unknowns.extend(block.unknowns);
            let rows = block
                .rows
                .iter()
                .filter_map(|&r| problem_row(&analysis.stated.system, analysis.rows, r));
            region.problem.rows.extend(rows);
        }
    }
    regions.iter_mut().for_each(|r| r.problem.unknowns.sort_unstable());
    regions
}

/// What lowering works with: serves any number of blocks, one after the other.
#[derive(Default)]
struct Work {
    layouts: Layouts,
    problem: Problem,
    reads: Reads,
}

/// What finds the reads of blocks.
#[derive(Default)]
struct Reads {
    list: Vec<SlotIndex>,
    /// Of large blocks, which slots are unknowns or found already.
    met: Vec<bool>,
}

/// From so many unknowns on the reads of a block are found by marks.
const MARKED: usize = 16;

impl Work {
    /// States the rows and unknowns of a block; none of its rows is opaque.
    fn state(&mut self, analysis: &Analysis<'_>, block: Block<'_>) -> &Problem {
        let Problem { rows, unknowns } = &mut self.problem;
        rows.clear();
        rows.reserve(block.rows.len());
        rows.extend(
            block
                .rows
                .iter()
                .filter_map(|&r| problem_row(&analysis.stated.system, analysis.rows, r)),
        );
        unknowns.clear();
        unknowns.extend_from_slice(block.unknowns);
        &self.problem
    }
}

fn reads_of(analysis: &Analysis<'_>, block: Block<'_>, reads: &mut Reads) -> Few {
    let Reads { list, met } = reads;
    list.clear();
    list.reserve(MARKED);
    if block.unknowns.len() < MARKED {
        for &r in block.rows {
            for &slot in analysis.reads_of_row(r) {
                if !block.unknowns.contains(&slot) {
                    list.push(slot);
                }
            }
        }
        list.sort_unstable();
        list.dedup();
        return list[..].into();
    }
    let all = block.rows.iter().flat_map(|&r| analysis.reads_of_row(r)).copied();
    met.resize(analysis.stated.system.slots.len(), false);
    block.unknowns.iter().for_each(|&s| met[s as usize] = true);
    list.extend(all.filter(|&s| !std::mem::replace(&mut met[s as usize], true)));
    block.unknowns.iter().chain(&*list).for_each(|&s| met[s as usize] = false);
    list.sort_unstable();
    list[..].into()
}

fn lower_block(analysis: &Analysis<'_>, block: Block<'_>, work: &mut Work, steps: &mut Vec<Step>) {
    let first = analysis.rows[block.rows[0]].relation;
    let one_relation = block.rows.iter().all(|&r| analysis.rows[r].relation == first);
    if one_relation && let Some(step) = by_method(analysis, first, block.rows) {
        steps.push(step);
        return;
    }
    let opaque = block.rows.iter().any(|&r| analysis.rows.kernel(r).is_none());
    let writes_more = block.unknowns.iter().any(|s| analysis.direction.is_written(*s));
    if opaque || writes_more {
        once_round(analysis, block, work, steps);
        return;
    }
    if let Some(step) = by_formula(analysis, block, work) {
        steps.push(step);
        return;
    }
    if block.rows.len() == block.unknowns.len() {
        square_block(analysis, block, work, steps);
        return;
    }
    let problem = work.state(analysis, block);
    let soft = problem.rows.iter().any(|r| r.level != Level::Required);
    let over = problem.rows.len() > problem.unknowns.len()
        || block.rows.iter().any(|&r| analysis.direction.slot_of_row[r].is_none());
    let kind = if soft && over { StepKind::Compromise } else { StepKind::LeastChange };
    let turn = |slot: SlotIndex| analysis.classes.stay[slot as usize].turn();
    if kind == StepKind::LeastChange
        && let Some(apart) = follows::apart(problem, &turn)
    {
        let rows: Vec<usize> = apart.rows.iter().map(|&r| block.rows[r]).collect();
        lower_block(analysis, Block { rows: &rows, unknowns: &apart.unknowns }, work, steps);
        for (r, slot) in apart.follow {
            let single = Block { rows: &[block.rows[r]], unknowns: &[slot] };
            match by_formula(analysis, single, work) {
                Some(step) => steps.push(step),
                None => square_block(analysis, single, work, steps),
            }
        }
        return;
    }
    let program = measure(analysis, problem, kind);
    let (targets, reads) = (block.unknowns[..].into(), reads_of(analysis, block, &mut work.reads));
    steps.push(step(analysis, kind, block.rows, targets, reads, program));
}

/// The step of a row that has a formula for its one unknown.
fn by_formula(analysis: &Analysis<'_>, block: Block<'_>, work: &mut Work) -> Option<Step> {
    let ([row], [slot]) = (block.rows, block.unknowns) else { return None };
    let inverse = Inverse::new(problem_row(&analysis.stated.system, analysis.rows, *row)?, *slot)?;
    let reads = reads_of(analysis, block, &mut work.reads);
    Some(inverse_step(analysis, block.rows, inverse, reads))
}

/// The steps of a square block that is no formula: by formula where all comes from one unknown that has
/// one, and at once where not.
fn square_block(analysis: &Analysis<'_>, block: Block<'_>, work: &mut Work, steps: &mut Vec<Step>) {
    let reads = reads_of(analysis, block, &mut work.reads);
    work.state(analysis, block);
    let Work { layouts, problem, .. } = work;
    let mut square = Square::alike(problem, layouts);
    if let Some(known) = analysis.acceptance.pivots(block.rows, block.unknowns) {
        square.take_pivots(&known.pattern, &known.symbolic);
    }
    if let Some(((row, core), rest)) = closed_form(&square.block, problem) {
        let mut step = inverse_step(analysis, &[block.rows[row]], core, reads);
        // it has nothing to do only where the rows that were put into it hold as well
        step.rows = sides_of(analysis, block.rows);
        steps.push(step);
        for (row, inverse) in rest {
            let target = inverse.row.arguments[inverse.argument as usize];
            let reads = inverse.row.arguments.iter().copied().filter(|&s| s != target).collect();
            steps.push(inverse_step(analysis, &[block.rows[row]], inverse, reads));
        }
        return;
    }
    let kind = match square.block.closed() {
        _ if square.block.is_linear => StepKind::Linear,
        Some(_) => StepKind::Closed,
        None => StepKind::Newton,
    };
    let targets = block.unknowns[..].into();
    steps.push(step(analysis, kind, block.rows, targets, reads, Program::Square(Box::new(square))));
}

/// The largest block that is looked at for a closed form.
const CLOSED: usize = 24;

/// A row, by its position in the block, with its formula.
type Formula = (usize, Inverse);

/// Solves a block of one core unknown by formula: the core's, then those of what it defines.
fn closed_form(laid: &Laid, problem: &Problem) -> Option<(Formula, Vec<Formula>)> {
    let ([core], [row]) = (&laid.core[..], &laid.core_rows[..]) else { return None };
    if problem.rows.len() > CLOSED {
        return None;
    }
    let row = *row as usize;
    let (kernel, arguments) = laid.substituted(row);
    let (kernel, arguments) = (Rc::new(kernel), arguments.into());
    let put = ProblemRow { kernel, arguments, ..problem.rows[row].clone() };
    let inverse = Inverse::new(put, laid.unknowns[*core as usize])?;
    let rest = laid.definitions.iter().map(|d| {
        let row = d.row as usize;
        let slot = laid.unknowns[d.unknown as usize];
        Inverse::new(problem.rows[row].clone(), slot).map(|inverse| (row, inverse))
    });
    Some(((row, inverse), rest.collect::<Option<_>>()?))
}

fn inverse_step(analysis: &Analysis<'_>, rows: &[usize], inverse: Inverse, reads: Few) -> Step {
    let target = inverse.row.arguments[inverse.argument as usize];
    let kind = StepKind::Inverse { roots: inverse.roots() };
    step(analysis, kind, rows, [target].into_iter().collect(), reads, Program::Inverse(inverse))
}

/// Up to this many unknowns, given numbers and others are told apart by what they leave each other free,
/// densely and exactly.
const MEASURED: usize = 60;

/// Makes the program that handles rows and unknowns of any number.
fn measure(analysis: &Analysis<'_>, problem: &Problem, step: StepKind) -> Program {
    let kind = |s: SlotIndex| {
        let turn = analysis.classes.stay[s as usize].turn();
        (analysis.stated.system.slots[s as usize].scale, turn)
    };
    let has_given = problem.unknowns.iter().any(|&u| matches!(kind(u).1, Turn::Given(_)));
    if step == StepKind::LeastChange && (!has_given || problem.unknowns.len() > MEASURED) {
        let least = Least::new(problem, &|s| kind(s).1);
        return Program::Least(Box::new((least, OnceCell::new())));
    }
    Program::Measure(Box::new(Measure::new(problem, &kind)))
}

fn step(
    analysis: &Analysis<'_>,
    kind: StepKind,
    rows: &[usize],
    targets: Few,
    reads: Few,
    program: Program,
) -> Step {
    let mut last = None;
    let relations = rows.iter().map(|&r| analysis.rows[r].relation);
    let relations = relations.filter(|&r| last.replace(r) != Some(r)).collect();
    let rows = sides_of(analysis, rows);
    Step { kind, targets, reads, relations, program, region: u32::MAX, rows }
}

/// Where the sides of rows stand among all sides.
fn sides_of(analysis: &Analysis<'_>, rows: &[usize]) -> Few {
    let side = |&r: &usize| {
        let Row { relation, equation, .. } = analysis.rows[r];
        let RelationBody::Equations(span) =
            &analysis.stated.system.relations[relation as usize].body
        else {
            return None;
        };
        Some(span.start + equation)
    };
    rows.iter().filter_map(side).collect()
}

/// The step of a relation whose written method was chosen.
fn by_method(analysis: &Analysis<'_>, relation: u32, rows: &[usize]) -> Option<Step> {
    let index = analysis.direction.method_of(relation)?;
    let system = &analysis.stated.system;
    let stated = &system.relations[relation as usize];
    let method = &stated.methods[index as usize];
    let over = |slots: &[SlotIndex]| -> Few {
        slots.iter().map(|&s| analysis.classes.representative[s as usize]).collect()
    };
    let targets = over(&method.targets);
    let reads = analysis.method_reads[&relation][..].into();
    let (kind, program) = match &method.body {
        MethodBody::Formulas { pattern, arguments } => {
            let pattern = analysis.stated.pattern(*pattern).clone();
            let program = Program::Formulas(pattern, over(system.arguments(*arguments)));
            (StepKind::Method { relation, method: index }, program)
        }
        MethodBody::Opaque { .. } => {
            let program = Program::Host { source: stated.source, method: index };
            (StepKind::Opaque { relation, method: index }, program)
        }
    };
    Some(step(analysis, kind, rows, targets, reads, program))
}

/// Rows that only methods can satisfy, in a cycle: each once, in order of declaration, then tested.
fn once_round(analysis: &Analysis<'_>, block: Block<'_>, work: &mut Work, steps: &mut Vec<Step>) {
    let mut done = BTreeSet::new();
    for &r in block.rows {
        let relation = analysis.rows[r].relation;
        let own = block.rows.iter().copied().filter(|&o| analysis.rows[o].relation == relation);
        if analysis.direction.method_of(relation).is_some() {
            let own: Vec<usize> = own.collect();
            if done.insert(relation)
                && let Some(step) = by_method(analysis, relation, &own)
            {
                steps.push(step);
            }
        } else if analysis.rows.kernel(r).is_some()
            && let Some(slot) = analysis.direction.slot_of_row[r]
        {
            let single = Block { rows: &[r], unknowns: &[slot] };
            match by_formula(analysis, single, work) {
                Some(step) => steps.push(step),
                None => square_block(analysis, single, work, steps),
            }
        }
    }
}
