//! Connections: a part that is given another by its bare path is one with it.
//!
//! `a.node = top` is the merge of the two. What names another, a number, and what is computed are values, and a
//! list whose length is what it is given has to be given it.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::members::Pending;
use crate::scope::Scope;
use base::Place;
use kernel::{ClassId, ClassKind, Given, Merge, Path, Step};
use std::rc::Rc;
use syntax::ast::{AstNode, Expr};

/// Returns true for an expression that is the path of a part, as far as its form tells.
pub(crate) fn is_bare_path(value: &Expr) -> bool {
    match value {
        Expr::Name(_) | Expr::Owner(_) => true,
        Expr::Paren(inner) => inner.inner().is_some_and(|e| is_bare_path(&e)),
        Expr::Field(field) => {
            field.args().is_none() && field.receiver().is_some_and(|e| is_bare_path(&e))
        }
        Expr::Index(index) => index.receiver().is_some_and(|e| is_bare_path(&e)),
        _ => false,
    }
}

impl Lowerer<'_> {
    /// Makes a merge of a value that connects; returns false for any other, which is still to be given.
    pub(crate) fn connect(&mut self, pending: &Pending) -> bool {
        let Pending::Value { scope, prefix, target, value } = pending else { return false };
        if !is_bare_path(value) || self.document.classes[scope.class()].program.is_some() {
            return false;
        }
        self.silent += 1;
        let ends = self.ends(scope, Path(prefix.clone()), target.as_ref(), value);
        self.silent -= 1;
        let Some([part, of]) = ends else { return false };
        let origin = self.origin(scope.file, value.span());
        let given = self
            .expr(scope, value)
            .map(|(value, _)| Rc::new(Given { path: part.clone(), value, origin }));
        let place = Place { file: scope.file, span: value.span() };
        self.warn_of_ends(scope, &[part.clone(), of.clone()], place, "");
        let class = &mut self.document.classes[scope.class()];
        class.connections.extend(given);
        class.merges.push(Merge { name: None, paths: vec![of, part], origin });
        true
    }

    /// Returns the two that a value connects: the part, and what it is one with.
    fn ends(
        &mut self,
        scope: &Scope,
        prefix: Path,
        target: Option<&Expr>,
        value: &Expr,
    ) -> Option<[Path; 2]> {
        let mut part = prefix;
        let mut class = self.class_at(scope.class(), &part);
        if let Some(target) = target {
            let of = class.filter(|_| !part.is_empty()).unwrap_or(scope.class());
            let own = scope.of_target(of, !part.is_empty());
            let (rest, of) = self.path(&own, target)?;
            (part, class) = (part.join(&rest), of);
        }
        let class = class.filter(|&c| self.has_parts(c))?;
        if self.goes_through_reference(scope.class(), &part.0) {
            return None;
        }
        let of = self.silent_path(scope, value)?;
        let (_, found) = self.path(scope, value)?;
        let found = found.filter(|&c| self.has_parts(c))?;
        let outwards = of.0.iter().take_while(|step| **step == Step::Owner).count();
        let from = *scope.classes.get(outwards)?;
        let is_stored = of.0.len() > outwards
            && of.0[outwards..].iter().all(|step| *step != Step::Owner)
            && !self.goes_through_reference(from, &of.0[outwards..]);
        // it would have to be made as long as what it is one with
        let is_short = self.loses_elements(scope, &part, class, value);
        let kinds = [class, found].map(|c| Kind::of_class(&self.document, c));
        (is_stored
            && !is_short
            && part != of
            && kinds[1].fits(&kinds[0], &self.document)
            && self.counts_apart(class, found).is_none())
        .then_some([part, of])
    }

    /// Returns true for the class of what is made of parts.
    fn has_parts(&self, class: ClassId) -> bool {
        match self.document.classes[class].kind {
            ClassKind::Composite => true,
            ClassKind::List(_)
            | ClassKind::Primitive(_)
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => false,
        }
    }

    /// Returns true where some part on a way only names another.
    fn goes_through_reference(&self, from: ClassId, way: &[Step]) -> bool {
        (0..way.len()).any(|n| {
            let owner = self.class_at(from, &Path(way[..n].to_vec()));
            owner.is_none_or(|owner| match &self.document.classes[owner].kind {
                ClassKind::List(element) => self.names_another(*element),
                _ => self.is_reference(owner, &Path(vec![way[n].clone()])),
            })
        })
    }

    fn names_another(&self, class: ClassId) -> bool {
        matches!(self.document.classes[class].kind, ClassKind::Reference(_))
    }
}
