//! The plan: steps in order, readable, and what the planner found out on the way.
//!
//! In: a system. Out: a [`Plan`], a pure function of it: no value is consulted, so one plan serves
//! every state of every component of that shape. Substitute, accept, direct, order, lower.

use crate::accept::{self, Acceptance};
use crate::attempt::carry::Places;
use crate::direct::{self, Direction};
use crate::few::Few;
use crate::joint::{Gathered, Joint};
use crate::kernel::Kernel;
use crate::lower::{self, Lowered, Problem, Program, Region};
use crate::order::{self, Blocks, Incidence};
use crate::pattern::{Pattern, Patterns};
use crate::peel::{self, Found, Peeled};
use crate::rest::Resting;
use crate::rows::{self, Rows};
use crate::run::start::Alike;
use crate::slice::Slice;
use crate::stated::Stated;
use crate::substitute::{self, Classes};
use crate::system::{Level, Relation, RelationBody, Slot, SlotIndex, Stay, System, TRUTH, Turn};
use crate::test::{Place, Tests};
use crate::tie;
use crate::truth::is_truth;
use crate::view::{self, Exchange};
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;
use std::ops::Range;
use std::rc::Rc;

/// How a step computes its targets.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StepKind {
    /// A slot takes the value of another that equals it, or of a number.
    Alias,
    /// A written method of this relation.
    Method {
        /// The relation's index in the system.
        relation: u32,
        /// The method's index in the relation.
        method: u32,
    },
    /// One equation solved for one slot by formula; of several roots the one on the present branch.
    Inverse {
        /// How many solutions the formula has.
        roots: u32,
    },
    /// As many linear equations as unknowns.
    Linear,
    /// Two equations of the second degree in two unknowns, as where two circles meet: by formula.
    Closed,
    /// As many equations as unknowns, by damped Newton steps.
    Newton,
    /// Fewer equations than unknowns: they hold, and the distance from the start is least.
    LeastChange,
    /// Soft rows that cannot all hold: least squares, level by level, under the hard ones.
    Compromise,
    /// A written method of this relation that only the host can run.
    Opaque {
        /// The relation's index in the system.
        relation: u32,
        /// The method's index in the relation.
        method: u32,
    },
}

/// One step of a plan.
#[derive(Debug)]
pub struct Step {
    /// How.
    pub kind: StepKind,
    /// The slots that it writes.
    pub targets: Few,
    /// The slots that it reads.
    pub reads: Few,
    /// The relations that it makes hold, by index in the system.
    pub relations: Few,
    pub(crate) program: Program,
    /// Which region it lies in; regions share no unknown. Where every row is required there are none.
    pub(crate) region: u32,
    /// The rows that it makes hold, by the places of their equations in the system.
    pub(crate) rows: Few,
}

impl Step {
    /// Returns true if least change or a compromise is sought among equations that are curved.
    pub fn is_curved(&self) -> bool {
        match &self.program {
            Program::Least(least) => !least.0.block.is_linear,
            Program::Measure(measure) => !measure.is_linear,
            Program::Constant(_)
            | Program::Copy
            | Program::Formulas(..)
            | Program::Inverse(_)
            | Program::Square(_)
            | Program::Host { .. } => false,
        }
    }
    /// Returns true if it may have several solutions for what it reads.
    pub(crate) fn may_branch(&self) -> bool {
        match self.kind {
            StepKind::Inverse { roots } => roots > 1,
            StepKind::Closed | StepKind::Newton => true,
            StepKind::Alias
            | StepKind::Method { .. }
            | StepKind::Linear
            | StepKind::LeastChange
            | StepKind::Compromise
            | StepKind::Opaque { .. } => false,
        }
    }
}

/// A row that depends on rows accepted before it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Rejected {
    /// The relation's index in the system.
    pub relation: u32,
    /// Which of its equations.
    pub row: u32,
    /// The accepted rows (relation, equation) that it is a combination of: with it, a minimal
    /// dependent set. Empty where it speaks of known slots alone.
    pub circuit: Vec<(u32, u32)>,
    /// True if it shares its level with a row of its circuit and compromises with it.
    pub compromises: bool,
}

