//! Mistakes of input, asked for before physics: does a sign, a unit, a swap or a shift explain
//! more with less than any effect?
//!
//! Each mistake is a hypothesis without a free number (a shift has one) before one court: twice
//! the log likelihood under noise fitted to what it leaves, with what workshops are usually like,
//! less the price of all looks. It must beat the file as it is, the file without its effects, and
//! the file's effects at any size, of several sensors on one alone too; a shift also an effect of the
//! catalogue that delays, a unit of places one of whole waves a turn.

mod along;
mod backwards;
mod clock;
mod column;
mod common;
mod convention;
mod court;
mod direction;
mod dividers;
mod doubt;
mod factor;
mod hypothesis;
mod late;
mod law;
mod lead;
mod order;
mod readings;
mod scale;
mod shift;
mod slip;
mod stretch;
mod stuck;
mod swap;
mod view;
mod worst_pass;

use crate::model::{Problem, noises_of};
use crate::policy::extent::SEARCHED_ROWS;

use court::Court;
pub use dividers::divider_doubt;
pub use doubt::Doubt;
pub(crate) use doubt::Suspect;
use hypothesis::Hypothesis;

/// Most mistakes in one file: each is looked for with the others mended.
const MOST: usize = 3;

/// What looks mistaken in a measurement or in its machine file; empty for sound input.
///
/// The largest evidence comes first. Looks at no more than a few thousand rows.
#[must_use]
pub fn doubts(problem: &Problem) -> Vec<Doubt> {
    doubts_and_suspects(problem).0
}

/// The same, and where nothing is doubted, what may yet be a mistake.
#[must_use]
pub(crate) fn doubts_and_suspects(problem: &Problem) -> (Vec<Doubt>, Vec<Suspect>) {
    let misplaced = along::runs_along(problem).or_else(|| swap::place_for_error(problem));
    if let Some(doubt) = misplaced {
        return (vec![doubt], Vec::new());
    }
    let contradicting = contradicting(problem);
    if !contradicting.is_empty() {
        return (contradicting, Vec::new());
    }
    let small = problem.thinned(SEARCHED_ROWS);
    // Laid out anew, so that a mend changes nothing but what it mends.
    let small = small.and_then(|small| Problem::new(&small.model, &small.measurement).ok());
    let mut now = small.unwrap_or_else(|| problem.clone());
    let mut doubts: Vec<Doubt> = Vec::new();
    while doubts.len() < MOST {
        let (mistake, suspects) = judged(&now);
        let is_new = |one: &Hypothesis| doubts.iter().all(|other| other.mend != one.mend);
        let Some(one) = mistake.filter(is_new) else {
            if doubts.is_empty() {
                doubts.extend(scale::another_scale(&now));
            }
            return (doubts, suspects);
        };
        doubts.push(one.doubt());
        now = one.mended;
    }
    (doubts, Vec::new())
}

/// The clearest mistake, and what may be one. Readings beside their rows are judged without the
/// ends of passes.
fn judged(problem: &Problem) -> (Option<Hypothesis>, Vec<Suspect>) {
    let all = hypotheses(problem);
    let apart = slip::apart_from_ends(problem);
    let slips = if follows_steps(problem) { Vec::new() } else { slip::slips(&apart) };
    let looks = all.len() + slips.len();
    // Hardly ever is there one, and a court works out what a bare machine would show.
    let slipped = (!slips.is_empty()).then(|| Court::of(&apart, looks).judged(slips).0).flatten();
    let (mistake, suspects) = Court::of(problem, looks).judged(all);
    let clearest = mistake.into_iter().chain(slipped).min_by(Hypothesis::said_before);
    (clearest, suspects)
}

/// What contradicts itself, whatever effects fit; the rest is told only when that is mended.
fn contradicting(problem: &Problem) -> Vec<Doubt> {
    let measurement = &problem.measurement;
    let clock =
        clock::restarted(measurement).or_else(|| clock::contradicted(measurement, &problem.model));
    let readings = readings::of_no_instrument(problem);
    let stuck = stuck::stuck(measurement);
    direction::denied(measurement).into_iter().chain(clock).chain(readings).chain(stuck).collect()
}

fn hypotheses(problem: &Problem) -> Vec<Hypothesis> {
    let odd = worst_pass::worst_pass(problem);
    // Of waves on a drift, either the noise of the file as it is or that of neighbours tells more.
    let noises = [noises_of(problem, &problem.residual()), view::rough_noises(problem)];
    let mut all = column::units(problem, odd);
    all.extend(column::signs(problem, odd));
    all.extend(backwards::backwards(problem, odd));
    all.extend(swap::swaps(problem));
    all.extend(shift::shifts(problem, odd, &noises));
    all.extend(dividers::other_dividers(problem));
    all.extend(lead::leads(problem));
    all.extend(stretch::stretches(problem, &noises));
    all.extend(order::other_orders(problem, &noises));
    if !follows_steps(problem) {
        all.extend(factor::factors(problem, odd, &noises));
        all.extend(late::late_logs(problem, &noises));
        all.extend(convention::conventions(problem));
        all.extend(hypothesis::another_machine(problem));
        all.extend(odd.and_then(|pass| hypothesis::another_machine_in(problem, pass)));
    }
    all
}

/// True when the prediction holds what logged steps have moved.
///
/// What they corrected is not in the error: an effect that the file lacks then looks like a
/// prediction that should be smaller, or not be there.
fn follows_steps(problem: &Problem) -> bool {
    problem.measurement.covariates.contains_key("steps")
}

#[cfg(test)]
mod tests;
