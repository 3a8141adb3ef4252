//! A lesson beside the picture: what it says, its task, a tick when it is done, a hint, and how it is done.

use crate::apart::apart;
use crate::lab::{Lab, Zoom};
use crate::{icons, keyboard, route, theme, words};
use drawing::Point;
use leptos::html::Div;
use leptos::prelude::*;
use session::Session;
use session::view::LessonView;

/// Lessons of the gallery begin with this; what follows is their order.
const PREFIX: &str = "gallery/lesson-";

/// Whether a path is that of a lesson of the gallery.
pub fn is_lesson(path: &str) -> bool {
    path.starts_with(PREFIX)
}

/// Where it is kept that a lesson was finished or left.
fn key(path: &str) -> String {
    format!("thinglab/lesson/{path}")
}

impl Lab {
    /// Begins the lesson of a document that has just been shown: at once where it is a lesson of the gallery that
    /// was not left before, else it is offered.
    pub fn meet_lesson(self, path: &str) {
        let lessons = self.ask_of_shown(Session::lessons).unwrap_or_default();
        self.lesson.set(None);
        self.card.set(0.0);
        self.lesson_offered.set(lessons.first().map(|lesson| lesson.title.clone()));
        if is_lesson(path) && theme::keep(&key(path)).is_none() {
            self.begin_lesson();
        }
    }

    /// Begins the lesson of the shown document.
    pub fn begin_lesson(self) {
        self.tell(|session, id| session.begin_lesson(id, Some(0)));
        self.lesson_offered.set(None);
        self.why.set(false);
        self.lesson.set(self.tell(|session, id| session.lesson(id, false)).flatten());
        self.begin_tracing();
    }

    /// Where there is something to trace, shows all of it and takes the tool that begins it.
    fn begin_tracing(self) {
        let tool =
            self.lesson.with_untracked(|lesson| lesson.as_ref().and_then(|l| l.tool.clone()));
        if let Some(class) = tool {
            self.zoom.set(Some(Zoom::Fit));
            self.take_tool(&class);
        }
    }

    /// Leaves the lesson; what was done stays.
    pub fn leave_lesson(self) {
        self.tell(|session, id| session.begin_lesson(id, None));
        self.lesson.set(None);
        self.card.set(0.0);
        self.lesson_offered.set(None);
        if let Some(path) = self.current.get_untracked() {
            theme::put(&key(&path), Some("over"));
        }
    }

    /// Looks whether the task of the lesson is done.
    pub fn follow_lesson(self) {
        if self.lesson.with_untracked(Option::is_none) {
            return;
        }
        let explained = self.why.get_untracked();
        let now = self.tell(|session, id| session.lesson(id, explained)).flatten();
        if self.lesson.with_untracked(|before| *before != now) {
            self.lesson.set(now);
        }
    }

    /// The lesson of the gallery that comes after the shown one, with its title.
    fn next_lesson(self) -> Option<(String, String)> {
        let here = self.current.get()?;
        self.listed.with(|all| {
            let mut lessons = all.iter().filter(|one| is_lesson(&one.path) && one.path > here);
            // what it is called, without what its document says of it
            let called = |title: &str| title.split(':').next().unwrap_or(title).to_string();
            lessons.next().map(|one| (one.path.clone(), called(&one.title)))
        })
    }
}

/// Rings what a step speaks of, over the picture.
#[component]
pub fn PointedAt(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    move || {
        let view = lab.view.get();
        let points_at = lab.lesson.with(|lesson| lesson.as_ref().map(|l| l.points_at.clone()));
        let points_at = points_at.filter(|_| lab.dragging.with(Option::is_none))?;
        lab.picture.with(|picture| {
            let grips = points_at.iter().filter_map(|path| picture.grips.iter().find(|g| g.path == *path));
            let rings = grips.map(|grip| {
                let (x, y) = view.screen_from_sheet(Point { x: grip.x, y: grip.y });
                view! { <span class="pulse" style:left=format!("{x}px") style:top=format!("{y}px")></span> }
            });
            Some(rings.collect_view())
        })
    }
}

/// The lesson that goes on, or that the document offers. It lies over the picture, and comes before the other panels
/// for those who go by keys.
#[component]
pub fn Coach(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    Effect::new(move |_| {
        lab.why.track();
        lab.follow_lesson();
    });
    view! {
        {move || match (lab.lesson.get(), lab.lesson_offered.get()) {
            (Some(lesson), _) if lesson.at >= lesson.steps => apart(|| view! { <Over lab=lab title=lesson.title /> }.into_any()),
            (Some(lesson), _) => apart(|| view! { <Step lab=lab lesson=lesson /> }.into_any()),
            (None, Some(title)) => apart(|| view! { <Offered lab=lab title=title /> }.into_any()),
            (None, None) => ().into_any(),
        }}
    }
}

