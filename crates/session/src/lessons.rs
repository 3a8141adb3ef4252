//! Lessons: which step a person is at, whether its task is done, and whether every solution does it.
//!
//! A lesson is of the document as it is: its steps are read again after every command, and what a task asks for
//! is found out in the state that it meets. That a task was done stays so, whatever is undone later.

use crate::apply;
use crate::check::{command_of, literal_of, meant};
use crate::document::Open;
use crate::expected::expect_rule;
use crate::host::{Beside, Host};
use crate::session::Session;
use crate::state::State;
use crate::tools::of_classes;
use crate::view::{Change, CheckReport, DocumentId, LessonEntry, LessonView, Refusal, Shortfall};
use crate::{views, words};
use base::LineIndex;
use drawing::Drawing;
use kernel::{Command, DOCUMENT, Path, Term};
use lang::{Expectation, Goal, Lesson, LessonStep, StatementKind};
use std::rc::Rc;

impl Session {
    /// Lists the lessons of a document.
    pub fn lessons(&self, id: DocumentId) -> Vec<LessonEntry> {
        list(&self.document(id).state)
    }
    /// Returns what the first step of a document's first lesson has people trace on an empty sheet; nothing of any other.
    pub fn to_trace(&self, id: DocumentId) -> Drawing {
        let open = self.document(id);
        let beside = Beside::of(&*self.host, &self.documents, id);
        let first = open.state.lowered.lessons.first().and_then(|lesson| lesson.steps.first());
        let drawn = first.map(|step| traced(open, &beside, step, &open.state).0);
        drawn.unwrap_or_default()
    }
    /// Begins one of a document's lessons by its number, or leaves the one that goes on.
    pub fn begin_lesson(&mut self, id: DocumentId, which: Option<usize>) {
        let open = self.document_mut(id);
        match which {
            Some(which) => begin(open, which),
            None => open.study = None,
        }
    }
    /// Returns what the lesson shows that goes on, at the first step that is not done; `explained` says that the
    /// reasons are asked for. Nothing where no lesson goes on.
    pub fn lesson(&mut self, id: DocumentId, explained: bool) -> Option<LessonView> {
        let (open, beside) = self.beside_others(id);
        follow(open, &beside, explained)
    }
    /// Goes to the next step of the lesson, whether or not this one is done.
    pub fn next_step(&mut self, id: DocumentId) {
        go_on(self.document_mut(id));
    }
    /// Does the task of the present step as the lesson does it.
    ///
    /// # Errors
    /// The lesson does not show it, or it can no longer be done.
    pub fn show_solution(&mut self, id: DocumentId) -> Result<Change, Refusal> {
        let (open, beside) = self.beside_others(id);
        open.drag = None;
        show(open, &beside)
    }
    /// Goes through the lessons, each on a fresh copy of the document: every task must be done by its solution.
    pub fn run_lessons(&self, id: DocumentId) -> Vec<CheckReport> {
        let beside = Beside::of(&*self.host, &self.documents, id);
        run_all(&self.document(id).state, &beside)
    }
}

/// Where someone is in a lesson.
pub(crate) struct Study {
    /// Which of the document's lessons it is.
    which: usize,
    /// Which of its steps.
    at: usize,
    /// The document when the step began.
    since: Rc<State>,
    /// Whether the reasons were asked for since then.
    explained: bool,
}

/// Lists the lessons of a document.
pub(crate) fn list(state: &State) -> Vec<LessonEntry> {
    let entry = |lesson: &Lesson| LessonEntry {
        title: lesson.title.clone(),
        doc: lesson.doc.clone(),
        steps: lesson.steps.len() as u32,
    };
    state.lowered.lessons.iter().map(entry).collect()
}

/// Begins a lesson, where there is one of this number.
pub(crate) fn begin(open: &mut Open, which: usize) {
    let since = open.state.clone();
    let is_there = which < open.state.lowered.lessons.len();
    open.study = is_there.then_some(Study { which, at: 0, since, explained: false });
}

/// Goes on while what is asked is done, and returns what the lesson shows now.
pub(crate) fn follow(open: &mut Open, host: &dyn Host, explained: bool) -> Option<LessonView> {
    let state = open.state.clone();
    loop {
        let study = open.study.as_ref()?;
        let lesson = state.lowered.lessons.get(study.which)?;
        let explained = explained || study.explained;
        let step = lesson.steps.get(study.at);
        let missing = step.map(|step| missing(open, host, step, (&study.since, explained)));
        let is_done = step.is_some_and(|step| step.task.is_some())
            && missing.as_ref().is_some_and(Vec::is_empty);
        if !is_done {
            let mut view = view(lesson, study.at, missing.unwrap_or_default());
            if let Some(step) = step {
                (view.traced, view.tool) = traced(open, host, step, &study.since);
            }
            let study = open.study.as_mut()?;
            study.explained = explained;
            return Some(view);
        }
        go_on(open);
    }
}

