//! Dependence: which rows of a component depend on others.
//!
//! In: a task, how its slots are held, a state. Out: the rows that are combinations of others there, each with the
//! rules of these. Slots that are held take no part.

use crate::diagnose::gradient::{Sizes, gradient, is_linear, is_rounding};
use crate::holds::counts;
use crate::host::Host;
use crate::planner::{Model, Planner};
use crate::rule::Body;
use crate::task::{Holding, Origin, Task};
use kernel::{SlotId, Structure, Values};
use solve::echelon::{Dependent, Echelon, Row};
use solve::{Level, Scratch};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// How slots are held.
pub(super) type Hold = fn(&Structure, SlotId) -> Holding;

/// A rule with rows that depend on others.
#[derive(Default)]
pub(super) struct Candidate {
    pub(super) rows: usize,
    /// The rules that these rows are combinations of.
    pub(super) circuit: BTreeSet<u32>,
}

/// Finds the rules with rows that depend on others here, though not everywhere.
pub(super) fn candidates(
    planner: &Planner,
    model: Model<'_>,
    setting: (&Task, Hold),
    core: &[(u32, u32)],
    values: &Values,
    host: &mut dyn Host,
) -> BTreeMap<u32, Candidate> {
    let mut found: BTreeMap<u32, Candidate> = BTreeMap::new();
    for Reliant { row: (rule, _), circuit } in
        dependents(planner, model, setting, core, [values, values], host)
    {
        let candidate = found.entry(rule).or_default();
        candidate.rows += 1;
        candidate.circuit.extend(circuit);
    }
    found
}

/// A row that depends on others.
pub(super) struct Reliant {
    /// Rule and equation.
    pub(super) row: (u32, u32),
    /// The rules that it is a combination of.
    pub(super) circuit: BTreeSet<u32>,
}

/// Finds the rows that depend on others, of those that count in the first state by their slopes in the second.
pub(super) fn dependents(
    planner: &Planner,
    model: Model<'_>,
    (task, hold): (&Task, Hold),
    core: &[(u32, u32)],
    [values, at]: [&Values; 2],
    host: &mut dyn Host,
) -> Vec<Reliant> {
    if core.is_empty() {
        return Vec::new();
    }
    let scratch = &mut Scratch::default();
    let patterns = planner.plans.patterns();
    let column = |s: SlotId| task.component.slots().binary_search(&s).ok().map(|i| i as u32);
    let sizes = Sizes::of(model.structure, task.component.slots(), &at.numbers);
    let mut rows: Vec<Row> = Vec::with_capacity(core.len());
    let mut places: Vec<(u32, u32)> = Vec::with_capacity(core.len());
    // a rule is left out as a whole: of what depends on each other first what says several things, then what follows
    // what it reads
    let is_last = |&&(position, _): &&(u32, u32)| {
        let shape = planner.rules.get(task.component.rules()[position as usize]).shape;
        let rows = match &shape.body {
            Body::Equations(equations) => equations.len(),
            _ => 0,
        };
        (Reverse(rows), shape.reads.is_empty())
    };
    let mut core: Vec<&(u32, u32)> = core.iter().collect();
    core.sort_by_key(is_last);
    for &(position, e) in core {
        let index = task.component.rules()[position as usize];
        let rule = planner.rules.get(index);
        let Body::Equations(equations) = &rule.shape.body else { continue };
        if !counts(patterns, model.structure, rule, values, host, scratch) {
            continue;
        }
        let moves = |s: SlotId| hold(model.structure, s) != Holding::Fixed;
        let equation = &equations[e as usize];
        let mut row = gradient(patterns, rule, equation, &at.numbers, scratch);
        let sides = rule.evaluate(equation, patterns, &at.numbers, scratch);
        if is_rounding(&row, sides, &sizes) {
            row.clear();
        }
        let own = row.into_iter().filter(|e| moves(e.0));
        rows.push(own.filter_map(|(s, v)| Some((column(s)?, v))).collect());
        places.push((index, e));
    }
    let found = Echelon::new(&rows, task.component.slots().len()).dependent().into_iter();
    let place = |row: u32| places[row as usize];
    let reliant = |Dependent { row, circuit }| Reliant {
        row: place(row),
        circuit: circuit.into_iter().map(|r| place(r).0).collect(),
    };
    found.map(reliant).collect()
}

