//! What a loop goes through where it is written out: `[1, 2, 5]`, `[left, right]`, rows such as `[(0, 1), (1, 2)]`.
//!
//! The list may stand in the loop, or be what a message answers: `ends => [(0, 1), (1, 2)]`. Elements of such a list,
//! `ends[i][0]`, are constants.

use super::{Over, Written, turns_of};
use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::members::Definition;
use crate::scope::{Constant, Scope};
use base::{Diagnostic, Place};
use kernel::{BinaryOperator, ClassKind, Primitive, Step, Term, UnaryOperator};
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr};

/// Lists within lists are followed so far.
const DEEPEST: usize = 16;
/// What a name stands for is no longer than so many terms, each text counted by its letters.
const MOST_REPEATED: usize = 1000;
const LETTERS: usize = 64;

/// What is written out as a list.
pub(super) struct Listed {
    pub(super) elements: Rc<[Expr]>,
    /// What names mean in it, where that is not what they mean in the loop: a message answers the list.
    scope: Option<Scope>,
}

impl Lowerer<'_> {
    /// Finds what a loop binds its names to where that is written, a row a turn.
    pub(super) fn written_rows(
        &mut self,
        scope: &Scope,
        each: &ast::For,
        listed: &Listed,
    ) -> Option<(u32, Over)> {
        let named = each.names().count();
        let there = listed.scope.as_ref().unwrap_or(scope);
        let mut rows = Vec::new();
        for e in &*listed.elements {
            let row = match (named, e) {
                (1, e) => vec![e.clone()],
                (_, Expr::List(_) | Expr::Tuple(_)) => elements(e)?,
                (_, other) => {
                    let message = format!("{named} names for `{}`", other.syntax().text());
                    self.refuse_names(scope, each, message);
                    return None;
                }
            };
            if row.len() != named {
                let message = format!("{named} names for {} in `{}`", row.len(), e.syntax().text());
                self.refuse_names(scope, each, message);
                return None;
            }
            let row: Option<Vec<Written>> = row.iter().map(|e| self.written(there, e)).collect();
            rows.push(row?);
        }
        Some((listed.elements.len() as u32, Over::Written(rows)))
    }

    /// Finds what a loop over pairs of two lists goes through, as long as both last: `for a, b in xs.zip(ys)`.
    pub(super) fn zipped_rows(
        &mut self,
        scope: &Scope,
        one: &Expr,
        other: &Expr,
    ) -> Option<(u32, Over)> {
        let (one, other) = (inside(one), inside(other));
        let ranges = (self.constant_range(scope, &one), self.constant_range(scope, &other));
        if let (Some(a), Some(b)) = ranges {
            return Some((turns_of(a).min(turns_of(b)), Over::Numbers(vec![a.0, b.0])));
        }
        // of a range no more is written than the list beside it has
        let numbers = |(from, to)| (from..=to).map(|i| Written::Constant(Constant::Whole(i)));
        let row = |(a, b)| vec![a, b];
        let rows: Vec<Vec<Written>> = match ranges {
            (Some(a), _) => numbers(a).zip(self.members_of_list(scope, &other)?).map(row).collect(),
            (_, Some(b)) => {
                self.members_of_list(scope, &one)?.into_iter().zip(numbers(b)).map(row).collect()
            }
            (None, None) => {
                let one = self.members_of_list(scope, &one)?;
                one.into_iter().zip(self.members_of_list(scope, &other)?).map(row).collect()
            }
        };
        Some((rows.len() as u32, Over::Written(rows)))
    }

    /// Returns the elements of a list: those that are written out, or the parts of one that is a part.
    fn members_of_list(&mut self, scope: &Scope, list: &Expr) -> Option<Vec<Written>> {
        if let Expr::Range(range) = list {
            self.refuse_range(scope, range);
            return None;
        }
        let is_here = matches!(list, Expr::List(_) | Expr::Tuple(_));
        let written = self.listed(scope, list);
        if let Some(listed) = written.filter(|w| is_here || self.are_constants(scope, w)) {
            let there = listed.scope.as_ref().unwrap_or(scope);
            return listed.elements.iter().map(|e| self.written(there, e)).collect();
        }
        let (path, class) = self.path(scope, list)?;
        let place = Place { file: scope.file, span: list.span() };
        let Some((element, count)) =
            class.and_then(|class| self.element(class)).zip(self.length_at(scope, &path))
        else {
            let message =
                format!("{path} is no list whose elements are counted where it is declared");
            let d = Diagnostic::error("not-a-count", place, message);
            self.report(d.hint("declare it as `List of 3 C`, or with its elements, `= [a, b]`"));
            return None;
        };
        let nth = |at| Written::Thing { path: path.then(Step::Index(at)), class: Some(element) };
        Some((0..count).map(nth).collect())
    }

    /// Reports a loop with other names than there are values in a turn.
    pub(super) fn refuse_names(&mut self, scope: &Scope, each: &ast::For, message: String) {
        let place = Place { file: scope.file, span: each.span() };
        let d = Diagnostic::error("wrong-arity", place, message);
        self.report(d.hint(
            "`for a in list`, `for a, b in list.neighbours`, `for a, b in xs.zip(ys)`, `for a, b in [(0, 1), (1, 2)]`, \
             `for i in 0..3`",
        ));
    }

    /// Finds what a loop binds its name to where it is written: a constant, or a part.
    fn written(&mut self, scope: &Scope, e: &Expr) -> Option<Written> {
        if let Expr::Paren(inner) = e {
            return self.written(scope, &inner.inner()?);
        }
        if let Some(constant) = self.written_constant(scope, e) {
            return Some(Written::Constant(constant));
        }
        if !matches!(e, Expr::Name(_) | Expr::Field(_) | Expr::Index(_)) {
            // what is wrong in it, aloud
            self.expr(scope, e)?;
            let place = Place { file: scope.file, span: e.span() };
            let message = "a `for` goes through parts, and what is known as the text stands";
            let d = Diagnostic::error("not-a-path", place, message);
            self.report_whole(d.hint("go through numbers, and compute it from them in the loop"));
            return None;
        }
        let (path, class) = self.path(scope, e)?;
        Some(Written::Thing { path, class })
    }

    /// Returns the constant that an expression is as the text stands: a number, a text, a truth value, an option.
    fn written_constant(&mut self, scope: &Scope, e: &Expr) -> Option<Constant> {
        let is_name = matches!(e, Expr::Name(_));
        match self.constant(scope, e) {
            Some(number) if !is_name || scope.constant(e).is_some() => {
                return Some(Constant::Whole(number));
            }
            _ => {}
        }
        self.silent += 1;
        let found = self.expr(scope, e);
        self.silent -= 1;
        let (term, kind) = found?;
        let term = folded(term);
        (is_literal(&term) && is_short(&term)).then_some(Constant::Value(term, kind))
    }

    /// Returns true for a list that a message answers, each element of which is a constant.
    pub(super) fn are_constants(&mut self, scope: &Scope, listed: &Listed) -> bool {
        let there = listed.scope.as_ref().unwrap_or(scope);
        listed.elements.iter().all(|e| self.written_constant(there, e).is_some())
    }

    /// Returns the turns of a loop over a choice, one for each of its options: `for fit in Fit`.
    pub(super) fn all_options(&mut self, scope: &Scope, range: &Expr) -> Option<(u32, Over)> {
        let class = self.class_as_receiver(scope, range)?;
        let ClassKind::Primitive(Primitive::Choice(of)) = self.document.classes[class].kind else {
            return None;
        };
        let count = self.document.classes[of].options.len() as u32;
        let option = |at| Constant::Value(Term::Option(of, at), Kind::Option(of));
        let rows = (0..count).map(|at| vec![Written::Constant(option(at))]);
        Some((count, Over::Written(rows.collect())))
    }

    /// Returns what a list is written out as, where it stands or in what a message of the scope's own things answers.
    pub(super) fn listed(&self, scope: &Scope, list: &Expr) -> Option<Listed> {
        let Expr::Name(name) = list else {
            return Some(Listed { elements: elements(list)?.into(), scope: None });
        };
        let name = name.name()?.name();
        if scope.local(&name).is_some() || scope.element(&name).is_some() {
            return None;
        }
        let mut line = self.document.primary_line(scope.class()).into_iter();
        let definition = line.find_map(|c| self.definitions.get(&(c, name.clone())))?;
        // the message may be inherited: its names are those of its own text, of the loop's thing
        let there = Scope { classes: scope.classes.clone(), ..Scope::clone(&definition.scope) };
        Some(Listed { elements: definition.elements()?, scope: Some(there) })
    }

    /// Returns the number that an element of a list of written numbers is, `ends[i][0]`.
    pub(crate) fn listed_number(&mut self, scope: &Scope, e: &Expr) -> Option<f64> {
        let mut indices = Vec::new();
        let mut list = e.clone();
        while let Expr::Index(index) = &list {
            if indices.len() == DEEPEST {
                return None;
            }
            indices.push(index.index()?);
            list = index.receiver()?;
        }
        // before the indices, which may be long themselves
        let mut items = self.listed(scope, &list)?.elements;
        let mut found = None;
        for index in indices.into_iter().rev() {
            if let Some(inner) = found {
                items = elements(&inner)?.into();
            }
            let at = usize::try_from(self.constant(scope, &index)?).ok()?;
            found = Some(items.get(at)?.clone());
        }
        crate::numbers::constant(&|_| None, &found?)
    }
}

