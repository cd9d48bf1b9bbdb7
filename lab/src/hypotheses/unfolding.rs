//! Lines in time above what the samples resolve: at the comparisons of two speeds one frequency
//! shows at two places, and only itself at both; where rows come nearly evenly its aliases lose a part of it.

use crate::model::Problem;
use crate::numerics::{count, in_parallel, nearly_even_rate};
use crate::policy::evidence::MARGIN;
use crate::policy::size::ANOTHER_SPEED;
use crate::spectrum::Scan;

/// Strongest lines that may be aliases, and most comparison rates by which they are unfolded.
const LINES: usize = 4;
const RATES: u16 = 8;

/// Speeds whose comparison rates are tried.
const SPEEDS: usize = 8;

/// Unfolded lines whose frequency is settled.
const SETTLED: usize = 8;

/// The frequency beyond a scan that explains a whitened residual better than its strongest lines,
/// as they are, by the margin; `None` at one speed where rows come evenly, which cannot tell it from them, and where
/// a loop swings at half of every rate.
#[must_use]
pub(crate) fn unfolded(
    problem: &Problem,
    scan: &Scan<'_>,
    white: &[f64],
    lines: &[f64],
) -> Option<f64> {
    if 0.0 < problem.hunting_um {
        return None;
    }
    let mut rates = comparison_rates_hz(problem);
    if rates.len() < 2 {
        let blocks = scan.layout.blocks.iter();
        let passes: Vec<&[f64]> = blocks.map(|block| &scan.turns[block.rows.clone()]).collect();
        rates = vec![nearly_even_rate(&passes)?];
    }
    let lines = &lines[..lines.len().min(LINES)];
    let as_they_are = lines.iter().map(|line| scan.settled(white, *line).1).fold(0.0, f64::max);
    let multiples = rates.iter().flat_map(|rate| (1..=RATES).map(move |k| f64::from(k) * rate));
    let beyond = multiples
        .flat_map(|multiple| lines.iter().flat_map(move |line| [multiple - line, multiple + line]));
    let beyond = beyond.filter(|hertz| scan.highest < *hertz);
    let with_gain = |hertz: f64| (hertz, scan.gain(white, hertz));
    let mut beyond: Vec<(f64, f64)> = in_parallel(beyond, with_gain);
    beyond.sort_by(|a, b| b.1.total_cmp(&a.1));
    // What the samples tell takes several times as long as a gain, and is asked of the best only.
    let told = beyond.iter().filter(|(hertz, _)| scan.tells(*hertz));
    let settled = told.take(SETTLED).map(|(hertz, _)| scan.settled(white, *hertz));
    let (hertz, gain) = settled.max_by(|a, b| a.1.total_cmp(&b.1))?;
    let price = 2.0 * libm::log(2.0 * count(lines.len() * rates.len()) * f64::from(RATES));
    (as_they_are + MARGIN + price < gain).then_some(hertz)
}

/// Comparisons a second at the speeds that most of a record has. Where the speed is another from row to row, there
/// are as many as rows, and none of them has samples enough for an alias.
fn comparison_rates_hz(problem: &Problem) -> Vec<f64> {
    let machine = &problem.model;
    let mut speeds = problem.record.speed_rpm.to_vec();
    speeds.sort_by(f64::total_cmp);
    let mut alike: Vec<(f64, usize)> = Vec::new();
    for rpm in speeds {
        match alike.last_mut().filter(|(known, _)| rpm - *known <= ANOTHER_SPEED * *known) {
            Some((_, rows)) => *rows += 1,
            None => alike.push((rpm, 1)),
        }
    }
    alike.sort_by_key(|(_, rows)| std::cmp::Reverse(*rows));
    let usual = alike.iter().take(SPEEDS);
    usual.map(|(rpm, _)| machine.comparison_hz() * rpm / machine.spindle.speed_rpm).collect()
}
