//! What `discover` proposes where a reading, a clock or a ripple could pass for a cause.

use helixlock_lab::{Discovery, discover};

use crate::support::diagnosed::{diagnosed_on, names, problem_of};
use crate::support::passes::white;

/// An instrument at rest: what moves it is a lead and a speed of the machine file only.
const AT_REST: &str = "spindle.speed = '60 rpm'\nlead_screw.lead = '8 mm'\n";

type Table = Vec<(&'static str, Vec<f64>)>;

fn discovered(machine: &str, columns: &Table) -> Discovery {
    discover(&problem_of(machine, columns.clone()))
}

/// What each proposal stands along.
fn along(found: &Discovery) -> Vec<&str> {
    found.proposals.iter().map(|proposal| proposal.along.as_str()).collect()
}

/// A camera's pixels and what was worked out of them, to three digits.
#[test]
fn a_reading_does_not_explain_itself() {
    for name in ["x_pixel", "where_mm", "air_temperature_c"] {
        let mut noise = white(1, 1.0);
        let mut place = 0.0;
        let pixel = |_| {
            place += 0.3 * noise();
            (100.0 * (1278.0 + place + noise())).round() / 100.0
        };
        let pixels: Vec<f64> = (0..300).map(pixel).collect();
        let error_um =
            pixels.iter().map(|pixel| (3086.4 * (pixel - 1278.0)).round() / 1000.0).collect();
        let time_s = (0..300).map(|row| 600.0 * f64::from(row)).collect();
        let table = vec![("time_s", time_s), (name, pixels), ("error_um", error_um)];
        let found = discovered(AT_REST, &table);
        assert!(!along(&found).contains(&name), "{name}: {:?}", found.proposals);
        let named = diagnosed_on(AT_REST, table);
        assert!(names(&named).is_empty(), "{name}: {:?}", names(&named));
        assert!(named.residual.iter().all(|left| left.along != name), "{name}: {named:?}");
    }
}
