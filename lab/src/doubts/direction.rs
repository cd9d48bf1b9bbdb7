//! A direction that denies the travel: no model is needed to see it.

use super::doubt::{Doubt, recipe, said_by};
use crate::measurement::Measurement;
use crate::policy::mistakes::DENIED;

/// The doubt, where nearly all of the way was gone against what `direction` says.
///
/// Rows of one way only and without a clock may be listed the other way round.
pub(super) fn denied(measurement: &Measurement) -> Option<Doubt> {
    let both = measurement.direction.windows(2).any(|pair| pair[0] * pair[1] < 0.0);
    if !measurement.told.direction || (!measurement.timed && !both) {
        return None;
    }
    let (place, pass) = (&measurement.angle_rev, &measurement.pass);
    let inside = (1..place.len()).filter(|&row| pass[row] == pass[row - 1]);
    let ways =
        || inside.clone().map(|row| measurement.direction[row] * (place[row] - place[row - 1]));
    let whole: f64 = ways().map(f64::abs).sum();
    let against: f64 = ways().map(|way| (-way).max(0.0)).sum();
    (0.0 < whole && DENIED * whole <= against).then(|| Doubt {
        what: "sign",
        evidence: said_by(ways().filter(|way| *way < 0.0).count()),
        says: "`direction` is -1 where the travel rises: one of the two counts the other way"
            .to_owned(),
        mend: recipe("direction", "sign = -1"),
    })
}
