//! Replay: what a program drew once is drawn again on numbers alone.
//!
//! In: a question whose answer follows from numbers: what the program of a thing draws, how that looks, what a row of a
//! family comes to. The second time that it is asked the interpreter's run is noted: operations, constructions, and the
//! decisions on the way, which are the *course* of the run. From then on, for other numbers that decide alike, what was
//! noted is done to these, without a name, a class or a term being looked at. Where a decision comes out as never
//! before, or a number is none, the interpreter runs; so it is the interpreter that says what fails, and why.
//!
//! Messages, calls, sets and classes come to nothing but operations on numbers, since the interpreter went through them.
//! A run counts as much fuel, and as many things, as it did when it was noted. What makes texts of numbers, looks for an
//! edge of a region, or fills what lines surround, is not noted; [`Evaluator::why_interpreted`] says so.
//!
//! Reading order: `op`, `outline`, `curves`, `routine`, `record`, `form`.

mod curves;
mod form;
mod op;
mod outline;
mod record;
mod routine;

pub(crate) use curves::{Measure, corners, order_of_lines};
pub(crate) use op::{Binary, Unary};

use crate::answer::{Answer, Made};
use crate::evaluator::{Evaluator, Result};
use crate::fault::Fault;
use expr::dimension::Dimension;
use form::Form;
use geometry::{
    Combination, Construction, Figure, NoConstruction, NoContour, NoRegion, Ring, Side, Surface,
};
use kernel::{ClassId, SlotId, ThingId};
use record::{Recorder, place_of};
use routine::{Outcome, Question, Routine};
use std::cell::RefCell;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

/// A question whose answer follows from numbers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Asked {
    /// What the program of a thing draws.
    Run(ThingId),
    /// How a thing looks whose class is a program.
    Look(ThingId),
    /// What a program draws for values of this form.
    Row(ClassId, Row),
    /// What is measured of that.
    Measures(ClassId, Row),
}

/// The form of a program's parameters: all but the numbers in them.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
pub(crate) struct Row {
    shape: Vec<u64>,
    texts: Vec<Arc<str>>,
}

/// What is known of runs, and room to run.
#[derive(Debug, Default)]
pub(crate) struct Routines {
    known: RefCell<BTreeMap<Asked, Routine>>,
    registers: RefCell<Vec<f64>>,
}

impl Routines {
    /// Returns how many runs were asked for, and how many of these went by what was noted.
    pub(crate) fn replays(&self) -> (u32, u32) {
        let known = self.known.borrow();
        known.values().fold((0, 0), |(asked, replayed), r| (asked + r.asked, replayed + r.replayed))
    }
}

/// A run that is being noted, and what it read.
#[derive(Debug, Default)]
pub(crate) struct Recording {
    recorder: Recorder,
    texts: Vec<(SlotId, Arc<str>)>,
}

impl<'a> Evaluator<'a> {
    /// Returns why the program of a class is left to the interpreter, run after run; nothing where it is not, as far
    /// as is known.
    pub fn why_interpreted(&self, class: ClassId) -> Option<String> {
        let known = self.tables.routines.as_ref()?.known.borrow();
        let is_of = |asked: &Asked| match asked {
            Asked::Run(thing) | Asked::Look(thing) => self.structure.things[*thing].class == class,
            Asked::Row(of, _) | Asked::Measures(of, _) => *of == class,
        };
        known.iter().filter(|(asked, _)| is_of(asked)).find_map(|(_, r)| r.given_up.clone())
    }

    /// Returns true while a run is being noted.
    pub(crate) fn is_recording(&self) -> bool {
        self.recording.borrow().is_some()
    }

