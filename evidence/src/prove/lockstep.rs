//! One block in Icarus, clock by clock against the reference engine.
//!
//! The engine runs the block on drawn inputs and writes down inputs and outputs; a test bench in
//! Icarus feeds the Verilog the same inputs and compares its outputs before every clock edge.

use std::path::Path;
use std::process::Command;

use anyhow::Context;
use helixlock_netlist::{Library, Netlist, SignalId, elaborate, mask};
use helixlock_rtl::BLOCKS;
use helixlock_sim::{Engine, Interpreter};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::computer::Computer;
use super::consequence::worth;
use super::sniffer::Sniffer;
use super::sources::Sources;
use super::workshop::Workshop;
use crate::tools::{run, write_scratch};

/// A drawn history of a block: what goes in and, by the engine, what comes out.
#[derive(Debug)]
pub struct History {
    block: String,
    inputs: Vec<Port>,
    outputs: Vec<Port>,
    /// A clock a line: inputs, then outputs, in bits.
    lines: Vec<String>,
}

#[derive(Debug)]
pub(super) struct Port {
    pub(super) id: SignalId,
    pub(super) name: String,
    pub(super) width: u32,
}

impl History {
    /// Runs a block for a number of clocks on inputs drawn from a seed.
    ///
    /// # Errors
    ///
    /// When there is no such block.
    pub fn draw(block: &str, clocks: usize, seed: u64) -> anyhow::Result<Self> {
        let card = BLOCKS.iter().find(|card| card.name == block).context("a block of the list")?;
        let netlist = Netlist::new(&elaborate(block, &*(card.build)(), &Library::new())?)?;
        let (inputs, outputs) =
            (ports(&netlist, &netlist.inputs), ports(&netlist, &netlist.outputs));
        let mut engine = Interpreter::new(&netlist);
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut workshop = (block == "board_shell").then(Workshop::default);
        let mut computer = (block == "settings_port").then(Computer::wild);
        let mut sniffer = (block == "logic_analyser").then(Sniffer::default);
        let mut lines = Vec::with_capacity(clocks);
        for clock in 0..clocks {
            for input in &inputs {
                let at_computer = (&mut computer, &mut sniffer, input.name.as_str());
                let level = match (&mut workshop, at_computer) {
                    (Some(workshop), _) => workshop.level(&input.name, clock, &mut random),
                    (_, (Some(computer), _, "received")) => {
                        computer.received(clock, &mut random).into()
                    }
                    (_, (Some(computer), _, "received_byte")) => computer.byte(),
                    (_, (_, Some(sniffer), "received")) => {
                        sniffer.received(clock, &mut random).into()
                    }
                    (_, (_, Some(sniffer), "received_byte")) => sniffer.byte(),
                    _ => next_level(input, engine.value(input.id), clock, &mut random),
                };
                if let Some(sniffer) = sniffer.as_mut().filter(|_| input.name == "clear")
                    && level == 1
                {
                    sniffer.begin();
                }
                engine.set_input(input.id, level);
            }
            let bits = inputs.iter().chain(&outputs).map(|port| {
                format!("{:0width$b}", engine.value(port.id), width = port.width as usize)
            });
            lines.push(bits.collect());
            engine.step();
        }
        Ok(Self { block: block.to_owned(), inputs, outputs, lines })
    }

    /// The first clock at which the Verilog differs, if it does.
    ///
    /// # Errors
    ///
    /// When Icarus cannot be started.
    pub fn first_difference(&self, sources: &Sources) -> anyhow::Result<Option<String>> {
        let folder = tempfile::tempdir()?;
        let (bench, program) = (folder.path().join("bench.v"), folder.path().join("bench.vvp"));
        let history = folder.path().join("history.txt");
        write_scratch(&bench, &self.test_bench(&history))?;
        write_scratch(&history, &self.lines.join("\n"))?;
        let mut compile = Command::new("iverilog");
        compile.args(["-g2005", "-o"]).arg(&program).arg("-y").arg(&sources.verilog).arg(&bench);
        let (content, said) = run(&mut compile, "iverilog")?;
        if !content {
            return Ok(Some(said));
        }
        let (_, said) = run(Command::new("vvp").arg("-n").arg(&program), "iverilog")?;
        Ok(said.lines().find(|line| line.starts_with("DIFFERS")).map(|line| self.report(line)))
    }

    /// First clock and signals of the bench's "DIFFERS 17 0110 0111", and what they are worth.
    fn report(&self, line: &str) -> String {
        let mut words = line.split_whitespace().skip(1);
        let clock = words.next().unwrap_or_default();
        let [mut found, mut expected] = [words.next(), words.next()].map(Option::unwrap_or_default);
        let mut lines = vec![format!("first difference at clock {clock}:")];
        for port in &self.outputs {
            let [theirs, ours] = [&mut found, &mut expected].map(|bits| {
                let (value, rest) =
                    bits.split_at_checked(port.width as usize).unwrap_or((bits, ""));
                *bits = rest;
                value
            });
            if theirs != ours {
                let worth = worth(&format!("{}.{}", self.block, port.name));
                lines.push(format!("  {}: engine {ours}, Verilog {theirs}: {worth}", port.name));
            }
        }
        lines.join("\n")
    }

