//! The painter's first half: a picture becomes one flat list of numbers.
//!
//! In: the session's picture and what is marked in it. Out: a [`DisplayList`], which
//! `assets/painter.js` paints in one call. The list is in the sheet's coordinates, so that pan and
//! zoom need no new one. Its operations:
//!
//! | numbers | meaning |
//! |---|---|
//! | 1, stroke, fill, line, width, on screen | a new style; colours by number, -1 for none; line as [`Line`] |
//! | 2, x1, y1, x2, y2 | a segment |
//! | 3, closed, n, x, y, … | a polyline of n corners |
//! | 4, x, y, radius, start, sweep | an arc |
//! | 5, sign, x, y, pixels | a point's `Sign` |
//! | 6, word, x, y, anchoring, height, width on the sheet, turn, right, down | words, by number; in heights, how far from the place the first base line is |
//! | 7, x, y, dx, dy, pixels | an arrow from a point, so many pixels for each unit of its direction |
//! | 8, x, y, a, b, turned, start, sweep | an arc of an ellipse |
//! | 9, x, y | a ring begins here |
//! | 10, x, y | the ring goes straight to here |
//! | 11 | the ring is closed |
//! | 12, x, y, radius, start, sweep | the ring goes on by an arc |
//! | 13, begins | a region of rings begins, or ends where 0 |
//! | 14, x, y, x, y, x, y | the ring goes on by a cubic curve |
//! | 15, opacity | how much of what follows is seen, from 0 to 1 |

mod kept;
mod note;
mod reach;
mod shapes;

use crate::sheet::View;
use drawing::{Anchoring, Color, Drawing, Element, Layer, Line, Placement, Point, Shape, Style};
pub(crate) use note::note;
use reach::Reach;
use session::view::{Caught, Freedom, MovedView, PictureView, Velocity};
use shapes::shape;
use std::cell::LazyCell;
use std::collections::BTreeSet;

/// What is painted: numbers, and the words and colours that they speak of.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct DisplayList {
    /// The operations.
    pub numbers: Vec<f64>,
    /// The words.
    pub words: Vec<String>,
    /// The colours that the document names; they are numbered after the page's own.
    pub colors: Vec<String>,
    /// Which way `y` runs on the sheet.
    vertical: drawing::Vertical,
    /// The numbers of the latest style: what has the same follows in one path.
    style: Option<[f64; 5]>,
}

/// Which part of a picture a list is of.
#[derive(Clone, Copy, Debug)]
pub enum Part<'a> {
    /// All of it.
    Whole,
    /// What has moved since a drag was pressed.
    Moving(&'a MovedView),
    /// The rest.
    Still(&'a MovedView),
}

impl Part<'_> {
    /// The numbers below `n` that belong to it, in order.
    fn of(self, n: usize, moved: impl Fn(&MovedView) -> Option<&[u32]>) -> Vec<usize> {
        match self {
            Part::Whole => (0..n).collect(),
            Part::Moving(view) => match moved(view) {
                Some(moved) => moved.iter().map(|&at| at as usize).filter(|&at| at < n).collect(),
                None => (0..n).collect(),
            },
            Part::Still(view) => match moved(view) {
                Some(moved) => {
                    let mut next = moved.iter().map(|&at| at as usize).peekable();
                    (0..n).filter(|&at| next.next_if_eq(&at).is_none()).collect()
                }
                None => Vec::new(),
            },
        }
    }

    fn elements(self, picture: &PictureView) -> Vec<usize> {
        self.of(picture.drawing.elements.len(), |view| match view {
            MovedView::Everything => None,
            MovedView::These { elements, .. } => Some(elements),
        })
    }

    fn grips(self, picture: &PictureView) -> Vec<usize> {
        self.of(picture.grips.len(), |view| match view {
            MovedView::Everything => None,
            MovedView::These { grips, .. } => Some(grips),
        })
    }
}

