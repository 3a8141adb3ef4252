//! What is between two things: how far apart they are, and the angle between straight ones, as a person sees it between
//! their sides, with its supplement; and what a dimension measures that only reads it.
//!
//! In: the offerer with two things that have ends. Out: offers of a number that is not negative. A side runs from the
//! corner: away from the end that both share, else to the end that is further from where they cross. A thing that runs
//! to the corner is turned round in what is said: `(-a).angle(to: b)`.

use super::{Offerer, REVERSED, Selected, in_degrees};
use crate::document::Open;
use crate::turning;
use crate::view::{Deed, Offer, Refusal};
use crate::words;
use base::Name;
use base::number::{close, hypot};
use kernel::{Argument, Literal, Path, Step, Term};
use std::f64::consts::{PI, TAU};

type Place = (f64, f64);

/// A straight thing, and whether it is turned round.
type Side<'s> = (&'s Selected, bool);

/// Has a distance of two lines keep them parallel, where nothing does yet: said of one end alone it would turn them.
pub(crate) fn keep_alongside(offers: &mut [Offer]) {
    let is_parallel = |offer: &&Offer| offer.label == "parallel" && offer.value.is_none();
    let Some(parallel) = offers.iter().find(is_parallel).map(|offer| offer.members.clone()) else {
        return;
    };
    let is_new = |offer: &&mut Offer| offer.label == "distance" && !offer.stands;
    if let Some(distance) = offers.iter_mut().find(is_new) {
        distance.members = format!("{parallel}\n{}", distance.members);
    }
}

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

    /// What is asked how far it is from what, of two things, and how that is said: two places, of round things their
    /// centres; a line and a place; a line and the start of one that runs alongside.
    pub(super) fn apart(&self, a: &Selected, b: &Selected) -> Option<(Path, Path, Vec<String>)> {
        let place = |one: &Selected| {
            let center = || one.path.then(Step::Part(Name::new("center")));
            let is_round = || self.is_a(one.class, "Round");
            self.is_place(one.class).then(|| one.path.clone()).or_else(|| is_round().then(center))
        };
        let said = |line: &Selected, place: &Path| format!("{}.distance(to: {place})", line.path);
        let aside = |line: &Selected, place: Path| {
            let lefts = vec![said(line, &place)];
            self.is_a(line.class, "Straight").then(|| (line.path.clone(), place, lefts))
        };
        match (place(a), place(b)) {
            (Some(one), Some(other)) => {
                let lefts = super::distances(&one, &other).to_vec();
                Some((one, other, lefts))
            }
            (Some(one), None) => aside(b, one),
            (None, Some(other)) => aside(a, other),
            (None, None) => {
                let (first, second) = (self.straight(a)?, self.straight(b)?);
                let end = |one: &Selected, name: &str| one.path.then(Step::Part(Name::new(name)));
                let (line, start, _) =
                    runs_alongside(first, second).then(|| aside(a, end(b, "p1"))).flatten()?;
                // it may be said of the other, or to the other end
                let ways = [(a, b), (b, a)].into_iter();
                let lefts = ways.flat_map(|(a, b)| ["p1", "p2"].map(|name| said(a, &end(b, name))));
                Some((line, start, lefts.collect()))
            }
        }
    }

    /// The dimension that one which only reads becomes when it is to rule, where it measures what is stored.
    pub(super) fn ruling(&self) -> Option<Offer> {
        let [one] = self.things else { return None };
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        let own = one.thing?;
        let measured = |name: &str| {
            let part = structure.part_named(own, &Name::new(name))?;
            let under = |thing: &kernel::ThingId| *thing != part;
            let other = structure.merged_with(part).into_iter().find(under)?;
            Some(structure.path(document, other))
        };
        let read = |name: &str| {
            self.number(&Term::at(Term::Document, &one.path.then(Step::Part(Name::new(name)))))
        };
        let (label, left) = if self.is_a(one.class, "ReferenceDistance") {
            let [left, _] = super::distances(&measured("from")?, &measured("to")?);
            ("ruling distance", left)
        } else if self.is_a(one.class, "ReferenceRadius") {
            ("ruling radius", format!("{}.radius", measured("circle")?))
        } else if self.is_a(one.class, "ReferenceAngle") {
            let (from, to) = (measured("from")?, measured("to")?);
            ("ruling angle", format!("{from}.angle(to: {to})"))
        } else {
            return None;
        };
        let now = read("reading")?;
        let value = match now.1 == expr::Dimension::NONE {
            true => in_degrees(now.0),
            false => self.written(now),
        };
        let deed = Deed::Rule(one.path.clone());
        Some(Offer { deed, ..self.dimension(label, &[left], value) })
    }

    /// Whether a class is one of a name, or below it.
    fn is_a(&self, class: kernel::ClassId, name: &str) -> bool {
        let document = &self.state.lowered.document;
        document.class_named(name).is_some_and(|of| document.is_a(class, of))
    }

    /// The ends of a thing that runs straight.
    fn straight(&self, one: &Selected) -> Option<(Place, Place)> {
        let end = |name: &str| {
            let part = |axis: &str| {
                let path = one.path.then(Step::Part(Name::new(name)));
                let path = path.then(Step::Part(Name::new(axis)));
                Some(self.number(&Term::at(Term::Document, &path))?.0)
            };
            Some((part("x")?, part("y")?))
        };
        let ends = || Some((end("p1")?, end("p2")?));
        self.is_a(one.class, "Straight").then(ends)?
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
    if !turning::is_angle(label) {
        return None;
    }
    let document = &open.state.lowered.document;
    // what is no angle is told to be none
    let wanted = lang::Wanted::Class(document.class_named("Angle")?);
    let Ok(Literal::Number(radians)) = lang::read_literal(value, wanted, document) else {
        return None;
    };
    let is_beyond = radians <= -PI || radians > PI;
    is_beyond.then(|| {
        let left = in_degrees(radians - TAU * ((radians - PI) / TAU).ceil());
        words::refuse(format!("the {label} is at most 180 deg: {value} is {left}"))
    })
}

/// Whether two straight things run the same way, or the opposite one.
fn runs_alongside((a, b): (Place, Place), (c, d): (Place, Place)) -> bool {
    close((b.0 - a.0) * (d.1 - c.1), (b.1 - a.1) * (d.0 - c.0))
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
    if runs_alongside(first, second) {
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
