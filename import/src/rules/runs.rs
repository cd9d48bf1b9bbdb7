//! Columns that each hold a run.

mod summaries;

use super::{Candidate, NONE, difference};
use crate::decide::Decisions;
use crate::error::quoted;
use crate::header::Header;
use crate::question::Answer;
use crate::samples::Holds;

/// A column that holds a run: its place, and the number and direction that its name tells.
type Found = (usize, Option<i64>, Option<i64>);

/// Columns that each hold a run; true when there are some.
pub(super) fn run_columns(candidates: &mut [Candidate<'_>], decisions: &mut Decisions<'_>) -> bool {
    let open = |candidate: &Candidate<'_>| {
        candidate.rule.to.is_none() && candidate.samples.holds == Holds::Numbers
    };
    let bare_number = |candidate: &Candidate<'_>| {
        candidate.header.bare.parse::<i64>().ok().filter(|number| (0..10_000).contains(number))
    };
    let indexed = |candidate: &Candidate<'_>| index_of(&candidate.header.bare);
    let (mut found, mut summaries): (Vec<Found>, Vec<usize>) = Default::default();
    for (index, candidate) in candidates.iter().enumerate().filter(|(_, c)| open(c)) {
        let run = candidate.header.run.filter(|_| {
            !["pass", "direction"].contains(&candidate.meaning())
                || candidate
                    .header
                    .run
                    .is_some_and(|run| run.number.is_some() || run.direction.is_some())
        });
        let number = run
            .and_then(|run| run.number)
            .or_else(|| bare_number(candidate))
            .or_else(|| indexed(candidate));
        let direction = run.and_then(|run| run.direction);
        if number.is_none() && summaries::is_one(candidate) {
            summaries.push(index);
        } else if number.is_some() || direction.is_some() {
            found.push((index, number, direction));
        }
    }
    summaries::part(candidates, &mut found, &summaries, decisions);
    found.extend(first_run(candidates, &found, decisions));
    if found.len() < 2 {
        return candidates.iter().any(|candidate| candidate.rule.pass.is_some());
    }
    let passes = passes(&found);
    for ((index, _, direction), pass) in found.into_iter().zip(passes) {
        let candidate = &mut candidates[index];
        candidate.rule.pass = candidate.rule.pass.or(Some(pass));
        candidate.rule.direction = candidate.rule.direction.or(direction);
    }
    true
}

