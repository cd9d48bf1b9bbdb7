//! Names and units as instruments write them above their rows.

use helixlock_import::Proposal;

use crate::guesses::{column, file, proposed};

fn from(proposal: &Proposal) -> Vec<&str> {
    proposal.recipe.columns.iter().map(|rule| rule.from.as_str()).collect()
}

fn unit<'a>(proposal: &'a Proposal, name: &str) -> Option<&'a str> {
    proposal.recipe.column(name).and_then(|rule| rule.unit.as_deref())
}

/// A separator ends the names and every row; the first row has a word among numbers.
fn ended(last: &str) -> String {
    file(&format!("Position [mm];Error [um];sv_temp;{last}"), |row| match row {
        0 => "0.5;over;20.5;".to_owned(),
        _ => format!("{row}.5;0.{row};20.{row};"),
    })
}

/// No column stands behind the last separator: it has neither name nor cell.
#[test]
fn a_separator_at_the_end_of_rows_begins_no_column() {
    let missing = "[table]\nmissing = [\"over\"]\n";
    for recipe in [missing.to_owned(), format!("{missing}header = 1\n")] {
        let proposal = proposed(&ended(""), &recipe);
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        assert_eq!(from(&proposal), ["Position [mm]", "Error [um]", "sv_temp"]);
        assert_eq!(column(&proposal, "error_um").len(), 40);
    }
    let named = proposed(&ended("note"), missing);
    assert_eq!(from(&named), ["Position [mm]", "Error [um]", "sv_temp", "note"]);
}

/// Names that no rule knows for names are those above the numbers, if a recipe tells of them.
#[test]
fn a_header_that_is_told_stands_above_the_numbers() {
    let header = "Rack 2\nPosition [mm],Error [um],Probe [V],0.25";
    let text = file(header, |row| format!("{row}.5,0.{row},7.{row},8.{row}"));
    let proposal = proposed(&text, "[table]\nheader = 1\n");
    assert_eq!(from(&proposal), ["Position [mm]", "Error [um]", "Probe [V]", "0.25"]);
    assert_eq!(column(&proposal, "position_mm").len(), 40);
}

/// A motor's amplifier names its channels and, below, what it put on them; below the time stands its unit.
#[test]
fn a_unit_among_names_belongs_to_the_name_above_it() {
    let header = "Axis1\nSampling time interval(ms),1.0\n\
                  Time,Analog 1,Analog 2,Analog 3,Digital 1\n\
                  ms,Position error,Torque,Not selected,Not selected";
    let text = file(header, |row| format!("{row}.5,0.{row},-{row}.1,0.0,0.000"));
    let proposal = proposed(&text, "[[column]]\nfrom = \"Analog 1 Position error\"\nunit = \"um\"");
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    assert_eq!(unit(&proposal, "Time"), Some("ms"));
    assert_eq!(column(&proposal, "time_s")[1].to_bits(), 0.0015_f64.to_bits());
    assert!(proposal.table.column("analog_2_torque").is_some());
    assert_eq!(
        proposal.notes,
        ["2 columns are zero throughout and left out, as their names say, first \
          `Analog 3 Not selected`"]
    );
    assert_eq!(proposal.table.names().count(), 3);
    let open = proposed(&text.replace("Position error", "Probe"), "").questions;
    assert!(open[0].answers.iter().all(|answer| !answer.label.contains("selected")));
    let selected = text.replace("0.000\n", "0.001\n");
    assert_eq!(proposed(&selected, "").table.names().count(), 4);
}

/// The word for a unit before each is none, and the names are in the row above.
#[test]
fn units_with_their_word_before_them_are_no_names() {
    let header = "Interval,0.001,Interval,0.001\n\
                  Channel name,\"Force\",Channel name,\"Probe\"\n\
                  Unit,\"N\",Unit,\"um\"";
    let text = file(header, |row| format!("0.{row:03},-0.{row},0.{row:03},3.{row}"));
    let proposal = proposed(&text, "[[column]]\nfrom = \"Probe\"\nto = \"error_um\"");
    assert_eq!(from(&proposal), ["Channel name", "Force", "Channel name (3)", "Probe"]);
    assert_eq!(["Force", "Probe"].map(|name| unit(&proposal, name)), [Some("N"), Some("um")]);
    assert_eq!(unit(&proposal, "Channel name"), None);
    // Nothing says that it is the time, but it rises.
    let answers = proposal.questions.into_iter().flat_map(|question| question.answers);
    let labels: Vec<_> = answers.map(|answer| answer.label).collect();
    let time = "`Channel name` is `time_s`".to_owned();
    assert!(labels.contains(&time) && !labels.contains(&"`Force` is `time_s`".to_owned()));
}
