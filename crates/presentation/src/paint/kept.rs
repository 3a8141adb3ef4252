//! What a list has in common with the one before it: that is kept as a picture, and what follows is painted over it.
//!
//! In: two lists that are painted one after the other. Out: how both begin, as a list of its own, which ends behind an
//! operation with nothing open; and what a list has behind such a beginning.

use super::{DisplayList, PAGE_COLORS};

/// How many numbers an operation has, with its own.
fn length(numbers: &[f64]) -> usize {
    match numbers[0] as u8 {
        2 | 5 => 5,
        // where the number of corners is cut off, so is the operation
        3 => numbers.get(2).map_or(usize::MAX, |corners| 3 + 2 * *corners as usize),
        6 => 10,
        1 | 4 | 7 | 12 => 6,
        8 => 8,
        9 | 10 => 3,
        13 | 15 => 2,
        14 => 7,
        _ => 1,
    }
}

/// How far a list is read: what its operations up to there speak of, and what they leave behind.
#[derive(Clone, Copy, Default)]
struct Reading {
    at: usize,
    words: usize,
    colors: usize,
    style: Option<[f64; 5]>,
    /// A region of rings goes on.
    is_open: bool,
    /// What follows is not wholly seen.
    is_dimmed: bool,
}

impl Reading {
    fn take(&mut self, operation: &[f64]) {
        match operation {
            [1.0, style @ ..] => {
                self.style = style.try_into().ok();
                for color in &style[..2] {
                    // the page's own colours come first; there may be none, which is -1
                    let own = (*color as usize + 1).saturating_sub(PAGE_COLORS);
                    self.colors = self.colors.max(own);
                }
            }
            [6.0, word, ..] => self.words = self.words.max(*word as usize + 1),
            [13.0, begins] => self.is_open = *begins != 0.0,
            [15.0, seen] => {
                self.is_dimmed = *seen < 1.0;
                self.style = None;
            }
            _ => {}
        }
        self.at += operation.len();
    }
}

impl DisplayList {
    /// How this list and another one both begin.
    pub fn shared(&self, other: &Self) -> Self {
        let alike = self.numbers.iter().zip(&other.numbers).take_while(|(a, b)| a == b).count();
        let (mut reading, mut end) = (Reading::default(), Reading::default());
        while reading.at < alike {
            let rest = &self.numbers[reading.at..alike];
            let Some(operation) = rest.get(..length(rest)) else { break };
            reading.take(operation);
            let texts = |of: fn(&Self) -> &Vec<String>, n| of(self).get(..n) == of(other).get(..n);
            if !texts(|list| &list.words, reading.words)
                || !texts(|list| &list.colors, reading.colors)
            {
                break;
            }
            if !reading.is_open && !reading.is_dimmed {
                end = reading;
            }
        }
        if self.vertical != other.vertical {
            end = Reading::default();
        }
        Self {
            numbers: self.numbers[..end.at].to_vec(),
            words: self.words[..end.words].to_vec(),
            colors: self.colors[..end.colors].to_vec(),
            vertical: self.vertical,
            style: end.style,
        }
    }

