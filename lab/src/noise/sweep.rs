//! Likelihood of noises in one sweep along the rows, without storing the factor.

use std::array::from_fn;
use std::ops::Range;

use super::factor::{Factor, Lanes, Pivots};
use super::kernel::{Noise, PARTS};
use super::layout::Layout;
use crate::numerics::count;

/// Noises whose likelihood is worked out side by side, in vector registers.
const LANES: usize = 6;

/// Whitened square of a column without its offsets, and log determinant with theirs, under each
/// of some noises that have equally many slow parts.
///
/// The same numbers as from a [`super::Whitener`].
#[must_use]
pub(crate) fn squares_and_log_determinants(
    layout: &Layout,
    noises: &[Noise],
    column: &[f64],
) -> Vec<(f64, f64)> {
    let parts = noises.iter().map(|noise| noise.slow.len()).max().unwrap_or(0);
    let mut all = Vec::with_capacity(noises.len());
    for some in noises.chunks(LANES) {
        // The last one stands in for lanes that nobody needs.
        let last = some.len() - 1;
        let lanes: [&Noise; LANES] = from_fn(|lane| &some[lane.min(last)]);
        let column = Column { layout, values: column };
        let found = match (parts, some.len()) {
            (0, 1) => column.swept::<0, 1>([lanes[0]]).to_vec(),
            (0, _) => column.swept::<0, LANES>(lanes).to_vec(),
            (1, 1) => column.swept::<1, 1>([lanes[0]]).to_vec(),
            (1, 2..=4) => column.swept::<1, 4>([lanes[0], lanes[1], lanes[2], lanes[3]]).to_vec(),
            (1, _) => column.swept::<1, LANES>(lanes).to_vec(),
            (_, 1) => column.swept::<PARTS, 1>([lanes[0]]).to_vec(),
            (_, 2..=4) => {
                column.swept::<PARTS, 4>([lanes[0], lanes[1], lanes[2], lanes[3]]).to_vec()
            }
            (_, _) => column.swept::<PARTS, LANES>(lanes).to_vec(),
        };
        all.extend(found.into_iter().take(some.len()));
    }
    all
}

/// Rows after which the ones are looked at.
const ROWS_A_LOOK: usize = 64;

struct Column<'a> {
    layout: &'a Layout,
    values: &'a [f64],
}

/// Whitened products of a column and of ones, and the log determinant of a block.
struct Sums<const L: usize> {
    square: Lanes<L>,
    product: Lanes<L>,
    ones: Lanes<L>,
    pivots: Pivots<L>,
}

/// Slow parts of a column and of ones as foreseen, and their last innovations.
struct Foreseen<const P: usize, const L: usize> {
    values: [Lanes<L>; P],
    ones: [Lanes<L>; P],
    value: Lanes<L>,
    one: Lanes<L>,
}

