//! Steps, kinks, waves and bumps that every curve has, since they make the readings more probable.
//!
//! What bends by chance is as rough everywhere: a step, a kink, a wave that goes on, and a bump make it rougher than a
//! screw is beside them, and its widest bands wider. What wanders by chance is slower than it is swift: a wave of a
//! turn that swells again and again, or in one place, makes it wander where it does not. Which is there is asked of
//! what a model leaves; one after the other is taken in, at the price of all places, lengths and widths that it might
//! have had. Of those that are likely one by one the best is not always the best together: each is asked again beside
//! the later ones, and all with the wave of a turn going on evenly and with its size wandering.

use std::f64::consts::TAU;

use super::super::smooth_process::Order;
use super::feature::{Feature, WAVES_A_CYCLE};
use super::gains::Gains;
use super::{A_PAIR, GROWING, Model, Readings, Whitened, evidence, most_probable};
use crate::number::number;

/// The longest wave, in lengths of the travel: a longer one is a bow.
const LONGEST: f64 = 1.0;
/// Tallest of the waves tried that are looked at closely, and halvings of their distance then.
pub(super) const CLOSELY: usize = 2;
pub(super) const HALVINGS: i32 = 4;
/// Widths of bumps, in samples: each twice the last. Chosen: from what three samples show to a sixteenth of a
/// record of a few hundred.
const WIDTHS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// Widths of bursts, in turns: each twice the last. Chosen: from what one turn shows to a sixth of a screw of a
/// hundred turns.
const TURNS: [f64; 5] = [1.0, 2.0, 4.0, 8.0, 16.0];
/// The widest burst, in lengths of the travel: a wider one is a wave that grows or swells.
const WIDEST: f64 = 0.25;
/// Turns that a wave of them takes at least to swell: a swifter one is waves of other lengths.
const TURNS_A_SWELL: f64 = 4.0;
/// Part of its width from bump to bump.
const BUMPS_A_WIDTH: f64 = 1.0;
/// Steps, kinks, waves and bumps, swelling waves of a turn and bursts.
const KINDS: f64 = 6.0;
/// Features that may be worth their price only together. Chosen: of two bumps that are alike the first leaves the
/// curve as rough as it was, and is worth nothing without the second.
const AT_ONCE: usize = 2;

/// A feature, and the logarithm of how many might have been it.
pub(super) type Priced = (Feature, f64);

/// Readings with the features that were taken in so far.
struct Path<'a> {
    bare: &'a Readings,
    /// Whether bumps are asked.
    bumps: bool,
    features: Vec<Priced>,
    readings: Readings,
    /// Means of neighbours, and the models of these.
    few: Readings,
    models: Vec<(Model, f64)>,
}

impl<'a> Path<'a> {
    fn of(bare: &'a Readings, bumps: bool, features: Vec<Priced>) -> Self {
        let all = features.iter();
        let readings = all.fold(bare.clone(), |readings, (feature, _)| readings.with(*feature));
        let few = readings.means_of_neighbours();
        let models = few.roughly_weighed();
        Self { bare, bumps, features, readings, few, models }
    }

    fn with(&self, priced: Priced) -> Self {
        Self::of(self.bare, self.bumps, self.features.iter().copied().chain([priced]).collect())
    }

    /// With every feature where it is likeliest beside the others, which were not there when it was taken in, and
    /// without it if that is worth more.
    fn tuned(mut self) -> Self {
        let model = most_probable(&self.models).0;
        for place in (0..self.features.len()).rev() {
            let mut features = self.features.clone();
            let (feature, price) = features.remove(place);
            let without = Self::of(self.bare, self.bumps, features.clone());
            let tuned = without.few.gains(model, |gains| gains.closely(vec![feature]));
            features.insert(place, (tuned.flatten().unwrap_or(feature), price));
            for other in [without, Self::of(self.bare, self.bumps, features)] {
                if self.worth() < other.worth() {
                    self = other;
                }
            }
        }
        self
    }

    /// How probable it makes the readings, what it was chosen from taken off.
    fn worth(&self) -> f64 {
        evidence(&self.models) - self.features.iter().map(|(_, price)| price).sum::<f64>()
    }

