//! The workbench as its users meet it: in a real Chromium.

mod kills;
mod screens;

use std::fmt::Write as _;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use serde_json::Value;
use tempfile::TempDir;

use crate::support::command::{helixlock, put, repository, scratch, word};

/// `helixlock serve` over a folder, ended with the value.
pub(crate) struct Server {
    child: Child,
    address: String,
}

impl Server {
    pub(crate) fn over(folder: &Path) -> Self {
        Self::run(Command::new(env!("CARGO_BIN_EXE_helixlock")), folder)
    }

    /// The same by a command that runs it.
    fn run(mut command: Command, folder: &Path) -> Self {
        let mut child = command
            .arg("serve")
            .arg(folder)
            .stdout(Stdio::piped())
            .spawn()
            .expect("the command starts");
        let mut address = String::new();
        let out = child.stdout.take().expect("a pipe");
        BufReader::new(out).read_line(&mut address).expect("a line");
        Self { child, address: address.trim().to_owned() }
    }
}

impl Server {
    fn host(&self) -> &str {
        self.address
            .strip_prefix("http://")
            .and_then(|rest| rest.split('/').next())
            .expect("a host")
    }

    /// The path of something below the token.
    fn path(&self, rest: &str) -> String {
        let from = "http://".len() + self.host().len();
        format!("{}{rest}", &self.address[from..])
    }

    /// Sends a request as it stands; the status and what was told.
    fn send(&self, method: &str, path: &str, head: &str, body: &str) -> Option<(u16, String)> {
        let mut stream = TcpStream::connect(self.host()).ok()?;
        let length = body.len();
        let request = format!(
            "{method} {path} HTTP/1.1\r\n{head}Connection: close\r\nContent-Length: {length}\r\n\r\n{body}"
        );
        stream.write_all(request.as_bytes()).ok()?;
        let mut answer = String::new();
        stream.read_to_string(&mut answer).ok()?;
        let status = answer.split(' ').nth(1)?.parse().ok()?;
        Some((status, answer.split_once("\r\n\r\n")?.1.to_owned()))
    }

    /// The same from the page itself.
    fn ask(&self, method: &str, what: &str, body: &str) -> Option<(u16, String)> {
        let head = format!("Host: {}\r\n", self.host());
        self.send(method, &self.path(&format!("api/{what}")), &head, body)
    }

    /// The answer to what is not refused.
    fn answered(&self, method: &str, what: &str, body: &str) -> Value {
        let (status, answer) = self.ask(method, what, body).expect("an answer");
        assert_eq!(status, 200, "{what}: {answer}");
        json(&answer)
    }

    /// How a page asks for a change of the files as they are now.
    fn change(&self, what: &str) -> String {
        format!("{what}?machine=machine.toml&data=data.csv&revision={}", self.revision())
    }

    /// Work that was begun with these words, when it has come to its end.
    fn finished(&self, words: &str) -> Value {
        let mut job = self.answered("POST", &(self.change("begin") + words), "{}");
        while job["running"] == true {
            std::thread::sleep(Duration::from_millis(20));
            job = self.answered("GET", &format!("job?job={}", job["job"]), "");
        }
        job
    }

    fn revision(&self) -> String {
        let (_, state) = self.ask("GET", "state?machine=machine.toml", "").expect("an answer");
        json(&state)["revision"].as_str().expect("a revision").to_owned()
    }

    /// Saves a machine file over a revision; the status.
    fn save(&self, revision: &str, text: &str) -> Option<u16> {
        let what = format!("machine?machine=machine.toml&revision={revision}");
        let body = serde_json::json!({ "text": text }).to_string();
        self.ask("POST", &what, &body).map(|(status, _)| status)
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        self.child.kill().expect("the server runs");
        self.child.wait().expect("the server ends");
    }
}

