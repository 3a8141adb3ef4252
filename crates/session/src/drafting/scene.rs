//! What can be picked: the figures that the home of a drawing knows, each by what it is called there.

mod through;

use super::compound::{self, Compound};
use super::{Home, text};
use crate::state::State;
use crate::view::Pointer;
use crate::views::drawn;
use base::Name;
use base::number::{atan2, hypot, tan};
use eval::{Answer, Context, Entry, Evaluator, Standing};
use geometry::{Figure, Side, Source};
use kernel::{ClassId, DOCUMENT};
use std::collections::{BTreeMap, BTreeSet};

/// A figure with its name.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// How it is written in the home.
    pub(crate) text: String,
    /// Its class.
    pub(crate) class: ClassId,
    /// Where it lies.
    pub(crate) curve: Curve,
    /// What it is in, from the nearest: a turn of a loop, the loop.
    pub(crate) wholes: Vec<String>,
    /// The class of the figure that it is a side or a place of; nothing for what is a figure of its own.
    pub(crate) side_of: Option<ClassId>,
    /// The edge of it, where it is one of several: of a contour, a surface or a region.
    pub(crate) side: Option<Side>,
    /// Whether it is a place of another figure.
    pub(crate) is_place: bool,
    /// Whether it is part of what is drawn: no guide, not erased, no place of another figure.
    pub(crate) is_result: bool,
}

impl Found {
    /// Whether a pointer is at the end of the edge that it is, or at its beginning; nothing where it is at neither.
    pub(crate) fn corner_at(&self, pointer: &Pointer) -> Option<bool> {
        let side = self.side?;
        let away = |[x, y]: [f64; 2]| hypot(pointer.at.0 - x, pointer.at.1 - y);
        let (begin, end) = (away(side.from), away(side.to));
        (begin.min(end) <= pointer.reach).then_some(end < begin)
    }

    /// How it, or what it is in, is written: at level 0 itself, or the figure that it is a side of where that is
    /// `whole_first`, then from the nearest whole on, and around.
    pub(crate) fn at_level(&self, level: usize, whole_first: bool) -> String {
        match (level + usize::from(whole_first)) % (self.wholes.len() + 1) {
            0 => self.text.clone(),
            n => self.wholes[n - 1].clone(),
        }
    }
}

/// Returns the nearest of figures under a pointer, a point before what runs through it where it is within half of the
/// pointer's reach: a finger reaches far, and would never find a short line between its ends. Beyond an end the line is
/// no nearer than that.
pub(crate) fn nearest<'f>(
    all: impl Iterator<Item = &'f Found>,
    pointer: &Pointer,
) -> Option<&'f Found> {
    let near = all.map(|f| (f.curve.distance(pointer.at), f));
    let near = near.filter(|(far, _)| *far <= pointer.reach);
    let runs = |(_, f): &(f64, &Found)| !f.curve.is_point();
    let is_aside = |one: &(f64, &Found)| runs(one) || one.0 > pointer.reach / 2.0;
    let order = |a: &(f64, &Found), b: &(f64, &Found)| {
        is_aside(a).cmp(&is_aside(b)).then(a.0.total_cmp(&b.0)).then(runs(a).cmp(&runs(b)))
    };
    near.min_by(order).map(|(_, f)| f)
}

/// Returns the nearest of figures that may take the place of one. A centre or an end stands for a place alone, unless
/// nothing else is there.
pub(crate) fn nearest_instead<'f>(
    all: impl Iterator<Item = &'f Found> + Clone,
    of: &str,
    pointer: &Pointer,
) -> Option<&'f Found> {
    let of = of.trim_start_matches('-');
    let is_it =
        |f: &&Found| f.text == of && !f.curve.is_point() || f.wholes.iter().any(|w| w == of);
    let figure = all.clone().any(|f| is_it(&f)).then(|| {
        let figures = all.clone().filter(|f| !f.is_place);
        nearest(figures, pointer)
    });
    figure.flatten().or_else(|| nearest(all, pointer))
}

