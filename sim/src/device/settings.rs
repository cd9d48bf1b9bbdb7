//! From the machine file to thumb wheels and switches.

use helixlock_plant::dividers::COMPENSATOR_REACH_PPM;
use helixlock_plant::{self as plant, Machine, Part, rationalisation_um_per_m};
use helixlock_rtl::settings::{Range, Settings};

use crate::SettingsError;

/// Least clocks from step to step: a step has to be over before the next begins.
const SHORTEST_STEP_PERIOD: f64 = 2.0;

/// Most clocks from step to step that the step clock's register holds.
const LONGEST_STEP_PERIOD: f64 = 16_777_215.0;

/// Settings, and what they come to where the file asked for something between two of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dialled {
    /// For the device.
    pub settings: Settings,
    /// Compensation that the wheels give, µm/m, signed as in the file.
    pub compensation_um_per_m: f64,
    /// Step frequency that the divided clock gives, Hz.
    pub step_frequency_hz: f64,
}

/// Settings of the device for a machine: the nearest there are.
///
/// Compensation is one pulse in F, F a multiple of 1000: `10⁶/F` µm/m (document 1, fig. 9), so
/// what the file asks for is met to 1 part in 2F/1000, and below 0.1 µm/m not at all.
///
/// # Errors
///
/// [`SettingsError`] when the file asks for something the device cannot do.
pub fn settings_for(machine: &Machine) -> Result<Dialled, SettingsError> {
    if machine.rotary {
        return Err(SettingsError::Rotary);
    }
    let whole = [Part::Workpiece, Part::Grating, Part::Laser, Part::Dividers, Part::Drive];
    if let Some(part) = machine.lacks(&whole) {
        return Err(SettingsError::Part { part });
    }
    let dividers = &machine.dividers;
    let compensation_f = compensation_f(dividers.compensation_um_per_m)?;
    let step_period = step_period(machine.drive.frequency_hz, machine.fpga.clock_hz)?;
    let size_um_per_m = if compensation_f == 0 { 0.0 } else { 1e6 / f64::from(compensation_f) };
    let settings = Settings {
        a: u32::from(dividers.a),
        b: u32::from(dividers.b),
        range: match dividers.range {
            plant::Range::X1 => Range::X1,
            plant::Range::X2 => Range::X2,
        },
        initial_phase: u32::from(dividers.initial_phase),
        compensation_f,
        insert: dividers.compensation_um_per_m < 0.0,
        step_period,
    };
    Ok(Dialled {
        settings,
        compensation_um_per_m: size_um_per_m.copysign(dividers.compensation_um_per_m),
        step_frequency_hz: machine.fpga.clock_hz / f64::from(step_period),
    })
}

/// Nearest F that four wheels can show, 0 for none.
fn compensation_f(um_per_m: f64) -> Result<u32, SettingsError> {
    let thousands = libm::round(1000.0 / um_per_m.abs());
    if thousands < 1.0 {
        return Err(SettingsError::Compensation { found_um_per_m: um_per_m });
    }
    Ok(if thousands <= 9999.0 { 1000 * whole(thousands) } else { 0 })
}

/// Refuses dividers that leave more than the compensator takes out: they stand for another lead, and
/// a run would only show the corrector at its end.
///
/// # Errors
///
/// [`SettingsError::Dividers`].
pub(crate) fn dividers_fit(machine: &Machine) -> Result<(), SettingsError> {
    let left_um_per_m = rationalisation_um_per_m(machine);
    if left_um_per_m.abs() <= COMPENSATOR_REACH_PPM {
        return Ok(());
    }
    Err(SettingsError::Dividers {
        a: machine.dividers.a,
        b: machine.dividers.b,
        lead: machine.workpiece.lead,
        left_um_per_m,
        most_um_per_m: COMPENSATOR_REACH_PPM,
    })
}

fn step_period(frequency_hz: f64, clock_hz: f64) -> Result<u32, SettingsError> {
    let period = libm::round(clock_hz / frequency_hz);
    if (SHORTEST_STEP_PERIOD..=LONGEST_STEP_PERIOD).contains(&period) {
        return Ok(whole(period));
    }
    Err(SettingsError::StepFrequency {
        found_hz: frequency_hz,
        low_hz: clock_hz / LONGEST_STEP_PERIOD,
        high_hz: clock_hz / SHORTEST_STEP_PERIOD,
        clock_hz,
    })
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the callers have bounded it to 24 bits"
)]
fn whole(number: f64) -> u32 {
    number as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_example_of_the_report_is_met_to_four_digits() {
        // ΔS = +6.4 µm/m → F = 156 250, printed and settable as 156 000.
        assert_eq!(compensation_f(6.4), Ok(156_000));
        assert_eq!(compensation_f(-6.4), Ok(156_000));
    }

    #[test]
    fn no_compensation_and_too_little_are_off() {
        assert_eq!(compensation_f(0.0), Ok(0));
        assert_eq!(compensation_f(0.099), Ok(0));
        assert_eq!(compensation_f(0.1001), Ok(9_990_000));
    }

    #[test]
    fn too_much_compensation_is_refused() {
        assert_eq!(compensation_f(1000.0), Ok(1_000));
        assert!(compensation_f(2100.0).is_err());
    }

    #[test]
    fn a_step_clock_beyond_the_fpga_is_refused() {
        assert_eq!(step_period(160.0, 12e6), Ok(75_000));
        assert_eq!(step_period(6e6, 12e6), Ok(2));
        let message = step_period(12e6, 12e6).unwrap_err().to_string();
        assert_eq!(
            message,
            "drive.frequency: 12000000 Hz, expected 0.715 Hz to 6000000 Hz with an \
             FPGA clock of 12000000 Hz"
        );
        assert!(step_period(0.1, 12e6).is_err());
    }
}
