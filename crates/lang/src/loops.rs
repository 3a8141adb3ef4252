//! Loops: members that `for` repeats, over a range of constants or over a list.
//!
//! What is declared in a loop is a list with an element for every turn (`loops/declared.rs`); in the
//! loop its name means the element of the turn.

mod decided;
mod declared;
mod listed;

use crate::lower::Lowerer;
use crate::members::Pending;
use crate::scope::{Constant, Scope};
use base::{Diagnostic, Name, Place};
pub(crate) use decided::decided;
pub(crate) use declared::Repeated;
use declared::{declared_names, is_declaration};
use kernel::{ClassId, ClassKind, Path, Primitive, Step};
use listed::{Listed, inside, zipped};
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr, Member};

/// How many members all `for` of a document may come to.
pub(crate) const MOST_MEMBERS: usize = 1_000_000;

/// What a loop goes through.
pub(crate) struct Turns {
    pub(crate) count: u32,
    over: Over,
    /// The names that the loop binds.
    bound: Vec<Name>,
    /// The names of what is declared in it.
    declared: Vec<Name>,
}

/// What a loop binds its name to in one turn, where the text lists it.
enum Written {
    Constant(Constant),
    Thing { path: Path, class: Option<ClassId> },
}

enum Over {
    /// Whole numbers from these on, one for each name.
    Numbers(Vec<i64>),
    /// What is written, one row after the other, with as many in each as there are names.
    Written(Vec<Vec<Written>>),
    /// Elements of a list, as many at a time as there are names.
    Elements { path: Path, element: ClassId },
}

