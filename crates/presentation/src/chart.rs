//! A chart by the keyboard.

use session::plotting::Plot;

/// The point beside the one that is read: along its curve, or of the next curve.
pub fn beside(
    plot: &Plot,
    read: Option<(usize, (f64, f64))>,
    key: &str,
) -> Option<(usize, (f64, f64))> {
    let curves: Vec<&[Option<(f64, f64)>]> = match plot.curves.is_empty() {
        true => plot.loci.iter().map(|locus| &locus.points[..]).collect(),
        false => plot.curves.iter().map(|curve| &curve.points[..]).collect(),
    };
    let all = |which: usize| -> Vec<(f64, f64)> {
        curves.get(which).into_iter().flat_map(|points| points.iter().flatten().copied()).collect()
    };
    let Some((which, at)) = read else { return all(0).first().map(|p| (0, *p)) };
    let own = all(which);
    let index = own.iter().position(|p| *p == at).unwrap_or(0);
    let (which, index) = match key {
        "ArrowLeft" => (which, index.saturating_sub(1)),
        "ArrowRight" => (which, index + 1),
        "ArrowUp" => (which.saturating_sub(1), index),
        _ => ((which + 1).min(curves.len().saturating_sub(1)), index),
    };
    let own = all(which);
    own.get(index).or(own.last()).map(|p| (which, *p))
}

#[cfg(test)]
mod tests {
    use super::beside;
    use session::plotting::{Axis, Curve, Plot};

    #[test]
    fn keys_walk_along_a_curve_and_from_curve_to_curve() {
        let curve = |y: f64| Curve {
            axis: Axis::default(),
            points: vec![Some((0.0, y)), None, Some((1.0, y))],
        };
        let plot = Plot { curves: vec![curve(2.0), curve(3.0)], ..Plot::default() };
        let walk = |keys: &[&str]| keys.iter().fold(None, |read, key| beside(&plot, read, key));
        assert_eq!(walk(&["ArrowRight"]), Some((0, (0.0, 2.0))));
        assert_eq!(walk(&["ArrowRight", "ArrowRight", "ArrowRight"]), Some((0, (1.0, 2.0))));
        assert_eq!(walk(&["ArrowRight", "ArrowRight", "ArrowDown"]), Some((1, (1.0, 3.0))));
        assert_eq!(walk(&["ArrowRight", "ArrowUp", "ArrowLeft"]), Some((0, (0.0, 2.0))));
        assert_eq!(beside(&Plot::default(), None, "ArrowLeft"), None);
    }
}
