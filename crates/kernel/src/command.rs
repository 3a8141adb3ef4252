//! Commands: the only way in. Mouse, text edit, replay and command line all speak these.

use crate::path::Path;

/// A value as a command carries it: what a user typed, dragged to or chose.
#[derive(Clone, PartialEq, Debug)]
pub enum Literal {
    /// A number in base units.
    Number(f64),
    /// A text.
    Text(String),
    /// A truth value.
    Bool(bool),
    /// A thing by position: a place `(x, y)`.
    Tuple(Vec<Literal>),
    /// What a part shall name, by its path from the document.
    Path(Path),
}

/// A change of a document, as its user means it. Each is one undo step with all that it implies.
///
/// `members` are written in the language: the text is the document's saved form, and a command that
/// changes structure is the smallest edit of it.
#[derive(Clone, PartialEq, Debug)]
pub enum Command {
    /// Required for this edit: what is typed into a value. A list is one edit.
    Set(Vec<(Path, Literal)>),
    /// A wish, as a drag from press to release. A list is one edit.
    Move(Vec<(Path, Literal)>),
    /// Makes parts one part.
    Merge(Vec<Path>),
    /// Takes a part out of the merges that name it; it keeps a copy of its value.
    Unmerge(Path),
    /// Deletes a part and everything that speaks of it.
    Delete(Path),
    /// Adds members to the document, a class (by name) or a thing (which becomes a class of one).
    Edit {
        /// The class's name or the thing's path; empty for the document.
        target: Path,
        /// The members, in the language.
        members: String,
    },
    /// Gives a part, class or constraint another name, wherever it is spoken of.
    Rename {
        /// What it is called now.
        from: Path,
        /// What it shall be called.
        to: String,
    },
    /// Gives a thing's class of one a name of its own.
    Promote {
        /// The thing.
        path: Path,
        /// The new class's name.
        class: String,
    },
    /// Locks a value, or lets it go.
    Anchor {
        /// The part.
        path: Path,
        /// Whether it shall be held.
        held: bool,
    },
    /// Switches a constraint on or off without deleting it.
    Enable {
        /// The constraint.
        path: Path,
        /// Whether it shall hold.
        on: bool,
    },
    /// Replaces the whole text, as an editor does.
    Text(String),
    /// Takes back the last step.
    Undo,
    /// Does again what was taken back.
    Redo,
}
