//! A real stage seen by real fringes: what one evening shows, another evening must hold.

use std::f64::consts::TAU;
use std::path::Path;

use helixlock_import::{Recipe, Source, propose};
use helixlock_traces::Table;

/// Period that the records have in common, mm: 5.1 million microsteps.
const PERIODS_MM: std::ops::RangeInclusive<u32> = 930..=990;

/// The table that one of the records becomes by the example's recipe.
fn imported(name: &str) -> Table {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/real-stage-fringes");
    let bytes = std::fs::read(folder.join(name).with_extension("txt")).expect("the record");
    let recipe = std::fs::read_to_string(folder.join("fringes.toml")).expect("the recipe");
    let given = Recipe::parse(&recipe, "fringes.toml").expect("a recipe");
    let proposal = propose(&[Source { name, bytes: &bytes }], &given);
    let proposal = proposal.unwrap_or_else(|error| panic!("{error}"));
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    proposal.table
}

/// Least squares by normal equations: coefficients, and what is left, rms, weighed by `weight`.
fn fitted(columns: &[Vec<f64>], values: &[f64], weight: &[f64]) -> (Vec<f64>, f64) {
    let width = columns.len();
    let dot = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).zip(weight).map(|((a, b), weight)| weight * a * b).sum()
    };
    let mut rows: Vec<Vec<f64>> = (0..width)
        .map(|i| {
            let own = (0..width).map(|j| dot(&columns[i], &columns[j]));
            own.chain([dot(&columns[i], values)]).collect()
        })
        .collect();
    for pivot in 0..width {
        for other in 0..width {
            if other != pivot {
                let factor = rows[other][pivot] / rows[pivot][pivot];
                let from = rows[pivot].clone();
                rows[other].iter_mut().zip(from).for_each(|(to, from)| *to -= factor * from);
            }
        }
    }
    let found: Vec<f64> = (0..width).map(|row| rows[row][width] / rows[row][row]).collect();
    let left: Vec<f64> = (0..values.len())
        .map(|row| values[row] - (0..width).map(|at| found[at] * columns[at][row]).sum::<f64>())
        .collect();
    (found, (dot(&left, &left) / weight.iter().sum::<f64>()).sqrt())
}

/// A record with the smooth curve of its stage: a cubic.
struct Record {
    position_mm: Vec<f64>,
    error_um: Vec<f64>,
    weight: Vec<f64>,
    curve: Vec<Vec<f64>>,
}

impl Record {
    fn of(table: &Table) -> Self {
        let column = |name: &str| table.require(name).expect(name).to_vec();
        let position_mm = column("position_mm");
        let (low, high) = position_mm
            .iter()
            .fold((f64::MAX, f64::MIN), |(low, high), at| (low.min(*at), high.max(*at)));
        let power = |n: i32| position_mm.iter().map(move |at| ((at - low) / (high - low)).powi(n));
        let curve = (0..4).map(|n| power(n).collect()).collect();
        let deviation = column("error_um_sd");
        // What the stage does beside is not in the deviation of a row.
        let weight = deviation.iter().map(|sd| 1.0 / (sd * sd + 0.01 * 0.01)).collect();
        Self { error_um: column("error_um"), position_mm, weight, curve }
    }

    /// Sines and cosines once and twice in a period.
    fn waves(&self, period_mm: f64, zero_mm: f64) -> [Vec<f64>; 4] {
        let angle = |times: f64, at: &f64| times * TAU * (at - zero_mm) / period_mm;
        let of = |wave: fn(f64) -> f64, times: f64| {
            self.position_mm.iter().map(|at| wave(angle(times, at))).collect()
        };
        [of(libm::sin, 1.0), of(libm::cos, 1.0), of(libm::sin, 2.0), of(libm::cos, 2.0)]
    }

    /// Coefficients of the waves, and what is left.
    fn own(&self, period_mm: f64) -> ([f64; 4], f64) {
        let columns = [self.curve.clone(), self.waves(period_mm, 0.0).into()].concat();
        let (found, left) = fitted(&columns, &self.error_um, &self.weight);
        ([found[4], found[5], found[6], found[7]], left)
    }

    /// What is left with the waves of another record, the zero of the position free.
    fn frozen(&self, period_mm: f64, coefficients: [f64; 4]) -> f64 {
        let with_zero = |zero_mm: f64| {
            let waves = self.waves(period_mm, zero_mm);
            let rest: Vec<f64> = (0..self.error_um.len())
                .map(|row| {
                    let wave: f64 = coefficients.iter().zip(&waves).map(|(c, w)| c * w[row]).sum();
                    self.error_um[row] - wave
                })
                .collect();
            fitted(&self.curve, &rest, &self.weight).1
        };
        (0..72).map(|n| with_zero(period_mm * f64::from(n) / 72.0)).fold(f64::MAX, f64::min)
    }

    /// The period by which the waves leave least.
    fn period_mm(&self) -> f64 {
        let periods = PERIODS_MM.map(|n| f64::from(n) * 1e-4);
        let best = |one: &f64, other: &f64| self.own(*one).1.total_cmp(&self.own(*other).1);
        periods.min_by(best).expect("a period")
    }
}

#[test]
fn what_one_evening_shows_another_evening_holds() {
    let tables = ["first", "second"].map(imported);
    for table in &tables {
        assert!(3900 < table.rows(), "{} fringes", table.rows());
    }
    let [first, second] = tables.each_ref().map(Record::of);
    let (waves, left) = first.own(first.period_mm());
    // A fit made apart from this project, over a longer way: 0.111 µm.
    let amplitude_um = libm::hypot(waves[0], waves[1]);
    assert!((0.09..0.14).contains(&amplitude_um) && left < 0.08, "{amplitude_um} {left}");
    for (from, onto) in [(&first, &second), (&second, &first)] {
        let period_mm = from.period_mm();
        let (waves, _) = from.own(period_mm);
        let (own, frozen) = (onto.own(period_mm).1, onto.frozen(period_mm, waves));
        assert!(frozen <= 1.25 * own, "frozen {frozen}, own {own}");
    }
}
