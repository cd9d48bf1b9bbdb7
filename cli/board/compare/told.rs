//! What a person, or a program, is told of a comparison.

use std::io::Write;

use helixlock_sim::Comparison;
use serde::Serialize;

use super::super::log::Scale;
use super::pins::PinLog;
use super::run::{Difference, Outcome};

/// A log against the model.
#[derive(Debug, Serialize)]
pub(super) struct Told<'a> {
    /// They agree.
    pub(super) same: bool,
    /// Clocks of the log.
    clocks: u64,
    /// Clocks a second.
    clock_hz: f64,
    /// Comparisons that agree.
    comparisons: u64,
    /// Outputs that were held to the model.
    compared: Vec<&'a str>,
    /// Inputs that the log lacks.
    at_rest: Vec<&'a str>,
    /// Where they part.
    difference: Option<ToldDifference<'a>>,
}

/// The first difference.
#[derive(Debug, Serialize)]
struct ToldDifference<'a> {
    /// The edge after which they differ.
    clock: u64,
    /// That is so long after the first, s.
    time_s: f64,
    /// The pin.
    pin: &'a str,
    /// Its level in the log.
    found_high: bool,
    /// Number of the comparison, as telemetry has it.
    comparison: Option<u64>,
    /// Travel at its beginning, mm.
    position_mm: Option<f64>,
    /// The comparison as a whole.
    reading: Option<Reading>,
    /// The motor at its end.
    motor: Option<Motor>,
}

/// A comparison in the log and in the model.
#[derive(Clone, Copy, Debug, Serialize)]
struct Reading {
    period_clocks: u64,
    found_width_clocks: u64,
    expected_width_clocks: u64,
    /// Recorder of the log less that of the model, µm.
    error_um: f64,
}

/// Net steps in the log and in the model.
#[derive(Clone, Copy, Debug, Serialize)]
struct Motor {
    found_steps: i64,
    expected_steps: i64,
    /// Those of the log less those of the model, at the table, µm.
    error_um: f64,
}

impl<'a> Told<'a> {
    /// Puts clocks into words: s, mm, µm.
    pub(super) fn new(outcome: &Outcome, log: &'a PinLog, scale: &Scale, step_um: f64) -> Self {
        let named = |wanted: fn(&super::pins::Pin) -> bool| {
            log.pins.iter().filter(move |pin| wanted(pin)).map(|pin| pin.name.as_str()).collect()
        };
        Self {
            same: outcome.difference.is_none(),
            clocks: log.clocks,
            clock_hz: scale.clock_hz,
            comparisons: outcome.comparisons,
            compared: named(|pin| !pin.input),
            at_rest: named(|pin| pin.input && !pin.logged),
            difference: outcome
                .difference
                .as_ref()
                .map(|difference| ToldDifference::new(difference, log, scale, step_um)),
        }
    }

    /// As text.
    pub(super) fn print(&self, out: &mut impl Write) -> anyhow::Result<()> {
        let outputs = self.compared.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>();
        let (clocks, comparisons) = (self.clocks, self.comparisons);
        let Some(difference) = &self.difference else {
            writeln!(out, "no difference in {clocks} clocks, {comparisons} comparisons")?;
            writeln!(out, "compared: {}", outputs.join(", "))?;
            return Ok(());
        };
        let word = |high: bool| if high { "high" } else { "low" };
        writeln!(
            out,
            "first difference after clock {}, at {:.7} s: `{}` is {}, the model has it {}",
            difference.clock,
            difference.time_s,
            difference.pin,
            word(difference.found_high),
            word(!difference.found_high),
        )?;
        match (difference.comparison, difference.position_mm) {
            (Some(number), Some(position_mm)) => {
                writeln!(out, "in comparison {number}, which begins at {position_mm:.4} mm")?;
            }
            _ => writeln!(out, "before the first comparison")?,
        }
        if let Some(reading) = difference.reading {
            writeln!(
                out,
                "its width is {} of {} clocks, the model's {}: {:+.4} µm",
                reading.found_width_clocks,
                reading.period_clocks,
                reading.expected_width_clocks,
                reading.error_um,
            )?;
        }
        if let Some(motor) = difference.motor {
            writeln!(
                out,
                "steps at its end are {:+}, the model's {:+}: {:+.4} µm",
                motor.found_steps, motor.expected_steps, motor.error_um,
            )?;
        }
        writeln!(
            out,
            "{comparisons} comparisons before it agree; compared: {}",
            outputs.join(", ")
        )?;
        Ok(())
    }
}

impl<'a> ToldDifference<'a> {
    #[expect(clippy::cast_precision_loss, reason = "clocks and steps of a pass are far below 2⁵³")]
    fn new(difference: &Difference, log: &'a PinLog, scale: &Scale, step_um: f64) -> Self {
        let motor = |[found_steps, expected_steps]: [i64; 2]| Motor {
            found_steps,
            expected_steps,
            error_um: (found_steps - expected_steps) as f64 * step_um,
        };
        let reading = |[found, expected]: [Comparison; 2]| Reading {
            period_clocks: expected.end - expected.begin,
            found_width_clocks: found.high,
            expected_width_clocks: expected.high,
            error_um: found.error_um(scale.full_scale_um) - expected.error_um(scale.full_scale_um),
        };
        Self {
            clock: difference.clock,
            time_s: difference.clock as f64 / scale.clock_hz,
            pin: &log.pins[difference.pin].name,
            found_high: difference.found,
            comparison: difference.number,
            position_mm: difference.number.map(|number| number as f64 * scale.comparison_mm),
            reading: difference.readings.map(reading),
            motor: difference.steps.map(motor),
        }
    }
}
