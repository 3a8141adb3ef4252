//! Lowering: constraints and declared stays become rules.
//!
//! In: a constraint of a thing. Out: what it says, over slots of the document. A constraint becomes
//! one rule, or several where it speaks of numbers and texts at once and has no methods of its own.

use crate::evaluate::Opening;
use crate::fault::{Fault, Trouble};
use crate::meaning::{Frame, Meaning, collect_slots, slots_of_expression};
use crate::rule::{
    Beside, Body, ByHost, Condition, Formula, How, RuleMethod, Rules, Shape, Source, Turns, Way,
    When,
};
use crate::say::{self, Decides, Said, say};
use base::number::Tolerance;
use expr::{Arena, ExprId, Node, Unary};
use kernel::{
    Constraint, ConstraintInstance, Method, Path, Setting, SlotId, StayInstance, Step, Strength,
    Structure, ThingId,
};
use solve::{Level, Patterns};
use std::collections::BTreeSet;

/// Returns the numbers that a declared stay holds. Anchors are no rules: their slots are fixed.
pub(crate) fn held(structure: &Structure, stay: StayInstance) -> Vec<SlotId> {
    let slots = structure.slots_under(stay.thing);
    slots.into_iter().filter(|&s| structure.slots[s].primitive.is_number()).collect()
}

/// Returns what a declared stay of so many slots says.
pub(crate) fn hold(strength: Strength, count: u32) -> Shape {
    Shape {
        level: stay_level(strength),
        body: Body::Hold((0..count).collect()),
        methods: Vec::new(),
        derived: true,
        reads: Vec::new(),
        within: Tolerance::Relative,
        when: Vec::new(),
    }
}

/// Returns the level at which a constraint of this strength stands.
pub(crate) fn level(strength: Strength) -> Level {
    match strength {
        Strength::Required => Level::Required,
        Strength::Strong => Level::Strong,
        Strength::Medium => Level::Medium,
        Strength::Weak => Level::Weak,
    }
}

/// Returns the level at which a declared stay of this strength stands: after the constraints.
fn stay_level(strength: Strength) -> Level {
    match strength {
        Strength::Required => Level::Required,
        Strength::Strong => Level::StrongStay,
        Strength::Medium => Level::MediumStay,
        Strength::Weak => Level::WeakStay,
    }
}

/// Lowers a constraint of the structure.
///
/// # Errors
/// What in it cannot be planned, at the constraint's or the method's place.
pub(crate) fn lower_constraint(
    opening: &mut Opening<'_>,
    patterns: &mut Patterns,
    instance: ConstraintInstance,
) -> Result<Lowered, Fault> {
    let constraint = &opening.document.classes[instance.class].constraints[instance.index as usize];
    opening.begin(instance.owner);
    let me = Frame::of(instance.owner);
    let parts = lower_parts(opening, constraint, &me).map_err(|t| t.at(constraint.origin))?;
    let Some(when) = lower_condition(opening, patterns, instance)? else {
        return Ok(Lowered::default());
    };
    let methods: Result<Vec<RuleMethod<SlotId>>, Fault> = (0..)
        .zip(&constraint.methods)
        .map(|(i, m)| {
            lower_method(opening, patterns, instance.owner, i, m).map_err(|t| t.at(m.origin))
        })
        .collect();
    let shape = Shape {
        level: level(opening.structure.strength(opening.document, instance)),
        body: Body::Equations(Vec::new()),
        methods: methods?,
        derived: constraint.derived || constraint.methods.is_empty(),
        reads: parts.reads,
        within: parts.within,
        when,
    };
    Ok(assemble(opening, patterns, shape, parts.said))
}

/// Lowers the condition under which a constraint is switched on: nothing where that is never, no
/// condition where it is always.
fn lower_condition(
    opening: &mut Opening<'_>,
    patterns: &mut Patterns,
    instance: ConstraintInstance,
) -> Result<Option<Vec<When<SlotId>>>, Fault> {
    let Some(&condition) = opening.structure.conditions.get(&instance) else {
        return Ok(Some(Vec::new()));
    };
    let switch = condition.switch(opening.document);
    let Setting::Enabled(term) = &switch.setting else { return Ok(Some(Vec::new())) };
    let meaning =
        opening.meaning(term, &Frame::of(condition.me)).map_err(|t| t.at(switch.origin))?;
    match (opening.decided(&meaning), meaning) {
        (Some(true), _) => Ok(Some(Vec::new())),
        (Some(false), _) => Ok(None),
        (None, Meaning::Number(id)) => {
            let condition = Condition::Numbers(Formula::of(patterns, &opening.arena, &[id]));
            Ok(Some(vec![When { condition, truth: true }]))
        }
        (
            None,
            Meaning::Thing(_)
            | Meaning::Made(_)
            | Meaning::List(_)
            | Meaning::Opaque(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_),
        ) => {
            let message = "a switch that depends on texts or things is not planned yet";
            Err(Trouble::not_yet(message).at(switch.origin))
        }
    }
}

