//! What crosses crates; one module a subject.

mod bad_data;
mod bad_input;
mod blocks_apart;
mod boards;
mod calibrator;
mod command_line;
mod cumulative_compensator;
mod decade_counter;
mod device;
mod digital_comparison;
mod direction_discriminator;
mod documentation;
mod documented_waveforms;
mod effects_in_the_loop;
mod example_data;
mod examples;
mod golden_verilog;
mod initial_phase_selector;
mod layers;
mod linuxcnc;
<<<<<<< HEAD
mod lockstep;
=======
mod metrology;
>>>>>>> 243d821 (Add an example of each document, with figures and what does not come out)
mod parquet_readers;
mod phase_meter;
mod programmable_divider;
mod properties;
mod range_stage;
mod reset_counter;
mod ring_distributor;
mod rust_hdl_verilog;
mod scale_lookup;
mod simulation;
mod standard_wave;
mod step_clock;
mod step_driver;
mod step_selector;
mod subdivided_comparison;
mod support;
mod synchronisers;
mod waveform_readers;
