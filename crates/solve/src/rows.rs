//! Rows: every equation once, over representatives, with its gradient at a generic point.
//!
//! In: the system and its classes. Out: one [`Row`] for each equation that substitution left (one for
//! an opaque relation). The point is the same for every row, so no value is consulted: a
//! coefficient is zero there only if it is zero everywhere.

use crate::dense;
use crate::few::Few;
use crate::kernel::exact::Exact;
use crate::kernel::{Form, Kernel};
use crate::lanes::{LaneScratch, Out, Outs, WIDE};
use crate::lists::Lists;
use crate::residue::Residue;
use crate::stated::Stated;
use crate::substitute::Classes;
use crate::system::{Level, MethodBody, Relation, RelationBody, SlotIndex, Span, Stay, System};
use base::scrambled;
use expr::LANES;
use std::collections::BTreeSet;
use std::rc::Rc;

/// One scalar condition.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// The relation that it belongs to.
    pub(crate) relation: u32,
    /// Which of the relation's equations it is; zero for an opaque relation.
    pub(crate) equation: u32,
    /// The relation's level.
    pub(crate) level: Level,
    /// True if a derivative by a slot that it may write depends on one.
    pub(crate) curved: bool,
    /// Its kernel's place among those of all rows.
    pub(crate) kernel: u32,
    mentions: Span,
}

/// Pivots smaller than this part of the largest may be a matter of rounding.
pub(crate) const REGULAR: f64 = 1e-11;

/// The kernel of an opaque row.
const OPAQUE: u32 = u32::MAX;

/// A column of a row: a slot that it may write, and its generic coefficient.
pub(crate) type Entry = (SlotIndex, f64);

/// All rows, in order of relation and equation.
#[derive(Debug, Default)]
pub(crate) struct Rows {
    list: Vec<Row>,
    kernels: Vec<Rc<Kernel>>,
    mentions: Mentions,
    /// Where the columns of every row stand, once they are there.
    spans: Vec<Span>,
    columns: Vec<Entry>,
    /// Where the coefficients were taken, if that is a point where nothing is known of any slot.
    point: Option<Point>,
}

/// What rows speak of, one row's after the other's.
#[derive(Debug)]
enum Mentions {
    /// The arguments of a system's equations, each of which stands for itself.
    Stated(Rc<System>),
    Own(Vec<SlotIndex>),
}

impl Default for Mentions {
    fn default() -> Self {
        Self::Own(Vec::new())
    }
}

impl Mentions {
    fn all(&self) -> &[SlotIndex] {
        match self {
            Self::Stated(system) => &system.arguments,
            Self::Own(own) => own,
        }
    }
    /// Returns them to be added to.
    fn own(&mut self) -> &mut Vec<SlotIndex> {
        if let Self::Stated(system) = self {
            *self = Self::Own(system.arguments.clone());
        }
        match self {
            Self::Own(own) => own,
            Self::Stated(_) => unreachable!("they were copied"),
        }
    }
}

