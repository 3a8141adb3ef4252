//! Expressions.

use super::{
    AstNode, Type, Word, ast_enum, ast_nodes, child, child_after, children, unescaped, word, words,
};
use crate::kind::{SyntaxElement, SyntaxKind, SyntaxNode};

ast_nodes! {
    /// `4.7 kohm`
    NumberExpr,
    /// `"text"`
    TextExpr,
    /// `true`, `false`
    BoolExpr,
    /// `x`
    NameExpr,
    /// `super`
    SuperExpr,
    /// `owner`
    OwnerExpr,
    /// `a.b`, `a.b(c, to: d)`: a part or a message
    FieldExpr,
    /// `f(a, to: b)`: a constructor or a message to self
    CallExpr,
    /// `(a, to: b)`
    ArgList,
    /// `to: b`
    Arg,
    /// `x => e`, `(x, y) => e`
    LambdaExpr,
    /// `a[i]`
    IndexExpr,
    /// `-a`, `not a`
    UnaryExpr,
    /// `a + b`
    BinaryExpr,
    /// `a < b <= c`
    ChainExpr,
    /// `a..b`, both ends included
    RangeExpr,
    /// `a is C`
    IsExpr,
    /// `if c then a else b`
    IfExpr,
    /// `let a = e, b = f in g`
    LetExpr,
    /// `a = e`
    Binding,
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

ast_enum! {
    /// An expression.
    Expr {
        /// `4.7 kohm`
        Number(NumberExpr),
        /// `"text"`
        Text(TextExpr),
        /// `true`
        Bool(BoolExpr),
        /// `x`
        Name(NameExpr),
        /// `super`
        Super(SuperExpr),
        /// `owner`
        Owner(OwnerExpr),
        /// `a.b(c)`
        Field(FieldExpr),
        /// `f(a)`
        Call(CallExpr),
        /// `x => e`
        Lambda(LambdaExpr),
        /// `a[i]`
        Index(IndexExpr),
        /// `-a`
        Unary(UnaryExpr),
        /// `a + b`
        Binary(BinaryExpr),
        /// `a < b < c`
        Chain(ChainExpr),
        /// `a..b`
        Range(RangeExpr),
        /// `a is C`
        Is(IsExpr),
        /// `if c then a else b`
        If(IfExpr),
        /// `let a = e in f`
        Let(LetExpr),
        /// `[a, b]`
        List(ListExpr),
        /// `(a, b)`
        Tuple(TupleExpr),
        /// `(a)`
        Paren(ParenExpr),
        /// `copy of a`
        Copy(CopyExpr),
        /// `all C`
        All(AllExpr),
    }
}

/// An operator before its operand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum UnaryOp {
    /// `-`
    Negate,
    /// `+`
    Plus,
    /// `not`
    Not,
}

/// An operator between its operands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BinaryOp {
    /// `or`
    Or,
    /// `and`
    And,
    /// `=`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
    /// `in`
    In,
    /// `subset`
    Subset,
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `union`
    Union,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `mod`
    Remainder,
    /// `^`
    Power,
}

impl BinaryOp {
    fn of(token: &crate::SyntaxToken) -> Option<Self> {
        Some(match token.kind() {
            SyntaxKind::OrKw => Self::Or,
            SyntaxKind::AndKw => Self::And,
            SyntaxKind::Eq | SyntaxKind::EqEq => Self::Equal,
            SyntaxKind::NotEq => Self::NotEqual,
            SyntaxKind::Less => Self::Less,
            SyntaxKind::LessEq => Self::LessEqual,
            SyntaxKind::Greater => Self::Greater,
            SyntaxKind::GreaterEq => Self::GreaterEqual,
            SyntaxKind::Plus => Self::Add,
            SyntaxKind::Minus => Self::Subtract,
            SyntaxKind::Star => Self::Multiply,
            SyntaxKind::Slash => Self::Divide,
            SyntaxKind::Caret => Self::Power,
            SyntaxKind::Keyword => match token.text() {
                "in" => Self::In,
                "subset" => Self::Subset,
                "union" => Self::Union,
                "mod" => Self::Remainder,
                _ => return None,
            },
            _ => return None,
        })
    }
}

/// The operators among a node's own tokens.
pub(super) fn operators(node: &SyntaxNode) -> impl Iterator<Item = (BinaryOp, Word)> + use<> {
    node.children_with_tokens()
        .filter_map(SyntaxElement::into_token)
        .filter_map(|token| Some((BinaryOp::of(&token)?, Word { token })))
}

impl NumberExpr {
    /// Returns the digits.
    pub fn digits(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Number)
    }
    /// Returns the number, without its unit.
    pub fn value(&self) -> Option<f64> {
        self.digits()?.text().parse().ok()
    }
    /// Returns the unit as it is written.
    pub fn unit(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Unit)
    }
}
/// A piece of a text: words as they are read, or the value of an expression.
#[derive(Clone, Debug)]
pub enum TextPiece {
    /// Words, without quotes and escapes.
    Words(String),
    /// A value in braces.
    Value(Expr),
}

