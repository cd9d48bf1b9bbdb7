//! Steps are asked for at ticks only, by the one whose turn it is.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

const INPUTS: [&str; 8] = [
    "clear",
    "tick",
    "correcting",
    "automatic_forward",
    "manual_enable",
    "manual_step",
    "manual_forward",
    "playback",
];

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Against the table of its page, for any history.
    #[test]
    fn asks_by_priority(history in vec(any::<[bool; 8]>(), 0..200)) {
        let mut bench = Bench::new("step_selector");
        let mut waits = false;
        for levels in history {
            for (input, level) in INPUTS.iter().zip(levels) {
                bench.set(&[(input, level.into())]);
            }
            let [clear, tick, correcting, automatic, enable, press, switch, playback] = levels;
            let manual = waits && enable && !playback;
            prop_assert_eq!(bench.high("request"), tick && (playback || correcting || manual));
            let forward = if manual && !correcting { switch } else { automatic };
            prop_assert_eq!(bench.high("forward"), forward);
            bench.clock();
            waits = !clear && !playback && enable && (press || waits && !tick);
        }
    }
}
