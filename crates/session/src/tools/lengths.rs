//! What lengths of copies count in. Where that is another unit than that of the sheet which they are put into, their
//! bare lengths are written with the unit that they had.

use super::copies::Clip;
use crate::document::Open;
use crate::host::Host;
use crate::view::Refusal;
use crate::words;
use base::number::{close, pow};
use base::{FileId, Severity, Span};
use kernel::{Document, Primitive, Slot, SlotId, Value};
use syntax::ast::{AstNode, NumberExpr};
use syntax::edit::{self, TextEdit};

/// In copies with more bare numbers these are not told apart.
const MOST: usize = 300;

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

/// What is written of copies so that they are as large where they are put.
pub(super) struct Measured {
    /// Of each member of the copies its edits.
    pub(super) edits: Vec<Vec<TextEdit>>,
    /// How many units of the sheet a unit of the copies is.
    pub(super) scale: f64,
}

/// Returns what is written of copies where they are put.
///
/// # Errors
/// Both sheets count in a unit, and not in the same; and some bare number is of another size there.
pub(super) fn measured(clip: &Clip, to: &Document, host: &dyn Host) -> Result<Measured, Refusal> {
    let as_it_is = Measured { edits: vec![Vec::new(); clip.members.len()], scale: 1.0 };
    let to = Measure::of(to);
    let Some((from, to)) = clip.measure.as_ref().zip(to) else { return Ok(as_it_is) };
    if from.per_metre == to.per_metre {
        return Ok(as_it_is);
    }
    let refused = || {
        words::refuse(format!(
            "the copy is of a sheet in {}, this one counts in {}: its lengths would be others here",
            from.unit, to.unit
        ))
    };
    let bare: Vec<(usize, u32)> = { clip.members.iter().enumerate() }
        .flat_map(|(n, member)| bare_numbers(&member.text).map(move |end| (n, end)))
        .collect();
    let edits = |chosen: &[(usize, u32)]| -> Vec<Vec<TextEdit>> {
        let of = |n: usize| {
            let own = chosen.iter().filter(move |(member, _)| *member == n);
            let unit = |&(_, end): &(usize, u32)| TextEdit {
                span: Span::new(end, end),
                insert: format!(" {}", from.unit),
            };
            own.map(unit).collect()
        };
        (0..clip.members.len()).map(of).collect()
    };
    let text = |chosen: &[(usize, u32)], unit: &str| written(clip, &edits(chosen), unit);
    let errors = |chosen: &[(usize, u32)]| {
        let text = text(chosen, &from.unit);
        let lowered = lang::lower(&text, &|name| host.read(name), None);
        lowered.diagnostics.iter().filter(|d| d.severity == Severity::Error).count()
    };
    let most = errors(&[]);
    let lengths = match errors(&bare) <= most {
        true => bare,
        // what is no length takes no unit of it
        false if bare.len() <= MOST => {
            bare.into_iter().filter(|one| errors(&[*one]) <= most).collect()
        }
        false => return Err(refused()),
    };
    let open = |text: String| Open::of("", text, host);
    let (own, there) = (open(text(&[], &from.unit)), open(text(&lengths, &to.unit)));
    match are_alike((&own, from.per_metre), (&there, to.per_metre)) {
        true => Ok(Measured { edits: edits(&lengths), scale: to.per_metre / from.per_metre }),
        false => Err(refused()),
    }
}

/// Where the numbers of a text end that have no unit.
fn bare_numbers(text: &str) -> impl Iterator<Item = u32> + use<> {
    let nodes: Vec<_> = syntax::parse(FileId(0), text).file().syntax().descendants().collect();
    let numbers = nodes.into_iter().filter_map(NumberExpr::cast);
    let bare = numbers.filter(|number| number.unit().is_none());
    bare.map(|number| u32::from(number.syntax().text_range().end()))
}

/// Copies as a document of their own, in a sheet that counts in a unit.
fn written(clip: &Clip, edits: &[Vec<TextEdit>], unit: &str) -> String {
    let header = clip.header.iter().filter(|said| !said.starts_with("unit "));
    let header = header.cloned().chain([format!("unit {unit}")]);
    let members = clip.members.iter().zip(edits);
    let members = members.map(|(member, edits)| edit::apply(&member.text, edits));
    header.chain(members).map(|said| format!("{}\n", said.trim())).collect()
}

/// Whether the things of two sheets are as large, each with how many units a metre has there.
fn are_alike((own, per_metre): (&Open, f64), (there, other): (&Open, f64)) -> bool {
    let (slots, others) = (&own.state.structure.slots, &there.state.structure.slots);
    let is_alike = |((id, slot), other_id): ((SlotId, &Slot), SlotId)| match (
        own.values().get(id),
        there.values().get(other_id),
    ) {
        (Value::Number(a), Value::Number(b)) => {
            let lengths = match slot.primitive {
                Primitive::Real(dimension) => f64::from(dimension.0[0]),
                _ => 0.0,
            };
            close(a * pow(other / per_metre, lengths), b)
        }
        (a, b) => a.same_bits(&b),
    };
    slots.len() == others.len() && slots.iter().zip(others.ids()).all(is_alike)
}
