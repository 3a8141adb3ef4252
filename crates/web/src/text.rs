//! The text view: CodeMirror with the session's colours and diagnostics, a list of these, and what its keys ask for.

use crate::dialog::Wish;
use crate::js::{self, Editor, set_option};
use crate::lab::{Lab, Notice};
use crate::{icons, words};
use js_sys::{Array, Object, Uint32Array};
use leptos::ev::KeyboardEvent;
use leptos::html::{Div, Pre};
use leptos::prelude::*;
use presentation::rows::{path_at, span_of};
use presentation::typing::is_of_unfinished;
use session::view::{DeclaredView, DiagnosticView, TextView, WordView};
use session::{Command, Session};
use wasm_bindgen::closure::Closure;
use wasm_bindgen::{JsCast, JsValue};

/// The kinds of tokens, as the session calls them.
const KINDS: [&str; 9] =
    ["keyword", "class", "name", "number", "text", "comment", "doc", "operator", "error"];

/// The text of the open document.
#[component]
pub fn Text(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let place = NodeRef::<Div>::new();
    let editor = StoredValue::new_local(None::<Editor>);
    let peek = RwSignal::new(None::<DeclaredView>);
    let made = Trigger::new();
    let fetching = RwSignal::new(Ok::<bool, ()>(true));
    Effect::new(move |_| {
        let Some(parent) = place.get() else { return };
        let options = options(lab);
        ask_by_keys(lab, editor, peek, &options);
        leptos::task::spawn_local(async move {
            let new = js::create_editor(&parent, &options).await;
            fetching.try_set(new.as_ref().map(|_| false).map_err(|_| ()));
            let Ok(new) = new.map(JsCast::unchecked_into::<Editor>) else { return };
            match editor.try_set_value(Some(new.clone())) {
                None => made.notify(),
                // the panel was shut meanwhile
                Some(_) => return new.destroy(),
            }
            if document().active_element().as_ref() == Some(parent.unchecked_ref()) {
                new.focus();
            }
        });
    });
    // Marks are offsets into the text that is shown, so they come after it.
    let shown = Trigger::new();
    on_cleanup(move || {
        lab.flush_text();
        editor.with_value(|editor| editor.as_ref().map(Editor::destroy)).unwrap_or_default();
    });
    Effect::new(move |_| {
        made.track();
        lab.typed_at.track();
        lab.text.with(|text| {
            // What is being typed is newer than what the session knows.
            if !lab.is_typing() {
                editor.with_value(|editor| editor.as_ref().map(|editor| show(lab, editor, text)));
            }
        });
        shown.notify();
    });
    Effect::new(move |_| {
        shown.track();
        let (selected, hovered) = (lab.selected.get(), lab.hovered.get());
        lab.structure.with(|rows| {
            let selected = selected.and_then(|path| span_of(rows, &path));
            let hovered = hovered.and_then(|path| span_of(rows, &path));
            editor.with_value(|editor| {
                editor.as_ref().map(|editor| mark(editor, place, selected, hovered))
            });
        });
    });
    let diagnostics = Memo::new(move |_| lab.told_diagnostics());
    view! {
        <section class="panel text" aria-label=words::TEXT>
            <header class="head">
                <h2>{words::TEXT}</h2>
                <span class="quiet">{move || lab.current.get()}</span>
            </header>
            {move || match fetching.get() {
                Ok(true) => Some(words::EDITOR_COMES),
                Ok(false) => None,
                Err(()) => Some(words::EDITOR_FAILED),
            }.map(|words| view! { <p class="quiet" role="status">{words}</p> })}
            <div class="editor" id="editor" tabindex="-1" node_ref=place></div>
            {move || peek.get().map(|declared| view! { <Peek declared=declared peek=peek editor=editor /> })}
            <Show when=move || diagnostics.with(|list| !list.is_empty())>
                <ul class="problems" aria-label=words::PROBLEMS>
                    <For each=move || diagnostics.get().into_iter().enumerate() key=|(at, d)| (*at, d.message.clone()) let((_, d))>
                        <Problem lab=lab editor=editor d=d />
                    </For>
                </ul>
            </Show>
        </section>
    }
}

#[component]
fn Problem(
    lab: Lab,
    editor: StoredValue<Option<Editor>, LocalStorage>,
    d: DiagnosticView,
) -> impl IntoView {
    let start = d.start;
    let own = d.file.is_empty();
    let place = if own {
        words::line_column(d.line, d.column)
    } else {
        format!("{}, {}", d.file, words::line_column(d.line, d.column))
    };
    let go = move |_| {
        if own {
            go_to(editor, start);
        }
    };
    view! {
        <li class=d.severity.clone()>
            <button on:click=go>
                {icons::warning()}
                <span class="message">{d.message.clone()}
                    {d.hint.clone().map(|hint| view! { <span class="hint">{hint}</span> })}</span>
                <span class="place"><code>{d.code.clone()}</code>" "{place}</span>
            </button>
            {d.fixes.into_iter().map(|fix| {
                let title = fix.title.clone();
                view! { <button class="fix" on:click=move |_| lab.fix(&fix)>{title}</button> }
            }).collect_view()}
        </li>
    }
}

