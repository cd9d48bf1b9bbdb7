//! The price of looking: at how many independent places an effect was tried.
//!
//! Of values that are listed each one is a place. Along a parameter that varies continuously the
//! curve of an effect turns, and only what it turns by is new: noise reaches a gain `u` somewhere
//! along an arc `s` (rad, in the whitened space of the samples) oftener than at one place by
//!
//! ```text
//! 1 + s·√(u/2π)
//! ```
//!
//! the expected upcrossings of Davies (1987, *Hypothesis testing when a nuisance parameter is
//! present only under the alternative*, Biometrika 74:33) over the tail of χ² at large `u`; the
//! factors of several parameters multiply as the Euler characteristics do (Vitells and Gross 2011,
//! arXiv 1105.4355). It is also what a flat prior costs by the Laplace approximation, whence arcs
//! are those through the best place: as wide a share of the chances is for narrow bumps as for wide
//! ones, though there is room for more of them.
//!
//! A step may begin at any instant between two samples, and its curve turns by a finite angle `θ`
//! from one to the next. That noise which does not reach the gain at one does at the next has the
//! share `erf(√u·tan(θ/2)/√2)`, which is `θ·√(u/2π)` for small angles and 1 for right ones.
//!
//! Which of both an axis is, is found by halving its intervals: a smooth curve turns by as much on
//! two halves as on the whole, one that jumps from sample to sample by more.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

use super::count;

/// Where an effect was looked for.
#[derive(Debug, Clone)]
pub(crate) struct Looks {
    /// Listed values.
    places: f64,
    /// Parameters that vary.
    axes: Vec<Axis>,
}

/// Where a curve was looked for along one of its parameters.
#[derive(Debug, Clone, Default)]
struct Axis {
    /// What it turns by smoothly, rad.
    arc: f64,
    /// Steps in which it jumps, and what it turns by in some of them, rad.
    jumps: f64,
    turns: Vec<f64>,
}

impl Axis {
    /// Independent places for a gain of so many deviations squared.
    fn places(&self, deviations: f64) -> f64 {
        let new = |turn: &f64| libm::erf(deviations * libm::tan(0.5 * turn) * FRAC_1_SQRT_2);
        let new_ones: f64 = self.turns.iter().map(new).sum();
        let jumps = self.jumps * new_ones / count(self.turns.len().max(1));
        1.0 + self.arc * deviations / TAU.sqrt() + jumps
    }
}

/// Intervals of an axis that are measured; the others are taken to be like them.
const MEASURED: usize = 8;

/// How often an interval is halved: its finest piece is a sixteenth, as fine as a search goes.
const HALVINGS: u32 = 4;

/// Growth of a length by a halving up to which a curve is smooth; one that jumps grows by √2.
const SMOOTH: f64 = 1.15;

/// An angle up to which smooth or not is all the same, for either law then says as much, rad.
const SMALL: f64 = 0.1;

/// An angle that is none: between equal curves rounding leaves a few 1e-8, rad.
const NONE: f64 = 1e-6;

/// Least share of a length in either half of an interval for it not to be a single jump.
const EVEN: f64 = 0.2;

impl Looks {
    /// So many places, none of them continuous.
    #[must_use]
    pub(crate) fn at_places(places: f64) -> Self {
        Self { places, axes: Vec::new() }
    }

    /// The same with one more continuous parameter.
    #[must_use]
    pub(crate) fn along(mut self, arc: f64) -> Self {
        self.axes.push(Axis { arc, ..Axis::default() });
        self
    }

    /// The same, so many times.
    #[must_use]
    pub(crate) fn times(mut self, factor: f64) -> Self {
        self.places *= factor;
        self
    }

    /// The same along the values of an axis, in order; `span` are orthonormal vectors of the curve.
    #[must_use]
    pub(crate) fn over(mut self, values: &[f64], span: impl Fn(f64) -> Vec<Vec<f64>>) -> Self {
        let intervals = values.len().saturating_sub(1);
        let every = intervals.div_ceil(MEASURED).max(1);
        let mut axis = Axis::default();
        let mut measured = 0_usize;
        for pair in values.windows(2).skip(every / 2).step_by(every) {
            let ends = [(pair[0], span(pair[0])), (pair[1], span(pair[1]))];
            let turn = angle(&ends[0].1, &ends[1].1);
            measure(&ends, turn, &span, HALVINGS, &mut axis);
            measured += 1;
        }
        let like_them = count(intervals) / count(measured.max(1));
        axis.arc *= like_them;
        axis.jumps = like_them * count(axis.turns.len());
        self.axes.push(axis);
        self
    }

    /// Independent places for a gain.
    #[must_use]
    pub(crate) fn for_gain(&self, gain: f64) -> f64 {
        let deviations = gain.max(0.0).sqrt();
        self.places * self.axes.iter().map(|axis| axis.places(deviations)).product::<f64>()
    }
}

/// Adds what a curve turns by between two of its values to an axis.
fn measure(
    [from, to]: &[(f64, Vec<Vec<f64>>); 2],
    whole: f64,
    span: &impl Fn(f64) -> Vec<Vec<f64>>,
    halvings: u32,
    axis: &mut Axis,
) {
    if whole < SMALL {
        axis.arc += whole;
        return;
    }
    let middle = 0.5 * (from.0 + to.0);
    let between = (middle, span(middle));
    let halves = [angle(&from.1, &between.1), angle(&between.1, &to.1)];
    let sum = halves[0] + halves[1];
    if halves[0].min(halves[1]) < NONE {
        axis.turns.push(whole);
    } else if sum <= SMOOTH * whole && EVEN * sum <= halves[0].min(halves[1]) {
        axis.arc += sum;
    } else if halvings == 1 {
        axis.turns.extend(halves);
    } else {
        measure(&[from.clone(), between.clone()], halves[0], span, halvings - 1, axis);
        measure(&[between, to.clone()], halves[1], span, halvings - 1, axis);
    }
}

