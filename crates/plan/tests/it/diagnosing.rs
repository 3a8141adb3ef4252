//! What cannot hold together, what would help, and what is free.

use crate::builder::{Builder, Lab, POINT, REAL, add, call, equal, mul, n, p, pair, sub};
use base::Dice;
use kernel::Term;
use plan::{Certainty, Contradiction, MotionKind, Repair, Source};

fn whole(dice: &mut Dice) -> f64 {
    dice.below(19) as f64 - 9.0
}

/// Places, coordinates and factors whose products are summed.
type Row = Vec<(usize, usize, f64)>;

/// A satisfiable system and one rule that contradicts it.
struct Planted {
    parts: Vec<(String, f64, f64)>,
    rules: Vec<Term>,
    culprit: usize,
}

impl Planted {
    /// Opens the document of these rules alone.
    fn open(&self, rules: &[usize]) -> Lab {
        let mut b = Builder::new();
        let parts: Vec<_> = self.parts.iter().map(|part| (part.0.as_str(), POINT)).collect();
        let root = b.class("document", &parts);
        for (name, x, y) in &self.parts {
            b.given(root, name, pair(*x, *y));
        }
        for &r in rules {
            b.constraint(root, self.rules[r].clone());
        }
        b.open(root)
    }
    fn all(&self) -> Vec<usize> {
        (0..self.rules.len()).collect()
    }
}

/// Sums of two or three coordinates, true of hidden numbers; the culprit is a combination of two of
/// them with another right side.
fn linear(seed: u64) -> Planted {
    let mut dice = Dice::new(seed);
    let hidden: Vec<[f64; 2]> = (0..5).map(|_| [whole(&mut dice), whole(&mut dice)]).collect();
    let parts = (0..5).map(|i| (format!("p{i}"), 0.0, 0.0)).collect();
    let mut rows: Vec<(Row, f64)> = Vec::new();
    for _ in 0..7 {
        let mut row = Vec::new();
        for _ in 0..2 + dice.below(2) {
            let at = (dice.below(5), dice.below(2));
            if row.iter().all(|&(i, c, _)| (i, c) != at) {
                row.push((at.0, at.1, 1.0 + dice.below(3) as f64));
            }
        }
        let sum = row.iter().map(|&(i, c, k)| k * hidden[i][c]).sum();
        rows.push((row, sum));
    }
    let (i, j) = (dice.below(3), 3 + dice.below(4));
    let mut both = rows[i].0.clone();
    both.extend(&rows[j].0);
    let wrong = rows[i].1 + rows[j].1 + 1.0 + dice.below(5) as f64;
    let culprit = dice.below(rows.len() + 1);
    rows.insert(culprit, (both, wrong));
    let term = |(row, sum): &(Row, f64)| {
        let one =
            |&(i, c, k): &(usize, usize, f64)| mul(n(k), p(&format!("p{i}.{}", ["x", "y"][c])));
        let left = row.iter().map(one).reduce(add).expect("a row has terms");
        equal(left, n(*sum))
    };
    Planted { parts, rules: rows.iter().map(term).collect(), culprit }
}

fn distance(i: usize, j: usize) -> Term {
    let along = |c: &str| sub(p(&format!("p{j}.{c}")), p(&format!("p{i}.{c}")));
    let square = |c| mul(along(c), along(c));
    call("sqrt", vec![add(square("x"), square("y"))])
}

/// Distances true of hidden places; the culprit is longer than the way round.
fn distances(seed: u64) -> Planted {
    let mut dice = Dice::new(seed);
    let hidden: Vec<[f64; 2]> =
        (0..5).map(|i| [20.0 * i as f64 + whole(&mut dice), 3.0 * whole(&mut dice)]).collect();
    let parts = hidden.iter().zip(0..).map(|(h, i)| (format!("p{i}"), h[0] + 1.0, h[1])).collect();
    let far = |i: usize, j: usize| {
        base::number::hypot(hidden[j][0] - hidden[i][0], hidden[j][1] - hidden[i][1])
    };
    let mut rules: Vec<Term> =
        (0..4).map(|i| equal(distance(i, i + 1), n(far(i, i + 1)))).collect();
    let i = dice.below(3);
    let wrong = 1.5 * (far(i, i + 1) + far(i + 1, i + 2));
    let culprit = dice.below(rules.len() + 1);
    rules.insert(culprit, equal(distance(i, i + 2), n(wrong)));
    Planted { parts, rules, culprit }
}