/// Finds the figures of a home that lie in a rectangle: whole ones, never the ends of a line that goes on outside, and
/// none twice.
pub(crate) fn within(state: &State, home: &Home, (a, b): ((f64, f64), (f64, f64))) -> Vec<Found> {
    let across = a.0.min(b.0)..=a.0.max(b.0);
    let up = a.1.min(b.1)..=a.1.max(b.1);
    let Scene { found: all, carried, .. } = surveyed(state, home);
    let known: BTreeSet<&str> = all.iter().map(|found| found.text.as_str()).collect();
    let is_part =
        |found: &Found| found.text.rsplit_once('.').is_some_and(|(owner, _)| known.contains(owner));
    let is_in = |found: &Found| {
        found.curve.box_of().is_some_and(|[low, high]| {
            [low, high].iter().all(|p| across.contains(&p[0]) && up.contains(&p[1]))
        })
    };
    let mut caught: BTreeSet<&str> = BTreeSet::new();
    // the corners of a rectangle are no figures of their own
    let is_part = |found: &Found| is_part(found) || found.is_place && found.side_of.is_some();
    // a contour is in it where all of its edges are, a spline where all of its chords are
    let cut: BTreeSet<&str> = all.iter().filter(|f| !is_in(f)).map(|f| f.text.as_str()).collect();
    let is_whole = |found: &Found| !cut.contains(found.text.as_str());
    // what a turn begins with was made elsewhere, save where it lies alone
    let carried: BTreeSet<&str> = carried.iter().map(String::as_str).collect();
    let is_carried = |found: &&Found| {
        let name = found.text.as_str();
        let owners = name.match_indices('.').map(|(at, _)| &name[..at]);
        owners.chain([name]).any(|owner| carried.contains(owner))
    };
    let elsewhere: BTreeSet<Vec<u64>> =
        all.iter().filter(|f| !is_carried(f)).map(|f| f.curve.where_it_lies()).collect();
    let is_own =
        |found: &&Found| !is_carried(found) || !elsewhere.contains(&found.curve.where_it_lies());
    let found = all.iter().filter(|found| is_in(found) && !is_part(found) && is_whole(found));
    found.filter(is_own).filter(|found| caught.insert(&found.text)).cloned().collect()
}

/// Names figures: one by one, and sets where all of one are among them. What a loop or a pattern makes more of, by other
/// values, belongs to its set.
pub(crate) fn whole_sets(
    state: &State,
    home: &Home,
    caught: &[Found],
) -> (Vec<String>, Vec<String>) {
    let all = scene(state, home);
    let caught_texts: BTreeSet<&str> = caught.iter().map(|found| found.text.as_str()).collect();
    let mut is_whole: BTreeMap<&str, bool> = BTreeMap::new();
    for found in all.iter().filter(|found| found.is_result) {
        let is_caught = caught_texts.contains(found.text.as_str());
        for set in &found.wholes {
            *is_whole.entry(set).or_insert(true) &= is_caught;
        }
    }
    let (mut single, mut sets) = (Vec::new(), Vec::new());
    let mut known: BTreeSet<&str> = BTreeSet::new();
    for found in caught {
        let set = found.wholes.iter().rev().find(|set| is_whole.get(set.as_str()) == Some(&true));
        match set {
            Some(set) if known.insert(set) => sets.push(set.clone()),
            Some(_) => {}
            None => single.push(found.text.clone()),
        }
    }
    (single, sets)
}

/// The name of a figure, or of what is made of others that it is a side of.
pub(crate) fn whole_of(found: &Found) -> String {
    found.side_of.and(found.wholes.first()).unwrap_or(&found.text).clone()
}

