//! Whatever way an encoder goes, the pulses are the lines it passed for the first time.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// An encoder at the decoder's inputs.
struct Encoder {
    bench: Bench,
    /// Quarters of a line from where it began.
    quarters: i64,
    /// The line furthest forward.
    furthest: i64,
    pulses: i64,
}

impl Encoder {
    fn new() -> Self {
        let bench = Bench::new("quadrature_decoder");
        let mut encoder = Self { bench, quarters: 0, furthest: 0, pulses: 0 };
        encoder.bench.set(&[("clear", 1)]);
        encoder.stand(2);
        encoder.bench.set(&[("clear", 0)]);
        encoder
    }

    fn stand(&mut self, clocks: usize) {
        let quarter = self.quarters.rem_euclid(4);
        let [a, b] = [matches!(quarter, 1 | 2), matches!(quarter, 2 | 3)].map(u64::from);
        self.bench.set(&[("a", a), ("b", b)]);
        self.furthest = self.furthest.max(self.line());
        for _ in 0..clocks {
            self.bench.clock();
            self.pulses += i64::from(self.bench.high("pulse"));
        }
    }

    /// Goes so many quarters, a clock each.
    fn go(&mut self, quarters: i64) {
        for _ in 0..quarters.abs() {
            self.quarters += quarters.signum();
            self.stand(1);
        }
    }

    /// The last line passed: the first is the first quarter.
    fn line(&self) -> i64 {
        (self.quarters + 3).div_euclid(4)
    }
}

proptest! {
    #![proptest_config(kept_beside_source())]

    #[test]
    fn pulses_are_the_lines_passed_for_the_first_time(
        ways in vec((-60_i64..80, 0_usize..4), 1..30),
    ) {
        let mut encoder = Encoder::new();
        for (quarters, clocks) in ways {
            encoder.go(quarters);
            encoder.stand(clocks + 1);
            prop_assert_eq!(encoder.pulses, encoder.furthest);
            let behind = i64::try_from(encoder.bench.get("behind")).unwrap();
            prop_assert_eq!(behind, encoder.furthest - encoder.line());
        }
        prop_assert!(!encoder.bench.high("lost"));
    }
}

/// A fringe of dither at any of its four edges is a line once, at most.
#[test]
fn dither_at_a_standstill_adds_nothing() {
    for edge in 0..4 {
        let mut encoder = Encoder::new();
        encoder.go(40 + edge);
        encoder.go(1);
        encoder.stand(1);
        let before = encoder.pulses;
        for _ in 0..1000 {
            encoder.go(-1);
            encoder.go(1);
        }
        for _ in 0..1000 {
            encoder.go(-4);
            encoder.go(4);
        }
        encoder.stand(1);
        assert_eq!(encoder.pulses, before, "edge {edge}");
    }
}

/// Forward, back to beyond the beginning, forward: as many as straight on.
#[test]
fn a_way_back_loses_nothing() {
    let mut encoder = Encoder::new();
    for quarters in [400, -800, 4000] {
        encoder.go(quarters);
        encoder.stand(1);
    }
    assert_eq!((encoder.pulses, encoder.line()), (900, 900));
}

/// The counter ends at 65 535 lines back, and says so until it is cleared.
#[test]
fn too_far_back_is_said() {
    let mut encoder = Encoder::new();
    encoder.go(-4 * 65_535);
    assert_eq!((encoder.bench.get("behind"), encoder.bench.high("lost")), (65_535, false));
    encoder.go(-4);
    assert_eq!((encoder.bench.get("behind"), encoder.bench.high("lost")), (65_535, true));
    encoder.bench.set(&[("clear", 1)]);
    encoder.stand(1);
    assert_eq!((encoder.bench.get("behind"), encoder.bench.high("lost")), (0, false));
}