/// Makes the rules of what a constraint says.
fn assemble(
    opening: &mut Opening<'_>,
    patterns: &mut Patterns,
    shape: Shape<SlotId>,
    mut said: Said,
) -> Lowered {
    let mut lowered = Lowered::default();
    if shape.level == Level::Required {
        said.equations.iter_mut().for_each(|sides| *sides = without_roots(&opening.arena, *sides));
    }
    let is_plain = said.branches.is_empty()
        && said.truths.is_empty()
        && said.beside.is_empty()
        && said.different.is_empty()
        && said.opaque.is_empty();
    if !shape.methods.is_empty() && !is_plain {
        // Written methods make the whole rule hold, so it is one.
        let mut slots: BTreeSet<SlotId> = BTreeSet::new();
        said.collect_slots(opening, &mut slots);
        lowered.shapes.push(Shape { body: Body::Opaque(slots.into_iter().collect()), ..shape });
    } else if is_plain {
        let equations =
            said.equations.iter().map(|e| Formula::of(patterns, &opening.arena, e)).collect();
        lowered.shapes.push(Shape { body: Body::Equations(equations), ..shape });
    } else {
        add_rules(opening, patterns, &shape, said, &mut lowered);
    }
    lowered
}

/// Returns what two square roots are of, which are equal where those are; anything else as it is. Distances that are
/// equal make a line of what squares make a curve, and have a slope where they are nothing.
fn without_roots(arena: &Arena, sides: [ExprId; 2]) -> [ExprId; 2] {
    match sides.map(|side| arena.node(side)) {
        [Node::Unary(Unary::Sqrt, a), Node::Unary(Unary::Sqrt, b)] => [a, b],
        _ => sides,
    }
}

/// Adds a rule for everything that is said, each under the conditions of `like`.
fn add_rules(
    opening: &mut Opening<'_>,
    patterns: &mut Patterns,
    like: &Shape<SlotId>,
    said: Said,
    lowered: &mut Lowered,
) {
    let mut add = |body| lowered.shapes.push(Shape { body, ..like.clone() });
    for said in said.beside {
        let (pattern, mut arguments) = patterns.intern(&opening.arena, &[said.truth]);
        let place = arguments.iter().position(|&v| v == say::Beside::NUMBER).unwrap_or(0);
        arguments.remove(place);
        let slots = arguments.into_iter().map(|v| SlotId(v.0)).collect();
        add(Body::Beside(Beside {
            truth: Formula { pattern, slots },
            place: place as u32,
            side: said.side,
            reads: said.reads.into_iter().collect(),
        }));
    }
    let mut formula = |roots: &[ExprId]| Formula::of(patterns, &opening.arena, roots);
    if !said.equations.is_empty() {
        add(Body::Equations(said.equations.iter().map(|e| formula(e)).collect()));
    }
    said.truths.iter().for_each(|&truth| add(Body::True(formula(&[truth]))));
    said.different.iter().for_each(|all| add(Body::Different(formula(all))));
    lowered.shapes.extend(said.opaque.into_iter().map(|o| Shape {
        body: Body::Opaque(o.slots.into_iter().collect()),
        methods: o.methods,
        ..like.clone()
    }));
    if !like.when.is_empty() {
        lowered.things.extend(said.things.into_iter().map(|t| (t, like.when.clone())));
    }
    for (condition, cases) in said.branches {
        let condition = match condition {
            Decides::Numbers(id) => {
                Condition::Numbers(Formula::of(patterns, &opening.arena, &[id]))
            }
            Decides::Host(side, reads) => {
                let truth = opening.arena.var(say::Beside::NUMBER);
                let (pattern, _) = patterns.intern(&opening.arena, &[truth]);
                let reads = reads.into_iter().collect();
                Condition::Host(ByHost { pattern, constraint: None, side, reads })
            }
        };
        for (case, truth) in cases.into_iter().zip([true, false]) {
            let mut like = like.clone();
            like.when.push(When { condition: condition.clone(), truth });
            add_rules(opening, patterns, &like, case, lowered);
        }
    }
}

/// What came of a constraint.
#[derive(Default)]
pub(crate) struct Lowered {
    /// Its rules.
    pub(crate) shapes: Vec<Shape<SlotId>>,
    /// Things whose own rules hold only under these conditions.
    pub(crate) things: Vec<(ThingId, Vec<When<SlotId>>)>,
}

/// Makes the rules of things that a branch names hold under its conditions alone.
pub(crate) fn guard(
    structure: &Structure,
    rules: &mut Rules,
    guarded: &[(ThingId, Vec<When<SlotId>>)],
) {
    if guarded.is_empty() {
        return;
    }
    for rule in 0..rules.len() as u32 {
        let Source::Constraint(index) = rules.source(rule) else { continue };
        let mut at = Some(structure.constraints[index as usize].owner);
        while let Some(thing) = at {
            for (named, when) in guarded {
                if structure.merged[*named] == structure.merged[thing] {
                    rules.guard(rule, when);
                }
            }
            at = structure.things[thing].owner;
        }
    }
}

