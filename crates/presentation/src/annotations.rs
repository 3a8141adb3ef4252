//! Annotations in the picture: dimension lines, and signs beside what constraints speak of.
//!
//! In: what the session says stands on the drawing, the picture, and where the sheet lies on the screen. Out: notes in
//! pixels, each with its words, its lines and its box, which are painted and picked.

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
/// The radius of an angle's arc.
const ARC: f64 = 26.0;

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
}

impl Note {
    /// Whether a place on the screen is on its words.
    fn is_at(&self, (x, y): Pixels) -> bool {
        let (wide, high) = half(&self.words);
        (x - self.at.0).abs() <= wide && (y - self.at.1).abs() <= high
    }
}

/// Half the size of the box of some words, in pixels.
fn half(words: &str) -> Pixels {
    (metrics::text_width(words, HEIGHT) / 2.0 + ROOM, HEIGHT / 2.0 + ROOM)
}

/// Returns the path of the constraint whose words are at a place on the screen.
pub fn at(notes: &[Note], place: Pixels) -> Option<&str> {
    notes.iter().rev().find(|note| note.is_at(place)).map(|note| note.path.as_str())
}

/// What the picture shows of a thing, in pixels.
#[derive(Clone, Copy, Debug)]
enum Seen {
    Place(Pixels),
    Way(Pixels, Pixels),
    /// A centre, a radius, and the direction of the middle of an arc.
    Round(Pixels, f64, f64),
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
pub fn notes(all: &[Annotation], picture: &PictureView, view: &View) -> Vec<Note> {
    let (seen, edges) = (seen(all, picture, view), edges(all, picture, view));
    let sides = edges.values().flatten().map(|(a, b)| between(*a, *b));
    let places: Vec<Pixels> = seen.values().map(|seen| seen.middle()).chain(sides).collect();
    let n = places.len().max(1) as f64;
    let middle = places.iter().fold((0.0, 0.0), |sum, at| (sum.0 + at.0 / n, sum.1 + at.1 / n));
    let mut desk = Desk { middle, scale: view.scale, taken: BTreeMap::new() };
    all.iter().flat_map(|one| desk.place(one, &seen, &edges)).collect()
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
                Some(Seen::Round(screen(*center), radius * view.scale, -FRAC_PI_4))
            }
            Shape::Arc { center, radius, start, sweep } => {
                let turn = start + sweep / 2.0;
                let on = Point { x: center.x + cos(turn), y: center.y + sin(turn) };
                let (from, to) = (screen(*center), screen(on));
                let turn = atan2(to.1 - from.1, to.0 - from.0);
                Some(Seen::Round(from, radius * view.scale, turn))
            }
            // what is said of it stands at its first edge
            Shape::Polyline { points, .. } => match points.as_slice() {
                [a, b, ..] => Some(Seen::Way(screen(*a), screen(*b))),
                _ => None,
            },
            Shape::Ellipse { .. } | Shape::Spline(_) | Shape::Region(_) | Shape::Text { .. } => {
                None
            }
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
struct Desk {
    /// The middle of all that they are of: dimensions stand away from it.
    middle: Pixels,
    /// How many pixels a unit of the sheet has.
    scale: f64,
    /// How many notes stand at a place already, by the place to the pixel.
    taken: BTreeMap<Spot, u32>,
}

/// A place to the pixel, and whether a dimension stands there.
type Spot = (i64, i64, bool);

fn spot(at: Pixels, is_dimension: bool) -> Spot {
    (at.0.round() as i64, at.1.round() as i64, is_dimension)
}

impl Desk {
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
        let note = |at: Pixels, lines: Vec<Vec<Pixels>>| Note {
            path: one.path.clone(),
            words: one.words.clone(),
            holds: one.holds,
            at,
            lines,
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
        match (shows, of.as_slice()) {
            (Shows::Length, [Seen::Way(a, b)])
            | (Shows::Length, [Seen::Place(a), Seen::Place(b)]) => {
                let (at, lines) = self.length((*a, *b), &one.words);
                vec![note(at, lines)]
            }
            (
                Shows::Length,
                [Seen::Place(a), Seen::Way(b, c)] | [Seen::Way(b, c), Seen::Place(a)],
            ) => {
                let (dx, dy) = direction(*b, *c);
                let far = (a.0 - b.0) * dx + (a.1 - b.1) * dy;
                let (at, lines) = self.length((*a, along(*b, (dx, dy), far)), &one.words);
                vec![note(at, lines)]
            }
            (Shows::Radius, [Seen::Round(center, radius, turn)]) => {
                let turn = turn + 0.5 * self.nth(*center, true);
                let way = (cos(turn), sin(turn));
                let (edge, end) =
                    (along(*center, way, *radius), along(*center, way, radius + ASIDE));
                let side = if way.0 < 0.0 { -1.0 } else { 1.0 };
                let (half, _) = half(&one.words);
                let lines = [vec![vec![edge, end]], vec![head(edge, end)]].concat();
                vec![note((end.0 + side * half, end.1), lines)]
            }
            (Shows::Angle, [Seen::Way(a, b), Seen::Way(c, d)]) => {
                let (at, lines) = angle((*a, *b), (*c, *d));
                vec![note(at, lines)]
            }
            // level or upright: once, between the two
            (_, [Seen::Place(a), Seen::Place(b)]) => {
                let at = self.beside(*a, *b);
                vec![note(at, Vec::new())]
            }
            (_, of) => of.iter().map(|seen| note(self.sign(*seen), Vec::new())).collect(),
        }
    }

