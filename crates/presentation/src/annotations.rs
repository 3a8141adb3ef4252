//! Annotations in the picture: dimension lines, and signs beside what constraints speak of.
//!
//! In: what the session says stands on the drawing, the picture, and where the sheet lies on the screen. Out: notes in
//! pixels, each with its words, its lines and its box, which are painted and picked. A hand may have moved some from
//! where they stand by themselves.

mod drawn;

pub use drawn::{draw, draw_for_dxf, elements, scaled};

use crate::paint::{DisplayList, Mark, note};
use crate::sheet::View;
use base::number::{atan2, cos, hypot, sin};
use drawing::{Point, Shape, metrics};
use session::view::{Annotation, PictureView, Shows};
use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_4, PI, TAU};

/// A place on the screen, or a way there.
type Pixels = (f64, f64);

/// How high the words are, in pixels.
pub const HEIGHT: f64 = 12.0;
/// The room around words, in pixels.
const ROOM: f64 = 4.0;
/// How far a dimension line is from what it measures, and from the next one.
const ASIDE: f64 = 26.0;
/// How far a sign is from its thing.
const BESIDE: f64 = 14.0;
/// The radius of an angle's arc, and the least that a hand leaves it.
const ARC: f64 = 26.0;
const LEAST_ARC: f64 = 10.0;
/// Words give way to so many grips at most, and so often.
const MOST_GRIPS: usize = 500;
const TURNS: u32 = 6;
/// How far words give way to a grip at once.
const STEP: f64 = 14.0;

/// What is painted of an annotation at one place.
#[derive(Clone, PartialEq, Debug)]
pub struct Note {
    /// The constraint's path.
    pub path: String,
    /// What it says.
    pub words: String,
    /// Whether the constraint holds.
    pub holds: bool,
    /// The middle of its words, in pixels.
    pub at: Pixels,
    /// Lines, each by its corners, in pixels.
    pub lines: Vec<Vec<Pixels>>,
    /// What it is known by when a hand moves it: what it shows, and of what.
    pub key: String,
    /// The first axis along which it is moved; the second is a quarter turn further.
    axis: Pixels,
}

/// How far hands have moved notes, by their keys: along their axes, in pixels.
pub type Moved = BTreeMap<String, Pixels>;

impl Note {
    /// Whether a place on the screen is on its words.
    fn is_at(&self, (x, y): Pixels) -> bool {
        let (wide, high) = half(&self.words);
        (x - self.at.0).abs() <= wide && (y - self.at.1).abs() <= high
    }
}

impl Note {
    /// A way on the screen along its axes.
    fn along_axes(&self, (x, y): Pixels) -> Pixels {
        let (ax, ay) = self.axis;
        (x * ax + y * ay, y * ax - x * ay)
    }
}

/// Half the size of the box of some words, in pixels.
fn half(words: &str) -> Pixels {
    (metrics::text_width(words, HEIGHT) / 2.0 + ROOM, HEIGHT / 2.0 + ROOM)
}

/// Returns the note whose words are at a place on the screen.
pub fn at(notes: &[Note], place: Pixels) -> Option<&Note> {
    notes.iter().rev().find(|note| note.is_at(place))
}

/// Moves a note on, as far as a hand went on the screen.
pub fn shift(notes: &[Note], key: &str, way: Pixels, moved: &mut Moved) {
    let Some(note) = notes.iter().find(|note| note.key == key) else { return };
    let (x, y) = note.along_axes(way);
    let far = moved.entry(String::from(key)).or_default();
    *far = (far.0 + x, far.1 + y);
}

/// What the picture shows of a thing, in pixels.
#[derive(Clone, Copy, Debug)]
enum Seen {
    Place(Pixels),
    Way(Pixels, Pixels),
    /// A centre, a radius, the direction of the middle of an arc, and that in which signs stand.
    Round(Pixels, f64, [f64; 2]),
}

impl Seen {
    fn middle(self) -> Pixels {
        match self {
            Self::Place(at) | Self::Round(at, ..) => at,
            Self::Way(a, b) => between(a, b),
        }
    }
}

fn between(a: Pixels, b: Pixels) -> Pixels {
    (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1))
}

fn along(from: Pixels, way: Pixels, far: f64) -> Pixels {
    (from.0 + far * way.0, from.1 + far * way.1)
}

/// The direction of a way; to the right where it is none.
fn direction(from: Pixels, to: Pixels) -> Pixels {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let far = hypot(dx, dy);
    if far > 0.0 { (dx / far, dy / far) } else { (1.0, 0.0) }
}

