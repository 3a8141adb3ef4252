//! Opening documents from the command line: files and folders in, open sessions out.

use crate::disk;
use crate::embedded;
use session::{DocumentId, Host, Session};
use std::fs;
use std::path::{Path, PathBuf};

/// Why a file could not be opened.
#[derive(Debug, thiserror::Error)]
pub(crate) enum OpenError {
    #[error("{path}: {}", reason(.source))]
    Unreadable { path: PathBuf, source: std::io::Error },
    #[error("{0}: no document (NAME.thing) here")]
    NoDocuments(PathBuf),
    #[error("{0}")]
    Refused(String),
    #[error("{path}: {source}")]
    Unsaved { path: PathBuf, source: disk::DiskError },
}

/// Reads what a document uses: the libraries that the command carries, and files beside the document.
struct FilesBeside {
    folder: PathBuf,
}

impl Host for FilesBeside {
    fn read(&self, name: &str) -> Option<String> {
        let plain = |part: &str| {
            !part.is_empty() && part.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-')
        };
        if session::is_table_name(name) {
            return read_bytes(&self.folder.join(name))
                .map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
        }
        if !name.split('.').all(plain) {
            return None;
        }
        if let Some(text) = embedded::library(name) {
            return Some(text.to_string());
        }
        let file = self.folder.join(name.replace('.', "/")).with_extension("thing");
        read_file(&file)
    }
    fn libraries(&self) -> Vec<String> {
        embedded::libraries()
    }
}

/// Reads a file beside a document; nothing where there is none, or something else by its name.
fn read_file(path: &Path) -> Option<String> {
    read_bytes(path).and_then(|bytes| String::from_utf8(bytes).ok())
}

/// Reads a table beside a document; of one that is no text in UTF-8 the table says so.
fn read_bytes(path: &Path) -> Option<Vec<u8>> {
    let is_file = fs::metadata(path).is_ok_and(|known| known.is_file());
    is_file.then(|| fs::read(path).ok()).flatten()
}

/// Says why a file cannot be read or written.
pub(crate) fn reason(source: &std::io::Error) -> String {
    match source.kind() {
        std::io::ErrorKind::InvalidData => "it is no text in UTF-8: save it as such".into(),
        _ => source.to_string(),
    }
}

/// An opened document.
pub(crate) struct Opened {
    pub(crate) session: Session,
    pub(crate) id: DocumentId,
    pub(crate) path: PathBuf,
    pub(crate) text: String,
}

impl Opened {
    /// Returns everything that the document's meaning follows from: its text, and those that it uses.
    pub(crate) fn meaning(&self) -> String {
        self.session.sources(self.id).join("\n")
    }
    /// Sets a value: `PATH=VALUE`.
    ///
    /// # Errors
    /// If it is written otherwise, or the document refuses it.
    fn set(&mut self, setting: &str) -> Result<(), OpenError> {
        let refused = |why: &str| OpenError::Refused(format!("--set {setting}: {why}"));
        let (path, value) = setting
            .split_once('=')
            .ok_or_else(|| refused("write PATH=VALUE, such as `r1.resistance=2 kohm`"))?;
        let (path, value) = (path.trim(), value.trim());
        // a text may be quoted, as it is in a document
        let quoted = value.strip_prefix('"').and_then(|value| value.strip_suffix('"'));
        let value = quoted.unwrap_or(value);
        // more than a whole turn: degrees are meant, and radians would be read
        if value.parse::<f64>().is_ok_and(|x| x.abs() > std::f64::consts::TAU) {
            let rows = self.session.values(self.id);
            let is_it = |row: &session::view::ValueRow| row.path == path || row.shortest == path;
            if rows.iter().find(|row| is_it(row)).is_some_and(|row| row.class == "Angle") {
                let message =
                    format!("{path} is an angle: say `{value} deg`, or `{value} rad` for radians");
                return Err(refused(&message));
            }
        }
        let change = self.session.set_typed(self.id, path, value);
        change.map(drop).map_err(|refusal| refused(&refusal.message))
    }
}

