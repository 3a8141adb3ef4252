//! Expressions of numbers: built once, then solved, differentiated, enclosed and run.
//!
//! Three nouns. An [`Arena`] holds expressions over anonymous variables ([`Var`]), each stored once and
//! named by an [`ExprId`]; a [`Tape`] is some of them lowered to a list of operations that is run again
//! and again; a [`Dimension`] says what a number measures. Rules, residuals, methods and pictures are
//! all written once as expressions: everything else about them is derived here.
//!
//! ```
//! use expr::{Arena, Tape, Var, gradient, isolate};
//! let mut arena = Arena::new();
//! // u = i r
//! let [u, i, r] = [0, 1, 2].map(|v| arena.var(Var(v)));
//! let product = arena.mul(i, r);
//! // its residual, with derivatives, as a tape
//! let residual = arena.sub(u, product);
//! let mut outputs = vec![residual];
//! outputs.extend(gradient(&mut arena, residual, &[Var(0), Var(1), Var(2)]));
//! let tape = Tape::compile(&arena, &outputs);
//! let (mut registers, mut out) = (Vec::new(), [0.0; 4]);
//! tape.run(&[13.0, 2.0, 5.0], &mut registers, &mut out);
//! assert_eq!(out, [3.0, 1.0, -5.0, -2.0]);
//! // and solved for the resistance
//! let roots = isolate(&mut arena, u, product, Var(2)).expect("it is linear");
//! assert_eq!(arena.evaluate(roots[0].value, &[13.0, 2.0, 0.0]), 6.5);
//! ```
//!
//! Invariants:
//! - operands stand before their users, so that a pass over ids in order meets every operand first;
//! - one expression has one id; what is built depends on the calls alone, never on hash order;
//! - folding, evaluation and tape compute the same bits, on every machine;
//! - no function here recurses over an expression: a sum of 100 000 terms is an ordinary one.
pub mod op;

pub mod arena;

pub mod derivative;

pub mod conic;
pub mod isolate;
mod polynomial;

pub mod interval;

pub mod tape;

pub mod dimension;
pub mod units;

pub use arena::{Arena, Excerpt, ExprId, Node, Var};
pub use conic::{Conic, conic};
pub use derivative::{derivative, gradient, varying};
pub use dimension::Dimension;
pub use interval::Interval;
pub use isolate::{Guard, Root, is_linear_in, isolate};
pub use op::{Binary, Unary};
pub use tape::{LANES, Lanes, Tape};
