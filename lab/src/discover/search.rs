//! The search for formulas: named effects first, then the grammar in their place and beside them,
//! one formula a round until what is left is noise.

use helixlock_plant::Role;

use super::held::{lost_part, takes_its_share};
use super::orders::is_named;
use super::proposal::{Granted, Proposal};
use crate::answer::{
    Advice, FarReadings, FittedEffect, LoudPass, accepted_beyond, apart, effects, far_readings,
    loud_passes,
};
use crate::doubts::{Doubt, doubts_and_suspects};
use crate::formulas::{Delta, Shape, formulas};
use crate::hypotheses::{
    Likelihood, Structure, at_targets, between_ways, disagreements, is_left, no_all_clear,
    samples_a_pass, slow_cause, slow_or_smooth, structures,
};
use crate::model::{Columns, Component, Fit, Problem, State, helps_unseen, holdout_rms};
use crate::noise::{rms, weighed_rms};
use crate::numerics::count;
use crate::policy::chance::SIGNIFICANCE;
use crate::policy::evidence::MARGIN;
use crate::policy::extent::{MOST_FORMULAS, SEARCHED_ROWS};
use crate::search::{
    Claim, Rivals, Step, claims, hear, in_place_of, left_at_targets, nobodys, paid,
    paid_by_formula, polished, pruned, rivals, running_off, search, suspected, tried_beside,
};

/// Runners-up that experiments are to tell from a proposal.
const NEAREST: usize = 2;

/// What can be said of a model and a measurement when formulas may be said, too.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// Formulas explain what no name does: a proposal.
    Formula,
    /// The named effects explain the data, and no formula does better.
    Name,
    /// The model leaves nothing but noise.
    Nothing,
    /// Structure is left that no formula of the grammar accounts for either.
    Unexplained,
    /// The data or the machine file look mistaken; nothing is proposed.
    DoubtfulInput,
}

impl Found {
    /// As results spell it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Formula => "explained-by-a-formula",
            Self::Name => "explained-by-name",
            Self::Nothing => "nothing-missing",
            Self::Unexplained => "unexplained",
            Self::DoubtfulInput => "doubtful-input",
        }
    }
}

/// Formulas for what no name explains.
#[derive(Debug, Clone)]
pub struct Discovery {
    /// The verdict.
    pub found: Found,
    /// What looks mistaken, by evidence.
    pub doubts: Vec<Doubt>,
    /// Formulas, in the order they were found.
    pub proposals: Vec<Proposal>,
    /// Named effects that stay beside them, fitted together with them.
    pub effects: Vec<FittedEffect>,
    /// Root mean square before and after, µm (arcsec), on the data seen.
    pub rms_um: [f64; 2],
    /// The same on held-out data.
    pub holdout_rms_um: [f64; 2],
    /// Independent samples that a pass of what is left is worth: few, and slow causes may be in it.
    pub samples_a_pass: f64,
    /// Readings that lie far from the rest and weigh little, if there are any.
    pub far_readings: Option<FarReadings>,
    /// Passes that weigh less.
    pub loud_passes: Vec<LoudPass>,
    /// What is left that is not noise.
    pub residual: Vec<Structure>,
    /// Experiments that would tell the proposals from their runners-up, best first.
    pub experiments: Vec<Advice>,
}

