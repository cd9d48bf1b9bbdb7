//! The figures do what their pages say, whatever the delays.

mod checks;
mod figures;
mod hazards;
mod properties;
mod reaches;

use helixlock_original::{Change, Circuit, Delays, Simulator};

/// A circuit that has had these changes, and time to rest behind them.
fn after<'a>(circuit: &'a Circuit, delays: &Delays, changes: &[Change]) -> Simulator<'a> {
    let mut simulator = Simulator::new(circuit, delays).expect("it rests at power-up");
    play(&mut simulator, changes);
    simulator
}

/// Plays changes, and lets 50 µs pass.
fn play(simulator: &mut Simulator, changes: &[Change]) {
    for (time_ps, pin, level) in changes {
        simulator.drive(*time_ps, *pin, *level).expect("in the order of time");
    }
    simulator.run_until(changes.last().map_or(0, |last| last.0) + 50_000_000);
}
