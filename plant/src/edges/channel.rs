//! One pulse train: its reading as a function of time, and the moment it reaches the next pulse.

use super::{MOST_OWED, SHORTEST_S};
use crate::motion::{Motion, Stretch};
use crate::piece::Piece;
use crate::smoothness::combined;
use crate::units::in_reach;
use crate::{Effect, EffectError, Entry, Instant, Smoothness};

/// What is left to the root after the last step of Newton's method, s.
const TOLERANCE_S: f64 = 5e-11;
/// Newton stops once a step is this short where the slope of rough effects is not known, so that
/// each step is shorter than the last by a ratio only.
const CLOSE_ROUGH_S: f64 = 1e-11;
/// Steps after which a root that a jump hides is bisected.
const NEWTON_STEPS: usize = 8;

/// What a channel reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
    /// Table travel by the laser.
    Laser,
    /// Spindle angle by the grating, as lead.
    Grating,
}

impl Reading {
    /// Sign with which an entry adds to the reading.
    fn sign(self, entry: Entry) -> f64 {
        match (self, entry) {
            (Self::Laser, Entry::Motion) | (Self::Grating, Entry::AngleReference) => 1.0,
            (Self::Laser, Entry::LengthReference | Entry::Electronics) => -1.0,
            _ => 0.0,
        }
    }
}

/// A pulse train and the pulse it will give next.
#[derive(Debug)]
pub(super) struct Channel {
    reading: Reading,
    pitch_um: f64,
    /// Reading at the start of the pass, from which pulses are counted.
    zero_um: f64,
    /// Smooth effects, as indices into the motion's, with their signs.
    smooth: Vec<(usize, f64)>,
    /// The others; any that depends on the error makes all be summed afresh.
    rough: Vec<(usize, f64)>,
    feeds_back: bool,
    smoothness: Vec<Smoothness>,
    /// Newton's last step may be this long, s.
    close_s: f64,
    stretch: usize,
    piece: Option<Piece>,
    /// Pulses passed, counted back in reverse.
    passed: i64,
    last_s: f64,
    /// Reading's slope at the last root, µm/s.
    slope_um_s: f64,
    /// Pulses in a row that came later than the reading wanted them.
    owed: u32,
    /// Why no more pulses come.
    pub(super) failure: Option<EffectError>,
    /// When the next pulse comes, s; infinity when none does.
    pub(super) due_s: f64,
}

impl Channel {
    pub(super) fn new(motion: &Motion, reading: Reading, pitch_um: f64) -> Self {
        let first = &motion.stretches[0];
        let (mut smooth, mut rough) = (Vec::new(), Vec::new());
        for (index, (entry, effect)) in motion.effects().iter().enumerate() {
            let sign = reading.sign(*entry);
            if sign != 0.0 {
                let list = match rates(effect, first) {
                    Smoothness::Rough => &mut rough,
                    _ => &mut smooth,
                };
                list.push((index, sign));
            }
        }
        let fed = |(index, _): &(usize, f64)| motion.effects()[*index].1.feeds_back();
        let feeds_back = smooth.iter().chain(&rough).any(fed);
        let smoothness = motion
            .stretches
            .iter()
            .map(|stretch| {
                let parts = smooth
                    .iter()
                    .map(|(index, sign)| (*sign, rates(&motion.effects()[*index].1, stretch)));
                combined(parts)
            })
            .collect();
        let mut channel = Self {
            reading,
            pitch_um,
            zero_um: 0.0,
            smooth,
            rough,
            feeds_back,
            smoothness,
            close_s: CLOSE_ROUGH_S,
            stretch: 0,
            piece: None,
            passed: 0,
            last_s: f64::NEG_INFINITY,
            slope_um_s: 1000.0 * first.velocity_mm_s,
            owed: 0,
            failure: None,
            due_s: 0.0,
        };
        channel.zero_um = channel.read_within(motion, first.start_s, 0.0).0;
        channel.enter(motion, 0);
        channel
    }

    /// The pulse that was due has passed: finds the next one.
    pub(super) fn pass(&mut self, motion: &Motion, corrector_um: f64) {
        let forward = 0.0 < motion.stretches[self.stretch].velocity_mm_s;
        self.passed += if forward { 1 } else { -1 };
        self.last_s = self.due_s;
        let guess_s = self.due_s + self.pitch_um / self.slope_um_s.abs();
        self.plan_near(motion, (self.due_s, guess_s), corrector_um);
    }

