//! Deciding: expressions of constants that say which parts there are. Beside whole numbers these are truth
//! values and options of choices: `if fit = close { … }`, `open: Bool = n > 3`.

use super::names_in;
use crate::choices::options_of;
use crate::lower::Lowerer;
use crate::numbers;
use crate::scope::Scope;
use base::{Name, Span};
use kernel::{ClassId, ClassKind, Document, Primitive};
use std::collections::BTreeMap;
use syntax::WalkEvent;
use syntax::ast::{self, AstNode, BinaryOp, Expr, TypeShape, UnaryOp};

/// What a part may be that decides which parts there are.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Deciding {
    /// A whole number.
    Whole,
    /// A truth value, 0 or 1.
    Truth,
    /// An option of a choice, its place.
    Choice(ClassId),
}

/// What is known where an expression of constants stands.
pub(crate) struct Known<'k> {
    pub(crate) document: &'k Document,
    /// The number that a name or a path stands for.
    pub(crate) number: &'k dyn Fn(&Expr) -> Option<f64>,
    /// What a name may be.
    pub(crate) kind: &'k dyn Fn(&Name) -> Deciding,
}

impl Known<'_> {
    /// Returns what an expression comes to where this is wanted: a number, 0 or 1, the place of an option.
    pub(crate) fn value(&self, e: &Expr, wanted: Deciding) -> Option<f64> {
        match wanted {
            Deciding::Whole => numbers::constant(self.number, e),
            Deciding::Truth => self.truth(e).map(f64::from),
            Deciding::Choice(choice) => self.option(e, choice),
        }
    }

    fn option(&self, e: &Expr, choice: ClassId) -> Option<f64> {
        match e {
            Expr::Paren(inner) => self.option(&inner.inner()?, choice),
            Expr::Name(name) => {
                let at = self.document.option_named(choice, name.name()?.text());
                at.map(f64::from).or_else(|| (self.number)(e))
            }
            Expr::Field(field) => {
                let Expr::Name(of) = field.receiver()? else { return None };
                let is_choice = self.document.classes[choice].name == of.name()?.name();
                let at = self.document.option_named(choice, field.name()?.text());
                at.filter(|_| is_choice).map(f64::from)
            }
            _ => None,
        }
    }

    /// Returns the truth value that an expression is.
    pub(crate) fn truth(&self, e: &Expr) -> Option<bool> {
        match e {
            Expr::Bool(b) => Some(b.value()),
            Expr::Paren(inner) => self.truth(&inner.inner()?),
            Expr::Name(name) if (self.kind)(&name.name()?.name()) == Deciding::Truth => {
                (self.number)(e).map(|x| x != 0.0)
            }
            Expr::Unary(u) if u.op()? == UnaryOp::Not => Some(!self.truth(&u.operand()?)?),
            Expr::Binary(b) => {
                let (op, left, right) = (b.op()?, b.left()?, b.right()?);
                match op {
                    BinaryOp::And => Some(self.truth(&left)? && self.truth(&right)?),
                    BinaryOp::Or => Some(self.truth(&left)? || self.truth(&right)?),
                    _ => self.compared(op, &left, &right),
                }
            }
            Expr::Chain(chain) => {
                let operands: Vec<Expr> = chain.operands().collect();
                let mut holds = true;
                for ((op, _), pair) in chain.ops().zip(operands.windows(2)) {
                    holds &= self.compared(op, &pair[0], &pair[1])?;
                }
                Some(holds)
            }
            _ => None,
        }
    }

    fn compared(&self, op: BinaryOp, a: &Expr, b: &Expr) -> Option<bool> {
        let wanted = match (self.kind_of(a), self.kind_of(b)) {
            (Deciding::Whole, other) => other,
            (one, _) => one,
        };
        let (a, b) = (self.value(a, wanted)?, self.value(b, wanted)?);
        Some(match op {
            BinaryOp::Equal => a == b,
            BinaryOp::NotEqual => a != b,
            _ if wanted != Deciding::Whole => return None,
            BinaryOp::Less => a < b,
            BinaryOp::LessEqual => a <= b,
            BinaryOp::Greater => a > b,
            BinaryOp::GreaterEqual => a >= b,
            _ => return None,
        })
    }

    fn kind_of(&self, e: &Expr) -> Deciding {
        match e {
            Expr::Name(name) => name.name().map_or(Deciding::Whole, |w| (self.kind)(&w.name())),
            Expr::Bool(_) => Deciding::Truth,
            _ => Deciding::Whole,
        }
    }
}

