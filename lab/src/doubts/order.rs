//! Waves of the file that come another number of times a turn: its screw has another lead, a gear other teeth.

use helixlock_plant::{Column, Formula, Lead, Model, Part, Search, Term};

use super::column::STEPS;
use super::hypothesis::{Hypothesis, Words};
use super::lead::with_lead;
use super::shift::{best, stages};
use crate::model::{Columns, Problem, Stage, noises_of};
use crate::noise::{Noise, rms};
use crate::numerics::spread;
use crate::policy::mistakes::{FARTHEST_LEAD, NEAR_A_STEP, SAME_LINE, SAME_WAVE, WHOLE};
use crate::spectrum::amplitude_spectrum;

/// Places looked at either way of a line, in a cell of the spectrum.
const PLACES: u8 = 8;

/// What turns, and the places in the file of the effects that come with it.
struct Shaft {
    effects: Vec<usize>,
    turned: Turned,
}

#[derive(Clone, Copy)]
enum Turned {
    Screw(Lead),
    /// So many times a turn of the spindle.
    Gear(f64),
}

/// For each shaft of the file whose waves come more or less often in the data how often, under each noise.
pub(super) fn other_orders(problem: &Problem, noises: &[Vec<Noise>]) -> Vec<Hypothesis> {
    let shafts = shafts(&problem.model);
    let stages = if shafts.is_empty() { Vec::new() } else { stages(problem, noises) };
    let told = |shaft: &Shaft| {
        let own = shaft.predicted(problem, 1.0)?;
        let lines = elsewhere(problem, &own)?;
        let each = stages.iter().filter_map(|stage| shaft.hypothesis(stage, &own, lines));
        Some(each.collect::<Vec<_>>())
    };
    shafts.iter().filter_map(told).flatten().collect()
}

/// The screw, and each gear that waves of the file come with.
fn shafts(model: &Model) -> Vec<Shaft> {
    let with = |comes: &dyn Fn(&Term) -> bool| -> Vec<usize> {
        (0..model.effects.len()).filter(|&at| comes(&model.effects[at])).collect()
    };
    let of_screw = with(&|term| {
        let card = if let Formula::Card(card) = term.formula { Some(card) } else { None };
        term.is_wave() && card.is_some_and(|card| card.parts.contains(&Part::LeadScrew))
    });
    let screw = model.lead_screw.filter(|_| !model.rotary && !of_screw.is_empty());
    let screw = screw.map(|lead| Shaft { effects: of_screw, turned: Turned::Screw(lead) });
    let mut orders: Vec<f64> =
        model.effects.iter().filter_map(|term| Some(shaft_of(model, order(term)?))).collect();
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    let gears = orders.into_iter().map(|shaft| {
        let effects = with(&|term| order(term).is_some_and(|order| is_whole(order / shaft)));
        Shaft { effects, turned: Turned::Gear(shaft) }
    });
    screw.into_iter().chain(gears).collect()
}

/// How often a wave of a gear comes, a turn of the spindle.
fn order(term: &Term) -> Option<f64> {
    let of_gear = term.parameters.iter().position(|what| what.search == Search::GearOrder)?;
    term.is_wave().then_some(term.values[of_gear])
}

/// The slowest shaft of the gear table that an order is a multiple of, or the order.
fn shaft_of(model: &Model, order: f64) -> f64 {
    let shafts = model.gears.iter().map(|gear| gear.order);
    shafts.filter(|shaft| is_whole(order / shaft)).fold(order, f64::min)
}

fn is_whole(ratio: f64) -> bool {
    0.5 < ratio && (ratio - ratio.round()).abs() < WHOLE
}

impl Shaft {
    /// The file's effects that come with it, so many times as often.
    fn terms(&self, model: &Model, times: f64) -> Vec<Term> {
        let of = |at: &usize| {
            let mut term = model.effects[*at].clone();
            let often = |search: Search| matches!(search, Search::GearOrder | Search::Whole);
            let values = term.parameters.iter().zip(&mut term.values);
            values.filter(|(what, _)| often(what.search)).for_each(|(_, value)| *value *= times);
            term
        };
        self.effects.iter().map(of).collect()
    }

    /// Columns of those.
    fn columns(&self, problem: &Problem, times: f64) -> Option<Vec<Column>> {
        let terms = self.terms(&problem.model, times);
        let columns = terms.iter().map(|term| Some(problem.design(term).ok()?.columns));
        Some(columns.collect::<Option<Vec<_>>>()?.concat())
    }

    /// What they predict.
    fn predicted(&self, problem: &Problem, times: f64) -> Option<Vec<f64>> {
        let terms = self.terms(&problem.model, times);
        let sizes: Vec<f64> = terms.iter().flat_map(Term::coefficients).collect();
        Some(sum(problem, &self.columns(problem, times)?, &sizes))
    }

