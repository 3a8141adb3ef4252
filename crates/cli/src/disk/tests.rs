//! Failure first: names that are none, files that changed, folders that cannot be written.

use super::*;

/// A new folder, gone with its value.
struct Folder(PathBuf);

impl Folder {
    fn new() -> Folder {
        let path =
            std::env::temp_dir().join(format!("thinglab-disk-{:016x}", getrandom::u64().unwrap()));
        fs::create_dir(&path).unwrap();
        Folder(path)
    }

    fn root(&self) -> Root {
        Root::open(&self.0).unwrap()
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.0.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.0.join(name)).unwrap()
    }

    /// Every name in the folder itself, hidden ones too.
    fn entries(&self) -> Vec<String> {
        let names =
            fs::read_dir(&self.0).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn odd_names_are_no_documents() {
    let long = format!("{}.thing", "x".repeat(300));
    let deep = format!("{}x.thing", "a/".repeat(8));
    let odd = [
        "",
        ".thing",
        "x",
        "x.txt",
        "x.thing/",
        "/x.thing",
        "//x.thing",
        "../x.thing",
        "a/../x.thing",
        "./x.thing",
        "a//x.thing",
        "a/./x.thing",
        "..\\x.thing",
        "a\\x.thing",
        "C:x.thing",
        "C:/x.thing",
        "x\0.thing",
        "x\n.thing",
        "x.thing\0",
        "con.thing",
        "COM1.thing",
        "nul.tar.thing",
        "a./x.thing",
        "a /x.thing",
        " x.thing",
        ".hidden.thing",
        ".git/x.thing",
        "x%2f.thing",
        "%2e%2e/x.thing",
        "x\u{202e}.thing",
        "x\u{200b}.thing",
        "a*.thing",
        "a?.thing",
        "file:x.thing",
        long.as_str(),
        deep.as_str(),
    ];
    for name in odd {
        assert!(matches!(check_name(name), Err(DiskError::Name(_))), "{name:?} was let through");
    }
    for name in ["x.thing", "a/b-c/Büro 2.thing", "compass.thing", "a..b.thing", "comet/lptx.thing"]
    {
        assert!(check_name(name).is_ok(), "{name:?} was refused");
    }
}

#[test]
fn a_saved_text_is_read_back_and_leaves_no_draft() {
    let folder = Folder::new();
    folder.write("a.thing", "one\n");
    let before = read(&folder.root(), "a.thing").unwrap();
    let version = save(&folder.root(), "a.thing", "two\n", &before.version).unwrap();
    let after = read(&folder.root(), "a.thing").unwrap();
    assert_eq!(after, Stored { text: String::from("two\n"), version: version.clone() });
    assert_ne!(before.version, version);
    assert_eq!(folder.entries(), ["a.thing"]);
}

#[test]
fn a_file_that_changed_underneath_is_not_overwritten() {
    let folder = Folder::new();
    folder.write("a.thing", "one");
    let read_first = read(&folder.root(), "a.thing").unwrap().version;
    folder.write("a.thing", "theirs");
    match save(&folder.root(), "a.thing", "ours", &read_first) {
        Err(DiskError::Changed(Some(found))) => assert_eq!(found.text, "theirs"),
        other => panic!("{other:?}"),
    }
    assert_eq!(folder.text("a.thing"), "theirs");
    assert_eq!(folder.entries(), ["a.thing"]);
}

#[test]
fn a_file_that_was_deleted_underneath_is_not_made_anew() {
    let folder = Folder::new();
    folder.write("a.thing", "one");
    let version = read(&folder.root(), "a.thing").unwrap().version;
    fs::remove_file(folder.0.join("a.thing")).unwrap();
    let result = save(&folder.root(), "a.thing", "ours", &version);
    assert!(matches!(result, Err(DiskError::Changed(None))), "{result:?}");
    assert!(folder.entries().is_empty());
}

#[test]
fn a_new_file_is_made_only_where_there_is_none() {
    let folder = Folder::new();
    save(&folder.root(), "new.thing", "one", &Version::absent()).unwrap();
    assert_eq!(folder.text("new.thing"), "one");
    match save(&folder.root(), "new.thing", "two", &Version::absent()) {
        Err(DiskError::Changed(Some(found))) => assert_eq!(found.text, "one"),
        other => panic!("{other:?}"),
    }
    assert_eq!(folder.entries(), ["new.thing"]);
}

#[test]
fn a_file_that_appears_before_the_last_step_is_not_overwritten() {
    let folder = Folder::new();
    let (draft, path) = (folder.0.join(".draft.tmp"), folder.0.join("a.thing"));
    write_draft(&draft, &path, "ours").unwrap();
    folder.write("a.thing", "theirs");
    let result = put_in_place(&draft, &path, &Version::absent());
    assert!(matches!(result, Err(DiskError::Changed(Some(_)))), "{result:?}");
    assert_eq!(folder.text("a.thing"), "theirs");
}

#[test]
fn a_folder_that_is_not_there_is_made_for_a_new_document_alone() {
    let folder = Folder::new();
    let result = save(&folder.root(), "sub/a.thing", "x", &Version::of("old"));
    assert!(result.is_err(), "{result:?}");
    assert!(folder.entries().is_empty());
    save(&folder.root(), "sub/a.thing", "x", &Version::absent()).unwrap();
    assert_eq!(read(&folder.root(), "sub/a.thing").unwrap().text, "x");
}

#[test]
fn a_folder_and_bytes_that_are_no_text_are_no_document() {
    let folder = Folder::new();
    fs::create_dir(folder.0.join("a.thing")).unwrap();
    fs::write(folder.0.join("b.thing"), [0xff, 0xfe]).unwrap();
    assert!(matches!(read(&folder.root(), "a.thing"), Err(DiskError::NotPlain)));
    assert!(matches!(read(&folder.root(), "b.thing"), Err(DiskError::NotText)));
    let result = save(&folder.root(), "b.thing", "x", &Version::of(""));
    assert!(matches!(result, Err(DiskError::NotText)), "{result:?}");
    assert_eq!(fs::read(folder.0.join("b.thing")).unwrap(), [0xff, 0xfe]);
}

#[test]
fn a_text_that_is_too_long_is_neither_read_nor_saved() {
    let folder = Folder::new();
    let long = "x".repeat(LONGEST + 1);
    folder.write("a.thing", &long);
    assert!(matches!(read(&folder.root(), "a.thing"), Err(DiskError::TooLong)));
    let result = save(&folder.root(), "b.thing", &long, &Version::absent());
    assert!(matches!(result, Err(DiskError::TooLong)), "{result:?}");
    assert_eq!(folder.entries(), ["a.thing"]);
}

#[cfg(unix)]
#[test]
fn links_out_of_the_folder_are_not_followed() {
    use std::os::unix::fs::symlink;
    let (inside, outside) = (Folder::new(), Folder::new());
    outside.write("secret.thing", "secret");
    symlink(outside.0.join("secret.thing"), inside.0.join("file.thing")).unwrap();
    symlink(&outside.0, inside.0.join("folder")).unwrap();
    symlink(inside.0.join("nowhere.thing"), inside.0.join("dangling.thing")).unwrap();
    let root = inside.root();
    for name in ["file.thing", "folder/secret.thing", "dangling.thing"] {
        assert!(matches!(read(&root, name), Err(DiskError::NotPlain)), "{name} was read");
        for version in [Version::of("secret"), Version::absent()] {
            let result = save(&root, name, "mine", &version);
            assert!(matches!(result, Err(DiskError::NotPlain)), "{name}: {result:?}");
        }
    }
    assert_eq!(outside.text("secret.thing"), "secret");
    assert!(list(&root).unwrap().is_empty());
}

#[cfg(unix)]
#[test]
fn a_folder_whose_name_begins_alike_is_outside() {
    use std::os::unix::fs::symlink;
    let both = Folder::new();
    both.write("test/a.thing", "in");
    both.write("testtest/a.thing", "out");
    symlink(both.0.join("testtest"), both.0.join("test/alike")).unwrap();
    let root = Root::open(&both.0.join("test")).unwrap();
    assert!(matches!(read(&root, "alike/a.thing"), Err(DiskError::NotPlain)));
}

/// The process file system takes no new file from anyone, root included.
#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_takes_no_file_gives_an_error() {
    let root = Root::open(Path::new("/proc/self")).unwrap();
    let result = save(&root, "a.thing", "x", &Version::absent());
    assert!(matches!(result, Err(DiskError::Io(_))), "{result:?}");
}

