//! The emitted Verilog, compiled by Verilator into a program that answers records.

use std::fmt::Write as _;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};

use helixlock_netlist::{Design, Netlist, SignalId};
use tempfile::TempDir;

use super::BATCH;
use super::records::Layout;

/// A compiled simulator, to be started as often as needed.
pub(crate) struct Program {
    /// Keeps the program while it may be started.
    folder: TempDir,
}

impl Program {
    /// Emits and compiles the design.
    pub(crate) fn of(design: &Design, netlist: &Netlist) -> Self {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let top = &design.top().name;
        let mut sources = vec!["public.vlt".to_owned(), "main.cpp".to_owned()];
        for (name, text) in helixlock_gen::verilog(design).expect("legal names") {
            put(folder.path(), &format!("{name}.v"), &text);
            sources.push(format!("{name}.v"));
        }
        put(folder.path(), "public.vlt", &public(design));
        put(folder.path(), "main.cpp", &harness(top, netlist, true));
        Self::build(folder, top, &sources, &[])
    }

    /// Compiles the files of a folder; `main.cpp` among them is the harness.
    pub(crate) fn build(folder: TempDir, top: &str, sources: &[String], options: &[&str]) -> Self {
        let built = Command::new("verilator")
            .args(["--cc", "--exe", "--build", "-O3", "-CFLAGS", "-O2", "--flatten"])
            .args(["--top-module", top, "-o", "simulator"])
            .args(options)
            .args(sources)
            .current_dir(folder.path())
            .output()
            .expect("verilator is installed");
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        Self { folder }
    }

    pub(crate) fn start(&self) -> Process {
        let child = Command::new(self.folder.path().join("obj_dir/simulator"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .expect("the simulator starts");
        Process { child }
    }
}

/// A running simulator.
pub(crate) struct Process {
    child: Child,
}

impl Process {
    /// Sends the inputs of a batch and reads that many bytes of answers.
    pub(crate) fn run(&mut self, inputs: &[u8], answer_bytes: usize) -> Vec<u8> {
        let mut to = self.child.stdin.take().expect("it is piped");
        let from = self.child.stdout.as_mut().expect("it is piped");
        let mut answers = vec![0; answer_bytes];
        // The simulator answers while it reads: writing and reading have to go on together.
        std::thread::scope(|threads| {
            threads.spawn(|| to.write_all(inputs).and_then(|()| to.flush()).expect("it reads on"));
            from.read_exact(&mut answers).expect("an answer to each record");
        });
        self.child.stdin = Some(to);
        answers
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        drop(self.child.stdin.take());
        // It ends at the end of its input.
        let _ = self.child.wait();
    }
}

#[expect(clippy::disallowed_methods, reason = "a test's scratch folder")]
pub(crate) fn put(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("the scratch folder is writable");
}

/// Keeps every flip-flop visible to the harness.
fn public(design: &Design) -> String {
    let mut text = String::from("`verilator_config\n");
    for module in &design.modules {
        for register in &module.registers {
            let name = &module.signal(register.output).name;
            writeln!(text, "public_flat_rd -module \"{}\" -var \"{name}\"", module.name)
                .expect("a string takes everything");
        }
    }
    text
}

/// C++ that reads a record, takes a rising edge, and answers; without flip-flops it shows ports.
pub(crate) fn harness(top: &str, netlist: &Netlist, flip_flops: bool) -> String {
    let layout = Layout::of(netlist);
    let mut text = format!(
        "#include <cstdint>\n#include <cstdio>\n#include \"V{top}.h\"\n#include \"V{top}___024root.h\"\n\n\
         static uint8_t in[{}], out[{}];\nstatic unsigned at;\n\n\
         static uint64_t get(unsigned width) {{\n  uint64_t value = 0;\n  \
         for (unsigned i = 0; i < width; i++, at++) value |= (uint64_t)(in[at >> 3] >> (at & 7) & 1) << i;\n  \
         return value;\n}}\n\n\
         static void put(unsigned width, uint64_t value) {{\n  \
         for (unsigned i = 0; i < width; i++, at++) out[at >> 3] |= (value >> i & 1) << (at & 7);\n}}\n\n\
         int main() {{\n  V{top} top;\n  uint64_t records = 0;\n  top.clock = 0;\n  top.eval();\n  \
         while (fread(in, sizeof in, 1, stdin) == 1) {{\n    at = 0;\n",
        layout.input_bytes(),
        layout.answer_bytes(),
    );
    let path = |id: SignalId| netlist.signal(id).path.as_str();
    for (&id, width) in netlist.inputs.iter().zip(layout.input_widths()) {
        writeln!(text, "    top.{} = get({width});", path(id)).expect("a string takes everything");
    }
    text += "    top.eval();\n    top.clock = 1;\n    top.eval();\n    at = 0;\n    \
             for (unsigned i = 0; i < sizeof out; i++) out[i] = 0;\n";
    let registers = netlist.registers.len();
    for (index, &(id, width)) in layout.answers().iter().enumerate() {
        let value = match (index < registers, flip_flops) {
            (false, _) => format!("top.{}", path(id)),
            (true, true) => format!("top.rootp->{top}__DOT__{}", path(id).replace('.', "__DOT__")),
            (true, false) => "0".to_owned(),
        };
        writeln!(text, "    put({width}, {value});").expect("a string takes everything");
    }
    text + &format!(
        "    fwrite(out, sizeof out, 1, stdout);\n    \
             if (++records % {BATCH} == 0) fflush(stdout);\n    \
             top.clock = 0;\n    top.eval();\n  }}\n  return 0;\n}}\n"
    )
}
