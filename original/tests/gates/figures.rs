//! The figures do what the tables on their pages say, at every corner of the data sheets.

use helixlock_original::figures::compensator::{self, Correction};
use helixlock_original::figures::{FIGURES, laser_direction, oscillator, phase_meter};
use helixlock_original::figures::{phase_selector, range_stage};
use helixlock_original::{Circuit, Corner, Delays, Simulator, Train, dump};

use crate::{after, play};

const CORNERS: [Corner; 3] = [Corner::Shortest, Corner::Typical, Corner::Longest];

/// Every name is a Verilog name of its own, and every wire has one driver.
#[test]
fn every_wire_has_one_driver() {
    for figure in FIGURES {
        let circuit = (figure.build)();
        let mut names: Vec<_> = circuit.nets.iter().collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{}: {names:?}", figure.name);
        let mut drivers = vec![0; circuit.nets.len()];
        drivers[..2].fill(1);
        let inputs = circuit.inputs.iter().map(|(net, _)| *net);
        for net in circuit.elements.iter().flat_map(|one| one.outputs.clone()).chain(inputs) {
            drivers[net.0] += 1;
        }
        assert!(drivers.iter().all(|count| *count == 1), "{}: {drivers:?}", figure.name);
        for (pin, net) in &circuit.outputs {
            let same = circuit.nets.iter().position(|name| name == pin);
            assert!(same.is_none_or(|number| number == net.0), "{}: {pin}", figure.name);
        }
    }
}

/// Pages have a table or a waveform, and say what is inferred.
#[test]
fn pages_are_complete() {
    for figure in FIGURES {
        let path = format!("{}/src/figures/{}.rs", env!("CARGO_MANIFEST_DIR"), figure.name);
        let page = std::fs::read_to_string(&path).expect(&path);
        assert!(page.contains("//! # Inferred"), "{path}");
        assert!(page.contains("//! | ") || page.contains("//! ```text"), "{path}");
    }
}

/// Levels of pins.
fn levels<const N: usize>(simulator: &Simulator, circuit: &Circuit, pins: [&str; N]) -> [bool; N] {
    pins.map(|pin| simulator.level(circuit.pin(pin).expect("a pin")))
}

#[test]
fn phase_meter_has_its_table() {
    for corner in CORNERS {
        let circuit = phase_meter::circuit();
        let delays = Delays::corner(&circuit, corner);
        let mut simulator = Simulator::new(&circuit, &delays).unwrap();
        let [grating, laser] = ["grating", "laser"].map(|pin| circuit.pin(pin).unwrap());
        let rows = [
            (grating, [true, false]),
            (grating, [true, false]),
            (laser, [false, true]),
            (laser, [false, true]),
        ];
        for ((pin, sides), number) in rows.into_iter().zip(1..) {
            let mut train = Train::new();
            train.pulse(number * 100_000_000, pin, 500_000);
            play(&mut simulator, &train.changes());
            assert_eq!(levels(&simulator, &circuit, ["t1", "t2"]), sides, "{corner:?} {number}");
        }
        let both_ps = 500_000_000;
        simulator.drive(both_ps, grating, true).unwrap();
        simulator.drive(both_ps, laser, true).unwrap();
        simulator.run_until(both_ps + 400_000);
        assert_eq!(levels(&simulator, &circuit, ["t1", "t2"]), [true, true]);
        simulator.drive(both_ps + 500_000, laser, false).unwrap();
        simulator.drive(both_ps + 600_000, grating, false).unwrap();
        simulator.run_until(both_ps + 1_000_000);
        assert_eq!(levels(&simulator, &circuit, ["t1", "t2"]), [true, false], "the last one wins");
    }
}

/// Rises of a pin.
fn rises(simulator: &mut Simulator, circuit: &Circuit, pin: &str) -> usize {
    let net = circuit.pin(pin).expect("a pin");
    simulator.take_edges().iter().filter(|edge| edge.net == net && edge.level).count()
}

#[test]
fn phase_selector_opens_after_m() {
    for (m, corner) in [(126, Corner::Shortest), (9, Corner::Typical), (700, Corner::Longest)] {
        let circuit = phase_selector::circuit(m);
        let [laser, grating, reset] =
            ["laser", "grating", "reset"].map(|pin| circuit.pin(pin).unwrap());
        let mut train = Train::new();
        train.level(1_000_000, reset, false);
        for number in 1..=1000 {
            train.pulse(number * 5_000_000, laser, 2_000_000);
            train.pulse(number * 5_000_000 + 3_000_000, grating, 1_000_000);
        }
        let mut simulator = after(&circuit, &Delays::corner(&circuit, corner), &train.changes());
        let passed = rises(&mut simulator, &circuit, "line");
        assert_eq!(passed, 1001 - usize::from(m), "m = {m}");
    }
}

