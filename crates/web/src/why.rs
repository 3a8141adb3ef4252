//! The panel that says why: what does not hold, what is free, superfluous or contradictory, and how the
//! values come about.

use crate::lab::{Kind, Lab, Told};
use crate::{icons, words};
use leptos::prelude::*;
use presentation::paths::covers;
use presentation::rows::told_apart;
use session::jobs::{LongAnswer, LongQuestion};
use session::view::{
    Advice, Analysis, Choice, ContradictionView, ExplainedStep, Ghost, HeldView, MotionView,
    RedundantView, RowKind, StructureRow, Unmet, Velocity,
};
use session::{Command, Path};

/// Paths as buttons that select them, after a word; nothing if there are none.
pub(crate) fn listed(lab: Lab, word: &'static str, paths: Vec<String>) -> Option<impl IntoView> {
    (!paths.is_empty()).then(|| {
        let buttons = paths.into_iter().map(|path| view! { <PathButton lab=lab path=path /> });
        view! { <p class="paths">{word}" "{buttons.collect_view()}</p> }
    })
}

/// A path that is selected when it is pressed.
#[component]
fn PathButton(lab: Lab, path: String) -> impl IntoView {
    let (select, hover, label) = (path.clone(), path.clone(), lab.called(&path));
    view! {
        <button class="path"
            on:click=move |_| lab.select(Some(select.clone()))
            on:pointerenter=move |_| lab.hover(Some(hover.clone()))
            on:pointerleave=move |_| lab.hover(None)>{label}</button>
    }
}

/// How far the analysis is.
#[derive(Clone, PartialEq, Debug)]
enum Looking {
    On,
    Done,
    /// Before its end, and why.
    Ended(String),
}

/// The panel that says what does not hold, what is free or superfluous and how the values come about.
#[component]
pub fn Why(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let about = Memo::new(move |_| lab.selected.get().and_then(|path| session::parse_path(&path)));
    // whoever counts what is free meanwhile changes none of these
    let explanation = Memo::new(move |_| {
        lab.text.track();
        about.with(|about| lab.explain(about.as_ref())).unwrap_or_default()
    });
    let held = Memo::new(move |_| {
        lab.text.track();
        about.with(|about| about.as_ref().and_then(|path| lab.held(path)))
    });
    let elsewhere = RwSignal::new(Vec::<Ghost>::new());
    Effect::new(move |_| {
        lab.text.track();
        lab.forget_long(Kind::Elsewhere);
        elsewhere.set(Vec::new());
        if let Some(path) = about.get() {
            lab.ask_long(Kind::Elsewhere, LongQuestion::Elsewhere(path), move |told| {
                if let Told::Part(LongAnswer::Elsewhere(found)) = told {
                    elsewhere.try_set(found);
                }
            });
        }
    });
    let (analysis, state) = (RwSignal::new(Analysis::default()), RwSignal::new(Looking::On));
    let analyse = move || {
        // what was found before stands until it is looked up anew
        if state.with_untracked(|state| *state != Looking::Done) {
            state.set(Looking::On);
        }
        lab.ask_long(Kind::Analysis, LongQuestion::Analysis, move |told| match told {
            Told::Part(LongAnswer::Analysis(found)) => {
                analysis.try_set(found);
                state.try_set(Looking::Done);
            }
            Told::Part(_) | Told::Over => {}
            Told::Stopped => {
                drop(state.try_set(Looking::Ended(String::from(words::ANALYSIS_STOPPED))));
            }
            Told::Failed(why) => drop(state.try_set(Looking::Ended(words::job_failed(&why)))),
        });
    };
    Effect::new(move |_| {
        lab.text.track();
        analyse();
    });
    let unmet = Memo::new(move |_| lab.status.with(|status| status.unmet.clone()));
    let steps = Memo::new(move |_| explanation.with(|e| e.steps.clone()));
    let show_all = move || {
        lab.ghosts.set(elsewhere.with(|ghosts| ghosts.iter().map(|g| g.picture.clone()).collect()));
    };
    Effect::new(move |_| show_all());
    on_cleanup(move || {
        lab.forget_long(Kind::Analysis);
        lab.forget_long(Kind::Elsewhere);
        lab.motion.set(Vec::new());
        lab.ghosts.set(Vec::new());
    });
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
                {move || held.get().map(|held| view! { <Held lab=lab held=held /> })}
                {move || (!elsewhere.with(Vec::is_empty)).then(|| view! {
                    <h3>{words::ELSEWHERE}</h3>
                    <ul class="motions" on:pointerleave=move |_| show_all()>
                        {elsewhere.get().into_iter().map(|g| view! { <Elsewhere lab=lab ghost=g /> }).collect_view()}
                    </ul>
                })}
                {move || match state.get() {
                    Looking::On => view! { <p class="quiet">{words::ANALYSING}</p> }.into_any(),
                    Looking::Done => ().into_any(),
                    Looking::Ended(why) => view! {
                        <p>{why}" "<button on:click=move |_| analyse()>{words::ANALYSE_AGAIN}</button></p>
                    }.into_any(),
                }}
                {move || view! { <Analysed lab=lab analysis=analysis.get() about=lab.selected.get() /> }}
                <p>{move || explanation.with(|e| e.summary.clone())}</p>
                {move || explanation.with(|e| e.warnings.clone()).into_iter()
                    .map(|warning| view! { <p class="quiet">{warning}</p> }).collect_view()}
                {move || (!steps.with(Vec::is_empty)).then(|| view! {
                    <h3>{words::STEPS}</h3>
                    <ol class="steps">{steps.get().into_iter().map(|s| view! { <Step lab=lab step=s /> }).collect_view()}</ol>
                })}
            </div>
        </section>
    }
}

