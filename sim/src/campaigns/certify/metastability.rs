//! How long a synchroniser works until a metastable level gets through it.
//!
//! ```text
//! MTBF = exp(t/τ) / (T_w · f · f_in)
//!
//! t settling time between the two flip-flops, a clock less what is lost    τ, T_w of the flip-flop
//! f clock, Hz    f_in pulses a second
//! ```

/// What is assumed of a flip-flop of the FPGA: the makers of small FPGAs print no figures, so these
/// have no source, and the result says that they are assumed.
pub const FLIP_FLOP: FlipFlop = FlipFlop { tau_s: 0.2e-9, window_s: 0.2e-9, overhead_s: 3e-9 };

/// Metastability parameters of a flip-flop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlipFlop {
    /// Time constant with which it settles, s.
    pub tau_s: f64,
    /// Window around the clock edge in which it is upset, s.
    pub window_s: f64,
    /// Clock to output, routing and set-up, lost to settling, s.
    pub overhead_s: f64,
}

/// Logarithm to base 10 of the mean time between failures, years: it overflows as a number.
#[must_use]
pub fn mtbf_log10_years(flip_flop: FlipFlop, clock_hz: f64, input_hz: f64) -> f64 {
    let settling_s = 1.0 / clock_hz - flip_flop.overhead_s;
    let seconds_a_year = 365.25 * 86_400.0;
    settling_s / flip_flop.tau_s * std::f64::consts::LOG10_E
        - libm::log10(flip_flop.window_s * clock_hz * input_hz * seconds_a_year)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 81.3 ns of settling over 0.2 ns is e^406 = 10^176.
    #[test]
    fn a_whole_clock_of_settling_is_plenty() {
        let flip_flop = FlipFlop { tau_s: 0.2e-9, window_s: 0.2e-9, overhead_s: 2e-9 };
        let log10 = mtbf_log10_years(flip_flop, 12e6, 4740.0);
        let exponent = (1e3 / 12.0 - 2.0) / 0.2 * std::f64::consts::LOG10_E;
        let rate_a_year = 0.2e-9 * 12e6 * 4740.0 * 31_557_600.0;
        assert!((log10 - (exponent - libm::log10(rate_a_year))).abs() < 1e-6, "{log10}");
    }
}
