//! What a model gains by a feature: quickly, since thousands are asked. The readings, what the model has and each feature
//! meet weighted by the inverse of the covariance, where a feature is not zero (de Jong and Penzer, see above).

use super::feature::Feature;
use super::features::{CLOSELY, HALVINGS, Priced};
use super::{Banded, Beside, Model, Whitened};
use crate::number::{dot, long_dot, number};

/// What a model gains by features.
pub(super) struct Gains<'a> {
    whitened: &'a Whitened<'a>,
    beside: &'a Beside,
    /// What the model leaves of the readings; that and its columns, weighted.
    pub(super) left: Vec<f64>,
    weighted: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

/// A column of a feature, where it is not zero.
struct Part {
    from: usize,
    values: Vec<f64>,
    white: Vec<f64>,
    /// With the weighted columns of the model.
    shared: Vec<f64>,
}

impl<'a> Gains<'a> {
    pub(super) fn of(model: Model, whitened: &'a Whitened<'a>, beside: &'a Beside) -> Self {
        let left = whitened.left(beside);
        let mut weighted = whitened.weighted(&whitened.readings.values);
        let columns = whitened.readings.beside(model.process).take(beside.best.len());
        let columns: Vec<Vec<f64>> = columns.map(|column| whitened.weighted(column)).collect();
        for (column, size) in columns.iter().zip(&beside.best) {
            for (value, part) in weighted.iter_mut().zip(column) {
                *value -= size * part;
            }
        }
        Self { whitened, beside, left, weighted, columns }
    }

    /// The feature that is gained most by, and the price of all.
    pub(super) fn best(&self, features: Vec<Feature>) -> Option<Priced> {
        let price = libm::log(number(features.len().max(1)));
        let gains = features.into_iter().map(|one| (self.gain(one, 1), (one, price)));
        gains.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, priced)| priced)
    }

    /// The bump that is gained most by, by so many of its columns at first, those that are looked at closely, and
    /// the price of all.
    pub(super) fn bump(&self, bumps: Vec<Feature>, columns: usize) -> Option<Priced> {
        let price = libm::log(number(bumps.len().max(1)));
        let mut gains: Vec<(f64, Feature)> =
            bumps.into_iter().map(|one| (self.gain(one, columns), one)).collect();
        gains.sort_by(|one, other| other.0.total_cmp(&one.0));
        let most = gains.into_iter().take(CLOSELY).map(|(_, bump)| bump);
        self.closely(most.collect()).map(|bump| (bump, price))
    }

    /// The best wave of a turn that swells, one of so many.
    pub(super) fn swelling(&self, (waves, tried): (Vec<Feature>, f64)) -> Option<Priced> {
        self.closely(waves).map(|wave| (wave, libm::log(tried)))
    }

    /// The best wave, its size even and growing, the one or the other of so many.
    pub(super) fn waves(&self, (waves, tried): (Vec<Feature>, f64)) -> Vec<Priced> {
        let Some(Feature::Wave(waves, _)) = self.closely(waves) else { return Vec::new() };
        let sizes = self.sizes(Feature::Wave(waves, 0.0), 2).1;
        let phase = libm::atan2(sizes[1], sizes[0]);
        let price = libm::log(2.0 * tried);
        [Feature::Wave(waves, phase), Feature::Growing(waves)].map(|wave| (wave, price)).to_vec()
    }

    /// The best of features and their neighbours.
    pub(super) fn closely(&self, features: Vec<Feature>) -> Option<Feature> {
        let closer = |feature: Feature| {
            let mut best = (self.gain(feature, feature.telling()), feature);
            for halving in 1..=HALVINGS {
                for feature in best.1.neighbours(halving) {
                    let found = self.gain(feature, feature.telling());
                    if best.0 < found {
                        best = (found, feature);
                    }
                }
            }
            best
        };
        let all = features.into_iter().map(closer);
        all.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, feature)| feature)
    }

    /// What the log likelihood gains by the first columns of a feature beside those of the model.
    fn gain(&self, feature: Feature, columns: usize) -> f64 {
        let (along, sizes) = self.sizes(feature, columns);
        0.5 * dot(&along, &sizes)
    }

    /// What the readings are along the first columns of a feature beside those of the model, and their sizes.
    fn sizes(&self, feature: Feature, columns: usize) -> (Vec<f64>, Vec<f64>) {
        let readings = self.whitened.readings;
        let columns = feature.columns(readings).into_iter().take(columns);
        let parts: Vec<Part> = columns.map(|column| self.part(&column)).collect();
        let along: Vec<f64> = parts.iter().map(|part| part.with(&self.weighted)).collect();
        let mut own = Banded::zeros(parts.len(), parts.len().saturating_sub(1));
        for (row, part) in parts.iter().enumerate() {
            let told = self.beside.precision.solve(&part.shared);
            for (column, other) in parts.iter().take(row + 1).enumerate() {
                let size = if column == row { 1.0 / readings.of_curve } else { 0.0 };
                let from = part.from.max(other.from);
                let together =
                    long_dot(&part.white[from - part.from..], &other.white[from - other.from..]);
                own.add(row, column, together - dot(&told, &other.shared) + size);
            }
        }
        let sizes = own.factor().map_or_else(|| vec![0.0; along.len()], |own| own.solve(&along));
        (along, sizes)
    }

    fn part(&self, column: &[f64]) -> Part {
        let from = column.iter().position(|value| *value != 0.0).unwrap_or(0);
        let to = column.iter().rposition(|value| *value != 0.0).unwrap_or(0);
        let white = self.whitened.white(from, &column[from..]);
        let mut part = Part { from, values: column[from..=to].to_vec(), white, shared: Vec::new() };
        part.shared = self.columns.iter().map(|weighted| part.with(weighted)).collect();
        part
    }
}

impl Part {
    fn with(&self, weighted: &[f64]) -> f64 {
        long_dot(&self.values, &weighted[self.from..self.from + self.values.len()])
    }
}
