//! A sheet that a laboratory can sign: figures, their uncertainty by a budget, and what that proves.

mod file;
mod json;
mod named;
mod page;
mod reader;

use helixlock_metrology::uncertainty::{Budget, Readings, Source, budgets};
use helixlock_metrology::{Conformity, conformity};

use crate::shared::words;

pub(crate) use file::{FROM_READING_TO_READING, SheetFile, Subject, ZEROS};
pub(crate) use json::SheetJson;
pub(crate) use named::Named;
pub(crate) use page::parts;

/// A figure on the sheet.
pub(crate) struct Line {
    /// What it is.
    pub(crate) named: Named,
    /// Its uncertainty, when all that contributes was told.
    pub(crate) budget: Option<Budget>,
    /// What it may be at most, µm.
    pub(crate) tolerance_um: Option<f64>,
    /// True when a file told of the measurement, so that a tolerance is proven or not.
    told: bool,
}

/// A sheet.
pub(crate) struct Sheet {
    /// What is printed above the figures; without a text, a field to fill in.
    pub(crate) head: Vec<(&'static str, Option<String>)>,
    /// The figures.
    pub(crate) lines: Vec<Line>,
    /// What was not told, so that there is no uncertainty.
    pub(crate) missing: Vec<&'static str>,
}

impl Line {
    /// Decision by ISO 14253-1; absent without a tolerance or an uncertainty.
    pub(crate) fn conformity(&self) -> Option<Conformity> {
        let (tolerance_um, budget) = (self.tolerance_um?, self.budget.as_ref()?);
        let value_um = self.named.value_um;
        let mut ends_um = [budget.below_um, budget.above_um];
        if value_um < 0.0 {
            ends_um.reverse();
        }
        Some(conformity(value_um.abs(), tolerance_um, ends_um))
    }

    /// True when the tolerance is kept; proven so where the uncertainty is known or was asked for.
    pub(crate) fn holds(&self) -> bool {
        let asked = self.told && self.tolerance_um.is_some();
        self.conformity().map_or(!asked && self.is_kept(), |found| found == Conformity::Proven)
    }

    /// True when the figure as read is within its tolerance.
    fn is_kept(&self) -> bool {
        self.tolerance_um.is_none_or(|most| self.named.value_um.abs() <= most)
    }

    /// What is said of the tolerance.
    fn verdict(&self) -> String {
        match self.conformity() {
            Some(decision) => format!("by ISO 14253-1: conformity {}", decision.name()),
            None if self.told => self.decision().into(),
            None => words::held(self.is_kept()).into(),
        }
    }

    /// The decision in words.
    pub(crate) fn decision(&self) -> &'static str {
        match (self.tolerance_um, self.conformity()) {
            (None, _) => "",
            (Some(_), Some(Conformity::Proven)) => "conforms",
            (Some(_), Some(Conformity::Disproven)) => "does not conform",
            (Some(_), Some(Conformity::Open)) => "no decision: within U of the tolerance",
            (Some(_), None) if self.is_kept() => "kept, without U: nothing is proven",
            (Some(_), None) => "exceeded, without U: nothing is proven",
        }
    }
}

impl Sheet {
    /// Figures with what the file says of them; `sources` is what it tells of the measurement.
    pub(crate) fn new(
        file: SheetFile,
        named: Vec<Named>,
        readings: &dyn Readings,
        sources: &[Source],
    ) -> anyhow::Result<Self> {
        file.only_figures(&named)?;
        let budgets = if file.missing.is_empty() { budgets(readings, sources) } else { Vec::new() };
        let mut budgets = budgets.into_iter();
        let line = |named: Named| Line {
            tolerance_um: file.tolerance_um(&named.key),
            budget: budgets.next(),
            told: file.told,
            named,
        };
        let lines = named.into_iter().map(line).collect();
        Ok(Self { lines, head: file.head, missing: file.missing })
    }

    /// True when every tolerance is kept, and proven to be where a file told of the measurement.
    pub(crate) fn holds(&self) -> bool {
        self.lines.iter().all(Line::holds)
    }

    /// True when anything is held against a tolerance.
    pub(crate) fn decides(&self) -> bool {
        self.lines.iter().any(|line| line.tolerance_um.is_some())
    }

    /// The figures in words, a line each, and then the decisions.
    pub(crate) fn words(&self) -> Vec<String> {
        let decision = |line: &Line| {
            let most_um = line.tolerance_um?;
            Some(format!("{}: limit {most_um} µm {}", line.named.symbol, line.verdict()))
        };
        let figures = self.lines.iter().map(in_words);
        figures.chain(self.lines.iter().filter_map(decision)).collect()
    }

    /// Why there is no uncertainty, when there is none.
    pub(crate) fn why_without(&self) -> Option<String> {
        let told = self.missing.is_empty();
        (!told).then(|| {
            format!("no uncertainty is given: nothing is told of {}", self.missing.join(", "))
        })
    }
}

/// How far below and above the figure the true one may be.
fn both_sides(budget: &Budget) -> String {
    format!("{:+.3} {:+.3}", -budget.below_um, budget.above_um)
}

fn in_words(line: &Line) -> String {
    let Named { symbol, meaning, value_um, .. } = &line.named;
    let uncertainty = line.budget.as_ref().map_or_else(String::new, |budget| {
        format!("   U = {} µm (k = {:.2})", both_sides(budget), budget.coverage_factor)
    });
    format!("{symbol:<6} {meaning:<38} {value_um:9.3} µm{uncertainty}")
}
