//! What is drawn through places, as a spline is: it is picked by its curve, and at each of its places.

use super::{Curve, Found, Scene};
use crate::drafting::compound;
use drawing::{Point, Shape, spline};
use eval::Answer;
use kernel::ClassId;
use std::borrow::Cow;

/// A curve between two places is picked as so many chords.
const CHORDS: u32 = 16;

impl<'a> Scene<'a> {
    /// Adds the chords of what is drawn through places, each as the whole, and the places.
    pub(super) fn through_places(
        &mut self,
        (text, wholes): (&str, &[String]),
        (class, of): (ClassId, &Answer<'a>),
    ) {
        let document = &self.state.lowered.document;
        if !compound::is_of_places(document, class) {
            return;
        }
        for element in self.evaluator.elements(of) {
            let cubics = match &element.shape {
                Shape::Spline(poles) => Cow::Borrowed(poles.as_slice()),
                Shape::Nurbs(curve) => Cow::Owned(curve.cubics()),
                _ => continue,
            };
            for curve in chords(&cubics) {
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
        let Some(part) = document.layout(class).first().map(|field| document.field_name(*field))
        else {
            return;
        };
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
