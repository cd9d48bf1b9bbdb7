//! Mistakes that are made when a machine file is typed or a log is put together.

use super::*;

/// A table of 14 mm a turn of its screw, as a file has it.
fn axis(lead: &str) -> Model {
    let text = format!(
        "lead_screw.lead = '{lead}'\nspindle.speed = '6 rpm'\n\
         [[effect]]\nkind = 'screw-periodic'\namplitude = '0.4 um'\nphase = '40 deg'\n"
    );
    Model::parse(&text, Path::new("machine.toml")).expect("a machine")
}

#[test]
fn a_lead_that_is_not_the_screws_is_told() {
    let shown = measured(&axis("14 mm"));
    assert_eq!(doubted(&axis("14 mm"), &shown), None);
    for typed in ["12 mm", "17.78 mm"] {
        let doubt = doubted(&axis(typed), &shown);
        assert_eq!(doubt, Some(("lead", "[lead_screw]\nlead = \"14 mm\"".to_owned())), "{typed}");
    }
    assert_eq!(doubted(&axis("28 mm"), &shown).expect("a doubt").0, "unit");
    // A wave of another size and phase may be anything.
    let other = changed(measured(&axis("14 mm")), "error_um", |value| 0.5 * value);
    assert_ne!(doubted(&axis("12 mm"), &other).map(|(what, _)| what), Some("lead"));
}

/// Twelve rows that a log was joined twice by.
#[test]
fn rows_that_are_there_twice_are_told() {
    let known = axis("14 mm");
    let joined = |twice: std::ops::Range<usize>| {
        let mut table = measured(&known);
        for column in &mut table.columns {
            let again = column.values[twice.clone()].to_vec();
            column.values.splice(twice.end..twice.end, again);
        }
        doubted(&known, &table)
    };
    let (what, mend) = joined(200..212).expect("a doubt");
    assert_eq!((what, mend.as_str()), ("copy", "leave the copies out"));
    assert_eq!(joined(200..204), None, "four rows may be so by accident");
}

/// Where the axis stands for forty rows so does a coarse display, on a clock of half of its pace.
#[test]
fn readings_of_an_axis_that_stands_are_no_copies() {
    let mut table = measured(&axis("14 mm"));
    for row in 0..table.rows() {
        let at = if (200..240).contains(&row) { 200 } else { row };
        table.columns[0].values[row] = 0.5 * crate::numerics::count(at);
        table.columns[1].values[row] = crate::numerics::count(row / 2);
        table.columns[2].values[row] = 20.0;
        let error = table.columns[3].values[at];
        table.columns[3].values[row] = 0.01 * libm::round(error / 0.01);
    }
    let found = doubted(&axis("14 mm"), &table);
    assert_ne!(found.map(|(what, _)| what), Some("copy"));
}

#[test]
fn a_clock_that_began_anew_within_a_pass_is_told() {
    let known = axis("14 mm");
    let of = |from: usize, fell_s: f64, listed: bool| {
        let mut table = measured(&known);
        for column in &mut table.columns {
            if column.name == "time_s" {
                column.values[from..].iter_mut().for_each(|time| *time -= fell_s);
            }
            if listed {
                column.values.rotate_left(from);
            }
        }
        doubted(&known, &table).map(|(what, _)| what)
    };
    assert_eq!(of(330, 270.0, false), Some("clock"));
    assert_eq!(of(570, 470.0, false), Some("clock"));
    assert_eq!(of(330, 1000.0, false), Some("clock"), "another clock, behind the first");
    assert_eq!(of(330, 0.0, true), None, "the later half may be listed first");
}

/// A drive whose angle nobody read, by a clock that counts from 1970.
#[test]
fn an_angle_that_follows_from_a_clock_counts_from_the_first_sample() {
    let model = Model::parse(
        "output.rotary = true\nspindle.speed = '0.07 rpm'\n[[gear]]\nname = 'worm'\norder = 180\n",
        Path::new("machine.toml"),
    );
    let model = model.expect("a machine");
    let of = |start_s: f64| {
        let column = |name: &str, values: Vec<f64>| Column { name: name.to_owned(), values };
        let time_s = (0..100_u32).map(|row| start_s + f64::from(row)).collect();
        let table =
            Table::new(vec![column("time_s", time_s), column("error_arcsec", vec![0.0; 100])]);
        problem(&model, &table).measurement.angle_rev.to_vec()
    };
    assert_eq!(of(1_772_352_000.0), of(0.0));
}
