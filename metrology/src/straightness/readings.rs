//! Repeated readings of three probes, and their combination without the carriage.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::chauvenet::is_outlier;
use super::separated::without_line;
use super::spacing::Spacing;
use crate::Error;
use crate::chance::beyond_chance;
use crate::number::{mean, number};

/// One run along the stroke.
#[derive(Clone, Debug, PartialEq)]
pub struct Repeat {
    /// Readings of each probe, µm; NaN where a reading is missing.
    pub probes_um: [Vec<f64>; 3],
}

/// Repeated runs over the same places.
#[derive(Clone, Debug, PartialEq)]
pub struct Readings {
    /// Carriage position of the first sample, mm.
    pub start_mm: f64,
    /// Sampling step, mm.
    pub step_mm: f64,
    /// The runs, each with the same number of samples.
    pub repeats: Vec<Repeat>,
}

/// A reading that was left out by Chauvenet's criterion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rejected {
    /// Which run, from 0.
    pub repeat: usize,
    /// Which sample, from 0.
    pub sample: usize,
    /// How far it lay from the mean of the runs, µm of `z`.
    pub distance_um: f64,
}

/// The combination `z` of all runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Combined {
    /// Carriage position of the first sample, mm.
    pub start_mm: f64,
    /// Sampling step, mm.
    pub step_mm: f64,
    /// Probe spacings.
    pub spacing: Spacing,
    /// Mean of the runs at each sample, its own mean over the stroke removed, µm.
    pub z_um: Vec<f64>,
    /// The mean that was removed, µm: probe zeros and the bar's parabola, inseparable.
    pub offset_um: f64,
    /// Standard uncertainty of that mean from how the runs' own means differ, more than by the noise
    /// along a run, µm: probes whose zeros drift from run to run. Zero when nothing was repeated.
    pub offset_uncertainty_um: f64,
    /// Standard deviation σ of one `z` about the mean of the runs (equation 12), µm; absent when
    /// nothing was repeated. The document reports ±3σ.
    pub sigma_um: Option<f64>,
    /// Share of the noise of a sample that is its neighbour's, from how the runs differ; none when
    /// nothing was repeated.
    pub correlation: f64,
    /// Mean reading of each probe, µm.
    pub mean_probes_um: [Vec<f64>; 3],
    /// Runs that count, at each sample.
    pub counts: Vec<usize>,
    /// What Chauvenet's criterion took out.
    pub rejected: Vec<Rejected>,
}

impl Combined {
    /// Variance of a mean `z` by the scatter of the runs, µm²: with what their own means, that are
    /// taken off, take of it.
    pub(super) fn variance_of_mean_um2(&self) -> Option<f64> {
        let taken = longer(self.correlation) / number(self.z_um.len());
        Some(self.sigma_um?.powi(2) / (1.0 - taken) / number(*self.counts.iter().min()?))
    }

    /// Standard deviation of one probe's reading, µm, if all three scatter alike.
    #[must_use]
    pub fn sigma_probe_um(&self) -> Option<f64> {
        self.sigma_um.map(|sigma| sigma / self.spacing.combination_noise())
    }
}

impl Readings {
    /// Samples of a run.
    #[must_use]
    pub fn samples(&self) -> usize {
        self.repeats.first().map_or(0, |repeat| repeat.probes_um[0].len())
    }

