//! The checker: every lie that a solver could tell is found out.

use crate::build::{Build, add, equal, method, num, op, part, path, send};
use eval::checker::{Edit, check_edit, check_state};
use kernel::{BinaryOperator, SlotId, Stay, Strength, Structure, Value, Values};

/// b = a + 1, c by itself, d anchored, whole in 0..9, words = a.text by written methods.
fn document() -> (Build, Structure) {
    let mut b = Build::new();
    let root = b.root();
    for name in ["a", "b", "c", "d"] {
        b.part(root, name, b.real);
    }
    b.part(root, "whole", b.integer);
    b.document.classes[root].parts[4].range = Some((0, 9));
    b.part(root, "words", b.text);
    b.constraint(root, "next", equal(part("b"), add(part("a"), num(1.0))));
    b.constraint(root, "shown", equal(part("words"), send(part("a"), "text", vec![]))).methods =
        vec![method(&["words"], vec![send(part("a"), "text", vec![])])];
    b.constraint(root, "wish", equal(part("c"), num(77.0))).strength = Strength::Weak;
    b.constraint(root, "off", equal(part("c"), part("a")));
    let origin = kernel::OriginId(0);
    let switch = kernel::Switch {
        path: kernel::Path::default(),
        name: "off".into(),
        setting: kernel::Setting::Enabled(kernel::Term::Bool(false)),
        origin,
    };
    b.document.classes[root].switches.push(switch);
    let stay = Stay { path: path("d"), strength: None, origin: kernel::OriginId(0) };
    b.document.classes[root].stays.push(stay);
    let structure = b.structure();
    (b, structure)
}
fn state(numbers: [f64; 5], words: &str) -> Values {
    let mut values = Values::new(6);
    for (i, x) in numbers.into_iter().enumerate() {
        values.numbers[SlotId(i as u32)] = x;
    }
    values.put(SlotId(5), Value::Text(words.into()));
    values
}
const RIGHT: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 5.0];

#[test]
fn a_right_state_is_praised() {
    let (b, structure) = document();
    assert_eq!(check_state(&b.document, &structure, &state(RIGHT, "1")), [""; 0]);
}

#[test]
fn a_wrong_state_is_found_out() {
    let (b, structure) = document();
    let says = |numbers, words| check_state(&b.document, &structure, &state(numbers, words));
    let [a, next, c, d, whole] = RIGHT;
    let off = ["next does not hold: 2.5 and 2, off by 5e-1"];
    assert_eq!(says([a, 2.5, c, d, whole], "1"), off);
    assert_eq!(says(RIGHT, "7"), ["shown does not hold: \"7\" and \"1\""]);
    assert_eq!(says([a, next, f64::NAN, d, whole], "1"), ["c is NaN"]);
    assert_eq!(says([a, next, -0.0, d, whole], "1"), ["c is a negative zero"]);
    assert_eq!(says([a, next, c, d, 5.5], "1"), ["whole is 5.5, no whole number"]);
    assert_eq!(says([a, next, c, d, 10.0], "1"), ["whole is 10, not in 0..9"]);
    let short = check_state(&b.document, &structure, &Values::new(2));
    assert_eq!(short, ["the state has another number of slots than the structure"]);
}

/// a + b = c: what differs by a part of 2e9 times 64 units in the last place, 2.8e-5, is rounding.
#[test]
fn a_sum_of_large_numbers_holds_to_their_rounding_and_no_further() {
    let mut b = Build::new();
    let root = b.root();
    for name in ["a", "b", "c"] {
        b.part(root, name, b.real);
    }
    b.constraint(root, "sum", equal(add(part("a"), part("b")), part("c")));
    let structure = b.structure();
    let says = |numbers: [f64; 3]| {
        let mut values = Values::new(3);
        for (i, x) in numbers.into_iter().enumerate() {
            values.numbers[SlotId(i as u32)] = x;
        }
        check_state(&b.document, &structure, &values).len()
    };
    assert_eq!(says([1e9, -1e9 + 1e-5, 0.0]), 0);
    assert_eq!(says([1e9, -1e9 + 1e-4, 0.0]), 1);
    // numbers of the size people use are held to what the sides say
    assert_eq!(says([1000.0, -1000.0 + 2e-9, 0.0]), 1);
    assert_eq!(says([1000.0, 0.0, 1000.0 + 1e-7]), 0);
}

#[test]
fn an_edit_moves_what_is_connected_and_nothing_else() {
    let (b, structure) = document();
    let before = state(RIGHT, "1");
    let says = |numbers, words, edited: &[SlotId]| {
        let after = state(numbers, words);
        check_edit(
            &b.document,
            &structure,
            Edit { before: &before, after: &after, edited, wishes: &[] },
        )
    };
    let moved = [6.0, 7.0, 3.0, 4.0, 5.0];
    assert_eq!(says(moved, "6", &[SlotId(0)]), [""; 0]);
    assert_eq!(says(moved, "6", &[SlotId(5)]), [""; 0]);
    let strayed = ["nothing connects c to the edit; 3 became 3.5"];
    assert_eq!(says([6.0, 7.0, 3.5, 4.0, 5.0], "6", &[SlotId(0)]), strayed);
    let anchored = ["d is anchored, and went from 4 to 5"];
    assert_eq!(says([1.0, 2.0, 3.0, 5.0, 5.0], "1", &[SlotId(0)]), anchored);
    assert_eq!(says([1.0, 2.0, 3.0, 5.0, 5.0], "1", &[SlotId(3)]), [""; 0]);
}

