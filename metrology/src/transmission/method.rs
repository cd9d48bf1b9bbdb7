//! The five methods behind one call, with what each can and cannot do.

use super::gearing::Gearing;
use super::pulses::Pulses;
use super::{analog, counting, digital, subdivided};
use crate::Error;
use crate::number::number;

/// How δ is found; the names are those of document 4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// Trigger phase meter: a flip-flop and a recorder with a time constant.
    Analog,
    /// Digital phase comparison: clock pulses between two divided pulses.
    Digital,
    /// Subdivided phase comparison: the fraction of the input period, followed from sample to sample.
    SubdividedComparison,
    /// Direct counting: whole input pulses.
    DirectCounting,
    /// Subdivided counting: whole input pulses and the clocked fraction.
    SubdividedCounting,
}

/// What a measurement is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Lines and ratio.
    pub gearing: Gearing,
    /// Clock that subdivides, Hz (digital, and both subdivided methods).
    pub clock_hz: f64,
    /// Further division of both trains (analog, digital): the range grows with it, and the time
    /// between samples.
    pub range_divider: u64,
    /// Time constant of the recorder, s (analog).
    pub recorder_s: f64,
}

/// One value of δ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// When, s.
    pub time_s: f64,
    /// Turns of the output since the first output pulse of the capture.
    pub output_turns: f64,
    /// δ, rad at the output; zero at the first sample.
    pub error_rad: f64,
}

/// What limits a method on these pulses.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Smallest change it shows, rad.
    pub resolution_rad: f64,
    /// Full range before it starts again, rad; absent when there is none.
    pub range_rad: Option<f64>,
    /// Largest change from one sample to the next that is not misread, rad; absent when any is right.
    pub step_rad: Option<f64>,
    /// Samples a turn of the output.
    pub samples_per_turn: f64,
    /// Bound on the error of a sample against the first one, rad, for an input whose speed changes
    /// between two pulses no quicker than from pulse to pulse.
    pub bound_rad: f64,
    /// In words, what it needs and what it loses.
    pub in_words: &'static str,
}

/// What one sample costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Counters and dividers in hardware.
    pub counters: u32,
    /// Multiplications and divisions in software.
    pub multiplications: u32,
    /// True when an analog part is needed.
    pub analog: bool,
}

/// What a method found.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// The method.
    pub method: Method,
    /// δ along the run.
    pub samples: Vec<Sample>,
    /// Its limits here.
    pub limits: Limits,
    /// Its cost.
    pub cost: Cost,
}

impl Method {
    /// All five, in the order of the document.
    pub const ALL: [Self; 5] = [
        Self::Analog,
        Self::Digital,
        Self::SubdividedComparison,
        Self::DirectCounting,
        Self::SubdividedCounting,
    ];

    /// Name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Analog => "analog",
            Self::Digital => "digital",
            Self::SubdividedComparison => "subdivided",
            Self::DirectCounting => "counting",
            Self::SubdividedCounting => "subdivided-counting",
        }
    }

    fn cost(self) -> Cost {
        let cost = |counters, multiplications, analog| Cost { counters, multiplications, analog };
        match self {
            // Two dividers and a flip-flop; the recorder does the rest.
            Self::Analog => cost(2, 0, true),
            // Two dividers, Δt and T.
            Self::Digital => cost(4, 1, false),
            // Nt and N; one quotient, one product for the nominal phase.
            Self::SubdividedComparison => cost(2, 2, false),
            // N1 and N2; one product.
            Self::DirectCounting => cost(2, 1, false),
            // N0, TΔ, T2; one quotient, one product.
            Self::SubdividedCounting => cost(3, 2, false),
        }
    }
}

