//! `cargo lab`: builds the page and the command, then serves.

use std::path::Path;
use std::process::{Command, ExitCode};

use crate::bundle::{self, Effort};
use crate::say;
use crate::tools::{self, Missing, Tool};

/// What the command line asks for.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Wish {
    then: Then,
    missing: Missing,
    effort: Effort,
    /// Handed on to `thinglab serve`.
    serve: Vec<String>,
}

#[derive(Debug, PartialEq, Eq)]
enum Then {
    Serve,
    Exit,
}

/// Reads the command line.
///
/// # Errors
/// A sentence about the first argument that is not one.
pub(crate) fn parse(arguments: &[String]) -> Result<Wish, String> {
    let mut wish =
        Wish { then: Then::Serve, missing: Missing::Name, effort: Effort::Full, serve: Vec::new() };
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--check" => wish.then = Then::Exit,
            "--quick" => wish.effort = Effort::Quick,
            "--install" => wish.missing = Missing::Install,
            "--no-open" => wish.serve.push(argument.clone()),
            "--port" => {
                let port = rest.next().ok_or("--port wants a number")?;
                wish.serve.extend([argument.clone(), port.clone()]);
            }
            option if option.starts_with('-') => return Err(format!("unknown option {option}")),
            file => wish.serve.push(String::from(file)),
        }
    }
    Ok(wish)
}

/// Builds and serves; 2 where something is missing, 1 where something does not compile.
pub(crate) fn run(wish: &Wish) -> ExitCode {
    tools::require(&[Tool::WasmCompiler], wish.missing);
    let Some(compiler) = tools::wasm_compiler() else { return ExitCode::from(2) };
    // neither keeps two cores busy by itself
    let (page, thinglab) = std::thread::scope(|scope| {
        let page = scope.spawn(|| bundle::build(&compiler, wish.effort));
        let thinglab = bundle::build_command(wish.effort, &bundle::NATIVE);
        (page.join().unwrap_or_else(|_| Err(String::from("the page broke off"))), thinglab)
    });
    let thinglab = match page.and(thinglab) {
        Ok(path) => path,
        Err(why) => {
            say!("{why}");
            return ExitCode::FAILURE;
        }
    };
    match wish.then {
        Then::Exit => ExitCode::SUCCESS,
        Then::Serve => serve(&thinglab, wish),
    }
}

fn serve(thinglab: &Path, wish: &Wish) -> ExitCode {
    let mut server = Command::new(thinglab);
    server.arg("serve").args(&wish.serve).arg("--page").arg(crate::top().join("dist"));
    match server.status() {
        Ok(status) if status.success() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            say!("{}: {error}", thinglab.display());
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(line: &str) -> Result<Wish, String> {
        parse(&line.split_whitespace().map(String::from).collect::<Vec<_>>())
    }

    #[test]
    fn a_file_and_a_port_go_to_the_server() {
        let wish = parsed("--port 8000 gallery/quadrilateral.thing --install --quick").unwrap();
        assert_eq!(wish.serve, ["--port", "8000", "gallery/quadrilateral.thing"]);
        assert_eq!((wish.then, wish.missing), (Then::Serve, Missing::Install));
        assert_eq!(wish.effort, Effort::Quick);
    }

    #[test]
    fn a_wrong_option_is_named() {
        assert_eq!(parsed("--chek").unwrap_err(), "unknown option --chek");
        assert_eq!(parsed("--port").unwrap_err(), "--port wants a number");
    }
}
