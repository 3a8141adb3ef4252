//! What a rule says: a Bool expression in, equations, truths and opaque rows out.
//!
//! Conjunctions are split, Bool messages opened, equalities of things taken part by part. What is no
//! equality (an inequality, alternatives) stays a truth; what stands under a condition is said for
//! either case.

use crate::evaluate::{Opening, bind_arguments};
use crate::fault::{FaultKind, Trouble};
use crate::meaning::{Frame, Meaning, Opaque, collect_slots, slots_of_expression};
use crate::rule::{How, RuleMethod, SideOf, Turns, Way};
use expr::{ExprId, Node, Unary, Var};
use kernel::{BinaryOperator, SlotId, Term, ThingId, UnaryOperator};
use std::collections::BTreeSet;

/// What a constraint says.
#[derive(Default)]
pub(crate) struct Said {
    /// Left and right sides that are equal.
    pub(crate) equations: Vec<[ExprId; 2]>,
    pub(crate) opaque: Vec<OpaqueRow>,
    /// Expressions that are true.
    pub(crate) truths: Vec<ExprId>,
    /// Expressions that are true, each with a number in it that the host computes.
    pub(crate) beside: Vec<Beside>,
    /// Expressions of which no two are equal.
    pub(crate) different: Vec<Vec<ExprId>>,
    /// What is said where a condition is true, and where it is false.
    pub(crate) branches: Vec<(Decides, [Said; 2])>,
    /// Things whose own rules hold.
    pub(crate) things: Vec<ThingId>,
}

/// What decides between branches.
pub(crate) enum Decides {
    /// An expression of numbers.
    Numbers(ExprId),
    /// Something that only the host can compute, from these slots.
    Host(SideOf, BTreeSet<SlotId>),
}

/// A comparison with a side that only the host can compute.
pub(crate) struct Beside {
    /// It, that side being the variable [`Beside::NUMBER`].
    pub(crate) truth: ExprId,
    pub(crate) side: SideOf,
    /// What the side is computed from.
    pub(crate) reads: BTreeSet<SlotId>,
}

impl Beside {
    /// Stands for the side that the host computes: no slot of a document.
    pub(crate) const NUMBER: Var = Var(u32::MAX);
}

/// Something in a rule that only the host can test.
pub(crate) struct OpaqueRow {
    pub(crate) slots: BTreeSet<SlotId>,
    pub(crate) methods: Vec<RuleMethod<SlotId>>,
}

/// Collects what must hold where `term` is true, a part of a rule to which these turns lead, if any do.
pub(crate) fn say<'a>(
    opening: &mut Opening<'a>,
    term: &'a Term,
    frame: &Frame<'a>,
    turns: Option<Turns>,
    said: &mut Said,
) -> Result<(), Trouble> {
    match term {
        Term::Binary(BinaryOperator::Equal, a, b) => {
            let a = opening.meaning(a, frame)?;
            let b = opening.meaning(b, frame)?;
            equate(opening, &a, &b, turns, said)
        }
        Term::Binary(BinaryOperator::And, a, b) => {
            say(opening, a, frame, first(turns), said)?;
            say(opening, b, frame, second(turns), said)
        }
        Term::Binary(BinaryOperator::Or, a, b) => either(opening, term, [a, b], frame, turns, said),
        Term::Let(name, bound, body) => {
            let bound = opening.meaning(bound, frame)?;
            say(opening, body, &frame.bind(name.clone(), bound), turns, said)
        }
        Term::If(condition, then, otherwise) => {
            let condition = opening.meaning(condition, frame)?;
            match opening.decided(&condition) {
                Some(true) => say(opening, then, frame, first(turns), said),
                Some(false) => say(opening, otherwise, frame, second(turns), said),
                None => {
                    let cases = cases(opening, [then, otherwise], frame, turns)?;
                    branch(opening, &condition, false, turns, cases, said)
                }
            }
        }
        Term::Call { name, arguments } if *name == "allDifferent" => {
            let mut items = Vec::new();
            for a in arguments {
                let meaning = opening.meaning(&a.value, frame)?;
                match opening.items(&meaning) {
                    Ok(list) => items.extend(list.iter().cloned()),
                    Err(_) => items.push(meaning),
                }
            }
            say_different(opening, &items, said)
        }
        Term::Binary(operator, a, b) if operator.is_order() => {
            let a = opening.meaning(a, frame)?;
            let b = opening.meaning(b, frame)?;
            match turns.and_then(|turns| beside(opening, *operator, [&a, &b], turns)) {
                Some(beside) => {
                    said.beside.push(beside);
                    Ok(())
                }
                None => {
                    let truth = opening.binary(*operator, &a, &b)?;
                    want(opening, &truth, 1.0, said)
                }
            }
        }
        Term::Unary(UnaryOperator::Not, operand) => {
            let operand = opening.meaning(operand, frame)?;
            want(opening, &operand, 0.0, said)
        }
        Term::Send { .. } => say_sent(opening, term, frame, turns, said),
        Term::Binary(..)
        | Term::Number { .. }
        | Term::Text(_)
        | Term::Bool(_)
        | Term::Option(..)
        | Term::Me
        | Term::Owner
        | Term::Document
        | Term::Local(_)
        | Term::Class(_)
        | Term::Construct { .. }
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
        | Term::Copy(_)
        | Term::Step(_)
        | Term::Result
        | Term::OfConstraint { .. } => want_true(opening, term, frame, said),
    }
}

