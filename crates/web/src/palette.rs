//! The palette: every action by name, with its key or with the reason why not now; every construction and every class
//! of the bin that has the words; every document.

use crate::actions::{self, ACTIONS, Action};
use crate::lab::Lab;
use crate::server::Listed;
use crate::{route, words};
use leptos::ev::KeyboardEvent;
use leptos::html::Input;
use leptos::prelude::*;
use session::drafting::view::ConstructionRow;

/// The palette, while it is open.
#[component]
pub fn Palette(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    view! { <Show when=move || lab.palette.get()><Open lab=lab /></Show> }
}

#[component]
fn Open(lab: Lab) -> impl IntoView {
    let input = NodeRef::<Input>::new();
    let wanted = RwSignal::new(String::new());
    let at = RwSignal::new(0_usize);
    let before = StoredValue::new_local(document().active_element());
    let drawn = StoredValue::new(drawn(lab));
    let found = Memo::new(move |_| {
        at.set(0);
        let wanted = wanted.get();
        lab.listed.with(|listed| drawn.with_value(|drawn| matching(&wanted, listed, drawn)))
    });
    leptos::task::spawn_local(async move {
        // Without the list there are still the actions.
        let _ = lab.fetch_list().await;
    });
    Effect::new(move |_| {
        if let Some(input) = input.get() {
            // It stands in the page, so it takes the focus.
            let _ = input.focus();
        }
    });
    let close = move || {
        lab.palette.set(false);
        if let Some(element) = before.get_value() {
            let element: web_sys::HtmlElement = wasm_bindgen::JsCast::unchecked_into(element);
            // What had the keyboard may be gone.
            let _ = element.focus();
        }
    };
    let choose = move |n: usize| {
        let Some(choice) = found.with_untracked(|found| found.get(n).cloned()) else { return };
        close();
        match choice {
            Choice::Do(action) => actions::run(action, lab),
            Choice::Draw(row) => lab.begin_construction(&row.id),
            Choice::Insert(class) => {
                lab.take_tool(&class);
                crate::keyboard::focus("#picture");
            }
            Choice::Open(listed) => route::go(&route::to(&listed.path)),
        }
    };
    let key = move |e: KeyboardEvent| {
        let count = found.with_untracked(Vec::len).max(1);
        match e.key().as_str() {
            "ArrowDown" => at.update(|at| *at = (*at + 1) % count),
            "ArrowUp" => at.update(|at| *at = (*at + count - 1) % count),
            "Enter" => choose(at.get_untracked()),
            "Escape" => close(),
            "k" if e.ctrl_key() || e.meta_key() => close(),
            _ => return,
        }
        e.prevent_default();
        e.stop_propagation();
    };
    let rows = move || {
        let list = found.get().into_iter().enumerate();
        list.map(|(n, choice)| view! { <Entry lab=lab choice=choice n=n at=at choose=choose /> })
            .collect_view()
    };
    view! {
        <div class="shade" on:pointerdown=move |_| close()>
            <div class="palette" role="dialog" aria-modal="true" aria-label=words::PALETTE
                on:pointerdown=|e| e.stop_propagation()>
                <input node_ref=input type="text" role="combobox" aria-expanded="true"
                    aria-controls="actions" aria-autocomplete="list"
                    aria-activedescendant=move || format!("action-{}", at.get())
                    aria-label=words::PALETTE placeholder=words::PALETTE
                    spellcheck="false" autocomplete="off"
                    on:input=move |e| wanted.set(event_target_value(&e))
                    on:keydown=key />
                <ul id="actions" role="listbox" aria-label=words::PALETTE>{rows}</ul>
                <Show when=move || found.with(Vec::is_empty)>
                    <p class="quiet">{words::NO_SUCH_ACTION}</p>
                </Show>
            </div>
        </div>
    }
}

