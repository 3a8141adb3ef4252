//! Messages: whose definition answers, with what arguments.
//!
//! A stored part comes first, then the class's messages in the thesis's order, then what every
//! number, text, list and picture knows. A combining message that a class with several superclasses
//! does not define combines what all of them say.

use crate::answer::{Answer, Closure, Frame};
use crate::evaluator::{Evaluator, Given, Result};
use crate::fault::Fault;
use base::Name;
use kernel::builtin::is_of_each;
use kernel::{ClassId, Message, Search, ThingId};

/// So many letters of a text take as much room as a slot that was read.
const LETTERS: u64 = 8;

impl<'a> Evaluator<'a> {
    /// Sends a message, or reads a part. `nearest` is the thing whose message sends it.
    pub(crate) fn send(
        &self,
        to: &Answer<'a>,
        name: &Name,
        arguments: Vec<Given<'a>>,
        search: Option<Search>,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        self.burn()?;
        if arguments.is_empty()
            && search.is_none()
            && let Some(part) = self.stored_part(to, name)
        {
            return part;
        }
        if !arguments.is_empty()
            && matches!(to, Answer::List(_) | Answer::Context(_))
            && is_of_each(name)
        {
            return self.each_in_set(to, name, &arguments, nearest);
        }
        if let Answer::Thing(thing) = to
            && let Some(answer) = self.combined(*thing, name, &arguments, search)?
        {
            return Ok(answer);
        }
        match self.message(to, name, search) {
            Some(message) => self.answer(to, message, arguments, nearest),
            None => self.send_builtin(to, name, &arguments, nearest),
        }
    }

    /// Sends a message to a class itself, by its form.
    pub(crate) fn send_to_class(
        &self,
        class: ClassId,
        form: &Name,
        arguments: Vec<Given<'a>>,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        self.burn()?;
        let message = self.class_message(class, form).ok_or_else(|| {
            let name = &self.document.classes[class].name;
            Fault::unknown(format!("the class {name} answers no `{form}`"))
        })?;
        self.answer(&Answer::Thing(nearest), message, arguments, nearest)
    }

    /// Reads a stored part, if the thing has one of this name.
    fn stored_part(&self, to: &Answer<'a>, name: &Name) -> Option<Result<Answer<'a>>> {
        match to {
            Answer::Thing(t) => self.part_named(*t, name).map(|part| self.part(part)),
            Answer::Made(made) => {
                let i = *self.layout(made.class).index.get(name)?;
                made.fields.get(i as usize).cloned().map(Ok)
            }
            Answer::Context(context) => match (context.step(name), &context.of) {
                (Some(answer), _) => Some(Ok(answer.clone())),
                (None, Some(of)) => self.stored_part(of, name),
                (None, None) => None,
            },
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::List(_)
            | Answer::Picture(_)
            | Answer::Function(_) => None,
        }
    }

    /// Finds the definition of a message, looking at everything that the thing is merged with.
    pub(crate) fn message(
        &self,
        to: &Answer<'a>,
        name: &Name,
        search: Option<Search>,
    ) -> Option<&'a Message> {
        let s = self.structure;
        let find = |class| match search {
            None => self.class_message(class, name),
            Some(_) => self.document.find_message(class, name, search).map(|found| found.1),
        };
        match to {
            Answer::Thing(t) => find(s.things[*t].class).or_else(|| {
                let alike = s.unlike(*t);
                alike.iter().find_map(|&t| find(s.things[t].class))
            }),
            Answer::Made(made) => find(made.class),
            Answer::Context(context) => find(context.class),
            Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::List(_)
            | Answer::Picture(_)
            | Answer::Function(_) => None,
        }
    }

    /// Computes what a message answers, or remembers it.
    fn answer(
        &self,
        to: &Answer<'a>,
        message: &'a Message,
        arguments: Vec<Given<'a>>,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let Answer::Thing(thing) = to else { return self.compute(to, message, arguments, nearest) };
        if !arguments.is_empty() || !self.remembers() {
            return self.compute(to, message, arguments, nearest);
        }
        let key = (*thing, std::ptr::from_ref(message).addr());
        if let Some((answer, read)) = self.remembered.borrow().get(&key) {
            // looking through what was read is work, too
            self.burn_several(read.len() as u64)?;
            if let Some(reads) = &mut *self.reads.borrow_mut() {
                reads.extend(read);
            }
            return Ok(answer.clone());
        }
        if self.left_to_remember.get() == 0 {
            return self.compute(to, message, arguments, nearest);
        }
        let (before, faults) = (self.fuel.get(), self.faults.borrow().len());
        let (answer, read) = self.listening(|| self.compute(to, message, arguments, nearest));
        let cost = before.saturating_sub(self.fuel.get());
        // a part that went wrong is told each time; what is as soon computed again is not worth it
        if let Ok(value) = &answer
            && self.faults.borrow().len() == faults
            && let Some(size) = size_of(value).map(|n| n + read.len() as u64)
            && size < cost
        {
            let left = self.left_to_remember.get();
            self.left_to_remember.set(left.saturating_sub(size));
            self.remembered.borrow_mut().insert(key, (value.clone(), read));
        }
        answer
    }

