//! How long a machine has stood still.

use super::Record;
use super::column::Column;

impl Record {
    /// Time since the machine came to stand, s, infinite while it moves; empty where it never stands.
    ///
    /// It stands where it neither travels nor turns from one sample of a pass to the next, and since the
    /// first sample there: when between two samples it stopped was not logged.
    pub(super) fn since_stops_s(&self) -> Column {
        let mut since_s = vec![f64::INFINITY; self.len()];
        let mut stands = false;
        for row in 1..self.len() {
            if self.moved(row) {
                continue;
            }
            stands = true;
            if since_s[row - 1].is_infinite() {
                since_s[row - 1] = 0.0;
            }
            since_s[row] = since_s[row - 1] + self.time_s[row] - self.time_s[row - 1];
        }
        if stands { since_s.into() } else { Column::default() }
    }

    /// True unless a sample lies where the one before it lay, later in the same pass.
    fn moved(&self, row: usize) -> bool {
        let place = |at: usize| {
            let exact = [self.position_mm[at], self.spindle_rad[at]].map(f64::to_bits);
            (self.pass[at], exact)
        };
        place(row) != place(row - 1) || self.time_s[row] <= self.time_s[row - 1]
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::{Model, Record, Samples};

    const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "100 mm" }
spindle.speed = "6 rpm"
"#;

    #[test]
    fn a_stop_begins_with_its_first_sample_and_ends_with_its_last() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
        let samples = Samples {
            time_s: vec![0.0, 1.0, 1.5, 2.5, 3.0, 4.0].into(),
            pass: vec![0, 0, 0, 0, 0, 1].into(),
            ..Samples::forward(&machine, vec![0.0, 2.0, 2.0, 2.0, 4.0, 4.0])
        };
        let record = Record::new(&machine, &samples);
        let since_s: Vec<f64> = record.instants().map(|now| now.since_stop_s).collect();
        let moves = f64::INFINITY;
        assert_eq!(since_s, [moves, 0.0, 0.5, 1.5, moves, moves]);
    }
}