/// Numbers by name, those that are given with a value of their own.
fn numbers(names: &[&str], given: &[&str]) -> Build {
    let mut b = Build::new();
    let root = b.root();
    for name in names {
        b.part(root, name, b.real);
    }
    for name in given {
        b.given(root, name, num(0.0));
    }
    b
}

/// What is said of an edit of the last number.
fn says(b: &Build, before: &[f64], after: &[f64]) -> Vec<String> {
    let structure = b.structure();
    let [before, after] = [before, after].map(|numbers| {
        let mut values = Values::new(numbers.len());
        for (i, &x) in numbers.iter().enumerate() {
            values.numbers[SlotId(i as u32)] = x;
        }
        values
    });
    let edited = &[SlotId(before.numbers.len() as u32 - 1)];
    check_edit(
        &b.document,
        &structure,
        Edit { before: &before, after: &after, edited, wishes: &[] },
    )
}

/// x + y = z: of two that may both move neither moves alone, unless a bound holds it.
#[test]
fn a_change_that_is_not_the_least_is_found_out() {
    let mut b = numbers(&["x", "y", "z"], &[]);
    let root = b.root();
    b.constraint(root, "sum", equal(add(part("x"), part("y")), part("z")));
    let from = [1.0, 1.0, 2.0];
    assert_eq!(says(&b, &from, &[2.0, 2.0, 4.0]), [""; 0]);
    assert_eq!(says(&b, &from, &[1.0, 3.0, 4.0]), [""; 0], "x may have been held");
    let found = says(&b, &from, &[1.5, 2.5, 4.0]);
    assert!(found[0].starts_with("numbers changed more than they had to"), "{found:?}");
    b.constraint(root, "wall", op(BinaryOperator::LessEqual, part("x"), num(1.5)));
    assert_eq!(says(&b, &from, &[1.5, 2.5, 4.0]), [""; 0], "the wall holds x");
}

/// A place on x + y = z beside a wall: the wall may hold it, and may not pull it.
#[test]
fn a_bound_that_acts_the_wrong_way_is_found_out() {
    let mut b = Build::new();
    let root = b.root();
    b.part(root, "p", b.point);
    b.part(root, "z", b.length);
    b.constraint(root, "sum", equal(add(part("p.x"), part("p.y")), part("z")));
    let wall = |x| op(BinaryOperator::LessEqual, part("p.x"), num(x));
    b.constraint(root, "wall", wall(1.5));
    let from = [1.0, 1.0, 2.0];
    assert_eq!(says(&b, &from, &[1.5, 2.5, 4.0]), [""; 0], "without it x were 2");
    let pulled = says(&b, &from, &[1.5, 1.1, 2.6]);
    assert!(pulled[0].starts_with("numbers changed more than they had to"), "{pulled:?}");
}

/// a + k = z with a given: k yields, and a only where k cannot.
#[test]
fn a_given_number_that_yields_without_need_is_found_out() {
    let mut b = numbers(&["a", "k", "z"], &["a"]);
    let root = b.root();
    b.constraint(root, "sum", equal(add(part("a"), part("k")), part("z")));
    let from = [1.0, 1.0, 2.0];
    assert_eq!(says(&b, &from, &[1.0, 3.0, 4.0]), [""; 0]);
    let needless = ["a is given and went from 1 to 3, where others could have yielded"];
    assert_eq!(says(&b, &from, &[3.0, 1.0, 4.0]), needless);
    b.constraint(root, "held", equal(part("k"), num(1.0)));
    assert_eq!(says(&b, &from, &[3.0, 1.0, 4.0]), [""; 0], "nothing else can");
}

/// p = z by two written methods: the first writes p, the second q, which stands for p nowhere else.
#[test]
fn a_later_method_is_found_out_where_an_earlier_one_was_possible() {
    let mut b = numbers(&["p", "q", "z"], &[]);
    let root = b.root();
    b.constraint(root, "sum", equal(add(part("p"), part("q")), part("z"))).methods =
        vec![method(&["p"], vec![part("z")]), method(&["q"], vec![part("z")])];
    let from = [1.0, 1.0, 2.0];
    assert_eq!(says(&b, &from, &[3.0, 1.0, 4.0]), [""; 0]);
    let later = ["sum took its method 2, and method 1 was possible"];
    assert_eq!(says(&b, &from, &[1.0, 3.0, 4.0]), later);
    b.constraint(root, "other", equal(part("p"), num(1.0)));
    assert_eq!(says(&b, &from, &[1.0, 3.0, 4.0]), [""; 0], "another constraint speaks of p");
}
