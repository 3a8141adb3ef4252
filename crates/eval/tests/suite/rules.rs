//! Rules and written methods: verdicts to the language's tolerances, targets part by part.

use crate::build::{Build, call, equal, labelled, make, method, num, op, part, send, sub, text};
use eval::{Evaluator, Side, Verdict, given_values};
use kernel::{BinaryOperator, Structure, Term, Value, Values};

/// Tests the first constraint, with slots set to these values in order.
fn verdict(b: &Build, values: &[Value]) -> Result<Verdict, String> {
    let structure = b.structure();
    let state = state(&structure, values);
    let evaluator = Evaluator::new(&b.document, &structure, &state);
    evaluator.test(structure.constraints[0]).map_err(|f| f.message)
}
fn state(structure: &Structure, values: &[Value]) -> Values {
    assert_eq!(structure.slots.len(), values.len());
    let mut state = Values::new(values.len());
    structure.slots.ids().zip(values).for_each(|(s, v)| state.put(s, v.clone()));
    state
}
fn x(value: f64) -> Value {
    Value::Number(value)
}
fn t(words: &str) -> Value {
    Value::Text(words.into())
}
fn two_reals() -> Build {
    let mut b = Build::new();
    b.part(b.root(), "a", b.real);
    b.part(b.root(), "b", b.real);
    b
}
fn holds(b: &Build, values: &[Value]) -> bool {
    verdict(b, values).expect("the rule has a value").holds
}

#[test]
fn sides_may_differ_by_a_billionth_of_the_larger() {
    let mut b = two_reals();
    b.constraint(b.root(), "same", equal(part("a"), part("b")));
    assert!(holds(&b, &[x(1e6), x(1e6 + 0.9e-3)]));
    assert!(!holds(&b, &[x(1e6), x(1e6 + 1.1e-3)]));
    assert!(holds(&b, &[x(0.0), x(0.9e-9)]));
    assert!(!holds(&b, &[x(0.0), x(1.1e-9)]));
    let verdict = verdict(&b, &[x(3.0), x(5.0)]).unwrap();
    assert_eq!(verdict.error, Some(-2.0));
    assert_eq!((verdict.left.as_deref(), verdict.right.as_deref()), (Some("3"), Some("5")));
}

#[test]
fn within_is_the_written_measure() {
    let mut b = two_reals();
    b.constraint(b.root(), "near", equal(part("a"), part("b"))).within = Some(Box::new(num(0.5)));
    assert!(holds(&b, &[x(1.0), x(1.5)]));
    assert!(!holds(&b, &[x(1.0), x(1.51)]));
}

#[test]
fn strictly_less_is_not_met_by_tolerance() {
    let mut b = two_reals();
    b.constraint(b.root(), "less", op(BinaryOperator::Less, part("a"), part("b")));
    assert!(!holds(&b, &[x(1.0), x(1.0)]));
    let mut b = two_reals();
    b.constraint(b.root(), "most", op(BinaryOperator::GreaterEqual, part("b"), part("a")));
    assert!(holds(&b, &[x(1.0 + 1e-10), x(1.0)]));
    let verdict = verdict(&b, &[x(5.0), x(3.0)]).unwrap();
    assert_eq!((verdict.holds, verdict.error), (false, Some(-2.0)));
}

#[test]
fn a_rule_without_a_value_is_a_fault() {
    let mut b = two_reals();
    let quotient = op(BinaryOperator::Divide, num(1.0), part("a"));
    b.constraint(b.root(), "inverse", equal(quotient, part("b")));
    assert_eq!(verdict(&b, &[x(0.0), x(1.0)]), Err("1 divided by zero".into()));
    let mut b = two_reals();
    b.constraint(b.root(), "number", part("a"));
    let says = "a number where a truth value is wanted";
    assert_eq!(verdict(&b, &[x(0.0), x(1.0)]), Err(says.into()));
}

#[test]
fn a_text_reads_as_its_number_to_the_digits_asked_for() {
    let mut b = Build::new();
    b.part(b.root(), "value", b.real);
    b.part(b.root(), "shown", b.text);
    b.constraint(b.root(), "shown", equal(part("shown"), send(part("value"), "text", vec![])));
    assert!(holds(&b, &[x(45.5), t("45.50")]));
    assert!(!holds(&b, &[x(45.5), t("45.51")]));
    assert!(!holds(&b, &[x(45.5), t("hot")]));
    let rounded = Term::Send {
        to: Box::new(part("value")),
        name: "text".into(),
        arguments: vec![labelled("digits", num(2.0))],
        search: None,
    };
    let root = b.root();
    b.document.classes[root].constraints.clear();
    b.constraint(root, "shown", equal(rounded, part("shown")));
    assert!(holds(&b, &[x(2.71449), t("2.71")]));
    assert!(holds(&b, &[x(2.71449), t("2.711")]));
    assert!(!holds(&b, &[x(2.71449), t("2.7")]));
}

#[test]
fn messages_that_answer_truth_are_opened() {
    let mut b = two_reals();
    let both = op(
        BinaryOperator::And,
        equal(part("a"), num(1.0)),
        op(BinaryOperator::LessEqual, part("b"), num(2.0)),
    );
    b.message(b.root(), "right", &[], both);
    b.constraint(b.root(), "rule", part("right"));
    let found = verdict(&b, &[x(1.5), x(6.0)]).unwrap();
    assert_eq!((found.holds, found.error), (false, Some(4.0)));
    assert!(holds(&b, &[x(1.0), x(2.0)]));
    let root = b.root();
    b.document.classes[root].constraints[0].within = Some(Box::new(num(0.5)));
    assert!(holds(&b, &[x(1.5), x(2.5)]));
}