/// The lesson that a document offers.
#[component]
fn Offered(lab: Lab, title: String) -> impl IntoView {
    let card = NodeRef::<Div>::new();
    Effect::new(move |_| {
        make_room(lab, card, move || lab.lesson_offered.with_untracked(Option::is_some));
    });
    let skip = |lab: Lab| {
        lab.lesson_offered.set(None);
        lab.card.set(0.0);
    };
    view! {
        <div class="coach" role="note" node_ref=card>
            <p>{words::lesson_offered(&title)}</p>
            <button class="primary" on:click=move |_| to_work(lab, Lab::begin_lesson)>{words::LESSON_BEGIN}</button>
            <button class="bare" on:click=move |_| to_work(lab, skip)>{words::FIRST_SKIP}</button>
        </div>
    }
}

/// Has the picture leave room for a card that lies over it, as long as that is there.
fn make_room(lab: Lab, card: NodeRef<Div>, is_there: impl Fn() -> bool + 'static) {
    let Some(card) = card.get() else { return };
    // it has its size once it is laid out
    request_animation_frame(move || {
        let reaches = f64::from(card.offset_top() + card.offset_height());
        if is_there() && lab.card.get_untracked() < reaches {
            lab.card.set(reaches);
        }
    });
}

/// Does what a button of the card says, which may be gone then: whoever pressed it by a key is at the picture.
fn to_work(lab: Lab, act: fn(Lab)) {
    act(lab);
    keyboard::give_back(None);
}

/// One step: what it says, what is still missing, and help.
#[component]
fn Step(lab: Lab, lesson: LessonView) -> impl IntoView {
    let hinted = RwSignal::new(false);
    let LessonView { title, steps, at, say, task, missing, hints, can_show, .. } = lesson;
    let place = words::lesson_place(&title, at + 1, steps);
    let reads_only = task.is_empty();
    // what is asked for is told in the lesson's own words, where it has some
    let said = if say.is_empty() { task } else { say };
    let next = |lab: Lab| {
        lab.tell(Session::next_step);
        lab.follow_lesson();
    };
    let show = |lab: Lab| {
        let done = lab.tell(Session::show_solution);
        lab.settle(done);
    };
    let card = NodeRef::<Div>::new();
    Effect::new(move |_| {
        hinted.track();
        let goes_on = move || lab.lesson.with_untracked(Option::is_some);
        make_room(lab, card, goes_on);
    });
    let hints = StoredValue::new(hints);
    let missing = StoredValue::new(missing);
    view! {
        <div class="coach lesson" role="region" aria-label=words::LESSON node_ref=card>
            <p class="place">{place}
                <span class="ticks" aria-hidden="true">{"●".repeat(at as usize)}{"○".repeat((steps - at) as usize)}</span>
            </p>
            <div class="lines" role="status">{said.into_iter().map(|line| view! { <p>{line}</p> }).collect_view()}</div>
            <Show when=move || hinted.get()>
                <ul class="hints">
                    {hints.get_value().into_iter().chain(missing.get_value()).map(|h| view! { <li>{h}</li> }).collect_view()}
                </ul>
            </Show>
            {if reads_only {
                view! { <button class="primary" on:click=move |_| to_work(lab, next)>{words::LESSON_NEXT}</button> }.into_any()
            } else {
                view! {
                    <button aria-expanded=move || hinted.get().to_string()
                        on:click=move |_| hinted.update(|h| *h = !*h)>{words::LESSON_HINT}</button>
                    {can_show.then(|| view! { <button on:click=move |_| to_work(lab, show)>{words::LESSON_SHOW}</button> })}
                }.into_any()
            }}
            <button class="bare" on:click=move |_| to_work(lab, Lab::leave_lesson)>{words::FIRST_SKIP}</button>
        </div>
    }
}

/// The end of a lesson, and where to go from there.
#[component]
fn Over(lab: Lab, title: String) -> impl IntoView {
    let next = Memo::new(move |_| lab.next_lesson());
    leptos::task::spawn_local(async move {
        // without a server there is no next one
        let _ = lab.fetch_list().await;
    });
    let go = move |path: String| {
        lab.leave_lesson();
        route::go(&route::to(&path));
    };
    view! {
        <div class="coach lesson" role="region" aria-label=words::LESSON>
            <p class="lines" role="status">{icons::holds()} {words::lesson_over(&title)}</p>
            {move || next.get().map(|(path, title)| view! {
                <button class="primary" on:click=move |_| go(path.clone())>{words::lesson_next(&title)}</button>
            })}
            <button on:click=move |_| { lab.leave_lesson(); route::go(route::GALLERY); }>{words::GALLERY}</button>
            <button on:click=move |_| { lab.leave_lesson(); lab.begin_new(); }>{words::NEW}</button>
            <button class="bare" on:click=move |_| lab.leave_lesson()>{words::CLOSE}</button>
        </div>
    }
}
