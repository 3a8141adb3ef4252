//! The lab in a real browser: [`Visit`] starts the `thinglab` command over a copy of the gallery,
//! and takes headless Chromium to the page; the tests in `tests/` do there what people do.
//!
//! `cargo verify` builds the command, and the page in `dist/`, and names the command and the browser in the
//! environment: `THINGLAB` and `CHROMIUM`. Without these a test fails and says so.

mod chromium;
pub mod drafting;
pub mod hands;

use std::cell::Cell;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;
use std::{env, fs};

use fantoccini::{Client, Locator};
use serde_json::{Value, json};

/// One browser on one server, over a folder of its own. Server and folder are gone with the value.
#[derive(Debug)]
pub struct Visit {
    /// The browser.
    pub client: Client,
    /// The address that the server printed: it carries the token.
    pub address: String,
    /// How many actions were done in the drawer *Draw*: choices, picks, keys of the calculator, and what is typed.
    pub actions: Cell<usize>,
    // Dropped in this order: a folder is gone only after those who write into it.
    _browser: chromium::Lent,
    server: Option<Process>,
    folder: Folder,
}

/// A program that ends with its value.
#[derive(Debug)]
struct Process(Child);

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// What the server shows: a copy of the gallery, in `gallery/`.
#[derive(Debug)]
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// A document that nobody has saved.
const EMPTY: &str = "empty.thing";

impl Visit {
    /// Counts one more action.
    pub fn act(&self) {
        self.actions.update(|n| n + 1);
    }

    /// Opens the lab on a document of the gallery (`quadrilateral.thing`), or on the gallery itself, which opens all
    /// that lies there.
    ///
    /// # Panics
    /// Where the server, the driver or the browser does not start: then there is nothing to test.
    pub async fn open(document: Option<&str>) -> Visit {
        let visit = Visit::prepare(document).await;
        visit.client.goto(&visit.address).await.expect("the page's address answers");
        visit
    }

    /// Opens the lab on a document that does not exist yet, by its path.
    ///
    /// # Panics
    /// As [`Visit::open`].
    pub async fn open_new(path: &str) -> Visit {
        let visit = Visit::prepare(None).await;
        visit.go_to(path).await;
        visit
    }

    /// Goes to the lab on a document, by its path.
    async fn go_to(&self, path: &str) {
        let there = self.address.replace("/#", &format!("/?document={path}#"));
        self.client.goto(&there).await.expect("the page's address answers");
    }

    /// Opens the lab on an empty sheet, for what is to be shown there.
    ///
    /// # Panics
    /// As [`Visit::open`].
    pub async fn open_empty() -> Visit {
        Visit::open_new(EMPTY).await
    }

    /// Starts the server, and takes a browser to it that keeps nothing under its address but the first minute.
    async fn prepare(document: Option<&str>) -> Visit {
        let folder = copy_of_the_gallery();
        let (server, address) = serve(&folder, document);
        let (client, browser) = chromium::take().await;
        let (origin, _) = address.split_once(['?', '#']).expect("an address with its token");
        client.goto(&format!("{origin}favicon.svg")).await.expect("the server answers");
        // another visit may have had the address: what it kept there goes; whoever comes here has had the first
        // minute, and does too little to rehearse it
        let over = "localStorage.clear(); sessionStorage.clear(); \
                    localStorage.setItem('thinglab/no-rehearsal', 'kept'); \
                    localStorage.setItem('thinglab/first-minute', 'over')";
        client.execute(over, Vec::new()).await.expect("the browser keeps it");
        let actions = Cell::new(0);
        Visit { client, address, actions, _browser: browser, server: Some(server), folder }
    }

    /// Comes to the page anew, where what hands do first is rehearsed now, as for everybody but a test.
    ///
    /// # Panics
    /// Where the page does not answer.
    pub async fn rehearse(&self) {
        self.script("localStorage.removeItem('thinglab/no-rehearsal')").await;
        self.client.refresh().await.expect("the page's address answers");
    }

    /// Kills the server in the midst of whatever it does, and starts another over the same folder; the page stays.
    ///
    /// # Panics
    /// Where the other one does not start.
    pub fn kill_server(&mut self) {
        self.server = None;
        let (server, address) = serve(&self.folder, None);
        (self.server, self.address) = (Some(server), address);
    }

    /// Leaves the page at once, asked or not, and comes to the lab again, on an empty sheet.
    ///
    /// # Panics
    /// Where the browser does not go there.
    pub async fn leave_and_return(&self) {
        self.client.goto("about:blank").await.expect("an empty page");
        self.go_to(EMPTY).await;
    }

    /// Runs a script in the page and gives what it returns.
    ///
    /// # Panics
    /// Where the script throws.
    pub async fn script(&self, script: &str) -> Value {
        self.client.execute(script, Vec::new()).await.expect("the script runs")
    }

    /// Waits until an expression of the page's is true.
    ///
    /// # Panics
    /// After half a minute, with the expression and what the page shows.
    pub async fn until(&self, expression: &str) {
        for _ in 0..600 {
            if self.script(&format!("return Boolean({expression})")).await == json!(true) {
                return;
            }
            tokio::time::sleep(Duration::from_millis(50)).await;
        }
        let shown = self.script("return document.body.innerText").await;
        panic!("never true: {expression}; the page shows\n{}", shown.as_str().unwrap_or_default());
    }

