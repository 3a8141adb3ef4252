//! What the browser's scripts do for the page: `assets/host.js` (the server), `assets/painter.js`
//! (the canvas), `assets/page.js` (small things), `assets/worker.js` (long jobs), `assets/rest.js` (the code that comes
//! last) and `assets/codemirror.js` (the text editor, built from `assets/editor/editor.src.js`, fetched by
//! `assets/editor.js`).
//!
//! All offsets are UTF-8 byte offsets into the editor's text.

use js_sys::{Array, Function, Object, Uint8Array, Uint32Array};
use leptos::prelude::{document, request_animation_frame, set_timeout};
use std::time::Duration;
use wasm_bindgen::JsValue;
use wasm_bindgen::prelude::wasm_bindgen;

/// Does something once the page has been painted as it stands now; in a tab that nobody sees, which is not painted, soon.
pub fn after_painting(run: impl FnOnce() + 'static) {
    match document().hidden() {
        true => set_timeout(run, Duration::ZERO),
        false => request_animation_frame(move || set_timeout(run, Duration::ZERO)),
    }
}

#[wasm_bindgen(raw_module = "./host.js")]
extern "C" {
    /// Sends a request with the server's token; gives `[status, text]`, status 0 without a server.
    pub async fn request(method: &str, path: &str, body: Option<&str>) -> Array;
}

#[wasm_bindgen(raw_module = "./rest.js")]
extern "C" {
    /// Fetches the code that a first drag does not run, while the page goes on; tells in the end whether it has come: a page
    /// may be whole.
    #[wasm_bindgen(js_name = fetchRest)]
    pub async fn fetch_rest() -> JsValue;

    /// Fetches it at once. Functions that are not there yet call it of themselves.
    #[wasm_bindgen(js_name = loadRest)]
    pub fn load_rest();
}