impl Rows {
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }
    /// Returns every slot that a row speaks of; of an equation, the arguments of its kernel.
    pub(crate) fn mentions(&self, row: usize) -> &[SlotIndex] {
        &self.mentions.all()[self.list[row].mentions.range()]
    }
    /// Returns the slots that a row may write, in order, with generic coefficients; none before these are found.
    pub(crate) fn columns(&self, row: usize) -> &[Entry] {
        self.spans.get(row).map_or(&[], |span| &self.columns[span.range()])
    }
    /// Computes the columns of these rows with coefficients in a finite field; none where one is made of what
    /// has no counterpart there.
    pub(crate) fn residues(&self, rows: &[u32]) -> Option<Vec<Vec<(SlotIndex, Residue)>>> {
        let point = self.point?;
        let (mut arguments, mut work, mut slopes) = (Vec::new(), Vec::new(), Vec::new());
        let own = |&r: &u32| {
            let kernel = self.kernel(r as usize)?;
            let mentions = self.mentions(r as usize);
            arguments.clear();
            arguments.extend(mentions.iter().map(|&slot| Exact::generic(slot, point)));
            kernel.exact_slopes(&arguments, &mut work, &mut slopes).then_some(())?;
            let of = |&(slot, _): &Entry| {
                let is_own = |e: &crate::kernel::Entry| mentions[e.argument as usize] == slot;
                let at = kernel.entries.iter().position(is_own);
                let told = at.map(|at| slopes[at]).filter(|slope| !slope.is_zero());
                let drawn = || Residue::drawn(u64::from(r) << 32 | u64::from(slot));
                (slot, told.unwrap_or_else(drawn))
            };
            Some(self.columns(r as usize).iter().map(of).collect())
        };
        rows.iter().map(own).collect()
    }
    /// Returns the columns of these rows.
    pub(crate) fn doubles(&self, rows: &[u32]) -> Vec<Vec<Entry>> {
        rows.iter().map(|&r| self.columns(r as usize).to_vec()).collect()
    }
    /// Returns true if a row says that a place lies on a line, wherever others are: as an equation for its
    /// coordinates it is of the first degree, as that of a point at equal distances from two others is.
    pub(crate) fn is_line(&self, row: usize, place: &[SlotIndex]) -> bool {
        let mentions = self.mentions(row);
        let own: Few =
            (0..).zip(mentions).filter(|m| place.contains(m.1)).map(|m: (u32, _)| m.0).collect();
        self.kernel(row).is_some_and(|kernel| {
            let mut of_own = kernel.entries.iter().filter(|entry| own.contains(&entry.argument));
            if !of_own.any(|entry| entry.depends.iter().any(|a| own.contains(a))) {
                return true;
            }
            let [first, second] = own[..] else { return false };
            kernel.curve([first, second]).is_some_and(|c| c.form == Form::Line)
        })
    }
    /// Returns what rows say, each once.
    pub(crate) fn kernels(&self) -> &[Rc<Kernel>] {
        &self.kernels
    }
    /// Returns what a row says; nothing for an opaque one.
    pub(crate) fn kernel(&self, row: usize) -> Option<&Rc<Kernel>> {
        self.kernels.get(self.list[row].kernel as usize)
    }
}

impl std::ops::Index<usize> for Rows {
    type Output = Row;
    fn index(&self, row: usize) -> &Row {
        &self.list[row]
    }
}

/// Gives rows their columns.
pub(crate) fn with_columns(stated: &Stated, classes: &Classes, mut rows: Rows) -> Rows {
    let (point, slopes) = slopes(&rows, stated.system.slots.len());
    rows.point = Some(point);
    set_columns(&stated.system, classes, &mut rows, &slopes);
    rows
}

/// Makes the rows with the derivatives that they have where the required linear ones hold: there a row
/// that they and others imply shows that it does. None where none is linear.
pub(crate) fn rows_where_linear_hold(stated: &Stated, classes: &Classes) -> Option<Rows> {
    let mut rows = stated_rows(stated, classes);
    let is_linear = |r: &usize| {
        rows[*r].level == Level::Required && rows.kernel(*r).is_some_and(|k| k.is_linear())
    };
    let linear: Vec<usize> = (0..rows.len()).filter(is_linear).collect();
    let n = stated.system.slots.len();
    let mut values: Vec<f64> = (0..n as u64).map(|i| generic_number(i, Point::Mixed)).collect();
    let at = evaluate(&rows, &values);
    let mut system = Vec::with_capacity(linear.len());
    for &r in &linear {
        let kernel = rows.kernel(r)?;
        let mut row = vec![0.0; n + 1];
        let mentions = rows.mentions(r);
        for (entry, slope) in kernel.entries.iter().zip(&at.slopes[at.first[r]..]) {
            row[mentions[entry.argument as usize] as usize] += slope;
        }
        row[n] = -at.errors[r];
        system.push(row);
    }
    let may_move = |s: usize| classes.stay[s] != Stay::Fixed;
    move_onto(system, &may_move, &mut values);
    let slopes = evaluate(&rows, &values).slopes;
    let is_usable = !linear.is_empty() && slopes.iter().all(|slope| slope.is_finite());
    set_columns(&stated.system, classes, &mut rows, &slopes);
    is_usable.then_some(rows)
}

