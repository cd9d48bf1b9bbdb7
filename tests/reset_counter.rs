//! The reset counter is the net position, never leaves its range, and finds zero again.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// The signed position the counter claims.
fn position(bench: &mut Bench) -> i64 {
    let magnitude = i64::try_from(bench.get("count")).expect("12 bits");
    if bench.high("count_forward") { magnitude } else { -magnitude }
}

/// One request; the step taken, signed.
fn request(bench: &mut Bench, forward: bool) -> i64 {
    bench.set(&[("request", 1), ("forward", forward.into())]);
    let step = match (bench.high("step"), bench.high("drive_forward")) {
        (false, _) => 0,
        (true, true) => 1,
        (true, false) => -1,
    };
    bench.clock();
    bench.set(&[("request", 0)]);
    step
}

/// Puts the counter at a signed position.
fn put(bench: &mut Bench, at: i64) {
    bench.force(&[("magnitude_q", at.unsigned_abs()), ("side_q", (at > 0).into())]);
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Whatever the history, wherever it starts: position, zero line, limit, fault, playback.
    #[test]
    fn counts_the_net_position(
        start in prop_oneof![-4095..=4095_i64, -3..=3_i64, 4090..=4095_i64, -4095..=-4090_i64],
        history in vec((any::<bool>(), any::<bool>(), 0..12), 0..300),
    ) {
        let mut bench = Bench::new("reset_counter");
        put(&mut bench, start);
        let mut expected = start;
        let mut fault = false;
        for (asked, forward, dice) in history {
            let playback = dice < 3;
            bench.set(&[("playback", playback.into())]);
            let at_zero = expected == 0;
            if asked {
                let wanted = match (playback, forward) {
                    (true, _) => -expected.signum(),
                    (false, true) => 1,
                    (false, false) => -1,
                };
                let allowed = (expected + wanted).abs() <= 4095;
                prop_assert_eq!(request(&mut bench, forward), if allowed { wanted } else { 0 });
                fault |= !allowed;
                expected += if allowed { wanted } else { 0 };
            } else {
                bench.clock();
            }
            fault &= !at_zero;
            prop_assert_eq!(position(&mut bench), expected);
            prop_assert_eq!(bench.high("zero"), expected == 0);
            prop_assert_eq!(bench.high("fault"), fault);
        }
    }

    /// After any history the playback ends at zero, in as many steps as were left, and stops.
    #[test]
    fn playback_ends_at_zero(history in vec(any::<bool>(), 0..300)) {
        let mut bench = Bench::new("reset_counter");
        let net: i64 = history.iter().map(|forward| request(&mut bench, *forward)).sum();
        bench.set(&[("playback", 1)]);
        let steps: Vec<_> = (0..310).map(|_| request(&mut bench, true)).collect();
        prop_assert_eq!(steps.iter().sum::<i64>(), -net);
        let taken = steps.iter().take_while(|step| **step != 0).count();
        prop_assert_eq!(taken as u64, net.unsigned_abs());
        prop_assert!(steps[taken..].iter().all(|step| *step == 0), "stays at zero");
        prop_assert!(bench.high("zero"));
    }
}

/// The document's own example: +8, then −6, leaves two steps in reverse.
#[test]
fn eight_forward_six_back() {
    let mut bench = Bench::new("reset_counter");
    (0..8).for_each(|_| assert_eq!(request(&mut bench, true), 1));
    (0..6).for_each(|_| assert_eq!(request(&mut bench, false), -1));
    assert_eq!(position(&mut bench), 2);
    bench.set(&[("playback", 1)]);
    let played: Vec<_> = (0..4).map(|_| request(&mut bench, false)).collect();
    assert_eq!(played, [-1, -1, 0, 0]);
}

/// All 4095 steps and one more, both ways: saturates, says so, comes all the way back.
#[test]
fn saturates_and_says_so() {
    for forward in [true, false] {
        let mut bench = Bench::new("reset_counter");
        let way = if forward { 1 } else { -1 };
        (0..4095).for_each(|_| assert_eq!(request(&mut bench, forward), way));
        assert!(!bench.high("fault"), "4095 are allowed");
        assert_eq!(request(&mut bench, forward), 0, "the next is not");
        assert!(bench.high("fault"));
        assert_eq!(position(&mut bench), 4095 * way);
        assert_eq!(request(&mut bench, !forward), -way, "back is allowed");
        bench.set(&[("playback", 1)]);
        for left in (0..4094).rev() {
            assert!(bench.high("fault"), "until zero");
            assert_eq!(request(&mut bench, forward), -way);
            assert_eq!(bench.get("count"), left);
        }
        bench.clock();
        assert!(!bench.high("fault"), "zero again");
    }
}

#[test]
fn clear_wins_over_a_step() {
    let mut bench = Bench::new("reset_counter");
    put(&mut bench, 7);
    bench.set(&[("clear", 1)]);
    assert_eq!(request(&mut bench, true), 0, "neither moved");
    assert_eq!(position(&mut bench), 0, "nor counted");
}
