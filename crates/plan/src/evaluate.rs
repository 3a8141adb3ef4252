//! Symbolic evaluation: a term in, its [`Meaning`] out.
//!
//! Messages and virtual parts are opened into their definitions, lists are expanded, conditions
//! become selections. Values are looked at where they decide how many there are or what a program draws alone, and
//! what they decide is noted: everything else serves every state.

use crate::counting::whole;
use crate::course::Decision;
use crate::fault::{FaultKind, Trouble};
use crate::meaning::{Closure, Drawn, Frame, Meaning, Opaque, collect_slots};
use crate::reach::Reach;
use base::Name;
use expr::{Arena, ExprId, Node, Unary, Var};
use kernel::builtin::is_of_each;
use kernel::{
    Argument, Aspect, BinaryOperator, ClassId, ClassKind, Document, Message, Search, Setting,
    SlotId, Structure, Term, ThingId, UnaryOperator, Values,
};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// How deep messages may call each other.
const DEEPEST: u32 = 200;
/// How deep terms may be nested, those that messages open into included: what the stack holds.
const DEEPEST_TERMS: u32 = 1000;
/// How many terms one rule may open into: what a mistyped recursion may cost.
const MOST_TERMS: u32 = 1_000_000;
/// How many terms every rule may open into, however many others ran away.
const LEAST_TERMS: u32 = 10_000;

/// How many nodes most rules open into at most.
const NODES: usize = 28;

/// An argument with its label, evaluated.
pub(crate) type Given<'a> = (Option<Name>, Meaning<'a>);

/// A meaning, or why there is none.
pub(crate) type Answer<'a> = Result<Meaning<'a>, Trouble>;

/// The context of symbolic evaluation.
pub(crate) struct Opening<'a> {
    pub(crate) document: &'a Document,
    /// The structure, for what follows from the class of a thing; the rest is asked of `reach`.
    pub(crate) structure: &'a Structure,
    pub(crate) reach: Reach<'a>,
    /// The expressions of the rule at hand.
    pub(crate) arena: Arena,
    /// The state whose courses programs take; nothing where only the host shall know what they draw.
    pub(crate) at: Option<&'a Values>,
    /// What programs of things draw, as far as the rule at hand asked; nothing while that is being found.
    pub(crate) drawn: BTreeMap<ThingId, Option<Rc<Drawn<'a>>>>,
    /// Of each program that is being opened what its names stand for so far.
    pub(crate) opened: Vec<Frame<'a>>,
    /// What was decided on the way.
    pub(crate) decisions: Vec<Decision>,
    /// Whole numbers that count something in the rule at hand: they are as they stand.
    pub(crate) counted: BTreeMap<SlotId, f64>,
    /// The same of the next rule, where that is known before it is opened.
    pub(crate) known_counts: BTreeMap<SlotId, f64>,
    /// True if the rule at hand speaks of as many as a value says.
    pub(crate) meets_counts: bool,
    /// True if the rule at hand speaks of as many as a value says, and there is no state that has one.
    pub(crate) awaits_count: bool,
    /// True once a rule spoke of what a program draws, or of as many as a value says.
    pub(crate) has_courses: bool,
    depth: u32,
    nested: u32,
    terms: u32,
    /// How many terms a rule may open into: half as many after each that ran away, so that all of them together end soon.
    most_terms: u32,
}

impl<'a> Opening<'a> {
    /// Says that a list has no such element.
    fn missing_element(&self, list: &Meaning<'_>, count: usize, index: i64) -> Trouble {
        let Meaning::Thing(list) = list else {
            return Trouble::wrong(format!("there is no element {index} in a list of {count}"));
        };
        let path = self.structure.path(self.document, *list);
        let elements = match count {
            0 => {
                return Trouble::wrong(format!(
                    "{path} has no elements: there is no {path}[{index}]; how many it has is said where it is declared, \
                     `List of 3 …`"
                ));
            }
            1 => "1 element, [0] alone".to_string(),
            n => format!("{n} elements, [0] to [{}]", n - 1),
        };
        Trouble::wrong(format!(
            "{path} has {elements}: there is no {path}[{index}]; \
             they are counted from 0, and `{path}.last` is {path}[{}]",
            count - 1
        ))
    }

