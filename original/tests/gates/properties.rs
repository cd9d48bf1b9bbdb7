//! What holds for any delays within the limits of the data sheets.

use bitvec::vec::BitVec;
use helixlock_original::figures::{Clear, decade, discriminator, divider, reset_counter, ring};
use helixlock_original::{Circuit, Delays, Simulator, Train};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::play;

/// The six legal drives, forward.
const SEQUENCE: [[bool; 3]; 6] = [
    [true, false, false],
    [true, true, false],
    [false, true, false],
    [false, true, true],
    [false, false, true],
    [true, false, true],
];

/// From pulse to pulse, ps.
const PERIOD_PS: u64 = 5_000_000;

fn settings() -> ProptestConfig {
    let persistence = proptest::test_runner::FileFailurePersistence::WithSource("regressions");
    ProptestConfig {
        cases: 48,
        failure_persistence: Some(Box::new(persistence)),
        ..Default::default()
    }
}

/// Instants at which a pin rises.
fn rises(simulator: &mut Simulator, circuit: &Circuit, pin: &str) -> Vec<u64> {
    let net = circuit.pin(pin).expect("a pin");
    let edges = simulator.take_edges().into_iter();
    edges.filter(|edge| edge.net == net && edge.level).map(|edge| edge.time_ps).collect()
}

proptest! {
    #![proptest_config(settings())]

    /// One pulse for every N, none more, none less, none early.
    #[test]
    fn divider_keeps_its_count(number in 1_u16..=999, seed: u64) {
        let circuit = divider::circuit(number, Clear::Delayed);
        let mut simulator = Simulator::new(&circuit, &Delays::drawn(&circuit, seed)).unwrap();
        let pulse = circuit.pin("pulse").unwrap();
        let mut train = Train::new();
        for count in 1..=u64::from(3 * number) {
            train.pulse(count * PERIOD_PS, pulse, PERIOD_PS / 2);
        }
        simulator.watch(&[circuit.pin("divided").unwrap()]);
        play(&mut simulator, &train.changes());
        let counted: Vec<_> = rises(&mut simulator, &circuit, "divided")
            .into_iter()
            .map(|time_ps| (time_ps - PERIOD_PS / 2) / PERIOD_PS)
            .collect();
        let expected: Vec<_> = (1..=3).map(|turn| turn * u64::from(number)).collect();
        prop_assert_eq!(counted, expected);
    }

    /// The decade counts in tens from any digit on; from what is no digit it gets back to them.
    #[test]
    fn decade_counts_from_any_state(state in 0_u8..16, pulses in 1_u64..40, seed: u64) {
        let circuit = decade::circuit();
        let mut bits: BitVec = BitVec::repeat(false, 4);
        // The order of the elements: a, b, c, d.
        for bit in 0..4 {
            bits.set(bit, state >> bit & 1 == 1);
        }
        let delays = Delays::drawn(&circuit, seed);
        let mut simulator = Simulator::woken(&circuit, &delays, &bits).unwrap();
        let pulse = circuit.pin("pulse").unwrap();
        let mut train = Train::new();
        for count in 1..=pulses {
            train.pulse(count * PERIOD_PS, pulse, PERIOD_PS / 2);
        }
        play(&mut simulator, &train.changes());
        let digit = (0_u64..4).map(|bit| {
            u64::from(simulator.level(circuit.pin(&format!("q{bit}")).unwrap())) << bit
        }).sum::<u64>();
        if state < 10 {
            prop_assert_eq!(digit, (u64::from(state) + pulses) % 10);
        } else if 6 < pulses {
            prop_assert!(digit < 10);
        }
    }

    /// Q is low after each comparison in which the laser led, high after each in which it lagged, and
    /// changes where it decides alone: at the laser's edge or at the middle, not where both begin.
    #[test]
    fn discriminator_decides_where_it_should(
        history in vec((any::<bool>(), 1_u64..20), 1..20), seed: u64,
    ) {
        let circuit = discriminator::circuit();
        let mut simulator = Simulator::new(&circuit, &Delays::drawn(&circuit, seed)).unwrap();
        let [start, middle, laser, q] =
            ["start", "middle", "laser", "q"].map(|pin| circuit.pin(pin).unwrap());
        for (number, (lags, by)) in (1..).zip(history) {
            let (begin_ps, middle_ps) = (number * 100_000_000, number * 100_000_000 + 50_000_000);
            let by_ps = by * 1_000_000;
            let laser_ps = if lags { middle_ps + by_ps } else { middle_ps - by_ps };
            let mut train = Train::new();
            for (time_ps, pin) in [(begin_ps, start), (middle_ps, middle), (laser_ps, laser)] {
                train.pulse(time_ps, pin, 500_000);
            }
            for (time_ps, pin, level) in train.changes() {
                simulator.drive(time_ps, pin, level).unwrap();
            }
            simulator.run_until(begin_ps + 99_999_999);
            prop_assert_eq!(simulator.level(q), lags);
            let decides_ps = middle_ps.min(laser_ps);
            for edge in simulator.take_edges().into_iter().filter(|edge| edge.net == q) {
                prop_assert!(decides_ps < edge.time_ps, "{} of {}", edge.time_ps, decides_ps);
            }
        }
    }

    /// From any state, legal or not, the drives are those of the net position.
    #[test]
    fn ring_from_any_state(
        state in 0_u8..8, history in vec(any::<bool>(), 0..60), seed: u64,
    ) {
        let circuit = ring::circuit();
        let bits: BitVec = (0..3).map(|bit| state >> bit & 1 == 1).collect();
        let delays = Delays::drawn(&circuit, seed);
        let mut simulator = Simulator::woken(&circuit, &delays, &bits).unwrap();
        let [step, forward] = ["step", "forward"].map(|pin| circuit.pin(pin).unwrap());
        let phases = ["phase_a", "phase_b", "phase_c"].map(|pin| circuit.pin(pin).unwrap());
        let woken = [0, 1, 2].map(|bit| bits[bit]);
        let legal = SEQUENCE.iter().position(|drives| *drives == woken);
        let mut position = legal.unwrap_or(0);
        for (count, ahead) in (1..).zip(history) {
            simulator.drive(count * PERIOD_PS, forward, ahead).unwrap();
            simulator.drive(count * PERIOD_PS + PERIOD_PS / 4, step, true).unwrap();
            simulator.drive(count * PERIOD_PS + PERIOD_PS / 2, step, false).unwrap();
            simulator.run_until((count + 1) * PERIOD_PS - 1);
            position += if ahead { 1 } else { 5 };
            let drives = phases.map(|phase| simulator.level(phase));
            prop_assert_eq!(drives, SEQUENCE[position % 6], "from {:?}", woken);
        }
    }

    /// The counter is the net steps, its side that of the first step from zero; it plays back.
    #[test]
    fn counter_keeps_the_net_steps(history in vec((any::<bool>(), 1_u64..40), 1..12), seed: u64) {
        let circuit = reset_counter::circuit();
        let mut simulator = Simulator::new(&circuit, &Delays::drawn(&circuit, seed)).unwrap();
        let mut bench = Counting { circuit: &circuit, at_ps: PERIOD_PS };
        let mut net = 0_i64;
        for (forward, steps) in history {
            for _ in 0..steps {
                net += if forward { 1 } else { -1 };
                prop_assert_eq!(bench.step(&mut simulator, forward, false), net);
            }
        }
        for _ in 0..net.unsigned_abs() {
            net -= net.signum();
            prop_assert_eq!(bench.step(&mut simulator, true, true), net);
        }
        prop_assert_eq!(bench.step(&mut simulator, true, true), 0, "the zero line blocks");
    }
}

