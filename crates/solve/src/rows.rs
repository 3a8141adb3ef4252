//! Rows: every equation once, over representatives, with its gradient at a generic point.
//!
//! In: the system and its classes. Out: one [`Row`] for each equation that substitution left (one for
//! an opaque relation). The point is the same for every system, so no value is consulted: a
//! coefficient is zero there only if it is zero everywhere.

use crate::stated::Stated;
use crate::substitute::Classes;
use crate::system::{Level, MethodBody, Relation, RelationBody, SlotIndex, Stay, System};
use crate::tableau::SparseRow;
use expr::{Arena, Binary, ExprId, Node, Tape, Unary, Var};
use std::collections::BTreeSet;

/// One scalar condition.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// The relation that it belongs to.
    pub(crate) relation: u32,
    /// Which of the relation's equations it is; zero for an opaque relation.
    pub(crate) equation: u32,
    /// The relation's level.
    pub(crate) level: Level,
    /// Both sides; none for an opaque relation.
    pub(crate) sides: Option<(ExprId, ExprId)>,
    /// Every slot that it speaks of.
    pub(crate) mentions: BTreeSet<SlotIndex>,
    /// The slots that it may write, with generic coefficients.
    pub(crate) columns: SparseRow,
    /// The tolerance of its sides.
    pub(crate) within: f64,
    /// True if a derivative by a slot that it may write depends on one.
    pub(crate) curved: bool,
}

impl Row {
    /// Returns true if the row may write the slot.
    pub(crate) fn writes(&self, slot: SlotIndex) -> bool {
        self.columns.binary_search_by_key(&slot, |e| e.0).is_ok()
    }
}

/// Makes every row, in order of relation and equation.
pub(crate) fn rows(stated: &Stated, classes: &Classes, arena: &mut Arena) -> Vec<Row> {
    let system = &*stated.system;
    let mut rows = Vec::new();
    let mut derivatives: Vec<(usize, SlotIndex, ExprId)> = Vec::new();
    for (r, relation) in system.relations.iter().enumerate() {
        let writable = Writable::of(relation, classes);
        match &relation.body {
            RelationBody::Equations(_) => {
                for (e, equation) in system.equations_of(relation).iter().enumerate() {
                    let key = (r as u32, e as u32);
                    if classes.used.contains_key(&key) || classes.repeated.contains_key(&key) {
                        continue;
                    }
                    let sides = stated.write_out(
                        arena,
                        &classes.representative,
                        equation.pattern,
                        equation.arguments,
                    );
                    let residual = arena.sub(sides[0], sides[1]);
                    let mut mentions: BTreeSet<SlotIndex> =
                        arena.variables(sides[0]).iter().map(|v| v.0).collect();
                    mentions.extend(arena.variables(sides[1]).iter().map(|v| v.0));
                    let vars: Vec<Var> = mentions
                        .iter()
                        .filter(|&&slot| writable.allows(classes, slot))
                        .map(|&slot| Var(slot))
                        .collect();
                    let gradient = expr::gradient(arena, residual, &vars);
                    derivatives
                        .extend(vars.iter().zip(gradient).map(|(v, d)| (rows.len(), v.0, d)));
                    let curved = !expr::is_linear_in(arena, residual, &vars);
                    rows.push(Row {
                        curved,
                        ..row(r, e, relation, Some((sides[0], sides[1])), mentions)
                    });
                }
            }
            RelationBody::Opaque { slots } => {
                let mentions = slots.iter().map(|&s| classes.representative[s as usize]).collect();
                rows.push(row(r, 0, relation, None, mentions));
            }
        }
    }
    set_coefficients(system, arena, &mut rows, &derivatives);
    add_written_targets(system, classes, &mut rows);
    rows
}

fn row(
    relation_index: usize,
    equation: usize,
    relation: &Relation,
    sides: Option<(ExprId, ExprId)>,
    mentions: BTreeSet<SlotIndex>,
) -> Row {
    Row {
        relation: relation_index as u32,
        equation: equation as u32,
        level: relation.level,
        sides,
        mentions,
        columns: Vec::new(),
        within: f64::from_bits(relation.within),
        curved: false,
    }
}

/// Which slots a relation may write.
struct Writable {
    never: BTreeSet<SlotIndex>,
    only: Option<BTreeSet<SlotIndex>>,
}

impl Writable {
    fn of(relation: &Relation, classes: &Classes) -> Self {
        let representative = |s: &SlotIndex| classes.representative[*s as usize];
        let written = !relation.derived && !relation.methods.is_empty();
        let opaque = matches!(relation.body, RelationBody::Opaque { .. });
        Self {
            never: relation.reads.iter().map(representative).collect(),
            only: (written || opaque).then(|| {
                relation.methods.iter().flat_map(|m| m.targets.iter().map(representative)).collect()
            }),
        }
    }
    fn allows(&self, classes: &Classes, slot: SlotIndex) -> bool {
        classes.stay[slot as usize] != Stay::Fixed
            && !self.never.contains(&slot)
            && self.only.as_ref().is_none_or(|only| only.contains(&slot))
    }
}

