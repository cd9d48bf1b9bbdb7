//! Dumps mean the same to us and to independent readers, in both directions.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use helixlock_traces::vcd::{Bit, Value};
use helixlock_traces::{Dump, FstWriter, Tick, Variable, VcdReader, VcdWriter, read_capture};
use proptest::collection::vec;
use proptest::prelude::*;

/// What a dump says: of each signal the unit of time, and every instant at which it took a value
/// other than before.
type Contents = BTreeMap<String, Vec<(u64, String)>>;

/// Keeps of each instant the last value, and of these what differs from the one before.
fn changes_only(values: impl Iterator<Item = (u64, String)>) -> Vec<(u64, String)> {
    let mut kept: Vec<(u64, String)> = Vec::new();
    for (ticks, value) in values {
        if kept.last().is_some_and(|(last, _)| *last == ticks) {
            kept.pop();
        }
        if kept.last().is_none_or(|(_, last)| *last != value) {
            kept.push((ticks, value));
        }
    }
    kept
}

/// By our reader.
fn ours(path: &Path) -> Contents {
    let file = std::fs::File::open(path).expect("the dump is there");
    let mut reader = VcdReader::new(std::io::BufReader::new(file), path).expect("the header reads");
    let signals = reader.signals().to_vec();
    let changes: Vec<_> = reader.by_ref().map(|change| change.expect("the body reads")).collect();
    let of_channel = |channel: usize, width: u32| {
        let of_it = changes.iter().filter(move |change| change.channel == channel);
        changes_only(of_it.map(move |change| (change.ticks, text(&change.value, width))))
    };
    let contents = signals
        .iter()
        .map(|signal| (signal.path.clone(), of_channel(signal.channel, signal.width)));
    contents.collect()
}

/// All bits of a value, the most significant first; a real number by its digits.
fn text(value: &Value, width: u32) -> String {
    match value {
        Value::Bit(bit) => bit.to_string(),
        Value::Real(number) => format!("{number:e}"),
        Value::Text(text) => text.clone(),
        Value::Vector(bits) => {
            let first = bits.first().copied().unwrap_or(Bit::V0);
            let filling = if first == Bit::V1 { Bit::V0 } else { first };
            let missing = (width as usize).saturating_sub(bits.len());
            std::iter::repeat_n(&filling, missing).chain(bits).map(Bit::to_string).collect()
        }
    }
}

/// By the wellen crate, which the Surfer viewer uses.
fn wellens(path: &Path) -> Contents {
    let mut wave = wellen::simple::read(path).expect("wellen reads it");
    let variables: Vec<_> = wave
        .hierarchy()
        .all_vars()
        .map(|variable| {
            let variable = &wave.hierarchy()[variable];
            let index = variable.index().filter(|index| index.msb() == index.lsb());
            let index = index.map(|index| format!("[{}]", index.msb())).unwrap_or_default();
            (variable.full_name(wave.hierarchy()) + &index, variable.signal_ref())
        })
        .collect();
    wave.load_signals(&variables.iter().map(|(_, signal)| *signal).collect::<Vec<_>>());
    let times = wave.time_table();
    let contents = variables.into_iter().map(|(name, signal)| {
        let signal = wave.get_signal(signal).expect("it was loaded");
        let values = signal.iter_changes().map(|(index, value)| {
            let text = match value {
                wellen::SignalValueRef::Real(number) => format!("{number:e}"),
                wellen::SignalValueRef::String(text) => text.to_owned(),
                bits => bits.to_bit_string().expect("it is bits"),
            };
            (times[index as usize], text)
        });
        (name, changes_only(values))
    });
    contents.collect()
}

/// Runs a tool and returns what it printed; it has to be there and succeed.
fn run(tool: &str, package: &str, words: &[&str]) -> Vec<u8> {
    let output = Command::new(tool).args(words).output();
    let output = output.unwrap_or_else(|_| panic!("`{tool}` starts (Debian package `{package}`)"));
    assert!(
        output.status.success(),
        "{tool} {words:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    output.stdout
}

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/vcd").join(name)
}

/// A short record with a pulse, a counter and micrometres.
#[derive(Clone, Debug)]
struct Event {
    after_ticks: u64,
    variable: usize,
    bits: u64,
    number: f64,
}

const WIDTHS: [Option<u32>; 5] = [Some(1), Some(12), Some(64), None, Some(1)];

