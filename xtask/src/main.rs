//! Builds the lab, opens it, verifies it.
fn main() {}
