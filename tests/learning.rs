//! `add` and `learn` on files: what is written, what is kept, what can be taken back.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use helixlock_plant::prediction::predict;
use helixlock_plant::{Model, Record, Samples};
use helixlock_traces::{parquet::write_parquet, read_table};
use serde_json::Value;

use crate::support::command::{Run, few_samples, helixlock, put, repository, scratch, word};
use crate::support::passes::white;

fn example(file: &str) -> String {
    fs::read_to_string(repository().join("examples").join(file)).expect("the example is there")
}

fn json(run: &Run) -> Value {
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    serde_json::from_str(&run.stdout).expect("JSON")
}

fn names(value: &Value) -> Vec<String> {
    let effects = value.as_array().expect("a list of effects");
    effects.iter().map(|effect| effect["effect"].as_str().expect("a name").to_owned()).collect()
}

fn ledger(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("ledger.json")).expect("a ledger");
    serde_json::from_str(&text).expect("JSON")
}

/// What was made up for the data, and why a candidate was not taken, stands in the report.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_diagnosis_says_how_the_data_were_read_and_why_names_were_not_taken() {
    let folder = scratch();
    let (path, data) = word(&folder, "data.csv");
    // The first pass of a measurement, as a recorder that knows the time alone would have it.
    let known = fs::read_to_string(repository().join("examples/hidden-gear/data.csv"));
    let known = known.expect("an example");
    let rows = known.lines().filter_map(|line| {
        let [_, time_s, error_um, "1"] = line.split(',').collect::<Vec<_>>()[..] else {
            return None;
        };
        let time_s = 700.0 + time_s.parse::<f64>().expect("a time");
        Some(format!("{time_s:.3},{error_um}\n"))
    });
    put(&path, &("time_s,error_um\n".to_owned() + &rows.collect::<String>()));
    let run = helixlock(&["diagnose", "examples/hidden-gear/machine.toml", &data]);
    let said = [
        "note: angle and travel follow from `time_s` and the spindle speed\n",
        "note: times of effects count from the first sample, `time_s` 701.314\n",
        "    not taken beside gear-error, screw-periodic",
        ": explains less than screw-progressive: evidence ",
    ];
    for said in said {
        assert!(run.stdout.contains(said), "{said}: {}", run.stdout);
    }
}

/// `diagnose` shows what `learn` shows, and writes nothing else.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_diagnosis_has_the_page_of_learn() {
    let folder = scratch();
    let [diagnosed, learned] = ["diagnosed", "learned"].map(|name| word(&folder, name));
    let data = few_samples(folder.path(), "hidden-gear", 4);
    let files = ["examples/hidden-gear/machine.toml", &data];
    let run = helixlock(&[&["diagnose"], &files[..], &["-o", &diagnosed.1]].concat());
    assert_eq!((run.status, run.stderr.as_str()), (0, ""));
    helixlock(&[&["learn"], &files[..], &["-o", &learned.1]].concat());
    let page = |folder: &Path| fs::read_to_string(folder.join("report.html")).expect("a report");
    assert_eq!(page(&diagnosed.0), page(&learned.0));
    assert_eq!(fs::read_dir(&diagnosed.0).expect("a folder").count(), 1);
    let over_data = helixlock(&["diagnose", files[0], files[1], "-o", files[1]]);
    assert_eq!(over_data.status, 2, "{}", over_data.stdout);
}

/// Two effects are found one after the other; each round can be gone back to.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn rounds_are_kept_and_can_be_taken_back() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "learned");
    let data = few_samples(folder.path(), "thermal-day", 2);
    let words = ["learn", "examples/thermal-day/machine.toml", &data];
    let learned = helixlock(&[&words[..], &["-o", &out_word, "--json"]].concat());
    let mut found = names(&json(&learned)["effects"]);
    found.sort_unstable();
    assert_eq!(found, ["air-pressure", "air-temperature"]);

    let book = ledger(&out);
    let rounds = book["rounds"].as_array().expect("rounds");
    assert_eq!(rounds.len(), 3, "{book}");
    for pair in rounds.windows(2) {
        assert_eq!(pair[1]["rms_before_um"], pair[0]["rms_um"]);
    }
    assert!(rounds[2]["rms_um"].as_f64() < rounds[0]["rms_um"].as_f64(), "{book}");
    let machine = || fs::read_to_string(out.join("machine.toml")).expect("a machine file");
    assert_eq!(rounds[2]["machine"], machine().as_str());

    for (left, kept) in [(1, 1), (0, 0)] {
        let undone = helixlock(&["learn", "--undo", "-o", &out_word]);
        assert_eq!((undone.status, undone.stderr.as_str()), (0, ""));
        assert!(undone.stdout.contains(" taken back\nnext: "), "{}", undone.stdout);
        assert_eq!(rounds[kept]["machine"], machine().as_str(), "{left} rounds are left");
        let report = fs::read_to_string(out.join("report.html")).expect("a report");
        let taken = rounds[kept + 1]["added"].as_str().expect("a name");
        assert!(report.contains("taken back: "), "{report}");
        assert!(!report.contains(&format!("+ {taken}")), "the picture still has {taken}");
    }
    assert_eq!(machine(), example("thermal-day/machine.toml"));
    let undone = helixlock(&["learn", "--undo", "-o", &out_word]);
    assert_eq!((undone.status, undone.stdout.as_str()), (1, "no round is left to take back\n"));
    let taken = ledger(&out)["rounds"].as_array().expect("rounds").clone();
    let taken: Vec<_> = taken.iter().map(|round| round["taken_back"].clone()).collect();
    assert_eq!(taken, [false, true, true]);
}

