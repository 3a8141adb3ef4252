//! The page of `cargo bench-table browser`: sketches solved and dragged in WebAssembly, compiled as the lab's
//! page is; the figures are the text of its body.

use bench::browser;

fn main() {
    let body = web_sys::window().and_then(|window| window.document()).and_then(|page| page.body());
    if let Some(body) = body {
        body.set_text_content(Some(&browser::table()));
    }
}
