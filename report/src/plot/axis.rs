//! Where an axis begins and ends, and its round numbers.

use super::{Axis, Scale};

/// An axis with its ends settled; positions along it are plain numbers, logarithms included.
#[derive(Clone, Debug)]
pub(crate) struct Settled {
    scale: Scale,
    /// Ends, as positions.
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// Positions of the round numbers.
    pub(crate) ticks: Vec<f64>,
    /// Distance of round numbers on a linear axis.
    step: f64,
}

impl Settled {
    /// Settles an axis over `data` with `most` round numbers or fewer, and `room` at both ends
    /// as a share of its length.
    pub(crate) fn new(
        axis: &Axis,
        data: impl Iterator<Item = f64>,
        most: usize,
        room: f64,
    ) -> Self {
        let scale = axis.scale;
        let given = axis.range.map(|[low, high]| [position(scale, low), position(scale, high)]);
        let given = given.filter(|[low, high]| low < high);
        let [mut low, mut high] =
            given.unwrap_or_else(|| spread(data.map(|value| position(scale, value)), scale, room));
        let least = (high - low) / count(most);
        let step = round_step(if scale == Scale::Counts { least.max(1.0) } else { least });
        if given.is_none() && scale == Scale::Linear {
            [low, high] = rounded([low, high], step);
        }
        let ticks = match scale {
            Scale::Linear | Scale::Counts => linear_ticks(low, high, step),
            Scale::Log => log_ticks(low, high, most),
        };
        Self { scale, low, high, ticks, step }
    }

    /// Where a value lies; not finite when it cannot be shown.
    pub(crate) fn position(&self, value: f64) -> f64 {
        position(self.scale, value)
    }

    /// The round number at a position, as text.
    pub(crate) fn text(&self, position: f64) -> String {
        let shown = match self.scale {
            Scale::Linear | Scale::Counts if position.abs() < self.step / 2.0 => "0".into(),
            Scale::Linear if self.exponents() => format!("{position:.1e}"),
            Scale::Linear | Scale::Counts => format!("{position:.*}", decimals(self.step)),
            Scale::Log => {
                let value = libm::pow(10.0, position);
                let plain = (-3.5..5.0).contains(&position);
                if plain { short(value) } else { format!("{value:.0e}") }
            }
        };
        shown.replacen('-', "\u{2212}", 1)
    }

    fn exponents(&self) -> bool {
        self.step < 1e-5 || 1e7 <= self.low.abs().max(self.high.abs())
    }
}

fn position(scale: Scale, value: f64) -> f64 {
    match scale {
        Scale::Linear | Scale::Counts => value,
        Scale::Log if value > 0.0 => libm::log10(value),
        Scale::Log => f64::NAN,
    }
}

/// Lowest and highest position with a little room; some range even for no data or a constant.
fn spread(positions: impl Iterator<Item = f64>, scale: Scale, room: f64) -> [f64; 2] {
    let ends = positions.filter(|position| position.is_finite()).fold(None, |ends, position| {
        let [low, high] = ends.unwrap_or([position; 2]);
        Some([position.min(low), position.max(high)])
    });
    let [low, high] = ends.unwrap_or([0.0, 1.0]);
    let width = high - low;
    let room = match scale {
        _ if width > 0.0 && width.is_finite() => room * width,
        Scale::Linear if low != 0.0 && width == 0.0 => 0.1 * low.abs(),
        _ => 0.5,
    };
    let limit = f64::MAX / 4.0; // beyond it the width of the axis would overflow
    [(low - room).clamp(-limit, limit), (high + room).clamp(-limit, limit)]
}

/// The same ends, or the round numbers just beyond them: 999.9 becomes 1000.
fn rounded([low, high]: [f64; 2], step: f64) -> [f64; 2] {
    let near = 0.02 * (high - low);
    let [below, above] = [(low / step).floor() * step, (high / step).ceil() * step];
    [if low - below <= near { below } else { low }, if above - high <= near { above } else { high }]
}

/// The least 1, 2 or 5 times a power of ten that is not below `least`.
fn round_step(least: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(least.max(f64::MIN_POSITIVE))));
    let factor = [1.0, 2.0, 5.0].into_iter().find(|factor| least <= factor * power);
    factor.unwrap_or(10.0) * power
}

fn linear_ticks(low: f64, high: f64, step: f64) -> Vec<f64> {
    const MOST: usize = 100;
    let first = (low / step).ceil();
    (0..MOST).map(|index| (first + count(index)) * step).take_while(|tick| *tick <= high).collect()
}

/// Powers of ten, with 2 and 5 between them when there are few.
fn log_ticks(low: f64, high: f64, most: usize) -> Vec<f64> {
    let few = high - low < 2.5;
    let between: &[f64] = if few { &[1.0, 2.0, 5.0] } else { &[1.0] };
    let decades = ((high - low) / count(most.max(1))).ceil().max(1.0);
    let mut ticks = Vec::new();
    let mut decade = low.floor();
    while decade <= high && ticks.len() < 100 {
        let positions = between.iter().map(|factor| decade + libm::log10(*factor));
        ticks.extend(positions.filter(|tick| (low..=high).contains(tick)));
        decade += decades;
    }
    ticks
}

/// Digits after the point that tell multiples of a round step apart.
fn decimals(step: f64) -> usize {
    (0..9).find(|digits| libm::pow(10.0, count(*digits)) * step >= 0.999).unwrap_or(9)
}

/// A number of few digits without trailing zeros.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[expect(clippy::cast_precision_loss, reason = "counts of marks on an axis are small")]
fn count(number: usize) -> f64 {
    number as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis, data: &[f64]) -> Vec<String> {
        let settled = Settled::new(axis, data.iter().copied(), 6, 0.04);
        settled.ticks.iter().map(|tick| settled.text(*tick)).collect()
    }

    #[test]
    fn ticks_are_round_numbers_inside_the_axis() {
        let axis = Axis::linear("error in µm");
        assert_eq!(texts(&axis, &[-0.31, 0.28]), ["\u{2212}0.2", "0", "0.2"]);
        assert_eq!(texts(&axis, &[0.0, 1000.0]), ["0", "200", "400", "600", "800", "1000"]);
    }

    #[test]
    fn counts_have_whole_numbers_only() {
        assert_eq!(texts(&Axis::counts("round").between(-0.4, 2.4), &[]), ["0", "1", "2"]);
    }

    #[test]
    fn an_axis_that_nearly_reaches_a_round_number_reaches_it() {
        let settled = Settled::new(&Axis::linear(""), [0.14, 999.9].into_iter(), 10, 0.0);
        assert_eq!((settled.ticks.len(), settled.text(settled.ticks[10])), (11, "1000".into()));
    }

    #[test]
    fn logarithmic_ticks_are_decades_or_ones_twos_and_fives() {
        let axis = Axis::log("amplitude in µm");
        assert_eq!(texts(&axis, &[0.02, 0.9]), ["0.02", "0.05", "0.1", "0.2", "0.5", "1"]);
        assert_eq!(texts(&axis, &[1e-6, 1e3, -1.0]).len(), 5);
    }

    #[test]
    fn degenerate_data_still_make_an_axis() {
        for data in [&[][..], &[f64::NAN], &[5.0, 5.0], &[f64::MAX, f64::MIN], &[1e-320, 0.0]] {
            for axis in [Axis::linear(""), Axis::log("")] {
                let settled = Settled::new(&axis, data.iter().copied(), 6, 0.04);
                assert!(settled.low < settled.high, "{data:?}");
                assert!((settled.high - settled.low).is_finite(), "{data:?}");
            }
        }
    }
}
