//! The outcome of a construction: every way to turn its operands is tried over what is drawn now, and the one
//! nearest to where they were picked is taken; of equal ones that with the fewest reversals.
//!
//! What is shown as a ghost, what is written and what is drawn then are one answer.

use super::catalogue::{Call, Slot, SlotKind, Tool};
use super::dialogue::Operand;
use super::scene::{Curve, elements_of};
use super::{Home, compound, text};
use crate::state::State;
use crate::view::Refusal;
use crate::views::answers;
use crate::words;
use eval::{Answer, Evaluator};
use kernel::{ClassId, DOCUMENT, Path, ThingId};

/// The outcome that is taken.
#[derive(Clone, Debug)]
pub(crate) struct Chosen {
    /// How it is written.
    pub(crate) text: String,
    /// How it looks.
    pub(crate) drawing: drawing::Drawing,
    /// Where it lies, if it is a figure.
    pub(crate) curve: Option<Curve>,
}

/// Looks at what a trial came to.
type Look<'l> = dyn for<'a> FnMut(usize, &Evaluator<'a>, Result<Answer<'a>, eval::Fault>) + 'l;

/// Chooses among the outcomes of a construction from its operands, with where the pointer is: the nearest, or one
/// further away for each time that another was asked for.
///
/// # Errors
/// Why there is none.
pub(crate) fn choose(
    state: &State,
    home: &Home,
    (tool, operands, pointer, turned): (&Tool, &[Operand], Option<(f64, f64)>, usize),
) -> Result<Chosen, Refusal> {
    let ways = ways(tool, operands);
    let texts: Vec<String> = ways.iter().map(|(text, _)| text.clone()).collect();
    let picks: Vec<(f64, f64)> = operands.iter().filter_map(|o| o.at).chain(pointer).collect();
    let mut all: Vec<(f64, u32, Chosen)> = Vec::new();
    let mut why = None;
    let unwritten = try_all(state, home, &texts, &mut |i, evaluator, answer| {
        let answer = match answer {
            Ok(answer) => answer,
            Err(fault) => {
                why.get_or_insert(fault.message);
                return;
            }
        };
        if let Some(fault) = undrawn(evaluator, &answer) {
            why.get_or_insert(fault.message);
            return;
        }
        let curve = Curve::of(evaluator, &answer);
        let away = curve.map_or(0.0, |c| picks.iter().map(|&p| c.distance(p)).sum());
        let elements = elements_of(evaluator, &answer);
        let drawing = drawing::Drawing { elements, ..drawing::Drawing::default() };
        let chosen = Chosen { text: texts[i].clone(), drawing, curve };
        match all.iter_mut().find(|(_, _, other)| other.curve == curve) {
            // of equal ones that with the fewest reversals
            Some(known) if ways[i].1 < known.1 => *known = (away, ways[i].1, chosen),
            Some(_) => {}
            None => all.push((away, ways[i].1, chosen)),
        }
    });
    let is_as_far = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + b.abs());
    all.sort_by(|a, b| match is_as_far(a.0, b.0) {
        true => a.1.cmp(&b.1),
        false => a.0.total_cmp(&b.0),
    });
    if all.is_empty() {
        let why = unwritten.or(why).unwrap_or_else(|| "there is no such figure".into());
        return Err(words::refuse(why));
    }
    let at = turned % all.len();
    Ok(all.swap_remove(at).2)
}

/// Why a curve through places cannot be drawn: of weights there may be too few.
fn undrawn<'a>(evaluator: &Evaluator<'a>, answer: &Answer<'a>) -> Option<eval::Fault> {
    let class = evaluator.class_of(answer)?;
    let is_it = compound::is_of_places(evaluator.document, class);
    evaluator.pictured(answer).err().filter(|_| is_it)
}

