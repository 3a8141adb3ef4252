//! Messages to classes themselves: `Circle.tangent(a, b, radius: r)`. How they are declared, and which of a class's
//! forms a call means: one with as many parameters, among them every label that is written, of classes that the arguments fit.

use crate::calls::Arg;
use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::names::owners;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::{ClassId, Message, Term, builtin, form};
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr};

impl Lowerer<'_> {
    /// Returns the class that an expression names as the receiver of a message, where it names no part nearer by.
    pub(crate) fn class_as_receiver(&mut self, scope: &Scope, e: &Expr) -> Option<ClassId> {
        let Expr::Name(name) = e else { return None };
        let name = name.name()?.name();
        let class = self.visible.class(scope.file, &name)?;
        let bound = scope.local(&name).is_some()
            || scope.element(&name).is_some()
            || scope.constants.contains_key(&name);
        let is_part = |l: &mut Self| {
            owners(scope).into_iter().any(|(c, _)| l.kind_of_part(c, &name).is_some())
        };
        (!bound && !is_part(self)).then_some(class)
    }

    /// Lowers a message to a class.
    pub(crate) fn message_to_class(
        &mut self,
        scope: &Scope,
        class: ClassId,
        word: &ast::Word,
        args: Vec<Arg>,
    ) -> Option<(Term, Kind)> {
        let forms = self.forms_of(class, word.text());
        let fits = |m: &&Message| {
            let takes = |label: &Name| m.parameters.iter().any(|p| p.labels().contains(&label));
            m.parameters.len() == args.len()
                && args.iter().all(|a| a.label.as_ref().is_none_or(|l| takes(&l.name())))
        };
        let document = &self.document;
        let suits = |m: &&Message| {
            args.iter().enumerate().all(|(i, arg)| {
                let is =
                    |label: &Name| m.parameters.iter().position(|p| p.labels().contains(&label));
                let place = arg.label.as_ref().map_or(Some(i), |l| is(&l.name()));
                let class = place.and_then(|i| m.parameters.get(i)?.class);
                class.is_none_or(|c| arg.kind.fits(&Kind::of_class(document, c), document))
            })
        };
        let fitting: Vec<&Message> = forms.iter().filter(fits).collect();
        // what no form suits is said of the first
        let found = fitting.iter().copied().find(suits).or(fitting.first().copied());
        let Some(found) = found.map(|m| m.name.clone()) else {
            self.no_such_form(scope, class, word, &forms);
            return None;
        };
        let definer = self.find_message(class, &found, None).map(|(c, _)| c)?;
        let place = Place { file: scope.file, span: word.span() };
        self.refer(place, &found, class);
        let (arguments, kind) =
            self.checked_message(scope, (class, definer), (word, &found), args)?;
        let to = Box::new(Term::Class(class));
        Some((Term::Send { to, name: found, arguments, search: None }, kind))
    }

    /// Returns what a class, or one above it, answers itself by a word; what it declares anew once.
    fn forms_of(&self, class: ClassId, word: &str) -> Vec<Message> {
        let mut forms: Vec<Message> = Vec::new();
        for c in self.document.lineage(class) {
            for m in &self.document.classes[c].messages {
                let is_form = m.is_of_class() && m.word() == word;
                if is_form && forms.iter().all(|known| known.name != m.name) {
                    forms.push(m.clone());
                }
            }
        }
        forms
    }

    fn no_such_form(&mut self, scope: &Scope, class: ClassId, word: &ast::Word, forms: &[Message]) {
        let what = self.document.classes[class].name.clone();
        let place = Place { file: scope.file, span: word.span() };
        let written = |m: &Message| {
            let labels: Vec<&str> = m.parameters.iter().map(|p| p.label.as_str()).collect();
            format!("`{what}.{}({})`", m.word(), labels.join(", "))
        };
        if !forms.is_empty() {
            let message = format!("{what}.{} takes other arguments", word.text());
            let forms: Vec<String> = forms.iter().map(written).collect();
            let hint = format!("it is written {}", forms.join(" or "));
            return self.report(Diagnostic::error("wrong-arity", place, message).hint(hint));
        }
        let broken =
            self.broken.iter().any(|(_, name)| name.starts_with(&format!("{}(", word.text())));
        if broken {
            return;
        }
        let message = format!("the class {what} answers no {} itself", word.text());
        let mut d = Diagnostic::error("unknown-part", place, message);
        let lineage = self.document.lineage(class);
        let all = lineage.iter().flat_map(|&c| &self.document.classes[c].messages);
        let mut known: Vec<String> =
            all.filter(|m| m.is_of_class()).map(|m| m.word().to_string()).collect();
        known.dedup();
        d = match self.nearest(word.text(), known.iter().map(String::as_str)) {
            Some(near) => d.meant(near),
            None if self.find_message(class, &word.name(), None).is_some() => {
                d.hint(format!("it is asked of a thing: `x.{}` where x is a {what}", word.text()))
            }
            None if known.is_empty() => d,
            None => d.hint(format!("it answers {}", known.join(", "))),
        };
        self.report(d);
    }

    /// Declares a message to the class itself.
    pub(crate) fn declare_static(&mut self, scope: &Scope, message: &ast::Message) {
        let Some(word) = message.name() else { return };
        let (parameters, inner) = self.parameters_of(scope, message);
        let name = form(word.text(), parameters.iter().map(|p| p.label.as_str()));
        let class = scope.class();
        let place = Place { file: scope.file, span: word.span() };
        if message.is_replacing() {
            let message = "a message to a class has no thing that it could replace".to_string();
            let d = Diagnostic::error("no-thing", place, message);
            self.report(d.hint("leave `static` or `replacing` out"));
        }
        if let Some(&before) = self.named_at.get(&(class, name.clone())) {
            let message = format!("the class answers {} with these labels already", word.text());
            let d = Diagnostic::error("duplicate-name", place, message);
            return self
                .report(d.label(before, "here").hint("give one of them another name or label"));
        }
        let answers = message.class().and_then(|ty| self.class_of_type(scope, &ty));
        if let Some(class) = answers {
            let kind = Kind::of_class(&self.document, class);
            self.message_kinds.insert((scope.class(), name.clone()), Some(kind));
        }
        let span = ast::span_without_doc(message.syntax());
        let mut declared = Message {
            name: name.clone(),
            doc: message.doc().unwrap_or_default(),
            parameters,
            class: answers,
            answer: self.unsaid.clone(),
            is_asked: true,
            is_default: false,
            is_combining: false,
            is_replacing: false,
            origin: self.origin(scope.file, span),
        };
        match (message.is_builtin(), message.definition()) {
            (false, Some(answer)) => self.add_message(&inner, &[], &word, &answer, declared),
            (true, None) => {
                let owner = self.document.classes[class].name.clone();
                let known = builtin::making(&owner, &name).zip(answers);
                let Some((what, answers)) = known else {
                    let message = format!("nothing by the name {owner}.{name} is built in");
                    let d = Diagnostic::error("unknown-builtin", place, message);
                    return self.report(d.hint("write what it answers after `=>`"));
                };
                let locals = declared.parameters.iter().map(|p| Term::Local(p.name.clone()));
                let of = locals.collect();
                declared.answer = Rc::new(Term::Construct { what, class: answers, of });
                self.named_at.insert((class, name.clone()), place);
                let index = self.document.classes[class].messages.len();
                self.messages.insert((class, name), index);
                self.document.classes[class].messages.push(declared);
            }
            (true, Some(_)) => {
                let message = "what is built in is not written out".to_string();
                self.error("unknown-builtin", scope.file, word.span(), message);
            }
            // the parser has said so
            (false, None) => {}
        }
    }

    /// Reports a message to a class that speaks of a thing of it.
    pub(crate) fn speaks_of_no_thing(
        &mut self,
        scope: &Scope,
        name: &Name,
        answer: &Expr,
        term: &Term,
    ) {
        if name.ends_with(')') && crate::rules::speaks_of_me(term) {
            let message = "a message to a class has no thing of it to speak of".to_string();
            let place = Place { file: scope.file, span: answer.span() };
            let d = Diagnostic::error("no-thing", place, message);
            self.report(d.hint("give it what it speaks of as a parameter, or leave `static` out"));
        }
    }
}
