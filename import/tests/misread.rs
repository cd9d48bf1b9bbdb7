//! What looks like one thing and is another: read as it is, asked for, refused, or told.

use helixlock_import::{Proposal, Recipe, Source, propose};

use crate::guesses::{asked, column, file, proposed, refused};

fn read(text: &str) -> Proposal {
    let proposal = proposed(text, "");
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    proposal
}

fn same(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "found {found}, expected {expected}");
}

/// The first run needs no number; what may be a mean of the runs is asked about.
#[test]
fn a_column_without_a_number_is_the_run_before_the_second() {
    let row = |row: u32| format!("{row}.0,1.{row},{row}.5,2.{row}");
    for header in [
        "Position [mm],Error [um],Run 2 Position [mm],Run 2 Error [um]",
        "position_mm,error_um,run2 position_mm,run2 error_um",
    ] {
        let proposal = read(&file(header, row));
        let at = |name: &str, row: usize| column(&proposal, name)[row];
        assert_eq!(proposal.table.rows(), 80, "{header}");
        for (place, pass, position, error) in [(3, 1.0, 3.0, 1.3), (43, 2.0, 3.5, 2.3)] {
            same(at("pass", place), pass);
            same(at("position_mm", place), position);
            same(at("error_um", place), error);
        }
    }
    let text = file("Position [mm],Run 1 Error [um],Run 2 Error [um],Error [um]", row);
    assert_eq!(asked(&text), ["column `Error [um]` names no run, as others of its kind do"]);
    let counted = read(&file("Position [mm],Run 0 Error [um],Run 1 Error [um]", |row| {
        format!("{row}.0,1.{row},2.{row}")
    }));
    same(column(&counted, "error_um")[43], 2.3);
}

/// Means and scatter stand on every sheet of ISO 230-2, and are no runs, whatever they are called.
#[test]
fn columns_that_sum_runs_up_are_left_out() {
    let runs = "Target [mm];1↑ [µm];1↓ [µm];2↑ [µm];2↓ [µm];3↑ [µm];3↓ [µm]";
    let row = |row: u32| {
        let at = f64::from(row);
        let up = [1.0, 1.4, 0.9].map(|um| um + 0.1 * libm::sin(at * (um + 2.0)) + at / 5.0);
        let down = up.map(|um| um - 0.8 - um / 9.0);
        let mean = |um: [f64; 3]| um.iter().sum::<f64>() / 3.0;
        let s = |um: [f64; 3]| {
            (um.iter().map(|one| (one - mean(um)).powi(2)).sum::<f64>() / 2.0).sqrt()
        };
        let each = (0..3).map(|run| format!("{:.2};{:.2}", up[run], down[run]));
        let each: Vec<String> = each.collect();
        (format!("{};{}", 50.0 * at, each.join(";")), [mean(up), mean(down), s(up), s(down)])
    };
    let alone = read(&file(runs, |at| row(at).0));
    assert_eq!(alone.table.rows(), 240);
    for (ways, sums) in [
        (["↑", "↓"], ["x̄", "s"]),
        (["↑", "↓"], ["Mean ", "Sigma "]),
        (["fwd", "rev"], ["Average ", "std dev "]),
        (["↑", "↓"], ["mean deviation ", "4s"]),
        (["↑", "↓"], ["Mittel ", "Streuung "]),
        // Named as nobody knows: what it holds says it.
        (["↑", "↓"], ["Quuux ", "Quux "]),
    ] {
        let [means, s] = sums.map(|sum| ways.map(|way| format!("{sum}{way} [µm]")).join(";"));
        let header = format!("{runs};{means};{s};B [µm]");
        let text = file(&header, |at| {
            let (runs, sums) = row(at);
            let sums: Vec<String> = sums.iter().map(|um| format!("{um:.3}")).collect();
            format!("{runs};{};{:.2}", sums.join(";"), 0.8)
        });
        let found = read(&text);
        assert!(found.table.columns == alone.table.columns, "{header}");
        let first = format!("first `{}{} [µm]`", sums[0], ways[0]);
        let note = format!("5 columns sum the runs up and are left out, {first}");
        assert!(found.notes.contains(&note), "{:?}", found.notes);
    }
}

