//! Faults: an expression that has no value, and why.

use crate::programs::Why;
use kernel::OriginId;

/// Why an expression has no value: lower case, what was found and what was wanted.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    /// The member whose expression it is; of several, the innermost.
    pub origin: Option<OriginId>,
    /// What kind of fault it is.
    pub kind: FaultKind,
    /// What was found and what was wanted.
    pub message: String,
}

/// The kinds of faults.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum FaultKind {
    /// A name that leads nowhere.
    UnknownName,
    /// A local name that stands for nothing: in a program, for what was not made.
    Unnamed,
    /// A value of one kind where another was wanted.
    WrongKind,
    /// Values that have not as many parts as each other.
    Unequal,
    /// Numbers of two dimensions where one was wanted.
    WrongDimension,
    /// An operation that has no answer for these values: a division by zero, `"hot".number`.
    NoAnswer,
    /// A reference that names nothing.
    Reference,
    /// Messages that call each other without end.
    Endless,
    /// A program that was called and ended before its last step.
    Run(Why),
}

impl FaultKind {
    /// Returns true for a message that has no value since something is not there, which is said where that is missing: what
    /// a reference names, what a program did not draw.
    pub fn is_of_missing(self) -> bool {
        match self {
            Self::Unnamed | Self::Reference | Self::Run(_) => true,
            Self::UnknownName
            | Self::WrongKind
            | Self::Unequal
            | Self::WrongDimension
            | Self::NoAnswer
            | Self::Endless => false,
        }
    }
    /// Returns the kebab-case code of its diagnostic.
    pub fn code(self) -> &'static str {
        match self {
            Self::UnknownName | Self::Unnamed => "unknown-name",
            Self::WrongKind | Self::Unequal => "wrong-kind",
            Self::WrongDimension => "wrong-dimension",
            Self::NoAnswer => "no-answer",
            Self::Reference => "unknown-reference",
            Self::Endless => "endless-messages",
            Self::Run(_) => "run-ended",
        }
    }
}

impl Fault {
    /// A fault of a kind, with its message, that names no member yet.
    #[cold]
    pub fn new(kind: FaultKind, message: impl Into<String>) -> Self {
        Self { origin: None, kind, message: message.into() }
    }
    #[cold]
    pub(crate) fn unknown(message: impl Into<String>) -> Self {
        Self::new(FaultKind::UnknownName, message)
    }
    #[cold]
    pub(crate) fn wrong(message: impl Into<String>) -> Self {
        Self::new(FaultKind::WrongKind, message)
    }
    pub(crate) fn no_answer(message: impl Into<String>) -> Self {
        Self::new(FaultKind::NoAnswer, message)
    }
    /// Names the member, where no inner one is named yet.
    pub(crate) fn within(mut self, origin: OriginId) -> Self {
        self.origin.get_or_insert(origin);
        self
    }
}
