//! An effect is a card and a formula: what both look like.

use std::borrow::Cow;
use std::fmt;
use std::ops::RangeInclusive;

use crate::machine::Part;
use crate::nature::Nature;
use crate::units::Unit;
use crate::{EffectError, Instant, Machine, Record, record::Columns};

/// The one place where an effect enters the machine; it decides which sensor sees it how.
///
/// | entry | meaning of δ, µm |
/// |---|---|
/// | motion | the table is ahead by δ |
/// | length reference | the laser reads short by δ |
/// | angle reference | the grating reads ahead by δ, as lead |
/// | workpiece | the thread ends up longer by δ |
/// | electronics | the meter shows δ too much |
/// | actuator | the correction falls short by δ |
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entry {
    /// Table motion.
    Motion,
    /// The laser.
    LengthReference,
    /// The grating.
    AngleReference,
    /// The finished thread alone.
    Workpiece,
    /// The meter.
    Electronics,
    /// The corrector.
    Actuator,
}

impl Entry {
    /// All entries, in the order of the table.
    pub const ALL: [Self; 6] = [
        Self::Motion,
        Self::LengthReference,
        Self::AngleReference,
        Self::Workpiece,
        Self::Electronics,
        Self::Actuator,
    ];

    /// As it is written in a machine file.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Motion => "motion",
            Self::LengthReference => "length-reference",
            Self::AngleReference => "angle-reference",
            Self::Workpiece => "workpiece",
            Self::Electronics => "electronics",
            Self::Actuator => "actuator",
        }
    }
}

impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

/// How a parameter enters its effect, and so how it is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// δ is proportional to it: one design column, the coefficient is the value.
    Linear,
    /// δ is proportional to its square: one design column, the coefficient is the value squared.
    Squared,
    /// Amplitude of a sinusoid whose phase is the next parameter: two columns, sine and cosine.
    Amplitude,
    /// Phase of the sinusoid whose amplitude is the parameter before.
    Phase,
    /// Physics fixes it to its default: one column, fitted only within this standard deviation.
    Known {
        /// Standard deviation of the prior, in the parameter's unit.
        stderr: f64,
    },
    /// Anything else: the columns depend on it.
    Nonlinear,
    /// What a pass began with, of an effect with a memory: one design column. It is none of the
    /// machine's numbers, and no file has it.
    Start {
        /// The pass, as [`Record::pass`] numbers it.
        pass: usize,
    },
}

/// Where values of a nonlinear parameter are worth trying.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// Evenly over the range.
    Linear,
    /// Evenly over the logarithm of the range.
    Logarithmic,
    /// Every whole number in the range.
    Whole,
    /// Anywhere in the travel of the record, mm.
    Position,
    /// Anywhere in the time of the record, s.
    Time,
    /// Orders of the gears in the machine file, of shafts and of meshes, turns per spindle turn.
    GearOrder,
    /// Each whole number in the range that the record may tell, as a look of its own; mostly the default stands.
    Switch,
    /// It is not searched for: the default stands.
    Fixed,
}

/// What 1 µm at the teeth of the smallest wheels, of 5.7 mm radius, is as an angle: plausible
/// values of a rotary chain are those of a servo as well as those of a telescope.
const ARCSEC_A_UM: f64 = 36.0;

/// How far off a coarse sensor of a rotary chain may be, a resolver or the poles of a magnet: ten
/// degrees.
const COARSE_ARCSEC: f64 = 36_000.0;

/// A number an effect needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its key in the machine file.
    pub name: Cow<'static, str>,
    /// Unit of its value.
    pub unit: Unit,
    /// True for a length of a part, which stays one where δ is an angle.
    pub of_part: bool,
    /// True for a way of what moves, which is an angle on a rotary chain.
    pub of_way: bool,
    /// Plausible values; a fit that ends at an end has failed.
    pub range: RangeInclusive<f64>,
    /// What stands when the file does not say; `None` makes it required.
    pub default: Option<f64>,
    /// How it enters.
    pub role: Role,
    /// Where to look for it, if nonlinear.
    pub search: Search,
    /// What it is, in words.
    pub meaning: Cow<'static, str>,
}

impl Parameter {
    const fn new(name: &'static str, unit: Unit, role: Role, meaning: &'static str) -> Self {
        Self {
            name: Cow::Borrowed(name),
            unit,
            of_part: false,
            of_way: false,
            range: 0.0..=0.0,
            default: None,
            role,
            search: Search::Fixed,
            meaning: Cow::Borrowed(meaning),
        }
    }

    /// δ is proportional to it.
    #[must_use]
    pub const fn linear(name: &'static str, unit: Unit, meaning: &'static str) -> Self {
        Self::new(name, unit, Role::Linear, meaning)
    }

