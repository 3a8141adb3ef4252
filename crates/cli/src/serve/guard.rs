//! Who may ask: only the page that this server gave out, in a browser on this machine.
//!
//! Checked before anything else is looked at, on every request: the exact `Host` (against names
//! that resolve to loopback), the exact `Origin` and `Sec-Fetch-Site` (against other pages), and
//! for all but the page's own files the token (against other programs and users of the machine).

use std::io;

use hyper::header::{HOST, HeaderMap, ORIGIN};
use hyper::{Method, StatusCode, Uri};

/// The header that carries the token; a custom one, so that no other page can send it unasked.
const TOKEN: &str = "x-thinglab-token";

/// The authorities and the token that this server answers to.
#[derive(Debug)]
pub(crate) struct Guard {
    hosts: [String; 2],
    token: String,
}

/// What a request may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ask {
    /// The page's own files, the same for everyone.
    Page,
    /// Documents.
    Documents,
}

/// Why a request is refused: the status and a sentence for whoever looks.
pub(crate) type Refusal = (StatusCode, &'static str);

impl Guard {
    /// A guard for a port of this machine, with a new random token.
    ///
    /// # Errors
    /// Where the system has no randomness to give.
    pub(crate) fn new(port: u16) -> io::Result<Guard> {
        let mut bits = [0; 32];
        getrandom::fill(&mut bits).map_err(io::Error::from)?;
        let token = bits.iter().map(|byte| format!("{byte:02x}")).collect();
        Ok(Guard { hosts: [authority("127.0.0.1", port), authority("localhost", port)], token })
    }

    /// The 256-bit token, in hexadecimal.
    pub(crate) fn token(&self) -> &str {
        &self.token
    }

    /// Lets a request pass, or says why not.
    ///
    /// # Errors
    /// The refusal to answer with.
    pub(crate) fn check(
        &self,
        ask: Ask,
        method: &Method,
        uri: &Uri,
        headers: &HeaderMap,
    ) -> Result<(), Refusal> {
        let forbidden = |why| Err((StatusCode::FORBIDDEN, why));
        let host = only(headers, HOST.as_str());
        let Some(host) = host.filter(|host| self.hosts.iter().any(|known| known == host)) else {
            return forbidden("this server answers to its own address alone");
        };
        if uri.authority().is_some() {
            return forbidden("a proxy's request");
        }
        let safe = *method == Method::GET || *method == Method::HEAD;
        if headers.contains_key(ORIGIN) || !safe {
            let own =
                only(headers, ORIGIN.as_str()).and_then(|origin| origin.strip_prefix("http://"));
            if own != Some(host) {
                return forbidden("the request comes from another page");
            }
        }
        if headers.contains_key("sec-fetch-site") {
            let site = only(headers, "sec-fetch-site");
            let followed_link =
                ask == Ask::Page && headers.get("sec-fetch-mode").is_some_and(|m| m == "navigate");
            if site != Some("same-origin") && site != Some("none") && !followed_link {
                return forbidden("the request comes from another site");
            }
        }
        match ask {
            Ask::Page => Ok(()),
            Ask::Documents => match only(headers, TOKEN) {
                Some(token) if same_bytes(token.as_bytes(), self.token.as_bytes()) => Ok(()),
                _ => Err((
                    StatusCode::UNAUTHORIZED,
                    "open the address that `thinglab serve` printed: it carries the token",
                )),
            },
        }
    }
}

/// What a browser puts into `Host`: it leaves out the port that http has anyway.
fn authority(name: &str, port: u16) -> String {
    if port == 80 { String::from(name) } else { format!("{name}:{port}") }
}

/// The value of a header that is there exactly once.
fn only<'a>(headers: &'a HeaderMap, name: &str) -> Option<&'a str> {
    let mut values = headers.get_all(name).iter();
    let value = values.next()?;
    if values.next().is_some() { None } else { value.to_str().ok() }
}

/// Compares in a time that does not tell how much agrees.
fn same_bytes(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |all, (x, y)| all | (x ^ y)) == 0
}
