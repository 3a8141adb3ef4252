//! Ends that become one: what each adds to a sum is then added once.
//!
//! A lead puts its current into the currents of its node. Two leads that are merged have one current, which counts once:
//! a circuit that looks closed carries none. What its writer means is to merge their nodes.

use crate::connections::is_bare_path;
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, Place};
use kernel::{ClassId, ClassKind, Path, Step};
use syntax::ast::{AstNode, BinaryOp, Expr, Member};

impl Lowerer<'_> {
    /// Warns of two ends of things that become one where each inserts something into a set.
    /// `said` begins the statement that joins them: `merge `, or nothing in a body.
    pub(crate) fn warn_of_ends(&mut self, scope: &Scope, paths: &[Path], place: Place, said: &str) {
        let [first, second, ..] = paths else { return };
        if place.file != OWN || first.0.last() == Some(&Step::Owner) {
            return;
        }
        let through = [first, second].map(|path| self.inserted_through(scope, path));
        let [Some(through), Some(_)] = through else { return };
        let [first, second] = [first, second].map(|path| {
            let outwards = path.0.iter().take_while(|step| **step == Step::Owner).count();
            Path(path.0[outwards..].to_vec())
        });
        let message = format!("{first} and {second} become one: what each adds is added once");
        let hint =
            format!("join what they lead to: `{said}{first}.{through} = {second}.{through}`");
        self.report(Diagnostic::warning("merged-ends", place, message).hint(hint));
    }

    /// Warns of two things with sets of their own that shall be equal: what is inserted into each is still apart.
    pub(crate) fn warn_of_equals(&mut self, scope: &Scope, rule: &Expr) {
        let Expr::Binary(equation) = rule else { return };
        let (Some(BinaryOp::Equal), Some(left), Some(right)) =
            (equation.op(), equation.left(), equation.right())
        else {
            return;
        };
        if scope.file != OWN || ![&left, &right].into_iter().all(|side| self.has_sets(scope, side))
        {
            return;
        }
        let [a, b] = [left, right].map(|side| side.syntax().text().to_string().trim().to_string());
        let message = format!("{a} and {b} get equal values and stay two things");
        let place = Place { file: scope.file, span: rule.span() };
        let d = Diagnostic::warning("equal-things", place, message);
        self.report(d.hint(format!("what is one thing is merged: `merge {a} = {b}`")));
    }

    /// Returns true for the path of a thing that has a set among its parts.
    fn has_sets(&mut self, scope: &Scope, side: &Expr) -> bool {
        if !is_bare_path(side) {
            return false;
        }
        let references = self.references.take();
        self.silent += 1;
        let found = self.path(scope, side);
        self.silent -= 1;
        self.references = references;
        let Some((_, Some(class))) = found else { return false };
        let document = &self.document;
        let is_set = |c: ClassId| matches!(document.classes[c].kind, ClassKind::Set(_));
        document.classes[class].kind == ClassKind::Composite
            && document.layout(class).into_iter().any(|field| is_set(document.field_class(field)))
    }

    /// Returns the part through which a part of a thing inserts something into a set: `node` of a lead. Of a whole
    /// thing nothing is said: two of them that become one are two views of it.
    fn inserted_through(&self, scope: &Scope, path: &Path) -> Option<String> {
        let outwards = path.0.iter().take_while(|step| **step == Step::Owner).count();
        let from = *scope.classes.get(outwards)?;
        let steps = Path(path.0[outwards..].to_vec());
        let is_inside = outwards + 1 < scope.classes.len();
        let is_part = match steps.0.as_slice() {
            [.., Step::Part(_) | Step::Index(_), Step::Part(_)] => true,
            [Step::Part(_)] => is_inside,
            _ => false,
        };
        let class = self.class_at(from, &steps).filter(|_| is_part)?;
        let mut line = self.document.primary_line(class).into_iter();
        line.find_map(|class| self.inserts_through(class))
    }

    fn inserts_through(&self, class: ClassId) -> Option<String> {
        let (_, _, text) = self.text_of(class)?;
        text.body()?.members().find_map(|member| match member {
            Member::Insert(insert) => match insert.set()? {
                Expr::Field(set) => match set.receiver()? {
                    Expr::Name(name) => Some(name.name()?.text().to_string()),
                    _ => None,
                },
                _ => None,
            },
            _ => None,
        })
    }
}