    /// What this list has behind such a beginning, in the style that goes on there; nothing where it begins otherwise.
    pub fn behind(&self, beginning: &Self) -> Option<Vec<f64>> {
        let rest = self.numbers.strip_prefix(&beginning.numbers[..])?;
        let is_it = self.words.starts_with(&beginning.words)
            && self.colors.starts_with(&beginning.colors)
            && self.vertical == beginning.vertical;
        let style = beginning.style.iter().flat_map(|style| [1.0].into_iter().chain(*style));
        is_it.then(|| style.chain(rest.iter().copied()).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Mark, Part, display_list};
    use super::DisplayList;
    use drawing::{Anchoring, Color, Drawing, Element, Layer, Placement, Point, Shape, Style, Tag};
    use session::view::PictureView;

    fn line(x: f64, color: &str) -> Element {
        let shape = Shape::Segment(Point { x, y: 0.0 }, Point { x, y: 1.0 });
        let style = Style { color: Color::Named(color.into()), ..Style::default() };
        Element { shape, style, layer: Layer::Lines, tag: Tag(0) }
    }

    fn list(elements: Vec<Element>, marks: &[Mark]) -> DisplayList {
        let drawing = Drawing { elements, ..Drawing::default() };
        let picture = PictureView { drawing, ..PictureView::default() };
        display_list(&picture, Part::Whole, marks)
    }

    #[test]
    fn what_is_added_goes_on_in_the_style_before_it() {
        let before = list(vec![line(1.0, "red"), line(2.0, "red")], &[]);
        let now = list(vec![line(1.0, "red"), line(2.0, "red"), line(3.0, "red")], &[]);
        let shared = before.shared(&now);
        assert_eq!(shared.numbers, before.numbers);
        let style = [1.0, 12.0, -1.0, 0.0, 1.75, 0.0];
        let added = [2.0, 3.0, 0.0, 3.0, 1.0];
        assert_eq!(now.behind(&shared), Some([&style[..], &added].concat()));
        assert_eq!(before.behind(&now), None);
    }

    #[test]
    fn a_shape_that_is_another_ends_what_is_shared() {
        let before = list([1.0, 2.0, 3.0].map(|x| line(x, "red")).to_vec(), &[]);
        let now = list([1.0, 4.0, 3.0].map(|x| line(x, "red")).to_vec(), &[]);
        assert_eq!(before.shared(&now).numbers.len(), 6 + 5);
    }

    #[test]
    fn a_polyline_with_more_corners_is_shared_in_no_part() {
        let polyline = |corners: u32| {
            let points = (0..corners).map(|i| Point { x: f64::from(i), y: 2.0 }).collect();
            let shape = Shape::Polyline { points, closed: false };
            Element { shape, ..line(0.0, "red") }
        };
        let before = list(vec![line(1.0, "red"), polyline(3)], &[]);
        let now = list(vec![line(1.0, "red"), polyline(4)], &[]);
        assert_eq!(before.shared(&now).numbers.len(), 6 + 5);
    }

    #[test]
    fn a_colour_of_another_name_is_not_shared() {
        let before = list(vec![line(1.0, "red"), line(2.0, "green")], &[]);
        let now = list(vec![line(1.0, "red"), line(2.0, "blue")], &[]);
        assert_eq!(before.numbers, now.numbers);
        let shared = before.shared(&now);
        assert_eq!((shared.numbers.len(), shared.colors), (6 + 5, vec![String::from("red")]));
    }

    #[test]
    fn what_is_dimmed_is_shared_with_all_that_is_or_not_at_all() {
        let elements = [1.0, 2.0].map(|x| line(x, "red")).to_vec();
        let dimmed = list(elements.clone(), &[Mark::Outside]);
        let mut more = elements.clone();
        more.push(line(3.0, "red"));
        let more = list(more, &[Mark::Outside]);
        assert_eq!(dimmed.shared(&more), DisplayList::default());
        assert_eq!(dimmed.shared(&dimmed).numbers, dimmed.numbers);
    }

    #[test]
    fn words_are_shared_as_far_as_they_are_the_same() {
        let word = |text: &str| {
            let (at, anchoring) = (Point { x: 0.0, y: 0.0 }, Anchoring::Start);
            let placement = Placement::OnScreen(12.0);
            let shape = Shape::Text { at, text: text.into(), anchoring, placement, turn: 0.0 };
            Element { shape, style: Style::default(), layer: Layer::Words, tag: Tag(0) }
        };
        let before = list(vec![line(1.0, "red"), word("a"), word("b")], &[]);
        let now = list(vec![line(1.0, "red"), word("a"), word("c")], &[]);
        let shared = before.shared(&now);
        assert_eq!(shared.words, ["a"]);
    }
}
