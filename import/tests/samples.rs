//! Every sample becomes the table it stands for, and its recipe does that again.

use std::path::Path;

use expect_test::expect_file;
use helixlock_import::{Recipe, Source, apply, propose};
use helixlock_traces::Table;
use helixlock_traces::csv::write_csv;

fn csv(table: &Table) -> String {
    let mut bytes = Vec::new();
    write_csv(table, &mut bytes).expect("the sample is whole");
    String::from_utf8(bytes).expect("the sample is whole")
}

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/samples").join(name))
        .expect("the sample is whole")
}

/// Recipe and table by what is given, held to a file; the recipe replays to the same bytes.
fn check(name: &str, given: &str) -> Table {
    let bytes = bytes(name);
    let sources = [Source { name, bytes: &bytes }];
    let given = Recipe::parse(given, "given").expect("the sample is whole");
    let proposal = propose(&sources, &given).unwrap_or_else(|error| panic!("{error}"));
    let asked: Vec<_> = proposal.questions.iter().map(ToString::to_string).collect();
    assert!(asked.is_empty(), "{name}: {}", asked.join("\n"));
    let recipe = proposal.recipe.to_string();
    let table = csv(&proposal.table);
    expect_file![format!("expected/{name}.txt")].assert_eq(&format!("{recipe}\n{table}"));
    let again = Recipe::parse(&recipe, "recipe").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(again.to_string(), recipe, "{name}: the recipe reads back");
    assert_eq!(
        csv(&apply(&sources, &again).expect("the sample is whole")),
        table,
        "{name}: the recipe replays"
    );
    proposal.table
}

#[test]
fn samples_that_leave_nothing_open() {
    for name in [
        "german.csv",
        "chinese-gbk.csv",
        "chinese-utf16.txt",
        "runs-as-columns.csv",
        "runs-apart.csv",
        "target-actual.txt",
        "zones.csv",
        "date-and-clock.csv",
        "blocks.txt",
        "missing.csv",
        "laser.rtl",
        "keysight.pos",
        "iso230.dat",
        "iso230.md",
        "guide-log.txt",
        "record.npy",
        "workbook.xlsx",
        "sheet.ods",
        "worm.pec",
        "stepper.sr",
        "session.mat",
        "session73.mat",
        "session.feather",
        "logger.h5",
        "packed.h5",
        "structure.mat",
        "table.h5",
        "report.md",
        "scope-stamps.csv",
        "scope-rates.csv",
    ] {
        check(name, "");
    }
}

#[test]
fn samples_that_need_an_answer_ask_for_it() {
    for (name, answer) in [
        ("screw.comp", "[calibration]\nunit = \"mm\""),
        (
            "halsampler.txt",
            "[halsampler]\nperiod_s = 0.001\n[[column]]\nfrom = \"pin.0\"\nto = \"position_mm\"\nunit = \"mm\"\n[[column]]\nfrom = \"pin.1\"\nto = \"error_um\"\nunit = \"mm\"",
        ),
        ("debug-log.txt", "[phd2]\nscale_arcsec = 1.9"),
        (
            "plain.mat",
            "[[column]]\nfrom = \"trace 1\"\nto = \"position_mm\"\nunit = \"mm\"\n[[column]]\nfrom = \"trace 2\"\nto = \"error_um\"\nunit = \"um\"",
        ),
        (
            "array.npy",
            "[[column]]\nfrom = \"column 1\"\nto = \"time_s\"\nunit = \"s\"\n[[column]]\nfrom = \"column 2\"\nto = \"error_um\"\nunit = \"um\"",
        ),
        (
            "camonitor.log",
            "[[column]]\nfrom = \"IOC:m1-PosSet\"\nunit = \"mm\"\n[[column]]\nfrom = \"IOC:enc1-PosAct\"\nunit = \"mm\"",
        ),
        (
            "servo.csv",
            "[[column]]\nfrom = \"Goal Position\"\nto = \"angle_rev\"\nunit = \"1/4096 rev\"\n[[column]]\nfrom = \"Present Position\"\nto = \"error_arcsec\"\nunit = \"1/4096 rev\"",
        ),
        (
            "scope.csv",
            "[[column]]\nfrom = \"SetPos\"\nunit = \"mm\"\n[[column]]\nfrom = \"ActPos\"\nunit = \"mm\"",
        ),
    ] {
        let bytes = bytes(name);
        let open = propose(&[Source { name, bytes: &bytes }], &Recipe::default())
            .expect("the sample is whole");
        assert!(!open.questions.is_empty(), "{name} is read without an answer");
        check(name, answer);
    }
}

