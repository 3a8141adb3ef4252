//! What a parameter becomes by where it is used.
//!
//! A number without a unit is a length. Where such a parameter is first used as a count, an angle or a plain number it
//! becomes one, in the same step, and the hand is told so. Where it is a length for other steps already it stays one.
//! What a program hands on to itself, one more or less each time, counts the calls.

use super::catalogue::Slot;
use super::parameters::{self, DEGREES, Declared, Said};
use super::view::{Prompt, Turn};
use super::{Home, recording, text, typed};
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use crate::view::Refusal;
use crate::words;
use kernel::BinaryOperator;
use syntax::ast::{self, AstNode, BinaryOp, Expr};

/// Gives an operand that is typed. Where a parameter counts the calls of its program by it, or has to be something else
/// for it, it becomes that in the same step.
///
/// # Errors
/// The operand does not fit.
pub(crate) fn given(
    open: &mut Open,
    host: &dyn Host,
    (home, typed, wanted): (&Home, &str, &Slot),
    again: &dyn Fn(&mut Open) -> Result<Turn, Refusal>,
) -> Result<Turn, Refusal> {
    let made = open.dialogue.as_ref().map(|dialogue| dialogue.tool.class.to_string());
    let count = made.and_then(|made| counter(&open.state, home, (&made, &wanted.name, typed)));
    if let Some(turn) = count.and_then(|count| count.tried(open, host, again).ok()) {
        return Ok(turn);
    }
    again(open).or_else(|refused| retried(open, host, (home, typed, &wanted.class), refused, again))
}

/// Returns a parameter as a count, where a program gives it to itself one more or less and it is no length elsewhere.
fn counter(state: &State, home: &Home, (made, name, typed): (&str, &str, &str)) -> Option<Other> {
    let Home::Program { program, .. } = home else { return None };
    if *program.as_str() != *made || !is_one_on(&typed::expression(typed)?, name) {
        return None;
    }
    let source = text::Source::now(state);
    let is_it =
        |d: &Declared| d.name == name && d.class == "Length" && d.example.parse::<u32>().is_ok();
    let found = parameters::declared(&source, program).into_iter().find(is_it)?;
    let body = text::block(&source, program, "")?;
    let names = body.syntax().descendants().filter_map(ast::NameExpr::cast);
    let mut spoken = names.filter(|n| n.name().is_some_and(|word| word.text() == name));
    spoken.all(|n| counts(&n, (made, name))).then(|| Other::count(&source, &found))
}

/// Whether a word is used as a count is: compared with a number, or handed on to the program itself.
fn counts(word: &ast::NameExpr, (program, name): (&str, &str)) -> bool {
    let Some(Expr::Binary(around)) = word.syntax().parent().and_then(Expr::cast) else {
        return false;
    };
    let is_bare = |side: Option<Expr>| matches!(side, Some(Expr::Number(n)) if n.unit().is_none());
    let operator = around.op().and_then(lang::operator_of);
    if operator.is_some_and(BinaryOperator::is_comparison) {
        return is_bare(around.left()) || is_bare(around.right());
    }
    let labelled = around.syntax().parent().and_then(ast::Arg::cast);
    let is_own = labelled.and_then(|a| a.label()).is_some_and(|label| label.text() == name);
    let mut calls = around.syntax().ancestors().filter_map(ast::CallExpr::cast);
    let is_called = calls.next().and_then(|c| c.name()).is_some_and(|word| word.text() == program);
    is_own && is_called && is_one_on(&Expr::Binary(around), name)
}

/// Whether an expression is a name and a whole number more or less: `depth - 1`.
fn is_one_on(said: &Expr, name: &str) -> bool {
    let Expr::Binary(sum) = said else { return false };
    let is_sum = matches!(sum.op(), Some(BinaryOp::Add | BinaryOp::Subtract));
    let is_name = matches!(sum.left(), Some(Expr::Name(left)) if left.name().is_some_and(|w| w.text() == name));
    let by = sum.right().map(|right| right.syntax().text().to_string());
    is_sum && is_name && by.is_some_and(|by| by.trim().parse::<u32>().is_ok())
}

/// A parameter that may be something else than a length: what it would be, and the text that says so.
struct Other {
    name: String,
    class: &'static str,
    text: String,
    /// Why it stays a length.
    stays: Option<String>,
}

impl Other {
    /// A parameter as a count.
    fn count(source: &text::Source, of: &Declared) -> Self {
        let (range, example) = (of.range.clone(), of.example.clone());
        let said = Said { class: "Integer".into(), range, example, prompt: of.prompt.clone() };
        let text = said.instead_of(source, of);
        Self { name: of.name.clone(), class: "Integer", text, stays: None }
    }

    /// Whether something can be done with the parameter as that.
    fn fits(
        &self,
        open: &mut Open,
        host: &dyn Host,
        again: &dyn Fn(&mut Open) -> Result<Turn, Refusal>,
    ) -> bool {
        let dialogue = open.dialogue.clone();
        let mut fits = false;
        let _ = open.tried(|open| {
            recording::retext(open, host, self.text.clone(), String::new())?;
            fits = again(open).is_ok();
            // it is only tried
            Err::<(), _>(words::refuse(String::new()))
        });
        open.dialogue = dialogue;
        fits
    }

