//! Rings: what segments, arcs and other open lines of a picture surround, so that it can be filled.

use std::collections::BTreeMap;

use base::number::{cos, hypot, sin, tan};
use drawing::curve::{corners_along, ring_along};
use drawing::{Corner, Element, Layer, Line, Point, Shape};

/// Ends that are closer than this part of how far the pieces reach meet: they are computed on several ways. Pieces
/// between the same ends are one where their bulges differ by as small a part.
const MEET: f64 = 1e-9;

/// A segment, an arc or another line, from one end to the other.
#[derive(Clone, Copy)]
struct Piece {
    from: Point,
    to: Point,
    /// The bulge of a segment or an arc; of another line how much lies between it and its chord, as a part of the
    /// chord's square, which tells it from others.
    bulge: f64,
    /// Whether it is neither a segment nor an arc.
    is_curve: bool,
}

impl Piece {
    fn of(shape: &Shape) -> Option<Self> {
        match *shape {
            Shape::Segment(from, to) => Some(Self { from, to, bulge: 0.0, is_curve: false }),
            Shape::Arc { center, radius, start, sweep } => {
                let at = |angle: f64| Point {
                    x: center.x + radius * cos(angle),
                    y: center.y + radius * sin(angle),
                };
                let (from, to) = (at(start), at(start + sweep));
                Some(Self { from, to, bulge: tan(sweep / 4.0), is_curve: false })
            }
            Shape::Polyline { closed: false, .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_) => Self::of_curve(shape),
            Shape::Dot(_)
            | Shape::Polyline { closed: true, .. }
            | Shape::Circle { .. }
            | Shape::Region(_)
            | Shape::Text { .. } => None,
        }
    }
    fn of_curve(shape: &Shape) -> Option<Self> {
        let line = corners_along(shape)?;
        let (from, to) = (line.first()?.at, line.last()?.at);
        let poles =
            line.iter().flat_map(|c| [Some(c.at), c.poles.map(|p| p[0]), c.poles.map(|p| p[1])]);
        let ways = poles.flatten().map(|p| (p.x - from.x, p.y - from.y));
        let ways: Vec<(f64, f64)> = ways.collect();
        let twice = ways.windows(2).map(|w| w[0].0 * w[1].1 - w[1].0 * w[0].1).sum::<f64>();
        let chord = hypot(to.x - from.x, to.y - from.y);
        Some(Self { from, to, bulge: twice / (chord * chord), is_curve: true })
    }
    fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, bulge: -self.bulge, ..self }
    }
    fn is_finite(self) -> bool {
        [self.from.x, self.from.y, self.to.x, self.to.y, self.bulge].into_iter().all(f64::is_finite)
    }
}

/// Returns true for what may be a piece of a ring.
pub(crate) fn is_piece(element: &Element) -> bool {
    let is_edge = matches!(
        element.shape,
        Shape::Segment(..)
            | Shape::Arc { .. }
            | Shape::Polyline { closed: false, .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_)
    );
    is_edge && !element.style.is_unbounded && element.style.dimension.is_none()
}

/// A piece between two corners, which are told by their numbers.
struct Side {
    corners: [usize; 2],
    piece: Piece,
    /// The places of all elements that draw it, the first in front.
    places: Vec<usize>,
}

impl Side {
    /// Its corners, the lower in front, and its bulge that way.
    fn ordered(&self) -> ([usize; 2], f64) {
        let [from, to] = self.corners;
        if from < to { ([from, to], self.piece.bulge) } else { ([to, from], -self.piece.bulge) }
    }
    /// Takes over the places of another that is the same.
    fn join(&mut self, other: &mut Self) {
        if other.places < self.places {
            std::mem::swap(self, other);
        }
        self.places.append(&mut other.places);
    }
    /// The piece as it runs from one of the corners, and the corner where it ends.
    fn run_from(&self, corner: usize) -> (Piece, usize) {
        let [from, to] = self.corners;
        if from == corner { (self.piece, to) } else { (self.piece.reversed(), from) }
    }
}

