//! `--language zh`: every line of every report in Chinese, its columns where they were, and every
//! page and picture.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use helixlock_plant::CATALOGUE;
use regex::{Captures, Regex};

use crate::support::command::{few_samples, helixlock, put, repository, scratch};

/// A line each: what is run, in order, with `OUT` for a folder that has few samples of some examples. Every command and every verdict.
const STORIES: &str = r#"
sim examples/sg7430-6mm/machine.toml --length 10 -o OUT/sim
sim examples/sg7430-6mm/too-slow.toml --length 20 -o OUT/slow
certify examples/sg7430-6mm/machine.toml --length 10 --gates=2 --gates-spread 1 --wave OUT/gates.vcd --trace OUT/gates.csv --pulses 100 --page OUT/certify.html
faults examples/sg7430-6mm/machine.toml --instants 1 --page OUT/faults.html
sweep examples/sg7430-6mm/machine.toml --set "drive.frequency=80,160 Hz" --length 5 --shard 1/2 -o OUT/parts
sweep examples/sg7430-6mm/machine.toml --set "drive.frequency=80,160 Hz" --length 5 --shard 2/2 -o OUT/parts
merge OUT/parts -o OUT/all.csv
sweep examples/sg7430-6mm/machine.toml --draw "spindle.speed=5..6 rpm" --samples 2 --length 5 -o OUT/draws.csv --page OUT/sweep.html
init
init --template lead-screw-grinder -o OUT/grinder
import examples/real-worm-drive/logs/performance_dataset03.txt -o OUT/worm.csv
import examples/real-stage-fringes/first.txt --recipe examples/real-stage-fringes/fringes.toml -o OUT/first.csv
gen examples/sg7430-6mm/machine.toml --board icestick -o OUT/icestick
gen examples/sg7430-6mm/machine.toml --board upduino -o OUT/upduino
compare examples/recorder-and-screw/machine.toml examples/recorder-and-screw/data.csv -o OUT/compare
compare examples/encoder-1000-1024/machine.toml examples/encoder-1000-1024/data.csv -o OUT/encoder
compare examples/real-worm-drive/machine.toml OUT/worm.csv -o OUT/rotary
diagnose examples/hidden-gear/machine.toml OUT/hidden-gear.csv -o OUT/explained
diagnose examples/outside-the-catalogue/machine.toml OUT/outside-the-catalogue.csv -o OUT/unexplained
diagnose examples/hidden-gear/machine.toml OUT/thermal-day.csv -o OUT/doubtful
learn examples/hidden-gear/machine.toml OUT/hidden-gear.csv -o OUT/learn
learn --undo -o OUT/learn
learn --undo -o OUT/learn
learn examples/real-worm-drive/machine.toml OUT/worm.csv -o OUT/worm
add examples/hidden-gear/machine.toml gear-error --fit OUT/hidden-gear.csv -o OUT/gear.toml
add examples/hidden-gear/machine.toml backlash --fit OUT/hidden-gear.csv -o OUT/backlash.toml
diagnose OUT/gear.toml OUT/hidden-gear.csv -o OUT/nothing-missing
discover examples/outside-the-catalogue/machine.toml OUT/outside-the-catalogue.csv --page OUT/discover.html
challenge --seed 3 -o OUT/challenge
challenge --experiment 1
challenge --score 1 --seed 79
board list
effects
dividers --table
dividers --lead "6 mm"
dividers --lead "6 mm" --lead "1/4 in" --find-lines --tolerance 20
screw examples/ball-screw-grade/screw.csv --lead "2 mm" --run-out "30 mm" --uncertainty "0.5 um" -o OUT/screw
screw examples/trapezoidal-screw/screw.csv --standard jbt2886 --lead "6 mm" -o OUT/thread
screw examples/ball-screw-grade/screw.csv --lead "2 mm" --run-out "30 mm" --grade 3 --sheet examples/ball-screw-grade/sheet.toml -o OUT/sheet
straightness --plan --spacing "45 mm,40 mm"
straightness examples/lathe-straightness/probes.csv --spacing "45 mm,40 mm" --simulate -o OUT/straightness
straightness examples/lathe-straightness/probes.csv --spacing "45 mm,40 mm" --zeros-matched --sheet examples/lathe-straightness/sheet.toml -o OUT/zeros
scale build examples/inductosyn-scale/table.csv -o OUT/table.hex --joint-zone "8 mm"
scale apply OUT/table.hex examples/inductosyn-scale/check.csv -o OUT/applied
scale export OUT/table.hex --format linuxcnc -o OUT/x.comp
scale export OUT/table.hex --format siemens -o OUT/x.spf
scale iso230 examples/inductosyn-scale/axis.csv --sheet examples/inductosyn-scale/sheet.toml -o OUT/iso230
scale model -o OUT/model
transmission examples/transmission-error/pulses.csv --input-lines 200 --output-lines 720 --ratio 36 --truth examples/transmission-error/truth.csv --shaft worm=36 -o OUT/transmission
"#;

