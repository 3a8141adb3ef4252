//! How values are put to people: a number of base units in, six digits and an engineer's unit out.
//!
//! All that people read of numbers (tables, explanations, refusals, texts with values in them) comes from here, and
//! can be typed back. The unit is the one that the value was written in, where it reads well; else the one in which the
//! text writes such quantities; else that of its class, with a prefix by steps of a thousand. Angles are in degrees.

use crate::{Document, Usual};
use base::Name;
use base::number::{shortest, significant};
use expr::dimension::Dimension;
use expr::units::{self, Unit};

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

/// A larger value does not read well in a unit in which the text writes others.
const MOST_READABLE: f64 = 1e6;
/// Below this whole numbers are written in full: every one of them is one of the computer's.
const LARGEST_COUNTED: f64 = 1e15;
/// Other numbers do not read well in the unit in which they were written.
const READABLE: std::ops::Range<f64> = 1e-3..MOST_READABLE;
/// A smaller number does not read well in a unit in which another one was written.
const LEAST_OF_ANOTHER: f64 = 0.1;

/// A smaller number does not read well in a quotient of the units that the text writes.
const LEAST_OF_QUOTIENT: f64 = 0.1;

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

impl Quantity<'_> {
    /// Returns the sort of quantity that a class tells beyond what it measures; empty for what its dimension says.
    ///
    /// What is of one sort is written in the same units: torques and moments, no energies.
    ///
    /// ```
    /// use kernel::Quantity;
    /// assert_eq!(Quantity::sort("Moment"), Quantity::sort("Torque"));
    /// assert_ne!(Quantity::sort("AngularVelocity"), Quantity::sort("Frequency"));
    /// ```
    pub fn sort(class: &str) -> &str {
        match class {
            "Moment" | "Torque" | "RotationalStiffness" => "Torque",
            "Angle"
            | "AngularVelocity"
            | "AngularAcceleration"
            | "MassFlow"
            | "Stress"
            | "ElasticModulus"
            | "SpecificWeight" => class,
            _ => "",
        }
    }
}

impl Shown {
    /// Returns the number and its unit.
    pub fn with_unit(&self) -> String {
        format!("{} {}", self.text, self.unit).trim_end().into()
    }
    /// Returns the same as it stands in a picture: with the signs `Ω` and `µ`.
    ///
    /// ```
    /// let shown = |unit: &str| kernel::Shown { text: "4.7".into(), unit: unit.into(), exact: String::new() };
    /// assert_eq!(shown("kohm").in_picture(), "4.7 kΩ");
    /// assert_eq!(shown("uA").in_picture(), "4.7 µA");
    /// assert_eq!(shown("turn/s").in_picture(), "4.7 turn/s");
    /// ```
    pub fn in_picture(&self) -> String {
        let unit = self.unit.replace("ohm", "Ω");
        let unit = match unit.strip_prefix('u') {
            Some(rest) if units::unit(&self.unit).is_some() => format!("µ{rest}"),
            _ => unit,
        };
        format!("{} {unit}", self.text).trim_end().into()
    }
}

/// A number as people read it.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Shown {
    /// The number in its unit, to six significant digits; a whole number without a unit to all of its digits.
    pub text: String,
    /// The unit, or nothing.
    pub unit: String,
    /// The number in the same unit with all its digits: what an editor begins with.
    pub exact: String,
}

/// Shows a number of base units.
///
/// A length without a unit anywhere is in the units of the sheet and has none; `unit mm` gives it one, and so does a
/// text that writes lengths in metres.
pub fn show_quantity(x: f64, quantity: Quantity<'_>, document: &Document) -> Shown {
    let spelling = spelling_for(x, quantity, document);
    let shown = in_unit(x, quantity.dimension, &spelling, document);
    // a whole number without a unit is counted: it keeps its digits
    let is_counted = spelling.is_empty() && shown.fract() == 0.0 && shown.abs() < LARGEST_COUNTED;
    let text = if is_counted { shortest(shown) } else { significant(shown, DIGITS) };
    // six digits tell many a number: 60 degrees, whose radians are 59.99999999999999
    let read = units::read_quantity(&text, &spelling);
    let is_told = read.is_some_and(|(si, of)| from_si(document, si, of) == x);
    let exact = if is_told { text.clone() } else { shortest(shown) };
    Shown { text, unit: spelling, exact }
}

