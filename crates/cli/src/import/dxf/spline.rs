//! Splines: B-splines without weights up to degree 3, as the Bézier curves that they are, and others as they are.

use super::{Entity, Figure, Read, found};
use drawing::nurbs::Nurbs;
use drawing::{Point, spline};

/// Reads a SPLINE.
pub(super) fn curves(entity: &Entity<'_>, scale: f64, read: &mut Read) {
    let all = |code: i32| -> Vec<f64> {
        let numbers = entity.values.iter().filter(move |(c, _)| *c == code);
        numbers.filter_map(|(_, v)| v.trim().parse().ok()).filter(|x: &f64| x.is_finite()).collect()
    };
    let points = |code: i32| -> Vec<Point> {
        let (xs, ys) = (all(code), all(code + 10));
        xs.into_iter().zip(ys).map(|(x, y)| Point { x: scale * x, y: scale * y }).collect()
    };
    let (knots, poles, weights) = (all(40), points(10), all(41));
    let degree = entity.number(71).unwrap_or(3.0) as usize;
    let raised = [30, 31].into_iter().flat_map(all).any(|z| z != 0.0);
    if raised {
        read.notes.push("SPLINE that does not lie flat on the sheet".into());
        return;
    }
    let is_rational = weights.windows(2).any(|w| w[0] != w[1]);
    if !poles.is_empty() && (is_rational || degree > 3) {
        let weights = if is_rational { weights } else { vec![1.0; poles.len()] };
        match Nurbs::new(degree, knots, poles, weights) {
            Ok(curve) => read.found.push(found(Figure::Rational(curve))),
            Err(why) => read.notes.push(format!("SPLINE with {why}")),
        }
        return;
    }
    let curves = match (poles.is_empty(), points(11)) {
        // where only the places that it goes through are said
        (true, through) if through.len() > 1 => Some(spline::through(&through)),
        (true, _) => None,
        (false, _) => bezier(degree, &knots, &poles),
    };
    match curves {
        Some(poles) => read.found.push(found(Figure::Curves(poles))),
        None => read.notes.push("SPLINE without all of its numbers".into()),
    }
}

/// Returns the poles of the cubic Bézier curves that a B-spline of a degree up to 3 is: its knots are inserted until
/// each stands as often as the degree.
///
/// **Source:** Boehm, *Inserting new knots into B-spline curves*, Computer-Aided Design 12 (1980).
pub(super) fn bezier(degree: usize, knots: &[f64], poles: &[Point]) -> Option<Vec<Point>> {
    let n = poles.len();
    let is_sound = (1..=3).contains(&degree)
        && n > degree
        && knots.len() == n + degree + 1
        && knots.windows(2).all(|w| w[0] <= w[1])
        // where a knot inside stands more often the curve is torn
        && knots[degree + 1..n].windows(degree + 1).all(|w| w[0] < w[degree]);
    let (first, last) = (*knots.get(degree)?, *knots.get(n)?);
    if !is_sound || first >= last {
        return None;
    }
    let (mut knots, mut poles) = (knots.to_vec(), poles.to_vec());
    let mut inner: Vec<f64> = knots.iter().copied().filter(|t| first <= *t && *t <= last).collect();
    inner.dedup();
    for t in inner {
        while knots.iter().filter(|k| **k == t).count() < degree {
            insert(degree, &mut knots, &mut poles, t);
        }
    }
    // the curve runs between the ends of the domain alone
    let begin =
        knots.iter().position(|k| *k == first)? + knots.iter().filter(|k| **k == first).count();
    let from = begin - 1 - degree;
    let spans = {
        let mut all: Vec<f64> =
            knots.iter().copied().filter(|t| first <= *t && *t <= last).collect();
        all.dedup();
        all.len() - 1
    };
    let own = poles.get(from..=from + degree * spans)?;
    let mut cubic = vec![own[0]];
    for i in 0..spans {
        cubic.extend(raised(&own[degree * i..=degree * (i + 1)]));
    }
    Some(cubic)
}

