//! Standard parts, drawn once by hand: what comes of them is that of the programs that the gallery has of them.

use crate::desk::Desk;
use session::Command;
use session::drafting::view::{Ends, Go, NewParameter, Turn, Wants};
use session::view::Pointer;

/// An operand: typed, or picked.
#[derive(Clone, Copy)]
pub(crate) enum By<'t> {
    Typed(&'t str),
    At(f64, f64),
}
use By::{At, Typed};

/// Draws by a construction.
pub(crate) fn draw(desk: &mut Desk, tool: &str, operands: &[By<'_>]) -> String {
    drawn(desk, (tool, false), operands)
}

/// Draws for construction alone.
fn guide(desk: &mut Desk, tool: &str, operands: &[By<'_>]) -> String {
    drawn(desk, (tool, true), operands)
}

fn drawn(desk: &mut Desk, (tool, is_guide): (&str, bool), operands: &[By<'_>]) -> String {
    desk.session.begin(desk.id, tool).unwrap_or_else(|r| panic!("{tool}: {}", r.message));
    desk.session.draw_guides(desk.id, is_guide);
    let mut last = None;
    for operand in operands {
        let turn = match *operand {
            Typed(text) => desk.session.enter(desk.id, text),
            At(x, y) => {
                let pointer = Pointer { at: (x, y), reach: 0.4, ..Pointer::default() };
                desk.session.hover(desk.id, &pointer, "");
                desk.session.point(desk.id, &pointer)
            }
        };
        last = Some(turn.unwrap_or_else(|r| panic!("{tool}: {}\n{}", r.message, desk.text())));
    }
    match last {
        Some(Turn::Made { name, .. }) => name,
        other => panic!("{tool} waits: {other:?}"),
    }
}

fn value(desk: &Desk, path: &str) -> String {
    desk.session.comes_to(desk.id, path).unwrap_or_else(|| panic!("{path}: {}", desk.text()))
}

#[test]
fn a_step_whose_name_was_typed_with_a_capital_is_asked_about() {
    let mut desk = Desk::recording("Rings", &[]);
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("5")]);
    let text = desk.text().replace("circle =", "Rim =");
    desk.type_text(&text);
    desk.session.begin_loop(desk.id, "").expect("a loop");
    let two = [Typed("Rim"), Typed("Rim.radius + 2")];
    draw(&mut desk, "Circle.concentric(with,radius)", &two);
    desk.session.end_turn(desk.id, Ends::Until).expect("the turn is drawn");
    let prompt = desk.session.prompt(desk.id).expect("it is asked");
    let Wants::Recurrence(asked) = prompt.wants else { panic!("{prompt:?}") };
    assert_eq!((&*asked.operand, &*asked.first, asked.of), ("with", "Rim", 2));
}

#[test]
fn the_numbers_of_a_second_turn_are_the_same_by_enter_alone() {
    let mut desk = Desk::recording("Comb", &[("pitch", "12"), ("tooth", "20")]);
    desk.session.begin_loop(desk.id, "").expect("a loop");
    for (tool, from, length) in [
        ("Line.vertical(from,length)", "0, 0", "tooth"),
        ("Line.horizontal(from,length)", "line.p2", "pitch / 2"),
        ("Line.vertical(from,length)", "line2.p2", "-tooth"),
        ("Line.horizontal(from,length)", "line3.p2", "pitch / 2"),
    ] {
        draw(&mut desk, tool, &[Typed(from), Typed(length)]);
        desk.session.give_up(desk.id);
    }
    desk.session.end_turn(desk.id, Ends::Until).expect("a turn is drawn");
    // of an object there is no such answer
    let refused = desk.session.enter(desk.id, "").expect_err("it is an object");
    assert!(refused.message.contains("press `The same`"), "{}", refused.message);
    for typed in ["line4.p2", "", "", "", ""] {
        desk.session.enter(desk.id, typed).unwrap_or_else(|r| panic!("{typed}: {}", r.message));
    }
    desk.session.enter(desk.id, "line4.p2.x > 55").expect("it ends");
    assert_eq!(value(&desk, "comb.turns"), "5 turns");
}

#[test]
fn a_second_turn_that_was_run_ahead_is_the_one_of_what_is_drawn_now() {
    let shown = |is_ahead: bool| {
        let mut desk = Desk::recording("Row", &[("pitch", "20")]);
        desk.session.begin_loop(desk.id, "").expect("a loop");
        for place in ["pitch, 0", "pitch, 5"] {
            draw(&mut desk, "Circle", &[Typed(place), Typed("3")]);
            if is_ahead {
                desk.session.foresee_turn(desk.id, None);
            }
        }
        desk.session.end_turn(desk.id, Ends::Until).expect("a turn is drawn");
        let nowhere = Pointer { reach: -1.0, ..Pointer::default() };
        let lit = desk.session.hover(desk.id, &nowhere, "");
        let first = Pointer { at: (23.0, 0.0), reach: 0.4, ..Pointer::default() };
        if is_ahead {
            desk.session.foresee_turn(desk.id, Some(&first));
        }
        (desk.session.prompt(desk.id), lit, desk.text())
    };
    let (prompt, lit, text) = shown(true);
    assert_eq!((&prompt, &lit, &text), (&shown(false).0, &shown(false).1, &shown(false).2));
    // the two circles of the second turn, and nothing under a pointer that is nowhere
    let circles = |e: &&drawing::Element| matches!(e.shape, drawing::Shape::Circle { .. });
    assert_eq!((lit.ghost.elements.iter().filter(circles).count(), lit.finds), (2, None));
}

#[test]
fn a_band_takes_what_a_loop_begins_with_where_nothing_else_draws_it() {
    let mut desk = Desk::recording("Rings", &[]);
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("5")]);
    let turns = "t = repeat 3 times with k = Circle(Point(30, 0), 2) {
        d = Circle.concentric(with: k, radius: k.radius + 1)
        next k = d
    }
    circle =";
    let text = desk.text().replace("circle =", turns);
    desk.type_text(&text);
    let everything = ((-100.0, -100.0), (100.0, 100.0));
    desk.session.begin_each(desk.id, everything).expect("five circles");
    let five = "for element in [t[0].k, t[0].d, t[1].d, t[2].d, circle] {";
    assert!(desk.text().contains(five), "{}", desk.text());
}

