//! Fixes that need to know what there is outside of a text: the libraries that have what is missing.

use crate::host::Host;
use base::{Diagnostic, FileId, Place, Span};
use std::cell::OnceCell;
use std::collections::BTreeSet;
use syntax::ast::{AstNode, Member};
use syntax::edit::{Spot, insert_member};

/// Adds to every diagnostic of an unknown class the `use` that would bring it.
pub(crate) fn add_uses(text: &str, diagnostics: &mut [Diagnostic], host: &dyn Host) {
    if !diagnostics.is_empty() {
        add_missing_uses(text, diagnostics, host);
    }
}

#[cold]
#[inline(never)]
fn add_missing_uses(text: &str, diagnostics: &mut [Diagnostic], host: &dyn Host) {
    let own = FileId(0);
    let missing = |d: &&mut Diagnostic| d.code == "missing-file" && d.place.file == own;
    for diagnostic in diagnostics.iter_mut().filter(missing) {
        let word = text.get(diagnostic.place.span.range()).unwrap_or_default();
        let libraries = host.libraries();
        let near = base::diagnostic::nearest(word, libraries.iter().map(String::as_str));
        *diagnostic = match near {
            Some(near) => diagnostic.clone().meant(near),
            None if libraries.is_empty() => continue,
            None if diagnostic.hint.is_some() => diagnostic.clone(),
            None => diagnostic.clone().hint(format!("the libraries are {}", libraries.join(", "))),
        };
    }
    let unknown = |d: &&mut Diagnostic| {
        matches!(d.code, "unknown-class" | "unknown-name") && d.place.file == own
    };
    let mut libraries: Option<Vec<Library>> = None;
    for diagnostic in diagnostics.iter_mut().filter(unknown) {
        let word = text.get(diagnostic.place.span.range()).unwrap_or_default();
        let is_visible = diagnostic.hint.as_ref().is_some_and(|h| h.starts_with("it is a class"));
        if !word.starts_with(char::is_uppercase) || is_visible {
            continue;
        }
        let libraries = libraries.get_or_insert_with(|| {
            let names = host.libraries().into_iter();
            names.filter_map(|name| Some(Library::of(host.read(&name)?, name))).collect()
        });
        // what was used already would have been found
        let declaring: Vec<&Library> = libraries.iter().filter(|l| l.declares(word)).collect();
        if !declaring.is_empty() {
            // a word that is written almost so, `rectangle`, is not what is meant
            diagnostic.fixes = Box::default();
        }
        for library in declaring {
            let name = &library.name;
            let title = format!("use {name}");
            let (at, insert) = library.line.get_or_init(|| line_at_head(text, &title)).clone();
            let place = Place { file: own, span: at };
            *diagnostic = diagnostic.clone().hint(format!("{name} has it: `use {name}`"));
            *diagnostic = diagnostic.clone().fix(title, [(place, insert)]);
        }
    }
}

/// A library that may have what is missing.
struct Library {
    name: String,
    text: String,
    /// The names of the classes that it declares; read when its text has the word that is looked for.
    classes: OnceCell<BTreeSet<String>>,
    /// The line that brings it, and where that goes; found when first asked for.
    line: OnceCell<(Span, String)>,
}

impl Library {
    fn of(text: String, name: String) -> Self {
        Self { name, text, classes: OnceCell::new(), line: OnceCell::new() }
    }

    /// Whether it declares a class of a name.
    fn declares(&self, word: &str) -> bool {
        let class = |member| match member {
            Member::Class(class) => class.name().map(|word| word.text().to_string()),
            _ => None,
        };
        let read = || {
            let file = syntax::parse(FileId(0), &self.text).file();
            file.members().filter_map(class).collect()
        };
        self.text.contains(word) && self.classes.get_or_init(read).contains(word)
    }
}

/// Returns where a line goes that stands behind what is used, and before all else.
pub(crate) fn line_at_head(text: &str, line: &str) -> (Span, String) {
    let file = syntax::parse(FileId(0), text).file();
    let members: Vec<Member> = file.members().collect();
    let last = members.iter().rfind(|m| matches!(m, Member::Use(_)));
    let spot = match (last, members.first()) {
        (Some(last), _) => Spot::After(last.syntax().clone()),
        (None, Some(first)) => Spot::Before(first.syntax().clone()),
        (None, None) => Spot::EndOf(file.syntax().clone()),
    };
    let edit = insert_member(&spot, line);
    (edit.span, edit.insert)
}
