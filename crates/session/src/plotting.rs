//! Plots: any number over another, while a value is swept or something is dragged, and loci of places.
//!
//! A sweep ([`Sweeping`]) drags a value through a range. A drag that goes on is sampled at each of its events. [`chart`]
//! makes the picture of a plot.

use crate::apply::{self, Aim};
use crate::document::Open;
use crate::drag;
use crate::host::Beside;
use crate::session::{Session, parse_path};
use crate::state::State;
use crate::view::{DocumentId, PlotEntry, Refusal};
use crate::words;
use base::Diagnostic;
use eval::Answer;
use expr::Dimension;
use kernel::{DOCUMENT, Path, Quantity, Step, Term, Values};
use serde::Serialize;
use std::rc::Rc;

pub mod chart;
mod sweeping;
mod table;

pub use sweeping::Sweeping;

/// A sweep has at most so many steps.
pub const MOST_STEPS: u32 = 10_000;

/// A drag is sampled at most so often; what comes after is not kept.
pub const MOST_SAMPLES: usize = 20_000;

/// What a plot shows, and over what.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Request {
    /// What is shown, as paths or expressions: a number makes a curve, a place its locus on the sheet.
    pub show: Vec<String>,
    /// What the curves are shown over; without it over what is swept, or over the number of the event.
    pub over: Option<String>,
    /// What is swept; without it the drags of the document are followed.
    pub sweep: Option<Sweep>,
}

/// A value that goes through a range.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Sweep {
    /// The path of a number, stored or computed.
    pub of: String,
    /// The value at one end, as a person types it.
    pub from: String,
    /// The value at the other end.
    pub to: String,
    /// How many steps there are from end to end.
    pub steps: u32,
}

/// Curves and loci.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Plot {
    /// What the curves are over.
    pub over: Axis,
    /// One for each number that is shown.
    pub curves: Vec<Curve>,
    /// One for each place that is shown.
    pub loci: Vec<Locus>,
    /// Why it ends before its range does, if so.
    pub notes: Vec<String>,
}

/// What is counted along one direction of a plot.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize)]
pub struct Axis {
    /// The path or the expression.
    pub label: String,
    /// The unit, or nothing.
    pub unit: String,
}

/// A number over another.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Curve {
    /// What it is, and its unit.
    pub axis: Axis,
    /// Both numbers, each in its unit, in the order in which they came; nothing where either has no value.
    pub points: Vec<Option<(f64, f64)>>,
}

/// Where a place went.
#[derive(Clone, PartialEq, Debug, Default, Serialize)]
pub struct Locus {
    /// Its path.
    pub label: String,
    /// On the sheet, in order; nothing where it has no place.
    pub points: Vec<Option<(f64, f64)>>,
}

impl Plot {
    /// Returns true if there is nothing to see.
    pub fn is_empty(&self) -> bool {
        let none = |points: &[Option<(f64, f64)>]| points.iter().all(Option::is_none);
        self.curves.iter().all(|c| none(&c.points)) && self.loci.iter().all(|l| none(&l.points))
    }
    /// Returns the loci as elements of a picture.
    pub fn drawn_loci(&self) -> drawing::Drawing {
        let runs = self.loci.iter().flat_map(|locus| chart::runs(&locus.points));
        let elements = runs.map(|run| {
            let points = run.iter().map(|&(x, y)| drawing::Point { x, y }).collect();
            drawing::Element::new(drawing::Shape::Polyline { points, closed: false })
        });
        drawing::Drawing { elements: elements.collect(), ..drawing::Drawing::default() }
    }
}

/// A value of what is shown at one moment.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Reading {
    Number(f64, Dimension),
    Place(f64, f64),
}

/// What is read at every moment: the first is what the curves are over.
struct Sampler {
    state: Rc<State>,
    terms: Vec<Option<Term>>,
    labels: Vec<String>,
    samples: Vec<Vec<Option<Reading>>>,
}

/// The samples of the drags of a document.
pub(crate) struct Trace {
    request: Request,
    sampler: Sampler,
}