/// A run, a hand-made change, the same run and taking back: the change is in no danger.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_machine_file_edited_by_hand_is_kept_aside() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "learned");
    let data = few_samples(folder.path(), "hidden-gear", 4);
    let words = ["learn", "examples/hidden-gear/machine.toml", &data];
    let learn = || helixlock(&[&words[..], &["-o", &out_word]].concat());
    let first = learn();
    assert!(!first.stdout.contains("kept as"), "{}", first.stdout);
    assert!(!learn().stdout.contains("kept as"), "its own file is no edit");
    let text = fs::read_to_string(out.join("machine.toml")).expect("a machine file");
    for name in ["machine-1.toml", "machine-2.toml"] {
        let edited = format!("{text}\n# my own for {name}\n");
        put(&out.join("machine.toml"), &edited);
        let said = match name {
            "machine-1.toml" => learn().stdout,
            _ => helixlock(&["learn", "--undo", "-o", &out_word]).stdout,
        };
        assert!(said.contains(&format!("kept as {name}")), "{said}");
        assert_eq!(fs::read_to_string(out.join(name)).expect("kept"), edited);
    }
}

/// The learned file is the old one, to the byte, with tables behind it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_new_machine_file_keeps_comments_and_order() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "learned");
    let data = few_samples(folder.path(), "hidden-gear", 4);
    let words = ["learn", "examples/hidden-gear/machine.toml", &data];
    // A folder of an earlier run, with a file of the user's own in it.
    fs::create_dir(&out).expect("a folder can be made");
    put(&out.join("machine.toml"), "# of an earlier run\n");
    put(&out.join("notes.txt"), "mine\n");
    let learned = helixlock(&[&words[..], &["-o", &out_word]].concat());
    assert_eq!((learned.status, learned.stderr.as_str()), (0, ""));
    let new = fs::read_to_string(out.join("machine.toml")).expect("a machine file");
    let old = example("hidden-gear/machine.toml");
    assert!(new.starts_with(&old), "expected the old file first:\n{new}");
    assert!(new[old.len()..].contains("kind = \"gear-error\""), "{new}");
    assert_eq!(fs::read_to_string(out.join("notes.txt")).expect("kept"), "mine\n");
    let mut files: Vec<_> = fs::read_dir(&out)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("text"))
        .collect();
    files.sort_unstable();
    assert_eq!(
        files,
        ["ledger.json", "machine-1.toml", "machine.toml", "notes.txt", "report.html"],
        "the machine file of somebody else is kept aside"
    );
    let aside = fs::read_to_string(out.join("machine-1.toml")).expect("kept");
    assert_eq!(aside, "# of an earlier run\n");
    let kept = "note: machine.toml was not as `learn` had left it: kept as machine-1.toml\n";
    assert!(learned.stdout.contains(kept), "{}", learned.stdout);

    // What was learned is no longer missing.
    let machine = out.join("machine.toml").to_str().expect("text").to_owned();
    let again = json(&helixlock(&["diagnose", &machine, words[2], "--json"]));
    assert_eq!(again["verdict"], "nothing-missing", "{again}");
}

