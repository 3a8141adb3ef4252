//! A parsed text: the tree with its diagnostics, and a dump of it for tests.

use crate::ast;
use crate::grammar::{self, Scope};
use crate::kind::{self, SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
use crate::lexer::lex;
use crate::parser::Parser;
use base::{Diagnostic, FileId, Span};
use rowan::{GreenNode, GreenNodeData, Language as _, NodeOrToken, TextRange};
use std::fmt::Write;

/// A text as a tree, and what is wrong with it. Cheap to copy, and free to cross threads.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Parse {
    green: GreenNode,
    diagnostics: Vec<Diagnostic>,
}

impl Parse {
    pub(crate) fn of(green: GreenNode, diagnostics: Vec<Diagnostic>) -> Self {
        Self { green, diagnostics }
    }
    pub(crate) fn green(&self) -> &GreenNode {
        &self.green
    }
    /// Returns the root of the tree.
    pub fn syntax(&self) -> SyntaxNode {
        SyntaxNode::new_root(self.green.clone())
    }
    /// Returns the root of the tree as a file.
    pub fn file(&self) -> ast::File {
        ast::File { syntax: self.syntax() }
    }
    /// Returns the kind and the bytes of every member at the top of the file, in order. It costs less
    /// than to look at them.
    pub fn outline(&self) -> impl Iterator<Item = (SyntaxKind, Span)> {
        let mut at = 0;
        self.green.children().filter_map(move |child| {
            let start = at;
            at += u32::from(child.text_len());
            let node = child.into_node()?;
            Some((kind::Language::kind_from_raw(node.kind()), Span::new(start, at)))
        })
    }
    /// Returns the bytes of every member at the top of the file that is of a kind or holds a node or token of it, in
    /// order. It costs less than to look for them.
    pub fn holding(&self, kind: SyntaxKind) -> impl Iterator<Item = Span> {
        let raw = rowan::SyntaxKind::from(kind);
        let children = self.green.children().filter_map(NodeOrToken::into_node);
        let holds = move |(member, (_, span)): (&GreenNodeData, (SyntaxKind, Span))| {
            let mut open = vec![member];
            while let Some(node) = open.pop() {
                if node.kind() == raw {
                    return Some(span);
                }
                for child in node.children() {
                    match child {
                        NodeOrToken::Node(node) => open.push(node),
                        NodeOrToken::Token(token) if token.kind() == raw => return Some(span),
                        NodeOrToken::Token(_) => {}
                    }
                }
            }
            None
        };
        children.zip(self.outline()).filter_map(holds)
    }
    /// Returns what is wrong, in the order of the text.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }
    /// Returns the text that was parsed, byte for byte.
    pub fn text(&self) -> String {
        self.syntax().text().to_string()
    }
}

/// Parses a document. Any text gives a tree whose text is the same.
///
/// # Panics
/// If the text is longer than 4 GiB.
///
/// Cost: linear in the text.
pub fn parse(file: FileId, text: &str) -> Parse {
    parse_with(file, text, |p| grammar::file(p, Scope::Thing))
}

/// Parses statements of a check without the braces around them: what is typed at a prompt.
pub fn parse_statements(file: FileId, text: &str) -> Parse {
    parse_with(file, text, |p| grammar::file(p, Scope::Check))
}

/// Parses one expression: what is typed into a cell. [`ast::File::expression`] finds it.
pub fn parse_expression(file: FileId, text: &str) -> Parse {
    parse_with(file, text, grammar::lone_expression)
}

pub(crate) fn parse_with(file: FileId, text: &str, rule: impl FnOnce(&mut Parser<'_>)) -> Parse {
    let mut parser = Parser::new(file, text, lex(text));
    rule(&mut parser);
    let (green, diagnostics) = parser.finish_parse();
    Parse::of(green, diagnostics)
}

/// Returns the bytes of a node.
pub fn span_of(node: &SyntaxNode) -> Span {
    let range = node.text_range();
    Span::new(range.start().into(), range.end().into())
}

/// Returns the bytes of a token.
pub fn span_of_token(token: &SyntaxToken) -> Span {
    let range = token.text_range();
    Span::new(range.start().into(), range.end().into())
}

/// Returns the token that begins at a byte, or that the byte lies in.
pub fn token_from(node: &SyntaxNode, at: u32) -> Option<SyntaxToken> {
    let (start, end) = (node.text_range().start(), node.text_range().end());
    // behind the last token is what ends there; among children of one parent it is found by halves
    let at = if u32::from(end) == at { at.checked_sub(1)? } else { at };
    let place = TextRange::at(at.into(), 1.into());
    let is_inside = start <= place.start() && place.end() <= end;
    is_inside.then(|| node.covering_element(place).into_token()).flatten()
}

/// Shows a tree for tests: each node with its children in brackets, tokens as they are written.
///
/// ```
/// let parse = syntax::parse(base::FileId(0), "x: Real = 1");
/// assert_eq!(syntax::dump(&parse.syntax()), "(File (Part x : (Type Real) = (NumberExpr 1)))");
/// ```
pub fn dump(node: &SyntaxNode) -> String {
    let mut out = format!("({:?}", node.kind());
    for child in node.children_with_tokens() {
        match child {
            SyntaxElement::Node(node) => {
                out.push(' ');
                out += &dump(&node);
            }
            SyntaxElement::Token(token) if token.kind().is_trivia() => {}
            SyntaxElement::Token(token) => {
                write!(out, " {}", token.text()).expect("writing to a string does not fail");
            }
        }
    }
    out.push(')');
    out
}
