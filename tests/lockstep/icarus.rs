//! The emitted Verilog in Icarus, with a bench that reads and writes records as hexadecimal text.

use std::fmt::Write as _;
use std::process::Command;

use helixlock_netlist::{Design, Netlist};

use super::records::Layout;
use super::verilator::put;

/// The answers of the design's Verilog to the records, packed like the engine's.
pub(crate) fn run(
    design: &Design,
    netlist: &Netlist,
    layout: &Layout,
    asked: &[Vec<u8>],
) -> Vec<u8> {
    let modules = helixlock_gen::verilog(design).expect("legal names");
    run_modules(&modules, design, netlist, layout, asked)
}

/// The answers of these modules, which have the design's ports and registers.
pub(crate) fn run_modules(
    modules: &[(String, String)],
    design: &Design,
    netlist: &Netlist,
    layout: &Layout,
    asked: &[Vec<u8>],
) -> Vec<u8> {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let mut sources = vec!["bench.v".to_owned()];
    for (name, text) in modules {
        put(folder.path(), &format!("{name}.v"), text);
        sources.push(format!("{name}.v"));
    }
    put(folder.path(), "bench.v", &bench(design, netlist, layout));
    let records = asked.iter().map(|record| hexadecimal(record) + "\n");
    put(folder.path(), "inputs.hex", &records.collect::<String>());
    let compiled = Command::new("iverilog")
        .args(["-g2005", "-Wall", "-s", "bench", "-o", "bench.vvp"])
        .args(&sources)
        .current_dir(folder.path())
        .output()
        .expect("iverilog is installed");
    let complaints = String::from_utf8_lossy(&compiled.stderr).into_owned();
    assert!(compiled.status.success() && !complaints.contains("rtl"), "{complaints}");
    let ran = Command::new("vvp").arg("bench.vvp").current_dir(folder.path()).output();
    let ran = ran.expect("vvp is installed");
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout).expect("text").lines().flat_map(bytes).collect()
}

/// Most significant byte first, as `%h` reads and writes it.
fn hexadecimal(record: &[u8]) -> String {
    record.iter().rev().fold(String::new(), |text, byte| text + &format!("{byte:02x}"))
}

fn bytes(line: &str) -> Vec<u8> {
    let digits = line.as_bytes().rchunks(2);
    let byte = |pair| u8::from_str_radix(std::str::from_utf8(pair).expect("ASCII"), 16);
    digits.map(|pair| byte(pair).unwrap_or_else(|_| panic!("undefined bits in {line}"))).collect()
}

fn bench(design: &Design, netlist: &Netlist, layout: &Layout) -> String {
    let top = &design.top().name;
    let (in_bits, out_bits) = (8 * layout.input_bytes(), 8 * layout.answer_bytes());
    let mut text = format!(
        "module bench;\n  reg clock = 0;\n  reg [{}:0] in = 0;\n  wire [{}:0] out;\n  integer file, got;\n",
        in_bits - 1,
        out_bits - 1
    );
    let mut connections = vec![".clock(clock)".to_owned()];
    let mut low = 0;
    for (&id, width) in netlist.inputs.iter().zip(layout.input_widths()) {
        connections.push(format!(".{}(in[{}:{low}])", netlist.signal(id).path, low + width - 1));
        low += width;
    }
    low = 0;
    for (index, &(id, width)) in layout.answers().iter().enumerate() {
        let (path, high) = (&netlist.signal(id).path, low + width - 1);
        if index < netlist.registers.len() {
            writeln!(text, "  assign out[{high}:{low}] = dut.{path};")
                .expect("a string takes everything");
        } else {
            connections.push(format!(".{path}(out[{high}:{low}])"));
        }
        low += width;
    }
    if (low as usize) < out_bits {
        writeln!(text, "  assign out[{}:{low}] = 0;", out_bits - 1)
            .expect("a string takes everything");
    }
    writeln!(text, "  {top} dut({});", connections.join(", ")).expect("a string takes everything");
    text + "  initial begin
    file = $fopen(\"inputs.hex\", \"r\");
    got = $fscanf(file, \"%h\", in);
    while (got == 1) begin
      #1 clock = 1;
      #1 $display(\"%h\", out);
      clock = 0;
      got = $fscanf(file, \"%h\", in);
    end
    $finish;
  end
endmodule
"
}
