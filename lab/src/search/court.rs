//! Explanations without a name, before the same judge as those that have one.
//!
//! Effects can follow what they do not make: a cubic with a bump follows a kink, sinusoids of two
//! gratings a square wave, a rate of the laser a column that was logged. So every shape without a
//! name is tried in the place of each effect, of several and of all, and beside all of them. Where
//! it explains more, nothing is explained.

use std::collections::BTreeSet;

use helixlock_plant::{CATALOGUE, Column, Entry};

use super::acceptance::chance_in_any_noise;
use super::analysis::Step;
use super::beside_the_rest::not_told_beside;
use super::likeness::is_slope;
use super::refusal::Refusal;
use super::rivals::Rivals;
use super::seats::{self, Seat, Tried};
use super::span::{Span, shown};
use super::uneven::{self, Taken};
use crate::formulas::{Placed, STRAIGHT_LINE, Shape, nameless};
use crate::hypotheses::{Structure, chance_with_tails, is_left};
use crate::model::{
    Columns, Component, Fit, Judged, Problem, Stage, State, noises_of, plain_noises, settle,
    with_noise,
};
use crate::noise::{Noise, about_means, rms};
use crate::numerics::{Looks, chi_squared_tail, count, in_parallel, spread};
use crate::policy::chance::{NO_ALL_CLEAR, SIGNIFICANCE};
use crate::policy::evidence::{MARGIN, SHAPE};
use crate::policy::size::SHARE_OF_AN_EFFECT;

/// Shapes of each noise whose own noise is fitted.
const SHORTLIST: usize = 2;

/// The same when formulas are looked for, and runners-up are told.
const CLAIMS: usize = 6;

/// Places from which on a shape is looked for beside the effects only, for the time it takes.
const MOST_PLACES: f64 = 400.0;

/// A shape without a name that explains more than some effects of a model, or what they leave.
#[derive(Debug, Clone)]
pub(crate) struct Winner {
    /// What it shows.
    pub(crate) shown: Structure,
    /// The effects in whose place it stands, by their places in the model.
    pub(crate) beaten: Vec<usize>,
    /// By how much it is ahead of them, or of nothing.
    pub(crate) ahead: f64,
}

/// What the shapes without a name have to say against a model.
#[derive(Debug, Clone, Default)]
pub(crate) struct Heard {
    /// The shape that is farthest ahead of the effects in whose place it stands.
    pub(crate) winner: Option<Winner>,
    /// What rivals an effect without beating it, by its place in the model: a relation to a logged
    /// column that explains more than an effect which does not know of it, one shape that explains
    /// as much as effects of several names together.
    pub(crate) witnesses: Vec<(usize, String)>,
}

/// Hears every shape without a name in the place of effects of a model, and beside all of them.
#[must_use]
pub(crate) fn hear(problem: &Problem, state: &State, found: &[Rivals]) -> Heard {
    let shapes = nameless(problem);
    let court = Court::new(problem, state, found, &shapes, (SHORTLIST, MOST_PLACES));
    let mut heard = Heard::default();
    for (seat, claims) in court.claims(court.groups()) {
        heard.witnesses.extend(court.witness(&seat.group, &claims));
        heard.witnesses.extend(court.simpler(&seat.group, &claims));
        let won = court.winner(seat.group, &seat.base, claims);
        let farthest = heard.winner.as_ref().map_or(f64::NEG_INFINITY, |one| one.ahead);
        if won.as_ref().is_some_and(|one| farthest <= one.ahead) {
            heard.winner = won;
        }
    }
    heard
}

/// The shape without a name that explains more beside a model than nothing does.
#[must_use]
pub(crate) fn shape_beside(problem: &Problem, state: &State) -> Option<Winner> {
    let shapes = nameless(problem);
    let court = Court::new(problem, state, &[], &shapes, (SHORTLIST, MOST_PLACES));
    let (seat, claims) = court.claims(vec![Vec::new()]).pop()?;
    court.winner(seat.group, &seat.base, claims)
}

