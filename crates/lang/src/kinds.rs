//! Kinds: what an expression is worth, as far as the text alone tells.

use crate::names::class_of_part;
use expr::dimension::Dimension;
use kernel::builtin::Kind as Builtin;
use kernel::quantity::from_bare;
use kernel::{Argument, BinaryOperator, ClassId, ClassKind, Document, Primitive, Term};

/// What an expression is worth. `Unknown` never complains.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Kind {
    /// A number; without a dimension it is made of bare numbers, and takes the one that is wanted.
    Number(Option<Dimension>),
    /// A truth value.
    Bool,
    /// An option of a choice.
    Option(ClassId),
    /// A text.
    Text,
    /// A colour: a text that has components.
    Color,
    /// A thing of a class with parts.
    Thing(ClassId),
    /// A list or set.
    List(Box<Kind>),
    /// `(a, b)`: a thing of whatever class the context wants.
    Tuple(Vec<Kind>),
    /// A picture.
    Picture,
    /// A function.
    Function,
    /// Not known.
    Unknown,
}

impl Kind {
    pub(crate) const PLAIN: Self = Self::Number(Some(Dimension::NONE));
    pub(crate) const LENGTH: Self = Self::Number(Some(Dimension::LENGTH));

    /// Returns what things of a class are worth.
    pub(crate) fn of_class(document: &Document, class: ClassId) -> Self {
        match document.classes[class].kind {
            ClassKind::Primitive(Primitive::Real(d)) => Self::Number(Some(d)),
            ClassKind::Primitive(Primitive::Integer) => Self::PLAIN,
            ClassKind::Primitive(Primitive::Bool) => Self::Bool,
            ClassKind::Primitive(Primitive::Choice(of)) => Self::Option(of),
            ClassKind::Primitive(Primitive::Text) => Self::Text,
            ClassKind::Primitive(Primitive::Color) => Self::Color,
            ClassKind::Composite => Self::Thing(class),
            ClassKind::List(element) | ClassKind::Set(element) => {
                Self::List(Box::new(Self::of_class(document, element)))
            }
            ClassKind::Reference(to) => Self::of_class(document, to),
        }
    }

    /// Returns the kind of lists of lists of these, so deep.
    pub(crate) fn listed(self, depth: usize) -> Self {
        (0..depth).fold(self, |kind, _| Self::List(Box::new(kind)))
    }

    /// Returns the kind of what lists of lists hold in the end; of anything else, the kind itself.
    pub(crate) fn inmost(&self) -> &Self {
        match self {
            Self::List(each) => each.inmost(),
            known => known,
        }
    }

    /// Returns the kind in words.
    pub(crate) fn words(&self, document: &Document) -> String {
        match self {
            Self::Number(None) => "a number".into(),
            Self::Number(Some(d)) if d.is_none() => "a plain number".into(),
            Self::Number(Some(d)) => dimension_in_words(*d),
            Self::Bool => "a truth value".into(),
            Self::Text => "a text".into(),
            Self::Color => "a colour".into(),
            Self::Thing(class) | Self::Option(class) => {
                let class = &document.classes[*class];
                // what a body adds to makes a class of one, which nobody has named
                let of_one = class.is_of_one.then(|| class.supers.first()).flatten();
                let named = of_one.map_or(&class.name, |s| &document.classes[s.class].name);
                with_article(named)
            }
            Self::List(element) if **element == Self::Unknown => "a list".into(),
            Self::List(element) => format!("a list of {}", element.several(document)),
            Self::Tuple(items) => {
                let items: Vec<String> = items.iter().map(|i| i.words(document)).collect();
                format!("({})", items.join(", "))
            }
            Self::Picture => "a picture".into(),
            Self::Function => "a function".into(),
            Self::Unknown => "something".into(),
        }
    }