/// Returns where annotations stand. What the picture does not show has none.
pub fn notes(all: &[Annotation], picture: &PictureView, view: &View, moved: &Moved) -> Vec<Note> {
    let (seen, edges) = (seen(all, picture, view), edges(all, picture, view));
    let sides = edges.values().flatten().map(|(a, b)| between(*a, *b));
    let places: Vec<Pixels> = seen.values().map(|seen| seen.middle()).chain(sides).collect();
    let middle = middle_of(&places);
    let grips = picture.grips.iter().take(MOST_GRIPS);
    let grips = grips.map(|grip| view.screen_from_sheet(Point { x: grip.x, y: grip.y }));
    let grips: Vec<Pixels> = grips.collect();
    let mut desk = Desk { middle, scale: view.scale, taken: BTreeMap::new(), grips, moved };
    let place = |one: &Annotation| {
        // the dimension of a side stands outside of what it is a side of
        let own = one.of.first().and_then(|path| edges.get(path.as_str()));
        let sides = |own: &Vec<(Pixels, Pixels)>| -> Vec<Pixels> {
            own.iter().map(|(a, b)| between(*a, *b)).collect()
        };
        desk.middle = own.map_or(middle, |own| middle_of(&sides(own)));
        desk.place(one, &seen, &edges)
    };
    all.iter().flat_map(place).collect()
}

/// The middle of some places.
fn middle_of(places: &[Pixels]) -> Pixels {
    let n = places.len().max(1) as f64;
    places.iter().fold((0.0, 0.0), |sum, at| (sum.0 + at.0 / n, sum.1 + at.1 / n))
}

/// What the picture shows of everything that annotations are of.
fn seen<'a>(all: &'a [Annotation], picture: &PictureView, view: &View) -> BTreeMap<&'a str, Seen> {
    let screen = |p: Point| view.screen_from_sheet(p);
    let mut wanted: BTreeMap<&str, Option<Seen>> =
        all.iter().flat_map(|one| &one.of).map(|path| (path.as_str(), None)).collect();
    for grip in &picture.grips {
        if let Some(found) = wanted.get_mut(grip.path.as_str()) {
            *found = Some(Seen::Place(screen(Point { x: grip.x, y: grip.y })));
        }
    }
    for element in &picture.drawing.elements {
        let path = picture.paths.get(element.tag.0 as usize).map(String::as_str);
        let Some(found @ None) = path.and_then(|path| wanted.get_mut(path)) else { continue };
        *found = match &element.shape {
            Shape::Dot(p) => Some(Seen::Place(screen(*p))),
            Shape::Segment(a, b) => Some(Seen::Way(screen(*a), screen(*b))),
            Shape::Circle { center, radius } => {
                let turns = [-FRAC_PI_4, PI - FRAC_PI_4];
                Some(Seen::Round(screen(*center), radius * view.scale, turns))
            }
            Shape::Arc { center, radius, start, sweep } => {
                let turn = start + sweep / 2.0;
                let on = Point { x: center.x + cos(turn), y: center.y + sin(turn) };
                let (from, to) = (screen(*center), screen(on));
                let turn = atan2(to.1 - from.1, to.0 - from.0);
                // opposite of its middle there is nothing of it
                Some(Seen::Round(from, radius * view.scale, [turn, turn]))
            }
            // what is said of it stands at its first edge
            Shape::Polyline { points, .. } => match points.as_slice() {
                [a, b, ..] => Some(Seen::Way(screen(*a), screen(*b))),
                _ => None,
            },
            Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_)
            | Shape::Region(_)
            | Shape::Text { .. } => None,
        };
    }
    wanted.into_iter().filter_map(|(path, seen)| Some((path, seen?))).collect()
}

/// Straight edges, by the path of what they are of.
type Edges<'a> = BTreeMap<&'a str, Vec<(Pixels, Pixels)>>;

/// The edges of what has several: a line with corners, and a whole that draws its sides, as a rectangle.
fn edges<'a>(all: &'a [Annotation], picture: &PictureView, view: &View) -> Edges<'a> {
    let of_one = all.iter().filter(|one| one.shows == Shows::Length);
    let of_one = of_one.filter_map(|one| match one.of.as_slice() {
        [path] => Some((path.as_str(), Vec::new())),
        _ => None,
    });
    let mut wanted: Edges<'a> = of_one.collect();
    for element in &picture.drawing.elements {
        let tag = element.tag.0 as usize;
        let whole = picture.drawn_by.get(tag).and_then(Option::as_ref);
        let (path, mut corners) = match &element.shape {
            Shape::Segment(a, b) => (whole, vec![*a, *b]),
            Shape::Polyline { points, .. } => (whole.or(picture.paths.get(tag)), points.clone()),
            _ => continue,
        };
        let Some(found) = path.and_then(|path| wanted.get_mut(path.as_str())) else { continue };
        if let Shape::Polyline { closed: true, .. } = element.shape {
            corners.extend(corners.first().copied());
        }
        let corners: Vec<Pixels> = corners.iter().map(|p| view.screen_from_sheet(*p)).collect();
        found.extend(corners.windows(2).map(|two| (two[0], two[1])));
    }
    wanted.retain(|_, edges| !edges.is_empty());
    wanted
}

