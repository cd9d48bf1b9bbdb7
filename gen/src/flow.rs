//! The way from Verilog to a bitstream, as commands: the Makefile and [`crate::synthesise`] run
//! the same ones.

use crate::Board;

/// One run of a tool, in the project's folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Step {
    /// Command.
    pub(crate) tool: &'static str,
    /// Debian package that has it.
    pub(crate) package: &'static str,
    /// File it makes.
    pub(crate) product: String,
    /// File it needs that an earlier step makes, if any.
    pub(crate) needs: Option<String>,
    /// Words after the command.
    pub(crate) arguments: Vec<String>,
}

/// Synthesis, placing and routing, timing, packing.
pub(crate) fn flow(top: &str, sources: &[String], board: &Board) -> Vec<Step> {
    let build = |ending: &str| format!("build/{top}.{ending}");
    let (json, asc) = (build("json"), build("asc"));
    let words = |line: &str| line.split_ascii_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let (device, package, pcf) = (&board.device, &board.package, &board.file);
    let mut yosys = words(&format!("-q -l build/{top}.yosys.log -p"));
    // Eight flip-flops of a tile share their clock enable: many small groups with one each find no
    // place on a small FPGA that has room for all cells.
    yosys.push(format!("synth_ice40 -dffe_min_ce_use 4 -top {top} -json {json}"));
    yosys.extend(sources.iter().cloned());
    let nextpnr = format!(
        "-q --{device} --package {package} --pcf {pcf} --json {json} --asc {asc} --seed 1 \
         --log build/{top}.nextpnr.log"
    );
    let timing = build("timing");
    let icetime = format!("-d {device} -P {package} -m -t -r {timing} {asc}");
    let step = |tool, package, product: String, needs, arguments| Step {
        tool,
        package,
        product,
        needs,
        arguments,
    };
    vec![
        step("yosys", "yosys", json.clone(), None, yosys),
        step("nextpnr-ice40", "nextpnr-ice40", asc.clone(), Some(json), words(&nextpnr)),
        step("icetime", "fpga-icestorm", timing, Some(asc.clone()), words(&icetime)),
        step("icepack", "fpga-icestorm", build("bin"), Some(asc.clone()), vec![asc, build("bin")]),
    ]
}
