//! A class by example: of the selection, what is of the class, what of this one thing only, what a parameter, and by
//! which points it is placed. While it is open, a click on a point of the picture says that one.

use crate::actions;
use crate::apart::apart;
use crate::lab::{Lab, Notice};
use crate::words;
use leptos::ev::{KeyboardEvent, SubmitEvent};
use leptos::html::Input;
use leptos::prelude::*;
use presentation::paths::covers;
use session::Path;
use session::view::{ClassItem, ClassPlan, ItemKind, Scope};

/// The panel, while a class is made.
#[component]
pub fn ByExample(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let is_open = Memo::new(move |_| lab.attachers.with(Option::is_some));
    move || is_open.get().then(|| apart(|| view! { <Panel lab=lab /> }))
}

#[component]
fn Panel(lab: Lab) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let error = RwSignal::new(None::<String>);
    let paths = StoredValue::new(lab.chosen());
    let items = lab.class_items();
    let scopes: Vec<RwSignal<Scope>> =
        items.iter().map(|item| RwSignal::new(item.kind.usual())).collect();
    let points = lab.points_of_selection();
    Effect::new(move |_| {
        if let Some(input) = input.get() {
            request_animation_frame(move || {
                // It stands in the page, so it takes the focus.
                let _ = input.focus();
            });
        }
    });
    let decided = StoredValue::new(scopes.clone());
    let accept = move |e: SubmitEvent| {
        e.prevent_default();
        let Some(name) = input.get_untracked().map(|input| input.value()) else { return };
        let attachers = lab.attachers.get_untracked().unwrap_or_default();
        let plan = ClassPlan {
            name: String::from(name.trim()),
            scopes: decided.get_value().iter().map(RwSignal::get_untracked).collect(),
            attachers: attachers.iter().filter_map(|path| session::parse_path(path)).collect(),
        };
        match lab.make_class(&paths.get_value(), &plan) {
            Ok(()) => lab.attachers.set(None),
            Err(sentence) => error.set(Some(sentence)),
        }
    };
    let key = move |e: KeyboardEvent| {
        if e.key() == "Escape" {
            e.stop_propagation();
            lab.attachers.set(None);
            actions::run(actions::named("go-picture"), lab);
        }
    };
    let rows: Vec<(ClassItem, RwSignal<Scope>)> = items.into_iter().zip(scopes).collect();
    view! {
        <form class="example" role="dialog" aria-label=words::CLASS_OF on:submit=accept on:keydown=key>
            <label for="asked">{words::NAME_OF_CLASS}</label>
            <input id="asked" node_ref=input type="text" spellcheck="false" autocomplete="off"
                placeholder=words::CLASS_NAME_LIKE
                aria-invalid=move || error.with(Option::is_some).to_string() />
            {move || error.get().map(|error| view! { <p class="error" role="alert">{error}</p> })}
            <div class="scroll">
                <h3>{words::OF_WHAT}</h3>
                <ul>{rows.into_iter().map(|(item, scope)| view! { <Item item=item scope=scope /> }).collect_view()}</ul>
                <h3>{words::STICKS_AT}</h3>
                <p class="quiet">{words::STICKS_AT_HINT}</p>
                <ul>{points.into_iter().map(|path| view! { <Attacher lab=lab path=path /> }).collect_view()}</ul>
            </div>
            <p class="choices">
                <button class="primary" type="submit">{words::MAKE_CLASS}</button>
                <button type="button" on:click=move |_| lab.attachers.set(None)>{words::CANCEL}</button>
            </p>
        </form>
    }
}

/// What is decided of one part, value, constraint or merge.
#[component]
fn Item(item: ClassItem, scope: RwSignal<Scope>) -> impl IntoView {
    let named = words::scope_of(&item.says);
    let is_value = item.kind == ItemKind::Value;
    let number = |scope: Scope| match scope {
        Scope::Class => "0",
        Scope::Own => "1",
        Scope::Parameter => "2",
    };
    let change = move |e| {
        scope.set(match event_target_value(&e).as_str() {
            "1" => Scope::Own,
            "2" => Scope::Parameter,
            _ => Scope::Class,
        });
    };
    view! {
        <li class:inner=is_value>
            <code>{item.says}</code>
            <select aria-label=named prop:value=move || number(scope.get()) on:change=change>
                <option value="0">{words::OF_CLASS}</option>
                <option value="1">{words::OF_THIS_ONE}</option>
                {item.parameter.map(|name| view! { <option value="2">{words::parameter(&name)}</option> })}
            </select>
        </li>
    }
}

/// A point by which things of the class may be placed.
#[component]
fn Attacher(lab: Lab, path: String) -> impl IntoView {
    let (label, hover) = (path.clone(), path.clone());
    let path = StoredValue::new(path);
    let place = move || {
        lab.attachers.with(|chosen| {
            let chosen = chosen.as_ref()?;
            path.with_value(|path| chosen.iter().position(|c| c == path))
        })
    };
    view! {
        <li on:pointerenter=move |_| lab.hover(Some(hover.clone()))>
            <label>
                <input type="checkbox" prop:checked=move || place().is_some()
                    on:change=move |_| path.with_value(|path| lab.toggle_attacher(path)) />
                <code>{label}</code>
                <span class="quiet">{move || place().map(|n| (n + 1).to_string())}</span>
            </label>
        </li>
    }
}

impl Lab {
    /// Begins a class by example of what is selected.
    pub fn begin_class(self) {
        self.flush_text();
        self.attachers.set(Some(Vec::new()));
    }

    /// The paths of what is selected, for the session.
    fn chosen(self) -> Vec<Path> {
        self.selection_untracked().iter().filter_map(|p| session::parse_path(p)).collect()
    }

    fn class_items(self) -> Vec<ClassItem> {
        let paths = self.chosen();
        self.id().map(|id| self.ask(|s| s.class_items(id, &paths))).unwrap_or_default()
    }

    /// The points of what is selected, in the order of the picture.
    fn points_of_selection(self) -> Vec<String> {
        let selection = self.selection_untracked();
        self.picture.with_untracked(|picture| {
            let grips = picture.grips.iter().map(|grip| grip.path.clone());
            grips.filter(|path| selection.iter().any(|whole| covers(whole, path))).collect()
        })
    }

    /// Takes a point into those by which the class is placed, or out of them.
    pub fn toggle_attacher(self, path: &str) {
        let is_of_it = self.points_of_selection().iter().any(|known| known == path);
        self.attachers.update(|chosen| {
            let Some(chosen) = chosen.as_mut().filter(|_| is_of_it) else { return };
            match chosen.iter().position(|c| c == path) {
                Some(at) => drop(chosen.remove(at)),
                None => chosen.push(String::from(path)),
            }
        });
    }

    /// Makes the class.
    ///
    /// # Errors
    /// Why not, in one sentence.
    fn make_class(self, paths: &[Path], plan: &ClassPlan) -> Result<(), String> {
        let Some(id) = self.id() else { return Ok(()) };
        let made = self.ask(|session| session.class_of(id, paths, plan));
        let (command, name) = made.map_err(|refusal| refusal.in_a_line())?;
        if self.apply_called(&command, &words::make_class(&plan.name)) {
            self.select(Some(name));
            self.notice.set(Some(Notice::Said(words::class_made(&plan.name))));
            actions::run(actions::named("go-picture"), self);
            return Ok(());
        }
        match self.notice.get_untracked() {
            Some(Notice::Refused(refusal)) => {
                self.notice.set(None);
                Err(refusal.in_a_line())
            }
            _ => Ok(()),
        }
    }
}
