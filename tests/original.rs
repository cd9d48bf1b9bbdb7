//! Gates of 1977 beside the clocked blocks: one coincidence at the phase meter as a picture, and the
//! reset counter over any history.

use expect_test::expect_file;
use helixlock_original::figures::{phase_meter, reset_counter};
use helixlock_original::{Circuit, Corner, Delays, Simulator, Train};
use helixlock_report::{Lane, Waveform};
use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

/// Grating and laser rise 40 ns apart; pulses of 120 ns, shorter than the device's, fit the picture.
const RISES_PS: [(&str, u64); 2] = [("grating", 40_000), ("laser", 80_000)];
const PULSE_PS: u64 = 120_000;
const END_NS: f64 = 420.0;

/// Instants and levels of a wire, ns.
type Changes = Vec<(f64, Option<bool>)>;

/// The picture in docs/verification.md is what the two do.
#[test]
fn coincidence_picture_is_fresh() {
    let circuit = phase_meter::circuit();
    let mut lanes = original(&circuit);
    lanes.extend(reconstruction());
    let divisions = (1..21).map(|division| (20.0 * f64::from(division), String::new())).collect();
    let picture = Waveform {
        width_px: 960,
        time_label: "time in ns, 20 ns a division".into(),
        range: [0.0, END_NS],
        lanes,
        arrows: vec![],
        marks: divisions,
    };
    expect_file!["../docs/figures/coincidence.svg"].assert_eq(&picture.svg());
}

fn bit(name: String, changes: Changes) -> Lane {
    Lane::Bit { name, changes }
}

/// Pins and gates of figure 3 with typical delays.
fn original(circuit: &Circuit) -> Vec<Lane> {
    let delays = Delays::corner(circuit, Corner::Typical);
    let mut simulator = Simulator::new(circuit, &delays).expect("it rests");
    // A laser pulse first: the meter is low, as in the reconstruction after power-up.
    let laser = circuit.pin("laser").expect("a pin");
    let mut train = Train::new();
    train.pulse(1_000_000, laser, PULSE_PS);
    let begin_ps = 10_000_000;
    for (pin, rises_ps) in RISES_PS {
        train.pulse(begin_ps + rises_ps, circuit.pin(pin).expect("a pin"), PULSE_PS);
    }
    for (time_ps, pin, level) in train.changes() {
        simulator.drive(time_ps, pin, level).expect("in order");
    }
    simulator.run_until(begin_ps);
    simulator.take_edges();
    let wires = ["grating", "laser", "set", "clear", "meter", "meter_bar"];
    let nets = wires.map(|name| circuit.pin(name).expect("a wire"));
    let before = nets.map(|net| simulator.level(net));
    simulator.run_until(begin_ps + 500_000);
    let edges = simulator.take_edges();
    let names = ["grating", "laser", "NAND set", "NOT clear", "T1", "T2"];
    let lanes = names.into_iter().zip(nets).zip(before).map(|((name, net), level)| {
        let own = edges.iter().filter(|edge| edge.net == net);
        let own = own.map(|edge| (nanoseconds(edge.time_ps - begin_ps), Some(edge.level)));
        bit(format!("1977: {name}"), [(0.0, Some(level))].into_iter().chain(own).collect())
    });
    lanes.collect()
}

