//! The words that the language itself has: functions, units, quantities, as completion and the manual list them.

use expr::Dimension;
use expr::units::{NAMED_UNITS, PREFIXES};
use kernel::builtin::{
    Builtin, FUNCTIONS, Given, Kind, LIST_MESSAGES, NUMBER_MESSAGES, TEXT_MESSAGES,
};
use kernel::quantity::of_si;
use serde::Serialize;

/// A function of the language.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct FunctionWord {
    /// Its name.
    pub name: &'static str,
    /// How it is called: `atan2(y, x)`.
    pub call: String,
    /// What its arguments measure, in words.
    pub takes: String,
    /// What it answers, in words.
    pub answers: &'static str,
    /// For which numbers it has an answer; empty where it has one for all.
    pub domain: &'static str,
    /// What it does, in one sentence.
    pub doc: &'static str,
}

/// A unit.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct UnitWord {
    /// How it is written after a number.
    pub spelling: &'static str,
    /// Its name.
    pub name: &'static str,
    /// What it measures.
    pub quantity: String,
    /// Whether the prefixes of SI may stand before it.
    pub is_prefixed: bool,
}

/// Returns every function of the language, in the order of the manual.
///
/// ```
/// let all = session::vocabulary::functions();
/// let log10 = all.iter().find(|f| f.name == "log10").unwrap();
/// assert_eq!((log10.call.as_str(), log10.domain), ("log10(x)", "x > 0"));
/// ```
pub fn functions() -> Vec<FunctionWord> {
    FUNCTIONS.iter().map(word).collect()
}

/// Returns every message that numbers know.
pub fn messages_of_numbers() -> Vec<FunctionWord> {
    NUMBER_MESSAGES.iter().map(word).collect()
}

/// Returns every message that texts know.
///
/// ```
/// let all = session::vocabulary::messages_of_texts();
/// assert!(all.iter().any(|m| m.call == "padded(to, with)"));
/// ```
pub fn messages_of_texts() -> Vec<FunctionWord> {
    let measured = |w: FunctionWord| match w.answers {
        SAME => FunctionWord { answers: in_words(Kind::Length), ..w },
        _ => w,
    };
    TEXT_MESSAGES.iter().map(word).map(measured).collect()
}

/// Returns every message that lists and sets know.
pub fn messages_of_lists() -> Vec<FunctionWord> {
    let listed = |w: FunctionWord| match w.answers {
        SAME => FunctionWord { answers: in_words(Kind::List), ..w },
        _ => w,
    };
    LIST_MESSAGES.iter().map(word).map(listed).collect()
}

/// What numbers answer that measure what they are sent to.
const SAME: &str = "the same quantity";

fn word<F>(b: &Builtin<F>) -> FunctionWord {
    let label = |p: &kernel::builtin::BuiltinParameter| match p.given {
        Given::Many => format!("{}, …", p.label),
        Given::Once | Given::Perhaps => p.label.to_string(),
    };
    let labels: Vec<String> = b.parameters.iter().map(label).collect();
    let mut takes: Vec<&str> = b.parameters.iter().map(|p| in_words(p.kind)).collect();
    takes.dedup();
    FunctionWord {
        name: b.name,
        call: match labels.is_empty() {
            true => b.name.to_string(),
            false => format!("{}({})", b.name, labels.join(", ")),
        },
        takes: takes.join(", "),
        answers: in_words(b.result),
        domain: b.domain.words().unwrap_or_default(),
        doc: b.doc,
    }
}

/// Returns every unit without a prefix, by quantity.
///
/// ```
/// let all = session::vocabulary::units();
/// let volt = all.iter().find(|u| u.spelling == "V").unwrap();
/// assert!(volt.quantity == "Voltage" && volt.is_prefixed);
/// ```
pub fn units() -> Vec<UnitWord> {
    let word = |named: &expr::units::NamedUnit| {
        let dimension = named.unit.dimension;
        let is_angle = dimension.is_none() && !matches!(named.spelling, "%" | "ppm");
        let quantity = if is_angle { Some("Angle") } else { dimension.named() };
        UnitWord {
            spelling: named.spelling,
            name: named.name,
            quantity: quantity.map_or_else(|| dimension.to_string(), str::to_string),
            is_prefixed: named.is_prefixed,
        }
    };
    NAMED_UNITS.iter().map(word).collect()
}

/// Returns every quantity that a part may be, each with the unit of SI that it is shown in; empty for plain numbers.
pub fn quantities() -> Vec<(&'static str, String)> {
    let unit = |name: &str, dimension: Dimension| match of_si(name, dimension) {
        Some(unit) => unit.to_string(),
        None if dimension.is_none() => String::new(),
        None => dimension.to_string(),
    };
    let of = |name| Some((name, unit(name, Dimension::by_name(name)?)));
    Dimension::names().filter_map(of).collect()
}

/// Returns every prefix of SI: its letter, its name and its power of ten.
pub fn prefixes() -> [(&'static str, &'static str, i8); 24] {
    PREFIXES
}

/// Says what an argument may be, or what an answer is.
fn in_words(kind: Kind) -> &'static str {
    match kind {
        Kind::Plain => "a plain number",
        Kind::Number => "a number",
        Kind::Same => SAME,
        Kind::Root => "the root of the quantity",
        Kind::Length => "a length",
        Kind::Bool => "a truth value",
        Kind::Text => "a text",
        Kind::Color => "a colour",
        Kind::Place => "a place",
        Kind::List => "a list",
        Kind::Plains => "a list of plain numbers",
        Kind::Texts => "a list of texts",
        Kind::Measures => "a list of numbers",
        Kind::Ordered => "a list of numbers or texts",
        Kind::Alike | Kind::Beside => "a list",
        Kind::Numbers => "numbers of one quantity, or a list of these",
        Kind::Element => "an element",
        Kind::Answer => "an answer",
        Kind::Function | Kind::Test => "a function",
        Kind::Picture => "a picture",
        Kind::Pictures => "pictures",
        Kind::Any => "anything",
    }
}
