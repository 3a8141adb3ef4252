//! Checks: the `check` blocks of the document, as data.
//!
//! A check's own members are kept as text: whoever runs the check adds them to a copy of the
//! document. Its statements are lowered as if they stood at the end of that copy.

use crate::kinds::Kind;
use crate::loops::{members_of, turn_of};
use crate::lower::{Lowerer, OWN};
use crate::paths::loose_path;
use crate::scope::Scope;
use crate::terms::operator_of;
use base::{Diagnostic, Name, Place, Span};
use kernel::{BinaryOperator, ClassId, Command, Literal, Path, Step, Term};
use std::rc::Rc;
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Member};

/// A `check` block.
#[derive(Clone, PartialEq, Debug)]
pub struct Check {
    /// What it promises.
    pub title: String,
    /// Where it stands in the document's own text.
    pub span: Span,
    /// Its own parts, merges and constraints, as written.
    pub members: Vec<Rc<str>>,
    /// What it does and expects, in order.
    pub statements: Vec<Statement>,
}

/// A statement of a check.
#[derive(Clone, PartialEq, Debug)]
pub struct Statement {
    /// What it says.
    pub kind: StatementKind,
    /// Where it stands.
    pub span: Span,
    /// Whether it gives a value a name.
    pub is_note: bool,
    /// Where the loop or condition stands that it is part of, the outermost; else where it stands.
    pub whole: Span,
}

/// What a statement says.
#[derive(Clone, PartialEq, Debug)]
pub enum StatementKind {
    /// `set path to value, …`
    Set(Vec<(Path, Term)>),
    /// `move path to value, …`
    Move(Vec<(Path, Term)>),
    /// `let name = e`: the value that an expression has now.
    Note(Name, Term),
    /// Any other edit.
    Command(Command),
    /// `try …`
    Try(Box<StatementKind>),
    /// `expect …`
    Expect(Expectation),
    /// What means nothing as the document stands; a statement before it may change that.
    Unclear,
}

/// What is expected.
#[derive(Clone, PartialEq, Debug)]
pub enum Expectation {
    /// That a rule is true, to a tolerance.
    Rule {
        /// The rule.
        rule: Term,
        /// The tolerance, where one is written.
        within: Option<Term>,
    },
    /// That every required constraint holds.
    Satisfied,
    /// That the latest edit moved these and no others.
    Moved(Vec<Path>),
    /// How many degrees of freedom there are.
    Free(Counted),
    /// How many solutions what is searched has.
    Solutions(Counted),
    /// The heaviest kind of the latest plan.
    Plan(PlanKind),
    /// That the latest `try` was refused with this word.
    Error(String),
}

/// How many there have to be of something: `= 3`, `>= 1`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Counted {
    /// How the number is compared.
    pub operator: BinaryOperator,
    /// What it is compared with.
    pub n: u64,
}

impl Counted {
    /// Returns whether so many are as many as there have to be.
    pub fn holds(self, found: u64) -> bool {
        match self.operator {
            BinaryOperator::NotEqual => found != self.n,
            BinaryOperator::Less => found < self.n,
            BinaryOperator::LessEqual => found <= self.n,
            BinaryOperator::Greater => found > self.n,
            BinaryOperator::GreaterEqual => found >= self.n,
            _ => found == self.n,
        }
    }
    /// Returns how many are enough to know, however many more there are.
    pub fn enough(self) -> u64 {
        match self.operator {
            BinaryOperator::Less | BinaryOperator::GreaterEqual => self.n,
            _ => self.n.saturating_add(1),
        }
    }
}

impl std::fmt::Display for Counted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let sign = match self.operator {
            BinaryOperator::NotEqual => "!= ",
            BinaryOperator::Less => "< ",
            BinaryOperator::LessEqual => "<= ",
            BinaryOperator::Greater => "> ",
            BinaryOperator::GreaterEqual => ">= ",
            _ => "",
        };
        write!(f, "{sign}{}", self.n)
    }
}

/// How heavy a plan is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PlanKind {
    /// Every step computes what it writes from what is known.
    OnePass,
    /// Some steps are solved together.
    Block,
    /// Some steps have no certificate of convergence.
    Relaxation,
    /// Whole numbers are searched.
    Search,
}

/// Returns a text without its `check` and `lesson` blocks.
pub fn without_checks(text: &str) -> String {
    let file = syntax::parse(OWN, text).file();
    let checks = file.members().filter(|m| matches!(m, Member::Check(_) | Member::Lesson(_)));
    let edits: Vec<_> = checks.map(|m| syntax::edit::delete_member(m.syntax())).collect();
    syntax::edit::apply(text, &edits)
}

