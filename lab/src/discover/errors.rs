//! Standard errors of a formula's parameters from the likelihood itself, which steps and relays
//! have and slopes of theirs have not.

use helixlock_plant::{Column, Parameter};

use crate::hypotheses::Likelihood;
use crate::model::{Problem, State};
use crate::noise::{about_means, rms};

/// Strongest correlation of two parameters that is told from a full one.
const STRONGEST: f64 = 0.9995;

/// Standard error of every parameter of a component, in their order; `None` where the data do not
/// hold it.
#[must_use]
pub(super) fn errors(problem: &Problem, state: &State, index: usize) -> Vec<Option<f64>> {
    let component = &state.components[index];
    let Some(likelihood) = Likelihood::of(problem, state, index) else { return Vec::new() };
    let (nonlinear, linear) = likelihood.errors(component.term.nonlinear_indices().len());
    let columns = component.design(problem).map_or_else(|_| Vec::new(), |(all, _)| all.columns);
    let all_um = rms(&problem.layout, &problem.residual());
    // An error that moves the curve by more than all there is says that others draw it as well, and so does
    // none at all: what others draw has no fit.
    let held = |(stderr, column): (f64, &Column)| {
        let moved_um = stderr * rms(&problem.layout, &about_means(&problem.layout, column));
        (0.0 < stderr && moved_um < all_um).then_some(stderr)
    };
    let (mut linear, mut nonlinear) =
        (linear.into_iter().zip(&columns).map(held), nonlinear.into_iter());
    let of_next = |is_nonlinear: bool| {
        if is_nonlinear { nonlinear.next().flatten() } else { linear.next().flatten() }
    };
    let parameters = component.term.parameters.iter();
    parameters.map(Parameter::is_nonlinear).map(of_next).collect()
}

impl Likelihood<'_> {
    /// Those of so many nonlinear values, `None` where nothing holds one, and of the sizes beside them.
    ///
    /// One or two are summed up over their likelihood, which where a root begins or a tooth ends is no parabola.
    fn errors(&self, number: usize) -> (Vec<Option<f64>>, Vec<f64>) {
        if let Some(summed_up) = self.deviations() {
            return (summed_up.nonlinear.into_iter().map(Some).collect(), summed_up.linear);
        }
        let sizes: Vec<Option<f64>> = (0..number).map(|place| self.size(place)).collect();
        let together = self.correlated(&sizes);
        let linear = self.linear(&sizes, &together);
        let mut own = (0..).map(|place| together[place][place].max(0.0).sqrt());
        let held = sizes.into_iter().map(|size| Some(size? * own.next()?));
        (held.collect(), linear)
    }

    /// Covariance of the nonlinear values in units of those sizes.
    fn correlated(&self, sizes: &[Option<f64>]) -> Vec<Vec<f64>> {
        let held: Vec<(usize, f64)> =
            sizes.iter().enumerate().filter_map(|(i, size)| size.map(|size| (i, size))).collect();
        let mut curvature = nalgebra::DMatrix::identity(held.len(), held.len());
        for row in 0..held.len() {
            for column in 0..row {
                let ((i, a), (j, b)) = (held[row], held[column]);
                let at = |x: f64, y: f64| self.loss(&[(i, 0.5 * x * a), (j, 0.5 * y * b)]);
                let mixed = at(1.0, 1.0) + at(-1.0, -1.0) - at(1.0, -1.0) - at(-1.0, 1.0);
                let mixed = if mixed.is_finite() { 0.5 * mixed } else { 0.0 };
                curvature[(row, column)] = mixed.clamp(-STRONGEST, STRONGEST);
                curvature[(column, row)] = curvature[(row, column)];
            }
        }
        let inverse = curvature.try_inverse();
        let one = |row: usize, column: usize| f64::from(u8::from(row == column));
        let of = |row, column| match &inverse {
            // The error with the others held is the least it can be.
            Some(inverse) if row == column => inverse[(row, column)].max(1.0),
            Some(inverse) => inverse[(row, column)],
            None => one(row, column),
        };
        (0..held.len()).map(|row| (0..held.len()).map(|column| of(row, column)).collect()).collect()
    }

    /// Standard errors of the coefficients, the nonlinear values free.
    fn linear(&self, sizes: &[Option<f64>], nonlinear: &[Vec<f64>]) -> Vec<f64> {
        let held = sizes.iter().enumerate().filter_map(|(i, size)| size.map(|size| (i, size)));
        let slopes: Vec<Vec<f64>> = held
            .map(|(place, size)| {
                let of = |by: f64| self.moved(&[(place, by)]).map(|gain| gain.fit.coefficients);
                let (up, down) = (of(size), of(-size));
                let pairs = up.iter().flatten().zip(down.iter().flatten());
                pairs.map(|(up, down)| 0.5 * (up - down)).collect()
            })
            .collect();
        let fixed = &self.best.fit.covariance;
        let of = |column: usize| {
            let slope = |place: usize| slopes[place].get(column).copied().unwrap_or_default();
            let moved: f64 = (0..slopes.len())
                .flat_map(|a| (0..slopes.len()).map(move |b| (a, b)))
                .map(|(a, b)| slope(a) * nonlinear[a][b] * slope(b))
                .sum();
            (fixed[(column, column)] + moved.max(0.0)).max(0.0).sqrt()
        };
        (0..self.best.fit.coefficients.len()).map(of).collect()
    }
}