/// The corners where ends meet, found by a lattice whose cells are as wide as ends that meet may lie apart.
struct Corners {
    width: f64,
    cells: BTreeMap<[i64; 2], Vec<(Point, usize)>>,
    count: usize,
}

impl Corners {
    /// Returns the number of the corner at a point.
    fn number(&mut self, p: Point) -> usize {
        let [column, row] = [p.x, p.y].map(|x| (x / self.width).floor() as i64);
        let near = [-1, 0, 1].map(|by| column.saturating_add(by)).into_iter();
        let near = near.flat_map(|x| [-1, 0, 1].map(|by| [x, row.saturating_add(by)]));
        let known = near.filter_map(|cell| self.cells.get(&cell)).flatten();
        let meets = |q: &Point| hypot(p.x - q.x, p.y - q.y) <= self.width;
        if let Some(number) = known.filter(|(q, _)| meets(q)).map(|(_, number)| *number).min() {
            return number;
        }
        let number = self.count;
        self.cells.entry([column, row]).or_default().push((p, number));
        self.count += 1;
        number
    }
}

/// Returns the sides in the order of their places, and how many corners they have. What is drawn twice is one side.
fn sides(elements: &[Element]) -> (Vec<Side>, usize) {
    let piece = |e: &Element| Piece::of(&e.shape).filter(|p| is_piece(e) && p.is_finite());
    let pieces = elements.iter().enumerate().filter_map(|(at, e)| Some((at, piece(e)?)));
    let pieces: Vec<(usize, Piece)> = pieces.collect();
    let ends = pieces.iter().flat_map(|(_, piece)| [piece.from, piece.to]);
    let reach = ends.fold(0.0_f64, |reach, p| reach.max(p.x.abs()).max(p.y.abs()));
    let mut corners = Corners { width: MEET * reach, cells: BTreeMap::new(), count: 0 };
    let mut side = |(place, piece): (usize, Piece)| Side {
        corners: [piece.from, piece.to].map(|end| corners.number(end)),
        piece,
        places: vec![place],
    };
    let mut sides: Vec<Side> = pieces.into_iter().map(&mut side).collect();
    sides.retain(|side| side.corners[0] != side.corners[1]);
    sides.sort_by(|one, other| {
        let ((one, by), (other, other_by)) = (one.ordered(), other.ordered());
        one.cmp(&other).then(by.total_cmp(&other_by))
    });
    sides.dedup_by(|next, kept| {
        let ((one, by), (other, other_by)) = (next.ordered(), kept.ordered());
        let is_same = one == other && (by - other_by).abs() <= MEET * by.abs().max(1.0);
        if is_same {
            kept.join(next);
        }
        is_same
    });
    sides.sort_by_key(|side| side.places[0]);
    (sides, corners.count)
}

/// Finds the rings that segments, arcs and other lines close, each piece in one ring at most: the surface of each, which has no
/// line, and the places of its pieces. What hangs on a ring, or leads from one to another, is in none.
///
/// From each corner the first side that is left is followed, until the way comes back to a corner that it has passed;
/// where it ends, it goes back. So each side is passed once, and the cost is that of sorting them: n log n.
pub(crate) fn rings(elements: &[Element]) -> Vec<(Element, Vec<usize>)> {
    let (sides, count) = sides(elements);
    // the sides of each corner that are left, the first at the end
    let mut left: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (i, side) in sides.iter().enumerate().rev() {
        side.corners.iter().for_each(|&corner| left[corner].push(i));
    }
    let mut is_used = vec![false; sides.len()];
    // for each corner on the way, how many sides lie before it
    let mut passed: Vec<Option<usize>> = vec![None; count];
    let mut rings = Vec::new();
    for first in &sides {
        let (mut way, mut at) = (Vec::new(), first.corners[0]);
        loop {
            passed[at] = Some(way.len());
            while left[at].pop_if(|side| is_used[*side]).is_some() {}
            if let Some(next) = left[at].pop() {
                is_used[next] = true;
                way.push((next, at));
                at = sides[next].run_from(at).1;
                if let Some(begun) = passed[at] {
                    let ring = way.split_off(begun);
                    ring.iter().for_each(|&(_, corner)| passed[corner] = None);
                    rings.push(surface(elements, &sides, &ring));
                }
            } else {
                passed[at] = None;
                let Some((_, before)) = way.pop() else { break };
                at = before;
            }
        }
    }
    rings
}

