//! Values written into a text, and read from what a person types.

use super::{load, lower, right};
use kernel::{Literal, Path, Quantity, Shown, Step, show_quantity};
use lang::{Wanted, read_literal, write_values};

fn place(x: f64, y: f64) -> Literal {
    Literal::Tuple(vec![Literal::Number(x), Literal::Number(y)])
}

fn at(path: &str) -> Path {
    let step = |s: &str| match s.parse() {
        Ok(i) => Step::Index(i),
        Err(_) => Step::Part(s.into()),
    };
    Path(path.split('.').map(step).collect())
}

#[track_caller]
fn assert_written(text: &str, writes: &[(&str, Literal)], wanted: &str) {
    let lowered = right(text);
    let writes: Vec<(Path, Literal)> = writes.iter().map(|(p, l)| (at(p), l.clone())).collect();
    let edits = write_values(&lowered, &writes);
    let written = syntax::edit::apply(text, &edits);
    assert_eq!(written, wanted);
    right(&written);
}

#[test]
fn a_number_is_rewritten_where_it_stands() {
    assert_written(
        "a: Real = 1  // one\nb: Real = 2",
        &[("a", Literal::Number(1.5))],
        "a: Real = 1.5  // one\nb: Real = 2",
    );
    assert_written("a: Real = -1", &[("a", Literal::Number(-2.0))], "a: Real = -2");
}

#[test]
fn what_is_written_already_is_left_alone() {
    assert_written(
        "a: Length = 4.70 mm\nb: Real = 1e3",
        &[("a", Literal::Number(0.0047)), ("b", Literal::Number(1000.0))],
        "a: Length = 4.70 mm\nb: Real = 1e3",
    );
}

#[test]
fn units_are_kept() {
    assert_written(
        "r: Resistance = 4.7 kohm",
        &[("r", Literal::Number(300.0))],
        "r: Resistance = 0.3 kohm",
    );
    assert_written(
        "unit mm\nl: Length = 2 m\nv: Voltage = 5 V\nw: Voltage = 5",
        &[("l", Literal::Number(10.0)), ("v", Literal::Number(1e6)), ("w", Literal::Number(3e6))],
        "unit mm\nl: Length = 0.01 m\nv: Voltage = 1 V\nw: Voltage = 3 V",
    );
}

#[test]
fn one_coordinate_is_replaced_in_its_tuple() {
    assert_written(
        "use shapes\np: Point = (1, 2)",
        &[("p", place(1.0, 5.0))],
        "use shapes\np: Point = (1, 5)",
    );
    assert_written(
        "use shapes\np: Point = (1, 2)",
        &[("p.y", Literal::Number(5.0))],
        "use shapes\np: Point = (1, 5)",
    );
    assert_written(
        "use shapes\nl: Line { p1 = (1, 2) }",
        &[("l.p1.x", Literal::Number(7.0))],
        "use shapes\nl: Line { p1 = (7, 2) }",
    );
    assert_written(
        "use shapes\nl: Line\nl.p1 = (1, 2)",
        &[("l.p1.x", Literal::Number(7.0))],
        "use shapes\nl: Line\nl.p1 = (7, 2)",
    );
}

#[test]
fn a_new_value_goes_into_the_body_of_its_own_thing() {
    assert_written("t: Real", &[("t", Literal::Number(30.0))], "t: Real = 30");
    assert_written(
        "use shapes\nq: Quad",
        &[("q.side1.p1", place(10.0, 20.0))],
        "use shapes\nq: Quad { side1.p1 = (10, 20) }",
    );
    assert_written(
        "use shapes\nq: Quad { side1.p1 = (1, 2) }",
        &[("q.side2.p2", place(10.0, 20.0)), ("q.side1.p1", place(1.0, 3.0))],
        "use shapes\nq: Quad { side1.p1 = (1, 3)  side2.p2 = (10, 20) }",
    );
    assert_written(
        "use shapes\nq: Quad { inner: Line }",
        &[("q.inner.p1", place(3.0, 4.0))],
        "use shapes\nq: Quad { inner: Line { p1 = (3, 4) } }",
    );
}

