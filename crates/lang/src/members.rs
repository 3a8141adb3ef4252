//! Members: parts and messages are declared first, then everything that speaks of parts is lowered.

use crate::counts::{Numbers, has_named_count, whole};
use crate::kept::Run;
use crate::kept::loops::KeptLoop;
use crate::kinds::Kind;
use crate::loops::MOST_MEMBERS;

use crate::lower::{Lowerer, OWN};
use crate::scope::Scope;
use base::{Diagnostic, FileId, Name, Place, Span};
use kernel::{
    ClassId, ClassKind, Count, Message, OriginId, Parameter, Part, Path, Primitive, Stay, Step,
    Term,
};
use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::rc::Rc;
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr, Member, TypeShape, span_without_doc};

/// A member whose expressions are still to be lowered.
#[derive(Clone, Debug)]
pub(crate) enum Pending {
    /// Any member.
    Member(Rc<Scope>, Member),
    /// A value of a part: `x = 3`, or one of a body of values.
    Value {
        scope: Rc<Scope>,
        /// From `Me` to what the target speaks of.
        prefix: Vec<Step>,
        /// The path after the prefix; none for a part's own `= value`.
        target: Option<Expr>,
        value: Expr,
    },
    /// Members that `for` repeats for what is known once all parts are declared; so many first turns
    /// were taken already.
    Each { scope: Rc<Scope>, each: ast::For, from: u32 },
    /// What a reference names, by a path from the document.
    Absolute { scope: Rc<Scope>, path: Path, target: Expr },
    /// The values of parts of the document that are kept.
    Kept(Run),
    /// What the turns of a loop of the document gave, which are not taken.
    KeptLoop(KeptLoop),
    /// The values of this member of the document follow.
    Note(usize),
    /// They end here: so many values, of the part of this index where the member declares one.
    Noted { member: usize, part: Option<u32>, givens: u32 },
    /// Those of a loop end here, which has these words and made so many members where it was declared.
    NotedLoop { member: usize, members: usize, words: BTreeSet<Name> },
    /// The answer of a message.
    Answer { scope: Rc<Scope>, index: usize, definition: Rc<Definition> },
}

/// The definition of a message.
#[derive(Debug)]
pub(crate) struct Definition {
    pub(crate) answer: Expr,
    /// What names mean in it.
    pub(crate) scope: Rc<Scope>,
    /// The loops that repeat it, the outermost first.
    pub(crate) loops: Vec<ast::For>,
    /// The elements of the answer where it is a list that is written out, once they were asked for.
    pub(crate) elements: OnceCell<Option<Rc<[Expr]>>>,
    /// What it answers, and what that is worth, where it was read to find that out and is read alike once more.
    pub(crate) read: OnceCell<(Rc<Term>, Kind)>,
}

/// The word that a `for` begins with.
pub(crate) const FOR: &str = "for";
/// What to write where a `for` stands for a list.
pub(crate) const FOR_AS_VALUE: &str = "a list of many is `(0..9).map(i => …)`; as a member, \
     `for i in 0..9 { list[i] = … }` gives the elements of a list one by one";

/// What is wrong with a step elsewhere.
const STEP_OUTSIDE: &str = "a step stands in a program";

