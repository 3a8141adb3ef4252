//! Where the sheet lies on the screen: fit, pan, zoom, and the grid's spacing.
//!
//! Screen coordinates are CSS pixels from the canvas's top left corner, `y` down.

pub use drawing::Bounds;
use drawing::{Drawing, Point, Shape, Vertical};

/// The part of the sheet that one sees.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct View {
    /// CSS pixels for one unit of the sheet.
    pub scale: f64,
    /// Where the sheet's origin lies.
    pub x: f64,
    /// Where the sheet's origin lies.
    pub y: f64,
    /// Which way the sheet's `y` runs.
    pub vertical: Vertical,
}

impl Default for View {
    fn default() -> Self {
        Self { scale: 1.0, x: 0.0, y: 0.0, vertical: Vertical::Up }
    }
}

/// The scales between which one can zoom.
const SCALES: (f64, f64) = (1e-12, 1e12);

/// The shortest distance between two lines of the grid, in pixels.
const GRID_PIXELS: f64 = 18.0;

impl View {
    /// Pixels for one step along the sheet's `y`: negative where `y` runs up.
    pub fn scale_y(&self) -> f64 {
        match self.vertical {
            Vertical::Up => -self.scale,
            Vertical::Down => self.scale,
        }
    }
    /// Returns where a point of the sheet lies on the screen.
    pub fn screen_from_sheet(&self, p: Point) -> (f64, f64) {
        (self.x + self.scale * p.x, self.y + self.scale_y() * p.y)
    }
    /// Returns which point of the sheet lies there on the screen.
    pub fn sheet_from_screen(&self, (x, y): (f64, f64)) -> Point {
        Point { x: (x - self.x) / self.scale, y: (y - self.y) / self.scale_y() }
    }
    /// Returns the view with everything moved by some pixels.
    #[must_use]
    pub fn panned(self, dx: f64, dy: f64) -> Self {
        Self { x: self.x + dx, y: self.y + dy, ..self }
    }
    /// Returns the view of a sheet whose `y` runs some way; what lies at a height stays where it is.
    #[must_use]
    pub fn turned_over(self, vertical: Vertical, height: f64) -> Self {
        let turned = Self { vertical, ..self };
        Self { y: self.y + (self.scale_y() - turned.scale_y()) * height, ..turned }
    }
    /// Returns the view zoomed by a factor; what lies at `(x, y)` on the screen stays there.
    #[must_use]
    pub fn zoomed(self, factor: f64, (x, y): (f64, f64)) -> Self {
        let scale = (self.scale * factor).clamp(SCALES.0, SCALES.1);
        let kept = scale / self.scale;
        Self { scale, x: x + (self.x - x) * kept, y: y + (self.y - y) * kept, ..self }
    }
    /// Returns the grid of free places: the largest of 1, 2 and 5 times a power of ten that is 6 pixels or less.
    pub fn tidy(&self) -> f64 {
        const WIDEST: f64 = 6.0;
        let most = WIDEST / self.scale;
        let mut step = 1.0;
        while step > most {
            step /= 10.0;
        }
        while 10.0 * step <= most {
            step *= 10.0;
        }
        [5.0, 2.0].into_iter().map(|k| k * step).find(|&k| k <= most).unwrap_or(step)
    }

    /// Whether a box of the sheet is lost to who looks: outside of a canvas of that size, or less than a few pixels. A
    /// place alone is no smaller than it is elsewhere.
    pub fn loses(&self, drawn: Bounds, (width, height): (f64, f64)) -> bool {
        let ((ax, ay), (bx, by)) =
            (self.screen_from_sheet(drawn.least), self.screen_from_sheet(drawn.most));
        let is_outside = f64::max(ax, bx) < 0.0
            || f64::max(ay, by) < 0.0
            || f64::min(ax, bx) > width
            || f64::min(ay, by) > height;
        let size = f64::max((ax - bx).abs(), (ay - by).abs());
        is_outside || size > 0.0 && size < SMALLEST
    }

