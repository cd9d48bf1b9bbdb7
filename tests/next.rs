//! Every command says the command that comes next, and that command runs.

use std::path::Path;
use std::process::{Command, Output};

use crate::support::command::{few_samples, repository, scratch};

/// A line each, in one folder beside the examples, with few samples of two of them: words, and what is next, up to the files.
const STORIES: &[(&str, &str)] = &[
    ("init", "helixlock init --template lead-screw-grinder -o lead-screw-grinder"),
    (
        "init --template robot-joint -o 'my joint'",
        "helixlock diagnose 'my joint/machine.toml' 'my joint/data.csv'",
    ),
    (
        "init --template lead-screw-grinder -o grinder",
        "helixlock sim grinder/machine.toml -o grinder/sim",
    ),
    ("import EX/real-worm-drive/logs/performance_dataset03.txt", "helixlock import "),
    ("import EX/real-worm-drive/logs/performance_dataset03.txt -o worm.csv", "helixlock init"),
    (
        "import EX/real-worm-drive/logs/performance_dataset03.txt -o 'my joint/worm.csv'",
        "helixlock compare 'my joint/machine.toml' 'my joint/worm.csv'",
    ),
    ("sim EX/sg7430-6mm/machine.toml --length 20 -o sim", "helixlock compare "),
    ("compare EX/hidden-gear/machine.toml hidden-gear.csv", "helixlock diagnose "),
    ("diagnose EX/hidden-gear/machine.toml hidden-gear.csv", "helixlock learn "),
    (
        "diagnose EX/outside-the-catalogue/machine.toml outside-the-catalogue.csv --with EX/outside-the-catalogue/rack.toml",
        "helixlock learn ",
    ),
    (
        "learn EX/hidden-gear/machine.toml hidden-gear.csv -o better",
        "helixlock compare better/machine.toml ",
    ),
    ("learn --undo -o better", "helixlock diagnose better/machine.toml "),
    ("learn EX/real-worm-drive/machine.toml worm.csv", "helixlock discover "),
    (
        "add EX/hidden-gear/machine.toml gear-error --fit hidden-gear.csv -o gear.toml",
        "helixlock compare gear.toml ",
    ),
    (
        "challenge --seed 3 -o challenge",
        "helixlock compare challenge/machine.toml challenge/data.csv",
    ),
    ("certify EX/sg7430-6mm/machine.toml --length 10 --pulses 100", "helixlock faults "),
    ("faults EX/sg7430-6mm/machine.toml --instants 1 --output 'all flips.csv'", "helixlock gen "),
    (
        "faults EX/sg7430-6mm/machine.toml --instants 1 --shard 1/1 -o parts",
        "helixlock merge parts -o faults.csv",
    ),
    ("effects", "helixlock effects screw-periodic"),
    ("dividers --lead '6 mm'", "helixlock init"),
    ("scale build EX/inductosyn-scale/table.csv -o table.hex", "helixlock scale export table.hex "),
    ("scale model -o scale", "helixlock scale build scale/table-run.csv -o table.hex"),
    (
        "transmission EX/transmission-error/pulses.csv --input-lines 200 --output-lines 720 --ratio 36 -o worm",
        "helixlock init",
    ),
    ("scale iso230 EX/inductosyn-scale/axis.csv", "helixlock scale build "),
];

/// Reports that leave nothing to do.
const ENDS: &[&str] = &[
    "compare gear.toml hidden-gear.csv",
    "diagnose gear.toml hidden-gear.csv",
    "compare EX/hidden-gear/machine.toml hidden-gear.csv --json",
];

fn run(folder: &Path, words: &[String]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_helixlock"));
    command.args(words).current_dir(folder).output().expect("the command starts")
}

fn words(line: &str) -> Vec<String> {
    let examples = repository().join("examples");
    shlex::split(&line.replace("EX", examples.to_str().expect("text"))).expect("words of a shell")
}

/// What the command says is next, as a shell reads it; it must not have failed.
fn next(folder: &Path, line: &[String]) -> Option<String> {
    let run = run(folder, line);
    let said = String::from_utf8(run.stdout).expect("text");
    assert!(matches!(run.status.code(), Some(0 | 1)), "{line:?}: {:?}", run.stderr);
    let mut next = said.lines().filter_map(|line| line.strip_prefix("next: "));
    let first = next.next().map(str::to_owned);
    assert!(next.next().is_none(), "{said}");
    first
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_is_next_runs() {
    let folder = scratch();
    for example in ["hidden-gear", "outside-the-catalogue"] {
        few_samples(folder.path(), example, 4);
    }
    for (line, expected) in STORIES {
        let next_line = next(folder.path(), &words(line));
        let next_line = next_line.unwrap_or_else(|| panic!("{line}: nothing is next"));
        assert!(next_line.starts_with(expected), "{line}: {next_line}");
        let further = shlex::split(&next_line).expect("words of a shell");
        if !["helixlock faults ", "helixlock discover "].contains(expected) {
            next(folder.path(), &further[1..]);
        }
    }
    for line in ENDS {
        assert_eq!(next(folder.path(), &words(line)), None, "{line}");
    }
}