/// What the planner found out.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Report {
    /// Rows that depend on others. Whether one is redundant or a conflict is seen when the plan runs:
    /// a conflict is unmet.
    pub rejected: Vec<Rejected>,
    /// Motions that the required relations leave, with given numbers and anchors held.
    pub freedom: usize,
    /// Given numbers that have to yield.
    pub yielded: Vec<SlotIndex>,
    /// Slots without a stay that nothing determines.
    pub free_slots: Vec<SlotIndex>,
}

/// What to do for one system in one edit, for any values.
#[derive(Debug)]
pub struct Plan {
    /// What the planner found out.
    pub report: Report,
    /// The steps and their regions; where all rows are solved one after the other by formula, made when they
    /// are first asked for.
    lowered: OnceCell<Lowered>,
    peeled: Option<Box<Peeled>>,
    /// Slots that stand for several, in order, each with what its scale is multiplied by so that its changes
    /// count for all of them: less than one.
    pub(crate) shares: Vec<(SlotIndex, f64)>,
    /// For every equation, its relation; found when first asked for.
    relation_of: OnceCell<Box<[u32]>>,
    /// The relations that only the host can test.
    pub(crate) opaque: Vec<u32>,
    /// Slots for which another stands, in order, with that one.
    pub(crate) stood_for: Vec<(SlotIndex, SlotIndex)>,
    pub(crate) scale_classes: usize,
    /// True if some of the plain numbers are angles.
    pub(crate) has_angles: bool,
    /// Stretches of slots that are alike, one after the other.
    pub(crate) alike: Vec<Alike>,
    /// True if a step depends on the branch that the state is on.
    pub(crate) has_branches: bool,
    /// True if a step is a curved block of many unknowns, none of which comes before the others.
    pub(crate) has_large_core: bool,
    /// True if a step changes as little as it can.
    pub(crate) has_least: bool,
    /// True if in some step the least change is sought along rows that are curved.
    pub(crate) bends: bool,
    stated: Stated,
    relaxed: OnceCell<Option<Box<Plan>>>,
    /// The places of two coordinates, found when something that hangs on them is carried along.
    coordinates: OnceCell<Places>,
    /// Every equation, laid out to be tested when that is first asked.
    tests: OnceCell<Tests>,
    /// What the latest drag could change.
    slice: RefCell<Option<Rc<Slice>>>,
    /// A state in which every equation holds: where the latest drag began or ended; empty where none is known.
    met_at: RefCell<Vec<f64>>,
    /// What was last moved all at once.
    gathered: RefCell<Option<Rc<Gathered>>>,
}

/// Up to this many rows it is looked at whether one that a given number would yield to is implied.
const IMPLIED_ROWS: usize = 300;

/// Up to this many slots a state that does not hold may be moved as a whole.
const RELAXED_SLOTS: usize = 300;

/// Everything known before blocks are lowered.
pub(crate) struct Analysis<'a> {
    pub(crate) stated: &'a Stated,
    pub(crate) classes: &'a Classes,
    pub(crate) rows: &'a Rows,
    pub(crate) acceptance: Acceptance,
    pub(crate) direction: Direction,
    /// For every relation whose written method was chosen, the slots that that reads, in order.
    pub(crate) method_reads: BTreeMap<u32, Vec<SlotIndex>>,
}

impl Analysis<'_> {
    /// Returns the slots that a row speaks of, or that its method reads.
    pub(crate) fn reads_of_row(&self, row: usize) -> &[SlotIndex] {
        match self.method_reads.get(&self.rows[row].relation) {
            Some(reads) => reads,
            None => self.rows.mentions(row),
        }
    }
    /// Accepts a superfluous row in place of one of its circuit, and goes another way from there; returns
    /// what takes that back.
    fn accept_instead(&mut self, Exchange { dependent, row }: Exchange) -> Exchange {
        let exchanged = &mut self.acceptance.dependent[dependent];
        let now = std::mem::replace(&mut exchanged.row, row);
        let accepted = self.acceptance.accepted.iter_mut().chain(&mut exchanged.circuit);
        accepted.filter(|r| **r == row).for_each(|r| *r = now);
        let system = &self.stated.system;
        let mut known = std::mem::take(&mut self.direction);
        if let Some(slot) = known.slot_of_row[row].take() {
            known.row_of_slot[slot as usize] = None;
        }
        let Self { classes, rows, acceptance, .. } = self;
        self.direction = direct::direct_from(system, classes, rows, acceptance, known);
        self.method_reads = method_reads(system, classes, &self.direction);
        Exchange { dependent, row: now }
    }
}

