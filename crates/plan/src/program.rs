//! Programs, opened into expressions on the course that they take at a state.
//!
//! In: a program, and the state that decides how many turns its loops take and which branches are drawn. Out: what
//! every step makes, over the program's parameters, and the decisions: while these are the same, so is what is drawn.
//! What cannot be opened so (texts, what is too long, a step without an outcome) stays with the host.

use crate::course::{Block as Place, Decided, Decision};
use crate::evaluate::{Answer, Given, Opening};
use crate::fault::{FaultKind, Trouble};
use crate::meaning::{Drawn, Entry, Frame, Made, Meaning};
use base::Name;
use kernel::program::{Block, Carried, Program, Says, Step};
use kernel::{ClassId, ClassKind, Primitive, Term, ThingId};
use std::rc::Rc;

/// Into so many nodes what one rule says of programs may open: more is one way.
const MOST_NODES: usize = 20_000;

/// A program that is being opened.
struct Run<'a> {
    /// The thing whose program it is, if it is one of the document.
    of: Option<ThingId>,
    /// The blocks around the step at hand, each with its turn.
    way: Vec<(&'a Name, Option<usize>)>,
}

/// What a block has made so far.
struct Making<'a> {
    frame: Frame<'a>,
    made: Vec<Entry<'a>>,
    /// Steps of blocks around it that it erased.
    erased: Vec<&'a Name>,
}

