//! Bindings: a part that is given an expression of other parts holds it at all times.
//!
//! `size = 2 * width` is a given value, which a nearer one takes the place of, and a constraint beside it: where the
//! value counts the structure has the constraint, and no given value.

use crate::connections::is_bare_path;
use crate::hints::further_out;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::{
    Argument, BinaryOperator, Binding, ClassId, ClassKind, Constraint, Document, Method, OriginId,
    Path, Primitive, Step, Term,
};
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Expr, span_without_doc};

/// So many texts of a list, or parts of a thing, are bound each by itself, for which the whole is computed anew.
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
                    // an element that is another thing is as that is at all times
                    match is_bare_path(&value) {
                        true => self.bind_whole(scope, (&path, element), (&value, item), given),
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
        if !class.is_some_and(|class| self.is_thing_itself(scope, class, value)) {
            self.bind_whole(scope, (path, class), (value, term), given);
        }
    }

    /// Binds a part to a value: by its parts and its texts, where it has others than numbers, else as a whole.
    fn bind_whole(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, Option<ClassId>),
        (value, term): (&Expr, &Term),
        given: OriginId,
    ) {
        let by_parts =
            |&class: &ClassId| is_mixed(&self.document, class) && self.has_few_parts(class);
        if let Some(class) = class.filter(by_parts) {
            return self.bind_fields(scope, (path, class), (value, term), given);
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

    /// Returns true for a class whose things have few parts and texts in lists, those of their parts counted: none
    /// that has itself as a part, without end.
    fn has_few_parts(&self, class: ClassId) -> bool {
        let (mut count, mut open) = (0u32, vec![class]);
        while let Some(class) = open.pop() {
            for field in self.document.layout(class) {
                let of = self.document.field_class(field);
                let texts = match self.document.classes[of].kind {
                    ClassKind::List(element) if !is_of_numbers(&self.document, element) => {
                        self.count_of_part(class, self.document.field_name(field))
                    }
                    ClassKind::Composite => {
                        open.push(of);
                        None
                    }
                    ClassKind::List(_)
                    | ClassKind::Primitive(_)
                    | ClassKind::Set(_)
                    | ClassKind::Reference(_) => None,
                };
                count = count.saturating_add(texts.unwrap_or(1));
            }
            if count > MOST_TEXTS {
                return false;
            }
        }
        true
    }

    /// Adds the constraint that a part is what an expression of other parts is.
    fn bind_part(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, Option<ClassId>),
        (value, term): (&Expr, &Term),
        given: OriginId,
    ) {
        // most values are plain numbers, which is seen at once
        if !speaks(term) {
            return;
        }
        let Some(class) = class.filter(|&c| can_be_bound(&self.document, c)) else { return };
        if self.is_reference(scope.class(), path) || self.is_count(scope, path) {
            return;
        }
        let member = value.syntax().parent();
        let span = member.map_or(value.span(), |member| span_without_doc(&member));
        let origin = self.rule_origin(scope, span);
        let part = Box::new(Term::at(Term::Me, path));
        let method = Method { targets: vec![path.clone()], values: vec![term.clone()], origin };
        // of several numbers and of elements they are derived, one by one; of a text that is another's, either way
        let are_derived = match self.document.classes[class].kind {
            ClassKind::List(_) => true,
            ClassKind::Composite => is_of_numbers(&self.document, class),
            ClassKind::Primitive(primitive) => !primitive.is_number() && is_bare_path(value),
            ClassKind::Set(_) | ClassKind::Reference(_) => false,
        };
        let rule = Term::Binary(BinaryOperator::Equal, part, Box::new(term.clone()));
        let methods = if are_derived { Vec::new() } else { vec![method] };
        let constraint = Constraint { methods, ..Constraint::required(rule, origin) };
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

    /// Binds the parts of a thing that has others than numbers each by itself: a text that is given stays while a number follows.
    fn bind_fields(
        &mut self,
        scope: &Scope,
        (path, class): (&Path, ClassId),
        (value, term): (&Expr, &Term),
        given: OriginId,
    ) {
        let fields: Vec<(Name, ClassId)> = { self.document.layout(class).into_iter() }
            .map(|f| (self.document.field_name(f).clone(), self.document.field_class(f)))
            .collect();
        let unlabelled = |value: &Term| Argument { label: None, value: value.clone() };
        let made: Option<Vec<Argument>> = match term {
            Term::Make { class: made, arguments } if *made == class => Some(arguments.clone()),
            Term::Tuple(values) => Some(values.iter().map(unlabelled).collect()),
            _ => None,
        };
        for (at, (name, class)) in fields.iter().enumerate() {
            let of = match &made {
                Some(arguments) => {
                    let labelled = arguments.iter().find(|a| a.label.as_ref() == Some(name));
                    let by_place = arguments.get(at).filter(|a| a.label.is_none());
                    match labelled.or(by_place) {
                        Some(argument) => argument.value.clone(),
                        None => continue,
                    }
                }
                None => Term::send(term.clone(), name),
            };
            let path = path.then(Step::Part(name.clone()));
            self.bind_whole(scope, (&path, Some(*class)), (value, &of), given);
        }
    }

    /// Reports a part that is given an expression of itself, `radius = 2 * radius`.
    pub(crate) fn is_given_by_itself(
        &mut self,
        scope: &Scope,
        path: &Path,
        term: &Term,
        (target, value): (Option<&Expr>, &Expr),
    ) -> bool {
        let own = Term::at(Term::Me, path);
        let mut waiting = vec![term];
        let speaks_of_it = loop {
            match waiting.pop() {
                None | Some(Term::Copy(_)) => break false,
                Some(term) if *term == own => break true,
                Some(term) => waiting.extend(term.operands()),
            }
        };
        if !speaks_of_it || path.is_empty() || self.is_reference(scope.class(), path) {
            return false;
        }
        let written = |e: &Expr| e.syntax().text().to_string().trim().to_string();
        let of = target.map_or_else(|| path.to_string(), written);
        let place = Place { file: scope.file, span: value.span() };
        let d = Diagnostic::error("given-by-itself", place, format!("{of} is given by itself"));
        let hint = self.further_out(scope, &path.0[0]).unwrap_or_else(|| match written(value) {
            value if value == of => format!("say what it is: `{of} = …`, or leave it out"),
            value => format!("what is true of it is a constraint: `constraint {of} = {value}`"),
        });
        self.report(d.hint(hint));
        true
    }

    /// Returns what tells a part from one of the same name further out, where there is one.
    fn further_out(&self, scope: &Scope, step: &Step) -> Option<String> {
        let Step::Part(name) = step else { return None };
        let mut outer = scope.classes.iter().skip(1);
        let depth = 1 + outer.position(|&class| self.class_of_part(class, name).is_some())?;
        Some(further_out(name, depth))
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
    is_made_of(document, class, |_| true, |class| !has_counts(document, class))
}

/// Returns true for the classes of real and whole numbers, and of things and lists that are made of such alone.
fn is_of_numbers(document: &Document, class: ClassId) -> bool {
    is_made_of(document, class, is_number, |_| true)
}

/// Returns true for the classes of things that have others than numbers, at whatever depth, all by name.
fn is_mixed(document: &Document, class: ClassId) -> bool {
    document.classes[class].kind == ClassKind::Composite
        && can_be_bound(document, class)
        && !is_of_numbers(document, class)
}

/// Returns true for real and whole numbers; not for truth values and options, which are kept as such.
fn is_number(p: Primitive) -> bool {
    p.is_number() && !matches!(p, Primitive::Bool | Primitive::Choice(_))
}

/// Returns true for a class that is made of such primitives and such classes of things alone, a class with parts of its
/// own kind once.
fn is_made_of(
    document: &Document,
    class: ClassId,
    is_primitive: impl Fn(Primitive) -> bool,
    is_thing: impl Fn(ClassId) -> bool,
) -> bool {
    let (mut seen, mut open) = (BTreeSet::new(), vec![class]);
    while let Some(class) = open.pop() {
        if !seen.insert(class) {
            continue;
        }
        match document.classes[class].kind {
            ClassKind::Primitive(p) if is_primitive(p) => {}
            ClassKind::Composite if is_thing(class) => {
                let fields = document.layout(class).into_iter();
                open.extend(fields.map(|field| document.field_class(field)));
            }
            ClassKind::List(element) => open.push(element),
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => return false,
        }
    }
    true
}

/// Returns true for a class whose things have as many parts as a number says.
fn has_counts(document: &Document, class: ClassId) -> bool {
    document.primary_line(class).iter().any(|&c| {
        let c = &document.classes[c];
        !c.counts.is_empty() || c.general.is_some()
    })
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