#[test]
fn the_value_of_a_class_is_never_changed() {
    assert_written(
        "class T { celsius: Real = 20 }\nt: T\nu: T\n",
        &[("t.celsius", Literal::Number(30.0))],
        "class T { celsius: Real = 20 }\nt: T { celsius = 30 }\nu: T\n",
    );
    assert_written(
        "use parts.bolts\n",
        &[("bolts.size", Literal::Number(4.0))],
        "use parts.bolts\nbolts.size = 4\n",
    );
}

#[test]
fn names_that_share_a_value_part_ways() {
    assert_written("x, y: Real = 1\n", &[("x", Literal::Number(2.0))], "x, y: Real = 1\nx = 2\n");
}

#[test]
fn elements_of_lists() {
    assert_written(
        "l: List of 3 Real\n",
        &[("l.1", Literal::Number(2.0))],
        "l: List of 3 Real\nl[1] = 2\n",
    );
    assert_written(
        "l: List of Real = [1, 2, 3]\n",
        &[("l.1", Literal::Number(9.0))],
        "l: List of Real = [1, 9, 3]\n",
    );
}

#[test]
fn texts_and_truth_values() {
    assert_written(
        "t: Text = \"a\"\nb: Bool = true",
        &[("t", Literal::Text("say \"hi\"\n".into())), ("b", Literal::Bool(false))],
        "t: Text = \"say \\\"hi\\\"\\n\"\nb: Bool = false",
    );
}

#[test]
fn what_is_computed_is_replaced_by_its_value() {
    assert_written("a: Real = 2 * 3", &[("a", Literal::Number(7.0))], "a: Real = 7");
}

#[test]
fn a_wrong_line_elsewhere_is_kept_as_typed() {
    let before = right("a: Real = 1\nb: Real = 2\n");
    let text = "b: Real = \na: Real = 1\n";
    let lowered = lang::lower(text, &load, Some(&before));
    let edits = write_values(&lowered, &[(at("a"), Literal::Number(5.0))]);
    assert_eq!(syntax::edit::apply(text, &edits), "b: Real = \na: Real = 5\n");
}

/// Reads a part's given number back from the text that it was written into.
fn reread(text: &str, before: &lang::Lowered) -> u64 {
    let lowered = lang::lower_written(text, &|_| None, before);
    let root = &lowered.document.classes[lowered.document.root];
    match root.givens[0].value {
        kernel::Term::Number { value, .. } => value.to_bits(),
        ref other => panic!("a number, not {other:?}"),
    }
}

#[test]
fn written_numbers_read_back_bit_for_bit() {
    let texts = [
        "a: Real = 1",
        "a: Angle = 30 deg",
        "a: Resistance = 1 kohm",
        "a: Length = 3 inch",
        "unit mm\na: Length = 3 m",
        "unit mm\na: Voltage = 3 mV",
        "unit mm\na: Force = 1",
        "unit inch\na: Length = 3 mm",
    ];
    let numbers = [0.1, 1.0 / 3.0, 72.5, 1e-9, 123_456.789, -2.5e7, 0.1 + 0.2, 1e-290];
    for text in texts {
        for x in numbers {
            let lowered = right(text);
            let edits = write_values(&lowered, &[(at("a"), Literal::Number(x))]);
            let written = syntax::edit::apply(text, &edits);
            assert_eq!(reread(&written, &lowered), x.to_bits(), "{x} in {written}");
        }
    }
}

