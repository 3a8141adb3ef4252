//! Layouts: what blocks have in common that differ in their slots alone.
//!
//! In: the kernels of a block's rows, and which of their arguments are which of its unknowns. Out: where
//! everything goes when the rows are evaluated, which unknowns are defined, what is left to be iterated.
//! Everything is named by position. In a chain of a thousand triangles one layout serves all.

use super::closed::Closed;
use crate::block::{Local, SecondPlace};
use crate::kernel::{Entry, Kernel, Side};
use crate::lower::{Definers, Problem};
use crate::sparse::Pattern;
use crate::system::{Level, SlotIndex, Span};
use base::Mixer;
use base::number::Tolerance;
use indexmap::IndexMap;
use std::hash::BuildHasherDefault;
use std::ops::Range;
use std::rc::Rc;
use std::sync::OnceLock;

/// Rows over unknowns, by position.
#[derive(Debug)]
pub(crate) struct Layout {
    /// How many unknowns there are.
    width: usize,
    /// For every row, the tolerance of its sides.
    pub(crate) within: Vec<Tolerance>,
    /// For every row, how strongly it wants to hold.
    pub(crate) levels: Vec<Level>,
    /// Where rows depend on unknowns.
    pub(crate) pattern: Pattern,
    /// Rows that define nothing.
    pub(crate) core_rows: Vec<u32>,
    /// Unknowns that nothing defines.
    pub(crate) core: Vec<u32>,
    /// In the order in which they are computed.
    pub(crate) definitions: Vec<Definition>,
    /// True if no derivative depends on an unknown.
    pub(crate) is_linear: bool,
    pub(super) groups: Vec<Group>,
    /// The rows of all groups.
    grouped: Vec<u32>,
    /// For every row in that order, where each of the kernel's derivatives goes in the Jacobian.
    entries: Vec<u32>,
    /// Second derivatives, row after row of all groups, and where those of each row end.
    pub(super) seconds: OnceLock<(Vec<SecondPlace>, Vec<u32>)>,
    pub(super) closed: OnceLock<Option<Closed>>,
    /// For every row, its group and its place there.
    place: Vec<(u32, u32)>,
}

/// An unknown that a row states outright.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Definition {
    /// The unknown, by position.
    pub(crate) unknown: u32,
    /// The row, by position.
    pub(crate) row: u32,
    /// The side on which the unknown stands alone.
    pub(crate) side: Side,
}

/// Rows of one kernel.
#[derive(Debug)]
pub(super) struct Group {
    pub(super) kernel: Rc<Kernel>,
    /// The rows, by position, among [`Layout::grouped`].
    pub(super) rows: Span,
    /// Where the slots of its rows begin, one row after the other, among those of all groups.
    pub(super) arguments: u32,
    /// Where its entries begin among [`Layout::entries`].
    entries: u32,
}

/// The argument, or what a derivative is by, is known.
pub(super) const KNOWN: u32 = u32::MAX;

/// Adds which unknown every argument of every row is, row after row; unknowns stand in order.
pub(super) fn positions(problem: &Problem, positions: &mut Vec<u32>) {
    positions.reserve(problem.rows.iter().map(|row| row.arguments.len()).sum());
    if problem.unknowns.len() <= SMALL {
        for row in &problem.rows {
            for slot in &row.arguments {
                let at = problem.unknowns.iter().position(|unknown| unknown == slot);
                positions.push(at.map_or(KNOWN, |at| at as u32));
            }
        }
        return;
    }
    let last = problem.unknowns.last().map_or(0, |&last| last as usize + 1);
    let mut place = vec![KNOWN; last];
    for (&slot, at) in problem.unknowns.iter().zip(0..) {
        place[slot as usize] = at;
    }
    let unknown = |s: &SlotIndex| place.get(*s as usize).copied().unwrap_or(KNOWN);
    for row in &problem.rows {
        positions.extend(row.arguments.iter().map(unknown));
    }
}

/// The layouts of small blocks, each made once.
#[derive(Debug, Default)]
pub(crate) struct Layouts {
    /// By everything that a layout depends on.
    known: IndexMap<Box<[u32]>, Rc<Layout>, BuildHasherDefault<Mixer>>,
    key: Vec<u32>,
}

/// The key of a layout has room for that of two rows.
const ROOM: usize = 32;

/// Up to this many rows it is looked whether a block is laid out as another was.
const SMALL: usize = 12;

impl Layouts {
    /// Returns the layout of a block.
    pub(super) fn find(&mut self, problem: &Problem, definers: Definers) -> Rc<Layout> {
        let Self { known, key } = self;
        key.clear();
        key.reserve(ROOM);
        if problem.rows.len() <= SMALL {
            let halves = |x: u64| [x as u32, (x >> 32) as u32];
            key.extend([definers as u32, problem.unknowns.len() as u32]);
            for row in &problem.rows {
                key.extend(halves(Rc::as_ptr(&row.kernel) as usize as u64));
                key.push(row.level as u32);
                match row.within {
                    Tolerance::Relative => key.push(0),
                    Tolerance::Within(bits) => key.extend([1].into_iter().chain(halves(bits))),
                    Tolerance::Part(bits) => key.extend([2].into_iter().chain(halves(bits))),
                }
            }
        }
        let start = key.len();
        positions(problem, key);
        if start == 0 {
            return Rc::new(Layout::new(problem, key, definers));
        }
        if let Some(layout) = known.get(key.as_slice()) {
            return layout.clone();
        }
        let layout = Rc::new(Layout::new(problem, &key[start..], definers));
        known.insert(key.as_slice().into(), layout.clone());
        layout
    }
}

