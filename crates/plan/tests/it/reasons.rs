//! Status, explanations, drags.

use crate::builder::{Builder, LENGTH, Lab, POINT, REAL, Terms, add, div, equal, n, p, pair};
use kernel::Value;
use plan::{
    ExplainedKind, PlanKind, Redundant, RedundantKind, RootKind, SlotState, Source, Target,
};

fn chain() -> Lab {
    let mut b = Builder::new();
    let root = b.class("document", &[("a", REAL), ("b", REAL), ("c", REAL), ("d", LENGTH)]);
    b.given(root, "a", n(1.0));
    b.constraint(root, equal(p("b"), add(p("a"), n(1.0))));
    b.constraint(root, equal(p("c"), add(p("b"), p("a"))));
    b.open(root)
}

#[test]
fn an_unmet_document_is_conflicting_and_a_repeated_rule_redundant() {
    let mut b = Builder::new();
    let root = b.class("document", &[("x", REAL), ("y", REAL), ("z", REAL)]);
    b.constraint(root, equal(p("x"), n(1.0)));
    b.constraint(root, equal(p("x"), n(2.0)));
    b.constraint(root, equal(p("y"), add(p("z"), n(1.0))));
    b.constraint(root, equal(add(p("z"), n(1.0)), p("y")));
    let mut lab = b.open(root);
    let status = lab.status();
    assert!(!status.satisfied);
    let again = Redundant {
        source: Source::Constraint(3),
        kind: RedundantKind::Form,
        implied_by: vec![Source::Constraint(2)],
    };
    assert_eq!(lab.redundancy().constraints, vec![again]);
    assert_eq!(status.slots[lab.slot("x")], SlotState::Conflicting);
    assert_eq!(status.slots[lab.slot("y")], SlotState::Free);
    assert_eq!((status.freedom, status.more), (1, Some(0)));
    let conflicts = lab.opened.conflicts;
    assert!(conflicts.iter().all(|c| c.source != Source::Constraint(3)), "{conflicts:?}");
}

#[test]
fn given_numbers_are_held_and_lone_ones_free() {
    let mut lab = chain();
    let status = lab.status();
    assert!(status.satisfied);
    assert_eq!(status.freedom, 1);
    assert_eq!(status.slots[lab.slot("c")], SlotState::Fixed);
    assert_eq!(status.slots[lab.slot("d")], SlotState::Free);
}

#[test]
fn a_value_is_traced_to_what_was_given() {
    let mut lab = chain();
    let c = lab.slot("c");
    let why = lab.why(c);
    let targets: Vec<_> = why.steps.iter().flat_map(|s| s.targets.clone()).collect();
    assert_eq!(targets, vec![lab.slot("b"), c]);
    assert_eq!(why.steps[0].sources, vec![Source::Constraint(0)]);
    assert!(matches!(why.steps[0].kind, ExplainedKind::Isolated { roots: 1 }), "{why:?}");
    assert_eq!(why.roots.len(), 1);
    assert_eq!(why.roots[0].slot, lab.slot("a"));
    assert_eq!(why.roots[0].kind, RootKind::Given);
    assert_eq!(lab.planner.latest_kind(), PlanKind::OnePass);
}

#[test]
fn what_cannot_move_names_its_circuit() {
    let mut b = Builder::new();
    let root = b.class("document", &[("x", REAL), ("y", REAL)]);
    b.given(root, "x", n(3.0));
    b.stay(root, "x", None);
    b.constraint(root, equal(p("y"), add(p("x"), n(1.0))));
    let mut lab = b.open(root);
    let y = lab.slot("y");
    let conflicts = lab.why_not(y);
    assert_eq!(conflicts.len(), 1, "{conflicts:?}");
    assert_eq!(conflicts[0].circuit, vec![Source::Constraint(0)]);
}

fn midpoint() -> Lab {
    let mut b = Builder::new();
    let root = b.class("document", &[("a", POINT), ("b", POINT), ("m", POINT)]);
    b.given(root, "a", pair(0.0, 0.0));
    b.given(root, "b", pair(10.0, 0.0));
    for c in ["x", "y"] {
        let sum = add(p(&format!("a.{c}")), p(&format!("b.{c}")));
        b.constraint(root, equal(p(&format!("m.{c}")), div(sum, n(2.0))));
    }
    b.open(root)
}

#[test]
fn a_drag_depends_on_the_press_alone() {
    let mut lab = midpoint();
    let before = lab.values.clone();
    let target = Target::Thing(lab.thing("m"));
    let (document, structure) = (lab.document.clone(), lab.structure.clone());
    let model = plan::Model { document: &document, structure: &structure };
    let mut host = Terms { document: &document, structure: &structure };
    let press =
        |lab: &mut Lab| lab.planner.press(model, &lab.values, &[target]).expect("it can be moved");
    let mut held = press(&mut lab);
    for x in [7.0, 100.0, -3.3, 6.0] {
        let step = lab.planner.drag(model, &mut held, &mut lab.values, &[x, 1.0], &mut host);
        assert!(step.reached);
    }
    assert_eq!((lab.number("b.x"), lab.number("b.y")), (12.0, 2.0));
    lab.values = before;
    let counts = lab.planner.plan_counts();
    let mut held = press(&mut lab);
    assert_eq!(lab.planner.plan_counts().planned, counts.planned);
    lab.planner.drag(model, &mut held, &mut lab.values, &[6.0, 0.0], &mut host);
    let report = lab.planner.release(model, held, &mut lab.values, &mut host);
    assert_eq!(report.changed, vec![lab.slot("b.x"), lab.slot("m.x")]);
    assert_eq!(lab.number("a.x"), 0.0);
}

#[test]
fn a_move_with_the_wrong_number_of_values_is_refused() {
    let mut lab = midpoint();
    let target = Target::Thing(lab.thing("m"));
    let report = lab.edit_targets(plan::EditKind::Move, &[(target, vec![Value::Number(1.0)])]);
    assert!(report.refusal.is_some());
}
