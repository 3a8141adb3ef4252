//! Classes: what the things of a kind have in common.

use crate::document::{PartRef, Side};
use crate::path::Path;
use crate::program::Program;
use crate::term::{OriginId, Term};
use base::Name;
use expr::dimension::Dimension;
use std::rc::Rc;

base::define_id!(ClassId, "c", "A class.");

/// What is stored in a slot.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Primitive {
    /// A real number of a dimension: `Real`, `Length`, `Voltage`, …
    Real(Dimension),
    /// A whole number.
    Integer,
    /// A truth value, stored as 0 or 1.
    Bool,
    /// One of the options of a class, stored as its place among them, from 0.
    Choice(ClassId),
    /// A text.
    Text,
    /// A colour, stored as its text: a name or `#rrggbb`.
    Color,
}

impl Primitive {
    /// Returns true if the slot holds a number (truth values and choices included).
    pub fn is_number(self) -> bool {
        match self {
            Self::Real(_) | Self::Integer | Self::Bool | Self::Choice(_) => true,
            Self::Text | Self::Color => false,
        }
    }
    /// Returns true if the slot holds whole numbers alone (truth values and choices included).
    pub fn is_whole(self) -> bool {
        match self {
            Self::Integer | Self::Bool | Self::Choice(_) => true,
            Self::Real(_) | Self::Text | Self::Color => false,
        }
    }
    /// Returns the dimension of its numbers; that of a plain number where it has none.
    pub fn dimension(self) -> Dimension {
        match self {
            Self::Real(dimension) => dimension,
            Self::Integer | Self::Bool | Self::Choice(_) | Self::Text | Self::Color => {
                Dimension::default()
            }
        }
    }
}

/// What kind of class it is.
#[derive(Clone, PartialEq, Debug)]
pub enum ClassKind {
    /// Its things have no parts of their own.
    Primitive(Primitive),
    /// Its things are made of named parts.
    Composite,
    /// `List of C`: its things are made of numbered parts.
    List(ClassId),
    /// `Set of C`: its things collect parts of others, by `insert … into`.
    Set(ClassId),
    /// `Path to C`, `ref`: its things name another.
    Reference(ClassId),
}

/// How strongly a constraint wants to hold.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Strength {
    /// Always.
    Required,
    /// Unless something required forbids it.
    Strong,
    /// Weaker than the wish of a drag.
    Medium,
    /// Weakest of those that are written.
    Weak,
}

impl Strength {
    /// Every strength, the strongest first.
    pub const ALL: [Self; 4] = [Self::Required, Self::Strong, Self::Medium, Self::Weak];
    /// Returns the word that is written for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Required => "required",
            Self::Strong => "strong",
            Self::Medium => "medium",
            Self::Weak => "weak",
        }
    }
}

/// A class: part descriptions, constraints, merges, messages.
#[derive(Clone, PartialEq, Debug)]
pub struct Class {
    /// Its name; for a class of one, the path of its thing; for the document, the document's title.
    pub name: Name,
    /// What `///` says of it.
    pub doc: String,
    /// What kind of class it is.
    pub kind: ClassKind,
    /// How many elements every list of the class has, where the class itself says so: one that is an
    /// element of another list.
    pub count: Option<u32>,
    /// What there is to choose, in order: `choice Fit { loose, normal, close }`. Empty for any other class.
    pub options: Vec<Name>,
    /// For lists whose elements are of different classes, the class of each.
    pub elements: Vec<ClassId>,
    /// The superclasses, the primary one first. Empty only for `Object`.
    pub supers: Vec<Superclass>,
    /// True for the class of a single thing, or of a part as its owner refines it: no text names it.
    pub is_of_one: bool,
    /// True for the things of a text that is used where nothing speaks of them: they are not shown, nor counted.
    pub is_unseen: bool,
    /// The class that it is, with other counts.
    pub general: Option<ClassId>,
    /// Its whole numbers that say how many elements its lists have or how often its loops run, and
    /// what they are. They are anchored.
    pub counts: Vec<(Name, i64)>,
    /// True if it has no instances of its own.
    pub is_abstract: bool,
    /// The stored parts that it adds, in order of declaration.
    pub parts: Vec<Part>,
    /// Given values of its parts and subparts, in order of declaration; later ones win.
    pub givens: Vec<Rc<Given>>,
    /// What its parts are connected with, as values: a thing that a constructor makes has these, for it has no merges.
    pub connections: Vec<Rc<Given>>,
    /// Messages and virtual parts.
    pub messages: Vec<Message>,
    /// The constraints that it adds.
    pub constraints: Vec<Constraint>,
    /// Which of these are bindings, in order of the constraints.
    pub bindings: Vec<Binding>,
    /// The merges that it adds.
    pub merges: Vec<Merge>,
    /// The set memberships that it adds.
    pub inserts: Vec<Insert>,
    /// Declared stays and anchors.
    pub stays: Vec<Stay>,
    /// Which way places and numbers of its things go from where two branches meet, in order.
    pub sides: Vec<Side>,
    /// Parts that stick to others when a thing of this class is placed, in order.
    pub attachers: Vec<Path>,
    /// Places of its things by which a hand changes them, in order.
    pub handles: Vec<Handle>,
    /// What it sets of constraints of its things and their parts, in order.
    pub switches: Vec<Switch>,
    /// Names of constraints and merges of the primary superclasses that do not apply here.
    pub without: Vec<Name>,
    /// Fields whose things are of a narrower class here than where they were declared: by a
    /// `modify` of this class or of one above it, or by a mask on a part's constraints.
    pub refined: Vec<(PartRef, ClassId)>,
    /// What its things draw, where it is a program.
    pub program: Option<Rc<Program>>,
    /// Where it was written.
    pub origin: OriginId,
}

