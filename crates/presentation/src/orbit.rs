//! A grip led round in a circle: how the gallery's pictures move and how the bench drags.

use crate::sheet;
use drawing::Drawing;
use session::view::{Freedom, Grip, PictureView};
use std::f64::consts::TAU;

/// Returns the grip to lead: the first that is not fixed, or else the first that no anchor holds.
pub fn grip(picture: &PictureView) -> Option<Grip> {
    let is_fixed = |grip: &&Grip| {
        let tag = picture.paths.iter().position(|path| *path == grip.path);
        tag.is_some_and(|tag| picture.freedom.get(tag) == Some(&Some(Freedom::Fixed)))
    };
    let loose = || picture.grips.iter().filter(|grip| !grip.anchored && !grip.drawn);
    loose().find(|grip| !is_fixed(grip)).or_else(|| loose().next()).cloned()
}

/// Returns where the grip is after so many turns of a circle that begins where it lies.
pub fn place(grip: &Grip, radius: f64, turn: f64) -> (f64, f64) {
    let angle = TAU * turn;
    let (cos, sin) = (base::number::cos(angle), base::number::sin(angle));
    (grip.x + radius * (cos - 1.0), grip.y + radius * sin)
}

/// Returns how wide or high a drawing is, whichever is more; 1 for a single point.
pub fn width(drawing: &Drawing) -> f64 {
    let bounds = sheet::bounds(drawing);
    let across = (bounds.most.x - bounds.least.x).max(bounds.most.y - bounds.least.y);
    if across > 0.0 { across } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::{grip, place};
    use session::view::{Freedom, Grip, PictureView};

    #[test]
    fn what_is_led_can_move() {
        let at =
            |path: &str, anchored| Grip { path: String::from(path), anchored, ..Grip::default() };
        let picture = PictureView {
            paths: ["a", "b", "c"].map(String::from).to_vec(),
            freedom: vec![Some(Freedom::Free), Some(Freedom::Fixed), Some(Freedom::Free)],
            grips: vec![at("a", true), at("b", false), at("c", false)],
            ..PictureView::default()
        };
        assert_eq!(grip(&picture).map(|grip| grip.path).as_deref(), Some("c"));
        assert_eq!(grip(&PictureView::default()), None);
    }

    #[test]
    fn a_turn_begins_and_ends_at_home() {
        let grip = Grip { path: String::from("p"), x: 3.0, y: 4.0, ..Grip::default() };
        assert_eq!(place(&grip, 10.0, 0.0), (3.0, 4.0));
        let (x, y) = place(&grip, 10.0, 0.5);
        assert!((x + 17.0).abs() < 1e-9 && (y - 4.0).abs() < 1e-9);
    }
}