/// Says that what a term stands for is true.
fn want_true<'a>(
    opening: &mut Opening<'a>,
    term: &'a Term,
    frame: &Frame<'a>,
    said: &mut Said,
) -> Result<(), Trouble> {
    let truth = opening.meaning(term, frame)?;
    want(opening, &truth, 1.0, said)
}

/// Says what a message answers where that is opened into its definition.
fn say_sent<'a>(
    opening: &mut Opening<'a>,
    term: &'a Term,
    frame: &Frame<'a>,
    turns: Option<Turns>,
    said: &mut Said,
) -> Result<(), Trouble> {
    if let Term::Send { to, name, arguments, .. } = term
        && let Term::Class(class) = **to
        && let Some((_, message)) = opening.document.find_message(class, name, None)
    {
        let given = opening.arguments(arguments, frame)?;
        let frame = bind_arguments(Frame::new(frame.me.clone()), message, &given)?;
        return opening.deeper(|o| say(o, &message.answer, &frame, turns, said));
    }
    if let Term::Send { to, name, arguments, search } = term {
        let to = opening.meaning(to, frame)?;
        if let (Some(message), true) =
            (opening.message(&to, name, *search), is_message(opening, &to, name))
        {
            let given = opening.arguments(arguments, frame)?;
            let frame = bind_arguments(Frame::new(to), message, &given)?;
            return opening.deeper(|o| say(o, &message.answer, &frame, turns, said));
        }
        if let ("all", [function], Ok(items)) =
            (name.as_str(), arguments.as_slice(), opening.items(&to))
        {
            return say_all(opening, &items, &function.value, frame, said);
        }
    }
    want_true(opening, term, frame, said)
}

/// Returns how one comes to the first of two parts of a rule: of an `and`, or what holds if a condition does.
fn first(turns: Option<Turns>) -> Option<Turns> {
    turns.and_then(|turns| turns.then(false))
}
/// Returns how one comes to the second of two.
fn second(turns: Option<Turns>) -> Option<Turns> {
    turns.and_then(|turns| turns.then(true))
}

/// Says an `or`: where a part of it that speaks of texts is not so, the other holds.
fn either<'a>(
    opening: &mut Opening<'a>,
    term: &'a Term,
    [a, b]: [&'a Term; 2],
    frame: &Frame<'a>,
    turns: Option<Turns>,
    said: &mut Said,
) -> Result<(), Trouble> {
    let Some((is_right, condition)) = said_of_texts(opening, [a, b], frame)? else {
        let truth = opening.meaning(term, frame)?;
        return want(opening, &truth, 1.0, said);
    };
    let (other, to_other) = if is_right { (a, first(turns)) } else { (b, second(turns)) };
    let mut cases = [Said::default(), Said::default()];
    say(opening, other, frame, to_other, &mut cases[1])?;
    branch(opening, &condition, is_right, turns, cases, said)
}

/// Returns which side of an `or` only the host can compute, where the other speaks of numbers alone: false for the
/// left one.
fn said_of_texts<'a>(
    opening: &mut Opening<'a>,
    [a, b]: [&'a Term; 2],
    frame: &Frame<'a>,
) -> Result<Option<(bool, Meaning<'a>)>, Trouble> {
    let left = opening.meaning(a, frame)?;
    if opening.decided(&left).is_some() {
        return Ok(None);
    }
    let right = opening.meaning(b, frame)?;
    Ok(match (&left, &right) {
        (Meaning::Opaque(_), Meaning::Number(_)) => Some((false, left)),
        (Meaning::Number(_), Meaning::Opaque(_)) => Some((true, right)),
        _ => None,
    })
}

