//! Wrong documents whose wrongness only shows when their values are computed: what is said, where.

use crate::desk::Desk;

/// A document, the code of its one diagnostic, what is underlined, and a word of the message.
const WRONG: &[(&str, &str, &str, &str)] = &[
    ("a: Real = 1 / 0", "no-answer", "1 / 0", "divided by zero"),
    ("a: Real = sqrt(0 - 1)", "no-answer", "sqrt(0 - 1)", "sqrt(-1)"),
    ("a: Integer = 5 / 2", "value-of-wrong-class", "5 / 2", "whole number"),
    ("a: Real = \"x\".number", "no-answer", "\"x\".number", "number"),
    (
        "class A { f(n: Real) => f(n + 1) }\na: A\nx: Real = copy of a.f(0)",
        "endless-messages",
        "copy of a.f(0)",
        "deep",
    ),
    (
        "l: List of Real = [1, 2]\nx: Real = copy of l[l.count]",
        "no-answer",
        "copy of l[l.count]",
        "element",
    ),
];

#[test]
fn a_given_value_that_is_none_says_why() {
    let mut failures = String::new();
    for (text, code, at, word) in WRONG {
        let desk = Desk::of(text);
        let found = desk.session.text(desk.id).diagnostics;
        let of = |d: &session::view::DiagnosticView| {
            (d.code.clone(), text[d.start as usize..d.end as usize].to_string(), d.message.clone())
        };
        let found: Vec<_> = found.iter().map(of).collect();
        let is_right =
            matches!(found.as_slice(), [(c, a, m), ..] if c == code && a == at && m.contains(word));
        if !is_right {
            failures +=
                &format!("\n{text}\n    wanted {code} at {at:?}, {word}\n    found {found:?}\n");
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn a_value_of_a_class_is_complained_of_once_for_all_its_things() {
    let desk = Desk::of("class A { x: Real = 1 / 0 }\nmany: List of 50 A\n");
    assert_eq!(desk.session.text(desk.id).diagnostics.len(), 1);
}

#[test]
fn values_given_by_later_ones_are_computed_in_a_moment() {
    let chain: String = (0..5_000).map(|i| format!("x{i}: Real = x{} + 1\n", i + 1)).collect();
    let desk = Desk::of(&format!("{chain}x5000: Real = 1\n"));
    assert_eq!(desk.session.text(desk.id).diagnostics, []);
    assert_eq!(desk.number("x0"), 5001.0);
}

#[test]
fn thousands_of_equal_numbers_are_one_in_a_moment() {
    let numbers: String = (0..5_000).map(|i| format!("x{i}: Real\n")).collect();
    let equal: String = (1..5_000).map(|i| format!("constraint x{} = x{i}\n", i - 1)).collect();
    let desk = Desk::of(&format!("{numbers}{equal}x4999 = 7\n"));
    assert_eq!(desk.session.text(desk.id).diagnostics, []);
    assert_eq!(desk.number("x0"), 7.0);
}

#[test]
fn thousands_of_things_of_a_library_that_is_not_used_are_told_in_a_moment() {
    let text: String = (0..5_000).map(|i| format!("x{i}: Circle\n")).collect();
    let desk = Desk::of(&text);
    let mut told = desk.session.text(desk.id).diagnostics;
    // five hundred one by one, then how many more there are
    assert_eq!(told.len(), 501);
    let more = told.pop().expect("the last");
    assert!(more.code == "more" && more.message.contains("4500"), "{more:?}");
    assert!(told.iter().all(|d| d.hint.as_deref() == Some("geometry has it: `use geometry`")));
}

/// What is wrong before anything is solved, and right after, is right.
#[test]
fn what_is_given_in_terms_of_what_is_computed_is_read_after_that() {
    let desk = Desk::of("p: Real\nconstraint p = 4\nz: Real = 1 / p\nl: List of Real = [z, p]");
    assert_eq!(desk.session.text(desk.id).diagnostics, []);
    assert_eq!([desk.number("z"), desk.number("l[0]"), desk.number("l[1]")], [0.25, 0.25, 4.0]);
}

#[test]
fn a_word_that_is_no_unit_is_told_as_one() {
    let mut desk = Desk::of("unit mm\nd: Length = 20\n");
    let refused = |desk: &mut Desk, typed: &str| {
        desk.type_in("d", typed).expect_err("it is no length").message
    };
    assert!(
        refused(&mut desk, "5 banana")
            .starts_with("`5 banana` is no value; banana is no unit that is known here; known are")
    );
    let message = refused(&mut desk, "5 kohn");
    assert_eq!(
        message,
        "`5 kohn` is no value; kohn is no unit that is known here; did you mean `kohm`?"
    );
    assert_eq!(
        refused(&mut desk, "8,5"),
        "`8,5` is no value; the tenths of a number stand after a point: `8.5`"
    );
    assert!(refused(&mut desk, "5 mm +").starts_with("`5 mm +` is no value; found"));
}

#[test]
fn a_number_for_a_thing_of_several_parts_is_told_what_it_is_made_of() {
    let mut desk = Desk::of("use geometry\nl: ConstantLengthLine { p2 = (3, 4) }\n");
    let mut refused =
        |path: &str| desk.type_in(path, "30 deg").expect_err("it is no number").message;
    assert_eq!(refused("l"), "`30 deg` is no value; it is made of p1, p2, size: set one of these");
    assert_eq!(refused("l.p2"), "`30 deg` is no value; a place is wanted, as `(3, 4)`");
}

#[test]
fn what_is_allowed_of_a_parameter_stands_where_it_is_written() {
    let desk = Desk::of(
        "program P(d: Length in 1 mm..9 mm = 2 mm, e: Length = 3 mm) {\n    a = d + e\n}\np: P\n",
    );
    let rows = desk.session.structure(desk.id);
    let row = rows.iter().find(|row| row.name == "d_range").expect("it is listed");
    assert_eq!(row.detail, "1 mm..9 mm");
}

#[test]
fn a_false_expectation_of_messages_that_double_says_both_numbers() {
    let doubled = |i: u32| format!("m{} => m{i} + m{i}\n", i + 1);
    let text = "x: Real = 1\nm0 => x\n".to_string()
        + &(0..40).map(doubled).collect::<String>()
        + "check \"c\" { expect m40 = 5 }\n";
    let desk = Desk::of(&text);
    let report = desk.session.run_checks(desk.id);
    let said: Vec<&str> = report[0].shortfalls.iter().map(|s| s.message.as_str()).collect();
    assert_eq!(said, ["1099511627776 and 5"]);
}
