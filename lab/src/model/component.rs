//! An effect inside a fit: which of its columns are in use, and what they weigh.

use std::f64::consts::TAU;

use helixlock_plant::{
    Column, Context, EffectError, Estimate, Parameter, Role, Search, Smoothness, Term,
};

use super::columns::Columns;
use super::problem::{Design, Problem};
use crate::noise::{Block, rms};
use crate::numerics::count;
use crate::policy::evidence::LEAST_PRICE;

/// An effect with the columns a fit may use.
#[derive(Debug, Clone)]
pub(crate) struct Component {
    /// The effect, at its present nonlinear values.
    pub(crate) term: Term,
    /// Per column of its basis: true when in use.
    pub(crate) kept: Vec<bool>,
    /// Per column of its basis: the whole number it was found to be, for counts.
    pub(crate) whole: Vec<Option<f64>>,
}

/// Mean and standard deviation of each coefficient that physics or counting fixes.
pub(crate) type Priors = Vec<Option<(f64, f64)>>;

/// Standard deviation that holds a count at its whole number.
const WHOLE_STDERR: f64 = 1e-4;

impl Columns {
    /// Columns of some components.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when a column of data or a section of the machine file is missing.
    pub(crate) fn of(problem: &Problem, components: &[Component]) -> Result<Self, EffectError> {
        let terms: Vec<&Term> = components.iter().map(|component| &component.term).collect();
        let mut all = Self::default();
        for component in components {
            let (design, priors) = component.design_beside(problem, &terms)?;
            all.raw.extend(design.columns);
            all.priors.extend(priors);
            all.take_off(design.fixed);
        }
        Ok(all)
    }

    /// The columns of a model: those of its effects, and what belongs to none behind them.
    ///
    /// # Errors
    ///
    /// As [`Self::of`].
    pub(crate) fn of_model(
        problem: &Problem,
        components: &[Component],
    ) -> Result<Self, EffectError> {
        Ok(Self::of(problem, components)?.and(&problem.free))
    }
}

/// Some effects at coefficients of their columns in use, row by row in µm (arcsec); `None` when one
/// cannot be worked out.
#[must_use]
pub(crate) fn shown_um(
    problem: &Problem,
    components: &[Component],
    used: &[f64],
) -> Option<Vec<f64>> {
    let columns = Columns::of(problem, components).ok()?;
    let missing = columns.left(&vec![0.0; problem.samples.len()], used);
    Some(missing.into_iter().map(|value| -value).collect())
}

impl Component {
    /// All columns in use.
    #[must_use]
    pub(crate) fn new(term: Term) -> Self {
        let width = term.priors().len();
        Self { term, kept: vec![true; width], whole: vec![None; width] }
    }

    /// Waves that the effect makes a turn of the spindle.
    #[must_use]
    pub(crate) fn waves_a_turn(&self, problem: &Problem) -> f64 {
        let context = Context { machine: &problem.model, columns: &problem.record.columns };
        let basis = self.term.basis(&context).map(|basis| basis.columns).unwrap_or_default();
        let turn_mm = problem.model.workpiece.lead.mm();
        let rate = |turns_per_s: f64| {
            let moving =
                basis.iter().map(|wave| wave.smoothness(TAU * turns_per_s, turn_mm * turns_per_s));
            moving.map(Smoothness::rate_per_s).fold(0.0, f64::max)
        };
        (rate(1.0) - rate(0.0)) / TAU
    }

    /// Columns that stand or fall together: a sine with its cosine, any other alone. What a pass began with,
    /// behind them, stands: another effect that is yet to be found has its share in it.
    #[must_use]
    pub(crate) fn atoms(&self) -> Vec<Vec<usize>> {
        let mut atoms = Vec::new();
        let mut column = 0;
        for parameter in &self.term.parameters {
            let width = match parameter.role {
                Role::Amplitude => 2,
                Role::Linear | Role::Squared | Role::Known { .. } => 1,
                Role::Phase | Role::Nonlinear | Role::Start { .. } => 0,
            };
            if 0 < width {
                atoms.push((column..column + width).collect());
                column += width;
            }
        }
        atoms
    }

