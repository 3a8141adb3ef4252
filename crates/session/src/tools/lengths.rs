//! Lengths of copies that are put into a sheet which counts in another unit: they stay as long as they were.
//!
//! A bare number is a length where its sheet's unit may stand behind it: where the text of the copies, read with that
//! unit, has no error that it had not before. So what it measures is found by the language alone.

use super::copies::Clip;
use crate::host::Host;
use crate::state::State;
use base::Severity;
use base::number::{shortest, significant};
use kernel::Document;
use syntax::ast::{AstNode, NumberExpr};
use syntax::{SyntaxKind, TextEdit};

/// Digits of a length in another unit: the rest is rounding.
const DIGITS: usize = 13;
/// A longer number keeps the unit that it had.
const LONGEST: usize = 8;

/// What a length without a unit is in a sheet.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Measure {
    /// How the unit is spelled.
    unit: String,
    /// How many of it are a metre.
    per_metre: f64,
}

impl Measure {
    /// That of a document; none where lengths without a unit are units of the sheet alone.
    pub(super) fn of(document: &Document) -> Option<Self> {
        let per_metre = document.units_per_metre;
        match &document.unit {
            Some(unit) => Some(Self { unit: unit.to_string(), per_metre }),
            None => document.writes_lengths.then(|| Self { unit: "m".into(), per_metre }),
        }
    }
}

/// Returns how many times larger the numbers of lengths are where copies are put, and of each of their members the
/// edits that say so.
///
/// Cost: the text of the copies is read once for each of its numbers; nothing where both sheets count alike.
pub(super) fn kept(clip: &Clip, to: &State, host: &dyn Host) -> (f64, Vec<Vec<TextEdit>>) {
    let none = || (1.0, vec![Vec::new(); clip.members.len()]);
    let Some((from, to)) = clip.measure.as_ref().zip(Measure::of(&to.lowered.document)) else {
        return none();
    };
    if from.per_metre == to.per_metre {
        return none();
    }
    let ratio = to.per_metre / from.per_metre;
    let header: String = clip.header.iter().map(|line| format!("{line}\n")).collect();
    let texts: Vec<&str> = clip.members.iter().map(|copied| copied.text.as_str()).collect();
    let mut edits: Vec<Vec<TextEdit>> = vec![Vec::new(); texts.len()];
    let mut known = texts.iter().map(ToString::to_string).collect::<Vec<_>>();
    let load = |name: &str| host.read(name);
    let errors = |members: &[String]| {
        let lowered = lang::lower(&format!("{header}{}\n", members.join("\n")), &load, None);
        lowered.diagnostics.iter().filter(|d| d.severity == Severity::Error).count()
    };
    let before = errors(&known);
    for (n, text) in texts.iter().enumerate() {
        for number in bare(text) {
            let at = number.span();
            let with_unit = TextEdit {
                span: at,
                insert: format!("{} {}", &text[at.start as usize..at.end as usize], from.unit),
            };
            let own: Vec<TextEdit> = edits[n].iter().cloned().chain([with_unit.clone()]).collect();
            let tried = syntax::edit::apply(text, &own);
            let was = std::mem::replace(&mut known[n], tried);
            if errors(&known) > before {
                known[n] = was;
            } else {
                edits[n].push(with_unit);
            }
        }
    }
    for (text, edits) in texts.iter().zip(&mut edits) {
        for edit in edits {
            let digits = &text[edit.span.start as usize..edit.span.end as usize];
            let there = digits.parse().ok().map(|x| shortest(times(x, ratio)));
            if let Some(there) = there.filter(|there| there.len() <= LONGEST) {
                edit.insert = there;
            }
        }
    }
    (ratio, edits)
}

/// Returns a number so many times, without what only rounding has made.
pub(super) fn times(x: f64, ratio: f64) -> f64 {
    let product = x * ratio;
    significant(product, DIGITS).parse().unwrap_or(product)
}

/// Returns the numbers of a text that have no unit and are not nothing.
fn bare(text: &str) -> Vec<NumberExpr> {
    let tree = syntax::parse(base::FileId(0), text).syntax();
    let numbers = tree.descendants().filter_map(NumberExpr::cast);
    let is_quoted = |number: &NumberExpr| {
        number.syntax().ancestors().any(|node| node.kind() == SyntaxKind::TextExpr)
    };
    numbers.filter(|n| n.unit().is_none() && n.value() != Some(0.0) && !is_quoted(n)).collect()
}
