//! The files that the command carries in itself, as `build.rs` found them: the library, the gallery
//! and the built page; and a page that lies in a folder instead.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// How the names of compressed files end.
const COMPRESSED: &str = "br";

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
                if !is_plain || is_stale(&folder.join(name)) {
                    return None;
                }
                fs::read(folder.join(name)).ok().map(Cow::Owned)
            }
        }
    }
}

/// Returns true for a compressed file whose own file is gone, or was written after it.
fn is_stale(file: &Path) -> bool {
    if file.extension().is_none_or(|extension| extension != COMPRESSED) {
        return false;
    }
    let written = |file: &Path| fs::metadata(file).and_then(|known| known.modified()).ok();
    match (written(&file.with_extension("")), written(file)) {
        (Some(own), Some(compressed)) => own > compressed,
        _ => true,
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, SystemTime};

    #[test]
    fn a_compressed_file_hides_no_edited_one_and_is_not_served_alone() {
        let folder = std::env::temp_dir().join(format!("thinglab-page-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("the folder is made");
        let write = |name: &str, age: u64| {
            let file = fs::File::create(folder.join(name)).expect("the file is made");
            let time = SystemTime::now() - Duration::from_secs(age);
            file.set_modified(time).expect("the time is set");
        };
        let page = Page::Folder(folder.clone());
        write("a.js.br", 10);
        assert_eq!(page.file("/a.js.br"), None);
        write("a.js", 20);
        assert!(page.file("/a.js.br").is_some());
        write("a.js", 5);
        assert_eq!(page.file("/a.js.br"), None);
        assert!(page.file("/a.js").is_some());
        fs::remove_dir_all(&folder).expect("the folder is removed");
    }
}
