//! Samples and waveforms in files.
