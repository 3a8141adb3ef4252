//! Terms: the language's expressions as data, names resolved as far as the text alone allows.
//!
//! A term is read in a class, for a thing of it: `Me` is that thing. `plan` lowers terms to
//! equations over slots; `eval` computes their values. Neither sees text.

use crate::builtin::Making;
use crate::class::ClassId;
use crate::path::{Path, Step};
use base::Name;
use expr::dimension::Dimension;

base::define_id!(OriginId, "o", "Where a member was written: `lang` keeps the table of places.");

/// An expression of the language.
#[derive(Clone, PartialEq, Debug)]
pub enum Term {
    /// A number in the document's base units, with its dimension.
    ///
    /// `bare` numbers (written without a unit) take the dimension that the context wants.
    Number {
        /// The value in base units.
        value: f64,
        /// What it measures.
        dimension: Dimension,
        /// True if no unit was written.
        bare: bool,
    },
    /// A text.
    Text(String),
    /// A truth value.
    Bool(bool),
    /// An option of a choice, by its place among them.
    Option(ClassId, u32),
    /// The thing that the expression belongs to.
    Me,
    /// The thing that `Me` is a part of.
    Owner,
    /// The document itself, for absolute references.
    Document,
    /// A `let` binding, a lambda's or a message's parameter.
    Local(Name),
    /// A part of a thing, or the answer to a message: `a.b`, `a.scaled(by: 2)`.
    ///
    /// `search` is set by `super.name`, and by `t.name` where `t` is the primary superclass.
    Send {
        /// The receiver.
        to: Box<Term>,
        /// The name of the part or message.
        name: Name,
        /// The arguments; none for a part.
        arguments: Vec<Argument>,
        /// Where its definition is looked for, if not in the class of the receiver.
        search: Option<Search>,
    },
    /// A class, as the receiver of a message to the class itself: `Circle.tangent(a, b, radius: r)`.
    Class(ClassId),
    /// A construction of oriented geometry, or of regions: what a `static builtin` message answers.
    Construct {
        /// Which one.
        what: Making,
        /// The class of what it makes.
        class: ClassId,
        /// What it is made of, in the order of the message's parameters.
        of: Vec<Term>,
    },
    /// A function of the language: `sqrt(x)`, `segment(p, q)`.
    Call {
        /// The name of the function.
        name: Name,
        /// The arguments.
        arguments: Vec<Argument>,
    },
    /// A new thing: `Point(1, 2)`, `Point(x: 1, y: 2)`.
    Make {
        /// Its class.
        class: ClassId,
        /// Its stored parts, by position (inherited first) or by name.
        arguments: Vec<Argument>,
    },
    /// `(a, b)`: a thing of whatever class the context wants, by position.
    Tuple(Vec<Term>),
    /// `[a, b, c]`.
    List(Vec<Term>),
    /// `a..b`, both ends included.
    Range(Box<Term>, Box<Term>),
    /// An element of a list, counted from 0.
    Index(Box<Term>, Box<Term>),
    /// `-a`, `not a`.
    Unary(UnaryOperator, Box<Term>),
    /// `a + b`, `a <= b`, `a and b`; a chain of comparisons is a conjunction of these.
    Binary(BinaryOperator, Box<Term>, Box<Term>),
    /// `if c then a else b`.
    If(Box<Term>, Box<Term>, Box<Term>),
    /// `let a = e in g`.
    Let(Name, Box<Term>, Box<Term>),
    /// `x => e`, `(x, y) => e`.
    Lambda(Vec<Name>, Box<Term>),
    /// `x is C`.
    IsA(Box<Term>, ClassId),
    /// `all C`.
    All(ClassId),
    /// `copy of x`.
    Copy(Box<Term>),
    /// What a step of the program of `Me` made.
    Step(Name),
    /// Everything that the program of `Me` drew: its result.
    Result,
    /// `level.error`: what is asked of a constraint of a thing.
    OfConstraint {
        /// The thing that has the constraint.
        of: Box<Term>,
        /// The constraint's name.
        name: Name,
        /// What is asked.
        aspect: Aspect,
    },
}

