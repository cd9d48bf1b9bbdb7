//! The keys of `answer.json` and of `challenge --score --json`; they do not change.

use std::collections::BTreeMap;

use helixlock_lab::{Challenge, Experimented, Figure, Hidden, Outcome, Score, Share};
use helixlock_plant::{Parameter, Term};

use crate::shared::keys::keys;

keys! {
    AnswerJson<'a>(task: &'a Challenge, seed: u64) {
        seed: u64 = seed,
        effects: Vec<HiddenJson<'a>> = task.terms.iter().map(HiddenJson::new).collect(),
        outside_the_catalogue: Option<&'a str> = match &task.hidden {
            Hidden::Outside(name) => Some(name),
            _ => None,
        },
        noise_um: f64 = task.noise_um,
        hidden_rms_um: f64 = task.hidden_um,
    }

    HiddenJson<'a>(term: &'a Term) {
        effect: &'a str = &term.name,
        parameters: BTreeMap<String, f64> =
            term.parameters.iter().map(Parameter::key).zip(term.values.iter().copied()).collect(),
    }

    /// The counts and each figure.
    ScoreJson<'a>(score: &'a Score) {
        outcomes: Vec<OutcomeJson> =
            score.outcomes.iter().map(|(words, number)| OutcomeJson::new(*words, *number)).collect(),
        figures: Vec<FigureJson> =
            score.figures.iter().map(|(figure, share)| FigureJson::new(*figure, *share)).collect(),
        mean_rms_before_um: f64 = score.mean_rms_um()[0],
        mean_holdout_rms_um: f64 = score.mean_rms_um()[1],
        seeds_to_look_at: &'a [u64] = &score.wrong,
    }

    ExperimentedJson<'a>(one: &'a Experimented, seed: u64) {
        seed: u64 = seed,
        hidden: &'a str = &one.hidden,
        verdict_before: &'static str = one.before.0.word(),
        right_before: bool = one.before.1 == Outcome::Right,
        advised: Option<&'a str> = one.advised.as_ref().map(|(action, _)| action.as_str()),
        expected_evidence: Option<f64> = one.advised.as_ref().map(|(_, evidence)| *evidence),
        verdict_after: Option<&'static str> = one.after.map(|after| after.0.word()),
        right_after: Option<bool> = one.after.map(|after| after.1 == Outcome::Right),
    }

    OutcomeJson(words: (&'static str, &'static str), number: u64) {
        hidden: &'static str = words.0,
        outcome: &'static str = words.1,
        number: u64 = number,
    }

    FigureJson(figure: Figure, share: Share) {
        figure: &'static str = figure.words(),
        yes: f64 = share.yes,
        of: f64 = share.of,
        share_pct: f64 = share.pct(),
        interval_pct: [f64; 2] = share.interval_pct(),
        target_pct: [f64; 2] = figure.target_pct(),
    }
}