impl Definition {
    /// Returns the elements of what it answers where that is written out as one list. They are collected once.
    fn elements(&self) -> Option<Rc<[Expr]>> {
        let written = || elements(&self.answer).filter(|_| self.loops.is_empty());
        self.elements.get_or_init(|| written().map(Rc::from)).clone()
    }
}

/// Returns an expression without the brackets around it.
pub(super) fn inside(e: &Expr) -> Expr {
    match e {
        Expr::Paren(paren) => paren.inner().map_or_else(|| e.clone(), |inner| inside(&inner)),
        _ => e.clone(),
    }
}

/// Returns the two lists of `xs.zip(ys)`.
pub(super) fn zipped(range: &Expr) -> Option<(Expr, Expr)> {
    let Expr::Field(field) = range else { return None };
    let other = field.args().filter(|_| field.name().is_some_and(|w| w.text() == "zip"))?;
    let (mut others, one) = (other.args(), field.receiver()?);
    let other = others.next()?.value()?;
    others.next().is_none().then_some((one, other))
}

/// Returns true for a term that is worth the same whatever the values are, written with operators and functions alone.
fn is_literal(term: &Term) -> bool {
    match term {
        Term::Number { .. } | Term::Text(_) | Term::Bool(_) | Term::Option(..) => true,
        Term::Unary(_, operand) => is_literal(operand),
        Term::Binary(_, left, right) => is_literal(left) && is_literal(right),
        Term::Tuple(terms) | Term::List(terms) => terms.iter().all(is_literal),
        Term::Call { arguments, .. } | Term::Make { arguments, .. } => {
            arguments.iter().all(|a| is_literal(&a.value))
        }
        _ => false,
    }
}