/// Moves a point so that linear equations in the differences hold as far as what may move allows.
fn move_onto(mut system: Vec<Vec<f64>>, may_move: &dyn Fn(usize) -> bool, values: &mut [f64]) {
    const SMALL: f64 = 1e-9;
    let n = values.len();
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    for r in 0..system.len() {
        let sizes = (0..n).filter(|&c| may_move(c)).map(|c| (c, system[r][c].abs()));
        let Some((pivot, size)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else { continue };
        if size <= SMALL {
            continue;
        }
        let row = std::mem::take(&mut system[r]);
        for other in system.iter_mut().filter(|other| !other.is_empty() && other[pivot] != 0.0) {
            let factor = other[pivot] / row[pivot];
            other.iter_mut().zip(&row).for_each(|(x, y)| *x -= factor * y);
        }
        system[r] = row;
        pivots.push((r, pivot));
    }
    for (r, pivot) in pivots {
        values[pivot] += system[r][n] / system[r][pivot];
    }
}

/// Makes the rows without their columns.
pub(crate) fn stated_rows(stated: &Stated, classes: &Classes) -> Rows {
    let system = &*stated.system;
    let mut rows = Rows::default();
    rows.list.reserve(system.equations.len());
    rows.mentions = match classes.is_plain() {
        true => Mentions::Stated(stated.system.clone()),
        false => Mentions::Own(Vec::with_capacity(system.arguments.len())),
    };
    let mut kernels = Kernels::default();
    for (r, relation) in (0..).zip(&system.relations) {
        let one = Row {
            relation: r,
            equation: 0,
            level: relation.level,
            curved: false,
            kernel: OPAQUE,
            mentions: Span::default(),
        };
        match &relation.body {
            RelationBody::Equations(span) => {
                for (e, at) in (0..).zip(span.range()) {
                    if classes.is_settled(at) {
                        continue;
                    }
                    let over = system.equations[at].arguments;
                    let arguments = system.arguments(over);
                    let pattern = stated.place_of(at);
                    if matches!(rows.mentions, Mentions::Stated(_)) && are_distinct(arguments) {
                        let kernel = kernels.plain(stated, pattern);
                        rows.list.push(Row { equation: e, kernel, mentions: over, ..one });
                        continue;
                    }
                    let all = rows.mentions.own();
                    let start = all.len();
                    all.extend(arguments.iter().map(|&s| classes.representative[s as usize]));
                    let kernel = if are_distinct(&all[start..]) {
                        kernels.plain(stated, pattern)
                    } else {
                        kernels.identified(stated, pattern, all, start)
                    };
                    let mentions = Span { start: start as u32, len: (all.len() - start) as u32 };
                    rows.list.push(Row { equation: e, kernel, mentions, ..one });
                }
            }
            RelationBody::Opaque { slots } => {
                let over: BTreeSet<SlotIndex> =
                    slots.iter().map(|&s| classes.representative[s as usize]).collect();
                let all = rows.mentions.own();
                let mentions = Span { start: all.len() as u32, len: over.len() as u32 };
                all.extend(over);
                rows.list.push(Row { mentions, ..one });
            }
        }
    }
    rows.kernels = kernels.list;
    rows
}

fn are_distinct(slots: &[SlotIndex]) -> bool {
    match *slots {
        [] | [_] => true,
        [a, b] => a != b,
        [a, b, c] => a != b && a != c && b != c,
        [a, b, c, d] => a != b && a != c && a != d && b != c && b != d && c != d,
        _ if slots.len() <= 16 => slots.iter().enumerate().all(|(i, s)| !slots[..i].contains(s)),
        _ => slots.iter().collect::<BTreeSet<_>>().len() == slots.len(),
    }
}

/// The kernels that rows have, each once.
#[derive(Default)]
struct Kernels {
    list: Vec<Rc<Kernel>>,
    /// By the place of their pattern.
    of_pattern: Vec<Option<u32>>,
    /// Which argument each is that is another's too.
    which: Vec<u32>,
}

impl Kernels {
    fn add(&mut self, kernel: Rc<Kernel>) -> u32 {
        self.list.push(kernel);
        self.list.len() as u32 - 1
    }
    fn plain(&mut self, stated: &Stated, pattern: usize) -> u32 {
        if self.of_pattern.len() <= pattern {
            self.of_pattern.resize(pattern + 1, None);
        }
        match self.of_pattern[pattern] {
            Some(kernel) => kernel,
            None => {
                let kernel = self.add(stated.pattern_at(pattern).kernel().clone());
                self.of_pattern[pattern] = Some(kernel);
                kernel
            }
        }
    }
    /// A pattern some of whose arguments (the mentions from `start` on) are one slot is another pattern,
    /// of fewer.
    fn identified(
        &mut self,
        stated: &Stated,
        pattern: usize,
        mentions: &mut Vec<SlotIndex>,
        start: usize,
    ) -> u32 {
        let Self { list, which, .. } = self;
        let arguments = &mentions[start..];
        let first = |s: &SlotIndex| arguments.iter().position(|a| a == s).unwrap_or(0) as u32;
        which.clear();
        which.extend(arguments.iter().map(first));
        let (pattern, left) = stated.pattern_at(pattern).identified(which);
        // what is left stands where it stood, or before
        for (to, &from) in (start..).zip(&*left) {
            mentions[to] = mentions[start + from as usize];
        }
        mentions.truncate(start + left.len());
        let kernel = pattern.kernel();
        let known = list.iter().position(|k| Rc::ptr_eq(k, kernel));
        known.unwrap_or_else(|| {
            list.push(kernel.clone());
            list.len() - 1
        }) as u32
    }
}

/// The derivatives of all rows, row after row, at the first of a few generic points that suits them
/// best.
fn slopes(rows: &Rows, slots: usize) -> (Point, Vec<f64>) {
    let mut best = (usize::MAX, (Point::Mixed, Vec::new()));
    for point in Point::ALL {
        let values: Vec<f64> = (0..slots as u64).map(|i| generic_number(i, point)).collect();
        let out = evaluate(rows, &values).slopes;
        let bad = out.iter().filter(|v| !v.is_finite()).count();
        if bad < best.0 {
            best = (bad, (point, out));
        }
        if bad == 0 {
            break;
        }
    }
    best.1
}

/// Returns true if every two of these rows are independent at a generic point, each two with the two slots that
/// they are to determine.
pub(crate) fn are_independent(rows: &Rows, slots: usize, twos: &[[(u32, SlotIndex); 2]]) -> bool {
    if twos.is_empty() {
        return true;
    }
    let (_, slopes) = slopes(rows, slots);
    let counts = (0..rows.len()).map(|r| rows.kernel(r).map_or(0, |k| k.entries.len()));
    let first: Vec<usize> =
        counts.scan(0, |next, count| Some(std::mem::replace(next, *next + count))).collect();
    let mut swaps = Vec::new();
    twos.iter().all(|two| {
        let mut matrix = [0.0; 4];
        for (i, &(row, _)) in two.iter().enumerate() {
            let mentions = rows.mentions(row as usize);
            let Some(kernel) = rows.kernel(row as usize) else { return false };
            let slopes = &slopes[first[row as usize]..][..kernel.entries.len()];
            let largest = slopes.iter().fold(0.0f64, |m, slope| m.max(slope.abs()));
            for (entry, slope) in kernel.entries.iter().zip(slopes) {
                let slot = mentions[entry.argument as usize];
                if let Some(at) = two.iter().position(|own| own.1 == slot) {
                    matrix[2 * i + at] = slope / largest;
                }
            }
        }
        // one that is not a number is not regular
        let factors = dense::factorise(&mut matrix, 2, &mut swaps);
        factors.sign != 0 && factors.ratio > REGULAR
    })
}

/// What rows come to at a point.
struct Evaluated {
    /// For every row, where its derivatives begin.
    first: Vec<usize>,
    /// The derivatives, row after row.
    slopes: Vec<f64>,
    /// For every row, by how much its left side is larger.
    errors: Vec<f64>,
}

fn evaluate(rows: &Rows, values: &[f64]) -> Evaluated {
    // rows of one kernel are evaluated together
    let mut first = Vec::with_capacity(rows.len() + 1);
    let mut count = 0;
    for r in 0..rows.len() {
        first.push(count);
        if let Some(kernel) = rows.kernel(r) {
            count += kernel.entries.len();
        }
    }
    let by_kernel = (0..rows.len() as u32).map(|r| (rows[r as usize].kernel, r));
    let of_kernel = Lists::new(rows.kernels.len(), by_kernel.filter(|&(k, _)| k != OPAQUE));
    let mut out = Evaluated { first, slopes: vec![0.0; count], errors: vec![0.0; rows.len()] };
    let mut work = Work::default();
    for (kernel, k) in rows.kernels.iter().zip(0..) {
        evaluate_kernel(rows, kernel, of_kernel.of(k), values, &mut work, &mut out);
    }
    out
}

/// Working space for evaluation, of any content.
#[derive(Default)]
struct Work {
    lanes: LaneScratch,
    registers: Vec<f64>,
    out: Vec<f64>,
}

fn evaluate_kernel(
    rows: &Rows,
    kernel: &Kernel,
    own: &[u32],
    values: &[f64],
    work: &mut Work,
    out: &mut Evaluated,
) {
    let entries = kernel.entries.len();
    let mut put = |r: u32, results: Out<'_>| {
        out.errors[r as usize] = results.get(0) - results.get(1);
        let own = &mut out.slopes[out.first[r as usize]..][..entries];
        own.iter_mut().zip(2..).for_each(|(slope, output)| *slope = results.get(output));
    };
    let of = |r: u32| rows.mentions(r as usize);
    for some in own.chunks(LANES) {
        if some.len() < WIDE {
            for &r in some {
                kernel.slopes.run_at(of(r), values, &mut work.registers, &mut work.out);
                put(r, Outs::of_one(&work.out).of(0));
            }
            continue;
        }
        let each = |lane: usize| of(some[lane]);
        let results = work.lanes.run(&kernel.slopes, some.len(), each, values, entries + 2);
        some.iter().zip(0..).for_each(|(&r, lane)| put(r, results.of(lane)));
    }
}

