//! Classes, things, parts, paths, merges: the object model. No text, no arithmetic but that of units, no pixels.
//!
//! Three nouns. A [`Document`] is a set of classes, the last of which has the document itself as its
//! one instance. [`instantiate`] makes its [`Structure`]: every thing of the document with its owner,
//! its parts and what it is merged with, and a *slot* for every distinct primitive part.
//! [`Values`] holds what is in the slots.
//!
//! **Invariants** ([`check`] states and tests them): a thing's parts follow it in its class's
//! layout; merged things agree, recursively, on what they have from their nearest common ancestor;
//! a slot belongs to one primitive thing, the first by declaration among those merged.
//!
//! Reading order: [`path`], [`term`], [`class`], [`document`], [`structure`], [`values`],
//! [`command`], [`builtin`], [`program`], [`quantity`], [`check`].
pub mod builtin;
pub mod check;
pub mod class;
mod classes;
pub mod command;
mod composed;
mod customary;
pub mod document;
mod instantiate;
pub mod path;
pub mod program;
pub mod quantity;
mod scale;
pub mod structure;
pub mod term;
pub mod values;

pub use class::{
    Binding, Class, ClassId, ClassKind, Constraint, Count, Given, Handle, Insert, Merge, Message,
    Method, Parameter, Part, Primitive, Setting, Stay, Strength, Superclass, Switch, form,
};
pub use classes::Classes;
pub use command::{Command, Literal};
pub use composed::quotients;
pub use customary::Customary;
pub use document::{Document, PartRef, PartRole, Side, SideWay, Usual, Vertical, Voices};
pub use instantiate::{Fault, FaultKind, MOST_THINGS, faults_of, instantiate, instantiate_again};
pub use path::{Path, Step};
pub use program::Program;
pub use quantity::{Quantity, Shown, in_unit, show_quantity};
pub use scale::Scale;
pub use structure::{
    Astray, Condition, ConstraintInstance, DOCUMENT, Form, GivenId, GivenIn, GivenTerm, Givens,
    Layout, Slot, SlotId, StayInstance, Structure, Thing, ThingId,
};
pub use term::{Argument, Aspect, BinaryOperator, OriginId, Search, Term, UnaryOperator};
pub use values::{Value, Values};
