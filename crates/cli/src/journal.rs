//! The journal: unsaved texts of the page, kept on disk from edit to edit, so that what the server has answered for
//! outlives a browser that is killed.
//!
//! In: a document's name, the name of a tab, and what that tab has not saved. Out: what the tabs of a document left
//! behind. Each is a file of its own in a folder of the user's, outside the served one, that nobody else may read; it is
//! put in its place in one step, and gone once the tab has nothing unsaved.

use crate::disk::{self, DiskError, Root, Version};
use std::fs::{self, DirBuilder, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// The most drafts of one document that are read: the newest.
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
    fn at(folder: &Path) -> Self {
        Self(Some(folder.to_path_buf()))
    }

    /// Keeps what a tab has not saved of a document, or nothing any more.
    ///
    /// # Errors
    /// The names are none, the user has no folder for drafts, the draft is too long, or it cannot be written; then what
    /// was kept before still is.
    pub(crate) fn keep(&self, name: &str, tab: &str, draft: Option<&str>) -> Result<(), DiskError> {
        let Some(place) = self.place(name, tab)? else { return Err(DiskError::NoDrafts) };
        let Some(draft) = draft else {
            return match fs::remove_file(place) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error.into()),
                _ => Ok(()),
            };
        };
        if draft.len() > disk::LONGEST {
            return Err(DiskError::TooLong);
        }
        make_folder(place.parent().expect("a draft lies in a folder"))?;
        let written = place.with_extension("new");
        let result = write(&written, draft).and_then(|()| fs::rename(&written, &place));
        if result.is_err() {
            // what is half written is ours alone; the first error is the one to report
            let _ = fs::remove_file(&written);
        }
        Ok(result?)
    }

    /// Returns what tabs have not saved of a document: of many tabs, what the last ones kept.
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
        let is_draft = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "draft");
        let places = entries.flatten().map(|entry| entry.path()).filter(is_draft);
        let mut places: Vec<(SystemTime, PathBuf)> =
            places.map(|path| (kept_at(&path), path)).collect();
        places.sort_by(|a, b| b.cmp(a));
        let mut found = Vec::new();
        for (_, path) in places.into_iter().take(MOST) {
            let tab = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
            if let (Some(tab), Ok(draft)) = (tab, fs::read_to_string(&path)) {
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

/// Makes a folder that its user alone may look into, with those around it that are not there yet.
fn make_folder(folder: &Path) -> io::Result<()> {
    let mut builder = DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)?;
    // it may be there, and open to others
    #[cfg(unix)]
    fs::set_permissions(folder, std::os::unix::fs::PermissionsExt::from_mode(0o700))?;
    Ok(())
}

/// Writes a file that its user alone may read, down to the disk.
fn write(path: &Path, text: &str) -> io::Result<()> {
    let mut options = OpenOptions::new();
    options.write(true).create(true).truncate(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    let mut file = options.open(path)?;
    // it may be left over from before, and open to others
    #[cfg(unix)]
    file.set_permissions(std::os::unix::fs::PermissionsExt::from_mode(0o600))?;
    file.write_all(text.as_bytes())?;
    file.sync_all()
}

/// When a draft was kept; long ago where that is not known.
fn kept_at(path: &Path) -> SystemTime {
    let modified = fs::metadata(path).and_then(|found| found.modified());
    modified.unwrap_or(SystemTime::UNIX_EPOCH)
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
    use super::{Draft, Journal, MOST};
    use crate::disk::DiskError;
    use std::fs;
    use std::path::PathBuf;
    use std::time::{Duration, SystemTime};

    /// A folder of one test.
    struct Folder(PathBuf);

    impl Folder {
        fn new(of: &str) -> Self {
            let name = format!("thinglab-journal-{of}-{}", std::process::id());
            Self(std::env::temp_dir().join(name))
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            let _ = fs::remove_dir_all(&self.0);
        }
    }

    #[test]
    fn what_a_tab_has_not_saved_is_found_until_it_is_saved() {
        let folder = Folder::new("kept");
        let journal = Journal::at(&folder.0);
        assert_eq!(journal.drafts("a/b.thing").expect("none yet"), []);
        journal.keep("a/b.thing", "7e-1", Some("absent 1\nx: Real\n")).expect("kept");
        journal.keep("a/b.thing", "7e-2", Some("absent 2\n")).expect("kept");
        journal.keep("a/b.thing", "7e-1", Some("absent 3\ny: Real\n")).expect("kept");
        journal.keep("b.thing", "7e-1", Some("another")).expect("kept");
        let again = Journal::at(&folder.0);
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
    }

    #[cfg(unix)]
    #[test]
    fn what_is_unsaved_is_read_by_nobody_else() {
        use std::os::unix::fs::PermissionsExt;
        let folder = Folder::new("shut");
        let journal = Journal::at(&folder.0.join("drafts"));
        journal.keep("a.thing", "7e-1", Some("absent 1\n")).expect("kept");
        let place = journal.place("a.thing", "7e-1").expect("a name").expect("a folder");
        let own = place.parent().expect("a draft lies in a folder");
        // what an earlier version left open is shut
        fs::set_permissions(own, fs::Permissions::from_mode(0o755)).expect("it is ours");
        let left = place.with_extension("new");
        fs::write(&left, "half").expect("it is ours");
        fs::set_permissions(&left, fs::Permissions::from_mode(0o644)).expect("it is ours");
        journal.keep("a.thing", "7e-1", Some("absent 2\n")).expect("kept");
        let mode = |path: &std::path::Path| {
            fs::metadata(path).expect("it is there").permissions().mode() & 0o777
        };
        assert_eq!(mode(&place), 0o600);
        for made in [own, &folder.0.join("drafts"), &folder.0] {
            assert_eq!(mode(made), 0o700, "{}", made.display());
        }
        assert!(!left.exists());
    }

    #[test]
    fn the_newest_draft_is_found_among_many_older_and_half_written_ones() {
        let folder = Folder::new("many");
        let journal = Journal::at(&folder.0);
        let kept = |tab: &str, age: u64| {
            journal.keep("a.thing", tab, Some(tab)).expect("kept");
            let place = journal.place("a.thing", tab).expect("a name").expect("a folder");
            fs::write(place.with_file_name(format!("half-{tab}.new")), "").expect("written");
            let file = fs::OpenOptions::new().write(true).open(place).expect("it is there");
            let then = SystemTime::UNIX_EPOCH + Duration::from_secs(1_000_000 - age);
            file.set_modified(then).expect("it is ours");
        };
        for i in 0..MOST as u64 + 2 {
            // the newest is neither the first nor the last by name
            kept(&format!("tab-{i:03}"), i.abs_diff(40));
        }
        let found = journal.drafts("a.thing").expect("read");
        assert_eq!(found.len(), MOST);
        let has = |tab: &str| found.iter().any(|draft| draft.tab == tab);
        assert!(has("tab-040") && has("tab-065"));
        // the two oldest are left out
        assert!(!has("tab-000") && !has("tab-001") && has("tab-002"));
    }

    #[test]
    fn a_machine_without_a_folder_for_drafts_says_so() {
        let refused = Journal(None).keep("a.thing", "7e-1", Some("text")).expect_err("nowhere");
        assert_eq!(refused.to_string(), "this machine has no folder for drafts");
        assert_eq!(Journal(None).drafts("a.thing").expect("none"), []);
    }
}