fn events() -> impl Strategy<Value = Vec<Event>> {
    let numbers =
        prop_oneof![Just(0.0), -1e3..1e3, any::<f64>().prop_filter("finite", |x| x.is_finite())];
    let event = (0..3_u64, 0..WIDTHS.len(), any::<u64>(), numbers).prop_map(
        |(after_ticks, variable, bits, number)| Event { after_ticks, variable, bits, number },
    );
    vec(event, 0..60)
}

fn written(events: &[Event]) -> Vec<u8> {
    let mut text = Vec::new();
    record(events, |variables| VcdWriter::new(&mut text, Tick::PICOSECOND, variables));
    text
}

/// The same packed, in many blocks.
fn packed(events: &[Event]) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    record(events, |variables| {
        FstWriter::new(&mut bytes, Tick::PICOSECOND, variables).map(|fst| fst.in_blocks_of(600))
    });
    bytes.into_inner()
}

fn record<D: Dump>(events: &[Event], make: impl FnOnce(&[Variable]) -> std::io::Result<D>) {
    let names = [
        "device.laser",
        "device.counter.count",
        "device.wide",
        "plant.error_um",
        "device.counter.zero",
    ];
    let variables: Vec<_> = names
        .iter()
        .zip(WIDTHS)
        .map(|(name, width)| {
            width.map_or(Variable::real(*name), |width| Variable::bits(*name, width))
        })
        .collect();
    let mut dump = make(&variables).expect("memory takes it");
    for (variable, width) in WIDTHS.iter().enumerate() {
        set(&mut dump, variable, *width, 0, 0.0);
    }
    let mut ticks = 0;
    for event in events {
        ticks += event.after_ticks * 41_667;
        dump.at(ticks).expect("time goes on");
        set(&mut dump, event.variable, WIDTHS[event.variable], event.bits, event.number);
    }
    dump.finish(ticks + 1).expect("memory takes it");
}

fn set(dump: &mut impl Dump, variable: usize, width: Option<u32>, bits: u64, number: f64) {
    let done = match width {
        Some(_) => dump.bits(variable, bits),
        None => dump.real(variable, number),
    };
    done.expect("memory takes it");
}

fn kept(bytes: &[u8]) -> tempfile::NamedTempFile {
    kept_as(".vcd", bytes)
}

fn kept_as(suffix: &str, bytes: &[u8]) -> tempfile::NamedTempFile {
    let mut file = tempfile::Builder::new().suffix(suffix).tempfile().expect("a file can be made");
    std::io::Write::write_all(&mut file, bytes).expect("the file can be written");
    file
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(64) })]

    /// Whatever is recorded, wellen finds what we find, and we find what was recorded.
    #[test]
    fn our_dumps_read_alike_in_wellen(events in events()) {
        let file = kept(&written(&events));
        let contents = ours(file.path());
        prop_assert_eq!(&contents, &wellens(file.path()));
        let numbers = &contents["plant.error_um"];
        let last = events.iter().rev().find(|event| event.variable == 3).map_or(0.0, |event| event.number);
        prop_assert_eq!(&numbers.last().expect("a first value").1, &format!("{last:e}"));
    }

    /// Packed or not, a waveform is the same.
    #[test]
    fn our_packed_waveforms_are_our_dumps(events in events()) {
        let [plain, fst] = [kept(&written(&events)), kept_as(".fst", &packed(&events))];
        prop_assert_eq!(ours(plain.path()), wellens(fst.path()));
    }
}

#[test]
fn dumps_of_other_producers_read_alike_in_wellen() {
    for name in [
        "icarus/counter.vcd",
        "verilator/counter.vcd",
        "gtkwave/counter.vcd",
        "sigrok/grbl_cnc_2_excerpt.vcd",
    ] {
        let contents = ours(&case(name));
        assert!(contents.values().any(|changes| changes.len() > 20), "{name}");
        assert_eq!(contents, wellens(&case(name)), "{name}");
    }
}

/// One design, two simulators: from the clear on, they agree on every signal.
#[test]
fn icarus_and_verilator_agree_once_the_counter_is_cleared() {
    let cleared_ticks = 1_300;
    let later = |name: &str, path: &str| {
        let changes = ours(&case(name)).remove(path).expect(path);
        changes.into_iter().filter(|(ticks, _)| cleared_ticks < *ticks).collect::<Vec<_>>()
    };
    for signal in ["clock", "count", "zero", "error_um", "dut.count"] {
        let icarus = later("icarus/counter.vcd", &format!("bench.{signal}"));
        let verilator = later("verilator/counter.vcd", &format!("TOP.bench.{signal}"));
        assert_eq!(icarus, verilator, "{signal}");
    }
}