/// The one of some shapes, of any number of places, that explains more than one of some groups of effects.
#[must_use]
pub(super) fn in_place_of_any(
    problem: &Problem,
    state: &State,
    found: &[Rivals],
    groups: Vec<Vec<usize>>,
    shapes: &[Shape],
) -> Option<Winner> {
    let court = Court::new(problem, state, found, shapes, (SHORTLIST, f64::INFINITY));
    let heard = court.claims(groups).into_iter();
    let won = heard.filter_map(|(seat, claims)| court.winner(seat.group, &seat.base, claims));
    won.max_by(|a, b| a.ahead.total_cmp(&b.ahead))
}

/// What every shape of a list has to say for itself beside the effects of a model or in the place
/// of some: the best of each shape and group, most evidence first.
#[must_use]
pub(crate) fn claims<'a>(
    problem: &'a Problem,
    state: &'a State,
    found: &[Rivals],
    shapes: &'a [Shape],
) -> Vec<Claim<'a>> {
    let court = Court::new(problem, state, found, shapes, (CLAIMS, f64::INFINITY));
    let all = court.claims(court.groups()).into_iter().flat_map(|(_, claims)| claims);
    let mut claims: Vec<Claim<'a>> = all.collect();
    claims.sort_by(|a, b| b.ahead.total_cmp(&a.ahead));
    claims
}

/// What is beyond chance at the end of a search and may not be named.
#[must_use]
pub(crate) fn nobodys(problem: &Problem, steps: &[Step]) -> Vec<Structure> {
    let Some(last) = steps.iter().rfind(|step| !step.tried.is_empty()) else { return Vec::new() };
    let refused = last.tried.iter().zip(&last.refused);
    let found = refused.filter_map(|(judged, why)| match why {
        Refusal::Clock | Refusal::Angle { .. } => wave_of_nobody(problem, judged),
        _ if why.is_of_the_name() && judged.p_value < NO_ALL_CLEAR => {
            curve_of_nobody(problem, &last.state, judged, why)
        }
        _ => None,
    });
    found.filter(|structure| is_left(problem, &last.state.fit, structure)).collect()
}

/// A wave in time that no clock tells from an order; without a clock one over the way, which is not the angle where
/// the axis turns back.
fn wave_of_nobody(problem: &Problem, judged: &Judged) -> Option<Structure> {
    let rms_um = judged.component.size_um(problem, judged.coefficients().0);
    let told = |along| {
        let shape = "sinusoid, or one over the angle";
        Structure::without_place(along, shape, rms_um, judged.p_value)
    };
    if problem.measurement.timed {
        let at = judged.component.term.nonlinear().first().copied();
        return Some(Structure { at, ..told("frequency in time") });
    }
    (0.0 < spread(&problem.record.direction)).then(|| told("way"))
}

/// A curve that is beyond chance in any noise, though its values or other data forbid the name.
pub(super) fn curve_of_nobody(
    problem: &Problem,
    now: &State,
    judged: &Judged,
    why: &Refusal,
) -> Option<Structure> {
    let p_value = chance_in_any_noise(problem, now, judged);
    let rms_um = judged.component.size_um(problem, judged.coefficients().0);
    let name = &judged.component.term.name;
    let shape = format!("a curve like that of {name}, which may not be named ({why})");
    (p_value < NO_ALL_CLEAR)
        .then(|| Structure::without_place("travel and time", &shape, rms_um, p_value))
}

/// What a shape may stand in for: nothing, each effect, all but one, all.
pub(super) fn groups(components: usize) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(), (0..components).collect()];
    for one in 0..components {
        groups.push(vec![one]);
        groups.push((0..components).filter(|other| *other != one).collect());
    }
    groups.sort();
    groups.dedup();
    groups
}

/// Places that an effect of a model was looked for at.
fn looks(state: &State, found: &[Rivals], index: usize) -> f64 {
    let name = &state.components[index].term.name;
    let tried = found.iter().filter(|found| found.index == index).flat_map(|found| &found.tried);
    let mut own = tried.filter(|judged| judged.component.term.name == *name);
    own.next().map_or(1.0, |judged| judged.looks)
}

