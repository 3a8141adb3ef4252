//! What is typed: for a tool while one draws, a length, an angle, a place; and into the text.

use session::view::{DiagnosticView, Pointer, TypedLength};

/// Whether a key adds to what is typed: a digit, and what a number or an angle begins with; behind that, any sign, so
/// that nothing which was pressed is missing from what is read.
pub fn adds(typed: &str, key: &str) -> bool {
    let mut characters = key.chars();
    let (Some(c), None) = (characters.next(), characters.next()) else { return false };
    let begins = c.is_ascii_digit() || ".,<-".contains(c);
    if typed.is_empty() { begins } else { !c.is_control() }
}

/// The pointer with what was typed: coordinates on the sheet, `120,40`, or a length and, after `<`, an angle in degrees,
/// `3 cm<45`; nothing where it is neither.
pub fn pointed(typed: &str, pointer: Pointer) -> Option<Pointer> {
    let is_empty = |text: &str| text.trim().is_empty();
    if is_empty(typed) {
        return Some(pointer);
    }
    if let Some((x, y)) = typed.split_once(',') {
        return Some(Pointer { at: (number(x)?, number(y)?), is_typed: true, ..pointer });
    }
    let (length, angle) = typed.split_once('<').unwrap_or((typed, ""));
    let degrees = angle.trim().trim_end_matches("deg").trim_end_matches('°');
    let angle = if is_empty(angle) { None } else { Some(number(degrees)?) };
    let length = if is_empty(length) { None } else { Some(TypedLength::read(length)?) };
    Some(Pointer { length, angle, ..pointer })
}

/// Whether a diagnostic is of the word at whose end somebody types, a byte of the text: it is told once the word is
/// left.
pub fn is_of_unfinished(diagnostic: &DiagnosticView, typed_at: Option<u32>) -> bool {
    let touches = |at| diagnostic.start <= at && at <= diagnostic.end;
    diagnostic.file.is_empty() && typed_at.is_some_and(touches)
}

fn number(typed: &str) -> Option<f64> {
    typed.trim().parse().ok().filter(|number: &f64| number.is_finite())
}

#[cfg(test)]
mod tests {
    use super::{DiagnosticView, Pointer, TypedLength, adds, is_of_unfinished, pointed};

    #[test]
    fn a_half_typed_word_is_not_told_before_it_is_left() {
        let of = |start, end, file: &str| DiagnosticView {
            severity: "error".into(),
            code: "unknown-class".into(),
            message: String::new(),
            hint: None,
            file: file.into(),
            start,
            end,
            line: 1,
            column: 1,
            labels: Vec::new(),
            fixes: Vec::new(),
        };
        assert!(is_of_unfinished(&of(3, 7, ""), Some(7)));
        assert!(!is_of_unfinished(&of(3, 7, ""), Some(8)), "a space ends it");
        assert!(!is_of_unfinished(&of(3, 7, ""), None), "nobody types");
        assert!(!is_of_unfinished(&of(3, 7, "geometry.thing"), Some(7)), "it is in another file");
    }

    #[test]
    fn a_sign_behind_a_digit_is_never_passed_over() {
        assert!(adds("", "3") && adds("", "-") && adds("", "<"));
        assert!(!adds("", "l") && !adds("", "+") && !adds("", " "), "these are other keys");
        assert!(adds("3", "/") && adds("3", " ") && adds("3 c", "m") && adds("30", "+"));
        assert!(!adds("3", "Enter") && !adds("3", "ArrowLeft"));
    }

    #[test]
    fn lengths_angles_and_places_are_read_and_all_else_is_not() {
        let read = |typed| pointed(typed, Pointer::default());
        let length = |number, unit: &str| Some(TypedLength { number, unit: Some(unit.into()) });
        assert_eq!(read("").expect("nothing is typed").length, None);
        assert_eq!(read("30 mm").expect("a length").length, length(30.0, "mm"));
        let both = read("3cm<45 deg").expect("a length and an angle");
        assert_eq!((both.length, both.angle), (length(3.0, "cm"), Some(45.0)));
        assert_eq!(read("<-30°").expect("an angle").angle, Some(-30.0));
        let place = read("120, -40").expect("a place");
        assert_eq!((place.at, place.is_typed), ((120.0, -40.0), true));
        for wrong in ["3/4 in", "30+5", "3 kg", "30<x", "1,", "120 mm,40 mm", "inf", "3,4,5"] {
            assert_eq!(read(wrong), None, "{wrong}");
        }
    }
}
