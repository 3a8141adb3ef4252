//! What lies under the pointer: grips first, then other points, words, lines and curves.

use crate::paths::covers;
use crate::sheet::View;
use drawing::{Element, Lie, Placement, Point, Shape};
use session::view::PictureView;

/// Returns the path of what lies within `reach` pixels of a place on the screen; of what a program drew, at
/// first the thing whose program it is, and by its turns what lies deeper where that is chosen already.
pub fn pick(
    picture: &PictureView,
    view: &View,
    at: (f64, f64),
    (reach, chosen): (f64, Option<&str>),
) -> Option<String> {
    let p = view.sheet_from_screen(at);
    let reach = reach / view.scale;
    let grips =
        picture.grips.iter().map(|grip| (distance(p, Point { x: grip.x, y: grip.y }), grip));
    let grip = grips.filter(|(d, _)| *d <= reach).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((_, grip)) = grip {
        return Some(grip.path.clone());
    }
    let picked = |element: &Element| {
        let tag = element.tag.0 as usize;
        let path = picture.paths.get(tag)?;
        Some(match picture.drawn_by.get(tag) {
            Some(Some(whole)) => deeper(whole, path, chosen),
            Some(None) | None => path.clone(),
        })
    };
    // a point that nothing grips: a construction makes it
    let dots = picture.drawing.elements.iter().filter_map(|element| match element.shape {
        Shape::Dot(q) => Some((distance(p, q), element)),
        _ => None,
    });
    let dot = dots.filter(|(d, _)| *d <= reach).min_by(|a, b| a.0.total_cmp(&b.0));
    if let Some((_, dot)) = dot {
        return picked(dot);
    }
    if let Some(word) = word_at(picture, view, at) {
        return picked(word);
    }
    let near = picture.drawing.elements.iter().map(|element| (from_element(p, element), element));
    let nearest = near.filter(|(d, _)| *d <= 0.6 * reach).min_by(|a, b| a.0.total_cmp(&b.0))?;
    picked(nearest.1)
}

/// Returns what a pick chooses of what a program drew: at first the thing whose program it is; where that is chosen
/// already, the entity; then its turn, the whole set, and so on outwards, to the thing again.
fn deeper(whole: &str, entity: &str, chosen: Option<&str>) -> String {
    match chosen {
        Some(chosen) if chosen == whole => entity.to_string(),
        Some(chosen) if covers(whole, chosen) && covers(chosen, entity) => {
            let end = chosen.rfind(['.', '[']).unwrap_or(0);
            chosen[..end].to_string()
        }
        Some(chosen) if covers(whole, chosen) => entity.to_string(),
        _ => whole.to_string(),
    }
}

/// Returns the words at a place on the screen, and the path of the thing that they are of.
pub fn pick_word(picture: &PictureView, view: &View, at: (f64, f64)) -> Option<(String, String)> {
    let element = word_at(picture, view, at)?;
    let path = picture.paths.get(element.tag.0 as usize)?;
    match &element.shape {
        Shape::Text { text, .. } => Some((path.clone(), text.clone())),
        _ => None,
    }
}

/// Returns the words at a place on the screen, those in front first.
fn word_at<'p>(picture: &'p PictureView, view: &View, (x, y): (f64, f64)) -> Option<&'p Element> {
    let at = |element: &Element| {
        let Shape::Text { at, text, anchoring, placement, turn } = &element.shape else {
            return false;
        };
        let (left, top) = view.screen_from_sheet(*at);
        // seen along the words
        let (c, s) = (base::number::cos(*turn), base::number::sin(*turn));
        let ahead = view.screen_from_sheet(Point { x: at.x + c, y: at.y + s });
        let long = base::number::hypot(ahead.0 - left, ahead.1 - top).max(f64::MIN_POSITIVE);
        let (c, s) = ((ahead.0 - left) / long, (ahead.1 - top) / long);
        let (along, below) = (x - left, y - top);
        let (x, y) = (left + along * c + below * s, top - along * s + below * c);
        let height = match placement {
            Placement::OnSheet(height) => height * view.scale,
            Placement::OnScreen(height) => *height,
        };
        let width = drawing::metrics::text_width(text, height);
        let lie = Lie { at: *at, turn: *turn, vertical: view.vertical };
        let (ahead, down) = anchoring.start(text, height, lie);
        let (left, top) = (left + ahead, top + down);
        (left..=left + width + 8.0).contains(&x)
            && (top - 1.2 * height..=top + 0.6 * height).contains(&y)
    };
    picture.drawing.elements.iter().rev().find(|element| at(element))
}

fn distance(p: Point, q: Point) -> f64 {
    base::number::hypot(p.x - q.x, p.y - q.y)
}

fn from_segment(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let square = dx * dx + dy * dy;
    let along = if square > 0.0 { ((p.x - a.x) * dx + (p.y - a.y) * dy) / square } else { 0.0 };
    let along = along.clamp(0.0, 1.0);
    distance(p, Point { x: a.x + along * dx, y: a.y + along * dy })
}

/// The distance of a point from an element; of a line without ends, from wherever it goes.
fn from_element(p: Point, element: &Element) -> f64 {
    match element.shape {
        Shape::Segment(a, b) if element.style.is_unbounded && a != b => {
            let (dx, dy) = (b.x - a.x, b.y - a.y);
            (dx * (p.y - a.y) - dy * (p.x - a.x)).abs() / base::number::hypot(dx, dy)
        }
        _ => from_shape(p, &element.shape),
    }
}