    /// With a wave of a turn that wanders, if that is worth more.
    fn wandering(&self) -> Option<Self> {
        let wandering = self.with(self.few.wandering(most_probable(&self.models).0)?);
        (self.worth() < wandering.worth()).then_some(wandering)
    }

    /// The path to its end: with every feature that is worth its price.
    fn followed(self) -> Self {
        let mut path = self;
        while let Some(more) = path.with_more(path.worth(), AT_ONCE) {
            path = more;
        }
        path.tuned()
    }

    /// With the feature that is worth most, if that is more than a bar; or with the one that is so before its
    /// price and others, so many at once, if these are.
    fn with_more(&self, bar: f64, at_once: usize) -> Option<Self> {
        let features = self.few.likeliest(most_probable(&self.models).0, self.bumps);
        let most = |worth: fn(&(f64, Priced)) -> f64| {
            let all = features.iter();
            all.max_by(|one, other| worth(one).total_cmp(&worth(other))).map(|(_, priced)| *priced)
        };
        let worthiest = most(|(evidence, (_, price))| evidence - price)?;
        let more = self.with(worthiest);
        if bar < more.worth() {
            return Some(more);
        }
        let likeliest = most(|(evidence, _)| *evidence).filter(|_| 1 < at_once)?;
        let more = if likeliest == worthiest { more } else { self.with(likeliest) };
        more.with_more(bar, at_once - 1)
    }
}

impl Readings {
    /// With the features that make the readings more probable, and the models beside them.
    pub(super) fn with_features(self) -> (Self, Vec<(Model, f64)>) {
        let begin = Path::of(&self, true, Vec::new());
        // A wave that swells evenly is two waves, of which the first is worth less than one that wanders.
        let wandering = begin.wandering().map(Path::followed);
        let path = begin.followed();
        // Two steps are a short rise, of which the first is worth less than a bump.
        let with_bumps = path.features.iter().any(|(one, _)| matches!(one, Feature::Bump(..)));
        let stepped = with_bumps.then(|| Path::of(&self, false, Vec::new()).followed());
        let path = wandering
            .into_iter()
            .chain(stepped)
            .fold(path, |path, other| if path.worth() < other.worth() { other } else { path });
        let models = path.few.weighed();
        (path.readings, models)
    }

    /// With no more pairs of columns of waves than so many.
    fn of_pairs(&self, pairs: usize) -> Self {
        let mut few = self.clone();
        few.columns.truncate(self.every + A_PAIR * pairs);
        few
    }

    fn with(&self, feature: Feature) -> Self {
        let mut columns = self.columns.clone();
        let new = feature.columns(self);
        let every = self.every + new.len();
        columns.splice(self.every..self.every, new);
        let wandering = if let Feature::Wandering(strength) = feature {
            Some(strength)
        } else {
            self.wandering
        };
        Self {
            places: self.places.clone(),
            values: self.values.clone(),
            columns,
            every,
            wandering,
            ..*self
        }
    }

    /// What is asked of the gains of a model.
    fn gains<T>(&self, model: Model, ask: impl FnOnce(&Gains) -> T) -> Option<T> {
        let whitened = Whitened::of(self, model.process);
        let beside = whitened.beside(model.pairs)?;
        Some(ask(&Gains::of(model, &whitened, &beside)))
    }

    /// Of each kind the one that a model gains most by, and how probable it makes the readings.
    fn likeliest(&self, model: Model, bumps: bool) -> Vec<(f64, Priced)> {
        let at_places = |feature: fn(f64) -> Feature| -> Vec<Feature> {
            self.places[1..].iter().map(|at| feature(*at)).collect()
        };
        let kinds = self.gains(model, |gains| {
            let one = [Feature::Step, Feature::Kink].map(|kind| gains.best(at_places(kind)));
            let near = [
                gains.bump(if bumps { self.bumps() } else { Vec::new() }, 1),
                gains.bump(self.bursts(), 2),
                gains.swelling(self.swelling(&gains.left)),
            ];
            let waves = gains.waves(self.waves(&gains.left));
            let all = one.into_iter().chain(near).flatten();
            all.chain(waves).collect::<Vec<Priced>>()
        });
        let few = self.of_pairs(model.pairs.max(GROWING));
        let worth = |(feature, price): Priced| {
            let models = few.with(feature).roughly_weighed();
            (evidence(&models), (feature, price + libm::log(KINDS)))
        };
        kinds.into_iter().flatten().map(worth).collect()
    }

