//! Tables read back as they were written, in both formats, to the bit.

use std::path::Path;

use helixlock_traces::csv::{read_csv, write_csv};
use helixlock_traces::parquet::{read_parquet, write_parquet};
use helixlock_traces::{Column, Table, in_range};
use proptest::collection::{btree_set, vec};
use proptest::prelude::*;

/// A number of the range that is read, often a small one, or a gap.
fn value() -> impl Strategy<Value = f64> {
    let finite = any::<f64>().prop_filter("in range", |value| in_range(*value));
    prop_oneof![4 => -1e3..1e3_f64, 2 => finite, 1 => Just(f64::NAN)]
}

/// One to four columns with names of all sorts but those that look like semicolons for commas.
fn table() -> impl Strategy<Value = Table> {
    let names = btree_set("[a-z#\"][ -:<-~µ误]{0,6}[a-z_%\"]", 1..5);
    (names, 1..20_usize).prop_flat_map(|(names, rows)| {
        let values = vec(vec(value(), rows), names.len());
        values.prop_map(move |values| {
            let columns = names.iter().cloned().zip(values);
            Table::new(columns.map(|(name, values)| Column { name, values }).collect())
        })
    })
}

/// Names and bits, with one kind of gap.
fn bits(table: &Table) -> Vec<(&str, Vec<Option<u64>>)> {
    let of = |value: &f64| Some(value.to_bits()).filter(|_| !value.is_nan());
    table.columns.iter().map(|c| (c.name.as_str(), c.values.iter().map(of).collect())).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(256) })]

    #[test]
    fn text_reads_back(table in table()) {
        let mut text = Vec::new();
        write_csv(&table, &mut text).expect("memory takes it");
        let again = read_csv(&text, Path::new("data.csv"));
        prop_assert!(again.is_ok(), "{:?}", again.err());
        let again = again.expect("it is fine");
        prop_assert_eq!(bits(&again), bits(&table));
    }

    #[test]
    fn parquet_reads_back(table in table()) {
        let mut bytes = Vec::new();
        write_parquet(&table, &mut bytes).expect("memory takes it");
        let again = read_parquet(bytes, Path::new("data.parquet")).expect("what we write, we read");
        prop_assert_eq!(bits(&again), bits(&table));
    }

    /// Byte-order mark, line ends, comments, blank lines and quotes change nothing.
    #[test]
    fn ways_of_writing_are_one(mut table in table(), comment in "[ -~]{0,10}") {
        for (index, column) in table.columns.iter_mut().enumerate() {
            column.name = format!("column_{index}");
        }
        let mut text = Vec::new();
        write_csv(&table, &mut text).expect("memory takes it");
        let text = String::from_utf8(text).expect("it is text");
        let lines: Vec<_> = text.lines().map(|line| format!("{line}\r\n#{comment}\r\n\r\n")).collect();
        let other = format!("\u{feff}# first\r\n{}", lines.concat());
        let again = read_csv(other.as_bytes(), Path::new("data.csv"));
        prop_assert!(again.is_ok(), "{:?}", again.err());
        let again = again.expect("it is fine");
        prop_assert_eq!(bits(&again), bits(&table));
        prop_assert_eq!(again.at(table.rows() - 1).line, Some(2 + 3 * table.rows()));
    }
}

/// What a doubt says to write into a recipe can be written there.
#[test]
fn recipes_know_every_unit_of_a_header() {
    for column in helixlock_plant::LOGGED_COLUMNS {
        let rows = (0..40).map(|row| format!("{row},0.{row},{}.5", 20 + row % 3));
        let rows: Vec<String> = rows.collect();
        let error = if column.name == "error_um" { "lead_error_um" } else { "error_um" };
        let place = if column.name == "position_mm" { "angle_rev" } else { "position_mm" };
        let text = format!("{place},{error},{}\n{}\n", column.name, rows.join("\n"));
        for (unit, ..) in column.units {
            let name = column.name;
            let given =
                format!("[[column]]\nfrom = \"{name}\"\nto = \"{name}\"\nunit = \"{unit}\"\n");
            let given = helixlock_import::Recipe::parse(&given, "recipe").expect("a recipe");
            let source = helixlock_import::Source { name: "data.csv", bytes: text.as_bytes() };
            let read = helixlock_import::propose(&[source], &given);
            assert!(
                read.is_ok(),
                "{name} in {unit}: {}",
                read.err().map_or_else(String::new, |e| e.to_string())
            );
        }
    }
}
