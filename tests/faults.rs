//! Flipped flip-flops: what recovers by itself does, and what cannot is told.

use std::path::Path;
use std::sync::Mutex;

use helixlock_plant::MachineFile;
use helixlock_sim::Error;
use helixlock_sim::faults::{Flips, Outcome, Verdict, flip_flops};

#[test]
fn the_ring_clears_itself_and_the_counter_is_told() {
    let path = Path::new("examples/sg7430-6mm/machine.toml");
    // Faster than the example, so that the test is short.
    let file = MachineFile::read(path).unwrap();
    let file = file.with_setting("spindle.speed", "\"15 rpm\"").unwrap();
    let names = flip_flops();
    let all: Vec<u64> = (0..names.len() as u64).collect();
    let outcomes = Mutex::new(Vec::new());
    let keep = |_, outcome| {
        outcomes.lock().unwrap().push(outcome);
        Ok::<(), Error>(())
    };
    Flips::new(&file.model, 1).unwrap().try_each(&all, &keep).unwrap();
    let mut outcomes = outcomes.into_inner().unwrap();
    outcomes.sort_by_key(|flip| flip.flip_flop);
    assert_eq!(outcomes.len(), names.len());
    let of = |prefix: &str| -> Vec<&Outcome> {
        outcomes.iter().filter(|flip| names[flip.flip_flop].starts_with(prefix)).collect()
    };
    // A flip leaves the ring in a neighbouring or an illegal state; either way it works on. Only the
    // state that clearing leads to can come out as it was.
    let slips: Vec<i64> = of("ring.").iter().map(|flip| flip.ring_slip).collect();
    assert_eq!(slips.len(), 3);
    assert!(slips.iter().all(|slip| slip.abs() <= 2), "{slips:?}");
    assert!(2 <= slips.iter().filter(|slip| **slip != 0).count(), "{slips:?}");
    for flip in of("ring.") {
        let expected = if flip.ring_slip == 0 { Verdict::Unseen } else { Verdict::HomeLost };
        assert_eq!(flip.verdict, expected, "{flip:?}");
    }
    // Of the three flips from any place of the ring one leads outside, and that for one clock.
    let mut illegal: Vec<u64> = of("ring.").iter().map(|flip| flip.ring_illegal_clocks).collect();
    illegal.sort_unstable();
    assert_eq!(illegal, [0, 0, 1]);
    // Bit n of the counter is 2ⁿ steps; the table knows nothing of it.
    for (bit, flip) in of("reset_counter.magnitude_q").into_iter().enumerate() {
        assert_eq!(flip.home_error.abs(), 1 << bit, "{flip:?}");
    }
    // The synchronisers forget.
    for flip in of("start_input.first_q").into_iter().chain(of("playback_input.first_q")) {
        assert!(flip.healed_clocks.is_some() || flip.verdict != Verdict::Unseen, "{flip:?}");
    }
    assert!(of("reset_counter.refused_q")[0].fault_shown, "the fault output shows its own flip");
}
