//! Splines of the DXF writer: Bézier curves and rational B-splines, each as one SPLINE.

use super::Writer;
use crate::element::{Element, Point};
use crate::nurbs::Nurbs;
use crate::spline;

impl Writer {
    /// Writes Bézier curves as a B-spline.
    pub(super) fn spline(&mut self, element: &Element, poles: &[Point]) {
        let pieces = spline::pieces(poles).count();
        if pieces == 0 {
            return;
        }
        self.b_spline(element, (3, &spline::knots(poles)), &poles[..=3 * pieces], &[]);
    }
    /// Writes a rational B-spline as one, unless its weights are all alike.
    pub(super) fn nurbs(&mut self, element: &Element, curve: &Nurbs) {
        let weights = curve.weights();
        let is_rational = weights.windows(2).any(|w| w[0] != w[1]);
        let weights = if is_rational { weights } else { &[] };
        self.b_spline(element, (curve.degree(), curve.knots()), curve.poles(), weights);
    }
    /// Writes a B-spline; with weights it is rational.
    fn b_spline(
        &mut self,
        element: &Element,
        (degree, knots): (usize, &[f64]),
        poles: &[Point],
        weights: &[f64],
    ) {
        self.begin("SPLINE", "AcDbSpline", element);
        self.pair(210, "0.0\n220\n0.0\n230\n1.0");
        // in a plane, rational
        self.pair(70, if weights.is_empty() { 8 } else { 8 + 4 });
        self.pair(71, degree);
        self.pair(72, knots.len());
        self.pair(73, poles.len());
        self.pair(74, 0);
        knots.iter().for_each(|knot| self.real(40, *knot));
        weights.iter().for_each(|weight| self.real(41, *weight));
        poles.iter().for_each(|p| self.at(10, *p));
    }
}