    /// Does something with the parameter as that; one step, which says so.
    ///
    /// # Errors
    /// What is refused then, and whether the parameter could be that.
    fn tried(
        &self,
        open: &mut Open,
        host: &dyn Host,
        again: &dyn Fn(&mut Open) -> Result<Turn, Refusal>,
    ) -> Result<Turn, (Refusal, bool)> {
        let since = open.done.len();
        let dialogue = open.dialogue.clone();
        let now = format!("{} is {}", self.name, class_in_words(self.class));
        let mut stood = None;
        let done = open.tried(|open| {
            stood = Some(recording::retext(open, host, self.text.clone(), now.clone())?);
            again(open)
        });
        match done {
            Ok(Turn::Made { change, name, text, next }) => {
                open.one_step(since);
                let next = next.map(|p| Prompt { words: format!("{now} now. {}", p.words), ..p });
                Ok(Turn::Made { change, name, text: format!("{text}; {now} now"), next })
            }
            // further operands are wanted: what it is now stands
            Ok(Turn::Wants(prompt)) => {
                let words = format!("{now} now. {}", prompt.words);
                let change = Box::new(stood.unwrap_or_default());
                let next = Some(Prompt { words, ..prompt });
                Ok(Turn::Made { change, name: now, text: String::new(), next })
            }
            Err(refusal) => {
                open.dialogue = dialogue;
                Err((refusal, stood.is_some()))
            }
        }
    }
}

/// Lists what the parameters that an expression speaks of may be where a class is wanted: those that were defined by a
/// number without a unit.
fn others(state: &State, home: &Home, typed: &str, wanted: &str) -> Vec<Other> {
    let Home::Program { program, .. } = home else { return Vec::new() };
    let source = text::Source::now(state);
    let is_alone = |name: &str| typed.trim() == name;
    let one = |d: Declared| {
        let is_plain = d.class == "Length" && d.example.parse::<f64>().is_ok();
        if !is_plain || text::places_of(typed, &d.name).is_empty() {
            return None;
        }
        let is_used = parameters::steps_that_speak(&source, program, &d.name).next().is_some();
        let is_whole = d.example.parse::<u32>().is_ok();
        let class = match wanted {
            "Integer" if is_whole => "Integer",
            "Angle" if is_alone(&d.name) => "Angle",
            "Real" | "Angle" | "Integer" if is_whole && !is_alone(&d.name) => "Integer",
            "Real" | "Angle" => "Real",
            // a length by how many: `w / (holes + 1)`
            "Point" | "Length" if is_whole && !is_alone(&d.name) => "Integer",
            _ => return None,
        };
        // a number without a unit is another one as an angle: in the range, where things are given it, in a demand
        let stays = match class {
            _ if is_used => Some("a length for other steps"),
            "Angle" if !d.range.is_empty() => Some("a length by its range"),
            "Angle" if !parameters::spoken_of(state, d.named).is_empty() => {
                Some("a length elsewhere, too")
            }
            _ => None,
        };
        let example = if class == "Angle" {
            parameters::in_unit(&d.example, DEGREES)
        } else {
            d.example.clone()
        };
        let said =
            Said { class: class.into(), range: d.range.clone(), example, prompt: d.prompt.clone() };
        let text = said.instead_of(&source, &d);
        Some(Other { name: d.name, class, text, stays: stays.map(String::from) })
    };
    parameters::declared(&source, program).into_iter().filter_map(one).collect()
}

/// Says what a parameter would become where a class is wanted.
pub(crate) fn may_become(
    state: &State,
    home: &Home,
    (typed, wanted): (&str, &str),
) -> Option<String> {
    let mut all = others(state, home, typed, wanted).into_iter().filter(|o| o.stays.is_none());
    let other = all.next().filter(|_| !is_of_lengths(wanted) || all.next().is_none())?;
    Some(format!("{} becomes {}", other.name, class_in_words(other.class)))
}

/// Does something again with a parameter as what is wanted of it, where that was refused: as a count, an angle, a plain
/// number. What is done is one step with it, and says so.
///
/// # Errors
/// What was refused, where no parameter can be something else.
pub(crate) fn retried(
    open: &mut Open,
    host: &dyn Host,
    (home, typed, wanted): (&Home, &str, &str),
    refused: Refusal,
    again: &dyn Fn(&mut Open) -> Result<Turn, Refusal>,
) -> Result<Turn, Refusal> {
    let others = others(&open.state, home, typed, wanted);
    let mut why = None;
    let mut may_be: Vec<&Other> = others.iter().filter(|other| other.stays.is_none()).collect();
    if is_of_lengths(wanted) {
        may_be.retain(|other| other.fits(open, host, again));
        if let [one, other, ..] = may_be.as_slice() {
            let message = format!("either {} or {} is a count: define which", one.name, other.name);
            return Err(words::refuse(message));
        }
    }
    for other in may_be {
        match other.tried(open, host, again) {
            Ok(turn) => return Ok(turn),
            Err((refusal, stood)) => {
                if stood {
                    why.get_or_insert(refusal);
                }
            }
        }
    }
    match others.first() {
        Some(Other { name, class, stays: Some(stays), .. }) if name == typed.trim() => {
            let wanted = class_in_words(class);
            let message = format!(
                "{name} is {stays}: where {wanted} is wanted, define one of the class {class}"
            );
            Err(words::refuse(message))
        }
        Some(_) | None => Err(why.unwrap_or(refused)),
    }
}

/// Whether what is wanted is said by lengths.
fn is_of_lengths(wanted: &str) -> bool {
    matches!(wanted, "Point" | "Length")
}

/// What a parameter of a class is, in words.
fn class_in_words(class: &str) -> &'static str {
    match class {
        "Integer" => "a count",
        "Angle" => "an angle",
        _ => "a plain number",
    }
}
