//! How many waves of a machine's effects go by between two samples.

use std::f64::consts::TAU;

use helixlock_plant::{Context, Effect, Model, Record, Smoothness};

/// What may be a wave on a machine, or bends as quickly as one.
pub(crate) struct Waves {
    /// Effects of the file.
    units: Vec<Box<dyn Effect>>,
    /// That of the quickest wheel it lists, whose error may still be missing.
    order: f64,
    /// True where the recorder has a filter, or an effect is one of the error.
    remembered: bool,
}

impl Waves {
    /// Those of a machine with its effects on a record.
    pub(crate) fn of(model: &Model, record: &Record) -> Self {
        let context = Context { machine: model, columns: &record.columns };
        let bases = model.effects.iter().filter_map(|term| term.basis(&context).ok());
        let units = bases.flat_map(|basis| basis.columns.into_iter().chain(basis.fixed));
        let (feeding, units): (Vec<_>, Vec<_>) = units.partition(|unit| unit.feeds_back());
        let order = model.gears.iter().map(|gear| gear.order.abs()).fold(0.0, f64::max);
        let remembered = model.filter_cutoff_hz.is_some() || !feeding.is_empty();
        Self { units, order, remembered }
    }

    /// True where the file itself has something that depends on what was shown before.
    pub(crate) fn are_remembered(&self) -> bool {
        self.remembered
    }

    /// Waves of the quickest on the way to a sample from the one before it.
    pub(crate) fn between(&self, record: &Record, row: usize) -> f64 {
        let elapsed_s = record.time_s[row] - record.time_s[row - 1];
        if elapsed_s <= 0.0 {
            return 0.0;
        }
        // What the table did, and not the speed that was told: it may have stood.
        let run = |values: &[f64]| (values[row] - values[row - 1]).abs() / elapsed_s;
        let (speed_rad_s, travel_mm_s) = (run(&record.spindle_rad), run(&record.position_mm));
        let moving = self.units.iter().map(|unit| unit.smoothness(speed_rad_s, travel_mm_s));
        moving.map(Smoothness::rate_per_s).fold(self.order * speed_rad_s, f64::max) * elapsed_s
            / TAU
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::measurement::{Measurement, Nominal};
    use crate::model::{Columns, Component, Problem};
    use helixlock_traces::{Column, Table};

    use super::*;

    /// Rows of a pass.
    const ROWS: u32 = 60;

    /// A worm of 90 waves a turn at 2 rpm, 0.333 s each, before a lag.
    fn machine(effects: &str) -> Model {
        let text = format!(
            "output.rotary = true\nspindle.speed = '2 rpm'\n\
             gear = [{{ name = 'worm', order = 90 }}]\n{effects}"
        );
        Model::parse(&text, Path::new("machine.toml")).expect("a machine")
    }

    const WORM: &str = "[[effect]]\nkind = 'gear-error'\norder = 90\n\
                        amplitude = '1 arcsec'\nphase = '40 deg'\n";

    fn lag(tau_s: f64) -> String {
        format!("[[effect]]\nkind = 'recorder-lag'\ntime_constant = '{tau_s} s'\n")
    }

    /// Forth at the speed of the file and back at half of it, so many rows a wave on the way forth:
    /// `y = g·sin(φ − atan ωτ) + rest·exp(−t/τ)`, `g = 1/√(1 + ω²τ²)`, settled at each first row.
    fn rows(tau_s: f64, rows_a_wave: f64) -> Vec<[f64; 5]> {
        let mut all = Vec::new();
        let (mut turns, interval_s) = (0.1, 1.0 / 3.0 / rows_a_wave);
        for (pass, speed_rpm) in [(1.0, 2.0), (2.0, -1.0)] {
            let omega = TAU * 90.0 * speed_rpm / 60.0;
            let first = TAU * 90.0 * turns + 40.0_f64.to_radians();
            let late = |time_s: f64| {
                let phase = first + omega * time_s - libm::atan(omega * tau_s);
                libm::sin(phase) / (1.0 + (omega * tau_s).powi(2)).sqrt()
            };
            let rest = libm::sin(first) - late(0.0);
            let begins_s = 100.0 * pass;
            for row in 0..ROWS {
                let time_s = interval_s * f64::from(row);
                let shown = late(time_s) + rest * libm::exp(-time_s / tau_s);
                let at = turns + speed_rpm / 60.0 * time_s;
                all.push([begins_s + time_s, at, pass, speed_rpm.abs(), -shown]);
            }
            turns += speed_rpm / 60.0 * interval_s * f64::from(ROWS - 1);
        }
        all
    }

    fn problem(model: &Model, rows: &[[f64; 5]]) -> Problem {
        let names = ["time_s", "angle_rev", "pass", "speed_rpm", "error_arcsec"];
        let column = |(index, name): (usize, &&str)| Column {
            name: (*name).to_owned(),
            values: rows.iter().map(|row| row[index]).collect(),
        };
        let table = Table::new(names.iter().enumerate().map(column).collect());
        let measurement = Measurement::from_table(&table, &Nominal::of(model)).expect("samples");
        Problem::new(model, &measurement).expect("all columns")
    }

    /// Largest of what is left, each pass from its first row.
    fn most(left: &[f64]) -> f64 {
        let passes = left.chunks(ROWS as usize);
        passes.flat_map(|pass| pass.iter().map(|now| (now - pass[0]).abs())).fold(0.0, f64::max)
    }

    #[test]
    fn a_lag_of_a_quick_wave_is_what_the_closed_form_says_however_few_the_rows() {
        for rows_a_wave in [0.7, 2.5, 7.0, 10.5, 20.0] {
            for tau_s in [0.02, 0.05, 0.5] {
                let model = machine(&(WORM.to_owned() + &lag(tau_s)));
                let left = problem(&model, &rows(tau_s, rows_a_wave)).residual();
                let most = most(&left);
                assert!(most < 0.008, "{rows_a_wave} rows a wave, {tau_s} s: {most}");
            }
        }
    }

    /// Its size and phase are those at the machine, as the file would have them.
    #[test]
    fn a_wave_that_is_missing_beside_a_lag_is_seen_through_it() {
        let (tau_s, whole) = (0.05, machine(&(WORM.to_owned() + &lag(0.05))));
        let rows = rows(tau_s, 2.5);
        let known = problem(&whole, &rows).residual();
        let [worm, delay] = whole.effects.as_slice() else { panic!("two effects") };
        for (file, missing) in [(lag(tau_s), vec![worm]), (String::new(), vec![worm, delay])] {
            let problem = problem(&machine(&file), &rows);
            let components: Vec<Component> =
                missing.into_iter().cloned().map(Component::new).collect();
            let columns = Columns::of(&problem, &components).expect("columns");
            let left = columns.left(&problem.residual(), &worm.coefficients());
            let off = left.iter().zip(&known).map(|(left, known)| (left - known).abs());
            assert!(off.fold(0.0, f64::max) < 1e-9, "{file}: {left:?}");
        }
    }
}