/// Where the definition of a message is looked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Search {
    /// Above a class of the receiver: `super.name`.
    Above(ClassId),
    /// As if the receiver were no more than a thing of this class, one of its primary superclasses.
    As(ClassId),
}

impl Search {
    /// Returns the same, said in another class.
    fn with_above(self, from: ClassId, to: ClassId) -> Self {
        match self {
            Self::Above(class) if class == from => Self::Above(to),
            other => other,
        }
    }
}

/// What can be asked of a constraint.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Aspect {
    /// The left side less the right one.
    Error,
    /// Whether its rule holds.
    Satisfied,
    /// How strongly it wants to hold, in a word.
    Strength,
    /// Whether it is switched on.
    Enabled,
}

impl Aspect {
    /// Returns what is asked by this word.
    pub fn of_word(word: &str) -> Option<Self> {
        Some(match word {
            "error" => Self::Error,
            "satisfied" => Self::Satisfied,
            "strength" => Self::Strength,
            "enabled" => Self::Enabled,
            _ => return None,
        })
    }
}

impl Term {
    /// Returns true for a plain number with a unit: a percentage, which is a part of something.
    pub fn is_part(&self) -> bool {
        matches!(self, Self::Number { dimension, bare: false, .. } if *dimension == Dimension::NONE)
    }
    /// Returns the term with `super` searching above one class instead of another.
    #[must_use]
    pub fn with_above(&self, from: ClassId, to: ClassId) -> Self {
        let one = |t: &Self| t.with_above(from, to);
        let boxed = |t: &Self| Box::new(one(t));
        let all = |terms: &[Self]| terms.iter().map(one).collect();
        let arguments = |arguments: &[Argument]| {
            let argument = |a: &Argument| Argument { label: a.label.clone(), value: one(&a.value) };
            arguments.iter().map(argument).collect()
        };
        match self {
            Self::Number { .. }
            | Self::Text(_)
            | Self::Bool(_)
            | Self::Option(..)
            | Self::Me
            | Self::Owner
            | Self::Document
            | Self::Local(_)
            | Self::Step(_)
            | Self::Result
            | Self::Class(_)
            | Self::All(_) => self.clone(),
            Self::Construct { what, class, of } => {
                Self::Construct { what: *what, class: *class, of: all(of) }
            }
            Self::Send { to: receiver, name, arguments: a, search } => Self::Send {
                to: boxed(receiver),
                name: name.clone(),
                arguments: arguments(a),
                search: search.map(|s| s.with_above(from, to)),
            },
            Self::Call { name, arguments: a } => {
                Self::Call { name: name.clone(), arguments: arguments(a) }
            }
            Self::Make { class, arguments: a } => {
                Self::Make { class: *class, arguments: arguments(a) }
            }
            Self::Tuple(terms) => Self::Tuple(all(terms)),
            Self::List(terms) => Self::List(all(terms)),
            Self::Range(a, b) => Self::Range(boxed(a), boxed(b)),
            Self::Index(a, b) => Self::Index(boxed(a), boxed(b)),
            Self::Unary(op, a) => Self::Unary(*op, boxed(a)),
            Self::Binary(op, a, b) => Self::Binary(*op, boxed(a), boxed(b)),
            Self::If(a, b, c) => Self::If(boxed(a), boxed(b), boxed(c)),
            Self::Let(name, a, b) => Self::Let(name.clone(), boxed(a), boxed(b)),
            Self::Lambda(names, a) => Self::Lambda(names.clone(), boxed(a)),
            Self::IsA(a, class) => Self::IsA(boxed(a), *class),
            Self::Copy(a) => Self::Copy(boxed(a)),
            Self::OfConstraint { of, name, aspect } => {
                Self::OfConstraint { of: boxed(of), name: name.clone(), aspect: *aspect }
            }
        }
    }
}

/// An argument of a message, function or constructor.
#[derive(Clone, PartialEq, Debug)]
pub struct Argument {
    /// The label, where one was written.
    pub label: Option<Name>,
    /// The value.
    pub value: Term,
}

/// An operator with one operand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum UnaryOperator {
    /// `-a`
    Negate,
    /// `not a`
    Not,
}

