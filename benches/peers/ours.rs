//! Our engines on the stimulus.

use std::fmt::Write as _;

use std::path::Path;

use anyhow::Context;
use helixlock_plant::MachineFile;
use helixlock_sim::{
    Engine, Interpreter, LANE_WORDS, LANES, Options, Snapshot, device, device_engine, device_lanes,
    simulate, stepped_device,
};

use crate::Run;
use crate::stimulus::{PinEvent, drive, pass};

/// An engine of ours.
pub(crate) struct Ours {
    pub(crate) name: &'static str,
    /// It gets fewer clocks.
    pub(crate) slow: bool,
    make: fn() -> Box<dyn Engine>,
}

/// All of them.
pub(crate) const ENGINES: &[Ours] = &[
    Ours { name: "helixlock leap", slow: false, make: || Box::new(device_engine()) },
    Ours { name: "helixlock compiled", slow: false, make: || Box::new(stepped_device()) },
    Ours {
        name: "helixlock interpreter",
        slow: true,
        make: || Box::new(Interpreter::new(device().netlist())),
    },
];

/// Runs the stimulus on one engine.
pub(crate) fn run(engine: &Ours, events: &[PinEvent], clocks: u64) -> anyhow::Result<Run> {
    let mut machine: Box<dyn Engine>;
    let mut runs = 0.0;
    let before = processor_seconds()?;
    let mut seconds;
    // The system counts by ticks of some milliseconds: a short run is repeated.
    loop {
        machine = (engine.make)();
        drive(machine.as_mut(), events, clocks);
        runs += 1.0;
        seconds = processor_seconds()? - before;
        if 0.2 < seconds {
            break;
        }
    }
    let seconds = seconds / runs;
    Ok(Run { seconds, clocks, state: state_of(machine.as_mut())? })
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
    let mut lanes = device_lanes();
    let before = processor_seconds()?;
    for event in events.iter().take_while(|event| event.clock < clocks) {
        lanes.run_until(event.clock);
        lanes.set_input(netlist.inputs[event.pin], event.value);
    }
    lanes.run_until(clocks);
    let seconds = (processor_seconds()? - before) / LANES as f64;
    // Some lane in the middle; the others are alike.
    anyhow::ensure!(lanes.unlike(300) == [0; LANE_WORDS], "the lanes differ");
    let mut single = Interpreter::new(netlist);
    let inputs = single.snapshot().inputs;
    single.restore(&Snapshot { clock: clocks, inputs, flip_flops: lanes.flip_flops(300) });
    Ok(Run { seconds, clocks, state: state_of(&mut single)? })
}

/// A whole pass of 1 m at 15 rpm and 12 MHz in closed loop, plant and both loops included, against
/// what the reference peer would take for its clocks.
pub(crate) fn closed_loop(reference_ns: f64) -> anyhow::Result<String> {
    let path = Path::new("examples/sg7430-6mm/machine.toml");
    let file = MachineFile::read(path)?.with_setting("spindle.speed", "\"15 rpm\"")?;
    let file = file.with_setting("workpiece.length", "\"1000 mm\"")?;
    let before = processor_seconds()?;
    let run = simulate(&file.machine, &Options::default(), &mut |_| {})?;
    let seconds = processor_seconds()? - before;
    let clocks = run.open.clocks + run.closed.clocks;
    let reference = reference_ns * 1e-9 * clocks as f64;
    Ok(format!(
        "1 m at 15 rpm and 12 MHz, loop open and loop closed, plant included: {clocks} clocks in \
         {seconds:.2} s;\n{} would take {reference:.0} s for the clocks alone (scaled from the \
         table): {:.0} times as long\n",
        crate::table::REFERENCE,
        reference / seconds
    ))
}

/// One second of grinding at 15 rpm, at clocks a hundred times apart.
pub(crate) fn by_clock_rate() -> String {
    let mut text = String::from("one second of grinding at 15 rpm, leaping\n");
    for clock_mhz in [1_u32, 10, 100] {
        let clocks = u64::from(clock_mhz) * 1_000_000;
        let events = pass(device().netlist(), clocks, 15.0, f64::from(clock_mhz) * 1e6);
        let seconds = (0..5)
            .filter_map(|_| run(&ENGINES[0], &events, clocks).ok())
            .map(|run| run.seconds)
            .fold(f64::INFINITY, f64::min);
        // Writing into a string does not fail.
        let _ = writeln!(
            text,
            "{clock_mhz:>4} MHz  {:>9} clocks  {:>6} pin changes  {:>7.3} ms",
            clocks,
            events.len(),
            1e3 * seconds
        );
    }
    text
}

/// Processor time this thread has taken, as Linux counts it.
fn processor_seconds() -> anyhow::Result<f64> {
    let path = "/proc/thread-self/schedstat";
    let text = std::fs::read_to_string(path).context(path)?;
    let nanoseconds = text.split(' ').next().context(path)?;
    Ok(nanoseconds.parse::<f64>()? / 1e9)
}
