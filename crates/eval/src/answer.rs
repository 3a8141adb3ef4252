//! Answers: what an expression can be worth.

use crate::programs::Context;
use base::Name;
use drawing::Element;
use expr::dimension::Dimension;
use kernel::{ClassId, Term, ThingId};
use std::rc::Rc;
use std::sync::Arc;

/// The value of an expression. Cheap to clone.
#[derive(Clone, Debug)]
pub enum Answer<'a> {
    /// A number in base units and what it measures; finite.
    Number(f64, Dimension),
    /// A truth value.
    Bool(bool),
    /// An option of a choice, by its place among them.
    Option(ClassId, u32),
    /// A text or a colour.
    Text(Arc<str>),
    /// A thing of the document that is not primitive.
    Thing(ThingId),
    /// A thing made by a constructor: it is no part of the document.
    Made(Rc<Made<'a>>),
    /// What a program made, or one turn of a block of it.
    Context(Rc<Context<'a>>),
    /// Values by position: a list, a set, a tuple.
    List(Rc<[Answer<'a>]>),
    /// A picture.
    Picture(Rc<Vec<Element>>),
    /// A function of the language: `x => x.width`.
    Function(Rc<Closure<'a>>),
}

/// A thing made by a constructor.
#[derive(Clone, Debug)]
pub struct Made<'a> {
    /// Its class.
    pub class: ClassId,
    /// Its fields, in the order of the class's layout.
    pub fields: Vec<Answer<'a>>,
}

/// A function with what its names stood for where it was written.
#[derive(Debug)]
pub struct Closure<'a> {
    pub(crate) parameters: &'a [Name],
    pub(crate) body: &'a Term,
    pub(crate) frame: Frame<'a>,
}

impl Answer<'_> {
    /// Makes a number that measures nothing.
    pub fn plain(x: f64) -> Self {
        Self::Number(x, Dimension::NONE)
    }
    /// Makes a text.
    pub fn text(text: &str) -> Self {
        Self::Text(Arc::from(text))
    }
    /// Returns the thing that it is, if it is one of the document's.
    pub fn thing(&self) -> Option<ThingId> {
        match self {
            Self::Thing(thing) => Some(*thing),
            Self::Number(..)
            | Self::Bool(_)
            | Self::Option(..)
            | Self::Text(_)
            | Self::Made(_)
            | Self::Context(_)
            | Self::List(_)
            | Self::Picture(_)
            | Self::Function(_) => None,
        }
    }
    /// Returns what kind of value it is, in words: "a number".
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Number(..) => "a number",
            Self::Bool(_) => "a truth value",
            Self::Option(..) => "an option of a choice",
            Self::Text(_) => "a text",
            Self::Thing(_) | Self::Made(_) | Self::Context(_) => "a thing",
            Self::List(_) => "a list",
            Self::Picture(_) => "a picture",
            Self::Function(_) => "a function",
        }
    }
}

/// What `Me` and the local names stand for.
#[derive(Clone, Debug)]
pub(crate) struct Frame<'a> {
    pub(crate) me: Answer<'a>,
    /// The nearest thing of the document whose message is being answered.
    pub(crate) nearest: ThingId,
    locals: Option<Rc<Local<'a>>>,
}

#[derive(Debug)]
struct Local<'a> {
    name: &'a Name,
    answer: Answer<'a>,
    outer: Option<Rc<Local<'a>>>,
}

impl<'a> Frame<'a> {
    pub(crate) fn of(thing: ThingId) -> Self {
        Self { me: Answer::Thing(thing), nearest: thing, locals: None }
    }
    /// Makes the frame for a message to `me`, sent from where `nearest` was the nearest thing.
    pub(crate) fn sent(me: Answer<'a>, nearest: ThingId) -> Self {
        let nearest = if let Answer::Thing(thing) = me { thing } else { nearest };
        Self { me, nearest, locals: None }
    }
    pub(crate) fn bind(&self, name: &'a Name, answer: Answer<'a>) -> Self {
        let outer = self.locals.clone();
        let locals = Some(Rc::new(Local { name, answer, outer }));
        Self { me: self.me.clone(), nearest: self.nearest, locals }
    }
    pub(crate) fn local(&self, name: &str) -> Option<&Answer<'a>> {
        let mut at = self.locals.as_deref();
        while let Some(local) = at {
            if *local.name == *name {
                return Some(&local.answer);
            }
            at = local.outer.as_deref();
        }
        None
    }
}
