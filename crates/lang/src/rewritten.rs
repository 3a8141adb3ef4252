//! Rewritten: a text of which no more than given numbers are others means what it meant, but for these.
//!
//! In: what the text meant before, and the text after an edit of values. Out: what it means now, with nothing declared
//! anew: the values of the parts that changed are read alone, and all places are moved. Nothing where more than that may
//! be another: a part that changed is not plain ([`crate::kept`]), is declared otherwise, or gives other parts of its
//! own; something was wrong before or is now; what is used is another text.

use crate::alone::{Reader, knowing};
use crate::checks::Check;
use crate::kept::is_plain;
use crate::lessons::Lesson;
use crate::lower::{Lowered, Lowerer, OWN};
use crate::members::values_alone;
use crate::scope::Scope;
use base::{Name, Place, Span};
use kernel::{Given, Step};
use std::rc::Rc;
use syntax::Reparsed;
use syntax::ast::{self, AstNode, Expr, Member};

/// A part at the top of the text that is written otherwise than before.
struct Other {
    member: usize,
    was: ast::Part,
    is: ast::Part,
}

/// What a part gives now, in the order in which it gave it.
struct Anew {
    /// Where that begins among what the document gives.
    first: usize,
    givens: Vec<(Given, Place, Option<Name>)>,
}

/// Returns what a text means that differs from the one before by given numbers alone.
pub(crate) fn rewritten(
    text: &str,
    load: &dyn Fn(&str) -> Option<String>,
    before: &Lowered,
) -> Option<Lowered> {
    let is_right = before.patches.is_empty() && before.diagnostics.is_empty();
    if !is_right || !uses_the_same(before, load) {
        return None;
    }
    let again = syntax::reparse(OWN, &before.effective_parse, &before.effective, text);
    if !again.parse.diagnostics().is_empty() {
        return None;
    }
    let others = others(before, &again)?;
    let mut l = knowing(before);
    l.origins = before.origins.clone();
    let anew: Option<Vec<Anew>> = others.iter().map(|other| l.given_anew(before, other)).collect();
    let anew = anew?;
    let is_as_it_was = l.document.classes.len() == before.document.classes.len();
    if !is_as_it_was || !l.diagnostics.is_empty() {
        return None;
    }
    let moves = Moves::of(before, &again, &others);
    let mut next = Lowered {
        document: l.document,
        parts: l.parts,
        files: l.files,
        masters: before.masters.clone(),
        checks: before.checks.clone(),
        lessons: before.lessons.clone(),
        views: before.views.clone(),
        toolboxes: before.toolboxes.clone(),
        families: before.families.clone(),
        origins: before.origins.clone(),
        diagnostics: Vec::new(),
        doc: before.doc.clone(),
        missing: before.missing.clone(),
        effective: text.into(),
        effective_parse: again.parse,
        added: before.added.clone(),
        used: before.used.clone(),
        patches: Vec::new(),
        class_spans: before.class_spans.clone(),
        names: before.names.clone(),
        reader: Reader::default(),
    };
    next.files[OWN].text = next.effective.clone();
    next.files[OWN].parse = next.effective_parse.clone();
    next.move_all(&moves);
    let root = next.document.root;
    for Anew { first, givens } in anew {
        let all = &mut next.document.classes[root].givens;
        for (old, (given, place, unit)) in all[first..].iter_mut().zip(givens) {
            let origin = old.origin;
            *old = Rc::new(Given { origin, ..given });
            next.origins.put(origin, place);
            match unit {
                Some(unit) => next.document.units.insert(origin, unit),
                None => next.document.units.remove(&origin),
            };
        }
    }
    Some(next)
}

/// Whether what the text uses is as it was.
fn uses_the_same(before: &Lowered, load: &dyn Fn(&str) -> Option<String>) -> bool {
    let mut used = before.files.iter().map(|(_, file)| file).filter(|f| !f.name.is_empty());
    used.all(|file| load(&file.name).is_some_and(|text| *text == *file.text))
        && before.missing.iter().all(|name| load(name).is_none())
}

/// Returns the parts that are written otherwise; nothing where one may be another part, or where something else is.
fn others(before: &Lowered, again: &Reparsed) -> Option<Vec<Other>> {
    let mut others = Vec::new();
    let (was, is) = (&before.effective_parse, &again.parse);
    let spans = |parse: &syntax::Parse| parse.outline().map(|(_, span)| span).collect::<Vec<_>>();
    let (were, are) = (spans(was), spans(is));
    let (was, is) = (was.file(), is.file());
    for changed in &again.changed {
        if changed.before != changed.after {
            return None;
        }
        for member in changed.after.clone() {
            before.added.get(member)?.as_ref()?;
            let part = |file: &ast::File, spans: &[Span]| match file.member_at(spans[member])? {
                part @ Member::Part(_) if !is_plain(&part) => None,
                Member::Part(part) => Some(part),
                _ => None,
            };
            let (was, is) = (part(&was, &were)?, part(&is, &are)?);
            if declared(&was) != declared(&is) {
                return None;
            }
            others.push(Other { member, was, is });
        }
    }
    Some(others)
}