    /// Whether a box of the sheet lies wholly on a canvas of that size.
    pub fn holds(&self, drawn: Bounds, (width, height): (f64, f64)) -> bool {
        let ((ax, ay), (bx, by)) =
            (self.screen_from_sheet(drawn.least), self.screen_from_sheet(drawn.most));
        f64::min(ax, bx) >= 0.0
            && f64::min(ay, by) >= 0.0
            && f64::max(ax, bx) <= width
            && f64::max(ay, by) <= height
    }

    /// Returns the view with a box of the sheet on a canvas of that size: moved no further than it must be, and smaller
    /// only where the box is larger than the canvas.
    #[must_use]
    pub fn with_in_sight(self, drawn: Bounds, size: (f64, f64), margin: f64) -> Self {
        let wide = self.scale * (drawn.most.x - drawn.least.x);
        let high = self.scale * (drawn.most.y - drawn.least.y);
        if wide > size.0 || high > size.1 {
            return fit_box(drawn, self.vertical, size, margin);
        }
        let ((ax, ay), (bx, by)) =
            (self.screen_from_sheet(drawn.least), self.screen_from_sheet(drawn.most));
        // how far two ends are moved to lie on the canvas, with a margin as far as there is room for it
        let way = |a: f64, b: f64, across: f64| {
            let (least, most) = (f64::min(a, b), f64::max(a, b));
            if least >= 0.0 && most <= across {
                return 0.0;
            }
            let margin = margin.min((across - (most - least)) / 2.0);
            f64::max(margin - least, 0.0) + f64::min(across - margin - most, 0.0)
        };
        self.panned(way(ax, bx, size.0), way(ay, by, size.1))
    }

    /// Whether a canvas holds a box that is a good part of it: wide or high enough to work on.
    pub fn shows_well(&self, drawn: Bounds, (width, height): (f64, f64)) -> bool {
        let (wide, high) = (drawn.most.x - drawn.least.x, drawn.most.y - drawn.least.y);
        let part = self.scale * f64::max(wide / width, high / height);
        self.holds(drawn, (width, height)) && (part >= GOOD || part == 0.0)
    }

    /// Returns how many decimals a position has that a pointer can tell apart: a pixel or less.
    pub fn decimals(&self) -> usize {
        let (mut step, mut decimals) = (1.0, 0);
        while step > 1.0 / self.scale {
            step /= 10.0;
            decimals += 1;
        }
        decimals
    }
    /// Returns the distance between two lines of the grid, in the sheet's units: 1, 2 or 5 times a
    /// power of ten.
    pub fn grid_step(&self) -> f64 {
        let least = GRID_PIXELS / self.scale;
        let mut step = 1.0;
        while step > least {
            step /= 10.0;
        }
        while step < least {
            step *= 10.0;
        }
        [step / 5.0, step / 2.0].into_iter().find(|s| *s >= least).unwrap_or(step)
    }
}

/// How many millimetres a CSS pixel is: an inch has 96.
const MILLIMETRES_PER_PIXEL: f64 = 25.4 / 96.0;

/// Returns a scale as people say it: that of a drawing, `5 : 1` or `1 : 200`, where it is known how many millimetres a
/// unit of the sheet is; else how many pixels it has, in percent.
pub fn scale_in_words(scale: f64, millimetres: Option<f64>) -> String {
    let Some(millimetres) = millimetres else {
        let percent = 100.0 * scale;
        return match percent {
            // where nothing is left of whole percents, digits that count
            small if small < 1.0 => format!("{} %", base::number::significant(small, 2)),
            large if large >= 1e7 => format!("{large:.0e} %"),
            plain => format!("{plain:.0} %"),
        };
    };
    let times = scale * MILLIMETRES_PER_PIXEL / millimetres;
    let digits = |x: f64| base::number::significant(x, if x < 100.0 { 2 } else { 3 });
    let (large, small) = (digits(times), digits(1.0 / times));
    if times >= 1.0 { format!("{large} : 1") } else { format!("1 : {small}") }
}

