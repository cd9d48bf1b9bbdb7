//! One judge for all mistakes: evidence against the file as it is, and against its effects at any
//! size or none.

use std::cell::OnceCell;

use helixlock_plant::{CATALOGUE, Card, Entry, Model, Parameter, Role, Search, Term};

use super::column::all_physics;
use super::common::{curve_of, curves, slopes};
use super::doubt::Suspect;
use super::hypothesis::{Hypothesis, with_effects};
use super::view::{View, rough_noises};
use super::worst_pass::{saying, silent, worst_pass};
use crate::formulas::{Placed, nameless};
use crate::hypotheses::{candidate, however_begun, try_candidate};
use crate::model::{Columns, Component, Fit, Problem, Stage, noises_of, settle, with_noise};
use crate::numerics::count;
use crate::policy::evidence::LOOSELY_KNOWN;
use crate::policy::mistakes::{DOUBT, NEAR_THE_BEST_DOUBT, SMALLER, WORTH_A_FIT};

/// A problem before the court.
pub(super) struct Court<'a> {
    problem: &'a Problem,
    /// What is so common that no mistake is seen by it: nothing, slopes, or curves and drifts too.
    common: [Columns; 3],
    /// The problem where nothing at all is predicted, and that of a machine without effects.
    absent: Vec<Problem>,
    /// Evidence of the best shape without a name, once it was asked for.
    shape: OnceCell<Option<f64>>,
    /// Evidence of the file's own effects at any size, once it was asked for.
    own: OnceCell<OfOwnEffects>,
    /// Evidence of an effect of a log that the file makes nothing of, once it was asked for.
    unheeded: OnceCell<f64>,
    /// What the number of mistakes that are tried costs.
    looks: f64,
}

/// Evidence of the file's own effects at any size, integrated over sizes as large as theirs.
#[derive(Clone, Copy)]
struct OfOwnEffects {
    /// Of one size on all sensors.
    on_all: f64,
    /// On one of several sensors alone: what lags, runs out or was clamped anew changes a wave there.
    on_one: f64,
}

/// Most mistakes whose noise is fitted under either view.
const FITTED: usize = 6;

/// Most effects of known size that are tried in every combination.
const MOST_PHYSICS: usize = 4;

impl<'a> Court<'a> {
    pub(super) fn of(problem: &'a Problem, tried: usize) -> Self {
        let looks = 2.0 * libm::log(count(tried.max(1)));
        let lines = slopes(problem);
        let curves = lines.and(&curves(problem));
        let bare = Model { effects: Vec::new(), ..problem.model.clone() };
        let bare = predicted_by(problem, &bare).filter(|_| !problem.model.effects.is_empty());
        let nothing = vec![0.0; problem.samples.len()];
        let absent = std::iter::once(nothing).chain(bare);
        let absent = absent.map(|predicted| saying(problem, predicted)).collect();
        Self {
            shape: OnceCell::new(),
            own: OnceCell::new(),
            unheeded: OnceCell::new(),
            problem,
            common: [Columns::default(), lines, curves],
            absent,
            looks,
        }
    }