/// Finds the rows, but for those that are left out, that may depend on others at some state: rule of the component
/// and equation.
///
/// A row that alone of those left mentions a slot, with a derivative that is never zero, depends on
/// none of them, nor they on it: it is left out, and so on. Where every rule is linear what depends
/// does so everywhere.
pub(super) fn core(
    planner: &Planner,
    model: Model<'_>,
    (task, hold): (&Task, Hold),
    left_out: &BTreeSet<(u32, u32)>,
) -> Vec<(u32, u32)> {
    let patterns = planner.plans.patterns();
    let rules = || (0..).zip(task.component.rules()).map(|(i, &r)| (i, r, planner.rules.get(r)));
    if rules().all(|(_, _, rule)| is_linear(patterns, rule)) {
        return Vec::new();
    }
    let mut rows: Vec<(u32, u32)> = Vec::new();
    // every slot of every row, and whether its derivative is the same everywhere
    let mut mentions: Vec<(SlotId, u32, bool)> = Vec::new();
    for (position, index, rule) in rules().filter(|(_, _, r)| r.shape.level == Level::Required) {
        let Body::Equations(equations) = &rule.shape.body else { continue };
        let moves = |s: SlotId| hold(model.structure, s) != Holding::Fixed;
        for (e, equation) in (0..).zip(equations).filter(|(e, _)| !left_out.contains(&(index, *e)))
        {
            let number = rows.len() as u32;
            rows.push((position, e));
            let slots: Vec<SlotId> = rule.slots_at(&equation.slots).collect();
            let slopes = patterns.get(equation.pattern).dependence();
            let slopes =
                slopes.map(|(argument, is_constant)| (slots[argument], number, is_constant));
            mentions.extend(slopes.filter(|m| moves(m.0)));
        }
    }
    mentions.sort_unstable();
    let of_slot: Vec<&[(SlotId, u32, bool)]> = mentions.chunk_by(|a, b| a.0 == b.0).collect();
    let mut of_row: Vec<Vec<u32>> = vec![Vec::new(); rows.len()];
    for (i, all) in (0..).zip(&of_slot) {
        all.iter().for_each(|m| of_row[m.1 as usize].push(i));
    }
    let mut left: Vec<usize> = of_slot.iter().map(|all| all.len()).collect();
    let mut is_out = vec![false; rows.len()];
    let mut alone: Vec<u32> =
        (0..of_slot.len() as u32).filter(|&i| left[i as usize] == 1).collect();
    while let Some(slot) = alone.pop() {
        let last = of_slot[slot as usize].iter().find(|m| !is_out[m.1 as usize]);
        let Some(&(_, row, true)) = last else { continue };
        is_out[row as usize] = true;
        for &other in &of_row[row as usize] {
            left[other as usize] -= 1;
            if left[other as usize] == 1 {
                alone.push(other);
            }
        }
    }
    let kept = rows.into_iter().zip(is_out).filter(|(_, is_out)| !is_out);
    kept.map(|(row, _)| row).collect()
}

/// Returns the rows that depend on others everywhere: rule and equation.
pub(super) fn rejected_rows(task: &Task) -> BTreeSet<(u32, u32)> {
    let source = |relation: u32| task.system.relations[relation as usize].source;
    let rule = |relation: u32| match task.origin(source(relation)) {
        Origin::Rule(r) => Some(r),
        Origin::Number(_) | Origin::Wish(_) => None,
    };
    let rejected = &task.plan.report.rejected;
    rejected.iter().filter_map(|r| Some((rule(r.relation)?, r.row))).collect()
}
