//! Wider than the standard is forward, narrower is reverse, equal keeps.

use crate::support::bench::Bench;

/// Every state and input against the words of the document.
#[test]
fn every_state_and_input() {
    for case in 0..64_u32 {
        let [clear, hold, meter, standard, q, decided] =
            [5, 4, 3, 2, 1, 0].map(|bit| u64::from(case >> bit & 1));
        let mut bench = Bench::new("direction_discriminator");
        bench.force(&[("jk_q", q), ("decision_q", decided)]);
        bench.set(&[("clear", clear), ("hold", hold), ("meter", meter), ("standard", standard)]);
        let wider = (hold, meter, standard) == (0, 1, 0);
        let narrower = (hold, meter, standard) == (0, 0, 1);
        assert_eq!((bench.high("cp1"), bench.high("cp2")), (!wider, !narrower), "{case:06b}");
        bench.clock();
        let next = match (clear, wider, narrower) {
            (1, ..) | (_, _, true) => 0,
            (_, true, _) => 1,
            _ => q,
        };
        assert_eq!((bench.get("q"), bench.get("q_bar")), (next, 1 - next), "{case:06b}");
        let known = clear == 0 && hold == 0 && (decided == 1 || wider || narrower);
        assert_eq!(bench.high("decided"), known, "{case:06b}");
    }
}

/// A period of 20 clocks, the standard high for 10: the sign of the difference decides.
#[test]
fn one_clock_of_difference_decides() {
    for width in 1..20_u64 {
        let mut bench = Bench::new("direction_discriminator");
        for clock in 0..20 {
            bench.set(&[("standard", (clock < 10).into()), ("meter", (clock < width).into())]);
            bench.clock();
        }
        assert_eq!(bench.high("q"), width > 10, "width {width}");
        assert_eq!(bench.high("decided"), width != 10, "width {width}");
    }
}
