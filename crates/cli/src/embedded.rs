//! The files that the command carries in itself, as `build.rs` found them: the library, the gallery
//! and the built page; and a page that lies in a folder instead.

use std::borrow::Cow;
use std::fs;
use std::path::PathBuf;

include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// Where the page's files are.
#[derive(Debug)]
pub(crate) enum Page {
    /// In the command itself.
    Carried,
    /// In a folder, read at each request: for whoever works on the page.
    Folder(PathBuf),
}

impl Page {
    /// The file at an address of the server; `/` is the index.
    pub(crate) fn file(&self, address: &str) -> Option<Cow<'static, [u8]>> {
        let address = if address == "/" { "/index.html" } else { address };
        match self {
            Page::Carried => {
                let index = PAGE.binary_search_by_key(&address, |(name, _)| name).ok()?;
                Some(Cow::Borrowed(PAGE[index].1))
            }
            Page::Folder(folder) => {
                // the page's files lie directly in it
                let name = address.strip_prefix('/')?;
                let is_plain =
                    !name.is_empty() && !name.starts_with('.') && !name.contains(['/', '\\', ':']);
                is_plain.then(|| fs::read(folder.join(name)).ok()).flatten().map(Cow::Owned)
            }
        }
    }
}

/// The names of the libraries, as `use` names them.
pub(crate) fn libraries() -> Vec<String> {
    let names = LIBRARY.iter().filter_map(|(name, _)| name.strip_suffix(".thing"));
    names.map(str::to_string).collect()
}

/// The text of a library, named as `use` names it.
pub(crate) fn library(name: &str) -> Option<&'static str> {
    let file = format!("{name}.thing");
    LIBRARY.iter().find(|(n, _)| *n == file).map(|(_, text)| *text)
}
