//! Measures that a calculator takes of what is drawn, by pointing: each is an expression over what was picked.

use super::Home;
use super::scene::{self, Curve, Found};
use super::view::MeasureKind;
use crate::state::State;
use crate::view::{Pointer, Refusal};
use crate::words;

/// A measure that waits for what it is of.
#[derive(Clone, Debug)]
pub(crate) struct Measuring {
    pub(crate) kind: MeasureKind,
    /// What was picked so far.
    picked: Vec<Found>,
    /// What the first of these is.
    first: Option<Sort>,
}

/// What a figure is, for a measure.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Sort {
    Point,
    Straight,
    Round,
    /// What has edges, a contour, a surface, a region; or a curve by places or poles.
    Outlined,
}

fn sort(state: &State, found: &Found) -> Option<Sort> {
    let is_of = |name: &str| is_a(state, found, name);
    match () {
        () if is_of("Point") => Some(Sort::Point),
        () if is_of("Straight") => Some(Sort::Straight),
        () if is_of("Circle") || is_of("Arc") => Some(Sort::Round),
        () if is_of("Outlined") || is_of("Freeform") => Some(Sort::Outlined),
        () => None,
    }
}

fn is_a(state: &State, found: &Found, name: &str) -> bool {
    let document = &state.lowered.document;
    document.class_named(name).is_some_and(|class| document.is_a(found.class, class))
}

/// The radius of what is round, as a size.
fn radius(found: &Found) -> String {
    match found.curve.runs_right() {
        true => format!("abs({}.radius)", found.text),
        false => format!("{}.radius", found.text),
    }
}

/// Returns the measure that a figure has without being asked for a certain one: a circle's radius, a line's length.
pub(crate) fn usual(state: &State, found: &Found) -> Option<String> {
    match sort(state, found)? {
        Sort::Round => Some(radius(found)),
        Sort::Straight if is_a(state, found, "Line") => Some(format!("{}.length", found.text)),
        Sort::Straight | Sort::Point | Sort::Outlined => None,
    }
}

impl Measuring {
    pub(crate) fn new(kind: MeasureKind) -> Self {
        Self { kind, picked: Vec::new(), first: None }
    }

    /// What is wanted next, in words.
    pub(crate) fn words(&self) -> &'static str {
        match (self.kind, self.picked.len()) {
            (MeasureKind::Radius, _) => "radius: pick a circle or an arc",
            (MeasureKind::Length, _) => "length: pick a line, an arc or another curve",
            (MeasureKind::Across | MeasureKind::Up, _) => "coordinate: pick a point",
            (MeasureKind::Area, _) => "area: pick a circle, or a surface",
            (MeasureKind::Distance, 0) => "distance: pick a point, a line, a circle or a contour",
            (MeasureKind::Distance, _) => match self.first {
                Some(Sort::Outlined) => "distance: pick the point that is so far from it",
                Some(Sort::Straight | Sort::Round) => "distance: pick a point, a line or a circle",
                Some(Sort::Point) | None => "distance: pick the other",
            },
            (MeasureKind::Angle, 0) => "angle: pick a line",
            (MeasureKind::Angle, _) => "angle: pick the line that it goes to",
        }
    }

    fn takes(&self, state: &State, found: &Found) -> bool {
        let sort = sort(state, found);
        match self.kind {
            MeasureKind::Radius => sort == Some(Sort::Round),
            // whatever answers how long it is
            MeasureKind::Length => {
                is_a(state, found, "Circle")
                    || state.lowered.document.find_message(found.class, "length", None).is_some()
            }
            MeasureKind::Across | MeasureKind::Up => sort == Some(Sort::Point),
            MeasureKind::Area => {
                is_a(state, found, "Circle")
                    || is_a(state, found, "Surface")
                    || is_a(state, found, "Contour")
            }
            // how far edges are from what is no point nobody says
            MeasureKind::Distance => match self.first {
                None | Some(Sort::Point) => sort.is_some(),
                Some(Sort::Outlined) => sort == Some(Sort::Point),
                Some(Sort::Straight | Sort::Round) => {
                    sort.is_some_and(|sort| sort != Sort::Outlined)
                }
            },
            MeasureKind::Angle => sort == Some(Sort::Straight),
        }
    }

    /// What lies under a pointer that it can be of.
    ///
    /// # Errors
    /// Nothing does.
    pub(crate) fn find(
        &self,
        state: &State,
        home: &Home,
        pointer: &Pointer,
    ) -> Result<Found, Refusal> {
        let all = scene::scene(state, home);
        let found = scene::nearest(all.iter().filter(|f| self.takes(state, f)), pointer).cloned();
        found.ok_or_else(|| words::refuse(self.words().into()))
    }

    /// Takes one more pick; returns the expression once it is complete.
    pub(crate) fn take(&mut self, state: &State, found: Found) -> Option<String> {
        self.first = self.first.or_else(|| sort(state, &found));
        self.picked.push(found);
        match (self.kind, self.picked.as_slice()) {
            (MeasureKind::Radius, [a, ..]) => Some(radius(a)),
            (MeasureKind::Length, [a, ..]) if is_a(state, a, "Circle") => {
                Some(format!("2 * pi() * {}", radius(a)))
            }
            (MeasureKind::Length, [a, ..]) => Some(format!("{}.length", a.text)),
            (MeasureKind::Across, [a, ..]) => Some(format!("{}.x", a.text)),
            (MeasureKind::Up, [a, ..]) => Some(format!("{}.y", a.text)),
            (MeasureKind::Area, [a, ..]) if is_a(state, a, "Circle") => {
                Some(format!("pi() * {}.radius^2", a.text))
            }
            (MeasureKind::Area, [a, ..]) => Some(format!("{}.area", a.text)),
            (MeasureKind::Angle, [a, b, ..]) => Some(format!("{}.angle(to: {})", a.text, b.text)),
            (MeasureKind::Distance, [a, b, ..]) => distance(state, a, b),
            (_, _) => None,
        }
    }
}

