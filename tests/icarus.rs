//! Icarus runs the original's structural Verilog to the same edges, all of them, of every wire.
//!
//! `cargo xtask icarus` does the same for 100 000 pulses at every pin and a hundred drawn sets of
//! delays; what it has compared stands in `original/icarus.csv`.

use helixlock_evidence::icarus::{CIRCUITS, Case, Row, Style, agree, ours, rows};
use helixlock_original::figures::{Clear, FIGURES, divider};
use helixlock_original::{Corner, Delays, Train};

use crate::support::command::repository;

/// Every figure, and all of them joined, at the corners of the data sheets and with drawn delays.
#[test]
fn agrees_on_every_edge() {
    let drawn = (0..2).map(|seed| ("drawn", seed));
    for (delays, seed) in [("shortest", 1), ("typical", 2), ("longest", 3)].into_iter().chain(drawn)
    {
        for place in 0..CIRCUITS {
            let case = Case::new(place, delays, seed, 300).expect("it rests at power-up");
            let changes = case.changes();
            let edges = agree(&case.circuit, &case.delays, &changes, Style::Gates);
            assert!(changes.len() < edges.expect("alike"), "{}", case.row);
        }
    }
}

/// Delays in specify blocks give the same edges where nothing is swallowed.
#[test]
fn agrees_with_delays_in_specify_blocks() {
    let circuit = divider::circuit(127, Clear::Delayed);
    let pulse = circuit.pin("pulse").expect("a pin");
    let mut train = Train::new();
    for number in 1..=400 {
        train.pulse(number * 5_000_000, pulse, 2_500_000);
    }
    let changes = train.changes();
    for corner in [Corner::Shortest, Corner::Typical, Corner::Longest] {
        let delays = Delays::corner(&circuit, corner);
        let edges = agree(&circuit, &delays, &changes, Style::Paths).expect("alike");
        assert!(changes.len() < edges, "{corner:?}");
    }
}

/// One gate a picosecond slower is seen.
#[test]
fn a_picosecond_is_seen() {
    let case = Case::new(0, "typical", 1, 100).expect("it rests at power-up");
    let slower = case.delays.clone().with(&case.circuit, "set", [11_001, 7_000]).expect("a gate");
    let changes = case.changes();
    let ours = ours(&case.circuit, &case.delays, &changes).expect("it runs");
    let other = helixlock_evidence::icarus::icarus(&case.circuit, &slower, &changes, Style::Gates);
    assert_ne!(ours, other.expect("Icarus, a Debian package, starts"));
}

/// The rows of the long run are of the netlists as they are, the page says how many they are, and of
/// each circuit the last one's pulses give as many edges as they gave then.
#[test]
fn what_was_compared_is_not_stale() {
    let known = rows(&repository().join("original/icarus.csv")).expect("a table");
    let place = |row: &Row| {
        let named = (0..CIRCUITS).find(|place| name(*place) == row.circuit);
        named.unwrap_or_else(|| panic!("{row} is of no circuit"))
    };
    let case = |row: &Row| {
        Case::new(place(row), &row.delays, row.seed, row.pulses).expect("it rests at power-up")
    };
    for row in &known {
        assert!(case(row).is(row), "{row} is of another netlist: run `cargo xtask icarus`");
    }
    for place in 0..CIRCUITS {
        let row = known.iter().rev().find(|row| row.circuit == name(place)).expect("a row");
        let case = case(row);
        let edges = ours(&case.circuit, &case.delays, &case.changes()).expect("it runs");
        assert_eq!(edges.len(), row.edges, "{row}");
    }
    let page = std::fs::read_to_string(repository().join("docs/verification.md")).expect("a page");
    let edges: usize = known.iter().map(|row| row.edges).sum();
    let said = format!("{} of 1339 comparisons, {edges} edges", known.len());
    assert!(page.contains(&said), "docs/verification.md is to say: {said}");
}

fn name(place: usize) -> String {
    FIGURES.get(place).map_or("device", |figure| figure.name).to_owned()
}
