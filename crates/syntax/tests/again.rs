//! Parsing an edited text again gives what parsing it anew gives.

use base::{Dice, FileId};
use std::fs;
use std::path::PathBuf;
use syntax::{Changed, Parse, Reparsed, parse, reparse};

/// What a hand types, right and wrong.
const TYPED: [&str; 24] = [
    "x",
    " ",
    "\n",
    "{",
    "}",
    "(",
    ")",
    "\"",
    "// ",
    "/* ",
    " */",
    "/// said\n",
    "1",
    "mm",
    " = 3",
    "+ 2",
    ";",
    "\nextra: Real = 7\n",
    "\nmerge a = b\n",
    "constraint ",
    " of ",
    ": Widget ",
    "\nclass C is D { a: Real }\n",
    "é",
];

fn texts() -> Vec<String> {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let folders =
        [here.join("tests/language"), here.join("../../gallery"), here.join("../../library")];
    let files = folders.iter().flat_map(|f| fs::read_dir(f).expect("the folder is there"));
    let mut paths: Vec<PathBuf> = files.map(|f| f.expect("it can be listed").path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "thing"));
    paths.sort();
    let long: String = (0..40).map(|i| format!("w{i}: Widget {{ left = {i} }}\n")).collect();
    let read = paths.iter().map(|p| fs::read_to_string(p).expect("it can be read"));
    read.chain([long]).collect()
}

fn edited(dice: &mut Dice, text: &str) -> String {
    let mut ends: Vec<usize> = text.char_indices().map(|(i, _)| i).collect();
    ends.push(text.len());
    let from = dice.below(ends.len());
    // mostly a little is replaced, now and then much
    let most = if dice.below(6) == 0 { 400 } else { 4 };
    let to = (from + dice.below(most)).min(ends.len() - 1);
    let typed = if dice.below(4) == 0 { "" } else { TYPED[dice.below(TYPED.len())] };
    format!("{}{typed}{}", &text[..ends[from]], &text[ends[to]..])
}

/// Parses an edited text again, and holds it against parsing it anew.
fn again(known: &Parse, before: &str, after: &str) -> Reparsed {
    let file = FileId(0);
    let again = reparse(file, known, before, after);
    let anew = parse(file, after);
    assert!(again.parse == anew, "{before:?}\nbecame\n{after:?}\n{:#?}", again.parse.syntax());
    // what is not told to be another member is the member that it was
    let (was, is): (Vec<_>, Vec<_>) = (known.outline().collect(), anew.outline().collect());
    let whole = Changed { before: was.len()..was.len(), after: is.len()..is.len(), shift: 0 };
    let (mut at, mut shift) = ((0, 0), 0);
    for Changed { before: gone, after: new, shift: next } in again.changed.iter().chain([&whole]) {
        let kept = was[at.0..gone.start].iter().zip(&is[at.1..new.start]);
        assert_eq!(gone.start - at.0, new.start - at.1, "{before:?}\nbecame\n{after:?}");
        for ((kind, span), (kind_now, span_now)) in kept {
            assert_eq!(
                (kind, i64::from(span.start) + shift),
                (kind_now, i64::from(span_now.start))
            );
            assert_eq!(before[span.range()], after[span_now.range()]);
        }
        (at, shift) = ((gone.end, new.end), *next);
    }
    again
}

#[test]
fn any_edit_gives_the_tree_of_its_text() {
    let mut dice = Dice::new(1);
    let mut right = 0;
    for text in texts() {
        let known = parse(FileId(0), &text);
        for _ in 0..100 {
            let (mut before, mut tree) = (text.clone(), known.clone());
            for _ in 0..1 + dice.below(4) {
                let after = edited(&mut dice, &before);
                let again = again(&tree, &before, &after).parse;
                right += usize::from(again.diagnostics().is_empty());
                (before, tree) = (after, again);
            }
        }
    }
    assert!(right > 1000, "{right} edited texts have no errors");
}

#[test]
fn members_that_an_edit_does_not_touch_keep_their_nodes() {
    let text: String = (0..40).map(|i| format!("w{i}: Widget {{ left = {i} }}\n")).collect();
    let known = parse(FileId(0), &text);
    let after = text.replace("left = 20", "left = 21").replace("w30: Widget { left = 30 }\n", "");
    let again = again(&known, &text, &after);
    let changed = [
        Changed { before: 20..21, after: 20..21, shift: 0 },
        Changed { before: 30..31, after: 30..30, shift: -26 },
    ];
    assert_eq!(again.changed, changed);
    let pointers = |p: &Parse| -> Vec<usize> {
        let nodes =
            p.syntax().children().map(|n| n.green().as_ref() as *const _ as *const u8 as usize);
        nodes.collect()
    };
    let (was, is) = (pointers(&known), pointers(&again.parse));
    assert_eq!([&was[..20], &was[21..30], &was[31..]], [&is[..20], &is[21..30], &is[30..]]);
}

#[test]
fn edits_in_many_places_give_the_tree_of_their_text() {
    let line = |i: usize| format!("w{i}: Widget {{ left = {i} }}\n");
    let lines: Vec<String> =
        (0..400).map(line).chain(["merge w3.left = w390.left\n".into()]).collect();
    let text = lines.concat();
    let known = parse(FileId(0), &text);
    let mut dice = Dice::new(7);
    let (mut right, mut apart) = (0, 0);
    for _ in 0..300 {
        let mut lines = lines.clone();
        // now and then too many to be told apart
        for _ in 0..[1, 2, 3, 8, 90][dice.below(5)] {
            let at = dice.below(lines.len());
            lines[at] = match dice.below(3) {
                0 => String::new(),
                1 => format!("{}v{at}: Real = 3\n", lines[at]),
                _ => edited(&mut dice, &lines[at]),
            };
        }
        let again = again(&known, &text, &lines.concat());
        right += usize::from(again.parse.diagnostics().is_empty());
        apart += usize::from(again.changed.len() > 2);
    }
    assert!(right > 60, "{right} edited texts have no errors");
    assert!(apart > 60, "{apart} were changed in more than two places");
}