#[test]
fn a_nut_is_a_flat_in_a_polar_pattern() {
    let mut desk = Desk::recording("Nut", &[("s", "16"), ("d", "10")]);
    guide(&mut desk, "Point", &[Typed("0, 0")]);
    guide(&mut desk, "Point", &[Typed("0, s / (2 * cos(30 deg))")]);
    guide(&mut desk, "Point:turned", &[At(0.0, 9.24), At(0.0, 0.0), Typed("60")]);
    draw(&mut desk, "Line", &[At(0.0, 9.24), At(-8.0, 4.62)]);
    let five =
        draw(&mut desk, ":pattern(about,count)", &[At(-4.0, 6.93), At(0.0, 0.0), Typed("6")]);
    assert_eq!(five, "pattern");
    draw(&mut desk, "Circle", &[At(0.0, 0.0), Typed("d / 2")]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // the first flat is drawn already, and not twice
    assert_eq!(value(&desk, "nut.pattern"), "5 figures");
    // the flat opposite of the first one; corners lie 16 / √3 from the middle
    assert_eq!(value(&desk, "nut.pattern[2]"), "(0, -9.2376) to (8, -4.6188)");
    desk.set("nut.s", 24.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "nut.pattern[2]"), "(0, -13.8564) to (12, -6.9282)");
    // a row of figures, each as far on as a point from the origin
    let row = draw(&mut desk, ":pattern(by,count)", &[At(5.0, 0.0), Typed("30,0"), Typed("3")]);
    assert_eq!(value(&desk, &format!("nut.{row}[1]")), "centre (60, 0), radius 5");
    let steps = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let words: Vec<&str> = steps.iter().map(|row| row.words.as_str()).collect();
    assert!(words.contains(&"polar pattern: line, about point, count 6"), "{words:?}");
    // how many there are is changed in one place, though it is written in two
    desk.session.set_operand(desk.id, ("nut", "pattern", "count"), "8").expect("it is a count");
    assert_eq!(value(&desk, "nut.pattern"), "7 figures");
    desk.session.make_guide(desk.id, ("Nut", "line"), true).expect("it has a name");
    assert!(desk.text().contains("guide line = Line("), "{}", desk.text());
    // there are as many flats, whether the first one is drawn by the pattern or by the line
    assert_eq!(value(&desk, "nut.pattern"), "8 figures");
    desk.session.make_guide(desk.id, ("Nut", "line"), false).expect("it has a name");
    assert!(!desk.text().contains("guide line"), "{}", desk.text());
    assert_eq!(value(&desk, "nut.pattern"), "7 figures");
    for (what, flats) in [("Line(point2, point)", "8 figures"), ("-line", "7 figures")] {
        desk.session.set_operand(desk.id, ("nut", "pattern", "what"), what).expect("it is a line");
        assert_eq!(value(&desk, "nut.pattern"), flats, "{what}");
    }
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_pattern_draws_all_flats_where_the_first_one_is_deleted() {
    let mut desk = Desk::recording("Nut", &[]);
    guide(&mut desk, "Point", &[Typed("0, 0")]);
    guide(&mut desk, "Point", &[Typed("0, 9")]);
    guide(&mut desk, "Point", &[Typed("-8, 4.5")]);
    draw(&mut desk, "Line", &[Typed("point2"), Typed("point3")]);
    draw(&mut desk, ":pattern(about,count)", &[Typed("line"), Typed("point"), Typed("6")]);
    assert_eq!(value(&desk, "nut.pattern"), "5 figures");
    // brackets around the place make it no other pattern
    desk.session.set_operand(desk.id, ("nut", "pattern", "about"), "(point)").expect("a place");
    desk.session.begin_delete(desk.id, "line").expect("it is a step");
    desk.session.enter(desk.id, "Line(point2, point)").expect("it is a line");
    assert!(desk.text().contains("(0..6 - 1).map(nth => Line(point2, point)."), "{}", desk.text());
    assert_eq!(value(&desk, "nut.pattern"), "6 figures");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_deletion_that_is_refused_waits_for_nothing() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program P() {
    circle = Circle(center: Point(0, 0), radius: 3)
}
p: P
double: Length => 2 * p.circle.radius
",
    );
    assert_eq!(desk.wrong(), []);
    desk.session.record(desk.id, "P").expect("it is there");
    let before = desk.text();
    desk.session.begin_delete(desk.id, "circle").expect_err("the document speaks of it");
    assert_eq!(desk.text(), before);
    draw(&mut desk, "Circle", &[Typed("9, 0"), Typed("2")]);
}

#[test]
fn a_pattern_of_what_is_only_typed_draws_all_of_it() {
    let typed = "Circle(center: Point(45, 0), radius: 5)";
    let mut desk = Desk::of("use geometry\nunit mm\n");
    draw(&mut desk, ":pattern(about,count)", &[Typed(typed), Typed("0, 0"), Typed("6")]);
    assert_eq!(value(&desk, "pattern"), "6 figures");
    let mut desk = Desk::recording("Flange", &[]);
    let operands = [Typed(typed), Typed("0, 0"), Typed("6")];
    draw(&mut desk, ":pattern(about,count)", &operands);
    assert_eq!(value(&desk, "flange.pattern"), "6 figures");
    // what is drawn is there, though it is turned round
    draw(&mut desk, "Circle", &[Typed("90, 0"), Typed("5")]);
    draw(&mut desk, ":pattern(about,count)", &[Typed("-circle"), Typed("0, 0"), Typed("6")]);
    assert_eq!(value(&desk, "flange.pattern2"), "5 figures");
    // a guide is not
    guide(&mut desk, "Circle", &[Typed("20, 0"), Typed("5")]);
    draw(&mut desk, ":pattern(about,count)", &[Typed("circle2"), Typed("0, 0"), Typed("6")]);
    assert_eq!(value(&desk, "flange.pattern3"), "6 figures");
}

