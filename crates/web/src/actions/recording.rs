//! What is done about a program that is recorded, wherever the keyboard is: one types operands in a field.

use super::conditions::recorded;
use super::{Action, Group};
use crate::lab::Lab;
use crate::words;

/// Begins a loop.
pub(super) const REPEAT: Action = Action {
    id: "record-repeat",
    group: Group::Edit,
    contexts: &[],
    label: words::RECORD_REPEAT,
    keys: &["Alt+R"],
    enabled: recorded,
    run: Lab::record_repeat,
};

/// Begins a branch.
pub(super) const IF: Action = Action {
    id: "record-if",
    group: Group::Edit,
    contexts: &[],
    label: words::RECORD_IF,
    keys: &["Alt+I"],
    enabled: recorded,
    run: Lab::record_if,
};
