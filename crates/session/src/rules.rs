//! Rules: what a constraint is called in a sentence. One that has a name is called by it; of one without, people are
//! told what it says.

use crate::state::State;
use crate::words::{command_label, constraint_name, constraint_path, rule_alone, source_name};
use kernel::{Command, ConstraintInstance, DOCUMENT, Path, SlotId, Step};
use plan::Source;

/// The longest rule that is told, in letters.
const LONGEST: usize = 64;

/// Returns what a reader is told of a constraint: its path, or what it says where it has no name; nothing for a wish.
pub(crate) fn told(state: &State, source: Source) -> Option<String> {
    let name = source_name(state, source)?;
    match source {
        Source::Constraint(index) => Some(unnamed(state, index).unwrap_or(name)),
        Source::Stay(_) | Source::Wish(_) => Some(name),
    }
}

/// Returns what constraints are called.
pub(crate) fn all_told(state: &State, sources: &[Source]) -> Vec<String> {
    sources.iter().filter_map(|&source| told(state, source)).collect()
}

/// Says what holds anchored places, those that the text declares as constants apart: `the constant g`, `the anchor of p`.
pub(crate) fn anchors_told(state: &State, anchors: &[SlotId]) -> Vec<String> {
    let mut told = Vec::new();
    for &anchor in anchors {
        let place = state.place_path(anchor);
        let words = match state.is_constant(anchor) {
            true => format!("the constant {place}"),
            false => format!("the anchor of {place}"),
        };
        if !told.contains(&words) {
            told.push(words);
        }
    }
    told
}

/// Returns what a constraint says that has no name, in quotes; nothing where it has one, or says too much.
pub(crate) fn unnamed(state: &State, index: u32) -> Option<String> {
    let instance = state.structure.constraints[index as usize];
    let document = &state.lowered.document;
    if document.classes[instance.class].constraints[instance.index as usize].name.is_some() {
        return None;
    }
    let rule = rule_alone(state, index);
    let is_short = !rule.is_empty() && rule.chars().count() <= LONGEST && !rule.contains('\n');
    let said = is_short.then(|| format!("“{}”", rule_in_words(&rule)))?;
    if is_of_loop(state, instance) {
        // each of a loop says the same in words
        return Some(format!("{} ({said})", constraint_path(state, instance)));
    }
    Some(match instance.owner {
        DOCUMENT => said,
        owner => format!("{said} of {}", state.structure.path(document, owner)),
    })
}

/// Returns what the undo list calls a command: what it does with a constraint without a name, by what that says.
pub(crate) fn step_label(state: &State, command: &Command) -> String {
    let said = |path: &Path| {
        let (Step::Part(name), owner) = path.0.split_last()? else { return None };
        let owner = state.structure.follow(DOCUMENT, &Path(owner.to_vec())).ok()?;
        let all = state.structure.constraints.iter().enumerate();
        let mut own = all.filter(|(_, instance)| instance.owner == owner);
        let document = &state.lowered.document;
        let (index, _) = own.find(|(_, one)| constraint_name(document, **one) == **name)?;
        unnamed(state, u32::try_from(index).ok()?)
    };
    let Command::Enable { path, on } = command else { return command_label(command) };
    match said(path) {
        Some(said) => format!("switch {said} {}", if *on { "on" } else { "off" }),
        None => command_label(command),
    }
}

/// Whether a constraint is one of those that a loop makes of one line.
fn is_of_loop(state: &State, instance: ConstraintInstance) -> bool {
    let constraints = &state.lowered.document.classes[instance.class].constraints;
    let place = |index: usize| state.lowered.place(constraints[index].origin);
    let index = instance.index as usize;
    let own = place(index);
    (0..constraints.len()).any(|other| other != index && place(other) == own)
}