/// Inserts a knot once.
fn insert(degree: usize, knots: &mut Vec<f64>, poles: &mut Vec<Point>, t: f64) {
    // the span that ends behind t
    let k = knots.iter().rposition(|knot| *knot <= t).unwrap_or(0).min(poles.len());
    let times = knots.iter().filter(|knot| **knot == t).count();
    let mut more = Vec::with_capacity(poles.len() + 1);
    for i in 0..=poles.len() {
        more.push(if i + degree <= k {
            poles[i]
        } else if i + times > k || i == poles.len() {
            poles[i - 1]
        } else {
            let part = (t - knots[i]) / (knots[i + degree] - knots[i]);
            between(poles[i - 1], poles[i], part)
        });
    }
    *poles = more;
    knots.insert(k + 1, t);
}

/// Returns the three poles behind the first of the cubic curve that one of a degree up to 3 is.
fn raised(own: &[Point]) -> Vec<Point> {
    match own {
        [a, b] => vec![between(*a, *b, 1.0 / 3.0), between(*a, *b, 2.0 / 3.0), *b],
        [a, b, c] => vec![between(*a, *b, 2.0 / 3.0), between(*c, *b, 2.0 / 3.0), *c],
        _ => own[1..].to_vec(),
    }
}

fn between(a: Point, b: Point, part: f64) -> Point {
    Point { x: a.x + part * (b.x - a.x), y: a.y + part * (b.y - a.y) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point { x, y }
    }
    /// The place of a B-spline by the recursion of de Boor, which inserts nothing.
    fn de_boor(degree: usize, knots: &[f64], poles: &[Point], t: f64) -> Point {
        let k = knots.iter().rposition(|knot| *knot <= t).unwrap().min(poles.len() - 1);
        let mut d: Vec<Point> = (0..=degree).map(|j| poles[j + k - degree]).collect();
        for r in 1..=degree {
            for j in (r..=degree).rev() {
                let i = j + k - degree;
                let part = (t - knots[i]) / (knots[i + degree + 1 - r] - knots[i]);
                d[j] = between(d[j - 1], d[j], part);
            }
        }
        d[degree]
    }
    #[test]
    fn bezier_curves_are_the_spline() {
        let poles = [p(0.0, 0.0), p(1.0, 3.0), p(4.0, 3.0), p(5.0, -2.0), p(8.0, 0.0), p(9.0, 4.0)];
        let clamped = [0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 4.0, 4.0, 4.0, 4.0];
        let open = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let square = [0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 4.0, 4.0];
        for (degree, knots, ends) in [
            (3, &clamped[..], vec![0.0, 1.0, 2.5, 4.0]),
            (3, &open[..], vec![3.0, 4.0, 5.0, 6.0]),
            (2, &square[..], vec![0.0, 1.0, 2.0, 3.0, 4.0]),
        ] {
            let cubic = bezier(degree, knots, &poles).unwrap();
            assert_eq!(cubic.len(), 3 * (ends.len() - 1) + 1);
            for (piece, span) in spline::pieces(&cubic).zip(ends.windows(2)) {
                for i in 0..10 {
                    let part = f64::from(i) / 10.0;
                    let (q, r) = (
                        spline::at(piece, part),
                        de_boor(degree, knots, &poles, span[0] + part * (span[1] - span[0])),
                    );
                    assert!(
                        (q.x - r.x).abs() + (q.y - r.y).abs() < 1e-12,
                        "{degree} {span:?} {part}: {q:?} {r:?}"
                    );
                }
            }
        }
    }
    #[test]
    fn what_is_no_spline_is_none() {
        let poles = [p(0.0, 0.0), p(1.0, 1.0), p(2.0, 0.0), p(3.0, 1.0)];
        assert_eq!(bezier(3, &[0.0; 8], &poles), None);
        assert_eq!(bezier(3, &[0.0, 1.0, 2.0], &poles), None);
        assert_eq!(bezier(5, &[0.0; 10], &poles), None);
    }
}