/// Why the selection does not move.
#[component]
fn Held(lab: Lab, held: HeldView) -> impl IntoView {
    view! {
        <h3>{words::HELD}</h3>
        <p>{held.message}</p>
        {listed(lab, words::IN_THE_WAY, held.constraints.into_iter().chain(held.anchors).collect())}
    }
}

/// Where else the selection could be: the picture shows it alone while the pointer or the keyboard is on it.
#[component]
fn Elsewhere(lab: Lab, ghost: Ghost) -> impl IntoView {
    let Ghost { label, moves: _, picture, command } = ghost;
    let show = move || lab.ghosts.set(vec![picture.clone()]);
    let focus = show.clone();
    view! {
        <li>
            <button class="bare motion" title=words::PICK on:pointerenter=move |_| show()
                on:focus=move |_| focus() on:click=move |_| { lab.apply(&command); }>{label}</button>
        </li>
    }
}

/// What cannot hold together, what says nothing new, and what can still move.
///
/// Of the motions those of one thing, if one is meant.
#[component]
fn Analysed(lab: Lab, analysis: Analysis, about: Option<String>) -> impl IntoView {
    let Analysis { freedom, mut free, mut motions, redundant, contradictions, advice } = analysis;
    let title = match &about {
        None => format!("{}, {}", words::FREE, words::ways(freedom)),
        Some(about) => {
            let is_its = |v: &Velocity| covers(about, &v.path) || covers(&v.path, about);
            motions.retain(|motion| motion.moves.iter().any(is_its));
            free.retain(|path| covers(about, path) || covers(path, about));
            String::from(words::FREE)
        }
    };
    view! {
        {(!contradictions.is_empty()).then(|| view! {
            <h3 class="conflicting">{words::CONTRADICTION}</h3>
            <ul>{contradictions.into_iter().map(|c| view! { <Contradiction lab=lab contradiction=c /> }).collect_view()}</ul>
        })}
        {(!redundant.is_empty()).then(|| view! {
            <h3 class="redundant">{words::REDUNDANT}</h3>
            <ul>{redundant.into_iter().map(|r| view! { <Redundant lab=lab redundant=r /> }).collect_view()}</ul>
        })}
        {(!advice.is_empty()).then(|| view! {
            <h3>{words::ADVICE}</h3>
            <ul>{advice.into_iter().map(|a| view! { <Advised lab=lab advice=a /> }).collect_view()}</ul>
        })}
        {(!motions.is_empty()).then(|| view! {
            <h3>{title}</h3>
            <ul class="motions" on:pointerleave=move |_| lab.motion.set(Vec::new())>
                {motions.into_iter().map(|m| view! { <Motion lab=lab motion=m /> }).collect_view()}
            </ul>
            {(!free.is_empty()).then(|| view! { <FreeParts lab=lab free=free /> })}
        })}
    }
}