/// A script that drives a browser.
pub(crate) fn driver(script: &str) -> Command {
    let mut command = Command::new("node");
    command.arg(repository().join("tests/workbench").join(script));
    command.env("NODE_FOLDER", node_folder()).env("CHROMIUM", "/usr/bin/chromium");
    command
}

/// The folder with the packages of npm, by the command that one of them brings.
fn node_folder() -> PathBuf {
    let own = repository().join("target/tools/node/node_modules/.bin");
    let path = std::env::var_os("PATH").unwrap_or_default();
    let mut folders = std::iter::once(own).chain(std::env::split_paths(&path));
    let command = folders.find_map(|folder| folder.join("playwright-core").canonicalize().ok());
    let command =
        command.expect("`playwright-core` of npm is needed: `cargo xtask check` installs it");
    command.ancestors().nth(2).expect("a folder of packages").to_owned()
}

/// Does a story in a browser; gives what it said.
pub(crate) fn story(name: &str, server: &Server, words: &[&str]) -> String {
    let mut command = driver("stories.mjs");
    command.args([name, &server.address]).args(words);
    if std::env::var_os("UPDATE_PICTURES").is_some() {
        command.env("PICTURES", repository().join("docs/figures/workbench"));
    }
    let output = command.output().expect("`node` starts; it is the Debian package `nodejs`");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    String::from_utf8(output.stdout).expect("text")
}

/// A challenge: its machine file alone in a folder, and its data elsewhere.
fn challenge(seed: &str) -> (TempDir, TempDir) {
    let (bench, elsewhere) = (scratch(), scratch());
    let run = helixlock(&[
        "challenge",
        "--seed",
        seed,
        "-o",
        elsewhere.path().to_str().expect("a path of text"),
    ]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    let machine = std::fs::read_to_string(elsewhere.path().join("machine.toml")).expect("a file");
    put(&bench.path().join("machine.toml"), &machine);
    (bench, elsewhere)
}

/// A challenge with its data in one folder.
pub(crate) fn with_data(seed: &str) -> TempDir {
    let (bench, elsewhere) = challenge(seed);
    let data = std::fs::read_to_string(elsewhere.path().join("data.csv")).expect("its data");
    put(&bench.path().join("data.csv"), &data);
    bench
}

/// The same with a workpiece that is ground in a minute.
pub(crate) fn shortened(bench: TempDir) -> TempDir {
    let path = bench.path().join("machine.toml");
    let machine = std::fs::read_to_string(&path).expect("a machine file");
    put(&path, &machine.replace("length = \"600 mm\"", "length = \"60 mm\""));
    bench
}

/// A folder with the files of an example.
fn example(name: &str) -> TempDir {
    let bench = scratch();
    for file in ["machine.toml", "data.csv"] {
        let text = std::fs::read_to_string(repository().join("examples").join(name).join(file));
        put(&bench.path().join(file), &text.expect("a file of the example"));
    }
    bench
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).expect("JSON")
}

