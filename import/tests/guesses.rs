//! What a file does not tell is asked for: nothing is read a thousand times too small.

use helixlock_import::{Proposal, Recipe, Source, propose};

/// A table of forty rows.
pub(crate) fn file(header: &str, row: impl Fn(u32) -> String) -> String {
    let rows: Vec<String> = (0..40).map(|index| row(index) + "\n").collect();
    format!("{header}\n{}", rows.concat())
}

pub(crate) fn proposed(text: &str, recipe: &str) -> Proposal {
    let recipe = Recipe::parse(recipe, "given").expect("a recipe");
    let source = Source { name: "data.csv", bytes: text.as_bytes() };
    propose(&[source], &recipe).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn refused(text: &str, recipe: &str) -> String {
    let recipe = Recipe::parse(recipe, "given").expect("a recipe");
    let source = Source { name: "data.csv", bytes: text.as_bytes() };
    propose(&[source], &recipe).expect_err("it cannot be read").to_string()
}

pub(crate) fn asked(text: &str) -> Vec<String> {
    proposed(text, "").questions.into_iter().map(|question| question.text).collect()
}

pub(crate) fn column(proposal: &Proposal, name: &str) -> Vec<f64> {
    proposal.table.column(name).unwrap_or_else(|| panic!("no {name}")).to_vec()
}

/// Ten millimetres or ten metres: three digits behind a mark tell nothing, whichever mark it is.
#[test]
fn a_mark_before_three_digits_is_asked_for() {
    let row = |index: u32| format!("{}.000;{}.125", 10 + index, 1 + index % 7);
    let points = file("Position [mm];Fehler [µm]", row);
    let commas = points.replace('.', ",");
    for (text, mark) in [(&points, "10.000"), (&commas, "10,000")] {
        let question =
            format!("`{mark}` may be a fraction or thousands, and nothing in the file tells which");
        assert_eq!(asked(text), [question]);
        let first = |sign: &str| {
            let proposal = proposed(text, &format!("[text]\ndecimal = \"{sign}\""));
            assert!(proposal.questions.is_empty(), "{mark} {sign}");
            column(&proposal, "position_mm")[0].to_bits()
        };
        let (fraction, thousands) = if mark.contains('.') { (".", ",") } else { (",", ".") };
        assert_eq!(first(fraction), 10.0_f64.to_bits());
        assert_eq!(first(thousands), 10_000.0_f64.to_bits());
    }
}

/// One number that cannot be grouped tells for all of them.
#[test]
fn a_fraction_without_a_whole_part_tells_the_decimal_sign() {
    let row = |index: u32| format!("{},000;0,{:03}", 10 + index, 125 + index);
    let commas = file("Position [mm];Fehler [µm]", row);
    for (text, sign) in [(commas.clone(), ","), (commas.replace(',', "."), ".")] {
        let proposal = proposed(&text, "");
        assert!(proposal.questions.is_empty(), "{sign}: {:?}", proposal.questions);
        assert_eq!(column(&proposal, "error_um")[0].to_bits(), 0.125_f64.to_bits());
        assert_eq!(column(&proposal, "position_mm")[0].to_bits(), 10.0_f64.to_bits());
    }
}

/// What reads with either mark is no evidence for one of them.
#[test]
fn numbers_that_read_either_way_count_for_neither_mark() {
    let text = file("Position [mm];Error [um]", |row| format!("{row}.125;0.{row}"));
    let recipe = proposed(&text, "").recipe.to_string();
    let decided = "decimal = \".\" # 41 numbers read only with a point, 0 only with a comma";
    assert!(recipe.contains(decided), "{recipe}");
}

/// A set point of a temperature is no position, unless its name has a unit of length.
#[test]
fn a_target_beside_a_temperature_of_its_name_is_no_position() {
    let row = |row: u32| format!("{row},0.{row},100.5,100.0");
    for name in ["he_t", "he temp", "he [°C]"] {
        let text = file(&format!("Time [s],Error [um],{name},he_target"), row);
        let proposal = proposed(&text, "");
        assert!(proposal.questions.is_empty(), "{name}: {:?}", proposal.questions);
        assert!(proposal.table.column("he_target").is_some(), "{name}");
    }
    let drift = file("Time [s],mcu_pos_z,he_t,he_target", |row| format!("{row},-{row},100.5,100"));
    let labels = proposed(&drift, "").questions.into_iter().flat_map(|question| question.answers);
    assert!(labels.into_iter().any(|answer| answer.label == "`mcu_pos_z` is `error_um`"));
    for (name, target) in [("he_t", "he_target_mm"), ("xy_t", "he_target [mm]")] {
        let text = file(&format!("Time [s],Error [um],{name},{target}"), row);
        assert!(proposed(&text, "").table.column("position_mm").is_some(), "{target}");
    }
}

/// A second column of times is kept, and never offered as the error or the position.
#[test]
fn a_time_is_not_offered_as_the_error() {
    let text = file("time (min),time (hr),x [px]", |row| format!("{row},0.{row},1.{row}"));
    let proposal = proposed(&text, "");
    let labels = |at: usize| {
        let answers = proposal.questions[at].answers.iter();
        answers.map(|answer| answer.label.as_str()).collect::<Vec<_>>()
    };
    assert_eq!(labels(0), ["`time (min)` is `time_s`", "`time (hr)` is `time_s`"]);
    assert_eq!(labels(1), ["`x [px]` is `error_um`"]);
}

/// Units of time as people write them.
#[test]
fn a_time_may_have_its_unit_in_many_spellings() {
    for (spellings, scale) in [
        ("h hr hrs hour hours", 3600.0),
        ("min mins minute minutes", 60.0),
        ("s sec secs second seconds", 1.0),
        ("ms msec msecs millisec millisecs millisecond milliseconds", 1e-3),
        ("us µs usec usecs µsec microsec microsecs microsecond microseconds", 1e-6),
    ] {
        for unit in spellings.split(' ') {
            let text = file(&format!("time ({unit}),Error [um]"), |row| format!("{row}.5,0.{row}"));
            let times = column(&proposed(&text, ""), "time_s");
            assert!((times[1] - 1.5 * scale).abs() < 1e-9 * scale, "{unit}: {}", times[1]);
        }
    }
}

/// Steps of a motor have no unit of their own; a multiple of one is offered, and told where one is wrong.
#[test]
fn a_multiple_of_a_unit_is_offered_for_counts() {
    let text = file("Position,Error [um]", |row| format!("{row},0.{row}"));
    let proposal = proposed(&text, "");
    let offered = "[[column]]\nfrom = \"Position\"\nunit = \"2.5 um\"";
    assert!(proposal.questions[0].answers.iter().any(|answer| answer.recipe == offered));
    let position = column(&proposed(&text, offered), "position_mm");
    assert_eq!(position[2].to_bits(), 0.005_f64.to_bits());
    let message = refused(&text, &offered.replace("2.5 um", "steps"));
    assert!(message.contains("`unit = \"2.5 um\"`"), "{message}");
    let broken = text.replace(",0", ".5,0");
    let labels = proposed(&broken, "").questions.remove(0).answers;
    assert!(labels.iter().all(|answer| !answer.label.contains("counts")));
}

/// Rows below a table that sum it up are no data, and are told of; units know no case.
#[test]
fn what_sums_a_table_up_is_left_out() {
    let header = "Position [mm];Fehler [um];Temp. Werkstück [c];Luftdruck [HPA]";
    let table = file(header, |index| format!("{}.5;1.5;20.5;1013.5", 10 * index));
    let whole = proposed(&table, "");
    let proposal =
        proposed(&format!("{table}\nMittelwert:;1.5;20.5;1013.5\nMax;1.5;20.5;1013.5\n"), "");
    assert_eq!(format!("{:?}", proposal.table), format!("{:?}", whole.table));
    assert_eq!(
        proposal.notes,
        ["left out below the table, from `Mittelwert:` on: it sums the table up"]
    );
    for name in ["workpiece_temperature_c", "air_pressure_hpa"] {
        assert!(proposal.table.column(name).is_some(), "{name}");
    }
}

/// A counter of rows in the column of the runs would take every reading for a run of its own.
#[test]
fn a_counter_of_rows_is_no_run() {
    for name in ["Run", "pass", "Durchgang"] {
        let header = format!("Position (mm),Error (um),{name}");
        let text = file(&header, |index| format!("{},{},{index}", 10 * index, index % 7));
        let proposal = proposed(&text, "");
        assert!(proposal.table.column("pass").is_none(), "{name}");
        let rule = proposal.recipe.column(name).expect("a rule for each");
        assert_eq!(
            (rule.to.as_deref(), rule.reason.as_str()),
            (Some("none"), "it counts the rows")
        );
        let given = format!("[[column]]\nfrom = \"{name}\"\nto = \"pass\"");
        let message = refused(&text, &given);
        let start = format!("data.csv:1: found a run for almost every row in column `{name}`");
        assert!(message.starts_with(&start), "{message}");
        let runs = file(&header, |index| format!("{},{},{}", 10 * index, index % 7, index / 20));
        assert_eq!(column(&proposed(&runs, ""), "pass")[39].to_bits(), 1.0_f64.to_bits(), "{name}");
    }
}

/// A rule for a column that is not there would be lost with its sign.
#[test]
fn a_rule_for_no_column_is_refused() {
    let text = file("Position (mm),Error (um)", |index| format!("{},{}", 10 * index, index % 7));
    let wrong = "[text]\ndecimal = \".\"\n[[column]]\nfrom = \"Eror (um)\"\nsign = -1\n";
    assert_eq!(
        refused(&text, wrong),
        "given:3:1: found `from` with `Eror (um)`, which no file has as a column, expected one of \
         `Position (mm)`, `Error (um)`"
    );
    let left_out = wrong.replace("sign = -1", "to = \"none\"");
    assert!(proposed(&text, &left_out).questions.is_empty());
    let bytes = include_bytes!("samples/laser.rtl");
    let rule = Recipe::parse("[[column]]\nfrom = \"Error\"\nsign = -1", "given").expect("a recipe");
    let error = propose(&[Source { name: "laser.rtl", bytes }], &rule).expect_err("no column");
    assert!(
        error
            .to_string()
            .ends_with("expected no `[[column]]`, as the format has no columns to name")
    );
    let right = wrong.replace("Eror", "Error");
    assert_eq!(column(&proposed(&text, &right), "error_um")[3].to_bits(), (-3.0_f64).to_bits());
}

/// Grams in a cubic metre, grams in a kilogram and dew points are between 1 and 100, too.
#[test]
fn only_a_plain_humidity_is_taken_as_relative() {
    let with = |header: &str, divisor: u32| {
        let row = |index: u32| {
            let humidity = f64::from(40 + index % 9) / f64::from(divisor);
            format!("{},{},{humidity}", 10 * index, index % 7)
        };
        file(&format!("Position (mm),Error (um),{header}"), row)
    };
    for header in [
        "Humidity (g/m³)",
        "Humidity [g/kg]",
        "Humidity (dew point °C)",
        "absolute humidity",
        "Humidity g/m3",
        "绝对湿度",
    ] {
        let text = with(header, 4);
        let asked = asked(&text);
        assert_eq!(asked, [format!("the unit of column `{header}` is not told")], "{header}");
        let left_out = format!("[[column]]\nfrom = \"{header}\"\nto = \"none\"");
        assert!(proposed(&text, &left_out).table.column("humidity_pct").is_none(), "{header}");
    }
    for header in
        ["Humidity", "humidity 2", "Luftfeuchte", "相对湿度", "RH (%)", "rel. Feuchte / %"]
    {
        let proposal = proposed(&with(header, 1), "");
        assert!(proposal.questions.is_empty(), "{header}: {:?}", proposal.questions);
        assert_eq!(column(&proposal, "humidity_pct")[0].to_bits(), 40.0_f64.to_bits(), "{header}");
    }
    let text = with("Humidity (%)", 100);
    assert_eq!(asked(&text), ["column `Humidity (%)` is in %, and nowhere above 1"]);
    for (unit, value) in [("ratio", 40.0_f64), ("%", 0.4)] {
        let given = format!("[[column]]\nfrom = \"Humidity (%)\"\nunit = \"{unit}\"");
        assert_eq!(column(&proposed(&text, &given), "humidity_pct")[0].to_bits(), value.to_bits());
    }
}

/// Nines where a logger had nothing are asked about; a counter that passes 999 is not.
#[test]
fn nines_far_from_all_others_are_asked_about() {
    let text = file("Position [mm],Error [um],Count", |row| {
        let error = if row % 9 == 4 { "-999.0".into() } else { format!("0.{row}") };
        format!("{row},{error},{}", 980 + row)
    });
    let proposal = proposed(&text, "");
    let [question] = proposal.questions.as_slice() else { panic!("{:?}", proposal.questions) };
    assert_eq!(
        question.text,
        "`-999.0` stands 4 times in column `Error [um]`, and no other value comes near it"
    );
    let missing = |answer: usize| {
        let proposal = proposed(&text, &question.answers[answer].recipe);
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        column(&proposal, "error_um").iter().filter(|value| value.is_nan()).count()
    };
    assert_eq!([missing(0), missing(1)], [4, 0]);
}

/// Packed numbers are what their attributes make of them; a recipe can have them as they are.
#[test]
fn packed_arrays_are_unpacked_and_the_recipe_says_so() {
    let bytes = include_bytes!("samples/packed.h5");
    let read = |recipe: &str| {
        let recipe = Recipe::parse(recipe, "given").expect("a recipe");
        let proposal = propose(&[Source { name: "packed.h5", bytes }], &recipe);
        proposal.unwrap_or_else(|error| panic!("{error}"))
    };
    let (unpacked, packed) = (read(""), read("[arrays]\nunpacked = []"));
    let line = "unpacked = [\"error_um\"] # scale_factor 0.001, add_offset 0";
    assert!(unpacked.recipe.to_string().contains(line), "{}", unpacked.recipe);
    let (unpacked, packed) = (column(&unpacked, "error_um"), column(&packed, "error_um"));
    assert!(packed.iter().any(|value| 100.0 < value.abs()));
    for (unpacked, packed) in unpacked.iter().zip(packed) {
        assert!((unpacked - packed / 1000.0).abs() < 1e-12);
    }
}

/// Texts of one length and of any; what is no unit is none.
#[test]
fn units_of_arrays_stand_in_their_attributes() {
    let bytes = include_bytes!("samples/units.h5");
    let proposal = propose(&[Source { name: "units.h5", bytes }], &Recipe::default());
    let proposal = proposal.unwrap_or_else(|error| panic!("{error}"));
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    for (name, expected) in [("time_s", 2.0), ("position_mm", 1.0), ("error_um", libm::sin(1.0))] {
        assert!((column(&proposal, name)[4] - expected).abs() < 1e-9, "{name}");
    }
}

/// Arrays of one length are columns; words and objects of Python are none.
#[test]
fn an_archive_of_numpy_is_its_arrays() {
    let bytes = include_bytes!("samples/arrays.npz");
    let read = |bytes: &[u8]| propose(&[Source { name: "arrays.npz", bytes }], &Recipe::default());
    let proposal = read(bytes).unwrap_or_else(|error| panic!("{error}"));
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    assert_eq!(proposal.notes[0], "2 columns that hold no numbers are left out, first `label`");
    for (name, expected) in [("time_s", 2.0), ("position_mm", 1.0), ("error_um", libm::sin(1.0))] {
        assert!((column(&proposal, name)[4] - expected).abs() < 1e-9, "{name}");
    }
    let message = read(&bytes[..bytes.len() - 30]).expect_err("a part of it").to_string();
    assert!(message.starts_with("arrays.npz: found "), "{message}");
}

/// A number in parentheses is asked about; columns that are counted so in the header are not.
#[test]
fn numbers_in_parentheses_are_asked_about() {
    let text = file("Position [mm];Error [um]", |row| {
        let error = if row % 4 == 1 { format!("(0,{row})") } else { format!("0,{row}") };
        format!("{row},5;{error}")
    });
    assert_eq!(asked(&text), ["`(0,1)` stands in parentheses"]);
    let error = |word: &str| {
        let proposal = proposed(&text, &format!("[table]\nparentheses = \"{word}\""));
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        column(&proposal, "error_um")[5]
    };
    assert_eq!(error("negative").to_bits(), (-0.5_f64).to_bits());
    assert!(error("missing").is_nan());
    let counted = file("(1);(2)\nPosition [mm];Error [um]", |row| format!("{row},5;0,{row}"));
    assert_eq!(asked(&counted), [""; 0]);
}

/// Of two positions one is aimed at: the error is their difference, whichever way the answer goes.
#[test]
fn two_positions_are_asked_which_is_aimed_at() {
    let text = file("time [s],Axis PosAct [mm],Encoder PosAct [mm]", |row| {
        format!("{row},{}.0,{}.002", 10 * row, 10 * row)
    });
    let open = proposed(&text, "");
    let [question] = open.questions.as_slice() else { panic!("{:?}", open.questions) };
    assert_eq!(question.text, "`Axis PosAct [mm]` and `Encoder PosAct [mm]` are positions both");
    for (answer, sign) in question.answers.iter().zip([-1.0, 1.0]) {
        let proposal = proposed(&text, &answer.recipe);
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        let error = column(&proposal, "error_um")[7];
        assert!((error - 2.0 * sign).abs() < 1e-9, "{error}");
    }
}

/// A sensor that counts against the axis: the sign of the position holds where it is subtracted, too.
#[test]
fn a_position_is_turned_wherever_it_is_used() {
    let text = file("Axis Pos [mm],Distance [mm]", |row| format!("{row}.0,{}.00{row}", 70 - row));
    let recipe = |sign: &str| {
        format!(
            "[[column]]\nfrom = \"Axis Pos [mm]\"\nto = \"position_mm\"\nunit = \"mm\"\n{sign}\n\
             [[column]]\nfrom = \"Distance [mm]\"\nto = \"error_um\"\nunit = \"mm\"\n\
             minus = \"Axis Pos [mm]\"\n"
        )
    };
    let seventh = |sign: &str| {
        let proposal = proposed(&text, &recipe(sign));
        [column(&proposal, "position_mm")[7], column(&proposal, "error_um")[7]].map(f64::to_bits)
    };
    assert_eq!(seventh(""), [7.0, 56_007.0].map(f64::to_bits));
    assert_eq!(seventh("sign = -1"), [-7.0, 70_007.0].map(f64::to_bits));
}

/// Where several columns say where the axis came to, each answer takes one of them.
#[test]
fn several_readings_of_one_target_are_asked_about() {
    let text = file("Target [mm],Motor Pos [mm],Scale Pos [mm]", |row| {
        format!("{row}.0,{row}.001,{row}.002")
    });
    let open = proposed(&text, "");
    let [question] = open.questions.as_slice() else { panic!("{:?}", open.questions) };
    for (answer, expected) in question.answers.iter().zip([-1.0, -2.0]) {
        let proposal = proposed(&text, &answer.recipe);
        assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
        assert!((column(&proposal, "error_um")[7] - expected).abs() < 1e-9);
    }
}

/// What is measured in ampere is no error, whatever its name begins with.
#[test]
fn a_current_is_no_error() {
    let text = file("Position [mm],Measured Current [A],Error [um]", |row| {
        format!("{row}.5,0.{row},1.{row}")
    });
    let proposal = proposed(&text, "");
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    assert_eq!(column(&proposal, "error_um").len(), 40);
    assert!(proposal.table.column("measured_current_a").is_some());
}

/// Rows without a time may come evenly; a time from row to row that is none is refused.
#[test]
fn rows_that_come_evenly_have_a_time() {
    let text = file("Error [um]", |row| format!("0.{row}"));
    let open = proposed(&text, "");
    let [question] = open.questions.as_slice() else { panic!("{:?}", open.questions) };
    assert_eq!(question.text, "no column is known as position or time");
    let [answer] = question.answers.as_slice() else { panic!("{:?}", question.answers) };
    let proposal = proposed(&text, &answer.recipe);
    assert!((column(&proposal, "time_s")[39] - 0.039).abs() < 1e-12);
    assert_eq!(
        refused(&text, "[table]\nperiod_s = 0.0"),
        "data.csv: found `period_s = 0`, expected a time from row to row, in seconds"
    );
    let timed = file("time [s],Error [um]", |row| format!("{row},0.{row}"));
    assert_eq!(
        refused(&timed, "[table]\nperiod_s = 0.001"),
        "data.csv: found a column of times, while the recipe says `period_s`, expected one of the two"
    );
}

/// A name may hold the word for a counter; its values tell whether it counts.
#[test]
fn only_what_counts_is_left_out_as_a_counter() {
    for name in ["Sample", "frame", "Cycle"] {
        let header = format!("Position (mm),Error (um),{name}");
        let text = file(&header, |row| format!("{}.5,{},{}", 10 * row, row % 7, 3 + row + row / 9));
        let proposal = proposed(&text, "");
        let rule = proposal.recipe.column(name).expect("a rule for each");
        assert_eq!(
            (rule.to.as_deref(), rule.reason.as_str()),
            (Some("none"), "it counts the rows")
        );
    }
    for (name, kept) in [
        ("frame_temperature_c", "frame_temperature_c"),
        ("DownSample", "down_sample"),
        ("cycle temperature", "cycle_temperature"),
    ] {
        let header = format!("Position (mm),Error (um),{name}");
        let text = file(&header, |row| {
            format!("{}.5,{},{}.{row}", 10 * row, row % 7, 21 + row * row % 11)
        });
        let values = column(&proposed(&text, ""), kept);
        assert!((values[3] - 30.3).abs() < 1e-12, "{name}: {values:?}");
    }
}

/// A log of a stage that goes from target to target: its position every 0.1 s, target and run when they
/// change, and a sensor that is read twice as often as it changes.
fn monitored() -> String {
    let line = |name: &str, tick: u32, value: f64| {
        let (minute, second) = (tick / 6000, f64::from(tick % 6000) / 100.0);
        format!("IOC:{name} 2024-03-10 10:{minute:02}:{second:09.6} {value}\n")
    };
    let target = |leg: u32| f64::from(5 * (leg % 6).min(6 - leg % 6));
    let mut log = String::new();
    for tick in (0..12_000_u32).step_by(5) {
        let (leg, within) = (tick / 500, f64::from(tick % 500) / 300.0);
        let from = target(leg.saturating_sub(1));
        let moved = from + (target(leg) - from) * within.min(1.0);
        if tick % 500 == 0 {
            log += &line("PosCmd", tick, target(leg));
        }
        if tick % 3000 == 0 {
            log += &line("Run", tick, f64::from(1 + tick / 3000));
        }
        if tick % 10 == 0 {
            log += &line("PosAct", tick, moved + 1e-6 * f64::from(tick * 7 % 11));
        }
        log += &line("Sensor", tick, f64::from(tick / 10 * 7 % 1009));
    }
    log
}

const MONITORED: &str = "[[column]]\nfrom = \"IOC:PosAct\"\nto = \"position_mm\"\nunit = \"mm\"\n\
     [[column]]\nfrom = \"IOC:PosCmd\"\nto = \"target\"\n\
     [[column]]\nfrom = \"IOC:Sensor\"\nto = \"error_um\"\nunit = \"um\"\n";

/// What a setpoint was between two of its changes is the earlier one, and the last one holds on; so do counts.
#[test]
fn setpoints_and_counts_are_held_until_they_change() {
    let proposal = proposed(&monitored(), MONITORED);
    let target = column(&proposal, "target");
    assert!(target.iter().all(|value| (value % 5.0).abs() <= 0.0), "{target:?}");
    assert_eq!(target.len(), 1200);
    assert_eq!([target[49], target[50]].map(f64::to_bits), [0.0_f64, 5.0].map(f64::to_bits));
    let pass = column(&proposal, "pass");
    assert_eq!(
        [pass[299], pass[300], pass[1199]].map(f64::to_bits),
        [1.0_f64, 2.0, 4.0].map(f64::to_bits)
    );
}

/// Rows are those of the channel that a recipe names; of itself none that only repeats.
#[test]
fn the_clock_is_the_channel_that_tells_most_or_the_one_named() {
    let rows = |clock: &str| proposed(&monitored(), &format!("{clock}{MONITORED}")).table.rows();
    assert_eq!(rows(""), 1200);
    assert_eq!(rows("[channels]\nclock = \"IOC:PosCmd\"\n"), 24);
    assert_eq!(rows("[channels]\nclock = \"IOC:Sensor\"\n"), 2399);
    assert_eq!(
        refused(&monitored(), &format!("[channels]\nclock = \"nonsense\"\n{MONITORED}")),
        "data.csv: found no channel `nonsense` for `clock`, expected one of `IOC:PosAct`, \
         `IOC:PosCmd`, `IOC:Run`, `IOC:Sensor`"
    );
}

/// Deviations of ISO 230-2 are actual minus target whether rows or columns tell the runs; errors are not.
#[test]
fn runs_of_targets_have_the_sign_of_a_deviation() {
    let value = |index: u32| f64::from(index % 7) + 0.5;
    let sign = |header: &str| {
        let text =
            file(header, |index| format!("{},{},{}", 10 * index, value(index), value(index)));
        let proposal = proposed(&text, "");
        assert!(proposal.questions.is_empty(), "{header}: {:?}", proposal.questions);
        column(&proposal, "error_um")[0].signum().to_bits()
    };
    for header in [
        "Zielposition (mm),1↑ [µm],1↓ [µm]",
        "Pi (mm),Run 1 [um],Run 2 [um]",
        "P_i [mm],1↑ [um],2↑ [um]",
        "Position [mm],Lauf 1 vor [µm],Lauf 1 rück [µm]",
        "Target (mm),Run 1 deviation (um),Run 2 deviation (um)",
    ] {
        assert_eq!(sign(header), (-1.0_f64).to_bits(), "{header}");
    }
    let long = file("Target (mm),deviation_um", |index| format!("{},{}", 10 * index, value(index)));
    assert_eq!(column(&proposed(&long, ""), "error_um")[0].to_bits(), (-0.5_f64).to_bits());
    for header in
        ["Target (mm),Run 1 error (um),Run 2 error (um)", "Position (mm),Run 1 (um),Run 2 (um)"]
    {
        assert_eq!(sign(header), 1.0_f64.to_bits(), "{header}");
    }
}

/// The number of a target is no position beside one, and the unit of its runs is asked for once.
#[test]
fn numbers_of_targets_are_counted_and_units_of_runs_asked_for_together() {
    let row = |index: u32| format!("{};{};0,5;0,7", 1 + index, 10 * index);
    let proposal = proposed(&file("Zielposition i;Pi (mm);1↑;1↓", row), "");
    let rule = proposal.recipe.column("Zielposition i").expect("a rule for each");
    assert_eq!((rule.to.as_deref(), rule.reason.as_str()), (Some("none"), "it counts the rows"));
    let [question] = proposal.questions.as_slice() else { panic!("{:?}", proposal.questions) };
    assert_eq!(question.text, "the unit of 2 runs is not told, from column `1↑`");
    let answered =
        proposed(&file("Zielposition i;Pi (mm);1↑;1↓", row), &question.answers[0].recipe);
    assert!(answered.questions.is_empty(), "{:?}", answered.questions);
    assert_eq!(column(&answered, "error_um")[0].to_bits(), (-0.5_f64).to_bits());
    assert_eq!(column(&answered, "position_mm")[1].to_bits(), 10.0_f64.to_bits());
    let along = |index: u32| format!("{},{index}.001", 1 + index);
    let text = file("Sollposition,Position (mm)", along);
    assert_ne!(proposed(&text, "").recipe.columns[0].to.as_deref(), Some("none"));
}
