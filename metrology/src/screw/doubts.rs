//! What readings say of the noise that is told of them: wild ones, noise that neighbours share, a coarse display.
//!
//! Each reading is set against the cubic through its two neighbours on either side, which takes nearly all of
//! a screw away and nothing of noise that is new at every reading. What is left may be larger than such noise
//! would make it, by the screw's own roughness, and not smaller.

use super::Curve;
use crate::number::number;

/// What is wrong with readings for noise that is new at each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// Neighbours differ less than they would: they share their noise, or it is smaller than was told.
    Steadier {
        /// Standard deviation that their differences show, µm.
        found_um: f64,
    },
    /// All are whole steps of a display, and noise does not carry them from one to the next.
    Coarse {
        /// The step, µm.
        step_um: f64,
    },
}

/// Neighbours that a reading is held against: two on either side.
const AROUND: usize = 2;
/// Median steps that a reading and its neighbours may span; beyond is a gap. Chosen: twice what they do.
const LONGEST_STEPS: f64 = 8.0;
/// Wild readings expected of a record that has none.
const EXPECTED_WILD: f64 = 0.01;
/// Rounds in which wild readings are looked for: some hide others.
const ROUNDS: usize = 8;
/// Share of the noise told below which neighbours share it. Chosen: noise told a quarter too large does no
/// harm; where half of a reading's noise is its neighbour's, they show 0.61 of it.
const LEAST_SHARE: f64 = 0.7;
/// Standard deviation of that share times the root of the readings, as drawn; two and a half of them count.
const OF_SHARE: f64 = 2.5;
/// Least noise, in steps of a display, that is as new at each reading as it was. Chosen: rounding alone is 0.29,
/// and noise of 0.3 steps with it 0.42.
const LEAST_OF_STEP: f64 = 0.35;
/// Part of a step by which a reading may be off a whole number of them: rounding.
const OFF_STEP: f64 = 1e-3;
/// Median size of a normal number.
const MEDIAN_SIZE: f64 = 0.674_49;

/// What is wrong with all readings for such noise, if there is any and anything is.
#[must_use]
pub fn doubt(curve: &Curve, noise_um: f64) -> Option<Doubt> {
    if noise_um.is_nan() || noise_um <= 0.0 {
        return None;
    }
    if let Some(step_um) = display_um(curve).filter(|step_um| noise_um < LEAST_OF_STEP * step_um) {
        return Some(Doubt::Coarse { step_um });
    }
    let off = Off::of(curve, noise_um);
    let share = off.share()?;
    let least = LEAST_SHARE - OF_SHARE / number(off.known().count()).sqrt();
    (share < least).then_some(Doubt::Steadier { found_um: share * noise_um })
}

/// The curve without the readings that are wild, and the places of these, mm.
#[must_use]
pub fn without_wild(curve: &Curve, noise_um: f64) -> (Curve, Vec<f64>) {
    let (mut curve, mut wild_mm) = (curve.clone(), Vec::new());
    let rounds = if 0.0 < noise_um { ROUNDS } else { 0 };
    for _ in 0..rounds {
        let wild = Off::of(&curve, noise_um).wild();
        let Some(rest) = curve.without(&wild).filter(|_| !wild.is_empty()) else { break };
        wild_mm.extend(wild.iter().map(|row| curve.travel_mm()[*row]));
        curve = rest;
    }
    wild_mm.sort_by(f64::total_cmp);
    (curve, wild_mm)
}

/// The step of the display, µm: the least difference of two readings, where all differ by whole ones.
fn display_um(curve: &Curve) -> Option<f64> {
    let mut sorted = curve.deviation_um().to_vec();
    sorted.sort_by(f64::total_cmp);
    let largest = sorted.last()?.abs().max(sorted.first()?.abs());
    let steps =
        || sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|um| 1e-9 * largest < *um);
    let step_um = steps().min_by(f64::total_cmp)?;
    let whole = |um: f64| (um / step_um - (um / step_um).round()).abs() < OFF_STEP;
    steps().all(whole).then_some(step_um)
}

/// What each reading is off its neighbours.
struct Off {
    /// Off, in standard deviations that noise alone would make; and by how much every reading about it counts
    /// for that. None at ends and gaps.
    each: Vec<Option<(f64, [f64; 2 * AROUND + 1])>>,
}

impl Off {
    fn of(curve: &Curve, noise_um: f64) -> Self {
        let (travel, deviation) = (curve.travel_mm(), curve.deviation_um());
        let longest_mm = LONGEST_STEPS * curve.median_step_mm();
        let one = |row: usize| {
            let first = row.checked_sub(AROUND)?;
            let around = travel.get(first..=row + AROUND)?;
            let apart = around.windows(2).all(|pair| pair[0] < pair[1]);
            if !apart || longest_mm < around[2 * AROUND] - around[0] {
                return None;
            }
            let weights = against_cubic(around);
            let values = weights.iter().zip(&deviation[first..]);
            let off_um: f64 = values.map(|(weight, um)| weight * um).sum();
            Some((off_um / noise_um, weights))
        };
        Self { each: (0..travel.len()).map(one).collect() }
    }

    fn known(&self) -> impl Iterator<Item = f64> {
        self.each.iter().flatten().map(|(off, _)| off.abs())
    }

