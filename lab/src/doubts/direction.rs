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
    let ways = ways(measurement);
    if let Some(rows) = ways.iter().copied().fold(Way::default(), Way::and).denied() {
        return Some(Doubt {
            what: "sign",
            evidence: said_by(rows),
            says: "`direction` is -1 where the travel rises: one of the two counts the other way"
                .to_owned(),
            mend: recipe("direction", "sign = -1"),
        });
    }
    let denied = |way: &Way| way.denied().filter(|rows| DENIED_ROWS <= *rows);
    let mut of_passes = ways.iter().zip(&measurement.pass_names).filter(|_| measurement.timed);
    let (rows, name) = of_passes.find_map(|(way, name)| Some((denied(way)?, name)))?;
    Some(Doubt {
        what: "sign",
        evidence: said_by(rows),
        says: format!("`direction` is -1 where the travel rises in pass {name}, not in the others"),
        mend: format!("turn `direction` in pass {name}"),
    })
}

/// What was gone of a pass, by the position, and what of that against `direction`, in how many rows.
#[derive(Clone, Copy, Default)]
struct Way {
    whole: f64,
    against: f64,
    rows: usize,
}

impl Way {
    fn and(self, more: Self) -> Self {
        Self {
            whole: self.whole + more.whole,
            against: self.against + more.against,
            rows: self.rows + more.rows,
        }
    }

    /// Rows against `direction`, where nearly all of the way is.
    fn denied(self) -> Option<usize> {
        (0.0 < self.whole && DENIED * self.whole <= self.against).then_some(self.rows)
    }
}

/// The way of every pass.
fn ways(measurement: &Measurement) -> Vec<Way> {
    let (place, pass) = (&measurement.angle_rev, &measurement.pass);
    let mut ways = vec![Way::default(); measurement.pass_names.len()];
    for row in (1..place.len()).filter(|&row| pass[row] == pass[row - 1]) {
        let way = measurement.direction[row] * (place[row] - place[row - 1]);
        let rows = usize::from(way < 0.0);
        let more = Way { whole: way.abs(), against: (-way).max(0.0), rows };
        ways[pass[row]] = ways[pass[row]].and(more);
    }
    ways
}
