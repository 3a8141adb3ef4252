//! References: which words of the document's own text speak of which member of which class.
//!
//! The lowerer itself says so, whenever it finds out what a word means; it is asked only when a
//! command has to know, by lowering the text once more. So what is renamed or deleted is found
//! wherever it is spoken of: in bodies, classes, messages, methods and checks.

use crate::kinds::Kind;
use crate::lower::{Lowered, Lowerer, OWN};
use base::{FileId, Name, Place, Span};
use kernel::ClassId;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Expr};

/// A member of a class by its name: a part, a message, a constraint or a merge.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Symbol {
    /// The class that declares it.
    pub(crate) class: ClassId,
    /// Its name there.
    pub(crate) name: Name,
}

/// What of the document's own text speaks of a member.
#[derive(Clone, Debug, Default)]
pub(crate) struct References {
    /// Every word that names one, by place.
    pub(crate) words: BTreeSet<(Span, Symbol)>,
    /// Every value that stands for one by its position in `(a, b)` or `C(a, b)`.
    pub(crate) positions: BTreeSet<(Span, Symbol)>,
    /// Every `(a, b)` that gives a thing its parts by position, and the thing's class.
    pub(crate) things: BTreeSet<(Span, ClassId)>,
}

impl Lowerer<'_> {
    /// Notes that a word speaks of a member of a class, or of one above it.
    pub(crate) fn refer(&mut self, place: Place, name: &Name, class: ClassId) {
        self.speak_of_used(place.file, name, class);
        if self.references.is_none() || place.file != OWN {
            return;
        }
        let symbol = self.symbol_of(name, class);
        if let (Some(symbol), Some(references)) = (symbol, &mut self.references) {
            references.words.insert((place.span, symbol));
        }
    }

    /// Notes which parts of a class's thing the values of an expression stand for by position.
    pub(crate) fn refer_by_position(&mut self, file: FileId, e: &Expr, wanted: &Kind) {
        let (Expr::Tuple(tuple), Kind::Thing(class)) = (e, wanted) else { return };
        let Some(references) = self.references.as_mut().filter(|_| file == OWN) else { return };
        references.things.insert((e.span(), *class));
        let fields = self.document.layout(*class);
        for (value, field) in tuple.elements().zip(fields) {
            let name = self.document.field_name(field).clone();
            let kind = Kind::of_class(&self.document, self.document.field_class(field));
            self.refer_position(file, value.span(), &name, *class);
            self.refer_by_position(file, &value, &kind);
        }
    }

    /// Notes that a value stands for a part by its position.
    pub(crate) fn refer_position(&mut self, file: FileId, span: Span, name: &Name, class: ClassId) {
        if self.references.is_none() || file != OWN {
            return;
        }
        let symbol = self.symbol_of(name, class);
        if let (Some(symbol), Some(references)) = (symbol, &mut self.references) {
            references.positions.insert((span, symbol));
        }
    }

    fn symbol_of(&self, name: &Name, class: ClassId) -> Option<Symbol> {
        let declares = |c: ClassId| {
            let key = (c, name.clone());
            self.named_at.contains_key(&key) || self.rule_names.contains_key(&key)
        };
        let class = self.document.lineage(class).into_iter().find(|&c| declares(c))?;
        Some(Symbol { class, name: name.clone() })
    }
}

impl Lowered {
    /// Finds what speaks of members, in the text as it is in force.
    pub(crate) fn references(&self) -> References {
        self.references_in(&self.effective)
    }

    /// Finds what speaks of members in another text, among the same files.
    pub(crate) fn references_in(&self, text: &str) -> References {
        let load = |name: &str| {
            let file = self.files.iter().find(|(id, f)| *id != OWN && f.name == name);
            file.map(|(_, f)| f.text.to_string())
        };
        crate::lower::references(text, &load)
    }
}
