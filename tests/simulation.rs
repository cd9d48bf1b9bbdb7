//! `helixlock sim` as a user meets it: files, windows, words that are wrong.

use std::collections::BTreeMap;
use std::fs;
use std::io::Read;
use std::path::Path;

use helixlock_sim::device;
use serde_json::Value;
use vcd::{Command, Parser, ScopeItem};

use crate::support::command::{Run, helixlock, put, scratch, word};

const MACHINE: &str = "examples/sg7430-6mm/machine.toml";

fn sim(out: &str, words: &[&str]) -> Run {
    helixlock(&[&["sim", MACHINE, "-o", out, "--length", "2"], words].concat())
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    entries
        .map(|e| {
            (
                e.file_name().into_string().expect("a plain name"),
                fs::read(e.path()).expect("a file"),
            )
        })
        .collect()
}

#[test]
fn the_same_machine_gives_the_same_bytes() {
    let folder = scratch();
    let [first, second] = ["first", "second"].map(|name| {
        let (path, path_word) = word(&folder, name);
        assert_eq!(sim(&path_word, &[]).status, 0);
        files(&path)
    });
    let names: Vec<_> = first.keys().map(String::as_str).collect();
    assert_eq!(names, ["report.html", "summary.json", "trace.csv", "wave.gtkw", "wave.vcd"]);
    for (name, bytes) in &first {
        assert!(bytes == &second[name], "{name} differs");
    }
}

#[test]
fn the_page_needs_no_network() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    assert_eq!(sim(&out_word, &[]).status, 0);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    // The name of the format, and a reference within the page.
    let page = page.replace("http://www.w3.org/2000/svg", "").replace("url(#", "");
    for outside in ["http:", "https:", "<script", "@import", "url("] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert_eq!(page.matches("<svg").count(), 5);
}

/// Paths of all variables in a dump, read by the `vcd` crate.
fn variables(items: &[ScopeItem], above: &str, found: &mut Vec<String>) {
    for item in items {
        match item {
            ScopeItem::Var(var) => found.push(format!("{above}{}", var.reference)),
            ScopeItem::Scope(scope) => {
                variables(&scope.items, &format!("{above}{}.", scope.identifier), found);
            }
            _ => {}
        }
    }
}

#[test]
fn every_signal_of_the_device_is_in_the_dump() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    let run = sim(&out_word, &["--scope", "all", "--from", "0.5", "--to", "0.5005"]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    let bytes = fs::read(out.join("wave.vcd")).unwrap();
    let mut dump = Parser::new(&bytes[..]);
    let header = dump.parse_header().unwrap();
    let mut found = Vec::new();
    variables(&header.items, "", &mut found);
    for signal in &device().netlist().signals {
        let path = format!("device.{}", signal.path);
        assert!(found.contains(&path), "{path}");
    }
    for path in ["machine.recorder_error_um", "machine.lead_error_um", "machine.correction_um"] {
        assert!(found.iter().any(|known| known == path), "{path}");
    }
    // 500 µs in picoseconds, of which the step clock alone fills 6000 clocks.
    let times: Vec<u64> = dump
        .map(Result::unwrap)
        .filter_map(|command| match command {
            Command::Timestamp(time) => Some(time),
            _ => None,
        })
        .collect();
    assert_eq!((times.first(), times.last()), (Some(&500_000_000_000), Some(&500_500_000_000)));
    assert!((6_000..6_003).contains(&times.len()), "{}", times.len());
}

/// A millisecond of everything, in every form.
#[test]
fn a_compressed_waveform_is_the_same() {
    let folder = scratch();
    let [plain, compressed, packed] = ["vcd", "vcd.gz", "fst"].map(|form| {
        let (out, out_word) = word(&folder, form);
        let words = ["--scope", "all", "--from", "0.5", "--to", "0.501", "--wave", form];
        assert_eq!(sim(&out_word, &words).status, 0, "{form}");
        let view = fs::read_to_string(out.join("wave.gtkw")).unwrap();
        assert!(view.starts_with(&format!("[dumpfile] \"wave.{form}\"\n")), "{view}");
        out.join(format!("wave.{form}"))
    });
    let plain_bytes = fs::read(&plain).unwrap();
    let mut unpacked = Vec::new();
    flate2::read::GzDecoder::new(fs::File::open(&compressed).unwrap())
        .read_to_end(&mut unpacked)
        .unwrap();
    assert!(unpacked == plain_bytes, "gzip gives back what was put in");
    let [plain_wave, packed_wave] = [&plain, &packed].map(|path| {
        let wave = wellen::simple::read(path).expect("wellen reads it");
        (wave.hierarchy().all_vars().count(), wave.time_table().to_vec())
    });
    assert_eq!(plain_wave.0, packed_wave.0, "variables");
    assert!(plain_wave.1.iter().all(|time| packed_wave.1.contains(time)), "instants");
    let sizes = [&compressed, &packed].map(|path| fs::metadata(path).unwrap().len());
    let most = plain_bytes.len() as u64 / 2;
    assert!(sizes.iter().all(|size| *size < most), "{sizes:?} of {}", plain_bytes.len());
}