/// The page's own colours, in the order of `ROLES` in `painter.js`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Hue {
    Ink,
    Faint,
    Accent,
    Paper,
    Free,
    Fixed,
    Conflict,
    Redundant,
    Halo,
    SoftHalo,
    Grid,
    GridStrong,
}
const PAGE_COLORS: usize = 12;

/// The shape of a point: its state without colour.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Sign {
    Disc,
    Square,
    Cross,
    Diamond,
}

/// How a thing is marked in all views.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Mark {
    /// Not at all.
    #[default]
    None,
    /// The pointer is over it, here or in another view.
    Hovered,
    /// It is selected.
    Selected,
    /// It stands outside of what is drawn now, and is dimmed.
    Outside,
}

/// The width of a line where the document does not say, in pixels.
const USUAL_WIDTH: f64 = 1.75;
/// The length of the longest arrow of a motion, in pixels.
const ARROW: f64 = 44.0;
/// So much is seen of what is dimmed.
const DIMMED: f64 = 0.4;
/// The radius of a point, in pixels.
const POINT: f64 = 4.75;

/// Returns the list for a part of a picture. Grips are painted as points where the picture itself has none; `marks`
/// are those of its tags and then of its grips.
pub fn display_list(picture: &PictureView, part: Part<'_>, marks: &[Mark]) -> DisplayList {
    let mut list = DisplayList { vertical: picture.drawing.vertical, ..DisplayList::default() };
    let all = &picture.drawing.elements;
    let own: Vec<&Element> = part.elements(picture).into_iter().map(|at| &all[at]).collect();
    let grips = part.grips(picture);
    let bare = bare_grips(picture, &own, &grips);
    let anchored: BTreeSet<&str> = grips
        .iter()
        .map(|at| &picture.grips[*at])
        .filter(|grip| grip.anchored)
        .map(|grip| grip.path.as_str())
        .collect();
    let is_dimmed = |at: usize| marks.get(at) == Some(&Mark::Outside);
    let (dimmed, own): (Vec<_>, Vec<_>) =
        own.into_iter().partition(|e| is_dimmed(e.tag.0 as usize));
    let (dimmed_bare, bare): (Vec<_>, Vec<_>) =
        bare.into_iter().partition(|at| is_dimmed(picture.paths.len() + at));
    if !dimmed.is_empty() || !dimmed_bare.is_empty() {
        opacity(&mut list, DIMMED);
        paint_elements(&mut list, picture, &anchored, &in_layers(picture, &dimmed));
        let grips = dimmed_bare.iter().map(|at| &picture.grips[*at]).filter(|grip| !grip.drawn);
        grips.for_each(|g| dot(&mut list, Point { x: g.x, y: g.y }, g.freedom, g.anchored));
        opacity(&mut list, 1.0);
    }
    let elements = in_layers(picture, &own);
    for mark in [Mark::Hovered, Mark::Selected] {
        halos(&mut list, &elements, marks, mark);
        let marked = |at: &&usize| marks.get(picture.paths.len() + **at) == Some(&mark);
        for grip in bare.iter().filter(marked).map(|at| &picture.grips[*at]) {
            halo(&mut list, Point { x: grip.x, y: grip.y }, mark);
        }
    }
    let words = elements.iter().position(|e| e.layer == Layer::Words).unwrap_or(elements.len());
    let (below, words) = elements.split_at(words);
    paint_elements(&mut list, picture, &anchored, below);
    paint_points_at_rest(&mut list, picture, part, &is_dimmed);
    for at in bare {
        let grip = &picture.grips[at];
        if grip.drawn && marks.get(picture.paths.len() + at).is_none_or(|m| *m == Mark::None) {
            continue;
        }
        dot(&mut list, Point { x: grip.x, y: grip.y }, grip.freedom, grip.anchored);
    }
    paint_elements(&mut list, picture, &anchored, words);
    list
}

