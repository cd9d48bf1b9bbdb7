//! Prints the tables of coverage in docs/metrology.md: what is drawn has a known truth.
//!
//! `cargo run --release -p helixlock-metrology --example coverage`; with a word, only the tables
//! that have it in their name: `straightness`, `screw`, `axis`; with a number behind it, over so many
//! records a row of screws.

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
        let records = std::env::args().nth(2).map_or(Ok(SCREWS), |number| number.parse())?;
        of_screws(&mut out, records)?;
    }
    if "axis".contains(&asked) {
        of_axes(&mut out)?;
    }
    Ok(())
}

/// Drawn screws a row.
const SCREWS: u32 = 300;

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

fn of_screws(out: &mut impl Write, records: u32) -> Printed {
    let sizes = "widened by | left of it | u | holds";
    writeln!(out, "| screw | noise | V300 {sizes} | V2π {sizes} | ΔL300 holds | ΔLu | ΔP | e |")?;
    writeln!(out, "|---|---|{}", "---|".repeat(12))?;
    for kind in screw::coverage::Screw::ALL {
        for noise_um in [0.05, 0.25, 0.6] {
            let found = screw::coverage::coverage(kind, noise_um, records, 1);
            let of = |symbol: &str| {
                found.iter().find(|one| one.symbol == symbol).ok_or("it is one of those shown")
            };
            write!(out, "| {} | {noise_um} µm |", kind.in_words())?;
            for one in [of("V300")?, of("V2π")?] {
                let (widened, left, u) = (one.widening_um, one.left_um, one.uncertainty_um);
                write!(out, " {widened:.2} µm | {left:+.3} µm | {u:.3} µm |{}", holds(one))?;
            }
            for symbol in ["ΔL300", "ΔLu", "ΔP", "e"] {
                write!(out, "{}", holds(of(symbol)?))?;
            }
            writeln!(out)?;
        }
    }
    Ok(writeln!(out)?)
}

/// A cell: how often ±1.96 u holds the truth.
fn holds(one: &screw::coverage::Coverage) -> String {
    format!(" {:.1} % |", 100.0 * one.held)
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