/// Root mean square of the angles between two spaces, given by orthonormal vectors, rad.
#[must_use]
fn angle(one: &[Vec<f64>], other: &[Vec<f64>]) -> f64 {
    let width = one.len().min(other.len());
    if width == 0 {
        return 0.0;
    }
    let shared: f64 = one
        .iter()
        .flat_map(|a| other.iter().map(move |b| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>()))
        .map(|along| along * along)
        .sum();
    let apart = (1.0 - shared / count(width)).clamp(0.0, 1.0);
    libm::asin(apart.sqrt()).min(FRAC_PI_2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numerics::chi_squared_tail;

    /// A circle's arc in the plane: the tube around it is exact, `s/π·exp(−u/2)` beside its ends.
    #[test]
    fn an_arc_costs_what_the_tube_around_it_holds() {
        for arc in [0.3_f64, 1.0, 3.0] {
            for gain in [12.0, 20.0, 40.0] {
                let one_place = chi_squared_tail(gain, 1.0);
                let anywhere = one_place + arc / std::f64::consts::PI * libm::exp(-0.5 * gain);
                let said = one_place * Looks::at_places(1.0).along(arc).for_gain(gain);
                assert!((said / anywhere - 1.0).abs() < 0.07, "{arc} rad, gain {gain}");
            }
        }
    }

    /// Two normal values of correlation cos θ: the share that is beyond 5 in the second alone, by
    /// quadrature of `φ(z)·Φ((5 − z·cos θ)/sin θ)` with `scipy`.
    #[test]
    fn neighbouring_instants_are_new_as_far_as_they_turn() {
        let shares = [(0.05, 0.1032), (0.3, 0.5667), (0.6, 0.8908), (1.57, 1.0)];
        for (turn, share) in shares {
            let there = |place: f64| vec![vec![libm::cos(place * turn), libm::sin(place * turn)]];
            let jump = |place: f64| there(f64::from(u8::from(0.3 < place)));
            let looks = Looks::at_places(1.0).over(&[0.0, 1.0], jump).for_gain(25.0);
            assert!(((looks - 1.0) / share - 1.0).abs() < 0.05, "{turn} rad: {looks}");
        }
    }

    /// A wave on 400 places turns by its arc `2π·σ`; a step by a place at a time.
    #[test]
    fn an_axis_is_as_long_as_its_curve_turns() {
        let unit = |curve: Vec<f64>| {
            let size = curve.iter().map(|value| value * value).sum::<f64>().sqrt();
            vec![curve.into_iter().map(|value| value / size.max(1e-300)).collect::<Vec<f64>>()]
        };
        let places: Vec<f64> = (0..400_u32).map(|row| (f64::from(row) + 0.5) / 400.0).collect();
        let values: Vec<f64> = (0..100_u32).map(|step| 0.2 * f64::from(step)).collect();
        let wave = |turns: f64| -> Vec<f64> {
            places.iter().map(|place| libm::sin(TAU * turns * (place - 0.5))).collect()
        };
        let looks = Looks::at_places(1.0).over(&values[20..], |turns| unit(wave(turns)));
        let expected = 1.0 + TAU / 12.0_f64.sqrt() * 15.8 * 5.0 / TAU.sqrt();
        let said = looks.for_gain(25.0);
        assert!((said / expected - 1.0).abs() < 0.05, "{said}, expected {expected}");
        // Of 60 gaps between 0.45 and 0.6 each is a place of its own.
        let step = |at: f64| places.iter().map(move |place| if *place < at { -1.0 } else { 1.0 });
        let values: Vec<f64> = (0..=10_u32).map(|i| 0.45 + 0.015 * f64::from(i)).collect();
        let looks = Looks::at_places(1.0).over(&values, |at| unit(step(at).collect()));
        let one = libm::asin((1.0_f64 - (1.0 - 2.0 / 400.0) * (1.0 - 2.0 / 400.0)).sqrt());
        let each = libm::erf(10.0 * libm::tan(0.5 * one) * FRAC_1_SQRT_2);
        let said = looks.for_gain(100.0);
        assert!((said / (1.0 + 60.0 * each) - 1.0).abs() < 0.1, "{said}, each {each}");
    }

    #[test]
    fn listed_places_and_arcs_multiply() {
        let looks = Looks::at_places(3.0).along(1.0).times(2.0);
        assert!((looks.for_gain(TAU) - 12.0).abs() < 1e-12);
        assert!((looks.for_gain(-1.0) - 6.0).abs() < 1e-12);
    }

    #[test]
    fn the_angle_of_two_spaces_is_the_mean_over_both() {
        let (s, c) = libm::sincos(0.4);
        let plane = |tilt: [f64; 2]| vec![vec![1.0, 0.0, 0.0], vec![0.0, tilt[1], tilt[0]]];
        let apart = angle(&plane([0.0, 1.0]), &plane([s, c]));
        assert!((libm::sin(apart) - s / 2.0_f64.sqrt()).abs() < 1e-12);
        assert!(angle(&[], &plane([0.0, 1.0])).abs() < 1e-12);
    }
}
