//! The server as a stranger meets it: raw bytes on its port, every attack that other local servers
//! fell to, and what an honest page asks.

#![expect(clippy::unwrap_used, reason = "what these helpers cannot do, the test fails by")]

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A running server over a folder of its own; both are gone with the value.
struct Server {
    child: Child,
    folder: PathBuf,
    port: u16,
    token: String,
}

impl Server {
    fn start(name: &str) -> Server {
        let folder = std::env::temp_dir().join(format!("thinglab-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("root/sub")).unwrap();
        fs::write(folder.join("root/a.thing"), "// First. Then more.\nx: Real\n").unwrap();
        fs::write(folder.join("root/sub/b.thing"), "y: Real\n").unwrap();
        fs::write(folder.join("secret.thing"), "secret").unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(folder.join("secret.thing"), folder.join("root/link.thing"))
            .unwrap();
        Server::over(folder)
    }

    /// Starts a server over a folder that is there.
    fn over(folder: PathBuf) -> Server {
        Server::with(folder, &[])
    }

    /// Starts a server over a folder that is there, with further arguments.
    fn with(folder: PathBuf, arguments: &[&Path]) -> Server {
        let mut child = Command::new(env!("CARGO_BIN_EXE_thinglab"))
            .args(["serve", "--no-open", "--root"])
            .arg(folder.join("root"))
            .args(arguments)
            .env("XDG_STATE_HOME", folder.join("state"))
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let rest = line.split_once("http://127.0.0.1:").unwrap().1.trim();
        let (port, token) = rest.split_once("/#token=").unwrap();
        Server { child, folder, port: port.parse().unwrap(), token: String::from(token) }
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        stream.set_read_timeout(Some(Duration::from_secs(30))).unwrap();
        stream
    }

    /// Sends bytes as they are, `PORT` and `TOKEN` filled in; gives the whole answer.
    fn raw(&self, request: &str) -> String {
        exchange(self.connect(), &self.filled_in(request))
    }

    fn filled_in(&self, request: &str) -> String {
        request.replace("PORT", &self.port.to_string()).replace("TOKEN", &self.token)
    }

    /// Kills the server where it is and starts another over the same folder.
    fn killed(&mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
        let folder = std::mem::take(&mut self.folder);
        *self = Server::over(folder);
    }

    /// The request of an honest page.
    fn ask(&self, method: &str, target: &str, body: &str) -> String {
        exchange(self.connect(), &self.request(method, target, body))
    }

    fn request(&self, method: &str, target: &str, body: &str) -> String {
        self.filled_in(&format!(
            "{method} {target} HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://127.0.0.1:PORT\r\n\
             X-ThingLab-Token: TOKEN\r\nContent-Type: application/json\r\nConnection: close\r\n\
             Content-Length: {}\r\n\r\n{body}",
            body.len()
        ))
    }
}

/// Sends bytes and gives the whole answer.
fn exchange(stream: TcpStream, request: &str) -> String {
    String::from_utf8_lossy(&exchange_bytes(stream, request)).into_owned()
}

fn exchange_bytes(mut stream: TcpStream, request: &str) -> Vec<u8> {
    // The server may have answered and closed before the last byte is sent.
    let _ = stream.write_all(request.as_bytes());
    let mut answer = Vec::new();
    let _ = stream.read_to_end(&mut answer);
    answer
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
        let _ = fs::remove_dir_all(&self.folder);
    }
}

/// The status of an answer; 0 for a connection that was closed without one.
fn status(answer: &str) -> u16 {
    let figures = answer.strip_prefix("HTTP/1.").and_then(|rest| rest.get(2..5));
    figures.map_or(0, |figures| figures.parse().unwrap())
}

fn body(answer: &str) -> serde_json::Value {
    serde_json::from_str(answer.split_once("\r\n\r\n").unwrap().1).unwrap()
}

#[test]
fn requests_from_elsewhere_are_refused() {
    let server = Server::start("elsewhere");
    let host = "Host: 127.0.0.1:PORT";
    let token = "x-thinglab-token: TOKEN";
    // What is asked, the header lines, and the status that it must get.
    let attacks: [(&str, &[&str], u16); 36] = [
        ("GET / HTTP/1.1", &["Host: evil.example"], 403),
        ("GET / HTTP/1.1", &["Host: evil.example:PORT"], 403),
        ("GET / HTTP/1.1", &["Host:"], 403),
        ("GET / HTTP/1.1", &["Host: :PORT"], 403),
        ("GET / HTTP/1.1", &[], 403),
        ("GET / HTTP/1.0", &[], 403),
        ("GET / HTTP/1.1", &[host, host], 403),
        ("GET / HTTP/1.1", &[host, "Host: evil.example"], 403),
        ("GET / HTTP/1.1", &["Host: 127.0.0.1"], 403),
        ("GET / HTTP/1.1", &["Host: 127.0.0.1:1"], 403),
        ("GET / HTTP/1.1", &["Host: 127.0.0.1.:PORT"], 403),
        ("GET / HTTP/1.1", &["Host: localhost.:PORT"], 403),
        ("GET / HTTP/1.1", &["Host: 127.0.0.1.nip.io:PORT"], 403),
        ("GET / HTTP/1.1", &["Host: 127.1:PORT"], 403),
        ("GET / HTTP/1.1", &["Host: 0.0.0.0:PORT"], 403),
        ("GET / HTTP/1.1", &["Host: user@127.0.0.1:PORT"], 403),
        ("GET http://evil.example/ HTTP/1.1", &[host], 403),
        ("GET http://127.0.0.1:PORT/ HTTP/1.1", &["Host: evil.example"], 403),
        ("GET /api/documents HTTP/1.1", &[host], 401),
        ("GET /api/documents HTTP/1.1", &[host, "x-thinglab-token:"], 401),
        ("GET /api/documents HTTP/1.1", &[host, "x-thinglab-token: TOKEN0"], 401),
        ("GET /api/documents HTTP/1.1", &[host, "x-thinglab-token: 0000"], 401),
        ("GET /api/documents HTTP/1.1", &[host, token, token], 401),
        ("GET /api/documents HTTP/1.1", &[host, "Cookie: token=TOKEN"], 401),
        ("GET /api/documents?token=TOKEN HTTP/1.1", &[host], 401),
        ("GET /api/nothing HTTP/1.1", &[host], 401),
        ("GET /api HTTP/1.1", &[host], 401),
        ("GET /api/documents HTTP/1.1", &[host, token, "Origin: null"], 403),
        ("GET /api/documents HTTP/1.1", &[host, token, "Origin: http://evil.example"], 403),
        ("GET /api/documents HTTP/1.1", &[host, token, "Origin: http://127.0.0.1:1"], 403),
        ("GET /api/documents HTTP/1.1", &[host, token, "Origin: https://127.0.0.1:PORT"], 403),
        ("GET /api/documents HTTP/1.1", &[host, token, "Sec-Fetch-Site: cross-site"], 403),
        ("GET /api/documents HTTP/1.1", &[host, token, "Sec-Fetch-Site: same-site"], 403),
        ("GET / HTTP/1.1", &[host, "Sec-Fetch-Site: cross-site", "Sec-Fetch-Mode: no-cors"], 403),
        ("PUT /api/document HTTP/1.1", &[host, token, "Content-Type: application/json"], 403),
        ("POST /api/document HTTP/1.1", &[host, "Content-Type: text/plain", "Origin: null"], 403),
    ];
    for (line, headers, wanted) in attacks {
        let head: String = headers.iter().map(|line| format!("{line}\r\n")).collect();
        let answer = server.raw(&format!("{line}\r\n{head}Connection: close\r\n\r\n"));
        assert_eq!(status(&answer), wanted, "{line} {headers:?}\n{answer}");
        assert!(!answer.contains("a.thing"), "{line} {headers:?} was told a name");
    }
}

#[test]
fn a_page_in_a_folder_is_served_and_nothing_beside_it() {
    let folder = std::env::temp_dir().join(format!("thinglab-page-{}", std::process::id()));
    let page = folder.join("page");
    fs::create_dir_all(folder.join("root")).unwrap();
    fs::create_dir_all(page.join("sub")).unwrap();
    let files = [
        ("index.html", "the page"),
        ("a.js", "plain"),
        ("a.js.br", "small"),
        ("sub/b.js", "b"),
        (".c", "c"),
    ];
    for (name, text) in files {
        fs::write(page.join(name), text).unwrap();
    }
    fs::write(folder.join("secret.js"), "secret").unwrap();
    let server = Server::with(folder, &[Path::new("--page"), &page]);
    let get = |target: &str, taken: &str| {
        server.raw(&format!(
            "GET {target} HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nConnection: close\r\n{taken}\r\n"
        ))
    };
    let content = |answer: &str| String::from(answer.split_once("\r\n\r\n").unwrap().1);
    assert_eq!(content(&get("/", "")), "the page");
    assert_eq!(content(&get("/a.js", "")), "plain");
    let small = get("/a.js", "Accept-Encoding: br\r\n");
    assert_eq!(content(&small), "small");
    assert!(small.contains("text/javascript"), "{small}");
    // what the browser has already is not sent again
    let tag = small.lines().find_map(|line| line.strip_prefix("etag: ")).unwrap();
    let asks_again = format!("Accept-Encoding: br\r\nIf-None-Match: {tag}\r\n");
    let again = get("/a.js", &asks_again);
    assert_eq!((status(&again), &*content(&again)), (304, ""));
    fs::write(page.join("a.js.br"), "other").unwrap();
    assert_eq!(content(&get("/a.js", &asks_again)), "other");
    for target in [
        "/../secret.js",
        "/%2e%2e/secret.js",
        "//secret.js",
        "/sub/b.js",
        "/.c",
        "/sub",
        "/none.js",
    ] {
        assert_eq!(status(&get(target, "")), 404, "{target}");
    }
}

#[test]
fn an_unsaved_text_is_kept_until_the_page_takes_it_back() {
    let server = Server::start("journal");
    let draft = "{\"path\":\"a.thing\",\"tab\":\"7e-1\",\"draft\":\"absent 1\\nz: Real\"}";
    assert_eq!(status(&server.ask("PUT", "/api/draft", draft)), 200);
    let kept = server.ask("GET", "/api/drafts?path=a.thing", "");
    assert!(kept.contains("\"tab\":\"7e-1\"") && kept.contains("z: Real"), "{kept}");
    assert!(!server.folder.join("root/.thinglab").exists(), "the folder has only documents");
    let none = draft.replace("\"absent 1\\nz: Real\"", "null");
    assert_eq!(status(&server.ask("PUT", "/api/draft", &none)), 200);
    assert!(!server.ask("GET", "/api/drafts?path=a.thing", "").contains("z: Real"));
    for wrong in [draft.replace("7e-1", "../1"), draft.replace("a.thing", "../a.thing")] {
        assert_eq!(status(&server.ask("PUT", "/api/draft", &wrong)), 400, "{wrong}");
    }
}

#[test]
fn no_spelling_leads_out_of_the_folder() {
    let server = Server::start("out");
    let spellings = [
        "../secret.thing",
        "..%2fsecret.thing",
        "%2e%2e/secret.thing",
        "%2e%2e%2fsecret.thing",
        "%252e%252e%252fsecret.thing",
        "..%5csecret.thing",
        "..\\secret.thing",
        "sub/../../secret.thing",
        "sub/..%2f..%2fsecret.thing",
        "/etc/passwd",
        "%2fetc%2fpasswd",
        "/etc/x.thing",
        "//secret.thing",
        "./a.thing",
        "a.thing%00",
        "a.thing%00.thing",
        "%00a.thing",
        "link.thing",
        "..",
        ".",
        "",
        "sub",
        "sub/",
        "C:%5csecret.thing",
        "file:///secret.thing",
        "%c0%ae%c0%ae/secret.thing",
        "%ff.thing",
        "%zz.thing",
        "a.thing%2",
        "a.thing&path=../secret.thing",
        "con.thing",
        "..;/secret.thing",
        "a.thing/../../secret.thing",
        "%e2%80%ae.thing",
        "...//secret.thing",
    ];
    for spelling in spellings {
        let answer = server.ask("GET", &format!("/api/document?path={spelling}"), "");
        assert!((400..500).contains(&status(&answer)), "{spelling}\n{answer}");
        assert!(!answer.contains("secret\""), "{spelling}\n{answer}");
        let saving = serde_json::json!({ "path": spelling, "text": "x", "version": "absent" });
        let answer = server.ask("PUT", "/api/document", &saving.to_string());
        assert!((400..500).contains(&status(&answer)), "{spelling}\n{answer}");
    }
    for target in [
        "/../secret.thing",
        "/%2e%2e/secret.thing",
        "/a.thing",
        "/sub/b.thing",
        "//",
        "/index.html/",
    ] {
        let answer = server.ask("GET", target, "");
        assert!((400..500).contains(&status(&answer)), "{target}\n{answer}");
    }
    assert_eq!(fs::read_to_string(server.folder.join("secret.thing")).unwrap(), "secret");
    assert_eq!(fs::read_dir(&server.folder).unwrap().count(), 2, "something was written outside");
}

#[test]
fn unknown_methods_and_broken_bodies_change_nothing() {
    let server = Server::start("broken");
    for method in ["POST", "DELETE", "PATCH", "OPTIONS", "TRACE", "PROPFIND"] {
        for target in ["/", "/api/documents", "/api/document", "/api/table", "/api/library"] {
            let answer = server.ask(method, target, "");
            assert_eq!(status(&answer), 405, "{method} {target}\n{answer}");
            assert!(!answer.to_lowercase().contains("access-control"), "{answer}");
        }
    }
    assert_eq!(status(&server.ask("GET", "/api/nothing", "")), 404);
    assert!((400..500).contains(&status(
        &server.raw("CONNECT evil.example:80 HTTP/1.1\r\nHost: evil.example:80\r\n\r\n")
    )));
    assert!([0, 400].contains(&status(&server.raw("nonsense\r\n\r\n"))));
    for wrong in [
        "",
        "{",
        "[]",
        "{}",
        "null",
        "{\"path\":\"a.thing\",\"text\":\"x\"}",
        "{\"path\":\"a.thing\",\"text\":1,\"version\":\"absent\"}",
        "{\"path\":\"a.thing\",\"text\":\"x\",\"version\":\"absent\",\"force\":true}",
    ] {
        assert_eq!(status(&server.ask("PUT", "/api/document", wrong)), 400, "{wrong}");
    }
    let put = "PUT /api/document HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://127.0.0.1:PORT\r\n\
               x-thinglab-token: TOKEN\r\nConnection: close\r\n";
    let kinds = [
        "Content-Type: text/plain",
        "Content-Type: application/json\r\nContent-Encoding: gzip",
        "X-No: kind",
    ];
    for kind in kinds {
        let answer = server.raw(&format!("{put}{kind}\r\nContent-Length: 2\r\n\r\n{{}}"));
        assert_eq!(status(&answer), 415, "{kind}\n{answer}");
    }
    let both = server.raw(&format!("{put}Content-Length: 2\r\nContent-Length: 3\r\n\r\n{{}}"));
    assert_eq!(status(&both), 400, "{both}");
    assert_eq!(
        fs::read_to_string(server.folder.join("root/a.thing")).unwrap(),
        "// First. Then more.\nx: Real\n"
    );
}

#[test]
fn what_is_too_large_is_refused_before_it_is_kept() {
    let server = Server::start("large");
    let put = "PUT /api/document HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nOrigin: http://127.0.0.1:PORT\r\n\
               x-thinglab-token: TOKEN\r\nContent-Type: application/json\r\n";
    // A gigabyte is announced; the answer comes without it.
    let announced = server.raw(&format!("{put}Content-Length: 1073741824\r\n\r\n"));
    assert_eq!(status(&announced), 413, "{announced}");
    // Chunks without end.
    let mut stream = server.connect();
    let head = put.replace("PORT", &server.port.to_string()).replace("TOKEN", &server.token);
    stream.write_all(format!("{head}Transfer-Encoding: chunked\r\n\r\n").as_bytes()).unwrap();
    let chunk = format!("100000\r\n{}\r\n", " ".repeat(0x10_0000));
    let sent = (0..64).take_while(|_| stream.write_all(chunk.as_bytes()).is_ok()).count();
    assert!(sent < 64, "64 MB were taken");
    // A head without end.
    let head = server.raw(&format!(
        "GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\nX: {}\r\n\r\n",
        "x".repeat(100_000)
    ));
    assert!([0, 431].contains(&status(&head)), "{head}");
    let many: String = (0..1000).map(|i| format!("x{i}: y\r\n")).collect();
    let head = server.raw(&format!("GET / HTTP/1.1\r\nHost: 127.0.0.1:PORT\r\n{many}\r\n"));
    assert!([0, 431].contains(&status(&head)), "{head}");
    // A document that is too long, in a body that is not.
    let long =
        serde_json::json!({ "path": "a.thing", "text": "x".repeat(9 << 20), "version": "absent" });
    assert_eq!(status(&server.ask("PUT", "/api/document", &long.to_string())), 413);
    assert_eq!(status(&server.ask("GET", "/api/documents", "")), 200);
}

#[test]
fn slow_clients_hold_up_nobody_and_are_cut_off() {
    let server = Server::start("slow");
    let slow: Vec<TcpStream> = (0..64)
        .map(|_| {
            let mut stream = server.connect();
            stream.write_all(b"GET / HTTP/1.1\r\nHost: ").unwrap();
            stream
        })
        .collect();
    let begun = Instant::now();
    assert_eq!(status(&server.ask("GET", "/api/documents", "")), 200);
    assert!(begun.elapsed() < Duration::from_secs(5), "an honest request waited");
    for mut stream in slow {
        let mut rest = Vec::new();
        stream.read_to_end(&mut rest).expect("cut off within the time to read");
    }
}

#[test]
fn an_honest_page_reads_saves_and_is_told_of_conflicts() {
    let server = Server::start("honest");
    let listed = body(&server.ask("GET", "/api/documents", ""));
    let first = &listed[0];
    assert_eq!((first["path"].as_str(), first["title"].as_str()), (Some("a.thing"), Some("First")));
    assert!(listed.as_array().unwrap().iter().any(|one| one["path"] == "sub/b.thing"));

    let opened = body(&server.ask("GET", "/api/document?path=sub%2Fb.thing", ""));
    assert_eq!(opened["text"], "y: Real\n");
    let saving = |text: &str, version: &serde_json::Value| {
        let saving = serde_json::json!({ "path": "sub/b.thing", "text": text, "version": version });
        server.ask("PUT", "/api/document", &saving.to_string())
    };
    let saved = body(&saving("y: Real = 2\n", &opened["version"]));
    assert_eq!(
        fs::read_to_string(server.folder.join("root/sub/b.thing")).unwrap(),
        "y: Real = 2\n"
    );

    let late = saving("y: Real = 3\n", &opened["version"]);
    assert_eq!(status(&late), 409);
    assert_eq!(body(&late)["text"], "y: Real = 2\n");
    assert_eq!(body(&late)["version"], saved["version"]);
    assert_eq!(status(&saving("y: Real = 3\n", &saved["version"])), 200);
    assert_eq!(status(&server.ask("GET", "/api/document?path=none.thing", "")), 404);

    let library = body(&server.ask("GET", "/api/library", ""));
    assert!(
        library
            .as_array()
            .unwrap()
            .iter()
            .all(|file| file["name"].as_str().unwrap().ends_with(".thing"))
    );
}

#[test]
fn a_long_answer_is_compressed_for_whoever_takes_that() {
    let server = Server::start("compressed");
    let asking = server.request("GET", "/api/library", "");
    let plain = exchange_bytes(server.connect(), &asking);
    let taking = asking.replace("Connection:", "Accept-Encoding: gzip, br\r\nConnection:");
    let sent = exchange_bytes(server.connect(), &taking);
    let parts = |answer: &[u8]| {
        let end = answer.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
        (String::from_utf8(answer[..end].to_vec()).unwrap(), answer[end + 4..].to_vec())
    };
    let ((_, plain), (head, sent)) = (parts(&plain), parts(&sent));
    assert!(head.contains("content-encoding: br"), "{head}");
    assert!(3 * sent.len() < plain.len(), "{} of {} bytes", sent.len(), plain.len());
    let mut read = Vec::new();
    brotli::Decompressor::new(&sent[..], 4096).read_to_end(&mut read).unwrap();
    assert!(read == plain);

    let short = server.request("GET", "/api/document?path=none.thing", "");
    let short = short.replace("Connection:", "Accept-Encoding: br\r\nConnection:");
    assert!(!exchange(server.connect(), &short).contains("content-encoding"));
    // what is refused is not sent, however that is written; a table of megabytes holds nobody up
    let refusing = asking.replace("Connection:", "Accept-Encoding: br; Q=0.\r\nConnection:");
    assert!(!exchange(server.connect(), &refusing).contains("content-encoding"));
    fs::write(server.folder.join("root/long.csv"), "1,2\n".repeat(300_000)).unwrap();
    let long = server.request("GET", "/api/table?path=long.csv", "");
    let long = long.replace("Connection:", "Accept-Encoding: br\r\nConnection:");
    let long = exchange(server.connect(), &long);
    assert!(long.starts_with("HTTP/1.1 200"), "{}", &long[..long.len().min(200)]);
    assert!(!long.contains("content-encoding"));
}

#[test]
fn every_answer_says_what_it_may_be_used_for() {
    let server = Server::start("headers");
    for answer in [
        server.ask("GET", "/", ""),
        server.ask("GET", "/none", ""),
        server.ask("GET", "/api/documents", ""),
        server.raw("GET / HTTP/1.1\r\nHost: evil.example\r\nConnection: close\r\n\r\n"),
    ] {
        let head = answer.split("\r\n\r\n").next().unwrap().to_lowercase();
        for wanted in [
            "content-security-policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval';",
            "frame-ancestors 'none'",
            "x-content-type-options: nosniff",
            "referrer-policy: no-referrer",
            "cross-origin-opener-policy: same-origin",
            "cross-origin-resource-policy: same-origin",
        ] {
            assert!(head.contains(wanted), "{wanted} is not in\n{head}");
        }
        assert!(!head.contains("access-control"), "{head}");
    }
}

/// How often a save is killed.
const KILLS: u32 = 40;

/// A document so long that writing it takes a while, in two versions.
fn two_texts() -> [String; 2] {
    ["a", "b"].map(|letter| format!("// {}\nx: Real\n", letter.repeat(2 << 20)))
}

/// Returns which of the texts a file holds; nothing where it holds neither, whole.
fn which(path: &Path, texts: &[String; 2]) -> Option<usize> {
    let found = fs::read(path).unwrap();
    texts.iter().position(|text| text.as_bytes() == found)
}

#[test]
fn a_save_that_is_killed_leaves_the_old_text_or_the_new_one_whole() {
    let mut server = Server::start("killed");
    let path = server.folder.join("root/a.thing");
    let texts = two_texts();
    let saving = |server: &Server, text: &str| {
        let opened = body(&server.ask("GET", "/api/document?path=a.thing", ""));
        let version = &opened["version"];
        let saving = serde_json::json!({ "path": "a.thing", "text": text, "version": version });
        server.request("PUT", "/api/document", &saving.to_string())
    };
    let first = saving(&server, &texts[0]);
    let start = Instant::now();
    assert_eq!(status(&exchange(server.connect(), &first)), 200);
    let whole_save = start.elapsed();
    let mut now = 0;
    for kill in 0..KILLS {
        let request = saving(&server, &texts[1 - now]);
        let stream = server.connect();
        let page = std::thread::spawn(move || exchange(stream, &request));
        std::thread::sleep(whole_save * kill * 5 / 4 / KILLS);
        server.killed();
        page.join().unwrap();
        now = which(&path, &texts).unwrap_or_else(|| panic!("kill {kill} left neither text"));
        let opened = body(&server.ask("GET", "/api/document?path=a.thing", ""));
        assert!(opened["text"] == texts[now], "the next server reads what is there");
    }
}

/// The same kills find out a writer that writes over the document itself.
#[cfg(unix)]
#[test]
fn a_naive_writer_is_caught_by_the_same_kills() {
    let folder = std::env::temp_dir().join(format!("thinglab-naive-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let texts = two_texts();
    fs::write(folder.join("one"), &texts[0]).unwrap();
    fs::write(folder.join("two"), &texts[1]).unwrap();
    fs::write(folder.join("a.thing"), &texts[0]).unwrap();
    let mut torn = 0;
    for kill in 0..KILLS {
        let mut writer = Command::new("sh")
            .args(["-c", "while :; do cat two > a.thing; cat one > a.thing; done"])
            .current_dir(&folder)
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_micros(u64::from(kill) * 500));
        writer.kill().unwrap();
        writer.wait().unwrap();
        torn += u32::from(which(&folder.join("a.thing"), &texts).is_none());
    }
    fs::remove_dir_all(&folder).unwrap();
    assert!(torn > 0, "none of {KILLS} kills tore a text");
}
