//! Every clock, on inputs that never rest.

use criterion::{Criterion, Throughput};
use helixlock_sim::{Interpreter, device, device_engine, stepped_device};

use crate::stimulus::{dense, drive};

/// Clocks in one run of a compiled engine.
const CLOCKS: u64 = 100_000;

pub(crate) fn stepping(criterion: &mut Criterion) {
    let netlist = device().netlist();
    let events = dense(netlist, CLOCKS);
    let mut group = criterion.benchmark_group("stepping");
    group.throughput(Throughput::Elements(CLOCKS));
    group.bench_function("compiled", |bencher| {
        bencher.iter(|| drive(&mut stepped_device(), &events, CLOCKS));
    });
    group.bench_function("leap", |bencher| {
        bencher.iter(|| drive(&mut device_engine(), &events, CLOCKS));
    });
    group.throughput(Throughput::Elements(CLOCKS / 100));
    group.sample_size(10).bench_function("interpreter", |bencher| {
        bencher.iter(|| drive(&mut Interpreter::new(netlist), &events, CLOCKS / 100));
    });
    group.finish();
}
