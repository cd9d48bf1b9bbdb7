//! Which rows make a pass, in which order, direction and speed.

use std::collections::BTreeMap;

use helixlock_traces::Table;

use super::coordinates::Coordinates;
use super::direction;
use crate::numerics::{count, median, spread, turns_of_the_way, weighted_median};
use crate::policy::reading::{
    JUMP_OF_MOVES, JUMP_OF_TRAVEL, LONE_PASSES, ROWS_A_PASS, ROWS_A_REVERSAL, WAY_OF_A_RESTART,
};

/// Rows of the table in pass and time order, with what follows from that order.
#[derive(Debug)]
pub(crate) struct Passes {
    pub(crate) rows: Vec<usize>,
    pub(crate) pass: Vec<usize>,
    pub(crate) names: Vec<f64>,
    pub(crate) direction: Vec<f64>,
    pub(crate) speed_rpm: Vec<f64>,
    pub(crate) restart: Option<Restart>,
}

/// A clock that began anew in the middle of a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Restart {
    /// Name of the pass.
    pub(crate) pass: f64,
    /// By how much it fell, s.
    pub(crate) by_s: f64,
}

impl Passes {
    /// How many there are, and how many of one sample, where these are too many.
    pub(crate) fn lone(&self) -> Option<(usize, usize)> {
        let (passes, mut samples) = (self.names.len(), vec![0; self.names.len()]);
        for pass in &self.pass {
            samples[*pass] += 1;
        }
        let lone = samples.iter().filter(|samples| **samples == 1).count();
        (LONE_PASSES * (passes - lone) < lone).then_some((passes, lone))
    }
}

/// Sorts rows into passes by the column `pass`, or where the table jumps back to a start.
pub(crate) fn split(
    table: &Table,
    coordinates: &Coordinates,
    rows: &[usize],
    notes: &mut Vec<String>,
) -> Passes {
    let groups = match table.column("pass") {
        Some(names) => in_order_of_time(by_name(names, rows, notes), coordinates),
        None => by_jumps(coordinates, rows, notes),
    };
    let mut passes = Passes {
        rows: Vec::with_capacity(rows.len()),
        pass: Vec::with_capacity(rows.len()),
        names: groups.iter().map(|(name, _)| *name).collect(),
        direction: Vec::new(),
        speed_rpm: Vec::new(),
        restart: None,
    };
    for (index, (name, mut members)) in groups.into_iter().enumerate() {
        let fallen = |by_s| Restart { pass: name, by_s };
        passes.restart = passes.restart.or_else(|| fell_by_s(&members, coordinates).map(fallen));
        order(&mut members, coordinates);
        passes.direction.extend(direction::of_rows(table, coordinates, &members));
        passes.speed_rpm.extend(speed(table, coordinates, &members));
        passes.pass.extend(std::iter::repeat_n(index, members.len()));
        passes.rows.extend(members);
    }
    passes
}

fn by_name(names: &[f64], rows: &[usize], notes: &mut Vec<String>) -> Vec<(f64, Vec<usize>)> {
    let mut groups: Vec<(f64, Vec<usize>)> = Vec::new();
    let mut places: BTreeMap<u64, usize> = BTreeMap::new();
    let mut missing = 0;
    for &row in rows {
        let name = names[row];
        if !name.is_finite() {
            missing += 1;
            continue;
        }
        let place = *places.entry(name.to_bits()).or_insert_with(|| {
            groups.push((name, Vec::new()));
            groups.len() - 1
        });
        groups[place].1.push(row);
    }
    if 0 < missing {
        notes.push(format!("{missing} rows without a pass are left out"));
    }
    groups.sort_by(|a, b| a.0.total_cmp(&b.0));
    groups
}

/// Passes as they were taken where one clock ran through all of them, whatever they are called.
fn in_order_of_time(
    mut groups: Vec<(f64, Vec<usize>)>,
    coordinates: &Coordinates,
) -> Vec<(f64, Vec<usize>)> {
    let span = |rows: &[usize]| {
        let times = || rows.iter().map(|&row| coordinates.time_s[row]);
        (times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max))
    };
    let mut spans: Vec<(f64, f64)> = groups.iter().map(|(_, rows)| span(rows)).collect();
    spans.sort_by(|a, b| a.0.total_cmp(&b.0));
    if coordinates.timed && spans.windows(2).all(|pair| pair[0].1 <= pair[1].0) {
        groups.sort_by(|a, b| span(&a.1).0.total_cmp(&span(&b.1).0));
    }
    groups
}

