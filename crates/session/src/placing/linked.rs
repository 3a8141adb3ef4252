//! Linked places: what hangs together is laid out along its links, as a circuit is along its parts.
//!
//! In: places without a place, and which two of them a part stands between. Out: rows and columns. Places are set one
//! after the other where that costs least, then each is moved for as long as that helps. A drawing costs much where
//! links cross or lie on each other, less where one is slanted, and least where it is long. The drawings of several
//! orders are compared.

use base::number::hypot;
use std::collections::BTreeSet;

/// A place on the grid: a column to the right and a row down.
pub(super) type Cell = [f64; 2];

/// What is to be laid out.
pub(super) struct Net {
    /// Where each place is, if that is given.
    pub(super) given: Vec<Option<Cell>>,
    /// What stands between two places, from the first to the second, in order of declaration.
    pub(super) links: Vec<[usize; 2]>,
    /// The places from which something hangs down that stands at no other.
    pub(super) hanging: BTreeSet<usize>,
}

/// So many places are laid out at most: each is compared with all others.
pub(super) const MOST: usize = 32;
/// So many are tried in all orders, and exchanged in pairs.
const FEW: usize = 12;
/// How often every place is moved, at most: of few, and of more.
const ROUNDS: [usize; 2] = [6, 2];
/// So many columns and rows away from what it hangs together with a place is tried.
const NEAR: f64 = 2.0;
/// What it costs that two links cross, or a place lies on one that does not lead to it.
const CROSSED: f64 = 24.0;
/// What it costs that two links or places lie on each other.
const COVERED: f64 = 40.0;
/// A place that is nearer to a link, in columns or rows, lies on it.
const ON: f64 = 0.3;
/// What it costs that a link lies neither in a row nor in a column.
const SLANTED: f64 = 4.0;

/// Lays out places that hang together, of which there are at most `MOST`; the answer has as many.
///
/// Without a given place the least column and row are zero.
pub(super) fn arranged(net: &Net) -> Vec<Cell> {
    let start = net.links.first().map_or(0, |link| link[0]);
    let is_few = net.given.len() <= FEW;
    let all = [(false, false), (true, false), (false, true), (true, true)];
    let (orders, rounds) = if is_few { (&all[..], ROUNDS[0]) } else { (&all[..2], ROUNDS[1]) };
    let mut best: Option<(f64, Vec<Cell>)> = None;
    let mut tried: BTreeSet<Vec<usize>> = BTreeSet::new();
    for &(is_deep, is_turned) in orders {
        let order = order(net, start, is_deep, is_turned);
        if !tried.insert(order.clone()) {
            continue;
        }
        let mut drawn = Drawn::new(net);
        for place in order {
            drawn.set(place);
        }
        for _ in 0..=rounds {
            let cost = drawn.cost();
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                let at = drawn.at.iter().map(|at| at.unwrap_or_default());
                best = Some((cost, at.collect()));
            }
            let is_moved = drawn.move_places() | drawn.move_links();
            if !(is_moved | (is_few && drawn.exchange())) {
                break;
            }
        }
    }
    best.map(|(_, at)| at).unwrap_or_default()
}

/// The order in which places are set: along the links from those that are given, else from one; deep or wide.
fn order(net: &Net, start: usize, is_deep: bool, is_turned: bool) -> Vec<usize> {
    let mut near = vec![Vec::new(); net.given.len()];
    for &[a, b] in &net.links {
        near[a].push(b);
        near[b].push(a);
    }
    if is_turned {
        near.iter_mut().for_each(|n| n.reverse());
    }
    let mut waiting: std::collections::VecDeque<usize> =
        (0..net.given.len()).filter(|&p| net.given[p].is_some()).collect();
    if waiting.is_empty() {
        waiting.push_back(start);
    }
    let mut order = Vec::new();
    let mut is_met = vec![false; net.given.len()];
    while let Some(place) = if is_deep { waiting.pop_back() } else { waiting.pop_front() } {
        if !std::mem::replace(&mut is_met[place], true) {
            order.push(place);
            waiting.extend(near[place].iter().filter(|&&n| !is_met[n]));
        }
    }
    order.retain(|&p| net.given[p].is_none());
    order
}

