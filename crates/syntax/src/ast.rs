//! The typed view: one thin wrapper a construct, over nodes of the tree.
//!
//! A wrapper holds no more than its node. What the text may lack, an accessor answers with `None`
//! or leaves out of its list, so broken trees are read like whole ones.

mod expressions;
mod members;
mod programs;
mod rules;
mod statements;

pub use expressions::{
    AllExpr, Arg, ArgList, BinaryExpr, BinaryOp, Binding, BoolExpr, CallExpr, ChainExpr, CopyExpr,
    Expr, FieldExpr, IfExpr, IndexExpr, IsExpr, LambdaExpr, LetExpr, ListExpr, NameExpr,
    NumberExpr, OwnerExpr, ParenExpr, RangeExpr, SuperExpr, TextExpr, TextPiece, TupleExpr,
    UnaryExpr, UnaryOp,
};
pub use members::{
    Assign, Attachers, Choice, Class, Domain, DottedName, Handle, Message, Modify, Param,
    ParamList, Part, Ref, Superclass, Toolbox, Type, TypeShape, UnitLine, Use, View, YLine,
};
pub use programs::{
    Check, Else, Erase, Family, For, If, Lesson, Next, Program, Repeat, Rows, Table, Value, While,
    With,
};
pub use rules::{
    Anchor, Constraint, Derived, IfRule, Insert, Merge, Method, MethodItem, MethodList, Reads,
    Replace, Rule, RuleBlock, Side, Stay, Strength, When, Within, Without,
};
pub use statements::{
    Delete, Edit, Expect, Expectation, Hint, Move, Note, Promote, Redo, Rename, Say, Set, Simulate,
    Target, Task, Try, Undo, Unmerge,
};

use crate::kind::{Language, SyntaxElement, SyntaxKind, SyntaxNode, SyntaxToken};
use crate::tree::{span_of, span_of_token};
use base::{Name, Span};
use rowan::{Language as _, TextRange};

/// A wrapper of a node of the tree.
pub trait AstNode: Sized {
    /// Wraps a node, if it is of this kind.
    fn cast(node: SyntaxNode) -> Option<Self>;
    /// Returns the node.
    fn syntax(&self) -> &SyntaxNode;
    /// Returns the bytes of the node, its doc comments included.
    fn span(&self) -> Span {
        span_of(self.syntax())
    }
}

