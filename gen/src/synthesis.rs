//! Runs the tools on a project and reads what they report.

use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Output};

use crate::flow::{Step, flow};
use crate::{Board, Family, GenError, Project};

/// What became of a design on a board.
#[derive(Clone, Debug, PartialEq)]
pub struct Synthesis {
    /// Logic cells used.
    pub cells: u32,
    /// Logic cells the FPGA has.
    pub cells_available: u32,
    /// Four-input tables.
    pub tables: u32,
    /// Flip-flops.
    pub flip_flops: u32,
    /// Carry cells.
    pub carries: u32,
    /// Highest clock, worst corner, as icetime finds it, or nextpnr where there is no icetime, MHz.
    pub max_mhz: f64,
    /// The board's clock, MHz.
    pub clock_mhz: u32,
    /// Files made, by their names in the project's folder.
    pub products: Vec<String>,
}

/// Builds the bitstream of a project whose files stand in `folder`.
///
/// Products go to `folder/build`.
///
/// # Errors
///
/// A tool that is missing or fails, or a report that cannot be read.
pub fn synthesise(folder: &Path, project: &Project, board: &Board) -> Result<Synthesis, GenError> {
    let build = folder.join("build");
    fs::create_dir_all(&build).map_err(|source| GenError::Folder { path: build, source })?;
    let mut products = vec![];
    for step in flow(&project.top, &project.sources, board) {
        run(&step, folder)?;
        products.push(step.product);
    }
    let log = |ending: &str| read(folder, &format!("build/{}.{ending}", project.top));
    let (family, yosys, nextpnr) = (board.family, log("yosys.log")?, log("nextpnr.log")?);
    let (cells, cells_available) = used_cells(&nextpnr, family.cells())?;
    Ok(Synthesis {
        cells,
        cells_available,
        tables: count_cells(&yosys, family.tables()),
        flip_flops: count_cells(&yosys, family.flip_flops()),
        carries: count_cells(&yosys, family.carries()),
        max_mhz: match family {
            Family::Ice40 => icetime_mhz(&log("timing")?)?,
            Family::Ecp5 | Family::Gowin => nextpnr_mhz(&nextpnr)?,
        },
        clock_mhz: board.clock_mhz,
        products,
    })
}

fn run(step: &Step, folder: &Path) -> Result<(), GenError> {
    let (tool, origin) = (step.tool, step.origin);
    let output = Command::new(tool).args(&step.arguments).current_dir(folder).output();
    let output = output.map_err(|source| match source.kind() {
        io::ErrorKind::NotFound => GenError::MissingTool { tool, origin },
        _ => GenError::ToolFailed { tool, status: source.to_string(), output: String::new() },
    })?;
    if output.status.success() {
        return Ok(());
    }
    let said = last_lines(&output);
    if said.contains("Can't find chipdb") {
        return Err(GenError::MissingChipDatabase);
    }
    Err(GenError::ToolFailed { tool, status: output.status.to_string(), output: said })
}

/// The end of what a tool said, where the reason stands.
fn last_lines(output: &Output) -> String {
    let said = [&output.stdout[..], &output.stderr[..]].concat();
    let said = String::from_utf8_lossy(&said);
    let lines: Vec<&str> = said.lines().collect();
    lines[lines.len().saturating_sub(10)..].join("\n")
}

fn read(folder: &Path, name: &str) -> Result<String, GenError> {
    let path = folder.join(name);
    fs::read_to_string(&path).map_err(|source| GenError::Folder { path, source })
}

/// Cells whose names begin so in the last statistics of a yosys log: `SB_DFF` for all its variants.
fn count_cells(log: &str, sort: &str) -> u32 {
    let statistics = log.rsplit("Printing statistics").next().unwrap_or(log);
    let counts = statistics.lines().filter_map(|line| {
        let mut words = line.split_ascii_whitespace();
        let cell = words.next()?;
        let count = words.next()?.parse::<u32>().ok()?;
        cell.starts_with(sort).then_some(count)
    });
    counts.sum()
}

/// Used and available cells: `ICESTORM_LC:   287/ 1280    22%`. With block RAM the placer tells its
/// way of each sort of cell as well, in lines without two such numbers.
fn used_cells(log: &str, sort: &str) -> Result<(u32, u32), GenError> {
    let read = |line: &str| {
        let (_, rest) = line.split_once(sort)?;
        let (used, rest) = rest.split_once('/')?;
        let available = rest.split_ascii_whitespace().next()?;
        Some((used.trim().parse().ok()?, available.parse().ok()?))
    };
    let missing = GenError::Report { tool: "nextpnr", figure: "number of logic cells" };
    log.lines().rev().find_map(read).ok_or(missing)
}

/// Highest clock: `Total path delay: 9.12 ns (109.65 MHz)`.
fn icetime_mhz(report: &str) -> Result<f64, GenError> {
    let read = || {
        let (_, rest) = report.split_once("Total path delay:")?;
        let (_, rest) = rest.split_once('(')?;
        rest.split_once(" MHz")?.0.parse().ok()
    };
    read().ok_or(GenError::Report { tool: "icetime", figure: "path delay" })
}

/// Highest clock after routing: `Max frequency for clock 'clock': 142.05 MHz (PASS at 25.00 MHz)`.
fn nextpnr_mhz(log: &str) -> Result<f64, GenError> {
    let read = || {
        let (_, rest) = log.rsplit_once("Max frequency for clock")?;
        let (_, rest) = rest.split_once(':')?;
        rest.split_once(" MHz")?.0.trim().parse().ok()
    };
    read().ok_or(GenError::Report { tool: "nextpnr", figure: "frequency" })
}

#[cfg(test)]
mod tests {
    use super::*;

    // Lines as yosys 0.23, nextpnr 0.4 and icetime print them.

    #[test]
    fn reads_the_last_statistics_of_yosys() {
        let log = "Printing statistics.\n  SB_LUT4  900\nPrinting statistics.\n\n\
                   SB_CARRY                       76\n     SB_DFF                         21\n\
                   SB_DFFESR                      63\n     SB_LUT4                       236\n";
        assert_eq!(count_cells(log, "SB_DFF"), 84);
        assert_eq!(count_cells(log, "SB_LUT4"), 236);
        assert_eq!(count_cells(log, "SB_CARRY"), 76);
    }

    #[test]
    fn reads_cells_and_clock() {
        let log = "Info: \t         ICESTORM_LC:   287/ 1280    22%\n\
                   Info:     at iteration #1, type ICESTORM_LC: wirelen solved = 613\n";
        assert_eq!(used_cells(log, "ICESTORM_LC:").unwrap(), (287, 1280));
        let report = "Total path delay: 9.12 ns (109.65 MHz)\n";
        assert!((icetime_mhz(report).unwrap() - 109.65).abs() < 1e-9);
    }

    #[test]
    fn says_which_figure_is_missing() {
        let error = icetime_mhz("nothing").unwrap_err().to_string();
        assert_eq!(error, "`icetime` reported no path delay; its version may be unknown to us");
    }
}