    fn hypothesis(
        &self,
        stage: &Stage<'_>,
        own: &[f64],
        [from, to]: [f64; 2],
    ) -> Option<Hypothesis> {
        let problem = stage.problem;
        let cell = cell(problem);
        let moved = |longer: f64| {
            let there = self.predicted(problem, to / from * (1.0 + longer))?;
            Some(there.iter().zip(own).map(|(there, own)| there - own).collect())
        };
        let step = cell / to / f64::from(PLACES);
        let (longer, _) = best(stage, &moved, (step, i32::from(PLACES)))?;
        let times = to / from * (1.0 + longer);
        let one = self.mended(problem, times)?;
        let looks = (FARTHEST_LEAD - FARTHEST_LEAD.recip()) * from / cell;
        let is_same = self.is_the_same(problem, &one.mended, (times, own))?;
        is_same.then_some(Hypothesis { numbers: 1.0, looks, usual: 0.0, ..one })
    }

    fn mended(&self, problem: &Problem, times: f64) -> Option<Hypothesis> {
        let own = match self.turned {
            // The position is asked for those, which moves waves alike.
            Turned::Screw(_)
                if STEPS.iter().any(|step| (times / step - 1.0).abs() < NEAR_A_STEP) =>
            {
                return None;
            }
            Turned::Screw(own) => {
                return with_lead(problem, own, &format!("{:.5} mm", own.mm() / times));
            }
            Turned::Gear(own) => own,
        };
        let mut model = problem.model.clone();
        let terms = self.terms(&problem.model, times);
        let words = words(&model, [own, own * times], &terms);
        for (at, term) in self.effects.iter().zip(terms) {
            model.effects[*at] = term;
        }
        Hypothesis::of_model(problem, &model, words)
    }

    /// True where the wave there has the size and the phase of the file's.
    fn is_the_same(
        &self,
        problem: &Problem,
        mended: &Problem,
        (times, own): (f64, &[f64]),
    ) -> Option<bool> {
        let raw = self.columns(problem, times)?;
        let noises = noises_of(mended, &mended.residual());
        let stage = Stage::new(mended, &Columns::default(), &noises);
        let free = stage.gain(&Columns { raw: raw.clone(), ..Columns::default() }).fit;
        let departs = sum(problem, &raw, &free.coefficients);
        Some(rms(&problem.layout, &departs) < SAME_WAVE * rms(&problem.layout, own))
    }
}

/// How often the strongest of a shaft's own waves comes, and how often the strongest of the data that are free of them.
fn elsewhere(problem: &Problem, own: &[f64]) -> Option<[f64; 2]> {
    let strongest = |curve: &[f64], sensor: usize| {
        let spectrum = amplitude_spectrum(problem, curve, sensor);
        spectrum.into_iter().max_by(|a, b| a[1].total_cmp(&b[1]))
    };
    let on = |sensor: usize| Some((sensor, strongest(own, sensor)?));
    let sensors = (0..problem.sensors.len()).filter_map(on);
    let (sensor, [from, _]) = sensors.max_by(|a, b| a.1[1].total_cmp(&b.1[1]))?;
    let free: Vec<f64> = problem.residual().iter().zip(own).map(|(left, own)| left + own).collect();
    let [to, _] = strongest(&free, sensor)?;
    let is_another = SAME_LINE * cell(problem) < (to - from).abs();
    (is_another && (to / from).max(from / to) < FARTHEST_LEAD).then_some([from, to])
}

fn sum(problem: &Problem, columns: &[Column], sizes: &[f64]) -> Vec<f64> {
    let mut all = vec![0.0; problem.samples.len()];
    for (column, size) in columns.iter().zip(sizes) {
        all.iter_mut().zip(column.iter()).for_each(|(all, value)| *all += size * value);
    }
    all
}

/// Width of a line, a turn of the spindle.
fn cell(problem: &Problem) -> f64 {
    let turns = spread(&problem.record.spindle_rad) / std::f64::consts::TAU;
    1.0 / turns.max(f64::MIN_POSITIVE)
}

fn words(model: &Model, [from, to]: [f64; 2], terms: &[Term]) -> Words {
    let says = format!(
        "what comes {from:.4} times a turn by the file comes {to:.4} times: a gear has other teeth than the file says"
    );
    let is_listed = model.gears.iter().any(|gear| is_whole(gear.order / from));
    let gear = is_listed.then(|| format!("[[gear]]\norder = {to:.5}"));
    let effect = |term: &Term| {
        let order = order(term).unwrap_or(to);
        format!("[[effect]]\nkind = \"{}\"\norder = {order:.5}", term.name)
    };
    let lines: Vec<String> = gear.into_iter().chain(terms.iter().map(effect)).collect();
    ("gear", says, lines.join("\n"))
}