/// Where notes are put one after the other.
struct Desk<'m> {
    /// The middle of all that they are of, or of what a side belongs to: dimensions stand away from it.
    middle: Pixels,
    /// How many pixels a unit of the sheet has.
    scale: f64,
    /// How many notes stand at a place already, by the place to the pixel.
    taken: BTreeMap<Spot, u32>,
    /// What the words of a dimension leave in sight.
    grips: Vec<Pixels>,
    moved: &'m Moved,
}

/// Where a note stands: the middle of its words, its lines, and its first axis.
type Stand = (Pixels, Vec<Vec<Pixels>>, Pixels);

/// The first axis of what is moved as the screen runs.
const LEVEL: Pixels = (1.0, 0.0);

/// A place to the pixel, and whether a dimension stands there.
type Spot = (i64, i64, bool);

fn spot(at: Pixels, is_dimension: bool) -> Spot {
    (at.0.round() as i64, at.1.round() as i64, is_dimension)
}

impl Desk<'_> {
    /// How far a hand has moved a note.
    fn moved(&self, key: &str) -> Pixels {
        self.moved.get(key).copied().unwrap_or_default()
    }

    /// The first of some stands whose words lie on no grip; where a hand has put them, they stand.
    fn clear(&self, (key, words): (&str, &str), stand: impl Fn(f64) -> Stand) -> Stand {
        let (wide, high) = half(words);
        let is_clear = |(at, ..): &Stand| {
            let is_under = |(x, y): &Pixels| (x - at.0).abs() <= wide && (y - at.1).abs() <= high;
            !self.grips.iter().any(is_under)
        };
        let first = stand(0.0);
        if self.moved.contains_key(key) || is_clear(&first) {
            return first;
        }
        let others = (1..=TURNS).map(|n| stand(STEP * f64::from(n)));
        others.into_iter().find(is_clear).unwrap_or(first)
    }

    /// How many notes of a kind stand at a place already; now one more does.
    fn nth(&mut self, at: Pixels, is_dimension: bool) -> f64 {
        let key = spot(at, is_dimension);
        let n = self.taken.entry(key).or_default();
        *n += 1;
        f64::from(*n - 1)
    }

    /// The direction across a way, away from the middle of all.
    fn outwards(&self, a: Pixels, b: Pixels) -> Pixels {
        let (dx, dy) = direction(a, b);
        let middle = between(a, b);
        let across = (dy, -dx);
        let away = (middle.0 - self.middle.0) * across.0 + (middle.1 - self.middle.1) * across.1;
        // a lone line has its dimension above
        let is_outwards = if away.abs() > 1.0 { away > 0.0 } else { across.1 < 0.0 };
        if is_outwards { across } else { (-dy, dx) }
    }

    /// The edge that is as long as a dimension says, of several the one with the fewest dimensions yet.
    fn edge(&self, edges: &[(Pixels, Pixels)], long: f64) -> Option<(Pixels, Pixels)> {
        let is_so = |(a, b): &(Pixels, Pixels)| {
            (hypot(b.0 - a.0, b.1 - a.1) - long).abs() <= 1e-6 * long.max(1.0)
        };
        let taken = |(a, b): &(Pixels, Pixels)| self.taken.get(&spot(between(*a, *b), true));
        edges.iter().copied().filter(is_so).min_by_key(taken)
    }

    fn place(
        &mut self,
        one: &Annotation,
        seen: &BTreeMap<&str, Seen>,
        edges: &Edges<'_>,
    ) -> Vec<Note> {
        let measure = one.measure.as_ref().unwrap_or(&one.words);
        let key = |n: usize| format!("{measure} {:?} {} {n}", one.shows, one.of.join(" "));
        let note = |n: usize, (at, lines, axis): Stand| Note {
            path: one.path.clone(),
            words: one.words.clone(),
            holds: one.holds,
            at,
            lines,
            key: key(n),
            axis,
        };
        let (shows, of) = match (one.shows, one.of.as_slice(), one.number) {
            (Shows::Length, [path], Some(number)) if edges.contains_key(path.as_str()) => {
                let edges = &edges[path.as_str()];
                match self.edge(edges, number.abs() * self.scale) {
                    Some((a, b)) => (Shows::Length, vec![Seen::Way(a, b)]),
                    // what no edge is as long as is said of the whole
                    None => (Shows::Relation, vec![Seen::Way(edges[0].0, edges[0].1)]),
                }
            }
            (shows, paths, _) => {
                (shows, paths.iter().filter_map(|path| seen.get(path.as_str()).copied()).collect())
            }
        };
        if of.len() < one.of.len() {
            return Vec::new();
        }
        let said = (&*key(0), &*one.words);
        match (shows, of.as_slice()) {
            (Shows::Length, [Seen::Way(a, b)])
            | (Shows::Length, [Seen::Place(a), Seen::Place(b)]) => {
                vec![note(0, self.length((*a, *b), said))]
            }
            (
                Shows::Length,
                [Seen::Place(a), Seen::Way(b, c)] | [Seen::Way(b, c), Seen::Place(a)],
            ) => {
                let (dx, dy) = direction(*b, *c);
                let far = (a.0 - b.0) * dx + (a.1 - b.1) * dy;
                vec![note(0, self.length((*a, along(*b, (dx, dy), far)), said))]
            }
            (Shows::Radius, [Seen::Round(center, radius, [turn, _])]) => {
                vec![note(0, self.radius((*center, *radius, *turn), said))]
            }
            (Shows::Angle([is_turned, is_other_turned]), [Seen::Way(a, b), Seen::Way(c, d)]) => {
                let side = |a, b, is_turned| if is_turned { (b, a) } else { (a, b) };
                let sides = (side(*a, *b, is_turned), side(*c, *d, is_other_turned));
                let off = self.moved(said.0);
                vec![note(0, self.clear(said, |further| angle(sides, off, further)))]
            }
            // level or upright: once, between the two
            (_, [Seen::Place(a), Seen::Place(b)]) => {
                let (at, off) = (self.beside(*a, *b), self.moved(said.0));
                vec![note(0, ((at.0 + off.0, at.1 + off.1), Vec::new(), LEVEL))]
            }
            (_, of) => {
                // of a place on a line or a circle it is said at the place alone
                let is_said = |seen: &Seen| match of {
                    [Seen::Place(_), _] | [_, Seen::Place(_)] => matches!(seen, Seen::Place(_)),
                    _ => true,
                };
                let sign = |(n, seen): (usize, &Seen)| {
                    let (at, off) = (self.sign(*seen), self.moved(&key(n)));
                    note(n, ((at.0 + off.0, at.1 + off.1), Vec::new(), LEVEL))
                };
                of.iter().enumerate().filter(|(_, seen)| is_said(seen)).map(sign).collect()
            }
        }
    }

    /// A radius or a diameter: a leader from the edge to its words.
    fn radius(&mut self, (center, radius, turn): (Pixels, f64, f64), said: (&str, &str)) -> Stand {
        let turn = turn + 0.5 * self.nth(center, true);
        let (half, _) = half(said.1);
        let off = self.moved(said.0);
        self.clear(said, |further| {
            let side = |x: f64| if x < center.0 { -1.0 } else { 1.0 };
            let end = along(center, (cos(turn), sin(turn)), radius + ASIDE + further);
            let at = (end.0 + side(end.0) * half + off.0, end.1 + off.1);
            // the leader comes to the side of the words that looks at the circle
            let end = (at.0 - side(at.0) * half, at.1);
            let edge = along(center, direction(center, end), radius);
            (at, vec![vec![edge, end], head(edge, end)], LEVEL)
        })
    }

    /// A dimension between two places; it is moved across and along the way.
    fn length(&mut self, (a, b): (Pixels, Pixels), said: (&str, &str)) -> Stand {
        /// What is left of the line on each side of the words, at least, in pixels.
        const LEFT: f64 = 10.0;
        let out = self.outwards(a, b);
        // a quarter turn from outwards, as notes are moved
        let on = (-out.1, out.0);
        let (aside, slide) = self.moved(said.0);
        let far = ASIDE * (1.0 + self.nth(between(a, b), true)) + aside;
        let (wide, high) = half(said.1);
        self.clear(said, |further| {
            let far = far + further;
            let (p, q) = (along(a, out, far), along(b, out, far));
            let middle = along(between(p, q), on, slide);
            let ends = if far < 0.0 { -4.0 } else { 4.0 };
            let leader = |from| vec![along(from, out, ends), along(from, out, far + ends)];
            let long = hypot(q.0 - p.0, q.1 - p.1);
            let mut lines = vec![leader(a), leader(b), vec![p, q], head(p, q), head(q, p)];
            // what does not fit into the line stands beyond it, or at its end
            let taken = (wide / on.0.abs()).min(high / on.1.abs());
            let is_past = slide.abs() > 0.5 * long;
            if is_past {
                let way = (q.0 - p.0) * on.0 + (q.1 - p.1) * on.1;
                lines.push(vec![if (way > 0.0) == (slide > 0.0) { q } else { p }, middle]);
            }
            let fits = is_past || long >= 2.0 * (taken + LEFT + slide.abs());
            let past = wide * out.0.abs() + high * out.1.abs() + ROOM;
            let beyond = if fits { 0.0 } else { past.copysign(far) };
            (along(middle, out, beyond), lines, out)
        })
    }

    /// A place beside the middle of a way, on its inner side.
    fn beside(&mut self, a: Pixels, b: Pixels) -> Pixels {
        let middle = between(a, b);
        let (dx, dy) = self.outwards(a, b);
        let n = self.nth(middle, false);
        // further ones go along the way, to both sides by turns
        let step = 22.0 * (n / 2.0).ceil() * if n % 2.0 == 0.0 { 1.0 } else { -1.0 };
        along(along(middle, (-dx, -dy), BESIDE), direction(a, b), step)
    }

    /// A place for a sign beside a thing.
    fn sign(&mut self, seen: Seen) -> Pixels {
        match seen {
            Seen::Way(a, b) => self.beside(a, b),
            Seen::Place(at) => {
                let n = self.nth(at, false);
                (at.0 + BESIDE + 22.0 * n, at.1 - BESIDE)
            }
            Seen::Round(center, radius, [_, turn]) => {
                let n = self.nth(center, false);
                let turn = turn + 22.0 * n / radius.max(22.0);
                along(center, (cos(turn), sin(turn)), radius - BESIDE)
            }
        }
    }
}