/// A new pass begins where the table is suddenly far back against its travel.
fn by_jumps(
    coordinates: &Coordinates,
    rows: &[usize],
    notes: &mut Vec<String>,
) -> Vec<(f64, Vec<usize>)> {
    let moves: Vec<f64> = rows
        .windows(2)
        .map(|pair| coordinates.angle_rev[pair[1]] - coordinates.angle_rev[pair[0]])
        .collect();
    let mut sizes: Vec<f64> = moves.iter().map(|m| m.abs()).collect();
    let usual = median(&mut sizes);
    let range = spread(&rows.iter().map(|&r| coordinates.angle_rev[r]).collect::<Vec<_>>());
    let far = (JUMP_OF_MOVES * usual).max(JUMP_OF_TRAVEL * range);
    let jumps = moves.iter().filter(|m| far < m.abs()).count();
    let shuffled = rows.len() < ROWS_A_PASS * jumps;
    let mut groups = vec![(1.0, vec![rows[0]])];
    for (pair, step) in rows.windows(2).zip(&moves) {
        if coordinates.placed && !shuffled && far < step.abs() {
            groups.push((count(groups.len() + 1), Vec::new()));
        }
        let last = groups.len() - 1;
        groups[last].1.push(pair[1]);
    }
    if 1 < groups.len() {
        notes.push(format!("{} passes are told apart by where the travel jumps", groups.len()));
    }
    groups
}

/// By how much the clock fell, s, where the way through the rows is far shorter as they stand in the file than as
/// it has them, or where it fell but once and the axis went on; `None` where it rises, or rows were listed in another
/// order than that of their instants.
fn fell_by_s(members: &[usize], coordinates: &Coordinates) -> Option<f64> {
    let Coordinates { time_s, angle_rev, timed, .. } = coordinates;
    let steps = members.windows(2).map(|pair| time_s[pair[0]] - time_s[pair[1]]);
    let fall = steps.fold(0.0, f64::max);
    if !timed || fall <= 0.0 {
        return None;
    }
    let way = |rows: &[usize]| -> f64 {
        rows.windows(2).map(|pair| (angle_rev[pair[1]] - angle_rev[pair[0]]).abs()).sum()
    };
    let mut in_time = members.to_vec();
    order(&mut in_time, coordinates);
    let anew = WAY_OF_A_RESTART * way(members) < way(&in_time) || fell_once(members, coordinates);
    anew.then_some(fall)
}

/// True where a clock fell but once, to before all there was, the axis went on from there as it goes, and all that came
/// behind would by the clock have ended long before the rest began.
fn fell_once(members: &[usize], coordinates: &Coordinates) -> bool {
    let Coordinates { time_s, angle_rev, .. } = coordinates;
    let (mut falls, mut longest_s, mut widest_rev) = (Vec::new(), 0.0_f64, 0.0_f64);
    for (one, next) in members.windows(2).map(|pair| (pair[0], pair[1])) {
        if time_s[next] < time_s[one] {
            falls.push((one, next));
        } else {
            longest_s = longest_s.max(time_s[next] - time_s[one]);
            widest_rev = widest_rev.max((angle_rev[next] - angle_rev[one]).abs());
        }
    }
    let [(one, next)] = falls[..] else { return false };
    let pause_s = time_s[members[0]] - time_s[members[members.len() - 1]];
    longest_s < pause_s && (angle_rev[next] - angle_rev[one]).abs() <= widest_rev
}

/// Time order; without a clock the order of the file, or that of travel when rows are shuffled.
fn order(members: &mut [usize], coordinates: &Coordinates) {
    if coordinates.timed {
        members.sort_by(|&a, &b| coordinates.time_s[a].total_cmp(&coordinates.time_s[b]));
        return;
    }
    let angle = |row: usize| coordinates.angle_rev[row];
    let turns = turns_of_the_way(&members.iter().map(|&row| angle(row)).collect::<Vec<_>>());
    if members.len() < ROWS_A_REVERSAL * turns {
        members.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
    }
}

/// Speed as told, or the usual one over the way of the pass: where an axis dwells it only trembles.
fn speed(table: &Table, coordinates: &Coordinates, members: &[usize]) -> Vec<f64> {
    let mut pieces: Vec<(f64, f64)> = members
        .windows(2)
        .map(|pair| {
            let turns = (coordinates.angle_rev[pair[1]] - coordinates.angle_rev[pair[0]]).abs();
            let time = coordinates.time_s[pair[1]] - coordinates.time_s[pair[0]];
            (60.0 * turns / time.abs(), turns)
        })
        .filter(|(rpm, _)| rpm.is_finite() && 0.0 < *rpm)
        .collect();
    let usual = weighted_median(&mut pieces);
    let given = table.column("speed_rpm");
    let told = |row: usize| given.map(|column| column[row]).filter(|rpm| rpm.is_finite());
    members.iter().map(|&row| told(row).unwrap_or(usual)).collect()
}

