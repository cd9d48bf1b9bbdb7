//! Does ±1.96 u hold the true band as often as it says? Screws and noise are drawn; truth is known.

use std::f64::consts::{PI, TAU};

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal, StandardNormal};

use super::{
    Characteristic, Curve, Weighting, evaluate_travel, helical_characteristics,
    pitch_characteristics, without_reading_noise,
};

/// What kind of screw is drawn: 600 mm, lead 6 mm, eight samples a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Screw {
    /// A wave of 470 mm and one of a turn.
    Waves,
    /// A deviation that wanders.
    Wandering,
    /// A bow, and a small wave of a turn.
    Bowed,
    /// One long wave, nothing within a turn.
    Smooth,
    /// A step somewhere, and a small wave of a turn.
    Stepped,
    /// A long wave, and one of a turn that grows along the travel.
    Growing,
    /// A wave of 80 mm, and one of a turn.
    Medium,
    /// A long wave, one of a turn, and one of 10 mm, the lead of the grinder's own screw.
    Grinder,
    /// A long wave, and one of a turn that swells and falls over 150 mm.
    Swelling,
    /// A long wave, and one of a turn that is three times as tall within 100 mm somewhere.
    Burst,
    /// A long wave, one of a turn, and two bumps.
    Bumps,
    /// Too long by up to 0.1 µm/mm, or too short, with the waves of the first.
    TooLong,
}

impl Screw {
    /// All kinds, in the order of the table.
    pub const ALL: [Self; 12] = [
        Self::Waves,
        Self::Wandering,
        Self::Bowed,
        Self::Smooth,
        Self::Stepped,
        Self::Growing,
        Self::Medium,
        Self::Grinder,
        Self::Swelling,
        Self::Burst,
        Self::Bumps,
        Self::TooLong,
    ];

    /// The screw in words, as the table of coverage has it.
    #[must_use]
    pub fn in_words(self) -> &'static str {
        match self {
            Self::Waves => "waves of 470 mm and of a turn",
            Self::Wandering => "wanders, with a wave of a turn",
            Self::Bowed => "bowed, with a small wave of a turn",
            Self::Smooth => "one long wave, nothing within a turn",
            Self::Stepped => "a step of 1.5 µm, with a small wave of a turn",
            Self::Growing => "a wave of 470 mm, one of a turn that grows",
            Self::Medium => "waves of 80 mm and of a turn",
            Self::Grinder => "waves of 350 mm, 10 mm and of a turn",
            Self::Swelling => "a wave of 470 mm, one of a turn that swells over 150 mm",
            Self::Burst => "a wave of 470 mm, one of a turn with a burst over 100 mm",
            Self::Bumps => "waves of 470 mm and of a turn, two bumps of 1.5 µm",
            Self::TooLong => "too long or too short, with waves of 470 mm and of a turn",
        }
    }

    fn drawn(self, random: &mut ChaCha8Rng) -> Curve {
        let travel_mm: Vec<f64> = (0..=800).map(|k| f64::from(k) * 0.75).collect();
        let [long, short] = [0, 1].map(|_| random.random_range(0.0..TAU));
        let [more, other] =
            if matches!(self, Self::Grinder | Self::Swelling | Self::Burst | Self::Bumps) {
                [0, 1].map(|_| random.random_range(0.0..TAU))
            } else {
                [0.0; 2]
            };
        let wave = |x: f64, mm: f64, phase: f64| libm::sin(TAU * x / mm + phase);
        // Somewhere in the middle 500 mm, two thirds of their height within 5 mm.
        let bump =
            |x: f64, at: f64| 1.5 * libm::exp(-((x - 50.0 - 500.0 * at / TAU) / 8.0).powi(2));
        let mut wandered = 0.0;
        let slope = if self == Self::TooLong { random.random_range(-0.1..0.1) } else { 0.0 };
        let deviation_um: Vec<f64> = travel_mm
            .iter()
            .map(|x| {
                let step: f64 = StandardNormal.sample(random);
                wandered += 0.1 * step;
                let turn = libm::sin(TAU * x / 6.0 + short);
                match self {
                    Self::Medium => 1.5 * wave(*x, 80.0, long) + 0.5 * turn,
                    Self::Grinder => {
                        2.0 * wave(*x, 350.0, long) + 0.6 * wave(*x, 10.0, more) + 0.5 * turn
                    }
                    Self::Swelling => {
                        let swell = 1.0 + 0.5 * wave(*x, 150.0, more);
                        2.0 * wave(*x, 470.0, long) + 0.8 * swell * turn
                    }
                    Self::Burst => {
                        let off = (x - 50.0 - 500.0 * more / TAU) / 50.0;
                        let burst = if off.abs() < 1.0 { 1.0 + libm::cos(PI * off) } else { 0.0 };
                        2.0 * wave(*x, 470.0, long) + 0.4 * (1.0 + burst) * turn
                    }
                    Self::Bumps => {
                        let both = bump(*x, more) + bump(*x, other);
                        2.0 * wave(*x, 470.0, long) + 0.5 * turn + both
                    }
                    Self::Waves | Self::TooLong => {
                        slope * x + 3.0 * libm::sin(TAU * x / 470.0 + long) + 0.8 * turn
                    }
                    Self::Wandering => wandered + 0.5 * turn,
                    Self::Bowed => 1e-5 * (x - 300.0) * (x - 300.0) + 0.3 * turn,
                    Self::Smooth => 4.0 * libm::sin(TAU * x / 1200.0 + long),
                    // The step is as far along as the phase of the other screws' long wave.
                    Self::Stepped => 0.3 * turn + if *x < 600.0 * long / TAU { 0.0 } else { 1.5 },
                    Self::Growing => 3.0 * libm::sin(TAU * x / 470.0 + long) + x / 750.0 * turn,
                }
            })
            .collect();
        Curve::new(&travel_mm, &deviation_um).expect("the travel goes one way")
    }
}

