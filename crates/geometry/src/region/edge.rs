//! Edges of regions: segments and arcs, and where they meet.

use base::number::{asin, atan, atan2, cos, hypot, sin, sqrt};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A place or a way.
pub(crate) type V = [f64; 2];

pub(crate) fn minus(p: V, q: V) -> V {
    [p[0] - q[0], p[1] - q[1]]
}
/// Returns `p + k q`.
pub(crate) fn further(p: V, k: f64, q: V) -> V {
    [p[0] + k * q[0], p[1] + k * q[1]]
}
pub(crate) fn dot(p: V, q: V) -> f64 {
    p[0] * q[0] + p[1] * q[1]
}
/// Returns the area that two ways span, positive where the second turns left.
pub(crate) fn cross(p: V, q: V) -> f64 {
    p[0] * q[1] - p[1] * q[0]
}
pub(crate) fn distance(p: V, q: V) -> f64 {
    hypot(p[0] - q[0], p[1] - q[1])
}
fn middle(p: V, q: V) -> V {
    [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]
}

/// What an edge is a part of.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Carrier {
    Straight,
    /// A circle; the edge runs to the right around it where the radius is negative.
    Round {
        center: V,
        radius: f64,
    },
}

/// A segment, or an arc of less than a whole turn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Edge {
    pub(crate) from: V,
    pub(crate) to: V,
    pub(crate) carrier: Carrier,
    /// The signed angle that an arc turns through; 0 for a segment.
    pub(crate) sweep: f64,
}

