//! Independent work on all cores.

use rayon::iter::{IntoParallelRefIterator, ParallelIterator};

/// Does `work` for every item, on all cores, in no order; stops early at an error.
///
/// # Errors
///
/// One of the errors of `work`.
pub fn parallel<T: Sync, E: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<(), E> + Send + Sync,
) -> Result<(), E> {
    items.par_iter().try_for_each(work)
}