    /// Computes what a message answers.
    fn compute(
        &self,
        to: &Answer<'a>,
        message: &'a Message,
        arguments: Vec<Given<'a>>,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let frame = self.bind(Frame::sent(to.clone(), nearest), message, arguments)?;
        let answer = self
            .deeper(|| self.term(&message.answer, &frame))
            .map_err(|f| f.within(message.origin));
        match answer {
            // things and lists of things stand for their pictures
            Ok(Answer::Thing(_) | Answer::Made(_) | Answer::Context(_) | Answer::List(_))
                if message.name == self.tables.picture =>
            {
                self.join_pictures(&[answer?], frame.nearest)
            }
            other => other,
        }
    }

    /// Binds the arguments of a message to its parameters, by label or by position.
    pub(crate) fn bind(
        &self,
        mut frame: Frame<'a>,
        message: &'a Message,
        arguments: Vec<Given<'a>>,
    ) -> Result<Frame<'a>> {
        let parameters = &message.parameters;
        let mut bound: Vec<Option<Answer<'a>>> = vec![None; parameters.len()];
        for (label, answer) in arguments {
            let place = match label {
                Some(label) => {
                    parameters.iter().position(|p| p.label == *label || p.name == *label)
                }
                None => bound.iter().position(Option::is_none),
            };
            match place.and_then(|i| bound.get_mut(i)) {
                Some(slot) if slot.is_none() => *slot = Some(answer),
                Some(_) | None => {
                    let what = label.map_or("one more argument".into(), |l| format!("`{l}`"));
                    return Err(Fault::wrong(format!("`{}` does not take {what}", message.name)));
                }
            }
        }
        for (parameter, answer) in parameters.iter().zip(bound) {
            let Some(answer) = answer else {
                let (name, label) = (&message.name, &parameter.label);
                return Err(Fault::wrong(format!("`{name}` wants `{label}`")));
            };
            let answer = match parameter.class {
                Some(class) => self.as_class(answer, class, frame.nearest)?,
                None => answer,
            };
            frame = frame.bind(&parameter.name, answer);
        }
        Ok(frame)
    }

    /// Calls a function of the language; one list serves several parameters.
    pub(crate) fn apply(
        &self,
        function: &Answer<'a>,
        arguments: &[Answer<'a>],
    ) -> Result<Answer<'a>> {
        let Answer::Function(closure) = function else {
            let kind = self.kind(function);
            return Err(Fault::wrong(format!("{kind} where a function is wanted")));
        };
        let Closure { parameters, body, frame } = closure.as_ref();
        let spread = match arguments {
            [one] if parameters.len() > 1 => self.items(one)?,
            _ => arguments.into(),
        };
        if spread.len() != parameters.len() {
            let (n, m) = (parameters.len(), spread.len());
            return Err(Fault::wrong(format!("a function of {n} got {m} arguments")));
        }
        let bind =
            |f: Frame<'a>, (name, answer): (&'a Name, &Answer<'a>)| f.bind(name, answer.clone());
        let frame = parameters.iter().zip(spread.iter()).fold(frame.clone(), bind);
        self.deeper(|| self.term(body, &frame))
    }

    /// Combines what several superclasses say, where that is what the message means.
    fn combined(
        &self,
        thing: ThingId,
        name: &Name,
        arguments: &[Given<'a>],
        search: Option<Search>,
    ) -> Result<Option<Answer<'a>>> {
        let class = self.structure.things[thing].class;
        let layout = self.layout(class);
        if layout.superclasses.is_empty() {
            return Ok(None);
        }
        let Some(voices) = self.document.voices(class, name, search) else { return Ok(None) };
        let mut answers = Vec::new();
        if let Some(message) = voices.own {
            answers.push(self.answer(&Answer::Thing(thing), message, arguments.to_vec(), thing)?);
        }
        for field in voices.others {
            let part = Answer::Thing(ThingId(self.structure.things[thing].first_part.0 + field));
            answers.push(self.send(&part, name, arguments.to_vec(), None, thing)?);
        }
        if answers.len() < 2 {
            return Ok(answers.pop());
        }
        if name == "picture" {
            return self.join_pictures(&answers, thing).map(Some);
        }
        let mut all = Vec::new();
        for answer in answers {
            match self.items(&answer) {
                Ok(items) => all.extend(items.iter().cloned()),
                Err(_) => all.push(answer),
            }
        }
        Ok(Some(Answer::List(all.into())))
    }
}

/// Returns how much room a value takes, by the slots that could be remembered in it; nothing for what is made anew each
/// time.
fn size_of(answer: &Answer<'_>) -> Option<u64> {
    match answer {
        Answer::Number(..) | Answer::Bool(_) | Answer::Option(..) | Answer::Thing(_) => Some(1),
        Answer::Text(text) => Some(1 + text.len() as u64 / LETTERS),
        Answer::List(items) => items.iter().try_fold(1, |sum, item| Some(sum + size_of(item)?)),
        Answer::Made(_) | Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => None,
    }
}
