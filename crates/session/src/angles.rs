//! Which sides of rules are angles: they are said in degrees, as angles are.
//!
//! In: a side of a rule, and whose it is. Out: whether it is what is declared as an `Angle`, a sum of such or so many
//! times one. Among the numbers themselves an angle is a plain one.

use crate::by_hand::class_at;
use crate::state::State;
use crate::words;
use eval::{Answer, Evaluator};
use kernel::{BinaryOperator, ClassId, DOCUMENT, Path, Step, Term, ThingId};

/// The class of angles.
const ANGLE: &str = "Angle";
/// The functions that answer angles.
const ANSWERING: [&str; 4] = ["atan2", "atan", "asin", "acos"];

/// Returns the class by which both sides of a rule are shown: that of angles, where one of them is one, else none.
pub(crate) fn class_of_sides<'a>(
    state: &State,
    evaluator: &Evaluator<'a>,
    owner: ThingId,
    sides: [&'a Term; 2],
) -> &'static str {
    if sides.iter().any(|side| is_angle(state, evaluator, owner, side)) { ANGLE } else { "" }
}

fn is_angle<'a>(state: &State, evaluator: &Evaluator<'a>, owner: ThingId, term: &'a Term) -> bool {
    let of = |term: &'a Term| is_angle(state, evaluator, owner, term);
    let is_number = |term: &Term| matches!(term, Term::Number { .. });
    match term {
        Term::Unary(_, operand) => of(operand),
        Term::If(_, one, other) => of(one) || of(other),
        Term::Call { name, .. } => ANSWERING.contains(&name.as_str()),
        Term::Binary(BinaryOperator::Add | BinaryOperator::Subtract, a, b) => of(a) || of(b),
        Term::Binary(BinaryOperator::Multiply, a, b) => {
            is_number(a) && of(b) || is_number(b) && of(a)
        }
        Term::Binary(BinaryOperator::Divide, a, b) => is_number(b) && of(a),
        Term::Send { to, name, .. } => {
            let Ok(Answer::Thing(receiver)) = evaluator.evaluate(to, owner) else { return false };
            let structure = &state.structure;
            if let Ok(part) = structure.follow(receiver, &Path(vec![Step::Part(name.clone())])) {
                return words::class_name(state, part) == ANGLE;
            }
            let document = &state.lowered.document;
            let answers = document.find_message(structure.things[receiver].class, name, None);
            let is_it = |class: ClassId| *document.classes[class].name == *ANGLE;
            answers.and_then(|(_, message)| message.class).is_some_and(is_it)
        }
        _ => false,
    }
}

/// Returns true for a path to an angle that a class computes, or a step of a program is.
pub(crate) fn is_path_of_one(state: &State, path: &Path) -> bool {
    let document = &state.lowered.document;
    let Some((Step::Part(name), whole)) = path.0.split_last() else { return false };
    let whole = match whole {
        [] => Some(state.structure.things[DOCUMENT].class),
        _ => class_at(state, &Path(whole.to_vec())),
    };
    let message = whole.and_then(|class| document.find_message(class, name, None));
    let class = message.and_then(|(_, message)| message.class);
    class.is_some_and(|class| *document.classes[class].name == *"Angle")
}
