//! Members: parts and messages are declared first, then everything that speaks of parts is lowered.

use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use kernel::{
    ClassId, ClassKind, Constraint, Count, Given, Insert, Merge, Message, Method, OriginId,
    Parameter, Part, Path, Stay, Step, Strength, Term,
};
use syntax::ast::{self, AstNode, Expr, Member, MethodItem, Rule, TypeShape, span_without_doc};

/// How many members a `for` may come to.
const MOST_MEMBERS: i64 = 100_000;

/// A member whose expressions are still to be lowered.
#[derive(Clone, Debug)]
pub(crate) enum Pending {
    /// Any member.
    Member(Scope, Member),
    /// A value of a part: `x = 3`, or one of a body of values.
    Value {
        scope: Scope,
        /// From `Me` to what the target speaks of.
        prefix: Vec<Step>,
        /// The path after the prefix; none for a part's own `= value`.
        target: Option<Expr>,
        value: Expr,
    },
    /// The answer of a message.
    Answer { scope: Scope, index: usize, answer: Expr },
}

impl Lowerer<'_> {
    /// Declares what a body adds to the class of its scope.
    pub(crate) fn declare_body(&mut self, scope: &Scope, members: Vec<Member>) {
        for member in members {
            let span = span_without_doc(member.syntax());
            match &member {
                Member::Part(part) => self.declare_part(scope, part),
                Member::Message(message) => self.declare_message(scope, message),
                Member::For(each) => self.unroll(scope, each),
                Member::Assign(assign) => {
                    let value = assign.value().and_then(ast::Value::expr);
                    if let (Some(target), Some(value)) = (assign.target(), value) {
                        let (scope, prefix, target) = (scope.clone(), Vec::new(), Some(target));
                        self.pending.push(Pending::Value { scope, prefix, target, value });
                    }
                }
                Member::Constraint(_)
                | Member::Merge(_)
                | Member::Stay(_)
                | Member::Anchor(_)
                | Member::Insert(_)
                | Member::Without(_)
                | Member::Attachers(_) => {
                    self.pending.push(Pending::Member(scope.clone(), member.clone()));
                }
                Member::Unit(_) | Member::Y(_) | Member::Use(_) | Member::Error(_) => {}
                Member::Class(_) | Member::Check(_) if scope.class() == self.document.root => {}
                Member::Class(_) if scope.file != OWN => {}
                Member::Check(_) if scope.file != OWN => {}
                other => self.refuse(scope.file, other, span),
            }
        }
    }

    fn refuse(&mut self, file: FileId, member: &Member, span: Span) {
        let what = match member {
            Member::Modify(_) => "`modify` is",
            Member::Replace(_) => "`replace` is",
            Member::If(_) => "members under a condition are",
            Member::When(_) => "events are",
            Member::Ref(_) => "references are",
            Member::View(_) => "views of one's own are",
            Member::Side(_) => "written orientations are",
            Member::Toolbox(_) => "toolboxes are",
            Member::Lesson(_) => "lessons are",
            Member::Program(_) => "programs are",
            Member::Family(_) => "families are",
            Member::Class(_) => "classes inside of others are",
            Member::Check(_) => "checks inside of classes are",
            _ => "this is",
        };
        let first = self.files[file].text.get(span.range()).unwrap_or_default();
        let line = first.lines().next().unwrap_or_default().trim_end().len() as u32;
        self.not_yet(file, Span::new(span.start, span.start + line), what);
    }

    fn unroll(&mut self, scope: &Scope, each: &ast::For) {
        let span = span_without_doc(each.syntax());
        let names: Vec<_> = each.names().collect();
        let Some(range) = each.range() else { return };
        let bounds = self.constant_range(scope, &range);
        let ([name], Some((from, to))) = (names.as_slice(), bounds) else {
            return self.not_yet(
                scope.file,
                range.span(),
                "`for` over anything but a range of constants is",
            );
        };
        if to.saturating_sub(from) >= MOST_MEMBERS {
            let message = format!("{from}..{to} would be more than {MOST_MEMBERS} members");
            return self.error("too-many-members", scope.file, span, message);
        }
        for i in from..=to {
            let members = each.body().into_iter().flat_map(|b| b.members()).collect();
            self.declare_body(&scope.with_constant(name.name(), i), members);
        }
    }

    fn constant_range(&mut self, scope: &Scope, range: &Expr) -> Option<(i64, i64)> {
        let Expr::Range(range) = range else { return None };
        let from = self.constant(scope, &range.start()?)?;
        Some((from, self.constant(scope, &range.end()?)?))
    }

    /// Returns the whole number that an expression of constants is.
    pub(crate) fn constant(&mut self, scope: &Scope, expr: &Expr) -> Option<i64> {
        let x =
            crate::numbers::constant(&|name| scope.constants.get(name).map(|&i| i as f64), expr)?;
        (x.fract() == 0.0 && x.abs() < 9e15).then_some(x as i64)
    }

    fn declare_part(&mut self, scope: &Scope, part: &ast::Part) {
        let Some(ty) = part.class() else { return };
        if let Some(definition) = part.definition() {
            return self.declare_virtual(scope, part, &ty, &definition);
        }
        let Some(class) = self.class_of_type(scope.file, &ty) else { return };
        let count = self.declared_count(scope, &ty);
        let range = part.domain().and_then(|d| {
            let range = self.constant_range(scope, &d);
            if range.is_none() {
                self.not_yet(scope.file, d.span(), "a domain of anything but whole numbers is");
            }
            range
        });
        if let Some(domain) = part.domain().filter(|_| range.is_some()) {
            self.not_yet(scope.file, domain.span(), "the search for whole numbers in a domain is");
        }
        for word in part.names() {
            if !self.is_new(scope, &word) {
                continue;
            }
            let span = span_without_doc(part.syntax());
            let origin = self.origin(scope.file, span);
            let name = word.name();
            let class = self.class_for_body(scope, &name, class, part.body(), origin);
            let doc = part.doc().unwrap_or_default();
            let declared = Part { name: name.clone(), doc, class, count, range, origin };
            self.document.classes[scope.class()].parts.push(declared);
            if let Some(value) = part.value().and_then(ast::Value::expr) {
                let prefix = vec![Step::Part(name)];
                let pending = Pending::Value { scope: scope.clone(), prefix, target: None, value };
                self.pending.push(pending);
            }
        }
    }

    /// Returns true if no part, message or superclass part of the class is called this.
    fn is_new(&mut self, scope: &Scope, word: &ast::Word) -> bool {
        let (class, name) = (scope.class(), word.name());
        let c = &self.document.classes[class];
        let own =
            c.parts.iter().any(|p| p.name == name) || c.messages.iter().any(|m| m.name == name);
        let layout = || self.document.layout(class);
        let inherited = layout().iter().any(|&f| *self.document.field_name(f) == name);
        if own || inherited {
            let message = format!("there is a part {name} already");
            self.error("duplicate-name", scope.file, word.span(), message);
        }
        !(own || inherited)
    }

    /// Returns the class of a part with a body: its class, or a class of one.
    fn class_for_body(
        &mut self,
        scope: &Scope,
        name: &Name,
        class: ClassId,
        body: Option<ast::Body>,
        origin: OriginId,
    ) -> ClassId {
        let Some(body) = body else { return class };
        let members: Vec<Member> = body.members().collect();
        if let Some(values) = values_alone(&members) {
            for (target, value) in values {
                let prefix = vec![Step::Part(name.clone())];
                let scope = scope.clone();
                let target = Some(target);
                self.pending.push(Pending::Value { scope, prefix, target, value });
            }
            return class;
        }
        let label = match self.document.classes[scope.class()].name.as_str() {
            "" => name.to_string(),
            owner => format!("{owner}.{name}"),
        };
        let one = self.document.classes.next_id();
        self.add_class(&label, ClassKind::Composite, &[class], origin);
        if self.names.get(label.as_str()) == Some(&one) {
            self.names.remove(label.as_str());
        }
        self.classes_of_one.insert(one);
        self.declare_body(&scope.inside(one), members);
        one
    }

    fn declare_virtual(&mut self, scope: &Scope, part: &ast::Part, ty: &ast::Type, answer: &Expr) {
        let class = self.class_of_type(scope.file, ty);
        for word in part.names() {
            let c = &self.document.classes[scope.class()];
            if c.parts.iter().any(|p| p.name == word.name())
                || c.messages.iter().any(|m| m.name == word.name())
            {
                let message = format!("there is a part {} already", word.text());
                self.error("duplicate-name", scope.file, word.span(), message);
                continue;
            }
            let doc = part.doc().unwrap_or_default();
            let origin = self.origin(scope.file, span_without_doc(part.syntax()));
            if let Some(class) = class {
                let kind = Kind::of_class(&self.document, class);
                self.message_kinds.insert((scope.class(), word.name()), Some(kind));
            }
            self.add_message(scope, word.name(), doc, Vec::new(), answer, (false, false), origin);
        }
    }

    fn declare_message(&mut self, scope: &Scope, message: &ast::Message) {
        let (Some(name), Some(answer)) = (message.name(), message.definition()) else { return };
        let c = &self.document.classes[scope.class()];
        if c.messages.iter().any(|m| m.name == name.name())
            || c.parts.iter().any(|p| p.name == name.name())
        {
            let said = format!("there is a part or message {} already", name.text());
            return self.error("duplicate-name", scope.file, name.span(), said);
        }
        let mut parameters = Vec::new();
        let mut inner = scope.clone();
        for p in message.params().into_iter().flat_map(|p| p.params()) {
            let (Some(name), Some(label)) = (p.name(), p.label()) else { continue };
            let class = p.class().and_then(|ty| self.class_of_type(scope.file, &ty));
            let kind = class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c));
            inner = inner.with_local(name.name(), kind);
            parameters.push(Parameter { label: label.name(), name: name.name(), class });
        }
        let above = self.document.find_message(scope.class(), name.text(), None);
        if let Some((_, inherited)) = above.filter(|(_, m)| m.parameters.len() != parameters.len())
        {
            let n = inherited.parameters.len();
            let said = format!(
                "{} has {n} parameters where it is inherited from, here {}",
                name.text(),
                parameters.len()
            );
            self.error("override-signature", scope.file, name.span(), said);
        }
        let origin = self.origin(scope.file, span_without_doc(message.syntax()));
        let doc = message.doc().unwrap_or_default();
        let how = (message.is_default(), message.is_combining());
        self.add_message(&inner, name.name(), doc, parameters, &answer, how, origin);
    }

    fn add_message(
        &mut self,
        scope: &Scope,
        name: Name,
        doc: String,
        parameters: Vec<Parameter>,
        answer: &Expr,
        (is_default, is_combining): (bool, bool),
        origin: OriginId,
    ) {
        let class = scope.class();
        let index = self.document.classes[class].messages.len();
        self.definitions.insert((class, name.clone()), (answer.clone(), scope.clone()));
        self.document.classes[class].messages.push(Message {
            name,
            doc,
            parameters,
            answer: Term::Me,
            is_default,
            is_combining,
            origin,
        });
        let (scope, answer) = (scope.clone(), answer.clone());
        self.pending.push(Pending::Answer { scope, index, answer });
    }

    /// Returns the class that a type names; reports what it does not find.
    pub(crate) fn class_of_type(&mut self, file: FileId, ty: &ast::Type) -> Option<ClassId> {
        match ty.shape() {
            TypeShape::Named(words) => {
                let word = words.last()?;
                let found = self.names.get(word.text()).copied();
                if found.is_none() {
                    let message = format!("there is no class {}", word.text());
                    let place = Place { file, span: word.span() };
                    let mut d = Diagnostic::error("unknown-class", place, message);
                    let names = self.names.keys().map(Name::as_str);
                    if let Some(near) = base::diagnostic::nearest(word.text(), names) {
                        d = d.hint(format!("did you mean `{near}`?"));
                    } else {
                        d = d.hint("declare it, or `use` the library that has it");
                    }
                    self.report(d);
                }
                found
            }
            TypeShape::List { element, .. } => {
                let element = self.class_of_type(file, &element?)?;
                Some(self.class_made_of("List of", ClassKind::List(element), element))
            }
            TypeShape::Set(element) => {
                let element = self.class_of_type(file, &element?)?;
                Some(self.class_made_of("Set of", ClassKind::Set(element), element))
            }
            TypeShape::Path(_) => {
                self.not_yet(file, ty.span(), "parts that name another part are");
                None
            }
            TypeShape::Placed(_) => {
                self.not_yet(file, ty.span(), "placed instances are");
                None
            }
        }
    }

    fn class_made_of(&mut self, word: &str, kind: ClassKind, element: ClassId) -> ClassId {
        let name = format!("{word} {}", self.document.classes[element].name);
        let known = self.document.classes.iter().find(|(_, c)| c.kind == kind).map(|(id, _)| id);
        known.unwrap_or_else(|| {
            let object = self.object;
            let origin = self.document.classes[object].origin;
            self.add_class(&name, kind, &[object], origin)
        })
    }

    fn declared_count(&mut self, scope: &Scope, ty: &ast::Type) -> Option<Count> {
        let TypeShape::List { count, .. } = ty.shape() else { return None };
        let Some(count) = count else { return Some(Count::Given) };
        match self.constant(scope, &count).and_then(|n| u32::try_from(n).ok()) {
            Some(n) => Some(Count::Fixed(n)),
            None => {
                self.not_yet(scope.file, count.span(), "a count that is no constant is");
                Some(Count::Fixed(0))
            }
        }
    }

    /// Lowers every expression that waits.
    pub(crate) fn define_members(&mut self) {
        for pending in std::mem::take(&mut self.pending) {
            match pending {
                Pending::Member(scope, member) => self.define(&scope, &member),
                Pending::Value { scope, prefix, target, value } => {
                    self.define_value(&scope, prefix, target.as_ref(), &value);
                }
                Pending::Answer { scope, index, answer } => {
                    if let Some((term, _)) = self.expr(&scope, &answer) {
                        self.document.classes[scope.class()].messages[index].answer = term;
                    }
                }
            }
        }
    }

    fn define_value(
        &mut self,
        scope: &Scope,
        prefix: Vec<Step>,
        target: Option<&Expr>,
        value: &Expr,
    ) {
        let mut path = Path(prefix);
        let mut class = self.class_at(scope.class(), &path);
        if let Some(target) = target {
            let inside = match class {
                Some(c) if !path.is_empty() => scope.inside(c),
                _ => scope.clone(),
            };
            let Some((rest, kind)) = self.path(&inside, target) else { return };
            path = path.join(&rest);
            class = kind;
        }
        let Some((term, kind)) = self.expr(scope, value) else { return };
        let wanted = class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c));
        if !kind.fits(&wanted) {
            let message = format!(
                "{path} is {}, and is given {}",
                wanted.words(&self.document),
                kind.words(&self.document)
            );
            let both_numbers = matches!((&kind, &wanted), (Kind::Number(_), Kind::Number(_)));
            let code = if both_numbers { "dimension-mismatch" } else { "value-of-wrong-class" };
            return self.error(code, scope.file, value.span(), message);
        }
        let origin = self.origin(scope.file, value.span());
        self.document.classes[scope.class()].givens.push(Given { path, value: term, origin });
    }

    fn define(&mut self, scope: &Scope, member: &Member) {
        let origin = self.origin(scope.file, span_without_doc(member.syntax()));
        let class = scope.class();
        match member {
            Member::Constraint(c) => self.define_constraint(scope, c, origin),
            Member::Merge(merge) => {
                let paths = self.paths(scope, merge.paths());
                let name = merge.name().map(|w| w.name());
                if paths.len() > 1 {
                    self.document.classes[class].merges.push(Merge { name, paths, origin });
                }
            }
            Member::Stay(stay) => {
                let strength = stay.strength().map_or(Strength::Weak, strength);
                for path in self.paths(scope, stay.paths()) {
                    let stay = Stay { path, strength: Some(strength), origin };
                    self.document.classes[class].stays.push(stay);
                }
            }
            Member::Anchor(anchor) => {
                for path in self.paths(scope, anchor.paths()) {
                    self.document.classes[class].stays.push(Stay { path, strength: None, origin });
                }
            }
            Member::Insert(insert) => {
                let part = insert.part().and_then(|p| self.path(scope, &p));
                let set = insert.set().and_then(|p| self.path(scope, &p));
                if let (Some((part, _)), Some((set, _))) = (part, set) {
                    self.document.classes[class].inserts.push(Insert { part, set, origin });
                }
            }
            Member::Without(without) => {
                for path in without.paths() {
                    if let Some(path) = loose_path(&path) {
                        self.document.classes[class].without.push(path);
                    }
                }
            }
            Member::Attachers(attachers) => {
                let paths = self.paths(scope, attachers.paths());
                self.document.classes[class].attachers.extend(paths);
            }
            _ => {}
        }
    }

    fn paths(&mut self, scope: &Scope, exprs: impl Iterator<Item = Expr>) -> Vec<Path> {
        exprs.filter_map(|e| self.path(scope, &e)).map(|(path, _)| path).collect()
    }

    fn define_constraint(&mut self, scope: &Scope, c: &ast::Constraint, origin: OriginId) {
        let rule = match c.rule() {
            Some(Rule::Holds(rule)) => rule,
            Some(Rule::If(rule)) => {
                let first = rule.span();
                return self.not_yet(scope.file, first, "constraints under a condition are");
            }
            None => return,
        };
        let Some((term, kind)) = self.expr(scope, &rule) else { return };
        if !kind.fits(&Kind::Bool) {
            let message =
                format!("a rule is true or false, this is {}", kind.words(&self.document));
            let place = Place { file: scope.file, span: rule.span() };
            let d = Diagnostic::error("not-a-rule", place, message);
            return self.report(d.hint("write an equation, `a = b`"));
        }
        let within = c.tolerance().and_then(|t| self.expr(scope, &t)).map(|(t, _)| t);
        let (mut methods, mut reads, mut derived, mut whole) = (Vec::new(), Vec::new(), true, true);
        for item in c.methods().into_iter().flat_map(|m| m.items()) {
            match item {
                MethodItem::Method(m) => {
                    if methods.is_empty() {
                        derived = false;
                    }
                    match self.method(scope, &m) {
                        Some(method) => methods.push(method),
                        None => whole = false,
                    }
                }
                MethodItem::Reads(r) => reads.extend(self.paths(scope, r.paths())),
                MethodItem::Derived(_) => derived = true,
            }
        }
        if !whole {
            return;
        }
        let strength = c.strength().map_or(Strength::Required, strength);
        self.document.classes[scope.class()].constraints.push(Constraint {
            name: c.name().map(|w| w.name()),
            doc: c.doc().unwrap_or_default(),
            rule: term,
            strength,
            methods,
            derived,
            reads,
            within,
            enabled: true,
            origin,
        });
    }

    fn method(&mut self, scope: &Scope, m: &ast::Method) -> Option<Method> {
        let targets: Vec<Expr> = m.targets().collect();
        let mut paths = Vec::new();
        for target in &targets {
            paths.push(self.path(scope, target)?.0);
        }
        let value = m.value()?;
        let parts: Vec<Expr> = match &value {
            Expr::Tuple(tuple) if targets.len() > 1 => tuple.elements().collect(),
            _ => vec![value.clone()],
        };
        if parts.len() != paths.len() {
            let message = format!("{} targets and {} values", paths.len(), parts.len());
            self.error("wrong-arity", scope.file, value.span(), message);
            return None;
        }
        let mut values = Vec::new();
        for part in &parts {
            values.push(self.expr(scope, part)?.0);
        }
        let origin = self.origin(scope.file, m.span());
        Some(Method { targets: paths, values, origin })
    }
}

fn strength(s: ast::Strength) -> Strength {
    match s {
        ast::Strength::Required => Strength::Required,
        ast::Strength::Strong => Strength::Strong,
        ast::Strength::Medium => Strength::Medium,
        ast::Strength::Weak => Strength::Weak,
    }
}

/// Returns the values of a body that holds nothing but constants for parts.
fn values_alone(members: &[Member]) -> Option<Vec<(Expr, Expr)>> {
    let value = |m: &Member| match m {
        Member::Assign(a) => {
            let value = a.value()?.expr()?;
            is_constant(&value).then_some((a.target()?, value))
        }
        _ => None,
    };
    members.iter().map(value).collect()
}

/// Returns true if an expression speaks of no part.
fn is_constant(expr: &Expr) -> bool {
    !expr.syntax().descendants().any(|n| {
        matches!(
            n.kind(),
            syntax::SyntaxKind::NameExpr
                | syntax::SyntaxKind::OwnerExpr
                | syntax::SyntaxKind::SuperExpr
        )
    })
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
