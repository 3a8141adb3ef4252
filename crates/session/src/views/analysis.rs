//! The analysis in words: what is free, what says nothing new, what cannot hold together.

use crate::document::Open;
use crate::session::parse_path;
use crate::state::State;
use crate::texts::Texts;
use crate::view::{Analysis, Choice, ContradictionView, MotionView, RedundantView, Velocity};
use crate::{rules, words};
use base::Place;
use expr::Dimension;
use kernel::{Command, Literal, Primitive, SlotId, ThingId, Values};
use plan::{
    Certainty, Combination, Contradiction, Motion, MotionKind, Redundant, RedundantKind, Repair,
    Said,
};
use std::collections::{BTreeMap, BTreeSet};

/// So many ways to move are told.
pub const MOST_MOTIONS: usize = 100_000;

/// Analyses the document as it is; a drag is not looked at.
pub(crate) fn view(open: &mut Open) -> Analysis {
    let state = open.state.clone();
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let found = open.planner.analyse(state.model(), &state.values, &mut texts);
    let unmet = &open.status.unmet;
    let against = open.planner.contradictions(state.model(), &state.values, unmet, &mut texts);
    let mut things = BTreeSet::new();
    let mut free: Vec<String> = Vec::new();
    for &slot in &found.free {
        let s = &state.structure.slots[slot];
        let thing = s.place.unwrap_or(s.thing);
        if things.insert(thing) {
            free.push(state.structure.path(&state.lowered.document, thing).to_string());
        }
    }
    let motions = found.motions.iter().take(MOST_MOTIONS).map(|m| motion(open, m)).collect();
    // what stands in a contradiction says something
    let stands = |r: &&Redundant| against.iter().any(|c| c.constraints.contains(&r.source));
    let says_nothing = found.redundant.iter().filter(|r| !stands(r));
    let redundant = says_nothing.filter_map(|r| redundant(open, r)).collect();
    let contradictions = against.iter().map(|c| contradiction(open, c)).collect();
    Analysis {
        freedom: found.freedom as u32,
        free,
        motions,
        redundant,
        contradictions,
        advice: Vec::new(),
    }
}

fn names(open: &Open, sources: &[plan::Source]) -> Vec<String> {
    sources.iter().filter_map(|&s| words::source_name(&open.state, s)).collect()
}

fn redundant(open: &Open, r: &Redundant) -> Option<RedundantView> {
    let constraint = words::source_name(&open.state, r.source)?;
    let implied_by = names(open, &r.implied_by);
    let because = match (r.kind, implied_by.is_empty()) {
        (RedundantKind::Form, true) => "it speaks of numbers that are fixed anyway".to_string(),
        (RedundantKind::Form, false) => {
            let say = if implied_by.len() == 1 { "says" } else { "say" };
            let said = rules::all_told(&open.state, &r.implied_by);
            format!("{} {say} it already", words::listed(&said))
        }
        (RedundantKind::Theorem, true) => "it holds wherever the others do".to_string(),
        (RedundantKind::Theorem, false) => {
            let hold = if implied_by.len() == 1 { "does" } else { "do" };
            let said = rules::all_told(&open.state, &r.implied_by);
            format!("it holds wherever {} {hold}", words::listed(&said))
        }
    };
    Some(RedundantView { constraint, implied_by, because })
}

/// The names of coordinates.
const AXES: [&str; 3] = ["x", "y", "z"];

/// What moves no faster beside the fastest rests.
const STILL: f64 = 1e-12;

