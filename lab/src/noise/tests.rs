use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::kernel::PARTS;
use super::sweep::squares_and_log_determinants;
use super::*;
use crate::noise::layout::{Block, Layout};
use crate::numerics::count;
use crate::numerics::least_squares::dot;

fn uneven() -> (Layout, Vec<Noise>) {
    let clock = vec![0.0, 1.0, 1.5, 4.0, 4.0, 7.0, 0.0, 2.0, 2.5, 9.0];
    let mut inflation = vec![1.0; 10];
    inflation[4] = 7.0;
    let blocks = vec![
        Block { sensor: 0, pass: 0, rows: 0..6, loudness: 3 },
        Block { sensor: 1, pass: 0, rows: 6..10, loudness: -1 },
    ];
    let slow =
        vec![SlowPart { variance: 2.0, length: 1.5 }, SlowPart { variance: 0.7, length: 40.0 }];
    let noises = vec![Noise { white: 0.3, slow }, Noise { white: 1.1, slow: vec![] }];
    (Layout { blocks, clock: clock.into(), inflation: inflation.into() }, noises)
}

/// Even sampling with an outlier and a pause.
fn even() -> Layout {
    let rows = 400;
    let clock = (0..rows).map(|i| if i < 300 { i } else { i + 50 }).map(count).collect();
    let mut inflation = vec![1.0; rows];
    inflation[200] = 9.0;
    let blocks = vec![Block { sensor: 0, pass: 0, rows: 0..rows, loudness: 0 }];
    Layout { blocks, clock, inflation: inflation.into() }
}

fn dense(layout: &Layout, noises: &[Noise]) -> DMatrix<f64> {
    let rows = layout.len();
    let mut matrix = DMatrix::zeros(rows, rows);
    for block in &layout.blocks {
        let noise = &noises[block.sensor];
        for i in block.rows.clone() {
            for j in block.rows.clone() {
                let apart = (layout.clock[i] - layout.clock[j]).abs();
                let slow = |p: &SlowPart| p.variance * libm::exp(-apart / p.length);
                matrix[(i, j)] = block.variance() * noise.slow.iter().map(slow).sum::<f64>();
            }
            matrix[(i, i)] += block.variance() * noise.white * layout.inflation[i];
        }
    }
    matrix
}

#[test]
fn products_equal_those_of_the_dense_inverse() {
    let (layout, noises) = uneven();
    let inverse = dense(&layout, &noises).try_inverse().unwrap();
    let whitener = Whitener::new(&layout, &noises);
    let a = DVector::from_fn(10, |i, _| libm::sin(count(i)));
    let b = DVector::from_fn(10, |i, _| libm::cos(count(i * i)));
    let [white_a, white_b] =
        [&a, &b].map(|column| whitener.whiten_only(column.as_slice().to_vec()));
    let semiseparable: f64 = white_a.iter().zip(&white_b).map(|(x, y)| x * y).sum();
    assert!((semiseparable - a.dot(&(&inverse * &b))).abs() < 1e-10);
    let weighted = whitener.unwhiten(&white_a);
    let product: f64 = weighted.iter().zip(b.iter()).map(|(x, y)| x * y).sum();
    assert!((product - semiseparable).abs() < 1e-10);
}

#[test]
fn determinant_equals_the_dense_one_with_the_offsets() {
    let (layout, noises) = uneven();
    let matrix = dense(&layout, &noises);
    let inverse = matrix.clone().try_inverse().unwrap();
    let mut expected = libm::log(matrix.determinant());
    for block in &layout.blocks {
        let ones = DVector::from_fn(10, |i, _| f64::from(u8::from(block.rows.contains(&i))));
        expected += libm::log(ones.dot(&(&inverse * &ones)));
    }
    assert!((Whitener::new(&layout, &noises).log_determinant() - expected).abs() < 1e-10);
}

