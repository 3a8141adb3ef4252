//! Scopes: what names mean where an expression stands.

use crate::kinds::Kind;
use base::{FileId, Name};
use kernel::ClassId;
use std::collections::BTreeMap;

/// Where an expression stands.
#[derive(Clone, Debug)]
pub(crate) struct Scope {
    /// The text.
    pub(crate) file: FileId,
    /// The class whose things are `Me`; then the classes around it, which `owner` reaches.
    pub(crate) classes: Vec<ClassId>,
    /// Names that `let`, lambdas and parameters bind, the innermost last.
    pub(crate) locals: Vec<(Name, Kind)>,
    /// Names that stand for whole numbers: the variables of `for`.
    pub(crate) constants: BTreeMap<Name, i64>,
}

impl Scope {
    pub(crate) fn of(file: FileId, class: ClassId) -> Self {
        Self { file, classes: vec![class], locals: Vec::new(), constants: BTreeMap::new() }
    }
    /// Returns the class whose things are `Me`.
    pub(crate) fn class(&self) -> ClassId {
        self.classes[0]
    }
    /// Returns the scope of a part's body in this one.
    pub(crate) fn inside(&self, class: ClassId) -> Self {
        let mut inner = self.clone();
        inner.classes.insert(0, class);
        inner
    }
    pub(crate) fn with_local(&self, name: Name, kind: Kind) -> Self {
        let mut inner = self.clone();
        inner.locals.push((name, kind));
        inner
    }
    pub(crate) fn with_constant(&self, name: Name, value: i64) -> Self {
        let mut inner = self.clone();
        inner.constants.insert(name, value);
        inner
    }
    /// Returns the number that a variable of `for` stands for.
    pub(crate) fn constant(&self, name: &str) -> Option<f64> {
        self.constants.get(name).map(|&i| i as f64)
    }
    pub(crate) fn local(&self, name: &str) -> Option<&Kind> {
        self.locals.iter().rev().find(|(n, _)| *n == name).map(|(_, kind)| kind)
    }
}
