//! Units: how quantities are spelled in a document, and what they are in SI.
//!
//! A factor is kept as a number times a power of ten, and powers of ten are applied to the decimal
//! text, so that `4.7 kohm` is the number that `4700` is.

use crate::dimension::Dimension;
use base::diagnostic::nearest;
use base::number::shortest;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::LazyLock;

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

/// A unit as it stands in the table.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NamedUnit {
    /// How it is spelled after a number.
    pub spelling: &'static str,
    /// Its name in words.
    pub name: &'static str,
    /// What it is.
    pub unit: Unit,
    /// True if it takes the prefixes of SI.
    pub is_prefixed: bool,
}

const fn si(spelling: &'static str, name: &'static str, unit: Unit) -> NamedUnit {
    NamedUnit { spelling, name, unit, is_prefixed: true }
}
const fn lone(spelling: &'static str, name: &'static str, unit: Unit) -> NamedUnit {
    NamedUnit { spelling, name, unit, is_prefixed: false }
}

/// Every unit, by quantity; of an ambiguous spelling the unit without a prefix counts (`ft`, `min`, `cd`).
///
/// **Source:** BIPM, *The International System of Units*, 9th ed.; NIST SP 811, appendix B, for all others.
pub const NAMED_UNITS: &[NamedUnit] = &[
    si("m", "metre", decimal(Dimension::LENGTH, 0)),
    lone("in", "inch", scaled(Dimension::LENGTH, 254.0, -4)),
    lone("inch", "inch", scaled(Dimension::LENGTH, 254.0, -4)),
    lone("ft", "foot", scaled(Dimension::LENGTH, 3048.0, -4)),
    // the point of typesetting by computer: 72 make an inch
    lone("pt", "point", scaled(Dimension::LENGTH, 0.0254 / 72.0, 0)),
    lone("yd", "yard", scaled(Dimension::LENGTH, 9144.0, -4)),
    lone("mi", "mile", scaled(Dimension::LENGTH, 1_609_344.0, -3)),
    lone("nmi", "nautical mile", scaled(Dimension::LENGTH, 1852.0, 0)),
    lone("au", "astronomical unit", scaled(Dimension::LENGTH, 149_597_870_700.0, 0)),
    lone("ly", "light year", scaled(Dimension::LENGTH, 9_460_730_472_580_800.0, 0)),
    // 648 000 / π astronomical units, as the IAU has defined it in 2015
    si("pc", "parsec", scaled(Dimension::LENGTH, 3.085_677_581_491_367e16, 0)),
    lone("ha", "hectare", decimal(Dimension::AREA, 4)),
    lone("acre", "acre", scaled(Dimension::AREA, 40_468_564_224.0, -7)),
    si("L", "litre", decimal(Dimension::VOLUME, -3)),
    // `l`, `dl` and `cl` are names like any other: `{ d = 8  l = 40 }`, `{ cd = 0.3  cl = 1.2 }`
    lone("ml", "millilitre", decimal(Dimension::VOLUME, -6)),
    lone("gal", "gallon", scaled(Dimension::VOLUME, 3_785_411_784.0, -12)),
    si("rad", "radian", decimal(Dimension::ANGLE, 0)),
    lone("deg", "degree", scaled(Dimension::ANGLE, PI / 180.0, 0)),
    lone("°", "degree", scaled(Dimension::ANGLE, PI / 180.0, 0)),
    lone("grad", "gradian", scaled(Dimension::ANGLE, PI / 200.0, 0)),
    lone("arcmin", "arc minute", scaled(Dimension::ANGLE, PI / 10_800.0, 0)),
    lone("arcsec", "arc second", scaled(Dimension::ANGLE, PI / 648_000.0, 0)),
    lone("mas", "milliarcsecond", scaled(Dimension::ANGLE, PI / 648_000.0, -3)),
    lone("turn", "turn", scaled(Dimension::ANGLE, 2.0 * PI, 0)),
    lone("rev", "revolution", scaled(Dimension::ANGLE, 2.0 * PI, 0)),
    lone("%", "percent", decimal(Dimension::NONE, -2)),
    lone("ppm", "part in a million", decimal(Dimension::NONE, -6)),
    si("g", "gram", decimal(Dimension::MASS, -3)),
    lone("t", "tonne", decimal(Dimension::MASS, 3)),
    lone("kt", "kilotonne", decimal(Dimension::MASS, 6)),
    lone("Mt", "megatonne", decimal(Dimension::MASS, 9)),
    lone("lb", "pound", scaled(Dimension::MASS, 45_359_237.0, -8)),
    lone("oz", "ounce", scaled(Dimension::MASS, 28_349_523_125.0, -12)),
    // a pound-force second squared a foot
    lone("slug", "slug", scaled(Dimension::MASS, 14.593_902_937_206_365, 0)),
    si("s", "second", decimal(Dimension::TIME, 0)),
    lone("min", "minute", scaled(Dimension::TIME, 60.0, 0)),
    lone("h", "hour", scaled(Dimension::TIME, 3600.0, 0)),
    lone("day", "day", scaled(Dimension::TIME, 86_400.0, 0)),
    lone("week", "week", scaled(Dimension::TIME, 604_800.0, 0)),
    // the Julian year; not `year`, which is a part of many a date
    lone("yr", "year", scaled(Dimension::TIME, 31_557_600.0, 0)),
    si("Hz", "hertz", decimal(Dimension::FREQUENCY, 0)),
    lone("rpm", "revolution a minute", scaled(Dimension::FREQUENCY, PI / 30.0, 0)),
    lone("knot", "nautical mile an hour", scaled(Dimension::VELOCITY, 1852.0 / 3600.0, 0)),
    lone("mph", "mile an hour", scaled(Dimension::VELOCITY, 44_704.0, -5)),
    si("N", "newton", decimal(Dimension::FORCE, 0)),
    lone("lbf", "pound-force", scaled(Dimension::FORCE, 44_482_216_152_605.0, -13)),
    lone("kgf", "kilogram-force", scaled(Dimension::FORCE, 980_665.0, -5)),
    lone("kip", "kilopound-force", scaled(Dimension::FORCE, 44_482_216_152_605.0, -10)),
    lone("dyn", "dyne", decimal(Dimension::FORCE, -5)),
    si("Pa", "pascal", decimal(Dimension::PRESSURE, 0)),
    si("bar", "bar", decimal(Dimension::PRESSURE, 5)),
    lone("atm", "atmosphere", scaled(Dimension::PRESSURE, 101_325.0, 0)),
    lone("psi", "pound a square inch", scaled(Dimension::PRESSURE, 6_894.757_293_168_361, 0)),
    lone("ksi", "kilopound a square inch", scaled(Dimension::PRESSURE, 6_894.757_293_168_361, 3)),
    lone("Torr", "torr", scaled(Dimension::PRESSURE, 101_325.0 / 760.0, 0)),
    lone("mmHg", "millimetre of mercury", scaled(Dimension::PRESSURE, 133_322_387_415.0, -9)),
    si("J", "joule", decimal(Dimension::ENERGY, 0)),
    lone("erg", "erg", decimal(Dimension::ENERGY, -7)),
    lone("BTU", "British thermal unit", scaled(Dimension::ENERGY, 105_505_585_262.0, -8)),
    si("Wh", "watt-hour", scaled(Dimension::ENERGY, 3600.0, 0)),
    si("eV", "electronvolt", scaled(Dimension::ENERGY, 1_602_176_634.0, -28)),
    si("cal", "calorie", scaled(Dimension::ENERGY, 4184.0, -3)),
    si("W", "watt", decimal(Dimension::POWER, 0)),
    si("VA", "volt-ampere", decimal(Dimension::POWER, 0)),
    lone("hp", "horsepower", scaled(Dimension::POWER, 745.699_871_582_270_2, 0)),
    si("A", "ampere", decimal(Dimension::CURRENT, 0)),
    si("V", "volt", decimal(Dimension::VOLTAGE, 0)),
    si("ohm", "ohm", decimal(Dimension::RESISTANCE, 0)),
    si("S", "siemens", decimal(Dimension::CONDUCTANCE, 0)),
    si("F", "farad", decimal(Dimension::CAPACITANCE, 0)),
    si("H", "henry", decimal(Dimension::INDUCTANCE, 0)),
    si("C", "coulomb", decimal(Dimension::CHARGE, 0)),
    si("Ah", "ampere-hour", scaled(Dimension::CHARGE, 3600.0, 0)),
    si("Wb", "weber", decimal(Dimension::MAGNETIC_FLUX, 0)),
    si("T", "tesla", decimal(Dimension::MAGNETIC_FLUX_DENSITY, 0)),
    si("K", "kelvin", decimal(Dimension::TEMPERATURE, 0)),
    si("mol", "mole", decimal(Dimension::AMOUNT, 0)),
    si("cd", "candela", decimal(Dimension::LUMINOUS_INTENSITY, 0)),
    si("lm", "lumen", decimal(Dimension::LUMINOUS_INTENSITY, 0)),
    si("lx", "lux", decimal(Dimension::ILLUMINANCE, 0)),
    si("Bq", "becquerel", decimal(Dimension::FREQUENCY, 0)),
    si("Gy", "gray", decimal(Dimension::DOSE, 0)),
    si("Sv", "sievert", decimal(Dimension::DOSE, 0)),
];