#[cfg(unix)]
#[test]
fn permissions_are_kept() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    folder.write("a.thing", "one");
    fs::set_permissions(folder.0.join("a.thing"), fs::Permissions::from_mode(0o640)).unwrap();
    save(&folder.root(), "a.thing", "two", &Version::of("one")).unwrap();
    let mode = fs::metadata(folder.0.join("a.thing")).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
}

#[test]
fn the_list_passes_over_hidden_and_built_folders() {
    let folder = Folder::new();
    for name in
        ["b.thing", "a/c.thing", "note.txt", ".git/x.thing", "target/x.thing", "dist/x.thing"]
    {
        folder.write(name, "x");
    }
    assert_eq!(list(&folder.root()).unwrap(), ["a/c.thing", "b.thing"]);
}

#[test]
fn versions_tell_texts_apart() {
    assert_eq!(Version::of("").0, "6c62272e07bb014262b821756295c58d");
    assert_eq!(Version::of("a").0, "d228cb696f1a8caf78912b704e4a8964");
    assert_ne!(Version::of("a"), Version::absent());
}

#[test]
fn a_document_of_the_gallery_is_saved_where_the_folder_has_no_gallery() {
    let folder = Folder::new();
    let version = save(&folder.root(), "gallery/queens.thing", "a: Real\n", &Version::absent());
    assert_eq!(version.expect("its folder is made"), Version::of("a: Real\n"));
    assert_eq!(folder.text("gallery/queens.thing"), "a: Real\n");
    // what is no longer there is not made anew
    let gone = save(&folder.root(), "other/x.thing", "b: Real\n", &Version::of("a: Real\n"));
    assert!(gone.is_err());
    assert_eq!(folder.entries(), ["gallery"]);
}

#[cfg(unix)]
#[test]
fn no_folder_is_made_behind_a_link_that_leaves_the_root() {
    let (folder, outside) = (Folder::new(), Folder::new());
    std::os::unix::fs::symlink(&outside.0, folder.0.join("link")).unwrap();
    let refused = save(&folder.root(), "link/new/x.thing", "a: Real\n", &Version::absent());
    assert!(matches!(refused, Err(DiskError::NotPlain)));
    assert_eq!(outside.entries(), Vec::<String>::new());
}
