//! What must be on the machine, how to see whether it is, and how to get it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::say;

/// Something that a build or a test needs besides the Rust toolchain's compiler.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tool {
    /// A compiler for the browser's machine.
    WasmCompiler,
    /// The formatter.
    Rustfmt,
    /// The linter.
    Clippy,
    /// Chromium and its driver.
    Browser,
    /// Python with ezdxf, which audits drawings.
    Ezdxf,
}

/// The compiler that makes the page.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum WasmCompiler {
    /// The toolchain's own, with the target's libraries.
    Toolchain,
    /// Debian's, which builds the libraries from source with the linker given.
    Debian { linker: PathBuf },
}

/// The browser's machine.
pub(crate) const WASM: &str = "wasm32-unknown-unknown";
const DEBIAN_WASM: [&str; 4] = ["rustc-web", "cargo-web", "rust-web-src", "lld-19"];
const EZDXF: &str = "ezdxf==1.4.5";
const DEBIAN_BROWSER: [&str; 2] = ["chromium", "chromium-driver"];

impl Tool {
    fn is_there(self) -> bool {
        match self {
            Tool::WasmCompiler => wasm_compiler().is_some(),
            Tool::Rustfmt => succeeds(&mut cargo(&["fmt", "--version"])),
            Tool::Clippy => clippy_driver().is_some(),
            Tool::Browser => browser().is_some() && on_path(&["chromedriver"]).is_some(),
            Tool::Ezdxf => succeeds(Command::new(ezdxf()).args(["-c", "import ezdxf"])),
        }
    }

    /// What is missing and how to get it, in one line.
    fn remedy(self) -> String {
        match self {
            Tool::WasmCompiler => format!(
                "missing: a Rust compiler for {WASM}; `rustup target add {WASM}`, or as root `apt-get install -y --no-install-recommends {}`",
                DEBIAN_WASM.join(" ")
            ),
            Tool::Rustfmt => String::from("missing: the formatter; `rustup component add rustfmt`"),
            Tool::Clippy => String::from("missing: the linter; `rustup component add clippy`"),
            Tool::Browser => format!(
                "missing: Chromium and chromedriver; as root `apt-get install -y --no-install-recommends {}`, or `cargo verify --no-browser`",
                DEBIAN_BROWSER.join(" ")
            ),
            Tool::Ezdxf => String::from(
                "missing: ezdxf in target/ezdxf; `cargo verify --install` makes a Python environment of it",
            ),
        }
    }

    fn install(self) {
        match self {
            Tool::WasmCompiler => {
                if !rustup(&["target", "add", WASM]) {
                    apt(&DEBIAN_WASM);
                }
            }
            Tool::Rustfmt => {
                rustup(&["component", "add", "rustfmt"]);
            }
            Tool::Clippy => {
                rustup(&["component", "add", "clippy"]);
            }
            Tool::Browser => apt(&DEBIAN_BROWSER),
            Tool::Ezdxf => {
                say!("installing: {EZDXF} in target/ezdxf");
                let folder = crate::top().join("target/ezdxf");
                let mut make = Command::new("python3");
                let made = succeeds(make.args(["-m", "venv"]).arg(folder));
                let pip = ["-m", "pip", "install", "--quiet", EZDXF];
                if !made || !succeeds(Command::new(ezdxf()).args(pip)) {
                    say!(
                        "Python could not; it needs its modules venv and pip, and its package index"
                    );
                }
            }
        }
    }
}

/// What to do about a tool that is not there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Missing {
    Name,
    Install,
}

/// Makes sure of the tools; gives the number of those still missing, each named with its remedy.
pub(crate) fn require(tools: &[Tool], missing: Missing) -> usize {
    let mut lacking = 0;
    for tool in tools {
        if !tool.is_there() && missing == Missing::Install {
            tool.install();
        }
        if !tool.is_there() {
            say!("{}", tool.remedy());
            lacking += 1;
        }
    }
    lacking
}