/// Names figures, and what is made of others in the place of its sides, where all of these are among them.
pub(crate) fn wholes_of(state: &State, home: &Home, caught: &[Found]) -> Vec<String> {
    let all = scene(state, home);
    let texts: BTreeSet<&str> = caught.iter().map(|found| found.text.as_str()).collect();
    let whole = |found: &Found| found.side_of.and(found.wholes.first()).cloned();
    let sides = all.iter().filter(|side| !side.is_place);
    let cut: BTreeSet<String> =
        sides.filter(|side| !texts.contains(side.text.as_str())).filter_map(whole).collect();
    let mut names: Vec<String> = Vec::new();
    for found in caught {
        let whole = whole(found).filter(|whole| !cut.contains(whole));
        let name = whole.unwrap_or_else(|| found.text.clone());
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Says how many figures of which kinds are called by some names: `1 Rectangle and 4 Circle`; nothing for one kind.
pub(crate) fn kinds_in_words(state: &State, caught: &[Found], names: &[String]) -> Option<String> {
    let class = |name: &String| {
        let of_whole = |f: &&Found| f.wholes.first() == Some(name);
        let own = caught.iter().find(|found| found.text == *name).map(|found| found.class);
        own.or_else(|| caught.iter().find(of_whole).and_then(|found| found.side_of))
    };
    let mut kinds: Vec<(ClassId, usize)> = Vec::new();
    for class in names.iter().filter_map(class) {
        match kinds.iter_mut().find(|(known, _)| *known == class) {
            Some((_, count)) => *count += 1,
            None => kinds.push((class, 1)),
        }
    }
    let one = |(class, count): &(ClassId, usize)| {
        format!("{count} {}", state.lowered.document.classes[*class].name)
    };
    let mut said: Vec<String> = kinds.iter().map(one).collect();
    let last = said.pop().filter(|_| !said.is_empty())?;
    Some(format!("{} and {last}", said.join(", ")))
}

/// Returns how something that a home knows is drawn; nothing where it is no figure.
pub(crate) fn drawing_of(state: &State, home: &Home, text: &str) -> drawing::Drawing {
    drawing_of_all(state, home, &[text.to_string()])
}

/// Returns how several things that a home knows are drawn.
pub(crate) fn drawing_of_all(state: &State, home: &Home, texts: &[String]) -> drawing::Drawing {
    let evaluator = state.evaluator(&state.values);
    let own = home.path();
    let drawn = |text: &String| {
        let plain = text.trim_start_matches('-').trim_matches(['(', ')']);
        let answer = crate::session::parse_path(plain).and_then(|inner| {
            // a name is of the innermost block that has it
            (0..=own.0.len()).rev().find_map(|n| {
                let outer = kernel::Path(own.0[..n].to_vec());
                evaluator.at(&inner.0.iter().fold(outer, |at, s| at.then(s.clone()))).ok()
            })
        });
        answer.map(|answer| elements_of(&evaluator, &answer)).unwrap_or_default()
    };
    let elements = texts.iter().flat_map(drawn).collect();
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

/// Returns what an answer draws, all of its turns where it is a list of them.
pub(crate) fn elements_of<'a>(
    evaluator: &Evaluator<'a>,
    answer: &Answer<'a>,
) -> Vec<drawing::Element> {
    match answer {
        Answer::List(items) => items.iter().flat_map(|i| elements_of(evaluator, i)).collect(),
        _ => evaluator.elements(answer),
    }
}

/// Where a figure lies.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Curve {
    figure: Figure<f64>,
    /// From where to where an arc runs, to the left; of a chord, what it stands for, where that may be an edge.
    arc: Option<[[f64; 2]; 2]>,
    /// Whether a straight goes on beyond its points.
    is_endless: bool,
    /// Whether it stands for a part of a curve that is neither a line nor an arc.
    is_chord: bool,
}

/// The names of the points that figures have.
const PLACES: [&str; 5] = ["p1", "p2", "center", "start", "end"];

impl Curve {
    fn segment(from: [f64; 2], to: [f64; 2]) -> Self {
        let figure = Figure::Straight { from, to };
        Self { figure, arc: None, is_endless: false, is_chord: false }
    }

    /// Returns where an edge lies.
    fn of_side(side: &Side) -> Self {
        let [from, to] = [side.from, side.to];
        match side.center() {
            Some(center) => Self {
                figure: Figure::Circle {
                    center,
                    radius: hypot(from[0] - center[0], from[1] - center[1]).copysign(side.bulge),
                },
                arc: Some(if side.bulge < 0.0 { [to, from] } else { [from, to] }),
                is_endless: false,
                is_chord: false,
            },
            None => Self::segment(from, to),
        }
    }

    /// Returns where it begins and ends, where it is a segment, an arc or a part of another curve.
    pub(crate) fn ends(&self) -> Option<[[f64; 2]; 2]> {
        match (self.figure, self.arc) {
            (_, ends) if self.is_chord => ends,
            (Figure::Straight { from, to }, _) if !self.is_endless => Some([from, to]),
            (_, ends) => ends,
        }
    }

    /// Returns what edges of others can come from it.
    pub(crate) fn source(&self) -> Option<Source> {
        match (self.figure, self.arc) {
            _ if self.is_chord => None,
            (Figure::Straight { from, to }, _) if self.is_endless => Some(Source::Axis(from, to)),
            (Figure::Straight { from, to }, _) => Some(Source::Line(from, to)),
            (Figure::Circle { center, radius }, None) => Some(Source::Circle(center, radius)),
            (Figure::Circle { center, radius }, Some([a, b])) => {
                let turn = |p: [f64; 2]| atan2(p[1] - center[1], p[0] - center[0]);
                let sweep = (turn(b) - turn(a)).rem_euclid(std::f64::consts::TAU);
                let bulge = tan(sweep / 4.0);
                Some(Source::Arc(match radius < 0.0 {
                    true => Side { from: b, to: a, bulge: -bulge },
                    false => Side { from: a, to: b, bulge },
                }))
            }
            (Figure::Point(_) | Figure::Arc { .. }, _) => None,
        }
    }

    /// Returns where an answer lies; nothing where it is no figure.
    pub(crate) fn of<'a>(evaluator: &Evaluator<'a>, answer: &Answer<'a>) -> Option<Self> {
        let document = evaluator.document;
        let class = evaluator.class_of(answer)?;
        document.figure(class)?;
        let figure = evaluator.figure_of(answer).ok()?;
        let is_of =
            |name: &str| document.class_named(name).is_some_and(|c| document.is_a(class, c));
        let ends = is_of("Arc")
            .then(|| Some([place(evaluator, answer, "start")?, place(evaluator, answer, "end")?]));
        let arc = ends.flatten().map(|[a, b]| if is_of("ClockwiseArc") { [b, a] } else { [a, b] });
        Some(Self { figure, arc, is_endless: !is_of("Line"), is_chord: false })
    }

    /// Its radius, with its sign, where it is a circle or an arc of one.
    pub(crate) fn radius(&self) -> Option<f64> {
        match self.figure {
            Figure::Circle { radius, .. } => Some(radius),
            Figure::Point(_) | Figure::Straight { .. } | Figure::Arc { .. } => None,
        }
    }

    /// Whether it is a point.
    pub(crate) fn is_point(&self) -> bool {
        matches!(self.figure, Figure::Point(_))
    }

    /// The corners of a rectangle that it lies in; nothing for what has no end.
    fn box_of(&self) -> Option<[[f64; 2]; 2]> {
        let around = |points: &[[f64; 2]]| {
            let low = |i: usize| points.iter().map(|p| p[i]).fold(f64::INFINITY, f64::min);
            let high = |i: usize| points.iter().map(|p| p[i]).fold(f64::NEG_INFINITY, f64::max);
            [[low(0), low(1)], [high(0), high(1)]]
        };
        match (self.figure, self.arc) {
            (Figure::Point(p), _) => Some([p, p]),
            (Figure::Straight { from, to }, _) => (!self.is_endless).then(|| around(&[from, to])),
            (Figure::Circle { center, radius }, None) => {
                let r = radius.abs();
                Some([[center[0] - r, center[1] - r], [center[0] + r, center[1] + r]])
            }
            (Figure::Circle { .. }, Some(ends)) => Some(around(&ends)),
            (Figure::Arc { start, end, .. }, _) => Some(around(&[start, end])),
        }
    }

    /// The corners of a rectangle that all of it lies in, and perhaps more: of an arc that of its circle.
    pub(crate) fn room(&self) -> Option<[[f64; 2]; 2]> {
        let Figure::Arc { center, start, .. } = self.figure else {
            return Self { arc: None, ..*self }.box_of();
        };
        let radius = hypot(start[0] - center[0], start[1] - center[1]);
        Self { figure: Figure::Circle { center, radius }, arc: None, ..*self }.box_of()
    }

    /// Where it lies, whichever way it runs: the same for what covers the same.
    fn where_it_lies(&self) -> Vec<u64> {
        let numbers = match (self.figure, self.arc) {
            (Figure::Point(at), _) => at.to_vec(),
            (Figure::Straight { from, to }, _) if from <= to => [from, to].concat(),
            (Figure::Straight { from, to }, _) => [to, from].concat(),
            (Figure::Circle { center: [x, y], radius }, arc) => {
                let ends = arc.into_iter().flatten().flatten();
                [x, y, radius.abs()].into_iter().chain(ends).collect()
            }
            (Figure::Arc { center, start, end }, _) => [center, start, end].concat(),
        };
        // zero has no sign
        numbers.into_iter().map(|x| (x + 0.0).to_bits()).collect()
    }

    /// At which part of it a place lies, as its class counts: of the way from end to end, of a turn to the left.
    pub(crate) fn part_at(&self, (x, y): (f64, f64)) -> Option<f64> {
        use std::f64::consts::TAU;
        let part = match (self.figure, self.arc) {
            (Figure::Straight { from, to }, _) => {
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                ((x - from[0]) * dx + (y - from[1]) * dy) / (dx * dx + dy * dy)
            }
            (Figure::Circle { center, radius }, None) => {
                let up = if radius < 0.0 { center[1] - y } else { y - center[1] };
                atan2(up, x - center[0]) / TAU
            }
            (Figure::Circle { center, radius }, Some([a, b])) => {
                let turn = |p: [f64; 2]| atan2(p[1] - center[1], p[0] - center[0]);
                let sweep = (turn(b) - turn(a)).rem_euclid(TAU);
                let part = (turn([x, y]) - turn(a)).rem_euclid(TAU) / sweep;
                if radius < 0.0 { 1.0 - part } else { part }
            }
            (Figure::Point(_) | Figure::Arc { .. }, _) => return None,
        };
        part.is_finite().then_some(part)
    }

    /// How far a place is from it.
    pub(crate) fn distance(&self, at: (f64, f64)) -> f64 {
        let away = |[x, y]: [f64; 2]| hypot(at.0 - x, at.1 - y);
        match self.figure {
            Figure::Point(p) => away(p),
            Figure::Straight { from, to } => {
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let along = ((at.0 - from[0]) * dx + (at.1 - from[1]) * dy) / (dx * dx + dy * dy);
                let along = match (along.is_finite(), self.is_endless) {
                    (false, _) => 0.0,
                    (true, true) => along,
                    (true, false) => along.clamp(0.0, 1.0),
                };
                match along == 1.0 {
                    true => away(to),
                    false => away([from[0] + along * dx, from[1] + along * dy]),
                }
            }
            Figure::Circle { center, radius } => match self.arc {
                Some([a, b]) if !is_between(center, a, b, at) => away(a).min(away(b)),
                _ => (away(center) - radius.abs()).abs(),
            },
            Figure::Arc { start, end, .. } => away(start).min(away(end)),
        }
    }

    /// Returns from where to where a number of it reaches: a radius from the centre to the rim, a length from end to end.
    pub(crate) fn reach_of_number(&self, slot: &str) -> Option<[(f64, f64); 2]> {
        match self.figure {
            Figure::Circle { center: [x, y], radius } if slot == "radius" => {
                let reach = radius.abs() * std::f64::consts::FRAC_1_SQRT_2;
                Some([(x, y), (x + reach, y + reach)])
            }
            Figure::Straight { from, to } if slot == "length" => {
                Some([(from[0], from[1]), (to[0], to[1])])
            }
            Figure::Point(_)
            | Figure::Straight { .. }
            | Figure::Circle { .. }
            | Figure::Arc { .. } => None,
        }
    }

    /// Returns where a number of it is shown that reaches from nowhere to nowhere.
    pub(crate) fn place_of_number(&self, slot: &str) -> (f64, f64) {
        let half = |a: [f64; 2], b: [f64; 2]| ((a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0);
        match self.figure {
            Figure::Point([x, y]) | Figure::Circle { center: [x, y], .. } => (x, y),
            Figure::Straight { from, .. } if slot == "angle" => (from[0], from[1]),
            Figure::Straight { from, to } => half(from, to),
            Figure::Arc { start, end, .. } => half(start, end),
        }
    }

    /// Returns an arrow that shows which way it runs, near a pointer; nothing for what runs no way.
    pub(crate) fn arrow(&self, near: &Pointer) -> Option<drawing::Element> {
        let (x, y) = near.at;
        let (at, way) = match self.figure {
            Figure::Straight { from, to } => {
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let length = hypot(dx, dy);
                let along = ((x - from[0]) * dx + (y - from[1]) * dy) / (length * length);
                let along = if self.is_endless { along } else { along.clamp(0.0, 1.0) };
                ([from[0] + along * dx, from[1] + along * dy], [dx / length, dy / length])
            }
            Figure::Circle { center, radius } => {
                let (dx, dy) = (x - center[0], y - center[1]);
                let far = hypot(dx, dy);
                let [ux, uy] = if far > 0.0 { [dx / far, dy / far] } else { [1.0, 0.0] };
                let (size, sign) = (radius.abs(), radius.signum());
                ([center[0] + size * ux, center[1] + size * uy], [-uy * sign, ux * sign])
            }
            Figure::Point(_) | Figure::Arc { .. } => return None,
        };
        let size = near.reach;
        let corner = |ahead: f64, left: f64| drawing::Point {
            x: at[0] + size * (ahead * way[0] - left * way[1]),
            y: at[1] + size * (ahead * way[1] + left * way[0]),
        };
        let points = vec![corner(1.0, 0.0), corner(-0.5, 0.5), corner(-0.5, -0.5)];
        let is_sound = size > 0.0 && points.iter().all(|p| p.x.is_finite() && p.y.is_finite());
        is_sound.then(|| drawing::Element {
            shape: drawing::Shape::Polyline { points, closed: true },
            style: drawing::Style {
                fill: Some(drawing::Color::Accent),
                ..drawing::Style::default()
            },
            layer: drawing::Layer::Points,
            tag: drawing::Tag(0),
        })
    }

    /// What it is, in words and numbers.
    pub(crate) fn words(&self) -> String {
        let number = |x: f64| base::number::rounded(x, 4);
        let place = |[x, y]: [f64; 2]| format!("({}, {})", number(x), number(y));
        match self.figure {
            Figure::Point(p) => place(p),
            Figure::Straight { from, to } => format!("{} to {}", place(from), place(to)),
            Figure::Circle { center, radius } => {
                // the sign says which way it runs
                let way = if radius < 0.0 { ", clockwise" } else { "" };
                format!("centre {}, radius {}{way}", place(center), number(radius.abs()))
            }
            Figure::Arc { start, end, .. } => format!("{} to {}", place(start), place(end)),
        }
    }
}

/// Whether a direction from a centre lies between two others, going left from the first.
fn is_between(center: [f64; 2], a: [f64; 2], b: [f64; 2], at: (f64, f64)) -> bool {
    let turn = |x: f64, y: f64| atan2(y - center[1], x - center[0]);
    let from = turn(a[0], a[1]);
    let left = |angle: f64| (angle - from).rem_euclid(std::f64::consts::TAU);
    left(turn(at.0, at.1)) <= left(turn(b[0], b[1]))
}

fn place<'a>(evaluator: &Evaluator<'a>, of: &Answer<'a>, name: &str) -> Option<[f64; 2]> {
    match evaluator.figure_of(&evaluator.of_part(of, name).ok()?).ok()? {
        Figure::Point(at) => Some(at),
        _ => None,
    }
}

