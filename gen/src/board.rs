//! Boards: everything known of one stands in its constraint file.
//!
//! The file is what nextpnr reads; its leading comments add the FPGA, the programmer and what has
//! to be wired where.

use helixlock_netlist::{Module, PortKind};

use crate::GenError;

/// The constraint files, by name: all there are in the folder, in the order of help and messages.
const FILES: &[(&str, &str)] = &[
    ("icestick.pcf", include_str!("../../constraints/icestick.pcf")),
    ("icebreaker.pcf", include_str!("../../constraints/icebreaker.pcf")),
    ("hx8k.pcf", include_str!("../../constraints/hx8k.pcf")),
    ("upduino3.pcf", include_str!("../../constraints/upduino3.pcf")),
    ("tinyfpga-bx.pcf", include_str!("../../constraints/tinyfpga-bx.pcf")),
];

/// A board with an iCE40 on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Board {
    /// Name on the command line.
    pub name: String,
    /// Maker's name.
    pub title: String,
    /// What a builder has to know, line by line.
    pub notes: Vec<String>,
    /// FPGA, as nextpnr and icetime call it: `hx1k`.
    pub device: String,
    /// Package, as nextpnr calls it: `tq144`.
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

/// Where a bit of a port goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pin {
    /// Port, or bit of one: `calibrate[0]`.
    pub port: String,
    /// Pin of the package.
    pub pin: String,
    /// Connector and purpose.
    pub note: String,
    /// The design may lack the port: `-nowarn` in the file.
    pub optional: bool,
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
        let tag = |tag: &'static str| {
            let found = text.lines().find_map(|line| line.strip_prefix("# ")?.strip_prefix(tag));
            found.map(|value| value.trim().to_owned()).ok_or_else(|| missing(tag))
        };
        let mut notes = text.lines().map_while(|line| line.strip_prefix("# ")).map(str::to_owned);
        let clock_mhz = text.lines().find_map(|line| line.strip_prefix("set_frequency clock "));
        let pins: Vec<Pin> = text.lines().filter_map(pin).collect();
        let clock_source = pins.iter().find(|pin| pin.port == "clock").map(|pin| &pin.note);
        Ok(Self {
            name: tag("board:")?,
            title: notes.next().ok_or_else(|| missing("a title"))?,
            notes: notes.collect(),
            device: tag("device:")?,
            package: tag("package:")?,
            program: tag("program:")?,
            clock_mhz: clock_mhz
                .and_then(|mhz| mhz.trim().parse().ok())
                .ok_or_else(|| missing("set_frequency clock"))?,
            clock_source: clock_source.ok_or_else(|| missing("set_io clock"))?.clone(),
            pins,
            file: file.to_owned(),
            constraints: text.to_owned(),
        })
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

fn pin(line: &str) -> Option<Pin> {
    let (set, note) = line.split_once('#').unwrap_or((line, ""));
    let words: Vec<&str> = set.strip_prefix("set_io ")?.split_ascii_whitespace().collect();
    let [options @ .., port, pin] = words.as_slice() else { return None };
    let (port, pin) = ((*port).to_owned(), (*pin).to_owned());
    let optional = options.contains(&"-nowarn");
    Some(Pin { port, pin, note: note.trim().to_owned(), optional })
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
        assert_eq!(names, ["icestick", "icebreaker", "hx8k", "upduino", "tinyfpga-bx"]);
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
        let calibrate = board.pins.iter().find(|pin| pin.port == "calibrate[1]").unwrap();
        assert_eq!((calibrate.pin.as_str(), &calibrate.note[..5]), ("E2", "pin 8"));
    }

    #[test]
    fn an_unknown_board_is_answered_with_the_known_ones() {
        assert_eq!(
            Board::find("ulx3s").unwrap_err().to_string(),
            "board `ulx3s` is not known; expected one of icestick, icebreaker, hx8k, upduino, \
             tinyfpga-bx"
        );
    }
}