#[test]
fn the_whole_loop_needs_the_mouse_alone_and_agrees_with_learn() {
    let (bench, elsewhere) = challenge("6");
    let (_, data) = word(&elsewhere, "data.csv");
    let server = Server::over(bench.path());
    story("learns", &server, &[&data]);
    let (_, machine) = word(&elsewhere, "machine.toml");
    let learned = elsewhere.path().join("learned");
    let run = helixlock(&["learn", &machine, &data, "-o", learned.to_str().unwrap()]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    let text = |path: PathBuf| std::fs::read_to_string(path).expect("a machine file");
    assert_eq!(text(bench.path().join("machine.toml")), text(learned.join("machine.toml")));
}

#[test]
fn a_machine_is_described_from_nothing() {
    let lead = "1/4 in";
    let run = helixlock(&["dividers", "--lead", lead, "--json"]);
    let wheels = json(&run.stdout)["settings"][0].clone();
    let [a, b] = ["a", "b"].map(|key| wheels[key].to_string());
    let bench = scratch();
    story("describes", &Server::over(bench.path()), &[lead, &a, &b]);
    let saved = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    for line in [format!("lead = \"{lead}\""), format!("\na = {a}"), format!("\nb = {b}")] {
        assert!(saved.contains(&line), "{saved}");
    }
    let machine = bench.path().join("machine.toml");
    let words = ["sim", machine.to_str().unwrap(), "--length", "1 mm", "-o"];
    let out = bench.path().join("sim");
    let run = helixlock(&[&words[..], &[out.to_str().unwrap()]].concat());
    assert_eq!(run.status, 0, "what was saved runs: {}", run.stderr);
}

/// A text that is not saved is simulated from a file of ours; what is wrong with it is told of the user's.
#[test]
fn what_is_wrong_with_a_draft_is_told_of_the_machine_file() {
    let bench = scratch();
    let text = std::fs::read_to_string("examples/real-worm-drive/machine.toml").unwrap();
    put(&bench.path().join("machine.toml"), &text);
    let server = Server::over(bench.path());
    let body = serde_json::json!({ "text": text }).to_string();
    let mut job = server.answered("POST", &(server.change("begin") + "&command=draft"), &body);
    while job["running"] == true {
        std::thread::sleep(Duration::from_millis(20));
        job = server.answered("GET", &format!("job?job={}", job["job"]), "");
    }
    let error = job["error"].as_str().expect("it has no device");
    assert!(error.starts_with("helixlock: machine.toml") && !error.contains("draft"), "{error}");
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn an_effect_is_tried_taken_and_taken_back() {
    let (bench, elsewhere) = challenge("6");
    let data = std::fs::read_to_string(elsewhere.path().join("data.csv")).unwrap();
    put(&bench.path().join("data.csv"), &data);
    let answer = std::fs::read_to_string(elsewhere.path().join("answer.json")).unwrap();
    let effect = json(&answer)["effects"][0]["effect"].as_str().expect("an effect").to_owned();
    story("tries", &Server::over(bench.path()), &[&effect]);
    let ledger = std::fs::read_to_string(bench.path().join("ledger.json")).unwrap();
    let rounds = json(&ledger)["rounds"].as_array().expect("rounds").clone();
    let machine = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    assert_eq!(rounds.len(), 2);
    assert_eq!(rounds[1]["machine"], machine.as_str());
    let folder = bench.path().to_str().unwrap();
    assert_eq!(helixlock(&["learn", "--undo", "-o", folder]).status, 0, "the command's own undo");
}

#[test]
fn what_is_not_explained_changes_nothing() {
    let bench = example("outside-the-catalogue");
    let before = std::fs::read(bench.path().join("machine.toml")).unwrap();
    story("leaves", &Server::over(bench.path()), &[]);
    assert_eq!(std::fs::read(bench.path().join("machine.toml")).unwrap(), before);
}

/// Every example with a machine file and data, every third unless all are asked for; those that are read
/// from an instrument's file first with the folder of the example, the machine file, the file and its
/// recipe.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_screen_shows_what_the_command_prints() {
    let names = ["hidden-gear", "recorder-and-screw", "thermal-day", "encoder-1000-1024"];
    let names = names.into_iter().chain(["outside-the-catalogue"]);
    let read = [
        ["real-worm-drive", "machine.toml", "dataset01.csv", ""],
        ["real-worm-drive", "astro-physics.toml", "logs/performance_dataset03.txt", ""],
        ["real-stage-fringes", "machine.toml", "first.txt", "fringes.toml"],
    ];
    let benches = names.map(example).chain(read.map(imported));
    for bench in benches.step_by(if all() { 1 } else { 3 }) {
        let shown = json(&story("shows", &Server::over(bench.path()), &[]));
        let words = ["machine.toml", "data.csv"].map(|file| word(&bench, file).1);
        for command in ["compare", "diagnose"] {
            let printed = helixlock(&[command, &words[0], &words[1], "--json"]).stdout;
            assert_eq!(shown[command], printed.as_str(), "{command}, {}", words[0]);
        }
    }
}

/// A folder with a machine file of an example, and what `import` makes of an instrument's file.
fn imported([folder, machine, file, recipe]: [&str; 4]) -> TempDir {
    let bench = scratch();
    let folder = repository().join("examples").join(folder);
    let text = std::fs::read_to_string(folder.join(machine)).expect("a file of the example");
    put(&bench.path().join("machine.toml"), &text);
    let [file, recipe_word] = [file, recipe].map(|name| folder.join(name).display().to_string());
    let data = word(&bench, "data.csv").1;
    let words = ["import", &file, "-o", &data, "--recipe", &recipe_word];
    let run = helixlock(&words[..if recipe.is_empty() { 4 } else { 6 }]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    bench
}

/// Every example of the device, one of them unless all are asked for.
#[test]
fn the_device_shows_what_sim_prints() {
    let names = ["sg7430-6mm", "sg7430-sixth-inch", "sg7430-half-pi-module"];
    for name in &names[..if all() { 3 } else { 1 }] {
        let bench = scratch();
        let file = repository().join("examples").join(name).join("machine.toml");
        put(&bench.path().join("machine.toml"), &std::fs::read_to_string(file).expect("a file"));
        let mut shown = json(&story("simulates", &Server::over(bench.path()), &[]));
        let (machine, out) = (word(&bench, "machine.toml").1, word(&bench, "out").1);
        let run = helixlock(&["sim", &machine, "-o", &out, "--json"]);
        let mut printed = json(&run.stdout);
        for summary in [&mut shown, &mut printed] {
            summary["machine_file"] = Value::Null; // a text that is not saved has another name
        }
        assert_eq!(shown, printed, "{name}");
    }
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_device_follows_its_form() {
    let bench = example("hidden-gear");
    let path = bench.path().join("machine.toml");
    let machine = std::fs::read_to_string(&path).unwrap().replace("\"600 mm\"", "\"20 mm\"");
    put(&path, &machine);
    story("lives", &Server::over(bench.path()), &["12 rpm"]);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), machine.replace("\"6 rpm\"", "\"12 rpm\""));
}

#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn two_tabs_lose_nothing_of_each_other() {
    let bench = example("hidden-gear");
    story("tabs", &Server::over(bench.path()), &[]);
}