/// Returns the figures that can be picked.
pub(crate) fn scene(state: &State, home: &Home) -> Vec<Found> {
    surveyed(state, home).found
}

/// Says of each figure that can be picked, and of each set of them, whether it is part of what is drawn.
pub(crate) fn standings(state: &State, home: &Home) -> BTreeMap<String, bool> {
    let Scene { found, sets, .. } = surveyed(state, home);
    sets.into_iter().chain(found.into_iter().map(|found| (found.text, found.is_result))).collect()
}

fn surveyed<'a>(state: &'a State, home: &Home) -> Scene<'a> {
    let mut all = Scene {
        state,
        evaluator: state.evaluator(&state.values),
        found: Vec::new(),
        sets: Vec::new(),
        carried: Vec::new(),
        is_result: true,
    };
    match home {
        Home::Document => all.document(),
        Home::Program { example, way, .. } => {
            let mut path = kernel::Path::of(&[example]);
            for name in parameters(state, home) {
                if let Ok(given) = all.evaluator.at(&path.then(kernel::Step::Part(name.clone()))) {
                    all.is_result = false;
                    all.add((name, &[]), &given, true);
                }
            }
            all.is_result = true;
            let mut levels = text::visible(&text::Source::now(state), home).into_iter();
            all.level(&path, &levels.next().unwrap_or_default());
            for around in way {
                let Some(name) = &around.name else { continue };
                path = path.then(kernel::Step::Part(name.clone()));
                if let Some(turn) = around.turn {
                    path = path.then(kernel::Step::Index(turn));
                }
                all.level(&path, &levels.next().unwrap_or_default());
            }
        }
    }
    all
}

