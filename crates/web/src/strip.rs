//! The strip: what can be said of the selection, each shown in the picture before it is done.

use crate::actions;
use crate::dialog::Wish;
use crate::lab::{Kind, Lab, Notice, Told, Zoom};
use crate::{keyboard, structure, words};
use drawing::Bounds;
use leptos::prelude::*;
use presentation::numbers::to_read;
use session::Command;
use session::jobs::{LongAnswer, LongQuestion};
use session::view::{Deed, Foreseen, Offer, Refusal, RowKind};
use std::time::Duration;

/// What the pointer only passes over is not tried.
const PAUSE: Duration = Duration::from_millis(80);

/// The offers for what is selected, over the lower edge of the picture.
#[component]
pub fn Strip(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let found = Memo::new(move |_| {
        let idle = lab.drafting.prompt.with(Option::is_none)
            && lab.tool.with(Option::is_none)
            && lab.dragging.with(Option::is_none);
        if idle { lab.offers_and_held() } else { Default::default() }
    });
    let offers = Memo::new(move |_| found.with(|(offers, _)| offers.clone()));
    let held = Memo::new(move |_| found.with(|(_, held)| held.clone()));
    let is_idle =
        move || lab.tool.with(Option::is_none) && lab.drafting.prompt.with(Option::is_none);
    let lockable = Memo::new(move |_| is_idle().then(|| actions::lockable(lab).ok()).flatten());
    let is_locked = Memo::new(move |_| {
        lockable.with(|paths| paths.iter().flatten().all(|path| structure::is_locked(lab, path)))
    });
    let is_shown = move || {
        let something = !(offers.with(Vec::is_empty) && held.with(Vec::is_empty))
            || lockable.with(Option::is_some);
        // several things can be a class, whatever else can be said of them
        let several = lab.also.with(|also| !also.is_empty()) && lab.dragging.with(Option::is_none);
        something || (lab.touch.get() || several) && is_idle() && lab.selected.with(Option::is_some)
    };
    Effect::new(move |_| {
        if lab.selected.with(Option::is_none) {
            lab.adding.set(false);
        }
    });
    view! {
        <Show when=is_shown>
            <div class="strip" role="toolbar" aria-label=words::CONSTRAIN
                on:keydown=|e| keyboard::go_beside(".strip", &e)>
                // a finger has no key that selects besides
                <Show when=move || lab.touch.get()>
                    <button class="adding" title=words::ALSO_HELP aria-pressed=move || lab.adding.get().to_string()
                        on:click=move |_| lab.adding.update(|adding| *adding = !*adding)>{words::ALSO}</button>
                </Show>
                <For each=move || offers.get() key=key let(offer)>
                    <Button lab=lab offer=offer />
                </For>
                <For each=move || held.get() key=Clone::clone let(label)>
                    <span class="held" title=words::HOLDS_ALREADY>"✓ "{label}</span>
                </For>
                <Show when=move || lockable.with(Option::is_some)>
                    <button data-action="lock" title=words::LOCK aria-pressed=move || is_locked.get().to_string()
                        on:click=move |_| actions::run(actions::named("lock"), lab)>
                        {move || if is_locked.get() { words::UNLOCK_IT } else { words::LOCK_IT }}
                    </button>
                </Show>
                <button data-action="class-of" title=words::CLASS_OF
                    on:click=move |_| actions::run(actions::named("class-of"), lab)>{words::CLASS}</button>
            </div>
        </Show>
    }
}

/// What tells one button from another: what stands on it, and what it is of.
fn key(offer: &Offer) -> (String, Option<String>, String) {
    (offer.members.clone(), offer.value.clone(), format!("{:?}", offer.deed))
}

#[component]
fn Button(lab: Lab, offer: Offer) -> impl IntoView {
    let label = match &offer.value {
        Some(value) if offer.stands => format!("✓ {} {}", offer.label, to_read(value)),
        Some(value) => format!("{} {}", offer.label, to_read(value)),
        None => offer.label.clone(),
    };
    let title = match offer.stands {
        true => String::from(words::SAID_ALREADY),
        false => offer.members.replace("{}", "…"),
    };
    let name = offer.label.clone();
    let offer = StoredValue::new(offer);
    let look = move || lab.foresee(Some(&offer.get_value()));
    view! {
        <button title=title data-offer=name
            on:pointerenter=move |_| look()
            on:pointerleave=move |_| lab.foresee(None)
            on:focus=move |_| look()
            on:blur=move |_| lab.foresee(None)
            on:click=move |_| lab.take_offer(&offer.get_value())>{label}</button>
    }
}

impl Lab {
    /// Takes to what works on the sheet: a finger or a pen, or a mouse, beside which there are keys.
    pub fn touched(self, touch: bool) {
        if self.touch.get_untracked() == touch {
            return;
        }
        self.touch.set(touch);
        if !touch {
            self.adding.set(false);
        }
    }

    /// What can be said of the selection; nothing of constraints.
    pub fn offers(self) -> Vec<Offer> {
        self.offers_and_held().0
    }