/// Returns false for a term that is too long to stand wherever its name does.
fn is_short(term: &Term) -> bool {
    let mut waiting = vec![term];
    let mut count = 0;
    while let Some(next) = waiting.pop() {
        count += match next {
            Term::Text(text) => 1 + text.len() / LETTERS,
            _ => 1,
        };
        if count > MOST_REPEATED {
            return false;
        }
        waiting.extend(next.operands());
    }
    true
}

/// Computes what arithmetic makes of numbers, and joined texts; what is infinite or no number stays as it is written.
fn folded(term: Term) -> Term {
    let all = |terms: Vec<Term>| terms.into_iter().map(folded).collect();
    match term {
        Term::Tuple(terms) => Term::Tuple(all(terms)),
        Term::List(terms) => Term::List(all(terms)),
        Term::Unary(UnaryOperator::Negate, operand) => match folded(*operand) {
            Term::Number { value, dimension, bare } => {
                Term::Number { value: 0.0 - value, dimension, bare }
            }
            other => Term::Unary(UnaryOperator::Negate, Box::new(other)),
        },
        Term::Binary(operator, a, b) => joined(operator, folded(*a), folded(*b)),
        other => other,
    }
}

fn joined(operator: BinaryOperator, a: Term, b: Term) -> Term {
    use BinaryOperator::{Add, Divide, Multiply, Subtract};
    let made = match (operator, &a, &b) {
        (Add, Term::Text(x), Term::Text(y)) => Some(Term::Text(format!("{x}{y}"))),
        (
            Add | Subtract | Multiply | Divide,
            Term::Number { value: x, dimension: dx, bare: bx },
            Term::Number { value: y, dimension: dy, bare: by },
        ) => {
            let (value, dimension) = match operator {
                Add => (x + y, *dx),
                Subtract => (x - y, *dx),
                Multiply => (x * y, dx.times(*dy)),
                _ => (x / y, dx.over(*dy)),
            };
            let agrees = matches!(operator, Multiply | Divide) || dx == dy;
            // negative zero is never stored
            (value.is_finite() && agrees).then_some(Term::Number {
                value: value + 0.0,
                dimension,
                bare: *bx && *by,
            })
        }
        _ => None,
    };
    made.unwrap_or_else(|| Term::Binary(operator, Box::new(a), Box::new(b)))
}

/// Returns the elements of `[a, b]` and `(a, b)`.
fn elements(list: &Expr) -> Option<Vec<Expr>> {
    match list {
        Expr::List(list) => Some(list.elements().collect()),
        Expr::Tuple(tuple) => Some(tuple.elements().collect()),
        Expr::Paren(inner) => match inner.inner()? {
            list @ (Expr::List(_) | Expr::Tuple(_)) => elements(&list),
            _ => None,
        },
        _ => None,
    }
}
