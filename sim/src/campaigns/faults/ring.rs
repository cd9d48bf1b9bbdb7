//! Where the windings are in their ring, and how long a flip keeps them outside.

use super::{LOGIC_CLOCKS, read};
use crate::Error;
use crate::device::stepped_device;
use crate::engine::{Engine, Snapshot};

/// Windings A, B and C in forward order.
const CYCLE: [[u64; 3]; 6] = [[1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]];

/// Place in the cycle; an illegal state, which lasts one clock, counts as A.
pub(super) fn place(engine: &mut impl Engine) -> Result<i64, Error> {
    Ok(i64::try_from(legal_place(engine)?.unwrap_or(0)).unwrap_or(0))
}

/// Clocks until the windings are in the ring, from a moment on; at most [`LOGIC_CLOCKS`].
pub(super) fn illegal_clocks(moment: &Snapshot) -> Result<u64, Error> {
    let mut engine = stepped_device();
    engine.restore(moment);
    for clocks in 0..LOGIC_CLOCKS {
        if legal_place(&mut engine)?.is_some() {
            return Ok(clocks);
        }
        engine.step();
    }
    Ok(LOGIC_CLOCKS)
}

fn legal_place(engine: &mut impl Engine) -> Result<Option<usize>, Error> {
    let [a, b, c] = ["phase_a", "phase_b", "phase_c"].map(|port| read(engine, port));
    let phases = [a?, b?, c?];
    Ok(CYCLE.iter().position(|state| *state == phases))
}
