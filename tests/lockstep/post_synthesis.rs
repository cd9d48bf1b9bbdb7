//! After synthesis: the gates yosys made of the Verilog answer like the engine, pin for pin.

use std::process::Command;
use std::sync::LazyLock;

use helixlock_netlist::{Design, Netlist};
use helixlock_sim::{device, stepped_device};

use super::records::{Layout, expected, report};
use super::stimulus::{Stimulus, dense, realistic};
use super::verilator::{Program, harness, put};
use super::{BATCH, clocks};
use crate::golden_verilog::device_design;

/// Models of the iCE40's cells, which come with yosys.
const CELLS: &str = "/usr/share/yosys/ice40/cells_sim.v";

/// The gates, compiled once.
fn program() -> &'static Program {
    static GATES: LazyLock<Program> = LazyLock::new(|| gates(&device_design(), device().netlist()));
    &GATES
}

fn gates(design: &Design, netlist: &Netlist) -> Program {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let top = &design.top().name;
    let mut read = String::from("read_verilog");
    for (name, text) in helixlock_gen::verilog(design).expect("legal names") {
        put(folder.path(), &format!("{name}.v"), &text);
        read = read + " " + &name + ".v";
    }
    let script =
        format!("{read}; synth_ice40 -dffe_min_ce_use 4 -top {top}; write_verilog -noattr gates.v");
    let synthesised = Command::new("yosys")
        .args(["-q", "-p", &script])
        .current_dir(folder.path())
        .output()
        .expect("yosys is installed");
    let said = String::from_utf8_lossy(&synthesised.stderr).into_owned();
    assert!(synthesised.status.success() && said.is_empty(), "{said}");
    put(folder.path(), "main.cpp", &harness(top, netlist, false));
    let sources = ["main.cpp", "gates.v", CELLS].map(str::to_owned);
    let options = ["-Wno-fatal", "-Wno-lint", "-DNO_ICE40_DEFAULT_ASSIGNMENTS"];
    Program::build(folder, top, &sources, &options)
}

fn compare(mut stimulus: Stimulus, clocks: u64) {
    let netlist = device().netlist();
    let layout = Layout::of(netlist);
    let state_bits: u32 =
        netlist.registers.iter().map(|register| netlist.signal(register.output).width).sum();
    let mut gates = program().start();
    let mut engine = stepped_device();
    let mut inputs = vec![0; netlist.inputs.len()];
    let mut done = 0;
    while done < clocks {
        let (mut asked, mut answers) = (vec![], vec![]);
        for _ in 0..BATCH {
            stimulus.next(&mut inputs);
            asked.extend(layout.pack_inputs(&inputs));
            let mut answer = expected(&mut engine, &layout, netlist, &inputs);
            clear_bits(&mut answer, state_bits);
            answers.extend(answer);
        }
        let found = gates.run(&asked, answers.len());
        assert!(found == answers, "{}", report(&layout, netlist, done, &answers, &found));
        done += BATCH as u64;
    }
}

/// Flip-flops have no names any more after synthesis.
fn clear_bits(record: &mut [u8], bits: u32) {
    for bit in 0..bits as usize {
        record[bit / 8] &= !(1 << (bit % 8));
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn gates_agree_with_the_engine_on_noise() {
    compare(dense(device().netlist(), 8), clocks() / 10);
}

#[test]
fn gates_agree_with_the_engine_on_a_pass() {
    compare(realistic(device().netlist(), 9), clocks() / 10);
}
