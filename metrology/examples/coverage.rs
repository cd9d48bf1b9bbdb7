//! Prints the tables of coverage in docs/metrology.md: what is drawn has a known truth.
//!
//! `cargo run --release -p helixlock-metrology --example coverage`; with a word, only the tables
//! that have it in their name: `straightness`, `screw`, `axis`.

use std::io::Write;

use helixlock_metrology::iso230::coverage::{Axis, Condition};
use helixlock_metrology::{iso230, screw, straightness};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked = std::env::args().nth(1).unwrap_or_default();
    let mut out = std::io::stdout().lock();
    if "straightness".contains(&asked) {
        of_straightness(&mut out)?;
    }
    if "screw".contains(&asked) {
        of_screws(&mut out)?;
    }
    if "axis".contains(&asked) {
        of_axes(&mut out)?;
    }
    Ok(())
}

type Printed = Result<(), Box<dyn std::error::Error>>;

fn of_straightness(out: &mut impl Write) -> Printed {
    use straightness::coverage::{Bar, Condition, coverage};
    writeln!(out, "| bar | | Fourier | least squares | zone, Fourier | zone, least squares |")?;
    writeln!(out, "|---|---|---|---|---|---|")?;
    let usual = Bar::ALL.map(|bar| (bar, Condition::Usual, 1000));
    let others = Condition::ALL.iter().skip(1).flat_map(|condition| {
        [Bar::Repeating, Bar::NotRepeating, Bar::Wandering].map(|bar| (bar, *condition, 400))
    });
    // What is lost in noise is asked of waves alone.
    let others = others.filter(|(bar, condition, _)| {
        let loud = matches!(condition, Condition::Loud | Condition::Louder);
        *bar == Bar::NotRepeating || !loud
    });
    for (bar, condition, records) in usual.into_iter().chain(others) {
        let found = coverage((bar, condition), records, 1)?;
        let [by_fourier, by_squares] = found.minimum_zone;
        let held = [found.fourier, found.least_squares, by_fourier, by_squares]
            .map(|share| format!("{:.1} %", 100.0 * share))
            .join(" | ");
        writeln!(out, "| {} | {} | {held} |", bar.in_words(), condition.in_words())?;
    }
    Ok(writeln!(out)?)
}

fn of_screws(out: &mut impl Write) -> Printed {
    let header = "| screw | noise | | widened by | left of it | u | ±1.96 u holds |";
    writeln!(out, "{header}\n|---|---|---|---|---|---|---|")?;
    for kind in screw::coverage::Screw::ALL {
        for noise_um in [0.05, 0.25, 0.6] {
            let found = screw::coverage::coverage(kind, noise_um, 500, 1);
            // The figures of JB/T 2886 are those of the same curve, the line left in.
            let all = kind == screw::coverage::Screw::TooLong;
            let of_variation = |symbol: &str| symbol == "V300" || symbol == "V2π";
            for found in found.into_iter().filter(|one| all || of_variation(one.symbol)) {
                let (symbol, widened, left) = (found.symbol, found.widening_um, found.left_um);
                let (kind, held) = (kind.in_words(), 100.0 * found.held);
                let sizes =
                    format!("{widened:.2} µm | {left:+.3} µm | {:.3} µm", found.uncertainty_um);
                writeln!(out, "| {kind} | {noise_um} µm | {symbol} | {sizes} | {held:.1} % |")?;
            }
        }
    }
    Ok(writeln!(out)?)
}

fn of_axes(out: &mut impl Write) -> Printed {
    let shown = ["A", "E", "M", "B", "B̄", "R", "P", "Ps"];
    writeln!(out, "| axis | drift | | {} |", shown.join(" | "))?;
    writeln!(out, "|---|---|---|{}", "---|".repeat(shown.len()))?;
    for (axis, condition, variation_um) in drawn_axes() {
        let found = iso230::coverage::coverage((axis, condition), variation_um, 100, 1)?;
        let held = |symbol: &&str| {
            let share = found.iter().find(|(name, _)| name == symbol).map_or(0.0, |one| one.1);
            format!("{:.1} %", 100.0 * share)
        };
        let held: Vec<String> = shown.iter().map(held).collect();
        let (axis, condition) = (axis.in_words(), condition.in_words());
        writeln!(out, "| {axis} | {variation_um} µm | {condition} | {} |", held.join(" | "))?;
    }
    Ok(writeln!(out)?)
}

/// Every axis as usual with little and much drift, then three under other conditions, and one where the
/// axis drifts itself or the drift cycles.
fn drawn_axes() -> Vec<(Axis, Condition, f64)> {
    let usual = Axis::ALL
        .iter()
        .flat_map(|axis| [0.1, 0.5].map(|variation_um| (*axis, Condition::Usual, variation_um)));
    let others = Condition::ALL.iter().skip(1).flat_map(|condition| {
        let (axes, variation_um) = match condition {
            // What drifts is not to make half of the scatter.
            Condition::Still => (3, 0.05),
            Condition::OwnRuns | Condition::Growing => (1, 0.2),
            condition if condition.cycles() => (1, 0.5),
            _ => (3, 0.5),
        };
        let axes = [Axis::Rising, Axis::Waves, Axis::Flat].into_iter().take(axes);
        axes.map(move |axis| (axis, *condition, variation_um))
    });
    usual.chain(others).collect()
}
