//! Expressions read alone mean what they mean in the text.

use lang::{lower, read_alone};

const TEXT: &str = "class Spot { x: Real = 1  y: Real = 2  sum => x + y
    place: Spot => Spot(x: y, y: x) }
program Row(count: Integer in 1..9 = 3, from: Spot = (0, 0)) {
    first = Spot(x: 4, y: from.y)
    turns = repeat count times with at = first {
        spot = at.place
        next at = -1 * spot.x
    }
    if count > 2 { more = 3 } else { more = 4 }
}
choice Side { left, right }
side: Side = right
constant deep = 7
row: Row
spots: List of 3 Spot
";

#[test]
fn an_expression_alone_is_what_a_message_of_it_says() {
    let of_row = [
        "first.sum",
        "turns.last.spot",
        "turns[1].moved(by: from)",
        "more * count",
        "turns.count",
        "Spot(x: 3, y: more)",
    ];
    let of_document = [
        "row.first",
        "side",
        "deep + 2",
        "spots.map(s => s.sum)",
        "[spots[0], row.from]",
        "(1, 2)",
    ];
    let load = |_: &str| None;
    let lowered = lower(TEXT, &load, None);
    for (name, written, inside) in [("Row", &of_row[..], true), ("", &of_document[..], false)] {
        for text in written {
            let class = match inside {
                true => lowered.document.class_named(name).expect("it is declared"),
                false => lowered.document.root,
            };
            let line = format!("alone => {text}\n");
            let edited = match inside {
                true => TEXT.replace("    if count", &format!("    {line}    if count")),
                false => format!("{TEXT}{line}"),
            };
            let anew = lower(&edited, &load, None);
            let message = anew.document.classes[class].messages.iter();
            let message = message.clone().find(|m| *m.name == *"alone");
            let alone = read_alone(&lowered, class, &[(*text).into()]);
            let term = alone.terms[0].as_ref().ok();
            assert_eq!(term, message.map(|m| &*m.answer), "{text}: {:?}", alone.terms);
        }
    }
}

#[test]
fn what_is_wrong_with_an_expression_alone_is_said_of_it() {
    let lowered = lower(TEXT, &|_| None, None);
    let root = lowered.document.root;
    let texts = ["row.frist", "1 +", "deep + 1", "row.first.sum + side"].map(String::from);
    let alone = read_alone(&lowered, root, &texts);
    let said: Vec<_> = { alone.terms.iter() }
        .map(|term| {
            term.as_ref().err().and_then(|d| Some((d.first()?.code, d.first()?.place.file)))
        })
        .collect();
    assert_eq!(said[0], Some(("unknown-part", base::FileId(0))));
    assert!(said[1].is_some() && said[2].is_none() && said[3].is_some(), "{said:?}");
}
