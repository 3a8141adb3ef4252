//! Mentions: what the words of the document's own text name, and where that is declared, for whoever edits the text.
//!
//! In: a text that was lowered with a record of what its words speak of. Out: plain facts, without ids.

use crate::edits::is_class_name;
use crate::lower::{Lowerer, OWN};
use crate::references::Symbol;
use base::{Name, Place, Span};
use kernel::{ClassId, Path, Step};
use std::collections::BTreeMap;
use syntax::{SyntaxElement, SyntaxKind};

/// A word of the document's own text, and what it names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mention {
    /// Where the word stands.
    pub span: Span,
    /// What it names.
    pub meant: Meant,
    /// What that is called, from the document or, of a member of a class, from the class: `q.side1`, `Line.p1`.
    pub path: Path,
    /// How it was declared, in a line: `p1: Point`, `class Line`, `scaled(by: Real)`.
    pub says: String,
    /// What `///` says of it.
    pub doc: String,
    /// Where its name is declared: the file as `use` names it, empty for the document, and the word there.
    pub declared: Option<(String, Span)>,
}

/// What a word can name.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Meant {
    /// A class.
    Class,
    /// A part.
    Part,
    /// A message, or a virtual part.
    Message,
    /// A constraint or a merge.
    Constraint,
}

impl Lowerer<'_> {
    /// Returns what every word of the document's own text names, in order of the text.
    pub(crate) fn mentions(mut self) -> Vec<Mention> {
        let spoken = self.references.take().unwrap_or_default().words;
        let mut words: BTreeMap<Span, Symbol> = spoken.into_iter().collect();
        let own = |(symbol, place): (&(ClassId, Name), &Place)| {
            let symbol = Symbol { class: symbol.0, name: symbol.1.clone() };
            (place.file == OWN).then_some((place.span, symbol))
        };
        words.extend(self.named_at.iter().filter_map(own));
        words.extend(self.rule_names.iter().filter_map(own));
        let members = words.into_iter().filter_map(|(span, symbol)| self.of_member(span, &symbol));
        let mut all: Vec<Mention> = members.chain(self.of_classes()).collect();
        all.sort_by_key(|mention| mention.span);
        all.dedup_by_key(|mention| mention.span);
        all
    }

    fn of_member(&self, span: Span, symbol: &Symbol) -> Option<Mention> {
        let class = &self.document.classes[symbol.class];
        let key = (symbol.class, symbol.name.clone());
        let part = self.parts.get(&key).and_then(|&i| class.parts.get(i));
        let message = self.messages.get(&key).and_then(|&i| class.messages.get(i));
        let name = |class: ClassId| self.class_name(class);
        let (meant, says, doc) = if let Some(part) = part {
            (Meant::Part, format!("{}: {}", part.name, name(part.class)), part.doc.clone())
        } else if let Some(message) = message {
            let parameter = |p: &kernel::Parameter| match p.class {
                Some(class) => format!("{}: {}", p.label, name(class)),
                None => p.label.to_string(),
            };
            let parameters: Vec<String> = message.parameters.iter().map(parameter).collect();
            let parameters = match parameters.is_empty() {
                true => String::new(),
                false => format!("({})", parameters.join(", ")),
            };
            let answer = message.class.map(|c| format!(": {}", name(c))).unwrap_or_default();
            let says = format!("{}{parameters}{answer}", message.word());
            (Meant::Message, says, message.doc.clone())
        } else {
            let is_it = |c: &&kernel::Constraint| c.name.as_ref() == Some(&symbol.name);
            let doc = class.constraints.iter().find(is_it).map(|c| c.doc.to_string());
            (Meant::Constraint, format!("constraint {}", symbol.name), doc.unwrap_or_default())
        };
        let place = self.named_at.get(&key).or_else(|| self.rule_names.get(&key));
        let path = self.path_to_members(symbol.class).then(Step::Part(symbol.name.clone()));
        let declared = place.and_then(|&place| self.declared(place));
        Some(Mention { span, meant, path, says, doc, declared })
    }

    /// Returns the words that name classes.
    fn of_classes(&self) -> Vec<Mention> {
        let tree = self.files[OWN].parse.syntax();
        let tokens = tree.descendants_with_tokens().filter_map(SyntaxElement::into_token);
        let words = tokens.filter(|t| t.kind() == SyntaxKind::Ident && is_class_name(t));
        let mention = |word: syntax::SyntaxToken| {
            let class = self.document.class_named(word.text())?;
            let says = &self.document.classes[class];
            // a quantity is declared nowhere
            let declared = self.word_in(self.origins.place(says.origin), &says.name)?;
            let above = match says.supers.first() {
                Some(above) if above.class != self.object => {
                    format!(" is a {}", self.class_name(above.class))
                }
                Some(_) | None => String::new(),
            };
            Some(Mention {
                span: syntax::span_of_token(&word),
                meant: Meant::Class,
                path: Path(vec![Step::Part(says.name.clone())]),
                says: format!("class {}{above}", says.name),
                doc: says.doc.clone(),
                declared: Some(declared),
            })
        };
        words.filter_map(mention).collect()
    }

    /// Returns from where a class's members are named: the class, or the thing whose class it is alone.
    fn path_to_members(&self, class: ClassId) -> Path {
        let says = &self.document.classes[class];
        if class == self.document.root {
            return Path::default();
        }
        // the class of one thing is called as its path
        Path(says.name.split('.').map(|step| Step::Part(step.into())).collect())
    }

    fn class_name(&self, class: ClassId) -> &str {
        &self.document.classes[self.document.named_class(class)].name
    }

    fn declared(&self, place: Place) -> Option<(String, Span)> {
        Some((self.files.get(place.file)?.name.clone(), place.span))
    }

    /// Returns where a name stands first in what was written at a place.
    fn word_in(&self, place: Place, name: &str) -> Option<(String, Span)> {
        let file = self.files.get(place.file)?;
        let tree = file.parse.syntax();
        let tokens = tree.descendants_with_tokens().filter_map(SyntaxElement::into_token);
        let mut within = tokens
            .filter(|t| place.span.range().contains(&(u32::from(t.text_range().start()) as usize)));
        let word = within.find(|t| t.kind() == SyntaxKind::Ident && t.text() == name)?;
        Some((file.name.clone(), syntax::span_of_token(&word)))
    }
}
