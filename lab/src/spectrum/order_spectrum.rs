//! Lines in a residual over any cyclic coordinate, unevenly sampled and under correlated noise.
//!
//! The gain of a frequency is the whitened square that a sine and a cosine take away: twice the
//! log likelihood ratio. A scan by Fourier sums finds the peaks, a fit settles each, and the
//! strongest is taken out before the next is looked for (CLEAN with exact fits).

use std::ops::Range;

use crate::noise::{Layout, Noise, SlowPart, Whitener};
use crate::numerics::least_squares::dot;
use crate::numerics::{count, fourier, golden_maximum, least_squares, spread, usual_rate};
use crate::policy::extent::{ALIKE_WINDOW, SLOWEST_WAVES, WINDOW_FROM};

/// Coordinate, noise and whitened residual of a search for lines.
#[derive(Debug, Clone)]
pub(crate) struct Scan<'a> {
    /// Which rows share a zero and a sensor.
    pub(crate) layout: &'a Layout,
    /// Noise of each sensor.
    pub(crate) noises: &'a [Noise],
    /// Per row: the cyclic coordinate, one period of order 1 a unit.
    pub(crate) turns: &'a [f64],
    /// Per row: what a wave of 1 shows there, by the row's sensor.
    pub(crate) unit: &'a [f64],
    /// Whitening of that noise.
    pub(crate) whitener: &'a Whitener,
    /// Lowest frequency tried, cycles a unit.
    pub(crate) lowest: f64,
    /// Highest frequency tried.
    pub(crate) highest: f64,
}

/// A sinusoid found in a residual.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// Cycles a unit of the coordinate.
    pub frequency: f64,
    /// Its standard error.
    pub frequency_stderr: f64,
    /// Amplitude in the residual's unit.
    pub amplitude: f64,
    /// Its standard error.
    pub amplitude_stderr: f64,
    /// Phase φ of `a·sin(2π·f·u + φ)`, rad.
    pub phase_rad: f64,
    /// Whitened square it takes away.
    pub gain: f64,
    /// Chance of a line as strong anywhere in noise.
    pub p_value: f64,
}

/// One point of a spectrum for the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    /// Cycles a unit of the coordinate.
    pub(crate) frequency: f64,
    /// Amplitude of the best sinusoid there, in the residual's unit, before whitening's share.
    pub(crate) amplitude: f64,
    /// Whitened gain, about χ² with two degrees of freedom in noise.
    pub(crate) gain: f64,
}

/// Scan points a frequency resolution cell; three lose at most a tenth of a peak's gain.
pub(crate) const POINTS_A_CELL: f64 = 3.0;

/// Frequencies on either side up to the lowest at which a wave is compared with slow ones.
const SLOW_STEPS: i8 = 2;

/// Share of the best gain below which a peak of the scan is not settled.
const HOPELESS: f64 = 0.5;

/// Points that are put in order first; a search seldom needs more.
const ORDERED: usize = 512;

/// Most scan points; a scan for more covers the lowest ones.
const MOST_POINTS: usize = 1 << 17;

