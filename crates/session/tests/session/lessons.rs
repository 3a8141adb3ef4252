//! Lessons: tasks are ticked as they are done, a solution does what its task asks, and what does not is told.

use crate::desk::{Desk, gallery};
use session::view::CheckReport;

const SQUARE: &str = "\
side: Real = 2
area: Real
constraint area = side * side
lesson \"Squares\" {
    say \"Type another side.\"
    task moved(side)
    expect area > 4
    hint \"A larger one.\"
    set side to 3
    task area = 16 and explained
    set area to 16
    say \"That was all.\"
}
";

fn shortfalls(text: &str) -> Vec<String> {
    let desk = Desk::of(text);
    let reports: Vec<CheckReport> = desk.session.run_lessons(desk.id);
    let all = reports.into_iter().flat_map(|r| r.shortfalls);
    all.map(|s| format!("{}: {}", s.line, s.message)).collect()
}

#[test]
fn a_step_is_done_once_its_task_and_what_is_expected_hold() {
    let mut desk = Desk::of(SQUARE);
    assert!(desk.session.lesson(desk.id, false).is_none());
    assert_eq!(desk.session.lessons(desk.id)[0].title, "Squares");
    desk.session.begin_lesson(desk.id, Some(0));
    let first = desk.session.lesson(desk.id, false).expect("it has begun");
    assert_eq!((first.at, first.steps), (0, 3));
    assert_eq!(first.say, ["Type another side."]);
    assert_eq!((first.task, first.points_at), (vec!["move side".into()], vec!["side".to_string()]));
    desk.set("side", 1.0).expect("nothing forbids it");
    let short = desk.session.lesson(desk.id, false).expect("it goes on");
    assert_eq!((short.at, short.missing.len()), (0, 1));
    assert!(short.missing[0].starts_with("not yet: area > 4"), "{:?}", short.missing);
    desk.set("side", 3.0).expect("nothing forbids it");
    let second = desk.session.lesson(desk.id, false).expect("it goes on");
    assert_eq!(second.task, ["make it so that area = 16", "open Why"]);
    // what was done stays done, whatever is undone
    desk.undo();
    desk.session.show_solution(desk.id).expect("it shows how");
    assert_eq!(desk.number("side"), 4.0);
    assert_eq!(desk.session.lesson(desk.id, false).expect("it goes on").at, 1);
    let last = desk.session.lesson(desk.id, true).expect("it goes on");
    assert_eq!((last.at, last.task.len()), (2, 0));
    desk.session.next_step(desk.id);
    assert_eq!(desk.session.lesson(desk.id, false).expect("it is over").at, 3);
}

#[test]
fn what_a_lesson_asks_can_be_what_is_yet_to_be_made() {
    let mut desk = Desk::of(&gallery("lesson-2-figure"));
    desk.session.begin_lesson(desk.id, Some(0));
    for at in 0..3 {
        assert_eq!(desk.session.lesson(desk.id, false).expect("it goes on").at, at);
        desk.session.show_solution(desk.id).expect("each step can be shown");
    }
    let end = desk.session.lesson(desk.id, false).expect("it goes on");
    assert!(end.task.is_empty() && end.at == 3, "{end:?}");
}

#[test]
fn every_lesson_of_the_gallery_can_be_done() {
    for name in ["1-first-minute", "2-figure", "3-midpoint-theorem", "4-ohms-law", "5-washer"] {
        let text = gallery(&format!("lesson-{name}"));
        assert_eq!(shortfalls(&text), Vec::<String>::new(), "{name}");
        let wrong = Desk::of(&text).session.text(session::DocumentId(0)).diagnostics;
        assert!(wrong.is_empty(), "{name}: {wrong:?}");
        assert!(Desk::of(&text).session.lessons(session::DocumentId(0))[0].steps > 2, "{name}");
    }
}

#[test]
fn a_lesson_that_cannot_be_done_is_told() {
    assert_eq!(shortfalls(SQUARE), Vec::<String>::new());
    let of = |steps: &str| shortfalls(&format!("a: Real = 1\nlesson \"L\" {{\n{steps}\n}}\n"));
    assert_eq!(of("task a = 1\nset a to 1"), ["3: this is done before anything is done"]);
    let wrong = of("task a = 3\nset a to 2");
    assert_eq!(wrong, ["3: its solution does not do it: not yet: a = 3 (2 and 3)"]);
    assert_eq!(of("task a = 3"), Vec::<String>::new());
    let text = "a: Real = 1\nlesson \"L\" { task b = 3\n set a to 2\n expect moved a only\n class C { } }\n";
    let codes: Vec<String> = Desk::of(text)
        .session
        .text(session::DocumentId(0))
        .diagnostics
        .into_iter()
        .map(|d| d.code)
        .collect();
    assert!(codes.contains(&"unknown-name".to_string()), "{codes:?}");
    assert!(codes.contains(&"not-in-a-lesson".to_string()), "{codes:?}");
}

#[test]
fn on_an_empty_sheet_a_lesson_shows_what_to_trace_and_the_tool_to_begin_with() {
    let mut desk = Desk::of(&gallery("lesson-2-figure"));
    let to_trace = desk.session.to_trace(desk.id);
    desk.session.begin_lesson(desk.id, Some(0));
    let first = desk.session.lesson(desk.id, false).expect("it has begun");
    let is_stroke = |e: &&drawing::Element| matches!(e.shape, drawing::Shape::Segment(..));
    assert_eq!(first.traced.elements.iter().filter(is_stroke).count(), 4);
    assert_eq!(first.traced, to_trace, "its card shows the same");
    assert_eq!(first.tool.as_deref(), Some("Line"));
    let drawn = format!("{}\nmine: Line\n", desk.text());
    desk.type_text(&drawn);
    let second = desk.session.lesson(desk.id, false).expect("it goes on");
    assert!(second.at == 0 && second.tool.is_none(), "the hand knows what to do");
    assert!(!second.traced.elements.is_empty());
    desk.session.next_step(desk.id);
    let later = desk.session.lesson(desk.id, false).expect("it goes on");
    assert!(later.traced.elements.is_empty());
}
