//! The hazards are where a hand calculation says, and each remedy keeps its own away.

use helixlock_original::{Hazard, hazards};

/// The hazard whose description begins so.
fn hazard<'a>(all: &'a [Hazard], what: &str) -> &'a Hazard {
    all.iter().find(|one| one.what.starts_with(what)).expect("it is listed")
}

/// NAND1's runt is as long as NAND3 is slow (meter and standard are alike), and 4 ns more for the
/// gate's slower rise; the coupling keeps out what is shorter than its 100 ns, a clock input what is
/// shorter than 14 ns, so that Q is touched from 96 and from 10 ns on; the NAND gates alone keep out 11 ns, so from 7 ns on.
#[test]
fn slow_nand3_begins_where_it_must() {
    let all = hazards().unwrap();
    let near = |hazard: &Hazard, by_hand_ps: u64| {
        hazard.begins_ps.is_some_and(|begins_ps| begins_ps.abs_diff(by_hand_ps) <= 100)
    };
    let coupled = hazard(&all, "a direction is lost");
    let of_clock_length = hazard(&all, "the same with clock inputs of 14 ns");
    let missing = hazard(&all, "the same, the clock inputs taken out");
    assert!(near(coupled, 96_000) && coupled.is_kept_away(), "{coupled:?}");
    assert!(
        near(of_clock_length, 10_000) && !of_clock_length.is_kept_away(),
        "{of_clock_length:?}"
    );
    assert!(near(missing, 7_000) && !missing.is_kept_away(), "{missing:?}");
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

/// Each has its waveform, in which the last wire, where it shows, moves; of a lost pulse, that it does
/// not move twice.
#[test]
fn each_hazard_has_its_waveform() {
    for hazard in hazards().unwrap() {
        let last = hazard.waves.wires.last().expect("wires");
        assert!(3 < hazard.waves.wires.len(), "{hazard:?}");
        assert!(!last.changes.is_empty(), "{hazard:?}");
        for wave in &hazard.waves.wires {
            assert!(wave.changes.iter().all(|(ps, _)| *ps <= hazard.waves.lasts_ps), "{wave:?}");
            assert!(!wave.changes.is_empty() || wave.wire.starts_with("toggle"), "{wave:?}");
        }
    }
}
