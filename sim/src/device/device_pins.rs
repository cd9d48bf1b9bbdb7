//! The device's ports, found by name once.

use helixlock_netlist::{Netlist, SignalId};

use crate::Error;

/// Inputs and outputs of `rtl::Device` that the closed loop drives or watches.
#[derive(Clone, Copy, Debug)]
pub struct DevicePins {
    /// Clears everything.
    pub master_reset: SignalId,
    /// Grating pulses.
    pub grating: SignalId,
    /// Laser pulses.
    pub laser: SignalId,
    /// Begins the pass.
    pub start: SignalId,
    /// Measure or correct.
    pub correct: SignalId,
    /// Plays the counted steps back.
    pub playback: SignalId,
    /// Known phase on the meter.
    pub calibrate: SignalId,
    /// Meter.
    pub t1: SignalId,
    /// A comparison begins.
    pub grating_divided: SignalId,
    /// One motor step.
    pub step: SignalId,
    /// Direction of the step.
    pub forward: SignalId,
    /// Initial phase selection is done.
    pub measuring: SignalId,
    /// Nothing counted.
    pub zero: SignalId,
    /// Counter saturated.
    pub fault: SignalId,
}

impl DevicePins {
    /// Finds the ports in a netlist of the device.
    ///
    /// # Errors
    ///
    /// [`Error::NoSignal`] when the netlist is of something else.
    pub fn find(netlist: &Netlist) -> Result<Self, Error> {
        let pin = |path| find(netlist, path);
        Ok(Self {
            master_reset: pin("master_reset")?,
            grating: pin("grating")?,
            laser: pin("laser")?,
            start: pin("start")?,
            correct: pin("correct")?,
            playback: pin("playback")?,
            calibrate: pin("calibrate")?,
            t1: pin("t1")?,
            grating_divided: pin("grating_divided")?,
            step: pin("step")?,
            forward: pin("forward")?,
            measuring: pin("measuring")?,
            zero: pin("zero")?,
            fault: pin("fault")?,
        })
    }
}

/// The signal of that path, as [`Netlist::find`], or an error that names it.
pub(crate) fn find(netlist: &Netlist, path: &str) -> Result<SignalId, Error> {
    netlist.find(path).ok_or_else(|| Error::NoSignal { path: path.to_owned() })
}
