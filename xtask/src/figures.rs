//! What `cargo bench-table browser` calls: builds the page of figures and reads it in a browser. And what
//! `cargo bench-table lab` calls: builds the lab and visits it. `figures rest` visits it too, and keeps which of its
//! functions a first drag does not run.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::{fs, io};

use crate::bundle::{self, Effort};
use crate::say;
use crate::tools::{self, Missing, Tool, WasmCompiler};

/// Whose figures are wanted.
#[derive(Clone, Copy)]
pub(crate) enum Of {
    /// What the solver does in WebAssembly.
    Browser,
    /// The lab's, as people get it.
    Lab,
    /// None: which functions of the page come after a first drag, kept for its next making.
    Rest,
}

/// Reads the command line.
///
/// # Errors
/// A sentence about the first argument that is not one.
pub(crate) fn parse(arguments: &[String]) -> Result<(Of, Missing), String> {
    let (of, rest) = match arguments.split_first() {
        Some((first, rest)) if first == "lab" => (Of::Lab, rest),
        Some((first, others)) if first == "rest" => (Of::Rest, others),
        _ => (Of::Browser, arguments),
    };
    match rest {
        [] => Ok((of, Missing::Name)),
        [install] if install == "--install" => Ok((of, Missing::Install)),
        [other, ..] => Err(format!("unknown argument {other}")),
    }
}

/// Builds and prints; 2 where something is missing, 1 where something does not compile or run.
pub(crate) fn run((of, missing): (Of, Missing)) -> ExitCode {
    tools::require(&[Tool::WasmCompiler, Tool::Browser], missing);
    let (Some(compiler), Some(browser)) = (tools::wasm_compiler(), tools::browser()) else {
        return ExitCode::from(2);
    };
    let told = match of {
        Of::Lab => visited(&compiler, &browser, Effort::Full, "lab-figures"),
        Of::Rest => visited(&compiler, &browser, Effort::Followed, "lab-rest").and_then(|list| {
            fs::write(bundle::rest(), list).map_err(|error| format!("not written: {error}"))?;
            Ok(format!("{} is new", bundle::rest().display()))
        }),
        Of::Browser => {
            bundle::module("figures", &compiler, Effort::Full).and_then(|(module, _)| {
                let page =
                    written(&module).map_err(|error| format!("no page of figures: {error}"))?;
                shown(&browser, &page)
            })
        }
    };
    let (said, code) = match told {
        Ok(table) => (table, ExitCode::SUCCESS),
        Err(why) => (why, ExitCode::FAILURE),
    };
    say!("{said}");
    code
}

/// Builds the lab, and has it visited by a program of the browser's package; gives what that prints.
fn visited(
    compiler: &WasmCompiler,
    browser: &Path,
    effort: Effort,
    visitor: &str,
) -> Result<String, String> {
    bundle::build(compiler, effort)?;
    let thinglab = bundle::build_command(Effort::Quick, &bundle::NATIVE)?;
    let mut visit = tools::cargo(&["run", "--quiet", "--package", "browser", "--bin", visitor]);
    visit.env("THINGLAB", thinglab).env("CHROMIUM", browser).stderr(Stdio::inherit());
    let output = visit.output().map_err(|error| format!("{visitor}: {error}"))?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).trim_end().into()),
        false => Err(format!("{visitor} failed")),
    }
}

/// Writes a page that needs no server and has run when it is there: all its code stands in it.
fn written(module: &Path) -> io::Result<PathBuf> {
    let script = fs::read_to_string(module.join("figures.js"))?;
    let code = fs::read(module.join("figures_bg.wasm"))?;
    let code: String = code.iter().map(|byte| format!("{byte:02x}")).collect();
    let page = module.join("figures.html");
    let start = format!(
        "const code = Uint8Array.from(\"{code}\".match(/../g), byte => parseInt(byte, 16));\n\
         initSync({{ module: code }});"
    );
    let text = format!(
        "<!doctype html><meta charset=utf-8><body>it did not run\n<script type=module>\n{script}\n{start}\n</script>"
    );
    fs::write(&page, text)?;
    Ok(page)
}

/// Opens a page without a window; gives the text of its body when it has run.
fn shown(browser: &Path, page: &Path) -> Result<String, String> {
    let flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--dump-dom"];
    let mut command = Command::new(browser);
    command.args(flags).arg(format!("file://{}", page.display())).stderr(Stdio::null());
    let output = command.output().map_err(|error| format!("{}: {error}", browser.display()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let body = text.split_once("<body>").and_then(|(_, rest)| rest.split_once("</body>"));
    match body {
        Some((table, _)) if !table.contains("<script") => Ok(table.trim_end().into()),
        Some(_) | None => Err("the page of figures did not run".into()),
    }
}
