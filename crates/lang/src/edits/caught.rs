//! Words that would mean something else once a member has another name.
//!
//! In: the edits of a renaming. Out: the same, with `owner.` before each word that the new name would catch, or that
//! would be caught. The text is read as it would be, and each of its words compared with what it meant.

use crate::references::{References, Symbol};
use crate::uses::Text;
use base::{Diagnostic, Name, Place, Span};
use kernel::ClassId;
use kernel::builtin::{FUNCTIONS, THING_MESSAGES, find};
use std::collections::BTreeSet;
use syntax::ast::{AstNode, NameExpr};
use syntax::edit::{self, TextEdit};

/// What a word lies inside of, at most, for it to be found by `owner.owner.`.
const MOST_OWNERS: usize = 4;

impl Text<'_> {
    /// Lets every word mean what it meant before a member was called otherwise.
    ///
    /// # Errors
    /// A word would mean something else, one of the language too, and cannot be written so that it does not.
    pub(super) fn meaning_the_same(
        &self,
        mut edits: Vec<TextEdit>,
        (renamed, to): (&Symbol, &Name),
        before: &References,
    ) -> Result<Vec<TextEdit>, Diagnostic> {
        let renamed_to = |symbol: &Symbol| match symbol == renamed {
            true => Symbol { class: symbol.class, name: to.clone() },
            false => symbol.clone(),
        };
        if let Some(span) = self.spoken_of_by_the_language(to, before) {
            return Err(self.caught(span, to));
        }
        let mut owners = 0;
        loop {
            let changed = self.changed_words(&edits, before, &renamed_to);
            let Some(&first) = changed.first() else { return Ok(edits) };
            let may_have_owner = |span: &Span| self.is_bare_name(*span);
            if owners == MOST_OWNERS || !changed.iter().all(may_have_owner) {
                return Err(self.caught(first, to));
            }
            owners += 1;
            for span in changed {
                let word = self.lowered.effective.get(span.range()).unwrap_or_default();
                let at = edits.iter().position(|e| e.span == span);
                let said = at.map_or(word, |i| last_word(&edits[i].insert));
                let insert = format!("{}{said}", "owner.".repeat(owners));
                edits.splice(at.map_or(0..0, |i| i..i + 1), [TextEdit { span, insert }]);
            }
        }
    }

    /// Returns the words, by place, that mean something else in the text as edits make it.
    fn changed_words(
        &self,
        edits: &[TextEdit],
        before: &References,
        renamed: &impl Fn(&Symbol) -> Symbol,
    ) -> Vec<Span> {
        let after = self.lowered.references_in(&edit::apply(&self.lowered.effective, edits));
        let is_same = |span: Span| {
            let there = moved(span, edits);
            let was: BTreeSet<Symbol> = meant(before, span).map(renamed).collect();
            meant(&after, there).eq(was.iter())
        };
        let mut spans: Vec<Span> = before.words.iter().map(|(span, _)| *span).collect();
        spans.dedup();
        spans.retain(|&span| !is_same(span));
        spans
    }

    /// Returns where a bare word stands that no member has and the language knows, `pi` or `parts`: a member of that name
    /// would be meant instead.
    fn spoken_of_by_the_language(&self, word: &Name, before: &References) -> Option<Span> {
        let is_number = find(FUNCTIONS, word).is_some_and(|f| f.parameters.is_empty());
        if !is_number && find(THING_MESSAGES, word).is_none() {
            return None;
        }
        let names = self.file.syntax().descendants().filter_map(NameExpr::cast);
        let words = names.filter_map(|name| name.name()).filter(|said| said.name() == *word);
        { words }.map(|said| said.span()).find(|&span| meant(before, span).next().is_none())
    }

    /// Returns true for a name that stands for itself, before which `owner.` may be written.
    fn is_bare_name(&self, span: Span) -> bool {
        let token = self.file.syntax().token_at_offset(span.start.into()).right_biased();
        token.and_then(|t| t.parent()).is_some_and(|parent| NameExpr::cast(parent).is_some())
    }

    fn caught(&self, span: Span, to: &Name) -> Diagnostic {
        let word = self.lowered.effective.get(span.range()).unwrap_or_default();
        let message = format!("as {to} it would be mistaken here, where {word} is spoken of");
        let place = match self.lowered.in_text(span) {
            Some(span) => Place { file: crate::lower::OWN, span },
            None => Place { file: crate::lower::OWN, span: Span::default() },
        };
        Diagnostic::error("duplicate-name", place, message)
            .hint("choose a name that nothing else has")
    }
}

/// Returns what a word means.
fn meant(references: &References, span: Span) -> impl Iterator<Item = &Symbol> {
    let first = Symbol { class: ClassId(0), name: Name::new("") };
    let from = references.words.range((span, first)..);
    from.take_while(move |(at, _)| *at == span).map(|(_, symbol)| symbol)
}

/// Returns where a word is in the text that edits make.
fn moved(span: Span, edits: &[TextEdit]) -> Span {
    let mut at = i64::from(span.start);
    let mut length = i64::from(span.end - span.start);
    for edit in edits {
        if edit.span == span {
            let word = last_word(&edit.insert).len();
            at += (edit.insert.len() - word) as i64;
            length = word as i64;
        } else if edit.span.end <= span.start {
            at += edit.insert.len() as i64 - i64::from(edit.span.end - edit.span.start);
        }
    }
    Span::new(at as u32, (at + length) as u32)
}

/// Returns what stands behind the last dot.
fn last_word(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}