/// Returns true if the name is not that of a stored part.
fn is_message(opening: &mut Opening<'_>, to: &Meaning<'_>, name: &str) -> bool {
    match to {
        Meaning::Thing(t) => opening.reach.part_named(*t, name).is_none(),
        Meaning::Made(made) => made.fields.iter().all(|f| f.0 != *name),
        Meaning::Drawn(drawn) => drawn.step(name).is_none(),
        Meaning::Number(_) | Meaning::List(_) | Meaning::Opaque(_) | Meaning::Lambda(_) => true,
    }
}

/// Says of every element what a function says of one.
fn say_all<'a>(
    opening: &mut Opening<'a>,
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
        say(opening, closure.body, &frame, None, said)?;
    }
    Ok(())
}

/// Returns a comparison of a number with what only the host can compute, if it is one, and the number is computed
/// from nothing of that.
fn beside<'a>(
    opening: &mut Opening<'a>,
    operator: BinaryOperator,
    sides: [&Meaning<'a>; 2],
    turns: Turns,
) -> Option<Beside> {
    let (number, other, is_right) = match sides {
        [Meaning::Number(number), Meaning::Opaque(other)] => (*number, other, true),
        [Meaning::Opaque(other), Meaning::Number(number)] => (*number, other, false),
        _ => return None,
    };
    let own = slots_of_expression(&opening.arena, number);
    if own.is_empty() || own.iter().any(|slot| other.slots.contains(slot)) {
        return None;
    }
    let computed = Meaning::Number(opening.arena.var(Beside::NUMBER));
    let number = Meaning::Number(number);
    let [left, right] = if is_right { [&number, &computed] } else { [&computed, &number] };
    let Meaning::Number(truth) = opening.binary(operator, left, right).ok()? else { return None };
    let reads = (*other.slots).clone();
    Some(Beside { truth, side: SideOf { turns, is_right }, reads })
}

/// Collects what holds where a condition is true, and where it is false.
fn cases<'a>(
    opening: &mut Opening<'a>,
    ways: [&'a Term; 2],
    frame: &Frame<'a>,
    turns: Option<Turns>,
) -> Result<[Said; 2], Trouble> {
    let mut cases = [Said::default(), Said::default()];
    let turns = [first(turns), second(turns)];
    for ((way, case), turns) in ways.into_iter().zip(&mut cases).zip(turns) {
        say(opening, way, frame, turns, case)?;
    }
    Ok(cases)
}

/// Says what holds in either case of a condition that depends on values, the `is_right` side of where turns lead.
fn branch<'a>(
    opening: &mut Opening<'a>,
    condition: &Meaning<'a>,
    is_right: bool,
    turns: Option<Turns>,
    cases: [Said; 2],
    said: &mut Said,
) -> Result<(), Trouble> {
    match (condition, turns) {
        (Meaning::Number(id), _) => said.branches.push((Decides::Numbers(*id), cases)),
        (Meaning::Opaque(opaque), Some(turns)) => {
            let side = SideOf { turns, is_right };
            said.branches.push((Decides::Host(side, (*opaque.slots).clone()), cases));
        }
        (Meaning::Opaque(opaque), None) => {
            // nobody could tell the host where this is: it tests all of it
            let mut slots = (*opaque.slots).clone();
            cases.iter().for_each(|case| case.collect_slots(opening, &mut slots));
            said.opaque.push(OpaqueRow { slots, methods: Vec::new() });
        }
        (
            Meaning::Thing(_)
            | Meaning::Made(_)
            | Meaning::List(_)
            | Meaning::Lambda(_)
            | Meaning::Drawn(_),
            _,
        ) => {
            let message = "a condition is true or false; this is neither";
            return Err(Trouble::new(FaultKind::WrongKind, message));
        }
    }
    Ok(())
}

/// Says that no two of some values are equal.
fn say_different<'a>(
    opening: &mut Opening<'a>,
    items: &[Meaning<'a>],
    said: &mut Said,
) -> Result<(), Trouble> {
    let number = |m: &Meaning<'a>| match m {
        Meaning::Number(id) => Some(*id),
        Meaning::Thing(_)
        | Meaning::Made(_)
        | Meaning::List(_)
        | Meaning::Opaque(_)
        | Meaning::Lambda(_)
        | Meaning::Drawn(_) => None,
    };
    if let Some(numbers) = items.iter().map(number).collect::<Option<Vec<ExprId>>>() {
        said.different.push(numbers);
        return Ok(());
    }
    let truth = opening.all_different(items)?;
    want(opening, &truth, 1.0, said)
}

