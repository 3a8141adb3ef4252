//! Lengths: lists that have as many elements as they are given, where what is given is no list as it is written.
//!
//! How many elements such a list has is read from the text: from the list that its class, its body or a new
//! thing gives it. A value that only comes to a list when it is evaluated gives those elements their values,
//! and can make no more of them.

use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::{ClassId, ClassKind, Count, Path, Step};
use syntax::ast::{self, AstNode, Expr};

/// What is known of how many elements a value gives.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Length {
    /// The list itself is written: so many are made.
    Written(u32),
    /// It will have so many.
    Known(u32),
    /// That is found out when it is evaluated.
    Unknown,
}

impl Lowerer<'_> {
    /// Reports a value that has more or fewer elements than there are where it goes; returns true if so.
    pub(crate) fn loses_elements(
        &mut self,
        scope: &Scope,
        path: &Path,
        class: ClassId,
        value: &Expr,
    ) -> bool {
        if matches!(value, Expr::Tuple(_) | Expr::Number(_) | Expr::Text(_) | Expr::Bool(_)) {
            return false;
        }
        let lists: Vec<Path> = match self.document.classes[class].kind {
            ClassKind::List(_) => vec![path.clone()],
            ClassKind::Composite => {
                let names = self.lists_as_given(class).into_iter();
                names.map(|name| path.then(Step::Part(name))).collect()
            }
            ClassKind::Primitive(_) | ClassKind::Set(_) | ClassKind::Reference(_) => return false,
        };
        let whole = path.0.len();
        let lost = lists.into_iter().find_map(|list| {
            if !self.is_as_given(scope, &list) {
                return None;
            }
            let here = self.length_at(scope, &list).unwrap_or(0);
            let is_wrong = match self.length_given(scope, value, &list.0[whole..]) {
                None => false,
                Some(Length::Written(n)) => n != here && self.is_gone_through(scope, &list),
                Some(Length::Known(n)) => n != here,
                Some(Length::Unknown) => here == 0,
            };
            is_wrong.then_some((list, here))
        });
        let Some((list, here)) = lost else { return false };
        let given = value.syntax().text();
        let message = format!("{list} has {here} elements, and {given} gives it others");
        let d = Diagnostic::error(
            "not-a-count",
            Place { file: scope.file, span: value.span() },
            message,
        );
        let says = list.0.last().map(|step| format!("{} = [...]", Path(vec![step.clone()])));
        let hint = match (list.0.len() > whole, says) {
            (true, Some(says)) => self.said_where_declared(path, class, &says),
            _ => "write how many there are, `List of 3 C`, or the list itself".to_string(),
        };
        self.report(d.hint(hint));
        true
    }

    /// Returns the lists of a class's things that have as many elements as they are given.
    fn lists_as_given(&self, class: ClassId) -> Vec<Name> {
        if self.document.classes[class].kind != ClassKind::Composite {
            return Vec::new();
        }
        let fields = self.document.layout(class).into_iter();
        let as_given = fields.filter(|&f| {
            self.document.declared(f).is_some_and(|part| part.count == Some(Count::Given))
        });
        as_given.map(|f| self.document.field_name(f).clone()).collect()
    }

    /// Returns true if the list at a path has as many elements as it is given.
    fn is_as_given(&self, scope: &Scope, list: &Path) -> bool {
        let Some((owner, Step::Part(name))) = self.owner_at(scope, list) else { return false };
        self.lists_as_given(owner).contains(name) && self.count_of_part(owner, name).is_none()
    }

    /// Returns true if a loop of its owner's class goes through the list at a path.
    fn is_gone_through(&self, scope: &Scope, list: &Path) -> bool {
        match self.owner_at(scope, list) {
            Some((owner, Step::Part(name))) => self.is_looped(owner, name),
            _ => false,
        }
    }

    /// Returns how many elements a value gives a list: itself, or a part of it that it gives a value.
    fn length_given(&mut self, scope: &Scope, value: &Expr, list: &[Step]) -> Option<Length> {
        match value {
            Expr::Paren(inner) => self.length_given(scope, &inner.inner()?, list),
            Expr::List(elements) if list.is_empty() => {
                Some(Length::Written(elements.elements().count() as u32))
            }
            Expr::Copy(copy) => self.length_given(scope, &copy.operand()?, list),
            Expr::Call(call) => {
                let [Step::Part(name)] = list else { return Some(Length::Unknown) };
                match self.visible.class(scope.file, &call.name()?.name()) {
                    Some(made) => {
                        let value = self.argument(made, call, name)?;
                        self.length_given(scope, &value, &[])
                    }
                    None => Some(Length::Unknown),
                }
            }
            other => {
                let path = self.silent_path(scope, other).map(|p| p.join(&Path(list.to_vec())));
                let path = path.filter(|path| self.owner_at(scope, path).is_some());
                Some(path.map_or(Length::Unknown, |path| {
                    Length::Known(self.length_at(scope, &path).unwrap_or(0))
                }))
            }
        }
    }

    /// Returns what a constructor is given for a part, by label or position.
    fn argument(&self, made: ClassId, call: &ast::CallExpr, name: &Name) -> Option<Expr> {
        let args: Vec<ast::Arg> = call.args()?.args().collect();
        let labelled = args.iter().find(|a| a.label().is_some_and(|l| l.name() == *name));
        let at = self.field_names(made).iter().position(|n| n == name);
        let by_position = || args.get(at?).filter(|a| a.label().is_none());
        labelled.or_else(by_position)?.value()
    }
}
