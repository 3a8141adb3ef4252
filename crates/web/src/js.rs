//! What the browser's scripts do for the page: `assets/host.js` (the server) and
//! `assets/codemirror.js` (the text editor, built from `assets/editor/editor.src.js`).
//!
//! All offsets are UTF-8 byte offsets into the editor's text.

use js_sys::{Array, Object, Uint32Array};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen(raw_module = "./host.js")]
extern "C" {
    /// Sends a request with the server's token; gives `[status, text]`, status 0 without a server.
    pub async fn request(method: &str, path: &str, body: Option<&str>) -> Array;
}

#[wasm_bindgen(raw_module = "./codemirror.js")]
extern "C" {
    /// A text editor in the page.
    #[derive(Debug, Clone)]
    pub type Editor;

    /// Makes an editor inside `parent`; the options are listed in `editor.src.js`.
    #[wasm_bindgen(js_name = createEditor)]
    pub fn create_editor(parent: &web_sys::Element, options: &Object) -> Editor;

    /// The text as it stands.
    #[wasm_bindgen(method)]
    pub fn text(this: &Editor) -> String;

    /// Replaces the range in which the texts differ; calls nothing back.
    #[wasm_bindgen(method, js_name = setText)]
    pub fn set_text(this: &Editor, text: &str);

    /// Shows squiggles and messages: an array of `{from, to, severity, message}`.
    #[wasm_bindgen(method, js_name = setDiagnostics)]
    pub fn set_diagnostics(this: &Editor, diagnostics: &Array);

    /// Colours tokens: from, to, index into `classes`, repeated.
    #[wasm_bindgen(method, js_name = setTokens)]
    pub fn set_tokens(this: &Editor, spans: &Uint32Array, classes: &Array);

    /// Marks what is selected or hovered in another view; spans as in [`Editor::set_tokens`].
    #[wasm_bindgen(method, js_name = setMarks)]
    pub fn set_marks(this: &Editor, spans: &Uint32Array, classes: &Array);

    /// Moves the cursor and brings it into sight; calls nothing back.
    #[wasm_bindgen(method, js_name = setCursor)]
    pub fn set_cursor(this: &Editor, offset: u32);

    /// Gives the editor the keyboard.
    #[wasm_bindgen(method)]
    pub fn focus(this: &Editor);

    /// Takes the editor out of the page.
    #[wasm_bindgen(method)]
    pub fn destroy(this: &Editor);
}

/// Sets one option of an editor, a value or a callback.
pub fn set_option(options: &Object, name: &str, value: &wasm_bindgen::JsValue) {
    js_sys::Reflect::set(options, &name.into(), value).expect("a plain object takes any property");
}