struct Counting<'a> {
    circuit: &'a Circuit,
    at_ps: u64,
}

impl Counting<'_> {
    /// A step, and the net count after it.
    fn step(&mut self, simulator: &mut Simulator, forward: bool, playback: bool) -> i64 {
        let pin = |name: &str| self.circuit.pin(name).expect("a pin");
        let quarter_ps = PERIOD_PS / 4;
        let changes = [
            (self.at_ps, pin("forward"), forward),
            (self.at_ps, pin("playback"), playback),
            (self.at_ps + quarter_ps, pin("request"), true),
            (self.at_ps + 2 * quarter_ps, pin("request"), false),
        ];
        for (time_ps, pin, level) in changes {
            simulator.drive(time_ps, pin, level).expect("in order");
        }
        self.at_ps += PERIOD_PS;
        simulator.run_until(self.at_ps - 1);
        let bits = 0..reset_counter::STAGES;
        let count: i64 =
            bits.map(|bit| i64::from(simulator.level(pin(&format!("count{bit}")))) << bit).sum();
        if simulator.level(pin("count_forward")) { count } else { -count }
    }
}

/// Beyond 4095 the original wraps, which the synchronous block does not.
#[test]
fn counter_wraps() {
    let circuit = reset_counter::circuit();
    let delays = Delays::corner(&circuit, helixlock_original::Corner::Typical);
    let mut simulator = Simulator::new(&circuit, &delays).unwrap();
    let mut bench = Counting { circuit: &circuit, at_ps: PERIOD_PS };
    let counts: Vec<_> = (0..4097).map(|_| bench.step(&mut simulator, true, false)).collect();
    assert_eq!(counts[4094..], [4095, 0, 1]);
}
