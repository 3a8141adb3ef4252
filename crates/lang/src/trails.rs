//! Trails: what `for` merges, found out in one turn of the loop and only counted in the others.
//!
//! In the turns of a loop a path differs in its indices alone, as a rule. Of a merge whose indices are sums
//! of multiples of the loops' numbers, and whose steps lead to the same classes in every turn, the steps are
//! looked up once. Wherever anything is not so plain, or an index is out of range, nothing is known here,
//! and the path is lowered as any other.

use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{FileId, Name};
use kernel::{ClassId, Path, Step};
use std::collections::BTreeMap;
use syntax::ast::{self, AstNode, BinaryOp, Expr, UnaryOp};

/// The merges of loops that were lowered, while nothing but merges is.
#[derive(Default)]
pub(crate) struct Trails(BTreeMap<(FileId, u32), Merged>);

/// A merge as it was lowered in one turn.
struct Merged {
    /// The classes around it.
    classes: Vec<ClassId>,
    /// Nothing where some path of it has to be lowered in every turn.
    trails: Option<Vec<Trail>>,
}

/// A path in any turn of the loops around it.
type Trail = Vec<Tread>;

/// A step of a path in any turn.
enum Tread {
    Step(Step),
    /// To an element of a list that has so many, if that is known.
    Index(Sum, Option<u32>),
    /// To what a loop's variable stands for, of this class.
    Variable(Name, ClassId),
}

/// A whole number and multiples of the numbers that loops bind names to.
#[derive(Default)]
struct Sum {
    constant: i64,
    terms: Vec<(Name, i64)>,
}

/// Numbers beyond this are no indices, and sums of them might not be exact.
const LARGEST: i64 = 1 << 32;

impl Sum {
    fn number(constant: i64) -> Option<Self> {
        (constant.abs() < LARGEST).then(|| Self { constant, terms: Vec::new() })
    }
    /// Reads an expression of whole numbers and of names that loops bind to numbers.
    fn of(scope: &Scope, e: &Expr) -> Option<Self> {
        match e {
            Expr::Number(n) if n.unit().is_none() => {
                let x = n.value()?;
                (x.fract() == 0.0 && x.abs() < LARGEST as f64).then(|| Self::number(x as i64))?
            }
            Expr::Paren(inner) => Self::of(scope, &inner.inner()?),
            Expr::Name(name) => {
                let name = name.name()?.name();
                let is_bound = scope.whole(&name).is_some();
                is_bound.then(|| Self { constant: 0, terms: vec![(name, 1)] })
            }
            Expr::Unary(unary) => match unary.op()? {
                UnaryOp::Negate => Self::of(scope, &unary.operand()?)?.times(-1),
                UnaryOp::Plus => Self::of(scope, &unary.operand()?),
                UnaryOp::Not => None,
            },
            Expr::Binary(binary) => {
                let one = Self::of(scope, &binary.left()?)?;
                let other = Self::of(scope, &binary.right()?)?;
                match binary.op()? {
                    BinaryOp::Add => one.plus(other),
                    BinaryOp::Subtract => one.plus(other.times(-1)?),
                    BinaryOp::Multiply if one.terms.is_empty() => other.times(one.constant),
                    BinaryOp::Multiply if other.terms.is_empty() => one.times(other.constant),
                    _ => None,
                }
            }
            _ => None,
        }
    }
    fn plus(mut self, other: Self) -> Option<Self> {
        self.constant += other.constant;
        self.terms.extend(other.terms);
        (self.constant.abs() < LARGEST).then_some(self)
    }
    fn times(mut self, factor: i64) -> Option<Self> {
        let is_small = |x: i64| x.checked_mul(factor).filter(|x| x.abs() < LARGEST);
        self.constant = is_small(self.constant)?;
        for (_, times) in &mut self.terms {
            *times = is_small(*times)?;
        }
        Some(self)
    }
    /// Returns the index that it is in a turn.
    fn index(&self, scope: &Scope) -> Option<u32> {
        let mut sum = self.constant;
        for (name, times) in &self.terms {
            let bound = scope.whole(name)?;
            sum = sum.checked_add(bound.checked_mul(*times).filter(|x| x.abs() < LARGEST)?)?;
        }
        u32::try_from(sum).ok()
    }
}

