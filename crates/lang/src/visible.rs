//! Which class a name means in a text: one of its own, else of a text that it uses, else the
//! language's.

use base::{FileId, Name};
use kernel::ClassId;
use std::collections::{BTreeMap, BTreeSet};

/// The classes that can be named.
#[derive(Clone, Debug, Default)]
pub(crate) struct Visible {
    /// The classes of each name, in order of declaration, with their texts; the language's own have
    /// none.
    classes: BTreeMap<Name, Vec<(Option<FileId>, ClassId)>>,
    /// For every text, all that it uses, directly or by way of others.
    uses: BTreeMap<FileId, BTreeSet<FileId>>,
}

impl Visible {
    /// Names a class of the language.
    pub(crate) fn add_own(&mut self, name: Name, class: ClassId) {
        self.classes.entry(name).or_default().push((None, class));
    }
    /// Names a class of a text. Texts come after those that they use.
    pub(crate) fn add(&mut self, file: FileId, name: Name, class: ClassId) {
        self.classes.entry(name).or_default().push((Some(file), class));
    }
    /// Lets a text use another, which has been read, and all that it uses.
    pub(crate) fn add_use(&mut self, file: FileId, used: FileId) {
        let mut all = self.uses.get(&used).cloned().unwrap_or_default();
        all.insert(used);
        self.uses.entry(file).or_default().extend(all);
    }
    /// Returns the class of the language itself of a name.
    pub(crate) fn of_language(&self, name: &str) -> Option<ClassId> {
        self.classes.get(name)?.iter().find(|class| class.0.is_none()).map(|class| class.1)
    }
    /// Returns the class that a name means in a text.
    pub(crate) fn class(&self, file: FileId, name: &str) -> Option<ClassId> {
        let all = self.classes.get(name)?.iter().rev();
        let seen = |class: &&(Option<FileId>, ClassId)| self.sees(file, class.0);
        // what the text itself declares was declared last of what it sees
        all.into_iter().find(seen).map(|c| c.1)
    }
    /// Returns the texts that a name can come from where a text does not declare it itself and several that it uses
    /// do, none of which knows the other: nothing says which one is meant.
    pub(crate) fn rivals(&self, file: FileId, name: &str) -> Vec<FileId> {
        let all = self.classes.get(name).map(Vec::as_slice).unwrap_or_default();
        if all.iter().any(|c| c.0 == Some(file)) {
            return Vec::new();
        }
        let seen = all.iter().filter_map(|c| c.0.filter(|_| self.sees(file, c.0)));
        let seen: Vec<FileId> = seen.collect();
        let is_used = |other: &FileId| {
            let uses = |by: &FileId| self.uses.get(by).is_some_and(|all| all.contains(other));
            seen.iter().any(uses)
        };
        let apart: Vec<FileId> = seen.iter().copied().filter(|f| !is_used(f)).collect();
        if apart.len() > 1 { apart } else { Vec::new() }
    }
    /// Returns the texts that a text uses, directly or by way of others.
    pub(crate) fn used(&self, file: FileId) -> impl Iterator<Item = FileId> {
        self.uses.get(&file).into_iter().flatten().copied()
    }
    /// Returns the class of this name that a text itself declares.
    pub(crate) fn declared(&self, file: FileId, name: &str) -> Option<ClassId> {
        self.classes.get(name)?.iter().find(|c| c.0 == Some(file)).map(|c| c.1)
    }
    /// Returns the names of all classes that a text can name.
    pub(crate) fn names(&self, file: FileId) -> impl Iterator<Item = &Name> {
        let seen =
            move |all: &[(Option<FileId>, ClassId)]| all.iter().any(|c| self.sees(file, c.0));
        self.classes.iter().filter(move |(_, all)| seen(all)).map(|(name, _)| name)
    }
    fn sees(&self, file: FileId, other: Option<FileId>) -> bool {
        let Some(other) = other else { return true };
        other == file || self.uses.get(&file).is_some_and(|all| all.contains(&other))
    }
}
