//! Statements of checks and lessons: the written forms of Commands.

use super::expressions::{BinaryOp, operators};
use super::rules::Within;
use super::{Body, Expr, Member, Word, ast_nodes, child, children, word};
use crate::kind::SyntaxKind;

ast_nodes! {
    /// `set a to 1, b to 2`
    Set,
    /// `move a to p, b to q`
    Move,
    /// `a to 1`
    Target,
    /// `unmerge a, b`
    Unmerge,
    /// `delete a, b`
    Delete,
    /// `edit path { … }`
    Edit,
    /// `rename a to b`
    Rename,
    /// `promote a as B`
    Promote,
    /// `undo`
    Undo,
    /// `redo`
    Redo,
    /// `simulate 5 s`
    Simulate,
    /// `try statement`
    Try,
    /// `expect …`
    Expect,
    /// `say "…"`
    Say,
    /// `task e`
    Task,
    /// `hint "…"`
    Hint,
    /// `let before = e`
    Note,
}

impl Note {
    /// Returns the name that the value gets.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the value.
    pub fn value(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}

impl Set {
    /// Returns the paths with their values: one edit.
    pub fn targets(&self) -> impl Iterator<Item = Target> + use<> {
        children(&self.syntax)
    }
}
impl Move {
    /// Returns the paths with where they are wished: one edit.
    pub fn targets(&self) -> impl Iterator<Item = Target> + use<> {
        children(&self.syntax)
    }
}
impl Target {
    /// Returns the path.
    pub fn path(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns what follows `to`.
    pub fn value(&self) -> Option<Expr> {
        children(&self.syntax).nth(1)
    }
}
impl Unmerge {
    /// Returns the paths.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Delete {
    /// Returns the paths.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Edit {
    /// Returns the class or thing that is edited.
    pub fn path(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns what is added to it.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}
impl Rename {
    /// Returns the path of what is renamed.
    pub fn path(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the new name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
}
impl Promote {
    /// Returns the path of the thing whose body becomes a class.
    pub fn path(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the name of the class.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
}
impl Simulate {
    /// Returns how long.
    pub fn duration(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl Try {
    /// Returns the statement that may be refused.
    pub fn statement(&self) -> Option<Member> {
        child(&self.syntax)
    }
}
impl Say {
    /// Returns what is said, quoted.
    pub fn text(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
}
impl Task {
    /// Returns the condition that the learner makes true.
    pub fn condition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl Hint {
    /// Returns the hint, quoted.
    pub fn text(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
}

/// What is expected.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Expectation {
    /// `expect EXPR within e`
    Holds {
        /// The condition.
        condition: Option<Expr>,
        /// What follows `within`.
        tolerance: Option<Expr>,
    },
    /// `expect satisfied`
    Satisfied,
    /// `expect moved a, b only`
    Moved(Vec<Expr>),
    /// `expect free = 3`
    Free(BinaryOp, Option<Expr>),
    /// `expect solutions = 92`
    Solutions(BinaryOp, Option<Expr>),
    /// `expect plan one_pass`
    Plan(Option<Word>),
    /// `expect error "word"`
    Error(Option<Word>),
}
impl Expect {
    /// Returns what is expected.
    pub fn expectation(&self) -> Expectation {
        let keyword = super::words(&self.syntax, SyntaxKind::Keyword).nth(1);
        let counted = |of: fn(BinaryOp, Option<Expr>) -> Expectation| {
            let op = operators(&self.syntax).next().map_or(BinaryOp::Equal, |(op, _)| op);
            of(op, child(&self.syntax))
        };
        match keyword.as_ref().map(Word::text) {
            Some("satisfied") => Expectation::Satisfied,
            Some("moved") => Expectation::Moved(children(&self.syntax).collect()),
            Some("free") => counted(Expectation::Free),
            Some("solutions") => counted(Expectation::Solutions),
            Some("plan") => Expectation::Plan(word(&self.syntax, SyntaxKind::Ident)),
            Some("error") => Expectation::Error(word(&self.syntax, SyntaxKind::Text)),
            _ => Expectation::Holds {
                condition: child(&self.syntax),
                tolerance: child::<Within>(&self.syntax).and_then(|w| w.tolerance()),
            },
        }
    }
}
