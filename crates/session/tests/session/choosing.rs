//! Choices in the lab: what there is to choose, what is typed, what is written.

use crate::desk::Desk;

const TEXT: &str = "choice Fit { loose, normal, close }\nclass Hole { fit: Fit = normal }\na: Hole\nb: Hole { fit = close }\non: Bool\nn: Integer = 2\n";

fn typed(desk: &mut Desk, path: &str, words: &str) -> Result<String, String> {
    desk.type_in(path, words).map(|_| desk.text()).map_err(|refusal| refusal.message)
}

#[test]
fn rows_say_what_there_is_to_choose() {
    let desk = Desk::of(TEXT);
    let row = desk.row("a.fit");
    assert_eq!((row.text.as_str(), row.class.as_str(), row.number), ("normal", "Fit", None));
    assert_eq!(row.options, ["loose", "normal", "close"]);
    assert_eq!(desk.row("on").options, ["true", "false"]);
    assert!(desk.row("n").options.is_empty());
}
#[test]
fn an_option_is_written_by_its_name() {
    let mut desk = Desk::of(TEXT);
    let text = typed(&mut desk, "a.fit", "loose").expect("it is an option");
    assert!(text.contains("a: Hole { fit = loose }"), "{text}");
    let text = typed(&mut desk, "b.fit", "loose").expect("it is an option");
    assert!(text.contains("b: Hole { fit = loose }"), "{text}");
    assert_eq!(desk.row("b.fit").text, "loose");
    let message = typed(&mut desk, "b.fit", "tight").expect_err("there is no such option");
    assert_eq!(message, "`tight` is no value; it has loose, normal, close");
}
#[test]
fn options_are_offered_where_one_writes() {
    let desk = Desk::of(TEXT);
    let offered = |text: &str| {
        let words = desk.session.completions(desk.id, text, text.len() as u32);
        let options = words.into_iter().filter(|w| w.kind == "enum");
        options.map(|w| (w.label, w.detail)).collect::<Vec<_>>()
    };
    let fit = |option: &str| (option.to_string(), "Fit".to_string());
    let all = vec![fit("loose"), fit("normal"), fit("close")];
    assert_eq!(offered("x: Fit = cl"), all);
    assert_eq!(offered("x: Fit = Fit."), all);
}