/// The text of another file, where a name is declared that the document's own text uses.
#[component]
fn Peek(
    declared: DeclaredView,
    peek: RwSignal<Option<DeclaredView>>,
    editor: StoredValue<Option<Editor>, LocalStorage>,
) -> impl IntoView {
    let place = NodeRef::<Pre>::new();
    Effect::new(move |_| {
        let Some(text) = place.get() else { return };
        request_animation_frame(move || {
            let mark = text.query_selector("mark").ok().flatten();
            if let Some(mark) = mark.and_then(|mark| mark.dyn_into::<web_sys::HtmlElement>().ok()) {
                text.set_scroll_top(mark.offset_top() - text.offset_top() - 48);
            }
            // It stands in the page, so it takes the focus.
            let _ = text.focus();
        });
    });
    let shut = move || {
        peek.set(None);
        editor.with_value(|editor| editor.as_ref().map(Editor::focus));
    };
    let key = move |e: KeyboardEvent| {
        if e.key() == "Escape" {
            e.prevent_default();
            e.stop_propagation();
            shut();
        }
    };
    let DeclaredView { file, text, start, end } = declared;
    let piece = |from: u32, to: usize| text.get(from as usize..to).unwrap_or_default().to_string();
    let (before, name, after) =
        (piece(0, start as usize), piece(start, end as usize), piece(end, text.len()));
    view! {
        <aside class="peek" aria-label=words::declared_in(&file) on:keydown=key>
            <header class="head">
                <h3>{file.clone()}</h3>
                <span class="quiet">{words::OF_A_LIBRARY}</span>
                <button class="bare" aria-label=words::CLOSE title=words::CLOSE on:click=move |_| shut()>{icons::close()}</button>
            </header>
            <pre tabindex="0" node_ref=place>{before}<mark>{name}</mark>{after}</pre>
        </aside>
    }
}

/// Puts the cursor somewhere in the text.
fn go_to(editor: StoredValue<Option<Editor>, LocalStorage>, offset: u32) {
    editor.with_value(|editor| {
        editor.as_ref().map(|editor| {
            editor.set_cursor(offset);
            editor.focus();
        })
    });
}

/// What the keys of the editor ask for: what a word is, where it is declared, another name, a fix, another layout.
fn ask_by_keys(
    lab: Lab,
    editor: StoredValue<Option<Editor>, LocalStorage>,
    peek: RwSignal<Option<DeclaredView>>,
    options: &Object,
) {
    let word_at = move |offset: u32| -> Option<WordView> {
        let text = lab.written();
        lab.ask_of_shown(|session, id| session.word_at(id, &text, offset)).flatten()
    };
    let said = move |sentence: String| lab.notice.set(Some(Notice::Said(sentence)));
    let about = Closure::<dyn FnMut(u32) -> JsValue>::new(move |offset| {
        let Some(word) = word_at(offset) else { return JsValue::NULL };
        let object = Object::new();
        set_option(&object, "from", &word.start.into());
        set_option(&object, "to", &word.end.into());
        set_option(&object, "says", &word.says.into());
        set_option(&object, "doc", &word.doc.into());
        set_option(&object, "value", &word.value.into());
        object.into()
    });
    set_option(options, "about", &about.into_js_value());
    let definition = Closure::<dyn FnMut(u32)>::new(move |offset| {
        match word_at(offset).map(|word| (word.says, word.declared)) {
            Some((_, Some(declared))) if declared.file.is_empty() => go_to(editor, declared.start),
            Some((_, Some(declared))) => peek.set(Some(declared)),
            Some((says, None)) => said(words::of_the_language(&says)),
            None => said(String::from(words::NAMES_NOTHING)),
        }
    });
    set_option(options, "onDefinition", &definition.into_js_value());
    let rename = Closure::<dyn FnMut(u32)>::new(move |offset| {
        lab.flush_text();
        match word_at(offset) {
            Some(WordView { declared: Some(declared), says, .. }) if !declared.file.is_empty() => {
                said(words::keeps_its_name(&says, &declared.file));
            }
            Some(word) if word.path.is_empty() => said(words::of_the_language(&word.says)),
            Some(word) => lab.wish.set(Some(Wish::Rename(word.path))),
            None => said(String::from(words::NAMES_NOTHING)),
        }
    });
    set_option(options, "onRename", &rename.into_js_value());
    let format = Closure::<dyn FnMut()>::new(move || {
        lab.flush_text();
        let text = lab.written();
        match session::misspelled(&text) {
            Some((line, column, message)) => {
                said(format!("{}: {message}", words::line_column(line, column)));
            }
            None => drop(lab.apply(&Command::Text(session::format(&text)))),
        }
    });
    set_option(options, "onFormat", &format.into_js_value());
    let fix = Closure::<dyn FnMut(usize, usize)>::new(move |problem: usize, fix: usize| {
        let chosen = lab.text.with_untracked(|text| {
            text.diagnostics.get(problem).and_then(|d| d.fixes.get(fix).cloned())
        });
        chosen.inspect(|fix| lab.fix(fix));
    });
    set_option(options, "onFix", &fix.into_js_value());
}