/// An operator with two operands.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum BinaryOperator {
    /// `a + b`; texts are joined
    Add,
    /// `a - b`
    Subtract,
    /// `a * b`
    Multiply,
    /// `a / b`
    Divide,
    /// `a mod b`: what is left of a, with the sign of b
    Remainder,
    /// `a ^ b`
    Power,
    /// `a = b`
    Equal,
    /// `a != b`
    NotEqual,
    /// `a < b`
    Less,
    /// `a <= b`
    LessEqual,
    /// `a > b`
    Greater,
    /// `a >= b`
    GreaterEqual,
    /// `a and b`
    And,
    /// `a or b`
    Or,
    /// `a in s`
    In,
}

impl BinaryOperator {
    /// Returns true for `<` and its like.
    pub fn is_order(self) -> bool {
        matches!(self, Self::Less | Self::LessEqual | Self::Greater | Self::GreaterEqual)
    }
    /// Returns true for `=`, `<` and their like.
    pub fn is_comparison(self) -> bool {
        self.is_order() || matches!(self, Self::Equal | Self::NotEqual)
    }
}

impl Term {
    /// Returns the terms that it is directly made of, in order.
    pub fn operands(&self) -> Vec<&Self> {
        match self {
            Self::Number { .. }
            | Self::Text(_)
            | Self::Bool(_)
            | Self::Option(..)
            | Self::Me
            | Self::Owner
            | Self::Document
            | Self::Local(_)
            | Self::Step(_)
            | Self::Result
            | Self::Class(_)
            | Self::All(_) => Vec::new(),
            Self::Send { to, arguments, .. } => {
                std::iter::once(&**to).chain(arguments.iter().map(|a| &a.value)).collect()
            }
            Self::Call { arguments, .. } | Self::Make { arguments, .. } => {
                arguments.iter().map(|a| &a.value).collect()
            }
            Self::Tuple(terms) | Self::List(terms) | Self::Construct { of: terms, .. } => {
                terms.iter().collect()
            }
            Self::Range(a, b) | Self::Index(a, b) | Self::Binary(_, a, b) | Self::Let(_, a, b) => {
                vec![a, b]
            }
            Self::If(a, b, c) => vec![a, b, c],
            Self::Unary(_, a)
            | Self::Lambda(_, a)
            | Self::IsA(a, _)
            | Self::Copy(a)
            | Self::OfConstraint { of: a, .. } => vec![a],
        }
    }
    /// Makes the term for a part of `Me`, step by step.
    pub fn part(names: &[&str]) -> Self {
        names.iter().fold(Self::Me, |to, name| Self::send(to, name))
    }
    /// Makes the term that reads what a path leads to from a thing.
    pub fn at(thing: Self, path: &Path) -> Self {
        path.0.iter().fold(thing, |to, step| match step {
            Step::Part(name) => Self::send(to, name),
            Step::Index(i) => Self::Index(Box::new(to), Box::new(Self::number(f64::from(*i)))),
            Step::Last => Self::send(to, "last"),
            Step::Owner if to == Self::Me => Self::Owner,
            Step::Owner => Self::send(to, "owner"),
        })
    }
    /// Returns the path that the term reads step by step from `Me`; messages without arguments are steps, too.
    pub fn path(&self) -> Option<Path> {
        match self {
            Self::Me => Some(Path::default()),
            Self::Owner => Some(Path(vec![Step::Owner])),
            Self::Send { to, name, arguments, search: None } if arguments.is_empty() => {
                let step = if *name == "owner" { Step::Owner } else { Step::Part(name.clone()) };
                Some(to.path()?.then(step))
            }
            Self::Index(of, at) => match **at {
                Self::Number { value, .. } => Some(of.path()?.then(Step::Index(value as u32))),
                _ => None,
            },
            _ => None,
        }
    }
    /// Makes the term that reads `name` of `to`.
    pub fn send(to: Self, name: &str) -> Self {
        Self::Send { to: Box::new(to), name: Name::new(name), arguments: Vec::new(), search: None }
    }
    /// Makes a bare number.
    pub fn number(value: f64) -> Self {
        Self::Number { value, dimension: Dimension::NONE, bare: true }
    }
}
