//! Totals that a loop adds up: who reads one of its last turn means all turns, and gets all but the last.
//!
//! In: a program's text. Out: warnings. What a turn begins with is often asked for, too, such as where the last ring lies. It
//! is no total where the turn itself makes use of it, or the loop ends by it.

use super::{members_of, step_name, with_of};
use crate::lower::Lowerer;
use base::{Diagnostic, FileId, Name, Place};
use std::collections::BTreeSet;
use syntax::ast::{self, AstNode, Expr, FieldExpr, Member, NameExpr, Value};

impl Lowerer<'_> {
    /// Warns of totals of a last turn, which are those before it.
    pub(super) fn warn_of_totals(
        &mut self,
        file: FileId,
        program: &ast::Program,
        totals: &BTreeSet<(Name, Name)>,
    ) {
        if totals.is_empty() {
            return;
        }
        for field in program.syntax().descendants().filter_map(FieldExpr::cast) {
            let read = read_of_last(&field).filter(|read| totals.contains(read));
            let Some((of, total)) = read else { continue };
            let place = Place { file, span: field.span() };
            let message = format!(
                "{total} of the last turn is what that turn began with: its `next {total}` is not in it"
            );
            let hint = format!(
                "make a step of the turn, `sum = …`, say `next {total} = sum`, and read `{of}.last.sum`"
            );
            self.report(Diagnostic::warning("total-before-next", place, message).hint(hint));
        }
    }
    /// Warns of what a loop's turns each make of something of the same name outside, `total = total + i`: it is handed on
    /// to no other turn. `outside` are the names that are known where the loop stands.
    pub(super) fn warn_of_own_steps(
        &mut self,
        file: FileId,
        value: &Value,
        outside: &[(Name, crate::kinds::Kind)],
    ) {
        let body = match value {
            Value::Repeat(block) => block.body(),
            Value::While(block) => block.body(),
            Value::For(block) => block.body(),
            Value::Expr(_) | Value::If(_) => return,
        };
        let Some(body) = body else { return };
        let carried: Vec<Name> = with_of(value)
            .into_iter()
            .chain(body.syntax().descendants().filter_map(ast::With::cast))
            .flat_map(|with| with.bindings())
            .filter_map(|binding| Some(binding.name()?.name()))
            .collect();
        for step in body.syntax().descendants().filter_map(ast::Assign::cast) {
            let (Some(word), Some(Value::Expr(made))) = (step_name(&step), step.value()) else {
                continue;
            };
            let name = word.name();
            let mut around = step.syntax().ancestors().take_while(|node| node != body.syntax());
            // what an inner loop makes is told there
            if around.any(|node| {
                matches!(
                    Value::cast(node),
                    Some(Value::Repeat(_) | Value::While(_) | Value::For(_))
                )
            }) {
                continue;
            }
            let is_outside = outside.iter().any(|(known, _)| *known == name);
            if !is_outside || carried.contains(&name) || !speaks_of(made.syntax(), &name) {
                continue;
            }
            let message = format!(
                "each turn makes a {name} of its own from the one outside, which stays as it is"
            );
            let made = made.syntax().text();
            let hint = format!(
                "to hand it on write `with {name} = {name}` before the brace of the loop, and in it `sum = {made}` and `next {name} = sum`; what the last turn comes to is its `sum`"
            );
            let place = Place { file, span: step.span() };
            self.report(Diagnostic::warning("step-of-a-turn", place, message).hint(hint));
        }
    }
}

/// Returns the loop and the name in `loop.last.name`.
fn read_of_last(field: &FieldExpr) -> Option<(Name, Name)> {
    let Expr::Field(last) = field.receiver()? else { return None };
    if last.name()?.text() != "last" {
        return None;
    }
    let of = match last.receiver()? {
        Expr::Name(name) => name.name()?,
        Expr::Field(field) => field.name()?,
        _ => return None,
    };
    Some((of.name(), field.name()?.name()))
}

/// Returns what a step adds up turn by turn, each with the step's name.
pub(super) fn totals_of(of: &Name, value: &Value) -> Vec<(Name, Name)> {
    let (body, ends) = match value {
        Value::Repeat(block) => (block.body(), block.until()),
        Value::While(block) => (block.body(), block.condition()),
        Value::For(block) => (block.body(), None),
        Value::Expr(_) | Value::If(_) => return Vec::new(),
    };
    let members = members_of(body);
    let is_next = |member: &&Member| matches!(member, Member::Next(_));
    let is_used = |name: &Name| {
        let mut steps = members.iter().filter(|member| !is_next(member));
        steps.any(|step| speaks_of(step.syntax(), name))
            || ends.as_ref().is_some_and(|end| speaks_of(end.syntax(), name))
    };
    // what a next turn begins with, made of what this one does
    let is_made_of = |name: &Name, of: &[Name]| {
        let nexts = members.iter().filter_map(|member| match member {
            Member::Next(next) => Some(next.bindings()),
            _ => None,
        });
        nexts.flatten().any(|binding| {
            let speaks = |value: Expr| of.iter().any(|name| speaks_of(value.syntax(), name));
            binding.name().is_some_and(|word| word.name() == *name)
                && binding.value().is_some_and(speaks)
        })
    };
    let carried = with_of(value).into_iter().flat_map(|with| with.bindings());
    let carried: Vec<Name> = carried.filter_map(|binding| Some(binding.name()?.name())).collect();
    // a loop that makes nothing is for what it ends with
    let makes_nothing = members.iter().all(|member| is_next(&member));
    let adds_up = |name: &Name| {
        is_made_of(name, if makes_nothing { &carried } else { std::slice::from_ref(name) })
    };
    let totals = carried.iter().filter(|name| adds_up(name) && !is_used(name));
    totals.map(|total| (of.clone(), total.clone())).collect()
}

fn speaks_of(node: &syntax::SyntaxNode, name: &Name) -> bool {
    let names = node.descendants().filter_map(NameExpr::cast);
    names.filter_map(|n| n.name()).any(|word| word.name() == *name)
}