    /// The mistake that beats every other explanation, and those that only the file's own effects at other
    /// sizes, or further ones, explain as well.
    pub(super) fn judged(&self, all: Vec<Hypothesis>) -> (Option<Hypothesis>, Vec<Suspect>) {
        let noises = rough_noises(self.problem);
        let rough = self.view(&noises);
        let plain = View::new(self.problem, &self.common[0], &noises);
        let all: Vec<Hypothesis> =
            all.into_iter().filter(|one| self.told([&rough, &plain], one)).collect();
        if all.is_empty() {
            return (None, Vec::new());
        }
        let (base, fit) = self.evidence(self.problem, &Columns::default());
        let gains = [self.gains(&rough, &all), self.gains(&self.view(&fit.noises), &all)];
        let worth = worth_a_fit(&all, &gains);
        let judged = all.into_iter().zip(worth).filter(|(_, worth)| *worth).map(|(one, _)| one);
        let mut likely: Vec<Hypothesis> = judged
            .map(|one| Hypothesis { evidence: self.own_evidence(&one) - base, ..one })
            .filter(|one| DOUBT < one.evidence)
            .collect();
        likely.sort_by(Hypothesis::said_before);
        let most = likely.iter().map(|one| one.evidence).fold(0.0, f64::max);
        let mut suspects = Vec::new();
        for one in likely {
            let ahead = |rival: f64| one.evidence - (rival - base).max(0.0);
            let of_nothing = ahead(self.nothing(&one));
            let of_one_sensor = ahead(self.freed().on_one);
            let evidence = of_nothing.min(of_one_sensor).min(ahead(self.rival(&one)));
            if DOUBT < evidence {
                return (Some(Hypothesis { evidence, ..one }), suspects);
            }
            let is_near = NEAR_THE_BEST_DOUBT * most <= one.evidence;
            if DOUBT < of_nothing && is_near && one.lateness() == 0 {
                suspects.push(self.suspect(one, of_one_sensor));
            }
        }
        (None, suspects)
    }

    fn suspect(&self, one: Hypothesis, of_one_sensor: f64) -> Suspect {
        let both = self.problem.residual().into_iter().zip(one.mended.residual());
        let change = both.map(|(before, after)| before - after).collect();
        let (price, listed) = (self.price(&one) - self.looks, self.looks);
        Suspect { doubt: one.doubt(), change, price, listed, of_one_sensor, mended: one.mended }
    }

    fn view(&self, noises: &[crate::noise::Noise]) -> View {
        View::new(self.problem, &self.common[2], noises)
    }

    /// True when the data can tell a mistake, and it leaves less than the file as it is: free of slopes and
    /// curves, or with them and not more without; a wrong pressure is a slope first of all,
    /// and a steady one nothing else.
    fn told(&self, [rough, plain]: [&View; 2], one: &Hypothesis) -> bool {
        if DOUBT < one.usual {
            return true;
        }
        // A mistake in one pass is all that is wrong with it.
        if one.pass.is_some() && !one.last_resort() && worst_pass(&one.mended) == one.pass {
            return false;
        }
        let (before, after) = (rough.left(self.problem), rough.left(&one.mended));
        let flatter = plain.left(&one.mended) < SMALLER * plain.left(self.problem);
        let moved: Vec<f64> =
            one.mended.predicted.iter().zip(&self.problem.predicted).map(|(a, b)| a - b).collect();
        let smaller = after < SMALLER * before || flatter && after <= before + WORTH_A_FIT;
        let needed =
            one.lets_go() || self.absent.iter().all(|bare| after < SMALLER * rough.left(bare));
        let is_felt = one.pass.is_some() || WORTH_A_FIT < rough.square(moved) + one.usual;
        is_felt && smaller && needed
    }

    /// What each mistake gains under a fixed noise.
    fn gains(&self, view: &View, all: &[Hypothesis]) -> Vec<f64> {
        let before = view.left(self.problem);
        let gain = |one: &Hypothesis| before - view.left(&one.mended) + one.rescaled + one.usual;
        all.iter().map(gain).collect()
    }

    fn own_evidence(&self, one: &Hypothesis) -> f64 {
        self.evidence(&one.mended, &Columns::default()).0 - self.price(one)
    }

    /// What a mistake pays: its numbers, and all looks; how much more usual it is takes some of it back, and
    /// that observations are written in another unit is no evidence.
    fn price(&self, one: &Hypothesis) -> f64 {
        let numbers = one.numbers * self.problem.price_of_a_number();
        self.looks + 2.0 * libm::log(one.looks) + numbers - one.usual - one.rescaled
    }

