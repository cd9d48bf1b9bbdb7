//! Pages on paper: A4, and no heading stands last on a sheet.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use regex::Regex;

use crate::support::command::{few_samples, helixlock, put, scratch, word};
use crate::workbench::{Server, driver, shortened, story, with_data};

/// Commands whose pages are printed, each without its output; `FEW` are some samples of its example.
const PRINTED: [&str; 5] = [
    "learn examples/recorder-and-screw/machine.toml FEW",
    "learn examples/thermal-day/machine.toml FEW",
    "screw examples/ball-screw-grade/screw.csv --lead 2mm --run-out 30mm --sheet examples/ball-screw-grade/sheet.toml",
    "straightness examples/lathe-straightness/probes.csv --spacing 45mm,40mm --zeros-matched --sheet examples/lathe-straightness/sheet.toml",
    "scale iso230 examples/inductosyn-scale/axis.csv --sheet examples/inductosyn-scale/sheet.toml",
];

/// The text of a page of HTML as a printer sets it, sheet by sheet.
fn sheets(page: &Path) -> Vec<String> {
    let pdf = page.with_extension("pdf");
    let printed = driver("print.mjs").args([page, &pdf]).output().expect("`node` starts");
    assert!(printed.status.success(), "{}", String::from_utf8_lossy(&printed.stderr));
    sheets_of(&pdf)
}

/// The text of what was printed, sheet by sheet.
fn sheets_of(pdf: &Path) -> Vec<String> {
    let text = poppler(&["pdftotext", "-layout"], pdf, &["-"]);
    let text = String::from_utf8(text).expect("text");
    let text = text.strip_suffix('\u{c}').expect("a sheet ends with a form feed");
    text.split('\u{c}').map(str::to_owned).collect()
}

/// What one of poppler's tools says of a file.
fn poppler(command: &[&str], pdf: &Path, more: &[&str]) -> Vec<u8> {
    let run = Command::new(command[0]).args(&command[1..]).arg(pdf).args(more).output();
    let run = run.expect("the tools of the Debian package `poppler-utils` start");
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    run.stdout
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
    (last_of(&sheets, headings), sheets.len())
}

/// Headings that end a sheet.
fn last_of(sheets: &[String], headings: Vec<String>) -> Vec<String> {
    assert!(sheets.iter().all(|sheet| !sheet.trim().is_empty()), "a sheet is empty: {sheets:?}");
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = words(&sheets.concat());
    let missing: Vec<_> = headings.iter().filter(|heading| !text.contains(*heading)).collect();
    assert!(missing.is_empty(), "{missing:?} in\n{text}");
    // A heading may take more lines than one.
    let ends = |sheet: &String| {
        let lines: Vec<&str> = sheet.trim_end().lines().collect();
        (1..=3)
            .filter_map(|count| {
                Some(words(&lines.get(lines.len().checked_sub(count)?..)?.join(" ")))
            })
            .collect::<Vec<_>>()
    };
    let last: Vec<String> = sheets.iter().flat_map(ends).collect();
    headings.into_iter().filter(|heading| last.contains(heading)).collect()
}

/// The first sheet in colours, three bytes a point, five points a centimetre.
fn first_in_colours(pdf: &Path) -> Vec<u8> {
    let picture = poppler(&["pdftoppm", "-r", "13", "-l", "1"], pdf, &[]);
    let head = picture.iter().enumerate().filter(|(_, byte)| **byte == b'\n').nth(2);
    picture[head.expect("three lines before the points").0 + 1..].to_vec()
}

/// Part of the points that a property holds for.
#[expect(clippy::cast_precision_loss, reason = "a number of points")]
fn share(points: &[u8], of: impl Fn(&[u8]) -> bool) -> f64 {
    points.chunks(3).filter(|point| of(point)).count() as f64 / (points.len() / 3) as f64
}

/// From a browser in the dark, whose charts have other colours and are wider than a sheet; the story
/// itself asks what would be cut.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn every_screen_of_the_workbench_is_whole_on_paper() {
    let bench = shortened(with_data("6"));
    let papers = scratch();
    let papers_word = papers.path().to_str().expect("a path of text");
    let told = story("prints", &Server::over(bench.path()), &[papers_word]);
    let told: BTreeMap<String, Vec<String>> = serde_json::from_str(&told).expect("JSON");
    assert_eq!(told.len(), 8, "{told:?}");
    for (name, headings) in told {
        let pdf = papers.path().join(&name).with_extension("pdf");
        let size = String::from_utf8(poppler(&["pdfinfo"], &pdf, &[])).expect("text");
        assert!(size.contains("(A4)"), "{name}: {size}");
        let sheets = sheets_of(&pdf);
        let alone = last_of(&sheets, headings);
        assert!(alone.is_empty(), "{name}: {alone:?}");
        let points = first_in_colours(&pdf);
        let white = share(&points, |point| point == [255, 255, 255]);
        assert!(0.6 < white, "{name}: {white} of the sheet is white");
        let blue = share(&points, |point| u16::from(point[0]) + 100 < u16::from(point[2]));
        let bars = ["fall", "kept"].contains(&name.as_str());
        assert!(!bars || 0.01 < blue, "{name}: {blue} of the sheet is blue");
    }
}

/// A telephone shows a part of what is wide, and that it goes on.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn nothing_is_cut_on_a_telephone_without_a_sign() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    let words: Vec<&str> = PRINTED[2].split(' ').chain(["-o", &out_word]).collect();
    assert_eq!(helixlock(&words).status, 0);
    let shown = driver("phone.mjs").arg(out.join("report.html")).output().expect("`node` starts");
    assert!(shown.status.success(), "{}", String::from_utf8_lossy(&shown.stderr));
    let found: serde_json::Value = serde_json::from_slice(&shown.stdout).expect("JSON");
    assert!(4 < found["scrolled"].as_u64().expect("a count"), "{found}");
    assert_eq!((&found["cut"], &found["over"]), (&serde_json::json!([]), &serde_json::json!(0)));
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn no_heading_stands_last_on_a_sheet() {
    let mut printed = 0;
    for line in PRINTED {
        let folder = scratch();
        let (out, out_word) = word(&folder, "out");
        let line = match line.strip_suffix("FEW") {
            Some(of) => {
                let example = of.split('/').nth(1).expect("an example");
                format!("{of}{}", few_samples(folder.path(), example, 4))
            }
            None => line.to_owned(),
        };
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
