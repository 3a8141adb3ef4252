//! The grammar: what a file, a body and a member look like, one function a construct.
//!
//! A wrong line becomes an Error node in its body; the members around it are read as ever.

mod expressions;
mod members;
mod mistakes;
mod programs;
mod rules;
mod statements;
mod types;

use crate::kind::SyntaxKind::{Body, Eof, File, IfKw, LBrace, RBrace, Semicolon};
use crate::parser::Parser;

/// What a body may hold beside members.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Scope {
    /// Members alone: the file, classes, things, programs.
    Thing,
    /// Statements of a check.
    Check,
    /// Statements of a lesson.
    Lesson,
    /// The table of a family.
    Family,
}

/// A whole text: the body of an unnamed class.
pub(crate) fn file(p: &mut Parser<'_>, scope: Scope) {
    p.start_file(File);
    elements(p, scope);
    while !p.at(Eof) {
        p.begin_member(p.pos());
        let hint = "take it away, or write the `{` that it closes";
        p.report("unexpected-brace", "found `}`, which closes nothing".into(), Some(hint.into()));
        p.skip_line();
        elements(p, scope);
    }
    p.finish_file();
}

/// A text that is one expression: what is typed into a cell of a table.
pub(crate) fn lone_expression(p: &mut Parser<'_>) {
    p.start_file(File);
    expressions::expression(p);
    while !p.at(Eof) {
        p.expected("expected-end", "the end of the expression");
        p.skip_line();
        p.eat(RBrace);
        p.eat(Semicolon);
    }
    p.finish_file();
}

/// `{ … }`
fn body(p: &mut Parser<'_>, scope: Scope) {
    if !p.at(LBrace) {
        p.expected("expected-body", "a body in `{ }`");
        return;
    }
    p.nested(|p| {
        outside_brackets(p, |p| {
            let opener = p.pos();
            let indent = (!p.is_closed()).then(|| p.indent());
            let outside = std::mem::replace(&mut p.unclosed_body, indent);
            p.start(Body);
            p.bump();
            elements(p, scope);
            if indent.is_some() {
                mistakes::unclosed(p, opener);
            } else {
                p.expect(RBrace, "expected-brace", "`}`");
            }
            p.finish();
            p.unclosed_body = outside;
        });
    });
}

/// Runs `f` with the brackets around it forgotten, as braces do.
fn outside_brackets(p: &mut Parser<'_>, f: impl FnOnce(&mut Parser<'_>)) {
    let outside = (p.brackets, p.unclosed, p.in_bindings);
    (p.brackets, p.unclosed, p.in_bindings) = (0, 0, false);
    f(p);
    (p.brackets, p.unclosed, p.in_bindings) = outside;
}

/// The members or statements up to a `}` or the end.
fn elements(p: &mut Parser<'_>, scope: Scope) {
    let outside = std::mem::replace(&mut p.in_check, scope == Scope::Check);
    list(p, |p| {
        if !(p.at(IfKw) && !p.names_itself(1) && statements::conditional(p, scope)
            || statements::statement(p, scope)
            || programs::member(p, scope)
            || members::member(p))
        {
            members::unknown(p);
        }
    });
    p.in_check = outside;
}

/// Elements up to a `}` or the end; `;` may stand between; one that takes nothing is an error.
fn list(p: &mut Parser<'_>, mut element: impl FnMut(&mut Parser<'_>)) {
    let mut previous = p.pos();
    while !p.at(Eof) && !p.at(RBrace) {
        if p.eat(Semicolon) {
            continue;
        }
        if p.unclosed_body.is_some_and(|indent| p.begins_line(0) && p.indent() <= indent) {
            break;
        }
        let before = p.pos();
        p.begin_member(previous);
        element(p);
        if p.pos() == before {
            p.skip_line();
        }
        previous = before;
    }
}
