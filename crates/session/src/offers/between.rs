//! The angle between two straight things: the one that a person sees between their sides, and its supplement.
//!
//! In: the offerer with two things that have ends. Out: offers of a number that is not negative. A side runs from the
//! corner: away from the end that both share, else to the end that is further from where they cross. A thing that runs
//! to the corner is turned round in what is said: `(-a).angle(to: b)`.

use super::{Offerer, REVERSED, Selected, in_degrees};
use crate::document::Open;
use crate::view::{Offer, Refusal};
use crate::words;
use base::Name;
use base::number::{close, hypot};
use kernel::{Argument, Literal, Path, Step, Term};
use std::f64::consts::{PI, TAU};

type Place = (f64, f64);

/// A straight thing, and whether it is turned round.
type Side<'s> = (&'s Selected, bool);

impl Offerer<'_> {
    /// The angle that one sees between two things and its supplement; the angle alone where one stands already, or
    /// where the things have no ends.
    pub(super) fn angles(&self) -> Vec<Offer> {
        let [a, b] = self.things else { return Vec::new() };
        if self.message(a.class, "angle").is_none_or(|m| m.parameters.len() != 1) {
            return Vec::new();
        }
        let (Some(first), Some(second)) = (self.straight(a), self.straight(b)) else {
            return self.angle("angle", ((a, false), (b, false))).into_iter().collect();
        };
        let all = [false, true].map(|x| [false, true].map(|y| ((a, x), (b, y)))).concat();
        let all = all.into_iter().flat_map(|(one, other)| [(one, other), (other, one)]);
        let mut offers = all.filter_map(|sides| self.angle("angle", sides));
        if let Some(stands) = offers.find(|offer| offer.stands) {
            return vec![stands];
        }
        let (x, y) = turned(first, second);
        let seen = self.not_negative("angle", ((a, x), (b, y)));
        let supplement = self.not_negative("supplement", ((a, !x), (b, y)));
        seen.into_iter().chain(supplement).collect()
    }

    /// The ends of a thing that runs straight.
    fn straight(&self, one: &Selected) -> Option<(Place, Place)> {
        let document = &self.state.lowered.document;
        let class = document.class_named("Straight")?;
        let end = |name: &str| {
            let part = |axis: &str| {
                let path = one.path.then(Step::Part(Name::new(name)));
                let path = path.then(Step::Part(Name::new(axis)));
                Some(self.number(&Term::at(Term::Document, &path))?.0)
            };
            Some((part("x")?, part("y")?))
        };
        let ends = || Some((end("p1")?, end("p2")?));
        document.is_a(one.class, class).then(ends)?
    }

    /// The offer of the angle from one side to another, or the other way round where that is negative.
    fn not_negative(&self, label: &str, (one, other): (Side<'_>, Side<'_>)) -> Option<Offer> {
        let is_negative = self.turn((one, other))? < 0.0;
        self.angle(label, if is_negative { (other, one) } else { (one, other) })
    }

    /// The offer of the angle from one side to another.
    fn angle(&self, label: &str, sides: (Side<'_>, Side<'_>)) -> Option<Offer> {
        let radians = self.turn(sides)?;
        let ((one, is_turned), (other, is_other_turned)) = sides;
        let one = if is_turned { format!("(-{})", one.path) } else { one.path.to_string() };
        let other =
            if is_other_turned { format!("-{}", other.path) } else { other.path.to_string() };
        let left = format!("{one}.angle(to: {other})");
        Some(self.dimension(label, &[left], in_degrees(radians)))
    }

    /// How far one side turns to the other.
    fn turn(
        &self,
        ((one, is_turned), (other, is_other_turned)): (Side<'_>, Side<'_>),
    ) -> Option<f64> {
        let side = |path: &Path, is_turned: bool| {
            let it = Term::at(Term::Document, path);
            if is_turned { Term::send(it, REVERSED) } else { it }
        };
        let argument =
            Argument { label: Some(Name::new("to")), value: side(&other.path, is_other_turned) };
        let asked = Term::Send {
            to: Box::new(side(&one.path, is_turned)),
            name: Name::new("angle"),
            arguments: vec![argument],
            search: None,
        };
        self.number(&asked).map(|(radians, _)| radians)
    }
}

/// Refuses an angle that is told as no angle is: none would ever hold.
pub(crate) fn beyond(open: &Open, offer: &Offer, value: &str) -> Option<Refusal> {
    let label = offer.label.as_str();
    if !["angle", "supplement", "direction"].contains(&label) {
        return None;
    }
    let read = lang::read_literal(value, lang::Wanted::Anything, &open.state.lowered.document);
    let Ok(Literal::Number(radians)) = read else { return None };
    let is_beyond = radians <= -PI || radians > PI;
    is_beyond.then(|| {
        let left = in_degrees(radians - TAU * ((radians - PI) / TAU).ceil());
        words::refuse(format!("the {label} is at most 180 deg: {value} is {left}"))
    })
}

/// Whether each of two straight things is turned round, so that both run from the corner that one sees.
fn turned(first: (Place, Place), second: (Place, Place)) -> (bool, bool) {
    let ((a, b), (c, d)) = (first, second);
    let is_one = |p: Place, q: Place| close(p.0, q.0) && close(p.1, q.1);
    let shared = [
        (a, c, (false, false)),
        (a, d, (false, true)),
        (b, c, (true, false)),
        (b, d, (true, true)),
    ];
    if let Some((.., turned)) = shared.into_iter().find(|(p, q, _)| is_one(*p, *q)) {
        return turned;
    }
    let (u, v) = ((b.0 - a.0, b.1 - a.1), (d.0 - c.0, d.1 - c.1));
    let cross = u.0 * v.1 - u.1 * v.0;
    if close(u.0 * v.1, u.1 * v.0) {
        // what runs alongside has no corner
        return (false, u.0 * v.0 + u.1 * v.1 < 0.0);
    }
    let far = ((c.0 - a.0) * v.1 - (c.1 - a.1) * v.0) / cross;
    let corner = (a.0 + far * u.0, a.1 + far * u.1);
    let reach = |p: Place| hypot(p.0 - corner.0, p.1 - corner.1);
    (reach(a) > reach(b), reach(c) > reach(d))
}

#[cfg(test)]
mod tests {
    use super::turned;

    #[test]
    fn sides_run_from_the_corner_that_one_sees() {
        let level = ((0.0, 0.0), (100.0, 0.0));
        // end to start, start to start, end to end
        assert_eq!(turned(level, ((100.0, 0.0), (60.0, 80.0))), (true, false));
        assert_eq!(turned(level, ((0.0, 0.0), (60.0, 80.0))), (false, false));
        assert_eq!(turned(level, ((60.0, 80.0), (100.0, 0.0))), (true, true));
        // crossing at (20, 0): the longer part of each
        assert_eq!(turned(level, ((20.0, 60.0), (20.0, -10.0))), (false, true));
        // side by side, and one the other way
        assert_eq!(turned(level, ((0.0, 10.0), (50.0, 10.0))), (false, false));
        assert_eq!(turned(level, ((50.0, 10.0), (0.0, 10.0))), (false, true));
    }
}