/// Goes to the next step, whether or not the task of this one is done.
pub(crate) fn go_on(open: &mut Open) {
    let since = open.state.clone();
    if let Some(study) = &mut open.study {
        *study = Study { which: study.which, at: study.at + 1, since, explained: false };
    }
}

/// Does the task of the present step as the lesson itself does it.
///
/// # Errors
/// There is no solution, or it can no longer be done.
pub(crate) fn show(open: &mut Open, host: &dyn Host) -> Result<Change, Refusal> {
    let state = open.state.clone();
    let step = open.study.as_ref().and_then(|study| {
        state.lowered.lessons.get(study.which).and_then(|lesson| lesson.steps.get(study.at))
    });
    let step = step.ok_or_else(|| words::refuse("no lesson goes on".into()))?;
    if step.solution.is_empty() {
        return Err(words::refuse("the lesson does not show how this is done".into()));
    }
    solve(open, host, &state.text, step)
}

fn view(lesson: &Lesson, at: usize, missing: Vec<String>) -> LessonView {
    let step = lesson.steps.get(at);
    let task = step.and_then(|step| step.task.as_ref());
    let points_at = task.into_iter().flat_map(|task| &task.goals).flat_map(|goal| match goal {
        Goal::Moved(paths) => paths.iter().map(ToString::to_string).collect(),
        Goal::Explained | Goal::Holds(_) => Vec::new(),
    });
    LessonView {
        title: lesson.title.clone(),
        steps: lesson.steps.len() as u32,
        at: at as u32,
        say: step.map(|step| step.say.clone()).unwrap_or_default(),
        task: task.map(|task| task.goals.iter().map(in_words).collect()).unwrap_or_default(),
        missing,
        hints: step.map(|step| step.hints.clone()).unwrap_or_default(),
        points_at: points_at.collect(),
        can_show: step.is_some_and(|step| !step.solution.is_empty()),
        traced: Drawing::default(),
        tool: None,
    }
}

/// Returns what a step's solution draws on a sheet that was empty when the step began, and the class of its first
/// thing as long as nothing has been drawn.
fn traced(
    open: &Open,
    host: &dyn Host,
    step: &LessonStep,
    since: &State,
) -> (Drawing, Option<String>) {
    let is_empty = |state: &State| state.structure.parts(DOCUMENT).next().is_none();
    let drawn = step.solution.iter().filter_map(|statement| match &statement.kind {
        StatementKind::Command(Command::Edit { target, members }) if target.0.is_empty() => {
            Some(members.as_str())
        }
        _ => None,
    });
    let drawn: Vec<&str> = drawn.collect();
    if drawn.is_empty() || !is_empty(since) {
        return (Drawing::default(), None);
    }
    let text = format!("{}\n{}\n", of_classes(&since.text), drawn.join("\n"));
    let trial = Open::of("lesson", text, host);
    let shown = views::picture::picture(&trial.state, trial.values(), &trial.status);
    let document = &trial.state.lowered.document;
    let first = trial.state.structure.parts(DOCUMENT).next().filter(|_| is_empty(&open.state));
    let class = first.map(|thing| document.named_class(trial.state.structure.things[thing].class));
    (shown.drawing, class.map(|class| document.classes[class].name.to_string()))
}

/// Says what a goal asks for.
fn in_words(goal: &Goal) -> String {
    match goal {
        Goal::Moved(paths) => {
            let paths: Vec<String> = paths.iter().map(ToString::to_string).collect();
            format!("move {}", words::listed(&paths))
        }
        Goal::Explained => "open Why".into(),
        Goal::Holds(source) => {
            format!("make it so that {}", source.strip_prefix("expect ").unwrap_or(source))
        }
    }
}

/// Returns what a step still asks for, in words; nothing where it asks for nothing more.
fn missing(
    open: &Open,
    host: &dyn Host,
    step: &LessonStep,
    (since, explained): (&Rc<State>, bool),
) -> Vec<String> {
    let mut missing = Vec::new();
    let goals = step.task.iter().flat_map(|task| &task.goals);
    for goal in goals.clone() {
        match goal {
            Goal::Moved(paths) => {
                let still = |path: &&Path| value(&open.state, path) == value(since, path);
                let still: Vec<String> =
                    paths.iter().filter(still).map(ToString::to_string).collect();
                if !still.is_empty() {
                    missing.push(format!("{} did not move yet", words::listed(&still)));
                }
            }
            Goal::Explained if !explained => {
                missing.push("the reasons were not asked for yet".into());
            }
            Goal::Explained | Goal::Holds(_) => {}
        }
    }
    if !missing.is_empty() {
        return missing;
    }
    let holds = goals.filter_map(|goal| match goal {
        Goal::Holds(source) => Some(&**source),
        Goal::Moved(_) | Goal::Explained => None,
    });
    let sources: Vec<&str> = holds.chain(step.expects.iter().map(|source| &**source)).collect();
    if sources.is_empty() {
        return missing;
    }
    let (statements, message) = meant(&open.state, host, &sources);
    for (at, source) in sources.iter().enumerate() {
        let said = source.strip_prefix("expect ").unwrap_or(source).trim();
        let found = match statements.get(at).map(|s| &s.kind) {
            Some(StatementKind::Expect(expectation)) => expected(open, expectation, said),
            _ => Err(message.clone().unwrap_or_else(|| "this means nothing here".into())),
        };
        missing.extend(found.err().map(|why| format!("not yet: {said} ({why})")));
    }
    missing
}

