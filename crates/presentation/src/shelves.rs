//! The bin's tiles, by toolbox and library.

use session::view::BinEntry;

/// Tiles that lie together.
#[derive(Clone, PartialEq, Debug)]
pub struct Shelf {
    /// The toolbox, or else the library; none for the document's own.
    pub name: String,
    /// The tiles.
    pub entries: Vec<BinEntry>,
    /// Whether it is open at first: what a library has beside its toolbox is seldom wanted.
    pub is_open: bool,
}

impl Shelf {
    /// What tells it from others: its name, what lies on it, whether it is open.
    pub fn key(&self) -> (String, Vec<String>, bool) {
        // how a library's classes look stays; the document's own are edited
        let told = |entry: &BinEntry| match entry.library.is_empty() {
            true => format!("{} {:?}", entry.class, entry.picture.elements),
            false => entry.class.clone(),
        };
        (self.name.clone(), self.entries.iter().map(told).collect(), self.is_open)
    }
}

/// The entries by toolbox and library: the document's own, then toolboxes, then the rest; what was taken into use last
/// comes first.
pub fn shelved(found: &[BinEntry], is_filtered: bool) -> Vec<Shelf> {
    let boxed = |library: &str| found.iter().any(|e| e.toolbox.is_some() && e.library == library);
    let mut shelves: Vec<((u8, String), Vec<BinEntry>)> = Vec::new();
    for entry in found {
        let rank = match (&entry.toolbox, entry.library.as_str()) {
            (Some(_), _) => 1,
            (None, "") => 0,
            (None, _) => 2,
        };
        let key = (rank, entry.toolbox.clone().unwrap_or_else(|| entry.library.clone()));
        match shelves.iter_mut().find(|(shelf, _)| *shelf == key) {
            Some((_, shelf)) => shelf.push(entry.clone()),
            None => shelves.push((key, vec![entry.clone()])),
        }
    }
    shelves.reverse();
    shelves.sort_by_key(|((rank, _), _)| *rank);
    let shelf = |((rank, name), entries): ((u8, String), Vec<BinEntry>)| {
        let is_rest = rank == 2 && boxed(&name);
        let is_open = is_filtered || !is_rest;
        // a toolbox is often called as its library is
        let name = if is_rest { format!("more of {name}") } else { name };
        Shelf { name, entries, is_open }
    };
    shelves.into_iter().map(shelf).collect()
}

#[cfg(test)]
mod tests {
    use super::{Shelf, shelved};
    use session::view::BinEntry;

    fn entry(class: &str, library: &str, toolbox: Option<&str>) -> BinEntry {
        BinEntry {
            class: String::from(class),
            doc: String::new(),
            library: String::from(library),
            toolbox: toolbox.map(String::from),
            picture: drawing::Drawing::default(),
        }
    }

    #[test]
    fn a_shelf_with_other_tiles_is_another_however_many_they_are() {
        let key = |class| {
            let found = [entry(class, "circuits", Some("Circuits"))];
            shelved(&found, true).iter().map(Shelf::key).collect::<Vec<_>>()
        };
        assert_ne!(key("Resistor"), key("Capacitor"));
        assert_eq!(key("Resistor"), key("Resistor"));
    }

    #[test]
    fn a_tile_is_drawn_anew_when_its_class_has_another_look() {
        let key = |x: f64| {
            let mut own = entry("Sail", "", None);
            own.picture.elements.push(drawing::Element {
                shape: drawing::Shape::Dot(drawing::Point { x, y: 0.0 }),
                style: drawing::Style::default(),
                layer: drawing::Layer::Lines,
                tag: drawing::Tag(0),
            });
            shelved(&[own], false)[0].key()
        };
        assert_ne!(key(1.0), key(2.0));
        assert_eq!(key(1.0), key(1.0));
    }

    #[test]
    fn toolboxes_come_before_what_else_libraries_have() {
        let found = [
            entry("Resistor", "circuits", Some("Circuits")),
            entry("Line", "geometry", None),
            entry("Node", "circuits", None),
            entry("Mine", "", None),
        ];
        let names = |is_filtered| {
            let shelves = shelved(&found, is_filtered).into_iter();
            shelves.map(|s| (s.name, s.is_open)).collect::<Vec<_>>()
        };
        let wanted =
            [("", true), ("Circuits", true), ("more of circuits", false), ("geometry", true)];
        assert_eq!(names(false), wanted.map(|(n, open)| (String::from(n), open)));
        assert!(names(true).iter().all(|(_, is_open)| *is_open));
    }
}
