//! Lessons: what a document says to someone who works on it, and the tasks that it sets.
//!
//! A step says something, sets a task, expects what follows from it, hints, and shows how it is done: statements
//! after the task are its solution. Conditions are kept as they are written, since they may speak of what a
//! person has yet to make; whoever follows a lesson reads them in the document as it is then.

use crate::checks::{self, Statement, StatementKind};
use crate::kinds::Kind;
use crate::lower::{Lowerer, OWN};
use crate::paths::loose_path;
use crate::scope::Scope;
use base::{Diagnostic, Place, Span};
use kernel::{Command, Path};
use std::rc::Rc;
use syntax::SyntaxKind;
use syntax::ast::{self, AstNode, Expr, Member};

/// A `lesson` block.
#[derive(Clone, PartialEq, Debug)]
pub struct Lesson {
    /// What it is called.
    pub title: String,
    /// What `///` says of it.
    pub doc: String,
    /// Where it stands in the document's own text.
    pub span: Span,
    /// Its steps, in order.
    pub steps: Vec<LessonStep>,
}

/// A step of a lesson.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct LessonStep {
    /// What it says, each a sentence or two.
    pub say: Vec<String>,
    /// What is to be done; nothing where there is only something to read.
    pub task: Option<Task>,
    /// What must hold besides once it is done, each as an `expect` is written.
    pub expects: Vec<Rc<str>>,
    /// What helps.
    pub hints: Vec<String>,
    /// What does the task.
    pub solution: Vec<Statement>,
}

/// What is to be done.
#[derive(Clone, PartialEq, Debug)]
pub struct Task {
    /// As it is written.
    pub source: Rc<str>,
    /// Where it is written.
    pub span: Span,
    /// What it consists of.
    pub goals: Vec<Goal>,
}

/// Something that a task asks for.
#[derive(Clone, PartialEq, Debug)]
pub enum Goal {
    /// `moved(a, b)`: each has another value than when the task was set.
    Moved(Vec<Path>),
    /// `explained`: the reasons were asked for.
    Explained,
    /// A condition, as an `expect` is written.
    Holds(Rc<str>),
}

/// Lowers the lessons of the document's own text.
pub(crate) fn lower(l: &mut Lowerer<'_>) -> Vec<Lesson> {
    let members = l.files[OWN].members_of(&[SyntaxKind::Lesson]);
    let lessons = members.into_iter().filter_map(|member| match member {
        Member::Lesson(lesson) => Some(lesson),
        _ => None,
    });
    let lessons: Vec<ast::Lesson> = lessons.collect();
    lessons.iter().map(|lesson| lower_lesson(l, lesson)).collect()
}

fn lower_lesson(l: &mut Lowerer<'_>, lesson: &ast::Lesson) -> Lesson {
    let scope = Scope::of(OWN, l.document.root);
    let members: Vec<Member> = lesson.body().into_iter().flat_map(|b| b.members()).collect();
    let mut steps: Vec<LessonStep> = Vec::new();
    let mut restructured = false;
    for (at, group) in grouped(&members).into_iter().enumerate() {
        // what speaks of what a person has yet to make can be told only once it is made
        let changes = group.iter().any(changes_structure);
        let silent = u32::from(restructured || changes);
        l.silent += silent;
        let mut step = LessonStep::default();
        for member in group {
            lower_member(l, &scope, member, &mut step);
        }
        l.silent -= silent;
        restructured |= changes;
        if step.task.is_none() && step.say.is_empty() {
            let span = group.first().map_or(lesson.span(), |m| ast::span_without_doc(m.syntax()));
            let message = format!("step {} of the lesson says nothing and sets no task", at + 1);
            let d = Diagnostic::error("no-task", Place { file: OWN, span }, message);
            l.report(d.hint("write `say \"…\"` or `task …` before it"));
        }
        steps.push(step);
    }
    Lesson {
        title: lesson.name().map(|w| w.unquoted()).unwrap_or_default(),
        doc: ast::doc_comment(lesson.syntax()).unwrap_or_default(),
        span: ast::span_without_doc(lesson.syntax()),
        steps,
    }
}

/// Returns the members of each step: after a task, one begins with what is said, or with the next task.
fn grouped(members: &[Member]) -> Vec<&[Member]> {
    let mut starts = Vec::new();
    let mut has_task = false;
    for (at, member) in members.iter().enumerate() {
        let is_task = matches!(member, Member::Task(_));
        let begins = has_task && (is_task || matches!(member, Member::Say(_)));
        if begins || at == 0 {
            starts.push(at);
            has_task = false;
        }
        has_task |= is_task;
    }
    let ends = starts.iter().skip(1).copied().chain([members.len()]);
    starts.iter().zip(ends).map(|(from, to)| &members[*from..to]).collect()
}

