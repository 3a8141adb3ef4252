//! Examples: what stands in the lists of a thing of a class that leaves them empty.
//!
//! A curve without a point shows nothing and nothing of it can be dragged. One that is inserted by hand, or shown in the
//! bin, has some.

use base::Name;
use kernel::{ClassId, ClassKind, Count, Document, Path, Primitive, Step, Vertical};

/// Where the points of an example are: a wave.
const WAVE: [(f64, f64); 4] = [(0.0, 0.0), (30.0, 30.0), (70.0, -30.0), (100.0, 0.0)];

/// Returns the members that give examples to the lists of places and numbers that a class leaves empty; nothing for a
/// class that has no such list of places.
pub(crate) fn lists(document: &Document, class: ClassId) -> Vec<String> {
    let lineage = document.lineage(class);
    let is_given = |name: &Name| {
        let part = Path(vec![Step::Part(name.clone())]);
        lineage.iter().any(|&c| document.classes[c].givens.iter().any(|given| given.path == part))
    };
    let up = if document.vertical == Vertical::Up { 1.0 } else { -1.0 };
    let mut members = Vec::new();
    let mut has_places = false;
    for field in document.layout(class) {
        let name = document.field_name(field);
        let ClassKind::List(element) = document.classes[document.field_class(field)].kind else {
            continue;
        };
        let count = document.declared(field).and_then(|part| part.count);
        let is_counted = matches!(count, Some(Count::Fixed(_)));
        if is_counted || is_given(name) {
            continue;
        }
        let is_place = document.is_place(element);
        has_places |= is_place;
        let elements = WAVE.map(|(x, y)| match is_place {
            true => format!("({x}, {})", up * y + 0.0),
            false => String::from("1"),
        });
        let is_number =
            matches!(document.classes[element].kind, ClassKind::Primitive(Primitive::Real(_)));
        if is_place || is_number {
            members.push(format!("{name} = [{}]", elements.join(", ")));
        }
    }
    if has_places { members } else { Vec::new() }
}
