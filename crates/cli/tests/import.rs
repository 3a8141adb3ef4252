//! `thinglab import`: what is drawn and read back is the same; what is not understood is listed.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("thinglab-import-{name}"));
    fs::create_dir_all(&folder).expect("there is a folder for such files");
    folder
}

fn thinglab(folder: &Path, about: &[&str]) -> Output {
    let mut thinglab = Command::new(env!("CARGO_BIN_EXE_thinglab"));
    thinglab.current_dir(folder).args(about).output().expect("the command starts")
}

const SHEET: &str = "use drafting
unit mm
a: Line { p1 = (0, 0)  p2 = (40, 0) }
b: Line { p1 = (40, 0)  p2 = (40, 25.5) }
round: Arc { center = (0, 0)  start = (10, 0)  end = (0, 10) }
hole: Circle { center = (20, 12)  radius = 3.25 }
axis: CenterLine { p1 = (20, 5)  p2 = (20, 19) }
oval: Ellipse { center = (60, 0)  end = (66, 8)  across = 5 }
note: Note { at = (0, 30)  words = \"Ø 6.5 °\"  size = 3.5 }
ring => Contour([Bend(70, 0, 0), Bend(90, 0, 1), Bend(90, 10, 0)])
picture => picture(parts, ring)
";

#[test]
fn what_is_drawn_and_read_back_is_the_same() {
    let folder = folder("back");
    let sheet = SHEET.replace("use drafting", "use drafting\nuse contours");
    fs::write(folder.join("sheet.thing"), sheet).expect("it can be written");
    thinglab(&folder, &["draw", "sheet.thing", "-o", "sheet.dxf"]);
    let said = thinglab(&folder, &["import", "sheet.dxf", "-o", "back.thing"]);
    assert!(said.status.success() && said.stderr.is_empty(), "{said:?}");
    let text = fs::read_to_string(folder.join("back.thing")).expect("it is there");
    for wanted in [
        "line1: Line { p1 = (0, 0)  p2 = (40, 0) }",
        "line2: Line { p1 = (40, 0)  p2 = (40, 25.5) }",
        "circle1: Circle { center = (20, 12)  radius = 3.25 }",
        "middle1: CenterLine { p1 = (20, 5)  p2 = (20, 19) }",
        "ellipse1: Ellipse { center = (60, 0)  end = (66, 8)  across = 5 }",
        "note1: Note { at = (0, 30)  words = \"Ø 6.5 °\"  size = 3.5 }",
        "merge line1.p2 = line2.p1",
        "merge line1.p1 = arc1.center",
        "arc2: Arc { center = (90, 5)  start = (90, 0)  end = (90, 10) }",
    ] {
        assert!(text.contains(wanted), "no {wanted} in\n{text}");
    }
    let checked = thinglab(&folder, &["check", "--strict", "back.thing"]);
    assert!(checked.status.success(), "{checked:?}");
    // drawn again, it is the same drawing but for the contour, which is now in pieces
    thinglab(&folder, &["draw", "back.thing", "-o", "again.dxf"]);
    thinglab(&folder, &["import", "again.dxf", "-o", "twice.thing"]);
    let twice = fs::read_to_string(folder.join("twice.thing")).expect("it is there");
    let things = |text: &str| text.lines().filter(|l| l.contains(": ")).count();
    assert_eq!(things(&text), things(&twice), "{text}\n{twice}");
}

/// A drawing of these entities.
fn drawing(units: &str, entities: &[&str]) -> String {
    let header = format!("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{units}\n0\nENDSEC\n");
    format!("{header}0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", entities.concat())
}

#[test]
fn what_is_not_understood_is_listed() {
    let folder = folder("listed");
    let spline = "0\n3DFACE\n8\n0\n70\n8\n";
    let line = "0\nLINE\n8\nWALLS\n10\n0.0\n20\n0.0\n11\n2.0\n21\n0.0\n";
    let lost = "0\nLINE\n8\n0\n10\n0.0\n20\n0.0\n";
    let raised = "0\nLINE\n8\n0\n10\n0\n20\n0\n30\n5\n11\n1\n21\n1\n31\n5\n";
    fs::write(folder.join("a.dxf"), drawing("1", &[spline, line, spline, lost, raised]))
        .expect("it can be written");
    let said = thinglab(&folder, &["import", "a.dxf"]);
    let words = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(words.contains("note: 3DFACE, which is not understood, 2 times"), "{words}");
    assert!(words.contains("note: LINE without all of its numbers"), "{words}");
    assert!(words.contains("note: LINE that does not lie flat on the sheet"), "{words}");
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(
        text.contains("// Not taken over: 3DFACE, which is not understood, 2 times."),
        "{text}"
    );
    assert!(text.contains("// layer WALLS"), "{text}");
    assert!(text.contains("line1: Line { p1 = (0, 0)  p2 = (50.8, 0) }"), "inches: {text}");
}

#[test]
fn what_is_no_drawing_is_refused_at_its_line() {
    let folder = folder("refused");
    let refused = |text: &str| {
        fs::write(folder.join("no.dxf"), text).expect("it can be written");
        let said = thinglab(&folder, &["import", "no.dxf"]);
        assert!(!said.status.success(), "{said:?}");
        String::from_utf8_lossy(&said.stderr).into_owned()
    };
    assert!(refused("0\nSECTION\nhello\n").contains("line 3: found `hello`, wanted a group code"));
    assert!(refused("0\nEOF\n").contains("found no section ENTITIES"));
    assert!(refused("0\n").contains("line 1: a code without a value"));
    assert!(refused("AutoCAD Binary DXF\r\n\u{1a}").contains("a binary DXF"));
}

/// A sheet of what is more than lines and arcs.
const RICH: &str = "use drafting
use contours
unit mm
wave: Spline { places = [(0, 0), (10, 5), (20, 0), (30, 5)] }
pulled: Nurbs { poles = [(10, 0), (10, 10), (0, 10)]  weights = [1, 0.5, 1] }
wide: HorizontalDimension { from = (0, 20) to = (30, 25) aside = 8 }
low: HorizontalDimension { from = (0, 20) to = (30, 25) aside = -6 }
high: VerticalDimension { from = (0, 20) to = (30, 45) aside = -9 }
slanted: LinearDimension { from = (40, 0) to = (46, 8) aside = 5 }
ring: Circle { center = (70, 10) radius = 6 }
round: RadialDimension { circle = ring angle = 30 deg }
across: DiameterDimension { circle = ring angle = 200 deg }
one: Line { p1 = (50, 30) p2 = (70, 30) }
other: Line { p1 = (50, 30) p2 = (60, 50) }
aside: Note { at = (0, 60)  words = \"turned\"  angle = 90 deg }
turn: AngularDimension { from = one to = other away = 12 }
plate => Surface(Contour.box(Rectangle((100, 0), 20, 10)), [Contour.circle(Circle((110, 5), 2))])
";

#[test]
fn splines_dimensions_and_surfaces_come_back() {
    let folder = folder("rich");
    fs::write(folder.join("sheet.thing"), RICH).expect("it can be written");
    let drawn = thinglab(&folder, &["draw", "sheet.thing", "-o", "sheet.dxf"]);
    assert!(drawn.status.success(), "{drawn:?}");
    let said = thinglab(&folder, &["import", "sheet.dxf", "-o", "back.thing"]);
    assert!(said.status.success() && said.stderr.is_empty(), "{said:?}");
    let text = fs::read_to_string(folder.join("back.thing")).expect("it is there");
    for wanted in [
        "note1: Note { at = (0, 60)  words = \"turned\"  size = 3.5  angle = 1.5707963267948966 }",
        "curve1: Bezier { poles = [(0, 0),",
        "curve2: Nurbs { poles = [(10, 0), (10, 10), (0, 10)]  weights = [1, 0.5, 1]  degree = 2  knots = [0, 0, 0, 1, 1, 1] }",
        "HorizontalDimension { from = (0, 20)  to = (30, 25)  aside = 8  size = 3.5 }",
        "HorizontalDimension { from = (0, 20)  to = (30, 25)  aside = -6  size = 3.5 }",
        "VerticalDimension { from = (0, 20)  to = (30, 45)  aside = -9  size = 3.5 }",
        "LinearDimension { from = (40, 0)  to = (46, 8)  aside = 5",
        "RadialDimension { circle.center = (70, 10)  circle.radius = 6",
        "DiameterDimension { circle.center = (70, 10)  circle.radius = 5.99999999999999",
        "AngularDimension { from.p1 = (50, 30)  from.p2 = (70, 30)  to.p1 = (50, 30)  to.p2 = (60, 50)  away = 11.99999999999999",
        "surface1 => Surface(Contour([Bend(100, 0, 0), Bend(120, 0, 0),",
    ] {
        assert!(text.contains(wanted), "no {wanted} in\n{text}");
    }
    assert!(!text.contains("line3"), "the edges of a surface are its own: {text}");
    let checked = thinglab(&folder, &["check", "--strict", "back.thing"]);
    assert!(checked.status.success(), "{checked:?}\n{text}");
    // drawn again, it is the same drawing
    thinglab(&folder, &["draw", "back.thing", "-o", "again.dxf"]);
    thinglab(&folder, &["import", "again.dxf", "-o", "twice.thing"]);
    let twice = fs::read_to_string(folder.join("twice.thing")).expect("it is there");
    let things = |text: &str| {
        let mut kinds: Vec<String> = text
            .lines()
            .filter_map(|l| l.split_once(": ").or(l.split_once(" => ")))
            .map(|(_, thing)| thing.split(['{', '(']).next().unwrap_or_default().trim().to_string())
            .collect();
        kinds.sort();
        kinds
    };
    assert_eq!(things(&text), things(&twice), "{text}\n{twice}");
}

#[test]
fn blocks_are_taken_apart_where_they_are_inserted() {
    let folder = folder("blocks");
    let block = "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nBOLT\n10\n1.0\n20\n0.0\n\
        0\nLINE\n8\n0\n10\n1.0\n20\n0.0\n11\n3.0\n21\n0.0\n\
        0\nARC\n8\nROUND\n10\n1.0\n20\n0.0\n40\n1.0\n50\n0.0\n51\n90.0\n0\nENDBLK\n0\nENDSEC\n";
    let insert = |more: &str| format!("0\nINSERT\n8\nPARTS\n2\nBOLT\n10\n10.0\n20\n5.0\n{more}");
    let turned = insert("41\n2.0\n42\n2.0\n50\n90.0\n");
    let mirrored = insert("41\n-1.0\n42\n1.0\n");
    let rows = insert("70\n2\n71\n2\n44\n50.0\n45\n20.0\n");
    let stretched = insert("41\n2.0\n");
    // words that are given to it, of 4 mm, with their middle at a place, upwards
    let given = "66\n1\n0\nATTRIB\n8\n0\n10\n0\n20\n0\n40\n4.0\n1\nMM\n50\n90.0\n72\n1\n74\n2\n11\n50.0\n21\n10.0\n0\nSEQEND\n";
    let stretched = stretched + given;
    let lost = "0\nINSERT\n8\n0\n2\nNUT\n10\n0\n20\n0\n";
    let entities = [turned.as_str(), &mirrored, &rows, &stretched, lost];
    let drawing = drawing("4", &entities).replacen(
        "0\nSECTION\n2\nENTITIES",
        &format!("{block}0\nSECTION\n2\nENTITIES"),
        1,
    );
    fs::write(folder.join("a.dxf"), drawing).expect("it can be written");
    let said = thinglab(&folder, &["import", "a.dxf"]);
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    for wanted in [
        "// layer PARTS",
        "// layer ROUND",
        // twice as large, turned by a quarter
        "line1: Line { p1 = (10, 5)  p2 = (10, 9) }",
        "arc1: Arc { center = (10, 5)  start = (10, 7)  end = (8, 5",
        // mirrored, it runs to the right
        "line2: Line { p1 = (10, 5)  p2 = (8, 5",
        "arc2: ClockwiseArc {",
        "line6: Line { p1 = (60, 25)  p2 = (62, 25) }",
        // stretched, a quarter of a circle is one of an ellipse
        "line7: Line { p1 = (10, 5)  p2 = (14, 5) }",
        "ellipse1: EllipticArc { center = (10, 5)  end = (12, 5)  across = 1  from = 0  sweep = 1.570796326794896",
        // the width of MM is 1.666 of their size, the height of capitals 0.718
        "note1: Note { at = (51.436, 6.668)  words = \"MM\"  size = 4  angle = 1.5707963267948966 }",
    ] {
        assert!(text.contains(wanted), "no {wanted} in\n{text}");
    }
    let words = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(words.contains("note: INSERT of a block that is not there"), "{words}");
}

#[test]
fn blocks_in_themselves_and_many_of_them_end() {
    let folder = folder("bomb");
    let own = "0\nINSERT\n2\nA\n10\n1.0\n20\n0.0\n";
    let line = "0\nLINE\n8\n0\n10\n1.0\n20\n0.0\n11\n3.0\n21\n0.0\n";
    let many = "0\nINSERT\n2\nA\n10\n1.0\n20\n0.0\n70\n1000\n71\n1000\n44\n1.0\n45\n1.0\n";
    let block = format!(
        "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nA\n10\n0.0\n20\n0.0\n{line}{own}{own}{own}0\nENDBLK\n0\nENDSEC\n"
    );
    let drawing = drawing("4", &[many]).replacen(
        "0\nSECTION\n2\nENTITIES",
        &format!("{block}0\nSECTION\n2\nENTITIES"),
        1,
    );
    fs::write(folder.join("a.dxf"), drawing).expect("it can be written");
    let said = thinglab(&folder, &["import", "a.dxf", "-o", "a.thing"]);
    let words = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(words.contains("note: INSERT of blocks in one another"), "{words}");
}

#[test]
fn paragraphs_are_notes_and_hatches_surfaces() {
    let folder = folder("words");
    let words = "0\nMTEXT\n8\n0\n10\n5.0\n20\n40.0\n40\n2.5\n71\n1\n1\n{\\\\fArial|b0;First} line\\\\PØ 8\n";
    let edges = "0\nHATCH\n8\n0\n10\n0.0\n20\n0.0\n30\n0.0\n2\nANSI31\n70\n0\n71\n0\n91\n1\n92\n1\n93\n2\n\
        72\n1\n10\n-2.0\n20\n0.0\n11\n2.0\n21\n0.0\n\
        72\n2\n10\n0.0\n20\n0.0\n40\n2.0\n50\n0.0\n51\n180.0\n73\n1\n97\n0\n75\n0\n76\n1\n";
    let words = words.replace("\\\\", "\\");
    fs::write(folder.join("a.dxf"), drawing("4", &[&words, edges])).expect("it can be written");
    let said = thinglab(&folder, &["import", "a.dxf"]);
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(
        text.contains("note1: Note { at = (5, 37.5)  words = \"First line\"  size = 2.5 }"),
        "{text}"
    );
    assert!(text.contains("words = \"Ø 8\""), "{text}");
    assert!(
        text.contains(
            "surface1 => Surface(Contour([Bend(-2, 0, 0), Bend(2, 0, 0.9999999999999999)]), [])"
        ),
        "{text}"
    );
    let words = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(words.contains("note: the pattern of a HATCH: it is filled"), "{words}");
}

#[test]
fn hatches_with_ellipses_and_splines_are_surfaces() {
    let folder = folder("curved");
    // half an ellipse and its axis; a spline and its chord
    let paths = "0\nHATCH\n8\n0\n10\n0.0\n20\n0.0\n30\n0.0\n2\nSOLID\n70\n1\n71\n0\n91\n2\n\
        92\n1\n93\n2\n72\n3\n10\n0.0\n20\n0.0\n11\n4.0\n21\n0.0\n40\n0.5\n50\n0.0\n51\n180.0\n73\n1\n\
        72\n1\n10\n-4.0\n20\n0.0\n11\n4.0\n21\n0.0\n97\n0\n\
        92\n1\n93\n2\n72\n4\n94\n3\n73\n0\n74\n0\n95\n8\n96\n4\n\
        40\n0.0\n40\n0.0\n40\n0.0\n40\n0.0\n40\n1.0\n40\n1.0\n40\n1.0\n40\n1.0\n\
        10\n10.0\n20\n0.0\n10\n10.0\n20\n4.0\n10\n16.0\n20\n4.0\n10\n16.0\n20\n0.0\n97\n0\n\
        72\n1\n10\n16.0\n20\n0.0\n11\n10.0\n21\n0.0\n97\n0\n75\n0\n76\n1\n";
    fs::write(folder.join("a.dxf"), drawing("4", &[paths])).expect("it can be written");
    let said = thinglab(&folder, &["import", "a.dxf", "-o", "a.thing"]);
    let words = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(!words.contains("HATCH"), "{words}");
    let text = fs::read_to_string(folder.join("a.thing")).expect("it is written");
    let spline = "Contour.along(edges: [Bezier([Point(10, 0), Point(10, 4), Point(16, 4), Point(16, 0)]), Line(Point(16, 0), Point(10, 0))])";
    assert!(text.contains(spline), "{text}");
    let text = format!(
        "{text}check \"what they cover\" {{\n    expect surface1.area = 4 * pi() * 1 mm^2 within 1e-4 mm^2\n    expect surface2.area = 14.4 mm^2 within 1e-4 mm^2\n}}\n"
    );
    fs::write(folder.join("a.thing"), text).expect("it is written");
    let said = thinglab(&folder, &["test", "a.thing"]);
    assert!(said.status.success(), "{said:?}");
}

#[test]
fn what_a_program_drew_is_a_block_and_comes_back() {
    let folder = folder("parts");
    let text = "use geometry\nunit mm\nprogram Posts(n: Integer = 3) {\n    row = repeat n times with x = 0 mm {\n        post = Circle(Point(x, 0 mm), 2 mm)\n        next x = x + 10 mm\n    }\n}\nleft: Posts\nalone: Circle { center = (50, 0)  radius = 1 }\n";
    fs::write(folder.join("sheet.thing"), text).expect("it can be written");
    thinglab(&folder, &["draw", "sheet.thing", "-o", "sheet.dxf"]);
    let dxf = fs::read_to_string(folder.join("sheet.dxf")).expect("it is there");
    assert!(dxf.contains("AcDbBlockReference\n2\nLEFT\n"), "{dxf}");
    let said = thinglab(&folder, &["import", "sheet.dxf"]);
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    for center in
        ["(0, 0)  radius = 2", "(10, 0)  radius = 2", "(20, 0)  radius = 2", "(50, 0)  radius = 1"]
    {
        assert!(text.contains(&format!("Circle {{ center = {center} }}")), "{center}: {text}");
    }
    assert!(said.stderr.is_empty(), "{said:?}");
}