/// Returns, for every relation whose written method was chosen, the slots that that reads.
fn method_reads(
    system: &System,
    classes: &Classes,
    direction: &Direction,
) -> BTreeMap<u32, Vec<SlotIndex>> {
    let reads = |&(r, m): &(u32, u32)| {
        let body = &system.relations[r as usize].methods[m as usize].body;
        (r, rows::method_reads(system, classes, body))
    };
    direction.methods.iter().map(reads).collect()
}

/// Plans a system over these patterns. Equal systems have equal plans.
pub fn plan(system: &Rc<System>, patterns: &Patterns) -> Plan {
    plan_stated(Stated::new(system, patterns))
}

fn plan_stated(stated: Stated) -> Plan {
    let system = &*stated.system;
    let classes = substitute::substitute(&stated);
    let rows = rows::stated_rows(&stated, &classes);
    let rows = if may_imply_somewhere(system, &classes, &rows) {
        rows
    } else {
        match peel::peel(system, &classes, rows) {
            Found::All(peeled) => return plan_peeled(stated, &classes, peeled),
            Found::Not(rows) => rows,
        }
    };
    let mut rows = rows::with_columns(&stated, &classes, rows);
    let resting = Resting::new(system, &classes, &rows);
    let with = |rows: &Rows, resting: &Resting| {
        let setting = |resting| accept::Setting { system, classes: &classes, rows, resting };
        let acceptance = accept::accept(setting(resting));
        if !acceptance.some_rest || acceptance.yielded.is_empty() {
            return acceptance;
        }
        let mut awake = resting.clone();
        let wakes = awake.wakes((system, &classes, rows), &acceptance.yielded);
        if wakes { accept::accept(setting(&awake)) } else { acceptance }
    };
    let mut acceptance = with(&rows, &resting);
    if (!acceptance.yielded.is_empty() || may_imply(system, &rows))
        && rows.len() <= IMPLIED_ROWS
        && let Some(there) = rows::rows_where_linear_hold(&stated, &classes)
    {
        // nothing yields to a row that says nothing new
        let again = with(&there, &resting);
        if again.yields(&classes) < acceptance.yields(&classes) {
            (rows, acceptance) = (there, again);
        }
    }
    let mut direction = direct::direct(system, &classes, &rows, &mut acceptance);
    let mut is_tied = tie::tie(system, &classes, &rows, &direction, &mut acceptance);
    if is_tied && acceptance.some_rest {
        // what yields along a chain may take with it what would rest
        acceptance = with(&rows, &Resting::default());
        direction = direct::direct(system, &classes, &rows, &mut acceptance);
        is_tied = tie::tie(system, &classes, &rows, &direction, &mut acceptance);
    }
    if is_tied && !direct::is_settled(system, &acceptance) {
        direction = direct::direct(system, &classes, &rows, &mut acceptance);
    }
    let method_reads = method_reads(system, &classes, &direction);
    let mut analysis = Analysis {
        stated: &stated,
        classes: &classes,
        rows: &rows,
        acceptance,
        direction,
        method_reads,
    };
    let (mut findings, together) = report(&analysis);
    let mut blocks = blocks_of(&mut analysis, &together);
    for exchange in view::exchanges(&analysis, &blocks) {
        let back = analysis.accept_instead(exchange);
        let (other, tied) = report(&analysis);
        let split = blocks_of(&mut analysis, &tied);
        if view::together(&split) < view::together(&blocks) {
            (findings, blocks) = (other, split);
        } else {
            analysis.accept_instead(back);
        }
    }
    let lowered = lower::lower(&analysis, &blocks);
    plan_of(stated, &classes, findings, lowered)
}