/// `Error` beside `Run 2 Error` is the first run, with its own `Position` or one for both.
///
/// Beside `Run 1 Error` it may be their mean: that is asked. Positions alone are read as where each run came
/// to, and the one without a number as what they were aimed at.
fn first_run(
    candidates: &[Candidate<'_>],
    found: &[Found],
    decisions: &mut Decisions<'_>,
) -> Vec<Found> {
    let numbers = || found.iter().filter_map(|(_, number, _)| *number);
    let (Some(least), Some(most)) = (numbers().min(), numbers().max()) else { return Vec::new() };
    let meanings: Vec<&str> =
        found.iter().map(|(index, ..)| candidates[*index].meaning()).collect();
    let same = |at: &usize| {
        let candidate = &candidates[*at];
        meanings.contains(&candidate.meaning())
            && candidate.header.run.is_none()
            && candidate.samples.holds == Holds::Numbers
            && candidate.rule.pass.is_none()
            && !candidate.is(NONE)
            && !candidate.given
    };
    let is_error = |at: &usize| candidates[*at].meaning().ends_with("error");
    let mut same: Vec<usize> = (0..candidates.len()).filter(same).collect();
    if !same.iter().any(is_error) {
        return Vec::new();
    }
    if 1 < least {
        return same.into_iter().map(|at| (at, Some(1), None)).collect();
    }
    same.retain(is_error);
    for at in same {
        ask_whether_a_run(candidates[at].header, most + 1, decisions);
    }
    Vec::new()
}

fn ask_whether_a_run(header: &Header, next: i64, decisions: &mut Decisions<'_>) {
    let text = format!("column {} names no run, as others of its kind do", quoted(&header.name));
    let from = toml_edit::Value::from(header.name.as_str());
    let answer = |label: String, line: String| Answer {
        label,
        recipe: format!("[[column]]\nfrom = {from}\n{line}"),
    };
    let ways = vec![
        answer("it is left out".to_owned(), format!("to = \"{NONE}\"")),
        answer(format!("it is run {next}"), format!("pass = {next}")),
    ];
    decisions.question_at(&header.place, &text, ways);
}

/// The last number of `x(i,3)` or `ref_pos[3]`.
fn index_of(bare: &str) -> Option<i64> {
    let inside = bare.trim_end().strip_suffix([')', ']'])?;
    let (_, last) = inside.rsplit_once([',', '(', '['])?;
    last.trim().parse().ok().filter(|_| inside.contains(','))
}

/// Runs as they are numbered; there and back under numbers of their own make one run together.
fn passes(found: &[Found]) -> Vec<i64> {
    let numbers: Vec<i64> = found.iter().filter_map(|(_, number, _)| *number).collect();
    let alternate = found.len().is_multiple_of(2)
        && found.chunks(2).all(|pair| {
            matches!((pair[0].2, pair[1].2), (Some(1), Some(-1)) | (Some(-1), Some(1)))
        })
        && numbers.windows(2).all(|pair| pair[0] != pair[1]);
    // Who counts from 0 has a run more than the highest number.
    let begin = i64::from(numbers.contains(&0));
    let counted = |direction: Option<i64>, until: usize| {
        1 + found[..until].iter().filter(|(_, _, other)| *other == direction).count()
    };
    let pass = |(place, (_, number, direction)): (usize, &Found)| {
        let number = number.filter(|_| !alternate).map(|number| number + begin);
        number.unwrap_or_else(|| i64::try_from(counted(*direction, place)).unwrap_or(1))
    };
    found.iter().enumerate().map(pass).collect()
}

/// What the columns of runs hold: positions near one target for all, or deviations from it.
pub(super) fn run_values(candidates: &mut [Candidate<'_>]) {
    // A position of one run is that run's own, and none to hold the others against.
    let coordinate = candidates.iter().position(|candidate| {
        candidate.rule.pass.is_none() && (candidate.is("position_mm") || candidate.is("angle_rev"))
    });
    let lone = || {
        candidates.iter().position(|candidate| {
            candidate.rule.to.is_none()
                && candidate.rule.pass.is_none()
                && matches!(candidate.meaning(), "position" | "actual" | "angle")
        })
    };
    let Some(at) = coordinate.or_else(lone) else { return };
    let to = if candidates[at].is_angle() { "angle_rev" } else { "position_mm" };
    candidates[at].decide(to, "the position aimed at in every run");
    let aimed_at = candidates[at].meaning() == "target";
    let targets = candidates[at].samples.values.clone();
    let name = candidates[at].header.name.clone();
    let unit = candidates[at].header.unit.clone();
    let is_value = |candidate: &&mut Candidate<'_>| {
        candidate.rule.pass.is_some() && !["time", "clock", "date"].contains(&candidate.meaning())
    };
    for candidate in candidates.iter_mut().filter(is_value) {
        if candidate.rule.unit.is_none() && follows(&candidate.samples.values, &targets) {
            candidate.rule.unit = candidate.header.unit.clone().or(unit.clone());
        }
        if follows(&candidate.samples.values, &targets) {
            difference(candidate, &name);
            continue;
        }
        deviation(candidate, aimed_at);
    }
}

/// A run of deviations. In the layout of ISO 230-2, runs there and back of targets, they are actual minus
/// target without a word; one that is called an error keeps its sign.
fn deviation(candidate: &mut Candidate<'_>, aimed_at: bool) {
    let standard = aimed_at || candidate.rule.direction.is_some();
    let to = if candidate.is_angle() { "error_arcsec" } else { "error_um" };
    let said = candidate.word.is_some_and(|word| word.reversed);
    let called_error = candidate.meaning().ends_with("error");
    if said || standard && !called_error {
        candidate.rule.sign = candidate.rule.sign.or(Some(-1));
    }
    let reason = if said {
        "a run of deviations, actual minus target, while the error is positive when the table is behind"
    } else if standard && !called_error {
        "a run of targets, whose deviations are actual minus target by ISO 230-2, while the error is \
         positive when the table is behind (`sign = 1` if they are not)"
    } else {
        "a run, taken with its sign (`sign = -1` if it is actual minus target)"
    };
    candidate.decide(to, reason);
}

/// True when values run along with the targets, and do not just differ from them.
pub(super) fn follows(values: &[f64], targets: &[f64]) -> bool {
    let pairs = || values.iter().zip(targets).filter(|(v, t)| v.is_finite() && t.is_finite());
    let spread = |pick: fn((&f64, &f64)) -> f64| {
        let (low, high) =
            pairs().map(pick).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                (low.min(value), high.max(value))
            });
        high - low
    };
    let (targets, values, rest) =
        (spread(|(_, t)| *t), spread(|(v, _)| *v), spread(|(v, t)| v - t));
    0.0 < targets && rest < 0.1 * targets && 0.8 * targets < values
}
