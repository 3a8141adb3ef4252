//! What is answered: the page's files, and the documents as JSON.
//!
//! - `GET /api/documents` → `[{path, name, title, place, writable}]`; `place` is `folder` or `gallery`
//! - `GET /api/document?path=P` → `{path, text, version, writable}`
//! - `PUT /api/document` with `{path, text, version}` → `{version}`; where the file is no longer
//!   that version, status 409 and what stands there now, `{text, version}`, both null for no file;
//!   the version `absent` makes a new file
//! - `GET /api/table?path=P` → `{text}`: the table of a family, a `.csv` beside its document
//! - `GET /api/drafts?path=P` → `[{tab, draft}]`: what tabs have not saved of a document
//! - `PUT /api/draft` with `{path, tab, draft}` → `{}` once it is on disk; null for nothing any more
//! - `GET /api/library` → `[{name, text}]`
//!
//! Every error is `{error: sentence}` with its status. Long answers are compressed for whoever takes that, but for those
//! of more than a megabyte.

use std::borrow::Cow;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::Write as _;
use std::time::Duration;

use http_body_util::{BodyExt, Full, LengthLimitError, Limited};
use hyper::body::{Body as _, Bytes, Incoming};
use hyper::header::{
    ACCEPT_ENCODING, ALLOW, CONTENT_ENCODING, CONTENT_TYPE, ETAG, HeaderMap, HeaderName,
    HeaderValue, IF_NONE_MATCH, VARY,
};
use hyper::{Method, Request, Response, StatusCode};
use serde::{Deserialize, Serialize};

use super::Lab;
use super::guard::Ask;
use crate::disk::{self, DiskError, Version};
use crate::embedded;

/// The longest body, in bytes: a longest document whose every byte is escaped as two.
const LONGEST_BODY: usize = 2 * disk::LONGEST;

/// How long a whole body may take to arrive.
const BODY_TIME: Duration = Duration::from_secs(60);

/// Answers from so many bytes on are compressed: shorter ones fit into a packet as they are.
const WORTH_COMPRESSING: usize = 1400;
/// Longer ones are sent as they are: within a machine that takes less time, and one that is compressed holds up the others.
const MOST_COMPRESSED: usize = 1 << 20;

/// How hard the compressor tries, as each answer waits for it, and how far back it looks, as a power of two.
const QUALITY: u32 = 5;
const WINDOW: u32 = 22;

/// What every answer says of itself: what the page may load, and that no other page may use it.
/// Styles may be inline, because the text editor makes its own; scripts may not.
const SECURITY: [(&str, &str); 8] = [
    (
        "content-security-policy",
        "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; \
         img-src 'self' blob: data:; font-src 'self'; connect-src 'self'; worker-src 'self'; \
         manifest-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    ),
    ("x-content-type-options", "nosniff"),
    ("x-frame-options", "DENY"),
    ("referrer-policy", "no-referrer"),
    ("cross-origin-opener-policy", "same-origin"),
    ("cross-origin-embedder-policy", "require-corp"),
    ("cross-origin-resource-policy", "same-origin"),
    ("cache-control", "no-cache"),
];

const NO_PAGE: &str = "<!doctype html><meta charset=utf-8><title>ThingLab</title>\
    <p>This thinglab was built without its page. <code>cargo lab</code> builds it in <code>dist</code>: \
    <code>thinglab serve --page dist</code>.";

type Answer = Response<Full<Bytes>>;

#[derive(Debug, Serialize)]
struct Listed<'a> {
    path: &'a str,
    name: &'a str,
    title: String,
    place: &'static str,
    writable: bool,
}