    /// Returns in words what a list of this kind holds.
    fn several(&self, document: &Document) -> String {
        let one = self.words(document);
        let (article, rest) = one.split_once(' ').unwrap_or(("", &one));
        match self {
            Self::Thing(_) | Self::Option(_) => rest.into(),
            Self::Number(_) | Self::List(_) if article == "a" => match rest.split_once(" of ") {
                Some((list, of)) => format!("{list}s of {of}"),
                None => format!("{rest}s"),
            },
            Self::Number(_) | Self::List(_) | Self::Tuple(_) | Self::Unknown => one,
            Self::Bool | Self::Text | Self::Color | Self::Picture | Self::Function => {
                format!("{rest}s")
            }
        }
    }

    /// Returns true if a value of this kind can stand where `wanted` is.
    pub(crate) fn fits(&self, wanted: &Self, document: &Document) -> bool {
        match (self, wanted) {
            (Self::Unknown, _) | (_, Self::Unknown) => true,
            (Self::Text, Self::Color) | (Self::Color, Self::Text) => true,
            (Self::Number(a), Self::Number(b)) => a.is_none() || b.is_none() || a == b,
            (Self::Tuple(items), Self::Thing(class)) | (Self::Thing(class), Self::Tuple(items)) => {
                let fields = fields(document, *class);
                fields.len() == items.len()
                    && items.iter().zip(&fields).all(|(item, field)| item.fits(field, document))
            }
            (Self::Tuple(a), Self::Tuple(b)) => {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.fits(b, document))
            }
            (Self::Tuple(items), Self::List(element))
            | (Self::List(element), Self::Tuple(items)) => {
                items.iter().all(|item| item.fits(element, document))
            }
            (Self::Thing(a), Self::Thing(b)) => {
                let may_be_disc = || document.classes[*b].is_abstract && is_disc(document, *a);
                let may_cover = || is_drawn(document, *a) || may_be_disc();
                are_alike(document, *a, *b) || covers(document, *b) && may_cover()
            }
            (Self::List(element), Self::Thing(class)) if covers(document, *class) => {
                element.fits(wanted, document)
            }
            (Self::List(a), Self::List(b)) => a.fits(b, document),
            _ => self == wanted,
        }
    }

    /// Returns what a message answers to a thing of a class: what is said to be an Object is a thing of
    /// that class again.
    pub(crate) fn for_receiver(self, receiver: ClassId, object: ClassId) -> Self {
        match self {
            Self::Thing(class) if class == object => Self::Thing(receiver),
            known => known,
        }
    }

    /// Returns what is known of two values that fit: of bare numbers, what the other measures; of a colour and a text, that
    /// it is a colour.
    pub(crate) fn joined(self, other: Self) -> Self {
        match self {
            Self::Number(None) | Self::Unknown => other,
            Self::Text if other == Self::Color => other,
            known => known,
        }
    }

    /// Returns true if a value can be what a function of the language wants.
    pub(crate) fn is(&self, wanted: Builtin, first: &Self, document: &Document) -> bool {
        match (wanted, self) {
            (_, Self::Unknown) | (Builtin::Any | Builtin::Element | Builtin::Answer, _) => true,
            (Builtin::Plain, _) => self.fits(&Self::PLAIN, document),
            (Builtin::Number | Builtin::Root, _) => matches!(self, Self::Number(_)),
            (Builtin::Same, _) => matches!(self, Self::Number(_)) && self.fits(first, document),
            (Builtin::Length, _) => self.fits(&Self::LENGTH, document),
            (Builtin::Bool, _) => *self == Self::Bool,
            (Builtin::Text | Builtin::Color, _) => matches!(self, Self::Text | Self::Color),
            (Builtin::Place, Self::Thing(class)) => ["x", "y"].iter().all(|name| {
                let part = class_of_part(document, *class, name);
                part.is_some() || document.find_message(*class, name, None).is_some()
            }),
            (Builtin::Place, Self::Tuple(items)) => {
                items.len() >= 2 && items.iter().all(|i| i.fits(&Self::LENGTH, document))
            }
            (Builtin::Place, _) => false,
            (Builtin::List | Builtin::Beside, _) => {
                matches!(self, Self::List(_) | Self::Tuple(_))
            }
            (Builtin::Plains, Self::List(element)) => element.is(Builtin::Plain, first, document),
            (Builtin::Plains, Self::Tuple(items)) => {
                items.iter().all(|item| item.is(Builtin::Plain, first, document))
            }
            (Builtin::Plains, _) => false,
            (Builtin::Texts, Self::List(element)) => element.is(Builtin::Text, first, document),
            (Builtin::Texts, Self::Tuple(items)) => {
                items.iter().all(|item| item.is(Builtin::Text, first, document))
            }
            (Builtin::Texts, _) => false,
            (Builtin::Measures, Self::List(element)) => {
                element.is(Builtin::Number, first, document)
            }
            (Builtin::Ordered, Self::List(element)) => {
                let is = |wanted| element.is(wanted, first, document);
                is(Builtin::Number) || is(Builtin::Text)
            }
            (Builtin::Measures | Builtin::Ordered, _) => false,
            // lines and circles are together in a set, and which one each is is known when it is looked at
            (Builtin::Alike, Self::List(element)) => {
                let is_thing = |kind: &Self| matches!(kind.inmost(), Self::Thing(_));
                element.fits(first, document) || is_thing(element) && is_thing(first)
            }
            (Builtin::Alike, _) => self.is(Builtin::List, first, document),
            (Builtin::Numbers, Self::List(element)) => element.is(Builtin::Same, first, document),
            (Builtin::Numbers, _) => self.is(Builtin::Same, first, document),
            (Builtin::Function | Builtin::Test, _) => *self == Self::Function,
            (Builtin::Picture, _) => *self == Self::Picture,
            (Builtin::Pictures, Self::List(element)) => element.is(wanted, first, document),
            (Builtin::Pictures, _) => matches!(self, Self::Picture | Self::Thing(_)),
        }
    }
}

