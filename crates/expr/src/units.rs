//! Units: how quantities are spelled in a document, and what they are in SI.
//!
//! A factor is kept as a number times a power of ten, and powers of ten are applied to the decimal
//! text, so that `4.7 kohm` is the number that `4700` is.

use crate::dimension::Dimension;
use base::number::shortest;
use std::f64::consts::PI;

/// A unit: what it measures, and how large it is in SI, `mantissa` · 10^`exponent`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Unit {
    /// What it measures.
    pub dimension: Dimension,
    /// The factor without its power of ten: 1 for all units that are decimal multiples of SI.
    pub mantissa: f64,
    /// The power of ten of the factor.
    pub exponent: i8,
}

const fn decimal(dimension: Dimension, exponent: i8) -> Unit {
    Unit { dimension, mantissa: 1.0, exponent }
}
const fn scaled(dimension: Dimension, mantissa: f64, exponent: i8) -> Unit {
    Unit { dimension, mantissa, exponent }
}

/// Every spelling, by quantity.
const UNITS: [(&str, Unit); 86] = [
    ("m", decimal(Dimension::LENGTH, 0)),
    ("mm", decimal(Dimension::LENGTH, -3)),
    ("cm", decimal(Dimension::LENGTH, -2)),
    ("km", decimal(Dimension::LENGTH, 3)),
    ("um", decimal(Dimension::LENGTH, -6)),
    ("inch", scaled(Dimension::LENGTH, 254.0, -4)),
    ("ft", scaled(Dimension::LENGTH, 3048.0, -4)),
    ("rad", decimal(Dimension::ANGLE, 0)),
    ("deg", scaled(Dimension::ANGLE, PI / 180.0, 0)),
    ("turn", scaled(Dimension::ANGLE, 2.0 * PI, 0)),
    ("kg", decimal(Dimension::MASS, 0)),
    ("g", decimal(Dimension::MASS, -3)),
    ("t", decimal(Dimension::MASS, 3)),
    ("s", decimal(Dimension::TIME, 0)),
    ("ms", decimal(Dimension::TIME, -3)),
    ("us", decimal(Dimension::TIME, -6)),
    ("ns", decimal(Dimension::TIME, -9)),
    ("min", scaled(Dimension::TIME, 60.0, 0)),
    ("h", scaled(Dimension::TIME, 3600.0, 0)),
    ("A", decimal(Dimension::CURRENT, 0)),
    ("mA", decimal(Dimension::CURRENT, -3)),
    ("uA", decimal(Dimension::CURRENT, -6)),
    ("K", decimal(Dimension::TEMPERATURE, 0)),
    ("V", decimal(Dimension::VOLTAGE, 0)),
    ("mV", decimal(Dimension::VOLTAGE, -3)),
    ("uV", decimal(Dimension::VOLTAGE, -6)),
    ("kV", decimal(Dimension::VOLTAGE, 3)),
    ("ohm", decimal(Dimension::RESISTANCE, 0)),
    ("kohm", decimal(Dimension::RESISTANCE, 3)),
    ("Mohm", decimal(Dimension::RESISTANCE, 6)),
    ("S", decimal(Dimension::CONDUCTANCE, 0)),
    ("F", decimal(Dimension::CAPACITANCE, 0)),
    ("mF", decimal(Dimension::CAPACITANCE, -3)),
    ("uF", decimal(Dimension::CAPACITANCE, -6)),
    ("nF", decimal(Dimension::CAPACITANCE, -9)),
    ("pF", decimal(Dimension::CAPACITANCE, -12)),
    ("H", decimal(Dimension::INDUCTANCE, 0)),
    ("mH", decimal(Dimension::INDUCTANCE, -3)),
    ("uH", decimal(Dimension::INDUCTANCE, -6)),
    ("C", decimal(Dimension::CHARGE, 0)),
    ("N", decimal(Dimension::FORCE, 0)),
    ("mN", decimal(Dimension::FORCE, -3)),
    ("kN", decimal(Dimension::FORCE, 3)),
    ("MN", decimal(Dimension::FORCE, 6)),
    ("Pa", decimal(Dimension::PRESSURE, 0)),
    ("kPa", decimal(Dimension::PRESSURE, 3)),
    ("MPa", decimal(Dimension::PRESSURE, 6)),
    ("GPa", decimal(Dimension::PRESSURE, 9)),
    ("J", decimal(Dimension::ENERGY, 0)),
    ("kJ", decimal(Dimension::ENERGY, 3)),
    ("MJ", decimal(Dimension::ENERGY, 6)),
    ("W", decimal(Dimension::POWER, 0)),
    ("mW", decimal(Dimension::POWER, -3)),
    ("kW", decimal(Dimension::POWER, 3)),
    ("MW", decimal(Dimension::POWER, 6)),
    ("Hz", decimal(Dimension::FREQUENCY, 0)),
    ("kHz", decimal(Dimension::FREQUENCY, 3)),
    ("MHz", decimal(Dimension::FREQUENCY, 6)),
    ("GHz", decimal(Dimension::FREQUENCY, 9)),
    ("nm", decimal(Dimension::LENGTH, -9)),
    ("dm", decimal(Dimension::LENGTH, -1)),
    ("yd", scaled(Dimension::LENGTH, 9144.0, -4)),
    ("°", scaled(Dimension::ANGLE, PI / 180.0, 0)),
    ("mrad", decimal(Dimension::ANGLE, -3)),
    ("grad", scaled(Dimension::ANGLE, PI / 200.0, 0)),
    ("mg", decimal(Dimension::MASS, -6)),
    ("hPa", decimal(Dimension::PRESSURE, 2)),
    ("bar", decimal(Dimension::PRESSURE, 5)),
    ("mJ", decimal(Dimension::ENERGY, -3)),
    ("nV", decimal(Dimension::VOLTAGE, -9)),
    ("pA", decimal(Dimension::CURRENT, -12)),
    ("nA", decimal(Dimension::CURRENT, -9)),
    ("kA", decimal(Dimension::CURRENT, 3)),
    ("mohm", decimal(Dimension::RESISTANCE, -3)),
    ("nH", decimal(Dimension::INDUCTANCE, -9)),
    ("nC", decimal(Dimension::CHARGE, -9)),
    ("uC", decimal(Dimension::CHARGE, -6)),
    ("mC", decimal(Dimension::CHARGE, -3)),
    ("uS", decimal(Dimension::CONDUCTANCE, -6)),
    ("mS", decimal(Dimension::CONDUCTANCE, -3)),
    ("T", decimal(FLUX_DENSITY, 0)),
    ("mT", decimal(FLUX_DENSITY, -3)),
    ("Wb", decimal(FLUX, 0)),
    ("mol", decimal(Dimension([0, 0, 0, 0, 0, 1, 0]), 0)),
    ("cd", decimal(Dimension([0, 0, 0, 0, 0, 0, 1]), 0)),
    ("%", decimal(Dimension::NONE, -2)),
];

