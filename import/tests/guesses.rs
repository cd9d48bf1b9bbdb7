//! What a file does not tell is asked for: nothing is read a thousand times too small.

use helixlock_import::{Proposal, Recipe, Source, propose};

/// A table of forty rows.
fn file(header: &str, row: impl Fn(u32) -> String) -> String {
    let rows: Vec<String> = (0..40).map(|index| row(index) + "\n").collect();
    format!("{header}\n{}", rows.concat())
}

fn proposed(text: &str, recipe: &str) -> Proposal {
    let recipe = Recipe::parse(recipe, "given").expect("a recipe");
    let source = Source { name: "data.csv", bytes: text.as_bytes() };
    propose(&[source], &recipe).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(text: &str, recipe: &str) -> String {
    let recipe = Recipe::parse(recipe, "given").expect("a recipe");
    let source = Source { name: "data.csv", bytes: text.as_bytes() };
    propose(&[source], &recipe).expect_err("it cannot be read").to_string()
}

/// A counter of rows in the column of the runs would take every reading for a run of its own.
#[test]
fn a_counter_of_rows_is_no_run() {
    for name in ["Run", "pass", "Durchgang"] {
        let header = format!("Position (mm),Error (um),{name}");
        let text = file(&header, |index| format!("{},{},{index}", 10 * index, index % 7));
        let proposal = proposed(&text, "");
        assert!(proposal.table.column("pass").is_none(), "{name}");
        let rule = proposal.recipe.column(name).expect("a rule for each");
        assert_eq!(
            (rule.to.as_deref(), rule.reason.as_str()),
            (Some("none"), "it counts the rows")
        );
        let given = format!("[[column]]\nfrom = \"{name}\"\nto = \"pass\"");
        let message = refused(&text, &given);
        let start = format!("data.csv:1: found a run for almost every row in column `{name}`");
        assert!(message.starts_with(&start), "{message}");
        let runs = file(&header, |index| format!("{},{},{}", 10 * index, index % 7, index / 20));
        assert_eq!(column(&proposed(&runs, ""), "pass")[39].to_bits(), 1.0_f64.to_bits(), "{name}");
    }
}

/// A rule for a column that is not there would be lost with its sign.
#[test]
fn a_rule_for_no_column_is_refused() {
    let text = file("Position (mm),Error (um)", |index| format!("{},{}", 10 * index, index % 7));
    let wrong = "[text]\ndecimal = \".\"\n[[column]]\nfrom = \"Eror (um)\"\nsign = -1\n";
    assert_eq!(
        refused(&text, wrong),
        "given:3:1: found `from` with `Eror (um)`, which no file has as a column, expected one of \
         `Position (mm)`, `Error (um)`"
    );
    let left_out = wrong.replace("sign = -1", "to = \"none\"");
    assert!(proposed(&text, &left_out).questions.is_empty());
    let bytes = include_bytes!("samples/laser.rtl");
    let rule = Recipe::parse("[[column]]\nfrom = \"Error\"\nsign = -1", "given").expect("a recipe");
    let error = propose(&[Source { name: "laser.rtl", bytes }], &rule).expect_err("no column");
    assert!(
        error
            .to_string()
            .ends_with("expected no `[[column]]`, as the format has no columns to name")
    );
    let right = wrong.replace("Eror", "Error");
    assert_eq!(column(&proposed(&text, &right), "error_um")[3].to_bits(), (-3.0_f64).to_bits());
}
