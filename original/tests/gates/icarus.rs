//! Icarus runs the structural Verilog to the same edges, all of them, of every wire.

use std::fmt::Write;
use std::path::Path;
use std::process::Command;

use helixlock_original::device::{self, Wheels};
use helixlock_original::figures::FIGURES;
use helixlock_original::figures::compensator::Correction;
use helixlock_original::{
    Change, Circuit, Corner, Delays, Edge, Net, Simulator, at_every_pin, bench, verilog,
};

/// Behind the last change, ps.
const TAIL_PS: u64 = 50_000_000;

/// Figures, delays at the corners of the sheet, and pulses at every pin.
#[test]
fn agrees_on_every_edge_at_the_corners() {
    for figure in FIGURES {
        let circuit = (figure.build)();
        let changes = at_every_pin(&circuit, 300, 1977);
        for corner in [Corner::Shortest, Corner::Typical, Corner::Longest] {
            let delays = Delays::corner(&circuit, corner);
            assert!(changes.len() < agree(&circuit, &delays, &changes), "{}", figure.name);
        }
    }
}

/// The same with delays drawn for each edge of each part.
#[test]
fn agrees_on_every_edge_with_drawn_delays() {
    for figure in FIGURES {
        let circuit = (figure.build)();
        for seed in 0..2 {
            let changes = at_every_pin(&circuit, 300, seed);
            agree(&circuit, &Delays::drawn(&circuit, seed), &changes);
        }
    }
}

/// All figures joined.
#[test]
fn agrees_on_every_edge_of_the_device() {
    let wheels =
        Wheels { a: 3, b: 4, initial_phase: 2, compensation: Some((1, Correction::Insert)) };
    let circuit = device::circuit(&wheels);
    let changes = at_every_pin(&circuit, 300, 1977);
    let delays = Delays::corner(&circuit, Corner::Typical);
    assert!(changes.len() < agree(&circuit, &delays, &changes));
}

/// 100 000 pulses at every pin, three corners and a hundred drawn delay sets.
#[test]
#[ignore = "takes hours, ten seconds for a set of delays and a small figure; run with `cargo test -p helixlock-original --release -- --ignored`"]
fn agrees_on_every_edge_of_the_long_run() {
    for figure in FIGURES {
        let circuit = (figure.build)();
        let corners = [Corner::Shortest, Corner::Typical, Corner::Longest];
        let corners = corners.map(|corner| Delays::corner(&circuit, corner));
        let drawn = (0..100).map(|seed| Delays::drawn(&circuit, seed));
        for (seed, delays) in (0..).zip(corners.into_iter().chain(drawn)) {
            agree(&circuit, &delays, &at_every_pin(&circuit, 100_000, seed));
        }
    }
}

/// Compares them, and gives the number of edges.
fn agree(circuit: &Circuit, delays: &Delays, changes: &[Change]) -> usize {
    let mut simulator = Simulator::new(circuit, delays).expect("it rests at power-up");
    let text = verilog(circuit, delays, simulator.levels());
    crate::play(&mut simulator, changes);
    let ours = simulator.take_edges();
    let icarus = run(circuit, &text, changes);
    let differs = ours.iter().zip(&icarus).find(|(one, other)| one != other);
    if let Some((one, other)) = differs {
        let named = |edge: &Edge| (edge.time_ps, circuit.nets[edge.net.0].clone(), edge.level);
        panic!("{}: ours {:?}, Icarus {:?}", circuit.name, named(one), named(other));
    }
    assert_eq!(ours.len(), icarus.len(), "{}", circuit.name);
    ours.len()
}

fn run(circuit: &Circuit, text: &str, changes: &[Change]) -> Vec<Edge> {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let mut stimuli = String::new();
    for (at, pin, level) in changes {
        writeln!(stimuli, "{at} {} {}", pin.0, u8::from(*level)).expect("text takes text");
    }
    put(folder.path(), "device.v", text);
    put(folder.path(), "bench.v", &bench(circuit, TAIL_PS));
    put(folder.path(), "stimuli.txt", &stimuli);
    let words = ["-g2005", "-Wall", "-Wno-timescale", "-s", "bench", "-o", "bench.vvp"];
    tool(folder.path(), "iverilog", &[&words[..], &["device.v", "bench.v"]].concat());
    tool(folder.path(), "vvp", &["-n", "bench.vvp"]);
    let edges = std::fs::read_to_string(folder.path().join("edges.txt")).expect("edges");
    let mut edges: Vec<Edge> = edges.lines().filter_map(edge).collect();
    edges.sort_unstable();
    edges
}

/// An edge, unless it is the first level at power-up.
fn edge(line: &str) -> Option<Edge> {
    let mut words = line.split(' ');
    let mut word = || words.next().expect("three words");
    let time_ps = word().parse().expect("a time");
    if time_ps == 0 {
        return None;
    }
    let net = Net(word().parse().expect("a number"));
    let level = match word() {
        "0" => false,
        "1" => true,
        other => panic!("undefined level {other} at {time_ps} ps"),
    };
    Some(Edge { time_ps, net, level })
}

fn tool(folder: &Path, name: &str, words: &[&str]) {
    let ran = Command::new(name).args(words).current_dir(folder).output();
    let ran = ran.unwrap_or_else(|error| panic!("{name} is not installed: {error}"));
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success() && said.is_empty(), "{name}: {said}");
}

#[expect(clippy::disallowed_methods, reason = "a test makes its own input, in its own folder")]
fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("the folder of the test takes files");
}
