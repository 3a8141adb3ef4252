//! Unions: a partition of numbers that grows coarser.

/// A partition of the numbers from 0; the least of a set stands for it.
#[derive(Clone, Debug)]
pub(crate) struct Union(Vec<u32>);

impl Union {
    /// Makes the partition of so many numbers into themselves.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }
    /// Returns the number that stands for a set.
    pub(crate) fn find(&mut self, i: usize) -> usize {
        let mut at = i;
        while self.0[at] as usize != at {
            let above = self.0[at] as usize;
            self.0[at] = self.0[above];
            at = above;
        }
        at
    }
    /// Makes two sets one.
    pub(crate) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b) as u32;
    }
}
