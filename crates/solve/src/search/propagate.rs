//! Propagation: what a row says of the domains of its cells.
//!
//! In: a row and domains. Out: smaller domains that lose no solution, or that there is none. Sums by
//! their bounds; different numbers by taking known ones from the others, by sets of cells that use
//! all their values up, and by values that only one cell can take; other rows by the bounds of their
//! sides, and state by state once there are few.
//!
//! **Source:** Schulte and Stuckey, "Efficient constraint propagation engines" (2008), §2;
//! van Hoeve, "The alldifferent constraint: a survey" (2001), §4.

use super::domain::{Domain, MOST};
use super::row::{General, Linear, Row, Shifted, Sum};
use crate::truth::Comparing;
use expr::{Arena, ExprId, Interval};

/// How many states of a row's cells are gone through one by one.
const STATES: u64 = 64;
/// What it costs to test a row in one of them, in multiplications, roughly.
const STATE: u64 = 20;
/// What it costs to bound one operation of a row's sides, there and back, in multiplications, roughly.
const BOUND: u64 = 200;

/// There is no solution.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Dead;

/// What can be said of a row for the present domains.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Prospect {
    Never,
    Open,
    Always,
}

/// The domains while they shrink.
#[derive(Debug)]
pub(crate) struct Field<'a> {
    pub(crate) arena: &'a Arena,
    pub(crate) domains: Vec<Domain>,
    /// Cells that are known and need not be whole: what a wish wants.
    known: &'a [Option<f64>],
    /// Cells that shrank since they were last taken.
    pub(crate) shrunk: Vec<u32>,
    /// What was spent so far, in multiplications, roughly, and what may be.
    pub(crate) spent: u64,
    pub(crate) most: u64,
    /// What the cells of the row at hand can be.
    boxes: Vec<Interval>,
    numbers: Vec<f64>,
    registers: Vec<f64>,
}

impl<'a> Field<'a> {
    pub(crate) fn new(arena: &'a Arena, domains: Vec<Domain>, known: &'a [Option<f64>]) -> Self {
        let numbers = vec![0.0; domains.len()];
        let boxes = vec![Interval::ALL; domains.len()];
        let (shrunk, registers) = (Vec::new(), Vec::new());
        Self { arena, domains, known, shrunk, spent: 0, most: u64::MAX, boxes, numbers, registers }
    }

    /// Returns another field with the same domains.
    pub(crate) fn again(&self) -> Self {
        Self::new(self.arena, self.domains.clone(), self.known)
    }

    /// Gives a cell a smaller domain.
    pub(crate) fn put(&mut self, cell: u32, domain: Domain) -> Result<(), Dead> {
        let old = &mut self.domains[cell as usize];
        if *old != domain {
            *old = domain;
            self.shrunk.push(cell);
        }
        if domain.is_empty() { Err(Dead) } else { Ok(()) }
    }

    fn of(&self, cell: u32) -> Domain {
        self.domains[cell as usize]
    }

    /// Makes a row's cells lose values that it does not allow.
    pub(crate) fn propagate(&mut self, row: &Row) -> Result<(), Dead> {
        match row {
            Row::Linear(linear) => self.sum(linear),
            Row::Different(cells) => self.different(cells),
            Row::General(general) => self.general(general),
            Row::All(rows) => rows.iter().try_for_each(|r| self.propagate(r)),
            Row::Any(rows) => {
                let mut only = None;
                for row in rows {
                    match (self.prospect(row), only) {
                        (Prospect::Never, _) => {}
                        (Prospect::Always, _) | (Prospect::Open, Some(_)) => return Ok(()),
                        (Prospect::Open, None) => only = Some(row),
                    }
                }
                only.map_or(Err(Dead), |row| self.propagate(row))
            }
        }
    }

