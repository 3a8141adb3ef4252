//! `?bench=drag`: leads the document's first grip round in a circle and says how long it takes.
//!
//! Out: `<pre id="bench">` and `window.__bench`, with the milliseconds until there was something to drag, microseconds
//! for one step of the session alone, milliseconds for a whole frame of work, and frames a second. Steps are counted in
//! a second turn: they would take the time of the frames.

use crate::js::now;
use crate::lab::Lab;
use crate::{js, orbit, route};
use leptos::prelude::*;
use session::view::Grip;

/// Frames that are counted.
const FRAMES: u32 = 240;
/// Frames in which steps of the session are counted; the most in each, and the time after which no further one begins,
/// in milliseconds.
const STEPPED: u32 = 60;
const STEPS: u32 = 80;
const STEPPING: f64 = 8.0;

#[derive(Clone, Debug)]
struct Run {
    lab: Lab,
    grip: Grip,
    radius: f64,
    frame: u32,
    steps: u32,
    opened: f64,
    begun: f64,
    ended: f64,
    in_steps: f64,
    in_frames: f64,
    report: RwSignal<String>,
}

/// Whether the page's address asks for a bench.
pub fn is_asked() -> bool {
    route::asked("bench").as_deref() == Some("drag")
}

/// The bench: waits for a document with a grip, runs once and reports.
#[component]
pub fn Bench(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let report = RwSignal::new(String::from("…"));
    let begun = StoredValue::new(false);
    Effect::new(move |_| {
        let found = lab.picture.with(|p| orbit::grip(p).map(|g| (g, orbit::width(&p.drawing))));
        let Some((grip, across)) = found else { return };
        if begun.get_value() || lab.document.with(Option::is_none) {
            return;
        }
        begun.set_value(true);
        let opened = now();
        set_timeout(
            move || {
                if lab.press(&grip.path).is_none() {
                    report.set(format!("{}: {}", grip.path, crate::words::NOT_DRAGGED));
                    return;
                }
                let run = Run {
                    lab,
                    grip,
                    radius: 0.1 * across,
                    frame: 0,
                    steps: 0,
                    opened,
                    begun: now(),
                    ended: now(),
                    in_steps: 0.0,
                    in_frames: 0.0,
                    report,
                };
                request_animation_frame(move || frame(run));
            },
            std::time::Duration::from_millis(300),
        );
    });
    view! { <pre id="bench">{report}</pre> }
}

fn frame(mut run: Run) {
    if run.frame == 0 {
        run.begun = now();
    } else {
        // what the step before came to is painted with this frame
        run.in_frames += run.lab.painted_in.get_value();
    }
    if run.frame == FRAMES {
        run.ended = now();
        return step(run, 0);
    }
    let start = now();
    run.frame += 1;
    let turn = f64::from(run.frame) / f64::from(FRAMES);
    run.lab.drag(orbit::place(&run.grip, run.radius, turn));
    // The panels' effects run before the next task does.
    queue_microtask(move || {
        run.in_frames += now() - start;
        request_animation_frame(move || frame(run));
    });
}

/// Goes the same round by steps of the session alone, a part of it in each frame.
fn step(mut run: Run, part: u32) {
    let Some(id) = run.lab.id().filter(|_| part < STEPPED) else { return finish(&run) };
    let start = now();
    for step in 0..STEPS {
        let turn = f64::from(part * STEPS + step) / f64::from(STEPPED * STEPS);
        let to = orbit::place(&run.grip, run.radius, turn);
        run.lab.order(|session| session.drag(id, to));
        run.steps += 1;
        if now() - start > STEPPING {
            break;
        }
    }
    run.in_steps += now() - start;
    request_animation_frame(move || step(run, part + 1));
}

fn finish(run: &Run) {
    let seconds = (run.ended - run.begun) / 1000.0;
    run.lab.cancel();
    let json = format!(
        "{{\"path\": {:?}, \"opened_ms\": {:.0}, \"frames\": {FRAMES}, \"steps\": {}, \"step_us\": {:.3}, \"frame_ms\": {:.3}, \"fps\": {:.1}}}",
        run.grip.path,
        run.opened,
        run.steps,
        1000.0 * run.in_steps / f64::from(run.steps),
        run.in_frames / f64::from(FRAMES),
        f64::from(FRAMES) / seconds,
    );
    js::publish_bench(&json);
    run.report.set(json);
}
