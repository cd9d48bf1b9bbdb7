//! What a curve may have beside what every curve has: where it is, and the columns that it has in a model.

use std::f64::consts::TAU;

use super::{A_PAIR, Readings};

/// Waves tried, for one that can be told from its neighbour over the travel.
pub(super) const WAVES_A_CYCLE: f64 = 2.0;
/// Widths of a bump beyond which nothing of it is left.
const REACH: f64 = 5.0;
/// How much of another shape than a bell a burst may have, as a part of its size. Chosen: a cosine's half wave, which
/// begins and ends at once, is off the bell nearest to it by a twentieth. Tripled: at much noise noise is taken for it.
const ANOTHER_SHAPE: f64 = 0.1;
/// How steep a kink may be: as what bends by the size of the whole curve within a sixteenth of the travel. Chosen; more is
/// a step.
const KINK_WITHIN: f64 = 1.0 / 16.0;

/// What a curve may have beside a cubic, waves of a turn, and what bends by chance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feature {
    /// From a place on.
    Step(f64),
    /// A slope from a place on.
    Kink(f64),
    /// A wave of a turn whose sizes change by chance, so strongly.
    Wandering(f64),
    /// So many over the travel, and a phase; with one that grows evenly beside it, as a wave of a length a little
    /// off does.
    Wave(f64, f64),
    /// So many over the travel, whose size grows.
    Growing(f64),
    /// A place and a width; with its first two derivatives, as bumps have that are a little off in either, or of
    /// another shape.
    Bump(f64, f64),
    /// A wave of a turn whose size and phase swell so many times over the travel.
    Swelling(f64),
    /// A wave of a turn within a bump at a place, with a width; with its change by the width, and a little of another
    /// shape, steeper at its flanks.
    Burst(f64, f64),
}

impl Feature {
    /// Those about it that are looked at closely, nearer at each halving; a step's and a kink's are all asked.
    pub(super) fn neighbours(self, halving: i32) -> Vec<Self> {
        let step = libm::ldexp(1.0, -halving);
        match self {
            Self::Step(_) | Self::Kink(_) | Self::Growing(_) | Self::Wandering(_) => Vec::new(),
            Self::Wave(waves, phase) => {
                [-step, step].map(|more| Self::Wave(waves + more / WAVES_A_CYCLE, phase)).to_vec()
            }
            Self::Swelling(swells) => {
                [-step, step].map(|more| Self::Swelling(swells + more / WAVES_A_CYCLE)).to_vec()
            }
            Self::Bump(at, width) => {
                about(at, width, step).map(|(at, width)| Self::Bump(at, width)).to_vec()
            }
            Self::Burst(at, width) => {
                about(at, width, step).map(|(at, width)| Self::Burst(at, width)).to_vec()
            }
        }
    }

    /// How many of its columns are asked where it lies: the others are there for what it is beside that.
    pub(super) fn telling(self) -> usize {
        if let Self::Swelling(..) = self { 4 } else { 2 }
    }

    /// What it is at the places of readings.
    pub(super) fn columns(self, readings: &Readings) -> Vec<Vec<f64>> {
        let places = &readings.places;
        let column =
            |value: &dyn Fn(f64) -> f64| places.iter().map(|place| value(*place)).collect();
        match self {
            Self::Step(at) => vec![column(&|place| f64::from(u8::from(at <= place)))],
            Self::Kink(at) => vec![column(&|place| (place - at).max(0.0) / KINK_WITHIN)],
            Self::Wandering(_) => Vec::new(),
            Self::Swelling(swells) => {
                let angle = |place: f64| TAU * swells * (place - 0.5);
                let sizes = [libm::cos, libm::sin]
                    .map(|part: fn(f64) -> f64| column(&|place| part(angle(place))));
                readings.waves_of_a_turn(&sizes)
            }
            Self::Burst(at, width) => {
                readings.waves_of_a_turn(&bells((at, width), places, [even, wider, steeper]))
            }
            Self::Bump(at, width) => bells((at, width), places, [even, along, wider]),
            Self::Wave(waves, phase) => {
                let angle = |place: f64| TAU * waves * (place - 0.5) - phase;
                vec![
                    column(&|place| libm::cos(angle(place))),
                    column(&|place| libm::sin(angle(place))),
                    column(&|place| 2.0 * (place - 0.5) * libm::sin(angle(place))),
                ]
            }
            Self::Growing(waves) => {
                let grows = |place: f64| 2.0 * (place - 0.5);
                let angle = |place: f64| TAU * waves * (place - 0.5);
                let mut columns = Self::Wave(waves, 0.0).columns(readings);
                columns.push(column(&|place| grows(place) * libm::cos(angle(place))));
                columns
            }
        }
    }
}

impl Readings {
    /// Cosine and sine of a turn, each of these sizes.
    fn waves_of_a_turn(&self, sizes: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let parts = &self.columns[self.every..][..A_PAIR];
        let of_size = |size: &Vec<f64>| {
            let each = parts.iter().map(|part| part.iter().zip(size).map(|(one, size)| one * size));
            each.map(Iterator::collect).collect::<Vec<Vec<f64>>>()
        };
        sizes.iter().flat_map(of_size).collect()
    }
}

/// Places and widths about those of a bump, by a part of its width.
fn about(at: f64, width: f64, part: f64) -> [(f64, f64); 4] {
    let wider = libm::exp2(part);
    [
        (at - part * width, width),
        (at + part * width, width),
        (at, width / wider),
        (at, width * wider),
    ]
}

/// A bell at a place, with a width, times what each of these is so many widths off.
fn bells<const N: usize>(
    (at, width): (f64, f64),
    places: &[f64],
    times: [fn(f64) -> f64; N],
) -> Vec<Vec<f64>> {
    let bell = |off: f64| if off.abs() < REACH { libm::exp(-0.5 * off * off) } else { 0.0 };
    let offs = places.iter().map(|place| (place - at) / width);
    let bells: Vec<(f64, f64)> = offs.map(|off| (off, bell(off))).collect();
    let one = |times: fn(f64) -> f64| bells.iter().map(|(off, bell)| times(*off) * bell).collect();
    times.map(one).to_vec()
}

fn even(_: f64) -> f64 {
    1.0
}

fn along(off: f64) -> f64 {
    off
}

fn wider(off: f64) -> f64 {
    off * off - 1.0
}

/// Hermite's function of the fourth order, as large beside a bell as another shape has it.
fn steeper(off: f64) -> f64 {
    ANOTHER_SHAPE / 24.0_f64.sqrt() * ((off * off - 6.0) * off * off + 3.0)
}
