//! Programs: steps that draw, as data. A class with a program has its parameters as stored parts and its
//! steps as messages; what a loop makes depends on values, so that nothing of it is a thing of a structure.
//!
//! In the terms of a block, what it and the blocks around it made so far are local names; `Me` is that whose
//! parameters they are.

use crate::class::ClassId;
use crate::term::{OriginId, Term};
use base::Name;
use std::rc::Rc;

/// What a class draws.
#[derive(Clone, PartialEq, Debug)]
pub struct Program {
    /// What is asked of who applies it, in order: each a part of the class.
    pub parameters: Vec<Asked>,
    /// What its parameters have to fulfil, beside what is allowed of each.
    pub demands: Vec<Demand>,
    /// What it does.
    pub body: Block,
}

/// A parameter, beside the part that it is.
#[derive(Clone, PartialEq, Debug)]
pub struct Asked {
    /// The name of the part.
    pub name: Name,
    /// What is asked, in words; empty where nothing is written.
    pub prompt: String,
    /// The values that are allowed; nothing for all.
    pub allowed: Option<Allowed>,
}

/// The values that are allowed of a parameter.
#[derive(Clone, PartialEq, Debug)]
pub enum Allowed {
    /// From the least to the largest; nothing where there is no such end, of which one at most is missing.
    Range {
        /// The least.
        least: Option<Bound>,
        /// The largest.
        most: Option<Bound>,
    },
    /// Those of a table.
    OneOf(Vec<Term>),
}

/// An end of the values that are allowed.
#[derive(Clone, PartialEq, Debug)]
pub struct Bound {
    /// The value.
    pub value: Term,
    /// Whether it is not allowed itself.
    pub is_outside: bool,
}

/// A constraint in a program: what rows and calls have to fulfil.
#[derive(Clone, PartialEq, Debug)]
pub struct Demand {
    /// Its name; how it is written where it has none.
    pub said: Name,
    /// What shall be true.
    pub rule: Rc<Term>,
    /// Where it was written.
    pub origin: OriginId,
}

/// Steps in order, and what they have from the turn before.
#[derive(Clone, PartialEq, Debug)]
pub struct Block {
    /// The class of what a turn makes: its messages are the steps.
    pub class: ClassId,
    /// What is carried from turn to turn.
    pub carried: Vec<Carried>,
    /// The steps.
    pub steps: Vec<Step>,
}

impl Block {
    /// Makes a block that does nothing.
    pub fn of(class: ClassId) -> Self {
        Self { class, carried: Vec::new(), steps: Vec::new() }
    }
}

/// `with under = floor`, `next under = -ring`
#[derive(Clone, PartialEq, Debug)]
pub struct Carried {
    /// Its name in the block.
    pub name: Name,
    /// What it is in the first turn, in terms of what is around the block.
    pub first: Term,
    /// What it is in the next turn, in terms of this one; itself where nothing is written.
    pub next: Option<Term>,
}

/// A step of a program.
#[derive(Clone, PartialEq, Debug)]
pub struct Step {
    /// Its name in its block; empty where a block of steps has none.
    pub name: Name,
    /// What `///` says of it.
    pub doc: String,
    /// What it does.
    pub says: Says,
    /// True where it is drawn for construction, and is no part of the result.
    pub is_guide: bool,
    /// Where it was written.
    pub origin: OriginId,
}

/// What a step does.
#[derive(Clone, PartialEq, Debug)]
pub enum Says {
    /// A construction, a measure, a call.
    Value(Term),
    /// One of two blocks.
    If {
        /// Which one.
        condition: Term,
        /// What is done where it is true.
        then: Block,
        /// What is done where it is not.
        otherwise: Option<Block>,
    },
    /// A block, turn by turn.
    Repeat {
        /// How often, where that is said.
        times: Option<Term>,
        /// What has to be true before a turn.
        before: Option<Term>,
        /// What ends the loop after a turn.
        until: Option<Term>,
        /// What is done.
        block: Block,
    },
    /// A block for each element of a set.
    Each {
        /// What the element is called: a pair's parts, where these are several.
        names: Vec<Name>,
        /// The set.
        of: Term,
        /// What is done.
        block: Block,
    },
    /// What steps made is no longer part of the result; it can still be named.
    Erase(Vec<Name>),
    /// Its text is wrong: a run ends here.
    Unclear,
}
