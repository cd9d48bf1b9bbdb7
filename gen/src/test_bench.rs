//! A test bench that checks the outputs after every clock against what an engine recorded.

use std::fmt::Write as _;

use helixlock_netlist::{Module, Port, PortKind};

/// Clocks during which neither inputs nor outputs change.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vector {
    /// Number of rising edges.
    pub clocks: u64,
    /// Value of each input port but the clock, in port order, set before the first edge.
    pub inputs: Vec<u64>,
    /// Value of each output port, in port order, after each of the edges.
    pub outputs: Vec<u64>,
}

/// How a module is tested.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bench {
    /// Its name.
    pub module: String,
    /// What goes in and comes out.
    pub vectors: Vec<Vector>,
    /// Values that settings inside it have for ever, by their paths: `device.divide_a`.
    pub constants: Vec<(String, u64)>,
}

/// The vectors as text: a line each, clocks in decimal, then the ports in hexadecimal.
pub(crate) fn vectors_text(top: &Module, vectors: &[Vector]) -> String {
    let names = |wanted: fn(&PortKind) -> bool| {
        let ports = top.ports.iter().filter(move |port| wanted(&port.kind));
        ports.map(|port| port.name.as_str()).collect::<Vec<_>>().join(" ")
    };
    let mut text = format!(
        "// clocks | {} | {}\n",
        names(|kind| matches!(kind, PortKind::Input(_))),
        names(|kind| matches!(kind, PortKind::Output(_)))
    );
    for vector in vectors {
        // Writing to a string cannot fail.
        let _ = write!(text, "{}", vector.clocks);
        for value in vector.inputs.iter().chain(&vector.outputs) {
            let _ = write!(text, " {value:x}");
        }
        text.push('\n');
    }
    text
}

/// The test bench; it reads its vectors from a file and ends with an exit status of its own.
pub(crate) fn test_bench(top: &Module, bench: &Bench, clock_mhz: u32) -> String {
    let clock = top.clock().unwrap_or("clock");
    let inputs: Vec<&Port> = ports(top, |kind| matches!(kind, PortKind::Input(_)));
    let outputs: Vec<&Port> = ports(top, |kind| matches!(kind, PortKind::Output(_)));
    let mut text = format!(
        "// Runs {name} on recorded inputs and checks every output after every rising edge.\n//\n\
         //     make sim-{name}\n\n`default_nettype none\n\n\
         module {name}_tb;\n    timeunit 1ns;\n    timeprecision 1ps;\n\n    reg {clock} = 1'b0;\n",
        name = top.name,
    );
    for port in &inputs {
        line(&mut text, &format!("    reg {}{};", range(top, port), port.name));
    }
    for port in &outputs {
        line(&mut text, &format!("    wire {}{};", range(top, port), port.name));
        line(&mut text, &format!("    reg {}expected_{};", range(top, port), port.name));
    }
    let connections = top.ports.iter().map(|port| format!("        .{0}({0})", port.name));
    let connections: Vec<String> = connections.collect();
    line(&mut text, &format!("\n    {} dut (\n{}\n    );\n", top.name, connections.join(",\n")));
    text.push_str(&checks(&outputs));
    text.push_str(&settings(&bench.constants));
    text.push_str(&driver(top, &inputs, &outputs, clock, clock_mhz));
    text
}

fn ports(top: &Module, wanted: fn(&PortKind) -> bool) -> Vec<&Port> {
    top.ports.iter().filter(|port| wanted(&port.kind)).collect()
}

fn range(top: &Module, port: &Port) -> String {
    let width = port.kind.signal().map_or(1, |id| top.signal(id).width);
    if width == 1 { String::new() } else { format!("[{}:0] ", width - 1) }
}

fn line(text: &mut String, line: &str) {
    text.push_str(line);
    text.push('\n');
}

/// A task that names every output that differs.
fn checks(outputs: &[&Port]) -> String {
    let mut text = String::from("    integer wrong = 0;\n\n    task check;\n        begin\n");
    for port in outputs {
        let name = &port.name;
        line(&mut text, &format!("            if ({name} !== expected_{name}) begin"));
        let message = format!("FAIL clock %0d: {name} is %h, expected %h");
        line(
            &mut text,
            &format!(
                "                $display(\"{message}\", clocks_done, {name}, expected_{name});"
            ),
        );
        line(&mut text, "                wrong = wrong + 1;\n            end");
    }
    text.push_str("        end\n    endtask\n\n");
    text
}

/// A task that names every setting that is not what it was to be.
fn settings(constants: &[(String, u64)]) -> String {
    let mut text = String::from("    task check_settings;\n        begin\n");
    for (path, value) in constants {
        line(&mut text, &format!("            if (dut.{path} !== 'h{value:x}) begin"));
        let message = format!("FAIL: {path} is %h, expected {value:x}");
        line(&mut text, &format!("                $display(\"{message}\", dut.{path});"));
        line(&mut text, "                wrong = wrong + 1;\n            end");
    }
    text.push_str("        end\n    endtask\n\n");
    text
}

fn driver(
    top: &Module,
    inputs: &[&Port],
    outputs: &[&Port],
    clock: &str,
    clock_mhz: u32,
) -> String {
    let vectors = format!("test/{}_vectors.txt", top.name);
    let targets = inputs.iter().map(|port| port.name.clone());
    let expected = outputs.iter().map(|port| format!("expected_{}", port.name));
    let targets: Vec<String> = targets.chain(expected).collect();
    let format = format!("%d{}", " %h".repeat(targets.len()));
    let half_ns = 500.0 / f64::from(clock_mhz);
    format!(
        "    integer file;
    integer fields;
    integer clocks;
    integer clocks_done = 0;
    reg [8*512-1:0] heading;

    initial begin
        file = $fopen(\"{vectors}\", \"r\");
        if (file == 0) $fatal(1, \"FAIL: {vectors} cannot be read\");
        fields = $fgets(heading, file);
        #{half_ns:.3} check_settings;
        if (wrong != 0) $fatal(1, \"FAIL: wrong settings\");
        fields = $fscanf(file, \"{format}\", clocks, {list});
        while (fields == {count}) begin
            repeat (clocks) begin
                #{half_ns:.3} {clock} = 1'b1;
                clocks_done = clocks_done + 1;
                #{half_ns:.3} check;
                if (wrong != 0) $fatal(1, \"FAIL after %0d clocks\", clocks_done);
                {clock} = 1'b0;
            end
            fields = $fscanf(file, \"{format}\", clocks, {list});
        end
        if (clocks_done == 0 || !$feof(file)) $fatal(1, \"FAIL: {vectors} is cut off\");
        $display(\"PASS %0d clocks\", clocks_done);
        $finish;
    end
endmodule

`default_nettype wire
",
        list = targets.join(", "),
        count = targets.len() + 1,
    )
}