/// The parameters of the program that a home is in.
pub(crate) fn parameters<'s>(state: &'s State, home: &Home) -> impl Iterator<Item = &'s Name> {
    let document = &state.lowered.document;
    let class = match home {
        Home::Program { program, .. } => document.class_named(program),
        Home::Document => None,
    };
    let program = class.and_then(|class| document.program(class));
    program.into_iter().flat_map(|program| program.parameters.iter().map(|asked| &asked.name))
}

struct Scene<'a> {
    state: &'a State,
    evaluator: Evaluator<'a>,
    found: Vec<Found>,
    /// What turns begin with: whatever it is was made elsewhere.
    carried: Vec<String>,
    /// The sets that were gone through, and whether each is part of what is drawn.
    sets: Vec<(String, bool)>,
    /// Whether what is gone through is part of what is drawn.
    is_result: bool,
}

impl<'a> Scene<'a> {
    fn document(&mut self) {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        for (thing, t) in structure.things.iter() {
            if thing == DOCUMENT || structure.merged[thing] != thing {
                continue;
            }
            let path = structure.path(document, thing).to_string();
            if compound::is_drawn(document, t.class) {
                self.add((&path, &[]), &Answer::Thing(thing), false);
            } else if document.program(t.class).is_some()
                && let Some(run) = drawn::shown(&self.evaluator, thing)
            {
                self.context((&format!("{path}."), std::slice::from_ref(&path)), &run);
            }
        }
        let root = &document.classes[structure.things[DOCUMENT].class];
        for message in &root.messages {
            if message.parameters.is_empty()
                && !message.is_of_class()
                && let Ok(answer) = self.evaluator.ask(DOCUMENT, &message.name)
            {
                self.add((&message.name, &[]), &answer, true);
            }
        }
    }

