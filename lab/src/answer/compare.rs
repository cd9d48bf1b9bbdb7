//! Where a model and a measurement part: size, noise, and every coordinate it could follow.

use helixlock_plant::prediction::Sensor;

use super::far_readings::{FarReadings, far_readings};
use super::loud_passes::{LoudPass, loud_passes};
use crate::doubts::{Doubt, doubts};
use crate::hypotheses::{
    Structure, above_flaws, all_structures, no_all_clear, no_larger_than, taken_for_noise,
};
use crate::model::{Problem, State};
use crate::noise::{Noise, effective_samples, rms};
use crate::numerics::{count, mean, median, spread};
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::extent::COMPARED_ROWS;
use crate::spectrum::{NamedLine, amplitude_spectrum, lines};

/// Size of a residual in one pass.
#[derive(Debug, Clone, PartialEq)]
pub struct PassSize {
    /// Name of the pass in the file.
    pub pass: f64,
    /// Samples.
    pub samples: usize,
    /// Root mean square about the pass's own zero.
    pub rms_um: f64,
    /// Peak to peak.
    pub peak_to_peak_um: f64,
}

/// Noise in the units of the chain.
#[derive(Debug, Clone)]
pub struct NoiseSize {
    /// Standard deviation of its white part.
    pub white_um: f64,
    /// Its slow parts.
    pub slow: Vec<SlowSize>,
}

/// A slow part of noise.
#[derive(Debug, Clone, Copy)]
pub struct SlowSize {
    /// Standard deviation.
    pub rms_um: f64,
    /// Time over which it stays alike, s.
    pub correlation_s: f64,
}

/// One sensor's residual.
#[derive(Debug, Clone)]
pub struct SensorResidual {
    /// The sensor.
    pub sensor: Sensor,
    /// Samples.
    pub samples: usize,
    /// Samples' worth of independent information about a mean.
    pub effective_samples: f64,
    /// Root mean square about the zero of each pass.
    pub rms_um: f64,
    /// Largest peak to peak of a pass.
    pub peak_to_peak_um: f64,
    /// Size in each pass.
    pub passes: Vec<PassSize>,
    /// The noise that fits best the samples looked at.
    pub noise: NoiseSize,
    /// Samples looked at: all, or means of neighbours where there are very many.
    pub looked_at: usize,
    /// Outliers that were weighed down.
    pub outliers: usize,
    /// Order and amplitude over the spindle angle.
    pub spectrum: Vec<[f64; 2]>,
}

/// A comparison of a model with a measurement.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// What looks mistaken in the data or the machine file, clearest first.
    pub doubts: Vec<Doubt>,
    /// One entry a sensor.
    pub sensors: Vec<SensorResidual>,
    /// Readings that lie far from the rest and weigh little, if there are any.
    pub far_readings: Option<FarReadings>,
    /// Passes that weigh less.
    pub loud_passes: Vec<LoudPass>,
    /// Everything that was looked along, clearest first; chances count all looks. A smooth curve
    /// that cannot be told from slow noise stands before all.
    pub along: Vec<Structure>,
    /// Lines over the spindle angle, named where the machine file knows them.
    pub lines: Vec<NamedLine>,
    /// Chance that the residual is noise alone: that of its clearest structure.
    pub noise_p_value: f64,
    /// True when no shape stands out of noise; a named effect, which is one of fewer looks, yet may.
    pub noise_only: bool,
    /// The residual, row by row.
    pub residual: Vec<f64>,
}

impl Comparison {
    /// True when structure is beyond chance; what is not may be a curve that no noise is told from.
    #[must_use]
    pub fn is_beyond_chance(&self) -> bool {
        self.noise_p_value <= SIGNIFICANCE
    }
}

/// Compares a model with a measurement.
///
/// Sizes are those of all samples; noise and structure are looked for in at most some
/// thirty thousand, means of neighbours where there are more.
#[must_use]
pub fn compare(problem: &Problem) -> Comparison {
    let compared = compared(problem);
    let doubts = doubts(problem);
    Comparison { doubts, ..compared }
}