    /// Answers a question by what was noted of it; by the interpreter, `ask`, where nothing was. `inputs` are the
    /// numbers that it is about, where these do not stand in slots.
    pub(crate) fn replay<T: Again>(
        &self,
        asked: &Asked,
        inputs: &[f64],
        ask: impl Fn() -> Result<T>,
    ) -> Result<T> {
        let Some(routines) = &self.tables.routines else { return ask() };
        if self.is_recording() || self.nudged.get().is_some() || self.calls.get() > 0 {
            return ask();
        }
        let input = |k: u32| match asked {
            Asked::Run(_) | Asked::Look(_) => self.values.numbers[SlotId(k)],
            Asked::Row(..) | Asked::Measures(..) => inputs[k as usize],
        };
        let may_note = {
            let mut known = routines.known.borrow_mut();
            let routine = match known.get_mut(asked) {
                Some(routine) => routine,
                None => known.entry(asked.clone()).or_default(),
            };
            let is_other = |(slot, text): &(SlotId, Arc<str>)| {
                self.values.texts.get(slot).map_or("", |now| now) != &**text
            };
            if routine.texts.iter().any(is_other) {
                *routine = Routine::default();
            }
            routine.asked = routine.asked.saturating_add(1);
            let registers = &mut *routines.registers.borrow_mut();
            if let Some(outcome) = routine.run(input, registers).filter(|o| self.affords(o)) {
                let outcome = outcome.clone();
                routine.replayed = routine.replayed.saturating_add(1);
                self.spend(&outcome);
                return Ok(T::again(&outcome.form, registers));
            }
            routine.may_note()
        };
        let mut failed = None;
        if may_note {
            match self.noted(&ask) {
                Ok(noted) => {
                    let answer = T::again(&noted.outcome.form, &noted.recorder.registers);
                    self.keep(asked, noted);
                    return Ok(answer);
                }
                Err(why) => failed = Some(why),
            }
        }
        let faults = self.faults.borrow().len();
        let answer = ask();
        let is_whole = self.faults.borrow().len() <= faults
            && answer.as_ref().is_ok_and(|answer| answer.why_ended().is_none());
        if let Some(routine) = routines.known.borrow_mut().get_mut(asked) {
            routine.is_worth_a_note = is_whole;
            routine.noted += u32::from(failed.is_some());
            // a run that the interpreter ends early, too, says nothing of others
            if is_whole && failed.is_some() {
                routine.given_up = failed;
            }
        }
        answer
    }

    /// Keeps what was noted of a run.
    fn keep(&self, asked: &Asked, noted: Noted) {
        let Some(routines) = &self.tables.routines else { return };
        if let Some(routine) = routines.known.borrow_mut().get_mut(asked) {
            let is_new = |t: &(SlotId, Arc<str>)| !routine.texts.contains(t);
            let texts: Vec<_> = noted.texts.into_iter().filter(is_new).collect();
            routine.texts.extend(texts);
            let Recorder { registers, notes, .. } = noted.recorder;
            routine.add(notes, Rc::new(noted.outcome), registers.len());
        }
    }

    /// Returns true where a run that comes to this ends well from here.
    fn affords(&self, outcome: &Outcome) -> bool {
        let [messages, terms] = outcome.depth;
        self.fuel.get() >= outcome.fuel
            && self.messages.get() <= messages
            && self.terms.get() <= terms
            && self.blocks.get() == 0
    }

    /// Counts what a run takes, as if the interpreter had run.
    fn spend(&self, outcome: &Outcome) {
        self.fuel.set(self.fuel.get() - outcome.fuel);
        self.entities.set(outcome.entities);
        if let Some(reads) = &mut *self.reads.borrow_mut() {
            reads.extend(&outcome.reads);
        }
    }

