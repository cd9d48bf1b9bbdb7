//! What a person, or a program, is told of a board that was set.

use std::io::Write;
use std::path::Path;

use helixlock_sim::Dialled;

use super::super::message::{IDENTIFIER, VERSION};
use crate::shared::keys::keys;
use crate::shared::wheels::Wheels;

keys! {
    /// The board and its settings in plain numbers; the JSON of `--json`.
    Told(port: &Path, clock_mhz: u32, dialled: &Dialled) {
        port: String = port.display().to_string(),
        identifier: u32 = IDENTIFIER,
        version: u32 = VERSION,
        clock_hz: u64 = 1_000_000 * u64::from(clock_mhz),
        settings: Wheels = Wheels::new(dialled),
    }
}

impl Told {
    /// Prints it for people.
    pub(crate) fn print(&self, out: &mut impl Write) -> anyhow::Result<()> {
        writeln!(out, "settings port {}, version {}", self.identifier, self.version)?;
        writeln!(out, "{}", self.settings)?;
        Ok(writeln!(out, "written and read back; they last until the board is switched off")?)
    }
}
