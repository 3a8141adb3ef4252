//! Expressions alone: read as if each stood in a class as the answer of a message, without lowering the text anew.
//!
//! In: what a text meant, a class, expressions. Out: their terms, over a document that has whatever classes these
//! made besides. A hand that hovers asks so many times a second.

use crate::files::{Use, UsedParts};
use crate::kinds::Kind;
use crate::lower::{ByName, Lowered, Lowerer, OWN};
use crate::programs::Programs;
use crate::scope::Scope;
use crate::visible::Visible;
use base::{Diagnostic, FileId, Name, Severity};
use kernel::{ClassId, Document, Path, Term};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// What the names of a text mean, once it is lowered.
#[derive(Clone, Debug)]
pub(crate) struct Names {
    pub(crate) visible: Visible,
    pub(crate) object: ClassId,
    pub(crate) messages: ByName<usize>,
    pub(crate) message_kinds: BTreeMap<(ClassId, Name), Option<Kind>>,
    pub(crate) primary_names: BTreeSet<Name>,
    pub(crate) constants: BTreeSet<(ClassId, Name)>,
    pub(crate) broken: BTreeSet<(ClassId, Name)>,
    pub(crate) file_things: BTreeMap<FileId, Path>,
    pub(crate) used_parts: UsedParts,
    pub(crate) spoken: BTreeSet<(FileId, Use)>,
    pub(crate) choices: Vec<ClassId>,
    pub(crate) made: BTreeMap<(&'static str, ClassId), ClassId>,
    pub(crate) counted: BTreeMap<(ClassId, u32), ClassId>,
    /// The programs, and the turns of their blocks.
    pub(crate) drawing: BTreeMap<ClassId, usize>,
}

/// Expressions that were read alone.
#[derive(Debug)]
pub struct Alone {
    /// The document of the text with the classes that the expressions made besides; nothing where they made none.
    pub document: Option<Document>,
    /// What each says; or what is wrong with it, with places in the expression's own text.
    pub terms: Vec<Result<Term, Vec<Diagnostic>>>,
}

/// Reads expressions as if each were the answer of a message of a class that the document's own text declares, or of
/// the document. Cost: for the first ones a copy of the document and of its names; the text is not looked at.
pub fn read_alone(lowered: &Lowered, class: ClassId, texts: &[String]) -> Alone {
    let mut l = lowered.reader.0.take().unwrap_or_else(|| Box::new(knowing(lowered)));
    let terms = texts.iter().map(|text| l.read_alone(class, text)).collect();
    if l.document.classes.len() > lowered.document.classes.len() {
        return Alone { document: Some(l.document), terms };
    }
    lowered.reader.0.replace(Some(l));
    Alone { document: None, terms }
}

/// What reads expressions over the names that a text meant, once it is asked to; kept while they make no class.
#[derive(Default)]
pub(crate) struct Reader(RefCell<Option<Box<Lowerer<'static>>>>);

impl Clone for Reader {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for Reader {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Reader")
    }
}

/// Returns what reads expressions over the names that a text meant.
pub(crate) fn knowing(lowered: &Lowered) -> Lowerer<'static> {
    let mut l = Lowerer::empty(None);
    let names = Names::clone(&lowered.names);
    l.document = lowered.document.clone();
    l.parts = lowered.parts.clone();
    l.files = lowered.files.clone();
    l.visible = names.visible;
    l.object = names.object;
    l.messages = names.messages;
    l.message_kinds = names.message_kinds;
    l.primary_names = names.primary_names;
    l.constants = names.constants;
    l.broken = names.broken;
    l.file_things = names.file_things;
    l.used_parts = names.used_parts;
    l.choices = names.choices;
    l.made = names.made;
    l.counted = names.counted;
    l.programs = Programs::known(names.drawing);
    l
}

impl Lowerer<'_> {
    fn read_alone(&mut self, class: ClassId, text: &str) -> Result<Term, Vec<Diagnostic>> {
        let parse = syntax::parse_expression(OWN, text);
        let is_error = |d: &&Diagnostic| d.severity == Severity::Error;
        let wrong: Vec<_> = parse.diagnostics().iter().filter(is_error).cloned().collect();
        let answer = parse.file().expression().filter(|_| wrong.is_empty()).ok_or(wrong)?;
        let term = self.expr(&Scope::of(OWN, class), &answer);
        self.said.clear();
        let wrong = std::mem::take(&mut self.diagnostics);
        term.map(|(term, _)| term).ok_or(wrong)
    }
}
