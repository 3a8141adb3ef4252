//! Calls: messages, functions of the language, constructors; their arguments checked.

use crate::functions::{pair, wanted_number};
use crate::hints::{ONE_KIND, instead_of_abstract};
use crate::kinds::{Kind, made, measured, wanted_in_words, with_article};
use crate::lower::Lowerer;
use crate::names::owners;
use crate::scope::Scope;
use crate::terms::{Holds, code_for};
use base::diagnostic::nearest;
use base::{Diagnostic, Name, Place, Span};
use expr::dimension::Dimension;
use kernel::builtin::{self, Kind as Builtin};
use kernel::{Argument, ClassId, ClassKind, Primitive, Search, Term};
use syntax::ast::{self, AstNode, Expr};

/// An argument, lowered, before it is known what is wanted of it.
pub(crate) struct Arg {
    pub(crate) label: Option<ast::Word>,
    pub(crate) value: Term,
    pub(crate) kind: Kind,
    /// What a function answers.
    pub(crate) answers: Kind,
    pub(crate) expr: Expr,
}

/// How what runs in time is written.
const STEPS_OF_TIME: &str = "take steps: `states: List of 101 State  for a, b in states.neighbours { constraint \
                             b.x = a.x + h * a.v }`, or `repeat n times with x = … { next x = … }` in a program";

/// Something that is wanted of a call: its label, its name inside, its class, what it may be.
struct Wanted {
    labels: [Name; 2],
    class: Option<ClassId>,
    kind: Kind,
}

