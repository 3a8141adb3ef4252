//! The evaluator: a term and the thing that it is read in come in, its answer goes out.
//!
//! Straight recursion over terms. Depth and steps are bounded, so that no document can hang the lab
//! or overflow its stack; everything looked up by class and name is looked up once.

use crate::answer::{Answer, Closure, Frame};
use crate::fault::{Fault, FaultKind};
use crate::lookup::{Known, Tables};
use crate::programs::Context;
use crate::replay::Recording;
use crate::sway::Compared;
use base::Name;
use expr::dimension::Dimension;
use kernel::{
    Argument, ClassId, ClassKind, DOCUMENT, Document, Path, Primitive, SlotId, Step, Structure,
    Term, ThingId, Values,
};
use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// How deep messages may call each other.
pub const DEEPEST_MESSAGES: u32 = 200;
/// How deep terms may be nested in each other, those of opened messages included.
const DEEPEST_TERMS: u32 = 1000;
/// How many terms one question may evaluate: what a mistyped recursion may cost.
const MOST_TERMS: u64 = 10_000_000;
/// How many terms every question may evaluate, however many others ran out of them.
const LEAST_TERMS: u64 = 10_000;
/// From so many terms on a question remembers what messages answer: those that speak of each other twice are asked
/// for once.
const LONG: u64 = 100_000;
/// How many answers and slots that were read for them are remembered in one state: no more memory than that.
const MOST_REMEMBERED: u64 = 1_000_000;
/// How many terms the rule of a constraint may evaluate: one that opens into more than a million is not
/// solved anyway.
const MOST_TERMS_OF_RULE: u64 = 2_000_000;
/// What a text asks of the numbers in it.
const SHOWN: &str = "shown";
/// How many elements a range may have.
const LONGEST_RANGE: f64 = 1_000_000.0;

pub(crate) type Result<T> = std::result::Result<T, Fault>;

/// What a message answered, and the slots that were read for it.
type Remembered<'a> = (Answer<'a>, BTreeSet<SlotId>);

/// An argument with its label, evaluated.
pub(crate) type Given<'a> = (Option<&'a Name>, Answer<'a>);

/// Computes the value of any expression on the things of a document in one state.
///
/// Terms must live as long as the evaluator; those of the document do.
#[derive(Debug)]
pub struct Evaluator<'a> {
    /// The classes.
    pub document: &'a Document,
    /// The things.
    pub structure: &'a Structure,
    /// What is in their slots.
    pub values: &'a Values,
    pub(crate) tables: Rc<Tables>,
    pub(crate) messages: Cell<u32>,
    pub(crate) terms: Cell<u32>,
    pub(crate) fuel: Cell<u64>,
    /// How much fuel a question gets: half as much after each that ran out, so that all of them together end soon.
    pub(crate) most: Cell<u64>,
    /// Whether the question at hand may remember what messages answer: what tests a rule looks at each comparison.
    pub(crate) may_remember: Cell<bool>,
    /// What messages without arguments answered, by the thing and where the message is, and what they read.
    pub(crate) remembered: RefCell<BTreeMap<(ThingId, usize), Remembered<'a>>>,
    /// How much more may be remembered.
    pub(crate) left_to_remember: Cell<u64>,
    /// What went wrong in parts whose siblings went on without them.
    pub(crate) faults: RefCell<Vec<Fault>>,
    /// The slots read since someone began to listen.
    pub(crate) reads: RefCell<Option<BTreeSet<SlotId>>>,
    /// A slot whose number is read as another one.
    pub(crate) nudged: Cell<Option<(SlotId, f64)>>,
    /// What is known of the comparisons of a rule, in the order in which they are made.
    pub(crate) compared: RefCell<Compared>,
    /// What programs of things drew in this state; nothing while one is being run.
    pub(crate) runs: RefCell<BTreeMap<ThingId, Option<Rc<Context<'a>>>>>,
    /// Of each program that is being drawn what its names stand for so far.
    pub(crate) drawing: RefCell<Vec<Frame<'a>>>,
    /// The run that is being noted.
    pub(crate) recording: RefCell<Option<Recording>>,
    /// How many programs call each other just now.
    pub(crate) calls: Cell<u32>,
    /// How many blocks of programs run in one another just now.
    pub(crate) blocks: Cell<u32>,
    /// How many things the run at hand has made.
    pub(crate) entities: Cell<u32>,
}

