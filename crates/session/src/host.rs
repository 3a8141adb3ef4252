//! The host: everything that reaches in from outside, in one trait.

use crate::document::Open;
use crate::view::DocumentId;
use std::collections::BTreeMap;

/// What a session may ask of the program that it lives in. No clock, file or network otherwise.
pub trait Host {
    /// Returns the text of a library or of a file beside the document, named as `use` names it
    /// (`geometry`, `parts.bolts`), or nothing if there is none.
    fn read(&self, name: &str) -> Option<String>;
    /// Returns the names of the libraries that can be used, for whoever misses one.
    fn libraries(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The host as one open document sees it: what another open document is now counts, not what it was
/// when it was saved.
pub(crate) struct Beside<'h> {
    host: &'h dyn Host,
    /// The other open documents, by name.
    texts: BTreeMap<String, String>,
}

impl<'h> Beside<'h> {
    pub(crate) fn of(host: &'h dyn Host, documents: &[Open], id: DocumentId) -> Self {
        // a document that is being opened has no place among them yet
        let user = documents.get(id.0 as usize).map_or("", |open| &open.name);
        let others = (0..).zip(documents).filter(|(i, _)| DocumentId(*i) != id);
        let texts = others
            .filter_map(|(_, open)| Some((used_as(&open.name, user)?, open.state.text.clone())));
        Self { host, texts: texts.collect() }
    }
}

/// Returns what `use` calls a document (`parts/bolts.thing`) in the text of another (`frame.thing`): `parts.bolts`;
/// nothing where it lies outside of that one's folder.
pub(crate) fn used_as(name: &str, user: &str) -> Option<String> {
    let folder = user.rfind('/').map_or("", |end| &user[..=end]);
    let file = name.strip_prefix(folder)?;
    Some(file.strip_suffix(".thing").unwrap_or(file).replace('/', "."))
}

impl Host for Beside<'_> {
    fn read(&self, name: &str) -> Option<String> {
        // only what can be used at all: a document that is nowhere saved is nobody's library
        let saved = self.host.read(name)?;
        Some(self.texts.get(name).cloned().unwrap_or(saved))
    }
    fn libraries(&self) -> Vec<String> {
        self.host.libraries()
    }
}
