//! Checks: the `check` blocks of a document, each run on a fresh copy.
//!
//! The copy is a text: the document's without its checks, with the check's own members added at its
//! end. Statements are then the same commands that the lab applies, and `expect` asks the state that
//! they came to. What a statement means is found out in the state that it meets.

use crate::apply;
use crate::complaints;
use crate::document::Open;
use crate::expected::{Unasked, expect_rule};
use crate::host::Host;
use crate::state::State;
use crate::view::{Change, CheckReport, Refusal, Shortfall};
use crate::words;
use base::{LineIndex, Name};
use eval::Answer;
use kernel::{Command, DOCUMENT, Literal, Path, SlotId, Term};
use lang::{Check, Expectation, PlanKind, Statement, StatementKind};
use plan::{NotDecided, Plans};
use solve::{COUNTING, Count};
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::ops::Range;
use std::rc::Rc;

/// Runs every check of a document.
pub(crate) fn run_all(state: &State, host: &dyn Host) -> Vec<CheckReport> {
    let document = lang::without_checks(&state.text);
    let lines = LineIndex::new(&state.text);
    let of = Checked { state, document: &document, lines: &lines };
    let mut begun = Begun::default();
    state.lowered.checks.iter().map(|check| run(of, check, host, &mut begun)).collect()
}

/// What is known of the copies that checks began with.
#[derive(Default)]
struct Begun {
    /// A copy that no check has added members to.
    plain: Option<Plain>,
    /// The plans of all checks so far.
    plans: Plans,
}

/// The copy that those checks begin with that have no members of their own.
struct Plain {
    state: Rc<State>,
    /// What holds in it.
    status: plan::Status,
    /// What the statements of each of these checks mean in it, those of the next check last.
    meanings: Vec<Vec<Statement>>,
}

impl Plain {
    fn of(open: &Open, of: Checked<'_>, host: &dyn Host) -> Self {
        let all = &of.state.lowered.checks;
        let checks: Vec<&Check> = all.iter().filter(|c| c.members.is_empty()).collect();
        let sources: Vec<Vec<&str>> = checks.iter().map(|c| of.sources(&c.statements)).collect();
        let (mut meanings, _) = each_meant(&open.state, host, &sources);
        let are_as_many = meanings.len() == checks.len()
            && meanings.iter().zip(&checks).all(|(m, c)| m.len() == c.statements.len());
        if !are_as_many {
            meanings.clear();
        }
        meanings.reverse();
        Self { state: open.state.clone(), status: open.status.clone(), meanings }
    }
}

/// The document whose checks are run.
#[derive(Clone, Copy)]
struct Checked<'h> {
    state: &'h State,
    /// Its text without checks.
    document: &'h str,
    lines: &'h LineIndex,
}

impl Checked<'_> {
    fn line(&self, offset: u32) -> u32 {
        self.lines.line_column(&self.state.text, offset).0
    }
    /// Returns the texts of statements; of those that a loop or condition makes, its own once.
    fn sources(&self, statements: &[Statement]) -> Vec<&str> {
        let mut wholes: Vec<base::Span> = statements.iter().map(|s| s.whole).collect();
        wholes.dedup();
        wholes.into_iter().map(|span| self.source(span)).collect()
    }
    fn source(&self, span: base::Span) -> &str {
        self.state.text.get(span.range()).unwrap_or_default()
    }
}

/// A check while it runs.
struct Run<'h> {
    open: Open,
    host: &'h dyn Host,
    of: Checked<'h>,
    check: &'h Check,
    /// Where those statements are that give names which all behind them know.
    notes: Vec<base::Span>,
    /// What statements mean in the present structure.
    statements: Vec<Statement>,
    /// Which of the check's these are.
    known: Range<usize>,
    /// What has been given a name, as terms that speak of nothing.
    noted: Vec<(Name, Term)>,
    /// What the latest `try` was refused with.
    refusal: Option<Refusal>,
    /// The state before the latest edit.
    before: Option<Rc<State>>,
    /// The state that the values of the check began with: that of its latest edit of the structure.
    start: Rc<State>,
    /// What it has set or moved since then.
    spoken: BTreeSet<SlotId>,
    /// Whether what they moved besides is told.
    is_moved_told: bool,
    /// What the latest edit said of constraints that act otherwise since.
    told: Vec<String>,
    shortfalls: Vec<Shortfall>,
}

