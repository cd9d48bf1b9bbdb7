//! The synchronisers pass every level and every edge, two clocks later.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

proptest! {
    #![proptest_config(kept_beside_source())]

    #[test]
    fn level_follows_two_clocks_later(pin in vec(any::<bool>(), 3..60)) {
        let mut bench = Bench::new("level_synchroniser");
        let mut levels = Vec::new();
        for level in &pin {
            bench.set(&[("pin", (*level).into())]);
            bench.clock();
            levels.push(bench.high("level"));
        }
        prop_assert_eq!(&levels[1..], &pin[..pin.len() - 1]);
    }

    #[test]
    fn every_rising_edge_is_one_pulse(pin in vec(any::<bool>(), 3..60)) {
        let mut bench = Bench::new("input_synchroniser");
        let mut pulses = 0;
        for level in pin.iter().chain(&[false; 3]) {
            bench.set(&[("pin", (*level).into())]);
            bench.clock();
            pulses += u32::from(bench.high("rising"));
        }
        let edges = pin.windows(2).filter(|pair| !pair[0] && pair[1]).count();
        let first = usize::from(pin[0]); // high at power-up is an edge
        prop_assert_eq!(pulses as usize, edges + first);
    }
}
