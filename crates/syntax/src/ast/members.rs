//! Members of a class or a thing.

use super::{
    AstNode, Body, Expr, Value, Word, ast_enum, ast_nodes, child, child_after, children,
    doc_comment, has_keyword, word, words,
};
use crate::kind::{SyntaxElement, SyntaxKind};

ast_nodes! {
    /// `unit mm`
    UnitLine,
    /// `y down`
    YLine,
    /// `use parts.bolts`
    Use,
    /// `abstract class A is B as b { … }`
    Class,
    /// `B as b`
    Superclass,
    /// `modify Line { … }`
    Modify,
    /// `x, y: Length in 0..9 = 3 { … }`, `length: Length => …`
    Part,
    /// `in 0..9`
    Domain,
    /// `p1.x = 3`, `ring = Circle(…)`
    Assign,
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
    /// `scaled(by k: Real): Rectangle => e`
    Message,
    /// `(by k: Real)`
    ParamList,
    /// `by k: Real in 0..1 = 3 "prompt"`
    Param,
    /// `without a, b.c`
    Without,
    /// `replace level: rule`
    Replace,
    /// `when c { methods }`
    When,
    /// `ref a: C -> document path`
    Ref,
    /// `attachers p1, p2`
    Attachers,
    /// `view "Force" => e`
    View,
    /// `side lower: right`
    Side,
    /// `toolbox "Mechanics" { Spring, Beam }`
    Toolbox,
    /// `List of 12 C`, `geometry.Line`
    Type,
    /// `geometry.parts`
    DottedName,
}

impl UnitLine {
    /// Returns the unit as it is written, without blanks: `mm`, `m/s`.
    pub fn unit(&self) -> String {
        self.syntax
            .children_with_tokens()
            .filter_map(SyntaxElement::into_token)
            .filter(|t| matches!(t.kind(), SyntaxKind::Ident | SyntaxKind::Slash))
            .map(|t| t.text().to_owned())
            .collect()
    }
}
impl YLine {
    /// Returns true for `y down`.
    pub fn is_down(&self) -> bool {
        has_keyword(&self.syntax, "down")
    }
}
impl Use {
    /// Returns the name of the library or file.
    pub fn path(&self) -> Option<DottedName> {
        child(&self.syntax)
    }
}
impl DottedName {
    /// Returns the names between the dots.
    pub fn segments(&self) -> impl Iterator<Item = Word> + use<> {
        words(&self.syntax, SyntaxKind::Ident)
    }
}

impl Class {
    /// Returns true for `abstract class`.
    pub fn is_abstract(&self) -> bool {
        has_keyword(&self.syntax, "abstract")
    }
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the superclasses, the primary one first.
    pub fn superclasses(&self) -> impl Iterator<Item = Superclass> + use<> {
        children(&self.syntax)
    }
    /// Returns the body.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}
impl Superclass {
    /// Returns the class.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns the name after `as`.
    pub fn alias(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
}
impl Modify {
    /// Returns the class whose parts are modified.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns what is added to it.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
}

impl Part {
    /// Returns the names: several share one class.
    pub fn names(&self) -> impl Iterator<Item = Word> + use<> {
        words(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the class.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns the range after `in`.
    pub fn domain(&self) -> Option<Expr> {
        child::<Domain>(&self.syntax)?.range()
    }
    /// Returns what follows `=`.
    pub fn value(&self) -> Option<Value> {
        child_after(&self.syntax, SyntaxKind::Eq)
    }
    /// Returns what follows `=>`: the part is virtual.
    pub fn definition(&self) -> Option<Expr> {
        child_after(&self.syntax, SyntaxKind::FatArrow)
    }
    /// Returns the body.
    pub fn body(&self) -> Option<Body> {
        child(&self.syntax)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}
impl Domain {
    /// Returns the range, or the list of choices.
    pub fn range(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl Assign {
    /// Returns the path that gets the value.
    pub fn target(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the value.
    pub fn value(&self) -> Option<Value> {
        child_after(&self.syntax, SyntaxKind::Eq)
    }
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

impl Message {
    /// Returns true for a message marked `default`.
    pub fn is_default(&self) -> bool {
        has_keyword(&self.syntax, "default")
    }
    /// Returns true for a message marked `combining`.
    pub fn is_combining(&self) -> bool {
        has_keyword(&self.syntax, "combining")
    }
    /// Returns true for a message marked `builtin`.
    pub fn is_builtin(&self) -> bool {
        has_keyword(&self.syntax, "builtin")
    }
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the parameters.
    pub fn params(&self) -> Option<ParamList> {
        child(&self.syntax)
    }
    /// Returns the class of the answer, where it is written.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns what follows `=>`.
    pub fn definition(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}
impl ParamList {
    /// Returns the parameters.
    pub fn params(&self) -> impl Iterator<Item = Param> + use<> {
        children(&self.syntax)
    }
}
impl Param {
    /// Returns the name inside: the last one before the colon.
    pub fn name(&self) -> Option<Word> {
        words(&self.syntax, SyntaxKind::Ident).last()
    }
    /// Returns the name that an argument is labelled with; the same as inside where only one is written.
    pub fn label(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the class.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns the range after `in`.
    pub fn domain(&self) -> Option<Expr> {
        child::<Domain>(&self.syntax)?.range()
    }
    /// Returns the example after `=`.
    pub fn value(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the prompt, quoted.
    pub fn prompt(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}

impl Ref {
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns the class.
    pub fn class(&self) -> Option<Type> {
        child(&self.syntax)
    }
    /// Returns true for a path that begins at the document.
    pub fn is_absolute(&self) -> bool {
        has_keyword(&self.syntax, "document")
    }
    /// Returns the path of what is referred to.
    pub fn target(&self) -> Option<Expr> {
        child(&self.syntax)
    }
}
impl Attachers {
    /// Returns the parts that stick, in the order in which they are placed.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl View {
    /// Returns the name, quoted.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
    /// Returns what it shows.
    pub fn definition(&self) -> Option<Expr> {
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
impl Toolbox {
    /// Returns the name, quoted.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Text)
    }
    /// Returns the classes in it.
    pub fn classes(&self) -> impl Iterator<Item = DottedName> + use<> {
        children(&self.syntax)
    }
}

/// How a class is made of another one.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum TypeShape {
    /// `geometry.Line`: the names between the dots.
    Named(Vec<Word>),
    /// `List of 12 C`
    List {
        /// The number of elements, where it is written.
        count: Option<Expr>,
        /// The class of the elements.
        element: Option<Type>,
    },
    /// `Set of C`
    Set(Option<Type>),
    /// `Path to C`
    Path(Option<Type>),
    /// `Placed of C`
    Placed(Option<Type>),
}
impl Type {
    /// Returns how the class is made.
    pub fn shape(&self) -> TypeShape {
        let element = child(&self.syntax);
        match word(&self.syntax, SyntaxKind::Keyword).as_ref().map(Word::text) {
            Some("List") => TypeShape::List { count: child(&self.syntax), element },
            Some("Set") => TypeShape::Set(element),
            Some("Path") => TypeShape::Path(element),
            Some("Placed") => TypeShape::Placed(element),
            _ => TypeShape::Named(words(&self.syntax, SyntaxKind::Ident).collect()),
        }
    }
}
