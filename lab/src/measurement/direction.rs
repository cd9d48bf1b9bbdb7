//! Which way the axis goes at each row.

use helixlock_traces::Table;

use super::coordinates::Coordinates;
use crate::numerics::{spread, weighted_median};
use crate::policy::reading::{
    AT_REST, DIRECTION_REACH, JITTER_OF_TRAVEL, JITTER_REV, REVERSAL_REACH, SHORT_STROKES,
};

/// That of each row of a pass: as told, or as the axis moves.
pub(super) fn of_rows(table: &Table, coordinates: &Coordinates, members: &[usize]) -> Vec<f64> {
    let given = table.column("direction");
    let angles: Vec<f64> = members.iter().map(|&row| coordinates.angle_rev[row]).collect();
    if given.is_none()
        && let Some(least) = least_step(&angles)
    {
        return from_the_row_before(&angles, least);
    }
    let last = angles.len() - 1;
    let mut before = if angles[last] < angles[0] { -1.0 } else { 1.0 };
    let mut signs = Vec::with_capacity(members.len());
    for (index, &row) in members.iter().enumerate() {
        let told = given.map_or(f64::NAN, |column| column[row]);
        let way = angles[(index + DIRECTION_REACH).min(last)]
            - angles[index.saturating_sub(DIRECTION_REACH)];
        if told.is_finite() && told != 0.0 {
            before = told.signum();
        } else if way != 0.0 {
            before = way.signum();
        }
        signs.push(before);
    }
    if given.is_none() {
        turn_at_extremes(&mut signs, |row| angles[row], |row| coordinates.time_s[members[row]]);
    }
    signs
}

/// Of an axis that goes from place to place, rather than through them: the least step that is not a jitter.
fn least_step(angles: &[f64]) -> Option<f64> {
    let sizes = || steps(angles).map(f64::abs);
    let mut by_size: Vec<(f64, f64)> = sizes().map(|size| (size, size)).collect();
    let rest = AT_REST * weighted_median(&mut by_size);
    let stands = 0.0 < rest && angles.len() < 2 * sizes().filter(|size| *size < rest).count();
    let jitter = JITTER_REV.max(JITTER_OF_TRAVEL * spread(angles));
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
fn from_the_row_before(angles: &[f64], least: f64) -> Vec<f64> {
    let first = steps(angles).find(|step| least <= step.abs()).unwrap_or(1.0).signum();
    let ways = steps(angles).scan(first, |way, step| {
        *way = if least <= step.abs() { step.signum() } else { *way };
        Some(*way)
    });
    std::iter::once(first).chain(ways).collect()
}

/// Moves every change of sign to where the travel is farthest; a wide window told it only roughly.
///
/// The farthest sample lies on one side of the turning point: the turn is in the interval that
/// was passed more slowly.
fn turn_at_extremes(signs: &mut [f64], angle: impl Fn(usize) -> f64, time: impl Fn(usize) -> f64) {
    let changes: Vec<usize> = (1..signs.len()).filter(|&i| signs[i - 1] * signs[i] < 0.0).collect();
    let speed = |i: usize| ((angle(i + 1) - angle(i)) / (time(i + 1) - time(i))).abs();
    for change in changes {
        let way = signs[change - 1];
        let window =
            change.saturating_sub(REVERSAL_REACH)..(change + REVERSAL_REACH).min(signs.len());
        let far = |&a: &usize, &b: &usize| (way * angle(a)).total_cmp(&(way * angle(b)));
        let Some(last) = window.clone().max_by(far) else { continue };
        let turned = 0 < last && last + 1 < signs.len() && speed(last - 1) < speed(last);
        for index in window {
            signs[index] = if index < last || (index == last && !turned) { way } else { -way };
        }
    }
}