/// An effect nobody foresaw is unexplained, then added as the user's own, and explains.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn an_effect_of_the_users_own_is_learned() {
    let folder = scratch();
    let data = few_samples(folder.path(), "outside-the-catalogue", 4);
    let words = ["learn", "examples/outside-the-catalogue/machine.toml", &data, "--json"];
    let without = json(&helixlock(&words));
    assert_eq!(without["verdict"], "unexplained");
    let own = ["--custom", "examples/outside-the-catalogue/rack.toml"];
    let with = json(&helixlock(&[&words[..], &own].concat()));
    assert_eq!(with["verdict"], "explained", "{with}");
    let rms = |value: &Value| {
        let rounds = value["rounds"].as_array().expect("rounds").clone();
        let of = |round: Option<&Value>| round.and_then(|r| r["holdout_rms_um"].as_f64());
        of(rounds.first()).zip(of(rounds.last())).expect("two rounds")
    };
    let (before, after) = rms(&with);
    assert!(after < 0.3 * before, "{before} → {after}");
}

/// Beside something unexplained nothing is added unasked, not even a space.
#[test]
fn what_is_unexplained_leaves_the_machine_file_alone() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "learned");
    let example = "examples/outside-the-catalogue";
    let data = few_samples(folder.path(), "outside-the-catalogue", 4);
    let words = [&format!("{example}/machine.toml"), &data];
    let learned = json(&helixlock(&["learn", words[0], words[1], "-o", &out_word, "--json"]));
    assert_eq!((&learned["verdict"], &learned["accepted"]), (&"unexplained".into(), &false.into()));
    let bytes = |path: &Path| fs::read(path).expect("a machine file");
    assert_eq!(bytes(&out.join("machine.toml")), bytes(&repository().join(words[0])));
    let standing = |round: &&Value| round["taken_back"] != true;
    let book = ledger(&out);
    assert_eq!(book["rounds"].as_array().expect("rounds").iter().filter(standing).count(), 1);
}

/// A slope that four effects draw alike is added when the user says so, and no sooner.
#[test]
fn what_is_ambiguous_is_added_when_accepted() {
    let folder = scratch();
    let (path, data) = word(&folder, "data.csv");
    let mut noise = white(4, 0.05);
    let row = |row: i32| format!("{row},{:.5}", 0.002 * f64::from(row) + noise());
    let rows: Vec<String> = (0..400).map(row).collect();
    put(&path, &format!("position_mm,error_um\n{}\n", rows.join("\n")));
    let (out, out_word) = word(&folder, "learned");
    let words = ["learn", "templates/screw-axis.toml", &data, "-o", &out_word];
    let first = helixlock(&words);
    assert!(first.stdout.contains("verdict: ambiguous"), "{}", first.stdout);
    assert!(first.stdout.contains("offered, not added: "), "{}", first.stdout);
    assert!(first.stdout.contains(" --accept -o learned"), "{}", first.stdout);
    let bytes = |path: &Path| fs::read(path).expect("a machine file");
    let before = bytes(&repository().join(words[1]));
    assert_eq!(bytes(&out.join("machine.toml")), before);
    let accepted = json(&helixlock(&[&words[..], &["--accept", "--json"]].concat()));
    assert_eq!((&accepted["verdict"], &accepted["accepted"]), (&"ambiguous".into(), &true.into()));
    assert_ne!(bytes(&out.join("machine.toml")), before);
}

/// Data with the wrong sign are doubted: exit status 1, no effect, the file as it was.
#[test]
fn doubtful_input_teaches_nothing() {
    let folder = scratch();
    let machine = example("hidden-gear/machine.toml");
    let known = "\n[[effect]]\nkind = \"screw-wear\"\nheight = \"2.5 um\"\nposition = \"200 mm\"\nwidth = \"30 mm\"\n[[effect]]\nkind = \"screw-periodic\"\namplitude = \"3 um\"\nphase = \"40 deg\"\n";
    let (path, machine_word) = word(&folder, "machine.toml");
    put(&path, &format!("{machine}{known}"));
    let (_, predicted) = word(&folder, "data.csv");
    turned(&path, Path::new(&predicted));
    let (out, out_word) = word(&folder, "learned");
    let run = helixlock(&["learn", &machine_word, &predicted, "-o", &out_word, "--json"]);
    assert_eq!((run.status, run.stderr.as_str()), (1, ""));
    let value: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(value["verdict"], "doubtful-input", "{value}");
    assert_eq!(value["doubts"][0]["what"], "sign");
    assert_eq!(names(&value["effects"]), [""; 0]);
    assert_eq!(fs::read(out.join("machine.toml")).expect("file"), fs::read(&path).expect("file"));
}

