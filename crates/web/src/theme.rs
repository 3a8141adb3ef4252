//! Light and dark, and what else the page keeps in the browser: sizes of panels, unsaved texts.

use crate::js;
use leptos::prelude::*;
use wasm_bindgen::JsCast;
use wasm_bindgen::closure::Closure;

/// Which colours the page has.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Theme {
    /// As the system says.
    #[default]
    System,
    /// Dark on light.
    Light,
    /// Light on dark.
    Dark,
}

impl Theme {
    /// The one that comes next when a user asks for another.
    pub fn next(self) -> Self {
        match self {
            Self::System => Self::Light,
            Self::Light => Self::Dark,
            Self::Dark => Self::System,
        }
    }
    fn name(self) -> &'static str {
        match self {
            Self::System => "system",
            Self::Light => "light",
            Self::Dark => "dark",
        }
    }
}

const KEY: &str = "thinglab/theme";

/// The page's theme, and a count of how often its colours have changed.
#[derive(Clone, Copy, Debug)]
pub struct Colors {
    /// What the user chose.
    pub theme: RwSignal<Theme>,
    /// Grows with every change of the colours that one sees.
    pub changes: RwSignal<u32>,
}

/// Takes up the theme of the last visit and keeps the page in step with it.
pub fn start() -> Colors {
    let kept = keep(KEY).unwrap_or_default();
    let theme = [Theme::Light, Theme::Dark].into_iter().find(|t| t.name() == kept);
    let colors =
        Colors { theme: RwSignal::new(theme.unwrap_or_default()), changes: RwSignal::new(0) };
    Effect::new(move |_| {
        let name = colors.theme.get().name();
        if let Some(root) = document().document_element() {
            // The page has this attribute whatever is kept of it.
            let _ = root.set_attribute("data-theme", name);
        }
        put(KEY, Some(name));
        colors.changes.update(|n| *n += 1);
    });
    let changed = Closure::<dyn FnMut()>::new(move || colors.changes.update(|n| *n += 1));
    js::on_color_scheme(changed.into_js_value().unchecked_ref());
    colors
}

/// Reads what an earlier visit kept under a name.
pub fn keep(name: &str) -> Option<String> {
    window().local_storage().ok()??.get_item(name).ok()?
}

/// The names under which something is kept.
pub fn names() -> Vec<String> {
    let Ok(Some(storage)) = window().local_storage() else { return Vec::new() };
    let names = (0..storage.length().unwrap_or(0)).map(|at| storage.key(at));
    names.filter_map(|name| name.ok().flatten()).collect()
}

/// Keeps a text under a name, or nothing any more; returns false where the browser keeps nothing.
pub fn put(name: &str, text: Option<&str>) -> bool {
    let Ok(Some(storage)) = window().local_storage() else { return false };
    match text {
        Some(text) => storage.set_item(name, text).is_ok(),
        None => storage.remove_item(name).is_ok(),
    }
}
