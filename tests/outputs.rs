//! What a command leaves: nothing of the user's is lost, and what belongs together appears together.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use crate::support::command::{few_samples, helixlock, put, repository, scratch, word};

const MACHINE: &str = "examples/sg7430-6mm/machine.toml";

fn said(run: &Output) -> String {
    String::from_utf8_lossy(&run.stderr).into_owned()
}

/// Runs the command in a folder.
fn run_in(folder: &Path, words: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
    command.current_dir(folder).args(words).output().expect("the command starts")
}

/// A table of a screw, and the machine of an example, in a folder.
fn workplace() -> tempfile::TempDir {
    let folder = scratch();
    let rows: Vec<_> = (0..400).map(|i| format!("{i},{}\n", f64::from(i % 7) / 8.0)).collect();
    put(&folder.path().join("data.csv"), &format!("position_mm,lead_error_um\n{}", rows.concat()));
    let text = fs::read_to_string(repository().join(MACHINE)).expect("the example is there");
    put(&folder.path().join("machine.toml"), &text);
    folder
}

/// Names in a folder, those that begin with a dot too.
fn listing(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let name = |entry: std::io::Result<fs::DirEntry>| {
        entry.expect("it can be listed").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<_> = entries.map(name).collect();
    names.sort();
    names
}

#[test]
fn what_is_read_is_not_replaced() {
    let folder = workplace();
    let path = |name: &str| folder.path().join(name);
    let scale = "position_mm,error_um\n0,0.1\n1,0.2\n2,0.1\n3,0.3\n";
    put(&path("t.csv"), scale);
    fs::create_dir(path("learned")).expect("a folder can be made");
    fs::copy(path("machine.toml"), path("learned/machine.toml")).expect("it can be copied");
    for words in [
        &["scale", "build", "t.csv", "-o", "t.csv"][..],
        &["learn", "learned/machine.toml", "data.csv", "-o", "learned"],
        &["add", "machine.toml", "backlash", "--set", "width=2 um", "-o", "machine.toml"],
        &["import", "data.csv", "-o", "data.csv"],
    ] {
        let before = words.iter().filter_map(|word| fs::read(path(word)).ok()).collect::<Vec<_>>();
        let run = run_in(folder.path(), words);
        assert_eq!(run.status.code(), Some(2), "{words:?}: {run:?}");
        assert!(said(&run).contains("is read by this command"), "{words:?}: {}", said(&run));
        let after = words.iter().filter_map(|word| fs::read(path(word)).ok()).collect::<Vec<_>>();
        assert_eq!(before, after, "{words:?}");
    }
    let words =
        ["add", "machine.toml", "backlash", "--set", "width=2 um", "-o", "machine.toml", "--force"];
    assert_eq!(run_in(folder.path(), &words).status.code(), Some(0));
    assert!(fs::read_to_string(path("machine.toml")).expect("text").contains("backlash"));
}

/// A curve that a machine file names is read too.
#[test]
fn a_measured_curve_is_not_replaced() {
    let folder = workplace();
    let path = |name: &str| folder.path().join(name);
    put(&path("trace.csv"), "position_mm,lead_error_um\n0,0\n1000,2\n");
    let text = fs::read_to_string(path("machine.toml")).expect("text");
    put(
        &path("machine.toml"),
        &format!("{text}\n[[effect]]\nkind = \"measured-curve\"\nfile = \"trace.csv\"\n"),
    );
    let run = run_in(folder.path(), &["sim", "machine.toml", "--length", "1 mm", "-o", "."]);
    assert_eq!(run.status.code(), Some(2), "{run:?}");
    assert!(said(&run).contains("trace.csv: is read by this command"), "{}", said(&run));
    assert_eq!(listing(folder.path()), ["data.csv", "machine.toml", "trace.csv"]);
}

/// No output of a command is another one of it, by whatever name, nor the journal of another; it
/// is told before any work.
#[test]
fn outputs_of_one_command_are_apart() {
    let folder = workplace();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("below")).expect("a folder can be made");
    let sweep = ["sweep", "machine.toml", "--set", "drive.frequency=60 Hz", "--length", "1"];
    let certify = ["certify", "machine.toml", "--length", "1"];
    let faults = ["faults", "machine.toml"];
    let discover = ["discover", "machine.toml", "data.csv"];
    let absolute = path("r.csv").to_string_lossy().into_owned();
    for (words, journal) in
        [(&sweep[..], true), (&certify, true), (&faults, true), (&discover, false)]
    {
        for (page, other) in [
            ("r.csv", "`-o`"),
            ("./r.csv", "`-o`"),
            ("below/../r.csv", "`-o`"),
            (absolute.as_str(), "`-o`"),
            ("r.csv.journal", "the journal of `-o`"),
            ("below/.././r.csv.journal", "the journal of `-o`"),
        ] {
            if !journal && page.ends_with(".journal") {
                continue;
            }
            let run = run_in(folder.path(), &[words, &["-o", "r.csv", "--page", page]].concat());
            assert_eq!(run.status.code(), Some(2), "{words:?} {page}: {run:?}");
            let expected = format!(
                "helixlock: {page}: is both {other} and `--page` of this command, expected a file each\n"
            );
            assert_eq!(said(&run), expected, "{words:?}");
            assert_eq!(listing(folder.path()), ["below", "data.csv", "machine.toml"], "{words:?}");
        }
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("r.csv", path("link.html")).expect("a link can be made");
        let words = [&discover[..], &["-o", "r.csv", "--page", "link.html"]].concat();
        assert_eq!(run_in(folder.path(), &words).status.code(), Some(2));
    }
}

