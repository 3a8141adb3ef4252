//! The host of the session in the page: texts that were fetched before they are asked for.
//!
//! A session asks at once and a browser fetches later: what is asked for and not there is noted, and
//! whoever opened the document fetches it and opens it again.

use leptos::prelude::*;
use session::Host;
use std::collections::{BTreeMap, BTreeSet};

/// The texts that are known, and the names that were asked for in vain.
#[derive(Clone, Debug, Default)]
pub struct FileSet {
    /// Texts by the name that `use` gives them; nothing where it is known that there is none.
    pub texts: BTreeMap<String, Option<String>>,
    /// The names of the libraries.
    pub libraries: Vec<String>,
    /// Names that nothing is known of.
    pub wanted: BTreeSet<String>,
}

impl FileSet {
    /// Returns a text, or notes that it is wanted.
    pub fn find(&mut self, name: &str) -> Option<String> {
        match self.texts.get(name) {
            Some(known) => known.clone(),
            None => {
                self.wanted.insert(String::from(name));
                None
            }
        }
    }
}

/// The page's host.
#[derive(Clone, Copy, Debug)]
pub struct Files(pub StoredValue<FileSet>);

impl Host for Files {
    fn read(&self, name: &str) -> Option<String> {
        self.0.try_update_value(|files| files.find(name)).flatten()
    }
    fn libraries(&self) -> Vec<String> {
        self.0.try_with_value(|files| files.libraries.clone()).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::FileSet;

    #[test]
    fn what_is_not_there_is_wanted_once() {
        let mut files = FileSet::default();
        files.texts.insert(String::from("geometry"), Some(String::from("class Point {}")));
        files.texts.insert(String::from("nowhere"), None);
        assert_eq!(files.find("geometry").as_deref(), Some("class Point {}"));
        assert_eq!(files.find("nowhere"), None);
        assert!(files.wanted.is_empty());
        assert_eq!(files.find("bolts"), None);
        assert_eq!(files.find("bolts"), None);
        assert_eq!(files.wanted.len(), 1);
    }
}
