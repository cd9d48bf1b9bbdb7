//! One effect of one machine: its parameters with their values, and how they relate to a fit.
//!
//! A fit works on *coefficients*, which δ is linear in; a person reads *parameters*. An amplitude
//! `a` with its phase `φ` has the coefficients `a·cos φ` of the sine and `a·sin φ` of the cosine.

use crate::custom::{self, Custom};
use crate::error::moment;
use crate::measured_curve::MeasuredCurve;
use crate::units::in_reach;
use crate::{
    Basis, CATALOGUE, Card, Columns, Context, Effect, EffectError, Entry, Instant, Machine, Nature,
    Parameter, Record, Role, Search,
};
use std::sync::Arc;

/// Where the formula of a term comes from.
#[derive(Clone, Debug)]
pub enum Formula {
    /// The catalogue.
    Card(&'static Card),
    /// An expression of the user.
    Custom(Arc<Custom>),
    /// An error curve that was measured.
    Curve(Arc<MeasuredCurve>),
}

/// An effect with its numbers.
#[derive(Clone, Debug)]
pub struct Term {
    /// Name of the effect: the kind, or the user's name of a `custom` one.
    pub name: String,
    /// Where it enters.
    pub entry: Entry,
    /// What it needs, in the order of `values`.
    pub parameters: Vec<Parameter>,
    /// Values in the parameters' units.
    pub values: Vec<f64>,
    /// Its formula.
    pub formula: Formula,
    /// The effect of the machine file, by its place there, that it takes the place of.
    pub instead_of: Option<usize>,
}

/// A parameter a fit has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Index in [`Term::parameters`].
    pub parameter: usize,
    /// Value in the parameter's unit.
    pub value: f64,
    /// Standard error in the parameter's unit.
    pub stderr: f64,
}

impl Term {
    /// An effect of the catalogue of a machine that travels, with a value for each parameter of its
    /// card.
    ///
    /// # Errors
    ///
    /// [`EffectError::ValueCount`] when there are more or fewer.
    pub fn new(card: &'static Card, values: &[f64]) -> Result<Self, EffectError> {
        if values.len() != card.parameters.len() {
            return Err(EffectError::ValueCount {
                effect: card.kind.into(),
                found: values.len(),
                expected: card.parameters.len(),
            });
        }
        Ok(Self { values: values.into(), ..Self::candidate(card, false) })
    }

    /// An effect of the catalogue at its defaults, on a rotary chain or not; what has none is 0.
    #[must_use]
    pub fn candidate(card: &'static Card, rotary: bool) -> Self {
        let on_chain = |what: &Parameter| {
            if rotary { what.clone().on_rotary_chain() } else { what.clone() }
        };
        let values = card.parameters.iter().map(|p| p.default.unwrap_or(0.0)).collect();
        Self {
            name: card.kind.into(),
            entry: card.entry,
            parameters: card.parameters.iter().map(on_chain).collect(),
            values,
            formula: Formula::Card(card),
            instead_of: None,
        }
    }

    /// A formula of the user with its parameters, whose roles follow from it.
    ///
    /// # Errors
    ///
    /// [`EffectError::Formula`] when it cannot be read, or leaves a parameter out.
    pub fn custom(
        name: &str,
        entry: Entry,
        formula: &str,
        parameters: Vec<Parameter>,
        values: Vec<f64>,
    ) -> Result<Self, EffectError> {
        let names: Vec<_> = parameters.iter().map(|what| what.name.to_string()).collect();
        let custom = Custom::new(name, formula, &names)?;
        let parameters = custom.with_roles(parameters);
        let formula = Formula::Custom(Arc::new(custom));
        Ok(Self { name: name.into(), entry, parameters, values, formula, instead_of: None })
    }

