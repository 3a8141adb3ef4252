//! Curves that are no figures, as splines and ellipses: each is picked by what it draws, and at its places.

use super::{Curve, Found, Scene};
use crate::drafting::compound;
use base::number::{cos, sin};
use drawing::{Point, Shape, curve, spline};
use eval::Answer;
use kernel::ClassId;
use std::f64::consts::TAU;

/// A curve between two places is picked as so many chords.
const CHORDS: u32 = 16;
/// An ellipse is picked as so many.
const CHORDS_AROUND: u32 = 96;

impl<'a> Scene<'a> {
    /// Adds the edges of what has ellipses or splines among them: each stands for the whole.
    pub(super) fn drawn_outline(
        &mut self,
        at: (&str, &[String]),
        (class, of): (ClassId, &Answer<'a>),
    ) {
        for element in self.evaluator.elements(of) {
            let Shape::Region(rings) = &element.shape else { continue };
            for edge in rings.iter().flat_map(|ring| curve::edges(ring)) {
                chords_of(&edge).into_iter().for_each(|chord| self.chord(at, class, chord));
            }
        }
    }

    fn chord(&mut self, (text, wholes): (&str, &[String]), class: ClassId, curve: Curve) {
        self.found.push(Found {
            text: text.into(),
            class,
            curve,
            wholes: wholes.to_vec(),
            side_of: None,
            side: None,
            is_place: false,
            is_result: self.is_result,
        });
    }

    /// Adds the chords of such a curve, each as the whole, and its places.
    pub(super) fn through_places(
        &mut self,
        (text, wholes): (&str, &[String]),
        (class, of): (ClassId, &Answer<'a>),
    ) {
        let document = &self.state.lowered.document;
        let is_of_places = compound::is_of_places(document, class);
        if !is_of_places && !compound::is_freeform(document, class) {
            return;
        }
        let is_edge = document.class_named("Edge").is_some_and(|edge| document.is_a(class, edge));
        for element in self.evaluator.elements(of) {
            let ends = ends_of(&element.shape).filter(|_| is_edge);
            for chord in chords_of(&element.shape) {
                self.chord((text, wholes), class, Curve { arc: ends, ..chord });
            }
        }
        let parts = document.layout(class);
        if !is_of_places {
            let names: Vec<_> = parts.into_iter().map(|part| document.field_name(part)).collect();
            for name in names {
                let Ok(place) = self.evaluator.of_part(of, name) else { continue };
                let point = self.evaluator.class_of(&place).zip(Curve::of(&self.evaluator, &place));
                if let Some(point) = point {
                    self.place(format!("{text}.{name}"), point);
                }
            }
            return;
        }
        let Some(part) = parts.first().map(|field| document.field_name(*field)) else { return };
        let Ok(Answer::List(places)) = self.evaluator.of_part(of, part) else { return };
        for (i, place) in places.iter().enumerate() {
            let point = self.evaluator.class_of(place).zip(Curve::of(&self.evaluator, place));
            if let Some(point) = point {
                self.place(format!("{text}.{part}[{i}]"), point);
            }
        }
    }
}

/// Returns where a curve begins and ends; what goes all the way round ends exactly where it begins.
fn ends_of(shape: &Shape) -> Option<[[f64; 2]; 2]> {
    let [from, to] = curve::ends(shape)?.map(|p| [p.x, p.y]);
    let is_whole = matches!(shape, Shape::Ellipse { sweep, .. } if sweep.abs() >= TAU);
    Some(if is_whole { [from, from] } else { [from, to] })
}

/// Returns the chords of a curve that is no figure, and of an edge.
fn chords_of(shape: &Shape) -> Vec<Curve> {
    match shape {
        Shape::Spline(poles) => chords(poles).collect(),
        Shape::Nurbs(curve) => chords(&curve.cubics()).collect(),
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            around((*center, *major, *ratio), (*start, *sweep)).collect()
        }
        Shape::Arc { center, radius, start, sweep } => {
            around((*center, Point { x: *radius, y: 0.0 }, 1.0), (*start, *sweep)).collect()
        }
        Shape::Segment(p, q) => {
            vec![Curve { is_chord: true, ..Curve::segment([p.x, p.y], [q.x, q.y]) }]
        }
        Shape::Dot(_)
        | Shape::Polyline { .. }
        | Shape::Circle { .. }
        | Shape::Region(_)
        | Shape::Text { .. } => Vec::new(),
    }
}

fn chords(poles: &[Point]) -> impl Iterator<Item = Curve> + '_ {
    spline::pieces(poles).flat_map(|piece| {
        let at = move |i: u32| {
            let Point { x, y } = spline::at(piece, f64::from(i) / f64::from(CHORDS));
            [x, y]
        };
        let chord = move |i| Curve { is_chord: true, ..Curve::segment(at(i), at(i + 1)) };
        (0..CHORDS).map(chord)
    })
}

/// The chords of an ellipse, or of a part of it: its middle, the end of a half axis from there, how long the other is
/// beside that; where it begins and how far it goes, in radians.
fn around(
    (center, major, ratio): (Point, Point, f64),
    (start, sweep): (f64, f64),
) -> impl Iterator<Item = Curve> {
    let at = move |i: u32| {
        let t = start + sweep * f64::from(i) / f64::from(CHORDS_AROUND);
        let (c, s) = (cos(t), ratio * sin(t));
        [center.x + c * major.x - s * major.y, center.y + c * major.y + s * major.x]
    };
    let chord = move |i| Curve { is_chord: true, ..Curve::segment(at(i), at(i + 1)) };
    (0..CHORDS_AROUND).map(chord)
}
