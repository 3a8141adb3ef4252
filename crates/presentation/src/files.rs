//! The texts that were fetched before a session asks for them, and what it asked for in vain.

use std::collections::{BTreeMap, BTreeSet};

/// The texts that are known, and the paths that were asked for in vain.
#[derive(Clone, Debug, Default)]
pub struct FileSet {
    /// The libraries, by the name that `use` gives them.
    pub libraries: BTreeMap<String, String>,
    /// Documents by path; nothing where it is known that there is none.
    pub texts: BTreeMap<String, Option<String>>,
    /// The paths that nothing is known of.
    pub wanted: BTreeSet<String>,
}

/// Whether a wanted path is one of a table: `shop/bolts.csv`. Those of documents end otherwise.
pub fn is_table(path: &str) -> bool {
    path.ends_with(".csv")
}

impl FileSet {
    /// Forgets which tables were not there: they are asked for once more.
    pub fn forget_missing_tables(&mut self) {
        self.texts.retain(|path, text| text.is_some() || !is_table(path));
    }

    /// Returns the text of a library, or of a document by its name in a folder; or notes that this is wanted.
    pub fn find(&mut self, folder: &str, name: &str) -> Option<String> {
        if let Some(library) = self.libraries.get(name) {
            return Some(library.clone());
        }
        let path = match session::is_table_name(name) {
            true => format!("{folder}{name}"),
            false => format!("{folder}{}.thing", name.replace('.', "/")),
        };
        match self.texts.get(&path) {
            Some(known) => known.clone(),
            None => {
                self.wanted.insert(path);
                None
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::FileSet;

    #[test]
    fn what_is_not_there_is_wanted_once_by_its_path() {
        let mut files = FileSet::default();
        files.libraries.insert(String::from("geometry"), String::from("class Point {}"));
        files.texts.insert(String::from("nowhere.thing"), None);
        files.texts.insert(String::from("shop/parts/bolts.thing"), Some(String::from("x: Real")));
        assert_eq!(files.find("shop/", "geometry").as_deref(), Some("class Point {}"));
        assert_eq!(files.find("", "nowhere"), None);
        assert_eq!(files.find("shop/", "parts.bolts").as_deref(), Some("x: Real"));
        assert!(files.wanted.is_empty());
        assert_eq!(files.find("", "parts.bolts"), None, "another folder has others");
        assert_eq!(files.find("", "parts.bolts"), None);
        assert_eq!(files.wanted.iter().collect::<Vec<_>>(), ["parts/bolts.thing"]);
        assert_eq!(files.find("shop/", "bolts.csv"), None, "a table is called as its file is");
        assert!(files.wanted.contains("shop/bolts.csv"));
        // a table that was not there may come
        files.wanted.clear();
        files.texts.insert(String::from("shop/bolts.csv"), None);
        assert_eq!(files.find("shop/", "bolts.csv"), None);
        assert!(files.wanted.is_empty());
        files.forget_missing_tables();
        assert_eq!(files.find("shop/", "bolts.csv"), None);
        assert!(files.wanted.contains("shop/bolts.csv"));
        assert!(files.texts.contains_key("nowhere.thing"));
    }
}
