//! How far noise with heavy tails reaches: the tails are read from the samples themselves.

use statrs::distribution::{Continuous, ContinuousCDF, DiscreteCDF, Poisson, StudentsT};

use crate::model::{Fit, Problem};
use crate::noise::Whitener;
use crate::numerics::count;

/// Degrees of freedom of the tails that noise may have; the last are nearly Gaussian.
const TAILS: [f64; 8] = [2.5, 3.0, 4.0, 5.0, 7.0, 10.0, 20.0, 200.0];

/// Widths of the bulk that are tried, against unit deviation.
const WIDTHS: [f64; 9] = [0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2];

/// Chance that as many of some whitened samples as `reached` lie beyond `limit` deviations, in
/// noise with the tails of those within.
///
/// The samples within are held against Student's law of every tail and width, cut off at the
/// limit; each law says its own chance, and has the weight of its likelihood.
#[must_use]
pub(crate) fn chance_beyond(white: &[f64], limit: f64, reached: usize) -> f64 {
    let within: Vec<f64> = white.iter().copied().filter(|z| z.abs() <= limit).collect();
    let fewer = u64::try_from(reached.max(1)).unwrap_or(u64::MAX) - 1;
    let laws = TAILS.iter().flat_map(|tail| WIDTHS.iter().map(|width| (*width, *tail)));
    let weighed: Vec<(f64, f64)> = laws
        .filter_map(|(width, tail)| {
            let law = StudentsT::new(0.0, width, tail).ok()?;
            let outside = 2.0 * law.sf(limit);
            let inside = libm::log1p(-outside);
            let likelihood: f64 = within.iter().map(|z| law.ln_pdf(*z) - inside).sum();
            let expected = (outside * count(white.len())).max(f64::MIN_POSITIVE);
            Some((likelihood, Poisson::new(expected).map_or(1.0, |law| law.sf(fewer))))
        })
        .collect();
    let best = weighed.iter().map(|(likelihood, _)| *likelihood).fold(f64::NEG_INFINITY, f64::max);
    let weight = |likelihood: f64| libm::exp(likelihood - best);
    let all: f64 = weighed.iter().map(|(likelihood, _)| weight(*likelihood)).sum();
    weighed.iter().map(|(likelihood, chance)| weight(*likelihood) * chance).sum::<f64>() / all
}

/// Chance of what a fit explains more than another when the noise may have tails.
///
/// A slip and a heavy sample of slow noise are alike at the sample where they happen; they differ
/// in all that follow. So either the sample that speaks loudest lies beyond the tails of the
/// others, or what the others gain, judged by `of_gain`, is beyond chance.
#[must_use]
pub(crate) fn chance_with_tails(
    problem: &Problem,
    [before, after]: [&Fit; 2],
    of_gain: impl Fn(f64) -> f64,
) -> f64 {
    let whitener = Whitener::new(&problem.layout, &after.noises);
    let white = |fit: &Fit| whitener.whiten(fit.left.clone());
    let (before, mut after) = (white(before), white(after));
    let taken = |row: usize| before[row] * before[row] - after[row] * after[row];
    let loudest = (0..before.len()).max_by(|&a, &b| taken(a).total_cmp(&taken(b)));
    let Some(row) = loudest else { return 1.0 };
    let by_others = of_gain((0..before.len()).map(taken).sum::<f64>() - taken(row));
    after.swap_remove(row);
    by_others.min(chance_beyond(&after, before[row].abs(), 1))
}