    /// δ is proportional to its square.
    #[must_use]
    pub const fn squared(name: &'static str, unit: Unit, meaning: &'static str) -> Self {
        Self::new(name, unit, Role::Squared, meaning)
    }

    /// An amplitude; [`Self::phase`] must follow it.
    #[must_use]
    pub const fn amplitude(name: &'static str, unit: Unit, meaning: &'static str) -> Self {
        Self::new(name, unit, Role::Amplitude, meaning)
    }

    /// The phase, 0 by default, of the amplitude before it.
    #[must_use]
    pub const fn phase(name: &'static str, meaning: &'static str) -> Self {
        Self::new(name, crate::units::DEG, Role::Phase, meaning).within(-180.0..=180.0).or(0.0)
    }

    /// Fixed by physics to 1, within the standard deviation `stderr`.
    #[must_use]
    pub const fn known(stderr: f64, meaning: &'static str) -> Self {
        let role = Role::Known { stderr };
        Self::new("scale", crate::units::NUMBER, role, meaning).within(0.5..=1.5).or(1.0)
    }

    /// The columns depend on it; `search` says where to look for it.
    #[must_use]
    pub const fn nonlinear(
        name: &'static str,
        unit: Unit,
        search: Search,
        meaning: &'static str,
    ) -> Self {
        let mut parameter = Self::new(name, unit, Role::Nonlinear, meaning);
        parameter.search = search;
        parameter
    }

    /// What a pass began with, δ there being 0 otherwise.
    #[must_use]
    pub const fn start(pass: usize) -> Self {
        let role = Role::Start { pass };
        Self::new("start", crate::units::UM, role, "of a pass").or(0.0)
    }

    /// A number of a formula of the user's, near a value; [`crate::Custom`] says how it enters.
    #[must_use]
    pub fn of_formula(name: String, value: f64) -> Self {
        let reach = 10.0 * value.abs().max(1e-6);
        let number = crate::units::NUMBER;
        let what = Self::nonlinear("", number, Search::Linear, "of the user's formula");
        Self { name: Cow::Owned(name), ..what.within(-reach..=reach) }
    }

    /// With these plausible values.
    #[must_use]
    pub const fn within(mut self, range: RangeInclusive<f64>) -> Self {
        self.range = range;
        self
    }

    /// As a length of a part: it stays one on a rotary chain.
    #[must_use]
    pub const fn of_part(mut self) -> Self {
        self.of_part = true;
        self
    }

    /// As a way of what moves, in mm: as many degrees are as plausible on a rotary chain.
    #[must_use]
    pub const fn of_way(mut self) -> Self {
        self.of_way = true;
        self
    }

    /// The same parameter on a rotary chain: δ is in seconds of arc there.
    #[must_use]
    pub fn on_rotary_chain(mut self) -> Self {
        if self.of_way {
            self.unit = crate::units::DEG;
            return self;
        }
        let angular = self.unit.on_rotary_chain();
        if !self.of_part && angular != self.unit {
            self.unit = angular;
            let least = if self.is_nonlinear() { 0.0 } else { COARSE_ARCSEC };
            let wider = |bound: &f64| {
                if *bound == 0.0 {
                    0.0
                } else {
                    (ARCSEC_A_UM * bound.abs()).max(least).copysign(*bound)
                }
            };
            self.range = wider(self.range.start())..=wider(self.range.end());
        }
        self
    }

    /// With a default.
    #[must_use]
    pub const fn or(mut self, default: f64) -> Self {
        self.default = Some(default);
        self
    }

    /// Its name with its unit, as a key of results: `offset_mm`.
    #[must_use]
    pub fn key(&self) -> String {
        match self.unit.suffix().as_str() {
            "" => self.name.to_string(),
            suffix => format!("{}_{suffix}", self.name),
        }
    }

    /// True when the design columns depend on it.
    #[must_use]
    pub fn is_nonlinear(&self) -> bool {
        self.role == Role::Nonlinear
    }

    /// True when it takes listed values only.
    #[must_use]
    pub fn is_listed(&self) -> bool {
        matches!(self.search, Search::Whole | Search::GearOrder | Search::Switch | Search::Fixed)
    }

    /// True when it takes whole numbers only.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        matches!(self.search, Search::Whole | Search::Switch)
    }

    /// True for what a pass began with.
    #[must_use]
    pub fn is_start(&self) -> bool {
        matches!(self.role, Role::Start { .. })
    }

    /// True for a time or a way that an effect takes only where the data ask for one.
    #[must_use]
    pub fn may_be_none(&self) -> bool {
        self.search == Search::Logarithmic && self.default == Some(0.0)
    }

    /// True for a frequency in time, which a spectrum finds better than a grid.
    #[must_use]
    pub fn is_frequency(&self) -> bool {
        self.unit.suffix() == "hz" && self.search != Search::Fixed
    }
}