    /// The same, and in words what is true of the selection already.
    fn offers_and_held(self) -> (Vec<Offer>, Vec<String>) {
        let selection = self.selection();
        let is_said = self.structure.with(|rows| {
            selection.iter().any(|path| {
                rows.iter().any(|row| row.path == *path && row.kind == RowKind::Constraint)
            })
        });
        let paths: Option<Vec<_>> =
            selection.iter().map(|path| session::parse_path(path)).collect();
        match (self.document.with(|d| d.as_ref().map(|d| d.id)), paths) {
            (Some(id), Some(paths)) if !is_said => {
                self.ask(|session| session.offers_and_held(id, &paths))
            }
            _ => Default::default(),
        }
    }

    /// Shows what an offer would do, or nothing any more.
    pub fn foresee(self, offer: Option<&Offer>) {
        let said = |offer| self.ask_of_shown(|session, id| session.said(id, offer, None).ok());
        self.foresee_command(offer.and_then(said).flatten().as_ref());
    }

    /// Shows what a command would do, or nothing any more.
    pub fn foresee_command(self, command: Option<&Command>) {
        match command {
            Some(command) => self.foresee_then(command, |_| {}),
            None => self.forget_foreseen(),
        }
    }

    /// Shows no more what a command would do.
    fn forget_foreseen(self) {
        self.ghosts.set(Vec::new());
        self.foreseen.update_value(|turn| *turn += 1);
        self.forget_long(Kind::Foreseen);
    }

    /// Has it tried what a command would do, unless another one is meant soon; shows it, and tells what it comes to.
    pub fn foresee_then(
        self,
        command: &Command,
        tell: impl Fn(Result<Foreseen, String>) + Clone + 'static,
    ) {
        self.forget_foreseen();
        let turn = self.foreseen.get_value();
        let is_meant = move || self.foreseen.try_get_value() == Some(turn);
        let question = LongQuestion::Foreseen(command.clone());
        let ask = move || {
            if !is_meant() {
                return;
            }
            let tell = tell.clone();
            self.ask_long(Kind::Foreseen, question.clone(), move |told| match told {
                Told::Part(LongAnswer::Foreseen(found)) if is_meant() => {
                    let picture = found.as_ref().ok().map(|found| found.picture.clone());
                    self.ghosts.set(picture.into_iter().collect());
                    tell(found);
                }
                Told::Part(_) | Told::Over | Told::Stopped | Told::Failed(_) => {}
            });
        };
        set_timeout(ask, PAUSE);
    }

    /// Shows what a repair would do, with as much of the sheet as that needs; what was seen before once it is nothing any
    /// more.
    pub fn foresee_repair(self, command: Option<&Command>) {
        match command {
            Some(command) => self.foresee_then(command, move |found| {
                let picture = found.ok().map(|found| found.picture);
                self.bring_into_sight(picture.as_ref().and_then(drawing::bounds));
            }),
            None => {
                self.forget_foreseen();
                self.bring_into_sight(None);
            }
        }
    }

    /// Shows as much of the sheet as what is drawn and what is foreseen need; what was seen before, where nothing is.
    fn bring_into_sight(self, foreseen: Option<Bounds>) {
        if let Some(foreseen) = foreseen {
            let whole = self
                .drawn_box()
                .map_or(foreseen, |drawn| foreseen.with(drawn.least).with(drawn.most));
            let view = self.view.get_untracked();
            self.seen_before.update_value(|seen| *seen = seen.or(Some(view)));
            self.zoom.set(Some(Zoom::Over(whole)));
        } else if let Some(view) = self.seen_before.get_value() {
            self.seen_before.set_value(None);
            self.view.set(view);
        }
    }

    /// Does what an offer says; where a value goes there, it is asked for.
    pub fn take_offer(self, offer: &Offer) {
        self.foresee(None);
        if offer.value.is_some() {
            self.wish.set(Some(Wish::Dimension(offer.clone())));
            return;
        }
        if let Err(refusal) = self.say_offer(offer, None) {
            self.notice.set(Some(Notice::Refused(refusal)));
        }
        // the strip offers something else now; whoever was in it is where its things are
        keyboard::give_back(None);
    }

    /// Says what is offered, with a value where one goes there; answers whether it holds now.
    ///
    /// # Errors
    /// Why it cannot be made so.
    pub fn say_offer(self, offer: &Offer, value: Option<&str>) -> Result<bool, Refusal> {
        // what is typed beside it comes first
        self.flush_text();
        let Some(said) = self.ask_of_shown(|session, id| session.said(id, offer, value)) else {
            return Ok(false);
        };
        let command = said?;
        Ok(match &offer.deed {
            Deed::Add | Deed::Rule(_) if !matches!(command, Command::Text(_)) => match value {
                Some(_) => self.apply(&command),
                // nobody waits beside a field
                None => self.apply_among(&command, &self.selected_paths()),
            },
            Deed::Add | Deed::Rule(_) => self.apply_called(&command, &offer.label),
            // as where the number itself is typed over, with its unit
            Deed::Give(path) => {
                let typed = value.or(offer.value.as_deref()).unwrap_or_default();
                self.set_typed_now(&path.to_string(), typed)?;
                true
            }
            Deed::Round(_) | Deed::InLines(_) => self.apply_called(&command, &offer.label),
        })
    }
}
