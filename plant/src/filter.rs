//! The recorder's low-pass filter, and any other first-order lag.

/// First-order lag between uneven samples, exact for an input that runs straight between them.
///
/// A wave of rate ω comes out too large or too small by `(ωT)²/12` of samples T apart: see
/// [`crate::Record::refined`] for samples that are farther apart than comparisons.
///
/// Document 1, figure 10 asks for a low-pass between the error band (three times the spindle) and
/// the comparison frequency; its elements are not in our hands, so one pole is assumed.
#[derive(Clone, Copy, Debug)]
pub struct LowPass {
    time_constant_s: f64,
    state: Option<(f64, f64, f64)>,
}

impl LowPass {
    /// With a time constant in s; 0 lets everything through.
    #[must_use]
    pub fn new(time_constant_s: f64) -> Self {
        Self { time_constant_s, state: None }
    }

    /// With a cut-off frequency in Hz, where the gain is 1/√2.
    #[must_use]
    pub fn with_cutoff(cutoff_hz: f64) -> Self {
        Self::new(1.0 / (std::f64::consts::TAU * cutoff_hz))
    }

    /// Output at `time_s` for an input that has run straight from the last sample to `input`.
    ///
    /// The first sample sets the output to the input: the filter has settled before.
    pub fn next(&mut self, time_s: f64, input: f64) -> f64 {
        let Some((last_s, last_input, last_output)) = self.state else {
            self.state = Some((time_s, input, input));
            return input;
        };
        let elapsed_s = time_s - last_s;
        let output = if elapsed_s <= 0.0 || self.time_constant_s <= 0.0 {
            if self.time_constant_s <= 0.0 { input } else { last_output }
        } else {
            let slope = (input - last_input) / elapsed_s;
            let ramp = self.time_constant_s * slope;
            let decay = libm::exp(-elapsed_s / self.time_constant_s);
            input - ramp + (last_output - last_input + ramp) * decay
        };
        self.state = Some((time_s, input, output));
        output
    }

    /// The whole of a pass at once.
    #[must_use]
    pub fn pass(mut self, time_s: &[f64], input: &[f64]) -> Vec<f64> {
        time_s.iter().zip(input).map(|(time_s, input)| self.next(*time_s, *input)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_and_ramp_follow_the_textbook() {
        let mut filter = LowPass::new(2.0);
        assert_eq!(filter.next(0.0, 0.0).to_bits(), 0.0_f64.to_bits());
        // A ramp of 1 per s through a lag τ: t − τ(1 − e^(−t/τ)), whatever the samples are.
        for time_s in [0.1, 0.7, 3.0, 11.0] {
            let by_hand = time_s - 2.0 * (1.0 - libm::exp(-time_s / 2.0));
            assert!((filter.next(time_s, time_s) - by_hand).abs() < 1e-12, "{time_s}");
        }
    }
}
