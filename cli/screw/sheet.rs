//! The figures of a screw on a sheet, with their uncertainty.

use anyhow::bail;
use helixlock_metrology::screw::{Characteristic, Curve, Estimate};
use helixlock_metrology::uncertainty::{Acts, Added, Distribution, Readings, Source};

use crate::shared::sheet::{FROM_READING_TO_READING, Named, Sheet, SheetFile};

/// A screw under evaluation.
pub(super) struct Measured<'a> {
    pub(super) curve: &'a Curve,
    /// Evaluates a curve.
    pub(super) evaluate: &'a dyn Fn(&Curve) -> Vec<Characteristic>,
}

impl Readings for Measured<'_> {
    /// A screw is read at too many places to change each on its own: what acts there is told of the
    /// figures themselves.
    fn places(&self) -> usize {
        0
    }

    fn readings(&self) -> usize {
        0
    }

    fn figures_um(&self, added: Added) -> Vec<f64> {
        let Added::ToLengths(um_per_m) = added else {
            return sizes(&(self.evaluate)(self.curve));
        };
        sizes(&(self.evaluate)(&self.curve.stretched(um_per_m)))
    }
}

fn sizes(characteristics: &[Characteristic]) -> Vec<f64> {
    characteristics.iter().filter_map(|one| Some(one.reached.ok()?.value_um)).collect()
}

/// The name of a characteristic in plain letters, as a key.
pub(super) fn key(symbol: &str) -> String {
    symbol.to_lowercase().replace('δ', "delta_").replace('π', "pi")
}

/// Takes the noise of readings out of the file: it is taken off the figures by itself.
pub(super) fn reading_noise_um(
    file: &mut SheetFile,
    told_um: Option<f64>,
) -> anyhow::Result<Option<f64>> {
    let index = file.sources.iter().position(|one| one.quantity == FROM_READING_TO_READING);
    let in_file = index.map(|index| file.sources.remove(index).standard).filter(|um| 0.0 < *um);
    if in_file.is_some() && told_um.is_some() {
        bail!("`--reading-noise` and `at_each_reading` of the sheet, expected one of them");
    }
    Ok(in_file.or(told_um))
}

/// The sheet: each figure without the noise of readings where that is known.
///
/// What acts from place to place or varies with time changes a difference of two places by √2.
pub(super) fn sheet_of(
    mut file: SheetFile,
    measured: &Measured<'_>,
    estimates: &[Option<Estimate>],
    noise_um: Option<f64>,
) -> anyhow::Result<Sheet> {
    let characteristics = (measured.evaluate)(measured.curve);
    let reached = || characteristics.iter().zip(estimates).filter(|(one, _)| one.reached.is_ok());
    let named = reached().map(|(one, estimate)| Named {
        symbol: one.symbol.into(),
        key: key(one.symbol),
        meaning: one.meaning.into(),
        value_um: match (one.reached, estimate) {
            (Ok(found), Some(estimate)) if noise_um.is_some() => {
                estimate.size_um.copysign(found.value_um)
            }
            (Ok(found), _) => found.value_um,
            (Err(_), _) => f64::NAN,
        },
    });
    let named: Vec<Named> = named.collect();
    let mut sources = std::mem::take(&mut file.sources);
    for source in &mut sources {
        if let Acts::AtEachPlace(um) | Acts::AtEachReading(um) | Acts::AsTimeGoes(um) = source.acts
        {
            source.acts = Acts::OnFigures(vec![um * 2.0_f64.sqrt(); named.len()]);
        }
    }
    if let Some(noise_um) = noise_um {
        let each =
            reached().map(|(_, known)| known.map_or(0.0, |one| one.uncertainty_um / noise_um));
        sources.push(Source {
            quantity: FROM_READING_TO_READING.into(),
            estimate: 0.0,
            unit: "um",
            standard: noise_um,
            distribution: Distribution::Normal,
            degrees_of_freedom: f64::INFINITY,
            acts: Acts::OnFigures(each.collect()),
        });
    }
    Sheet::new(file, named, measured, &sources)
}

/// What is known of each characteristic by the budget of its figure; as before where there is none.
pub(super) fn with_budgets(
    sheet: &Sheet,
    characteristics: &[Characteristic],
    estimates: Vec<Option<Estimate>>,
) -> Vec<Option<Estimate>> {
    let mut lines = sheet.lines.iter();
    let each = characteristics.iter().zip(estimates).map(|(one, estimate)| {
        let line = one.reached.ok().and_then(|_| lines.next())?;
        let Some(budget) = &line.budget else { return estimate };
        let size_um = line.named.value_um.abs();
        Some(Estimate { size_um, uncertainty_um: budget.standard_um })
    });
    each.collect()
}
