//! What completion offers where someone writes.

use crate::desk::Desk;

fn labels(desk: &Desk, text: &str) -> Vec<String> {
    let offset = text.len() as u32;
    let words = desk.session.completions(desk.id, text, offset);
    words.into_iter().map(|word| word.label).collect()
}

#[test]
fn after_a_dot_the_parts_of_what_stands_before_it_are_offered() {
    let text = "use geometry\nl: Line\n";
    let desk = Desk::of(text);
    let found = labels(&desk, &format!("{text}constraint l.p1."));
    assert_eq!(found, ["x", "y"]);
}

#[test]
fn after_a_number_units_are_offered_and_else_names_classes_and_functions() {
    let text = "use geometry\nl: Line\n";
    let desk = Desk::of(text);
    let units = labels(&desk, &format!("{text}constraint l.length = 30 m"));
    assert!(units.iter().any(|unit| unit == "m") && !units.iter().any(|word| word == "sqrt"));
    let words = labels(&desk, &format!("{text}constraint sq"));
    for word in ["l", "Line", "sqrt", "Length"] {
        assert!(words.iter().any(|w| w == word), "{word} in {words:?}");
    }
    assert!(labels(&desk, &format!("{text}nothing.")).is_empty());
}