/// What a named effect pays.
pub(super) struct Price {
    /// For its free numbers; a size that physics fixes is none.
    numbers: f64,
    /// For the places it was looked for at.
    looks: f64,
}

impl Price {
    pub(super) fn of(problem: &Problem, component: &Component, looks: f64) -> Self {
        let priors = component.term.priors();
        let free =
            component.kept.iter().zip(&priors).filter(|(kept, known)| **kept && known.is_none());
        let numbers = count(free.count()) * problem.price_of_a_number();
        Self { numbers, looks: 2.0 * libm::log(looks.max(1.0)) }
    }

    pub(super) fn whole(&self) -> f64 {
        self.numbers + self.looks
    }
}

/// A model and the shapes that are tried against it.
pub(super) struct Court<'a> {
    pub(super) problem: &'a Problem,
    pub(super) state: &'a State,
    shapes: &'a [Shape],
    /// What each effect pays.
    pub(super) prices: Vec<Price>,
    /// Shapes of each noise whose own noise is fitted.
    shortlist: usize,
    /// Places from which on a shape is looked for beside the effects only.
    most_places: f64,
}

/// A shape with its fit, and its evidence against the effects in whose place it stands.
pub(crate) struct Claim<'a> {
    /// The shape at its best.
    pub(crate) placed: Placed<'a>,
    /// Its joint fit with the effects that stay.
    pub(crate) fit: Fit,
    /// By how much it is ahead.
    pub(crate) ahead: f64,
    /// The effects in whose place it stands.
    pub(crate) group: Vec<usize>,
    /// Shapes and places among which it was looked for.
    pub(crate) looks: f64,
    /// Chance of as much in noise, or odds that those effects are right.
    pub(crate) p_value: f64,
}

impl Claim<'_> {
    /// What rivals an effect, in the words of a person.
    fn words(&self) -> String {
        let Shape { words, along, .. } = self.placed.shape;
        format!("{words} along {along}")
    }

    /// What the shape shows at its best, by itself.
    pub(crate) fn shown(&self, problem: &Problem) -> Structure {
        let rms_um = self.size_um(problem);
        structure(&self.placed, self.placed.shape.words, rms_um, self.p_value)
    }

    /// Size of that, µm.
    fn size_um(&self, problem: &Problem) -> f64 {
        rms(&problem.layout, &self.left_of_nothing(problem))
    }

    /// The shape at its best, of the other sign.
    fn left_of_nothing(&self, problem: &Problem) -> Vec<f64> {
        let nothing = vec![0.0; problem.samples.len()];
        self.placed.columns.left(&nothing, &self.placed.coefficients)
    }
}

/// The claim that is farthest ahead.
fn farthest<'c, 'a: 'c>(claims: impl IntoIterator<Item = &'c Claim<'a>>) -> Option<&'c Claim<'a>> {
    claims.into_iter().max_by(|a, b| a.ahead.total_cmp(&b.ahead))
}

impl<'a> Court<'a> {
    pub(super) fn new(
        problem: &'a Problem,
        state: &'a State,
        found: &[Rivals],
        shapes: &'a [Shape],
        (shortlist, most_places): (usize, f64),
    ) -> Self {
        let prices = (0..state.components.len())
            .map(|index| Price::of(problem, &state.components[index], looks(state, found, index)))
            .collect();
        Self { problem, state, shapes, prices, shortlist, most_places }
    }

    /// Groups of effects that a shape may stand in for.
    fn groups(&self) -> Vec<Vec<usize>> {
        let mut groups = groups(self.state.components.len());
        // A setting is a number of the file that fits exactly, against any slope and any bend.
        let setting = |index: &usize| self.state.components[*index].term.nature().is_setting();
        groups.retain(|group| !group.iter().any(setting));
        groups
    }

    /// Columns of the effects that are in no group.
    pub(super) fn without(&self, group: &[usize]) -> Option<Columns> {
        Columns::of_model(self.problem, &self.state.without(group)).ok()
    }

