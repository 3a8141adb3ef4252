//! What lengths of copies count in: they are put where they count alike.

use crate::view::Refusal;
use crate::words;
use kernel::Document;

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

/// Refuses copies whose bare lengths would be others where they are put.
///
/// # Errors
/// Both sheets count in a unit, and not in the same.
pub(super) fn count_alike(from: Option<&Measure>, to: &Document) -> Result<(), Refusal> {
    let to = Measure::of(to);
    match from.zip(to.as_ref()) {
        Some((from, to)) if from.per_metre != to.per_metre => Err(words::refuse(format!(
            "the copy is of a sheet in {}, this one counts in {}: its lengths would be others here",
            from.unit, to.unit
        ))),
        Some(_) | None => Ok(()),
    }
}