#[derive(Debug, Serialize)]
struct Opened<'a> {
    path: &'a str,
    text: &'a str,
    version: &'a Version,
    writable: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Saving {
    path: String,
    text: String,
    version: Version,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Keeping {
    path: String,
    tab: String,
    draft: Option<String>,
}

#[derive(Debug, Serialize)]
struct Saved {
    version: Version,
}

#[derive(Debug, Serialize)]
struct Conflict {
    error: String,
    text: Option<String>,
    version: Option<Version>,
}

#[derive(Debug, Serialize)]
struct LibraryFile {
    name: &'static str,
    text: &'static str,
}

/// Answers one request.
pub(crate) async fn answer(lab: &Lab, request: Request<Incoming>) -> Answer {
    let path = request.uri().path();
    let ask = if path == "/api" || path.starts_with("/api/") { Ask::Documents } else { Ask::Page };
    let checked = lab.guard.check(ask, request.method(), request.uri(), request.headers());
    let mut answer = match checked {
        Err((status, why)) => refused(status, why),
        Ok(()) => match ask {
            Ask::Page => page(lab, request.method(), path, request.headers()),
            Ask::Documents if takes_brotli(request.headers()) => {
                compressed(documents(lab, request).await).await
            }
            Ask::Documents => documents(lab, request).await,
        },
    };
    for (name, value) in SECURITY {
        answer.headers_mut().insert(HeaderName::from_static(name), HeaderValue::from_static(value));
    }
    answer
}

/// A file of the page, by its exact address; compressed where it is kept so and the browser takes that.
fn page(lab: &Lab, method: &Method, path: &str, headers: &HeaderMap) -> Answer {
    if *method != Method::GET && *method != Method::HEAD {
        return only_methods("GET, HEAD");
    }
    let kind = kind_of(if path == "/" { ".html" } else { path });
    if takes_brotli(headers)
        && let Some(bytes) = lab.page.file(&format!("{path}.br"))
    {
        let mut answer = file_answer(kind, bytes, headers);
        say_compressed(answer.headers_mut());
        return answer;
    }
    match lab.page.file(path) {
        Some(bytes) => file_answer(kind, bytes, headers),
        None if path == "/" => {
            bytes_answer(StatusCode::OK, kind, Bytes::from_static(NO_PAGE.as_bytes()))
        }
        None => refused(StatusCode::NOT_FOUND, "no such page"),
    }
}

/// A file, named by what it holds; not sent to a browser that has it already.
fn file_answer(kind: &'static str, bytes: Cow<'static, [u8]>, headers: &HeaderMap) -> Answer {
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    let tag = format!("\"{:016x}\"", hasher.finish());
    let known = headers.get(IF_NONE_MATCH).and_then(|value| value.to_str().ok());
    let is_known = known.is_some_and(|known| known.split(',').any(|one| one.trim() == tag));
    let mut answer = match is_known {
        true => bytes_answer(StatusCode::NOT_MODIFIED, kind, Bytes::new()),
        false => bytes_answer(StatusCode::OK, kind, owned(bytes)),
    };
    if let Ok(tag) = HeaderValue::from_str(&tag) {
        answer.headers_mut().insert(ETAG, tag);
    }
    answer
}

fn owned(bytes: Cow<'static, [u8]>) -> Bytes {
    match bytes {
        Cow::Borrowed(bytes) => Bytes::from_static(bytes),
        Cow::Owned(bytes) => Bytes::from(bytes),
    }
}

/// A long answer compressed, a short one as it is.
async fn compressed(answer: Answer) -> Answer {
    let (mut parts, body) = answer.into_parts();
    let Ok(whole) = body.collect().await;
    let plain = whole.to_bytes();
    if !(WORTH_COMPRESSING..=MOST_COMPRESSED).contains(&plain.len()) {
        return Response::from_parts(parts, Full::new(plain));
    }
    let mut bytes = Vec::new();
    let mut writer = brotli::CompressorWriter::new(&mut bytes, 1 << 16, QUALITY, WINDOW);
    writer.write_all(&plain).expect("a list takes all that is written");
    drop(writer);
    say_compressed(&mut parts.headers);
    Response::from_parts(parts, Full::new(Bytes::from(bytes)))
}

fn say_compressed(headers: &mut HeaderMap) {
    headers.insert(CONTENT_ENCODING, HeaderValue::from_static("br"));
    headers.insert(VARY, HeaderValue::from_static("accept-encoding"));
}

/// Whether a request takes an answer compressed by brotli.
fn takes_brotli(headers: &HeaderMap) -> bool {
    let taken = headers.get(ACCEPT_ENCODING).and_then(|value| value.to_str().ok());
    taken.is_some_and(|taken| {
        taken.split(',').any(|one| {
            let mut parts = one.split(';').map(str::trim);
            let is_br = parts.next().is_some_and(|name| name.eq_ignore_ascii_case("br"));
            let is_none = |weight: &str| {
                let number =
                    weight.strip_prefix(['q', 'Q']).and_then(|rest| rest.strip_prefix('='));
                number.and_then(|number| number.parse().ok()) == Some(0.0)
            };
            is_br && !parts.any(is_none)
        })
    })
}

/// The media type of a file of the page.
fn kind_of(name: &str) -> &'static str {
    match name.rsplit('.').next().unwrap_or_default() {
        "html" => "text/html; charset=utf-8",
        "css" => "text/css; charset=utf-8",
        "js" => "text/javascript; charset=utf-8",
        "svg" => "image/svg+xml",
        "txt" => "text/plain; charset=utf-8",
        "wasm" => "application/wasm",
        "json" | "webmanifest" => "application/json",
        "woff2" => "font/woff2",
        "png" => "image/png",
        _ => "application/octet-stream",
    }
}

