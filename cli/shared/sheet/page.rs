//! A sheet as parts of a page.

use helixlock_metrology::uncertainty::{Budget, Contribution};
use helixlock_report::{Part, Table};

use super::{Line, Sheet, both_sides};

/// Head, figures, budgets, and room for signatures.
pub(crate) fn parts(sheet: &Sheet) -> Vec<Part> {
    let text = |text: &Option<String>| text.clone().unwrap_or_default();
    let head = sheet.head.iter().map(|(name, value)| ((*name).to_owned(), text(value)));
    let mut parts = vec![Part::Fields(head.collect()), Part::Heading("Figures".into())];
    parts.push(Part::Table(figures(sheet).without_empty_columns()));
    parts.extend(sheet.why_without().map(Part::Note));
    parts.extend(budgets(sheet));
    if sheet.decides() {
        parts.push(Part::Text(
            "Decisions by ISO 14253-1: a figure conforms when it keeps its tolerance with U against \
             it, and does not when it exceeds it with U in its favour. Between them nothing is decided."
                .into(),
        ));
    }
    let blank = |name: &str| (name.to_owned(), String::new());
    parts.push(Part::Fields(
        ["Measured by", "Signature", "Approved by", "Signature"].map(blank).into(),
    ));
    parts
}

fn figures(sheet: &Sheet) -> Table {
    let mut table = Table::new([
        "symbol",
        "meaning",
        "value in µm",
        "U in µm",
        "k",
        "tolerance in µm",
        "decision",
    ]);
    for line in &sheet.lines {
        let of =
            |words: &dyn Fn(&Budget) -> String| line.budget.as_ref().map_or(String::new(), words);
        table.row([
            line.named.symbol.clone(),
            line.named.meaning.clone(),
            format!("{:.3}", line.named.value_um),
            of(&both_sides),
            of(&|budget| format!("{:.2}", budget.coverage_factor)),
            line.tolerance_um.map_or(String::new(), |um| um.to_string()),
            line.decision().to_owned(),
        ]);
    }
    table
}

/// A budget in full for every figure that has a tolerance, or else for the first one; and what each
/// quantity contributes to all figures.
fn budgets(sheet: &Sheet) -> Vec<Part> {
    let decided: Vec<&Line> =
        sheet.lines.iter().filter(|line| line.tolerance_um.is_some()).collect();
    let shown = if decided.is_empty() { sheet.lines.iter().take(1).collect() } else { decided };
    let mut parts = Vec::new();
    for line in shown {
        if let Some(budget) = &line.budget {
            parts.push(Part::Heading(format!("Budget of {}", line.named.symbol)));
            parts.push(Part::Table(full(budget)));
        }
    }
    if sheet.lines.iter().any(|line| line.budget.is_some()) {
        parts.push(Part::Heading(
            "Contributions to every figure, standard uncertainties in µm".into(),
        ));
        parts.push(Part::Table(every(sheet)));
        parts.push(Part::Text(
            "By JCGM 100:2008: contributions are what one standard uncertainty of a quantity changes \
             of the evaluated figure, up and down, as a root mean square; they are independent and add \
             by their squares. U is how far below and above the figure the true one may be, with a \
             probability of 95.45 %: by the distribution of all that makes lengths wrong, and by \
             readings drawn without their noise. k is the mean of both sides over the combined."
                .into(),
        ));
    }
    parts
}

fn full(budget: &Budget) -> Table {
    let mut table = Table::new([
        "quantity",
        "estimate",
        "standard uncertainty",
        "distribution",
        "degrees of freedom",
        "sensitivity",
        "contribution in µm",
    ]);
    for Contribution { source, sensitivity, contribution_um } in &budget.contributions {
        let unit = source.unit.replace('u', "µ");
        let per = if unit.contains('/') { format!("µm/({unit})") } else { format!("µm/{unit}") };
        table.row([
            source.quantity.clone(),
            format!("{} {unit}", short(source.estimate)),
            format!("{:.4} {unit}", source.standard),
            source.distribution.name().into(),
            degrees(source.degrees_of_freedom),
            format!("{sensitivity:.4} {per}"),
            format!("{contribution_um:.4}"),
        ]);
    }
    table.row([
        "combined".to_owned(),
        format!("{:.3} µm", budget.value_um),
        String::new(),
        String::new(),
        degrees(budget.degrees_of_freedom),
        String::new(),
        format!("{:.4}", budget.standard_um),
    ]);
    table
}

/// As many digits as there are, six at most: a difference has rounding in its last ones.
fn short(value: f64) -> String {
    let digits = format!("{value:.6}");
    digits.trim_end_matches('0').trim_end_matches('.').to_owned()
}

fn degrees(of_freedom: f64) -> String {
    if of_freedom.is_finite() { format!("{:.0}", of_freedom.floor()) } else { "∞".into() }
}

fn every(sheet: &Sheet) -> Table {
    let budgets = || sheet.lines.iter().filter_map(|line| Some((line, line.budget.as_ref()?)));
    let first = budgets().next().map(|(_, budget)| budget);
    let quantities = first.into_iter().flat_map(|budget| &budget.contributions);
    let mut header = vec!["symbol".to_owned()];
    header.extend(quantities.map(|one| one.source.quantity.clone()));
    header.push("combined".into());
    let mut table = Table::new(header);
    for (line, budget) in budgets() {
        let mut row = vec![line.named.symbol.clone()];
        row.extend(budget.contributions.iter().map(|one| format!("{:.4}", one.contribution_um)));
        row.push(format!("{:.4}", budget.standard_um));
        table.row(row);
    }
    table
}
