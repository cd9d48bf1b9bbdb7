//! Lead screws, straightness, scales and transmission error: numbers in, numbers out.
