//! The report of `helixlock sim`: lead error before and after, then what the device did.

use helixlock_plant::Machine;
use helixlock_report::{Band, Colour, Page, Panel, Part, Series, Style, Table};
use helixlock_sim::{Simulation, Trace, illustrate};

use super::summary::{PassSummary, Summary};
use super::waveforms::{calibration_picture, comparison_picture};
use crate::shared::page_pieces::{panel, picture, points};

/// What the report of 1977 promises of periodic and cumulative error, µm.
const PROMISED_UM: f64 = 1.0;

/// What errors are drawn over.
const POSITION: &str = "position in mm";

/// Comparisons drawn singly, to show the hunting.
const HUNTING_SHOWN: usize = 60;

/// The page.
pub(crate) fn page(
    machine: &Machine,
    simulation: &Simulation,
    summary: &Summary,
) -> anyhow::Result<Page> {
    let illustrations = illustrate(machine, &simulation.course)?;
    let clock_hz = simulation.course.clock_hz();
    let mut parts = vec![Part::Numbers(numbers(summary))];
    parts.extend(summary.notes.iter().cloned().map(Part::Note));
    parts.extend([
        picture(lead_error(simulation), LEAD_CAPTION),
        Part::Table(table(summary)),
        Part::Heading("Recorder, steps and hunting".into()),
        picture(recorder(simulation), RECORDER_CAPTION),
        picture(vec![hunting(simulation)], HUNTING_CAPTION),
        Part::Heading("Wave-forms of the simulated device".into()),
        Part::Picture {
            svg: comparison_picture(&illustrations.comparison, clock_hz),
            caption: COMPARISON_CAPTION.into(),
        },
        Part::Picture {
            svg: calibration_picture(&illustrations.calibration, clock_hz),
            caption: CALIBRATION_CAPTION.into(),
        },
    ]);
    Ok(Page { title: summary.heading(), summary: sentence(summary), parts })
}

const LEAD_CAPTION: &str = "Lead error of the finished thread, positive when it is longer than \
    nominal: without the correction, and with it on a scale of its own; shaded, ±0.5 µm.";

const RECORDER_CAPTION: &str = "What the instruments show. Recorder behind its low-pass, positive \
    when the laser lags the grating; net steps of the motor with the loop closed.";

const HUNTING_CAPTION: &str = "Raw recorder in the middle of the pass, one reading a comparison, \
    loop closed: the loop hunts about zero at half the comparison frequency.";

const COMPARISON_CAPTION: &str = "Figures 3 and 16 from the simulation. The grating sets T1, the \
    laser clears it; what outlasts the standard square wave clocks Q to forward (CP1), what falls \
    short of it to reverse (CP2). For the eye, the table of this run swings by an eighth of the \
    range; a real error is a few thousandths of it.";

const CALIBRATION_CAPTION: &str = "Figure 12 from the simulation. Calibration puts 180° on T1 and \
    T2, then 45° less: 135°, three eighths of the time high, never 225°.";

fn sentence(summary: &Summary) -> String {
    let run = &summary.run;
    let slower = if summary.slew.limited {
        " The motor is too slow for the error of this machine."
    } else {
        ""
    };
    format!(
        "{:.0} mm ground in {:.0} s, without and with the correction, {} clocks at {} MHz.{slower}",
        run.length_mm,
        run.duration_s,
        run.clocks,
        simulated_mhz(run.clock_hz),
    )
}

#[expect(clippy::cast_precision_loss, reason = "a clock is far below 2⁵³ Hz")]
fn simulated_mhz(clock_hz: u64) -> f64 {
    clock_hz as f64 / 1e6
}

fn numbers(summary: &Summary) -> Vec<(String, String)> {
    let change = |before: f64, after: f64| format!("{before:.1} → {after:.2} µm");
    let (before, after) = (&summary.without_correction, &summary.with_correction);
    let mut numbers = vec![
        (
            change(before.periodic_error_um, after.periodic_error_um),
            "periodic error, peak to peak".to_owned(),
        ),
        (
            change(before.cumulative_error_um, after.cumulative_error_um),
            "cumulative error, peak to peak".to_owned(),
        ),
        (after.steps_taken.to_string(), format!("steps taken, net {}", after.steps_net)),
    ];
    if let Some(hunting) = &summary.hunting {
        numbers.push((
            format!("{:.2} Hz", hunting.frequency_hz),
            format!("hunting, {:.2} of the comparison frequency", hunting.ratio),
        ));
    }
    numbers
}