/// Opens the copy that a check begins with, and says what its statements mean there where that is known.
fn begin(
    of: Checked<'_>,
    check: &Check,
    host: &dyn Host,
    begun: &mut Begun,
) -> (Open, Option<Vec<Statement>>) {
    let plans = std::mem::take(&mut begun.plans);
    if !check.members.is_empty() {
        let members: Vec<&str> = check.members.iter().map(|m| &**m).collect();
        let text = format!("{}\n{}\n", of.document, members.join("\n"));
        return (Open::again("check", text, None, host, plans), None);
    }
    if let Some(Plain { state, status, meanings }) = &mut begun.plain {
        let meaning = meanings.pop();
        // of a copy that is not computed there is no plan to ask after
        let asks_for_plan =
            |s: &Statement| matches!(s.kind, StatementKind::Expect(Expectation::Plan(_)));
        let open = match check.statements.iter().any(asks_for_plan) {
            true => Open::again("check", state.text.clone(), Some(state), host, plans),
            false => Open::beginning("check", (state.clone(), status.clone()), plans),
        };
        return (open, meaning);
    }
    let open = Open::again("check", format!("{}\n\n", of.document), None, host, plans);
    let mut plain = Plain::of(&open, of, host);
    let meaning = plain.meanings.pop();
    begun.plain = Some(plain);
    (open, meaning)
}

fn run(of: Checked<'_>, check: &Check, host: &dyn Host, begun: &mut Begun) -> CheckReport {
    let end = of.document.len() as u32;
    let (open, meaning) = begin(of, check, host, begun);
    let notes = check.statements.iter().filter(|s| s.is_note && s.span == s.whole);
    let mut run = Run {
        notes: notes.map(|s| s.whole).collect(),
        start: open.state.clone(),
        spoken: BTreeSet::new(),
        is_moved_told: false,
        open,
        host,
        of,
        check,
        statements: Vec::new(),
        known: 0..0,
        noted: Vec::new(),
        refusal: None,
        before: None,
        told: Vec::new(),
        shortfalls: Vec::new(),
    };
    match meaning {
        Some(statements) => {
            run.known = 0..statements.len();
            run.statements = statements;
        }
        None => run.know(0..check.statements.len()),
    }
    run.note_faults(end);
    if let Some(first) = check.statements.first() {
        run.note_violations(first);
    }
    for (at, statement) in check.statements.iter().enumerate() {
        if let Err(message) = run.statement(at) {
            run.fall_short(statement, message);
            break;
        }
    }
    begun.plans = run.open.planner.take_plans().without_course();
    CheckReport {
        title: check.title.clone(),
        line: of.line(check.span.start),
        passed: run.shortfalls.is_empty(),
        shortfalls: run.shortfalls,
    }
}

