//! What a constraint says, as it is painted.

use super::{DisplayList, Hue, Mark, Space, begin, shape};
use drawing::{Anchoring, Line, Placement, Point, Shape};

/// Adds an annotation: its lines, and its words on a frame of paper.
pub(crate) fn note(
    list: &mut DisplayList,
    (lines, frame): (&[Vec<Point>], &[Point; 4]),
    (at, words): (Point, &str),
    (mark, holds): (Mark, bool),
) {
    let hue = match (holds, mark) {
        (false, _) => Hue::Conflict,
        (true, Mark::None | Mark::Outside) => Hue::Faint,
        (true, Mark::Hovered | Mark::Selected) => Hue::Accent,
    };
    let polyline = |points: &[Point], closed| Shape::Polyline { points: points.to_vec(), closed };
    begin(list, hue as i32, -1, Line::Solid, 1.0, Space::Sheet);
    lines.iter().for_each(|line| shape(list, &polyline(line, false)));
    // what is chosen has a frame, so that it is told by more than its colour; only its own lines lie behind words
    let rim = if mark == Mark::Selected { hue as i32 } else { -1 };
    let paper = if lines.is_empty() { -1 } else { Hue::Paper as i32 };
    begin(list, rim, paper, Line::Solid, 1.0, Space::Sheet);
    shape(list, &polyline(frame, true));
    let text = Shape::Text {
        at,
        text: String::from(words),
        anchoring: Anchoring::Center,
        placement: Placement::OnScreen(crate::annotations::HEIGHT),
        turn: 0.0,
    };
    begin(list, hue as i32, -1, Line::None, 1.0, Space::Screen);
    shape(list, &text);
}
