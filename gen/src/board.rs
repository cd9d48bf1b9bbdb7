//! Boards: everything known of one stands in its constraint file.
//!
//! The file is what the placer reads; its leading comments add the FPGA, the programmer and what
//! has to be wired where.

use helixlock_netlist::{Module, PortKind};

use crate::constraints::{self, Pin};
use crate::{Family, GenError};

/// The constraint files, by name: all there are in the folder, in the order of help and messages.
const FILES: &[(&str, &str)] = &[
    ("icestick.pcf", include_str!("../../constraints/icestick.pcf")),
    ("icebreaker.pcf", include_str!("../../constraints/icebreaker.pcf")),
    ("hx8k.pcf", include_str!("../../constraints/hx8k.pcf")),
    ("upduino3.pcf", include_str!("../../constraints/upduino3.pcf")),
    ("tinyfpga-bx.pcf", include_str!("../../constraints/tinyfpga-bx.pcf")),
    ("ulx3s.lpf", include_str!("../../constraints/ulx3s.lpf")),
    ("colorlight-i5.lpf", include_str!("../../constraints/colorlight-i5.lpf")),
    ("orangecrab.lpf", include_str!("../../constraints/orangecrab.lpf")),
    ("tang-nano-9k.cst", include_str!("../../constraints/tang-nano-9k.cst")),
    ("tang-nano-20k.cst", include_str!("../../constraints/tang-nano-20k.cst")),
];

/// A board with an FPGA on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Board {
    /// Name on the command line.
    pub name: String,
    /// Maker's name.
    pub title: String,
    /// What a builder has to know, line by line.
    pub notes: Vec<String>,
    /// Family of its FPGA.
    pub family: Family,
    /// FPGA, as its tools call it: `hx1k`, `25k`, `GW1N-9C`.
    pub device: String,
    /// Package, as they call it: `tq144`, `CABGA381`; of Gowin the part, `GW1NR-LV9QN88PC6/I5`.
    pub package: String,
    /// Command that loads a bitstream; the file's name follows.
    pub program: String,
    /// Frequency of the clock on the board, MHz.
    pub clock_mhz: u32,
    /// Where that clock comes from.
    pub clock_source: String,
    /// Every pin, in order of the file.
    pub pins: Vec<Pin>,
    /// File name of the constraints.
    pub file: String,
    /// The constraints.
    pub constraints: String,
}

impl Board {
    /// Every board there are constraints for.
    ///
    /// # Errors
    ///
    /// [`GenError::Constraints`] for a file that lacks something; a test holds those that come
    /// along to it.
    pub fn all() -> Result<Vec<Self>, GenError> {
        FILES.iter().map(|(file, text)| Self::parse(file, text)).collect()
    }

    /// The board of that name.
    ///
    /// # Errors
    ///
    /// [`GenError::UnknownBoard`] with the names there are.
    pub fn find(name: &str) -> Result<Self, GenError> {
        let all = Self::all()?;
        let known = all.iter().map(|board| board.name.clone()).collect();
        let found = all.into_iter().find(|board| board.name == name);
        found.ok_or_else(|| GenError::UnknownBoard { found: name.to_owned(), known })
    }

    /// Reads a constraint file.
    fn parse(file: &str, text: &str) -> Result<Self, GenError> {
        let missing = |what| GenError::Constraints { file: file.to_owned(), what };
        let family = Family::of(file).ok_or_else(|| missing("a placer's ending"))?;
        let comment = |line| constraints::comment(family, line);
        let tag = |tag: &'static str| {
            let found = text.lines().find_map(|line| comment(line)?.strip_prefix(tag));
            found.map(|value| value.trim().to_owned()).ok_or_else(|| missing(tag))
        };
        let mut notes = text.lines().map_while(comment).map(str::to_owned);
        let pins = constraints::pins(family, text);
        let clock_source = pins.iter().find(|pin| pin.port == "clock").map(|pin| &pin.note);
        Ok(Self {
            name: tag("board:")?,
            title: notes.next().ok_or_else(|| missing("a title"))?,
            notes: notes.collect(),
            family,
            device: tag("device:")?,
            package: tag("package:")?,
            program: tag("program:")?,
            clock_mhz: constraints::clock_mhz(family, text)
                .ok_or_else(|| missing(constraints::clock(family)))?,
            clock_source: clock_source.ok_or_else(|| missing("a pin of the clock"))?.clone(),
            pins,
            file: file.to_owned(),
            constraints: text.to_owned(),
        })
    }

    /// The FPGA, without its package.
    #[must_use]
    pub fn chip(&self) -> String {
        match self.family {
            Family::Ice40 => self.device.to_uppercase(),
            Family::Ecp5 => format!("LFE5U-{}F", self.device.trim_end_matches('k')),
            Family::Gowin => self.device.clone(),
        }
    }

    /// The FPGA in its package; of Gowin the part, which says both.
    #[must_use]
    pub fn part(&self) -> String {
        match self.family {
            Family::Ice40 => format!("{}-{}", self.device, self.package),
            Family::Ecp5 => format!("{}-{}", self.chip(), self.package),
            Family::Gowin => self.package.clone(),
        }
    }

    /// The pins that the design uses, in order of the file.
    #[must_use]
    pub fn pins_of(&self, top: &Module) -> Vec<Pin> {
        let wanted: Vec<String> = top.ports.iter().flat_map(|port| bits(top, port)).collect();
        self.pins.iter().filter(|pin| wanted.contains(&pin.port)).cloned().collect()
    }

    /// Checks that every bit of every port has a pin, and every pin that is not optional a port.
    ///
    /// # Errors
    ///
    /// [`GenError::Pins`] with what is left over on either side.
    pub fn check(&self, top: &Module) -> Result<(), GenError> {
        let wanted: Vec<String> = top.ports.iter().flat_map(|port| bits(top, port)).collect();
        let without_pin = wanted.iter().filter(|bit| !self.pins.iter().any(|p| p.port == **bit));
        let needed = self.pins.iter().filter(|pin| !pin.optional);
        let without_port = needed.filter(|pin| !wanted.contains(&pin.port));
        let without_pin: Vec<String> = without_pin.cloned().collect();
        let without_port: Vec<String> = without_port.map(|pin| pin.port.clone()).collect();
        if without_pin.is_empty() && without_port.is_empty() {
            return Ok(());
        }
        Err(GenError::Pins { file: self.file.clone(), without_pin, without_port })
    }
}