    /// Combines the probes, rejects outliers, averages the runs.
    ///
    /// # Errors
    ///
    /// When runs or probes differ in length, there are fewer than four samples, the probes span the
    /// stroke or more, a reading is infinite, or a sample has no complete reading in any run.
    pub fn combine(&self, spacing: Spacing) -> Result<Combined, Error> {
        self.check()?;
        let (span, stroke) = (spacing.total(), self.samples() - 1);
        if stroke <= span {
            let (found_mm, stroke_mm) =
                (number(span) * self.step_mm, number(stroke) * self.step_mm);
            return Err(Error::ProbesBeyondStroke { found_mm, stroke_mm });
        }
        let mut z = self.z_of_runs(spacing);
        let unshifted = z.clone();
        // One spike moves the mean of its whole run, so outliers are sought about the median;
        // what is left is then put on its mean, as equation 11 has it.
        align(&mut z, median);
        let rejected = reject(&mut z);
        align(&mut z, mean);
        let samples = self.samples();
        let mut z_um = Vec::with_capacity(samples);
        let mut counts = Vec::with_capacity(samples);
        for sample in 0..samples {
            let (mean, count) = mean_of(&z, sample);
            if count == 0 {
                return Err(Error::NotFinite { row: sample, column: "every reading of a sample" });
            }
            z_um.push(mean);
            counts.push(count);
        }
        let sigma_um = sigma(&z, &z_um);
        let offset_um = mean(&z_um);
        for z in &mut z_um {
            *z -= offset_um;
        }
        let shifts_um = shifts(&z, &unshifted);
        let correlation = sigma_um.map_or(0.0, |_| correlation(&z));
        let offset_uncertainty_um = sigma_um.map_or(0.0, |sigma_um| {
            let of_mean_um = sigma_um * (longer(correlation) / number(samples)).sqrt();
            offset_uncertainty_um(&shifts_um, of_mean_um)
        });
        let mean_probes_um = [0, 1, 2].map(|probe| self.mean_probe(probe, &z));
        let (start_mm, step_mm) = (self.start_mm, self.step_mm);
        Ok(Combined {
            start_mm,
            step_mm,
            spacing,
            z_um,
            offset_um,
            offset_uncertainty_um,
            sigma_um,
            correlation,
            mean_probes_um,
            counts,
            rejected,
        })
    }

    /// What of the carriage's motion does not repeat: standard deviation of the first probe over
    /// the runs, each run's straight line and the probe's own noise taken off, µm.
    ///
    /// The bar is the same in every run, so it does not count. `None` when nothing was repeated
    /// or readings are missing.
    #[must_use]
    pub fn unrepeatable_um(&self, combined: &Combined) -> Option<f64> {
        let runs: Vec<Vec<f64>> =
            self.repeats.iter().map(|repeat| without_line(repeat.probes_um[0].clone())).collect();
        let means: Vec<f64> = (0..self.samples()).map(|sample| mean_of(&runs, sample).0).collect();
        let scatter = sigma(&runs, &means).filter(|scatter| scatter.is_finite())?;
        let probe = combined.sigma_um? / combined.spacing.combination_noise();
        Some((scatter * scatter - probe * probe).max(0.0).sqrt())
    }

    fn check(&self) -> Result<(), Error> {
        let expected = self.samples();
        if expected < 4 {
            return Err(Error::TooFewSamples { found: expected, expected: 4 });
        }
        for probe in self.repeats.iter().flat_map(|repeat| &repeat.probes_um) {
            if probe.len() != expected {
                return Err(Error::ColumnLengths { expected, found: probe.len() });
            }
            if let Some(row) = probe.iter().position(|value| value.is_infinite()) {
                return Err(Error::NotFinite { row, column: "probe" });
            }
        }
        Ok(())
    }

    /// `z` of every run.
    fn z_of_runs(&self, spacing: Spacing) -> Vec<Vec<f64>> {
        let r = spacing.ratio();
        let combine = |repeat: &Repeat| {
            let [first, second, third] = &repeat.probes_um;
            let probes = first.iter().zip(second).zip(third);
            probes.map(|((z1, z2), z3)| z1 - (1.0 + r) * z2 + r * z3).collect()
        };
        self.repeats.iter().map(combine).collect()
    }

    /// Mean of a probe over the runs whose `z` counts at each sample.
    fn mean_probe(&self, probe: usize, z: &[Vec<f64>]) -> Vec<f64> {
        let at = |sample: usize| {
            let known = self.repeats.iter().zip(z).filter(|(_, z)| z[sample].is_finite());
            mean(&known.map(|(repeat, _)| repeat.probes_um[probe][sample]).collect::<Vec<_>>())
        };
        (0..self.samples()).map(at).collect()
    }
}

/// By how much the variance of a mean along a run is larger when a part of each sample's noise is its
/// neighbour's.
fn longer(correlation: f64) -> f64 {
    (1.0 + correlation) / (1.0 - correlation)
}