/// Examples of whose samples few tell as much.
const FEW: [&str; 3] = ["hidden-gear", "thermal-day", "outside-the-catalogue"];

/// Commands that write pages.
const WITH_PAGES: [&str; 12] = [
    "certify",
    "compare",
    "diagnose",
    "discover",
    "faults",
    "learn",
    "scale",
    "screw",
    "sim",
    "straightness",
    "sweep",
    "transmission",
];

/// Words that are names: of blocks and ports, of parts and boards, of methods, formats and programs.
const NAMES: &str = "
alarm calibrator clock compensator correct device direction discriminator fault grating laser
measuring playback ring selector start step zero
coincidence divided down due forward line meter open pulse standard taken toggle6 toggle11 up
fourier least-squares analog digital subdivided counting subdivided-counting
height pitch order harmonic lines rack size offset amplitude phase
lead-screw-grinder screw-axis laser-axis rotary-table telescope robot-joint gear-tester
machine.toml data.csv answer.json report.html unguided raw phd2 ra none worm fringe pass time steps
Lattice iCEstick evaluation kit UPduino helixlock motion length-reference angle-reference workpiece electronics actuator
ISO JB GB VDI DGQ STR UTF-8 ASCII PHD2 FPGA LED RGB Pmod RC GND NAND3 USB OSC SRAM Ciddor
hx1k-tq144 up5k-sg48 SPI tx column Vu Lu PLu Pa Ps PLu
um mm nm us ns Hz MHz ppm arcsec rpm deg min µm pi in m s h N
exp sin abs fract sqrt step ramp ppm width
ms rad JCGM ep lu
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
    static WORD: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"[A-Za-z][A-Za-z0-9_./\[\]'-]*").expect("a pattern"));
    let found = WORD.find_iter(line).map(|found| found.as_str());
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
fn own_text(shown: &str, folder: &str, titles: &str) -> String {
    let own =
        format!(r"(?m)`[^`\n]*`|^ *helixlock .*$|δ = .*|^下一步：.*$|{folder}[\w./-]*|{titles}");
    Regex::new(&own).expect("a pattern").replace_all(shown, "").into_owned()
}

/// Titles of all machine files of the examples, and names of their gears, as a pattern.
fn titles() -> String {
    let files = below(&repository().join("examples"), &["toml"]);
    let title = Regex::new(r#"(?m)^(?:title|name) = "(.*)""#).expect("a pattern");
    let found = files.iter().flat_map(|path| {
        let text = read(path);
        let titles = title.captures_iter(&text).map(|found| regex::escape(&found[1]));
        titles.collect::<Vec<_>>()
    });
    found.collect::<Vec<_>>().join("|")
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).expect("a text that is there")
}

