//! What the planner promises, on documents made by hand.
mod bridge;
mod builder;
mod circuits;
mod diagnosing;
mod moving;
mod opening_rules;
mod reasons;
mod setting;
// what only the room itself knows stands beside its tests, and is compiled with them here
#[expect(dead_code, reason = "the room asks more of it")]
#[path = "../../src/component.rs"]
mod component;
#[expect(dead_code, reason = "the room asks more of it")]
#[path = "../../src/past.rs"]
mod past;
#[expect(dead_code, unreachable_pub, reason = "the room asks more of it, and gives some of it on")]
#[path = "../../src/rule.rs"]
mod rule;
#[path = "../../src/diagnose/second.rs"]
mod second;
