//! Values of a body that name what is further out.
//!
//! In: a value as it is written in a body. Out: the scope in which its names are looked for. A part is never given
//! itself, so in `{ width = width }` the name on the right is the width further out, and so are both in
//! `{ x = y  y = x }`; in `R1: Resistor { a.node = a }` it is the `a` further out where that can be given and the
//! resistor's own lead cannot. A body connects a thing with what is around it: in `Line { p1 = p2  p2 = p3 }` the first
//! value is the `p2` further out. Where both can be meant, the own one is, and the text is warned.

use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::members::Pending;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::Path;
use std::collections::BTreeSet;
use std::rc::Rc;
use syntax::SyntaxKind;
use syntax::ast::{Assign, AstNode, Expr, NameExpr};

/// The code of the warning.
const CODE: &str = "nearest-name";

impl Lowerer<'_> {
    /// Makes a value of a body look further out for a name that can mean nothing of the thing itself.
    pub(crate) fn look_outwards(&mut self, pending: &mut Pending) {
        let Pending::Value { scope, prefix, target: Some(target), value } = pending else { return };
        if scope.classes.len() < 2 {
            return;
        }
        let own = prefix.is_empty().then(|| word_of(target)).flatten();
        let outwards = match own.filter(|name| self.is_further_out(scope, name)) {
            Some(name) if speaks_of(value, &name) => Some(name),
            own => own
                .and_then(|own| self.in_a_ring(scope, &own, value))
                .or_else(|| self.misfit(scope, &Path(prefix.clone()), target, value)),
        };
        match outwards {
            Some(_) => Rc::make_mut(scope).outwards = outwards,
            None if prefix.is_empty() && self.silent == 0 && scope.file == OWN => {
                self.warn_of_another(scope, target, value);
            }
            None => {}
        }
    }

    /// Returns the bare name that a value is, where by it the part would be given itself through others of its body.
    fn in_a_ring(&self, scope: &Scope, own: &Name, value: &Expr) -> Option<Name> {
        let named = word_of(value).filter(|name| self.is_further_out(scope, name))?;
        let (mut next, mut met) = (named.clone(), BTreeSet::new());
        while next != *own {
            if !met.insert(next.clone()) {
                return None;
            }
            let given = beside(value).find(|given| head_of(given).as_ref() == Some(&next))?;
            next = word_of(&given.value()?.expr()?)?;
        }
        Some(named)
    }

    /// Warns of a name in a value that is a part of the thing itself, of which the body says nothing, and of something
    /// further out, too.
    fn warn_of_another(&mut self, scope: &Scope, target: &Expr, value: &Expr) {
        let binds = |kind| matches!(kind, SyntaxKind::LetExpr | SyntaxKind::LambdaExpr);
        if value.syntax().descendants().any(|node| binds(node.kind())) {
            return;
        }
        let of_target = head(target);
        for written in value.syntax().descendants().filter_map(NameExpr::cast) {
            let Some(word) = written.name() else { continue };
            let name = word.name();
            let is_another = Some(&name) != of_target.as_ref()
                && self.is_further_out(scope, &name)
                && !beside(value).any(|given| head_of(&given).as_ref() == Some(&name));
            let depth = is_another.then(|| self.depth_of_another(scope, &name)).flatten();
            let Some(depth) = depth else { continue };
            let place = Place { file: scope.file, span: word.span() };
            let message =
                format!("{name} is the thing's own here, and there is another further out");
            let other = "owner.".repeat(depth);
            self.report(Diagnostic::warning(CODE, place, message).hint(format!(
                "write `{other}{name}` for the other; the own one is meant where the body gives it, `{name} = …`"
            )));
        }
    }

    /// Returns how many things further out a part of this name and of the same kind is.
    fn depth_of_another(&mut self, scope: &Scope, name: &Name) -> Option<usize> {
        let own = self.kind_of_part(scope.class(), name)?;
        let mut around = scope.classes.iter().enumerate().skip(1);
        let (depth, &class) =
            around.find(|(_, class)| self.class_of_part(**class, name).is_some())?;
        let other = self.kind_of_part(class, name)?;
        other.fits(&own, &self.document).then_some(depth)
    }

    /// Returns true for a part of the thing itself whose name something further out has, too, or a constant of the text.
    fn is_further_out(&self, scope: &Scope, name: &Name) -> bool {
        let mut has = scope.classes.iter().map(|&class| {
            self.class_of_part(class, name).is_some()
                || self.find_message(class, name, None).is_some()
        });
        scope.local(name).is_none()
            && scope.element(name).is_none()
            && !scope.constants.contains_key(name)
            && has.next() == Some(true)
            && (has.any(|it| it) || self.holder_of_constant(scope.file, name).is_some())
    }

    /// Returns the name that a bare path begins with, where it leads to what cannot be given from the thing itself, and
    /// to what can from further out.
    fn misfit(
        &mut self,
        scope: &Scope,
        prefix: &Path,
        target: &Expr,
        value: &Expr,
    ) -> Option<Name> {
        let name = head(value).filter(|name| self.is_further_out(scope, name))?;
        let references = self.references.take();
        self.silent += 1;
        let wanted = self.wanted_by(scope, prefix, target);
        let outer = Scope { outwards: Some(name.clone()), ..scope.clone() };
        let is_thing = matches!(wanted, Some(Kind::Thing(_)));
        let fits = wanted.map(|wanted| {
            [scope, &outer].map(|scope| {
                let found = self.expr_wanting(scope, value, &wanted);
                found.is_some_and(|(_, kind)| kind.fits(&wanted, &self.document))
            })
        });
        self.silent -= 1;
        self.references = references;
        match fits? {
            [false, true] => Some(name),
            [true, true] => is_thing.then_some(name),
            _ => None,
        }
    }

    /// Returns what the part that is given a value may be given.
    fn wanted_by(&mut self, scope: &Scope, prefix: &Path, target: &Expr) -> Option<Kind> {
        let own = scope.of_target(self.class_at(scope.class(), prefix)?, !prefix.is_empty());
        let (_, class) = self.path(&own, target)?;
        Some(Kind::of_class(&self.document, class?))
    }
}

/// Returns what else the body gives in which a value stands.
fn beside(value: &Expr) -> impl Iterator<Item = Assign> {
    let given = value.syntax().ancestors().find_map(Assign::cast);
    let body = given.and_then(|given| given.syntax().parent());
    body.into_iter().flat_map(|body| body.children().filter_map(Assign::cast).collect::<Vec<_>>())
}

/// Returns the name that what is given begins with.
fn head_of(given: &Assign) -> Option<Name> {
    head(&given.target()?)
}

/// Returns the name that a bare path begins with.
pub(crate) fn head(value: &Expr) -> Option<Name> {
    match value {
        Expr::Name(_) => word_of(value),
        Expr::Paren(inner) => head(&inner.inner()?),
        Expr::Field(field) if field.args().is_none() => head(&field.receiver()?),
        Expr::Index(index) => head(&index.receiver()?),
        _ => None,
    }
}

pub(crate) fn word_of(e: &Expr) -> Option<Name> {
    let Expr::Name(name) = e else { return None };
    Some(name.name()?.name())
}

/// Returns true if a name stands in an expression as what is looked for.
pub(crate) fn speaks_of(value: &Expr, name: &Name) -> bool {
    let mut names = value.syntax().descendants().filter_map(NameExpr::cast);
    names.any(|n| n.name().is_some_and(|word| word.name() == *name))
}
