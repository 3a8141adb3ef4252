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
    let spline = "0\nSPLINE\n8\n0\n70\n8\n";
    let line = "0\nLINE\n8\nWALLS\n10\n0.0\n20\n0.0\n11\n2.0\n21\n0.0\n";
    let lost = "0\nLINE\n8\n0\n10\n0.0\n20\n0.0\n";
    let raised = "0\nLINE\n8\n0\n10\n0\n20\n0\n30\n5\n11\n1\n21\n1\n31\n5\n";
    fs::write(folder.join("a.dxf"), drawing("1", &[spline, line, spline, lost, raised]))
        .expect("it can be written");
    let said = thinglab(&folder, &["import", "a.dxf"]);
    let words = String::from_utf8_lossy(&said.stderr).into_owned();
    assert!(words.contains("note: SPLINE, which is not understood, 2 times"), "{words}");
    assert!(words.contains("note: LINE without all of its numbers"), "{words}");
    assert!(words.contains("note: LINE that does not lie flat on the sheet"), "{words}");
    let text = String::from_utf8_lossy(&said.stdout).into_owned();
    assert!(
        text.contains("// Not taken over: SPLINE, which is not understood, 2 times."),
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
