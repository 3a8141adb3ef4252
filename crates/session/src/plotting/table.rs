//! A plot as a table of commas.

use super::{Axis, Plot};
use base::number::{shortest, significant};

impl Plot {
    /// Returns the samples as CSV: what the curves are over, then every curve, then both coordinates of
    /// every locus; a cell is empty where there is no value.
    pub fn csv(&self) -> String {
        let head = |axis: &Axis| match axis.unit.as_str() {
            "" => axis.label.clone(),
            unit => format!("{} [{unit}]", axis.label),
        };
        let mut heads = Vec::new();
        if !self.curves.is_empty() {
            heads.push(head(&self.over));
        }
        heads.extend(self.curves.iter().map(|curve| head(&curve.axis)));
        for locus in &self.loci {
            heads.extend(["x", "y"].map(|name| format!("{}.{name}", locus.label)));
        }
        let curves = self.curves.iter().map(|curve| &curve.points);
        let count = curves.chain(self.loci.iter().map(|l| &l.points)).map(Vec::len).max();
        let mut writer =
            csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(Vec::new());
        let mut rows = vec![heads];
        for i in 0..count.unwrap_or(0) {
            let point = |points: &[Option<(f64, f64)>]| points.get(i).copied().flatten();
            let cell = |x: Option<f64>| x.map(shortest).unwrap_or_default();
            let mut row = Vec::new();
            if !self.curves.is_empty() {
                // a step of a sweep is as round as it is in the unit that it is told in
                let over = self.curves.iter().find_map(|c| point(&c.points)).map(|p| p.0);
                row.push(over.map(|x| significant(x, 15)).unwrap_or_default());
            }
            row.extend(self.curves.iter().map(|c| cell(point(&c.points).map(|p| p.1))));
            for locus in &self.loci {
                let place = point(&locus.points);
                row.extend([cell(place.map(|p| p.0)), cell(place.map(|p| p.1))]);
            }
            rows.push(row);
        }
        for row in &rows {
            // into memory, with as many cells in every row: nothing of it can fail
            let _ = writer.write_record(row);
        }
        let bytes = writer.into_inner().unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    }
}
