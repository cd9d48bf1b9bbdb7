//! Which way the axis goes at each row.

use std::ops::Range;

use helixlock_traces::Table;

use super::coordinates::Coordinates;
use crate::numerics::{deviation, median, spread, turns_of_the_way, weighted_median};
use crate::policy::reading::{
    AS_LONG_AS_A_MOVE, AT_REST, BEYOND_TREMBLING, DIRECTION_REACH, JITTER_OF_TRAVEL, JITTER_REV,
    REVERSAL_REACH, ROWS_OF_A_STAND, SHORT_STROKES, SLOWED_BY, TREMBLES, TURNS_AT_ROWS,
};

/// That of each row of a pass: as told, or as the axis moves.
pub(super) fn of_rows(table: &Table, coordinates: &Coordinates, members: &[usize]) -> Vec<f64> {
    let angles: Vec<f64> = members.iter().map(|&row| coordinates.angle_rev[row]).collect();
    let rows = 0..members.len();
    let all = if angles.last() < angles.first() { -1.0 } else { 1.0 };
    if let Some(column) = table.column("direction") {
        let told =
            |row: usize| Some(column[members[row]]).filter(|way| way.is_finite() && *way != 0.0);
        return kept(all, rows.map(|row| told(row).unwrap_or_else(|| around(&angles, row))));
    }
    let (rest, jitter) = (rest(&angles), jitter(&angles));
    let time = |row: usize| coordinates.time_s[members[row]];
    if let Some(least) = least_step(&angles, rest, jitter) {
        return from_the_row_before(&angles, time, least);
    }
    let rests = at_rest(&angles, rest.min(jitter));
    let mut signs = kept(all, rows.map(|row| if rests[row] { 0.0 } else { around(&angles, row) }));
    turn_at_extremes(&mut signs, &rests, |row| angles[row], time);
    signs
}

/// How far an axis goes over the rows around one.
fn around(angles: &[f64], row: usize) -> f64 {
    let to = (row + DIRECTION_REACH).min(angles.len() - 1);
    angles[to] - angles[row.saturating_sub(DIRECTION_REACH)]
}

/// The way of each row; one that is 0 keeps the way before it.
fn kept(before: f64, ways: impl Iterator<Item = f64>) -> Vec<f64> {
    let keep = |before: &mut f64, way: f64| {
        *before = if way == 0.0 { *before } else { way.signum() };
        Some(*before)
    };
    ways.scan(before, keep).collect()
}

/// Rows at which an axis stands and trembles by less than that.
fn at_rest(angles: &[f64], least: f64) -> Vec<bool> {
    let mut rests = vec![false; angles.len()];
    let mut from = 0;
    while from < angles.len() {
        let (mut low, mut high) = (angles[from], angles[from]);
        let leaves = |next: &f64| {
            (low, high) = (low.min(*next), high.max(*next));
            least <= high - low
        };
        let behind = from + 1;
        let to =
            angles[behind..].iter().position(leaves).map_or(angles.len(), |rows| behind + rows);
        if let Some(stand) = stand(angles, from..to) {
            rests[stand.clone()].fill(true);
            from = stand.end;
        } else {
            // Half of what is no stand, so that a long one costs no square of its rows.
            from += (to - from).div_ceil(2);
        }
    }
    rests
}

/// The rows of a stand among rows at which an axis goes nowhere: all that it passes, however it trembles there, or those
/// from which it goes back without their slow ends.
fn stand(angles: &[f64], rows: Range<usize>) -> Option<Range<usize>> {
    if is_passed(angles, &rows) {
        return (1 <= turns_of(&angles[rows.clone()])).then_some(rows);
    }
    let middle = without_slow_ends(angles, rows);
    trembles(&angles[middle.clone()]).then_some(middle)
}

/// True where an axis comes to rows and leaves them the same way.
fn is_passed(angles: &[f64], rows: &Range<usize>) -> bool {
    let step = |to: usize| Some(angles.get(to)? - angles.get(to.checked_sub(1)?)?);
    step(rows.start).zip(step(rows.end)).is_some_and(|(comes, leaves)| 0.0 < comes * leaves)
}