/// A drawing of a net under way.
struct Drawn<'n> {
    net: &'n Net,
    /// The links at each place.
    links_at: Vec<Vec<usize>>,
    /// Where each place is; nothing for one that is not set yet.
    at: Vec<Option<Cell>>,
    /// Nothing is given: rows and columns are counted anew as they come.
    is_free: bool,
}

impl<'n> Drawn<'n> {
    fn new(net: &'n Net) -> Self {
        let mut links_at = vec![Vec::new(); net.given.len()];
        for (n, link) in net.links.iter().enumerate() {
            for &end in link {
                links_at[end].push(n);
            }
        }
        let is_free = net.given.iter().all(Option::is_none);
        Self { net, links_at, at: net.given.clone(), is_free }
    }

    /// Sets a place where it costs least; false where it is there.
    fn set(&mut self, place: usize) -> bool {
        let was = self.at[place];
        let mut best = was.map(|at| (self.cost_at(place, f64::INFINITY) - 1e-9, at));
        let (columns, rows) = (self.lines(0, place), self.lines(1, place));
        for &(row, apart_down) in &rows {
            for &(column, apart) in &columns {
                self.at[place] = Some([column, row]);
                let least = best.map_or(f64::INFINITY, |(least, _)| least);
                let anew = apart + apart_down;
                let cost = self.cost_at(place, least - anew) + anew;
                if cost < least {
                    best = Some((cost, [column, row]));
                }
            }
        }
        self.at[place] = best.map(|(_, cell)| cell);
        let is_moved = self.at[place] != was;
        self.count_anew();
        is_moved
    }

    /// Moves every place to where it costs less; false where none does.
    fn move_places(&mut self) -> bool {
        let mut is_better = false;
        for place in 0..self.at.len() {
            is_better |= self.net.given[place].is_none() && self.set(place);
        }
        is_better
    }

