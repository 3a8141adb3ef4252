//! `thinglab import`: a DXF drawing becomes a document, to trace over and to constrain.
//!
//! In: a DXF text. Out: a document in millimetres with a thing for each entity; points that coincide are merged. What
//! is not understood is listed in the document's head and where it was asked for: nothing is dropped in silence.

mod dxf;
mod merging;

use crate::commands::{Form, Report};
use crate::documents::OpenError;
use base::number::shortest;
use drawing::{Corner, Point, Shape, curve};
use dxf::{Figure, Measured, Read, What};
use merging::Merging;
use serde_json::json;
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

/// Reads a drawing and writes the document of it.
///
/// # Errors
/// If the file cannot be read or is no DXF text, or the document cannot be written.
pub(crate) fn run(path: &Path, output: Option<&Path>, form: Form) -> Result<Report, OpenError> {
    let unreadable = |source| OpenError::Unreadable { path: path.to_path_buf(), source };
    let bytes = std::fs::read(path).map_err(unreadable)?;
    let read = dxf::read(&String::from_utf8_lossy(&bytes))
        .map_err(|why| OpenError::Refused(format!("{}: {why}", path.display())))?;
    let name = path.file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
    let text = session::format(&document(&name, &read));
    let listed: Vec<String> = listed(&read);
    let json = json!({ "path": path, "things": read.found.len(), "notes": listed, "text": text });
    let notes: String = listed.iter().map(|note| format!("note: {note}\n")).collect();
    let words = match output {
        None => text,
        Some(output) => {
            std::fs::write(output, &text)
                .map_err(|source| OpenError::Unreadable { path: output.to_path_buf(), source })?;
            format!("{} things: {}\n", read.found.len(), output.display())
        }
    };
    Ok(match form {
        Form::Words => Report { text: words, aside: notes, good: true },
        Form::Json => Report { text: format!("{json}\n"), aside: String::new(), good: true },
    })
}

/// Says what was not understood, each kind once with how often.
fn listed(read: &Read) -> Vec<String> {
    let mut times: BTreeMap<&str, usize> = BTreeMap::new();
    read.notes.iter().for_each(|note| *times.entry(note).or_default() += 1);
    let say = |(note, times): (&str, usize)| match times {
        1 => note.to_string(),
        n => format!("{note}, {n} times"),
    };
    times.into_iter().map(say).collect()
}

/// Writes the document.
fn document(name: &str, read: &Read) -> String {
    let mut text = format!("// Read from {}.\n", on_one_line(name));
    for note in listed(read) {
        let _ = writeln!(text, "// Not taken over: {}.", on_one_line(&note));
    }
    text += "use drafting\n";
    if read.found.iter().any(|found| matches!(found.figure, Figure::Surface(_))) {
        text += "use contours\n";
    }
    text += "\nunit mm\n\n";
    let mut counts: BTreeMap<&str, u32> = BTreeMap::new();
    let mut merging = Merging::of(read.found.iter().flat_map(|f| points(&f.figure)));
    let mut layer = None;
    for found in &read.found {
        if layer != Some(&found.layer) {
            let _ = writeln!(text, "// layer {}", on_one_line(&found.layer));
            layer = Some(&found.layer);
        }
        let (class, base) = class(found);
        let n = counts.entry(base).or_default();
        *n += 1;
        let thing = format!("{base}{n}");
        let _ = match &found.figure {
            Figure::Surface(rings) => writeln!(text, "{thing} => {}", surface(rings)),
            figure => {
                writeln!(text, "{thing}: {class} {{ {} }}", body(figure, &thing, &mut merging))
            }
        };
    }
    text.push('\n');
    for names in merging.groups() {
        let _ = writeln!(text, "merge {}", names.join(" = "));
    }
    text
}

/// Returns a text without what would end a comment's line.
fn on_one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

