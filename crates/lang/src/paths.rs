//! Paths: expressions that lead to a stored part, step by step.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::names::referred;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::{ClassId, ClassKind, Count, Path, Step};
use syntax::ast::{self, AstNode, Expr};

impl Lowerer<'_> {
    /// Lowers a path to a stored part, and finds the class of what it leads to, if that is known.
    pub(crate) fn path(&mut self, scope: &Scope, e: &Expr) -> Option<(Path, Option<ClassId>)> {
        match e {
            Expr::Paren(inner) => self.path(scope, &inner.inner()?),
            Expr::Owner(_) => Some((Path(vec![Step::Owner]), scope.classes.get(1).copied())),
            Expr::Name(name) => self.first_step(scope, &name.name()?),
            Expr::Field(field) if field.args().is_none() => {
                let (path, class) = self.path(scope, &field.receiver()?)?;
                self.next_step(scope, &path, class, &field.name()?)
            }
            Expr::Index(index) => {
                let receiver = index.receiver()?;
                let (path, class) = self.path(scope, &receiver)?;
                let at = index.index()?;
                let Some(i) = self.constant_number(scope, &at) else {
                    let message = "an index in a path is a whole number, from 0".to_string();
                    self.error("index", scope.file, at.span(), message);
                    return None;
                };
                let count = self.count_at(scope, &path);
                let i = self.element_index(scope, i, &at, (&receiver, count))?;
                let element = match class {
                    Some(list) => Some(self.element_at(list, i).or_else(|| {
                        let what = Kind::of_class(&self.document, list).words(&self.document);
                        let message = format!("{what} has no elements");
                        let span = receiver.span();
                        self.error("value-of-wrong-class", scope.file, span, message);
                        None
                    })?),
                    None => None,
                };
                Some((path.then(Step::Index(i)), element))
            }
            other => {
                let message = "a path of parts is wanted: `a.b.c`".to_string();
                self.error("not-a-path", scope.file, other.span(), message);
                None
            }
        }
    }

    /// Lowers several paths; those that are wrong are left out.
    pub(crate) fn paths(&mut self, scope: &Scope, exprs: impl Iterator<Item = Expr>) -> Vec<Path> {
        exprs.filter_map(|e| self.path(scope, &e)).map(|(path, _)| path).collect()
    }

    fn first_step(&mut self, scope: &Scope, word: &ast::Word) -> Option<(Path, Option<ClassId>)> {
        if let Some(element) = scope.element(&word.name()) {
            return Some((scope.path_to(element), self.class_of_variable(scope, element)));
        }
        let passed_over = scope.passed_over(word.text());
        let mut path = Path(vec![Step::Owner; passed_over]);
        for &class in scope.classes.iter().skip(passed_over) {
            if let Some(part) = self.class_of_part(class, &word.name()) {
                let place = Place { file: scope.file, span: word.span() };
                self.refer(place, &word.name(), class);
                return Some((path.then(Step::Part(word.name())), Some(part)));
            }
            if self.find_message(class, &word.name(), None).is_some() {
                return self.refuse_virtual(scope, word);
            }
            path = path.then(Step::Owner);
        }
        self.unknown_name(scope, word);
        None
    }

    fn next_step(
        &mut self,
        scope: &Scope,
        path: &Path,
        class: Option<ClassId>,
        word: &ast::Word,
    ) -> Option<(Path, Option<ClassId>)> {
        if word.text() == "owner" {
            return Some((path.then(Step::Owner), None));
        }
        let Some(class) = class else {
            return Some((path.then(Step::Part(word.name())), None));
        };
        if let Some(element) = self.element(class).filter(|_| word.text() == "last") {
            return Some((path.then(Step::Last), Some(element)));
        }
        match self.class_of_part(class, &word.name()) {
            Some(part) => {
                let place = Place { file: scope.file, span: word.span() };
                self.refer(place, &word.name(), class);
                Some((path.then(Step::Part(word.name())), Some(part)))
            }
            None if self.find_message(class, &word.name(), None).is_some() => {
                self.refuse_virtual(scope, word)
            }
            None => match self.kin_with(scope, class, &word.name()) {
                Some(kin) => self.next_step(scope, path, Some(kin), word),
                None => {
                    self.unknown_part(scope, &Kind::of_class(&self.document, class), word);
                    None
                }
            },
        }
    }

    fn refuse_virtual(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
    ) -> Option<(Path, Option<ClassId>)> {
        let message = format!("{} is a virtual part: it is computed, not stored", word.text());
        let place = Place { file: scope.file, span: word.span() };
        let d = Diagnostic::error("virtual-part", place, message);
        self.report(d.hint("say what it shall be by a constraint: `constraint a = b`"));
        None
    }

    pub(crate) fn element(&self, list: ClassId) -> Option<ClassId> {
        match self.document.classes[list].kind {
            ClassKind::List(element) => Some(referred(&self.document, element)),
            ClassKind::Primitive(_)
            | ClassKind::Composite
            | ClassKind::Set(_)
            | ClassKind::Reference(_) => None,
        }
    }

    /// Returns the class of one element of a list.
    pub(crate) fn element_at(&self, list: ClassId, i: u32) -> Option<ClassId> {
        let own = self.document.classes[list].elements.get(i as usize);
        own.map(|&c| referred(&self.document, c)).or_else(|| self.element(list))
    }

    /// Returns the path that an expression is, if it is one; what is wrong with it is said elsewhere.
    pub(crate) fn silent_path(&mut self, scope: &Scope, e: &Expr) -> Option<Path> {
        let mut names = e.syntax().descendants().filter_map(ast::NameExpr::cast);
        if names.any(|n| n.name().is_some_and(|w| scope.local(w.text()).is_some())) {
            return None;
        }
        self.silent += 1;
        let found = self.path(scope, e);
        self.silent -= 1;
        found.map(|(path, _)| path)
    }

    /// Returns how many elements a list always has, if its declaration tells.
    pub(crate) fn count_of(&mut self, scope: &Scope, list: &Expr) -> Option<u32> {
        let path = self.silent_path(scope, list)?;
        self.count_at(scope, &path)
    }

    /// Returns the class of what has a list.
    pub(crate) fn owner_of(&mut self, scope: &Scope, list: &Expr) -> Option<ClassId> {
        let path = self.silent_path(scope, list)?;
        self.owner_at(scope, &path).map(|(owner, _)| owner)
    }

    /// Returns how many elements a list has: as its declaration tells, or what it is given.
    pub(crate) fn length_of(&mut self, scope: &Scope, list: &Expr) -> Option<u32> {
        let path = self.silent_path(scope, list)?;
        self.length_at(scope, &path)
    }

    /// Returns how many elements the list at a path has: as its declaration tells, or what it is given.
    pub(crate) fn length_at(&self, scope: &Scope, path: &Path) -> Option<u32> {
        let given = || match self.owner_at(scope, path)? {
            (owner, Step::Part(name)) => {
                self.given_by_body(scope, path).or_else(|| self.given_count(owner, name))
            }
            (_, Step::Index(_) | Step::Last | Step::Owner) => None,
        };
        self.count_at(scope, path).or_else(given)
    }

    /// Returns how many elements a list is given by the body of the part that has it.
    fn given_by_body(&self, scope: &Scope, path: &Path) -> Option<u32> {
        let (Step::Part(list), part) = path.0.split_last()? else { return None };
        let part = Path(part.to_vec());
        let (class, Step::Part(part)) = self.owner_at(scope, &part)? else { return None };
        let line = self.document.primary_line(class);
        let given = |c: ClassId| self.given_in_bodies.get(&(c, part.clone(), list.clone()));
        line.into_iter().find_map(given).copied()
    }

    /// Returns how many elements the list at a path always has, if its declaration tells.
    pub(crate) fn count_at(&self, scope: &Scope, path: &Path) -> Option<u32> {
        let (owner, step) = self.owner_at(scope, path)?;
        match step {
            Step::Part(name) => self.count_of_part(owner, name),
            Step::Index(_) | Step::Last => {
                let list = self.class_at(owner, &Path(vec![step.clone()]))?;
                self.document.classes[list].count
            }
            Step::Owner => None,
        }
    }

    /// Returns the class of what owns the thing at a path, and the last step to it.
    pub(crate) fn owner_at<'p>(
        &self,
        scope: &Scope,
        path: &'p Path,
    ) -> Option<(ClassId, &'p Step)> {
        let outwards = path.0.iter().take_while(|step| **step == Step::Owner).count();
        let class = *scope.classes.get(outwards)?;
        let (step, owner) = path.0[outwards..].split_last()?;
        Some((self.class_at(class, &Path(owner.to_vec()))?, step))
    }

    /// Returns how many elements the list of this name is given, by the class or the nearest above it.
    pub(crate) fn given_count(&self, class: ClassId, name: &Name) -> Option<u32> {
        let line = self.document.primary_line(class);
        line.into_iter().find_map(|c| self.given_counts.get(&(c, name.clone())).copied())
    }

    /// Returns how many elements the list of this name has, if its class tells.
    pub(crate) fn count_of_part(&self, class: ClassId, name: &Name) -> Option<u32> {
        let narrowed = self.class_of_part(class, name);
        if let Some(count) = narrowed.and_then(|list| self.document.classes[list].count) {
            return Some(count);
        }
        let line = self.document.primary_line(class);
        let own = |c: ClassId| Some((c, *self.parts.get(&(c, name.clone()))?));
        let (c, part) = line.into_iter().find_map(own)?;
        match self.document.classes[c].parts[part].count? {
            Count::Fixed(n) => Some(n),
            Count::Given => None,
        }
    }
}

