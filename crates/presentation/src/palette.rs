//! The palette: what has the words that are wanted, of actions, things, constructions, classes and documents.

use crate::find::has_words;
use session::drafting::view::ConstructionRow;
use session::view::{RowKind, StructureRow};

/// An action: itself, its name, its label.
pub type Named<A> = (A, &'static str, &'static str);

/// A document that the server offers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Listed {
    /// Its path: `gallery/quadrilateral.thing`.
    pub path: String,
    /// What it is called.
    pub title: String,
    /// Whether it comes from the gallery.
    pub in_gallery: bool,
}

/// A class that things can be made of.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Makeable {
    /// Its name.
    pub class: String,
    /// The library that has it, where the document does not use that yet.
    pub unused: Option<String>,
}

/// Finds what somebody means who types the name of a class and looks no further: what is called so, else what begins
/// so, else the only one there is; what is in use comes first each time.
pub fn called<'m>(all: &'m [Makeable], typed: &str) -> Option<&'m Makeable> {
    let typed = typed.trim().to_lowercase();
    let by = |is_it: &dyn Fn(&str) -> bool| {
        let mut ones = all.iter().filter(|one| is_it(&one.class.to_lowercase()));
        let first = ones.next()?;
        Some(std::iter::once(first).chain(ones).find(|one| one.unused.is_none()).unwrap_or(first))
    };
    let alone = |ones: &[&'m Makeable]| ones.first().copied().filter(|_| ones.len() == 1);
    let only = || {
        let used: Vec<&Makeable> = all.iter().filter(|one| one.unused.is_none()).collect();
        alone(&used).or_else(|| alone(&all.iter().collect::<Vec<_>>()))
    };
    by(&|class| class == typed).or_else(|| by(&|class| class.starts_with(&typed))).or_else(only)
}

/// What can be chosen.
#[derive(Clone, PartialEq, Debug)]
pub enum Choice<A> {
    /// An action.
    Do(A),
    /// A construction.
    Draw(ConstructionRow),
    /// A class of the bin, or of a library that is not used yet.
    Insert(Makeable),
    /// A thing of the shown document, by its path.
    Select(String),
    /// A document.
    Open(Listed),
}

/// What the shown document offers: its constructions, what things can be made of, and the paths of its things.
pub type Drawn = (Vec<ConstructionRow>, Vec<Makeable>, Vec<String>);

/// The paths of the things of a document that are found by name: its own, and what these have that has parts.
pub fn named_things(rows: &[StructureRow]) -> Vec<String> {
    let is_named = |row: &&StructureRow| {
        row.kind == RowKind::Part && (row.depth == 1 || row.depth == 2 && row.descendants > 0)
    };
    rows.iter().filter(is_named).map(|row| row.path.clone()).collect()
}

/// What has the words that are wanted in its label, where a word begins or within one; then what has them in its own name; then what has each of
/// them somewhere; then what has all their letters in order, the shortest first: an action in its label, a
/// document, whose title may be long, in its path.
///
/// Constructions and classes are found by pieces of words, not by scattered letters. Those whose name begins so come
/// before documents, others after what has the words in its label or name.
pub fn matching<A: Clone>(
    wanted: &str,
    actions: &[Named<A>],
    listed: &[Listed],
    (constructions, classes, things): &Drawn,
) -> Vec<Choice<A>> {
    let wanted = wanted.trim().to_lowercase();
    let rank = |label: &str, name: &str, short: &str| {
        let (label, name, short) =
            (label.to_lowercase(), name.to_lowercase(), short.to_lowercase());
        match () {
            () if has_word_with(&label, &wanted) => Some((0, 0)),
            () if label.contains(&wanted) => Some((0, 1)),
            () if name.contains(&wanted) => Some((1, 0)),
            () if wanted.split_whitespace().all(|word| label.contains(word)) => Some((2, 0)),
            () => scattered(&short, &wanted).then_some((3, short.len())),
        }
    };
    let action =
        |(action, id, label): &Named<A>| (rank(label, id, label), Choice::Do(action.clone()));
    // a title is a sentence, and may have any word in it: what is called so comes first
    let document = |one: &Listed| {
        let rank = rank(&one.title, &one.path, &one.path);
        (rank.map(|rank| rank.max((0, 2))), Choice::Open(one.clone()))
    };
    let has = |text: &str| !wanted.is_empty() && has_words(text, &wanted);
    let begins = |text: &str| match text.to_lowercase().starts_with(&wanted) {
        true => (0, 1),
        false => (2, 1),
    };
    let construction = |row: &ConstructionRow| {
        let text = [&row.label, row.also].join(" ");
        (has(&text).then(|| begins(&row.label)), Choice::Draw(row.clone()))
    };
    let class = |one: &Makeable| {
        let rank = has(&one.class).then(|| begins(&one.class));
        let rank = rank.or_else(|| has(&format!("place: {}", one.class)).then_some((2, 1)));
        let later = usize::from(one.unused.is_some());
        (rank.map(|(rank, place)| (rank, place + later)), Choice::Insert(one.clone()))
    };
    let thing = |path: &String| {
        let name = path.rsplit('.').next().unwrap_or(path);
        (has(path).then(|| begins(name)), Choice::Select(path.clone()))
    };
    let all = actions
        .iter()
        .map(action)
        .chain(things.iter().map(thing))
        .chain(constructions.iter().map(construction));
    let all = all.chain(classes.iter().map(class)).chain(listed.iter().map(document));
    let mut found: Vec<_> = all.filter_map(|(rank, choice)| Some((rank?, choice))).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, choice)| choice).collect()
}

