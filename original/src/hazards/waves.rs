//! What wires do around the moment of a hazard.

use crate::circuit::Circuit;
use crate::delays::Delays;
use crate::error::Error;
use crate::pulses::Change;
use crate::simulator::Simulator;

/// A wire over a short time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Wave {
    /// Its name in the netlist.
    pub wire: &'static str,
    /// Its level where the time begins.
    pub level: bool,
    /// Its changes, ps since the time began.
    pub changes: Vec<(u64, bool)>,
}

/// Some wires over a short time.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Waves {
    /// How long it is, ps.
    pub lasts_ps: u64,
    /// The wires, from cause to effect.
    pub wires: Vec<Wave>,
}

impl Waves {
    /// What these wires do between two instants.
    pub(super) fn of(
        circuit: &Circuit,
        delays: &Delays,
        changes: &[Change],
        wires: &[&'static str],
        [from_ps, to_ps]: [u64; 2],
    ) -> Result<Self, Error> {
        let before = Simulator::new(circuit, delays)?;
        let edges = super::ways::run(circuit, delays, changes)?.take_edges();
        let wave = |wire: &&'static str| {
            let net = circuit.pin(wire)?;
            let own = || edges.iter().filter(|edge| edge.net == net);
            let last = own().take_while(|edge| edge.time_ps < from_ps).last();
            let shown = own().filter(|edge| (from_ps..=to_ps).contains(&edge.time_ps));
            Ok(Wave {
                wire,
                level: last.map_or_else(|| before.level(net), |edge| edge.level),
                changes: shown.map(|edge| (edge.time_ps - from_ps, edge.level)).collect(),
            })
        };
        let wires = wires.iter().map(wave).collect::<Result<_, _>>()?;
        Ok(Self { lasts_ps: to_ps - from_ps, wires })
    }
}