/// Rows of what may be a stand, without those at its ends at which the axis slowly comes or goes: they are farther off
/// than it trembles.
fn without_slow_ends(angles: &[f64], rows: Range<usize>) -> Range<usize> {
    let middle = median(&mut angles[rows.clone()].to_vec());
    let off = |row: usize| (angles[row] - middle).abs();
    let trembling = deviation(&mut rows.clone().map(off).collect::<Vec<f64>>());
    let stands = |row: &usize| off(*row) <= BEYOND_TREMBLING * trembling;
    let first = rows.clone().find(stands).unwrap_or(rows.start);
    let last = rows.clone().rfind(stands).unwrap_or(first);
    first..last + 1
}

/// True where an axis goes nowhere, less far than all its steps would lead, and more often to and fro than once: that is
/// a turn.
fn trembles(angles: &[f64]) -> bool {
    let gone: f64 = steps(angles).map(f64::abs).sum();
    2 <= turns_of(angles) && (angles[angles.len() - 1] - angles[0]).abs() < TREMBLES * gone
}

/// How often an axis turns among such rows.
fn turns_of(angles: &[f64]) -> usize {
    let mut places = angles.to_vec();
    places.dedup();
    turns_of_the_way(&places)
}

/// Steps up to which an axis that makes such steps may rest.
fn rest(angles: &[f64]) -> f64 {
    let mut by_size: Vec<(f64, f64)> = steps(angles).map(|step| (step.abs(), step.abs())).collect();
    AT_REST * weighted_median(&mut by_size)
}

/// What the places of an axis may jitter by.
fn jitter(angles: &[f64]) -> f64 {
    JITTER_REV.max(JITTER_OF_TRAVEL * spread(angles))
}

/// Of an axis that goes from place to place, rather than through them: the least step that is not a jitter.
fn least_step(angles: &[f64], rest: f64, jitter: f64) -> Option<f64> {
    let at_rest = steps(angles).filter(|step| step.abs() < rest).count();
    let stands = 0.0 < rest && angles.len() < 2 * at_rest;
    stands.then_some(rest).or_else(|| makes_short_strokes(angles, jitter).then_some(jitter))
}

/// From each row to the next.
fn steps(angles: &[f64]) -> impl Iterator<Item = f64> {
    angles.windows(2).map(|two| two[1] - two[0])
}

/// True for an axis that goes to and fro again and again within fewer rows than tell a way from a jitter, by far more
/// than one: targets in any order, or three ahead and one back.
fn makes_short_strokes(angles: &[f64], least: f64) -> bool {
    let mut strokes: Vec<(f64, usize)> = Vec::new();
    for step in steps(angles) {
        let goes_on = step.abs() < least || strokes.last().is_some_and(|last| 0.0 < last.0 * step);
        match strokes.last_mut() {
            Some((_, rows)) if goes_on => *rows += 1,
            _ if step.abs() < least => {}
            _ => strokes.push((step, 1)),
        }
    }
    // How long the first has gone on and how long the last will, no row says.
    let inside = strokes.get(1..strokes.len().saturating_sub(1)).unwrap_or_default();
    SHORT_STROKES <= inside.iter().filter(|(_, rows)| *rows <= DIRECTION_REACH).count()
}

/// The way that the axis came to each row; to the first as it goes on.
fn from_the_row_before(angles: &[f64], time: impl Fn(usize) -> f64, least: f64) -> Vec<f64> {
    let first = steps(angles).find(|step| least <= step.abs()).unwrap_or(1.0).signum();
    let ways = steps(angles).map(|step| if least <= step.abs() { step } else { 0.0 });
    let ways: Vec<f64> = std::iter::once(first).chain(ways).collect();
    let mut signs = kept(first, ways.iter().copied());
    for rows in come_back_to(&ways, &signs, time) {
        let other = -signs[rows.start];
        signs[rows].fill(other);
    }
    signs
}

