//! Short lists of numbers, most of them held in place; longer ones are shared by their copies.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::ops::Deref;
use std::rc::Rc;

/// How many numbers are held in place.
const IN_PLACE: usize = 5;

/// A list of numbers, a handful as a rule, that does not grow.
#[derive(Clone)]
pub struct Few(Held);

#[derive(Clone)]
enum Held {
    InPlace(u8, [u32; IN_PLACE]),
    Apart(Rc<[u32]>),
}

impl Deref for Few {
    type Target = [u32];
    fn deref(&self) -> &[u32] {
        match &self.0 {
            Held::InPlace(len, items) => &items[..*len as usize],
            Held::Apart(items) => items,
        }
    }
}

impl From<&[u32]> for Few {
    fn from(items: &[u32]) -> Self {
        if items.len() > IN_PLACE {
            return Self(Held::Apart(items.into()));
        }
        let mut held = [0; IN_PLACE];
        held[..items.len()].copy_from_slice(items);
        Self(Held::InPlace(items.len() as u8, held))
    }
}

impl From<Vec<u32>> for Few {
    fn from(items: Vec<u32>) -> Self {
        if items.len() > IN_PLACE {
            Self(Held::Apart(items.into()))
        } else {
            Self::from(&items[..])
        }
    }
}

impl FromIterator<u32> for Few {
    fn from_iter<I: IntoIterator<Item = u32>>(items: I) -> Self {
        let mut items = items.into_iter();
        let mut held = [0; IN_PLACE];
        for len in 0..IN_PLACE {
            let Some(item) = items.next() else {
                return Self(Held::InPlace(len as u8, held));
            };
            held[len] = item;
        }
        let Some(next) = items.next() else {
            return Self(Held::InPlace(IN_PLACE as u8, held));
        };
        Self(Held::Apart(held.into_iter().chain([next]).chain(items).collect()))
    }
}

impl<'f> IntoIterator for &'f Few {
    type Item = &'f u32;
    type IntoIter = std::slice::Iter<'f, u32>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl Default for Few {
    fn default() -> Self {
        Self(Held::InPlace(0, [0; IN_PLACE]))
    }
}
impl PartialEq for Few {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}
impl Eq for Few {}
impl PartialOrd for Few {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Few {
    fn cmp(&self, other: &Self) -> Ordering {
        (**self).cmp(&**other)
    }
}
impl Hash for Few {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (**self).hash(state);
    }
}
impl fmt::Debug for Few {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_of_any_length_comes_back_as_it_was() {
        for n in 0..9 {
            let items: Vec<u32> = (0..n).collect();
            let (a, b): (Few, Few) = (items.iter().copied().collect(), Few::from(&items[..]));
            assert_eq!(*a, items[..]);
            assert_eq!(a, b);
            assert_eq!(b, Few::from(items));
        }
        assert_eq!(size_of::<Few>(), size_of::<Vec<u32>>());
    }
}
