//! Report of `helixlock learn`: the error falling round by round, before and after.

use helixlock_lab::diagnosis::{Diagnosis, Verdict};
use helixlock_lab::lines::LineSearch;
use helixlock_lab::problem::Problem;
use helixlock_report::{Colour, Figure, Page, Part, Series, Style, Table};

use crate::pages::compare::{panel, points, x_axis};

/// The page.
pub(crate) fn page(title: &str, problem: &Problem, diagnosis: &Diagnosis) -> Page {
    let unit = problem.measurement.unit();
    let mut parts = vec![Part::Numbers(numbers(diagnosis, unit)), falling(diagnosis, unit)];
    for sensor in 0..problem.sensors.len() {
        parts.push(Part::Picture {
            svg: before_and_after(problem, diagnosis, sensor).svg(),
            caption: "Measured and model over each other, each pass about its own zero; what the file's model leaves and what the learned one leaves; both spectra.".into(),
        });
    }
    parts.push(Part::Heading("Rounds".into()));
    parts.push(Part::Table(rounds(diagnosis, unit)));
    parts.push(Part::Heading("Parameters".into()));
    parts.push(Part::Table(parameters(diagnosis)));
    parts.push(Part::Heading("What was tried".into()));
    parts.push(Part::Table(tried(diagnosis, unit)));
    for left in &diagnosis.residual {
        parts.push(Part::Note(format!(
            "left: {} along {}, {:.4} {unit} rms, p = {:.1e}",
            left.shape, left.along, left.rms_um, left.p_value
        )));
    }
    parts.extend(problem.measurement.notes.iter().cloned().map(Part::Note));
    Page { title: format!("{title}: what the model lacked"), summary: sentence(diagnosis), parts }
}

fn sentence(diagnosis: &Diagnosis) -> String {
    let names: Vec<&str> = diagnosis
        .rounds
        .last()
        .map(|round| round.effects.iter().map(|effect| effect.name.as_str()).collect())
        .unwrap_or_default();
    match diagnosis.verdict {
        Verdict::Explained => {
            format!("Explained by {}: what is left is noise.", names.join(" and "))
        }
        Verdict::Ambiguous => format!(
            "Ambiguous: {} fits, but other effects fit as well; see what would tell them apart.",
            names.join(" and ")
        ),
        Verdict::Unexplained => {
            "Unexplained: structure is left that no effect of the catalogue accounts for.".into()
        }
        Verdict::NothingMissing => "Nothing is missing: the model leaves nothing but noise.".into(),
    }
}

fn numbers(diagnosis: &Diagnosis, unit: &str) -> Vec<(String, String)> {
    let first = diagnosis.rounds.first().map_or(0.0, |round| round.rms_um);
    let last = diagnosis.rounds.last();
    vec![
        (diagnosis.verdict.word().to_owned(), "verdict".to_owned()),
        (format!("{first:.3} {unit}"), "error before, rms".to_owned()),
        (format!("{:.3} {unit}", last.map_or(0.0, |r| r.rms_um)), "error after".to_owned()),
        (
            format!("{:.3} {unit}", last.map_or(0.0, |r| r.holdout_rms_um)),
            "on held-out data".to_owned(),
        ),
    ]
}

fn falling(diagnosis: &Diagnosis, unit: &str) -> Part {
    let line = |name, colour, value: fn(&helixlock_lab::diagnosis::Round) -> f64| {
        let points =
            (0_u32..).zip(&diagnosis.rounds).map(|(n, round)| [f64::from(n), value(round)]);
        Series::new(name, colour, Style::Line, points)
    };
    let series = vec![
        line("seen", Colour::Orange, |round| round.rms_um),
        line("held out", Colour::Blue, |round| round.holdout_rms_um),
    ];
    let panel = panel("the error falls", "round".into(), &format!("rms in {unit}"), series);
    Part::Picture {
        svg: Figure { width_px: 900, panels: vec![panel] }.svg(),
        caption: "Root mean square of what each round's model leaves.".into(),
    }
}

