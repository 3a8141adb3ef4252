//! `thinglab serve`: the lab's page and the documents of one folder, for this machine alone.
//!
//! In: requests on a loopback port. [`guard`] refuses what does not come from the page itself, first
//! of all and whatever is asked for; [`api`] answers the rest. The printed address carries the token
//! in its fragment, which browsers never send.

use std::io::{self, Write};
use std::net::{Ipv4Addr, SocketAddr};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::rc::Rc;
use std::time::Duration;

use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;

use crate::disk::Root;
use crate::embedded::Page;
use crate::journal::Journal;

mod api;
mod guard;

/// How long a request's head may take to arrive, and how many connections there may be at once.
const HEAD_TIME: Duration = Duration::from_secs(10);
const MOST_CONNECTIONS: usize = 256;

/// The longest head of a request, in bytes.
const LONGEST_HEAD: usize = 16 << 10;

#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The document to open, or to begin where there is none yet; without it the gallery.
    file: Option<PathBuf>,
    /// The port on 127.0.0.1; 0 takes a free one. Without it each folder has some of its own, so that the browser
    /// finds again what it keeps for that folder: unsaved texts, what was chosen.
    #[arg(long)]
    port: Option<u16>,
    /// The folder whose documents may be read and saved; else the current one, or FILE's where that
    /// lies elsewhere.
    #[arg(long)]
    root: Option<PathBuf>,
    /// The page's files, from a folder instead of those that the command carries.
    #[arg(long, hide = true)]
    page: Option<PathBuf>,
    /// Only print the address.
    #[arg(long)]
    no_open: bool,
}

/// What the requests share.
struct Lab {
    page: Page,
    root: Root,
    journal: Journal,
    guard: guard::Guard,
}

/// Serves until it is stopped.
pub(crate) fn run(arguments: &Arguments) -> ExitCode {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_io().enable_time().build();
    match runtime
        .and_then(|runtime| tokio::task::LocalSet::new().block_on(&runtime, open(arguments)))
    {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // Without a standard error there is nobody to tell.
            let _ = writeln!(io::stderr(), "thinglab serve: {error}");
            ExitCode::from(2)
        }
    }
}

async fn open(arguments: &Arguments) -> io::Result<()> {
    let (root, document) = choose(arguments.root.as_deref(), arguments.file.as_deref())?;
    let listener = listen(arguments.port, root.folder()).await?;
    let address = listener.local_addr()?;
    let guard = guard::Guard::new(address.port())?;
    let address = page_address(address, document.as_deref(), guard.token());
    announce(&address, root.folder())?;
    if !arguments.no_open {
        open_browser(&address);
    }
    let page = arguments.page.clone().map_or(Page::Carried, Page::Folder);
    let journal = Journal::of(&root);
    accept(listener, Rc::new(Lab { page, root, journal, guard })).await
}

/// Listens on a port that was asked for, or else on the first of the folder's own that no other program has; where
/// there is none, on any that is free.
async fn listen(port: Option<u16>, folder: &Path) -> io::Result<TcpListener> {
    let at = |port| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    if let Some(port) = port {
        return at(port).await;
    }
    for port in own_ports(folder) {
        if let Ok(listener) = at(port).await {
            return Ok(listener);
        }
    }
    at(0).await
}

/// The ports of a folder by its name, one for each lab that may be open over it at once: ports that nothing is
/// registered for, above those that Linux gives to outgoing connections. **Source:** RFC 6335, section 6.
fn own_ports(folder: &Path) -> impl Iterator<Item = u16> {
    const FIRST: u32 = 61_000;
    const EACH: u32 = 8;
    const FOLDERS: u32 = (65_536 - FIRST) / EACH;
    // FNV-1a
    let bytes = folder.as_os_str().as_encoded_bytes();
    let hash = bytes
        .iter()
        .fold(0x811c_9dc5_u32, |hash, &byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193));
    let own = FIRST + hash % FOLDERS * EACH;
    (own..own + EACH).map(|port| port as u16)
}