/// A sheet of means alone: they were measured, their scatter was not.
#[test]
fn means_are_the_run_where_no_other_is() {
    let found =
        read(&file("Target [mm];Mean ↑ [µm];Mean ↓ [µm];s ↑ [µm];s ↓ [µm]", |row| {
            format!("{row},0;1,{row};0,{row};0,25;0,26")
        }));
    assert_eq!(found.table.rows(), 80);
    assert_eq!(found.notes.len(), 1, "{:?}", found.notes);
}

/// What an instrument writes below its table is no target.
#[test]
fn rows_that_sum_a_sheet_up_are_left_out() {
    for sums in ["x̄↑;1,5;2,5\ns↑;0,1;0,2\n", "Mean;1,5;2,5\nStreuung;0,1;0,2\n"] {
        let table =
            file("Target [mm];1↑ [µm];2↑ [µm]", |row| format!("{row},0;1,{row};2,{row}"));
        let found = read(&format!("{table}{sums}"));
        assert_eq!(found.table.rows(), 80, "{sums}");
        assert!(found.notes.iter().any(|note| note.ends_with("it sums the table up")));
    }
}

/// Target and actual beside an error show its sign, whatever it is called.
#[test]
fn the_sign_of_an_error_is_the_one_its_rows_show() {
    for (name, sign) in [("Error", -1.0), ("Error", 1.0), ("Deviation", -1.0), ("Deviation", 1.0)] {
        let row = |row: u32| {
            let [row, error] = [f64::from(row), f64::from(row * 7 % 11)];
            format!("{row},{},{}", row + error / 1000.0, sign * error)
        };
        let proposal = read(&file(&format!("Target [mm],Actual [mm],{name} [um]"), row));
        same(column(&proposal, "error_um")[1], -7.0);
    }
}

/// A day ends at midnight, a counter at its last bit, a circle after a turn: all go on from there.
#[test]
fn what_begins_anew_goes_on() {
    let clock = |minute: u32| format!("{:02}:{:02}:00", (23 + minute / 60) % 24, minute % 60);
    let forward =
        file("Time,Position [mm],Error [um]", |row| format!("{},{row}.5,0.{row}", clock(40 + row)));
    let reverse =
        file("Time,Position [mm],Error [um]", |row| format!("{},{row}.5,0.{row}", clock(80 - row)));
    let counter = |bits: u32| {
        let end = 1_u64 << bits;
        file("Time [ms],Position [mm],Error [um]", |row| {
            format!("{},{row}.5,0.{row}", (end - 9_500 + u64::from(row) * 1000) % end)
        })
    };
    let angle =
        file("Angle [deg],Error [arcsec]", |row| format!("{},0.{row}", (300 + 9 * row) % 360));
    for (text, name, last) in [
        (&forward, "time_s", 39.0 * 60.0),
        (&reverse, "time_s", -39.0 * 60.0),
        (&counter(16), "time_s", 39.0),
        (&counter(32), "time_s", 39.0),
        (&angle, "angle_rev", 39.0 * 9.0 / 360.0),
    ] {
        let values = column(&read(text), name);
        assert!((values[39] - values[0] - last).abs() < 1e-6, "{values:?}");
    }
    assert_eq!(
        read(&counter(16)).notes,
        ["`Time [ms]` begins anew at data.csv:12:1: counted on from 2^16"]
    );
    assert_eq!(
        read(&angle).notes,
        ["the angle begins anew at data.csv:9:1: counted on after a turn"]
    );
}

/// There and back over the end of a circle are at the same angles: each run is counted on by itself.
#[test]
fn an_angle_is_counted_on_within_its_run() {
    let text = file("Angle [deg],Error [arcsec],pass", |row| {
        let turned = if row < 20 { row } else { 39 - row };
        format!("{},0.{row},{}", (300 + 9 * turned) % 360, 1 + row / 20)
    });
    let angle = column(&read(&text), "angle_rev");
    same(angle[19], (300.0 + 9.0 * 19.0) / 360.0);
    same(angle[20], angle[19]);
    same(angle[39], angle[0]);
}

