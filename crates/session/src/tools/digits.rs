//! The digits that a thing is written with: those that only rounding has made are left out.

use super::member_of;
use crate::document::Open;
use crate::host::Host;
use crate::state::State;
use base::number::{RULE_TOLERANCE, rounded, shortest};
use kernel::{ThingId, Value, Values};
use std::collections::BTreeMap;
use syntax::ast::{AstNode, NumberExpr, UnaryExpr, UnaryOp};
use syntax::{SyntaxKind, SyntaxNode, TextEdit};

/// What of a number is no more than rounding.
#[derive(Clone, Copy)]
pub(super) struct Rounding {
    /// A longer decimal has digits that somebody may mean.
    longest: usize,
    /// So many digits behind the first one of a value are more than rounding.
    digits: i32,
    /// How far a value may be from what it was, as a part of the largest number of its tuple.
    like: f64,
}

/// A decimal that is computed and longer has digits that somebody may mean.
const LONGEST: usize = 9;
/// So many digits behind the first one of a computed value are more than rounding.
const DIGITS: i32 = 12;
/// How far a computed value may be from what it was, as a part of the largest number of its tuple.
const LIKE: f64 = 1e-12;
/// The same of what is solved: longest decimal.
const LONGEST_SOLVED: usize = 13;
/// The same of what is solved: digits behind the first one.
const DIGITS_SOLVED: i32 = 9;

/// That of computing.
pub(super) const COMPUTED: Rounding = Rounding { longest: LONGEST, digits: DIGITS, like: LIKE };
/// That of solving: what is drawn by hand and follows from a constraint is known to a rule's tolerance.
pub(super) const SOLVED: Rounding =
    Rounding { longest: LONGEST_SOLVED, digits: DIGITS_SOLVED, like: RULE_TOLERANCE };

/// Returns what a text says of one of its things, without digits that only rounding has made, of the first sort that
/// leaves what it is; as it stands where none does.
pub(super) fn without_noise(
    trial: &Open,
    name: &str,
    sorts: &[Rounding],
    host: &dyn Host,
) -> String {
    let member = member_of(&trial.state.text, name);
    let stands = |short: &String, rounding: Rounding| {
        let again = Open::of(&trial.name, trial.state.text.replacen(&member, short, 1), host);
        let state = &again.state;
        let holds = again.status.satisfied && state.gave_way.is_empty() && !state.has_errors();
        holds && has_values(state, &trial.state.values, rounding.like)
    };
    for &rounding in sorts {
        let short = shortened(&member, rounding);
        if short != member && stands(&short, rounding) {
            return short;
        }
    }
    member
}

/// Whether a text, written shorter, says as well what another does: the same values but for rounding, and as much of it
/// holds.
pub(super) fn is_like(short: &Open, long: &Open) -> bool {
    let (now, was) = (&short.state, &long.state);
    let holds = short.status.satisfied || !long.status.satisfied;
    let yields = now.gave_way.len() > was.gave_way.len();
    let errors = now.has_errors() && !was.has_errors();
    holds && !yields && !errors && has_values(now, &was.values, RULE_TOLERANCE)
}

/// Returns what a text says of a thing that was moved by so far, its numbers as short as they were before: those that come
/// to as few decimals but for rounding.
pub(super) fn as_short_as(was: &str, now: &str, far: f64) -> String {
    /// So small a part of the largest number is rounding.
    const ROUNDING: f64 = 1e-11;
    /// A number may stand in a unit that is so many powers of ten larger.
    const LARGER_UNIT: usize = 3;
    let numbers = |text: &str| -> Vec<NumberExpr> {
        let tree = syntax::parse(base::FileId(0), text).syntax();
        tree.descendants().filter_map(NumberExpr::cast).collect()
    };
    let (before, after) = (numbers(was), numbers(now));
    let decimals = |number: &NumberExpr| number.value().map_or(0, count_decimals);
    let most = before.iter().map(decimals).max().unwrap_or(0);
    let size = before.iter().chain(&after).filter_map(NumberExpr::value).fold(far.abs(), f64::max);
    let of_far = count_decimals(far) + LARGER_UNIT;
    let short = |(n, number): (usize, &NumberExpr)| {
        let (digits, x) = (number.digits()?, number.value()?);
        let its = before.get(n).filter(|_| before.len() == after.len()).map_or(most, decimals);
        let round: f64 = rounded(x, its.max(of_far)).parse().ok()?;
        let text = shortest(round);
        let is_rounding = (round - x).abs() <= ROUNDING * size && text.len() < digits.text().len();
        is_rounding.then(|| {
            // zero has no sign
            let span = if round == 0.0 { syntax::span_of(&signed(number)) } else { digits.span() };
            TextEdit { span, insert: text }
        })
    };
    let edits: Vec<TextEdit> = after.iter().enumerate().filter_map(short).collect();
    syntax::edit::apply(now, &edits)
}

