//! The blocks of documents 3 and 4 as Verilog: reviewed, linted, and small enough for a small FPGA.

use std::path::PathBuf;
use std::process::Command;

use expect_test::expect_file;
use helixlock_netlist::{Library, elaborate};
use helixlock_rtl::APART;

fn golden(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.v"))
}

#[test]
fn as_reviewed() {
    for card in APART {
        let library = Library::new().with(card.name, card.summary, (card.build)());
        let design = elaborate(card.name, &*(card.build)(), &library).expect("sound");
        for (name, text) in helixlock_gen::verilog(&design).expect("the names are legal") {
            expect_file![golden(&name)].assert_eq(&text);
        }
    }
}

#[test]
fn verilator_has_nothing_to_say() {
    for card in APART {
        let output = Command::new("verilator")
            .args(["--lint-only", "-Wall"])
            .arg(golden(card.name))
            .output()
            .expect("verilator, of the Debian package of that name, starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success() && said.is_empty(), "{}: {said}", card.name);
    }
}

/// The smallest of our FPGAs has 1280 logic cells.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn each_fits_half_a_small_fpga() {
    for card in APART {
        let script = format!(
            "read_verilog {}; synth_ice40 -top {}; stat",
            golden(card.name).display(),
            card.name
        );
        let output = Command::new("yosys")
            .args(["-p", &script])
            .output()
            .expect("yosys, of the Debian package of that name, starts");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{}: {said}", card.name);
        let cells: u32 = said
            .lines()
            .rev()
            .filter_map(|line| line.trim().strip_prefix("SB_LUT4"))
            .find_map(|count| count.trim().parse().ok())
            .expect("a count of look-up tables");
        assert!(cells < 640, "{}: {cells} look-up tables", card.name);
    }
}