/// Magnetic flux: V·s.
const FLUX: Dimension = Dimension([2, 1, -2, -1, 0, 0, 0]);
/// Magnetic flux density: V·s/m².
const FLUX_DENSITY: Dimension = Dimension([0, 1, -2, -1, 0, 0, 0]);

/// Returns the unit of a spelling, simple or compound: `mm`, `m/s^2`, `N*m`, `kg/m^3`.
///
/// Compound spellings are `unit(^whole)?((*|/)unit(^whole)?)*`, read from left to right, without
/// spaces.
///
/// ```
/// use expr::{Dimension, units::unit};
/// assert_eq!(unit("m/s^2").map(|u| u.dimension), Some(Dimension::ACCELERATION));
/// assert_eq!(unit("N*m").map(|u| u.dimension), Some(Dimension::MOMENT));
/// assert_eq!(unit("kΩ"), unit("kohm"));
/// assert_eq!(unit("furlong"), None);
/// ```
pub fn unit(spelling: &str) -> Option<Unit> {
    // the two letters µ and the sign Ω are other spellings of u and ohm
    let plain = spelling.replace(['µ', 'μ'], "u").replace('Ω', "ohm");
    let mut whole = decimal(Dimension::NONE, 0);
    let mut rest = plain.as_str();
    let mut above = true;
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let (name, power) = match rest[..end].split_once('^') {
            Some((name, power)) => (name, power.parse::<i8>().ok()?),
            None => (&rest[..end], 1),
        };
        let factor = UNITS.iter().find(|(n, _)| *n == name)?.1;
        let power = if above { power } else { power.checked_neg()? };
        whole.dimension = whole.dimension.times(factor.dimension.power(power));
        whole.exponent = whole.exponent.checked_add(factor.exponent.checked_mul(power)?)?;
        for _ in 0..power.unsigned_abs() {
            if power > 0 {
                whole.mantissa *= factor.mantissa;
            } else {
                whole.mantissa /= factor.mantissa;
            }
        }
        let Some(operator) = rest[end..].chars().next() else { break };
        above = operator == '*';
        rest = &rest[end + 1..];
    }
    Some(whole)
}

/// Returns every simple spelling, for completion and for hints.
pub fn spellings() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|(spelling, _)| *spelling)
}

/// Reads a number with its unit and returns it in SI, with its dimension.
///
/// Where the unit is a power of ten of SI, the result is the number nearest to the decimal written.
///
/// ```
/// use expr::{Dimension, units::read_quantity};
/// assert_eq!(read_quantity("4.7", "kohm"), Some((4700.0, Dimension::RESISTANCE)));
/// assert_eq!(read_quantity("0.3", "mm"), Some((0.0003, Dimension::LENGTH)));
/// ```
pub fn read_quantity(number: &str, spelling: &str) -> Option<(f64, Dimension)> {
    let unit = unit(spelling)?;
    Some((unit.read(number)?, unit.dimension))
}

