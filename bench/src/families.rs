//! Families of cases, of any size: the same from the same family, size and seed.
//!
//! In: a name, a size, a seed. Out: a [`Case`] whose truth was known before its constraints, and whose
//! start is the truth with noise.

use crate::case::{Case, Constraint, Drag, End};
use base::number::{cos, sin};
use base::scrambled;
use std::f64::consts::{FRAC_PI_3, PI};

/// A family of cases.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Family {
    /// Squares in a row, each at the corner of the one before; corners are shared points.
    Rects,
    /// The same, every line with ends of its own, corners coincident.
    Rectsc,
    /// Squares that have nothing to do with each other.
    Indep,
    /// Lines at right angles, joined by tangent arcs.
    Arcs,
    /// Triangles in a row.
    Truss,
    /// Rigid frameworks, half of whose points split a random bar.
    Henneberg2,
    /// A grid of squares; the first row and column say how large.
    Grid,
    /// A grid, every side of which is said to be as long as the first.
    Gridr,
    /// A loop of bars, driven by the angle of the first.
    Linkage,
    /// A loop of bars, dragged by the end of the first.
    Linkdrag,
}

/// Every family, with its name.
pub const FAMILIES: [(&str, Family); 10] = [
    ("rects", Family::Rects),
    ("rectsc", Family::Rectsc),
    ("indep", Family::Indep),
    ("arcs", Family::Arcs),
    ("truss", Family::Truss),
    ("henneberg2", Family::Henneberg2),
    ("grid", Family::Grid),
    ("gridr", Family::Gridr),
    ("linkage", Family::Linkage),
    ("linkdrag", Family::Linkdrag),
];

