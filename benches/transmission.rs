//! What one sample of δ costs in software, by each method of document 4, on the same pulses in the
//! same run: a worm pair 36:1 with 1000 and 3600 lines. Only the ratios are to be quoted.

use std::f64::consts::TAU;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use helixlock_metrology::transmission::{Gearing, Method, Setup, Synthesis, measure, synthesise};

fn methods(c: &mut Criterion) {
    let gearing = Gearing { input_lines: 1000, output_lines: 3600, ratio: (36, 1) };
    let run = Synthesis { input_hz: 6.0, output_turns: 20.0 };
    let pulses = synthesise(&gearing, &run, |turns| 1e-4 * libm::sin(TAU * turns))
        .expect("a gentle error keeps the pulses in order");
    let setup = Setup { gearing, clock_hz: 12e6, range_divider: 1, recorder_s: 0.05 };
    let mut group = c.benchmark_group("one sample of a transmission error");
    for method in Method::ALL {
        let samples =
            measure(&pulses, &setup, method).expect("the method works here").samples.len();
        group.throughput(Throughput::Elements(samples as u64));
        group.bench_function(method.name(), |b| {
            b.iter(|| measure(black_box(&pulses), &setup, method));
        });
    }
    group.finish();
}

criterion_group!(benches, methods);
criterion_main!(benches);