impl Unit {
    /// Reads a number written in this unit and returns it in SI.
    pub fn read(self, number: &str) -> Option<f64> {
        if self.mantissa == 1.0 {
            return shifted(number, i32::from(self.exponent));
        }
        let scaled = number.parse::<f64>().ok()? * self.mantissa;
        shifted(&shortest(scaled), i32::from(self.exponent))
    }
    /// Returns a number in SI as one in this unit: what [`Unit::read`] reads back, rounding aside.
    pub fn show(self, in_si: f64) -> Option<f64> {
        let shown = shifted(&shortest(in_si), -i32::from(self.exponent))?;
        Some(shown / self.mantissa)
    }
}

/// Reads a decimal times a power of ten, correctly rounded.
fn shifted(number: &str, exponent: i32) -> Option<f64> {
    if exponent == 0 {
        return number.parse().ok();
    }
    let (digits, own) = match number.split_once(['e', 'E']) {
        Some((digits, own)) => (digits, own.parse::<i32>().ok()?),
        None => (number, 0),
    };
    format!("{digits}e{}", own.checked_add(exponent)?).parse().ok()
}

/// Returns the unit in which a quantity is shown: `V`, `A`, `kg`; none for plain numbers and lengths.
///
/// It is always the unit of SI, so that the number shown is the number kept.
pub fn preferred(dimension: Dimension) -> Option<&'static str> {
    const PREFERRED: [(Dimension, &str); 25] = [
        (Dimension::AREA, "m^2"),
        (Dimension::VOLUME, "m^3"),
        (Dimension::MASS, "kg"),
        (Dimension::TIME, "s"),
        (Dimension::CURRENT, "A"),
        (Dimension::TEMPERATURE, "K"),
        (Dimension::VELOCITY, "m/s"),
        (Dimension::ACCELERATION, "m/s^2"),
        (Dimension::MOMENTUM, "N*s"),
        (Dimension::FORCE, "N"),
        (Dimension::PRESSURE, "Pa"),
        (Dimension::ENERGY, "J"),
        (Dimension::POWER, "W"),
        (Dimension::VOLTAGE, "V"),
        (Dimension::RESISTANCE, "ohm"),
        (Dimension::CONDUCTANCE, "S"),
        (Dimension::CAPACITANCE, "F"),
        (Dimension::INDUCTANCE, "H"),
        (Dimension::CHARGE, "C"),
        (Dimension::FREQUENCY, "Hz"),
        (Dimension::STIFFNESS, "N/m"),
        (Dimension::DAMPING, "N*s/m"),
        (Dimension::DENSITY, "kg/m^3"),
        (Dimension::MOMENT_OF_INERTIA, "kg*m^2"),
        (Dimension::SECOND_MOMENT_OF_AREA, "m^4"),
    ];
    PREFERRED.iter().find(|(d, _)| *d == dimension).map(|(_, unit)| *unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_unit_is_refused() {
        for spelling in ["", "mm ", "m/", "/s", "m^", "m^x", "m^^2", "m^200", "km^100", "*"] {
            assert_eq!(unit(spelling), None, "{spelling}");
        }
        assert_eq!(read_quantity("4,7", "mm"), None);
        assert_eq!(read_quantity("", "mm"), None);
    }
    #[test]
    fn decimal_units_read_as_the_decimal_does() {
        for (number, unit, wanted) in [
            ("4.7", "kohm", 4.7e3),
            ("0.1", "mm", 0.0001),
            ("2.2", "uF", 2.2e-6),
            ("1e3", "mA", 1.0),
            ("33", "pF", 33e-12),
            ("9.81", "m/s^2", 9.81),
            ("200", "cm^2", 0.02),
            ("7850", "kg/m^3", 7850.0),
            ("7.85", "g/cm^3", 7850.0),
            ("210", "GPa", 210e9),
            ("12", "inch", 0.3048),
            ("1", "ft", 0.3048),
            ("90", "min", 5400.0),
            ("-3", "N/mm", -3000.0),
        ] {
            assert_eq!(read_quantity(number, unit).map(|q| q.0), Some(wanted), "{number} {unit}");
        }
    }
    #[test]
    fn angles_are_radians() {
        assert_eq!(read_quantity("180", "deg"), Some((PI, Dimension::NONE)));
        assert_eq!(read_quantity("0.5", "turn"), Some((PI, Dimension::NONE)));
    }
    #[test]
    fn the_preferred_unit_is_the_unit_of_si() {
        for name in Dimension::names() {
            let dimension = Dimension::by_name(name).expect("names are known");
            let Some(spelling) = preferred(dimension) else { continue };
            assert_eq!(unit(spelling), Some(decimal(dimension, 0)), "{spelling}");
        }
        assert_eq!(preferred(Dimension::LENGTH), None);
    }
    #[test]
    fn shown_is_what_was_read() {
        for (number, spelling) in [("4.7", "kohm"), ("0.1", "mm"), ("3", "inch"), ("90", "deg")] {
            let unit = unit(spelling).expect("these are units");
            let in_si = unit.read(number).expect("these are numbers");
            assert_eq!(unit.show(in_si), number.parse().ok(), "{number} {spelling}");
        }
    }
    #[test]
    fn no_spelling_stands_twice() {
        let mut all: Vec<&str> = spellings().collect();
        all.sort_unstable();
        all.dedup();
        assert_eq!(all.len(), UNITS.len());
    }
}