    /// Columns whose coefficient counts something and must be whole.
    #[must_use]
    pub(crate) fn counts(&self) -> Vec<usize> {
        let counting = |what: &Parameter| what.role == Role::Linear && what.name == "count";
        self.sizes().filter(|(what, _)| counting(what)).map(|(_, atom)| atom[0]).collect()
    }

    /// Parameters that have columns of their own, with those.
    fn sizes(&self) -> impl Iterator<Item = (&Parameter, Vec<usize>)> {
        let parameters = self.term.parameters.iter();
        parameters
            .filter(|what| !matches!(what.role, Role::Phase | Role::Nonlinear))
            .zip(self.atoms())
    }

    /// True for one that has a rate or a time constant in use, and forgets nothing within a pass.
    #[must_use]
    pub(crate) fn goes_on_with_time(&self) -> bool {
        let runs = |what: &Parameter| what.unit.is_of_time() && what.search != Search::Time;
        let is_kept = |atom: &[usize]| atom.iter().any(|&column| self.kept[column]);
        let by_a_rate = self.sizes().any(|(what, atom)| runs(what) && is_kept(&atom));
        let mut others = self.term.parameters.iter().filter(|what| what.role == Role::Nonlinear);
        !self.term.nature().delays && (by_a_rate || others.any(runs))
    }

    /// Columns of its basis that are sizes of their own and count nothing.
    #[must_use]
    pub(crate) fn sizes_alone(&self) -> Vec<usize> {
        let counts = self.counts();
        let alone = self.atoms().into_iter().filter(|atom| atom.len() == 1).map(|atom| atom[0]);
        alone.filter(|column| !counts.contains(column)).collect()
    }

    /// True where one of those is not in use.
    #[must_use]
    pub(crate) fn leaves_out(&self) -> bool {
        self.sizes_alone().iter().any(|&column| !self.kept[column])
    }

    /// Number of columns in use before one.
    #[must_use]
    pub(crate) fn used_before(&self, column: usize) -> usize {
        self.kept[..column].iter().filter(|kept| **kept).count()
    }

    /// Number of columns in use.
    #[must_use]
    pub(crate) fn width(&self) -> usize {
        self.used_before(self.kept.len())
    }

    /// Free numbers, as evidence counts them: those in use, of an effect that has none of its own one,
    /// and what passes began with.
    #[must_use]
    pub(crate) fn freedom(&self) -> f64 {
        count(self.width().saturating_sub(self.starts()).max(1) + self.starts())
    }

    /// What those cost as evidence: a number that all rows tell of as much as any, one that is forgotten
    /// after some rows as one of so many.
    #[must_use]
    pub(crate) fn price(&self, problem: &Problem) -> f64 {
        let own = self.freedom() - count(self.starts());
        own * problem.price_of_a_number() + self.price_of_starts(problem)
    }

    /// The part of it for what passes began with.
    #[must_use]
    pub(crate) fn price_of_starts(&self, problem: &Problem) -> f64 {
        if self.starts() == 0 {
            return 0.0;
        }
        self.starts_alone(problem).map_or(0.0, |starts| price_of_starts(problem, &starts))
    }

    /// Columns of what passes began with, without the effect.
    ///
    /// # Errors
    ///
    /// As [`Self::design`].
    pub(crate) fn starts_alone(&self, problem: &Problem) -> Result<Columns, EffectError> {
        let (design, _) = self.design(problem)?;
        let own = design.columns.len() - self.starts();
        Ok(Columns::free(design.columns.into_iter().skip(own)))
    }

    /// The effect itself, whatever passes began with.
    #[must_use]
    pub(crate) fn without_starts(&self) -> Self {
        let own = self.kept.len() - self.term.starts().count();
        let (kept, whole) = (self.kept[..own].to_vec(), self.whole[..own].to_vec());
        Self { term: self.term.without_starts(), kept, whole }
    }

    /// Number of passes that begin with a value of their own.
    pub(crate) fn starts(&self) -> usize {
        let starts = self.term.starts().count();
        self.kept[self.kept.len() - starts..].iter().filter(|kept| **kept).count()
    }

    /// True for an effect that scales with none of its numbers.
    #[must_use]
    pub(crate) fn is_of_one_size(&self) -> bool {
        self.kept.len() == self.term.starts().count()
    }

