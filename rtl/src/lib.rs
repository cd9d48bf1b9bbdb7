//! The logic of the correction device, one block a file.
//!
//! [`BLOCKS`] lists those of the device in signal order, [`APART`] those of documents 3 and 4; [`device::Device`] joins them, and [`settings`] says
//! what its wheels mean. Each block's page names its figure, ports, sequence and waveform, what
//! happens when two things come at once, and what was inferred where the print is silent.

pub mod board_shell;
pub mod calibrator;
pub mod compensation_divider;
pub mod cumulative_compensator;
pub mod decade_counter;
pub mod device;
pub mod digital_comparison;
pub mod direction_discriminator;
pub mod frame_check;
pub mod index_gate;
pub mod initial_phase_selector;
pub mod input_conditioner;
pub mod input_synchroniser;
pub mod level_synchroniser;
pub mod logic_analyser;
pub mod phase_meter;
pub mod programmable_divider;
pub mod quadrature_decoder;
pub mod range_stage;
pub mod reset_counter;
pub mod ring_distributor;
pub mod scale_lookup;
pub mod settings;
pub mod settings_port;
pub mod standard_wave;
pub mod step_clock;
pub mod step_driver;
pub mod step_selector;
pub mod subdivided_comparison;
pub mod supervisor;
pub mod telemetry;
pub mod uart_receiver;
pub mod uart_transmitter;

mod blocks;

pub use blocks::{APART, BLOCKS, BlockCard};