    /// Its word after `kind =` in a machine file.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match &self.formula {
            Formula::Card(card) => card.kind,
            Formula::Custom(_) => "custom",
            Formula::Curve(_) => "measured-curve",
        }
    }

    /// Its formula: as the user wrote it, or as the catalogue does; of a measured curve its file.
    #[must_use]
    pub fn formula_text(&self) -> &str {
        match &self.formula {
            Formula::Card(card) => card.formula,
            Formula::Custom(custom) => custom.formula(),
            Formula::Curve(curve) => curve.file(),
        }
    }

    /// What is special about it; nothing of the user's own.
    #[must_use]
    pub fn nature(&self) -> &'static Nature {
        match &self.formula {
            Formula::Card(card) => &card.nature,
            Formula::Custom(_) | Formula::Curve(_) => &Nature::PLAIN,
        }
    }

    /// True for a line of a shaft or a mesh that the machine file lists.
    #[must_use]
    pub fn is_of_a_gear(&self) -> bool {
        self.parameters.iter().any(|what| what.search == Search::GearOrder)
    }

    /// Logged columns it cannot do without.
    #[must_use]
    pub fn needs(&self) -> Vec<&str> {
        match &self.formula {
            Formula::Card(card) => card.needs.to_vec(),
            Formula::Custom(custom) => custom.needs(),
            Formula::Curve(_) => Vec::new(),
        }
    }

    /// True for a wave, which has a phase.
    #[must_use]
    pub fn is_wave(&self) -> bool {
        self.parameters.iter().any(|what| what.role == Role::Phase)
    }

    /// Its frequency in time, Hz, if it has one.
    #[must_use]
    pub fn frequency_hz(&self) -> Option<f64> {
        let place = self.parameters.iter().position(Parameter::is_frequency)?;
        Some(self.values[place])
    }

    /// Of a wave that is a whole harmonic of its part's turn: which.
    #[must_use]
    pub fn harmonic(&self) -> Option<u32> {
        let place = self.parameters.iter().position(|what| what.search == Search::Whole)?;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number of waves a turn"
        )]
        self.is_wave().then(|| self.values[place].round() as u32)
    }

    /// Values of the nonlinear parameters, in their order.
    #[must_use]
    pub fn nonlinear(&self) -> Vec<f64> {
        let pairs = self.parameters.iter().zip(&self.values);
        pairs.filter(|(parameter, _)| parameter.is_nonlinear()).map(|(_, value)| *value).collect()
    }

    /// Indices in [`Self::parameters`] of the nonlinear ones.
    #[must_use]
    pub fn nonlinear_indices(&self) -> Vec<usize> {
        let with_index = self.parameters.iter().enumerate();
        with_index.filter(|(_, parameter)| parameter.is_nonlinear()).map(|(i, _)| i).collect()
    }

    /// The same effect with other values of the nonlinear parameters.
    #[must_use]
    pub fn with_nonlinear(&self, nonlinear: &[f64]) -> Self {
        let mut term = self.clone();
        for (index, value) in self.nonlinear_indices().into_iter().zip(nonlinear) {
            term.values[index] = *value;
        }
        term
    }

    /// Unit effects at the present values of the nonlinear parameters.
    ///
    /// # Errors
    ///
    /// [`EffectError`] when a column or a part of the machine is missing.
    pub fn basis(&self, context: &Context<'_>) -> Result<Basis, EffectError> {
        if let Some(column) = self.needs().into_iter().find(|name| !context.columns.has(name)) {
            return Err(EffectError::MissingColumn {
                effect: self.name.clone(),
                column: column.into(),
                near: custom::near(column),
            });
        }
        let nonlinear = self.nonlinear();
        let parts = Self::card(self.kind()).map_or(&[][..], |card| card.parts);
        if let Some(part) = context.machine.lacks(parts) {
            return Err(EffectError::MissingPart { effect: self.name.clone(), part });
        }
        let mut basis = match &self.formula {
            Formula::Card(card) => (card.basis)(context, &nonlinear),
            Formula::Custom(custom) => custom.basis(context.columns, &self.parameters, &nonlinear),
            Formula::Curve(curve) => Ok(curve.basis()),
        }?;
        let remembers = basis.fixed.iter();
        let started =
            remembers.flat_map(|fixed| self.starts().filter_map(|pass| fixed.started(pass)));
        let started: Vec<Box<dyn Effect>> = started.collect();
        basis.columns.extend(started);
        Ok(basis)
    }

    /// Passes of which it is open what an effect with a memory began with.
    pub fn starts(&self) -> impl Iterator<Item = usize> {
        self.parameters.iter().filter_map(|what| match what.role {
            Role::Start { pass } => Some(pass),
            _ => None,
        })
    }

    /// The same effect where it is open what it began with in some passes; for one that
    /// [`Nature::delays`].
    #[must_use]
    pub fn with_starts(&self, passes: impl IntoIterator<Item = usize>) -> Self {
        let mut term = self.without_starts();
        term.parameters.extend(passes.into_iter().map(Parameter::start));
        term.values.resize(term.parameters.len(), 0.0);
        term
    }

    /// The same effect as it is on any record.
    #[must_use]
    pub fn without_starts(&self) -> Self {
        let mut term = self.clone();
        term.parameters.retain(|what| !what.is_start());
        term.values.truncate(term.parameters.len());
        term
    }

    /// Coefficients of the basis' columns that belong to the present values.
    #[must_use]
    pub fn coefficients(&self) -> Vec<f64> {
        let mut coefficients = Vec::new();
        for (index, (parameter, value)) in self.parameters.iter().zip(&self.values).enumerate() {
            match parameter.role {
                Role::Linear | Role::Known { .. } | Role::Start { .. } => coefficients.push(*value),
                Role::Squared => coefficients.push(value * value),
                Role::Amplitude => {
                    let (sine, cosine) = libm::sincos(self.values[index + 1].to_radians());
                    coefficients.extend([value * cosine, value * sine]);
                }
                Role::Phase | Role::Nonlinear => {}
            }
        }
        coefficients
    }

    /// Prior `(mean, standard deviation)` of each coefficient that physics fixes.
    #[must_use]
    pub fn priors(&self) -> Vec<Option<(f64, f64)>> {
        let mut priors = Vec::new();
        for parameter in &self.parameters {
            match parameter.role {
                Role::Known { stderr } => {
                    priors.push(Some((parameter.default.unwrap_or(1.0), stderr)));
                }
                Role::Linear | Role::Squared | Role::Start { .. } => priors.push(None),
                Role::Amplitude => priors.extend([None, None]),
                Role::Phase | Role::Nonlinear => {}
            }
        }
        priors
    }

    /// Parameters with standard errors from fitted coefficients and their covariance.
    ///
    /// `covariance` is square, as wide as there are coefficients. Standard errors of amplitude,
    /// phase and squared parameters follow by the delta method, so they are honest while the
    /// value is large against them. The values of this term are not touched; nonlinear parameters
    /// are left out. A negative coefficient of a squared parameter gives 0.
    #[must_use]
    pub fn estimates(&self, coefficients: &[f64], covariance: &[Vec<f64>]) -> Vec<Estimate> {
        let mut estimates = Vec::new();
        let mut column = 0;
        for (parameter, what) in self.parameters.iter().enumerate() {
            let mut push = |parameter, value, variance: f64| {
                estimates.push(Estimate { parameter, value, stderr: variance.max(0.0).sqrt() });
            };
            match what.role {
                Role::Linear | Role::Known { .. } | Role::Start { .. } => {
                    push(parameter, coefficients[column], covariance[column][column]);
                    column += 1;
                }
                Role::Squared => {
                    let value = coefficients[column].max(0.0).sqrt();
                    let slope = 0.5 / value.max(covariance[column][column].max(0.0).sqrt().sqrt());
                    push(parameter, value, slope * slope * covariance[column][column]);
                    column += 1;
                }
                Role::Amplitude => {
                    let wave = Wave::new(&coefficients[column..], |i, j| {
                        covariance[column + i][column + j]
                    });
                    push(parameter, wave.amplitude, wave.amplitude_variance);
                    push(parameter + 1, wave.phase_rad.to_degrees(), wave.phase_variance_deg2());
                    column += 2;
                }
                Role::Phase | Role::Nonlinear => {}
            }
        }
        estimates
    }

    /// The same effect with the values that belong to these coefficients.
    #[must_use]
    pub fn with_coefficients(&self, coefficients: &[f64]) -> Self {
        let none = vec![vec![0.0; coefficients.len()]; coefficients.len()];
        let mut term = self.clone();
        for estimate in self.estimates(coefficients, &none) {
            term.values[estimate.parameter] = estimate.value;
        }
        term
    }

    /// The effect with its values put in, for runs and predictions.
    ///
    /// # Errors
    ///
    /// As [`Self::basis`].
    pub fn effect(&self, machine: &Machine, columns: &Columns) -> Result<Sum, EffectError> {
        let basis = self.basis(&Context { machine, columns })?;
        let mut parts: Vec<_> = self.coefficients().into_iter().zip(basis.columns).collect();
        parts.extend(basis.fixed.map(|fixed| (1.0, fixed)));
        Ok(Sum { parts })
    }

    /// Names the first sample at which one of the values of this effect is none that a machine could
    /// follow.
    ///
    /// # Errors
    ///
    /// [`EffectError::OutOfReach`] with that sample, and as [`Self::basis`].
    pub fn must_be_in_reach(&self, machine: &Machine, record: &Record) -> Result<(), EffectError> {
        let deltas = self.effect(machine, &record.columns)?.deltas_um(record);
        let beyond = deltas.iter().position(|delta_um| !in_reach(*delta_um));
        beyond.map_or(Ok(()), |row| {
            Err(EffectError::OutOfReach {
                effect: format!("effect `{}`", self.name),
                found: deltas[row].to_string(),
                place: moment(record.time_s[row], record.position_mm[row]),
            })
        })
    }

    /// The catalogue's card of this name.
    #[must_use]
    pub fn card(kind: &str) -> Option<&'static Card> {
        CATALOGUE.iter().copied().find(|card| card.kind == kind)
    }
}

