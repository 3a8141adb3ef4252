//! What the page asks of the server: the list of documents, a document, saving one, the library.
//!
//! In: names and texts. Out: what came back, or one sentence that says why not.

use crate::js::{field, request, text_field};
use crate::words;
use js_sys::{Array, JSON, Object};
use presentation::palette::Listed;
use wasm_bindgen::JsValue;

/// A document's text as it stands on disk.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Stored {
    /// The text.
    pub text: String,
    /// What the server calls this state of it.
    pub version: String,
    /// Whether it stands in the folder; others are built in.
    pub writable: bool,
}

/// What saving came to.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Saved {
    /// Saved; the new version.
    Done(String),
    /// Not saved: another text stands there now, or none.
    Changed(Option<Stored>),
    /// Not saved, in one sentence.
    Failed(String),
}

/// Asks, and reads the JSON of the answer.
async fn ask(method: &str, path: &str, body: Option<&str>) -> (u16, JsValue) {
    let answer: Array = request(method, path, body).await;
    let status = answer.get(0).as_f64().unwrap_or_default() as u16;
    let text = answer.get(1).as_string().unwrap_or_default();
    (status, JSON::parse(&text).unwrap_or(JsValue::UNDEFINED))
}

/// Says why an answer is not what was asked for.
fn failure(status: u16, json: &JsValue) -> String {
    match field(json, "error").as_string() {
        Some(sentence) => sentence,
        None if status == 0 => String::from(words::NO_SERVER),
        None => format!("{status}"),
    }
}

/// Returns the documents that there are.
///
/// # Errors
/// One sentence.
pub async fn documents() -> Result<Vec<Listed>, String> {
    let (status, json) = ask("GET", "/api/documents", None).await;
    if status != 200 {
        return Err(failure(status, &json));
    }
    Ok(Array::from(&json)
        .iter()
        .map(|one| Listed {
            path: text_field(&one, "path"),
            title: text_field(&one, "title"),
            in_gallery: text_field(&one, "place") == "gallery",
        })
        .collect())
}

/// Returns a document; nothing where there is none of that name yet.
///
/// # Errors
/// One sentence.
pub async fn document(path: &str) -> Result<Option<Stored>, String> {
    let query = String::from(js_sys::encode_uri_component(path));
    let (status, json) = ask("GET", &format!("/api/document?path={query}"), None).await;
    match status {
        200 => Ok(Some(Stored {
            text: text_field(&json, "text"),
            version: text_field(&json, "version"),
            writable: field(&json, "writable").as_bool().unwrap_or(false),
        })),
        404 => Ok(None),
        _ => Err(failure(status, &json)),
    }
}

/// Returns the table of a family, the text of a `.csv` file; nothing where there is no such file.
///
/// # Errors
/// One sentence: it cannot be read.
pub async fn table(path: &str) -> Result<Option<String>, String> {
    let query = String::from(js_sys::encode_uri_component(path));
    let (status, json) = ask("GET", &format!("/api/table?path={query}"), None).await;
    match status {
        200 => Ok(Some(text_field(&json, "text"))),
        404 => Ok(None),
        _ => Err(failure(status, &json)),
    }
}

/// Saves a document if its file still is of that version.
pub async fn save(path: &str, text: &str, version: &str) -> Saved {
    let body = Object::new();
    for (name, value) in [("path", path), ("text", text), ("version", version)] {
        crate::js::set_option(&body, name, &value.into());
    }
    let body = JSON::stringify(&body).map(String::from).unwrap_or_default();
    let (status, json) = ask("PUT", "/api/document", Some(&body)).await;
    match status {
        200 => Saved::Done(text_field(&json, "version")),
        409 => Saved::Changed(field(&json, "text").as_string().map(|text| Stored {
            text,
            version: text_field(&json, "version"),
            writable: true,
        })),
        _ => Saved::Failed(failure(status, &json)),
    }
}

/// Returns the library's files by name.
///
/// # Errors
/// One sentence.
pub async fn library() -> Result<Vec<(String, String)>, String> {
    let (status, json) = ask("GET", "/api/library", None).await;
    if status != 200 {
        return Err(failure(status, &json));
    }
    Ok(Array::from(&json)
        .iter()
        .map(|one| (text_field(&one, "name"), text_field(&one, "text")))
        .collect())
}

/// Returns what tabs have not saved of a document, by their names; nothing where the server keeps none.
pub async fn drafts(path: &str) -> Vec<(String, String)> {
    let query = String::from(js_sys::encode_uri_component(path));
    let (status, json) = ask("GET", &format!("/api/drafts?path={query}"), None).await;
    if status != 200 {
        return Vec::new();
    }
    let all = Array::from(&json);
    all.iter().map(|one| (text_field(&one, "tab"), text_field(&one, "draft"))).collect()
}

/// Has the server keep what a tab has not saved of a document, or nothing any more; returns whether it has answered.
/// What it refuses it would refuse again.
pub async fn keep_draft(path: &str, tab: &str, draft: Option<&str>) -> bool {
    let body = Object::new();
    let draft = draft.map_or(JsValue::NULL, JsValue::from);
    for (name, value) in [("path", path.into()), ("tab", tab.into()), ("draft", draft)] {
        crate::js::set_option(&body, name, &value);
    }
    let body = JSON::stringify(&body).map(String::from).unwrap_or_default();
    ask("PUT", "/api/draft", Some(&body)).await.0 != 0
}