impl Lowerer<'_> {
    /// Lowers `a.b` and `a.b(…)`.
    pub(crate) fn field(&mut self, scope: &Scope, field: &ast::FieldExpr) -> Option<(Term, Kind)> {
        let (receiver, word) = (field.receiver()?, field.name()?);
        let name = word.name();
        if let Expr::Super(_) = receiver {
            return self.super_message(scope, field, &word);
        }
        if let Some(of) = self.of_constraint(scope, field, &receiver) {
            return Some(of);
        }
        if let (Expr::Name(text), Some(args)) = (&receiver, field.args()) {
            let text = text.name().and_then(|w| self.text_named(scope.file, w.text()));
            if let Some(class) = text.and_then(|t| self.visible.declared(t, &name)) {
                let args = self.arguments(scope, Some(args), &Kind::Unknown)?;
                return self.constructor(scope, &word, class, args);
            }
        }
        if let Some(class) = self.class_as_receiver(scope, &receiver) {
            if let ClassKind::Primitive(Primitive::Choice(of)) = self.document.classes[class].kind {
                return self.option_of(scope, of, &word);
            }
            let args = self.arguments(scope, field.args(), &Kind::Unknown)?;
            return self.message_to_class(scope, class, &word, args);
        }
        let (to, kind) = self.expr(scope, &receiver)?;
        if field.args().is_none()
            && let Some(made) = self.places_by_component(&name, &to, &kind)
        {
            return Some(made);
        }
        let element = if let Kind::List(element) = &kind { element } else { &Kind::Unknown };
        let args = self.arguments(scope, field.args(), element)?;
        let (arguments, answer) = self.message(scope, &kind, &word, args, &to)?;
        let search = match kind {
            Kind::Thing(class)
                if self.class_of_part(class, &name).is_none()
                    && self.is_primary_superclass(scope, &receiver) =>
            {
                Some(Search::As(class))
            }
            _ => None,
        };
        Some((Term::Send { to: Box::new(to), name, arguments, search }, answer))
    }

    /// Returns true for an expression that reaches a thing by the name of a primary superclass: what is
    /// sent to it is answered as that class says.
    fn is_primary_superclass(&mut self, scope: &Scope, e: &Expr) -> bool {
        let named = |word: Option<ast::Word>| word.map(|w| w.name());
        match e {
            Expr::Paren(inner) => {
                inner.inner().is_some_and(|e| self.is_primary_superclass(scope, &e))
            }
            Expr::Name(name) => {
                let Some(name) = named(name.name()) else { return false };
                let bound = scope.local(&name).is_some() || scope.element(&name).is_some();
                let owner = scope.classes.iter().find(|&&c| self.class_of_part(c, &name).is_some());
                !bound && owner.is_some_and(|&c| self.is_primary_name(c, &name))
            }
            Expr::Field(field) => {
                let name = named(field.name()).filter(|n| self.primary_names.contains(n));
                let (Some(name), Some(receiver)) = (name, field.receiver()) else { return false };
                self.silent += 1;
                let owner = self.expr(scope, &receiver);
                self.silent -= 1;
                matches!(owner, Some((_, Kind::Thing(c))) if self.is_primary_name(c, &name))
            }
            _ => false,
        }
    }

    fn super_message(
        &mut self,
        scope: &Scope,
        field: &ast::FieldExpr,
        word: &ast::Word,
    ) -> Option<(Term, Kind)> {
        let (class, name) = (scope.class(), word.name());
        let args = self.arguments(scope, field.args(), &Kind::Unknown)?;
        let search = Some(Search::Above(class));
        let above = self.find_message(class, &name, search).map(|(c, _)| c);
        if let Some(definer) = above {
            self.refer(Place { file: scope.file, span: word.span() }, &name, definer);
        }
        let (arguments, kind) = match above {
            Some(definer) => self.user_message(scope, (class, definer), word, args)?,
            None => {
                let message = format!("no superclass has a message {name}");
                self.error("unknown-part", scope.file, word.span(), message);
                return None;
            }
        };
        let to = Box::new(Term::Me);
        Some((Term::Send { to, name, arguments, search }, kind))
    }

    /// Finds out what a receiver answers to a name; reports a name that it does not know.
    fn message(
        &mut self,
        scope: &Scope,
        receiver: &Kind,
        word: &ast::Word,
        args: Vec<Arg>,
        to: &Term,
    ) -> Option<(Vec<Argument>, Kind)> {
        let name = word.name();
        let outwards = owners_in(to);
        if name == "owner" && outwards > 0 && args.is_empty() {
            let class = scope.classes.get(outwards + 1);
            return Some((Vec::new(), class.map_or(Kind::Unknown, |&class| Kind::Thing(class))));
        }
        if name == "owner" || *receiver == Kind::Unknown || outwards > 0 {
            let known = match receiver {
                Kind::Thing(class) => {
                    self.refer(Place { file: scope.file, span: word.span() }, &name, *class);
                    self.kind_of_part(*class, &name)
                }
                _ => None,
            };
            return Some((unchecked(args), known.unwrap_or(Kind::Unknown)));
        }
        if builtin::is_of_each(&name) && !args.is_empty() && self.is_set(receiver) {
            return Some((unchecked(args), receiver.clone()));
        }
        match receiver {
            Kind::Number(_) => {
                self.own_message(scope, builtin::NUMBER_MESSAGES, receiver, word, args)
            }
            // what a text spells may measure anything
            Kind::Text | Kind::Color if name == "number" && args.is_empty() => {
                Some((Vec::new(), Kind::Unknown))
            }
            Kind::Text | Kind::Color => {
                self.own_message(scope, builtin::TEXT_MESSAGES, receiver, word, args)
            }
            Kind::List(_) => self.own_message(scope, builtin::LIST_MESSAGES, receiver, word, args),
            Kind::Picture => {
                self.own_message(scope, builtin::PICTURE_MESSAGES, receiver, word, args)
            }
            Kind::Thing(class) => {
                self.refer(Place { file: scope.file, span: word.span() }, &name, *class);
                if let Some(part) = self.class_of_part(*class, &name) {
                    let is_list = matches!(Kind::of_class(&self.document, part), Kind::List(_));
                    self.takes_none(scope, word, &args, is_list)?;
                    return Some((Vec::new(), Kind::of_class(&self.document, part)));
                }
                match self.find_message(*class, &name, None).map(|(c, _)| c) {
                    Some(definer) => self.user_message(scope, (*class, definer), word, args),
                    None if builtin::find(builtin::THING_MESSAGES, &name).is_none()
                        && let Some(kin) = self.kin_with(scope, *class, &name) =>
                    {
                        self.message(scope, &Kind::Thing(kin), word, args, to)
                    }
                    None => self.own_message(scope, builtin::THING_MESSAGES, receiver, word, args),
                }
            }
            Kind::Bool | Kind::Option(_) if name == "text" && args.is_empty() => {
                Some((Vec::new(), Kind::Text))
            }
            Kind::Bool | Kind::Option(_) | Kind::Function => {
                self.unknown_part(scope, receiver, word);
                None
            }
            Kind::Tuple(_) if builtin::find(builtin::LIST_MESSAGES, &name).is_none() => {
                self.unknown_part(scope, receiver, word);
                None
            }
            Kind::Tuple(_) | Kind::Unknown => Some((unchecked(args), Kind::Unknown)),
        }
    }

    /// Returns true for what answers some messages thing by thing: a list of things, what a program draws.
    fn is_set(&self, receiver: &Kind) -> bool {
        match receiver {
            // what a list of copies holds is known when it is made
            Kind::List(element) => {
                matches!(**element, Kind::Thing(_) | Kind::List(_) | Kind::Unknown)
            }
            Kind::Thing(class) => self.draws(*class),
            _ => false,
        }
    }

    /// Returns true for what programs draw, and for lists of lists, where a list of things is wanted: which these are is
    /// known when it is made.
    fn is_set_for(&self, found: &Kind, wanted: &Kind) -> bool {
        let draws = |kind: &Kind| matches!(kind, Kind::Thing(class) if self.draws(*class));
        let wants_things = matches!(wanted, Kind::List(each) if matches!(**each, Kind::Thing(_)));
        let is_nested = || match (found, wanted) {
            (Kind::List(each), Kind::List(wanted)) => {
                matches!(**each, Kind::List(_)) && each.inmost().fits(wanted, &self.document)
            }
            _ => false,
        };
        wants_things
            && (draws(found) || matches!(found, Kind::List(each) if draws(each)) || is_nested())
    }

    fn takes_none(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
        args: &[Arg],
        is_list: bool,
    ) -> Option<()> {
        if args.is_empty() {
            return Some(());
        }
        self.takes_no_arguments(scope, word, is_list);
        None
    }

    /// Checks a message that a class of the document or a library defines.
    fn user_message(
        &mut self,
        scope: &Scope,
        (receiver, definer): (ClassId, ClassId),
        word: &ast::Word,
        args: Vec<Arg>,
    ) -> Option<(Vec<Argument>, Kind)> {
        self.checked_message(scope, (receiver, definer), (word, &word.name()), args)
    }

    /// Checks a message by the name that it has in its class.
    pub(crate) fn checked_message(
        &mut self,
        scope: &Scope,
        (receiver, definer): (ClassId, ClassId),
        (word, name): (&ast::Word, &Name),
        args: Vec<Arg>,
    ) -> Option<(Vec<Argument>, Kind)> {
        let message = self.defined_message(definer, name)?;
        let wanted = message.parameters.iter().map(|p| Wanted {
            labels: [p.label.clone(), p.name.clone()],
            class: p.class,
            kind: p.class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c)),
        });
        let wanted: Vec<Wanted> = wanted.collect();
        if wanted.len() != args.len() {
            let labels: Vec<&str> = wanted.iter().map(|w| w.labels[0].as_str()).collect();
            let said = format!(
                "{} takes ({}), here are {} arguments",
                word.text(),
                labels.join(", "),
                args.len()
            );
            let place = Place { file: scope.file, span: word.span() };
            let d = Diagnostic::error("wrong-arity", place, said);
            let asked = self.as_asked(definer, name);
            self.report(match asked {
                Some(hint) => d.hint(hint),
                None => d,
            });
            return None;
        }
        let arguments = self.bound(scope, word.text(), &wanted, args)?;
        Some((arguments, self.message_kind(definer, name).for_receiver(receiver, self.object)))
    }

    /// Binds arguments by label or position, their kinds checked.
    fn bound(
        &mut self,
        scope: &Scope,
        what: &str,
        wanted: &[Wanted],
        args: Vec<Arg>,
    ) -> Option<Vec<Argument>> {
        let mut taken = vec![false; wanted.len()];
        let mut bound = Vec::new();
        for (position, arg) in args.into_iter().enumerate() {
            let place = match &arg.label {
                Some(label) => wanted.iter().position(|w| w.labels.contains(&label.name())),
                None => Some(position),
            };
            let Some(place) = place else {
                let label = arg.label.as_ref()?;
                let message = format!("{what} has no {}", label.text());
                let at = Place { file: scope.file, span: label.span() };
                let mut d = Diagnostic::error("unknown-part", at, message);
                let labels: Vec<&str> = wanted.iter().map(|w| w.labels[0].as_str()).collect();
                d = match nearest(label.text(), labels.iter().copied()) {
                    Some(near) => d.meant(near),
                    None => {
                        let labels: Vec<String> =
                            labels.iter().map(|l| format!("`{l}: …`")).collect();
                        d.hint(format!("what it takes is {}", labels.join(", ")))
                    }
                };
                self.report(d);
                return None;
            };
            let Wanted { labels, class, kind } = wanted.get(place)?;
            if std::mem::replace(&mut taken[place], true) {
                let message = format!("{} is given twice", labels[0]);
                self.error("wrong-arity", scope.file, arg.expr.span(), message);
                return None;
            }
            if !arg.kind.fits(kind, &self.document) && !self.is_set_for(&arg.kind, kind) {
                let (found, wanted) = (arg.kind.words(&self.document), kind.words(&self.document));
                let message = format!("{} is {found}, wanted {wanted}", labels[0]);
                let place = Place { file: scope.file, span: arg.expr.span() };
                let d = Diagnostic::error(code_for(&arg.kind, kind), place, message);
                let is_plain = arg.kind == Kind::PLAIN && *kind == Kind::LENGTH;
                self.report(match is_plain {
                    true => d.hint(self.plain_for_length(&arg.expr)),
                    false => d,
                });
                return None;
            }
            if let Some(class) = *class {
                if self.is_fraction(scope, &labels[0], class, &arg.expr) {
                    return None;
                }
                let written = |degrees: &str| format!("`{}: {degrees}`", labels[0]);
                self.warn_of_bare_degrees(scope, class, &arg.expr, &written);
            }
            self.refer_by_position(scope.file, &arg.expr, kind);
            let value = measured(&self.document, arg.value, &arg.kind, kind);
            // what a rule asks is opened by what its arguments are
            let value = made(&self.document, value, kind);
            bound.push(Argument { label: arg.label.map(|w| w.name()), value });
        }
        Some(bound)
    }

    /// Checks a message that the language itself knows.
    fn own_message<F>(
        &mut self,
        scope: &Scope,
        table: &'static [builtin::Builtin<F>],
        receiver: &Kind,
        word: &ast::Word,
        args: Vec<Arg>,
    ) -> Option<(Vec<Argument>, Kind)> {
        let Some(b) = builtin::find(table, word.text()) else {
            self.unknown_part(scope, receiver, word);
            return None;
        };
        if !receiver.is(b.receiver, receiver, &self.document) {
            let wanted = wanted_in_words(b.receiver, receiver, &self.document);
            let found = receiver.words(&self.document);
            let message = format!("{} is sent to {found}, wanted {wanted}", b.name);
            let code = code_for(receiver, &Kind::PLAIN);
            let place = Place { file: scope.file, span: word.span() };
            let d = Diagnostic::error(code, place, message);
            let d = with_plain_hint(d, b.receiver, receiver, "x");
            let d = self.with_list_hint(d, word, receiver);
            self.report(d);
            return None;
        }
        self.own_arguments(scope, b, word.span(), Some(receiver.clone()), args)
    }

    /// Checks the arguments of a function or message of the language.
    fn own_arguments<F>(
        &mut self,
        scope: &Scope,
        b: &'static builtin::Builtin<F>,
        span: Span,
        receiver: Option<Kind>,
        args: Vec<Arg>,
    ) -> Option<(Vec<Argument>, Kind)> {
        let labels: Vec<&str> = b.parameters.iter().map(|p| p.label).collect();
        if !b.takes(args.len()) {
            let takes = labels.join(", ");
            let message = format!("{} takes ({takes}), here are {}", b.name, args.len());
            self.error("wrong-arity", scope.file, span, message);
            return None;
        }
        self.have_places(scope, (b, span), &args)?;
        let (count, mut first) = (args.len(), receiver);
        let mut answers = match &first {
            Some(Kind::List(each)) if b.name == "neighbours" => pair(each, each),
            _ => Kind::Unknown,
        };
        let mut bound = Vec::new();
        for (position, arg) in args.into_iter().enumerate() {
            let place = match &arg.label {
                Some(label) => b.parameters.iter().position(|p| p.label == label.text()),
                None => Some(position.min(b.parameters.len().saturating_sub(1))),
            };
            let Some(parameter) = place.and_then(|i| b.parameters.get(i)) else {
                let label = arg.label.as_ref()?;
                let message = format!("{} has no {}", b.name, label.text());
                let at = Place { file: scope.file, span: label.span() };
                let hint = format!("it takes {}", labels.join(", "));
                self.report(Diagnostic::error("unknown-part", at, message).hint(hint));
                return None;
            };
            let known = first.clone().unwrap_or(Kind::Unknown);
            let alike = if let Kind::List(element) = &known { element } else { &known };
            if !arg.kind.is(parameter.kind, alike, &self.document) {
                let wanted = wanted_in_words(parameter.kind, alike, &self.document);
                let found = arg.kind.words(&self.document);
                let message = format!("{} wants {wanted}, here is {found}", b.name);
                let code = code_for(&arg.kind, &wanted_number(parameter.kind));
                let place = Place { file: scope.file, span: arg.expr.span() };
                let d = Diagnostic::error(code, place, message);
                let written = arg.expr.syntax().text().to_string();
                let d = match parameter.kind {
                    Builtin::Alike => d.hint(ONE_KIND),
                    _ => with_plain_hint(d, parameter.kind, &arg.kind, &written),
                };
                self.report(d);
                return None;
            }
            self.fits_call(scope, b.name, (parameter.kind, count), &arg)?;
            let value = match parameter.kind {
                Builtin::Same | Builtin::Numbers => {
                    measured(&self.document, arg.value, &arg.kind, alike)
                }
                _ => arg.value,
            };
            bound.push(Argument { label: arg.label.map(|w| w.name()), value });
            if b.result == Builtin::Root {
                self.warn_of_uneven_root(scope, &arg.expr, (&arg.kind, 0.5));
            }
            answers = match (&arg.kind, parameter.kind) {
                (Kind::List(other), Builtin::Beside) => pair(alike, other),
                _ => arg.answers,
            };
            first = Some(first.map_or(arg.kind.clone(), |known| known.joined(arg.kind)));
        }
        let first = first.unwrap_or(Kind::Unknown);
        let is_list_message = matches!(
            b.receiver,
            Builtin::List | Builtin::Plains | Builtin::Texts | Builtin::Measures | Builtin::Ordered
        );
        let element =
            if let Kind::List(element) = &first { (**element).clone() } else { first.clone() };
        let kind = match (b.result, answers) {
            // what a list is mapped to; bare numbers may measure whatever is wanted
            (Builtin::List, Kind::Number(None)) => Kind::List(Box::new(Kind::Unknown)),
            (Builtin::List, answers) => Kind::List(Box::new(answers)),
            _ => self.builtin_kind(b.result, if is_list_message { &first } else { &element }),
        };
        Some((bound, kind))
    }

    pub(crate) fn builtin_kind(&self, result: Builtin, first: &Kind) -> Kind {
        match result {
            Builtin::Plain => Kind::PLAIN,
            Builtin::Number => Kind::Unknown,
            // the measures of a text are lengths
            Builtin::Same if matches!(first, Kind::Text | Kind::Color) => Kind::LENGTH,
            // some of the elements, in another order
            Builtin::Same if matches!(first, Kind::Tuple(_)) => Kind::List(Box::new(Kind::Unknown)),
            Builtin::Same | Builtin::Numbers => first.clone(),
            Builtin::Root => match first {
                Kind::Number(Some(d)) => d.root(2).map_or(Kind::Unknown, |d| Kind::Number(Some(d))),
                _ => first.clone(),
            },
            Builtin::Length => Kind::Number(Some(Dimension::LENGTH)),
            Builtin::Bool => Kind::Bool,
            Builtin::Text => Kind::Text,
            Builtin::Color => Kind::Color,
            Builtin::List
            | Builtin::Measures
            | Builtin::Ordered
            | Builtin::Alike
            | Builtin::Beside => Kind::List(Box::new(Kind::Unknown)),
            Builtin::Plains => Kind::List(Box::new(Kind::PLAIN)),
            Builtin::Texts => Kind::List(Box::new(Kind::Text)),
            Builtin::Element => match first {
                Kind::List(element) => (**element).clone(),
                _ => Kind::Unknown,
            },
            Builtin::Function | Builtin::Test => Kind::Function,
            Builtin::Picture | Builtin::Pictures => Kind::Picture,
            Builtin::Place | Builtin::Answer | Builtin::Any => Kind::Unknown,
        }
    }

    fn arguments(
        &mut self,
        scope: &Scope,
        args: Option<ast::ArgList>,
        element: &Kind,
    ) -> Option<Vec<Arg>> {
        let mut arguments = Vec::new();
        for arg in args.into_iter().flat_map(|a| a.args()) {
            let e = arg.value()?;
            let (value, kind, answers) = match &e {
                Expr::Lambda(lambda) => {
                    let (value, answers) = self.lambda(scope, lambda, element)?;
                    (value, Kind::Function, answers)
                }
                // which parameter it is for is not known yet
                Expr::List(list) => {
                    let (value, kind) = self.list_of(scope, list, &Kind::Unknown, Holds::Sets)?;
                    (value, kind, Kind::Unknown)
                }
                other => {
                    let (value, kind) = self.expr(scope, other)?;
                    (value, kind, Kind::Unknown)
                }
            };
            arguments.push(Arg { label: arg.label(), value, kind, answers, expr: e });
        }
        Some(arguments)
    }

    /// Lowers `f(…)`: a constructor, a message to `Me`, or a function of the language.
    pub(crate) fn call(&mut self, scope: &Scope, call: &ast::CallExpr) -> Option<(Term, Kind)> {
        let word = call.name()?;
        let name = word.name();
        // `moved(by: way)` is what every thing answers; of a place it is a task of a lesson
        let labelled =
            call.args().and_then(|a| a.args().next()).is_some_and(|a| a.label().is_some());
        if word.text() == "der" && !labelled {
            let place = Place { file: scope.file, span: call.span() };
            let d = Diagnostic::error("not-yet", place, "`der(…)` is not supported yet");
            self.report(d.hint(STEPS_OF_TIME));
            return None;
        }
        if word.text() == "plot"
            && !labelled
            && self.find_message(scope.class(), &name, None).is_none()
        {
            let place = Place { file: scope.file, span: call.span() };
            let d = Diagnostic::error("not-a-view", place, "a plot is a view, and no value");
            let hint =
                "write `view \"Force\" => plot(force, over: length, from: 0, to: 100)` in a class";
            self.report(d.hint(hint));
            return None;
        }
        if matches!(word.text(), "moved" | "all" | "plot") && !labelled {
            self.not_yet(scope.file, call.span(), &format!("`{name}(…)` is"));
            return None;
        }
        let args = self.arguments(scope, call.args(), &Kind::Unknown)?;
        if let Some(class) = self.class_meant(scope.file, &word)? {
            return self.constructor(scope, &word, class, args);
        }
        for (class, me) in owners(scope) {
            // `picture => picture(a, b)`: what takes no arguments leaves the name to the function, as does
            // `picture => picture()`, where that takes none as well
            let count = args.len();
            let is_asked = builtin::find(builtin::FUNCTIONS, &name).is_some_and(|b| b.takes(count));
            if (is_asked || count > 0) && !self.takes_arguments(class, &name) {
                break;
            }
            if self.kind_of_part(class, &name).is_some() {
                let receiver = Kind::Thing(class);
                let (arguments, kind) = self.message(scope, &receiver, &word, args, &Term::Me)?;
                return Some((
                    Term::Send { to: Box::new(me), name, arguments, search: None },
                    kind,
                ));
            }
        }
        let Some(b) = builtin::find(builtin::FUNCTIONS, &name) else {
            let Some(b) = builtin::find(builtin::THING_MESSAGES, &name) else {
                match asked_of_first(self, &word, &args) {
                    Some(said) => {
                        let message = format!("there is no function {}", word.text());
                        let at = Place { file: scope.file, span: call.span() };
                        self.report(
                            Diagnostic::error("unknown-name", at, message)
                                .hint(format!("it is asked of a thing: `{said}`"))
                                .fix(format!("write {said}"), [(at, said)]),
                        );
                    }
                    None => self.unknown_name(scope, &word),
                }
                return None;
            };
            let (arguments, kind) = self.own_arguments(scope, b, call.span(), None, args)?;
            let to = Box::new(Term::Me);
            return Some((Term::Send { to, name, arguments, search: None }, kind));
        };
        self.warn_of_degrees(scope, call);
        let (arguments, kind) = self.own_arguments(scope, b, call.span(), None, args)?;
        Some((Term::Call { name, arguments }, kind))
    }

    /// Returns false if a name is one of the language's functions and of a part or plain message.
    fn takes_arguments(&self, class: ClassId, name: &Name) -> bool {
        let message = self.find_message(class, name, None);
        let plain = message.is_none_or(|(_, m)| m.parameters.is_empty());
        !(plain && builtin::find(builtin::FUNCTIONS, name).is_some())
    }

    fn constructor(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
        class: ClassId,
        args: Vec<Arg>,
    ) -> Option<(Term, Kind)> {
        // a program that hands do not place is there to be called
        if self.document.classes[class].is_abstract && !self.is_program(class) {
            let message = format!("{} is abstract: it has no things of its own", word.text());
            let place = Place { file: scope.file, span: word.span() };
            let d = Diagnostic::error("abstract-part", place, message);
            self.report(d.hint(instead_of_abstract(&self.document, class)));
            return None;
        }
        let names = self.field_names(class);
        let given = args.iter().enumerate().filter_map(|(i, arg)| {
            let name = arg.label.as_ref().map(ast::Word::name).or(names.get(i).cloned())?;
            Some((name, arg.expr.clone()))
        });
        let given: Vec<(Name, Expr)> = given.collect();
        let class = self.class_constructed(scope, class, &given)?;
        let document = &self.document;
        let fields = document.layout(class).into_iter().map(|f| {
            let name = document.field_name(f).clone();
            let class = document.field_class(f);
            let kind = Kind::of_class(document, class);
            Wanted { labels: [name.clone(), name], class: Some(class), kind }
        });
        let fields: Vec<Wanted> = fields.collect();
        if args.len() > fields.len() {
            let n = fields.len();
            let what = with_article(word.text());
            let message = format!("{what} has {n} parts, here are {}", args.len());
            self.error("wrong-arity", scope.file, word.span(), message);
            return None;
        }
        for (arg, field) in args.iter().zip(&fields) {
            let name = arg.label.as_ref().map_or(field.labels[0].clone(), ast::Word::name);
            self.refer_position(scope.file, arg.expr.span(), &name, class);
            if let Some(label) = &arg.label {
                self.refer(Place { file: scope.file, span: label.span() }, &name, class);
            }
        }
        for (name, value) in &given {
            self.has_elements(scope, (class, word), name, value)?;
        }
        let what = with_article(word.text());
        let arguments = self.bound(scope, &what, &fields, args)?;
        Some((Term::Make { class, arguments }, Kind::of_class(&self.document, class)))
    }
}

