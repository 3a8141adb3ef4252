//! What an edit leaves as it was is kept, and means what lowering anew says.

use base::Dice;
use lang::{Lowered, lower};

const CLASSES: &str = "class Widget { left: Real = 1  bottom: Real = 2  top: Real
    constraint top = left + bottom }
class Pair { a: Widget  b: Widget }
class Row { all: List of Real = [1] }
";

/// What the lines of a document may be: plain parts, and all that they are not.
const LINES: [&str; 22] = [
    "w: Widget { left = 5  bottom = 7 }",
    "v: Widget",
    "x: Real = 3",
    "y: Real",
    "w: Widget { left = 8 }",
    "p: Pair { a.left = 4 }",
    "many: List of 3 Widget",
    "few: List of 2 Real = [1, 2]",
    "z: Widget { left = x }",
    "/// said\nu: Widget { left = 2 }",
    "i, j: Real = 0",
    "q: Widget { top.enabled = false }",
    "o: Pair { merge a = b }",
    "constraint x = y",
    "merge v.left = w.left",
    "t: Text = \"word\"",
    "k: Integer in 0..9 = 4",
    "unit mm",
    "class More { a: Real }",
    "m: More",
    "some: List of Real = [1, 2, 3]",
    "for a in some { constraint a <= 9 }",
];

fn told(l: &Lowered) -> String {
    let Lowered { document, checks, origins, diagnostics, doc, .. } = l;
    format!("{document:#?}{checks:?}{origins:?}{diagnostics:#?}{doc}{}", l.keepable())
}

#[test]
fn what_is_kept_is_what_lowering_anew_gives() {
    let mut dice = Dice::new(5);
    let mut kept = 0;
    for _ in 0..220 {
        let mut lines: Vec<&str> = (0..6).map(|_| LINES[dice.below(LINES.len())]).collect();
        let mut before: Option<Lowered> = None;
        for _ in 0..12 {
            let text = format!("{CLASSES}{}\n", lines.join("\n"));
            let now = lower(&text, &|_| None, before.as_ref());
            // where something is wrong what was right before stays in force
            let anew = lower(&text, &|_| None, None);
            if anew.diagnostics.is_empty() {
                assert_eq!(told(&now), told(&anew), "{text}");
                kept += now.keepable();
            } else {
                assert_eq!(now.diagnostics, anew.diagnostics, "{text}");
            }
            before = Some(now);
            for _ in 0..1 + dice.below(3) {
                let (at, line) = (dice.below(lines.len()), LINES[dice.below(LINES.len())]);
                match dice.below(3) {
                    0 => lines[at] = line,
                    1 => lines.insert(at, line),
                    _ if lines.len() > 1 => {
                        lines.remove(at);
                    }
                    _ => {}
                }
            }
        }
    }
    assert!(kept > 500, "{kept} parts could be kept");
}
