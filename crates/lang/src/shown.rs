//! How values are put to people: a number of base units in, six digits and an engineer's unit out.
//!
//! All that people read of numbers (tables, explanations, refusals) comes from here, and can be typed
//! back. The unit is the one that the value was written in, where it reads well; else that of its class,
//! with a prefix by steps of a thousand. Angles are in degrees.

use crate::numbers::{is_of_the_sheet, to_bare, to_si};
use base::number::{shortest, significant};
use expr::dimension::Dimension;
use expr::units::{self, Unit};
use kernel::Document;

/// So many significant digits of a number are shown.
const DIGITS: usize = 6;

/// The prefixes of a thousand, smallest first, each with its power of ten and that as a number.
const PREFIXES: [(&str, i8, f64); 10] = [
    ("f", -15, 1e-15),
    ("p", -12, 1e-12),
    ("n", -9, 1e-9),
    ("u", -6, 1e-6),
    ("m", -3, 1e-3),
    ("", 0, 1.0),
    ("k", 3, 1e3),
    ("M", 6, 1e6),
    ("G", 9, 1e9),
    ("T", 12, 1e12),
];

/// What is known of a number beside its value.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Quantity<'a> {
    /// What it measures.
    pub dimension: Dimension,
    /// The name of its class, where it has one: `Angle` and `Torque` are told by that alone.
    pub class: &'a str,
    /// Its value as it is written in a text, with its unit; empty if it is not.
    pub written: &'a str,
}

/// A number as people read it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Shown {
    /// The number in its unit, to six significant digits.
    pub text: String,
    /// The unit, or nothing.
    pub unit: String,
    /// The number in the same unit with all its digits: what an editor begins with.
    pub exact: String,
}

/// Shows a number of base units.
///
/// A length without a unit anywhere is in the units of the sheet and has none; `unit mm` gives it one.
pub fn show_quantity(x: f64, quantity: Quantity<'_>, document: &Document) -> Shown {
    let spelling = spelling_for(x, quantity, document);
    let shown = in_unit(x, quantity.dimension, &spelling, document);
    Shown { text: significant(shown, DIGITS), unit: spelling, exact: shortest(shown) }
}

/// Returns a number of base units in a unit; without one, as a bare number of it is written.
pub fn in_unit(x: f64, dimension: Dimension, spelling: &str, document: &Document) -> f64 {
    let unit = units::unit(spelling).filter(|_| !spelling.is_empty());
    let shown = unit.and_then(|u| u.show(to_si(document, x, dimension)));
    shown.unwrap_or_else(|| to_bare(document, x, dimension))
}

/// Chooses the unit for a number of base units.
pub(crate) fn spelling_for(x: f64, quantity: Quantity<'_>, document: &Document) -> String {
    let Quantity { dimension, class, written } = quantity;
    let size = |spelling: &str| in_unit(x, dimension, spelling, document).abs();
    if class == "Angle" {
        return "deg".into();
    }
    let last = written.trim_end_matches([')', ']', ',', '}']).rsplit(char::is_whitespace).next();
    let fits = |spelling: &&str| units::unit(spelling).is_some_and(|u| u.dimension == dimension);
    if let Some(spelling) = last.filter(fits)
        && (x == 0.0 || (1e-3..1e6).contains(&size(spelling)))
    {
        return spelling.into();
    }
    if is_of_the_sheet(dimension) {
        return of_the_sheet(dimension, document, size);
    }
    let spelling = match class {
        "Torque" | "Moment" => "N*m",
        "AngularVelocity" => "rad/s",
        "AngularAcceleration" => "rad/s^2",
        _ => match units::preferred(dimension) {
            Some(spelling) => spelling,
            None => return dimension.to_string(),
        },
    };
    prefixed(spelling, size)
}

/// The unit of a plain number, a length, an area, …: that of the sheet, where it has one and the number
/// reads well in it.
fn of_the_sheet(
    dimension: Dimension,
    document: &Document,
    size: impl Fn(&str) -> f64 + Copy,
) -> String {
    let power = dimension.0[0];
    let Some(own) = document.unit.as_deref().filter(|_| power != 0) else { return String::new() };
    if power != 1 {
        return format!("{own}^{power}");
    }
    // sheets are laid out in decimetres, but nobody reads a table of them
    let unit = units::unit(own);
    let is_read = own == "cm" || unit.is_some_and(|u| u.mantissa != 1.0 || u.exponent % 3 == 0);
    if !is_read {
        return prefixed("m", size);
    }
    let least = if own == "cm" { 1.0 } else { 0.1 };
    let shown = size(own);
    if shown == 0.0 || (least..1e5).contains(&shown) { own.into() } else { prefixed("m", size) }
}

