//! Every number that decides, with its origin.
