//! Documents on disk: which names are documents, reading them, and saving them so that neither a
//! crash nor another program's edit loses anything.
//!
//! In: a folder and a name as a stranger may give it. Out: text with its [`Version`], or a
//! [`DiskError`] that left the disk as it was.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// The longest document, in bytes.
pub(crate) const LONGEST: usize = 8 << 20;

/// The deepest folder below the root that is looked into, and the most entries that are looked at.
const DEEPEST: usize = 8;
const MOST_ENTRIES: usize = 20_000;

/// Folders of built things, where no document is looked for.
const BUILT: [&str; 4] = ["dist", "node_modules", "target", "target-web"];

/// Which text was read: equal exactly when the texts are equal; `absent` for no file at all.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Version(String);

impl Version {
    /// The version of a file that does not exist yet.
    pub(crate) fn absent() -> Version {
        Version(String::from("absent"))
    }

    /// The version of a text: its 128-bit FNV-1a hash in hexadecimal.
    ///
    /// It tells an edit from none; it is no defence against someone who forges collisions, who
    /// could write the file anyway.
    pub(crate) fn of(text: &str) -> Version {
        let mut hash: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
        for byte in text.bytes() {
            hash =
                (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b);
        }
        Version(format!("{hash:032x}"))
    }
}

impl std::fmt::Display for Version {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

/// A document as it stands on disk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Stored {
    pub(crate) text: String,
    pub(crate) version: Version,
}

/// Why a document was not read or not saved; the disk is as it was.
#[derive(Debug, thiserror::Error)]
pub(crate) enum DiskError {
    #[error("not a document's name: {0}")]
    Name(&'static str),
    #[error("no such document")]
    Missing,
    #[error("not a plain file below the folder")]
    NotPlain,
    #[error("longer than {LONGEST} bytes")]
    TooLong,
    #[error("not UTF-8 text")]
    NotText,
    #[error("this machine has no folder for drafts")]
    NoDrafts,
    #[error("changed on disk since it was read")]
    Changed(Option<Stored>),
    #[error("{0}")]
    Io(#[from] io::Error),
}

/// A folder whose documents may be read and saved: an existing folder's real path.
#[derive(Debug, Clone)]
pub(crate) struct Root(PathBuf);

impl Root {
    /// # Errors
    /// Where there is no such folder.
    pub(crate) fn open(folder: &Path) -> io::Result<Root> {
        let real = folder.canonicalize()?;
        if !real.is_dir() {
            return Err(io::Error::new(io::ErrorKind::NotADirectory, "not a folder"));
        }
        Ok(Root(real))
    }

    /// The folder's real path.
    pub(crate) fn folder(&self) -> &Path {
        &self.0
    }
}

/// Refuses every name that is not a plain relative path to a `.thing` file, on any system.
///
/// # Errors
/// [`DiskError::Name`] with what is wrong.
pub(crate) fn check_name(name: &str) -> Result<(), DiskError> {
    if !name.ends_with(".thing") {
        return Err(DiskError::Name("it must end in .thing"));
    }
    check_path(name)
}

/// Refuses every name that is not a plain relative path, on any system.
fn check_path(name: &str) -> Result<(), DiskError> {
    let refuse = |why| Err(DiskError::Name(why));
    if name.len() > 1024 || name.split('/').count() > DEEPEST {
        return refuse("too long or too deep");
    }
    for component in name.split('/') {
        if component.is_empty() || component.len() > 255 {
            return refuse("an empty or too long component");
        }
        if component.starts_with('.') || component.starts_with(' ') {
            return refuse("a component begins with a dot or a space");
        }
        if component.ends_with('.') || component.ends_with(' ') {
            return refuse("a component ends with a dot or a space");
        }
        if component.chars().any(|c| c.is_control() || "\\:*?\"<>|%".contains(c) || is_unseen(c)) {
            return refuse("a character that paths do not have");
        }
        if is_device(component) {
            return refuse("a device's name");
        }
    }
    Ok(())
}

/// Characters that show nothing or turn the text round, and so make one name look like another.
fn is_unseen(c: char) -> bool {
    matches!(c, '\u{ad}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2060}'..='\u{206f}' | '\u{feff}')
}

/// Names that are devices on Windows whatever follows the first dot.
fn is_device(component: &str) -> bool {
    let stem = component.split('.').next().unwrap_or_default().to_ascii_uppercase();
    let numbered =
        |prefix| stem.strip_prefix(prefix).is_some_and(|n| matches!(n.as_bytes(), [b'1'..=b'9']));
    ["CON", "PRN", "AUX", "NUL"].contains(&stem.as_str()) || numbered("COM") || numbered("LPT")
}

/// The names of all documents below the folder, sorted; hidden and built folders are passed over,
/// symbolic links are not followed.
///
/// # Errors
/// Where the folder itself cannot be read.
pub(crate) fn list(root: &Root) -> Result<Vec<String>, DiskError> {
    let mut names = Vec::new();
    let mut left = MOST_ENTRIES;
    let mut open = vec![(root.0.clone(), String::new(), 1)];
    while let Some((folder, prefix, depth)) = open.pop() {
        let entries = match fs::read_dir(&folder) {
            Ok(entries) => entries,
            Err(error) if prefix.is_empty() => return Err(error.into()),
            Err(_) => continue,
        };
        for entry in entries.flatten() {
            if left == 0 {
                break;
            }
            left -= 1;
            let (Ok(kind), Ok(own)) = (entry.file_type(), entry.file_name().into_string()) else {
                continue;
            };
            let name = format!("{prefix}{own}");
            if kind.is_dir() {
                if depth < DEEPEST && !own.starts_with('.') && !BUILT.contains(&own.as_str()) {
                    open.push((entry.path(), format!("{name}/"), depth + 1));
                }
            } else if kind.is_file() && check_name(&name).is_ok() {
                names.push(name);
            }
        }
    }
    names.sort();
    Ok(names)
}

/// The real path of a file that exists or may be made: its folder exists below the root, and
/// whatever stands at its name is a plain file.
fn locate(root: &Root, name: &str) -> Result<PathBuf, DiskError> {
    check_path(name)?;
    let path = root.0.join(name);
    let folder = path.parent().expect("a file's path has a folder");
    let real = folder.canonicalize().map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => DiskError::Missing,
        _ => DiskError::Io(error),
    })?;
    if !real.starts_with(&root.0) {
        return Err(DiskError::NotPlain);
    }
    let path = real.join(path.file_name().expect("a document has a name"));
    match fs::symlink_metadata(&path) {
        Ok(found) if !found.is_file() => Err(DiskError::NotPlain),
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error.into()),
        _ => Ok(path),
    }
}

