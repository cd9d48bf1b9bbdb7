//! The best prediction of a noise by its last values, whatever its spectrum.

use crate::numerics::count;
use crate::numerics::least_squares::lagged;
use crate::policy::extent::{PREDICTED_BY_MOST, ROWS_A_LAG};

/// Weights of the last values of a pass, the newest first; none where the values do not tell the next.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Prediction {
    weights: Vec<f64>,
}

impl Prediction {
    /// That of some passes of one noise: the equations of Yule and Walker, solved for one value more at a time
    /// (Durbin 1960, *The fitting of time-series models*, Review of the International Statistical Institute 28:233),
    /// as many as Akaike's criterion asks for (1974, *A new look at the statistical model identification*, IEEE
    /// Transactions on Automatic Control 19:716).
    pub(crate) fn of(passes: &[&[f64]]) -> Self {
        let rows: usize = passes.iter().map(|pass| pass.len()).sum();
        let most = PREDICTED_BY_MOST.min(rows / ROWS_A_LAG);
        let products: Vec<f64> = (0..=most).map(|lag| product(passes, lag)).collect();
        let (mut weights, mut left) = (Vec::<f64>::new(), products[0]);
        let (mut best, mut least) = (Vec::new(), 0.0);
        for lag in 1..=most {
            let older = weights.iter().zip(products[1..lag].iter().rev());
            let foreseen: f64 = older.map(|(weight, product)| weight * product).sum();
            let reflected = (products[lag] - foreseen) / left;
            if !reflected.is_finite() || 1.0 <= reflected.abs() {
                break;
            }
            let older: Vec<f64> = weights.iter().rev().map(|weight| reflected * weight).collect();
            weights.iter_mut().zip(older).for_each(|(weight, other)| *weight -= other);
            weights.push(reflected);
            left *= 1.0 - reflected * reflected;
            let criterion = count(rows) * libm::log(left / products[0]) + 2.0 * count(lag);
            if criterion < least {
                (best, least) = (weights.clone(), criterion);
            }
        }
        Self { weights: best }
    }

    /// The rows of a pass that have enough rows before them.
    pub(crate) fn told<'a>(&self, pass: &'a [f64]) -> &'a [f64] {
        &pass[self.weights.len().min(pass.len())..]
    }

    /// What a pass shows there beside what its last values tell.
    pub(crate) fn beside(&self, pass: &[f64]) -> Vec<f64> {
        let windows = pass.windows(self.weights.len() + 1);
        let foreseen = |before: &[f64]| -> f64 {
            before.iter().rev().zip(&self.weights).map(|(value, weight)| value * weight).sum()
        };
        windows
            .filter_map(|window| window.split_last())
            .map(|(next, before)| next - foreseen(before))
            .collect()
    }
}

/// Sum of the products of values so many rows apart.
fn product(passes: &[&[f64]], lag: usize) -> f64 {
    let long = passes.iter().filter(|pass| lag < pass.len());
    long.map(|pass| lagged(pass, lag)).sum()
}