fn before_and_after(problem: &Problem, diagnosis: &Diagnosis, sensor: usize) -> Figure {
    let unit = problem.measurement.unit();
    let model: Vec<f64> = problem
        .observed
        .iter()
        .zip(&diagnosis.state.fit.left)
        .map(|(observed, left)| observed - left)
        .collect();
    let over = vec![
        Series::new(
            "measured",
            Colour::Orange,
            Style::Line,
            points(problem, sensor, &problem.observed),
        ),
        Series::new("learned model", Colour::Blue, Style::Line, points(problem, sensor, &model)),
    ];
    let left = vec![
        Series::new(
            "before",
            Colour::Orange,
            Style::Line,
            points(problem, sensor, &diagnosis.before),
        ),
        Series::new(
            "after",
            Colour::Blue,
            Style::Line,
            points(problem, sensor, &diagnosis.state.fit.left),
        ),
    ];
    let turns: Vec<f64> = problem.record.turns().collect();
    let spectrum = |name, colour, values: &[f64]| {
        let mut fit = diagnosis.state.fit.clone();
        fit.left = values.to_vec();
        let search = LineSearch { problem, fit: &fit, sensor, coordinate: &turns };
        let points = search.spectrum().into_iter().map(|p| [p.frequency, p.amplitude]);
        Series::new(name, colour, Style::Line, points)
    };
    let spectra = vec![
        spectrum("before", Colour::Orange, &diagnosis.before),
        spectrum("after", Colour::Blue, &diagnosis.state.fit.left),
    ];
    Figure {
        width_px: 900,
        panels: vec![
            panel("measured and model", x_axis(problem), unit, over),
            panel("residual", x_axis(problem), unit, left),
            panel("order spectrum of the residual", "cycles a spindle turn".into(), unit, spectra),
        ],
    }
}

fn rounds(diagnosis: &Diagnosis, unit: &str) -> Table {
    let (seen, unseen) = (format!("rms in {unit}"), format!("held out in {unit}"));
    let mut table =
        Table::new(["round", "added", seen.as_str(), unseen.as_str(), "chance", "dropped"]);
    for round in &diagnosis.rounds {
        table.row([
            round.round.to_string(),
            round.added.clone().unwrap_or_else(|| "the file's model".into()),
            format!("{:.4}", round.rms_um),
            format!("{:.4}", round.holdout_rms_um),
            round.p_value.map_or(String::new(), |p| format!("{p:.1e}")),
            round.dropped.join(", "),
        ]);
    }
    table
}

fn parameters(diagnosis: &Diagnosis) -> Table {
    let mut table = Table::new(["effect", "parameter", "value", "standard error", ""]);
    for effect in diagnosis.rounds.last().map(|round| round.effects.as_slice()).unwrap_or_default()
    {
        for parameter in &effect.parameters {
            table.row([
                effect.name.clone(),
                parameter.key.clone(),
                format!("{:.5}", parameter.value),
                parameter.stderr.map_or("from a list".into(), |stderr| format!("{stderr:.5}")),
                parameter.warning.unwrap_or_default().to_owned(),
            ]);
        }
    }
    table
}

fn tried(diagnosis: &Diagnosis, unit: &str) -> Table {
    let (seen, unseen) = (format!("rms in {unit}"), format!("held out in {unit}"));
    let mut table = Table::new([
        "effect",
        "in the model",
        seen.as_str(),
        unseen.as_str(),
        "chance",
        "cannot be told from",
        "to tell them apart",
    ]);
    for one in &diagnosis.candidates {
        table.row([
            one.name.clone(),
            if one.accepted { "yes" } else { "" }.to_owned(),
            format!("{:.4}", one.rms_um),
            format!("{:.4}", one.holdout_rms_um),
            format!("{:.1e}", one.p_value),
            one.confounded_with.join(", "),
            one.separate_by.clone().unwrap_or_default(),
        ]);
    }
    table
}
