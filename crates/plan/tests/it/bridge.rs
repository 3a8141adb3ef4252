//! A bridge of elastic beams: many messages, sets, one large block.

use crate::builder::{
    Builder, Lab, POINT, REAL, SET_OF_REAL, add, call, div, equal, method, mul, n, p, pair, send,
    sub, to_path,
};
use kernel::{Term, UnaryOperator};

const JOINTS: [(&str, f64, f64); 9] = [
    ("left", 20.0, 94.0),
    ("right", 340.0, 94.0),
    ("top1", 66.0, 32.0),
    ("bottom1", 98.0, 108.0),
    ("top2", 143.0, 45.0),
    ("middle", 180.0, 118.0),
    ("top3", 217.0, 45.0),
    ("bottom2", 262.0, 108.0),
    ("top4", 294.0, 32.0),
];

const BEAMS: [(&str, &str); 15] = [
    ("top1", "left"),
    ("top1", "bottom1"),
    ("left", "bottom1"),
    ("top1", "top2"),
    ("top2", "bottom1"),
    ("top2", "middle"),
    ("bottom1", "middle"),
    ("top2", "top3"),
    ("top3", "middle"),
    ("top3", "bottom2"),
    ("middle", "bottom2"),
    ("top3", "top4"),
    ("top4", "bottom2"),
    ("top4", "right"),
    ("bottom2", "right"),
];

fn negative(term: Term) -> Term {
    Term::Unary(UnaryOperator::Negate, Box::new(term))
}

fn bridge(load: f64) -> Lab {
    let mut b = Builder::new();
    let joint_parts = [("at", POINT), ("pullsX", SET_OF_REAL), ("pullsY", SET_OF_REAL)];
    let joint = b.class("Joint", &joint_parts);
    let free = b.subclass("FreeJoint", joint, &[]);
    for pulls in ["pullsX", "pullsY"] {
        b.constraint(free, equal(send(p(pulls), "sum", vec![]), n(0.0)));
    }
    let fixed = b.subclass("FixedJoint", joint, &[]);
    b.stay(fixed, "at", None);
    let end = b.class("BeamEnd", &[("joint", joint), ("pullX", REAL), ("pullY", REAL)]);
    b.insert(end, "pullX", "joint.pullsX");
    b.insert(end, "pullY", "joint.pullsY");
    let beam = b.class("Beam", &[("a", end), ("b", end), ("rest", REAL)]);
    b.given(beam, "rest", n(80.0));
    b.message(beam, "dx", &[], sub(p("b.joint.at.x"), p("a.joint.at.x")));
    b.message(beam, "dy", &[], sub(p("b.joint.at.y"), p("a.joint.at.y")));
    let square = add(mul(p("dx"), p("dx")), mul(p("dy"), p("dy")));
    b.message(beam, "length", &[], call("sqrt", vec![square]));
    b.message(beam, "tension", &[], sub(p("length"), p("rest")));
    for (pull, d) in [("pullX", "dx"), ("pullY", "dy")] {
        let (a, of_b) = (format!("a.{pull}"), format!("b.{pull}"));
        let value = div(mul(p("tension"), p(d)), p("length"));
        let pulls = b.constraint(beam, equal(p(&a), value.clone()));
        pulls.methods = vec![method(&a, value)];
        pulls.reads = vec![to_path("rest")];
        b.constraint(beam, equal(p(&of_b), negative(p(&a))));
    }
    let weight = b.class("Load", &[("end", end), ("size", REAL), ("tip", POINT)]);
    b.constraint(weight, equal(p("end.pullX"), n(0.0)));
    b.constraint(weight, equal(p("end.pullY"), p("size")));
    b.constraint(weight, equal(p("tip.x"), p("end.joint.at.x")));
    let arrow = add(add(p("end.joint.at.y"), n(20.0)), mul(p("size"), n(4.0)));
    b.constraint(weight, equal(p("tip.y"), arrow));
    let class = |name: &str| if name == "left" || name == "right" { fixed } else { free };
    let mut parts: Vec<(&str, kernel::ClassId)> =
        JOINTS.iter().map(|&(name, _, _)| (name, class(name))).collect();
    let names: Vec<String> = (1..=15).map(|i| format!("beam{i}")).collect();
    parts.extend(names.iter().map(|name| (name.as_str(), beam)));
    parts.push(("load", weight));
    let root = b.class("document", &parts);
    for (name, x, y) in JOINTS {
        b.given(root, &format!("{name}.at"), pair(x, y));
    }
    b.given(root, "load.size", n(load));
    for ((a, to), name) in BEAMS.iter().zip(&names) {
        b.merge(root, &[a, &format!("{name}.a.joint")]);
        b.merge(root, &[to, &format!("{name}.b.joint")]);
    }
    b.merge(root, &["middle", "load.end.joint"]);
    b.open(root)
}

fn near(a: f64, b: f64, within: f64) {
    assert!((a - b).abs() <= within, "{a} is not {b}");
}

#[test]
fn a_bridge_settles_under_its_load() {
    for (load, y) in [(0.0, 94.0), (2.0, 104.801263), (5.0, 124.512604)] {
        let lab = bridge(load);
        assert_eq!(lab.opened.unmet, vec![], "load {load}");
        near(lab.number("middle.at.y"), y, 1e-6);
        near(lab.number("middle.at.x"), 180.0, 1e-6);
        near(lab.number("top1.at.x") + lab.number("top4.at.x"), 360.0, 1e-6);
    }
}

#[test]
fn the_load_is_set_and_dragged() {
    let mut lab = bridge(5.0);
    let report = lab.set("load.size", &[2.0]);
    assert_eq!(report.refusal, None, "{report:?}");
    near(lab.number("middle.at.y"), 104.801263, 1e-6);
    let report = lab.move_to("load.tip", &[180.0, 170.0]);
    assert_eq!(report.unmet, vec![]);
    near(lab.number("load.tip.y"), 170.0, 1e-6);
    assert!(lab.number("load.size") > 5.0);
    assert_eq!(lab.number("left.at.y"), 94.0);
}