/// What a clock that goes back was cannot be known; that it does, and where, is told.
#[test]
fn a_clock_that_goes_back_is_told() {
    let log = |clock: &dyn Fn(u32) -> String| {
        let text = file("Timestamp,Position [mm],Error [um]", |row| {
            format!("{},{row}.5,0.{row}", clock(row))
        });
        read(&text).notes
    };
    let summer = log(&|row| format!("2026-10-25 02:{:02}:00", (45 + row) % 60));
    let twelve = log(&|row| {
        let minute = 20 + 2 * row;
        format!("{:02}:{:02}:00", [12, 1][(minute / 60) as usize], minute % 60)
    });
    let steady = log(&|row| format!("2026-10-25 02:{row:02}:00"));
    let runs = read(&file("time_s,position_mm,error_um,pass", |row| {
        format!("{},{}.5,0.{row},{}", row % 20, row % 20, 1 + row / 20)
    }));
    assert_eq!([steady, runs.notes], [[""; 0]; 2]);
    let why = "the end of summer time, which a zone with each time would tell";
    assert_eq!(
        summer,
        [format!("the time goes back once, first by 3540 s at data.csv:17:1: {why}")]
    );
    let why = "a clock of 12 hours, which `am` and `pm` would tell";
    let told = format!("the time goes back once, first by 43080 s at data.csv:22:1: {why}");
    assert_eq!(twelve, [told]);
}

/// `1:30` is half past one or a minute and a half; sixty times as much is asked for.
#[test]
fn times_with_one_colon_are_asked_about_unless_they_tell() {
    let log = |name: &str, time: &dyn Fn(u32) -> String| {
        file(&format!("{name},Position [mm],Error [um]"), |row| {
            format!("{},{row}.5,0.{row}", time(row))
        })
    };
    let half = |row: u32| format!("{}:{:02}", row / 2, 30 * (row % 2));
    let open = log("Time", &half);
    assert_eq!(asked(&open), ["`0:00` may be hours and minutes, or minutes and seconds"]);
    for (word, step_s) in [("minutes", 30.0), ("hours", 1800.0)] {
        let proposal = proposed(&open, &format!("[table]\nclock = \"{word}\""));
        assert!(proposal.questions.is_empty());
        same(column(&proposal, "time_s")[1], step_s);
    }
    for (text, step_s) in [
        (log("Time [m:ss]", &half), 30.0),
        (log("Time [hh:mm]", &half), 1800.0),
        (log("Uhrzeit", &half), 1800.0),
        (log("Time", &|row| format!("{}:{:02}", (23 + row / 30) % 24, 2 * (row % 30))), 120.0),
        (log("Time", &|row| format!("59:{row:02}")), 1.0),
        (log("Time", &|row| format!("5:{row:02}.5")), 1.0),
    ] {
        same(column(&read(&text), "time_s")[1], step_s);
    }
}

/// No column and no block of a table is lost, or read under another's name.
#[test]
fn a_table_is_read_whole_or_not_at_all() {
    let commas = file("Position [mm],Error [um]", |row| format!("{row},5,0,{row}"));
    let longer = file("Position [mm],Error [um]", |row| format!("{row}.0,0.{row}"))
        + &file("Position [mm],Error [um],Temp [C]", |row| format!("{row}.0,0.{row},20"));
    for (text, start) in [
        (
            &commas,
            "data.csv:2:5: found rows of 4 cells below 2 names, expected a name for every cell",
        ),
        (
            &longer,
            "data.csv:2: found 40 rows of 2 numbers above another table, expected one table a file",
        ),
    ] {
        let message = refused(text, "");
        assert!(message.starts_with(start), "{message}");
    }
    let below = proposed(&longer, "[table]\npreamble = 41");
    assert_eq!(below.table.rows(), 40);
    let mean =
        file("Position [mm],Error [um]", |row| format!("{row}.0,{}", row % 2)) + "\n19.5,0.5\n";
    assert_eq!(read(&mean).table.rows(), 40);
}