    /// The middle of the words and the lines of a dimension between two places.
    fn length(&mut self, (a, b): (Pixels, Pixels), words: &str) -> (Pixels, Vec<Vec<Pixels>>) {
        /// What is left of the line on each side of the words, at least, in pixels.
        const LEFT: f64 = 10.0;
        let out = self.outwards(a, b);
        let far = ASIDE * (1.0 + self.nth(between(a, b), true));
        let (p, q) = (along(a, out, far), along(b, out, far));
        let leader = |from| vec![along(from, out, 4.0), along(from, out, far + 4.0)];
        let lines = vec![leader(a), leader(b), vec![p, q], head(p, q), head(q, p)];
        // what does not fit into the line stands beyond it
        let (wide, high) = half(words);
        let (dx, dy) = direction(p, q);
        let taken = (wide / dx.abs()).min(high / dy.abs());
        let fits = hypot(q.0 - p.0, q.1 - p.1) >= 2.0 * (taken + LEFT);
        let beyond = if fits { 0.0 } else { wide * out.0.abs() + high * out.1.abs() + ROOM };
        (along(between(p, q), out, beyond), lines)
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
            Seen::Round(center, radius, turn) => {
                let n = self.nth(center, false);
                let turn = turn + PI + 22.0 * n / radius.max(22.0);
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

/// The words and the arc of an angle between two lines.
fn angle((a, b): (Pixels, Pixels), (c, d): (Pixels, Pixels)) -> (Pixels, Vec<Vec<Pixels>>) {
    let ((ux, uy), (vx, vy)) = (direction(a, b), direction(c, d));
    let cross = ux * vy - uy * vx;
    if cross.abs() < 1e-9 {
        return (between(between(a, b), between(c, d)), Vec::new());
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
    let on = |turn: f64, radius: f64| along(corner, (cos(turn), sin(turn)), radius);
    let part = |n: u32| on(from + sweep * f64::from(n) / f64::from(PARTS), ARC);
    // where a line does not reach the arc it is continued
    let leader = |(p, q): (Pixels, Pixels), turn: f64| {
        let end = on(turn, ARC + 6.0);
        let past = |r: Pixels| (r.0 - corner.0) * cos(turn) + (r.1 - corner.1) * sin(turn);
        let reaches = past(p).max(past(q)) >= ARC && past(p).min(past(q)) <= ARC;
        (!reaches).then(|| vec![corner, end])
    };
    let mut lines = vec![(0..=PARTS).map(part).collect()];
    lines.extend(leader((a, b), from).into_iter().chain(leader((c, d), to)));
    (on(from + sweep / 2.0, 1.9 * ARC), lines)
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

#[cfg(test)]
mod tests {
    use super::{Note, at, notes};
    use crate::sheet::View;
    use drawing::{Drawing, Element, Layer, Point, Shape, Style, Tag};
    use session::view::{Annotation, PictureView, Shows};

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
            number: words.split(' ').next().and_then(|number| number.parse().ok()),
            typed: None,
        }
    }

    fn made(all: &[Annotation]) -> Vec<Note> {
        // a sheet whose origin is at (200, 300), y up, two pixels a unit
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        notes(all, &corner(), &view)
    }

    #[test]
    fn dimensions_stand_outside_and_further_ones_further_away() {
        let length = |path| annotation(path, Shows::Length, "100 mm", &["a"]);
        let upright = annotation("c3", Shows::Length, "60 mm", &["b"]);
        let all = made(&[length("c1"), length("c2"), upright]);
        let places: Vec<(f64, f64)> = all.iter().map(|note| note.at).collect();
        // below the line that runs along the bottom, to the right of the upright one
        assert_eq!(places, [(300.0, 326.0), (300.0, 352.0), (426.0, 240.0)]);
        assert_eq!(at(&all, (303.0, 350.0)), Some("c2"));
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
            annotation("c2", Shows::Angle, "90 deg", &["a", "b"]),
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
    fn a_box_has_its_width_along_and_its_height_beside_it() {
        let mut picture = corner();
        picture.paths = vec!["box.side1".into(), "box.side2".into()];
        picture.drawn_by = vec![Some("box".into()); 2];
        let view = View { scale: 2.0, x: 200.0, y: 300.0, ..View::default() };
        let of = ["60 mm", "100 mm", "320 mm"];
        let all = of.map(|words| annotation(words, Shows::Length, words, &["box"]));
        let all = notes(&all, &picture, &view);
        let [height, width, around] = all.as_slice() else { panic!("three notes: {all:?}") };
        // outside of the middles of the lower side and of the right one, at (300, 300) and (400, 240)
        assert_eq!((width.at, height.at), ((300.0, 326.0), (426.0, 240.0)));
        // what is as long as no side has no arrows
        assert_eq!((width.lines.len(), height.lines.len(), around.lines.len()), (5, 5, 0));
    }

    #[test]
    fn what_the_picture_does_not_show_has_no_note() {
        assert_eq!(made(&[annotation("c1", Shows::Length, "5", &["elsewhere"])]), []);
        assert_eq!(made(&[annotation("c1", Shows::Angle, "5", &["a", "elsewhere"])]), []);
    }
}