#[test]
fn a_rubber_band_for_copies_takes_no_guides() {
    let mut desk = Desk::recording("Flange", &[]);
    guide(&mut desk, "Circle", &[Typed("0, 0"), Typed("3")]);
    draw(&mut desk, "Circle", &[Typed("10, 0"), Typed("2")]);
    guide(&mut desk, "Axis.vertical(x)", &[Typed("100")]);
    desk.session.begin(desk.id, "Point:mirrored").expect("figures are mirrored");
    desk.session.point_all(desk.id, ((-20.0, -20.0), (20.0, 20.0))).expect("a circle");
    desk.session.enter(desk.id, "axis").expect("it is a line");
    let wanted = "mirrored = circle2.mirrored(about: axis)";
    assert!(desk.text().contains(wanted), "{}", desk.text());
}

#[test]
fn a_step_of_a_list_with_turns_is_told_by_its_parts() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program P() {
    turns = repeat 2 times {
        c = Circle(center: Point(5, 0), radius: 2)
    }
    circle = Circle(center: Point(10, 0), radius: 2)
    mirrored = [turns[0].c, circle].mirrored(about: Axis.vertical(x: 20))
}
",
    );
    assert_eq!(desk.wrong(), []);
    desk.session.record(desk.id, "P").expect("it is there");
    let rows = desk.session.steps(desk.id, None).expect("it is recorded").rows;
    let words = &rows.last().expect("there are steps").words;
    assert_eq!(words, "mirrored of turns[0].c, circle: about Axis.vertical(x: 20)");
}

#[test]
fn a_retaining_ring_has_the_lug_that_its_size_asks_for() {
    let parameters = [("d1", "20"), ("d3", "18.5"), ("a", "4"), ("b", "2.6"), ("d5", "2")];
    let mut desk = Desk::recording("Ring", &parameters);
    guide(&mut desk, "Point", &[Typed("0, 0")]);
    guide(&mut desk, "Circle", &[At(0.0, 0.0), Typed("d3 / 2")]);
    guide(&mut desk, "Circle", &[Typed("Point(0, -b / 5)"), Typed("d3 / 2 + 4 * b / 5")]);
    guide(&mut desk, "Axis.vertical(x)", &[Typed("a / 5")]);
    let eye = "Point.intersection(Axis.vertical(x: 7 * a / 10), Circle(center: point, radius: d3 / 2 + a / 2))";
    draw(&mut desk, "Circle", &[Typed(eye), Typed("d5 / 2")]);
    // the lug of a small ring is round, that of a larger one goes out to a circle
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "d1 < 10").expect("it is a condition");
    draw(&mut desk, "Circle", &[At(0.0, 0.0), Typed("d3 / 2 + a")]);
    desk.session.otherwise(desk.id).expect("the first branch is drawn");
    desk.set("ring.d1", 8.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    draw(&mut desk, "Circle.concentric(with,radius)", &[Typed("circle3"), Typed("a / 2")]);
    desk.session.end_choice(desk.id).expect("it is open");
    // either lug is one thing to what follows
    draw(&mut desk, "Point:mirrored", &[Typed("circle4"), Typed("Axis.vertical(x: 0)")]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "ring.circle4"), "centre (0, 0), radius 13.25");
    for (d1, lug) in [
        (8.0, "centre (-2.8, 10.896), radius 2, clockwise"),
        (25.0, "centre (0, 0), radius 13.25, clockwise"),
    ] {
        desk.set("ring.d1", d1).expect("a parameter can be set");
        assert_eq!(value(&desk, "ring.mirrored"), lug, "{d1}");
        // what the branch that is not taken would draw is not lit in the place of the other
        let lit = ["#0.then.circle4", "#0.else.circle4"]
            .map(|step| desk.session.step_drawing(desk.id, "ring", step).elements.len());
        assert_eq!(lit, if d1 < 10.0 { [1, 0] } else { [0, 1] });
    }
}

#[test]
fn what_is_drawn_for_construction_is_in_sight_while_it_can_be_picked() {
    let mut desk = Desk::recording("Ring", &[("a", "4")]);
    let seen = |desk: &Desk| desk.session.guides(desk.id).elements.len();
    guide(&mut desk, "Circle", &[Typed("0,0"), Typed("a")]);
    draw(&mut desk, "Circle", &[At(0.0, 0.0), Typed("a / 2")]);
    assert_eq!(seen(&desk), 1);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "a < 10").expect("it is a condition");
    guide(&mut desk, "Axis.vertical(x)", &[Typed("a / 5")]);
    assert_eq!(seen(&desk), 2);
    desk.session.end_choice(desk.id).expect("it is open");
    desk.session.stop_recording(desk.id).expect("nothing is open");
    assert_eq!(seen(&desk), 0);
}

#[test]
fn a_place_that_is_typed_from_another_is_one_place() {
    let mut desk = Desk::recording("Slot", &[("d", "10")]);
    draw(&mut desk, "Line", &[Typed("0, d / 2"), Typed("@30,0")]);
    draw(&mut desk, "Line", &[At(30.0, 5.0), Typed("@0,-d")]);
    draw(&mut desk, "Line", &[At(30.0, -5.0), Typed("@-d / 2, 2 * d")]);
    let text = desk.text();
    assert!(text.contains("line = Line(Point(0, d / 2), Point(30, d / 2))"), "{text}");
    assert!(text.contains("line2 = Line(line.p2, Point(line.p2.x, line.p2.y - d))"), "{text}");
    assert_eq!(value(&desk, "slot.line3"), "(30, -5) to (25, 15)");
}

#[test]
fn a_construction_that_gives_an_operand_is_kept_only_if_that_is_said() {
    let mut desk = Desk::recording("Mark", &[("a", "4")]);
    guide(&mut desk, "Circle", &[Typed("0,0"), Typed("a")]);
    desk.session.draw_guides(desk.id, true);
    desk.session.begin(desk.id, "Circle").expect("it is in scope");
    let prompt = desk.session.begin(desk.id, "Point.middle(first,second)").expect("it fits");
    assert!(!prompt.is_guide);
    for typed in ["0,0", "a,0"] {
        desk.session.enter(desk.id, typed).expect("it fits");
    }
    // what waited is for construction, as was said
    assert!(desk.session.prompt(desk.id).expect("a radius is wanted").is_guide);
    desk.session.enter(desk.id, "1").expect("it fits");
    let text = desk.text();
    assert!(text.contains("guide circle2 = Circle(center: Point.middle("), "{text}");
}

