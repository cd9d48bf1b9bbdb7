//! What instruments write beyond their range, or in place of a number.

use crate::guesses::{column, file, proposed, refused};

/// Row 3 and 5 of a column hold these.
fn with(one: &str, other: &str) -> String {
    file("Position [mm],Error [um],Probe [V]", |row| match row {
        3 => format!("3.5,{one},1.5"),
        5 => format!("5.5,0.5,{other}"),
        _ => format!("{row}.5,0.{row},1.{row}"),
    })
}

/// No reading is as large: all are read as missing by one rule, which is told.
#[test]
fn overloads_are_missing_and_told() {
    for (one, other) in [
        ("9.9e37", "-9.9E+37"),
        ("-1.000000000e+38", "9.900000000000e+37"),
        ("9.91E37", "1e38"),
        ("9.89999990e+37", "99000000000000000000000000000000000000"),
    ] {
        for recipe in ["", "[table]\nmissing = [\"none\"]"] {
            let proposal = proposed(&with(one, other), recipe);
            assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
            assert!(column(&proposal, "error_um")[3].is_nan(), "{one}");
            assert!(column(&proposal, "probe_v")[5].is_nan(), "{other}");
            let note = format!(
                "2 cells hold the overload of an instrument, first `{one}` at data.csv:5:5: read as \
                 missing"
            );
            assert_eq!(proposal.notes, [note]);
        }
    }
    let note = "1 cell holds the overload of an instrument, first `9.9e37` at data.csv:5:5: read as \
                missing";
    assert_eq!(proposed(&with("9.9e37", "1.5"), "").notes, [note]);
}

/// A column that begins with them is no words, and the row of names above it no preamble.
#[test]
fn overloads_at_the_beginning_leave_the_header_where_it_is() {
    let text = file("Position [mm];Error [um];Probe [V]", |row| match row {
        0..3 => format!("{row}.5;-1.0e+38;9.9e37"),
        _ => format!("{row}.5;0.{row};1.{row}"),
    });
    assert_eq!(column(&proposed(&text, ""), "error_um").len(), 40);
}

/// Other numbers out of all bounds are no overload, and refused where they stand.
#[test]
fn another_number_out_of_bounds_is_refused() {
    for wrong in ["9.8e37", "1e39", "3.4e38", "1e35"] {
        let message = refused(&with(wrong, "1.5"), "");
        let start = format!("data.csv:5:5: found `{wrong}` in column `Error [um]`");
        assert!(message.starts_with(&start), "{message}");
    }
}