#[test]
fn whole_things_are_compared_part_by_part() {
    let mut b = Build::new();
    b.part(b.root(), "p", b.point);
    b.constraint(b.root(), "there", equal(part("p"), make(b.point, vec![num(1.0), num(2.0)])));
    assert!(holds(&b, &[x(1.0), x(2.0)]));
    let found = verdict(&b, &[x(1.25), x(7.0)]).unwrap();
    assert_eq!((found.holds, found.error), (false, Some(5.0)));
}

#[test]
fn written_methods_write_all_their_targets_from_the_state_before() {
    let mut b = two_reals();
    let swap = method(&["a", "b"], vec![part("b"), part("a")]);
    b.constraint(b.root(), "swap", Term::Bool(true)).methods = vec![swap];
    let structure = b.structure();
    let state = state(&structure, &[x(1.0), x(2.0)]);
    let evaluator = Evaluator::new(&b.document, &structure, &state);
    let written = evaluator.method(structure.constraints[0], 0).unwrap();
    let values: Vec<Value> = written.into_iter().map(|(_, v)| v).collect();
    assert_eq!(values, [x(2.0), x(1.0)]);
}

#[test]
fn a_method_writes_a_thing_part_by_part_and_says_what_failed() {
    let mut b = Build::new();
    b.part(b.root(), "p", b.point);
    b.part(b.root(), "caption", b.text);
    let shifted = sub(part("p.x"), num(1.0));
    let number = send(part("caption"), "number", vec![]);
    b.constraint(b.root(), "move", Term::Bool(true)).methods = vec![
        method(&["p"], vec![make(b.point, vec![shifted, num(-0.0)])]),
        method(&["p.x"], vec![number]),
        method(&["p"], vec![num(3.0)]),
        method(&["p"], vec![call("sqrt", vec![num(-1.0)])]),
        method(&["caption"], vec![text("on")]),
    ];
    let structure = b.structure();
    let state = state(&structure, &[x(4.0), x(2.0), t("hot")]);
    let evaluator = Evaluator::new(&b.document, &structure, &state);
    let run = |i| evaluator.method(structure.constraints[0], i);
    let slots: Vec<kernel::SlotId> = structure.slots.ids().collect();
    let moved = run(0).unwrap();
    assert_eq!(moved, [(slots[0], x(3.0)), (slots[1], x(0.0))]);
    assert!(moved[1].1.same_bits(&x(0.0)));
    let fault = run(1).unwrap_err();
    assert_eq!(fault.message, "`hot` is no number");
    assert_eq!(fault.origin, Some(kernel::OriginId(900)));
    assert_eq!(run(2).unwrap_err().message, "a number has no parts");
    assert_eq!(run(3).unwrap_err().message, "sqrt(-1), which is defined where x >= 0");
    assert_eq!(run(4).unwrap(), [(slots[2], t("on"))]);
}

#[test]
fn a_side_takes_the_value_of_the_other() {
    let mut b = Build::new();
    b.part(b.root(), "p", b.point);
    b.part(b.root(), "caption", b.text);
    b.constraint(b.root(), "there", equal(part("p"), make(b.point, vec![num(1.0), num(2.0)])));
    b.constraint(b.root(), "shown", equal(send(part("p.x"), "text", vec![]), part("caption")));
    b.message(b.root(), "named", &[], equal(part("caption"), text("here")));
    b.constraint(b.root(), "name", part("named"));
    b.constraint(b.root(), "less", op(BinaryOperator::Less, part("p.x"), num(1.0)));
    let structure = b.structure();
    let state = state(&structure, &[x(4.0), x(2.0), t("hot")]);
    let evaluator = Evaluator::new(&b.document, &structure, &state);
    let copy = |i: usize, side| {
        let found = evaluator.copy_side(structure.constraints[i], std::iter::empty(), side);
        found.map_err(|f| f.message).map(|w| w.into_iter().map(|(_, v)| v).collect::<Vec<_>>())
    };
    assert_eq!(copy(0, Side::Left), Ok(vec![x(1.0), x(2.0)]));
    let says = "a side that is no stored part takes no value";
    assert_eq!(copy(0, Side::Right), Err(says.into()));
    assert_eq!(copy(1, Side::Left), Err(says.into()));
    assert_eq!(copy(1, Side::Right), Ok(vec![t("4")]));
    assert_eq!(copy(2, Side::Left), Ok(vec![t("here")]));
    assert_eq!(copy(3, Side::Left), Err("a rule that is no equation".into()));
}

#[test]
fn the_thesis_thermometer_converts_both_ways() {
    let mut b = Build::new();
    b.part(b.root(), "celsius", b.real);
    b.part(b.root(), "fahrenheit", b.real);
    b.given(b.root(), "celsius", num(20.0));
    let warm = || {
        let scaled = op(BinaryOperator::Multiply, part("celsius"), num(1.8));
        op(BinaryOperator::Add, scaled, num(32.0))
    };
    let back = op(BinaryOperator::Divide, sub(part("fahrenheit"), num(32.0)), num(1.8));
    b.constraint(b.root(), "convert", equal(warm(), part("fahrenheit"))).methods =
        vec![method(&["fahrenheit"], vec![warm()]), method(&["celsius"], vec![back])];
    let structure = b.structure();
    let (mut values, _) = given_values(&b.document, &structure);
    let convert = structure.constraints[0];
    for i in [0, 1] {
        let written = Evaluator::new(&b.document, &structure, &values).method(convert, i).unwrap();
        written.into_iter().for_each(|(slot, value)| values.put(slot, value));
        assert!(Evaluator::new(&b.document, &structure, &values).test(convert).unwrap().holds);
    }
    assert_eq!(values.numbers.as_slice(), [20.0, 68.0]);
}