/// Looks for formulas that explain what the named effects do not.
///
/// Nothing is searched for in mistaken input. The search works on at most a few thousand rows,
/// means of neighbours where there are more; figures that are reported are fitted to all rows.
#[must_use]
pub fn discover(problem: &Problem) -> Discovery {
    let (doubts, suspects) = doubts_and_suspects(problem);
    if !doubts.is_empty() {
        return doubtful(problem, doubts);
    }
    let mut small = problem.thinned(SEARCHED_ROWS).unwrap_or_else(|| problem.clone());
    let (named, mut steps) = Now::named(&mut small);
    if let Some(doubt) = suspected(&small, &named.state, &named.found, &suspects).doubt {
        return doubtful(problem, vec![doubt]);
    }
    let shapes = formulas(&small);
    let mut now = named.with_formulas(&small, &shapes);
    let mut of_targets = now.of_targets(problem, &small, &steps);
    if of_targets.is_some() {
        small = small.with_targets_free();
        (now, steps) = Now::again(&mut small, &shapes);
    }
    if let Some(each_way) = left_at_targets(problem, &small, &now.state, between_ways) {
        small = small.with_ways_free();
        (now, steps) = Now::again(&mut small, &shapes);
        of_targets = Some(each_way);
    }
    let mut answer = now.told(problem, &small, &steps);
    if let Some(own_errors) = of_targets {
        answer.residual.push(own_errors);
        answer.found = Found::Unexplained;
    } else if answer.found == Found::Unexplained {
        let beside = beside_accepted(problem, &answer, &shapes, &steps);
        answer = beside.unwrap_or(answer);
    }
    answer
}

/// The answer beside the names of a diagnosis, where a search on fewer rows finds waves that an answer lacks.
fn beside_accepted(
    problem: &Problem,
    answer: &Discovery,
    shapes: &[Shape],
    steps: &[Step],
) -> Option<Discovery> {
    let accepted = accepted_beyond(problem, &answer.effects)?;
    let mut small = problem.thinned(SEARCHED_ROWS).unwrap_or_else(|| problem.clone());
    let first = accepted.on(&small)?;
    small.mark_outliers(&first.fit.left);
    let state = first.on(&small)?;
    let named = Now { state, found: Vec::new(), granted: Vec::new(), names_stay: true };
    Some(named.with_formulas(&small, shapes).told(problem, &small, steps))
}

/// The answer to mistaken input.
fn doubtful(problem: &Problem, doubts: Vec<Doubt>) -> Discovery {
    let left = told(problem, &State::bare(problem));
    Discovery { found: Found::DoubtfulInput, doubts, ..left }
}

/// The model while formulas are looked for: those granted so far are its last components.
#[derive(Clone)]
struct Now {
    state: State,
    /// What was tried in the place of its effects, by which they pay for their looks.
    found: Vec<Rivals>,
    granted: Vec<Granted>,
    /// True where no formula may stand in the place of a name.
    names_stay: bool,
}

impl Now {
    /// The model of the named effects alone, and the steps to it.
    fn named(problem: &mut Problem) -> (Self, Vec<Step>) {
        let steps = search(problem);
        let state = steps[steps.len() - 1].state.clone();
        let found = rivals(problem, &state, &steps[0].tried);
        (Self { state, found, granted: Vec::new(), names_stay: false }, steps)
    }

    /// The same with formulas, of a problem in which more is left free.
    fn again(problem: &mut Problem, shapes: &[Shape]) -> (Self, Vec<Step>) {
        let (named, steps) = Self::named(problem);
        (named.with_formulas(problem, shapes), steps)
    }

    /// It with as many formulas as may join; one that is lost beside a later one leaves its place to another.
    fn with_formulas(self, problem: &Problem, shapes: &[Shape]) -> Self {
        let mut now = self;
        for _ in 0..2 * MOST_FORMULAS {
            now = now.without_lost(problem);
            let has_room = now.granted.len() < MOST_FORMULAS;
            match has_room.then(|| now.with_one_more(problem, shapes)).flatten() {
                Some(next) => now = next,
                None => return now.without_gone(problem),
            }
        }
        now.without_lost(problem).without_gone(problem)
    }

    /// The same without names of which nothing is left beside the formulas: a file cannot say the square of a size
    /// that would have to be negative.
    fn without_gone(self, problem: &Problem) -> Self {
        let named = self.state.components.len() - self.granted.len();
        let gone: Vec<usize> = (0..named).filter(|&index| is_gone(&self.state, index)).collect();
        if gone.is_empty() {
            return self;
        }
        let state = self.state.settled_without(problem, &gone);
        Self { state: state.unwrap_or_else(|| self.state.clone()), ..self }
    }

