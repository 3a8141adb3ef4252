//! Comments that are a number alone behind a value, `y => x // 2`: their writer may have meant a whole quotient.

use crate::lower::Lowerer;
use base::{Diagnostic, FileId, Place};
use syntax::ast::{AstNode, Expr};
use syntax::{Parse, SyntaxElement, SyntaxKind, SyntaxToken};

impl Lowerer<'_> {
    /// Warns of the comments of a text that may have been meant to divide. Cost: that of finding `//` in it, where none is
    /// a number alone.
    pub(crate) fn warn_of_quotients(&mut self, file: FileId, text: &str, parse: &Parse) {
        if !text.lines().any(|line| line.rsplit_once("//").is_some_and(|(_, end)| is_number(end))) {
            return;
        }
        let tokens = parse.syntax().descendants_with_tokens().filter_map(SyntaxElement::into_token);
        let comments = tokens.filter(|token| token.kind() == SyntaxKind::LineComment);
        for comment in comments.filter(|c| is_number(c.text().trim_start_matches('/'))) {
            if !is_behind_value(&comment) {
                continue;
            }
            let (comment, place) = (
                comment.text().trim_end().to_string(),
                Place { file, span: syntax::span_of_token(&comment) },
            );
            let number = comment.trim_start_matches('/').trim();
            let hint = format!(
                "a whole quotient is `floor(x / {number})`; a comment says more than a number"
            );
            let message = format!("`{comment}` is a comment");
            self.report(Diagnostic::warning("comment", place, message).hint(hint));
        }
    }
}

/// Returns true for a number without a sign and nothing else.
fn is_number(text: &str) -> bool {
    let text = text.trim();
    text.starts_with(|c: char| c.is_ascii_digit()) && text.parse::<f64>().is_ok()
}

/// Returns true behind an operand that stands behind `=`, `=>` or `:=`, on its line.
fn is_behind_value(comment: &SyntaxToken) -> bool {
    let operand = match comment.prev_token() {
        Some(space) if space.kind() == SyntaxKind::Whitespace && !space.text().contains('\n') => {
            space.prev_token()
        }
        other => other,
    };
    let Some(operand) = operand else { return false };
    let end = operand.text_range().end();
    let around = operand.parent_ancestors().take_while(|node| node.text_range().end() == end);
    around.filter_map(Expr::cast).any(|value| {
        let first = value.syntax().first_token();
        let mut before = first.and_then(|token| token.prev_token());
        while let Some(space) = before.take_if(|token| token.kind().is_trivia()) {
            before = space.prev_token();
        }
        let gives = |token: SyntaxToken| {
            matches!(token.kind(), SyntaxKind::Eq | SyntaxKind::FatArrow | SyntaxKind::ColonEq)
        };
        before.is_some_and(gives)
    })
}
