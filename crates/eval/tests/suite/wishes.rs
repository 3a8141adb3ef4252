//! Wishes: the checker finds out where a drag could have come nearer to the pointer.

use crate::build::{Build, add, equal, num, op, part};
use eval::checker::{Edit, check_edit};
use kernel::{BinaryOperator, SlotId, Values};

/// What is said of a drag of the first numbers to where they are wished.
fn says(b: &Build, before: [f64; 2], after: [f64; 2], wished: &[f64]) -> Vec<String> {
    let structure = b.structure();
    let [before, after] = [before, after].map(|numbers| {
        let mut values = Values::new(2);
        (0..).zip(numbers).for_each(|(i, x)| values.numbers[SlotId(i)] = x);
        values
    });
    let wishes: Vec<(SlotId, f64)> = (0..).map(SlotId).zip(wished.iter().copied()).collect();
    let edited: Vec<SlotId> = wishes.iter().map(|(slot, _)| *slot).collect();
    let edit = Edit { before: &before, after: &after, edited: &edited, wishes: &wishes };
    check_edit(&b.document, &structure, edit)
}

fn two_numbers() -> Build {
    let mut b = Build::new();
    let root = b.root();
    b.part(root, "x", b.real);
    b.part(root, "y", b.real);
    b
}

/// x + y = 2 and x <= 3: the wall stops x, and is not what keeps it from going the other way.
#[test]
fn what_stops_short_of_a_wall_and_what_sticks_to_it_is_found_out() {
    let mut b = two_numbers();
    let root = b.root();
    b.constraint(root, "sum", equal(add(part("x"), part("y")), num(2.0)));
    b.constraint(root, "wall", op(BinaryOperator::LessEqual, part("x"), num(3.0)));
    let from = [1.0, 1.0];
    assert_eq!(says(&b, from, [3.0, -1.0], &[5.0]), [""; 0]);
    assert_eq!(says(&b, from, [2.5, -0.5], &[2.5]), [""; 0]);
    let short = says(&b, from, [2.5, -0.5], &[5.0]);
    assert!(short[0].starts_with("x could be nearer to the pointer"), "{short:?}");
    let still = says(&b, from, from, &[5.0]);
    assert!(still[0].starts_with("x could be nearer to the pointer"), "{still:?}");
    let stuck = says(&b, from, [3.0, -1.0], &[0.0]);
    assert!(stuck[0].starts_with("x could be nearer to the pointer"), "{stuck:?}");
}

/// x² + y² = 1: of all places on the circle one is nearest to the pointer.
#[test]
fn the_nearest_place_on_a_circle_is_praised_alone() {
    let mut b = two_numbers();
    let root = b.root();
    let square = |name| op(BinaryOperator::Multiply, part(name), part(name));
    b.constraint(root, "circle", equal(add(square("x"), square("y")), num(1.0)));
    let from = [0.0, 1.0];
    assert_eq!(says(&b, from, [0.8, 0.6], &[4.0, 3.0]), [""; 0]);
    let aside = says(&b, from, [0.6, 0.8], &[4.0, 3.0]);
    assert!(aside[0].starts_with("x, y could be nearer to the pointer"), "{aside:?}");
}