/// A unit that is two, and a name that says ten times: what the numbers are is asked.
#[test]
fn units_with_two_meanings_are_asked_about() {
    let row = |row: u32| format!("{row},{row}.5");
    for (header, question) in [
        ("Angle [grad],Error [arcsec]", "`grad` of column `Angle [grad]` is degree or gon"),
        (
            "Position [mm],Error x10 [um]",
            "the name of column `Error x10 [um]` has a factor in it, 10",
        ),
        (
            "Position [mm],Error*100 [um]",
            "the name of column `Error*100 [um]` has a factor in it, 100",
        ),
    ] {
        let text = file(header, row);
        let open = proposed(&text, "");
        let [asked] = open.questions.as_slice() else { panic!("{:?}", open.questions) };
        assert_eq!(asked.text, question);
        let answered = proposed(&text, &asked.answers[0].recipe);
        assert!(answered.questions.is_empty(), "{:?}", answered.questions);
    }
    for header in ["Angle [gon],Error [mgon]", "Position x1 [mm],Error [um]"] {
        assert_eq!(asked(&file(header, row)), [""; 0], "{header}");
    }
    let grad = "[[column]]\nfrom = \"Angle\"\nunit = \"grad\"";
    let counts = grad.replace("grad", "counts");
    for (recipe, hint) in [(grad, "`gon` of 400 a turn"), (&counts, "`unit = \"1/4096 rev\"`")] {
        let message = refused(&file("Angle,Error [arcsec]", row), recipe);
        assert!(message.contains(hint), "{message}");
    }
}

/// Directions are 1 and -1, whatever numbers a file has for them; the positions show which is which.
#[test]
fn directions_in_other_numbers_are_told_by_the_positions() {
    let table = |way: &dyn Fn(u32) -> u32, position: &dyn Fn(u32) -> u32| {
        file("Position [mm],Error [um],Direction", |row| {
            format!("{},0.{row},{}", position(row), way(row))
        })
    };
    let there_and_back = |row: u32| if row < 20 { row } else { 40 - row };
    for (there, back) in [(1, 2), (1, 0), (2, 1)] {
        let way = |row| if row < 20 { there } else { back };
        let proposal = read(&table(&way, &there_and_back));
        let found = column(&proposal, "direction");
        assert_eq!([found[3], found[30]].map(f64::to_bits), [1.0_f64, -1.0].map(f64::to_bits));
        assert_eq!(proposal.notes, [format!("direction `{back}` is back, as the positions go")]);
        let message = refused(&table(&way, &|row| row), "");
        let start = "data.csv:";
        let end = "which the positions do not tell, expected 1, -1, or a word for it\n\nhint: `to = \"none\"` leaves the column out";
        assert!(message.starts_with(start) && message.ends_with(end), "{message}");
    }
}

/// Words that name no direction are told by the positions as well, where there are two of them.
#[test]
fn directions_in_other_words_are_told_by_the_positions() {
    let table = |ways: [&str; 2], position: &dyn Fn(u32) -> u32| {
        file("Position [mm],Error [um],Direction", |row| {
            format!("{},0.{row},{}", position(row), ways[usize::from(20 <= row)])
        })
    };
    let there_and_back = |row: u32| if row < 20 { row } else { 40 - row };
    for ways in [["CW", "CCW"], ["U", "D"], ["aller", "retour"], ["+", "back again"]] {
        let proposal = read(&table(ways, &there_and_back));
        let found = column(&proposal, "direction");
        assert_eq!([found[3], found[30]].map(f64::to_bits), [1.0_f64, -1.0].map(f64::to_bits));
        assert_eq!(
            proposal.notes,
            [format!("direction `{}` is back, as the positions go", ways[1])]
        );
        let message = refused(&table(ways, &|row| row), "");
        assert!(message.contains("which the positions do not tell"), "{message}");
    }
    let message = refused(&table(["CW", "CCW"], &there_and_back).replace("0.7,CW", "0.7,stop"), "");
    assert!(message.contains("expected a direction: 1, -1, or a word for it"), "{message}");
}

/// A column that is there and cannot be read is named, with a cell of it.
#[test]
fn what_is_no_number_is_named() {
    for (cell, row) in [("0.1(2)", "0.{}(2)"), ("0.1±0.05", "0.{}±0.05"), ("0x1", "0x{}")] {
        let text = file("Position [mm],Error [um]", |index| {
            format!("{index}.0,{}", row.replace("{}", &(index + 1).to_string()))
        });
        let message = refused(&text, "");
        let hint = format!("hint: column `Error [um]` holds words, first `{cell}` at data.csv:2:5");
        assert!(message.ends_with(&hint), "{message}");
        let beside =
            file("Position [mm],Load,Error [um]", |index| format!("{index}.0,{index}.5,0x{index}"));
        let question = "no column is known as the measured error, and `Error [um]` holds words";
        assert_eq!(asked(&beside), [question]);
    }
    for text in ["{\"error_um\": [1, 2]}", "[{\"error_um\": 1}]", " [[1, 2], [3, 4]]", "[1, 2]"] {
        let message = refused(text, "");
        assert!(message.starts_with("data.csv: found JSON, expected a table"), "{message}");
    }
}

