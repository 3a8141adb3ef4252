//! Answers: what messages are worth, found out where that is first asked, and what they answer, once all merges are
//! known.
//!
//! In: definitions. Out: kinds and terms. To find out what a message is worth is to read its answer; what is read alike
//! when its turn comes is read once.

use crate::kinds::{Kind, measured};
use crate::lower::{Lowerer, OWN};
use crate::members::Definition;
use crate::scope::Scope;
use base::Name;
use kernel::ClassId;
use std::rc::Rc;
use syntax::ast::Expr;

/// How many expressions may stand inside one another before a message's worth is left open.
const DEEPEST: u32 = 200;

impl Lowerer<'_> {
    /// Finds out what a message is worth, once.
    pub(crate) fn message_kind(&mut self, definer: ClassId, name: &Name) -> Kind {
        let key = (definer, name.clone());
        if let Some(known) = self.message_kinds.get(&key) {
            self.open_readings += usize::from(known.is_none());
            return known.clone().unwrap_or(Kind::Unknown);
        }
        if self.depth > DEEPEST {
            self.open_readings += 1;
            return Kind::Unknown;
        }
        let Some(definition) = self.definitions.get(&key).cloned() else {
            self.define_program_of(definer);
            return self.message_kinds.get(&key).cloned().flatten().unwrap_or(Kind::Unknown);
        };
        self.message_kinds.insert(key.clone(), None);
        self.silent += 1;
        let kind = self.kind_read(&definition).unwrap_or(Kind::Unknown);
        self.silent -= 1;
        self.message_kinds.insert(key, Some(kind.clone()));
        kind
    }

    /// Finds out what a definition is worth; keeps what it answers where reading that once more gives the same.
    fn kind_read(&mut self, definition: &Definition) -> Option<Kind> {
        let Definition { answer, scope, loops, .. } = definition;
        if !loops.is_empty() {
            return self.kind_of_answer(scope, loops, answer);
        }
        let before = self.open_readings;
        let (term, kind) = self.expr(scope, answer)?;
        // of a text that is used nothing is warned
        let is_sure = self.has_merged && scope.file != OWN && self.open_readings == before;
        let is_kept = is_sure && self.references.is_none() && is_read_alike(answer, &kind);
        if is_kept && kind.fits(&kind, &self.document) {
            let term = measured(&self.document, term, &kind, &kind);
            let _ = definition.read.set((Rc::new(term), kind.clone()));
        }
        Some(kind)
    }

    /// Lowers what a message answers.
    pub(crate) fn define_answer(&mut self, scope: &Scope, index: usize, definition: &Definition) {
        let class = scope.class();
        let name = self.document.classes[class].messages[index].name.clone();
        let wanted = self.message_kind(class, &name);
        let Definition { answer, loops, read, .. } = definition;
        let term = match read.get().filter(|(_, kind)| *kind == wanted) {
            Some((term, _)) => {
                self.refer_by_position(scope.file, answer, &wanted);
                Some(term.clone())
            }
            None => self.answer_of(scope, loops, answer, &wanted).map(Rc::new),
        };
        match term {
            Some(term) => {
                self.speaks_of_no_thing(scope, &name, answer, &term);
                self.document.classes[class].messages[index].answer = term;
                if loops.is_empty() {
                    self.tell_angle(scope, index, answer);
                }
            }
            None => {
                self.messages.shift_remove(&(class, name.clone()));
                self.broken.insert((class, name));
            }
        }
    }
}

/// Returns true for an expression of a kind that is read alike where that kind is wanted and where none is.
fn is_read_alike(e: &Expr, kind: &Kind) -> bool {
    match kind {
        Kind::Number(_)
        | Kind::Bool
        | Kind::Text
        | Kind::Color
        | Kind::Picture
        | Kind::Function => true,
        Kind::Thing(_) | Kind::List(_) | Kind::Tuple(_) => {
            !matches!(e, Expr::Paren(_) | Expr::If(_) | Expr::List(_) | Expr::Tuple(_))
        }
        Kind::Option(_) | Kind::Unknown => false,
    }
}