impl Scan<'_> {
    /// Width of a frequency cell: one over the range of the coordinate.
    #[must_use]
    pub(crate) fn resolution(&self) -> f64 {
        1.0 / spread(self.turns).max(f64::MIN_POSITIVE)
    }

    /// Independent frequencies in the range, at least one.
    #[must_use]
    pub(crate) fn looks(&self) -> f64 {
        (2.0 * (self.highest - self.lowest) / self.resolution()).max(1.0)
    }

    /// Gain and amplitude over the whole range for a whitened residual.
    #[must_use]
    pub(crate) fn spectrum(&self, white: &[f64]) -> Vec<Point> {
        let step = self.resolution() / POINTS_A_CELL;
        let points = self.points(step);
        let weighted = times(self.unit, self.whitener.unwhiten(white));
        let sizes = fourier::sizes(self.turns, &weighted, step, points);
        let stretches = self.stretches();
        let mut spectrum = Vec::with_capacity(points);
        for (index, size) in sizes.iter().enumerate() {
            let frequency = step * count(index);
            if frequency < self.lowest {
                continue;
            }
            let information: f64 = stretches.iter().map(|s| s.information(frequency)).sum();
            let power = size * size / information.max(f64::MIN_POSITIVE);
            let amplitude = size / information.max(f64::MIN_POSITIVE);
            spectrum.push(Point { frequency, amplitude, gain: power });
        }
        spectrum
    }

    /// The strongest frequency of a wave that has a size and a phase of its own in each block, and how many such were
    /// looked at; `None` where fewer than two blocks are long enough for one.
    #[must_use]
    pub(crate) fn strongest_in_each_block(&self, white: &[f64]) -> Option<(f64, f64)> {
        let weighted = times(self.unit, self.whitener.unwhiten(white));
        let blocks = self.stretches();
        let longest = blocks.iter().map(|block| block.turns).fold(0.0, f64::max);
        let lowest = SLOWEST_WAVES / longest.max(f64::MIN_POSITIVE);
        if blocks.len() < 2 || self.highest <= lowest {
            return None;
        }
        let step = 1.0 / (longest * POINTS_A_CELL);
        let points = self.points(step);
        let mut gains = vec![0.0; points];
        for block in &blocks {
            let rows = block.rows.clone();
            let sizes = fourier::sizes(&self.turns[rows.clone()], &weighted[rows], step, points);
            for (index, (gain, size)) in gains.iter_mut().zip(sizes).enumerate() {
                *gain += size * size / block.information(step * count(index));
            }
        }
        let told = gains.iter().enumerate().map(|(index, gain)| (step * count(index), gain));
        let (frequency, _) =
            told.filter(|(frequency, _)| lowest <= *frequency).max_by(|a, b| a.1.total_cmp(b.1))?;
        Some((frequency, (2.0 * (self.highest - lowest) * longest).max(1.0)))
    }

    /// Lines stronger than chance, strongest first, at most `most`.
    ///
    /// `white` is the whitened residual; `significance` the chance of naming one in pure noise.
    /// Each further line is fitted with all before it.
    #[must_use]
    pub(crate) fn lines(&self, white: &[f64], significance: f64, most: usize) -> Vec<Line> {
        let mut lines: Vec<Line> = Vec::new();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let mut left = white.to_vec();
        while lines.len() < most {
            let Some(line) = self.strongest(&left) else { break };
            if significance < line.p_value {
                break;
            }
            columns.extend(self.wave(line.frequency));
            left = remainder(&columns, white);
            lines.push(line);
        }
        lines
    }

    /// True when the samples tell the size of a wave: it is no slow curve in every block, and its
    /// phase there is not always the same.
    #[must_use]
    pub(crate) fn tells(&self, frequency: f64) -> bool {
        self.tells_of(frequency, WINDOW_FROM * usual_rate(self.turns))
    }

    /// The same where all that is slower than a share of the sampling is told.
    fn tells_of(&self, frequency: f64, swift: f64) -> bool {
        let is_slow = swift < frequency && self.is_a_slow_curve(frequency);
        !is_slow && (2.0 * frequency <= swift || !self.has_one_phase(frequency))
    }

    /// The strongest line whose size the samples tell.
    ///
    /// What the samples resolve at their usual rate and what only their unevenness resolves are
    /// looked at one after the other, each paying for its own looks: aliases above would drown a
    /// line below, and their number would cost it its significance.
    #[must_use]
    pub(crate) fn strongest(&self, white: &[f64]) -> Option<Line> {
        let rate = usual_rate(self.turns);
        let is_told = |frequency| self.tells_of(frequency, WINDOW_FROM * rate);
        let usual = (0.5 * rate).max(self.lowest);
        if self.highest <= usual {
            return self.strongest_in_band(white, &is_told);
        }
        let bands =
            [Self { highest: usual, ..self.clone() }, Self { lowest: usual, ..self.clone() }];
        let evidence = |band: &Self, line: &Line| line.gain - 2.0 * libm::log(band.looks());
        let found = bands.iter().filter_map(|band| {
            let line = band.strongest_in_band(white, &is_told)?;
            Some((evidence(band, &line), line))
        });
        let (_, mut line) = found.max_by(|a, b| a.0.total_cmp(&b.0))?;
        line.p_value = anywhere(line.p_value, 2.0);
        Some(line)
    }

    fn strongest_in_band(&self, white: &[f64], is_told: &dyn Fn(f64) -> bool) -> Option<Line> {
        let spectrum = self.spectrum(white);
        let peaks = strongest_first(spectrum);
        let mut tried: Vec<f64> = Vec::new();
        let mut best: Option<(f64, f64)> = None;
        for peak in peaks {
            let known = |other: &f64| (other - peak.frequency).abs() < self.resolution();
            // A scan shows every peak at nine tenths of its gain at least.
            if best.is_some_and(|(_, gain)| peak.gain < HOPELESS * gain) {
                break;
            }
            if tried.iter().any(known) || !is_told(peak.frequency) {
                continue;
            }
            tried.push(peak.frequency);
            let refined = self.settled(white, peak.frequency);
            if best.is_none_or(|(_, gain)| gain < refined.1) {
                best = Some(refined);
            }
            if 3 < tried.len() {
                break;
            }
        }
        best.map(|(frequency, _)| self.line(white, frequency))
    }

    /// True when a frequency as high as the sampling's shows in every block what a wave slower than
    /// the lowest shows there: blocks that begin at different places tell the two apart, but each
    /// has its own zero, which takes the wave away.
    fn is_a_slow_curve(&self, frequency: f64) -> bool {
        let alike = |at: f64| ALIKE_WINDOW < self.window(at);
        (-SLOW_STEPS..=SLOW_STEPS)
            .any(|step| alike(frequency + self.lowest * f64::from(step) / f64::from(SLOW_STEPS)))
    }

    /// True when every sample of a block meets a wave at the same phase or half a turn from it, as at
    /// half the rate of even samples: its size depends on a phase that nothing tells.
    fn has_one_phase(&self, frequency: f64) -> bool {
        ALIKE_WINDOW < self.window(2.0 * frequency)
    }

    /// Spectral window of the blocks, each by itself: 1 where all samples of a block meet a wave at
    /// one phase.
    fn window(&self, frequency: f64) -> f64 {
        let size = |rows: &[f64]| {
            let waves = rows.iter().map(|u| libm::sincos(std::f64::consts::TAU * frequency * u));
            let (sine, cosine) =
                waves.fold((0.0, 0.0), |sum, wave| (sum.0 + wave.0, sum.1 + wave.1));
            libm::hypot(sine, cosine)
        };
        let blocks = self.layout.blocks.iter();
        blocks.map(|block| size(&self.turns[block.rows.clone()])).sum::<f64>()
            / count(self.turns.len().max(1))
    }

    /// Frequency and gain of the peak near a scan point, by golden section.
    #[must_use]
    pub(crate) fn settled(&self, white: &[f64], near: f64) -> (f64, f64) {
        let width = self.resolution() / POINTS_A_CELL;
        let ends = ((near - width).max(0.2 * self.resolution()), near + width);
        let mut gain = |frequency: f64| self.gain(white, frequency);
        golden_maximum(&mut gain, ends, 14)
    }

    /// Gain of a sinusoid of one frequency.
    #[must_use]
    pub(crate) fn gain(&self, white: &[f64], frequency: f64) -> f64 {
        let wave = self.wave(frequency);
        let total = dot(white, white);
        total - least_squares::fit(&[&wave[0], &wave[1]], white).residual_square
    }

    /// Whitened sine and cosine.
    #[must_use]
    pub(crate) fn wave(&self, frequency: f64) -> [Vec<f64>; 2] {
        let pairs = self.turns.iter().map(|u| libm::sincos(std::f64::consts::TAU * frequency * u));
        let (sine, cosine): (Vec<f64>, Vec<f64>) = pairs.unzip();
        let [sine, cosine] = [sine, cosine].map(|part| times(self.unit, part));
        let white = self.whitener.whiten_all(&[&sine, &cosine]);
        <[Vec<f64>; 2]>::try_from(white).unwrap_or_default()
    }

    /// What waves show at every row: a sine and a cosine of each frequency in its turn.
    #[must_use]
    pub(crate) fn shown(&self, frequencies: impl Iterator<Item = f64>, sizes: &[f64]) -> Vec<f64> {
        let mut shown = vec![0.0; self.turns.len()];
        for (frequency, sizes) in frequencies.zip(sizes.chunks_exact(2)) {
            for (value, u) in shown.iter_mut().zip(self.turns) {
                let (sine, cosine) = libm::sincos(std::f64::consts::TAU * frequency * u);
                *value += sizes[0] * sine + sizes[1] * cosine;
            }
        }
        times(self.unit, shown)
    }

    /// Amplitude, phase and all standard errors of the sinusoid at a settled frequency.
    #[must_use]
    pub(crate) fn line(&self, white: &[f64], frequency: f64) -> Line {
        let wave = self.wave(frequency);
        let flat = least_squares::fit(&[&wave[0], &wave[1]], white);
        let (sine, cosine) = (flat.coefficients[0], flat.coefficients[1]);
        let amplitude = libm::hypot(sine, cosine);
        // The third column says how the sinusoid changes with its frequency.
        let middle = 0.5
            * (self.turns.iter().copied().fold(f64::INFINITY, f64::min)
                + self.turns.iter().copied().fold(f64::NEG_INFINITY, f64::max));
        let slope: Vec<f64> = self
            .turns
            .iter()
            .map(|u| {
                let (s, c) = libm::sincos(std::f64::consts::TAU * frequency * u);
                std::f64::consts::TAU * (u - middle) * (sine * c - cosine * s)
            })
            .collect();
        let slope = self.whitener.whiten(times(self.unit, slope));
        let bent = least_squares::fit(&[&wave[0], &wave[1], &slope], white);
        let freedom = (count(white.len()) - 5.0 - count(self.whitener.offsets())).max(1.0);
        let scale = (flat.residual_square / freedom).max(1e-300);
        let along = |i: usize, j: usize| bent.covariance[(i, j)] * scale;
        let power = (amplitude * amplitude).max(f64::MIN_POSITIVE);
        let variance = (sine * sine * along(0, 0)
            + 2.0 * sine * cosine * along(0, 1)
            + cosine * cosine * along(1, 1))
            / power;
        let gain = dot(white, white) - flat.residual_square;
        Line {
            frequency,
            frequency_stderr: along(2, 2).max(0.0).sqrt(),
            amplitude,
            amplitude_stderr: variance.max(0.0).sqrt(),
            phase_rad: libm::atan2(cosine, sine),
            gain,
            p_value: chance(gain / scale.max(1.0), freedom, self.looks()),
        }
    }

    fn points(&self, step: f64) -> usize {
        let wanted = (self.highest / step).clamp(4.0, count(MOST_POINTS));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to small positive numbers"
        )]
        let points = wanted as usize;
        points + 1
    }

    fn stretches(&self) -> Vec<Stretch> {
        let blocks = self.layout.blocks.iter().filter(|block| 1 < block.rows.len());
        blocks
            .map(|block| {
                let clock = &self.layout.clock[block.rows.clone()];
                let turns = spread(&self.turns[block.rows.clone()]);
                let cycles_an_interval =
                    turns / (clock[clock.len() - 1] - clock[0]).max(f64::MIN_POSITIVE);
                let gap = usual_least_gap(clock);
                Stretch {
                    rows: block.rows.clone(),
                    turns,
                    density: Density::of(&self.noises[block.sensor].scaled(block.variance()), gap),
                    square: dot(&self.unit[block.rows.clone()], &self.unit[block.rows.clone()]),
                    cycles_a_gap: cycles_an_interval * gap,
                }
            })
            .collect()
    }
}