/// Returns what a part says before its values.
fn declared(part: &ast::Part) -> Option<String> {
    let whole = syntax::span_of(part.syntax());
    let value = part.value().and_then(ast::Value::expr).map(|value| value.span().start);
    let body = part.body().map(|body| syntax::span_of(body.syntax()).start);
    let until = value.into_iter().chain(body).min().unwrap_or(whole.end);
    let text = part.syntax().text().to_string();
    Some(text.get(..(until - whole.start) as usize)?.trim_end().to_string())
}

impl Lowerer<'_> {
    /// Returns what a part gives now, where it gives the same parts as before.
    fn given_anew(&mut self, before: &Lowered, other: &Other) -> Option<Anew> {
        let added = before.added[other.member]?;
        let root = self.document.root;
        let (scope, from) = (Scope::of(OWN, root), self.document.classes[root].givens.len());
        let name = other.is.names().next()?.name();
        let values = |part: &ast::Part| -> Option<Vec<(Option<Expr>, Expr)>> {
            let body = part.body().map(|body| values_alone(&body.members().collect::<Vec<_>>()));
            let mut all = match body {
                Some(values) => values?.into_iter().map(|(to, value)| (Some(to), value)).collect(),
                None => Vec::new(),
            };
            all.extend(part.value().and_then(ast::Value::expr).map(|value| (None, value)));
            Some(all)
        };
        let (were, are) = (values(&other.was)?, values(&other.is)?);
        if were.len() != are.len() {
            return None;
        }
        for (target, value) in are {
            self.define_value(&scope, vec![Step::Part(name.clone())], target.as_ref(), &value);
        }
        let new = self.document.classes[root].givens.split_off(from);
        let range = added.givens_range();
        let old = &before.document.classes[before.document.root].givens[range.clone()];
        let are_same = new.len() == old.len() && new.iter().zip(old).all(|(a, b)| a.path == b.path);
        let told = |given: Rc<Given>| {
            let unit = self.document.units.remove(&given.origin);
            (Given::clone(&given), self.origins.place(given.origin), unit)
        };
        let givens = new.into_iter().map(told).collect();
        are_same.then_some(Anew { first: range.start, givens })
    }
}

/// How places in the document's own text have moved.
struct Moves {
    /// From which byte on, by how many.
    steps: Vec<(u32, i64)>,
}

impl Moves {
    fn of(before: &Lowered, again: &Reparsed, others: &[Other]) -> Self {
        let were: Vec<Span> = before.effective_parse.outline().map(|(_, span)| span).collect();
        let are: Vec<Span> = again.parse.outline().map(|(_, span)| span).collect();
        let end = before.effective.len() as u32;
        let mut steps = Vec::new();
        let by = |was: u32, is: u32| (was, i64::from(is) - i64::from(was));
        let mut others = others.iter().peekable();
        for changed in &again.changed {
            while let Some(other) = others.next_if(|other| other.member < changed.after.end) {
                let (was, is) = (were[other.member], are[other.member]);
                steps.extend([by(was.start, is.start), by(was.end, is.end)]);
            }
            steps
                .push((were.get(changed.before.end).map_or(end, |span| span.start), changed.shift));
        }
        Self { steps }
    }
    fn at(&self, byte: u32) -> u32 {
        let known = self.steps.partition_point(|(from, _)| *from <= byte);
        let by = known.checked_sub(1).map_or(0, |last| self.steps[last].1);
        (i64::from(byte) + by) as u32
    }
    pub(crate) fn span(&self, span: Span) -> Span {
        Span::new(self.at(span.start), self.at(span.end))
    }
}

impl Lowered {
    fn move_all(&mut self, moves: &Moves) {
        self.origins.each(|place| {
            if place.file == OWN {
                place.span = moves.span(place.span);
            }
        });
        self.class_spans.iter_mut().for_each(|span| *span = moves.span(*span));
        let statement = |statement: &mut crate::checks::Statement| {
            statement.span = moves.span(statement.span);
            statement.whole = moves.span(statement.whole);
        };
        for Check { span, statements, .. } in &mut self.checks {
            *span = moves.span(*span);
            statements.iter_mut().for_each(statement);
        }
        for Lesson { span, steps, .. } in &mut self.lessons {
            *span = moves.span(*span);
            for step in steps {
                step.task.iter_mut().for_each(|task| task.span = moves.span(task.span));
                step.solution.iter_mut().for_each(statement);
            }
        }
    }
}
