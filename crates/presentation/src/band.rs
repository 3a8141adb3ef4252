//! What a band that is drawn over the picture selects.
//!
//! Drawn to the right it takes what lies wholly in it, drawn to the left also what it crosses. A thing of the document
//! is taken as a whole where it can be; else the parts of it that can.

use drawing::{Bounds, Drawing, Element, Point, Shape, bounds};
use session::view::PictureView;
use std::collections::{BTreeMap, BTreeSet};

/// Which things a band takes.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Take {
    /// Those that lie in it as a whole.
    Within,
    /// Those that it touches as well.
    Crossed,
}

/// Returns the paths of what lies in a band between two corners on the sheet, each whole once, in order of the picture.
pub fn banded(picture: &PictureView, (a, b): (Point, Point), take: Take) -> Vec<String> {
    let band = Bounds {
        least: Point { x: a.x.min(b.x), y: a.y.min(b.y) },
        most: Point { x: a.x.max(b.x), y: a.y.max(b.y) },
    };
    let drawn = picture.drawing.elements.iter().filter_map(|element| {
        let path = picture.paths.get(element.tag.0 as usize)?;
        (!path.is_empty()).then(|| (path.as_str(), within(&band, element), crossed(&band, element)))
    });
    let held = picture.grips.iter().map(|grip| {
        let inside = contains(&band, Point { x: grip.x, y: grip.y });
        (grip.path.as_str(), inside, inside)
    });
    let seen: Vec<Seen<'_>> = drawn.chain(held).collect();
    let mut found: Vec<String> = Vec::new();
    match take {
        Take::Within => wholes(&seen, 0, &mut found),
        Take::Crossed => {
            let mut known = BTreeSet::new();
            for (path, _, _) in seen.iter().filter(|(_, _, crossed)| *crossed) {
                let whole = up_to(path, 0);
                if known.insert(whole) {
                    found.push(String::from(whole));
                }
            }
        }
    }
    found
}

/// What a band was compared with: its path, whether it lies in the band, and whether that touches it.
type Seen<'a> = (&'a str, bool, bool);