/// The clocked blocks, 12 MHz: two synchronisers and the meter.
fn reconstruction() -> Vec<Lane> {
    let names = ["clock", "grating", "laser", "meter"];
    let mut lanes: [Changes; 4] = [const { vec![] }; 4];
    let [mut grating, mut laser] = ["input_synchroniser"; 2].map(Bench::new);
    let mut meter = Bench::new("phase_meter");
    for clock in 0..12_u32 {
        // The clock runs free: its edges are where they are.
        let rises_ns = f64::from(clock) * 1e3 / 12.0 - 500.0;
        let at_ps = |pin: usize| {
            let high_ns = nanoseconds(RISES_PS[pin].1);
            let until_ns = high_ns + nanoseconds(PULSE_PS);
            u64::from((high_ns..until_ns).contains(&rises_ns))
        };
        grating.set(&[("pin", at_ps(0))]);
        laser.set(&[("pin", at_ps(1))]);
        let (set, clear) = (grating.get("rising"), laser.get("rising"));
        meter.set(&[("grating", set), ("laser", clear)]);
        for block in [&mut grating, &mut laser, &mut meter] {
            block.clock();
        }
        let levels = [grating.high("rising"), laser.high("rising"), meter.high("meter")];
        if 0.0 <= rises_ns {
            lanes[0].extend([(rises_ns, Some(true)), (rises_ns + 500.0 / 12.0, Some(false))]);
        }
        for (lane, level) in lanes[1..].iter_mut().zip(levels) {
            lane.push((rises_ns.max(0.0), Some(level)));
        }
    }
    lanes[0].insert(0, (0.0, Some(false)));
    let shown = names.into_iter().zip(lanes);
    shown.map(|(name, changes)| bit(format!("12 MHz: {name}"), changes)).collect()
}

#[expect(clippy::cast_precision_loss, reason = "a microsecond in picoseconds")]
fn nanoseconds(ps: u64) -> f64 {
    ps as f64 / 1e3
}

/// From step to step, ps.
const STEP_PS: u64 = 5_000_000;

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Steps of any direction, by hand or played back, with any delays within the data sheets: gates
    /// and block show the same count, side and zero after each, and let the same steps through.
    #[test]
    fn reset_counter_of_gates_is_the_block(
        history in vec((any::<bool>(), 0..8, 1_u64..30), 1..20), seed: u64,
    ) {
        let circuit = reset_counter::circuit();
        let delays = Delays::drawn(&circuit, seed);
        let mut gates = Simulator::new(&circuit, &delays).expect("it rests");
        let mut block = Bench::new("reset_counter");
        block.pulse(&["clear"]);
        let mut at_ps = STEP_PS;
        for (forward, dice, steps) in history {
            for _ in 0..steps {
                let inputs = [("forward", forward), ("playback", dice == 0)];
                let passed = step(&mut gates, &circuit, at_ps, inputs);
                at_ps += STEP_PS;
                block.set(&inputs.map(|(pin, level)| (pin, level.into())));
                block.set(&[("request", 1)]);
                prop_assert_eq!(passed, block.high("step"));
                block.clock();
                block.set(&[("request", 0)]);
                let bits = (0..reset_counter::STAGES).rev();
                let count = bits.fold(0, |count, bit| {
                    2 * count + u64::from(level(&gates, &circuit, &format!("count{bit}")))
                });
                prop_assert_eq!(count, block.get("count"));
                for pin in ["count_forward", "zero"] {
                    prop_assert_eq!(level(&gates, &circuit, pin), block.high(pin), "{}", pin);
                }
            }
        }
    }
}

/// A request to the gates, and whether it passed.
fn step(gates: &mut Simulator, circuit: &Circuit, at_ps: u64, inputs: [(&str, bool); 2]) -> bool {
    let pin = |name: &str| circuit.pin(name).expect("a pin");
    let request = [("request", at_ps + STEP_PS / 4, true), ("request", at_ps + STEP_PS / 2, false)];
    let before = inputs.map(|(name, level)| (name, at_ps, level));
    for (name, time_ps, level) in before.into_iter().chain(request) {
        gates.drive(time_ps, pin(name), level).expect("in order");
    }
    gates.take_edges();
    gates.run_until(at_ps + STEP_PS - 1);
    gates.take_edges().iter().any(|edge| edge.net == pin("taken") && edge.level)
}

fn level(gates: &Simulator, circuit: &Circuit, pin: &str) -> bool {
    gates.level(circuit.pin(pin).expect("a pin"))
}