/// Returns a noun with its article.
pub fn with_article(noun: &str) -> String {
    match noun.starts_with(['A', 'E', 'I', 'O', 'U', 'a', 'e', 'i', 'o', 'u']) {
        true => format!("an {noun}"),
        false => format!("a {noun}"),
    }
}

/// Returns what a function of the language wants, in words.
#[cold]
#[inline(never)]
pub(crate) fn wanted_in_words(wanted: Builtin, first: &Kind, document: &Document) -> String {
    match wanted {
        Builtin::Plain => "a plain number".into(),
        Builtin::Number | Builtin::Root => "a number".into(),
        Builtin::Same | Builtin::Numbers if *first == Kind::Unknown => "a number".into(),
        Builtin::Same | Builtin::Numbers => first.words(document),
        Builtin::Length => dimension_in_words(Dimension::LENGTH),
        Builtin::Bool => "a truth value".into(),
        Builtin::Text => "a text".into(),
        Builtin::Color => "a colour, a text".into(),
        Builtin::Place => "a place, (x, y)".into(),
        Builtin::List | Builtin::Beside => "a list".into(),
        Builtin::Plains => "a list of plain numbers".into(),
        Builtin::Texts => "a list of texts".into(),
        Builtin::Measures => "a list of numbers".into(),
        Builtin::Ordered => "a list of numbers or texts".into(),
        Builtin::Alike => Kind::List(Box::new(first.clone())).words(document),
        Builtin::Function => "a function, `x => …`".into(),
        Builtin::Test => "a function of a truth value, `x => x > 0`".into(),
        Builtin::Picture | Builtin::Pictures => "a picture".into(),
        Builtin::Element | Builtin::Answer | Builtin::Any => "something".into(),
    }
}

/// Says what a dimension is: its name with its unit, or the base units alone.
pub(crate) fn dimension_in_words(dimension: Dimension) -> String {
    let unit = expr::units::preferred(dimension);
    let unit = unit.map_or_else(|| dimension.to_string(), str::to_string);
    match dimension.named() {
        Some(name) => format!("{name} ({unit})"),
        None => unit,
    }
}

