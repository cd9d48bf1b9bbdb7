//! Pictures of a diagnosis: the error falling, the model on the data, before and after.

use helixlock_lab::{Diagnosis, NamedLine, Problem, Round, sensor_column};
use helixlock_report::{Axis, Colour, Label, Panel, Part, Series, Style};

use crate::shared::page_pieces::{panel, picture};
use crate::shared::residual_picture::{points, x_axis};
use crate::shared::spectrum;
use crate::shared::words::change;

/// Samples shown closely: few enough that dots and curve stay apart.
const CLOSE: usize = 150;

/// Spectra of each sensor, and the lines that are named in them.
pub(crate) type Spectra = (Vec<helixlock_lab::Spectra>, Vec<NamedLine>);

/// What a round's model leaves.
pub(crate) struct Left {
    /// What it did to the model.
    pub(crate) change: String,
    /// Root mean square, µm (arcsec).
    pub(crate) rms_um: f64,
    /// The same on held-out data.
    pub(crate) holdout_rms_um: f64,
}

impl From<&Round> for Left {
    fn from(round: &Round) -> Self {
        let Round { rms_um, holdout_rms_um, .. } = *round;
        Self { change: change(round.added.as_deref(), &round.dropped), rms_um, holdout_rms_um }
    }
}

/// The error of each round's model.
pub(crate) fn falling(rounds: &[Left], unit: &str) -> Part {
    let all = rounds;
    let rounds = || (0_u32..).map(f64::from).zip(all);
    let series = |name, colour, style, value: fn(&Left) -> f64| {
        Series::new(name, colour, style, rounds().map(|(n, round)| [n, value(round)]))
    };
    let series = vec![
        series("", Colour::Blue, Style::Line, |round| round.rms_um),
        series("on the data", Colour::Blue, Style::Dots, |round| round.rms_um),
        series("on held-out data", Colour::Orange, Style::Dots, |round| round.holdout_rms_um),
    ];
    let highest = rounds().map(|(_, round)| round.rms_um.max(round.holdout_rms_um));
    let highest = highest.fold(f64::MIN_POSITIVE, f64::max);
    let last = rounds().last().map_or(0.0, |(n, _)| n);
    let mut panel = panel("The error falls", "round", &format!("left, rms in {unit}"), series);
    panel.x = Axis::counts("round").between(-0.5, last + 0.5);
    panel.y = panel.y.between(0.0, 1.2 * highest);
    panel.labels = rounds()
        .map(|(n, round)| Label {
            at: [n, round.rms_um.max(round.holdout_rms_um) + 0.04 * highest],
            text: round.change.clone(),
        })
        .collect();
    let rises = all.windows(2).any(|pair| pair[0].rms_um < pair[1].rms_um);
    let hidden = if rises {
        " Two effects that hide each other are found together; the first of them alone leaves more."
    } else {
        ""
    };
    picture(vec![panel], &format!("What each round's model leaves of the measurement.{hidden}"))
}

/// Measured and model, residual before and after, spectrum before and after, of one sensor.
pub(crate) fn before_and_after(
    problem: &Problem,
    diagnosis: &Diagnosis,
    spectra: &Spectra,
    sensor: usize,
) -> Part {
    let unit = problem.measurement.unit();
    let after = &diagnosis.left;
    let model = |left: &[f64]| -> Vec<f64> {
        problem.observed.iter().zip(left).map(|(observed, left)| observed - left).collect()
    };
    let (old, new) = (model(&diagnosis.before), model(after));
    let line = |name, colour, style, values: &[f64]| {
        Series::new(name, colour, style, points(problem, sensor, values))
    };
    let over = || {
        vec![
            line("measured", Colour::Orange, Style::Dots, &problem.observed),
            line("learned model", Colour::Blue, Style::Line, &new),
        ]
    };
    let mut close = over();
    close.push(line("the file's model", Colour::Grey, Style::Dashes, &old));
    let close = close.into_iter().map(first_of).collect();
    let left = vec![
        line("before", Colour::Orange, Style::Line, &diagnosis.before),
        line("after", Colour::Blue, Style::Line, after),
    ];
    let column = sensor_column(problem.sensors[sensor], problem.measurement.rotary);
    let axis = x_axis(problem);
    let panels = vec![
        panel(&format!("{column}, measured and model"), axis, unit, over()),
        panel("The same closely, its beginning", axis, unit, close),
        panel("Residual", axis, unit, left),
        spectrum(problem, spectra, sensor),
    ];
    picture(
        panels,
        "Each pass about its own zero. A line of the spectrum that the machine file cannot name \
         carries a question mark.",
    )
}

/// The beginning of the first pass.
fn first_of(mut series: Series) -> Series {
    let end = series.points.iter().position(|point| point[0].is_nan());
    series.points.truncate(end.unwrap_or(series.points.len()).min(CLOSE));
    series
}

fn spectrum(problem: &Problem, (sensors, lines): &Spectra, sensor: usize) -> Panel {
    let line = |name, colour, points: &[[f64; 2]]| {
        Series::new(name, colour, Style::Line, points.iter().copied())
    };
    let series = vec![
        line("before", Colour::Orange, &sensors[sensor].before),
        line("after", Colour::Blue, &sensors[sensor].after),
    ];
    let unit = format!("amplitude in {}", problem.measurement.unit());
    let panel = panel("Order spectrum of the residual", "", &unit, series);
    spectrum::named(panel, lines, sensor, problem.model.rotary)
}