/// A guider that is switched off leaves half a row; what stood before it is whole.
#[test]
fn a_guide_log_that_ends_within_a_row_is_read_up_to_it() {
    let all = bytes("guide-log.txt");
    let end = all.windows(12).rposition(|part| part == b"20,64.000,\"M");
    let end = end.expect("the last row") + 20;
    let read = |bytes: &[u8]| {
        let sources = [Source { name: "guide-log.txt", bytes }];
        propose(&sources, &Recipe::default()).expect("the sample is whole")
    };
    let (whole, cut) = (read(&all), read(&all[..end]));
    assert_eq!(cut.table.rows() + 1, whole.table.rows());
    let said = |proposal: &helixlock_import::Proposal, note: &str| {
        proposal.notes.iter().any(|known| known.contains(note))
    };
    assert!(said(&cut, "ends in the middle") && !said(&whole, "ends in the middle"));
    assert!(said(&whole, "at a declination of 5.2°"));
    let newer = String::from_utf8(all).expect("the sample is whole");
    let newer = newer.replace("Dec = 5.2 deg", "RA = 20.34 hr, Dec = 45.9 deg");
    assert!(said(&read(newer.as_bytes()), "at a declination of 45.9°"));
}

/// Forty steps forward and 25 back, five samples of a millisecond each.
#[test]
fn steps_of_a_session_are_counted_with_their_direction() {
    let table = check("stepper.sr", "");
    let column = |name: &str| table.column(name).expect("the sample is whole");
    let (time_s, steps) = (column("time_s"), column("steps"));
    assert_eq!((steps.len(), steps[39], steps[64]), (65, 40.0, 15.0));
    assert!((time_s[64] - 0.323).abs() < 1e-12, "{}", time_s[64]);
}

/// Counts of a servo, 4096 a turn: 3 behind on the way there, 2 ahead on the way back.
#[test]
fn a_position_called_an_error_is_held_against_its_target() {
    let given = "[[column]]\nfrom = \"Goal Position\"\nto = \"angle_rev\"\nunit = \"1/4096 rev\"\n[[column]]\nfrom = \"Present Position\"\nto = \"error_arcsec\"\nunit = \"1/4096 rev\"";
    let table = check("servo.csv", given);
    let error = table.column("error_arcsec").expect("the sample is whole");
    let count = 1_296_000.0 / 4096.0;
    assert!((error[3] - 3.0 * count).abs() < 1e-9 && (error[20] + 2.0 * count).abs() < 1e-9);
}

/// Both ways of a report lie under one header; their headings tell which is which.
#[test]
fn headings_of_a_report_tell_the_way() {
    let table = check("report.md", "");
    let direction = table.column("direction").expect("the headings tell it");
    assert_eq!(direction.iter().filter(|way| **way < 0.0).count(), 8);
    let error = table.column("error_um").expect("the sample is whole");
    assert!((error[0] + 1.3).abs() < 1e-9 && (error[8] - 1.7).abs() < 1e-9);
}

/// The two encodings of one Chinese table give one table.
#[test]
fn encodings_change_nothing() {
    let table = |name| csv(&check(name, ""));
    assert_eq!(table("chinese-gbk.csv"), table("chinese-utf16.txt"));
}