fn named(c: &Contradiction) -> Vec<usize> {
    let index = |s: &Source| match s {
        Source::Constraint(c) => *c as usize,
        Source::Stay(_) | Source::Wish(_) => panic!("only constraints were planted"),
    };
    c.constraints.iter().map(index).collect()
}

fn assert_found(planted: &Planted) {
    let found = planted.open(&planted.all()).contradictions();
    assert_eq!(found.len(), 1, "{found:?}");
    let set = named(&found[0]);
    assert!(set.contains(&planted.culprit), "{set:?} without {}", planted.culprit);
    assert!(!planted.open(&set).status().satisfied, "{set:?} can hold");
    for spared in &set {
        let rest: Vec<usize> = set.iter().copied().filter(|r| r != spared).collect();
        assert!(planted.open(&rest).status().satisfied, "{set:?} without {spared}");
    }
    for repair in &found[0].repairs {
        let Repair::LeaveOut { source: Source::Constraint(c), .. } = repair else { continue };
        let rest: Vec<usize> = planted.all().into_iter().filter(|r| r != &(*c as usize)).collect();
        assert!(planted.open(&rest).status().satisfied, "{repair:?} does not help");
    }
    let culprit = Source::Constraint(planted.culprit as u32);
    let spares = |r: &Repair| matches!(r, Repair::LeaveOut { source, .. } if *source == culprit);
    assert!(found[0].repairs.iter().any(spares), "{found:?}");
}

#[test]
fn a_planted_sum_is_found_with_just_those_that_it_contradicts() {
    (0..60).for_each(|seed| assert_found(&linear(seed)));
}

#[test]
fn a_planted_distance_is_found_with_just_those_that_it_contradicts() {
    (0..8).for_each(|seed| assert_found(&distances(seed)));
}

#[test]
fn nothing_is_found_where_everything_holds() {
    let planted = linear(1);
    let rest: Vec<usize> = planted.all().into_iter().filter(|&r| r != planted.culprit).collect();
    let mut lab = planted.open(&rest);
    assert!(lab.status().satisfied);
    assert_eq!(lab.contradictions(), []);
}

#[test]
fn a_number_that_a_rule_only_reads_is_told_the_value_that_it_would_need() {
    let mut b = Builder::new();
    let root = b.class("document", &[("a", POINT), ("b", POINT), ("size", REAL)]);
    b.given(root, "a", pair(0.0, 0.0));
    b.given(root, "b", pair(3.0, 4.0));
    b.given(root, "size", n(6.0));
    b.stay(root, "a", None);
    b.stay(root, "b", None);
    let along = |c: &str| sub(p(&format!("b.{c}")), p(&format!("a.{c}")));
    let square = |c| mul(along(c), along(c));
    let length = call("sqrt", vec![add(square("x"), square("y"))]);
    b.constraint(root, equal(length, p("size"))).reads = vec![crate::builder::to_path("size")];
    let mut lab = b.open(root);
    let found = lab.contradictions();
    let (a, end, size) = (lab.slot("a.x"), lab.slot("b.x"), lab.slot("size"));
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].anchors, [a, end]);
    assert_eq!(found[0].certainty, Certainty::Contradiction);
    let source = Source::Constraint(0);
    let [Repair::LeaveOut { source: left_out, numbers }, others @ ..] = &*found[0].repairs else {
        panic!("the rule can be left out: {found:?}")
    };
    assert_eq!(*left_out, source);
    assert!(numbers.contains(&(size, 6.0)) && numbers.len() == 5, "{numbers:?}");
    assert_eq!(
        others,
        [
            Repair::LetGo { slot: a },
            Repair::LetGo { slot: end },
            Repair::Change { slot: size, to: 5.0 },
        ]
    );
}