/// The width and height of what a printed page has room for, in millimetres: A4 and Letter, upright, within margins and
/// under a title.
const PAGE: (f64, f64) = (170.0, 210.0);

/// Returns how many CSS pixels a unit of the sheet has where a drawing is printed as large as it is; nothing where a page
/// has no room for it, or it is not known how many millimetres a unit is.
pub fn printed_true(drawing: &Drawing, millimetres: Option<f64>) -> Option<f64> {
    let (millimetres, bounds) = (millimetres?, drawing::bounds(drawing)?);
    let (width, height) = (millimetres * bounds.width(), millimetres * bounds.height());
    (width <= PAGE.0 && height <= PAGE.1).then(|| millimetres / MILLIMETRES_PER_PIXEL)
}

/// What is a smaller part of a canvas is not looked at comfortably.
const GOOD: f64 = 0.2;

/// What is smaller as a whole is not seen as what it is, in pixels.
const SMALLEST: f64 = 12.0;

/// Returns the view that shows all of a drawing in the middle of a canvas of that size.
pub fn fit(drawing: &Drawing, size: (f64, f64), margin: f64) -> View {
    fit_box(bounds(drawing), drawing.vertical, size, margin)
}

/// Returns the view that shows a box of the sheet in the middle of a canvas of that size.
pub fn fit_box(
    bounds: Bounds,
    vertical: Vertical,
    (width, height): (f64, f64),
    margin: f64,
) -> View {
    let (w, h) = (bounds.most.x - bounds.least.x, bounds.most.y - bounds.least.y);
    let room = ((width - 2.0 * margin).max(1.0), (height - 2.0 * margin).max(1.0));
    let wanted = f64::min(
        if w > 0.0 { room.0 / w } else { f64::INFINITY },
        if h > 0.0 { room.1 / h } else { f64::INFINITY },
    );
    let scale = if wanted.is_finite() { wanted.clamp(SCALES.0, SCALES.1) } else { 1.0 };
    let view = View { scale, x: 0.0, y: 0.0, vertical };
    let middle = Point { x: bounds.least.x + w / 2.0, y: bounds.least.y + h / 2.0 };
    let (x, y) = view.screen_from_sheet(middle);
    view.panned(width / 2.0 - x, height / 2.0 - y)
}

/// Returns a view in which words of a constant size, which stand beside their places, are in sight as well: a little
/// smaller, where little hangs over the sides of a canvas.
pub fn with_words(drawing: &Drawing, view: View, size: (f64, f64)) -> View {
    // places move less than the sides: what is left over is little the second time, and nothing the third
    (0..3).fold(view, |view, _| nearer_with_words(drawing, view, size))
}

fn nearer_with_words(drawing: &Drawing, view: View, (width, height): (f64, f64)) -> View {
    let [mut left, mut right, mut above, mut below] = [0.0_f64; 4];
    for element in &drawing.elements {
        let Shape::Text { at, text, anchoring, placement, turn } = &element.shape else { continue };
        let drawing::Placement::OnScreen(size) = placement else { continue };
        let lie = drawing::Lie { at: *at, turn: *turn, vertical: drawing.vertical };
        let (at, start) = (view.screen_from_sheet(*at), anchoring.start(text, *size, lie));
        let (start, base) = (at.0 + start.0, at.1 + start.1);
        let end = start + drawing::metrics::text_width(text, *size);
        left = left.max(BESIDE - start);
        right = right.max(end + BESIDE - width);
        above = above.max(size + EDGE - base);
        below = below.max(base + EDGE - height);
    }
    // words of a picture that is hardly larger than they are stay over its sides
    let fits = |over: f64, size: f64| if over <= 0.4 * size { over } else { 0.0 };
    let (wide, high) = (fits(left + right, width), fits(above + below, height));
    if wide + high <= 0.0 {
        return view;
    }
    let scale = f64::min(width / (width + wide), height / (height + high));
    let smaller = view.zoomed(scale, (width / 2.0, height / 2.0));
    let aside = |a: f64, b: f64, over: f64| if over > 0.0 { (a - b) / 2.0 } else { 0.0 };
    smaller.panned(aside(left, right, wide), aside(above, below, high))
}

