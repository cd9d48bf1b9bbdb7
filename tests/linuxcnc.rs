//! The ring drives a motor that LinuxCNC drives, step for step.

use crate::support::bench::Bench;

/// `stepgen(9)` of LinuxCNC, step type 4, "three phase, half step": phase A is the lowest bit.
const STEP_TYPE_4: [u64; 6] = [1, 3, 2, 6, 4, 5];

#[test]
fn the_ring_is_the_three_phase_half_step_of_stepgen() {
    let mut ring = Bench::new("ring_distributor");
    ring.clock();
    let forward = (1..=12_usize).map(|position| (1, position));
    let reverse = (0..12_usize).rev().map(|position| (0, position));
    for (direction, position) in forward.chain(reverse) {
        ring.set(&[("step", 1), ("forward", direction)]);
        ring.clock();
        let drives = ring.get("phase_c") << 2 | ring.get("phase_b") << 1 | ring.get("phase_a");
        assert_eq!(drives, STEP_TYPE_4[position % 6], "position {position}");
    }
}