/// Plans a system whose rows are solved one after the other.
fn plan_peeled(stated: Stated, classes: &Classes, peeled: Peeled) -> Plan {
    let mut is_determined = vec![false; stated.system.slots.len()];
    peeled.order.iter().for_each(|solved| is_determined[solved.target as usize] = true);
    let acceptance = accept::peeled(&stated.system, classes, &peeled.rows, &is_determined);
    let (findings, _) =
        report_on(&stated, classes, &peeled.rows, &acceptance, &|s| is_determined[s as usize]);
    if classes.is_plain() && peeled.is_by_formula(&stated.system) {
        let mut plan = plan_of(stated, classes, findings, Lowered::default());
        plan.lowered = OnceCell::new();
        plan.peeled = Some(Box::new(peeled));
        return plan;
    }
    let lowered = lower_peeled(&stated, classes, &peeled);
    plan_of(stated, classes, findings, lowered)
}

/// Lowers rows that are solved one after the other.
fn lower_peeled(stated: &Stated, classes: &Classes, peeled: &Peeled) -> Lowered {
    let (acceptance, direction, method_reads) = Default::default();
    let rows = &peeled.rows;
    let analysis = Analysis { stated, classes, rows, acceptance, direction, method_reads };
    lower::lower(&analysis, &peeled.blocks())
}

fn plan_of(stated: Stated, classes: &Classes, report: Report, lowered: Lowered) -> Plan {
    let system = &*stated.system;
    let alike = Alike::all(system);
    let (mut has_branches, mut has_large_core) = (false, false);
    let (mut has_least, mut bends) = (false, false);
    for step in &lowered.steps {
        let is_measured = matches!(step.kind, StepKind::LeastChange | StepKind::Compromise);
        has_branches |= is_measured || step.may_branch();
        match &step.program {
            Program::Square(square) => has_large_core |= square.is_large(),
            Program::Least(least) => {
                has_least = true;
                bends |= !least.0.block.is_linear;
            }
            Program::Constant(_)
            | Program::Copy
            | Program::Formulas(..)
            | Program::Inverse(_)
            | Program::Measure(_)
            | Program::Host { .. } => {}
        }
    }
    let opaque = |(r, relation): (u32, &Relation)| match relation.body {
        RelationBody::Equations(_) => None,
        RelationBody::Opaque { .. } => Some(r),
    };
    Plan {
        has_least,
        bends,
        report,
        lowered: lowered.into(),
        peeled: None,
        shares: shares(system, classes),
        opaque: (0..).zip(&system.relations).filter_map(opaque).collect(),
        relation_of: OnceCell::new(),
        stood_for: stood_for(classes),
        scale_classes: alike.iter().map(|a| a.scale as usize + 1).max().unwrap_or(0),
        alike,
        has_angles: stated.has_angles(),
        has_branches,
        has_large_core,
        stated,
        relaxed: OnceCell::new(),
        coordinates: OnceCell::new(),
        tests: OnceCell::new(),
        slice: RefCell::default(),
        met_at: RefCell::default(),
        gathered: RefCell::default(),
    }
}

/// Returns true if places may yield to a row that says nothing new, as far as rows without coefficients tell.
fn may_imply_somewhere(system: &System, classes: &Classes, rows: &Rows) -> bool {
    let says = |r: &usize, is_linear: bool| {
        rows[*r].level == Level::Required
            && rows.kernel(*r).is_some_and(|k| k.is_linear() == is_linear)
    };
    let ties = |r: usize| {
        let reads = system.reads(&system.relations[rows[r].relation as usize]);
        let is_read = |slot| reads.iter().any(|&s| classes.representative[s as usize] == slot);
        let moves =
            |&&slot: &&SlotIndex| classes.stay[slot as usize] != Stay::Fixed && !is_read(slot);
        rows.mentions(r).iter().filter(moves).nth(1).is_some()
    };
    rows.len() <= IMPLIED_ROWS
        && system.slots.iter().all(|s| s.stay != Stay::Free)
        && (0..rows.len()).filter(|r| says(r, false)).nth(1).is_some()
        && (0..rows.len()).filter(|r| says(r, true)).any(ties)
}

/// Returns true if places may yield to a row that says nothing new where the linear ones hold: only where some
/// that tie slots stand among curved ones, and everything has a value to stay at.
fn may_imply(system: &System, rows: &Rows) -> bool {
    let is_required = |r: &usize| rows[*r].level == Level::Required;
    let required = || (0..rows.len()).filter(is_required);
    let ties = |r: usize| !rows[r].curved && rows.kernel(r).is_some() && rows.columns(r).len() > 1;
    system.slots.iter().all(|s| s.stay != Stay::Free)
        && required().any(ties)
        && required().filter(|&r| rows[r].curved).nth(1).is_some()
}