impl Trace {
    /// Begins to watch what a request shows.
    ///
    /// # Errors
    /// An expression that means nothing.
    pub(crate) fn of(open: &Open, request: &Request) -> Result<Self, Refusal> {
        let sampler = Sampler::of(open, (request.over.as_deref(), &request.show))?;
        Ok(Self { request: request.clone(), sampler })
    }
    /// Begins anew, for a drag that was pressed; a document that has changed is read again.
    pub(crate) fn restart(&mut self, open: &Open) -> Result<(), Refusal> {
        if Rc::ptr_eq(&self.sampler.state, &open.state) {
            self.sampler.samples.clear();
        } else {
            *self = Self::of(open, &self.request)?;
        }
        self.sampler.read(open.values());
        Ok(())
    }
    /// Takes the values at an event of the drag.
    pub(crate) fn follow(&mut self, values: &Values) {
        if self.sampler.samples.len() < MOST_SAMPLES {
            self.sampler.read(values);
        }
    }
    /// Returns the plot of the latest drag.
    pub(crate) fn plot(&self) -> Plot {
        self.sampler.plot("event", Vec::new())
    }
}

/// So many steps a view of a class has.
const VIEW_STEPS: u32 = 200;

impl Session {
    /// Makes the plot of a sweep, in a copy of the document.
    ///
    /// # Errors
    /// What is shown or swept means nothing, the range is none, or the value cannot be moved.
    pub fn plot(&self, id: DocumentId, request: &Request) -> Result<Plot, Refusal> {
        if request.sweep.is_none() {
            let trace = self.document(id).trace.as_ref();
            return Ok(trace.map(Trace::plot).unwrap_or_default());
        }
        let mut sweeping = self.begin_sweep(id, request)?;
        while self.go_on(id, &mut sweeping)? {}
        sweeping.finished()
    }

    /// Begins the plot of a sweep, in a copy of the document.
    ///
    /// # Errors
    /// What is shown or swept means nothing, the range is none, or the value cannot be moved.
    pub fn begin_sweep(&self, id: DocumentId, request: &Request) -> Result<Sweeping, Refusal> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        let sweep = request.sweep.clone().unwrap_or_default();
        Sweeping::begin(self.document(id), &beside, request, &sweep)
    }

    /// Goes on with a sweep to its next value; returns false at its end.
    ///
    /// # Errors
    /// The value cannot be moved the other way.
    pub fn go_on(&self, id: DocumentId, sweeping: &mut Sweeping) -> Result<bool, Refusal> {
        sweeping.step(&Beside::of(&*self.host, &self.documents, id))
    }

    /// Returns the views that the class of a thing defines, the nearest class's first.
    pub fn views_of(&self, id: DocumentId, path: &Path) -> Vec<PlotEntry> {
        views_of(&self.document(id).state, path)
    }

    /// From the next press on, every event of a drag is a sample of what a request shows; without one none is.
    ///
    /// # Errors
    /// What is shown means nothing; then what was watched before goes on.
    pub fn watch(&mut self, id: DocumentId, request: Option<&Request>) -> Result<(), Refusal> {
        let open = self.document(id);
        let trace = request.map(|request| Trace::of(open, request)).transpose()?;
        self.document_mut(id).trace = trace;
        Ok(())
    }
}

/// Returns the views that the class of a thing defines, as plots of that thing.
pub(crate) fn views_of(state: &State, path: &Path) -> Vec<PlotEntry> {
    let Some(thing) = crate::session::thing_at(state, path) else { return Vec::new() };
    let document = &state.lowered.document;
    let lineage = document.lineage(state.structure.things[thing].class);
    let views = lineage
        .iter()
        .flat_map(|class| state.lowered.views.iter().filter(move |view| view.class == *class));
    let mut found: Vec<PlotEntry> = Vec::new();
    for view in views {
        // a subclass's view takes the place of one of the same name
        if found.iter().any(|entry| entry.title == view.title) {
            continue;
        }
        let of = |part: &Path| path.join(part).to_string();
        let [from, to] = view.range.clone();
        let sweep = Some(Sweep { of: of(&view.over), from, to, steps: VIEW_STEPS });
        let show = view.show.iter().map(of).collect();
        let request = Request { show, over: None, sweep };
        found.push(PlotEntry { title: view.title.clone(), doc: view.doc.clone(), request });
    }
    found
}

