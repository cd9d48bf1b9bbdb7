use std::path::Path;

use helixlock_sim::{Options, simulate};
use helixlock_traces::{Column, Table};

use super::*;
use crate::measurement::{Nominal, means};

/// 12.64 comparisons a second, 13 steps of the motor in each: a swing of 0.158 µm.
fn machine(more: &str) -> Model {
    machine_with(more, "")
}

fn machine_with(dividers: &str, rest: &str) -> Model {
    let text = format!(
        "workpiece.lead = '6 mm'\nspindle.speed = '6 rpm'\ngrating.lines = 13906\n\
         laser.wavelength = '0.63281983 um'\ndividers = {{ a = 110, b = 150, {dividers} }}\n\
         drive = {{ step = '0.0125 um', frequency = '160 Hz' }}\n{rest}"
    );
    Model::parse(&text, Path::new("machine.toml")).expect("a machine")
}

fn problem(machine: &Model, columns: &[(&str, Vec<f64>)]) -> Problem {
    let column = |(name, values): &(&str, Vec<f64>)| Column {
        name: (*name).to_owned(),
        values: values.clone(),
    };
    let table = Table::new(columns.iter().map(column).collect());
    let measurement = Measurement::from_table(&table, &Nominal::of(machine));
    Problem::new(machine, &measurement.expect("a measurement")).expect("no columns missing")
}

/// The counter of a loop that follows 30 µm/m and swings by 13 steps from comparison to comparison,
/// read at every second of them, stands still most of the time.
#[test]
fn a_counter_that_stands_still_between_readings_hunts_no_less() {
    let mut model = machine("");
    model.machine.loop_closed = true;
    let comparisons: Vec<f64> = (0..6000).map(|row| f64::from(row) / 12.64).collect();
    let mut net = 0.0;
    let all = comparisons.iter().map(|time_s| {
        let due_um = 30e-3 * 0.6 * time_s;
        net += if net * 0.0125 < due_um { 13.0 } else { -13.0 };
        net
    });
    let steps: Vec<f64> = all.collect::<Vec<f64>>().into_iter().step_by(2).collect();
    let still = steps.windows(2).filter(|pair| pair[0].to_bits() == pair[1].to_bits()).count();
    assert!(steps.len() < 2 * still, "{still} of {}", steps.len());
    let time_s = comparisons.iter().copied().step_by(2).collect();
    let hunting_um = problem(&model, &[("time_s", time_s), ("steps", steps)]).hunting_um;
    assert!((hunting_um - 0.158).abs() < 0.001, "{hunting_um}");
}

/// λ/2 of lag at every 100 000th fringe, 31.64 mm, from the pass's first sample or from travel
/// zero 70 mm before it: both are found in the file.
#[test]
fn stairs_of_the_compensation_are_found_wherever_it_began_to_count() {
    for (rate, sign) in [("10 um/m", 1.0), ("-10 um/m", -1.0)] {
        let machine = machine(&format!("compensation = '{rate}'"));
        let slope = -0.846e-3; // document 1
        for start_mm in [70.0, 0.0] {
            let position_mm: Vec<f64> = (0..900).map(|row| 70.0 + 0.5 * f64::from(row)).collect();
            let lag_um = |place_mm: &f64| {
                let stairs = ((place_mm - start_mm) / 31.640_991_5).floor();
                sign * 0.316_409_915 * stairs + slope * place_mm
            };
            let error_um = position_mm.iter().map(lag_um).collect();
            let columns = [("position_mm", position_mm), ("error_um", error_um)];
            let whole = problem(&machine, &columns);
            let groups = whole.measurement.groups(4);
            let thinned = whole.averaged(groups.clone()).expect("no columns missing");
            assert_eq!(*thinned.predicted, means(&whole.predicted, &groups));
            let left = whole.residual();
            let low = left.iter().copied().fold(f64::INFINITY, f64::min);
            let high = left.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(high - low < 1e-3, "{rate} from {start_mm} mm: {low} to {high} µm");
        }
    }
}

/// A recorder of 0.2 Hz, clock by clock, and every ninth comparison of it: 0.7 s apart, a fourth of
/// the gear's wave.
#[test]
fn a_wave_through_the_recorder_is_known_from_samples_far_apart() {
    let gear = "workpiece.length = '90 mm'\nfilter.cutoff = '0.2 Hz'\n[[effect]]\n\
                kind = 'gear-error'\namplitude = '2 um'\norder = 3.4\n";
    let with_gear = machine_with("range = 1", gear);
    let trace =
        simulate(&with_gear, &Options::default(), &mut |_| {}).expect("a machine").open.trace;
    let every = |values: &[f64]| values.iter().copied().step_by(9).collect::<Vec<f64>>();
    let columns = [
        ("time_s", every(&trace.time_s)),
        ("position_mm", every(&trace.position_mm)),
        ("error_um", every(&trace.filtered_error_um)),
    ];
    let known = problem(&with_gear, &columns);
    let mut without = with_gear.clone();
    without.effects.clear();
    let left = problem(&without, &columns);
    let design = left.design(&with_gear.effects[0]).expect("a wave");
    let (known, left) = (known.residual(), left.residual());
    let first = known[0];
    for (row, now) in known.iter().enumerate() {
        // The zero of the meter, and nothing else.
        assert!((now - first).abs() < 0.01, "row {row}: {now} µm of the known gear, not {first}");
        let fitted = left[row] - 2.0 * design.columns[0][row];
        assert!((fitted - now).abs() < 1e-9, "row {row}: {fitted} µm of the column, not {now}");
    }
}

/// A display of half a micrometre, and one reading off it that is wild.
#[test]
fn a_wild_reading_off_the_lattice_hides_no_steps() {
    let machine = machine("");
    let time_s: Vec<f64> = (0..120).map(f64::from).collect();
    let wave = |time: &f64| 0.5 * (2.0 * libm::sin(7.0 * time)).round();
    let mut error_um: Vec<f64> = time_s.iter().map(wave).collect();
    error_um[60] = 38.0438;
    let problem = problem(&machine, &[("time_s", time_s), ("error_um", error_um)]);
    let step_um = (12.0 * problem.least_variance[0]).sqrt();
    assert!((step_um - 0.5).abs() < 1e-9, "{step_um}");
    assert_eq!(problem.far_rows(), [60]);
}