    /// Evidence of a prediction of nothing, everywhere or in the pass that is mended, of one that a curve of
    /// that pass puts right, or of a shape without a name beside it where readings of some rows alone would be wrong:
    /// whatever makes a wrong prediction vanish looks like a mend, and so does what shrinks a step.
    fn nothing(&self, best: &Hypothesis) -> f64 {
        let evidence = |problem: &Problem| self.evidence(problem, &Columns::default()).0;
        let absent = self.absent.iter().filter(|_| !best.last_resort()).map(evidence);
        let in_pass = best.pass.filter(|_| !best.last_resort());
        let in_pass = in_pass.map(|pass| evidence(&silent(self.problem, pass)));
        let grown = best.pass.map(|pass| self.grown(pass));
        let in_places = best.slips || best.pass.is_some();
        let shape = in_places.then(|| *self.shape.get_or_init(|| self.nameless())).flatten();
        absent.chain(in_pass).chain(grown).chain(shape).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Evidence of the file as it is, with a curve of a pass's own: something may have grown while it went on.
    fn grown(&self, pass: usize) -> f64 {
        let curve = curve_of(self.problem, pass);
        let numbers = count(curve.raw.len());
        let (evidence, _) = self.evidence(self.problem, &curve);
        evidence - numbers * self.problem.price_of_a_number()
    }

    /// The best of all other explanations.
    fn rival(&self, best: &Hypothesis) -> f64 {
        let evidence = |other: &Problem| self.evidence(other, &Columns::default()).0;
        let mut rivals = vec![self.freed().on_all, self.unheeded()];
        if best.physics {
            rivals.push(self.loosened());
            rivals.extend(self.with_physics().iter().map(evidence));
        }
        if best.shifts() {
            rivals.extend(self.with_one(|card| card.nature.delays));
        }
        if best.stretches() {
            rivals.extend(
                self.with_one(|card| {
                    card.parameters.iter().any(|what| what.search == Search::Whole)
                }),
            );
        }
        rivals.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// Twice the log likelihood of what a problem predicts with what is common, less the price of that.
    fn evidence(&self, problem: &Problem, more: &Columns) -> (f64, Fit) {
        let of = |common: &Columns| {
            let fit = fitted(problem, &common.and(more));
            let number = self.problem.price_of_a_number();
            let variances = with_the_rest_held(&fit, common.raw.len());
            let price = |(value, variance): (&f64, f64)| {
                libm::log1p(value * value / variance.max(f64::MIN_POSITIVE)).max(number)
            };
            let price: f64 = fit.linear.coefficients.iter().zip(variances).map(price).sum();
            (2.0 * fit.log_likelihood - price, fit)
        };
        let [none, slopes, curves] = &self.common;
        [slopes, curves]
            .into_iter()
            .map(of)
            .fold(of(none), |best, other| if best.0 < other.0 { other } else { best })
    }

    fn freed(&self) -> OfOwnEffects {
        *self.own.get_or_init(|| {
            let effects = self.problem.model.effects.iter();
            let all: Vec<Columns> =
                effects.filter_map(|term| departures(self.problem, term)).collect();
            let sensors = self.problem.sensors.len();
            let alone = (0..sensors).filter(|_| 1 < sensors).map(|sensor| {
                self.integrated(all.iter().map(|columns| on_one(self.problem, columns, sensor)))
            });
            let on_one = alone.fold(f64::NEG_INFINITY, f64::max);
            OfOwnEffects { on_all: self.integrated(all.into_iter()), on_one }
        })
    }

    /// That of the effects of known size that the file does not have, by another factor than the textbook's:
    /// a workpiece of another alloy grows by 1.8 times as much, and is not in °F.
    fn loosened(&self) -> f64 {
        let all = all_physics(self.problem);
        self.integrated(all.iter().filter_map(|term| any_size(self.problem, term)))
    }

    /// That of the likeliest effect of a log that the file has no effect of: where a bed leans, the air is not what was
    /// logged as its pitch.
    fn unheeded(&self) -> f64 {
        *self.unheeded.get_or_init(|| {
            let logged = &self.problem.measurement.covariates;
            let effects = &self.problem.model.effects;
            let heeds = |name: &str| effects.iter().any(|term| term.needs().contains(&name));
            let is_new = |name: &&str| logged.contains_key(*name) && !heeds(name);
            let all = self.with_one(|card| card.needs.iter().any(is_new));
            all.into_iter().fold(f64::NEG_INFINITY, f64::max)
        })
    }

    /// That of each effect of the catalogue of some kind, at its best.
    fn with_one(&self, is_one: impl Fn(&Card) -> bool) -> Vec<f64> {
        let stage = Stage::new(self.problem, &self.common[1], &rough_noises(self.problem));
        let sees = |card: &&Card| is_one(card) && self.problem.sees(card.entry);
        let cards = CATALOGUE.iter().copied().filter(sees);
        let terms = cards.map(|card| Term::candidate(card, self.problem.model.rotary));
        let resting = terms.filter_map(|term| candidate(&stage, term));
        let found = resting.flat_map(|one| however_begun(&stage, one));
        let found = found.filter_map(|one| try_candidate(&stage, &one));
        found.filter_map(|found| self.evidence_beside(&found.component)).collect()
    }

    /// That of the shape without a name that shows most beside the file: what settles after each stop is
    /// followed by a row that stands beside its place.
    fn nameless(&self) -> Option<f64> {
        let shapes = nameless(self.problem);
        let stage = Stage::new(self.problem, &self.common[1], &rough_noises(self.problem));
        let number = self.problem.price_of_a_number();
        let placed = shapes.iter().flat_map(|shape| shape.best(&[&stage], Entry::Motion)).flatten();
        let priced = |placed: Placed<'_>| {
            (placed.price(number, &placed.looks(&stage), placed.gain), placed.gain, placed.columns)
        };
        let best = placed.map(priced).max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)));
        best.map(|(price, _, columns)| self.evidence(self.problem, &columns).0 - price)
    }

    /// Evidence of an effect beside the file's, each of its numbers paid for.
    fn evidence_beside(&self, effect: &Component) -> Option<f64> {
        let columns = Columns::of(self.problem, std::slice::from_ref(effect)).ok()?;
        let counted = usize::from(effect.is_of_one_size());
        let numbers = count(effect.term.nonlinear().len().saturating_sub(counted));
        let (evidence, _) = self.evidence(self.problem, &columns);
        let price = effect.price(self.problem) + numbers * self.problem.price_of_a_number();
        Some(evidence - price)
    }

    fn integrated(&self, columns: impl Iterator<Item = Columns>) -> f64 {
        let more = columns.fold(Columns::default(), |all, one| all.and(&one));
        if more.raw.is_empty() {
            return f64::NEG_INFINITY;
        }
        let (evidence, fit) = self.evidence(self.problem, &more);
        let width = more.raw.len();
        let from = fit.linear.coefficients.len() - width;
        let posterior = fit.linear.covariance.view((from, from), (width, width)).determinant();
        let prior: f64 = more.priors.iter().flatten().map(|(_, sd)| 2.0 * libm::log(*sd)).sum();
        evidence - (prior - libm::log(posterior.max(f64::MIN_POSITIVE))).max(0.0)
    }

    /// The problem with every set of the effects of known size that the file does not have.
    fn with_physics(&self) -> Vec<Problem> {
        let all = all_physics(self.problem);
        let all = &all[..all.len().min(MOST_PHYSICS)];
        let member = |set: usize| move |(index, _): &(usize, &Term)| set & (1 << index) != 0;
        let sets = (1_usize..1 << all.len()).map(|set| {
            all.iter().enumerate().filter(member(set)).map(|(_, term)| term.clone()).collect()
        });
        let model = &self.problem.model;
        let with = |set: Vec<Term>| {
            Some(saying(self.problem, predicted_by(self.problem, &with_effects(model, &set))?))
        };
        sets.filter_map(with).collect()
    }
}

