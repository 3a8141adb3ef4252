//! Which way: written methods in their order, multi-way rules, branches.

use crate::builder::{Sheet, close, lines};
use solve::{
    Host, Level, Method, MethodBody, NoHost, Note, Relation, RelationBody, Stay, StepKind,
};

fn thermometer() -> (Sheet, [u32; 2]) {
    let mut s = Sheet::default();
    let (c, f) = (s.given(20.0), s.free(0.0));
    let (vc, vf) = (s.v(c), s.v(f));
    let (k, o) = (s.c(1.8), s.c(32.0));
    let product = s.mul(vc, k);
    let forward = s.add(product, o);
    let r = s.require(forward, vf);
    s.method(r, f, forward);
    let rest = s.sub(vf, o);
    let back = s.div(rest, k);
    s.method(r, c, back);
    s.open();
    (s, [c, f])
}

#[test]
fn a_temperature_goes_both_ways() {
    let (s, [c, f]) = thermometer();
    assert_eq!(s.x0[f as usize], 68.0);
    let (values, _, plan) = s.set(&[(c, 72.5)]);
    assert_eq!(values[f as usize], 162.5);
    assert_eq!(plan.steps()[0].kind, StepKind::Method { relation: 0, method: 0 });
    let (values, _, plan) = s.set(&[(f, 212.0)]);
    assert_eq!(values[c as usize], 100.0);
    assert_eq!(plan.steps()[0].kind, StepKind::Method { relation: 0, method: 1 });
    assert_eq!(plan.report.yielded, [c]);
    let (values, _, _) = s.set(&[(c, -40.0)]);
    assert_eq!(values[f as usize], -40.0);
}

#[test]
fn of_several_methods_the_first_possible_is_taken() {
    let mut s = Sheet::default();
    let (a, b, c) = (s.kept(2.0), s.kept(3.0), s.kept(5.0));
    let (va, vb, vc) = (s.v(a), s.v(b), s.v(c));
    let sum = s.add(va, vb);
    let r = s.require(sum, vc);
    let (to_a, to_b) = (s.sub(vc, vb), s.sub(vc, va));
    s.method(r, b, to_b);
    s.method(r, a, to_a);
    // c is never written, so a, the first declared, stays and b yields
    let (values, outcome, _) = s.set(&[(c, 9.0)]);
    assert!(outcome.is_solved());
    assert_eq!(values, [2.0, 7.0, 9.0]);
    let (values, _, _) = s.set(&[(c, 9.0), (b, 1.0)]);
    assert_eq!(values, [8.0, 1.0, 9.0]);
}

#[test]
fn what_is_only_read_is_never_written() {
    let mut s = Sheet::default();
    let (size, width) = (s.given(80.0), s.kept(80.0));
    let (vs, vw) = (s.v(size), s.v(width));
    let two = s.c(2.0);
    let (ds, dw) = (s.mul(vs, two), s.mul(vw, two));
    let r = s.require(dw, ds);
    s.reads(r, size);
    let (values, outcome, _) = s.set(&[(width, 90.0)]);
    assert!(!outcome.is_solved());
    assert_eq!(values[size as usize], 80.0);
    let (values, outcome, _) = s.set(&[(size, 90.0)]);
    assert!(outcome.is_solved());
    assert_eq!(values[width as usize], 90.0);
}

/// a * b = c and a = b, by two wires: a calculator of square roots.
fn square_root(start: f64) -> (Sheet, [u32; 3]) {
    let mut s = Sheet::default();
    let (a, b, c) = (s.free(start), s.free(start), s.given(2.0));
    let (va, vb, vc) = (s.v(a), s.v(b), s.v(c));
    let product = s.mul(va, vb);
    s.require(product, vc);
    s.require(va, vb);
    s.open();
    (s, [a, b, c])
}