fn table(summary: &Summary) -> Table {
    let (before, after) = (&summary.without_correction, &summary.with_correction);
    let mut table = Table::new(["quantity", "without correction", "with correction"]);
    let mut row = |name: &str, value: fn(&PassSummary) -> String| {
        table.row([name.to_owned(), value(before), value(after)]);
    };
    row("periodic lead error, peak to peak, µm", |pass| format!("{:.3}", pass.periodic_error_um));
    row("cumulative lead error, peak to peak, µm", |pass| {
        format!("{:.3}", pass.cumulative_error_um)
    });
    row("lead error in all, peak to peak, µm", |pass| {
        format!("{:.3}", pass.lead_error_peak_to_peak_um)
    });
    row("recorder, peak to peak, µm", |pass| format!("{:.3}", pass.recorder_peak_to_peak_um));
    row("times the recorder jumped by its range", |pass| pass.recorder_jumps.to_string());
    row("steps taken", |pass| pass.steps_taken.to_string());
    row("net steps at the end", |pass| pass.steps_net.to_string());
    if let Some(hunting) = &summary.hunting {
        let found = format!("{:.3} (due {:.3})", hunting.swing_um, hunting.expected_swing_um);
        table.row(["swing of the hunting, µm".to_owned(), String::new(), found]);
    }
    let slew = &summary.slew;
    table.row([
        "fastest error, and fastest correction, µm/s".to_owned(),
        format!("{:.3}", slew.needed_um_per_s),
        format!("{:.3}", slew.limit_um_per_s),
    ]);
    if let Some(playback) = &summary.playback {
        let took = format!("{} in {:.1} s", playback.steps, playback.duration_s);
        table.row(["steps played back after the pass".to_owned(), String::new(), took]);
    }
    table
}

fn lead_error(simulation: &Simulation) -> Vec<Panel> {
    let (open, closed) = (&simulation.open.trace, &simulation.closed.trace);
    let before = Series::new(
        "without correction",
        Colour::Orange,
        Style::Line,
        points(&open.position_mm, &open.lead_error_um),
    );
    let after = Series::new(
        "with correction",
        Colour::Blue,
        Style::Line,
        points(&closed.position_mm, &closed.lead_error_um),
    );
    let mut corrected = panel("With correction", POSITION, "lead error in µm", vec![after.clone()]);
    let half_um = PROMISED_UM / 2.0;
    corrected.bands.push(Band::Y { range: [-half_um, half_um], colour: Colour::Green });
    vec![
        panel("Without and with correction", POSITION, "lead error in µm", vec![before, after]),
        corrected,
    ]
}

fn recorder(simulation: &Simulation) -> Vec<Panel> {
    let (open, closed) = (&simulation.open.trace, &simulation.closed.trace);
    let line = |name: &str, colour, trace: &Trace, values: &[f64]| {
        Series::new(name, colour, Style::Line, points(&trace.position_mm, values))
    };
    #[expect(clippy::cast_precision_loss, reason = "the counter holds 4095 steps")]
    let steps: Vec<f64> = closed.steps.iter().map(|steps| *steps as f64).collect();
    let shown = vec![
        line("without correction", Colour::Orange, open, &open.filtered_error_um),
        line("with correction", Colour::Blue, closed, &closed.filtered_error_um),
    ];
    vec![
        panel("Recorder", POSITION, "error in µm", shown),
        panel("Counter", POSITION, "net steps", vec![line("", Colour::Blue, closed, &steps)]),
    ]
}

fn hunting(simulation: &Simulation) -> Panel {
    let trace = &simulation.closed.trace;
    let first = (trace.time_s.len() / 2).saturating_sub(HUNTING_SHOWN / 2);
    let last = (first + HUNTING_SHOWN).min(trace.time_s.len());
    let series = Series::new(
        "",
        Colour::Blue,
        Style::Step,
        points(&trace.time_s[first..last], &trace.error_um[first..last]),
    );
    panel("Hunting", "time in s", "recorder, raw, in µm", vec![series])
}
