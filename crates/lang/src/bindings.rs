//! Bindings: a part that is given an expression of other parts holds it at all times.
//!
//! `size = 2 * width` is a given value, which a nearer one takes the place of, and a constraint beside it: where the
//! value counts the structure has the constraint, and no given value.

use crate::connections::is_bare_path;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::Name;
use kernel::{
    Argument, BinaryOperator, Binding, ClassId, ClassKind, Constraint, Document, Method, OriginId,
    Path, Step, Strength, Term,
};
use syntax::ast::{AstNode, Expr, span_without_doc};

/// So many texts of a list are bound each by itself, for which the list is computed anew.
const MOST_TEXTS: u32 = 100;

impl Lowerer<'_> {
    /// Adds the constraint of a value that speaks of other parts; nothing for any other. The elements of a list that is
    /// written out are bound each by itself, and so are the numbers of a thing that is made with so many parts.
    pub(crate) fn bind_value(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, Option<ClassId>),
        (value, term): (&Expr, &Term),
        given: OriginId,
    ) {
        match (value, term) {
            (Expr::List(list), Term::List(items)) => {
                let element = class.and_then(|class| match self.document.classes[class].kind {
                    ClassKind::List(element) => Some(element),
                    ClassKind::Primitive(_)
                    | ClassKind::Composite
                    | ClassKind::Set(_)
                    | ClassKind::Reference(_) => None,
                });
                for ((at, item), value) in (0..).zip(items).zip(list.elements()) {
                    let path = path.then(Step::Index(at));
                    let is_of_numbers = element.is_some_and(|e| is_of_numbers(&self.document, e));
                    // an element that is another thing of numbers is as that is at all times
                    match is_bare_path(&value) && is_of_numbers {
                        true => self.bind_part(scope, (&path, element), (&value, item), given),
                        false => self.bind_value(scope, (&path, element), (&value, item), given),
                    }
                }
                return;
            }
            // what is computed has no constraints that a copy of it could have
            (Expr::Copy(copy), Term::Copy(of)) if let Some(value) = copy.operand() => {
                if self.silent_path(scope, &value).is_none() {
                    self.bind_value(scope, (path, class), (&value, of), given);
                }
                return;
            }
            (_, Term::Make { arguments, .. })
                if class.is_some_and(|c| has_counts(&self.document, c)) =>
            {
                return self.bind_arguments(scope, (path, class), (value, arguments), given);
            }
            _ => {}
        }
        if class.is_some_and(|class| self.is_thing_itself(scope, class, value)) {
            return;
        }
        let elements = class.and_then(|class| self.texts_of(scope, path, class));
        let Some((count, element)) = elements else {
            return self.bind_part(scope, (path, class), (value, term), given);
        };
        // texts follow each by itself
        for at in 0..count {
            let index = Box::new(Term::number(f64::from(at)));
            let item = Term::Index(Box::new(term.clone()), index);
            let path = path.then(Step::Index(at));
            self.bind_part(scope, (&path, Some(element)), (value, &item), given);
        }
    }

    /// Returns how many elements a list has that are no numbers, and their class; nothing where these are many.
    fn texts_of(&mut self, scope: &Scope, path: &Path, list: ClassId) -> Option<(u32, ClassId)> {
        let ClassKind::List(element) = self.document.classes[list].kind else { return None };
        let count = self.length_at(scope, path)?;
        let are_texts = count <= MOST_TEXTS && !is_of_numbers(&self.document, element);
        are_texts.then_some((count, element))
    }

    /// Adds the constraint that a part is what an expression of other parts is.
    fn bind_part(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, Option<ClassId>),
        (value, term): (&Expr, &Term),
        given: OriginId,
    ) {
        let Some(class) = class.filter(|&c| can_be_bound(&self.document, c)) else { return };
        if !speaks(term) || self.is_reference(scope.class(), path) || self.is_count(scope, path) {
            return;
        }
        let member = value.syntax().parent();
        let span = member.map_or(value.span(), |member| span_without_doc(&member));
        let origin = self.rule_origin(scope, span);
        let part = Box::new(Term::at(Term::Me, path));
        let method = Method { targets: vec![path.clone()], values: vec![term.clone()], origin };
        // of several numbers and of elements they are derived, one by one
        let is_of_several = match self.document.classes[class].kind {
            ClassKind::List(_) => true,
            ClassKind::Composite => is_of_numbers(&self.document, class),
            ClassKind::Primitive(_) | ClassKind::Set(_) | ClassKind::Reference(_) => false,
        };
        let constraint = Constraint {
            name: None,
            doc: String::new(),
            rule: Term::Binary(BinaryOperator::Equal, part, Box::new(term.clone())),
            strength: Strength::Required,
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

    /// Binds the numbers, texts and truth values that a thing is made of.
    fn bind_arguments(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, Option<ClassId>),
        (value, arguments): (&Expr, &[Argument]),
        given: OriginId,
    ) {
        let Some(class) = class else { return };
        let fields: Vec<(Name, ClassId)> = { self.document.layout(class).into_iter() }
            .map(|f| (self.document.field_name(f).clone(), self.document.field_class(f)))
            .collect();
        for (at, argument) in arguments.iter().enumerate() {
            let field = match &argument.label {
                Some(label) => fields.iter().find(|(name, _)| name == label),
                None => fields.get(at),
            };
            let Some((name, class)) = field else { continue };
            if matches!(self.document.classes[*class].kind, ClassKind::Primitive(_)) {
                let path = path.then(Step::Part(name.clone()));
                self.bind_value(scope, (&path, Some(*class)), (value, &argument.value), given);
            }
        }
    }

    /// Returns true for the whole number that says how many parts its thing has.
    fn is_count(&self, scope: &Scope, path: &Path) -> bool {
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return false };
        let Some(owner) = self.class_at(scope.class(), &Path(owner.to_vec())) else { return true };
        let line = self.document.primary_line(owner);
        line.into_iter().any(|c| self.document.classes[c].counts.iter().any(|(n, _)| n == name))
    }

    /// Returns true for a value that is another thing, or a list of such, as it is stored: the part has its values.
    fn is_thing_itself(&mut self, scope: &Scope, class: ClassId, value: &Expr) -> bool {
        let mut of = class;
        while let ClassKind::List(element) = self.document.classes[of].kind {
            of = element;
        }
        let is_thing = self.document.classes[of].kind == ClassKind::Composite;
        is_thing && self.silent_path(scope, value).is_some()
    }
}