/// Returns the class of what was found, and what its name begins with.
fn class(found: &dxf::Found) -> (&'static str, &'static str) {
    let line_type = found.line_type.to_ascii_uppercase();
    match &found.figure {
        Figure::Point(_) => ("Point", "point"),
        Figure::Line(..) if line_type.starts_with("CENTER") => ("CenterLine", "middle"),
        Figure::Line(..) if line_type.starts_with("HIDDEN") => ("HiddenLine", "hidden"),
        Figure::Line(..) if line_type.starts_with("DASHED") => ("HiddenLine", "hidden"),
        Figure::Line(..) => ("Line", "line"),
        Figure::Circle { .. } => ("Circle", "circle"),
        Figure::Arc { is_clockwise: false, .. } => ("Arc", "arc"),
        Figure::Arc { is_clockwise: true, .. } => ("ClockwiseArc", "arc"),
        Figure::Ellipse { sweep: None, .. } => ("Ellipse", "ellipse"),
        Figure::Ellipse { sweep: Some(_), .. } => ("EllipticArc", "ellipse"),
        Figure::Words { .. } => ("Note", "note"),
        Figure::Curves(_) => ("Bezier", "curve"),
        Figure::Rational(_) => ("Nurbs", "curve"),
        Figure::Surface(_) => ("Surface", "surface"),
        Figure::Dimension(Measured { what, .. }) => match what {
            What::Aligned { .. } => ("LinearDimension", "size"),
            What::Horizontal { .. } => ("HorizontalDimension", "size"),
            What::Vertical { .. } => ("VerticalDimension", "size"),
            What::Radius { is_across: false, .. } => ("RadialDimension", "size"),
            What::Radius { is_across: true, .. } => ("DiameterDimension", "size"),
            What::Angle { .. } => ("AngularDimension", "size"),
        },
    }
}

/// Returns the points of a figure that can be merged with others.
fn points(figure: &Figure) -> Vec<Point> {
    match figure {
        Figure::Point(p) | Figure::Circle { center: p, .. } => vec![*p],
        Figure::Line(p, q) => vec![*p, *q],
        Figure::Arc { center, start, end, .. } => vec![*center, *start, *end],
        Figure::Dimension(Measured { what, .. }) => match what {
            What::Aligned { from, to, .. }
            | What::Horizontal { from, to, .. }
            | What::Vertical { from, to, .. } => vec![*from, *to],
            What::Radius { center, .. } => vec![*center],
            What::Angle { from, to, .. } => vec![from.0, from.1, to.0, to.1],
        },
        Figure::Ellipse { .. }
        | Figure::Words { .. }
        | Figure::Curves(_)
        | Figure::Rational(_)
        | Figure::Surface(_) => Vec::new(),
    }
}