/// Measures δ by one method.
///
/// # Errors
///
/// When a setting makes no sense, or the method cannot work on these pulses: the phase methods
/// need a ratio whose dividers leave at least two comparisons in the capture.
pub fn measure(pulses: &Pulses, setup: &Setup, method: Method) -> Result<Reading, Error> {
    setup.check()?;
    let (mut samples, limits) = match method {
        Method::Analog => analog::measure(pulses, setup)?,
        Method::Digital => digital::measure(pulses, setup)?,
        Method::SubdividedComparison => subdivided::measure(pulses, setup)?,
        Method::DirectCounting => counting::direct(pulses, setup)?,
        Method::SubdividedCounting => counting::subdivided(pulses, setup)?,
    };
    let zero_rad = samples.first().map_or(0.0, |first| first.error_rad);
    for sample in &mut samples {
        sample.error_rad -= zero_rad;
    }
    Ok(Reading { method, samples, limits, cost: method.cost() })
}

impl Reading {
    /// Highest less lowest error, rad.
    #[must_use]
    pub fn peak_to_peak_rad(&self) -> f64 {
        let errors = || self.samples.iter().map(|sample| sample.error_rad);
        let (low, high) =
            (errors().fold(f64::INFINITY, f64::min), errors().fold(f64::NEG_INFINITY, f64::max));
        if low <= high { high - low } else { 0.0 }
    }
}

impl Setup {
    fn check(&self) -> Result<(), Error> {
        self.gearing.check()?;
        let positive = |name, value: f64| {
            if 0.0 < value && value.is_finite() {
                return Ok(());
            }
            Err(Error::OutOfRange { name, found: value, expected: "more than 0" })
        };
        positive("clock in Hz", self.clock_hz)?;
        positive("recorder time constant in s", self.recorder_s)?;
        if !(1..1 << 16).contains(&self.range_divider) {
            let found = super::gearing::float(self.range_divider);
            return Err(Error::OutOfRange { name: "range divider", found, expected: "1 to 65535" });
        }
        Ok(())
    }

    /// Clock ticks up to an instant.
    #[expect(clippy::cast_possible_truncation, reason = "captures are far shorter than 2⁶³ ticks")]
    pub(super) fn ticks(&self, at_s: f64) -> i64 {
        (at_s * self.clock_hz).floor() as i64
    }
}