fn shares(system: &System, classes: &Classes) -> Vec<(SlotIndex, f64)> {
    let share = |(root, members): (SlotIndex, &[SlotIndex])| {
        let stay = std::mem::discriminant(&classes.stay[root as usize]);
        let of = |s: SlotIndex| std::mem::discriminant(&system.slots[s as usize].stay);
        let alike = members.iter().filter(|&&s| of(s) == stay).count();
        (alike > 1).then(|| (root, 1.0 / (alike as f64).sqrt()))
    };
    classes.members().filter_map(share).collect()
}

/// States what was rejected, and which rows have to be solved together because they compromise.
fn report(analysis: &Analysis<'_>) -> (Report, Vec<Vec<usize>>) {
    let Analysis { stated, classes, rows, acceptance, direction, .. } = analysis;
    report_on(stated, classes, rows, acceptance, &|s| {
        direction.row_of_slot[s as usize].is_some() || direction.is_written(s)
    })
}

fn report_on(
    stated: &Stated,
    classes: &Classes,
    rows: &Rows,
    acceptance: &Acceptance,
    is_determined: &dyn Fn(SlotIndex) -> bool,
) -> (Report, Vec<Vec<usize>>) {
    let mut together = Vec::new();
    let mut rejected: Vec<Rejected> = classes
        .repeated
        .iter()
        .map(|&((relation, row), ref circuit)| Rejected {
            relation,
            row,
            circuit: circuit.clone(),
            compromises: false,
        })
        .collect();
    for dependent in &acceptance.dependent {
        let row = rows[dependent.row];
        let level = row.level;
        // what is true or not is met or not met: that which was accepted is
        let is_number = |kernel: &Rc<Kernel>| {
            let (arena, sides) = kernel.expressions();
            let arguments = rows.mentions(dependent.row);
            let of_slot = |argument: u32| {
                let slot = arguments[argument as usize];
                stated.system.slots[slot as usize].scale == TRUTH
            };
            !sides.iter().all(|&side| is_truth(arena, side, &of_slot))
        };
        let compromises = level != Level::Required
            && rows.kernel(dependent.row).is_some_and(is_number)
            && dependent.circuit.iter().any(|&c| rows[c].level == level);
        if compromises {
            let mut set = vec![dependent.row];
            set.extend(&dependent.circuit);
            together.push(set);
        }
        rejected.push(Rejected {
            relation: row.relation,
            row: row.equation,
            circuit: dependent
                .circuit
                .iter()
                .map(|&c| (rows[c].relation, rows[c].equation))
                .collect(),
            compromises,
        });
    }
    let slots = &stated.system.slots;
    let mut yielded = acceptance.yielded.clone();
    let has_yielded = |root| acceptance.yielded.binary_search(&root).is_ok();
    for (root, members) in classes.members() {
        let given = |&&s: &&SlotIndex| slots[s as usize].stay.is_given();
        if classes.stay[root as usize] == Stay::Fixed || has_yielded(root) {
            yielded.extend(members.iter().filter(given));
        }
    }
    for &(s, _) in &classes.constants {
        if slots[s as usize].stay.is_given() {
            yielded.push(s);
        }
    }
    yielded.sort_unstable();
    yielded.dedup();
    let free_slots = (0..slots.len() as u32)
        .filter(|&s| {
            acceptance.unknown[s as usize]
                && classes.stay[s as usize] == Stay::Free
                && !is_determined(s)
        })
        .collect();
    (Report { rejected, freedom: acceptance.freedom, yielded, free_slots }, together)
}