/// A record of every variable, its numbers exact in the sixteen digits that `fst2vcd` prints.
fn a_record() -> Vec<Event> {
    (0..200)
        .map(|i: u64| Event {
            after_ticks: i % 3,
            variable: usize::try_from(i % 5).expect("small"),
            bits: i.wrapping_mul(0x9e37_79b9_7f4a_7c15),
            number: f64::from(u32::try_from(i).expect("small")) / -64.0,
        })
        .collect()
}

#[test]
fn our_packed_waveforms_unpack_by_gtkwaves_own_tool() {
    let fst = kept_as(".fst", &packed(&a_record()));
    let path = fst.path().to_str().expect("a plain name");
    let unpacked = kept(&run("fst2vcd", "gtkwave", &[path]));
    assert_eq!(ours(kept(&written(&a_record())).path()), ours(unpacked.path()));
}

#[test]
fn our_dumps_survive_gtkwaves_own_tools() {
    let file = kept(&written(&a_record()));
    let folder = tempfile::tempdir().expect("a folder can be made");
    let fst = folder.path().join("wave.fst");
    let words = [file.path(), &fst].map(|path| path.to_str().expect("a plain name"));
    run("vcd2fst", "gtkwave", &words);
    let back = kept(&run("fst2vcd", "gtkwave", &words[1..]));
    assert_eq!(ours(file.path()), ours(back.path()));
}

/// What sigrok makes of a file, as a dump.
fn by_sigrok(words: &[&str]) -> tempfile::NamedTempFile {
    let dump = kept(b"");
    let path = dump.path().to_str().expect("a plain name");
    run("sigrok-cli", "sigrok-cli", &[words, &["-O", "vcd", "-o", path]].concat());
    dump
}

/// The G-code of the capture: 200 mm out and back on both axes, 80 steps per millimetre.
#[test]
fn real_captures_give_the_exact_number_of_steps() {
    let file = case("sigrok/smoothieware.sr");
    let dump = by_sigrok(&["-i", file.to_str().expect("a plain name")]);
    let capture = read_capture(dump.path()).expect("sigrok's dump reads");
    for (axis, step, direction) in [("X", "5", "6"), ("Y", "3", "4")] {
        let steps = &capture.signal(step).expect(axis).rising_ticks;
        let direction = capture.signal(direction).expect(axis);
        let out = steps.iter().filter(|ticks| direction.high_at(**ticks) == Some(false)).count();
        assert_eq!((out, steps.len()), (16_000, 32_000), "{axis}");
    }
}

/// 20 946 is the number of rises that a script of a few lines counts in sigrok's own text.
#[test]
fn a_capture_with_names_of_several_words_reads() {
    let file = case("sigrok/grbl_cnc_2.sr");
    let dump = by_sigrok(&["-i", file.to_str().expect("a plain name")]);
    let capture = read_capture(dump.path()).expect("sigrok's dump reads");
    assert_eq!(capture.signal("STEP (Y axis)").expect("it is there").rising_ticks.len(), 20_946);
}

#[test]
fn sigrok_reads_a_capture_that_we_wrote() {
    let written = kept(&two_pulse_trains());
    let path = written.path().to_str().expect("a plain name");
    let dump = by_sigrok(&["-I", "vcd", "-i", path]);
    let [ours, sigroks] =
        [&written, &dump].map(|file| read_capture(file.path()).expect("it reads"));
    for name in ["grating", "laser"] {
        let theirs = sigroks.signals.iter().find(|signal| signal.path.ends_with(name)).expect(name);
        assert_eq!(ours.rising_s(name).expect(name), sigroks.rising_s(&theirs.path).expect(name));
        assert_eq!(ours.signal(name).expect(name).falling_ticks.len(), theirs.falling_ticks.len());
    }
}

fn two_pulse_trains() -> Vec<u8> {
    let variables = [Variable::bits("pulses.grating", 1), Variable::bits("pulses.laser", 1)];
    let mut text = Vec::new();
    let mut dump =
        VcdWriter::new(&mut text, Tick::NANOSECOND, &variables).expect("memory takes it");
    for half_period in 0..=400 {
        if half_period > 0 {
            dump.at(half_period * 1_000).expect("time goes on");
        }
        set(&mut dump, 0, Some(1), half_period % 2, 0.0);
        set(&mut dump, 1, Some(1), half_period / 3 % 2, 0.0);
    }
    dump.finish(401_000).expect("memory takes it");
    text
}