/// Largest and root-mean-square difference of a reading from the true δ, rad.
///
/// `truth_rad` gives δ at a turn of the output; both are compared from the first sample on.
#[must_use]
pub fn error_against(reading: &Reading, truth_rad: impl Fn(f64) -> f64) -> (f64, f64) {
    let Some(first) = reading.samples.first() else { return (0.0, 0.0) };
    let zero_rad = truth_rad(first.output_turns);
    let difference = |s: &Sample| s.error_rad - (truth_rad(s.output_turns) - zero_rad);
    let squares: f64 = reading.samples.iter().map(|s| difference(s) * difference(s)).sum();
    let largest = reading.samples.iter().map(|s| difference(s).abs()).fold(0.0, f64::max);
    (largest, (squares / number(reading.samples.len())).sqrt())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use proptest::prelude::*;

    use super::*;
    use crate::transmission::{Synthesis, synthesise};

    fn setup() -> Setup {
        Setup {
            gearing: Gearing { input_lines: 1000, output_lines: 3600, ratio: (36, 1) },
            clock_hz: 12e6,
            range_divider: 4,
            recorder_s: 0.005,
        }
    }

    /// δ of a worm pair: once a turn of the output and once a turn of the worm.
    fn truth(size_rad: f64) -> impl Fn(f64) -> f64 {
        move |turns| size_rad * (libm::sin(TAU * turns) + 0.3 * libm::sin(TAU * 36.0 * turns + 1.0))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(12))]
        #[test]
        fn each_method_recovers_a_known_error_within_its_limit(size_arcsec in 1.0..30.0f64) {
            let size_rad = size_arcsec / 3600.0 * TAU / 360.0;
            let synthesis = Synthesis { input_hz: 6.0, output_turns: 1.1 };
            let pulses = synthesise(&setup().gearing, &synthesis, truth(size_rad)).unwrap();
            for method in Method::ALL {
                let reading = measure(&pulses, &setup(), method).unwrap();
                let (largest, _) = error_against(&reading, truth(size_rad));
                prop_assert!(largest <= reading.limits.bound_rad, "{method:?}: {largest} {:?}", reading.limits);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// The input swings by up to 30 %, up to 50 times a turn of 1000 pulses.
        #[test]
        fn bounds_hold_for_an_input_that_turns_unevenly(
            size_arcsec in 1.0..30.0f64, depth in 0.0..0.3f64, swings in 0.1..50.0f64,
        ) {
            let size_rad = size_arcsec / 3600.0 * TAU / 360.0;
            let synthesis = Synthesis { input_hz: 6.0, output_turns: 1.1 };
            let even = synthesise(&setup().gearing, &synthesis, truth(size_rad)).unwrap();
            let rate = TAU * 6.0 * swings;
            let uneven = |s: &[f64]| -> Vec<f64> {
                s.iter().map(|t| t + depth / rate * libm::sin(rate * t)).collect()
            };
            let pulses = Pulses::new(uneven(even.input_s()), uneven(even.output_s())).unwrap();
            for method in Method::ALL {
                let reading = measure(&pulses, &setup(), method).unwrap();
                let (largest, _) = error_against(&reading, truth(size_rad));
                prop_assert!(largest <= reading.limits.bound_rad, "{method:?}: {largest} {:?}", reading.limits);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// An analyser at 100 kHz or 1 MHz: with instants of 10 µs the error was 3.5″, and the bound said
        /// 0.12″.
        #[test]
        fn bounds_hold_for_instants_that_are_whole_ticks(
            size_arcsec in 1.0..30.0f64, input_hz in 0.5..2.0f64, tick_us in 1..=10u32,
        ) {
            let size_rad = size_arcsec / 3600.0 * TAU / 360.0;
            let synthesis = Synthesis { input_hz, output_turns: 1.1 };
            let exact = synthesise(&setup().gearing, &synthesis, truth(size_rad)).unwrap();
            let ticked = |s: &[f64]| -> Vec<f64> {
                let ticks_per_s = 1e6 / f64::from(tick_us);
                s.iter().map(|at_s| (at_s * ticks_per_s).floor() / ticks_per_s).collect()
            };
            let pulses = Pulses::new(ticked(exact.input_s()), ticked(exact.output_s())).unwrap();
            prop_assert!((pulses.tick_s() * 1e6 / f64::from(tick_us) - 1.0).abs() < 1e-6);
            for method in Method::ALL {
                let reading = measure(&pulses, &setup(), method).unwrap();
                let (largest, _) = error_against(&reading, truth(size_rad));
                prop_assert!(largest <= reading.limits.bound_rad, "{method:?}: {largest} {:?}", reading.limits);
            }
        }
    }

    #[test]
    fn subdivision_beats_counting_by_far() {
        let size_rad = 1e-4;
        let synthesis = Synthesis { input_hz: 6.0, output_turns: 1.1 };
        let pulses = synthesise(&setup().gearing, &synthesis, truth(size_rad)).unwrap();
        let rms =
            |method| error_against(&measure(&pulses, &setup(), method).unwrap(), truth(size_rad)).1;
        assert!(rms(Method::SubdividedCounting) < 0.02 * rms(Method::DirectCounting));
    }

    /// 30 input pulses of error do not fit a range of 4·10 pulses centred by half: it starts
    /// again, while the methods without a range follow.
    #[test]
    fn the_phase_meters_start_again_beyond_their_range() {
        let size_rad = 30.0 * setup().gearing.input_pulse_rad();
        let slow = move |turns: f64| size_rad * libm::sin(TAU * turns);
        let synthesis = Synthesis { input_hz: 6.0, output_turns: 1.1 };
        let pulses = synthesise(&setup().gearing, &synthesis, slow).unwrap();
        let largest = |method| {
            let reading = measure(&pulses, &setup(), method).unwrap();
            error_against(&reading, slow).0 / setup().gearing.input_pulse_rad()
        };
        assert!(20.0 < largest(Method::Digital), "{}", largest(Method::Digital));
        assert!(20.0 < largest(Method::Analog), "{}", largest(Method::Analog));
        assert!(largest(Method::SubdividedComparison) < 0.1);
        assert!(largest(Method::SubdividedCounting) < 0.1);
    }
}