impl TextExpr {
    /// Returns the text where no value stands in it, without quotes and escapes.
    pub fn plain(&self) -> Option<String> {
        word(&self.syntax, SyntaxKind::Text).map(|w| without_doubled(&w.unquoted()))
    }
    /// Returns its pieces, in order: words, and values where some stand in it.
    pub fn pieces(&self) -> impl Iterator<Item = TextPiece> + use<> {
        self.syntax.children_with_tokens().filter_map(|child| match child {
            SyntaxElement::Node(node) => Expr::cast(node).map(TextPiece::Value),
            SyntaxElement::Token(token) => {
                let cut = |before: char, after: char| {
                    let text = token.text();
                    let text = text.strip_prefix(before).unwrap_or(text);
                    let inner = text.strip_suffix(after).unwrap_or(text);
                    Some(TextPiece::Words(without_doubled(&unescaped(inner))))
                };
                match token.kind() {
                    SyntaxKind::Text => cut('"', '"'),
                    SyntaxKind::TextOpen => cut('"', '{'),
                    SyntaxKind::TextMiddle => cut('}', '{'),
                    SyntaxKind::TextClose => cut('}', '"'),
                    _ => None,
                }
            }
        })
    }
}
impl BoolExpr {
    /// Returns the truth value.
    pub fn value(&self) -> bool {
        word(&self.syntax, SyntaxKind::TrueKw).is_some()
    }
}
impl NameExpr {
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
}
impl FieldExpr {
    /// Returns what the part is of, or the message is sent to.
    pub fn receiver(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the name of the part or message.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the arguments, where brackets are written.
    pub fn args(&self) -> Option<ArgList> {
        child(&self.syntax)
    }
}
impl CallExpr {
    /// Returns the name of the class or message.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the arguments.
    pub fn args(&self) -> Option<ArgList> {
        child(&self.syntax)
    }
}
impl ArgList {
    /// Returns the arguments.
    pub fn args(&self) -> impl Iterator<Item = Arg> + use<> {
        children(&self.syntax)
    }
}
impl Arg {
    /// Returns the label; without one the argument stands by position.
    pub fn label(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the value.
    pub fn value(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl LambdaExpr {
    /// Returns the parameters.
    pub fn params(&self) -> impl Iterator<Item = Word> + use<> {
        words(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns what it answers.
    pub fn body(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl IndexExpr {
    /// Returns the list.
    pub fn receiver(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the index.
    pub fn index(&self) -> Option<Expr> {
        child_after(&self.syntax, SyntaxKind::LBracket)
    }
}
impl UnaryExpr {
    /// Returns the operator.
    pub fn op(&self) -> Option<UnaryOp> {
        self.syntax.children_with_tokens().find_map(|e| match e.kind() {
            SyntaxKind::Minus => Some(UnaryOp::Negate),
            SyntaxKind::Plus => Some(UnaryOp::Plus),
            SyntaxKind::NotKw => Some(UnaryOp::Not),
            _ => None,
        })
    }
    /// Returns the operand.
    pub fn operand(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl BinaryExpr {
    /// Returns the operator.
    pub fn op(&self) -> Option<BinaryOp> {
        operators(&self.syntax).next().map(|(op, _)| op)
    }
    /// Returns the operator as it is written.
    pub fn op_word(&self) -> Option<Word> {
        operators(&self.syntax).next().map(|(_, word)| word)
    }
    /// Returns the left side.
    pub fn left(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the right side.
    pub fn right(&self) -> Option<Expr> {
        children(&self.syntax).nth(1)
    }
}
impl ChainExpr {
    /// Returns the operators, one fewer than the operands.
    pub fn ops(&self) -> impl Iterator<Item = (BinaryOp, Word)> + use<> {
        operators(&self.syntax)
    }
    /// Returns the operands.
    pub fn operands(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
/// Reads doubled braces as braces.
fn without_doubled(text: &str) -> String {
    text.replace("{{", "{").replace("}}", "}")
}

impl RangeExpr {
    /// Returns the first value, or after `>` the one before it; nothing where there is no least one: `..9`, `< 9`.
    pub fn start(&self) -> Option<Expr> {
        child(&self.syntax).filter(|_| !self.has_no_start())
    }
    /// Returns true if the value after `..<` or `<` is not part of it.
    pub fn is_open(&self) -> bool {
        word(&self.syntax, SyntaxKind::Less).is_some()
    }
    /// Returns true if the value after `>` is not part of it.
    pub fn is_above(&self) -> bool {
        word(&self.syntax, SyntaxKind::Greater).is_some()
    }
    /// Returns the last value, or after `..<` the one behind it; nothing where there is no largest one: `0..`, `> 0`.
    pub fn end(&self) -> Option<Expr> {
        children(&self.syntax).nth(usize::from(!self.has_no_start()))
    }
    fn has_no_start(&self) -> bool {
        let first = self.syntax.children_with_tokens().find(|e| !e.kind().is_trivia());
        first.is_some_and(|first| {
            matches!(first.kind(), SyntaxKind::DotDot | SyntaxKind::Less | SyntaxKind::LessEq)
        })
    }
}
impl IsExpr {
    /// Returns what is asked about.
    pub fn operand(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the class.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
}
impl IfExpr {
    /// Returns the condition.
    pub fn condition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the value where it is true.
    pub fn then_value(&self) -> Option<Expr> {
        child_after(&self.syntax, SyntaxKind::ThenKw)
    }
    /// Returns the value elsewhere.
    pub fn else_value(&self) -> Option<Expr> {
        child_after(&self.syntax, SyntaxKind::ElseKw)
    }
}
impl LetExpr {
    /// Returns the bindings.
    pub fn bindings(&self) -> impl Iterator<Item = Binding> + use<> {
        children(&self.syntax)
    }
    /// Returns what follows `in`.
    pub fn body(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl Binding {
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the value.
    pub fn value(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl ListExpr {
    /// Returns the elements.
    pub fn elements(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl TupleExpr {
    /// Returns the elements.
    pub fn elements(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl ParenExpr {
    /// Returns what stands in the brackets.
    pub fn inner(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl CopyExpr {
    /// Returns what is copied.
    pub fn operand(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl AllExpr {
    /// Returns the class.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
}
