//! Rules over slots: what constraints and declared stays say, lowered once for the whole document.
//!
//! In: the constraints of a structure. Out: [`Rule`]s, whose expressions' variables are slots by
//! their number in the document. A constraint becomes one rule, or several where it speaks of
//! numbers and texts at once and has no methods of its own.

use crate::evaluate::{Opening, bind_arguments};
use crate::fault::{Fault, FaultKind, Trouble};
use crate::meaning::{Frame, Meaning, Opaque, collect_slots, slots_of_expression};
use expr::{ExprId, Node};
use kernel::{
    BinaryOperator, Constraint, ConstraintInstance, Method, Path, SlotId, StayInstance, Step,
    Strength, Structure, Term, ThingId, UnaryOperator,
};
use solve::{Equation, Level};
use std::collections::BTreeSet;

/// Where a rule comes from.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Source {
    /// The constraint of this index in the structure.
    Constraint(u32),
    /// The declared stay of this index in the structure.
    Stay(u32),
    /// The wish of this index in the edit.
    Wish(u32),
}

/// A constraint or a declared stay, over the slots of the document.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    pub(crate) source: Source,
    pub(crate) level: Level,
    pub(crate) body: Body,
    pub(crate) methods: Vec<RuleMethod>,
    pub(crate) derived: bool,
    pub(crate) reads: Vec<SlotId>,
    pub(crate) within: f64,
    /// Every slot that it mentions, in order.
    pub(crate) slots: Vec<SlotId>,
}

/// What a rule says.
#[derive(Clone, Debug)]
pub(crate) enum Body {
    /// Equations that hold together.
    Equations(Vec<Equation>),
    /// Something that only the host can test.
    Opaque(Vec<SlotId>),
    /// The slots keep the values that they had when the edit began.
    Hold(Vec<SlotId>),
}

/// A way to make a rule hold.
#[derive(Clone, Debug)]
pub(crate) struct RuleMethod {
    pub(crate) targets: Vec<SlotId>,
    pub(crate) reads: Vec<SlotId>,
    pub(crate) how: How,
}

/// How a method computes its targets.
#[derive(Clone, Debug)]
pub(crate) enum How {
    /// By one expression for each target.
    Expressions(Vec<ExprId>),
    /// The host does.
    Host(Way),
    /// The one target takes what is in the one slot that is read.
    Copy,
}

/// A way to make a constraint hold that only the host can go.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Way {
    /// The written method of this index.
    Written(u32),
    /// The left side of its `=` takes the value of the right side.
    Left,
    /// The right side takes the value of the left side.
    Right,
}

/// Lowers a declared stay. Anchors are no rules: their slots are fixed.
pub(crate) fn lower_stay(structure: &Structure, index: u32, stay: StayInstance) -> Option<Rule> {
    let level = level(stay.strength?);
    let slots = structure.slots_under(stay.thing);
    let numbers = slots.into_iter().filter(|&s| structure.slots[s].primitive.is_number());
    let slots: Vec<SlotId> = numbers.collect();
    Some(Rule {
        source: Source::Stay(index),
        level,
        body: Body::Hold(slots.clone()),
        methods: Vec::new(),
        derived: true,
        reads: Vec::new(),
        within: base::number::RULE_TOLERANCE,
        slots,
    })
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

/// Lowers a constraint of the structure; a switched-off one says nothing.
///
/// # Errors
/// What in it cannot be planned, at the constraint's or the method's place.
pub(crate) fn lower_constraint<'a>(
    opening: &mut Opening<'a, '_>,
    index: u32,
    instance: ConstraintInstance,
) -> Result<Vec<Rule>, Fault> {
    let constraint = &opening.document.classes[instance.class].constraints[instance.index as usize];
    if !constraint.enabled {
        return Ok(Vec::new());
    }
    opening.begin();
    let me = Frame::of(instance.owner);
    let parts = lower_parts(opening, constraint, &me).map_err(|t| t.at(constraint.origin))?;
    let methods: Result<Vec<RuleMethod>, Fault> = (0..)
        .zip(&constraint.methods)
        .map(|(i, m)| lower_method(opening, instance.owner, i, m).map_err(|t| t.at(m.origin)))
        .collect();
    let rule = Rule {
        source: Source::Constraint(index),
        level: level(constraint.strength),
        body: Body::Equations(Vec::new()),
        methods: methods?,
        derived: constraint.derived || constraint.methods.is_empty(),
        reads: parts.reads,
        within: parts.within,
        slots: Vec::new(),
    };
    Ok(assemble(opening, rule, parts.said))
}

