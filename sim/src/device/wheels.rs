//! Settings onto the device's inputs.

use helixlock_rtl::settings::Settings;

use super::device_pins::find;
use crate::Error;
use crate::engine::Engine;

/// Puts the wheels of a device where the settings say.
///
/// # Errors
///
/// [`Error::Wheels`] when a wheel cannot show its number.
pub fn set_wheels(engine: &mut impl Engine, settings: &Settings) -> Result<(), Error> {
    for (name, level) in settings.wheels()?.named() {
        let input = find(engine.netlist(), name)?;
        engine.set_input(input, level);
    }
    Ok(())
}
