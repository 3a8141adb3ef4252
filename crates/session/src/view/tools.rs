//! What hands and their tools ask, and are answered.

use expr::{Dimension, units};

/// Where a pointer is, for a tool.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Pointer {
    /// On the sheet.
    pub at: (f64, f64),
    /// How near it must be to what it finds, on the sheet.
    pub reach: f64,
    /// Whether it finds nothing: no joints, no guides.
    pub alone: bool,
    /// Whether its place was typed: it finds no more than the joint that is exactly there.
    pub is_typed: bool,
    /// A length that was typed: the place is so far from the last one, in the pointer's direction.
    pub length: Option<TypedLength>,
    /// An angle that was typed, in degrees: the direction from the last place, turned left from the right.
    pub angle: Option<f64>,
    /// The grid to which a free place of a construction goes, on the sheet: 1, 2 or 5 of a power of ten; 0 for none.
    pub grid: f64,
    /// Two opposite corners of what is in view, on the sheet: what lies elsewhere is no guide. All of it, without.
    pub seen: Option<[(f64, f64); 2]>,
}

impl Pointer {
    /// Whether a place is in view.
    pub(crate) fn sees(&self, (x, y): (f64, f64)) -> bool {
        let is_within = |x: f64, a: f64, b: f64| a.min(b) <= x && x <= a.max(b);
        self.seen.is_none_or(|[a, b]| is_within(x, a.0, b.0) && is_within(y, a.1, b.1))
    }
}

/// A length as it was typed: `30`, `3 cm`.
#[derive(Clone, PartialEq, Debug)]
pub struct TypedLength {
    /// The number.
    pub number: f64,
    /// Its unit; a bare number is one of the sheet.
    pub unit: Option<String>,
}

impl TypedLength {
    /// Reads a number, and the unit of a length after it; nothing where it is something else.
    pub fn read(typed: &str) -> Option<Self> {
        let typed = typed.trim();
        let is_number = |end: &usize| typed[..*end].trim_end().parse::<f64>().is_ok();
        let mut ends = typed.char_indices().map(|(at, c)| at + c.len_utf8()).rev();
        let end = ends.find(is_number)?;
        let (number, unit) = (typed[..end].trim_end().parse().ok()?, typed[end..].trim());
        let is_length = |unit| units::unit(unit).is_some_and(|u| u.dimension == Dimension::LENGTH);
        let unit = if unit.is_empty() { None } else { Some(unit) };
        (f64::is_finite(number) && unit.is_none_or(is_length))
            .then(|| Self { number, unit: unit.map(String::from) })
    }
}

impl From<f64> for TypedLength {
    fn from(number: f64) -> Self {
        Self { number, unit: None }
    }
}

/// Which way along what a key goes through.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Along {
    /// To the next one.
    Next,
    /// To the one before.
    Back,
}

/// What a tool shows.
#[derive(Clone, Debug, Default)]
pub struct ToolView {
    /// What the mouse does now, in one sentence.
    pub hint: String,
    /// What would be made, and the guides to it.
    pub preview: drawing::Drawing,
    /// What the pointer finds, if anything.
    pub caught: Option<Caught>,
    /// What makes it, once every place is set.
    pub command: Option<kernel::Command>,
    /// Whether something of it is set already.
    pub begun: bool,
    /// The path of what it makes.
    pub makes: String,
}

/// What a pointer with a tool, or with something dragged, finds.
#[derive(Clone, PartialEq, Debug)]
pub struct Caught {
    /// Where it is, on the sheet.
    pub at: (f64, f64),
    /// What comes of it: `joins line.p2`, `midpoint of line`, `horizontal`.
    pub word: String,
}

/// Something that can be said of what is selected.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Offer {
    /// What a button says: `parallel`, `equal length`, `distance`.
    pub label: String,
    /// The members of the document that say it; `{}` stands where a value goes.
    pub members: String,
    /// The value as it is now, where one goes there.
    pub value: Option<String>,
    /// Whether a dimension says it already: saying it gives that another value.
    pub stands: bool,
    /// What saying it does.
    pub deed: Deed,
}

