//! Paths: how one gets from a thing to one of its subparts.

use base::Name;
use std::fmt;

/// One step of a path.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Step {
    /// To the part of this name (of a superclass of this name, in a class with several).
    Part(Name),
    /// To the element of a list, counted from 0.
    Index(u32),
    /// To the last element of a list.
    Last,
    /// To the thing that the thing is a part of.
    Owner,
}

/// A symbolic reference to a subpart: the same path serves every instance of a class.
///
/// The starting point is supplied by whoever uses the path. The empty path is the thing itself.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Path(pub Vec<Step>);

impl Path {
    /// Makes a path of part names.
    pub fn of(names: &[&str]) -> Self {
        Self(names.iter().map(|n| Step::Part(Name::new(n))).collect())
    }
    /// Returns the path that goes on from `self` by `rest`.
    #[must_use]
    pub fn join(&self, rest: &Self) -> Self {
        Self(self.0.iter().chain(&rest.0).cloned().collect())
    }
    /// Returns the path one step longer.
    #[must_use]
    pub fn then(&self, step: Step) -> Self {
        Self(self.0.iter().cloned().chain([step]).collect())
    }
    /// Returns true if one path can be made from the other by adding steps at its end.
    ///
    /// **Source:** Borning 1979, chapter 3, "Paths".
    pub fn overlaps(&self, other: &Self) -> bool {
        self.0.iter().zip(&other.0).all(|(a, b)| a == b)
    }
    /// Returns true for the path to the thing itself.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl fmt::Display for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, step) in self.0.iter().enumerate() {
            let dot = if i == 0 { "" } else { "." };
            match step {
                Step::Part(name) => write!(f, "{dot}{name}")?,
                Step::Index(n) => write!(f, "[{n}]")?,
                Step::Last => write!(f, "{dot}last")?,
                Step::Owner => write!(f, "{dot}owner")?,
            }
        }
        Ok(())
    }
}
impl fmt::Debug for Path {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}
