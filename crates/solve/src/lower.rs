//! Lowering: blocks become steps with tapes.
//!
//! In: the blocks in order. Out: steps, each with a program that runs without looking at the system
//! again, and the regions, whose soft rows can be approached where they cannot be met.

use crate::eliminate::{Definers, Definition, Reduced, eliminate};
use crate::measure::Measure;
use crate::order::Block;
use crate::plan::{Analysis, Step, StepKind};
use crate::rows::Row;
use crate::square::Square;
use crate::system::{Level, MethodBody, SlotIndex, Stay};
use expr::{Arena, ExprId, Guard, Tape, Var};
use std::collections::{BTreeMap, BTreeSet};
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
    /// One target, several formulas for it.
    Roots(Roots),
    /// As many equations as unknowns.
    Square(Square),
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
pub(crate) struct Roots {
    /// Guards and value of each root, in order.
    pub(crate) tape: Tape,
    /// For each root, the kinds of its guards.
    pub(crate) guards: Vec<Vec<GuardKind>>,
    /// What solves it where the guards fail.
    pub(crate) fallback: Square,
}

/// What a guard demands of its value.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum GuardKind {
    NonZero,
    NonNegative,
    Positive,
}

/// Unknowns connected by rows, with everything that is needed to approach what cannot be met.
#[derive(Debug, Default)]
pub(crate) struct Region {
    /// True if a row in it is soft and none is opaque.
    pub(crate) can_approach: bool,
    /// The rows of the whole region, over [`Region::arena`].
    pub(crate) problem: Problem,
    /// Made when it is first needed.
    pub(crate) approach: OnceLock<Measure>,
}

/// Rows and unknowns before their derivatives are taken.
#[derive(Clone, Debug, Default)]
pub(crate) struct Problem {
    pub(crate) rows: Vec<ProblemRow>,
    pub(crate) unknowns: Vec<SlotIndex>,
}

