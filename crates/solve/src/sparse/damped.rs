//! Damped steps: the least squares of a sparse system, held back by the length of the step.
//!
//! In: where a matrix has entries; then numbers, a right side, a damping. Out: the step that makes
//! `|A step - right|² + damping |step|²` least, by the residuals that it leaves: `[-damping Aᵀ; A I]` is
//! quasi-definite and as sparse as `A`.
//!
//! **Source:** Björck, *Numerical Methods for Least Squares Problems*, SIAM 1996, §2.5.3.

use super::{Ldl, Pattern, Symmetric};

/// The order for damped steps, of columns then rows.
#[derive(Clone, Debug)]
pub(crate) struct Damped {
    symmetric: Symmetric,
    height: usize,
    width: usize,
}

/// Working space for damped steps; serves any number of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct DampedScratch {
    ldl: Ldl,
    saddle: Vec<f64>,
    right: Vec<f64>,
}

impl Damped {
    /// Lays the factors out.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let (height, width) = (pattern.height(), pattern.width);
        let entries = pattern.bordered(std::iter::empty());
        Self { symmetric: Symmetric::new(width + height, &entries), height, width }
    }

    /// Returns the step, by column, for numbers in the order of the pattern and a right side for every row;
    /// nothing where the factors are not finite. The damping is above zero.
    pub(crate) fn step<'a>(
        &self,
        matrix: &[f64],
        right: impl Iterator<Item = f64>,
        damping: f64,
        s: &'a mut DampedScratch,
    ) -> Option<&'a [f64]> {
        s.saddle.clear();
        s.saddle.resize(self.width, -damping);
        s.saddle.resize(self.width + self.height, 1.0);
        s.saddle.extend_from_slice(matrix);
        s.right.clear();
        s.right.resize(self.width, 0.0);
        s.right.extend(right);
        self.symmetric.factorise(&s.saddle, &mut s.ldl)?;
        self.symmetric.solve(&mut s.ldl, &mut s.right);
        Some(&s.right[..self.width])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_damped_step_is_least_squares_held_back() {
        // x + y = 3, x - y = 1, x = 5: normal equations [3 0; 0 2] (x, y) = (9, 2), each with one more
        let pattern = Pattern::of_rows(2, [vec![0, 1], vec![0, 1], vec![0]].into_iter());
        let matrix = [1.0, 1.0, 1.0, -1.0, 1.0];
        let mut scratch = DampedScratch::default();
        let right = [3.0, 1.0, 5.0];
        let damped = Damped::new(&pattern);
        let step = damped.step(&matrix, right.into_iter(), 1.0, &mut scratch).expect("is finite");
        assert!((step[0] - 9.0 / 4.0).abs() < 1e-14 && (step[1] - 2.0 / 3.0).abs() < 1e-14);
    }

    #[test]
    fn numbers_that_are_none_give_no_step() {
        let pattern = Pattern::of_rows(1, [vec![0]].into_iter());
        let mut scratch = DampedScratch::default();
        let step = Damped::new(&pattern).step(&[f64::NAN], [1.0].into_iter(), 1.0, &mut scratch);
        assert_eq!(step, None);
    }
}