impl Lowerer<'_> {
    /// Repeats members for every number of a range; a loop over what is known later waits.
    pub(crate) fn unroll(&mut self, scope: &Scope, each: &ast::For) {
        if scope.turns.is_empty() {
            self.declare_loop(scope, each);
        }
        match each.range() {
            None => {}
            Some(range) if self.constant_range(scope, &range).is_some() => {
                self.take_turns(scope, each, 0);
            }
            // how long a list is, is known once all parts are declared
            Some(_) => {
                self.pending.push(Pending::Each {
                    scope: Rc::new(scope.clone()),
                    each: each.clone(),
                    from: 0,
                });
            }
        }
    }

    /// Declares the members of every turn of a loop, but for so many first ones.
    pub(crate) fn take_turns(&mut self, scope: &Scope, each: &ast::For, from: u32) {
        let Some(range) = each.range() else { return };
        let Some(turns) = self.turns(scope, each) else { return };
        let members = members_of(each);
        let most = turns.count.saturating_sub(from) as usize;
        if !self.may_take(scope, &range, most, &members) {
            return;
        }
        for turn in from..turns.count {
            let inner = turn_of(scope, &turns, turn);
            self.take_turn(&inner, each, &members);
        }
    }

    /// Counts the members of so many turns of a loop, before they are made: where loops in it make too many, nothing is
    /// begun.
    pub(crate) fn may_take(
        &mut self,
        scope: &Scope,
        range: &Expr,
        turns: usize,
        members: &[Member],
    ) -> bool {
        let whole = turns.saturating_mul(self.fewest(scope, members));
        let own = turns.saturating_mul(members.len().max(1));
        let counted = if self.unrolled.saturating_add(whole) > MOST_MEMBERS { whole } else { own };
        self.may_unroll(scope, range, counted)
    }

    /// Returns how many members these come to at least: loops in them over what is written out or is a list whose
    /// length is known here count with all their turns.
    fn fewest(&mut self, scope: &Scope, members: &[Member]) -> usize {
        let mut all: usize = 0;
        for member in members {
            let count = match member {
                Member::For(each) => {
                    let known = through(each).and_then(|list| self.length_of(scope, &list));
                    let written = || each.range().map_or(1, |range| written_turns(&range));
                    let turns = known.map_or_else(written, |n| n as usize);
                    turns.saturating_mul(self.fewest(scope, &members_of(each)))
                }
                _ => 1,
            };
            all = all.saturating_add(count);
        }
        all.max(1)
    }

    /// Counts members that `for` makes, before they are made; reports once that there are too many.
    pub(crate) fn may_unroll(&mut self, scope: &Scope, range: &Expr, members: usize) -> bool {
        let was = self.unrolled;
        self.unrolled = was.saturating_add(members);
        if was <= MOST_MEMBERS && self.unrolled > MOST_MEMBERS {
            let message = format!("`for` makes more than {MOST_MEMBERS} members here");
            self.error("too-many-members", scope.file, range.span(), message);
        }
        self.unrolled <= MOST_MEMBERS
    }

    /// Finds what a loop goes through, and how many turns that takes.
    pub(crate) fn turns(&mut self, scope: &Scope, each: &ast::For) -> Option<Turns> {
        let (count, over) = self.gone_through(scope, each)?;
        let bound = each.names().map(|word| word.name()).collect();
        Some(Turns { count, over, bound, declared: declared_names(each) })
    }

    fn gone_through(&mut self, scope: &Scope, each: &ast::For) -> Option<(u32, Over)> {
        let range = each.range()?;
        let (over, together) = match &range {
            Expr::Range(_) => (None, 1),
            Expr::Field(field)
                if field.args().is_none()
                    && field.name().is_some_and(|w| w.text() == "neighbours") =>
            {
                (Some(field.receiver()?), 2)
            }
            other => (Some(other.clone()), 1),
        };
        let named = each.names().count();
        if let Some(options) = self.all_options(scope, &range).filter(|_| named == 1) {
            return Some(options);
        }
        if let Some(rows) = over.as_ref().filter(|_| together == 1) {
            let written = self.listed(scope, rows);
            // names of things are looked for where they stand
            let is_here = matches!(rows, Expr::List(_) | Expr::Tuple(_));
            let are_constants =
                |l: &mut Self, written: &Listed| named > 1 || l.are_constants(scope, written);
            if let Some(written) = written.filter(|w| is_here || are_constants(self, w)) {
                return self.written_rows(scope, each, &written);
            }
        }
        if let Some((one, other)) = zipped(&range).filter(|_| named == 2) {
            return self.zipped_rows(scope, &one, &other);
        }
        if named != together as usize {
            let message = format!("{named} names for {together} at a time");
            self.refuse_names(scope, each, message);
            return None;
        }
        let Some(list) = over else {
            let Some((from, to)) = self.constant_range(scope, &range) else {
                self.refuse_range(scope, &range);
                return None;
            };
            return Some((turns_of((from, to)), Over::Numbers(vec![from])));
        };
        if !matches!(list, Expr::Name(_) | Expr::Field(_) | Expr::Index(_) | Expr::Paren(_)) {
            let place = Place { file: scope.file, span: list.span() };
            let message = "a `for` goes through a range of whole numbers, a list that is a part, or what is listed";
            let d = Diagnostic::error("not-a-path", place, message);
            let counted = matches!(list, Expr::Number(_));
            let number = list.syntax().text();
            let range = match &list {
                Expr::Call(call) if call.name().is_some_and(|word| word.text() == "range") => {
                    call.args().and_then(|args| args.args().last()?.value())
                }
                _ => None,
            };
            self.report_whole(match counted {
                _ if let Some(end) = range => {
                    let end = end.syntax().text();
                    d.hint(format!("write `0..<{end}` for the numbers below {end}"))
                }
                true => d.hint(format!("write `0..<{number}` for the numbers below {number}")),
                false => d.hint("declare the list as a part, or write `for a in [b, c]`"),
            });
            return None;
        }
        let (path, class) = self.path(scope, &list)?;
        let Some(element) = class.and_then(|c| self.element(c)) else {
            let place = Place { file: scope.file, span: list.span() };
            let d =
                Diagnostic::error("value-of-wrong-class", place, format!("{path} is not a list"));
            let is_whole = class.is_some_and(|c| {
                self.document.classes[c].kind == ClassKind::Primitive(Primitive::Integer)
            });
            self.report(match is_whole {
                true => d.hint(format!("write `0..<{path}` for the numbers below {path}")),
                false => d,
            });
            return None;
        };
        // a list of the thing's own that nothing is said of is empty; what gives it elements goes on
        let empty = || own_list(scope, &list).map(|_| 0);
        let Some(elements) = self.length_at(scope, &path).or_else(empty) else {
            let place = Place { file: scope.file, span: list.span() };
            let message = format!("how many elements {path} has is not said where it is declared");
            let d = Diagnostic::error("not-a-count", place, message);
            self.report(d.hint("declare it as `List of 3 C`, or with its elements, `= [a, b]`"));
            return None;
        };
        let count = elements.saturating_sub(together - 1);
        Some((count, Over::Elements { path, element }))
    }

    /// Reports a range that is not known as the text stands.
    fn refuse_range(&mut self, scope: &Scope, range: &impl AstNode) {
        let place = Place { file: scope.file, span: range.span() };
        let message = "a `for` goes through whole numbers that are known as the text stands";
        let d = Diagnostic::error("not-a-count", place, message);
        self.report(d.hint("write `0..3`, or go through a list: `for a in list`"));
    }

    /// Loops of a class go on in what gives a list that they go through more elements.
    pub(crate) fn continue_loops(&mut self) {
        let waiting = self.pending.iter().filter_map(|p| match p {
            Pending::Each { scope, each, from: 0 } if scope.turns.is_empty() => {
                let name = own_list(scope, &through(each)?)?;
                (scope.classes.len() == 1).then(|| (name, (**scope).clone(), each.clone()))
            }
            _ => None,
        });
        let loops: Vec<(Name, Scope, ast::For)> = waiting.collect();
        for (name, scope, each) in loops {
            let giving: Vec<ClassId> = self
                .given_counts
                .keys()
                .filter(|(class, given)| *given == name && *class != scope.class())
                .map(|&(class, _)| class)
                .collect();
            for class in giving {
                if !self.document.primary_line(class).contains(&scope.class()) {
                    continue;
                }
                let above = self.document.classes[class].supers.first().map(|s| s.class);
                let before = above.and_then(|c| self.given_count(c, &name)).unwrap_or(0);
                let together = each.names().count() as u32;
                let from = before.saturating_sub(together.saturating_sub(1));
                let declared_by = scope.class();
                let scope = Scope::of(scope.file, class);
                self.redeclare_loop(declared_by, &scope, &each);
                let scope = Rc::new(scope);
                self.pending.push(Pending::Each { scope, each: each.clone(), from });
            }
        }
    }

    /// Returns true for a value that a loop of the class goes through: what has it is a class of one.
    pub(crate) fn is_looped(&self, class: ClassId, name: &Name) -> bool {
        self.document.lineage(class).into_iter().any(|c| {
            let body = self.text_of(c).and_then(|(_, _, text)| text.body());
            body.into_iter().flat_map(|b| b.members()).any(|m| match &m {
                Member::For(each) => {
                    let list = through(each);
                    matches!(list, Some(Expr::Name(n)) if n.name().is_some_and(|w| w.name() == *name))
                }
                _ => false,
            })
        })
    }

    /// Declares the members of one turn, in which the names of its parts mean this turn's elements.
    fn take_turn(&mut self, scope: &Scope, each: &ast::For, members: &[Member]) {
        for member in members {
            match member {
                Member::Part(part) if part.definition().is_none() => {
                    for name in part.names().map(|w| w.name()) {
                        self.give_turn(scope, each, part, &name);
                    }
                }
                Member::Ref(reference) => {
                    let (Some(word), Some(target)) = (reference.name(), reference.target()) else {
                        continue;
                    };
                    let path = of_turn(scope, word.name());
                    let scope = Rc::new(scope.clone());
                    self.pending.push(if reference.is_absolute() {
                        Pending::Absolute { scope, path, target }
                    } else {
                        Pending::Value { scope, prefix: path.0, target: None, value: target }
                    });
                }
                _ => {}
            }
        }
        let others = members.iter().filter(|m| !is_declaration(m)).cloned().collect();
        self.declare_body(scope, others);
    }

    /// Gives the element of a turn its values.
    fn give_turn(&mut self, scope: &Scope, each: &ast::For, part: &ast::Part, name: &Name) {
        let prefix = of_turn(scope, name.clone()).0;
        let whole = part.value().and_then(ast::Value::expr);
        let whole = whole.map(|value| (None, value));
        let element = part.class().and_then(|ty| self.class_of_element(scope, &ty));
        let is_of_turns = |b: &ast::Body| element.is_some_and(|e| self.is_of_turns(e, each, b));
        let body = part.body().filter(is_of_turns);
        let members = body.iter().flat_map(ast::Body::members).collect::<Vec<_>>();
        let assigned = members.into_iter().filter_map(|member| match member {
            Member::Assign(assign) => {
                let value = assign.value().and_then(ast::Value::expr)?;
                Some((Some(assign.target()?), value))
            }
            _ => None,
        });
        for (target, value) in whole.into_iter().chain(assigned) {
            let (scope, prefix) = (Rc::new(scope.clone()), prefix.clone());
            self.pending.push(Pending::Value { scope, prefix, target, value });
        }
    }
}

