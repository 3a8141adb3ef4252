//! Hostile documents: whatever stands in a text, reading it ends soon, and says what is wrong.

use lang::{Lowered, lower};
use proptest::prelude::*;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn library(name: &str) -> Option<String> {
    fs::read_to_string(root().join("library").join(name).with_extension("thing")).ok()
}

/// The longest that any text of a few megabytes may take, on a slow and busy machine.
const LONGEST: Duration = Duration::from_secs(20);

/// Lowers a text and makes its things; returns the codes of what is wrong, each once.
fn codes(text: &str) -> Vec<&'static str> {
    let start = Instant::now();
    let lowered = lower(text, &library, None);
    let (structure, faults) = kernel::instantiate(&lowered.document);
    kernel::check::structure(&lowered.document, &structure).expect("a structure is in order");
    assert!(start.elapsed() < LONGEST, "it ends soon: {:?}", start.elapsed());
    let mut codes: Vec<_> = lowered.diagnostics.iter().map(|d| d.code).collect();
    codes.extend(lowered.fault_diagnostics(&faults).iter().map(|d| d.code));
    assert_in_text(&lowered);
    codes.sort_unstable();
    codes.dedup();
    codes
}

/// Every diagnostic stands in a text, between characters.
fn assert_in_text(lowered: &Lowered) {
    for d in &lowered.diagnostics {
        let text = &lowered.files[d.place.file].text;
        assert!(text.get(d.place.span.range()).is_some(), "{} at {:?}", d.code, d.place.span);
    }
}

fn lines(n: usize, line: impl Fn(usize) -> String) -> String {
    let mut text = String::new();
    for i in 0..n {
        let _ = writeln!(text, "{}", line(i));
    }
    text
}

