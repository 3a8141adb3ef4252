//! Faults: rules that cannot be planned, each named by the member that it comes from.

use kernel::OriginId;

/// A member that has no place in a plan, and why. The rest is planned without it.
#[derive(Clone, PartialEq, Debug)]
pub struct Fault {
    /// The member at fault.
    pub origin: OriginId,
    /// What kind of fault it is.
    pub kind: FaultKind,
    /// What was found and what was wanted.
    pub message: String,
}

/// The kinds of faults.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum FaultKind {
    /// The language has it; the planner cannot solve it yet.
    NotYet,
    /// A name that leads nowhere.
    UnknownName,
    /// A value of one kind where another was wanted.
    WrongKind,
    /// A reference that names nothing.
    Reference,
    /// Messages that call each other without end, or an expression of more than a million steps.
    Endless,
}

impl FaultKind {
    /// Returns the kebab-case code of its diagnostic.
    pub fn code(self) -> &'static str {
        match self {
            Self::NotYet => "not-yet",
            Self::UnknownName => "unknown-name",
            Self::WrongKind => "wrong-kind",
            Self::Reference => "unknown-reference",
            Self::Endless => "endless-messages",
        }
    }
}

/// A fault on its way to the member that it belongs to.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Trouble {
    pub(crate) kind: FaultKind,
    pub(crate) message: String,
}

impl Trouble {
    #[cold]
    pub(crate) fn new(kind: FaultKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }
    #[cold]
    pub(crate) fn not_yet(what: impl Into<String>) -> Self {
        Self::new(FaultKind::NotYet, what)
    }
    #[cold]
    pub(crate) fn wrong(what: impl Into<String>) -> Self {
        Self::new(FaultKind::WrongKind, what)
    }
    pub(crate) fn at(self, origin: OriginId) -> Fault {
        Fault { origin, kind: self.kind, message: self.message }
    }
}
