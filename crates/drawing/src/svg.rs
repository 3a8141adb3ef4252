//! The SVG writer: a drawing in, a document for browsers and printers out.
//!
//! The same drawing gives the same bytes. Where `y` runs up, coordinates are negated and nothing is
//! mirrored. Colours are classes with a light and a dark meaning; strokes keep their width.

use crate::bounds::{Bounds, bounds, point_on_circle};
use crate::element::{
    Anchoring, Color, Corner, Drawing, Element, Lie, Line, Placement, Point, Shape, Style, Tag,
    Vertical,
};
use crate::{curve, metrics, spline};
use base::number::{atan2, rounded, shortest, significant};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// The frame of a picture has so many digits.
const FRAME: usize = 9;

/// How a drawing is written.
#[derive(Clone, Copy)]
pub struct SvgOptions<'a> {
    /// How many pixels a unit of the sheet has.
    pub pixels_per_unit: f64,
    /// Free space on every side, in pixels.
    pub margin: f64,
    /// What a screen reader says of it, if anything.
    pub title: Option<&'a str>,
    /// The path of the thing that a tag stands for, written as `data-path`.
    pub path: &'a dyn Fn(Tag) -> Option<String>,
}

impl std::fmt::Debug for SvgOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SvgOptions")
            .field("pixels_per_unit", &self.pixels_per_unit)
            .field("margin", &self.margin)
            .field("title", &self.title)
            .finish_non_exhaustive()
    }
}

impl Default for SvgOptions<'_> {
    fn default() -> Self {
        Self { pixels_per_unit: 1.0, margin: 16.0, title: None, path: &|_| None }
    }
}

/// The light and the dark meaning of the colours that a document does not name.
const COLORS: [(&str, &str, &str); 3] = [
    ("ink", "#1f2328", "#e6e6e6"),
    ("faint", "#8a919a", "#7d848c"),
    ("accent", "#b3401a", "#ff9a63"),
];

/// How large a dot is, in pixels.
const DOT: f64 = 7.0;

/// How wide a line is where its style does not say, in pixels.
const STROKE: f64 = 1.5;

/// Writes a drawing as an SVG document, in layers from back to front.
///
/// ```
/// use drawing::{Drawing, Element, Point, Shape, svg};
/// let line = Shape::Segment(Point { x: 0.0, y: 0.0 }, Point { x: 30.0, y: 10.0 });
/// let drawing = Drawing { elements: vec![Element::new(line)], ..Drawing::default() };
/// let text = svg::write(&drawing, &svg::SvgOptions::default());
/// assert!(text.contains(r#"x1="0" y1="0" x2="30" y2="-10""#));
/// ```
pub fn write(drawing: &Drawing, options: &SvgOptions<'_>) -> String {
    let origin = Point::default();
    let around = with_labels(bounds(drawing).unwrap_or(Bounds::at(origin)), drawing, options);
    let margin = options.margin / options.pixels_per_unit;
    let top = match drawing.vertical {
        Vertical::Up => -around.most.y,
        Vertical::Down => around.least.y,
    };
    let (width, height) = (around.width() + 2.0 * margin, around.height() + 2.0 * margin);
    let mut out = String::new();
    let pixels = |length: f64| rounded(length * options.pixels_per_unit, 2);
    // how much is in sight is a matter of the eye
    let framed = |length: f64| significant(length, FRAME);
    line(
        &mut out,
        format_args!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="{} {} {} {}" width="{}" height="{}" role="img">"#,
            framed(around.least.x - margin),
            framed(top - margin),
            framed(width),
            framed(height),
            pixels(width),
            pixels(height),
        ),
    );
    if let Some(title) = options.title {
        line(&mut out, format_args!("<title>{}</title>", escaped(title)));
    }
    line(&mut out, format_args!("<style>{}</style>", style_sheet()));
    let mut elements: Vec<&Element> = drawing.elements.iter().collect();
    elements.sort_by_key(|e| e.layer);
    for element in elements {
        write_element(&mut out, element, drawing.vertical, options);
    }
    out.push_str("</svg>\n");
    out
}

