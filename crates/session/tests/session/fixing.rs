//! Fixes: what is wrong with a text, and the edits that would mend it.

use super::desk::Desk;
use session::view::DiagnosticView;

fn first(desk: &Desk, code: &str) -> DiagnosticView {
    let diagnostics = desk.session.text(desk.id).diagnostics.into_iter();
    diagnostics.into_iter().find(|d| d.code == code).expect("the text is wrong in this way")
}

/// Applies the fix of this title, and returns the text.
fn fixed(text: &str, code: &str, title: &str) -> String {
    let mut desk = Desk::of(text);
    let wrong = first(&desk, code);
    let titles: Vec<&str> = wrong.fixes.iter().map(|f| f.title.as_str()).collect();
    let fix = wrong.fixes.iter().find(|f| f.title == title);
    let fix = fix.unwrap_or_else(|| panic!("{title} is offered, not {titles:?}"));
    desk.session.fix(desk.id, fix).expect("the text is as it was");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let mended = desk.text();
    desk.undo();
    assert_eq!(desk.text(), text);
    mended
}

#[test]
fn the_nearest_name_is_written() {
    let text = "use geometry\nl: Lin\n";
    assert_eq!(fixed(text, "unknown-class", "write Line"), "use geometry\nl: Line\n");
    let text = "width: Real = 3\nx: Real = widht + 1\n";
    let mended = "width: Real = 3\nx: Real = width + 1\n";
    assert_eq!(fixed(text, "unknown-name", "write width"), mended);
    let text = "use geometry\nl: Line\nconstraint l.lenght = 3\n";
    let mended = "use geometry\nl: Line\nconstraint l.length = 3\n";
    assert_eq!(fixed(text, "unknown-part", "write length"), mended);
    let text = "use geometry\nl: HorizontalLine { without levle }\n";
    let mended = "use geometry\nl: HorizontalLine { without level }\n";
    assert_eq!(fixed(text, "unknown-name", "write level"), mended);
    let text = "r: Resistance = 3 kohn\n";
    assert_eq!(fixed(text, "unknown-unit", "write kohm"), "r: Resistance = 3 kohm\n");
}

#[test]
fn a_library_that_has_the_class_is_used() {
    let text = "/// Two lines.\nl: Line\n";
    let mended = "use geometry\n/// Two lines.\nl: Line\n";
    assert_eq!(fixed(text, "unknown-class", "use geometry"), mended);
    let text = "use geometry\nc: NumberNode\n";
    let mended = "use geometry\nuse calculator\nc: NumberNode\n";
    assert_eq!(fixed(text, "unknown-class", "use calculator"), mended);
}

const TWO: &str = "class A { n: Real = 1  said => n }
class B { m: Real = 2  said => m }
";

#[test]
fn a_class_of_a_library_is_not_taken_for_a_word_that_is_written_almost_so() {
    let desk = Desk::of("r => Rectangle((0, 0), (3, 2))\n");
    let wrong = first(&desk, "unknown-name");
    let titles: Vec<&str> = wrong.fixes.iter().map(|f| f.title.as_str()).collect();
    assert_eq!(titles, ["use geometry"]);
}

#[test]
fn a_conflict_offers_both_ways_out() {
    let text = format!("{TWO}class C is A as a, B as b {{ }}\nc: C\n");
    let wrong = first(&Desk::of(&text), "conflict");
    let titles: Vec<&str> = wrong.fixes.iter().map(|f| f.title.as_str()).collect();
    assert_eq!(titles, ["said => a.said", "said => b.said"]);
    let mended = format!("{TWO}class C is A as a, B as b {{ said => b.said }}\nc: C\n");
    assert_eq!(fixed(&text, "conflict", "said => b.said"), mended);
}

#[test]
fn parts_that_are_there_twice_can_be_merged() {
    let classes = "class A { n: Real = 1 }\nclass B is A { }\nclass C is A { }\n";
    let text = format!("{classes}class D is B as b, C as c {{ }}\nd: D\n");
    let mended = format!("{classes}class D is B as b, C as c {{ merge b = c }}\nd: D\n");
    assert_eq!(fixed(&text, "undeclared-correspondence", "merge b = c"), mended);
}

#[test]
fn a_fix_for_another_text_is_refused() {
    let mut desk = Desk::of("use geometry\nl: Lin\n");
    let fix = first(&desk, "unknown-class").fixes.remove(0);
    desk.type_text("n: Real\n");
    assert!(desk.session.fix(desk.id, &fix).is_err());
    assert_eq!(desk.text(), "n: Real\n");
}