/// Returns the path of a trail in a turn; nothing where it has to be lowered.
fn walk(scope: &Scope, trail: &Trail) -> Option<Path> {
    let mut steps = Vec::with_capacity(trail.len());
    for tread in trail {
        match tread {
            Tread::Step(step) => steps.push(step.clone()),
            Tread::Index(sum, count) => {
                let i = sum.index(scope).filter(|i| count.is_none_or(|count| *i < count))?;
                steps.push(Step::Index(i));
            }
            Tread::Variable(name, class) => {
                let element = scope.element(name).filter(|e| e.class == Some(*class))?;
                steps.extend(scope.path_to(element).0);
            }
        }
    }
    Some(Path(steps))
}

impl Lowerer<'_> {
    /// Lowers the paths of a merge, and counts them; those that are wrong are left out.
    pub(crate) fn paths_of_merge(
        &mut self,
        scope: &Scope,
        merge: &ast::Merge,
        trails: &mut Trails,
    ) -> (Vec<Path>, usize) {
        if !scope.turns.is_empty() && self.references.is_none() {
            let key = (scope.file, merge.span().start);
            match trails.0.get(&key).filter(|known| known.classes == scope.classes) {
                Some(Merged { trails: Some(trails), .. }) => {
                    let walked: Option<Vec<Path>> = trails.iter().map(|t| walk(scope, t)).collect();
                    if let Some(paths) = walked {
                        return (paths, trails.len());
                    }
                }
                Some(_) => {}
                None => {
                    let made = merge.paths().map(|e| Some(self.trail(scope, &e)?.0)).collect();
                    let made = Merged { classes: scope.classes.clone(), trails: made };
                    trails.0.insert(key, made);
                }
            }
        }
        (self.paths(scope, merge.paths()), merge.paths().count())
    }

    /// Finds what a path is in every turn, with its path in this one and the class of what it leads to.
    fn trail(&self, scope: &Scope, e: &Expr) -> Option<(Trail, Path, ClassId)> {
        match e {
            Expr::Paren(inner) => self.trail(scope, &inner.inner()?),
            Expr::Name(name) => {
                let name = name.name()?.name();
                if let Some(element) = scope.element(&name) {
                    let (path, class) = (scope.path_to(element), element.class?);
                    return Some((vec![Tread::Variable(name, class)], path, class));
                }
                let mut path = Path::default();
                for &class in &scope.classes {
                    if let Some(part) = self.class_of_part(class, &name) {
                        path = path.then(Step::Part(name));
                        let trail = path.0.iter().cloned().map(Tread::Step).collect();
                        return Some((trail, path, part));
                    }
                    if self.find_message(class, &name, None).is_some() {
                        return None;
                    }
                    path = path.then(Step::Owner);
                }
                None
            }
            Expr::Field(field) if field.args().is_none() => {
                let (mut trail, path, class) = self.trail(scope, &field.receiver()?)?;
                let name = field.name()?.name();
                // what leads outwards, or to the last, is looked up in every turn
                if name == "owner" || self.element(class).is_some() {
                    return None;
                }
                let part = self.class_of_part(class, &name)?;
                trail.push(Tread::Step(Step::Part(name.clone())));
                Some((trail, path.then(Step::Part(name)), part))
            }
            Expr::Index(index) => {
                let (mut trail, path, list) = self.trail(scope, &index.receiver()?)?;
                // elements may be of classes of their own
                let is_plain = self.document.classes[list].elements.is_empty();
                let element = self.element(list).filter(|_| is_plain)?;
                let at = Sum::of(scope, &index.index()?)?;
                let path = path.then(Step::Index(at.index(scope)?));
                let list_path = Path(path.0[..path.0.len() - 1].to_vec());
                trail.push(Tread::Index(at, self.count_at(scope, &list_path)));
                Some((trail, path, element))
            }
            _ => None,
        }
    }
}
