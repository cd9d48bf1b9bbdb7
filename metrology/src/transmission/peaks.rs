//! The tallest lines of a spectrum, with the shafts they may come from.

use super::order_spectrum::{OrderLine, OrderSpectrum, Shaft};

/// A tall line and who may make it.
#[derive(Clone, Debug, PartialEq)]
pub struct Peak {
    /// The line.
    pub line: OrderLine,
    /// Shafts whose order lies within half the distance of lines; none: a shaft nobody named.
    pub shafts: Vec<String>,
}

/// A line counts as a peak when it is this many times the median line.
const ABOVE_MEDIAN: f64 = 4.0;

/// The `count` tallest lines that stand above both neighbours and the median, the tallest first.
#[must_use]
pub fn peaks(spectrum: &OrderSpectrum, shafts: &[Shaft], count: usize) -> Vec<Peak> {
    let lines = &spectrum.lines;
    let mut amplitudes: Vec<f64> = lines.iter().map(|line| line.amplitude_rad).collect();
    amplitudes.sort_by(f64::total_cmp);
    let Some(&median) = amplitudes.get(amplitudes.len() / 2) else { return Vec::new() };
    let at = |index: usize| lines.get(index).map_or(0.0, |line| line.amplitude_rad);
    let tall = |index: &usize| {
        let here = at(*index);
        let before = index.checked_sub(1).map_or(0.0, at);
        ABOVE_MEDIAN * median < here && before <= here && at(index + 1) < here
    };
    let mut found: Vec<&OrderLine> =
        (0..lines.len()).filter(tall).map(|index| &lines[index]).collect();
    found.sort_by(|a, b| b.amplitude_rad.total_cmp(&a.amplitude_rad));
    let half = lines.first().map_or(0.0, |line| line.order / 2.0);
    let named = |line: &OrderLine| Peak {
        line: line.clone(),
        shafts: shafts
            .iter()
            .filter(|shaft| (shaft.order - line.order).abs() <= half)
            .map(|shaft| shaft.name.clone())
            .collect(),
    };
    found.into_iter().take(count).map(named).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tall_lines_are_named_and_short_ones_left_out() {
        let amplitude = |index: u32| match index {
            9 => 5.0,
            29 => 2.0,
            _ => 0.01,
        };
        let lines = (0..100).map(|index| OrderLine {
            order: f64::from(index + 1) / 2.0,
            amplitude_rad: amplitude(index),
        });
        let spectrum = OrderSpectrum {
            turns: 2.0,
            slope_rad_per_turn: None,
            lines: lines.collect(),
            shafts: vec![],
        };
        let worm = Shaft { name: "worm".into(), order: 15.1 };
        let found = peaks(&spectrum, &[worm], 5);
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].line.order, found[0].shafts.len()), (5.0, 0));
        assert_eq!(found[1].shafts, ["worm"]);
    }
}
