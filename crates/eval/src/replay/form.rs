//! Forms: an answer whose numbers stand in registers, so that it can be made again of other numbers.

use super::record::place_of;
use crate::answer::{Answer, Made};
use crate::programs::{Context, Entry, Standing};
use base::Name;
use drawing::{Dimension as Measured, Element};
use expr::dimension::Dimension;
use kernel::{ClassId, ThingId};
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

/// An answer, its parts before what is made of them; what stands in it twice stands here once.
#[derive(Debug, Default)]
pub(crate) struct Form {
    nodes: Vec<Node>,
    /// What numbers are called, where they are all that it is made of.
    names: Arc<[String]>,
}

#[derive(Debug)]
enum Node {
    /// The number in a register.
    Number(u32, Dimension),
    /// A number that is the same in every run.
    Fixed(f64, Dimension),
    Bool(bool),
    Option(ClassId, u32),
    Text(Arc<str>),
    Thing(ThingId),
    Made(ClassId, Box<[u32]>),
    List(Box<[u32]>),
    Context {
        class: ClassId,
        of: Option<u32>,
        made: Box<[(Name, u32, Standing)]>,
    },
    /// Elements, their numbers marked.
    Picture(Rc<Vec<Element>>),
}

impl Form {
    /// Reads an answer whose numbers are marked.
    ///
    /// # Errors
    /// What cannot be made again, in words.
    pub(crate) fn of(answer: &Answer<'_>) -> Result<Self, String> {
        let mut reading = Reading { form: Self::default(), known: BTreeMap::new() };
        reading.node(answer)?;
        Ok(reading.form)
    }

    /// Reads numbers that are marked, with what they are called.
    pub(crate) fn of_numbers(names: Arc<[String]>, numbers: &[f64]) -> Self {
        let node = |&x: &f64| match place_of(x) {
            Some(place) => Node::Number(place, Dimension::NONE),
            None => Node::Fixed(x, Dimension::NONE),
        };
        Self { nodes: numbers.iter().map(node).collect(), names }
    }

    /// Makes the numbers of those in registers, with what they are called.
    pub(crate) fn numbers(&self, registers: &[f64]) -> (Arc<[String]>, Vec<f64>) {
        let number = |node: &Node| match node {
            Node::Number(place, _) => registers[*place as usize],
            Node::Fixed(x, _) => *x,
            _ => f64::NAN,
        };
        (self.names.clone(), self.nodes.iter().map(number).collect())
    }

    /// Makes the answer of the numbers in registers.
    pub(crate) fn answer<'a>(&self, registers: &[f64]) -> Answer<'a> {
        let mut made: Vec<Answer<'a>> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let of = |i: &u32| made[*i as usize].clone();
            let answer = match node {
                Node::Number(place, dimension) => {
                    Answer::Number(registers[*place as usize], *dimension)
                }
                Node::Fixed(x, dimension) => Answer::Number(*x, *dimension),
                Node::Bool(b) => Answer::Bool(*b),
                Node::Option(class, at) => Answer::Option(*class, *at),
                Node::Text(text) => Answer::Text(text.clone()),
                Node::Thing(thing) => Answer::Thing(*thing),
                Node::Made(class, fields) => {
                    let fields = fields.iter().map(of).collect();
                    Answer::Made(Rc::new(Made { class: *class, fields }))
                }
                Node::List(items) => Answer::List(items.iter().map(of).collect()),
                Node::Context { class, of: owner, made: entries } => {
                    let entry = |(name, i, standing): &(Name, u32, Standing)| Entry {
                        name: name.clone(),
                        answer: of(i),
                        standing: *standing,
                    };
                    Answer::Context(Rc::new(Context {
                        class: *class,
                        of: owner.as_ref().map(of),
                        made: entries.iter().map(entry).collect(),
                        ended: None,
                    }))
                }
                Node::Picture(marked) => Answer::Picture(Rc::new(read_elements(marked, registers))),
            };
            made.push(answer);
        }
        made.pop().unwrap_or(Answer::Bool(false))
    }
}

/// Puts the numbers of registers where elements are marked. What is one dimension stays one.
fn read_elements(marked: &[Element], registers: &[f64]) -> Vec<Element> {
    let mut read = |x: &mut f64| {
        if let Some(place) = place_of(*x) {
            *x = registers[place as usize];
        }
    };
    let mut elements = marked.to_vec();
    let mut latest: Option<(Arc<Measured>, Arc<Measured>)> = None;
    for element in &mut elements {
        element.shape.each_number(&mut read);
        if let Some(of) = &mut element.style.dimension {
            let is_latest = latest.as_ref().is_some_and(|(marked, _)| Arc::ptr_eq(marked, of));
            if !is_latest {
                let mut made = Measured::clone(of);
                made.points.iter_mut().flat_map(|p| [&mut p.x, &mut p.y]).for_each(&mut read);
                latest = Some((of.clone(), Arc::new(made)));
            }
            if let Some((_, made)) = &latest {
                *of = made.clone();
            }
        }
    }
    elements
}

/// An answer that is being read.
struct Reading {
    form: Form,
    /// What was read, by where it is stored.
    known: BTreeMap<usize, u32>,
}

impl Reading {
    fn add(&mut self, node: Node) -> u32 {
        self.form.nodes.push(node);
        self.form.nodes.len() as u32 - 1
    }

    fn all(&mut self, answers: &[Answer<'_>]) -> Result<Box<[u32]>, String> {
        answers.iter().map(|a| self.node(a)).collect()
    }

    fn node(&mut self, answer: &Answer<'_>) -> Result<u32, String> {
        let stored = match answer {
            Answer::Made(made) => Some(Rc::as_ptr(made).addr()),
            Answer::Context(context) => Some(Rc::as_ptr(context).addr()),
            // an empty list is stored nowhere
            Answer::List(items) if !items.is_empty() => Some(items.as_ptr().addr()),
            Answer::Picture(elements) => Some(Rc::as_ptr(elements).addr()),
            Answer::List(_)
            | Answer::Number(..)
            | Answer::Bool(_)
            | Answer::Option(..)
            | Answer::Text(_)
            | Answer::Thing(_)
            | Answer::Function(_) => None,
        };
        if let Some(&known) = stored.and_then(|stored| self.known.get(&stored)) {
            return Ok(known);
        }
        let node = match answer {
            Answer::Number(x, dimension) => match place_of(*x) {
                Some(place) => Node::Number(place, *dimension),
                None => Node::Fixed(*x, *dimension),
            },
            Answer::Bool(b) => Node::Bool(*b),
            Answer::Option(class, at) => Node::Option(*class, *at),
            Answer::Text(text) => Node::Text(text.clone()),
            Answer::Thing(thing) => Node::Thing(*thing),
            Answer::Made(made) => Node::Made(made.class, self.all(&made.fields)?),
            Answer::List(items) => Node::List(self.all(items)?),
            Answer::Context(context) => {
                let of = context.of.as_ref().map(|of| self.node(of)).transpose()?;
                let entry = |e: &Entry<'_>| Ok((e.name.clone(), self.node(&e.answer)?, e.standing));
                let made = context.made.iter().map(entry).collect::<Result<_, String>>()?;
                Node::Context { class: context.class, of, made }
            }
            Answer::Picture(elements) => Node::Picture(elements.clone()),
            Answer::Function(_) => return Err("a step makes a function".into()),
        };
        let place = self.add(node);
        if let Some(stored) = stored {
            self.known.insert(stored, place);
        }
        Ok(place)
    }
}
