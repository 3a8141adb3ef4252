//! Texts of documents of any size, for the table.

/// A grid of `k` times `k` nodes, one ohm between neighbours, one ampere from corner to corner.
pub fn resistor_grid(k: usize) -> String {
    let (nodes, links) = (k * k, k * (k - 1));
    format!(
        "use circuits
class Ohm is Resistor {{ resistance = 1 ohm }}
nodes: List of {nodes} Node
across: List of {links} Ohm
down: List of {links} Ohm
source: CurrentSource {{ source = 1 A }}
ground: Ground
for i in 0..{last} {{
    for j in 0..{before} {{
        merge across[{before1} * i + j].a.node = nodes[{k} * i + j]
        merge across[{before1} * i + j].b.node = nodes[{k} * i + j + 1]
        merge down[{before1} * i + j].a.node = nodes[{k} * j + i]
        merge down[{before1} * i + j].b.node = nodes[{k} * j + i + {k}]
    }}
}}
merge source.b.node = nodes[0]
merge source.a.node = ground.lead.node = nodes[{end}]
",
        last = k - 1,
        before = k - 2,
        before1 = k - 1,
        end = nodes - 1,
    )
}

/// A Warren truss of `n` bays of 3 m, 10 kN at every inner joint below.
pub fn warren_truss(n: usize) -> String {
    let inner = n - 1;
    let before = n - 2;
    format!(
        "use trusses
class LoadedJoint is Joint {{ load = 10 kN }}
left: Joint
below: List of {inner} LoadedJoint
right: Joint
above: List of {n} Joint
lower: List of {n} Bar
upper: List of {inner} Bar
rising, falling: List of {n} Bar
pin: PinnedSupport
roller: RollerSupport
left.at = (0, 0)
right.at = ({span}, 0)
for i in 0..{before} {{ below[i].at = (3 * i + 3, 0) }}
for i in 0..{inner} {{ above[i].at = (3 * i + 1.5, 2.598076211353316) }}
merge pin.joint = left = lower[0].a.joint = rising[0].a.joint
merge roller.joint = right = lower[{inner}].b.joint = falling[{inner}].b.joint
for i in 0..{before} {{
    merge below[i] = lower[i].b.joint = lower[i + 1].a.joint = falling[i].b.joint = rising[i + 1].a.joint
    merge upper[i].a.joint = above[i]
    merge upper[i].b.joint = above[i + 1]
}}
for i in 0..{inner} {{ merge above[i] = rising[i].b.joint = falling[i].a.joint }}
",
        span = 3 * n,
    )
}

/// A truss of `n` square bays of 3 m with a post and both diagonals in each, 10 kN at every joint below:
/// its bars share what they carry by how stiff they are.
pub fn braced_truss(n: usize) -> String {
    let (joints, before) = (n + 1, n - 1);
    format!(
        "use trusses
class LoadedJoint is Joint {{ load = 10 kN }}
below: List of {joints} LoadedJoint
above: List of {joints} Joint
lower, upper, rising, falling: List of {n} Bar
posts: List of {joints} Bar
pin: PinnedSupport
roller: RollerSupport
for i in 0..{n} {{
    below[i].at = (3 * i, 0)
    above[i].at = (3 * i, 3)
    merge below[i] = posts[i].a.joint
    merge above[i] = posts[i].b.joint
}}
for i in 0..{before} {{
    merge below[i] = lower[i].a.joint = rising[i].a.joint
    merge below[i + 1] = lower[i].b.joint = falling[i].b.joint
    merge above[i] = upper[i].a.joint = falling[i].a.joint
    merge above[i + 1] = upper[i].b.joint = rising[i].b.joint
}}
merge pin.joint = below[0]
merge roller.joint = below[{n}]
"
    )
}

const SCALED: &str = "class Scaled {
    k, c, a: Real
    b: Real
    constraint scaled: b = k * a + c
}
k: Real = 1.0000001
c: Real = 0.5
";

/// `n` rows `b = k*a + c` with one `k` and one `c`, each of its own `a`.
pub fn projection(n: usize) -> String {
    let last = n - 1;
    scaled(n) + &format!("for i in 0..{last} {{ rows[i].a = 0.25 * i }}\n")
}

