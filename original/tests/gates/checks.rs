//! What the report's remedies keep away, shown by taking them out.

use helixlock_original::figures::calibrator::{Remedy, Step, without};
use helixlock_original::figures::discriminator::{ClockInputs, with};
use helixlock_original::figures::{Clear, divider};
use helixlock_original::{Check, Circuit, Corner, Delays, Finding, Simulator, Train};

use crate::{after, play};

const CORNERS: [Corner; 3] = [Corner::Shortest, Corner::Typical, Corner::Longest];

/// Pulses every 5 µs at a pin.
fn pulses(circuit: &Circuit, pin: &str, count: u64) -> Vec<helixlock_original::Change> {
    let pin = circuit.pin(pin).expect("a pin");
    let mut train = Train::new();
    for number in 1..=count {
        train.pulse(number * 5_000_000, pin, 2_500_000);
    }
    train.changes()
}

fn broken(findings: &[Finding], check: Check) -> Vec<&Finding> {
    findings.iter().filter(|finding| finding.check == check).collect()
}

/// Widths of the clear, ps.
fn clears(clear: Clear, corner: Corner) -> Vec<u64> {
    let circuit = divider::circuit(127, clear);
    let changes = pulses(&circuit, "pulse", 400);
    let mut simulator = after(&circuit, &Delays::corner(&circuit, corner), &changes);
    let clear_bar = circuit.pin("clear_bar").expect("a figure of ours");
    let edges = simulator.take_edges();
    let edges: Vec<_> = edges.iter().filter(|edge| edge.net == clear_bar).collect();
    edges.chunks(2).map(|pair| pair[1].time_ps - pair[0].time_ps).collect()
}

/// The clear lasts as long as the delay. At once, it is cut off by the first flip-flop that obeys:
/// by hand, from the shortest delays of JK, NAND, and two NOR, 12.5 + 5.5 + 3.5 + 6 ns, where the
/// flip-flops may ask for 25 ns.
#[test]
fn the_delay_keeps_the_clear_long() {
    for corner in CORNERS {
        let widths_ps = clears(Clear::Delayed, corner);
        assert_eq!(widths_ps.len(), 3);
        assert!(widths_ps.iter().all(|width_ps| 400_000 < *width_ps), "{corner:?}: {widths_ps:?}");
    }
    assert_eq!(clears(Clear::AtOnce, Corner::Shortest), [27_500; 3]);
}

/// By hand, 25 ns less inverter and NORs, 6 + 3.5 + 6: a flip-flop that obeys in less than
/// 9.5 ns cuts the clear of the others below what they may ask for; behind the delay it does not
/// matter.
#[test]
fn a_quick_flip_flop_cuts_the_clear_short() {
    for (clear, flip_flop_ps, count) in
        [(Clear::AtOnce, 9_400, 1), (Clear::AtOnce, 9_600, 0), (Clear::Delayed, 1_000, 0)]
    {
        let circuit = divider::circuit(4, clear);
        let shortest = Delays::corner(&circuit, Corner::Shortest);
        let delays = shortest.with(&circuit, "units_c", [8_000, flip_flop_ps]).unwrap();
        let findings = after(&circuit, &delays, &pulses(&circuit, "pulse", 40)).findings();
        let short = broken(&findings, Check::PresetClear);
        assert_eq!(!short.is_empty(), count == 1, "{clear:?} {flip_flop_ps}: {short:?}");
    }
}

/// Eighths in which T1 is high, of the fourth period.
fn eighths(step: Step, remedy: Remedy) -> Vec<bool> {
    let circuit = without(step, remedy);
    let delays = Delays::corner(&circuit, Corner::Typical);
    let mut simulator = Simulator::new(&circuit, &delays).expect("a figure of ours");
    play(&mut simulator, &pulses(&circuit, "line", 24));
    let t1 = circuit.pin("t1").expect("a figure of ours");
    let line = circuit.pin("line").expect("a figure of ours");
    let offset_ps = simulator.now_ps();
    let mut levels = vec![];
    for eighth in 0..8 {
        levels.push(simulator.level(t1));
        let at_ps = offset_ps + eighth * 5_000_000;
        simulator.drive(at_ps, line, true).expect("a figure of ours");
        simulator.drive(at_ps + 2_500_000, line, false).expect("a figure of ours");
        simulator.run_until(at_ps + 4_999_999);
    }
    levels
}

#[test]
fn calibrator_shows_its_phases() {
    for (step, high) in [(Step::Degrees180, 4), (Step::Degrees90, 2), (Step::Degrees45, 3)] {
        let expected: Vec<_> = (0..8).map(|eighth| eighth < high).collect();
        assert_eq!(eighths(step, Remedy::InPlace), expected, "{step:?}");
    }
}

