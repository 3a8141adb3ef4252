//! Things made by constructors: `Point(1, 2)`, `Rectangle(corner: (0, 0))`.

use crate::answer::{Answer, Frame, Made};
use crate::evaluator::{Evaluator, Given, Result};
use crate::fault::{Fault, FaultKind};
use base::Name;
use expr::dimension::Dimension;
use kernel::{ClassId, ClassKind, Count, PartRef, Primitive, Step, ThingId};
use std::rc::Rc;

impl<'a> Evaluator<'a> {
    /// Makes a thing from its stored parts, inherited first, by position or by name.
    ///
    /// What is not said is what the class gives, else zero, false or empty.
    pub(crate) fn make(
        &self,
        class: ClassId,
        arguments: &[Given<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let document = self.document;
        let layout = self.layout(class);
        let name = |i: usize| document.field_name(layout.fields[i]);
        let mut said: Vec<Option<&Answer<'a>>> = vec![None; layout.fields.len()];
        for (position, (label, answer)) in arguments.iter().enumerate() {
            let place = match label {
                Some(label) => (0..said.len()).find(|&i| *name(i) == **label),
                None => Some(position),
            };
            match place.and_then(|i| said.get_mut(i)) {
                Some(field) => *field = Some(answer),
                None => {
                    let class = &document.classes[class].name;
                    let n = said.len();
                    let message = match label {
                        Some(label) => format!("{class} has no part `{label}`"),
                        None => format!("{class} has {n} parts, and here are more"),
                    };
                    return Err(Fault::wrong(message));
                }
            }
        }
        let mut made = Made { class, fields: Vec::with_capacity(said.len()) };
        for (i, answer) in said.into_iter().enumerate() {
            let field = layout.fields[i];
            let answer = match answer {
                Some(a) => self.as_class(a.clone(), document.field_class(field), nearest)?,
                None => self.default_field(&made, field, nearest)?,
            };
            made.fields.push(answer);
        }
        Ok(Answer::Made(Rc::new(made)))
    }

    /// Returns the parts of a thing, in order; what it only refers to is none.
    pub(crate) fn parts_of(&self, of: &Answer<'a>) -> Result<Vec<Answer<'a>>> {
        match of {
            Answer::Thing(t) if !self.is_set(*t) => {
                let own = self.structure.parts(*t).filter(|&p| !self.is_reference(p));
                own.map(|p| self.part(p)).collect()
            }
            other => self.by_position(other),
        }
    }

    /// Makes a thing of another's class with other parts; what that one refers to, it refers to, and the
    /// last parts, where fewer are said, are that one's.
    pub(crate) fn made_of(
        &self,
        model: &Answer<'a>,
        arguments: &[Answer<'a>],
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let Some(parts) = arguments.first() else { return Ok(model.clone()) };
        let mut parts = self.items(parts)?.iter().cloned().collect::<Vec<_>>().into_iter();
        let composite = match model {
            Answer::Thing(t) => *self.class_kind(*t) == ClassKind::Composite,
            _ => true,
        };
        let Some(class) = self.class_of(model).filter(|_| composite) else {
            return Ok(Answer::List(parts.collect()));
        };
        let layout = self.layout(class);
        let mut made = Made { class, fields: Vec::with_capacity(layout.fields.len()) };
        for (i, &field) in layout.fields.iter().enumerate() {
            let field_class = self.document.field_class(field);
            let refers = matches!(self.document.classes[field_class].kind, ClassKind::Reference(_));
            let own = |t: ThingId| ThingId(self.structure.things[t].first_part.0 + i as u32);
            made.fields.push(match (model, refers) {
                (Answer::Thing(t), true) => {
                    self.part(own(*t)).unwrap_or(Answer::List(Rc::from([])))
                }
                (_, _) => match (parts.next(), model) {
                    (Some(part), _) => self.as_class(part, field_class, nearest)?,
                    (None, Answer::Thing(t)) => self.part(own(*t))?,
                    (None, Answer::Made(whole)) => whole.fields[i].clone(),
                    (None, _) => self.default_field(&made, field, nearest)?,
                },
            });
        }
        match parts.next() {
            None => Ok(Answer::Made(Rc::new(made))),
            Some(_) => {
                let class = &self.document.classes[class].name;
                Err(Fault::wrong(format!(
                    "{class} has {} parts, and here are more",
                    made.fields.len()
                )))
            }
        }
    }

    /// Returns true for a thing that begins with two lengths `x` and `y`, where all else in it are values.
    pub(crate) fn is_place(&self, of: &Answer<'a>) -> bool {
        let Some(class) = self.class_of(of) else { return false };
        let is_value = |&field: &PartRef| {
            let kind = &self.document.classes[self.document.field_class(field)].kind;
            matches!(kind, ClassKind::Primitive(_) | ClassKind::Reference(_))
        };
        self.coordinates(class) == Some((0, 1)) && self.layout(class).fields.iter().all(is_value)
    }

    fn is_reference(&self, thing: ThingId) -> bool {
        matches!(self.class_kind(thing), ClassKind::Reference(_))
    }

    fn is_set(&self, thing: ThingId) -> bool {
        matches!(self.class_kind(thing), ClassKind::Set(_))
    }

    /// Sees a tuple as a thing of the class that is wanted; leaves everything else as it is.
    pub(crate) fn as_class(
        &self,
        answer: Answer<'a>,
        class: ClassId,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        match (&answer, &self.document.classes[class].kind) {
            // several stand where one of a class without parts is wanted: what covers together
            (Answer::List(_), ClassKind::Composite) if self.layout(class).fields.is_empty() => {
                Ok(answer)
            }
            (Answer::List(items), ClassKind::Composite) => {
                let arguments: Vec<Given<'a>> = items.iter().map(|a| (None, a.clone())).collect();
                self.make(class, &arguments, nearest)
            }
            _ => Ok(answer),
        }
    }

    /// Computes what a class gives to a field of its things, from the fields before it.
    fn default_field(
        &self,
        so_far: &Made<'a>,
        field: PartRef,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let document = self.document;
        let name = document.field_name(field);
        let field_class = document.field_class(field);
        let count = document.declared(field).and_then(|p| p.count);
        let line = document.primary_line(so_far.class).into_iter().rev();
        let classes = line.map(|c| &document.classes[c]);
        let givens = classes.flat_map(|c| c.connections.iter().chain(&c.givens));
        let mut value = None;
        for given in givens.filter(|g| g.path.0.first() == Some(&Step::Part(name.clone()))) {
            let me = Answer::Made(Rc::new(so_far.clone()));
            let answer = self
                .deeper(|| self.term(&given.value, &Frame::sent(me, nearest)))
                .map_err(|f| f.within(given.origin))?;
            let rest = &given.path.0[1..];
            value = Some(if rest.is_empty() {
                self.as_class(answer, field_class, nearest)?
            } else {
                let whole = value.map_or_else(|| self.blank(field_class, count, nearest), Ok)?;
                self.replaced(&whole, rest, answer, nearest)?
            });
        }
        value.map_or_else(|| self.blank(field_class, count, nearest), Ok)
    }

    /// Makes a value of a class of which nothing is said.
    fn blank(&self, class: ClassId, count: Option<Count>, nearest: ThingId) -> Result<Answer<'a>> {
        match self.document.classes[class].kind {
            ClassKind::Primitive(Primitive::Real(dimension)) => Ok(Answer::Number(0.0, dimension)),
            ClassKind::Primitive(Primitive::Integer) => Ok(Answer::Number(0.0, Dimension::NONE)),
            ClassKind::Primitive(Primitive::Bool) => Ok(Answer::Bool(false)),
            ClassKind::Primitive(Primitive::Choice(of)) => Ok(Answer::Option(of, 0)),
            ClassKind::Primitive(Primitive::Text | Primitive::Color) => Ok(Answer::text("")),
            ClassKind::Composite => self.deeper(|| self.make(class, &[], nearest)),
            ClassKind::List(element) => {
                let own = self.document.classes[class].count.map(Count::Fixed);
                let n = match count.or(own) {
                    Some(Count::Fixed(n)) => n,
                    Some(Count::Given) | None => 0,
                };
                (0..n)
                    .map(|_| self.blank(element, None, nearest))
                    .collect::<Result<_>>()
                    .map(Answer::List)
            }
            ClassKind::Set(_) => Ok(Answer::List(Rc::from([]))),
            ClassKind::Reference(_) => {
                Err(Fault::new(FaultKind::Reference, "a reference that names nothing"))
            }
        }
    }

    /// Returns a made thing with one of its subparts replaced.
    fn replaced(
        &self,
        whole: &Answer<'a>,
        path: &[Step],
        new: Answer<'a>,
        nearest: ThingId,
    ) -> Result<Answer<'a>> {
        let Some((step, rest)) = path.split_first() else { return Ok(new) };
        let astray = || Fault::unknown("a given value whose path leads nowhere");
        let replace = |old: &Answer<'a>| self.replaced(old, rest, new, nearest);
        match (whole, step) {
            (Answer::Made(made), Step::Part(name)) => {
                let i = self.field(made.class, name).ok_or_else(astray)?;
                let class = self.document.field_class(self.layout(made.class).fields[i]);
                let mut made = Made::clone(made);
                made.fields[i] = self.as_class(replace(&made.fields[i])?, class, nearest)?;
                Ok(Answer::Made(Rc::new(made)))
            }
            (Answer::List(items), Step::Index(i)) => {
                let mut items = items.to_vec();
                let item = items.get_mut(*i as usize).ok_or_else(astray)?;
                *item = replace(item)?;
                Ok(Answer::List(items.into()))
            }
            _ => Err(astray()),
        }
    }

    fn field(&self, class: ClassId, name: &Name) -> Option<usize> {
        self.layout(class).index.get(name).map(|&i| i as usize)
    }
}
