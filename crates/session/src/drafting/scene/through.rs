//! Curves that are no figures, as splines and ellipses: each is picked by what it draws, and at its places.

use super::{Curve, Found, Scene};
use crate::drafting::compound;
use base::number::{cos, sin};
use drawing::{Point, Shape, spline};
use eval::Answer;
use kernel::ClassId;

/// A curve between two places is picked as so many chords.
const CHORDS: u32 = 16;
/// An ellipse is picked as so many.
const CHORDS_AROUND: u32 = 96;

impl<'a> Scene<'a> {
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
        for element in self.evaluator.elements(of) {
            let chords: Vec<Curve> = match &element.shape {
                Shape::Spline(poles) => chords(poles).collect(),
                Shape::Nurbs(curve) => chords(&curve.cubics()).collect(),
                Shape::Ellipse { center, major, ratio, start, sweep } => {
                    around((*center, *major, *ratio), (*start, *sweep)).collect()
                }
                _ => continue,
            };
            for curve in chords {
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
