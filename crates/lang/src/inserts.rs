//! What is a member of a set: `insert a into s`, and a set that is given its members, `s = [a, b]`.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Place, Span};
use kernel::{ClassId, ClassKind, Insert, OriginId, Path};
use syntax::ast::{self, AstNode, Expr};

impl Lowerer<'_> {
    /// `insert current into node.currents`
    pub(crate) fn define_insert(&mut self, scope: &Scope, insert: &ast::Insert, origin: OriginId) {
        let (Some(part), Some(set)) = (insert.part(), insert.set()) else { return };
        let (part, into) = (self.path(scope, &part), self.path(scope, &set));
        let (Some(part), Some(into)) = (part, into) else { return };
        self.put_into(scope, (part, insert.span()), (into, set.span()), origin);
    }

    /// `currents = [a, b]`: each of them is a member.
    pub(crate) fn define_set(
        &mut self,
        scope: &Scope,
        set: &Path,
        class: Option<ClassId>,
        value: &Expr,
    ) {
        let whole = value.span();
        let Expr::List(list) = value else {
            return self.no_members(scope, whole, set);
        };
        for one in list.elements() {
            if !matches!(one, Expr::Name(_) | Expr::Field(_) | Expr::Index(_)) {
                return self.no_members(scope, one.span(), set);
            }
            let origin = self.origin(scope.file, one.span());
            if let Some(part) = self.path(scope, &one) {
                self.put_into(scope, (part, one.span()), ((set.clone(), class), whole), origin);
            }
        }
    }

    fn no_members(&mut self, scope: &Scope, span: Span, set: &Path) {
        let place = Place { file: scope.file, span };
        let message = format!("{set} is a set: what is in it are parts, and here are none");
        let d = Diagnostic::error("value-of-wrong-class", place, message);
        self.report(d.hint("values are kept by a list, `List of Real`; parts are named: `[a, b]`"));
    }

    /// Makes a part a member of a set, or says why it is none.
    fn put_into(
        &mut self,
        scope: &Scope,
        ((part, member), told): ((Path, Option<ClassId>), Span),
        ((path, class), set): ((Path, Option<ClassId>), Span),
        origin: OriginId,
    ) {
        let kind_of = |class: Option<ClassId>| {
            class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c))
        };
        let (member, kind) = (kind_of(member), kind_of(class));
        let is_set =
            class.is_none_or(|c| matches!(self.document.classes[c].kind, ClassKind::Set(_)));
        match &kind {
            Kind::List(element) if is_set && matches!(member, Kind::List(_)) => {
                let place = Place { file: scope.file, span: told };
                let (message, hint) = match part == path {
                    true => {
                        let hint = "insert a part that is one of its members".to_string();
                        (format!("{path} cannot be a member of itself"), hint)
                    }
                    false => {
                        let one = element.words(&self.document);
                        let message = format!("{part} is {}", member.words(&self.document));
                        let hint = format!("merge the two: `merge {part} = {path}`");
                        (format!("{message}, wanted one member, {one}"), hint)
                    }
                };
                self.report(Diagnostic::error("value-of-wrong-class", place, message).hint(hint));
            }
            Kind::List(element) if is_set && !member.fits(element, &self.document) => {
                self.wrong_kind(scope, told, &member, element);
            }
            _ if !is_set => {
                let message = format!("{path} is {}, wanted a set", kind.words(&self.document));
                let place = Place { file: scope.file, span: set };
                let d = Diagnostic::error("value-of-wrong-class", place, message);
                self.report(d.hint("a set is declared as `name: Set of C`"));
            }
            _ => self.document.classes[scope.class()].inserts.push(Insert {
                part,
                set: path,
                origin,
            }),
        }
    }
}
