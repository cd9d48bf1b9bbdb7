//! The ring distributor does what its page says.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// The six legal drives ABC, in forward order.
const SEQUENCE: [u64; 6] = [0b100, 0b110, 0b010, 0b011, 0b001, 0b101];

fn drives(bench: &mut Bench) -> u64 {
    bench.get("phase_a") << 2 | bench.get("phase_b") << 1 | bench.get("phase_c")
}

fn put(bench: &mut Bench, drives: u64) {
    bench.force(&[("a_q", drives >> 2), ("b_q", drives >> 1 & 1), ("c_q", drives & 1)]);
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Whatever the history of steps, the drives are those of the net position.
    #[test]
    fn drives_follow_the_net_position(history in vec(any::<Option<bool>>(), 0..200)) {
        let mut ring = Bench::new("ring_distributor");
        ring.clock();
        let mut position = 0; // one step back is five forward
        for step in history {
            ring.set(&[("step", step.is_some().into())]);
            ring.set(&[("forward", step.unwrap_or(false).into())]);
            ring.clock();
            position += step.map_or(0, |forward| if forward { 1 } else { 5 });
            prop_assert_eq!(drives(&mut ring), SEQUENCE[position % 6], "after {:?}", step);
        }
    }
}

/// From every state, legal or not, whatever comes, the next one is legal.
#[test]
fn recovers_from_every_state() {
    for state in 0..8 {
        for inputs in 0..8_u64 {
            let mut ring = Bench::new("ring_distributor");
            put(&mut ring, state);
            ring.set(&[("clear", inputs >> 2), ("step", inputs >> 1 & 1), ("forward", inputs & 1)]);
            ring.clock();
            let next = drives(&mut ring);
            assert!(SEQUENCE.contains(&next), "{state:03b} to {next:03b}");
            if inputs >> 2 == 1 || !SEQUENCE.contains(&state) {
                assert_eq!(next, 0b100, "cleared from {state:03b}");
            }
        }
    }
}