/// The bits of a port as constraint files call them.
fn bits(top: &Module, port: &helixlock_netlist::Port) -> Vec<String> {
    let width = match port.kind {
        PortKind::Clock => 1,
        PortKind::Input(id) | PortKind::Output(id) => top.signal(id).width,
    };
    match width {
        1 => vec![port.name.clone()],
        _ => (0..width).map(|bit| format!("{}[{bit}]", port.name)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn every_file_is_complete() {
        let names: Vec<_> = Board::all().unwrap().into_iter().map(|board| board.name).collect();
        let expected = "icestick icebreaker hx8k upduino tinyfpga-bx ulx3s colorlight-i5 \
                        orangecrab tang-nano-9k tang-nano-20k";
        assert_eq!(names.join(" "), expected);
    }

    #[test]
    fn the_boards_are_the_files_of_the_folder() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../constraints");
        let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name());
        let found: BTreeSet<_> = entries.map(|name| name.into_string().unwrap()).collect();
        assert_eq!(found, FILES.iter().map(|(file, _)| (*file).to_owned()).collect());
    }

    #[test]
    fn no_pin_is_used_twice() {
        for board in Board::all().unwrap() {
            let mut pins: Vec<_> = board.pins.iter().map(|pin| &pin.pin).collect();
            pins.sort();
            pins.dedup();
            assert_eq!(pins.len(), board.pins.len(), "{}", board.name);
        }
    }

    #[test]
    fn reads_what_the_comments_say() {
        let board = Board::find("tinyfpga-bx").unwrap();
        assert_eq!(board.title, "TinyFPGA BX");
        assert_eq!((board.device.as_str(), board.package.as_str()), ("lp8k", "cm81"));
        assert_eq!((board.clock_mhz, board.clock_source.as_str()), (16, "16 MHz oscillator"));
        assert_eq!(board.notes.len(), 2);
    }

    #[test]
    fn reads_three_languages() {
        for (board, part, clock_mhz, bit, pin) in [
            ("tinyfpga-bx", "lp8k-cm81", 16, "calibrate[1]", ("E2", "pin 8: switch")),
            ("ulx3s", "LFE5U-12F-CABGA381", 25, "calibrate[1]", ("B9", "J1 gp3: switch")),
            ("tang-nano-9k", "GW1NR-LV9QN88PC6/I5", 27, "calibrate[1]", ("33", "pin 33: switch")),
        ] {
            let board = Board::find(board).unwrap();
            assert_eq!((board.part().as_str(), board.clock_mhz), (part, clock_mhz));
            let found = board.pins.iter().find(|pin| pin.port == bit).unwrap();
            assert!(found.note.starts_with(pin.1), "{}", found.note);
            assert_eq!((found.pin.as_str(), found.optional, found.pull_up), (pin.0, false, true));
            let t1 = board.pins.iter().find(|pin| pin.port == "t1").unwrap();
            let stop = board.pins.iter().find(|pin| pin.port == "emergency_stop").unwrap();
            assert!(!t1.pull_up && !t1.optional && stop.pull_up && stop.optional);
        }
    }

    /// nextpnr-ice40 warns of pins without a port unless it is told not to; the others are silent.
    #[test]
    fn pins_that_may_be_missing_are_so_for_the_placer_too() {
        for board in Board::all().unwrap().iter().filter(|board| board.family == Family::Ice40) {
            let quiet = board.constraints.lines().filter(|line| line.starts_with("set_io -nowarn"));
            let optional = board.pins.iter().filter(|pin| pin.optional);
            assert_eq!(quiet.count(), optional.count(), "{}", board.name);
        }
    }

    #[test]
    fn an_unknown_board_is_answered_with_the_known_ones() {
        assert_eq!(
            Board::find("arty").unwrap_err().to_string(),
            "board `arty` is not known; expected one of icestick, icebreaker, hx8k, upduino, \
             tinyfpga-bx, ulx3s, colorlight-i5, orangecrab, tang-nano-9k, tang-nano-20k"
        );
    }
}
