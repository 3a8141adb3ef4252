//! The steps of a program, lowered in order: each sees the parameters, and by name what the steps before it
//! and the blocks around it made.

use super::totals::totals_of;
use super::{members_of, nothing, step_name, with_of};
use crate::angles::ANGLE;
use crate::kinds::{Kind, measured};
use crate::lower::Lowerer;
use crate::scope::Scope;
use crate::tables;
use base::{Diagnostic, Name, Place, Span};
use kernel::program::{Allowed, Asked, Block, Bound, Carried, Says, Step};
use kernel::{BinaryOperator, ClassId, Constraint, Program, Term};
use syntax::ast::{self, AstNode, Else, Expr, Member, Value, span_without_doc};

/// So deep in one another what blocks carry is looked at twice; deeper it may be anything.
const DEEPEST_SETTLED: usize = 6;

/// What a branch makes by name.
type Names = Vec<(Name, Kind)>;

impl Lowerer<'_> {
    pub(super) fn define_program(&mut self, index: usize) {
        if !self.begins(index) {
            return;
        }
        let (class, file, node) = self.programs.declared()[index].clone();
        let mut scope = Scope::of(file, class);
        let params = node.params().into_iter().flat_map(|p| p.params());
        let parameters = params.filter_map(|p| self.asked(&scope, &p)).collect::<Vec<_>>();
        scope.is_program = true;
        let mut body = nothing(class);
        // a call lowers another program in the midst of this one
        let outer = std::mem::take(&mut self.programs.totals);
        let outer_angles = std::mem::take(&mut self.programs.angles);
        self.steps(&mut scope, &mut body, &members_of(node.body()));
        let totals = std::mem::replace(&mut self.programs.totals, outer);
        self.programs.angles = outer_angles;
        self.set_program(class, Program { parameters, demands: Vec::new(), body });
        self.warn_of_totals(file, &node, &totals);
    }

    fn asked(&mut self, scope: &Scope, param: &ast::Param) -> Option<Asked> {
        let name = param.name()?.name();
        let kind = self.kind_of_part(scope.class(), &name)?;
        let prompt = param.prompt().map_or_else(String::new, |w| w.unquoted());
        let domain = param.domain();
        let allowed =
            domain.as_ref().and_then(|domain| self.allowed(scope, domain, (&name, &kind)));
        if let (Some(domain), Some(allowed)) = (domain, allowed.clone()) {
            self.demand(scope, &name, (allowed, domain.span()));
        }
        Some(Asked { name, prompt, allowed })
    }

    /// Makes what is allowed of a program's parameter a required constraint: `d_range` of `d`.
    fn demand(&mut self, scope: &Scope, of: &Name, (allowed, span): (Allowed, Span)) {
        let class = scope.class();
        let name = Name::new(&format!("{of}_range"));
        self.constraints.insert((class, name.clone()));
        let origin = self.origin(scope.file, span);
        self.document.classes[class].constraints.push(Constraint {
            name: Some(name),
            doc: format!("What is allowed of {of}.").into(),
            ..Constraint::required(within(of, allowed), origin)
        });
    }

    /// Reads the values that are allowed of a parameter: `1 mm..9 mm`, `[3 mm, 4 mm]`.
    fn allowed(
        &mut self,
        scope: &Scope,
        domain: &Expr,
        (parameter, kind): (&Name, &Kind),
    ) -> Option<Allowed> {
        match domain {
            Expr::Range(range) => {
                let mut bound = |end: Option<Expr>, is_outside| match end {
                    Some(end) => {
                        let value = self.expr_of(scope, &end, kind)?;
                        Some(Some(Bound { value, is_outside }))
                    }
                    None => Some(None),
                };
                let least = bound(range.start(), range.is_above())?;
                let most = bound(range.end(), range.is_open())?;
                let has_end = least.is_some() || most.is_some();
                has_end.then_some(Allowed::Range { least, most })
            }
            Expr::List(list) if list.elements().next().is_some() => {
                let each = list.elements().map(|one| self.expr_of(scope, &one, kind));
                Some(Allowed::OneOf(each.collect::<Vec<_>>().into_iter().collect::<Option<_>>()?))
            }
            Expr::Field(_) if let Some(column) = tables::column_of(domain) => {
                self.allowed_by(scope, (&column, domain.span()), parameter)
            }
            _ => {
                let message = "what is allowed of a parameter is `least..largest`, a list of values, or a column of a table, `\"bolts.csv\".d`";
                self.error("not-a-domain", scope.file, domain.span(), message.into());
                None
            }
        }
    }

    /// Lowers the members of a block, and adds the steps to it; their names become locals of the scope.
    fn steps(&mut self, scope: &mut Scope, block: &mut Block, members: &[Member]) {
        for member in members {
            let span = span_without_doc(member.syntax());
            let origin = self.origin(scope.file, span);
            let doc = member.doc().unwrap_or_default();
            let step = |name: Name, says: Says, is_guide: bool| Step {
                name,
                doc: doc.clone(),
                says,
                is_guide,
                origin,
            };
            let unnamed = || Name::new("");
            match member {
                Member::Assign(assign) => {
                    let (Some(word), Some(value)) = (step_name(assign), assign.value()) else {
                        continue;
                    };
                    let name = word.name();
                    let (says, kind) = self.step_says(scope, &value);
                    self.programs.totals.extend(totals_of(&name, &value));
                    let is_angle = self.is_angle_of_step(scope, &kind, &value);
                    self.makes(scope, block.class, &name, kind);
                    self.tell_angle_of_step(block.class, &name, is_angle);
                    block.steps.push(step(name, says, assign.is_guide()));
                }
                Member::If(choice) => {
                    let says = self.branches(scope, block.class, choice);
                    block.steps.push(step(unnamed(), says, false));
                }
                Member::Repeat(of) => {
                    let says = self.step_says(scope, &Value::Repeat(of.clone())).0;
                    block.steps.push(step(unnamed(), says, false));
                }
                Member::While(of) => {
                    let says = self.step_says(scope, &Value::While(of.clone())).0;
                    block.steps.push(step(unnamed(), says, false));
                }
                Member::For(of) => {
                    let says = self.step_says(scope, &Value::For(of.clone())).0;
                    block.steps.push(step(unnamed(), says, false));
                }
                Member::Erase(erase) => {
                    let names = erase.paths().filter_map(|e| self.erased(scope, &e)).collect();
                    block.steps.push(step(unnamed(), Says::Erase(names), false));
                }
                Member::Next(next) => {
                    for binding in next.bindings() {
                        self.next(scope, block, &binding);
                    }
                }
                _ => {}
            }
        }
    }

    /// Notes what a step makes, for the steps after it and for those who look in.
    fn makes(&mut self, scope: &mut Scope, class: ClassId, name: &Name, kind: Kind) {
        scope.locals.push((name.clone(), kind.clone()));
        self.message_kinds.insert((class, name.clone()), Some(kind));
    }

    /// Returns true for a step whose value is an angle.
    fn is_angle_of_step(&mut self, scope: &Scope, kind: &Kind, value: &Value) -> bool {
        let Value::Expr(value) = value else { return false };
        matches!(kind, Kind::Number(None) | &Kind::PLAIN) && self.is_angle(scope, value)
    }

    /// Notes whether a step of a name is an angle, and says so of what it answers.
    fn tell_angle_of_step(&mut self, class: ClassId, name: &Name, is_angle: bool) {
        if !is_angle {
            self.programs.angles.remove(name);
            return;
        }
        self.programs.angles.insert(name.clone());
        let angle = self.visible.of_language(ANGLE);
        if let Some(&index) = self.messages.get(&(class, name.clone())) {
            self.document.classes[class].messages[index].class = angle;
        }
    }

    /// Returns true for the name of a step that is an angle.
    pub(crate) fn is_step_of_angle(&self, scope: &Scope, name: &Name) -> bool {
        self.programs.angles.contains(name) && scope.local(name).is_some()
    }

    /// Lowers what a step does.
    fn step_says(&mut self, scope: &Scope, value: &Value) -> (Says, Kind) {
        self.warn_of_own_steps(scope.file, value, &scope.locals);
        match value {
            Value::Expr(e) => match self.expr(scope, e) {
                // a bare number is one of the sheet's lengths only where that is wanted
                Some((term, kind)) => (Says::Value(term), kind),
                None => (Says::Unclear, Kind::Unknown),
            },
            Value::If(choice) => {
                let Some(class) =
                    choice.then_body().and_then(|b| self.programs.block(scope.file, &b))
                else {
                    return (Says::Unclear, Kind::Unknown);
                };
                let mut inner = scope.clone();
                (self.branches(&mut inner, class, choice), Kind::Thing(class))
            }
            Value::Repeat(_) | Value::While(_) | Value::For(_) => {
                let body = match value {
                    Value::Repeat(block) => block.body(),
                    Value::While(block) => block.body(),
                    Value::For(block) => block.body(),
                    Value::Expr(_) | Value::If(_) => None,
                };
                let Some(body) = body else { return (Says::Unclear, Kind::Unknown) };
                let Some(class) = self.programs.block(scope.file, &body) else {
                    return (Says::Unclear, Kind::Unknown);
                };
                let says = self.loop_says(scope, class, value, &body).unwrap_or(Says::Unclear);
                (says, Kind::List(Box::new(Kind::Thing(class))))
            }
        }
    }

    /// Lowers a loop.
    fn loop_says(
        &mut self,
        scope: &Scope,
        class: ClassId,
        value: &Value,
        body: &ast::Body,
    ) -> Option<Says> {
        let times = match value {
            Value::Repeat(block) => match block.times() {
                Some(e) => Some(self.expr_of(scope, &e, &Kind::PLAIN)?),
                None => None,
            },
            _ => None,
        };
        let each = match value {
            Value::For(block) => Some(self.set(scope, &block.range()?, block)?),
            _ => None,
        };
        let mut inner = scope.clone();
        for (name, kind) in each.iter().flat_map(|(_, names)| names) {
            self.makes(&mut inner, class, name, kind.clone());
        }
        let mut block = nothing(class);
        let firsts = self.firsts(scope, value)?;
        let kinds = self.settled(&inner, class, &firsts, body);
        for ((name, first, _), kind) in firsts.into_iter().zip(kinds) {
            let of = |binding: &ast::Binding| {
                binding.name().filter(|word| word.name() == name).and(binding.value())
            };
            let first_value = with_of(value).and_then(|with| with.bindings().find_map(|b| of(&b)));
            let is_angle =
                first_value.is_some_and(|e| self.is_angle_of_step(scope, &kind, &Value::Expr(e)));
            self.makes(&mut inner, class, &name, kind);
            self.tell_angle_of_step(class, &name, is_angle);
            block.carried.push(Carried { name, first, next: None });
        }
        let before = match value {
            Value::While(block) => Some(self.expr_of(&inner, &block.condition()?, &Kind::Bool)?),
            _ => None,
        };
        self.programs.depth += 1;
        self.steps(&mut inner, &mut block, &members_of(Some(body.clone())));
        self.programs.depth -= 1;
        let until = match value {
            Value::Repeat(block) => match block.until() {
                Some(e) => Some(self.expr_of(&inner, &e, &Kind::Bool)?),
                None => None,
            },
            _ => None,
        };
        // `repeat while c` and `repeat n { … }` were told already
        let words =
            value.syntax().descendants_with_tokens().filter_map(syntax::NodeOrToken::into_token);
        let mut words = words.filter(|token| !token.kind().is_trivia());
        let is_misread = words.nth(1).is_some_and(|word| word.text() == "while")
            || matches!(value, Value::Repeat(block) if block.lacks_times());
        if let (Value::Repeat(_), None, None, false) = (value, &times, &until, is_misread) {
            let span = self.first_line(scope.file, value.span());
            let place = Place { file: scope.file, span };
            let message = "this loop is open: it takes one turn";
            let d = Diagnostic::warning("open-block", place, message);
            self.report(d.hint("say when it ends: `} until c`, or `repeat n times {`"));
        }
        Some(match each {
            Some((of, names)) => {
                Says::Each { names: names.into_iter().map(|(n, _)| n).collect(), of, block }
            }
            None => Says::Repeat { times, before, until, block },
        })
    }

    /// Lowers the set that a loop goes through; returns the names of an element, too.
    fn set(&mut self, scope: &Scope, range: &Expr, block: &ast::For) -> Option<(Term, Names)> {
        let (of, kind) = self.expr(scope, range)?;
        let element = match kind {
            Kind::List(element) => *element,
            Kind::Unknown | Kind::Thing(_) | Kind::Tuple(_) => Kind::Unknown,
            other => {
                self.wrong_kind(scope, range.span(), &other, &Kind::List(Box::new(Kind::Unknown)));
                return None;
            }
        };
        let words: Vec<ast::Word> = block.names().collect();
        let kinds = match words.len() {
            1 => vec![element],
            n => vec![Kind::Unknown; n],
        };
        Some((of, words.iter().map(ast::Word::name).zip(kinds).collect()))
    }

    /// Lowers what a loop carries into its first turn.
    fn firsts(&mut self, scope: &Scope, value: &Value) -> Option<Vec<(Name, Term, Kind)>> {
        let bindings = with_of(value).into_iter().flat_map(|w| w.bindings());
        let first = |binding: ast::Binding| {
            let (term, kind) = self.expr(scope, &binding.value()?)?;
            Some((binding.name()?.name(), term, kind))
        };
        bindings.map(first).collect()
    }

    /// Finds out what is carried over all turns: an object may change its class from turn to turn.
    fn settled(
        &mut self,
        scope: &Scope,
        class: ClassId,
        firsts: &[(Name, Term, Kind)],
        body: &ast::Body,
    ) -> Vec<Kind> {
        let kinds: Vec<Kind> = firsts.iter().map(|(_, _, kind)| kind.clone()).collect();
        if firsts.is_empty() {
            return kinds;
        }
        if self.programs.depth >= DEEPEST_SETTLED {
            return vec![Kind::Unknown; kinds.len()];
        }
        let members = members_of(Some(body.clone()));
        let nexts = members.iter().filter_map(|m| match m {
            Member::Next(next) => Some(next.bindings()),
            _ => None,
        });
        let nexts: Vec<ast::Binding> = nexts.flatten().collect();
        if nexts.is_empty() {
            return kinds;
        }
        self.silent += 1;
        self.programs.depth += 1;
        let mut inner = scope.clone();
        for ((name, ..), kind) in firsts.iter().zip(&kinds) {
            self.makes(&mut inner, class, name, kind.clone());
        }
        self.steps(&mut inner, &mut nothing(class), &members);
        let joined = firsts.iter().zip(kinds).map(|((name, ..), kind)| {
            let next = nexts.iter().find(|b| b.name().is_some_and(|w| w.name() == *name));
            match next.and_then(ast::Binding::value).and_then(|e| self.expr(&inner, &e)) {
                Some((_, next)) => self.general(kind, next),
                None => kind,
            }
        });
        let joined = joined.collect();
        self.programs.depth -= 1;
        self.silent -= 1;
        joined
    }

    /// Returns what can be said of both of two kinds.
    pub(crate) fn general(&self, a: Kind, b: Kind) -> Kind {
        let document = &self.document;
        match (&a, &b) {
            (Kind::Thing(a), Kind::Thing(b)) => {
                let above = document.primary_line(*b);
                let shared = document.primary_line(*a).into_iter().find(|c| above.contains(c));
                let named = shared.filter(|&c| c != self.object);
                named.map_or(Kind::Unknown, Kind::Thing)
            }
            (Kind::List(a), Kind::List(b)) => {
                Kind::List(Box::new(self.general((**a).clone(), (**b).clone())))
            }
            _ if b.fits(&a, document) => a.joined(b),
            _ => Kind::Unknown,
        }
    }

    /// Lowers both branches of an `if`. What they make is visible after it.
    fn branches(&mut self, scope: &mut Scope, class: ClassId, choice: &ast::If) -> Says {
        if let Some(condition) = choice.turned_round().or_else(|| choice.turned_twice()) {
            let span = self.first_line(scope.file, choice.span());
            let message = "this `if` is open: its condition is turned round";
            let d = Diagnostic::warning("open-block", Place { file: scope.file, span }, message);
            let hint = format!("record more of the program and end it, or write `if {condition}`");
            self.report(d.hint(hint));
        }
        let condition = choice.condition().and_then(|c| self.expr_of(scope, &c, &Kind::Bool));
        let known = scope.locals.len();
        let branch = |l: &mut Self, members: &[Member]| {
            let (mut inner, mut block) = (scope.clone(), nothing(class));
            l.steps(&mut inner, &mut block, members);
            (block, inner.locals.split_off(known))
        };
        let (then, mut made) = branch(self, &members_of(choice.then_body()));
        let other = match choice.else_branch() {
            Some(Else::Body(body)) => Some(branch(self, &members_of(Some(body)))),
            Some(Else::If(choice)) => Some(branch(self, &[Member::If(choice)])),
            None => None,
        };
        let (otherwise, others) = other.map_or((None, Vec::new()), |(b, n)| (Some(b), n));
        for (name, kind) in others {
            match made.iter_mut().find(|(n, _)| *n == name) {
                Some((_, known)) => *known = self.general(known.clone(), kind),
                None => made.push((name, kind)),
            }
        }
        for (name, kind) in made {
            self.makes(scope, class, &name, kind);
        }
        match condition {
            Some(condition) => Says::If { condition, then, otherwise },
            None => Says::Unclear,
        }
    }

    fn erased(&mut self, scope: &Scope, path: &Expr) -> Option<Name> {
        let name = match path {
            Expr::Name(name) => name.name(),
            _ => None,
        };
        let Some(word) = name else {
            let message = "what a step made is erased as a whole, by its name".to_string();
            self.error("not-a-step", scope.file, path.span(), message);
            return None;
        };
        if scope.local(&word.name()).is_none() {
            self.expr(scope, path)?;
            let message = format!("{} is no step of this program", word.text());
            self.error("not-a-step", scope.file, word.span(), message);
            return None;
        }
        Some(word.name())
    }

    /// Lowers what an object is in the next turn.
    fn next(&mut self, scope: &Scope, block: &mut Block, binding: &ast::Binding) {
        let (Some(word), Some(value)) = (binding.name(), binding.value()) else { return };
        let name = word.name();
        let kind = scope.local(&name).cloned().unwrap_or(Kind::Unknown);
        let Some(carried) = block.carried.iter_mut().find(|c| c.name == name) else {
            let message = format!("this block carries no {name} from turn to turn");
            let place = Place { file: scope.file, span: word.span() };
            let d = Diagnostic::error("not-carried", place, message);
            return self.report(d.hint(format!("say what it is first: `with {name} = …`")));
        };
        let lowered = self.expr(scope, &value);
        if let Some((term, found)) = lowered {
            carried.next = Some(measured(&self.document, term, &found, &kind));
        }
    }
}

/// The condition that a parameter has one of the values that are allowed.
fn within(name: &Name, allowed: Allowed) -> Term {
    let me = || Box::new(Term::send(Term::Me, name));
    match allowed {
        Allowed::Range { least, most } => {
            let less = |is_outside| match is_outside {
                true => BinaryOperator::Less,
                false => BinaryOperator::LessEqual,
            };
            let least = least.map(|b| Term::Binary(less(b.is_outside), Box::new(b.value), me()));
            let most = most.map(|b| Term::Binary(less(b.is_outside), me(), Box::new(b.value)));
            match (least, most) {
                (Some(least), Some(most)) => {
                    Term::Binary(BinaryOperator::And, Box::new(least), Box::new(most))
                }
                (one, other) => one.or(other).unwrap_or(Term::Bool(true)),
            }
        }
        Allowed::OneOf(values) => {
            Term::Binary(BinaryOperator::In, me(), Box::new(Term::List(values)))
        }
    }
}
