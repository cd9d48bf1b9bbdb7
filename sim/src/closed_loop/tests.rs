//! The real device against a machine simple enough to be worked out by hand.

use helixlock_rtl::settings::{Range, Settings};

use super::appraisal::measure_hunting;
use super::feedback::ClosedLoop;
use super::pass::{Pass, PassPlan, run_pass};
use super::probe::{Probe, Watch, Waveform, signals_of};
use super::swing::{Progress, Swing};
use super::waveform_file::write_vcd;
use crate::device::{device, device_engine, set_wheels, stepped_device};
use crate::engine::Engine;

const CLOCK_HZ: f64 = 12e6;

/// The 6 mm screw at 6 rpm: lines of 6 mm / 13906, fringes of 22/69.53 µm, exactly commensurate.
const MACHINE: Swing = Swing {
    speed_um_per_s: 600.0,
    line_um: 6000.0 / 13906.0,
    fringe_um: 22.0 / 69.53,
    amplitude_um: 0.0,
    period_s: 1.0,
    step_um: 0.0125,
    begin_s: 0.1, // the initial phase is selected by then, which takes 150 fringes
    progress: Progress::START,
};

const FULL_SCALE_UM: f64 = 300.0 * 22.0 / 69.53;

fn run(machine: Swing, correct: bool, end_s: f64) -> Pass {
    run_on(device_engine(), machine, correct, end_s, None)
}

/// A pass with the loop closed, and the pieces of what `probe` looks at.
fn watched(
    engine: impl Engine,
    machine: Swing,
    end_s: f64,
    probe: &Probe,
) -> (Pass, Vec<Waveform>) {
    let mut pieces = Vec::new();
    let mut seen = |piece: &Waveform| {
        pieces.push(piece.clone());
        Ok(())
    };
    let watch = Watch { probe, seen: &mut seen };
    let pass = run_on(engine, machine, true, end_s, Some(watch));
    (pass, pieces)
}

fn whole(pieces: &[Waveform]) -> Waveform {
    let mut whole = pieces[0].clone();
    for piece in &pieces[1..] {
        whole.changes.extend_from_slice(&piece.changes);
        whole.analogue.extend_from_slice(&piece.analogue);
    }
    whole
}

fn run_on(
    mut engine: impl Engine,
    machine: Swing,
    correct: bool,
    end_s: f64,
    watch: Option<Watch<'_>>,
) -> Pass {
    let settings = Settings {
        a: 110,
        b: 150,
        range: Range::X2,
        initial_phase: 150,
        compensation_f: 0,
        insert: false,
        step_period: 75_000, // 160 Hz
    };
    set_wheels(&mut engine, &settings).unwrap();
    let plan = PassPlan {
        clock_hz: CLOCK_HZ,
        end_s,
        full_scale_um: FULL_SCALE_UM,
        cutoff_hz: None,
        correct,
        playback_s: correct.then_some(30.0),
    };
    run_pass(engine, machine, plan, watch, &mut |_| {}).unwrap()
}

#[test]
fn the_open_loop_shows_the_lag_of_the_table() {
    let machine = Swing { amplitude_um: 10.0, period_s: 3.0, ..MACHINE };
    let pass = run(machine, false, 4.0);
    assert!(pass.trace.time_s.len() > 20, "{}", pass.trace.time_s.len());
    // The grating starts up to a line late, which is a constant.
    let differences: Vec<f64> = pass
        .trace
        .error_um
        .iter()
        .zip(&pass.trace.lead_error_um)
        .map(|(shown_um, lead_um)| shown_um + lead_um)
        .collect();
    let first_um = differences[0];
    assert!(first_um.abs() < 0.44, "{first_um}");
    for difference_um in differences {
        assert!((difference_um - first_um).abs() < 0.001, "{difference_um} after {first_um}");
    }
}

#[test]
fn the_closed_loop_hunts_at_half_the_comparison_frequency() {
    // Without any error, 180° is met to the clock and the motor is never asked to move.
    let machine = Swing { amplitude_um: 1.0, period_s: 40.0, ..MACHINE };
    let pass = run(machine, true, 8.0);
    let swing_um = 160.0 * 0.0125 / (13906.0 * 0.1 / 220.0);
    let hunting = measure_hunting(&pass.trace.time_s, &pass.trace.error_um, swing_um).unwrap();
    assert!((hunting.frequency_hz / hunting.comparison_hz - 0.5).abs() < 0.02, "{hunting:?}");
    assert!((hunting.swing_um - swing_um).abs() < 0.02, "{hunting:?}");
}

