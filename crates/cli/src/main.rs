//! The `thinglab` command.
fn main() {}