/// 68 °F are 20 °C, 760 mmHg are 1013.25 hPa, 1.5 inch are 38.1 mm, 10 nm are 0.01 µm.
#[test]
fn units_are_ours_in_the_end() {
    let table = check("zones.csv", "");
    let first = |name: &str| table.column(name).expect("the sample is whole")[1];
    assert!((first("position_mm") - 38.1).abs() < 1e-12);
    assert!((first("error_um") - 0.01).abs() < 1e-12);
    assert!((first("air_temperature_c") - 20.005_555_6).abs() < 1e-6);
    assert!((first("air_pressure_hpa") - 1013.25).abs() < 1e-3);
}

/// A deviation of +0.4 µm is a table that is ahead: the recorder shows −0.4 µm.
#[test]
fn deviations_turn_their_sign() {
    let table = check("laser.rtl", "");
    assert_eq!(
        table.column("error_um").expect("the sample is whole")[0].to_bits(),
        (-0.4_f64).to_bits()
    );
    assert_eq!(table.column("pass").expect("the sample is whole")[5].to_bits(), 1.0_f64.to_bits());
    assert_eq!(
        table.column("direction").expect("the sample is whole")[5].to_bits(),
        (-1.0_f64).to_bits()
    );
}

/// Sessions began at 23:58:30 and 00:03:10 of the next day: 280 s.
#[test]
fn sessions_lie_apart_by_their_clock() {
    let table = check("guide-log.txt", "");
    let time = table.column("time_s").expect("the sample is whole");
    assert!((time[20] - time[0] - 280.0).abs() < 1e-9);
    assert!(
        table.column("error_arcsec").expect("the sample is whole")[4].is_nan(),
        "a lost star leaves a gap"
    );
    let passes: Vec<f64> = table.column("pass").expect("the sample is whole").to_vec();
    assert!((passes[39] - 4.0).abs() < 0.5, "a dither and a session begin a pass each");
}

/// The samples were made with these latencies.
#[test]
fn latencies_are_found_and_said() {
    for (name, latency_s) in [("camonitor.log", 0.25), ("scope.csv", 0.1)] {
        let bytes = bytes(name);
        let found = propose(&[Source { name, bytes: &bytes }], &Recipe::default())
            .expect("the sample is whole");
        let Some(helixlock_import::Value::Number(latency)) =
            found.recipe.get("channels", "latency_s")
        else {
            panic!("{name}: no latency")
        };
        assert!((latency.abs() - latency_s).abs() < 0.005, "{name}: {latency}");
        assert!(found.notes.iter().any(|note| note.contains("earlier")), "{:?}", found.notes);
    }
}

/// Runs of several files are counted through.
#[test]
fn files_of_one_kind_become_one_table() {
    let one = bytes("laser.rtl");
    let source = Source { name: "laser.rtl", bytes: &one };
    let table = propose(&[source, source], &Recipe::default()).expect("the sample is whole").table;
    assert_eq!(table.rows(), 40);
    assert_eq!(table.column("pass").expect("the sample is whole")[39].to_bits(), 4.0_f64.to_bits());
}

/// The real logs of the examples, against the script that used to make their tables.
#[test]
fn guide_logs_are_what_the_examples_have() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/real-worm-drive");
    for name in ["performance_dataset03", "performance_dataset04", "performance_dataset07"] {
        let log =
            std::fs::read(folder.join(format!("logs/{name}.txt"))).expect("the sample is whole");
        let table = propose(&[Source { name, bytes: &log }], &Recipe::default())
            .expect("the sample is whole")
            .table;
        let known = helixlock_traces::read_table(&folder.join(format!("{name}.csv")))
            .expect("the sample is whole");
        for column in ["time_s", "error_arcsec", "pass"] {
            let pairs = table
                .column(column)
                .expect("the sample is whole")
                .iter()
                .zip(known.column(column).expect("the sample is whole"));
            assert!(pairs.clone().all(|(a, b)| (a - b).abs() < 1.5e-4 || a.is_nan() && b.is_nan()));
            assert_eq!(pairs.count(), known.rows());
        }
    }
}