impl Lowerer<'_> {
    /// Declares what a body adds to the class of its scope.
    pub(crate) fn declare_body(&mut self, scope: &Scope, members: Vec<Member>) {
        let whole = OnceCell::new();
        let shared = || whole.get_or_init(|| Rc::new(scope.clone())).clone();
        for member in members {
            let span = span_without_doc(member.syntax());
            match &member {
                Member::Part(part) => self.declare_part(scope, part),
                Member::Ref(reference) => self.declare_reference(scope, reference),
                Member::Message(message) => self.declare_message(scope, &[], message),
                Member::For(each) => self.unroll(scope, each),
                Member::If(choice) => self.declare_choice(scope, choice),
                Member::Modify(modify) => self.declare_modify(scope, modify),
                Member::Assign(assign) if assign.is_guide() => {
                    let place = Place { file: scope.file, span: self.first_line(scope.file, span) };
                    let d = Diagnostic::error("misplaced-step", place, STEP_OUTSIDE);
                    self.report(d.hint("leave `guide` out"));
                }
                Member::Assign(assign) => {
                    self.refuse_block(scope, assign.value());
                    let value = assign.value().and_then(ast::Value::expr);
                    if let Some((name, count)) = given_list(assign) {
                        self.given_counts.insert((scope.class(), name), count);
                    }
                    if let (Some(target), Some(value)) = (assign.target(), value) {
                        let (scope, prefix, target) = (shared(), Vec::new(), Some(target));
                        self.pending.push(Pending::Value { scope, prefix, target, value });
                    }
                }
                Member::Constraint(constraint) => {
                    if let Some(name) = constraint.name() {
                        self.constraints.insert((scope.class(), name.name()));
                    }
                    self.pending.push(Pending::Member(shared(), member.clone()));
                }
                Member::Merge(_)
                | Member::Stay(_)
                | Member::Anchor(_)
                | Member::Side(_)
                | Member::Insert(_)
                | Member::Without(_)
                | Member::Replace(_)
                | Member::Attachers(_)
                | Member::Handle(_) => {
                    self.pending.push(Pending::Member(shared(), member.clone()));
                }
                Member::Error(error) => self.note_meant(scope, error),
                Member::Unit(_) | Member::Y(_) | Member::Use(_) => {}
                Member::Class(_)
                | Member::Choice(_)
                | Member::Program(_)
                | Member::Family(_)
                | Member::Check(_)
                | Member::Lesson(_)
                | Member::View(_)
                | Member::Toolbox(_)
                    if self.is_top_level(scope) => {}
                // those of classes are read once all classes are known
                Member::View(_) if self.is_declared(scope) => {}
                Member::Toolbox(_) | Member::View(_) if scope.file != OWN => {}
                Member::Class(_) | Member::Choice(_) | Member::Program(_) | Member::Family(_)
                    if scope.file != OWN => {}
                Member::Check(_) | Member::Lesson(_) if scope.file != OWN => {}
                other => self.refuse(scope.file, other, span),
            }
        }
    }

    /// Returns true at the top level of the document's own text, outside of any `for`.
    fn is_top_level(&self, scope: &Scope) -> bool {
        scope.class() == self.document.root && scope.turns.is_empty()
    }

    /// Returns true in the body of a class that a text declares by its name.
    fn is_declared(&self, scope: &Scope) -> bool {
        scope.turns.is_empty() && self.declared.iter().any(|(class, _, _)| *class == scope.class())
    }

    /// Reports a value that is a block of steps, as only programs have.
    fn refuse_block(&mut self, scope: &Scope, value: Option<ast::Value>) {
        let Some(value) = value.filter(|v| v.clone().expr().is_none()) else { return };
        // `repeat n { … }`, which the parser told
        if matches!(&value, ast::Value::Repeat(block) if block.lacks_times()) {
            return;
        }
        let (file, span) = (scope.file, value.span());
        let is_for = matches!(value, ast::Value::For(_));
        let place = Place { file, span: self.first_line(file, span) };
        self.report(if is_for {
            Diagnostic::error("for-as-value", place, "a `for` is no value").hint(FOR_AS_VALUE)
        } else {
            let hint = "write it in `program Name() { … }`";
            Diagnostic::error("misplaced-step", place, STEP_OUTSIDE).hint(hint)
        });
    }

    fn refuse(&mut self, file: FileId, member: &Member, span: Span) {
        let what = match member {
            Member::When(_) => "events are",
            Member::View(_) => "views of a single part are",
            Member::Toolbox(_) => "toolboxes inside of classes are",
            Member::Lesson(_) => "lessons inside of classes are",
            Member::Program(program) => {
                let place = Place { file, span: self.first_line(file, span) };
                let message = "a program stands at the top of a text, not in a class";
                let d = Diagnostic::error("misplaced-program", place, message);
                let name = program.name().map_or("Name".into(), |word| word.name());
                return self.report(d.hint(format!(
                    "write it beside the class; a part of it is drawn in each thing: `drawn: {name} {{ … }}`"
                )));
            }
            Member::Family(_) => "families inside of others are",
            Member::Class(_) => "classes inside of others are",
            Member::Choice(_) => "choices inside of classes are",
            Member::Check(_) => "checks inside of classes are",
            Member::Repeat(block) if block.lacks_times() => return,
            Member::Repeat(_) | Member::While(_) | Member::Next(_) | Member::Erase(_) => {
                let line = self.first_line(file, span);
                let d =
                    Diagnostic::error("misplaced-step", Place { file, span: line }, STEP_OUTSIDE);
                return self.report(d.hint("write it in `program Name() { … }`"));
            }
            Member::Table(_) | Member::Rows(_) => "rows of families are",
            // statements outside of checks: the text was refused already
            _ => return,
        };
        let line = self.first_line(file, span);
        self.not_yet(file, line, what);
    }

    /// Returns the first line of what is written at a place.
    pub(crate) fn first_line(&self, file: FileId, span: Span) -> Span {
        let text = self.files[file].text.get(span.range()).unwrap_or_default();
        let line = text.lines().next().unwrap_or_default().trim_end().len() as u32;
        Span::new(span.start, span.start + line)
    }

    /// Returns the whole numbers that a part may be; a list's are those of its elements.
    pub(crate) fn domain(
        &mut self,
        scope: &Scope,
        domain: &Expr,
        class: ClassId,
    ) -> Option<(i64, i64)> {
        let mut of = class;
        while let ClassKind::List(element) = self.document.classes[of].kind {
            of = element;
        }
        let is_whole =
            matches!(self.document.classes[of].kind, ClassKind::Primitive(Primitive::Integer));
        let range = self.constant_range(scope, domain);
        let place = Place { file: scope.file, span: domain.span() };
        if let Some(column) = crate::tables::column_of(domain) {
            let message = "a column of a table is allowed of a parameter of a program alone";
            let d = Diagnostic::error("not-a-domain", place, message);
            let (file, name) = (column.file(), column.name());
            self.report(match crate::tables::is_name(&file) {
                true => d.hint(format!(
                    "a program asks for it: `program Part(… in \"{file}\".{name} = …) {{ … }}`"
                )),
                false => d,
            });
            return None;
        }
        match range {
            Some((low, high)) if is_whole && low <= high => return range,
            Some((low, high)) if is_whole => {
                let message = format!("no whole number lies in {low}..{high}");
                let d = Diagnostic::error("empty-domain", place, message);
                self.report(d.hint("write the least number first"));
            }
            _ if is_whole => {
                let message = "a domain is a range of constants".to_string();
                let d = Diagnostic::error("not-a-domain", place, message);
                let within = match domain {
                    Expr::List(list) => list.elements().next(),
                    _ => None,
                };
                let d = match within.filter(|e| matches!(e, Expr::Range(_))) {
                    Some(range) => d.hint(format!("write `in {}`", range.syntax().text())),
                    None if matches!(domain, Expr::List(_)) => d.hint(format!(
                        "what is one of several is a rule: `constraint x in {}`",
                        domain.syntax().text()
                    )),
                    None => d.hint(match ends_by_minus(domain).or_else(|| one_sided(domain)) {
                        Some(said) => said,
                        None => "write `in 0..9`; what depends on parts is a constraint".into(),
                    }),
                };
                self.report_whole(d);
            }
            _ => {
                let is = Kind::of_class(&self.document, of).words(&self.document);
                let message = format!("only whole numbers have a domain, this is {is}");
                let d = Diagnostic::error("not-a-domain", place, message);
                let end = |e: Option<Expr>| e.map(|e| e.syntax().text().to_string());
                let ends = match domain {
                    Expr::Range(range) => end(range.start()).zip(end(range.end())),
                    _ => None,
                };
                let (low, high) = ends.unwrap_or_else(|| ("0".into(), "9".into()));
                let hint = one_sided(domain)
                    .unwrap_or_else(|| format!("write a constraint: `{low} <= x <= {high}`"));
                self.report(d.hint(hint));
            }
        }
        None
    }

    pub(crate) fn constant_range(&mut self, scope: &Scope, range: &Expr) -> Option<(i64, i64)> {
        let Expr::Range(range) = range else { return None };
        let from = self.constant(scope, &range.start()?)?;
        let end = self.constant(scope, &range.end()?)?;
        Some((from, end.saturating_sub(i64::from(range.is_open()))))
    }

    /// Declares the members of the branch that a condition of constants chooses.
    fn declare_choice(&mut self, scope: &Scope, choice: &ast::If) {
        if let Some(members) = self.chosen(scope, choice) {
            self.declare_body(scope, members);
        }
    }

    /// Returns the members of the branch that a condition of constants chooses; reports one that no constants decide.
    pub(crate) fn chosen(&mut self, scope: &Scope, choice: &ast::If) -> Option<Vec<Member>> {
        let condition = choice.condition()?;
        // `x: Real = 1 if c else 2`, which the parser told
        let place = Place { file: scope.file, span: condition.span() };
        if choice.then_body().is_none() && self.goes_on(place, "else") {
            return None;
        }
        let Some(holds) = self.constant_truth(scope, &condition) else {
            let message = "members stand under a condition that is known as the text stands";
            let d = Diagnostic::error("not-a-constant", place, message);
            let hint = "what depends on values is a rule: `constraint if c { a = b } else { … }`";
            let default = self.with_default(scope, &condition);
            self.report(d.hint(default.unwrap_or(hint.into())));
            return None;
        };
        match (holds, choice.else_branch()) {
            (true, _) => Some(choice.then_body()?.members().collect()),
            (false, Some(ast::Else::Body(body))) => Some(body.members().collect()),
            (false, Some(ast::Else::If(next))) => self.chosen(scope, &next),
            (false, None) => Some(Vec::new()),
        }
    }

    /// Returns the whole number that an expression of constants is.
    pub(crate) fn constant(&mut self, scope: &Scope, expr: &Expr) -> Option<i64> {
        whole(self.constant_number(scope, expr)?)
    }

    /// Returns the number that an expression of constants is.
    pub(crate) fn constant_number(&mut self, scope: &Scope, expr: &Expr) -> Option<f64> {
        let turn = crate::numbers::constant(&|e| scope.constant(e), expr);
        if turn.is_some() {
            return turn;
        }
        let known = self.constants_in(scope, expr);
        crate::numbers::constant(&|e| known.get(&e.span()).copied(), expr)
    }

    /// Returns how many elements a list has, where `list.count` says so and that is known, or the count of
    /// another thing, `t.n`.
    pub(crate) fn constant_count(&mut self, scope: &Scope, e: &Expr) -> Option<i64> {
        let Expr::Field(field) = e else { return None };
        let is_count = field.args().is_none() && field.name()?.text() == "count";
        let length = match field.receiver().filter(|_| is_count) {
            Some(list) => self.length_of(scope, &list).map(i64::from),
            None => None,
        };
        length.or_else(|| self.count_of_thing(scope, e))
    }

    fn declare_part(&mut self, scope: &Scope, part: &ast::Part) {
        let Some(ty) = part.class() else {
            return self.broken.extend(part.names().map(|w| (scope.class(), w.name())));
        };
        if part.is_constant() && part.value().is_none() {
            let place = Place { file: scope.file, span: span_without_doc(part.syntax()) };
            let d = Diagnostic::error("constant-without-value", place, "a constant has a value");
            self.report(d.hint("write `constant g: Acceleration = 9.81 m/s^2`"));
        }
        if let Some(definition) = part.definition() {
            return self.declare_virtual(scope, &[], part, &ty, &definition);
        }
        let before = self.diagnostics.len();
        let Some(class) = self.class_of_type(scope, &ty) else {
            self.hint_class(before, part.value().and_then(ast::Value::expr));
            return self.broken.extend(part.names().map(|w| (scope.class(), w.name())));
        };
        self.warn_of_turns(scope, part, &ty);
        let value = part.value().and_then(ast::Value::expr);
        let count = match (self.declared_count(scope, &ty), &value) {
            (Some(Count::Given), Some(value)) => {
                Some(self.count_of_range(scope, value).map_or(Count::Given, Count::Fixed))
            }
            (count, _) => count,
        };
        let body = part.body();
        let of_elements = body.clone().filter(|_| matches!(ty.shape(), TypeShape::List { .. }));
        let range = part.domain().and_then(|d| self.domain(scope, &d, class));
        self.refuse_block(scope, part.value());
        // what is asked of the whole declaration is asked once, however many names it has
        let doc = part.doc().unwrap_or_default();
        let span = span_without_doc(part.syntax());
        let (is_constant, is_layout) = (part.is_constant(), part.is_layout());
        let is_counted_by_name = has_named_count(part);
        for word in part.names() {
            if !self.is_new(scope, &word) {
                continue;
            }
            let origin = self.origin(scope.file, span);
            let name = word.name();
            let class = match &value {
                Some(Expr::Call(call)) => self.class_for_call(scope, &name, class, call, origin),
                _ => class,
            };
            let class = match &of_elements {
                // a class may have things of itself with other counts, down to none
                Some(_) if count == Some(Count::Fixed(0)) && is_counted_by_name => class,
                Some(body) => self.list_with_body(scope, &name, class, body, origin),
                None => self.class_for_body(scope, &name, class, body.clone(), origin),
            };
            let (name_of_part, doc) = (name.clone(), doc.clone());
            let declared = Part { name: name_of_part, doc, class, count, range, is_layout, origin };
            let place = Place { file: scope.file, span: word.span() };
            self.add_part(place, scope.class(), declared);
            if is_constant {
                self.constants.insert((scope.class(), name.clone()));
                let path = Path(vec![Step::Part(name.clone())]);
                let stay = Stay { path, strength: None, origin };
                self.document.classes[scope.class()].stays.push(stay);
            }
            if let (Some(Count::Given), Some(Expr::List(list))) = (count, &value) {
                let key = (scope.class(), name.clone());
                self.given_counts.insert(key, list.elements().count() as u32);
            }
            if let Some(value) = value.clone() {
                let prefix = vec![Step::Part(name)];
                let scope = Rc::new(scope.clone());
                let pending = Pending::Value { scope, prefix, target: None, value };
                self.pending.push(pending);
            }
        }
    }

    /// Returns how many elements a range of constants has, or what is made of each of it or of a list.
    fn count_of_range(&mut self, scope: &Scope, value: &Expr) -> Option<u32> {
        match value {
            Expr::Paren(inner) => self.count_of_range(scope, &inner.inner()?),
            Expr::Range(_) => {
                let (low, high) = self.constant_range(scope, value)?;
                let count = high.saturating_sub(low).saturating_add(1);
                u32::try_from(count.max(0)).ok().filter(|&n| n as usize <= MOST_MEMBERS)
            }
            Expr::Field(sent)
                if sent.args().is_some() && sent.name().is_some_and(|w| w.text() == "map") =>
            {
                match sent.receiver()? {
                    Expr::List(list) => Some(list.elements().count() as u32),
                    Expr::Name(_) | Expr::Field(_)
                        if let Some(n) = self.length_of(scope, &sent.receiver()?) =>
                    {
                        Some(n)
                    }
                    other => self.count_of_range(scope, &other),
                }
            }
            _ => None,
        }
    }

    /// Notes what a member that was not understood was perhaps to declare, `let x = 3`: where it is used is no mistake of
    /// its own.
    fn note_meant(&mut self, scope: &Scope, error: &ast::Error) {
        let tokens =
            error.syntax().children_with_tokens().filter_map(syntax::SyntaxElement::into_token);
        let tokens: Vec<_> = tokens.filter(|t| !t.kind().is_trivia()).take(3).collect();
        let signs = [SyntaxKind::Eq, SyntaxKind::LParen, SyntaxKind::Colon];
        for pair in tokens.windows(2) {
            if pair[0].kind() == SyntaxKind::Ident && signs.contains(&pair[1].kind()) {
                self.broken.insert((scope.class(), Name::new(pair[0].text())));
            }
        }
    }

    /// Declares a part that names another thing.
    fn declare_reference(&mut self, scope: &Scope, reference: &ast::Ref) {
        let (Some(word), Some(ty)) = (reference.name(), reference.class()) else { return };
        let Some(to) = self.class_of_type(scope, &ty) else {
            self.broken.insert((scope.class(), word.name()));
            return;
        };
        if !self.is_new(scope, &word) {
            return;
        }
        let class = self.reference_to(to);
        let name = word.name();
        let doc = reference.doc().unwrap_or_default();
        let origin = self.origin(scope.file, span_without_doc(reference.syntax()));
        let declared = Part {
            name: name.clone(),
            doc,
            class,
            count: None,
            range: None,
            is_layout: false,
            origin,
        };
        let place = Place { file: scope.file, span: word.span() };
        self.add_part(place, scope.class(), declared);
        let Some(value) = reference.target() else {
            let message = format!("{name} names nothing");
            let d = Diagnostic::error("unknown-reference", place, message);
            return self.report(d.hint("say what: `ref a: C -> b.c`"));
        };
        let (scope, prefix) = (Rc::new(scope.clone()), vec![Step::Part(name)]);
        self.pending.push(if reference.is_absolute() {
            Pending::Absolute { scope, path: Path(prefix), target: value }
        } else {
            Pending::Value { scope, prefix, target: None, value }
        });
    }

    /// Adds a part to a class.
    pub(crate) fn add_part(&mut self, place: Place, class: ClassId, part: Part) {
        let key = (class, part.name.clone());
        let parts = &mut self.document.classes[class].parts;
        self.parts.insert(key.clone(), parts.len());
        self.named_at.insert(key, place);
        parts.push(part);
    }

    /// Returns true if the class itself has no part or message of this name yet; else it is reported.
    pub(crate) fn is_new(&mut self, scope: &Scope, word: &ast::Word) -> bool {
        let key = (scope.class(), word.name());
        let Some(&before) = self.named_at.get(&key) else { return true };
        let place = Place { file: scope.file, span: word.span() };
        if before == place && !scope.turns.is_empty() {
            let message =
                format!("{} stands under an `if` that holds in several turns", word.text());
            let d = Diagnostic::error("duplicate-name", place, message);
            let hint = "declare it in a loop over these turns alone, `for i in 0..1 { … }`: there it is a list";
            self.report(d.hint(hint));
            return false;
        }
        let message = format!("there is a part or message {} already", word.text());
        let d = Diagnostic::error("duplicate-name", place, message);
        self.report(d.label(before, "here").hint("give one of them another name"));
        false
    }

    /// Returns the class of a part with a body: its class, or a class of one.
    pub(crate) fn class_for_body(
        &mut self,
        scope: &Scope,
        name: &Name,
        class: ClassId,
        body: Option<ast::Body>,
        origin: OriginId,
    ) -> ClassId {
        let Some(body) = body else { return class };
        let members: Vec<Member> = body.members().collect();
        let class = self.class_for_counts(scope, class, &members);
        let gives = |m: &Member| match m {
            Member::Assign(assign) => given_list(assign).map(|(name, _)| name),
            _ => None,
        };
        let is_looped = members.iter().filter_map(gives).any(|name| self.is_looped(class, &name));
        if let Some(values) = values_alone(&members).filter(|_| !is_looped) {
            for (list, count) in members.iter().filter_map(|m| match m {
                Member::Assign(assign) => given_list(assign),
                _ => None,
            }) {
                self.given_in_bodies.insert((scope.class(), name.clone(), list), count);
            }
            for (target, value) in values {
                let prefix = vec![Step::Part(name.clone())];
                let scope = Rc::new(scope.clone());
                let target = Some(target);
                self.pending.push(Pending::Value { scope, prefix, target, value });
            }
            return class;
        }
        let one = self.class_of_one(scope, name, class, origin);
        self.note_counts(one, &members, &Numbers::new());
        self.declare_body(&scope.inside(one), members);
        one
    }

    /// Returns the class of a list whose elements all have a body.
    fn list_with_body(
        &mut self,
        scope: &Scope,
        name: &Name,
        list: ClassId,
        body: &ast::Body,
        origin: OriginId,
    ) -> ClassId {
        let ClassKind::List(element) = self.document.classes[list].kind else { return list };
        let members: Vec<Member> = body.members().collect();
        if members.is_empty() {
            return list;
        }
        let element = self.class_for_counts(scope, element, &members);
        let one = self.class_of_one(scope, name, element, origin);
        self.note_counts(one, &members, &Numbers::new());
        self.declare_body(&scope.inside(one), members);
        self.class_made_of("List of", ClassKind::List(one), one)
    }

    pub(crate) fn class_of_one(
        &mut self,
        scope: &Scope,
        name: &Name,
        class: ClassId,
        origin: OriginId,
    ) -> ClassId {
        let label = match self.document.classes[scope.class()].name.as_str() {
            "" => name.to_string(),
            owner => format!("{owner}.{name}"),
        };
        let one = self.add_unnamed_class(&label, class, origin);
        self.document.classes[one].is_of_one = true;
        one
    }

    /// Declares a computed part: repeated by loops, a list of them.
    pub(crate) fn declare_virtual(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        part: &ast::Part,
        ty: &ast::Type,
        answer: &Expr,
    ) {
        let class = self.class_of_type(scope, ty);
        let said = part.doc().unwrap_or_default();
        let span = span_without_doc(part.syntax());
        for word in part.names() {
            if !self.is_new(scope, &word) {
                continue;
            }
            let doc = said.clone();
            let origin = self.origin(scope.file, span);
            if let Some(class) = class {
                let kind = Kind::of_class(&self.document, class).listed(loops.len());
                self.message_kinds.insert((scope.class(), word.name()), Some(kind));
            }
            let message = Message {
                name: word.name(),
                doc,
                parameters: Vec::new(),
                class,
                answer: self.unsaid.clone(),
                is_asked: false,
                is_default: false,
                is_combining: false,
                is_replacing: false,
                origin,
            };
            self.add_message(scope, loops, &word, answer, message);
        }
    }

    /// Declares a message: repeated by loops, it answers a list.
    pub(crate) fn declare_message(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        message: &ast::Message,
    ) {
        if message.is_static() {
            return self.declare_static(scope, message);
        }
        let (Some(name), Some(answer)) = (message.name(), message.definition()) else { return };
        if !self.is_new(scope, &name) {
            return;
        }
        let (parameters, inner) = self.parameters_of(scope, message);
        let class = message.class().and_then(|ty| self.class_of_type(scope, &ty));
        if let Some(class) = class {
            let kind = Kind::of_class(&self.document, class).listed(loops.len());
            self.message_kinds.insert((scope.class(), name.name()), Some(kind));
        }
        let origin = self.origin(scope.file, span_without_doc(message.syntax()));
        let doc = message.doc().unwrap_or_default();
        let declared = Message {
            name: name.name(),
            doc,
            parameters,
            class,
            answer: self.unsaid.clone(),
            is_asked: message.params().is_some(),
            is_default: message.is_default(),
            is_combining: message.is_combining(),
            is_replacing: message.is_replacing(),
            origin,
        };
        self.add_message(&inner, loops, &name, &answer, declared);
    }

    /// Reads the parameters of a message, and makes the scope of its answer.
    pub(crate) fn parameters_of(
        &mut self,
        scope: &Scope,
        message: &ast::Message,
    ) -> (Vec<Parameter>, Scope) {
        let mut parameters = Vec::new();
        let mut inner = scope.clone();
        for p in message.params().into_iter().flat_map(|p| p.params()) {
            let (Some(name), Some(label)) = (p.name(), p.label()) else { continue };
            let class = p.class().and_then(|ty| self.class_of_type(scope, &ty));
            let kind = class.map_or(Kind::Unknown, |c| Kind::of_class(&self.document, c));
            inner.add_local(name.name(), kind);
            parameters.push(Parameter { label: label.name(), name: name.name(), class });
        }
        (parameters, inner)
    }

    /// Adds a message to the class of the scope; its answer waits until all parts are declared.
    pub(crate) fn add_message(
        &mut self,
        scope: &Scope,
        loops: &[ast::For],
        word: &ast::Word,
        answer: &Expr,
        message: Message,
    ) {
        let class = scope.class();
        let key = (class, message.name.clone());
        self.named_at.insert(key.clone(), Place { file: scope.file, span: word.span() });
        let (answer, loops) = (answer.clone(), loops.to_vec());
        let (elements, read) = (OnceCell::new(), OnceCell::new());
        let scope = Rc::new(scope.clone());
        let definition =
            Rc::new(Definition { answer, scope: scope.clone(), loops, elements, read });
        self.definitions.insert(key, definition.clone());
        let index = self.document.classes[class].messages.len();
        self.messages.insert((class, message.name.clone()), index);
        self.document.classes[class].messages.push(message);
        self.pending.push(Pending::Answer { scope, index, definition });
    }
}

