//! The scale of a text, and whether its lengths have a unit.

use base::number::shortest;
use expr::dimension::Dimension;
use kernel::Scale;

fn scale(text: &str) -> Scale {
    lang::lower(text, &|_| None, None).document.scale
}

/// Whether the lengths of a text have a unit.
fn writes(text: &str) -> bool {
    lang::lower(text, &|_| None, None).document.writes_lengths
}

#[test]
fn everyday_numbers_stay_in_si() {
    assert_eq!(scale("x: Length = 3 m\ny: Resistance = 4.7 kohm\n"), Scale::default());
    assert_eq!(scale("x: Real = 1e-30\n"), Scale::default());
}

#[test]
fn lengths_have_a_unit_where_a_velocity_has() {
    assert!(writes("v: Velocity = 100 km/h\nd: Length = v^2 / (2 * 8 m/s^2)\n"));
    assert!(writes("rho: Density = 1000 kg/m^3\n"));
    assert!(writes("p: Pressure = 2 bar\n"));
    assert!(!writes("rho: Density = 1000 kg/m^3\np: Point = (10, 20.5)\n"));
    assert!(!writes("v: Velocity = 3 m/s\nd: Length = 20\n"));
    assert!(!writes("f: Force = 5 N\nx: Length = 20\n"));
    assert!(!writes("unit mm\nv: Velocity = 100 km/h\n"));
}

#[test]
fn bare_lengths_in_bodies_arguments_and_parameters_have_no_unit() {
    let writes = |text: &str| writes(&format!("v: Velocity = 3 m/s\n{text}\n"));
    for bare in [
        "c: Circle { radius = 20 }",
        "c: Circle\nc.radius = -20",
        "p = Point(10, 20)",
        "c: Circle = Circle(radius: 20)",
        "program P(r: Length = 40) { c = Circle(Point(0, 0), r) }",
        "radii: List of 2 Length = [10, 20]",
    ] {
        assert!(!writes(bare), "{bare}");
    }
    for other in [
        "c: Circle { radius = 0 }",
        "class Wheel { weight: Mass }\nw: Wheel { weight = 20 }\nu: Wheel = Wheel(weight: 3)",
        "x: Real = max(2, 3)",
        "t: Text = (2 / 3).text(2)",
        "program P(n: Integer = 4) { }",
    ] {
        assert!(writes(other), "{other}");
    }
}

#[test]
fn checks_and_tolerances_say_nothing_of_the_scale() {
    let text = "x: Length = 3 m\ncheck \"c\" { expect x = 3e12 pm within 1 pm }\n";
    assert_eq!(scale(text), Scale::default());
}

#[test]
fn small_numbers_are_near_one_in_their_scale() {
    // a photon: h, c and 500 nm
    let scale = scale("h: Real = 6.6e-34 J*s\nc: Velocity = 3e8 m/s\nx: Length = 500 nm\n");
    for (x, d) in [(5e-7, Dimension::LENGTH), (3e8, Dimension::VELOCITY)] {
        let stored = x * scale.factor(d);
        assert!((0.25..4.0).contains(&stored), "{} {}", shortest(stored), d);
    }
}

#[test]
fn however_small_a_number_is_its_units_have_a_size() {
    for text in ["m: Mass = 1e-300 kg\n", "m: Mass = 1e300 kg\nl: Length = 1e-300 m\n"] {
        let factor = scale(text).factor(Dimension::FORCE);
        assert!(factor.is_normal(), "{factor} for {text}");
    }
}

#[test]
fn lengths_of_a_sheet_are_not_scaled() {
    assert_eq!(scale("unit mm\nx: Length = 3 um\nq: Charge = 2 fC\n").0[0], 0);
    assert_eq!(scale("q: Charge = 2 fC\n").0[0], 0);
}