/// White, one part and two, alone and in lanes; lengths near each other and far apart.
#[test]
fn one_sweep_gives_what_the_stored_factor_gives() {
    let (layout, noises) = uneven();
    for layout in [layout.of_sensor(0).0, even()] {
        let column: Vec<f64> = (0..layout.len()).map(|i| libm::sin(count(7 * i))).collect();
        for parts in 0..=PARTS {
            let mut noise = noises[0].clone();
            noise.slow.truncate(parts);
            let mut many = vec![noise; 8];
            for (lane, noise) in many.iter_mut().enumerate().skip(2) {
                let factor = if lane < 5 { 1.0 + 1e-3 * count(lane) } else { 3.0 };
                noise.slow.iter_mut().for_each(|part| part.length *= factor);
                noise.white *= factor;
            }
            for lanes in [1, 3, 6, 8] {
                let swept = squares_and_log_determinants(&layout, &many[..lanes], &column);
                assert_eq!(swept.len(), lanes);
                for (swept, noise) in swept.iter().zip(&many) {
                    let whitener = Whitener::new(&layout, std::slice::from_ref(noise));
                    let white = whitener.whiten(column.clone());
                    let square: f64 = white.iter().map(|value| value * value).sum();
                    assert!((swept.0 / square - 1.0).abs() < 1e-11, "{swept:?} {square}");
                    let logarithm = whitener.log_determinant();
                    assert!((swept.1 - logarithm).abs() < 1e-9, "{swept:?} {logarithm}");
                }
            }
        }
    }
}

/// Where sampling is even the gains settle; an outlier and a pause unsettle them again.
#[test]
fn settled_gains_give_what_the_dense_covariance_gives() {
    let layout = even();
    let (_, noises) = uneven();
    let inverse = dense(&layout, &noises).try_inverse().unwrap();
    let whitener = Whitener::new(&layout, &noises);
    let columns: Vec<DVector<f64>> =
        (1..16).map(|k| DVector::from_fn(layout.len(), |i, _| libm::sin(count(k * i)))).collect();
    let views: Vec<&[f64]> = columns.iter().map(DVector::as_slice).collect();
    let ones = DVector::from_element(layout.len(), 1.0);
    let weight = ones.dot(&(&inverse * &ones));
    let white = whitener.whiten_all(&views);
    for (i, a) in columns.iter().enumerate() {
        let weighted = &inverse * a;
        for (j, b) in columns.iter().enumerate() {
            let offsets = ones.dot(&weighted) * ones.dot(&(&inverse * b)) / weight;
            let expected = weighted.dot(b) - offsets;
            let product = dot(&white[i], &white[j]);
            assert!((product - expected).abs() < 1e-9, "{i} {j}: {product} {expected}");
        }
    }
}

#[test]
fn noises_are_alike_when_every_number_is() {
    let (_, noises) = uneven();
    assert!(noises[0].is_like(&noises[0].scaled(1.04)));
    assert!(!noises[0].is_like(&noises[0].scaled(1.06)));
    assert!(!noises[0].is_like(&noises[1]));
    let mut longer = noises[0].clone();
    longer.slow[1].length *= 2.0;
    assert!(!noises[0].is_like(&longer));
}

#[test]
fn a_constant_in_a_pass_whitens_to_nothing() {
    let (layout, noises) = uneven();
    let mut column = vec![3.0; 10];
    column[6..].fill(-8.0);
    let white = Whitener::new(&layout, &noises).whiten(column);
    assert!(white.iter().all(|value| value.abs() < 1e-12), "{white:?}");
}