#[wasm_bindgen(raw_module = "./editor.js")]
extern "C" {
    /// A text editor in the page.
    #[derive(Debug, Clone)]
    pub type Editor;

    /// Makes an [`Editor`] inside `parent`; the options are listed in `editor.src.js`. Fails where its code does not
    /// come.
    #[wasm_bindgen(js_name = createEditor, catch)]
    pub async fn create_editor(
        parent: &web_sys::Element,
        options: &Object,
    ) -> Result<JsValue, JsValue>;

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

#[wasm_bindgen(raw_module = "./painter.js")]
extern "C" {
    /// What paints a canvas and keeps it sharp.
    #[derive(Debug, Clone)]
    pub type Painter;

    /// Makes a painter; `on_size(width, height)` hears of every new size in CSS pixels.
    #[wasm_bindgen(js_name = createPainter)]
    pub fn create_painter(canvas: &web_sys::HtmlCanvasElement, on_size: &Function) -> Painter;

    /// Reads the page's colours again.
    #[wasm_bindgen(method)]
    pub fn look(this: &Painter);

    /// The colours that the document names.
    #[wasm_bindgen(method, js_name = setColors)]
    pub fn set_colors(this: &Painter, colors: &Array);

    /// The words of the picture.
    #[wasm_bindgen(method, js_name = setWords)]
    pub fn set_words(this: &Painter, words: &Array);

    /// Paints a display list (`paint.rs`); a point lies at `(x + kx * px, y + ky * py)`.
    #[wasm_bindgen(method)]
    pub fn paint(this: &Painter, list: &[f64], x: f64, y: f64, kx: f64, ky: f64);

    /// Keeps what is painted, so that the next lists are painted over it.
    #[wasm_bindgen(method)]
    pub fn keep(this: &Painter);

    /// Forgets what was kept.
    #[wasm_bindgen(method)]
    pub fn forget(this: &Painter);

    /// Stops watching the canvas.
    #[wasm_bindgen(method)]
    pub fn stop(this: &Painter);
}

#[wasm_bindgen(raw_module = "./page.js")]
extern "C" {
    /// Covers the page with a message after a panic.
    #[wasm_bindgen(js_name = showCrash)]
    pub fn show_crash(title: &str, advice: &str, reload: &str, details: &str);

    /// Whether this is the worker, which has no page.
    #[wasm_bindgen(js_name = isWorker)]
    pub fn is_worker() -> bool;

    /// In the worker: calls back with each job, as bytes, and a function that tells the page an answer; called without
    /// bytes that says that there are no more.
    pub fn serve(answer: &Function);

    /// Who answers long jobs.
    #[derive(Debug, Clone)]
    pub type Worker;

    /// Starts a [`Worker`], which calls back with a word and what belongs to it: `ready`; `part` and bytes; `over`;
    /// `failed` and why. Undefined where the browser refuses.
    #[wasm_bindgen(js_name = startWorker)]
    pub fn start_worker(said: &Function) -> JsValue;

    /// Hands it a job, as bytes.
    #[wasm_bindgen(method)]
    pub fn ask(this: &Worker, job: &Uint8Array);

    /// Ends it in the midst of whatever it does.
    #[wasm_bindgen(method)]
    pub fn end(this: &Worker);

    /// Lets the page have its turn.
    pub async fn pause();

    /// Waits until what is to be seen is painted.
    pub async fn painted();

    /// The name of this tab among those of the address.
    #[wasm_bindgen(js_name = tabName)]
    pub fn tab_name() -> String;

    /// The names of the tabs that live, as an array.
    #[wasm_bindgen(js_name = liveTabs)]
    pub async fn live_tabs() -> JsValue;

    /// Hands the user a file.
    pub fn download(name: &str, text: &str);

    /// Hands the user a file of bytes.
    #[wasm_bindgen(js_name = download)]
    pub fn download_bytes(name: &str, bytes: &[u8]);

    /// Hands the user an SVG as a PNG of twice its size.
    #[wasm_bindgen(js_name = downloadPng)]
    pub fn download_png(name: &str, svg: &str);

    /// Prints the page, of which the picture alone is on paper.
    #[wasm_bindgen(js_name = printPage)]
    pub fn print();

    /// Copies a text; gives whether the browser let it.
    pub async fn copy(text: &str) -> JsValue;

    /// The text that the clipboard holds; undefined where the browser does not let it be read.
    pub async fn pasted() -> JsValue;

    /// Hears of copy, cut and paste by the system's keys: `take` is told which and gives a text, `put` is given one.
    #[wasm_bindgen(js_name = onClipboard)]
    pub fn on_clipboard(take: &Function, put: &Function);

    /// Compresses a text into letters that an address may have.
    pub async fn pack(text: &str) -> JsValue;

    /// Brings such a text back; undefined where it is none.
    pub async fn unpack(packed: &str) -> JsValue;

    /// Lets a person choose a file of some endings, `.csv,text/csv`; calls back with its name and its text.
    #[wasm_bindgen(js_name = chooseFile)]
    pub fn choose_file(endings: &str, chosen: &Function);

    /// Makes `window.__thinglab.state()` of a function that gives JSON.
    pub fn publish(state: &Function);

    /// Makes `window.__bench` of JSON.
    #[wasm_bindgen(js_name = publishBench)]
    pub fn publish_bench(json: &str);

    /// Calls back when the system goes from light to dark or back.
    #[wasm_bindgen(js_name = onColorScheme)]
    pub fn on_color_scheme(callback: &Function);

    /// Whether the system asks for little motion.
    pub fn calm() -> bool;

    /// Whether a finger is the pointer.
    pub fn coarse() -> bool;

    /// Follows a pointer outside the element.
    pub fn capture(element: &web_sys::Element, pointer: i32);
}

/// Sets one option of an editor, a value or a callback.
pub fn set_option(options: &Object, name: &str, value: &JsValue) {
    js_sys::Reflect::set(options, &name.into(), value).expect("a plain object takes any property");
}

/// Reads one property of an object; undefined where there is none.
pub fn field(object: &JsValue, name: &str) -> JsValue {
    js_sys::Reflect::get(object, &name.into()).unwrap_or(JsValue::UNDEFINED)
}

/// Reads one text of an object; empty where there is none.
pub fn text_field(object: &JsValue, name: &str) -> String {
    field(object, name).as_string().unwrap_or_default()
}

/// The milliseconds since the page was begun.
pub fn now() -> f64 {
    leptos::prelude::window().performance().map_or(0.0, |performance| performance.now())
}