/// A document, and what is set in it before it is looked at. The file stays as it is.
#[derive(Debug, clap::Args)]
pub(crate) struct Source {
    /// The document; `-` is standard input.
    pub(crate) file: PathBuf,
    /// Sets a value first, such as `r1.resistance=2 kohm`, as typing it in the lab does; may stand several times.
    #[arg(long, value_name = "PATH=VALUE")]
    set: Vec<String>,
}

impl Source {
    /// Opens it.
    ///
    /// # Errors
    /// If it cannot be read as text, or a value cannot be set.
    pub(crate) fn open(&self) -> Result<Opened, OpenError> {
        let mut opened = open(&self.file)?;
        for setting in &self.set {
            opened.set(setting)?;
        }
        Ok(opened)
    }
    /// Opens it to be looked at, in as little room as it takes.
    ///
    /// # Errors
    /// As [`Source::open`].
    pub(crate) fn open_sparingly(&self) -> Result<Opened, OpenError> {
        // what an edit needs is there only where all is
        if self.set.is_empty() { open_by(&self.file, Session::open_sparingly) } else { self.open() }
    }
}

/// Opens one file.
///
/// # Errors
/// If it cannot be read as text.
pub(crate) fn open(path: &Path) -> Result<Opened, OpenError> {
    open_by(path, Session::open)
}

/// Returns true for `-`, which stands for what comes in by standard input.
pub(crate) fn is_standard_input(path: &Path) -> bool {
    path == Path::new("-")
}

/// Reads the text of a document.
///
/// # Errors
/// If it cannot be read as text.
pub(crate) fn read(path: &Path) -> Result<String, OpenError> {
    let text = match is_standard_input(path) {
        true => std::io::read_to_string(std::io::stdin()),
        false => fs::read_to_string(path),
    };
    text.map_err(|source| OpenError::Unreadable { path: path.to_path_buf(), source })
}

fn open_by(
    path: &Path,
    open: impl FnOnce(&mut Session, &str, &str) -> DocumentId,
) -> Result<Opened, OpenError> {
    let text = read(path)?;
    let folder = path.parent().unwrap_or(Path::new(".")).to_path_buf();
    let mut session = Session::new(Box::new(FilesBeside { folder }));
    let name = path.file_stem().map_or_else(String::new, |s| s.to_string_lossy().into_owned());
    let id = open(&mut session, &name, &text);
    Ok(Opened { session, id, path: path.to_path_buf(), text })
}

/// Lists the documents that the arguments name: files as they are, folders with all below them.
///
/// # Errors
/// If a folder cannot be read or holds no document.
pub(crate) fn find(arguments: &[PathBuf]) -> Result<Vec<PathBuf>, OpenError> {
    let mut found = Vec::new();
    for argument in arguments {
        if !argument.is_dir() {
            found.push(argument.clone());
            continue;
        }
        let before = found.len();
        collect(argument, &mut found)?;
        if found.len() == before {
            return Err(OpenError::NoDocuments(argument.clone()));
        }
        found[before..].sort();
    }
    Ok(found)
}

fn collect(folder: &Path, found: &mut Vec<PathBuf>) -> Result<(), OpenError> {
    let unreadable = |source| OpenError::Unreadable { path: folder.to_path_buf(), source };
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.is_dir() && !path.is_symlink() {
            collect(&path, found)?;
        } else if path.extension().is_some_and(|e| e == "thing") {
            found.push(path);
        }
    }
    Ok(())
}

/// Writes another text in the place of the one that was read.
///
/// # Errors
/// If it cannot be written, or is no longer what was read; then it is as it was.
pub(crate) fn replace(path: &Path, read: &str, text: &str) -> Result<(), OpenError> {
    let unreadable = |source| OpenError::Unreadable { path: path.to_path_buf(), source };
    let unsaved = |source| OpenError::Unsaved { path: path.to_path_buf(), source };
    let whole = path.canonicalize().map_err(unreadable)?;
    let folder = whole.parent().unwrap_or(Path::new("/"));
    let name = whole.file_name().unwrap_or_default().to_string_lossy();
    let root = disk::Root::open(folder).map_err(unreadable)?;
    disk::save(&root, &name, text, &disk::Version::of(read)).map_err(unsaved)?;
    Ok(())
}