/// What a wave turns by over all frequencies between two, rad: `2π·σ(u)` a cycle a unit (Baluev 2008,
/// *Assessing the statistical significance of periodogram peaks*, MNRAS 385:1279).
#[must_use]
pub(crate) fn arc(turns: &[f64], [lowest, highest]: [f64; 2]) -> f64 {
    let rows = count(turns.len().max(1));
    let mean = turns.iter().sum::<f64>() / rows;
    let square: f64 = turns.iter().map(|u| (u - mean) * (u - mean)).sum();
    std::f64::consts::TAU * (square / rows).sqrt() * (highest - lowest).max(0.0)
}

/// Each value by a factor of its own.
fn times(factors: &[f64], values: Vec<f64>) -> Vec<f64> {
    values.into_iter().zip(factors).map(|(value, factor)| value * factor).collect()
}

/// A block as the spectrum sees it: so many samples that show it under noise of known colour.
struct Stretch {
    rows: Range<usize>,
    /// How far they reach.
    turns: f64,
    density: Density,
    /// What a wave shows at them, squared.
    square: f64,
    cycles_a_gap: f64,
}

impl Stretch {
    /// Information a sinusoid of frequency `f` gets here: half the samples over the noise density.
    fn information(&self, frequency: f64) -> f64 {
        0.5 * self.square / self.density.at(frequency * self.cycles_a_gap)
    }
}

