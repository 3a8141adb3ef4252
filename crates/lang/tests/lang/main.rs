//! What texts mean, what is wrong with them, and how values and commands are written into them.

mod alone;
mod commands;
mod diagnostics;
mod kept;
mod lowering;
mod scale;
mod shown;
mod tables;
mod values;

use lang::Lowered;

/// A point, a line and a horizontal line, as a library says them.
const GEOMETRY: &str = r"
class Point { x, y: Length   distance(to p: Point) => sqrt((p.x - x)^2 + (p.y - y)^2) }
class Line {
    p1: Point = (50, 100)
    p2: Point = (200, 200)
    length: Length => sqrt((p2.x - p1.x)^2 + (p2.y - p1.y)^2)
    midpoint => Point((p1.x + p2.x) / 2, (p1.y + p2.y) / 2)
    parallel(to m: Line) => (p2.x - p1.x) * (m.p2.y - m.p1.y) = (p2.y - p1.y) * (m.p2.x - m.p1.x)
}
class HorizontalLine is Line { constraint level: p1.y = p2.y }
class Quad {
    side1, side2: Line
    merge corner: side1.p2 = side2.p1
}
";

/// A file with things of its own.
const BOLTS: &str = "use shapes\nbolt: Line { p2 = (7, 8) }\nsize: Length = 3\n";

fn load(name: &str) -> Option<String> {
    match name {
        "shapes" => Some(GEOMETRY.into()),
        "parts.bolts" => Some(BOLTS.into()),
        "ring" => Some("use ring2\nclass Ring { }\n".into()),
        "ring2" => Some("use ring\nclass Ring2 { }\n".into()),
        _ => None,
    }
}

fn lower(text: &str) -> Lowered {
    lang::lower(text, &load, None)
}

/// Lowers a text that has to be right.
fn right(text: &str) -> Lowered {
    let lowered = lower(text);
    assert!(lowered.diagnostics.is_empty(), "{text}\n{:#?}", lowered.diagnostics);
    lowered
}

/// Returns the code of every diagnostic, that of the structure included, with the text that it is at.
fn wrong(text: &str) -> Vec<(&'static str, String)> {
    let lowered = lower(text);
    let (_, faults) = kernel::instantiate(&lowered.document);
    let at =
        |d: &base::Diagnostic| lowered.files[d.place.file].text[d.place.span.range()].to_string();
    let all = lowered.diagnostics.iter().cloned().chain(lowered.fault_diagnostics(&faults));
    all.map(|d| (d.code, at(&d))).collect()
}