/// Paints the points that rest over the lines that move, where there are few: a line does not lie over its end.
fn paint_points_at_rest(
    list: &mut DisplayList,
    picture: &PictureView,
    part: Part<'_>,
    is_dimmed: &dyn Fn(usize) -> bool,
) {
    /// With more points these stay under what moves.
    const MOST: usize = 400;
    let Part::Moving(view @ MovedView::These { .. }) = part else { return };
    if picture.grips.len() > MOST || picture.drawing.elements.len() > MOST {
        return;
    }
    let rest = Part::Still(view);
    let dots: Vec<&Element> = { rest.elements(picture).into_iter() }
        .map(|at| &picture.drawing.elements[at])
        .filter(|e| matches!(e.shape, Shape::Dot(_)) && !is_dimmed(e.tag.0 as usize))
        .collect();
    let grips = rest.grips(picture);
    let bare = bare_grips(picture, &dots, &grips);
    let anchored = { grips.iter().map(|at| &picture.grips[*at]) }
        .filter(|grip| grip.anchored)
        .map(|grip| grip.path.as_str())
        .collect();
    paint_elements(list, picture, &anchored, &dots);
    let clear = bare.iter().filter(|at| !is_dimmed(picture.paths.len() + **at));
    for grip in clear.map(|at| &picture.grips[*at]).filter(|grip| !grip.drawn) {
        dot(list, Point { x: grip.x, y: grip.y }, grip.freedom, grip.anchored);
    }
}

/// Adds an element's shape, as far as it is shown: where it has no ends, from one side of the picture to the other.
fn shown(
    list: &mut DisplayList,
    element: &Element,
    reach: &LazyCell<Reach, impl FnOnce() -> Reach>,
) {
    let across = match element.shape {
        Shape::Segment(a, b) if element.style.is_unbounded => reach.across((a, b)),
        _ => None,
    };
    shape(list, across.as_ref().unwrap_or(&element.shape));
}

/// Adds an arrow for every place that a motion moves.
pub fn arrows(list: &mut DisplayList, picture: &PictureView, motion: &[Velocity]) {
    if motion.is_empty() {
        return;
    }
    begin(list, Hue::Accent as i32, -1, Line::Solid, 2.0, Space::Screen);
    for velocity in motion {
        let grip = picture.grips.iter().find(|grip| grip.path == velocity.path);
        if let (Some(grip), &[dx, dy]) = (grip, velocity.direction.as_slice()) {
            list.numbers.extend([7.0, grip.x, grip.y, dx, dy, ARROW]);
        }
    }
}

/// Adds what looks otherwise where a thing could be elsewhere, faint and dashed.
pub fn ghosts(list: &mut DisplayList, drawn: &[Drawing]) {
    for element in drawn.iter().flat_map(|drawing| &drawing.elements) {
        match element.shape {
            Shape::Dot(at) => {
                begin(list, Hue::Faint as i32, -1, Line::Solid, USUAL_WIDTH, Space::Screen);
                sign(list, Sign::Disc, at, POINT);
            }
            Shape::Text { .. } => {}
            Shape::Segment(..)
            | Shape::Polyline { .. }
            | Shape::Circle { .. }
            | Shape::Arc { .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_)
            | Shape::Region(_) => {
                begin(list, Hue::Faint as i32, -1, Line::Dashed, USUAL_WIDTH, Space::Sheet);
                shape(list, &element.shape);
            }
        }
    }
}

/// Adds what is drawn for construction alone, faint and dashed: straights without ends as far as the screen reaches.
pub fn guides(list: &mut DisplayList, drawn: &Drawing, picture: &Drawing) {
    let faint = Hue::Faint as i32;
    let dot = |list: &mut _| begin(list, faint, -1, Line::Solid, USUAL_WIDTH, Space::Screen);
    let line = |list: &mut _, _| begin(list, faint, -1, Line::Dashed, USUAL_WIDTH, Space::Sheet);
    sketched(list, (drawn, picture), dot, line);
}