#[test]
fn a_pinned_bar_turns_and_a_free_one_moves_as_one() {
    let mut b = Builder::new();
    let parts: Vec<(String, _)> = (0..4).map(|i| (format!("p{i}"), POINT)).collect();
    let parts: Vec<_> = parts.iter().map(|(name, class)| (name.as_str(), *class)).collect();
    let root = b.class("document", &parts);
    for (name, x) in [("p0", 0.0), ("p1", 10.0), ("p2", 30.0), ("p3", 34.0)] {
        b.given(root, name, pair(x, x / 2.0));
    }
    b.stay(root, "p0", None);
    b.constraint(root, equal(distance(0, 1), n(10.0)));
    b.constraint(root, equal(distance(2, 3), n(5.0)));
    let mut lab = b.open(root);
    let analysis = lab.analyse();
    assert_eq!(analysis.freedom, 4);
    assert_eq!(lab.status().freedom, 4);
    let kinds: Vec<MotionKind> = analysis.motions.iter().map(|m| m.kind).collect();
    let alone = kinds.iter().filter(|k| **k == MotionKind::Alone).count();
    assert_eq!(alone, 3, "the end of either bar swings, and both ends of the free one: {kinds:?}");
    assert_eq!(kinds.last(), Some(&MotionKind::Translation));
    // a swing is across the bar
    let (x, y) = (lab.number("p1.x"), lab.number("p1.y"));
    let swing = &analysis.motions[0].moves;
    assert_eq!((swing[0].0, swing[1].0), (lab.slot("p1.x"), lab.slot("p1.y")));
    assert!((swing[0].1 * x + swing[1].1 * y).abs() < 1e-9);
}

#[test]
fn what_gives_way_to_first_order_alone_is_no_motion() {
    let mut b = Builder::new();
    let root = b.class("document", &[("p0", POINT), ("p1", POINT), ("p2", POINT)]);
    // two bars of 50 stretched between posts 100 apart
    for (name, x) in [("p0", 0.0), ("p1", 50.0), ("p2", 100.0)] {
        b.given(root, name, pair(x, 0.0));
    }
    b.stay(root, "p0", None);
    b.stay(root, "p2", None);
    b.constraint(root, equal(distance(0, 1), n(50.0)));
    b.constraint(root, equal(distance(1, 2), n(50.0)));
    let mut lab = b.open(root);
    let analysis = lab.analyse();
    assert_eq!(analysis.freedom, 0);
    assert_eq!(analysis.motions, []);
}

#[test]
fn what_touches_moves_with_what_it_touches() {
    let mut b = Builder::new();
    let root = b.class("document", &[("p0", POINT), ("p1", POINT), ("p2", POINT)]);
    // circles of 3 and 5 that touch in p2
    for (name, x) in [("p0", 0.0), ("p1", 8.0), ("p2", 3.0)] {
        b.given(root, name, pair(x, 0.0));
    }
    b.stay(root, "p0", None);
    b.constraint(root, equal(distance(0, 1), n(8.0)));
    b.constraint(root, equal(distance(0, 2), n(3.0)));
    b.constraint(root, equal(distance(1, 2), n(5.0)));
    let mut lab = b.open(root);
    let analysis = lab.analyse();
    assert_eq!(analysis.freedom, 1);
    let [motion] = &analysis.motions[..] else { panic!("one motion: {:?}", analysis.motions) };
    assert_eq!(motion.kind, MotionKind::Rotation { center: [0.0, 0.0] });
    let [(far, one), (near, part)] = motion.moves[..] else { panic!("two numbers move") };
    assert_eq!([far, near], [lab.slot("p1.y"), lab.slot("p2.y")]);
    assert_eq!([one, part], [1.0, 0.375]);
}
