//! Drags in few frames and in many: a wish is followed along the way to it, so that what a drag comes to
//! does not depend on how often the pointer was asked where it is.
//!
//! Chains of bars from a pin, open and closed, bent at random, are dragged by one of their joints along a
//! straight way of several bar lengths: in one frame, in five, and in hundreds. `THINGLAB_LONG` tries
//! more of them.

use base::Dice;
use bench::case::{Case, Constraint};
use bench::document;
use bench::opened::Opened;
use kernel::Values;
use plan::Target;

/// How far two ends may lie apart, of bars of length one: where least change is measured anew on the way, the
/// place where that is depends a little on the strides.
const SAME: f64 = 1e-3;
/// The same for chains that come to lie on a floor, where that begins depends on the strides as well.
const SAME_ON_FLOOR: f64 = 1e-2;
/// Two bars fold on a floor where the joints at their other ends lie on it and are so near to one another.
const FOLDED: f64 = 1e-2;
/// Into how many frames a way is cut.
const FRAMES: [usize; 3] = [100, 5, 1];

/// Whether the last joint of a chain is pinned too.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum End {
    Open,
    Pinned,
}

/// A chain of bars of length one, each bent from the one before.
fn chain(bars: usize, end: End, dice: &mut Dice) -> Case {
    let (mut at, mut angle) = ([0.0, 0.0], dice.between(-3.0, 3.0));
    let mut points = vec![at];
    for _ in 0..bars {
        angle += dice.between(-1.4, 1.4);
        at = [at[0] + base::number::cos(angle), at[1] + base::number::sin(angle)];
        points.push(at);
    }
    let pin = |p: usize| Constraint::Fix { p, x: points[p][0], y: points[p][1] };
    let mut constraints = vec![pin(0)];
    constraints.extend((0..bars).map(|p| Constraint::Distance { p, q: p + 1, v: 1.0 }));
    if end == End::Pinned {
        constraints.push(pin(bars));
    }
    Case {
        format: "gcs-case/1".into(),
        name: "chain".into(),
        well_constrained: false,
        truth: points.clone(),
        start: points,
        lines: Vec::new(),
        arcs: Vec::new(),
        constraints,
        drag: None,
    }
}

/// What a drag comes to: where all joints are at first and after each frame, and whether the place was reached.
struct Dragged {
    way: Vec<Vec<[f64; 2]>>,
    reached: bool,
    /// What the independent checker says of its end.
    complaints: Vec<String>,
}

impl Dragged {
    fn ends(&self) -> &[[f64; 2]] {
        self.way.last().expect("it begins somewhere")
    }
}

/// Whether joints two bars apart that slide along the floor passed through one another from one frame to the next:
/// then the joint between them may be anywhere around them, and which way it goes on is not decided.
fn folds(before: &[[f64; 2]], after: &[[f64; 2]], floor: f64) -> bool {
    let lies = |p: [f64; 2]| p[1] < floor + 1e-3;
    let between = |p: &[[f64; 2]], i: usize| [p[i + 2][0] - p[i][0], p[i + 2][1] - p[i][1]];
    let slide = |&i: &usize| [i, i + 2].iter().all(|&j| lies(before[j]) && lies(after[j]));
    (0..before.len().saturating_sub(2)).filter(slide).any(|i| {
        let (from, to) = (between(before, i), between(after, i));
        let way = [to[0] - from[0], to[1] - from[1]];
        let along = -(from[0] * way[0] + from[1] * way[1]);
        let part = (along / (way[0] * way[0] + way[1] * way[1]).max(1e-12)).clamp(0.0, 1.0);
        base::number::hypot(from[0] + part * way[0], from[1] + part * way[1]) < FOLDED
    })
}

/// Drags a joint straight to a place, with more rules.
fn dragged(case: &Case, rules: &str, joint: usize, to: [f64; 2], frames: usize) -> Dragged {
    let text = format!("{}\n{rules}", document::text(case));
    let opened = Opened::new(&text).expect("a chain can be said");
    let (mut planner, mut values, report) = opened.solve();
    assert!(report.unmet.is_empty(), "its bars are as long as they are");
    let thing = opened.thing(&format!("p{joint}")).expect("it has this joint");
    let (model, host) = (opened.model(), &mut opened.host());
    let press = planner.press(model, &values, &[Target::Thing(thing)]);
    let mut press = press.expect("a joint can be dragged");
    let place = |values: &Values, p: usize| {
        let slots = opened.slots(&format!("p{p}"));
        [values.numbers[slots[0]], values.numbers[slots[1]]]
    };
    let places =
        |values: &Values| -> Vec<_> { (0..case.start.len()).map(|p| place(values, p)).collect() };
    let mut dragged =
        Dragged { way: vec![places(&values)], reached: false, complaints: Vec::new() };
    let before = values.clone();
    for frame in 1..=frames {
        let part = frame as f64 / frames as f64;
        let wish = [0, 1].map(|k| case.start[joint][k] + part * (to[k] - case.start[joint][k]));
        dragged.reached = planner.drag(model, &mut press, &mut values, &wish, host).reached;
        dragged.way.push(places(&values));
    }
    let path = format!("p{joint}");
    dragged.complaints = opened.complaints(&before, &values, &path, &to);
    // where least change is measured anew its end is no longer the least from where the drag began
    dragged.complaints.retain(|complaint| !complaint.contains("more than they had to"));
    dragged
}