/// Gives every row the slots that it may write.
fn set_columns(system: &System, classes: &Classes, rows: &mut Rows, slopes: &[f64]) {
    let mut columns: Vec<Entry> = Vec::with_capacity(slopes.len());
    rows.spans.clear();
    rows.spans.reserve(rows.len());
    let mut slopes = slopes.iter();
    let mut may: Vec<bool> = Vec::new();
    let mut next = 0;
    while next < rows.len() {
        let relation_index = rows[next].relation;
        let relation = &system.relations[relation_index as usize];
        let writable = Writable::of(system, relation, classes);
        let first = next;
        while next < rows.len() && rows[next].relation == relation_index {
            let start = columns.len();
            let mut curved = false;
            if let Some(kernel) = rows.kernel(next) {
                let mentions = rows.mentions(next);
                may.clear();
                may.extend(mentions.iter().map(|&slot| writable.allows(slot)));
                for (entry, &value) in kernel.entries.iter().zip(slopes.by_ref()) {
                    if !may[entry.argument as usize] {
                        continue;
                    }
                    let slot = mentions[entry.argument as usize];
                    curved = curved || entry.depends.iter().any(|&a| may[a as usize]);
                    // a choice or an exponential that comes to nothing here may be anything elsewhere
                    let may_be_any = value == 0.0 && (entry.branches || kernel.may_underflow());
                    let value = if value.is_finite() && !may_be_any {
                        value
                    } else {
                        generic_coefficient(next, slot)
                    };
                    if value != 0.0 {
                        columns.push((slot, value));
                    }
                }
            }
            let own = &mut columns[start..];
            if !own.is_sorted_by_key(|e| e.0) {
                own.sort_unstable_by_key(|e| e.0);
            }
            let largest = own.iter().fold(0.0f64, |m, e| m.max(e.1.abs()));
            own.iter_mut().for_each(|e| e.1 /= largest);
            let len = (columns.len() - start) as u32;
            rows.spans.push(Span { start: start as u32, len });
            rows.list[next].curved = curved;
            next += 1;
        }
        if !relation.methods.is_empty() {
            add_written_targets(&writable, rows, first..next, &mut columns);
        }
    }
    rows.columns = columns;
}

