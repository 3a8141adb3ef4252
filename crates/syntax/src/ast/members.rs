//! Members of a class or a thing.

use super::{
    Body, Expr, Value, Word, ast_nodes, child, child_after, children, doc_comment, has_keyword,
    word, words,
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
    /// `scaled(by k: Real): Rectangle => e`
    Message,
    /// `(by k: Real)`
    ParamList,
    /// `by k: Real in 0..1 = 3 "prompt"`
    Param,
    /// `ref a: C -> document path`
    Ref,
    /// `attachers p1, p2`
    Attachers,
    /// `handle far keeps corner`
    Handle,
    /// `view "Force" => e`
    View,
    /// `toolbox "Mechanics" { Spring, Beam }`
    Toolbox,
    /// `choice Fit { loose, normal, close }`
    Choice,
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
    /// Returns true for `constant x: C = value`: it never yields.
    pub fn is_constant(&self) -> bool {
        has_keyword(&self.syntax, "constant")
    }
    /// Returns the names: several share one class.
    pub fn names(&self) -> impl Iterator<Item = Word> + use<> {
        words(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns true for a part that only says where a thing is drawn.
    pub fn is_layout(&self) -> bool {
        has_keyword(&self.syntax, "layout")
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
    /// Returns true for a step that is drawn for construction alone.
    pub fn is_guide(&self) -> bool {
        has_keyword(&self.syntax, "guide")
    }
    /// Returns the path that gets the value.
    pub fn target(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the value.
    pub fn value(&self) -> Option<Value> {
        child_after(&self.syntax, SyntaxKind::Eq)
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
    /// Returns true for a message marked `replacing`.
    pub fn is_replacing(&self) -> bool {
        has_keyword(&self.syntax, "replacing")
    }
    /// Returns true for a message to the class itself, marked `static`.
    pub fn is_static(&self) -> bool {
        has_keyword(&self.syntax, "static")
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
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
    }
}
impl Attachers {
    /// Returns the parts that stick, in the order in which they are placed.
    pub fn paths(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax)
    }
}
impl Handle {
    /// Returns the place that is dragged.
    pub fn place(&self) -> Option<Expr> {
        child(&self.syntax)
    }
    /// Returns the places that stay meanwhile.
    pub fn kept(&self) -> impl Iterator<Item = Expr> + use<> {
        children(&self.syntax).skip(1)
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

impl Choice {
    /// Returns the name.
    pub fn name(&self) -> Option<Word> {
        word(&self.syntax, SyntaxKind::Ident)
    }
    /// Returns what there is to choose, in order.
    pub fn options(&self) -> impl Iterator<Item = Word> + use<> {
        words(&self.syntax, SyntaxKind::Ident).skip(1)
    }
    /// Returns the doc comment.
    pub fn doc(&self) -> Option<String> {
        doc_comment(&self.syntax)
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
