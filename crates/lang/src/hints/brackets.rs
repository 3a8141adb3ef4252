//! Names within brackets that hold what other languages write there: comprehensions, sums over an index.

use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr};

/// True within brackets of which the parser left a part unread, and said so: a name there may be one of what follows,
/// `[2 * x for x in xs]`.
pub(crate) fn is_in_unread(word: &ast::Word) -> bool {
    let end = word.token.text_range().end();
    let is_bracket =
        |kind| matches!(kind, SyntaxKind::ListExpr | SyntaxKind::ArgList | SyntaxKind::ParenExpr);
    let brackets = word.token.parent_ancestors().filter(|node| is_bracket(node.kind()));
    let mut last = brackets.flat_map(|node| node.children().last());
    last.any(|child| child.kind() == SyntaxKind::Error && child.text_range().start() >= end)
}

/// Says how `sum(i in 0..<n)` is written.
pub(crate) fn index_of_sum(word: &ast::Word) -> Option<String> {
    let name = word.token.parent()?;
    let within = ast::BinaryExpr::cast(name.parent()?)?;
    let Some(Expr::Range(range)) = within.right() else { return None };
    let call = ast::CallExpr::cast(name.ancestors().nth(4)?)?;
    let range = range.syntax().text().to_string();
    let i = word.text();
    matches!(call.syntax().first_token()?.text(), "sum" | "product" | "min" | "max" | "mean")
        .then(|| format!("what is summed over a range is `({range}).map({i} => 2 * {i}).sum`"))
}
