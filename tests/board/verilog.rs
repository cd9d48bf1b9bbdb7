//! Verilog of a bitstream and of a top module, made into one that a program of C++ can hold by its
//! pins.

use std::collections::BTreeSet;

/// Names of the inputs but the clock, and of the outputs.
pub(super) type Ports = (Vec<String>, Vec<String>);

/// Inputs but the clock, and outputs, of Verilog as icebox writes it.
pub(super) fn placed_ports(verilog: &str) -> Ports {
    let head = verilog.split_once('(').and_then(|(_, rest)| rest.split_once(");"));
    let ports = head.expect("a module").0.split([',', '\n']).map(str::trim);
    let (mut inputs, mut outputs) = (vec![], vec![]);
    for port in ports {
        match port.split_once(' ') {
            Some(("input", "clock")) | None => {}
            Some(("input", name)) => inputs.push(name.to_owned()),
            Some((_, name)) => outputs.push(name.to_owned()),
        }
    }
    (inputs, outputs)
}

/// With ports declared after the header, since what follows declares them once more as `reg`, and
/// with the input for faults.
pub(super) fn with_fault(verilog: &str) -> String {
    let (head, body) = verilog.split_once(");").expect("a module");
    let (module, ports) = head.split_once('(').expect("its ports");
    let ports: Vec<&str> = ports.split(',').map(str::trim).collect();
    let names = joined(ports.iter().filter_map(|port| port.split_once(' ')), |(_, name)| {
        format!(", {name}")
    });
    let declared = joined(&ports, |port| format!("{port};\n"));
    format!("{module}(injected{names});\ninput [15:0] injected;\n{declared}{body}")
}

/// With a fault in each look-up table, and their number: with `injected` at the number of a table,
/// from 1, one bit of it is turned over, an answer to one of the up to 16 questions.
pub(super) fn with_weak_tables(verilog: &str) -> (String, u16) {
    let mut number = 0_u16;
    let lines = verilog.lines().map(|line| {
        let Some((target, rest)) = line.split_once(" = /* LUT ") else { return line.to_owned() };
        let Some((place, table)) = rest.split_once("*/ ") else { return line.to_owned() };
        number += 1;
        let table = table.trim_end_matches(';');
        let is_name = |character: char| character.is_ascii_alphanumeric() || character == '_';
        let names: BTreeSet<&str> = table
            .split(|character| !is_name(character))
            .filter(|word| word.starts_with(|first: char| first.is_ascii_alphabetic()))
            .filter(|word| *word != "b0" && *word != "b1")
            .collect();
        let question = joined(names.iter().enumerate(), |(bit, name)| {
            let high = u32::from(number).wrapping_mul(0x9e37_79b9) >> (20 + bit) & 1 == 1;
            format!(" && {}{name}", if high { "" } else { "!" })
        });
        format!("{target} = /* LUT {place}*/ ({table}) ^ (injected == {number}{question});")
    });
    let weak = lines.map(|line| line + "\n").collect();
    (weak, number)
}

/// A text of each, one behind the other.
fn joined<T>(these: impl IntoIterator<Item = T>, text: impl FnMut(T) -> String) -> String {
    these.into_iter().map(text).collect()
}

/// Inputs but the clock, and outputs, of the emitted top module, bit by bit.
pub(super) fn shell_ports(verilog: &str) -> Ports {
    let lines = verilog.lines().map(|line| line.trim().trim_end_matches(','));
    let ports = lines.filter_map(|line| {
        let words: Vec<_> = line.split_ascii_whitespace().collect();
        match words[..] {
            [way @ ("input" | "output"), "wire", name] if name != "clock" => {
                Some((way, vec![name.to_owned()]))
            }
            [way @ ("input" | "output"), "wire", "[1:0]", name] => {
                Some((way, [0, 1].map(|bit| format!("{name}_{bit}")).to_vec()))
            }
            _ => None,
        }
    });
    let ports: Vec<_> = ports.collect();
    let bits = |way: &str| {
        let these = ports.iter().filter(|(other, _)| *other == way);
        these.flat_map(|(_, bits)| bits.iter().cloned()).collect()
    };
    (bits("input"), bits("output"))
}

/// The emitted top module with a port a bit.
pub(super) fn wrapper((inputs, outputs): &Ports) -> String {
    let inputs_text = joined(inputs, |name| format!(", input {name}"));
    let outputs_text = joined(outputs, |name| format!(", output {name}"));
    let single = inputs.iter().chain(outputs).filter(|name| !name.starts_with("calibrate"));
    let singles = joined(single, |name| format!(", .{name}({name})"));
    format!(
        "module placed(input [15:0] injected, input clock{inputs_text}{outputs_text});\n    \
         board_shell shell(.clock(clock), .calibrate({{calibrate_1, calibrate_0}}){singles});\n\
         endmodule\n"
    )
}

/// C++ that holds inputs for a number of clocks, or until an output changes.
pub(super) fn harness((inputs, outputs): &Ports) -> String {
    let set = joined(inputs.iter().enumerate(), |(bit, name)| {
        format!("    top.{name} = ask[0] >> {bit} & 1;\n")
    });
    let get = joined(outputs.iter().enumerate(), |(bit, name)| {
        format!(" | (uint32_t)top.{name} << {bit}")
    });
    format!(
        "#include <cstdint>\n#include <cstdio>\n#include \"Vplaced.h\"\n\n\
         static Vplaced top;\n\nstatic uint32_t levels() {{ return 0{get}; }}\n\n\
         int main() {{\n  uint32_t ask[3], answer[2];\n  \
         while (fread(ask, sizeof ask, 1, stdin) == 1) {{\n{set}    top.injected = ask[2];\n    \
         top.clock = 0;\n    top.eval();\n    answer[0] = 0;\n    answer[1] = levels();\n    \
         for (uint32_t before = answer[1]; answer[0] < ask[1] && before == answer[1];) {{\n      \
         top.clock = 1;\n      top.eval();\n      top.clock = 0;\n      top.eval();\n      \
         answer[0]++;\n      answer[1] = levels();\n    }}\n    \
         fwrite(answer, sizeof answer, 1, stdout);\n    fflush(stdout);\n  }}\n}}\n",
    )
}
