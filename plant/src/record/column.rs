//! One value a sample, shared.

use std::ops::{Deref, DerefMut, Range};
use std::sync::Arc;

/// One value a sample. There may be millions: clones share them until one is changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<T = f64>(Arc<Vec<T>>);

impl<T: Clone> Column<T> {
    /// The values of some rows; shared when these are all.
    ///
    /// # Panics
    ///
    /// When a row is not there.
    #[must_use]
    pub fn part(&self, rows: &Range<usize>) -> Self {
        if *rows == (0..self.len()) { self.clone() } else { self[rows.clone()].to_vec().into() }
    }
}

impl<T> Default for Column<T> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<T> From<Vec<T>> for Column<T> {
    fn from(values: Vec<T>) -> Self {
        Self(Arc::new(values))
    }
}

impl<T> FromIterator<T> for Column<T> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        Vec::from_iter(values).into()
    }
}

impl<T> Deref for Column<T> {
    type Target = Vec<T>;

    fn deref(&self) -> &Vec<T> {
        &self.0
    }
}

impl<T: Clone> DerefMut for Column<T> {
    fn deref_mut(&mut self) -> &mut Vec<T> {
        Arc::make_mut(&mut self.0)
    }
}

impl<'a, T> IntoIterator for &'a Column<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}
