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
    assert_eq!(found[..2], ["x", "y"]);
    assert!(found.contains(&"distance".to_string()), "{found:?}");
}

#[test]
fn after_a_text_and_a_list_what_all_of_these_know_is_offered() {
    let text = "name: Text\nages: List of 3 Real\n";
    let desk = Desk::of(text);
    let has =
        |of: &str, word: &str| labels(&desk, &format!("{text}a => {of}.")).contains(&word.into());
    assert!(has("name", "upper") && has("ages", "mean") && has("ages[0]", "round"));
    assert!(!has("name", "mean"));
}

#[test]
fn in_the_body_of_a_class_its_own_parts_and_those_that_it_inherits_are_offered() {
    let text =
        "use geometry\nclass Strut is Line {\n    middle: Point\n    constraint \n}\nout: Real\n";
    let desk = Desk::of(text);
    let at = (text.find("constraint ").expect("it is written") + 11) as u32;
    let words = desk.session.completions(desk.id, text, at);
    let of = |label: &str| words.iter().position(|word| word.label == label);
    for own in ["middle", "p1", "p2", "length", "out"] {
        assert!(of(own).is_some(), "{own} in {words:?}");
    }
    assert!(of("p1") < of("out"), "what is nearer comes first");
    let dotted = text.replacen("constraint ", "constraint middle.", 1);
    let words = desk.session.completions(desk.id, &dotted, at + 7);
    assert_eq!(words[0].label, "x");
}

#[test]
fn after_a_colon_classes_alone_after_use_libraries_and_in_a_comment_nothing() {
    let text = "use geometry\nl: Line\n";
    let desk = Desk::of(text);
    let classes = labels(&desk, &format!("{text}k: "));
    assert!(classes.contains(&"Circle".to_string()) && !classes.contains(&"sqrt".to_string()));
    let libraries = labels(&desk, &format!("{text}use ge"));
    assert!(libraries.contains(&"geometry".to_string()) && !libraries.contains(&"l".to_string()));
    assert!(labels(&desk, &format!("{text}// of a L")).is_empty());
    assert!(
        labels(&desk, &format!("{text}constraint Line.")).iter().any(|word| word == "horizontal")
    );
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