impl Lowerer<'_> {
    /// Reads a path without looking where it leads; where it speaks of elements that a `for` goes through,
    /// and by numbers known here, these are what it says.
    pub(crate) fn written_path(&mut self, scope: &Scope, expr: &Expr) -> Option<Path> {
        match expr {
            Expr::Name(name) => match scope.element(&name.name()?.name()) {
                Some(element) => Some(scope.path_to(element)),
                None => loose_path(expr),
            },
            Expr::Field(field) if field.args().is_none() => {
                let name = field.name()?.name();
                let step = if name == "last" { Step::Last } else { Step::Part(name) };
                Some(self.written_path(scope, &field.receiver()?)?.then(step))
            }
            Expr::Index(index) => {
                let i = self.constant(scope, &index.index()?)?;
                let list = self.written_path(scope, &index.receiver()?)?;
                Some(list.then(Step::Index(u32::try_from(i).ok()?)))
            }
            Expr::Paren(inner) => self.written_path(scope, &inner.inner()?),
            other => loose_path(other),
        }
    }
}

/// Reads a path without looking where it leads.
pub(crate) fn loose_path(expr: &Expr) -> Option<Path> {
    match expr {
        Expr::Name(name) => Some(Path(vec![Step::Part(name.name()?.name())])),
        Expr::Owner(_) => Some(Path(vec![Step::Owner])),
        Expr::Paren(inner) => loose_path(&inner.inner()?),
        Expr::Field(field) if field.args().is_none() => {
            let name = field.name()?.name();
            let step = if name == "last" { Step::Last } else { Step::Part(name) };
            Some(loose_path(&field.receiver()?)?.then(step))
        }
        Expr::Index(index) => {
            let i = crate::numbers::constant(&|_| None, &index.index()?)?;
            let i = (i.fract() == 0.0 && (0.0..4e9).contains(&i)).then_some(i as u32)?;
            Some(loose_path(&index.receiver()?)?.then(Step::Index(i)))
        }
        _ => None,
    }
}