/// What a machine shows on 400 mm, with the opposite sign.
fn turned(machine: &Path, data: &Path) {
    let model = Model::read(machine).expect("a machine");
    let places: Vec<f64> = (0..800).map(|row| 0.5 * f64::from(row)).collect();
    let record = Record::new(&model, &Samples::forward(&model, places.clone()));
    let shown = predict(&model, &record).expect("a prediction").error_um;
    let mut text = "position_mm,error_um\n".to_owned();
    for (row, (place, error_um)) in places.iter().zip(shown).enumerate() {
        let noise_um = f64::from(u8::try_from(row * 37 % 101).expect("small")) / 1000.0;
        writeln!(text, "{place},{}", noise_um - error_um).expect("text");
    }
    put(data, &text);
}

/// What an effect's nonlinear values begin with is no value of it: a width of 0 has none.
#[test]
fn effects_of_any_shape_can_be_added() {
    let folder = scratch();
    let (data, data_word) = word(&folder, "data.csv");
    let rows = (0..300).map(f64::from);
    let row = |at: f64| format!("{at},{at},{}\n", libm::sin(at * at) + 5.0 * libm::exp(-0.01 * at));
    put(&data, &("time_s,position_mm,error_um\n".to_owned() + &rows.map(row).collect::<String>()));
    for kind in ["screw-wear", "headstock-growth"] {
        let (_, new) = word(&folder, &format!("{kind}.toml"));
        let machine = "examples/hidden-gear/machine.toml";
        let run = helixlock(&["add", machine, kind, "--fit", &data_word, "-o", &new]);
        assert!(run.status < 2, "{kind}: {}", run.stderr);
    }
}

/// With `--refit` the effects of the file give way; without, they stay as they are.
#[test]
fn a_refit_moves_the_effects_of_the_file() {
    let folder = scratch();
    let (machine, machine_word) = word(&folder, "machine.toml");
    // A periodic error of the file that is half as large as the data's own.
    let text = example("hidden-gear/machine.toml");
    let kept = text.split("[[effect]]").next().expect("a first part");
    let given = "\n[[effect]]                     # guessed\nkind = \"gear-error\"\n";
    put(
        &machine,
        &format!("{kept}{given}order = 2.5\namplitude = \"0.1 um\"\nphase = \"0 deg\"\n"),
    );
    let (new, new_word) = word(&folder, "new.toml");
    let words = ["add", &machine_word, "screw-periodic", "--fit", "examples/hidden-gear/data.csv"];
    let fixed = json(&helixlock(&[&words[..], &["-o", &new_word, "--json"]].concat()));
    assert_eq!(names(&fixed["effects"]), ["screw-periodic"]);
    assert!(fs::read_to_string(&new).expect("a file").contains("# guessed"));
    let refitted =
        json(&helixlock(&[&words[..], &["-o", &new_word, "--refit", "--json"]].concat()));
    assert_eq!(names(&refitted["effects"]), ["gear-error", "screw-periodic"]);
    let rms = |value: &Value| value["rms_um"].as_f64().expect("a number");
    assert!(rms(&refitted) <= rms(&fixed) + 1e-9, "{fixed}\n{refitted}");
}

/// The same samples from Parquet give the same answer.
#[test]
fn parquet_is_learned_from_like_text() {
    let folder = scratch();
    let csv = few_samples(folder.path(), "hidden-gear", 4);
    let table = read_table(Path::new(&csv)).expect("a table");
    let (parquet, parquet_word) = word(&folder, "data.parquet");
    #[expect(clippy::disallowed_methods, reason = "a test makes its own input, in its own folder")]
    let mut file = fs::File::create(&parquet).expect("a file can be made");
    write_parquet(&table, &mut file).expect("it can be written");
    let machine = "examples/hidden-gear/machine.toml";
    let answer = |data: &str| {
        let mut answer = json(&helixlock(&["learn", machine, data, "--json"]));
        answer.as_object_mut().expect("an object").remove("data_hash");
        answer
    };
    assert_eq!(answer(&parquet_word), answer(&csv));
}