/// Every prefix of SI, its name and its power of ten; `µ` is read as `u`.
pub const PREFIXES: [(&str, &str, i8); 24] = [
    ("Q", "quetta", 30),
    ("R", "ronna", 27),
    ("Y", "yotta", 24),
    ("Z", "zetta", 21),
    ("E", "exa", 18),
    ("P", "peta", 15),
    ("T", "tera", 12),
    ("G", "giga", 9),
    ("M", "mega", 6),
    ("k", "kilo", 3),
    ("h", "hecto", 2),
    ("da", "deca", 1),
    ("d", "deci", -1),
    ("c", "centi", -2),
    ("m", "milli", -3),
    ("u", "micro", -6),
    ("n", "nano", -9),
    ("p", "pico", -12),
    ("f", "femto", -15),
    ("a", "atto", -18),
    ("z", "zepto", -21),
    ("y", "yocto", -24),
    ("r", "ronto", -27),
    ("q", "quecto", -30),
];

/// The table by spelling: every number that is shown asks it several times.
static BY_SPELLING: LazyLock<BTreeMap<&str, &NamedUnit>> =
    LazyLock::new(|| NAMED_UNITS.iter().map(|named| (named.spelling, named)).collect());

/// Returns the unit of a word without operators: one of the table, with a prefix where it takes one.
fn simple(word: &str) -> Option<Unit> {
    // nothing, and numbers, are asked for most
    if word.bytes().next().is_none_or(|first| first.is_ascii_digit()) {
        return None;
    }
    if let Some(named) = BY_SPELLING.get(word) {
        return Some(named.unit);
    }
    PREFIXES.iter().find_map(|(prefix, _, exponent)| {
        let base = word.strip_prefix(prefix)?;
        let named = BY_SPELLING.get(base).filter(|named| named.is_prefixed)?;
        let exponent = named.unit.exponent.checked_add(*exponent)?;
        Some(Unit { exponent, ..named.unit })
    })
}