impl Layout {
    /// Lays rows out whose arguments are these unknowns, row after row.
    pub(super) fn new(problem: &Problem, positions: &[u32], definers: Definers) -> Self {
        let mut groups: Vec<Group> = Vec::new();
        let mut place: Vec<(u32, u32)> = Vec::with_capacity(problem.rows.len());
        for row in &problem.rows {
            let same = |g: &Group| Rc::ptr_eq(&g.kernel, &row.kernel);
            let at = groups.iter().rposition(same).unwrap_or_else(|| {
                let kernel = Rc::clone(&row.kernel);
                groups.push(Group { kernel, rows: Span::default(), arguments: 0, entries: 0 });
                groups.len() - 1
            });
            place.push((at as u32, groups[at].rows.len));
            groups[at].rows.len += 1;
        }
        let (mut rows, mut arguments, mut entries) = (0, 0, 0);
        for group in &mut groups {
            group.rows.start = rows;
            (group.arguments, group.entries) = (arguments, entries);
            rows += group.rows.len;
            arguments += group.rows.len * group.kernel.arity() as u32;
            entries += group.rows.len * group.kernel.entries.len() as u32;
        }
        let mut made = Self {
            within: problem.rows.iter().map(|r| r.within).collect(),
            levels: problem.rows.iter().map(|r| r.level).collect(),
            width: problem.unknowns.len(),
            pattern: Pattern::default(),
            core_rows: Vec::new(),
            core: Vec::new(),
            definitions: Vec::new(),
            is_linear: true,
            groups,
            grouped: vec![0; rows as usize],
            entries: vec![KNOWN; entries as usize],
            seconds: OnceLock::new(),
            closed: OnceLock::new(),
            place,
        };
        made.fill(positions);
        made.define(positions, definers);
        made
    }

    /// Puts in where the derivatives of every row go.
    fn fill(&mut self, mut positions: &[u32]) {
        let mut pattern = Pattern::with_room(self.width, self.place.len(), self.entries.len());
        for r in 0..self.place.len() {
            let (group, at) = self.place[r];
            let Group { kernel, rows, entries, .. } = &self.groups[group as usize];
            let count = kernel.entries.len();
            let (position, rest) = positions.split_at(kernel.arity());
            positions = rest;
            self.grouped[(rows.start + at) as usize] = r as u32;
            let of = |e: &Entry| position[e.argument as usize];
            let is_unknown = |&a: &u32| position[a as usize] != KNOWN;
            let is_straight = |e: &Entry| of(e) == KNOWN || !e.depends.iter().any(is_unknown);
            self.is_linear = self.is_linear && kernel.entries.iter().all(is_straight);
            pattern.push(kernel.entries.iter().map(of).filter(|&c| c != KNOWN));
            let places = &mut self.entries[*entries as usize + at as usize * count..][..count];
            for (place, entry) in places.iter_mut().zip(&kernel.entries) {
                if of(entry) != KNOWN {
                    *place = pattern.find(r, of(entry)).map_or(KNOWN, |at| at as u32);
                }
            }
        }
        self.pattern = pattern;
    }

    /// Returns the number of rows.
    pub(crate) fn height(&self) -> usize {
        self.within.len()
    }
    /// Returns the rows of a group, by position.
    pub(super) fn rows_of(&self, group: &Group) -> &[u32] {
        &self.grouped[group.rows.range()]
    }
    /// Returns where each derivative of the rows of a group goes.
    pub(super) fn entries_of(&self, group: &Group) -> &[u32] {
        let count = group.rows.len as usize * group.kernel.entries.len();
        &self.entries[group.entries as usize..][..count]
    }
    /// Returns how many arguments all rows have.
    pub(super) fn argument_count(&self) -> usize {
        let last = self.groups.last();
        last.map_or(0, |g| g.arguments as usize + g.rows.len as usize * g.kernel.arity())
    }
    /// Returns where the arguments of a row stand among those of all groups.
    pub(super) fn arguments_of_row(&self, row: usize) -> Range<usize> {
        let (group, at) = self.place[row];
        let group = &self.groups[group as usize];
        let arity = group.kernel.arity();
        let start = group.arguments as usize + at as usize * arity;
        start..start + arity
    }
    pub(super) fn kernel_of_row(&self, row: usize) -> &Rc<Kernel> {
        &self.groups[self.place[row].0 as usize].kernel
    }

