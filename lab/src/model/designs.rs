//! Columns of effects at the places of their grids: worked out once, tried under many noises.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use super::columns::Columns;

/// Columns at every place of a grid; `None` where they say nothing.
pub(crate) type GridColumns = Arc<Vec<Option<Columns>>>;

/// Kind of an effect, the effect of the machine file in whose place it stands, and its columns: more where
/// it is open what passes began with.
pub(crate) type Key = (&'static str, Option<usize>, usize);

/// What is known of the effects of the catalogue; clones of a problem share it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Designs {
    known: Arc<Mutex<BTreeMap<Key, Known>>>,
}

#[derive(Debug)]
struct Known {
    grid: Vec<Vec<f64>>,
    columns: GridColumns,
}

impl Designs {
    /// Columns at every place of a grid of an effect, from memory if they are there.
    #[must_use]
    pub(crate) fn of(
        &self,
        key: Key,
        grid: &[Vec<f64>],
        make: impl FnOnce() -> GridColumns,
    ) -> GridColumns {
        let known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = known.get(&key).filter(|known| known.grid == grid) {
            return Arc::clone(&known.columns);
        }
        // Nobody waits for a lock while columns are made: the work is shared with other threads.
        drop(known);
        let columns = make();
        let fresh = Known { grid: grid.to_vec(), columns: Arc::clone(&columns) };
        self.known.lock().unwrap_or_else(PoisonError::into_inner).insert(key, fresh);
        columns
    }
}
