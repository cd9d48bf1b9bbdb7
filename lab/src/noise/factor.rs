//! One row after the other of the Cholesky factor of a block: a Kalman filter's covariances.

use std::array::from_fn;

use super::Noise;
use crate::numerics::count;

/// Change of a gain from one row to the next below which it has settled.
const SETTLED: f64 = 1e-12;

/// Share of a deviation below which the filter knows nothing better.
const FLOOR: f64 = 1e-12;

/// Part of a length by which the decays of two lanes may differ and still be worked out together.
const NEAR: f64 = 3e-3;

/// One value a lane.
pub(super) type Lanes<const L: usize> = [f64; L];

/// The filters of `P` slow parts at one row, for `L` noises side by side.
#[derive(Debug)]
pub(super) struct Factor<const P: usize, const L: usize> {
    noise: Shapes<P, L>,
    /// Upper triangle of the covariance of the slow parts before the row is seen.
    covariance: [[Lanes<L>; P]; P],
    /// Sums of its lines.
    seen: [Lanes<L>; P],
    /// What the interval before the row leaves of each slow part.
    pub(super) decay: [Lanes<L>; P],
    /// Share of an innovation that goes to each slow part.
    pub(super) gain: [Lanes<L>; P],
    /// Variance of the innovation, and one over it.
    pub(super) pivot: Lanes<L>,
    pub(super) weight: Lanes<L>,
    interval: f64,
    inflation: f64,
    settled: bool,
}

/// The noises, part by part.
#[derive(Debug)]
struct Shapes<const P: usize, const L: usize> {
    white: Lanes<L>,
    floor: Lanes<L>,
    variance: [Lanes<L>; P],
    /// One over the lengths, and that of the first lane less that of each.
    rate: [Lanes<L>; P],
    apart: [Lanes<L>; P],
}

impl<const P: usize, const L: usize> Shapes<P, L> {
    fn new(noises: [&Noise; L]) -> Self {
        let of = |part: usize, value: fn(&super::SlowPart) -> f64| {
            noises.map(|noise| noise.slow.get(part).map_or(0.0, value))
        };
        let rate: [Lanes<L>; P] = from_fn(|part| of(part, |slow| 1.0 / slow.length));
        Self {
            white: noises.map(|noise| noise.white),
            floor: noises.map(|noise| FLOOR * noise.variance()),
            variance: from_fn(|part| of(part, |slow| slow.variance)),
            apart: rate.map(|rates| rates.map(|rate| rates[0] - rate)),
            rate,
        }
    }
}

impl<const P: usize, const L: usize> Factor<P, L> {
    /// At the first row of a block, where nothing is known.
    pub(super) fn new(noises: [&Noise; L], inflation: f64) -> Self {
        let nothing = [[0.0; L]; P];
        let mut first = Self {
            noise: Shapes::new(noises),
            covariance: [nothing; P],
            seen: nothing,
            decay: nothing,
            gain: nothing,
            pivot: [0.0; L],
            weight: [0.0; L],
            interval: f64::NAN,
            inflation,
            settled: false,
        };
        for part in 0..P {
            first.covariance[part][part] = first.noise.variance[part];
        }
        first.see();
        first
    }

    /// True when a row that comes after such an interval changes nothing any more.
    #[inline]
    pub(super) fn stays(&self, interval: f64, inflation: f64) -> bool {
        self.settled && self.as_before(interval, inflation)
    }

    /// Goes to the next row.
    #[inline]
    pub(super) fn advance(&mut self, interval: f64, inflation: f64) {
        let as_before = self.as_before(interval, inflation);
        if !self.same(interval) {
            self.interval = interval;
            self.over(interval.max(0.0));
        }
        self.inflation = inflation;
        self.foresee();
        if !as_before {
            self.see();
            self.settled = false;
            return;
        }
        let (pivot, gain) = (self.pivot, self.gain);
        self.see();
        self.settled = self.near(&pivot, &gain);
    }

    #[inline]
    fn as_before(&self, interval: f64, inflation: f64) -> bool {
        self.same(interval) && inflation.to_bits() == self.inflation.to_bits()
    }

    #[inline]
    fn same(&self, interval: f64) -> bool {
        (interval - self.interval).abs() <= 1e-9 * interval.abs()
    }