/// `n` rows `b = k*a + c` with one `k` and one `c`, each `a` the `b` of the row before.
pub fn chain(n: usize) -> String {
    let last = n - 1;
    let joined = format!("for i in 1..{last} {{ merge rows[i].a = rows[i - 1].b }}\n");
    scaled(n) + "rows[0].a = 1\n" + &joined
}

/// A `for` makes a hundred thousand members at most, so that each merge has its own.
fn scaled(n: usize) -> String {
    let last = n - 1;
    format!(
        "{SCALED}rows: List of {n} Scaled
for i in 0..{last} {{ merge rows[i].k = k }}
for i in 0..{last} {{ merge rows[i].c = c }}
"
    )
}

/// `n` four-bar linkages, each with its own crank angle.
pub fn linkages(n: usize) -> String {
    format!(
        "use geometry
class FourBar {{
    left: Point = (0, 0)
    right: Point = (12, 0)
    tip: Point = (5, 8.7)
    joint: Point = (15, 9.5)
    ground, arm: Line
    merge ground.p1 = arm.p1 = left
    merge ground.p2 = right
    merge arm.p2 = tip
    anchor left
    anchor right
    crank, coupler, rocker: Distance
    crank.value = 10
    coupler.value = 10
    rocker.value = 10
    merge crank.from = left
    merge crank.to = coupler.from = tip
    merge coupler.to = rocker.from = joint
    merge rocker.to = right
    turn: AngleBetween
    turn.value = 60 deg
    merge turn.from = ground
    merge turn.to = arm
}}
linkages: List of {n} FourBar
"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::opened::Opened;
    use eval::checker::check_state;

    fn solved(text: &str) -> (Opened, kernel::Values) {
        let opened = Opened::new(text).expect("the document has no errors");
        let (_, values, report) = opened.solve();
        assert!(report.unmet.is_empty(), "{} rules do not hold", report.unmet.len());
        (opened, values)
    }
    fn value(opened: &Opened, values: &kernel::Values, path: &str) -> f64 {
        values.numbers[opened.slots(path)[0]]
    }

    /// Displacements of thousands of kilometres, pulls of a giganewton: to their own rounding all is in
    /// balance, and nothing that is off by more passes. **Source:** virtual work.
    #[test]
    fn trusses_of_any_length_are_in_balance() {
        for (n, sag) in [(10, -0.056_875), (100, -521.312_5), (1000, -5_208_381.25)] {
            let (opened, mut values) = solved(&warren_truss(n));
            let middle = value(&opened, &values, &format!("below.{}.uy", n / 2 - 1));
            assert!((middle / sag - 1.0).abs() < 1e-12, "{n}: {middle}");
            let model = opened.model();
            let wrong = || check_state(model.document, model.structure, &values);
            assert_eq!(wrong(), [""; 0], "{n}");
            values.numbers[opened.slots("lower.4.tension")[0]] *= 1.0 + 1e-8;
            let wrong = || check_state(model.document, model.structure, &values);
            assert!(!wrong().is_empty(), "{n}");
        }
    }

    /// Half of the load rests on either support, whatever the bars share.
    #[test]
    fn a_braced_truss_is_in_balance() {
        for n in [3, 40] {
            let (opened, values) = solved(&braced_truss(n));
            let reaction = value(&opened, &values, "pin.reactionY");
            let wanted = 5e3 * (n + 1) as f64;
            assert!((reaction / wanted - 1.0).abs() < 1e-9, "{n}: {reaction}");
            let model = opened.model();
            assert_eq!(check_state(model.document, model.structure, &values), [""; 0], "{n}");
        }
    }

    /// **Source:** SuperLU on the nodal equations, ngspice agrees; a band of Gaussian elimination for 40.
    #[test]
    fn a_grid_of_resistors_has_its_voltage() {
        for (k, voltage) in [(10, 3.011_669_564_896_55), (40, 4.774_312_176_046_592)] {
            let (opened, values) = solved(&resistor_grid(k));
            let corner = value(&opened, &values, "nodes.0.voltage");
            let error = (corner / voltage - 1.0).abs();
            assert!(error < 1e-9, "{k}: {corner}");
        }
    }

    /// Without a ground voltages are known but for one sum, which the least distance from zero decides.
    #[test]
    fn a_grid_without_a_ground_floats_about_zero() {
        for (k, apart) in [(10, 3.011_669_564_896_55), (40, 4.774_312_176_046_592)] {
            let text =
                resistor_grid(k).replace("ground: Ground\n", "").replace("ground.lead.node = ", "");
            let (opened, values) = solved(&text);
            let voltage = |i: usize| value(&opened, &values, &format!("nodes.{i}.voltage"));
            assert!((voltage(0) - voltage(k * k - 1) - apart).abs() < 1e-9, "{k}");
            assert!((0..k * k).map(voltage).sum::<f64>().abs() < 1e-9, "{k}");
        }
    }

    /// Two sources that say otherwise of the same nodes yield alike: the given numbers of one circuit.
    #[test]
    fn sources_in_contradiction_meet_half_way_in_a_large_grid() {
        let battery =
            resistor_grid(20).replace("CurrentSource { source = 1 A }", "Battery { emf = 1 V }");
        let other = "other: Battery { emf = 2 V }
merge other.a.node = source.a.node
merge other.b.node = source.b.node
";
        let (opened, values) = solved(&(battery + other));
        for name in ["source.emf", "other.emf"] {
            assert!((value(&opened, &values, name) - 1.5).abs() < 1e-12, "{name}");
        }
    }

    /// Nothing carries the loads: all of them yield, each by the same, until they are in balance.
    /// **Source:** the least sum of squares under two sums, which symmetry makes one.
    #[test]
    fn a_truss_without_supports_has_loads_in_balance() {
        let n = 100;
        let text = warren_truss(n)
            .replace("pin: PinnedSupport\nroller: RollerSupport\n", "")
            .replace("pin.joint = ", "")
            .replace("roller.joint = ", "");
        let (opened, values) = solved(&text);
        let carried = 10e3 * (n - 1) as f64 / (2 * n + 1) as f64;
        let loads = [("below.0", 10e3 - carried), ("below.70", 10e3 - carried), ("left", -carried)];
        for (name, load) in loads {
            let found = value(&opened, &values, &format!("{name}.load"));
            assert!((found / load - 1.0).abs() < 1e-9, "{name}: {found}");
        }
    }

    /// With every bar braced too, and in a chain so long that doubles alone lose what depends on what.
    /// **Source:** the least sum of squares; it is symmetric, so that all change alike.
    #[test]
    fn a_braced_truss_without_supports_has_loads_in_balance() {
        let n = 60;
        let text = braced_truss(n)
            .replace("pin: PinnedSupport\nroller: RollerSupport\n", "")
            .replace("merge pin.joint = below[0]\n", "")
            .replace(&format!("merge roller.joint = below[{n}]\n"), "");
        let (opened, values) = solved(&text);
        for (name, load) in [("below.0", 5e3), ("below.41", 5e3), ("above.7", -5e3)] {
            let found = value(&opened, &values, &format!("{name}.load"));
            assert!((found / load - 1.0).abs() < 1e-9, "{name}: {found}");
        }
    }

    /// A truss that may turn about its pin has loads without a moment about it.
    /// **Source:** the least sum of squares under one sum: each load changes by so much of its lever.
    #[test]
    fn a_truss_that_may_turn_has_loads_without_a_moment() {
        let n = 80;
        let text =
            warren_truss(n).replace("roller: RollerSupport\n", "").replace("roller.joint = ", "");
        let (opened, values) = solved(&text);
        let levers = |all: std::ops::Range<usize>| all.map(|i| 1.5 * i as f64);
        let moment: f64 = (1..n).map(|i| 10e3 * 3.0 * i as f64).sum();
        let squares: f64 = levers(0..2 * n + 1).map(|x| x * x).sum();
        for (i, lever) in [(0, 3.0), (39, 120.0), (78, 237.0)] {
            let found = value(&opened, &values, &format!("below.{i}.load"));
            let wanted = 10e3 - lever * moment / squares;
            assert!((found / wanted - 1.0).abs() < 1e-8, "{i}: {found}, {wanted}");
        }
    }
}