/// Adds where places went.
pub fn loci(list: &mut DisplayList, drawn: &Drawing) {
    for element in &drawn.elements {
        begin(list, Hue::Accent as i32, -1, Line::Solid, 1.25, Space::Sheet);
        shape(list, &element.shape);
    }
}

/// Adds what a tool would make.
pub fn preview(list: &mut DisplayList, drawn: &Drawing, picture: &Drawing) {
    let (paper, accent) = (Hue::Paper as i32, Hue::Accent as i32);
    let dot = |list: &mut _| begin(list, paper, accent, Line::Solid, 1.5, Space::Screen);
    let line = |list: &mut _, line| begin(list, accent, -1, line, USUAL_WIDTH, Space::Sheet);
    sketched(list, (drawn, picture), dot, line);
}

/// Adds what is no part of the picture that it lies over: dots and lines, each begun as its function says.
fn sketched(
    list: &mut DisplayList,
    (drawn, picture): (&Drawing, &Drawing),
    dot: impl Fn(&mut DisplayList),
    line: impl Fn(&mut DisplayList, Line),
) {
    let reach = LazyCell::new(|| Reach::of(picture));
    for element in &drawn.elements {
        if let Shape::Dot(at) = element.shape {
            dot(list);
            sign(list, Sign::Disc, at, POINT);
        } else {
            line(list, element.style.line);
            shown(list, element, &reach);
        }
    }
}

/// Adds a ring around what a pointer found, and the word for it.
pub fn caught(list: &mut DisplayList, found: &Caught) {
    let at = Point { x: found.at.0, y: found.at.1 };
    begin(list, Hue::Accent as i32, -1, Line::Solid, 2.0, Space::Screen);
    sign(list, Sign::Disc, at, 2.2 * POINT);
    let text = Shape::Text {
        at,
        text: found.word.clone(),
        anchoring: Anchoring::Start,
        placement: Placement::OnScreen(13.0),
        turn: 0.0,
    };
    begin(list, Hue::Accent as i32, -1, Line::None, 1.0, Space::Screen);
    shape(list, &text);
}

/// Those of some grips where some elements have no point.
fn bare_grips(picture: &PictureView, elements: &[&Element], grips: &[usize]) -> Vec<usize> {
    let dots = elements.iter().filter(|e| matches!(e.shape, Shape::Dot(_)));
    let dotted: BTreeSet<&str> =
        dots.filter_map(|e| picture.paths.get(e.tag.0 as usize)).map(String::as_str).collect();
    let is_bare = |at: &usize| !dotted.contains(picture.grips[*at].path.as_str());
    grips.iter().copied().filter(is_bare).collect()
}

fn paint_elements(
    list: &mut DisplayList,
    picture: &PictureView,
    anchored: &BTreeSet<&str>,
    elements: &[&Element],
) {
    let reach = LazyCell::new(|| Reach::of(&picture.drawing));
    for element in elements {
        let tag = element.tag.0 as usize;
        let freedom = picture.freedom.get(tag).copied().flatten();
        if let Shape::Dot(p) = element.shape {
            let path = picture.paths.get(tag).map(String::as_str);
            dot(list, p, freedom, path.is_some_and(|path| anchored.contains(path)));
            continue;
        }
        let now = style_of(list, &element.style, freedom);
        take_up(list, now);
        shown(list, element, &reach);
    }
}

