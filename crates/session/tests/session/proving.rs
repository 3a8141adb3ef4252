//! Contradictions that are proved: of linear constraints by a sum that can be checked by hand, of whole numbers by a
//! search of all there are.

use crate::desk::{Desk, Library};
use session::jobs::{Desk as Copies, Job, LongAnswer, LongQuestion};

fn told(text: &str) -> Vec<String> {
    let mut desk = Desk::of(text);
    let analysis = desk.session.analysis(desk.id);
    analysis.contradictions.into_iter().map(|c| c.message).collect()
}

#[test]
fn equations_are_added_up() {
    let text = "a, b, c: Real\nconstraint first: a + b = 10\nconstraint second: a - b = 4\n\
        constraint other: b + c = 1\nconstraint third: a = 8\n";
    let proof = "first, second, third contradict each other: \
        0.5 × first + 0.5 × second says 7, third says 8";
    assert_eq!(told(text), [proof]);
}

#[test]
fn bounds_are_added_up_with_the_right_sign() {
    let text = "a, b: Real\nconstraint least: a >= 3\nconstraint above: b >= 4 + a\n\
        constraint most: 2 * a + b <= 12\n";
    let proof = "least, above, most contradict each other: \
        3 × least + above says at least 13, most says at most 12";
    assert_eq!(told(text), [proof]);
    // the same bounds with room between them
    assert_eq!(told(&text.replace("<= 12", "<= 13")), [""; 0]);
}

#[test]
fn an_anchored_number_counts_as_it_is() {
    let text = "p, q, r: Real = 1\nanchor p\nconstraint one: q = p + 10\n\
        constraint two: r = q + 20\nconstraint sum: q + r = 43\n";
    let proof = "2 × one + two says 42, sum says 43";
    let found = told(text);
    assert!(found.len() == 1 && found[0].ends_with(proof), "{found:?}");
}

#[test]
fn what_is_not_linear_is_not_proved() {
    let text = "a, b: Real = 1\nconstraint ring: a^2 + b^2 = 1\nconstraint far: a = 3\n";
    assert_eq!(told(text), ["no solution of ring, far together was found, from 50 starts"]);
}

#[test]
fn what_was_searched_to_its_end_contradicts() {
    let text = "a, b, c: Integer in 1..3\nconstraint all: allDifferent(a, b, c)\n\
        constraint sum: a + b = 3\nconstraint low: c < 3\nconstraint odd: a * c != 7";
    // 1 and 2 are taken by a and b, so that c is 3
    assert_eq!(told(text), ["all, sum, low contradict each other: a, b, c are in 1..3"]);
}

#[test]
fn what_comes_to_nothing_for_the_given_numbers_contradicts() {
    // v = 30 and w = 20, so that the last says 0 = 400; with any other number given it could hold
    let text = "u: Real = 15\nv, w, image: Real\nconstraint first: v * (u - 10) = u * 10\n\
        constraint between: w = 50 - v\nconstraint second: image * (w - 20) = w * 20\n\
        free: Real\nconstraint other: free = u + v\n";
    let found = ["no solution of first, between, second together was found, from 50 starts"];
    assert_eq!(told(text), found);
    assert_eq!(told(&text.replace("= 15", "= 16")), [""; 0]);
}

#[test]
fn a_line_that_would_have_to_vanish_contradicts() {
    let text = "use geometry\na: Line { p1 = (0, 0)  p2 = (100, 0) }\n\
        b: Line { p1 = (0, 40)  p2 = (100, 40) }\nconstraint level: a.p1.y = a.p2.y\n\
        constraint par: a.parallel(to: b)\nconstraint off1: a.offset(of: b.p1) = 40\n\
        constraint off2: a.offset(of: b.p2) = 41\n";
    let found = ["no solution of par, off1, off2 together was found, from 50 starts"];
    assert_eq!(told(text), found);
    assert_eq!(told(&text.replace("= 41", "= 40")), [""; 0]);
}