    /// Goes on to a stretch of the motion.
    fn enter(&mut self, motion: &Motion, stretch: usize) {
        let velocity_um_s = 1000.0 * motion.stretches[stretch].velocity_mm_s;
        self.stretch = stretch;
        self.piece = None;
        self.slope_um_s = velocity_um_s;
        let known = self.rough.is_empty() && !self.feeds_back;
        self.close_s = if known {
            longest_step_s(self.smoothness[stretch], velocity_um_s.abs())
        } else {
            CLOSE_ROUGH_S
        };
    }

    /// Finds the next pulse, which comes no earlier than `from_s`.
    pub(super) fn plan(&mut self, motion: &Motion, from_s: f64, corrector_um: f64) {
        let from_s = from_s.max(self.last_s);
        self.plan_near(motion, (from_s, from_s), corrector_um);
    }

    /// The same, with a guess of where to look first.
    fn plan_near(&mut self, motion: &Motion, (from_s, guess_s): (f64, f64), corrector_um: f64) {
        let (mut from_s, mut guess_s) = (from_s, guess_s);
        loop {
            let stretch = motion.stretches[self.stretch];
            if from_s <= stretch.end_s {
                let span_s = (from_s, guess_s);
                let root_s = self.root(motion, &stretch, span_s, corrector_um);
                if root_s <= stretch.end_s && self.failure.is_none() {
                    self.owe(motion, root_s);
                    return;
                }
            }
            if motion.stretches.len() <= self.stretch + 1 || self.failure.is_some() {
                self.due_s = f64::INFINITY;
                return;
            }
            self.enter(motion, self.stretch + 1);
            from_s = from_s.max(stretch.end_s);
            guess_s = from_s;
        }
    }

    /// The pulse comes when the reading reaches it, or as soon as the detector can give it.
    fn owe(&mut self, motion: &Motion, root_s: f64) {
        self.due_s = later(root_s, self.last_s + SHORTEST_S);
        self.owed = if root_s < self.due_s { self.owed + 1 } else { 0 };
        if MOST_OWED < self.owed {
            let reading = match self.reading {
                Reading::Laser => "table",
                Reading::Grating => "grating",
            };
            let place = motion.place(self.due_s);
            self.failure = Some(EffectError::TooFast { reading, most: MOST_OWED, place });
            self.due_s = f64::INFINITY;
        }
    }

    /// When the reading reaches the next pulse at or after `from_s`; beyond the stretch if never.
    fn root(
        &mut self,
        motion: &Motion,
        stretch: &Stretch,
        (from_s, guess_s): (f64, f64),
        corrector_um: f64,
    ) -> f64 {
        let forward = 0.0 < stretch.velocity_mm_s;
        #[expect(clippy::cast_precision_loss, reason = "far fewer than 2⁵³ pulses")]
        let count = self.passed as f64 + if forward { 0.5 } else { -0.5 };
        let target_um = self.zero_um + count * self.pitch_um;
        let mut time_s = guess_s;
        for _ in 0..NEWTON_STEPS {
            let (reading_um, slope_um_s) = self.read(motion, time_s, corrector_um);
            if !in_reach(reading_um) {
                // Beyond the stretch it may be what it likes; inside, the search below finds it.
                break;
            }
            if slope_um_s.is_finite() && slope_um_s * stretch.velocity_mm_s > 0.0 {
                self.slope_um_s = slope_um_s;
            }
            let step_s = (target_um - reading_um) / self.slope_um_s;
            if time_s <= from_s && step_s <= 0.0 {
                return from_s;
            }
            time_s += step_s;
            if step_s.abs() < self.close_s {
                return later(time_s, from_s);
            }
            if time_s < from_s || stretch.end_s + (stretch.end_s - from_s) + 1.0 < time_s {
                break;
            }
        }
        let mut reached = |time_s| {
            let reading_um = self.read_within(motion, time_s, corrector_um).0;
            let passed = if forward { target_um <= reading_um } else { reading_um <= target_um };
            passed || !in_reach(reading_um)
        };
        bisect(&mut reached, from_s, stretch.end_s)
    }

    /// The same inside the stretch, where every value counts.
    fn read_within(&mut self, motion: &Motion, time_s: f64, corrector_um: f64) -> (f64, f64) {
        let read = self.read(motion, time_s, corrector_um);
        if !in_reach(read.0) && self.failure.is_none() {
            self.failure = Some(motion.out_of_reach(time_s, corrector_um));
        }
        read
    }

