//! Workbooks that show more than their cells hold: merged cells, numbers typed as texts, times without a date.

use std::fmt::Write as _;
use std::io::{Cursor, Write as _};

use helixlock_import::{ImportError, Proposal, Recipe, Source, propose};
use zip::write::{SimpleFileOptions, ZipWriter};

/// A workbook of one sheet with the cells of rows, and what stands behind them; style 1 is a time of day.
fn workbook(rows: &[String], behind: &str) -> Vec<u8> {
    let mut cells = String::new();
    for (at, row) in rows.iter().enumerate() {
        write!(cells, "<row r=\"{}\">{row}</row>", at + 1).expect("memory");
    }
    let main = "xmlns=\"http://schemas.openxmlformats.org/spreadsheetml/2006/main\"";
    let relations = "http://schemas.openxmlformats.org/officeDocument/2006/relationships";
    let packages = "xmlns=\"http://schemas.openxmlformats.org/package/2006/relationships\"";
    let parts = [
        (
            "_rels/.rels",
            format!(
                "<Relationships {packages}><Relationship Id=\"rId1\" \
                 Type=\"{relations}/officeDocument\" Target=\"xl/workbook.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/_rels/workbook.xml.rels",
            format!(
                "<Relationships {packages}><Relationship Id=\"rId1\" Type=\"{relations}/worksheet\" \
                 Target=\"worksheets/sheet1.xml\"/></Relationships>"
            ),
        ),
        (
            "xl/workbook.xml",
            format!(
                "<workbook {main} xmlns:r=\"{relations}\"><sheets>\
                 <sheet name=\"S\" sheetId=\"1\" r:id=\"rId1\"/></sheets></workbook>"
            ),
        ),
        (
            "xl/styles.xml",
            format!(
                "<styleSheet {main}><cellXfs><xf numFmtId=\"0\"/><xf numFmtId=\"21\"/></cellXfs></styleSheet>"
            ),
        ),
        (
            "xl/worksheets/sheet1.xml",
            format!("<worksheet {main}><sheetData>{cells}</sheetData>{behind}</worksheet>"),
        ),
    ];
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, text) in parts {
        archive.start_file(name, SimpleFileOptions::default()).expect("memory");
        archive.write_all(text.as_bytes()).expect("memory");
    }
    archive.finish().expect("memory").into_inner()
}

fn text(text: &str) -> String {
    format!("<c t=\"inlineStr\"><is><t>{text}</t></is></c>")
}

fn number(value: f64, style: u32) -> String {
    format!("<c s=\"{style}\"><v>{value}</v></c>")
}

/// Thirty rows below names.
fn sheet(
    names: &[&str],
    row: impl Fn(u32) -> String,
    behind: &str,
) -> Result<Proposal, ImportError> {
    let names: String = names.iter().map(|name| text(name)).collect();
    let rows: Vec<String> = std::iter::once(names).chain((0..30).map(row)).collect();
    let bytes = workbook(&rows, behind);
    propose(&[Source { name: "book.xlsx", bytes: &bytes }], &Recipe::default())
}

#[test]
fn cells_are_read_as_they_are_meant() {
    let names = ["Position [mm]", "Error [um]"];
    let merged = |row: u32| {
        let position =
            if row.is_multiple_of(2) { number(f64::from(row * 5), 0) } else { "<c/>".to_owned() };
        position + &number(f64::from(row) / 10.0, 0)
    };
    let mut regions = String::new();
    for row in (2..32).step_by(2) {
        write!(regions, "<mergeCell ref=\"A{row}:A{}\"/>", row + 1).expect("memory");
    }
    let merged = sheet(&names, merged, &format!("<mergeCells>{regions}</mergeCells>"));
    let typed = sheet(
        &names,
        |row| text(&format!("{},0", row / 2 * 10)) + &text(&format!("0,{row}00")),
        "",
    );
    let midnight = |row: u32| {
        let minute = f64::from((1425 + row) % 1440);
        number(minute / 1440.0, 1) + &number(f64::from(row), 0)
    };
    let midnight = sheet(&["Time", "Error [um]"], midnight, "");
    for (found, column, last) in [
        (merged, "position_mm", 140.0),
        (typed, "position_mm", 140.0),
        (midnight, "time_s", 29.0 * 60.0),
    ] {
        let proposal = found.unwrap_or_else(|error| panic!("{column}: {error}"));
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        let values = proposal.table.column(column).unwrap_or_else(|| panic!("no {column}"));
        assert!((values[29] - last).abs() < 1e-6, "{column}: {values:?}");
    }
}

/// A form of ISO 230-2: each way over its runs, which are numbered below; a title is above all of it.
#[test]
fn a_heading_merged_over_columns_is_that_of_each() {
    let gap = |cells: usize| "<c/>".repeat(cells);
    let title = text("Axis X") + &gap(6);
    let ways =
        text("Target [mm]") + &text("forward [µm]") + &gap(2) + &text("backward [µm]") + &gap(2);
    let runs: String = [1.0, 2.0, 3.0].map(|run| number(run, 0)).concat();
    let row = |row: u32| {
        let read: String = (0..6).map(|run| number(f64::from(row % 7 + 10 * run), 0)).collect();
        number(f64::from(100 * row), 0) + &read
    };
    let head = [title, ways, format!("<c/>{runs}{runs}")];
    let rows: Vec<String> = head.into_iter().chain((0..9).map(row)).collect();
    let merged = ["A1:G1", "A2:A3", "B2:D2", "E2:G2"];
    let merged = merged.map(|cells| format!("<mergeCell ref=\"{cells}\"/>")).concat();
    for behind in [format!("<mergeCells>{merged}</mergeCells>"), String::new()] {
        let bytes = workbook(&rows, &behind);
        let found = propose(&[Source { name: "book.xlsx", bytes: &bytes }], &Recipe::default())
            .unwrap_or_else(|error| panic!("{error}"));
        assert!(found.questions.is_empty(), "{:?}", found.questions);
        let names: Vec<&str> = found.table.names().collect();
        assert_eq!(names, ["position_mm", "error_um", "pass", "direction"]);
        assert_eq!(found.table.rows(), 6 * 9);
        let column = |name| found.table.column(name).expect(name);
        let at = |pass: f64, way: f64| {
            let mut rows = 0..found.table.rows();
            rows.find(|row| {
                let near = |name, value: f64| (column(name)[*row] - value).abs() < 0.5;
                near("position_mm", 200.0) && near("pass", pass) && near("direction", way)
            })
        };
        for (pass, way, error_um) in [(1.0, 1.0, -2.0), (3.0, 1.0, -22.0), (2.0, -1.0, -42.0)] {
            let row = at(pass, way).expect("such a row");
            assert!((column("error_um")[row] - error_um).abs() < 1e-9, "{pass} {way}");
        }
    }
}

#[test]
fn a_column_of_formulas_that_were_never_computed_is_named() {
    let error = sheet(&["Position [mm]", "Error [um]"], |row| number(f64::from(row), 0), "")
        .expect_err("there is no error");
    let hint = "hint: column `Error [um]` is empty, were its formulas never computed?";
    assert!(error.to_string().ends_with(hint), "{error}");
}