/// Returns the number at a path.
fn number_at(state: &State, path: &Path, values: &Values) -> Result<f64, Refusal> {
    let term =
        match apply::aim(state, path).map_err(|r| words::find(state, path).err().unwrap_or(r))? {
            Aim::Thing(_) => Term::at(Term::Me, path),
            Aim::Term(term) => term,
        };
    match state.evaluator(values).evaluate(&term, DOCUMENT) {
        Ok(Answer::Number(x, _)) => Ok(x),
        Ok(other) => {
            let kind = other.kind();
            Err(words::refuse(format!("{path} is {kind}, and only a number can be swept")))
        }
        Err(fault) => Err(words::refuse(format!("{path}: {}", fault.message))),
    }
}

impl Sampler {
    fn of(open: &Open, (over, show): (Option<&str>, &[String])) -> Result<Self, Refusal> {
        let trimmed = |text: &str| Some(text.trim().to_string()).filter(|t| !t.is_empty());
        let show: Vec<String> = show.iter().filter_map(|text| trimmed(text)).collect();
        if show.is_empty() {
            return Err(words::refuse("nothing is named that could be shown".into()));
        }
        let labels: Vec<Option<String>> =
            std::iter::once(over.and_then(trimmed)).chain(show.into_iter().map(Some)).collect();
        let named: Vec<&str> = labels.iter().flatten().map(String::as_str).collect();
        let mut terms = read(&open.state, &named)?.into_iter();
        let terms: Vec<Option<Term>> =
            labels.iter().map(|label| label.as_ref().and_then(|_| terms.next())).collect();
        let labels = labels.into_iter().map(Option::unwrap_or_default).collect();
        let sampler = Self { state: open.state.clone(), terms, labels, samples: Vec::new() };
        let evaluator = sampler.state.evaluator(open.values());
        for (term, label) in sampler.terms.iter().zip(&sampler.labels) {
            let answer = term.as_ref().and_then(|term| evaluator.evaluate(term, DOCUMENT).ok());
            if let Some(answer) =
                answer.filter(|a| reading(&sampler.state, open.values(), a).is_none())
            {
                let kind = answer.kind();
                let message = format!("{label} is {kind}, and a plot shows numbers and places");
                return Err(words::refuse(message));
            }
        }
        Ok(sampler)
    }

    /// Returns one that has read these.
    fn with_samples(&self, samples: Vec<Vec<Option<Reading>>>) -> Self {
        let (terms, labels) = (self.terms.clone(), self.labels.clone());
        Self { state: self.state.clone(), terms, labels, samples }
    }

    /// Reads everything at one moment.
    fn read(&mut self, values: &Values) {
        let evaluator = self.state.evaluator(values);
        let mut sample = Vec::with_capacity(self.terms.len());
        for term in &self.terms {
            let answer = term.as_ref().and_then(|term| evaluator.evaluate(term, DOCUMENT).ok());
            sample.push(answer.and_then(|answer| reading(&self.state, values, &answer)));
        }
        self.samples.push(sample);
    }

    /// Says what the latest moment is over, in base units.
    fn set_over(&mut self, value: f64) {
        let latest = self.samples.last_mut().and_then(|sample| sample.first_mut());
        if let Some(Some(Reading::Number(over, _))) = latest {
            *over = value;
        }
    }

    /// Makes the plot; `counted` is what samples are called where they are over nothing else.
    fn plot(&self, counted: &str, notes: Vec<String>) -> Plot {
        let numbers = |at: usize| -> Vec<Option<(f64, Dimension)>> {
            let number = |sample: &Vec<Option<Reading>>| match sample.get(at).copied().flatten() {
                Some(Reading::Number(x, dimension)) => Some((x, dimension)),
                Some(Reading::Place(..)) | None => None,
            };
            self.samples.iter().map(number).collect()
        };
        let is_place = |at: usize| {
            let place =
                |s: &Vec<Option<Reading>>| matches!(s.get(at), Some(Some(Reading::Place(..))));
            self.samples.iter().any(place)
        };
        let (over, along) = match self.terms.first() {
            Some(Some(_)) => self.in_unit(0, &numbers(0)),
            _ => {
                let label = counted.to_string();
                let count = (0..self.samples.len()).map(|i| Some(i as f64));
                (Axis { label, unit: String::new() }, count.collect())
            }
        };
        let mut plot = Plot { over, notes, ..Plot::default() };
        for at in 1..self.terms.len() {
            if is_place(at) {
                let place = |sample: &Vec<Option<Reading>>| match sample.get(at).copied().flatten()
                {
                    Some(Reading::Place(x, y)) => Some((x, y)),
                    Some(Reading::Number(..)) | None => None,
                };
                let points = self.samples.iter().map(place).collect();
                plot.loci.push(Locus { label: self.labels[at].clone(), points });
            } else {
                let (axis, values) = self.in_unit(at, &numbers(at));
                let points = along.iter().zip(values).map(|(x, y)| Some(((*x)?, y?))).collect();
                plot.curves.push(Curve { axis, points });
            }
        }
        plot
    }

