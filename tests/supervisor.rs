//! What the supervisor stops, and for how long.

use crate::support::bench::Bench;

fn measuring(limit: u64) -> Bench {
    let mut bench = Bench::new("supervisor");
    bench.set(&[("enable", 1), ("limit", limit), ("tick", 1), ("wrap_watched", 1)]);
    bench.pulse(&["clear"]);
    bench.set(&[("measuring", 1)]);
    bench
}

#[test]
fn a_missing_channel_stops_the_loop_and_not_the_playback() {
    for (there, missing) in [("line", "fringes_missing"), ("fringe", "lines_missing")] {
        let mut bench = measuring(20);
        for _ in 0..19 {
            bench.pulse(&[there]);
        }
        assert!(bench.high("may_correct"), "19 ticks are in time");
        bench.pulse(&[there]);
        assert!(bench.high(missing) && bench.high("alarm"));
        assert!(!bench.high("may_correct") && bench.high("may_step"));
        bench.pulse(&["line", "fringe"]);
        assert!(!bench.high("may_correct"), "until it is cleared");
        bench.pulse(&["clear"]);
        assert!(bench.high("may_correct") && !bench.high("alarm"));
    }
}

#[test]
fn without_a_limit_nothing_is_missed() {
    let mut bench = measuring(0);
    bench.clocks(10_000);
    assert!(bench.high("may_correct"));
}

/// Set and clear of the meter in turns are right in either order, and with coincidences between.
#[test]
fn a_wrapped_meter_is_noticed_at_the_second_of_a_kind() {
    let (set, clear, both) = (&["opening"][..], &["shutting"][..], &["opening", "shutting"][..]);
    let right = [[set, clear, set, clear], [clear, set, clear, set], [set, both, set, clear]];
    let wrong = [[set, clear, set, set], [clear, set, clear, clear], [both, clear, set, set]];
    for (sequences, wrapped) in [(right, false), (wrong, true)] {
        for sequence in sequences {
            let mut bench = measuring(4000);
            for (place, pulses) in sequence.iter().enumerate() {
                assert!(!bench.high("wrapped"), "before pulse {place}");
                bench.pulse(pulses);
            }
            assert_eq!(bench.high("wrapped"), wrapped);
            assert_eq!(bench.high("may_correct"), !wrapped);
        }
    }
}

#[test]
fn an_emergency_stop_is_at_once_and_stays() {
    let mut bench = measuring(0);
    bench.set(&[("stop", 1)]);
    assert!(bench.high("stopped") && !bench.high("may_step") && !bench.high("may_correct"));
    bench.pulse(&["clear"]);
    assert!(bench.high("stopped"), "the contact is open");
    bench.set(&[("stop", 0)]);
    bench.clocks(100);
    assert!(bench.high("stopped") && !bench.high("may_step"), "nothing moves by its release");
    bench.pulse(&["clear"]);
    assert!(!bench.high("stopped") && bench.high("may_step"));
}

#[test]
fn without_enable_there_is_no_step() {
    let mut bench = measuring(0);
    bench.set(&[("enable", 0)]);
    assert!(!bench.high("may_step") && !bench.high("may_correct") && !bench.high("stopped"));
}