/// A written target that no derivative shows is one all the same.
fn add_written_targets(
    writable: &Writable<'_>,
    rows: &mut Rows,
    own: std::ops::Range<usize>,
    columns: &mut Vec<Entry>,
) {
    let shown = |rows: &Rows, columns: &[Entry], slot: SlotIndex| {
        own.clone().any(|r| columns[rows.spans[r].range()].iter().any(|e| e.0 == slot))
    };
    let Writable { relation, classes, .. } = writable;
    let mut missing: Vec<SlotIndex> = relation
        .methods
        .iter()
        .flat_map(|m| &m.targets)
        .map(|&t| classes.representative[t as usize])
        .filter(|&s| writable.allows(s) && !shown(rows, columns, s))
        .collect();
    missing.sort_unstable();
    missing.dedup();
    if missing.is_empty() {
        return;
    }
    let start = rows.spans[own.start].start as usize;
    let before = columns.split_off(start);
    for r in own {
        let span = rows.spans[r];
        let from = columns.len();
        let range = span.range();
        columns.extend(&before[range.start - start..range.end - start]);
        columns.extend(missing.iter().map(|&slot| (slot, generic_coefficient(r, slot))));
        columns[from..].sort_unstable_by_key(|e| e.0);
        rows.spans[r] = Span { start: from as u32, len: (columns.len() - from) as u32 };
    }
}