#[test]
fn what_is_written_anew_keeps_its_unit() {
    let texts = [
        ("rate: Real = 3 %", "%"),
        ("rate: Real = -3%", "%"),
        ("traces: Real = 40 ppm", "ppm"),
        ("a: Angle = 30 deg", "deg"),
        ("a: Length = 3 ft", "ft"),
        ("a: Velocity = 55 mph", "mph"),
        ("a: Pressure = 30 psi", "psi"),
        ("a: Temperature = 300 K", "K"),
        ("a: Voltage = -3 mV", "mV"),
    ];
    let mut seed = 1_u64;
    for (text, unit) in texts {
        let lowered = right(text);
        let path =
            at(text.split(": ").next().unwrap_or_default().lines().last().unwrap_or_default());
        for _ in 0..200 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let x = (seed >> 11) as f64 / (1_u64 << 53) as f64 * 0.7 + 0.01;
            let edits = write_values(&lowered, &[(path.clone(), Literal::Number(x))]);
            let written = syntax::edit::apply(text, &edits);
            assert!(written.ends_with(&format!(" {unit}")), "{x} in {written}");
            assert_eq!(reread(&written, &lowered), x.to_bits(), "{x} in {written}");
        }
    }
}

#[test]
fn a_share_that_a_class_gives_in_percent_is_written_so() {
    let class = "class Loan { rate: Real = 3 %  turn: Angle = 1 turn }\n";
    assert_written(
        &format!("{class}a: Loan\nb: Loan {{ rate = -4% }}"),
        &[("a.rate", Literal::Number(0.025)), ("b.rate", Literal::Number(0.045))],
        &format!("{class}a: Loan {{ rate = 2.5 % }}\nb: Loan {{ rate = 4.5 % }}"),
    );
    let bank = "class Bank { loan: Loan { rate = 3% } }\n";
    assert_written(
        &format!("{class}{bank}c: Bank"),
        &[("c.loan.rate", Literal::Number(0.0252))],
        &format!("{class}{bank}c: Bank {{ loan.rate = 2.52 % }}"),
    );
}

#[test]
fn a_small_number_of_a_quotient_is_shown_as_it_is_written() {
    let lowered = right("");
    let shown = |x, class: &str, written| {
        let dimension = expr::dimension::Dimension::by_name(class).expect("it is a quantity");
        show_quantity(x, Quantity { dimension, class, written }, &lowered.document).with_unit()
    };
    assert_eq!(shown(0.018, "Concentration", "1.8e-5 mol/L"), "0.000018 mol/L");
    assert_eq!(shown(0.036, "Concentration", "1.8e-5 mol/L"), "0.036 mol/m^3");
    assert_eq!(shown(0.215, "HeatTransferCoefficient", ""), "0.215 W/m^2/K");
    // a unit of one symbol has a prefix for it
    assert_eq!(shown(1e-14, "Current", "1e-14 A"), "10 fA");
}

fn typed(text: &str, class: &str, document: &str) -> Result<Literal, &'static str> {
    let lowered = lower(document);
    let class = lowered.document.class_named(class).expect("it is declared");
    read_literal(text, Wanted::Class(class), &lowered.document).map_err(|d| d.code)
}

#[test]
fn what_a_person_types() {
    let number = |x| Ok(Literal::Number(x));
    assert_eq!(typed("300 ohm", "Resistance", ""), number(300.0));
    assert_eq!(typed("1.5 kV", "Voltage", ""), number(1500.0));
    assert_eq!(typed(" 12 ", "Length", "unit mm"), number(12.0));
    assert_eq!(typed("12 mm", "Length", "unit mm"), number(12.0));
    assert_eq!(typed("5", "Voltage", "unit mm"), number(5e6));
    assert_eq!(typed("2*80", "Real", ""), number(160.0));
    assert_eq!(typed("(1 + 2)^2 / 3", "Real", ""), number(3.0));
    assert_eq!(typed("2 * 80 mm + 1", "Length", "unit mm"), number(161.0));
    assert_eq!(typed("6 V / 2 A", "Resistance", ""), number(3.0));
    assert_eq!(typed("-0", "Real", "").map(|l| format!("{l:?}")), Ok("Number(0.0)".into()));
    assert_eq!(typed("hello there", "Text", ""), Ok(Literal::Text("hello there".into())));
    assert_eq!(typed("red", "Color", ""), Ok(Literal::Text("red".into())));
    assert_eq!(typed("true", "Bool", ""), Ok(Literal::Bool(true)));
    assert_eq!(typed("(3, 4)", "Point", "use shapes"), Ok(place(3.0, 4.0)));
    assert_eq!(typed("(3 mm, 4)", "Point", "use shapes\nunit mm"), Ok(place(3.0, 4.0)));
    assert_eq!(typed("7", "Integer", ""), number(7.0));
}

