//! Constraints: rules, tolerances, methods, and what happens `when` a condition becomes true.

use super::expressions::{comparison, conditional_rest, expression, path};
use super::types::paths;
use super::{list, mistakes, outside_brackets};
use crate::kind::SyntaxKind::{
    BinaryExpr, Colon, ColonEq, Comma, Constraint, Derived, Ellipsis, ElseKw, Eq, Error, Ident,
    IfKw, IfRule, LBrace, Method, MethodList, RBrace, Reads, RuleBlock, When, Within,
};
use crate::parser::Parser;

/// `weak constraint home: x = 100 within 1e-6 { x := 100 }`
pub(super) fn constraint(p: &mut Parser<'_>) {
    p.start_documented(Constraint);
    if !p.eat_word("constraint") {
        p.bump_keyword();
        p.bump_keyword();
    }
    if mistakes::elsewhere::for_all(p) {
        p.skip_line();
        p.finish();
        return;
    }
    if p.at(Ident) && p.nth(1) == Colon {
        p.bump();
        p.bump();
    } else if let Some(words) = mistakes::spaced_name(p) {
        p.start(Error);
        (0..=words).for_each(|_| p.bump());
        p.finish();
    } else if mistakes::elsewhere::name_without_colon(p) {
        p.start(Error);
        p.bump();
        p.finish();
    }
    rule(p);
    tolerance(p);
    methods_if_any(p);
    p.finish();
}

/// A rule: an expression, or `if c { rules } else { rules }`.
pub(super) fn rule(p: &mut Parser<'_>) {
    if p.at(LBrace) && !assigns(p) {
        let hint = "each rule has its own word: `constraint x = 3`".to_string();
        p.expected_hint("expected-expression", "an expression", Some(hint));
        p.nested(|p| {
            p.start(Error);
            rule_block(p);
            p.finish();
        });
        return;
    }
    if !p.at(IfKw) {
        let start = p.checkpoint();
        expression(p);
        if mistakes::turned_comparison(p) {
            p.bump();
            expression(p);
            p.start_at(start, BinaryExpr);
            p.finish();
        }
        return;
    }
    p.nested(|p| {
        let start = p.checkpoint();
        p.bump();
        expression(p);
        if !p.at(LBrace) {
            conditional_rest(p, start);
            return;
        }
        rule_block(p);
        if p.at(ElseKw) {
            p.bump();
            if p.at(IfKw) { rule(p) } else { rule_block(p) }
        }
        p.start_at(start, IfRule);
        p.finish();
    });
}

/// Returns true where methods stand on the line, `{ x := 3 }`.
fn assigns(p: &Parser<'_>) -> bool {
    (1..=p.line_end() - p.pos()).any(|n| p.nth(n) == ColonEq)
}

/// `{ vout = gain * vin }`
fn rule_block(p: &mut Parser<'_>) {
    if !p.at(LBrace) {
        p.expected("expected-body", "rules in `{ }`");
        return;
    }
    outside_brackets(p, |p| {
        p.start(RuleBlock);
        p.bump();
        list(p, |p| {
            rule(p);
            p.eat(Comma);
        });
        p.expect(RBrace, "expected-brace", "`}`");
        p.finish();
    });
}

/// `within 1e-9`
pub(super) fn tolerance(p: &mut Parser<'_>) {
    if p.at_word(0, "within") {
        p.start(Within);
        p.bump_keyword();
        comparison(p);
        mistakes::numbers::compared_after_tolerance(p);
        while mistakes::joined_after_tolerance(p) {
            p.bump();
            expression(p);
            if p.at_word(0, "within") {
                p.bump_keyword();
                comparison(p);
            }
        }
        p.finish();
    }
}

/// `{ a := e  reads b  ... }`, if it stands here.
pub(super) fn methods_if_any(p: &mut Parser<'_>) {
    if p.at(LBrace) {
        methods(p);
    }
}

fn methods(p: &mut Parser<'_>) {
    if !p.at(LBrace) {
        p.expected("expected-body", "methods in `{ }`");
        return;
    }
    outside_brackets(p, |p| {
        p.start(MethodList);
        p.bump();
        list(p, method);
        p.expect(RBrace, "expected-brace", "`}`");
        p.finish();
    });
}

/// `r, theta := (sqrt(x^2 + y^2), atan2(y, x))`, `reads size`, `...`
fn method(p: &mut Parser<'_>) {
    if p.at(Ellipsis) {
        p.start(Derived);
        p.bump();
        p.finish();
    } else if p.at_word(0, "reads") {
        p.start_documented(Reads);
        p.bump_keyword();
        paths(p);
        p.finish();
    } else if p.at(Ident) {
        p.start_documented(Method);
        path(p);
        while p.eat(Comma) {
            path(p);
        }
        if p.at(Eq) && !p.begins_line(0) {
            let hint = "a method is written `part := value`; a rule stands before the braces";
            p.expected_hint("expected-method", "`:=` and a value", Some(hint.into()));
            p.start(Error);
            p.bump();
            expression(p);
            p.finish();
        } else if p.expect(ColonEq, "expected-method", "`:=` and a value") {
            expression(p);
        }
        p.finish();
    } else {
        p.expected("expected-method", "a method: `part := value`");
    }
}

/// `when y <= 0 m { v := -0.8 * v }`
pub(super) fn when(p: &mut Parser<'_>) {
    p.start_documented(When);
    p.bump_keyword();
    expression(p);
    methods(p);
    p.finish();
}
