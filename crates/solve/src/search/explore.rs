//! Exploring: depth first through what propagation leaves open.
//!
//! In: rows and domains. Out: the first, the nearest or the number of the solutions. The cell with
//! the fewest values comes first, of equals the first by declaration; its values by their distance
//! from where it was, the smaller first. Nothing else chooses, so every run is the same.

use super::domain::Domain;
use super::propagate::{Dead, Field, Partners};
use super::row::Row;
use std::collections::VecDeque;
use std::rc::Rc;

/// How many times a row is run, on an average, until the bounds of what is still open are let be: those of contrary
/// rows may creep towards one another without end.
const TURNS: usize = 1_000;
/// What it costs to look at one cell of a row, in multiplications, roughly.
const CELL: u64 = 50;

/// Rows with what is needed to run them: who has to hear of which cell.
pub(crate) struct Net<'a> {
    rows: Vec<&'a Row>,
    partners: Vec<Option<Box<Partners>>>,
    watching: Vec<Vec<u32>>,
    /// What running each row costs, in multiplications, roughly.
    costs: Vec<u64>,
}

impl<'a> Net<'a> {
    pub(crate) fn new(rows: Vec<&'a Row>, field: &mut Field<'_>) -> Self {
        let mut watching = vec![Vec::new(); field.domains.len()];
        let mut costs = Vec::with_capacity(rows.len());
        for (i, row) in (0..).zip(&rows) {
            let cells = row.cells();
            costs.push(cells.len() as u64 * CELL);
            cells.into_iter().for_each(|c| watching[c as usize].push(i));
        }
        let partners = |row: &&Row| match row {
            Row::General(general) => field.partners(general).map(Box::new),
            Row::Linear(_) | Row::Different(_) | Row::All(_) | Row::Any(_) => None,
        };
        let partners = rows.iter().map(partners).collect();
        Self { rows, partners, watching, costs }
    }

    /// Runs every row until nothing shrinks, or creeps.
    pub(crate) fn settle_all(&self, field: &mut Field<'_>) -> Result<(), Dead> {
        self.settle(field, (0..self.rows.len() as u32).collect())
    }

    /// Runs the rows that speak of cells that shrank, until nothing shrinks.
    fn settle_shrunk(&self, field: &mut Field<'_>) -> Result<(), Dead> {
        self.settle(field, VecDeque::new())
    }

    fn settle(&self, field: &mut Field<'_>, mut waiting: VecDeque<u32>) -> Result<(), Dead> {
        let mut waits = vec![false; self.rows.len()];
        waiting.iter().for_each(|&r| waits[r as usize] = true);
        let mut turns = TURNS * self.rows.len();
        loop {
            for cell in std::mem::take(&mut field.shrunk) {
                for &row in &self.watching[cell as usize] {
                    if !std::mem::replace(&mut waits[row as usize], true) {
                        waiting.push_back(row);
                    }
                }
            }
            let Some(row) = waiting.pop_front() else { return Ok(()) };
            waits[row as usize] = false;
            let is_open = |c: &u32| field.domains[*c as usize].known().is_none();
            if turns == 0 && self.rows[row as usize].cells().iter().any(is_open) {
                // it is run again when one of these shrinks
                continue;
            }
            turns = turns.saturating_sub(1);
            field.spent += self.costs[row as usize];
            match &self.partners[row as usize] {
                Some(partners) => field.pair_up(partners)?,
                None => field.propagate(self.rows[row as usize])?,
            }
        }
    }
}

/// What is told of every state that is met.
pub(crate) trait Visitor {
    /// Returns false where nothing below this state is of interest.
    fn enter(&mut self, field: &Field<'_>) -> bool;
    /// Takes a solution; returns false to end the search.
    fn found(&mut self, solution: &Field<'_>) -> bool;
    /// Returns how many states may still be visited; 0 ends the search.
    fn patience(&self, visited: u64) -> u64;
}

/// How a search ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum End {
    /// Everything was looked at.
    Exhausted,
    /// The visitor has what it wants.
    Content,
    /// So many states were visited, or what it may cost was spent.
    Bound(u64),
}

/// A state to be visited: one cell of a state loses values.
struct Step {
    domains: Rc<[Domain]>,
    cell: u32,
    domain: Domain,
}

/// Visits the solutions of a net whose rows are settled.
///
/// `near` are the numbers that values should be near to.
pub(crate) fn explore(
    net: &Net<'_>,
    field: &mut Field<'_>,
    near: &[f64],
    visitor: &mut dyn Visitor,
) -> End {
    let mut visited = 0;
    let mut stack: Vec<Step> = Vec::new();
    if !visitor.enter(field) {
        return End::Exhausted;
    }
    if !branch(field, near, &mut stack) && !visitor.found(field) {
        return End::Content;
    }
    while let Some(Step { domains, cell, domain }) = stack.pop() {
        if visitor.patience(visited) == 0 || field.spent > field.most {
            return End::Bound(visited);
        }
        visited += 1;
        field.spent += domains.len() as u64;
        field.domains.copy_from_slice(&domains);
        field.shrunk.clear();
        let is_open = field.put(cell, domain).and_then(|()| net.settle_shrunk(field)).is_ok();
        if !is_open || !visitor.enter(field) {
            continue;
        }
        if !branch(field, near, &mut stack) && !visitor.found(field) {
            return End::Content;
        }
    }
    End::Exhausted
}

/// Puts what one cell may be on the stack, the nearest on top; returns false where all are known.
fn branch(field: &Field<'_>, near: &[f64], stack: &mut Vec<Step>) -> bool {
    let open = (0..).zip(&field.domains).filter(|(_, d)| d.size() > 1);
    let Some((cell, &domain)) = open.min_by_key(|(_, d)| d.size()) else { return false };
    let domains: Rc<[Domain]> = field.domains.as_slice().into();
    let mut push = |domain: Domain| {
        if !domain.is_empty() {
            stack.push(Step { domains: domains.clone(), cell, domain });
        }
    };
    let near = near[cell as usize];
    match domain.values() {
        Some(values) => {
            let mut values: Vec<i64> = values.collect();
            values.sort_by(|&a, &b| {
                let (x, y) = ((a as f64 - near).abs(), (b as f64 - near).abs());
                x.total_cmp(&y).then(a.cmp(&b))
            });
            values.into_iter().rev().for_each(|v| push(Domain::one(v)));
        }
        None => {
            let first = domain.nearest(near);
            push(domain.clip(first + 1, i64::MAX));
            push(domain.clip(i64::MIN, first - 1));
            push(Domain::one(first));
        }
    }
    true
}
