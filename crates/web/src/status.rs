//! The status line, and what the lab has to say.

use crate::annotated::Sizing;
use crate::apart::apart;
use crate::keyboard::KeysAt;
use crate::lab::{Kind, Lab, Notice};
use crate::marked::marked;
use crate::player::NowPlaying;
use crate::why::listed;
use crate::{icons, js, keyboard, words};
use leptos::prelude::*;
use session::view::{Choice, Question, Recognised, Refusal};
use session::{Command, Path};
use std::time::Duration;

/// What stops nearer to the pointer than this, in pixels, is where the pointer is.
const UNSEEN: f64 = 2.0;

/// The line at the bottom: whether all holds, how free things are, and what was just said.
#[component]
pub fn StatusLine(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let holds = Memo::new(move |_| lab.status.with(|status| status.satisfied));
    let sentence = Memo::new(move |_| lab.status.with(|status| status.message.clone()));
    let doubtful = Memo::new(move |_| {
        lab.text.with(|text| {
            text.diagnostics.iter().any(|d| d.severity == "error" || d.code == "run-ended")
        }) || lab.status.with(|status| !status.unmet.is_empty())
    });
    let drag = Memo::new(move |_| {
        lab.dragging.with(|drag| {
            let drag = drag.as_ref()?;
            // each move draws anew, even where nothing else is to be said of it
            lab.picture.track();
            let follow = lab.ask_of_shown(session::Session::dragged_along).unwrap_or_default();
            let modes = drag.modes.iter().map(|mode| mode.message.clone());
            // nearer than a hand can see it is there
            let scale = lab.view.with(|view| view.scale);
            let is_there = drag.short.is_some_and(|short| short * scale < UNSEEN);
            let message = drag.message.iter().filter(|_| !is_there).cloned();
            let said: Vec<String> = message.chain(modes).chain(follow).collect();
            (!said.is_empty()).then(|| said.join("; "))
        })
    });
    let said = Memo::new(move |_| {
        lab.notice.with(|notice| match notice {
            Some(Notice::Said(words)) => Some(words.clone()),
            Some(Notice::Refused(_) | Notice::Asked(_) | Notice::Recognised(_)) | None => None,
        })
    });
    let hint = Memo::new(move |_| {
        let hint = lab.tool_view.with(|view| view.hint.clone());
        let typed = lab.typed.get();
        let typed = (!typed.is_empty()).then(|| words::typed_for_tool(&typed));
        // a finger has no keys: what it does stands first
        if lab.touch.get() {
            let first = hint
                .split("; ")
                .next()
                .unwrap_or_default()
                .replace(words::CLICK_OR_PRESS, words::TOUCH)
                .replace(words::CLICK, words::TOUCH);
            return lab.tool.with(Option::is_some).then(|| typed.unwrap_or(first));
        }
        let has_keys = lab.cursor.with(Option::is_none) || lab.keys.with(Option::is_some);
        let hint = if has_keys { words::tool_by_keys(&hint) } else { hint };
        let sizes = (lab.annotated.sizing.get() != Sizing::Off)
            .then(|| String::from(if has_keys { words::SIZING_BY_KEYS } else { words::SIZING }));
        lab.tool.with(Option::is_some).then(|| typed.unwrap_or(hint)).or(sizes)
    });
    let swept = move || {
        let progress = lab.plotting.progress.get();
        progress.map(|(done, all)| words::sweeping(&lab.plotting.of.get(), done, all))
    };
    let wanted =
        move || lab.drafting.prompt.with(|prompt| prompt.as_ref().map(|p| p.words.clone()));
    let idle = move || {
        let is_free = lab.dragging.with(Option::is_none);
        let is_there = is_free && lab.document.with(Option::is_some) && !js::coarse();
        is_there.then(|| String::from(idle_hint(lab)))
    };
    let asked_for = Memo::new(move |_| {
        let held = drag.get().or_else(swept).or_else(wanted).or_else(|| said.get());
        held.or_else(|| hint.get())
    });
    let is_idle = Memo::new(move |_| asked_for.with(Option::is_none));
    let heard = Memo::new(move |_| asked_for.get().or_else(idle));
    // until then it is presumed to be as much as before
    let counting = Memo::new(move |_| {
        lab.jobs.going.with(|going| going.as_ref().is_some_and(|g| g.kind == Kind::Freedom))
    });
    let explain = move || if counting.get() { words::COUNTING } else { words::EXPLAIN };
    view! {
        <footer class="status" class:wrong=move || !holds.get() class:doubtful=doubtful
            class:counting=counting>
            <button class="verdict" aria-expanded=move || lab.why.get().to_string()
                aria-controls="why" title=explain
                on:click=move |_| lab.why.update(|why| *why = !*why)>
                {move || if holds.get() && !doubtful.get() { icons::holds() } else { icons::warning() }}
                <span role="status" aria-label=words::STATUS>{sentence}</span>
            </button>
            <NowPlaying lab=lab />
            <Busy lab=lab />
            <span class="said" class:idle=is_idle aria-live="polite" title=move || heard.get().map(|said| said.replace('`', ""))>
                {move || heard.get().map(|said| marked(&said))}
            </span>
        </footer>
    }
}