    /// The one of some claims that explains more than a group of effects in their place.
    fn winner(&self, group: Vec<usize>, base: &Columns, claims: Vec<Claim<'a>>) -> Option<Winner> {
        let claim = claims.into_iter().max_by(|a, b| a.ahead.total_cmp(&b.ahead))?;
        if claim.ahead <= MARGIN {
            return None;
        }
        let ahead = claim.ahead;
        if group.is_empty() {
            return Some(Winner { shown: self.beside_all(&claim)?, beaten: group, ahead });
        }
        // What is hardly another shape, or the effect and more, explains what the effects leave of themselves,
        // and not them away.
        if self.is_hardly_another(&group, &claim) {
            let shown = self.better_than(&group, self.apart_um(&group, &claim)?, &claim);
            return Some(Winner { shown, beaten: Vec::new(), ahead });
        }
        if let Some(more) = self.more_than(&group, base, &claim) {
            let shown = self.better_than(&group, self.apart_um(&group, &claim)?, &claim);
            return Some(Winner { shown: shown.drawn_by(more), beaten: Vec::new(), ahead });
        }
        let left = settle(self.problem, base, &self.state.fit.noises).left;
        let shown = self.better_than(&group, rms(&self.problem.layout, &left), &claim);
        Some(Winner { shown, beaten: group, ahead })
    }

    /// What a shape is made of beside the effects that it contains, where these are worth their price beside that:
    /// a wave that swells is that wave, and a play that changes on the way is that play. Of a curve, a further power
    /// makes another one, of a slope any bend; so does what explains as much without what it contains.
    fn more_than(&self, group: &[usize], base: &Columns, claim: &Claim<'_>) -> Option<Vec<Column>> {
        let components: Vec<Component> =
            group.iter().map(|&index| self.state.components[index].clone()).collect();
        let are_waves = components.iter().all(|one| one.term.is_wave());
        let is_part = |index: &usize| {
            let one = &self.state.components[*index];
            one.width() == 1 && !one.is_of_one_size() && !is_slope(self.problem, self.state, *index)
        };
        let has_more = self.sizes(group) < claim.placed.columns.raw.len();
        let may_be_part = are_waves || group.iter().all(is_part);
        if !(has_more && may_be_part && self.draws((base, &claim.placed), group)) {
            return None;
        }
        let own = Columns::of(self.problem, &components).ok()?;
        let own = Span::of(self.problem, &own.raw);
        let is_own = |column: &&Column| own.has(&about_means(&self.problem.layout, column), SHAPE);
        let all = claim.placed.columns.raw.iter();
        let more: Vec<Column> = all.filter(|column| !is_own(column)).cloned().collect();
        let rest = Columns::free(more.clone());
        let beside = self.problem.beside(&rest);
        let prices: Vec<f64> = self.prices.iter().map(Price::whole).collect();
        let not_told = not_told_beside(&beside, self.state, &prices);
        let is_needed = group.iter().all(|index| !not_told.contains(index));
        (is_needed && (are_waves || self.is_behind(group, &rest))).then_some(more)
    }

    /// True where some effects are ahead of columns that stand alone in their place.
    fn is_behind(&self, group: &[usize], rest: &Columns) -> bool {
        let Some(base) = self.without(group) else { return false };
        let alone = self.settled(&base.and(rest)).log_likelihood;
        MARGIN < 2.0 * (self.state.fit.log_likelihood - alone)
    }

    /// The relation to a logged column that explains more than the only effect of a group, which
    /// does not know of it: two that were logged by the same clock seldom go along by accident. Or what grows straight
    /// with the way and explains as much, where no effect does.
    fn witness(&self, group: &[usize], claims: &[Claim<'a>]) -> Option<(usize, String)> {
        let [index] = *group else { return None };
        let needs = self.state.components[index].term.needs();
        let logged = &self.problem.measurement.covariates;
        let tells = |claim: &&Claim<'_>| {
            let along = claim.placed.shape.along.as_str();
            let is_of_a_log = logged.contains_key(along) && !needs.contains(&along);
            let is_a_line = claim.placed.shape.words == STRAIGHT_LINE;
            0.0 < claim.ahead && is_of_a_log || -MARGIN < claim.ahead && is_a_line
        };
        Some((index, farthest(claims.iter().filter(tells))?.words()))
    }

