//! Many machines that differ in a few values of the file: a grid, chance, or both.
//!
//! An axis names a key of the machine file and its values; a case takes one of each, the last axis
//! running fastest. Drawn axes take a value by chance, uniformly, anew for every case; the value
//! depends on the seed and the number of the case alone, so that any case can be run again by itself.

use helixlock_plant::{MachineError, MachineFile};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Uniform};
use thiserror::Error;

use crate::Error;
use crate::closed_loop::{Options, Simulation, simulate};

/// Columns of results, after those of the axes.
pub const FIGURES: &[&str] = &[
    "open_periodic_um",
    "open_cumulative_um",
    "open_total_um",
    "closed_periodic_um",
    "closed_cumulative_um",
    "closed_total_um",
    "closed_recorder_um",
    "hunting_hz",
    "hunting_swing_um",
    "slew_limited",
    "steps_net",
    "steps_taken",
    "fault",
];

/// Most cases of a sweep: at a tenth of a second each, a day on one core.
pub const MOST_CASES: u64 = 1_000_000;

/// What is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Varied in a grid.
    pub grid: Vec<Axis>,
    /// Varied by chance.
    pub drawn: Vec<DrawnAxis>,
    /// Samples at every point of the grid; 1 without drawn axes.
    pub samples: u64,
    /// Of the draws.
    pub seed: u64,
}

/// One key with its values.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Such as `drive.frequency` or `effect.0.amplitude`.
    pub key: String,
    /// In `unit`, in order.
    pub values: Vec<f64>,
    /// As in the machine file; empty for a plain number.
    pub unit: String,
}

/// One key with its bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct DrawnAxis {
    /// Such as `drive.frequency` or `effect.0.amplitude`.
    pub key: String,
    /// Lowest value, in `unit`.
    pub low: f64,
    /// Bound above, in `unit`.
    pub high: f64,
    /// As in the machine file; empty for a plain number.
    pub unit: String,
}

/// One machine of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    /// Place in the plan, from 0.
    pub index: u64,
    /// Keys with their TOML values.
    pub settings: Vec<(String, String)>,
    /// The values alone, grid first.
    pub values: Vec<f64>,
}

/// An axis that cannot be understood.
#[derive(Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum AxisError {
    /// No `=`, or nothing on one side of it.
    #[error("`{text}`: expected KEY=VALUES, such as `drive.frequency=80,160 Hz`")]
    Shape {
        /// What was given.
        text: String,
    },
    /// Something that should be a number.
    #[error("`{text}`: found `{found}`, expected a number")]
    Number {
        /// What was given.
        text: String,
        /// The part that is no number.
        found: String,
    },
    /// A range that has no length, or too few values.
    #[error("`{text}`: expected {expected}")]
    Range {
        /// What was given.
        text: String,
        /// What a range looks like.
        expected: &'static str,
    },
}

/// A case that gives no figures.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum CaseError {
    /// The values do not make a machine file.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// The machine cannot be simulated.
    #[error(transparent)]
    Simulation(#[from] Error),
}

impl Axis {
    /// Reads `drive.frequency=80,160,320 Hz` or `drive.frequency=40..320:8 Hz`, eight values from
    /// 40 to 320.
    ///
    /// # Errors
    ///
    /// [`AxisError`] names the part that is wrong.
    pub fn parse(text: &str) -> Result<Self, AxisError> {
        let (key, numbers, unit) = split(text)?;
        let values = if let Some((low, rest)) = numbers.split_once("..") {
            evenly(text, low, rest)?
        } else {
            numbers.split(',').map(|word| number(text, word)).collect::<Result<_, _>>()?
        };
        Ok(Self { key, values, unit })
    }

    /// Name of the column: the key with the unit.
    #[must_use]
    pub fn column(&self) -> String {
        column(&self.key, &self.unit)
    }
}

impl DrawnAxis {
    /// Reads `effect.0.amplitude=0.5..3 um`.
    ///
    /// # Errors
    ///
    /// [`AxisError`] names the part that is wrong.
    pub fn parse(text: &str) -> Result<Self, AxisError> {
        let expected = "LOW..HIGH with LOW below HIGH";
        let wrong = || AxisError::Range { text: text.into(), expected };
        let (key, numbers, unit) = split(text)?;
        let (low, high) = numbers.split_once("..").ok_or_else(wrong)?;
        let (low, high) = (number(text, low)?, number(text, high)?);
        if low < high { Ok(Self { key, low, high, unit }) } else { Err(wrong()) }
    }

    /// Name of the column: the key with the unit.
    #[must_use]
    pub fn column(&self) -> String {
        column(&self.key, &self.unit)
    }
}

