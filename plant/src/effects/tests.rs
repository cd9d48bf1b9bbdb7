//! What holds for every card.

use std::path::Path;

use expect_test::expect_file;

use super::{CATALOGUE, guide};
use crate::{
    COVARIATES, Columns, Context, Effect, Instant, Model, Parameter, Role, Smoothness, Term,
};

pub(super) const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "1000 mm" }
spindle.speed = "6 rpm"
lead_screw.lead = "12 mm"
gear = [{ name = "change gear 1", order = 2.5, teeth = 48 }]
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150, range = 2 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;

pub(super) fn machine() -> Model {
    Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine")
}

/// Logs of an ordinary day, in the order of [`COVARIATES`].
pub(super) const LOGS: [f64; 11] =
    [22.0, 1015.0, 60.0, 22.0, 21.0, 2.0, 50.0, 150.0, 90.0, 0.0, 400.0];

pub(super) fn now() -> Instant<'static> {
    Instant {
        time_s: 600.0,
        position_mm: 500.0,
        spindle_rad: 500.0 / 6.0 * std::f64::consts::TAU,
        speed_rpm: 6.0,
        direction: 1.0,
        velocity_rpm: 6.0,
        pass: 0,
        travelled_mm: 500.0,
        since_reversal_mm: 3.0,
        since_turn_mm: 3.0,
        since_stop_s: f64::INFINITY,
        error_um: 0.3,
        covariates: &LOGS,
    }
}

fn columns() -> Columns {
    Columns::new(COVARIATES.iter().copied())
}

/// δ of an effect of the catalogue with these values.
pub(super) fn delta_um(kind: &str, values: &[f64], now: &Instant<'_>) -> f64 {
    let term = Term::new(Term::card(kind).expect(kind), values).expect(kind);
    term.effect(&machine(), &columns()).expect(kind).delta_um(now)
}

/// A value inside the range that is neither 0 nor an end.
fn inside(parameter: &Parameter) -> f64 {
    let (low, high) = (*parameter.range.start(), *parameter.range.end());
    let value = if 0.0 < low { (low * high).sqrt() } else { low + (high - low) * 0.625 };
    if parameter.is_whole() { libm::round(value) } else { value }
}

#[test]
fn every_card_is_complete() {
    for card in CATALOGUE {
        for text in [card.summary, card.formula, card.example, card.signature, card.separated_by] {
            assert!(!text.is_empty(), "{}", card.kind);
        }
        assert!(!card.source.is_empty(), "{}", card.kind);
        for other in card.confused_with {
            assert!(Term::card(other).is_some(), "{}: no effect `{other}`", card.kind);
        }
        for column in card.needs {
            assert!(COVARIATES.contains(column), "{}: no column `{column}`", card.kind);
        }
        for parameter in card.parameters {
            assert!(parameter.range.start() < parameter.range.end(), "{}", card.kind);
        }
    }
}

#[test]
fn amplitudes_are_followed_by_their_phases() {
    for card in CATALOGUE {
        for (index, parameter) in card.parameters.iter().enumerate() {
            let next = card.parameters.get(index + 1).map(|next| next.role);
            assert_eq!(
                parameter.role == Role::Amplitude,
                next == Some(Role::Phase),
                "{}",
                card.kind
            );
        }
    }
}

#[test]
fn columns_times_coefficients_are_the_effect() {
    let (machine, columns) = (machine(), columns());
    for card in CATALOGUE {
        let values: Vec<_> = card.parameters.iter().map(inside).collect();
        let term = Term::new(card, &values).expect(card.kind);
        let basis = term.basis(&Context { machine: &machine, columns: &columns }).expect(card.kind);
        assert_eq!(basis.columns.len(), term.coefficients().len(), "{}", card.kind);
        assert_eq!(term.priors().len(), term.coefficients().len(), "{}", card.kind);
        let back = term.with_coefficients(&term.coefficients());
        for (value, same) in values.iter().zip(&back.values) {
            assert!((value - same).abs() < 1e-9 * value.abs(), "{}: {value} {same}", card.kind);
        }
    }
}

#[test]
fn every_effect_is_finite_at_the_ends_of_its_ranges() {
    for card in CATALOGUE {
        let ends = card.parameters.iter().map(|p| (*p.range.start(), *p.range.end()));
        let (low, high): (Vec<_>, Vec<_>) = ends.unzip();
        for values in [low, high] {
            let delta_um = delta_um(card.kind, &values, &now());
            assert!(delta_um.is_finite(), "{} at {values:?}", card.kind);
        }
    }
}

/// A bound that is too small would let the solver of edges leave fringes where they are not.
#[test]
fn effects_change_no_faster_than_they_promise() {
    let (machine, columns) = (machine(), columns());
    let (speed_rad_s, travel_mm_s) = (std::f64::consts::TAU / 10.0, 0.6);
    for card in CATALOGUE {
        let values: Vec<_> = card.parameters.iter().map(inside).collect();
        let term = Term::new(card, &values).expect(card.kind);
        let effect = term.effect(&machine, &columns).expect(card.kind);
        let at = |seconds: f64| {
            effect.delta_um(&Instant {
                time_s: 600.0 + seconds,
                position_mm: 500.0 + travel_mm_s * seconds,
                spindle_rad: now().spindle_rad + speed_rad_s * seconds,
                travelled_mm: 500.0 + travel_mm_s * seconds,
                since_reversal_mm: 3.0 + travel_mm_s * seconds,
                since_turn_mm: 3.0 + travel_mm_s * seconds,
                since_stop_s: f64::INFINITY,
                ..now()
            })
        };
        let smoothness = effect.smoothness(speed_rad_s, travel_mm_s);
        let tolerance_um = 1e-7;
        let span_s = crate::piece::Piece::longest_s(smoothness, tolerance_um).min(300.0);
        if smoothness != Smoothness::Rough {
            let piece = crate::piece::Piece::new(0.0, span_s, at);
            for part in 0..=100 {
                let seconds = span_s * f64::from(part) / 100.0;
                let off_um = (piece.at(seconds).0 - at(seconds)).abs();
                // Wrong settings are metres large: there the rounding of f64 counts, not the bound.
                let rounding_um = 16.0 * f64::EPSILON * at(seconds).abs();
                let bound_um = tolerance_um + rounding_um;
                assert!(off_um < bound_um, "{} is off by {off_um}", card.kind);
            }
        }
    }
}

#[test]
fn the_guide_is_fresh() {
    expect_file!["../../../docs/effects.md"].assert_eq(&guide());
}
