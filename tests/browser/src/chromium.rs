//! Browsers and their drivers. One visit takes a browser after the other, since to start Chromium costs as much as
//! most visits do.
//!
//! A browser is lent to one visit at a time, and shows it a tab of its own in a window of the usual size. A visit's
//! address may be one that another had: what is kept under it is emptied first. The clipboard and the cache of what
//! servers answered go on to the next visit. Where a test fails its browser is not lent again.

use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};
use std::{env, thread};

use fantoccini::error::{CmdError, NewSessionError};
use fantoccini::{Client, ClientBuilder};
use hyper_util::client::legacy::connect::HttpConnector;
use serde_json::{Value, json};

/// The size of a window, in pixels.
pub(crate) const SIZE: (u32, u32) = (1400, 900);

/// Those that nobody visits with.
static IDLE: Mutex<Vec<Browser>> = Mutex::new(Vec::new());

/// A browser with its driver.
#[derive(Debug)]
struct Browser {
    /// Where the driver listens.
    address: String,
    /// What the driver calls the browser.
    session: String,
    _life: Life,
}

/// A browser that a visit has; idle again with the value.
#[derive(Debug)]
pub(crate) struct Lent(Option<Browser>);

impl Drop for Lent {
    fn drop(&mut self) {
        if let Some(browser) = self.0.take().filter(|_| !thread::panicking()) {
            IDLE.lock().unwrap_or_else(PoisonError::into_inner).push(browser);
        }
    }
}

/// Takes a browser, and gives what drives its one empty tab.
///
/// # Panics
/// Where the driver or the browser does not start: then there is nothing to test.
pub(crate) async fn take() -> (Client, Lent) {
    let idle = IDLE.lock().unwrap_or_else(PoisonError::into_inner).pop();
    if let Some(browser) = idle
        && let Ok(client) = browser.client().await
        && clear(&client).await.is_ok()
    {
        return (client, Lent(Some(browser)));
    }
    let browser = Browser::start().await;
    let client = browser.client().await.expect("chromedriver knows its browser");
    (client, Lent(Some(browser)))
}

/// Puts one empty tab in the place of all that a visit has left open.
async fn clear(client: &Client) -> Result<(), CmdError> {
    let old = client.windows().await?;
    let new = client.new_window(true).await?;
    for window in old {
        client.switch_to_window(window).await?;
        client.close_window().await?;
    }
    client.switch_to_window(new.handle).await?;
    client.release_actions().await?;
    client.set_window_size(SIZE.0, SIZE.1).await
}

impl Browser {
    async fn start() -> Browser {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("thinglab-browser-{}-{number}", std::process::id());
        let profile = env::temp_dir().join(name);
        let (life, port) = start_driver(&profile);
        let address = format!("http://127.0.0.1:{port}");
        let client = ClientBuilder::new(HttpConnector::new())
            .capabilities(capabilities(&profile))
            .connect(&address)
            .await
            .expect("chromedriver opens Chromium");
        client.persist().await.expect("a client");
        let session = client.session_id().await.ok().flatten().expect("an open session has a name");
        Browser { address, session, _life: life }
    }

    /// What drives it, for as long as the runtime lasts that asks.
    async fn client(&self) -> Result<Client, NewSessionError> {
        let connector = HttpConnector::new();
        let client = Client::with_existing_session(&self.address, &self.session, connector).await?;
        // the browser stays when the client goes
        client.persist().await.expect("a client");
        Ok(client)
    }
}

/// A program that ends when its standard input does: with the value, and with this process however it ends.
#[derive(Debug)]
struct Life {
    input: Option<ChildStdin>,
    program: Child,
}

impl Drop for Life {
    fn drop(&mut self) {
        self.input = None;
        // It may have ended by itself.
        let _ = self.program.wait();
    }
}

/// Starts chromedriver and gives its port. It takes a port that is free for one kind of address and
/// ends where another program has it for the other kind: then it is asked again.
fn start_driver(profile: &Path) -> (Life, u16) {
    /// Ends the driver once the input ends, and with it Chromium, which it holds by a pipe: also where a key ends the
    /// tests, which this outlives to remove the profile.
    const WATCHED: &str = "trap '' INT; exec 3<&0; chromedriver --port=0 & driver=$!; \
        { read -r _ <&3; kill $driver; } >/dev/null 2>&1 & exec 2>/dev/null; wait $driver; \
        sleep 1; rm -rf \"$0\" || { sleep 2; rm -rf \"$0\"; }";
    let mark = "started successfully on port ";
    let start = || {
        let mut shell = Command::new("sh");
        shell.args(["-c", WATCHED]).arg(profile).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut program = shell.spawn().expect("a shell");
        let output = program.stdout.take().expect("piped");
        let life = Life { input: program.stdin.take(), program };
        let mut lines = BufReader::new(output).lines().map_while(Result::ok);
        let line = lines.find(|line| line.contains(mark))?;
        // What it prints later is read and dropped, so that it never waits for us.
        thread::spawn(move || lines.count());
        let port = line.rsplit(' ').next()?.trim_end_matches('.').parse().ok()?;
        Some((life, port))
    };
    (0..5).find_map(|_| start()).expect("chromedriver says that it runs, and names its port")
}

fn capabilities(profile: &Path) -> serde_json::Map<String, Value> {
    let profile = format!("--user-data-dir={}", profile.display());
    let size = format!("--window-size={},{}", SIZE.0, SIZE.1);
    let arguments = [
        "--headless=new",
        "--no-sandbox",
        "--disable-gpu",
        "--disable-gpu-rasterization",
        "--disable-software-rasterizer",
        "--disable-dev-shm-usage",
        "--no-first-run",
        "--disable-background-networking",
        "--disable-component-update",
        "--disable-sync",
        "--remote-debugging-pipe",
        &size,
        &profile,
    ];
    let wanted = json!({
        "browserName": "chrome",
        "goog:chromeOptions": { "binary": crate::named("CHROMIUM"), "args": arguments },
    });
    match wanted {
        Value::Object(map) => map,
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) | Value::Array(_) => {
            unreachable!("written as an object")
        }
    }
}
