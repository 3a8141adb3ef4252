//! Circuits: merged nodes, sets, simultaneous equations.

use crate::builder::{Builder, Lab, REAL, SET_OF_REAL, equal, mul, n, p, send, sub};
use kernel::{ClassId, Term, UnaryOperator};
use plan::PlanKind;

struct Parts {
    two_lead: ClassId,
    ground: ClassId,
}

fn parts(b: &mut Builder) -> Parts {
    let node = b.class("Node", &[("voltage", REAL), ("currents", SET_OF_REAL)]);
    b.constraint(node, equal(send(p("currents"), "sum", vec![]), n(0.0)));
    let lead = b.class("Lead", &[("node", node), ("current", REAL)]);
    b.insert(lead, "current", "node.currents");
    let two_lead = b.class("TwoLead", &[("a", lead), ("b", lead), ("current", REAL)]);
    b.merge(two_lead, &["a.current", "current"]);
    let back = Term::Unary(UnaryOperator::Negate, Box::new(p("current")));
    b.constraint(two_lead, equal(p("b.current"), back));
    let ground = b.class("Ground", &[("lead", lead)]);
    b.constraint(ground, equal(p("lead.node.voltage"), n(0.0)));
    Parts { two_lead, ground }
}

fn divider() -> Lab {
    let mut b = Builder::new();
    let Parts { two_lead, ground } = parts(&mut b);
    let drop = || sub(p("a.node.voltage"), p("b.node.voltage"));
    let resistor = b.subclass("Resistor", two_lead, &[("resistance", REAL)]);
    b.given(resistor, "resistance", n(100.0));
    b.constraint(resistor, equal(drop(), mul(p("current"), p("resistance"))));
    let battery = b.subclass("Battery", two_lead, &[("emf", REAL)]);
    b.given(battery, "emf", n(1.5));
    b.constraint(battery, equal(drop(), p("emf")));
    b.stay(battery, "emf", None);
    let root = b.class(
        "document",
        &[("battery", battery), ("r1", resistor), ("r2", resistor), ("ground", ground)],
    );
    b.merge(root, &["battery.a.node", "r1.a.node"]);
    b.merge(root, &["r1.b.node", "r2.a.node"]);
    b.merge(root, &["battery.b.node", "r2.b.node", "ground.lead.node"]);
    b.open(root)
}

fn near(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12, "{a} is not {b}");
}

#[test]
fn a_divider_finds_its_currents_and_voltages() {
    let mut lab = divider();
    assert_eq!(lab.opened.unmet, vec![]);
    near(lab.number("r1.current"), 0.0075);
    near(lab.number("r2.a.node.voltage"), 0.75);
    let report = lab.set("r2.resistance", &[300.0]);
    assert_eq!(report.refusal, None);
    near(lab.number("r1.current"), 0.00375);
    near(lab.number("r2.a.node.voltage"), 1.125);
    assert_eq!(lab.planner.latest_kind(), PlanKind::Block);
}

#[test]
fn a_resistance_yields_where_nothing_else_can() {
    let mut lab = divider();
    let report = lab
        .edit(plan::EditKind::Set, &[("r2.a.node.voltage", &[1.125]), ("r1.resistance", &[100.0])]);
    assert_eq!(report.refusal, None, "{report:?}");
    near(lab.number("r1.current"), 0.00375);
    assert!((lab.number("r2.resistance") - 300.0).abs() < 1e-9);
}

#[test]
fn an_empty_sum_is_zero() {
    let mut b = Builder::new();
    let node = b.class("Node", &[("currents", SET_OF_REAL), ("total", REAL)]);
    b.constraint(node, equal(p("total"), send(p("currents"), "sum", vec![])));
    let root = b.class("document", &[("node", node)]);
    let lab = b.open(root);
    assert_eq!(lab.number("node.total"), 0.0);
    assert_eq!(lab.opened.unmet, vec![]);
}