/// Returns a unit of SI with the largest prefix with which the number is not below one.
fn prefixed(spelling: &str, size: impl Fn(&str) -> f64) -> String {
    // the kilogram has its prefix already, squares have none, and nobody counts in kiloseconds
    let stem = if spelling == "kg" { "g" } else { spelling };
    let first = stem.split(['*', '/']).next().unwrap_or_default();
    let highest = match stem {
        "s" => 0,
        "g" => 3,
        _ => i8::MAX,
    };
    if size(spelling) == 0.0
        || first.contains('^')
        || matches!(first, "K" | "rad")
        || (first == "kg" && stem != "g")
    {
        return spelling.into();
    }
    let Some(base) = units::unit(stem) else { return spelling.into() };
    let is_known = |unit: Unit, by: i8| {
        (unit.dimension, unit.mantissa) == (base.dimension, 1.0)
            && unit.exponent == base.exponent + by
    };
    let rung = |&(prefix, by, _): &(&str, i8, f64)| {
        let spelling = format!("{prefix}{stem}");
        units::unit(&spelling).filter(|u| by <= highest && is_known(*u, by)).map(|_| spelling)
    };
    // as it is shown, so that 999.9999 is a thousand
    let reads =
        |s: &String| significant(size(s), DIGITS).parse::<f64>().is_ok_and(|shown| shown >= 1.0);
    let bare = size(stem);
    // what rounding does not bring to one is not looked at
    let near = PREFIXES.iter().rev().filter(|(_, _, power)| bare >= 0.5 * power);
    let smallest = || PREFIXES.iter().find_map(rung).filter(|s| size(s) >= 1e-3);
    { near }
        .filter_map(rung)
        .find(reads)
        // below the smallest prefix that there is
        .or_else(smallest)
        .unwrap_or_else(|| spelling.into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lower;

    fn document(text: &str) -> Document {
        lower(text, &|_| None, None).document
    }
    fn shown(x: f64, class: &str, written: &str, document: &Document) -> String {
        let dimension = Dimension::by_name(class).unwrap_or(Dimension::NONE);
        let shown = show_quantity(x, Quantity { dimension, class, written }, document);
        format!("{} {}", shown.text, shown.unit).trim().into()
    }

    #[test]
    fn prefixes_go_by_thousands() {
        let d = document("");
        for (x, class, wanted) in [
            (0.01, "Current", "10 mA"),
            (1500.0, "Resistance", "1.5 kohm"),
            (12_500.0, "Force", "12.5 kN"),
            (-51_961.524_227_066_32, "Force", "-51.9615 kN"),
            (0.999_999_9, "Voltage", "1 V"),
            (999.999_99, "Voltage", "1 kV"),
            (210e9, "Stress", "210 GPa"),
            (4500.0, "Torque", "4.5 kN*m"),
            (4500.0, "Energy", "4.5 kJ"),
            (0.25, "Mass", "250 g"),
            (7200.0, "Time", "7200 s"),
            (0.0, "Current", "0 A"),
            (1e-40, "Current", "1e-40 A"),
            (293.15, "Temperature", "293.15 K"),
            (1.0, "Density", "1 kg/m^3"),
            (2.0, "AngularVelocity", "2 rad/s"),
        ] {
            assert_eq!(shown(x, class, "", &d), wanted);
        }
    }
    #[test]
    fn angles_are_read_in_degrees() {
        let d = document("unit mm");
        assert_eq!(shown(std::f64::consts::FRAC_PI_4, "Angle", "", &d), "45 deg");
        assert_eq!(shown(1.0, "Angle", "1 rad", &d), "57.2958 deg");
    }
    #[test]
    fn what_is_written_is_read_in_its_unit() {
        let d = document("");
        assert_eq!(shown(1000.0, "Resistance", "1000 ohm", &d), "1000 ohm");
        assert_eq!(shown(7500.0, "Force", "10 kN", &d), "7.5 kN");
        assert_eq!(shown(1e-9, "Force", "10 kN", &d), "1 nN");
        assert_eq!(shown(10.0, "Voltage", "2 * 5", &d), "10 V");
    }
    #[test]
    fn lengths_are_in_the_unit_of_the_sheet() {
        let plain = document("");
        assert_eq!(shown(121.666_666_67, "Length", "", &plain), "121.667");
        let mm = document("unit mm");
        assert_eq!(shown(0.5, "Length", "", &mm), "0.5 mm");
        assert_eq!(shown(1250.0, "Length", "", &mm), "1250 mm");
        assert_eq!(shown(0.02, "Length", "", &mm), "20 um");
        assert_eq!(shown(2e5, "Length", "", &mm), "200 m");
        assert_eq!(shown(400.0, "Area", "", &mm), "400 mm^2");
        let dm = document("unit dm");
        assert_eq!(shown(300.0, "Length", "", &dm), "30 m");
        assert_eq!(shown(-0.568_75, "Length", "", &dm), "-56.875 mm");
    }
    #[test]
    fn what_is_shown_reads_back() {
        let d = document("unit mm");
        let quantity = Quantity { dimension: Dimension::CURRENT, class: "Current", written: "" };
        let shown = show_quantity(1.0 / 300.0, quantity, &d);
        assert_eq!((&*shown.text, &*shown.unit), ("3.33333", "mA"));
        let unit = units::unit(&shown.unit).expect("it is a unit");
        assert_eq!(unit.read(&shown.exact), Some(1.0 / 300.0));
    }
}