/// Returns what sides surround, each of them with the corner that it runs from, and the places of their elements.
fn surface(elements: &[Element], sides: &[Side], ring: &[(usize, usize)]) -> (Element, Vec<usize>) {
    let pieces = ring.iter().map(|&(side, corner)| sides[side].run_from(corner).0);
    let pieces: Vec<Piece> = pieces.collect();
    let shape = |(side, _): &(usize, usize)| elements[sides[*side].places[0]].shape.clone();
    let curved = pieces
        .iter()
        .any(|piece| piece.is_curve)
        .then(|| ring_along(&ring.iter().map(shape).collect::<Vec<_>>()));
    let straight = || pieces.iter().map(|piece| Corner::new(piece.from, piece.bulge)).collect();
    let corners = curved.flatten().unwrap_or_else(straight);
    let places: Vec<usize> =
        ring.iter().flat_map(|&(side, _)| &sides[side].places).copied().collect();
    let mut surface = Element {
        shape: Shape::Region(vec![corners]),
        layer: Layer::Back,
        ..elements[places[0]].clone()
    };
    surface.style.line = Line::None;
    (surface, places)
}

#[cfg(test)]
mod tests {
    use super::rings;
    use drawing::{Element, Point, Shape};

    fn segment(a: (f64, f64), b: (f64, f64)) -> Element {
        let point = |(x, y)| Point { x, y };
        Element::new(Shape::Segment(point(a), point(b)))
    }