/// An arrow head at the first of two places, by its corners.
fn head(tip: Pixels, from: Pixels) -> Vec<Pixels> {
    let (dx, dy) = direction(tip, from);
    let back = along(tip, (dx, dy), 8.0);
    vec![along(back, (dy, -dx), 3.0), tip, along(back, (-dy, dx), 3.0)]
}

/// The words and the arc of an angle between two lines, moved by a hand or further from the corner.
fn angle(
    ((a, b), (c, d)): ((Pixels, Pixels), (Pixels, Pixels)),
    off: Pixels,
    further: f64,
) -> Stand {
    let ((ux, uy), (vx, vy)) = (direction(a, b), direction(c, d));
    let cross = ux * vy - uy * vx;
    if cross.abs() < 1e-9 {
        let at = between(between(a, b), between(c, d));
        return ((at.0 + off.0, at.1 + off.1), Vec::new(), LEVEL);
    }
    let far = ((c.0 - a.0) * vy - (c.1 - a.1) * vx) / cross;
    let corner = along(a, (ux, uy), far);
    // from where the first line goes on to where the other goes
    let (from, to) = (atan2(uy, ux), atan2(vy, vx));
    let mut sweep = to - from;
    if sweep > PI {
        sweep -= TAU;
    } else if sweep < -PI {
        sweep += TAU;
    }
    /// An arc has so many corners.
    const PARTS: u32 = 16;
    /// The words are so many times as far from the corner as the arc.
    const WORDS: f64 = 1.9;
    let on = |turn: f64, radius: f64| along(corner, (cos(turn), sin(turn)), radius);
    let middle = on(from + sweep / 2.0, WORDS * ARC + further);
    let at = (middle.0 + off.0, middle.1 + off.1);
    let arc = (hypot(at.0 - corner.0, at.1 - corner.1) / WORDS).max(LEAST_ARC);
    let part = |n: u32| on(from + sweep * f64::from(n) / f64::from(PARTS), arc);
    // where a line does not reach the arc it is continued
    let leader = |(p, q): (Pixels, Pixels), turn: f64| {
        let end = on(turn, arc + 6.0);
        let past = |r: Pixels| (r.0 - corner.0) * cos(turn) + (r.1 - corner.1) * sin(turn);
        let reaches = past(p).max(past(q)) >= arc && past(p).min(past(q)) <= arc;
        (!reaches).then(|| vec![corner, end])
    };
    let mut lines = vec![(0..=PARTS).map(part).collect()];
    lines.extend(leader((a, b), from).into_iter().chain(leader((c, d), to)));
    (at, lines, LEVEL)
}