/// Variances of the first coefficients with all behind them held: what those may be is paid for apart, and a
/// column that runs along with a slope must not make the slope cheap.
fn with_the_rest_held(fit: &Fit, width: usize) -> Vec<f64> {
    let covariance = &fit.linear.covariance;
    let rest = covariance.nrows() - width;
    let of_rest = covariance.view((width, width), (rest, rest)).into_owned();
    let across = covariance.view((0, width), (width, rest));
    let told = of_rest.try_inverse().map(|inverse| across * inverse * across.transpose());
    let left = |at: usize| covariance[(at, at)] - told.as_ref().map_or(0.0, |told| told[(at, at)]);
    (0..width).map(left).collect()
}

/// A prediction with its noise, columns free.
fn fitted(problem: &Problem, columns: &Columns) -> Fit {
    let rough = with_noise(&problem.layout, columns, &problem.residual(), &rough_noises(problem));
    settle(problem, columns, &noises_of(problem, &rough.left))
}

fn predicted_by(problem: &Problem, model: &Model) -> Option<Vec<f64>> {
    let other = Problem::new(model, &problem.measurement).ok()?;
    other.has_rows_of(problem).then(|| other.predicted.to_vec())
}

/// Columns of an effect that the file does not have, as large as the textbook says, more or less.
fn any_size(problem: &Problem, term: &Term) -> Option<Columns> {
    let raw = problem.design(term).ok()?.columns;
    let size = |value: &f64| Some((*value, value.abs().max(f64::MIN_POSITIVE.sqrt())));
    let priors: Vec<_> = term.coefficients().iter().map(size).collect();
    (priors.len() == raw.len()).then_some(Columns { raw, priors, fixed: None })
}