/// Puts elements into the order in which they are painted. Where a layer has no fills, which hide
/// what is behind them, those of one style come together, so that each style is drawn once; so do points.
fn in_layers<'e>(picture: &PictureView, elements: &[&'e Element]) -> Vec<&'e Element> {
    let mut sorted: Vec<&Element> = Vec::with_capacity(elements.len());
    for layer in [Layer::Back, Layer::Lines, Layer::Points, Layer::Words] {
        let from = sorted.len();
        sorted.extend(elements.iter().copied().filter(|e| e.layer == layer));
        let own = &mut sorted[from..];
        if layer == Layer::Points {
            own.sort_by_key(|e| picture.freedom.get(e.tag.0 as usize).copied().flatten());
        }
        if layer == Layer::Lines && own.iter().all(|e| e.style.fill.is_none()) {
            let mut styles: Vec<&Style> = Vec::new();
            own.sort_by_cached_key(|e| {
                styles.iter().position(|s| **s == e.style).unwrap_or_else(|| {
                    styles.push(&e.style);
                    styles.len() - 1
                })
            });
        }
    }
    sorted
}

/// Paints a broad soft line behind everything that is marked so.
fn halos(list: &mut DisplayList, elements: &[&Element], marks: &[Mark], mark: Mark) {
    let Some(color) = halo_color(mark) else { return };
    let marked = |e: &&&Element| marks.get(e.tag.0 as usize) == Some(&mark);
    for element in elements.iter().filter(marked) {
        match element.shape {
            Shape::Dot(_) | Shape::Text { .. } => {}
            Shape::Segment(..)
            | Shape::Polyline { .. }
            | Shape::Circle { .. }
            | Shape::Arc { .. }
            | Shape::Ellipse { .. }
            | Shape::Spline(_)
            | Shape::Nurbs(_)
            | Shape::Region(_) => {
                begin(list, color, -1, Line::Solid, 9.0, Space::Sheet);
                shape(list, &element.shape);
            }
        }
    }
    for element in elements.iter().filter(marked) {
        if let Shape::Dot(p) = element.shape {
            halo(list, p, mark);
        }
    }
}

fn halo_color(mark: Mark) -> Option<i32> {
    match mark {
        Mark::None | Mark::Outside => None,
        Mark::Hovered => Some(Hue::SoftHalo as i32),
        Mark::Selected => Some(Hue::Halo as i32),
    }
}

fn halo(list: &mut DisplayList, at: Point, mark: Mark) {
    if let Some(color) = halo_color(mark) {
        begin(list, -1, color, Line::None, 0.0, Space::Screen);
        sign(list, Sign::Disc, at, 2.4 * POINT);
    }
}

/// Where the numbers of a path live.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Space {
    Sheet,
    Screen,
}

fn begin(list: &mut DisplayList, stroke: i32, fill: i32, line: Line, width: f64, space: Space) {
    let on_screen = f64::from(u8::from(space == Space::Screen));
    take_up(list, [f64::from(stroke), f64::from(fill), line_number(line), width, on_screen]);
}

/// Begins a path of another style than that of the latest.
fn take_up(list: &mut DisplayList, style: [f64; 5]) {
    if list.style != Some(style) {
        list.numbers.push(1.0);
        list.numbers.extend(style);
        list.style = Some(style);
    }
}

/// From here on so much is seen.
fn opacity(list: &mut DisplayList, seen: f64) {
    list.numbers.extend([15.0, seen]);
    list.style = None;
}

fn line_number(line: Line) -> f64 {
    match line {
        Line::Solid => 0.0,
        Line::Dashed => 1.0,
        Line::Dotted => 2.0,
        Line::None => 3.0,
        Line::Chained => 4.0,
    }
}

/// A point: free blue discs, fixed ones in ink, anchored squares, conflicting crosses, redundant
/// diamonds, each with a rim of paper.
fn dot(list: &mut DisplayList, at: Point, freedom: Option<Freedom>, anchored: bool) {
    let (color, form) = match freedom {
        Some(Freedom::Conflicting) => (Hue::Conflict, Sign::Cross),
        Some(Freedom::Redundant) => (Hue::Redundant, Sign::Diamond),
        _ if anchored => (Hue::Fixed, Sign::Square),
        Some(Freedom::Free) => (Hue::Free, Sign::Disc),
        Some(Freedom::Fixed) | None => (Hue::Fixed, Sign::Disc),
    };
    let paper = Hue::Paper as i32;
    match form {
        Sign::Cross => {
            for (color, width) in [(paper, 6.0), (color as i32, 2.75)] {
                begin(list, color, -1, Line::Solid, width, Space::Screen);
                sign(list, form, at, POINT);
            }
        }
        Sign::Disc | Sign::Square | Sign::Diamond => {
            begin(list, paper, color as i32, Line::Solid, 1.5, Space::Screen);
            sign(list, form, at, if form == Sign::Diamond { 1.4 * POINT } else { POINT });
        }
    }
}

