//! The logic analyser captures what the signals were at the ticks of SUMP, and tells it backwards.

use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

const RUN: u8 = 1;
const IDENTIFY: u8 = 2;
const METADATA: u8 = 4;

/// An analyser with its memory, at a clock of so many MHz, whose transmitter is ready now and then.
struct Analyser {
    bench: Bench,
    mhz: u64,
    memory: Vec<u64>,
    /// The signals at every clock.
    seen: Vec<u8>,
    told: Vec<u8>,
    /// Clocks at which a sample was taken.
    taken: Vec<usize>,
}

impl Analyser {
    fn new(mhz: u64) -> Self {
        let mut bench = Bench::new("logic_analyser");
        bench.set(&[("rate", 1_000_000 * mhz), ("megahertz", mhz)]);
        bench.set(&[("ticks", 100 / mhz), ("ticks_rest", 100 % mhz)]);
        let memory = vec![0; helixlock_rtl::logic_analyser::SAMPLES];
        Self { bench, mhz, memory, seen: vec![], told: vec![], taken: vec![] }
    }

    fn clock(&mut self, byte: Option<u8>) {
        let clock = self.seen.len();
        // A pattern that repeats after 256·7 clocks only.
        let probes = u8::try_from(clock / 7 * 37 % 256).expect("a byte");
        self.seen.push(probes);
        self.bench
            .set(&[("probes", probes.into()), ("ready", u64::from(clock.is_multiple_of(20)))]);
        self.bench.set(&[("received", byte.is_some().into())]);
        self.bench.set(&[("received_byte", byte.unwrap_or(0x55).into())]);
        if self.bench.high("send") {
            self.told.push(u8::try_from(self.bench.get("data")).expect("a byte"));
        }
        let place = usize::try_from(self.bench.get("memory_address")).expect("a place");
        let word = self.memory[place];
        if self.bench.high("memory_write") {
            self.taken.push(clock);
            self.memory[place] = self.bench.get("memory_sample");
        }
        self.bench.clock();
        self.bench.set(&[("memory_data", word)]);
    }

    fn hear(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.clock(Some(*byte));
            (0..3).for_each(|_| self.clock(None));
        }
    }

    fn set(&mut self, command: u8, value: u32) {
        self.hear(&[&[command], &value.to_le_bytes()[..]].concat());
    }

    /// What is told in answer to a command of one byte, within so many clocks.
    fn ask(&mut self, command: u8, clocks: u32) -> Vec<u8> {
        self.told.clear();
        self.taken.clear();
        self.hear(&[command]);
        (0..clocks).for_each(|_| self.clock(None));
        std::mem::take(&mut self.told)
    }

    /// The samples that a run tells, so many.
    fn capture(&mut self, count: usize) -> Vec<u8> {
        let mut told = self.ask(RUN, 100);
        for _ in 0..60_000 {
            if told.len() + self.told.len() >= count {
                break;
            }
            self.clock(None);
        }
        (0..100).for_each(|_| self.clock(None));
        told.append(&mut self.told);
        told
    }

    /// The signals at the clocks in which samples were taken, two clocks late, the last one first.
    fn backwards(&self, count: usize) -> Vec<u8> {
        self.taken.iter().rev().take(count).map(|clock| self.seen[clock - 2]).collect()
    }
}

#[test]
fn it_says_what_it_is() {
    let mut analyser = Analyser::new(12);
    assert_eq!(analyser.ask(IDENTIFY, 200), b"1ALS");
    let metadata = b"\x01helixlock\0\x21\0\0\x10\0\x23\x00\xb7\x1b\x00\x40\x08\x41\x02\0";
    assert_eq!(analyser.ask(METADATA, 2000), metadata);
    // Flow control, a command of nobody, and flags: nothing.
    analyser.hear(&[0x11, 0x13, 0x7f]);
    analyser.set(0x82, 0x0204);
    assert_eq!(analyser.ask(0x05, 1000), [0_u8; 0]);
}

/// Just powered up: every clock a sample, the first is the trigger, and four are told.
#[test]
fn a_run_of_nothing_set_tells_four_samples() {
    // With one tick a clock, so that a divider of 1 would show.
    let mut analyser = Analyser::new(100);
    let told = analyser.ask(RUN, 400);
    assert_eq!(analyser.taken.len(), 5);
    assert!(analyser.taken.windows(2).all(|pair| pair[1] == pair[0] + 1));
    assert_eq!(told, analyser.backwards(4));
    analyser.set(0xc0, 1);
    let told = analyser.ask(RUN, 4000);
    assert_eq!(told.len(), 4, "a value that was never set is zero");
    assert_eq!(analyser.seen[analyser.taken[analyser.taken.len() - 5] - 2] & 1, 0);
}

#[test]
fn a_reset_ends_a_run_and_an_answer() {
    let mut analyser = Analyser::new(12);
    analyser.set(0xc0, 0xff);
    analyser.set(0xc1, 0x01);
    analyser.ask(RUN, 3);
    assert_eq!(analyser.ask(0, 4000), [0_u8; 0]);
    analyser.hear(&[METADATA]);
    assert_eq!(analyser.ask(0, 4000), [0_u8; 0]);
    assert_eq!(analyser.ask(IDENTIFY, 200), b"1ALS");
}

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Whatever the clock of the board, the divider and the counts: samples are those of their ticks,
    /// and the trigger is where a reader looks for it.
    #[test]
    fn samples_are_those_of_their_ticks(
        mhz in prop::sample::select(vec![12_u64, 16, 25, 27, 48]),
        divider in 0_u32..300,
        counts in (0_u32..12, 0_u32..12),
        value in any::<u8>(),
    ) {
        let (after, total) = (counts.0.min(counts.1), counts.0.max(counts.1));
        let mut analyser = Analyser::new(mhz);
        analyser.set(0x80, divider);
        analyser.set(0x81, total | after << 16);
        // Three neighbours in the pattern have these four bits, whatever they are.
        analyser.set(0xc0, 0x0f);
        analyser.set(0xc1, value.into());
        let wanted = usize::try_from(4 * (total + 1)).expect("few");
        let told = analyser.capture(wanted);
        prop_assert_eq!(told.len(), wanted);
        prop_assert_eq!(told, analyser.backwards(wanted));

        // A tick is 10 ns, and a sample's lies in its clock; a clock gives one at most.
        let first = analyser.taken[0];
        let period = u64::from(divider + 1);
        for (number, clock) in (0..).zip(&analyser.taken) {
            let since = u64::try_from(clock - first).expect("later");
            if period * analyser.mhz <= 100 {
                prop_assert_eq!(since, number);
            } else {
                let [begin, end] = [since, since + 1].map(|clock| clock * 100 / analyser.mhz);
                let tick = number * period;
                prop_assert!(begin <= tick && tick < end, "{begin} {tick} {end}");
            }
        }

        // The trigger is the last sample that is not behind it, and none before it may be.
        let behind = usize::try_from(4 * (after + 1)).expect("few");
        let ahead = usize::try_from(4 * (total - after)).expect("few");
        let levels: Vec<u8> = analyser.taken.iter().map(|clock| analyser.seen[clock - 2]).collect();
        let trigger = levels.len() - behind - 1;
        prop_assert_eq!(levels[trigger] & 0x0f, value & 0x0f);
        prop_assert!(levels[ahead..trigger].iter().all(|level| level & 0x0f != value & 0x0f));
        prop_assert!(ahead <= trigger);
    }
}