impl Lowerer<'_> {
    /// Reports a list that is written out for a part of a new thing, and has not as many elements as such a thing.
    fn has_elements(
        &mut self,
        scope: &Scope,
        (class, word): (ClassId, &ast::Word),
        name: &Name,
        value: &Expr,
    ) -> Option<()> {
        let Expr::List(list) = value else { return Some(()) };
        let (has, given) = (self.count_of_part(class, name), list.elements().count());
        let Some(has) = has.filter(|&has| has as usize != given) else { return Some(()) };
        let what = with_article(word.text());
        let message = format!("{name} of {what} has {has} elements, and is given {given}");
        self.error("value-of-wrong-class", scope.file, value.span(), message);
        None
    }

    /// Returns the names of what things of a class are made of, in order.
    pub(crate) fn field_names(&self, class: ClassId) -> Vec<Name> {
        let fields = self.document.layout(class).into_iter();
        fields.map(|f| self.document.field_name(f).clone()).collect()
    }
}

/// Returns how far out a term leads: twice for `owner.owner`.
fn owners_in(term: &Term) -> usize {
    match term {
        Term::Owner => 1,
        Term::Send { to, name, arguments, .. } if *name == *"owner" && arguments.is_empty() => {
            match owners_in(to) {
                0 => 0,
                n => n + 1,
            }
        }
        _ => 0,
    }
}

