//! What a word of the text names: for whoever points at it, goes to where it is declared, or renames it.

use crate::Session;
use crate::host::{Beside, Host};
use crate::session::thing_at;
use crate::view::{DeclaredView, DocumentId, WordView};
use crate::{vocabulary, words};
use base::FileId;
use lang::{Meant, Mention};
use syntax::{SyntaxKind, SyntaxToken};

impl Session {
    /// Returns what a word names at an offset of a text that is being written in a document; nothing where it names
    /// nothing. Cost: that of reading the text once.
    pub fn word_at(&self, id: DocumentId, text: &str, offset: u32) -> Option<WordView> {
        let id = self.home(id);
        let beside = Beside::of(&*self.host, &self.documents, id);
        let tree = syntax::parse(FileId(0), text).syntax();
        let at = tree.token_at_offset(offset.min(text.len() as u32).into());
        let is_word = |token: &SyntaxToken| {
            let kind = token.kind();
            kind == SyntaxKind::Ident || kind == SyntaxKind::Unit || kind.is_reserved()
        };
        let token = at
            .clone()
            .right_biased()
            .filter(is_word)
            .or_else(|| at.left_biased().filter(is_word))?;
        let span = syntax::span_of_token(&token);
        let mentions = lang::mentions(text, &|name| beside.read(name));
        match mentions.iter().find(|mention| mention.span == span) {
            Some(mention) => Some(self.named(id, mention, &mentions, &beside)),
            None => library(&token, &beside).or_else(|| of_language(&token)),
        }
    }

    fn named(
        &self,
        id: DocumentId,
        mention: &Mention,
        all: &[Mention],
        host: &dyn Host,
    ) -> WordView {
        let open = self.document(id);
        let is_same = |other: &&Mention| {
            (other.meant, &other.path, &other.declared)
                == (mention.meant, &mention.path, &mention.declared)
        };
        let uses = all.iter().filter(is_same).map(|m| (m.span.start, m.span.end)).collect();
        let is_thing = mention.meant != Meant::Class;
        let thing = is_thing.then(|| thing_at(&open.state, &mention.path)).flatten();
        let declared = mention.declared.as_ref().map(|(file, span)| DeclaredView {
            text: if file.is_empty() { String::new() } else { host.read(file).unwrap_or_default() },
            file: file.clone(),
            start: span.start,
            end: span.end,
        });
        WordView {
            start: mention.span.start,
            end: mention.span.end,
            says: mention.says.clone(),
            doc: mention.doc.clone(),
            value: thing.and_then(|thing| words::show_thing(&open.state, thing, open.values())),
            path: mention.path.to_string(),
            declared,
            uses,
        }
    }
}

/// Says of a library's name after `use` what the library is.
fn library(token: &SyntaxToken, host: &dyn Host) -> Option<WordView> {
    let used = token.parent_ancestors().find(|node| node.kind() == SyntaxKind::Use)?;
    let written = used.text().to_string();
    let name = written.split_whitespace().nth(1)?;
    let text = host.read(name)?;
    let doc: Vec<&str> = text
        .lines()
        .take_while(|line| line.starts_with("//"))
        .map(|line| line.trim_start_matches('/').trim())
        .collect();
    let span = syntax::span_of_token(token);
    Some(WordView {
        start: span.start,
        end: span.end,
        says: format!("library {name}"),
        doc: doc.join(" "),
        value: None,
        path: String::new(),
        declared: Some(DeclaredView { file: name.into(), text, start: 0, end: 0 }),
        uses: Vec::new(),
    })
}

/// Says what a word of the language itself is: a function, a unit, a quantity.
fn of_language(token: &SyntaxToken) -> Option<WordView> {
    let word = token.text();
    let function = vocabulary::functions().into_iter().find(|f| f.name == word);
    let unit = || vocabulary::units().into_iter().find(|u| u.spelling == word);
    let quantity = || vocabulary::quantities().into_iter().find(|(name, _)| *name == word);
    let (says, doc) = if let Some(f) = function {
        let domain =
            if f.domain.is_empty() { String::new() } else { format!(" For {}.", f.domain) };
        (f.call, format!("{}{domain}", f.doc))
    } else if let Some(u) = (token.kind() == SyntaxKind::Unit).then(unit).flatten() {
        (format!("{}, a unit", u.name), u.quantity)
    } else {
        let (name, unit) = quantity()?;
        (
            name.to_string(),
            if unit.is_empty() { String::new() } else { format!("Shown in {unit}.") },
        )
    };
    let span = syntax::span_of_token(token);
    let (path, value, declared, uses) = (String::new(), None, None, Vec::new());
    Some(WordView { start: span.start, end: span.end, says, doc, value, path, declared, uses })
}