/// The machine of an example, and so many samples of a wave over a metre with something like noise.
fn many(rows: u32) -> TempDir {
    let bench = example("hidden-gear");
    let mut text = String::from("position_mm,error_um\n");
    for row in 0..rows {
        let place = 1000.0 * f64::from(row + 1) / f64::from(rows);
        let noise = libm::sin(f64::from(row) * f64::from(row % 977));
        let error = 0.9 * libm::sin(std::f64::consts::TAU * place / 3.2) + 0.1 * noise;
        writeln!(text, "{place:.6},{error:.5}").expect("memory");
    }
    put(&bench.path().join("data.csv"), &text);
    bench
}

#[test]
#[ignore = "measures time: alone, on a quiet machine"]
fn three_hundred_thousand_samples_pan_and_zoom_below_fifty_milliseconds_a_frame() {
    let bench = many(300_000);
    story("pans", &Server::over(bench.path()), &[]);
}

/// Processor time of server and browser together, which is no less than what a user waits for on a
/// machine that does nothing else; docs/performance.md states both.
#[test]
#[ignore = "measures time: alone, on a quiet machine"]
fn five_million_samples_open_in_ten_seconds() {
    let bench = many(5_000_000);
    let server = Server::over(bench.path());
    let id = server.child.id();
    let seconds: f64 = story("opens", &server, &[&id.to_string()]).parse().expect("seconds");
    let status = std::fs::read_to_string(format!("/proc/{id}/status")).expect("Linux says");
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).expect("a peak");
    let kilobytes: f64 = peak.trim().trim_end_matches(" kB").parse().expect("a number");
    assert!(seconds < 10.0, "{seconds} s");
    assert!(kilobytes < 1.2e6, "{kilobytes} kB");
}

