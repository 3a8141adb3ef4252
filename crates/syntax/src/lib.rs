//! The lossless tree: lex, parse, typed view, format, edit. It has never heard of a thing.
//!
//! A [`Parse`] is a text as a tree, with what is wrong with it. The typed view ([`ast`]) reads the
//! tree as classes, parts, constraints, expressions. A [`TextEdit`] is how the text is changed.
//!
//! ```
//! use syntax::{ast::Member, edit};
//! let text = "t: Thermometer   // in the garden\n";
//! let parse = syntax::parse(base::FileId(0), text);
//! let Some(Member::Part(part)) = parse.file().members().next() else { panic!("a part") };
//! assert_eq!(part.names().next().unwrap().text(), "t");
//! let spot = edit::Spot::EndOf(syntax::ast::AstNode::syntax(&part).clone());
//! let warmer = edit::insert_member(&spot, "celsius = 30");
//! assert_eq!(edit::apply(text, &[warmer]), "t: Thermometer { celsius = 30 }   // in the garden\n");
//! ```
//!
//! Invariants: the text of a tree is the text that was parsed, byte for byte, whatever it was; a node
//! neither begins nor ends with trivia, but for the doc comments that a member begins with; trees
//! are at most some hundred nodes high; a wrong line is an Error node between members that stand.

pub mod kind;

pub mod units;

mod lexer;

pub mod parser;

mod grammar;

mod strange;

pub mod tree;

mod reparse;

pub mod ast;

pub mod format;

pub mod edit;

pub use edit::TextEdit;
pub use format::format;
pub use kind::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
pub use reparse::{Changed, Reparsed, reparse};
pub use rowan::{NodeOrToken, WalkEvent};
pub use tree::{
    Parse, dump, parse, parse_expression, parse_statements, span_of, span_of_token, token_from,
};
