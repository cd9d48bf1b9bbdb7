//! What glitches of the gates do not reach.

use helixlock_original::figures::reset_counter;
use helixlock_original::{Delays, Edge, Net, Simulator, Train};

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