/// Returns the list that elements are given to, and how many.
fn given_list(assign: &ast::Assign) -> Option<(Name, u32)> {
    let Some(Expr::List(list)) = assign.value().and_then(ast::Value::expr) else { return None };
    let Expr::Name(name) = assign.target()? else { return None };
    Some((name.name()?.name(), list.elements().count() as u32))
}

/// Returns the values of a body that holds nothing but constants for parts.
pub(crate) fn values_alone(members: &[Member]) -> Option<Vec<(Expr, Expr)>> {
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
pub(crate) fn is_constant(expr: &Expr) -> bool {
    !expr.syntax().descendants().any(|n| {
        matches!(n.kind(), SyntaxKind::NameExpr | SyntaxKind::OwnerExpr | SyntaxKind::SuperExpr)
    })
}

/// Says what to write for a domain that is open at an end.
fn one_sided(domain: &Expr) -> Option<String> {
    let Expr::Range(range) = domain else { return None };
    let text = |e: Expr| e.syntax().text().to_string();
    let sign =
        |sign: &str, is_outside: bool| format!("{sign}{}", if is_outside { "" } else { "=" });
    let rule = match (range.start(), range.end()) {
        (Some(least), None) => format!("{} {}", sign(">", range.is_above()), text(least)),
        (None, Some(most)) => format!("{} {}", sign("<", range.is_open()), text(most)),
        _ => return None,
    };
    Some(format!("what has one end is a constraint: `x {rule}`"))
}

/// Returns `1..10` for `1-10`, the range of other texts, as what to write.
fn ends_by_minus(domain: &Expr) -> Option<String> {
    let Expr::Binary(difference) = domain else { return None };
    let (ast::BinaryOp::Subtract, Expr::Number(low), Expr::Number(high)) =
        (difference.op()?, difference.left()?, difference.right()?)
    else {
        return None;
    };
    Some(format!("write `in {}..{}`", low.syntax().text(), high.syntax().text()))
}