/// Lowers the checks of the document's own text.
pub(crate) fn lower(l: &mut Lowerer<'_>) -> Vec<Check> {
    let mut checks = Vec::new();
    for member in l.files[OWN].members_of(&[SyntaxKind::Check]) {
        let Member::Check(check) = member else { continue };
        checks.push(lower_check(l, &check));
    }
    checks
}

fn lower_check(l: &mut Lowerer<'_>, check: &ast::Check) -> Check {
    let members: Vec<Member> = check.body().into_iter().flat_map(|b| b.members()).collect();
    let (own, statements): (Vec<Member>, Vec<Member>) =
        members.into_iter().partition(|m| !is_statement(m));
    let class = class_of_check(l, &own);
    let mut scope = Scope::of(OWN, class);
    let mut lowered = Vec::new();
    let mut restructured = false;
    for member in &statements {
        let whole = ast::span_without_doc(member.syntax());
        let before = lowered.len();
        let one = std::slice::from_ref(member);
        lower_statements(l, &mut scope, one, (&mut lowered, &mut restructured));
        lowered.iter_mut().skip(before).for_each(|s: &mut Statement| s.whole = whole);
    }
    let is_broken = check.syntax().descendants().any(|node| node.kind() == SyntaxKind::Error);
    if let (Some(name), true) =
        (check.name(), statements.is_empty() && !own.is_empty() && !is_broken)
    {
        let place = Place { file: OWN, span: name.span() };
        let d = Diagnostic::warning("nothing-expected", place, "nothing is expected in this check");
        l.report(d.hint("what is to be true is expected: `expect x = 3`; `x = 3` gives a value"));
    }
    Check {
        title: check.name().map(|w| w.unquoted()).unwrap_or_default(),
        span: ast::span_without_doc(check.syntax()),
        members: own.iter().map(|m| m.syntax().text().to_string().into()).collect(),
        statements: lowered,
    }
}

/// Lowers statements in order; those in a `for` once for every turn, those under a condition of constants where it
/// holds.
fn lower_statements(
    l: &mut Lowerer<'_>,
    scope: &mut Scope,
    statements: &[Member],
    (lowered, restructured): (&mut Vec<Statement>, &mut bool),
) {
    for member in statements {
        match member {
            Member::For(each) => {
                let members = members_of(each);
                let (Some(turns), Some(range)) = (l.turns(scope, each), each.range()) else {
                    continue;
                };
                if !l.may_take(scope, &range, turns.count as usize, &members) {
                    return;
                }
                for turn in 0..turns.count {
                    let mut inner = turn_of(scope, &turns, turn);
                    lower_statements(l, &mut inner, &members, (&mut *lowered, &mut *restructured));
                }
            }
            Member::If(choice) => {
                let chosen = l.chosen(scope, choice).unwrap_or_default();
                lower_statements(
                    l,
                    &mut scope.clone(),
                    &chosen,
                    (&mut *lowered, &mut *restructured),
                );
            }
            _ => {
                let span = ast::span_without_doc(member.syntax());
                // what stands after an edit of the structure can be told only once that edit is made
                let silent = u32::from(*restructured);
                l.silent += silent;
                let kind = match member {
                    Member::Note(note) => noted(l, scope, note),
                    member => statement(l, scope, member),
                };
                let kind = kind.unwrap_or(StatementKind::Unclear);
                l.silent -= silent;
                *restructured |= restructures(l, scope.class(), &kind);
                let is_note = matches!(member, Member::Note(_));
                lowered.push(Statement { kind, span, is_note, whole: span });
            }
        }
    }
}

/// Lowers a value that is given a name, which the statements behind it know.
fn noted(l: &mut Lowerer<'_>, scope: &mut Scope, note: &ast::Note) -> Option<StatementKind> {
    let name = note.name()?.name();
    let found = l.expr(scope, &note.value()?);
    let kind = found.as_ref().map_or(Kind::Unknown, |(_, kind)| kind.clone());
    *scope = scope.with_local(name.clone(), kind);
    Some(StatementKind::Note(name, found?.0))
}

/// Makes a class for the names that the check's statements see: the document's and its own.
fn class_of_check(l: &mut Lowerer<'_>, own: &[Member]) -> ClassId {
    let root = l.document.root;
    if own.is_empty() {
        return root;
    }
    let origin = l.document.classes[root].origin;
    let class = l.add_unnamed_class("", root, origin);
    l.declare_body(&Scope::of(OWN, class), own.to_vec());
    l.define_members();
    class
}

/// Returns true for an edit after which other names may be known.
fn restructures(l: &Lowerer<'_>, class: ClassId, statement: &StatementKind) -> bool {
    let is_count = |path: &Path| {
        let Some((Step::Part(name), owner)) = path.0.split_last() else { return false };
        let owner = l.class_at(class, &Path(owner.to_vec()));
        owner.is_some_and(|owner| l.document.count(owner, name).is_some())
    };
    match statement {
        StatementKind::Command(_) => true,
        StatementKind::Try(inner) => restructures(l, class, inner),
        StatementKind::Set(targets) => targets.iter().any(|(path, _)| is_count(path)),
        StatementKind::Move(_)
        | StatementKind::Note(..)
        | StatementKind::Expect(_)
        | StatementKind::Unclear => false,
    }
}

