use super::*;
use crate::number::LARGEST;
use crate::table::Column;

fn read(text: &str) -> Result<Table, TraceError> {
    read_csv(text.as_bytes(), Path::new("data.csv"))
}

fn refusal(text: &str) -> String {
    read(text).unwrap_err().to_string()
}

#[test]
fn byte_order_mark_crlf_and_missing_cells() {
    let table = read("\u{feff}# pass 1\r\nposition_mm, error_um\r\n1,0.5\r\n2,\r\n").unwrap();
    assert_eq!(table.names().collect::<Vec<_>>(), ["position_mm", "error_um"]);
    assert_eq!(table.column("position_mm"), Some(&[1.0, 2.0][..]));
    let error_um = table.column("error_um").unwrap();
    assert!((error_um[0] - 0.5).abs() < f64::EPSILON && error_um[1].is_nan());
    assert_eq!(table.at(1).line, Some(4));
}

#[test]
fn a_bad_cell_is_named_by_line_and_column() {
    assert_eq!(
        refusal("time_s,µ_um\r\n# µ\r\n1,  abc\r\n2,1\r\n"),
        "data.csv:3:5: column `µ_um`: found `abc`, expected a number or an empty cell"
    );
}

#[test]
fn a_short_last_line_is_taken_for_a_cut() {
    assert_eq!(
        refusal("a,b\n1,2\n3"),
        "data.csv:3: found 1 cell, expected 2 as in the header\n\n\
         hint: the file ends here, it may have been cut off"
    );
}

#[test]
fn written_numbers_read_back_to_the_same_bits() {
    let values = vec![0.1 + 0.2, -1e-300, LARGEST, 5e-324, -0.0, 1e16, f64::NAN];
    let table = Table::new(vec![
        Column { name: "a_um".into(), values: values.clone() },
        Column { name: "row".into(), values: vec![1.0; 7] },
    ]);
    let mut text = Vec::new();
    write_csv(&table, &mut text).unwrap();
    let again = read_csv(&text, Path::new("data.csv")).unwrap();
    let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&again.columns[0].values), bits(&values));
}

#[test]
fn names_that_look_like_comments_read_back() {
    let table = Table::new(vec![Column { name: "#, \"x\"".into(), values: vec![1.0, f64::NAN] }]);
    let mut text = Vec::new();
    write_csv(&table, &mut text).unwrap();
    let again = read_csv(&text, Path::new("data.csv")).unwrap();
    assert_eq!((again.columns[0].name.as_str(), again.rows()), ("#, \"x\"", 2));
    assert_eq!(
        refusal("a\u{1}b\n1\n"),
        "data.csv:1:1: found `a\\u{1}b`, expected a name that can be printed"
    );
}

#[test]
fn semicolons_tabs_and_latin_1_are_read_alike() {
    for text in [
        &b"Time [s];error [\xB5m]\n0;0.1\n1;\n"[..],
        b"# logged\r\nTime [s]\terror [\xB5m]\r\n0\t0.1\r\n1\t\r\n",
    ] {
        let table = read_csv(text, Path::new("data.csv")).unwrap();
        assert_eq!(table.names().collect::<Vec<_>>(), ["Time [s]", "error [\u{b5}m]"]);
        let values = table.column("error [\u{b5}m]").unwrap();
        assert!((values[0] - 0.1).abs() < f64::EPSILON && values[1].is_nan());
    }
}

#[test]
fn a_column_of_instants_is_a_time() {
    let text = "timestamp,error_um\n2033-05-18T03:33:20Z,0\n,1\n2033-05-18T03:33:21.25Z,2\n";
    let table = read(text).unwrap();
    let time_s = table.column("time_s").unwrap();
    assert!((time_s[2] - time_s[0] - 1.25).abs() < 1e-6 && time_s[1].is_nan());
}

#[test]
fn quoted_separators_separate_nothing() {
    let table = read("i,\"a;b\"\n1,2\n").unwrap();
    assert_eq!(table.names().collect::<Vec<_>>(), ["i", "a;b"]);
    let mut text = Vec::new();
    write_csv(&table, &mut text).unwrap();
    assert_eq!(read_csv(&text, Path::new("data.csv")).unwrap().names().count(), 2);
    assert_eq!(read("\"a,b\";c\n1;2\n").unwrap().names().count(), 2);
}

#[test]
fn a_column_of_words_is_left_out_and_remembered() {
    let table = read("operator,error_um\n Li,1\n,2\nOtto,3\n").unwrap();
    assert_eq!(table.names().collect::<Vec<_>>(), ["error_um"]);
    assert_eq!((table.text[0].name.as_str(), table.text[0].first.as_str()), ("operator", "Li"));
    let refused = table.require("operator").unwrap_err().to_string();
    assert!(refused.starts_with("data.csv:2:2: column `operator`: found `Li`"), "{refused}");
}

#[test]
fn a_word_among_numbers_is_a_mistake() {
    let found = |text: &str| refusal(text).lines().next().unwrap().to_owned();
    let expected = "expected a number or an empty cell";
    assert_eq!(
        found("a,b,c\n1,x,x\n2,x,3\n3,4,4\n5,x,x\n6,x,6\n"),
        format!("data.csv:2:5: column `c`: found `x`, {expected}")
    );
    // What was meant to be a number is no word, nor is a file of words one of data.
    for text in ["a,b\n1,5 mm\n2,6 mm\n", "a;b\n1;0,5\n2;0,6\n", "a,b\nx,y\nz,w\n"] {
        assert!(found(text).ends_with(expected), "{text}");
    }
}
