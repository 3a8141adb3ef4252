//! Loops: members that `for` repeats, over a range of constants or over a list.
//!
//! A part that is declared in a loop is a list with an element for every turn; in the loop its name
//! means the element of the turn.

use crate::lower::Lowerer;
use crate::members::{Pending, values_alone};
use crate::scope::Scope;
use base::{Diagnostic, Name, Place};
use kernel::{ClassId, ClassKind, Count, Part, Path, Step};
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr, Member, span_without_doc};

/// How many members all `for` of a document may come to.
const MOST_MEMBERS: usize = 1_000_000;

/// A list that a loop goes through.
struct Through {
    path: Path,
    element: ClassId,
    /// How many elements a turn is about.
    together: u32,
    turns: u32,
}

impl Lowerer<'_> {
    /// Repeats members for every number of a range; a loop over a list waits.
    pub(crate) fn unroll(&mut self, scope: &Scope, each: &ast::For) {
        let names: Vec<_> = each.names().collect();
        let Some(range) = each.range() else { return };
        if !matches!(range, Expr::Range(_)) {
            // how long a list is, is known once all parts are declared
            return self.pending.push(Pending::Each { scope: scope.clone(), each: each.clone() });
        }
        let bounds = self.constant_range(scope, &range);
        let ([name], Some((from, to))) = (names.as_slice(), bounds) else {
            let what = "`for` over a range that is not of constants is";
            return self.not_yet(scope.file, range.span(), what);
        };
        let turns = u32::try_from(to - from + 1).unwrap_or(0);
        self.declare_turns(scope, each, turns);
        let members = members_of(each);
        for i in from..=to {
            if !self.may_unroll(scope, &range, members.len()) {
                return;
            }
            let inner = scope.with_constant(name.name(), i);
            self.take_turn(&inner, each, &members, (i - from) as u32);
        }
    }

    /// Counts members that `for` makes; reports once that there are too many.
    fn may_unroll(&mut self, scope: &Scope, range: &Expr, members: usize) -> bool {
        let was = self.unrolled;
        self.unrolled += members.max(1);
        if was <= MOST_MEMBERS && self.unrolled > MOST_MEMBERS {
            let message = format!("`for` makes more than {MOST_MEMBERS} members here");
            self.error("too-many-members", scope.file, range.span(), message);
        }
        self.unrolled <= MOST_MEMBERS
    }

    /// Declares what loops over lists declare, once the lists are declared.
    pub(crate) fn declare_repeated(&mut self) {
        let loops = self.pending.iter().filter_map(|p| match p {
            Pending::Each { scope, each } => Some((scope.clone(), each.clone())),
            _ => None,
        });
        for (scope, each) in loops.collect::<Vec<_>>() {
            if !each.body().is_some_and(|b| b.members().any(|m| is_declaration(&m))) {
                continue;
            }
            self.silent += 1;
            let through = self.through(&scope, &each);
            self.silent -= 1;
            if let Some(through) = through {
                self.declare_turns(&scope, &each, through.turns);
            }
        }
    }

    /// Repeats members for every element of a list, or for every pair of neighbours.
    pub(crate) fn unroll_list(&mut self, scope: &Scope, each: &ast::For) {
        let Some(range) = each.range() else { return };
        let Some(through) = self.through(scope, each) else { return };
        let names: Vec<Name> = each.names().map(|w| w.name()).collect();
        let members = members_of(each);
        if !scope.constants.is_empty() || !scope.elements.is_empty() {
            self.declare_turns(scope, each, 0);
        }
        for turn in 0..through.turns {
            if !self.may_unroll(scope, &range, members.len()) {
                return;
            }
            let bind = |scope: Scope, (i, name): (u32, &Name)| {
                let path = through.path.then(Step::Index(turn + i));
                scope.with_element(name.clone(), path, Some(through.element))
            };
            let inner = (0..through.together).zip(&names).fold(scope.clone(), bind);
            self.take_turn(&inner, each, &members, turn);
        }
    }

    /// Finds the list that a loop goes through, and how many turns that takes.
    fn through(&mut self, scope: &Scope, each: &ast::For) -> Option<Through> {
        let range = each.range()?;
        let named = each.names().count();
        let (list, together) = match &range {
            Expr::Field(field)
                if field.args().is_none()
                    && field.name().is_some_and(|w| w.text() == "neighbours") =>
            {
                (field.receiver()?, 2)
            }
            other => (other.clone(), 1),
        };
        if !matches!(list, Expr::Name(_) | Expr::Field(_) | Expr::Index(_) | Expr::Paren(_)) {
            let what = "`for` over anything but a range or a list that is a part is";
            self.not_yet(scope.file, list.span(), what);
            return None;
        }
        if named != together as usize {
            let message = format!("{named} names for {together} elements at a time");
            let place = Place { file: scope.file, span: each.span() };
            let d = Diagnostic::error("wrong-arity", place, message);
            self.report(d.hint("`for a in list`, `for a, b in list.neighbours`"));
            return None;
        }
        let (path, class) = self.path(scope, &list)?;
        let Some(element) = class.and_then(|c| self.element(c)) else {
            let message = format!("{path} is not a list");
            self.error("value-of-wrong-class", scope.file, list.span(), message);
            return None;
        };
        let counted = class.and_then(|c| self.document.classes[c].count);
        let count = counted.or_else(|| self.count_of(scope, &list));
        let Some(count) = count.or_else(|| self.given_count(scope, &list)) else {
            let what = "`for` over a list without a count, `List of 3 C` or `= [a, b]`, is";
            self.not_yet(scope.file, list.span(), what);
            return None;
        };
        Some(Through { path, element, together, turns: (count + 1).saturating_sub(together) })
    }

    /// Declares the parts of a loop's body: each is a list with an element for every turn.
    fn declare_turns(&mut self, scope: &Scope, each: &ast::For, turns: u32) {
        for member in members_of(each).into_iter().filter(is_declaration) {
            let span = span_without_doc(member.syntax());
            if !scope.constants.is_empty() || !scope.elements.is_empty() {
                self.not_yet(scope.file, span, "declarations in a `for` inside of another are");
                continue;
            }
            match &member {
                Member::Part(part) if part.definition().is_none() => {
                    self.declare_list(scope, each, part, turns);
                }
                Member::Ref(reference) => {
                    let (Some(word), Some(ty)) = (reference.name(), reference.class()) else {
                        continue;
                    };
                    let Some(to) = self.class_of_type(scope.file, &ty) else {
                        self.broken.insert((scope.class(), word.name()));
                        continue;
                    };
                    let element = self.reference_to(to);
                    let doc = reference.doc().unwrap_or_default();
                    self.add_list(scope, &word, element, turns, (doc, None, span));
                }
                _ => self.not_yet(scope.file, span, "messages in `for` are"),
            }
        }
    }

    fn declare_list(&mut self, scope: &Scope, each: &ast::For, part: &ast::Part, turns: u32) {
        let Some(ty) = part.class() else { return };
        let Some(element) = self.class_of_element(scope.file, &ty) else {
            return self.broken.extend(part.names().map(|w| (scope.class(), w.name())));
        };
        let range = part.domain().and_then(|d| self.domain(scope, &d, element));
        let span = span_without_doc(part.syntax());
        for word in part.names() {
            let body = part.body().filter(|b| !is_of_turns(each, b));
            if body.as_ref().is_some_and(|b| varies(each, b)) {
                let what = "bodies of more than values that speak of what a `for` goes through are";
                return self.not_yet(scope.file, span, what);
            }
            let origin = self.origin(scope.file, span);
            let element = self.class_for_body(scope, &word.name(), element, body, origin);
            let doc = part.doc().unwrap_or_default();
            self.add_list(scope, &word, element, turns, (doc, range, span));
        }
    }

    fn add_list(
        &mut self,
        scope: &Scope,
        word: &ast::Word,
        element: ClassId,
        turns: u32,
        (doc, range, span): (String, Option<(i64, i64)>, base::Span),
    ) {
        if !self.is_new(scope, word) {
            return;
        }
        let class = self.class_made_of("List of", ClassKind::List(element), element);
        let origin = self.origin(scope.file, span);
        let count = Some(Count::Fixed(turns));
        let part = Part { name: word.name(), doc, class, count, range, origin };
        self.add_part(Place { file: scope.file, span: word.span() }, scope.class(), part);
    }

    /// Declares the members of one turn, in which the names of its parts mean this turn's elements.
    fn take_turn(&mut self, scope: &Scope, each: &ast::For, members: &[Member], turn: u32) {
        let (parts, others): (Vec<Member>, Vec<Member>) =
            members.iter().cloned().partition(is_declaration);
        let mut inner = scope.clone();
        let mut values: Vec<(Name, Option<Expr>, Expr)> = Vec::new();
        for member in &parts {
            let words: Vec<ast::Word> = match member {
                Member::Part(part) => part.names().collect(),
                Member::Ref(reference) => reference.name().into_iter().collect(),
                _ => Vec::new(),
            };
            for name in words.iter().map(ast::Word::name) {
                let path = Path(vec![Step::Part(name.clone()), Step::Index(turn)]);
                let class = self.class_at(scope.class(), &path);
                inner = inner.with_element(name.clone(), path, class);
                match member {
                    Member::Part(part) => {
                        let whole = part.value().and_then(ast::Value::expr);
                        values.extend(whole.map(|value| (name.clone(), None, value)));
                        let body = part.body().filter(|b| is_of_turns(each, b));
                        for assign in body.iter().flat_map(ast::Body::members) {
                            let Member::Assign(assign) = assign else { continue };
                            let value = assign.value().and_then(ast::Value::expr);
                            let given = assign.target().zip(value);
                            values.extend(given.map(|(t, v)| (name.clone(), Some(t), v)));
                        }
                    }
                    Member::Ref(r) if r.is_absolute() => {
                        let path = Path(vec![Step::Part(name.clone()), Step::Index(turn)]);
                        let (scope, target) = (scope.clone(), r.target());
                        let absolute =
                            target.map(|target| Pending::Absolute { scope, path, target });
                        self.pending.extend(absolute);
                    }
                    Member::Ref(r) => {
                        values.extend(r.target().map(|value| (name.clone(), None, value)));
                    }
                    _ => {}
                }
            }
        }
        for (name, target, value) in values {
            let prefix = vec![Step::Part(name), Step::Index(turn)];
            self.pending.push(Pending::Value { scope: inner.clone(), prefix, target, value });
        }
        self.declare_body(&inner, others);
    }
}

fn members_of(each: &ast::For) -> Vec<Member> {
    each.body().into_iter().flat_map(|b| b.members()).collect()
}

fn is_declaration(member: &Member) -> bool {
    matches!(member, Member::Part(_) | Member::Message(_) | Member::Ref(_))
}

/// Returns true for a body of values that every turn says for itself.
fn is_of_turns(each: &ast::For, body: &ast::Body) -> bool {
    let members: Vec<Member> = body.members().collect();
    let values = members.iter().all(|m| matches!(m, Member::Assign(_)));
    values && (varies(each, body) || values_alone(&members).is_some())
}

/// Returns true for a body that speaks of what a loop goes through.
fn varies(each: &ast::For, body: &ast::Body) -> bool {
    let is_variable = |node: syntax::SyntaxNode| {
        let text = node.text().to_string();
        node.kind() == SyntaxKind::NameExpr && each.names().any(|w| w.text() == text.trim())
    };
    body.syntax().descendants().any(is_variable)
}