/// Which slots a relation may write.
struct Writable<'a> {
    relation: &'a Relation,
    classes: &'a Classes,
    /// True if these are the targets of its methods alone.
    only_targets: bool,
    /// True if these are all that may move.
    is_any: bool,
    /// What it never writes.
    reads: &'a [SlotIndex],
}

impl<'a> Writable<'a> {
    fn of(system: &'a System, relation: &'a Relation, classes: &'a Classes) -> Self {
        let written = !relation.derived && !relation.methods.is_empty();
        let opaque = matches!(relation.body, RelationBody::Opaque { .. });
        let only_targets = written || opaque;
        let reads = system.reads(relation);
        let is_any = !only_targets && reads.is_empty();
        Self { relation, classes, only_targets, is_any, reads }
    }
    fn allows(&self, slot: SlotIndex) -> bool {
        self.classes.stay[slot as usize] != Stay::Fixed && (self.is_any || self.is_named(slot))
    }
    /// Returns true if the relation does not say that it never writes a slot.
    fn is_named(&self, slot: SlotIndex) -> bool {
        let is = |s: &SlotIndex| self.classes.representative[*s as usize] == slot;
        let mut targets = self.relation.methods.iter().flat_map(|m| &m.targets);
        !self.reads.iter().any(is) && (!self.only_targets || targets.any(is))
    }
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
    pub(crate) const ALL: [Self; 3] = [Self::Mixed, Self::Positive, Self::Small];
}

/// Returns a coefficient that no other is equal to.
fn generic_coefficient(row: usize, slot: SlotIndex) -> f64 {
    generic_number((row as u64) << 32 | u64::from(slot), Point::Mixed)
}

/// Returns a number that depends on `seed` alone and on nothing else that could coincide.
pub(crate) fn generic_number(seed: u64, point: Point) -> f64 {
    let z = scrambled(seed);
    let unit = (z >> 11) as f64 / (1u64 << 53) as f64;
    match point {
        Point::Mixed if z & 1 == 1 => -(0.6 + 1.3 * unit),
        Point::Mixed | Point::Positive => 0.6 + 1.3 * unit,
        Point::Small => 0.05 + 0.4 * unit,
    }
}

/// Collects the slots that a method reads, over representatives, in order.
pub(crate) fn method_reads(
    system: &System,
    classes: &Classes,
    body: &MethodBody,
) -> Vec<SlotIndex> {
    let reads = match body {
        MethodBody::Formulas { arguments, .. } => system.arguments(*arguments),
        MethodBody::Opaque { reads } => reads,
    };
    let mut reads: Vec<SlotIndex> =
        reads.iter().map(|&s| classes.representative[s as usize]).collect();
    reads.sort_unstable();
    reads.dedup();
    reads
}
