//! Causes that slow noise would swallow, and effects that only undo each other.

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{diagnosed, diagnosed_on, names};
use crate::support::passes::{MACHINE, white};

/// Six passes forward of 200 rows over 600 mm: noise of 0.2 µm and an error, µm, of pass and place, mm.
fn six_passes(seed: u64, error_um: &dyn Fn(usize, f64) -> f64) -> Diagnosis {
    let mut noise = white(seed, 0.2);
    let mut columns = [const { Vec::new() }; 4];
    for (nth, pass) in (0..6).zip([0.0, 1.0, 2.0, 3.0, 4.0, 5.0]) {
        for row in 0..200 {
            let mm = 3.0 * f64::from(row);
            let cells = [pass, 40.0 * pass + mm / 20.0, mm, error_um(nth, mm) + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
    }
    let titles = ["pass", "time_s", "position_mm", "error_um"];
    diagnosed(titles.into_iter().zip(columns).collect())
}

/// A chip that lies under the table from the fourth pass on: a bump of 25 standard errors in three of
/// six passes, which noise of each pass's own would follow another way.
#[test]
fn what_half_of_the_passes_share_is_no_noise() {
    let bump = |mm: f64| libm::exp(-0.5 * ((mm - 250.0) / 25.0) * ((mm - 250.0) / 25.0));
    for seed in 0..4 {
        let later = six_passes(seed, &|pass, mm| if pass < 3 { 0.0 } else { 0.8 * bump(mm) });
        assert_eq!(later.verdict, Verdict::Unexplained, "{seed}");
        let by_turns = six_passes(seed, &|pass, mm| {
            let size = if pass % 2 == 0 { 0.5 } else { -0.5 };
            size * bump(mm)
        });
        assert_eq!(by_turns.verdict, Verdict::Unexplained, "{seed}");
    }
}

/// Noise as slow as a quarter of a pass, another in each.
#[test]
fn slow_noise_of_each_pass_has_nothing_in_common() {
    for seed in 0..4 {
        let mut fresh = white(seed + 20, 0.1);
        let slow: Vec<Vec<f64>> = (0..6)
            .map(|_| {
                let mut value = 0.0;
                let mut next = || {
                    value = 0.98 * value + fresh();
                    value
                };
                (0..200).map(|_| next()).collect()
            })
            .collect();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few hundred"
        )]
        let found = six_passes(seed, &|pass, mm| slow[pass][(mm / 3.0) as usize]);
        assert!(names(&found).is_empty(), "{seed}");
        let shapes: Vec<&str> = found.residual.iter().map(|one| one.shape.as_str()).collect();
        assert!(shapes.iter().all(|shape| !shape.contains("in common")), "{seed}: {shapes:?}");
    }
}

/// A drift of eleven standard errors in one long pass: the noise is slow only without it.
#[test]
fn a_drift_is_no_slow_noise() {
    for seed in 0..4 {
        let mut noise = white(seed, 3.0);
        let mut columns = [const { Vec::new() }; 4];
        for row in 0..1200 {
            let hours = f64::from(row) / 800.0;
            let cells = [1.0, 3600.0 * hours, f64::from(row % 150), 2.5 * hours + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "error_um"];
        let found = diagnosed_on(MACHINE, titles.into_iter().zip(columns).collect());
        assert_ne!(found.verdict, Verdict::NothingMissing, "{seed}");
    }
}

/// A wheel that runs in and out, at both ends of a thread: a bow of the screw and the sag of a bed, each a
/// hundred times as large, would leave nearly as much.
#[test]
fn effects_that_undo_each_other_are_not_named_together() {
    for seed in 0..4 {
        let mut noise = white(seed, 0.28);
        let mut columns = [const { Vec::new() }; 4];
        for (pass, row) in
            [0.0, 1.0, 2.0, 3.0].into_iter().flat_map(|pass| (0..300).map(move |row| (pass, row)))
        {
            let mm = 500.0 * f64::from(row) / 299.0;
            let ends = libm::exp(-mm / 18.0) - libm::exp(-(500.0 - mm) / 18.0);
            let cells = [pass, 900.0 * pass + mm / 0.6, mm, 0.8 * ends + noise()];
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.push(cell));
        }
        let titles = ["pass", "time_s", "position_mm", "lead_error_um"];
        let found = diagnosed(titles.into_iter().zip(columns).collect());
        let named = names(&found);
        assert!(!named.contains(&"steady-sag"), "{seed}: {named:?}");
    }
}