    /// Finds what the rows define, in an order in which it can be computed.
    fn define(&mut self, mut positions: &[u32], definers: Definers) {
        let mut defined: Vec<Option<Definition>> = vec![None; self.width];
        let mut count = 0;
        let mut seen = vec![u32::MAX; self.width];
        let mut core_rows = Vec::with_capacity(self.height());
        for r in 0..self.height() {
            let kernel = self.kernel_of_row(r);
            let (position, rest) = positions.split_at(kernel.arity());
            positions = rest;
            let may = match definers {
                Definers::None => false,
                Definers::Any => true,
                Definers::Required => self.levels[r] == Level::Required,
            };
            if !may || count + 1 >= self.width {
                core_rows.push(r as u32);
                continue;
            }
            let found = kernel.stated().find_map(|(argument, side)| {
                let unknown = position[argument as usize];
                let once = position.iter().filter(|&&p| p == unknown).count() == 1;
                let is_free = unknown != KNOWN && once && defined[unknown as usize].is_none();
                let definition = Definition { unknown, row: r as u32, side };
                (is_free && !self.leads_to(&defined, definition, &mut seen)).then_some(definition)
            });
            match found {
                Some(definition) => {
                    defined[definition.unknown as usize] = Some(definition);
                    count += 1;
                }
                None => core_rows.push(r as u32),
            }
        }
        if count > 0 {
            self.definitions = self.in_order(&defined);
        }
        self.core.reserve(self.width - count);
        self.core.extend((0..self.width as u32).filter(|&u| defined[u as usize].is_none()));
        self.core_rows = core_rows;
    }

    /// Returns true if what a definition is made of comes from the unknown that it would define, or
    /// from more than is worth following.
    fn leads_to(
        &self,
        defined: &[Option<Definition>],
        definition: Definition,
        seen: &mut [u32],
    ) -> bool {
        const FAR: usize = 2000;
        let mut visits = 0;
        let mut rows = vec![definition.row];
        while let Some(r) = rows.pop() {
            let first = r == definition.row;
            for &u in self.pattern.row(r as usize) {
                if first && u == definition.unknown {
                    continue;
                }
                if u == definition.unknown || visits > FAR {
                    return true;
                }
                if seen[u as usize] != definition.row {
                    seen[u as usize] = definition.row;
                    visits += 1;
                    rows.extend(defined[u as usize].map(|d| d.row));
                }
            }
        }
        false
    }

    /// Orders definitions so that each is computed after those that it is made of.
    fn in_order(&self, defined: &[Option<Definition>]) -> Vec<Definition> {
        let mut order = Vec::new();
        let mut done = vec![false; self.width];
        let mut stack: Vec<(u32, usize)> = Vec::new();
        for u in 0..self.width as u32 {
            stack.push((u, 0));
            while let Some((u, next)) = stack.pop() {
                let Some(definition) = defined[u as usize] else { continue };
                if done[u as usize] {
                    continue;
                }
                let row = self.pattern.row(definition.row as usize);
                if let Some(&other) = row.get(next) {
                    stack.push((u, next + 1));
                    if other != u && !done[other as usize] {
                        stack.push((other, 0));
                    }
                } else {
                    done[u as usize] = true;
                    order.push(definition);
                }
            }
        }
        order
    }

    /// Computes every unknown's gradient by the core, each unknown of the core in units of its `scale`: one
    /// row of as many numbers as the core has for every unknown.
    pub(crate) fn gradients(
        &self,
        local: &Local,
        scale: &dyn Fn(usize) -> f64,
        gradients: &mut Vec<f64>,
    ) {
        let n = self.core.len();
        gradients.clear();
        gradients.resize(self.width * n, 0.0);
        for (i, &u) in self.core.iter().enumerate() {
            gradients[u as usize * n + i] = scale(i);
        }
        for d in &self.definitions {
            let own = d.unknown as usize;
            let mut pivot = 1.0;
            for e in self.pattern.range(d.row as usize) {
                let c = self.pattern.column(e);
                let slope = local.jacobian[e];
                if c == own {
                    pivot = slope;
                } else {
                    for i in 0..n {
                        gradients[own * n + i] -= slope * gradients[c * n + i];
                    }
                }
            }
            for gradient in &mut gradients[own * n..][..n] {
                *gradient /= pivot;
            }
        }
    }

    /// Finds the factors of the defining rows that make a sum of rows, each times its factor, stationary in
    /// what they define.
    pub(crate) fn pass_back(&self, local: &Local, factor: &mut [f64]) {
        if self.definitions.is_empty() {
            return;
        }
        let mut slope = vec![0.0; self.width];
        let add = |row: usize, factor: f64, slope: &mut [f64]| {
            for e in self.pattern.range(row) {
                slope[self.pattern.column(e)] += factor * local.jacobian[e];
            }
        };
        for &r in &self.core_rows {
            add(r as usize, factor[r as usize], &mut slope);
        }
        for d in self.definitions.iter().rev() {
            let row = d.row as usize;
            let pivot = self.pattern.find(row, d.unknown).map_or(1.0, |e| local.jacobian[e]);
            factor[row] = -slope[d.unknown as usize] / pivot;
            add(row, factor[row], &mut slope);
        }
    }
}
