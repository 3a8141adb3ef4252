//! Programs: a class's steps are run on numbers, in order; what they make is a [`Context`].
//!
//! The reference interpreter: it walks the program as it was written. What a step cannot do ends the run
//! with the step's name, its operands and the reason; what was drawn before stands.

use crate::answer::{Answer, Frame};
use crate::evaluator::{Evaluator, Result};
use crate::fault::{Fault, FaultKind};
use crate::replay::{Asked, Measures, Row};
use base::Name;
use kernel::program::{Block, Carried, Program, Says, Step};
use kernel::{ClassId, OriginId, Term, ThingId};
use std::rc::Rc;

mod bounds;
mod demands;
mod ending;
pub use demands::allowed_table;

/// How many terms a run may evaluate, that of the programs it calls included.
pub const MOST_OPERATIONS: u64 = 2_000_000;
/// How many things a run may make, turns of loops included.
pub const MOST_ENTITIES: u32 = 100_000;
/// Why a step has no outcome that was told as an error of the text.
pub const UNCLEAR: &str = "its text is wrong";
/// How deep programs may call each other.
pub const DEEPEST_CALLS: u32 = 200;
/// How deep blocks may stand and run in one another, calls included.
const DEEPEST_BLOCKS: u32 = 400;

/// What a program made, or one turn of a block of it.
#[derive(Debug)]
pub struct Context<'a> {
    /// The program, or the class of the block's turns.
    pub class: ClassId,
    /// That whose parameters the program read; none for a turn.
    pub of: Option<Answer<'a>>,
    /// What was made, in order, with what a turn began with.
    pub made: Vec<Entry<'a>>,
    /// Why the run ended before its last step.
    pub ended: Option<Ended>,
}

/// What a step made.
#[derive(Clone, Debug)]
pub struct Entry<'a> {
    /// The step; empty for a block without a name.
    pub name: Name,
    /// What it is.
    pub answer: Answer<'a>,
    /// What it is for.
    pub standing: Standing,
}

/// What something in a context is for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Standing {
    /// It is part of the result.
    Result,
    /// It is drawn for construction.
    Guide,
    /// It was part of the result.
    Erased,
    /// It is what the turn began with.
    Carried,
}

/// Why a run ended before its last step.
#[derive(Clone, PartialEq, Debug)]
pub struct Ended {
    /// In which way.
    pub why: Why,
    /// The step, as it is reached from the program: `column[2].ring`; the demand, where one is not met.
    pub step: String,
    /// What the step, or the demand, spoke of: names and values.
    pub operands: Vec<(String, String)>,
    /// What was found and what was wanted.
    pub reason: String,
    /// True where that was in a program which the step called.
    pub is_called: bool,
    /// Where the step was written.
    pub origin: OriginId,
}

/// The ways in which a run ends early.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Why {
    /// A demand on the parameters is not met.
    Outside,
    /// A step has no outcome.
    Failed,
    /// It used up what a run may use.
    TooLong,
}

impl std::fmt::Display for Ended {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.why {
            Why::Outside if self.reason.is_empty() => write!(f, "{} is not met", self.step)?,
            Why::Outside => write!(f, "{} is not met: {}", self.step, self.reason)?,
            Why::Failed => write!(f, "the step {} has no outcome: {}", self.step, self.reason)?,
            Why::TooLong if self.step.is_empty() => write!(f, "{}", self.reason)?,
            Why::TooLong => write!(f, "the run ended at the step {}: {}", self.step, self.reason)?,
        }
        for (i, (name, value)) in self.operands.iter().enumerate() {
            write!(f, "{}{name} is {value}", if i == 0 { "; " } else { ", " })?;
        }
        Ok(())
    }
}

impl<'a> Context<'a> {
    /// Returns what the step of a name made.
    pub fn step(&self, name: &str) -> Option<&Answer<'a>> {
        self.made.iter().rev().find(|e| *e.name == *name).map(|e| &e.answer)
    }
    /// Returns what is part of the result, in the order of making.
    pub fn result(&self) -> impl Iterator<Item = &Entry<'a>> {
        self.made.iter().filter(|e| e.standing == Standing::Result)
    }
}

/// A run in progress: the block at hand, and the way to it.
struct Run<'e, 'a> {
    evaluator: &'e Evaluator<'a>,
    /// The steps around the one at hand, each with its turn.
    way: Vec<(&'a Name, Option<usize>)>,
}

/// What a block has made so far.
struct Making<'a> {
    frame: Frame<'a>,
    made: Vec<Entry<'a>>,
    /// Steps of blocks around it that it erased.
    erased: Vec<Name>,
}

