//! What leaping over clocks could get wrong, one case after the other: the waveform with every
//! signal of the device must be that of stepping, byte by byte.

use helixlock_netlist::SignalId;

use crate::closed_loop::{Analogue, Probe, Recording, signals_of, write_vcd};
use crate::device::{device, device_engine, stepped_device};
use crate::engine::{Dice, Engine, Snapshot};

/// Clocks of a run.
const CLOCKS: u64 = 1500;

/// When which pin takes which value; in order of the clocks.
type Script = Vec<(u64, &'static str, u64)>;

const ANALOGUE: Analogue =
    Analogue { clock: 0, position_mm: 0.0, lead_error_um: 0.0, correction_um: 0.0, error_um: 0.0 };

/// Small dividers, a quick step clock, the loop correcting.
fn begin() -> Script {
    [
        ("divide_a", 0x003),
        ("divide_b", 0x004),
        ("initial_phase", 0x002),
        ("compensation", 0x0001),
        ("step_period", 37),
        ("start", 1),
        ("correct", 1),
    ]
    .map(|(pin, value)| (0, pin, value))
    .into()
}

/// Pulses of a pin: `high` clocks at the beginning of every `period`, from clock `first` on.
fn pulses(script: &mut Script, pin: &'static str, first: u64, [high, period]: [u64; 2]) {
    for clock in (first..CLOCKS).step_by(usize::try_from(period).unwrap()) {
        script.extend([(clock, pin, 1), (clock + high, pin, 0)]);
    }
}

fn lines_and_fringes(script: &mut Script, lag: u64) {
    pulses(script, "grating", 20, [9, 24]);
    pulses(script, "laser", 20 + lag, [8, 18]);
}

/// Runs a script, looking at every signal whenever the engine stops: at changes when it `leaps`,
/// else at every clock.
fn run(mut engine: impl Engine, script: &Script, leaps: bool) -> (Vec<u8>, Snapshot) {
    let netlist = device().netlist();
    let signals = signals_of(netlist, &["all".to_owned()]).unwrap();
    engine.watch(&signals);
    let mut script = script.clone();
    script.sort_by_key(|(clock, ..)| *clock);
    let mut script = script.into_iter().peekable();
    let mut recording = Recording::new(netlist, Probe { signals, window: 0..CLOCKS });
    while engine.clock() < CLOCKS {
        let clock = engine.clock();
        while let Some((_, pin, value)) = script.next_if(|(due, ..)| *due <= clock) {
            engine.set_input(netlist.find(pin).unwrap(), value);
        }
        assert!(recording.sample(&mut engine, Analogue { clock, ..ANALOGUE }));
        let due = script.peek().map_or(CLOCKS, |(due, ..)| (*due).min(CLOCKS));
        engine.run_until(if leaps { due } else { clock + 1 });
    }
    let mut bytes = Vec::new();
    write_vcd(&mut bytes, &recording.waveform, 1_000_000).unwrap();
    (bytes, engine.snapshot())
}

fn assert_leaping_is_stepping(script: &Script) {
    let leapt = run(device_engine(), script, true);
    let stepped = run(stepped_device(), script, false);
    assert_eq!(leapt.1, stepped.1, "{script:?}");
    assert!(leapt.0 == stepped.0, "waveforms differ: {script:?}");
}

/// The clocks at which all the signals are high when a script is stepped.
fn clocks_of(script: &Script, paths: &[&str]) -> Vec<u64> {
    let netlist = device().netlist();
    let signals: Vec<SignalId> = paths.iter().map(|path| netlist.find(path).unwrap()).collect();
    let mut engine = stepped_device();
    let mut found = Vec::new();
    let mut script = script.clone();
    script.sort_by_key(|(clock, ..)| *clock);
    let mut script = script.into_iter().peekable();
    for clock in 0..CLOCKS {
        while let Some((_, pin, value)) = script.next_if(|(due, ..)| *due <= clock) {
            engine.set_input(netlist.find(pin).unwrap(), value);
        }
        if signals.iter().all(|signal| engine.value(*signal) == 1) {
            found.push(clock);
        }
        engine.step();
    }
    found
}

#[test]
fn coincidences() {
    let mut met = 0;
    for lag in 0..18 {
        let mut script = begin();
        lines_and_fringes(&mut script, lag);
        met += clocks_of(&script, &["grating_input.rising", "laser_input.rising"]).len();
        assert_leaping_is_stepping(&script);
    }
    assert!(50 < met, "lines and fringes came together {met} times only");
}

/// The step clock's period is turned, up and down and to nothing, about the clock of its reload;
/// the presets of the dividers are turned below what has been counted.
#[test]
fn prescaler_reload() {
    let mut script = begin();
    lines_and_fringes(&mut script, 5);
    let ticks = clocks_of(&script, &["step_clock.tick"]);
    let tick = *ticks.iter().find(|tick| 500 < **tick).unwrap();
    for around in tick - 3..=tick + 3 {
        for period in [0, 1, 2, 36, 38, 0x00ff_ffff] {
            let mut turned = script.clone();
            turned.extend([(around, "step_period", period), (around + 400, "step_period", 11)]);
            turned.extend([(around + 7, "divide_a", 0x001), (around + 31, "divide_b", 0x121)]);
            turned.extend([(around + 9, "compensation", 0), (around + 300, "compensation", 2)]);
            assert_leaping_is_stepping(&turned);
        }
    }
}

/// Pulses and gaps of one to three clocks, which the two flip-flops have not passed on yet when the
/// next one comes.
#[test]
fn pulse_while_the_synchroniser_is_busy() {
    let mut dice = Dice(7);
    for _ in 0..20 {
        let mut script = begin();
        for pin in ["grating", "laser", "manual_step", "start"] {
            let mut clock = 20;
            let mut level = u64::from(pin == "start");
            while clock < CLOCKS {
                level ^= 1;
                script.push((clock, pin, level));
                let rests = dice.below(if pin == "start" { 3 } else { 12 }) == 0;
                clock += 1 + if rests { dice.below(200) } else { dice.below(3) };
            }
        }
        assert_leaping_is_stepping(&script);
    }
}

/// Master reset for one clock, at every clock from before a step to after the windings have moved.
#[test]
fn reset_in_mid_step() {
    let mut script = begin();
    lines_and_fringes(&mut script, 5);
    let steps = clocks_of(&script, &["step"]);
    let step = *steps.iter().find(|step| 500 < **step).unwrap();
    for clock in step - 4..=step + 4 {
        for (pin, length) in [("master_reset", 1), ("master_reset", 30), ("playback", 50)] {
            let mut reset = script.clone();
            reset.extend([(clock, pin, 1), (clock + length, pin, 0)]);
            assert_leaping_is_stepping(&reset);
        }
    }
}
