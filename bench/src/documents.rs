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
