//! Colours by component: `(c + d) / 2` is the colour halfway, `0.5 * c` the one half as bright.
//!
//! A sum of two colours is made of the sums of what is red, green and blue in them. It need not be a colour itself, so
//! that nothing is put together before the last operator. What has a name, a message or a `let`, is a colour.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place, Span};
use kernel::{Argument, BinaryOperator, Term};

/// The function that makes a colour of its components.
const MADE: &str = "rgb";
/// The components, in its order.
const COMPONENTS: [&str; 3] = ["red", "green", "blue"];
/// An operand stands in each component; one of more terms needs a name.
const MOST_REPEATED: usize = 64;

impl Lowerer<'_> {
    /// Applies an operator to the components of colours: two are added or subtracted, one is multiplied by a plain
    /// number or divided by it. What is not known is taken for what fits.
    ///
    /// Returns nothing where this is no matter of colours, and nothing in it where an operand is too long, which is
    /// reported.
    pub(crate) fn of_colours(
        &mut self,
        (scope, span): (&Scope, Span),
        operator: BinaryOperator,
        (a, ka): (&Term, &Kind),
        (b, kb): (&Term, &Kind),
    ) -> Option<Option<(Term, Kind)>> {
        let number = |k: &Kind| {
            matches!(k, Kind::Number(_) | Kind::Unknown) && k.fits(&Kind::PLAIN, &self.document)
        };
        let is_colour = |k: &Kind| matches!(k, Kind::Color | Kind::Unknown);
        let (left, right) = match operator {
            BinaryOperator::Add | BinaryOperator::Subtract if is_colour(ka) && is_colour(kb) => {
                (true, true)
            }
            BinaryOperator::Multiply | BinaryOperator::Divide
                if *ka == Kind::Color && number(kb) =>
            {
                (true, false)
            }
            BinaryOperator::Multiply if number(ka) && *kb == Kind::Color => (false, true),
            _ => return None,
        };
        let repeated = |term: &Term, is_colour: bool| match is_colour {
            true => size_beside_components(term),
            false => size(term),
        };
        if repeated(a, left).max(repeated(b, right)) > MOST_REPEATED {
            let place = Place { file: scope.file, span };
            let message =
                "found a long expression beside an operator of colours, wanted a short one";
            let d = Diagnostic::error("too-large", place, message);
            self.report(d.hint("give what is long a name: `let share = … in share * c`"));
            return Some(None);
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
        let made = Term::Call { name: Name::new(MADE), arguments: each.collect() };
        Some(Some((made, Kind::Color)))
    }
}

/// Returns how much of one component is in a colour.
fn component(colour: &Term, at: usize) -> Term {
    let boxed = |term: &Term| Box::new(component(term, at));
    match colour {
        Term::Call { name, arguments } if *name == *MADE => {
            argument(arguments, at).cloned().unwrap_or_else(|| whole(colour, at))
        }
        Term::If(condition, a, b) => Term::If(condition.clone(), boxed(a), boxed(b)),
        Term::Let(name, value, inner) => Term::Let(name.clone(), value.clone(), boxed(inner)),
        _ => whole(colour, at),
    }
}

fn whole(colour: &Term, at: usize) -> Term {
    Term::send(colour.clone(), COMPONENTS[at])
}

/// Returns the argument that is one component: by its label, by its position where it has none.
fn argument(arguments: &[Argument], at: usize) -> Option<&Term> {
    let is = |(place, a): &(usize, &Argument)| match &a.label {
        Some(label) => **label == *COMPONENTS[at],
        None => *place == at,
    };
    arguments.iter().enumerate().find(is).map(|(_, a)| &a.value)
}

/// Returns of how many terms that which stands in each component of a colour is made.
fn size_beside_components(colour: &Term) -> usize {
    match colour {
        Term::Call { name, .. } if *name == *MADE => 0,
        Term::If(condition, a, b) => {
            size(condition) + size_beside_components(a) + size_beside_components(b)
        }
        Term::Let(_, value, inner) => size(value) + size_beside_components(inner),
        whole => size(whole),
    }
}

/// Returns of how many terms a term is made; counting ends where there are too many to repeat.
fn size(term: &Term) -> usize {
    let mut waiting = vec![term];
    let mut count = 0;
    while let Some(next) = waiting.pop().filter(|_| count <= MOST_REPEATED) {
        count += 1;
        waiting.extend(next.operands());
    }
    count
}