    /// Columns in use with their priors, and the part that does not scale.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when a column or a section of the machine file is missing.
    pub(crate) fn design(&self, problem: &Problem) -> Result<(Design, Priors), EffectError> {
        self.design_beside(problem, &[])
    }

    /// The same through those of some effects that delay.
    ///
    /// # Errors
    ///
    /// As [`Self::design`].
    pub(crate) fn design_beside(
        &self,
        problem: &Problem,
        others: &[&Term],
    ) -> Result<(Design, Priors), EffectError> {
        let Design { columns, fixed } = problem.design_beside(&self.term, others)?;
        let held = self.term.priors().into_iter().zip(&self.whole);
        let priors = held.map(|(prior, whole)| whole.map(|w| (w, WHOLE_STDERR)).or(prior));
        let rests = columns.iter().zip(self.unused()).zip(&self.kept);
        let rests = rests.filter(|((_, size), kept)| !**kept && *size != 0.0);
        let fixed =
            rests.fold(fixed, |fixed, ((column, size), _)| Some(with_more(fixed, column, size)));
        let pairs = columns.into_iter().zip(priors).zip(&self.kept);
        let (columns, priors) = pairs.filter(|(_, kept)| **kept).map(|(pair, _)| pair).unzip();
        Ok((Design { columns, fixed }, priors))
    }

    /// Per column of the basis its coefficient where it is not in use: what the machine file says of an effect
    /// that it has, else 0.
    fn unused(&self) -> Vec<f64> {
        match self.term.instead_of {
            Some(_) => self.term.coefficients(),
            None => vec![0.0; self.kept.len()],
        }
    }

    /// The effect with its first numbers alone, fewer by one and more, where each scales a shape of its own.
    pub(crate) fn parts(&self) -> impl Iterator<Item = Self> {
        let each = self.term.parameters.iter().all(|what| what.role == Role::Linear);
        let last = if each { self.width() } else { 0 };
        (1..last).map(|width| {
            let mut part = self.clone();
            let mut kept = 0;
            for keeps in &mut part.kept {
                kept += usize::from(*keeps);
                *keeps &= kept <= width;
            }
            part
        })
    }

    /// Coefficients of the whole basis from those in use.
    #[must_use]
    pub(crate) fn spread(&self, used: &[f64]) -> Vec<f64> {
        let mut all = self.unused();
        let in_use = all.iter_mut().zip(&self.kept).filter(|(_, kept)| **kept);
        in_use.zip(used).for_each(|((value, _), found)| *value = *found);
        all
    }

    /// The effect at some coefficients of the columns in use, row by row in µm (arcsec); `None`
    /// when it cannot be worked out.
    #[must_use]
    pub(crate) fn shown_um(&self, problem: &Problem, used: &[f64]) -> Option<Vec<f64>> {
        shown_um(problem, std::slice::from_ref(self), used)
    }

    /// True when a column of it goes in steps.
    #[must_use]
    pub(crate) fn is_rough(&self, problem: &Problem) -> bool {
        let context = Context { machine: &problem.model, columns: &problem.record.columns };
        self.term.basis(&context).is_ok_and(|basis| {
            let all = basis.columns.iter().chain(&basis.fixed);
            all.map(|wave| wave.smoothness(0.0, 0.0)).any(|one| matches!(one, Smoothness::Rough))
        })
    }

    /// Root mean square of that about the zero of each pass, µm (arcsec); 0 when it cannot be
    /// worked out.
    #[must_use]
    pub(crate) fn size_um(&self, problem: &Problem, used: &[f64]) -> f64 {
        self.shown_um(problem, used).map_or(0.0, |shown| rms(&problem.layout, &shown))
    }

    /// The same with another value of one nonlinear parameter.
    #[must_use]
    pub(crate) fn with_value(&self, place: usize, value: f64) -> Self {
        let mut values = self.term.nonlinear();
        values[place] = value;
        Self { term: self.term.with_nonlinear(&values), ..self.clone() }
    }

    /// The term with the values that belong to these coefficients of the columns in use, on any record.
    #[must_use]
    pub(crate) fn valued(&self, used: &[f64]) -> Term {
        self.term.with_coefficients(&self.spread(used)).without_starts()
    }