/// The distance of a point from a line or curve; words and dots are not picked this way.
fn from_shape(p: Point, shape: &Shape) -> f64 {
    match shape {
        Shape::Dot(_) | Shape::Text { .. } => f64::INFINITY,
        Shape::Segment(a, b) => from_segment(p, *a, *b),
        Shape::Polyline { points, closed } => {
            let open = points.windows(2).map(|pair| (pair[0], pair[1]));
            let last = points.last().copied().zip(points.first().copied()).filter(|_| *closed);
            open.chain(last).map(|(a, b)| from_segment(p, a, b)).fold(f64::INFINITY, f64::min)
        }
        Shape::Circle { center, radius } => (distance(p, *center) - radius).abs(),
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            /// An ellipse is picked as so many segments.
            const PARTS: u32 = 96;
            let part = |i: u32| start + sweep * f64::from(i) / f64::from(PARTS);
            let at = |i| drawing::curve::on_ellipse(*center, *major, *ratio, part(i));
            (0..PARTS).map(|i| from_segment(p, at(i), at(i + 1))).fold(f64::INFINITY, f64::min)
        }
        Shape::Spline(poles) => from_curves(p, poles),
        Shape::Nurbs(curve) => from_curves(p, &curve.cubics()),
        Shape::Region(rings) => {
            let edges = rings.iter().flat_map(|ring| drawing::curve::edges(ring));
            edges.map(|edge| from_shape(p, &edge)).fold(f64::INFINITY, f64::min)
        }
        Shape::Arc { center, radius, start, sweep } => {
            let angle = base::number::atan2(p.y - center.y, p.x - center.x);
            let turned = (angle - start) * sweep.signum();
            let turned = turned.rem_euclid(std::f64::consts::TAU);
            if turned <= sweep.abs() {
                (distance(p, *center) - radius).abs()
            } else {
                f64::INFINITY
            }
        }
    }
}

/// The distance of a point from Bézier curves.
fn from_curves(p: Point, poles: &[Point]) -> f64 {
    /// Each of the curves is picked as so many segments.
    const PARTS: u32 = 24;
    let pieces = drawing::spline::pieces(poles).flat_map(|piece| {
        let at = move |i| drawing::spline::at(piece, f64::from(i) / f64::from(PARTS));
        (0..PARTS).map(move |i| from_segment(p, at(i), at(i + 1)))
    });
    pieces.fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::{from_shape, pick};
    use crate::sheet::View;
    use drawing::{Drawing, Element, Layer, Point, Shape, Style, Tag};
    use session::view::{Grip, PictureView};

    const AT: fn(f64, f64) -> Point = |x, y| Point { x, y };

    #[test]
    fn distances_from_curves() {
        let segment = Shape::Segment(AT(0.0, 0.0), AT(10.0, 0.0));
        assert_eq!(from_shape(AT(5.0, 3.0), &segment), 3.0);
        assert_eq!(from_shape(AT(14.0, 3.0), &segment), 5.0);
        let nothing = Shape::Segment(AT(1.0, 1.0), AT(1.0, 1.0));
        assert_eq!(from_shape(AT(1.0, 3.0), &nothing), 2.0);
        let arc = |sweep| Shape::Arc { center: AT(0.0, 0.0), radius: 2.0, start: 0.0, sweep };
        assert_eq!(from_shape(AT(0.0, 3.0), &arc(2.0)), 1.0);
        assert_eq!(from_shape(AT(0.0, 3.0), &arc(-2.0)), f64::INFINITY);
        assert_eq!(from_shape(AT(0.0, -3.0), &arc(-2.0)), 1.0);
    }

    #[test]
    fn a_point_is_picked_before_the_line_that_it_lies_on() {
        let line = Element {
            shape: Shape::Segment(AT(0.0, 0.0), AT(100.0, 0.0)),
            style: Style::default(),
            layer: Layer::Lines,
            tag: Tag(0),
        };
        let picture = PictureView {
            drawing: Drawing { elements: vec![line], ..Drawing::default() },
            paths: vec![String::from("line")],
            freedom: vec![None],
            grips: vec![Grip { path: String::from("line.p1"), ..Grip::default() }],
            ..PictureView::default()
        };
        let view = View { scale: 2.0, ..View::default() };
        let at = |x, y| pick(&picture, &view, (x, y), (10.0, None));
        assert_eq!(at(6.0, 0.0), Some(String::from("line.p1")));
        assert_eq!(at(60.0, 5.0), Some(String::from("line")));
        assert_eq!(at(60.0, 15.0), None);
    }

    #[test]
    fn a_point_that_a_construction_makes_is_picked() {
        let dot = |tag, x| Element {
            shape: Shape::Dot(AT(x, 0.0)),
            style: Style::default(),
            layer: Layer::Points,
            tag: Tag(tag),
        };
        let picture = PictureView {
            drawing: Drawing { elements: vec![dot(0, 0.0), dot(1, 40.0)], ..Drawing::default() },
            paths: vec![String::from("foot"), String::from("middle")],
            drawn_by: vec![None, None],
            freedom: vec![None, None],
            ..PictureView::default()
        };
        let at = |x, y| pick(&picture, &View::default(), (x, y), (10.0, None));
        assert_eq!(at(4.0, 3.0), Some(String::from("foot")));
        assert_eq!(at(33.0, 0.0), Some(String::from("middle")));
        assert_eq!(at(20.0, 0.0), None);
    }

    #[test]
    fn picking_again_goes_in_and_outwards() {
        let entity = "rings.column[2].ring";
        let ways = [
            (None, "rings"),
            (Some("other"), "rings"),
            (Some("rings"), entity),
            (Some(entity), "rings.column[2]"),
            (Some("rings.column[2]"), "rings.column"),
            (Some("rings.column"), "rings"),
            (Some("rings.column[1].ring"), entity),
        ];
        for (chosen, wanted) in ways {
            assert_eq!(super::deeper("rings", entity, chosen), wanted, "{chosen:?}");
        }
    }
}