/// Returns how what stands as a function's first argument is asked instead, `a.distance(to: b)` of
/// `distance(a, b)`; None where it knows no such part or message.
fn asked_of_first(lowerer: &Lowerer<'_>, word: &ast::Word, args: &[Arg]) -> Option<String> {
    let (first, rest) = args.split_first()?;
    let labels: Vec<&str> = match &first.kind {
        Kind::Thing(class) => match lowerer.find_message(*class, &word.name(), None) {
            // of three things the first need not be the one that is asked: `angle(a, b, c)`
            Some((_, message)) if message.parameters.len() > 1 => return None,
            Some((_, message)) => message.parameters.iter().map(|p| p.label.as_str()).collect(),
            None => lowerer.class_of_part(*class, &word.name()).map(|_| Vec::new())?,
        },
        Kind::List(_) => labels_of(builtin::LIST_MESSAGES, word)?,
        Kind::Text | Kind::Color => labels_of(builtin::TEXT_MESSAGES, word)?,
        Kind::Number(_) => labels_of(builtin::NUMBER_MESSAGES, word)?,
        Kind::Picture => labels_of(builtin::PICTURE_MESSAGES, word)?,
        Kind::Bool | Kind::Option(_) | Kind::Function | Kind::Tuple(_) | Kind::Unknown => {
            return None;
        }
    };
    let text = |arg: &Arg| arg.expr.syntax().to_string().trim().to_string();
    let stands_alone = matches!(
        first.expr,
        Expr::Name(_) | Expr::Field(_) | Expr::Index(_) | Expr::Call(_) | Expr::Paren(_)
    );
    let receiver = if stands_alone { text(first) } else { format!("({})", text(first)) };
    let argument = |(arg, label): (&Arg, &&str)| match label {
        &"" => text(arg),
        label => format!("{label}: {}", text(arg)),
    };
    let arguments: Vec<String> = rest.iter().zip(&labels).map(argument).collect();
    match (rest.len() == labels.len(), arguments.is_empty()) {
        (false, _) => None,
        (true, true) => Some(format!("{receiver}.{}", word.text())),
        (true, false) => Some(format!("{receiver}.{}({})", word.text(), arguments.join(", "))),
    }
}

/// The language's own messages are written without labels.
fn labels_of<F>(
    table: &'static [builtin::Builtin<F>],
    word: &ast::Word,
) -> Option<Vec<&'static str>> {
    builtin::find(table, word.text()).map(|b| vec![""; b.parameters.len()])
}

fn unchecked(args: Vec<Arg>) -> Vec<Argument> {
    let plain = |a: Arg| Argument { label: a.label.map(|w| w.name()), value: a.value };
    args.into_iter().map(plain).collect()
}

/// Says how a plain number is made of one that measures something.
#[cold]
#[inline(never)]
fn with_plain_hint(d: Diagnostic, wanted: Builtin, found: &Kind, written: &str) -> Diagnostic {
    let Kind::Number(Some(dimension)) = found else { return d };
    match expr::units::preferred(*dimension).or((*dimension == Dimension::LENGTH).then_some("m")) {
        Some(unit) if wanted == Builtin::Plain && !dimension.is_none() => {
            d.hint(format!("divide by a unit first: `{written} / 1 {unit}`"))
        }
        _ => d,
    }
}