/// Returns a number of base units in a unit; without one, as a bare number of it is written.
pub fn in_unit(x: f64, dimension: Dimension, spelling: &str, document: &Document) -> f64 {
    let unit = if spelling.is_empty() { None } else { units::unit(spelling) };
    let shown = unit.and_then(|u| u.show(to_si(document, x, dimension)));
    shown.unwrap_or_else(|| to_bare(document, x, dimension))
}

/// Chooses the unit for a number of base units.
pub fn spelling_for(x: f64, quantity: Quantity<'_>, document: &Document) -> String {
    let Quantity { dimension, class, written } = quantity;
    let size = |spelling: &str| in_unit(x, dimension, spelling, document).abs();
    let last = written.trim_end_matches([')', ']', ',', '}']).rsplit(char::is_whitespace).next();
    // `5%` is one word, and `1/min` is a unit
    let digits = |c: char| c.is_ascii_digit() || c == '.';
    let words = last.into_iter().flat_map(|word| [word, word.trim_start_matches(digits)]);
    let fits = |spelling: &&str| units::unit(spelling).is_some_and(|u| u.dimension == dimension);
    let text = written;
    let written = { words }.find(fits);
    if class == "Angle" {
        // a sum of several units, `52 deg + 30 arcmin`, reads in degrees
        let all = text.split(char::is_whitespace).map(|word| word.trim_start_matches(digits));
        let is_one = all.filter(fits).nth(1).is_none();
        let is_read = |s: &&str| x == 0.0 || READABLE.contains(&size(s));
        let is_of_degrees =
            |s: &&str| is_one && matches!(*s, "arcmin" | "arcsec" | "mas") && is_read(s);
        return written.filter(is_of_degrees).unwrap_or("deg").into();
    }
    let is_read = |s: &&str| {
        let size = size(s);
        let least = match size < LEAST_OF_ANOTHER && !is_written_as(text, size) {
            true => LEAST_OF_ANOTHER,
            false => READABLE.start,
        };
        x == 0.0 || (least..READABLE.end).contains(&size)
    };
    if let Some(spelling) = written.filter(is_read) {
        return spelling.into();
    }
    // what is written so is read so where no prefix belongs to the unit: `1.8e-5 mol/L`
    let is_as_written = |s: &&str| {
        s.contains(['*', '/']) && size(s) < READABLE.start && is_written_as(text, size(s))
    };
    if let Some(spelling) = written.filter(is_as_written) {
        return spelling.into();
    }
    // millions of light years are no easier to read as billions of terametres
    let other = spelling_of_text(x, quantity, document);
    match written {
        Some(spelling) if awkwardness(size(spelling)) <= awkwardness(size(&other)) => {
            spelling.into()
        }
        _ => other,
    }
}

/// Returns true for the size of a number that stands in what is written.
fn is_written_as(written: &str, size: f64) -> bool {
    let is_of_number = |c: char| c.is_ascii_digit() || c == '.' || c == 'e' || c == '-';
    let words = written.split(|c: char| !is_of_number(c));
    let mut numbers = words.filter_map(|word| word.parse::<f64>().ok());
    numbers.any(|number| base::number::close(number.abs(), size))
}

/// How many times a number is larger or smaller than one that is read easily.
fn awkwardness(size: f64) -> f64 {
    if size < 1.0 { 1.0 / size } else { (size / 1e3).max(1.0) }
}