#[test]
fn a_square_root_calculator_opens_from_anywhere() {
    for start in [1.0, 0.0, 100.0] {
        let (s, [a, b, c]) = square_root(start);
        close(s.x0[a as usize].abs(), std::f64::consts::SQRT_2, 1e-12);
        assert_eq!(s.x0[a as usize], s.x0[b as usize]);
        let (values, outcome, _) = s.set(&[(c, 9.0)]);
        assert!(outcome.is_solved(), "{outcome:?}");
        close(values[a as usize], 3.0f64.copysign(s.x0[a as usize]), 1e-12);
    }
}

#[test]
fn a_square_root_keeps_its_branch() {
    let (s, [a, _, c]) = square_root(-1.0);
    assert!(s.x0[a as usize] < 0.0);
    let (values, _, _) = s.set(&[(c, 9.0)]);
    close(values[a as usize], -3.0, 1e-12);
}

/// x^2 - 6 x + 9 = 0 by parts: square = x * y, y = x, line = six * x, square + nine = line.
#[test]
fn a_double_root_is_found_and_reported() {
    let mut s = Sheet::default();
    let (x, y, square, line) = (s.free(1.0), s.free(1.0), s.free(0.0), s.free(0.0));
    let (six, nine) = (s.given(6.0), s.given(9.0));
    let [vx, vy, vq, vl, v6, v9] = [x, y, square, line, six, nine].map(|i| s.v(i));
    let product = s.mul(vx, vy);
    s.require(vq, product);
    s.require(vx, vy);
    let term = s.mul(v6, vx);
    s.require(vl, term);
    let left = s.add(vq, v9);
    s.require(left, vl);
    let outcome = s.open();
    close(s.x0[x as usize], 3.0, 1e-6);
    assert!(
        outcome.notes.iter().any(|n| matches!(n, Note::DoubleRoot { .. })),
        "{:?}\n{}",
        outcome.notes,
        lines(&s.plan())
    );
    let plan = s.plan();
    let (values, outcome) = s.run(&plan, &[], &mut NoHost);
    assert!(outcome.is_solved());
    assert_eq!(crate::builder::bits(&values), crate::builder::bits(&s.x0));
}

/// A caption shows a height: text on the host's side.
struct Caption {
    text: String,
    height: u32,
    caption: u32,
}

impl Host for Caption {
    fn compute(
        &mut self,
        _: u32,
        method: usize,
        values: &[f64],
        out: &mut [f64],
    ) -> Result<(), String> {
        if method == 0 {
            self.text = base::number::shortest(values[self.height as usize]);
        } else {
            out[0] = self.text.parse().map_err(|_| format!("{} is no number", self.text))?;
        }
        Ok(())
    }
    fn holds(&mut self, _: u32, values: &[f64]) -> bool {
        let _ = self.caption;
        self.text.parse() == Ok(values[self.height as usize])
    }
}

#[test]
fn a_caption_and_a_height_follow_each_other() {
    let mut s = Sheet::default();
    let height = s.given(40.0);
    let caption = s.text(Stay::Free);
    s.system.relations.push(Relation {
        level: Level::Required,
        body: RelationBody::Opaque { slots: [caption, height].into() },
        methods: vec![
            Method { targets: vec![caption], body: MethodBody::Opaque { reads: vec![height] } },
            Method { targets: vec![height], body: MethodBody::Opaque { reads: vec![caption] } },
        ]
        .into(),
        derived: false,
        reads: Default::default(),
        within: base::number::Tolerance::within(0.0),
        source: 0,
        rests: false,
    });
    let mut host = Caption { text: String::new(), height, caption };
    let plan = s.plan();
    assert!(s.run(&plan, &[], &mut host).1.is_solved());
    assert_eq!(host.text, "40");
    s.system.slots[caption as usize].stay = Stay::Fixed;
    let plan = s.plan();
    host.text = "55".into();
    let (values, outcome) = s.run(&plan, &[(caption, 0.0)], &mut host);
    assert!(outcome.is_solved(), "{outcome:?}");
    assert_eq!(values[height as usize], 55.0);
    host.text = "hot".into();
    let (values, outcome) = s.run(&plan, &[(caption, 0.0)], &mut host);
    assert!(!outcome.is_solved());
    assert_eq!(values[height as usize], 40.0);
}
