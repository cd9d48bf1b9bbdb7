//! Keys of a sheet; they do not change.

use helixlock_metrology::Conformity;
use helixlock_metrology::uncertainty::{Budget, Contribution};

use super::{Line, Sheet};
use crate::shared::keys::keys;

keys! {
    /// A sheet; infinite degrees of freedom are `null`.
    SheetJson<'a>(sheet: &'a Sheet) {
        missing: &'a [&'static str] = &sheet.missing,
        figures: Vec<LineJson<'a>> = sheet.lines.iter().map(LineJson::new).collect(),
    }

    LineJson<'a>(line: &'a Line) {
        symbol: &'a str = &line.named.symbol,
        key: &'a str = &line.named.key,
        value_um: f64 = line.named.value_um,
        standard_uncertainty_um: Option<f64> = line.budget.as_ref().map(|one| one.standard_um),
        degrees_of_freedom: Option<f64> = line.budget.as_ref().map(|one| one.degrees_of_freedom),
        coverage_factor: Option<f64> = line.budget.as_ref().map(|one| one.coverage_factor),
        expanded_uncertainty_um: Option<f64> = line.budget.as_ref().map(Budget::expanded_um),
        expanded_below_um: Option<f64> = line.budget.as_ref().map(|one| one.below_um),
        expanded_above_um: Option<f64> = line.budget.as_ref().map(|one| one.above_um),
        tolerance_um: Option<f64> = line.tolerance_um,
        conformity: Option<&'static str> = line.conformity().map(Conformity::name),
        budget: Vec<ContributionJson<'a>> = contributions(line.budget.as_ref()),
    }

    ContributionJson<'a>(one: &'a Contribution) {
        quantity: &'a str = &one.source.quantity,
        estimate: f64 = one.source.estimate,
        unit: &'static str = one.source.unit,
        standard_uncertainty: f64 = one.source.standard,
        distribution: &'static str = one.source.distribution.name(),
        degrees_of_freedom: f64 = one.source.degrees_of_freedom,
        sensitivity_um: f64 = one.sensitivity,
        contribution_um: f64 = one.contribution_um,
    }
}

fn contributions(budget: Option<&Budget>) -> Vec<ContributionJson<'_>> {
    budget.iter().flat_map(|one| &one.contributions).map(ContributionJson::new).collect()
}
