//! Annotations as parts of a drawing, which is exported or printed.
//!
//! In: notes where they stand. Out: elements on the sheet. No paper lies under words there, so that their own lines are
//! broken where they stand.

use super::{HEIGHT, Moved, Note, Pixels, half, notes};
use crate::sheet::View;
use drawing::dxf::DxfOptions;
use drawing::{Anchoring, Color, Element, Layer, Placement, Shape, Style, Tag};
use session::view::{Annotation, PictureView};

/// The layer of the sheet that annotations are on.
const LAYER: &str = "DIMENSIONS";
/// How wide their lines are, in pixels.
const WIDTH: f64 = 0.75;
/// A tag of no thing.
const NOBODY: Tag = Tag(u32::MAX);

/// Returns how far notes have been moved where a unit of the sheet has so many times as many pixels.
pub fn scaled(moved: &Moved, times: f64) -> Moved {
    let far = |(key, (x, y)): (&String, &Pixels)| (key.clone(), (times * x, times * y));
    moved.iter().map(far).collect()
}

/// Adds to a picture what is said on it, where a unit of the sheet has so many pixels.
pub fn draw(picture: &mut PictureView, said: &[Annotation], moved: &Moved, pixels: f64) {
    let view = View { scale: pixels, vertical: picture.drawing.vertical, ..View::default() };
    let notes = notes(said, picture, &view, moved);
    picture.drawing.elements.extend(elements(&notes, &view));
}

/// Adds what is said on a picture that is written as DXF, where words are as high as they are written there: `draw` adds
/// it where a unit has so many pixels. What is said may make the drawing larger, and its words with it.
pub fn draw_for_dxf(picture: &mut PictureView, draw: impl Fn(&mut PictureView, f64)) {
    let millimetres = picture.millimetres.unwrap_or(1.0);
    let pixels = |picture: &PictureView| {
        HEIGHT * millimetres / DxfOptions::of(&picture.drawing, millimetres).text_height
    };
    let mut noted = picture.clone();
    draw(&mut noted, pixels(picture));
    draw(picture, pixels(&noted));
}

/// Returns notes as elements of the sheet; what does not hold is as conspicuous there.
pub fn elements(notes: &[Note], view: &View) -> Vec<Element> {
    let sheet = |at: &Pixels| view.sheet_from_screen(*at);
    let mut all = Vec::new();
    for note in notes {
        let color = if note.holds { Color::Ink } else { Color::Accent };
        let style =
            Style { color, width: WIDTH, sheet_layer: Some(LAYER.into()), ..Style::default() };
        let element = |shape, layer| Element { shape, style: style.clone(), layer, tag: NOBODY };
        let whole = note.lines.iter().flat_map(|line| line.windows(2).map(|two| (two[0], two[1])));
        let pieces = whole.flat_map(|way| outside(way, note));
        all.extend(
            pieces.map(|(a, b)| element(Shape::Segment(sheet(&a), sheet(&b)), Layer::Lines)),
        );
        let text = Shape::Text {
            at: sheet(&note.at),
            text: note.words.clone(),
            anchoring: Anchoring::Center,
            placement: Placement::OnScreen(HEIGHT),
            turn: 0.0,
        };
        all.push(element(text, Layer::Words));
    }
    all
}

/// The pieces of a way that are not under the words of a note.
fn outside((a, b): (Pixels, Pixels), note: &Note) -> Vec<(Pixels, Pixels)> {
    let (wide, high) = half(&note.words);
    let (mut enters, mut leaves) = (0.0_f64, 1.0_f64);
    for (from, to, middle, half) in [(a.0, b.0, note.at.0, wide), (a.1, b.1, note.at.1, high)] {
        let (least, most, by) = (middle - half - from, middle + half - from, to - from);
        if by == 0.0 {
            if least > 0.0 || most < 0.0 {
                return vec![(a, b)];
            }
            continue;
        }
        enters = enters.max((least / by).min(most / by));
        leaves = leaves.min((least / by).max(most / by));
    }
    if enters >= leaves {
        return vec![(a, b)];
    }
    let on = |t: f64| (a.0 + t * (b.0 - a.0), a.1 + t * (b.1 - a.1));
    let before = (enters > 0.0).then(|| (a, on(enters)));
    let after = (leaves < 1.0).then(|| (on(leaves), b));
    before.into_iter().chain(after).collect()
}

#[cfg(test)]
mod tests {
    use super::{elements, outside};
    use crate::annotations::Note;
    use crate::sheet::View;
    use drawing::{Point, Shape};

    fn note() -> Note {
        Note {
            path: "c1".into(),
            words: "30 mm".into(),
            holds: true,
            at: (100.0, 50.0),
            lines: vec![vec![(0.0, 50.0), (200.0, 50.0)], vec![(0.0, 0.0), (0.0, 60.0)]],
            key: String::new(),
            axis: (1.0, 0.0),
        }
    }

    #[test]
    fn a_line_is_broken_where_its_words_stand() {
        let note = note();
        let [(a, b), (c, d)] = outside(((0.0, 50.0), (200.0, 50.0)), &note)[..] else {
            panic!("it is in two")
        };
        assert_eq!((a, d), ((0.0, 50.0), (200.0, 50.0)));
        assert!(b.0 > 60.0 && (b.0 + c.0 - 200.0).abs() < 1e-9 && c.0 - b.0 > 30.0, "{b:?} {c:?}");
        let beside = ((0.0, 70.0), (200.0, 70.0));
        assert_eq!(outside(beside, &note), [beside]);
        assert_eq!(outside(((99.0, 50.0), (101.0, 50.0)), &note), []);
        let slanted = outside(((100.0, 0.0), (100.0, 50.0)), &note);
        assert_eq!(slanted, [((100.0, 0.0), (100.0, 40.0))]);
    }

    #[test]
    fn annotations_are_exported_where_they_stand_on_the_sheet() {
        let view = View { scale: 2.0, ..View::default() };
        let all = elements(&[note()], &view);
        let shapes: Vec<&Shape> = all.iter().map(|element| &element.shape).collect();
        let [
            Shape::Segment(a, _),
            Shape::Segment(..),
            Shape::Segment(p, q),
            Shape::Text { at, text, .. },
        ] = shapes[..]
        else {
            panic!("{shapes:?}")
        };
        assert_eq!((*a, *at), (Point { x: 0.0, y: -25.0 }, Point { x: 50.0, y: -25.0 }));
        assert_eq!((*p, *q), (Point { x: 0.0, y: 0.0 }, Point { x: 0.0, y: -30.0 }));
        assert_eq!(text, "30 mm");
    }
}
