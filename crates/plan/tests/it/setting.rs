//! Opening and setting: failure cases first.

use crate::builder::{
    Builder, LENGTH, Lab, REAL, TEXT, add, div, equal, method, mul, n, p, send, sub,
};
use kernel::Value;
use plan::{EditKind, RefusalReason, Source, Target};

fn thermometer(builder: &mut Builder) -> kernel::ClassId {
    let class = builder.class("Thermometer", &[("celsius", REAL), ("fahrenheit", REAL)]);
    builder.given(class, "celsius", n(20.0));
    let fahrenheit = add(mul(p("celsius"), n(1.8)), n(32.0));
    let celsius = div(sub(p("fahrenheit"), n(32.0)), n(1.8));
    let rule = equal(fahrenheit.clone(), p("fahrenheit"));
    let constraint = builder.constraint(class, rule);
    constraint.methods = vec![method("fahrenheit", fahrenheit), method("celsius", celsius)];
    constraint.derived = false;
    class
}

fn one_thermometer() -> Lab {
    let mut builder = Builder::new();
    let class = thermometer(&mut builder);
    let root = builder.class("document", &[("t", class)]);
    builder.open(root)
}

fn bits(lab: &Lab) -> Vec<u64> {
    lab.values.numbers.as_slice().iter().map(|x| x.to_bits()).collect()
}

#[test]
fn a_contradiction_leaves_every_bit_and_names_the_constraint() {
    let mut lab = one_thermometer();
    let before = bits(&lab);
    let report = lab.edit(EditKind::Set, &[("t.celsius", &[10.0]), ("t.fahrenheit", &[10.0])]);
    assert_eq!(report.refusal, Some(RefusalReason::Unmet));
    assert_eq!(report.unmet.len(), 1);
    assert_eq!(report.unmet[0].source, Source::Constraint(0));
    assert_eq!(report.unmet[0].error, Some(40.0));
    assert_eq!(report.changed, vec![]);
    assert_eq!(bits(&lab), before);
}

#[test]
fn a_text_is_no_value_for_a_number() {
    let mut lab = one_thermometer();
    let target = Target::Thing(lab.thing("t.celsius"));
    let report = lab.edit_targets(EditKind::Set, &[(target, vec![Value::Text("hot".into())])]);
    assert!(matches!(report.refusal, Some(RefusalReason::Target(_))), "{report:?}");
}

#[test]
fn opening_computes_what_is_not_given() {
    let lab = one_thermometer();
    assert_eq!(lab.faults, vec![]);
    assert_eq!(lab.opened.unmet, vec![]);
    assert_eq!(lab.number("t.celsius"), 20.0);
    assert_eq!(lab.number("t.fahrenheit"), 68.0);
}

#[test]
fn a_thermometer_is_set_at_either_side() {
    let mut lab = one_thermometer();
    let report = lab.set("t.fahrenheit", &[162.5]);
    assert_eq!(report.refusal, None);
    assert_eq!(lab.number("t.celsius"), 72.5);
    lab.set("t.celsius", &[-40.0]);
    assert_eq!(lab.number("t.fahrenheit"), -40.0);
    assert_eq!(report.changed, vec![lab.slot("t.celsius"), lab.slot("t.fahrenheit")]);
}

#[test]
fn a_thousand_equal_things_are_planned_once() {
    let mut builder = Builder::new();
    let class = thermometer(&mut builder);
    let names: Vec<String> = (0..1000).map(|i| format!("t{i}")).collect();
    let parts: Vec<(&str, kernel::ClassId)> = names.iter().map(|n| (n.as_str(), class)).collect();
    let root = builder.class("document", &parts);
    let mut lab = builder.open(root);
    assert_eq!(lab.number("t999.fahrenheit"), 68.0);
    let counts = lab.planner.plan_counts();
    assert_eq!((counts.planned, counts.reused), (1, 999));
    lab.set("t3.celsius", &[1.0]);
    lab.set("t4.celsius", &[2.0]);
    let counts = lab.planner.plan_counts();
    assert_eq!((counts.planned, counts.reused), (2, 1000));
    assert_eq!(lab.number("t5.fahrenheit"), 68.0);
}

#[test]
fn an_anchor_is_lifted_by_a_set_of_exactly_its_path() {
    let mut builder = Builder::new();
    let class = thermometer(&mut builder);
    let root = builder.class("document", &[("t", class)]);
    builder.stay(root, "t.celsius", None);
    let mut lab = builder.open(root);
    assert_eq!(lab.number("t.fahrenheit"), 68.0);
    let before = bits(&lab);
    let report = lab.set("t.fahrenheit", &[50.0]);
    assert_eq!(report.refusal, Some(RefusalReason::Unmet));
    assert_eq!(bits(&lab), before);
    let report = lab.set("t.celsius", &[10.0]);
    assert_eq!(report.refusal, None);
    assert_eq!(lab.number("t.fahrenheit"), 50.0);
}

fn labelled_bar() -> Lab {
    let mut builder = Builder::new();
    let class = builder.class("LabelledBar", &[("height", REAL), ("caption", TEXT)]);
    builder.given(class, "height", n(40.0));
    let text = send(p("height"), "text", vec![]);
    let number = send(p("caption"), "number", vec![]);
    let constraint = builder.constraint(class, equal(p("caption"), text.clone()));
    constraint.methods = vec![method("caption", text), method("height", number)];
    constraint.derived = false;
    let root = builder.class("document", &[("bar", class)]);
    builder.open(root)
}

#[test]
fn a_method_that_fails_refuses_by_its_constraint() {
    let mut lab = labelled_bar();
    let target = Target::Thing(lab.thing("bar.caption"));
    let report = lab.edit_targets(EditKind::Set, &[(target, vec![Value::Text("hot".into())])]);
    let Some(RefusalReason::Method(failure)) = report.refusal else { panic!("{report:?}") };
    assert_eq!(failure.source, Source::Constraint(0));
    assert_eq!(failure.message, "\"hot\" is not a number");
    assert_eq!(lab.text("bar.caption"), "40");
    assert_eq!(lab.number("bar.height"), 40.0);
}

#[test]
fn texts_and_numbers_follow_each_other() {
    let mut lab = labelled_bar();
    assert_eq!(lab.text("bar.caption"), "40");
    lab.set("bar.height", &[12.5]);
    assert_eq!(lab.text("bar.caption"), "12.5");
    let target = Target::Thing(lab.thing("bar.caption"));
    let report = lab.edit_targets(EditKind::Set, &[(target, vec![Value::Text("72".into())])]);
    assert_eq!(report.refusal, None);
    assert_eq!(lab.number("bar.height"), 72.0);
}

#[test]
fn equal_texts_are_copied_without_a_written_method() {
    let mut builder = Builder::new();
    let class = builder.class("Card", &[("title", TEXT), ("width", LENGTH)]);
    let root = builder.class("document", &[("a", class), ("b", class)]);
    builder.given(root, "a.title", Term::Text("one".into()));
    builder.given(root, "a.width", n(3.0));
    builder.constraint(root, equal(p("a"), p("b")));
    let mut lab = builder.open(root);
    assert_eq!((lab.text("b.title").as_str(), lab.number("b.width")), ("one", 3.0));
    let target = Target::Thing(lab.thing("b.title"));
    let report = lab.edit_targets(EditKind::Set, &[(target, vec![Value::Text("two".into())])]);
    assert_eq!(report.refusal, None);
    assert_eq!(lab.text("a.title"), "two");
}
use kernel::Term;