/// Points in the order of their gains.
pub(crate) fn strongest_first(mut points: Vec<Point>) -> impl Iterator<Item = Point> {
    let falling = |a: &Point, b: &Point| b.gain.total_cmp(&a.gain);
    let first = ORDERED.min(points.len());
    if first < points.len() {
        points.select_nth_unstable_by(first, falling);
    }
    let mut rest = points.split_off(first);
    points.sort_by(falling);
    // The rest is put in order only if somebody asks for it.
    let rest = std::iter::once_with(move || {
        rest.sort_by(falling);
        rest
    });
    points.into_iter().chain(rest.flatten())
}

/// Share of the gaps between samples that are no longer than what a sampling goes by: of samples of
/// which some are lost it is one comparison, though the usual gap may be several.
const SHORT_GAPS: usize = 10;

/// What the gaps of a block are whole multiples of, or may be, in usual intervals.
fn usual_least_gap(clock: &[f64]) -> f64 {
    let mut gaps: Vec<f64> =
        clock.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| 0.0 < *gap).collect();
    gaps.sort_by(f64::total_cmp);
    gaps.get(gaps.len() / SHORT_GAPS).copied().unwrap_or(1.0)
}

/// Power density of noise at samples some of which are missing from an even row: slow noise comes
/// back where a wave turns once from one place of that row to the next, not sooner.
struct Density {
    white: f64,
    /// Variance of each slow part in a usual interval, and what a gap leaves of it.
    slow: Vec<(f64, f64)>,
}