    /// The one shape that explains as much as effects of several names, or nearly so. One that is these effects
    /// and what makes it is not simpler: the margin would be its price for a number that the record has no need of.
    fn simpler(&self, group: &[usize], claims: &[Claim<'a>]) -> Vec<(usize, String)> {
        let adds = |placed: &Placed<'_>| {
            let beside = placed.columns.raw.get(..placed.shape.sizes_beside());
            beside.is_some_and(|columns| self.are_sums_of(columns, group))
        };
        let others = claims.iter().filter(|claim| !adds(&claim.placed));
        let near = farthest(others).filter(|claim| -MARGIN < claim.ahead);
        let Some(claim) = near.filter(|_| 1 < self.names(group).len()) else { return Vec::new() };
        group.iter().map(|&index| (index, claim.words())).collect()
    }

    /// Names of the effects of a group, each once.
    fn names(&self, group: &[usize]) -> BTreeSet<&str> {
        group.iter().map(|&index| self.state.components[index].term.name.as_str()).collect()
    }

    /// The best shapes in the place of each of some groups.
    fn claims(&self, groups: Vec<Vec<usize>>) -> Vec<(Seat<'a>, Vec<Claim<'a>>)> {
        let noises =
            [self.state.fit.noises.clone(), plain_noises(self.problem, &self.state.fit.left)];
        let seat = |group| self.seat(group, &noises);
        let seats: Vec<Seat<'a>> = groups.into_iter().filter_map(seat).collect();
        let tried = seats::tried(&seats, self.shapes, self.most_places);
        let with_claims = |(seat, tried)| {
            let claims = self.claims_in(&seat, tried);
            (seat, claims)
        };
        in_parallel(seats.into_iter().zip(tried), with_claims)
    }

