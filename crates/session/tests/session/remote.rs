//! Edits that a worker executes: the document that takes them over is the one that would have done them itself.

use crate::desk::{Desk, at, gallery};
use session::jobs::{Desk as Worker, LongAnswer, LongQuestion};
use session::plain::{read, written};
use session::remote::{Came, Executed, LongEdit};
use session::{Command, Literal};

/// What the worker comes to, through bytes as between page and worker.
fn asked(worker: &mut Worker, desk: &Desk, edit: &LongEdit) -> Executed {
    let job = desk.session.job(desk.id, LongQuestion::Edit(edit.clone()));
    worker.take(read(&written(&job)).expect("a job is plain data"));
    let answer = worker.answer(0).expect("an edit has an answer");
    match read::<LongAnswer>(&written(&answer)) {
        Some(LongAnswer::Edited(executed)) => *executed,
        other => panic!("not an edit's answer: {other:?}"),
    }
}

fn typed(path: &str, typed: &str) -> LongEdit {
    LongEdit::Typed { path: path.into(), typed: typed.into() }
}

/// The edits done by the worker and done here lead to the same: text, values, status, diagnostics, what is told.
fn same(document: &str, edits: &[LongEdit]) {
    let text = gallery(document);
    let (mut here, mut there) = (Desk::of(&text), Desk::of(&text));
    let mut worker = Worker::default();
    for edit in edits {
        let own = edit.apply(&mut here.session, here.id);
        let executed = asked(&mut worker, &there, edit);
        let taken = there.session.take_over(there.id, &executed);
        assert_eq!(taken, Some(own), "{document}: {edit:?}");
        assert_eq!(here.moment(), there.moment(), "{document}: {edit:?}");
        let standing = |desk: &Desk| format!("{:?}", desk.session.standing(desk.id));
        assert_eq!(standing(&here), standing(&there), "{document}: {edit:?}");
        let told = |desk: &Desk| format!("{:?}", desk.session.text(desk.id).diagnostics);
        assert_eq!(told(&here), told(&there), "{document}: {edit:?}");
    }
    for command in [Command::Undo, Command::Redo, Command::Undo, Command::Undo] {
        assert_eq!(here.apply(&command), there.apply(&command), "{document}: {command:?}");
        assert_eq!(here.moment(), there.moment(), "{document}: {command:?}");
    }
}

#[test]
fn a_bridge_comes_to_the_same_where_a_worker_computes_it() {
    let merge = LongEdit::Command(Command::Merge(vec![at("bridge.top2"), at("bridge.top3")]));
    let hold = LongEdit::Command(Command::Anchor { path: at("bridge.middle"), held: true });
    same(
        "bridge",
        &[
            typed("bridge.load.size", "6 N"),
            typed("bridge.beam1.tension", "2 N"),
            typed("bridge.middle.at", "(182, 120)"),
            typed("bridge.middle.at", "somewhere"),
            hold,
            typed("bridge.load.size", "7 N"),
            merge,
        ],
    );
}

#[test]
fn a_truss_and_a_circuit_come_to_the_same_where_a_worker_computes_them() {
    let off = LongEdit::Command(Command::Anchor { path: at("left"), held: true });
    same(
        "warren-truss",
        &[typed("below[4].load", "12 kN"), off, typed("lower[0].stretch", "1 mm")],
    );
    let values = [("supply", "9 V"), ("r1.resistance", "220 ohm"), ("r2.resistance", "150 ohm")];
    same("voltage-divider", &values.map(|(path, value)| typed(path, value)));
    same("temperature", &[typed("fahrenheit", "451"), typed("celsius", "-3")]);
}

#[test]
fn what_contradicts_is_asked_about_by_a_worker_too() {
    let say =
        |members: &str| Command::Edit { target: session::Path::default(), members: members.into() };
    let offered = |members: &str| LongEdit::Command(say(members));
    let level = "constraint bridge.top1.at.y = bridge.top4.at.y";
    let never = "constraint bridge.left.at.y = bridge.right.at.y + 1";
    same("bridge", &[offered(level), offered(never)]);
    let desk = Desk::of(&gallery("bridge"));
    let executed = asked(&mut Worker::default(), &desk, &offered(never));
    let mut taking = Desk::of(&gallery("bridge"));
    let came = taking.session.take_over(taking.id, &executed);
    assert!(matches!(came, Some(Ok(Came::Asked(_)))), "{came:?}");
    assert_eq!(taking.text(), gallery("bridge"));
}

#[test]
fn what_was_computed_for_another_state_is_not_taken_over() {
    let mut desk = Desk::of(&gallery("bridge"));
    let mut worker = Worker::default();
    let executed = asked(&mut worker, &desk, &typed("bridge.load.size", "6 N"));
    desk.set("bridge.load.size", 4.0).expect("another edit");
    let moment = desk.moment();
    assert_eq!(desk.session.take_over(desk.id, &executed), None);
    assert_eq!(desk.moment(), moment);
    desk.apply(&Command::Undo).expect("there was a step");
    assert!(desk.session.take_over(desk.id, &executed).is_some(), "the state is the same again");
}

#[test]
fn where_few_values_hang_together_nothing_is_asked_of_a_worker() {
    let mut bridge = Desk::of(&gallery("bridge"));
    let size = |desk: &mut Desk, path: &str| {
        let command = Command::Set(vec![(at(path), Literal::Number(1.0))]);
        desk.session.may_take_long(desk.id, &LongEdit::Command(command), &[])
    };
    assert!(size(&mut bridge, "bridge.load.size"));
    assert!(size(&mut bridge, "bridge.load.tip.x"), "what is computed of many values");
    assert!(!size(&mut Desk::of(&gallery("quadrilateral")), "q.outer.side1.p1.x"));
    assert!(!size(&mut Desk::of(&gallery("temperature")), "celsius"));
    bridge.hold("bridge.top1", &[]);
    assert!(!size(&mut bridge, "bridge.load.size"), "amid a drag");
}