/// How far words are from the upper and lower side of a canvas, in pixels.
const EDGE: f64 = 4.0;

/// How far words stand beside their places, and from the side of a canvas, in pixels.
const BESIDE: f64 = 14.0;

/// Returns the box around a drawing; around the origin if it is empty. Words count with their
/// position and, where they lie on the sheet, an estimate of their size.
pub fn bounds(drawing: &Drawing) -> Bounds {
    let mut all: Option<Bounds> = None;
    let mut add = |x: f64, y: f64| {
        if !(x.is_finite() && y.is_finite()) {
            return;
        }
        let b = all.get_or_insert(Bounds { least: Point { x, y }, most: Point { x, y } });
        b.least = Point { x: b.least.x.min(x), y: b.least.y.min(y) };
        b.most = Point { x: b.most.x.max(x), y: b.most.y.max(y) };
    };
    for element in &drawing.elements {
        match &element.shape {
            Shape::Dot(p) => add(p.x, p.y),
            Shape::Segment(p, q) => {
                add(p.x, p.y);
                add(q.x, q.y);
            }
            Shape::Polyline { points, .. } => points.iter().for_each(|p| add(p.x, p.y)),
            Shape::Circle { center, radius } | Shape::Arc { center, radius, .. } => {
                add(center.x - radius, center.y - radius);
                add(center.x + radius, center.y + radius);
            }
            Shape::Ellipse { .. } | Shape::Spline(_) | Shape::Nurbs(_) | Shape::Region(_) => {
                add_whole(element, drawing.vertical, &mut add);
            }
            Shape::Text { turn, anchoring, .. }
                if *turn != 0.0 || matches!(anchoring, drawing::Anchoring::Away(_)) =>
            {
                add_whole(element, drawing.vertical, &mut add);
            }
            Shape::Text { at, text, anchoring, placement, .. } => {
                let height = match placement {
                    drawing::Placement::OnSheet(height) => *height,
                    drawing::Placement::OnScreen(_) => 0.0,
                };
                let width = drawing::metrics::text_width(text, height);
                let lie = drawing::Lie { at: *at, turn: 0.0, vertical: drawing.vertical };
                let left = at.x + anchoring.start(text, height, lie).0;
                add(left, at.y - height);
                add(left + width, at.y + height);
            }
        }
    }
    all.unwrap_or(Bounds { least: Point::default(), most: Point::default() })
}

/// Adds the corners of the box around one element.
fn add_whole(element: &drawing::Element, vertical: Vertical, add: &mut dyn FnMut(f64, f64)) {
    let one = Drawing { elements: vec![element.clone()], vertical };
    if let Some(b) = drawing::bounds(&one) {
        add(b.least.x, b.least.y);
        add(b.most.x, b.most.y);
    }
}

#[cfg(test)]
mod tests {
    use super::{View, fit};
    use drawing::{Drawing, Element, Layer, Point, Shape, Style, Tag, Vertical};

    fn dots(points: &[(f64, f64)], vertical: Vertical) -> Drawing {
        let element = |&(x, y): &(f64, f64)| Element {
            shape: Shape::Dot(Point { x, y }),
            style: Style::default(),
            layer: Layer::Points,
            tag: Tag(0),
        };
        Drawing { elements: points.iter().map(element).collect(), vertical }
    }

    #[test]
    fn a_drawing_of_a_few_pixels_is_lost_and_one_place_is_not() {
        let view = View { scale: 1.0, x: 0.0, y: 0.0, vertical: Vertical::Down };
        let lost = |points: &[(f64, f64)]| {
            view.loses(super::bounds(&dots(points, Vertical::Down)), (400.0, 300.0))
        };
        assert!(lost(&[(100.0, 100.0), (103.0, 101.0)]));
        assert!(lost(&[(500.0, 100.0), (700.0, 200.0)]));
        assert!(!lost(&[(100.0, 100.0), (100.0, 160.0)]));
        assert!(!lost(&[(100.0, 100.0)]));
    }

