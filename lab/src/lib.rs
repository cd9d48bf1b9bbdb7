//! Model against measurement.