    fn test_bench(&self, history: &Path) -> String {
        let (ins, outs) = (bits(&self.inputs), bits(&self.outputs));
        let (inputs, outputs) = (names(&self.inputs), names(&self.outputs));
        let pins = self.inputs.iter().chain(&self.outputs);
        let pins: Vec<_> = pins.map(|port| format!(", .{0}({0})", port.name)).collect();
        let pins = pins.concat();
        let lines = self.lines.len();
        [
            "module bench;".to_owned(),
            declare("reg", &self.inputs),
            declare("wire", &self.outputs),
            format!("reg clock; {} dut(.clock(clock){pins});", self.block),
            format!("reg [{}:0] history [1:{lines}];", ins + outs - 1),
            format!("reg [{}:0] expected; integer i;", outs - 1),
            format!("initial begin $readmemb(\"{}\", history); clock = 0;", history.display()),
            format!("for (i = 1; i <= {lines}; i = i + 1) begin"),
            format!("{{{inputs}, expected}} = history[i]; #1"),
            format!("if ({{{outputs}}} !== expected) begin"),
            format!("$display(\"DIFFERS %0d %b %b\", i, {{{outputs}}}, expected);"),
            "$finish; end clock = 1; #1 clock = 0; end end endmodule".to_owned(),
        ]
        .join("\n")
    }
}

pub(super) fn ports(netlist: &Netlist, ids: &[SignalId]) -> Vec<Port> {
    let port = |id: &SignalId| {
        let signal = netlist.signal(*id);
        Port { id: *id, name: signal.path.clone(), width: signal.width }
    };
    ids.iter().map(port).collect()
}

pub(super) fn bits(ports: &[Port]) -> u32 {
    ports.iter().map(|port| port.width).sum()
}

pub(super) fn names(ports: &[Port]) -> String {
    ports.iter().map(|port| port.name.as_str()).collect::<Vec<_>>().join(", ")
}

pub(super) fn declare(kind: &str, ports: &[Port]) -> String {
    let declare = |port: &Port| format!("{kind} [{}:0] {};", port.width - 1, port.name);
    ports.iter().map(declare).collect::<Vec<_>>().join(" ")
}

/// Clocks without a reset, so that what power-up left behind shows before the first.
const UNTOUCHED: usize = 4000;

/// What an input does next: wheels are turned now and then and to small numbers, switches thrown
/// seldom, resets are rare, and pulses come in bursts of changing density.
#[expect(clippy::too_many_lines, reason = "a list of inputs")]
fn next_level(input: &Port, now: u64, clock: usize, random: &mut ChaCha8Rng) -> u64 {
    let mut one_in = |n: u32| random.random_range(0..n) == 0;
    let seldom = clock > 0 && !one_in(512);
    match input.name.as_str() {
        "telemetry_byte" if one_in(3) => 0,
        "data" | "telemetry_byte" | "memory_data" => random.random_range(0..=mask(input.width)),
        "count" if input.width > 1 => random.random_range(0..=mask(input.width)),
        "probes" if one_in(3) => random.random_range(0..=mask(input.width)),
        "ready" => u64::from(!one_in(3)),
        "send" | "telemetry_send" | "take" | "level" => u64::from(one_in(3)),
        "at_rest" => u64::from(!one_in(4)),
        "stop" => u64::from(one_in(4096)),
        "clear" | "master_reset" => {
            u64::from(UNTOUCHED <= clock && (clock < UNTOUCHED + 4 || one_in(4096)))
        }
        "divide_a"
        | "divide_b"
        | "preset"
        | "initial_phase"
        | "compensation"
        | "built_divide_a"
        | "built_divide_b"
        | "built_initial_phase"
        | "built_compensation"
            if !seldom =>
        {
            wheel(input, random)
        }
        "step_period" | "period" | "bit_clocks" | "ticks" | "limit" if !seldom => {
            random.random_range(1..12)
        }
        "measuring" => u64::from(!one_in(2048)),
        "start" | "enable" => u64::from(clock > 8 && !one_in(2048)),
        "calibrate"
        | "tick_period"
        | "rate"
        | "megahertz"
        | "ticks_rest"
        | "built_step_period"
        | "range_x2"
        | "insert"
        | "correct"
        | "playback"
        | "manual_enable"
        | "hold"
        | "correcting"
        | "compensation_insert"
        | "built_range_x2"
        | "built_compensation_insert"
        | "active_low"
        | "wrap_watched"
        | "fault"
        | "alarm"
        | "count_forward"
            if !seldom =>
        {
            random.random_range(0..=mask(input.width))
        }
        "forward" | "manual_forward" | "automatic_forward" if one_in(6000) || clock == 0 => 1 - now,
        "grating" | "laser" | "pulse" | "count" | "step" | "request" | "tick" | "divided"
        | "line" | "fringe" | "opening" | "shutting" | "pin" | "manual_step" | "half" | "meter"
        | "standard" => {
            let density = 2 + u32::try_from(clock / 700 % 5).unwrap_or(0);
            u64::from(one_in(density))
        }
        _ => now,
    }
}

/// A number on thumb wheels: often a small one, so that it is reached.
fn wheel(input: &Port, random: &mut ChaCha8Rng) -> u64 {
    let digits = input.width / 4;
    let shown = if input.width == 16 || random.random_range(0..4) > 0 { 1 } else { digits };
    let number = (0..shown).fold(0, |number, _| number << 4 | random.random_range(0..10));
    // Four digits are F/1000: 1 to 3, for a burst of a few thousand pulses to reach it.
    if input.width == 16 { 1 + number % 3 } else { number }
}