/// Adds notes to what is painted, marked where their constraints are.
pub fn paint(list: &mut DisplayList, notes: &[Note], view: &View, mark: impl Fn(&str) -> Mark) {
    for one in notes {
        let sheet = |at: &Pixels| view.sheet_from_screen(*at);
        let lines: Vec<Vec<Point>> =
            one.lines.iter().map(|line| line.iter().map(sheet).collect()).collect();
        let (wide, high) = half(&one.words);
        let corner = |x: f64, y: f64| sheet(&(one.at.0 + x * wide, one.at.1 + y * high));
        let frame = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
        note(list, (&lines, &frame), (sheet(&one.at), &one.words), (mark(&one.path), one.holds));
    }
}

/// How short a dimension is, in pixels, that its number would cover with what it is of.
const SHORT: f64 = 64.0;

/// Where the number of a short dimension stands on the screen: beyond its end; nothing for longer ones.
#[must_use]
pub fn beyond([from, to]: [Pixels; 2]) -> Option<Pixels> {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let length = hypot(x, y);
    // as far as half of its number is wide, or high
    let aside = |along: f64, half: f64| along / length * (half + 8.0);
    (length > 0.0 && length < SHORT).then(|| (to.0 + aside(x, 36.0), to.1 + aside(y, 11.0)))
}

