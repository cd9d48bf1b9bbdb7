//! Steps, waves and bumps that every curve has, since they make the readings more probable.
//!
//! What bends by chance is as rough everywhere: a step, a wave that goes on, and a bump make it rougher than a screw is
//! beside them, and its widest bands wider. Which is there is asked of what a model leaves; one after the
//! other is taken in, at the price of all places, lengths and widths that it might have had.

use std::f64::consts::TAU;

use super::{Model, Readings, Whitened, evidence, most_probable};
use crate::number::number;

/// Waves tried, for one that can be told from its neighbour over the travel.
const WAVES_A_CYCLE: f64 = 2.0;
/// The longest wave, in lengths of the travel: a longer one is a bow.
const LONGEST: f64 = 1.0;
/// Tallest of the waves tried that are looked at closely, and halvings of their distance then.
const CLOSELY: usize = 2;
const HALVINGS: i32 = 4;
/// Widths of bumps, in samples: each twice the last. Chosen: from what three samples show to a sixteenth of a
/// record of a few hundred.
const WIDTHS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// Part of its width from bump to bump.
const BUMPS_A_WIDTH: f64 = 1.0;
/// Widths of a bump beyond which nothing of it is left.
const REACH: f64 = 5.0;

/// What a curve may have beside a cubic, waves of a turn, and what bends by chance.
#[derive(Clone, Copy, Debug)]
enum Feature {
    /// From a place on.
    Step(f64),
    /// So many over the travel; with one that grows evenly, as a wave of a length a little off does.
    Wave(f64),
    /// A place and a width.
    Bump(f64, f64),
}

impl Feature {
    fn columns(self, places: &[f64]) -> Vec<Vec<f64>> {
        let column =
            |value: &dyn Fn(f64) -> f64| places.iter().map(|place| value(*place)).collect();
        match self {
            Self::Step(at) => vec![column(&|place| f64::from(u8::from(at <= place)))],
            Self::Bump(at, width) => {
                vec![column(&|place| {
                    let off = (place - at) / width;
                    if off.abs() < REACH { libm::exp(-0.5 * off * off) } else { 0.0 }
                })]
            }
            Self::Wave(waves) => {
                let angle = |place: f64| TAU * waves * (place - 0.5);
                let grows = |place: f64| 2.0 * (place - 0.5);
                vec![
                    column(&|place| libm::cos(angle(place))),
                    column(&|place| libm::sin(angle(place))),
                    column(&|place| grows(place) * libm::cos(angle(place))),
                    column(&|place| grows(place) * libm::sin(angle(place))),
                ]
            }
        }
    }
}

/// A feature, and the logarithm of how many might have been it.
type Priced = (Feature, f64);
/// Readings, the means of their neighbours, and the models of these.
type Weighed = (Readings, Readings, Vec<(Model, f64)>);

impl Readings {
    /// With the features that make the readings more probable, and the models beside them.
    pub(super) fn with_features(self) -> (Self, Vec<(Model, f64)>) {
        let mut few = self.means_of_neighbours();
        let (mut readings, mut models) = (self, few.roughly_weighed());
        while let Some((more, few_more, others)) = readings.with_one_more(&few, &models) {
            (readings, few, models) = (more, few_more, others);
        }
        let models = few.weighed();
        (readings, models)
    }

    /// The likeliest feature that makes the readings more probable, if any does.
    fn with_one_more(&self, few: &Self, models: &[(Model, f64)]) -> Option<Weighed> {
        few.likeliest(most_probable(models).0).into_iter().find_map(|(feature, price)| {
            let more = self.with(feature);
            let few_more = more.means_of_neighbours();
            let others = few_more.roughly_weighed();
            let better = evidence(models) < evidence(&others) - price;
            better.then_some((more, few_more, others))
        })
    }

    fn with(&self, feature: Feature) -> Self {
        let mut columns = self.columns.clone();
        let new = feature.columns(&self.places);
        let every = self.every + new.len();
        columns.splice(self.every..self.every, new);
        Self { places: self.places.clone(), values: self.values.clone(), columns, every, ..*self }
    }

    /// Of each kind the one that a model gains most by, those first that gain most beyond their price.
    fn likeliest(&self, model: Model) -> Vec<Priced> {
        let whitened = Whitened::of(self, model.process);
        let Some(beside) = whitened.beside(model.pairs) else { return Vec::new() };
        let gain = |feature: Feature| -> f64 {
            let columns = feature.columns(&self.places);
            let even: Vec<Vec<f64>> =
                columns.iter().take(2).map(|column| whitened.white(column)).collect();
            whitened.gain(&beside, &even)
        };
        let steps: Vec<Feature> = self.places[1..].iter().map(|at| Feature::Step(*at)).collect();
        let (waves, tried) = self.waves(&whitened.left(&beside), &gain);
        let kinds = [(steps, None), (waves, Some(tried)), (self.bumps(), None)];
        let mut best: Vec<(f64, Priced)> = Vec::new();
        for (kind, tried) in kinds {
            let price = libm::log(tried.unwrap_or(number(kind.len())).max(1.0));
            let gains = kind.into_iter().map(|one| (0.5 * gain(one) - price, (one, price)));
            best.extend(gains.max_by(|one, other| one.0.total_cmp(&other.0)));
        }
        best.retain(|(gain, _)| 0.0 < *gain);
        best.sort_by(|one, other| other.0.total_cmp(&one.0));
        best.into_iter().map(|(_, priced)| priced).collect()
    }

    /// The waves that are tallest in what a model leaves, and how many were tried.
    fn waves(&self, left: &[f64], gain: &dyn Fn(Feature) -> f64) -> (Vec<Feature>, f64) {
        let most = number(self.places.len()) / super::SAMPLES_A_WAVE;
        let tried: Vec<f64> = (0..self.places.len())
            .map(|step| 1.0 / LONGEST + number(step) / WAVES_A_CYCLE)
            .take_while(|waves| *waves < most)
            .collect();
        let power = |waves: &f64| {
            let (mut cosines, mut sines) = (0.0, 0.0);
            for (place, value) in self.places.iter().zip(left) {
                let (sin, cos) = libm::sincos(TAU * waves * place);
                (cosines, sines) = (cosines + value * cos, sines + value * sin);
            }
            (cosines * cosines + sines * sines, *waves)
        };
        let mut powers: Vec<(f64, f64)> = tried.iter().map(power).collect();
        powers.sort_by(|one, other| other.0.total_cmp(&one.0));
        let closer = |(_, waves): &(f64, f64)| {
            let mut best = (gain(Feature::Wave(*waves)), *waves);
            for halving in 1..=HALVINGS {
                let step = libm::ldexp(1.0 / WAVES_A_CYCLE, -halving);
                for waves in [best.1 - step, best.1 + step] {
                    let found = gain(Feature::Wave(waves));
                    if best.0 < found {
                        best = (found, waves);
                    }
                }
            }
            Feature::Wave(best.1)
        };
        let tallest = powers.iter().take(CLOSELY).map(closer).collect();
        (tallest, number(tried.len()))
    }

    fn bumps(&self) -> Vec<Feature> {
        let sample = 1.0 / number(self.places.len());
        let of_width = |width: f64| {
            let bumps = (0..).map(move |bump| (number(bump) / BUMPS_A_WIDTH + 0.5) * width);
            bumps.take_while(|at| *at < 1.0).map(move |at| Feature::Bump(at, width))
        };
        WIDTHS.iter().flat_map(|width| of_width(width * sample)).collect()
    }
}