fn motion(open: &Open, motion: &Motion) -> MotionView {
    let (state, structure) = (&open.state, &open.state.structure);
    let mut things: BTreeMap<ThingId, Vec<(SlotId, f64)>> = BTreeMap::new();
    for &(slot, speed) in &motion.moves {
        let s = &structure.slots[slot];
        let place = s.place.filter(|&place| has_axes(state, place));
        things.entry(place.unwrap_or(s.thing)).or_default().push((slot, speed));
    }
    let velocity = |(&thing, moves): (&ThingId, &Vec<(SlotId, f64)>)| {
        let speed = |s: &SlotId| moves.iter().find(|m| m.0 == *s).map_or(0.0, |m| m.1);
        let direction = structure.slots_under(thing).iter().map(speed).collect();
        let path = structure.path(&state.lowered.document, thing).to_string();
        Velocity { path, direction }
    };
    let moves: Vec<Velocity> = things.iter().map(velocity).collect();
    // how fast what measures alike moves at most: of lengths and forces that go together one may look like nothing
    let measure = |thing: &ThingId| structure.slots[things[thing][0].0].primitive;
    let mut fastest: Vec<(Primitive, f64)> = Vec::new();
    for (thing, v) in things.keys().zip(&moves) {
        let speed = v.direction.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        match fastest.iter_mut().find(|known| known.0 == measure(thing)) {
            Some(known) => known.1 = known.1.max(speed),
            None => fastest.push((measure(thing), speed)),
        }
    }
    let short = |x: &f64| base::number::rounded(*x, 3);
    let along = |direction: &[f64]| {
        let rounded: Vec<String> = direction.iter().map(short).collect();
        let moving: Vec<usize> = (0..rounded.len()).filter(|&i| rounded[i] != "0").collect();
        match moving[..] {
            // along an axis there is no need for numbers
            [axis] => AXES[axis].to_string(),
            _ => format!("({})", rounded.join(", ")),
        }
    };
    let summary = match (motion.kind, moves.as_slice()) {
        (MotionKind::Alone, [only]) if only.direction.len() == 1 => {
            format!("{} moves alone", only.path)
        }
        (MotionKind::Alone, [only]) => {
            format!("{} moves along {}", only.path, along(&only.direction))
        }
        (MotionKind::Rotation { center }, [first, ..]) => {
            let [x, y] = center.map(|c| short(&c));
            format!("everything around {} turns about ({x}, {y}) as one", first.path)
        }
        (_, moves) => {
            let shown = things.keys().zip(moves).filter_map(|(thing, v)| {
                let own = fastest.iter().find(|known| known.0 == measure(thing))?.1;
                let direction: Vec<f64> = v.direction.iter().map(|x| x / own).collect();
                let rests = own <= STILL || direction.iter().all(|x| short(x) == "0");
                let has_direction = direction.len() > 1;
                let v = Velocity { path: v.path.clone(), direction };
                (!(has_direction && rests)).then_some(v)
            });
            together(&shown.collect::<Vec<_>>(), along)
        }
    };
    MotionView { summary, moves }
}

/// Returns true for a thing whose numbers are its coordinates; what else belongs together is told number by number.
fn has_axes(state: &State, place: ThingId) -> bool {
    let parts = state.structure.slots_under(place).into_iter();
    let name = |slot: SlotId| {
        let thing = state.structure.slots[slot].thing;
        state.structure.path(&state.lowered.document, thing).0.pop()
    };
    let is_axis = |(slot, axis): (SlotId, &str)| matches!(name(slot), Some(kernel::Step::Part(name)) if *name == *axis);
    parts.zip(AXES).all(is_axis)
}

/// Says how several places and numbers move together: what goes the same way in one breath.
fn together(moves: &[Velocity], along: impl Fn(&[f64]) -> String) -> String {
    let way = |v: &Velocity| match v.direction.as_slice() {
        [speed] => base::number::rounded(*speed, 3),
        direction => along(direction),
    };
    let mut groups: Vec<(bool, String, Vec<String>)> = Vec::new();
    for v in moves {
        let (is_number, way) = (v.direction.len() == 1, way(v));
        match groups.iter_mut().find(|g| (g.0, &g.1) == (is_number, &way)) {
            Some(group) => group.2.push(v.path.clone()),
            None => groups.push((is_number, way, vec![v.path.clone()])),
        }
    }
    let listed = |paths: &[String]| words::listed(paths);
    match groups.as_slice() {
        [(false, way, paths)] if paths.len() > 1 => {
            format!("{} slide together along {way}", listed(paths))
        }
        [(true, _, paths)] if paths.len() > 1 => format!("{} move together", listed(paths)),
        groups => {
            let is_alone =
                |is_number: &bool| groups.iter().filter(|g| g.0 == *is_number).count() < 2;
            let each = groups.iter().map(|(is_number, way, paths)| match is_number {
                false => format!("{} along {way}", listed(paths)),
                true if is_alone(is_number) => listed(paths),
                true => format!("{} by {way}", listed(paths)),
            });
            let each: Vec<String> = each.collect();
            format!("together: {}", words::listed(&each))
        }
    }
}