    pub(crate) fn new(document: &'a Document, structure: &'a Structure) -> Self {
        let reach = Reach::new(structure);
        Self {
            document,
            structure,
            reach,
            arena: Arena::new(),
            at: None,
            drawn: BTreeMap::new(),
            opened: Vec::new(),
            decisions: Vec::new(),
            counted: BTreeMap::new(),
            known_counts: BTreeMap::new(),
            meets_counts: false,
            awaits_count: false,
            has_courses: false,
            depth: 0,
            nested: 0,
            terms: 0,
            most_terms: MOST_TERMS,
        }
    }

    /// Finds what a term stands for.
    pub(crate) fn meaning(&mut self, term: &'a Term, frame: &Frame<'a>) -> Answer<'a> {
        self.count_term()?;
        if self.nested >= DEEPEST_TERMS {
            let message = format!("an expression nested more than {DEEPEST_TERMS} deep");
            return Err(Trouble::new(FaultKind::Endless, message));
        }
        self.nested += 1;
        let meaning = self.open_term(term, frame);
        self.nested -= 1;
        meaning
    }

    fn open_term(&mut self, term: &'a Term, frame: &Frame<'a>) -> Answer<'a> {
        match term {
            Term::Number { value, .. } => Ok(self.number(*value)),
            Term::Text(_) => Ok(Meaning::Opaque(Opaque::default())),
            Term::Bool(b) => Ok(self.number(f64::from(u8::from(*b)))),
            Term::Option(_, at) => Ok(self.number(f64::from(*at))),
            Term::Me => Ok(frame.me.clone()),
            Term::Owner => self.owner(&frame.me),
            Term::Document => Ok(Meaning::Thing(self.reach.document())),
            Term::Local(name) => frame.local(name).ok_or_else(|| {
                Trouble::new(FaultKind::UnknownName, format!("nothing is named `{name}` here"))
            }),
            Term::Class(class) => Err(self.no_value(*class)),
            Term::Construct { what, class, of } => {
                let of: Result<Vec<_>, _> = of.iter().map(|t| self.meaning(t, frame)).collect();
                self.construct(*what, *class, &of?)
            }
            Term::Send { to, name, arguments, .. } if let Term::Class(class) = **to => {
                let arguments = self.arguments(arguments, frame)?;
                self.send_to_class(class, name, &arguments, frame)
            }
            Term::Send { to, name, arguments, search } => {
                let to = self.meaning(to, frame)?;
                let arguments = self.arguments(arguments, frame)?;
                self.send(&to, name, &arguments, *search)
            }
            Term::Call { name, arguments } => {
                let arguments = self.arguments(arguments, frame)?;
                self.call(name, &arguments)
            }
            Term::Make { class, arguments } => {
                let arguments = self.arguments(arguments, frame)?;
                self.drawn_with(*class, &arguments)
            }
            Term::Tuple(items) | Term::List(items) => {
                let items: Result<Vec<_>, _> =
                    items.iter().map(|t| self.meaning(t, frame)).collect();
                Ok(Meaning::List(items?.into()))
            }
            Term::Range(from, to) => {
                let ends = [self.meaning(from, frame)?, self.meaning(to, frame)?];
                self.range(&ends)
            }
            Term::Index(list, index) => self.indexed(list, index, frame),
            Term::Unary(operator, operand) => {
                let operand = self.meaning(operand, frame)?;
                let operator = match operator {
                    UnaryOperator::Negate => Unary::Neg,
                    UnaryOperator::Not => Unary::Not,
                };
                self.unary(operator, &operand)
            }
            Term::Binary(operator, a, b) => {
                let a = self.meaning(a, frame)?;
                let b = self.meaning(b, frame)?;
                self.binary(*operator, &a, &b)
            }
            Term::If(condition, then, otherwise) => {
                let condition = self.meaning(condition, frame)?;
                match self.decided(&condition) {
                    Some(true) => self.meaning(then, frame),
                    Some(false) => self.meaning(otherwise, frame),
                    None => {
                        let then = self.meaning(then, frame)?;
                        let otherwise = self.meaning(otherwise, frame)?;
                        self.select(&condition, &then, &otherwise)
                    }
                }
            }
            Term::Let(name, bound, body) => {
                let bound = self.meaning(bound, frame)?;
                self.meaning(body, &frame.bind(name.clone(), bound))
            }
            Term::Lambda(parameters, body) => {
                let frame = frame.clone();
                Ok(Meaning::Lambda(Rc::new(Closure { parameters, body, frame })))
            }
            Term::IsA(thing, class) => {
                let thing = self.meaning(thing, frame)?;
                let is = self.is_a(&thing, *class);
                Ok(self.number(f64::from(u8::from(is))))
            }
            Term::All(class) => self.all(*class),
            Term::Copy(term) => self.meaning(term, frame),
            Term::Step(name) => self.step(&frame.me, name),
            Term::Result => self.result(&frame.me),
            Term::OfConstraint { of, name, aspect } => {
                let of = self.meaning(of, frame)?;
                self.of_constraint(&of, name, *aspect)
            }
        }
    }

    /// Answers an element of a list; where the index follows from numbers, whichever it says.
    fn indexed(&mut self, list: &'a Term, index: &'a Term, frame: &Frame<'a>) -> Answer<'a> {
        let list = self.meaning(list, frame)?;
        if let Meaning::Opaque(_) = list {
            let at = self.meaning(index, frame)?;
            return Ok(self.opaque([&list, &at]));
        }
        let count = self.count(&list)?;
        let at = self.meaning(index, frame)?;
        let Some(index) = self.constant(&at) else {
            return self.chosen(&list, count, &at);
        };
        let index = whole(index).ok_or_else(|| Trouble::wrong("an index is a whole number"))?;
        match usize::try_from(index).ok().filter(|&i| i < count) {
            Some(i) => self.item(&list, i),
            None => Err(self.missing_element(&list, count, index)),
        }
    }

    fn no_value(&self, class: ClassId) -> Trouble {
        let name = &self.document.classes[class].name;
        Trouble::wrong(format!("the class {name} itself is no value"))
    }

    /// Answers what is asked of a constraint of a thing.
    fn of_constraint(&mut self, of: &Meaning<'a>, name: &Name, aspect: Aspect) -> Answer<'a> {
        let missing = || Trouble::wrong(format!("there is no constraint `{name}` here"));
        let Meaning::Thing(thing) = of else { return Err(missing()) };
        self.reach.looks_around();
        let document = self.document;
        let named = self.structure.constraint_named(document, *thing, name);
        let instance = named.ok_or_else(missing)?;
        let constraint = &document.classes[instance.class].constraints[instance.index as usize];
        let frame = Frame::of(instance.owner);
        match (aspect, &*constraint.rule) {
            (Aspect::Error, Term::Binary(BinaryOperator::Equal, a, b)) => self.deeper(|o| {
                let (a, b) = (o.meaning(a, &frame)?, o.meaning(b, &frame)?);
                o.binary(BinaryOperator::Subtract, &a, &b)
            }),
            (Aspect::Error, Term::Binary(operator, a, b)) if operator.is_order() => {
                self.deeper(|o| {
                    let (a, b) = (o.meaning(a, &frame)?, o.meaning(b, &frame)?);
                    let holds = o.binary(*operator, &a, &b)?;
                    let apart = o.binary(BinaryOperator::Subtract, &a, &b)?;
                    let nothing = o.number(0.0);
                    o.select(&holds, &nothing, &apart)
                })
            }
            (Aspect::Error, _) => {
                let message = "the error of a rule that is no equality is not planned yet";
                Err(Trouble::not_yet(message))
            }
            (Aspect::Satisfied, rule) => self.deeper(|o| o.meaning(rule, &frame)),
            (Aspect::Strength, _) => Ok(Meaning::Opaque(Opaque::default())),
            (Aspect::Enabled, _) if self.structure.conditions.contains_key(&instance) => {
                let condition = self.structure.conditions[&instance];
                match &condition.switch(document).setting {
                    Setting::Enabled(term) => {
                        self.deeper(|o| o.meaning(term, &Frame::of(condition.me)))
                    }
                    Setting::Strength(_) => Ok(self.number(1.0)),
                }
            }
            (Aspect::Enabled, _) => {
                let is_on = self.structure.is_on(instance);
                Ok(self.number(f64::from(u8::from(is_on))))
            }
        }
    }

    /// Counts one more term of the rule at hand.
    pub(crate) fn count_term(&mut self) -> Result<(), Trouble> {
        self.terms += 1;
        if self.terms > self.most_terms {
            let message = match self.most_terms {
                MOST_TERMS => "it opens into more than a million terms".to_string(),
                most => {
                    format!("it opens into more than {most} terms, behind others without an end")
                }
            };
            self.most_terms = (self.most_terms / 2).max(LEAST_TERMS);
            return Err(Trouble::new(FaultKind::Endless, message));
        }
        Ok(())
    }

    /// Begins another rule: with no expression, so that it is stated alike wherever it stands.
    pub(crate) fn begin(&mut self, owner: ThingId) {
        self.reach.begin(owner);
        self.arena = Arena::for_nodes(NODES);
        self.drawn.clear();
        self.opened.clear();
        self.decisions.clear();
        self.counted.clear();
        (self.awaits_count, self.meets_counts) = (false, false);
        self.terms = 0;
        self.depth = 0;
        self.nested = 0;
        self.take_known_counts();
    }

    pub(crate) fn number(&mut self, value: f64) -> Meaning<'a> {
        Meaning::Number(self.arena.constant(value))
    }

    pub(crate) fn owner(&mut self, me: &Meaning<'a>) -> Answer<'a> {
        match me {
            Meaning::Thing(t) => match self.reach.owner(*t) {
                Some(owner) => Ok(Meaning::Thing(owner)),
                None => Err(Trouble::wrong("the document is not a part of anything")),
            },
            other => Err(Trouble::wrong(format!("{} has no owner", kind(other)))),
        }
    }

    /// Evaluates the arguments of a message.
    pub(crate) fn arguments(
        &mut self,
        arguments: &'a [Argument],
        frame: &Frame<'a>,
    ) -> Result<Vec<Given<'a>>, Trouble> {
        arguments.iter().map(|a| Ok((a.label.clone(), self.meaning(&a.value, frame)?))).collect()
    }

    /// Returns the element that a number chooses: one after the other, each where the number is its place. Beyond them
    /// there is none, which of numbers is a division by zero.
    fn chosen(&mut self, list: &Meaning<'a>, count: usize, at: &Meaning<'a>) -> Answer<'a> {
        let items = (0..count).map(|i| self.item(list, i)).collect::<Result<Vec<_>, _>>()?;
        let is_plain = |item: &Meaning<'a>| matches!(item, Meaning::Number(_) | Meaning::Opaque(_));
        let are_plain = !items.is_empty() && items.iter().all(is_plain);
        if let (true, Meaning::Opaque(_)) = (are_plain, at) {
            return Ok(self.opaque(items.iter().chain([at])));
        }
        if !are_plain || !matches!(at, Meaning::Number(_)) {
            let message = "an index of things that depends on values is not planned yet";
            return Err(Trouble::not_yet(message));
        }
        let (one, zero) = (self.number(1.0), self.number(0.0));
        let mut chosen = self.binary(BinaryOperator::Divide, &one, &zero)?;
        for (i, item) in items.iter().enumerate().rev() {
            let place = self.number(i as f64);
            let is_here = self.binary(BinaryOperator::Equal, at, &place)?;
            chosen = self.select(&is_here, item, &chosen)?;
        }
        Ok(chosen)
    }

    /// Returns the number that a meaning is, if it is one whatever the values are.
    pub(crate) fn constant(&self, meaning: &Meaning<'a>) -> Option<f64> {
        match meaning {
            Meaning::Number(id) => match self.arena.node(*id) {
                Node::Constant(bits) => Some(f64::from_bits(bits)),
                Node::Var(_) | Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
            },
            Meaning::Thing(_)
            | Meaning::Made(_)
            | Meaning::List(_)
            | Meaning::Opaque(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_) => None,
        }
    }

    /// Returns the truth value that a meaning is, if it is one whatever the values are.
    pub(crate) fn decided(&self, meaning: &Meaning<'a>) -> Option<bool> {
        self.constant(meaning).map(|x| x != 0.0)
    }

    /// Returns what is stored in a part, or the part itself where it has parts.
    pub(crate) fn part(&mut self, thing: ThingId) -> Answer<'a> {
        if let Some(slot) = self.reach.slot(thing) {
            if let Some(&count) = self.counted.get(&slot) {
                return Ok(self.number(count));
            }
            return Ok(if self.structure.slots[slot].primitive.is_number() {
                Meaning::Number(self.arena.var(Var(slot.0)))
            } else {
                Meaning::Opaque(Opaque::stored(slot))
            });
        }
        match self.document.classes[self.structure.things[thing].class].kind {
            ClassKind::Reference(_) => match self.reach.referent(thing) {
                Some(target) => self.part(target),
                None => {
                    let path = self.structure.path(self.document, thing);
                    Err(Trouble::new(FaultKind::Reference, format!("`{path}` names nothing")))
                }
            },
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::List(_)
            | ClassKind::Set(_) => Ok(Meaning::Thing(thing)),
        }
    }

    /// Sends a message, or reads a part.
    pub(crate) fn send(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Given<'a>],
        search: Option<Search>,
    ) -> Answer<'a> {
        if let Some(part) = self.stored_part(to, name, arguments, search)? {
            return Ok(part);
        }
        if !arguments.is_empty()
            && matches!(to, Meaning::List(_) | Meaning::Drawn(_))
            && is_of_each(name)
        {
            return self.each_in_set(to, name, arguments);
        }
        if let Some(combined) = self.combined(to, name, arguments, search)? {
            return Ok(combined);
        }
        if let Some(message) = self.message(to, name, search) {
            let frame = bind_arguments(Frame::new(to.clone()), message, arguments)?;
            return self.deeper(|opening| opening.meaning(&message.answer, &frame));
        }
        self.send_builtin(to, name, arguments)
    }

    /// Sends a message to a class itself, by its form.
    fn send_to_class(
        &mut self,
        class: ClassId,
        form: &Name,
        arguments: &[Given<'a>],
        frame: &Frame<'a>,
    ) -> Answer<'a> {
        let Some((_, message)) = self.document.find_message(class, form, None) else {
            let name = &self.document.classes[class].name;
            let message = format!("the class {name} answers no `{form}`");
            return Err(Trouble::new(FaultKind::UnknownName, message));
        };
        let frame = bind_arguments(Frame::new(frame.me.clone()), message, arguments)?;
        self.deeper(|opening| opening.meaning(&message.answer, &frame))
    }

    /// Lists what several superclasses say, where a message combines that.
    fn combined(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Given<'a>],
        search: Option<Search>,
    ) -> Result<Option<Meaning<'a>>, Trouble> {
        let &Meaning::Thing(thing) = to else { return Ok(None) };
        let class = self.structure.things[thing].class;
        if self.structure.layout(class).is_none_or(|l| l.superclasses.is_empty()) {
            return Ok(None);
        }
        let Some(voices) = self.document.voices(class, name, search) else { return Ok(None) };
        let mut said = Vec::new();
        if let Some(message) = voices.own {
            let frame = bind_arguments(Frame::new(to.clone()), message, arguments)?;
            said.push(self.deeper(|opening| opening.meaning(&message.answer, &frame))?);
        }
        let parts = self.reach.parts(thing);
        for part in voices.others.iter().filter_map(|&i| parts.get(i as usize)) {
            said.push(self.send(&Meaning::Thing(*part), name, arguments, None)?);
        }
        if said.len() < 2 {
            return Ok(said.pop());
        }
        let mut all = Vec::new();
        for meaning in said {
            match self.items(&meaning) {
                Ok(items) => all.extend(items.iter().cloned()),
                Err(_) => all.push(meaning),
            }
        }
        Ok(Some(Meaning::List(all.into())))
    }

    /// Reads a stored part, where the message is nothing else.
    fn stored_part(
        &mut self,
        to: &Meaning<'a>,
        name: &Name,
        arguments: &[Given<'a>],
        search: Option<Search>,
    ) -> Result<Option<Meaning<'a>>, Trouble> {
        if !arguments.is_empty() || search.is_some() {
            return Ok(None);
        }
        match to {
            Meaning::Thing(t) => match self.reach.part_named(*t, name) {
                Some(part) => self.part(part).map(Some),
                None => Ok(None),
            },
            Meaning::Made(made) => {
                Ok(made.fields.iter().find(|f| f.0 == *name).map(|f| f.1.clone()))
            }
            Meaning::Drawn(drawn) => match (drawn.step(name), &drawn.of) {
                (Some(meaning), _) => Ok(Some(meaning.clone())),
                (None, Some(of)) => self.stored_part(&of.clone(), name, arguments, search),
                (None, None) => Ok(None),
            },
            Meaning::Number(_) | Meaning::List(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => {
                Ok(None)
            }
        }
    }

    /// Finds the definition of a message, looking at everything that the thing is merged with.
    pub(crate) fn message(
        &self,
        to: &Meaning<'a>,
        name: &str,
        search: Option<Search>,
    ) -> Option<&'a Message> {
        let document = self.document;
        let find = |class| document.find_message(class, name, search).map(|found| found.1);
        match to {
            Meaning::Thing(t) => find(self.structure.things[*t].class).or_else(|| {
                let alike = self.structure.unlike(*t);
                alike.iter().find_map(|&t| find(self.structure.things[t].class))
            }),
            Meaning::Made(made) => find(made.class),
            Meaning::Drawn(drawn) => find(drawn.class),
            Meaning::Number(_) | Meaning::List(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => None,
        }
    }

    /// Runs one message call deeper.
    pub(crate) fn deeper<T>(
        &mut self,
        run: impl FnOnce(&mut Self) -> Result<T, Trouble>,
    ) -> Result<T, Trouble> {
        if self.depth >= DEEPEST {
            let message = format!("messages call each other more than {DEEPEST} deep");
            return Err(Trouble::new(FaultKind::Endless, message));
        }
        self.depth += 1;
        let answer = run(self);
        self.depth -= 1;
        answer
    }

    /// Calls a function of the language.
    pub(crate) fn apply(
        &mut self,
        function: &Meaning<'a>,
        arguments: &[Meaning<'a>],
    ) -> Answer<'a> {
        let Meaning::Lambda(closure) = function else {
            return Err(Trouble::wrong(format!("{} is not a function", kind(function))));
        };
        let frame = self.closure_frame(closure, arguments)?;
        self.deeper(|opening| opening.meaning(closure.body, &frame))
    }

    /// Binds the parameters of a function; one list serves several parameters.
    pub(crate) fn closure_frame(
        &mut self,
        closure: &Closure<'a>,
        arguments: &[Meaning<'a>],
    ) -> Result<Frame<'a>, Trouble> {
        let spread = match arguments {
            [one] if closure.parameters.len() > 1 => self.items(one)?,
            _ => arguments.into(),
        };
        if spread.len() != closure.parameters.len() {
            return Err(Trouble::wrong(format!(
                "a function of {} got {} arguments",
                closure.parameters.len(),
                spread.len()
            )));
        }
        let bind = |frame: Frame<'a>, (name, m): (&Name, &Meaning<'a>)| {
            frame.bind(name.clone(), m.clone())
        };
        Ok(closure.parameters.iter().zip(spread.iter()).fold(closure.frame.clone(), bind))
    }

    /// Returns the elements of a list, a set or a tuple.
    pub(crate) fn items(&mut self, list: &Meaning<'a>) -> Result<Rc<[Meaning<'a>]>, Trouble> {
        match list {
            Meaning::List(items) => Ok(items.clone()),
            Meaning::Thing(t) => {
                let things: Vec<ThingId> = match self.structure_kind(*t) {
                    ClassKind::List(_) => self.reach.parts(*t),
                    ClassKind::Set(_) => self.reach.members(*t),
                    ClassKind::Primitive(_) | ClassKind::Composite | ClassKind::Reference(_) => {
                        let class = self.structure.things[*t].class;
                        let name = &self.document.classes[class].name;
                        return Err(Trouble::wrong(format!("{name} is neither a list nor a set")));
                    }
                };
                let items: Result<Vec<_>, _> = things.into_iter().map(|t| self.part(t)).collect();
                Ok(items?.into())
            }
            Meaning::Drawn(drawn) => {
                let result = drawn.made.iter().filter(|e| e.is_result);
                Ok(result.map(|e| e.meaning.clone()).collect())
            }
            Meaning::Number(_) | Meaning::Made(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => {
                Err(Trouble::wrong(format!("{} is neither a list nor a set", kind(list))))
            }
        }
    }

    /// Returns the list that a meaning is, if it is one of the structure.
    fn stored_list(&self, list: &Meaning<'a>) -> Option<ThingId> {
        let &Meaning::Thing(thing) = list else { return None };
        matches!(self.structure_kind(thing), ClassKind::List(_)).then_some(thing)
    }

    /// Returns how many elements a list, a set or a tuple has.
    pub(crate) fn count(&mut self, list: &Meaning<'a>) -> Result<usize, Trouble> {
        match self.stored_list(list) {
            Some(list) => Ok(self.reach.count(list)),
            None => Ok(self.items(list)?.len()),
        }
    }

    /// Returns one element of a list, a set or a tuple that has so many, without a look at the others where
    /// it is stored.
    pub(crate) fn item(&mut self, list: &Meaning<'a>, at: usize) -> Answer<'a> {
        match self.stored_list(list) {
            Some(list) => {
                let element = self.reach.element(list, at);
                self.part(element)
            }
            None => Ok(self.items(list)?[at].clone()),
        }
    }

    fn structure_kind(&self, thing: ThingId) -> &'a ClassKind {
        &self.document.classes[self.structure.things[thing].class].kind
    }

    fn is_a(&self, meaning: &Meaning<'a>, class: ClassId) -> bool {
        match meaning {
            Meaning::Thing(t) => {
                let is = |t: ThingId| self.document.is_a(self.structure.things[t].class, class);
                self.structure.merged_with(*t).into_iter().any(is)
            }
            Meaning::Made(made) => self.document.is_a(made.class, class),
            Meaning::Drawn(drawn) => self.document.is_a(drawn.class, class),
            Meaning::Number(_) | Meaning::List(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => {
                false
            }
        }
    }

    fn all(&mut self, class: ClassId) -> Answer<'a> {
        self.reach.looks_around();
        let things = self.structure.all(self.document, class);
        Ok(Meaning::List(things.into_iter().map(|t| self.part(t)).collect::<Result<_, _>>()?))
    }

    /// Makes the meaning of something that only the host can compute from these.
    pub(crate) fn opaque<'m>(&self, from: impl IntoIterator<Item = &'m Meaning<'a>>) -> Meaning<'a>
    where
        'a: 'm,
    {
        let mut slots: BTreeSet<SlotId> = BTreeSet::new();
        from.into_iter().for_each(|m| collect_slots(&self.arena, m, &mut slots));
        Meaning::Opaque(Opaque::over(slots))
    }

    /// Wants a number that the planner can reason about.
    pub(crate) fn expression(&self, meaning: &Meaning<'a>) -> Result<ExprId, Trouble> {
        match meaning {
            Meaning::Number(id) => Ok(*id),
            other => Err(Trouble::wrong(format!("{} is not a number", kind(other)))),
        }
    }
}