    /// Says whether a row can hold, for domains that are not empty.
    pub(crate) fn prospect(&mut self, row: &Row) -> Prospect {
        match row {
            Row::Linear(linear) => {
                let (low, high) = self.extent(linear);
                let constant = i128::from(linear.constant);
                match linear.comparing {
                    Sum::AtMost if high <= constant => Prospect::Always,
                    Sum::AtMost if low > constant => Prospect::Never,
                    Sum::AtMost => Prospect::Open,
                    Sum::Equal | Sum::Differ => {
                        let equal = match (low, high) {
                            _ if constant < low || high < constant => Prospect::Never,
                            (low, high) if low == high => Prospect::Always,
                            _ => Prospect::Open,
                        };
                        match (linear.comparing, equal) {
                            (Sum::Differ, Prospect::Never) => Prospect::Always,
                            (Sum::Differ, Prospect::Always) => Prospect::Never,
                            (Sum::Equal | Sum::AtMost | Sum::Differ, same) => same,
                        }
                    }
                }
            }
            Row::Different(cells) => {
                let mut known: Vec<i64> = Vec::new();
                for c in cells {
                    known.extend(self.of(c.cell).known().map(|v| v + c.by));
                }
                let count = known.len();
                known.sort_unstable();
                known.dedup();
                match (known.len() == count, count == cells.len()) {
                    (false, _) => Prospect::Never,
                    (true, true) => Prospect::Always,
                    (true, false) => Prospect::Open,
                }
            }
            Row::General(general) => self.prospect_of_sides(general),
            Row::All(rows) => {
                let all: Vec<Prospect> = rows.iter().map(|r| self.prospect(r)).collect();
                if all.contains(&Prospect::Never) {
                    Prospect::Never
                } else if all.contains(&Prospect::Open) {
                    Prospect::Open
                } else {
                    Prospect::Always
                }
            }
            Row::Any(rows) => {
                let all: Vec<Prospect> = rows.iter().map(|r| self.prospect(r)).collect();
                if all.contains(&Prospect::Always) {
                    Prospect::Always
                } else if all.contains(&Prospect::Open) {
                    Prospect::Open
                } else {
                    Prospect::Never
                }
            }
        }
    }

    fn extent(&self, linear: &Linear) -> (i128, i128) {
        let mut extent = (0i128, 0i128);
        for &(cell, c) in &linear.terms {
            let (low, high) = self.term(cell, c);
            extent = (extent.0 + low, extent.1 + high);
        }
        extent
    }

    /// Returns the least and the greatest value of a term.
    fn term(&self, cell: u32, coefficient: i64) -> (i128, i128) {
        let (d, c) = (self.of(cell), i128::from(coefficient));
        let (a, b) = (c * i128::from(d.low()), c * i128::from(d.high()));
        (a.min(b), a.max(b))
    }

    fn sum(&mut self, linear: &Linear) -> Result<(), Dead> {
        let constant = i128::from(linear.constant);
        if linear.comparing == Sum::Differ {
            let mut open = linear.terms.iter().filter(|t| self.of(t.0).known().is_none());
            return match (open.next(), open.next()) {
                (None, _) if self.extent(linear).0 == constant => Err(Dead),
                (Some(&(cell, c)), None) => {
                    let (low, _) = self.extent(linear);
                    let rest = constant - (low - self.term(cell, c).0);
                    let c = i128::from(c);
                    if rest % c == 0 && (rest / c).unsigned_abs() <= MOST as u128 {
                        let domain = self.of(cell).without((rest / c) as i64);
                        return self.put(cell, domain);
                    }
                    Ok(())
                }
                (None, _) | (Some(_), Some(_)) => Ok(()),
            };
        }
        let (low, high) = self.extent(linear);
        if low > constant || linear.comparing == Sum::Equal && high < constant {
            return Err(Dead);
        }
        if linear.comparing == Sum::Equal && !linear.divides(|cell| self.of(cell).known()) {
            return Err(Dead);
        }
        let (mut low, mut high) = (low, high);
        for &(cell, c) in &linear.terms {
            let (l, h) = self.term(cell, c);
            let most = constant - (low - l);
            let least = match linear.comparing {
                Sum::Equal => constant - (high - h),
                Sum::AtMost | Sum::Differ => i128::MIN / 4,
            };
            // least <= c * x <= most
            let wide = |x: i128| x.clamp(-2 * i128::from(MOST), 2 * i128::from(MOST)) as i64;
            let c = i128::from(c);
            let (from, to) = if c > 0 {
                (ceiling(least, c), floor(most, c))
            } else {
                (ceiling(-most, -c), floor(-least, -c))
            };
            let domain = self.of(cell).clip(wide(from), wide(to));
            self.put(cell, domain)?;
            let (newer_l, newer_h) = self.term(cell, c as i64);
            low += newer_l - l;
            high += newer_h - h;
        }
        Ok(())
    }

