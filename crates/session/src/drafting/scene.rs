//! What can be picked: the figures that the home of a drawing knows, each by what it is called there.

use super::Home;
use crate::state::State;
use base::number::{atan2, hypot};
use eval::{Answer, Context, Evaluator};
use geometry::Figure;
use kernel::{ClassId, DOCUMENT, Path};

/// A figure with its name.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// How it is written in the home.
    pub(crate) text: String,
    /// Its class.
    pub(crate) class: ClassId,
    /// Where it lies.
    pub(crate) curve: Curve,
}

/// Where a figure lies.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Curve {
    figure: Figure<f64>,
    /// From where to where an arc runs, to the left.
    arc: Option<[[f64; 2]; 2]>,
    /// Whether a straight goes on beyond its points.
    is_endless: bool,
}

/// The names of the points that figures have.
const PLACES: [&str; 5] = ["p1", "p2", "center", "start", "end"];

impl Curve {
    /// Returns where an answer lies; nothing where it is no figure.
    pub(crate) fn of<'a>(
        evaluator: &Evaluator<'a>,
        state: &'a State,
        answer: &Answer<'a>,
    ) -> Option<Self> {
        let document = &state.lowered.document;
        let class = evaluator.class_of(answer)?;
        document.figure(class)?;
        let figure = evaluator.figure_of(answer).ok()?;
        let is_of =
            |name: &str| document.class_named(name).is_some_and(|c| document.is_a(class, c));
        let ends = is_of("Arc")
            .then(|| Some([place(evaluator, answer, "start")?, place(evaluator, answer, "end")?]));
        let arc = ends.flatten().map(|[a, b]| if is_of("ClockwiseArc") { [b, a] } else { [a, b] });
        Some(Self { figure, arc, is_endless: !is_of("Line") })
    }

    /// Whether it is a point.
    pub(crate) fn is_point(&self) -> bool {
        matches!(self.figure, Figure::Point(_))
    }

    /// How far a place is from it.
    pub(crate) fn distance(&self, at: (f64, f64)) -> f64 {
        let away = |[x, y]: [f64; 2]| hypot(at.0 - x, at.1 - y);
        match self.figure {
            Figure::Point(p) => away(p),
            Figure::Straight { from, to } => {
                let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
                let along = ((at.0 - from[0]) * dx + (at.1 - from[1]) * dy) / (dx * dx + dy * dy);
                let along = match (along.is_finite(), self.is_endless) {
                    (false, _) => 0.0,
                    (true, true) => along,
                    (true, false) => along.clamp(0.0, 1.0),
                };
                away([from[0] + along * dx, from[1] + along * dy])
            }
            Figure::Circle { center, radius } => match self.arc {
                Some([a, b]) if !is_between(center, a, b, at) => away(a).min(away(b)),
                _ => (away(center) - radius.abs()).abs(),
            },
            Figure::Arc { start, end, .. } => away(start).min(away(end)),
        }
    }

    /// What it is, in words and numbers.
    pub(crate) fn words(&self) -> String {
        let number = |x: f64| base::number::rounded(x, 4);
        let place = |[x, y]: [f64; 2]| format!("({}, {})", number(x), number(y));
        match self.figure {
            Figure::Point(p) => place(p),
            Figure::Straight { from, to } => format!("{} to {}", place(from), place(to)),
            Figure::Circle { center, radius } => {
                format!("centre {}, radius {}", place(center), number(radius))
            }
            Figure::Arc { start, end, .. } => format!("{} to {}", place(start), place(end)),
        }
    }
}

/// Whether a direction from a centre lies between two others, going left from the first.
fn is_between(center: [f64; 2], a: [f64; 2], b: [f64; 2], at: (f64, f64)) -> bool {
    let turn = |x: f64, y: f64| atan2(y - center[1], x - center[0]);
    let from = turn(a[0], a[1]);
    let left = |angle: f64| (angle - from).rem_euclid(std::f64::consts::TAU);
    left(turn(at.0, at.1)) <= left(turn(b[0], b[1]))
}

fn place<'a>(evaluator: &Evaluator<'a>, of: &Answer<'a>, name: &str) -> Option<[f64; 2]> {
    match evaluator.figure_of(&evaluator.of_part(of, name).ok()?).ok()? {
        Figure::Point(at) => Some(at),
        _ => None,
    }
}

/// Returns the figures that can be picked.
pub(crate) fn scene(state: &State, home: &Home) -> Vec<Found> {
    let evaluator = state.evaluator(&state.values);
    let mut all = Scene { state, evaluator: &evaluator, found: Vec::new() };
    match home {
        Home::Document => all.document(),
        Home::Program { example, block, .. } => {
            if let Ok(example) = state.structure.follow(DOCUMENT, &Path::of(&[example]))
                && let Ok(Some(run)) = evaluator.run(example)
            {
                all.context("", &run);
                // of the turn that is drawn its steps are called by their own names
                if let Some(block) = block {
                    let inside = format!("{block}[0]");
                    all.found.retain(|found| !found.text.starts_with(&inside));
                    if let Ok(Answer::Context(turn)) = evaluator.at(&home.path()) {
                        all.context("", &turn);
                    }
                }
            }
        }
    }
    all.found
}

struct Scene<'e, 'a> {
    state: &'a State,
    evaluator: &'e Evaluator<'a>,
    found: Vec<Found>,
}

impl<'a> Scene<'_, 'a> {
    fn document(&mut self) {
        let (document, structure) = (&self.state.lowered.document, &self.state.structure);
        for (thing, t) in structure.things.iter() {
            if thing == DOCUMENT || structure.merged[thing] != thing {
                continue;
            }
            let path = structure.path(document, thing).to_string();
            if document.figure(t.class).is_some() {
                self.add(&path, &Answer::Thing(thing), false);
            } else if document.program(t.class).is_some()
                && let Ok(Some(run)) = self.evaluator.run(thing)
            {
                self.context(&format!("{path}."), &run);
            }
        }
        let root = &document.classes[structure.things[DOCUMENT].class];
        for message in &root.messages {
            if message.parameters.is_empty()
                && !message.is_of_class()
                && let Ok(answer) = self.evaluator.ask(DOCUMENT, &message.name)
            {
                self.add(&message.name, &answer, true);
            }
        }
    }

    fn context(&mut self, prefix: &str, context: &Context<'a>) {
        for entry in &context.made {
            if !entry.name.is_empty() {
                self.add(&format!("{prefix}{}", entry.name), &entry.answer, true);
            }
        }
    }

    /// Adds what an answer is, or what is in it, and its places where these are no things of their own.
    fn add(&mut self, text: &str, answer: &Answer<'a>, with_places: bool) {
        match answer {
            Answer::Context(inner) => return self.context(&format!("{text}."), inner),
            Answer::List(items) => {
                for (i, item) in items.iter().enumerate() {
                    self.add(&format!("{text}[{i}]"), item, true);
                }
                return;
            }
            _ => {}
        }
        let Some(class) = self.evaluator.class_of(answer) else { return };
        let Some(curve) = Curve::of(self.evaluator, self.state, answer) else { return };
        self.found.push(Found { text: text.into(), class, curve });
        if !with_places || matches!(curve.figure, Figure::Point(_)) {
            return;
        }
        for name in PLACES {
            if let Ok(part) = self.evaluator.of_part(answer, name)
                && let (Some(class), Some(curve)) =
                    (self.evaluator.class_of(&part), Curve::of(self.evaluator, self.state, &part))
            {
                self.found.push(Found { text: format!("{text}.{name}"), class, curve });
            }
        }
    }
}
