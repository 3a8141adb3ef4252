//! The order of a document's members plays no part: parts, constraints and merges are written in one order and
//! in others, are edited alike, and come to the same values for the same reasons. Where numbers determine one
//! another, that is to the last bit of what is computed by formula; sums over several given numbers that yield
//! together differ by rounding.
//!
//! What order does decide, by definition, is which of several places yields and under which path a merged part is
//! shown. `THINGLAB_LONG` tries more.

use base::Dice;
use session::{Command, DocumentId, Host, Literal, Session};
use std::fmt::Write as _;

/// How far numbers of two orders may lie apart where several are found together.
const ROUNDING: f64 = 1e-9;

const CLASSES: &str = "class Cell { inner: Real  outer: Real  gain: Real = 2\n\
    constraint turn: outer = gain * inner + 1 }\n";

struct NoFiles;

impl Host for NoFiles {
    fn read(&self, _: &str) -> Option<String> {
        None
    }
}

/// Returns a number from one to four, in hundredths.
fn number(dice: &mut Dice) -> f64 {
    1.0 + dice.below(301) as f64 / 100.0
}

/// A document of cells in a net, what is computed from them, and what is read.
#[derive(Default)]
struct Net {
    members: Vec<String>,
    given: Vec<String>,
    computed: Vec<String>,
}

impl Net {
    fn new(dice: &mut Dice) -> Self {
        let mut net = Self::default();
        net.say(format!("source: Real = {}", number(dice)));
        net.given.push("source".into());
        let cells = 2 + dice.below(5);
        for i in 0..cells {
            net.say(format!("c{i}: Cell {{ gain = {} }}", number(dice)));
            net.given.push(format!("c{i}.gain"));
            net.computed.push(format!("c{i}.outer"));
            let from = match dice.below(i + 1) {
                0 => "source".into(),
                j => format!("c{}.outer", j - 1),
            };
            net.say(format!("merge c{i}.inner = {from}"));
        }
        let cell = |dice: &mut Dice| format!("c{}.outer", dice.below(cells));
        for k in 0..dice.below(3) {
            // two lines that meet
            net.say(format!("p{k}: Real"));
            net.say(format!("q{k}: Real"));
            net.say(format!("constraint p{k} + 2 * q{k} = {}", cell(dice)));
            net.say(format!("constraint {} * p{k} - q{k} = {}", number(dice), cell(dice)));
            net.computed.extend([format!("p{k}"), format!("q{k}")]);
        }
        net.say("total: Real".into());
        let sum: Vec<String> = (0..cells).map(|i| format!("c{i}.outer")).collect();
        net.say(format!("constraint total = {}", sum.join(" + ")));
        net.computed.push("total".into());
        // under which of its paths a merged part is shown is decided by order: all is read by parts of their own
        let read: Vec<String> = net.computed.iter().chain(&net.given).cloned().collect();
        for (i, path) in read.into_iter().enumerate() {
            net.say(format!("read{i} => {path}"));
        }
        net
    }
    fn say(&mut self, member: String) {
        self.members.push(member);
    }
    fn text(&self) -> String {
        format!("{CLASSES}{}\n", self.members.join("\n"))
    }
}

/// What is read in a state: every value and why it is so, apart from the names and the order of the steps.
fn read(session: &Session, id: DocumentId, net: &Net) -> Result<Vec<(f64, Vec<String>)>, String> {
    let rows = session.values(id);
    let one = |(i, of): (usize, &String)| {
        let row = rows.iter().find(|row| row.path == format!("read{i}"));
        let number = row.and_then(|row| row.number).ok_or_else(|| format!("{of} is not there"))?;
        let path = session::parse_path(of).expect("a path");
        let mut why = Vec::new();
        for step in session.explain(id, Some(&path)).steps {
            // equations that are solved together are told in order of declaration
            let mut rules: Vec<&str> = step.formula.lines().collect();
            rules.sort_unstable();
            why.push(format!("{}: {}", step.method, rules.join(", ")));
        }
        why.sort();
        Ok((number, why))
    };
    net.computed.iter().enumerate().map(one).collect()
}