    #[test]
    fn what_a_panel_hides_is_moved_into_sight_and_not_made_larger() {
        let view = View { scale: 2.0, x: 0.0, y: 0.0, vertical: Vertical::Down };
        let seen = |points: &[(f64, f64)], size: (f64, f64)| {
            view.with_in_sight(super::bounds(&dots(points, Vertical::Down)), size, 20.0)
        };
        assert_eq!(seen(&[(10.0, 10.0), (90.0, 40.0)], (200.0, 100.0)), view);
        let small = seen(&[(10.0, 240.0), (20.0, 250.0)], (400.0, 300.0));
        assert_eq!(small, view.panned(0.0, 280.0 - 500.0));
        assert_eq!(seen(&[(10.0, 240.0)], (400.0, 300.0)), view.panned(0.0, 280.0 - 480.0));
        let large = seen(&[(0.0, 0.0), (400.0, 100.0)], (400.0, 300.0));
        assert!(large.scale < view.scale);
        // what barely fits has what room there is
        assert_eq!(seen(&[(0.0, 100.0), (10.0, 245.0)], (400.0, 300.0)), view.panned(0.0, -195.0));
    }

    #[test]
    fn a_small_part_of_a_sheet_in_millimetres_is_not_shown_well() {
        let size = (1000.0, 800.0);
        let box_of = |w: f64, h: f64| {
            super::bounds(&dots(&[(10.0, 10.0), (10.0 + w, 10.0 + h)], Vertical::Down))
        };
        let at = |scale: f64| View { scale, vertical: Vertical::Down, ..View::default() };
        assert!(!at(1.0).shows_well(box_of(30.0, 20.0), size));
        assert!(at(10.0).shows_well(box_of(30.0, 20.0), size));
        assert!(!at(40.0).shows_well(box_of(30.0, 20.0), size), "it reaches over the side");
        assert!(at(1.0).shows_well(box_of(0.0, 0.0), size), "a place has no size");
    }

    #[test]
    fn words_beside_their_places_are_in_sight() {
        let mut drawing = dots(&[(0.0, 0.0), (100.0, 50.0)], Vertical::Down);
        drawing.elements.push(Element {
            shape: Shape::Text {
                at: Point { x: 100.0, y: 25.0 },
                text: "0.75 V".into(),
                anchoring: drawing::Anchoring::default(),
                placement: drawing::Placement::OnScreen(13.0),
                turn: 0.0,
            },
            style: Style::default(),
            layer: Layer::Words,
            tag: Tag(0),
        });
        let size = (390.0, 600.0);
        let bare = fit(&drawing, size, 30.0);
        let view = super::with_words(&drawing, bare, size);
        let end = |view: &View| {
            let (x, _) = view.screen_from_sheet(Point { x: 100.0, y: 25.0 });
            x + 7.0 + drawing::metrics::text_width("0.75 V", 13.0)
        };
        assert!(end(&bare) > 390.0 && end(&view) <= 390.0, "{} {}", end(&bare), end(&view));
        assert!(view.scale > 0.8 * bare.scale);
        assert_eq!(super::with_words(&dots(&[(0.0, 0.0)], Vertical::Up), bare, size), bare);
    }

    #[test]
    fn words_above_a_picture_are_in_sight() {
        let mut drawing = dots(&[(0.0, 0.0), (100.0, 0.0)], Vertical::Down);
        drawing.elements.push(Element {
            shape: Shape::Text {
                at: Point { x: 50.0, y: -30.0 },
                text: "0 V".into(),
                anchoring: drawing::Anchoring::default(),
                placement: drawing::Placement::OnScreen(13.0),
                turn: 0.0,
            },
            style: Style::default(),
            layer: Layer::Words,
            tag: Tag(0),
        });
        let size = (120.0, 50.0);
        let view = super::with_words(&drawing, fit(&drawing, size, 8.0), size);
        let (_, base) = view.screen_from_sheet(Point { x: 50.0, y: -30.0 });
        assert!(base >= 16.5, "a letter's height and the distance from the side: {base}");
    }

