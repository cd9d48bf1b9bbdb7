//! What becomes of each column: from its name, its unit and what it holds.

mod runs;
mod set_point;
mod sign;
mod slip;
mod units;
mod unused;

use std::collections::BTreeMap;

use crate::data::{self, Target, Word};
use crate::decide::Decisions;
use crate::error::quoted;
use crate::fringes::{COUNT, DETECTORS};
use crate::header::{self, Header};
use crate::place::Place;
use crate::question::Answer;
use crate::recipe::ColumnRule;
use crate::runs::{counts, counts_rows};
use crate::samples::{Holds, Samples};
use runs::{run_columns, run_values};
pub(crate) use slip::check_names;
use units::units;

/// Our columns that a measurement needs one of.
pub(crate) const OBSERVED: [&str; 4] = ["error_um", "error_arcsec", "lead_error_um", "steps"];
/// Our columns that say where or when; it needs one of them, too.
pub(crate) const COORDINATES: [&str; 3] = ["position_mm", "time_s", "angle_rev"];
/// What leaves a column out.
pub(crate) const NONE: &str = "none";

/// A column with what is known of it.
pub(crate) struct Candidate<'a> {
    pub(crate) header: &'a Header,
    pub(crate) samples: &'a Samples,
    pub(crate) word: Option<Word>,
    pub(crate) rule: ColumnRule,
    given: bool,
}

impl Candidate<'_> {
    fn meaning(&self) -> &'static str {
        self.word.map_or("", |word| word.meaning)
    }

    fn is_angle(&self) -> bool {
        self.header.unit.as_deref().is_some_and(|unit| {
            data::unit(unit, "angle").is_some() && data::unit(unit, "length").is_none()
        })
    }

    fn decide(&mut self, to: &str, reason: impl Into<String>) {
        if self.rule.to.is_none() {
            self.rule.to = Some(to.to_owned());
        }
        if self.rule.reason.is_empty() {
            self.rule.reason = reason.into();
        }
    }

    fn is(&self, to: &str) -> bool {
        self.rule.to.as_deref() == Some(to)
    }
}

/// Rules for all columns; `preamble_unit` is a unit named above the table.
pub(crate) fn propose(
    headers: &[Header],
    samples: &[Samples],
    preamble_unit: Option<&str>,
    decisions: &mut Decisions<'_>,
) -> Vec<ColumnRule> {
    let mut candidates: Vec<Candidate> = headers
        .iter()
        .zip(samples)
        .map(|(header, samples)| candidate(header, samples, decisions))
        .collect();
    set_point::of_temperatures(&mut candidates);
    unused::left_out(&mut candidates, decisions);
    candidates.iter_mut().for_each(by_content);
    counters(&mut candidates);
    let runs = run_columns(&mut candidates, decisions);
    positions(&mut candidates, runs, decisions);
    candidates.iter_mut().for_each(by_word);
    one_of_each(&mut candidates, decisions);
    covariates(&mut candidates);
    units(&mut candidates, preamble_unit, decisions);
    observed(&candidates, decisions);
    candidates.into_iter().map(|candidate| candidate.rule).collect()
}

fn candidate<'a>(
    header: &'a Header,
    samples: &'a Samples,
    decisions: &Decisions<'_>,
) -> Candidate<'a> {
    let given = decisions.given_column(&header.name);
    let rule = given
        .cloned()
        .unwrap_or_else(|| ColumnRule { from: header.name.clone(), ..ColumnRule::default() });
    let given = given.is_some_and(|rule| rule.to.is_some());
    let word = header::meaning(&header.bare);
    // `target speed` is no position: the unit decides.
    let kinds = word.and_then(|word| data::target(word.meaning)).map_or("", |target| target.kind);
    let unit = header.unit.as_deref().filter(|_| !kinds.is_empty());
    let fits = unit.is_none_or(|unit| {
        data::unit(unit, kinds).is_some()
            || kinds == "length" && data::unit(unit, "angle").is_some()
    });
    Candidate { header, samples, word: word.filter(|_| fits), rule, given }
}