/// What can be chosen.
#[derive(Clone, PartialEq, Debug)]
enum Choice {
    Do(&'static Action),
    Draw(ConstructionRow),
    Insert(String),
    Open(Listed),
}

/// What can be drawn in the shown document: its constructions, and the classes of its bin.
type Drawn = (Vec<ConstructionRow>, Vec<String>);

fn drawn(lab: Lab) -> Drawn {
    let constructions = lab.ask_of_shown(session::Session::constructions).unwrap_or_default();
    let classes = lab.ask_of_shown(session::Session::bin_names).unwrap_or_default();
    (constructions, classes)
}

#[component]
fn Entry(
    lab: Lab,
    choice: Choice,
    n: usize,
    at: RwSignal<usize>,
    choose: impl Fn(usize) + Copy + 'static,
) -> impl IntoView {
    let (name, label, action) = match choice {
        Choice::Do(action) => (String::from(action.id), String::from(action.label), Some(action)),
        Choice::Draw(row) => (row.operands, row.label, None),
        Choice::Insert(class) => (class.clone(), words::place_one(&class), None),
        Choice::Open(listed) => (listed.path, format!("{} {}", words::OPEN, listed.title), None),
    };
    // of a document where it is, of a construction what it is made of
    let path = if action.is_none() { name.clone() } else { String::new() };
    let why = Memo::new(move |_| action.and_then(|action| (action.enabled)(lab).err()));
    let key = action.and_then(|action| action.keys.first());
    view! {
        <li id=format!("action-{n}") role="option" data-action=name
            aria-selected=move || (at.get() == n).to_string()
            aria-disabled=move || why.get().is_some().to_string()
            on:pointerenter=move |_| at.set(n)
            on:click=move |_| choose(n)>
            <span class="label">{label}</span>
            <span class="reason">{path}{why}</span>
            {key.map(|key| view! { <kbd>{*key}</kbd> })}
        </li>
    }
}

/// What has the words that are wanted in its label; then what has them in its own name; then what has each of
/// them somewhere; then what has all their letters in order, the shortest first: an action in its label, a
/// document, whose title may be long, in its path.
///
/// Constructions and classes are found by pieces of words, not by scattered letters. Those whose name begins so come
/// before documents, others after what has the words in its label or name.
fn matching(wanted: &str, listed: &[Listed], (constructions, classes): &Drawn) -> Vec<Choice> {
    let wanted = wanted.trim().to_lowercase();
    let rank = |label: &str, name: &str, short: &str| {
        let (label, name, short) =
            (label.to_lowercase(), name.to_lowercase(), short.to_lowercase());
        match () {
            () if label.contains(&wanted) => Some((0, 0)),
            () if name.contains(&wanted) => Some((1, 0)),
            () if wanted.split_whitespace().all(|word| label.contains(word)) => Some((2, 0)),
            () => scattered(&short, &wanted).then_some((3, short.len())),
        }
    };
    let action =
        |action: &'static Action| (rank(action.label, action.id, action.label), Choice::Do(action));
    // a title is a sentence, and may have any word in it: what is called so comes first
    let document = |one: &Listed| {
        let rank = rank(&one.title, &one.path, &one.path);
        (rank.map(|rank| rank.max((0, 2))), Choice::Open(one.clone()))
    };
    let has = |text: &str| {
        let text = text.to_lowercase();
        !wanted.is_empty() && wanted.split_whitespace().all(|word| text.contains(word))
    };
    let called = |text: &str| match text.to_lowercase().starts_with(&wanted) {
        true => (0, 1),
        false => (2, 1),
    };
    let construction = |row: &ConstructionRow| {
        let text = [&row.label, row.also].join(" ");
        (has(&text).then(|| called(&row.label)), Choice::Draw(row.clone()))
    };
    let class = |class: &String| (has(class).then(|| called(class)), Choice::Insert(class.clone()));
    let all = ACTIONS.iter().map(action).chain(constructions.iter().map(construction));
    let all = all.chain(classes.iter().map(class)).chain(listed.iter().map(document));
    let mut found: Vec<_> = all.filter_map(|(rank, choice)| Some((rank?, choice))).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, choice)| choice).collect()
}

fn scattered(label: &str, wanted: &str) -> bool {
    let mut letters = label.chars();
    wanted.chars().all(|letter| letters.any(|found| found == letter))
}

#[cfg(test)]
mod tests {
    use super::{Choice, ConstructionRow, matching};
    use crate::actions::ACTIONS;
    use crate::server::Listed;

    #[test]
    fn the_palette_finds_by_words_before_letters() {
        let listed = [Listed {
            path: String::from("gallery/bridge.thing"),
            title: String::from("Bridge under load"),
            in_gallery: true,
        }];
        let row = ConstructionRow {
            id: String::from("Axis.equidistant(first,second)"),
            class: String::from("Axis"),
            label: String::from(
                "Line of the points that are as far from one point as from another",
            ),
            operands: String::from("first, second"),
            doc: String::new(),
            also: "perpendicular bisector",
        };
        let drawn = (vec![row], vec![String::from("Resistor")]);
        assert_eq!(matching("", &listed, &drawn).len(), ACTIONS.len() + 1);
        let first = |wanted| match matching(wanted, &listed, &drawn).into_iter().next() {
            Some(Choice::Do(action)) => String::from(action.id),
            Some(Choice::Draw(row)) => row.id,
            Some(Choice::Insert(class)) => class,
            Some(Choice::Open(listed)) => listed.path,
            None => String::new(),
        };
        assert_eq!(first("zoom in"), "zoom-in");
        assert_eq!(first("undo"), "undo");
        assert_eq!(first("load bridge"), "gallery/bridge.thing");
        assert_eq!(first("under load"), "gallery/bridge.thing");
        assert_eq!(first("ftp"), "fit");
        assert_eq!(first("recog"), "recognise");
        assert_eq!(first("perpendicular bisector"), "Axis.equidistant(first,second)");
        assert_eq!(first("resist"), "Resistor");
        assert_eq!(first("brg"), "gallery/bridge.thing");
        // no piece of every word of a long title
        assert_eq!(first("bgeudload"), "");
        assert_eq!(first("qqq"), "");
    }
}
