//! Things of narrower classes than what they are given to: a part is of the class that it is declared with, and keeps of a
//! thing what that class has.
//!
//! In: a value and the class of what it is given to. Out: a warning where the value's class has more.

use crate::kinds::{Kind, with_article};
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, Place};
use kernel::{ClassId, ClassKind, Path};
use syntax::ast::{AstNode, Expr};

impl Lowerer<'_> {
    /// Warns of a thing that is given to a part of a superclass, and of such elements of a list.
    pub(crate) fn warn_of_narrower(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, ClassId),
        (kind, value): (&Kind, &Expr),
    ) {
        if scope.file != OWN || self.silent > 0 {
            return;
        }
        match (&self.document.classes[class].kind, kind, value) {
            (ClassKind::Composite, Kind::Thing(given), _) if self.loses(*given, class) => {
                let [given, wanted] = [*given, class].map(|class| self.name_in_text(class));
                let hint = format!("what is to stay one is declared so: `{path}: {given} = …`");
                let what = format!("{path} is {}", with_article(&wanted));
                self.tell_narrower(scope, value, (&what, &given, &wanted), hint);
            }
            (ClassKind::List(of), Kind::List(_), Expr::List(list)) => {
                let of = *of;
                if self.document.classes[of].kind != ClassKind::Composite {
                    return;
                }
                let mut each = list.elements();
                let found =
                    each.find_map(|element| match self.kind_of_listed(scope, &element)? {
                        Kind::Thing(given) if self.loses(given, of) => Some((element, given)),
                        _ => None,
                    });
                if let Some((element, given)) = found {
                    let [given, wanted] = [given, of].map(|class| self.name_in_text(class));
                    let hint =
                        format!("what only lists things keeps them as they are: `{path} => […]`");
                    let what = format!("{path} holds things of the class {wanted}");
                    self.tell_narrower(scope, &element, (&what, &given, &wanted), hint);
                }
            }
            _ => {}
        }
    }

    fn tell_narrower(
        &mut self,
        scope: &Scope,
        value: &Expr,
        (what, given, wanted): (&str, &str, &str),
        hint: String,
    ) {
        let [a_given, a_wanted] = [given, wanted].map(with_article);
        let message = format!("{what}, and keeps of {a_given} only what {a_wanted} has");
        let place = Place { file: scope.file, span: value.span() };
        self.report(Diagnostic::warning("lost-class", place, message).hint(hint));
    }

    /// Finds out what an element of a list is, where that is no number or tuple.
    fn kind_of_listed(&mut self, scope: &Scope, element: &Expr) -> Option<Kind> {
        if !matches!(element, Expr::Name(_) | Expr::Field(_) | Expr::Call(_) | Expr::Index(_)) {
            return None;
        }
        // what it speaks of is recorded where it is lowered
        let references = self.references.take();
        self.silent += 1;
        let found = self.expr(scope, element);
        self.silent -= 1;
        self.references = references;
        found.map(|(_, kind)| kind)
    }

    fn name_in_text(&self, class: ClassId) -> String {
        self.document.classes[self.document.named_class(class)].name.to_string()
    }

    /// Returns true where a class that is named in the text has more than a superclass of it.
    fn loses(&self, given: ClassId, wanted: ClassId) -> bool {
        let document = &self.document;
        let [given, wanted] = [given, wanted].map(|class| document.named_class(class));
        if given == wanted || !document.is_a(given, wanted) {
            return false;
        }
        let kept = document.lineage(wanted);
        let has_more = |&class: &ClassId| {
            let class = &document.classes[class];
            !class.parts.is_empty() || !class.messages.is_empty()
        };
        document.lineage(given).iter().filter(|class| !kept.contains(class)).any(has_more)
    }
}