#[test]
fn a_figure_that_is_a_parameter_is_in_sight_and_picked() {
    let mut desk = Desk::recording("Third", &[("from", "0,0"), ("to", "270,0")]);
    assert_eq!(desk.session.guides(desk.id).elements.len(), 2);
    // neither is offered where a number is wanted
    assert_eq!(desk.session.value_parameters(desk.id), [""; 0]);
    // the pointer is nearer to the other end when the ratio is typed
    let third = draw(
        &mut desk,
        "Point.dividing(first,second,ratio)",
        &[At(0.0, 0.0), At(270.0, 0.0), Typed("1 / 3")],
    );
    let text = desk.text();
    assert!(text.contains("Point.dividing(from, to, ratio: 1 / 3)"), "{text}");
    assert_eq!(value(&desk, &format!("third.{third}")), "(90, 0)");
}

/// Records a hole, then a row of them, then rows of rows: each by its first turn and what the second one takes.
#[test]
fn a_plate_is_rows_of_rows_of_holes() {
    let mut desk = Desk::recording("Plate", &[("pitch", "8"), ("hole", "5")]);
    for (name, example) in [("rows", "5"), ("columns", "8")] {
        let new = NewParameter {
            name: name.into(),
            example: example.into(),
            class: "Integer".into(),
            ..NewParameter::default()
        };
        desk.session.define_parameter(desk.id, &new).expect("it is new");
    }
    for _ in 0..2 {
        desk.session.begin_loop(desk.id, "").expect("it is recorded");
    }
    draw(&mut desk, "Circle", &[Typed("pitch / 2, pitch / 2"), Typed("hole / 2")]);
    for (times, by) in [("columns", "pitch,0"), ("rows", "0,pitch")] {
        desk.session.end_turn(desk.id, Ends::Times).expect("the first turn is drawn");
        while let Some(Wants::Recurrence(question)) = desk.session.prompt(desk.id).map(|p| p.wants)
        {
            if question.first == "Point(pitch / 2, pitch / 2)" {
                // the place that is asked about is lit, though it has no name
                let away = Pointer { at: (99.0, 99.0), reach: 0.1, ..Pointer::default() };
                let lit = desk.session.hover(desk.id, &away, "").ghost;
                let is_place = |e: &drawing::Element| matches!(e.shape, drawing::Shape::Dot(at) if (at.x, at.y) == (4.0, 4.0));
                assert!(lit.elements.iter().any(is_place), "{:?}", lit.elements);
                draw_answer(&mut desk, by);
            } else {
                desk.session.same(desk.id).expect("it can be the same");
            }
        }
        desk.session.enter(desk.id, times).expect("a number of turns");
    }
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "plate.turns.last.turns2.last.circle.center"), "(60, 36)");
    desk.set("plate.rows", 3.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "plate.turns.last.turns2.last.circle.center"), "(60, 20)");
}

/// Answers a question by the first hole's centre, moved.
fn draw_answer(desk: &mut Desk, by: &str) {
    desk.session.begin(desk.id, ":moved(by)").expect("it is in scope");
    let pointer = Pointer { at: (4.0, 4.0), reach: 0.4, ..Pointer::default() };
    desk.session.point(desk.id, &pointer).expect("the centre lies there");
    desk.session.enter(desk.id, by).expect("it is a place");
}

#[test]
fn half_a_shaft_is_mirrored_by_one_rubber_band() {
    let mut desk = Desk::recording("Shaft", &[("d", "30"), ("length", "40")]);
    guide(&mut desk, "Axis.horizontal(y)", &[Typed("0")]);
    draw(&mut desk, "Line", &[Typed("0, 0"), Typed("0, d / 2")]);
    draw(&mut desk, "Line", &[Typed("line.p2"), Typed("@length, 0")]);
    draw(&mut desk, "Circle", &[Typed("20, 8"), Typed("3")]);
    // an end of the first line alone is nothing
    desk.session.begin(desk.id, "Point:mirrored").expect("figures are mirrored");
    let none = desk.session.point_all(desk.id, ((-5.0, 14.0), (5.0, 16.0)));
    assert!(none.is_err_and(|refusal| refusal.message.starts_with("nothing that can be taken")));
    desk.session.point_all(desk.id, ((-5.0, -1.0), (45.0, 16.0))).expect("three figures");
    desk.session.enter(desk.id, "axis").expect("it is a line");
    let wanted = "mirrored = [line, line2, circle].mirrored(about: axis)";
    assert!(desk.text().contains(wanted), "{}", desk.text());
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "shaft.mirrored[2]"), "centre (20, -8), radius 3, clockwise");
}

#[test]
fn a_rubber_band_takes_a_pattern_as_a_whole_so_that_its_count_may_change() {
    let mut desk = Desk::recording("Flange", &[("holes", "6")]);
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("60")]);
    draw(&mut desk, "Circle", &[Typed("45, 0"), Typed("5")]);
    draw(&mut desk, ":pattern(about,count)", &[Typed("circle2"), Typed("0, 0"), Typed("holes")]);
    guide(&mut desk, "Axis.vertical(x)", &[Typed("100")]);
    let steps = desk.session.history(desk.id).0.len();
    desk.session.begin(desk.id, "Point:mirrored").expect("figures are mirrored");
    desk.session.point_all(desk.id, ((-70.0, -70.0), (70.0, 70.0))).expect("all of it");
    let turn = desk.session.enter(desk.id, "axis").expect("it is a line");
    let Turn::Made { name, .. } = turn else { panic!("all is given") };
    assert_eq!(name, "mirrored, mirrored2");
    for wanted in [
        "mirrored = [circle, circle2].mirrored(about: axis)",
        "mirrored2 = pattern.mirrored(about: axis)",
    ] {
        assert!(desk.text().contains(wanted), "{}", desk.text());
    }
    assert_eq!(desk.session.history(desk.id).0.len(), steps + 1);
    desk.set("flange.holes", 4.0).expect("a parameter can be set");
    assert_eq!(value(&desk, "flange.mirrored2"), "3 figures");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_pattern_of_what_is_not_drawn_by_these_values_is_not_settled_by_chance() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program P(d: Length = 4) {
    if d > 5 {
        c = Circle(center: Point(10, 0), radius: 2)
        many = (1..3 - 1).map(nth => c.turned(about: Point(0, 0), by: nth * 360 deg / 3))
    }
}
p: P
",
    );
    assert_eq!(desk.wrong(), []);
    let before = desk.text();
    let refused = desk.session.make_guide(desk.id, ("P", "#0.then.c"), true);
    let wanted = "many is a pattern of c, which is not drawn by these values: choose others first";
    assert_eq!(refused.expect_err("nothing tells").message, wanted);
    assert_eq!(desk.text(), before);
    desk.set("p.d", 6.0).expect("a parameter can be set");
    desk.session.make_guide(desk.id, ("P", "#0.then.c"), true).expect("it is drawn");
    assert!(desk.text().contains("many = (0..3 - 1)"), "{}", desk.text());
}