/// The folder to serve, and the document's name in it.
fn choose(root: Option<&Path>, file: Option<&Path>) -> io::Result<(Root, Option<String>)> {
    let here = Root::open(root.unwrap_or(Path::new(".")))?;
    let Some(file) = file else { return Ok((here, None)) };
    let real = real_path(file)
        .map_err(|error| io::Error::new(error.kind(), format!("{}: {error}", file.display())))?;
    let root = match real.parent() {
        Some(folder) if root.is_none() && !real.starts_with(here.folder()) => Root::open(folder)?,
        _ => here,
    };
    let name = real.strip_prefix(root.folder()).ok().and_then(Path::to_str);
    let name = name.ok_or_else(|| {
        let why = format!("{} is not below {}", file.display(), root.folder().display());
        io::Error::new(io::ErrorKind::InvalidInput, why)
    })?;
    let name = name.replace(std::path::MAIN_SEPARATOR, "/");
    crate::disk::check_name(&name).map_err(|error| {
        io::Error::new(io::ErrorKind::InvalidInput, format!("{}: {error}", file.display()))
    })?;
    Ok((root, Some(name)))
}

/// The real path of a file that is there, or that will be in a folder that is there.
fn real_path(file: &Path) -> io::Result<PathBuf> {
    let missing = match file.canonicalize() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => error,
        found => return found,
    };
    let Some(name) = file.file_name() else { return Err(missing) };
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    Ok(folder.unwrap_or(Path::new(".")).canonicalize()?.join(name))
}

/// The address to open: the document in the query, the token in the fragment.
fn page_address(address: SocketAddr, document: Option<&str>, token: &str) -> String {
    let query = document.map(|name| format!("?document={}", api::encoded(name)));
    format!("http://{address}/{}#token={token}", query.unwrap_or_default())
}

fn announce(page: &str, folder: &Path) -> io::Result<()> {
    let folder = folder.display();
    let lines = format!(
        "The lab is open at {page}\nIt shows and saves the documents in {folder}; Ctrl+C closes it.\n"
    );
    let mut out = io::stdout().lock();
    out.write_all(lines.as_bytes())?;
    out.flush()
}

/// Opens the address in the browser, where there is a desktop with one; the printed address serves
/// everywhere else.
fn open_browser(page: &str) {
    let opener = if cfg!(target_os = "macos") {
        "open"
    } else if std::env::var_os("DISPLAY").is_some() || std::env::var_os("WAYLAND_DISPLAY").is_some()
    {
        "xdg-open"
    } else {
        return;
    };
    let quiet = Command::new(opener)
        .arg(page)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn();
    // No opener, no browser: the address has been printed.
    drop(quiet);
}

/// Takes connections, a bounded number at once; no client can hold one by being slow with its head.
async fn accept(listener: TcpListener, lab: Rc<Lab>) -> io::Result<()> {
    let places = Rc::new(Semaphore::new(MOST_CONNECTIONS));
    loop {
        let place = Rc::clone(&places);
        let Ok((stream, _)) = listener.accept().await else {
            // Out of descriptors, or the client has gone: the next one may do better.
            tokio::time::sleep(Duration::from_millis(10)).await;
            continue;
        };
        let lab = Rc::clone(&lab);
        tokio::task::spawn_local(async move {
            if let Ok(_place) = place.try_acquire() {
                serve_connection(stream, lab).await;
            }
        });
    }
}

async fn serve_connection(stream: TcpStream, lab: Rc<Lab>) {
    let answer = service_fn(move |request| {
        let lab = Rc::clone(&lab);
        async move { Ok::<_, std::convert::Infallible>(api::answer(&lab, request).await) }
    });
    // A broken connection is the client's affair.
    let _ = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD_TIME)
        .max_buf_size(LONGEST_HEAD)
        .serve_connection(TokioIo::new(stream), answer)
        .await;
}

#[cfg(test)]
mod tests {
    use super::{own_ports, real_path};
    use std::path::Path;

    #[test]
    fn a_folder_has_the_same_ports_again_and_another_has_others() {
        let ports = |folder: &str| own_ports(Path::new(folder)).collect::<Vec<u16>>();
        assert_eq!(ports("/home/a"), ports("/home/a"));
        assert_eq!(ports("/home/a").len(), 8);
        assert!(ports("/home/a").iter().all(|port| (61_000..=65_535).contains(port)));
        assert!(ports("/home/a").iter().all(|port| !ports("/home/b").contains(port)));
    }

    #[test]
    fn a_file_that_is_not_there_yet_is_begun_in_a_folder_that_is() {
        let folder = std::env::temp_dir().canonicalize().unwrap();
        let file = folder.join("thinglab-never-saved.thing");
        assert_eq!(real_path(&file).unwrap(), file);
        assert!(real_path(&folder.join("no-such-folder/x.thing")).is_err());
    }
}
