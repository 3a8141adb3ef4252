//! The kinds of tokens and nodes: the vocabulary that lexer, parser and typed view share.

macro_rules! kinds {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// What a token or a node of the tree is.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
        #[repr(u16)]
        pub enum SyntaxKind {
            $($(#[$doc])* $name,)*
        }
        /// Every kind, in the order of its number.
        const ALL: &[SyntaxKind] = &[$(SyntaxKind::$name,)*];
    };
}

kinds! {
    // ---- trivia
    /// Spaces, tabs and line ends.
    Whitespace,
    /// `// …`, up to the line's end.
    LineComment,
    /// `/// …`: what the lab shows for the member that follows.
    DocComment,
    /// `/* … */`, not nested.
    BlockComment,
    // ---- tokens with a text of their own
    /// `12`, `4.7`, `1e-9`.
    Number,
    /// `kohm`, `m/s^2`, right after a number.
    Unit,
    /// `"…"`, with its quotes.
    Text,
    /// `"… {`: a text up to the first value in it.
    TextOpen,
    /// `} … {`: a text between two values in it.
    TextMiddle,
    /// `} …"`: a text behind the last value in it.
    TextClose,
    /// A name.
    Ident,
    /// A word that is a keyword only where it stands.
    Keyword,
    /// What no token begins with.
    Unknown,
    // ---- reserved words
    /// `if`
    IfKw,
    /// `then`
    ThenKw,
    /// `else`
    ElseKw,
    /// `and`
    AndKw,
    /// `or`
    OrKw,
    /// `not`
    NotKw,
    /// `let`
    LetKw,
    /// `true`
    TrueKw,
    /// `false`
    FalseKw,
    /// `super`
    SuperKw,
    /// `owner`
    OwnerKw,
    // ---- punctuation
    /// `(`
    LParen,
    /// `)`
    RParen,
    /// `[`
    LBracket,
    /// `]`
    RBracket,
    /// `{`
    LBrace,
    /// `}`
    RBrace,
    /// `,`
    Comma,
    /// `;`
    Semicolon,
    /// `:`
    Colon,
    /// `:=`
    ColonEq,
    /// `=`
    Eq,
    /// `==`, which the language does not have; known so that it can be said.
    EqEq,
    /// `=>`
    FatArrow,
    /// `->`
    Arrow,
    /// `!=`
    NotEq,
    /// `<`
    Less,
    /// `<=`
    LessEq,
    /// `>`
    Greater,
    /// `>=`
    GreaterEq,
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Star,
    /// `/`
    Slash,
    /// `^`
    Caret,
    /// `.`
    Dot,
    /// `..`
    DotDot,
    /// `...`
    Ellipsis,
    /// The end of the text; no token of the tree.
    Eof,
    // ---- nodes: the file, bodies, members
    /// A whole text.
    File,
    /// `{ members }`
    Body,
    /// What could not be understood.
    Error,
    /// `unit mm`
    UnitLine,
    /// `y down`
    YLine,
    /// `use parts.bolts`
    Use,
    /// `class A is B { … }`
    Class,
    /// `B as b` after `is`
    Superclass,
    /// `modify Line { … }`
    Modify,
    /// `x, y: Length = 3 { … }`, `length: Length => …`
    Part,
    /// `in 0..9` after a part's class
    Domain,
    /// `p1.x = 3`, `ring = Circle(…)`
    Assign,
    /// `constraint name: rule { methods }`
    Constraint,
    /// `within 1e-9`
    Within,
    /// `if c { rules } else { rules }` as a rule
    IfRule,
    /// `{ rules }`
    RuleBlock,
    /// `{ methods }`
    MethodList,
    /// `a, b := e`
    Method,
    /// `reads a, b`
    Reads,
    /// `...` at the end of a list of methods
    Derived,
    /// `merge a = b = c`
    Merge,
    /// `stay a, b`
    Stay,
    /// `anchor a, b`
    Anchor,
    /// `insert a into b`
    Insert,
    /// `name(params) => e`
    Message,
    /// `(by k: Real, …)`
    ParamList,
    /// `by k: Real in 0..1 = 3 "prompt"`
    Param,
    /// `without a, b`
    Without,
    /// `replace name: rule`
    Replace,
    /// `for a, b in e { … }`
    For,
    /// `if c { … } else { … }` as a member
    If,
    /// `repeat 5 times with … { … } until c`
    Repeat,
    /// `while c with … { … }`
    While,
    /// `with a = e, b = f`
    With,
    /// `next a = e, b = f`
    Next,
    /// `a = e` after `with`, `next`, `let`
    Binding,
    /// `when c { methods }`
    When,
    /// `ref a: C -> path`
    Ref,
    /// `attachers p1, p2`
    Attachers,
    /// `handle far keeps corner`
    Handle,
    /// `erase line`
    Erase,
    /// `view "name" => e`
    View,
    /// `side path: right`
    Side,
    /// `toolbox "name" { A, B }`
    Toolbox,
    /// `let before = e`, in a check
    Note,
    /// `choice Name { a, b }`
    Choice,
    /// `lesson "name" { … }`
    Lesson,
    /// `program Name(params) { … }`
    Program,
    /// `family Name of Program { … }`
    Family,
    /// `table "file.csv"`
    Table,
    /// `rows: (a, b)  (c, d)`
    Rows,
    /// `check "name" { … }`
    Check,
    // ---- statements of checks and lessons
    /// `set a to 1, b to 2`
    Set,
    /// `move a to p, b to q`
    Move,
    /// `a to 1` after `set` and `move`
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
    // ---- classes where they are named
    /// `List of 12 C`, `geometry.Line`
    Type,
    /// `geometry.parts`
    DottedName,
    // ---- expressions
    /// `4.7 kohm`
    NumberExpr,
    /// `"text"`
    TextExpr,
    /// `true`
    BoolExpr,
    /// `x`
    NameExpr,
    /// `super`
    SuperExpr,
    /// `owner`
    OwnerExpr,
    /// `a.b`, `a.b(c)`
    FieldExpr,
    /// `f(a, to: b)`
    CallExpr,
    /// `(a, to: b)` after a name
    ArgList,
    /// `to: b`
    Arg,
    /// `x => e`
    LambdaExpr,
    /// `a[i]`
    IndexExpr,
    /// `-a`, `not a`
    UnaryExpr,
    /// `a + b`
    BinaryExpr,
    /// `a < b <= c`
    ChainExpr,
    /// `a..b`
    RangeExpr,
    /// `a is C`
    IsExpr,
    /// `if c then a else b`
    IfExpr,
    /// `let a = e in f`
    LetExpr,
    /// `[a, b]`
    ListExpr,
    /// `(a, b)`
    TupleExpr,
    /// `(a)`
    ParenExpr,
    /// `copy of a`
    CopyExpr,
    /// `all C`
    AllExpr,
}

impl SyntaxKind {
    /// Returns true for what carries no meaning: spaces and comments.
    pub fn is_trivia(self) -> bool {
        (self as u16) <= SyntaxKind::BlockComment as u16
    }
    /// Returns true for comments of every sort.
    pub fn is_comment(self) -> bool {
        self.is_trivia() && self != SyntaxKind::Whitespace
    }
    /// Returns true for `if then else and or not let true false super owner`.
    pub fn is_reserved(self) -> bool {
        (SyntaxKind::IfKw as u16..=SyntaxKind::OwnerKw as u16).contains(&(self as u16))
    }
    /// Returns the reserved word spelled `word`, if it is one.
    pub fn reserved(word: &str) -> Option<SyntaxKind> {
        Some(match word {
            "if" => SyntaxKind::IfKw,
            "then" => SyntaxKind::ThenKw,
            "else" => SyntaxKind::ElseKw,
            "and" => SyntaxKind::AndKw,
            "or" => SyntaxKind::OrKw,
            "not" => SyntaxKind::NotKw,
            "let" => SyntaxKind::LetKw,
            "true" => SyntaxKind::TrueKw,
            "false" => SyntaxKind::FalseKw,
            "super" => SyntaxKind::SuperKw,
            "owner" => SyntaxKind::OwnerKw,
            _ => return None,
        })
    }
}

/// The language of the tree, as rowan wants it named.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Language {}

impl rowan::Language for Language {
    type Kind = SyntaxKind;
    fn kind_from_raw(raw: rowan::SyntaxKind) -> SyntaxKind {
        ALL[raw.0 as usize]
    }
    fn kind_to_raw(kind: SyntaxKind) -> rowan::SyntaxKind {
        rowan::SyntaxKind(kind as u16)
    }
}

/// A node of the tree, with its place in the text.
pub type SyntaxNode = rowan::SyntaxNode<Language>;
/// A token of the tree, with its place in the text.
pub type SyntaxToken = rowan::SyntaxToken<Language>;
/// A node or a token.
pub type SyntaxElement = rowan::SyntaxElement<Language>;