    /// Takes a picture of the page, for whoever wants to look: only where `THINGLAB_PICTURES` names a folder.
    ///
    /// # Panics
    /// Where it cannot be taken or written.
    pub async fn picture(&self, name: &str) {
        let Some(folder) = env::var_os("THINGLAB_PICTURES") else { return };
        let image = self.client.screenshot().await.expect("the browser takes a picture");
        fs::write(PathBuf::from(folder).join(format!("{name}.png")), image).expect("it is written");
    }

    /// Takes a picture for the book, small, of the picture with what stands around it: only where `THINGLAB_BOOK` names the folder of these,
    /// `THINGLAB_BOOK=book/pictures cargo test --package browser`.
    ///
    /// # Panics
    /// Where it cannot be taken or written.
    pub async fn book_picture(&self, name: &str) {
        let Some(folder) = env::var_os("THINGLAB_BOOK") else { return };
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
        self.client.set_window_size(1000, 760).await.expect("a small window");
        self.script("document.querySelector('.corner button:nth-of-type(2)').click()").await;
        tokio::time::sleep(Duration::from_millis(600)).await;
        let centre = self.client.find(Locator::Css(".centre")).await.expect("the picture's panel");
        let image = centre.screenshot().await.expect("the browser takes a picture");
        fs::write(folder.join(format!("{name}.png")), image).expect("it is written");
        self.client
            .set_window_size(chromium::SIZE.0, chromium::SIZE.1)
            .await
            .expect("the window as it was");
        tokio::time::sleep(Duration::from_millis(300)).await;
    }

    /// Takes a picture of the whole page for the book, in a window of some size, light or dark: only where
    /// `THINGLAB_BOOK` names the folder of these.
    ///
    /// # Panics
    /// Where it cannot be taken or written.
    pub async fn reference_picture(&self, name: &str) {
        let Some(folder) = env::var_os("THINGLAB_BOOK") else { return };
        tokio::time::sleep(Duration::from_millis(300)).await;
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder);
        let image = self.client.screenshot().await.expect("the browser takes a picture");
        fs::write(folder.join(format!("page-{name}.png")), image).expect("it is written");
    }

    /// Puts a document into the gallery's copy.
    ///
    /// # Panics
    /// Where it cannot be written.
    pub fn put(&self, document: &str, text: &str) {
        fs::write(self.folder.0.join("gallery").join(document), text).expect("a new document");
    }

    /// The text of a document on disk.
    ///
    /// # Panics
    /// Where it is not there.
    pub fn saved(&self, document: &str) -> String {
        fs::read_to_string(self.folder.0.join("gallery").join(document)).expect("a document")
    }
}

/// A program's path from the environment, as `cargo verify` sets it.
fn named(variable: &str) -> PathBuf {
    match env::var_os(variable) {
        Some(path) => PathBuf::from(path),
        None => {
            panic!("{variable} is not set: `cargo verify` builds and names what these tests need")
        }
    }
}

/// Starts the server; gives it and its address.
fn serve(folder: &Folder, document: Option<&str>) -> (Process, String) {
    let (server, line) = start(
        Command::new(named("THINGLAB"))
            .args(["serve", "--no-open", "--root"])
            .arg(&folder.0)
            .args(["--page", concat!(env!("CARGO_MANIFEST_DIR"), "/../../dist")])
            .env("XDG_STATE_HOME", folder.0.join(".state"))
            .args(document.map(|name| folder.0.join("gallery").join(name))),
        "http://",
    )
    .expect("the server says that it runs");
    (server, format!("http://{}", line.split_once("http://").expect("an address").1))
}

/// Starts a program and waits for the line of its output that holds a mark; gives that line, or
/// nothing where the program ended without it.
fn start(command: &mut Command, mark: &str) -> Option<(Process, String)> {
    let mut child = command.stdout(Stdio::piped()).spawn().expect("the program starts");
    let output = child.stdout.take().expect("piped");
    let mut lines = BufReader::new(output).lines().map_while(Result::ok);
    let child = Process(child);
    let line = lines.find(|line| line.contains(mark))?;
    // What it prints later is read and dropped, so that it never waits for us.
    std::thread::spawn(move || lines.count());
    Some((child, line))
}

fn copy_of_the_gallery() -> Folder {
    static NUMBER: AtomicU32 = AtomicU32::new(0);
    let number = NUMBER.fetch_add(1, Ordering::Relaxed);
    let name = format!("thinglab-visit-{}-{number}", std::process::id());
    let folder = Folder(env::temp_dir().join(name));
    let gallery = folder.0.join("gallery");
    fs::create_dir_all(&gallery).expect("a new folder");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../gallery");
    for entry in fs::read_dir(source).expect("the gallery") {
        let path = entry.expect("the gallery can be read").path();
        let name = path.file_name().expect("listed by name");
        fs::copy(&path, gallery.join(name)).expect("a copy");
    }
    folder
}