/// Adds the things of a depth that lie in the band; of the others, those of their parts that do.
fn wholes(seen: &[Seen<'_>], depth: usize, found: &mut Vec<String>) {
    let mut places = BTreeMap::new();
    let mut things: Vec<(&str, Vec<Seen<'_>>)> = Vec::new();
    for &part in seen {
        let whole = up_to(part.0, depth);
        let place = *places.entry(whole).or_insert(things.len());
        if place == things.len() {
            things.push((whole, Vec::new()));
        }
        things[place].1.push(part);
    }
    for (whole, parts) in things {
        if parts.iter().all(|(_, within, _)| *within) {
            found.push(String::from(whole));
        } else {
            let is_deeper = |(path, ..): &Seen<'_>| up_to(path, depth + 1) != whole;
            let deeper: Vec<Seen<'_>> = parts.into_iter().filter(is_deeper).collect();
            if deeper.iter().any(|(_, within, _)| *within) {
                wholes(&deeper, depth + 1, found);
            }
        }
    }
}

/// The first steps of a path, one more than a depth; a numbered element counts with its list.
fn up_to(path: &str, depth: usize) -> &str {
    path.match_indices('.').nth(depth).map_or(path, |(at, _)| &path[..at])
}

fn contains(band: &Bounds, p: Point) -> bool {
    (band.least.x..=band.most.x).contains(&p.x) && (band.least.y..=band.most.y).contains(&p.y)
}

fn around(element: &Element) -> Bounds {
    bounds(&Drawing { elements: vec![element.clone()], ..Drawing::default() })
        .unwrap_or(Bounds { least: Point { x: 0.0, y: 0.0 }, most: Point { x: 0.0, y: 0.0 } })
}

fn within(band: &Bounds, element: &Element) -> bool {
    let own = around(element);
    !element.style.is_unbounded && contains(band, own.least) && contains(band, own.most)
}

/// Whether something of an element lies in the band: of a segment exactly, of anything else the box around it.
fn crossed(band: &Bounds, element: &Element) -> bool {
    if let Shape::Segment(a, b) = element.shape {
        return meets(band, a, b);
    }
    let own = around(element);
    own.least.x <= band.most.x
        && own.most.x >= band.least.x
        && own.least.y <= band.most.y
        && own.most.y >= band.least.y
}

/// Whether a segment meets a box: what is left of it between the box's sides, one direction after the other.
fn meets(band: &Bounds, a: Point, b: Point) -> bool {
    let mut left = (0.0_f64, 1.0_f64);
    let ways = [(a.x, b.x, band.least.x, band.most.x), (a.y, b.y, band.least.y, band.most.y)];
    for (from, to, least, most) in ways {
        let far = to - from;
        if far == 0.0 {
            if !(least..=most).contains(&from) {
                return false;
            }
            continue;
        }
        let (one, other) = ((least - from) / far, (most - from) / far);
        left = (left.0.max(one.min(other)), left.1.min(one.max(other)));
    }
    left.0 <= left.1
}

#[cfg(test)]
mod tests {
    use super::{Take, banded};
    use drawing::{Drawing, Element, Layer, Point, Shape, Style, Tag};
    use session::view::{Grip, PictureView};

    const AT: fn(f64, f64) -> Point = |x, y| Point { x, y };

    /// Two lines of one thing, and a circle.
    fn picture() -> PictureView {
        let shapes = [
            Shape::Segment(AT(0.0, 0.0), AT(10.0, 0.0)),
            Shape::Segment(AT(10.0, 0.0), AT(10.0, 50.0)),
            Shape::Circle { center: AT(30.0, 5.0), radius: 4.0 },
        ];
        let element = |(tag, shape)| Element {
            shape,
            style: Style::default(),
            layer: Layer::Lines,
            tag: Tag(tag),
        };
        let grip = |path: &str, x, y| Grip { path: String::from(path), x, y, ..Grip::default() };
        PictureView {
            drawing: Drawing {
                elements: (0..).zip(shapes).map(element).collect(),
                ..Drawing::default()
            },
            paths: ["q.south", "q.east", "k"].map(String::from).to_vec(),
            freedom: vec![None; 3],
            grips: vec![grip("q.south.p1", 0.0, 0.0), grip("k.center", 30.0, 5.0)],
            ..PictureView::default()
        }
    }

    #[test]
    fn what_lies_in_the_band_is_taken_as_a_whole_or_by_its_parts() {
        let taken = |to| banded(&picture(), (AT(-2.0, -2.0), to), Take::Within);
        assert_eq!(taken(AT(40.0, 60.0)), ["q", "k"]);
        assert_eq!(taken(AT(40.0, 20.0)), ["q.south", "k"]);
        assert_eq!(taken(AT(5.0, 20.0)), ["q.south.p1"]);
        assert!(taken(AT(-1.0, -1.0)).is_empty());
    }

    #[test]
    fn a_band_around_thousands_takes_each_once() {
        let mut picture = picture();
        let line = picture.drawing.elements[0].clone();
        let many = 20_000_u32;
        picture.drawing.elements =
            (0..many).map(|i| Element { tag: Tag(i), ..line.clone() }).collect();
        picture.paths = (0..many).map(|i| format!("lines[{i}]")).collect();
        picture.grips.clear();
        let taken = banded(&picture, (AT(-2.0, -2.0), AT(40.0, 60.0)), Take::Within);
        assert_eq!(taken, picture.paths);
    }

    #[test]
    fn drawn_to_the_left_it_takes_what_it_crosses() {
        let taken = |from, to| banded(&picture(), (from, to), Take::Crossed);
        assert_eq!(taken(AT(32.0, 40.0), AT(5.0, 3.0)), ["q", "k"]);
        assert_eq!(taken(AT(9.0, 40.0), AT(5.0, 3.0)), Vec::<String>::new());
    }
}
