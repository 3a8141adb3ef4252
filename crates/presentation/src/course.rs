//! A value that is played, on its way through its range.

use drawing::Bounds;

/// After so many turns without a way between them there is none.
const MOST_TURNS: u32 = 2;

/// A value on its way.
#[derive(Clone, PartialEq, Debug)]
pub struct Course {
    /// The ends of the range.
    pub ends: (f64, f64),
    /// The value that is wanted now.
    pub at: f64,
    /// Whether it grows.
    pub grows: bool,
    /// Whether the range is a whole turn, whose ends may be one place.
    pub is_turn: bool,
    /// Whether it is computed, so that the ends of a whole turn are one.
    pub is_computed: bool,
    /// The numbers that were there at each end, once it was there.
    pub seen: [Option<Vec<f64>>; 2],
    /// How often it has turned since it last got on.
    pub turns: u32,
    /// What the picture has covered of the sheet so far, while the view is one that fits.
    pub covered: Option<Bounds>,
}

impl Course {
    /// Goes on by a part of the range; from an end it turns round, or goes on from the other.
    pub fn step(&mut self, part: f64) {
        let (least, most) = self.ends;
        if self.at >= most && self.grows || self.at <= least && !self.grows {
            match self.goes_round() {
                true => self.at = if self.grows { least } else { most },
                false => self.grows = !self.grows,
            }
        }
        let way = part * (most - least);
        self.at = (self.at + if self.grows { way } else { -way }).clamp(least, most);
    }

    /// Whether it goes on through its ends: only where all was the same at both, so that nothing jumps. What is computed
    /// is followed past half a turn, and comes on from the other end by itself.
    fn goes_round(&self) -> bool {
        if self.is_turn && self.is_computed {
            return true;
        }
        let [Some(first), Some(last)] = &self.seen else { return false };
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-6 * (1.0 + a.abs().max(b.abs()));
        self.is_turn && first.len() == last.len() && first.iter().zip(last).all(near)
    }

    /// Keeps what is there at an end, where it is at one.
    pub fn see(&mut self, numbers: impl FnOnce() -> Vec<f64>) {
        let at_end = [self.ends.0, self.ends.1].iter().position(|end| *end == self.at);
        if let Some(end) = at_end.filter(|_| self.is_turn) {
            self.seen[end] = Some(numbers());
        }
    }

    /// Turns round where the value has stopped short; returns false where it can go neither way.
    pub fn turn_at(&mut self, stopped: f64) -> bool {
        self.grows = !self.grows;
        self.at = stopped;
        self.turns += 1;
        self.turns <= MOST_TURNS
    }
}

#[cfg(test)]
mod tests {
    use super::Course;

    fn course() -> Course {
        Course {
            ends: (0.0, 10.0),
            at: 8.0,
            grows: true,
            is_turn: false,
            is_computed: false,
            seen: [None, None],
            turns: 0,
            covered: None,
        }
    }

    #[test]
    fn a_whole_turn_goes_on_through_its_ends_where_all_is_the_same_there() {
        let turn = || Course { is_turn: true, at: 10.0, ..course() };
        let mut same = turn();
        same.seen[0] = Some(vec![1.0, 2.0]);
        same.see(|| vec![1.0, 2.0]);
        same.step(0.25);
        assert_eq!((same.at, same.grows), (2.5, true));
        // what is geared to it would jump
        let mut geared = turn();
        geared.seen[0] = Some(vec![1.0, 0.0]);
        geared.see(|| vec![1.0, 180.0]);
        geared.step(0.25);
        assert_eq!((geared.at, geared.grows), (7.5, false));
        // what is computed comes on from the other end, whatever follows it
        let mut computed = Course { is_computed: true, ..turn() };
        computed.step(0.25);
        assert_eq!((computed.at, computed.grows), (2.5, true));
        let mut unknown = turn();
        unknown.see(|| vec![1.0]);
        unknown.step(0.25);
        assert_eq!((unknown.at, unknown.grows), (7.5, false));
    }

    #[test]
    fn a_value_turns_round_at_the_ends_of_its_range() {
        let mut course = course();
        course.step(0.25);
        assert_eq!((course.at, course.grows), (10.0, true));
        course.step(0.25);
        assert_eq!((course.at, course.grows), (7.5, false));
        course.step(1.0);
        assert_eq!((course.at, course.grows), (0.0, false));
        course.step(0.25);
        assert_eq!((course.at, course.grows), (2.5, true));
    }

    #[test]
    fn where_it_stops_short_it_goes_back_and_gives_up_between_two_walls() {
        let mut course = course();
        assert!(course.turn_at(6.0));
        assert_eq!((course.at, course.grows), (6.0, false));
        assert!(course.turn_at(6.0));
        assert!(!course.turn_at(6.0));
    }
}
