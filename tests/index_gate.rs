//! A pass begins at the index, once, and ends with the switch.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Open from the rise of the index after the switch, until the switch is off.
    #[test]
    fn the_first_index_opens(levels in vec(any::<(bool, bool)>(), 1..80)) {
        let mut bench = Bench::new("index_gate");
        bench.set(&[("wired", 1)]);
        bench.clock();
        let (mut before, mut passed) = (false, false);
        for (switch, index) in levels {
            let level = u64::from(switch);
            bench.set(&[("start", level), ("started", level), ("index", index.into())]);
            prop_assert_eq!(bench.high("open"), switch && passed);
            bench.clock();
            passed = switch && (passed || (index && !before));
            before = index;
        }
    }

    #[test]
    fn without_an_index_the_switch_passes(levels in vec(any::<(bool, bool, bool)>(), 1..60)) {
        let mut bench = Bench::new("index_gate");
        for (start, started, index) in levels {
            let [level, synchronised, index] = [start, started, index].map(u64::from);
            bench.set(&[("start", level), ("started", synchronised), ("index", index)]);
            prop_assert_eq!(bench.high("open"), start);
            bench.clock();
        }
    }
}