/// What a recipe was read from is no place for the data.
#[test]
fn a_recipe_is_not_replaced_by_data() {
    let folder = workplace();
    let recipe = "[text]\ndecimal = \".\"\n";
    put(&folder.path().join("r.csv"), recipe);
    let run = run_in(folder.path(), &["import", "data.csv", "--recipe", "r.csv", "-o", "r.csv"]);
    assert_eq!(run.status.code(), Some(2), "{run:?}");
    assert!(said(&run).contains("r.csv: is read by this command"), "{}", said(&run));
    assert_eq!(fs::read_to_string(folder.path().join("r.csv")).expect("text"), recipe);
}

/// Measured data are CSV or Parquet, as the name says; no other name gets either.
#[test]
fn measured_data_are_written_as_their_name_says() {
    let folder = workplace();
    let run = run_in(folder.path(), &["import", "data.csv", "-o", "a.xlsx"]);
    assert_eq!(run.status.code(), Some(2), "{run:?}");
    assert_eq!(said(&run), "helixlock: a.xlsx: expected a name in .csv or .parquet\n");
    assert!(!folder.path().join("a.xlsx").exists());
    let run = run_in(folder.path(), &["import", "data.csv", "-o", "a.parquet"]);
    assert_eq!(run.status.code(), Some(0), "{run:?}");
    let table = helixlock_traces::read_table(&folder.path().join("a.parquet")).expect("a table");
    assert_eq!(table.column("position_mm").map(<[f64]>::len), Some(400));
}

/// One of several names is refused by the file system: none of the files appears.
#[test]
fn a_name_that_is_too_long_is_refused_before_anything_is_written() {
    let folder = workplace();
    let files = || -> Vec<String> {
        let all = listing(folder.path());
        all.into_iter().filter(|name| folder.path().join(name).is_file()).collect()
    };
    let before = files();
    let long = "x".repeat(246) + ".csv"; // a name may have 255 bytes; its recipe would have 258
    let prefix = "p".repeat(300);
    for words in [
        &["import", "data.csv", "-o", &long][..],
        &["gen", "machine.toml", "-o", ".", "--prefix", &prefix],
    ] {
        let run = run_in(folder.path(), words);
        assert_eq!(run.status.code(), Some(2), "{words:?}: {run:?}");
        assert_eq!(files(), before, "{words:?}");
    }
    let run = run_in(folder.path(), &["import", "data.csv", "-o", "ok.csv"]);
    assert_eq!(run.status.code(), Some(0), "{run:?}");
}