/// What an effect is worked out for.
#[derive(Clone, Copy, Debug)]
pub struct Context<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The logged columns that instants will carry.
    pub columns: &'a Columns,
}

/// A formula with all its numbers put in: δ in µm (arcsec on a rotary chain).
pub trait Effect: fmt::Debug + Send + Sync {
    /// δ at an instant.
    fn delta_um(&self, now: &Instant<'_>) -> f64;

    /// δ for every sample; an effect with a memory overrides this and looks at the samples before.
    fn deltas_um(&self, record: &Record) -> Vec<f64> {
        record.instants().map(|now| self.delta_um(&now)).collect()
    }

    /// How fast δ can change in time while the spindle turns at constant speed.
    ///
    /// Lets the solver of [`crate::edges`] replace the formula by polynomials with a proven
    /// error; [`Smoothness::Rough`] makes it evaluate the formula each time.
    fn smoothness(&self, _speed_rad_s: f64, _travel_mm_s: f64) -> Smoothness {
        Smoothness::Rough
    }

    /// True when δ depends on [`Instant::error_um`], so that it has to be evaluated last.
    fn feeds_back(&self) -> bool {
        false
    }

    /// True when δ depends on the samples before it, and so on how close they are.
    fn remembers(&self) -> bool {
        false
    }

    /// What δ has more in a pass that began with δ = 1; `None` of an effect without a memory, or one
    /// whose memory the record tells.
    fn started(&self, _pass: usize) -> Option<Box<dyn Effect>> {
        None
    }
}

/// Bound on an effect between two reversals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Smoothness {
    /// A polynomial in time of degree 11 at most.
    Polynomial,
    /// From the second to the twelfth, derivative `k` in time stays below `amplitude_um · rate^k`.
    Band {
        /// Scale, µm.
        amplitude_um: f64,
        /// Rate, 1/s.
        rate_per_s: f64,
    },
    /// Nothing is promised.
    Rough,
}

impl Smoothness {
    /// How quickly it waves, 1/s; nothing of what has no rate.
    #[must_use]
    pub fn rate_per_s(self) -> f64 {
        match self {
            Self::Band { rate_per_s, .. } => rate_per_s,
            Self::Polynomial | Self::Rough => 0.0,
        }
    }
}

/// Unit effects that add up to an effect: δ = Σ coefficient · column + fixed.
#[derive(Debug, Default)]
pub struct Basis {
    /// One for each coefficient, in the order of the parameters; a phase adds the cosine column.
    pub columns: Vec<Box<dyn Effect>>,
    /// What does not scale with any parameter, such as a sawtooth whose height is its period.
    pub fixed: Option<Box<dyn Effect>>,
}

impl Basis {
    /// A basis of one column.
    pub fn one(column: impl Effect + 'static) -> Self {
        Self { columns: vec![Box::new(column)], fixed: None }
    }

    /// A basis of a sine and a cosine column.
    pub fn two(sine: impl Effect + 'static, cosine: impl Effect + 'static) -> Self {
        Self { columns: vec![Box::new(sine), Box::new(cosine)], fixed: None }
    }

    /// A basis without coefficients.
    pub fn fixed(effect: impl Effect + 'static) -> Self {
        Self { columns: Vec::new(), fixed: Some(Box::new(effect)) }
    }
}

/// Everything there is to know of an effect: simulation, fit, ranking, advice and guide read it.
#[derive(Debug)]
pub struct Card {
    /// Its name in a machine file.
    pub kind: &'static str,
    /// Where it enters.
    pub entry: Entry,
    /// What happens, in one sentence.
    pub summary: &'static str,
    /// δ in µm; the symbols are those of the effect's page.
    pub formula: &'static str,
    /// A worked number.
    pub example: &'static str,
    /// Its numbers, in the order of `values`.
    pub parameters: &'static [Parameter],
    /// Parts of the machine it cannot do without.
    pub parts: &'static [Part],
    /// Logged columns it cannot do without.
    pub needs: &'static [&'static str],
    /// What gives it away in data.
    pub signature: &'static str,
    /// Other effects that look alike.
    pub confused_with: &'static [&'static str],
    /// The experiment that tells them apart.
    pub separated_by: &'static str,
    /// Where the formula and the numbers come from.
    pub source: &'static str,
    /// True when it is chance, so that its size can be estimated but not its course.
    pub random: bool,
    /// True when it must be looked for in data; false when it is a means of simulation only.
    pub candidate: bool,
    /// What is special about it.
    pub nature: Nature,
    /// The unit effects for given values of the nonlinear parameters, in their order.
    pub basis: fn(&Context<'_>, &[f64]) -> Result<Basis, EffectError>,
}
