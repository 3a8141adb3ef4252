//! What is given to the functions and messages of the language: each in its place, and what functions that are written
//! as arguments, `x => x.width`, are given and have to answer.

use crate::calls::Arg;
use crate::hints::lists::with_test_hint;
use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place, Span};
use kernel::Term;
use kernel::builtin::{self, Given, Kind as Builtin};
use syntax::ast::{self, AstNode, Expr};

impl Lowerer<'_> {
    /// Lowers a function of elements of this kind; what it answers is told beside it.
    pub(crate) fn lambda(
        &mut self,
        scope: &Scope,
        lambda: &ast::LambdaExpr,
        element: &Kind,
    ) -> Option<(Term, Kind)> {
        let names: Vec<Name> = lambda.params().map(|w| w.name()).collect();
        let kinds = match (&names[..], element) {
            ([_], _) => vec![element.clone()],
            // a pair is taken apart
            (_, Kind::Tuple(items)) if items.len() == names.len() => items.clone(),
            (_, Kind::Unknown | Kind::List(_) | Kind::Thing(_)) => Vec::new(),
            _ => {
                self.takes_one_element(scope, lambda, element);
                return None;
            }
        };
        let kinds = kinds.into_iter().chain(std::iter::repeat(Kind::Unknown));
        let bound = names.iter().zip(kinds);
        let inner = bound.fold(scope.clone(), |s, (name, kind)| s.with_local(name.clone(), kind));
        let (body, answer) = self.expr(&inner, &lambda.body()?)?;
        Some((Term::Lambda(names, Box::new(body)), answer))
    }

    /// Checks that each argument has a place of its own, and that none is left out before one that is given by its label.
    pub(crate) fn have_places<F>(
        &mut self,
        scope: &Scope,
        (b, span): (&'static builtin::Builtin<F>, Span),
        args: &[Arg],
    ) -> Option<()> {
        let mut taken = vec![false; b.parameters.len()];
        for (position, arg) in args.iter().enumerate() {
            let is_it =
                |label: &ast::Word| b.parameters.iter().position(|p| p.label == label.text());
            let place = arg.label.as_ref().map_or(Some(position), is_it);
            let Some(taken) = place.and_then(|place| taken.get_mut(place)) else { continue };
            if std::mem::replace(taken, true) {
                let label = place.and_then(|place| b.parameters.get(place)).map_or("", |p| p.label);
                let message = format!("{label} of {} is given twice", b.name);
                self.error("wrong-arity", scope.file, arg.expr.span(), message);
                return None;
            }
        }
        let last = taken.iter().rposition(|taken| *taken).unwrap_or(0);
        // a text of which nothing is said is empty
        let is_left_out = |(taken, p): &(&bool, &builtin::BuiltinParameter)| {
            let may_be_empty = p.given == Given::Perhaps && p.kind == Builtin::Text;
            !**taken && !may_be_empty
        };
        let Some((_, missing)) = taken.iter().take(last).zip(b.parameters).find(is_left_out) else {
            return Some(());
        };
        let message = format!("{} wants {} as well", b.name, missing.label);
        self.error("wrong-arity", scope.file, span, message);
        None
    }

    /// Checks what the kind of an argument alone does not tell: what a function answers, and that a list stands alone where
    /// it is taken for its numbers.
    pub(crate) fn fits_call(
        &mut self,
        scope: &Scope,
        name: &str,
        (wanted, count): (Builtin, usize),
        arg: &Arg,
    ) -> Option<()> {
        let place = Place { file: scope.file, span: arg.expr.span() };
        let written = || arg.expr.syntax().text().to_string().trim().to_string();
        match (wanted, &arg.kind, &arg.answers) {
            (Builtin::Test, _, Kind::Bool | Kind::Unknown) => Some(()),
            (Builtin::Test, _, answers) => {
                let found = answers.words(&self.document);
                let message =
                    format!("{name} wants a function of a truth value, this one answers {found}");
                let d = Diagnostic::error("value-of-wrong-class", place, message);
                self.report(with_test_hint(d, answers, &arg.expr));
                None
            }
            (Builtin::Numbers, Kind::List(_) | Kind::Tuple(_), _) if count > 1 => {
                let message = format!(
                    "{name} wants numbers, or one list of these; here is a list among others"
                );
                let d = Diagnostic::error("value-of-wrong-class", place, message);
                self.report(d.hint(format!("one number of it is `{}.{name}`", written())));
                None
            }
            _ => Some(()),
        }
    }

    /// Reports branches of which one is of another kind.
    pub(crate) fn unlike_branches(
        &mut self,
        scope: &Scope,
        choice: &ast::IfExpr,
        (then, other): (&Kind, &Kind),
    ) {
        let ((Kind::Text, Kind::Number(_)) | (Kind::Number(_), Kind::Text)) = (then, other) else {
            return self.mismatch(scope, choice.span(), None, (then, other));
        };
        let (a, b) = (then.words(&self.document), other.words(&self.document));
        let place = Place { file: scope.file, span: choice.span() };
        let message = format!("one branch is {a}, the other {b}, wanted one kind in both");
        let d = Diagnostic::error("value-of-wrong-class", place, message);
        let number = if *then == Kind::Text { choice.else_value() } else { choice.then_value() };
        let number = number.map(|e| e.syntax().text().to_string().trim().to_string());
        self.report(match number {
            Some(number) if number.len() < 30 => d.hint(match number.parse::<f64>() {
                Ok(_) => format!("a number as a text stands in quotes: `\"{number}\"`"),
                Err(_) => format!("a number stands in a text in braces: `\"{{{number}}}\"`"),
            }),
            _ => d,
        });
    }

    /// Returns the variable of a loop that an index speaks of, and what it is in this turn.
    pub(crate) fn turn_of(&self, scope: &Scope, index: &Expr) -> Option<(String, i64)> {
        let Expr::Binary(difference) = index else { return None };
        let Expr::Name(name) = difference.left()? else { return None };
        let word = name.name()?;
        Some((word.text().to_string(), scope.whole(&word.name())?))
    }

    /// Reports a function of several arguments where each element is one.
    #[cold]
    #[inline(never)]
    fn takes_one_element(&mut self, scope: &Scope, lambda: &ast::LambdaExpr, element: &Kind) {
        let count = lambda.params().count();
        let found = element.words(&self.document);
        let message = format!("a function of {count} is given one element at a time, {found}");
        let place = Place { file: scope.file, span: lambda.span() };
        let d = Diagnostic::error("wrong-arity", place, message);
        let body = lambda.body().map(|body| body.syntax().text().to_string());
        self.report(match (element, body) {
            (Kind::Tuple(items), _) => d.hint(format!("it has {} parts, each with a name", items.len())),
            (_, Some(body)) if count == 2 => d.hint(format!(
                "pairs are what `xs.neighbours` and `xs.zip(ys)` have: `xs.zip(ys).map((a, b) => {})`",
                body.trim()
            )),
            _ => d,
        });
    }
}