/// Rows of the place of a turn to which the axis has come back from beyond: between two rows there as much time has gone
/// as a move takes, and not between others.
fn come_back_to(ways: &[f64], signs: &[f64], time: impl Fn(usize) -> f64) -> Vec<Range<usize>> {
    let rows: Vec<usize> = (0..ways.len()).collect();
    let lasts = |row: usize| time(row) - time(row - 1);
    let usual = |moves: bool| {
        let all = rows[1..].iter().filter(|row| (ways[**row] != 0.0) == moves);
        median(&mut all.map(|row| lasts(*row)).collect::<Vec<f64>>())
    };
    let as_long = AS_LONG_AS_A_MOVE * usual(true);
    if as_long <= usual(false) {
        return Vec::new();
    }
    let back = |place: &[usize]| {
        let behind = place[place.len() - 1] + 1;
        let turns = signs.get(behind).is_some_and(|sign| sign * signs[place[0]] < 0.0);
        let mut away = place[1..].iter().filter(|row| as_long <= lasts(**row));
        let back = away.next().filter(|_| turns && away.next().is_none())?;
        Some(*back..behind)
    };
    rows.chunk_by(|_, row| ways[*row] == 0.0).filter_map(back).collect()
}

/// Moves every change of sign to where the travel is farthest; a wide window told it only roughly. From where it stood,
/// an axis turns as it leaves.
///
/// The farthest sample lies on one side of the turning point: the turn is in the interval next to it that was passed more
/// slowly than all around. Where many turns are in neither, the axis turns at its samples, to which it has come.
fn turn_at_extremes(
    signs: &mut [f64],
    rests: &[bool],
    angle: impl Fn(usize) -> f64,
    time: impl Fn(usize) -> f64,
) {
    let end = signs.len() - 1;
    let speed = |i: usize| ((angle(i + 1) - angle(i)) / (time(i + 1) - time(i))).abs();
    // A stroke may have no more than six rows: two intervals on either side.
    let is_slowest = |row: usize, last: usize| {
        let others = (last.saturating_sub(2)..(last + 2).min(end)).filter(|other| *other != row);
        speed(row) < SLOWED_BY * others.map(speed).fold(f64::INFINITY, f64::min)
    };
    let turn = |change: usize| {
        let way = signs[change - 1];
        let window = change.saturating_sub(REVERSAL_REACH)..(change + REVERSAL_REACH).min(end + 1);
        let far = |&a: &usize, &b: &usize| (way * angle(a)).total_cmp(&(way * angle(b)));
        let last = window.clone().max_by(far)?;
        let back = |row: usize| way * (angle(last) - angle(row));
        let stood = stood_until(last..window.end.min(end), window.start, back);
        if let Some(last) = stood {
            return Some(Turn { way, window, last, is_before: false, is_between: true });
        }
        let is_before = 0 < last && last < end && is_slowest(last - 1, last);
        let is_between = is_before || (last < end && is_slowest(last, last));
        Some(Turn { way, window, last, is_before, is_between })
    };
    let changes = (1..=end).filter(|&row| signs[row - 1] * signs[row] < 0.0 && !rests[row - 1]);
    let turns: Vec<Turn> = changes.filter_map(turn).collect();
    let beside_none = turns.iter().filter(|turn| !turn.is_between).count();
    let at_rows = turns.len() <= TURNS_AT_ROWS * beside_none;
    for Turn { way, window, last, is_before, .. } in turns {
        for index in window {
            let behind = last < index || (index == last && is_before && !at_rows);
            signs[index] = if behind { -way } else { way };
        }
    }
}

/// The last of some rows behind a turn at which the axis still stood there, with those before them: a row later it is
/// far away against how near they all are.
fn stood_until(behind: Range<usize>, first: usize, back: impl Fn(usize) -> f64) -> Option<usize> {
    behind.rev().find(|&row| {
        let least = AT_REST * back(row + 1);
        let near = (first..row).filter(|&other| back(other) < least).count();
        back(row) < least && ROWS_OF_A_STAND <= near + 1
    })
}

/// A reversal, near the row where the travel is farthest.
struct Turn {
    /// The way before it.
    way: f64,
    /// Rows around it.
    window: Range<usize>,
    /// The farthest of them.
    last: usize,
    /// True when the interval before that was passed more slowly than all around.
    is_before: bool,
    /// True when that or the one behind it was.
    is_between: bool,
}