/// Returns the unit of a spelling, simple or compound: `mm`, `m/s^2`, `N*m`, `kg/m^3`.
///
/// Compound spellings are `(1/)?unit(^whole)?((*|/)unit(^whole)?)*`, read from left to right, without
/// spaces.
///
/// ```
/// use expr::{Dimension, units::unit};
/// assert_eq!(unit("m/s^2").map(|u| u.dimension), Some(Dimension::ACCELERATION));
/// assert_eq!(unit("N*m").map(|u| u.dimension), Some(Dimension::MOMENT));
/// assert_eq!(unit("kΩ"), unit("kohm"));
/// assert_eq!(unit("1/min"), unit("min^-1"));
/// assert_eq!(unit("furlong"), None);
/// ```
pub fn unit(spelling: &str) -> Option<Unit> {
    // the two letters µ and the sign Ω are other spellings of u and ohm
    let plain = match spelling.is_ascii() {
        true => Cow::Borrowed(spelling),
        false => Cow::Owned(spelling.replace(['µ', 'μ'], "u").replace('Ω', "ohm")),
    };
    let mut whole = decimal(Dimension::NONE, 0);
    let (mut rest, mut above) = match plain.strip_prefix("1/") {
        Some(rest) => (rest, false),
        None => (&*plain, true),
    };
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let (name, power) = match rest[..end].split_once('^') {
            Some((name, power)) => (name, power.parse::<i8>().ok()?),
            None => (&rest[..end], 1),
        };
        let factor = simple(name)?;
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

/// Returns every spelling without a prefix, for completion.
pub fn spellings() -> impl Iterator<Item = &'static str> {
    NAMED_UNITS.iter().map(|named| named.spelling)
}

/// Returns true for a prefix of SI that is no unit.
pub fn is_prefix(word: &str) -> bool {
    unit(word).is_none() && PREFIXES.iter().any(|(prefix, ..)| *prefix == word)
}

