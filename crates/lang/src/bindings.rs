//! Bindings: a part that is given an expression of other parts holds it at all times.
//!
//! `size = 2 * width` is a given value, which a nearer one takes the place of, and a constraint beside it: where the
//! value counts the structure has the constraint, and no given value.

use crate::lower::Lowerer;
use crate::scope::Scope;
use kernel::{
    BinaryOperator, Binding, ClassId, ClassKind, Constraint, Document, Method, OriginId, Path,
    Step, Strength, Term,
};
use syntax::ast::{AstNode, Expr, span_without_doc};

impl Lowerer<'_> {
    /// Adds the constraint of a value that speaks of other parts; nothing for any other.
    pub(crate) fn bind_value(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, Option<ClassId>),
        (value, term): (&Expr, &Term),
        given: OriginId,
    ) {
        let Some(class) = class.filter(|&c| can_be_bound(&self.document, c)) else { return };
        if !speaks(term)
            || self.is_reference(scope.class(), path)
            || self.is_count(scope, path)
            || self.is_thing_itself(scope, class, value)
        {
            return;
        }
        let member = value.syntax().parent();
        let span = member.map_or(value.span(), |member| span_without_doc(&member));
        let origin = self.rule_origin(scope, span);
        let part = Box::new(Term::at(Term::Me, path));
        let method = Method { targets: vec![path.clone()], values: vec![term.clone()], origin };
        let is_of_several = self.document.classes[class].kind == ClassKind::Composite
            && is_of_numbers(&self.document, class);
        let constraint = Constraint {
            name: None,
            doc: String::new(),
            rule: Term::Binary(BinaryOperator::Equal, part, Box::new(term.clone())),
            strength: Strength::Required,
            // of several numbers they are derived, one by one
            methods: if is_of_several { Vec::new() } else { vec![method] },
            derived: true,
            reads: Vec::new(),
            within: None,
            origin,
        };
        let of = &mut self.document.classes[scope.class()];
        let index = of.constraints.len() as u32;
        of.constraints.push(constraint);
        of.bindings.push(Binding { constraint: index, path: path.clone(), value: given });
    }

    /// Returns true for the whole number that says how many parts its thing has.
    fn is_count(&self, scope: &Scope, path: &Path) -> bool {
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return false };
        let Some(owner) = self.class_at(scope.class(), &Path(owner.to_vec())) else { return true };
        let line = self.document.primary_line(owner);
        line.into_iter().any(|c| self.document.classes[c].counts.iter().any(|(n, _)| n == name))
    }

    /// Returns true for a value that is another thing as it is stored: the part has its values.
    fn is_thing_itself(&mut self, scope: &Scope, class: ClassId, value: &Expr) -> bool {
        let is_thing = self.document.classes[class].kind == ClassKind::Composite;
        is_thing && self.silent_path(scope, value).is_some()
    }
}

/// Returns true for the classes of numbers, texts and things that are made of such.
fn can_be_bound(document: &Document, class: ClassId) -> bool {
    let of = &document.classes[class];
    let parts = || {
        let has_counts = document.primary_line(class).iter().any(|&c| {
            let c = &document.classes[c];
            !c.counts.is_empty() || c.general.is_some()
        });
        !has_counts
            && document
                .layout(class)
                .into_iter()
                .all(|f| can_be_bound(document, document.field_class(f)))
    };
    match of.kind {
        ClassKind::Primitive(_) => true,
        ClassKind::Composite => parts(),
        ClassKind::List(_) | ClassKind::Set(_) | ClassKind::Reference(_) => false,
    }
}

/// Returns true for the classes of real and whole numbers, and of things that are made of such alone.
fn is_of_numbers(document: &Document, class: ClassId) -> bool {
    match document.classes[class].kind {
        ClassKind::Primitive(p) => {
            p.is_number() && !matches!(p, kernel::Primitive::Bool | kernel::Primitive::Choice(_))
        }
        ClassKind::Composite => {
            let mut fields = document.layout(class).into_iter();
            fields.all(|field| is_of_numbers(document, document.field_class(field)))
        }
        ClassKind::List(_) | ClassKind::Set(_) | ClassKind::Reference(_) => false,
    }
}

/// Returns true for a value that depends on parts; a copy has the values of its original, and shares nothing.
fn speaks(term: &Term) -> bool {
    let mut waiting = vec![term];
    let mut found = false;
    while let Some(term) = waiting.pop() {
        match term {
            Term::Copy(_) => return false,
            Term::Me | Term::Owner | Term::Document | Term::All(_) => found = true,
            _ => {}
        }
        waiting.extend(term.operands());
    }
    found
}