/// Where a fast wave turns its samples lie near their neighbours, and on its flanks far from them: no
/// crest is an outlier for that. Bad readings are, one in ten.
#[test]
fn samples_that_scatter_by_turns_are_no_outliers() {
    let layout = even();
    let wave = |row: usize| if row % 10 < 4 { 1.0 } else { 0.1 } * libm::sin(7.0 * count(row));
    let residual: Vec<f64> = (0..400).map(wave).collect();
    let weighed = outlier_inflation(&layout, &residual, &vec![true; residual.len()], &[0.0]);
    assert!(weighed.iter().all(|by| *by < 1.5), "{weighed:?}");
    let with_bad = |row: usize| if row % 10 == 5 { 30.0 } else { libm::sin(7.0 * count(row)) };
    let residual: Vec<f64> = (0..400).map(with_bad).collect();
    let weighed = outlier_inflation(&layout, &residual, &vec![true; residual.len()], &[0.0]);
    assert!((0..40).all(|nth| 20.0 < weighed[10 * nth + 5]), "{weighed:?}");
}

/// A display that hardly moves from row to row, and one reading in fifty that is wild: steps of one digit are no
/// outliers, though most rows are the median of their neighbours.
#[test]
fn wild_readings_of_a_coarse_display_are_outliers() {
    let layout = even();
    let digits = |row: usize| f64::from(u8::from(row % 13 == 6)) + (count(row) / 40.0).floor();
    let shown = |row: usize| if row % 50 == 25 { 300.0 } else { digits(row) };
    let residual: Vec<f64> = (0..400).map(shown).collect();
    let weighed = outlier_inflation(&layout, &residual, &vec![true; residual.len()], &[0.0]);
    let wild = weighed.iter().filter(|by| 100.0 < **by).count();
    let usual = weighed.iter().filter(|by| **by < 1.5).count();
    assert_eq!((wild, usual), (8, 392), "{weighed:?}");
}

/// Twelve deviations off, alone and in a knock of three rows: what stands in several rows weighs as much as an outlier
/// of three deviations does.
#[test]
fn a_wild_reading_weighs_less_than_a_knock() {
    let layout = even();
    let off = |row: usize| if row == 100 || (250..253).contains(&row) { 30.0 } else { 0.0 };
    let residual: Vec<f64> = (0..400).map(|row| off(row) + libm::sin(7.0 * count(row))).collect();
    let weighed = outlier_inflation(&layout, &residual, &vec![true; residual.len()], &[0.0]);
    let sizes = [100, 250, 251, 252].map(|row| residual[row] / weighed[row].sqrt());
    assert!(sizes[1..].iter().all(|size| 1.8 * sizes[0] < *size), "{sizes:?}");
}

/// Half of the rows of a coarse display are what their neighbours are: it is no smoother for that, and a wild
/// reading in it is where its neighbours are.
#[test]
fn a_coarse_display_without_its_outliers_is_what_it_was() {
    let digits = |row: usize| f64::from(u8::from(row % 3 == 1)) - f64::from(u8::from(row % 7 == 3));
    let shown: Vec<f64> = (0..60).map(digits).collect();
    let mut wild = shown.clone();
    wild[31] = 40.0;
    let kept = without_outliers(&wild, 6.0);
    assert!(
        (0..60).all(|row| row == 31 || kept[row].to_bits() == shown[row].to_bits()),
        "{kept:?}"
    );
    assert!(kept[31].abs() <= 1.0, "{}", kept[31]);
}

/// An oscillation that forgets, in two passes: white noise of the size that drove it is left beside its last values.
#[test]
fn what_last_values_tell_is_taken_off_noise() {
    let mut chance = ChaCha8Rng::seed_from_u64(3);
    let drive: Vec<f64> = (0..2000).map(|_| StandardNormal.sample(&mut chance)).collect();
    let (mut last, mut before) = (0.0, 0.0);
    let next = |driven: &f64| {
        (last, before) = (1.4 * last - 0.8 * before + driven, last);
        last
    };
    let all: Vec<f64> = drive.iter().map(next).collect();
    let passes: Vec<&[f64]> = all.chunks(1000).collect();
    let prediction = Prediction::of(&passes);
    let left = prediction.beside(passes[1]);
    let driven = &drive[drive.len() - left.len()..];
    let off: f64 = left.iter().zip(driven).map(|(left, driven)| (left - driven).powi(2)).sum();
    assert!(off < 0.02 * dot(driven, driven), "{off}");
}
