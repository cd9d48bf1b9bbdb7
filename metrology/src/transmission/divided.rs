//! Both trains divided down to one frequency, for the methods that compare phases.

use super::gearing::float;
use super::method::Setup;
use super::pulses::Pulses;
use super::unevenness::phase_at;
use crate::Error;

/// Two trains of nominally equal frequency.
pub(super) struct Divided {
    /// Instants of the divided input, s: they set.
    pub(super) set_s: Vec<f64>,
    /// Instants of the divided output, s: they clear.
    pub(super) clear_s: Vec<f64>,
    /// Number of the output pulse of each of those.
    pub(super) clear_pulse: Vec<usize>,
    /// Input pulses a comparison period has: the range.
    pub(super) range_pulses: f64,
    /// Output pulses from one comparison to the next.
    pub(super) divider: usize,
}

/// Divides the input by `p·k` and the output by `q·k`, where `R = p/q` and `k` is the range divider.
///
/// The input's division starts half a period off, as the initial-phase selector of a phase meter
/// does, so that the meter begins in the middle of its range.
pub(super) fn divide(
    pulses: &Pulses,
    setup: &Setup,
    method: &'static str,
) -> Result<Divided, Error> {
    let (over, under) = setup.gearing.pulses_per_pulse();
    // Dividers beyond 64 bits are beyond any capture too.
    let by_input = over.saturating_mul(setup.range_divider);
    let by_output = under.saturating_mul(setup.range_divider);
    let comparisons = float(by_output) * 2.0;
    let cannot = || Error::MethodCannot {
        method,
        reason: format!(
            "compares equal frequencies, which takes dividers {by_input} and {by_output}; with {} output pulses there are fewer than two comparisons, expected more than {comparisons} pulses\nhint: the subdivided methods take any ratio",
            pulses.output_s().len(),
        ),
    };
    let divider = usize::try_from(by_output).map_err(|_| cannot())?;
    let by_input = usize::try_from(by_input).map_err(|_| cannot())?;
    let placed = pulses.placed();
    let Some(&(first_output, first_input)) = placed.first() else { return Err(cannot()) };
    let skip = first_input + by_input.div_ceil(2);
    let set_s: Vec<f64> = pulses.input_s().iter().skip(skip).step_by(by_input).copied().collect();
    let outputs = (first_output..pulses.output_s().len()).step_by(divider);
    let (clear_s, clear_pulse): (Vec<f64>, Vec<usize>) =
        outputs.map(|output| (pulses.output_s()[output], output)).unzip();
    if set_s.len() < 2 || clear_s.len() < 2 {
        return Err(cannot());
    }
    Ok(Divided {
        set_s,
        clear_s,
        clear_pulse,
        range_pulses: float(over) * float(setup.range_divider),
        divider,
    })
}

impl Divided {
    /// Largest part of a comparison period by which time and the input's turn tell it apart.
    pub(super) fn unevenness(&self, pulses: &Pulses) -> f64 {
        let input_s = pulses.input_s();
        let off = |&(clear, set): &(usize, usize)| {
            let (clear_s, set_s, next_s) =
                (self.clear_s[clear], self.set_s[set], self.set_s[set + 1]);
            let turned = phase_at(input_s, clear_s)? - phase_at(input_s, set_s)?;
            Some(((clear_s - set_s) / (next_s - set_s) - turned / self.range_pulses).abs())
        };
        self.pairs().iter().filter_map(off).fold(0.0, f64::max)
    }

    /// Each clear pulse between two set pulses: its number among the clears, and the set before it.
    pub(super) fn pairs(&self) -> Vec<(usize, usize)> {
        let mut last = 0;
        let mut pairs = Vec::with_capacity(self.clear_s.len());
        for (clear, &at_s) in self.clear_s.iter().enumerate() {
            while last + 1 < self.set_s.len() && self.set_s[last + 1] <= at_s {
                last += 1;
            }
            if self.set_s[last] <= at_s && last + 1 < self.set_s.len() {
                pairs.push((clear, last));
            }
        }
        pairs
    }
}
