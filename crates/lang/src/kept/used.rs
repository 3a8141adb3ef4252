//! What used texts say, taken over: their classes know nothing of the text that uses them.
//!
//! In: what the text meant before. Out: answers and constraints of the classes of used texts, where these texts, what
//! they count in and their classes are as they were. Most of a text with a library is that library.

use crate::files::File;
use crate::kinds::Kind;
use crate::lower::{Lowered, Lowerer, OWN};
use crate::scope::Scope;
use base::{Id, Name};
use kernel::{ClassId, Constraint, Document, OriginId, Part, Search, Term};
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::rc::Rc;
use syntax::ast;

/// What of used texts may be taken over by a text that uses the same.
#[derive(Debug)]
pub(crate) struct Used {
    /// So many classes come first: the language's own, and those that used texts declare.
    classes: usize,
    /// What speaks of other classes, once that was asked for: few texts are followed by another.
    others: OnceCell<Others>,
}

/// What of used texts speaks of other classes than theirs, which may be others next time.
#[derive(Debug)]
struct Others {
    /// Messages: by class and place.
    messages: BTreeSet<(ClassId, usize)>,
    /// Constraints.
    constraints: BTreeSet<(ClassId, usize)>,
}

impl Others {
    fn of(document: &Document, classes: usize) -> Self {
        let all = || document.classes.iter().take(classes);
        let is_other = |term: &Term| !is_of_first(term, classes);
        let messages = all().flat_map(|(id, class)| {
            let others = class.messages.iter().enumerate().filter(|(_, m)| is_other(&m.answer));
            others.map(move |(i, _)| (id, i))
        });
        let says_other = |c: &Constraint| {
            let values = c.methods.iter().flat_map(|m| &m.values);
            let mut terms = values.chain(c.within.as_deref()).chain([&*c.rule]);
            terms.any(is_other)
        };
        let constraints = all().flat_map(|(id, class)| {
            let others = class.constraints.iter().enumerate().filter(|(_, c)| says_other(c));
            others.map(move |(i, _)| (id, i))
        });
        Self { messages: messages.collect(), constraints: constraints.collect() }
    }
}

impl<'l> Lowerer<'l> {
    /// Finds out whether used texts say what they said; what messages of their classes are worth is known then.
    pub(crate) fn begin_used(&mut self) {
        let Some((before, used)) = self.before.and_then(|b| Some((b, b.used.clone()?))) else {
            return;
        };
        if !self.uses_the_same(before, &used) {
            return;
        }
        let is_first = |class: ClassId| class.index() < used.classes;
        let known = before.names.message_kinds.iter().filter(|((class, _), kind)| {
            let is_program = before.names.drawing.contains_key(class);
            !is_program
                && is_first(*class)
                && kind.as_ref().is_some_and(|kind| speaks_of(kind, &is_first))
        });
        for (key, kind) in known {
            self.message_kinds.entry(key.clone()).or_insert_with(|| kind.clone());
        }
        // what is taken over is not read again, and speaks of what it spoke of
        self.spoken.extend(before.names.spoken.iter().filter(|(by, _)| *by != OWN));
        self.used = Some((before, used));
    }

    /// Returns what the next text may take over of used texts, once all of their members are lowered.
    pub(crate) fn keepable_of_used(&self) -> Option<Rc<Used>> {
        if let Some((_, used)) = &self.used {
            return Some(used.clone());
        }
        let is_plain = self.modifications.is_empty()
            && !self.kin.is_asked_by_used
            && self.diagnostics.iter().all(|d| d.place.file == OWN)
            && self.replacements.iter().all(|(scope, ..)| scope.file == OWN);
        is_plain.then(|| {
            let classes = self.used_classes();
            Rc::new(Used { classes, others: OnceCell::new() })
        })
    }

    /// How many classes come before those of the document's own text.
    fn used_classes(&self) -> usize {
        let classes = self.declared.iter().map(|(class, file, _)| (class.index(), *file));
        let programs = self.programs.declared().into_iter();
        let all = classes.chain(programs.map(|(class, file, _)| (class.index(), file)));
        all.filter(|(_, file)| *file != OWN).map(|(class, _)| class + 1).max().unwrap_or_default()
    }

    fn uses_the_same(&self, before: &Lowered, used: &Used) -> bool {
        let is_same = |(a, b): (&File, &File)| a.name == b.name && a.text == b.text;
        let files = self.files.iter().zip(before.files.iter()).skip(1);
        let (is, was) = (&self.document, &before.document);
        self.files.len() == before.files.len()
            && files.map(|((_, a), (_, b))| (a, b)).all(is_same)
            && self.modifications.is_empty()
            && self.file_things == before.names.file_things
            && used.classes == self.used_classes()
            && (&is.unit, is.vertical, is.scale) == (&was.unit, was.vertical, was.scale)
            && is.units_per_metre.to_bits() == was.units_per_metre.to_bits()
            && (is.writes_lengths, &is.usual) == (was.writes_lengths, &was.usual)
            && (0..used.classes).all(|i| is_declared_alike(is, was, ClassId(i as u32)))
    }