impl Class {
    /// Makes a class that says nothing yet.
    pub fn new(name: Name, kind: ClassKind, supers: Vec<Superclass>, origin: OriginId) -> Self {
        Self {
            name,
            doc: String::new(),
            kind,
            count: None,
            options: Vec::new(),
            elements: Vec::new(),
            supers,
            is_of_one: false,
            is_unseen: false,
            general: None,
            counts: Vec::new(),
            is_abstract: false,
            parts: Vec::new(),
            givens: Vec::new(),
            connections: Vec::new(),
            messages: Vec::new(),
            constraints: Vec::new(),
            bindings: Vec::new(),
            merges: Vec::new(),
            inserts: Vec::new(),
            stays: Vec::new(),
            sides: Vec::new(),
            attachers: Vec::new(),
            handles: Vec::new(),
            switches: Vec::new(),
            without: Vec::new(),
            refined: Vec::new(),
            program: None,
            origin,
        }
    }
}

/// A place by which a hand changes things of a class: while it is dragged, others stay where they are.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Handle {
    /// The place that is dragged, stored or computed.
    pub place: Path,
    /// The places that stay meanwhile, if they can.
    pub keeps: Vec<Path>,
}

/// A superclass; all but the first are parts of the thing, reached by their name.
#[derive(Clone, PartialEq, Debug)]
pub struct Superclass {
    /// The class.
    pub class: ClassId,
    /// The name by which it is reached; empty for a class's only one, unless `as` names it.
    pub name: Name,
}

/// A part description.
#[derive(Clone, PartialEq, Debug)]
pub struct Part {
    /// Its name.
    pub name: Name,
    /// What `///` says of it.
    pub doc: String,
    /// The class of the part: a named class, a list class, or a class of one for a part with a body.
    pub class: ClassId,
    /// For lists, how many elements.
    pub count: Option<Count>,
    /// The values that an integer may take, both ends included.
    pub range: Option<(i64, i64)>,
    /// True if it only says where a thing is drawn: no degree of freedom of the thing.
    pub is_layout: bool,
    /// Where it was written.
    pub origin: OriginId,
}

/// How many elements a list has.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Count {
    /// As the class says: `List of 12 C`.
    Fixed(u32),
    /// As many as the given list has elements.
    Given,
}

/// A given value: `x = 3`, `p1.x = 3`, or a default of a part.
#[derive(Clone, PartialEq, Debug)]
pub struct Given {
    /// From a thing of the class to the part.
    pub path: Path,
    /// Its value, in terms of the thing whose class says so.
    pub value: Term,
    /// Where it was written (the value alone).
    pub origin: OriginId,
}

/// Returns the name that a message to a class itself has among its messages: its *form*, the word with the labels.
/// So a class and its things may answer to one word, and a class to several forms of it.
///
/// ```
/// assert_eq!(*kernel::form("parallel", ["to", "through"]), *"parallel(to,through)");
/// ```
pub fn form<'l>(word: &str, labels: impl IntoIterator<Item = &'l str>) -> Name {
    let labels: Vec<&str> = labels.into_iter().collect();
    Name::new(&format!("{word}({})", labels.join(",")))
}

/// A message: its answer is an expression. Without parameters it is a virtual part, which stands among the values
/// unless it is asked with parentheses.
#[derive(Clone, Debug)]
pub struct Message {
    /// Its name.
    pub name: Name,
    /// What `///` says of it.
    pub doc: String,
    /// The parameters, in order.
    pub parameters: Vec<Parameter>,
    /// The class of the answer, where one is written; of a message in a loop, that of an element.
    pub class: Option<ClassId>,
    /// The answer; shared, since texts that follow one another say most of what they said.
    pub answer: Rc<Term>,
    /// True if it was declared with parentheses, with or without parameters between them.
    pub is_asked: bool,
    /// True if it gives way to any other definition.
    pub is_default: bool,
    /// True if superclasses' answers are combined where the class has none of its own.
    pub is_combining: bool,
    /// True if what it makes takes the place of what it is sent to, where it is a step.
    pub is_replacing: bool,
    /// Where it was written.
    pub origin: OriginId,
}

