//! The hazards are where a hand calculation says, and each remedy keeps its own away.

use helixlock_original::{Hazard, hazards};

/// The hazard whose description begins so.
fn hazard<'a>(all: &'a [Hazard], what: &str) -> &'a Hazard {
    all.iter().find(|one| one.what.starts_with(what)).expect("it is listed")
}

/// NAND1's runt is as long as NAND3 is slow (meter and standard are alike), and 4 ns more for the
/// gate's slower rise; the clock input keeps out what is shorter than its 14 ns, so from 10 ns on Q
/// is touched; the NAND gates alone keep out 11 ns, so from 7 ns on.
#[test]
fn slow_nand3_begins_where_it_must() {
    let all = hazards().unwrap();
    let near = |hazard: &Hazard, by_hand_ps: u64| {
        hazard.begins_ps.is_some_and(|begins_ps| begins_ps.abs_diff(by_hand_ps) <= 100)
    };
    let printed = hazard(&all, "a direction is lost");
    let missing = hazard(&all, "the same, the clock inputs taken out");
    assert!(near(printed, 10_000), "{printed:?}");
    assert!(near(missing, 7_000), "{missing:?}");
}

/// By hand: 25 ns less the gates around, 6 + 3.5 + 6 ns.
#[test]
fn the_clear_is_too_short_below_nine_and_a_half() {
    let all = hazards().unwrap();
    let clear = hazard(&all, "the clear is shorter");
    assert!(clear.begins_ps.is_some_and(|ps| (9_300..=9_500).contains(&ps)), "{clear:?}");
    assert!(clear.is_kept_away());
}

#[test]
fn what_time_keeps_apart_stays_apart() {
    let all = hazards().unwrap();
    for what in ["a pulse that comes", "an added pulse runs"] {
        let hazard = hazard(&all, what);
        assert!(hazard.begins_ps.is_some() && hazard.is_kept_away(), "{hazard:?}");
    }
    for what in ["the first line", "the counter miscounts", "an added pulse behind"] {
        let hazard = hazard(&all, what);
        assert!(hazard.begins_ps.is_some() && !hazard.is_kept_away(), "{hazard:?}");
    }
}
