//! What crosses crates; one module a subject.

mod blocks_apart;
mod calibrator;
mod cumulative_compensator;
mod decade_counter;
mod device;
mod digital_comparison;
mod direction_discriminator;
mod documented_waveforms;
mod golden_verilog;
mod initial_phase_selector;
mod linuxcnc;
mod phase_meter;
mod programmable_divider;
mod properties;
mod range_stage;
mod reset_counter;
mod ring_distributor;
mod scale_lookup;
mod standard_wave;
mod step_clock;
mod step_driver;
mod step_selector;
mod subdivided_comparison;
mod support;
mod synchronisers;
mod waveform_readers;