impl PartialEq for Message {
    /// Answers are compared last, and where they are not shared: each edit asks it of all classes of all libraries.
    fn eq(&self, other: &Self) -> bool {
        let Self {
            name,
            doc,
            parameters,
            class,
            answer,
            is_asked,
            is_default,
            is_combining,
            is_replacing,
            origin,
        } = self;
        *name == other.name
            && *class == other.class
            && *is_asked == other.is_asked
            && *is_default == other.is_default
            && *is_combining == other.is_combining
            && *is_replacing == other.is_replacing
            && *origin == other.origin
            && *parameters == other.parameters
            && *doc == other.doc
            && (Rc::ptr_eq(answer, &other.answer) || *answer == other.answer)
    }
}

impl Message {
    /// Returns true for a message to the class itself: its name is its [`form`].
    pub fn is_of_class(&self) -> bool {
        self.name.ends_with(')')
    }
    /// Returns the word that is written for it.
    pub fn word(&self) -> &str {
        self.name.split('(').next().unwrap_or_default()
    }
}

/// A parameter of a message: `scaled(by k: Real)`.
#[derive(Clone, PartialEq, Debug)]
pub struct Parameter {
    /// The label at the call; the name where no other is written.
    pub label: Name,
    /// The name in the answer.
    pub name: Name,
    /// The class of the argument, where one is written.
    pub class: Option<ClassId>,
}

impl Parameter {
    /// Returns the labels that an argument may have: the one of calls, and the name inside.
    pub fn labels(&self) -> [&Name; 2] {
        [&self.label, &self.name]
    }
}

/// A constraint: a rule, a strength, and methods where they were written.
#[derive(Clone, PartialEq, Debug)]
pub struct Constraint {
    /// Its name, if it has one.
    pub name: Option<Name>,
    /// What `///` says of it.
    pub doc: Box<str>,
    /// What shall be true; shared as answers of messages are.
    pub rule: Rc<Term>,
    /// How strongly.
    pub strength: Strength,
    /// The written methods, in order of preference. A written list is complete unless `derived`.
    pub methods: Vec<Method>,
    /// True if methods are derived from the rule too (always so where none is written).
    pub derived: bool,
    /// Parts that the constraint never writes.
    pub reads: Vec<Path>,
    /// How far its sides may differ, where that was written.
    pub within: Option<Box<Term>>,
    /// Where it was written.
    pub origin: OriginId,
}

impl Constraint {
    /// Returns a required constraint that says this and nothing else: without a name, its methods derived.
    pub fn required(rule: Term, origin: OriginId) -> Self {
        Self {
            name: None,
            doc: Box::default(),
            rule: Rc::new(rule),
            strength: Strength::Required,
            methods: Vec::new(),
            derived: true,
            reads: Vec::new(),
            within: None,
            origin,
        }
    }
}

/// A part that is given an expression of other parts: `size = 2 * width`.
///
/// It is a constraint that holds where nothing nearer gives the part a value, and no given value.
#[derive(Clone, PartialEq, Debug)]
pub struct Binding {
    /// The index of its constraint.
    pub constraint: u32,
    /// From a thing of the class to the part.
    pub path: Path,
    /// Where the value was written: that of its given value, too.
    pub value: OriginId,
}

/// A way to make a rule hold: `fahrenheit := celsius * 1.8 + 32`.
#[derive(Clone, PartialEq, Debug)]
pub struct Method {
    /// The parts that it writes.
    pub targets: Vec<Path>,
    /// What it writes into each.
    pub values: Vec<Term>,
    /// Where it was written.
    pub origin: OriginId,
}

/// Parts that are one part, reached by several paths.
#[derive(Clone, PartialEq, Debug)]
pub struct Merge {
    /// Its name, by which it can be masked.
    pub name: Option<Name>,
    /// The paths, two or more.
    pub paths: Vec<Path>,
    /// Where it was written.
    pub origin: OriginId,
}

/// A set membership: `insert current into node.currents`.
#[derive(Clone, PartialEq, Debug)]
pub struct Insert {
    /// The part.
    pub part: Path,
    /// The set.
    pub set: Path,
    /// Where it was written.
    pub origin: OriginId,
}

/// What is set of a constraint: `level.enabled = false`, `level.strength = "weak"`.
#[derive(Clone, PartialEq, Debug)]
pub struct Switch {
    /// The thing that has the constraint.
    pub path: Path,
    /// The constraint's name.
    pub name: Name,
    /// What is set.
    pub setting: Setting,
    /// Where it was written.
    pub origin: OriginId,
}

/// What can be set of a constraint.
#[derive(Clone, PartialEq, Debug)]
pub enum Setting {
    /// Whether it shall hold: always, never, or while an expression of the thing that says so is true.
    Enabled(Term),
    /// How strongly.
    Strength(Strength),
}

/// A declared stay, or an anchor.
#[derive(Clone, PartialEq, Debug)]
pub struct Stay {
    /// The part that stays.
    pub path: Path,
    /// How strongly; `None` for an anchor, which only a `set` of exactly this path changes.
    pub strength: Option<Strength>,
    /// Where it was written.
    pub origin: OriginId,
}