/// Evaluates all derivatives at the first of a few generic points that suits them best.
fn set_coefficients(
    system: &System,
    arena: &Arena,
    rows: &mut [Row],
    derivatives: &[(usize, SlotIndex, ExprId)],
) {
    let ids: Vec<ExprId> = derivatives.iter().map(|d| d.2).collect();
    let tape = Tape::compile(arena, &ids);
    let mut registers = Vec::new();
    let mut best = (usize::MAX, Vec::new());
    for point in Point::ALL {
        let values: Vec<f64> =
            (0..system.slots.len()).map(|i| generic_number(i as u64, point)).collect();
        let mut out = vec![0.0; ids.len()];
        tape.run(&values, &mut registers, &mut out);
        let bad = out.iter().filter(|v| !v.is_finite()).count();
        if bad < best.0 {
            best = (bad, out);
        }
        if bad == 0 {
            break;
        }
    }
    let branching = branching(arena);
    for (&(row, slot, id), &value) in derivatives.iter().zip(&best.1) {
        let by_branch = value == 0.0 && branching[id.0 as usize];
        let value = if value.is_finite() && !by_branch {
            value
        } else {
            generic_number((row as u64) << 32 | u64::from(slot), Point::Mixed)
        };
        if value != 0.0 {
            rows[row].columns.push((slot, value));
        }
    }
    for row in rows {
        let largest = row.columns.iter().fold(0.0f64, |m, e| m.max(e.1.abs()));
        for entry in &mut row.columns {
            entry.1 /= largest;
        }
    }
}

/// A written target that no derivative shows is one all the same.
fn add_written_targets(system: &System, classes: &Classes, rows: &mut [Row]) {
    let mut start = 0;
    while start < rows.len() {
        let r = rows[start].relation;
        let end = start + rows[start..].iter().take_while(|row| row.relation == r).count();
        let relation = &system.relations[r as usize];
        let writable = Writable::of(relation, classes);
        for target in relation.methods.iter().flat_map(|m| &m.targets) {
            let slot = classes.representative[*target as usize];
            let shown = rows[start..end].iter().any(|row| row.writes(slot));
            if shown || !writable.allows(classes, slot) {
                continue;
            }
            for (i, row) in rows[start..end].iter_mut().enumerate() {
                let value =
                    generic_number(((start + i) as u64) << 32 | u64::from(slot), Point::Mixed);
                let at = row.columns.partition_point(|e| e.0 < slot);
                row.columns.insert(at, (slot, value));
            }
        }
        start = end;
    }
}

/// For every expression, whether its value depends on a choice.
fn branching(arena: &Arena) -> Vec<bool> {
    let mut found: Vec<bool> = Vec::with_capacity(arena.len());
    for i in 0..arena.len() {
        let of = |id: ExprId| found[id.0 as usize];
        let branches = match arena.node(ExprId(i as u32)) {
            Node::Constant(_) | Node::Var(_) => false,
            Node::Unary(op, a) => {
                matches!(op, Unary::Abs | Unary::Sign | Unary::Floor | Unary::Round | Unary::Not)
                    || of(a)
            }
            Node::Binary(op, a, b) => {
                matches!(
                    op,
                    Binary::Min
                        | Binary::Max
                        | Binary::Less
                        | Binary::LessEqual
                        | Binary::Equal
                        | Binary::NotEqual
                ) || of(a)
                    || of(b)
            }
            Node::Select { .. } => true,
        };
        found.push(branches);
    }
    found
}

/// Where gradients are taken.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Point {
    /// Both signs.
    Mixed,
    /// Positive: square roots and logarithms of slots are defined.
    Positive,
    /// Positive and small: arcs are defined.
    Small,
}

impl Point {
    const ALL: [Self; 3] = [Self::Mixed, Self::Positive, Self::Small];
}

/// Returns a number that depends on `seed` alone and on nothing else that could coincide.
pub(crate) fn generic_number(seed: u64, point: Point) -> f64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    let unit = (z >> 11) as f64 / (1u64 << 53) as f64;
    match point {
        Point::Mixed if z & 1 == 1 => -(0.6 + 1.3 * unit),
        Point::Mixed | Point::Positive => 0.6 + 1.3 * unit,
        Point::Small => 0.05 + 0.4 * unit,
    }
}

/// Collects the slots that a method reads, over representatives.
pub(crate) fn method_reads(
    system: &System,
    classes: &Classes,
    body: &MethodBody,
) -> BTreeSet<SlotIndex> {
    let reads = match body {
        MethodBody::Formulas { arguments, .. } => system.arguments(*arguments),
        MethodBody::Opaque { reads } => reads,
    };
    reads.iter().map(|&s| classes.representative[s as usize]).collect()
}