impl<'a> Evaluator<'a> {
    /// Makes an evaluator for one state. Of what programs draw it asks the interpreter alone: the reference.
    pub fn new(document: &'a Document, structure: &'a Structure, values: &'a Values) -> Self {
        Self::with_tables(document, structure, values, Rc::new(Tables::new(document)))
    }

    /// Makes an evaluator for a state of things of which something was looked up before, and of
    /// whose programs runs are known. `known` belongs to this document and this structure.
    pub fn knowing(
        document: &'a Document,
        structure: &'a Structure,
        values: &'a Values,
        known: &Known,
    ) -> Self {
        Self::with_tables(document, structure, values, known.tables(document))
    }

    /// Makes an evaluator for another state of the same things; what was looked up stays known.
    pub fn in_state<'b>(&self, values: &'b Values) -> Evaluator<'b>
    where
        'a: 'b,
    {
        Evaluator::with_tables(self.document, self.structure, values, self.tables.clone())
    }

    pub(crate) fn with_tables(
        document: &'a Document,
        structure: &'a Structure,
        values: &'a Values,
        tables: Rc<Tables>,
    ) -> Self {
        Self {
            document,
            structure,
            values,
            tables,
            messages: Cell::new(0),
            terms: Cell::new(0),
            fuel: Cell::new(MOST_TERMS),
            most: Cell::new(MOST_TERMS),
            may_remember: Cell::new(true),
            remembered: RefCell::default(),
            left_to_remember: Cell::new(MOST_REMEMBERED),
            faults: RefCell::new(Vec::new()),
            reads: RefCell::new(None),
            nudged: Cell::new(None),
            compared: RefCell::default(),
            runs: RefCell::default(),
            drawing: RefCell::default(),
            recording: RefCell::default(),
            calls: Cell::new(0),
            blocks: Cell::new(0),
            entities: Cell::new(0),
        }
    }

    /// Computes the value of a term in which `Me` is the thing `me`.
    ///
    /// # Errors
    /// Why it has none.
    pub fn evaluate(&self, term: &'a Term, me: ThingId) -> Result<Answer<'a>> {
        self.begin();
        self.term(term, &Frame::of(me))
    }

    /// Sends a message without arguments to a thing, or reads a part of it.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn ask(&self, thing: ThingId, name: &Name) -> Result<Answer<'a>> {
        self.begin();
        self.send(&Answer::Thing(thing), name, Vec::new(), None, thing)
    }

    /// Follows a path from the document, through what things answer too: `d.column[2].ring.radius`.
    ///
    /// # Errors
    /// A step that leads nowhere.
    pub fn at(&self, path: &Path) -> Result<Answer<'a>> {
        self.from(Answer::Thing(DOCUMENT), &path.0)
    }

    /// Follows steps from something that was answered.
    ///
    /// # Errors
    /// A step that leads nowhere.
    pub fn from(&self, at: Answer<'a>, steps: &[Step]) -> Result<Answer<'a>> {
        self.begin();
        steps.iter().try_fold(at, |at, step| match step {
            Step::Part(name) => self.send(&at, name, Vec::new(), None, DOCUMENT),
            Step::Index(i) => self.element(&at, &Answer::plain(f64::from(*i))),
            Step::Last => self.send(&at, &Name::new("last"), Vec::new(), None, DOCUMENT),
            Step::Owner => self.owner(&at),
        })
    }

    /// Asks something, and returns the slots that were read for the answer too.
    pub fn listening<T>(&self, ask: impl FnOnce() -> T) -> (T, BTreeSet<SlotId>) {
        let before = self.reads.replace(Some(BTreeSet::new()));
        let answer = ask();
        let reads = self.reads.replace(before).unwrap_or_default();
        if let Some(outer) = &mut *self.reads.borrow_mut() {
            outer.extend(&reads);
        }
        (answer, reads)
    }

    /// Asks something as if another number stood in a slot.
    pub(crate) fn nudging<T>(&self, slot: SlotId, number: f64, ask: impl FnOnce() -> T) -> T {
        let before = self.nudged.replace(Some((slot, number)));
        // there messages answer something else
        let (remembered, left) = (self.remembered.take(), self.left_to_remember.get());
        let answer = ask();
        self.nudged.set(before);
        self.remembered.replace(remembered);
        self.left_to_remember.set(left);
        answer
    }

    /// Returns how many terms the latest question evaluated.
    pub fn steps(&self) -> u64 {
        self.most.get().saturating_sub(self.fuel.get())
    }

    /// Begins another question, with fuel of its own.
    pub(crate) fn begin(&self) {
        self.messages.set(0);
        self.terms.set(0);
        self.fuel.set(self.most.get());
        self.may_remember.set(true);
    }

    /// Begins the test of a constraint.
    pub(crate) fn begin_rule(&self) {
        self.begin();
        self.fuel.set(MOST_TERMS_OF_RULE.min(self.most.get()));
        self.may_remember.set(false);
    }

    /// Returns true where a question has taken long, and no program is being drawn.
    pub(crate) fn remembers(&self) -> bool {
        self.may_remember.get()
            && self.steps() > LONG
            && self.recording.borrow().is_none()
            && self.drawing.borrow().is_empty()
    }

    /// Computes the value of a term.
    pub(crate) fn term(&self, term: &'a Term, frame: &Frame<'a>) -> Result<Answer<'a>> {
        self.burn()?;
        let depth = self.terms.get();
        if depth >= DEEPEST_TERMS {
            let message = format!("an expression nested more than {DEEPEST_TERMS} deep");
            return Err(Fault::new(FaultKind::Endless, message));
        }
        self.terms.set(depth + 1);
        let answer = self.term_here(term, frame);
        self.terms.set(depth);
        answer
    }

    fn term_here(&self, term: &'a Term, frame: &Frame<'a>) -> Result<Answer<'a>> {
        match term {
            Term::Number { value, dimension, .. } => Ok(Answer::Number(*value, *dimension)),
            Term::Text(text) => Ok(Answer::text(text)),
            Term::Bool(b) => Ok(Answer::Bool(*b)),
            Term::Option(class, at) => Ok(Answer::Option(*class, *at)),
            Term::Me => Ok(frame.me.clone()),
            Term::Owner => self.owner(&frame.me),
            Term::Document => Ok(Answer::Thing(DOCUMENT)),
            Term::Local(name) => frame.local(name).cloned().ok_or_else(|| {
                Fault::new(FaultKind::Unnamed, format!("nothing is named `{name}` here"))
            }),
            Term::Class(class) => {
                let name = &self.document.classes[*class].name;
                Err(Fault::wrong(format!("the class {name} itself is no value")))
            }
            Term::Construct { what, class, of } => {
                let of: Result<Vec<_>> = of.iter().map(|t| self.term(t, frame)).collect();
                self.construct(*what, *class, &of?, frame.nearest)
            }
            Term::Send { to, name, arguments, .. } if let Term::Class(class) = **to => {
                let arguments = self.arguments(arguments, frame)?;
                self.send_to_class(class, name, arguments, frame.nearest)
            }
            Term::Send { to: of, name, arguments, search } => {
                let to = self.term(of, frame)?;
                let mut arguments = self.arguments(arguments, frame)?;
                if name == SHOWN && matches!(to, Answer::Number(..)) {
                    self.say_unit(of, frame, &mut arguments);
                }
                self.send(&to, name, arguments, *search, frame.nearest)
            }
            Term::Call { name, arguments } => {
                let arguments = self.arguments(arguments, frame)?;
                self.call(name, &arguments, frame.nearest)
            }
            Term::Make { class, arguments } => {
                let arguments = self.arguments(arguments, frame)?;
                let made = self.make(*class, &arguments, frame.nearest)?;
                self.called(made, frame.nearest)
            }
            Term::Step(name) => self.step(&frame.me, name, frame.nearest),
            Term::Result => self.result(&frame.me, frame.nearest),
            Term::Tuple(items) | Term::List(items) => {
                let items: Result<_> = items.iter().map(|t| self.term(t, frame)).collect();
                self.list(items?)
            }
            Term::Range(from, to) => {
                let from = self.term(from, frame)?;
                let to = self.term(to, frame)?;
                self.range(&from, &to)
            }
            Term::Index(list, index) if let Term::Range(from, to) = &**list => {
                let ends = [self.term(from, frame)?, self.term(to, frame)?];
                let index = self.term(index, frame)?;
                self.element_of_range(&ends, &index)
            }
            Term::Index(list, index) => {
                let list = self.term(list, frame)?;
                let index = self.term(index, frame)?;
                self.element(&list, &index)
            }
            Term::Unary(operator, operand) => self.unary(*operator, &self.term(operand, frame)?),
            Term::Binary(operator, a, b) => {
                let a = self.term(a, frame)?;
                if let Some(decided) = self.decided(*operator, &a)? {
                    return Ok(decided);
                }
                let b = self.term(b, frame)?;
                self.binary(*operator, &a, &b)
            }
            Term::If(condition, then, otherwise) => {
                let branch = if self.truth(condition, frame)? { then } else { otherwise };
                self.term(branch, frame)
            }
            Term::Let(name, bound, body) => {
                let bound = self.term(bound, frame)?;
                self.term(body, &frame.bind(name, bound))
            }
            Term::Lambda(parameters, body) => {
                let frame = frame.clone();
                Ok(Answer::Function(Rc::new(Closure { parameters, body, frame })))
            }
            Term::IsA(thing, class) => {
                let thing = self.term(thing, frame)?;
                Ok(Answer::Bool(self.is_a(&thing, *class)))
            }
            Term::All(class) => Ok(Answer::List(self.all(*class)?)),
            Term::Copy(term) => self.term(term, frame),
            Term::OfConstraint { of, name, aspect } => {
                let of = self.term(of, frame)?;
                self.of_constraint(&of, name, *aspect)
            }
        }
    }

    /// Counts one more step of the question at hand.
    pub(crate) fn burn(&self) -> Result<()> {
        self.burn_several(1)
    }

    /// Counts so many steps more.
    pub(crate) fn burn_several(&self, steps: u64) -> Result<()> {
        match self.fuel.get().checked_sub(steps) {
            Some(left) => {
                self.fuel.set(left);
                Ok(())
            }
            None => {
                self.most.set((self.most.get() / 2).max(LEAST_TERMS));
                let message = String::from("too many steps without an end");
                Err(Fault::new(FaultKind::Endless, message))
            }
        }
    }

    /// Runs one message call deeper.
    pub(crate) fn deeper<T>(&self, run: impl FnOnce() -> Result<T>) -> Result<T> {
        let depth = self.messages.get();
        if depth >= DEEPEST_MESSAGES {
            let message = format!("messages call each other more than {DEEPEST_MESSAGES} deep");
            return Err(Fault::new(FaultKind::Endless, message));
        }
        self.messages.set(depth + 1);
        let answer = run();
        self.messages.set(depth);
        answer
    }

    pub(crate) fn owner(&self, me: &Answer<'a>) -> Result<Answer<'a>> {
        match me {
            Answer::Thing(t) => match self.structure.owner(*t) {
                Some(owner) => Ok(Answer::Thing(owner)),
                None => Err(Fault::wrong("the document is not a part of anything")),
            },
            other => Err(Fault::wrong(format!("{} has no owner", self.kind(other)))),
        }
    }

    pub(crate) fn arguments(
        &self,
        arguments: &'a [Argument],
        frame: &Frame<'a>,
    ) -> Result<Vec<Given<'a>>> {
        let value = |a: &'a Argument| Ok((a.label.as_ref(), self.term(&a.value, frame)?));
        arguments.iter().map(value).collect()
    }

    #[inline(never)]
    fn range(&self, from: &Answer<'a>, to: &Answer<'a>) -> Result<Answer<'a>> {
        let (from, to) = (self.whole(from)?, self.whole(to)?);
        if (to - from) as f64 > LONGEST_RANGE {
            return Err(Fault::no_answer(format!("{from}..{to} has more than a million elements")));
        }
        self.burn_several(u64::try_from(to - from).unwrap_or(0))?;
        Ok(Answer::List((from..=to).map(|i| Answer::plain(i as f64)).collect()))
    }

    /// Answers an element of a range by itself: that is none of its other elements.
    fn element_of_range(&self, ends: &[Answer<'a>; 2], index: &Answer<'a>) -> Result<Answer<'a>> {
        let [from, to, index] = [self.whole(&ends[0])?, self.whole(&ends[1])?, self.whole(index)?];
        if index < 0 || index > to - from {
            let n = (to - from + 1).max(0);
            let message = format!("there is no element {index} in a list of {n}");
            return Err(Fault::no_answer(message));
        }
        Ok(Answer::plain((from + index) as f64))
    }

    /// Reads a whole number; one that is off by rounding alone, as 600 mm by 200 mm is, is one.
    pub(crate) fn whole(&self, answer: &Answer<'a>) -> Result<i64> {
        let (x, _) = self.operand(answer)?;
        let x = self.fixed_number(x);
        let whole = x.round();
        if (x - whole).abs() <= base::number::ROUNDING * x.abs() && x.abs() < 1e15 {
            Ok(whole as i64)
        } else {
            let x = base::number::shortest(x);
            Err(Fault::no_answer(format!("{x} where a whole number is wanted")))
        }
    }

    #[inline(never)]
    fn element(&self, list: &Answer<'a>, index: &Answer<'a>) -> Result<Answer<'a>> {
        let index = self.whole(index)?;
        let missing =
            |n: usize| Fault::no_answer(format!("there is no element {index} in a list of {n}"));
        let at = usize::try_from(index).ok();
        if let Answer::Thing(t) = list
            && matches!(self.class_kind(*t), ClassKind::List(_))
        {
            let mut parts = self.structure.parts(*t);
            let n = parts.len();
            return self.part(at.and_then(|i| parts.nth(i)).ok_or_else(|| missing(n))?);
        }
        let items = self.items(list)?;
        at.and_then(|i| items.get(i)).cloned().ok_or_else(|| missing(items.len()))
    }

    /// Returns the elements of a list or set.
    pub(crate) fn items(&self, answer: &Answer<'a>) -> Result<Rc<[Answer<'a>]>> {
        match answer {
            Answer::List(items) => Ok(items.clone()),
            Answer::Context(context) => Ok(context.result().map(|e| e.answer.clone()).collect()),
            Answer::Thing(t) => match self.class_kind(*t) {
                ClassKind::List(_) => {
                    let parts = self.structure.parts(*t);
                    self.burn_several(parts.len() as u64)?;
                    parts.map(|p| self.part(p)).collect()
                }
                ClassKind::Set(_) => {
                    let members = self.structure.sets.get(&self.structure.merged[*t]);
                    self.burn_several(members.map_or(0, |set| set.len() as u64))?;
                    members.into_iter().flatten().map(|&m| self.part(m)).collect()
                }
                ClassKind::Primitive(_) | ClassKind::Composite | ClassKind::Reference(_) => {
                    Err(Fault::wrong(format!("{} where a list is wanted", self.kind(answer))))
                }
            },
            other => Err(Fault::wrong(format!("{} where a list is wanted", self.kind(other)))),
        }
    }

    /// Returns what is stored in a part, or the part itself where it has parts.
    pub(crate) fn part(&self, thing: ThingId) -> Result<Answer<'a>> {
        match self.structure.slot_of(thing) {
            Some(slot) => Ok(self.stored(slot)),
            None => match self.class_kind(thing) {
                ClassKind::Reference(_) => match self.structure.referent(thing) {
                    same if same == thing => Err(self.names_nothing(thing)),
                    target => self.part(target),
                },
                ClassKind::Primitive(_)
                | ClassKind::Composite
                | ClassKind::List(_)
                | ClassKind::Set(_) => Ok(Answer::Thing(thing)),
            },
        }
    }

    /// Returns what is stored in a slot.
    pub(crate) fn stored(&self, slot: SlotId) -> Answer<'a> {
        if let Some(reads) = &mut *self.reads.borrow_mut() {
            reads.insert(slot);
        }
        let number = match self.nudged.get() {
            Some((nudged, number)) if nudged == slot => number,
            Some(_) | None => self.slot_number(slot, self.values.numbers[slot]),
        };
        match self.structure.slots[slot].primitive {
            Primitive::Real(dimension) => Answer::Number(number, dimension),
            Primitive::Integer => Answer::plain(number),
            Primitive::Bool => Answer::Bool(self.fixed_number(number) != 0.0),
            Primitive::Choice(of) => Answer::Option(of, self.fixed_number(number) as u32),
            Primitive::Text | Primitive::Color => {
                let text = self.values.texts.get(&slot);
                self.slot_text(slot, text.map_or("", |text| text));
                text.map_or_else(|| Answer::text(""), |text| Answer::Text(text.clone()))
            }
        }
    }

    pub(crate) fn is_a(&self, answer: &Answer<'a>, class: ClassId) -> bool {
        let is = |c: ClassId| self.document.is_a(c, class);
        match answer {
            Answer::Thing(t) => {
                let is = |t: ThingId| is(self.structure.things[t].class);
                is(*t) || self.structure.unlike(*t).iter().any(|&t| is(t))
            }
            Answer::Made(made) => is(made.class),
            Answer::Context(context) => is(context.class),
            Answer::Number(..) => match self.document.classes[class].kind {
                ClassKind::Primitive(p) => {
                    p.is_number() && !matches!(p, Primitive::Bool | Primitive::Choice(_))
                }
                ClassKind::Composite
                | ClassKind::List(_)
                | ClassKind::Set(_)
                | ClassKind::Reference(_) => false,
            },
            Answer::Bool(_) => {
                self.document.classes[class].kind == ClassKind::Primitive(Primitive::Bool)
            }
            Answer::Option(of, _) => *of == class,
            Answer::Text(_) => {
                self.document.classes[class].kind == ClassKind::Primitive(Primitive::Text)
            }
            Answer::List(_) | Answer::Picture(_) | Answer::Function(_) => false,
        }
    }

    /// Says what a value is, by its class where it has one.
    pub(crate) fn kind(&self, answer: &Answer<'a>) -> String {
        let class = |c: ClassId| {
            let name = &self.document.classes[self.document.named_class(c)].name;
            if name.is_empty() { "the document".to_string() } else { format!("a {name}") }
        };
        match answer {
            Answer::Thing(t) => class(self.structure.things[*t].class),
            Answer::Made(made) => class(made.class),
            Answer::Context(context) => class(context.class),
            Answer::Option(of, _) => class(*of),
            other => other.kind().to_string(),
        }
    }

    /// Reads a number as it is.
    pub(crate) fn number(&self, answer: &Answer<'a>) -> Result<(f64, Dimension)> {
        match self.operand(answer) {
            Ok((x, _)) if x.is_nan() => Err(Fault::wrong("what is made of a number is no number")),
            read => read,
        }
    }

    /// Computes a truth value.
    pub(crate) fn truth(&self, term: &'a Term, frame: &Frame<'a>) -> Result<bool> {
        self.truth_of(&self.term(term, frame)?)
    }

    pub(crate) fn truth_of(&self, answer: &Answer<'a>) -> Result<bool> {
        match answer {
            Answer::Bool(b) => Ok(*b),
            other => {
                Err(Fault::wrong(format!("{} where a truth value is wanted", self.kind(other))))
            }
        }
    }
}