    /// Linear parameters of the machine in use with standard errors; `covariance` covers the columns in
    /// use.
    #[must_use]
    pub(crate) fn estimates(&self, used: &[f64], covariance: &[Vec<f64>]) -> Vec<Estimate> {
        let width = self.kept.len();
        let places: Vec<usize> = (0..width).filter(|&i| self.kept[i]).collect();
        let mut whole = vec![vec![0.0; width]; width];
        for (i, &row) in places.iter().enumerate() {
            for (j, &column) in places.iter().enumerate() {
                whole[row][column] = covariance[i][j];
            }
        }
        let estimates = self.term.estimates(&self.spread(used), &whole);
        let is_told =
            |parameter: usize| self.uses(parameter) && !self.term.parameters[parameter].is_start();
        estimates.into_iter().filter(|estimate| is_told(estimate.parameter)).collect()
    }

    /// True for a number of something, found to be whole: it has no error.
    #[must_use]
    pub(crate) fn is_counted(&self, parameter: usize) -> bool {
        let linear = self.term.parameters[..=parameter].iter().map(|what| match what.role {
            Role::Amplitude => 2,
            Role::Linear | Role::Squared | Role::Known { .. } | Role::Start { .. } => 1,
            Role::Phase | Role::Nonlinear => 0,
        });
        let behind: usize = linear.sum();
        let column = behind.checked_sub(1).and_then(|column| self.whole.get(column));
        column.is_some_and(Option::is_some)
    }

    /// True unless a nonlinear parameter changes nothing in the columns in use, as the moment of a
    /// hop without a hop.
    #[must_use]
    pub(crate) fn depends_on(&self, problem: &Problem, used: &[f64], place: usize) -> bool {
        let what = &self.term.parameters[self.term.nonlinear_indices()[place]];
        let shown = self.shown_um(problem, used);
        [*what.range.start(), *what.range.end()].into_iter().any(|end| {
            let other = self.with_value(place, end).shown_um(problem, used);
            other.is_none() || other != shown
        })
    }

    /// True when a parameter belongs to a column in use.
    #[must_use]
    pub(crate) fn uses(&self, parameter: usize) -> bool {
        let mut column = 0;
        for (index, what) in self.term.parameters.iter().enumerate() {
            let width = match what.role {
                Role::Amplitude => 2,
                Role::Linear | Role::Squared | Role::Known { .. } | Role::Start { .. } => 1,
                Role::Phase if index == parameter => {
                    return self.kept.get(column - 1) == Some(&true);
                }
                Role::Nonlinear if index == parameter => return true,
                Role::Phase | Role::Nonlinear => 0,
            };
            if index == parameter {
                return self.kept.get(column) == Some(&true);
            }
            column += width;
        }
        false
    }
}

/// What columns of what passes began with cost as evidence.
#[must_use]
pub(crate) fn price_of_starts(problem: &Problem, starts: &Columns) -> f64 {
    let number = problem.price_of_a_number();
    let price =
        |column: &Column| libm::log(rows_told(problem, column)).max(LEAST_PRICE).min(number);
    // From the last on, for sums depend on their order.
    starts.raw.iter().rev().map(price).sum()
}

/// Rows that tell what a pass began with, each as much as it still shows of it.
fn rows_told(problem: &Problem, column: &Column) -> f64 {
    let of_block = |block: &Block| -> Vec<f64> {
        let last = column[block.rows.end - 1];
        block.rows.clone().map(|row| column[row] - last).collect()
    };
    let shown: Vec<f64> = problem.layout.blocks.iter().flat_map(of_block).collect();
    let most = shown.iter().fold(f64::MIN_POSITIVE, |most, value| most.max(value.abs()));
    shown.iter().map(|value| (value / most) * (value / most)).sum()
}

/// A part that does not scale, and so much of a column beside it.
fn with_more(fixed: Option<Column>, column: &Column, size: f64) -> Column {
    let more = column.iter().map(|value| size * value);
    match fixed {
        Some(fixed) => fixed.iter().zip(more).map(|(fixed, more)| fixed + more).collect(),
        None => more.collect(),
    }
}