/// Columns by which an effect of the file may differ from what the file says: one whose constant is that of a
/// material by any, for another material is in no other unit.
fn departures(problem: &Problem, term: &Term) -> Option<Columns> {
    let raw = problem.design(term).ok()?.columns;
    let values = term.coefficients();
    let size = values.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
    let fixed =
        |what: &Parameter| matches!(what.role, Role::Known { stderr } if stderr < LOOSELY_KNOWN);
    let known = term.parameters.iter().any(fixed);
    let held = term.priors();
    let prior = |at: usize| match held.get(at).copied().flatten() {
        Some((mean, deviation)) if known => (mean - values[at], deviation),
        _ => (0.0, size.max(f64::MIN_POSITIVE.sqrt())),
    };
    let priors = (0..raw.len()).map(|at| Some(prior(at))).collect();
    Some(Columns { raw, priors, fixed: None })
}

/// Columns where one sensor reads.
fn on_one(problem: &Problem, columns: &Columns, sensor: usize) -> Columns {
    let raw = columns.raw.iter().map(|raw| problem.of_rows(sensor, |row| raw[row]).into());
    Columns { raw: raw.collect(), ..columns.clone() }
}

/// Those that gain enough, or nearly as much as the best, under either noise.
fn worth_a_fit(all: &[Hypothesis], gains: &[Vec<f64>; 2]) -> Vec<bool> {
    let mut worth = vec![false; all.len()];
    for gains in gains {
        let best = gains.iter().copied().fold(0.0, f64::max);
        let enough = WORTH_A_FIT.max(NEAR_THE_BEST_DOUBT * best);
        let mut order: Vec<usize> = (0..all.len()).filter(|&at| enough <= gains[at]).collect();
        order.sort_by(|&a, &b| gains[b].total_cmp(&gains[a]));
        for (rank, at) in order.into_iter().enumerate() {
            worth[at] |= rank < FITTED || all[at].last_resort();
        }
    }
    worth
}
