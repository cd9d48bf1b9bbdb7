//! The machine and its physics; no flip-flops.