    /// Moves both ends of every link to where they cost less; false where none does.
    fn move_links(&mut self) -> bool {
        let mut is_better = false;
        for &ends in &self.net.links {
            for [dx, dy] in [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]] {
                let to = ends.map(|end| self.at[end].map(|[x, y]| [x + dx, y + dy]));
                is_better |= self.place_two(ends, to);
            }
        }
        is_better
    }

    /// Exchanges two places where that costs less; false where none does.
    fn exchange(&mut self) -> bool {
        let mut is_better = false;
        for one in 0..self.at.len() {
            for other in 0..one {
                is_better |= self.place_two([one, other], [self.at[other], self.at[one]]);
            }
        }
        is_better
    }

    /// Puts two places elsewhere if they cost less there.
    fn place_two(&mut self, two: [usize; 2], to: [Option<Cell>; 2]) -> bool {
        if two.iter().any(|&place| self.net.given[place].is_some()) {
            return false;
        }
        let was = two.map(|place| self.at[place]);
        let all = f64::INFINITY;
        let cost = self.cost_at(two[0], all) + self.cost_at(two[1], all);
        two.iter().zip(to).for_each(|(&place, at)| self.at[place] = at);
        let first = self.cost_at(two[0], all);
        let is_better = first + self.cost_at(two[1], cost - first) < cost - 1e-9;
        if is_better {
            self.count_anew();
        } else {
            two.iter().zip(was).for_each(|(&place, at)| self.at[place] = at);
        }
        is_better
    }

    /// The columns or rows that a place may have, and what it costs to make a new one between others.
    fn lines(&self, axis: usize, place: usize) -> Vec<(f64, f64)> {
        let others = self.at.iter().enumerate().filter(|&(p, _)| p != place);
        let mut there: Vec<f64> = others.filter_map(|(_, at)| at.map(|at| at[axis])).collect();
        there.sort_by(f64::total_cmp);
        there.dedup();
        let (Some(&least), Some(&most)) = (there.first(), there.last()) else {
            return vec![(0.0, 0.0)];
        };
        let between = there.windows(2).map(|two| (f64::midpoint(two[0], two[1]), 1.5));
        let mut all: Vec<(f64, f64)> = between.filter(|_| self.is_free).collect();
        all.extend(there.iter().map(|&line| (line, 0.0)));
        all.extend([(least - 1.0, 0.0), (most + 1.0, 0.0)]);
        let near = self.links_at[place].iter().flat_map(|&link| self.net.links[link]);
        let near = near.filter(|&p| p != place).filter_map(|p| self.at[p].map(|at| at[axis]));
        let near: Vec<f64> = near.collect();
        if !self.is_free {
            all.extend(near.iter().flat_map(|line| [(line - 1.0, 0.0), (line + 1.0, 0.0)]));
        }
        let is_near = |line: f64| near.iter().any(|other| (line - other).abs() <= NEAR);
        all.retain(|&(line, _)| near.is_empty() || is_near(line));
        all
    }

    /// Numbers columns and rows by their order, so that those between others get room and empty ones vanish.
    fn count_anew(&mut self) {
        if !self.is_free {
            return;
        }
        for axis in 0..2 {
            let mut lines: Vec<f64> = self.at.iter().flatten().map(|at| at[axis]).collect();
            lines.sort_by(f64::total_cmp);
            lines.dedup();
            for at in self.at.iter_mut().flatten() {
                at[axis] = lines.partition_point(|&line| line < at[axis]) as f64;
            }
        }
    }

    /// What the whole drawing costs.
    fn cost(&self) -> f64 {
        let places = 0..self.at.len();
        let links = 0..self.net.links.len();
        let pairs = links.clone().flat_map(|a| (0..a).map(move |b| self.cost_of_two(a, b)));
        let on_links =
            places.clone().flat_map(|p| links.clone().map(move |link| self.cost_on(p, link)));
        places.clone().map(|p| self.cost_of_place(p)).sum::<f64>() / 2.0
            + links.clone().map(|link| self.cost_of_link(link)).sum::<f64>()
            + pairs.sum::<f64>()
            + on_links.sum::<f64>()
    }

    /// What of the cost depends on where one place is; any larger number where that is more than `most`.
    fn cost_at(&self, place: usize, most: f64) -> f64 {
        let own = &self.links_at[place];
        let mut cost = self.cost_of_place(place);
        cost += own.iter().map(|&link| self.cost_of_link(link)).sum::<f64>();
        for link in 0..self.net.links.len() {
            if cost > most {
                return cost;
            }
            cost += self.cost_on(place, link);
            for &own in own.iter().filter(|&&own| own != link) {
                cost += self.cost_of_two(own, link);
            }
        }
        for other in (0..self.at.len()).filter(|&other| other != place) {
            if cost > most {
                return cost;
            }
            cost += own.iter().map(|&own| self.cost_on(other, own)).sum::<f64>();
        }
        cost
    }

    /// What a place costs beside the others; what hangs hangs low.
    fn cost_of_place(&self, place: usize) -> f64 {
        let Some(at) = self.at[place] else { return 0.0 };
        let others = self.at.iter().enumerate().filter(|&(p, _)| p != place);
        let near = others.filter_map(|(_, other)| *other).filter(|&other| apart(at, other) < 0.4);
        let low = if self.net.hanging.contains(&place) { at[1] } else { 0.0 };
        COVERED * near.count() as f64 - low
    }

    /// What a place costs that lies on a link.
    fn cost_on(&self, place: usize, link: usize) -> f64 {
        let ends = self.net.links[link];
        let (Some(at), Some([a, b])) = (self.at[place], self.ends(link)) else { return 0.0 };
        let is_on = !ends.contains(&place) && is_within(at, a, b) && distance(at, a, b) < ON;
        if is_on { CROSSED } else { 0.0 }
    }

    /// What a link costs for itself: what is read goes to the right and down, and the first stands to the left.
    fn cost_of_link(&self, link: usize) -> f64 {
        let Some([a, b]) = self.ends(link) else { return 0.0 };
        let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
        let is_slanted = dx.abs() > 0.05 && dy.abs() > 0.05;
        let is_skew = is_slanted && (dx.abs() - dy.abs()).abs() > 0.05;
        let slanted =
            if is_slanted { SLANTED } else { 0.0 } + if is_skew { SLANTED / 4.0 } else { 0.0 };
        let backwards = if dx < 0.0 || dy < 0.0 { 0.6 } else { 0.0 };
        let first = match link {
            0 => a[0] + b[0] + if dx.abs() > 0.05 { SLANTED } else { 0.0 },
            _ => 0.0,
        };
        let from_hanging = self.net.links[link].iter().zip([dy, -dy]);
        let below =
            from_hanging.filter(|&(end, down)| down > 0.05 && self.net.hanging.contains(end));
        dx.abs() + dy.abs() + slanted + backwards + first + 4.0 * below.count() as f64
    }

    /// What two links cost that cross, or leave a place the same way.
    fn cost_of_two(&self, one: usize, other: usize) -> f64 {
        let (Some([a, b]), Some([c, d])) = (self.ends(one), self.ends(other)) else { return 0.0 };
        let ends = self.net.links[one];
        let other_ends = self.net.links[other];
        let shared = ends.iter().filter(|&end| other_ends.contains(end)).count();
        match shared {
            0 => {
                if !do_overlap([a, b], [c, d]) {
                    return 0.0;
                }
                let sides = side(a, b, c) * side(a, b, d) < -1e-9;
                if sides && side(c, d, a) * side(c, d, b) < -1e-9 { CROSSED } else { 0.0 }
            }
            1 => {
                // the two other ends, from the one that is shared
                let (from, to) = if other_ends.contains(&ends[0]) { (a, b) } else { (b, a) };
                let on = if apart(from, c) < apart(from, d) { d } else { c };
                let [u, v] =
                    [[to[0] - from[0], to[1] - from[1]], [on[0] - from[0], on[1] - from[1]]];
                let is_along = u[0] * v[0] + u[1] * v[1] > 0.0;
                let turned = (u[0] * v[1] - u[1] * v[0]).abs();
                let is_narrow = turned < 0.3 * hypot(u[0], u[1]) * hypot(v[0], v[1]);
                if is_along && is_narrow { COVERED } else { 0.0 }
            }
            // nothing parts what stands between the same two
            _ => 0.0,
        }
    }

    fn ends(&self, link: usize) -> Option<[Cell; 2]> {
        let [a, b] = self.net.links[link];
        Some([self.at[a]?, self.at[b]?])
    }
}

fn apart(a: Cell, b: Cell) -> f64 {
    hypot(a[0] - b[0], a[1] - b[1])
}

/// Twice the area of a triangle; negative where it turns the other way.
fn side(a: Cell, b: Cell, c: Cell) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Whether a place is near the box around two others.
fn is_within(at: Cell, a: Cell, b: Cell) -> bool {
    (0..2).all(|i| at[i] > a[i].min(b[i]) - ON && at[i] < a[i].max(b[i]) + ON)
}

/// Whether the boxes around two pairs of places have anything in common.
fn do_overlap([a, b]: [Cell; 2], [c, d]: [Cell; 2]) -> bool {
    (0..2).all(|i| a[i].min(b[i]) <= c[i].max(d[i]) && c[i].min(d[i]) <= a[i].max(b[i]))
}

/// How far a place is from the segment between two.
fn distance(at: Cell, a: Cell, b: Cell) -> f64 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let square = dx * dx + dy * dy;
    if square <= 0.0 {
        return apart(at, a);
    }
    let t = (((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / square).clamp(0.0, 1.0);
    apart(at, [a[0] + t * dx, a[1] + t * dy])
}