/// Returns the spellings that somebody can have meant by a word that is no unit, none of another magnitude.
///
/// Names in words, plurals, other cases of the letters, factors without `*`; and a slip in a word of three
/// letters or more, whose prefix stays as it is.
///
/// ```
/// use expr::units::meant;
/// assert_eq!(meant("millimeters"), ["mm"]);
/// assert_eq!(meant("Nm"), ["N*m"]);
/// assert_eq!(meant("khz"), ["kHz"]);
/// assert_eq!(meant("mhz"), ["MHz", "mHz"]);
/// assert_eq!(meant("kohn"), ["kohm"]);
/// assert_eq!(meant("years"), ["yr"]);
/// assert!(meant("furlong").is_empty());
/// ```
pub fn meant(word: &str) -> Vec<String> {
    let prefixes = || std::iter::once(("", "")).chain(PREFIXES.map(|(p, name, _)| (p, name)));
    let prefixed = |with: &dyn Fn(&str, &str, &NamedUnit) -> bool| {
        let mut found: Vec<String> = Vec::new();
        for (prefix, prefix_name) in prefixes() {
            for named in NAMED_UNITS.iter().filter(|n| prefix.is_empty() || n.is_prefixed) {
                if with(prefix, prefix_name, named) {
                    let spelling = format!("{prefix}{}", named.spelling);
                    // the unit without a prefix may stand for it
                    found.extend(unit(&spelling).is_some().then_some(spelling));
                }
            }
        }
        found.dedup();
        found
    };
    let lower = word.to_lowercase();
    // so many thousands or millionths of what is not said
    if is_prefix(word) {
        return Vec::new();
    }
    let in_words = prefixed(&|prefix, prefix_name, named| {
        let rest = lower.strip_prefix(prefix_name);
        let rest = rest.or_else(|| word.strip_prefix(prefix));
        rest.is_some_and(|rest| names_of(named).iter().any(|name| rest.eq_ignore_ascii_case(name)))
    });
    if let Some(first) = in_words.into_iter().next() {
        return vec![first];
    }
    if let Some((_, spelling)) = COLLOQUIAL.iter().find(|(said, _)| *said == lower) {
        return vec![(*spelling).to_string()];
    }
    let factors = (1..word.len()).filter(|&i| word.is_char_boundary(i)).find_map(|i| {
        let (a, b) = word.split_at(i);
        (simple(a).is_some() && ["m", "s", "h"].contains(&b)).then(|| format!("{a}*{b}"))
    });
    if let Some(factors) = factors {
        return vec![factors];
    }
    let other_case =
        prefixed(&|prefix, _, named| format!("{prefix}{}", named.spelling).to_lowercase() == lower);
    if !other_case.is_empty() {
        return other_case;
    }
    let slips = prefixed(&|prefix, _, named| {
        let Some(rest) = word.strip_prefix(prefix) else { return false };
        let is_usual = prefix.is_empty() || "TGMkcmunp".contains(prefix);
        let is_long = is_usual && rest.chars().count() >= 3 && named.spelling.chars().count() >= 3;
        is_long && nearest(rest, [named.spelling]).is_some()
    });
    slips.into_iter().next().into_iter().collect()
}

/// What people say for a unit and no table of them knows.
const COLLOQUIAL: [(&str, &str); 33] = [
    ("sec", "s"),
    ("secs", "s"),
    ("hr", "h"),
    ("hrs", "h"),
    ("mins", "min"),
    ("amp", "A"),
    ("amps", "A"),
    ("lbs", "lb"),
    ("kgs", "kg"),
    ("kilo", "kg"),
    ("kilos", "kg"),
    ("gms", "g"),
    ("knots", "knot"),
    ("micron", "um"),
    ("microns", "um"),
    ("psf", "lbf/ft^2"),
    ("pcf", "lb/ft^3"),
    ("plf", "lbf/ft"),
    ("klf", "kip/ft"),
    ("gpm", "gal/min"),
    ("cfm", "ft^3/min"),
    ("fps", "ft/s"),
    ("ftlb", "ft*lbf"),
    ("kph", "km/h"),
    ("kmh", "km/h"),
    ("feet", "ft"),
    ("percent", "%"),
    ("pct", "%"),
    ("cc", "cm^3"),
    ("l", "L"),
    ("sqm", "m^2"),
    ("cbm", "m^3"),
    ("mps", "m/s"),
];