/// Share of the noise of a sample that is its neighbour's, from what the runs lie from their mean.
///
/// A run of n samples whose own mean is taken off shows (1 + 4·ρ)/n too little of it (Marriott and Pope,
/// Biometrika 41, 1954, 390). What chance makes is none, as probable as it is.
fn correlation(z: &[Vec<f64>]) -> f64 {
    let samples = z.first().map_or(0, Vec::len);
    let means: Vec<f64> = (0..samples).map(|sample| mean_of(z, sample).0).collect();
    let (mut squares, mut products) = (0.0, 0.0);
    for run in z {
        let apart: Vec<f64> = run.iter().zip(&means).map(|(z, mean)| z - mean).collect();
        squares += apart.iter().filter(|um| um.is_finite()).map(|um| um * um).sum::<f64>();
        let pairs = apart.windows(2).map(|pair| pair[0] * pair[1]);
        products += pairs.filter(|product| product.is_finite()).sum::<f64>();
    }
    let length = number(samples);
    if samples < FEWEST_FOR_CORRELATION || squares == 0.0 {
        return 0.0;
    }
    let shown = products / squares * length / (length - 1.0);
    let found = ((shown + 1.0 / length) / (1.0 - 4.0 / length)).clamp(-MOST_ALIKE, MOST_ALIKE);
    let of_chance = 1.0 / (number(z.len() - 1) * length);
    found * beyond_chance(found * found / of_chance, 1.0, 1.0 / of_chance)
}

/// Fewer samples of a run do not show how their noise goes together.
const FEWEST_FOR_CORRELATION: usize = 8;
/// Noise that is more alike along a run is a form of each run.
const MOST_ALIKE: f64 = 0.9;

/// Shifts each run onto the mean of all runs, so that they agree although the carriage started
/// each from another place; `centre` says what of a run's differences has to vanish.
fn align(z: &mut [Vec<f64>], centre: impl Fn(&[f64]) -> f64) {
    let samples = z.first().map_or(0, Vec::len);
    let means: Vec<f64> = (0..samples).map(|sample| mean_of(z, sample).0).collect();
    for run in z {
        let differences = run.iter().zip(&means).map(|(z, mean)| z - mean);
        let known: Vec<f64> = differences.filter(|difference| difference.is_finite()).collect();
        if !known.is_empty() {
            let shift = centre(&known);
            for z in run {
                *z -= shift;
            }
        }
    }
}

/// By how much each run was shifted, of the readings that count.
fn shifts(aligned: &[Vec<f64>], unshifted: &[Vec<f64>]) -> Vec<f64> {
    let shift = |(aligned, unshifted): (&Vec<f64>, &Vec<f64>)| {
        let each = aligned.iter().zip(unshifted).map(|(to, from)| from - to);
        mean(&each.filter(|shift| shift.is_finite()).collect::<Vec<_>>())
    };
    aligned.iter().zip(unshifted).map(shift).filter(|shift| shift.is_finite()).collect()
}

/// Standard uncertainty of the mean of the runs' shifts beyond that of `noise_um`, which each has
/// from the noise along it.
///
/// Few runs tell little of it: 1.96 times this is what Student's factor is times the scatter (JCGM
/// 100:2008, G.3).
fn offset_uncertainty_um(shifts_um: &[f64], noise_um: f64) -> f64 {
    let (runs, mean_um) = (number(shifts_um.len()), mean(shifts_um));
    let squares: f64 = shifts_um.iter().map(|shift| (shift - mean_um).powi(2)).sum();
    let beyond_um2 = (squares / (runs - 1.0) - noise_um * noise_um).max(0.0) / runs;
    let student = StudentsT::new(0.0, 1.0, runs - 1.0).map_or(0.0, |one| one.inverse_cdf(0.975));
    beyond_um2.sqrt() * student / 1.96
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    f64::midpoint(sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2])
}

