//! Samples as they were taken, and the [`Record`] of them that effects read.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::ops::Range;

use crate::{Column, Columns, Machine, Record};

/// Where and when samples were taken and what was logged there: columns of equal length, pass by
/// pass, ordered as they were taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples {
    /// Time, s, any zero.
    pub time_s: Column,
    /// Nominal travel, mm; 0 in rotary chains, whose angles are no travel.
    pub position_mm: Column,
    /// Spindle angle in turns, growing with position.
    pub angle_rev: Column,
    /// Spindle speed, turns a minute.
    pub speed_rpm: Column,
    /// +1 forward, −1 in reverse.
    pub direction: Column,
    /// Pass, from 0, in blocks: a number never comes back.
    pub pass: Column<usize>,
    /// Logged quantities, known and unknown.
    pub covariates: BTreeMap<String, Column>,
}

impl Samples {
    /// One pass forward through these places, at the machine's lead and speed.
    #[must_use]
    pub fn forward(machine: &Machine, position_mm: Vec<f64>) -> Self {
        let (rows, speed_rpm) = (position_mm.len(), machine.spindle.speed_rpm);
        let lead_mm = machine.workpiece.lead.mm();
        let angle_rev: Column = position_mm.iter().map(|place_mm| place_mm / lead_mm).collect();
        Self {
            time_s: angle_rev.iter().map(|turn| 60.0 * turn / speed_rpm).collect(),
            position_mm: position_mm.into(),
            angle_rev,
            speed_rpm: vec![speed_rpm; rows].into(),
            direction: vec![1.0; rows].into(),
            pass: vec![0; rows].into(),
            covariates: BTreeMap::new(),
        }
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.time_s.len()
    }

    /// True when there is no sample.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.time_s.is_empty()
    }

    /// All columns but the passes.
    pub fn columns_mut(&mut self) -> impl Iterator<Item = &mut Column> {
        let Self { time_s, position_mm, angle_rev, speed_rpm, direction, covariates, .. } = self;
        let coordinates = [time_s, position_mm, angle_rev, speed_rpm, direction];
        coordinates.into_iter().chain(covariates.values_mut())
    }

    /// Time since the first sample, s.
    fn since_start_s(&self) -> Column {
        let start_s = self.time_s.iter().copied().fold(f64::INFINITY, f64::min);
        if start_s == 0.0 {
            return self.time_s.clone();
        }
        self.time_s.iter().map(|time| time - start_s).collect()
    }

    /// Logged quantities row by row, as an effect reads them, and what they are called.
    fn logged(&self) -> (Columns, Column) {
        let columns = Columns::new(self.covariates.keys().map(String::as_str));
        let width = columns.len();
        let rows = if self.covariates.is_empty() { 0 } else { self.len() };
        let mut logged = vec![f64::NAN; width * rows];
        for (name, values) in &self.covariates {
            let Some(column) = columns.index(name) else { continue };
            for (row, value) in logged.chunks_exact_mut(width).zip(values) {
                row[column] = *value;
            }
        }
        (columns, logged.into())
    }
}

impl Record {
    /// What effects of a machine may know of samples.
    #[must_use]
    pub fn new(machine: &Machine, samples: &Samples) -> Self {
        let (columns, covariates) = samples.logged();
        let mut record = Self {
            time_s: samples.since_start_s(),
            position_mm: samples.position_mm.clone(),
            spindle_rad: samples.angle_rev.iter().map(|turn| turn * TAU).collect(),
            speed_rpm: samples.speed_rpm.clone(),
            direction: samples.direction.clone(),
            pass: samples.pass.clone(),
            travelled_mm: Column::default(),
            since_reversal_mm: Column::default(),
            since_turn_mm: Column::default(),
            since_stop_s: Column::default(),
            velocity_rpm: Column::default(),
            error_um: vec![0.0; samples.len()].into(),
            columns,
            covariates,
        };
        [record.travelled_mm, record.since_reversal_mm, record.since_turn_mm] =
            ways(&record, machine);
        record.since_stop_s = record.since_stops_s();
        record.velocity_rpm = record.velocities_rpm();
        record
    }
}

/// Where the axis is along its way, and how fast that is: mm, or degrees on a rotary chain, on which nothing travels.
struct Places {
    of_row: Column,
    /// Way of one turn of the spindle.
    of_turn: f64,
}