impl Edge {
    pub(crate) fn segment(from: V, to: V) -> Self {
        Self { from, to, carrier: Carrier::Straight, sweep: 0.0 }
    }
    /// Makes the edge from one corner to the next, which bends as a bulge says.
    pub(crate) fn bent(from: V, to: V, bulge: f64) -> Self {
        let way = minus(to, from);
        let chord = hypot(way[0], way[1]);
        if bulge == 0.0 || chord == 0.0 {
            return Self::segment(from, to);
        }
        // the centre lies beside the middle of the chord
        let aside = (1.0 - bulge * bulge) / (4.0 * bulge);
        let center = further(middle(from, to), aside, [-way[1], way[0]]);
        let radius = chord * (1.0 + bulge * bulge) / (4.0 * bulge);
        Self { from, to, carrier: Carrier::Round { center, radius }, sweep: 4.0 * atan(bulge) }
    }
    /// Makes the arc around a centre between two places, less than a whole turn.
    pub(crate) fn around(center: V, radius: f64, from: V, to: V) -> Self {
        let (p, q) = (minus(from, center), minus(to, center));
        let turn = atan2(cross(p, q), dot(p, q));
        let sweep = match (radius < 0.0, turn) {
            (false, t) if t < 0.0 => t + TAU,
            (true, t) if t > 0.0 => t - TAU,
            (_, t) => t,
        };
        Self { from, to, carrier: Carrier::Round { center, radius }, sweep }
    }
    pub(crate) fn reversed(self) -> Self {
        let carrier = match self.carrier {
            Carrier::Straight => Carrier::Straight,
            Carrier::Round { center, radius } => Carrier::Round { center, radius: -radius },
        };
        Self { from: self.to, to: self.from, carrier, sweep: -self.sweep }
    }
    pub(crate) fn chord(&self) -> f64 {
        distance(self.from, self.to)
    }
    /// Returns the place at a part of it.
    pub(crate) fn at(&self, part: f64) -> V {
        match self.carrier {
            Carrier::Straight => further(self.from, part, minus(self.to, self.from)),
            Carrier::Round { center, .. } => turned(self.from, center, part * self.sweep),
        }
    }
    /// Returns the way that it runs at a part of it, of length 1.
    pub(crate) fn way(&self, part: f64) -> V {
        let way = match self.carrier {
            Carrier::Straight => minus(self.to, self.from),
            Carrier::Round { center, radius } => {
                let out = minus(self.at(part), center);
                if radius < 0.0 { [out[1], -out[0]] } else { [-out[1], out[0]] }
            }
        };
        let length = hypot(way[0], way[1]).max(f64::MIN_POSITIVE);
        [way[0] / length, way[1] / length]
    }
    /// Returns at which part of it a place is nearest; below 0 before its start, above 1 behind its end.
    pub(crate) fn part(&self, p: V) -> f64 {
        match self.carrier {
            Carrier::Straight => {
                let way = minus(self.to, self.from);
                dot(minus(p, self.from), way) / dot(way, way).max(f64::MIN_POSITIVE)
            }
            Carrier::Round { center, .. } => {
                let (a, b) = (minus(self.from, center), minus(p, center));
                let turn = atan2(cross(a, b), dot(a, b));
                let turn = if self.sweep < 0.0 { -turn } else { turn };
                // what lies behind the end is nearer to it than to the start
                let gap = TAU - self.sweep.abs();
                let turn = if turn < -0.5 * gap { turn + TAU } else { turn };
                turn / self.sweep.abs().max(f64::MIN_POSITIVE)
            }
        }
    }
    /// Returns how far a place is from it.
    pub(crate) fn distance(&self, p: V) -> f64 {
        let part = self.part(p);
        if (0.0..=1.0).contains(&part) {
            return match self.carrier {
                Carrier::Straight => distance(p, self.at(part)),
                Carrier::Round { center, radius } => (distance(p, center) - radius.abs()).abs(),
            };
        }
        distance(p, self.from).min(distance(p, self.to))
    }
    /// Returns the parts of it between its ends where it is highest or lowest.
    pub(crate) fn turning(&self) -> Vec<f64> {
        let Carrier::Round { center, .. } = self.carrier else { return Vec::new() };
        let start = atan2(self.from[1] - center[1], self.from[0] - center[0]);
        let parts = [FRAC_PI_2, -FRAC_PI_2].into_iter().map(|top| {
            let turn = if self.sweep < 0.0 { start - top } else { top - start };
            let turn = if turn < 0.0 { turn + TAU } else { turn };
            turn / self.sweep.abs().max(f64::MIN_POSITIVE)
        });
        parts.filter(|&part| 0.0 < part && part < 1.0).collect()
    }
    /// Returns the area between it and the origin's ways to its ends, positive where it turns left around it.
    pub(crate) fn area(&self) -> f64 {
        let beyond = match self.carrier {
            Carrier::Straight => 0.0,
            Carrier::Round { radius, .. } => radius * radius * (self.sweep - sin(self.sweep)),
        };
        0.5 * (cross(self.from, self.to) + beyond)
    }
    /// Returns the place on it so far, as the crow flies, from its start.
    pub(crate) fn off(&self, far: f64) -> V {
        match self.carrier {
            Carrier::Straight => further(self.from, far, self.way(0.0)),
            Carrier::Round { center, radius } => {
                let turn = 2.0 * asin((far / (2.0 * radius)).clamp(-1.0, 1.0));
                turned(self.from, center, turn)
            }
        }
    }
}

/// Turns a place to the left around another.
pub(crate) fn turned(p: V, center: V, angle: f64) -> V {
    let ([x, y], c, s) = (minus(p, center), cos(angle), sin(angle));
    [center[0] + x * c - y * s, center[1] + x * s + y * c]
}

