//! Colours by component: `(c + d) / 2` is the colour halfway, `0.5 * c` the one half as bright.
//!
//! A sum of two colours is made of the sums of what is red, green and blue in them. It need not be a colour itself, so
//! that nothing is put together before the last operator.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::Name;
use kernel::{Argument, BinaryOperator, ClassKind, Primitive, Term};

/// The function that makes a colour of its components.
const MADE: &str = "rgb";
/// The components, in its order.
const COMPONENTS: [&str; 3] = ["red", "green", "blue"];

impl Lowerer<'_> {
    /// Applies an operator to the components of colours: two are added or subtracted, one is multiplied by a plain
    /// number or divided by it; nothing where this is no matter of colours.
    pub(crate) fn of_colours(
        &self,
        scope: &Scope,
        operator: BinaryOperator,
        (a, ka): (&Term, &Kind),
        (b, kb): (&Term, &Kind),
    ) -> Option<(Term, Kind)> {
        let number =
            |k: &Kind| matches!(k, Kind::Number(_)) && k.fits(&Kind::PLAIN, &self.document);
        let (left, right) = (self.is_colour(scope, a), self.is_colour(scope, b));
        let applies = match operator {
            BinaryOperator::Add | BinaryOperator::Subtract => left && right,
            BinaryOperator::Multiply => left && number(kb) || number(ka) && right,
            BinaryOperator::Divide => left && number(kb),
            _ => false,
        };
        if !applies {
            return None;
        }
        let operand = |term: &Term, is_colour: bool, at: usize| match is_colour {
            true => component(term, at),
            false => term.clone(),
        };
        let each = (0..COMPONENTS.len()).map(|at| {
            let (x, y) = (operand(a, left, at), operand(b, right, at));
            let value = Term::Binary(operator, Box::new(x), Box::new(y));
            Argument { label: None, value }
        });
        Some((Term::Call { name: Name::new(MADE), arguments: each.collect() }, Kind::Text))
    }

    /// Returns true for a part or message that is a colour, and for what `rgb` makes.
    fn is_colour(&self, scope: &Scope, term: &Term) -> bool {
        if let Term::Call { name, .. } = term {
            return *name == *MADE;
        }
        let class = self.declared_class(scope, term);
        class.is_some_and(|c| {
            self.document.classes[c].kind == ClassKind::Primitive(Primitive::Color)
        })
    }
}

/// Returns how much of one component is in a colour.
fn component(colour: &Term, at: usize) -> Term {
    match colour {
        Term::Call { arguments, .. } if arguments.len() == COMPONENTS.len() => {
            arguments[at].value.clone()
        }
        whole => Term::send(whole.clone(), COMPONENTS[at]),
    }
}