/// Flip-flop E starts low, and the first toggle is the one at 3: that is 225° for ever.
#[test]
fn without_the_clamp_the_phase_is_225_degrees() {
    let expected: Vec<_> = (0..8).map(|eighth| 3 <= eighth).collect();
    assert_eq!(eighths(Step::Degrees45, Remedy::NoClamp), expected);
}

/// The decoder sees 2 while 3 ripples to 4, and E gets a clock too many; the clamp, which comes in
/// the same moment, hides it.
#[test]
fn without_the_strobe_the_ripple_is_decoded() {
    for (remedy, clocks) in [(Remedy::InPlace, 2), (Remedy::NoStrobe, 3)] {
        let circuit = without(Step::Degrees45, remedy);
        let delays = Delays::corner(&circuit, Corner::Typical);
        let mut simulator = after(&circuit, &delays, &pulses(&circuit, "line", 80));
        let toggle = circuit.pin("toggle").unwrap();
        let edges = simulator.take_edges();
        let falls = edges.iter().filter(|edge| edge.net == toggle && !edge.level).count();
        assert_eq!(falls, 10 * clocks, "{remedy:?}");
        assert_eq!(eighths(Step::Degrees45, remedy)[..4], [true, true, true, false]);
    }
}

/// Twelve comparisons of 1 ms in each of which the laser leads.
fn leading(circuit: &Circuit) -> Vec<helixlock_original::Change> {
    let [start, middle, laser] =
        ["start", "middle", "laser"].map(|pin| circuit.pin(pin).expect("a pin"));
    let mut train = Train::new();
    for number in 1..=12 {
        let begin_ps = number * 1_000_000_000;
        train.pulse(begin_ps, start, 500_000);
        train.pulse(begin_ps + 400_000_000, laser, 500_000);
        train.pulse(begin_ps + 500_000_000, middle, 500_000);
    }
    train.changes()
}

/// Edges of Q in them, with a NAND3 of this delay.
fn edges_of_q(inputs: ClockInputs, nand3_ps: u64) -> usize {
    let circuit = with(inputs);
    let typical = Delays::corner(&circuit, Corner::Typical);
    let delays = typical.with(&circuit, "nand3", [nand3_ps, nand3_ps]).expect("a figure of ours");
    let mut simulator = after(&circuit, &delays, &leading(&circuit));
    let q = circuit.pin("q").expect("a figure of ours");
    simulator.take_edges().iter().filter(|edge| edge.net == q).count()
}

/// The laser leads in every comparison: Q falls once, if it ever was high, and stays. A slow NAND3
/// lets a runt through NAND1 at each start; the clock input keeps it out until it is as long as
/// itself.
#[test]
fn the_clock_inputs_keep_runts_from_the_direction() {
    assert!(edges_of_q(ClockInputs::Coupled, 15_000) <= 1, "the slowest of the data sheet");
    assert!(11 < edges_of_q(ClockInputs::Coupled, 120_000), "a NAND3 of 120 ns is no NAND3");
    assert!(edges_of_q(ClockInputs::OfClockLength, 9_000) <= 1);
    assert!(11 < edges_of_q(ClockInputs::OfClockLength, 15_000), "within the data sheet");
    assert!(11 < edges_of_q(ClockInputs::Missing, 8_000), "within the data sheet");
}

/// Every gate that makes the runt longer at its longest, every one that makes it shorter at its
/// shortest, and the coupling as short as it may be: by hand, 11.5 + 16.5 + 15 + 18.5 = 61.5 ns.
#[test]
fn the_coupling_keeps_out_the_longest_runt_of_the_data_sheets() {
    let delays = [
        ("set", [5_500, 3_500]),
        ("meter", [5_500, 3_500]),
        ("standard_set", [22_000, 15_000]),
        ("standard", [22_000, 15_000]),
        ("nand3", [22_000, 15_000]),
        ("nand1", [22_000, 3_500]),
        ("cp1", [80_000; 2]),
    ];
    for (inputs, edges) in [(ClockInputs::Coupled, 1), (ClockInputs::OfClockLength, 23)] {
        let circuit = with(inputs);
        let mut worst = Delays::corner(&circuit, Corner::Typical);
        for (element, edges) in &delays[..delays.len() - usize::from(edges > 1)] {
            worst = worst.with(&circuit, element, *edges).expect("a figure of ours");
        }
        let mut simulator = after(&circuit, &worst, &leading(&circuit));
        let all = simulator.take_edges();
        let net = |pin: &str| circuit.pin(pin).expect("a figure of ours");
        let runt = all.iter().filter(|edge| edge.net == net("nand1"));
        let times: Vec<_> = runt.map(|edge| edge.time_ps).collect();
        assert_eq!(times[1] - times[0], 61_500, "{inputs:?}");
        assert_eq!(all.iter().filter(|edge| edge.net == net("q")).count(), edges, "{inputs:?}");
    }
}