    /// Lets the interpreter answer, and notes what it does.
    ///
    /// # Errors
    /// Why that cannot be noted. Nothing is changed then.
    fn noted<T: Again>(&self, ask: &impl Fn() -> Result<T>) -> std::result::Result<Noted, String> {
        let counters = [&self.messages, &self.terms, &self.calls, &self.blocks, &self.entities];
        let before = counters.map(std::cell::Cell::get);
        let fuel = self.fuel.get();
        let faults = self.faults.borrow().len();
        // what was drawn before is not marked, and what is drawn now is
        let runs = self.runs.take();
        let most = self.most.get();
        self.recording.replace(Some(Recording::default()));
        let (answer, reads) = self.listening(ask);
        let recording = self.recording.take().unwrap_or_default();
        self.runs.replace(runs);
        let entities = self.entities.get();
        // what is several questions has fuel for each
        let used = fuel.saturating_sub(self.fuel.get());
        let made = answer.map_err(|fault| fault.message).and_then(|answer| {
            if let Some(why) = answer.why_ended() {
                return Err(why);
            }
            if let Some(fault) = self.faults.borrow().get(faults) {
                return Err(fault.message.clone());
            }
            if recording.recorder.is_full() {
                return Err("a run is too long to be noted".into());
            }
            answer.form()
        });
        match made {
            Ok(form) => {
                let [messages, terms, ..] = before;
                let depth = [messages, terms];
                let outcome = Outcome { form, fuel: used, entities, depth, reads };
                let Recording { recorder, texts } = recording;
                Ok(Noted { recorder, texts, outcome })
            }
            Err(why) => {
                counters.into_iter().zip(before).for_each(|(cell, was)| cell.set(was));
                self.fuel.set(fuel);
                self.most.set(most);
                self.faults.borrow_mut().truncate(faults);
                Err(why)
            }
        }
    }

    /// Goes on with the run that is being noted, if one is.
    fn recorder<T>(&self, go_on: impl FnOnce(&mut Recording) -> T) -> Option<T> {
        self.recording.borrow_mut().as_mut().map(go_on)
    }

    /// Reads a number that may be marked.
    pub(crate) fn operand(&self, answer: &Answer<'a>) -> Result<(f64, Dimension)> {
        match answer {
            Answer::Number(x, dimension) => Ok((*x, *dimension)),
            other => Err(Fault::wrong(format!("{} where a number is wanted", self.kind(other)))),
        }
    }

    /// Returns the number that may be marked, as it is in this run: not to be decided by.
    pub(crate) fn value_of(&self, x: f64) -> f64 {
        match place_of(x) {
            Some(_) => self.recorder(|r| r.recorder.value(x)).unwrap_or(x),
            None => x,
        }
    }

    /// Computes an operation on a number that may be marked.
    pub(crate) fn unary_number(&self, op: Unary, x: f64) -> f64 {
        match place_of(x) {
            Some(_) => self.recorder(|r| r.recorder.unary(op, x)).unwrap_or(x),
            None => op.apply(x),
        }
    }

    /// Computes an operation on numbers that may be marked.
    pub(crate) fn binary_number(&self, op: Binary, x: f64, y: f64) -> f64 {
        match (place_of(x), place_of(y)) {
            (None, None) => op.apply(x, y),
            _ => self.recorder(|r| r.recorder.binary(op, x, y)).unwrap_or(f64::NAN),
        }
    }

    /// Computes a construction of figures whose numbers may be marked.
    pub(crate) fn constructed(
        &self,
        what: Construction,
        of: &[Figure<f64>],
        numbers: &[f64],
    ) -> std::result::Result<Figure<f64>, NoConstruction> {
        let noted = self.recorder(|r| r.recorder.construct(what, of, numbers));
        noted.unwrap_or_else(|| geometry::construct(what, of, numbers))
    }

    /// Makes a contour of edges whose numbers may be marked.
    pub(crate) fn joined(&self, sides: &[Side]) -> std::result::Result<Ring, NoContour> {
        let noted = self.recorder(|r| r.recorder.contour(sides));
        noted.unwrap_or_else(|| geometry::contour(sides))
    }

    /// Combines regions whose numbers may be marked.
    pub(crate) fn region_of_two(
        &self,
        how: Combination,
        of: [&[Surface]; 2],
    ) -> std::result::Result<Vec<Surface>, NoRegion> {
        let noted = self.recorder(|r| r.recorder.combine(how, of));
        noted.unwrap_or_else(|| geometry::combine(how, of[0], of[1]))
    }

