//! Constraints with their rules and methods, and the other facts about parts: merges, stays, anchors.

use super::{
    AstNode, Expr, Word, ast_enum, ast_nodes, child, child_after, children, doc_comment, word,
};
use crate::kind::{SyntaxElement, SyntaxKind};

ast_nodes! {
    /// `weak constraint home: x = 100 within 1e-6 { … }`
    Constraint,
    /// `within 1e-9`
    Within,
    /// `if c { rules } else { rules }`
    IfRule,
    /// `{ rules }`
    RuleBlock,
    /// `{ methods }`
    MethodList,
    /// `a, b := e`
    Method,
    /// `reads a, b`
    Reads,
    /// `...`
    Derived,
    /// `merge apex: a = b = c`
    Merge,
    /// `strong stay a, b`
    Stay,
    /// `anchor a, b`
    Anchor,
    /// `insert a into b`
    Insert,
    /// `without a, b.c`
    Without,
    /// `replace level: rule`
    Replace,
    /// `when c { methods }`
    When,
    /// `side lower: right`
    Side,
}

/// How much a constraint or stay weighs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Strength {
    /// `required`
    Required,
    /// `strong`
    Strong,
    /// `medium`
    Medium,
    /// `weak`
    Weak,
}

fn strength(node: &crate::SyntaxNode) -> Option<Strength> {
    match word(node, SyntaxKind::Keyword)?.text() {
        "required" => Some(Strength::Required),
        "strong" => Some(Strength::Strong),
        "medium" => Some(Strength::Medium),
        "weak" => Some(Strength::Weak),
        _ => None,
    }
}

/// What must hold.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Rule {
    /// A Bool expression.
    Holds(Expr),
    /// Rules under a condition.
    If(IfRule),
}

impl AstNode for Rule {
    fn cast(node: crate::SyntaxNode) -> Option<Self> {
        if node.kind() == SyntaxKind::IfRule {
            Some(Self::If(IfRule { syntax: node }))
        } else {
            Expr::cast(node).map(Self::Holds)
        }
    }
    fn syntax(&self) -> &crate::SyntaxNode {
        match self {
            Self::Holds(expr) => expr.syntax(),
            Self::If(rule) => &rule.syntax,
        }
    }
}

impl Constraint {
    /// Returns the strength, where it is written.
    pub fn strength(&self) -> Option<Strength> {
        strength(&self.syntax)
    }
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the rule.
    pub fn rule(&self) -> Option<Rule> {
        child(&self.syntax)
    }
    /// Returns what follows `within`.
    pub fn tolerance(&self) -> Option<Expr> {
        child::<Within>(&self.syntax)?.tolerance()
    }
    /// Returns the written methods; without a list all are derived.
    pub fn methods(&self) -> Option<MethodList> {
        child(&self.syntax)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}
impl Within {
    /// Returns the tolerance.
    pub fn tolerance(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl IfRule {
    /// Returns the condition.
    pub fn condition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the rules that hold where the condition is true.
    pub fn then_rules(&self) -> Option<RuleBlock> {
        child(&self.syntax)
    }
    /// Returns the rules that hold elsewhere; `else if` gives one rule.
    pub fn else_rules(&self) -> Vec<Rule> {
        if let Some(block) = child_after::<RuleBlock>(&self.syntax, SyntaxKind::ElseKw) {
            return block.rules().collect();
        }
        child_after::<IfRule>(&self.syntax, SyntaxKind::ElseKw).map(Rule::If).into_iter().collect()
    }
}
impl RuleBlock {
    /// Returns the rules; a path to a part stands for that part's constraints.
    pub fn rules(&self) -> impl Iterator<Item = Rule> + use<> {
        children(&self.syntax)
    }
}

ast_enum! {
    /// A line of a list of methods.
    MethodItem {
        /// `a, b := e`
        Method(Method),
        /// `reads a, b`
        Reads(Reads),
        /// `...`
        Derived(Derived),
    }
}
impl MethodList {
    /// Returns the lines, in order.
    pub fn items(&self) -> impl Iterator<Item = MethodItem> + use<> {
        children(&self.syntax)
    }
}
impl Method {
    /// Returns the paths that are written.
    pub fn targets(&self) -> impl Iterator<Item = Expr> + use<> {
        let assigns = |e: &SyntaxElement| e.kind() != SyntaxKind::ColonEq;
        self.syntax
            .children_with_tokens()
            .take_while(assigns)
            .filter_map(SyntaxElement::into_node)
            .filter_map(Expr::cast)
    }
    /// Returns what is written into them.
    pub fn value(&self) -> Option<Expr> {
        child_after(&self.syntax, SyntaxKind::ColonEq)
    }
}
impl Reads {
    /// Returns the paths that are never written.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}

impl Merge {
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the paths that become one.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Stay {
    /// Returns the strength, where it is written.
    pub fn strength(&self) -> Option<Strength> {
        strength(&self.syntax)
    }
    /// Returns the paths that stay.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Anchor {
    /// Returns the anchored paths.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Insert {
    /// Returns the part that is inserted.
    pub fn part(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the set that it is inserted into.
    pub fn set(&self) -> Option<Expr> {
        children(&self.syntax).nth(1)
    }
}
impl Without {
    /// Returns the paths of what is masked.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Replace {
    /// Returns the path of the constraint that is replaced.
    pub fn target(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the rule in its place.
    pub fn rule(&self) -> Option<Rule> {
        child_after(&self.syntax, SyntaxKind::Colon)
    }
    /// Returns what follows `within`.
    pub fn tolerance(&self) -> Option<Expr> {
        child::<Within>(&self.syntax)?.tolerance()
    }
    /// Returns the written methods.
    pub fn methods(&self) -> Option<MethodList> {
        child(&self.syntax)
    }
}
impl When {
    /// Returns the condition.
    pub fn condition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns what is written when it becomes true.
    pub fn methods(&self) -> Option<MethodList> {
        child(&self.syntax)
    }
}
impl Side {
    /// Returns the path of what has a side.
    pub fn target(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the side.
    pub fn side(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
}
