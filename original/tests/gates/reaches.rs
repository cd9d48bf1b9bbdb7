//! What glitches of the gates do not reach.

use helixlock_original::device::{self, Wheels};
use helixlock_original::figures::reset_counter;
use helixlock_original::{Circuit, Delays, Edge, Net, Simulator, Train};

/// Steps out, and back by playback.
const STEPS: u64 = 300;
/// From step to step, ps.
const PERIOD_PS: u64 = 5_000_000;

/// Line 158 has glitches: where many stages change at once all of them may be low for a moment. It
/// is heeded while a step is high, and stages change when it falls. So playback takes every step
/// back, and the side is clocked by the first step alone.
#[test]
fn a_glitch_of_zero_reaches_nothing() {
    let circuit = reset_counter::circuit();
    let net = |pin: &str| circuit.pin(pin).expect("a pin");
    let [request, forward, playback] = ["request", "forward", "playback"].map(net);
    let mut train = Train::new();
    for number in 1..=2 * STEPS + 20 {
        train.pulse(number * PERIOD_PS, request, PERIOD_PS / 2);
    }
    let between_ps = STEPS * PERIOD_PS + 3 * PERIOD_PS / 4;
    train.level(between_ps, playback, true);
    train.level(between_ps, forward, false);
    let mut glitches = 0;
    for seed in 0..20 {
        let delays = Delays::drawn(&circuit, seed);
        let mut simulator = Simulator::new(&circuit, &delays).expect("it rests at power-up");
        crate::play(&mut simulator, &train.clone().changes());
        let edges = simulator.take_edges();
        let rises = |wire: Net| edges.iter().filter(move |edge| edge.net == wire && edge.level);
        assert_eq!(rises(net("taken")).count() as u64, 2 * STEPS, "seed {seed}");
        assert_eq!(rises(net("side_clock")).count(), 1, "seed {seed}");
        assert!(simulator.level(net("zero")), "seed {seed}");
        // The last rise of zero is the one that stays.
        glitches += rises(net("zero")).count() - 1;
        let high = |instant: &Edge| {
            let before = edges.iter().filter(|edge| edge.net == net("taken"));
            before
                .take_while(|edge| edge.time_ps <= instant.time_ps)
                .last()
                .is_some_and(|e| e.level)
        };
        assert!(rises(net("zero")).all(|edge| !high(edge)), "seed {seed}");
    }
    assert!(20 < glitches, "glitches: {glitches}");
}

/// A line, and what a comparison of eight of them lasts, ps.
const LINE_PS: u64 = 25_000_000;
/// A fringe, ps; twenty to a comparison.
const FRINGE_PS: u64 = 10_000_000;

/// A line more or less at the gate of figure 8 is another zero of the pass: the meter is high for a
/// line longer in every comparison, and for nothing else.
#[test]
fn a_line_more_is_another_zero() {
    let wheels = Wheels { a: 4, b: 10, initial_phase: 3, compensation: None };
    let circuit = device::circuit(&wheels);
    let behind_ps = 500_000;
    for delays in (0..5).map(|seed| Delays::drawn(&circuit, seed)) {
        let without = widths_ps(&circuit, &delays, 0);
        let with = widths_ps(&circuit, &delays, behind_ps);
        let longer: Vec<_> =
            with.iter().zip(&without).map(|(with, without)| with - without).collect();
        assert!(10 < longer.len());
        assert!(longer.iter().all(|longer| *longer == LINE_PS - behind_ps), "{longer:?}");
    }
}

/// How long the meter was high in each comparison, a line falling so long behind the third fringe.
fn widths_ps(circuit: &Circuit, delays: &Delays, behind_ps: u64) -> Vec<u64> {
    let [grating, laser, reset, meter] =
        ["grating", "laser", "reset", "meter"].map(|pin| circuit.pin(pin).expect("a pin"));
    let mut train = Train::new();
    train.level(1_000_000, reset, false);
    for fringe in 1..=300 {
        train.pulse(fringe * FRINGE_PS, laser, FRINGE_PS / 2);
    }
    let opens_ps = 3 * FRINGE_PS + FRINGE_PS / 2;
    for line in 0..118 {
        train.pulse(opens_ps + behind_ps - LINE_PS / 2 + line * LINE_PS, grating, LINE_PS / 2);
    }
    let edges = crate::after(circuit, delays, &train.changes()).take_edges();
    let mut own = edges.iter().filter(|edge| edge.net == meter).skip_while(|edge| !edge.level);
    let mut widths = vec![];
    while let (Some(rises), Some(falls)) = (own.next(), own.next()) {
        widths.push(falls.time_ps - rises.time_ps);
    }
    widths
}

/// A direction that is new when a step comes leaves the counter beside what the motor does, by 32 at
/// the carry out of its fifth bit. The motor steps rightly all the same; playback ends as far beside
/// zero, and a reset is the end of it.
#[test]
fn a_miscount_is_seen_by_playback_alone() {
    let circuit = reset_counter::circuit();
    let net = |pin: &str| circuit.pin(pin).expect("a pin");
    let [turned_ps, reset_ps] = [32, 140].map(|number| number * PERIOD_PS + 3 * PERIOD_PS / 4);
    let mut train = Train::new();
    (1..=147).for_each(|number| train.pulse(number * PERIOD_PS, net("request"), PERIOD_PS / 2));
    train.level(32 * PERIOD_PS - 88_000, net("forward"), false);
    train.level(turned_ps, net("playback"), true);
    train.level(reset_ps, net("playback"), false);
    train.level(reset_ps, net("reset_bar"), false);
    train.level(reset_ps + PERIOD_PS / 16, net("reset_bar"), true);
    let mut simulator = Simulator::new(&circuit, &Delays::drawn(&circuit, 1)).expect("it rests");
    let (mut edges, mut seen) = (vec![], vec![]);
    let mut changes = train.changes().into_iter().peekable();
    for until_ps in [turned_ps, reset_ps, 148 * PERIOD_PS] {
        while let Some((time_ps, pin, level)) = changes.next_if(|change| change.0 < until_ps) {
            simulator.drive(time_ps, pin, level).expect("in the order of time");
        }
        simulator.run_until(until_ps - 1);
        edges.extend(simulator.take_edges());
        let bit = |bit| i32::from(simulator.level(net(&format!("count{bit}")))) << bit;
        seen.push((steps(&circuit, &edges), (0..12).map(bit).sum::<i32>()));
    }
    assert_eq!(seen, [(30, 62), (-32, 0), (-39, 7)]);
}

/// Steps that the motor took, forward positive, from edges that begin with it going forward.
fn steps(circuit: &Circuit, edges: &[Edge]) -> i32 {
    let [taken, drive] = ["taken", "drive_forward"].map(|pin| circuit.pin(pin).expect("a wire"));
    let mut ahead = true;
    let mut steps = 0;
    for edge in edges {
        if edge.net == drive {
            ahead = edge.level;
        } else if edge.net == taken && edge.level {
            steps += if ahead { 1 } else { -1 };
        }
    }
    steps
}