/// Columns of ours, empty columns, words and instants.
fn by_content(candidate: &mut Candidate<'_>) {
    let name = candidate.header.name.as_str();
    let known = data::targets().iter().any(|target| target.column == name);
    let told = ["pass", "direction"].contains(&candidate.meaning());
    match candidate.samples.holds {
        Holds::Nothing => candidate.decide(NONE, "it is empty"),
        Holds::Instants if candidate.meaning() == "clock" => {}
        Holds::Instants => candidate.decide("time_s", "it holds instants"),
        Holds::Words if told => {}
        Holds::Words => candidate.decide(NONE, "it holds words"),
        Holds::Numbers if name == "pass" && counts(&candidate.samples.values) => {
            candidate.decide(NONE, "it counts the rows");
        }
        Holds::Numbers if known && candidate.rule.to.is_none() => {
            candidate.rule.to = Some(name.to_owned());
            "the name says it all".clone_into(&mut candidate.rule.reason);
        }
        Holds::Numbers => {}
    }
}

/// `Zielposition i` beside `Pi (mm)`: numbers of targets are no positions, unless they run along with one.
fn counters(candidates: &mut [Candidate<'_>]) {
    let is_place = |candidate: &Candidate<'_>| {
        matches!(candidate.meaning(), "target" | "position")
            && candidate.rule.to.is_none()
            && candidate.samples.holds == Holds::Numbers
    };
    let counter = |candidate: &Candidate<'_>| {
        let values = &candidate.samples.values;
        let from_one = values.windows(2).next().is_some_and(|first| first == [1.0, 2.0]);
        is_place(candidate) && candidate.header.unit.is_none() && from_one && counts(values)
    };
    let places: Vec<usize> =
        (0..candidates.len()).filter(|at| is_place(&candidates[*at])).collect();
    let [one, other] = places[..] else { return };
    for (at, beside) in [(one, other), (other, one)] {
        let place = &candidates[beside];
        let along = runs::follows(&place.samples.values, &candidates[at].samples.values);
        if counter(&candidates[at]) && !counter(place) && !along {
            candidates[at].decide(NONE, "it counts the rows");
        }
    }
}

/// Target and actual position: the one is the coordinate, their difference the error.
fn positions(candidates: &mut [Candidate<'_>], runs: bool, decisions: &mut Decisions<'_>) {
    let column =
        |candidate: &Candidate<'_>| if candidate.is_angle() { "angle_rev" } else { "position_mm" };
    let open = |candidate: &Candidate<'_>, meaning: &str| {
        candidate.meaning() == meaning
            && candidate.rule.to.is_none()
            && candidate.rule.pass.is_none()
    };
    let taken = |candidates: &[Candidate<'_>]| {
        candidates.iter().any(|candidate| candidate.is("position_mm") || candidate.is("angle_rev"))
    };
    let targets: Vec<usize> =
        (0..candidates.len()).filter(|at| open(&candidates[*at], "target")).collect();
    if let [target] = targets.as_slice()
        && !taken(candidates)
    {
        let to = column(&candidates[*target]);
        candidates[*target].decide(to, "the position aimed at");
    }
    if runs {
        return run_values(candidates);
    }
    if let Some(target) = target_of(candidates) {
        given_as_error(candidates, target);
    }
    let &[aimed_at] = targets.as_slice() else { return };
    let target = candidates[aimed_at].header.name.clone();
    let found = candidates.iter().any(|candidate| {
        matches!(candidate.meaning(), "error" | "angular error" | "lead error")
            && candidate.rule.to.is_none()
            || OBSERVED.iter().any(|name| candidate.is(name))
    });
    let found_at: Vec<usize> = (0..candidates.len())
        .filter(|at| open(&candidates[*at], "actual") || open(&candidates[*at], "position"))
        .collect();
    if let (true, Some(actual)) = (found, found_at.first()) {
        sign::shown(candidates, aimed_at, *actual);
    }
    for (place, at) in found_at.iter().enumerate() {
        let candidate = &mut candidates[*at];
        if found {
            candidate
                .decide(NONE, format!("where it came to; {} is the position", quoted(&target)));
        } else if place == 0 {
            difference(candidate, &target);
        } else {
            candidate.word = None; // another one is taken until the question is answered
        }
    }
    if !found && 1 < found_at.len() {
        ask_which(candidates, &found_at, &target, decisions);
    }
}

