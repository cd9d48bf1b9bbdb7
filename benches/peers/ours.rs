//! Our engines on the stimulus.

use std::fmt::Write as _;

use std::path::Path;

use anyhow::Context;
use helixlock_plant::MachineFile;
use helixlock_sim::{
    Course, Engine, Interpreter, LANE_WORDS, LANES, Options, Snapshot, device, device_engine,
    device_lanes, simulate, stepped_device,
};

use crate::Run;
use crate::stimulus::{PinEvent, drive, pass};
use crate::table::digits;

/// An engine of ours.
pub(crate) struct Ours {
    pub(crate) name: &'static str,
    /// It gets fewer clocks.
    pub(crate) slow: bool,
    make: fn() -> Box<dyn Engine>,
}

/// All of them.
pub(crate) const ENGINES: &[Ours] = &[
    Ours {
        name: "helixlock, compiled, every clock",
        slow: false,
        make: || Box::new(stepped_device()),
    },
    Ours { name: "helixlock, leap", slow: false, make: || Box::new(device_engine()) },
    Ours {
        name: "helixlock, interpreter",
        slow: true,
        make: || Box::new(Interpreter::new(device().netlist())),
    },
];

/// Runs the stimulus on one engine.
pub(crate) fn run(engine: &Ours, events: &[PinEvent], clocks: u64) -> anyhow::Result<Run> {
    let (mut machine, seconds) = repeated(|| {
        let mut machine = (engine.make)();
        drive(machine.as_mut(), events, clocks);
        machine
    })?;
    Ok(Run { seconds, clocks, state: state_of(machine.as_mut())? })
}

/// What a run leaves, and its processor time, s. The system counts by ticks of some milliseconds: a short
/// run is repeated.
fn repeated<T>(run: impl Fn() -> T) -> anyhow::Result<(T, f64)> {
    let (mut runs, before) = (0.0, processor_seconds()?);
    loop {
        let left = run();
        runs += 1.0;
        let seconds = processor_seconds()? - before;
        if 0.2 < seconds {
            return Ok((left, seconds / runs));
        }
    }
}

/// Every register, in order.
fn state_of(engine: &mut dyn Engine) -> anyhow::Result<String> {
    let mut state = String::new();
    for register in &device().netlist().registers {
        write!(state, "{:x} ", engine.value(register.output))?;
    }
    Ok(state)
}

/// Runs the stimulus on all lanes alike; the time is that of one lane.
pub(crate) fn run_lanes(events: &[PinEvent], clocks: u64) -> anyhow::Result<Run> {
    let netlist = device().netlist();
    let (lanes, seconds) = repeated(|| {
        let mut lanes = device_lanes();
        for event in events.iter().take_while(|event| event.clock < clocks) {
            lanes.run_until(event.clock);
            lanes.set_input(netlist.inputs[event.pin], event.value);
        }
        lanes.run_until(clocks);
        lanes
    })?;
    let seconds = seconds / LANES as f64;
    // Some lane in the middle; the others are alike.
    anyhow::ensure!(lanes.unlike(300) == [0; LANE_WORDS], "the lanes differ");
    let mut single = Interpreter::new(netlist);
    let inputs = single.snapshot().inputs;
    single.restore(&Snapshot { clock: clocks, inputs, flip_flops: lanes.flip_flops(300) });
    Ok(Run { seconds, clocks, state: state_of(&mut single)? })
}

/// What simulating both passes in closed loop took.
struct ClosedLoopRun {
    clocks: [u64; 2],
    seconds: [f64; 2],
}