#[test]
fn what_can_hold_elsewhere_is_no_contradiction() {
    // two bars fold back, and two more: -8 + 8 = 0; one pair alone is not enough
    let text = "use geometry\na: Point = (0, 0)\nb, d: Point = (8, 6)\nc, e: Point = (16, 0)\n\
        anchor a\nconstraint b.y = 6\nconstraint c.y = 0\nconstraint d.y = 6\n\
        constraint e.y = 0\nconstraint a.distance(to: b) = 10\nconstraint b.distance(to: c) = 10\n\
        constraint a.distance(to: d) = 10\nconstraint d.distance(to: e) = 10\n\
        constraint side: c.x + e.x <= 2\n";
    let mut desk = Desk::of(text);
    let found = desk.session.analysis(desk.id).contradictions;
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(
        found[0].message,
        "side can hold with all the others, but not from where things are"
    );
    assert!(!found[0].decided);
    assert_eq!(found[0].repairs, ["set b.x to -8, set d.x to -8, set c.x to 0, set e.x to 0"]);
    desk.type_text(&text.replace("(8, 6)", "(-8, 6)").replace("(16, 0)", "(0, 0)"));
    assert!(desk.session.status(desk.id).satisfied);
}

#[test]
fn what_stands_in_a_contradiction_says_something() {
    let text = "x: Real = 5\ny: Real = 2\nconstraint p: x * y = 10\nconstraint q: y = 2\n";
    let redundant = |text: &str| {
        let mut desk = Desk::of(text);
        let found = desk.session.analysis(desk.id).redundant;
        found.into_iter().map(|r| r.constraint).collect::<Vec<_>>()
    };
    // without p it would be 14
    assert_eq!(redundant(&format!("{text}constraint r: x = 7\n")), [""; 0]);
    assert_eq!(redundant(&format!("{text}constraint r: x = 5\n")).len(), 1);
}

#[test]
fn a_repair_tells_texts_in_quotes_and_nothing_of_a_written_number() {
    let repairs = |text: &str| {
        let mut desk = Desk::of(text);
        let mut found = desk.session.analysis(desk.id).contradictions;
        found.pop().map_or_else(Vec::new, |c| c.repairs)
    };
    assert_eq!(
        repairs("t: Text\nconstraint own: t = \"a\" + t\n"),
        ["delete own or switch it off; then t is \"\", \"a\" + t is \"a\""]
    );
    assert_eq!(
        repairs("x: Real\nconstraint root: sqrt(x) = -1\n"),
        ["delete root or switch it off; then sqrt(x) is 0"]
    );
    // in degrees, and with no more digits than hold
    assert_eq!(
        repairs(
            "a: Angle = 30 deg\nb: Angle = 45 deg\nanchor a\nanchor b\nconstraint right: a + b = 90 deg\n"
        ),
        [
            "delete right or switch it off; then a + b is 75 deg",
            "let go of a",
            "let go of b",
            "set a to 45 deg",
            "set b to 60 deg"
        ]
    );
    // a sum of percentages is one
    assert_eq!(
        repairs(
            "a: Real = 70 %\nb: Real = 40 %\nanchor a\nanchor b\nconstraint all: a + b = 100 %\n"
        )[0],
        "delete all or switch it off; then a + b is 110 %"
    );
}

#[test]
fn no_repair_praises_a_rectangle_that_comes_to_nothing() {
    let mut desk = Desk::of(
        "use geometry\nunit mm\na, b, c, d: Line\nmerge a.p2 = b.p1\nmerge b.p2 = c.p1\n\
         merge c.p2 = d.p1\nmerge d.p2 = a.p1\nconstraint a.parallel(to: c)\n\
         constraint b.parallel(to: d)\nconstraint a.perpendicular(to: b)\n\
         constraint long: a.length = 40\nconstraint longer: c.length = 45\nconstraint b.length = 20\n",
    );
    let found = desk.session.analysis(desk.id).contradictions;
    let repairs: Vec<String> = found.into_iter().flat_map(|c| c.repairs).collect();
    assert!(repairs.contains(&"delete long or switch it off".to_string()), "{repairs:?}");
    assert!(repairs.iter().all(|r| !r.contains("is 0") && !r.contains("fm")), "{repairs:?}");
}

