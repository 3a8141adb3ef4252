//! Handles: which places of a class's things a hand changes them by, and which stay meanwhile.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Place};
use kernel::{Handle, Path, Step};
use syntax::ast::{self, AstNode, Expr};

impl Lowerer<'_> {
    /// Reads `handle far keeps corner`.
    pub(crate) fn define_handle(&mut self, scope: &Scope, handle: &ast::Handle) {
        let Some(expr) = handle.place().filter(|_| handle.kept().next().is_some()) else { return };
        let Some(place) = self.handle_place(scope, &expr) else { return };
        let mut keeps = Vec::new();
        for kept in handle.kept() {
            let Some(path) = self.handle_place(scope, &kept) else { continue };
            if path == place {
                let message = format!("{path} is dragged: it does not stay meanwhile");
                self.error("handle-of-itself", scope.file, kept.span(), message);
                continue;
            }
            keeps.push(path);
        }
        let handles = &mut self.document.classes[scope.class()].handles;
        if handles.iter().any(|known| known.place == place) {
            let message = format!("{place} is a handle already");
            let place = Place { file: scope.file, span: expr.span() };
            let d = Diagnostic::error("handle-twice", place, message);
            self.report(
                d.hint("name all that stays in one line: `handle far keeps corner, side.p1`"),
            );
            return;
        }
        handles.push(Handle { place, keeps });
    }

    /// Reads the path of a place of a class's things, which may be computed.
    fn handle_place(&mut self, scope: &Scope, expr: &Expr) -> Option<Path> {
        let (path, class, word) = match expr {
            Expr::Paren(inner) => return self.handle_place(scope, &inner.inner()?),
            Expr::Name(name) => (Path::default(), Some(scope.class()), name.name()?),
            Expr::Field(field) if field.args().is_none() => {
                let (path, class) = self.path(scope, &field.receiver()?)?;
                (path, class, field.name()?)
            }
            other => {
                let message = "a place of the class is wanted: `far`".to_string();
                self.error("not-a-path", scope.file, other.span(), message);
                return None;
            }
        };
        let name = word.name();
        let class = class?;
        let Some(kind) = self.kind_of_part(class, &name) else {
            self.unknown_part(scope, &Kind::of_class(&self.document, class), &word);
            return None;
        };
        let place = Place { file: scope.file, span: word.span() };
        self.refer(place, &name, class);
        let of = if let Kind::List(element) = &kind { &**element } else { &kind };
        let is_place = match of {
            Kind::Thing(class) => self.document.place_in(*class).is_some(),
            Kind::Unknown => true,
            _ => false,
        };
        if !is_place {
            let found = kind.words(&self.document);
            let message = format!("{name} is {found}, wanted a place that a hand can drag");
            self.error("handle-of-no-place", scope.file, word.span(), message);
            return None;
        }
        Some(path.then(Step::Part(name)))
    }
}