/// What can be done next with nothing in the hand: by keys where they go, or by the pointer.
fn idle_hint(lab: Lab) -> &'static str {
    let is_selected = lab.selected.with(Option::is_some);
    let is_empty = || lab.picture.with(|picture| picture.drawing.elements.is_empty());
    match lab.keys.get() {
        Some(_) if !lab.status.with(|status| status.satisfied) => words::KEYS_OF_CONFLICT,
        Some(KeysAt::Bin) => words::KEYS_IN_BIN,
        Some(KeysAt::Strip) => words::KEYS_IN_STRIP,
        Some(KeysAt::Structure) => words::KEYS_IN_TREE,
        Some(KeysAt::Picture | KeysAt::Elsewhere) if is_selected => words::KEYS_OF_SELECTION,
        Some(KeysAt::Picture) if is_empty() => words::KEYS_OF_EMPTY,
        Some(KeysAt::Picture) => words::KEYS_IN_PICTURE,
        Some(KeysAt::Elsewhere) => words::KEYS_ELSEWHERE,
        None if is_selected => words::HAND_HINT,
        None => words::BAND_HINT,
    }
}

/// What goes on, how far it is, and a button that stops it; shown only where it takes a while.
#[component]
fn Busy(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    /// So long nobody has to be told.
    const UNSEEN: Duration = Duration::from_millis(300);
    let begun = Memo::new(move |_| {
        let going = lab.jobs.going.get().filter(|going| going.kind != Kind::Freedom);
        going.map(|going| going.begun)
    });
    let seen = RwSignal::new(None::<f64>);
    Effect::new(move |_| {
        if let Some(now) = begun.get() {
            set_timeout(
                move || {
                    seen.try_set(Some(now));
                },
                UNSEEN,
            );
        }
    });
    let shown = Memo::new(move |_| begun.get().is_some() && begun.get() == seen.get());
    let all = Memo::new(move |_| lab.jobs.going.get().map_or(1, |going| going.all));
    let done = move || lab.jobs.going.get().map_or(0, |going| going.done).to_string();
    let said = move || lab.jobs.going.get().map(|going| words::job(going.kind));
    view! {
        <Show when=move || shown.get()>
            <span class="busy">
                // without a value it only says that something goes on
                {move || match all.get() {
                    1 => view! { <progress aria-label=said></progress> }.into_any(),
                    all => view! { <progress aria-label=said max=all.to_string() value=done></progress> }.into_any(),
                }}
                <span>{said}</span>
                <button class="bare" title="Esc" on:click=move |_| { lab.stop_job(); }>
                    {icons::stop()} {words::STOP_JOB}
                </button>
            </span>
        </Show>
    }
}