impl Offer {
    /// Returns the command that adds its members to the document, with a value where one goes there.
    pub fn command(&self, value: Option<&str>) -> kernel::Command {
        let value = value.or(self.value.as_deref()).unwrap_or_default();
        let members = self.members.replace("{}", value);
        kernel::Command::Edit { target: kernel::Path::default(), members }
    }
}

/// What saying an offer does; `Session::said` gives the command.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub enum Deed {
    /// Its members are added to the document.
    #[default]
    Add,
    /// The value at a path, which a dimension has that stands already, is another.
    Give(kernel::Path),
    /// The corner at a point, or between two lines, is rounded; its value is the radius.
    Round(Vec<kernel::Path>),
    /// A rectangle becomes its four lines.
    InLines(kernel::Path),
    /// The dimension at a path, which only follows what it measures, becomes one that says its value.
    Rule(kernel::Path),
}

/// Of what something is that becomes part of a class by example.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Scope {
    /// Of the class: every thing of it has it.
    #[default]
    Class,
    /// Of this one thing only.
    Own,
    /// A parameter of the class: every thing may have another number.
    Parameter,
}

/// What has to be decided of a class by example.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ItemKind {
    /// A part.
    Part,
    /// A value that a part is given.
    Value,
    /// A constraint.
    Constraint,
    /// A merge.
    Merge,
    /// An anchor.
    Anchor,
}

impl ItemKind {
    /// Of what it is unless somebody decides otherwise: where things of a class are held, all would lie on one another.
    pub fn usual(self) -> Scope {
        match self {
            Self::Part | Self::Value | Self::Constraint | Self::Merge => Scope::Class,
            Self::Anchor => Scope::Own,
        }
    }
}

/// One thing that has to be decided of a class by example.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ClassItem {
    /// What it is.
    pub kind: ItemKind,
    /// What the text says of it, on one line.
    pub says: String,
    /// What a parameter for its number would be called; nothing where it has no number of its own.
    pub parameter: Option<String>,
}

/// What was decided of a class by example.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct ClassPlan {
    /// The class's name.
    pub name: String,
    /// Of what each item is, in the order of the items; what is usual, where there are fewer.
    pub scopes: Vec<Scope>,
    /// The parts by which a thing of it is placed, in this order.
    pub attachers: Vec<kernel::Path>,
}

/// A value of a thing or its parts, which may be shared with what that is merged with.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ValueWithin {
    /// Its path within the thing; empty for a thing that is a value itself.
    pub path: String,
    /// The path of its row of the values view.
    pub row: String,
}

/// What a constraint says, as it stands on a drawing.
#[derive(Clone, PartialEq, Debug)]
pub struct Annotation {
    /// The constraint's path; of a thing that draws nothing, which says it, that thing's.
    pub path: String,
    /// Its rule, as it is written.
    pub says: String,
    /// What stands on the drawing: `30 mm`, `R 5 mm`, `∥`.
    pub words: String,
    /// How it is drawn.
    pub shows: Shows,
    /// What it is of, by the paths of the picture.
    pub of: Vec<String>,
    /// Whether it holds.
    pub holds: bool,
    /// What a dimension measures, as `width`.
    pub measure: Option<String>,
    /// The number that a dimension gives, as the sheet counts.
    pub number: Option<f64>,
    /// What types another value of a dimension, where it is a number.
    pub typed: Option<Offer>,
}

/// How an annotation is drawn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shows {
    /// Beside a line, or the way between two places.
    Length,
    /// At the end of a line from a circle's edge.
    Radius,
    /// Between two lines, each with whether it is turned round.
    Angle([bool; 2]),
    /// As a sign beside each thing.
    Relation,
}
