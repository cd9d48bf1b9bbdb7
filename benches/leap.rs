//! A tenth of a second of grinding at 15 rpm: time goes with the events, not with the clock.

use criterion::{BenchmarkId, Criterion, Throughput};
use helixlock_sim::{device, device_engine};

use crate::stimulus::{drive, pass};

pub(crate) fn leap(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("leap");
    for clock_mhz in [1_u32, 10, 100] {
        let clock_hz = f64::from(clock_mhz) * 1e6;
        let clocks = u64::from(clock_mhz) * 100_000;
        let events = pass(device().netlist(), clocks, 15.0, clock_hz);
        group.throughput(Throughput::Elements(events.len() as u64));
        let id = BenchmarkId::new("clock_mhz", clock_mhz);
        group.bench_with_input(id, &events, |bencher, events| {
            bencher.iter(|| drive(&mut device_engine(), events, clocks));
        });
    }
    group.finish();
}
