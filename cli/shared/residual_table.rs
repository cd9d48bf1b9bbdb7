//! Residuals as a table: a row a sample, each pass about its own zero.

use helixlock_lab::Problem;
use helixlock_traces::{Column, Table};

/// `sensor` (its number in the result), `pass`, `time_s`, `position_mm` or `angle_rev`, then each
/// of `values` by its name, in the unit of the chain.
pub(crate) fn residual_table(problem: &Problem, values: &[(&str, &[f64])]) -> Table {
    let mut rows: Vec<(usize, usize, usize)> = Vec::new(); // sensor, pass, row
    for block in &problem.layout.blocks {
        rows.extend(block.rows.clone().map(|row| (block.sensor, block.pass, row)));
    }
    let record = &problem.record;
    let column = |name: &str, value: &dyn Fn(&(usize, usize, usize)) -> f64| {
        Column::new(name, rows.iter().map(value).collect())
    };
    let sample = |row: usize| problem.samples[row];
    let mut columns = vec![
        column("sensor", &|(sensor, _, _)| number(*sensor)),
        column("pass", &|(_, pass, _)| problem.measurement.pass_names[*pass]),
        column("time_s", &|(_, _, row)| record.time_s[sample(*row)]),
    ];
    columns.push(if problem.model.rotary {
        let turns: Vec<f64> = record.turns().collect();
        column("angle_rev", &|(_, _, row)| turns[sample(*row)])
    } else {
        column("position_mm", &|(_, _, row)| record.position_mm[sample(*row)])
    });
    for (name, values) in values {
        let about_zero = about_zero(problem, values);
        let name = format!("{name}_{}", problem.measurement.unit_word());
        columns.push(column(&name, &|(_, _, row)| about_zero[*row]));
    }
    Table::new(columns)
}

/// `sensor`, `order` of the spindle and amplitude, in the unit of the chain, of each sensor's
/// spectrum.
pub(crate) fn spectrum_table(problem: &Problem, spectra: &[&[[f64; 2]]]) -> Table {
    let numbered = || {
        (0..).zip(spectra).flat_map(|(sensor, lines)| lines.iter().map(move |line| (sensor, line)))
    };
    Table::new(vec![
        Column::new("sensor", numbered().map(|(sensor, _)| number(sensor)).collect()),
        Column::new("order", numbered().map(|(_, line)| line[0]).collect()),
        Column::new(
            format!("amplitude_{}", problem.measurement.unit_word()),
            numbered().map(|(_, line)| line[1]).collect(),
        ),
    ])
}

/// Values less the mean of their pass.
pub(crate) fn about_zero(problem: &Problem, values: &[f64]) -> Vec<f64> {
    let mut about_zero = values.to_vec();
    for block in &problem.layout.blocks {
        let part = &mut about_zero[block.rows.clone()];
        let mean = part.iter().sum::<f64>() / number(part.len().max(1));
        for value in part {
            *value -= mean;
        }
    }
    about_zero
}

#[expect(clippy::cast_precision_loss, reason = "a number of samples or sensors")]
fn number(count: usize) -> f64 {
    count as f64
}