impl<'a> Evaluator<'a> {
    /// Runs the program of a thing; once in a state. Nothing where its class is none.
    ///
    /// # Errors
    /// A thing whose program needs what itself draws.
    pub fn run(&self, thing: ThingId) -> Result<Option<Rc<Context<'a>>>> {
        self.begin();
        self.run_once(thing)
    }

    /// Runs the program of a thing in the midst of a question.
    fn run_once(&self, thing: ThingId) -> Result<Option<Rc<Context<'a>>>> {
        let thing = self.structure.merged[thing];
        let class = self.structure.things[thing].class;
        let Some(program) = self.document.program(class) else { return Ok(None) };
        let is_plain = self.nudged.get().is_none();
        if let Some(reads) = &mut *self.reads.borrow_mut() {
            reads.extend(self.structure.slots_under(thing));
        }
        if let Some(known) = self.runs.borrow().get(&thing).filter(|_| is_plain) {
            return match known {
                Some(run) => Ok(Some(run.clone())),
                None => Err(Fault::new(FaultKind::Endless, "a program that needs what it draws")),
            };
        }
        self.runs.borrow_mut().insert(thing, None);
        let run = self.drawn_again(&Asked::Run(thing), &[], || {
            self.draw_program(program, class, Answer::Thing(thing), thing)
        })?;
        self.runs.borrow_mut().insert(thing, Some(run.clone()));
        if !is_plain {
            self.runs.borrow_mut().remove(&thing);
        }
        Ok(Some(run))
    }

    /// Runs the program of a class for given values of its parameters, in their order.
    ///
    /// # Errors
    /// A class that is no program, values that its parameters do not take.
    pub fn run_with(
        &self,
        class: ClassId,
        values: Vec<(&'a Name, Answer<'a>)>,
    ) -> Result<Rc<Context<'a>>> {
        let (program, of) = self.begin_with(class, values)?;
        let mut inputs = Vec::new();
        let draw = || self.draw_program(program, class, self.marked(&of), kernel::DOCUMENT);
        match Row::of(&of, &mut inputs) {
            Some(row) => self.drawn_again(&Asked::Row(class, row), &inputs, draw),
            None => Ok(Rc::new(draw())),
        }
    }

    /// Tests what a program demands of given values of its parameters; returns the run that ended there, or one that has
    /// drawn nothing yet.
    ///
    /// # Errors
    /// A class that is no program, values that its parameters do not take.
    pub fn ask_with(
        &self,
        class: ClassId,
        values: Vec<(&'a Name, Answer<'a>)>,
    ) -> Result<Rc<Context<'a>>> {
        let (program, of) = self.begin_with(class, values)?;
        let run = Run { evaluator: self, way: Vec::new() };
        let ended = run.demands(program, &Frame::sent(of.clone(), kernel::DOCUMENT)).err();
        Ok(Rc::new(Context { class, of: Some(of), made: Vec::new(), ended }))
    }

    /// Measures what a program draws for given values of its parameters. `measure` says what, and passes numbers on as
    /// they are; nothing where it takes no measures of a run. `what` tells apart what is measured of one program.
    ///
    /// # Errors
    /// A class that is no program, values that its parameters do not take.
    pub fn measure_with(
        &self,
        what: &str,
        class: ClassId,
        values: Vec<(&'a Name, Answer<'a>)>,
        measure: impl Fn(&Rc<Context<'a>>) -> Option<Measures>,
    ) -> Result<Option<Measures>> {
        let (program, of) = self.begin_with(class, values)?;
        let mut inputs = Vec::new();
        let measured = || {
            self.begin();
            let run = self.draw_program(program, class, self.marked(&of), kernel::DOCUMENT);
            Ok(measure(&Rc::new(run)))
        };
        match Row::of(&of, &mut inputs) {
            Some(row) => self.replay(&Asked::Measures(class, row.asked(what)), &inputs, measured),
            None => measured(),
        }
    }

    /// Begins a question about what a program draws; returns it, and that whose parameters it reads.
    fn begin_with(
        &self,
        class: ClassId,
        values: Vec<(&'a Name, Answer<'a>)>,
    ) -> Result<(&'a Rc<Program>, Answer<'a>)> {
        self.begin();
        let Some(program) = self.document.program(class) else {
            return Err(Fault::wrong("a class that draws nothing"));
        };
        let given: Vec<_> = values.into_iter().map(|(name, value)| (Some(name), value)).collect();
        Ok((program, self.make(class, &given, kernel::DOCUMENT)?))
    }

    /// Runs a program as it was run before, where it was; else as it is written.
    fn drawn_again(
        &self,
        asked: &Asked,
        inputs: &[f64],
        draw: impl Fn() -> Context<'a>,
    ) -> Result<Rc<Context<'a>>> {
        match self.replay(asked, inputs, || Ok(Answer::Context(Rc::new(draw()))))? {
            Answer::Context(run) => Ok(run),
            other => Err(Fault::wrong(format!("{} is not drawn", self.kind(&other)))),
        }
    }

    /// Returns whether a rule that speaks of a program's parameters and steps is true of a run.
    ///
    /// # Errors
    /// A rule without a value.
    pub fn holds(&self, rule: &'a Term, run: &Rc<Context<'a>>) -> Result<bool> {
        self.begin();
        self.truth(rule, &Frame::sent(Answer::Context(run.clone()), kernel::DOCUMENT))
    }

    /// Returns what something draws that is no thing of the document.
    pub fn elements(&self, of: &Answer<'a>) -> Vec<drawing::Element> {
        self.pictured(of).unwrap_or_default()
    }

    /// Returns what an answer draws.
    ///
    /// # Errors
    /// Why it cannot be drawn.
    pub fn pictured(&self, of: &Answer<'a>) -> Result<Vec<drawing::Element>> {
        self.begin();
        match self.send(of, &self.tables.picture, Vec::new(), None, kernel::DOCUMENT)? {
            Answer::Picture(elements) => Ok(elements.to_vec()),
            _ => Ok(Vec::new()),
        }
    }

    /// Runs a program that is called: what a thing of its class that was made with values draws.
    pub(crate) fn called(&self, made: Answer<'a>, nearest: ThingId) -> Result<Answer<'a>> {
        let Some(class) = self.class_of(&made) else { return Ok(made) };
        let Some(program) = self.document.program(class) else { return Ok(made) };
        let run = self.draw_program(program, class, made, nearest);
        match &run.ended {
            None => Ok(Answer::Context(Rc::new(run))),
            Some(ended) => {
                let name = &self.document.classes[class].name;
                // of calls in calls the innermost says it
                let message = match ended.is_called {
                    true => ended.reason.clone(),
                    false => format!("in {name}: {ended}"),
                };
                Err(Fault::new(FaultKind::Run(ended.why), message).within(ended.origin))
            }
        }
    }

    fn draw_program(
        &self,
        program: &'a Rc<Program>,
        class: ClassId,
        of: Answer<'a>,
        nearest: ThingId,
    ) -> Context<'a> {
        let (calls, fuel) = (self.calls.get(), self.fuel.get());
        if calls == 0 {
            self.entities.set(0);
            self.fuel.set(fuel.min(MOST_OPERATIONS));
        }
        let given = self.fuel.get();
        self.calls.set(calls + 1);
        let frame = Frame::sent(of.clone(), nearest);
        self.drawing.borrow_mut().push(frame.clone());
        let mut making = Making { frame, made: Vec::new(), erased: Vec::new() };
        let mut run = Run { evaluator: self, way: Vec::new() };
        let outcome = match calls < DEEPEST_CALLS {
            true => run
                .demands(program, &making.frame)
                .and_then(|()| run.steps(&program.body, &mut making)),
            false => Err(Ended {
                why: Why::TooLong,
                step: String::new(),
                operands: Vec::new(),
                is_called: false,
                reason: format!("programs call each other more than {DEEPEST_CALLS} deep"),
                origin: self.document.classes[class].origin,
            }),
        };
        self.drawing.borrow_mut().pop();
        self.calls.set(calls);
        if calls == 0 {
            self.fuel.set(fuel - (given - self.fuel.get()));
        }
        Context { class, of: Some(of), made: making.made, ended: outcome.err() }
    }

    /// Returns what a step of a thing's program made.
    pub(crate) fn step(
        &self,
        me: &Answer<'a>,
        name: &Name,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        if let Some(made) = self.made_so_far(me, name) {
            return made;
        }
        let context = self.context(me, nearest)?;
        match (context.step(name), &context.ended) {
            (Some(answer), _) => Ok(answer.clone()),
            (None, Some(ended)) => Err(Fault::no_answer(ended.to_string()).within(ended.origin)),
            (None, None) => {
                Err(Fault::no_answer(format!("`{name}` was not made: another branch ran")))
            }
        }
    }

    /// Returns what a step made, where the program that has it is being drawn and asks itself: by a message of its own.
    fn made_so_far(&self, me: &Answer<'a>, name: &Name) -> Option<Result<Answer<'a>>> {
        let drawing = self.drawing.borrow();
        let frame = drawing.last()?;
        let is_it = match (&frame.me, me) {
            (Answer::Thing(a), Answer::Thing(b)) => a == b,
            (Answer::Made(a), Answer::Made(b)) => Rc::ptr_eq(a, b),
            _ => false,
        };
        let missing = || Fault::no_answer(format!("`{name}` is not made yet"));
        is_it.then(|| frame.local(name).cloned().ok_or_else(missing))
    }

    /// Returns what a thing's program drew, as a list. That it ended early is noted.
    pub(crate) fn result(&self, me: &Answer<'a>, nearest: ThingId) -> Result<Answer<'a>> {
        let context = self.context(me, nearest)?;
        if let Some(ended) = &context.ended {
            let fault = Fault::no_answer(ended.to_string()).within(ended.origin);
            self.faults.borrow_mut().push(fault);
        }
        Ok(Answer::List(context.result().map(|e| e.answer.clone()).collect()))
    }

    fn context(&self, me: &Answer<'a>, nearest: ThingId) -> Result<Rc<Context<'a>>> {
        let found = match me {
            Answer::Context(context) => Some(context.clone()),
            Answer::Thing(thing) => self.run_once(*thing)?,
            Answer::Made(_) => match self.called(me.clone(), nearest)? {
                Answer::Context(context) => Some(context),
                _ => None,
            },
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::List(_)
            | Answer::Picture(_)
            | Answer::Function(_) => None,
        };
        found.ok_or_else(|| Fault::wrong(format!("{} draws nothing", self.kind(me))))
    }

    /// Sends a message to everything in a set that is drawn; what is in it keeps its place and name.
    pub(crate) fn each_in_set(
        &self,
        set: &Answer<'a>,
        name: &Name,
        arguments: &[(Option<&'a Name>, Answer<'a>)],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        self.burn()?;
        match set {
            Answer::List(items) => self.deeper(|| {
                let each = items.iter().map(|i| self.each_in_set(i, name, arguments, nearest));
                each.collect::<Result<_>>().map(Answer::List)
            }),
            Answer::Context(context) => self.deeper(|| {
                let each = |entry: &Entry<'a>| {
                    let answer = self.each_in_set(&entry.answer, name, arguments, nearest)?;
                    Ok(Entry { answer, ..entry.clone() })
                };
                let made = context.made.iter().map(each).collect::<Result<_>>()?;
                let (class, of) = (context.class, context.of.clone());
                Ok(Answer::Context(Rc::new(Context { class, of, made, ended: None })))
            }),
            Answer::Thing(_) | Answer::Made(_) => {
                self.count_entity()?;
                self.send(set, name, arguments.to_vec(), None, nearest)
            }
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::Picture(_)
            | Answer::Function(_) => Ok(set.clone()),
        }
    }

    /// Counts one more thing of the run at hand.
    fn count_entity(&self) -> Result<()> {
        let n = self.entities.get() + 1;
        if n > MOST_ENTITIES {
            let message = format!("a run makes at most {MOST_ENTITIES} things");
            return Err(Fault::new(FaultKind::Endless, message));
        }
        self.entities.set(n);
        Ok(())
    }
}

impl<'a> Run<'_, 'a> {
    /// Does the steps of a block; what was made before a step fails stays made.
    fn steps(
        &mut self,
        block: &'a Block,
        making: &mut Making<'a>,
    ) -> std::result::Result<(), Ended> {
        block.steps.iter().try_for_each(|step| self.step(step, making))
    }

    fn step(&mut self, step: &'a Step, making: &mut Making<'a>) -> std::result::Result<(), Ended> {
        if self.way.is_empty()
            && let Some(so_far) = self.evaluator.drawing.borrow_mut().last_mut()
        {
            *so_far = making.frame.clone();
        }
        let burnt = self.evaluator.burn();
        burnt.map_err(|fault| self.ended(step, &making.frame, None, fault))?;
        match &step.says {
            Says::Value(term) => {
                let value = self.evaluator.count_entity();
                let value = value.and_then(|()| self.evaluator.term(term, &making.frame));
                match value.and_then(|answer| self.within_bounds(answer)) {
                    Ok(answer) => making.add(step, answer),
                    Err(fault) => return Err(self.ended(step, &making.frame, Some(term), fault)),
                }
                Ok(())
            }
            Says::If { condition, then, otherwise } => {
                let truth = self.evaluator.truth(condition, &making.frame);
                let truth =
                    truth.map_err(|f| self.ended(step, &making.frame, Some(condition), f))?;
                let branch = if truth { Some(then) } else { otherwise.as_ref() };
                let Some(branch) = branch else { return Ok(()) };
                self.branch(step, branch, making)
            }
            Says::Repeat { times, before, until, block } => {
                let mut turns = Vec::new();
                let outcome = self.repeat(step, (times, before, until), block, making, &mut turns);
                making.add(step, Answer::List(turns.into()));
                outcome
            }
            Says::Each { names, of, block } => {
                let mut turns = Vec::new();
                let outcome = self.each(step, (names, of), block, making, &mut turns);
                making.add(step, Answer::List(turns.into()));
                outcome
            }
            Says::Erase(names) => {
                names.iter().for_each(|name| making.erase(name));
                Ok(())
            }
            Says::Unclear => {
                let fault = Fault::wrong(UNCLEAR);
                Err(self.ended(step, &making.frame, None, fault))
            }
        }
    }

    /// Does a branch of an `if`: without a name, what it makes is made where the `if` stands.
    fn branch(
        &mut self,
        step: &'a Step,
        branch: &'a Block,
        making: &mut Making<'a>,
    ) -> std::result::Result<(), Ended> {
        self.enter(step, &making.frame)?;
        let outcome = if step.name.is_empty() {
            self.steps(branch, making)
        } else {
            self.way.push((&step.name, None));
            let mut inner = making.inside();
            let outcome = self.steps(branch, &mut inner);
            self.way.pop();
            let context = making.close(branch, inner);
            making.add(step, context);
            outcome
        };
        self.leave();
        outcome
    }

    fn repeat(
        &mut self,
        step: &'a Step,
        (times, before, until): (&'a Option<Term>, &'a Option<Term>, &'a Option<Term>),
        block: &'a Block,
        making: &mut Making<'a>,
        turns: &mut Vec<Answer<'a>>,
    ) -> std::result::Result<(), Ended> {
        let outside = making.frame.clone();
        let fails = |run: &Self, term: &'a Term, frame: &Frame<'a>, fault: Fault| {
            run.ended(step, frame, Some(term), fault)
        };
        let times = match times {
            None => None,
            Some(term) => {
                let n = self.evaluator.term(term, &outside).and_then(|n| self.evaluator.whole(&n));
                Some(n.map_err(|f| fails(self, term, &outside, f))?)
            }
        };
        let mut carried = self.firsts(step, block, &outside)?;
        // a loop that nothing ends is open, and takes one turn
        let is_open = times.is_none() && before.is_none() && until.is_none();
        while times.is_none_or(|n| (turns.len() as i64) < n) {
            let mut inner = making.inside();
            inner.begin(&block.carried, &carried);
            if let Some(term) = before {
                let goes_on = self.evaluator.truth(term, &inner.frame);
                if !goes_on.map_err(|f| fails(self, term, &inner.frame, f))? {
                    break;
                }
            }
            let outcome = self.turn(step, block, turns.len(), &mut inner);
            let frame = inner.frame.clone();
            turns.push(making.close(block, inner));
            outcome?;
            let ends = match until {
                Some(term) => {
                    let ends = self.evaluator.truth(term, &frame);
                    ends.map_err(|f| fails(self, term, &frame, f))?
                }
                None => is_open,
            };
            if ends {
                break;
            }
            if times.is_none_or(|n| (turns.len() as i64) < n) {
                carried = self.nexts(step, block, &frame, carried)?;
            }
        }
        Ok(())
    }

    fn each(
        &mut self,
        step: &'a Step,
        (names, of): (&'a [Name], &'a Term),
        block: &'a Block,
        making: &mut Making<'a>,
        turns: &mut Vec<Answer<'a>>,
    ) -> std::result::Result<(), Ended> {
        let outside = making.frame.clone();
        let set = self.evaluator.term(of, &outside).and_then(|set| self.evaluator.items(&set));
        let set = set.map_err(|f| self.ended(step, &outside, Some(of), f))?;
        let mut carried = self.firsts(step, block, &outside)?;
        for (i, element) in set.iter().enumerate() {
            let mut inner = making.inside();
            let parts = match names {
                [_] => Ok([element.clone()].into()),
                _ => self.evaluator.items(element).and_then(|parts| match parts.len() {
                    n if n == names.len() => Ok(parts),
                    n => Err(Fault::wrong(format!("{n} parts, where {} are named", names.len()))),
                }),
            };
            let parts = parts.map_err(|f| self.ended(step, &outside, Some(of), f))?;
            for (name, part) in names.iter().zip(parts.iter()) {
                inner.know(name, part.clone(), Standing::Carried);
            }
            inner.begin(&block.carried, &carried);
            let outcome = self.turn(step, block, i, &mut inner);
            let frame = inner.frame.clone();
            turns.push(making.close(block, inner));
            outcome?;
            carried = self.nexts(step, block, &frame, carried)?;
        }
        Ok(())
    }

    /// Does one turn of a loop.
    fn turn(
        &mut self,
        step: &'a Step,
        block: &'a Block,
        turn: usize,
        making: &mut Making<'a>,
    ) -> std::result::Result<(), Ended> {
        self.enter(step, &making.frame)?;
        let counted = self.evaluator.count_entity();
        counted.map_err(|fault| self.ended(step, &making.frame, None, fault))?;
        self.way.push((&step.name, Some(turn)));
        let outcome = self.steps(block, making);
        self.way.pop();
        self.leave();
        outcome
    }

    fn firsts(
        &self,
        step: &'a Step,
        block: &'a Block,
        frame: &Frame<'a>,
    ) -> std::result::Result<Vec<Answer<'a>>, Ended> {
        let first = |c: &'a Carried| {
            let answer = self.evaluator.term(&c.first, frame);
            answer.map_err(|f| self.ended(step, frame, Some(&c.first), f))
        };
        block.carried.iter().map(first).collect()
    }

    /// Computes what is carried into the next turn, all of it from this one.
    fn nexts(
        &self,
        step: &'a Step,
        block: &'a Block,
        frame: &Frame<'a>,
        carried: Vec<Answer<'a>>,
    ) -> std::result::Result<Vec<Answer<'a>>, Ended> {
        let next = |(c, now): (&'a Carried, Answer<'a>)| match &c.next {
            None => Ok(now),
            Some(term) => {
                let answer = self.evaluator.term(term, frame);
                answer.map_err(|f| self.ended(step, frame, Some(term), f))
            }
        };
        block.carried.iter().zip(carried).map(next).collect()
    }

    fn enter(&self, step: &'a Step, frame: &Frame<'a>) -> std::result::Result<(), Ended> {
        let depth = self.evaluator.blocks.get();
        if depth >= DEEPEST_BLOCKS {
            let message = format!("blocks run more than {DEEPEST_BLOCKS} deep in one another");
            let fault = Fault::new(FaultKind::Endless, message);
            return Err(self.ended(step, frame, None, fault));
        }
        self.evaluator.blocks.set(depth + 1);
        Ok(())
    }

    fn leave(&self) {
        self.evaluator.blocks.set(self.evaluator.blocks.get() - 1);
    }
}