fn sign(list: &mut DisplayList, form: Sign, at: Point, pixels: f64) {
    list.numbers.extend([5.0, f64::from(form as u8), at.x, at.y, pixels]);
}

/// Returns the five numbers of a style.
fn style_of(list: &mut DisplayList, style: &Style, freedom: Option<Freedom>) -> [f64; 5] {
    let stroke = match freedom {
        Some(Freedom::Conflicting) => Hue::Conflict as usize,
        Some(Freedom::Free | Freedom::Fixed | Freedom::Redundant) | None => {
            color_number(list, &style.color)
        }
    };
    let fill = style.fill.as_ref().map_or(-1.0, |color| color_number(list, color) as f64);
    let width = if style.width > 0.0 { style.width } else { USUAL_WIDTH };
    [stroke as f64, fill, line_number(style.line), width, 0.0]
}

fn color_number(list: &mut DisplayList, color: &Color) -> usize {
    match color {
        Color::Ink => Hue::Ink as usize,
        Color::Faint => Hue::Faint as usize,
        Color::Accent => Hue::Accent as usize,
        Color::Named(name) => PAGE_COLORS + number_in(&mut list.colors, name),
    }
}

/// Returns where a text stands in a list, which it joins if it is not there yet.
fn number_in(texts: &mut Vec<String>, text: &str) -> usize {
    texts.iter().position(|t| t == text).unwrap_or_else(|| {
        texts.push(String::from(text));
        texts.len() - 1
    })
}

/// Returns the lines of the grid that one sees, as a list that goes before the picture's.
pub fn grid(view: &View, (width, height): (f64, f64)) -> Vec<f64> {
    let step = view.grid_step();
    let (p, q) = (view.sheet_from_screen((0.0, 0.0)), view.sheet_from_screen((width, height)));
    let mut list = DisplayList::default();
    for (color, every) in [(Hue::Grid, false), (Hue::GridStrong, true)] {
        begin(&mut list, color as i32, -1, Line::Solid, 1.0, Space::Sheet);
        for n in lines_between(p.x, q.x, step).filter(|n| (n % 5 == 0) == every) {
            list.numbers.extend([2.0, n as f64 * step, p.y, n as f64 * step, q.y]);
        }
        for n in lines_between(p.y, q.y, step).filter(|n| (n % 5 == 0) == every) {
            list.numbers.extend([2.0, p.x, n as f64 * step, q.x, n as f64 * step]);
        }
    }
    list.numbers
}

fn lines_between(a: f64, b: f64, step: f64) -> impl Iterator<Item = i64> {
    let (least, most) = (a.min(b), a.max(b));
    (least / step).ceil() as i64..=(most / step).floor() as i64
}

#[cfg(test)]
mod tests {
    use super::{Mark, Part, display_list, grid};
    use crate::sheet::View;
    use drawing::{Color, Drawing, Element, Layer, Point, Shape, Style, Tag};
    use session::view::{Freedom, Grip, MovedView, PictureView};

    fn element(shape: Shape, layer: Layer, style: Style) -> Element {
        Element { shape, style, layer, tag: Tag(0) }
    }
    fn segment(x: f64) -> Shape {
        Shape::Segment(Point { x, y: 0.0 }, Point { x, y: 1.0 })
    }
    fn picture(elements: Vec<Element>, freedom: Option<Freedom>) -> PictureView {
        PictureView {
            drawing: Drawing { elements, ..Drawing::default() },
            paths: vec![String::from("p")],
            freedom: vec![freedom],
            grips: Vec::new(),
            ..PictureView::default()
        }
    }

