//! What `helixlock gen` says of the project it wrote.

use std::io::Write;
use std::path::Path;

use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use helixlock_gen::{Board, Project, Synthesis};
use helixlock_sim::Dialled;

use crate::shared::keys::keys;
use crate::shared::next::Next;
use crate::shared::wheels::Wheels;

keys! {
    /// The project in plain numbers; the JSON of `--json`. `machine` is what the machine file
    /// says: its settings, and its clock, Hz.
    Summary(
        project: &Project, board: &Board, pins: &[helixlock_gen::Pin],
        machine: (&Dialled, f64), synthesis: Option<&Synthesis>
    ) {
        board: String = board.name.clone(),
        title: String = board.title.clone(),
        device: String = board.device.clone(),
        package: String = board.package.clone(),
        part: String = board.part(),
        clock_source: String = board.clock_source.clone(),
        clock_hz: u64 = 1_000_000 * u64::from(board.clock_mhz),
        machine_file_clock_hz: f64 = machine.1,
        settings: Wheels = Wheels::new(machine.0),
        notes: Vec<String> = board.notes.clone(),
        pins: Vec<Pin> = pins.iter().map(Pin::new).collect(),
        files: Vec<String> = project.files.iter().map(|(name, _)| name.clone()).collect(),
        synthesis: Option<Built> = synthesis.map(Built::new),
    }

    Pin(place: &helixlock_gen::Pin) {
        port: String = place.port.clone(),
        pin: String = place.pin.clone(),
        note: String = place.note.clone(),
    }

    Built(synthesis: &Synthesis) {
        cells: u32 = synthesis.cells,
        cells_available: u32 = synthesis.cells_available,
        lookup_tables: u32 = synthesis.tables,
        flip_flops: u32 = synthesis.flip_flops,
        carry_cells: u32 = synthesis.carries,
        max_clock_mhz: f64 = synthesis.max_mhz,
        meets_clock: bool = f64::from(synthesis.clock_mhz) <= synthesis.max_mhz,
        files: Vec<String> = synthesis.products.clone(),
    }
}

impl Summary {
    /// False when the board's clock is faster than the logic.
    pub(crate) fn is_fast_enough(&self) -> bool {
        self.synthesis.as_ref().is_none_or(|built| built.meets_clock)
    }

    /// Prints it for people.
    pub(crate) fn print(&self, output: &Path, out: &mut impl Write) -> anyhow::Result<()> {
        writeln!(out, "{}, {}, {}", self.title, self.part, self.clock_source)?;
        writeln!(out, "{}", self.settings)?;
        #[expect(clippy::cast_precision_loss, reason = "megahertz are far below 2^53 Hz")]
        let clock_hz = self.clock_hz as f64;
        if (clock_hz - self.machine_file_clock_hz).abs() >= 0.5 {
            writeln!(
                out,
                "note: the machine file is for another board at {} MHz; the step clock is set for \
                 the {} MHz of this one",
                self.machine_file_clock_hz / 1e6,
                clock_hz / 1e6,
            )?;
        }
        writeln!(out, "\n{}", self.pin_table())?;
        self.notes.iter().try_for_each(|note| writeln!(out, "{note}"))?;
        if let Some(built) = &self.synthesis {
            writeln!(out, "\n{}", built.table(clock_hz / 1e6))?;
        }
        let made = self.synthesis.iter().flat_map(|built| &built.files);
        let files = self.files.len() + made.count();
        writeln!(out, "\n{}: {files} files", output.display())?;
        if self.synthesis.is_some() {
            let next = Next::command("board").words(["flash"]).words([output]);
            return next.words(["--board", &self.board]).print(out);
        }
        Next::program("make").words(["-C"]).words([output]).words(["sim"]).print(out)
    }

    fn pin_table(&self) -> Table {
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED).set_header(["port", "pin", "wire it to"]);
        for pin in &self.pins {
            table.add_row([&pin.port, &pin.pin, &pin.note]);
        }
        table
    }
}

impl Built {
    fn table(&self, clock_mhz: f64) -> Table {
        let cells = format!("{} of {}", self.cells, self.cells_available);
        let clock = format!("{:.1} MHz, {clock_mhz} MHz needed", self.max_clock_mhz);
        let rows = [
            ("logic cells", cells),
            ("lookup tables", self.lookup_tables.to_string()),
            ("flip-flops", self.flip_flops.to_string()),
            ("carry cells", self.carry_cells.to_string()),
            ("maximum clock", clock),
        ];
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED).set_header(["synthesis", ""]);
        for (what, value) in rows {
            table.add_row([what, &value]);
        }
        if let Some(values) = table.column_mut(1) {
            values.set_cell_alignment(CellAlignment::Right);
        }
        table
    }
}