/// How many constraints of a search that was given up are named.
const FEW: usize = 4;

pub(crate) fn contradiction(open: &Open, c: &Contradiction) -> ContradictionView {
    let state = &open.state;
    let constraints = names(open, &c.constraints);
    let anchors: Vec<String> = c.anchors.iter().map(|&a| state.place_path(a).to_string()).collect();
    let mut all = rules::all_told(state, &c.constraints);
    all.extend(rules::anchors_told(state, &c.anchors));
    let list = words::listed(&all);
    let (decided, message) = match (c.certainty, all.len()) {
        (Certainty::Contradiction, 1) => {
            let domains = domains(state, &c.constraints).unwrap_or_default();
            (true, format!("{list} cannot hold{domains}"))
        }
        (Certainty::Contradiction, _) => {
            let proof = c.proof.as_ref().and_then(|p| combination(open, p));
            let proof = proof.map(|p| format!(": {p}")).or_else(|| domains(state, &c.constraints));
            (true, format!("{list} contradict each other{}", proof.unwrap_or_default()))
        }
        (Certainty::NoSolution { starts }, count) => {
            let together = if count == 1 { "" } else { " together" };
            let why = no_value(open, c).and_then(|no_value| {
                let name = rules::told(state, no_value.source)?;
                Some(format!(": {name} has no value: {}", no_value.fault))
            });
            let why = why.unwrap_or_default();
            (true, format!("no solution of {list}{together} was found, from {starts} starts{why}"))
        }
        (Certainty::Holds, _) => {
            (false, format!("{list} can hold with all the others, but not from where things are"))
        }
        (Certainty::NotDecided { trials }, _) => {
            let end = format!("the search ended after {trials} trials");
            (false, format!("not decided which of {list} contradict: {end}"))
        }
        (Certainty::GivenUp(bound), count) => {
            let few = words::listed(&all[..count.min(FEW)]);
            let more =
                if count > FEW { format!(" and {} more", count - FEW) } else { String::new() };
            let bound = words::given_up(bound);
            (false, format!("not decided whether {few}{more} can hold: {bound}"))
        }
    };
    let message = match only_reading(open, &c.constraints, &BTreeSet::new()) {
        Some(reads) if decided => format!("{message}; {reads}"),
        _ => message,
    };
    let set = |slot: SlotId, to: f64| {
        let mut values = state.values.clone();
        values.numbers[slot] = to;
        // what is to be typed keeps its digits: the rules hold for that value
        let exact = words::slot_exactly(state, slot, &values);
        format!("set {} to {exact}", state.slot_path(slot))
    };
    let repair = |r: &Repair| match *r {
        Repair::LeaveOut { source, ref numbers } => {
            let name = rules::told(state, source)?;
            let values = left(open, numbers);
            // what was only searched for is no repair where a figure comes to nothing
            let is_found = matches!(c.certainty, Certainty::NoSolution { .. });
            let is_none = is_found && collapses(state, source, &values);
            let sides = words::sides_in_words(state, source, &values).filter(|_| !is_none);
            let sides = sides.map_or(String::new(), |sides| format!("; then {sides}"));
            Some(format!("delete {name} or switch it off{sides}"))
        }
        // what is constant is not to be given up for a rule
        Repair::LetGo { slot } | Repair::Change { slot, .. } if state.is_constant(slot) => None,
        Repair::Move { ref to } if to.iter().any(|(slot, _)| state.is_constant(*slot)) => None,
        Repair::LetGo { slot } => Some(format!("let go of {}", state.place_path(slot))),
        Repair::Change { slot, to } => Some(set(slot, to)),
        Repair::Move { ref to } if to.len() <= FEW => {
            let each: Vec<String> = to.iter().map(|&(slot, to)| set(slot, to)).collect();
            Some(words::listed(&each))
        }
        Repair::Move { .. } => None,
    };
    let (mut repairs, mut choices) = (Vec::new(), Vec::new());
    for r in &c.repairs {
        let r = &rounded(open, c, r);
        let Some(label) = repair(r) else { continue };
        choices.extend(mending(open, r).map(|command| Choice { label: label.clone(), command }));
        repairs.push(label);
    }
    ContradictionView { constraints, anchors, decided, message, repairs, choices }
}

