//! The bars between panels: dragged or moved by the arrow keys, and remembered.

use crate::{js, theme, words};
use leptos::ev::{KeyboardEvent, PointerEvent};
use leptos::html::Div;
use leptos::prelude::*;

/// Towards where the bar goes when its panel grows.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Way {
    /// The panel lies to the left.
    Right,
    /// The panel lies to the right.
    Left,
    /// The panel lies below.
    Up,
    /// The panel lies above.
    Down,
}

impl Way {
    fn is_upright(self) -> bool {
        match self {
            Self::Right | Self::Left => true,
            Self::Up | Self::Down => false,
        }
    }
    fn sign(self) -> f64 {
        match self {
            Self::Right | Self::Down => 1.0,
            Self::Left | Self::Up => -1.0,
        }
    }
}

/// A bar that sets the style variable `--NAME` to its panel's size in pixels.
#[component]
pub fn Splitter(
    /// The variable's name.
    name: &'static str,
    /// Towards where its panel grows.
    way: Way,
    /// The panel's least size, in pixels.
    least: f64,
    /// The panel's greatest size, in pixels.
    most: f64,
) -> impl IntoView {
    let bar = NodeRef::<Div>::new();
    let key = format!("thinglab/size/{name}");
    let kept = theme::keep(&key).and_then(|kept| kept.parse::<f64>().ok());
    let size = RwSignal::new(kept.map(|size| size.clamp(least, most)));
    let grabbed = StoredValue::new(None::<(f64, f64)>);
    Effect::new(move |_| {
        let Some(size) = size.get() else { return };
        theme::put(&key, Some(&size.to_string()));
        set_variable(name, size);
    });
    // The size that the panel has now, whatever decided it.
    let present = move || {
        let Some(bar) = bar.try_get_untracked().flatten() else { return least };
        let panel = match way {
            Way::Right | Way::Down => bar.previous_element_sibling(),
            Way::Left | Way::Up => bar.next_element_sibling(),
        };
        let rect = panel.map(|panel| panel.get_bounding_client_rect());
        rect.map_or(least, |rect| if way.is_upright() { rect.width() } else { rect.height() })
    };
    let along = move |e: &PointerEvent| {
        f64::from(if way.is_upright() { e.client_x() } else { e.client_y() })
    };
    let now = RwSignal::new(least);
    Effect::new(move |_| {
        size.track();
        bar.track();
        request_animation_frame(move || {
            // A bar that is gone needs no value.
            let _ = now.try_set(present());
        });
    });
    let down = move |e: PointerEvent| {
        e.prevent_default();
        bar.get_untracked().inspect(|bar| js::capture(bar, e.pointer_id()));
        grabbed.set_value(Some((along(&e), present())));
    };
    let moved = move |e: PointerEvent| {
        if let Some((from, was)) = grabbed.get_value() {
            size.set(Some((was + way.sign() * (along(&e) - from)).clamp(least, most)));
        }
    };
    let pressed = move |e: KeyboardEvent| {
        let by = match e.key().as_str() {
            "ArrowRight" | "ArrowDown" => 16.0,
            "ArrowLeft" | "ArrowUp" => -16.0,
            _ => return,
        };
        e.prevent_default();
        size.set(Some((present() + way.sign() * by).clamp(least, most)));
    };
    view! {
        <div
            node_ref=bar
            class=format!("splitter {}", if way.is_upright() { "upright" } else { "level" })
            role="separator"
            tabindex="0"
            aria-label=format!("{} {name}", words::RESIZE)
            aria-orientation=if way.is_upright() { "vertical" } else { "horizontal" }
            aria-valuemin=least.to_string()
            aria-valuemax=most.to_string()
            aria-valuenow=move || format!("{:.0}", now.get())
            on:pointerdown=down
            on:pointermove=moved
            on:pointerup=move |_| grabbed.set_value(None)
            on:pointercancel=move |_| grabbed.set_value(None)
            on:keydown=pressed
            on:dblclick=move |_| {
                theme::put(&format!("thinglab/size/{name}"), None);
                unset_variable(name);
                size.set(None);
            }
        ></div>
    }
}

fn root_style() -> Option<web_sys::CssStyleDeclaration> {
    let root: web_sys::HtmlElement =
        wasm_bindgen::JsCast::unchecked_into(document().document_element()?);
    Some(root.style())
}

fn set_variable(name: &str, size: f64) {
    if let Some(style) = root_style() {
        // A style variable can always be set.
        let _ = style.set_property(&format!("--{name}"), &format!("{size}px"));
    }
}

fn unset_variable(name: &str) {
    if let Some(style) = root_style() {
        // As above.
        let _ = style.remove_property(&format!("--{name}"));
    }
}