    /// Decay over an interval; evenly sampled data need one exponential a part in all.
    #[inline]
    fn over(&mut self, interval: f64) {
        for part in 0..P {
            let first = libm::exp(-interval * self.noise.rate[part][0]);
            let mut near = true;
            for lane in 0..L {
                let more = interval * self.noise.apart[part][lane];
                near &= more.abs() < NEAR;
                self.decay[part][lane] = first
                    * (1.0 + more * (1.0 + more / 2.0 * (1.0 + more / 3.0 * (1.0 + more / 4.0))));
            }
            // Lanes are near in nearly all searches: without a branch for each they go side by side.
            if !near {
                self.one_by_one(part, interval);
            }
        }
    }

    /// The decays of a part whose lanes are not all near the first.
    #[cold]
    fn one_by_one(&mut self, part: usize, interval: f64) {
        for lane in 0..L {
            if NEAR <= (interval * self.noise.apart[part][lane]).abs() {
                self.decay[part][lane] = libm::exp(-interval * self.noise.rate[part][lane]);
            }
        }
    }

    #[inline]
    fn foresee(&mut self) {
        for i in 0..P {
            for j in i..P {
                for lane in 0..L {
                    let left =
                        self.covariance[i][j][lane] - self.seen[i][lane] * self.gain[j][lane];
                    self.covariance[i][j][lane] = self.decay[i][lane] * self.decay[j][lane] * left;
                }
            }
            for lane in 0..L {
                let kept = self.decay[i][lane] * self.decay[i][lane];
                self.covariance[i][i][lane] += self.noise.variance[i][lane] * (1.0 - kept);
            }
        }
    }

    #[inline]
    fn see(&mut self) {
        for lane in 0..L {
            self.pivot[lane] = self.noise.white[lane] * self.inflation;
        }
        for i in 0..P {
            self.seen[i] = [0.0; L];
            for j in 0..P {
                for lane in 0..L {
                    self.seen[i][lane] += self.covariance[i.min(j)][i.max(j)][lane];
                }
            }
            for lane in 0..L {
                self.pivot[lane] += self.seen[i][lane];
            }
        }
        for lane in 0..L {
            let floor = self.noise.floor[lane];
            self.pivot[lane] = if self.pivot[lane] < floor { floor } else { self.pivot[lane] };
            self.weight[lane] = 1.0 / self.pivot[lane];
        }
        for part in 0..P {
            for lane in 0..L {
                self.gain[part][lane] = self.seen[part][lane] * self.weight[lane];
            }
        }
    }

    #[inline]
    fn near(&self, pivot: &Lanes<L>, gain: &[Lanes<L>; P]) -> bool {
        let near = |now: f64, before: f64, size: f64| (now - before).abs() <= SETTLED * size;
        (0..L).all(|lane| {
            near(self.pivot[lane], pivot[lane], pivot[lane])
                && (0..P).all(|part| near(self.gain[part][lane], gain[part][lane], 1.0))
        })
    }
}

/// Rows after which a product of pivots is looked at, lest it leaves the range.
const ROWS_A_LOOK: usize = 8;

/// A product of many pivots as a logarithm, which is taken once for many of them.
#[derive(Debug)]
pub(super) struct Pivots<const L: usize> {
    product: Lanes<L>,
    logarithm: Lanes<L>,
}

impl<const L: usize> Pivots<L> {
    pub(super) fn new() -> Self {
        Self { product: [1.0; L], logarithm: [0.0; L] }
    }

    #[inline]
    pub(super) fn times(&mut self, pivots: &Lanes<L>, row: usize) {
        for (product, pivot) in self.product.iter_mut().zip(pivots) {
            *product *= pivot;
        }
        let out = |product: &f64| !(1e-100..1e100).contains(product);
        if row.is_multiple_of(ROWS_A_LOOK) && self.product.iter().any(out) {
            self.logarithm = self.logarithm();
            self.product = [1.0; L];
        }
    }

    pub(super) fn times_often(&mut self, pivots: &Lanes<L>, times: usize) {
        for (logarithm, pivot) in self.logarithm.iter_mut().zip(pivots) {
            *logarithm += count(times) * libm::log(*pivot);
        }
    }

    pub(super) fn logarithm(&self) -> Lanes<L> {
        from_fn(|lane| self.logarithm[lane] + libm::log(self.product[lane]))
    }
}
