//! Quotients of the units that a text writes: gallons and minutes make gallons a minute, not cubic inches a minute.
//!
//! In: the units of a text. Out: by what it measures, each quotient of two of them that spares a reader powers: one of
//! the two is a unit of its own for what lengths, masses and times make only together, a litre, a bar, a horsepower.

use base::Name;
use expr::dimension::Dimension;
use expr::units;
use std::collections::BTreeMap;

/// Returns the quotients of a text's units, by what they measure, each list in the order of writing.
///
/// ```
/// use expr::Dimension;
/// use base::Name;
/// let made = kernel::quotients(&["gal", "min", "ft"].map(Name::new));
/// assert_eq!(made[&Dimension::VOLUME_FLOW], [Name::new("gal/min")]);
/// ```
pub fn quotients(written: &[Name]) -> BTreeMap<Dimension, Vec<Name>> {
    let mut made: BTreeMap<Dimension, Vec<Name>> = BTreeMap::new();
    let is_electric = written.iter().any(|unit| is_electric(unit));
    let is_word = |unit: &&Name| !unit.contains(['*', '/', '^']);
    let words = || written.iter().filter(is_word);
    for over in words() {
        for under in words().filter(|u| is_own(over) || is_own(u) || is_mileage(over, u)) {
            let spelling = Name::new(&format!("{over}/{under}"));
            let Some(unit) = units::unit(&spelling) else { continue };
            let [length, mass, ..] = unit.dimension.0;
            // powers of electricity are in watts; areas and volumes are told by the lengths of the sheet
            let is_of_heat = !is_electric && !over.ends_with("Wh");
            let is_in_watts = unit.dimension == Dimension::POWER && !is_of_heat;
            let is_mileage = is_mileage(over, under);
            let is_simple = factors(unit.dimension) < 3 && !is_mileage;
            if is_in_watts || (length, mass) == (0, 0) || is_simple {
                continue;
            }
            let known = made.entry(unit.dimension).or_default();
            let is_of_the_sheet = crate::quantity::is_of_the_sheet(unit.dimension) && !is_mileage;
            if !is_of_the_sheet && !known.contains(&spelling) {
                known.push(spelling);
            }
        }
    }
    made
}

/// Returns true for volts, amperes, watts and what else is of electricity.
pub(crate) fn is_electric(spelling: &str) -> bool {
    let Some(Dimension([_, _, _, current, ..])) = units::unit(spelling).map(|u| u.dimension) else {
        return false;
    };
    current != 0 || spelling.ends_with('W')
}

/// Returns true for a unit outside of SI for what lengths, masses and times make only together. Velocities are joined as
/// they are.
fn is_own(spelling: &str) -> bool {
    units::unit(spelling).is_some_and(|unit| {
        let Dimension([.., a, b, c, d]) = unit.dimension;
        let is_mechanical = [a, b, c, d] == [0; 4] && unit.dimension != Dimension::VELOCITY;
        is_mechanical && factors(unit.dimension) > 1 && !crate::quantity::is_of_si(spelling)
    })
}

/// Returns true for a way over a volume: how far it lasts, as of fuel.
fn is_mileage(over: &str, under: &str) -> bool {
    let is_volume = units::unit(under).is_some_and(|unit| unit.dimension == Dimension::VOLUME);
    matches!(over, "km" | "mi" | "nmi") && is_volume
}

/// Returns of how many factors a quantity is, at least: masses or forces, lengths and times, each as often as it counts.
fn factors(dimension: Dimension) -> u8 {
    let Dimension([length, mass, time, others @ ..]) = dimension;
    let count = |powers: [i8; 3]| powers.iter().map(|p| p.unsigned_abs()).sum::<u8>();
    let by_force = count([mass, length - mass, time + 2 * mass]);
    others.iter().map(|p| p.unsigned_abs()).sum::<u8>() + count([length, mass, time]).min(by_force)
}