    #[test]
    fn an_empty_drawing_and_a_single_point_lie_in_the_middle() {
        let empty = fit(&dots(&[], Vertical::Up), (400.0, 300.0), 20.0);
        assert_eq!(empty.screen_from_sheet(Point { x: 0.0, y: 0.0 }), (200.0, 150.0));
        let one = fit(&dots(&[(7.0, 9.0)], Vertical::Down), (400.0, 300.0), 20.0);
        assert_eq!(one.scale, 1.0);
        assert_eq!(one.screen_from_sheet(Point { x: 7.0, y: 9.0 }), (200.0, 150.0));
    }

    #[test]
    fn numbers_that_are_not_finite_do_not_spoil_the_fit() {
        let view = fit(
            &dots(&[(0.0, 0.0), (f64::NAN, 1.0), (100.0, 0.0)], Vertical::Up),
            (140.0, 140.0),
            20.0,
        );
        assert_eq!(view.scale, 1.0);
    }

    #[test]
    fn up_is_up() {
        let up = fit(&dots(&[(0.0, 0.0), (10.0, 10.0)], Vertical::Up), (100.0, 100.0), 0.0);
        assert_eq!(up.screen_from_sheet(Point { x: 0.0, y: 10.0 }), (0.0, 0.0));
        let down = fit(&dots(&[(0.0, 0.0), (10.0, 10.0)], Vertical::Down), (100.0, 100.0), 0.0);
        assert_eq!(down.screen_from_sheet(Point { x: 0.0, y: 10.0 }), (0.0, 100.0));
    }

    #[test]
    fn zooming_keeps_what_is_under_the_cursor() {
        let view = View { scale: 2.0, x: 30.0, y: 40.0, vertical: Vertical::Up };
        let before = view.sheet_from_screen((100.0, 80.0));
        let after = view.zoomed(1.5, (100.0, 80.0)).sheet_from_screen((100.0, 80.0));
        assert!((before.x - after.x).abs() < 1e-12 && (before.y - after.y).abs() < 1e-12);
    }

    #[test]
    fn a_sheet_of_known_size_tells_its_scale_as_a_drawing_does() {
        let pixels_per_millimetre = 96.0 / 25.4;
        for (scale, millimetres, says) in [
            (169.92, Some(1.0), "45 : 1"),
            (pixels_per_millimetre, Some(1.0), "1 : 1"),
            (0.02 * pixels_per_millimetre, Some(1.0), "1 : 50"),
            (30.0, Some(1000.0), "1 : 126"),
            (1.5, None, "150 %"),
            (1e-9, None, "1e-7 %"),
            (2e9, None, "2e11 %"),
        ] {
            assert_eq!(super::scale_in_words(scale, millimetres), says);
        }
    }

    #[test]
    fn what_a_page_has_room_for_is_printed_as_large_as_it_is() {
        let drawn = dots(&[(0.0, 0.0), (80.0, 50.0)], Vertical::Up);
        let scale = super::printed_true(&drawn, Some(1.0)).expect("a page has room for it");
        assert!((scale - 96.0 / 25.4).abs() < 1e-12, "{scale}");
        assert_eq!(super::printed_true(&drawn, Some(10.0)), None, "80 cm are wider than a page");
        assert_eq!(super::printed_true(&drawn, None), None);
    }

    #[test]
    fn a_place_at_full_size_is_in_whole_units() {
        for (scale, decimals) in [(0.004, 0), (0.5, 0), (1.0, 0), (5.0, 1), (11.0, 2)] {
            assert_eq!(View { scale, ..View::default() }.decimals(), decimals, "at {scale}");
        }
    }

    #[test]
    fn the_grid_keeps_its_lines_apart() {
        for (scale, step) in [(1.0, 20.0), (18.0, 1.0), (17.0, 2.0), (0.01, 2000.0), (400.0, 0.05)]
        {
            let found = View { scale, ..View::default() }.grid_step();
            assert!((found / step - 1.0).abs() < 1e-9, "{scale}: {found}, not {step}");
        }
    }
}
