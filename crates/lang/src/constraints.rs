//! Constraints as things: `level.error`, `level.satisfied`, `level.strength`, `level.enabled`.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::names::owners;
use crate::scope::Scope;
use base::{Name, Place};
use kernel::{Aspect, ClassId, Path, Step, Term};
use syntax::ast::{self, Expr};

impl Lowerer<'_> {
    /// Lowers what is asked of a constraint; nothing where the receiver is none.
    pub(crate) fn of_constraint(
        &mut self,
        scope: &Scope,
        field: &ast::FieldExpr,
        receiver: &Expr,
    ) -> Option<(Term, Kind)> {
        let aspect = Aspect::of_word(field.name()?.text()).filter(|_| field.args().is_none())?;
        let (of, class, word) = match receiver {
            Expr::Paren(inner) => return self.of_constraint(scope, field, &inner.inner()?),
            Expr::Name(name) => {
                let word = name.name()?;
                let name = word.name();
                if scope.local(&name).is_some() || scope.element(&name).is_some() {
                    return None;
                }
                let (class, me) = owners(scope).into_iter().find(|(class, _)| {
                    self.has_constraint(*class, &name) || self.has_part(*class, &name)
                })?;
                (me, class, word)
            }
            Expr::Field(inner) if inner.args().is_none() => {
                let word = inner.name()?;
                let of = inner.receiver()?;
                self.silent += 1;
                let found = self.expr(scope, &of);
                self.silent -= 1;
                let Some((of, Kind::Thing(class))) = found else { return None };
                (of, class, word)
            }
            _ => return None,
        };
        let name = word.name();
        if self.has_part(class, &name) {
            return None;
        }
        // merged things have the constraints of each
        let class = match self.has_constraint(class, &name) {
            true => class,
            false => self.kin_that(scope, class, |l, kin| l.has_constraint(kin, &name))?,
        };
        self.refer(Place { file: scope.file, span: word.span() }, &name, class);
        let kind = kind_of(aspect);
        Some((Term::OfConstraint { of: Box::new(of), name, aspect }, kind))
    }

    /// Returns what is asked of a constraint of a class's prototype, by the path to the constraint.
    pub(crate) fn kind_of_constraint(
        &self,
        class: ClassId,
        constraint: &[Step],
        aspect: &Name,
    ) -> Option<Kind> {
        let aspect = Aspect::of_word(aspect)?;
        let (Step::Part(name), owner) = constraint.split_last()? else { return None };
        let owner = self.class_at(class, &Path(owner.to_vec()))?;
        let is_one = !self.has_part(owner, name) && self.has_constraint(owner, name);
        is_one.then(|| kind_of(aspect))
    }

    fn has_part(&self, class: ClassId, name: &Name) -> bool {
        self.class_of_part(class, name).is_some() || self.find_message(class, name, None).is_some()
    }

    fn has_constraint(&self, class: ClassId, name: &Name) -> bool {
        let lineage = self.document.lineage(class);
        lineage.into_iter().any(|c| self.constraints.contains(&(c, name.clone())))
    }
}

fn kind_of(aspect: Aspect) -> Kind {
    match aspect {
        Aspect::Error => Kind::Unknown,
        Aspect::Satisfied | Aspect::Enabled => Kind::Bool,
        Aspect::Strength => Kind::Text,
    }
}
