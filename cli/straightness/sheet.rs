//! The straightness of a bar on a sheet, with its uncertainty.

use helixlock_metrology::straightness::{drawn_straightness_um, straightness_uncertainty_um};
use helixlock_metrology::uncertainty::{Acts, Distribution, Source, Told};

use super::evaluation::{Evaluation, Outcome};
use crate::shared::sheet::{Named, Sheet, SheetFile, ZEROS};

/// Of the bars that are drawn.
const SEED: u64 = 1;

/// The sheet of the method that counts.
pub(super) fn sheet_of(mut file: SheetFile, found: &Evaluation) -> anyhow::Result<Sheet> {
    let named = figures(found.chosen());
    let values_um: Vec<f64> = named.iter().map(|figure| figure.value_um).collect();
    if !found.zeros_matched {
        file.missing.push("the bar's parabola, which needs `--zeros-matched`");
    }
    let mut sources = std::mem::take(&mut file.sources);
    for source in &mut sources {
        source.acts = Acts::OnFigures(match source.acts {
            // A millionth of every height, and so of their differences.
            Acts::OnLengths(_) => values_um.iter().map(|um| um * 1e-6).collect(),
            _ if source.quantity == ZEROS => vec![found.plan.zero_offset_gain; values_um.len()],
            // A difference of two heights, each the mean of the runs.
            _ => vec![(2.0 / runs(found)).sqrt(); values_um.len()],
        });
    }
    let separated = &found.chosen().separated;
    let drawn_um = drawn_straightness_um(separated, SEED);
    let each_um = drawn_um.as_deref().and_then(|all| straightness_uncertainty_um(separated, all));
    match (each_um, found.combined.sigma_um) {
        (Some(each), Some(sigma_um)) if 0.0 < sigma_um => sources.push(Source {
            quantity: "noise of the probes, and what they cannot see".into(),
            estimate: 0.0,
            unit: "um",
            standard: sigma_um,
            distribution: Distribution::Normal,
            degrees_of_freedom: f64::INFINITY,
            acts: Acts::AsDrawn(each.map(|um| um / sigma_um).into()),
        }),
        _ => file.missing.push("the noise of the probes, which needs several runs"),
    }
    let told = Told::new(values_um, drawn_um.iter().flatten().map(|each| each.to_vec()).collect());
    Sheet::new(file, named, &told, &sources)
}

#[expect(clippy::cast_precision_loss, reason = "runs are few")]
fn runs(found: &Evaluation) -> f64 {
    found.repeats.max(1) as f64
}

fn figures(chosen: &Outcome) -> Vec<Named> {
    let lines = &chosen.workpiece;
    let each = [
        ("by the least-squares line", "least_squares", lines.least_squares),
        ("by the end points", "end_points", lines.end_points),
        ("minimum zone", "minimum_zone", lines.minimum_zone),
    ];
    let named = each.map(|(meaning, key, line)| Named {
        symbol: "STR".into(),
        key: key.into(),
        meaning: format!("straightness, {meaning}"),
        value_um: line.error_um,
    });
    named.into()
}
