//! The range stage lets one pulse in two through at ×2, the first one first.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

proptest! {
    #![proptest_config(kept_beside_source())]

    #[test]
    fn passes_the_odd_ones(range_x2: bool, train in vec((any::<bool>(), 0..15), 0..200)) {
        let mut bench = Bench::new("range_stage");
        bench.set(&[("range_x2", range_x2.into())]);
        let mut seen = 0;
        for (divided, dice) in train {
            let clear = dice == 0;
            bench.set(&[("divided", divided.into()), ("clear", clear.into())]);
            let passes = divided && (!range_x2 || seen % 2 == 0);
            prop_assert_eq!(bench.high("pulse"), passes);
            bench.clock();
            seen = if clear { 0 } else { seen + u32::from(divided) };
        }
    }
}