impl Said {
    /// Adds every slot that it speaks of.
    pub(crate) fn collect_slots(&self, opening: &Opening<'_>, slots: &mut BTreeSet<SlotId>) {
        let numbers = |(decides, _): &(Decides, _)| match decides {
            Decides::Numbers(id) => Some(*id),
            Decides::Host(..) => None,
        };
        let conditions = self.branches.iter().filter_map(numbers);
        let sides = self.equations.iter().flatten().copied();
        let others = self.truths.iter().chain(self.different.iter().flatten()).copied();
        for id in sides.chain(others).chain(conditions) {
            slots.extend(opening.arena.variables(id).into_iter().map(|v| SlotId(v.0)));
        }
        for beside in &self.beside {
            let variables = opening.arena.variables(beside.truth).into_iter();
            slots.extend(variables.filter(|&v| v != Beside::NUMBER).map(|v| SlotId(v.0)));
            slots.extend(&beside.reads);
        }
        self.opaque.iter().for_each(|o| slots.extend(&o.slots));
        for (decides, cases) in &self.branches {
            if let Decides::Host(_, reads) = decides {
                slots.extend(reads);
            }
            cases.iter().for_each(|case| case.collect_slots(opening, slots));
        }
    }
}

/// Wants a truth value to be 1 or 0.
fn want<'a>(
    opening: &mut Opening<'a>,
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
                said.equations.push([*id, right]);
                Ok(())
            }
            Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => {
                let truth = if wanted == 0.0 { opening.arena.unary(Unary::Not, *id) } else { *id };
                said.truths.push(truth);
                Ok(())
            }
        },
        Meaning::Thing(thing) if wanted != 0.0 => {
            opening.reach.looks_around();
            said.things.push(*thing);
            Ok(())
        }
        Meaning::Thing(_)
        | Meaning::Made(_)
        | Meaning::List(_)
        | Meaning::Lambda(_)
        | Meaning::Drawn(_) => {
            Err(Trouble::new(FaultKind::WrongKind, "a rule is true or false; this is neither"))
        }
    }
}

/// Makes two meanings equal, part by part.
fn equate<'a>(
    opening: &mut Opening<'a>,
    a: &Meaning<'a>,
    b: &Meaning<'a>,
    turns: Option<Turns>,
    said: &mut Said,
) -> Result<(), Trouble> {
    for (left, right) in opening.leaves(a, b)? {
        if let (Meaning::Number(left), Meaning::Number(right)) = (&left, &right) {
            said.equations.push([*left, *right]);
            continue;
        }
        let (l, r) = (lone_slot(opening, &left), lone_slot(opening, &right));
        let reads = |m: &Meaning<'a>| {
            let mut slots = BTreeSet::new();
            collect_slots(&opening.arena, m, &mut slots);
            slots
        };
        let (ls, rs) = (reads(&left), reads(&right));
        let mut methods = Vec::new();
        if let (Some(l), Some(r)) = (l, r) {
            methods.push(RuleMethod { targets: vec![l], reads: vec![r], how: How::Copy });
            methods.push(RuleMethod { targets: vec![r], reads: vec![l], how: How::Copy });
        } else if let Some(turns) = turns {
            let mut way = |target: Option<SlotId>, from: &BTreeSet<SlotId>, way: Way| {
                if let Some(target) = target.filter(|t| !from.contains(t)) {
                    let reads = from.iter().copied().collect();
                    methods.push(RuleMethod { targets: vec![target], reads, how: How::Host(way) });
                }
            };
            way(l, &rs, Way::Left(turns));
            way(r, &ls, Way::Right(turns));
        }
        let slots = ls.union(&rs).copied().collect();
        said.opaque.push(OpaqueRow { slots, methods });
    }
    Ok(())
}

/// Returns the slot that a meaning is, where it is just what is stored there.
pub(crate) fn lone_slot(opening: &Opening<'_>, meaning: &Meaning<'_>) -> Option<SlotId> {
    match meaning {
        Meaning::Number(id) => match opening.arena.node(*id) {
            Node::Var(v) => Some(SlotId(v.0)),
            Node::Constant(_) | Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
        },
        Meaning::Opaque(Opaque { slot, .. }) => *slot,
        Meaning::Thing(_)
        | Meaning::Made(_)
        | Meaning::List(_)
        | Meaning::Lambda(_)
        | Meaning::Drawn(_) => None,
    }
}
