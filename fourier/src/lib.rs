//! Discrete Fourier transforms of any length.
//!
//! Scalar algorithms alone: what vector instructions a processor has would show in the last bits. A
//! crate of its own, because all algorithms are compiled wherever one is asked for.

use std::cell::RefCell;

use rustfft::{FftDirection, FftPlannerScalar};

pub use rustfft::num_complex::Complex;

thread_local! {
    /// Keeps the twiddle factors of lengths that were used before.
    static PLANNER: RefCell<FftPlannerScalar<f64>> = RefCell::new(FftPlannerScalar::new());
}

/// `Σ valueⱼ·exp(−2πi·j·k/n)` in the place of the `n` values.
pub fn forward(values: &mut [Complex<f64>]) {
    transform(values, FftDirection::Forward);
}

/// `Σ valueⱼ·exp(+2πi·j·k/n)` in the place of the `n` values: after `forward`, `n` times what was
/// there.
pub fn backward(values: &mut [Complex<f64>]) {
    transform(values, FftDirection::Inverse);
}

fn transform(values: &mut [Complex<f64>], direction: FftDirection) {
    let plan = PLANNER.with_borrow_mut(|planner| planner.plan_fft(values.len(), direction));
    plan.process(values);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths with small factors, of two primes, and a prime.
    #[test]
    fn both_directions_are_the_sums_as_written() {
        for length in [1_u32, 12, 77, 101] {
            let values: Vec<Complex<f64>> =
                (0..length).map(|j| Complex::new(f64::from(j * j % 7), f64::from(j % 3))).collect();
            let mut found = values.clone();
            forward(&mut found);
            let turn = std::f64::consts::TAU / f64::from(length);
            for (k, found) in (0..length).zip(&found) {
                let term = |(j, value): (u32, &Complex<f64>)| {
                    value * Complex::from_polar(1.0, -turn * f64::from(j * k % length))
                };
                let sum: Complex<f64> = (0..length).zip(&values).map(term).sum();
                assert!((sum - found).norm() < 1e-9, "{length} {k}: {found} for {sum}");
            }
            backward(&mut found);
            for (before, after) in values.iter().zip(&found) {
                assert!((before * f64::from(length) - after).norm() < 1e-9, "{length}");
            }
        }
    }
}