/// Tests what a lesson may expect.
fn expected(open: &Open, expectation: &Expectation, source: &str) -> Result<(), String> {
    match expectation {
        Expectation::Rule { rule, within } => {
            expect_rule(&open.state, rule, within.as_ref(), source)
        }
        Expectation::Satisfied => {
            let status = views::status::view(open);
            if status.satisfied { Ok(()) } else { Err(status.message) }
        }
        Expectation::Free(n) => {
            let found = match open.status.more {
                Some(_) => open.freedom().0,
                None => open.trial().counted(),
            };
            if n.holds(found as u64) {
                Ok(())
            } else {
                Err(format!("{found} degrees of freedom, not {n}"))
            }
        }
        Expectation::Moved(_)
        | Expectation::Solutions(_)
        | Expectation::Plan(_)
        | Expectation::Error(_) => Err("a lesson does not expect this".into()),
    }
}

/// Returns what a path leads to, to be compared; nothing where it leads nowhere.
fn value(state: &State, path: &Path) -> Option<Vec<kernel::Value>> {
    if let Some(thing) = crate::session::thing_at(state, path) {
        let slots = state.structure.slots_under(thing);
        return Some(slots.into_iter().map(|slot| state.values.get(slot)).collect());
    }
    let term = Term::at(Term::Me, path);
    let evaluator = state.evaluator(&state.values);
    let answer = evaluator.evaluate(&term, DOCUMENT).ok()?;
    Some(apply::flat(&literal_of(&answer).ok()?))
}

/// Does what a step's solution says, statement by statement.
fn solve(
    open: &mut Open,
    host: &dyn Host,
    written: &str,
    step: &LessonStep,
) -> Result<Change, Refusal> {
    let mut last = Change::default();
    for statement in &step.solution {
        let source = written.get(statement.span.range()).unwrap_or_default();
        if let StatementKind::Command(command @ Command::Edit { target, .. }) = &statement.kind
            && target.0.is_empty()
        {
            last = apply::apply(open, host, command)?;
            continue;
        }
        let (meaning, message) = meant(&open.state, host, &[source]);
        let kind = meaning.into_iter().next().map(|s| s.kind);
        let kind = kind.filter(|kind| *kind != StatementKind::Unclear).ok_or_else(|| {
            words::refuse(message.unwrap_or_else(|| format!("{source} means nothing here")))
        })?;
        let state = open.state.clone();
        let command = command_of(&state, &kind)?;
        last = apply::by_hand(open, host, &command)?;
    }
    Ok(last)
}

/// Goes through every lesson of a document on a fresh copy: each task must be open at first, and done by its
/// solution, where it has one.
pub(crate) fn run_all(state: &State, host: &dyn Host) -> Vec<CheckReport> {
    if state.lowered.lessons.is_empty() {
        return Vec::new();
    }
    let document = lang::without_checks(&state.text);
    let lines = LineIndex::new(&state.text);
    let line = |offset: u32| lines.line_column(&state.text, offset).0;
    let report = |lesson: &Lesson| {
        let shortfalls = run(&document, state, host, lesson);
        let shortfall = |(span, message): (base::Span, String)| Shortfall {
            line: line(span.start),
            statement: state.text.get(span.range()).unwrap_or_default().trim().into(),
            message,
        };
        let shortfalls: Vec<Shortfall> = shortfalls.into_iter().map(shortfall).collect();
        CheckReport {
            title: lesson.title.clone(),
            line: line(lesson.span.start),
            passed: shortfalls.is_empty(),
            shortfalls,
        }
    };
    state.lowered.lessons.iter().map(report).collect()
}

fn run(document: &str, of: &State, host: &dyn Host, lesson: &Lesson) -> Vec<(base::Span, String)> {
    let mut open = Open::of("lesson", document.into(), host);
    let mut shortfalls = Vec::new();
    for step in &lesson.steps {
        let Some(task) = &step.task else { continue };
        let since = open.state.clone();
        let asks_why = task.goals.contains(&Goal::Explained);
        if missing(&open, host, step, (&since, false)).is_empty() {
            shortfalls.push((task.span, "this is done before anything is done".into()));
        }
        // how it is done is known to whoever does it
        if step.solution.is_empty() && !asks_why {
            continue;
        }
        if let Err(refusal) = solve(&mut open, host, &of.text, step) {
            shortfalls.push((task.span, format!("its solution is refused: {}", refusal.message)));
            break;
        }
        let missing = missing(&open, host, step, (&since, true));
        if !missing.is_empty() {
            shortfalls
                .push((task.span, format!("its solution does not do it: {}", missing.join("; "))));
            break;
        }
    }
    shortfalls
}
