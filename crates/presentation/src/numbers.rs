//! Numbers as fields, sliders and buttons have them.

/// The ends of a slider: the old ones while the number lies between them, else `natural` ones that hold it, else some
/// around the number and zero.
pub fn slider_range(
    number: f64,
    natural: Option<(f64, f64)>,
    old: Option<&(f64, f64)>,
) -> (f64, f64) {
    let holds = |(least, most): &(f64, f64)| *least <= number && number <= *most;
    match old.copied().filter(holds).or(natural.filter(holds)) {
        Some(ends) => ends,
        None if number == 0.0 => (-100.0, 100.0),
        None => ((2.0 * number).min(0.0), (2.0 * number).max(0.0)),
    }
}

/// The ends of a slider for a number that is asked to lie between some: an end that is open is as for any number.
pub fn ends_between(
    number: f64,
    asked: (Option<f64>, Option<f64>),
    natural: Option<(f64, f64)>,
    old: Option<&(f64, f64)>,
) -> (f64, f64) {
    let (below, above) = slider_range(number, natural, old);
    (asked.0.unwrap_or(below), asked.1.unwrap_or(above))
}

/// How much one step of scrubbing changes a number: one unit of its third figure or so.
pub fn step(number: f64) -> f64 {
    let mut step = 1.0;
    while step > 1e-9 && step * 100.0 > number.abs().max(1e-9) {
        step /= 10.0;
    }
    while step * 1000.0 < number.abs() {
        step *= 10.0;
    }
    if number == 0.0 { 1.0 } else { step }
}

/// A bare number is meant in the unit that stands beside the field; anything else is as it was typed.
pub fn meant_in(words: &str, unit: &str) -> String {
    match words.trim() {
        // of a text every space counts
        number if number.parse::<f64>().is_err() => String::from(words),
        number if unit.is_empty() => String::from(number),
        number => format!("{number} {unit}"),
    }
}

/// What is meant by the words of a field that begins with a value as it is shown: where they are still those, the value
/// itself with all its digits. A bare number is meant in the unit of the value; of a length the sheet says which.
pub fn exactly(typed: &str, value: &str) -> String {
    let quantity = value
        .split_once(' ')
        .filter(|(number, unit)| number.parse::<f64>().is_ok() && !unit.contains(' '));
    match quantity {
        _ if typed.trim() == to_read(value) => String::from(value),
        Some((_, unit)) if !session::is_unit_of_sheet(unit) => meant_in(typed, unit),
        Some(_) => String::from(typed.trim()),
        // of a text every space counts
        None => String::from(typed),
    }
}

/// A value as a button and the field that asks for it show it, to six digits.
pub fn to_read(value: &str) -> String {
    let (number, unit) = value.split_once(' ').unwrap_or((value, ""));
    match number.parse() {
        Ok(x) => format!("{} {unit}", base::number::significant(x, 6)).trim_end().into(),
        Err(_) => value.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::{ends_between, exactly, meant_in, slider_range, step, to_read};

    #[test]
    fn a_value_that_is_left_as_it_is_shown_keeps_its_digits() {
        let value = "252.98221281347034 mm";
        assert_eq!(to_read(value), "252.982 mm");
        assert_eq!(exactly(" 252.982 mm", value), value);
        assert_eq!(exactly("252.98 mm ", value), "252.98 mm");
        assert_eq!(exactly("252", value), "252");
        assert_eq!(exactly(" 75", "59.826 deg"), "75 deg");
        assert_eq!(exactly("4.8", "4.7 kohm"), "4.8 kohm");
        assert_eq!(exactly("820 ohm", "4.7 kohm"), "820 ohm");
        assert_eq!(exactly("3", "2 * r"), "3");
        assert_eq!(exactly("pi() / 3", "59.826 deg"), "pi() / 3");
    }

    #[test]
    fn a_bare_number_takes_the_unit_beside_it() {
        assert_eq!(meant_in(" 300 ", "ohm"), "300 ohm");
        assert_eq!(meant_in("0.3 kohm", "ohm"), "0.3 kohm");
        assert_eq!(meant_in("300", ""), "300");
        assert_eq!(meant_in("hello", "ohm"), "hello");
    }

    #[test]
    fn a_text_keeps_the_spaces_at_its_ends() {
        assert_eq!(meant_in("rent = ", ""), "rent = ");
        assert_eq!(exactly("rent = ", "text"), "rent = ");
    }

    #[test]
    fn a_slider_keeps_its_ends_while_its_number_lies_between_them() {
        assert_eq!(slider_range(120.0, None, None), (0.0, 240.0));
        assert_eq!(slider_range(180.0, None, Some(&(0.0, 240.0))), (0.0, 240.0));
        assert_eq!(slider_range(-5.0, None, Some(&(0.0, 240.0))), (-10.0, 0.0));
        assert_eq!(slider_range(30.0, Some((0.0, 360.0)), None), (0.0, 360.0));
        assert_eq!(slider_range(30.0, Some((-180.0, 180.0)), None), (-180.0, 180.0));
        assert_eq!(slider_range(400.0, Some((0.0, 360.0)), None), (0.0, 800.0));
    }

    #[test]
    fn a_slider_has_the_end_that_is_asked_and_room_where_none_is() {
        assert_eq!(ends_between(10.0, (Some(2.0), Some(50.0)), None, None), (2.0, 50.0));
        assert_eq!(ends_between(10.0, (Some(5.0), None), None, None), (5.0, 20.0));
        // the open end stays under the hand
        assert_eq!(ends_between(18.0, (Some(5.0), None), None, Some(&(5.0, 20.0))), (5.0, 20.0));
        assert_eq!(ends_between(20.0, (Some(5.0), None), None, Some(&(5.0, 20.0))), (5.0, 20.0));
        assert_eq!(ends_between(30.0, (Some(5.0), None), None, Some(&(5.0, 20.0))), (5.0, 60.0));
        assert_eq!(ends_between(5.0, (Some(5.0), None), None, None), (5.0, 10.0));
        assert_eq!(ends_between(0.0, (Some(0.0), None), None, None), (0.0, 100.0));
        assert_eq!(ends_between(-3.0, (Some(-5.0), None), None, None), (-5.0, 0.0));
        assert_eq!(ends_between(4.0, (None, Some(10.0)), None, None), (0.0, 10.0));
        assert_eq!(ends_between(0.0, (None, Some(0.0)), None, None), (-100.0, 0.0));
        assert_eq!(ends_between(1.0, (Some(0.0), None), Some((0.0, 6.0)), None), (0.0, 6.0));
    }

    #[test]
    fn scrubbing_steps_by_the_third_figure() {
        assert_eq!((step(174.0), step(0.0), step(20.0)), (1.0, 1.0, 0.1));
        assert!((step(0.0075) / 1e-5 - 1.0).abs() < 1e-9);
        assert!((step(-33_000.0) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn a_button_shows_six_digits_of_a_length() {
        assert_eq!(to_read("353.5533905932738"), "353.553");
        assert_eq!(to_read("-53.089384 deg"), "-53.0894 deg");
        assert_eq!(to_read("a + b"), "a + b");
    }
}
