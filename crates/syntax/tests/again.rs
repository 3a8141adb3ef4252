//! Parsing an edited text again gives what parsing it anew gives.

use base::FileId;
use std::fs;
use std::path::PathBuf;
use syntax::{parse, reparse};

/// Numbers that depend on nothing but the seed.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 33) as usize % n
    }
}

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

#[test]
fn any_edit_gives_the_tree_of_its_text() {
    let file = FileId(0);
    let mut dice = Dice(1);
    let mut right = 0;
    for text in texts() {
        let known = parse(file, &text);
        for _ in 0..100 {
            let (mut before, mut tree) = (text.clone(), known.clone());
            for _ in 0..1 + dice.below(4) {
                let after = edited(&mut dice, &before);
                let again = reparse(file, &tree, &before, &after);
                let anew = parse(file, &after);
                assert!(again == anew, "{before:?}\nbecame\n{after:?}\n{:#?}", again.syntax());
                right += usize::from(anew.diagnostics().is_empty());
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
    let after = text.replace("left = 20", "left = 21");
    let again = reparse(FileId(0), &known, &text, &after);
    assert_eq!(again, parse(FileId(0), &after));
    let pointers = |p: &syntax::Parse| -> Vec<usize> {
        let nodes =
            p.syntax().children().map(|n| n.green().as_ref() as *const _ as *const u8 as usize);
        nodes.collect()
    };
    let (was, is) = (pointers(&known), pointers(&again));
    let kept = was.iter().zip(&is).filter(|(a, b)| a == b).count();
    assert_eq!(kept, 40 - 5, "the member and two on either side are parsed");
}

#[test]
fn edits_far_apart_give_the_tree_of_their_text() {
    let line = |i: usize| format!("w{i}: Widget {{ left = {i} }}\n");
    let text: String = (0..400).map(line).chain(["merge w3.left = w390.left\n".into()]).collect();
    let known = parse(FileId(0), &text);
    let mut dice = Dice(7);
    let mut right = 0;
    for _ in 0..300 {
        let (first, second) = text.split_at(text.len() / 2);
        let after = edited(&mut dice, first) + &edited(&mut dice, second);
        let (again, anew) = (reparse(FileId(0), &known, &text, &after), parse(FileId(0), &after));
        assert!(again == anew, "became\n{after}");
        right += usize::from(anew.diagnostics().is_empty());
    }
    assert!(right > 20, "{right} edited texts have no errors");
    let after = text.replace("left = 3 ", "left = 47 ").replace("merge w3.left = w390.left\n", "");
    let again = reparse(FileId(0), &known, &text, &after);
    assert_eq!(again, parse(FileId(0), &after));
    assert_eq!(again.shared(&known), (3, 0));
    assert_eq!(again.shared_behind(&known, 3), 396);
}
