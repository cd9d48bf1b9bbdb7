//! The clock of what captured the pulses, from their instants alone.
//!
//! A logic analyser gives an instant as a whole number of its ticks: the true one is anywhere within a
//! tick. Nothing says which tick that was, but all instants are whole numbers of it apart.

/// Rates of analysers and cards that are no whole number of decimal ticks apart in their files, Hz: their
/// instants are rounded to some decimal. Times every power of ten.
const RATES_HZ: [f64; 6] = [1.2, 1.6, 2.4, 3.0, 4.8, 6.0];
/// Powers of ten of the rates, Hz.
const DECADES: std::ops::RangeInclusive<i32> = 0..=9;
/// Part of a tick by which an instant may be off a whole number. Chosen: of eight instants that have no tick
/// a millionth of all sets is within it at every one.
const OFF: f64 = 1.0 / 12.0;
/// Rounding of a number in a file, in parts of the latest instant.
const ROUNDING: f64 = f64::EPSILON;
/// A step is told from rounding that is so many times as large. Chosen: a remainder is taken for none by
/// chance once in ten, and that of every instant never.
const LEAST_ROUNDINGS: f64 = 20.0;

/// The greatest step of which both trains are whole numbers apart, s; `None` where it is no more than
/// rounding.
pub(super) fn common_step_s(input_s: &[f64], output_s: &[f64]) -> Option<f64> {
    let both = || input_s.iter().chain(output_s);
    let latest_s = both().fold(0.0_f64, |latest, at_s| latest.max(at_s.abs()));
    let rounding_s = ROUNDING * latest_s;
    let origin_s = *input_s.first()?;
    let whole = |tick_s: &f64| {
        let off = |at_s: &f64| {
            let ticks = (at_s - origin_s) / tick_s;
            (ticks - ticks.round()).abs()
        };
        LEAST_ROUNDINGS * rounding_s < *tick_s && both().all(|at_s| off(at_s) <= OFF)
    };
    let rates =
        DECADES.flat_map(|decade| RATES_HZ.map(|rate| rate * libm::pow(10.0, f64::from(decade))));
    let of_rate = rates.map(|rate_hz| 1.0 / rate_hz).find(whole);
    let steps = |train_s: &'_ [f64]| -> Vec<f64> {
        train_s.windows(2).map(|pair| pair[1] - pair[0]).collect()
    };
    let mut apart = steps(input_s);
    apart.extend(steps(output_s));
    apart.push((output_s.first()? - origin_s).abs());
    of_rate.into_iter().chain(common(&apart, rounding_s)).max_by(f64::total_cmp)
}

/// A length, and what rounding may have made of it.
#[derive(Clone, Copy)]
struct Rounded {
    length: f64,
    rounding: f64,
}

/// The greatest common divisor of lengths by Euclid's algorithm, where a remainder no larger than rounding is
/// none.
fn common(lengths: &[f64], rounding: f64) -> Option<f64> {
    let mut step = Rounded { length: 0.0, rounding: 0.0 };
    for length in lengths {
        let mut rest = Rounded { length: *length, rounding };
        while 2.0 * rest.rounding < rest.length {
            let times = (step.length / rest.length).round();
            let more = Rounded {
                length: (step.length - times * rest.length).abs(),
                rounding: step.rounding + times * rest.rounding,
            };
            (step, rest) = (rest, more);
        }
        // The more steps a length has, the better it tells the step.
        let times = (length / step.length).round();
        if rounding / times < step.rounding {
            step = Rounded { length: length / times, rounding: rounding / times };
        }
        if step.length < LEAST_ROUNDINGS * step.rounding {
            return None;
        }
    }
    (0.0 < step.length).then_some(step.length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Instants of two uneven trains, as a capture writes them.
    fn instants(written: impl Fn(f64) -> f64) -> [Vec<f64>; 2] {
        [(0.000_277_7, 0.1), (0.002_777, 0.37)].map(|(period_s, from)| {
            let at =
                |k: u32| 0.2 + period_s * (f64::from(k) + from + 0.2 * libm::sin(f64::from(k)));
            (0..400).map(at).map(&written).collect()
        })
    }

    #[test]
    fn a_tick_is_found_where_there_is_one() {
        for tick_s in [1e-5, 1e-6, 7e-6, 1e-8] {
            let [input_s, output_s] = instants(|at_s| (at_s / tick_s).floor() * tick_s);
            let found = common_step_s(&input_s, &output_s).unwrap();
            assert!((found / tick_s - 1.0).abs() < 1e-6, "{found} {tick_s}");
        }
        // 24 MHz, written in nanoseconds.
        let [input_s, output_s] =
            instants(|at_s| (((at_s * 24e6).floor() / 24e6) * 1e9).round() / 1e9);
        let found = common_step_s(&input_s, &output_s).unwrap();
        assert!((found * 24e6 - 1.0).abs() < 1e-6, "{found}");
        let [input_s, output_s] = instants(|at_s| at_s);
        let found = common_step_s(&input_s, &output_s);
        assert!(found.is_none_or(|tick_s| tick_s < 1e-11), "{found:?}");
    }
}
