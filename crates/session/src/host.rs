//! The host: everything that reaches in from outside, in one trait.

use crate::document::Open;
use crate::view::DocumentId;
use std::collections::BTreeMap;

/// What a session may ask of the program that it lives in. No clock, file or network otherwise.
pub trait Host {
    /// Returns the text of a library or of a file beside the document, named as `use` names it
    /// (`geometry`, `parts.bolts`), or of a table beside it by its path (`parts/bolts.csv`); nothing if there is none.
    fn read(&self, name: &str) -> Option<String>;
    /// The same for a document in a folder (`shop/`, or nothing); a host whose documents lie in one folder need not
    /// tell.
    fn read_beside(&self, folder: &str, name: &str) -> Option<String> {
        let _ = folder;
        self.read(name)
    }
    /// Returns the names of the libraries that can be used, for whoever misses one.
    fn libraries(&self) -> Vec<String> {
        Vec::new()
    }
}

/// The host as one open document sees it: what another open document is now counts, not what it was
/// when it was saved.
pub(crate) struct Beside<'h> {
    host: &'h dyn Host,
    folder: String,
    /// The other open documents, as `use` names them.
    texts: BTreeMap<String, String>,
}

impl<'h> Beside<'h> {
    pub(crate) fn of(host: &'h dyn Host, documents: &[Open], id: DocumentId) -> Self {
        let user = &documents[id.0 as usize].name;
        let others = (0..).zip(documents).filter(|(i, _)| DocumentId(*i) != id);
        Self::among(host, others.map(|(_, open)| open), user)
    }
    /// The same for a document that is being opened.
    pub(crate) fn opening(host: &'h dyn Host, documents: &[Open], name: &str) -> Self {
        Self::among(host, documents.iter(), name)
    }
    fn among<'d>(host: &'h dyn Host, others: impl Iterator<Item = &'d Open>, user: &str) -> Self {
        let text = |open: &Open| Some((used_as(&open.name, user)?, open.state.text.clone()));
        Self { host, folder: folder_of(user).into(), texts: others.filter_map(text).collect() }
    }
}

/// The folder that a document lies in: `shop/` of `shop/frame.thing`.
fn folder_of(name: &str) -> &str {
    name.rfind('/').map_or("", |end| &name[..=end])
}

/// Returns what `use` calls a document (`parts/bolts.thing`) in the text of another (`frame.thing`): `parts.bolts`;
/// nothing where it lies outside of that one's folder.
pub fn used_as(name: &str, user: &str) -> Option<String> {
    let file = name.strip_prefix(folder_of(user))?;
    Some(file.strip_suffix(".thing").unwrap_or(file).replace('/', "."))
}

impl Host for Beside<'_> {
    fn read(&self, name: &str) -> Option<String> {
        // only what can be used at all: a document that is nowhere saved is nobody's library
        let saved = self.host.read_beside(&self.folder, name)?;
        Some(self.texts.get(name).cloned().unwrap_or(saved))
    }
    fn libraries(&self) -> Vec<String> {
        self.host.libraries()
    }
}
