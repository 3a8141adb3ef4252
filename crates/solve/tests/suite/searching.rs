//! Whole numbers: what is found is what trying everything finds.

use base::Dice;
use expr::{Arena, Binary, ExprId, Unary, Var};
use solve::{
    COUNTING, Conditional, Count, Demand, DemandKind, Level, Patterns, Puzzle, Relation,
    RelationBody, Slot, SlotRange, Span, Stay, Verdict,
};

/// Whole numbers from 0 to `most`, of which these expressions are true.
fn puzzle(stays: &[Stay], most: i64, arena: &Arena, truths: &[ExprId]) -> Puzzle {
    let mut patterns = Patterns::default();
    let mut stated = Conditional::default();
    for (&stay, slot) in stays.iter().zip(0..) {
        stated.system.slots.push(Slot { stay, scale: 0, is_number: true, is_discrete: true });
        stated.ranges.push(SlotRange { slot, low: 0, high: most, is_by_class: false });
    }
    for (&truth, relation) in truths.iter().zip(0..) {
        let (pattern, slots) = patterns.intern(arena, &[truth]);
        let arguments = stated.system.add_arguments(slots.into_iter().map(|v| v.0));
        stated.demands.push(Demand { relation, kind: DemandKind::True, pattern, arguments });
        stated.system.relations.push(Relation {
            level: Level::Required,
            body: RelationBody::Equations(Span::default()),
            methods: Default::default(),
            derived: true,
            reads: Default::default(),
            within: base::number::Tolerance::Relative,
            source: relation,
            rests: false,
        });
    }
    assert!(stated.is_searched());
    Puzzle::new(&stated, &patterns)
}

const KEPT: Stay = Stay::Kept { group: 0 };

#[test]
fn a_contradiction_is_impossible_and_not_merely_undecided() {
    let mut arena = Arena::new();
    let [x, y] = [0, 1].map(|v| arena.var(Var(v)));
    let less = arena.binary(Binary::Less, x, y);
    let more = arena.binary(Binary::Less, y, x);
    let puzzle = puzzle(&[KEPT, KEPT], 9, &arena, &[less, more]);
    assert_eq!(puzzle.nearest(&[1.0, 1.0], &[1.0, 1.0]), Verdict::Impossible);
    let count = puzzle.count(&[1.0, 1.0], u64::MAX, &mut COUNTING.clone());
    assert_eq!((count.solutions, count.is_complete), (0, true));
}

#[test]
fn a_known_number_that_is_not_whole_has_no_solution() {
    let mut arena = Arena::new();
    let [x, y] = [0, 1].map(|v| arena.var(Var(v)));
    let equal = arena.binary(Binary::Equal, x, y);
    let puzzle = puzzle(&[Stay::Fixed, KEPT], 9, &arena, &[equal]);
    assert_eq!(puzzle.nearest(&[0.5, 0.0], &[0.5, 0.0]), Verdict::Impossible);
}

#[test]
fn a_given_number_yields_only_where_nothing_else_can() {
    let mut arena = Arena::new();
    let [x, y] = [0, 1].map(|v| arena.var(Var(v)));
    let less = arena.binary(Binary::Less, x, y);
    let puzzle = puzzle(&[Stay::Given(solve::Giver::Document), KEPT], 9, &arena, &[less]);
    let start = [5.0, 4.0];
    assert_eq!(puzzle.nearest(&start, &start), Verdict::Found(vec![5.0, 6.0]));
    let start = [9.0, 4.0];
    let nearest = puzzle.nearest(&start, &start);
    assert_eq!(nearest, Verdict::Found(vec![8.0, 9.0]), "the given number changes least");
}

fn some_number(dice: &mut Dice, arena: &mut Arena, depth: u32) -> ExprId {
    if depth == 0 || dice.below(3) == 0 {
        return match dice.below(4) {
            0 => arena.constant(dice.below(5) as f64),
            v => arena.var(Var(v as u32 - 1)),
        };
    }
    let a = some_number(dice, arena, depth - 1);
    let b = some_number(dice, arena, depth - 1);
    match dice.below(4) {
        0 => arena.add(a, b),
        1 => arena.sub(a, b),
        2 => arena.mul(a, b),
        _ => arena.unary(Unary::Abs, a),
    }
}