/// Takes outliers out (as NaN) and says which.
///
/// The scatter is that of the whole record (equation 12), so the criterion counts all its
/// readings, and a reading is not judged by the few beside it. Of each sample only the farthest
/// reading goes at a time: it has moved the mean that the others are judged by.
fn reject(z: &mut [Vec<f64>]) -> Vec<Rejected> {
    let samples = z.first().map_or(0, Vec::len);
    let mut rejected = Vec::new();
    for _ in 0..z.len() {
        let means: Vec<f64> = (0..samples).map(|sample| mean_of(z, sample).0).collect();
        let Some(sigma) = sigma(z, &means) else { break };
        let known = z.iter().flatten().filter(|value| value.is_finite()).count();
        let farthest = (0..samples).filter_map(|sample| farthest(z, sample, means[sample]));
        let outlying = farthest.filter(|one| is_outlier(one.distance_um, sigma, known));
        let outlying: Vec<Rejected> = outlying.collect();
        for one in &outlying {
            z[one.repeat][one.sample] = f64::NAN;
        }
        if outlying.is_empty() {
            break;
        }
        rejected.extend(outlying);
    }
    rejected
}

/// The reading of a sample that is farthest from the mean of the runs.
fn farthest(z: &[Vec<f64>], sample: usize, mean_um: f64) -> Option<Rejected> {
    let distances = z.iter().enumerate().map(|(repeat, run)| (repeat, run[sample] - mean_um));
    let known = distances.filter(|(_, distance)| distance.is_finite());
    let (repeat, distance_um) = known.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
    Some(Rejected { repeat, sample, distance_um })
}

/// Equation 12, with the degrees of freedom that rejection leaves.
fn sigma(z: &[Vec<f64>], mean_um: &[f64]) -> Option<f64> {
    let (mut squares, mut known) = (0.0, 0_usize);
    for run in z {
        for distance in run.iter().zip(mean_um).map(|(z, mean)| z - mean).filter(|d| d.is_finite())
        {
            squares += distance * distance;
            known += 1;
        }
    }
    let freedom = known.saturating_sub(mean_um.len());
    (0 < freedom).then(|| (squares / number(freedom)).sqrt())
}

/// Mean of the runs at one sample, and how many runs count.
fn mean_of(z: &[Vec<f64>], sample: usize) -> (f64, usize) {
    let known: Vec<f64> = z.iter().map(|run| run[sample]).filter(|v| v.is_finite()).collect();
    (mean(&known), known.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn readings(spike_um: f64) -> Readings {
        let probe = |repeat: usize, probe: usize| -> Vec<f64> {
            let reading = |sample: usize| {
                // A fixed pattern stands in for noise: its sum over the runs is zero.
                let noise = if (repeat + sample).is_multiple_of(2) { 0.01 } else { -0.01 };
                let spike = if (repeat, probe, sample) == (3, 0, 5) { spike_um } else { 0.0 };
                noise * (number(probe) + 1.0) + spike
            };
            (0..16).map(reading).collect()
        };
        let repeat = |index| Repeat { probes_um: [0, 1, 2].map(|p| probe(index, p)) };
        Readings { start_mm: 0.0, step_mm: 5.0, repeats: (0..10).map(repeat).collect() }
    }

    /// No place of the bar would be touched twice.
    #[test]
    fn probes_that_span_the_stroke_are_refused() {
        assert!(readings(0.0).combine(Spacing { first: 7, second: 7 }).is_ok());
        let error = readings(0.0).combine(Spacing { first: 7, second: 8 }).unwrap_err();
        assert_eq!(error, Error::ProbesBeyondStroke { found_mm: 75.0, stroke_mm: 75.0 });
    }

    #[test]
    fn a_spike_is_rejected_and_named() {
        let combined = readings(1.0).combine(Spacing { first: 1, second: 1 }).unwrap();
        assert_eq!(combined.rejected.len(), 1, "{:?}", combined.rejected);
        assert_eq!((combined.rejected[0].repeat, combined.rejected[0].sample), (3, 5));
        assert_eq!(combined.counts[5], 9);
    }

    #[test]
    fn steps_of_the_carriage_between_runs_do_not_count() {
        let still = readings(0.0).combine(Spacing { first: 1, second: 1 }).unwrap();
        let mut moved = readings(0.0);
        for (index, repeat) in moved.repeats.iter_mut().enumerate() {
            repeat.probes_um[0].iter_mut().for_each(|z| *z += number(index));
        }
        let moved = moved.combine(Spacing { first: 1, second: 1 }).unwrap();
        assert!((still.sigma_um.unwrap() - moved.sigma_um.unwrap()).abs() < 1e-12);
    }
}