/// How a characteristic came out, on average.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coverage {
    /// Its symbol.
    pub symbol: &'static str,
    /// What noise adds to its size as measured, µm.
    pub widening_um: f64,
    /// What is left of it, µm.
    pub left_um: f64,
    /// Standard uncertainty, µm.
    pub uncertainty_um: f64,
    /// Share of the records whose truth ±1.96 u holds.
    pub held: f64,
}

/// Of ISO 3408-3 and of JB/T 2886: what is linear in the readings, and what noise widens over long and short.
const SHOWN: [&str; 6] = ["e", "V300", "V2π", "ΔL300", "ΔLu", "ΔP"];

/// Draws so many screws and records of them with noise of a standard deviation, in µm; how their
/// figures came out.
///
/// # Panics
///
/// When `noise_um` is not a finite size.
#[must_use]
pub fn coverage(screw: Screw, noise_um: f64, records: u32, seed: u64) -> Vec<Coverage> {
    let size = |curve: &Curve| -> Vec<f64> {
        let all = characteristics(curve);
        all.iter().filter_map(|one| one.reached.ok()).map(|found| found.value_um.abs()).collect()
    };
    let noise = Normal::new(0.0, noise_um).expect("noise is a finite size");
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let none =
        Coverage { symbol: "", widening_um: 0.0, left_um: 0.0, uncertainty_um: 0.0, held: 0.0 };
    let mut all = SHOWN.map(|symbol| Coverage { symbol, ..none });
    let share = 1.0 / f64::from(records);
    for record in 0..records {
        let curve = screw.drawn(&mut random);
        let measured = curve.changed(|deviation_um| deviation_um + noise.sample(&mut random));
        let seed = seed + u64::from(record);
        let estimates = without_reading_noise(&measured, noise_um, 6.0, seed, &characteristics);
        let found = size(&measured).into_iter().zip(estimates.into_iter().flatten());
        for (one, (truth, (wide, estimate))) in all.iter_mut().zip(size(&curve).iter().zip(found)) {
            let error_um = estimate.size_um - truth;
            one.widening_um += (wide - truth) * share;
            one.left_um += error_um * share;
            one.uncertainty_um += estimate.uncertainty_um * share;
            if error_um.abs() < 1.96 * estimate.uncertainty_um {
                one.held += share;
            }
        }
    }
    all.to_vec()
}

/// Those that are shown, in their order.
fn characteristics(curve: &Curve) -> Vec<Characteristic> {
    let travel = evaluate_travel(curve, 6.0, 0.0, Weighting::Samples).expect("6 mm is a lead");
    let mut all = travel.characteristics.to_vec();
    all.extend(helical_characteristics(curve, 6.0));
    all.extend(pitch_characteristics(curve, 6.0));
    all.retain(|one| SHOWN.contains(&one.symbol));
    all
}