    /// The place of some effects; `None` when the others have no columns.
    fn seat(&self, group: Vec<usize>, noises: &[Vec<Noise>; 2]) -> Option<Seat<'a>> {
        let base = self.without(&group)?;
        let stages = noises.each_ref().map(|noises| Stage::new(self.problem, &base, noises));
        Some(Seat { entries: self.entries(&group), group, base, stages })
    }

    /// The best shapes in a place.
    fn claims_in(&self, seat: &Seat<'_>, tried: Tried<'a>) -> Vec<Claim<'a>> {
        let Seat { group, base, entries, stages } = seat;
        let listed = count(self.shapes.len() * entries.len());
        let nothing = self.settled(base).log_likelihood;
        let least_um = SHARE_OF_AN_EFFECT * self.shown_um(group);
        let mut claims = Vec::new();
        for (stage, tried) in stages.iter().zip(tried) {
            let shortlist = self.shortlist(stage, tried).into_iter();
            claims.extend(shortlist.map(|(placed, looks)| {
                let fit = self.fitted(base, &placed, stage);
                let gain = 2.0 * (fit.log_likelihood - nothing);
                // Where it enters was chosen, too.
                let looked = count(entries.len()) * looks.for_gain(gain);
                let places = 2.0 * libm::log(looked);
                let draws = self.draws((base, &placed), group);
                let chosen = if draws { self.chosen(group) } else { 0.0 };
                let numbers = placed.shape.price(self.problem.price_of_a_number());
                let ahead = self.ahead(group, &fit) - numbers - places.max(chosen);
                let p_value = if group.is_empty() {
                    self.chance(&placed, (listed, &looks), &fit)
                } else {
                    libm::exp(-0.5 * ahead).min(1.0)
                };
                let looks = count(self.shapes.len()) * looked;
                Claim { placed, fit, ahead, group: group.clone(), looks, p_value }
            }));
        }
        // What is far smaller has let the noise explain the effects.
        claims.retain(|claim| least_um <= claim.size_um(self.problem));
        claims
    }

    /// Size of what some effects show together, µm.
    pub(super) fn shown_um(&self, group: &[usize]) -> f64 {
        let mut all = vec![0.0; self.problem.samples.len()];
        for shown in group.iter().filter_map(|&index| shown(self.problem, self.state, index)) {
            all.iter_mut().zip(shown).for_each(|(all, shown)| *all += shown);
        }
        rms(&self.problem.layout, &all)
    }

    /// Where a shape may enter in the place of a group: what goes in at several places may have one cause, which
    /// goes in at another.
    fn entries(&self, group: &[usize]) -> Vec<Entry> {
        if self.problem.sensors.len() == 1 {
            return self.problem.distinct_entries();
        }
        let own = group.iter().map(|&index| self.state.components[index].term.entry);
        let mut entries: BTreeSet<Entry> = own.collect();
        if entries.len() != 1 {
            entries.extend(self.problem.distinct_entries());
        }
        entries.into_iter().collect()
    }

    /// The shapes that take the most away under a stage's noise.
    fn shortlist(&self, stage: &Stage<'_>, tried: Vec<Placed<'a>>) -> Vec<(Placed<'a>, Looks)> {
        let mut tried = tried;
        let of_a_size = self.problem.price_of_a_number();
        let at_most = |placed: &Placed<'_>| placed.gain - placed.shape.price(of_a_size);
        tried.sort_by(|a, b| at_most(b).total_cmp(&at_most(a)));
        // Looks take away more, and are worked out for those only that may be among the best.
        let mut best: Vec<(f64, Placed<'a>, Looks)> = Vec::new();
        for placed in tried {
            if best.get(self.shortlist - 1).is_some_and(|last| at_most(&placed) < last.0) {
                break;
            }
            let looks = placed.looks(stage);
            let worth = placed.gain - self.price(&placed, &looks, placed.gain);
            best.push((worth, placed, looks));
            best.sort_by(|a, b| b.0.total_cmp(&a.0));
            best.truncate(self.shortlist);
        }
        best.into_iter().map(|(_, placed, looks)| (placed, looks)).collect()
    }

    /// What a shape pays for a gain: its sizes, and the places it was looked for at.
    fn price(&self, placed: &Placed<'_>, looks: &Looks, gain: f64) -> f64 {
        placed.price(self.problem.price_of_a_number(), looks, gain)
    }

    /// Some columns under the likelier of two noises: that of the model adjusted, and one of what they leave.
    pub(super) fn settled(&self, columns: &Columns) -> Fit {
        let problem = self.problem;
        let near = settle(problem, columns, &self.state.fit.noises);
        let anew = settle(problem, columns, &noises_of(problem, &near.left));
        if near.log_likelihood < anew.log_likelihood { anew } else { near }
    }

    /// The model with a shape, under the likelier of two noises: that of the model adjusted, and
    /// one looked for from the start.
    fn fitted(&self, base: &Columns, placed: &Placed<'_>, stage: &Stage<'_>) -> Fit {
        let problem = self.problem;
        let columns = base.and(&placed.columns);
        let near = settle(problem, &columns, &self.state.fit.noises);
        let rough = with_noise(&problem.layout, &columns, &problem.residual(), &stage.noises);
        let anew = settle(problem, &columns, &noises_of(problem, &rough.left));
        if near.log_likelihood < anew.log_likelihood { anew } else { near }
    }

    /// Evidence by which a fit is ahead of the effects in whose place a shape stands, its price apart.
    pub(super) fn ahead(&self, group: &[usize], fit: &Fit) -> f64 {
        // The shape's noise may suit the effects, too.
        let own = settle(self.problem, &self.state.columns, &fit.noises).log_likelihood;
        let own = own.max(self.state.fit.log_likelihood);
        let saved: f64 = group.iter().map(|&index| self.prices[index].whole()).sum();
        2.0 * (fit.log_likelihood - own) + saved + self.names_chosen(group)
    }

    /// What several names pay: a shape is one of a list, as a name is; every further name was chosen once more.
    fn names_chosen(&self, group: &[usize]) -> f64 {
        let more_names = count(self.names(group).len().saturating_sub(1));
        2.0 * more_names * libm::log(count(CATALOGUE.len()))
    }

    /// What effects pay for having been chosen among places and names: what draws all of them has chosen as
    /// much, at its own places or at theirs.
    fn chosen(&self, group: &[usize]) -> f64 {
        let looks: f64 = group.iter().map(|&index| self.prices[index].looks).sum();
        looks + self.names_chosen(group)
    }

    /// True when the effects of a group are sums of the columns of a shape, which has no fewer, and of those
    /// that stay: that of three waves of a turn one swells with another is no saving.
    fn draws(&self, (base, placed): (&Columns, &Placed<'_>), group: &[usize]) -> bool {
        let columns = placed.columns.raw.iter().chain(&base.raw).cloned();
        self.sizes(group) <= placed.columns.raw.len()
            && self.are_sums_of(&columns.collect::<Vec<Column>>(), group)
    }

    /// True when the effects of a group, one at least, are sums of some columns.
    fn are_sums_of(&self, columns: &[Column], group: &[usize]) -> bool {
        if group.is_empty() {
            return false;
        }
        let span = Span::of(self.problem, columns);
        let shown = |&index: &usize| shown(self.problem, self.state, index);
        group.iter().all(|index| shown(index).is_some_and(|shown| span.has(&shown, SHAPE)))
    }

    /// Sizes of the effects of a group, those of each power of a curve among them.
    fn sizes(&self, group: &[usize]) -> usize {
        group.iter().map(|&index| self.state.components[index].width()).sum()
    }

    /// Chance of what a shape takes away beside all effects in noise, which may have tails.
    fn chance(&self, placed: &Placed<'_>, (listed, looks): (f64, &Looks), fit: &Fit) -> f64 {
        let freedom = count(placed.columns.raw.len());
        let of_gain = |gain| listed * looks.for_gain(gain) * chi_squared_tail(gain, freedom);
        let gain = 2.0 * (fit.log_likelihood - self.state.fit.log_likelihood);
        let chance = of_gain(gain);
        if SIGNIFICANCE <= chance {
            return chance.min(1.0);
        }
        let taken = Taken::by(self.problem, self.state, &placed.columns, fit);
        let uneven = uneven::inflation(self.problem, self.state, fit, &taken);
        let with_tails = chance_with_tails(self.problem, [&self.state.fit, fit], of_gain);
        chance.max(with_tails).max(of_gain(gain / uneven)).min(1.0)
    }

    /// What a shape shows beside all effects; `None` when it is chance or too small.
    fn beside_all(&self, claim: &Claim<'_>) -> Option<Structure> {
        let told = claim.shown(self.problem);
        is_left(self.problem, &self.state.fit, &told).then_some(told)
    }

    /// A shape of some size in the place of some effects; its chance is the odds that they are right.
    fn better_than(&self, group: &[usize], rms_um: f64, claim: &Claim<'_>) -> Structure {
        let names: Vec<&str> = self.names(group).into_iter().collect();
        let shape = format!("{}, better than {}", claim.placed.shape.words, names.join(" and "));
        structure(&claim.placed, &shape, rms_um, claim.p_value)
    }

    /// True for a shape that differs from what some effects show together by hardly anything, and has more numbers:
    /// a decay that a cubic follows is no cubic and more.
    fn is_hardly_another(&self, group: &[usize], claim: &Claim<'_>) -> bool {
        let least_um = SHARE_OF_AN_EFFECT * claim.size_um(self.problem);
        self.sizes(group) < claim.placed.shape.numbers()
            && self.apart_um(group, claim).is_some_and(|apart| apart < least_um)
    }

    /// By how much a shape differs from what some effects show together.
    fn apart_um(&self, group: &[usize], claim: &Claim<'_>) -> Option<f64> {
        let layout = &self.problem.layout;
        let mut apart = about_means(layout, &claim.left_of_nothing(self.problem));
        for &index in group {
            let shown = shown(self.problem, self.state, index)?;
            apart.iter_mut().zip(shown).for_each(|(apart, shown)| *apart += shown);
        }
        Some(rms(layout, &apart))
    }
}

fn structure(placed: &Placed<'_>, shape: &str, rms_um: f64, p_value: f64) -> Structure {
    let told = Structure::without_place(&placed.shape.along, shape, rms_um, p_value);
    Structure { at: placed.at, ..told.drawn_by(placed.columns.raw.clone()) }
}