    /// Adds what a block, or a turn of it, made by the names that are seen of it.
    fn level(&mut self, path: &kernel::Path, names: &[String]) {
        let run = match self.evaluator.at(path) {
            Ok(Answer::Context(turn)) => turn,
            Ok(Answer::Thing(thing)) => match self.evaluator.run(thing) {
                Ok(Some(run)) => run,
                Ok(None) | Err(_) => return,
            },
            Ok(_) | Err(_) => return,
        };
        for entry in &run.made {
            if names.iter().any(|name| **name == *entry.name) {
                self.entry((&entry.name, &[]), entry);
            }
        }
    }

    fn context(&mut self, (prefix, wholes): (&str, &[String]), context: &Context<'a>) {
        for entry in &context.made {
            if !entry.name.is_empty() {
                self.entry((&format!("{prefix}{}", entry.name), wholes), entry);
            }
        }
    }

    /// Adds what a step made, as what that is for.
    fn entry(&mut self, at: (&str, &[String]), entry: &Entry<'a>) {
        let around = self.is_result;
        self.is_result &= entry.standing == Standing::Result;
        if entry.standing == Standing::Carried {
            self.carried.push(at.0.into());
        }
        self.add(at, &entry.answer, true);
        self.is_result = around;
    }

    /// Adds what an answer is, or what is in it, and its places where these are no things of their own.
    fn add(&mut self, (text, wholes): (&str, &[String]), answer: &Answer<'a>, with_places: bool) {
        let within =
            || std::iter::once(text.to_string()).chain(wholes.iter().cloned()).collect::<Vec<_>>();
        if matches!(answer, Answer::Context(_) | Answer::List(_)) {
            self.sets.push((text.into(), self.is_result));
        }
        match answer {
            Answer::Context(inner) => return self.context((&format!("{text}."), &within()), inner),
            Answer::List(items) => {
                let wholes = within();
                for (i, item) in items.iter().enumerate() {
                    self.add((&format!("{text}[{i}]"), &wholes), item, true);
                }
                return;
            }
            _ => {}
        }
        let Some(class) = self.evaluator.class_of(answer) else { return };
        if let Some(parts) = compound::of(&self.state.lowered.document, class) {
            return self.compound((text, wholes), (class, answer), parts);
        }
        let Some(curve) = Curve::of(&self.evaluator, answer) else {
            self.sets.push((text.into(), self.is_result));
            self.through_places((text, wholes), (class, answer));
            return self.outline((text, wholes), (class, answer));
        };
        let (wholes, is_result, is_place) = (wholes.to_vec(), self.is_result, false);
        self.found.push(Found {
            text: text.into(),
            class,
            curve,
            wholes,
            side_of: None,
            side: None,
            is_place,
            is_result,
        });
        if !with_places || matches!(curve.figure, Figure::Point(_)) {
            return;
        }
        for name in PLACES {
            if let Ok(part) = self.evaluator.of_part(answer, name)
                && let (Some(class), Some(curve)) =
                    (self.evaluator.class_of(&part), Curve::of(&self.evaluator, &part))
            {
                self.place(format!("{text}.{name}"), (class, curve));
            }
        }
    }