/// Makes the rules of what a constraint says.
fn assemble(opening: &Opening<'_, '_>, rule: Rule, said: Said) -> Vec<Rule> {
    let arena = &*opening.arena;
    let mut rules = Vec::new();
    if said.opaque.is_empty() {
        rules.push(Rule { body: Body::Equations(said.equations), ..rule });
    } else if !rule.methods.is_empty() {
        // Written methods make the whole rule hold, so it is one.
        let mut slots: BTreeSet<SlotId> = BTreeSet::new();
        said.opaque.iter().for_each(|o| slots.extend(&o.slots));
        for e in &said.equations {
            slots.extend(slots_of_expression(arena, e.left));
            slots.extend(slots_of_expression(arena, e.right));
        }
        rules.push(Rule { body: Body::Opaque(slots.into_iter().collect()), ..rule });
    } else {
        if !said.equations.is_empty() {
            rules.push(Rule { body: Body::Equations(said.equations), ..rule.clone() });
        }
        rules.extend(said.opaque.into_iter().map(|o| Rule {
            body: Body::Opaque(o.slots.into_iter().collect()),
            methods: o.methods,
            ..rule.clone()
        }));
    }
    for rule in &mut rules {
        let mut slots: BTreeSet<SlotId> = rule.reads.iter().copied().collect();
        match &rule.body {
            Body::Equations(equations) => {
                for e in equations {
                    slots.extend(slots_of_expression(arena, e.left));
                    slots.extend(slots_of_expression(arena, e.right));
                }
            }
            Body::Opaque(over) | Body::Hold(over) => slots.extend(over),
        }
        for m in &rule.methods {
            slots.extend(m.targets.iter().chain(&m.reads));
        }
        rule.slots = slots.into_iter().collect();
    }
    rules
}

struct Parts {
    said: Said,
    reads: Vec<SlotId>,
    within: f64,
}

fn lower_parts<'a>(
    opening: &mut Opening<'a, '_>,
    constraint: &'a Constraint,
    me: &Frame<'a>,
) -> Result<Parts, Trouble> {
    let mut said = Said::default();
    say(opening, &constraint.rule, me, Standing::Whole, &mut said)?;
    let mut reads = BTreeSet::new();
    for path in &constraint.reads {
        let meaning = meaning_of_path(opening, &me.me, path)?;
        match meaning {
            Meaning::Thing(t) => reads.extend(opening.structure.slots_under(t)),
            other => collect_slots(opening.arena, &other, &mut reads),
        }
    }
    let within = match &constraint.within {
        None => base::number::RULE_TOLERANCE,
        Some(term) => {
            let meaning = opening.meaning(term, me)?;
            opening.constant(&meaning).ok_or_else(|| {
                Trouble::not_yet("a tolerance that depends on values is not planned yet")
            })?
        }
    };
    Ok(Parts { said, reads: reads.into_iter().collect(), within })
}

/// What a constraint says.
#[derive(Default)]
struct Said {
    equations: Vec<Equation>,
    opaque: Vec<OpaqueRow>,
}

struct OpaqueRow {
    slots: BTreeSet<SlotId>,
    methods: Vec<RuleMethod>,
}

/// Whether a term is the whole rule, or a part of it or of a message that it opens into.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Standing {
    Whole,
    Part,
}

