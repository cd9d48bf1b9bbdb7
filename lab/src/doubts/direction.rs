//! A direction that denies the travel: no model is needed to see it.

use super::doubt::{Doubt, recipe, said_by};
use crate::measurement::Measurement;
use crate::policy::mistakes::{DENIED, DENIED_ROWS};

/// The doubt, where nearly all of the way was gone against what `direction` says, in all passes or in one.
///
/// Rows of one way only and without a clock may be listed the other way round.
pub(super) fn denied(measurement: &Measurement) -> Option<Doubt> {
    let both = measurement.direction.windows(2).any(|pair| pair[0] * pair[1] < 0.0);
    if !measurement.told.direction || (!measurement.timed && !both) {
        return None;
    }
    if let Some(rows) = against(measurement, |_| true) {
        return Some(Doubt {
            what: "sign",
            evidence: said_by(rows),
            says: "`direction` is -1 where the travel rises: one of the two counts the other way"
                .to_owned(),
            mend: recipe("direction", "sign = -1"),
        });
    }
    let passes = 0..measurement.pass_names.len();
    let of_pass = |pass| against(measurement, |row| measurement.pass[row] == pass);
    let denied = |pass| of_pass(pass).filter(|rows| DENIED_ROWS <= *rows).map(|rows| (pass, rows));
    let (pass, rows) = passes.filter(|_| measurement.timed).find_map(denied)?;
    let name = measurement.pass_names[pass];
    Some(Doubt {
        what: "sign",
        evidence: said_by(rows),
        says: format!("`direction` is -1 where the travel rises in pass {name}, not in the others"),
        mend: format!("turn `direction` in pass {name}"),
    })
}

/// Rows from which the way was gone against `direction`, where that is nearly all of the way.
fn against(measurement: &Measurement, belongs: impl Fn(usize) -> bool) -> Option<usize> {
    let (place, pass) = (&measurement.angle_rev, &measurement.pass);
    let inside = (1..place.len()).filter(|&row| pass[row] == pass[row - 1] && belongs(row));
    let ways = inside.map(|row| measurement.direction[row] * (place[row] - place[row - 1]));
    let (mut whole, mut against, mut rows) = (0.0, 0.0, 0);
    for way in ways {
        whole += f64::abs(way);
        against += (-way).max(0.0);
        rows += usize::from(way < 0.0);
    }
    (0.0 < whole && DENIED * whole <= against).then_some(rows)
}