/// Chooses the unit for a number of base units where that in which it was written says nothing.
fn spelling_of_text(x: f64, quantity: Quantity<'_>, document: &Document) -> String {
    let Quantity { dimension, class, written } = quantity;
    let size = |spelling: &str| in_unit(x, dimension, spelling, document).abs();
    if let Some(spelling) = usual(class, dimension, document, size) {
        return spelling;
    }
    let sort = || sort_in(document, class, dimension).unwrap_or_default();
    let is_made = dimension != Dimension::LENGTH && !is_bare(written);
    if let Some(quotients) = document.quotients.get(&dimension).filter(|_| is_made) {
        let readable = LEAST_OF_QUOTIENT..MOST_READABLE;
        let fits = |s: &&Name| size(s) == 0.0 || readable.contains(&size(s));
        if let Some(spelling) = quotients.iter().find(fits) {
            return spelling.to_string();
        }
    }
    if let Some(customary) = document.customary.as_ref().filter(|_| is_made)
        && let Some(spelling) = customary.spelling(dimension, sort() == "Torque", size)
    {
        return spelling;
    }
    if let Some(litres) = in_litres(class, dimension, document, size) {
        return litres.into();
    }
    if is_of_the_sheet(dimension) {
        return of_the_sheet(dimension, document, size);
    }
    match of_si(sort(), dimension) {
        Some(spelling) => prefixed(spelling, size),
        None => dimension.to_string(),
    }
}

/// Returns true for what is written in numbers alone, `5` or `[1, 2e3]`: these are in SI. Nothing is nothing anywhere.
fn is_bare(written: &str) -> bool {
    let words = written.split(|c: char| !c.is_alphanumeric() && c != '.');
    let numbers = words.filter(|word| !word.is_empty());
    let numbers: Result<Vec<f64>, _> =
        numbers.map(|word| word.trim_end_matches(['e', 'E']).parse()).collect();
    numbers.is_ok_and(|all| all.iter().any(|&x| x != 0.0))
}

/// Returns the unit of SI in which a class of quantities is shown; none for plain numbers, lengths and what has no name.
///
/// ```
/// use expr::Dimension;
/// use kernel::quantity::of_si;
/// assert_eq!(of_si("MassFlow", Dimension::MASS_FLOW), Some("kg/s"));
/// assert_eq!(of_si("Damping", Dimension::DAMPING), Some("N*s/m"));
/// ```
pub fn of_si(class: &str, dimension: Dimension) -> Option<&'static str> {
    match class {
        "MassFlow" => Some("kg/s"),
        "Torque" | "Moment" | "RotationalStiffness" => Some("N*m"),
        "AngularVelocity" => Some("rad/s"),
        "AngularAcceleration" => Some("rad/s^2"),
        "SpecificWeight" => Some("N/m^3"),
        _ => units::preferred(dimension),
    }
}

/// The unit in which the text writes such quantities, where it is none that a prefix of a thousand makes of that of SI:
/// of several the first in which the number is not below one. A sheet's own unit of length comes first.
fn usual(
    class: &str,
    dimension: Dimension,
    document: &Document,
    size: impl Fn(&str) -> f64,
) -> Option<String> {
    if dimension == Dimension::LENGTH && document.unit.is_some() {
        return None;
    }
    let (units, least) = usual_of(class, dimension, document)?;
    let sized: Vec<(f64, &Name)> = units.into_iter().map(|unit| (size(unit), unit)).collect();
    let is_readable = |x: f64| x == 0.0 && least < 1.0 || (least..MOST_READABLE).contains(&x);
    let smallest = || sized.iter().max_by(|a, b| a.0.total_cmp(&b.0));
    let best = sized.iter().find(|(x, _)| *x >= 1.0).or_else(smallest);
    best.filter(|(x, _)| is_readable(*x)).map(|(_, unit)| unit.to_string())
}