/// Compares documents of one net; returns how many values were compared.
///
/// # Errors
/// What is different.
fn run(seed: u64) -> Result<usize, String> {
    const ORDERS: usize = 3;
    let mut dice = Dice::new(seed);
    let mut net = Net::new(&mut dice);
    let mut session = Session::new(Box::new(NoFiles));
    let mut ids = Vec::new();
    let mut texts = String::new();
    for order in 0..ORDERS {
        ids.push(session.open(&format!("order{order}"), &net.text()));
        writeln!(texts, "--- order {order}\n{}", net.text()).expect("a string");
        dice.shuffle(&mut net.members);
    }
    let mut compared = 0;
    // of what is set, given numbers first: what is computed is then set to where given ones have to yield
    let mut edits: Vec<String> =
        (0..3).map(|_| net.given[dice.below(net.given.len())].clone()).collect();
    edits.push("total".into());
    for step in 0..=edits.len() {
        let told = |what: String| format!("{what} after {:?}\n{texts}", &edits[..step]);
        let all = ids.iter().map(|&id| read(&session, id, &net)).collect::<Result<Vec<_>, _>>();
        let all = all.map_err(told)?;
        let by_formula = |name: &str| name.starts_with('c') || name == "total";
        for (order, other) in all.iter().enumerate().skip(1) {
            for ((a, b), name) in all[0].iter().zip(other).zip(&net.computed) {
                let is_same = if step < edits.len() && by_formula(name) {
                    a.0.to_bits() == b.0.to_bits()
                } else {
                    (a.0 - b.0).abs() <= ROUNDING * a.0.abs().max(1.0)
                };
                if !is_same {
                    return Err(told(format!("{name} is {} and in order {order} {}", a.0, b.0)));
                }
                if a.1 != b.1 {
                    let why = format!("{:#?}\nand in order {order} {:#?}", a.1, b.1);
                    return Err(told(format!("{name} is explained by {why}")));
                }
                compared += 1;
            }
        }
        let Some(name) = edits.get(step) else { break };
        let by = number(&mut dice) / 2.0;
        let path = session::parse_path(name).expect("a path");
        for &id in &ids {
            let mut read = net.computed.iter().chain(&net.given);
            let index = read.position(|path| path == name).expect("it is read");
            let rows = session.values(id);
            let row = rows.iter().find(|row| row.path == format!("read{index}"));
            let now = row.and_then(|row| row.number);
            let set = Literal::Number(now.unwrap_or(1.0) + by);
            let made = session.apply(id, &Command::Set(vec![(path.clone(), set)]));
            made.map_err(|refusal| told(format!("{name} cannot be set: {}", refusal.message)))?;
        }
    }
    Ok(compared)
}

#[test]
fn the_order_of_members_plays_no_part() {
    let seeds = if std::env::var_os("THINGLAB_LONG").is_some() { 2000 } else { 40 };
    let (mut compared, mut wrong) = (0, Vec::new());
    for seed in 0..seeds {
        match run(seed) {
            Ok(count) => compared += count,
            Err(told) => wrong.push(format!("seed {seed}: {told}")),
        }
    }
    let shown: Vec<&str> = wrong.iter().take(3).map(String::as_str).collect();
    assert!(wrong.is_empty(), "{} of {seeds}\n{}", wrong.len(), shown.join("\n\n"));
    assert!(compared > 40 * seeds as usize, "{compared} values were compared");
}

/// Reads where a place came to that is as far as two distances say from two others.
fn third(members: [&str; 2]) -> [f64; 2] {
    let mut session = Session::new(Box::new(NoFiles));
    let members = members.join("\n");
    let id = session.open("third", &format!("class Spot {{ x, y: Real }}\nc: Spot\n{members}\n"));
    let rows = session.values(id);
    ["c.x", "c.y"].map(|path| {
        rows.iter().find(|row| row.path == path).and_then(|row| row.number).expect("it is there")
    })
}

#[test]
fn a_start_between_two_solutions_takes_the_same_in_every_order() {
    let a = "constraint sqrt(c.x ^ 2 + c.y ^ 2) = 6";
    let b = "constraint sqrt((c.x - 10) ^ 2 + c.y ^ 2) = 7";
    // 6² - x² = 7² - (10 - x)²; of the two above and below the one in which y grows
    let y = base::number::sqrt(36.0 - 4.35 * 4.35);
    for members in [[a, b], [b, a]] {
        let [x_found, y_found] = third(members);
        let off = (x_found - 4.35).abs().max((y_found - y).abs());
        assert!(off < ROUNDING, "{members:?}: {x_found}, {y_found}");
    }
}
