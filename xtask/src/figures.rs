//! What `cargo bench-table browser` calls: builds the page of figures and reads it in a browser.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};
use std::{fs, io};

use crate::bundle::{self, Effort};
use crate::say;
use crate::tools::{self, Missing, Tool};

/// Reads the command line.
///
/// # Errors
/// A sentence about the first argument that is not one.
pub(crate) fn parse(arguments: &[String]) -> Result<Missing, String> {
    match arguments {
        [] => Ok(Missing::Name),
        [install] if install == "--install" => Ok(Missing::Install),
        [other, ..] => Err(format!("unknown argument {other}")),
    }
}

/// Builds and prints; 2 where something is missing, 1 where something does not compile or run.
pub(crate) fn run(missing: Missing) -> ExitCode {
    tools::require(&[Tool::WasmCompiler, Tool::Browser], missing);
    let (Some(compiler), Some(browser)) = (tools::wasm_compiler(), tools::browser()) else {
        return ExitCode::from(2);
    };
    let table = bundle::module("figures", &compiler, Effort::Full).and_then(|module| {
        let page = written(&module).map_err(|error| format!("no page of figures: {error}"))?;
        shown(&browser, &page)
    });
    match table {
        Ok(table) => {
            say!("{table}");
            ExitCode::SUCCESS
        }
        Err(why) => {
            say!("{why}");
            ExitCode::FAILURE
        }
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