/// Makes a case; `size` is at least 4.
pub fn generate(family: Family, size: usize, seed: u64) -> Case {
    let name = FAMILIES.iter().find(|(_, f)| *f == family).map_or("", |(name, _)| name);
    let mut made = Made::new(format!("{name}-{size}"), seed);
    let size = size.max(4);
    match family {
        Family::Rects => made.rects(size, Corners::Shared),
        Family::Rectsc => made.rects(size, Corners::Coincident),
        Family::Indep => made.rects(size, Corners::Apart),
        Family::Arcs => made.arcs(size),
        Family::Truss => made.truss(size),
        Family::Henneberg2 => made.henneberg(size),
        Family::Grid => made.grid(size, false),
        Family::Gridr => made.grid(size, true),
        Family::Linkage => {
            made.linkage(size);
            made.turn();
        }
        Family::Linkdrag => {
            made.linkage(size);
            made.pull();
        }
    }
    made.case
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Corners {
    Shared,
    Coincident,
    Apart,
}

struct Made {
    case: Case,
    /// The state of the noise: splitmix64. **Source:** Steele, Lea, Flood 2014.
    state: u64,
}

impl Made {
    fn new(name: String, seed: u64) -> Self {
        let case = Case {
            format: "gcs-case/1".into(),
            name,
            well_constrained: true,
            start: Vec::new(),
            truth: Vec::new(),
            lines: Vec::new(),
            arcs: Vec::new(),
            constraints: Vec::new(),
            drag: None,
        };
        Self { case, state: seed }
    }

    /// Returns a number from -1 to 1.
    fn noise(&mut self) -> f64 {
        let z = scrambled(self.state);
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        (z >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn below(&mut self, n: usize) -> usize {
        (((self.noise() + 1.0) / 2.0 * n as f64) as usize).min(n - 1)
    }

    fn point(&mut self, at: [f64; 2], rough: f64) -> usize {
        self.case.truth.push(at);
        let start = at.map(|x| x + rough * self.noise());
        self.case.start.push(start);
        self.case.truth.len() - 1
    }
    fn fixed(&mut self, at: [f64; 2]) -> usize {
        let p = self.point(at, 0.0);
        self.hold(Constraint::Fix { p, x: at[0], y: at[1] });
        p
    }
    fn line(&mut self, p: usize, q: usize) -> usize {
        self.case.lines.push([p, q]);
        self.case.lines.len() - 1
    }
    fn hold(&mut self, constraint: Constraint) {
        self.case.constraints.push(constraint);
    }
    fn bar(&mut self, p: usize, q: usize) {
        let v = distance(self.case.truth[p], self.case.truth[q]);
        self.hold(Constraint::Distance { p, q, v });
    }

    fn rects(&mut self, n: usize, corners: Corners) {
        let mut at = [0.0, 0.0];
        let mut last: Option<usize> = None;
        for i in 0..n {
            let size = 10.0 + 2.0 * self.noise();
            let [x, y] = at;
            let places = [[x, y], [x + size, y], [x + size, y + size], [x, y + size]];
            let ends: Vec<[usize; 2]> = if corners == Corners::Shared {
                let first = last.unwrap_or_else(|| self.fixed(places[0]));
                let p = [
                    first,
                    self.point(places[1], 1.0),
                    self.point(places[2], 1.0),
                    self.point(places[3], 1.0),
                ];
                (0..4).map(|k| [p[k], p[(k + 1) % 4]]).collect()
            } else {
                let is_first = i == 0 || corners == Corners::Apart;
                let mut end = |k: usize, rough| self.point(places[k % 4], rough);
                (0..4)
                    .map(|k| [end(k, if k == 0 && is_first { 0.0 } else { 1.0 }), end(k + 1, 1.0)])
                    .collect()
            };
            if corners != Corners::Shared {
                let first = ends[0][0];
                match last {
                    Some(q) if corners == Corners::Coincident => {
                        self.hold(Constraint::Coincident { p: q, q: first });
                    }
                    Some(_) | None => self.hold(Constraint::Fix { p: first, x, y }),
                }
                for k in 0..4 {
                    self.hold(Constraint::Coincident { p: ends[k][1], q: ends[(k + 1) % 4][0] });
                }
            }
            let l: Vec<usize> = ends.iter().map(|&[p, q]| self.line(p, q)).collect();
            for k in [0, 2] {
                self.hold(Constraint::Horizontal { l: l[k] });
                self.hold(Constraint::Vertical { l: l[k + 1] });
            }
            self.hold(Constraint::Distance { p: ends[0][0], q: ends[0][1], v: size });
            self.hold(Constraint::EqualLength { l: l[0], m: l[1] });
            last = Some(ends[1][1]);
            at = match corners {
                Corners::Shared | Corners::Coincident => places[2],
                Corners::Apart => [x + 20.0, y],
            };
        }
    }

    /// Right, up, right, …: each bend a quarter of a circle of radius 5.
    fn arcs(&mut self, n: usize) {
        let mut at = [0.0, 0.0];
        let mut from = self.fixed(at);
        let mut bend: Option<usize> = None;
        for i in 0..=n {
            let long = f64::from(10 + self.below(3) as u32);
            let (along, aside) =
                if i % 2 == 0 { ([1.0, 0.0], [0.0, 1.0]) } else { ([0.0, 1.0], [1.0, 0.0]) };
            at = step(at, along, long);
            let to = self.point(at, 0.5);
            let l = self.line(from, to);
            if i == 0 {
                self.hold(Constraint::Horizontal { l });
            }
            self.hold(Constraint::Distance { p: from, q: to, v: long });
            // turning left an arc starts where the line before it ends, turning right it ends there
            let left = i % 2 == 0;
            if let Some(a) = bend {
                self.hold(Constraint::TangentArcLine {
                    a,
                    l,
                    at: if left { End::Start } else { End::End },
                });
            }
            if i == n {
                break;
            }
            let center = self.point(step(at, aside, 5.0), 0.5);
            at = step(step(at, aside, 5.0), along, 5.0);
            from = self.point(at, 0.5);
            self.case.arcs.push(if left { [center, to, from] } else { [center, from, to] });
            let a = self.case.arcs.len() - 1;
            self.hold(Constraint::ArcRadius { a, v: 5.0 });
            self.bar(to, from);
            self.hold(Constraint::TangentArcLine {
                a,
                l,
                at: if left { End::Start } else { End::End },
            });
            bend = Some(a);
        }
    }

    fn truss(&mut self, n: usize) {
        self.fixed([0.0, 0.0]);
        for i in 1..n {
            let p = self.point([5.0 * i as f64, if i % 2 == 0 { 0.0 } else { 8.0 }], 1.0);
            if i == 2 {
                let l = self.line(0, 2);
                self.hold(Constraint::Horizontal { l });
            }
            self.bar(p - 1, p);
            if i >= 2 {
                self.bar(p - 2, p);
            }
        }
    }

    fn henneberg(&mut self, n: usize) {
        let columns = (1..).find(|c| c * c >= n).unwrap_or(1);
        let mut bars: Vec<[usize; 2]> = vec![[0, 1]];
        for i in 0..n {
            let [x, y] = [(i % columns) as f64 * 10.0, (i / columns) as f64 * 10.0];
            let at = [
                x + 3.0 * self.noise(),
                if i == 1 { self.case.truth[0][1] } else { y + 3.0 * self.noise() },
            ];
            let p = if i == 0 { self.fixed(at) } else { self.point(at, 0.3) };
            if i < 2 {
                continue;
            }
            let near = nearest(&self.case.truth, p);
            if i == 2 || self.noise() < 0.0 {
                bars.extend([[near[0], p], [near[1], p]]);
                continue;
            }
            // the bar that is split is one of those around
            let around: Vec<usize> = (0..bars.len())
                .filter(|&b| bars[b].iter().any(|q| near[..3.min(near.len())].contains(q)))
                .collect();
            let choice = self.below(around.len());
            let [a, b] = bars.swap_remove(around[choice]);
            let third = near.iter().copied().find(|&q| q != a && q != b).unwrap_or(a);
            bars.extend([[a, p], [b, p], [third, p]]);
        }
        let l = self.line(0, 1);
        self.hold(Constraint::Horizontal { l });
        bars.sort_unstable();
        bars.iter().for_each(|&[p, q]| self.bar(p, q));
    }

    fn grid(&mut self, k: usize, all_equal: bool) {
        for i in 0..k * k {
            let at = [10.0 * (i % k) as f64, 10.0 * (i / k) as f64];
            if i == 0 {
                self.fixed(at)
            } else {
                self.point(at, 1.0)
            };
        }
        let mut rows = Vec::new();
        for i in (0..k * k).filter(|i| i % k + 1 < k) {
            rows.push(self.line(i, i + 1));
        }
        let mut columns = Vec::new();
        for i in 0..k * (k - 1) {
            columns.push(self.line(i, i + k));
        }
        rows.iter().for_each(|&l| self.hold(Constraint::Horizontal { l }));
        columns.iter().for_each(|&l| self.hold(Constraint::Vertical { l }));
        self.hold(Constraint::Distance { p: 0, q: 1, v: 10.0 });
        let first = rows[0];
        let is_told = |l: &usize| {
            let [p, _] = self.case.lines[*l];
            all_equal || (if *l < columns[0] { p < k } else { p % k == 0 })
        };
        let equal: Vec<usize> =
            rows.iter().chain(&columns).copied().filter(|&l| l != first).filter(is_told).collect();
        equal.into_iter().for_each(|m| self.hold(Constraint::EqualLength { l: first, m }));
    }

    /// `n - 1` bars of 10 from one fixed point to another: a crank at 60°, the others along a bow.
    fn linkage(&mut self, n: usize) {
        let end = [6.0 * (n - 2) as f64, 0.0];
        let crank = [10.0 * cos(FRAC_PI_3), 10.0 * sin(FRAC_PI_3)];
        self.fixed([0.0, 0.0]);
        self.point(crank, 0.2);
        let bow = bow(crank, end, n - 2, 10.0);
        for &at in &bow[..n - 3] {
            self.point(at, 0.2);
        }
        let last = self.fixed(end);
        self.line(0, last);
        self.line(0, 1);
        for p in 0..last {
            self.bar(p, p + 1);
        }
        self.case.well_constrained = false;
    }
    fn turn(&mut self) {
        self.hold(Constraint::Angle { l: 0, m: 1, v: FRAC_PI_3 });
        self.case.well_constrained = self.case.start.len() == 4;
        let c = self.case.constraints.len() - 1;
        let values = (1..=100).map(|i| FRAC_PI_3 + f64::from(i) * PI / 360.0).collect();
        self.case.drag = Some(Drag::Param { c, values });
    }
    fn pull(&mut self) {
        let path = (1..=100).map(|i| {
            let angle = FRAC_PI_3 + f64::from(i) * PI / 360.0;
            [12.0 * cos(angle), 12.0 * sin(angle)]
        });
        self.case.drag = Some(Drag::Point { p: 1, path: path.collect() });
    }
}

fn step(at: [f64; 2], along: [f64; 2], far: f64) -> [f64; 2] {
    [at[0] + along[0] * far, at[1] + along[1] * far]
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    let (x, y) = (q[0] - p[0], q[1] - p[1]);
    (x * x + y * y).sqrt()
}

/// Returns the points before `p`, nearest first.
fn nearest(points: &[[f64; 2]], p: usize) -> Vec<usize> {
    let mut near: Vec<usize> = (0..p).collect();
    near.sort_by(|&a, &b| {
        distance(points[a], points[p]).total_cmp(&distance(points[b], points[p]))
    });
    near
}

/// Returns the corners of `n` bars along a circle that bows to the left from `p` to `q`, `q` the last.
fn bow(p: [f64; 2], q: [f64; 2], n: usize, bar: f64) -> Vec<[f64; 2]> {
    let chord = distance(p, q);
    // the chord of n bars that turn by 2t from one to the next is bar * sin(n t) / sin(t)
    let (mut low, mut high) = (1e-9, PI / n as f64);
    for _ in 0..200 {
        let t = (low + high) / 2.0;
        if bar * sin(n as f64 * t) / sin(t) > chord { low = t } else { high = t }
    }
    let t = (low + high) / 2.0;
    let toward = [(q[0] - p[0]) / chord, (q[1] - p[1]) / chord];
    let mut at = p;
    let turned = |angle: f64| {
        [
            toward[0] * cos(angle) - toward[1] * sin(angle),
            toward[0] * sin(angle) + toward[1] * cos(angle),
        ]
    };
    (0..n)
        .map(|i| {
            at = if i + 1 == n {
                q
            } else {
                step(at, turned((n as f64 - 1.0 - 2.0 * i as f64) * t), bar)
            };
            at
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::residual::largest;

    #[test]
    fn the_truth_is_true_and_the_start_is_not() {
        for (name, family) in FAMILIES {
            for size in [4, 7, 12] {
                let case = generate(family, size, 3);
                let off = |points| largest(&case, &case.constraints, points);
                assert!(off(&case.truth) < 1e-9, "{name} {size}: {}", off(&case.truth));
                assert!(off(&case.start) > 1e-3, "{name} {size} begins solved");
                assert_eq!(case, generate(family, size, 3), "{name} {size}: the same again");
                assert_ne!(case.start, generate(family, size, 4).start, "{name} {size}: a seed");
            }
        }
    }

    #[test]
    fn families_are_as_constrained_as_they_say() {
        let rows = |case: &Case| {
            let row = |c: &Constraint| match c {
                Constraint::Fix { .. } | Constraint::Coincident { .. } => 2,
                Constraint::Horizontal { .. }
                | Constraint::Vertical { .. }
                | Constraint::Distance { .. }
                | Constraint::EqualLength { .. }
                | Constraint::ArcRadius { .. }
                | Constraint::TangentArcLine { .. }
                | Constraint::Angle { .. } => 1,
            };
            case.constraints.iter().map(row).sum::<i64>() + case.arcs.len() as i64
        };
        let surplus = |family, size| {
            let case = generate(family, size, 5);
            rows(&case) - 2 * case.start.len() as i64
        };
        for (_, family) in &FAMILIES[..7] {
            assert_eq!(surplus(*family, 9), 0, "{family:?}");
        }
        assert_eq!(surplus(Family::Gridr, 10), 162);
        assert_eq!(surplus(Family::Linkage, 10), -6);
        assert_eq!(surplus(Family::Linkdrag, 10), -7);
    }
}
