//! Pages on paper: A4, and no heading stands last on a sheet.

use std::fs;
use std::path::Path;
use std::process::Command;

use regex::Regex;

use crate::support::command::{helixlock, put, scratch, word};
use crate::workbench::driver;

/// Commands whose pages are printed, each without its output.
const PRINTED: [&str; 5] = [
    "learn examples/recorder-and-screw/machine.toml examples/recorder-and-screw/data.csv",
    "learn examples/thermal-day/machine.toml examples/thermal-day/data.csv",
    "screw examples/ball-screw-grade/screw.csv --lead 2mm --run-out 30mm --sheet examples/ball-screw-grade/sheet.toml",
    "straightness examples/lathe-straightness/probes.csv --spacing 45mm,40mm --zeros-matched --sheet examples/lathe-straightness/sheet.toml",
    "scale iso230 examples/inductosyn-scale/axis.csv --sheet examples/inductosyn-scale/sheet.toml",
];

/// The text of a page of HTML as a printer sets it, sheet by sheet.
fn sheets(page: &Path) -> Vec<String> {
    let pdf = page.with_extension("pdf");
    let printed = driver("print.mjs").args([page, &pdf]).output().expect("`node` starts");
    assert!(printed.status.success(), "{}", String::from_utf8_lossy(&printed.stderr));
    let text = Command::new("pdftotext").arg("-layout").arg(&pdf).arg("-").output();
    let text = text.expect("`pdftotext` starts; it is in the Debian package `poppler-utils`");
    assert!(text.status.success(), "{}", String::from_utf8_lossy(&text.stderr));
    let text = String::from_utf8(text.stdout).expect("text");
    text.split('\u{c}').filter(|sheet| !sheet.trim().is_empty()).map(str::to_owned).collect()
}

/// Headings of a page of HTML, as they are read.
fn headings(page: &Path) -> Vec<String> {
    let html = fs::read_to_string(page).expect("the page is written");
    let heading = Regex::new("<h2>(.*?)</h2>").expect("a pattern");
    heading.captures_iter(&html).map(|found| found[1].replace("&amp;", "&")).collect()
}

/// Headings that stand last on a sheet, and how many sheets there are.
fn last_headings(page: &Path) -> (Vec<String>, usize) {
    let (sheets, headings) = (sheets(page), headings(page));
    let text = sheets.concat();
    assert!(headings.iter().all(|heading| text.contains(heading)), "{headings:?} in\n{text}");
    let last = sheets.iter().filter_map(|sheet| sheet.trim_end().lines().last());
    let last: Vec<&str> = last.map(str::trim).collect();
    let alone = headings.into_iter().filter(|heading| last.contains(&heading.as_str()));
    (alone.collect(), sheets.len())
}

#[test]
fn no_heading_stands_last_on_a_sheet() {
    let mut printed = 0;
    for line in PRINTED {
        let folder = scratch();
        let (out, out_word) = word(&folder, "out");
        let words: Vec<&str> = line.split(' ').chain(["-o", &out_word]).collect();
        let run = helixlock(&words);
        assert!(run.status < 2 && run.stderr.is_empty(), "{line}: {}", run.stderr);
        let (alone, sheets) = last_headings(&out.join("report.html"));
        assert!(alone.is_empty(), "{line}: {alone:?}");
        printed += sheets;
    }
    assert!(2 * PRINTED.len() <= printed, "{printed} sheets do not try it");
}

/// What the test above would find.
#[test]
fn a_heading_that_stands_last_is_seen() {
    let folder = scratch();
    let (page, _) = word(&folder, "page.html");
    put(
        &page,
        "<style>@page { size: A4; margin: 15mm } body, h2 { margin: 0 }</style>\
         <p style='height: 250mm'>a</p><h2>Alone</h2><p style='height: 50mm; break-inside: avoid'>b</p>",
    );
    assert_eq!(last_headings(&page), (vec!["Alone".to_owned()], 2));
}
