//! What a word of the text names, as someone who points at it is told.

use crate::desk::Desk;
use kernel::{Command, Path};
use session::view::WordView;

const TEXT: &str = "use geometry\n/// Two ends held apart.\nclass Strut {\n    /// Where it begins.\n    foot: Point\n    head: Point\n    constraint upright: foot.x = head.x\n}\na: Strut { head = (0, 80) }\nsize: Real = 3\nconstraint a.foot.y = 2 * size\n";

fn word(desk: &Desk, text: &str, written: &str, nth: usize) -> WordView {
    let at = text.match_indices(written).nth(nth).expect("it is written").0 as u32;
    desk.session
        .word_at(desk.id, text, at + 1)
        .unwrap_or_else(|| panic!("{written} names something"))
}

#[test]
fn a_part_of_a_class_is_found_where_it_is_declared_from_wherever_it_is_named() {
    let desk = Desk::of(TEXT);
    let declared = TEXT.find("foot: Point").expect("it is written") as u32;
    let names = TEXT.match_indices("foot").count();
    for nth in 0..names {
        let found = word(&desk, TEXT, "foot", nth);
        assert_eq!((found.says.as_str(), found.doc.as_str()), ("foot: Point", "Where it begins."));
        let place = found.declared.expect("it is declared");
        assert_eq!((place.file.as_str(), place.start, place.end), ("", declared, declared + 4));
        assert_eq!(found.uses.len(), names);
    }
    let class = word(&desk, TEXT, "Strut", 1);
    assert_eq!((class.says.as_str(), class.doc.as_str()), ("class Strut", "Two ends held apart."));
    assert_eq!(class.uses.len(), 2);
    let rule = word(&desk, TEXT, "upright", 0);
    assert_eq!((rule.says.as_str(), rule.path.as_str()), ("constraint upright", "Strut.upright"));
}

#[test]
fn a_thing_shows_its_value_and_a_class_of_a_library_where_it_stands() {
    let desk = Desk::of(TEXT);
    assert_eq!(word(&desk, TEXT, "size", 1).value.as_deref(), Some("3"));
    let place = word(&desk, TEXT, "Point", 0).declared.expect("a library declares it");
    assert_eq!(place.file, "geometry");
    assert_eq!(&place.text[place.start as usize..place.end as usize], "Point");
    assert_eq!(word(&desk, TEXT, "geometry", 0).says, "library geometry");
    let text = "a: Length = 3 m\nb: Real = sqrt(4)\n";
    let desk = Desk::of(text);
    assert_eq!(word(&desk, text, "sqrt", 0).says, "sqrt(x)");
    assert_eq!(word(&desk, text, "m\n", 0).doc, "Length");
    assert_eq!(word(&desk, text, "Length", 0).doc, "Shown in m.");
    assert_eq!(desk.session.word_at(desk.id, text, 11), None);
}

#[test]
fn what_a_word_names_is_renamed_by_its_path_wherever_it_is_spoken_of() {
    for (written, nth, to, gone) in [
        ("foot", 2, "base", "foot"),
        ("Strut", 1, "Post", "Strut"),
        ("size", 1, "half", "size"),
        ("upright", 0, "steep", "upright"),
    ] {
        let mut desk = Desk::of(TEXT);
        let path = word(&desk, TEXT, written, nth).path;
        let from = Path(path.split('.').map(|step| kernel::Step::Part(step.into())).collect());
        desk.session.apply(desk.id, &Command::Rename { from, to: to.into() }).expect("it is free");
        let text = desk.session.text(desk.id);
        assert_eq!(
            text.source.matches(to).count(),
            TEXT.matches(written).count(),
            "{}",
            text.source
        );
        assert!(!text.source.contains(gone) && text.diagnostics.is_empty());
    }
}

#[test]
fn words_are_found_in_a_text_with_an_error_elsewhere() {
    let broken = format!("{TEXT}constraint size = nothing + \n");
    let desk = Desk::of(&broken);
    assert_eq!(word(&desk, &broken, "head", 2).says, "head: Point");
}