#[cfg(test)]
mod tests {
    use super::{Moved, Note, at, beyond, notes, shift};
    use crate::sheet::View;
    use base::number::hypot;
    use drawing::{Drawing, Element, Layer, Point, Shape, Style, Tag};
    use session::view::{Annotation, Grip, PictureView, Shows};

    /// A line of 100 from the origin to the right, and one of 60 from its end upwards.
    fn corner() -> PictureView {
        let point = |x, y| Point { x, y };
        let line = |tag, a, b| Element {
            shape: Shape::Segment(a, b),
            style: Style::default(),
            layer: Layer::Lines,
            tag: Tag(tag),
        };
        let elements = vec![
            line(0, point(0.0, 0.0), point(100.0, 0.0)),
            line(1, point(100.0, 0.0), point(100.0, 60.0)),
        ];
        PictureView {
            drawing: Drawing { elements, ..Drawing::default() },
            paths: vec!["a".into(), "b".into()],
            drawn_by: vec![None; 2],
            ..PictureView::default()
        }
    }

    fn annotation(path: &str, shows: Shows, words: &str, of: &[&str]) -> Annotation {
        Annotation {
            path: path.into(),
            says: String::new(),
            words: words.into(),
            shows,
            of: of.iter().map(|path| String::from(*path)).collect(),
            holds: true,
            measure: None,
            number: words.split(' ').next().and_then(|number| number.parse().ok()),
            typed: None,
        }
    }

    fn made(all: &[Annotation]) -> Vec<Note> {
        // a sheet whose origin is at (200, 300), y up, two pixels a unit
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        notes(all, &corner(), &view, &Moved::new())
    }

    #[test]
    fn dimensions_stand_outside_and_further_ones_further_away() {
        let length = |path| annotation(path, Shows::Length, "100 mm", &["a"]);
        let upright = annotation("c3", Shows::Length, "60 mm", &["b"]);
        let all = made(&[length("c1"), length("c2"), upright]);
        let places: Vec<(f64, f64)> = all.iter().map(|note| note.at).collect();
        // below the line that runs along the bottom, to the right of the upright one
        assert_eq!(places, [(300.0, 326.0), (300.0, 352.0), (426.0, 240.0)]);
        assert_eq!(at(&all, (303.0, 350.0)).map(|note| &*note.path), Some("c2"));
        assert_eq!(at(&all, (300.0, 300.0)), None);
    }

    #[test]
    fn words_that_do_not_fit_stand_beyond_their_line() {
        let words = "1 234 567.891 234 567 mm and more than there is room for";
        let all = made(&[annotation("c1", Shows::Length, words, &["a"])]);
        let [note] = all.as_slice() else { panic!("one note: {all:?}") };
        // what stands alone has it above
        assert_eq!(note.at, (300.0, 260.0));
    }

    #[test]
    fn a_relation_has_a_sign_beside_each_thing_and_an_angle_one_arc() {
        let all = made(&[
            annotation("c1", Shows::Relation, "=", &["a", "b"]),
            annotation("c2", Shows::Angle([false; 2]), "90 deg", &["a", "b"]),
        ]);
        let [first, second, angle] = all.as_slice() else { panic!("three notes: {all:?}") };
        assert_eq!((first.at, second.at), ((300.0, 286.0), (386.0, 240.0)));
        // from the corner at (400, 300), halfway between where the first goes on and up
        let far = 1.9 * 26.0 * std::f64::consts::FRAC_1_SQRT_2;
        let off = (angle.at.0 - (400.0 + far), angle.at.1 - (300.0 - far));
        assert!(off.0.abs() < 1e-9 && off.1.abs() < 1e-9, "{angle:?}");
        // the arc, and the first line continued
        assert_eq!(angle.lines.len(), 2);
    }

