//! Figures that are made of others: a rectangle of its sides. Its sides and corners are picked like lines and points, and
//! a pick of a side may mean the whole.

use base::Name;
use kernel::{ClassId, ClassKind, Document, PartRef, Path, Step};

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

/// Whether things of a class are drawn through places, as many as there are, and by numbers at most besides: a spline.
pub(crate) fn is_of_places(document: &Document, class: ClassId) -> bool {
    let kind = |field: &PartRef| &document.classes[document.field_class(*field)].kind;
    let is_places = |field: &PartRef| match kind(field) {
        ClassKind::List(element) => *document.classes[*element].name == *"Point",
        _ => false,
    };
    let is_number = |field: &PartRef| match kind(field) {
        ClassKind::List(element) => {
            matches!(document.classes[*element].kind, ClassKind::Primitive(_))
        }
        kind => matches!(kind, ClassKind::Primitive(_)),
    };
    let is_drawn = || document.find_message(class, &Name::new("picture"), None).is_some();
    match document.layout(class).split_first() {
        Some((places, rest)) => is_places(places) && rest.iter().all(is_number) && is_drawn(),
        None => false,
    }
}

/// Whether a class itself says what a part is, unless something else is said.
pub(crate) fn is_given(document: &Document, class: ClassId, part: &Name) -> bool {
    let path = Path(vec![Step::Part(part.clone())]);
    let says = |class: &ClassId| document.classes[*class].givens.iter().any(|g| g.path == path);
    document.lineage(class).iter().any(says)
}

/// Whether things of a class are curves that are measured as they are drawn.
pub(crate) fn is_freeform(document: &Document, class: ClassId) -> bool {
    document.class_named("Freeform").is_some_and(|curve| document.is_a(class, curve))
}

/// Whether things of a class are drawn as figures: it is one, made of others, drawn through places, or another curve.
pub(crate) fn is_drawn(document: &Document, class: ClassId) -> bool {
    document.figure(class).is_some()
        || of(document, class).is_some()
        || is_of_places(document, class)
        || is_freeform(document, class)
}
