//! Lists that are empty as a rule: of many there is a place for each, and it is a small one.

use std::fmt;
use std::ops::Deref;

/// A list that is empty as a rule, in the room of one pointer.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Seldom<T>(Option<Box<Held<T>>>);

/// What is in it; never nothing.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
struct Held<T>(Vec<T>);

impl<T> Seldom<T> {
    /// Adds an item at the end.
    pub fn push(&mut self, item: T) {
        match &mut self.0 {
            Some(held) => held.0.push(item),
            None => *self = vec![item].into(),
        }
    }
    /// Takes out everything.
    pub fn clear(&mut self) {
        self.0 = None;
    }
}

impl<T> Default for Seldom<T> {
    fn default() -> Self {
        Self(None)
    }
}
impl<T> Deref for Seldom<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        match &self.0 {
            Some(held) => &held.0,
            None => &[],
        }
    }
}
impl<T> From<Vec<T>> for Seldom<T> {
    fn from(items: Vec<T>) -> Self {
        Self((!items.is_empty()).then(|| Box::new(Held(items))))
    }
}
impl<T> FromIterator<T> for Seldom<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        items.into_iter().collect::<Vec<T>>().into()
    }
}
impl<'s, T> IntoIterator for &'s Seldom<T> {
    type Item = &'s T;
    type IntoIter = std::slice::Iter<'s, T>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}
impl<T: fmt::Debug> fmt::Debug for Seldom<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_put_in_comes_out() {
        let mut list = Seldom::default();
        assert_eq!((list.len(), &list), (0, &Vec::new().into()));
        list.push(3);
        list.push(4);
        assert_eq!(list[..], [3, 4]);
        assert_eq!(list, [3, 4].into_iter().collect());
        list.clear();
        assert_eq!(list, Seldom::default());
        assert_eq!(size_of::<Seldom<u32>>(), size_of::<usize>());
    }
}