/// What follows the travel, its reading kept for all rows of a rest of the axis.
pub(crate) fn kept_at_rest(values: &[f64], position: &[f64], pass: &[usize]) -> Vec<f64> {
    let mut kept = values.to_vec();
    let rests =
        |a: usize, b: usize| pass[a] == pass[b] && position[a].to_bits() == position[b].to_bits();
    let behind = (1..kept.len()).map(|row| (row, row - 1));
    let before = (1..kept.len()).rev().map(|row| (row - 1, row));
    for (row, neighbour) in behind.chain(before) {
        if !kept[row].is_finite() && rests(row, neighbour) {
            kept[row] = kept[neighbour];
        }
    }
    kept
}

/// Missing values taken from their neighbours in the pass: between two, linear; at an end, equal.
pub(crate) fn bridged(values: &[f64], pass: &[usize]) -> Vec<f64> {
    let overall = values.iter().copied().find(|value| value.is_finite()).unwrap_or(0.0);
    let mut whole = values.to_vec();
    let mut start = 0;
    while start < values.len() {
        let end = start + pass[start..].iter().take_while(|p| **p == pass[start]).count();
        bridge(&mut whole[start..end], overall);
        start = end;
    }
    whole
}

fn bridge(values: &mut [f64], overall: f64) {
    let known: Vec<usize> = (0..values.len()).filter(|&i| values[i].is_finite()).collect();
    let Some((&first, &last)) = known.first().zip(known.last()) else {
        values.fill(overall);
        return;
    };
    let (low, high) = (values[first], values[last]);
    values[..first].fill(low);
    values[last + 1..].fill(high);
    for pair in known.windows(2) {
        let (a, b) = (values[pair[0]], values[pair[1]]);
        let width = count(pair[1] - pair[0]);
        for (step, value) in values[pair[0]..pair[1]].iter_mut().enumerate().skip(1) {
            *value = a + (b - a) * count(step) / width;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples::{Measurement, Nominal};
    use super::*;
    use helixlock_traces::Column;

    /// Passes of a hundred samples, by the number of each row.
    fn read(pass: impl Fn(f64) -> f64) -> Result<usize, String> {
        let rows: Vec<f64> = (0..100).map(f64::from).collect();
        let column = |name: &str, values| Column::new(name.to_owned(), values);
        let table = Table::new(vec![
            column("position_mm", rows.clone()),
            column("error_um", rows.iter().map(|row| libm::sin(row / 9.0)).collect()),
            column("pass", rows.iter().map(|row| pass(*row)).collect()),
        ]);
        let nominal = Nominal {
            lead_mm: 6.0,
            speed_rpm: 10.0,
            step_um: 1.0,
            rotary: false,
            drive: false,
            closed: false,
        };
        let read = Measurement::from_table(&table, &nominal);
        read.map(|read| read.pass_names.len()).map_err(|error| error.to_string())
    }

    /// A pitch that is read once at each of three places.
    #[test]
    fn what_follows_the_travel_keeps_its_reading_at_rest() {
        let nan = f64::NAN;
        let place = [0.0, 0.0, 10.0, 10.0, 20.0, 20.0, 20.0];
        let read = [1.0, nan, nan, 3.0, 5.0, nan, nan];
        assert_eq!(kept_at_rest(&read, &place, &[0; 7]), [1.0, 1.0, 3.0, 3.0, 5.0, 5.0, 5.0]);
        let of_two_passes = kept_at_rest(&read, &place, &[0, 1, 1, 1, 1, 1, 1]);
        assert!(of_two_passes[1].is_nan());
    }

    #[test]
    fn passes_of_one_sample_are_refused_and_longer_ones_are_not() {
        let message = read(|row| row).expect_err("each row has a zero of its own");
        assert!(message.contains("column `pass`: found 100 passes of which 100 have a single"));
        // Two rows together and then four apart; two together and then two apart; a row left over.
        let grouped = |of: f64, together: f64| {
            move |row: f64| of * (row / of).floor() + (row % of - together + 1.0).max(0.0)
        };
        assert!(read(grouped(6.0, 2.0)).is_err());
        assert!(read(grouped(4.0, 2.0)).is_err());
        assert_eq!(read(grouped(4.0, 3.0)), Ok(50));
        assert_eq!(read(|row| (row / 2.0).floor()), Ok(50));
        assert_eq!(read(|row| if row < 99.0 { 1.0 } else { 2.0 }), Ok(2));
        assert_eq!(read(|_| 1.0), Ok(1));
    }
}
