//! Kept: parts of the document that are written as they were say what they said.
//!
//! A part at the top of the document's own text, of a class that is declared and with values that are
//! constants, depends on the classes alone. Where these are as they were, and the part's node is the
//! one that it was, its part and given values are copied from what the text meant before. What the turns of a loop
//! give is copied too (`kept/loops.rs`).

pub(crate) mod loops;
pub(crate) mod used;

use crate::counts::has_named_count;
use crate::files::File;
use crate::kept::loops::{Looped, gives_only};
use crate::lower::{Lowered, Lowerer, OWN};
use crate::members::{Pending, is_constant, values_alone};
use crate::scope::Scope;
use base::{Id, Place, Span};
use kernel::{Count, Given, Part};
use std::ops::Range;
use std::rc::Rc;
use syntax::ast::{AstNode, Expr, Member, Value};
use syntax::{Changed, Parse, SyntaxKind};

/// What a member at the top of the text added to the document's class: one part whose class depends on the classes
/// alone, with some given values; or one value of a part that another member declares, or those of a loop.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Added {
    part: Option<u32>,
    first_given: u32,
    givens: u32,
    /// What else the values of a loop depend on.
    looped: Option<Rc<Looped>>,
}

/// How much there is that values may add to.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct SoFar {
    givens: usize,
    /// Merges, constraints and the like of the document.
    rules: usize,
    classes: usize,
    diagnostics: usize,
    /// Members of loops.
    unrolled: usize,
    /// Names that were looked for in what things are merged with.
    asked: usize,
}

impl SoFar {
    /// How many values the document gives.
    pub(crate) fn givens(self) -> usize {
        self.givens
    }
    /// The same with so many values.
    pub(crate) fn with_givens(self, givens: usize) -> Self {
        Self { givens, ..self }
    }
    /// The same with so many members of loops.
    fn with_unrolled(self, unrolled: usize) -> Self {
        Self { unrolled, ..self }
    }
}

impl Added {
    /// Where its values are among those that the document gives.
    pub(crate) fn givens_range(&self) -> Range<usize> {
        let first = self.first_given as usize;
        first..first + self.givens as usize
    }
    /// Moves it behind more values.
    pub(crate) fn move_behind(&mut self, more: u32) {
        self.first_given += more;
    }
    /// One value, of a part that another member declares.
    pub(crate) fn value(first_given: u32) -> Self {
        Self { part: None, first_given, givens: 1, looped: None }
    }
}

/// Members at the top of the text, one after the other, that say what they said.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    members: Range<usize>,
    /// The part that the first of them is, now, and which member it was.
    part: u32,
    was: usize,
    /// How far they have moved.
    shift: i64,
}

/// The members at the top of the document's own text, of which some are declared.
#[derive(Debug)]
pub(crate) struct OwnMembers {
    scope: Scope,
    members: Vec<Span>,
    next: usize,
    /// Whether what the text meant before says what members say that are as they were.
    is_known: bool,
    /// How many classes there were before.
    classes: usize,
}

impl OwnMembers {
    /// How many members there are.
    pub(crate) fn count(&self) -> usize {
        self.members.len()
    }
    /// How many are not declared yet.
    pub(crate) fn left(&self) -> usize {
        self.members.len() - self.next
    }
}

/// Returns which member of the text before a member is, and how far it has moved; nothing for another one.
fn member_before(changed: &[Changed], member: usize) -> Option<(usize, i64)> {
    match &changed[..changed.partition_point(|c| c.after.start <= member)] {
        [] => Some((member, 0)),
        [.., last] => Some((last.before.end + member.checked_sub(last.after.end)?, last.shift)),
    }
}

impl Run {
    /// Returns true if a member that was another one stands behind these, as it did.
    fn goes_on(&self, member: usize, was: usize, shift: i64) -> bool {
        self.members.end == member && self.was + self.members.len() == was && self.shift == shift
    }
}

