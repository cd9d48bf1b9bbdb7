//! The device on a board: what is between its pins and the logic, and the design that comes of it.

use anyhow::bail;
use clap::{Args, ValueEnum};
use helixlock_gen::{Board, bypass, leave_out};
use helixlock_netlist::{Design, elaborate};
use helixlock_rtl::board_shell::BoardShell;
use helixlock_rtl::settings::{Conditioning, Encoder, Settings};
use helixlock_rtl::settings_port::PASSED;
use helixlock_sim::library;

use super::analyser;

/// Name of the top module.
pub(crate) const TOP: &str = "board_shell";

/// Bits a second on the serial port.
pub(crate) const BAUD: u32 = 115_200;

/// What is between the pins and the device.
#[derive(Clone, Debug, Args)]
pub(crate) struct Front {
    /// Further pins, separated by commas
    #[arg(long, value_name = "PINS", value_delimiter = ',')]
    pins: Vec<Pin>,
    /// Clocks that a level of grating or laser has to stand, 0 to 15; 0 takes every edge
    #[arg(long, value_name = "CLOCKS", default_value_t = 4)]
    glitch_clocks: u32,
    /// Milliseconds that a switch or button has to stand, 0 to 15
    #[arg(long, value_name = "MS", default_value_t = 10)]
    debounce: u32,
    /// Milliseconds without a line or fringe that stop the loop, 0 to 4095; 0 watches nothing
    #[arg(long, value_name = "MS", default_value_t = 1000)]
    watchdog: u32,
    /// Switches lead their pins to the supply, not to ground
    #[arg(long)]
    active_high: bool,
}

/// A pin that a design may lack.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Pin {
    /// Switch: the range, in place of the machine file's
    Range,
    /// Switch: steps are allowed
    Enable,
    /// Contact that opens to stop
    EmergencyStop,
    /// Second signal of the grating, a quarter of a line behind: lines that go back are owed
    GratingB,
    /// Second signal of the laser, or of a scale in its place
    LaserB,
    /// Index of the grating: a pass begins there
    GratingIndex,
    /// Index of a scale in the laser's place
    LaserIndex,
    /// Serial port: settings from a computer, by `helixlock board set`
    Rx,
    /// Serial port: a logic analyser in place of the telemetry, for `sigrok-cli` and `PulseView`
    Analyser,
}

impl Pin {
    /// The pins, but for the serial port's.
    const ALL: [(Self, &str); 7] = [
        (Self::Range, "range_x2"),
        (Self::Enable, "enable"),
        (Self::EmergencyStop, "emergency_stop"),
        (Self::GratingB, "grating_b"),
        (Self::LaserB, "laser_b"),
        (Self::GratingIndex, "grating_index"),
        (Self::LaserIndex, "laser_index"),
    ];
}

impl Front {
    /// The conditioning they ask for on a board, whose ticks are milliseconds.
    pub(crate) fn conditioning(&self, board: &Board) -> anyhow::Result<Conditioning> {
        let has = |pin| self.pins.contains(&pin);
        let conditioning = Conditioning {
            glitch_clocks: self.glitch_clocks,
            debounce_ticks: self.debounce,
            tick_period: 1000 * board.clock_mhz,
            watchdog_ticks: self.watchdog,
            bit_clocks: (1_000_000 * board.clock_mhz + BAUD / 2) / BAUD,
            active_low: !self.active_high,
            range_pin: has(Pin::Range),
            enable_pin: has(Pin::Enable),
            grating: Encoder { quadrature: has(Pin::GratingB), index: has(Pin::GratingIndex) },
            laser: Encoder { quadrature: has(Pin::LaserB), index: has(Pin::LaserIndex) },
        };
        conditioning.check()?;
        self.check_serial_port(board)?;
        Ok(conditioning)
    }

    /// True when the bitstream's settings are those it wakes up with.
    pub(crate) fn is_set_from_outside(&self) -> bool {
        self.pins.contains(&Pin::Rx)
    }

    /// True when the serial port is a logic analyser's.
    pub(crate) fn has_analyser(&self) -> bool {
        self.pins.contains(&Pin::Analyser)
    }

    /// The port has a pin and, on the small FPGAs, room; a range is set in one way, and the port is
    /// one block's.
    fn check_serial_port(&self, board: &Board) -> anyhow::Result<()> {
        let takes = |board: &Board| board.pins.iter().any(|pin| pin.port == "rx");
        if !self.is_set_from_outside() && !self.has_analyser() {
            return Ok(());
        }
        if !takes(board) {
            let wanted = if self.has_analyser() { "analyser" } else { "rx" };
            let all = Board::all()?;
            let others: Vec<_> = all.iter().filter(|board| takes(board)).collect();
            let names: Vec<_> = others.iter().map(|board| board.name.as_str()).collect();
            bail!(
                "board `{}` has no room for `{wanted}`, expected one of {}",
                board.name,
                names.join(", ")
            );
        }
        if self.is_set_from_outside() && self.has_analyser() {
            bail!("found the pins `rx` and `analyser`, expected one of them: the port is one's");
        }
        if self.is_set_from_outside() && self.pins.contains(&Pin::Range) {
            bail!("found the pins `rx` and `range`, expected one of them: settings have a range");
        }
        Ok(())
    }

    /// What can be simulated of [`Front::design`]: no model has the memory of an analyser, so neither
    /// that is there nor the pin it talks on.
    pub(crate) fn model(
        &self,
        settings: &Settings,
        conditioning: &Conditioning,
    ) -> anyhow::Result<Design> {
        if !self.has_analyser() {
            return self.design(settings, conditioning);
        }
        let mut others = self.clone();
        others.pins.retain(|pin| *pin != Pin::Analyser);
        let mut design = others.design(settings, conditioning)?;
        leave_out(&mut design, "tx", 0)?;
        Ok(design)
    }

    /// The board shell with these settings, without the pins that nobody asked for: their levels
    /// say nothing then.
    pub(crate) fn design(
        &self,
        settings: &Settings,
        conditioning: &Conditioning,
    ) -> anyhow::Result<Design> {
        let shell = BoardShell::connected(settings, conditioning)?;
        let mut design = elaborate(TOP, &shell, &library())?;
        if !self.is_set_from_outside() {
            bypass(&mut design, "settings_port", &PASSED)?;
        }
        if self.has_analyser() {
            // Ticks are milliseconds.
            analyser::put_in(&mut design, u64::from(conditioning.tick_period / 1000))?;
        } else if !self.is_set_from_outside() {
            bypass(&mut design, "receiver", &[])?;
            leave_out(&mut design, "rx", 0)?;
        }
        for (pin, port) in Pin::ALL {
            if !self.pins.contains(&pin) {
                leave_out(&mut design, port, 0)?;
            }
        }
        Ok(design)
    }
}
