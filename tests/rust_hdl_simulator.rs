//! The device in rust-hdl's own simulator and in our engine: every output is equal.
//!
//! That simulator is wrong in some idioms, which the device does not use; here it is right, and
//! it shares no code with the engine but the description.

use helixlock_rtl::device::Device;
use helixlock_sim::{Engine, device, stepped_device};
use rust_hdl::core::simulate::simulate;
use rust_hdl::prelude::Block;

use crate::lockstep::stimulus::{Stimulus, dense, realistic};

/// Clocks of each stimulus: the simulator takes some ten thousand a second.
const CLOCKS: u32 = 20_000;

/// Sets the inputs, all in port order.
macro_rules! set {
    ($device:ident, $values:ident, $($input:ident: $sort:ident),+) => {
        let mut values = $values.iter().copied();
        $($device.$input.next = set!(@$sort values.next().expect("a value each"));)+
    };
    (@bit $value:expr) => { $value == 1 };
    (@bits $value:expr) => { $value.into() };
}

fn apply(device: &mut Device, values: &[u64]) {
    set!(
        device, values, master_reset: bit, grating: bit, laser: bit, start: bit, correct: bit,
        playback: bit, calibrate: bits, manual_step: bit, manual_forward: bit, divide_a: bits,
        divide_b: bits, range_x2: bit, initial_phase: bits, compensation: bits,
        compensation_insert: bit, step_period: bits
    );
}

/// The outputs by name.
fn outputs(device: &Device) -> Vec<(&'static str, u64)> {
    macro_rules! bits {
        ($($output:ident),+) => { vec![$((stringify!($output), u64::from(device.$output.val()))),+] };
    }
    let mut all = bits!(
        t1,
        t2,
        standard,
        cp1,
        cp2,
        q,
        q_bar,
        step,
        forward,
        reverse,
        phase_a,
        phase_b,
        phase_c,
        count_forward,
        zero,
        fault,
        measuring,
        grating_divided,
        laser_divided
    );
    all.push(("count", device.count.val().to_u64()));
    all
}

/// Inputs settle while the clock is low; then comes the rising edge.
fn clock(block: &mut Device) {
    for level in [false, true] {
        block.clock.next = level.into();
        assert!(simulate(block, 100), "the device settles");
    }
}

fn compare(mut stimulus: Stimulus) {
    let netlist = device().netlist();
    let mut engine = stepped_device();
    let mut block = Device::default();
    block.connect_all();
    let mut inputs = vec![0; netlist.inputs.len()];
    for number in 1..=CLOCKS {
        stimulus.next(&mut inputs);
        apply(&mut block, &inputs);
        clock(&mut block);
        for (&input, &value) in netlist.inputs.iter().zip(&inputs) {
            engine.set_input(input, value);
        }
        engine.step();
        for (name, simulated) in outputs(&block) {
            let signal = netlist.find(name).expect("an output");
            assert_eq!(engine.value(signal), simulated, "{name} after clock {number}");
        }
    }
}

#[test]
fn the_simulator_agrees_on_noise() {
    compare(dense(device().netlist(), 10));
}

#[test]
fn the_simulator_agrees_on_a_pass() {
    compare(realistic(device().netlist(), 11));
}

#[test]
fn inputs_are_applied_in_port_order() {
    let netlist = device().netlist();
    let names: Vec<_> = netlist.inputs.iter().map(|&id| netlist.signal(id).path.as_str()).collect();
    let applied = "master_reset grating laser start correct playback calibrate manual_step \
                   manual_forward divide_a divide_b range_x2 initial_phase compensation \
                   compensation_insert step_period";
    assert_eq!(names.join(" "), applied);
}