/// Whatever a journal says that cannot be done, one command says so, nothing is lost, and the next
/// one goes on.
#[test]
fn a_journal_that_cannot_be_finished_is_put_aside() {
    let long =
        format!("[[\".helixlock-1-0\",\"ok.csv\"],[\".helixlock-1-1\",\"{}\"]]", "x".repeat(300));
    for (journal, left) in [
        (long.as_str(), &["helixlock-1-1", "helixlock-commit"][..]),
        (
            "[[\".helixlock-1-0\",\"none/x\"]]",
            &["helixlock-1-0", "helixlock-1-1", "helixlock-commit"],
        ),
        (
            "[[\".helixlock-1-0\",\"../x\"]]",
            &["helixlock-1-0", "helixlock-1-1", "helixlock-commit"],
        ),
        ("[[\"data.csv\",\"x\"]]", &["helixlock-1-0", "helixlock-1-1", "helixlock-commit"]),
        ("not a journal", &["helixlock-1-0", "helixlock-1-1", "helixlock-commit"]),
    ] {
        let folder = workplace();
        let path = |name: &str| folder.path().join(name);
        put(&path(".helixlock-1-0"), "first");
        put(&path(".helixlock-1-1"), "second");
        put(&path(".helixlock-commit"), journal);
        let data = fs::read(path("data.csv")).expect("it is there");
        let import = ["import", "data.csv", "-o", "new.csv"];
        let run = run_in(folder.path(), &import);
        assert_eq!(run.status.code(), Some(2), "{journal}: {run:?}");
        assert!(said(&run).contains("its files are in ./unfinished-1 now"), "{}", said(&run));
        assert_eq!(listing(&path("unfinished-1")), left, "{journal}");
        let second = fs::read_to_string(path("unfinished-1/helixlock-1-1"));
        assert_eq!(second.expect("it is kept"), "second", "{journal}");
        assert_eq!(fs::read(path("data.csv")).expect("it stays"), data, "{journal}");
        let run = run_in(folder.path(), &import);
        assert_eq!(run.status.code(), Some(0), "{journal}: {run:?}");
        assert!(listing(folder.path()).iter().all(|name| !name.starts_with('.')), "{journal}");
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_makefile_of_the_user_stays() {
    let folder = workplace();
    let makefile = folder.path().join("Makefile");
    put(&makefile, "all:\n\techo mine\n");
    let words = ["gen", "machine.toml", "-o", ".", "--board", "icestick"];
    let run = run_in(folder.path(), &words);
    assert_eq!(run.status.code(), Some(2), "{run:?}");
    assert!(said(&run).contains("./Makefile: found a file that `gen` has not written"), "{run:?}");
    assert_eq!(fs::read_to_string(&makefile).expect("text"), "all:\n\techo mine\n");
    let forced = [&words[..], &["--force"]].concat();
    assert_eq!(run_in(folder.path(), &forced).status.code(), Some(0));
    assert!(fs::read_to_string(&makefile).expect("text").contains("icestick") || makefile.exists());
    // Its own files it replaces, also for another machine, but none that was changed since.
    let text = fs::read_to_string(folder.path().join("machine.toml")).expect("text");
    put(&folder.path().join("machine.toml"), &text.replace("SG7430", "SG7431"));
    assert_eq!(run_in(folder.path(), &words).status.code(), Some(0));
    put(&makefile, "all:\n\techo changed\n");
    assert_eq!(run_in(folder.path(), &words).status.code(), Some(2));
}

#[test]
#[cfg(unix)]
fn links_modes_and_devices_stay_what_they_are() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let folder = workplace();
    let path = |name: &str| folder.path().join(name);
    put(&path("t.csv"), "position_mm,error_um\n0,0.1\n1,0.2\n2,0.1\n3,0.3\n");
    put(&path("secret.bin"), "old");
    let mode = fs::Permissions::from_mode(0o600);
    fs::set_permissions(path("secret.bin"), mode).expect("it is ours");
    fs::create_dir(path("elsewhere")).expect("a folder can be made");
    put(&path("elsewhere/end.bin"), "old");
    symlink("elsewhere/end.bin", path("link.bin")).expect("a link can be made");
    for name in ["secret.bin", "link.bin", "/dev/null"] {
        let run = run_in(folder.path(), &["scale", "build", "t.csv", "-o", name]);
        assert_eq!(run.status.code(), Some(0), "{name}: {run:?}");
    }
    let mode = fs::metadata(path("secret.bin")).expect("it is there").permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
    assert!(fs::symlink_metadata(path("link.bin")).expect("it is there").is_symlink());
    let written = fs::read(path("secret.bin")).expect("it is there");
    assert_eq!(fs::read(path("elsewhere/end.bin")).expect("it is there"), written);
    assert!(written.len() > 1000);
    assert!(fs::metadata("/dev/null").expect("it is there").file_type().is_char_device());
}

#[test]
#[cfg(unix)]
fn pipes_are_read_once_and_written_into() {
    let folder = workplace();
    let shell = |line: &str| {
        let mut command = Command::new("bash");
        command.args(["-c", line]).current_dir(folder.path());
        command.env("HELIXLOCK", env!("CARGO_BIN_EXE_helixlock")).output().expect("bash is there")
    };
    let plain = shell("$HELIXLOCK compare machine.toml data.csv");
    assert_eq!(plain.status.code(), Some(0), "{plain:?}");
    let piped = shell("$HELIXLOCK compare <(cat machine.toml) <(cat data.csv)");
    let plain = String::from_utf8_lossy(&plain.stdout);
    let (report, next) = plain.split_once("next: ").expect("files can be read again");
    assert!(next.starts_with("helixlock diagnose "), "{next}");
    assert_eq!(String::from_utf8_lossy(&piped.stdout), report, "{}", said(&piped));
    let plain = shell("$HELIXLOCK screw data.csv --lead '6 mm'");
    let piped = shell("cat data.csv | $HELIXLOCK screw /dev/stdin --lead '6 mm'");
    let text =
        |run: &Output| String::from_utf8_lossy(&run.stdout).replace("/dev/stdin", "data.csv");
    assert_eq!(text(&piped), text(&plain), "{}", said(&piped));
    put(&folder.path().join("t.csv"), "position_mm,error_um\n0,0.1\n1,0.2\n2,0.1\n3,0.3\n");
    let run = shell(
        "mkfifo pipe.bin && (cat pipe.bin > got.bin &) && $HELIXLOCK scale build t.csv -o pipe.bin \
         && test -p pipe.bin && $HELIXLOCK scale build t.csv -o file.bin && sleep 0.2 && cmp got.bin file.bin",
    );
    assert_eq!(run.status.code(), Some(0), "{run:?}");
}

#[test]
fn a_folder_in_the_place_of_a_file_leaves_all_as_it_was() {
    let folder = workplace();
    let words = ["screw", "data.csv", "--lead", "6 mm", "-o", "out"];
    assert_eq!(run_in(folder.path(), &words).status.code(), Some(0));
    let out = folder.path().join("out");
    fs::remove_file(out.join("report.html")).expect("it is ours");
    fs::create_dir(out.join("report.html")).expect("a folder can be made");
    put(&out.join("result.json"), "old");
    let run = run_in(folder.path(), &words);
    assert_eq!(run.status.code(), Some(2), "{run:?}");
    assert!(said(&run).contains("report.html: found a folder, expected a file"), "{}", said(&run));
    assert_eq!(fs::read_to_string(out.join("result.json")).expect("text"), "old");
    assert_eq!(listing(&out), ["figure.svg", "report.html", "result.json"]);
}

/// Killed at the n-th of each system call that can change a folder, a command leaves its old files
/// or, once the journal stands, what the next command makes the new ones of; never a mixture for
/// good, and nothing under a temporary name.
#[test]
#[cfg(target_os = "linux")]
fn killed_at_any_system_call_it_leaves_all_or_nothing() {
    let names = ["figure.svg", "report.html", "result.json"];
    let folder = workplace();
    let words = ["screw", "data.csv", "--lead", "6 mm", "-o", "new"];
    assert_eq!(run_in(folder.path(), &words).status.code(), Some(0));
    let read = |out: &str| names.map(|name| fs::read_to_string(folder.path().join(out).join(name)));
    let new = read("new").map(|text| text.expect("a run writes it"));
    let mut stages = [0; 3];
    for calls in ["openat", "write", "fsync", "linkat", "rename", "unlink"] {
        for time in 1.. {
            let out = folder.path().join("out");
            let _ = fs::remove_dir_all(&out);
            fs::create_dir(&out).expect("a folder can be made");
            for name in names {
                put(&out.join(name), "old");
            }
            let killed = Command::new("strace")
                .args(["-f", "-qq", "-o", "/dev/null", "-e", &format!("trace={calls}"), "-e"])
                .arg(format!("inject={calls}:signal=KILL:when={time}"))
                .arg(env!("CARGO_BIN_EXE_helixlock"))
                .args(["screw", "data.csv", "--lead", "6 mm", "-o", "out"])
                .current_dir(folder.path())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .status()
                .expect("strace is there");
            let committed = out.join(".helixlock-commit").exists();
            let found = read("out").map(|text| text.expect("every file has its name"));
            for (found, new) in found.iter().zip(&new) {
                assert!(found == "old" || found == new, "{calls} {time}: half a file");
            }
            let all_old = found.iter().all(|text| text == "old");
            let all_new = found == new;
            assert!(all_old || all_new || committed, "{calls} {time}: a mixture");
            stages[usize::from(committed) + 2 * usize::from(all_new && !committed)] += 1;
            // Another command of the same folder finishes what stands in the journal.
            let other = ["scale", "model", "-o", "out"];
            assert_eq!(run_in(folder.path(), &other).status.code(), Some(0));
            let recovered = names.map(|name| fs::read_to_string(out.join(name)).expect("text"));
            let same = |index: usize| {
                recovered[index] == if committed { &*new[index] } else { &*found[index] }
            };
            assert!(same(0) && same(2), "{calls} {time}: lost on the way");
            let left: Vec<_> = listing(&out).into_iter().filter(|n| n.starts_with('.')).collect();
            assert_eq!(left, [""; 0], "{calls} {time}");
            if killed.success() {
                break;
            }
        }
    }
    assert!(stages.iter().all(|count| 0 < *count), "{stages:?}");
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_was_taken_back_survives_another_run() {
    let folder = scratch();
    let (task, task_word) = word(&folder, "task");
    let (out, out_word) = word(&folder, "out");
    assert_eq!(helixlock(&["challenge", "--seed", "3", "-o", &task_word]).status, 0);
    let [machine, data] =
        ["machine.toml", "data.csv"].map(|name| task.join(name).to_string_lossy().into_owned());
    let learn = ["learn", &machine, &data, "--accept", "-o", &out_word];
    assert_eq!(helixlock(&learn).status, 0);
    assert_eq!(helixlock(&["learn", "--undo", "-o", &out_word]).status, 0);
    let undone = fs::read(out.join("ledger.json")).expect("it is there");
    assert_eq!(helixlock(&learn).status, 0);
    assert_eq!(fs::read(out.join("ledger-1.json")).expect("the old one is kept"), undone);
    assert_eq!(helixlock(&learn).status, 0);
    assert!(!out.join("ledger-2.json").exists(), "nothing was taken back in between");
}

/// Whatever a command leaves in its folder, it says.
#[test]
fn what_is_written_is_said() {
    let commands = [
        "compare examples/hidden-gear/machine.toml FEW",
        "diagnose examples/hidden-gear/machine.toml FEW",
        "learn examples/hidden-gear/machine.toml FEW",
        "screw examples/ball-screw-grade/screw.csv --lead 2 --run-out 30",
        "straightness examples/lathe-straightness/probes.csv --spacing 45,40",
        "transmission examples/transmission-error/pulses.csv --input-lines 200 --output-lines 720 --ratio 36",
        "scale iso230 examples/inductosyn-scale/axis.csv",
        "scale model",
        "challenge --seed 6",
    ];
    for command in commands {
        let folder = scratch();
        let (out, out_word) = word(&folder, "out");
        let command = command.replace("FEW", &few_samples(folder.path(), "hidden-gear", 4));
        let mut words: Vec<&str> = command.split(' ').collect();
        words.extend(["-o", &out_word]);
        let run = helixlock(&words);
        assert_eq!((run.status, run.stderr.as_str()), (0, ""), "{command}");
        let place = format!("{}: ", out.display());
        let said = run.stdout.lines().find_map(|line| line.strip_prefix(&place));
        let mut said: Vec<&str> = said.unwrap_or_default().split(", ").collect();
        said.sort_unstable();
        assert_eq!(said, listing(&out), "{command}");
    }
}
