//! Two positions of another scale: an error that runs straight along the travel, by more than a machine's does.

use std::ops::Range;

use helixlock_plant::Part;

use super::along::{Line, travel};
use super::doubt::Doubt;
use crate::measurement::{ARCSEC_A_TURN, sensor_column};
use crate::model::Problem;
use crate::numerics::least_squares::{dot, fit};
use crate::numerics::{mean, spread};
use crate::policy::mistakes::{
    ANOTHER_SCALE, DRIFTS_UM_PER_H, GROWS_AS_AN_ANGLE, GROWS_UM, OFF_CENTRE, ONE_LINE_OF_A_TURN,
    RUNS_ALONG_SHARE, STRAIGHT, TOLD_FROM_TIME,
};

/// The doubt, of the first sensor that gives one.
///
/// A device that compares the two scales has settings for them, which are asked for elsewhere.
pub(super) fn another_scale(problem: &Problem) -> Option<Doubt> {
    let compares = problem.model.lacks(&[Part::Dividers]).is_none();
    let left = problem.residual();
    let mut sensors = (0..problem.sensors.len()).filter(|_| !compares);
    sensors.find_map(|sensor| {
        let line = Line::of(problem, sensor, &left)?;
        let steep = || Strokes::of(problem, sensor).are_steep(&left);
        (RUNS_ALONG_SHARE <= line.explained && steep()).then(|| said(problem, sensor, &line))
    })
}

/// Rows of a sensor by passes and ways, each stroke from a zero of its own.
struct Strokes<'a> {
    problem: &'a Problem,
    there: Vec<Vec<usize>>,
    back: Vec<Vec<usize>>,
    /// Where the travel begins and ends, µm (arcsec).
    travel: Range<f64>,
}

impl<'a> Strokes<'a> {
    fn of(problem: &'a Problem, sensor: usize) -> Self {
        let direction = |row: usize| problem.record.direction[problem.samples[row]];
        let strokes = |way: f64| {
            let blocks = problem.layout.blocks.iter().filter(|block| block.sensor == sensor);
            let rows = blocks.map(|block| block.rows.clone());
            let own = rows.map(|rows| rows.filter(|row| 0.0 < way * direction(*row)).collect());
            own.filter(|rows: &Vec<usize>| !rows.is_empty()).collect()
        };
        let [there, back]: [Vec<Vec<usize>>; 2] = [1.0, -1.0].map(strokes);
        let places = there.iter().chain(&back).flatten().map(|row| travel(problem, *row));
        let wider = |so_far: Range<f64>, place: f64| so_far.start.min(place)..so_far.end.max(place);
        let travel = places.fold(f64::INFINITY..f64::NEG_INFINITY, wider);
        Self { problem, there, back, travel }
    }

    /// True where values grow along all of the travel, either way, as no machine's error does.
    fn are_steep(&self, values: &[f64]) -> bool {
        let span = self.travel.end - self.travel.start;
        let middle = self.travel.start.midpoint(self.travel.end);
        let place = |row: usize| (travel(self.problem, row) - middle) / span;
        let both = !self.there.is_empty() && !self.back.is_empty();
        let of_time = if both {
            self.about_means(|row, way| way * place(row))
        } else {
            self.about_means(|row, _| self.problem.record.time_s[self.problem.samples[row]])
        };
        let powers = [1, 2, 3].map(|power| self.about_means(|row, _| place(row).powi(power)));
        let left_of_place = fit(&[&of_time], &powers[0]).residual_square;
        let is_told = TOLD_FROM_TIME * dot(&powers[0], &powers[0]) < left_of_place;
        let mut shapes: Vec<&[f64]> = powers.iter().map(Vec::as_slice).collect();
        shapes.extend(is_told.then_some(of_time.as_slice()));
        let sizes = fit(&shapes, &self.about_means(|row, _| values[row])).coefficients;
        let each_way = sizes.get(3).filter(|_| both).map_or(0.0, |size| size.abs());
        let grown = if is_told { 0.0 } else { self.may_grow() };
        let (flattest, steepest) = slopes(&sizes);
        let (flattest, steepest) = (flattest - each_way, steepest + each_way);
        STRAIGHT * steepest <= flattest && grown.max(self.least_share(both) * span) <= flattest
    }

    /// Share of the travel from which on an error that is straight is no machine's.
    fn least_share(&self, both: bool) -> f64 {
        let turns = (self.travel.end - self.travel.start) / ARCSEC_A_TURN;
        match (self.problem.measurement.rotary, both && 1.0 <= turns) {
            (true, true) => ONE_LINE_OF_A_TURN,
            (true, false) => OFF_CENTRE,
            _ => ANOTHER_SCALE,
        }
    }

    /// How much a drift and a growth may be in the time of the longest stroke, µm (arcsec).
    fn may_grow(&self) -> f64 {
        let time_s = |row: &usize| self.problem.record.time_s[self.problem.samples[*row]];
        let strokes = self.there.iter().chain(&self.back);
        let took_s = strokes.map(|rows| spread(&rows.iter().map(time_s).collect::<Vec<f64>>()));
        let longest_h = took_s.fold(0.0, f64::max) / 3600.0;
        let unit = if self.problem.measurement.rotary { GROWS_AS_AN_ANGLE } else { 1.0 };
        unit * (GROWS_UM + DRIFTS_UM_PER_H * longest_h)
    }

    /// Values of rows, by their way, from the mean of their stroke.
    fn about_means(&self, value: impl Fn(usize, f64) -> f64) -> Vec<f64> {
        let there = self.there.iter().map(|rows| (rows, 1.0));
        let all = there.chain(self.back.iter().map(|rows| (rows, -1.0)));
        let stroke = |(rows, way): (&Vec<usize>, f64)| {
            let values: Vec<f64> = rows.iter().map(|row| value(*row, way)).collect();
            let mean = mean(&values);
            values.into_iter().map(move |value| value - mean)
        };
        all.flat_map(stroke).collect()
    }
}

/// Least and greatest slope of a cubic over places from -½ to ½, upwards as it mostly is.
fn slopes(sizes: &[f64]) -> (f64, f64) {
    let up = sizes[0].signum();
    let slope =
        |place: f64| up * (sizes[0] + 2.0 * sizes[1] * place + 3.0 * sizes[2] * place * place);
    let flat = (-sizes[1] / (3.0 * sizes[2])).clamp(-0.5, 0.5);
    let all = [-0.5, flat, 0.5].map(slope);
    let end = |better: fn(f64, f64) -> f64| all.into_iter().reduce(better).unwrap_or(f64::NAN);
    (end(f64::min), end(f64::max))
}

fn said(problem: &Problem, sensor: usize, line: &Line) -> Doubt {
    let rotary = problem.measurement.rotary;
    let column = sensor_column(problem.sensors[sensor], rotary);
    let (grows, place) = if rotary {
        (format!("{:.4} arcsec a turn", ARCSEC_A_TURN * line.share), "angle_rev")
    } else {
        (format!("{:.4} µm/m", 1e6 * line.share), "position_mm")
    };
    let says = format!(
        "`{column}` grows straight with the travel, by {grows}: a lead, a circumference, a gear ratio or a number of lines is off by as much"
    );
    let mend = format!(
        "bring the two positions to one scale: one moves {:.6} times as far; to see what else there is, `helixlock add MACHINE.toml --formula \"k*{place}\" --set k=0 --fit DATA.csv -o NEW.toml`",
        1.0 - line.share
    );
    Doubt { what: "scale", evidence: line.evidence(), says, mend }
}