impl Column<'_> {
    fn swept<const P: usize, const L: usize>(&self, noises: [&Noise; L]) -> [(f64, f64); L] {
        let mut total = [(0.0, 0.0); L];
        for block in self.layout.blocks.iter().filter(|block| !block.rows.is_empty()) {
            let sums = self.block::<P, L>(&block.rows, noises);
            let logarithms = sums.pivots.logarithm();
            let variance = block.variance();
            let louder = (count(block.rows.len()) - 1.0) * libm::log(variance);
            for (lane, (square, logarithm)) in total.iter_mut().enumerate() {
                let ones = sums.ones[lane].max(f64::MIN_POSITIVE);
                let product = sums.product[lane];
                *square += (sums.square[lane] - product * product / ones) / variance;
                *logarithm += logarithms[lane] + libm::log(ones) + louder;
            }
        }
        total
    }

    fn block<const P: usize, const L: usize>(
        &self,
        rows: &Range<usize>,
        noises: [&Noise; L],
    ) -> Sums<L> {
        let first = rows.start;
        let mut factor = Factor::<P, L>::new(noises, self.layout.inflation[first]);
        let mut state = Foreseen {
            values: [[0.0; L]; P],
            ones: [[0.0; L]; P],
            value: [self.values[first]; L],
            one: [1.0; L],
        };
        let mut sums = Sums::new();
        sums.add(&state, &factor.weight);
        sums.pivots.times(&factor.pivot, 0);
        let mut row = first + 1;
        while row < rows.end {
            let before = factor.gain;
            factor.advance(self.interval(row), self.layout.inflation[row]);
            state.advance(&factor.decay, &before, self.values[row]);
            sums.add(&state, &factor.weight);
            sums.pivots.times(&factor.pivot, row);
            row = self.settled(row + 1..rows.end, &factor, &mut state, &mut sums);
        }
        sums
    }

    #[inline]
    fn interval(&self, row: usize) -> f64 {
        self.layout.clock[row] - self.layout.clock[row - 1]
    }

    /// Rows over which the factor stays as it is; returns the first behind them.
    fn settled<const P: usize, const L: usize>(
        &self,
        rows: Range<usize>,
        factor: &Factor<P, L>,
        state: &mut Foreseen<P, L>,
        sums: &mut Sums<L>,
    ) -> usize {
        let stays = |row: usize| {
            row < rows.end && factor.stays(self.interval(row), self.layout.inflation[row])
        };
        let mut row = rows.start;
        if !stays(row) {
            return row;
        }
        let mut run = Sums::new();
        let mut repeated = false;
        while !repeated && stays(row) {
            let before = (state.ones, state.one);
            state.advance(&factor.decay, &factor.gain, self.values[row]);
            run.add(state, &[1.0; L]);
            row += 1;
            repeated = row.is_multiple_of(ROWS_A_LOOK) && (state.ones, state.one) == before;
        }
        // Ones that are as in the row before stay so: nothing else enters them.
        while stays(row) {
            state.advance_values(&factor.decay, &factor.gain, self.values[row]);
            run.add(state, &[1.0; L]);
            row += 1;
        }
        for lane in 0..L {
            let weight = factor.weight[lane];
            sums.square[lane] += weight * run.square[lane];
            sums.product[lane] += weight * run.product[lane];
            sums.ones[lane] += weight * run.ones[lane];
        }
        sums.pivots.times_often(&factor.pivot, row - rows.start);
        row
    }
}

impl<const L: usize> Sums<L> {
    fn new() -> Self {
        let zero = [0.0; L];
        Self { square: zero, product: zero, ones: zero, pivots: Pivots::new() }
    }

    #[inline]
    fn add<const P: usize>(&mut self, state: &Foreseen<P, L>, weight: &Lanes<L>) {
        for (lane, weight) in weight.iter().enumerate() {
            let (value, one) = (state.value[lane], weight * state.one[lane]);
            self.square[lane] += weight * value * value;
            self.product[lane] += one * value;
            self.ones[lane] += one * state.one[lane];
        }
    }
}

impl<const P: usize, const L: usize> Foreseen<P, L> {
    #[inline]
    fn advance(&mut self, decay: &[Lanes<L>; P], gain: &[Lanes<L>; P], value: f64) {
        self.one = next(&mut self.ones, [decay, gain], &self.one, 1.0);
        self.advance_values(decay, gain, value);
    }

    #[inline]
    fn advance_values(&mut self, decay: &[Lanes<L>; P], gain: &[Lanes<L>; P], value: f64) {
        self.value = next(&mut self.values, [decay, gain], &self.value, value);
    }
}

/// Foresees slow parts by the last innovation, and returns that of a value.
#[inline]
fn next<const P: usize, const L: usize>(
    foreseen: &mut [Lanes<L>; P],
    [decay, gain]: [&[Lanes<L>; P]; 2],
    last: &Lanes<L>,
    value: f64,
) -> Lanes<L> {
    let mut now = [value; L];
    for part in 0..P {
        for lane in 0..L {
            let carried = decay[part][lane] * gain[part][lane];
            foreseen[part][lane] = decay[part][lane] * foreseen[part][lane] + carried * last[lane];
            now[lane] -= foreseen[part][lane];
        }
    }
    now
}