/// A lone µ is the Latin-1 of a German instrument; Chinese has characters side by side.
#[test]
fn single_letters_beyond_ascii_are_western() {
    for header in
        ["Position [mm];Abweichung [µm]", "Größe;Position [mm];Abweichung [µm];Temperatur [°C]"]
    {
        let cells = header.matches(';').count();
        let text = file(header, |row| format!("{row},5{}", format!(";0,{row}").repeat(cells)));
        let latin = |c: char| u8::try_from(u32::from(c)).expect("a character of Latin-1");
        let bytes: Vec<u8> = text.chars().map(latin).collect();
        let proposal = propose(&[Source { name: "data.csv", bytes: &bytes }], &Recipe::default());
        let proposal = proposal.unwrap_or_else(|error| panic!("{error}"));
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        same(column(&proposal, "error_um")[1], -0.1);
    }
}

/// Arrays that are no columns are named, and infinity is no missing value.
#[test]
fn arrays_that_are_no_numbers_are_named() {
    let read = |name, bytes: &[u8]| propose(&[Source { name, bytes }], &Recipe::default());
    let mode = read("enumeration.h5", include_bytes!("samples/enumeration.h5"));
    let mode = mode.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(mode.notes[0], "1 columns that hold no numbers are left out, first `mode`");
    let complex = read("complex.mat", include_bytes!("refused/complex.mat")).expect_err("no error");
    assert!(complex.to_string().ends_with("hint: `error_um` holds complex numbers"), "{complex}");
    let infinity =
        read("infinity.mat", include_bytes!("refused/infinity.mat")).expect_err("no number");
    let start = "infinity.mat: sheet `arrays`, cell B6: found `inf` in column `error_um`";
    assert!(infinity.to_string().starts_with(start), "{infinity}");
}

/// A table on its side has a line a column: no row of it is a reading.
#[test]
fn a_table_on_its_side_is_said_to_be() {
    let line = |name: &str, cells: u32| {
        (0..cells).fold(name.to_owned(), |line, cell| format!("{line},{cell}.5")) + "\n"
    };
    for (cells, found) in [
        (40, "2 rows that each begin with a name, expected a row of names"),
        (16_384, "2 rows of 16385 columns, expected up to 4096 columns"),
    ] {
        let text = line("Angle [deg]", cells) + &line("Error [arcsec]", cells);
        let hint = "it lies on its side: turn it, so that each row is a reading";
        assert_eq!(refused(&text, ""), format!("data.csv:1: found {found}\n\nhint: {hint}"));
    }
}

/// What a rule calls a column is one of ours, `none`, or a name that nobody takes for either.
#[test]
fn a_slip_in_the_name_of_a_column_is_refused() {
    let text = file("Position [mm],Error [um],Load", |row| format!("{row}.0,0.{row},{row}.5"));
    let rule = |to: &str| format!("[[column]]\nfrom = \"Load\"\nto = \"{to}\"");
    for slip in ["ignore", "skip", "error", "eror_um", "positon_mm", "air_temprature_c"] {
        let message = refused(&text, &rule(slip));
        let start = format!("given:1:1: found `to = \"{slip}\"`, expected one of `time_s`, ");
        let end = "hint: `to = \"none\"` leaves a column out";
        assert!(message.starts_with(&start) && message.ends_with(end), "{message}");
    }
    for name in ["load", "motor_load", "force_x", "mass", "target"] {
        assert!(proposed(&text, &rule(name)).table.column(name).is_some(), "{name}");
    }
    assert!(proposed(&text, &rule("none")).table.column("load").is_none());
    let twice =
        file("Error [um],Fehler [um],Position [mm]", |row| format!("0.{row},1.{row},{row}.5"));
    let question =
        "`Error [um]`, `Fehler [um]` may be `error_um` each; `to = \"none\"` leaves a column out";
    assert_eq!(asked(&twice), [question]);
}
