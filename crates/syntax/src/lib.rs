//! The lossless tree: lex, parse, typed view, format, edit. It has never heard of a thing.

pub mod ast;
mod grammar;
pub mod kind;
mod lexer;
pub mod parser;
pub mod tree;
pub mod units;

pub use kind::{SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
pub use tree::{Parse, dump, parse, parse_expression, parse_statements, span_of, span_of_token};
