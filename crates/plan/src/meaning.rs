//! Meanings: what a term stands for before any value is known.
//!
//! A number is an expression over slots, a thing is itself, a thing made on the way is its fields.
//! What only the host can compute (texts, and numbers read from texts) is opaque: all that is
//! known of it is which slots it speaks of.

use base::Name;
use expr::{Arena, ExprId};
use kernel::{ClassId, SlotId, Term, ThingId};
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

/// What a term stands for.
#[derive(Clone, Debug)]
pub(crate) enum Meaning<'a> {
    /// A number or a truth value: an expression whose variables are slots.
    Number(ExprId),
    /// A thing of the structure that is not primitive.
    Thing(ThingId),
    /// A thing made by a constructor.
    Made(Rc<Made<'a>>),
    /// Things or values by position: a list, a set, a tuple.
    List(Rc<[Meaning<'a>]>),
    /// What only the host can compute.
    Opaque(Opaque),
    /// A function of the language: `x => x.width`.
    Lambda(Rc<Closure<'a>>),
    /// What a program draws, or a turn of a block of it, on the course that it takes.
    Drawn(Rc<Drawn<'a>>),
}

/// A thing made by a constructor: it has no slots of its own.
#[derive(Clone, Debug)]
pub(crate) struct Made<'a> {
    pub(crate) class: ClassId,
    /// Every field with its name, in the order of the class's layout.
    pub(crate) fields: Vec<(Name, Meaning<'a>)>,
}

/// What a program, or a turn of a block of it, draws.
#[derive(Debug)]
pub(crate) struct Drawn<'a> {
    /// The program, or the class of the block's turns.
    pub(crate) class: ClassId,
    /// Its parameters; none for a turn.
    pub(crate) of: Option<Meaning<'a>>,
    /// What was made, in order, with what a turn began with.
    pub(crate) made: Vec<Entry<'a>>,
    /// True where it ended before its last step.
    pub(crate) is_cut: bool,
}

/// What a step made.
#[derive(Clone, Debug)]
pub(crate) struct Entry<'a> {
    pub(crate) name: Name,
    pub(crate) meaning: Meaning<'a>,
    /// True where it is part of the result.
    pub(crate) is_result: bool,
}

impl<'a> Drawn<'a> {
    /// Returns what the step of a name made.
    pub(crate) fn step(&self, name: &str) -> Option<&Meaning<'a>> {
        self.made.iter().rev().find(|e| *e.name == *name).map(|e| &e.meaning)
    }
    /// Counts the turns of every loop, by the way to it.
    pub(crate) fn count_turns(&self, way: &str, found: &mut BTreeMap<String, u32>) {
        for entry in &self.made {
            let path = format!("{way}{}", entry.name);
            match &entry.meaning {
                Meaning::List(turns) if turns.iter().all(|t| matches!(t, Meaning::Drawn(_))) => {
                    found.insert(path.clone(), turns.len() as u32);
                    for (i, turn) in turns.iter().enumerate() {
                        if let Meaning::Drawn(turn) = turn {
                            turn.count_turns(&format!("{path}[{i}]."), found);
                        }
                    }
                }
                Meaning::Drawn(drawn) => drawn.count_turns(&format!("{path}."), found),
                _ => {}
            }
        }
    }
}

/// Something that only the host can compute.
#[derive(Clone, Debug, Default)]
pub(crate) struct Opaque {
    /// The slots that it speaks of.
    pub(crate) slots: Rc<BTreeSet<SlotId>>,
    /// The slot that it is, where it is just what is stored there.
    pub(crate) slot: Option<SlotId>,
}

impl Opaque {
    pub(crate) fn over(slots: BTreeSet<SlotId>) -> Self {
        Self { slots: Rc::new(slots), slot: None }
    }
    pub(crate) fn stored(slot: SlotId) -> Self {
        Self { slots: Rc::new(BTreeSet::from([slot])), slot: Some(slot) }
    }
}

/// A function with the bindings of the place where it was written.
#[derive(Debug)]
pub(crate) struct Closure<'a> {
    pub(crate) parameters: &'a [Name],
    pub(crate) body: &'a Term,
    pub(crate) frame: Frame<'a>,
}

/// What `Me` and the local names stand for.
#[derive(Clone, Debug)]
pub(crate) struct Frame<'a> {
    pub(crate) me: Meaning<'a>,
    locals: Option<Rc<Local<'a>>>,
}

#[derive(Debug)]
struct Local<'a> {
    name: Name,
    meaning: Meaning<'a>,
    outer: Option<Rc<Local<'a>>>,
}

impl<'a> Frame<'a> {
    pub(crate) fn new(me: Meaning<'a>) -> Self {
        Self { me, locals: None }
    }
    pub(crate) fn of(thing: ThingId) -> Self {
        Self::new(Meaning::Thing(thing))
    }
    pub(crate) fn bind(&self, name: Name, meaning: Meaning<'a>) -> Self {
        let outer = self.locals.clone();
        Self { me: self.me.clone(), locals: Some(Rc::new(Local { name, meaning, outer })) }
    }
    pub(crate) fn local(&self, name: &str) -> Option<Meaning<'a>> {
        let mut at = self.locals.as_ref();
        while let Some(local) = at {
            if local.name == *name {
                return Some(local.meaning.clone());
            }
            at = local.outer.as_ref();
        }
        None
    }
}

/// Returns the slots of an expression, whose variables are slots by number.
pub(crate) fn slots_of_expression(arena: &Arena, id: ExprId) -> BTreeSet<SlotId> {
    arena.variables(id).into_iter().map(|v| SlotId(v.0)).collect()
}

/// Adds the slots that a meaning speaks of. A thing as such speaks of none: only its parts do.
pub(crate) fn collect_slots(arena: &Arena, meaning: &Meaning<'_>, into: &mut BTreeSet<SlotId>) {
    match meaning {
        Meaning::Number(id) => into.extend(slots_of_expression(arena, *id)),
        Meaning::Opaque(opaque) => into.extend(opaque.slots.iter()),
        Meaning::Made(made) => {
            made.fields.iter().for_each(|(_, m)| collect_slots(arena, m, into));
        }
        Meaning::List(items) => items.iter().for_each(|m| collect_slots(arena, m, into)),
        Meaning::Drawn(drawn) => {
            drawn.made.iter().for_each(|e| collect_slots(arena, &e.meaning, into));
        }
        Meaning::Thing(_) | Meaning::Lambda(_) => {}
    }
}