    /// The waves that are tallest in what a model leaves, and how many were tried.
    fn waves(&self, left: &[f64]) -> (Vec<Feature>, f64) {
        let most = number(self.places.len()) / super::SAMPLES_A_WAVE;
        let tried = numbers_of_waves(most);
        let tallest = tallest(&tried, |waves| self.power(left, waves));
        (tallest.map(|waves| Feature::Wave(waves, 0.0)).collect(), number(tried.len()))
    }

    /// The same of waves of a turn that swell, by the two waves beside it that they are.
    fn swelling(&self, left: &[f64]) -> (Vec<Feature>, f64) {
        let Some(turn) = self.turn else { return (Vec::new(), 0.0) };
        let turns = 1.0 / turn;
        let tried = numbers_of_waves(turns / TURNS_A_SWELL);
        let beside =
            |swells: f64| self.power(left, turns - swells) + self.power(left, turns + swells);
        let tallest = tallest(&tried, beside).map(Feature::Swelling);
        (tallest.collect(), number(tried.len()))
    }

    /// How tall a wave of so many over the travel is in values, squared.
    fn power(&self, values: &[f64], waves: f64) -> f64 {
        let (mut cosines, mut sines) = (0.0, 0.0);
        for (place, value) in self.places.iter().zip(values) {
            let (sin, cos) = libm::sincos(TAU * waves * place);
            (cosines, sines) = (cosines + value * cos, sines + value * sin);
        }
        cosines * cosines + sines * sines
    }

    /// The strength of a wandering wave of a turn that a model gains most by.
    fn wandering(&self, model: Model) -> Option<Priced> {
        let (from, to) = self.range_within(Order::Second, self.turn?);
        let steps = std::iter::successors(Some(from), |strength| Some(strength + super::STEP));
        let strengths: Vec<f64> = steps.take_while(|strength| *strength < to).collect();
        let price = libm::log(number(strengths.len().max(1)));
        let of_strength = |strength: f64| {
            let feature = Feature::Wandering(libm::exp(strength));
            let found = self.with(feature).evidence_of(model.process, 1.0);
            (most_probable(&found).1, (feature, price))
        };
        let all = strengths.into_iter().map(of_strength);
        all.max_by(|one, other| one.0.total_cmp(&other.0)).map(|(_, priced)| priced)
    }

    fn bumps(&self) -> Vec<Feature> {
        let sample = 1.0 / number(self.places.len());
        let of_width = |width: f64| places(width).map(move |at| Feature::Bump(at, width));
        WIDTHS.iter().flat_map(|width| of_width(width * sample)).collect()
    }

    fn bursts(&self) -> Vec<Feature> {
        let Some(turn) = self.turn else { return Vec::new() };
        let of_width = |width: f64| places(width).map(move |at| Feature::Burst(at, width));
        let widths = TURNS.iter().map(|turns| turns * turn).take_while(|width| *width < WIDEST);
        widths.flat_map(of_width).collect()
    }
}

/// Where bumps of a width are tried.
fn places(width: f64) -> impl Iterator<Item = f64> {
    let bumps = (0..).map(move |bump| (number(bump) / BUMPS_A_WIDTH + 0.5) * width);
    bumps.take_while(|at| *at < 1.0)
}

/// Numbers of waves over the travel that are tried, up to the most.
fn numbers_of_waves(most: f64) -> Vec<f64> {
    let waves = (0..).map(|step| 1.0 / LONGEST + number(step) / WAVES_A_CYCLE);
    waves.take_while(|waves| *waves < most).collect()
}

/// Those of the greatest power.
fn tallest(tried: &[f64], power: impl Fn(f64) -> f64) -> impl Iterator<Item = f64> {
    let mut powers: Vec<(f64, f64)> = tried.iter().map(|waves| (power(*waves), *waves)).collect();
    powers.sort_by(|one, other| other.0.total_cmp(&one.0));
    powers.into_iter().take(CLOSELY).map(|(_, waves)| waves)
}