/// Returns the words for a unit: its name and its plural, with American spellings.
fn names_of(named: &NamedUnit) -> Vec<String> {
    let name = named.name;
    let american = name.strip_suffix("re").map_or(name.to_string(), |stem| format!("{stem}er"));
    let mut names = Vec::new();
    for one in [name, &american] {
        names.extend([one.to_string(), format!("{one}s"), format!("{one}es")]);
    }
    if named.spelling == "ohm" {
        names.push("Ω".to_string());
    }
    names
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
    ///
    /// A number of eighteen or nineteen digits is read more exactly than a number of base units is kept, so that each of
    /// these can be written in every unit.
    pub fn read(self, number: &str) -> Option<f64> {
        if self.mantissa == 1.0 {
            return shifted(number, i32::from(self.exponent));
        }
        if let Some(exact) = self.read_many_digits(number) {
            return Some(exact);
        }
        let scaled = number.parse::<f64>().ok()? * self.mantissa;
        shifted(&shortest(scaled), i32::from(self.exponent))
    }
    /// Reads a number of eighteen or nineteen digits: the number nearest to its product with the factor as that is written.
    fn read_many_digits(self, number: &str) -> Option<f64> {
        if number.len() < 18 {
            return None;
        }
        let (sign, digits) = number.strip_prefix('-').map_or(("", number), |rest| ("-", rest));
        let (n, n_power) = whole(digits)?;
        if !(10_u128.pow(17)..10_u128.pow(19)).contains(&n) {
            return None;
        }
        let (factor, power) = whole(&shortest(self.mantissa))?;
        let product = n.checked_mul(factor)?;
        shifted(&format!("{sign}{product}"), n_power + power + i32::from(self.exponent))
    }
    /// Returns a number in SI as one in this unit: what [`Unit::read`] reads back, rounding aside.
    pub fn show(self, in_si: f64) -> Option<f64> {
        let shown = shifted(&shortest(in_si), -i32::from(self.exponent))?;
        Some(shown / self.mantissa)
    }
}