#[test]
fn a_step_cannot_speak_of_itself() {
    let mut desk = Desk::recording("Mark", &[]);
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("3")]);
    desk.session.begin_change(desk.id, ("circle", "center"), None).expect("it has a centre");
    let pointer = Pointer { at: (3.0, 0.0), reach: 0.4, ..Pointer::default() };
    let refused = desk.session.point(desk.id, &pointer).expect_err("it is the circle's own");
    assert_eq!(
        refused.message,
        "circle would be drawn from itself: pick something that was drawn before it"
    );
}

#[test]
fn a_pattern_of_what_is_drawn_by_another_name_does_not_draw_its_first_again() {
    let mut desk = Desk::of(
        "use geometry
unit mm
program Flange() {
    circle = Circle(center: Point(45, 0), radius: 5)
    circle2 = Circle(center: Point(60, 0), radius: 2)
    guide circle3 = Circle(center: Point(20, 0), radius: 2)
    turns = repeat 3 times with at = Point(80, 0) {
        c = Circle(center: at, radius: 1)
        next at = Point(at.x + 10, 0)
    }
    each = for hole in [circle, circle2] {
        ring = Circle(center: hole.center, radius: hole.radius / 2)
    }
    guides = for hole in [circle3] {
        ring2 = Circle(center: hole.center, radius: hole.radius / 2)
    }
}
flange: Flange
",
    );
    assert_eq!(desk.wrong(), []);
    desk.session.record(desk.id, "Flange").expect("it is there");
    let whats = [
        ("circle.reversed", "5 figures"),
        ("-circle.reversed", "5 figures"),
        ("circle3.reversed", "6 figures"),
        ("turns.last.c", "5 figures"),
        ("turns.first.c.reversed", "5 figures"),
        ("turns[2]", "5 turns"),
        ("turns", "5 figures"),
        ("circle.center", "6 figures"),
    ];
    for (what, figures) in whats {
        let name =
            draw(&mut desk, ":pattern(about,count)", &[Typed(what), Typed("0, 0"), Typed("6")]);
        assert_eq!(value(&desk, &format!("flange.{name}")), figures, "{what}");
    }
    for (address, figures) in [("each.ring", "5 figures"), ("guides.ring2", "6 figures")] {
        desk.session.visit(desk.id, &Go::To(address.into())).expect("there is one");
        draw(&mut desk, ":pattern(about,count)", &[Typed("hole"), Typed("0, 0"), Typed("6")]);
        let block = address.split('.').next().unwrap_or_default();
        let last = desk.text();
        let name = last.lines().filter_map(|line| line.trim().split_once(" = (")).map(|l| l.0);
        let names: Vec<&str> = name.collect();
        let made = names.iter().filter_map(|name| {
            desk.session.comes_to(desk.id, &format!("flange.{block}[0].{name}"))
        });
        assert_eq!(made.collect::<Vec<_>>(), [figures], "{address}: {}", desk.text());
    }
    // what a loop runs over becomes a guide: its patterns draw all
    desk.session.make_guide(desk.id, ("Flange", "circle"), true).expect("it has a name");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    assert_eq!(value(&desk, "flange.pattern"), "6 figures", "{}", desk.text());
    let text = desk.text();
    let (_, each) = text.split_once("each = for").expect("it is there");
    assert!(each.split("guides").next().is_some_and(|each| each.contains("(0..6 - 1)")), "{text}");
}