/// The units in which the text writes the sort of a class, and the least number for which they are used; nothing where
/// it writes some of SI.
///
/// What is written without a class counts where the units themselves tell the sort; what a class is written in is its
/// own. A quantity without a class is shown in the units of the one sort that is written.
fn usual_of<'d>(
    class: &str,
    dimension: Dimension,
    document: &'d Document,
) -> Option<(Vec<&'d Name>, f64)> {
    let sort = sort_in(document, class, dimension)?;
    let is_told_by_unit = !matches!(sort, "Stress" | "ElasticModulus" | "SpecificWeight");
    let counts = |of: Option<&str>| of.map_or(is_told_by_unit, |of| of == sort);
    let usual: Vec<(Option<&str>, &Usual)> =
        written(document, dimension).filter(|(of, _)| counts(*of)).collect();
    if usual.is_empty() || usual.iter().any(|(_, usual)| usual.units.is_empty()) {
        return None;
    }
    let least = usual.iter().map(|(_, usual)| usual.least).fold(f64::INFINITY, f64::min);
    let units = usual.into_iter().flat_map(|(of, usual)| {
        let is_own = class.is_empty() || of.is_some();
        usual.units.iter().filter(move |unit| is_own || suits(unit, sort, dimension))
    });
    Some((units.collect(), least))
}

/// The units in which the text writes quantities of a dimension, by the sort of their class where they have one.
fn written(
    document: &Document,
    dimension: Dimension,
) -> impl Iterator<Item = (Option<&str>, &Usual)> {
    let written = document.usual.range((dimension, None)..);
    let written = written.take_while(move |((d, _), _)| *d == dimension);
    written.map(|((_, sort), usual)| (sort.as_deref(), usual))
}

/// The sort of a class; without one the sort of its dimension that the text writes, and nothing where there are several.
fn sort_in<'a>(document: &'a Document, class: &'a str, dimension: Dimension) -> Option<&'a str> {
    if !class.is_empty() {
        return Some(Quantity::sort(class));
    }
    let mut sorts = written(document, dimension).filter_map(|(sort, _)| sort);
    let one = sorts.next().unwrap_or_default();
    sorts.next().is_none().then_some(one)
}

/// Returns true for a unit in which people write a sort of quantity, of those that share its dimension: newton metres are
/// no joules, turns no hertz, kilograms a second no damping, a specific weight is no gradient.
fn suits(unit: &str, sort: &str, dimension: Dimension) -> bool {
    match dimension {
        Dimension::ENERGY => unit.contains('*') == (sort == "Torque"),
        Dimension::FREQUENCY | Dimension::ANGULAR_ACCELERATION => match sort {
            "" => !is_of_turning(unit),
            _ => !unit.ends_with("Hz"),
        },
        Dimension::DAMPING => unit.contains('*') != (sort == "MassFlow"),
        _ => true,
    }
}

/// Returns the class that is shown in another unit of SI than what else has its dimension; none for most.
///
/// ```
/// use expr::Dimension;
/// use kernel::quantity::sharing;
/// assert_eq!(sharing(Dimension::ENERGY), Some("Torque"));
/// assert_eq!(sharing(Dimension::FORCE), None);
/// ```
pub fn sharing(dimension: Dimension) -> Option<&'static str> {
    match dimension {
        Dimension::FREQUENCY => Some("AngularVelocity"),
        Dimension::ANGULAR_ACCELERATION => Some("AngularAcceleration"),
        Dimension::ENERGY => Some("Torque"),
        Dimension::DAMPING => Some("MassFlow"),
        Dimension::PRESSURE_GRADIENT => Some("SpecificWeight"),
        _ => None,
    }
}

/// Returns true for turns, radians or degrees in a time.
fn is_of_turning(unit: &str) -> bool {
    let angle = unit.split('/').next().unwrap_or_default();
    let is_angle = |u: Unit| u.dimension.is_none();
    unit.starts_with("rpm") || angle != "1" && units::unit(angle).is_some_and(is_angle)
}