impl Run<'_> {
    /// Finds out what some of the check's statements mean in the present structure.
    fn know(&mut self, which: Range<usize>) {
        self.statements = self.lowered(which.clone()).0;
        self.known = which;
    }

    /// Returns what a statement means in the present structure. After an edit of the structure one statement is
    /// read, after that twice as many at a time.
    fn meaning(&mut self, at: usize) -> Option<StatementKind> {
        if !self.known.contains(&at) {
            let more = (2 * self.known.len()).max(1);
            self.know(at..self.check.statements.len().min(at + more));
        }
        self.statements.get(at - self.known.start).map(|s| s.kind.clone())
    }

    /// Finds out what statements mean in the present structure, and what is wrong with them.
    fn lowered(&self, which: Range<usize>) -> (Vec<Statement>, Option<String>) {
        let statements = &self.check.statements[which.clone()];
        let mut wholes = self.notes_before(statements).to_vec();
        let noted = wholes.len();
        wholes.extend(statements.iter().map(|s| s.whole));
        wholes.dedup();
        let sources: Vec<&str> = wholes.iter().map(|span| self.of.source(*span)).collect();
        let (mut all, message) = meant(&self.open.state, self.host, &sources);
        all.drain(..noted.min(all.len()));
        // a loop is read as a whole: what stands before these in it is left out
        if let Some(first) = statements.first() {
            let before = self.check.statements[..which.start].iter().rev();
            let before = before.take_while(|s| s.whole == first.whole);
            let before = before.count().min(all.len());
            all.drain(..before);
        }
        (all, message)
    }

    /// Returns where those are that give names which some statements know.
    fn notes_before(&self, statements: &[Statement]) -> &[base::Span] {
        let first = statements.first().map_or(0, |first| first.whole.start);
        &self.notes[..self.notes.partition_point(|note| note.end <= first)]
    }

    fn is_told(&self, statement: &Statement) -> bool {
        let inside = |d: &base::Diagnostic| {
            d.place.file == base::FileId(0)
                && statement.span.range().contains(&(d.place.span.start as usize))
        };
        self.of.state.diagnostics.iter().any(inside)
    }

    fn source(&self, statement: &Statement) -> &str {
        self.of.source(statement.span)
    }

    /// A check whose own members are wrong falls short at once.
    fn note_faults(&mut self, end: u32) {
        let known = |m: &str| self.of.state.diagnostics.iter().any(|d| d.message == m);
        for d in &self.open.state.diagnostics {
            let own = d.place.file == base::FileId(0) && d.place.span.start >= end;
            if own && d.severity == base::Severity::Error && !known(&d.message) {
                let line = self.of.line(self.check.span.start);
                let statement = "its own members".to_string();
                self.shortfalls.push(Shortfall { line, statement, message: d.message.clone() });
            }
        }
    }

    fn fall_short(&mut self, statement: &Statement, message: String) {
        let source = self.source(statement).trim().to_string();
        let line = self.of.line(statement.span.start);
        self.shortfalls.push(Shortfall { line, statement: source, message });
    }

    /// In debug builds the independent checker goes over every edit.
    fn note_violations(&mut self, statement: &Statement) {
        if cfg!(debug_assertions) {
            for violation in complaints::violations(&self.open) {
                self.fall_short(statement, violation);
            }
            for path in complaints::restless(&mut self.open) {
                let message = format!("solving what is solved changes {path}");
                self.fall_short(statement, message);
            }
        }
    }

    /// Runs one statement; what is returned ends the check.
    fn statement(&mut self, at: usize) -> Result<(), String> {
        let state = self.open.state.clone();
        let statement = &self.check.statements[at];
        let kind = match self.meaning(at) {
            // the text's own diagnostics say so already
            Some(StatementKind::Unclear) | None if self.is_told(statement) => return Ok(()),
            Some(StatementKind::Unclear) | None => {
                let (_, message) = self.lowered(at..at + 1);
                let is_error = |d: &base::Diagnostic| d.severity == base::Severity::Error;
                return match message {
                    Some(message) => Err(message),
                    // what it speaks of is wrong where it is declared, and that is said there
                    None if self.of.state.diagnostics.iter().any(is_error) => Ok(()),
                    None => Err("this means nothing here".into()),
                };
            }
            Some(kind) => kind,
        };
        match &kind {
            StatementKind::Note(name, term) => {
                let value = self.now(&state, term)?;
                self.noted.push((name.clone(), value));
            }
            StatementKind::Expect(expectation) => {
                let of = self.of;
                let source = of.source(statement.span).trim();
                let source = source.strip_prefix("expect ").unwrap_or(source);
                if let Err(mut message) = self.expect(&state, expectation, source) {
                    if let Expectation::Rule { rule, within } = expectation {
                        self.told.drain(..).for_each(|told| message += &format!("; {told}"));
                        let unasked = self.unasked(&state, rule, within.as_ref());
                        unasked.into_iter().for_each(|told| message += &format!("\n{told}"));
                    }
                    self.fall_short(statement, message);
                }
            }
            StatementKind::Try(inner) if **inner == StatementKind::Unclear => {
                let (_, message) = self.lowered(at..at + 1);
                self.refusal = Some(words::refuse(message.unwrap_or_default()));
            }
            StatementKind::Try(inner) => {
                let result = self.edit(&state, inner);
                self.refusal = result.err();
            }
            edit => {
                self.edit(&state, edit).map_err(|r| r.message)?;
                self.note_violations(statement);
            }
        }
        Ok(())
    }

    /// Returns the value that an expression has now, as a term that speaks of nothing.
    fn now(&self, state: &State, term: &Term) -> Result<Term, String> {
        let term = self.with_noted(term);
        let evaluator = state.evaluator(&state.values);
        let answer = evaluator.evaluate(&term, DOCUMENT).map_err(|f| f.message)?;
        evaluator.fixed(&answer).map_err(|f| f.message)
    }

    /// Returns a term in which what has been given a name is known.
    fn with_noted(&self, term: &Term) -> Term {
        let bind = |body, (name, value): &(Name, Term)| {
            Term::Let(name.clone(), Box::new(value.clone()), Box::new(body))
        };
        self.noted.iter().rev().fold(term.clone(), bind)
    }

    fn with_noted_targets(&self, targets: &[(Path, Term)]) -> Vec<(Path, Term)> {
        targets.iter().map(|(path, term)| (path.clone(), self.with_noted(term))).collect()
    }

    fn edit(&mut self, state: &State, kind: &StatementKind) -> Result<Change, Refusal> {
        let command = match kind {
            StatementKind::Set(targets) => {
                command_of(state, &StatementKind::Set(self.with_noted_targets(targets)))?
            }
            StatementKind::Move(targets) => {
                command_of(state, &StatementKind::Move(self.with_noted_targets(targets)))?
            }
            other => command_of(state, other)?,
        };
        self.before = Some(self.open.state.clone());
        self.told.clear();
        let change = apply::by_hand(&mut self.open, self.host, &command)?;
        let of_constraints = change.modes.iter().filter(|mode| !mode.constraint.is_empty());
        self.told.extend(of_constraints.map(|mode| mode.message.clone()));
        if !self.open.state.has_form_of(state) {
            self.known = 0..0;
        }
        self.note_spoken(kind, change.structure);
        Ok(change)
    }

    /// Says which given values the edits moved that they did not speak of, once until the next one.
    fn unasked(&mut self, state: &State, rule: &Term, within: Option<&Term>) -> Option<String> {
        if self.is_moved_told {
            return None;
        }
        let (rule, within) = (self.with_noted(rule), within.map(|w| self.with_noted(w)));
        let unasked = Unasked::of(&self.start, state, &self.spoken);
        let told = unasked.for_rule(&rule, within.as_ref());
        self.is_moved_told = told.is_some();
        told
    }

    /// Notes what an edit spoke of.
    fn note_spoken(&mut self, kind: &StatementKind, is_structural: bool) {
        let state = &self.open.state;
        self.is_moved_told = false;
        if is_structural {
            self.start = state.clone();
            self.spoken.clear();
        }
        if let StatementKind::Set(targets) | StatementKind::Move(targets) = kind {
            let things = targets.iter().filter_map(|(path, _)| words::find(state, path).ok());
            self.spoken.extend(things.flat_map(|thing| state.structure.slots_under(thing)));
        }
    }

    fn expect(
        &mut self,
        state: &State,
        expectation: &Expectation,
        source: &str,
    ) -> Result<(), String> {
        match expectation {
            Expectation::Rule { rule, within } => {
                let within = within.as_ref().map(|within| self.with_noted(within));
                expect_rule(state, &self.with_noted(rule), within.as_ref(), source)
            }
            Expectation::Satisfied => {
                let status = crate::views::status::view(&self.open);
                if status.satisfied { Ok(()) } else { Err(status.message) }
            }
            Expectation::Moved(paths) => self.expect_moved(state, paths),
            Expectation::Free(n) => {
                let found = self.open.counted();
                let message = || format!("{found} degrees of freedom, not {n}");
                if n.holds(found as u64) { Ok(()) } else { Err(message()) }
            }
            Expectation::Solutions(n) => {
                let model = state.model();
                let found = self.open.planner.solutions(model, &state.values, n.enough());
                let found = found.map_err(|e| {
                    let slot = state.slot_path(e.slot);
                    format!("{slot} stands among real numbers, whose solutions are not counted")
                })?;
                let Count { solutions, is_complete } =
                    found.ok_or("no whole numbers are searched here")?;
                if !is_complete && solutions < n.enough() {
                    let bound = words::given_up(NotDecided::Work(COUNTING));
                    return Err(format!("{bound}, which found {solutions} solutions"));
                }
                let at_least = if is_complete { "" } else { "at least " };
                let message = || format!("{at_least}{solutions} solutions, not {n}");
                if n.holds(solutions) { Ok(()) } else { Err(message()) }
            }
            Expectation::Plan(kind) => {
                let found = match self.open.planner.latest_kind() {
                    plan::PlanKind::OnePass => PlanKind::OnePass,
                    plan::PlanKind::Block => PlanKind::Block,
                    plan::PlanKind::Relaxation => PlanKind::Relaxation,
                    plan::PlanKind::Search => PlanKind::Search,
                };
                let message = || format!("the latest plan is {found:?}, not {kind:?}");
                if found == *kind { Ok(()) } else { Err(message()) }
            }
            Expectation::Error(word) => match &self.refusal {
                None => Err("nothing was refused".into()),
                Some(refusal) if mentions(refusal, word) => Ok(()),
                Some(refusal) => Err(format!("the refusal says: {}", refusal.message)),
            },
        }
    }

    fn expect_moved(&self, state: &State, paths: &[Path]) -> Result<(), String> {
        let Some(before) = &self.before else { return Err("nothing was edited yet".into()) };
        if before.structure.slots.len() != state.structure.slots.len() {
            return Err("the edit changed the structure".into());
        }
        let mut wanted = BTreeSet::new();
        for path in paths {
            let thing = words::find(state, path).map_err(|r| r.message)?;
            wanted.extend(state.structure.slots_under(thing));
        }
        let found: BTreeSet<_> = state.values.changed(&before.values).collect();
        let names = |slots: Vec<&SlotId>| {
            let names = slots.into_iter().map(|&s| state.slot_path(s).to_string());
            names.collect::<Vec<_>>().join(", ")
        };
        let too_many: Vec<_> = found.difference(&wanted).collect();
        if !too_many.is_empty() {
            return Err(format!("these moved as well: {}", names(too_many)));
        }
        // A place has moved when any of its coordinates has.
        for path in paths {
            let thing = words::find(state, path).map_err(|r| r.message)?;
            if !state.structure.slots_under(thing).iter().any(|s| found.contains(s)) {
                return Err(format!("{path} did not move"));
            }
        }
        Ok(())
    }
}