#[component]
fn Contradiction(lab: Lab, contradiction: ContradictionView) -> impl IntoView {
    let ContradictionView { constraints, anchors, decided: _, message, mut repairs, choices } =
        contradiction;
    repairs.retain(|repair| !choices.iter().any(|choice| choice.label == *repair));
    let paths = constraints.into_iter().chain(anchors).collect();
    view! {
        <li>
            <p>{message}</p>
            {listed(lab, words::IN_THE_WAY, paths)}
            {(!choices.is_empty()).then(|| view! {
                <p>{words::REPAIRS}</p>
                <ul class="repairs" on:pointerleave=move |_| lab.foresee_repair(None)>
                    {choices.into_iter().map(|c| view! { <RepairButton lab=lab choice=c /> }).collect_view()}
                </ul>
            })}
            {(!repairs.is_empty()).then(|| view! {
                <p>{words::REPAIRS}</p>
                <ul>{repairs.into_iter().map(|r| view! { <li>{r}</li> }).collect_view()}</ul>
            })}
        </li>
    }
}

/// What would mend a contradiction: the picture shows it while the pointer or the keyboard is on it.
#[component]
fn RepairButton(lab: Lab, choice: Choice) -> impl IntoView {
    let command = StoredValue::new(choice.command);
    let look = move || command.with_value(|command| lab.foresee_repair(Some(command)));
    let mend = move |_| {
        lab.foresee_repair(None);
        lab.apply(&command.get_value());
    };
    view! {
        <li>
            <button class="repair" on:pointerenter=move |_| look() on:focus=move |_| look()
                on:blur=move |_| lab.foresee_repair(None) on:click=mend>{choice.label}</button>
        </li>
    }
}

/// At most so many free places are listed; the button selects them all.
const MOST_FREE: usize = 24;

/// What can still move, each lit in the picture while the pointer is on it.
#[component]
fn FreeParts(lab: Lab, free: Vec<String>) -> impl IntoView {
    let shown: Vec<String> = free.iter().take(MOST_FREE).cloned().collect();
    let more = free.len().saturating_sub(MOST_FREE);
    view! {
        {listed(lab, words::FREE_PARTS, shown)}
        {(more > 0).then(|| view! { <p class="quiet">{words::and_more(more)}</p> })}
        <p><button on:click=move |_| lab.select_all(&free)>{words::SELECT_FREE}</button></p>
    }
}

/// A second view, and a button that makes it.
#[component]
fn Advised(lab: Lab, advice: Advice) -> impl IntoView {
    let Advice { message, members } = advice;
    let make = move |_| {
        let (target, members) = (Path::default(), members.clone());
        lab.apply(&Command::Edit { target, members });
    };
    view! { <li>{message}" "<button on:click=make>{words::ADD_IT}</button></li> }
}

#[component]
fn Redundant(lab: Lab, redundant: RedundantView) -> impl IntoView {
    view! { <li><PathButton lab=lab path=redundant.constraint />{redundant.because}</li> }
}

/// A way to move, which the picture shows by arrows while the pointer or the keyboard is on it.
#[component]
fn Motion(lab: Lab, motion: MotionView) -> impl IntoView {
    let moves = StoredValue::new(motion.moves);
    let show = move || lab.motion.set(moves.get_value());
    view! {
        <li>
            <button class="bare motion" on:pointerenter=move |_| show() on:focus=move |_| show()
                on:blur=move |_| lab.motion.set(Vec::new())
                on:click=move |_| lab.select(moves.with_value(|m| m.first().map(|v| v.path.clone())))>
                {motion.summary}
            </button>
        </li>
    }
}

#[component]
fn UnmetRow(lab: Lab, unmet: Unmet) -> impl IntoView {
    let is_named = lab.called(&unmet.constraint) == unmet.constraint;
    view! {
        <li>
            <PathButton lab=lab path=unmet.constraint />
            {is_named.then(|| view! { <code>{unmet.rule}</code>" " })}
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

impl Lab {
    /// What is at a path, in words: a constraint that nobody has named by what it says.
    pub fn called(self, path: &str) -> String {
        self.structure.with_untracked(|rows| {
            let rule = |row: &&StructureRow| row.path == path && row.kind == RowKind::Constraint;
            rows.iter().find(rule).map_or_else(|| path.into(), |row| told_apart(row, rows))
        })
    }
}