impl Plan {
    /// Number of cases; the largest number there is when they are more.
    #[must_use]
    pub fn cases(&self) -> u64 {
        let lengths = self.grid.iter().map(|axis| axis.values.len() as u64);
        lengths.fold(self.samples, u64::saturating_mul)
    }

    /// Names of the columns of [`Case::values`].
    #[must_use]
    pub fn columns(&self) -> Vec<String> {
        let grid = self.grid.iter().map(Axis::column);
        grid.chain(self.drawn.iter().map(DrawnAxis::column)).collect()
    }

    /// Looks for every key in the file.
    ///
    /// # Errors
    ///
    /// [`MachineError`] of a key that no machine file has: no case could be run with it. What a value
    /// is refused for is that case's own.
    pub fn check_keys(&self, file: &MachineFile) -> Result<(), MachineError> {
        let mut file = file.clone();
        for (key, value) in self.case(0).settings {
            match file.with_setting(&key, &value) {
                Ok(set) => file = set,
                Err(error @ (MachineError::UnknownKey { .. } | MachineError::NoSuchKey { .. })) => {
                    return Err(error);
                }
                Err(_) => {}
            }
        }
        Ok(())
    }

    /// The case of a number below [`Plan::cases`].
    #[must_use]
    pub fn case(&self, index: u64) -> Case {
        let mut point = index / self.samples.max(1);
        let mut chosen = Vec::new();
        for axis in self.grid.iter().rev() {
            let length = axis.values.len() as u64;
            let value = usize::try_from(point % length).map_or(0.0, |place| axis.values[place]);
            chosen.push((&axis.key, value, &axis.unit));
            point /= length;
        }
        chosen.reverse();
        let mut chance = ChaCha8Rng::seed_from_u64(self.seed);
        chance.set_stream(index);
        for axis in &self.drawn {
            let value = Uniform::new(axis.low, axis.high)
                .map_or(axis.low, |uniform| uniform.sample(&mut chance));
            chosen.push((&axis.key, value, &axis.unit));
        }
        let settings = chosen.iter().map(|(key, value, unit)| ((*key).clone(), toml(*value, unit)));
        Case {
            index,
            settings: settings.collect(),
            values: chosen.iter().map(|(_, value, _)| *value).collect(),
        }
    }
}

impl Case {
    /// Simulates the machine of this case; gives [`FIGURES`].
    ///
    /// # Errors
    ///
    /// [`CaseError`] when the values do not fit a machine, or the device cannot serve it.
    pub fn run(&self, file: &MachineFile, options: &Options) -> Result<Vec<f64>, CaseError> {
        let mut file = file.clone();
        for (key, value) in &self.settings {
            file = file.with_setting(key, value)?;
        }
        Ok(figures(&simulate(&file.model, options, &mut |_| {})?))
    }
}

#[expect(clippy::cast_precision_loss, reason = "steps stay far below 2⁵³")]
fn figures(simulation: &Simulation) -> Vec<f64> {
    let found = simulation.findings();
    let closed = &simulation.closed;
    let (open_lead, closed_lead) = (found.open.lead, found.closed.lead);
    let flag = |set: bool| f64::from(u8::from(set));
    vec![
        open_lead.periodic_um,
        open_lead.cumulative_um,
        open_lead.total_um,
        closed_lead.periodic_um,
        closed_lead.cumulative_um,
        closed_lead.total_um,
        found.closed.recorder_um,
        found.hunting.map_or(f64::NAN, |hunting| hunting.frequency_hz),
        found.hunting.map_or(f64::NAN, |hunting| hunting.swing_um),
        flag(found.slew_limited),
        closed.steps_net as f64,
        closed.steps_taken as f64,
        flag(closed.fault),
    ]
}

/// Key, numbers, unit.
fn split(text: &str) -> Result<(String, String, String), AxisError> {
    let wrong = || AxisError::Shape { text: text.into() };
    let (key, rest) = text.split_once('=').ok_or_else(wrong)?;
    let rest = rest.trim();
    // The unit follows the last number.
    let last = rest.rfind(',').map_or(0, |comma| comma + 1);
    let length = rest[last..].find(|c: char| !"0123456789+-.:eE ".contains(c));
    let end = length.map_or(rest.len(), |length| last + length);
    // An exponent's letter may also begin a unit: what is left must end in a digit.
    let digit = rest[..end].rfind(|c: char| c.is_ascii_digit());
    let end = digit.map_or(end, |digit| digit + 1).max(last);
    if key.trim().is_empty() || rest.is_empty() {
        return Err(wrong());
    }
    let (numbers, unit) = rest.split_at(end);
    Ok((key.trim().into(), numbers.into(), unit.trim().into()))
}