    /// What targets show at every visit, where no formula explains it, or none better than errors of their own do.
    fn of_targets(&self, problem: &Problem, small: &Problem, steps: &[Step]) -> Option<Structure> {
        let State { fit, components, .. } = &self.state;
        let named = components.len() - self.granted.len();
        let paid = |index: usize| {
            if index < named {
                return paid(small, &self.state, steps, index);
            }
            let one = &self.granted[index - named];
            let others = Columns::of_model(small, &self.state.without(&[index]));
            let of =
                |others| paid_by_formula(small, others, &fit.noises, (&one.columns, one.looks));
            others.as_ref().map_or(0.0, of)
        };
        let left = left_at_targets(problem, small, &self.state, at_targets);
        left.or_else(|| in_place_of(small, &self.state, paid))
    }

    /// The model with the best formula that may join, and whose sizes the data hold; of those in its place that the
    /// data cannot tell from it, the one of the fewest numbers. `None` when none may.
    fn with_one_more(&self, problem: &Problem, shapes: &[Shape]) -> Option<Self> {
        let claims = claims(problem, &self.state, &self.found, shapes);
        let mut best: Option<(&Claim<'_>, Self)> = None;
        for claim in &claims {
            let is_alike = |(first, _): &(&Claim<'_>, Self)| {
                first.group == claim.group && first.ahead - claim.ahead < MARGIN
            };
            let is_worth = best.as_ref().is_none_or(|best| {
                is_alike(best) && claim.placed.shape.fewest_numbers() < best.1.last_numbers()
            });
            if !is_worth || self.kept_out(problem, claim).is_some() {
                continue;
            }
            let next = self.with(problem, &claims, claim)?;
            let Some(next) = next.held(problem, next.granted.len() - 1) else { continue };
            best = match best {
                None => Some((claim, next)),
                Some((first, now)) if next.last_numbers() < now.last_numbers() => {
                    Some((first, next))
                }
                now => now,
            };
        }
        best.map(|(_, next)| next)
    }

    /// Numbers of its last formula.
    fn last_numbers(&self) -> usize {
        self.granted.last().map_or(0, |last| last.shape.numbers())
    }

    /// The model with one formula more, all others of a list its runners-up.
    fn with(&self, problem: &Problem, claims: &[Claim<'_>], best: &Claim<'_>) -> Option<Self> {
        let mut others: Vec<(&Claim<'_>, Option<&'static str>)> = Vec::new();
        for other in claims {
            if !is_same(best, other) && !others.iter().any(|(known, _)| is_same(known, other)) {
                let is_ahead = best.ahead < other.ahead;
                let why = if is_ahead { self.kept_out(problem, other) } else { None };
                others.push((other, why));
            }
        }
        let named = self.state.components.len() - self.granted.len();
        let name = format!("formula {}", self.granted.len() + 1);
        let delta = Delta::of(problem);
        let one = Granted::new(&name, delta, &self.state, best, &others).ok()?;
        let mut granted: Vec<Granted> = Vec::new();
        for (place, known) in self.granted.iter().enumerate() {
            if !best.group.contains(&(named + place)) {
                granted.push(known.clone());
            }
        }
        let mut components = self.state.without(&best.group);
        components.push(Component::new(one.term.clone()));
        granted.push(one);
        let state = State::settled(problem, components, &best.fit.noises)?;
        let state = in_the_middle(problem, polished(problem, state));
        Some(Self { state, found: Vec::new(), granted, ..*self })
    }

    /// Why a claim may not join; in the place of names it must leave no more than they do.
    fn kept_out(&self, problem: &Problem, claim: &Claim<'_>) -> Option<&'static str> {
        let named = self.state.components.len() - self.granted.len();
        if claim.group.iter().any(|&index| index < named) {
            if self.names_stay {
                return Some("the names are found on fewer rows");
            }
            if self.leaves_more(problem, claim) {
                return Some("leaves more than the names");
            }
        }
        if claim
            .placed
            .order()
            .is_some_and(|order| is_named(problem, &self.state.components, order))
        {
            return Some("not told from a listed shaft");
        }
        kept_out(problem, &self.state, claim)
    }

    /// True where a shape leaves more than what it stands in the place of; numbers that it does without are worth to it
    /// what they cost.
    fn leaves_more(&self, problem: &Problem, claim: &Claim<'_>) -> bool {
        let rms_um = |fit: &Fit| weighed_rms(&problem.layout, &fit.left);
        let names = claim.group.iter().map(|&index| self.state.components[index].price(problem));
        let saved = names.sum::<f64>() - claim.placed.shape.price(problem.price_of_a_number());
        let worth = libm::exp(0.5 * saved.max(0.0) / count(problem.samples.len()));
        worth * rms_um(&self.state.fit) < rms_um(&claim.fit)
    }

    /// The same without what of a formula is lost in its error; `None` where that makes it, or where it takes less
    /// than its share.
    fn held(&self, problem: &Problem, place: usize) -> Option<Self> {
        let index = self.state.components.len() - self.granted.len() + place;
        if !takes_its_share(problem, &self.state, index) {
            return None;
        }
        let one = &self.granted[place];
        let Some(part) = lost_part(problem, &self.state, index, &one.shape) else {
            return Some(self.clone());
        };
        let now = self.state.components[index].valued(self.state.coefficients(index).0);
        let fewer = one.without(part, &now, Delta::of(problem))?;
        let mut components = self.state.components.clone();
        components[index] = Component::new(fewer.term.clone());
        let state = State::settled(problem, components, &self.state.fit.noises)?;
        let mut granted = self.granted.clone();
        granted[place] = fewer;
        let found = self.found.clone();
        Self { state: polished(problem, state), found, granted, ..*self }.held(problem, place)
    }

    /// The same without formulas, or parts of them, whose size is lost in its error beside later ones.
    fn without_lost(mut self, problem: &Problem) -> Self {
        let mut place = 0;
        while place < self.granted.len() {
            if let Some(held) = self.held(problem, place) {
                (self, place) = (held, place + 1);
                continue;
            }
            let index = self.state.components.len() - self.granted.len() + place;
            let Some(state) = self.state.settled_without(problem, &[index]) else { return self };
            self.granted.remove(place);
            (self.state, place) = (polished(problem, state), 0);
        }
        self
    }

    /// What is left that is not noise, as `diagnose` asks for it, and the names that a shape without one takes out: of
    /// a model without formulas what may not be named, too, which else one would have explained.
    fn left(&self, small: &Problem, steps: &[Step]) -> (Vec<Structure>, Vec<usize>) {
        let State { columns, fit, .. } = &self.state;
        let is_named = self.granted.is_empty();
        let mut left = structures(small, columns, fit);
        let mut beaten = Vec::new();
        if is_named {
            left.extend(nobodys(small, steps));
            if let Some(won) = hear(small, &self.state, &self.found).winner {
                left.push(won.shown);
                beaten = won.beaten;
            } else {
                let (off, shown) = running_off(small, &self.state);
                left.extend(shown);
                beaten = off;
            }
        }
        if is_named && left.is_empty() {
            left.extend(slow_or_smooth(small, &self.state, tried_beside(steps)));
        }
        left.extend(disagreements(small, &self.state).into_iter().map(|one| one.differs));
        // Of so many shapes one follows slow noise: beside it none is believed to be noise.
        let slow = match (is_named, left.is_empty()) {
            (true, _) => no_all_clear(small, &self.state, &left),
            (false, nothing_else) => nothing_else.then(|| slow_cause(small, fit)).flatten(),
        };
        left.extend(slow);
        (left, beaten)
    }

    /// The same without some names, and without those that are superfluous then.
    fn without(self, problem: &Problem, names: &[usize]) -> Self {
        if names.is_empty() {
            return self;
        }
        let state = self.state.settled_without(problem, names);
        let state = state.map_or_else(|| self.state.clone(), |state| pruned(problem, state).0);
        Self { state, ..self }
    }

    /// The answer, fitted to all rows.
    fn told(self, problem: &Problem, small: &Problem, steps: &[Step]) -> Discovery {
        let (residual, beaten) = self.left(small, steps);
        self.without(small, &beaten).with_rest(problem, small, residual)
    }

    /// The same, where it is known what is left.
    fn with_rest(&self, problem: &Problem, small: &Problem, residual: Vec<Structure>) -> Discovery {
        let mut whole = problem.clone();
        let state = if small.samples.len() == problem.samples.len() {
            whole = small.clone();
            self.state.clone()
        } else {
            let first = self.state.on(&whole).unwrap_or_else(|| State::bare(&whole));
            whole.mark_outliers(&first.fit.left);
            polished(&whole, self.state.on(&whole).unwrap_or(first))
        };
        let named = state.components.len() - self.granted.len();
        let proposed = |(place, one): (usize, &Granted)| {
            one.proposed(&state, (small, &self.state), named + place)
        };
        let proposals: Vec<Proposal> = self.granted.iter().enumerate().map(proposed).collect();
        let mut experiments = Vec::new();
        for (one, proposal) in self.granted.iter().zip(&proposals) {
            let nearest = &one.rivals[..one.rivals.len().min(NEAREST)];
            experiments.extend(apart(small, &self.state.fit.noises, &proposal.term, nearest));
        }
        experiments.sort_by(|a, b| b.evidence.total_cmp(&a.evidence));
        let mut answer = told(&whole, &state);
        answer.residual = residual;
        if answer.residual.is_empty() {
            answer.residual.extend(answer.no_gain());
        }
        answer.effects.truncate(named);
        answer.found = match (proposals.is_empty(), answer.residual.is_empty()) {
            (_, false) => Found::Unexplained,
            (false, true) => Found::Formula,
            (true, true) if named == 0 => Found::Nothing,
            (true, true) => Found::Name,
        };
        Discovery { proposals, experiments, ..answer }
    }
}

impl Discovery {
    /// What is left where effects and formulas leave no less than there was, of all rows or of held-out ones.
    fn no_gain(&self) -> Option<Structure> {
        let no_less = |[before, after]: [f64; 2]| before <= after;
        let is_vain = no_less(self.rms_um) || no_less(self.holdout_rms_um);
        let shape = "no less than there was";
        (!self.effects.is_empty() && is_vain)
            .then(|| Structure::without_place("time", shape, self.rms_um[1], 1.0))
    }
}

/// A model's figures, nothing proposed.
fn told(problem: &Problem, state: &State) -> Discovery {
    let bare = State::bare(problem);
    let size = |state: &State| rms(&problem.layout, &state.fit.left);
    let unseen = |state: &State| holdout_rms(problem, &state.columns, &state.fit.noises);
    Discovery {
        found: Found::Nothing,
        doubts: Vec::new(),
        proposals: Vec::new(),
        effects: effects(problem, state),
        rms_um: [size(&bare), size(state)],
        holdout_rms_um: [unseen(&bare), unseen(state)],
        samples_a_pass: samples_a_pass(problem, &state.fit),
        far_readings: far_readings(problem, &state.fit.left),
        loud_passes: loud_passes(problem),
        residual: Vec::new(),
        experiments: Vec::new(),
    }
}

/// Why a claim may not join: it must be ahead by the margin and help on unseen data. Beside all others it must be
/// beyond chance and large enough, which of what it would take the place of is known.
fn kept_out(problem: &Problem, state: &State, claim: &Claim<'_>) -> Option<&'static str> {
    let is_chance = claim.group.is_empty() && SIGNIFICANCE <= claim.p_value;
    if claim.ahead <= MARGIN || is_chance {
        return Some("not beyond chance");
    }
    let helps = Columns::of_model(problem, &state.without(&claim.group)).is_ok_and(|base| {
        let columns = base.and(&claim.placed.columns);
        helps_unseen(problem, (&columns, &claim.fit.noises), (&base, &state.fit.noises))
    });
    if !helps {
        return Some("no better on held-out data");
    }
    let is_small = claim.group.is_empty() && !is_left(problem, &state.fit, &claim.shown(problem));
    is_small.then_some("too small to change a figure")
}

/// A model whose last component has its nonlinear values in the middle of where they may be.
fn in_the_middle(problem: &Problem, state: State) -> State {
    let last = state.components.len() - 1;
    let Some(likelihood) = Likelihood::of(problem, &state, last) else { return state };
    let mut values = state.components[last].term.nonlinear();
    let moves: Vec<f64> = (0..values.len()).map(|place| likelihood.to_the_middle(place)).collect();
    if moves.iter().all(|by| *by == 0.0) {
        return state;
    }
    values.iter_mut().zip(moves).for_each(|(value, by)| *value += by);
    let mut components = state.components.clone();
    components[last].term = components[last].term.with_nonlinear(&values);
    State::settled(problem, components, &state.fit.noises).unwrap_or(state)
}

/// True for an effect whose square is fitted as nothing or less.
fn is_gone(state: &State, index: usize) -> bool {
    let term = state.components[index].valued(state.coefficients(index).0);
    let mut values = term.parameters.iter().zip(&term.values);
    values.any(|(what, value)| what.role == Role::Squared && *value <= 0.0)
}

fn is_same(a: &Claim<'_>, b: &Claim<'_>) -> bool {
    a.placed.shape.words == b.placed.shape.words && a.placed.shape.along == b.placed.shape.along
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use helixlock_plant::{Entry, Model};
    use helixlock_traces::{Column, Table};
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal};

    use super::super::held::takes_its_share;
    use super::*;
    use crate::measurement::{Measurement, Nominal};
    use crate::model::Stage;

    const MACHINE: &str = r#"
[workpiece]
lead = "6 mm"
[spindle]
speed = "6 rpm"
[grating]
lines = 13906
[laser]
wavelength = "0.63281983 um"
[dividers]
a = 110
b = 150
[drive]
step = "0.0125 um"
frequency = "160 Hz"
"#;

    /// Two passes of 100 samples over 400 mm with noise of 0.05 µm, and a table motion.
    fn problem(seed: u64, motion_um: impl Fn(f64) -> f64) -> Problem {
        let machine = Model::parse(MACHINE, Path::new("machine.toml")).expect("a machine");
        let mut chance = ChaCha8Rng::seed_from_u64(seed);
        let rows: Vec<(f64, f64)> =
            (0..200_u32).map(|row| (f64::from(row / 100), 4.0 * f64::from(row % 100))).collect();
        let column = |name: &str, values: Vec<f64>| Column { name: name.into(), values };
        let table = Table::new(vec![
            column("pass", rows.iter().map(|(pass, _)| *pass).collect()),
            column("position_mm", rows.iter().map(|(_, x)| *x).collect()),
            column("error_um", vec![0.0; rows.len()]),
        ]);
        let measurement = Measurement::from_table(&table, &Nominal::of(&machine));
        let mut problem =
            Problem::new(&machine, &measurement.expect("a measurement")).expect("all columns");
        // What the dividers leave of the lead is in the data, as it is in the model.
        for (row, (_, x)) in rows.iter().enumerate() {
            let noise: f64 = StandardNormal.sample(&mut chance);
            problem.observed[row] = problem.predicted[row] + 0.05 * noise - motion_um(*x);
        }
        problem
    }

    #[test]
    fn nothing_is_proposed_on_noise() {
        for seed in 0..3 {
            let found = discover(&problem(seed, |_| 0.0));
            assert_eq!(found.found, Found::Nothing, "seed {seed}: {:?}", found.proposals);
        }
    }

    /// The likelihood has a peak near every sample there: as a parabola, the highest of them is 14 and 8
    /// errors off.
    #[test]
    #[ignore = "long: `cargo xtask campaign` runs it"]
    fn where_a_root_begins_is_as_sure_as_it_is_told() {
        for (seed, at_mm) in [(20, 63.0), (52, 104.6)] {
            let found = discover(&problem(seed, |x| 0.1 * (x - at_mm).max(0.0).sqrt()));
            let parameters = &mut found.proposals[0].parameters.iter();
            let one = parameters.find(|what| what.name == "at_mm").expect("where it begins");
            let stderr = one.stderr.expect("an error");
            assert!((one.value - at_mm).abs() < 2.0 * stderr, "{one:?} {at_mm}");
        }
    }

    /// Ahead of a cubic by 17, where a shape beside names needs 18.
    #[test]
    fn what_takes_a_name_away_is_proposed_in_its_place() {
        let found = discover(&problem(0, |x| 0.4 * libm::exp(-x / 60.0)));
        assert_eq!(found.found, Found::Formula, "{:?}", found.residual);
        let proposal = &found.proposals[0];
        assert!(found.effects.is_empty() && proposal.instead_of == ["screw-progressive"]);
        assert_eq!(proposal.shape, "decay");
    }

    /// Whether a step does whose sizes are so many times those that leave least.
    fn step_takes_its_share(times: f64) -> bool {
        let problem = problem(1, |x| if x < 201.0 { 0.0 } else { 10.0 });
        let bare = State::bare(&problem);
        let shapes = formulas(&problem);
        let shape = shapes.iter().find(|shape| shape.words == "step at one place").expect("a step");
        let stage = Stage::new(&problem, &bare.columns, &bare.fit.noises);
        let placed = shape.best(&[&stage], Entry::Motion).pop().flatten().expect("a place");
        let step = Component::new(placed.term("step").expect("a term"));
        let mut model = State::settled(&problem, vec![step], &bare.fit.noises).expect("a fit");
        model.fit.linear.coefficients.iter_mut().for_each(|size| *size *= times);
        model.fit.left = model.columns.left(&problem.residual(), &model.fit.linear.coefficients);
        takes_its_share(&problem, &model, 0)
    }

    /// As under noise that follows the curve, which leaves of it what one sample differs from the next.
    #[test]
    fn what_leaves_more_than_least_squares_would_does_not_take_its_share() {
        assert!(step_takes_its_share(1.0) && step_takes_its_share(0.4));
        assert!(!step_takes_its_share(0.25) && !step_takes_its_share(-1.0));
    }

    #[test]
    fn a_root_is_found_with_its_values() {
        let found = discover(&problem(1, |x| 0.1 * (x - 40.0).max(0.0).sqrt()));
        assert_eq!(found.found, Found::Formula, "{found:?}");
        let proposal = &found.proposals[0];
        assert_eq!(proposal.formula, "size*sqrt(ramp(position_mm - at_mm))");
        for (name, truth, unit) in [("size", 0.1, "µm/mm^0.5"), ("at_mm", 40.0, "mm")] {
            let parameters = &mut proposal.parameters.iter();
            let one = parameters.find(|what| what.name == name).expect(name);
            let stderr = one.stderr.expect("an error");
            assert!((one.value - truth).abs() < 3.0 * stderr, "{one:?}");
            assert_eq!(one.unit, unit);
        }
    }
}