/// An effect as the weighted sum of its unit effects.
#[derive(Debug)]
pub struct Sum {
    parts: Vec<(f64, Box<dyn Effect>)>,
}

impl Effect for Sum {
    fn delta_um(&self, now: &Instant<'_>) -> f64 {
        self.parts.iter().map(|(weight, part)| weight * part.delta_um(now)).sum()
    }

    fn deltas_um(&self, record: &Record) -> Vec<f64> {
        let mut sum = vec![0.0; record.len()];
        for (weight, part) in &self.parts {
            for (total, delta) in sum.iter_mut().zip(part.deltas_um(record)) {
                *total += weight * delta;
            }
        }
        sum
    }

    fn smoothness(&self, speed_rad_s: f64, travel_mm_s: f64) -> crate::Smoothness {
        let parts = self.parts.iter();
        crate::smoothness::combined(
            parts.map(|(weight, part)| (*weight, part.smoothness(speed_rad_s, travel_mm_s))),
        )
    }

    fn remembers(&self) -> bool {
        self.parts.iter().any(|(_, part)| part.remembers())
    }

    fn feeds_back(&self) -> bool {
        self.parts.iter().any(|(_, part)| part.feeds_back())
    }
}

/// A sinusoid from the coefficients of its sine and cosine.
struct Wave {
    amplitude: f64,
    phase_rad: f64,
    amplitude_variance: f64,
    phase_variance_rad2: f64,
}

impl Wave {
    fn new(coefficients: &[f64], covariance: impl Fn(usize, usize) -> f64) -> Self {
        let (sine, cosine) = (coefficients[0], coefficients[1]);
        let amplitude = libm::hypot(sine, cosine);
        let phase_rad = libm::atan2(cosine, sine);
        let (along, across) = ([sine, cosine], [-cosine, sine]);
        let square = |direction: [f64; 2]| {
            let cross = 2.0 * direction[0] * direction[1] * covariance(0, 1);
            direction[0] * direction[0] * covariance(0, 0)
                + cross
                + direction[1] * direction[1] * covariance(1, 1)
        };
        let power = (amplitude * amplitude).max(f64::MIN_POSITIVE);
        let amplitude_variance = square(along) / power;
        // A phase is known to half a turn at worst.
        let widest = std::f64::consts::PI * std::f64::consts::PI / 3.0;
        let phase_variance_rad2 = (square(across) / power / power).min(widest);
        Self { amplitude, phase_rad, amplitude_variance, phase_variance_rad2 }
    }

    fn phase_variance_deg2(&self) -> f64 {
        let degrees = self.phase_variance_rad2.sqrt().to_degrees();
        degrees * degrees
    }
}