/// Returns true for the classes of numbers, texts, and of things and lists that are made of such.
fn can_be_bound(document: &Document, class: ClassId) -> bool {
    let of = &document.classes[class];
    let parts = || {
        let mut fields = document.layout(class).into_iter();
        !has_counts(document, class)
            && fields.all(|f| can_be_bound(document, document.field_class(f)))
    };
    match of.kind {
        ClassKind::Primitive(_) => true,
        ClassKind::Composite => parts(),
        ClassKind::List(element) => can_be_bound(document, element),
        ClassKind::Set(_) | ClassKind::Reference(_) => false,
    }
}

/// Returns true for a class whose things have as many parts as a number says.
fn has_counts(document: &Document, class: ClassId) -> bool {
    document.primary_line(class).iter().any(|&c| {
        let c = &document.classes[c];
        !c.counts.is_empty() || c.general.is_some()
    })
}

/// Returns true for the classes of real and whole numbers, and of things and lists that are made of such alone.
fn is_of_numbers(document: &Document, class: ClassId) -> bool {
    match document.classes[class].kind {
        ClassKind::Primitive(p) => {
            p.is_number() && !matches!(p, kernel::Primitive::Bool | kernel::Primitive::Choice(_))
        }
        ClassKind::Composite => {
            let mut fields = document.layout(class).into_iter();
            fields.all(|field| is_of_numbers(document, document.field_class(field)))
        }
        ClassKind::List(element) => is_of_numbers(document, element),
        ClassKind::Set(_) | ClassKind::Reference(_) => false,
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
