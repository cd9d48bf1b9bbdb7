//! After a reset of four clocks nothing is left of the power-up state.
//!
//! Two copies of the device get the same inputs and different power-up states; after four clocks
//! of `master_reset` every register must be equal. Equal states and equal inputs stay equal, so
//! four clocks prove it for ever.

use std::fmt::Write;

use anyhow::Context;
use helixlock_netlist::{Library, Netlist, elaborate};
use helixlock_rtl::BLOCKS;

use super::sources::Sources;
use crate::tools::{write_scratch, yosys};

/// Clocks of reset, as the device's page demands.
const CLOCKS: u32 = 4;

/// Number of registers compared, if all were proven equal.
///
/// # Errors
///
/// When yosys cannot be started, or the device cannot be elaborated.
pub fn power_up(sources: &Sources) -> anyhow::Result<Option<usize>> {
    let card = BLOCKS.iter().find(|card| card.name == "device").context("there is a device")?;
    let design = elaborate(card.name, &*(card.build)(), &Library::new())?;
    let netlist = Netlist::new(&design)?;
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("forgets.sv");
    write_scratch(&path, &two_copies(&netlist))?;
    let script = format!(
        "read_verilog {verilog}/*.v; read_verilog -sv -formal {path}; prep -top forgets -flatten; \
         setattr -unset init w:one.* w:other.*; \
         sat -verify -prove-asserts -set-assumes -seq {CLOCKS} -set-at 1 age 0 forgets",
        verilog = sources.verilog.display(),
        path = path.display(),
    );
    Ok(yosys(&script)?.0.then_some(netlist.registers.len()))
}

/// A module around two devices with the same inputs, asserting that all registers are equal.
fn two_copies(netlist: &Netlist) -> String {
    let (mut declared, mut connected) = (String::new(), String::new());
    for id in &netlist.inputs {
        let input = netlist.signal(*id);
        // Writing to a string cannot fail.
        let _ = write!(declared, ", input [{}:0] {}", input.width - 1, input.path);
        let _ = write!(connected, ", .{0}({0})", input.path);
    }
    let mut text = format!("module forgets(input clock{declared});\n");
    for copy in ["one", "other"] {
        let _ = writeln!(text, "    device {copy}(.clock(clock){connected});");
    }
    let _ = writeln!(text, "    reg [2:0] age = 0;");
    let _ = writeln!(text, "    always @(posedge clock) if (age != {CLOCKS}) age <= age + 1;");
    let _ = writeln!(text, "    always @* if (age != {CLOCKS}) assume (master_reset);");
    for register in &netlist.registers {
        let signal = netlist.signal(register.output);
        let (high, path) = (signal.width - 1, &signal.path);
        for copy in ["one", "other"] {
            let _ = writeln!(text, "    (* hierconn *) wire [{high}:0] \\{copy}.{path} ;");
        }
        let _ = writeln!(
            text,
            "    always @* if (age == {CLOCKS}) assert ( \\one.{path} == \\other.{path} );"
        );
    }
    text.push_str("endmodule\n");
    text
}
