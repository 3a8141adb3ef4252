//! The drawings of a family as files: one for each row, all in one archive.

use super::Family;
use crate::lab::{Kind, Notice, Told};
use crate::{js, words};
use leptos::prelude::*;
use presentation::archive::zip;
use session::file_names;
use session::jobs::{LongAnswer, LongQuestion};
use session::view::{RowFormats, RowOutcome};

/// What a drawing is written as.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Format {
    /// SVG at scale.
    Svg,
    /// DXF in millimetres.
    Dxf,
}

/// Draws all rows, and hands out those that are drawn.
pub fn save(family: Family, format: Format) {
    let (name, rows) = family.grid.with_untracked(|grid| (grid.name.clone(), grid.rows.clone()));
    let formats = RowFormats { svg: format == Format::Svg, dxf: format == Format::Dxf };
    let (names, ending) = (file_names(&rows), if formats.svg { "svg" } else { "dxf" });
    let all = rows.len();
    let archive = format!("{name}-{ending}.zip");
    let come = StoredValue::new(Vec::<RowOutcome>::new());
    let give = move || {
        let outcomes = come.try_update_value(std::mem::take).unwrap_or_default();
        let drawn = outcomes.into_iter().zip(&names);
        let drawn = drawn.map(|(outcome, name)| {
            let text = if formats.svg { outcome.svg } else { outcome.dxf };
            (format!("{name}.{ending}"), text)
        });
        let files: Vec<(String, String)> = drawn.filter(|(_, text)| !text.is_empty()).collect();
        if !files.is_empty() {
            js::download_bytes(&archive, &zip(&files));
        }
        family.lab.notice.set(Some(Notice::Said(words::files_given(files.len(), all))));
    };
    let question = LongQuestion::Rows { family: name, rows, formats };
    let refused = family.refused;
    let kind = if formats.svg { Kind::Svg } else { Kind::Dxf };
    family.lab.ask_long(kind, question, move |told| match told {
        Told::Part(LongAnswer::Row(outcome)) => {
            come.try_update_value(|all| all.push(outcome));
        }
        Told::Part(_) => {}
        Told::Over => give(),
        Told::Stopped => drop(refused.try_set(Some(String::from(words::FILES_STOPPED)))),
        Told::Failed(why) => drop(refused.try_set(Some(words::job_failed(&why)))),
    });
}
