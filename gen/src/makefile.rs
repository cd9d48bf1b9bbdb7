//! The Makefile of a project.

use std::fmt::Write as _;

use crate::Board;
use crate::flow::{Step, flow};

/// Makefile with the targets `all`, `prog`, `sim`, `lint`, `clean`.
pub(crate) fn makefile(top: &str, sources: &[String], board: &Board) -> String {
    let steps = flow(top, sources, board);
    let mut text = format!(
        "# {title}: make, make prog, make sim, make lint\n\
         #\n\
         # Debian packages: yosys nextpnr-ice40 fpga-icestorm fpga-icestorm-chipdb;\n\
         # iverilog for sim, verilator for lint\n\n\
         SOURCES := {sources}\n\n\
         .PHONY: all prog sim lint clean\n\n\
         all: build/{top}.bin build/{top}.timing\n",
        title = board.title,
        sources = sources.join(" \\\n    "),
    );
    for step in &steps {
        rule(&mut text, step, board, sources);
    }
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "\nprog: build/{top}.bin\n\t{program} $<\n\n\
         sim: test/{top}_tb.sv test/vectors.txt $(SOURCES)\n\
         \t@mkdir -p build\n\
         \tiverilog -g2012 -Wall -Wno-timescale -s {top}_tb -o build/{top}_tb test/{top}_tb.sv $(SOURCES)\n\
         \tvvp -n build/{top}_tb\n\n\
         lint: $(SOURCES)\n\
         \tverilator --lint-only -Wall --top-module {top} $(SOURCES)\n\n\
         clean:\n\trm -rf build\n",
        program = board.program,
    );
    text
}

fn rule(text: &mut String, step: &Step, board: &Board, sources: &[String]) {
    let needs = match &step.needs {
        None => "$(SOURCES)".to_owned(),
        Some(made) if step.arguments.contains(&board.file) => format!("{made} {}", board.file),
        Some(made) => made.clone(),
    };
    let all = sources.join(" ");
    let words: Vec<String> = step
        .arguments
        .iter()
        .map(|word| if word.contains(' ') { format!("\"{word}\"") } else { word.clone() })
        .collect();
    let arguments = words.join(" ").replace(&all, "$(SOURCES)");
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "\n{}: {needs}\n\t@mkdir -p build\n\t{} {arguments}\n",
        step.product, step.tool
    );
}
