//! Numbers that look like chance and are the same in every run.

/// Returns a number that depends on `seed` alone; near seeds give numbers that have nothing in common (the
/// last step of SplitMix64).
pub fn scrambled(seed: u64) -> u64 {
    let mut z = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// A generator of numbers for tests and benches (xorshift).
#[derive(Debug)]
pub struct Dice(u64);

impl Dice {
    /// Begins a sequence; every seed has its own.
    pub fn new(seed: u64) -> Self {
        let mut dice = Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        (0..8).for_each(|_| {
            dice.below(2);
        });
        dice
    }

    /// Returns a whole number from 0 to `n - 1`.
    ///
    /// # Panics
    /// If `n` is 0.
    pub fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        ((self.0 >> 20) % n as u64) as usize
    }

    /// Returns a number from `low` to `high`, in ten thousandths of the way.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.below(10_007) as f64 / 10_006.0
    }

    /// Returns one of some things; None of none.
    pub fn one_of<T: Clone>(&mut self, things: &[T]) -> Option<T> {
        (!things.is_empty()).then(|| things[self.below(things.len())].clone())
    }

    /// Puts things into some order.
    pub fn shuffle<T>(&mut self, things: &mut [T]) {
        for i in (1..things.len()).rev() {
            things.swap(i, self.below(i + 1));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Dice, scrambled};

    #[test]
    fn the_first_number_of_splitmix64_is_the_published_one() {
        // of seed 0, from the reference program at prng.di.unimi.it/splitmix64.c
        assert_eq!(scrambled(0), 0xe220_a839_7b1d_cdaf);
    }

    #[test]
    fn a_die_shows_all_its_sides_about_as_often() {
        let (mut dice, mut seen) = (Dice::new(1), [0; 6]);
        (0..6_000).for_each(|_| seen[dice.below(6)] += 1);
        assert!(seen.iter().all(|&count| (800..1200).contains(&count)), "{seen:?}");
        assert_eq!(Dice::new(1).one_of::<u8>(&[]), None);
    }

    #[test]
    fn what_is_shuffled_is_all_there() {
        let mut things: Vec<usize> = (0..50).collect();
        Dice::new(3).shuffle(&mut things);
        assert_ne!(things, (0..50).collect::<Vec<_>>());
        things.sort_unstable();
        assert_eq!(things, (0..50).collect::<Vec<_>>());
    }
}