/// Collects what must hold where `term` is true.
fn say<'a>(
    opening: &mut Opening<'a, '_>,
    term: &'a Term,
    frame: &Frame<'a>,
    standing: Standing,
    said: &mut Said,
) -> Result<(), Trouble> {
    match term {
        Term::Binary(BinaryOperator::Equal, a, b) => {
            let a = opening.meaning(a, frame)?;
            let b = opening.meaning(b, frame)?;
            equate(opening, &a, &b, standing, said)
        }
        Term::Binary(BinaryOperator::And, a, b) => {
            say(opening, a, frame, Standing::Part, said)?;
            say(opening, b, frame, Standing::Part, said)
        }
        Term::Let(name, bound, body) => {
            let bound = opening.meaning(bound, frame)?;
            say(opening, body, &frame.bind(name.clone(), bound), Standing::Part, said)
        }
        Term::If(condition, then, otherwise) => {
            let condition = opening.meaning(condition, frame)?;
            match opening.decided(&condition) {
                Some(true) => say(opening, then, frame, Standing::Part, said),
                Some(false) => say(opening, otherwise, frame, Standing::Part, said),
                None => Err(Trouble::not_yet("a rule under a condition is not planned yet")),
            }
        }
        Term::Unary(UnaryOperator::Not, operand) => {
            let operand = opening.meaning(operand, frame)?;
            want(opening, &operand, 0.0, said)
        }
        Term::Send { to, name, arguments, above } => {
            let to = opening.meaning(to, frame)?;
            if let (Some(message), true) =
                (opening.message(&to, name, *above), is_message(opening, &to, name))
            {
                let mut given = Vec::new();
                for a in arguments {
                    given.push((a.label.clone(), opening.meaning(&a.value, frame)?));
                }
                let frame = bind_arguments(Frame::new(to), message, &given)?;
                return opening.deeper(|o| say(o, &message.answer, &frame, Standing::Part, said));
            }
            if let ("all", [function], Ok(items)) =
                (name.as_str(), arguments.as_slice(), opening.items(&to))
            {
                return say_all(opening, &items, &function.value, frame, said);
            }
            let truth = opening.meaning(term, frame)?;
            want(opening, &truth, 1.0, said)
        }
        Term::Binary(..)
        | Term::Number { .. }
        | Term::Text(_)
        | Term::Bool(_)
        | Term::Me
        | Term::Owner
        | Term::Document
        | Term::Local(_)
        | Term::Call { .. }
        | Term::Make { .. }
        | Term::Tuple(_)
        | Term::List(_)
        | Term::Range(..)
        | Term::Index(..)
        | Term::Unary(..)
        | Term::Lambda(..)
        | Term::IsA(..)
        | Term::All(_)
        | Term::Copy(_) => {
            let truth = opening.meaning(term, frame)?;
            want(opening, &truth, 1.0, said)
        }
    }
}

/// Returns true if the name is not that of a stored part.
fn is_message(opening: &Opening<'_, '_>, to: &Meaning<'_>, name: &str) -> bool {
    match to {
        Meaning::Thing(t) => opening.structure.part_named(*t, name).is_none(),
        Meaning::Made(made) => made.fields.iter().all(|f| f.0 != *name),
        Meaning::Number(_) | Meaning::List(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => true,
    }
}

/// Says of every element what a function says of one.
fn say_all<'a>(
    opening: &mut Opening<'a, '_>,
    items: &[Meaning<'a>],
    function: &'a Term,
    frame: &Frame<'a>,
    said: &mut Said,
) -> Result<(), Trouble> {
    let Meaning::Lambda(closure) = opening.meaning(function, frame)? else {
        return Err(Trouble::wrong("`all` wants a function"));
    };
    for item in items {
        let frame = opening.closure_frame(&closure, std::slice::from_ref(item))?;
        say(opening, closure.body, &frame, Standing::Part, said)?;
    }
    Ok(())
}

/// Wants a truth value to be 1 or 0.
fn want<'a>(
    opening: &mut Opening<'a, '_>,
    truth: &Meaning<'a>,
    wanted: f64,
    said: &mut Said,
) -> Result<(), Trouble> {
    match truth {
        Meaning::Opaque(opaque) => {
            said.opaque.push(OpaqueRow { slots: (*opaque.slots).clone(), methods: Vec::new() });
            Ok(())
        }
        Meaning::Number(id) => match opening.arena.node(*id) {
            Node::Constant(bits) if (f64::from_bits(bits) != 0.0) == (wanted != 0.0) => Ok(()),
            Node::Constant(_) | Node::Var(_) => {
                let right = opening.arena.constant(wanted);
                said.equations.push(Equation { left: *id, right });
                Ok(())
            }
            Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => {
                Err(Trouble::not_yet("a rule that is not an equality is not planned yet"))
            }
        },
        Meaning::Thing(_) | Meaning::Made(_) => {
            Err(Trouble::not_yet("a rule that names a part is not planned yet"))
        }
        Meaning::List(_) | Meaning::Lambda(_) => {
            Err(Trouble::new(FaultKind::WrongKind, "a rule is true or false; this is neither"))
        }
    }
}