impl Density {
    /// `gap` is the distance of the row's places, in usual intervals.
    fn of(noise: &Noise, gap: f64) -> Self {
        let part = |part: &SlowPart| (gap * part.variance, libm::exp(-gap / part.length));
        Self { white: noise.white, slow: noise.slow.iter().map(part).collect() }
    }

    /// At a frequency in cycles a gap; that of white noise is its variance.
    fn at(&self, cycles: f64) -> f64 {
        if self.slow.is_empty() {
            return self.white;
        }
        let wave = libm::cos(std::f64::consts::TAU * cycles);
        let slow = self.slow.iter().map(|(variance, kept)| {
            variance * (1.0 - kept * kept) / (1.0 - 2.0 * kept * wave + kept * kept)
        });
        self.white + slow.sum::<f64>()
    }
}

/// Chance of a gain of two columns as large at any of `looks` places in noise of known colour.
#[must_use]
pub(crate) fn chance(gain: f64, freedom: f64, looks: f64) -> f64 {
    // F with 2 and ν degrees of freedom has this closed tail; it counts the scale's own error.
    let single = libm::exp(-0.5 * freedom * libm::log1p(gain / freedom.max(1.0)));
    anywhere(single, looks)
}

/// Chance that what has some chance at one place happens at any of `looks` places.
fn anywhere(single: f64, looks: f64) -> f64 {
    -libm::expm1(looks * libm::log1p(-single.min(1.0 - 1e-16)))
}

/// What of `target` is left when whitened columns are fitted.
#[must_use]
pub(crate) fn remainder(columns: &[Vec<f64>], target: &[f64]) -> Vec<f64> {
    let views: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    least_squares::left(&views, target, &least_squares::fit(&views, target).coefficients)
}
