//! `--language zh`: every line of every report in Chinese, its columns where they were.

use std::collections::BTreeSet;
use std::fmt::Write;

use helixlock_plant::CATALOGUE;
use regex::Regex;

use crate::support::command::{Run, helixlock, scratch};

/// A line each: what is run, in order, with `OUT` for a folder. Every command and every verdict.
const STORIES: &str = r#"
sim examples/sg7430-6mm/machine.toml --length 10 -o OUT/sim
sim examples/sg7430-6mm/too-slow.toml --length 20 -o OUT/slow
certify examples/sg7430-6mm/machine.toml --length 10 --gates=2 --pulses 100
faults examples/sg7430-6mm/machine.toml --instants 1
sweep examples/sg7430-6mm/machine.toml --set "drive.frequency=80,160 Hz" --length 5 --shard 1/2 -o OUT/parts
sweep examples/sg7430-6mm/machine.toml --set "drive.frequency=80,160 Hz" --length 5 --shard 2/2 -o OUT/parts
merge OUT/parts -o OUT/all.csv
init
init --template lead-screw-grinder -o OUT/grinder
import examples/real-worm-drive/logs/performance_dataset03.txt -o OUT/worm.csv
import examples/real-stage-fringes/first.txt --recipe examples/real-stage-fringes/fringes.toml -o OUT/first.csv
gen examples/sg7430-6mm/machine.toml --board icestick -o OUT/icestick
gen examples/sg7430-6mm/machine.toml --board upduino -o OUT/upduino
compare examples/recorder-and-screw/machine.toml examples/recorder-and-screw/data.csv -o OUT/compare
compare examples/encoder-1000-1024/machine.toml examples/encoder-1000-1024/data.csv
compare examples/real-worm-drive/machine.toml OUT/worm.csv
diagnose examples/hidden-gear/machine.toml examples/hidden-gear/data.csv
diagnose examples/outside-the-catalogue/machine.toml examples/outside-the-catalogue/data.csv
diagnose examples/hidden-gear/machine.toml examples/thermal-day/data.csv
learn examples/hidden-gear/machine.toml examples/hidden-gear/data.csv -o OUT/learn
learn --undo -o OUT/learn
learn --undo -o OUT/learn
learn examples/real-worm-drive/machine.toml OUT/worm.csv -o OUT/worm
add examples/hidden-gear/machine.toml gear-error --fit examples/hidden-gear/data.csv -o OUT/gear.toml
add examples/hidden-gear/machine.toml backlash --fit examples/hidden-gear/data.csv -o OUT/backlash.toml
diagnose OUT/gear.toml examples/hidden-gear/data.csv
discover examples/outside-the-catalogue/machine.toml examples/outside-the-catalogue/data.csv
challenge --seed 3 -o OUT/challenge
challenge --experiment 1
challenge --score 1
board list
effects
dividers --table
dividers --lead "6 mm"
dividers --lead "6 mm" --lead "1/4 in" --find-lines --tolerance 20
screw examples/ball-screw-grade/screw.csv --lead "2 mm" --run-out "30 mm" --uncertainty "0.5 um" -o OUT/screw
screw examples/trapezoidal-screw/screw.csv --standard jbt2886 --lead "6 mm"
screw examples/ball-screw-grade/screw.csv --lead "2 mm" --run-out "30 mm" --grade 3 --sheet examples/ball-screw-grade/sheet.toml
straightness --plan --spacing "45 mm,40 mm"
straightness examples/lathe-straightness/probes.csv --spacing "45 mm,40 mm" --simulate
straightness examples/lathe-straightness/probes.csv --spacing "45 mm,40 mm" --zeros-matched --sheet examples/lathe-straightness/sheet.toml
scale build examples/inductosyn-scale/table.csv -o OUT/table.hex --joint-zone "8 mm"
scale apply OUT/table.hex examples/inductosyn-scale/check.csv
scale export OUT/table.hex --format linuxcnc -o OUT/x.comp
scale export OUT/table.hex --format siemens -o OUT/x.spf
scale iso230 examples/inductosyn-scale/axis.csv --sheet examples/inductosyn-scale/sheet.toml
scale model
transmission examples/transmission-error/pulses.csv --input-lines 200 --output-lines 720 --ratio 36 --truth examples/transmission-error/truth.csv --shaft worm=36
"#;