/// Whether a word of a label begins so.
fn has_word_with(label: &str, wanted: &str) -> bool {
    let begins = |(at, _): (usize, &str)| {
        !label[..at].chars().next_back().is_some_and(char::is_alphanumeric)
    };
    label.match_indices(wanted).any(begins)
}

fn scattered(label: &str, wanted: &str) -> bool {
    let mut letters = label.chars();
    wanted.chars().all(|letter| letters.any(|found| found == letter))
}

#[cfg(test)]
mod tests {
    use super::{Choice, ConstructionRow, Listed, Makeable, Named, called, matching};

    /// Some of the page's.
    const ACTIONS: [Named<&str>; 15] = [
        ("new", "new", "New document"),
        ("open", "open", "Open a file of this machine"),
        ("save", "save", "Save"),
        ("undo", "undo", "Undo"),
        ("redo", "redo", "Redo"),
        ("explain", "explain", "Why is it so?"),
        ("recognise", "recognise", "What could it be parts of?"),
        ("delete", "delete", "Delete"),
        ("duplicate", "duplicate", "Duplicate"),
        ("copy", "copy", "Copy"),
        ("insert", "insert", "Insert from the bin"),
        ("fit", "fit", "Fit the picture"),
        ("zoom-in", "zoom-in", "Zoom in"),
        ("zoom-out", "zoom-out", "Zoom out"),
        ("theme", "theme", "Light, dark or as the system says"),
    ];

    fn makeable(class: &str, unused: Option<&str>) -> Makeable {
        Makeable { class: String::from(class), unused: unused.map(String::from) }
    }

    #[test]
    fn the_name_of_a_class_means_it_wherever_it_lies() {
        let all = [
            makeable("ConstantLengthLine", None),
            makeable("Constant", Some("calculator")),
            makeable("Times", Some("calculator")),
        ];
        let meant = |typed| called(&all, typed).map(|one| one.class.as_str());
        assert_eq!(meant("constant"), Some("Constant"));
        assert_eq!(meant("const"), Some("ConstantLengthLine"));
        // of what the words were found in, the only one in use, else the only one
        assert_eq!(meant("product"), Some("ConstantLengthLine"));
        let found = |from: usize| called(&all[from..], "product").map(|one| one.class.as_str());
        assert_eq!((found(1), found(2)), (None, Some("Times")));
    }

    #[test]
    fn the_palette_finds_by_words_before_letters() {
        let listed = [Listed {
            path: String::from("gallery/bridge.thing"),
            title: String::from("Bridge under load"),
            in_gallery: true,
        }];
        let row = ConstructionRow {
            id: String::from("Axis.equidistant(first,second)"),
            class: String::from("Axis"),
            label: String::from("Perpendicular bisector"),
            operands: String::from("first, second"),
            doc: String::new(),
            also: "mediator",
        };
        let drawn = (
            vec![row],
            [makeable("Resistor", None), makeable("Resistance", Some("circuits"))].into(),
            ["rocker", "frame.rocker"].map(String::from).into(),
        );
        assert_eq!(matching("", &ACTIONS, &listed, &drawn).len(), ACTIONS.len() + 1);
        let first = |wanted| match matching(wanted, &ACTIONS, &listed, &drawn).into_iter().next() {
            Some(Choice::Do(action)) => String::from(action),
            Some(Choice::Draw(row)) => row.id,
            Some(Choice::Insert(one)) => one.class,
            Some(Choice::Select(path)) => path,
            Some(Choice::Open(listed)) => listed.path,
            None => String::new(),
        };
        assert_eq!(first("zoom in"), "zoom-in");
        assert_eq!(first("place resistor"), "Resistor");
        assert_eq!(first("undo"), "undo");
        // at the beginning of a word before within one
        assert_eq!(first("in"), "insert");
        assert_eq!(first("do"), "new");
        assert_eq!(first("load bridge"), "gallery/bridge.thing");
        assert_eq!(first("under load"), "gallery/bridge.thing");
        assert_eq!(first("ftp"), "fit");
        assert_eq!(first("recog"), "recognise");
        assert_eq!(first("perpendicular bisector"), "Axis.equidistant(first,second)");
        assert_eq!(first("resist"), "Resistor");
        assert_eq!(first("resistance"), "Resistance");
        assert_eq!(first("brg"), "gallery/bridge.thing");
        // a thing of the document
        assert_eq!(first("rocker"), "rocker");
        assert_eq!(first("frame.ro"), "frame.rocker");
        // no piece of every word of a long title
        assert_eq!(first("bgeudload"), "");
        assert_eq!(first("qqq"), "");
    }
}