/// Reads a document.
///
/// # Errors
/// Every case of [`DiskError`] but `Changed`.
pub(crate) fn read(root: &Root, name: &str) -> Result<Stored, DiskError> {
    check_name(name)?;
    read_at(&locate(root, name)?)
}

/// Reads the table of a family.
///
/// # Errors
/// Every case of [`DiskError`] but `Changed`.
pub(crate) fn read_table(root: &Root, name: &str) -> Result<String, DiskError> {
    if !name.ends_with(".csv") {
        return Err(DiskError::Name("a table must end in .csv"));
    }
    Ok(read_at(&locate(root, name)?)?.text)
}

fn read_at(path: &Path) -> Result<Stored, DiskError> {
    let file = File::open(path).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => DiskError::Missing,
        _ => DiskError::Io(error),
    })?;
    let mut bytes = Vec::new();
    file.take(LONGEST as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > LONGEST {
        return Err(DiskError::TooLong);
    }
    let text = String::from_utf8(bytes).map_err(|_| DiskError::NotText)?;
    let version = Version::of(&text);
    Ok(Stored { text, version })
}

/// Saves a document if it still is what `expected` says: the new text is written to a new file
/// beside it, synced, and put in its place in one step, so that a crash leaves the old text or the
/// new one, whole.
///
/// Another program that writes between the last look and the rename (microseconds) is not seen.
///
/// # Errors
/// [`DiskError::Changed`] with what stands there now, where that is not `expected`.
pub(crate) fn save(
    root: &Root,
    name: &str,
    text: &str,
    expected: &Version,
) -> Result<Version, DiskError> {
    if text.len() > LONGEST {
        return Err(DiskError::TooLong);
    }
    check_name(name)?;
    if *expected == Version::absent() {
        make_folders(root, name)?;
    }
    let path = locate(root, name)?;
    expect_version(&path, expected)?;
    let draft = draft_path(&path)?;
    let result = write_draft(&draft, &path, text)
        .and_then(|()| expect_version(&path, expected))
        .and_then(|()| put_in_place(&draft, &path, expected));
    if result.is_err() {
        // The draft is ours alone; the first error is the one to report.
        let _ = fs::remove_file(&draft);
    }
    result.map(|()| Version::of(text))
}

/// Makes the folders of a new document that are not there yet, each only below one that really lies below
/// the root.
fn make_folders(root: &Root, name: &str) -> Result<(), DiskError> {
    let folders = name.rsplit_once('/').map_or("", |(folders, _)| folders);
    let mut folder = root.0.clone();
    for component in folders.split('/').filter(|c| !c.is_empty()) {
        folder.push(component);
        match fs::create_dir(&folder) {
            Err(error) if error.kind() != io::ErrorKind::AlreadyExists => return Err(error.into()),
            _ => {}
        }
        let real = folder.canonicalize()?;
        if !real.starts_with(&root.0) || !real.is_dir() {
            return Err(DiskError::NotPlain);
        }
        folder = real;
    }
    Ok(())
}

fn expect_version(path: &Path, expected: &Version) -> Result<(), DiskError> {
    match read_at(path) {
        Ok(stored) if stored.version == *expected => Ok(()),
        Ok(stored) => Err(DiskError::Changed(Some(stored))),
        Err(DiskError::Missing) if *expected == Version::absent() => Ok(()),
        Err(DiskError::Missing) => Err(DiskError::Changed(None)),
        Err(error) => Err(error),
    }
}

/// A new name beside the document, hidden, and not a document's.
fn draft_path(path: &Path) -> Result<PathBuf, DiskError> {
    let number = getrandom::u64().map_err(io::Error::from)?;
    Ok(path.with_file_name(format!(".thinglab-{number:016x}.tmp")))
}

fn write_draft(draft: &Path, path: &Path, text: &str) -> Result<(), DiskError> {
    let mut file = OpenOptions::new().write(true).create_new(true).open(draft)?;
    if let Ok(found) = fs::metadata(path) {
        file.set_permissions(found.permissions())?;
    }
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    Ok(())
}

fn put_in_place(draft: &Path, path: &Path, expected: &Version) -> Result<(), DiskError> {
    if *expected == Version::absent() {
        // A link, unlike a rename, fails where a file has appeared meanwhile.
        match fs::hard_link(draft, path) {
            Ok(()) => fs::remove_file(draft)?,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                return Err(DiskError::Changed(read_at(path).ok()));
            }
            Err(error) => return Err(error.into()),
        }
    } else {
        fs::rename(draft, path)?;
    }
    sync_folder(path.parent().expect("a file's path has a folder"))
}

/// Makes the new name last through a power cut, where folders can be synced.
fn sync_folder(folder: &Path) -> Result<(), DiskError> {
    if cfg!(unix) {
        File::open(folder)?.sync_all()?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