/// How an axis goes from row to row of a pass.
struct Pace {
    /// The longest way between neighbours of one direction.
    longest: f64,
    /// The middle one.
    usual: f64,
    /// False where it stops on its way, so that time tells no way.
    is_steady: bool,
}

/// What an axis has gone from one row to the next, and how far it is behind the turn between them, if there is one.
struct Gone {
    way: f64,
    behind_turn: Option<f64>,
}

impl Gone {
    /// The way since the last turn, from what it was before.
    fn since(&self, before: f64) -> f64 {
        self.behind_turn.unwrap_or(before + self.way)
    }
}

impl Places {
    fn of(record: &Record, machine: &Machine) -> Self {
        if machine.rotary {
            let of_row = record.spindle_rad.iter().map(|angle| angle.to_degrees()).collect();
            return Self { of_row, of_turn: 360.0 };
        }
        Self { of_row: record.position_mm.clone(), of_turn: machine.workpiece.lead.mm() }
    }

    fn move_to(&self, row: usize) -> f64 {
        self.of_row[row] - self.of_row[row - 1]
    }

    fn pace(&self, record: &Record, rows: Range<usize>) -> Pace {
        let moves = (rows.start + 1..rows.end).filter(|&row| !record.turned(row));
        let way = |row: usize| self.move_to(row).abs();
        let elapsed_s = |row: usize| record.time_s[row] - record.time_s[row - 1];
        let mut ways: Vec<f64> = moves.clone().map(way).collect();
        let timed = moves.filter(|&row| 0.0 < elapsed_s(row));
        let mut speeds: Vec<f64> = timed.map(|row| way(row) / elapsed_s(row)).collect();
        let ([longest, usual], [_, speed]) =
            (longest_and_middle(&mut ways), longest_and_middle(&mut speeds));
        let unlike = speeds.iter().filter(|one| UNSTEADY * speed < (*one - speed).abs()).count();
        Pace { longest, usual, is_steady: 2 * unlike <= speeds.len() }
    }

    /// What was gone to a row from the one before.
    ///
    /// A reversal is where the direction changes, so that what turns with the direction and what winds
    /// up anew turn together. The turning point lies between two samples, as far beyond them as the
    /// table had time for, or as samples are apart where it rested.
    fn gone(&self, record: &Record, row: usize, pace: &Pace) -> Gone {
        let step = self.move_to(row);
        if !record.turned(row) {
            return Gone { way: step.abs(), behind_turn: None };
        }
        let way = self.over_a_turn(record, row, pace);
        // Out and back are the way between; what one is longer than the other, the move.
        Gone { way, behind_turn: Some(0.5 * (way + record.direction[row] * step)) }
    }

    /// The way from one row over the turning point to the next: what the table had time for. If it had
    /// time for more than it ever goes, it rested, and has gone as far as between others; none where it
    /// stands at one place before and after.
    fn over_a_turn(&self, record: &Record, row: usize, pace: &Pace) -> f64 {
        let elapsed_s = record.time_s[row] - record.time_s[row - 1];
        let most = self.of_turn * record.speed_rpm[row] / 60.0 * elapsed_s;
        let step = self.move_to(row).abs();
        let unseen = if step < ONE_PLACE * pace.usual { 0.0 } else { pace.usual };
        let goes_on = pace.is_steady && most <= (1.0 + ONE_PLACE) * pace.longest;
        if goes_on { most } else { unseen }.max(step)
    }
}

/// The largest of some values, and the middle one; 0 of none. They are sorted.
fn longest_and_middle(values: &mut [f64]) -> [f64; 2] {
    values.sort_unstable_by(f64::total_cmp);
    let of = |place: usize| values.get(place).copied().unwrap_or(0.0);
    [of(values.len().saturating_sub(1)), of(values.len() / 2)]
}

/// Part of the usual speed by which half of the others differ where an axis stops at its rows.
///
/// Chosen: a drive holds its speed to a few per cent, and dwells are as long at short steps as at long ones. Doubled:
/// tables whose steps differ by a tenth pass for strokes.
const UNSTEADY: f64 = 0.05;