fn evenly(text: &str, low: &str, rest: &str) -> Result<Vec<f64>, AxisError> {
    let expected = "LOW..HIGH:COUNT with a COUNT of 2 to 1000000";
    let wrong = || AxisError::Range { text: text.into(), expected };
    let (high, count) = rest.split_once(':').ok_or_else(wrong)?;
    let (low, high) = (number(text, low)?, number(text, high)?);
    let count: u32 = count.trim().parse().map_err(|_| wrong())?;
    if count < 2 || MOST_CASES < u64::from(count) {
        return Err(wrong());
    }
    let step = (high - low) / f64::from(count - 1);
    Ok((0..count).map(|place| low + step * f64::from(place)).collect())
}

fn number(text: &str, word: &str) -> Result<f64, AxisError> {
    let word = word.trim();
    let wrong = || AxisError::Number { text: text.into(), found: word.into() };
    word.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(wrong)
}

fn column(key: &str, unit: &str) -> String {
    let unit = unit.to_lowercase().replace('/', "_per_").replace(' ', "_").replace('^', "");
    if unit.is_empty() { key.to_owned() } else { format!("{key}_{unit}") }
}

fn toml(value: f64, unit: &str) -> String {
    if unit.is_empty() { value.to_string() } else { format!("\"{value} {unit}\"") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        Plan {
            grid: vec![
                Axis::parse("drive.frequency=80, 160 Hz").unwrap(),
                Axis::parse("dividers.b=148..152:3").unwrap(),
            ],
            drawn: vec![DrawnAxis::parse("effect.0.amplitude=0.5..3 um").unwrap()],
            samples: 2,
            seed: 7,
        }
    }

    #[test]
    fn the_last_axis_runs_fastest_and_samples_faster() {
        let plan = plan();
        assert_eq!(plan.cases(), 12);
        assert_eq!(plan.columns(), ["drive.frequency_hz", "dividers.b", "effect.0.amplitude_um"]);
        let grid: Vec<_> = (0..12).map(|index| plan.case(index).values[..2].to_vec()).collect();
        assert_eq!(grid[0], [80.0, 148.0]);
        assert_eq!(grid[1], [80.0, 148.0]);
        assert_eq!(grid[3], [80.0, 150.0]);
        assert_eq!(grid[11], [160.0, 152.0]);
        assert_eq!(plan.case(3).settings[1], ("dividers.b".into(), "150".into()));
        assert_eq!(plan.case(3).settings[0].1, "\"80 Hz\"");
    }

    #[test]
    fn more_cases_than_can_be_counted_are_not_none() {
        let axis = Axis::parse("dividers.b=1..65536:65536").unwrap();
        let plan = Plan { grid: vec![axis; 4], drawn: Vec::new(), samples: 1, seed: 1 };
        assert_eq!(plan.cases(), u64::MAX);
        assert!(Axis::parse("dividers.b=1..2:4000000000").is_err());
    }

    #[test]
    fn a_draw_depends_on_seed_and_case_alone() {
        let draws: Vec<f64> = (0..12).map(|index| plan().case(index).values[2]).collect();
        assert!(draws.iter().all(|draw| (0.5..3.0).contains(draw)));
        assert!(draws.windows(2).all(|pair| pair[0].to_bits() != pair[1].to_bits()));
        assert_eq!(plan().case(5), plan().case(5));
        let other = Plan { seed: 8, ..plan() };
        assert_ne!(plan().case(5).values[2].to_bits(), other.case(5).values[2].to_bits());
    }

    #[test]
    fn units_may_begin_like_exponents() {
        let axis = Axis::parse("a.b=1e3,2 expansions/m^2").unwrap();
        assert_eq!((axis.values, axis.unit.as_str()), (vec![1000.0, 2.0], "expansions/m^2"));
    }

    #[test]
    fn words_that_are_no_axis_are_told() {
        let message = |text: &str| Axis::parse(text).unwrap_err().to_string();
        assert!(message("drive.frequency").contains("expected KEY=VALUES"));
        assert!(message("a=1,x,3 Hz").contains("expected a number"), "{}", message("a=1,x,3 Hz"));
        assert!(message("a=1..2 Hz").contains("LOW..HIGH:COUNT"));
        assert!(message("a=1..2:1 Hz").contains("COUNT of 2 to 1000000"));
        let drawn = DrawnAxis::parse("a=3..1 um").unwrap_err().to_string();
        assert!(drawn.contains("LOW below HIGH"));
    }
}
