//! Lists by number: what belongs to each of several numbers, one list after the other.

/// A list of numbers for every one of several numbers.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) struct Lists {
    first: Vec<u32>,
    items: Vec<u32>,
}

impl Default for Lists {
    fn default() -> Self {
        Self { first: vec![0], items: Vec::new() }
    }
}

impl Lists {
    /// Sorts pairs by their first number; those of one number stay in order.
    pub(crate) fn new(count: usize, pairs: impl Iterator<Item = (u32, u32)> + Clone) -> Self {
        // counted two further on, so that where a list starts can move on to where it ends
        let mut first = vec![0; count + 2];
        pairs.clone().for_each(|(of, _)| first[of as usize + 2] += 1);
        for i in 2..count + 2 {
            first[i] += first[i - 1];
        }
        let mut items = vec![0; first[count + 1] as usize];
        for (of, item) in pairs {
            let next = &mut first[of as usize + 1];
            items[*next as usize] = item;
            *next += 1;
        }
        first.truncate(count + 1);
        Self { first, items }
    }
    /// Makes room for the lists of so many numbers, of so many items in all.
    pub(crate) fn with_room(count: usize, items: usize) -> Self {
        let mut first = Vec::with_capacity(count + 1);
        first.push(0);
        Self { first, items: Vec::with_capacity(items) }
    }
    /// Adds the list of the next number, its items in order of size.
    pub(crate) fn push_sorted(&mut self, own: impl Iterator<Item = u32>) {
        let start = self.items.len();
        self.items.extend(own);
        self.items[start..].sort_unstable();
        self.first.push(self.items.len() as u32);
    }
    /// Adds the list of the next number.
    pub(crate) fn push(&mut self, own: &[u32]) {
        self.items.extend_from_slice(own);
        self.first.push(self.items.len() as u32);
    }
    /// Adds the list of the next number, item by item.
    pub(crate) fn push_each(&mut self, own: impl Iterator<Item = u32>) {
        self.items.extend(own);
        self.first.push(self.items.len() as u32);
    }
    /// Returns where each list starts, and where the last one ends; then all lists, one after the other.
    pub(crate) fn into_parts(self) -> (Vec<u32>, Vec<u32>) {
        (self.first, self.items)
    }
    /// Returns all lists, one after the other.
    pub(crate) fn all(&self) -> &[u32] {
        &self.items
    }
    /// Returns where each list starts among all, and where the last one ends.
    pub(crate) fn starts(&self) -> &[u32] {
        &self.first
    }
    /// Returns how many lists there are.
    pub(crate) fn len(&self) -> usize {
        self.first.len() - 1
    }
    /// Returns the list of a number.
    pub(crate) fn of(&self, of: u32) -> &[u32] {
        &self.items[self.first[of as usize] as usize..self.first[of as usize + 1] as usize]
    }
}