impl<'a> Making<'a> {
    /// Begins a block in this one.
    fn inside(&self) -> Self {
        Self { frame: self.frame.clone(), made: Vec::new(), erased: Vec::new() }
    }
    /// Makes a name known.
    fn know(&mut self, name: &'a Name, answer: Answer<'a>, standing: Standing) {
        if !name.is_empty() {
            self.frame = self.frame.bind(name, answer.clone());
        }
        self.made.push(Entry { name: name.clone(), answer, standing });
    }
    fn add(&mut self, step: &'a Step, answer: Answer<'a>) {
        let standing = if step.is_guide { Standing::Guide } else { Standing::Result };
        self.know(&step.name, answer, standing);
    }
    /// Begins a turn with what is carried.
    fn begin(&mut self, carried: &'a [Carried], values: &[Answer<'a>]) {
        for (carried, value) in carried.iter().zip(values) {
            self.know(&carried.name, value.clone(), Standing::Carried);
        }
    }
    /// Takes what a step made out of the result.
    fn erase(&mut self, name: &Name) {
        match self.made.iter_mut().rev().find(|e| e.name == *name) {
            Some(entry) => entry.standing = Standing::Erased,
            None => self.erased.push(name.clone()),
        }
    }
    /// Ends a block in this one.
    fn close(&mut self, block: &'a Block, inner: Self) -> Answer<'a> {
        inner.erased.iter().for_each(|name| self.erase(name));
        let Self { made, .. } = inner;
        Answer::Context(Rc::new(Context { class: block.class, of: None, made, ended: None }))
    }
}
