//! How many records of chance a scene is asked for.

use std::ops::Range;

/// The first few seeds; with `HELIXLOCK_SEEDS=all` so many.
pub(crate) fn seeds(few: u64, all: u64) -> Range<u64> {
    0..if all_are_asked() { all } else { few }
}

/// The first few cases; with `HELIXLOCK_SEEDS=all` every one.
pub(crate) fn cases<T>(few: usize, all: &[T]) -> &[T] {
    if all_are_asked() { all } else { &all[..few] }
}

/// True when `HELIXLOCK_SEEDS=all` asks for every record.
pub(crate) fn all_are_asked() -> bool {
    std::env::var("HELIXLOCK_SEEDS").is_ok_and(|which| which == "all")
}

/// True when `HELIXLOCK_BOARD=all` asks for every block's gates and every fault.
pub(crate) fn all_boards_are_asked() -> bool {
    std::env::var("HELIXLOCK_BOARD").is_ok_and(|which| which == "all")
}
