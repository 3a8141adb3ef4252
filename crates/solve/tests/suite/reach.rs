//! Large changes: one stride ends where a walk of a thousand steps does, or tells that there is none.

use crate::builder::{Sheet, close};
use solve::{Drag, NoHost, Plan, SlotIndex};

/// A four-bar linkage: crank, coupler, rocker, with hubs at the origin and at `base`. The crank's
/// end is known; the coupler's end follows.
struct FourBar {
    sheet: Sheet,
    crank: f64,
    end: [SlotIndex; 2],
    joint: [SlotIndex; 2],
}

fn four_bar([crank, coupler, rocker, base]: [f64; 4], angle: f64) -> Option<FourBar> {
    let mut sheet = Sheet::default();
    let [x, y] = on_circle(crank, angle);
    let end = sheet.anchor(x, y);
    let hub = sheet.anchor(base, 0.0);
    // the upper meeting point of the two circles
    let (dx, dy) = (base - x, -y);
    let d = base::number::sqrt(dx * dx + dy * dy);
    let along = (d * d + coupler * coupler - rocker * rocker) / (2.0 * d);
    let square = coupler * coupler - along * along;
    if square < 1e-3 {
        return None;
    }
    let up = base::number::sqrt(square);
    let joint = sheet.place(x + (along * dx - up * dy) / d, y + (along * dy + up * dx) / d);
    for (from, length) in [(end, coupler), (hub, rocker)] {
        let (distance, length) = (sheet.distance(from, joint), sheet.c(length));
        sheet.require(distance, length);
    }
    Some(FourBar { sheet, crank, end, joint })
}

fn on_circle(radius: f64, degrees: f64) -> [f64; 2] {
    let angle = degrees.to_radians();
    [radius * base::number::cos(angle), radius * base::number::sin(angle)]
}

impl FourBar {
    fn plan(&self) -> Plan {
        self.sheet.plan()
    }
    /// Turns the crank in so many steps; returns where the joint is, if every step was reached.
    fn turn(
        &self,
        drag: &mut Drag,
        plan: &Plan,
        [from, to]: [f64; 2],
        steps: u32,
    ) -> Option<[f64; 2]> {
        for step in 1..=steps {
            let part = f64::from(step) / f64::from(steps);
            let target = on_circle(self.crank, from + (to - from) * part);
            if !drag.follow(plan, &target, &mut NoHost).is_solved() {
                return None;
            }
        }
        Some(self.joint.map(|slot| drag.values()[slot as usize]))
    }
}

/// Numbers that depend on the seed alone, from 0 to 1.
fn next(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*seed >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn large_turns_of_a_four_bar_end_where_a_thousand_small_ones_do() {
    let mut seed = 7;
    let (mut reachable, mut reached) = (0, 0);
    for _ in 0..60 {
        let lengths = [
            2.0 + 3.0 * next(&mut seed),
            6.0 + 4.0 * next(&mut seed),
            6.0 + 4.0 * next(&mut seed),
            8.0 + 3.0 * next(&mut seed),
        ];
        let from = 360.0 * next(&mut seed) - 180.0;
        let to = from + 160.0 * next(&mut seed) - 80.0;
        let Some(bar) = four_bar(lengths, from) else { continue };
        let plan = bar.plan();
        let drag = || bar.sheet.drag(&plan, &bar.end);
        let Some(wanted) = bar.turn(&mut drag(), &plan, [from, to], 1000) else { continue };
        reachable += 1;
        let mut fast = drag();
        let Some(got) = bar.turn(&mut fast, &plan, [from, to], 1) else { continue };
        reached += 1;
        for (a, b) in got.into_iter().zip(wanted) {
            close(a, b, 1e-7);
        }
        // and back
        let back = bar.turn(&mut fast, &plan, [to, from], 1).expect("it was there");
        for (a, slot) in back.into_iter().zip(bar.joint) {
            close(a, bar.sheet.x0[slot as usize], 1e-7);
        }
    }
    assert!(reachable > 40, "{reachable}");
    assert_eq!(reached, reachable);
}

#[test]
fn ten_thousand_turns_do_not_drift() {
    let bar = four_bar([4.0, 8.0, 8.0, 10.0], 60.0).expect("it can be built");
    let plan = bar.plan();
    let mut drag = bar.sheet.drag(&plan, &bar.end);
    let end = bar.turn(&mut drag, &plan, [60.0, 60.0 + 36_000.0], 10_000).expect("it turns round");
    for (a, slot) in end.into_iter().zip(bar.joint) {
        close(a, bar.sheet.x0[slot as usize], 1e-9);
    }
}
