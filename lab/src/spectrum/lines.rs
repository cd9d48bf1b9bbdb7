//! All lines of a residual, one after the other, with the names the machine file gives them.

use helixlock_plant::Machine;

use super::bands::{self, Band};
use super::combs::{self, Comb};
use super::order_spectrum::{Line, Point, Scan};
use crate::model::{Columns, Fit, Problem, State, settle};
use crate::noise::Whitener;
use crate::numerics::{in_parallel, median, spread};
use crate::policy::chance::{LISTED_LINE, NAME_CELL, NAME_STANDARD_ERRORS, NEARLY_WHOLE};
use crate::policy::extent::{
    COMPARED_ROWS, HIGHEST_MULTIPLE, LISTED_LINES, NAMED_HARMONICS, NAMED_SPINDLE_HARMONICS,
    SLOWEST_WAVES,
};

/// A line with what is known of it.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedLine {
    /// The line; its frequency is in cycles a spindle turn.
    pub line: Line,
    /// Index of the sensor.
    pub sensor: usize,
    /// Shaft, mesh or screw of the machine file whose order it is.
    pub name: Option<String>,
    /// `(number, order)` when it is a harmonic of a stronger line.
    pub harmonic_of: Option<(u32, f64)>,
    /// Period in s at the usual speed.
    pub period_s: f64,
    /// Standard error of the period, s.
    pub period_stderr_s: f64,
    /// Period in mm of travel; `None` for rotary chains.
    pub period_mm: Option<f64>,
}

/// Rows of one sensor over one cyclic coordinate.
#[derive(Debug)]
pub(crate) struct LineSearch<'a> {
    /// The problem.
    pub(crate) problem: &'a Problem,
    /// Its fit: noise and residual.
    pub(crate) fit: &'a Fit,
    /// Index of the sensor.
    pub(crate) sensor: usize,
    /// Coordinate of every sample.
    pub(crate) coordinate: &'a [f64],
    /// Highest frequency that the coordinate resolves.
    pub(crate) highest: f64,
}

#[allow(
    clippy::redundant_closure_for_method_calls,
    reason = "the methods' own paths are not general enough over the lifetime of a scan"
)]
impl LineSearch<'_> {
    /// The strongest line there is.
    #[must_use]
    pub(crate) fn strongest(&self) -> Option<Line> {
        self.with_scan(|scan, white| scan.strongest(white))
    }

    /// A line found there, measured under the noise that is left when it is taken out: noise fitted
    /// with it inside is larger just where it stands. What it was found by stays.
    fn measured(&self, found: &Line) -> Line {
        let anew = self.with_scan(|scan, white| {
            let (frequency, _) = scan.settled(white, found.frequency);
            scan.line(white, frequency)
        });
        Line { gain: found.gain, p_value: found.p_value, ..anew }
    }

    /// The highest peak along each of some other coordinates of all samples, between two frequencies over it.
    #[must_use]
    pub(crate) fn highest_peaks(&self, others: &[(Vec<f64>, [f64; 2])]) -> Vec<Option<Point>> {
        let (_, rows) = self.problem.layout.of_sensor(self.sensor);
        let samples = &self.problem.samples[rows];
        self.with_scan(|scan, white| {
            let along = |(coordinate, [lowest, highest]): &(Vec<f64>, [f64; 2])| {
                let turns: Vec<f64> = samples.iter().map(|&sample| coordinate[sample]).collect();
                let slowest = SLOWEST_WAVES / spread(&turns).max(f64::MIN_POSITIVE);
                let (lowest, highest) = (lowest.max(slowest), *highest);
                let scan = Scan { turns: &turns, lowest, highest, ..scan.clone() };
                scan.spectrum(white).into_iter().max_by(|a, b| a.gain.total_cmp(&b.gain))
            };
            in_parallel(others, along)
        })
    }

    /// The strongest frequency of a wave of each pass's own size and phase, and how many such were looked at.
    #[must_use]
    pub(crate) fn strongest_in_each_pass(&self) -> Option<(f64, f64)> {
        self.with_scan(|scan, white| scan.strongest_in_each_block(white))
    }

    /// The clearest band of frequencies that is no line.
    #[must_use]
    pub(crate) fn band(&self) -> Option<Band> {
        self.with_scan(bands::clearest)
    }

    /// The clearest comb of frequencies.
    #[must_use]
    pub(crate) fn comb(&self) -> Option<Comb> {
        self.with_scan(combs::clearest)
    }

    /// Hands a scan and the whitened residual of this sensor to a function.
    fn with_scan<T>(&self, use_scan: impl FnOnce(&Scan<'_>, &[f64]) -> T) -> T {
        let (layout, rows) = self.problem.layout.of_sensor(self.sensor);
        let samples = &self.problem.samples[rows.clone()];
        let turns: Vec<f64> = samples.iter().map(|&sample| self.coordinate[sample]).collect();
        let noises = std::slice::from_ref(&self.fit.noises[self.sensor]);
        let whitener = Whitener::new(&layout, noises);
        let white = whitener.whiten(self.fit.left[rows].to_vec());
        let scan = Scan {
            layout: &layout,
            noises,
            turns: &turns,
            unit: &vec![1.0; turns.len()],
            whitener: &whitener,
            lowest: SLOWEST_WAVES / spread(&turns).max(f64::MIN_POSITIVE),
            highest: self.highest,
        };
        use_scan(&scan, &white)
    }
}

