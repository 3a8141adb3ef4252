//! The status line, what the lab has to say, and the panel that explains why.

use crate::lab::{Lab, Notice};
use crate::{icons, words};
use leptos::prelude::*;
use session::view::{Choice, ExplainedStep, Question, Refusal, Unmet};

/// The line at the bottom: whether all holds, how free things are, and what was just said.
#[component]
pub fn StatusLine(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let holds = Memo::new(move |_| lab.status.with(|status| status.satisfied));
    let sentence = Memo::new(move |_| lab.status.with(|status| status.message.clone()));
    let doubtful = Memo::new(move |_| {
        lab.text.with(|text| text.diagnostics.iter().any(|d| d.severity == "error"))
            || lab.status.with(|status| !status.unmet.is_empty())
    });
    let drag = Memo::new(move |_| {
        lab.dragging.with(|drag| drag.as_ref().and_then(|drag| drag.message.clone()))
    });
    let said = Memo::new(move |_| {
        lab.notice.with(|notice| match notice {
            Some(Notice::Said(words)) => Some(words.clone()),
            Some(Notice::Refused(_) | Notice::Asked(_)) | None => None,
        })
    });
    let heard = Memo::new(move |_| drag.get().or_else(|| said.get()));
    view! {
        <footer class="status" class:wrong=move || !holds.get() class:doubtful=doubtful>
            <button class="verdict" aria-expanded=move || lab.why.get().to_string()
                aria-controls="why" title=words::EXPLAIN
                on:click=move |_| lab.why.update(|why| *why = !*why)>
                {move || if holds.get() && !doubtful.get() { icons::holds() } else { icons::warning() }}
                <span role="status" aria-label=words::STATUS>{sentence}</span>
            </button>
            <span class="said" aria-live="polite" title=heard>{heard}</span>
        </footer>
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
            Some(Notice::Said(_) | Notice::Asked(_)) | None => None,
        })
    });
    let shown = move |refusal: Refusal| {
        let mut sentences: Vec<String> = Vec::new();
        for sentence in refusal.diagnostics.into_iter().map(|d| d.message) {
            if sentence != refusal.message && !sentences.contains(&sentence) {
                sentences.push(sentence);
            }
        }
        let diagnostics = sentences.into_iter().map(|sentence| view! { <p>{sentence}</p> });
        view! {
            <div class="notice refused" role="alert">
                <div class="words">
                    <p class="lead">{refusal.message}</p>
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
    move || refusal.get().map(shown)
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
            Some(Notice::Said(_) | Notice::Refused(_)) | None => None,
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
        let go = move |_| {
            lab.notice.set(None);
            lab.apply_as_meant(&choice.command);
        };
        view! { <button node_ref=button on:click=go>{choice.label}</button> }
    };
    let shown = move |question: Question| {
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
    move || question.get().map(shown)
}

/// Paths as buttons that select them, after a word; nothing if there are none.
fn listed(lab: Lab, word: &'static str, paths: Vec<String>) -> Option<impl IntoView> {
    (!paths.is_empty()).then(|| {
        let buttons = paths.into_iter().map(|path| view! { <PathButton lab=lab path=path /> });
        view! { <p class="paths">{word}" "{buttons.collect_view()}</p> }
    })
}

/// A path that is selected when it is pressed.
#[component]
fn PathButton(lab: Lab, path: String) -> impl IntoView {
    let (select, hover) = (path.clone(), path.clone());
    view! {
        <button class="path"
            on:click=move |_| lab.select(Some(select.clone()))
            on:pointerenter=move |_| lab.hover(Some(hover.clone()))
            on:pointerleave=move |_| lab.hover(None)>{path}</button>
    }
}

/// The panel that says what does not hold, what is redundant and how the values come about.
#[component]
pub fn Why(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let explanation = Memo::new(move |_| {
        lab.status.track();
        let about = lab.selected.get().and_then(|path| session::parse_path(&path));
        lab.explain(about.as_ref()).unwrap_or_default()
    });
    let unmet = Memo::new(move |_| lab.status.with(|status| status.unmet.clone()));
    let redundant = Memo::new(move |_| lab.status.with(|status| status.redundant.clone()));
    let steps = Memo::new(move |_| explanation.with(|e| e.steps.clone()));
    view! {
        <section id="why" class="panel why" aria-label=words::WHY>
            <header class="head">
                <h2>{words::WHY}</h2>
                <span class="quiet">{move || explanation.with(|e| {
                    if e.about.is_empty() { String::from(words::WHOLE_DOCUMENT) } else { e.about.clone() }
                })}</span>
                <button class="bare" aria-label=words::CLOSE title=words::CLOSE
                    on:click=move |_| lab.why.set(false)>{icons::close()}</button>
            </header>
            <div class="scroll reasons">
                {move || (!unmet.with(Vec::is_empty)).then(|| view! {
                    <h3 class="conflicting">{words::UNMET}</h3>
                    <ul>{unmet.get().into_iter().map(|u| view! { <UnmetRow lab=lab unmet=u /> }).collect_view()}</ul>
                })}
                {move || (!redundant.with(Vec::is_empty)).then(|| view! {
                    <h3 class="redundant">{words::REDUNDANT}</h3>
                    {listed(lab, "", redundant.get())}
                })}
                <p>{move || explanation.with(|e| e.summary.clone())}</p>
                {move || (!steps.with(Vec::is_empty)).then(|| view! {
                    <h3>{words::STEPS}</h3>
                    <ol class="steps">{steps.get().into_iter().map(|s| view! { <Step lab=lab step=s /> }).collect_view()}</ol>
                })}
            </div>
        </section>
    }
}

#[component]
fn UnmetRow(lab: Lab, unmet: Unmet) -> impl IntoView {
    view! {
        <li>
            <PathButton lab=lab path=unmet.constraint />
            <code>{unmet.rule}</code>
            <span class="quiet">{unmet.strength}
                {unmet.error.map(|error| format!(", {} {}", words::OFF_BY, words::short(error)))}</span>
        </li>
    }
}

#[component]
fn Step(lab: Lab, step: ExplainedStep) -> impl IntoView {
    let targets = step.targets.into_iter().map(|path| view! { <PathButton lab=lab path=path /> });
    view! {
        <li>
            <span class="targets">{targets.collect_view()}</span>
            <span class="method">{step.method}</span>
            <code>{step.formula}</code>
            <span class="quiet">{step.reason}</span>
            <span class="results">{step.values.join(", ")}</span>
        </li>
    }
}