/// Reads a decimal as a whole number times a power of ten.
fn whole(number: &str) -> Option<(u128, i32)> {
    let (digits, power) = number.split_once('e').unwrap_or((number, "0"));
    let (before, behind) = digits.split_once('.').unwrap_or((digits, ""));
    let power = power.parse::<i32>().ok()? - i32::try_from(behind.len()).ok()?;
    Some((format!("{before}{behind}").parse().ok()?, power))
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
    const PREFERRED: [(Dimension, &str); 69] = [
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
        (Dimension::AMOUNT, "mol"),
        (Dimension::LUMINOUS_INTENSITY, "cd"),
        (Dimension::ILLUMINANCE, "lx"),
        (Dimension::MAGNETIC_FLUX, "Wb"),
        (Dimension::MAGNETIC_FLUX_DENSITY, "T"),
        (Dimension::ELECTRIC_FIELD, "V/m"),
        (Dimension::RESISTIVITY, "ohm*m"),
        (Dimension::CONDUCTIVITY, "S/m"),
        (Dimension::VISCOSITY, "Pa*s"),
        (Dimension::DIFFUSIVITY, "m^2/s"),
        (Dimension::VOLUME_FLOW, "m^3/s"),
        (Dimension::MASS_FLOW, "kg/s"),
        (Dimension::HEAT_CAPACITY, "J/K"),
        (Dimension::SPECIFIC_HEAT, "J/kg/K"),
        (Dimension::THERMAL_CONDUCTIVITY, "W/m/K"),
        (Dimension::HEAT_FLUX, "W/m^2"),
        (Dimension::DOSE, "J/kg"),
        (Dimension::ANGULAR_MOMENTUM, "J*s"),
        (Dimension::MOLAR_MASS, "kg/mol"),
        (Dimension::MOLAR_HEAT_CAPACITY, "J/mol/K"),
        (Dimension::CONCENTRATION, "mol/m^3"),
        (Dimension::AREA_DENSITY, "kg/m^2"),
        (Dimension::HEAT_TRANSFER, "W/m^2/K"),
        (Dimension::THERMAL_EXPANSION, "m/m/K"),
        (Dimension::PERMITTIVITY, "F/m"),
        (Dimension::PERMEABILITY, "H/m"),
        (Dimension::THERMAL_RESISTANCE, "K/W"),
        (Dimension::THERMAL_CONDUCTANCE, "W/K"),
        (Dimension::BENDING_STIFFNESS, "N*m^2"),
        (Dimension::LINE_DENSITY, "kg/m"),
        (Dimension::SPECIFIC_VOLUME, "m^3/kg"),
        (Dimension::PRESSURE_GRADIENT, "Pa/m"),
        (Dimension::FLOW_RESISTANCE, "Pa*s/m^3"),
        (Dimension::JERK, "m/s^3"),
        (Dimension::CURRENT_DENSITY, "A/m^2"),
        (Dimension::MAGNETIC_FIELD, "A/m"),
        (Dimension::GRAVITATION, "N*m^2/kg^2"),
        (Dimension::RADIATION, "W/m^2/K^4"),
        (Dimension::MOLAR_CHARGE, "C/mol"),
        (Dimension::RECIPROCAL_AMOUNT, "1/mol"),
        (Dimension::MOLAR_ENERGY, "J/mol"),
        (Dimension::MOLAR_VOLUME, "m^3/mol"),
        (Dimension::POWER_DENSITY, "W/m^3"),
        (Dimension::COMPRESSIBILITY, "1/Pa"),
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
        assert_eq!(all.len(), NAMED_UNITS.len());
    }
    #[test]
    fn every_prefix_stands_before_every_unit_of_si() {
        for (prefix, _, exponent) in PREFIXES {
            let newton = unit(&format!("{prefix}N")).map(|u| (u.dimension, u.exponent));
            assert_eq!(newton, Some((Dimension::FORCE, exponent)), "{prefix}N");
        }
        assert_eq!(read_quantity("3", "THz").map(|q| q.0), Some(3e12));
        assert_eq!(read_quantity("1", "fC").map(|q| q.0), Some(1e-15));
        assert_eq!(unit("kmin"), None);
        // without a prefix counts first
        assert_eq!(unit("ft").map(|u| u.dimension), Some(Dimension::LENGTH));
        assert_eq!(unit("cd").map(|u| u.dimension), Some(Dimension::LUMINOUS_INTENSITY));
        assert_eq!(unit("mT").map(|u| u.exponent), Some(-3));
    }
    #[test]
    fn other_systems_are_exact_by_definition() {
        for (number, unit, wanted) in [
            ("1", "in", 0.0254),
            ("1", "mi", 1609.344),
            ("1", "ly", 9.460_730_472_580_8e15),
            ("1", "lb", 0.453_592_37),
            ("1", "lbf", 4.448_221_615_260_5),
            ("1", "gal", 3.785_411_784e-3),
            ("2.5", "kWh", 9e6),
            ("1", "eV", 1.602_176_634e-19),
            ("2000", "mAh", 7200.0),
            ("1", "mbar", 100.0),
            ("1", "day", 86_400.0),
            ("1", "kcal", 4184.0),
            ("50", "%", 0.5),
        ] {
            let read = read_quantity(number, unit).map(|q| q.0).expect("it is a unit");
            assert!(
                (read - wanted).abs() <= 4.0 * f64::EPSILON * wanted,
                "{number} {unit}: {read}"
            );
        }
        // 550 ft lbf/s; 60 rpm is a turn a second
        let [hp, made] = ["hp", "ft*lbf/s"].map(|u| read_quantity("550", u).expect("a unit").0);
        assert!((hp / 550.0 - made).abs() < 1e-10 * made);
        let psi = read_quantity("1", "psi").expect("a unit").0;
        let made = read_quantity("1", "lbf/in^2").expect("a unit").0;
        assert!((psi - made).abs() < 1e-12 * made);
        assert_eq!(read_quantity("60", "rpm"), Some((2.0 * PI, Dimension::FREQUENCY)));
    }
    #[test]
    fn what_was_meant_is_never_another_magnitude() {
        for (said, wanted) in [
            ("seconds", "s"),
            ("meters", "m"),
            ("Kilometres", "km"),
            ("inches", "in"),
            ("degrees", "deg"),
            ("kOhm", "kohm"),
            ("Kg", "kg"),
            ("amps", "A"),
            ("kNm", "kN*m"),
            ("volts", "V"),
        ] {
            assert_eq!(meant(said), [wanted], "{said}");
        }
        for said in ["qHzz", "Xm", "XHz", "blubb", "xx", "w2"] {
            assert!(meant(said).is_empty(), "{said}: {:?}", meant(said));
        }
    }
}
