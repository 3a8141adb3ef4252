//! Results in the units of what they are made of: pounds and feet make pound-feet, not newton metres.
//!
//! In: the units that a text writes, where all that speak of lengths and masses are of one system that is not that of
//! SI. Out: for what it measures without writing any unit of that, the unit that those make. Heat is counted apart: a
//! text with BTU has its powers in none of foot-pounds an hour.

use base::Name;
use expr::dimension::Dimension;
use expr::units;

/// The units of a text that counts in inches, feet and pounds, or in dynes and centimetres.
#[derive(Clone, PartialEq, Debug)]
pub struct Customary {
    forces: Vec<&'static str>,
    masses: Vec<&'static str>,
    lengths: Vec<&'static str>,
    time: Name,
    /// True if it writes volts, amperes or watts: then its powers and energies are in watts and joules.
    is_electric: bool,
}

/// A unit of a system, with the units of force, mass and length that it is made of; empty for none.
struct Factor {
    spelling: &'static str,
    force: &'static str,
    mass: &'static str,
    length: &'static str,
    /// True if nobody writes it who counts in SI.
    tells: bool,
}

const fn factor(
    spelling: &'static str,
    [force, mass, length]: [&'static str; 3],
    tells: bool,
) -> Factor {
    Factor { spelling, force, mass, length, tells }
}

/// A system: its units, and its force and mass where a text writes none.
struct System {
    factors: &'static [Factor],
    force: &'static str,
    mass: &'static str,
}

const SYSTEMS: [System; 2] = [
    System {
        factors: &[
            factor("in", ["", "", "in"], true),
            factor("inch", ["", "", "in"], true),
            factor("ft", ["", "", "ft"], true),
            factor("yd", ["", "", "yd"], true),
            factor("mi", ["", "", "mi"], true),
            factor("acre", ["", "", ""], true),
            factor("gal", ["", "", ""], true),
            factor("mph", ["", "", ""], true),
            factor("lb", ["", "lb", ""], true),
            factor("oz", ["", "oz", ""], true),
            factor("slug", ["", "slug", ""], true),
            factor("lbf", ["lbf", "", ""], true),
            factor("kip", ["kip", "", ""], true),
            factor("psi", ["lbf", "", "in"], true),
            factor("ksi", ["kip", "", "in"], true),
            factor("hp", ["", "", ""], true),
        ],
        force: "lbf",
        mass: "lb",
    },
    System {
        factors: &[
            factor("dyn", ["dyn", "", ""], true),
            factor("erg", ["dyn", "", "cm"], true),
            factor("cm", ["", "", "cm"], false),
            factor("g", ["", "g", ""], false),
        ],
        force: "dyn",
        mass: "g",
    },
];

impl Customary {
    /// Returns the system of a text that writes these units; nothing for one of SI, or of several.
    ///
    /// ```
    /// use kernel::Customary;
    /// assert!(Customary::of(["kip/ft", "ft", "s"].into_iter()).is_some());
    /// assert_eq!(Customary::of(["ft", "kN"].into_iter()), None);
    /// assert_eq!(Customary::of(["cm", "g"].into_iter()), None);
    /// ```
    pub fn of<'a>(written: impl Iterator<Item = &'a str>) -> Option<Self> {
        let factors = |unit: &'a str| {
            unit.split(['*', '/']).map(|f| f.split('^').next().unwrap_or(f)).filter(|f| *f != "1")
        };
        let words: Vec<&str> = written.flat_map(factors).collect();
        SYSTEMS.iter().find_map(|system| Self::within(system, &words))
    }

    fn within(system: &System, words: &[&str]) -> Option<Self> {
        let mut found = Self {
            forces: Vec::new(),
            masses: Vec::new(),
            lengths: Vec::new(),
            time: Name::new("s"),
            is_electric: false,
        };
        let mut tells = false;
        let mut times: Vec<&str> = Vec::new();
        for word in words {
            let Some(factor) = system.factors.iter().find(|f| f.spelling == *word) else {
                let dimension = units::unit(word)?.dimension;
                let Dimension([length, mass, ..]) = dimension;
                // volts, amperes and watts are everybody's
                let is_electric = crate::composed::is_electric(word);
                found.is_electric |= is_electric;
                if !is_electric && (length != 0 || mass != 0) {
                    return None;
                }
                if dimension == Dimension::TIME && !times.contains(word) {
                    times.push(word);
                }
                continue;
            };
            tells |= factor.tells;
            for (known, unit) in [
                (&mut found.forces, factor.force),
                (&mut found.masses, factor.mass),
                (&mut found.lengths, factor.length),
            ] {
                if !unit.is_empty() && !known.contains(&unit) {
                    known.push(unit);
                }
            }
        }
        if let [time] = times.as_slice() {
            found.time = Name::new(time);
        }
        if found.forces.is_empty() {
            found.forces.push(system.force);
        }
        if found.masses.is_empty() {
            found.masses.push(system.mass);
        }
        tells.then_some(found)
    }

    /// Returns the unit that these make for a quantity: of several the largest in which it is not below one, else the
    /// smallest. Nothing where they make none.
    ///
    /// Forces, masses, lengths and times are combined in the fewest factors that do it: a momentum is in pounds times
    /// seconds, a density in pounds in a cubic foot.
    pub fn spelling(
        &self,
        dimension: Dimension,
        is_torque: bool,
        size: impl Fn(&str) -> f64,
    ) -> Option<String> {
        let Dimension([length, mass, time, others @ ..]) = dimension;
        let is_energy = matches!(dimension, Dimension::ENERGY | Dimension::POWER) && !is_torque;
        let is_other = others.iter().any(|&power| power != 0) || length == 0 && mass == 0;
        if is_other || self.is_electric && is_energy {
            return None;
        }
        let cost = |powers: [i8; 3]| powers.iter().map(|p| p.unsigned_abs()).sum::<u8>();
        let [by_mass, by_force] = [[mass, length, time], [mass, length - mass, time + 2 * mass]];
        let (heavy, [power, length, time]) = match cost(by_force) < cost(by_mass) {
            true => (&self.forces, by_force),
            false => (&self.masses, by_mass),
        };
        if length != 0 && self.lengths.is_empty() {
            return None;
        }
        let none = [""];
        let heavy = if power == 0 { &none[..] } else { heavy };
        let lengths = match dimension {
            _ if length == 0 => &none[..],
            // a stress is in psi or ksi wherever inches are written
            Dimension::PRESSURE if self.lengths.contains(&"in") => &["in"],
            _ => &self.lengths,
        };
        let spell = |heavy: &str, long: &str| {
            let mut factors = vec![(heavy, power), (long, length), (self.time.as_str(), time)];
            // an energy is told from a torque by the order of its factors; so is a power
            if is_energy {
                factors.swap(0, 1);
            }
            joined(&factors)
        };
        let pairs = heavy.iter().flat_map(|h| lengths.iter().map(|l| spell(h, l)));
        let mut all: Vec<(f64, String)> = pairs.map(|s| (size(&s), s)).collect();
        all.sort_by(|a, b| a.0.total_cmp(&b.0));
        let largest = all.iter().position(|(x, _)| *x >= 1.0).unwrap_or(all.len() - 1);
        Some(all.swap_remove(largest).1)
    }
}

/// Joins factors to a unit, those with a positive power first; pounds in a square inch have a word of their own.
fn joined(factors: &[(&str, i8)]) -> String {
    let spelled = |(unit, power): (&str, i8)| match power {
        1 => unit.to_string(),
        _ => format!("{unit}^{power}"),
    };
    let above = factors.iter().filter(|(_, power)| *power > 0).map(|f| spelled(*f));
    let above: Vec<String> = above.collect();
    let below = factors.iter().filter(|(_, power)| *power < 0);
    let below: String =
        below.map(|&(unit, power)| format!("/{}", spelled((unit, -power)))).collect();
    let above = if above.is_empty() { "1".into() } else { above.join("*") };
    match format!("{above}{below}").as_str() {
        "lbf/in^2" => "psi".into(),
        "kip/in^2" => "ksi".into(),
        other => other.into(),
    }
}