/// Checks that an operand is what a slot wants.
///
/// # Errors
/// What it is instead, or what is wrong with its text.
pub(crate) fn fits(
    state: &State,
    home: &Home,
    (operand, slot): (&str, &Slot),
) -> Result<(), Refusal> {
    let mut outcome = Err(words::refuse(format!("{operand} has no value")));
    let texts = [operand.to_string()];
    let unwritten = try_all(state, home, &texts, &mut |_, evaluator, answer| {
        let document = evaluator.document;
        let is_wanted = |found: ClassId| {
            slot.classes().any(|class| {
                document.class_named(class).is_some_and(|wanted| document.is_a(found, wanted))
            })
        };
        let (class, kind) = (&slot.class, slot.kind);
        outcome = match answer {
            Err(fault) => Err(words::refuse(format!("{operand}: {}", fault.message))),
            Ok(Answer::List(_)) if slot.is_list => Ok(()),
            Ok(Answer::Number(..) | Answer::Bool(_) | Answer::Option(..))
                if kind == SlotKind::Value && **class != *"Text" =>
            {
                Ok(())
            }
            Ok(Answer::Text(_)) if kind == SlotKind::Value && **class == *"Text" => Ok(()),
            Ok(Answer::List(_) | Answer::Context(_))
                if matches!(kind, SlotKind::Set | SlotKind::Edges) || **class == *"Planar" =>
            {
                Ok(())
            }
            Ok(answer) => match evaluator.class_of(&answer) {
                Some(found) if is_wanted(found) => Ok(()),
                Some(found) => {
                    let found = &document.classes[found].name;
                    Err(words::refuse(format!("{operand} is a {found}, where a {class} is wanted")))
                }
                None => Err(words::refuse(format!(
                    "{operand} is {}, where a {class} is wanted",
                    answer.kind()
                ))),
            },
        };
    });
    match unwritten {
        Some(message) => Err(words::refuse(format!("{operand}: {message}"))),
        None => outcome,
    }
}

/// Returns what an expression comes to in a home, in words.
///
/// # Errors
/// Why it has no value.
pub(crate) fn worth(state: &State, home: &Home, text: &str) -> Result<Worth, Refusal> {
    let mut outcome = Err(words::refuse(format!("{text} has no value")));
    let texts = [text.to_string()];
    let unwritten = try_all(state, home, &texts, &mut |_, evaluator, answer| {
        outcome = match answer {
            Err(fault) => Err(words::refuse(fault.message)),
            Ok(Answer::Bool(truth)) => Ok(Worth::Truth(truth)),
            Ok(other) => Ok(match answers::in_words(evaluator.document, &other) {
                Some(number) => Worth::Number(number),
                None => Worth::Other(other.kind().to_string()),
            }),
        };
    });
    match unwritten {
        Some(message) => Err(words::refuse(message)),
        None => outcome,
    }
}

/// Returns the place that an expression says in a home; nothing where it says none.
pub(crate) fn place(state: &State, home: &Home, text: &str) -> Option<Curve> {
    let mut found = None;
    try_all(state, home, &[text.to_string()], &mut |_, evaluator, answer| {
        found = answer.ok().and_then(|answer| Curve::of(evaluator, &answer));
    });
    found.filter(Curve::is_point)
}

/// Returns how what an expression comes to in a home is drawn.
pub(crate) fn drawing_of(state: &State, home: &Home, text: &str) -> drawing::Drawing {
    let mut elements = Vec::new();
    try_all(state, home, &[text.to_string()], &mut |_, evaluator, answer| {
        elements = answer.map_or_else(|_| Vec::new(), |answer| elements_of(evaluator, &answer));
    });
    drawing::Drawing { elements, ..drawing::Drawing::default() }
}

/// What an expression comes to.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Worth {
    /// A yes or no.
    Truth(bool),
    /// A number, as it is read.
    Number(String),
    /// Something else: its kind.
    Other(String),
}

/// Reads the value of expressions in a home; returns what is wrong with the text of them all.
pub(crate) fn try_all(
    state: &State,
    home: &Home,
    texts: &[String],
    look: &mut Look<'_>,
) -> Option<String> {
    let texts = &from_outside(state, home, texts);
    let (class, me) = match reader(state, home) {
        Ok(found) => found,
        Err(refusal) => return Some(refusal.message),
    };
    let alone = lang::read_alone(&state.lowered, class, texts);
    // what made no class besides is read with what was looked up before
    let evaluator = match &alone.document {
        None => state.evaluator(&state.values),
        Some(document) => Evaluator::new(document, &state.structure, &state.values),
    };
    let mut wrong = None;
    let mut any = false;
    for (i, term) in alone.terms.iter().enumerate() {
        match term {
            Ok(term) => {
                any = true;
                look(i, &evaluator, evaluator.evaluate(term, me));
            }
            Err(said) => {
                let said = said.first().map(|d| d.message.clone());
                wrong.get_or_insert(said.unwrap_or_else(|| format!("{} means nothing", texts[i])));
            }
        }
    }
    wrong.filter(|_| !any)
}