/// Returns the kind of a pair; bare numbers may measure whatever is wanted.
pub(crate) fn pair(a: &Kind, b: &Kind) -> Kind {
    let known = |kind: &Kind| match kind {
        Kind::Number(None) => Kind::Unknown,
        known => known.clone(),
    };
    Kind::Tuple(vec![known(a), known(b)])
}

/// Returns a kind that says whether a number is wanted, for the code of a diagnostic.
pub(crate) fn wanted_number(wanted: Builtin) -> Kind {
    match wanted {
        Builtin::Plain
        | Builtin::Number
        | Builtin::Same
        | Builtin::Root
        | Builtin::Length
        | Builtin::Numbers => Kind::Number(None),
        Builtin::Bool
        | Builtin::Text
        | Builtin::Color
        | Builtin::Place
        | Builtin::List
        | Builtin::Plains
        | Builtin::Texts
        | Builtin::Measures
        | Builtin::Ordered
        | Builtin::Alike
        | Builtin::Beside
        | Builtin::Element
        | Builtin::Answer
        | Builtin::Function
        | Builtin::Test
        | Builtin::Picture
        | Builtin::Pictures
        | Builtin::Any => Kind::Unknown,
    }
}

/// Returns what an operand is worth beside another: what a text spells may measure anything, but is a number.
pub(crate) fn spelled(term: &Term, kind: Kind, other: &Kind) -> Kind {
    let is_spelled = matches!(term, Term::Send { name, arguments, .. } if *name == *"number" && arguments.is_empty());
    match other {
        Kind::Number(_) | Kind::Unknown => kind,
        _ if kind == Kind::Unknown && is_spelled => Kind::PLAIN,
        _ => kind,
    }
}
