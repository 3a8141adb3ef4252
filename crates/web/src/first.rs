//! The first minute: a live figure with one pulsing corner, then why, then a figure of one's own.
//!
//! It is offered in the gallery until it was taken or skipped, and does not come again.

use crate::lab::Lab;
use crate::{actions, route, theme, words};
use drawing::Point;
use leptos::prelude::*;

const KEY: &str = "thinglab/first-minute";
const FIGURE: &str = "gallery/quadrilateral.thing";
/// The corner that pulses.
const CORNER: &str = "q.outer.side2.p2";

/// Where the first minute is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Step {
    /// It is offered.
    Offered,
    /// A corner wants to be dragged.
    Drag,
    /// It was dragged: why does the inner figure stay a parallelogram?
    Why,
    /// The reasons are shown: now one's own.
    Build,
    /// Lines are drawn on an empty sheet.
    Trace,
    /// It was taken or skipped.
    Over,
}

/// What the page sees of what a person does.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Seen {
    /// Something was dragged and let go.
    pub dragged: bool,
    /// The reasons are open.
    pub why: bool,
    /// How many lines the document has.
    pub lines: usize,
}

impl Step {
    /// The step that what is seen leads to.
    pub fn after(self, seen: Seen) -> Self {
        match self {
            Self::Drag if seen.dragged => Self::Why,
            Self::Why if seen.why => Self::Build,
            Self::Trace if seen.lines >= 4 => Self::Over,
            same => same,
        }
    }
}

/// Where the first minute begins in this browser.
pub fn start() -> Step {
    if theme::keep(KEY).is_some() { Step::Over } else { Step::Offered }
}

impl Lab {
    /// Goes to a step of the first minute; its end is remembered.
    pub fn first_minute(self, step: Step) {
        self.first.set(step);
        match step {
            Step::Over => drop(theme::put(KEY, Some("over"))),
            Step::Drag => route::go(&route::to(FIGURE)),
            Step::Trace => {
                self.why.set(false);
                self.begin_new();
            }
            Step::Offered | Step::Why | Step::Build => {}
        }
    }
}

/// What the gallery says to someone who is here for the first time.
#[component]
pub fn Invitation(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    view! {
        <Show when=move || lab.first.get() == Step::Offered>
            <div class="notice first" role="note">
                <p class="words lead">{words::FIRST_LEAD}</p>
                <button class="primary" on:click=move |_| lab.first_minute(Step::Drag)>{words::FIRST_BEGIN}</button>
                <button class="bare" on:click=move |_| lab.first_minute(Step::Over)>{words::FIRST_SKIP}</button>
            </div>
        </Show>
    }
}

/// What the first minute says over the picture.
#[component]
pub fn Coach(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    Effect::new(move |_| {
        let lines = lab.structure.with(|rows| {
            rows.iter().filter(|row| row.depth == 1 && row.detail.starts_with("Line")).count()
        });
        let dragged =
            lab.dragging.with(Option::is_none) && lab.status.with(|status| status.undo.is_some());
        let seen = Seen { dragged, why: lab.why.get(), lines };
        let step = lab.first.get();
        let next = step.after(seen);
        if next != step {
            lab.first_minute(next);
        }
    });
    // The line tool comes into the hand as soon as the empty sheet is there.
    Effect::new(move |_| {
        let is_empty = lab.current.with(|path| path.as_deref().is_some_and(|path| path != FIGURE));
        if is_empty && lab.first.get() == Step::Trace {
            request_animation_frame(move || actions::run(actions::named("tool-line"), lab));
        }
    });
    let ring = move || {
        let view = lab.view.get();
        let grip = lab.picture.with(|picture| {
            let grip = picture.grips.iter().find(|grip| grip.path == CORNER)?;
            Some(view.screen_from_sheet(Point { x: grip.x, y: grip.y }))
        });
        grip.filter(|_| lab.first.get() == Step::Drag).map(|(x, y)| {
            view! { <span class="pulse" style:left=format!("{x}px") style:top=format!("{y}px")></span> }
        })
    };
    let say = move |step: Step| match step {
        Step::Offered | Step::Over => None,
        Step::Drag => Some((words::FIRST_DRAG, None)),
        Step::Why => Some((words::FIRST_WHY, Some((words::WHY, Step::Why)))),
        Step::Build => Some((words::FIRST_BUILT, Some((words::FIRST_BUILD, Step::Trace)))),
        Step::Trace => Some((words::FIRST_TRACE, None)),
    };
    let go = move |to: Step| match to {
        Step::Why => lab.why.set(true),
        other => lab.first_minute(other),
    };
    view! {
        {ring}
        {move || say(lab.first.get()).map(|(sentence, next)| view! {
            <div class="coach" role="status">
                <p>{sentence}</p>
                {next.map(|(label, to)| view! {
                    <button class="primary" on:click=move |_| go(to)>{label}</button>
                })}
                <button class="bare" on:click=move |_| lab.first_minute(Step::Over)>{words::FIRST_SKIP}</button>
            </div>
        })}
    }
}

#[cfg(test)]
mod tests {
    use super::{Seen, Step};

    #[test]
    fn each_step_waits_for_what_it_asks() {
        let nothing = Seen::default();
        let dragged = Seen { dragged: true, ..nothing };
        let why = Seen { why: true, ..dragged };
        assert_eq!(Step::Drag.after(nothing), Step::Drag);
        assert_eq!(Step::Drag.after(why), Step::Why);
        assert_eq!(Step::Why.after(dragged), Step::Why);
        assert_eq!(Step::Why.after(why), Step::Build);
        assert_eq!(Step::Build.after(why), Step::Build);
        assert_eq!(Step::Trace.after(Seen { lines: 3, ..nothing }), Step::Trace);
        assert_eq!(Step::Trace.after(Seen { lines: 4, ..nothing }), Step::Over);
    }
}
