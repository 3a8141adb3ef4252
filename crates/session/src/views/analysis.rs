//! The analysis in words: what is free, what says nothing new, what cannot hold together.

use crate::document::Open;
use crate::texts::Texts;
use crate::view::{Analysis, ContradictionView, MotionView, RedundantView, Velocity};
use crate::words;
use kernel::{Primitive, SlotId, ThingId};
use plan::{
    Certainty, Combination, Contradiction, Motion, MotionKind, Redundant, RedundantKind, Repair,
    Said,
};
use std::collections::BTreeMap;

/// Analyses the document as it is; a drag is not looked at.
pub(crate) fn view(open: &mut Open) -> Analysis {
    let state = open.state.clone();
    let mut texts = Texts::new(&state.lowered.document, &state.structure);
    let found = open.planner.analyse(state.model(), &state.values, &mut texts);
    let unmet = &open.status.unmet;
    let against = open.planner.contradictions(state.model(), &state.values, unmet, &mut texts);
    let mut free: Vec<String> = Vec::new();
    for &slot in &found.free {
        let s = &state.structure.slots[slot];
        let thing = s.place.unwrap_or(s.thing);
        let path = state.structure.path(&state.lowered.document, thing).to_string();
        if !free.contains(&path) {
            free.push(path);
        }
    }
    let motions = found.motions.iter().map(|m| motion(open, m)).collect();
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
            format!("{} {say} it already", words::listed(&implied_by))
        }
        (RedundantKind::Theorem, true) => "it holds wherever the others do".to_string(),
        (RedundantKind::Theorem, false) => {
            let hold = if implied_by.len() == 1 { "does" } else { "do" };
            format!("it holds wherever {} {hold}", words::listed(&implied_by))
        }
    };
    Some(RedundantView { constraint, implied_by, because })
}

/// What moves no faster beside the fastest rests.
const STILL: f64 = 1e-12;

fn motion(open: &Open, motion: &Motion) -> MotionView {
    let (state, structure) = (&open.state, &open.state.structure);
    let mut things: BTreeMap<ThingId, Vec<(SlotId, f64)>> = BTreeMap::new();
    for &(slot, speed) in &motion.moves {
        let s = &structure.slots[slot];
        things.entry(s.place.unwrap_or(s.thing)).or_default().push((slot, speed));
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
    let along = |v: &Velocity| match v.direction.as_slice() {
        [_] => "alone".to_string(),
        many => format!("along ({})", many.iter().map(short).collect::<Vec<_>>().join(", ")),
    };
    let summary = match (motion.kind, moves.as_slice()) {
        (MotionKind::Alone, [only]) => format!("{} moves {}", only.path, along(only)),
        (MotionKind::Translation, [first, ..]) => {
            format!("everything around {} moves {} as one", first.path, along(first))
        }
        (MotionKind::Rotation { center }, [first, ..]) => {
            let [x, y] = center.map(|c| short(&c));
            format!("everything around {} turns about ({x}, {y}) as one", first.path)
        }
        (_, moves) => {
            let shown = things.keys().zip(moves).filter_map(|(thing, v)| {
                let own = fastest.iter().find(|known| known.0 == measure(thing))?.1;
                let direction: Vec<f64> = v.direction.iter().map(|x| x / own).collect();
                let v = Velocity { path: v.path.clone(), direction };
                let rests = own <= STILL || v.direction.iter().all(|x| short(x) == "0");
                let has_direction = v.direction.len() > 1;
                (!(has_direction && rests)).then(|| format!("{} {}", v.path, along(&v)))
            });
            let each: Vec<String> = shown.collect();
            format!("together: {}", words::listed(&each))
        }
    };
    MotionView { summary, moves }
}

/// How many constraints of a search that was given up are named.
const FEW: usize = 4;

fn contradiction(open: &Open, c: &Contradiction) -> ContradictionView {
    let state = &open.state;
    let constraints = names(open, &c.constraints);
    let anchors: Vec<String> = c.anchors.iter().map(|&a| place(open, a)).collect();
    let mut all = constraints.clone();
    all.extend(anchors.iter().map(|a| format!("the anchor of {a}")));
    let list = words::listed(&all);
    let (decided, message) = match (c.certainty, all.len()) {
        (Certainty::Contradiction, 1) => (true, format!("{list} cannot hold")),
        (Certainty::Contradiction, _) => {
            let proof = c.proof.as_ref().and_then(|p| combination(open, p));
            let proof = proof.map_or(String::new(), |p| format!(": {p}"));
            (true, format!("{list} contradict each other{proof}"))
        }
        (Certainty::NoSolution { starts }, 1) => {
            (true, format!("no solution of {list} was found, from {starts} starts"))
        }
        (Certainty::NoSolution { starts }, _) => {
            (true, format!("no solution of {list} together was found, from {starts} starts"))
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
            (
                false,
                format!(
                    "not decided whether {few}{more} can hold: no solution was found in {bound}"
                ),
            )
        }
    };
    let shown = |x: f64| base::number::rounded(x, 6);
    let set = |slot: SlotId, to: f64| {
        let mut values = state.values.clone();
        values.numbers[slot] = to;
        let (text, unit) = words::show_slot(state, slot, &values);
        format!("set {} to {}", state.slot_path(slot), format!("{text} {unit}").trim())
    };
    let repair = |r: &Repair| match *r {
        Repair::LeaveOut { source, sides } => {
            let name = words::source_name(state, source)?;
            let sides = sides.map_or(String::new(), |(left, right)| {
                format!("; its sides are then {} and {}", shown(left), shown(right))
            });
            Some(format!("delete {name} or switch it off{sides}"))
        }
        Repair::LetGo { slot } => Some(format!("let go of {}", place(open, slot))),
        Repair::Change { slot, to } => Some(set(slot, to)),
        Repair::Move { ref to } if to.len() <= FEW => {
            let each: Vec<String> = to.iter().map(|&(slot, to)| set(slot, to)).collect();
            Some(words::listed(&each))
        }
        Repair::Move { .. } => None,
    };
    let repairs = c.repairs.iter().filter_map(repair).collect();
    ContradictionView { constraints, anchors, decided, message, repairs }
}

/// Says a proof: `2 × a + b says 30, c says 31`.
fn combination(open: &Open, proof: &Combination) -> Option<String> {
    let shown = |x: f64| base::number::rounded(x, 6);
    let mut sum = String::new();
    for &(source, factor) in &proof.terms {
        let name = words::source_name(&open.state, source)?;
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
    let says = |said: Said| match said {
        Said::Is(x) => shown(x),
        Said::AtMost(x) => format!("at most {}", shown(x)),
        Said::AtLeast(x) => format!("at least {}", shown(x)),
    };
    let against = words::source_name(&open.state, proof.against)?;
    let (said, denied) = (says(proof.says), says(proof.denies));
    (!sum.is_empty()).then(|| format!("{sum} says {said}, {against} says {denied}"))
}

/// Returns the path of the place that a slot is a coordinate of, else its own.
fn place(open: &Open, slot: SlotId) -> String {
    let s = &open.state.structure.slots[slot];
    let thing = s.place.unwrap_or(s.thing);
    open.state.structure.path(&open.state.lowered.document, thing).to_string()
}