    /// What they are off, in units of what noise makes: by their median, which wild ones do not move.
    fn share(&self) -> Option<f64> {
        let mut sizes: Vec<f64> = self.known().collect();
        let middle = sizes.len() / 2;
        (!sizes.is_empty())
            .then(|| *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 / MEDIAN_SIZE)
    }

    /// Readings farther off than noise and the screw's own roughness make any, that stand alone.
    fn wild(&self) -> Vec<usize> {
        let expected = |off: f64| number(self.each.len()) * libm::erfc(off / 2.0_f64.sqrt());
        let Some(share) = self.share().map(|share| share.max(1.0)) else { return Vec::new() };
        let size =
            |row: usize| self.each.get(row).copied().flatten().map_or(0.0, |one| one.0.abs());
        let is_wild = |row: &usize| {
            let near = row.saturating_sub(AROUND)..=row + AROUND;
            expected(size(*row) / share) < EXPECTED_WILD
                && near.clone().all(|other| size(other) <= size(*row))
                && self.stands_alone(*row)
        };
        (0..self.each.len()).filter(is_wild).collect()
    }

    /// True when one reading off explains more than a step before it or behind it.
    fn stands_alone(&self, row: usize) -> bool {
        let alone = self.gain(row, |other| other == row);
        let steps = [row, row + 1].map(|from| self.gain(row, |other| from <= other));
        steps.iter().all(|step| *step < alone)
    }

    /// What some readings off by the same explain of what is about one.
    fn gain(&self, row: usize, is_off: impl Fn(usize) -> bool) -> f64 {
        let (mut along, mut squares) = (0.0, 0.0);
        for at in row.saturating_sub(AROUND + 1)..=row + AROUND + 1 {
            let Some((off, weights)) = self.each.get(at).copied().flatten() else { continue };
            let first = at - AROUND;
            let seen: f64 = weights
                .iter()
                .enumerate()
                .map(|(place, weight)| if is_off(first + place) { *weight } else { 0.0 })
                .sum();
            (along, squares) = (along + off * seen, squares + seen * seen);
        }
        if 0.0 < squares { along * along / squares } else { 0.0 }
    }
}

/// By how much each of five readings counts for what the middle one is off the cubic through the others, its
/// variance that of one.
fn against_cubic(travel_mm: &[f64]) -> [f64; 2 * AROUND + 1] {
    let others =
        |without: usize| (0..travel_mm.len()).filter(move |k| *k != AROUND && *k != without);
    let weight = |place: usize| {
        let part =
            |k: usize| (travel_mm[AROUND] - travel_mm[k]) / (travel_mm[place] - travel_mm[k]);
        if place == AROUND { 1.0 } else { -others(place).map(part).product::<f64>() }
    };
    let weights: [f64; 2 * AROUND + 1] = std::array::from_fn(weight);
    let size = weights.iter().map(|weight| weight * weight).sum::<f64>().sqrt();
    weights.map(|weight| weight / size)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::drawn::normal;

    /// Waves, a step of 1.5 µm, and noise of 0.25 µm, each reading with a share of its neighbour's.
    fn readings(shared: f64) -> Curve {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut noise = normal(&mut random);
        let travel_mm: Vec<f64> = (0..=800).map(|k| 0.75 * f64::from(k)).collect();
        let deviation = |x: &f64| {
            noise = shared * noise + (1.0 - shared * shared).sqrt() * normal(&mut random);
            let step = if *x < 311.0 { 0.0 } else { 1.5 };
            3.0 * libm::sin(TAU * x / 470.0) + 0.8 * libm::sin(TAU * x / 6.0) + step + 0.25 * noise
        };
        let deviation_um: Vec<f64> = travel_mm.iter().map(deviation).collect();
        Curve::new(&travel_mm, &deviation_um).expect("a curve")
    }

    #[test]
    fn wild_readings_are_found_and_a_step_is_none() {
        let curve = readings(0.0);
        assert_eq!(without_wild(&curve, 0.25).1, [0.0; 0]);
        assert_eq!(without_wild(&curve, 0.05).1, [0.0; 0]);
        let mut row = 0;
        let spoilt = curve.changed(|um| {
            row += 1;
            um + if row == 201 || row == 211 { 3.0 } else { 0.0 }
        });
        let (rest, wild_mm) = without_wild(&spoilt, 0.25);
        assert_eq!(wild_mm, [150.0, 157.5]);
        assert_eq!(rest.travel_mm().len(), 799);
    }

    /// Noise that is seven tenths its neighbour's made a V2π of 2.09 ± 0.15 of 1.72.
    #[test]
    fn noise_of_neighbours_and_coarse_displays_are_doubted() {
        assert_eq!(doubt(&readings(0.0), 0.25), None);
        assert_eq!(doubt(&readings(0.0), 0.3), None);
        let found = doubt(&readings(0.7), 0.25);
        assert!(
            matches!(found, Some(Doubt::Steadier { found_um }) if found_um < 0.16),
            "{found:?}"
        );
        let coarse = readings(0.0).changed(|um| um.round());
        assert_eq!(doubt(&coarse, 0.3), Some(Doubt::Coarse { step_um: 1.0 }));
        assert_eq!(doubt(&coarse, 0.38), None);
    }
}