/// Data of an example, its header and the cells of one column changed.
fn changed(name: &str, rename: &[(&str, &str)], column: &str, change: fn(f64) -> f64) -> TempDir {
    let bench = example(name);
    let path = bench.path().join("data.csv");
    let text = std::fs::read_to_string(&path).expect("a table");
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let at = header.iter().position(|name| *name == column);
    let new = header
        .iter()
        .map(|name| rename.iter().find(|(old, _)| old == name).map_or(*name, |(_, new)| new));
    let mut out = new.collect::<Vec<_>>().join(",")
        + if rename.is_empty() { "" } else { ",air_temperature_c" };
    for (row, line) in lines.enumerate() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if let Some(at) = at {
            // A cell may be empty.
            cells[at] =
                cells[at].parse::<f64>().map_or(String::new(), |value| change(value).to_string());
        }
        if !rename.is_empty() {
            // The air of a shop, slow and steady.
            cells.push(
                (20.0 + 0.3 * libm::sin(f64::from(u32::try_from(row).expect("few rows")) / 90.0))
                    .to_string(),
            );
        }
        out.extend(["\n", &cells.join(",")]);
    }
    put(&path, &(out + "\n"));
    bench
}

/// Mistakes made in data of the examples: each is asked about before any verdict, and its one button leads to data
/// that are not doubted, and to the effects that are there without it.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn one_click_mends_a_mistake() {
    let celsius = [("air_temperature_c", "workpiece_temperature_c")];
    let gear = |of: fn(f64) -> f64| ("hidden-gear", changed("hidden-gear", &[], "error_um", of));
    let day = |renamed: &[(&str, &str)], column: &str, of: fn(f64) -> f64| {
        ("thermal-day", changed("thermal-day", renamed, column, of))
    };
    let mut mistakes =
        vec![("sign", gear(|value| -value)), ("swap", day(&celsius, "", |value| value))];
    if all() {
        mistakes.push(("unit", day(&[], "air_temperature_c", |value| 1.8 * value + 32.0)));
        mistakes.push(("unit", gear(|value| 1000.0 * value)));
    }
    let truth = |name: &str| match name {
        "hidden-gear" => vec!["gear-error"],
        _ => vec!["air-temperature", "air-pressure"],
    };
    for (what, (name, bench)) in mistakes {
        let before = std::fs::read(bench.path().join("data.csv")).unwrap();
        story("mends", &Server::over(bench.path()), &[what]);
        assert_eq!(std::fs::read(bench.path().join("data.csv")).unwrap(), before, "{what}");
        let mended = ["machine.toml", "data-2.csv"].map(|file| word(&bench, file).1);
        let found = json(&helixlock(&["compare", &mended[0], &mended[1], "--json"]).stdout);
        assert_eq!(found["doubts"], json("[]"), "{what}");
        assert_eq!(effects_in(&bench, "data-2.csv"), truth(name), "{what}");
    }
}

/// Names of the effects that a diagnosis of data finds.
fn effects_in(bench: &TempDir, data: &str) -> Vec<String> {
    let words = ["machine.toml", data].map(|file| word(bench, file).1);
    let found = json(&helixlock(&["diagnose", &words[0], &words[1], "--json"]).stdout);
    let effects = found["effects"].as_array().expect("effects").clone();
    effects.iter().map(|one| one["effect"].as_str().expect("a name").to_owned()).collect()
}

