//! The waveforms on the blocks' pages are what the blocks do.
//!
//! A waveform is a text block under `# Waveform`, one column a clock. Rows named like inputs are
//! driven, rows named like outputs compared. The sentence above it sets other inputs
//! (`` `preset` = 003 ``, hexadecimal) and may send pulses first (`` after 999 pulses on `laser` ``).
//! The block gets one clock with the inputs of the first column before that column.

use std::fmt::Write;

use helixlock_rtl::{APART, BLOCKS};

use crate::support::bench::Bench;

/// A waveform and the sentence above it.
struct Documented {
    sentence: String,
    rows: Vec<(String, Vec<u64>)>,
}

/// Blocks whose page has a table of clocks instead, tested in their own module.
const WITHOUT: &[&str] = &["step_driver", "board_shell"];

#[test]
fn waveforms_are_true() {
    let mut wrong = String::new();
    for card in BLOCKS.iter().chain(APART).filter(|card| !WITHOUT.contains(&card.name)) {
        let waveforms = read(&page(card.name));
        assert!(!waveforms.is_empty(), "{} has no waveform", card.name);
        for waveform in waveforms {
            let shown = render(&waveform.rows);
            let simulated = render(&simulated(card.name, &waveform));
            if shown != simulated {
                let _ = writeln!(wrong, "{}: it does\n{simulated}", card.name);
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// Every page has the same sections, in the same order.
#[test]
fn pages_are_complete() {
    for card in BLOCKS.iter().chain(APART) {
        let page = page(card.name);
        let mut sections = vec!["| port", "# At the same time", "# Inferred", "use rust_hdl"];
        if card.name == "board_shell" {
            sections[0] = "| pin";
        }
        let places: Vec<_> = sections.iter().map(|section| page.find(section)).collect();
        assert!(places.iter().all(Option::is_some), "{}: {sections:?} at {places:?}", card.name);
        assert!(places.is_sorted(), "{}: {sections:?} at {places:?}", card.name);
    }
}

/// Runs the block through the driven rows, and gives all rows as they come out.
fn simulated(block: &str, waveform: &Documented) -> Vec<(String, Vec<u64>)> {
    let mut bench = Bench::new(block);
    prepare(&mut bench, &waveform.sentence);
    let columns = waveform.rows[0].1.len();
    let mut rows: Vec<_> = waveform.rows.iter().map(|(name, _)| (name.clone(), vec![])).collect();
    for column in [0].into_iter().chain(0..columns) {
        for (name, levels) in &waveform.rows {
            if bench.is_input(name) {
                bench.set(&[(name, levels[column])]);
            }
        }
        for (name, levels) in &mut rows {
            levels.push(bench.get(name));
        }
        bench.clock();
    }
    for (_, levels) in &mut rows {
        levels.remove(0);
    }
    rows
}

/// Sets the inputs the sentence sets, and sends the pulses it sends.
fn prepare(bench: &mut Bench, sentence: &str) {
    let words: Vec<_> = sentence.split_whitespace().collect();
    for window in words.windows(3).filter(|window| window[1] == "=") {
        let name = window[0].trim_matches('`');
        let digits = window[2].trim_matches([',', ':', '.', ';']);
        if window[0].starts_with('`') {
            bench.set(&[(name, u64::from_str_radix(digits, 16).expect("a hexadecimal number"))]);
        }
    }
    for window in words.windows(5).filter(|window| window[0] == "after" && window[3] == "on") {
        let pulses: u32 = window[1].parse().expect("a number of pulses");
        let input = window[4].trim_matches(['`', ',', ':']);
        for _ in 0..pulses {
            bench.pulse(&[input]);
            bench.clock();
        }
    }
    for window in words.windows(3).filter(|window| window[0] == "after") {
        if window[2].starts_with("clocks") {
            bench.clocks(window[1].parse().expect("a number of clocks"));
        }
    }
}

/// The page of a block: its file.
fn page(block: &str) -> String {
    let path = format!("{}/rtl/src/{block}.rs", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).expect(&path)
}

/// The waveforms of a page.
fn read(page: &str) -> Vec<Documented> {
    let text: Vec<_> = page.lines().map_while(|line| line.strip_prefix("//!")).collect();
    let mut sections = text.split(|line| line.starts_with(" # "));
    let section = sections.find(|lines| lines.iter().any(|line| line.contains(['▁', '▔'])));
    let mut found = Vec::new();
    let mut sentence = String::new();
    let mut rows: Option<Vec<_>> = None;
    for line in section.unwrap_or_default() {
        match (line.trim(), rows.take()) {
            ("```text", _) => rows = Some(Vec::new()),
            ("```", Some(rows)) => {
                found.push(Documented { sentence: std::mem::take(&mut sentence), rows });
            }
            (row, Some(mut open)) => {
                let (name, levels) = row.split_once(' ').expect("a name and its levels");
                open.push((name.to_owned(), levels.trim().chars().map(level).collect()));
                rows = Some(open);
            }
            (words, None) => sentence = format!("{sentence} {words}"),
        }
    }
    found
}

fn level(drawn: char) -> u64 {
    match drawn {
        '▁' => 0,
        '▔' => 1,
        digit => digit.to_digit(16).map_or(u64::MAX, u64::from),
    }
}

/// Rows as drawn on a page.
fn render(rows: &[(String, Vec<u64>)]) -> String {
    let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
    let mut text = String::new();
    for (name, levels) in rows {
        let wide = levels.iter().any(|level| *level > 1);
        let drawn: String = levels.iter().map(|level| draw(*level, wide)).collect();
        let _ = writeln!(text, "//! {name:width$} {drawn}");
    }
    text
}

fn draw(level: u64, wide: bool) -> char {
    match level {
        0 if !wide => '▁',
        1 if !wide => '▔',
        digit => u32::try_from(digit).ok().and_then(|d| char::from_digit(d, 16)).unwrap_or('?'),
    }
}