/// Names the places, near both, where two edges touch or cross; what they have in common begins and ends there.
pub(crate) fn meetings(e: &Edge, f: &Edge, near: f64, say: &mut dyn FnMut(V)) {
    let lies_on = |edge: &Edge, p: V| edge.distance(p) <= near;
    for p in [f.from, f.to].into_iter().filter(|&p| lies_on(e, p)) {
        say(p);
    }
    for p in [e.from, e.to].into_iter().filter(|&p| lies_on(f, p)) {
        say(p);
    }
    let mut both = |p: V| {
        if lies_on(e, p) && lies_on(f, p) {
            say(p);
        }
    };
    match (e.carrier, f.carrier) {
        (Carrier::Straight, Carrier::Straight) => {
            let (a, b) = (minus(e.to, e.from), minus(f.to, f.from));
            let across = cross(a, b);
            if across.abs() > 1e-12 * e.chord() * f.chord() {
                both(further(e.from, cross(minus(f.from, e.from), b) / across, a));
            }
        }
        (Carrier::Straight, Carrier::Round { center, radius }) => {
            straight_meets(e, center, radius.abs(), near, &mut both);
        }
        (Carrier::Round { center, radius }, Carrier::Straight) => {
            straight_meets(f, center, radius.abs(), near, &mut both);
        }
        (Carrier::Round { center: c, radius: r }, Carrier::Round { center: d, radius: s }) => {
            rounds_meet((c, r.abs()), (d, s.abs()), near, &mut both);
        }
    }
}

fn straight_meets(e: &Edge, center: V, radius: f64, near: f64, say: &mut dyn FnMut(V)) {
    let way = e.way(0.0);
    let foot = further(e.from, dot(minus(center, e.from), way), way);
    let far = distance(foot, center);
    if (far - radius).abs() <= near {
        say(foot);
    } else if far < radius {
        let half = sqrt((radius - far) * (radius + far));
        say(further(foot, half, way));
        say(further(foot, -half, way));
    }
}

fn rounds_meet((c, r): (V, f64), (d, s): (V, f64), near: f64, say: &mut dyn FnMut(V)) {
    let far = distance(c, d);
    if far <= near {
        return;
    }
    let way = [(d[0] - c[0]) / far, (d[1] - c[1]) / far];
    if (far - r - s).abs() <= near {
        say(further(c, r, way));
    } else if (far - (r - s).abs()).abs() <= near {
        say(further(c, if r > s { r } else { -r }, way));
    } else if far < r + s && far > (r - s).abs() {
        let along = (far * far + (r - s) * (r + s)) / (2.0 * far);
        let half = sqrt((r * r - along * along).max(0.0));
        let foot = further(c, along, way);
        say(further(foot, half, [-way[1], way[0]]));
        say(further(foot, -half, [-way[1], way[0]]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(e: &Edge, f: &Edge) -> Vec<V> {
        let mut all = Vec::new();
        meetings(e, f, 1e-9, &mut |p| all.push(p));
        all
    }
    #[test]
    fn a_segment_meets_half_a_circle_once() {
        let half = Edge::bent([1.0, 0.0], [-1.0, 0.0], 1.0);
        let upright = Edge::segment([0.6, -2.0], [0.6, 2.0]);
        let all = found(&half, &upright);
        assert_eq!(all.len(), 1);
        assert!((all[0][0] - 0.6).abs() < 1e-15 && (all[0][1] - 0.8).abs() < 1e-15, "{all:?}");
    }
    #[test]
    fn what_is_common_to_two_segments_begins_and_ends_at_their_ends() {
        let e = Edge::segment([0.0, 0.0], [2.0, 0.0]);
        let f = Edge::segment([3.0, 0.0], [1.0, 0.0]);
        assert_eq!(found(&e, &f), [[1.0, 0.0], [2.0, 0.0]]);
    }
    #[test]
    fn a_place_behind_the_end_of_an_arc_is_nearest_to_the_end() {
        let quarter = Edge::around([0.0, 0.0], 1.0, [1.0, 0.0], [0.0, 1.0]);
        assert!(quarter.part([-1.0, 1.0]) > 1.0 && quarter.part([1.0, -1.0]) < 0.0);
        assert!((quarter.distance([-1.0, 1.0]) - 1.0).abs() < 1e-15);
        assert!((quarter.part([1.0, 1.0]) - 0.5).abs() < 1e-15);
    }
}
