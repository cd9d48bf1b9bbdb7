//! The final check of `helixlock learn`, in words and as JSON.

use std::io::Write;

use helixlock_lab::{FinalCheck, Problem, final_check, sensor_column};
use helixlock_plant::Model;

/// What became of the check.
pub(crate) enum Checked {
    /// The machine file says that the loop is open, or no pass runs forward.
    NotAsked,
    /// The device cannot serve the machine; why.
    Impossible(String),
    /// It ran.
    Done(FinalCheck),
}

impl Checked {
    /// Runs both machines where the loop is closed.
    pub(crate) fn run(problem: &Problem, file: &Model, learned: &Model) -> Self {
        if !file.loop_closed || file.rotary {
            return Self::NotAsked;
        }
        match final_check(problem, file, learned) {
            Ok(Some(check)) => Self::Done(check),
            Ok(None) => Self::NotAsked,
            Err(error) => Self::Impossible(error.to_string()),
        }
    }

    /// A line a sensor.
    pub(crate) fn sentences(&self) -> Vec<String> {
        let check = match self {
            Self::NotAsked => return Vec::new(),
            Self::Impossible(why) => return vec![format!("final check: not run, {why}")],
            Self::Done(check) => check,
        };
        let mut lines: Vec<String> = check
            .sensors
            .iter()
            .map(|one| {
                format!(
                    "final check, clock by clock: {} of pass {} less simulated: {:.4} → {:.4} µm rms, of which up to {:.4} the loop's hunting",
                    sensor_column(one.sensor, false),
                    check.pass,
                    one.before_um,
                    one.after_um,
                    check.hunting_um
                )
            })
            .collect();
        lines.extend(check.left_out.iter().map(|what| format!("final check: without {what}")));
        lines
    }

    pub(crate) fn print(&self, out: &mut impl Write) -> anyhow::Result<()> {
        for line in self.sentences() {
            writeln!(out, "{line}")?;
        }
        Ok(())
    }
}
