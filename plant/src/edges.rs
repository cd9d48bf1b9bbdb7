//! The next fringe and the next grating line, as instants; no grid.
//!
//! A fringe comes when the table has moved on by `λ/2` as the laser reads it, a line when the
//! spindle has turned on by one line as the grating reads it. Both are roots of
//!
//! ```text
//! v·t + δ(t) + corrector = (k + ½)·pitch        in µm
//! ```
//!
//! δ changes little from one edge to the next, so Newton's method from the last edge ends after one
//! or two evaluations of δ, which is a polynomial where the effects are smooth ([`crate::Effect::smoothness`]).
//! Instants are right to 1e-10 s for smooth effects, and to the same for rough ones away from their
//! jumps. Where the reading jumps ahead by more than a pitch, the pulses it owes come one
//! [`SHORTEST_S`] after the other, as from a detector of that bandwidth.

mod channel;

use channel::{Channel, Reading};

use crate::actuator::Actuator;
use crate::{EffectError, Model, Motion, motion::Pass, units::in_reach};

/// Shortest time between two pulses of one channel, s: photo detectors of 1 MHz.
pub const SHORTEST_S: f64 = 1e-6;

/// Most pulses that a reading may owe at once: 20 ms of them, some 6 mm of fringes.
const MOST_OWED: u32 = 20_000;

/// Which pulse train an edge belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The laser: one fringe, λ/2 of table travel.
    Fringe,
    /// The circular grating: one line.
    Line,
}

/// A pulse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    /// When, s since the start of the pass.
    pub time_s: f64,
    /// Of which train.
    pub source: Source,
}

/// Where table and thread are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Nominal travel, mm.
    pub position_mm: f64,
    /// How much longer than nominal the thread is there, µm.
    pub lead_error_um: f64,
    /// What the corrector holds the table ahead by, µm.
    pub corrector_um: f64,
}

/// The pulses of one pass, while the corrector moves the table.
///
/// # Examples
///
/// ```
/// # use std::path::Path;
/// # let text = "workpiece.lead = '6 mm'\nspindle.speed = '6 rpm'\ngrating.lines = 13906\n\
/// #     laser.wavelength = '0.63281983 um'\ndividers = { a = 110, b = 150 }\n\
/// #     drive = { step = '0.0125 um', frequency = '160 Hz' }";
/// use helixlock_plant::{Model, edges::{Edges, Source}, motion::Pass};
///
/// let model = Model::parse(text, Path::new("machine.toml"))?;
/// let mut edges = Edges::new(&model, &Pass::forward(&model))?;
/// // The fringe is shorter than the line: λ/2 = 0.316 µm against 6 mm / 13906 = 0.431 µm.
/// let first = edges.next().expect("the pass has just begun");
/// assert_eq!(first.source, Source::Fringe);
/// assert!((first.time_s - 0.5 * 0.63281983 / 2.0 / 600.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Edges {
    motion: Motion,
    actuator: Actuator,
    corrector_um: f64,
    fringe: Channel,
    line: Channel,
    failure: Option<EffectError>,
}

impl Edges {
    /// The pulses of a pass, both trains half a pitch before their first.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when an effect needs a section of the machine file that is missing, or begins
    /// with a value that no machine could follow.
    pub fn new(model: &Model, pass: &Pass) -> Result<Self, EffectError> {
        let motion = Motion::new(model, pass)?;
        let line_um = 1000.0 * model.workpiece.lead.mm() / f64::from(model.grating.lines);
        let fringe = Channel::new(&motion, Reading::Laser, model.fringe_um());
        let line = Channel::new(&motion, Reading::Grating, line_um);
        let actuator = Actuator::new(model)?;
        let mut edges = Self { motion, actuator, corrector_um: 0.0, fringe, line, failure: None };
        edges.fringe.plan(&edges.motion, 0.0, 0.0);
        edges.line.plan(&edges.motion, 0.0, 0.0);
        edges.place(0.0);
        edges.failure().map_or(Ok(edges), Err)
    }

    /// When the next line comes, s; infinity at the end of the pass.
    #[must_use]
    pub fn next_line_s(&self) -> f64 {
        self.line.due_s
    }

    /// When the next fringe comes with the table where it is, s; infinity at the end of the pass.
    #[must_use]
    pub fn next_fringe_s(&self) -> f64 {
        self.fringe.due_s
    }

    /// The line announced has passed.
    pub fn pass_line(&mut self) {
        self.line.pass(&self.motion, self.corrector_um);
    }

    /// The fringe announced has passed.
    pub fn pass_fringe(&mut self) {
        self.fringe.pass(&self.motion, self.corrector_um);
    }

    /// The motor takes one step: the table moves at once, and the fringe announced with it.
    ///
    /// `time_s` is not before the last edge that has passed, and not after the next fringe.
    pub fn step(&mut self, time_s: f64, forward: bool) {
        let corrector_um = self.actuator.step(&self.motion, time_s, forward);
        if corrector_um.to_bits() != self.corrector_um.to_bits() {
            self.corrector_um = corrector_um;
            self.fringe.plan(&self.motion, time_s, corrector_um);
        }
    }

    /// Where table and thread are at a time, with the corrector where it is.
    pub fn place(&mut self, time_s: f64) -> Place {
        let now = self.motion.at(time_s);
        let sums = self.motion.deltas(&now, self.corrector_um);
        let lead_error_um = sums.motion_um + sums.workpiece_um + self.corrector_um;
        if !in_reach(lead_error_um) && self.failure.is_none() {
            self.failure = Some(self.motion.out_of_reach(time_s, self.corrector_um));
        }
        Place { position_mm: now.position_mm, lead_error_um, corrector_um: self.corrector_um }
    }

    /// The first value that no machine could follow; from there on no pulses come.
    #[must_use]
    pub fn failure(&self) -> Option<EffectError> {
        let mut channels = [&self.line, &self.fringe].into_iter();
        let failed = channels.find_map(|channel| channel.failure.clone());
        failed.or_else(|| self.failure.clone())
    }

    /// The motion behind the pulses.
    #[must_use]
    pub fn motion(&self) -> &Motion {
        &self.motion
    }

    /// Net steps taken, forward positive.
    #[must_use]
    pub fn steps(&self) -> i64 {
        self.actuator.steps()
    }
}

/// Both trains in order of time; at the same instant the line first.
impl Iterator for Edges {
    type Item = Edge;

    fn next(&mut self) -> Option<Edge> {
        let (line_s, fringe_s) = (self.line.due_s, self.fringe.due_s);
        if line_s <= fringe_s && line_s.is_finite() {
            self.pass_line();
            Some(Edge { time_s: line_s, source: Source::Line })
        } else if fringe_s.is_finite() {
            self.pass_fringe();
            Some(Edge { time_s: fringe_s, source: Source::Fringe })
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests;
