//! The device, compiled in: its circuit, and engines that run it.

mod device_pins;
mod settings;
mod wheels;

use std::sync::LazyLock;

use helixlock_netlist::{Library, Netlist, elaborate};

use crate::engine::{Circuit, Compiled, Lanes, Leaping};

#[allow(clippy::all, clippy::pedantic, reason = "generated: written for the compiler alone")]
#[allow(unused_imports, reason = "a design may do without shifts")]
#[allow(unused_variables, reason = "bits that nobody takes: the compiler drops them")]
mod generated {
    use helixlock_netlist::SignalId;

    use crate::engine::{
        AllSignals, Coast, DenseKernel, Edge, Gather, Known, LANE_WORDS, Lane, LaneKernel, Rest,
        Vector, choose, shift_down, shift_up,
    };

    include!(concat!(env!("OUT_DIR"), "/device.rs"));
}

pub use device_pins::DevicePins;
pub(crate) use device_pins::find;
pub use generated::DeviceKernel;
pub(crate) use settings::dividers_fit;
pub use settings::{Dialled, settings_for};
pub use wheels::set_wheels;

/// The fast engine of the device: what a closed loop runs on.
pub type DeviceEngine = Leaping<'static, DeviceKernel>;

/// The device's netlist and its pieces; made once.
///
/// # Panics
///
/// Never: the build script has elaborated the same block.
#[must_use]
pub fn device() -> &'static Circuit {
    static DEVICE: LazyLock<Circuit> = LazyLock::new(|| Circuit::new(elaborated()));
    &DEVICE
}

/// The device at power-up, with all inputs low, ready to leap.
#[must_use]
pub fn device_engine() -> DeviceEngine {
    Leaping::new(device())
}

/// The device at power-up, with all inputs low, stepped at every clock.
#[must_use]
pub fn stepped_device() -> Compiled<'static, DeviceKernel> {
    Compiled::new(device())
}

/// 512 devices at power-up, with all inputs low.
#[must_use]
pub fn device_lanes() -> Lanes<'static, DeviceKernel> {
    Lanes::new(device())
}

/// The blocks of the device by their names and pages, under the project's licence, for Verilog.
#[must_use]
pub fn library() -> Library {
    let blocks = helixlock_rtl::BLOCKS.iter().fold(Library::new(), |library, card| {
        library.with(card.name, card.summary, (card.build)()).described(card.ports())
    });
    blocks.licensed("MIT OR Apache-2.0")
}

fn elaborated() -> Netlist {
    let card = helixlock_rtl::BLOCKS.iter().find(|card| card.name == "device");
    let card = card.expect("the build script has found it");
    let design = elaborate(card.name, (card.build)().as_ref(), &Library::new());
    let netlist = Netlist::new(&design.expect("the build script has elaborated it"));
    netlist.expect("the build script has flattened it")
}

#[cfg(test)]
mod tests {
    use helixlock_netlist::SignalId;

    use super::*;
    use crate::engine::{Dice, Engine, Interpreter, LANE_WORDS, compare, compare_lanes};

    /// Inputs of their own, flips and fills included.
    #[test]
    fn every_lane_is_a_device_of_its_own() {
        for seed in 0..4 {
            compare_lanes::<DeviceKernel>(device(), &Dice(seed));
        }
    }

    #[test]
    fn only_the_flipped_lane_is_unlike() {
        let mut lanes = device_lanes();
        lanes.flip(77, 5);
        let mut expected = [0; LANE_WORDS];
        expected[1] = 1 << 13;
        assert_eq!(lanes.unlike(0), expected);
    }

    #[test]
    fn both_compiled_engines_agree_with_the_reference_on_noise() {
        for seed in 0..20 {
            compare(device().netlist(), &mut device_engine(), &mut Dice(seed));
            compare(device().netlist(), &mut stepped_device(), &mut Dice(seed));
        }
    }

    /// Pulses at nearly equal rates drift past each other, so that every coincidence comes about;
    /// switches are thrown in between.
    #[test]
    fn leaping_a_pass_is_stepping_it() {
        let netlist = device().netlist();
        let mut leap = device_engine();
        let mut stepped = stepped_device();
        let mut reference = Interpreter::new(netlist);
        let mut dice = Dice(1977);
        let mut grating = 0;
        let mut laser = 0;
        for clock in 0..60_000 {
            let mut inputs: Vec<(SignalId, u64)> = Vec::new();
            let mut set = |path: &str, value| inputs.push((netlist.find(path).unwrap(), value));
            if clock == 0 {
                for (path, value) in [("divide_a", 0x003), ("divide_b", 0x004), ("start", 1)] {
                    set(path, value);
                }
                for (path, value) in [("initial_phase", 0x002), ("compensation", 0x0001)] {
                    set(path, value);
                }
                set("step_period", 37);
            }
            grating = (grating + 1) % 24;
            laser = if clock % 1000 == 0 { laser } else { (laser + 1) % 18 };
            set("grating", u64::from(grating < 9));
            set("laser", u64::from(laser < 8));
            if dice.below(900) == 0 {
                let path = dice.pick(&[
                    "start",
                    "correct",
                    "correct",
                    "playback",
                    "manual_step",
                    "manual_forward",
                    "calibrate",
                    "range_x2",
                    "compensation_insert",
                    "master_reset",
                ]);
                set(path, dice.below(2));
            }
            for (input, value) in inputs {
                leap.set_input(input, value);
                stepped.set_input(input, value);
                reference.set_input(input, value);
            }
            leap.step();
            stepped.step();
            reference.step();
            assert_eq!(leap.snapshot(), reference.snapshot());
            assert_eq!(stepped.snapshot(), reference.snapshot());
        }
    }
}
