//! What crosses crates; one module a subject.
