//! What is done about a program that is recorded, wherever the keyboard is: one types operands in a field.

use super::conditions::{is_recorded, recorded};
use super::{Action, Group};
use crate::keyboard::focus;
use crate::lab::{Drawer, Lab};
use crate::words;
use leptos::prelude::request_animation_frame;

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

/// Leads to what can be begun and ended.
pub(super) const GO: Action = Action {
    id: "go-recording",
    group: Group::Go,
    contexts: &[],
    label: words::GO_RECORDING,
    keys: &["Alt+8"],
    enabled: is_recorded,
    run: |lab| {
        lab.open_drawer(Drawer::Draw);
        request_animation_frame(|| focus(".drawing .blocks button"));
    },
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