/// Several columns say where the axis came to: asks which of them measured it.
fn ask_which(
    candidates: &[Candidate<'_>],
    found_at: &[usize],
    target: &str,
    decisions: &mut Decisions<'_>,
) {
    let answer = |at: &usize| {
        let candidate = &candidates[*at];
        let error = if candidate.is_angle() { "error_arcsec" } else { "error_um" };
        error_answer(&candidate.header.name, error, target)
    };
    let text = format!("several columns may be where it came to, aimed at {}", quoted(target));
    decisions.question_at(
        &candidates[found_at[0]].header.place,
        &text,
        found_at.iter().map(answer).collect(),
    );
}

/// Target minus what was found is the error.
fn error_answer(actual: &str, error: &str, target: &str) -> Answer {
    Answer {
        label: format!("{} is where it came to", quoted(actual)),
        recipe: format!(
            "[[column]]\nfrom = {}\nto = \"{error}\"\nminus = {}\nsign = -1",
            toml_edit::Value::from(actual),
            toml_edit::Value::from(target),
        ),
    }
}

/// The one column that was aimed at, by its name.
fn target_of(candidates: &[Candidate<'_>]) -> Option<usize> {
    let mut all = (0..candidates.len()).filter(|at| candidates[*at].meaning() == "target");
    all.next().filter(|_| all.next().is_none())
}

/// A position that a recipe calls an error, and that runs along with the target, is what it came to.
fn given_as_error(candidates: &mut [Candidate<'_>], target: usize) {
    let (name, values) = (candidates[target].header.name.clone(), candidates[target].samples);
    let is_position = |candidate: &Candidate<'_>| {
        matches!(candidate.meaning(), "actual" | "position")
            && OBSERVED[..3].iter().any(|name| candidate.is(name))
            && candidate.rule.minus.is_none()
            && runs::follows(&candidate.samples.values, &values.values)
    };
    for candidate in candidates.iter_mut().filter(|candidate| is_position(candidate)) {
        difference(candidate, &name);
    }
}

/// Turns an actual position into an error.
fn difference(candidate: &mut Candidate<'_>, target: &str) {
    let to = if candidate.is_angle() { "error_arcsec" } else { "error_um" };
    candidate.decide(
        to,
        format!("target minus actual: positive when the table is behind {}", quoted(target)),
    );
    candidate.rule.minus = candidate.rule.minus.take().or(Some(target.to_owned()));
    candidate.rule.sign = candidate.rule.sign.or(Some(-1));
}

/// What the words of a name say.
fn by_word(candidate: &mut Candidate<'_>) {
    let Some(word) = candidate.word.filter(|_| candidate.rule.to.is_none()) else { return };
    let angle = candidate.is_angle();
    let meaning = match word.meaning {
        "error" if angle => "angular error",
        "position" | "actual" if angle => "angle",
        "pass" | "number" if counts(&candidate.samples.values) => {
            return candidate.decide(NONE, "it counts the rows");
        }
        // Neither the number of a row nor that of a run, whatever its name holds.
        "pass" if counts_rows(&candidate.samples.values) => return,
        "date" | "clock" if candidate.samples.holds == Holds::Instants => "time",
        meaning => meaning,
    };
    let Some(target) = data::target(meaning) else { return };
    let mut reason = format!("{} means {meaning}", quoted(word.spelling));
    if word.reversed && candidate.rule.sign.is_none() {
        candidate.rule.sign = Some(-1);
        reason.push_str(
            ": actual minus target, while the error is positive when the table is behind",
        );
    }
    candidate.decide(target.column, reason);
}

/// No column of ours may come from two of the file, or from two of a run.
fn one_of_each(candidates: &mut [Candidate<'_>], decisions: &mut Decisions<'_>) {
    join_clock(candidates);
    let mut columns = BTreeMap::<_, Vec<usize>>::new();
    for (at, candidate) in candidates.iter().enumerate() {
        let rule = &candidate.rule;
        if let Some(target) = rule.to.as_deref().and_then(by_column) {
            columns.entry((target.column, rule.pass, rule.direction)).or_default().push(at);
        }
    }
    for ((target, ..), same) in columns.into_iter().filter(|(_, same)| 1 < same.len()) {
        let given: Vec<usize> = same.iter().copied().filter(|at| candidates[*at].given).collect();
        let needed = OBSERVED.contains(&target) || COORDINATES.contains(&target);
        if given.is_empty() && two_positions(candidates, &same, decisions) {
            continue;
        }
        if given.is_empty() && needed {
            let names: Vec<_> = same.iter().map(|at| candidates[*at].header.name.clone()).collect();
            let text = format!(
                "`{}` may be `{target}` each; `to = \"{NONE}\"` leaves a column out",
                names.join("`, `")
            );
            let place = &candidates[same[1]].header.place;
            decisions.question_at(place, &text, answers(&names, target));
        }
        let kept = given.first().copied().unwrap_or(same[0]);
        for at in same.into_iter().filter(|at| *at != kept && !given.contains(at)) {
            candidates[at].rule.to = None;
            candidates[at].rule.sign = None;
            candidates[at].rule.reason = format!("another column is `{target}`");
            if candidates[at].samples.holds != Holds::Numbers {
                candidates[at].rule.to = Some(NONE.to_owned());
            }
        }
    }
}

/// Of two positions and no error one is aimed at, and the other one where the axis came to: asks which.
fn two_positions(
    candidates: &mut [Candidate<'_>],
    same: &[usize],
    decisions: &mut Decisions<'_>,
) -> bool {
    let &[one, other] = same else { return false };
    let place = ["position_mm", "angle_rev"].iter().find(|place| candidates[one].is(place));
    let found = candidates.iter().any(|candidate| OBSERVED.iter().any(|name| candidate.is(name)));
    let Some(place) = place.filter(|_| !found && candidates[other].rule.minus.is_none()) else {
        return false;
    };
    let error = if *place == "angle_rev" { "error_arcsec" } else { "error_um" };
    let names = [one, other].map(|at| candidates[at].header.name.clone());
    let answer = |[target, actual]: [&String; 2]| {
        let aimed_at = answers(std::slice::from_ref(target), place).remove(0);
        let came_to = error_answer(actual, error, target);
        Answer {
            label: format!("{} is aimed at, {}", quoted(target), came_to.label),
            recipe: format!("{}\n\n{}", aimed_at.recipe, came_to.recipe),
        }
    };
    let text = format!("`{}` and `{}` are positions both", names[0], names[1]);
    let [first, second] = [&names[0], &names[1]];
    let left_out = |[kept, other]: [&String; 2]| Answer {
        label: format!("{} is the position, {} is left out", quoted(kept), quoted(other)),
        recipe: [
            answers(std::slice::from_ref(kept), place),
            answers(std::slice::from_ref(other), NONE),
        ]
        .concat()
        .into_iter()
        .map(|answer| answer.recipe)
        .collect::<Vec<_>>()
        .join("\n\n"),
    };
    let ways = vec![
        answer([first, second]),
        answer([second, first]),
        left_out([first, second]),
        left_out([second, first]),
    ];
    decisions.question_at(&candidates[other].header.place, &text, ways);
    candidates[other].rule.to = None;
    candidates[other].rule.reason.clear();
    difference(&mut candidates[other], &names[0]);
    true
}

/// A date and a time of day side by side make one instant.
fn join_clock(candidates: &mut [Candidate<'_>]) {
    let instants = |meaning: &str| {
        let fits = |c: &Candidate<'_>| c.samples.holds == Holds::Instants && c.meaning() == meaning;
        candidates.iter().position(fits)
    };
    let Some(date) = instants("date") else { return };
    let Some(clock) = instants("clock").or_else(|| instants("time")) else { return };
    let name = candidates[clock].header.name.clone();
    candidates[clock].rule.to = Some(NONE.to_owned());
    "it belongs to the date".clone_into(&mut candidates[clock].rule.reason);
    candidates[date].rule.with = candidates[date].rule.with.take().or(Some(name));
}

pub(crate) fn answers(names: &[String], target: &str) -> Vec<Answer> {
    let answer = |name: &String| Answer {
        label: format!("{} is `{target}`", quoted(name)),
        recipe: format!(
            "[[column]]\nfrom = {}\nto = \"{target}\"",
            toml_edit::Value::from(name.as_str())
        ),
    };
    names.iter().map(answer).collect()
}

/// What nobody knows is kept under its own name: it may explain something.
fn covariates(candidates: &mut [Candidate<'_>]) {
    let mut names: Vec<String> =
        candidates.iter().filter_map(|candidate| candidate.rule.to.clone()).collect();
    for candidate in candidates.iter_mut().filter(|candidate| candidate.rule.to.is_none()) {
        if candidate.samples.holds != Holds::Numbers {
            candidate.decide(NONE, "it holds no numbers");
            continue;
        }
        let plain = header::plain_name(candidate.header);
        let taken =
            |name: &str| names.iter().any(|known| known == name) || data::target(name).is_some();
        let name = (1..=names.len() + 2)
            .map(|n| if n == 1 { plain.clone() } else { format!("{plain}_{n}") })
            .find(|name| !taken(name));
        let name = name.unwrap_or(plain);
        names.push(name.clone());
        candidate.decide(&name, "not known: kept beside the measurement");
    }
}

pub(crate) fn by_column(name: &str) -> Option<Target> {
    data::target(name).filter(|target| target.column == name)
}

/// True for what may be named as the error or the position: a time and a channel that is not used are neither.
fn is_free(candidate: &Candidate<'_>) -> bool {
    candidate.samples.holds == Holds::Numbers
        && candidate.rule.to.as_deref().is_none_or(|to| by_column(to).is_none())
        && candidate.meaning() != "time"
        && !unused::is_unused(candidate)
}

/// True for what may be a time: it rises from row to row, and is in no other unit.
fn may_be_time(candidate: &Candidate<'_>) -> bool {
    let unit = candidate.header.unit.as_deref();
    unit.is_none_or(|unit| data::unit(unit, "time").is_some())
        && candidate.samples.values.windows(2).all(|pair| pair[0] < pair[1])
}

/// Asks for what a measurement cannot do without.
fn observed(candidates: &[Candidate<'_>], decisions: &mut Decisions<'_>) {
    let has = |names: &[&str]| {
        candidates.iter().any(|candidate| names.iter().any(|name| candidate.is(name)))
    };
    let timed = has(&["time_s"]);
    let free: Vec<String> = candidates
        .iter()
        // An axis that should stand still is logged by the clock: where it is, is its error.
        .filter(|candidate| is_free(candidate) || timed && candidate.is("position_mm"))
        .map(|candidate| candidate.header.name.clone())
        .take(12)
        .collect();
    if !has(&OBSERVED) && !has(&DETECTORS) && !free.is_empty() {
        let rotary = candidates.iter().any(|candidate| candidate.is("angle_rev"));
        let to = if rotary { "error_arcsec" } else { "error_um" };
        let words = candidates.iter().find(|candidate| {
            candidate.samples.holds == Holds::Words && candidate.meaning().ends_with("error")
        });
        let but = words.map_or_else(String::new, |candidate| {
            format!(", and {} holds words", quoted(&candidate.header.name))
        });
        let text = format!("no column is known as the measured error{but}");
        decisions.question_at(&names_line(candidates), &text, answers(&free, to));
    }
    let even = decisions.given("table", "period_s").is_some();
    let numbers = candidates.iter().any(|candidate| candidate.samples.holds == Holds::Numbers);
    if !has(&COORDINATES) && !has(&[COUNT]) && !even && numbers {
        // The one column there is holds what was measured.
        let free = if free.len() == 1 && !has(&OBSERVED) { &[] } else { free.as_slice() };
        let mut ways = answers(free, "position_mm");
        let rising: Vec<String> = candidates
            .iter()
            .filter(|candidate| free.contains(&candidate.header.name) && may_be_time(candidate))
            .map(|candidate| candidate.header.name.clone())
            .collect();
        ways.extend(answers(&rising, "time_s"));
        ways.push(Answer {
            label: "a row comes every so many seconds".to_owned(),
            recipe: "[table]\nperiod_s = 0.001".to_owned(),
        });
        let text = "no column is known as position or time";
        decisions.question_at(&names_line(candidates), text, ways);
    }
}

/// The line of the names.
fn names_line(candidates: &[Candidate<'_>]) -> Place {
    let mut place = candidates[0].header.place.clone();
    place.at.column = None;
    place
}
