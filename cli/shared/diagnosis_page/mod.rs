//! Page of a diagnosis: the verdict, the error falling, before and after, what to do next.

mod pictures;

use helixlock_lab::{
    Diagnosis, FittedEffect, FittedParameter, Problem, Verdict, lines_left, spectra,
};
use helixlock_report::{Page, Part, Table};

use self::pictures::before_and_after;
pub(crate) use self::pictures::{Left, falling};
use crate::shared::far_readings::notes;
use crate::shared::words::{chance, change, doubted, file_says, why_left};

/// The page, with what else is known of the model behind the pictures of the data.
pub(crate) fn page(problem: &Problem, diagnosis: &Diagnosis, more: Vec<Part>) -> Page {
    let spectra = (spectra(problem, diagnosis), lines_left(problem));
    let unit = problem.measurement.unit();
    let mut parts = vec![Part::Numbers(numbers(diagnosis, unit))];
    parts.extend(diagnosis.doubts.iter().map(|doubt| Part::Note(doubted(doubt))));
    parts.extend(diagnosis.residual.iter().map(|left| {
        Part::Note(format!(
            "Left: {} along {}{}, {:.4} {unit} rms, {}.",
            left.shape,
            left.along,
            left.at.map_or(String::new(), |at| format!(" at {at:.4}")),
            left.rms_um,
            why_left(left)
        ))
    }));
    let left: Vec<Left> = diagnosis.rounds.iter().map(Left::from).collect();
    parts.push(falling(&left, unit));
    parts.extend(
        (0..problem.sensors.len()).map(|i| before_and_after(problem, diagnosis, &spectra, i)),
    );
    parts.extend(more);
    parts.extend(next(diagnosis, unit));
    parts.push(Part::Heading("Rounds".into()));
    parts.push(Part::Table(rounds(diagnosis, unit).without_empty_columns()));
    parts.push(Part::Heading("Parameters".into()));
    parts.push(Part::Table(parameters(diagnosis).without_empty_columns()));
    parts.push(Part::Heading("What was tried".into()));
    parts.push(Part::Table(tried(diagnosis, unit).without_empty_columns()));
    let notes =
        notes(&problem.measurement, diagnosis.far_readings.as_ref(), &diagnosis.loud_passes);
    if !notes.is_empty() {
        parts.push(Part::Heading("How the data were read".into()));
    }
    parts.extend(notes.into_iter().map(Part::Text));
    let summary = sentence(diagnosis, unit);
    Page { title: format!("{}: what the model lacked", problem.model.title), summary, parts }
}

/// The verdict in words.
fn sentence(diagnosis: &Diagnosis, unit: &str) -> String {
    let effects = diagnosis.rounds.last().map_or(&[][..], |round| &round.effects);
    let names: Vec<String> = effects.iter().map(described).collect();
    let names = names.join("; ");
    let [before, after] = [diagnosis.rounds.first(), diagnosis.rounds.last()]
        .map(|round| round.map_or(0.0, |round| round.rms_um));
    match diagnosis.verdict {
        Verdict::Explained => format!(
            "The model lacked {names}. With that the error falls from {before:.3} to {after:.3} {unit} rms, and what is left is noise."
        ),
        Verdict::Ambiguous => format!(
            "The data fit {names}, but other effects fit them as well: see what would tell them apart. The error falls from {before:.3} to {after:.3} {unit} rms."
        ),
        Verdict::Unexplained if names.is_empty() => {
            format!("{before:.3} {unit} rms are left that no effect of the catalogue accounts for.")
        }
        Verdict::Unexplained => format!(
            "The model lacked {names}, but something is left that no effect of the catalogue accounts for. The error falls from {before:.3} to {after:.3} {unit} rms."
        ),
        Verdict::NothingMissing => {
            format!("Nothing is missing: what the model leaves, {before:.3} {unit} rms, is noise.")
        }
        Verdict::DoubtfulInput => "The data or the machine file look mistaken: no effect is named, and nothing is added, before that is settled.".to_owned(),
    }
}

/// An effect with its first parameters.
fn described(effect: &FittedEffect) -> String {
    const MOST: usize = 2;
    let value = |parameter: &FittedParameter| {
        let stderr = parameter.stderr.map_or(String::new(), |stderr| format!(" ± {stderr:.3}"));
        format!("{} {:.3}{stderr}", parameter.key, parameter.value)
    };
    let shown: Vec<String> = effect.parameters.iter().take(MOST).map(value).collect();
    if shown.is_empty() {
        effect.name.clone()
    } else {
        format!("{} ({})", effect.name, shown.join(", "))
    }
}

fn numbers(diagnosis: &Diagnosis, unit: &str) -> Vec<(String, String)> {
    let first = diagnosis.rounds.first().map_or(0.0, |round| round.rms_um);
    let last = diagnosis.rounds.last();
    vec![
        (diagnosis.verdict.word().to_owned(), "verdict".to_owned()),
        (format!("{first:.3} {unit}"), "error before, rms".to_owned()),
        (format!("{:.3} {unit}", last.map_or(0.0, |r| r.rms_um)), "error after, rms".to_owned()),
        (
            format!("{:.3} {unit}", last.map_or(0.0, |r| r.holdout_rms_um)),
            "the same on held-out data".to_owned(),
        ),
    ]
}

/// Experiments that would tell rivals apart.
fn next(diagnosis: &Diagnosis, unit: &str) -> Vec<Part> {
    if diagnosis.experiments.is_empty() {
        return Vec::new();
    }
    let size = format!("predictions then differ by, {unit} rms");
    let mut table = Table::new(["experiment", "tells", "from", size.as_str()]);
    for advice in diagnosis.experiments.iter().take(5) {
        table.row([
            advice.action.clone(),
            advice.between.0.clone(),
            advice.between.1.clone(),
            if advice.is_a_run() { format!("{:.3}", advice.separation_um) } else { String::new() },
        ]);
    }
    vec![Part::Heading("What to measure next".into()), Part::Table(table)]
}

fn rounds(diagnosis: &Diagnosis, unit: &str) -> Table {
    let (seen, unseen) = (format!("rms in {unit}"), format!("held out in {unit}"));
    let mut table =
        Table::new(["round", "change", &seen, &unseen, "chance", "tried and not taken"]);
    for round in &diagnosis.rounds {
        let reason = |(effect, why): &(String, String)| format!("{effect}: {why}");
        let rejected: Vec<String> = round.rejected.iter().take(3).map(reason).collect();
        table.row([
            round.round.to_string(),
            change(round.added.as_deref(), &round.dropped),
            format!("{:.4}", round.rms_um),
            format!("{:.4}", round.holdout_rms_um),
            round.p_value.map_or(String::new(), chance),
            rejected.join("; "),
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
                remarks(parameter),
            ]);
        }
    }
    table
}

/// What is to be said of a value.
fn remarks(parameter: &FittedParameter) -> String {
    let warning = parameter.warning.map(str::to_owned);
    file_says(parameter).into_iter().chain(warning).collect::<Vec<_>>().join("; ")
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
            chance(one.p_value),
            one.confounded_with.join(", "),
            one.separate_by.clone().unwrap_or_default(),
        ]);
    }
    table
}