struct Parts {
    said: Said,
    reads: Vec<SlotId>,
    within: Tolerance,
}

fn lower_parts<'a>(
    opening: &mut Opening<'a>,
    constraint: &'a Constraint,
    me: &Frame<'a>,
) -> Result<Parts, Trouble> {
    let mut said = Said::default();
    say(opening, &constraint.rule, me, Some(Turns::NONE), &mut said)?;
    let mut reads = BTreeSet::new();
    for path in &constraint.reads {
        let meaning = meaning_of_path(opening, &me.me, path)?;
        match meaning {
            Meaning::Thing(t) => reads.extend(opening.reach.slots_under(t)),
            other => collect_slots(&opening.arena, &other, &mut reads),
        }
    }
    // what decides on the course of a program alone: another value of it may ask for another rule
    if !opening.decisions.is_empty() {
        let mut own = BTreeSet::new();
        said.collect_slots(opening, &mut own);
        for decision in &opening.decisions {
            let decides = slots_of_expression(&opening.arena, decision.of);
            reads.extend(decides.difference(&own));
        }
    }
    let within = match &constraint.within {
        None => Tolerance::Relative,
        Some(term) => {
            let meaning = opening.meaning(term, me)?;
            let within = opening.constant(&meaning).ok_or_else(|| {
                Trouble::not_yet("a tolerance that depends on values is not planned yet")
            })?;
            match term.is_part() {
                true => Tolerance::part(within),
                false => Tolerance::within(within),
            }
        }
    };
    Ok(Parts { said, reads: reads.into_iter().collect(), within })
}

/// Follows a path through parts, virtual ones included.
fn meaning_of_path<'a>(
    opening: &mut Opening<'a>,
    from: &Meaning<'a>,
    path: &Path,
) -> Result<Meaning<'a>, Trouble> {
    let mut at = from.clone();
    for step in &path.0 {
        at = match step {
            Step::Part(name) => opening.send(&at, name, &[], None)?,
            Step::Index(_) | Step::Last => {
                let count = opening.count(&at)?;
                let place = match step {
                    Step::Index(i) => Some(*i as usize).filter(|&i| i < count),
                    Step::Last | Step::Part(_) | Step::Owner => count.checked_sub(1),
                };
                let nowhere = || Trouble::wrong(format!("{path} leads nowhere"));
                opening.item(&at, place.ok_or_else(nowhere)?)?
            }
            Step::Owner => match at {
                Meaning::Thing(t) => {
                    let owner = opening.reach.owner(t);
                    Meaning::Thing(
                        owner.ok_or_else(|| Trouble::wrong("the document has no owner"))?,
                    )
                }
                Meaning::Number(_)
                | Meaning::Made(_)
                | Meaning::List(_)
                | Meaning::Opaque(_)
                | Meaning::Lambda(_)
                | Meaning::Drawn(_) => return Err(Trouble::wrong("only a thing has an owner")),
            },
        };
    }
    Ok(at)
}

fn lower_method<'a>(
    opening: &mut Opening<'a>,
    patterns: &mut Patterns,
    owner: ThingId,
    index: u32,
    method: &'a Method,
) -> Result<RuleMethod<SlotId>, Trouble> {
    let frame = Frame::of(owner);
    let values: Result<Vec<Meaning<'a>>, _> =
        method.values.iter().map(|v| opening.meaning(v, &frame)).collect();
    let mut values = values?;
    if let ([Meaning::List(items)], true) = (values.as_slice(), method.targets.len() > 1) {
        values = items.to_vec();
    }
    if values.len() != method.targets.len() {
        let message = format!("{} values for {} targets", values.len(), method.targets.len());
        return Err(Trouble::wrong(message));
    }
    let mut targets = Vec::new();
    let mut expressions = Vec::new();
    let mut opaque = false;
    let mut reads = BTreeSet::new();
    for (path, value) in method.targets.iter().zip(&values) {
        let target = opening.reach.follow(owner, path).ok_or_else(|| {
            Trouble::not_yet(format!(
                "a method that writes {path}, which is not stored, is not planned yet"
            ))
        })?;
        for (slot, value) in opening.share(target, value)? {
            collect_slots(&opening.arena, &value, &mut reads);
            targets.push(slot);
            match value {
                Meaning::Number(id) if opening.structure.slots[slot].primitive.is_number() => {
                    expressions.push(id);
                }
                Meaning::Number(_)
                | Meaning::Opaque(_)
                | Meaning::Thing(_)
                | Meaning::Made(_)
                | Meaning::List(_)
                | Meaning::Lambda(_)
                | Meaning::Drawn(_) => opaque = true,
            }
        }
    }
    let how = if opaque {
        How::Host(Way::Written(index))
    } else {
        How::Formulas(Formula::of(patterns, &opening.arena, &expressions))
    };
    Ok(RuleMethod { targets, reads: reads.into_iter().collect(), how })
}