/// Makes two meanings equal, part by part.
fn equate<'a>(
    opening: &mut Opening<'a, '_>,
    a: &Meaning<'a>,
    b: &Meaning<'a>,
    standing: Standing,
    said: &mut Said,
) -> Result<(), Trouble> {
    for (left, right) in opening.leaves(a, b)? {
        if let (Meaning::Number(left), Meaning::Number(right)) = (&left, &right) {
            said.equations.push(Equation { left: *left, right: *right });
            continue;
        }
        let (l, r) = (lone_slot(opening, &left), lone_slot(opening, &right));
        let reads = |m: &Meaning<'a>| {
            let mut slots = BTreeSet::new();
            collect_slots(opening.arena, m, &mut slots);
            slots
        };
        let (ls, rs) = (reads(&left), reads(&right));
        let mut methods = Vec::new();
        if let (Some(l), Some(r)) = (l, r) {
            methods.push(RuleMethod { targets: vec![l], reads: vec![r], how: How::Copy });
            methods.push(RuleMethod { targets: vec![r], reads: vec![l], how: How::Copy });
        } else if standing == Standing::Whole {
            let mut way = |target: Option<SlotId>, from: &BTreeSet<SlotId>, way: Way| {
                if let Some(target) = target.filter(|t| !from.contains(t)) {
                    let reads = from.iter().copied().collect();
                    methods.push(RuleMethod { targets: vec![target], reads, how: How::Host(way) });
                }
            };
            way(l, &rs, Way::Left);
            way(r, &ls, Way::Right);
        }
        let slots = ls.union(&rs).copied().collect();
        said.opaque.push(OpaqueRow { slots, methods });
    }
    Ok(())
}

/// Returns the slot that a meaning is, where it is just what is stored there.
pub(crate) fn lone_slot(opening: &Opening<'_, '_>, meaning: &Meaning<'_>) -> Option<SlotId> {
    match meaning {
        Meaning::Number(id) => match opening.arena.node(*id) {
            Node::Var(v) => Some(SlotId(v.0)),
            Node::Constant(_) | Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
        },
        Meaning::Opaque(Opaque { slot, .. }) => *slot,
        Meaning::Thing(_) | Meaning::Made(_) | Meaning::List(_) | Meaning::Lambda(_) => None,
    }
}

/// Follows a path through parts, virtual ones included.
fn meaning_of_path<'a>(
    opening: &mut Opening<'a, '_>,
    from: &Meaning<'a>,
    path: &Path,
) -> Result<Meaning<'a>, Trouble> {
    let mut at = from.clone();
    for step in &path.0 {
        at = match step {
            Step::Part(name) => opening.send(&at, name, &[], None)?,
            Step::Index(_) | Step::Last => {
                let items = opening.items(&at)?;
                let item = match step {
                    Step::Index(i) => items.get(*i as usize),
                    Step::Last | Step::Part(_) | Step::Owner => items.last(),
                };
                item.cloned().ok_or_else(|| Trouble::wrong(format!("{path} leads nowhere")))?
            }
            Step::Owner => match at {
                Meaning::Thing(t) => {
                    let owner = opening.structure.things[t].owner;
                    Meaning::Thing(
                        owner.ok_or_else(|| Trouble::wrong("the document has no owner"))?,
                    )
                }
                Meaning::Number(_)
                | Meaning::Made(_)
                | Meaning::List(_)
                | Meaning::Opaque(_)
                | Meaning::Lambda(_) => return Err(Trouble::wrong("only a thing has an owner")),
            },
        };
    }
    Ok(at)
}

fn lower_method<'a>(
    opening: &mut Opening<'a, '_>,
    owner: ThingId,
    index: u32,
    method: &'a Method,
) -> Result<RuleMethod, Trouble> {
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
        let target = opening.structure.follow(owner, path).map_err(|_| {
            Trouble::not_yet(format!(
                "a method that writes {path}, which is not stored, is not planned yet"
            ))
        })?;
        for (slot, value) in opening.share(target, value)? {
            collect_slots(opening.arena, &value, &mut reads);
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
                | Meaning::Lambda(_) => opaque = true,
            }
        }
    }
    let how = if opaque { How::Host(Way::Written(index)) } else { How::Expressions(expressions) };
    Ok(RuleMethod { targets, reads: reads.into_iter().collect(), how })
}
