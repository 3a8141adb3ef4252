//! Terms: expressions resolved and checked. In: the tree of an expression and its scope. Out: the
//! kernel's term and what it is worth; nothing where it is wrong, which is reported at its place.

use crate::kinds::Kind;
use crate::lower::Lowerer;
use crate::scope::Scope;
use base::{Diagnostic, Name, Place, Span};
use expr::dimension::Dimension;
use kernel::builtin::{self, Kind as Builtin};
use kernel::{
    Argument, BinaryOperator, ClassId, ClassKind, Document, Path, Step, Term, UnaryOperator,
};
use syntax::ast::{self, AstNode, BinaryOp, Expr, UnaryOp};

type Lowered = Option<(Term, Kind)>;

impl Lowerer<'_> {
    /// Lowers an expression.
    pub(crate) fn expr(&mut self, scope: &Scope, e: &Expr) -> Lowered {
        match e {
            Expr::Number(n) => self.number(scope, n),
            Expr::Text(t) => Some((Term::Text(t.text()?.unquoted()), Kind::Text)),
            Expr::Bool(b) => Some((Term::Bool(b.value()), Kind::Bool)),
            Expr::Paren(inner) => self.expr(scope, &inner.inner()?),
            Expr::Name(n) => self.name(scope, &n.name()?),
            Expr::Owner(_) => {
                let kind = scope.classes.get(1).map_or(Kind::Unknown, |&c| Kind::Thing(c));
                Some((Term::Owner, kind))
            }
            Expr::Super(s) => {
                let message = "`super` is followed by a message: `super.picture`".to_string();
                self.error("unknown-name", scope.file, s.span(), message);
                None
            }
            Expr::Field(field) => self.field(scope, field),
            Expr::Call(call) => self.call(scope, call),
            Expr::Lambda(lambda) => {
                let names: Vec<Name> = lambda.params().map(|w| w.name()).collect();
                let inner =
                    names.iter().fold(scope.clone(), |s, n| s.with_local(n.clone(), Kind::Unknown));
                let (body, _) = self.expr(&inner, &lambda.body()?)?;
                Some((Term::Lambda(names, Box::new(body)), Kind::Function))
            }
            Expr::Index(index) => {
                let (of, kind) = self.expr(scope, &index.receiver()?)?;
                let (at, _) = self.expr(scope, &index.index()?)?;
                let kind = if let Kind::List(element) = kind { *element } else { Kind::Unknown };
                Some((Term::Index(Box::new(of), Box::new(at)), kind))
            }
            Expr::Unary(unary) => self.unary(scope, unary),
            Expr::Binary(binary) => {
                let op = binary.op()?;
                let (left, right) = (binary.left()?, binary.right()?);
                let (a, b) = (self.expr(scope, &left), self.expr(scope, &right));
                self.combine(scope, op, e.span(), a?, b?)
            }
            Expr::Chain(chain) => self.chain(scope, chain),
            Expr::Range(range) => {
                let (a, _) = self.expr(scope, &range.start()?)?;
                let (b, _) = self.expr(scope, &range.end()?)?;
                let kind = Kind::List(Box::new(Kind::PLAIN));
                Some((Term::Range(Box::new(a), Box::new(b)), kind))
            }
            Expr::If(choice) => {
                let (c, _) = self.expr(scope, &choice.condition()?)?;
                let (a, kind) = self.expr(scope, &choice.then_value()?)?;
                let (b, other) = self.expr(scope, &choice.else_value()?)?;
                if !other.fits(&kind) {
                    self.mismatch(scope, e.span(), &kind, &other);
                    return None;
                }
                let kind =
                    if matches!(kind, Kind::Number(None) | Kind::Unknown) { other } else { kind };
                Some((Term::If(Box::new(c), Box::new(a), Box::new(b)), kind))
            }
            Expr::Let(bindings) => {
                let mut inner = scope.clone();
                let mut bound = Vec::new();
                for binding in bindings.bindings() {
                    let (value, kind) = self.expr(&inner, &binding.value()?)?;
                    let name = binding.name()?.name();
                    inner = inner.with_local(name.clone(), kind);
                    bound.push((name, value));
                }
                let (body, kind) = self.expr(&inner, &bindings.body()?)?;
                let wrap = |body, (name, value)| Term::Let(name, Box::new(value), Box::new(body));
                Some((bound.into_iter().rev().fold(body, wrap), kind))
            }
            Expr::List(list) => {
                let mut items = Vec::new();
                let mut element = Kind::Unknown;
                for item in list.elements() {
                    let (term, kind) = self.expr(scope, &item)?;
                    if element == Kind::Unknown {
                        element = kind;
                    }
                    items.push(term);
                }
                Some((Term::List(items), Kind::List(Box::new(element))))
            }
            Expr::Tuple(tuple) => {
                let items: Option<Vec<Term>> =
                    tuple.elements().map(|i| Some(self.expr(scope, &i)?.0)).collect();
                Some((Term::Tuple(items?), Kind::Tuple))
            }
            Expr::Is(is) => {
                let (of, _) = self.expr(scope, &is.operand()?)?;
                let class = self.class_of_type(scope.file, &is.class()?)?;
                Some((Term::IsA(Box::new(of), class), Kind::Bool))
            }
            Expr::Copy(copy) => {
                self.not_yet(scope.file, copy.span(), "`copy of` is");
                None
            }
            Expr::All(all) => {
                self.not_yet(scope.file, all.span(), "`all` of a class is");
                None
            }
        }
    }

    fn number(&mut self, scope: &Scope, n: &ast::NumberExpr) -> Lowered {
        let digits = n.digits()?;
        let Some(unit) = n.unit() else {
            let value = n.value()?;
            let dimension = Dimension::NONE;
            return Some((Term::Number { value, dimension, bare: true }, Kind::Number(None)));
        };
        let Some((si, dimension)) = expr::units::read_quantity(digits.text(), unit.text()) else {
            let message = format!("{} is no unit that is known here", unit.text());
            self.error("unknown-unit", scope.file, unit.span(), message);
            return None;
        };
        let value = crate::numbers::from_si(&self.document, si, dimension);
        Some((Term::Number { value, dimension, bare: false }, Kind::Number(Some(dimension))))
    }

    /// Resolves a bare name.
    fn name(&mut self, scope: &Scope, word: &ast::Word) -> Lowered {
        let name = word.name();
        if let Some(kind) = scope.local(&name) {
            return Some((Term::Local(name), kind.clone()));
        }
        if let Some(&i) = scope.constants.get(&name) {
            return Some((Term::number(i as f64), Kind::Number(None)));
        }
        let mut me = Term::Me;
        for &class in &scope.classes.clone() {
            if let Some(kind) = self.kind_of_part(class, &name) {
                return Some((Term::send(me, &name), kind));
            }
            me = if me == Term::Me { Term::Owner } else { Term::send(me, "owner") };
        }
        if let Some(b) = builtin::find(builtin::THING_MESSAGES, &name) {
            let kind = self.builtin_kind(b.result, &Kind::Unknown);
            return Some((Term::send(Term::Me, &name), kind));
        }
        self.unknown_name(scope, word);
        None
    }

    fn unknown_name(&mut self, scope: &Scope, word: &ast::Word) {
        let mut names: Vec<String> = scope.locals.iter().map(|(n, _)| n.to_string()).collect();
        for &class in &scope.classes {
            names.extend(self.names_of(class));
        }
        names.extend(builtin::FUNCTIONS.iter().map(|b| b.name.to_string()));
        let message = format!("there is nothing called {} here", word.text());
        let place = Place { file: scope.file, span: word.span() };
        let mut d = Diagnostic::error("unknown-name", place, message);
        if let Some(near) = base::diagnostic::nearest(word.text(), names.iter().map(String::as_str))
        {
            d = d.hint(format!("did you mean `{near}`?"));
        }
        self.report(d);
    }

    /// Returns the names of the parts and messages of a class.
    fn names_of(&self, class: ClassId) -> Vec<String> {
        let document = &self.document;
        let mut names: Vec<String> = Vec::new();
        for c in document.lineage(class) {
            let c = &document.classes[c];
            names.extend(c.parts.iter().map(|p| p.name.to_string()));
            names.extend(c.messages.iter().map(|m| m.name.to_string()));
        }
        names
    }

    fn class_of_part(&self, class: ClassId, name: &str) -> Option<ClassId> {
        class_of_part(&self.document, class, name)
    }

    /// Returns what the part or message of this name is worth, seen from a class.
    fn kind_of_part(&mut self, class: ClassId, name: &Name) -> Option<Kind> {
        if let Some(part) = self.class_of_part(class, name) {
            return Some(Kind::of_class(&self.document, part));
        }
        let (definer, _) = self.document.find_message(class, name, None)?;
        Some(self.message_kind(definer, name))
    }

    /// Finds out what a message is worth, once.
    fn message_kind(&mut self, definer: ClassId, name: &Name) -> Kind {
        let key = (definer, name.clone());
        if let Some(known) = self.message_kinds.get(&key) {
            return known.clone().unwrap_or(Kind::Unknown);
        }
        let Some((answer, scope)) = self.definitions.get(&key).cloned() else {
            return Kind::Unknown;
        };
        self.message_kinds.insert(key.clone(), None);
        self.silent += 1;
        let kind = self.expr(&scope, &answer).map_or(Kind::Unknown, |(_, kind)| kind);
        self.silent -= 1;
        self.message_kinds.insert(key, Some(kind.clone()));
        kind
    }

    fn field(&mut self, scope: &Scope, field: &ast::FieldExpr) -> Lowered {
        let (receiver, word) = (field.receiver()?, field.name()?);
        let name = word.name();
        let arguments = self.arguments(scope, field.args())?;
        if let Expr::Super(_) = receiver {
            let class = scope.class();
            let above = self.document.find_message(class, &name, Some(class)).map(|(c, _)| c);
            let kind = match above {
                Some(definer) => self.message_kind(definer, &name),
                None if builtin::find(builtin::THING_MESSAGES, &name).is_some() => Kind::Picture,
                None => {
                    let message = format!("no superclass has a message {name}");
                    self.error("unknown-part", scope.file, word.span(), message);
                    return None;
                }
            };
            let to = Box::new(Term::Me);
            return Some((Term::Send { to, name, arguments, above: Some(class) }, kind));
        }
        let (to, kind) = self.expr(scope, &receiver)?;
        let kind = self.answer(scope, &kind, &word, arguments.len(), &to)?;
        Some((Term::Send { to: Box::new(to), name, arguments, above: None }, kind))
    }

    /// Finds out what a receiver answers to a name; reports a name that it does not know.
    fn answer(
        &mut self,
        scope: &Scope,
        receiver: &Kind,
        word: &ast::Word,
        arguments: usize,
        to: &Term,
    ) -> Option<Kind> {
        let name = word.name();
        if name == "owner" || *receiver == Kind::Unknown || *to == Term::Owner {
            let known = match receiver {
                Kind::Thing(class) => self.kind_of_part(*class, &name),
                _ => None,
            };
            return Some(known.unwrap_or(Kind::Unknown));
        }
        let found = match receiver {
            Kind::Number(_) => self.known(builtin::NUMBER_MESSAGES, &name, receiver, arguments),
            Kind::Text => self.known(builtin::TEXT_MESSAGES, &name, receiver, arguments),
            Kind::List(_) => self.known(builtin::LIST_MESSAGES, &name, receiver, arguments),
            Kind::Picture => self.known(builtin::PICTURE_MESSAGES, &name, receiver, arguments),
            Kind::Thing(class) => match self.kind_of_part(*class, &name) {
                Some(kind) => {
                    Some(self.check_arity(scope, *class, word, arguments).then_some(kind)?)
                }
                None => self.known(builtin::THING_MESSAGES, &name, receiver, arguments),
            },
            Kind::Tuple | Kind::Bool | Kind::Function | Kind::Unknown => Some(Kind::Unknown),
        };
        if found.is_none() {
            self.unknown_part(scope, receiver, word);
        }
        found
    }

    fn known<F>(
        &self,
        table: &'static [builtin::Builtin<F>],
        name: &str,
        receiver: &Kind,
        arguments: usize,
    ) -> Option<Kind> {
        let b = builtin::find(table, name)?;
        b.takes(arguments).then(|| self.builtin_kind(b.result, receiver))
    }

    /// Returns false if a name is one of the language's functions and of a part or plain message.
    fn takes_arguments(&self, class: ClassId, name: &Name) -> bool {
        let message = self.document.find_message(class, name, None);
        let plain = message.is_none_or(|(_, m)| m.parameters.is_empty());
        !(plain && builtin::find(builtin::FUNCTIONS, name).is_some())
    }

    fn check_arity(&mut self, scope: &Scope, class: ClassId, word: &ast::Word, n: usize) -> bool {
        let Some((_, message)) = self.document.find_message(class, word.text(), None) else {
            return true;
        };
        let wanted = message.parameters.len();
        if self.class_of_part(class, word.text()).is_none() && wanted != n {
            let message = format!("{} takes {wanted} arguments, here are {n}", word.text());
            self.error("wrong-arity", scope.file, word.span(), message);
            return false;
        }
        true
    }

    fn unknown_part(&mut self, scope: &Scope, receiver: &Kind, word: &ast::Word) {
        let what = receiver.words(&self.document);
        let message = format!("{what} has no part or message {}", word.text());
        let place = Place { file: scope.file, span: word.span() };
        let mut d = Diagnostic::error("unknown-part", place, message);
        let names: Vec<String> = match receiver {
            Kind::Thing(class) => self.names_of(*class),
            Kind::Number(_) => builtin::NUMBER_MESSAGES.iter().map(|b| b.name.into()).collect(),
            Kind::Text => builtin::TEXT_MESSAGES.iter().map(|b| b.name.into()).collect(),
            Kind::List(_) => builtin::LIST_MESSAGES.iter().map(|b| b.name.into()).collect(),
            Kind::Picture => builtin::PICTURE_MESSAGES.iter().map(|b| b.name.into()).collect(),
            Kind::Bool | Kind::Tuple | Kind::Function | Kind::Unknown => Vec::new(),
        };
        d = match base::diagnostic::nearest(word.text(), names.iter().map(String::as_str)) {
            Some(near) => d.hint(format!("did you mean `{near}`?")),
            None if names.is_empty() => d,
            None => d.hint(format!("it has {}", names.join(", "))),
        };
        self.report(d);
    }

    fn builtin_kind(&self, result: Builtin, first: &Kind) -> Kind {
        match result {
            Builtin::Plain => Kind::PLAIN,
            Builtin::Number => Kind::Unknown,
            // the measures of a text are lengths
            Builtin::Same if *first == Kind::Text => Kind::Number(Some(Dimension::LENGTH)),
            Builtin::Same | Builtin::Numbers => first.clone(),
            Builtin::Root => match first {
                Kind::Number(Some(d)) => d.root(2).map_or(Kind::Unknown, |d| Kind::Number(Some(d))),
                _ => first.clone(),
            },
            Builtin::Length => Kind::Number(Some(Dimension::LENGTH)),
            Builtin::Bool => Kind::Bool,
            Builtin::Text | Builtin::Color => Kind::Text,
            Builtin::List => Kind::List(Box::new(Kind::Unknown)),
            Builtin::Element => match first {
                Kind::List(element) => (**element).clone(),
                _ => Kind::Unknown,
            },
            Builtin::Function => Kind::Function,
            Builtin::Picture => Kind::Picture,
            Builtin::Place | Builtin::Answer | Builtin::Any => Kind::Unknown,
        }
    }

    fn arguments(&mut self, scope: &Scope, args: Option<ast::ArgList>) -> Option<Vec<Argument>> {
        let mut arguments = Vec::new();
        for arg in args.into_iter().flat_map(|a| a.args()) {
            let (value, _) = self.expr(scope, &arg.value()?)?;
            arguments.push(Argument { label: arg.label().map(|w| w.name()), value });
        }
        Some(arguments)
    }

    /// Lowers `f(…)`: a constructor, a message to `Me`, or a function of the language.
    fn call(&mut self, scope: &Scope, call: &ast::CallExpr) -> Lowered {
        let word = call.name()?;
        let name = word.name();
        if matches!(word.text(), "der" | "moved" | "all" | "plot") {
            self.not_yet(scope.file, call.span(), &format!("`{name}(…)` is"));
            return None;
        }
        let args: Vec<ast::Arg> = call.args().into_iter().flat_map(|a| a.args()).collect();
        let mut kinds = Vec::new();
        let mut arguments = Vec::new();
        for arg in &args {
            let (value, kind) = self.expr(scope, &arg.value()?)?;
            kinds.push(kind);
            arguments.push(Argument { label: arg.label().map(|w| w.name()), value });
        }
        if let Some(&class) = self.names.get(&name) {
            return self.constructor(scope, &word, class, arguments);
        }
        let mut me = Term::Me;
        for &class in &scope.classes.clone() {
            // `picture => picture(a, b)`: what takes no arguments leaves the name to the function
            if !arguments.is_empty() && !self.takes_arguments(class, &name) {
                break;
            }
            if let Some(kind) = self.kind_of_part(class, &name) {
                if !self.check_arity(scope, class, &word, arguments.len()) {
                    return None;
                }
                return Some((Term::Send { to: Box::new(me), name, arguments, above: None }, kind));
            }
            me = if me == Term::Me { Term::Owner } else { Term::send(me, "owner") };
        }
        let Some(b) = builtin::find(builtin::FUNCTIONS, &name) else {
            self.unknown_name(scope, &word);
            return None;
        };
        if !b.takes(arguments.len()) {
            let labels: Vec<&str> = b.parameters.iter().map(|p| p.label).collect();
            let message = format!(
                "{name} takes ({}), here are {} arguments",
                labels.join(", "),
                arguments.len()
            );
            self.error("wrong-arity", scope.file, call.span(), message);
            return None;
        }
        let first = kinds.first().cloned().unwrap_or(Kind::Unknown);
        let first = if let Kind::List(element) = first { *element } else { first };
        let kind = self.builtin_kind(b.result, &first);
        Some((Term::Call { name, arguments }, kind))
    }

    fn constructor(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
        class: ClassId,
        arguments: Vec<Argument>,
    ) -> Lowered {
        let fields = self.document.layout(class);
        if arguments.len() > fields.len() {
            let message = format!(
                "a {} has {} parts, here are {}",
                word.text(),
                fields.len(),
                arguments.len()
            );
            self.error("wrong-arity", scope.file, word.span(), message);
            return None;
        }
        for argument in &arguments {
            let Some(label) = &argument.label else { continue };
            if self.class_of_part(class, label).is_none() {
                let message = format!("a {} has no part {label}", word.text());
                self.error("unknown-part", scope.file, word.span(), message);
                return None;
            }
        }
        Some((Term::Make { class, arguments }, Kind::of_class(&self.document, class)))
    }

    fn unary(&mut self, scope: &Scope, unary: &ast::UnaryExpr) -> Lowered {
        let (operand, kind) = self.expr(scope, &unary.operand()?)?;
        match unary.op()? {
            UnaryOp::Plus => Some((operand, kind)),
            UnaryOp::Negate => match operand {
                Term::Number { value, dimension, bare } => {
                    Some((Term::Number { value: -value, dimension, bare }, kind))
                }
                other => Some((Term::Unary(UnaryOperator::Negate, Box::new(other)), kind)),
            },
            UnaryOp::Not => Some((Term::Unary(UnaryOperator::Not, Box::new(operand)), Kind::Bool)),
        }
    }

    fn chain(&mut self, scope: &Scope, chain: &ast::ChainExpr) -> Lowered {
        let mut terms = Vec::new();
        for operand in chain.operands() {
            terms.push((self.expr(scope, &operand)?, operand.span()));
        }
        let mut all: Option<Term> = None;
        for ((op, _), pair) in chain.ops().zip(terms.windows(2)) {
            let [(a, from), (b, to)] = pair else { continue };
            let (link, _) = self.combine(scope, op, from.join(*to), a.clone(), b.clone())?;
            all = Some(match all {
                None => link,
                Some(before) => Term::Binary(BinaryOperator::And, Box::new(before), Box::new(link)),
            });
        }
        Some((all?, Kind::Bool))
    }

    fn mismatch(&mut self, scope: &Scope, span: Span, left: &Kind, right: &Kind) {
        let message = format!(
            "left is {}, right is {}",
            left.words(&self.document),
            right.words(&self.document)
        );
        let numbers = matches!((left, right), (Kind::Number(_), Kind::Number(_)));
        let code = if numbers { "dimension-mismatch" } else { "value-of-wrong-class" };
        self.error(code, scope.file, span, message);
    }

    /// Joins two operands, their dimensions checked.
    fn combine(
        &mut self,
        scope: &Scope,
        op: BinaryOp,
        span: Span,
        (a, ka): (Term, Kind),
        (b, kb): (Term, Kind),
    ) -> Lowered {
        let operator = match op {
            BinaryOp::Or => BinaryOperator::Or,
            BinaryOp::And => BinaryOperator::And,
            BinaryOp::Equal => BinaryOperator::Equal,
            BinaryOp::NotEqual => BinaryOperator::NotEqual,
            BinaryOp::Less => BinaryOperator::Less,
            BinaryOp::LessEqual => BinaryOperator::LessEqual,
            BinaryOp::Greater => BinaryOperator::Greater,
            BinaryOp::GreaterEqual => BinaryOperator::GreaterEqual,
            BinaryOp::In => BinaryOperator::In,
            BinaryOp::Add => BinaryOperator::Add,
            BinaryOp::Subtract => BinaryOperator::Subtract,
            BinaryOp::Multiply => BinaryOperator::Multiply,
            BinaryOp::Divide => BinaryOperator::Divide,
            BinaryOp::Power => BinaryOperator::Power,
            BinaryOp::Subset | BinaryOp::Union => {
                self.not_yet(scope.file, span, "`subset` and `union` are");
                return None;
            }
        };
        let kind = match op {
            BinaryOp::Add | BinaryOp::Subtract => {
                if !ka.fits(&kb) {
                    self.mismatch(scope, span, &ka, &kb);
                    return None;
                }
                match ka {
                    Kind::Number(None) | Kind::Unknown => kb,
                    known => known,
                }
            }
            BinaryOp::Multiply => self.product(&ka, &kb, Dimension::times),
            BinaryOp::Divide => self.product(&ka, &kb, Dimension::over),
            BinaryOp::Power => power(&ka, &b),
            BinaryOp::Equal
            | BinaryOp::NotEqual
            | BinaryOp::Less
            | BinaryOp::LessEqual
            | BinaryOp::Greater
            | BinaryOp::GreaterEqual => {
                if !ka.fits(&kb) {
                    self.mismatch(scope, span, &ka, &kb);
                    return None;
                }
                Kind::Bool
            }
            BinaryOp::And | BinaryOp::Or | BinaryOp::In | BinaryOp::Subset | BinaryOp::Union => {
                Kind::Bool
            }
        };
        Some((Term::Binary(operator, Box::new(a), Box::new(b)), kind))
    }

    fn product(&self, a: &Kind, b: &Kind, join: fn(Dimension, Dimension) -> Dimension) -> Kind {
        let dimension = |k: &Kind| match k {
            Kind::Number(d) => Some(d.unwrap_or(Dimension::NONE)),
            _ => None,
        };
        match (a, b) {
            (Kind::Number(None), Kind::Number(None)) => Kind::Number(None),
            _ => match (dimension(a), dimension(b)) {
                (Some(a), Some(b)) => Kind::Number(Some(join(a, b))),
                _ => Kind::Unknown,
            },
        }
    }

    /// Lowers a path to a stored part, and finds the class of what it leads to, if that is known.
    pub(crate) fn path(&mut self, scope: &Scope, e: &Expr) -> Option<(Path, Option<ClassId>)> {
        match e {
            Expr::Paren(inner) => self.path(scope, &inner.inner()?),
            Expr::Owner(_) => Some((Path(vec![Step::Owner]), scope.classes.get(1).copied())),
            Expr::Name(name) => {
                let word = name.name()?;
                let mut path = Path::default();
                for &class in &scope.classes {
                    if let Some(part) = self.class_of_part(class, word.text()) {
                        return Some((path.then(Step::Part(word.name())), Some(part)));
                    }
                    path = path.then(Step::Owner);
                }
                let class = scope.class();
                if self.document.find_message(class, word.text(), None).is_some() {
                    return self.refuse_virtual(scope, &word);
                }
                self.unknown_name(scope, &word);
                None
            }
            Expr::Field(field) if field.args().is_none() => {
                let (path, class) = self.path(scope, &field.receiver()?)?;
                let word = field.name()?;
                let is_list = |c: ClassId| match self.document.classes[c].kind {
                    ClassKind::List(element) => Some(element),
                    _ => None,
                };
                if word.text() == "last" {
                    if let Some(element) = class.and_then(is_list) {
                        return Some((path.then(Step::Last), Some(element)));
                    }
                }
                if word.text() == "owner" {
                    return Some((path.then(Step::Owner), None));
                }
                let Some(class) = class else {
                    return Some((path.then(Step::Part(word.name())), None));
                };
                match self.class_of_part(class, word.text()) {
                    Some(part) => Some((path.then(Step::Part(word.name())), Some(part))),
                    None if self.document.find_message(class, word.text(), None).is_some() => {
                        self.refuse_virtual(scope, &word)
                    }
                    None => {
                        self.unknown_part(scope, &Kind::of_class(&self.document, class), &word);
                        None
                    }
                }
            }
            Expr::Index(index) => {
                let (path, class) = self.path(scope, &index.receiver()?)?;
                let at = index.index()?;
                let Some(i) = self.constant(scope, &at).and_then(|i| u32::try_from(i).ok()) else {
                    let message = "an index in a path is a whole number, from 0".to_string();
                    self.error("index", scope.file, at.span(), message);
                    return None;
                };
                let element = class.and_then(|c| match self.document.classes[c].kind {
                    ClassKind::List(element) => Some(element),
                    _ => None,
                });
                Some((path.then(Step::Index(i)), element))
            }
            other => {
                let message = "a path of parts is wanted: `a.b.c`".to_string();
                self.error("not-a-path", scope.file, other.span(), message);
                None
            }
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

    pub(crate) fn class_at(&self, class: ClassId, path: &Path) -> Option<ClassId> {
        class_at(&self.document, class, path)
    }
}

/// Returns the class of the part of this name, seen from a class.
pub(crate) fn class_of_part(document: &Document, class: ClassId, name: &str) -> Option<ClassId> {
    let layout = document.layout(class);
    if let Some(&field) = layout.iter().find(|&&f| *document.field_name(f) == *name) {
        return Some(document.field_class(field));
    }
    let supers = &document.classes[class].supers;
    if let Some(first) = supers.first().filter(|s| supers.len() > 1 && s.name == *name) {
        return Some(first.class);
    }
    let others = layout.iter().filter(|f| f.role == kernel::PartRole::Superclass);
    others.map(|&f| document.field_class(f)).find_map(|c| class_of_part(document, c, name))
}

/// Returns the class of what a path leads to, if that is known.
pub(crate) fn class_at(document: &Document, class: ClassId, path: &Path) -> Option<ClassId> {
    path.0.iter().try_fold(class, |class, step| match step {
        Step::Part(name) => class_of_part(document, class, name),
        Step::Index(_) | Step::Last => match document.classes[class].kind {
            ClassKind::List(element) => Some(element),
            _ => None,
        },
        Step::Owner => None,
    })
}

fn power(base: &Kind, exponent: &Term) -> Kind {
    let Kind::Number(dimension) = base else { return Kind::Unknown };
    let (Some(d), Term::Number { value, .. }) = (dimension, exponent) else { return base.clone() };
    if d.is_none() {
        return base.clone();
    }
    if value.fract() == 0.0 && value.abs() <= 20.0 {
        return Kind::Number(Some(d.power(*value as i8)));
    }
    let root = (1.0 / value).round();
    let is_root = (1.0 / root - value).abs() < 1e-12 && (2.0..=20.0).contains(&root);
    let rooted = if is_root { d.root(root as i8) } else { None };
    rooted.map_or(Kind::Unknown, |d| Kind::Number(Some(d)))
}
