//! The logic of the correction device, one block a file, in signal order.