#[test]
fn the_closed_loop_follows_and_goes_home() {
    let machine = Swing { amplitude_um: 3.0, period_s: 20.0, ..MACHINE };
    let pass = run(machine, true, 16.0);
    let lead_um = &pass.trace.lead_error_um[4..];
    let largest_um = lead_um.iter().fold(0.0_f64, |largest, error| largest.max(error.abs()));
    assert!(largest_um < 0.7, "{largest_um}");
    let most = pass.trace.steps.iter().max().unwrap();
    assert!((220..270).contains(most), "3 µm are 240 steps forward: {most}");
    let playback = pass.playback.unwrap();
    assert_eq!(playback.left, 0);
    assert_eq!(playback.steps, pass.steps_net.unsigned_abs());
}

/// Every signal of the device, from the end of the initial phase selection on.
#[test]
fn the_leaping_waveform_is_the_stepped_one() {
    let machine = Swing { amplitude_um: 3.0, period_s: 1.0, ..MACHINE };
    let signals = signals_of(device().netlist(), &["all".into()]).unwrap();
    let probe = Probe { signals, window: 945_000..970_000 };
    let (leap, leapt) = watched(device_engine(), machine, 0.5, &probe);
    let (stepped, looked_at) = watched(stepped_device(), machine, 0.5, &probe);
    assert_eq!(leap.trace, stepped.trace);
    assert!(3 <= leapt.len(), "in pieces, so that memory does not grow with the window");
    let (leap, stepped) = (whole(&leapt), whole(&looked_at));
    assert_eq!(leap.changes, stepped.changes);
    assert_eq!(leap.analogue, stepped.analogue);
    assert!(25_000 < leap.changes.len(), "the step clock counts at every clock");
}

/// What the dump says at each clock is what the waveform holds.
#[test]
fn the_dump_reads_back_as_the_waveform() {
    use helixlock_traces::Tick;
    use vcd::{Command, Parser, Value};

    let signals = signals_of(device().netlist(), &["top".into(), "divider_a".into()]).unwrap();
    let probe = Probe { signals, window: 940_000..4_000_000 };
    let waveform = whole(&watched(device_engine(), MACHINE, 0.4, &probe).1);
    let mut text = Vec::new();
    write_vcd(&mut text, &waveform, 12_000_000).unwrap();

    let mut dump = Parser::new(&text[..]);
    let header = dump.parse_header().unwrap();
    let code = |path: &str| {
        let names: Vec<&str> = ["device"].into_iter().chain(path.split('.')).collect();
        header.find_var(&names).unwrap_or_else(|| panic!("{path}")).code
    };
    let codes: Vec<_> = waveform.signals.iter().map(|(path, _)| code(path)).collect();
    let mut found = std::collections::BTreeSet::new();
    let mut time = 0;
    for command in dump {
        match command.unwrap() {
            Command::Timestamp(now) => time = now,
            Command::ChangeScalar(code, value) => {
                found.insert((time, code, u64::from(value == Value::V1)));
            }
            Command::ChangeVector(code, bits) => {
                let value = bits.iter().fold(0, |v, bit| 2 * v + u64::from(bit == Value::V1));
                found.insert((time, code, value));
            }
            _ => {}
        }
    }
    let due: std::collections::BTreeSet<_> = waveform
        .changes
        .iter()
        .map(|c| (Tick::PICOSECOND.of_clock(c.clock, 12_000_000), codes[c.signal], c.value))
        .collect();
    assert_eq!(found, due);
}

/// Half a second of a machine that swings, looked at in a window with every signal there is.
fn waveform(engine: impl Engine) -> Vec<u8> {
    let swing = Swing {
        speed_um_per_s: 1500.0,
        line_um: 0.43,
        fringe_um: 0.316,
        amplitude_um: 5.0,
        period_s: 0.4,
        step_um: 0.0125,
        begin_s: 0.0,
        progress: Progress::START,
    };
    let clock_hz = 1e6;
    let mut device = ClosedLoop::new(engine, swing, clock_hz, 3.0).unwrap();
    let pins = device.pins();
    let netlist = device.engine().netlist().clone();
    for (path, value) in [
        ("divide_a", 0x007),
        ("divide_b", 0x009),
        ("range_x2", 1),
        ("initial_phase", 0x009),
        ("compensation", 0x0001),
        ("step_period", 1009),
    ] {
        device.engine().set_input(netlist.find(path).unwrap(), value);
    }
    device.engine().set_input(pins.start, 1);
    device.engine().set_input(pins.correct, 1);
    device.set_moving().unwrap();
    device.run_until(480_000, |_| false).unwrap();
    let signals = signals_of(&netlist, &["all".to_owned()]).unwrap();
    device.begin_recording(Probe { signals, window: 480_000..500_000 });
    device.run_until(500_000, |_| false).unwrap();
    let mut bytes = Vec::new();
    write_vcd(&mut bytes, &device.end_recording().unwrap(), 1_000_000).unwrap();
    bytes
}

#[test]
fn the_waveform_of_a_leap_is_that_of_stepping_byte_by_byte() {
    let stepped = waveform(stepped_device());
    assert!(100_000 < stepped.len(), "something has been recorded");
    assert!(waveform(device_engine()) == stepped);
}
