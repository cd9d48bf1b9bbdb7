//! A machine as the loop sees it.

use helixlock_plant::EffectError;

/// What the loop needs of the machine.
///
/// Instants are in s since the start of the run; infinity means that none comes any more.
pub trait Process {
    /// When the next grating line comes.
    fn next_line_s(&mut self) -> f64;
    /// When the next fringe comes, with the table where it is now.
    fn next_fringe_s(&mut self) -> f64;
    /// The line announced has passed.
    fn pass_line(&mut self);
    /// The fringe announced has passed.
    fn pass_fringe(&mut self);
    /// The motor takes one step.
    fn step(&mut self, time_s: f64, forward: bool);
    /// Where table and workpiece are.
    fn place(&mut self, time_s: f64) -> Place;
    /// Why no more lines and fringes come, unless the pass is over.
    fn failure(&self) -> Option<EffectError>;
}

/// Where the machine is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Nominal position on the workpiece, mm.
    pub position_mm: f64,
    /// How much longer than nominal the thread is there, µm.
    pub lead_error_um: f64,
    /// What the motor has moved the table, µm.
    pub correction_um: f64,
}