fn is_statement(member: &Member) -> bool {
    if let Member::For(each) = member {
        return members_of(each).iter().any(is_statement);
    }
    if let Member::If(choice) = member {
        return choice.then_body().is_some_and(|b| b.members().any(|m| is_statement(&m)));
    }
    is_restructuring(member)
        || matches!(
            member,
            Member::Set(_)
                | Member::Move(_)
                | Member::Simulate(_)
                | Member::Try(_)
                | Member::Expect(_)
                | Member::Note(_)
                | Member::Say(_)
                | Member::Task(_)
                | Member::Hint(_)
        )
}

/// Returns true for a statement after which there may be other parts, or other names for them.
pub(crate) fn is_restructuring(member: &Member) -> bool {
    matches!(
        member,
        Member::Merge(_)
            | Member::Unmerge(_)
            | Member::Delete(_)
            | Member::Edit(_)
            | Member::Rename(_)
            | Member::Promote(_)
            | Member::Undo(_)
            | Member::Redo(_)
    )
}

pub(crate) fn statement(
    l: &mut Lowerer<'_>,
    scope: &Scope,
    member: &Member,
) -> Option<StatementKind> {
    let one = |command| Some(StatementKind::Command(command));
    match member {
        Member::Set(set) => match set.targets().map(|t| named_in_class(l, scope, &t)).collect() {
            Some(named) => one(Command::Set(named)),
            None => Some(StatementKind::Set(targets(l, scope, set.targets())?)),
        },
        Member::Move(moved) => Some(StatementKind::Move(targets(l, scope, moved.targets())?)),
        Member::Unmerge(u) => one(Command::Unmerge(spoken_of(l, scope, &u.paths().next()?)?)),
        Member::Delete(d) => one(Command::Delete(spoken_of(l, scope, &d.paths().next()?)?)),
        Member::Edit(edit) => {
            let body = edit.body()?;
            let members: Vec<String> =
                body.members().map(|m| m.syntax().text().to_string()).collect();
            let target = spoken_of(l, scope, &edit.path()?)?;
            one(Command::Edit { target, members: members.join("\n") })
        }
        Member::Rename(r) => {
            let (from, to) = (spoken_of(l, scope, &r.path()?)?, r.name()?.text().to_string());
            one(Command::Rename { from, to })
        }
        Member::Promote(p) => {
            let (path, class) = (spoken_of(l, scope, &p.path()?)?, p.name()?.text().to_string());
            one(Command::Promote { path, class })
        }
        Member::Merge(m) => {
            let paths: Option<Vec<Path>> = m.paths().map(|p| spoken_of(l, scope, &p)).collect();
            one(Command::Merge(paths?))
        }
        Member::Undo(_) => one(Command::Undo),
        Member::Redo(_) => one(Command::Redo),
        Member::Try(t) => {
            let inner = statement(l, scope, &t.statement()?).unwrap_or(StatementKind::Unclear);
            Some(StatementKind::Try(Box::new(inner)))
        }
        Member::Expect(e) => Some(StatementKind::Expect(expectation(l, scope, e)?)),
        Member::Simulate(s) => {
            l.not_yet(OWN, s.span(), "`simulate` is");
            None
        }
        other => {
            l.not_yet(OWN, ast::span_without_doc(other.syntax()), "this statement is");
            None
        }
    }
}

/// Reads the path that a command is about. It may lead to what an edit before it adds.
fn spoken_of(l: &mut Lowerer<'_>, scope: &Scope, e: &ast::Expr) -> Option<Path> {
    l.silent += 1;
    let found = l.expr(scope, e);
    l.silent -= 1;
    path_in_turn(scope, e, found.map(|(term, _)| term))
}

/// Returns the path that an expression is; in a turn of a `for` the one that its names stand for there.
fn path_in_turn(scope: &Scope, e: &ast::Expr, term: Option<Term>) -> Option<Path> {
    match term {
        Some(term) if !scope.turns.is_empty() => term.path().or_else(|| loose_path(e)),
        _ => loose_path(e),
    }
}