fn blocks_of(analysis: &mut Analysis<'_>, together: &[Vec<usize>]) -> Blocks {
    let Analysis { stated, rows, acceptance, direction, .. } = &mut *analysis;
    let is_settled = direct::is_settled(&stated.system, acceptance);
    let exchangeable = acceptance.exchangeable.take();
    if let Some(matched) = acceptance.matched.take() {
        // where every slot that may move has its row, what acceptance found are the blocks
        let unknown = acceptance.unknown.iter().filter(|u| **u).count();
        if unknown == acceptance.accepted.len() && direction.methods.is_empty() {
            return matched.blocks;
        }
        let (blocks, unknown) = (&matched.blocks, &acceptance.unknown);
        let find = || order::exchangeable(blocks, rows, unknown, direction);
        let beside = || {
            let free = exchangeable.or_else(find)?;
            order::beside_free(blocks, rows, (unknown, &free), direction)
        };
        if let Some(blocks) = is_settled.then(beside).flatten() {
            return blocks;
        }
    }
    let mut taking_part = analysis.acceptance.accepted.clone();
    taking_part.extend(together.iter().map(|set| set[0]));
    taking_part.sort_unstable();
    taking_part.dedup();
    order::order(&Incidence {
        rows: analysis.rows,
        taking_part: &taking_part,
        unknown: &analysis.acceptance.unknown,
        direction: &analysis.direction,
        method_reads: &analysis.method_reads,
        together,
    })
}

fn stood_for(classes: &Classes) -> Vec<(SlotIndex, SlotIndex)> {
    let all = (0..).zip(classes.representative.iter().copied());
    all.filter(|(slot, root)| slot != root).collect()
}