    /// Reading, µm, and its slope, µm/s, without the part of rough effects.
    fn read(&mut self, motion: &Motion, time_s: f64, corrector_um: f64) -> (f64, f64) {
        let stretch = &motion.stretches[self.stretch];
        let velocity_um_s = 1000.0 * stretch.velocity_mm_s;
        let moved_um = if self.reading == Reading::Laser { corrector_um } else { 0.0 };
        let place_um = stretch.travel_um(time_s) + moved_um;
        if self.feeds_back {
            let now = motion.on(stretch, time_s);
            return (place_um + self.all(motion, &now, corrector_um), velocity_um_s);
        }
        let (smooth_um, slope_um_s) = self.smooth_part(motion, stretch, time_s);
        if self.rough.is_empty() {
            return (place_um + smooth_um, velocity_um_s + slope_um_s);
        }
        let rough_um = sum(&self.rough, motion, &motion.on(stretch, time_s));
        (place_um + smooth_um + rough_um, velocity_um_s + slope_um_s)
    }

    /// All effects of this channel, those that depend on the error included.
    fn all(&self, motion: &Motion, now: &Instant<'_>, corrector_um: f64) -> f64 {
        let sums = motion.deltas(now, corrector_um);
        match self.reading {
            Reading::Laser => sums.motion_um - sums.lag_um,
            Reading::Grating => sums.angle_um,
        }
    }

    /// Smooth effects and their slope, from a polynomial that is made anew where it ends.
    fn smooth_part(&mut self, motion: &Motion, stretch: &Stretch, time_s: f64) -> (f64, f64) {
        if self.smooth.is_empty() {
            return (0.0, 0.0);
        }
        let holds = |piece: &&Piece| piece.start_s() <= time_s && time_s <= piece.end_s;
        if let Some(piece) = self.piece.as_ref().filter(holds) {
            return piece.at(time_s);
        }
        let tolerance_um = 0.2 * TOLERANCE_S * 1000.0 * stretch.velocity_mm_s.abs();
        let longest_s = Piece::longest_s(self.smoothness[self.stretch], tolerance_um);
        let whole_s = stretch.end_s - stretch.start_s;
        let end_s = time_s + longest_s.min(whole_s.max(1e-3));
        let value = |time_s| sum(&self.smooth, motion, &motion.on(stretch, time_s));
        let piece = Piece::new(time_s, end_s, value);
        self.piece = Some(piece);
        piece.at(time_s)
    }
}

/// The later of two instants; the second when the first is none. One instruction, where `max` is four
/// that wait for each other, and the next pulse for them.
fn later(time_s: f64, other_s: f64) -> f64 {
    if other_s < time_s { time_s } else { other_s }
}

fn rates(effect: &impl Effect, stretch: &Stretch) -> Smoothness {
    if effect.feeds_back() {
        return Smoothness::Rough;
    }
    effect.smoothness(stretch.spindle_rad_s(), stretch.velocity_mm_s.abs())
}

fn sum(effects: &[(usize, f64)], motion: &Motion, now: &Instant<'_>) -> f64 {
    effects.iter().map(|(index, sign)| sign * motion.effects()[*index].1.delta_um(now)).sum()
}

/// Length of a step of Newton's method after which the root is within the tolerance.
///
/// A step of `s` leaves `|δ″|·s²/(2·v)`; at least 1e-8 s, so that rounding does not matter, and at
/// most 1e-6 s, so that neither do the bends of polynomials.
fn longest_step_s(smoothness: Smoothness, velocity_um_s: f64) -> f64 {
    let Smoothness::Band { amplitude_um, rate_per_s } = smoothness else { return 1e-6 };
    let bend_um_s2 = amplitude_um * rate_per_s * rate_per_s;
    (2.0 * velocity_um_s * TOLERANCE_S / bend_um_s2).sqrt().clamp(1e-8, 1e-6)
}

/// The first crossing that a jump or a bend hides from Newton's method; infinity when there is none.
///
/// Looks ahead in growing strides, so that what it finds is the first but for ripples shorter than
/// half the way to it.
fn bisect(reached: &mut impl FnMut(f64) -> bool, from_s: f64, end_s: f64) -> f64 {
    let (mut low_s, mut stride_s) = (from_s, SHORTEST_S);
    let mut high_s = loop {
        let next_s = (low_s + stride_s).min(end_s);
        if reached(next_s) {
            break next_s;
        }
        if end_s <= next_s {
            return f64::INFINITY;
        }
        (low_s, stride_s) = (next_s, stride_s * 1.5);
    };
    while 1e-12 < high_s - low_s {
        let middle_s = low_s + (high_s - low_s) / 2.0;
        if middle_s <= low_s || high_s <= middle_s {
            break;
        }
        if reached(middle_s) {
            high_s = middle_s;
        } else {
            low_s = middle_s;
        }
    }
    high_s
}