/// Whether the values of a state are like others of the same things: apart by no more than such a part of themselves, or
/// of the largest coordinate of their place and of the other places of its thing.
pub(crate) fn has_values(now: &State, was: &Values, like: f64) -> bool {
    let (slots, things) = (&now.structure.slots, &now.structure.things);
    // a place of the document's own is measured by itself
    let whole = |place: ThingId| {
        let owner = things[place].owner.filter(|owner| things[*owner].owner.is_some());
        owner.unwrap_or(place)
    };
    let mut largest: BTreeMap<ThingId, f64> = BTreeMap::new();
    for (slot, of) in slots.iter() {
        if let (Some(place), Value::Number(x)) = (of.place, was.get(slot)) {
            let known = largest.entry(whole(place)).or_default();
            *known = known.max(x.abs());
        }
    }
    let is_like = |a: f64, b: f64, place: Option<ThingId>| {
        let size = place.and_then(|place| largest.get(&whole(place)).copied()).unwrap_or(a.abs());
        a == b || (a - b).abs() <= like * size
    };
    slots.len() == was.numbers.len()
        && slots.iter().all(|(slot, of)| match (was.get(slot), now.values.get(slot)) {
            (Value::Number(a), Value::Number(b)) => is_like(a, b, of.place),
            (a, b) => a.same_bits(&b),
        })
}

/// Returns a text with its numbers to some digits of themselves, and those of its places to some digits of the places'
/// largest, where they are much shorter so.
fn shortened(text: &str, rounding: Rounding) -> String {
    let tree = syntax::parse(base::FileId(0), text).syntax();
    let tuples = tree.descendants().filter(|node| node.kind() == SyntaxKind::TupleExpr);
    let size = tuples.map(|tuple| largest(&tuple)).fold(0.0, f64::max);
    let numbers = tree.descendants().filter_map(NumberExpr::cast);
    let edits: Vec<TextEdit> =
        numbers.filter_map(|number| shorter(&number, size, rounding)).collect();
    syntax::edit::apply(text, &edits)
}

/// Returns the edit that shortens a number; none where it is as short as it can be, or stands within quotes.
fn shorter(number: &NumberExpr, size: f64, rounding: Rounding) -> Option<TextEdit> {
    let (digits, x) = (number.digits()?, number.value()?);
    if number.syntax().ancestors().any(|node| node.kind() == SyntaxKind::TextExpr) {
        return None;
    }
    let signed = signed(number);
    let is_of_place = signed.parent().is_some_and(|node| node.kind() == SyntaxKind::TupleExpr);
    let short = decimal(x, if is_of_place { size } else { x }, rounding.digits);
    if short.len() > rounding.longest || short.len() >= digits.text().len() {
        return None;
    }
    let span = digits.span();
    // zero has no sign
    let span = if short == "0" { syntax::span_of(&signed).join(span) } else { span };
    Some(TextEdit { span, insert: short })
}

/// Returns a number with its sign, where it has one.
fn signed(number: &NumberExpr) -> SyntaxNode {
    let node = number.syntax();
    let unary = node.parent().and_then(UnaryExpr::cast);
    let minus = unary.filter(|unary| unary.op() == Some(UnaryOp::Negate));
    minus.map_or_else(|| node.clone(), |minus| minus.syntax().clone())
}

/// Returns the largest size of the numbers that are coordinates of a tuple.
fn largest(tuple: &SyntaxNode) -> f64 {
    let numbers = tuple.descendants().filter_map(NumberExpr::cast);
    let own = numbers.filter(|number| signed(number).parent().as_ref() == Some(tuple));
    own.filter_map(|number| number.value()).fold(0.0, f64::max)
}