    #[test]
    fn what_moves_and_what_rests_are_the_whole() {
        let elements = [1.0, 2.0, 3.0].map(|x| element(segment(x), Layer::Lines, Style::default()));
        let picture = picture(elements.to_vec(), None);
        let moved = MovedView::These { elements: vec![1], grips: Vec::new() };
        let numbers = |part| display_list(&picture, part, &[]).numbers;
        let style = [1.0, 0.0, -1.0, 0.0, 1.75, 0.0];
        let line = |x: f64| [2.0, x, 0.0, x, 1.0];
        assert_eq!(numbers(Part::Moving(&moved)), [&style[..], &line(2.0)].concat());
        let rest = [&style[..], &line(1.0), &line(3.0)].concat();
        assert_eq!(numbers(Part::Still(&moved)), rest);
        assert_eq!(numbers(Part::Moving(&MovedView::Everything)), numbers(Part::Whole));
        assert!(numbers(Part::Still(&MovedView::Everything)).is_empty());
    }

    #[test]
    fn an_empty_picture_is_an_empty_list() {
        assert_eq!(
            display_list(&PictureView::default(), Part::Whole, &[]),
            super::DisplayList::default()
        );
    }

    #[test]
    fn a_ghost_lies_on_the_sheet_dashed() {
        let elements = vec![element(segment(1.0), Layer::Lines, Style::default())];
        let mut list = super::DisplayList::default();
        super::ghosts(&mut list, &[Drawing { elements, ..Drawing::default() }]);
        let (begun, drawn) = list.numbers.split_at(6);
        assert_eq!(begun[3], super::line_number(super::Line::Dashed));
        assert_eq!(begun[5], 0.0);
        assert_eq!(drawn, [2.0, 1.0, 0.0, 1.0, 1.0]);
    }

    #[test]
    fn lines_of_one_style_are_one_path_whatever_their_order() {
        let faint = Style { color: Color::Faint, ..Style::default() };
        let elements = vec![
            element(segment(1.0), Layer::Lines, Style::default()),
            element(segment(2.0), Layer::Lines, faint),
            element(segment(3.0), Layer::Lines, Style::default()),
        ];
        let list = display_list(&picture(elements, None), Part::Whole, &[]);
        assert_eq!(
            list.numbers,
            [
                [1.0, 0.0, -1.0, 0.0, 1.75, 0.0].as_slice(),
                &[2.0, 1.0, 0.0, 1.0, 1.0],
                &[2.0, 3.0, 0.0, 3.0, 1.0],
                &[1.0, 1.0, -1.0, 0.0, 1.75, 0.0],
                &[2.0, 2.0, 0.0, 2.0, 1.0],
            ]
            .concat()
        );
    }

    #[test]
    fn fills_keep_their_order_because_they_hide_what_is_behind() {
        let filled = Style { fill: Some(Color::Named(String::from("red"))), ..Style::default() };
        let elements = vec![
            element(segment(1.0), Layer::Lines, Style::default()),
            element(segment(2.0), Layer::Lines, filled),
            element(segment(3.0), Layer::Lines, Style::default()),
        ];
        let list = display_list(&picture(elements, None), Part::Whole, &[]);
        let order: Vec<f64> = list
            .numbers
            .windows(5)
            .filter(|w| w[0] == 2.0 && w[1] == w[3] && w[2] == 0.0 && w[4] == 1.0)
            .map(|w| w[1])
            .collect();
        assert_eq!(order, [1.0, 2.0, 3.0]);
        assert_eq!(list.colors, ["red"]);
    }