    fn different(&mut self, cells: &[Shifted]) -> Result<(), Dead> {
        loop {
            let before = self.shrunk.len();
            self.take_known(cells)?;
            if self.shrunk.len() == before {
                self.used_up(cells)?;
                self.single_takers(cells)?;
            }
            if self.shrunk.len() == before {
                return Ok(());
            }
        }
    }

    /// What is known of some cells is taken from the others, unless two know the same.
    fn take_known(&mut self, cells: &[Shifted]) -> Result<(), Dead> {
        let mut known: Vec<i64> = Vec::new();
        let mut open: Vec<Shifted> = Vec::new();
        for c in cells {
            match self.of(c.cell).known() {
                Some(value) => known.push(value + c.by),
                None => open.push(*c),
            }
        }
        for value in &known {
            for c in &open {
                let domain = self.of(c.cell).without(value - c.by);
                self.put(c.cell, domain)?;
            }
        }
        known.sort_unstable();
        match known.windows(2).any(|pair| pair[0] == pair[1]) {
            true => Err(Dead),
            false => Ok(()),
        }
    }

    /// As many cells as the values that they can have: nothing else has any of these.
    fn used_up(&mut self, cells: &[Shifted]) -> Result<(), Dead> {
        let Some(Sets { base, sets }) = self.sets(cells) else { return self.too_few(cells) };
        for &set in &sets {
            let size = set.count_ones() as usize;
            if size == 1 || size >= cells.len() {
                continue;
            }
            let inside = sets.iter().filter(|&&s| s & !set == 0).count();
            if inside > size {
                return Err(Dead);
            }
            if inside == size {
                for (c, &other) in cells.iter().zip(&sets) {
                    if other & !set != 0 && other & set != 0 {
                        self.keep(*c, base, !set)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// As many values as cells, all told: a value that one cell alone can take is that cell's.
    fn single_takers(&mut self, cells: &[Shifted]) -> Result<(), Dead> {
        let Some(Sets { base, sets }) = self.sets(cells) else { return Ok(()) };
        let union = sets.iter().fold(0u128, |u, s| u | s);
        let count = union.count_ones() as usize;
        if count != cells.len() {
            return if count < cells.len() { Err(Dead) } else { Ok(()) };
        }
        let (mut once, mut twice) = (0u128, 0u128);
        for s in &sets {
            twice |= once & s;
            once |= s;
        }
        for (c, &set) in cells.iter().zip(&sets) {
            let own = set & once & !twice;
            if own != 0 && own != set {
                if own.count_ones() > 1 {
                    return Err(Dead);
                }
                self.keep(*c, base, own)?;
            }
        }
        Ok(())
    }

    /// Returns the values of cells as bits; nothing where they lie too far apart.
    fn sets(&self, cells: &[Shifted]) -> Option<Sets> {
        let base = self.base(cells);
        let set = |c: &Shifted| {
            let mut set = 0u128;
            for v in self.of(c.cell).values()? {
                set |= 1u128.checked_shl(u32::try_from(v + c.by - base).ok()?)?;
            }
            Some(set)
        };
        let sets: Option<Vec<u128>> = cells.iter().map(set).collect();
        Some(Sets { base, sets: sets? })
    }

    fn base(&self, cells: &[Shifted]) -> i64 {
        cells.iter().map(|c| self.of(c.cell).low() + c.by).min().unwrap_or(0)
    }

    /// Leaves a cell the values of a set.
    fn keep(&mut self, c: Shifted, base: i64, set: u128) -> Result<(), Dead> {
        let mut domain = self.of(c.cell);
        for v in self.of(c.cell).values().into_iter().flatten() {
            if set >> (v + c.by - base) & 1 == 0 {
                domain = domain.without(v);
            }
        }
        self.put(c.cell, domain)
    }

    /// Fewer values than cells, where only bounds are known.
    fn too_few(&self, cells: &[Shifted]) -> Result<(), Dead> {
        let high = cells.iter().map(|c| self.of(c.cell).high() + c.by).max().unwrap_or(0);
        let width = i128::from(high) - i128::from(self.base(cells)) + 1;
        if width < cells.len() as i128 { Err(Dead) } else { Ok(()) }
    }

    fn general(&mut self, general: &General) -> Result<(), Dead> {
        let open = |&c: &u32| self.of(c).known().is_none();
        let open: Vec<u32> = general.cells.iter().copied().filter(open).collect();
        let states = open.iter().try_fold(1, |states: u64, &cell| {
            let domain = self.of(cell);
            let is_listed = domain.values().is_some();
            states.checked_mul(domain.size()).filter(|&s| is_listed && s <= STATES)
        });
        match states {
            Some(states) => self.go_through(general, &open, states),
            None => self.narrow(general),
        }
    }

    /// Leaves cells the values that they have in a state in which a row holds.
    fn go_through(&mut self, general: &General, open: &[u32], states: u64) -> Result<(), Dead> {
        self.note_known(general);
        let values = |&cell: &u32| self.of(cell).values().into_iter().flatten().collect();
        let values: Vec<Vec<i64>> = open.iter().map(values).collect();
        // what each cell has in some state that holds: bit `i` is its value `i`
        let mut found = vec![0u64; open.len()];
        let mut holds = false;
        for state in 0..states {
            self.spent += STATE;
            let mut rest = state as usize;
            let mut at = [0; STATES.ilog2() as usize];
            for ((&cell, values), at) in open.iter().zip(&values).zip(&mut at) {
                *at = rest % values.len();
                rest /= values.len();
                self.numbers[cell as usize] = values[*at] as f64;
            }
            if self.sides_hold(general) {
                holds = true;
                found.iter_mut().zip(at).for_each(|(found, at)| *found |= 1 << at);
                if found.iter().zip(&values).all(|(f, v)| f.count_ones() as usize == v.len()) {
                    break;
                }
            }
        }
        for ((&cell, values), found) in open.iter().zip(values).zip(found) {
            let mut domain = self.of(cell);
            for (at, value) in values.into_iter().enumerate() {
                if found >> at & 1 == 0 {
                    domain = domain.without(value);
                }
            }
            self.put(cell, domain)?;
        }
        if holds { Ok(()) } else { Err(Dead) }
    }

    /// Leaves cells what the bounds of both sides allow.
    fn narrow(&mut self, general: &General) -> Result<(), Dead> {
        self.spent += BOUND * general.sides.len() as u64;
        let (l, r) = self.enclose_sides(general);
        let (of_left, of_right) = match general.comparing {
            Comparing::Differ => return Ok(()),
            Comparing::Less if l.low >= r.high => return Err(Dead),
            Comparing::Equal => (r, l),
            Comparing::AtMost | Comparing::Less => (
                Interval { low: f64::NEG_INFINITY, high: r.high },
                Interval { low: l.low, high: f64::INFINITY },
            ),
        };
        let boxes = &mut self.boxes;
        if !self.arena.narrow(general.left, of_left, boxes)
            || !self.arena.narrow(general.right, of_right, boxes)
        {
            return Err(Dead);
        }
        let most = 2.0 * MOST as f64;
        for &cell in &general.cells {
            if self.known[cell as usize].is_none() {
                let Interval { low, high } = self.boxes[cell as usize];
                let (low, high) = (low.ceil().max(-most) as i64, high.floor().min(most) as i64);
                self.put(cell, self.of(cell).clip(low, high))?;
            }
        }
        Ok(())
    }

    fn prospect_of_sides(&mut self, general: &General) -> Prospect {
        if general.cells.iter().all(|&c| self.of(c).known().is_some()) {
            let holds = self.tests_true(general);
            return if holds { Prospect::Always } else { Prospect::Never };
        }
        let (l, r) = self.enclose_sides(general);
        if l.is_none() || r.is_none() {
            return Prospect::Never;
        }
        let apart = l.high < r.low || r.high < l.low;
        match general.comparing {
            Comparing::Equal if apart => Prospect::Never,
            Comparing::Differ if apart => Prospect::Always,
            Comparing::AtMost if l.high <= r.low => Prospect::Always,
            Comparing::AtMost if l.low > r.high => Prospect::Never,
            Comparing::Less if l.high < r.low => Prospect::Always,
            Comparing::Less if l.low >= r.high => Prospect::Never,
            Comparing::Equal | Comparing::Differ | Comparing::AtMost | Comparing::Less => {
                Prospect::Open
            }
        }
    }

    /// Returns what a cell can be.
    fn interval(&self, cell: u32) -> Interval {
        match self.known[cell as usize] {
            Some(x) => Interval::point(x),
            None => {
                let domain = self.of(cell);
                Interval { low: domain.low() as f64, high: domain.high() as f64 }
            }
        }
    }

    /// Returns an interval that holds whatever an expression can be.
    pub(crate) fn enclose(&self, id: ExprId) -> Interval {
        let boxes: Vec<_> = (0..self.domains.len() as u32).map(|c| self.interval(c)).collect();
        self.arena.enclose(id, &boxes)
    }

    /// Returns intervals that hold whatever the sides of a row can be.
    fn enclose_sides(&mut self, general: &General) -> (Interval, Interval) {
        for &cell in &general.cells {
            self.boxes[cell as usize] = self.interval(cell);
        }
        let of = |side| self.arena.enclose(side, &self.boxes);
        (of(general.left), of(general.right))
    }

    fn tests_true(&mut self, general: &General) -> bool {
        self.note_known(general);
        self.sides_hold(general)
    }

    fn note_known(&mut self, general: &General) {
        for &cell in &general.cells {
            if let Some(value) = self.known[cell as usize] {
                self.numbers[cell as usize] = value;
            } else if let Some(value) = self.of(cell).known() {
                self.numbers[cell as usize] = value as f64;
            }
        }
    }

    fn sides_hold(&mut self, general: &General) -> bool {
        let mut out = [0.0; 2];
        general.sides.run(&self.numbers, &mut self.registers, &mut out);
        general.comparing.holds(out[0], out[1])
    }

    /// Returns the values of `second` that go with each of `first`, where both are few.
    pub(crate) fn partners(&mut self, general: &General) -> Option<Partners> {
        let &[first, second] = general.cells.as_slice() else { return None };
        if self.known[first as usize].is_some() || self.known[second as usize].is_some() {
            return None;
        }
        let (firsts, seconds) = (self.of(first).values()?, self.of(second).values()?);
        let (first_base, second_base) = (self.of(first).low(), self.of(second).low());
        let seconds: Vec<i64> = seconds.collect();
        let mut partners = Partners {
            first,
            second,
            first_base,
            second_base,
            of_first: [0; 64],
            of_second: [0; 64],
        };
        for a in firsts {
            self.numbers[first as usize] = a as f64;
            for &b in &seconds {
                self.numbers[second as usize] = b as f64;
                if self.sides_hold(general) {
                    partners.of_first[(a - first_base) as usize] |= 1 << (b - second_base);
                    partners.of_second[(b - second_base) as usize] |= 1 << (a - first_base);
                }
            }
        }
        Some(partners)
    }

    /// Makes two cells lose the values without a partner.
    pub(crate) fn pair_up(&mut self, partners: &Partners) -> Result<(), Dead> {
        let Partners { first, second, first_base, second_base, of_first, of_second } = partners;
        for (cell, base, other, other_base, of) in [
            (*second, *second_base, *first, *first_base, of_first),
            (*first, *first_base, *second, *second_base, of_second),
        ] {
            let mut allowed = 0u64;
            for v in self.of(other).values().into_iter().flatten() {
                allowed |= of[(v - other_base) as usize];
            }
            let mut domain = self.of(cell);
            for v in self.of(cell).values().into_iter().flatten() {
                if allowed >> (v - base) & 1 == 0 {
                    domain = domain.without(v);
                }
            }
            self.put(cell, domain)?;
        }
        Ok(())
    }
}

/// The values of several cells: bit `i` is `base + i`.
struct Sets {
    base: i64,
    sets: Vec<u128>,
}

/// Which values of two cells go together in a row.
#[derive(Debug)]
pub(crate) struct Partners {
    first: u32,
    second: u32,
    first_base: i64,
    second_base: i64,
    of_first: [u64; 64],
    of_second: [u64; 64],
}

fn floor(a: i128, b: i128) -> i128 {
    a.div_euclid(b)
}

fn ceiling(a: i128, b: i128) -> i128 {
    -((-a).div_euclid(b))
}