impl<'l> Lowerer<'l> {
    /// Returns what the text meant before, unless that says nothing about members that are as they were:
    /// where a class is another one.
    fn known(&self) -> Option<&'l Lowered> {
        let before = self.before?;
        let is_same = |(a, b): (&File, &File)| a.name == b.name && a.text == b.text;
        let used = self.files.iter().zip(before.files.iter()).skip(1);
        let mut used = used.map(|((_, a), (_, b))| (a, b));
        if self.files.len() != before.files.len() || !used.all(is_same) {
            return None;
        }
        let kinds = [
            SyntaxKind::Class,
            SyntaxKind::Choice,
            SyntaxKind::Program,
            SyntaxKind::Use,
            SyntaxKind::UnitLine,
            SyntaxKind::YLine,
        ];
        let has_other = |parse: &Parse, members: &dyn Fn(&Changed) -> Range<usize>| {
            let mut others = self.changed.iter().flat_map(members).peekable();
            let mut all = (0..).zip(parse.outline());
            others.any(|member| {
                all.by_ref()
                    .find(|(i, _)| *i == member)
                    .is_some_and(|(_, (kind, _))| kinds.contains(&kind))
            })
        };
        let is_other = has_other(&self.files[OWN].parse, &|c| c.after.clone())
            || has_other(&before.effective_parse, &|c| c.before.clone());
        (!is_other).then_some(before)
    }

    /// Begins to declare what the document's own text adds to the document's class.
    pub(crate) fn begin_own(&mut self, scope: Scope) -> OwnMembers {
        let before = self.known();
        let members: Vec<Span> = self.files[OWN].parse.outline().map(|(_, span)| span).collect();
        self.added = vec![None; members.len()];
        self.given_from = vec![0; members.len()];
        if let Some(before) = before {
            self.reserve(before);
        }
        let classes = self.document.classes.len();
        self.declared_classes = classes;
        OwnMembers { scope, members, next: 0, is_known: before.is_some(), classes }
    }

    /// Declares so many more of these members; returns whether any are left.
    pub(crate) fn declare_own(&mut self, own: &mut OwnMembers, most: usize) -> bool {
        let file = self.files[OWN].parse.file();
        let before = self.before.filter(|_| own.is_known);
        let to = own.members.len().min(own.next + most);
        for member in own.next..to {
            let span = own.members[member];
            let known = before.zip(member_before(&self.changed, member));
            let part = self.document.classes[own.scope.class()].parts.len() as u32;
            if let Some((before, (was, shift))) = known
                && self.keep_part(&own.scope, before, was, span)
            {
                match self.pending.last_mut() {
                    Some(Pending::Kept(run)) if run.goes_on(member, was, shift) => {
                        run.members.end += 1;
                    }
                    _ => {
                        let members = member..member + 1;
                        self.pending.push(Pending::Kept(Run { members, part, was, shift }));
                    }
                }
                continue;
            }
            if let Some((before, moved)) = known
                && self.may_keep_loop(before, member, moved)
            {
                continue;
            }
            match file.member_at(span) {
                Some(node) if gives_only(&node) => self.declare_loop_anew(&own.scope, member, node),
                Some(node) => self.declare_anew(own, (member, part), node),
                None => {}
            }
        }
        own.next = to;
        own.left() > 0
    }

    /// Declares a member that is not as it was; `part` is the next part's index.
    fn declare_anew(&mut self, own: &OwnMembers, (member, part): (usize, u32), node: Member) {
        let effects = |l: &Self| (l.pending.len(), l.document.classes.len(), l.diagnostics.len());
        let (from, made, said) = effects(self);
        let (is_plain, is_value) = (is_plain(&node), plain_value(&node).is_some());
        self.pending.push(Pending::Note(member));
        self.declare_body(&own.scope, vec![node]);
        let (to, made_now, said_now) = effects(self);
        let givens = (to - from - 1) as u32;
        let is_alone = (made, said) == (made_now, said_now);
        if is_value && is_alone && givens == 1 {
            return self.pending.push(Pending::Noted { member, part: None, givens });
        }
        let is_one = match &self.document.classes[own.scope.class()].parts[part as usize..] {
            // how many elements a list is given is counted where it is declared
            [part] => part.class.index() < own.classes && part.count != Some(Count::Given),
            _ => false,
        };
        if is_plain && is_one && is_alone {
            self.pending.push(Pending::Noted { member, part: Some(part), givens });
        }
    }

    /// Makes room for as many parts and values as there were.
    fn reserve(&mut self, before: &Lowered) {
        let class = &mut self.document.classes[self.document.root];
        let was = &before.document.classes[before.document.root];
        class.parts.reserve(was.parts.len());
        class.givens.reserve(was.givens.len());
        self.parts.reserve(was.parts.len());
        self.named_at.reserve(was.parts.len());
        self.origins.reserve(was.parts.len() + was.givens.len());
    }

    /// Declares a part as it was declared before; false where its name is taken now.
    fn keep_part(&mut self, scope: &Scope, before: &Lowered, was: usize, span: Span) -> bool {
        let Some(Some(added)) = before.added.get(was) else { return false };
        let Some(index) = added.part else { return false };
        let root = before.document.root;
        let part = &before.document.classes[root].parts[index as usize];
        if self.named_at.contains_key(&(scope.class(), part.name.clone())) {
            return false;
        }
        let origin = self.origin(OWN, span);
        let end = span.start + part.name.as_str().len() as u32;
        let place = Place { file: OWN, span: Span::new(span.start, end) };
        self.add_part(place, scope.class(), Part { origin, ..part.clone() });
        true
    }

    /// Gives parts that were kept the values that they were given before.
    pub(crate) fn keep_values(&mut self, run: Run) {
        let (Some(before), root) = (self.before, self.document.root) else { return };
        let were = before.added[run.was..].iter().flatten();
        for ((member, part), was) in run.members.zip(run.part..).zip(were) {
            let first_given = self.document.classes[root].givens.len() as u32;
            self.keep_givens(before, was.givens_range(), run.shift);
            self.given_from[member] = first_given;
            self.added[member] =
                Some(Added { part: Some(part), first_given, givens: was.givens, looped: None });
        }
    }

    /// Gives what was given before by these, which have moved so far.
    fn keep_givens(&mut self, before: &Lowered, these: Range<usize>, shift: i64) {
        let root = self.document.root;
        for given in &before.document.classes[before.document.root].givens[these] {
            let place = before.origins.place(given.origin);
            let moved = |at: u32| (i64::from(at) + shift) as u32;
            let span = Span::new(moved(place.span.start), moved(place.span.end));
            let origin = self.origin(OWN, span);
            if let Some(unit) = before.document.units.get(&given.origin) {
                self.document.units.insert(origin, unit.clone());
            }
            let given = match given.origin == origin {
                true => given.clone(),
                false => Rc::new(Given { origin, ..Given::clone(given) }),
            };
            self.document.classes[root].givens.push(given);
        }
    }

    /// Returns what tells whether values did more than give.
    pub(crate) fn so_far(&self) -> SoFar {
        let root = &self.document.classes[self.document.root];
        let rules = root.constraints.len() + root.merges.len() + root.bindings.len();
        let rules = rules + root.stays.len() + root.switches.len() + root.sides.len();
        let rules = rules + self.switches.len();
        SoFar {
            givens: root.givens.len(),
            rules,
            classes: self.document.classes.len(),
            diagnostics: self.diagnostics.len(),
            unrolled: self.unrolled,
            asked: self.kin.asked,
        }
    }

    /// Begins the values of a member of the document.
    pub(crate) fn begin_note(&mut self, member: usize) -> SoFar {
        let now = self.so_far();
        self.given_from[member] = now.givens as u32;
        now
    }

    /// Notes what a member of the document and its values added, if they did no more than that.
    pub(crate) fn note(&mut self, member: usize, part: Option<u32>, givens: u32, before: SoFar) {
        let first_given = before.givens as u32;
        let is_as_declared = part.is_none_or(|part| !self.counts.from_outside.contains(&part));
        let wanted = SoFar { givens: before.givens + givens as usize, ..before };
        if is_as_declared && self.so_far() == wanted {
            self.added[member] = Some(Added { part, first_given, givens, looped: None });
        }
    }
}

/// Returns what one value alone says, of which part and what: numbers, words and truth values, places of such.
pub(crate) fn plain_value(member: &Member) -> Option<(Expr, Expr)> {
    let Member::Assign(assign) = member else { return None };
    let (target, value) = (assign.target()?, assign.value()?.expr()?);
    // a list says how many elements there are, a thing of a class which class it is
    let is_made = |kind| matches!(kind, SyntaxKind::ListExpr | SyntaxKind::CallExpr);
    let is_plain = !assign.is_guide()
        && is_constant(&value)
        && !value.syntax().descendants().any(|node| is_made(node.kind()));
    is_plain.then_some((target, value))
}

/// Returns true for one part without a comment, all of whose values are constants.
pub(crate) fn is_plain(member: &Member) -> bool {
    let Member::Part(part) = member else { return false };
    let value = part.value().map(|v| Value::expr(v).is_some_and(|e| is_constant(&e)));
    let values = || part.body().map(|b| values_alone(&b.members().collect::<Vec<_>>()));
    part.definition().is_none()
        && !part.is_constant()
        && !has_named_count(part)
        && part.doc().is_none()
        && part.names().count() == 1
        && value.unwrap_or(true)
        && values().is_none_or(|v| v.is_some())
}