fn some_truth(dice: &mut Dice, arena: &mut Arena, depth: u32) -> ExprId {
    if depth > 0 && dice.below(2) == 0 {
        let a = some_truth(dice, arena, depth - 1);
        let b = some_truth(dice, arena, depth - 1);
        return match dice.below(3) {
            0 => arena.binary(Binary::And, a, b),
            1 => arena.binary(Binary::Or, a, b),
            _ => arena.unary(Unary::Not, a),
        };
    }
    let a = some_number(dice, arena, 2);
    let b = some_number(dice, arena, 2);
    let op = [Binary::Less, Binary::LessEqual, Binary::Equal, Binary::NotEqual];
    arena.binary(op[dice.below(4)], a, b)
}

#[test]
fn a_count_ends_where_there_are_enough_or_it_is_too_much_work() {
    let mut arena = Arena::new();
    let vars = [0, 1, 2].map(|v| arena.var(Var(v)));
    let less = arena.binary(Binary::LessEqual, vars[0], vars[1]);
    let also = arena.binary(Binary::LessEqual, vars[1], vars[2]);
    let puzzle = puzzle(&[KEPT; 3], 99, &arena, &[less, also]);
    let start = [0.0; 3];
    let count = |enough, most: u64| puzzle.count(&start, enough, &mut most.clone());
    // 102 choose 3 ways to place three numbers in order
    assert_eq!(count(u64::MAX, COUNTING), Count { solutions: 171_700, is_complete: true });
    assert_eq!(count(2, COUNTING), Count { solutions: 2, is_complete: false });
    assert_eq!(count(171_701, COUNTING), Count { solutions: 171_700, is_complete: true });
    let given_up = count(u64::MAX, 100_000);
    assert!(!given_up.is_complete && given_up.solutions < 171_700, "{given_up:?}");
    let none = Count { solutions: 0, is_complete: true };
    assert_eq!(given_up.and(none), none);
    assert!(!given_up.and(Count { solutions: 2, is_complete: true }).is_complete);
}

#[test]
fn the_nearest_and_the_count_are_those_of_trying_everything() {
    let mut dice = Dice::new(7);
    let mut found_some = 0;
    for _ in 0..400 {
        let mut arena = Arena::new();
        (0..3).for_each(|v| {
            arena.var(Var(v));
        });
        let truths: Vec<ExprId> =
            (0..1 + dice.below(3)).map(|_| some_truth(&mut dice, &mut arena, 2)).collect();
        let start: Vec<f64> = (0..3).map(|_| dice.below(5) as f64).collect();
        let puzzle = puzzle(&[KEPT; 3], 4, &arena, &truths);
        let mut all: Vec<(f64, Vec<f64>)> = Vec::new();
        for i in 0..125 {
            let values = [i / 25, i / 5 % 5, i % 5].map(f64::from).to_vec();
            if truths.iter().all(|&t| arena.evaluate(t, &values) != 0.0) {
                let away = values.iter().zip(&start).map(|(a, b)| (a - b) * (a - b)).sum();
                all.push((away, values));
            }
        }
        let count = puzzle.count(&start, u64::MAX, &mut COUNTING.clone());
        assert!(count.is_complete);
        assert_eq!(count.solutions, all.len() as u64);
        let least = all.iter().map(|a| a.0).min_by(f64::total_cmp);
        match (puzzle.nearest(&start, &start), least) {
            (Verdict::Found(values), Some(least)) => {
                found_some += 1;
                assert!(all.contains(&(least, values.clone())), "{values:?} is not the nearest");
            }
            (verdict, least) => {
                assert_eq!((verdict, least), (Verdict::Impossible, None));
            }
        }
    }
    assert!(found_some > 100, "{found_some} had solutions");
}