    /// Adds a place of another figure.
    fn place(&mut self, text: String, (class, curve): (ClassId, Curve)) {
        let (wholes, side_of, side) = (Vec::new(), None, None);
        let (is_place, is_result) = (true, false);
        self.found.push(Found { text, class, curve, wholes, side_of, side, is_place, is_result });
    }

    /// Adds the sides and the places of a figure that is made of others.
    fn compound(
        &mut self,
        (text, wholes): (&str, &[String]),
        (class, of): (ClassId, &Answer<'a>),
        parts: &Compound,
    ) {
        self.sets.push((text.into(), self.is_result));
        let around: Vec<String> =
            std::iter::once(text.to_string()).chain(wholes.iter().cloned()).collect();
        let since = self.found.len();
        for name in parts.sides {
            let (side, said) = (self.evaluator.of_part(of, name), format!("{text}.{name}"));
            match side {
                Ok(Answer::List(all)) => all.iter().enumerate().for_each(|(i, side)| {
                    self.add((&format!("{said}[{i}]"), &around), side, true);
                }),
                Ok(side) => self.add((&said, &around), &side, parts.places.is_empty()),
                Err(_) => {}
            }
        }
        for name in parts.places {
            if let Ok(part) = self.evaluator.of_part(of, name)
                && let (Some(point), Some(curve)) =
                    (self.evaluator.class_of(&part), Curve::of(&self.evaluator, &part))
            {
                if parts.sides.is_empty() {
                    // nothing else says where it lies
                    let (wholes, is_result) = (wholes.to_vec(), self.is_result);
                    let (side_of, side, is_place) = (None, None, false);
                    let text = text.into();
                    self.found.push(Found {
                        text,
                        class,
                        curve,
                        wholes,
                        side_of,
                        side,
                        is_place,
                        is_result,
                    });
                }
                self.place(format!("{text}.{name}"), (point, curve));
            }
        }
        let own = self.found[since..].iter_mut().filter(|found| found.text != text);
        for found in own {
            found.side_of = Some(class);
            if found.is_place {
                found.wholes.clone_from(&around);
            }
        }
    }

    /// Adds the edges of what covers a part of the plane, each as the whole.
    fn outline(&mut self, (text, wholes): (&str, &[String]), of: (ClassId, &Answer<'a>)) {
        let document = &self.state.lowered.document;
        let (class, answer) = of;
        let planar = document.class_named("Planar");
        if !planar.is_some_and(|planar| document.is_a(class, planar)) {
            return;
        }
        let Ok(sides) = self.evaluator.outline_of(answer) else {
            return self.drawn_outline((text, wholes), of);
        };
        for side in sides {
            self.found.push(Found {
                text: text.into(),
                class,
                curve: Curve::of_side(&side),
                wholes: wholes.to_vec(),
                side_of: None,
                side: Some(side),
                is_place: false,
                is_result: self.is_result,
            });
        }
    }
}
