//! Addresses: `#/gallery/quadrilateral.thing` shows a document, everything else the gallery.
//!
//! `?document=PATH`, which the server prints, is turned into the first form at once.

use leptos::prelude::*;
use wasm_bindgen::JsValue;

/// The address of a document.
pub fn to(path: &str) -> String {
    let encoded: Vec<String> =
        path.split('/').map(|part| String::from(js_sys::encode_uri_component(part))).collect();
    format!("#/{}", encoded.join("/"))
}

/// The address of the gallery.
pub const GALLERY: &str = "#/";

/// The document that the page's address names.
pub fn present() -> Option<String> {
    let hash = window().location().hash().unwrap_or_default();
    let path = js_sys::decode_uri_component(hash.strip_prefix("#/")?).ok().map(String::from)?;
    (!path.is_empty()).then_some(path)
}

const SHARED: &str = "#share=";

/// The address of this page that carries a packed document.
pub fn to_shared(packed: &str) -> String {
    format!("{SHARED}{packed}")
}

/// The same in full, to hand on.
pub fn share(packed: &str) -> String {
    let location = window().location();
    let (origin, path) = (location.origin(), location.pathname());
    format!("{}{}{}", origin.unwrap_or_default(), path.unwrap_or_default(), to_shared(packed))
}

/// The packed document that the page's address carries.
pub fn shared() -> Option<String> {
    let hash = window().location().hash().unwrap_or_default();
    hash.strip_prefix(SHARED).map(String::from)
}

/// One parameter of the page's query.
pub fn asked(name: &str) -> Option<String> {
    let search = window().location().search().ok()?;
    web_sys::UrlSearchParams::new_with_str(&search).ok()?.get(name)
}

/// Turns the address that the server printed into the one that is kept; a bench stays one.
pub fn settle() {
    if present().is_some() || shared().is_some() {
        return;
    }
    let Some(path) = asked("document") else { return };
    let bench = asked("bench").map_or_else(String::new, |bench| format!("?bench={bench}"));
    let location = window().location();
    let url = format!("{}{bench}{}", location.pathname().unwrap_or_default(), to(&path));
    if let Ok(history) = window().history() {
        // An address that the browser will not have is no loss.
        let _ = history.replace_state_with_url(&JsValue::NULL, "", Some(&url));
    }
}

/// Makes an address the page's own without going anywhere.
pub fn replace(address: &str) {
    if let Ok(history) = window().history() {
        // An address that the browser will not have is no loss.
        let _ = history.replace_state_with_url(&JsValue::NULL, "", Some(address));
    }
}

/// Goes to an address of the page.
pub fn go(address: &str) {
    // A fragment can always be set.
    let _ = window().location().set_hash(address);
}
