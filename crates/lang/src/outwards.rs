//! Values of a body that name what is further out.
//!
//! In: a value as it is written in a body. Out: the scope in which its names are looked for. A part is never given
//! itself, so in `{ width = width }` the name on the right is the width further out; and in `R1: Resistor { a.node = a }`
//! it is the `a` further out where that can be given and the resistor's own lead cannot.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::members::Pending;
use crate::scope::Scope;
use base::Name;
use kernel::Path;
use std::rc::Rc;
use syntax::ast::{AstNode, Expr, NameExpr};

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
            _ => self.misfit(scope, &Path(prefix.clone()), target, value),
        };
        if outwards.is_some() {
            Rc::make_mut(scope).outwards = outwards;
        }
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
        let fits = wanted.map(|wanted| {
            [scope, &outer].map(|scope| {
                let found = self.expr_wanting(scope, value, &wanted);
                found.is_some_and(|(_, kind)| kind.fits(&wanted, &self.document))
            })
        });
        self.silent -= 1;
        self.references = references;
        (fits == Some([false, true])).then_some(name)
    }

    /// Returns what the part that is given a value may be given.
    fn wanted_by(&mut self, scope: &Scope, prefix: &Path, target: &Expr) -> Option<Kind> {
        let own = scope.of_target(self.class_at(scope.class(), prefix)?, !prefix.is_empty());
        let (_, class) = self.path(&own, target)?;
        Some(Kind::of_class(&self.document, class?))
    }
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
