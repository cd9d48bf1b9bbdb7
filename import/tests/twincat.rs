//! What a scope exports, in the variants its settings make of one recording.

use helixlock_import::{Proposal, Recipe, Source, propose};

/// 50 samples of two positions, 10 ms apart.
const SAMPLES: u64 = 50;
/// 2024-12-30 10:00 UTC in 100 ns since 1601.
const BEGIN: u64 = 133_801_416_000_000_000;

fn positions(sample: u64) -> [f64; 2] {
    let turn = f64::from(u32::try_from(sample).expect("few samples")) / 25.0;
    [turn * 3.0, turn * 3.0 + 0.001 * (turn - 1.0) * (turn - 1.0)]
}

/// An export: header, a row for each sample, and what ends it.
fn export(header: &str, row: impl Fn(u64, [f64; 2]) -> String, end: &str) -> String {
    let rows: Vec<String> = (0..SAMPLES).map(|sample| row(sample, positions(sample))).collect();
    format!("{header}\n\n{}\n{end}", rows.join("\n"))
}

const SHARED: &str = "Name;SetPos;ActPos\nSampleTime[ms];10;10\nUnit;mm (Length);mm (Length)";

fn read(text: &str) -> Proposal {
    let source = Source { name: "scope.csv", bytes: text.as_bytes() };
    propose(&[source], &Recipe::default()).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// True when the table holds the recording, with its times.
fn is_whole(found: &Proposal) -> bool {
    let column = |name: &str| found.table.column(name).expect("the table has it");
    let (time_s, set) = (column("time_s"), column("position_mm"));
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
    let rows = (0..SAMPLES).zip(time_s.iter().zip(set).zip(column("error_um")));
    time_s.len() == 50
        && rows.into_iter().all(|(sample, ((time_s, set), error_um))| {
            let [target, actual] = positions(sample);
            let second = f64::from(u32::try_from(sample).expect("few samples")) * 0.01;
            near(*time_s, second)
                && near(*set, target)
                && (error_um - 1000.0 * (target - actual)).abs() < 1e-5
        })
}

#[test]
fn settings_of_the_export_change_nothing() {
    let stamp = |sample| BEGIN + 100_000 * sample;
    let apart = "Name;SetPos;Name;ActPos\nSampleTime[ms];10;SampleTime[ms];10\nUnit;mm (Length);Unit;mm (Length)";
    let scope = "Name;Axis;\nFile;C:\\axis.csv;\nStarttime of export;133801416000000000\n\n";
    let comma = |value: f64| value.to_string().replace('.', ",");
    let variants = [
        ("stamps", export(SHARED, |n, [s, a]| format!("{};{s};{a}", stamp(n)), "EOF\n")),
        ("no end", export(SHARED, |n, [s, a]| format!("{};{s};{a}", stamp(n)), "")),
        ("blank lines", export(SHARED, |n, [s, a]| format!("{};{s};{a}", stamp(n)), "\nEOF\n\n")),
        ("milliseconds", export(SHARED, |n, [s, a]| format!("{};{s};{a}", 10 * n), "EOF")),
        ("no times", export(SHARED, |_, [s, a]| format!("{s};{a}"), "EOF")),
        (
            "times of their own",
            export(apart, |n, [s, a]| format!("{};{s};{};{a}", 10 * n, 10 * n), "EOF"),
        ),
        (
            "the name of the scope",
            export(&format!("{scope}{SHARED}"), |n, [s, a]| format!("{};{s};{a}", 10 * n), ""),
        ),
        (
            "decimal comma",
            export(SHARED, |n, [s, a]| format!("{};{};{}", 10 * n, comma(s), comma(a)), ""),
        ),
    ];
    for (name, text) in variants {
        assert!(is_whole(&read(&text)), "{name}:\n{text}");
        let found = read(&text.replace(';', "\t"));
        assert!(is_whole(&found), "{name}, tabs:\n{text}");
        let latency = found.recipe.get("channels", "latency_s");
        assert!(latency.is_none(), "{name}: samples of one instant are not shifted");
    }
}

/// A key before every channel tells where a name with blanks ends; without one nothing does.
#[test]
fn names_with_blanks_between_blanks() {
    let keyed = "Name Set Pos Name Act Pos\nSampleTime[ms] 10 SampleTime[ms] 10\nUnit mm (Length) Unit mm (Length)";
    let text = export(keyed, |n, [s, a]| format!("{t} {s} {t} {a}", t = 10 * n), "EOF");
    assert!(is_whole(&read(&text)), "{text}");
    let shared = "Name Set Pos Act Pos\nSampleTime[ms] 10 10";
    let text = export(shared, |n, [s, a]| format!("{} {s} {a}", 10 * n), "EOF");
    let source = Source { name: "scope.csv", bytes: text.as_bytes() };
    let error = propose(&[source], &Recipe::default()).expect_err("nothing tells the names");
    assert!(error.to_string().contains("read as `twincat`"), "{error}");
}

/// 100 ns are no rounding of an `f64` near 1.3e17, whose neighbours are 16 counts apart.
#[test]
fn stamps_are_exact() {
    let text = export(SHARED, |n, [s, a]| format!("{};{s};{a}", BEGIN + 100_001 * n), "EOF");
    let time_s = read(&text).table.column("time_s").expect("the table has it").to_vec();
    assert!((time_s[1] - 0.010_000_1).abs() < 1e-12 && (time_s[49] - 0.490_004_9).abs() < 1e-12);
}

/// Two exports, the second an hour later: their times lie an hour apart.
#[test]
fn stamps_lay_recordings_apart() {
    let later =
        |from: u64| export(SHARED, |n, [s, a]| format!("{};{s};{a}", from + 100_000 * n), "EOF");
    let texts = [later(BEGIN), later(BEGIN + 36_000_000_000)];
    let sources = [0, 1].map(|at: usize| Source { name: "scope.csv", bytes: texts[at].as_bytes() });
    let found = propose(&sources, &Recipe::default()).expect("both are whole");
    let time_s = found.table.column("time_s").expect("the table has it");
    assert!((time_s[50] - 3600.0).abs() < 1e-6, "{}", time_s[50]);
}

#[test]
fn notes_tell_what_became_of_channels() {
    let bytes = include_bytes!("samples/scope-rates.csv");
    let found = propose(&[Source { name: "scope-rates.csv", bytes }], &Recipe::default());
    let notes = found.expect("the sample is whole").notes;
    for told in [
        "straight between two samples: `Air Temperature [°C]`",
        "scale and offset of the scope are in them: `Air Temperature [°C]`",
        "left out, as they hold text: `Phase`",
    ] {
        assert!(notes.iter().any(|note| note.contains(told)), "{told}: {notes:?}");
    }
    let none = export(SHARED, |_, [s, a]| format!("{s};{a}"), "EOF");
    assert!(read(&none).notes.iter().any(|note| note.contains("sample times count the rows")));
}

/// Where nothing tells the time, a gap hides how long it is; a header without sample times, all of it.
#[test]
fn times_that_nothing_tells_are_refused() {
    let gap = |n: u64, [s, a]: [f64; 2]| if n == 9 { format!(";{a}") } else { format!("{s};{a}") };
    let untold = "Name;SetPos;ActPos\nStartRecord;1;1";
    let row = |_, [s, a]: [f64; 2]| format!("{s};{a}");
    for (text, expected) in [
        (export(SHARED, gap, ""), "scope.csv:15:1: found `1.2000000000000002` below an empty cell"),
        (export(untold, row, ""), "scope.csv:1:6: found no column of times, and no sample time"),
    ] {
        let source = Source { name: "scope.csv", bytes: text.as_bytes() };
        let error = propose(&[source], &Recipe::default()).expect_err("nothing tells the time");
        assert!(error.to_string().starts_with(expected), "{error}");
        assert!(error.to_string().contains("read as `twincat`"), "{error}");
    }
}
