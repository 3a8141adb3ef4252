//! Figures that are made of others: a rectangle of its sides. Its sides and corners are picked like lines and points, and
//! a pick of a side may mean the whole.

use base::Name;
use kernel::{ClassId, ClassKind, Document, PartRef};

/// What a figure that is made of others is picked by.
#[derive(Debug)]
pub(crate) struct Compound {
    /// The class.
    class: &'static str,
    /// Its sides, each a line or a list of lines.
    pub(crate) sides: &'static [&'static str],
    /// Its points.
    pub(crate) places: &'static [&'static str],
}

impl Compound {
    /// Whether it has a place of a name.
    pub(crate) fn has(&self, place: &str) -> bool {
        self.places.contains(&place)
    }
}

const ALL: [Compound; 4] = [
    Compound {
        class: "Rectangle",
        sides: &["side1", "side2", "side3", "side4"],
        places: &["corner", "corner2", "far", "corner4", "center"],
    },
    Compound {
        class: "TurnedRectangle",
        sides: &["side1", "side2", "side3", "side4"],
        places: &["corner", "corner2", "far", "corner4", "center"],
    },
    Compound { class: "RegularPolygon", sides: &["edges"], places: &["center"] },
    Compound { class: "Caption", sides: &[], places: &["at"] },
];

/// Returns what things of a class are picked by, where they are made of other figures.
pub(crate) fn of(document: &Document, class: ClassId) -> Option<&'static Compound> {
    let is_it = |of: &&Compound| {
        document.class_named(of.class).is_some_and(|known| document.is_a(class, known))
    };
    ALL.iter().find(is_it)
}

/// Whether things of a class are drawn through places, as many as there are: a spline.
pub(crate) fn is_of_places(document: &Document, class: ClassId) -> bool {
    let is_places = |field: &PartRef| match document.classes[document.field_class(*field)].kind {
        ClassKind::List(element) => *document.classes[element].name == *"Point",
        _ => false,
    };
    let is_drawn = || document.find_message(class, &Name::new("picture"), None).is_some();
    matches!(document.layout(class).as_slice(), [field] if is_places(field)) && is_drawn()
}

/// Whether things of a class are drawn as figures: it is one, made of others, or drawn through places.
pub(crate) fn is_drawn(document: &Document, class: ClassId) -> bool {
    document.figure(class).is_some()
        || of(document, class).is_some()
        || is_of_places(document, class)
}
