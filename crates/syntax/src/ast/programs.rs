//! Programs, blocks of steps, families; checks and lessons as wholes.

use super::{
    AstNode, Binding, Body, Expr, ParamList, Superclass, TupleExpr, Type, Word, ast_nodes, child,
    child_after, children, doc_comment, has_keyword, word, words,
};
use crate::kind::{SyntaxElement, SyntaxKind, SyntaxNode};

ast_nodes! {
    /// `for a, b in e { … }`
    For,
    /// `if c { … } else { … }`
    If,
    /// `repeat 5 times with … { … } until c`
    Repeat,
    /// `while c with … { … }`
    While,
    /// `with a = e, b = f`
    With,
    /// `next a = e, b = f`
    Next,
    /// `erase line`
    Erase,
    /// `program Rings(…) { … }`
    Program,
    /// `family StandardRings of Rings { … }`
    Family,
    /// `table "rings.csv"`
    Table,
    /// `rows: (40 mm, 2 mm)  (20 mm, 1 mm)`
    Rows,
    /// `check "…" { … }`
    Check,
    /// `lesson "…" { … }`
    Lesson,
}

/// What a part or a step is.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Value {
    /// An expression.
    Expr(Expr),
    /// A repetition.
    Repeat(Repeat),
    /// A repetition under a condition.
    While(While),
    /// A repetition over elements.
    For(For),
    /// Steps under a condition.
    If(If),
}

impl AstNode for Value {
    fn cast(node: SyntaxNode) -> Option<Self> {
        if let Some(expr) = Expr::cast(node.clone()) {
            return Some(Self::Expr(expr));
        }
        if let Some(block) = Repeat::cast(node.clone()) {
            return Some(Self::Repeat(block));
        }
        if let Some(block) = While::cast(node.clone()) {
            return Some(Self::While(block));
        }
        if let Some(block) = For::cast(node.clone()) {
            return Some(Self::For(block));
        }
        If::cast(node).map(Self::If)
    }
    fn syntax(&self) -> &SyntaxNode {
        match self {
            Self::Expr(expr) => expr.syntax(),
            Self::Repeat(block) => &block.syntax,
            Self::While(block) => &block.syntax,
            Self::For(block) => &block.syntax,
            Self::If(block) => &block.syntax,
        }
    }
}
impl Value {
    /// Returns the expression, if it is one.
    pub fn expr(self) -> Option<Expr> {
        match self {
            Self::Expr(expr) => Some(expr),
            Self::Repeat(_) | Self::While(_) | Self::For(_) | Self::If(_) => None,
        }
    }
}

impl For {
    /// Returns the names that an element is given.
    pub fn names(&self) -> impl Iterator<Item = Word> + use<> {
        words(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns what the names run through.
    pub fn range(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns what objects are in the first turn.
    pub fn with(&self) -> Option<With> {
        child(&self.syntax)
    }
    /// Returns what is repeated.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}

/// What stands after `else`.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Else {
    /// `else { … }`
    Body(Body),
    /// `else if …`
    If(If),
}
impl If {
    /// Returns the condition.
    pub fn condition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the members where it is true.
    pub fn then_body(&self) -> Option<Body> {
        child(&self.syntax)
    }
    /// Returns what stands after `else`.
    pub fn else_branch(&self) -> Option<Else> {
        child_after(&self.syntax, SyntaxKind::ElseKw)
            .map(Else::Body)
            .or_else(|| child_after(&self.syntax, SyntaxKind::ElseKw).map(Else::If))
    }
    /// Returns the condition that is turned round by `not ((…))`, two pairs of parentheses: how an `if` is written while
    /// its other branch is demonstrated with the same values.
    pub fn turned_round(&self) -> Option<String> {
        let condition = self.condition()?.syntax().text().to_string();
        Self::inside_turned(condition.trim()).map(str::to_string)
    }
    /// Returns the condition that is turned round twice, `not (not ((…)))`: how an `if` is written while its other branch
    /// is demonstrated under other values.
    pub fn turned_twice(&self) -> Option<String> {
        let condition = self.condition()?.syntax().text().to_string();
        let inner = condition.trim().strip_prefix("not (")?.strip_suffix(')')?;
        Self::inside_turned(inner).map(str::to_string)
    }
    /// Returns what stands in the parentheses of a condition `not ((…))`. `not ((a) or (b))` is none.
    pub fn inside_turned(condition: &str) -> Option<&str> {
        let inner = condition.strip_prefix("not ((")?.strip_suffix("))")?;
        is_closed(inner).then_some(inner)
    }
}

/// Whether each parenthesis of a text is closed in it.
fn is_closed(text: &str) -> bool {
    let mut depth = 0;
    let is_inside = text.chars().all(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        depth >= 0
    });
    is_inside && depth == 0
}
impl Repeat {
    /// Returns true for `repeat n { … }`, which lacks its `times`.
    pub fn lacks_times(&self) -> bool {
        let first = self.syntax.children().next();
        self.times().is_none() && first.is_some_and(|first| Expr::cast(first).is_some())
    }
    /// Returns the number of turns before `times`.
    pub fn times(&self) -> Option<Expr> {
        has_keyword(&self.syntax, "times").then(|| child(&self.syntax)).flatten()
    }
    /// Returns what objects are in the first turn.
    pub fn with(&self) -> Option<With> {
        child(&self.syntax)
    }
    /// Returns what is repeated.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
    /// Returns the condition after `until`.
    pub fn until(&self) -> Option<Expr> {
        self.syntax
            .children_with_tokens()
            .skip_while(|e| e.as_token().is_none_or(|t| t.text() != "until"))
            .filter_map(SyntaxElement::into_node)
            .find_map(Expr::cast)
    }
}
impl While {
    /// Returns the condition.
    pub fn condition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns what objects are in the first turn.
    pub fn with(&self) -> Option<With> {
        child(&self.syntax)
    }
    /// Returns what is repeated.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}
impl With {
    /// Returns the bindings.
    pub fn bindings(&self) -> impl Iterator<Item = Binding> + use<> {
        children(&self.syntax)
    }
}
impl Next {
    /// Returns the bindings.
    pub fn bindings(&self) -> impl Iterator<Item = Binding> + use<> {
        children(&self.syntax)
    }
}
impl Erase {
    /// Returns the steps that are no longer part of the result.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Program {
    /// Returns true for `abstract program`: other programs and messages call it, and hands do not.
    pub fn is_abstract(&self) -> bool {
        has_keyword(&self.syntax, "abstract")
    }
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the parameters.
    pub fn params(&self) -> Option<ParamList> {
        child(&self.syntax)
    }
    /// Returns the superclasses.
    pub fn superclasses(&self) -> impl Iterator<Item = Superclass> + use<> {
        children(&self.syntax)
    }
    /// Returns the steps.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}
impl Family {
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the program.
    pub fn program(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns the table or rows.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}
impl Table {
    /// Returns the name of the file, quoted.
    pub fn file(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
}
impl Rows {
    /// Returns the rows.
    pub fn rows(&self) -> impl Iterator<Item = TupleExpr> + use<> {
        children(&self.syntax)
    }
}
impl Check {
    /// Returns what is promised, quoted.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
    /// Returns the statements.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}
impl Lesson {
    /// Returns the title, quoted.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
    /// Returns the statements.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}
