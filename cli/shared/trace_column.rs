//! A column of a trace as it is written.

use helixlock_traces::Column;

/// Digits behind the point: a nanosecond, a picometre of position, a picometre of error.
const DIGITS: f64 = 1e9;

/// Values to those digits, under a name.
pub(crate) fn trace_column(name: impl Into<String>, values: &[f64]) -> Column {
    Column::new(name, values.iter().map(|value| (value * DIGITS).round() / DIGITS).collect())
}