/// One row of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProblemRow {
    pub(crate) level: Level,
    pub(crate) left: ExprId,
    pub(crate) right: ExprId,
    pub(crate) within: f64,
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
    let region_of = regions_of(analysis, blocks);
    let mut regions: Vec<Region> = Vec::new();
    for (block, &region) in blocks.iter().zip(&region_of) {
        if region as usize == regions.len() {
            regions.push(Region { can_approach: true, ..Region::default() });
        }
        let first = steps.len();
        lower_block(analysis, arena, block, &mut steps);
        for step in &mut steps[first..] {
            step.region = region;
        }
        let home = &mut regions[region as usize];
        home.problem.unknowns.extend(&block.unknowns);
        for &r in &block.rows {
            match problem_row(&analysis.rows[r]) {
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
        formulas: Vec::new(),
        program,
        region: u32::MAX,
        rows: Vec::new(),
    }
}

fn problem_row(row: &Row) -> Option<ProblemRow> {
    let (left, right) = row.sides?;
    Some(ProblemRow { level: row.level, left, right, within: row.within })
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

fn lower_block(analysis: &Analysis<'_>, arena: &mut Arena, block: &Block, steps: &mut Vec<Step>) {
    let first = &analysis.rows[block.rows[0]];
    let one_relation = block.rows.iter().all(|&r| analysis.rows[r].relation == first.relation);
    if one_relation && let Some(step) = by_method(analysis, arena, first.relation, &block.rows) {
        steps.push(step);
        return;
    }
    let opaque = block.rows.iter().any(|&r| analysis.rows[r].sides.is_none());
    let writes_more = block.unknowns.iter().any(|s| analysis.direction.written_by.contains_key(s));
    if opaque || writes_more {
        once_round(analysis, arena, block, steps);
        return;
    }
    let problem = Problem {
        rows: block.rows.iter().filter_map(|&r| problem_row(&analysis.rows[r])).collect(),
        unknowns: block.unknowns.clone(),
    };
    if problem.rows.len() == problem.unknowns.len() {
        square_block(analysis, arena, block, &problem, steps);
        return;
    }
    let soft = problem.rows.iter().any(|r| r.level != Level::Required);
    let over = problem.rows.len() > problem.unknowns.len()
        || block.rows.iter().any(|&r| analysis.direction.slot_of_row[r].is_none());
    let kind = if soft && over { StepKind::Compromise } else { StepKind::LeastChange };
    let formulas = residuals(arena, &problem);
    let program = measure(analysis, arena, &problem);
    let reads = reads_of(analysis, block).into_iter().collect();
    steps.push(step(analysis, kind, &block.rows, block.unknowns.clone(), reads, formulas, program));
}

/// The steps of a square block: what has to be solved at once, then what its rows state outright.
fn square_block(
    analysis: &Analysis<'_>,
    arena: &mut Arena,
    block: &Block,
    problem: &Problem,
    steps: &mut Vec<Step>,
) {
    let Reduced { problem: left, rows, definitions } = eliminate(arena, problem, Definers::Any);
    let (kind, formulas, program) = square(arena, &left);
    let rows: Vec<usize> = rows.into_iter().map(|r| block.rows[r]).collect();
    let reads = reads_of(analysis, block).into_iter().collect();
    let mut core = step(analysis, kind, &rows, left.unknowns, reads, formulas, program);
    // it has nothing to do only where the rows that were put into it hold as well
    core.rows = sides_of(analysis, &block.rows);
    steps.push(core);
    for Definition { row, slot, value } in definitions {
        let reads = arena.variables(value).into_iter().map(|v| v.0).collect();
        let program = Program::Formulas(Tape::compile(arena, &[value]));
        let kind = StepKind::Inverse { roots: 1 };
        let row = block.rows[row];
        steps.push(step(analysis, kind, &[row], vec![slot], reads, vec![value], program));
    }
}

/// Makes the program that handles rows and unknowns of any number.
fn measure(analysis: &Analysis<'_>, arena: &mut Arena, problem: &Problem) -> Program {
    let kind = |s: SlotIndex| {
        let given = analysis.classes.stay[s as usize] == Stay::Given;
        (analysis.stated.system.slots[s as usize].scale, given)
    };
    Program::Measure(Measure::compile(arena, problem, &kind))
}

fn step(
    analysis: &Analysis<'_>,
    kind: StepKind,
    rows: &[usize],
    targets: Vec<SlotIndex>,
    reads: Vec<SlotIndex>,
    formulas: Vec<ExprId>,
    program: Program,
) -> Step {
    let mut relations: Vec<u32> = rows.iter().map(|&r| analysis.rows[r].relation).collect();
    relations.dedup();
    let rows = sides_of(analysis, rows);
    Step { kind, targets, reads, relations, formulas, program, region: u32::MAX, rows }
}

/// Where the sides of rows stand among all sides.
fn sides_of(analysis: &Analysis<'_>, rows: &[usize]) -> Vec<u32> {
    let side = |&r: &usize| {
        let row = &analysis.rows[r];
        row.sides.map(|_| analysis.first_row[row.relation as usize] + row.equation)
    };
    rows.iter().filter_map(side).collect()
}

fn residuals(arena: &mut Arena, problem: &Problem) -> Vec<ExprId> {
    problem.rows.iter().map(|r| arena.sub(r.left, r.right)).collect()
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
    let (kind, formulas, program) = match &method.body {
        MethodBody::Formulas { pattern, arguments } => {
            let stated = analysis.stated;
            let values = stated.write_out(arena, &classes.representative, *pattern, *arguments);
            let tape = Tape::compile(arena, &values);
            (StepKind::Method { relation, method: m }, values, Program::Formulas(tape))
        }
        MethodBody::Opaque { .. } => {
            let program = Program::Host { source: stated.source, method: m };
            (StepKind::Opaque { relation, method: m }, Vec::new(), program)
        }
    };
    Some(step(analysis, kind, rows, targets, reads, formulas, program))
}

/// Rows that only methods can satisfy, in a cycle: each once, in order of declaration, then tested.
fn once_round(analysis: &Analysis<'_>, arena: &mut Arena, block: &Block, steps: &mut Vec<Step>) {
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
            (problem_row(row), analysis.direction.slot_of_row[r])
        {
            let problem = Problem { rows: vec![one], unknowns: vec![slot] };
            let (kind, formulas, program) = square(arena, &problem);
            let reads = row.mentions.iter().copied().filter(|&s| s != slot).collect();
            steps.push(step(analysis, kind, &[r], vec![slot], reads, formulas, program));
        }
    }
}

/// As many rows as unknowns: by formula, by elimination, or by Newton steps.
fn square(arena: &mut Arena, problem: &Problem) -> (StepKind, Vec<ExprId>, Program) {
    if let ([row], [slot]) = (&problem.rows[..], &problem.unknowns[..])
        && let Some(roots) = expr::isolate(arena, row.left, row.right, Var(*slot))
        && !roots.is_empty()
    {
        let values: Vec<ExprId> = roots.iter().map(|r| r.value).collect();
        let plain = roots.len() == 1 && roots[0].guards.is_empty();
        let kind = StepKind::Inverse { roots: roots.len() as u32 };
        if plain {
            let tape = Tape::compile(arena, &values);
            return (kind, values, Program::Formulas(tape));
        }
        let mut outs = Vec::new();
        let mut guards = Vec::new();
        for root in &roots {
            let mut kinds = Vec::new();
            for guard in &root.guards {
                let (id, kind) = match *guard {
                    Guard::NonZero(id) => (id, GuardKind::NonZero),
                    Guard::NonNegative(id) => (id, GuardKind::NonNegative),
                    Guard::Positive(id) => (id, GuardKind::Positive),
                };
                outs.push(id);
                kinds.push(kind);
            }
            outs.push(root.value);
            guards.push(kinds);
        }
        let tape = Tape::compile(arena, &outs);
        let fallback = Square::compile(arena, problem);
        return (kind, values, Program::Roots(Roots { tape, guards, fallback }));
    }
    let formulas = residuals(arena, problem);
    let fallback = Square::compile(arena, problem);
    let kind = if fallback.is_linear { StepKind::Linear } else { StepKind::Newton };
    (kind, formulas, Program::Square(fallback))
}