async fn documents(lab: &Lab, request: Request<Incoming>) -> Answer {
    let get = *request.method() == Method::GET || *request.method() == Method::HEAD;
    match request.uri().path() {
        "/api/documents" if get => list(lab),
        "/api/document" if get => match asked_path(request.uri().query().unwrap_or_default()) {
            Some(path) => open(lab, &path),
            None => refused(StatusCode::BAD_REQUEST, "the query is not path=NAME"),
        },
        "/api/document" if *request.method() == Method::PUT => {
            match body(request, "{path, text, version}").await {
                Ok(saving) => save(lab, &saving),
                Err(answer) => answer,
            }
        }
        "/api/drafts" if get => match asked_path(request.uri().query().unwrap_or_default()) {
            Some(path) => drafts(lab, &path),
            None => refused(StatusCode::BAD_REQUEST, "the query is not path=NAME"),
        },
        "/api/draft" if *request.method() == Method::PUT => {
            match body(request, "{path, tab, draft}").await {
                Ok(keeping) => keep(lab, &keeping),
                Err(answer) => answer,
            }
        }
        "/api/draft" => only_methods("PUT"),
        "/api/table" if get => match asked_path(request.uri().query().unwrap_or_default()) {
            Some(path) => table(lab, &path),
            None => refused(StatusCode::BAD_REQUEST, "the query is not path=NAME"),
        },
        "/api/library" if get => library(),
        "/api/document" => only_methods("GET, HEAD, PUT"),
        "/api/documents" | "/api/table" | "/api/drafts" | "/api/library" => {
            only_methods("GET, HEAD")
        }
        _ => refused(StatusCode::NOT_FOUND, "no such page"),
    }
}

/// The documents of the folder, and those of the gallery that the folder does not have itself.
fn list(lab: &Lab) -> Answer {
    let names = match disk::list(&lab.root) {
        Ok(names) => names,
        Err(error) => return disk_answer(error),
    };
    let mut listed = Vec::new();
    for name in &names {
        let text = disk::read(&lab.root, name).map(|stored| stored.text).unwrap_or_default();
        let place = if name.starts_with("gallery/") { "gallery" } else { "folder" };
        listed.push(Listed {
            path: name,
            name: stem(name),
            title: title(name, &text),
            place,
            writable: true,
        });
    }
    let kept: Vec<(String, &str)> =
        embedded::GALLERY.iter().map(|(name, text)| (format!("gallery/{name}"), *text)).collect();
    for (path, text) in kept.iter().filter(|(path, _)| names.binary_search(path).is_err()) {
        let (name, title) = (stem(path), title(path, text));
        listed.push(Listed { path, name, title, place: "gallery", writable: false });
    }
    json(StatusCode::OK, &listed)
}