/// Every line over the spindle angle that the machine file leaves, strongest first; looked for in
/// means of neighbours where there are very many samples, as a comparison does.
#[must_use]
pub fn lines_left(problem: &Problem) -> Vec<NamedLine> {
    let thinned = problem.thinned(COMPARED_ROWS);
    let small = thinned.as_ref().unwrap_or(problem);
    let bare = State::bare(small);
    lines(small, &bare.columns, &bare.fit)
}

/// Every line over the spindle angle that a fit leaves, strongest first.
///
/// Each is taken out, and the noise fitted anew, before the next is looked for, so that a strong
/// line hides no weak one.
#[must_use]
pub(crate) fn lines(problem: &Problem, model: &Columns, fit: &Fit) -> Vec<NamedLine> {
    let turns: Vec<f64> = problem.record.turns().collect();
    let mut all = Vec::new();
    for sensor in 0..problem.sensors.len() {
        let mut columns = model.clone();
        let mut now = fit.clone();
        let mut found: Vec<NamedLine> = Vec::new();
        while found.len() < LISTED_LINES {
            let search = LineSearch {
                problem,
                fit: &now,
                sensor,
                coordinate: &turns,
                highest: problem.highest_order(),
            };
            let Some(line) = search.strongest() else { break };
            if LISTED_LINE < line.p_value {
                break;
            }
            columns = columns.and(&wave(problem, sensor, &turns, line.frequency));
            let without = settle(problem, &columns, &now.noises);
            let with = Fit { noises: without.noises.clone(), ..now.clone() };
            let line = LineSearch { fit: &with, ..search }.measured(&line);
            found.push(named(problem, sensor, line));
            now = without;
        }
        harmonics(&mut found);
        all.extend(found);
    }
    all
}

/// A wave of any size and phase over a coordinate, for one sensor.
#[must_use]
pub(crate) fn wave(problem: &Problem, sensor: usize, turns: &[f64], order: f64) -> Columns {
    let of = |phase: f64| {
        problem.alone(sensor, |sample| {
            libm::sin(std::f64::consts::TAU * order * turns[sample] + phase)
        })
    };
    Columns::free(vec![of(0.0), of(std::f64::consts::FRAC_PI_2)])
}

fn named(problem: &Problem, sensor: usize, line: Line) -> NamedLine {
    let machine = &problem.model;
    let mut speeds = problem.record.speed_rpm.clone();
    let usual = median(&mut speeds);
    let period_s = 60.0 / (usual * line.frequency);
    let resolution = 1.0 / spread(&problem.measurement.angle_rev).max(f64::MIN_POSITIVE);
    let slack = NAME_STANDARD_ERRORS * line.frequency_stderr + NAME_CELL * resolution;
    NamedLine {
        sensor,
        name: name(machine, line.frequency, slack),
        harmonic_of: None,
        period_s,
        period_stderr_s: period_s * line.frequency_stderr / line.frequency,
        period_mm: (!machine.rotary).then(|| machine.workpiece.lead.mm() / line.frequency),
        line,
    }
}

/// What in the machine file turns or meshes at an order, to within `slack`.
fn name(machine: &Machine, order: f64, slack: f64) -> Option<String> {
    let mut known: Vec<(f64, String)> = Vec::new();
    for gear in &machine.gears {
        known.push((gear.order, gear.name.clone()));
        known.extend(gear.mesh_order().map(|mesh| (mesh, format!("mesh of {}", gear.name))));
        for harmonic in 2..=NAMED_HARMONICS {
            known.push((gear.order * f64::from(harmonic), format!("{} × {harmonic}", gear.name)));
        }
    }
    if let Some(screw) = machine.lead_screw.as_ref().filter(|_| !machine.rotary) {
        let turns = machine.workpiece.lead.mm() / screw.mm();
        for harmonic in 1..=NAMED_HARMONICS {
            known.push((turns * f64::from(harmonic), format!("lead screw × {harmonic}")));
        }
    }
    if !machine.rotary {
        known.extend(
            (1..=NAMED_SPINDLE_HARMONICS).map(|n| (f64::from(n), format!("spindle × {n}"))),
        );
    }
    known
        .into_iter()
        .map(|(at, name)| ((at - order).abs(), name))
        .filter(|(apart, _)| *apart <= slack)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name)
}

/// Marks lines that are whole multiples of a stronger one.
fn harmonics(found: &mut [NamedLine]) {
    for index in 1..found.len() {
        let line = &found[index].line;
        let base = found[..index].iter().find_map(|other| {
            let ratio = line.frequency / other.line.frequency;
            let number = ratio.round();
            let slack = NAME_STANDARD_ERRORS
                * (line.frequency_stderr / other.line.frequency
                    + ratio * other.line.frequency_stderr / other.line.frequency);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "between 2 and 12"
            )]
            let harmonic = (2.0..=HIGHEST_MULTIPLE).contains(&number).then_some(number as u32)?;
            ((ratio - number).abs() < slack.min(NEARLY_WHOLE))
                .then_some((harmonic, other.line.frequency))
        });
        found[index].harmonic_of = base;
    }
}

/// Shafts and meshes of the gear table, also those faster than the samples: their aliases are
/// exact, because the columns are worked out at the very samples.
#[must_use]
pub(crate) fn gear_orders(machine: &Machine) -> Vec<f64> {
    let shafts = machine.gears.iter().map(|gear| gear.order);
    let meshes = machine.gears.iter().filter_map(helixlock_plant::machine::Gear::mesh_order);
    shafts.chain(meshes).collect()
}