/// Returns how many decimals a number has: digits behind the point, as long as it is written without an exponent.
pub(super) fn count_decimals(x: f64) -> usize {
    let written = shortest(x);
    let (digits, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let behind = digits.split_once('.').map_or(0, |(_, behind)| behind.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let shift = usize::try_from(exponent.unsigned_abs()).unwrap_or(0);
    if exponent < 0 { behind + shift } else { behind.saturating_sub(shift) }
}

/// Returns a number rounded to so many digits behind the first one of a larger one.
fn decimal(x: f64, largest: f64, digits: i32) -> String {
    let first = format!("{largest:e}");
    let first: i32 = first.split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or_default();
    let decimals = (digits - first).max(0) as usize;
    rounded(x, decimals).parse().map(shortest).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::{COMPUTED, Open, SOLVED, as_short_as, count_decimals, without_noise};
    use crate::host::Host;

    fn shortened(text: &str) -> String {
        super::shortened(text, COMPUTED)
    }

    #[test]
    fn digits_that_only_rounding_made_are_left_out() {
        let text = "line2: Line { p1 = (-110.70000000000002, 2.842170943040401e-14)  p2 = (46.0554002110016, 1) }";
        let short = "line2: Line { p1 = (-110.7, 0)  p2 = (46.0554002110016, 1) }";
        assert_eq!(shortened(text), short);
        assert_eq!(shortened("a = (-1e-15, 300.00000000000006)"), "a = (0, 300)");
        // beside the other places of its thing a place is at the origin
        let arc = "arc1: Arc { center = (-1.0157151026e-15, 0)  start = (40, 0)  end = (0, 40) }";
        assert_eq!(shortened(arc), "arc1: Arc { center = (0, 0)  start = (40, 0)  end = (0, 40) }");
        assert_eq!(shortened("a = -50.00000000000001 mm"), "a = -50 mm");
    }

    #[test]
    fn decimals_are_counted_in_small_numbers_too() {
        assert_eq!([0.25, 1500.0, 2.5e-9, 3e20, 0.0].map(count_decimals), [2, 0, 10, 0, 0]);
    }

    #[test]
    fn what_was_moved_is_as_short_as_it_was() {
        let was = "a: Arc { center = (0, 20.25)  start = (46.0554002110016, 1) }";
        let now = "a: Arc { center = (38.4, 58.650000000000006)  start = (84.45540021100161, 39.39999999999999) }";
        let short = "a: Arc { center = (38.4, 58.65)  start = (84.4554002110016, 39.4) }";
        assert_eq!(as_short_as(was, now, 38.4), short);
        assert_eq!(as_short_as("r = 20", "r = 19.999999999999993", 40.0), "r = 20");
        assert_eq!(as_short_as("x = 3", "x = -1.7e-15", 3.0), "x = 0");
        // more than rounding
        assert_eq!(as_short_as("r = 20", "r = 19.9999999", 40.0), "r = 19.9999999");
        assert_eq!(as_short_as("r = 2e-9", "r = 2.0000000000000001e-9", 1e-9), "r = 2e-9");
    }

    #[test]
    fn a_small_value_beside_a_large_one_is_kept() {
        for text in [
            "pipe: Pipe { size = 200  leak = 0.00000000000025 }",
            "pipe: Pipe { size = 200  leak = 2.5e-13 }",
            "pipe: Pipe { at = (200, 100)  leak = -2.5e-13 }",
            "x = Pipe(200, 2.5e-13)",
            "x: Real => a - 0.00000000000000001",
            "x: Point => (a - 1e-17, 200)",
            "x = (2.5e-13, -1e-14)",
        ] {
            let leaks = text.replace("0.00000000000025", "2.5e-13");
            let leaks = leaks.replace("0.00000000000000001", "1e-17");
            assert_eq!(shortened(text), leaks);
        }
    }

    #[test]
    fn what_stands_within_quotes_is_not_shortened() {
        for text in ["note = \"50.00000000000001\"", "note = \"{a + 50.00000000000001} wide\""] {
            assert_eq!(shortened(text), text);
        }
    }

    struct Nothing;
    impl Host for Nothing {
        fn read(&self, _: &str) -> Option<String> {
            None
        }
    }

    #[test]
    fn a_free_parameter_that_is_small_is_written_as_it_is() {
        let class = "class Pipe { size, leak, total: Real  constraint total = size + leak }\n";
        let member = |size: &str| format!("pipe: Pipe {{ size = {size}  leak = 2.5e-13 }}");
        let written = |text: String| {
            without_noise(&Open::of("trial", text, &Nothing), "pipe", &[SOLVED, COMPUTED], &Nothing)
        };
        assert_eq!(written(format!("{class}{}\n", member("200.00000000000003"))), member("200"));
        // what a rule leaves of a place is written to the rule's tolerance
        let round = "class Place { x, y: Real }\nclass Ray { end: Place  far: Real  constraint far = sqrt(end.x^2 + end.y^2) }\n";
        let ray = |end: &str| format!("ray: Ray {{ end = {end}  far = 200 }}");
        let drawn = ray("(89.44271910000069, -178.88543819963163)");
        let short = without_noise(
            &Open::of("trial", format!("{round}{drawn}\n"), &Nothing),
            "ray",
            &[SOLVED, COMPUTED],
            &Nothing,
        );
        assert!(short.contains("(89.4427191, -178.8854382)"), "{short}");
        // a small difference of large numbers would be another one
        let apart = "class Pipe { size, less, leak: Real  constraint leak = size - less }\n";
        let member = "pipe: Pipe { size = 200.00000000000003  less = 200 }";
        assert_eq!(written(format!("{apart}{member}\n")), member);
    }
}