    /// Returns numbers in the unit in which the largest of them reads well.
    fn in_unit(&self, at: usize, numbers: &[Option<(f64, Dimension)>]) -> (Axis, Vec<Option<f64>>) {
        let label = self.labels[at].clone();
        let document = &self.state.lowered.document;
        let largest = numbers.iter().flatten().max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        let Some(&(largest, dimension)) = largest else {
            return (Axis { label, unit: String::new() }, vec![None; numbers.len()]);
        };
        let path = parse_path(&label);
        let slot = path.as_ref().and_then(|path| {
            let thing = crate::session::thing_at(&self.state, path)?;
            self.state.structure.slot_of(thing)
        });
        let written = slot.map(|slot| words::written_for(&self.state, slot)).unwrap_or_default();
        let class = match (slot, &path) {
            (Some(slot), _) => words::quantity_of(&self.state, slot, &written).class,
            (None, Some(path)) => self.class_answered(path),
            (None, None) => "",
        };
        let quantity = Quantity { dimension, class, written: &written };
        let unit = kernel::show_quantity(largest, quantity, document).unit;
        let shown = |x: &Option<(f64, Dimension)>| {
            let (x, dimension) = (*x)?;
            Some(kernel::in_unit(x, dimension, &unit, document)).filter(|x| x.is_finite())
        };
        (Axis { label, unit: unit.clone() }, numbers.iter().map(shown).collect())
    }

    /// Returns the class that is written for what the last message of a path answers; empty where none is.
    fn class_answered(&self, path: &Path) -> &str {
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return "" };
        let owner = crate::session::thing_at(&self.state, &Path(owner.to_vec()));
        let class = owner.map(|owner| self.state.structure.things[owner].class);
        let document = &self.state.lowered.document;
        class.map_or("", |class| crate::views::answers::answer_class(document, class, name))
    }
}

/// Reads expressions as the document's own members would.
///
/// # Errors
/// What the first that means nothing is, and why.
pub(crate) fn read(state: &State, named: &[&str]) -> Result<Vec<Term>, Refusal> {
    let refuse = |what: &str, d: &Diagnostic| {
        let hint = d.hint.as_ref().map(|hint| format!("; {hint}")).unwrap_or_default();
        words::refuse(format!("{what}: {}{hint}", d.message))
    };
    for words in named {
        let alone = syntax::parse_expression(base::FileId(0), words);
        if let Some(d) = alone.diagnostics().first() {
            return Err(refuse(words, d));
        }
    }
    let texts: Vec<String> = named.iter().map(ToString::to_string).collect();
    let alone = lang::read_alone(&state.lowered, state.lowered.document.root, &texts);
    let term = |(term, words): (Result<Term, Vec<Diagnostic>>, &&str)| {
        term.map_err(|wrong| match wrong.first() {
            Some(d) => refuse(words, d),
            None => words::refuse(format!("{words} means nothing here")),
        })
    };
    alone.terms.into_iter().zip(named).map(term).collect()
}

/// Returns an answer as a number or a place; nothing where it is neither.
fn reading(state: &State, values: &Values, answer: &Answer<'_>) -> Option<Reading> {
    match answer {
        Answer::Number(x, dimension) => Some(Reading::Number(*x, *dimension)),
        Answer::Thing(thing) => {
            let [(_, x), (_, y)] = drag::coordinates(&state.structure, *thing)?;
            Some(Reading::Place(values.numbers[x], values.numbers[y]))
        }
        Answer::Made(made) if state.lowered.document.is_place(made.class) => match &made.fields[..]
        {
            [Answer::Number(x, _), Answer::Number(y, _)] => Some(Reading::Place(*x, *y)),
            _ => None,
        },
        Answer::Made(_)
        | Answer::Bool(_)
        | Answer::Option(..)
        | Answer::Text(_)
        | Answer::Context(_)
        | Answer::List(_)
        | Answer::Picture(_)
        | Answer::Function(_) => None,
    }
}