/// The compiler for the page, where there is one.
pub(crate) fn wasm_compiler() -> Option<WasmCompiler> {
    let libraries =
        output(Command::new(rustc()).args(["--print", "target-libdir", "--target", WASM]))?;
    if Path::new(libraries.trim()).is_dir() {
        return Some(WasmCompiler::Toolchain);
    }
    let sysroot = output(Command::new("/usr/bin/rustc").args(["--print", "sysroot"]))?;
    let source = Path::new(sysroot.trim()).join("lib/rustlib/src/rust/library/std");
    let linker = on_path(&["lld-19", "lld"])?;
    let there = source.is_dir() && Path::new("/usr/bin/cargo").exists();
    there.then_some(WasmCompiler::Debian { linker })
}

/// Has cargo compile the workspace's packages with the linter, which is a compiler that complains more. Machine code is
/// of the same speed as the compiler's at opt-level 1 (measured on the tests).
pub(crate) fn lint(cargo: &mut Command) -> &mut Command {
    if let Some(driver) = clippy_driver() {
        cargo.env("RUSTC_WORKSPACE_WRAPPER", driver);
    }
    cargo
}

/// The linter as a compiler.
fn clippy_driver() -> Option<PathBuf> {
    let beside = beside_the_compiler("clippy-driver").filter(|driver| driver.exists());
    beside.or_else(|| on_path(&["clippy-driver"]))
}

/// The program that writes documentation.
pub(crate) fn rustdoc() -> PathBuf {
    let beside = beside_the_compiler("rustdoc").filter(|program| program.exists());
    beside.unwrap_or_else(|| PathBuf::from("rustdoc"))
}

fn beside_the_compiler(program: &str) -> Option<PathBuf> {
    let sysroot = output(Command::new(rustc()).args(["--print", "sysroot"]))?;
    Some(
        Path::new(sysroot.trim())
            .join("bin")
            .join(format!("{program}{}", std::env::consts::EXE_SUFFIX)),
    )
}

/// The Python that has ezdxf.
pub(crate) fn ezdxf() -> PathBuf {
    crate::top().join("target/ezdxf/bin/python")
}

/// The browser for the tests.
pub(crate) fn browser() -> Option<PathBuf> {
    on_path(&["chromium", "chromium-browser", "google-chrome"])
}

/// Cargo, the one that runs us.
pub(crate) fn cargo(arguments: &[&str]) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.args(arguments).current_dir(crate::top());
    command
}

/// The same behind all that others do at once, where the system knows such an order.
pub(crate) fn cargo_behind(arguments: &[&str]) -> Command {
    let Some(nice) = on_path(&["nice"]) else { return cargo(arguments) };
    let cargo = cargo(arguments);
    let mut command = Command::new(nice);
    command.args(["-n", "10"]).arg(cargo.get_program()).args(arguments).current_dir(crate::top());
    command
}

fn rustc() -> std::ffi::OsString {
    std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// The first of these programs that is on the search path.
fn on_path(names: &[&str]) -> Option<PathBuf> {
    let path = std::env::var_os("PATH")?;
    names.iter().find_map(|name| {
        std::env::split_paths(&path).map(|folder| folder.join(name)).find(|file| file.is_file())
    })
}

fn rustup(arguments: &[&str]) -> bool {
    say!("installing: rustup {}", arguments.join(" "));
    let done = succeeds(Command::new("rustup").args(arguments));
    if !done {
        say!("rustup could not");
    }
    done
}

/// Installs Debian's packages; `require` sees afterwards whether that worked.
fn apt(packages: &[&str]) {
    say!("installing: {}", packages.join(" "));
    let apt_get = |arguments: &[&str]| {
        let mut command = Command::new("apt-get");
        command.env("DEBIAN_FRONTEND", "noninteractive").arg("-qq").args(arguments);
        output(&mut command).is_some()
    };
    let install = ["install", "-y", "--no-install-recommends"];
    if !apt_get(&["update"]) || !apt_get(&[&install, packages].concat()) {
        say!("apt-get could not; it needs root and Debian");
    }
}

fn succeeds(command: &mut Command) -> bool {
    let quiet = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// What a command prints, where it succeeds.
fn output(command: &mut Command) -> Option<String> {
    let output = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}