/// Half of a disc with a notch in its floor, as lines and arcs that are drawn in no order.
fn half_disc() -> Desk {
    let mut desk = Desk::recording("Half", &[("r", "20")]);
    guide(&mut desk, "Circle", &[Typed("0, 0"), Typed("r")]);
    draw(&mut desk, "Line", &[Typed("r, 0"), Typed("4, 0")]);
    draw(&mut desk, "Arc", &[Typed("0, 0"), Typed("r, 0"), Typed("-r, 0")]);
    draw(&mut desk, "Line", &[Typed("-r, 0"), Typed("-4, 0")]);
    draw(&mut desk, "ClockwiseArc", &[Typed("0, 0"), Typed("-4, 0"), Typed("4, 0")]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    desk
}

#[test]
fn a_contour_is_made_of_edges_that_one_pick_follows() {
    let mut desk = half_disc();
    let by_one = draw(&mut desk, "Contour.along(edges)", &[At(10.0, 0.0)]);
    assert_eq!(by_one, "contour");
    let wanted = "contour = Contour.along(edges: [line, clockwiseArc, line2, arc])";
    assert!(desk.text().contains(wanted), "{}", desk.text());
    let area = std::f64::consts::PI * (400.0 - 16.0) / 2.0;
    draw(&mut desk, "value", &[Typed("contour.area / 1")]);
    let found = value_of(&desk, "half.value");
    assert!((found.abs() - area).abs() < 1e-9, "{found} for {area}");
    // filled, it is what they surround
    assert_eq!(draw(&mut desk, "Surface.filled(edges)", &[At(10.0, 0.0)]), "surface");
    let wanted = "surface = Surface.filled(edges: [line, clockwiseArc, line2, arc])";
    assert!(desk.text().contains(wanted), "{}", desk.text());
    draw(&mut desk, "value", &[Typed("surface.area / 1")]);
    let found = value_of(&desk, "half.value2");
    assert!((found - area).abs() < 1e-9, "{found} for {area}");
    desk.undo();
    desk.undo();
    // where what covers the plane is wanted, several may stand in a list
    draw(&mut desk, "Contour.circle(of)", &[Typed("circle")]);
    draw(
        &mut desk,
        "Region.union(first,second)",
        &[Typed("contour"), Typed("[contour2, contour]")],
    );
    // it is picked as a whole
    desk.session.begin(desk.id, "Point:mirrored").expect("it is mirrored");
    let pointer = Pointer { at: (0.0, 4.0), reach: 0.4, ..Pointer::default() };
    desk.session.point(desk.id, &pointer).expect("an edge lies there");
    desk.session.enter(desk.id, "Axis.vertical(x: 30)").expect("it is a line");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn where_two_edges_go_on_the_next_is_picked_and_an_open_contour_is_refused() {
    let mut desk = half_disc();
    // a second way from one end to the other
    draw(&mut desk, "Line", &[Typed("-r, 0"), Typed("0, -r")]);
    draw(&mut desk, "Line", &[Typed("0, -r"), Typed("r, 0")]);
    desk.session.begin(desk.id, "Contour.along(edges)").expect("there are contours");
    let pick = |desk: &mut Desk, x: f64, y: f64| {
        let pointer = Pointer { at: (x, y), reach: 0.4, ..Pointer::default() };
        desk.session.hover(desk.id, &pointer, "");
        desk.session.point(desk.id, &pointer)
    };
    // it goes on to the place where two ways are
    let Ok(Turn::Wants(prompt)) = pick(&mut desk, -15.0, 0.0) else { panic!("it is open") };
    assert!(prompt.words.contains("3 edges"), "{prompt:?}");
    let refused = desk.session.enter(desk.id, "").expect_err("it is open");
    assert!(refused.message.contains("nothing goes on where edge"), "{}", refused.message);
    let made = pick(&mut desk, 0.0, 20.0).expect("it closes");
    assert!(matches!(made, Turn::Made { .. }), "{made:?}");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_step_speaks_of_the_edge_of_a_union_by_what_it_comes_from() {
    let mut desk = Desk::recording("Plate", &[("r", "5"), ("w", "40")]);
    draw(&mut desk, "Line", &[Typed("0, 0"), Typed("w, 0")]);
    draw(&mut desk, "Line", &[Typed("w, 0"), Typed("w, 20")]);
    draw(&mut desk, "Line", &[Typed("w, 20"), Typed("0, 20")]);
    draw(&mut desk, "Line", &[Typed("0, 20"), Typed("0, 0")]);
    draw(&mut desk, "Circle", &[Typed("w, 20"), Typed("r")]);
    draw(&mut desk, "Contour.along(edges)", &[At(20.0, 0.0)]);
    draw(&mut desk, "Contour.circle(of)", &[At(40.0, 25.0)]);
    draw(&mut desk, "Region.union(first,second)", &[Typed("contour"), Typed("contour2")]);
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // the line lies under its edge: Tab goes on to that
    let pointer = Pointer { at: (20.0, 20.0), reach: 0.4, ..Pointer::default() };
    let prompt = desk.session.begin(desk.id, "Axis.perpendicular(to,through)");
    assert!(prompt.expect("there are axes").goes_wider);
    desk.session.pick_wider(desk.id);
    desk.session.point(desk.id, &pointer).expect("an edge lies there");
    desk.session.enter(desk.id, "0, 0").expect("a place");
    let between = "Line.edge(of: region, from: line3, nth: 7).length";
    let why = desk.session.compute(desk.id, between).why.expect("there is no such edge");
    assert!(why.contains("none has the number 7"), "{why}");
    let edge = "Line.edge(of: region, from: line3)";
    assert!(desk.text().contains(edge), "{}", desk.text());
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    // the reference follows other values
    draw(&mut desk, "value", &[Typed(&format!("{edge}.length"))]);
    assert!((value_of(&desk, "plate.value") - 35.0).abs() < 1e-9);
    desk.set("plate.r", 8.0).expect("a parameter can be set");
    assert!((value_of(&desk, "plate.value") - 32.0).abs() < 1e-9);
    // where the edge is gone the step says so
    desk.set("plate.r", 41.0).expect("a parameter can be set");
    let said = desk.session.text(desk.id).diagnostics;
    let is_it = |said: &str| said.contains("none of its edges comes from there");
    assert!(said.iter().any(|d| is_it(&d.message)), "{said:?}");
}

#[test]
fn edges_that_are_typed_join_those_that_were_picked() {
    let mut desk = half_disc();
    draw(&mut desk, "Line", &[Typed("-r, 0"), Typed("0, -r")]);
    draw(&mut desk, "Line", &[Typed("0, -r"), Typed("r, 0")]);
    desk.session.begin(desk.id, "Contour.along(edges)").expect("there are contours");
    let pointer = Pointer { at: (-15.0, 0.0), reach: 0.4, ..Pointer::default() };
    desk.session.point(desk.id, &pointer).expect("an edge lies there");
    let made = desk.session.enter(desk.id, "arc").expect("it closes");
    assert!(matches!(made, Turn::Made { .. }), "{made:?}");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_contour_is_made_of_edges_and_of_sets_of_edges() {
    let lines = "a = Line(Point(0, 0), Point(10, 0))
    m = [Line(Point(10, 0), Point(10, 10)), Line(Point(10, 10), Point(0, 10)), Line(Point(0, 10), Point(0, 0))]";
    let of = |more: &str| {
        format!("use drafting\nuse contours\n\nprogram Box {{\n    {lines}\n{more}}}\n\nbox: Box\n")
    };
    for edges in ["[a, m]", "[m, a]", "[[a], m]"] {
        let desk =
            Desk::of(&of(&format!("    c = Contour.along(edges: {edges})\n    v = c.area / 1\n")));
        assert_eq!(desk.wrong(), [], "{edges}");
        assert_eq!(value_of(&desk, "box.v").abs(), 100.0, "{edges}");
    }
    // by picks the set is spoken of as a whole
    let mut desk = Desk::of(&of(""));
    desk.session.record(desk.id, "Box").expect("it is there");
    draw(&mut desk, "Contour.along(edges)", &[At(5.0, 0.0)]);
    assert!(desk.text().contains("Contour.along(edges: [a, m])"), "{}", desk.text());
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

fn value_of(desk: &Desk, path: &str) -> f64 {
    let rows = desk.session.values(desk.id);
    let row = rows.iter().find(|row| row.path == path);
    row.and_then(|row| row.number).unwrap_or_else(|| panic!("{path}: {}", desk.text()))
}

#[test]
fn how_the_other_case_is_drawn_is_asked_no_more_after_escape() {
    let mut desk = Desk::recording("Pulley", &[("d", "100")]);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    match desk.session.enter(desk.id, "d > 80").expect("it is a condition") {
        // a name that says all of it is not said twice
        Turn::Made { name, text, .. } => {
            assert_eq!((name.as_str(), text.as_str()), ("if d > 80", ""));
        }
        other => panic!("{other:?}"),
    }
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("d / 2")]);
    desk.session.give_up(desk.id);
    desk.session.otherwise(desk.id).expect("the first case is drawn");
    assert_eq!(desk.session.prompt(desk.id).expect("it is asked").wants, Wants::Otherwise);
    assert_eq!(desk.session.give_up(desk.id), None);
    // a construction that is given up meanwhile takes the question along no more than before
    desk.session.otherwise(desk.id).expect("the first case is drawn");
    desk.session.begin(desk.id, "Circle").expect("it is one");
    let waits = desk.session.give_up(desk.id).expect("it is asked still");
    assert_eq!(waits.wants, Wants::Otherwise);
}

#[test]
fn a_step_of_a_branch_is_told_by_its_name_and_not_by_where_it_stands() {
    let mut desk = Desk::recording("Pulley", &[("d", "100")]);
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("d / 2")]);
    desk.session.give_up(desk.id);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "d > 80").expect("it is a condition");
    draw(&mut desk, "Circle.concentric(with,radius)", &[Typed("circle"), Typed("4")]);
    desk.session.give_up(desk.id);
    desk.session.end_choice(desk.id).expect("it is open");
    desk.session.begin_delete(desk.id, "circle").expect("something is drawn from it");
    let asked = desk.session.prompt(desk.id).expect("it is asked");
    assert!(asked.words.starts_with("circle2 is drawn from circle: pick"), "{}", asked.words);
    assert_eq!(asked.label, "Delete circle, 1 of 1");
}

