//! Writes the table of files that the command carries: the library, the gallery and, where the
//! environment names the folder of a built page (`THINGLAB_DIST`, a whole path), the page.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let home = PathBuf::from(env::var("CARGO_MANIFEST_DIR").expect("cargo names the package"));
    let top = home.join("../..").canonicalize()?;
    println!("cargo::rerun-if-env-changed=THINGLAB_DIST");

    let mut table = String::new();
    write_texts(&mut table, "LIBRARY", &top.join("library"), "thing")?;
    write_texts(&mut table, "GALLERY", &top.join("gallery"), "thing")?;
    write_texts(&mut table, "TABLES", &top.join("gallery"), "csv")?;
    write_page(&mut table, env::var_os("THINGLAB_DIST").map(PathBuf::from))?;
    let out = PathBuf::from(env::var("OUT_DIR").expect("cargo names the output folder"));
    fs::write(out.join("embedded.rs"), table)
}

/// One table of the files with an ending: `(file name, text)`, in order of name.
fn write_texts(table: &mut String, name: &str, folder: &Path, ending: &str) -> io::Result<()> {
    println!("cargo::rerun-if-changed={}", folder.display());
    writeln!(table, "pub(crate) static {name}: &[(&str, &str)] = &[").expect("a string");
    for path in
        files_below(folder)?.iter().filter(|path| path.extension().is_some_and(|e| e == ending))
    {
        let short = path.strip_prefix(folder).expect("found below the folder");
        writeln!(table, "    ({short:?}, include_str!({path:?})),").expect("a string");
    }
    writeln!(table, "];").expect("a string");
    Ok(())
}

/// The page's table: `(address, bytes)`; empty where no page was built.
fn write_page(table: &mut String, dist: Option<PathBuf>) -> io::Result<()> {
    writeln!(table, "pub(crate) static PAGE: &[(&str, &[u8])] = &[").expect("a string");
    if let Some(dist) = dist {
        println!("cargo::rerun-if-changed={}", dist.display());
        for path in files_below(&dist)? {
            let short = path.strip_prefix(&dist).expect("found below the folder");
            writeln!(
                table,
                "    ({:?}, include_bytes!({path:?})),",
                format!("/{}", short.display())
            )
            .expect("a string");
        }
    }
    writeln!(table, "];").expect("a string");
    Ok(())
}

/// Every file in a folder and the folders in it, sorted; none where there is no such folder.
fn files_below(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else { return Ok(found) };
    for entry in entries {
        let path = entry?.path();
        if path.is_dir() {
            found.append(&mut files_below(&path)?);
        } else {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
