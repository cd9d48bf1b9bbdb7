//! What is left beside noise is seen, and noise is not taken for anything.

use helixlock_lab::{Verdict, compare, diagnose};

use crate::support::passes::{Passes, noise};

#[test]
fn noise_at_two_speeds_and_in_two_directions_is_noise() {
    for (seed, length) in [(1, 0.1), (2, 5.0), (3, 50.0), (4, 0.1), (5, 10.0)] {
        let compared = compare(&Passes::new(&|_, _, _| 0.0, &mut noise(seed, length)).problem());
        let clearest = &compared.along[0];
        assert!(compared.noise_only, "{length}: {} {}", clearest.along, clearest.p_value);
    }
}

/// It turns its sign with the direction and fades: no two passes show the same.
#[test]
fn a_smooth_error_of_each_pass_s_own_is_not_noise() {
    let turning = |time_s: f64, position_mm: f64, direction: f64| {
        let wave = libm::cos(position_mm / 450.0 * std::f64::consts::TAU);
        1.5 * direction * (1.0 - time_s / 4000.0) * wave
    };
    let diagnosis = diagnose(&Passes::new(&turning, &mut noise(7, 5.0)).problem());
    assert_eq!(diagnosis.verdict, Verdict::Unexplained);
}

/// A kink, and a step at one place of every pass: a cubic with a bump follows the one, a slip in
/// each pass the other, both to within the noise.
#[test]
fn plain_shapes_are_not_named_after_effects_that_imitate_them() {
    let kink = |x: f64| 0.004 * (x - 410.0).max(0.0);
    let step = |x: f64| if x < 450.25 { 0.0 } else { 1.3 };
    let shapes: [(&str, &dyn Fn(f64) -> f64); 2] = [("kink", &kink), ("step", &step)];
    for (name, shape) in shapes {
        let passes = Passes::new(&|_, x, _| shape(x), &mut noise(5, 3.0));
        let diagnosis = diagnose(&passes.problem());
        assert_eq!(diagnosis.verdict, Verdict::Unexplained, "{name}");
        let shapes: Vec<&str> = diagnosis.residual.iter().map(|s| s.shape.as_str()).collect();
        assert!(shapes.iter().any(|shape| shape.starts_with(name)), "{name}: {shapes:?}");
    }
}