/// A document's name without folder and ending.
fn stem(path: &str) -> &str {
    let name = path.rsplit('/').next().unwrap_or(path);
    name.strip_suffix(".thing").unwrap_or(name)
}

/// What a document's first comment calls it, up to a full stop; else its name.
fn title(path: &str, text: &str) -> String {
    let first = text.lines().next().unwrap_or_default();
    let comment = first.strip_prefix("//").map(|line| line.trim_start_matches('/').trim());
    let sentence =
        comment.map(|line| line.split(". ").next().unwrap_or(line).trim_end_matches('.'));
    match sentence {
        Some(words) if !words.is_empty() => String::from(words),
        _ => stem(path).replace(['-', '_'], " "),
    }
}

fn open(lab: &Lab, path: &str) -> Answer {
    let (stored, writable) = match disk::read(&lab.root, path) {
        Ok(stored) => (stored, true),
        Err(DiskError::Missing) => match from_gallery(path) {
            Some(text) => {
                let stored = disk::Stored { text: String::from(text), version: Version::absent() };
                (stored, false)
            }
            None => return disk_answer(DiskError::Missing),
        },
        Err(error) => return disk_answer(error),
    };
    let disk::Stored { text, version } = &stored;
    json(StatusCode::OK, &Opened { path, text, version, writable })
}

fn from_gallery(path: &str) -> Option<&'static str> {
    let name = path.strip_prefix("gallery/")?;
    embedded::GALLERY.iter().find(|(own, _)| *own == name).map(|(_, text)| *text)
}

fn table(lab: &Lab, path: &str) -> Answer {
    let kept = |path: &str| {
        let name = path.strip_prefix("gallery/")?;
        embedded::TABLES.iter().find(|(own, _)| *own == name).map(|(_, text)| text.to_string())
    };
    let text = match disk::read_table(&lab.root, path) {
        Err(DiskError::Missing) => kept(path).ok_or(DiskError::Missing),
        read => read,
    };
    match text {
        Ok(text) => json(StatusCode::OK, &serde_json::json!({ "text": text })),
        Err(error) => disk_answer(error),
    }
}

fn save(lab: &Lab, saving: &Saving) -> Answer {
    match disk::save(&lab.root, &saving.path, &saving.text, &saving.version) {
        Ok(version) => json(StatusCode::OK, &Saved { version }),
        Err(error) => disk_answer(error),
    }
}

fn drafts(lab: &Lab, path: &str) -> Answer {
    match lab.journal.drafts(path) {
        Ok(drafts) => json(StatusCode::OK, &drafts),
        Err(error) => disk_answer(error),
    }
}

fn keep(lab: &Lab, keeping: &Keeping) -> Answer {
    match lab.journal.keep(&keeping.path, &keeping.tab, keeping.draft.as_deref()) {
        Ok(()) => json(StatusCode::OK, &serde_json::json!({})),
        Err(error) => disk_answer(error),
    }
}

fn library() -> Answer {
    let files: Vec<LibraryFile> =
        embedded::LIBRARY.iter().map(|&(name, text)| LibraryFile { name, text }).collect();
    json(StatusCode::OK, &files)
}

/// Reads and understands a body of some form, within its limits of size and time.
async fn body<T: serde::de::DeserializeOwned>(
    request: Request<Incoming>,
    form: &str,
) -> Result<T, Answer> {
    let (parts, body) = request.into_parts();
    if !is_plain_json(&parts.headers) {
        return Err(refused(
            StatusCode::UNSUPPORTED_MEDIA_TYPE,
            "the body is not plain application/json",
        ));
    }
    let too_long = || refused(StatusCode::PAYLOAD_TOO_LARGE, "the body is too long");
    if body.size_hint().lower() > LONGEST_BODY as u64 {
        return Err(too_long());
    }
    let all = tokio::time::timeout(BODY_TIME, Limited::new(body, LONGEST_BODY).collect()).await;
    let bytes = match all {
        Err(_) => {
            return Err(refused(StatusCode::REQUEST_TIMEOUT, "the body did not arrive in time"));
        }
        Ok(Err(error)) if error.is::<LengthLimitError>() => return Err(too_long()),
        Ok(Err(_)) => return Err(refused(StatusCode::BAD_REQUEST, "the body is broken")),
        Ok(Ok(collected)) => collected.to_bytes(),
    };
    serde_json::from_slice(&bytes)
        .map_err(|_| refused(StatusCode::BAD_REQUEST, &format!("the body is not {form}")))
}

