//! Lowering: blocks become steps with tapes.
//!
//! In: the blocks in order. Out: steps, each with a program that runs without looking at the system
//! again, and the regions, whose soft rows can be approached where they cannot be met.

use crate::block::Block as Laid;
use crate::kernel::{Kernel, Kernels};
use crate::least::Least;
use crate::measure::Measure;
use crate::order::Block;
use crate::plan::{Analysis, Step, StepKind};
use crate::rows::Row;
use crate::square::Square;
use crate::system::{Level, MethodBody, SlotIndex, Stay};
use expr::{Arena, Tape};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;
use std::sync::OnceLock;

/// What a step runs.
#[derive(Debug)]
pub(crate) enum Program {
    /// Its target takes this number.
    Constant(f64),
    /// Its target takes the value of its one read.
    Copy,
    /// A value for each target.
    Formulas(Tape),
    /// One equation solved for its target.
    Inverse(Inverse),
    /// As many equations as unknowns.
    Square(Square),
    /// Fewer equations than unknowns, and the measure for where they cannot all hold.
    Least(Box<(Least, Measure)>),
    /// Anything else.
    Measure(Measure),
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
    fallback: OnceLock<Square>,
}

impl Inverse {
    /// Solves a row by formula, where there is one.
    fn new(row: &ProblemRow, target: SlotIndex) -> Option<Self> {
        let mut places = (0..).zip(&row.arguments).filter(|a| *a.1 == target);
        let (argument, _) = places.next()?;
        let once = places.next().is_none();
        row.kernel.solved(argument).filter(|_| once)?;
        Some(Self { row: row.clone(), argument, fallback: OnceLock::new() })
    }
    /// Returns the number of formulas.
    fn roots(&self) -> u32 {
        self.row.kernel.solved(self.argument).map_or(0, |s| s.guards.len() as u32)
    }
    /// Returns what solves it step by step.
    pub(crate) fn fallback(&self) -> &Square {
        self.fallback.get_or_init(|| {
            let target = self.row.arguments[self.argument as usize];
            Square::new(&Problem { rows: vec![self.row.clone()], unknowns: vec![target] })
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
    pub(crate) approach: OnceLock<Measure>,
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
    pub(crate) arguments: Vec<SlotIndex>,
    pub(crate) level: Level,
    pub(crate) within: f64,
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
pub(crate) struct Lowered {
    pub(crate) steps: Vec<Step>,
    pub(crate) regions: Vec<Region>,
}

/// Lowers every block, then the slots that equal others.
pub(crate) fn lower(analysis: &Analysis<'_>, arena: &mut Arena, blocks: &[Block]) -> Lowered {
    let mut steps = Vec::new();
    let mut equalities: BTreeMap<SlotIndex, Vec<u32>> = BTreeMap::new();
    for (&(relation, _), &root) in &analysis.classes.used {
        let relations = equalities.entry(root).or_default();
        if relations.last() != Some(&relation) {
            relations.push(relation);
        }
    }
    for (&slot, &bits) in &analysis.classes.constants {
        steps.push(alias(
            &equalities,
            slot,
            slot,
            Program::Constant(f64::from_bits(bits)),
            Vec::new(),
        ));
    }
    let mut kernels = Kernels::default();
    let region_of = regions_of(analysis, blocks);
    let mut regions: Vec<Region> = Vec::new();
    for (block, &region) in blocks.iter().zip(&region_of) {
        if region as usize == regions.len() {
            regions.push(Region { can_approach: true, ..Region::default() });
        }
        let first = steps.len();
        lower_block(analysis, arena, &mut kernels, block, &mut steps);
        for step in &mut steps[first..] {
            step.region = region;
        }
        let home = &mut regions[region as usize];
        home.problem.unknowns.extend(&block.unknowns);
        for &r in &block.rows {
            match problem_row(arena, &mut kernels, &analysis.rows[r]) {
                Some(row) => home.problem.rows.push(row),
                None => home.can_approach = false,
            }
        }
    }
    for region in &mut regions {
        region.can_approach &= region.problem.rows.iter().any(|r| r.level != Level::Required);
        region.problem.unknowns.sort_unstable();
    }
    for (&root, members) in &analysis.classes.members {
        for &m in members.iter().filter(|&&m| m != root) {
            steps.push(alias(&equalities, root, m, Program::Copy, vec![root]));
        }
    }
    Lowered { steps, regions }
}

fn alias(
    equalities: &BTreeMap<SlotIndex, Vec<u32>>,
    root: SlotIndex,
    target: SlotIndex,
    program: Program,
    reads: Vec<SlotIndex>,
) -> Step {
    let relations = equalities.get(&root).cloned().unwrap_or_default();
    Step {
        kind: StepKind::Alias,
        targets: vec![target],
        reads,
        relations,
        program,
        region: u32::MAX,
        rows: Vec::new(),
    }
}

fn problem_row(arena: &Arena, kernels: &mut Kernels, row: &Row) -> Option<ProblemRow> {
    let (left, right) = row.sides?;
    let (kernel, arguments) = kernels.row(arena, left, right);
    Some(ProblemRow { kernel, arguments, level: row.level, within: row.within })
}

/// Numbers the regions by their first block.
fn regions_of(analysis: &Analysis<'_>, blocks: &[Block]) -> Vec<u32> {
    let mut block_of_slot: BTreeMap<SlotIndex, usize> = BTreeMap::new();
    for (b, block) in blocks.iter().enumerate() {
        block_of_slot.extend(block.unknowns.iter().map(|&s| (s, b)));
    }
    let mut parent: Vec<usize> = (0..blocks.len()).collect();
    fn find(parent: &mut [usize], mut i: usize) -> usize {
        while parent[i] != i {
            parent[i] = parent[parent[i]];
            i = parent[i];
        }
        i
    }
    for (b, block) in blocks.iter().enumerate() {
        for s in reads_of(analysis, block) {
            if let Some(&other) = block_of_slot.get(&s) {
                let (x, y) = (find(&mut parent, b), find(&mut parent, other));
                parent[x.max(y)] = x.min(y);
            }
        }
    }
    let mut number: BTreeMap<usize, u32> = BTreeMap::new();
    (0..blocks.len())
        .map(|b| {
            let root = find(&mut parent, b);
            let next = number.len() as u32;
            *number.entry(root).or_insert(next)
        })
        .collect()
}

fn reads_of(analysis: &Analysis<'_>, block: &Block) -> BTreeSet<SlotIndex> {
    let mut reads = BTreeSet::new();
    for &r in &block.rows {
        let row = &analysis.rows[r];
        reads.extend(analysis.method_reads.get(&row.relation).unwrap_or(&row.mentions));
    }
    for slot in &block.unknowns {
        reads.remove(slot);
    }
    reads
}

fn lower_block(
    analysis: &Analysis<'_>,
    arena: &mut Arena,
    kernels: &mut Kernels,
    block: &Block,
    steps: &mut Vec<Step>,
) {
    let first = &analysis.rows[block.rows[0]];
    let one_relation = block.rows.iter().all(|&r| analysis.rows[r].relation == first.relation);
    if one_relation && let Some(step) = by_method(analysis, arena, first.relation, &block.rows) {
        steps.push(step);
        return;
    }
    let opaque = block.rows.iter().any(|&r| analysis.rows[r].sides.is_none());
    let writes_more = block.unknowns.iter().any(|s| analysis.direction.written_by.contains_key(s));
    if opaque || writes_more {
        once_round(analysis, arena, kernels, block, steps);
        return;
    }
    let rows = block.rows.iter();
    let problem = Problem {
        rows: rows.filter_map(|&r| problem_row(arena, kernels, &analysis.rows[r])).collect(),
        unknowns: block.unknowns.clone(),
    };
    if problem.rows.len() == problem.unknowns.len() {
        square_block(analysis, block, &problem, steps);
        return;
    }
    let soft = problem.rows.iter().any(|r| r.level != Level::Required);
    let over = problem.rows.len() > problem.unknowns.len()
        || block.rows.iter().any(|&r| analysis.direction.slot_of_row[r].is_none());
    let kind = if soft && over { StepKind::Compromise } else { StepKind::LeastChange };
    let program = measure(analysis, &problem, kind);
    let reads = reads_of(analysis, block).into_iter().collect();
    steps.push(step(analysis, kind, &block.rows, block.unknowns.clone(), reads, program));
}

/// The steps of a square block: by formula where all comes from one unknown that has one, and at once
/// where not.
fn square_block(analysis: &Analysis<'_>, block: &Block, problem: &Problem, steps: &mut Vec<Step>) {
    let reads: Vec<SlotIndex> = reads_of(analysis, block).into_iter().collect();
    if let ([row], [slot]) = (&problem.rows[..], &problem.unknowns[..])
        && let Some(inverse) = Inverse::new(row, *slot)
    {
        steps.push(inverse_step(analysis, &block.rows, inverse, reads));
        return;
    }
    let square = Square::new(problem);
    if let Some(((row, core), rest)) = closed_form(&square.block, problem) {
        let mut step = inverse_step(analysis, &[block.rows[row]], core, reads);
        // it has nothing to do only where the rows that were put into it hold as well
        step.rows = sides_of(analysis, &block.rows);
        steps.push(step);
        for (row, inverse) in rest {
            let target = inverse.row.arguments[inverse.argument as usize];
            let mut reads = inverse.row.arguments.clone();
            reads.retain(|&s| s != target);
            steps.push(inverse_step(analysis, &[block.rows[row]], inverse, reads));
        }
        return;
    }
    let kind = if square.block.is_linear { StepKind::Linear } else { StepKind::Newton };
    let targets = block.unknowns.clone();
    steps.push(step(analysis, kind, &block.rows, targets, reads, Program::Square(square)));
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
    let put = ProblemRow { kernel: Rc::new(kernel), arguments, ..problem.rows[row].clone() };
    let inverse = Inverse::new(&put, laid.unknowns[*core as usize])?;
    let rest = laid.definitions.iter().map(|d| {
        let row = d.row as usize;
        let slot = laid.unknowns[d.unknown as usize];
        Inverse::new(&problem.rows[row], slot).map(|inverse| (row, inverse))
    });
    Some(((row, inverse), rest.collect::<Option<_>>()?))
}

fn inverse_step(
    analysis: &Analysis<'_>,
    rows: &[usize],
    inverse: Inverse,
    reads: Vec<SlotIndex>,
) -> Step {
    let target = inverse.row.arguments[inverse.argument as usize];
    let kind = StepKind::Inverse { roots: inverse.roots() };
    step(analysis, kind, rows, vec![target], reads, Program::Inverse(inverse))
}

/// Makes the program that handles rows and unknowns of any number.
fn measure(analysis: &Analysis<'_>, problem: &Problem, step: StepKind) -> Program {
    let kind = |s: SlotIndex| {
        let given = analysis.classes.stay[s as usize] == Stay::Given;
        (analysis.stated.system.slots[s as usize].scale, given)
    };
    let measure = Measure::new(problem, &kind);
    let alike = problem.unknowns.iter().all(|&u| !kind(u).1);
    if step == StepKind::LeastChange && alike {
        return Program::Least(Box::new((Least::new(problem), measure)));
    }
    Program::Measure(measure)
}

fn step(
    analysis: &Analysis<'_>,
    kind: StepKind,
    rows: &[usize],
    targets: Vec<SlotIndex>,
    reads: Vec<SlotIndex>,
    program: Program,
) -> Step {
    let mut relations: Vec<u32> = rows.iter().map(|&r| analysis.rows[r].relation).collect();
    relations.dedup();
    let rows = sides_of(analysis, rows);
    Step { kind, targets, reads, relations, program, region: u32::MAX, rows }
}

/// Where the sides of rows stand among all sides.
fn sides_of(analysis: &Analysis<'_>, rows: &[usize]) -> Vec<u32> {
    let side = |&r: &usize| {
        let row = &analysis.rows[r];
        row.sides.map(|_| analysis.first_row[row.relation as usize] + row.equation)
    };
    rows.iter().filter_map(side).collect()
}

/// The step of a relation whose written method was chosen.
fn by_method(
    analysis: &Analysis<'_>,
    arena: &mut Arena,
    relation: u32,
    rows: &[usize],
) -> Option<Step> {
    let index = *analysis.direction.method.get(&relation)?;
    let stated = &analysis.stated.system.relations[relation as usize];
    let method = &stated.methods[index];
    let classes = &analysis.classes;
    let targets: Vec<SlotIndex> =
        method.targets.iter().map(|&t| classes.representative[t as usize]).collect();
    let reads = analysis.method_reads[&relation].iter().copied().collect();
    let m = index as u32;
    let (kind, program) = match &method.body {
        MethodBody::Formulas { pattern, arguments } => {
            let stated = analysis.stated;
            let values = stated.write_out(arena, &classes.representative, *pattern, *arguments);
            let tape = Tape::compile(arena, &values);
            (StepKind::Method { relation, method: m }, Program::Formulas(tape))
        }
        MethodBody::Opaque { .. } => {
            let program = Program::Host { source: stated.source, method: m };
            (StepKind::Opaque { relation, method: m }, program)
        }
    };
    Some(step(analysis, kind, rows, targets, reads, program))
}

/// Rows that only methods can satisfy, in a cycle: each once, in order of declaration, then tested.
fn once_round(
    analysis: &Analysis<'_>,
    arena: &mut Arena,
    kernels: &mut Kernels,
    block: &Block,
    steps: &mut Vec<Step>,
) {
    let mut done = BTreeSet::new();
    for &r in &block.rows {
        let row = &analysis.rows[r];
        let own: Vec<usize> = block
            .rows
            .iter()
            .copied()
            .filter(|&o| analysis.rows[o].relation == row.relation)
            .collect();
        if analysis.direction.method.contains_key(&row.relation) {
            if done.insert(row.relation)
                && let Some(step) = by_method(analysis, arena, row.relation, &own)
            {
                steps.push(step);
            }
        } else if let (Some(one), Some(slot)) =
            (problem_row(arena, kernels, row), analysis.direction.slot_of_row[r])
        {
            let single = Block { rows: vec![r], unknowns: vec![slot] };
            let problem = Problem { rows: vec![one], unknowns: vec![slot] };
            square_block(analysis, &single, &problem, steps);
        }
    }
}