    #[test]
    fn sides_close_whichever_way_they_run_and_open_ones_do_not() {
        let sides = [
            segment((0.0, 0.0), (4.0, 0.0)),
            segment((9.0, 9.0), (8.0, 8.0)),
            segment((4.0, 3.0), (4.0, 0.0)),
            segment((4.0, 3.0), (0.0, 0.0)),
        ];
        let found = rings(&sides);
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].1, [0, 2, 3]);
        assert!(rings(&sides[..3]).is_empty());
    }

    #[test]
    fn a_half_circle_and_its_chord_close() {
        let center = Point { x: 1e3, y: 0.0 };
        let arc = Shape::Arc { center, radius: 7.0, start: 0.0, sweep: std::f64::consts::PI };
        let found = rings(&[Element::new(arc), segment((993.0, 0.0), (1007.0, 0.0))]);
        let Shape::Region(corners) = &found[0].0.shape else { panic!("a region") };
        assert!((corners[0][0].bulge - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_spline_and_its_chord_close_whichever_way_they_run() {
        let point = |(x, y)| Point { x, y };
        let poles = [(0.0, 0.0), (1.0, 3.0), (3.0, 3.0), (4.0, 0.0)];
        let spline = |way: Vec<Point>| Element::new(Shape::Spline(way));
        let way: Vec<Point> = poles.into_iter().map(point).collect();
        let back: Vec<Point> = way.iter().rev().copied().collect();
        for (a, b) in [((0.0, 0.0), (4.0, 0.0)), ((4.0, 0.0), (0.0, 0.0))] {
            let lines = [spline(way.clone()), segment(a, b), spline(back.clone())];
            let found = rings(&lines);
            // what is drawn twice is one side
            assert_eq!(found[0].1, [0, 2, 1]);
            let Shape::Region(corners) = &found[0].0.shape else { panic!("a region") };
            assert_eq!(corners[0].len(), 2);
            assert!(drawing::curve::covers(corners, Point { x: 2.0, y: 2.0 }));
            assert!(!drawing::curve::covers(corners, Point { x: 2.0, y: 2.4 }));
        }
        // with an ellipse for the other side
        let half = |ratio| {
            Element::new(Shape::Ellipse {
                center: point((2.0, 0.0)),
                major: point((2.0, 0.0)),
                ratio,
                start: 0.0,
                sweep: -std::f64::consts::PI,
            })
        };
        let found = rings(&[half(0.5), spline(way)]);
        assert_eq!(found.len(), 1);
        let Shape::Region(corners) = &found[0].0.shape else { panic!("a region") };
        assert!(drawing::curve::covers(corners, Point { x: 2.0, y: -0.9 }));
        assert!(!drawing::curve::covers(corners, Point { x: 2.0, y: -1.1 }));
        // a line that closes by itself is filled by itself
        let whole = Shape::Ellipse {
            center: point((0.0, 0.0)),
            major: point((2.0, 0.0)),
            ratio: 0.5,
            start: 0.0,
            sweep: std::f64::consts::TAU,
        };
        assert!(rings(&[Element::new(whole), segment((9.0, 0.0), (8.0, 0.0))]).is_empty());
    }

    /// The places of the pieces of each ring that segments between named corners close.
    fn closed(named: &[&str]) -> Vec<Vec<usize>> {
        let place = |name| match name {
            'a' => (0.0, 0.0),
            'b' => (4.0, 0.0),
            'c' => (4.0, 3.0),
            'd' => (0.0, 3.0),
            'e' => (9.0, 0.0),
            'f' => (9.0, 3.0),
            _ => (12.0, 0.0),
        };
        let ends = |name: &str| {
            let mut ends = name.chars().map(place);
            Some(segment(ends.next()?, ends.next()?))
        };
        let sides: Vec<Element> = named.iter().filter_map(|name| ends(name)).collect();
        rings(&sides).into_iter().map(|(_, places)| places).collect()
    }

    #[test]
    fn a_spur_on_a_corner_leaves_the_figure_closed() {
        assert_eq!(closed(&["ab", "be", "bc", "cd", "da"]), [[0, 2, 3, 4]]);
        assert_eq!(closed(&["eb", "fe", "ab", "bc", "cd", "da"]), [[2, 5, 4, 3]]);
        assert!(closed(&["ab", "be", "ef"]).is_empty());
    }

    #[test]
    fn a_side_that_is_drawn_twice_counts_once() {
        assert_eq!(closed(&["ab", "ba", "bc", "ca"]), [[0, 1, 2, 3]]);
        assert_eq!(closed(&["ab", "bc", "ab", "ca"]), [[0, 2, 1, 3]]);
        assert!(closed(&["ab", "ba"]).is_empty());
    }

    #[test]
    fn figures_that_share_a_corner_or_are_led_from_one_to_the_other_close_each() {
        assert_eq!(
            closed(&["ab", "be", "eg", "gf", "fe", "bc", "ca"]),
            [vec![2, 3, 4], vec![0, 5, 6]]
        );
        assert_eq!(closed(&["ab", "be", "ef", "fb", "bc", "ca"]), [[1, 2, 3], [0, 4, 5]]);
    }

    #[test]
    fn two_arcs_between_the_same_ends_close() {
        let center = Point { x: 0.0, y: 0.0 };
        let arc = |sweep| Element::new(Shape::Arc { center, radius: 2.0, start: 0.0, sweep });
        let (up, down) = (arc(std::f64::consts::PI), arc(-std::f64::consts::PI));
        assert_eq!(rings(&[up.clone(), down, up.clone()])[0].1, [0, 2, 1]);
        assert!(rings(&[up.clone(), up]).is_empty());
    }
}