/// Returns true for a unit that a prefix of a thousand makes of the one of SI in which a quantity is shown.
///
/// ```
/// use kernel::quantity::is_of_si;
/// assert!(is_of_si("kN") && is_of_si("mm") && is_of_si("m/s"));
/// assert!(is_of_si("kN*m") && is_of_si("kg/s") && is_of_si("rad/s^2") && is_of_si("kN/m^3"));
/// assert!(!is_of_si("ft") && !is_of_si("day") && !is_of_si("N/mm") && !is_of_si("L"));
/// ```
pub fn is_of_si(spelling: &str) -> bool {
    let Some(unit) = units::unit(spelling) else { return false };
    let stem = match unit.dimension {
        Dimension::LENGTH => "m",
        Dimension::MASS => "g",
        other => units::preferred(other).unwrap_or_default(),
    };
    let told = sharing(unit.dimension).and_then(|class| of_si(class, unit.dimension));
    let is_stem = |rest: &str| rest == stem || told == Some(rest);
    PREFIXES.iter().any(|(prefix, ..)| spelling.strip_prefix(prefix).is_some_and(is_stem))
}

/// The unit of a plain number, a length, an area, …: that of the sheet, where it has one and the number
/// reads well in it.
fn of_the_sheet(
    dimension: Dimension,
    document: &Document,
    size: impl Fn(&str) -> f64 + Copy,
) -> String {
    let power = dimension.0[0];
    let Some(own) = document.unit.as_deref().filter(|_| power != 0) else {
        return match (document.writes_lengths, power) {
            (false, _) | (true, 0) => String::new(),
            (true, 1) => prefixed("m", size),
            (true, _) => raised(power, "", size),
        };
    };
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
    // as it is shown, so that 0.9999999 is one
    let shown = significant(size(own), DIGITS).parse().unwrap_or_default();
    if shown == 0.0 || (least..1e5).contains(&shown) { own.into() } else { prefixed("m", size) }
}

/// Returns litres for what fills bottles and tanks: volumes and their flows from one litre up to a tenth of a cubic metre.
/// Nobody counts a section modulus in them.
fn in_litres(
    class: &str,
    dimension: Dimension,
    document: &Document,
    size: impl Fn(&str) -> f64,
) -> Option<&'static str> {
    let (litres, cubic) = match dimension {
        Dimension::VOLUME if document.unit.is_none() && document.writes_lengths => ("L", "m^3"),
        Dimension::VOLUME_FLOW => ("L/s", "m^3/s"),
        _ => return None,
    };
    let is_of_volumes = matches!(class, "" | "Volume" | "VolumeFlow");
    (is_of_volumes && size(litres) >= 1.0 && size(cubic) < 0.1).then_some(litres)
}

/// Returns the power of the largest unit of length with which a number is not below a tenth, and `rest` behind it.
fn raised(power: i8, rest: &str, size: impl Fn(&str) -> f64) -> String {
    let spelling = |unit: &str| format!("{unit}^{power}{rest}");
    if size(&spelling("m")) == 0.0 || power < 0 {
        return spelling("m");
    }
    let reads = |spelling: &String| size(spelling) >= 0.1;
    let mut spellings = ["km", "m", "cm", "mm"].map(spelling).into_iter();
    spellings.find(reads).unwrap_or_else(|| spelling("mm"))
}