/// Declares a wrapper for each kind of node, with the name of the kind.
macro_rules! ast_nodes {
    ($($(#[$doc:meta])* $name:ident,)*) => {$(
        $(#[$doc])*
        #[derive(Clone, PartialEq, Eq, Hash, Debug)]
        pub struct $name {
            pub(crate) syntax: $crate::kind::SyntaxNode,
        }
        impl $crate::ast::AstNode for $name {
            fn cast(node: $crate::kind::SyntaxNode) -> Option<Self> {
                (node.kind() == $crate::kind::SyntaxKind::$name).then_some(Self { syntax: node })
            }
            fn syntax(&self) -> &$crate::kind::SyntaxNode {
                &self.syntax
            }
        }
    )*};
}

/// Declares an enum over wrappers.
macro_rules! ast_enum {
    ($(#[$doc:meta])* $name:ident { $($(#[$vdoc:meta])* $variant:ident($node:ident),)* }) => {
        $(#[$doc])*
        #[derive(Clone, PartialEq, Eq, Hash, Debug)]
        pub enum $name {
            $($(#[$vdoc])* $variant($node),)*
        }
        impl $crate::ast::AstNode for $name {
            fn cast(node: $crate::kind::SyntaxNode) -> Option<Self> {
                match node.kind() {
                    $($crate::kind::SyntaxKind::$node => Some(Self::$variant($node { syntax: node })),)*
                    _ => None,
                }
            }
            fn syntax(&self) -> &$crate::kind::SyntaxNode {
                match self {
                    $(Self::$variant(node) => &node.syntax,)*
                }
            }
        }
    };
}
pub(crate) use {ast_enum, ast_nodes};

/// A word, number or text as it is written, with its place.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub struct Word {
    /// The token.
    pub token: SyntaxToken,
}

impl Word {
    /// Returns what is written.
    pub fn text(&self) -> &str {
        self.token.text()
    }
    /// Returns what is written, as a name.
    pub fn name(&self) -> Name {
        Name::new(self.token.text())
    }
    /// Returns the bytes of the word.
    pub fn span(&self) -> Span {
        span_of_token(&self.token)
    }
    /// Returns what a quoted text says: without quotes, escapes resolved.
    ///
    /// `\n` and `\t` are a line end and a tab; any other character after `\` is itself.
    pub fn unquoted(&self) -> String {
        let text = self.token.text();
        let inner = text.strip_prefix('"').unwrap_or(text);
        let inner = inner.strip_suffix('"').unwrap_or(inner);
        unescaped(inner)
    }
}

/// Reads escapes: `\n`, `\t`, `\"`, `\\`.
pub(crate) fn unescaped(inner: &str) -> String {
    let mut out = String::with_capacity(inner.len());
    let mut chars = inner.chars();
    while let Some(c) = chars.next() {
        out.push(match c {
            '\\' => match chars.next() {
                Some('n') => '\n',
                Some('t') => '\t',
                Some(other) => other,
                None => '\\',
            },
            _ => c,
        });
    }
    out
}

pub(crate) fn child<N: AstNode>(node: &SyntaxNode) -> Option<N> {
    node.children().find_map(N::cast)
}
pub(crate) fn children<N: AstNode>(node: &SyntaxNode) -> impl Iterator<Item = N> + use<N> {
    node.children().filter_map(N::cast)
}
/// The tokens of a node itself, of one kind.
pub(crate) fn words(node: &SyntaxNode, kind: SyntaxKind) -> impl Iterator<Item = Word> + use<> {
    node.children_with_tokens()
        .filter_map(SyntaxElement::into_token)
        .filter(move |t| t.kind() == kind)
        .map(|token| Word { token })
}
pub(crate) fn word(node: &SyntaxNode, kind: SyntaxKind) -> Option<Word> {
    words(node, kind).next()
}
pub(crate) fn has_keyword(node: &SyntaxNode, keyword: &str) -> bool {
    words(node, SyntaxKind::Keyword).any(|w| w.text() == keyword)
}
/// The child after a token of one kind.
pub(crate) fn child_after<N: AstNode>(node: &SyntaxNode, kind: SyntaxKind) -> Option<N> {
    node.children_with_tokens()
        .skip_while(|e| e.kind() != kind)
        .filter_map(SyntaxElement::into_node)
        .find_map(N::cast)
}

/// Returns the doc comment of a member or parameter: its lines without `///`, joined.
pub fn doc_comment(node: &SyntaxNode) -> Option<String> {
    // most have none: the green tree tells so without a cursor for each token
    let green = node.green();
    let lines: Vec<&str> = leading_trivia(&green)
        .filter(|(kind, _)| *kind == SyntaxKind::DocComment)
        .map(|(_, text)| text.trim_start_matches('/').trim())
        .collect();
    (!lines.is_empty()).then(|| lines.join("\n"))
}

/// Returns the bytes of a node without the comments that it begins with.
pub fn span_without_doc(node: &SyntaxNode) -> Span {
    let span = span_of(node);
    let green = node.green();
    let trivia: usize = leading_trivia(&green).map(|(_, text)| text.len()).sum();
    match span.start + trivia as u32 {
        // there is nothing else
        start if start == span.end => span,
        start => Span::new(start, span.end),
    }
}

/// The comments and blanks that a node begins with, as tokens of its own.
fn leading_trivia(green: &rowan::GreenNodeData) -> impl Iterator<Item = (SyntaxKind, &str)> {
    let tokens = green.children().map_while(rowan::NodeOrToken::into_token);
    tokens
        .map(|token| (Language::kind_from_raw(token.kind()), token.text()))
        .take_while(|(kind, _)| kind.is_trivia())
}

ast_nodes! {
    /// A whole text: the body of an unnamed class with one instance.
    File,
    /// `{ members }`
    Body,
    /// What could not be understood.
    Error,
}

impl File {
    /// Returns the members or statements of the file.
    pub fn members(&self) -> impl Iterator<Item = Member> + use<> {
        children(&self.syntax)
    }
    /// Returns the member at these bytes, which [`crate::Parse::outline`] tells.
    pub fn member_at(&self, span: Span) -> Option<Member> {
        let range = TextRange::new(span.start.into(), span.end.into());
        Member::cast(self.syntax.child_or_token_at_range(range)?.into_node()?)
    }
    /// Returns the expression of a text that is one: see [`crate::parse_expression`].
    pub fn expression(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl Body {
    /// Returns the members or statements of the body.
    pub fn members(&self) -> impl Iterator<Item = Member> + use<> {
        children(&self.syntax)
    }
}

ast_enum! {
    /// What a file or a body holds, one after the other: members, and the statements of checks.
    Member {
        /// `unit mm`
        Unit(UnitLine),
        /// `y down`
        Y(YLine),
        /// `use geometry`
        Use(Use),
        /// `class A is B { … }`
        Class(Class),
        /// `modify Line { … }`
        Modify(Modify),
        /// `x: Real = 1`
        Part(Part),
        /// `p1.x = 3`
        Assign(Assign),
        /// `constraint level: p1.y = p2.y`
        Constraint(Constraint),
        /// `merge a = b`
        Merge(Merge),
        /// `stay p1`
        Stay(Stay),
        /// `anchor p1`
        Anchor(Anchor),
        /// `insert current into node.currents`
        Insert(Insert),
        /// `center => …`
        Message(Message),
        /// `without level`
        Without(Without),
        /// `replace level: …`
        Replace(Replace),
        /// `for i in 0..7 { … }`
        For(For),
        /// `if c { … } else { … }`
        If(If),
        /// `repeat … { … } until c`
        Repeat(Repeat),
        /// `while c { … }`
        While(While),
        /// `next under = -ring`
        Next(Next),
        /// `erase line`
        Erase(Erase),
        /// `when c { … }`
        When(When),
        /// `ref target: Section -> …`
        Ref(Ref),
        /// `attachers p1, p2`
        Attachers(Attachers),
        /// `handle far keeps corner`
        Handle(Handle),
        /// `view "Force" => …`
        View(View),
        /// `side lower: right`
        Side(Side),
        /// `toolbox "Mechanics" { … }`
        Toolbox(Toolbox),
        /// `choice Fit { loose, normal, close }`
        Choice(Choice),
        /// `lesson "Midpoints" { … }`
        Lesson(Lesson),
        /// `program Rings(…) { … }`
        Program(Program),
        /// `family StandardRings of Rings { … }`
        Family(Family),
        /// `table "rings.csv"`
        Table(Table),
        /// `rows: (40 mm, 2 mm)`
        Rows(Rows),
        /// `check "…" { … }`
        Check(Check),
        /// `set t.celsius to 10`
        Set(Set),
        /// `move p to (10, 20)`
        Move(Move),
        /// `unmerge p`
        Unmerge(Unmerge),
        /// `delete p`
        Delete(Delete),
        /// `edit Widget { … }`
        Edit(Edit),
        /// `rename a to b`
        Rename(Rename),
        /// `promote beam as Strut`
        Promote(Promote),
        /// `undo`
        Undo(Undo),
        /// `redo`
        Redo(Redo),
        /// `simulate 5 s`
        Simulate(Simulate),
        /// `try set …`
        Try(Try),
        /// `expect …`
        Expect(Expect),
        /// `let before = e`
        Note(Note),
        /// `say "…"`
        Say(Say),
        /// `task …`
        Task(Task),
        /// `hint "…"`
        Hint(Hint),
        /// What could not be understood.
        Error(Error),
    }
}

impl Member {
    /// Returns the member's doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(self.syntax())
    }
}
