//! Blocks: what is drawn together stands in a block of its own, which is inserted once; a dimension's block is its
//! picture.

use super::{Writer, plain};
use crate::element::{Dimension, Element, Tag};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A block, with everything that is drawn in it.
pub(super) struct Block<'d> {
    /// The dimension whose picture it is; nothing for what is inserted.
    pub(super) dimension: Option<&'d Dimension>,
    pub(super) elements: Vec<&'d Element>,
    pub(super) name: String,
    /// The handle of its record.
    pub(super) record: u32,
}

/// Finds the dimensions of a drawing and what is to be drawn together, in the order in which they are drawn.
pub(super) fn gathered<'d>(
    elements: &[&'d Element],
    group: &dyn Fn(Tag) -> Option<String>,
) -> Vec<Block<'d>> {
    let mut all: Vec<Block<'d>> = Vec::new();
    // the order of addresses is not looked at
    let mut dimensions: BTreeMap<*const Dimension, usize> = BTreeMap::new();
    let mut groups: BTreeMap<String, usize> = BTreeMap::new();
    let mut taken: BTreeSet<String> = BTreeSet::new();
    for element in elements {
        let at = match &element.style.dimension {
            Some(of) => *dimensions.entry(Arc::as_ptr(of)).or_insert(all.len()),
            None => match group(element.tag) {
                Some(group) => *groups.entry(group).or_insert(all.len()),
                None => continue,
            },
        };
        if at == all.len() {
            let dimension = element.style.dimension.as_deref();
            let name = match dimension {
                Some(_) => format!("*D{}", dimensions.len()),
                None => {
                    let group = groups.iter().find(|(_, i)| **i == at);
                    free(&plain(group.map_or("", |(name, _)| name)), &mut taken)
                }
            };
            all.push(Block { dimension, elements: Vec::new(), name, record: 0 });
        }
        all[at].elements.push(element);
    }
    all
}

/// Returns a name that is not taken yet: this one, or with a number.
fn free(name: &str, taken: &mut BTreeSet<String>) -> String {
    let numbered = (2..).map(|n| format!("{name}_{n}"));
    let mut all = std::iter::once(name.to_string()).chain(numbered);
    let name = all.find(|name| !taken.contains(name)).unwrap_or_default();
    taken.insert(name.clone());
    name
}

impl Writer {
    /// Inserts a block where it was drawn.
    pub(super) fn insert(&mut self, name: &str) {
        let handle = self.next();
        self.pair(0, "INSERT");
        self.hex(5, handle);
        self.hex(330, self.owner);
        self.pair(100, "AcDbEntity");
        self.pair(8, "0");
        self.pair(100, "AcDbBlockReference");
        self.pair(2, name);
        self.at(10, crate::Point::default());
    }
}
