//! Recordings that were broken off, as by a page that has gone, and go on.

use crate::demonstrations::{By::Typed, draw, open_in, sheet};
use crate::desk::Desk;
use session::drafting::view::Go;

#[test]
fn a_visit_by_other_values_goes_on_where_it_was_after_the_page_has_gone() {
    let mut desk = sheet();
    let before = desk.text();
    let at = |desk: &Desk| desk.session.steps(desk.id, None).expect("it is recorded").at;
    let gone = |desk: &Desk| {
        let mut again = Desk::of(&desk.text());
        let left = desk.session.left_at(desk.id).expect("it is recorded");
        again.session.return_to(again.id, &left).expect("it is there");
        assert_eq!((at(&again), again.session.left_at(again.id)), (at(desk), Some(left)));
        again
    };
    assert_eq!(open_in(&gone(&desk)), [""; 0]);
    for name in ["turns[2].circle", "turns[1].turns2[1].circle2"] {
        desk.session.visit(desk.id, &Go::UntilDrawn(name.into())).expect("it is drawn");
        desk.session.visit_by(desk.id, &[("pitch".into(), "14".into())]).expect("it is a value");
        let circle = "turns[2].circle.center";
        let is_at = |desk: &Desk| desk.session.comes_to(desk.id, &format!("sheet.{circle}"));
        let mut again = gone(&desk);
        assert_eq!(is_at(&again), is_at(&desk));
        let drawn = |desk: &Desk| desk.session.drawn_so_far(desk.id).expect("it is visited");
        assert_eq!(drawn(&again).elements.len(), drawn(&desk).elements.len());
        assert!(again.session.steps(again.id, None).expect("it is recorded").by_others);
        again.session.stop_recording(again.id).expect("nothing is open");
        assert_eq!(again.text(), before);
        // the end of a block is a place, too
        desk.session.visit(desk.id, &Go::Step).expect("it goes on");
        gone(&desk);
    }
    // what is demonstrated in a turn that is visited goes on, too
    desk.session.visit(desk.id, &Go::UntilDrawn("turns[1].circle".into())).expect("it is drawn");
    desk.session.begin_loop(desk.id, "").expect("a loop");
    draw(&mut desk, "Circle", &[Typed("start"), Typed("1")]);
    assert_eq!(open_in(&gone(&desk)), open_in(&desk));
    // what was taken back is taken back with what was kept of it
    let mut desk = sheet();
    desk.session.visit(desk.id, &Go::To("turns.circle".into())).expect("it is there");
    for pitch in ["14", "15"] {
        desk.session.visit_by(desk.id, &[("pitch".into(), pitch.into())]).expect("it is a value");
    }
    desk.undo();
    desk.undo();
    assert_eq!(desk.text(), before);
    desk.session.visit_by(desk.id, &[("pitch".into(), "16".into())]).expect("it is a value");
    desk.session.stop_recording(desk.id).expect("nothing is open");
    assert_eq!(desk.text(), before);
    // a text without the program, or without the place
    desk.session.return_to(desk.id, "Gone [] x").expect_err("there is none");
    desk.session.return_to(desk.id, "Sheet [7] turns.gone").expect("its end");
    assert_eq!(at(&desk), None);
}