/// Returns a rule as a person says it: `a ∥ b` for `a.parallel(to: b)`, `length of a = 30 mm` for `a.length = 30 mm`;
/// any other as it is written.
///
/// ```
/// use session::rule_in_words;
/// assert_eq!(rule_in_words("a.perpendicular(to: b.side1)"), "a ⟂ b.side1");
/// assert_eq!(rule_in_words("a.perpendicular(to: Line(c.center, a.p2))"), "a touches c at a.p2");
/// assert_eq!(rule_in_words("circle.passes(through: line.p2)"), "circle passes through line.p2");
/// assert_eq!(rule_in_words("a.angle(to: b) = 30 deg"), "angle of a to b = 30 deg");
/// assert_eq!(rule_in_words("b.angle(to: -a) = 60 deg"), "angle between b and a = 60 deg");
/// assert_eq!(rule_in_words("q.side1.length = 30 mm"), "length of q.side1 = 30 mm");
/// assert_eq!(rule_in_words("a.length = b.length"), "a.length = b.length");
/// assert_eq!(rule_in_words("a.p1.y = a.p2.y"), "a.p1 is level with a.p2");
/// assert_eq!(rule_in_words("a.p1.x = b.p2.x"), "a.p1 is straight above or below b.p2");
/// assert_eq!(rule_in_words("x = 30"), "x = 30");
/// ```
pub fn rule_in_words(rule: &str) -> String {
    let (measured, value) = match rule.split_once(" = ") {
        Some((left, value)) if value.starts_with(|c: char| c.is_ascii_digit()) => (left, value),
        Some((left, right)) => return level(left, right).unwrap_or_else(|| rule.into()),
        None => {
            if let Some((one, circle, place)) = touching(rule) {
                return format!("{one} touches {circle} at {place}");
            }
            return asked(rule).map_or(rule.into(), |(one, verb, other)| match verb.as_str() {
                "parallel to" => format!("{one} ∥ {other}"),
                "perpendicular to" => format!("{one} ⟂ {other}"),
                _ => format!("{one} {verb} {other}"),
            });
        }
    };
    if let Some((one, other)) = corner(measured) {
        return format!("angle between {one} and {other} = {value}");
    }
    if let Some((one, verb, other)) = asked(measured) {
        let (what, way) = verb.split_once(' ').unwrap_or((&verb, "and"));
        return format!("{what} of {one} {way} {other} = {value}");
    }
    match measured.rsplit_once('.') {
        Some((whole, what)) if is_path(measured) => format!("{what} of {whole} = {value}"),
        _ => rule.into(),
    }
}

/// Says that two places are level, or one above the other.
fn level(left: &str, right: &str) -> Option<String> {
    let ((one, x), (other, y)) = (left.rsplit_once('.')?, right.rsplit_once('.')?);
    let said = match (x, y) {
        ("y", "y") => "is level with",
        ("x", "x") => "is straight above or below",
        _ => return None,
    };
    (is_path(one) && is_path(other)).then(|| format!("{one} {said} {other}"))
}

/// A line, the circle that it touches, and where: it is square to the radius there.
fn touching(rule: &str) -> Option<(&str, &str, &str)> {
    let (one, radius) = rule.strip_suffix("))")?.split_once(".perpendicular(to: Line(")?;
    let (circle, place) = radius.split_once(".center, ")?;
    [one, circle, place].into_iter().all(is_path).then_some((one, circle, place))
}

/// The two sides of an angle of which one is turned round at least, so that both run from their corner.
fn corner(measured: &str) -> Option<(&str, &str)> {
    let (one, other) = measured.strip_suffix(')')?.split_once(".angle(to: ")?;
    let first = one.strip_prefix("(-").and_then(|one| one.strip_suffix(')'));
    let second = other.strip_prefix('-');
    let is_turned = first.is_some() || second.is_some();
    let (one, other) = (first.unwrap_or(one), second.unwrap_or(other));
    (is_turned && is_path(one) && is_path(other)).then_some((one, other))
}

/// Takes apart what is asked of one thing about another: the one, the message with its label, and the other.
fn asked(rule: &str) -> Option<(&str, String, &str)> {
    let (to, argument) = rule.strip_suffix(')')?.split_once('(')?;
    let (one, message) = to.rsplit_once('.')?;
    let (label, other) = argument.split_once(": ")?;
    let is_plain = is_path(one) && is_path(other) && is_path(message) && is_path(label);
    is_plain.then(|| (one, format!("{message} {label}"), other))
}

fn is_path(text: &str) -> bool {
    text.starts_with(char::is_alphabetic)
        && text.chars().all(|c| c.is_alphanumeric() || "._[]".contains(c))
}