/// A beam between two joints, and one that hangs from it: along both their pulls say the same twice.
const BEAMS: &str = "use bridges\na: FixedJoint { at = (0, 0) }\nb, c: FreeJoint\n\
    ab: Beam { rest = 80 }\nmerge a = ab.a.joint\nmerge b = ab.b.joint\n\
    bc: Beam { rest = 80 }\nmerge b = bc.a.joint\nmerge c = bc.b.joint\n\
    b.at = (80, 0)\nc.at = (160, 0)\n";

#[test]
fn what_may_be_free_besides_is_told_as_the_least_until_it_is_counted() {
    let mut desk = Desk::of(BEAMS);
    let least = desk.session.standing(desk.id);
    assert!(!least.counted);
    assert_eq!(least.message, "all constraints hold; what is free is not counted yet");
    // each turns around the joint before it
    assert_eq!(desk.session.status(desk.id).freedom, 2);
    let counted = desk.session.standing(desk.id);
    assert!(counted.counted);
    assert_eq!(counted.message, "all constraints hold; 2 degrees of freedom");
    desk.drag("c.at", &[(150.0, 30.0), (130.0, 60.0)]);
    // the form is as it was: what was counted is told until it is counted again
    let presumed = desk.session.standing(desk.id);
    assert_eq!((presumed.counted, presumed.freedom), (false, 2));
    assert_eq!(presumed.message, "all constraints hold; 2 degrees of freedom");
    desk.session.analysis(desk.id);
    assert!(desk.session.standing(desk.id).counted, "an analysis counts as well");
}

#[test]
fn what_a_text_of_another_form_leaves_free_is_not_told_of_this_one() {
    let with = |constraint| format!("{BEAMS}x: Real\nconstraint held: x = {constraint}\n");
    let mut desk = Desk::of(&with("3"));
    // what can no longer be read is in force as it was
    desk.type_text(&with(")"));
    let at_once = desk.session.standing(desk.id);
    assert!(!at_once.counted);
    let mut copies = Copies::default();
    copies.take(desk.session.job(desk.id, LongQuestion::More));
    let Some(LongAnswer::More { form, more }) = copies.answer(0) else { panic!("it is counted") };
    assert_eq!(form + more, 3, "to the text alone the number is free as well");
    desk.session.note_more(desk.id, form, more);
    assert_eq!(desk.session.standing(desk.id), at_once);
    assert_eq!(desk.session.status(desk.id).freedom, 2);
}

#[test]
fn what_hands_do_first_is_rehearsed_to_its_end() {
    let job = Job::rehearsal(&Library).expect("the library is there");
    let mut copies = Copies::default();
    copies.take(job);
    assert_eq!(copies.answer(0), None, "nothing of it is refused");
}

#[test]
fn to_let_go_of_a_point_is_not_offered_where_lengths_contradict_without_it() {
    for text in [
        "use geometry\nl: Line { p1 = (0, 0)  p2 = (100, 0) }\nanchor l.p1\n\
         constraint a: l.length = 100\nconstraint b: l.length = 50\n",
        "use geometry\np1, p2, p3: Point\np1 = (0, 0)\np2 = (100, 0)\np3 = (50, 50)\nanchor p1\n\
         constraint a: p1.distance(to: p2) = 100\nconstraint b: p2.distance(to: p3) = 30\n\
         constraint c: p1.distance(to: p3) = 30\n",
        "use geometry\np1, p2: Point\np1 = (0, 0)\np2 = (100, 0)\nanchor p1\nanchor p2\n\
         constraint a: p1.distance(to: p2) = 100\nconstraint b: p1.distance(to: p2) = 50\n",
    ] {
        let mut desk = Desk::of(text);
        let found = desk.session.analysis(desk.id).contradictions;
        for c in &found {
            assert!(!c.repairs.is_empty(), "{text}");
            assert!(
                c.repairs.iter().all(|repair| !repair.starts_with("let go")),
                "{:?}",
                c.repairs
            );
        }
    }
}