/// Returns what the parts of a class's things are worth.
pub(crate) fn fields(document: &Document, class: ClassId) -> Vec<Kind> {
    let layout = document.layout(class);
    layout.iter().map(|&f| Kind::of_class(document, document.field_class(f))).collect()
}

/// Returns true if things of two classes can be compared: they have parts from a common ancestor.
fn are_alike(document: &Document, a: ClassId, b: ClassId) -> bool {
    let above = document.lineage(b);
    let shares = |&c: &ClassId| above.contains(&c) && !document.layout(c).is_empty();
    above.contains(&a) || document.is_a(a, b) || document.lineage(a).iter().any(shares)
}

/// Gives the bare numbers of a value the dimension that is wanted of it.
pub(crate) fn measured(document: &Document, term: Term, kind: &Kind, wanted: &Kind) -> Term {
    match (term, kind, wanted) {
        (Term::Number { value, bare, .. }, Kind::Number(None), Kind::Number(Some(d))) => {
            Term::Number { value: from_bare(document, value, *d), dimension: *d, bare }
        }
        (term, Kind::Number(None), Kind::Number(Some(d))) => {
            let scale = from_bare(document, 1.0, *d);
            if scale == 1.0 {
                return term;
            }
            let unit = Term::Number { value: scale, dimension: *d, bare: false };
            Term::Binary(BinaryOperator::Multiply, Box::new(term), Box::new(unit))
        }
        (Term::Tuple(items), Kind::Tuple(kinds), Kind::Thing(class)) => {
            let fields = fields(document, *class);
            let each = items.into_iter().zip(kinds).enumerate();
            let measure = |(i, (item, kind)): (usize, (Term, &Kind))| match fields.get(i) {
                Some(field) => measured(document, item, kind, field),
                None => item,
            };
            Term::Tuple(each.map(measure).collect())
        }
        (Term::List(items), Kind::List(kind), Kind::List(wanted)) => {
            let measure = |item| measured(document, item, kind, wanted);
            Term::List(items.into_iter().map(measure).collect())
        }
        (term, _, _) => term,
    }
}

/// Makes a tuple the thing of a class that is wanted, and those in it; a list of tuples a list of these.
pub(crate) fn made(document: &Document, term: Term, wanted: &Kind) -> Term {
    match (term, wanted) {
        (Term::Tuple(items), Kind::Thing(class)) if !document.classes[*class].is_abstract => {
            let each = items.into_iter().zip(fields(document, *class));
            let each = each.map(|(item, field)| made(document, item, &field));
            let arguments = each.map(|value| Argument { label: None, value }).collect();
            Term::Make { class: *class, arguments }
        }
        (Term::List(items), Kind::List(wanted)) => {
            Term::List(items.into_iter().map(|item| made(document, item, wanted)).collect())
        }
        (term, _) => term,
    }
}

/// Returns true for a class whose things cover a part of the plane: several cover one together.
fn covers(document: &Document, class: ClassId) -> bool {
    document.find_message(class, "covered", None).is_some()
}

/// Returns true for what covers a part of the plane beside a circle, in whichever order.
pub(crate) fn cover_together(document: &Document, a: ClassId, b: ClassId) -> bool {
    let is_one = |a, b| covers(document, a) && is_disc(document, b);
    is_one(a, b) || is_one(b, a)
}

/// Returns true for circles: one covers its disc.
fn is_disc(document: &Document, class: ClassId) -> bool {
    document.class_named("Circle").is_some_and(|circle| document.is_a(class, circle))
}

/// Returns true for a program, and for the turns of a block of one: what they draw may cover something.
fn is_drawn(document: &Document, class: ClassId) -> bool {
    let class = &document.classes[class];
    class.program.is_some() || class.messages.iter().any(|m| matches!(*m.answer, Term::Step(_)))
}
