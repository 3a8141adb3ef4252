//! Listings: the rows of structure and values, made while there is time.
//!
//! In: a document as it stands. Out: its rows, a few at a time, so that whoever shows them goes on between. What has
//! become of the document meanwhile is not seen.

use super::{structure, values};
use crate::document::Open;
use crate::session::Session;
use crate::state::State;
use crate::view::{DocumentId, StructureRow, ValueRow};
use kernel::Values;
use std::rc::Rc;

impl Session {
    /// Tells of the values one by one, in the order of [`Session::values`].
    pub fn each_value(&self, id: DocumentId, tell: &mut dyn FnMut(ValueRow)) {
        let open = self.document(id);
        values::each_row((&open.state, open.values(), &open.status), tell);
    }
    /// Returns the values for programs: a `number`, and the `range` of one, counts in SI, a length without a unit in
    /// those of the sheet, whatever the units are in which the document counts.
    pub fn values_in_si(&self, id: DocumentId) -> Vec<ValueRow> {
        let document = &self.document(id).state.lowered.document;
        let mut rows = self.values(id);
        for row in &mut rows {
            let dimension = match row.unit.as_str() {
                "" => expr::Dimension::by_name(&row.class),
                unit => expr::units::unit(unit).map(|unit| unit.dimension),
            };
            let Some(dimension) = dimension else { continue };
            let bare = |x: f64| kernel::quantity::to_bare(document, x, dimension);
            row.number = row.number.map(bare);
            row.range = row.range.map(|(least, most)| (least.map(bare), most.map(bare)));
        }
        rows
    }
}

/// Returns by which power of ten numbers in one unit are to be multiplied to count in another; nothing for units of which
/// neither is a decimal multiple of the other.
pub fn decimal_shift(from: &str, to: &str) -> Option<i32> {
    let [from, to] = [expr::units::unit(from)?, expr::units::unit(to)?];
    let is_multiple = from.dimension == to.dimension && from.mantissa == to.mantissa;
    is_multiple.then(|| i32::from(from.exponent) - i32::from(to.exponent))
}

/// Rows that are being made.
pub struct Listing {
    state: Rc<State>,
    values: Values,
    status: plan::Status,
    structure_rows: structure::Work,
    value_rows: values::Work,
}

impl std::fmt::Debug for Listing {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let rows = self.structure_rows.rows.len() + self.value_rows.rows.len();
        f.debug_struct("Listing").field("rows", &rows).finish_non_exhaustive()
    }
}

impl Listing {
    pub(crate) fn of(open: &Open) -> Self {
        Self {
            state: open.state.clone(),
            values: open.values().clone(),
            status: open.status.clone(),
            structure_rows: structure::Work::new(&open.state),
            value_rows: values::Work::default(),
        }
    }

    /// Goes on while there is time, which is asked after every row or two; returns true when all rows are made.
    pub fn go_on(&mut self, has_time: &mut dyn FnMut() -> bool) -> bool {
        let of = (&*self.state, &self.values, &self.status);
        self.structure_rows.go_on(of, has_time) && self.value_rows.go_on(of, has_time)
    }

    /// Makes what is left, and returns all rows.
    pub fn finished(mut self) -> (Vec<StructureRow>, Vec<ValueRow>) {
        self.go_on(&mut || true);
        (self.structure_rows.rows, self.value_rows.rows)
    }
}
