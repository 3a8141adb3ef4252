//! Numbers as people read them in a document: six digits, and an engineer's unit.

use expr::{Dimension, units};
use kernel::{Document, Quantity, show_quantity};
use lang::lower;

fn document_of(text: &str) -> Document {
    lower(text, &|_| None, None).document
}
fn read_as(x: f64, class: &str, written: &str, document: &Document) -> String {
    let dimension = Dimension::by_name(class).unwrap_or(Dimension::NONE);
    let shown = show_quantity(x, Quantity { dimension, class, written }, document);
    format!("{} {}", shown.text, shown.unit).trim().into()
}

#[test]
fn prefixes_go_by_thousands() {
    let d = document_of("");
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
        assert_eq!(read_as(x, class, "", &d), wanted);
    }
}
#[test]
fn a_limit_is_rounded_towards_where_the_way_began() {
    let document = document_of("");
    let number = Quantity { dimension: Dimension::NONE, class: "Real", written: "" };
    let short = |limit, from| lang::show_limit(limit, from, number, &document).0;
    assert_eq!(short(130.58, 90.0), "130.5");
    assert_eq!(short(130.58, 170.0), "130.6");
    assert_eq!(short(99.999_999_99, 50.0), "100", "known to the tolerance of rules");
    assert_eq!(short(-0.012_345, 0.0), "-0.01234");
    assert_eq!(short(70.0, 70.0), "70");
    assert_eq!(short(0.0, 5.0), "0");
}
#[test]
fn angles_are_read_in_degrees() {
    let d = document_of("unit mm");
    assert_eq!(read_as(std::f64::consts::FRAC_PI_4, "Angle", "", &d), "45 deg");
    assert_eq!(read_as(1.0, "Angle", "1 rad", &d), "57.2958 deg");
}
#[test]
fn what_is_written_is_read_in_its_unit() {
    let d = document_of("");
    assert_eq!(read_as(1000.0, "Resistance", "1000 ohm", &d), "1000 ohm");
    assert_eq!(read_as(7500.0, "Force", "10 kN", &d), "7.5 kN");
    assert_eq!(read_as(1e-9, "Force", "10 kN", &d), "1 nN");
    assert_eq!(read_as(10.0, "Voltage", "2 * 5", &d), "10 V");
    assert_eq!(read_as(0.05, "Real", "5%", &d), "5 %");
    assert_eq!(read_as(299_792_458.0, "Velocity", "", &d), "299792 km/s");
}
#[test]
fn lengths_are_in_the_unit_of_the_sheet() {
    let plain = document_of("");
    assert_eq!(read_as(121.666_666_67, "Length", "", &plain), "121.667");
    let mm = document_of("unit mm");
    assert_eq!(read_as(0.5, "Length", "", &mm), "0.5 mm");
    assert_eq!(read_as(1250.0, "Length", "", &mm), "1250 mm");
    assert_eq!(read_as(0.02, "Length", "", &mm), "20 um");
    assert_eq!(read_as(2e5, "Length", "", &mm), "200 m");
    assert_eq!(read_as(400.0, "Area", "", &mm), "400 mm^2");
    let metres = document_of("x: Length = 2 mm");
    assert_eq!(read_as(0.036, "Length", "", &metres), "36 mm");
    assert_eq!(read_as(2e-12, "Length", "", &metres), "2 pm");
    assert_eq!(read_as(0.000_05, "Volume", "", &metres), "50 cm^3");
    assert_eq!(read_as(0.0, "Area", "", &metres), "0 m^2");
    assert_eq!(read_as(5e-12, "Area", "", &metres), "0.000005 mm^2");
    assert_eq!(read_as(3.0, "Real", "", &metres), "3");
    let dm = document_of("unit dm");
    assert_eq!(read_as(300.0, "Length", "", &dm), "30 m");
    assert_eq!(read_as(-0.568_75, "Length", "", &dm), "-56.875 mm");
}
#[test]
fn what_is_shown_reads_back() {
    let d = document_of("unit mm");
    let quantity = Quantity { dimension: Dimension::CURRENT, class: "Current", written: "" };
    let shown = show_quantity(1.0 / 300.0, quantity, &d);
    assert_eq!((&*shown.text, &*shown.unit), ("3.33333", "mA"));
    let unit = units::unit(&shown.unit).expect("it is a unit");
    assert_eq!(unit.read(&shown.exact), Some(1.0 / 300.0));
}