    /// Widens a region whose numbers may be marked.
    pub(crate) fn widened(
        &self,
        of: &[Surface],
        by: f64,
    ) -> std::result::Result<Vec<Surface>, NoRegion> {
        let noted = self.recorder(|r| r.recorder.offset(of, by));
        noted.unwrap_or_else(|| geometry::offset(of, by))
    }

    /// Makes something of lines whose numbers may be marked.
    pub(crate) fn of_lines(
        &self,
        what: Measure,
        shapes: &[drawing::Shape],
    ) -> std::result::Result<Vec<f64>, &'static str> {
        let noted = self.recorder(|r| r.recorder.measure(what, shapes));
        noted.unwrap_or_else(|| what.of(shapes))
    }

    /// Compares numbers that may be marked, exactly; answers are finite, so that the order is total up to the sign of
    /// zero.
    pub(crate) fn order_of(&self, x: f64, y: f64) -> Ordering {
        match (place_of(x), place_of(y)) {
            (None, None) => (x + 0.0).total_cmp(&(y + 0.0)),
            _ => {
                let decided = self.recorder(|r| r.recorder.decide(Question::Order, x, y));
                (decided.unwrap_or_default() as i64).cmp(&0)
            }
        }
    }

    /// Returns true if numbers that may be marked are equal, to the tolerance of rules.
    pub(crate) fn are_close(&self, x: f64, y: f64) -> bool {
        match (place_of(x), place_of(y)) {
            (None, None) => base::number::close(x, y),
            _ => self.recorder(|r| r.recorder.decide(Question::Close, x, y)) == Some(1),
        }
    }

    /// Returns what a number is that may be marked; whatever follows, follows from that.
    pub(crate) fn fixed_number(&self, x: f64) -> f64 {
        match place_of(x) {
            Some(_) => self.recorder(|r| r.recorder.fix(x)).unwrap_or(x),
            None => x,
        }
    }

    /// Marks a number that is read from a slot, while a run is being noted.
    pub(crate) fn slot_number(&self, slot: SlotId, x: f64) -> f64 {
        self.recorder(|r| r.recorder.input(slot.0, x)).unwrap_or(x)
    }

    /// Notes a text that is read from a slot, while a run is being noted.
    pub(crate) fn slot_text(&self, slot: SlotId, text: &str) {
        self.recorder(|r| r.texts.push((slot, Arc::from(text))));
    }

    /// Returns the same values, their numbers marked while a run is being noted.
    pub(crate) fn marked(&self, answer: &Answer<'a>) -> Answer<'a> {
        let mut next = 0;
        self.recorder(|r| marked(&mut r.recorder, answer, &mut next))
            .unwrap_or_else(|| answer.clone())
    }
}

/// Returns true for a number that is marked.
pub(crate) fn is_marked(x: f64) -> bool {
    place_of(x).is_some()
}

/// A run that was noted.
struct Noted {
    recorder: Recorder,
    texts: Vec<(SlotId, Arc<str>)>,
    outcome: Outcome,
}

/// What a question is answered with, and can be made again of other numbers.
pub(crate) trait Again: Sized {
    /// Says why it is not whole.
    fn why_ended(&self) -> Option<String>;
    /// Reads it, its numbers marked.
    ///
    /// # Errors
    /// What cannot be made again, in words.
    fn form(&self) -> std::result::Result<Form, String>;
    /// Makes it of the numbers in registers.
    fn again(form: &Form, registers: &[f64]) -> Self;
}

impl Again for Answer<'_> {
    fn why_ended(&self) -> Option<String> {
        match self {
            Answer::Context(run) => run.ended.as_ref().map(ToString::to_string),
            _ => None,
        }
    }
    fn form(&self) -> std::result::Result<Form, String> {
        Form::of(self)
    }
    fn again(form: &Form, registers: &[f64]) -> Self {
        form.answer(registers)
    }
}