    /// Takes over what a message of a used text answers; false where that is to be lowered.
    pub(crate) fn keep_answer(&mut self, scope: &Scope, index: usize) -> bool {
        let Some((before, used)) = self.used.clone().filter(|(_, u)| u.has(scope)) else {
            return false;
        };
        let class = scope.class();
        let others = used.others(before);
        let was = before.document.classes[class].messages.get(index);
        let is = &mut self.document.classes[class].messages[index];
        match was.filter(|was| was.name == is.name && !others.messages.contains(&(class, index))) {
            Some(was) => {
                is.answer = was.answer.clone();
                // what is said here may be a list's class, which is made anew; what is not is found by the answer
                is.class = is.class.or(was.class);
                true
            }
            None => false,
        }
    }

    /// Takes over a constraint of a used text; false where it is to be lowered.
    pub(crate) fn keep_constraint(
        &mut self,
        scope: &Scope,
        c: &ast::Constraint,
        origin: OriginId,
    ) -> bool {
        let Some((before, used)) = self.used.clone().filter(|(_, u)| u.has(scope)) else {
            return false;
        };
        let class = scope.class();
        let index = self.document.classes[class].constraints.len();
        let others = used.others(before);
        let was = before.document.classes[class].constraints.get(index);
        let place = self.origins.place(origin);
        let is_it = |was: &&Constraint| {
            before.origins.place(was.origin) == place
                && !others.constraints.contains(&(class, index))
        };
        let Some(was) = was.filter(is_it) else { return false };
        let mut constraint = Constraint { origin, ..was.clone() };
        for method in &mut constraint.methods {
            let span = before.origins.place(method.origin).span;
            method.origin = self.rule_origin(scope, span);
        }
        // its name is taken
        let _ = self.rule_name(scope, c.name());
        self.document.classes[class].constraints.push(constraint);
        true
    }
}

impl Used {
    /// What speaks of other classes in the text that this is of.
    fn others(&self, of: &Lowered) -> &Others {
        self.others.get_or_init(|| Others::of(&of.document, self.classes))
    }
    /// Whether what stands here is of a class that a used text declares, as it is declared.
    fn has(&self, scope: &Scope) -> bool {
        let is_alone = scope.constants.is_empty() && scope.elements.is_empty();
        scope.file != OWN && is_alone && scope.classes.iter().all(|c| c.index() < self.classes)
    }
}

/// Whether a class has the name, superclasses, parts and messages that it had.
fn is_declared_alike(is: &Document, was: &Document, id: ClassId) -> bool {
    let (Some(a), Some(b)) = (is.classes.get(id), was.classes.get(id)) else { return false };
    let name = |of: &Document, class: ClassId| of.classes.get(class).map(|c| c.name.clone());
    let is_part = |(a, b): (&Part, &Part)| {
        (&a.name, a.class, a.count) == (&b.name, b.class, b.count)
            && name(is, a.class) == name(was, b.class)
    };
    let names = |class: &kernel::Class| -> Vec<Name> {
        class.messages.iter().map(|m| m.name.clone()).collect()
    };
    a.name == b.name
        && (&a.kind, &a.supers) == (&b.kind, &b.supers)
        && a.parts.len() == b.parts.len()
        && a.parts.iter().zip(&b.parts).all(is_part)
        && names(a) == names(b)
        && b.refined.is_empty()
}

/// Whether all the classes that a kind speaks of are such.
fn speaks_of(kind: &Kind, is_such: &dyn Fn(ClassId) -> bool) -> bool {
    match kind {
        Kind::Option(class) | Kind::Thing(class) => is_such(*class),
        Kind::List(element) => speaks_of(element, is_such),
        Kind::Tuple(kinds) => kinds.iter().all(|kind| speaks_of(kind, is_such)),
        Kind::Number(_)
        | Kind::Bool
        | Kind::Text
        | Kind::Color
        | Kind::Picture
        | Kind::Function
        | Kind::Unknown => true,
    }
}

/// Whether a term speaks of the first classes alone.
fn is_of_first(term: &Term, classes: usize) -> bool {
    let class = match term {
        Term::Class(class)
        | Term::All(class)
        | Term::Option(class, _)
        | Term::IsA(_, class)
        | Term::Make { class, .. }
        | Term::Construct { class, .. }
        | Term::Send { search: Some(Search::Above(class) | Search::As(class)), .. } => Some(class),
        Term::Send { search: None, .. }
        | Term::Number { .. }
        | Term::Text(_)
        | Term::Bool(_)
        | Term::Me
        | Term::Owner
        | Term::Document
        | Term::Local(_)
        | Term::Call { .. }
        | Term::Tuple(_)
        | Term::List(_)
        | Term::Range(..)
        | Term::Index(..)
        | Term::Unary(..)
        | Term::Binary(..)
        | Term::If(..)
        | Term::Let(..)
        | Term::Lambda(..)
        | Term::Copy(_)
        | Term::Step(_)
        | Term::Result
        | Term::OfConstraint { .. } => None,
    };
    class.is_none_or(|class| class.index() < classes)
        && term.operands().into_iter().all(|term| is_of_first(term, classes))
}