/// What was refused, with what stands in the way and what would work.
#[component]
pub fn Refused(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let refusal = Memo::new(move |_| {
        lab.notice.with(|notice| match notice {
            Some(Notice::Refused(refusal)) => Some(refusal.clone()),
            Some(Notice::Said(_) | Notice::Asked(_) | Notice::Recognised(_)) | None => None,
        })
    });
    let shown = move |refusal: Refusal| {
        let mut sentences: Vec<String> = Vec::new();
        for sentence in refusal.diagnostics.into_iter().map(|d| d.message) {
            if !refusal.message.starts_with(&sentence) && !sentences.contains(&sentence) {
                sentences.push(sentence);
            }
        }
        let diagnostics =
            sentences.into_iter().map(|sentence| view! { <p>{marked(&sentence)}</p> });
        view! {
            <div class="notice refused" role="alert">
                <div class="words">
                    <p class="lead">{marked(&refusal.message)}</p>
                    {diagnostics.collect_view()}
                    {listed(lab, words::IN_THE_WAY, refusal.constraints)}
                    {(!refusal.repairs.is_empty()).then(|| view! {
                        <p>{words::REPAIRS}</p>
                        <ul>{refusal.repairs.into_iter().map(|r| view! { <li>{r}</li> }).collect_view()}</ul>
                    })}
                </div>
                <button class="bare" aria-label=words::CLOSE title=words::CLOSE
                    on:click=move |_| lab.notice.set(None)>{icons::close()}</button>
            </div>
        }
    };
    move || refusal.get().map(|it| apart(|| shown(it)))
}

/// What has to be decided before a command is applied: of one thing, or of all of its class.
#[component]
pub fn Asked(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let question = Memo::new(move |_| {
        lab.notice.with(|notice| match notice {
            Some(Notice::Asked(question)) => Some(question.clone()),
            Some(Notice::Said(_) | Notice::Refused(_) | Notice::Recognised(_)) | None => None,
        })
    });
    let choice = move |at: usize, choice: Choice| {
        let button = NodeRef::<leptos::html::Button>::new();
        Effect::new(move |_| {
            if let (0, Some(button)) = (at, button.get()) {
                // The keyboard decides where the question is asked.
                let _ = button.focus();
            }
        });
        let (command, label) =
            (StoredValue::new(choice.command), StoredValue::new(choice.label.clone()));
        let go = move |_| {
            lab.foresee_command(None);
            lab.notice.set(None);
            lab.apply_called(&command.get_value(), &label.get_value());
        };
        let look = move || lab.foresee_command(Some(&command.get_value()));
        view! {
            <button node_ref=button on:click=go
                on:pointerenter=move |_| look()
                on:pointerleave=move |_| lab.foresee_command(None)
                on:focus=move |_| look()
                on:blur=move |_| lab.foresee_command(None)>{choice.label}</button>
        }
    };
    let shown = move |question: Question| {
        let before = StoredValue::new_local(keyboard::holder());
        on_cleanup(move || keyboard::give_back(before.try_get_value().flatten()));
        let choices = question.choices.into_iter().enumerate();
        let label = question.message.clone();
        view! {
            <div class="notice asked" role="alertdialog" aria-label=label>
                <div class="words">
                    <p class="lead">{question.message}</p>
                    <p class="choices">
                        {choices.map(|(at, c)| choice(at, c)).collect_view()}
                        <button class="bare" on:click=move |_| lab.notice.set(None)>{words::CANCEL}</button>
                    </p>
                </div>
            </div>
        }
    };
    move || question.get().map(|it| apart(|| shown(it)))
}

/// The classes that the selection could be the parts of, each with what would make it one.
#[component]
pub fn Recognition(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let found = Memo::new(move |_| {
        lab.notice.with(|notice| match notice {
            Some(Notice::Recognised(found)) => Some(found.clone()),
            Some(Notice::Said(_) | Notice::Refused(_) | Notice::Asked(_)) | None => None,
        })
    });
    let one = move |r: Recognised| {
        let members = r.members;
        let make = move |_| {
            let (target, members) = (Path::default(), members.clone());
            lab.apply(&Command::Edit { target, members });
        };
        let parts: Vec<String> =
            r.parts.iter().map(|(field, part)| format!("{field} = {part}")).collect();
        view! {
            <li>
                <b>{r.class}</b>" "<code>{parts.join(", ")}</code>" "
                <span class="quiet">{words::rules_hold(r.constraints)}</span>
                <button on:click=make>{words::MAKE_ONE}</button>
            </li>
        }
    };
    let shown = move |found: Vec<Recognised>| {
        view! {
            <div class="notice recognised" role="status">
                <div class="words">
                    <p class="lead">{words::RECOGNISED}</p>
                    <ul>{found.into_iter().map(one).collect_view()}</ul>
                </div>
                <button class="bare" aria-label=words::CLOSE title=words::CLOSE
                    on:click=move |_| lab.notice.set(None)>{icons::close()}</button>
            </div>
        }
    };
    move || found.get().map(|it| apart(|| shown(it)))
}