    #[test]
    fn the_sign_of_an_arc_stands_beside_the_arc_rather_than_where_there_is_none() {
        let mut picture = corner();
        let center = Point { x: 0.0, y: 0.0 };
        let (start, sweep) = (std::f64::consts::FRAC_PI_2, std::f64::consts::PI);
        picture.drawing.elements[0].shape = Shape::Arc { center, radius: 20.0, start, sweep };
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let tangent = annotation("c1", Shows::Relation, "T", &["a"]);
        let all = notes(&[tangent], &picture, &view, &Moved::new());
        let [note] = all.as_slice() else { panic!("one note: {all:?}") };
        // the arc runs through (160, 300) on the screen
        assert!(hypot(note.at.0 - 160.0, note.at.1 - 300.0) < 20.0, "{note:?}");
    }

    #[test]
    fn of_a_place_on_a_line_the_sign_stands_at_the_place_alone() {
        let mut picture = corner();
        picture.grips.push(Grip { path: "p".into(), x: 50.0, y: 0.0, ..Grip::default() });
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        for of in [["a", "p"], ["p", "a"]] {
            let all = [annotation("c1", Shows::Relation, "on", &of)];
            let all = notes(&all, &picture, &view, &Moved::new());
            let [note] = all.as_slice() else { panic!("one note: {all:?}") };
            // (50, 0) is at pixel (300, 300)
            assert!((note.at.0 - 300.0).abs() < 30.0 && (note.at.1 - 300.0).abs() < 30.0);
        }
    }

    #[test]
    fn a_box_has_its_width_along_and_its_height_beside_it() {
        let mut picture = corner();
        picture.paths = vec!["box.side1".into(), "box.side2".into()];
        picture.drawn_by = vec![Some("box".into()); 2];
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let of = ["60 mm", "100 mm", "320 mm"];
        let all = of.map(|words| annotation(words, Shows::Length, words, &["box"]));
        let all = notes(&all, &picture, &view, &Moved::new());
        let [height, width, around] = all.as_slice() else { panic!("three notes: {all:?}") };
        // outside of the middles of the lower side and of the right one, at (300, 300) and (400, 240)
        assert_eq!((width.at, height.at), ((300.0, 326.0), (426.0, 240.0)));
        // what is as long as no side has no arrows
        assert_eq!((width.lines.len(), height.lines.len(), around.lines.len()), (5, 5, 0));
    }

    #[test]
    fn a_note_stands_where_a_hand_has_put_it() {
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let all = [
            annotation("c1", Shows::Length, "100 mm", &["a"]),
            annotation("c2", Shows::Length, "60 mm", &["b"]),
            annotation("c3", Shows::Angle([true, false]), "90 deg", &["a", "b"]),
        ];
        let mut moved = Moved::new();
        let first = notes(&all, &corner(), &view, &moved);
        for (note, way) in first.iter().zip([(20.0, 30.0), (-66.0, 0.0), (-10.0, -10.0)]) {
            shift(&first, &note.key, way, &mut moved);
        }
        let now = notes(&all, &corner(), &view, &moved);
        for (one, (was, way)) in
            now.iter().zip(first.iter().zip([(20.0, 30.0), (-66.0, 0.0), (-10.0, -10.0)]))
        {
            let off = (one.at.0 - was.at.0 - way.0, one.at.1 - was.at.1 - way.1);
            assert!(off.0.abs() < 1e-9 && off.1.abs() < 1e-9, "{one:?}");
        }
        // the line of the first lies 56 below what it measures, the second's on the other side of its own
        assert_eq!(now[0].lines[2], [(200.0, 356.0), (400.0, 356.0)]);
        assert_eq!(now[1].lines[2], [(360.0, 300.0), (360.0, 180.0)]);
        // the arc is between the side that runs back and the one that runs up, and larger
        let ends = [now[2].lines[0][0], *now[2].lines[0].last().expect("an arc")];
        assert!(ends[0].0 < 400.0 - 26.0 && ends[1].1 < 300.0 - 26.0, "{ends:?}");
        // in another view as many pixels away
        let nearer = View { scale: 4.0, ..view };
        let nearer = notes(&all, &corner(), &nearer, &moved);
        assert_eq!(nearer[0].lines[2], [(200.0, 356.0), (600.0, 356.0)]);
    }