/// The comparison without doubts.
fn compared(problem: &Problem) -> Comparison {
    let thinned = problem.thinned(COMPARED_ROWS);
    let small = thinned.as_ref().unwrap_or(problem);
    let state = State::bare(small);
    let mut along = all_structures(small, &state.columns, &state.fit);
    along.retain(|one| SIGNIFICANCE < one.p_value || above_flaws(small, &state.fit, one));
    let noise_p_value = along.first().map_or(1.0, |first| first.p_value);
    let by_chance = SIGNIFICANCE < noise_p_value;
    let slow = || by_chance.then(|| no_all_clear(small, &state, &[])).flatten();
    let taken = taken_for_noise(small, &state.fit, &along).or_else(slow);
    let noise_only = by_chance && taken.is_none();
    along.splice(..0, taken);
    no_larger_than(rms(&small.layout, &state.fit.left), &mut along);
    let residual = problem.residual();
    let sensors = (0..problem.sensors.len())
        .map(|sensor| sensor_residual(problem, (small, &state), &residual, sensor))
        .collect();
    Comparison {
        doubts: Vec::new(),
        sensors,
        far_readings: far_readings(problem, &residual),
        loud_passes: loud_passes(problem),
        lines: lines(small, &state.columns, &state.fit),
        noise_only,
        noise_p_value,
        along,
        residual,
    }
}

fn sensor_residual(
    problem: &Problem,
    (small, state): (&Problem, &State),
    residual: &[f64],
    sensor: usize,
) -> SensorResidual {
    let blocks = || problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
    let passes: Vec<PassSize> = blocks()
        .map(|block| {
            let part = &residual[block.rows.clone()];
            let samples = part.len();
            let mean = mean(part);
            let square: f64 = part.iter().map(|value| (value - mean) * (value - mean)).sum();
            PassSize {
                pass: problem.measurement.pass_names[block.pass],
                samples,
                rms_um: (square / count(samples)).sqrt(),
                peak_to_peak_um: spread(part),
            }
        })
        .collect();
    let samples: usize = passes.iter().map(|pass| pass.samples).sum();
    let (layout, rows) = small.layout.of_sensor(sensor);
    let square: f64 =
        passes.iter().map(|pass| pass.rms_um * pass.rms_um * count(pass.samples)).sum();
    let rms_um = (square / count(samples.max(1))).sqrt();
    let smaller = (rms_um / rms(&layout, &state.fit.left[rows]).max(f64::MIN_POSITIVE)).powi(2);
    let told = problem.told_variances();
    SensorResidual {
        sensor: problem.sensors[sensor],
        samples,
        effective_samples: smaller * effective_samples(&layout, &state.fit.noises[sensor]),
        rms_um,
        peak_to_peak_um: passes.iter().map(|pass| pass.peak_to_peak_um).fold(0.0, f64::max),
        passes,
        noise: noise_size(&state.fit.noises[sensor], interval_s(small)),
        looked_at: layout.len(),
        outliers: blocks()
            .flat_map(|block| block.rows.clone())
            .filter(|&row| told[row] < problem.layout.inflation[row])
            .count(),
        spectrum: amplitude_spectrum(problem, residual, sensor),
    }
}

fn noise_size(noise: &Noise, interval_s: f64) -> NoiseSize {
    let slow = noise.slow.iter().map(|part| SlowSize {
        rms_um: part.variance.sqrt(),
        correlation_s: part.length * interval_s,
    });
    NoiseSize { white_um: noise.white.sqrt(), slow: slow.collect() }
}

fn interval_s(problem: &Problem) -> f64 {
    let mut intervals: Vec<f64> = problem
        .record
        .time_s
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|interval| 0.0 < *interval)
        .collect();
    median(&mut intervals)
}
