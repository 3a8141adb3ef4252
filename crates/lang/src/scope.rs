//! Scopes: what names mean where an expression stands.

use crate::kinds::Kind;
use base::{FileId, Name};
use kernel::{ClassId, Path, Step, Term};
use std::collections::BTreeMap;
use syntax::ast::Expr;

/// Where an expression stands.
#[derive(Clone, Debug)]
pub(crate) struct Scope {
    /// The text.
    pub(crate) file: FileId,
    /// The class whose things are `Me`; then the classes around it, which `owner` reaches.
    pub(crate) classes: Vec<ClassId>,
    /// Names that `let`, lambdas and parameters bind, the innermost last.
    pub(crate) locals: Vec<(Name, Kind)>,
    /// Names that stand for constants: the variables of `for`.
    pub(crate) constants: BTreeMap<Name, Constant>,
    /// Names that stand for elements of lists, the innermost last.
    pub(crate) elements: Vec<Element>,
    /// The turns of the loops around, in the same body, the outermost first.
    pub(crate) turns: Vec<u32>,
    /// True in the steps of a program: of its steps those are seen that are among the locals.
    pub(crate) is_program: bool,
    /// The name that is not looked for in the innermost class: a value of a body means what is further out by it.
    pub(crate) outwards: Option<Name>,
}

/// What a variable of `for` stands for where it is known as the text stands.
#[derive(Clone, Debug)]
pub(crate) enum Constant {
    /// A whole number: it may be an index.
    Whole(i64),
    /// Any other number, a text, a truth value, an option.
    Value(Term, Kind),
}

/// An element of a list that `for` goes through.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    pub(crate) name: Name,
    /// From the thing in whose body `for` stands.
    pub(crate) path: Path,
    /// None for what is declared in a loop: it is looked up where it is spoken of.
    pub(crate) class: Option<ClassId>,
    /// How many classes there are around that body, its own included.
    pub(crate) depth: usize,
}

impl Scope {
    pub(crate) fn of(file: FileId, class: ClassId) -> Self {
        Self {
            file,
            classes: vec![class],
            locals: Vec::new(),
            constants: BTreeMap::new(),
            elements: Vec::new(),
            turns: Vec::new(),
            is_program: false,
            outwards: None,
        }
    }
    /// Returns the class whose things are `Me`.
    pub(crate) fn class(&self) -> ClassId {
        self.classes[0]
    }
    /// Returns the scope of a part's body in this one.
    pub(crate) fn inside(&self, class: ClassId) -> Self {
        let mut inner = self.clone();
        inner.classes.insert(0, class);
        inner.turns.clear();
        inner.outwards = None;
        inner
    }
    pub(crate) fn with_local(&self, name: Name, kind: Kind) -> Self {
        let mut inner = self.clone();
        inner.add_local(name, kind);
        inner
    }
    /// Makes a name stand for something of a kind from here on.
    pub(crate) fn add_local(&mut self, name: Name, kind: Kind) {
        self.locals.push((name, kind));
    }
    /// Returns how many of the innermost classes a name is not looked for in.
    pub(crate) fn passed_over(&self, name: &str) -> usize {
        usize::from(self.outwards.as_ref().is_some_and(|outwards| *outwards == name))
    }
    /// Makes a name stand for a constant.
    pub(crate) fn bind_constant(&mut self, name: Name, value: Constant) {
        self.constants.insert(name, value);
    }
    /// Returns the whole number that a name stands for.
    pub(crate) fn whole(&self, name: &str) -> Option<i64> {
        match self.constants.get(name)? {
            Constant::Whole(number) => Some(*number),
            Constant::Value(..) => None,
        }
    }
    /// Makes a name stand for an element of a list, of this class if that is known.
    pub(crate) fn bind_element(&mut self, name: Name, path: Path, class: Option<ClassId>) {
        self.elements.push(Element { name, path, class, depth: self.classes.len() });
    }
    /// Returns the scope in which is looked for what is given a value: the parts of a thing of this class. In the body of
    /// a part no variable of a loop around it is one of these.
    pub(crate) fn of_target(&self, class: ClassId, is_in_body: bool) -> Self {
        let depth = self.classes.len();
        let mut own = Self { outwards: None, classes: vec![class], ..self.clone() };
        own.elements.retain(|element| !is_in_body && element.depth == depth);
        own
    }
    /// Returns the element that a variable of `for` stands for.
    pub(crate) fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().rev().find(|e| e.name == *name)
    }
    /// Returns the path to an element from here.
    pub(crate) fn path_to(&self, element: &Element) -> Path {
        let outwards = self.classes.len().saturating_sub(element.depth);
        Path(vec![Step::Owner; outwards]).join(&element.path)
    }
    /// Returns the whole number that a variable of `for` stands for.
    pub(crate) fn constant(&self, name: &Expr) -> Option<f64> {
        let Expr::Name(name) = name else { return None };
        self.whole(&name.name()?.name()).map(|i| i as f64)
    }
    pub(crate) fn local(&self, name: &str) -> Option<&Kind> {
        self.locals.iter().rev().find(|(n, _)| *n == name).map(|(_, kind)| kind)
    }
}