/// Says between which whole numbers some constraints have to hold: `: a, b, c are in 1..3`; nothing where each may be any.
fn domains(state: &State, constraints: &[plan::Source]) -> Option<String> {
    let mut by_range: Vec<((i64, i64), Vec<SlotId>)> = Vec::new();
    for slot in words::read_by(state, constraints) {
        let Some(&range) = state.structure.ranges.get(&slot) else { continue };
        match by_range.iter_mut().find(|known| known.0 == range) {
            Some(known) => known.1.push(slot),
            None => by_range.push((range, vec![slot])),
        }
    }
    let told = by_range.iter().map(|((low, high), slots)| {
        let names = words::slots_listed(state, slots);
        let are = if names.len() == 1 { "is" } else { "are" };
        let few = words::listed(&names[..names.len().min(FEW)]);
        match names.len().checked_sub(FEW).filter(|more| *more > 0) {
            Some(more) => format!("{few} and {more} more {are} in {low}..{high}"),
            None => format!("{few} {are} in {low}..{high}"),
        }
    });
    let told: Vec<String> = told.collect();
    (!told.is_empty()).then(|| format!(": {}", told.join(", ")))
}

/// A side of a rule comes to nothing where it is a smaller part than this of the other.
const NOTHING: f64 = 1e-9;

/// Returns true if one length of a constraint's rule comes to nothing beside the other: the figure would collapse.
fn collapses(state: &State, source: plan::Source, values: &Values) -> bool {
    let Some((instance, left, right)) = words::sides_of(state, source) else { return false };
    let evaluator = state.evaluator(values);
    let size = |term| match evaluator.evaluate(term, instance.owner) {
        Ok(eval::Answer::Number(x, Dimension::LENGTH)) => Some(x.abs()),
        _ => None,
    };
    let (Some(left), Some(right)) = (size(left), size(right)) else { return false };
    left.min(right) <= NOTHING * left.max(right)
}

/// How many digits a number of a repair has at first.
const DIGITS: usize = 6;
/// As many digits tell any number.
const ALL_DIGITS: usize = 17;

/// Returns a repair with as few digits in its numbers, in the units in which they are shown, as it needs.
fn rounded(open: &Open, c: &Contradiction, repair: &Repair) -> Repair {
    let numbers = match *repair {
        Repair::Change { slot, to } => vec![(slot, to)],
        Repair::Move { ref to } if to.len() <= FEW => to.clone(),
        _ => return repair.clone(),
    };
    let with = |digits: usize| -> Vec<(SlotId, f64)> {
        numbers.iter().map(|&(slot, to)| (slot, with_digits(open, slot, to, digits))).collect()
    };
    let holds = |numbers: &Vec<(SlotId, f64)>| {
        let values = left(open, numbers);
        c.constraints.iter().all(|&s| words::shortfall(&open.state, s, &values).is_none())
    };
    let Some(numbers) = (DIGITS..ALL_DIGITS).map(with).find(holds) else { return repair.clone() };
    match (repair, numbers.as_slice()) {
        (Repair::Change { .. }, &[(slot, to)]) => Repair::Change { slot, to },
        _ => Repair::Move { to: numbers },
    }
}

/// Returns the number that is shown with so many digits for one of a slot.
fn with_digits(open: &Open, slot: SlotId, to: f64, digits: usize) -> f64 {
    let state = &open.state;
    let Primitive::Real(dimension) = state.structure.slots[slot].primitive else { return to };
    let document = &state.lowered.document;
    let unit = words::show_slot(state, slot, &left(open, &[(slot, to)])).unit;
    let shown = kernel::in_unit(to, dimension, &unit, document);
    let written = base::number::significant(shown, digits);
    match expr::units::read_quantity(&written, &unit) {
        Some((si, dimension)) => kernel::quantity::from_si(document, si, dimension),
        None => written.parse().map_or(to, |x| kernel::quantity::from_bare(document, x, dimension)),
    }
}