/// Part of the way between neighbours that two rows at one place are apart at the most, and by which a time that
/// is read is off.
///
/// Chosen: a target is met to a hundredth of the way to the next. Doubled: one row in fifty of an axis
/// that goes on is at one place with the row behind the turn by chance.
const ONE_PLACE: f64 = 0.01;

/// Way since the start of the pass, since the last reversal in it, and since that of passes which go on, mm, or degrees
/// on a rotary chain.
fn ways(record: &Record, machine: &Machine) -> [Column; 3] {
    let places = Places::of(record, machine);
    let mut travelled = Vec::with_capacity(record.len());
    let mut since_reversal = Vec::with_capacity(record.len());
    let mut since_turn = Vec::with_capacity(record.len());
    for rows in record.passes() {
        let pace = places.pace(record, rows.clone());
        let mut way = way_before(machine, places.of_row[rows.start]);
        let (mut of_pass, mut of_all) = (f64::INFINITY, f64::INFINITY);
        if let Some(before) = since_turn.last()
            && places.move_to(rows.start).abs() <= pace.longest
        {
            of_all = places.gone(record, rows.start, &pace).since(*before);
        }
        for row in rows.clone() {
            if rows.start < row {
                let gone = places.gone(record, row, &pace);
                way += gone.way;
                of_pass = gone.since(of_pass);
                of_all = gone.since(of_all);
            }
            travelled.push(way);
            since_reversal.push(of_pass);
            since_turn.push(of_all);
        }
    }
    let goes_on = since_turn != since_reversal;
    let since_reversal = Column::from(since_reversal);
    let since_turn = if goes_on { since_turn.into() } else { since_reversal.clone() };
    [travelled.into(), since_reversal, since_turn]
}