fn is_plain_json(headers: &HeaderMap) -> bool {
    let kind = headers.get(CONTENT_TYPE).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let kind = kind.split(';').next().unwrap_or_default().trim();
    kind.eq_ignore_ascii_case("application/json") && !headers.contains_key(CONTENT_ENCODING)
}

fn disk_answer(error: DiskError) -> Answer {
    let status = match &error {
        DiskError::Name(_) => StatusCode::BAD_REQUEST,
        DiskError::Missing => StatusCode::NOT_FOUND,
        DiskError::NotPlain => StatusCode::FORBIDDEN,
        DiskError::TooLong => StatusCode::PAYLOAD_TOO_LARGE,
        DiskError::NotText => StatusCode::UNPROCESSABLE_ENTITY,
        DiskError::NoDrafts => StatusCode::NOT_IMPLEMENTED,
        DiskError::Changed(_) => StatusCode::CONFLICT,
        DiskError::Io(_) => StatusCode::INTERNAL_SERVER_ERROR,
    };
    let sentence = error.to_string();
    match error {
        DiskError::Changed(found) => {
            let (text, version) = found.map(|stored| (stored.text, stored.version)).unzip();
            json(status, &Conflict { error: sentence, text, version })
        }
        DiskError::Name(_)
        | DiskError::Missing
        | DiskError::NotPlain
        | DiskError::TooLong
        | DiskError::NotText
        | DiskError::NoDrafts
        | DiskError::Io(_) => refused(status, &sentence),
    }
}

fn refused(status: StatusCode, why: &str) -> Answer {
    json(status, &serde_json::json!({ "error": why }))
}

fn only_methods(allowed: &'static str) -> Answer {
    let mut answer = refused(StatusCode::METHOD_NOT_ALLOWED, "not with this method");
    answer.headers_mut().insert(ALLOW, HeaderValue::from_static(allowed));
    answer
}

fn json<T: Serialize>(status: StatusCode, value: &T) -> Answer {
    let text = serde_json::to_vec(value).expect("our answers have string keys only");
    bytes_answer(status, "application/json", Bytes::from(text))
}

fn bytes_answer(status: StatusCode, kind: &'static str, bytes: Bytes) -> Answer {
    let mut answer = Response::new(Full::new(bytes));
    *answer.status_mut() = status;
    answer.headers_mut().insert(CONTENT_TYPE, HeaderValue::from_static(kind));
    answer
}

/// The `path` of a query, decoded once; none where the query is anything else.
fn asked_path(query: &str) -> Option<String> {
    let value = query.strip_prefix("path=")?;
    let mut bytes = Vec::new();
    let mut rest = value.bytes();
    while let Some(byte) = rest.next() {
        let digit = |byte: u8| char::from(byte).to_digit(16);
        match byte {
            b'%' => {
                let (high, low) = (digit(rest.next()?)?, digit(rest.next()?)?);
                bytes.push(u8::try_from(16 * high + low).expect("two hexadecimal digits"));
            }
            b'&' | b'=' => return None,
            b'+' => bytes.push(b' '),
            _ => bytes.push(byte),
        }
    }
    String::from_utf8(bytes).ok()
}

/// A name as a query's value.
pub(crate) fn encoded(name: &str) -> String {
    let mut query = String::new();
    for byte in name.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-._~".contains(&byte) {
            query.push(char::from(byte));
        } else {
            query.push_str(&format!("%{byte:02X}"));
        }
    }
    query
}
