//! The widest variation over any 300 mm, by three methods on the same curve in the same run.
//!
//! - `monotone queues`: what the library does, O(n);
//! - `sorted window`: document 5's method, one sorted array that loses its first sample and takes
//!   the next by binary search, O(n·w) moves;
//! - `naive`: each window looked through on its own, O(n·w) comparisons.
//!
//! Only the ratios are to be quoted: machines differ. The slow ones get a curve of 1 m at the
//! document's density (16 samples a turn of 2 mm: 2400 in a window); the queues also get ten
//! million samples.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use helixlock_metrology::screw::widest_in_windows;

const WINDOW_MM: f64 = 300.0;

/// A curve over 1 m with as many samples: slow waves, a wave a turn, and something like noise.
fn curve(samples: u32) -> (Vec<f64>, Vec<f64>) {
    let step_mm = 1000.0 / f64::from(samples);
    let x: Vec<f64> = (0..samples).map(|k| f64::from(k) * step_mm).collect();
    let height = |(k, x): (u32, &f64)| {
        let noise = f64::from(k.wrapping_mul(2_654_435_761) >> 8) / f64::from(1_u32 << 24);
        3.0 * wave(x / 50.0) + 2.0 * wave(x * 3.1) + noise
    };
    let y = (0..samples).zip(&x).map(height).collect();
    (x, y)
}

/// A wave of period 2π without a library: its exact shape does not matter here.
fn wave(phase: f64) -> f64 {
    let turn = phase / std::f64::consts::TAU;
    let part = turn - turn.floor() - 0.5;
    16.0 * part * (part.abs() - 0.5)
}

/// Document 5: sorted values of the window, updated by binary search.
fn sorted_window(x: &[f64], y: &[f64]) -> f64 {
    let mut sorted: Vec<f64> = Vec::new();
    let (mut start, mut widest) = (0, 0.0_f64);
    for (end, value) in y.iter().enumerate() {
        while WINDOW_MM < x[end] - x[start] {
            let gone = sorted.partition_point(|other| *other < y[start]);
            sorted.remove(gone);
            start += 1;
        }
        sorted.insert(sorted.partition_point(|other| other < value), *value);
        widest = widest.max(sorted[sorted.len() - 1] - sorted[0]);
    }
    widest
}

fn naive(x: &[f64], y: &[f64]) -> f64 {
    let window = |start: usize| {
        let inside = x[start..].iter().take_while(|at| **at - x[start] <= WINDOW_MM).count();
        let values = &y[start..start + inside];
        let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        highest - values.iter().copied().fold(f64::INFINITY, f64::min)
    };
    (0..x.len()).map(window).fold(0.0, f64::max)
}

fn windows(c: &mut Criterion) {
    let (x, y) = curve(8000);
    let found = widest_in_windows(&x, &y, WINDOW_MM).map(|widest| widest.spread);
    assert_eq!(found, Some(naive(&x, &y)), "the same work");
    assert_eq!(found, Some(sorted_window(&x, &y)), "the same work");
    let mut group = c.benchmark_group("any 300 mm, 8000 samples");
    group.throughput(Throughput::Elements(8000));
    group.bench_function("monotone queues", |b| {
        b.iter(|| widest_in_windows(black_box(&x), &y, WINDOW_MM));
    });
    group.bench_function("sorted window", |b| b.iter(|| sorted_window(black_box(&x), &y)));
    group.bench_function("naive", |b| b.iter(|| naive(black_box(&x), &y)));
    group.finish();
    let (x, y) = curve(10_000_000);
    let mut group = c.benchmark_group("any 300 mm, ten million samples");
    group.throughput(Throughput::Elements(10_000_000)).sample_size(10);
    group.bench_function("monotone queues", |b| {
        b.iter(|| widest_in_windows(black_box(&x), &y, WINDOW_MM));
    });
    group.finish();
}

criterion_group!(benches, windows);
criterion_main!(benches);
