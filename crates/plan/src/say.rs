//! What a rule says: a Bool expression in, equations and opaque rows out.
//!
//! Conjunctions are split, Bool messages opened, equalities of things taken part by part. What is
//! neither an equality nor decided by the text alone is a plain fault: it is not planned yet.

use crate::evaluate::{Opening, bind_arguments};
use crate::fault::{FaultKind, Trouble};
use crate::meaning::{Frame, Meaning, Opaque, collect_slots};
use crate::rule::{How, RuleMethod, Way};
use expr::{ExprId, Node};
use kernel::{BinaryOperator, SlotId, Term, UnaryOperator};
use std::collections::BTreeSet;

/// What a constraint says.
#[derive(Default)]
pub(crate) struct Said {
    /// Left and right sides that are equal.
    pub(crate) equations: Vec<[ExprId; 2]>,
    pub(crate) opaque: Vec<OpaqueRow>,
}

/// Something in a rule that only the host can test.
pub(crate) struct OpaqueRow {
    pub(crate) slots: BTreeSet<SlotId>,
    pub(crate) methods: Vec<RuleMethod<SlotId>>,
}

/// Whether a term is the whole rule, or a part of it or of a message that it opens into.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Standing {
    Whole,
    Part,
}

/// Collects what must hold where `term` is true.
pub(crate) fn say<'a>(
    opening: &mut Opening<'a>,
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
fn is_message(opening: &mut Opening<'_>, to: &Meaning<'_>, name: &str) -> bool {
    match to {
        Meaning::Thing(t) => opening.reach.part_named(*t, name).is_none(),
        Meaning::Made(made) => made.fields.iter().all(|f| f.0 != *name),
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
        say(opening, closure.body, &frame, Standing::Part, said)?;
    }
    Ok(())
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
    opening: &mut Opening<'a>,
    a: &Meaning<'a>,
    b: &Meaning<'a>,
    standing: Standing,
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
pub(crate) fn lone_slot(opening: &Opening<'_>, meaning: &Meaning<'_>) -> Option<SlotId> {
    match meaning {
        Meaning::Number(id) => match opening.arena.node(*id) {
            Node::Var(v) => Some(SlotId(v.0)),
            Node::Constant(_) | Node::Unary(..) | Node::Binary(..) | Node::Select { .. } => None,
        },
        Meaning::Opaque(Opaque { slot, .. }) => *slot,
        Meaning::Thing(_) | Meaning::Made(_) | Meaning::List(_) | Meaning::Lambda(_) => None,
    }
}
