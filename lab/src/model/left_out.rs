//! How much less is known of coefficients because other sizes of their effects were left at 0.
//!
//! A slope beside which no bow was needed is known no better than what bow may hide there. By the law of
//! total variance over the models `S` that have one to three of those sizes more or fewer, about the fitted `β`
//!
//! ```text
//! var βᵢ = Σ w_S·(C_S,ii + (β_S,i − βᵢ)²)
//! ```
//!
//! with `w_S` what a model is worth by its likelihood and the price of its numbers, as everywhere
//! (Hoeting, Madigan, Raftery and Volinsky 1999, equations 1 to 3). All of them are the model with every
//! size free, under the condition that those which are not in `S` are 0.

use nalgebra::{DMatrix, DVector};

use super::columns::Columns;
use super::problem::Problem;
use super::state::State;
use super::unsure::Rows;
use crate::numerics::count;
use crate::policy::extent::MOST_CHANGED;

/// By how much the standard error of each coefficient of a linearised model is larger than if the sizes that
/// were left at 0 were known to be 0.
#[must_use]
pub(super) fn widening(problem: &Problem, state: &State, linearised: &Columns) -> Vec<f64> {
    let own = linearised.raw.len();
    let (others, mut sizes) = sizes(problem, state, own);
    let all = Free::of(problem, state, &linearised.and(&others));
    sizes.retain(|size| 0.0 < all.covariance[(size.column, size.column)]);
    let Some(known) = all.with(&sizes) else { return vec![1.0; own] };
    let mut variances = vec![0.0; own];
    let mut sum = 0.0;
    for model in models(&sizes).iter().filter_map(|sizes| all.with(sizes)) {
        let numbers = count(model.at_zero) - count(known.at_zero);
        let gain = known.lost - model.lost + problem.price_of_a_number() * numbers;
        let weight = libm::exp(0.5 * gain);
        sum += weight;
        for (at, variance) in variances.iter_mut().enumerate() {
            let moved = model.coefficients[at] - known.coefficients[at];
            *variance += weight * (model.variances[at] + moved * moved);
        }
    }
    let wider = |(at, variance): (usize, f64)| {
        let share = variance / (sum * known.variances[at]);
        if share.is_finite() { share.max(1.0).sqrt() } else { 1.0 }
    };
    variances.into_iter().enumerate().map(wider).collect()
}

/// A size of an effect of several, which may or may not be in use.
#[derive(Debug, Clone, Copy)]
struct Size {
    /// Its place among all columns.
    column: usize,
    fitted: f64,
    is_used: bool,
}

/// Columns that are not in use, and with those in use the sizes of the effects that have such, but for counts,
/// which are whole, and for the sizes of waves, which hardly share anything with others.
fn sizes(problem: &Problem, state: &State, behind: usize) -> (Columns, Vec<Size>) {
    let mut others = Columns::default();
    let mut sizes = Vec::new();
    let all = state.components.iter().enumerate();
    for (index, component) in all.filter(|(_, component)| component.leaves_out()) {
        let Ok(design) = problem.design(&component.term) else { continue };
        let (fitted, from) = state.coefficients(index);
        for column in component.sizes_alone() {
            let size = if component.kept[column] {
                let place = component.used_before(column);
                Size { column: from + place, fitted: fitted[place], is_used: true }
            } else {
                others = others.and(&Columns::free([design.columns[column].clone()]));
                Size { column: behind + others.raw.len() - 1, fitted: 0.0, is_used: false }
            };
            sizes.push(size);
        }
    }
    (others, sizes)
}

/// The model as it is, and those in which one to three sizes are in use that were not, or are not that were: of a slope,
/// a bow and an S all there are.
fn models(sizes: &[Size]) -> Vec<Vec<Size>> {
    let mut all = vec![(0, sizes.to_vec())];
    for place in 0..sizes.len() {
        let few = all.iter().filter(|(changed, _)| *changed < MOST_CHANGED);
        let other = |(changed, sizes): &(usize, Vec<Size>)| {
            let mut sizes = sizes.clone();
            sizes[place].is_used ^= true;
            (changed + 1, sizes)
        };
        all.extend(few.map(other).collect::<Vec<_>>());
    }
    all.into_iter().map(|(_, sizes)| sizes).collect()
}

/// What is added to the fitted coefficients when all sizes are free.
struct Free {
    coefficients: DVector<f64>,
    covariance: DMatrix<f64>,
}

/// What is added when some are held at 0.
struct Held {
    at_zero: usize,
    coefficients: DVector<f64>,
    variances: DVector<f64>,
    /// Twice the log likelihood that holding them costs.
    lost: f64,
}

impl Free {
    fn of(problem: &Problem, state: &State, columns: &Columns) -> Self {
        let linear = Rows::of(problem, state, columns).fit(&state.fit.noises).linear;
        let coefficients = DVector::from_vec(linear.coefficients);
        Self { coefficients, covariance: linear.covariance }
    }

    /// A normal law under the condition that what is not in use is 0; `None` where the data do not tell it.
    fn with(&self, sizes: &[Size]) -> Option<Held> {
        let held: Vec<&Size> = sizes.iter().filter(|size| !size.is_used).collect();
        let columns: Vec<usize> = held.iter().map(|size| size.column).collect();
        let fitted = DVector::from_iterator(held.len(), held.iter().map(|size| size.fitted));
        let too_much = self.coefficients.select_rows(&columns) + fitted;
        let shared = self.covariance.select_columns(&columns);
        let inner = shared.select_rows(&columns).cholesky()?;
        let lost = too_much.dot(&inner.solve(&too_much));
        let coefficients = &self.coefficients - &shared * inner.solve(&too_much);
        let explained = &shared * inner.solve(&shared.transpose());
        let variances = (&self.covariance - explained).diagonal();
        Some(Held { at_zero: held.len(), coefficients, variances, lost })
    }
}
