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

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, TAU};

use crate::model::{Columns, Stage};
use crate::numerics::count;

/// Where an effect was looked for.
#[derive(Debug, Clone)]
pub(crate) struct Looks {
    /// Listed values.
    places: f64,
    /// What the curve turns by along each continuous parameter, rad.
    arcs: Vec<f64>,
    /// Instants between samples, and what the curve turns by from one to the next, here and there.
    instants: f64,
    turns: Vec<f64>,
}

impl Looks {
    /// So many places, none of them continuous.
    #[must_use]
    pub(crate) fn at_places(places: f64) -> Self {
        Self { places, arcs: Vec::new(), instants: 0.0, turns: Vec::new() }
    }

    /// The same with one more continuous parameter.
    #[must_use]
    pub(crate) fn along(mut self, arc: f64) -> Self {
        self.arcs.push(arc);
        self
    }

    /// The same, so many times.
    #[must_use]
    pub(crate) fn times(mut self, factor: f64) -> Self {
        self.places *= factor;
        self
    }

    /// The same at every one of some instants, at each of which the curve may jump; `turns` are the
    /// angles from one to the next, rad, at some of them.
    #[must_use]
    pub(crate) fn at_instants(self, instants: f64, turns: Vec<f64>) -> Self {
        Self { instants, turns, ..self }
    }

    /// Independent places for a gain.
    #[must_use]
    pub(crate) fn for_gain(&self, gain: f64) -> f64 {
        let deviations = gain.max(0.0).sqrt();
        let along = |arc: &f64| 1.0 + arc * deviations / TAU.sqrt();
        let new = |turn: &f64| libm::erf(deviations * libm::tan(0.5 * turn) * FRAC_1_SQRT_2);
        let new_ones: f64 = self.turns.iter().map(new).sum();
        let instants = 1.0 + self.instants * new_ones / count(self.turns.len().max(1));
        self.arcs.iter().map(along).product::<f64>() * self.places * instants
    }
}

/// What the curve on a grid turns by along one of its axes through a point, rad.
///
/// `lengths` are those of the grid's axes, the last one running fastest.
#[must_use]
pub(crate) fn arc(
    stage: &Stage<'_>,
    on_grid: &[Option<Columns>],
    (lengths, axis): (&[usize], usize),
    point: usize,
) -> f64 {
    let stride: usize = lengths[axis + 1..].iter().product();
    let start = point - point / stride % lengths[axis] * stride;
    let places = (0..lengths[axis]).filter_map(|step| on_grid[start + step * stride].as_ref());
    let spans: Vec<Vec<Vec<f64>>> = places.map(|columns| stage.span(columns)).collect();
    spans.windows(2).map(|pair| angle(&pair[0], &pair[1])).sum()
}

/// Root mean square of the angles between two spaces, given by orthonormal vectors, rad.
#[must_use]
pub(crate) fn angle(one: &[Vec<f64>], other: &[Vec<f64>]) -> f64 {
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
    /// quadrature of `φ(z)·Φ((5 − z·cos θ)/sin θ)` with SciPy.
    #[test]
    fn neighbouring_instants_are_new_as_far_as_they_turn() {
        let shares = [(0.05, 0.1032), (0.3, 0.5667), (0.6, 0.8908), (1.57, 1.0)];
        for (turn, share) in shares {
            let looks = Looks::at_places(1.0).at_instants(1.0, vec![turn]).for_gain(25.0);
            assert!(((looks - 1.0) / share - 1.0).abs() < 0.05, "{turn} rad: {looks}");
        }
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
        assert_eq!(angle(&[], &plane([0.0, 1.0])), 0.0);
    }
}