/// Numbers, each with what it is called.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Measures {
    names: Arc<[String]>,
    numbers: Vec<f64>,
}

impl Measures {
    /// Returns each name with its number, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.names.iter().map(String::as_str).zip(self.numbers.iter().copied())
    }
    /// Returns how many there are.
    pub fn len(&self) -> usize {
        self.numbers.len()
    }
    /// Returns true if there are none.
    pub fn is_empty(&self) -> bool {
        self.numbers.is_empty()
    }
}

impl FromIterator<(String, f64)> for Measures {
    fn from_iter<I: IntoIterator<Item = (String, f64)>>(all: I) -> Self {
        let (names, numbers): (Vec<String>, Vec<f64>) = all.into_iter().unzip();
        Self { names: names.into(), numbers }
    }
}

impl Again for Option<Measures> {
    fn why_ended(&self) -> Option<String> {
        self.is_none().then(|| "nothing is measured".into())
    }
    fn form(&self) -> std::result::Result<Form, String> {
        match self {
            Some(Measures { names, numbers }) => Ok(Form::of_numbers(names.clone(), numbers)),
            None => Err("nothing is measured".into()),
        }
    }
    fn again(form: &Form, registers: &[f64]) -> Self {
        let (names, numbers) = form.numbers(registers);
        Some(Measures { names, numbers })
    }
}

fn marked<'a>(recorder: &mut Recorder, answer: &Answer<'a>, next: &mut u32) -> Answer<'a> {
    match answer {
        Answer::Number(x, dimension) => {
            let k = *next;
            *next += 1;
            Answer::Number(recorder.input(k, *x), *dimension)
        }
        Answer::Made(made) => {
            let fields = made.fields.iter().map(|f| marked(recorder, f, next)).collect();
            Answer::Made(Rc::new(Made { class: made.class, fields }))
        }
        Answer::List(items) => {
            Answer::List(items.iter().map(|item| marked(recorder, item, next)).collect())
        }
        Answer::Bool(_)
        | Answer::Option(..)
        | Answer::Text(_)
        | Answer::Thing(_)
        | Answer::Context(_)
        | Answer::Picture(_)
        | Answer::Function(_) => answer.clone(),
    }
}

impl Row {
    /// Reads the form of values, and adds their numbers in order; nothing where they are more than values.
    pub(crate) fn of(answer: &Answer<'_>, inputs: &mut Vec<f64>) -> Option<Self> {
        let mut row = Self::default();
        row.read(answer, inputs).then_some(row)
    }

    /// Returns the same, asked for something.
    pub(crate) fn asked(mut self, what: &str) -> Self {
        self.texts.push(Arc::from(what));
        self
    }

    fn read(&mut self, answer: &Answer<'_>, inputs: &mut Vec<f64>) -> bool {
        match answer {
            Answer::Made(made) => {
                self.shape.extend([0, u64::from(made.class.0)]);
                made.fields.iter().all(|part| self.read(part, inputs))
            }
            Answer::List(items) => {
                self.shape.extend([1, items.len() as u64]);
                items.iter().all(|part| self.read(part, inputs))
            }
            Answer::Number(x, dimension) => {
                inputs.push(*x);
                let exponents = dimension.0.iter();
                let packed = exponents.fold(0, |packed, &e| (packed << 8) | u64::from(e as u8));
                self.shape.extend([2, packed]);
                true
            }
            Answer::Bool(b) => {
                self.shape.extend([3, u64::from(*b)]);
                true
            }
            Answer::Option(class, at) => {
                self.shape.extend([4, u64::from(class.0), u64::from(*at)]);
                true
            }
            Answer::Text(text) => {
                self.shape.push(5);
                self.texts.push(text.clone());
                true
            }
            Answer::Thing(_) | Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => {
                false
            }
        }
    }
}
