//! Rewritten: a text of which no more than given numbers are others means what it meant, but for these.
//!
//! In: what the text meant before, and the text after an edit of values. Out: what it means now, with nothing declared
//! anew: the values that changed or came anew are read alone, and all places are moved. Nothing where more than that may
//! be another: a part that changed is not plain ([`crate::kept`]), is declared otherwise, or gives other parts of its
//! own; a value is given to another part, or says how many parts there are; something was wrong before or is now; what
//! is used is another text.

use crate::alone::{Reader, knowing};
use crate::checks::Check;
use crate::edits::is_count;
use crate::kept::{Added, is_plain, plain_value};
use crate::lessons::Lesson;
use crate::lower::{Lowered, Lowerer, OWN};
use crate::members::values_alone;
use crate::scope::Scope;
use base::{Name, Place, Span};
use kernel::{Given, Step};
use std::rc::Rc;
use syntax::Reparsed;
use syntax::ast::{self, AstNode, Expr, Member};

/// A member at the top of the text that is written otherwise than before.
struct Other {
    was: usize,
    is: usize,
    written: Written,
}

/// How it is written.
enum Written {
    /// A part, before and now.
    Part(ast::Part, ast::Part),
    /// A value of a part that another member declares: which, and what.
    Value(Expr, Expr),
    /// As it was: it stands between others.
    Alike,
}

/// What a member gives now, in the order in which it gave it.
struct Anew {
    /// Where that begins among what the document gives.
    first: usize,
    givens: Vec<(Given, Place, Option<Name>)>,
}