/// Returns the scope of one turn, in which what is declared in the loop means the turn's own.
pub(crate) fn turn_of(scope: &Scope, turns: &Turns, turn: u32) -> Scope {
    let mut inner = scope.clone();
    for (i, name) in (0..).zip(&turns.bound) {
        match &turns.over {
            Over::Numbers(from) => {
                let number = Constant::Whole(from[i as usize] + i64::from(turn));
                inner.bind_constant(name.clone(), number);
            }
            Over::Written(rows) => match &rows[turn as usize][i as usize] {
                Written::Constant(constant) => {
                    inner.bind_constant(name.clone(), constant.clone());
                }
                Written::Thing { path, class } => {
                    inner.bind_element(name.clone(), path.clone(), *class);
                }
            },
            Over::Elements { path, element } => {
                let path = path.then(Step::Index(turn + i));
                inner.bind_element(name.clone(), path, Some(*element));
            }
        }
    }
    inner.turns.push(turn);
    for name in &turns.declared {
        let path = of_turn(&inner, name.clone());
        inner.bind_element(name.clone(), path, None);
    }
    inner
}

/// Returns the path to the element of a turn, of the list of this name.
fn of_turn(scope: &Scope, name: Name) -> Path {
    let indices = scope.turns.iter().map(|&i| Step::Index(i));
    Path(std::iter::once(Step::Part(name)).chain(indices).collect())
}