/// Evaluates what targets are to be set or moved to.
fn literals(
    state: &State,
    targets: &[(Path, Term)],
    literal: impl Fn(&(Path, Term), &Answer<'_>) -> Result<Literal, Refusal>,
) -> Result<Vec<(Path, Literal)>, Refusal> {
    let evaluator = state.evaluator(&state.values);
    let each = targets.iter().map(|target| {
        let (path, term) = target;
        let answer = evaluator.evaluate(term, DOCUMENT).map_err(|f| words::refuse(f.message))?;
        Ok((path.clone(), literal(target, &answer)?))
    });
    each.collect()
}

/// Returns what a part is set to: of a part that names another, what it shall name.
fn to_set(
    state: &State,
    path: &Path,
    term: &Term,
    answer: &Answer<'_>,
) -> Result<Literal, Refusal> {
    if !words::names_another(state, path) {
        return literal_of(answer);
    }
    // a number or text is named by its path
    let named = || state.structure.follow(DOCUMENT, &term.path()?).ok();
    let thing = match answer {
        Answer::Thing(thing) => Some(*thing),
        _ => named(),
    };
    match thing {
        Some(thing) => Ok(Literal::Path(state.structure.path(&state.lowered.document, thing))),
        None => literal_of(answer),
    }
}

pub(crate) fn literal_of(answer: &Answer<'_>) -> Result<Literal, Refusal> {
    Ok(match answer {
        Answer::Number(x, _) => Literal::Number(*x),
        Answer::Bool(b) => Literal::Bool(*b),
        Answer::Option(_, at) => Literal::Number(f64::from(*at)),
        Answer::Text(t) => Literal::Text(t.to_string()),
        Answer::Made(made) => {
            Literal::Tuple(made.fields.iter().map(literal_of).collect::<Result<_, _>>()?)
        }
        Answer::List(items) => {
            Literal::Tuple(items.iter().map(literal_of).collect::<Result<_, _>>()?)
        }
        Answer::Thing(_) | Answer::Context(_) | Answer::Picture(_) | Answer::Function(_) => {
            return Err(words::refuse(format!("{} is no value to set", answer.kind())));
        }
    })
}

/// Returns true if a refusal says the whole word.
fn mentions(refusal: &Refusal, word: &str) -> bool {
    let texts = std::iter::once(&refusal.message)
        .chain(&refusal.constraints)
        .chain(refusal.diagnostics.iter().flat_map(|d| [&d.message, &d.code]));
    let has = |text: &String| {
        text.split(|c: char| !c.is_alphanumeric() && c != '_' && c != '-').any(|w| w == word)
    };
    texts.into_iter().any(has)
}

/// Finds out what statements mean in a document, and what is wrong with the first that means nothing.
pub(crate) fn meant(
    state: &State,
    host: &dyn Host,
    sources: &[&str],
) -> (Vec<Statement>, Option<String>) {
    let (mut checks, message) = each_meant(state, host, &[sources.to_vec()]);
    (checks.pop().unwrap_or_default(), message)
}

/// The same of the statements of several checks, which are read at once.
fn each_meant(
    state: &State,
    host: &dyn Host,
    checks: &[Vec<&str>],
) -> (Vec<Vec<Statement>>, Option<String>) {
    let document = &state.text;
    let mut text = format!("{document}\n");
    for sources in checks {
        let _ = write!(text, "check \"\" {{\n{}\n}}\n", sources.join("\n"));
    }
    let lowered = lang::lower_asking(&text, &|name| host.read(name), &state.lowered);
    let own = lowered
        .diagnostics
        .iter()
        .find(|d| d.place.file == base::FileId(0) && d.place.span.start as usize > document.len());
    let message = own.map(|d| d.message.clone());
    let known = lowered.checks.len().saturating_sub(checks.len());
    let meanings = lowered.checks.into_iter().skip(known).map(|check| check.statements);
    (meanings.collect(), message)
}

/// Returns the command that a statement is.
///
/// # Errors
/// It is none, or a value of it is none.
pub(crate) fn command_of(state: &State, kind: &StatementKind) -> Result<Command, Refusal> {
    Ok(match kind {
        StatementKind::Set(targets) => {
            let literal = |(path, term): &(Path, Term), answer: &Answer<'_>| {
                to_set(state, path, term, answer)
            };
            Command::Set(literals(state, targets, literal)?)
        }
        StatementKind::Move(targets) => {
            Command::Move(literals(state, targets, |_, answer| literal_of(answer))?)
        }
        StatementKind::Command(command) => command.clone(),
        StatementKind::Expect(_)
        | StatementKind::Note(..)
        | StatementKind::Try(_)
        | StatementKind::Unclear => {
            return Err(words::refuse("only an edit can be tried".into()));
        }
    })
}