/// Returns the command that mends a contradiction as a repair says; nothing where none can say it.
fn mending(open: &Open, repair: &Repair) -> Option<Command> {
    let state = &open.state;
    let set = |slot: SlotId, to: f64| (state.slot_path(slot), Literal::Number(to));
    match *repair {
        Repair::LeaveOut { source: source @ plan::Source::Constraint(_), .. } => {
            let path = parse_path(&words::source_name(state, source)?)?;
            Some(Command::Enable { path, on: false })
        }
        Repair::LeaveOut { .. } => None,
        Repair::LetGo { slot } => {
            Some(Command::Anchor { path: state.place_path(slot), held: false })
        }
        Repair::Change { slot, to } => Some(Command::Set(vec![set(slot, to)])),
        Repair::Move { ref to } => {
            Some(Command::Set(to.iter().map(|&(slot, to)| set(slot, to)).collect()))
        }
    }
}

/// Returns the values of the document as a repair would leave them.
fn left(open: &Open, numbers: &[(SlotId, f64)]) -> Values {
    let mut values = open.state.values.clone();
    numbers.iter().for_each(|&(slot, x)| values.numbers[slot] = x);
    values
}

/// A constraint that has no value where the others hold: it divides by zero, or the like.
struct NoValue {
    source: plan::Source,
    /// Why it has none.
    fault: String,
    /// Where the others hold.
    values: Values,
}

fn no_value(open: &Open, c: &Contradiction) -> Option<NoValue> {
    let faulty = |repair: &Repair| {
        let Repair::LeaveOut { source, ref numbers } = *repair else { return None };
        let values = left(open, numbers);
        let fault = words::fault(&open.state, source, &values)?;
        Some(NoValue { source, fault, values })
    };
    c.repairs.iter().find_map(faulty)
}

/// Returns where the operation stands that leaves a constraint of a contradiction without a value.
pub(super) fn place_without_value(open: &Open, c: &Contradiction) -> Option<Place> {
    let NoValue { source, values, .. } = no_value(open, c)?;
    words::place_of_fault(&open.state, source, &values)
}

/// Names what constraints only read, as `reads` says or since no method computes it; nothing of what is set itself.
pub(crate) fn only_reading(
    open: &Open,
    constraints: &[plan::Source],
    set: &BTreeSet<SlotId>,
) -> Option<String> {
    let state = &open.state;
    let said = |&source: &plan::Source| {
        let plan::Source::Constraint(index) = source else { return None };
        let instance = state.structure.constraints[index as usize];
        let class = &state.lowered.document.classes[instance.class];
        let reads = class.constraints[instance.index as usize].reads.iter();
        let named = reads.filter_map(|path| state.structure.follow(instance.owner, path).ok());
        let mut read = open.planner.only_read(source);
        read.extend(named.flat_map(|thing| state.structure.slots_under(thing)));
        if !read.is_disjoint(set) {
            return None;
        }
        let read: Vec<SlotId> = read.into_iter().collect();
        let name = rules::told(state, source)?;
        let read = words::listed(&words::slots_listed(state, &read));
        (!read.is_empty()).then(|| format!("{name} only reads {read}"))
    };
    let said: Vec<String> = constraints.iter().filter_map(said).collect();
    (!said.is_empty()).then(|| words::listed(&said))
}

/// Says a proof: `2 × a + b says 30, c says 31`.
fn combination(open: &Open, proof: &Combination) -> Option<String> {
    let shown = |x: f64| base::number::significant(x, 6);
    let mut sum = String::new();
    for &(source, factor) in &proof.terms {
        let name = rules::told(&open.state, source)?;
        let sign = match (sum.is_empty(), factor < 0.0) {
            (true, false) => "",
            (true, true) => "−",
            (false, false) => " + ",
            (false, true) => " − ",
        };
        sum.push_str(sign);
        if factor.abs() != 1.0 {
            sum.push_str(&format!("{} × ", shown(factor.abs())));
        }
        sum.push_str(&name);
    }
    let measured = |x: f64| words::amount(&open.state, proof.against, x);
    let says = |said: Said| match said {
        Said::Is(x) => measured(x),
        Said::AtMost(x) => format!("at most {}", measured(x)),
        Said::AtLeast(x) => format!("at least {}", measured(x)),
    };
    let against = rules::told(&open.state, proof.against)?;
    let (said, denied) = (says(proof.says), says(proof.denies));
    (!sum.is_empty()).then(|| format!("{sum} says {said}, {against} says {denied}"))
}