/// What is not as it was.
#[derive(Default)]
struct Others {
    /// Members that are written otherwise.
    changed: Vec<Other>,
    /// Values that came anew: which member each is, before which member of the text before it stands, of which part and
    /// what.
    new: Vec<(usize, usize, (Expr, Expr))>,
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
    let changed = others.changed.iter().filter(|o| !matches!(o.written, Written::Alike));
    let anew = changed.map(|other| l.given_anew(before, other));
    let anew = anew.collect::<Option<Vec<Anew>>>()?;
    let new = others.new.iter().map(|(_, at, value)| l.given_more(before, *at, value));
    let new = new.collect::<Option<Vec<Anew>>>()?;
    let is_as_it_was = l.document.classes.len() == before.document.classes.len()
        && l.spoken.is_subset(&before.names.spoken);
    if !is_as_it_was || !l.diagnostics.is_empty() {
        return None;
    }
    let moves = Moves::of(before, &again, &others.changed);
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
        given_from: before.given_from.clone(),
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
    for (n, ((member, ..), Anew { first, givens })) in others.new.iter().zip(new).enumerate() {
        for (given, place, unit) in givens {
            next.give(*member, first + n, (given, place, unit));
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

/// Returns what is written otherwise or came anew; nothing where that may be another part, or where something else is.
fn others(before: &Lowered, again: &Reparsed) -> Option<Others> {
    let mut others = Others::default();
    let (was, is) = (&before.effective_parse, &again.parse);
    let spans = |parse: &syntax::Parse| parse.outline().map(|(_, span)| span).collect::<Vec<_>>();
    let (were, are) = (spans(was), spans(is));
    let (was, is) = (was.file(), is.file());
    for changed in &again.changed {
        let mut old = changed.before.clone();
        for member in changed.after.clone() {
            let new = is.member_at(are[member])?;
            let known = old.start;
            let written = match old.is_empty() {
                true => None,
                false => otherwise(&was.member_at(were[known])?, &new),
            };
            match written {
                Some(written) => {
                    let is_known = matches!(before.added.get(known), Some(Some(_)));
                    if !is_known && !matches!(written, Written::Alike) {
                        return None;
                    }
                    others.changed.push(Other { was: known, is: member, written });
                    old.next();
                }
                None => others.new.push((member, known, plain_value(&new)?)),
            }
        }
        if !old.is_empty() {
            return None;
        }
    }
    Some(others)
}

/// Returns how a member is written that gives the parts that another gave; nothing where it may be something else.
fn otherwise(was: &Member, is: &Member) -> Option<Written> {
    match (was, is) {
        _ if was.syntax().green() == is.syntax().green() => Some(Written::Alike),
        (Member::Part(part), Member::Part(now)) if is_plain(was) && is_plain(is) => {
            let is_same = declared(part)? == declared(now)?;
            is_same.then(|| Written::Part(part.clone(), now.clone()))
        }
        (Member::Assign(_), Member::Assign(_)) => {
            let ((was, _), (is, value)) = (plain_value(was)?, plain_value(is)?);
            let is_same = was.syntax().text() == is.syntax().text();
            is_same.then_some(Written::Value(is, value))
        }
        _ => None,
    }
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
    /// Returns what a member gives now, where it gives the same parts as before.
    fn given_anew(&mut self, before: &Lowered, other: &Other) -> Option<Anew> {
        let added = before.added[other.was].as_ref()?;
        let (prefix, values) = match &other.written {
            Written::Part(was, is) => {
                let (were, are) = (values_of(was)?, values_of(is)?);
                if were.len() != are.len() {
                    return None;
                }
                (vec![Step::Part(is.names().next()?.name())], are)
            }
            Written::Value(target, value) => {
                (Vec::new(), vec![(Some(target.clone()), value.clone())])
            }
            Written::Alike => return None,
        };
        let new = self.given_alone(&prefix, &values)?;
        let range = added.givens_range();
        let old = &before.document.classes[before.document.root].givens[range.clone()];
        let are_same = new.len() == old.len()
            && new.iter().zip(old).all(|((a, ..), b)| a.path == b.path)
            && (!prefix.is_empty() || new.iter().all(|(given, ..)| !is_count(before, &given.path)));
        are_same.then_some(Anew { first: range.start, givens: new })
    }

    /// Returns what a value gives that comes anew before a member of the text before.
    fn given_more(
        &mut self,
        before: &Lowered,
        at: usize,
        (target, value): &(Expr, Expr),
    ) -> Option<Anew> {
        let new = self.given_alone(&[], &[(Some(target.clone()), value.clone())])?;
        let is_one = new.len() == 1 && new.iter().all(|(given, ..)| !is_count(before, &given.path));
        let first = *before.given_from.get(at)? as usize;
        is_one.then_some(Anew { first, givens: new })
    }

    /// Reads values alone; returns what they give, where they do no more than that.
    fn given_alone(
        &mut self,
        prefix: &[Step],
        values: &[(Option<Expr>, Expr)],
    ) -> Option<Vec<(Given, Place, Option<Name>)>> {
        let root = self.document.root;
        let (scope, from) = (Scope::of(OWN, root), self.so_far());
        for (target, value) in values {
            self.define_value(&scope, prefix.to_vec(), target.as_ref(), value);
        }
        let to = self.so_far();
        let new = self.document.classes[root].givens.split_off(from.givens());
        let told = |given: Rc<Given>| {
            let unit = self.document.units.remove(&given.origin);
            (Given::clone(&given), self.origins.place(given.origin), unit)
        };
        (to == from.with_givens(to.givens())).then(|| new.into_iter().map(told).collect())
    }
}

/// Returns the values that a part gives itself, in order; nothing where its body says more.
fn values_of(part: &ast::Part) -> Option<Vec<(Option<Expr>, Expr)>> {
    let body = part.body().map(|body| values_alone(&body.members().collect::<Vec<_>>()));
    let mut all = match body {
        Some(values) => values?.into_iter().map(|(to, value)| (Some(to), value)).collect(),
        None => Vec::new(),
    };
    all.extend(part.value().and_then(ast::Value::expr).map(|value| (None, value)));
    Some(all)
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
            while let Some(other) = others.next_if(|other| other.is < changed.after.end) {
                let (was, is) = (were[other.was], are[other.is]);
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
    /// Adds a value as a member gives it, at a place among what the document gives.
    fn give(
        &mut self,
        member: usize,
        at: usize,
        (given, place, unit): (Given, Place, Option<Name>),
    ) {
        let root = self.document.root;
        let origin = self.origins.add(place);
        if let Some(unit) = unit {
            self.document.units.insert(origin, unit);
        }
        self.document.classes[root].givens.insert(at, Rc::new(Given { origin, ..given }));
        for added in self.added[member..].iter_mut().flatten() {
            added.move_behind(1);
        }
        self.given_from[member..].iter_mut().for_each(|from| *from += 1);
        self.added.insert(member, Some(Added::value(at as u32)));
        self.given_from.insert(member, at as u32);
    }

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
