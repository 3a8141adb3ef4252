//! Why a thing does not move, in words.

use crate::document::Open;
use crate::view::HeldView;
use crate::words;
use kernel::Path;

/// Says what holds the thing at a path; nothing where it can move, or where there is none.
pub(crate) fn view(open: &mut Open, about: &Path) -> Option<HeldView> {
    let state = open.state.clone();
    let thing = words::find(&state, about).ok()?;
    let slots = state.structure.slots_under(thing);
    let numbers = slots.into_iter().filter(|&s| state.structure.slots[s].primitive.is_number());
    let (mut constraints, mut anchors): (Vec<String>, Vec<String>) = (Vec::new(), Vec::new());
    let add = |names: &mut Vec<String>, name: String| {
        if !names.contains(&name) {
            names.push(name);
        }
    };
    let (mut held, mut loose) = (Vec::new(), Vec::new());
    for slot in numbers {
        let path = state.slot_path(slot).to_string();
        match open.planner.held(state.model(), slot) {
            None => loose.push(path),
            Some(by) => {
                held.push(path);
                for source in by.constraints {
                    if let Some(name) = words::source_name(&state, source) {
                        add(&mut constraints, name);
                    }
                }
                for anchor in by.anchors {
                    let s = &state.structure.slots[anchor];
                    let thing = s.place.unwrap_or(s.thing);
                    let path = state.structure.path(&state.lowered.document, thing);
                    add(&mut anchors, path.to_string());
                }
            }
        }
    }
    if held.is_empty() {
        return None;
    }
    let subject = if loose.is_empty() { about.to_string() } else { words::listed(&held) };
    let message = match (constraints.is_empty(), anchors.is_empty()) {
        (true, _) => format!("{subject} does not move: it is anchored"),
        (false, true) => {
            format!("{subject} does not move: held by {}", words::listed(&constraints))
        }
        (false, false) => format!(
            "{subject} does not move: held by {}, and by the anchor of {}",
            words::listed(&constraints),
            words::listed(&anchors)
        ),
    };
    let message = match loose.is_empty() {
        true => message,
        false => format!("{message}; {} can", words::listed(&loose)),
    };
    Some(HeldView { message, constraints, anchors })
}