/// A trace of our own run, ×2 range and closed loop: the counter tells the error, and the learned
/// machine, run clock by clock, does what was measured.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_closed_loop_trace_passes_the_final_check() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    let simulated =
        helixlock(&["sim", "examples/sg7430-6mm/machine.toml", "--length", "240", "-o", &out_word]);
    assert_eq!((simulated.status, simulated.stderr.as_str()), (0, ""));
    let text = example("sg7430-6mm/machine.toml");
    assert!(text.contains("range = 2 "));
    let (before, after) = text.split_once("[[effect]]").expect("an effect");
    let (_, progressive) = after.split_once("[[effect]]").expect("two effects");
    let (machine, machine_word) = word(&folder, "machine.toml");
    put(&machine, &format!("{before}[[effect]]{progressive}"));
    let trace = out.join("trace.csv").to_str().expect("text").to_owned();
    let answer = json(&helixlock(&["learn", &machine_word, &trace, "--json"]));
    let effects = answer["effects"].as_array().expect("effects");
    let periodic = effects.iter().find(|effect| effect["effect"] == "screw-periodic");
    let amplitude = periodic.expect("it is found")["parameters"]["amplitude_um"]["value"].as_f64();
    assert!((amplitude.expect("a number") - 1.5).abs() < 0.02, "{amplitude:?}");

    let check = &answer["final_check"];
    let hunting_um = check["hunting_um"].as_f64().expect("a number");
    let sensors = check["sensors"].as_array().expect("sensors");
    let counter = sensors.iter().find(|one| one["sensor"] == "steps").expect("the counter");
    let (before, after) = (counter["rms_before_um"].as_f64(), counter["rms_um"].as_f64());
    assert!(1.0 < before.expect("a number"), "{check}");
    assert!(after.expect("a number") < 1.3 * hunting_um, "{check}");
}

/// The samples of hidden-gear as a logger writes them: other units, instants, semicolons.
fn as_logged(csv: &str) -> String {
    let mut lines = csv.lines().filter(|line| !line.starts_with('#'));
    assert_eq!(lines.next(), Some("position_mm,time_s,error_um,pass"));
    let mut logged = "Pass;Error (nm);timestamp;Position [m]\n".to_owned();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let scaled = |cell: &str, factor: f64| {
            cell.parse::<f64>().map_or(String::new(), |value| format!("{}", value * factor))
        };
        let stamp = cells[1].parse::<f64>().map_or(String::new(), |time_s| {
            let (minutes, seconds) = ((time_s / 60.0).floor(), time_s % 60.0);
            let (hours, minutes) = ((minutes / 60.0).floor(), minutes % 60.0);
            format!("2026-03-01 {hours:02}:{minutes:02}:{seconds:08.5}")
        });
        let (error, position) = (scaled(cells[2], 1000.0), scaled(cells[0], 0.001));
        writeln!(logged, "{};{error};{stamp};{position}", cells[3]).expect("memory takes it");
    }
    logged
}

/// Units, separators and clocks of the file change neither the verdict nor the numbers.
#[test]
fn a_loggers_file_is_diagnosed_like_our_own() {
    let folder = scratch();
    let (data, data_word) = word(&folder, "logged.csv");
    let few = few_samples(folder.path(), "hidden-gear", 4);
    put(&data, &as_logged(&fs::read_to_string(&few).expect("it is there")));
    let machine = "examples/hidden-gear/machine.toml";
    let logged = json(&helixlock(&["diagnose", machine, &data_word, "--json"]));
    let own = json(&helixlock(&["diagnose", machine, &few, "--json"]));
    assert_eq!(logged["verdict"], own["verdict"]);
    assert_eq!(names(&logged["effects"]), names(&own["effects"]));
    let amplitude = |answer: &Value| {
        answer["effects"][0]["parameters"]["amplitude_um"]["value"].as_f64().expect("a number")
    };
    assert!((amplitude(&logged) - amplitude(&own)).abs() < 1e-5, "{logged}");
    let notes = logged["notes"].to_string();
    assert!(notes.contains("`Position [m]` is read as `position_mm`, converted"), "{notes}");
}

/// The number of a sample is no cause, and says nothing of what is.
#[test]
fn a_column_that_numbers_the_rows_is_left_out() {
    let folder = scratch();
    let mut numbered = String::new();
    let few = few_samples(folder.path(), "hidden-gear", 4);
    for (row, line) in fs::read_to_string(&few).expect("it is there").lines().enumerate() {
        let number = if row == 0 { "sample".to_owned() } else { row.to_string() };
        writeln!(numbered, "{line},{number}").expect("memory takes it");
    }
    let (data, data_word) = word(&folder, "numbered.csv");
    put(&data, &numbered);
    let machine = "examples/hidden-gear/machine.toml";
    let mut counted = json(&helixlock(&["diagnose", machine, &data_word, "--json"]));
    let own = json(&helixlock(&["diagnose", machine, &few, "--json"]));
    let notes = counted["notes"].to_string();
    assert!(notes.contains("`sample` counts on from row to row and is left out"), "{notes}");
    counted["notes"] = own["notes"].clone();
    assert_eq!(counted, own);
}
