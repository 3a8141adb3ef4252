//! Kinds: what an expression is worth, as far as the text alone tells.

use expr::dimension::Dimension;
use kernel::{ClassId, ClassKind, Document, Primitive};

/// What an expression is worth. `Unknown` never complains.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Kind {
    /// A number; without a dimension it takes the one that the context wants.
    Number(Option<Dimension>),
    /// A truth value.
    Bool,
    /// A text or a colour.
    Text,
    /// A thing of a class with parts.
    Thing(ClassId),
    /// A list or set.
    List(Box<Kind>),
    /// `(a, b)`: a thing of whatever class the context wants.
    Tuple,
    /// A picture.
    Picture,
    /// A function.
    Function,
    /// Not known.
    Unknown,
}

impl Kind {
    pub(crate) const PLAIN: Self = Self::Number(Some(Dimension::NONE));

    /// Returns what things of a class are worth.
    pub(crate) fn of_class(document: &Document, class: ClassId) -> Self {
        match document.classes[class].kind {
            ClassKind::Primitive(Primitive::Real(d)) => Self::Number(Some(d)),
            ClassKind::Primitive(Primitive::Integer) => Self::PLAIN,
            ClassKind::Primitive(Primitive::Bool) => Self::Bool,
            ClassKind::Primitive(Primitive::Text | Primitive::Color) => Self::Text,
            ClassKind::Composite => Self::Thing(class),
            ClassKind::List(element) | ClassKind::Set(element) => {
                Self::List(Box::new(Self::of_class(document, element)))
            }
            ClassKind::Reference(to) => Self::of_class(document, to),
        }
    }

    /// Returns the kind in words.
    pub(crate) fn words(&self, document: &Document) -> String {
        match self {
            Self::Number(None) => "a number".into(),
            Self::Number(Some(d)) if d.is_none() => "a plain number".into(),
            Self::Number(Some(d)) => match d.named() {
                Some(name) => format!("{name} ({d})"),
                None => format!("{d}"),
            },
            Self::Bool => "a truth value".into(),
            Self::Text => "a text".into(),
            Self::Thing(class) => format!("a {}", document.classes[*class].name),
            Self::List(_) => "a list".into(),
            Self::Tuple => "a tuple".into(),
            Self::Picture => "a picture".into(),
            Self::Function => "a function".into(),
            Self::Unknown => "something".into(),
        }
    }

    /// Returns true if a value of this kind can stand where `wanted` is.
    pub(crate) fn fits(&self, wanted: &Self) -> bool {
        match (self, wanted) {
            (Self::Unknown, _) | (_, Self::Unknown) => true,
            (Self::Number(a), Self::Number(b)) => a.is_none() || b.is_none() || a == b,
            (Self::Tuple, Self::Thing(_) | Self::List(_) | Self::Tuple) => true,
            (Self::Thing(_), Self::Thing(_) | Self::Tuple) => true,
            (Self::List(a), Self::List(b)) => a.fits(b),
            (Self::List(_), Self::Tuple) => true,
            _ => self == wanted,
        }
    }
}