/// Grinds so much of the 6 mm screw at 15 rpm, without and with the correction.
fn grind(clock_mhz: u32, length_mm: u32) -> anyhow::Result<ClosedLoopRun> {
    let file = MachineFile::read(Path::new("examples/sg7430-6mm/machine.toml"))?
        .with_setting("spindle.speed", "\"15 rpm\"")?
        .with_setting("fpga.clock", &format!("\"{clock_mhz} MHz\""))?
        .with_setting("workpiece.length", &format!("\"{length_mm} mm\""))?;
    let half = Course::new(&file.model, &Options::default())?.clocks() / 2;
    let begin = processor_seconds()?;
    let mut turned = begin;
    let run = simulate(&file.model, &Options::default(), &mut |clocks| {
        if clocks <= half {
            turned = processor_seconds().unwrap_or(f64::NAN);
        }
    })?;
    let seconds = [turned - begin, processor_seconds()? - turned];
    Ok(ClosedLoopRun { clocks: [run.open.clocks, run.closed.clocks], seconds })
}

/// The quickest of so many runs, pass by pass.
fn grind_quickly(clock_mhz: u32, length_mm: u32, rounds: usize) -> anyhow::Result<ClosedLoopRun> {
    let mut best = grind(clock_mhz, length_mm)?;
    for _ in 1..rounds {
        let run = grind(clock_mhz, length_mm)?;
        for (quickest, seconds) in best.seconds.iter_mut().zip(run.seconds) {
            *quickest = quickest.min(seconds);
        }
    }
    Ok(best)
}

/// Whole passes of 1 m at 15 rpm and 12 MHz, plant included, against what the quickest peer would
/// take for their clocks.
pub(crate) fn closed_loop(peer_ns: f64) -> anyhow::Result<String> {
    let run = grind_quickly(12, 1000, crate::ROUNDS)?;
    let mut text = String::from(
        "| 1 m at 15 rpm and 12 MHz, plant included | clocks | s | quickest peer, clocks alone, s | × |\n\
         |---|---:|---:|---:|---:|\n",
    );
    let passes = ["loop open", "loop closed, then played back"];
    for ((pass, clocks), seconds) in passes.into_iter().zip(run.clocks).zip(run.seconds) {
        let peer = peer_ns * 1e-9 * clocks as f64;
        writeln!(
            text,
            "| {pass} | {clocks} | {} | {} | {} |",
            digits(seconds),
            digits(peer),
            digits(peer / seconds)
        )?;
    }
    writeln!(text, "\nThe peer's time is that of the pass above, scaled by the number of clocks.")?;
    Ok(text)
}

/// One second of pins, and 100 mm in closed loop, at clocks a hundred times apart.
pub(crate) fn by_clock_rate() -> anyhow::Result<String> {
    let mut text = String::from(
        "| FPGA clock | clocks in 1 s | pin changes | by leaping, ms | 100 mm in closed loop, ms |\n\
         |---:|---:|---:|---:|---:|\n",
    );
    for clock_mhz in [1_u32, 10, 100] {
        let clocks = u64::from(clock_mhz) * 1_000_000;
        let events = pass(device().netlist(), clocks, 15.0, f64::from(clock_mhz) * 1e6);
        let leap = ENGINES.iter().find(|engine| engine.name.contains("leap"));
        let leap = leap.context("one of our engines leaps")?;
        let mut seconds = f64::INFINITY;
        for _ in 0..crate::ROUNDS {
            seconds = seconds.min(run(leap, &events, clocks)?.seconds);
        }
        let closed = grind_quickly(clock_mhz, 100, crate::ROUNDS)?.seconds[1];
        writeln!(
            text,
            "| {clock_mhz} MHz | {clocks} | {} | {} | {} |",
            events.len(),
            digits(1e3 * seconds),
            digits(1e3 * closed)
        )?;
    }
    Ok(text)
}

/// Processor time this thread has taken, as Linux counts it.
fn processor_seconds() -> anyhow::Result<f64> {
    let path = "/proc/thread-self/schedstat";
    let text = std::fs::read_to_string(path).context(path)?;
    let nanoseconds = text.split(' ').next().context(path)?;
    Ok(nanoseconds.parse::<f64>()? / 1e9)
}
