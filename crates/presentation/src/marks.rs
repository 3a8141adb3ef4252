//! What is marked in a picture: selected things, and the one under the pointer.

use crate::paint::Mark;
use crate::paths::covers;
use session::view::PictureView;

/// What is marked in all views, each as the first path of its thing.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Marked {
    /// What is selected, in the order of choosing.
    pub selected: Vec<String>,
    /// What is under the pointer.
    pub hovered: Option<String>,
    /// What is drawn now, while a program is recorded: its example.
    pub recorded: Option<String>,
}

/// Returns how each of a picture's tags and then each of its grips is marked.
pub fn marks(picture: &PictureView, marked: &Marked) -> Vec<Mark> {
    let is = |whole: &String, path: &str| !whole.is_empty() && covers(whole, path);
    if *marked == Marked::default() {
        return Vec::new();
    }
    let mark = |path: &String| {
        if marked.selected.iter().any(|whole| is(whole, path)) {
            Mark::Selected
        } else if marked.hovered.as_ref().is_some_and(|whole| is(whole, path)) {
            Mark::Hovered
        } else if marked.recorded.as_ref().is_some_and(|whole| !is(whole, path)) {
            Mark::Outside
        } else {
            Mark::None
        }
    };
    picture.paths.iter().chain(picture.grips.iter().map(|grip| &grip.path)).map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::{Marked, marks};
    use crate::paint::Mark;
    use session::view::PictureView;

    #[test]
    fn selection_wins_over_hovering_and_the_document_marks_nothing() {
        let paths = ["a", "a.b", "c"].map(String::from).to_vec();
        let picture = PictureView { paths, ..PictureView::default() };
        let marks = |selected: &[&str], hovered: Option<&str>| {
            let selected = selected.iter().map(|path| String::from(*path)).collect();
            let hovered = hovered.map(String::from);
            marks(&picture, &Marked { selected, hovered, ..Marked::default() })
        };
        assert_eq!(marks(&["a.b"], Some("a")), [Mark::Hovered, Mark::Selected, Mark::None]);
        assert_eq!(marks(&["a.b", "c"], None), [Mark::None, Mark::Selected, Mark::Selected]);
        assert_eq!(marks(&[""], None), [Mark::None; 3]);
        assert!(marks(&[], None).is_empty());
        let recorded = Some(String::from("a"));
        let marked = super::marks(&picture, &Marked { recorded, ..Marked::default() });
        assert_eq!(marked, [Mark::None, Mark::None, Mark::Outside]);
    }
}