/// A pulley whose `if` is open: the first branch is drawn.
fn in_its_if() -> Desk {
    let mut desk = Desk::recording("Pulley", &[("d", "100")]);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "d > 80").expect("it is a condition");
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("d / 2")]);
    desk.session.give_up(desk.id);
    desk
}

/// The text of a document, opened anew and recorded further.
fn gone_on(desk: &Desk) -> Desk {
    let mut again = Desk::of(&desk.text());
    again.session.record(again.id, "Pulley").expect("it is there");
    again
}

pub(crate) fn open_in(desk: &Desk) -> Vec<String> {
    let open = desk.session.steps(desk.id, None).expect("it is recorded").open;
    open.into_iter().map(|block| block.words).collect()
}

const WHOLE: &str = "    if d > 80 {
        circle = Circle(center: Point(0, 0), radius: d / 2)
    } else {
        circle = Circle(center: Point(0, 0), radius: d / 4)
    }
";

#[test]
fn a_recording_that_was_broken_off_goes_on_in_its_if() {
    let mut desk = gone_on(&in_its_if());
    assert_eq!(open_in(&desk), ["draw what is done if d > 80"]);
    desk.session.otherwise(desk.id).expect("the first case is drawn");
    desk.session.other_branch(desk.id, true).expect("with the same values");
    for _ in 0..2 {
        // before its first step, and after it
        desk = gone_on(&desk);
        assert_eq!(open_in(&desk), ["draw what is done unless d > 80"], "{}", desk.text());
        let said = desk.session.text(desk.id).diagnostics;
        let said: Vec<_> = said.iter().map(|d| (d.code.as_str(), d.severity.as_str())).collect();
        assert_eq!(said, [("open-block", "recording")]);
        if !desk.text().contains("d / 4") {
            draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("d / 4")]);
            desk.session.give_up(desk.id);
        }
    }
    desk.session.end_choice(desk.id).expect("it is open");
    assert!(desk.text().contains(WHOLE), "{}", desk.text());
    assert_eq!(open_in(&gone_on(&desk)), [""; 0]);
    assert_eq!(value(&desk, "pulley.circle"), "centre (0, 0), radius 50");
}

#[test]
fn a_recording_that_was_broken_off_under_other_values_goes_on_in_the_branch_that_they_take() {
    let mut desk = in_its_if();
    desk.session.otherwise(desk.id).expect("the first case is drawn");
    desk.set("pulley.d", 40.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    for _ in 0..2 {
        // before its first step, and after it
        desk = gone_on(&desk);
        assert_eq!(open_in(&desk), ["draw what is done unless d > 80"], "{}", desk.text());
        if !desk.text().contains("d / 4") {
            draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("d / 4")]);
            desk.session.give_up(desk.id);
        }
    }
    desk.session.end_choice(desk.id).expect("it is open");
    assert!(desk.text().contains(WHOLE), "{}", desk.text());
    assert_eq!(open_in(&gone_on(&desk)), [""; 0]);
}

#[test]
fn a_recording_that_was_broken_off_under_other_values_gives_the_example_back_its_own() {
    let mut desk = in_its_if();
    let own = desk.text().lines().last().unwrap_or_default().to_string();
    desk.session.otherwise(desk.id).expect("the first case is drawn");
    desk.set("pulley.d", 40.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    // an `if` in it, under values of its own
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "d > 30").expect("it is a condition");
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("d / 4")]);
    desk.session.give_up(desk.id);
    desk.session.otherwise(desk.id).expect("the first case is drawn");
    desk.set("pulley.d", 20.0).expect("a parameter can be set");
    desk.session.other_branch(desk.id, false).expect("the values take it");
    desk = gone_on(&desk);
    assert_eq!(value(&desk, "pulley.d"), "20 mm");
    assert_eq!(open_in(&desk).len(), 2, "{}", desk.text());
    draw(&mut desk, "Point", &[Typed("0, 0")]);
    desk.session.give_up(desk.id);
    desk.session.end_choice(desk.id).expect("it is open");
    assert_eq!(value(&desk, "pulley.d"), "40 mm", "{}", desk.text());
    desk = gone_on(&desk);
    assert_eq!(open_in(&desk), ["draw what is done unless d > 80"], "{}", desk.text());
    desk.session.end_choice(desk.id).expect("it is open");
    assert_eq!(desk.text().lines().last(), Some(own.as_str()));
    assert!(!desk.text().contains("//"), "{}", desk.text());
    desk.session.apply(desk.id, &Command::Undo).expect("there is a step");
    assert_eq!(value(&desk, "pulley.d"), "40 mm", "{}", desk.text());
}