/// What a drag comes to in many frames, and what is otherwise in few.
struct Compared {
    many: Dragged,
    complaints: Vec<String>,
}

/// Drags a joint in many frames and in few, and complains where joints lie farther apart than `same` then or
/// one drag reaches what another does not.
fn compared(case: &Case, rules: &str, joint: usize, to: [f64; 2], same: f64) -> Compared {
    let [many, few @ ..] = FRAMES.map(|frames| dragged(case, rules, joint, to, frames));
    let mut complaints = many.complaints.clone();
    for (few, frames) in few.iter().zip(&FRAMES[1..]) {
        let off = |(p, q): (&[f64; 2], &[f64; 2])| (p[0] - q[0]).abs().max((p[1] - q[1]).abs());
        complaints
            .extend(few.complaints.iter().map(|c| format!("{c}, in {frames} frames to {to:?}")));
        let apart = many.ends().iter().zip(few.ends()).map(off).fold(0.0, f64::max);
        if apart > same || few.reached != many.reached {
            complaints.push(format!(
                "{} joints to {to:?} in {frames} frames: {apart:.1e} off, reached: {}, in many: {}",
                case.start.len(),
                few.reached,
                many.reached
            ));
        }
    }
    Compared { many, complaints }
}

fn seeds() -> u64 {
    if std::env::var_os("THINGLAB_LONG").is_some() { 400 } else { 9 }
}

#[test]
fn a_drag_ends_in_the_same_place_in_few_frames_and_in_many() {
    let (mut wrong, mut reached) = (Vec::new(), 0);
    for seed in 0..seeds() {
        let dice = &mut Dice::new(seed);
        let bars = 3 + seed as usize % 7;
        let end = if seed % 3 == 0 { End::Pinned } else { End::Open };
        let case = chain(bars, end, dice);
        let joint = if end == End::Pinned { bars / 2 } else { bars };
        let reach = 0.9 * joint as f64;
        let (far, angle) = (dice.between(0.2, 1.0) * reach, dice.between(-3.2, 3.2));
        let to = [far * base::number::cos(angle), far * base::number::sin(angle)];
        let drags = compared(&case, "", joint, to, SAME);
        reached += u64::from(drags.many.reached);
        wrong.extend(drags.complaints.iter().map(|c| format!("seed {seed}, {end:?}: {c}")));
    }
    assert!(wrong.is_empty(), "{reached} of {} reached\n{}", seeds(), wrong.join("\n"));
    assert!(2 * reached > seeds(), "{reached} of {} reached", seeds());
}

#[test]
fn a_chain_comes_to_lie_on_its_floor_in_few_frames_as_in_many() {
    let (mut wrong, mut lie, mut undecided) = (Vec::new(), 0, 0);
    for seed in 0..seeds() {
        let dice = &mut Dice::new(seed);
        let bars = 2 + seed as usize % 4;
        let case = chain(bars, End::Open, dice);
        let lowest = case.start.iter().map(|p| p[1]).fold(0.0, f64::min);
        let floor = lowest - dice.between(0.05, 0.5);
        let rules: Vec<String> =
            (1..=bars).map(|p| format!("constraint p{p}.y >= {floor}")).collect();
        let to = [dice.between(-1.0, 1.0) * bars as f64, floor - dice.between(0.0, 1.0)];
        let drags = compared(&case, &rules.join("\n"), bars, to, SAME_ON_FLOOR);
        lie += u64::from(drags.many.ends().iter().any(|p| p[1] < floor + 1e-6));
        if drags.many.way.windows(2).any(|w| folds(&w[0], &w[1], floor)) {
            undecided += u64::from(!drags.complaints.is_empty());
            continue;
        }
        wrong.extend(drags.complaints.iter().map(|c| format!("seed {seed}, floor {floor}: {c}")));
    }
    assert!(wrong.is_empty(), "{lie} of {} lie\n{}", seeds(), wrong.join("\n"));
    assert!(2 * lie > seeds(), "{lie} of {} lie on it", seeds());
    assert!(50 * undecided <= seeds(), "{undecided} of {} go on in two ways from a fold", seeds());
}

#[test]
fn a_chain_goes_on_without_a_jump_where_it_comes_to_its_floor() {
    let case = chain(4, End::Open, &mut Dice::new(34));
    let rules: Vec<String> =
        (1..=4).map(|p| format!("constraint p{p}.y >= -0.26186787927243654")).collect();
    let to = [3.9176494103537873, -0.79125024985009];
    let Dragged { way, .. } = dragged(&case, &rules.join("\n"), 4, to, 400);
    let step = |a: [f64; 2], b: [f64; 2]| base::number::hypot(a[0] - b[0], a[1] - b[1]);
    let pointer = step(case.start[4], to) / 400.0;
    let joints = way.windows(2).flat_map(|w| w[0].iter().zip(&w[1]).map(|(&a, &b)| step(a, b)));
    let farthest = joints.fold(0.0, f64::max);
    assert!(farthest < 3.0 * pointer, "{farthest} where the pointer goes {pointer} a frame");
}
