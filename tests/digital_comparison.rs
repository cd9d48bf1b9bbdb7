//! The digital comparison counts what the software of document 4's method counts.

use helixlock_metrology::transmission::digital_word;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Any train of openings and shuttings, word by word.
    #[test]
    fn words_are_those_of_the_software(train in vec((0..8_u8, 1..40_u64), 1..60)) {
        let mut bench = Bench::new("digital_comparison");
        let mut clock = 0;
        let (mut opened, mut shut) = (None, true);
        for (kind, gap) in train {
            let (opening, shutting) = (kind < 4, kind % 4 > 0);
            bench.set(&[("opening", opening.into()), ("shutting", shutting.into())]);
            bench.clock();
            bench.set(&[("opening", 0), ("shutting", 0)]);
            let period = opened.filter(|_| opening).map(|opened| clock - opened);
            prop_assert_eq!(bench.high("period_ready"), period.is_some());
            if let Some(period) = period {
                prop_assert_eq!(bench.get("period"), period);
            }
            if opening {
                (opened, shut) = (Some(clock), false);
            }
            let word = opened.filter(|_| shutting && !shut).map(|set| digital_word(set, clock));
            prop_assert_eq!(bench.high("delay_ready"), word.is_some());
            if let Some(word) = word {
                prop_assert_eq!(bench.get("delay"), u64::from(word));
                shut = true;
            }
            bench.clocks(u32::try_from(gap - 1).expect("small"));
            clock += gap;
        }
    }
}

/// The count stops at its end instead of starting over.
#[test]
fn saturates() {
    let mut bench = Bench::new("digital_comparison");
    bench.pulse(&["opening"]);
    bench.force(&[("since_q", 0xffff_fffe)]);
    bench.clocks(5);
    bench.pulse(&["shutting"]);
    assert_eq!((bench.get("delay"), bench.high("delay_ready")), (0xffff_ffff, true));
}

#[test]
fn clear_forgets_the_period() {
    let mut bench = Bench::new("digital_comparison");
    bench.pulse(&["opening"]);
    bench.pulse(&["clear"]);
    bench.pulse(&["shutting"]);
    assert!(!bench.high("delay_ready"));
    bench.pulse(&["opening"]);
    assert!(!bench.high("period_ready"));
}