fn line(out: &mut String, text: std::fmt::Arguments<'_>) {
    out.write_fmt(text).expect("a string takes any text");
    out.push('\n');
}

fn style_sheet() -> String {
    let mut light = String::from(
        "line,path,circle,polyline,polygon{fill:none;stroke-linejoin:round;vector-effect:non-scaling-stroke}text{font-family:Helvetica,Arial,sans-serif}",
    );
    let mut dark = String::new();
    for (name, on_light, on_dark) in COLORS {
        for (out, color) in [(&mut light, on_light), (&mut dark, on_dark)] {
            let rule = format!(".{name}{{stroke:{color}}}.on-{name}{{fill:{color}}}");
            out.push_str(&rule);
        }
    }
    format!("{light}@media(prefers-color-scheme:dark){{{dark}}}")
}

/// Returns a text as XML may hold it: markup escaped, characters that XML forbids left out.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\t' | '\n' => out.push(c),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => {}
            _ => out.push(c),
        }
    }
    out
}

fn write_element(
    out: &mut String,
    element: &Element,
    vertical: Vertical,
    options: &SvgOptions<'_>,
) {
    let p = |p: Point| match vertical {
        Vertical::Up => (shortest(p.x), shortest(-p.y)),
        Vertical::Down => (shortest(p.x), shortest(p.y)),
    };
    let look = looks(element, (options.path)(element.tag));
    match &element.shape {
        Shape::Dot(at) => {
            let (x, y) = p(*at);
            line(out, format_args!(r#"<path d="M{x} {y}h0"{look} stroke-linecap="round"/>"#));
        }
        Shape::Segment(a, b) => {
            let ((x1, y1), (x2, y2)) = (p(*a), p(*b));
            line(out, format_args!(r#"<line x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"{look}/>"#));
        }
        Shape::Polyline { points, closed } => {
            let name = if *closed { "polygon" } else { "polyline" };
            let corners: Vec<String> =
                points.iter().map(|&q| p(q)).map(|(x, y)| format!("{x},{y}")).collect();
            line(out, format_args!(r#"<{name} points="{}"{look}/>"#, corners.join(" ")));
        }
        Shape::Circle { center, radius } => {
            let (x, y) = p(*center);
            let r = shortest(*radius);
            line(out, format_args!(r#"<circle cx="{x}" cy="{y}" r="{r}"{look}/>"#));
        }
        Shape::Arc { center, radius, sweep, .. } if sweep.abs() >= TAU => {
            let shape = Shape::Circle { center: *center, radius: *radius };
            write_element(out, &Element { shape, ..element.clone() }, vertical, options);
        }
        Shape::Arc { center, radius, start, sweep } => {
            let (x1, y1) = p(point_on_circle(*center, *radius, *start));
            let (x2, y2) = p(point_on_circle(*center, *radius, *start + *sweep));
            let r = shortest(*radius);
            let long = u8::from(sweep.abs() > TAU / 2.0);
            // On paper whose y runs down, positive angles turn clockwise, which SVG calls 1.
            let clockwise = u8::from((*sweep > 0.0) == (vertical == Vertical::Down));
            line(
                out,
                format_args!(
                    r#"<path d="M{x1} {y1}A{r} {r} 0 {long} {clockwise} {x2} {y2}"{look}/>"#
                ),
            );
        }
        Shape::Ellipse { center, major, ratio, start, sweep } => {
            let data = ellipse_data((*center, *major, *ratio), (*start, *sweep), vertical);
            line(out, format_args!(r#"<path d="{data}"{look}/>"#));
        }
        Shape::Spline(poles) => {
            line(out, format_args!(r#"<path d="{}"{look}/>"#, spline_data(poles, vertical)));
        }
        Shape::Nurbs(curve) => {
            let data = spline_data(&curve.cubics(), vertical);
            line(out, format_args!(r#"<path d="{data}"{look}/>"#));
        }
        Shape::Region(rings) => {
            let data: String = rings.iter().map(|ring| ring_data(ring, vertical)).collect();
            line(out, format_args!(r#"<path d="{data}" fill-rule="evenodd"{look}/>"#));
        }
        Shape::Text { at, text, anchoring, placement, turn } => {
            let size = match placement {
                Placement::OnSheet(size) => *size,
                Placement::OnScreen(pixels) => pixels / options.pixels_per_unit,
            };
            // words on the sheet are as wide as the measure that the document goes by
            let width = match placement {
                Placement::OnSheet(size) if !text.contains('\n') => {
                    let width = shortest(metrics::text_width(text, *size));
                    format!(r#" textLength="{width}" lengthAdjust="spacingAndGlyphs""#)
                }
                Placement::OnSheet(_) | Placement::OnScreen(_) => String::new(),
            };
            let turned = if *turn == 0.0 {
                String::new()
            } else {
                let turn = if vertical == Vertical::Up { -turn } else { *turn };
                let turn = shortest(turn.to_degrees());
                let (x, y) = p(*at);
                format!(r#" transform="rotate({turn} {x} {y})""#)
            };
            // `y` runs down here, and what is turned is turned around its position
            let sign = if vertical == Vertical::Up { -1.0 } else { 1.0 };
            let (right, down) = anchoring.held(text, size, Lie { at: *at, turn: *turn, vertical });
            let (x, line) = (shortest(at.x + right), shortest(sign * at.y + down));
            let look = format!("{width}{turned}{look}");
            write_text(out, (&x, &line), text, *anchoring, size, &look);
        }
    }
}

/// Returns a point as SVG has it, whose `y` runs down.
fn placed(p: Point, vertical: Vertical) -> String {
    let y = if vertical == Vertical::Up { -p.y } else { p.y };
    format!("{} {}", shortest(p.x), shortest(y))
}

/// Returns an arc's part of a path, to its end; `ratio` is that of its half axes.
fn arc_data(
    (rx, ry, turned): (f64, f64, f64),
    sweep: f64,
    end: &str,
    vertical: Vertical,
) -> String {
    let long = u8::from(sweep.abs() > TAU / 2.0);
    let clockwise = u8::from((sweep > 0.0) == (vertical == Vertical::Down));
    let turned = if vertical == Vertical::Up { -turned } else { turned };
    let [rx, ry, turned] = [rx, ry, turned.to_degrees()].map(shortest);
    format!("A{rx} {ry} {turned} {long} {clockwise} {end}")
}

/// Returns Bézier curves as a path.
fn spline_data(poles: &[Point], vertical: Vertical) -> String {
    let Some(first) = poles.first() else { return String::new() };
    let mut data = format!("M{}", placed(*first, vertical));
    for [_, p, q, r] in spline::pieces(poles) {
        let [p, q, r] = [p, q, r].map(|p| placed(p, vertical));
        data += &format!("C{p} {q} {r}");
    }
    data
}

/// Returns a closed ring as a path.
fn ring_data(ring: &[Corner], vertical: Vertical) -> String {
    let Some(first) = ring.first() else { return String::new() };
    let mut data = format!("M{}", placed(first.at, vertical));
    let next = ring.iter().skip(1).chain(ring.first());
    for (edge, to) in curve::edges(ring).zip(next) {
        let end = placed(to.at, vertical);
        data += &match edge {
            Shape::Arc { radius, sweep, .. } => {
                arc_data((radius, radius, 0.0), sweep, &end, vertical)
            }
            Shape::Spline(poles) => {
                let [p, q] = [poles[1], poles[2]].map(|p| placed(p, vertical));
                format!("C{p} {q} {end}")
            }
            _ => format!("L{end}"),
        };
    }
    data.push('Z');
    data
}

/// Returns an elliptic arc as a path: in two parts, since SVG draws no whole turn in one.
fn ellipse_data(
    (center, major, ratio): (Point, Point, f64),
    (start, sweep): (f64, f64),
    vertical: Vertical,
) -> String {
    let sweep = sweep.clamp(-TAU, TAU);
    let at =
        |part: f64| placed(curve::on_ellipse(center, major, ratio, start + part * sweep), vertical);
    let length = curve::half_axis(major);
    let axes = (length, ratio * length, atan2(major.y, major.x));
    let half = |end: &str| arc_data(axes, 0.5 * sweep, end, vertical);
    format!("M{}{}{}", at(0.0), half(&at(0.5)), half(&at(1.0)))
}

/// Widens a box by words of a constant size on the screen, as large as they are in this file.
fn with_labels(around: Bounds, drawing: &Drawing, options: &SvgOptions<'_>) -> Bounds {
    drawing.elements.iter().fold(around, |around, element| match &element.shape {
        Shape::Text { at, text, anchoring, placement: Placement::OnScreen(pixels), turn } => {
            let size = pixels / options.pixels_per_unit;
            let width = metrics::text_width(text, size);
            let lie = Lie { at: *at, turn: *turn, vertical: drawing.vertical };
            let (left, down) = anchoring.start(text, size, lie);
            let down = if drawing.vertical == Vertical::Up { -down } else { down };
            let corner = Point { x: at.x + left, y: at.y + down };
            around.with(corner).with(Point { x: corner.x + width, ..corner })
        }
        Shape::Text { .. }
        | Shape::Dot(_)
        | Shape::Segment(..)
        | Shape::Polyline { .. }
        | Shape::Circle { .. }
        | Shape::Arc { .. }
        | Shape::Ellipse { .. }
        | Shape::Spline(_)
        | Shape::Nurbs(_)
        | Shape::Region(_) => around,
    })
}

fn write_text(
    out: &mut String,
    (x, y): (&str, &str),
    text: &str,
    anchoring: Anchoring,
    size: f64,
    look: &str,
) {
    let anchor = match anchoring {
        Anchoring::Start => "",
        Anchoring::Middle | Anchoring::Center | Anchoring::Away(_) => r#" text-anchor="middle""#,
        Anchoring::End => r#" text-anchor="end""#,
    };
    let step = shortest(metrics::LINE_HEIGHT * size);
    let mut lines = String::new();
    for (i, words) in text.split('\n').enumerate() {
        let words = escaped(words);
        let tspan = format!(r#"<tspan x="{x}" dy="{step}">{words}</tspan>"#);
        lines.push_str(if i == 0 { &words } else { &tspan });
    }
    let size = shortest(size);
    line(
        out,
        format_args!(r#"<text x="{x}" y="{y}" font-size="{size}"{anchor}{look}>{lines}</text>"#),
    );
}

/// Writes the attributes that say how an element looks and what it pictures.
fn looks(element: &Element, path: Option<String>) -> String {
    let Style { color, fill, line, width, sheet_layer, dimension: _, is_unbounded: _ } =
        &element.style;
    let mut classes = Vec::new();
    let mut attributes = String::new();
    let mut add = |name: &str, value: &str| {
        write!(attributes, r#" {name}="{}""#, escaped(value)).expect("a string takes any text");
    };
    // A document's own colour is said in `style`, which is stronger than the style sheet.
    let mut own = String::new();
    let words = matches!(element.shape, Shape::Text { .. });
    let dot = matches!(element.shape, Shape::Dot(_));
    if words || *line != Line::None {
        match (color_class(color), words) {
            (Ok(class), true) => classes.push(format!("on-{class}")),
            (Ok(class), false) => classes.push(class.to_string()),
            (Err(name), true) => own.push_str(&format!("fill:{name};")),
            (Err(name), false) => own.push_str(&format!("stroke:{name};")),
        }
    }
    if let (Some(fill), false) = (fill, words) {
        match color_class(fill) {
            Ok(class) => classes.push(format!("on-{class}")),
            Err(name) => own.push_str(&format!("fill:{name};")),
        }
    }
    if !words && *line != Line::None {
        let usual = if dot { DOT } else { STROKE };
        let width = if *width > 0.0 && !dot { *width } else { usual };
        add("stroke-width", &shortest(width));
        match line {
            Line::Dashed if !dot => add("stroke-dasharray", "6 4"),
            Line::Dotted if !dot => add("stroke-dasharray", "1.5 4"),
            Line::Chained if !dot => add("stroke-dasharray", "14 3 3 3"),
            Line::Solid | Line::Dashed | Line::Dotted | Line::Chained | Line::None => {}
        }
    }
    if !classes.is_empty() {
        add("class", &classes.join(" "));
    }
    if !own.is_empty() {
        add("style", own.trim_end_matches(';'));
    }
    if let Some(layer) = sheet_layer {
        add("data-layer", layer);
    }
    if let Some(path) = path {
        add("data-path", &path);
    }
    attributes
}

/// Returns the class of a colour, or the document's own name for it.
fn color_class(color: &Color) -> Result<&'static str, String> {
    match color {
        Color::Ink => Ok("ink"),
        Color::Faint => Ok("faint"),
        Color::Accent => Ok("accent"),
        // Only what can be part of a colour: a name in quotes or with `;` would be another rule.
        Color::Named(name) => {
            let allowed = |c: &char| c.is_ascii_alphanumeric() || "#(),.% ".contains(*c);
            Err(name.chars().filter(allowed).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::element::Layer;
    use std::f64::consts::FRAC_PI_2;

    fn drawn(element: Element, vertical: Vertical) -> String {
        write(&Drawing { elements: vec![element], vertical }, &SvgOptions::default())
    }
    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    #[test]
    fn an_empty_drawing_is_its_margin() {
        let text = write(&Drawing::default(), &SvgOptions::default());
        assert!(text.contains(r#"viewBox="-16 -16 32 32" width="32""#), "{text}");
    }
    #[test]
    fn arcs_turn_the_way_that_y_runs() {
        let arc = Shape::Arc { center: p(0.0, 0.0), radius: 10.0, start: 0.0, sweep: FRAC_PI_2 };
        let up = drawn(Element::new(arc.clone()), Vertical::Up);
        assert!(up.contains("M10 0A10 10 0 0 0 ") && up.contains(" -10\""), "{up}");
        let down = drawn(Element::new(arc), Vertical::Down);
        assert!(down.contains("M10 0A10 10 0 0 1 ") && down.contains(" 10\""), "{down}");
    }
    #[test]
    fn a_whole_turn_is_a_circle() {
        let arc = Shape::Arc { center: p(1.0, 2.0), radius: 3.0, start: 1.0, sweep: -TAU };
        assert!(drawn(Element::new(arc), Vertical::Up).contains(r#"cx="1" cy="-2" r="3""#));
    }
    #[test]
    fn a_region_has_holes_and_arcs() {
        let at = |x, y, bulge| Corner::new(p(x, y), bulge);
        let outer = vec![at(0.0, 0.0, 0.0), at(4.0, 0.0, 1.0), at(4.0, 2.0, 0.0)];
        let hole = vec![at(1.0, 0.5, 0.0), at(2.0, 0.5, 0.0), at(2.0, 1.0, 0.0)];
        let out = drawn(Element::new(Shape::Region(vec![outer, hole])), Vertical::Up);
        assert!(out.contains(r#"d="M0 0L4 0A1 1 0 0 0 4 -2L0 0ZM1 -0.5L"#), "{out}");
        assert!(out.contains(r#"fill-rule="evenodd""#), "{out}");
    }
    #[test]
    fn an_ellipse_is_drawn_in_two_halves() {
        let (center, major) = (p(1.0, 0.0), p(2.0, 0.0));
        let shape = Shape::Ellipse { center, major, ratio: 0.5, start: 0.0, sweep: TAU };
        let out = drawn(Element::new(shape), Vertical::Up);
        assert!(out.contains(r#"d="M3 0A2 1 0 0 0 -1 "#), "{out}");
    }
    #[test]
    fn words_are_escaped_and_never_mirrored() {
        let text = Shape::Text {
            at: p(0.0, 5.0),
            text: "a<b & \"c\"\u{7}\nd".into(),
            anchoring: Anchoring::Middle,
            placement: Placement::OnSheet(10.0),
            turn: FRAC_PI_2,
        };
        let out = drawn(Element::new(text), Vertical::Up);
        assert!(out.contains(r#"transform="rotate(-90 0 -5)""#), "{out}");
        assert!(out.contains(r#"y="-5" font-size="10" text-anchor="middle""#), "{out}");
        assert!(
            out.contains(r#">a&lt;b &amp; &quot;c&quot;<tspan x="0" dy="12">d</tspan><"#),
            "{out}"
        );
        assert!(!out.contains("scale("));
    }
    #[test]
    fn words_in_the_middle_are_turned_around_it() {
        let text = Shape::Text {
            at: p(0.0, 5.0),
            text: "A".into(),
            anchoring: Anchoring::Center,
            placement: Placement::OnSheet(10.0),
            turn: FRAC_PI_2,
        };
        let out = drawn(Element::new(text), Vertical::Up);
        assert!(out.contains(r#"y="-1.41"#), "{out}");
        assert!(out.contains(r#"transform="rotate(-90 0 -5)""#), "{out}");
    }
    #[test]
    fn words_beyond_a_place_are_told_by_their_middle() {
        let text = |from| Shape::Text {
            at: p(1.0, 5.0),
            text: "MM".into(),
            anchoring: Anchoring::Away(from),
            placement: Placement::OnSheet(10.0),
            turn: 0.0,
        };
        // half as wide as they are, 16.66, and 3.5 between
        let out = drawn(Element::new(text(p(0.0, 5.0))), Vertical::Up);
        assert!(out.contains(r#"<text x="12.83" y="-1.41"#), "{out}");
        assert!(out.contains(r#"text-anchor="middle""#), "{out}");
        let above = drawn(Element::new(text(p(1.0, 0.0))), Vertical::Up);
        assert!(above.contains(r#"<text x="1" y="-8.5" "#), "{above}");
        let below = drawn(Element::new(text(p(1.0, 0.0))), Vertical::Down);
        assert!(below.contains(r#"<text x="1" y="15.68" "#), "{below}");
    }
    #[test]
    fn a_colour_is_no_way_into_the_markup() {
        let mut e = Element::new(Shape::Dot(p(0.0, 0.0)));
        e.style.color = Color::Named("red;\"/><script>".into());
        let out = drawn(e, Vertical::Up);
        assert!(out.contains(r#"style="stroke:redscript""#), "{out}");
    }
    #[test]
    fn layers_go_from_back_to_front_and_tags_become_paths() {
        let mut dot = Element::new(Shape::Dot(p(0.0, 0.0)));
        (dot.layer, dot.tag) = (Layer::Points, Tag(7));
        let line = Element::new(Shape::Segment(p(0.0, 0.0), p(1.0, 0.0)));
        let drawing = Drawing { elements: vec![dot, line], vertical: Vertical::Up };
        let path = |tag: Tag| (tag.0 == 7).then(|| "a.\"b".to_string());
        let out = write(&drawing, &SvgOptions { path: &path, ..SvgOptions::default() });
        assert!(out.find("<line").unwrap() < out.find("h0").unwrap(), "{out}");
        assert!(out.contains(r#"data-path="a.&quot;b""#), "{out}");
        assert_eq!(out.matches("data-path").count(), 1);
    }
}
