//! Places by component: `(p + q) / 2`, `p + (10, 0)`, `-p`, `k * p`. In: operands whose kinds are known. Out: a term
//! that makes the place of the components, so that whoever opens or computes it knows constructors alone.

use crate::kinds::{Kind, fields, measured};
use crate::lower::Lowerer;
use base::Name;
use kernel::{Argument, BinaryOperator, ClassId, PartRef, Term, UnaryOperator};

/// The names of the operands, which no text can use.
const LEFT: &str = "(left)";
const RIGHT: &str = "(right)";

/// What an operator is applied to, component by component.
#[derive(Clone)]
enum Shape {
    /// A thing of a class that is a place.
    Place(ClassId),
    /// `(a, b)`, so many.
    Tuple(Vec<Kind>),
    /// One number, the same for every component.
    Number(Kind),
}

impl Lowerer<'_> {
    /// Applies an operator component by component, where one side is a place or `(x, y)` and the other fits; nothing
    /// where this is no matter of components.
    pub(crate) fn by_component(
        &self,
        operator: BinaryOperator,
        (a, ka): (&Term, &Kind),
        (b, kb): (&Term, &Kind),
    ) -> Option<(Term, Kind)> {
        let (left, right) = (self.shape_of(ka)?, self.shape_of(kb)?);
        let shape = match (operator, &left, &right) {
            (BinaryOperator::Add | BinaryOperator::Subtract, Shape::Place(p), Shape::Place(q)) => {
                Shape::Place(self.common_place(*p, *q)?)
            }
            (BinaryOperator::Add | BinaryOperator::Subtract, Shape::Place(p), Shape::Tuple(_))
            | (BinaryOperator::Add | BinaryOperator::Subtract, Shape::Tuple(_), Shape::Place(p)) => {
                Shape::Place(*p)
            }
            (BinaryOperator::Add | BinaryOperator::Subtract, Shape::Tuple(_), Shape::Tuple(_))
            | (
                BinaryOperator::Multiply | BinaryOperator::Divide,
                Shape::Tuple(_),
                Shape::Number(_),
            )
            | (BinaryOperator::Multiply, Shape::Number(_), Shape::Tuple(_)) => {
                left_or(&left, &right)
            }
            (
                BinaryOperator::Multiply | BinaryOperator::Divide,
                Shape::Place(_),
                Shape::Number(_),
            )
            | (BinaryOperator::Multiply, Shape::Number(_), Shape::Place(_)) => {
                let place = left_or(&left, &right);
                let number = if matches!(left, Shape::Number(_)) { ka } else { kb };
                // what is no length any more is a pair of numbers
                let is_plain = number.fits(&Kind::PLAIN, &self.document);
                if is_plain { place } else { Shape::Tuple(self.components(&place)) }
            }
            _ => return None,
        };
        let (of_left, of_right) = (self.components(&left), self.components(&right));
        let count = [&left, &right]
            .into_iter()
            .filter(|s| !matches!(s, Shape::Number(_)))
            .map(|s| self.components(s).len());
        let count = count.reduce(|a, b| if a == b { a } else { 0 }).filter(|&n| n > 0)?;
        let kind_at = |kinds: &[Kind], i: usize| {
            kinds.get(i).or(kinds.first()).cloned().unwrap_or(Kind::Unknown)
        };
        let mut items = Vec::new();
        let mut kinds = Vec::new();
        for i in 0..count {
            let (ki, kj) = (kind_at(&of_left, i), kind_at(&of_right, i));
            let x = self.component(&left, a, LEFT, i);
            let y = self.component(&right, b, RIGHT, i);
            let kind = self.combined_kind(operator, &ki, &kj, &y)?;
            let (x, y) = match operator {
                BinaryOperator::Add | BinaryOperator::Subtract => {
                    (measured(&self.document, x, &ki, &kj), measured(&self.document, y, &kj, &ki))
                }
                _ => (x, y),
            };
            items.push(Term::Binary(operator, Box::new(x), Box::new(y)));
            kinds.push(kind);
        }
        let made = self.made(&shape, items, kinds)?;
        let body = self.bind(&right, b, RIGHT, made.0);
        Some((self.bind(&left, a, LEFT, body), made.1))
    }

    /// Negates a place or `(x, y)` component by component.
    pub(crate) fn negated_by_component(&self, a: &Term, kind: &Kind) -> Option<(Term, Kind)> {
        let shape = self.shape_of(kind)?;
        if let Shape::Number(_) = shape {
            return None;
        }
        let kinds = self.components(&shape);
        let negated = |i| {
            let x = self.component(&shape, a, LEFT, i);
            Term::Unary(UnaryOperator::Negate, Box::new(x))
        };
        let (made, kind) = self.made(&shape, (0..kinds.len()).map(negated).collect(), kinds)?;
        Some((self.bind(&shape, a, LEFT, made), kind))
    }

    /// Makes the sum or the mean of a list of places, component by component; nothing of anything else.
    pub(crate) fn places_by_component(
        &self,
        message: &Name,
        list: &Term,
        kind: &Kind,
    ) -> Option<(Term, Kind)> {
        let Kind::List(each) = kind else { return None };
        let Kind::Thing(class) = **each else { return None };
        let class = self.place_of(class).filter(|_| *message == *"sum" || *message == *"mean")?;
        let (all, each) = (Name::new(LEFT), Name::new(RIGHT));
        let of_field = |&field: &PartRef| {
            let body = Term::send(Term::Local(each.clone()), self.document.field_name(field));
            let value = Term::Lambda(vec![each.clone()], Box::new(body));
            let numbers = Term::Send {
                to: Box::new(Term::Local(all.clone())),
                name: Name::new("map"),
                arguments: vec![Argument { label: None, value }],
                search: None,
            };
            Argument { label: None, value: Term::send(numbers, message) }
        };
        let arguments = self.document.layout(class).iter().map(of_field).collect();
        let made = Term::Make { class, arguments };
        Some((Term::Let(all, Box::new(list.clone()), Box::new(made)), Kind::Thing(class)))
    }

    /// Finds what a kind is to components: a place, as far as the class has one, numbers in brackets, or a number.
    fn shape_of(&self, kind: &Kind) -> Option<Shape> {
        match kind {
            Kind::Thing(class) => self.place_of(*class).map(Shape::Place),
            Kind::Tuple(items) => {
                let are_numbers = items.iter().all(|k| matches!(k, Kind::Number(_)));
                are_numbers.then(|| Shape::Tuple(items.clone()))
            }
            Kind::Number(_) => Some(Shape::Number(kind.clone())),
            Kind::Bool
            | Kind::Option(_)
            | Kind::Text
            | Kind::Color
            | Kind::List(_)
            | Kind::Picture
            | Kind::Function
            | Kind::Unknown => None,
        }
    }

    /// Returns the nearest class along the primary line whose things are places and no more.
    fn place_of(&self, class: ClassId) -> Option<ClassId> {
        let line = self.document.primary_line(class);
        line.into_iter().find(|&c| self.is_place_so_far(c))
    }

    /// Returns true if all that is declared of a class are two or three real numbers of one dimension.
    fn is_place_so_far(&self, class: ClassId) -> bool {
        let kinds = fields(&self.document, class);
        let alike = kinds.windows(2).all(|pair| pair[0] == pair[1]);
        let is_number = |k: &Kind| matches!(k, Kind::Number(Some(_)));
        alike && (2..=3).contains(&kinds.len()) && kinds.iter().all(is_number)
    }

    fn common_place(&self, a: ClassId, b: ClassId) -> Option<ClassId> {
        let line = self.document.primary_line(b);
        let shared = self.document.primary_line(a).into_iter().find(|c| line.contains(c))?;
        self.is_place_so_far(shared).then_some(shared)
    }

    fn components(&self, shape: &Shape) -> Vec<Kind> {
        match shape {
            Shape::Place(class) => fields(&self.document, *class),
            Shape::Tuple(kinds) => kinds.clone(),
            Shape::Number(kind) => vec![kind.clone()],
        }
    }

    /// Returns the component of an operand: of a place that was bound to a name, of what stands in brackets itself.
    fn component(&self, shape: &Shape, operand: &Term, name: &'static str, i: usize) -> Term {
        match (shape, operand) {
            (Shape::Tuple(_), Term::Tuple(items)) => items[i].clone(),
            (Shape::Tuple(_), _) => {
                let local = Box::new(Term::Local(Name::new(name)));
                Term::Index(local, Box::new(Term::number(i as f64)))
            }
            (Shape::Number(_), Term::Number { .. }) => operand.clone(),
            (Shape::Number(_), _) => Term::Local(Name::new(name)),
            (Shape::Place(class), _) => {
                let field = self
                    .document
                    .layout(*class)
                    .get(i)
                    .map(|&f| self.document.field_name(f).clone());
                Term::send(Term::Local(Name::new(name)), &field.unwrap_or_else(|| Name::new("")))
            }
        }
    }

    /// Binds an operand to its name, where its components speak of that.
    fn bind(&self, shape: &Shape, operand: &Term, name: &'static str, body: Term) -> Term {
        match (shape, operand) {
            (Shape::Tuple(_), Term::Tuple(_)) | (Shape::Number(_), Term::Number { .. }) => body,
            _ => Term::Let(Name::new(name), Box::new(operand.clone()), Box::new(body)),
        }
    }

    fn made(&self, shape: &Shape, items: Vec<Term>, kinds: Vec<Kind>) -> Option<(Term, Kind)> {
        match shape {
            Shape::Place(class) => {
                let wanted = fields(&self.document, *class);
                let fit = kinds.iter().zip(&wanted).all(|(k, w)| k.fits(w, &self.document));
                let item = |((value, kind), wanted): ((Term, &Kind), &Kind)| Argument {
                    label: None,
                    value: measured(&self.document, value, kind, wanted),
                };
                let arguments = items.into_iter().zip(&kinds).zip(&wanted).map(item).collect();
                fit.then_some((Term::Make { class: *class, arguments }, Kind::Thing(*class)))
            }
            Shape::Tuple(_) => Some((Term::Tuple(items), Kind::Tuple(kinds))),
            Shape::Number(_) => None,
        }
    }
}

/// Returns the one of two shapes that has components; the first, where both have.
fn left_or(left: &Shape, right: &Shape) -> Shape {
    if let Shape::Number(_) = left { right.clone() } else { left.clone() }
}