/// Returns the class whose names a home reads, and its thing.
fn reader(state: &State, home: &Home) -> Result<(ClassId, ThingId), Refusal> {
    let document = &state.lowered.document;
    let Home::Program { program, .. } = home else { return Ok((document.root, DOCUMENT)) };
    let class = document.class_named(program);
    let path = Path(home.path().0.into_iter().take(1).collect());
    let example = state.structure.follow(DOCUMENT, &path).ok();
    let none = || words::refuse(format!("the document has no program {program} with an example"));
    class.zip(example).ok_or_else(none)
}

/// Says from the program what is said in the blocks that are open: their steps are `column[0].ring` there.
fn from_outside(state: &State, home: &Home, texts: &[String]) -> Vec<String> {
    let Home::Program { way, .. } = home else { return texts.to_vec() };
    // in the program itself names are as they are outside of blocks
    if way.iter().all(|around| around.name.is_none()) {
        return texts.to_vec();
    }
    let levels = text::visible(&text::Source::now(state), home);
    // from the innermost, whose names hide those of the blocks around it
    let mut prefixes = vec![String::new()];
    for around in way {
        let Some(name) = &around.name else { continue };
        let outer = prefixes.last().cloned().unwrap_or_default();
        let turn = around.turn.map_or(String::new(), |turn| format!("[{turn}]"));
        prefixes.push(format!("{outer}{name}{turn}."));
    }
    let outside = |text: &String| {
        let pairs = levels.iter().zip(&prefixes).skip(1).rev();
        pairs.fold(text.clone(), |text, (names, prefix)| {
            names
                .iter()
                .fold(text, |text, name| text::renamed(&text, name, &format!("{prefix}{name}")))
        })
    };
    texts.iter().map(outside).collect()
}

/// Returns every way to write a construction, with how many operands are turned round.
fn ways(tool: &Tool, operands: &[Operand]) -> Vec<(String, u32)> {
    let texts: Vec<String> = operands.iter().map(|o| o.text.clone()).collect();
    if !matches!(tool.call, Call::Class(_)) {
        return vec![(tool.written(&texts), 0)];
    }
    let is_curve = |i: &usize| tool.slots[*i].kind == SlotKind::Curve;
    let curves: Vec<usize> = (0..texts.len()).filter(is_curve).collect();
    let mut orders = vec![texts.clone()];
    // a point of points has one outcome, in the order of the picks
    let is_point_of = |slot: &Slot| slot.kind == SlotKind::Point && *tool.class == *slot.class;
    if let [a, b, ..] = tool.slots.as_slice()
        && a.class == b.class
        && !is_point_of(a)
        && texts.len() > 1
        && a.label.is_none()
    {
        let mut other = texts;
        other.swap(0, 1);
        orders.push(other);
    }
    let mut all = Vec::new();
    for (order, texts) in orders.iter().enumerate() {
        for turned in 0..1_u32 << curves.len() {
            let mut texts = texts.clone();
            for (bit, &i) in curves.iter().enumerate() {
                if turned >> bit & 1 == 1 {
                    texts[i] = turned_round(&texts[i]);
                }
            }
            // an order other than the picks' costs as much as a reversal
            all.push((tool.written(&texts), turned.count_ones() + order as u32));
        }
    }
    all
}

/// Writes a curve turned round.
pub(crate) fn turned_round(text: &str) -> String {
    let is_path = |t: &str| t.chars().all(text::is_of_path);
    match text.strip_prefix('-') {
        Some(rest) if is_path(rest) => rest.into(),
        _ if is_path(text) => format!("-{text}"),
        _ => format!("-({text})"),
    }
}
