//! Choices: classes of a few options with names, `choice Fit { loose, normal, close }`.
//!
//! Where a choice is wanted, a name is first looked for among its options; anywhere else an option is known by
//! its name alone where nothing else is called so and one choice has it, and always as `Fit.close`.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::names::{MOST_LISTED, owners};
use crate::scope::{Constant, Scope};
use base::{Diagnostic, FileId, Name, Place};
use kernel::{ClassId, ClassKind, Document, Primitive, Term};
use std::collections::BTreeSet;
use syntax::ast::{self, AstNode, BinaryOp, Expr};

/// What an expression means and is worth; nothing where it is wrong.
type Found = Option<(Term, Kind)>;

impl Lowerer<'_> {
    /// Names a choice of a file.
    pub(crate) fn declare_choice_class(&mut self, file: FileId, choice: &ast::Choice) {
        let Some(word) = choice.name() else { return };
        let origin = self.origin(file, choice.span());
        if self.visible.declared(file, word.text()).is_some() {
            let message = format!("there is a class {} already", word.text());
            return self.error("duplicate-name", file, word.span(), message);
        }
        let object = self.object;
        let class = self.add_class(word.text(), ClassKind::Composite, &[object], origin);
        let mut options: Vec<Name> = Vec::new();
        let mut known: BTreeSet<Name> = BTreeSet::new();
        for option in choice.options() {
            if !known.insert(option.name()) {
                let message = format!("{} has {} already", word.text(), option.text());
                self.error("duplicate-name", file, option.span(), message);
                continue;
            }
            options.push(option.name());
        }
        let is_broken = choice.syntax().children().next().is_some();
        if options.is_empty() && !is_broken {
            let message = format!("{} has nothing to choose", word.text());
            let d = Diagnostic::error("empty-choice", Place { file, span: word.span() }, message);
            self.report(d.hint(format!("name the options: `choice {} {{ a, b }}`", word.text())));
        }
        let c = &mut self.document.classes[class];
        c.kind = ClassKind::Primitive(Primitive::Choice(class));
        (c.options, c.doc) = (options, choice.doc().unwrap_or_default());
        self.visible.add(file, word.name(), class);
        self.choices.push(class);
    }

    /// Returns the option that a name is where a choice is wanted that has it, unless something of that choice is
    /// called so here.
    pub(crate) fn option_wanted(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
        wanted: &Kind,
    ) -> Found {
        let Kind::Option(choice) = wanted else { return None };
        let at = self.document.option_named(*choice, word.text())?;
        let name = word.name();
        let is_part = |l: &mut Self| {
            let mut all = owners(scope).into_iter();
            all.any(|(class, _)| l.kind_of_part(class, &name).as_ref() == Some(wanted))
        };
        let is_bound = scope.local(&name) == Some(wanted)
            || matches!(scope.constants.get(&name), Some(Constant::Value(_, kind)) if kind == wanted);
        (!is_bound && !is_part(self)).then_some((Term::Option(*choice, at), Kind::Option(*choice)))
    }

    /// Resolves a name where a kind is wanted: one that means nothing is an option that the choice does not have.
    pub(crate) fn name_wanting(&mut self, scope: &Scope, word: &ast::Word, wanted: &Kind) -> Found {
        let &Kind::Option(choice) = wanted else { return self.name(scope, word) };
        self.silent += 1;
        let found = self.name(scope, word);
        self.silent -= 1;
        if found.is_none() {
            self.missing_option(scope, choice, word);
        }
        found
    }

    /// Returns the option that a name is which means nothing else; an empty answer, reported, where several choices
    /// have it.
    pub(crate) fn option_named(&mut self, scope: &Scope, word: &ast::Word) -> Option<Found> {
        let document = &self.document;
        let seen = |&&class: &&ClassId| {
            let name = &document.classes[class].name;
            self.visible.class(scope.file, name) == Some(class)
        };
        let has = |&class: &ClassId| Some((class, document.option_named(class, word.text())?));
        let found: Vec<(ClassId, u32)> = self.choices.iter().filter(seen).filter_map(has).collect();
        match found.as_slice() {
            [] => None,
            &[(class, at)] => Some(Some((Term::Option(class, at), Kind::Option(class)))),
            several => {
                let name = word.text();
                let each = |(class, _): &(ClassId, u32)| {
                    format!("`{}.{name}`", document.classes[*class].name)
                };
                let each: Vec<String> = several.iter().map(each).collect();
                let place = Place { file: scope.file, span: word.span() };
                let message = format!("several choices have {name}");
                let d = Diagnostic::error("unknown-name", place, message);
                self.report(d.hint(format!("write {}", each.join(" or "))));
                Some(None)
            }
        }
    }

    /// Returns the option of a choice that stands behind its name, `Fit.close`; reports one that it does not have.
    pub(crate) fn option_of(&mut self, scope: &Scope, choice: ClassId, word: &ast::Word) -> Found {
        let at = self.document.option_named(choice, word.text());
        if at.is_none() {
            self.missing_option(scope, choice, word);
        }
        Some((Term::Option(choice, at?), Kind::Option(choice)))
    }

    /// Says that a choice has no option of this name, and which it has.
    pub(crate) fn missing_option(&mut self, scope: &Scope, choice: ClassId, word: &ast::Word) {
        let class = &self.document.classes[choice];
        let place = Place { file: scope.file, span: word.span() };
        let message = format!("{} has no option {}", class.name, word.text());
        let options: Vec<String> = class.options.iter().map(ToString::to_string).collect();
        let d = Diagnostic::error("unknown-option", place, message);
        let near = self.nearest(word.text(), options.iter().map(String::as_str));
        self.report(match near {
            Some(near) => d.meant(near),
            None if options.len() > MOST_LISTED => {
                d.hint(format!("it has {}, …", options[..MOST_LISTED].join(", ")))
            }
            None => d.hint(format!("it has {}", options.join(", "))),
        });
    }

    /// Lowers both sides of an operator; one that compares with a choice knows its options by their names alone.
    pub(crate) fn both(
        &mut self,
        scope: &Scope,
        op: BinaryOp,
        (left, right): (&Expr, &Expr),
    ) -> (Found, Found) {
        let compares = matches!(op, BinaryOp::Equal | BinaryOp::NotEqual | BinaryOp::In);
        let wanted = |found: &Found| match found {
            Some((_, kind @ Kind::Option(_))) if op == BinaryOp::In => {
                Kind::List(Box::new(kind.clone()))
            }
            Some((_, kind @ Kind::Option(_))) if compares => kind.clone(),
            _ => Kind::Unknown,
        };
        if compares && self.is_option_alone(scope, left) {
            let b = self.expr(scope, right);
            return (self.expr_wanting(scope, left, &wanted(&b)), b);
        }
        let a = self.expr(scope, left);
        let b = self.expr_wanting(scope, right, &wanted(&a));
        (a, b)
    }

    /// Returns true for a name that some choice has for an option.
    fn is_option_alone(&self, scope: &Scope, e: &Expr) -> bool {
        let Expr::Name(name) = e else { return false };
        let Some(word) = name.name().filter(|w| scope.local(&w.name()).is_none()) else {
            return false;
        };
        self.choices.iter().any(|&c| self.document.option_named(c, word.text()).is_some())
    }
}

/// Returns the choice of a name, the last declared first.
pub(crate) fn options_of(document: &Document, choices: &[ClassId], name: &str) -> Option<ClassId> {
    choices.iter().rev().copied().find(|&choice| *document.classes[choice].name == *name)
}