#[test]
fn no_other_page_and_no_other_name_gets_in() {
    let bench = example("hidden-gear");
    let server = Server::over(bench.path());
    let machine = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    let body = serde_json::json!({ "text": machine.replace("6 rpm", "7 rpm") }).to_string();
    let revision = server.revision();
    let path = server.path(&format!("api/machine?machine=machine.toml&revision={revision}"));
    let host = format!("Host: {}\r\n", server.host());
    let status =
        |path: &str, head: &str| server.send("POST", path, head, &body).expect("an answer").0;
    assert_eq!(status(&path, &format!("{host}Origin: http://elsewhere.example\r\n")), 403);
    assert_eq!(status(&path, &format!("{host}Sec-Fetch-Site: cross-site\r\n")), 403);
    assert_eq!(status(&path, "Host: rebound.example\r\n"), 403);
    assert_eq!(status(&path.replacen('/', "/0", 1), &host), 403);
    for name in ["../machine.toml", "/etc/passwd", "%2e%2e/x.toml", ".hidden.toml"] {
        let path = server.path(&format!("api/machine?machine={name}&revision="));
        assert_eq!(status(&path, &host), 400, "{name}");
    }
    let now = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    assert_eq!(now, machine, "nothing of that was written");
    assert_eq!(status(&path, &format!("{host}Origin: http://{}\r\n", server.host())), 200);
}

#[test]
fn the_second_of_two_tabs_is_told_and_loses_nothing() {
    let bench = example("hidden-gear");
    let server = Server::over(bench.path());
    let machine = std::fs::read_to_string(bench.path().join("machine.toml")).unwrap();
    let revision = server.revision();
    let [first, second] = ["7 rpm", "8 rpm"].map(|speed| machine.replace("6 rpm", speed));
    assert_eq!(server.save(&revision, &first), Some(200));
    assert_eq!(server.save(&revision, &second), Some(409), "it was shown another state");
    assert_eq!(std::fs::read_to_string(bench.path().join("machine.toml")).unwrap(), first);
    assert_eq!(server.save(&server.revision(), &second), Some(200));
}

/// On a telephone, in the dark and in Chinese as on a desk in the light: sizes, widths, contrast,
/// and what axe-core finds.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn every_screen_can_be_read() {
    let bench = with_data("6");
    let server = Server::over(bench.path());
    let looks = ["desk light en-US", "phone dark zh-CN", "desk dark zh-CN", "phone light en-US"];
    for look in &looks[..if all() { 4 } else { 2 }] {
        story("reads", &server, &look.split(' ').collect::<Vec<_>>());
    }
}

/// Every kind of file that `import` reads: its questions, notes and reasons.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_reading_is_told_in_chinese() {
    let samples = std::fs::read_dir(repository().join("import/tests/samples")).expect("a folder");
    let paths = samples.map(|entry| entry.expect("a file").path());
    let files: Vec<String> = paths
        .filter(|path| path.extension().is_none_or(|ending| ending != "md"))
        .map(|path| path.display().to_string())
        .collect();
    let bench = scratch();
    let words: Vec<&str> = files.iter().map(String::as_str).collect();
    story("drops", &Server::over(bench.path()), &words);
}

/// From a challenge to a machine file without noise left, and no mouse.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn the_keyboard_is_enough() {
    let bench = with_data("6");
    story("types", &Server::over(bench.path()), &[]);
    let ledger = std::fs::read_to_string(bench.path().join("ledger.json")).unwrap();
    assert_eq!(json(&ledger)["verdict"], "explained");
}

/// Challenges up to 50: a name at every peak that has one, and nowhere else.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn names_in_a_spectrum_stand_at_peaks_and_apart() {
    let bench = scratch();
    for seed in (1..=50).step_by(if all() { 1 } else { 7 }) {
        let (_, elsewhere) = challenge(&seed.to_string());
        for (from, to) in [("machine.toml", "toml"), ("data.csv", "csv")] {
            let text = std::fs::read_to_string(elsewhere.path().join(from)).unwrap();
            put(&bench.path().join(format!("{seed}.{to}")), &text);
        }
    }
    story("labels", &Server::over(bench.path()), &[]);
}

/// Every look and every challenge instead of some, and for new pictures.
fn all() -> bool {
    ["HELIXLOCK_WORKBENCH", "UPDATE_PICTURES"].iter().any(|name| std::env::var_os(name).is_some())
}