/// Returns true for what adds, takes away or names things: what speaks of these means something only then.
fn changes_structure(member: &Member) -> bool {
    let adds = matches!(
        member,
        Member::Part(_) | Member::Constraint(_) | Member::Anchor(_) | Member::Assign(_)
    );
    adds || checks::is_restructuring(member)
}

fn lower_member(l: &mut Lowerer<'_>, scope: &Scope, member: &Member, step: &mut LessonStep) {
    let span = ast::span_without_doc(member.syntax());
    match member {
        Member::Say(say) => step.say.extend(say.text().map(|w| w.unquoted())),
        Member::Hint(hint) => step.hints.extend(hint.text().map(|w| w.unquoted())),
        Member::Task(task) => {
            let Some(condition) = task.condition() else { return };
            let mut goals = Vec::new();
            lower_goals(l, scope, &condition, &mut goals);
            let source = written(condition.syntax());
            step.task = Some(Task { source, span, goals });
        }
        Member::Expect(expect) => {
            let kind = checks::statement(l, scope, member);
            let is_plain = matches!(
                expect.expectation(),
                ast::Expectation::Holds { .. }
                    | ast::Expectation::Satisfied
                    | ast::Expectation::Free(..)
            );
            if is_plain {
                step.expects.push(written(expect.syntax()));
            } else if kind.is_some() {
                let message = "a lesson expects conditions, `satisfied` or `free = n`".to_string();
                l.error("not-in-a-lesson", OWN, span, message);
            }
        }
        Member::Error(_) => {}
        edit if matches!(edit, Member::Set(_) | Member::Move(_))
            || checks::is_restructuring(edit) =>
        {
            let kind = checks::statement(l, scope, member).unwrap_or(StatementKind::Unclear);
            step.solution.push(Statement { kind, span, is_note: false, whole: span });
        }
        // what a person adds to the document by hand
        Member::Part(_) | Member::Constraint(_) | Member::Anchor(_) | Member::Assign(_) => {
            let members = written(member.syntax()).to_string();
            let command = Command::Edit { target: Path::default(), members };
            step.solution.push(Statement {
                kind: StatementKind::Command(command),
                span,
                is_note: false,
                whole: span,
            });
        }
        _ => {
            let place = Place { file: OWN, span: l.first_line(OWN, span) };
            let message = "this is no part of a lesson".to_string();
            let d = Diagnostic::error("not-in-a-lesson", place, message);
            l.report(d.hint(
                "a lesson has `say`, `task`, `expect`, `hint`, and what does a task: edits, or members to add",
            ));
        }
    }
}

/// Reads what a condition asks for: each part of what is joined by `and` by itself.
fn lower_goals(l: &mut Lowerer<'_>, scope: &Scope, condition: &Expr, goals: &mut Vec<Goal>) {
    match condition {
        Expr::Paren(inner) => {
            if let Some(inner) = inner.inner() {
                lower_goals(l, scope, &inner, goals);
            }
        }
        Expr::Binary(both) if both.op_word().is_some_and(|o| o.text() == "and") => {
            for side in [both.left(), both.right()].into_iter().flatten() {
                lower_goals(l, scope, &side, goals);
            }
        }
        Expr::Call(call)
            if call.name().is_some_and(|w| w.text() == "moved") && !is_labelled(call) =>
        {
            let arguments: Vec<Expr> =
                call.args().into_iter().flat_map(|a| a.args()).filter_map(|a| a.value()).collect();
            let mut paths = Vec::new();
            for argument in &arguments {
                // a name that means nothing is reported here
                let found = l.expr(scope, argument);
                match loose_path(argument) {
                    Some(path) => paths.push(path),
                    None if found.is_some() => {
                        let message = "a path is wanted: `a.b.c`".to_string();
                        l.error("not-a-path", OWN, argument.span(), message);
                    }
                    None => {}
                }
            }
            if arguments.is_empty() {
                let message = "`moved()` names nothing".to_string();
                let place = Place { file: OWN, span: call.span() };
                l.report(Diagnostic::error("no-path", place, message).hint("`moved(a.p1)`"));
            }
            goals.push(Goal::Moved(paths));
        }
        Expr::Name(name) if name.name().is_some_and(|w| w.text() == "explained") => {
            goals.push(Goal::Explained);
        }
        other => {
            let _ = l.expr_of(scope, other, &Kind::Bool);
            goals.push(Goal::Holds(format!("expect {}", written(other.syntax())).into()));
        }
    }
}

fn is_labelled(call: &ast::CallExpr) -> bool {
    let first = call.args().and_then(|a| a.args().next());
    first.is_some_and(|a| a.label().is_some())
}

/// Returns a piece of the text without what stands around it.
fn written(node: &syntax::SyntaxNode) -> Rc<str> {
    node.text().to_string().trim().into()
}
