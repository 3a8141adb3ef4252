//! The journal: unsaved texts of the page, kept on disk from edit to edit, so that what the server has answered for
//! outlives a browser that is killed.
//!
//! In: a document's name, the name of a tab, and what that tab has not saved. Out: what the tabs of a document left
//! behind. Each is a file of its own in a folder of the user's, outside the served one; it is put in its place in one
//! step, and gone once the tab has nothing unsaved.

use crate::disk::{self, DiskError, Root, Version};
use std::fs;
use std::io;
use std::path::PathBuf;

/// The most drafts of one document that are looked at.
const MOST: usize = 64;

/// Where drafts are kept.
#[derive(Debug)]
pub(crate) struct Journal(Option<PathBuf>);

/// What a tab has not saved.
#[derive(Debug, PartialEq, Eq, serde::Serialize)]
pub(crate) struct Draft {
    /// The tab.
    pub(crate) tab: String,
    /// The draft as the page wrote it.
    pub(crate) draft: String,
}

impl Journal {
    /// The journal of a served folder; one that keeps nothing where the user has no folder for such things.
    pub(crate) fn of(root: &Root) -> Self {
        let state = state_folder().map(|folder| folder.join("thinglab/drafts"));
        Self(state.map(|folder| folder.join(hash(&root.folder().to_string_lossy()))))
    }

    /// A journal in a folder.
    #[cfg(test)]
    fn at(folder: &std::path::Path) -> Self {
        Self(Some(folder.to_path_buf()))
    }

    /// Keeps what a tab has not saved of a document, or nothing any more.
    ///
    /// # Errors
    /// The names are none, the draft is too long, or it cannot be written; then what was kept before still is.
    pub(crate) fn keep(&self, name: &str, tab: &str, draft: Option<&str>) -> Result<(), DiskError> {
        let Some(place) = self.place(name, tab)? else { return Err(DiskError::Missing) };
        let Some(draft) = draft else {
            return match fs::remove_file(place) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error.into()),
                _ => Ok(()),
            };
        };
        if draft.len() > disk::LONGEST {
            return Err(DiskError::TooLong);
        }
        let folder = place.parent().expect("a draft lies in a folder");
        fs::create_dir_all(folder)?;
        let written = place.with_extension("new");
        fs::write(&written, draft)?;
        Ok(fs::rename(written, &place)?)
    }

    /// Returns what tabs have not saved of a document.
    ///
    /// # Errors
    /// The name is none, or what is kept cannot be read.
    pub(crate) fn drafts(&self, name: &str) -> Result<Vec<Draft>, DiskError> {
        let Some(place) = self.place(name, "any")? else { return Ok(Vec::new()) };
        let entries = match fs::read_dir(place.parent().expect("a draft lies in a folder")) {
            Ok(entries) => entries,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
            Err(error) => return Err(error.into()),
        };
        let mut found = Vec::new();
        for path in entries.flatten().map(|entry| entry.path()).take(MOST) {
            let tab = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
            let is_draft = path.extension().is_some_and(|ending| ending == "draft");
            if let (true, Some(tab), Ok(draft)) = (is_draft, tab, fs::read_to_string(&path)) {
                found.push(Draft { tab, draft });
            }
        }
        found.sort_by(|a, b| a.tab.cmp(&b.tab));
        Ok(found)
    }

    /// Where a tab's draft of a document lies.
    fn place(&self, name: &str, tab: &str) -> Result<Option<PathBuf>, DiskError> {
        disk::check_name(name)?;
        let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-';
        if tab.is_empty() || tab.len() > 64 || !tab.chars().all(is_plain) {
            return Err(DiskError::Name("a tab is called by letters, digits and hyphens"));
        }
        let folder = self.0.as_ref().map(|folder| folder.join(hash(name)));
        Ok(folder.map(|folder| folder.join(format!("{tab}.draft"))))
    }
}

/// A name as a folder's.
fn hash(name: &str) -> String {
    Version::of(name).to_string()
}

/// Where programs of this user keep what they have to find again. **Source:** XDG Base Directory Specification 0.8.
fn state_folder() -> Option<PathBuf> {
    let named = |name: &str| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let whole = |folder: &PathBuf| folder.is_absolute();
    let own = named("XDG_STATE_HOME").filter(whole).or_else(|| named("LOCALAPPDATA").filter(whole));
    own.or_else(|| Some(named("HOME").filter(whole)?.join(".local/state")))
}

#[cfg(test)]
mod tests {
    use super::{Draft, Journal};
    use crate::disk::DiskError;

    #[test]
    fn what_a_tab_has_not_saved_is_found_until_it_is_saved() {
        let folder = std::env::temp_dir().join(format!("thinglab-journal-{}", std::process::id()));
        let journal = Journal::at(&folder);
        assert_eq!(journal.drafts("a/b.thing").expect("none yet"), []);
        journal.keep("a/b.thing", "7e-1", Some("absent 1\nx: Real\n")).expect("kept");
        journal.keep("a/b.thing", "7e-2", Some("absent 2\n")).expect("kept");
        journal.keep("a/b.thing", "7e-1", Some("absent 3\ny: Real\n")).expect("kept");
        journal.keep("b.thing", "7e-1", Some("another")).expect("kept");
        let again = Journal::at(&folder);
        let draft = |tab: &str, draft: &str| Draft { tab: tab.into(), draft: draft.into() };
        let both = [draft("7e-1", "absent 3\ny: Real\n"), draft("7e-2", "absent 2\n")];
        assert_eq!(again.drafts("a/b.thing").expect("read"), both);
        again.keep("a/b.thing", "7e-1", None).expect("gone");
        again.keep("a/b.thing", "7e-1", None).expect("gone already");
        assert_eq!(again.drafts("a/b.thing").expect("read"), both[1..]);
        for (name, tab) in
            [("../x.thing", "1"), ("x.thing", "../1"), ("x.thing", ""), ("x.txt", "1")]
        {
            let refused = journal.keep(name, tab, Some("text"));
            assert!(matches!(refused, Err(DiskError::Name(_))), "{name} {tab}");
        }
        std::fs::remove_dir_all(&folder).expect("it was made");
    }
}
