//! Speed of the engines on the device; one group a subject.

mod closed_loop;
mod lanes;
mod leap;
mod stepping;
mod stimulus;

use criterion::{criterion_group, criterion_main};

criterion_group!(benches, stepping::stepping, leap::leap, lanes::lanes, closed_loop::closed_loop);
criterion_main!(benches);