impl Plan {
    /// Returns how many given numbers yield: of those that the document gives, then of defaults. What is less yields
    /// less.
    pub fn yields(&self) -> [usize; 2] {
        let mut yields = [0; 2];
        for &slot in &self.report.yielded {
            if let Stay::Given(giver) = self.slots()[slot as usize].stay {
                yields[giver as usize] += 1;
            }
        }
        yields
    }
    /// Returns the steps, in order.
    pub fn steps(&self) -> &[Step] {
        &self.lowered().steps
    }
    /// Returns the steps, if some may have several solutions.
    pub(crate) fn branching(&self) -> &[Step] {
        match self.peeled() {
            Some(_) => &[],
            None => self.steps(),
        }
    }
    /// Returns the slots that the steps write, in their order.
    pub fn targets(&self) -> impl Iterator<Item = SlotIndex> + '_ {
        let peeled = self.peeled().map_or(&[][..], |peeled| &peeled.order);
        let steps = self.branching().iter().flat_map(|step| &step.targets).copied();
        peeled.iter().map(|solved| solved.target).chain(steps)
    }
    /// Returns true if rows that bend are solved for several unknowns at once, or by one of several roots.
    pub fn is_curved(&self) -> bool {
        self.has_branches || self.bends
    }
    /// Returns true if some rows bend, though what is solved for by them may not.
    pub fn speaks_of_bends(&self) -> bool {
        self.is_curved() || self.stated.has_bends()
    }
    /// Returns how many steps there are.
    pub fn step_count(&self) -> usize {
        self.peeled().map_or_else(|| self.steps().len(), |peeled| peeled.order.len())
    }
    pub(crate) fn regions(&self) -> &[Region] {
        &self.lowered().regions
    }
    fn lowered(&self) -> &Lowered {
        self.lowered.get_or_init(|| {
            let lower = |peeled: &Peeled| {
                lower_peeled(&self.stated, &substitute::substitute(&self.stated), peeled)
            };
            self.peeled().map(lower).unwrap_or_default()
        })
    }
    /// Returns the rows in the order of the steps, where each step is a row that is solved by formula.
    pub(crate) fn peeled(&self) -> Option<&Peeled> {
        self.peeled.as_deref()
    }
    /// Returns the scale of a slot, and when its change counts.
    pub(crate) fn kind(&self, slot: SlotIndex) -> (u16, Turn) {
        let slot = &self.slots()[slot as usize];
        (slot.scale, slot.stay.turn())
    }
    /// Returns the slots of the system.
    pub(crate) fn slots(&self) -> &[Slot] {
        &self.system().slots
    }
    pub(crate) fn system(&self) -> &System {
        &self.stated.system
    }
    /// Returns the pattern of an equation, by its place among those that the system uses.
    pub(crate) fn pattern_place(&self, row: u32) -> usize {
        self.stated.place_of(row as usize)
    }
    /// Returns a relation of the system.
    pub(crate) fn relation(&self, relation: u32) -> &Relation {
        &self.system().relations[relation as usize]
    }
    /// Returns how many relations the system has.
    pub(crate) fn relation_count(&self) -> u32 {
        self.system().relations.len() as u32
    }
    /// Returns the equations of a relation, by their places in the system.
    pub(crate) fn rows_of(&self, relation: u32) -> Range<u32> {
        match self.relation(relation).body {
            RelationBody::Equations(span) => span.start..span.start + span.len,
            RelationBody::Opaque { .. } => 0..0,
        }
    }
    /// Returns the equations of a relation.
    pub(crate) fn places(&self, relation: u32) -> impl Iterator<Item = Place> + use<> {
        self.rows_of(relation).map(move |row| Place { relation, row })
    }
    /// Returns an equation with the relation that it is of.
    pub(crate) fn place_of(&self, row: u32) -> Place {
        let of = |system: &System| {
            let mut of = vec![0; system.equations.len()];
            for r in 0..self.relation_count() {
                self.rows_of(r).for_each(|row| of[row as usize] = r);
            }
            of.into()
        };
        let relation_of = self.relation_of.get_or_init(|| of(self.system()));
        Place { relation: relation_of[row as usize], row }
    }
    /// Returns the place of the equation that a row is of.
    pub(crate) fn place_of_row(&self, rows: &Rows, row: u32) -> u32 {
        let row = rows[row as usize];
        self.rows_of(row.relation).start + row.equation
    }
    pub(crate) fn pattern_at(&self, place: usize) -> &Pattern {
        self.stated.pattern_at(place)
    }
    pub(crate) fn pattern_count(&self) -> usize {
        self.stated.pattern_count()
    }
    /// Returns every equation, laid out to be tested.
    pub(crate) fn tests(&self) -> &Tests {
        self.tests.get_or_init(|| Tests::new(self, &(0..self.relation_count())))
    }
    /// Returns what moving these known slots can change; made once.
    pub(crate) fn slice(&self, inputs: &[SlotIndex]) -> Rc<Slice> {
        let mut known = self.slice.borrow_mut();
        if let Some(slice) = known.as_ref().filter(|s| s.inputs == inputs) {
            return slice.clone();
        }
        let made = Rc::new(Slice::new(self, inputs));
        *known = Some(made.clone());
        made
    }
    /// Returns true if every equation is known to hold in a state.
    pub(crate) fn is_met_at(&self, state: &[f64]) -> bool {
        let known = self.met_at.borrow();
        let is_same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
        !known.is_empty() && known.len() == state.len() && known.iter().zip(state).all(is_same)
    }
    /// Notes a state in which every equation holds.
    pub(crate) fn note_met_at(&self, state: Vec<f64>) {
        self.met_at.replace(state);
    }
    /// Returns what moves these unknowns all at once until these equations hold, given by their places in the
    /// system; made once while they are the same.
    pub(crate) fn gathered(
        &self,
        mut equations: Vec<u32>,
        mut unknowns: Vec<SlotIndex>,
    ) -> Rc<Gathered> {
        equations.sort_unstable();
        unknowns.sort_unstable();
        let mut known = self.gathered.borrow_mut();
        if let Some(gathered) = known.as_ref().filter(|g| g.is_of(&equations, &unknowns)) {
            return gathered.clone();
        }
        let joint = Joint::new(&self.problem(&equations, &unknowns));
        let made = Rc::new(Gathered { equations, unknowns, joint });
        *known = Some(made.clone());
        made
    }
    /// Returns these equations, by their places in the system, as rows over these unknowns, both in order; those
    /// that substitution makes hold, that are opaque or that speak of none of these are left out.
    fn problem(&self, equations: &[u32], unknowns: &[SlotIndex]) -> Problem {
        let classes = substitute::substitute(&self.stated);
        let rows = rows::stated_rows(&self.stated, &classes);
        let is_unknown = |slot: &SlotIndex| unknowns.binary_search(slot).is_ok();
        let row = |r: usize| {
            let place = self.place_of_row(&rows, r as u32);
            equations.binary_search(&place).ok()?;
            rows.mentions(r)
                .iter()
                .any(is_unknown)
                .then(|| lower::problem_row(self.system(), &rows, r))?
        };
        Problem { rows: (0..rows.len()).filter_map(row).collect(), unknowns: unknowns.to_vec() }
    }
    /// Returns every slot that a relation speaks of.
    pub(crate) fn mentions(&self, relation: u32) -> impl Iterator<Item = SlotIndex> + '_ {
        let (system, relation) = (self.system(), self.relation(relation));
        let equations = system.equations_of(relation).iter();
        let stated = equations.flat_map(|e| system.arguments(e.arguments));
        let opaque = match &relation.body {
            RelationBody::Equations(_) => &[][..],
            RelationBody::Opaque { slots } => slots,
        };
        stated.chain(opaque).copied()
    }
    /// Returns true if something has no value yet that it could keep.
    pub fn opens(&self) -> bool {
        self.slots().iter().any(|s| s.stay == Stay::Free)
    }
    /// Returns true if these relations, which do not hold, may hold elsewhere: they are the host's, and some of its
    /// methods read what comes after them, as in a ring, which is run once round.
    pub fn may_hold_elsewhere(&self, mut unmet: impl Iterator<Item = u32>) -> bool {
        let mut writer = vec![0; self.slots().len()];
        for (i, step) in self.steps().iter().enumerate() {
            step.targets.iter().for_each(|&t| writer[t as usize] = i);
        }
        let is_early = |(i, step): (usize, &Step)| {
            matches!(step.program, Program::Host { .. })
                && step.reads.iter().any(|&r| writer[r as usize] > i)
        };
        unmet.all(|r| self.opaque.binary_search(&r).is_ok())
            && self.steps().iter().enumerate().any(is_early)
    }
    /// Returns true if some of its relations are tested by the host.
    pub fn asks_host(&self) -> bool {
        !self.opaque.is_empty()
    }
    /// Returns true if a whole number is unknown.
    pub(crate) fn has_whole_unknowns(&self) -> bool {
        self.slots().iter().any(|s| s.is_number && s.is_discrete && s.stay != Stay::Fixed)
    }
    /// The places of two coordinates.
    pub(crate) fn coordinates(&self) -> &Places {
        self.coordinates.get_or_init(|| Places::new(&self.stated.system, &self.stood_for))
    }
    /// The plan in which every place may yield: for a state that does not hold, where those that
    /// structure lets yield cannot reach far enough. None where nothing more would yield.
    pub(crate) fn relaxed(&self) -> Option<&Plan> {
        let make = || {
            let mut system = (*self.stated.system).clone();
            let kept = |s: &&mut Slot| matches!(s.stay, Stay::Kept { .. });
            let mut yields = false;
            for slot in system.slots.iter_mut().filter(kept) {
                slot.stay = Stay::Free;
                yields = true;
            }
            (yields && system.slots.len() <= RELAXED_SLOTS)
                .then(|| Box::new(plan_stated(self.stated.with(system))))
        };
        self.relaxed.get_or_init(make).as_deref()
    }
    /// Returns one line a step: kind, targets, what they come from, the relations that then hold.
    pub fn describe(&self, name: &dyn Fn(SlotIndex) -> String) -> Vec<String> {
        let list =
            |slots: &[SlotIndex]| slots.iter().map(|&s| name(s)).collect::<Vec<_>>().join(", ");
        self.steps()
            .iter()
            .map(|step| {
                let kind = match step.kind {
                    StepKind::Alias => "alias".to_owned(),
                    StepKind::Method { method, .. } => format!("method {method}"),
                    StepKind::Inverse { roots: 1 } => "inverse".to_owned(),
                    StepKind::Inverse { roots } => format!("inverse of {roots} roots"),
                    StepKind::Linear => "linear".to_owned(),
                    StepKind::Closed => "closed form".to_owned(),
                    StepKind::Newton => "newton".to_owned(),
                    StepKind::LeastChange => "least change".to_owned(),
                    StepKind::Compromise => "compromise".to_owned(),
                    StepKind::Opaque { method, .. } => format!("host method {method}"),
                };
                let relations: Vec<String> =
                    step.relations.iter().map(ToString::to_string).collect();
                format!(
                    "{} := {kind} from {} [{}]",
                    list(&step.targets),
                    list(&step.reads),
                    relations.join(" ")
                )
            })
            .collect()
    }
}