/// Returns what a part may be that can decide which parts there are; nothing for any other part.
pub(crate) fn deciding(
    document: &Document,
    choices: &[ClassId],
    part: &ast::Part,
) -> Option<Deciding> {
    let Some(TypeShape::Named(words)) = part.class().map(|ty| ty.shape()) else { return None };
    if part.definition().is_some() {
        return None;
    }
    match words.last()?.text() {
        "Integer" => Some(Deciding::Whole),
        "Bool" => Some(Deciding::Truth),
        name => options_of(document, choices, name).map(Deciding::Choice),
    }
}

impl Lowerer<'_> {
    /// Returns what a part of this name may be that decides which parts things of a class have.
    pub(crate) fn deciding_of(&self, class: ClassId, name: &Name) -> Deciding {
        let line = self.document.primary_line(class);
        let known = line.iter().find_map(|c| self.counts.kinds.get(&(*c, name.clone())));
        known.copied().unwrap_or(Deciding::Whole)
    }

    /// Returns true for a truth value or an option of a class of which nothing is said.
    pub(super) fn is_unsaid(&self, class: ClassId, name: &Name) -> bool {
        let line = self.document.primary_line(class);
        line.iter().any(|c| self.counts.unsaid.contains(&(*c, name.clone())))
            && self.count_of_class(class, name).is_none()
    }

    /// Says how a part that a condition speaks of is declared, where nothing says what it is.
    #[cold]
    #[inline(never)]
    pub(crate) fn with_default(&mut self, scope: &Scope, condition: &Expr) -> Option<String> {
        for name in names_in(condition) {
            if self.constant_named(scope, &name).is_some() {
                continue;
            }
            let class = scope.classes.iter().find_map(|&c| self.class_of_part(c, &name));
            let Some(class) = class else { continue };
            let first = match self.document.classes[class].kind {
                ClassKind::Primitive(Primitive::Integer) => "3",
                ClassKind::Primitive(Primitive::Bool) => "false",
                ClassKind::Primitive(Primitive::Choice(of)) => {
                    self.document.classes[of].options.first()?.as_str()
                }
                _ => continue,
            };
            let class = &self.document.classes[class].name;
            return Some(format!(
                "say what {name} is where nothing else is said: `{name}: {class} = {first}`"
            ));
        }
        None
    }

    /// Returns what a name may be where it stands.
    pub(crate) fn deciding_in(&self, scope: &Scope, name: &Name) -> Deciding {
        let mut kinds = scope.classes.iter().map(|&class| self.deciding_of(class, name));
        kinds.find(|kind| *kind != Deciding::Whole).unwrap_or(Deciding::Whole)
    }

    /// Returns the truth value that an expression of constants is.
    pub(crate) fn constant_truth(&mut self, scope: &Scope, e: &Expr) -> Option<bool> {
        let numbers = self.constants_in(scope, e);
        let known = Known {
            document: &self.document,
            number: &|e| numbers.get(&e.span()).copied(),
            kind: &|name| self.deciding_in(scope, name),
        };
        known.truth(e)
    }

    /// Returns the numbers that the names and paths in an expression stand for, by where they stand. What stands in an
    /// index belongs to the element that it takes.
    pub(crate) fn constants_in(&mut self, scope: &Scope, e: &Expr) -> BTreeMap<Span, f64> {
        let mut known = BTreeMap::new();
        let mut walk = e.syntax().preorder();
        while let Some(event) = walk.next() {
            let WalkEvent::Enter(node) = event else { continue };
            let Some(e) = Expr::cast(node) else { continue };
            let number = match &e {
                Expr::Name(name) => name.name().and_then(|w| self.constant_named(scope, &w.name())),
                Expr::Index(_) => {
                    walk.skip_subtree();
                    known.extend(self.listed_number(scope, &e).map(|n| (e.span(), n)));
                    continue;
                }
                e => self.constant_count(scope, e),
            };
            known.extend(number.map(|n| (e.span(), n as f64)));
        }
        known
    }
}
