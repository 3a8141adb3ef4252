//! Shapes as operations of a display list.

use super::{DisplayList, POINT, Sign, sign};
use drawing::{Anchoring, Placement, Point, Shape};

/// Adds a shape in the style that was begun.
pub(super) fn shape(list: &mut DisplayList, shape: &Shape) {
    let out = &mut list.numbers;
    match shape {
        Shape::Dot(p) => sign(list, Sign::Disc, *p, POINT),
        Shape::Segment(p, q) => out.extend([2.0, p.x, p.y, q.x, q.y]),
        Shape::Polyline { points, closed } => {
            out.extend([3.0, f64::from(u8::from(*closed)), points.len() as f64]);
            out.extend(points.iter().flat_map(|p| [p.x, p.y]));
        }
        Shape::Circle { center, radius } => {
            out.extend([4.0, center.x, center.y, radius.max(0.0), 0.0, std::f64::consts::TAU]);
        }
        Shape::Arc { center, radius, start, sweep } => {
            out.extend([4.0, center.x, center.y, radius.max(0.0), *start, *sweep]);
        }
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            let (length, turned) =
                (drawing::curve::half_axis(*major), base::number::atan2(major.y, major.x));
            out.extend([8.0, center.x, center.y, length, ratio * length, turned, *start, *sweep]);
        }
        Shape::Spline(poles) => curves(out, poles),
        Shape::Nurbs(curve) => curves(out, &curve.cubics()),
        Shape::Region(rings) => {
            out.extend([13.0, 1.0]);
            for ring in rings {
                let mut is_first = true;
                for edge in drawing::curve::edges(ring) {
                    region_edge(out, &edge, std::mem::take(&mut is_first));
                }
                out.push(11.0);
            }
            out.extend([13.0, 0.0]);
        }
        Shape::Text { at, text, anchoring, placement, turn } => {
            let word = list.words.len() as f64;
            list.words.push(text.clone());
            let lie = drawing::Lie { at: *at, turn: *turn, vertical: list.vertical };
            let (right, down) = anchoring.held(text, 1.0, lie);
            let anchoring = match anchoring {
                Anchoring::Start => 0.0,
                Anchoring::Middle | Anchoring::Center | Anchoring::Away(_) => 1.0,
                Anchoring::End => 2.0,
            };
            // words on the sheet are never wider than the measure that the document goes by
            let (height, width) = match placement {
                Placement::OnSheet(height) => {
                    (*height, drawing::metrics::text_width(text, *height))
                }
                Placement::OnScreen(height) => (*height, 0.0),
            };
            out.extend([6.0, word, at.x, at.y, anchoring, height, width, *turn, right, down]);
        }
    }
}

/// Goes along Bézier curves.
fn curves(out: &mut Vec<f64>, poles: &[Point]) {
    out.extend(poles.first().into_iter().flat_map(|p| [9.0, p.x, p.y]));
    for [_, p, q, r] in drawing::spline::pieces(poles) {
        out.extend([14.0, p.x, p.y, q.x, q.y, r.x, r.y]);
    }
}

/// Goes on along a ring; its first edge begins it.
fn region_edge(out: &mut Vec<f64>, edge: &Shape, is_first: bool) {
    match edge {
        Shape::Segment(p, q) => {
            if is_first {
                out.extend([9.0, p.x, p.y]);
            }
            out.extend([10.0, q.x, q.y]);
        }
        Shape::Arc { center, radius, start, sweep } => {
            if is_first {
                let at = |f: fn(f64) -> f64, c: f64| c + radius * f(*start);
                out.extend([9.0, at(base::number::cos, center.x), at(base::number::sin, center.y)]);
            }
            out.extend([12.0, center.x, center.y, *radius, *start, *sweep]);
        }
        Shape::Spline(poles) => {
            let begin = if is_first { 0 } else { 3 };
            let from = out.len();
            curves(out, poles);
            out.drain(from..from + begin);
        }
        _ => {}
    }
}