    #[test]
    fn a_point_in_conflict_is_a_red_cross_and_a_free_one_a_blue_disc() {
        let dots = || vec![element(Shape::Dot(Point::default()), Layer::Points, Style::default())];
        let free = display_list(&picture(dots(), Some(Freedom::Free)), Part::Whole, &[]).numbers;
        assert_eq!((free[2], free[6], free[7]), (4.0, 5.0, 0.0));
        let wrong =
            display_list(&picture(dots(), Some(Freedom::Conflicting)), Part::Whole, &[]).numbers;
        assert_eq!((wrong[12], wrong[18]), (6.0, 2.0));
    }

    #[test]
    fn a_grip_without_a_point_of_its_own_is_painted_as_one() {
        let freedom = Some(Freedom::Free);
        let grip = Grip { path: String::from("p"), x: 3.0, y: 4.0, freedom, ..Grip::default() };
        let lines = vec![element(segment(1.0), Layer::Lines, Style::default())];
        let bare = PictureView { grips: vec![grip.clone()], ..picture(lines, None) };
        let list = display_list(&bare, Part::Whole, &[]).numbers;
        assert_eq!(list[list.len() - 5..], [5.0, 0.0, 3.0, 4.0, super::POINT]);
        let dots = vec![element(Shape::Dot(Point::default()), Layer::Points, Style::default())];
        let plain = picture(dots, Some(Freedom::Free));
        let dotted = PictureView { grips: vec![grip], ..plain.clone() };
        assert_eq!(display_list(&dotted, Part::Whole, &[]), display_list(&plain, Part::Whole, &[]));
    }

    #[test]
    fn what_is_selected_has_a_halo_behind_it() {
        let elements = vec![element(segment(1.0), Layer::Lines, Style::default())];
        let plain =
            display_list(&picture(elements.clone(), None), Part::Whole, &[Mark::None]).numbers;
        let marked = display_list(&picture(elements, None), Part::Whole, &[Mark::Selected]).numbers;
        assert_eq!(&marked[..2], &[1.0, 8.0]);
        assert_eq!(&marked[marked.len() - plain.len()..], plain);
    }

    #[test]
    fn what_stands_outside_is_dimmed_below_the_rest() {
        let elements = [0, 1].map(|tag| {
            let shape = segment(f64::from(tag));
            Element { tag: Tag(tag), ..element(shape, Layer::Lines, Style::default()) }
        });
        let picture = PictureView {
            paths: vec![String::from("p"), String::from("q")],
            freedom: vec![None; 2],
            ..picture(elements.to_vec(), None)
        };
        let list = display_list(&picture, Part::Whole, &[Mark::None, Mark::Outside]);
        let style = [1.0, 0.0, -1.0, 0.0, 1.75, 0.0];
        let line = |x: f64| [2.0, x, 0.0, x, 1.0];
        let dimmed = [&[15.0, 0.4], &style[..], &line(1.0), &[15.0, 1.0]].concat();
        assert_eq!(list.numbers, [&dimmed[..], &style, &line(0.0)].concat());
        // nor does a point of it come to the front while something moves
        let grip = Grip {
            path: String::from("q"),
            x: 1.0,
            y: 0.0,
            anchored: false,
            drawn: false,
            freedom: None,
        };
        let picture = PictureView { grips: vec![grip], ..picture };
        let moved = MovedView::These { elements: vec![0], grips: Vec::new() };
        let marks = [Mark::None, Mark::Outside, Mark::Outside];
        let list = display_list(&picture, Part::Moving(&moved), &marks);
        assert_eq!(list.numbers, [&style[..], &line(0.0)].concat());
    }

    #[test]
    fn the_grid_covers_the_canvas_and_no_more() {
        let view = View { scale: 18.0, ..View::default() };
        let lines = grid(&view, (90.0, 36.0));
        // 6 lines across and 3 along, 5 numbers each, after two styles of 6.
        assert_eq!(lines.len(), 9 * 5 + 12);
    }
}