/// Way of a pass before its first sample, mm; none on a rotary chain, which has no such device.
///
/// A recorder does not say where its pass began. If the first sample lies no farther from travel
/// zero than the device takes to its first comparison, the pass began at zero; any other is taken
/// to begin with its first sample.
fn way_before(machine: &Machine, first_mm: f64) -> f64 {
    if machine.rotary {
        return 0.0;
    }
    let dividers = &machine.dividers;
    let comparison = f64::from(dividers.range.factor()) * f64::from(dividers.b);
    let pulses = f64::from(dividers.initial_phase) + 2.0 * comparison;
    let longest_mm = pulses * machine.fringe_um() / 1000.0;
    if first_mm.abs() <= longest_mm { first_mm.abs() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::motion::{Leg, Pass};
    use crate::{Model, Motion};

    /// 0.6 mm/s.
    const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "100 mm" }
spindle.speed = "6 rpm"
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;

    fn leg(length_mm: f64, forward: bool) -> Leg {
        Leg { length_mm, speed_rpm: 6.0, forward }
    }

    /// Each leg of a motion that turns within the pass, sampled every 1.3 s, and on its turns.
    #[test]
    fn ways_from_samples_are_those_of_the_motion() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).unwrap();
        let legs = vec![leg(30.0, true), leg(21.0, false), leg(17.3, true), leg(9.1, false)];
        let motion = Motion::new(&machine, &Pass { number: 0, start_mm: 20.0, legs }).unwrap();
        let mut time_s: Vec<f64> = (0..99).map(|row| 1.3 * f64::from(row)).collect();
        time_s.push(50.0);
        time_s.sort_by(f64::total_cmp);
        let of = |value: fn(&crate::Instant<'_>) -> f64| {
            time_s.iter().map(|time_s| value(&motion.at(*time_s))).collect::<Vec<f64>>()
        };
        let samples = Samples {
            time_s: time_s.clone().into(),
            direction: of(|now| now.direction).into(),
            ..Samples::forward(&machine, of(|now| now.position_mm))
        };
        let record = Record::new(&machine, &samples);
        for (row, now) in time_s.iter().map(|time_s| motion.at(*time_s)).enumerate() {
            assert!((record.travelled_mm[row] - now.travelled_mm).abs() < 1e-9, "row {row}");
            let (found_mm, due_mm) = (record.since_reversal_mm[row], now.since_reversal_mm);
            let alike = (found_mm - due_mm).abs() < 1e-9 || found_mm.total_cmp(&due_mm).is_eq();
            assert!(alike, "row {row}: {found_mm} mm since the reversal, not {due_mm} mm");
        }
    }

    /// A rest at the turn is no way: where the table stands before and after, it turned.
    #[test]
    fn a_rest_at_the_turn_is_no_way() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).unwrap();
        let samples = Samples {
            time_s: vec![0.0, 1.0, 2.0, 62.0, 63.0, 64.0].into(),
            direction: vec![1.0, 1.0, 1.0, -1.0, -1.0, -1.0].into(),
            ..Samples::forward(&machine, vec![0.0, 0.6, 1.2, 1.2, 0.6, 0.0])
        };
        let record = Record::new(&machine, &samples);
        assert!(record.since_reversal_mm[3].abs() < 1e-12);
        assert!((record.travelled_mm[5] - 2.4).abs() < 1e-12);
    }

    /// Rows at random distances, and a minute of rest between two of them: no farther than neighbours usually are.
    #[test]
    fn a_rest_between_uneven_rows_is_a_usual_way() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).unwrap();
        let places_mm = [0.0, 0.6, 3.0, 3.6, 4.2, 4.0, 3.4, 2.2, 1.6, 1.0];
        let rest_s = |row: usize| if row < 5 { 0.0 } else { 60.0 };
        let mut time_s = vec![0.0];
        for row in 1..places_mm.len() {
            let way_mm = f64::abs(places_mm[row] - places_mm[row - 1]);
            time_s.push(time_s[row - 1] + way_mm / 0.6 + rest_s(row) - rest_s(row - 1));
        }
        let samples = Samples {
            time_s: time_s.into(),
            direction: (0..10).map(|row| if row < 5 { 1.0 } else { -1.0 }).collect(),
            ..Samples::forward(&machine, places_mm.into())
        };
        let record = Record::new(&machine, &samples);
        // 0.6 mm from row to row over the turn, 0.2 mm of them the move.
        assert!((record.since_reversal_mm[5] - 0.4).abs() < 1e-12);
    }

    /// Targets at uneven distances, each reached by a move and a dwell: the time at the turn is no way.
    #[test]
    fn time_tells_no_way_where_an_axis_stops() {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).unwrap();
        let places_mm = [0.0, 1.0, 5.0, 6.5, 9.5, 9.5, 6.5, 5.0, 1.0, 0.0];
        let dwells_s = [0.0, 3.0, 1.0, 2.0, 4.0, 2.0, 1.0, 3.0, 2.0, 1.0];
        let mut time_s = vec![0.0];
        for row in 1..places_mm.len() {
            let way_mm = f64::abs(places_mm[row] - places_mm[row - 1]);
            time_s.push(time_s[row - 1] + way_mm / 0.6 + dwells_s[row]);
        }
        let samples = Samples {
            time_s: time_s.into(),
            direction: (0..10).map(|row| if row < 5 { 1.0 } else { -1.0 }).collect(),
            ..Samples::forward(&machine, places_mm.into())
        };
        let record = Record::new(&machine, &samples);
        assert!(record.since_reversal_mm[5].abs() < 1e-12);
    }

    /// A table that turns 40° there and back, at a degree a row.
    #[test]
    fn the_way_of_a_rotary_chain_is_its_angle() {
        let table = "output.rotary = true\nspindle.speed = \"1 rpm\"\n";
        let machine = Model::parse(table, Path::new("machine.toml")).unwrap();
        let ways: Vec<f64> = (0..80).map(|row| 40.0 - (f64::from(row) - 39.5).abs()).collect();
        let rows = ways.len();
        let samples = Samples {
            time_s: (0..80).map(|row| f64::from(row) / 6.0).collect(),
            angle_rev: ways.iter().map(|degrees| degrees / 360.0).collect(),
            direction: (0..80).map(|row| if row < 40 { 1.0 } else { -1.0 }).collect(),
            ..Samples::forward(&machine, vec![0.0; rows])
        };
        let record = Record::new(&machine, &samples);
        assert!(record.since_reversal_mm[39].is_infinite());
        assert!((record.since_reversal_mm[40] - 0.5).abs() < 1e-9);
        assert!((record.since_reversal_mm[79] - 39.5).abs() < 1e-9);
        assert!((record.travelled_mm[79] - 79.0).abs() < 1e-9);
    }
}
