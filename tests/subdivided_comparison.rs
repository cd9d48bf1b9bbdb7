//! The subdivided comparison divides as the software of document 4's method does.

use helixlock_metrology::transmission::subdivided_word;
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Clocks to the next word, if one comes: the fraction and N0.
fn word(bench: &mut Bench) -> Option<(u64, u64)> {
    (0..20).find_map(|_| {
        bench.clock();
        bench.high("ready").then(|| (bench.get("fraction"), bench.get("pulses")))
    })
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// A period and a place in it, or beyond it.
    #[test]
    fn words_are_those_of_the_software(period in 1..400_u32, since in 0..500_u32) {
        let mut bench = Bench::new("subdivided_comparison");
        bench.pulse(&["fast"]);
        bench.clocks(period - 1);
        bench.set(&[("fast", 1), ("slow", (since == 0).into())]);
        bench.clock();
        bench.set(&[("fast", 0), ("slow", 0)]);
        if since > 0 {
            bench.clocks(since - 1);
            bench.pulse(&["slow"]);
        }
        let expected = u64::from(subdivided_word(since, period));
        prop_assert_eq!(word(&mut bench), Some((expected, 2)));
    }

    /// Wide words, where the counters cannot be run there: every bit of both takes part.
    #[test]
    fn wide_words(period in 1..=u32::MAX, since in 0..=u32::MAX) {
        let mut bench = Bench::new("subdivided_comparison");
        bench.force(&[("since_q", since.into()), ("last_period_q", period.into())]);
        bench.force(&[("seen_q", 1), ("known_q", 1)]);
        bench.pulse(&["slow"]);
        let expected = u64::from(subdivided_word(since, period));
        prop_assert_eq!(word(&mut bench), Some((expected, 0)));
    }

    /// Every input pulse is counted to one output pulse.
    #[test]
    fn counts_whole_pulses(gaps in vec(0..60_u32, 1..20)) {
        let mut bench = Bench::new("subdivided_comparison");
        let mut clock = 0;
        let mut tick = |bench: &mut Bench, slow: bool| {
            bench.set(&[("fast", (clock % 5 == 0).into()), ("slow", slow.into())]);
            bench.clock();
            clock += 1;
            u64::from(clock % 5 == 1)
        };
        let mut sent: u64 = (0..10).map(|_| tick(&mut bench, false)).sum();
        for gap in gaps {
            sent += tick(&mut bench, true);
            let mut words = 0;
            let mut after = 0;
            for _ in 0..17 + gap {
                after += tick(&mut bench, false);
                if bench.high("ready") {
                    prop_assert_eq!(bench.get("pulses"), sent);
                    words += 1;
                }
            }
            prop_assert_eq!(words, 1);
            sent = after;
        }
    }
}

/// No word before a whole input period is known.
#[test]
fn waits_for_a_period() {
    let mut bench = Bench::new("subdivided_comparison");
    bench.pulse(&["slow"]);
    assert_eq!(word(&mut bench), None);
    bench.pulse(&["fast"]);
    bench.pulse(&["slow"]);
    assert_eq!(word(&mut bench), None);
}