/// What the editor calls back.
fn options(lab: Lab) -> Object {
    let options = Object::new();
    let set = |name: &str, closure: JsValue| set_option(&options, name, &closure);
    set_option(&options, "text", &lab.text.with_untracked(|text| text.source.clone()).into());
    set_option(&options, "label", &words::TEXT.into());
    // a change is told before the place of the cursor behind it
    let is_change = StoredValue::new(false);
    let changed = Closure::<dyn FnMut(String)>::new(move |text| {
        is_change.set_value(true);
        lab.typed_text(text);
    });
    set("onChange", changed.into_js_value());
    let cursor = Closure::<dyn FnMut(u32)>::new(move |offset| {
        let typed_at =
            is_change.try_update_value(std::mem::take).unwrap_or(false).then_some(offset);
        lab.type_at(typed_at);
        lab.list();
        if let Some(path) = lab.structure.with_untracked(|rows| path_at(rows, offset)) {
            lab.select(Some(path));
        }
    });
    set("onCursor", cursor.into_js_value());
    let hover = Closure::<dyn FnMut(f64)>::new(move |offset: f64| {
        let inside = (offset >= 0.0).then_some(offset as u32);
        lab.hover(inside.and_then(|at| lab.structure.with_untracked(|rows| path_at(rows, at))));
    });
    set("onHover", hover.into_js_value());
    let back = Closure::<dyn FnMut()>::new(move || lab.undo());
    set("onUndo", back.into_js_value());
    let again = Closure::<dyn FnMut()>::new(move || {
        lab.apply(&Command::Redo);
    });
    set("onRedo", again.into_js_value());
    let complete = Closure::<dyn FnMut(u32) -> Array>::new(move |offset| {
        let text = lab.written();
        lab.ask_of_shown(|session, id| session.completions(id, &text, offset))
            .unwrap_or_default()
            .into_iter()
            .map(|word| {
                let object = Object::new();
                set_option(&object, "label", &word.label.into());
                set_option(&object, "kind", &word.kind.into());
                set_option(&object, "detail", &word.detail.into());
                JsValue::from(object)
            })
            .collect()
    });
    set("complete", complete.into_js_value());
    let leave = Closure::<dyn FnMut()>::new(move || lab.flush_text());
    set("onLeave", leave.into_js_value());
    options
}

/// Shows a text with its colours and what is wrong with it.
fn show(lab: Lab, editor: &Editor, text: &TextView) {
    editor.set_text(&text.source);
    let tokens = lab.ask_of_shown(Session::tokens).unwrap_or_default();
    let number = |kind: &str| KINDS.iter().position(|k| *k == kind).unwrap_or(2) as u32;
    let spans: Vec<u32> = tokens.iter().flat_map(|t| [t.start, t.end, number(&t.kind)]).collect();
    let classes: Array = KINDS.iter().map(|kind| JsValue::from(format!("tok-{kind}"))).collect();
    editor.set_tokens(&Uint32Array::from(&spans[..]), &classes);
    let typed_at = lab.typed_at.get_untracked();
    let own = (0_u32..).zip(&text.diagnostics);
    let own = own.filter(|(_, d)| d.file.is_empty() && !is_of_unfinished(d, typed_at));
    let squiggles: Array = own.map(|(number, d)| squiggle(number, d)).collect();
    editor.set_diagnostics(&squiggles);
}

fn squiggle(number: u32, d: &DiagnosticView) -> JsValue {
    let object = Object::new();
    let is_mild = matches!(d.severity.as_str(), "note" | "recording");
    let severity = if is_mild { "info" } else { &d.severity };
    let message = match &d.hint {
        Some(hint) => format!("{}\n{hint}", d.message),
        None => d.message.clone(),
    };
    set_option(&object, "from", &d.start.into());
    set_option(&object, "to", &d.end.into());
    set_option(&object, "severity", &severity.into());
    set_option(&object, "message", &message.into());
    set_option(&object, "number", &number.into());
    let fixes: Array = d.fixes.iter().map(|fix| JsValue::from(&fix.title)).collect();
    set_option(&object, "fixes", &fixes);
    object.into()
}

/// Marks where the selected and the hovered thing are written; brings the selected one into sight
/// unless the user is writing.
fn mark(
    editor: &Editor,
    place: NodeRef<Div>,
    selected: Option<(u32, u32)>,
    hovered: Option<(u32, u32)>,
) {
    let spans: Vec<u32> = [(hovered, 0), (selected, 1)]
        .into_iter()
        .filter_map(|(span, class)| span.map(|(start, end)| [start, end, class]))
        .flatten()
        .collect();
    let classes: Array = ["mark-hovered", "mark-selected"].map(JsValue::from).into_iter().collect();
    editor.set_marks(&Uint32Array::from(&spans[..]), &classes);
    let writing = place.get_untracked().is_some_and(|place| {
        document()
            .active_element()
            .is_some_and(|active| place.contains(Some(active.unchecked_ref())))
    });
    if let (Some((start, _)), false) = (selected, writing) {
        editor.set_cursor(start);
    }
}