/// The short form of IEC 60062, in which the prefix stands for the point.
#[test]
fn a_prefix_alone_stands_for_the_unit_that_is_wanted() {
    let number = |x| Ok(Literal::Number(x));
    assert_eq!(typed("2k", "Resistance", ""), number(2000.0));
    assert_eq!(typed(" 4k7 ", "Resistance", ""), number(4700.0));
    assert_eq!(typed("10K", "Resistance", ""), number(10_000.0));
    assert_eq!(typed("10K", "Temperature", ""), number(10.0));
    assert_eq!(typed("2.5M", "Resistance", ""), number(2.5e6));
    assert_eq!(typed("100n", "Capacitance", ""), number(1e-7));
    assert_eq!(typed("-3k", "Voltage", ""), number(-3000.0));
    // a metre and a volt are no resistance; lengths and plain numbers have no such form; no prefix
    assert_eq!(typed("1m", "Resistance", ""), Err("dimension-mismatch"));
    assert_eq!(typed("1V", "Resistance", ""), Err("dimension-mismatch"));
    for (text, class) in
        [("2k", "Length"), ("2k", "Real"), ("2q", "Resistance"), ("4k-7", "Resistance")]
    {
        assert_eq!(typed(text, class, ""), Err("not-a-value"), "{text}");
    }
}

#[test]
fn what_is_no_value() {
    assert_eq!(typed("3 V", "Length", ""), Err("dimension-mismatch"));
    assert_eq!(typed("3 V + 2 A", "Voltage", ""), Err("not-a-value"));
    assert_eq!(typed("3,5", "Real", ""), Err("not-a-value"));
    assert_eq!(typed("", "Real", ""), Err("not-a-value"));
    assert_eq!(typed("1/0", "Real", ""), Err("not-a-value"));
    assert_eq!(typed("1e999", "Real", ""), Err("not-a-value"));
    assert_eq!(typed("2.5", "Integer", ""), Err("not-a-value"));
    assert_eq!(typed("1", "Bool", ""), Err("not-a-value"));
    assert_eq!(typed("true", "Real", ""), Err("not-a-value"));
    assert_eq!(typed("(1, 2, 3)", "Point", "use shapes"), Err("not-a-value"));
    assert_eq!(typed("(1, true)", "Point", "use shapes"), Err("not-a-value"));
    assert_eq!(typed("hot", "Real", ""), Err("not-a-value"));
}

#[test]
fn what_is_shown_may_be_typed_back() {
    for document in ["", "unit mm", "unit inch"] {
        let lowered = right(document);
        for name in expr::dimension::Dimension::names() {
            let dimension = expr::dimension::Dimension::by_name(name).unwrap();
            let quantity = Quantity { dimension, class: name, written: "" };
            let Shown { text, unit, .. } = show_quantity(7.5, quantity, &lowered.document);
            let literal = typed(&format!("{text} {unit}"), name, document);
            let Ok(Literal::Number(x)) = literal else {
                panic!("{name}: {text} {unit}: {literal:?}")
            };
            // six digits are shown
            assert!((x - 7.5).abs() < 4e-5, "{name}: {text} {unit} is {x}");
        }
    }
}