/// All files below a folder with one of these endings.
fn below(folder: &Path, endings: &[&str]) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder that can be read");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let ends = |path: &PathBuf| {
        path.extension().is_some_and(|ending| endings.iter().any(|one| ending == *one))
    };
    let found = |path: PathBuf| {
        if path.is_dir() {
            below(&path, endings)
        } else {
            Some(path).filter(ends).into_iter().collect()
        }
    };
    paths.flat_map(found).collect()
}

/// Texts of a page or picture, a line each, without listings and what the user wrote into fields.
fn texts(page: &str) -> String {
    let kept = r#"(?s)<style>.*?</style>|<pre>.*?</pre>|<dl class="fields">.*?</dl>"#;
    let page = Regex::new(kept).expect("a pattern").replace_all(page, |kept: &Captures<'_>| {
        let name = Regex::new("<dt>[^<]*</dt>").expect("a pattern");
        name.find_iter(&kept[0]).map(|name| name.as_str()).collect::<String>()
    });
    let text = Regex::new(">[^<>]+<").expect("a pattern");
    let texts = text.find_iter(&page).map(|text| text.as_str().trim_matches(['<', '>']).trim());
    let marks = [("&lt;", "<"), ("&gt;", ">"), ("&quot;", "\""), ("&apos;", "'"), ("&amp;", "&")];
    let unescaped = |text: String, (written, mark): &(&str, &str)| text.replace(written, mark);
    marks.iter().fold(texts.collect::<Vec<_>>().join("\n"), unescaped)
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn every_line_of_every_report_is_chinese() {
    let (folder, names, titles) = (scratch(), names(), titles());
    let (mut pages, mut written) = (BTreeMap::new(), BTreeSet::new());
    let folder = folder.path().to_str().expect("a path of text");
    let mut wrong = String::new();
    for example in FEW {
        few_samples(Path::new(folder), example, 4);
    }
    for story in STORIES.lines().filter(|line| !line.is_empty()) {
        let words = words(story, folder);
        let run = helixlock(&words.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(run.status < 2, "{story}: {}", run.stderr);
        let mut shown = run.stdout.clone();
        for path in below(Path::new(folder), &["html", "svg"]) {
            let page = read(&path);
            if pages.get(&path) != Some(&page) {
                let is_picture = path.extension().is_some_and(|ending| ending == "svg");
                assert!(is_picture || page.contains("<html lang=\"zh\">"), "{story}");
                shown.extend(["\n", &texts(&page)]);
                written.extend(story.split(' ').next());
                pages.insert(path, page);
            }
        }
        for line in own_text(&shown, folder, &titles).lines() {
            let english = english(line, &names);
            if !english.is_empty() {
                writeln!(wrong, "{story}\n    {line}\n    {english:?}").expect("memory takes it");
            }
        }
        frames_are_closed(story, &run.stdout);
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert_eq!(written, WITH_PAGES.into());
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
    for line in helixlock_evidence::same_output::STORIES
        .lines()
        .filter(|line| !line.starts_with(['#', '[', ' ']))
    {
        let command = line.split(' ').next().unwrap_or_default();
        assert!(said.contains(command) || silent.contains(&command), "{command}");
    }
}

/// `explained` is a phrase of the table.
#[test]
fn a_title_stays_as_its_owner_wrote_it() {
    let (folder, title) = (scratch(), "Grinder in hall 3, explained");
    let machine = std::fs::read_to_string(repository().join("examples/sg7430-6mm/machine.toml"));
    let own = |line: &str| {
        let is_title = line.starts_with("title = ");
        if is_title { format!("title = \"{title}\"\n") } else { format!("{line}\n") }
    };
    let path = folder.path().join("machine.toml");
    put(&path, &machine.expect("an example").lines().map(own).collect::<String>());
    let [path, out] = [path, folder.path().join("out")].map(|path| path.display().to_string());
    let run = helixlock(&["sim", &path, "--length", "5", "-o", &out, "--language", "zh"]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    let page = std::fs::read_to_string(folder.path().join("out/report.html")).expect("a page");
    assert!(run.stdout.contains(title) && page.contains(&format!("<h1>{title}")), "{}", run.stdout);
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