/// Words that are names: of blocks and ports, of parts and boards, of methods, formats and programs.
const NAMES: &str = "
alarm calibrator clock compensator correct device direction discriminator fault grating laser
measuring playback ring selector start step zero
fourier least-squares analog digital subdivided counting subdivided-counting
height pitch order harmonic lines rack size offset amplitude phase
lead-screw-grinder screw-axis laser-axis rotary-table telescope robot-joint gear-tester
machine.toml data.csv answer.json report.html unguided raw phd2 ra none worm fringe pass time steps
Lattice iCEstick evaluation kit UPduino helixlock motion length-reference angle-reference workpiece electronics actuator
ISO JB GB VDI DGQ STR UTF-8 ASCII PHD2 FPGA LED RGB Pmod RC GND NAND3 USB OSC SRAM Ciddor
hx1k-tq144 up5k-sg48 SPI tx column Vu Lu PLu Pa Ps PLu
um mm nm us ns Hz MHz ppm arcsec rpm deg min µm pi in m s h N
exp sin fract sqrt step sqrt ramp ppm
";

fn names() -> BTreeSet<&'static str> {
    let parameters = CATALOGUE.iter().flat_map(|card| card.parameters.iter());
    let kinds = CATALOGUE.iter().map(|card| card.kind);
    kinds
        .chain(parameters.map(|parameter| &*parameter.name))
        .chain(NAMES.split_whitespace())
        .collect()
}

/// The words of a line that should have been Chinese.
fn english<'a>(line: &'a str, names: &BTreeSet<&str>) -> Vec<&'a str> {
    let word = Regex::new(r"[A-Za-z][A-Za-z0-9_./\[\]'-]*").expect("a pattern");
    let found = word.find_iter(line).map(|found| found.as_str());
    found.filter(|word| 1 < word.len() && !names.contains(word) && !is_key(word)).collect()
}

/// Keys and paths, such as `error_um` and `out/report.html`, and symbols, such as `V300`.
fn is_key(word: &str) -> bool {
    let symbol = word.len() < 6 && word.contains(|c: char| c.is_ascii_digit());
    symbol || word.contains(['_', '/', '[']) || word.trim_end_matches('.').contains('.')
}

fn words(line: &str, folder: &str) -> Vec<String> {
    let words = shlex::split(&line.replace("OUT", folder)).expect("words of a shell");
    words.into_iter().chain(["--language".into(), "zh".into()]).collect()
}

/// What is shown, without what the user has written: quotes, titles, folders, commands.
fn own_text(run: &Run, folder: &str) -> String {
    let titles = "SG7430 grinding a 6 mm screw|SG7430 at 15 rpm with too slow a step clock";
    let own =
        format!(r"(?m)`[^`\n]*`|^ *helixlock .*$|δ = .*|^下一步：.*$|{folder}[\w./-]*|{titles}");
    Regex::new(&own).expect("a pattern").replace_all(&run.stdout, "").into_owned()
}

#[test]
fn every_line_of_every_report_is_chinese() {
    let (folder, names) = (scratch(), names());
    let folder = folder.path().to_str().expect("a path of text");
    let mut wrong = String::new();
    for story in STORIES.lines().filter(|line| !line.is_empty()) {
        let words = words(story, folder);
        let run = helixlock(&words.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(run.status < 2, "{story}: {}", run.stderr);
        for line in own_text(&run, folder).lines() {
            let english = english(line, &names);
            if !english.is_empty() {
                writeln!(wrong, "{story}\n    {line}\n    {english:?}").expect("memory takes it");
            }
        }
        frames_are_closed(story, &run.stdout);
    }
    assert!(wrong.is_empty(), "{wrong}");
}

/// All lines of a table in a frame are as wide as each other.
fn frames_are_closed(story: &str, shown: &str) {
    let mut width = None;
    for line in shown.lines() {
        let framed = line.starts_with(['│', '┌', '╞', '└', '+']);
        let found = framed.then(|| unicode_width::UnicodeWidthStr::width(line));
        assert!(width.is_none() || found.is_none() || width == found, "{story}:\n{shown}");
        width = found;
    }
}

#[test]
fn every_command_is_told_in_chinese() {
    let said: BTreeSet<_> = STORIES.lines().filter_map(|line| line.split(' ').next()).collect();
    let silent = ["completions", "man", "serve"]; // what programs read, and what only an error ends
    for line in
        xtask::same_output::STORIES.lines().filter(|line| !line.starts_with(['#', '[', ' ']))
    {
        let command = line.split(' ').next().unwrap_or_default();
        assert!(said.contains(command) || silent.contains(&command), "{command}");
    }
}

#[test]
fn data_have_no_language() {
    let words = ["compare", "examples/hidden-gear/machine.toml", "examples/hidden-gear/data.csv"];
    let [one, other] = [&["--json"][..], &["--json", "--language", "zh"]].map(|more| {
        let words: Vec<_> = words.iter().chain(more).copied().collect();
        helixlock(&words).stdout
    });
    assert_eq!(one, other);
}