    #[test]
    fn each_of_two_notes_of_the_same_things_is_moved_by_itself() {
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let mut all = [
            annotation("c1", Shows::Length, "100 mm", &["a"]),
            annotation("c2", Shows::Length, "80 mm", &["a"]),
            annotation("c3", Shows::Relation, "∥", &["a", "b"]),
            annotation("c4", Shows::Relation, "=", &["a", "b"]),
        ];
        (all[0].measure, all[1].measure) = (Some("width".into()), Some("height".into()));
        let first = notes(&all, &corner(), &view, &Moved::new());
        for one in &first {
            let mut moved = Moved::new();
            shift(&first, &one.key, (0.0, 40.0), &mut moved);
            let now = notes(&all, &corner(), &view, &moved);
            let others = now.iter().zip(&first).filter(|(now, was)| now.at != was.at);
            assert_eq!(others.count(), 1, "{}", one.key);
        }
        // told anew a dimension stands where it stood
        let mut moved = Moved::new();
        shift(&first, &first[0].key, (0.0, 40.0), &mut moved);
        all[0].words = "101 mm".into();
        let now = notes(&all, &corner(), &view, &moved);
        assert_eq!(now[0].at.1, first[0].at.1 + 40.0);
    }

    #[test]
    fn a_radius_stays_under_the_hand_on_the_other_side_of_its_circle() {
        let center = Point { x: 0.0, y: 0.0 };
        let mut picture = corner();
        picture.drawing.elements[0].shape = Shape::Circle { center, radius: 20.0 };
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let all = [annotation("c1", Shows::Radius, "R 20 mm", &["a"])];
        let mut moved = Moved::new();
        let first = notes(&all, &picture, &view, &moved);
        shift(&first, &first[0].key, (-200.0, 10.0), &mut moved);
        let now = notes(&all, &picture, &view, &moved);
        assert!((now[0].at.0 - first[0].at.0 + 200.0).abs() < 1e-9, "{now:?}");
        // the leader ends at the right end of the words, and begins at the edge
        let [edge, end] = now[0].lines[0][..] else { panic!("a leader: {now:?}") };
        assert!(end.0 > now[0].at.0 && end.1 == now[0].at.1, "{now:?}");
        assert!((hypot(edge.0 - 200.0, edge.1 - 300.0) - 40.0).abs() < 1e-9, "{now:?}");
    }

    #[test]
    fn words_of_a_dimension_leave_grips_in_sight() {
        let mut picture = corner();
        let grip = Grip { path: "p".into(), x: 50.0, y: 13.0, ..Grip::default() };
        picture.grips.push(grip);
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let all = [annotation("c1", Shows::Length, "100 mm", &["a"])];
        let all = notes(&all, &picture, &view, &Moved::new());
        // the grip is at (300, 274), where the words would stand
        assert_eq!(all[0].at, (300.0, 260.0));
    }

    #[test]
    fn the_width_of_a_box_stands_outside_of_it_whatever_stands_below() {
        let point = |x, y| Point { x, y };
        let mut picture = corner();
        let points =
            vec![point(0.0, 200.0), point(80.0, 200.0), point(80.0, 260.0), point(0.0, 260.0)];
        picture.drawing.elements[1].shape = Shape::Polyline { points, closed: true };
        let view = View { scale: 2.0, x: 200.0, y: 600.0, ..View::default() };
        let width = annotation("c1", Shows::Length, "80 mm", &["b"]);
        let below = annotation("c2", Shows::Length, "100 mm", &["a"]);
        let all = notes(&[width, below], &picture, &view, &Moved::new());
        // the box lies between 80 and 200 on the screen
        assert!(!(80.0..=200.0).contains(&all[0].at.1), "{:?}", all[0].at);
    }

    #[test]
    fn the_number_of_a_short_dimension_leaves_what_it_is_of_in_sight() {
        assert_eq!(beyond([(100.0, 50.0), (120.0, 50.0)]), Some((164.0, 50.0)));
        assert_eq!(beyond([(100.0, 50.0), (100.0, 30.0)]), Some((100.0, 11.0)));
        assert_eq!(beyond([(100.0, 50.0), (200.0, 50.0)]), None);
        assert_eq!(beyond([(100.0, 50.0), (100.0, 50.0)]), None);
    }

    #[test]
    fn what_the_picture_does_not_show_has_no_note() {
        assert_eq!(made(&[annotation("c1", Shows::Length, "5", &["elsewhere"])]), []);
        assert_eq!(
            made(&[annotation("c1", Shows::Angle([false; 2]), "5", &["a", "elsewhere"])]),
            []
        );
    }
}
