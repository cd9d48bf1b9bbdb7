//! Fringes made of a known travel give it back, and say how well.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use helixlock_import::{Recipe, Source, propose};
use helixlock_traces::Table;

const LAMBDA_UM: f64 = 0.632_8;

/// Error of the table, µm, at a commanded position, mm: a screw's wobble.
fn error_um(position_mm: f64) -> f64 {
    0.2 * libm::sin(TAU * position_mm / 0.05 + 0.4)
}

/// Noise of Park and Miller's generator, of deviation 1.
fn noise(seed: &mut u64) -> f64 {
    let mut sum = -6.0;
    for _ in 0..12 {
        *seed = *seed * 16_807 % 2_147_483_647;
        sum += f64::from(u32::try_from(*seed).unwrap_or(0)) / 2_147_483_647.0;
    }
    sum
}

/// A file of one way of 0.3 mm: what `light` says at phase, position and noise.
fn file(header: &str, light: impl Fn(f64, f64, &mut dyn FnMut() -> f64) -> Vec<f64>) -> String {
    let mut text = format!("position [mm],{header}\n");
    let mut seed = 20_240_607;
    for n in 0..9000 {
        // Uneven, as a clock that is not the motor's.
        let position_mm = (f64::from(n) + 0.08 * noise(&mut seed)) * 0.3 / 9000.0;
        let travel_um = 1000.0 * position_mm - error_um(position_mm);
        let phase = 4.0 * PI * travel_um;
        let _ = write!(text, "{position_mm:.9}");
        for value in light(phase, position_mm, &mut || noise(&mut seed)) {
            let _ = write!(text, ",{value:.6}");
        }
        text.push('\n');
    }
    text
}

fn read(text: &str, recipe: &str) -> (Table, Vec<String>) {
    let given = Recipe::parse(recipe, "recipe").expect("a recipe");
    let source = Source { name: "fringes.csv", bytes: text.as_bytes() };
    let proposal = propose(&[source], &given).unwrap_or_else(|error| panic!("{error}"));
    assert!(proposal.questions.is_empty(), "{:?}", proposal.questions);
    (proposal.table, proposal.notes)
}

/// What is off, in standard deviations and in µm, rms each.
fn off(table: &Table) -> (f64, f64) {
    let column = |name: &str| table.require(name).expect(name);
    let (at, error) = (column("position_mm"), column("error_um"));
    let deviation = column("error_um_sd");
    let weight: f64 = deviation.iter().map(|sd| 1.0 / (sd * sd)).sum();
    let left: Vec<f64> = at.iter().zip(error).map(|(at, error)| error - error_um(*at)).collect();
    let zero: f64 = left.iter().zip(deviation).map(|(l, sd)| l / (sd * sd)).sum::<f64>() / weight;
    let count = f64::from(u32::try_from(left.len()).expect("few"));
    let rms = |of: &dyn Fn(f64, f64) -> f64| {
        let squares = left.iter().zip(deviation).map(|(l, sd)| of(l - zero, *sd).powi(2));
        (squares.sum::<f64>() / count).sqrt()
    };
    (rms(&|l, sd| l / sd), rms(&|l, _| l))
}

#[test]
fn one_detector_gives_the_error_with_an_honest_deviation() {
    let text =
        file("fringe", |phase, _, noise| vec![5.0 + libm::cos(phase / LAMBDA_UM) + 0.1 * noise()]);
    let (table, _) = read(&text, "[fringes]\nwavelength_um = 0.6328");
    assert!(table.rows() > 900, "{} rows", table.rows());
    let (sigmas, um) = off(&table);
    assert!((0.7..1.4).contains(&sigmas) && um < 0.004, "{sigmas} {um}");
}

/// The fringes fade to nothing and come back, on light that drifts: what is said of the error there
/// is said with a large deviation, or not at all, and no fringe is lost.
#[test]
fn faded_fringes_weigh_little_and_none_is_skipped() {
    let text = file("fringe", |phase, position_mm, noise| {
        let height = libm::cos(TAU * position_mm / 0.35).abs();
        vec![5.0 + 3.0 * position_mm + height * libm::cos(phase / LAMBDA_UM) + 0.05 * noise()]
    });
    // An envelope that changes its sign is two wavelengths, not a fading: `abs` keeps the phase.
    let (table, _) = read(&text, "[fringes]\nwavelength_um = 0.6328");
    let (sigmas, um) = off(&table);
    assert!(sigmas < 1.5 && um < 0.05, "{sigmas} {um}");
    let deviation = table.require("error_um_sd").expect("it is there");
    let most = deviation.iter().copied().fold(0.0, f64::max);
    let least = deviation.iter().copied().fold(f64::MAX, f64::min);
    assert!(5.0 * least < most, "{least} {most}");
}

/// Heydemann's ellipse: unequal gains, offsets, a lag of 70° in place of 90°.
#[test]
fn a_crooked_quadrature_is_put_right() {
    let text = file("fringe,fringe_quadrature", |phase, _, noise| {
        let angle = phase / LAMBDA_UM;
        let lag = 70_f64.to_radians();
        vec![
            2.0 + libm::cos(angle) + 0.01 * noise(),
            -1.0 + 0.6 * libm::cos(angle - lag) + 0.01 * noise(),
        ]
    });
    let (table, notes) = read(&text, "[fringes]\nwavelength_um = 0.6328");
    let (_, um) = off(&table);
    assert!(um < 0.001, "{um}");
    let told = notes.iter().any(|note| note.starts_with("quadrature: the ellipses leave"));
    assert!(told, "{notes:?}");
}

/// The first detector is dark over more fringes than can be counted on; the second one counts.
#[test]
fn two_wavelengths_find_skipped_fringes() {
    let second_um = 0.532;
    let text = file("fringe,fringe_second", |phase, position_mm, noise| {
        let dark = (0.1..0.13).contains(&position_mm);
        let height = if dark { 0.0 } else { 1.0 };
        vec![
            5.0 + height * libm::cos(phase / LAMBDA_UM) + 0.05 * noise(),
            3.0 + libm::cos(phase / second_um) + 0.05 * noise(),
        ]
    });
    let (table, _) = read(&text, "[fringes]\nwavelength_um = 0.6328\nsecond_um = 0.532");
    let (_, um) = off(&table);
    assert!(um < 0.01, "{um}");
}

#[test]
fn what_is_missing_is_asked_for_and_what_cannot_be_is_refused() {
    let text = file("fringe", |phase, _, _| vec![libm::cos(phase / LAMBDA_UM)]);
    let source = Source { name: "fringes.csv", bytes: text.as_bytes() };
    let asked = propose(&[source], &Recipe::default()).map(|proposal| proposal.questions);
    let refused = |recipe: &str, text: &str| {
        let given = Recipe::parse(recipe, "recipe").expect("a recipe");
        let source = Source { name: "fringes.csv", bytes: text.as_bytes() };
        propose(&[source], &given).map(|_| ()).expect_err("refused").to_string()
    };
    let asked = asked.expect("readable");
    assert!(asked.iter().any(|question| question.text.contains("wavelength")), "{asked:?}");
    let wide = refused("[fringes]\nwavelength_um = 632.8", &text);
    assert!(wide.contains("`wavelength_um = 632.8`, expected 0.1 to 20"), "{wide}");
    let dark = file("fringe", |_, _, _| vec![1.0]);
    let dark = refused("[fringes]\nwavelength_um = 0.6328", &dark);
    assert!(dark.contains("no stretch of `position_mm` with fringes"), "{dark}");
}