impl<'a> Opening<'a> {
    /// Returns what a step of a thing's program makes.
    pub(crate) fn step(&mut self, me: &Meaning<'a>, name: &Name) -> Answer<'a> {
        if let Some(made) = self.made_so_far(me, name) {
            return Ok(made);
        }
        let Some(drawn) = self.drawn_of(me)? else { return Ok(self.opaque([me])) };
        match drawn.step(name) {
            Some(meaning) => Ok(meaning.clone()),
            None if drawn.is_cut => Ok(self.opaque([me])),
            None => Err(self.missing_step(&drawn, name)),
        }
    }

    /// Returns what a step makes, where the program that has it is being opened and asks itself: by a message of its own.
    fn made_so_far(&self, me: &Meaning<'a>, name: &Name) -> Option<Meaning<'a>> {
        let frame = self.opened.last()?;
        match (&frame.me, me) {
            (Meaning::Made(a), Meaning::Made(b)) if Rc::ptr_eq(a, b) => frame.local(name),
            _ => None,
        }
    }

    /// Returns what a thing's program draws, as a list.
    pub(crate) fn result(&mut self, me: &Meaning<'a>) -> Answer<'a> {
        match self.drawn_of(me)? {
            Some(drawn) if !drawn.is_cut => self.items(&Meaning::Drawn(drawn)).map(Meaning::List),
            Some(_) | None => Ok(self.opaque([me])),
        }
    }

    /// Makes a thing of a class; of a program, what it draws with these values.
    pub(crate) fn drawn_with(&mut self, class: ClassId, given: &[Given<'a>]) -> Answer<'a> {
        let made = self.make(class, given)?;
        let Meaning::Made(thing) = &made else { return Ok(made) };
        if self.document.program(thing.class).is_none() {
            return Ok(made);
        }
        match self.drawn_of(&made)? {
            Some(drawn) => Ok(Meaning::Drawn(drawn)),
            None => Ok(self.opaque([&made])),
        }
    }

    pub(crate) fn missing_step(&self, drawn: &Drawn<'a>, name: &Name) -> Trouble {
        let class = &self.document.classes[drawn.class].name;
        let message = format!("`{name}` was not drawn by {class}: another branch ran");
        Trouble::new(FaultKind::UnknownName, message)
    }

    /// Opens the program of what answers; nothing where only the host knows what it draws.
    fn drawn_of(&mut self, me: &Meaning<'a>) -> Result<Option<Rc<Drawn<'a>>>, Trouble> {
        match me {
            Meaning::Drawn(drawn) => Ok(Some(drawn.clone())),
            Meaning::Thing(thing) => self.drawn_by(*thing),
            Meaning::Made(made) => {
                let Some(program) = self.document.program(made.class) else { return Ok(None) };
                self.open_program(program, me.clone(), made.class, None)
            }
            Meaning::Number(_) | Meaning::List(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => {
                Ok(None)
            }
        }
    }

    /// Opens the program of a thing, once for a rule.
    pub(crate) fn drawn_by(&mut self, thing: ThingId) -> Result<Option<Rc<Drawn<'a>>>, Trouble> {
        self.has_courses = true;
        // on which course it is opened no other thing says
        self.reach.looks_around();
        let thing = self.structure.merged[thing];
        let class = self.structure.things[thing].class;
        let Some(program) = self.document.program(class) else { return Ok(None) };
        if self.at.is_none() {
            return Ok(None);
        }
        if let Some(known) = self.drawn.get(&thing) {
            return match known {
                Some(drawn) => Ok(Some(drawn.clone())),
                None => Err(Trouble::new(FaultKind::Endless, "a program that needs what it draws")),
            };
        }
        self.drawn.insert(thing, None);
        let drawn = match self.parameters(thing, class) {
            Ok(me) => self.open_program(program, me, class, Some(thing)),
            Err(_) => Ok(None),
        };
        self.drawn.remove(&thing);
        let drawn = drawn?;
        if let Some(drawn) = &drawn {
            self.drawn.insert(thing, Some(drawn.clone()));
        }
        Ok(drawn)
    }

    /// Returns a program's parameters. Whole numbers and truth values decide on the course, and are as they stand.
    fn parameters(&mut self, thing: ThingId, class: ClassId) -> Answer<'a> {
        let document = self.document;
        let mut fields = Vec::new();
        for field in document.layout(class) {
            let name = document.field_name(field).clone();
            let part = self.reach.part_named(thing, &name);
            let part = part.ok_or_else(|| Trouble::wrong(format!("no part `{name}`")))?;
            let mut meaning = self.part(part)?;
            let kind = &document.classes[document.field_class(field)].kind;
            if let ClassKind::Primitive(
                Primitive::Integer | Primitive::Bool | Primitive::Choice(_),
            ) = kind
            {
                let what = Decided::Parameter;
                let place = Place { of: Some(thing), path: name.to_string(), what };
                let value = self.decide(&meaning, place)?;
                meaning = self.number(value);
            }
            fields.push((name, meaning));
        }
        Ok(Meaning::Made(Rc::new(Made { class, fields })))
    }

    fn open_program(
        &mut self,
        program: &'a Program,
        me: Meaning<'a>,
        class: ClassId,
        of: Option<ThingId>,
    ) -> Result<Option<Rc<Drawn<'a>>>, Trouble> {
        self.has_courses = true;
        if self.at.is_none() {
            return Ok(None);
        }
        self.deeper(|opening| {
            let mut run = Run { of, way: Vec::new() };
            let frame = Frame::new(me.clone());
            opening.opened.push(frame.clone());
            let mut making = Making { frame, made: Vec::new(), erased: Vec::new() };
            // what was drawn before a step without an outcome stands
            let ended = run.demands(opening, program, &making.frame);
            let ended = ended.and_then(|()| run.steps(opening, &program.body, &mut making));
            opening.opened.pop();
            let drawn = Drawn { class, of: Some(me), made: making.made, is_cut: ended.is_err() };
            Ok(Some(Rc::new(drawn)))
        })
    }

    /// Decides what a number is at the state whose courses are taken, and notes that.
    pub(crate) fn decide(&mut self, meaning: &Meaning<'a>, place: Place) -> Result<f64, Trouble> {
        let id = self.expression(meaning)?;
        if let Some(value) = self.constant(meaning) {
            return Ok(value);
        }
        let Some(at) = self.at else { return Err(Trouble::wrong("no course")) };
        let value = self.arena.evaluate(id, at.numbers.as_slice());
        self.decisions.push(Decision { of: id, is: value, place });
        if value.is_nan() {
            return Err(Trouble::wrong("a condition without a value"));
        }
        Ok(value)
    }

    /// Sends a message to everything in a set that is drawn; what is in it keeps its place and name.
    pub(crate) fn each_in_set(
        &mut self,
        set: &Meaning<'a>,
        name: &Name,
        arguments: &[Given<'a>],
    ) -> Answer<'a> {
        self.count_term()?;
        match set {
            Meaning::List(items) => {
                let each = items.iter().map(|i| self.each_in_set(i, name, arguments));
                Ok(Meaning::List(each.collect::<Result<_, _>>()?))
            }
            Meaning::Drawn(drawn) => {
                let mut made = Vec::new();
                for entry in &drawn.made {
                    let meaning = self.each_in_set(&entry.meaning, name, arguments)?;
                    made.push(Entry { meaning, ..entry.clone() });
                }
                let Drawn { class, ref of, is_cut, .. } = **drawn;
                Ok(Meaning::Drawn(Rc::new(Drawn { class, of: of.clone(), made, is_cut })))
            }
            Meaning::Thing(_) | Meaning::Made(_) => self.send(set, name, arguments, None),
            Meaning::Number(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => Ok(set.clone()),
        }
    }
}

impl<'a> Run<'a> {
    fn place(&self, step: &str, what: Decided) -> Place {
        let mut path = String::new();
        for (name, turn) in &self.way {
            path += if name.is_empty() { "block" } else { name.as_str() };
            if let Some(turn) = turn {
                path += &format!("[{turn}]");
            }
            path.push('.');
        }
        match step.is_empty() {
            true => path.truncate(path.len().saturating_sub(1)),
            false => path += step,
        }
        Place { of: self.of, path, what }
    }

    /// Decides whether a condition is true.
    fn truth(
        &self,
        opening: &mut Opening<'a>,
        (step, term): (&'a Step, &'a Term),
        what: Decided,
        frame: &Frame<'a>,
    ) -> Result<bool, Trouble> {
        let meaning = opening.meaning(term, frame)?;
        Ok(opening.decide(&meaning, self.place(&step.name, what))? != 0.0)
    }

    fn demands(
        &self,
        opening: &mut Opening<'a>,
        program: &'a Program,
        frame: &Frame<'a>,
    ) -> Result<(), Trouble> {
        for demand in &program.demands {
            let meaning = opening.meaning(&demand.rule, frame)?;
            let said = &demand.said;
            if opening.decide(&meaning, self.place(said, Decided::Demand))? == 0.0 {
                return Err(Trouble::wrong(format!("{said} is not met")));
            }
        }
        Ok(())
    }

    fn steps(
        &mut self,
        opening: &mut Opening<'a>,
        block: &'a Block,
        making: &mut Making<'a>,
    ) -> Result<(), Trouble> {
        block.steps.iter().try_for_each(|step| self.step(opening, step, making))
    }

    fn step(
        &mut self,
        opening: &mut Opening<'a>,
        step: &'a Step,
        making: &mut Making<'a>,
    ) -> Result<(), Trouble> {
        if self.way.is_empty()
            && let Some(so_far) = opening.opened.last_mut()
        {
            *so_far = making.frame.clone();
        }
        opening.count_term()?;
        if opening.arena.len() > MOST_NODES {
            return Err(Trouble::not_yet(format!("more than {MOST_NODES} terms are one way")));
        }
        match &step.says {
            Says::Value(term) => {
                let meaning = opening.meaning(term, &making.frame)?;
                making.add(step, meaning);
                Ok(())
            }
            Says::If { condition, then, otherwise } => {
                let branch =
                    match self.truth(opening, (step, condition), Decided::Branch, &making.frame)? {
                        true => Some(then),
                        false => otherwise.as_ref(),
                    };
                branch.map_or(Ok(()), |branch| self.branch(opening, step, branch, making))
            }
            Says::Repeat { times, before, until, block } => {
                let mut turns = Vec::new();
                let ends = [times, before, until].map(Option::as_ref);
                let ended = self.repeat(opening, step, (ends, block), making, &mut turns);
                making.add(step, Meaning::List(turns.into()));
                ended
            }
            Says::Each { names, of, block } => {
                let mut turns = Vec::new();
                let ended = self.each(opening, step, (names, of, block), making, &mut turns);
                making.add(step, Meaning::List(turns.into()));
                ended
            }
            Says::Erase(names) => {
                names.iter().for_each(|name| making.erase(name));
                Ok(())
            }
            Says::Unclear => Err(Trouble::wrong("its text is wrong")),
        }
    }

    /// Opens a branch of an `if`: without a name, what it makes is made where the `if` stands.
    fn branch(
        &mut self,
        opening: &mut Opening<'a>,
        step: &'a Step,
        branch: &'a Block,
        making: &mut Making<'a>,
    ) -> Result<(), Trouble> {
        opening.deeper(|opening| {
            if step.name.is_empty() {
                return self.steps(opening, branch, making);
            }
            self.way.push((&step.name, None));
            let mut inner = making.inside();
            let ended = self.steps(opening, branch, &mut inner);
            self.way.pop();
            let drawn = making.close(branch, inner, ended.is_err());
            making.add(step, drawn);
            ended
        })
    }

    fn repeat(
        &mut self,
        opening: &mut Opening<'a>,
        step: &'a Step,
        ([times, before, until], block): ([Option<&'a Term>; 3], &'a Block),
        making: &mut Making<'a>,
        turns: &mut Vec<Meaning<'a>>,
    ) -> Result<(), Trouble> {
        let outside = making.frame.clone();
        let times = match times {
            None => None,
            Some(term) => {
                let meaning = opening.meaning(term, &outside)?;
                Some(opening.decide(&meaning, self.place(&step.name, Decided::Turns))?)
            }
        };
        let mut carried = firsts(opening, block, &outside)?;
        let is_open = times.is_none() && before.is_none() && until.is_none();
        while times.is_none_or(|n| (turns.len() as f64) < n) {
            let mut inner = making.inside();
            inner.begin(&block.carried, &carried);
            if let Some(term) = before
                && !self.truth(opening, (step, term), Decided::Turns, &inner.frame)?
            {
                break;
            }
            let frame = self.turn(opening, step, block, (making, inner), turns)?;
            let ends = match until {
                Some(term) => self.truth(opening, (step, term), Decided::Turns, &frame)?,
                None => is_open,
            };
            if ends {
                break;
            }
            if times.is_none_or(|n| (turns.len() as f64) < n) {
                carried = nexts(opening, block, &frame, carried)?;
            }
        }
        Ok(())
    }

    fn each(
        &mut self,
        opening: &mut Opening<'a>,
        step: &'a Step,
        (names, of, block): (&'a [Name], &'a Term, &'a Block),
        making: &mut Making<'a>,
        turns: &mut Vec<Meaning<'a>>,
    ) -> Result<(), Trouble> {
        let outside = making.frame.clone();
        let set = opening.meaning(of, &outside)?;
        let set = opening.items(&set)?;
        let mut carried = firsts(opening, block, &outside)?;
        for element in set.iter() {
            let mut inner = making.inside();
            let parts = match names {
                [_] => [element.clone()].into(),
                _ => opening.items(element)?,
            };
            if parts.len() != names.len() {
                let (n, m) = (parts.len(), names.len());
                return Err(Trouble::wrong(format!("{n} parts, where {m} are named")));
            }
            for (name, part) in names.iter().zip(parts.iter()) {
                inner.know(name, part.clone(), false);
            }
            inner.begin(&block.carried, &carried);
            let frame = self.turn(opening, step, block, (making, inner), turns)?;
            carried = nexts(opening, block, &frame, carried)?;
        }
        Ok(())
    }

    /// Opens one turn of a loop; returns what its names stand for at its end.
    fn turn(
        &mut self,
        opening: &mut Opening<'a>,
        step: &'a Step,
        block: &'a Block,
        (making, mut inner): (&mut Making<'a>, Making<'a>),
        turns: &mut Vec<Meaning<'a>>,
    ) -> Result<Frame<'a>, Trouble> {
        self.way.push((&step.name, Some(turns.len())));
        let ended = opening.deeper(|opening| self.steps(opening, block, &mut inner));
        self.way.pop();
        let frame = inner.frame.clone();
        turns.push(making.close(block, inner, ended.is_err()));
        ended.map(|()| frame)
    }
}

fn firsts<'a>(
    opening: &mut Opening<'a>,
    block: &'a Block,
    frame: &Frame<'a>,
) -> Result<Vec<Meaning<'a>>, Trouble> {
    block.carried.iter().map(|c| opening.meaning(&c.first, frame)).collect()
}

/// Returns what is carried into the next turn, all of it from this one.
fn nexts<'a>(
    opening: &mut Opening<'a>,
    block: &'a Block,
    frame: &Frame<'a>,
    carried: Vec<Meaning<'a>>,
) -> Result<Vec<Meaning<'a>>, Trouble> {
    let next = |(c, now): (&'a Carried, Meaning<'a>)| match &c.next {
        None => Ok(now),
        Some(term) => opening.meaning(term, frame),
    };
    block.carried.iter().zip(carried).map(next).collect()
}

impl<'a> Making<'a> {
    /// Begins a block in this one.
    fn inside(&self) -> Self {
        Self { frame: self.frame.clone(), made: Vec::new(), erased: Vec::new() }
    }
    /// Makes a name known.
    fn know(&mut self, name: &'a Name, meaning: Meaning<'a>, is_result: bool) {
        if !name.is_empty() {
            self.frame = self.frame.bind(name.clone(), meaning.clone());
        }
        self.made.push(Entry { name: name.clone(), meaning, is_result });
    }
    fn add(&mut self, step: &'a Step, meaning: Meaning<'a>) {
        self.know(&step.name, meaning, !step.is_guide);
    }
    /// Begins a turn with what is carried.
    fn begin(&mut self, carried: &'a [Carried], meanings: &[Meaning<'a>]) {
        for (carried, meaning) in carried.iter().zip(meanings) {
            self.know(&carried.name, meaning.clone(), false);
        }
    }
    /// Takes what a step made out of the result.
    fn erase(&mut self, name: &'a Name) {
        match self.made.iter_mut().rev().find(|e| e.name == *name) {
            Some(entry) => entry.is_result = false,
            None => self.erased.push(name),
        }
    }
    /// Ends a block in this one.
    fn close(&mut self, block: &'a Block, inner: Self, is_cut: bool) -> Meaning<'a> {
        inner.erased.iter().for_each(|name| self.erase(name));
        let drawn = Drawn { class: block.class, of: None, made: inner.made, is_cut };
        Meaning::Drawn(Rc::new(drawn))
    }
}