fn targets(
    l: &mut Lowerer<'_>,
    scope: &Scope,
    targets: impl Iterator<Item = ast::Target>,
) -> Option<Vec<(Path, Term)>> {
    let mut all = Vec::new();
    for target in targets {
        let e = target.path()?;
        if let Some(target) = of_prototype(l, scope, &target) {
            all.push(target);
            continue;
        }
        // the path may be virtual: it is lowered as an expression to be checked
        let (term, kind) = l.expr(scope, &e)?;
        let Some(path) = path_in_turn(scope, &e, Some(term)) else {
            let message = "a path is wanted: `a.b.c`".to_string();
            l.error("not-a-path", scope.file, e.span(), message);
            return None;
        };
        let value = target.value()?;
        if let Some(class) = l.class_at(scope.class(), &path) {
            l.warn_of_bare_degrees(scope, class, &value, &|degrees| format!("`{degrees}`"));
        }
        all.push((path, l.expr_of(scope, &value, &kind)?));
    }
    Some(all)
}

/// Reads what a part of a prototype is to name: `set Strut.end to Strut.p2`.
fn named_in_class(
    l: &mut Lowerer<'_>,
    scope: &Scope,
    target: &ast::Target,
) -> Option<(Path, Literal)> {
    let (path, named) = (loose_path(&target.path()?)?, loose_path(&target.value()?)?);
    let [Step::Part(first), before @ .., last] = path.0.as_slice() else { return None };
    let class = prototype_named(l, scope, first)?;
    let owner = l.class_at(class, &Path(before.to_vec()))?;
    l.class_at(class, &Path(named.0.get(1..)?.to_vec()))?;
    let names_another = l.is_reference(owner, &Path(vec![last.clone()]));
    (names_another && named.0[0] == path.0[0]).then_some((path, Literal::Path(named)))
}

/// Lowers a target that begins at a class's prototype: `Strut.p1.x`.
fn of_prototype(l: &mut Lowerer<'_>, scope: &Scope, target: &ast::Target) -> Option<(Path, Term)> {
    let path = loose_path(&target.path()?)?;
    let [Step::Part(first), before @ .., Step::Part(last)] = path.0.as_slice() else { return None };
    let class = prototype_named(l, scope, first)?;
    let kind = match l.kind_of_constraint(class, before, last) {
        Some(kind) => kind,
        None => {
            let owner = l.class_at(class, &Path(before.to_vec()))?;
            l.kind_of_part(owner, last)?
        }
    };
    let value = l.expr_of(scope, &target.value()?, &kind)?;
    Some((path.clone(), value))
}

/// Returns the class whose prototype a name means, where it is no part's.
fn prototype_named(l: &mut Lowerer<'_>, scope: &Scope, name: &Name) -> Option<ClassId> {
    let is_part = scope.classes.iter().any(|&c| l.kind_of_part(c, name).is_some());
    l.visible.class(scope.file, name).filter(|_| !is_part)
}

fn counted(
    l: &mut Lowerer<'_>,
    scope: &Scope,
    op: ast::BinaryOp,
    n: &ast::Expr,
) -> Option<Counted> {
    let operator = operator_of(op).filter(|operator| operator.is_comparison())?;
    Some(Counted { operator, n: u64::try_from(l.constant(scope, n)?).ok()? })
}

fn expectation(l: &mut Lowerer<'_>, scope: &Scope, e: &ast::Expect) -> Option<Expectation> {
    match e.expectation() {
        ast::Expectation::Satisfied => Some(Expectation::Satisfied),
        ast::Expectation::Moved(paths) => {
            for path in &paths {
                l.expr(scope, path)?;
            }
            let path = |e: &ast::Expr| {
                let term = l.expr(scope, e).map(|(term, _)| term);
                path_in_turn(scope, e, term)
            };
            let paths: Option<Vec<Path>> = paths.iter().map(path).collect();
            Some(Expectation::Moved(paths?))
        }
        ast::Expectation::Free(op, n) => Some(Expectation::Free(counted(l, scope, op, &n?)?)),
        ast::Expectation::Solutions(op, n) => {
            Some(Expectation::Solutions(counted(l, scope, op, &n?)?))
        }
        ast::Expectation::Plan(word) => match word?.text() {
            "one_pass" => Some(Expectation::Plan(PlanKind::OnePass)),
            "block" => Some(Expectation::Plan(PlanKind::Block)),
            "relaxation" => Some(Expectation::Plan(PlanKind::Relaxation)),
            "search" => Some(Expectation::Plan(PlanKind::Search)),
            other => {
                let message =
                    format!("plans are one_pass, block, relaxation or search, not {other}");
                l.error("unknown-name", OWN, e.span(), message);
                None
            }
        },
        ast::Expectation::Error(word) => Some(Expectation::Error(word?.unquoted())),
        ast::Expectation::Holds { condition, tolerance } => {
            let condition = condition?;
            if l.splits_its_rule(scope, &condition, tolerance.as_ref()) {
                return None;
            }
            let rule = l.expr_of(scope, &condition, &Kind::Bool)?;
            let within = match tolerance {
                Some(t) => Some(l.tolerance(scope, &condition, &t)?),
                None => None,
            };
            Some(Expectation::Rule { rule, within })
        }
    }
}