/// Writes how far two figures are from each other where they are nearest; of two unbounded lines how far apart they run.
fn distance(state: &State, a: &Found, b: &Found) -> Option<String> {
    let (one, other) = (sort(state, a)?, sort(state, b)?);
    let is_segment = |found: &Found| is_a(state, found, "Line");
    let is_arc = |found: &Found| is_a(state, found, "Arc");
    let (first, second) = (&a.text, &b.text);
    Some(match (one, other) {
        (Sort::Point, Sort::Point) => format!("{first}.distance(to: {second})"),
        (Sort::Straight | Sort::Round | Sort::Outlined, Sort::Point) => {
            format!("{first}.clearance(to: {second})")
        }
        (Sort::Straight, Sort::Straight) => match (is_segment(a), is_segment(b)) {
            (true, true) => format!("{first}.apart(from: {second})"),
            (false, false) => format!("abs({first}.offset(of: {second}.p1))"),
            (false, true) => {
                let [p, q] = ["p1", "p2"].map(|end| format!("{first}.offset(of: {second}.{end})"));
                format!("max(min({p}, {q}), -max({p}, {q}), 0)")
            }
            (true, false) => return distance(state, b, a),
        },
        (Sort::Straight | Sort::Round, Sort::Round) if is_arc(b) => {
            format!("{first}.arcClearance(to: {second})")
        }
        (Sort::Round, Sort::Round) if is_arc(a) => return distance(state, b, a),
        (Sort::Straight, Sort::Round) => {
            let (center, r) = (format!("{second}.center"), radius(b));
            let nearest = format!("{first}.clearance(to: {center}) - {r}");
            match is_segment(a) {
                // all of it may lie within
                true => {
                    let [p, q] =
                        ["p1", "p2"].map(|end| format!("{center}.distance(to: {first}.{end})"));
                    format!("max({nearest}, {r} - max({p}, {q}), 0)")
                }
                false => format!("max({nearest}, 0)"),
            }
        }
        (Sort::Round, Sort::Round) => {
            let apart = format!("{first}.center.distance(to: {second}.center)");
            let (r, s) = (radius(a), radius(b));
            format!("max({apart} - {r} - {s}, abs({r} - {s}) - {apart}, 0)")
        }
        (Sort::Point | Sort::Round, Sort::Straight)
        | (Sort::Point, Sort::Round | Sort::Outlined) => return distance(state, b, a),
        (Sort::Outlined, Sort::Straight | Sort::Round | Sort::Outlined)
        | (Sort::Straight | Sort::Round, Sort::Outlined) => return None,
    })
}

impl Curve {
    /// Whether it is round and runs to the right around its centre.
    fn runs_right(&self) -> bool {
        self.radius().is_some_and(|radius| radius < 0.0)
    }
}
