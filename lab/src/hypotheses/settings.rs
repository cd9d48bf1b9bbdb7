//! Numbers of the machine file that may be other than the file says.
//!
//! A wrong divider, line count or lead leaves an exact slope, because each enters the comparison
//! as a plain factor. A slope that equals such a ratio to within its error is a setting, not
//! physics.

use helixlock_plant::{CATALOGUE, Card, Machine, Term};

/// Leads taken for each other: inch for metric, two starts, π as 22/7.
const LEAD_RATIOS: [f64; 5] =
    [25.4 / 25.0, 25.0 / 25.4, 2.0, 0.5, 22.0 / 7.0 / std::f64::consts::PI];

/// The effect of every setting worth a look: digit slips and neighbours, counts of ten for counts
/// of two, the other track, inch for metric.
#[must_use]
pub(crate) fn alternatives(machine: &Machine) -> Vec<Term> {
    let has = |card: &&&Card| card.nature.is_setting() && machine.lacks(card.parts).is_none();
    let Some(card) = CATALOGUE.iter().find(has) else {
        return Vec::new();
    };
    let lead_mm = machine.workpiece.lead.mm();
    let lines = line_counts(machine.grating.lines).into_iter().map(|n| ("lines", f64::from(n)));
    let a = slips(u32::from(machine.dividers.a)).into_iter().map(|n| ("a", f64::from(n)));
    let b = slips(u32::from(machine.dividers.b)).into_iter().map(|n| ("b", f64::from(n)));
    let leads = LEAD_RATIOS.iter().map(|ratio| ("lead", lead_mm * ratio));
    let all: Vec<_> = lines.chain(a).chain(b).chain(leads).collect();
    [0.0, 1.0, 2.0]
        .into_iter()
        .flat_map(|reading| all.iter().map(move |what| (*what, reading)))
        .filter_map(|((parameter, value), reading)| {
            let mut term = Term::candidate(card, machine.rotary);
            let place = |name| term.parameters.iter().position(|what| what.name == name);
            let (index, how) = (place(parameter)?, place("reading")?);
            term.values[index] = value;
            term.values[how] = reading;
            Some(term)
        })
        .collect()
}

/// One thumb wheel turned, two digits exchanged, the next number, twice or half.
fn slips(number: u32) -> Vec<u32> {
    const MOST: u32 = 999;
    let mut slips = vec![number.saturating_sub(1), number + 1, 2 * number, number / 2];
    slips.extend(misread(number, 3));
    distinct(slips, number, MOST)
}

/// One digit of a number taken for another, or two exchanged.
fn misread(number: u32, digits: u32) -> Vec<u32> {
    let digit = |place: u32| number / 10_u32.pow(place) % 10;
    let without = |place: u32| digit(place) * 10_u32.pow(place);
    let mut numbers = Vec::new();
    for place in 0..digits {
        let rest = number - without(place);
        numbers.extend((0..10).map(|other| rest + other * 10_u32.pow(place)));
        for higher in place + 1..digits {
            let exchanged = digit(higher) * 10_u32.pow(place) + digit(place) * 10_u32.pow(higher);
            numbers.push(rest - without(higher) + exchanged);
        }
    }
    numbers
}

/// The two tracks of the disc of document 1.
const TRACKS: &[u32] = &[13_906, 11_060];

/// Line counts that encoders are sold with, taken for each other on the shelf.
const STOCK: &[u32] = &[
    100, 128, 200, 250, 256, 300, 360, 400, 500, 512, 600, 720, 800, 900, 1000, 1024, 1200, 1250,
    1440, 1500, 1800, 2000, 2048, 2500, 3000, 3600, 4000, 4096, 5000, 8192, 9000, 10_000,
];

/// Counts that are mistaken for each other, digits misread, and the neighbours.
fn line_counts(lines: u32) -> Vec<u32> {
    let mut counts = vec![lines.saturating_sub(1), lines + 1, 2 * lines, 4 * lines];
    for family in [TRACKS, STOCK] {
        counts.extend(family.iter().filter(|_| family.contains(&lines)));
    }
    counts.extend([2, 4].into_iter().filter(|n| lines.is_multiple_of(*n)).map(|n| lines / n));
    // Decimal for binary at any size: 1000 for 1024, 500 for 512, interpolated or not.
    counts.extend(misread(lines, lines.checked_ilog10().unwrap_or(0) + 1));
    counts.extend((lines.is_multiple_of(128)).then_some(lines / 128 * 125));
    counts.extend((lines.is_multiple_of(125)).then_some(lines / 125 * 128));
    distinct(counts, lines, u32::MAX)
}

fn distinct(mut numbers: Vec<u32>, not: u32, most: u32) -> Vec<u32> {
    numbers.sort_unstable();
    numbers.dedup();
    numbers.retain(|number| 0 < *number && *number <= most && *number != not);
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_binary_count_is_taken_for_a_decimal_one() {
        assert!(line_counts(1024).contains(&1000));
        assert!(line_counts(1000).contains(&1024));
        assert!(line_counts(13_906).contains(&11_060));
    }

    #[test]
    fn digits_of_a_line_count_are_misread() {
        for expected in [13_900, 13_960, 19_306, 3_906] {
            assert!(line_counts(13_906).contains(&expected), "{expected}");
        }
    }

    #[test]
    fn slips_turn_one_wheel_or_exchange_two() {
        let slips = slips(127);
        for expected in [126, 128, 27, 197, 172, 217, 721] {
            assert!(slips.contains(&expected), "{expected}");
        }
        assert!(!slips.contains(&127) && !slips.contains(&0));
    }
}