#[test]
fn many_parts_are_read_in_a_moment() {
    assert_eq!(codes(&lines(20_000, |i| format!("p{i}: Real = {i}"))), [""; 0]);
}
#[test]
fn many_unused_classes_are_read_in_a_moment() {
    assert_eq!(codes(&lines(100_000, |i| format!("class C{i} {{ x: Real }}"))), [""; 0]);
}
#[test]
fn many_unknown_names_are_reported() {
    assert_eq!(codes(&lines(5_000, |i| format!("p{i}: Real = nothing{i}"))), ["unknown-name"]);
}
#[test]
fn many_unknown_classes_are_reported() {
    assert_eq!(codes(&lines(5_000, |i| format!("p{i}: Kind{i}"))), ["unknown-class"]);
}
#[test]
fn many_values_of_which_nothing_is_left_are_reported_in_a_moment() {
    assert_eq!(codes(&lines(50_000, |i| format!("p{i}: Real = )"))), ["expected-expression"]);
}
#[test]
fn many_lists_are_read_in_a_moment() {
    let text = lines(5_000, |i| format!("class C{i} {{ x: List of 1 C{} }}", i + 1));
    assert_eq!(codes(&text), ["unknown-class"]);
}
#[test]
fn a_name_of_a_megabyte_is_a_name() {
    let name = "n".repeat(1_000_000);
    assert_eq!(codes(&format!("{name}: Real = {}m", &name[1..])), ["unknown-name"]);
    assert_eq!(codes(&format!("a: {name}\nclass {name}m {{ }}")), ["unknown-class"]);
}
#[test]
fn a_deep_body_is_refused() {
    let text = format!("{}{}", "a: Object { ".repeat(10_000), "}".repeat(10_000));
    assert!(!codes(&text).is_empty());
}
#[test]
fn deep_brackets_are_refused() {
    let text = format!("a: Real = {}1{}", "(".repeat(10_000), ")".repeat(10_000));
    assert!(!codes(&text).is_empty());
}
#[test]
fn a_long_sum_is_read_or_refused() {
    codes(&format!("a: Real = 1{}", " + 1".repeat(100_000)));
}
#[test]
fn a_class_that_is_its_own_element_is_refused() {
    assert_eq!(codes("class A { xs: List of 2 A }\na: A"), ["endless-parts"]);
    assert_eq!(codes("class A { b: B }\nclass B { xs: List of 2 A }\na: A"), ["endless-parts"]);
}
#[test]
fn things_that_double_at_every_class_are_too_many() {
    let text = lines(40, |i| format!("class C{} {{ a, b: C{i} }}", i + 1));
    let text = format!("class C0 {{ x: Real }}\n{text}c: C40");
    assert_eq!(codes(&text), ["too-many-things"]);
}
#[test]
fn a_billion_turns_are_too_many() {
    assert_eq!(codes("for i in 0..1000000000 { constraint 1 = 1 }"), ["too-many-members"]);
    let nested = "for i in 0..99 { for j in 0..99 { for k in 0..99 { for l in 0..99 { constraint 1 = 1 } } } }";
    assert_eq!(codes(nested), ["too-many-members"]);
    let pairs = "for i in 0..1000 { for a, b in (0..900000).zip(0..900000) { constraint 1 = 1 } }";
    assert_eq!(codes(pairs), ["too-many-members"]);
}
#[test]
fn a_list_of_a_billion_is_too_long() {
    assert_eq!(codes("xs: List of 1000000000 Real"), ["too-many-things"]);
    assert_eq!(codes("xs: List of 5000000 Real"), ["too-many-things"]);
    assert_eq!(codes("xs: List of 99999999999 Real"), ["too-many-things"]);
    let twice = "xs: List of 3000000 Real\nys: List of 3000000 Real";
    assert_eq!(codes(twice), ["too-many-things"]);
}
#[test]
fn turns_are_counted_before_any_is_taken() {
    for count in [4_294_967_295_u32, 1_000_000_000, 4_500_001] {
        let text = format!("xs: List of {count} Real\nfor x in xs {{ constraint x = 1 }}");
        assert_eq!(codes(&text), ["too-many-things"], "{text}");
        let text = format!("xs: List of {count} Real\nfor a, b in xs.neighbours {{ merge a = b }}");
        assert_eq!(codes(&text), ["too-many-things"], "{text}");
    }
    let text = "xs: List of 1500000 Real\nfor x in xs { constraint x = 1 }";
    assert!(codes(text).contains(&"too-many-members"));
    for last in ["4294967295", "8000000000000000", "1000000"] {
        let text = format!("for i in 0..{last} {{ p: Real = i  constraint p = i }}");
        assert_eq!(codes(&text), ["too-many-members"], "{text}");
    }
}
#[test]
fn rings_of_merges_are_one_part() {
    let parts = lines(300, |i| format!("p{i}: Real"));
    let merges = lines(300, |i| format!("merge p{i} = p{}", (i + 1) % 300));
    assert_eq!(codes(&format!("{parts}{merges}")), [""; 0]);
}
#[test]
fn superclasses_by_two_routes_are_looked_up_once() {
    let text = lines(64, |i| {
        format!(
            "class A{} is A{i} as a, B{i} as b {{ }}\nclass B{} is A{i} as a, B{i} as b {{ }}",
            i + 1,
            i + 1
        )
    });
    let text = format!(
        "class A0 {{ x: Real }}\nclass B0 {{ y: Real }}\n{text}class C is A64 {{ constraint x = nowhere }}"
    );
    assert!(codes(&text).contains(&"unknown-name"));
}
#[test]
fn a_long_line_of_superclasses_is_followed() {
    let line = |n: usize| lines(n, |i| format!("class C{i} is C{} {{ p{i}: Real }}", i + 1));
    let text = line(1_000);
    assert_eq!(codes(&format!("{text}class C1000 {{ x: Real }}\nc: C0 {{ x = 1 }}")), [""; 0]);
    assert_eq!(codes(&format!("{text}class C1000 is C0 {{ }}")), ["superclass-cycle"]);
    // what all of them together inherit grows with the square
    let longer = line(3_000);
    assert_eq!(codes(&format!("{longer}class C3000 {{ x: Real }}")), ["too-many-superclasses"]);
}
#[test]
fn a_long_line_of_messages_is_followed() {
    let text = lines(5_000, |i| format!("m{i} => m{} + 1", i + 1));
    assert_eq!(codes(&format!("{text}m5000 => 1")), [""; 0]);
    let deep = lines(300, |i| format!("m{i} => {}m{}{}", "(".repeat(150), i + 1, ")".repeat(150)));
    assert_eq!(codes(&format!("{deep}m300 => 1")), [""; 0]);
}
#[test]
fn messages_in_a_ring_are_read() {
    codes("a => b + 1\nb => a + 1\nc: Real\nconstraint c = a");
}
#[test]
fn files_that_use_one_another_are_read_once() {
    let load = |name: &str| {
        Some(format!(
            "use {}\nclass {} {{ }}",
            if name == "a" { "b" } else { "a" },
            name.to_uppercase()
        ))
    };
    let lowered = lower("use a\nx: A\ny: B", &load, None);
    assert_eq!(lowered.files.iter().filter(|(_, f)| !f.name.is_empty()).count(), 2);
    assert_eq!(
        lowered.document.classes[lowered.document.root]
            .parts
            .iter()
            .filter(|p| *p.name == *"x" || *p.name == *"y")
            .count(),
        2
    );
}
#[test]
fn numbers_beyond_all_bounds_are_refused() {
    for text in
        ["a: Real = 1e999", "a: Length = 1e308 km", "a: Real = -1e999", "a: Real = [1e999][0]"]
    {
        assert_eq!(codes(text), ["too-large"], "{text}");
    }
    codes("a: Real = 1 / 0\nb: List of 1/0 Real\nfor i in 0..1/0 { c: Real }");
}

