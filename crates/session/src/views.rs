//! Views made of a state: one file each.
pub(crate) mod analysis;
pub(crate) mod answers;
pub(crate) mod drawn;
pub(crate) mod explain;
pub(crate) mod held;
pub(crate) mod listing;
pub(crate) mod picture;
pub(crate) mod problems;
pub(crate) mod status;
pub(crate) mod structure;
pub(crate) mod text;
pub(crate) mod values;