/// Writes what a thing's parts are; notes which of them may coincide with others.
fn body(figure: &Figure, thing: &str, merging: &mut Merging) -> String {
    let mut at = |part: &str, p: Point| {
        let p = merging.take(p, format!("{thing}.{part}"));
        format!("{part} = {}", place(p))
    };
    match figure {
        Figure::Point(p) => {
            let p = merging.take(*p, thing.to_string());
            format!("x = {}  y = {}", shortest(p.x), shortest(p.y))
        }
        Figure::Line(p, q) => format!("{}  {}", at("p1", *p), at("p2", *q)),
        Figure::Circle { center, radius } => {
            format!("{}  radius = {}", at("center", *center), shortest(*radius))
        }
        Figure::Arc { center, start, end, .. } => {
            format!("{}  {}  {}", at("center", *center), at("start", *start), at("end", *end))
        }
        Figure::Ellipse { center, end, across, sweep } => {
            let arc = sweep.map_or_else(String::new, |(from, sweep)| {
                format!("  from = {}  sweep = {}", shortest(from), shortest(sweep))
            });
            let (center, end) = (place(*center), place(*end));
            format!("center = {center}  end = {end}  across = {}{arc}", shortest(*across))
        }
        Figure::Curves(poles) => {
            let poles: Vec<String> = poles.iter().map(|p| place(*p)).collect();
            format!("poles = [{}]", poles.join(", "))
        }
        Figure::Rational(curve) => {
            let poles: Vec<String> = curve.poles().iter().map(|p| place(*p)).collect();
            let list = |numbers: &[f64]| -> String {
                numbers.iter().map(|x| shortest(*x)).collect::<Vec<_>>().join(", ")
            };
            format!(
                "poles = [{}]  weights = [{}]  degree = {}  knots = [{}]",
                poles.join(", "),
                list(curve.weights()),
                curve.degree(),
                list(curve.knots())
            )
        }
        // it is no thing of its own
        Figure::Surface(_) => String::new(),
        Figure::Dimension(Measured { what, size }) => {
            let size = shortest(*size);
            match what {
                What::Aligned { from, to, aside }
                | What::Horizontal { from, to, aside }
                | What::Vertical { from, to, aside } => {
                    let (from, to, aside) = (at("from", *from), at("to", *to), shortest(*aside));
                    format!("{from}  {to}  aside = {aside}  size = {size}")
                }
                What::Radius { center, radius, angle, beyond, .. } => {
                    let [radius, angle, beyond] = [radius, angle, beyond].map(|x| shortest(*x));
                    let center = at("circle.center", *center);
                    format!(
                        "{center}  circle.radius = {radius}  angle = {angle}  beyond = {beyond}  size = {size}"
                    )
                }
                What::Angle { from, to, away } => {
                    let ends = [
                        at("from.p1", from.0),
                        at("from.p2", from.1),
                        at("to.p1", to.0),
                        at("to.p2", to.1),
                    ];
                    format!("{}  away = {}  size = {size}", ends.join("  "), shortest(*away))
                }
            }
        }
        Figure::Words { at, words, size, turn } => {
            let words = on_one_line(words).replace('\\', "\\\\").replace('"', "\\\"");
            let turn = match *turn {
                0.0 => String::new(),
                turn => format!("  angle = {}", shortest(turn)),
            };
            format!("at = {}  words = \"{words}\"  size = {}{turn}", place(*at), shortest(*size))
        }
    }
}

/// Writes what rings surround.
fn surface(rings: &[Vec<Corner>]) -> String {
    let corner = |c: &Corner| {
        format!("Bend({}, {}, {})", shortest(c.at.x), shortest(c.at.y), shortest(c.bulge))
    };
    let contour = |ring: &Vec<Corner>| {
        if ring.iter().any(|corner| corner.poles.is_some()) {
            let edges: Vec<String> = curve::runs(ring).iter().filter_map(edge).collect();
            return format!("Contour.along(edges: [{}])", edges.join(", "));
        }
        let corners: Vec<String> = ring.iter().map(corner).collect();
        format!("Contour([{}])", corners.join(", "))
    };
    let mut rings = rings.iter().map(contour);
    let outer = rings.next().unwrap_or_default();
    format!("Surface({outer}, [{}])", rings.collect::<Vec<_>>().join(", "))
}

/// Writes an edge of a ring; nothing for what is none.
fn edge(shape: &Shape) -> Option<String> {
    let point = |p: Point| format!("Point{}", place(p));
    Some(match shape {
        Shape::Segment(from, to) => format!("Line({}, {})", point(*from), point(*to)),
        Shape::Arc { center, sweep, .. } => {
            let [from, to] = curve::ends(shape)?.map(point);
            let class = if *sweep < 0.0 { "ClockwiseArc" } else { "Arc" };
            format!("{class}({}, {from}, {to})", point(*center))
        }
        Shape::Spline(poles) => {
            let poles: Vec<String> = poles.iter().map(|p| point(*p)).collect();
            format!("Bezier([{}])", poles.join(", "))
        }
        Shape::Dot(_)
        | Shape::Polyline { .. }
        | Shape::Circle { .. }
        | Shape::Ellipse { .. }
        | Shape::Nurbs(_)
        | Shape::Region(_)
        | Shape::Text { .. } => return None,
    })
}

fn place(p: Point) -> String {
    format!("({}, {})", shortest(p.x), shortest(p.y))
}