#[test]
fn an_if_keeps_no_empty_branch() {
    let mut desk = in_its_if();
    desk.session.end_choice(desk.id).expect("it is open");
    assert!(!desk.text().contains("else"), "{}", desk.text());
    // what is done where the condition does not hold
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "d < 20").expect("it is a condition");
    let nothing = desk.session.end_choice(desk.id).expect_err("nothing is drawn");
    assert!(nothing.message.contains("nothing is drawn in either case"), "{}", nothing.message);
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("5")]);
    desk.session.give_up(desk.id);
    desk.session.end_choice(desk.id).expect("it is open");
    assert!(desk.text().contains("    if not (d < 20) {\n        circle2 ="), "{}", desk.text());
    assert_eq!(desk.wrong(), [], "{}", desk.text());
}

#[test]
fn a_condition_of_two_in_parentheses_is_turned_round_as_a_whole() {
    let mut desk = Desk::recording("Pulley", &[("d", "100")]);
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "(d < 20) or (d > 200)").expect("it is a condition");
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("5")]);
    desk.session.give_up(desk.id);
    desk.session.end_choice(desk.id).expect("it is open");
    assert!(desk.text().contains("    if not ((d < 20) or (d > 200)) {"), "{}", desk.text());
    desk.session.begin_choice(desk.id).expect("it is recorded");
    desk.session.enter(desk.id, "not ((d < 30) or (d > 300))").expect("it is a condition");
    draw(&mut desk, "Circle", &[Typed("0, 0"), Typed("6")]);
    desk.session.give_up(desk.id);
    desk.session.end_choice(desk.id).expect("it is open");
    assert!(desk.text().contains("    if not ((d < 30) or (d > 300)) {"), "{}", desk.text());
    assert_eq!(open_in(&gone_on(&desk)), [""; 0]);
}

#[test]
fn undo_of_the_other_branch_leads_back_into_the_first() {
    for is_same in [true, false] {
        let mut desk = in_its_if();
        desk.session.otherwise(desk.id).expect("the first case is drawn");
        if !is_same {
            desk.set("pulley.d", 40.0).expect("a parameter can be set");
        }
        desk.session.other_branch(desk.id, is_same).expect("it is taken");
        assert_eq!(open_in(&desk), ["draw what is done unless d > 80"]);
        desk.session.apply(desk.id, &Command::Undo).expect("there is a step");
        assert_eq!(open_in(&desk), ["draw what is done if d > 80"], "{}", desk.text());
    }
}

/// Rows of holes, each row begun by the hole to which the turn behind it goes on.
pub(crate) fn sheet() -> Desk {
    let mut desk = Desk::of(
        "use geometry
program Sheet(pitch: Length = 10) {
    turns = repeat 3 times with start = Point(0, 0) {
        circle = Circle(center: start, radius: 3)
        turns2 = repeat 2 times with from = circle.center {
            circle2 = Circle(center: Point(from.x + pitch, from.y), radius: 2)
            next from = circle2.center
        }
        next start = Point(circle.center.x, circle.center.y + pitch)
    }
}
sheet: Sheet
",
    );
    assert_eq!(desk.wrong(), []);
    desk.session.record(desk.id, "Sheet").expect("it is there");
    desk
}

#[test]
fn what_a_loop_carries_on_from_a_step_that_goes_is_asked_where_its_turn_ends() {
    let mut desk = sheet();
    let asked = |desk: &Desk| desk.session.prompt(desk.id).expect("it is asked").words;
    desk.session.begin_delete(desk.id, "turns.circle").expect("it is there");
    let words = asked(&desk);
    assert!(
        words.starts_with("what turns carries on, or ends by, is drawn from circle"),
        "{words}"
    );
    assert!(words.ends_with("or delete all of turns"), "{words}");
    // what the turn draws later can be spoken of there
    desk.session.enter(desk.id, "turns2[0].circle2").expect("it is drawn by then");
    assert!(asked(&desk).starts_with("turns2 is drawn from circle: pick"));
    desk.session.enter(desk.id, "Circle(center: start, radius: 1)").expect("it is a circle");
    assert_eq!(desk.wrong(), [], "{}", desk.text());
    let text = desk.text();
    let wanted =
        "next start = Point(turns2[0].circle2.center.x, turns2[0].circle2.center.y + pitch)";
    assert!(text.contains(wanted), "{text}");
    assert_eq!(desk.session.history(desk.id).0.last().map(String::as_str), Some("delete circle"));
}

#[test]
fn a_value_that_is_set_by_hand_while_a_program_is_visited_is_one_of_the_visit() {
    let by_others =
        |desk: &Desk| desk.session.steps(desk.id, None).expect("it is recorded").by_others;
    for is_dragged in [false, true] {
        let mut desk = sheet();
        let before = desk.text();
        desk.session.visit(desk.id, &Go::To("turns.circle".into())).expect("it is there");
        match is_dragged {
            true => {
                desk.session.press(desk.id, &session::Path::of(&["sheet", "pitch"])).expect("free");
                desk.session.drag(desk.id, (14.0, 0.0));
                desk.session.release(desk.id).expect("nothing is wrong");
            }
            false => _ = desk.set("sheet.pitch", 14.0).expect("a parameter can be set"),
        }
        assert!(by_others(&desk) && desk.text() != before, "{}", desk.text());
        desk.session.own_values(desk.id).expect("it is recorded");
        assert_eq!(desk.text(), before);
        assert!(!by_others(&desk));
    }
}

#[test]
fn a_step_that_is_replaced_is_told_by_its_name() {
    let mut desk = sheet();
    let step = "turns.turns2.circle2";
    assert_eq!(desk.session.begin_replace(desk.id, step).expect("it is one"), "circle2");
    assert_eq!(open_in(&desk).last().unwrap(), "what you draw next takes the place of circle2");
    let name = draw(&mut desk, "Circle", &[Typed("from"), Typed("pitch / 4")]);
    assert_eq!(name, "circle2");
}