/// Pieces of which texts are made that look like documents.
const TOKENS: &[&str] = &[
    "class ",
    "A",
    "B",
    "Point",
    "Real",
    "Length",
    "List of ",
    "Set of ",
    "3 ",
    "1e999 ",
    "2 mm ",
    "{ ",
    " }",
    "(",
    ")",
    "[",
    "]",
    ": ",
    " = ",
    " => ",
    " := ",
    ", ",
    ".",
    "..",
    " + ",
    " - ",
    " * ",
    " / ",
    " ^ ",
    " < ",
    " <= ",
    "x",
    "y",
    "p1",
    "owner",
    "super",
    "constraint ",
    "merge ",
    "stay ",
    "anchor ",
    "insert ",
    " into ",
    "for i in ",
    "check \"c\" { ",
    "expect ",
    "set ",
    " to ",
    "move ",
    "try ",
    "if ",
    " then ",
    " else ",
    "let ",
    " in ",
    "without ",
    "unit mm\n",
    "y down\n",
    "use geometry\n",
    "\"text\"",
    "true",
    "not ",
    " and ",
    " is ",
    " as ",
    "sum",
    "sqrt(",
    "\n",
    "\n",
    "\n",
    ";",
    "// words\n",
    "/// words\n",
    "weak ",
    "reads ",
    "...",
    "default ",
    "é",
    "∞",
    "abs(x)",
    ".text",
    ".last",
    ".sum",
];

fn soup() -> impl Strategy<Value = String> {
    prop::collection::vec(prop::sample::select(TOKENS), 0..120).prop_map(|t| t.concat())
}

/// The documents of the gallery and the library.
fn documents() -> Vec<String> {
    let mut texts = Vec::new();
    for folder in ["gallery", "library"] {
        let entries = fs::read_dir(root().join(folder)).expect("the folder is there");
        let mut paths: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
        paths.sort();
        let documents = paths.into_iter().filter(|p| p.extension().is_some_and(|e| e == "thing"));
        texts.extend(documents.map(|p| fs::read_to_string(p).expect("a document can be read")));
    }
    texts
}

/// A document with some of its pieces taken away, doubled, or put in another place.
fn mutated() -> impl Strategy<Value = (String, String)> {
    let change = (any::<prop::sample::Index>(), 0_usize..30, 0_u8..3, prop::sample::select(TOKENS));
    (prop::sample::select(documents()), prop::collection::vec(change, 1..8)).prop_map(
        |(text, changes)| {
            let mut letters: Vec<char> = text.chars().collect();
            for (at, length, what, token) in changes {
                let from = at.index(letters.len() + 1);
                let to = (from + length).min(letters.len());
                let piece: Vec<char> = match what {
                    0 => Vec::new(),
                    1 => letters[from..to].repeat(2),
                    _ => token.chars().collect(),
                };
                letters.splice(from..to, piece);
            }
            (text, letters.into_iter().collect())
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_letters_are_read(text in "\\PC{0,300}") {
        codes(&text);
    }
    #[test]
    fn any_tokens_are_read(text in soup()) {
        codes(&text);
    }
    #[test]
    fn a_damaged_document_keeps_what_it_can((text, damaged) in mutated()) {
        codes(&damaged);
        let before = lower(&text, &library, None);
        let after = lower(&damaged, &library, Some(&before));
        assert_in_text(&after);
        let (structure, _) = kernel::instantiate(&after.document);
        prop_assert!(kernel::check::structure(&after.document, &structure).is_ok());
    }
}