/// Returns a unit of SI with the largest prefix with which the number is not below one.
fn prefixed(spelling: &str, size: impl Fn(&str) -> f64) -> String {
    // the kilogram has its prefix already, squares have none, and nobody counts in kiloseconds, megametres or
    // megametres a second
    let stem = if spelling == "kg" { "g" } else { spelling };
    let first = stem.split(['*', '/']).next().unwrap_or_default();
    let highest = match stem {
        "s" => 0,
        "g" | "m/s" => 3,
        _ => i8::MAX,
    };
    // a flow, a diffusivity: nobody counts in square kilometres a second
    if let Some(per) = ["m^3/s", "m^2/s"].into_iter().find(|s| *s == spelling) {
        let (power, rest) = (per.as_bytes()[2] - b'0', &per[3..]);
        return if size(per) < 1.0 { raised(power as i8, rest, size) } else { per.into() };
    }
    if size(spelling) == 0.0
        || first.contains('^')
        || matches!(first, "K" | "rad")
        || (first == "kg" && stem != "g")
    {
        return spelling.into();
    }
    if is_read_bare(stem, size(spelling)) {
        return spelling.into();
    }
    let Some(base) = units::unit(stem) else { return spelling.into() };
    let is_known = |unit: Unit, by: i8| {
        (unit.dimension, unit.mantissa) == (base.dimension, 1.0)
            && unit.exponent == base.exponent + by
    };
    let rung = |&(prefix, by, _): &(&str, i8, f64)| {
        let spelling = format!("{prefix}{stem}");
        let is_used = by <= highest && spelling != "Mm";
        units::unit(&spelling).filter(|u| is_used && is_known(*u, by)).map(|_| spelling)
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

/// Returns true where a number of a product or quotient of units reads better as it is than with a prefix.
///
/// Prefixes belong to units of one symbol. 0.215 W/(m² K), 0.072 N/m and 0.2 m/s² are written so; a small one is kept for
/// what has no power and one operator (5 mm/s, 1 mPa s, 8.85 pF/m), a large one for all but motion (4.2 kJ/(kg K)).
fn is_read_bare(unit: &str, size: f64) -> bool {
    let operators = unit.matches(['*', '/']).count();
    // expansions are told in micrometres by metre and kelvin
    if operators == 0 || unit == "m/m/K" {
        return false;
    }
    let has_power = unit.contains('^');
    let is_motion = has_power && unit.starts_with("m/");
    if is_motion || size < 1.0 && operators > 1 {
        return true;
    }
    let least = if has_power { 1e-3 } else { 1e-2 };
    // as it is shown, so that 0.9999999 is one
    let shown = significant(size, DIGITS).parse::<f64>().unwrap_or_default();
    (least..1.0).contains(&shown)
}

/// Returns a number of SI in the document's base units. Powers of ten are shifted, not multiplied.
pub fn from_si(document: &Document, si: f64, dimension: Dimension) -> f64 {
    shifted(document, si, i32::from(dimension.0[0])) * document.scale.factor(dimension)
}

/// Returns a number of the document's base units in SI.
pub fn to_si(document: &Document, x: f64, dimension: Dimension) -> f64 {
    shifted(document, x / document.scale.factor(dimension), -i32::from(dimension.0[0]))
}

/// Returns a number that was written without a unit in base units.
///
/// A bare length, area or volume counts in the units of the sheet; whatever else, in those of SI.
pub fn from_bare(document: &Document, x: f64, dimension: Dimension) -> f64 {
    match is_of_the_sheet(dimension) {
        true => x * document.scale.factor(dimension),
        false => from_si(document, x, dimension),
    }
}

/// Returns what to write for a number without its unit: what [`from_bare`] reads.
pub fn to_bare(document: &Document, x: f64, dimension: Dimension) -> f64 {
    match is_of_the_sheet(dimension) {
        true => x / document.scale.factor(dimension),
        false => to_si(document, x, dimension),
    }
}

/// Returns true for plain numbers, lengths, areas, volumes.
pub fn is_of_the_sheet(dimension: Dimension) -> bool {
    dimension.0[1..].iter().all(|&exponent| exponent == 0)
}

/// Scales by the document's units of length in a metre, to a power.
fn shifted(document: &Document, x: f64, power: i32) -> f64 {
    let scale = document.units_per_metre;
    if power == 0 || scale == 1.0 || x == 0.0 {
        return x;
    }
    let tens = [10.0, 100.0, 1000.0, 1e6, 1e9].iter().position(|t| *t == scale);
    let Some(exponent) = tens.map(|i| [1, 2, 3, 6, 9][i]) else {
        return x * base::number::pow(scale, f64::from(power));
    };
    format!("{x:e}")
        .split_once('e')
        .and_then(|(digits, own)| {
            let own: i32 = own.parse().ok()?;
            format!("{digits}e{}", own + exponent * power).parse().ok()
        })
        .unwrap_or(x * base::number::pow(scale, f64::from(power)))
}
