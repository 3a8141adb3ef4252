//! A parameter that a program hands on to itself, one more or less each time: it counts the calls, and is no length.

use super::catalogue::Slot;
use super::parameters::{self, Declared, Other};
use super::view::Turn;
use super::{Home, text, typed};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::Refusal;
use syntax::ast::{self, AstNode, BinaryOp, Expr};

/// Gives an operand that is typed. Where a parameter counts the calls of its program by it, or has to be something else
/// for it, it becomes that in the same step.
///
/// # Errors
/// The operand does not fit.
pub(crate) fn given(
    open: &mut Open,
    host: &dyn Host,
    (home, typed, wanted): (&Home, &str, &Slot),
    again: &dyn Fn(&mut Open) -> Result<Turn, Refusal>,
) -> Result<Turn, Refusal> {
    let made = open.dialogue.as_ref().map(|dialogue| dialogue.tool.class.to_string());
    let count = made.and_then(|made| counter(&open.state, home, (&made, &wanted.name, typed)));
    if let Some(turn) = count.and_then(|count| count.tried(open, host, again).ok()) {
        return Ok(turn);
    }
    again(open).or_else(|refused| {
        parameters::retried(open, host, (home, typed, &wanted.class), refused, again)
    })
}

/// Returns a parameter as a count, where a program gives it to itself one more or less and it is no length elsewhere.
fn counter(state: &State, home: &Home, (made, name, typed): (&str, &str, &str)) -> Option<Other> {
    let Home::Program { program, .. } = home else { return None };
    if *program.as_str() != *made || !is_one_on(&typed::expression(typed)?, name) {
        return None;
    }
    let source = text::Source::now(state);
    let is_it =
        |d: &Declared| d.name == name && d.class == "Length" && d.example.parse::<u32>().is_ok();
    let found = parameters::declared(&source, program).into_iter().find(is_it)?;
    let body = text::block(&source, program, "")?;
    let names = body.syntax().descendants().filter_map(ast::NameExpr::cast);
    let mut spoken = names.filter(|n| n.name().is_some_and(|word| word.text() == name));
    spoken.all(|n| counts(&n, (made, name))).then(|| Other::count(&source, &found))
}

/// Whether a word is used as a count is: compared with a number, or handed on to the program itself.
fn counts(word: &ast::NameExpr, (program, name): (&str, &str)) -> bool {
    let Some(Expr::Binary(around)) = word.syntax().parent().and_then(Expr::cast) else {
        return false;
    };
    let is_bare = |side: Option<Expr>| matches!(side, Some(Expr::Number(n)) if n.unit().is_none());
    let is_compared = matches!(
        around.op(),
        Some(
            BinaryOp::Equal
                | BinaryOp::NotEqual
                | BinaryOp::Less
                | BinaryOp::LessEqual
                | BinaryOp::Greater
                | BinaryOp::GreaterEqual
        )
    );
    if is_compared {
        return is_bare(around.left()) || is_bare(around.right());
    }
    let labelled = around.syntax().parent().and_then(ast::Arg::cast);
    let is_own = labelled.and_then(|a| a.label()).is_some_and(|label| label.text() == name);
    let mut calls = around.syntax().ancestors().filter_map(ast::CallExpr::cast);
    let is_called = calls.next().and_then(|c| c.name()).is_some_and(|word| word.text() == program);
    is_own && is_called && is_one_on(&Expr::Binary(around), name)
}

/// Whether an expression is a name and a whole number more or less: `depth - 1`.
fn is_one_on(said: &Expr, name: &str) -> bool {
    let Expr::Binary(sum) = said else { return false };
    let is_sum = matches!(sum.op(), Some(BinaryOp::Add | BinaryOp::Subtract));
    let is_name = matches!(sum.left(), Some(Expr::Name(left)) if left.name().is_some_and(|w| w.text() == name));
    let by = sum.right().map(|right| right.syntax().text().to_string());
    is_sum && is_name && by.is_some_and(|by| by.trim().parse::<u32>().is_ok())
}