#[test]
fn compensator_blocks_or_adds_one_in_f() {
    for (way, expected) in [(Correction::Block, 4000 - 1), (Correction::Insert, 4000 + 2)] {
        for corner in CORNERS {
            let circuit = compensator::circuit(2, way);
            let laser = circuit.pin("laser").unwrap();
            let mut train = Train::new();
            for number in 1..=4000 {
                train.pulse(number * 5_000_000, laser, 2_500_000);
            }
            let delays = Delays::corner(&circuit, corner);
            let mut simulator = Simulator::new(&circuit, &delays).unwrap();
            let pulse = circuit.pin("pulse").unwrap();
            simulator.watch(&[pulse]);
            play(&mut simulator, &train.changes());
            let edges = simulator.take_edges();
            assert_eq!(edges.iter().filter(|edge| edge.level).count(), expected, "{way:?}");
            let shortest = edges.windows(2).map(|pair| pair[1].time_ps - pair[0].time_ps).min();
            assert!(shortest.is_some_and(|ps| 47_000 <= ps), "{way:?} {corner:?}: {shortest:?}");
        }
    }
}

#[test]
fn range_stage_sorts_pulses() {
    let circuit = range_stage::circuit();
    let divided = circuit.pin("divided").unwrap();
    for corner in CORNERS {
        let mut train = Train::new();
        for number in 1..=7 {
            train.pulse(number * 5_000_000, divided, 500_000);
        }
        let mut simulator = after(&circuit, &Delays::corner(&circuit, corner), &train.changes());
        let edges = simulator.take_edges();
        let count = |pin: &str| {
            let net = circuit.pin(pin).unwrap();
            edges.iter().filter(|edge| edge.net == net && edge.level).count()
        };
        assert_eq!((count("start"), count("middle")), (4, 3), "{corner:?}");
    }
}

/// Fringes forward and back: so many pulses up and down, and the last direction.
#[test]
fn laser_direction_counts_both_ways() {
    let circuit = laser_direction::circuit();
    let [sine, cosine] = ["sine", "cosine"].map(|pin| circuit.pin(pin).unwrap());
    for corner in CORNERS {
        let mut train = Train::new();
        let mut at_ps = 0;
        let quarters = [(false, false), (true, false), (true, true), (false, true)];
        let forward = (0..20).map(|quarter| quarters[quarter % 4]);
        let back = (0..12).map(|quarter| quarters[(19 - quarter) % 4]);
        for (sine_level, cosine_level) in forward.chain(back) {
            at_ps += 20_000_000;
            train.level(at_ps, sine, sine_level);
            train.level(at_ps, cosine, cosine_level);
        }
        let mut simulator = after(&circuit, &Delays::corner(&circuit, corner), &train.changes());
        let edges = simulator.take_edges();
        let count = |pin: &str| {
            let net = circuit.pin(pin).unwrap();
            edges.iter().filter(|edge| edge.net == net && edge.level).count()
        };
        assert_eq!((count("up"), count("down")), (5, 3), "{corner:?}");
        assert_eq!(levels(&simulator, &circuit, ["forward"]), [false]);
    }
}

/// By hand: the first rise after 3 ms, then every 6 ms, which is 167 in a second.
#[test]
fn oscillator_ticks() {
    let circuit = oscillator::circuit();
    let delays = Delays::corner(&circuit, Corner::Typical);
    let mut simulator = Simulator::new(&circuit, &delays).unwrap();
    simulator.drive(1, circuit.pin("run").unwrap(), true).unwrap();
    simulator.run_until(1_000_000_000_000);
    assert_eq!(rises(&mut simulator, &circuit, "out"), 167);
}

/// The dump has every wire and every edge.
#[test]
fn dump_has_every_edge() {
    let circuit = phase_meter::circuit();
    let delays = Delays::corner(&circuit, Corner::Typical);
    let mut simulator = Simulator::new(&circuit, &delays).unwrap();
    let initial = simulator.levels().to_vec();
    let mut train = Train::new();
    train.pulse(1_000, circuit.pin("grating").unwrap(), 500_000);
    play(&mut simulator, &train.changes());
    let edges = simulator.take_edges();
    let mut text = Vec::new();
    dump(&mut text, &circuit, &initial, &edges).unwrap();
    let mut reader = vcd::Parser::new(&text[..]);
    let header = reader.parse_header().unwrap();
    assert_eq!(header.timescale, Some((1, vcd::TimescaleUnit::PS)));
    let changes =
        reader.filter(|command| matches!(command, Ok(vcd::Command::ChangeScalar(..)))).count();
    assert_eq!(changes, circuit.nets.len() + edges.len());
}
