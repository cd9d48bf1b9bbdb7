//! Figures 3, 12 and 16 of document 1, drawn from what the simulated device did.

use helixlock_report as report;
use helixlock_report::Arrow;
use helixlock_sim::Waveform;

/// How a lane is called in the picture, and in the netlist.
const COMPARISON: &[(&str, &str)] = &[
    ("grating ÷A", "grating_divided"),
    ("laser ÷B", "laser_divided"),
    ("T1", "t1"),
    ("T2", "t2"),
    ("standard", "standard"),
    ("CP1", "cp1"),
    ("CP2", "cp2"),
    ("Q", "q"),
    ("Q̄", "q_bar"),
    ("step", "step"),
];

const CALIBRATION: &[(&str, &str)] = &[("grating", "grating"), ("T1", "t1"), ("T2", "t2")];

/// A pulse of one clock is drawn this part of the picture wide, so that it can be seen.
const VISIBLE_PULSE: f64 = 0.002;

/// Figures 3 and 16; arrows lead from the divided pulses to the meter.
pub(crate) fn comparison_picture(waveform: &Waveform, clock_hz: f64) -> String {
    let mut picture = picture(waveform, clock_hz, COMPARISON);
    let (grating, laser, meter) = (0, 1, 2);
    let causes = [grating, laser].map(|lane| (lane, rising(&picture.lanes[lane])));
    for (lane, times) in causes {
        let arrow = |time| Arrow { from: (lane, time), to: (meter, time) };
        picture.arrows.extend(times.into_iter().take(2).map(arrow));
    }
    picture.svg()
}

/// Figure 12.
pub(crate) fn calibration_picture(waveform: &Waveform, clock_hz: f64) -> String {
    let mut picture = picture(waveform, clock_hz, CALIBRATION);
    let switched = changes(waveform, "calibrate").nth(1);
    if let Some((clock, _)) = switched {
        picture.marks = vec![
            (picture.range[0], "180°".to_owned()),
            (time_ms(waveform, clock, clock_hz), "135°".to_owned()),
        ];
    }
    picture.svg()
}

fn picture(waveform: &Waveform, clock_hz: f64, lanes: &[(&str, &str)]) -> report::Waveform {
    let end_ms = time_ms(waveform, waveform.window.end, clock_hz);
    let lane = |&(name, signal): &(&str, &str)| {
        let widened = widened(changes(waveform, signal), waveform, clock_hz, end_ms);
        report::Lane::Bit { name: name.to_owned(), changes: widened }
    };
    report::Waveform {
        width_px: 900,
        time_label: "time in ms".into(),
        range: [0.0, end_ms],
        lanes: lanes.iter().map(lane).collect(),
        arrows: Vec::new(),
        marks: Vec::new(),
    }
}

/// Changes of a one-bit signal, a pulse never narrower than the eye sees.
fn widened(
    changes: impl Iterator<Item = (u64, u64)>,
    waveform: &Waveform,
    clock_hz: f64,
    end_ms: f64,
) -> Vec<(f64, Option<bool>)> {
    let mut drawn: Vec<(f64, Option<bool>)> = Vec::new();
    for (clock, value) in changes {
        let time = time_ms(waveform, clock, clock_hz);
        let earliest = drawn.last().map_or(time, |(last, _)| last + VISIBLE_PULSE * end_ms);
        let ends_a_pulse = drawn.last().is_some_and(|(_, level)| *level == Some(true));
        drawn.push((if ends_a_pulse { time.max(earliest) } else { time }, Some(value == 1)));
    }
    drawn
}

fn changes<'a>(waveform: &'a Waveform, signal: &str) -> impl Iterator<Item = (u64, u64)> + 'a {
    let index = waveform.signals.iter().position(|(path, _)| path == signal);
    let changes = waveform.changes.iter();
    changes.filter(move |c| Some(c.signal) == index).map(|change| (change.clock, change.value))
}

fn rising(lane: &report::Lane) -> Vec<f64> {
    match lane {
        report::Lane::Bit { changes, .. } => {
            let rises = changes.iter().filter(|(_, level)| *level == Some(true));
            rises.map(|(time, _)| *time).collect()
        }
        _ => Vec::new(),
    }
}

#[expect(clippy::cast_precision_loss, reason = "clock numbers stay below 2⁵³")]
fn time_ms(waveform: &Waveform, clock: u64, clock_hz: f64) -> f64 {
    (clock - waveform.window.start) as f64 / clock_hz * 1e3
}
