//! Loops that only give values, at the top of the document's own text: what their turns gave is copied, as long as
//! every word of them means what it meant.
//!
//! Unlike a plain part, a loop gives values to parts that other members declare. So it is noted beside its values which
//! part each of its words names, of which class and of how many elements.

use super::Added;
use crate::kept::SoFar;
use crate::loops::MOST_MEMBERS;
use crate::lower::{Lowered, Lowerer, OWN};
use crate::members::Pending;
use crate::scope::Scope;
use base::{Id, Name};
use kernel::{ClassId, ClassKind, Count, Primitive};
use std::collections::BTreeSet;
use std::rc::Rc;
use syntax::ast::{self, AstNode, Expr, Member};
use syntax::{NodeOrToken, SyntaxKind};

/// What the turns of a loop depend on beside the loop itself and the classes.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Looped {
    /// How many members the loop made.
    members: usize,
    /// Its words, and what each of them names.
    words: Vec<(Name, Option<Named>)>,
}

/// A part of the document that a word names.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
struct Named {
    /// A class that is declared; of lists, what they hold in the end.
    class: ClassId,
    /// How many lists are around that.
    lists: u32,
    count: Option<u32>,
}

/// A loop whose turns are not taken yet: they may be what they were.
#[derive(Clone, Debug)]
pub(crate) struct KeptLoop {
    member: usize,
    was: usize,
    shift: i64,
}

impl<'l> Lowerer<'l> {
    /// Leaves out the turns of a loop that may give what it gave; false for any other member.
    pub(super) fn may_keep_loop(
        &mut self,
        before: &Lowered,
        member: usize,
        (was, shift): (usize, i64),
    ) -> bool {
        let looped = before.added.get(was).and_then(|a| a.as_ref()?.looped.as_deref());
        let Some(Looped { members, .. }) = looped else { return false };
        let together = self.unrolled.saturating_add(*members);
        if together > MOST_MEMBERS {
            return false;
        }
        self.unrolled = together;
        self.pending.push(Pending::KeptLoop(KeptLoop { member, was, shift }));
        true
    }

    /// Decides on the loops whose turns were left out, once all parts are declared: the others take them now.
    pub(crate) fn decide_loops(&mut self) {
        let Some(before) = self.before else { return };
        if !self.pending.iter().any(|p| matches!(p, Pending::KeptLoop(_))) {
            return;
        }
        let spans: Vec<_> = self.files[OWN].parse.outline().map(|(_, span)| span).collect();
        let scope = Scope::of(OWN, self.document.root);
        for pending in std::mem::take(&mut self.pending) {
            let Pending::KeptLoop(KeptLoop { member, was, .. }) = &pending else {
                self.pending.push(pending);
                continue;
            };
            let looped = before.added[*was].as_ref().and_then(|added| added.looped.clone());
            let Some(looped) = looped else { continue };
            if self.named_by(looped.words.iter().map(|(name, _)| name)).as_ref()
                == Some(&looped.words)
            {
                self.pending.push(pending);
                continue;
            }
            self.unrolled -= looped.members;
            let node = self.files[OWN].parse.file().member_at(spans[*member]);
            if let Some(node) = node {
                self.declare_loop_anew(&scope, *member, node);
            }
        }
    }

    /// Declares a loop that only gives values, and notes what it gives.
    pub(super) fn declare_loop_anew(&mut self, scope: &Scope, member: usize, node: Member) {
        let words: BTreeSet<Name> = words_of(&node).into_iter().collect();
        self.pending.push(Pending::Note(member));
        let before = self.unrolled;
        self.declare_body(scope, vec![node]);
        let members = self.unrolled - before;
        self.pending.push(Pending::NotedLoop { member, members, words });
    }

    /// Notes what a loop gave, if it did no more than that.
    pub(crate) fn note_loop(
        &mut self,
        (member, members): (usize, usize),
        words: &BTreeSet<Name>,
        before: SoFar,
    ) {
        let now = self.so_far();
        let members = members.saturating_add(now.unrolled - before.unrolled);
        if before.with_givens(now.givens).with_unrolled(now.unrolled) != now {
            return;
        }
        let Some(words) = self.named_by(words.iter()) else { return };
        self.added[member] = Some(Added {
            part: None,
            first_given: before.givens as u32,
            givens: (now.givens - before.givens) as u32,
            looped: Some(Rc::new(Looped { members, words })),
        });
    }

    /// Gives what the turns of a loop gave before.
    pub(crate) fn keep_loop(&mut self, KeptLoop { member, was, shift }: &KeptLoop) {
        let Some(before) = self.before else { return };
        let Some(added) = before.added[*was].clone() else { return };
        let first_given = self.so_far().givens as u32;
        self.given_from[*member] = first_given;
        self.keep_givens(before, added.givens_range(), *shift);
        self.added[*member] = Some(Added { first_given, ..added });
    }

    /// Returns what words name among the document's parts; nothing where that does not say all of it.
    fn named_by<'n>(
        &self,
        words: impl Iterator<Item = &'n Name>,
    ) -> Option<Vec<(Name, Option<Named>)>> {
        words.map(|name| Some((name.clone(), self.named(name)?))).collect()
    }

    /// Returns true for a part of the document whose body gives a list its elements.
    fn gives_lists_in_body(&self, part: &Name) -> bool {
        let root = self.document.root;
        let mut from = self.given_in_bodies.range((root, part.clone(), Name::from(""))..);
        from.next().is_some_and(|((class, of, _), _)| (*class, of) == (root, part))
    }

    fn named(&self, name: &Name) -> Option<Option<Named>> {
        let root = self.document.root;
        let key = (root, name.clone());
        let is_more = self.messages.contains_key(&key)
            || self.constants.contains(&key)
            || self.broken.contains(&key)
            || self.given_counts.contains_key(&key)
            || self.gives_lists_in_body(name);
        if is_more {
            return None;
        }
        let Some(&index) = self.parts.get(&key) else { return Some(None) };
        let part = &self.document.classes[root].parts[index];
        let count = match part.count {
            Some(Count::Given) => return None,
            Some(Count::Fixed(count)) => Some(count),
            None => None,
        };
        let (mut class, mut lists) = (part.class, 0);
        while let ClassKind::List(element) = self.document.classes[class].kind
            && self.document.classes[class].elements.is_empty()
        {
            (class, lists) = (element, lists + 1);
        }
        // a whole number may say how often the loop runs: then its value counts
        let counts = |p: Primitive| lists == 0 && p.is_whole();
        if matches!(self.document.classes[class].kind, ClassKind::Primitive(p) if counts(p)) {
            return None;
        }
        let is_declared = class.index() < self.declared_classes
            && !self.counts.from_outside.contains(&(index as u32));
        is_declared.then_some(Some(Named { class, lists, count }))
    }
}

/// Returns the words of a loop.
fn words_of(member: &Member) -> Vec<Name> {
    let tokens = member.syntax().descendants_with_tokens().filter_map(NodeOrToken::into_token);
    tokens.filter(|t| t.kind() == SyntaxKind::Ident).map(|t| Name::from(t.text())).collect()
}

/// Returns true for a loop that does no more than give parts values, or other loops in it do.
pub(super) fn gives_only(member: &Member) -> bool {
    let Member::For(each) = member else { return false };
    crate::loops::members_of(each).iter().all(|member| match member {
        Member::For(_) => gives_only(member),
        Member::Assign(assign) => {
            let value = assign.value().and_then(ast::Value::expr);
            !assign.is_guide()
                && assign.target().is_some()
                && value.is_some_and(|value| !matches!(value, Expr::List(_)))
        }
        _ => false,
    })
}