/// The waveform is on its way when the effect stops being finite; nothing of it stays, not even the
/// folder.
#[test]
fn a_run_that_fails_late_leaves_nothing() {
    let folder = scratch();
    let text = fs::read_to_string(MACHINE).unwrap();
    let (machine, machine_word) = word(&folder, "machine.toml");
    put(
        &machine,
        &format!("{text}\n[[effect]]\nkind = 'custom'\nformula = 'sqrt(1.5-position_mm)'\n"),
    );
    let (out, out_word) = word(&folder, "out");
    let run = helixlock(&["sim", &machine_word, "-o", &out_word, "--length", "2"]);
    assert_eq!(run.status, 2, "{}", run.stdout);
    assert!(!out.exists(), "{}", run.stderr);
}

#[test]
fn an_error_beyond_the_range_is_drawn_on_and_said_so() {
    let folder = scratch();
    let text = fs::read_to_string(MACHINE).unwrap();
    let text = text.replace("range = 2 ", "range = 1 ");
    let text = text.replace("initial_phase = 150", "initial_phase = 75");
    let text = text.replace("linear = \"50 um/m\"", "linear = \"500 um/m\"");
    let (machine, machine_word) = word(&folder, "machine.toml");
    put(&machine, &text);
    let (out, out_word) = word(&folder, "out");
    let run = helixlock(&["sim", &machine_word, "-o", &out_word, "--length", "100"]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("note: without correction the error leaves the range of ±23.7 um"));
    let text = fs::read_to_string(out.join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(summary["without_correction"]["recorder_jumps"], 1);
    let recorder_um = summary["without_correction"]["recorder_peak_to_peak_um"].as_f64().unwrap();
    assert!((49.0..53.0).contains(&recorder_um), "{recorder_um}");
}

#[test]
fn wrong_words_are_refused_and_leave_nothing() {
    let cases: [(&[&str], &str); 5] = [
        (&["--scope", "no_such_block"], "scope `no_such_block` is not in the design, expected"),
        (&["--from", "2", "--to", "1"], "window from 2 s to 1 s: expected a part of 0 s to 1666.6"),
        (&["--from", "2000"], "window from 2000 s to"),
        (&["--length", "-1"], "--length"),
        (&["--from", "soon"], "invalid value 'soon' for '--from"),
    ];
    for (words, expected) in cases {
        let folder = scratch();
        let (out, out_word) = word(&folder, "out");
        let run = helixlock(&[&["sim", MACHINE, "-o", &out_word], words].concat());
        assert_eq!(run.status, 2, "{words:?}");
        assert!(run.stderr.contains(expected), "{words:?}: {}", run.stderr);
        assert!(!out.exists(), "{words:?}");
    }
}

#[test]
fn a_file_in_the_way_of_the_folder_is_named() {
    let folder = scratch();
    let (out, out_word) = word(&folder, "out");
    put(&out, "in the way");
    let run = sim(&out_word, &[]);
    assert_eq!(run.status, 2);
    assert!(run.stderr.contains("the folder cannot be made"), "{}", run.stderr);
    assert_eq!(fs::read_to_string(&out).unwrap(), "in the way");
}

/// What the file says is well formed, and yet the device cannot do it.
#[test]
fn what_the_device_cannot_do_is_refused() {
    let cases = [
        (
            "clock = \"12 MHz\"",
            "clock = \"2 kHz\"",
            "laser: pulses at 0.",
            "too fast for a clock of",
        ),
        (
            "frequency = \"100 Hz\"",
            "frequency = \"9 MHz\"",
            "drive.frequency: 9000000 Hz",
            "6000000 Hz",
        ),
        ("frequency = \"100 Hz\"", "frequency = \"0.1 Hz\"", "drive.frequency: 0.1 Hz", "0.715 Hz"),
    ];
    for (good, bad, found, expected) in cases {
        let folder = scratch();
        let (machine, machine_word) = word(&folder, "machine.toml");
        let text = fs::read_to_string(MACHINE).unwrap();
        assert!(text.contains(good), "{good}");
        put(&machine, &text.replace(good, bad));
        let (out, out_word) = word(&folder, "out");
        let run = helixlock(&["sim", &machine_word, "-o", &out_word, "--length", "20"]);
        assert_eq!(run.status, 2, "{bad}: {}", run.stdout);
        assert!(run.stderr.contains("machine.toml: "), "{bad}: {}", run.stderr);
        assert!(run.stderr.contains(found) && run.stderr.contains(expected), "{}", run.stderr);
        assert!(!out.exists(), "{bad}");
    }
}

#[test]
fn a_counter_at_its_end_is_said_so() {
    let folder = scratch();
    let (machine, machine_word) = word(&folder, "machine.toml");
    let text = fs::read_to_string(MACHINE).unwrap();
    put(&machine, &text.replace("linear = \"50 um/m\"", "linear = \"400 um/m\""));
    let (_, out_word) = word(&folder, "out");
    let run = helixlock(&["sim", &machine_word, "-o", &out_word, "--length", "160"]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("net -4095"), "{}", run.stdout);
    assert!(run.stdout.contains("the step counter stood at 4095"), "{}", run.stdout);
    assert!(!run.stdout.contains("slew limit"), "{}", run.stdout);
}
