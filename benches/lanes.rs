//! Lanes against one copy: the same clocks, 512 times.

use criterion::{Criterion, Throughput};
use helixlock_sim::{Engine, LANES, device_lanes, stepped_device};

/// Clocks in one run.
const CLOCKS: u64 = 10_000;

pub(crate) fn lanes(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("lanes");
    group.throughput(Throughput::Elements(CLOCKS * LANES as u64));
    group.bench_function("512 lanes", |bencher| {
        bencher.iter(|| device_lanes().run_until(CLOCKS));
    });
    group.throughput(Throughput::Elements(CLOCKS));
    group.bench_function("one, compiled", |bencher| {
        bencher.iter(|| stepped_device().run_until(CLOCKS));
    });
    group.finish();
}