/// Binds the parameters of a message to arguments, by label or by position.
pub(crate) fn bind_arguments<'a>(
    frame: Frame<'a>,
    message: &'a Message,
    arguments: &[Given<'a>],
) -> Result<Frame<'a>, Trouble> {
    if arguments.len() != message.parameters.len() {
        return Err(Trouble::wrong(format!(
            "`{}` takes {} arguments and got {}",
            message.name,
            message.parameters.len(),
            arguments.len()
        )));
    }
    let mut bound = frame;
    for (i, parameter) in message.parameters.iter().enumerate() {
        let labelled =
            arguments.iter().find(|a| a.0.as_ref().is_some_and(|l| *l == parameter.label));
        let argument =
            labelled.or_else(|| arguments.get(i).filter(|a| a.0.is_none())).ok_or_else(|| {
                Trouble::wrong(format!("`{}` wants `{}`", message.name, parameter.label))
            })?;
        bound = bound.bind(parameter.name.clone(), argument.1.clone());
    }
    Ok(bound)
}

/// Names the kind of a meaning, for messages.
pub(crate) fn kind(meaning: &Meaning<'_>) -> &'static str {
    match meaning {
        Meaning::Number(_) => "a number",
        Meaning::Thing(_) | Meaning::Made(_) => "a thing",
        Meaning::List(_) => "a list",
        Meaning::Opaque(_) => "a text",
        Meaning::Lambda(_) => "a function",
        Meaning::Drawn(_) => "a drawing",
    }
}
