//! Results in the units of what they are made of.

use expr::{Dimension, units};
use kernel::Customary;

fn shown(text: &[&str], si: f64, dimension: Dimension, is_torque: bool) -> Option<String> {
    let customary = Customary::of(text.iter().copied())?;
    let size = |s: &str| units::unit(s).and_then(|u| u.show(si)).unwrap_or(f64::NAN);
    customary.spelling(dimension, is_torque, size)
}

#[test]
fn products_are_in_the_units_of_their_factors() {
    let foot_pound = 1.355_817_948_331_400_4;
    for (text, si, dimension, is_torque, wanted) in [
        (&["lbf", "ft"][..], 1500.0 * foot_pound, Dimension::ENERGY, true, "lbf*ft"),
        (&["lbf", "ft"], 1500.0 * foot_pound, Dimension::ENERGY, false, "ft*lbf"),
        (&["kip/ft", "ft"], 144e3 * foot_pound, Dimension::ENERGY, true, "kip*ft"),
        (&["lbf", "in"], 1e6, Dimension::PRESSURE, false, "psi"),
        (&["kip", "ft", "in"], 1e8, Dimension::PRESSURE, false, "ksi"),
        (&["ksi", "in"], 1e6, Dimension::FORCE, false, "kip"),
        (&["psi"], 2e-3, Dimension::AREA, false, "in^2"),
        (&["in", "ft"], 1.2, Dimension::AREA, false, "ft^2"),
        (&["in", "ft"], 1e-5, Dimension::SECOND_MOMENT_OF_AREA, false, "in^4"),
        (&["lb", "ft"], 1000.0, Dimension::DENSITY, false, "lb/ft^3"),
        (&["lbf", "ft", "s"], 7e3, Dimension::POWER, false, "ft*lbf/s"),
        (&["mi", "h"], 30.0, Dimension::VELOCITY, false, "mi/h"),
        (&["lbf/in"], 100.0, Dimension::FORCE, false, "lbf"),
        (&["dyn", "cm"], 1e-5, Dimension::ENERGY, false, "cm*dyn"),
        (&["dyn", "cm"], 1.0, Dimension::PRESSURE, false, "dyn/cm^2"),
    ] {
        let found = shown(text, si, dimension, is_torque);
        assert_eq!(found.as_deref(), Some(wanted), "{text:?}");
    }
    assert_eq!(shown(&["lbf", "ft", "mm"], 1.0, Dimension::AREA, false), None);
    let with_volts = ["lbf", "ft", "V", "A"];
    let torque = shown(&with_volts, 10.0, Dimension::ENERGY, true);
    assert_eq!(torque.as_deref(), Some("lbf*ft"), "a volt is everybody's");
    assert_eq!(shown(&with_volts, 24.0, Dimension::POWER, false), None, "amperes make watts");
    assert_eq!(shown(&["lbf"], 1.0, Dimension::AREA, false), None, "no length is written");
    assert_eq!(shown(&["BTU", "ft", "h"], 1.0, Dimension::POWER, false), None, "heat is no work");
    assert_eq!(shown(&["ft"], 1.0, Dimension::TEMPERATURE, false), None);
}
