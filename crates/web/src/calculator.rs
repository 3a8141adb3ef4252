//! The dock's calculator: expressions with their values, which follow every command and every drag.

use crate::lab::{Lab, Notice};
use crate::{icons, words};
use leptos::ev::KeyboardEvent;
use leptos::prelude::*;
use session::Command;

/// Expressions and their values.
#[component]
pub fn Calculator(
    /// The lab.
    lab: Lab,
) -> impl IntoView {
    let typed = RwSignal::new(String::new());
    let values = Memo::new(move |_| {
        lab.picture.track();
        lab.text.track();
        let sums = lab.sums.get();
        lab.tell(|session, id| session.calculate(id, &sums)).unwrap_or_default()
    });
    let add = move || {
        let text = typed.with_untracked(|text| String::from(text.trim()));
        if !text.is_empty() {
            lab.sums.update(|sums| sums.push(text));
            typed.set(String::new());
        }
    };
    let row = move |at: usize, written: String| {
        let value = Memo::new(move |_| values.with(|values| values.get(at).cloned()));
        let (kept, shown, label) =
            (written.clone(), written.clone(), words::calculator_without(&written));
        view! {
            <li>
                <code>{shown}</code>
                <output aria-label=written>
                    {move || match value.get() {
                        Some(Ok(value)) => view! { <span>"= "{value}</span> }.into_any(),
                        Some(Err(why)) => view! { <span class="error">{why}</span> }.into_any(),
                        None => ().into_any(),
                    }}
                </output>
                <button on:click=move |_| lab.keep_expression(&kept)>{words::KEEP_EXPRESSION}</button>
                <button class="bare" aria-label=label.clone() title=label
                    on:click=move |_| lab.sums.update(|sums| { if at < sums.len() { sums.remove(at); } })>
                    {icons::close()}</button>
            </li>
        }
    };
    view! {
        <section class="panel calculator" aria-label=words::CALCULATOR>
            <div class="scroll" tabindex="0" role="group" aria-label=words::CALCULATOR>
                <ul class="sums">
                    {move || lab.sums.get().into_iter().enumerate().map(|(at, text)| row(at, text)).collect_view()}
                </ul>
                <Show when=move || lab.sums.with(Vec::is_empty)>
                    <p class="quiet">{words::CALCULATOR_LEAD}</p>
                </Show>
            </div>
            <input class="expression" autocomplete="off" spellcheck="false" aria-label=words::EXPRESSION
                placeholder=words::EXPRESSION prop:value=typed
                on:input=move |e| typed.set(event_target_value(&e))
                on:keydown=move |e: KeyboardEvent| if e.key() == "Enter" { add() } />
        </section>
    }
}

impl Lab {
    /// Makes an expression a message of the document, under a name that is free.
    fn keep_expression(self, written: &str) {
        let text = self.text.with_untracked(|text| text.source.clone());
        let name = (1..).map(|n| format!("result{n}")).find(|name| !text.contains(name.as_str()));
        let Some(name) = name else { return };
        let members = format!("{name} => {written}");
        let target = session::Path::default();
        if self.apply(&Command::Edit { target, members }) {
            self.notice.set(Some(Notice::Said(words::expression_kept(&name))));
        }
    }
}