/// Returns the list that a loop goes through.
fn through(each: &ast::For) -> Option<Expr> {
    match each.range()? {
        Expr::Range(_) => None,
        Expr::Field(field) if field.name().is_some_and(|w| w.text() == "neighbours") => {
            field.receiver()
        }
        other => Some(other),
    }
}

/// Returns how many turns a loop from one whole number to another takes.
fn turns_of((from, to): (i64, i64)) -> u32 {
    let count = to.saturating_sub(from).saturating_add(1).max(0);
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Returns the name of a list that is a part of the scope's own things.
fn own_list(scope: &Scope, list: &Expr) -> Option<Name> {
    let Expr::Name(name) = list else { return None };
    let name = name.name()?.name();
    scope.element(&name).is_none().then_some(name)
}

/// Returns how many turns a loop takes where its range is two numbers, or its pairs are of such ranges; else one.
fn written_turns(range: &Expr) -> usize {
    let Expr::Range(range) = inside(range) else {
        let pairs = zipped(range);
        return pairs.map_or(1, |(one, other)| written_turns(&one).min(written_turns(&other)));
    };
    match (range.start(), range.end()) {
        (Some(Expr::Number(from)), Some(Expr::Number(to))) => {
            let ends = from.value().zip(to.value());
            let last = f64::from(u8::from(!range.is_open()));
            ends.map_or(1, |(from, to)| (to - from + last).max(0.0) as usize)
        }
        _ => 1,
    }
}

pub(crate) fn members_of(each: &ast::For) -> Vec<Member> {
    each.body().into_iter().flat_map(|b| b.members()).collect()
}
