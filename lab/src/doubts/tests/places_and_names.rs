//! Places that are counted otherwise, on tables and on rotary axes, and columns with another's name.

use super::*;

/// A table with a worm of 90 and an eccentric grating.
fn rotary(speed: &str) -> Model {
    let text = format!(
        "output.rotary = true\nspindle.speed = '{speed}'\n\
         grating = {{ lines = 36000, diameter = '150 mm' }}\n\
         [[gear]]\nname = 'worm'\norder = 90\n\
         [[effect]]\nkind = 'gear-error'\norder = 90\namplitude = '6 arcsec'\nphase = '17 deg'\n\
         [[effect]]\nkind = 'grating-eccentricity'\neccentricity = '2 um'\nphase = '33 deg'\n"
    );
    Model::parse(&text, Path::new("machine.toml")).expect("a machine")
}

/// A turn at 1 rpm in 900 rows, what `known` shows of it with noise of 0.3″; the angle as it was read.
fn turn(known: &Model, read: impl Fn(f64) -> f64) -> Table {
    let column = |name: &str, values: Vec<f64>| Column { name: name.to_owned(), values };
    let turns: Vec<f64> = (0..900_u32).map(|row| f64::from(row) / 900.0).collect();
    let of = |error: Vec<f64>, angle: Vec<f64>| {
        let time_s = turns.iter().map(|turn| 60.5 * turn).collect();
        Table::new(vec![
            column("time_s", time_s),
            column("angle_rev", angle),
            column("error_arcsec", error),
        ])
    };
    let clean = problem(known, &of(vec![0.0; 900], turns.clone())).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    let shown = clean.iter().map(|value| value + 0.3 * noise()).collect();
    of(shown, turns.iter().map(|turn| read(*turn)).collect())
}

#[test]
fn degrees_and_another_zero_of_an_angle_are_told() {
    let known = rotary("1 rpm");
    assert_eq!(doubted(&known, &turn(&known, |turn| turn)), None);
    let (what, mend) = doubted(&known, &turn(&known, |turn| 360.0 * turn)).expect("a doubt");
    assert!(what == "unit" && mend.contains("angle_rev") && mend.ends_with("\"deg\""), "{mend}");
    let shifted = problem(&known, &turn(&known, |turn| turn + 0.253));
    let (doubts, suspects) = doubts_and_suspects(&shifted);
    let all = doubts.iter().chain(suspects.iter().map(|one| &one.doubt));
    let mend = "take 0.2530 turns off `angle_rev`";
    assert!(all.into_iter().any(|one| one.mend == mend), "{doubts:?} {}", suspects.len());
}

/// An axis whose angle follows from its clock: only the worm tells that the clock is in minutes.
#[test]
fn a_clock_that_is_all_that_tells_the_angle_is_told_by_a_wave() {
    let known = rotary("1 rpm");
    let mut table = turn(&known, |turn| turn);
    table.columns.remove(1);
    let table = changed(table, "time_s", |time_s| time_s / 60.5);
    let (what, mend) = doubted(&known, &table).expect("a doubt");
    assert!(what == "unit" && mend.contains("time_s") && mend.ends_with("\"min\""), "{mend}");
}

#[test]
fn a_position_that_counts_twice_is_told() {
    let known = machine(150, WAVES);
    for (factor, unit) in [(2.0, "0.5 mm"), (0.5, "2 mm")] {
        let table = changed(measured(&known), "position_mm", |place| factor * place);
        let (what, mend) = doubted(&known, &table).expect("a doubt");
        assert!(what == "unit" && mend.ends_with(&format!("unit = \"{unit}\"")), "{mend}");
    }
}

#[test]
fn fringes_that_nobody_made_a_length_of_are_told() {
    let known = machine(150, WAVES);
    let table = changed(measured(&known), "error_um", |value| value / 0.316_409_9);
    let (what, mend) = doubted(&known, &table).expect("a doubt");
    assert!(what == "unit" && mend.ends_with("unit = \"0.3164099 um\""), "{what} {mend}");
}

#[test]
fn the_threads_error_under_the_recorders_name_is_told() {
    let grown = machine(150, &format!("{WAVES}[[effect]]\nkind = 'workpiece-expansion'\n"));
    let warm = |mut table: Table| {
        let warm = (0..600).map(|row| 20.0 + 0.005 * crate::numerics::count(row));
        let values = warm.collect();
        table.columns.push(Column { name: "workpiece_temperature_c".to_owned(), values });
        table
    };
    let mut thread = warm(table(&[0.0; 600]));
    let error = |table: &mut Table, name: &str| name.clone_into(&mut table.columns[3].name);
    error(&mut thread, "lead_error_um");
    let clean = problem(&grown, &thread).predicted;
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    let mut row = 0;
    let mut thread = changed(thread, "lead_error_um", |_| {
        row += 1;
        let fresh: f64 = StandardNormal.sample(&mut chance);
        clean[row - 1] + 0.05 * fresh
    });
    assert_eq!(doubted(&grown, &thread), None);
    error(&mut thread, "error_um");
    let (what, mend) = doubted(&grown, &thread).expect("a doubt");
    assert!(what == "swap" && mend.contains("to = \"lead_error_um\""), "{what} {mend}");
    // Of the table alone, the thread shows what the recorder does with the other sign.
    let turned = changed(measured(&machine(150, WAVES)), "error_um", |value| -value);
    assert_eq!(doubted(&machine(150, WAVES), &turned).expect("a doubt").0, "sign");
}

#[test]
fn a_temperature_under_the_humiditys_name_is_told() {
    let known = machine(150, "[[effect]]\nkind = 'air-temperature'\n");
    let mut table = measured(&known);
    let humidity = (0..600).map(|row| 45.0 + 3.0 * libm::sin(0.07 * crate::numerics::count(row)));
    table.columns.push(Column { name: "humidity_pct".to_owned(), values: humidity.collect() });
    assert_eq!(doubted(&known, &table), None);
    table.columns[2].name = "humidity_pct".to_owned();
    table.columns[4].name = "air_temperature_c".to_owned();
    assert_eq!(doubted(&known, &table).expect("a doubt").0, "swap");
}

/// A factor of no unit on all effects alike is one number; two of their own are what the machine does.
#[test]
fn a_factor_of_no_unit_is_told_where_all_effects_have_it() {
    let known = rotary("1 rpm");
    let alike = changed(turn(&known, |turn| turn), "error_arcsec", |error| 0.71 * error);
    let (what, mend) = doubted(&known, &alike).expect("a doubt");
    assert!(what == "unit" && mend.contains("unit = \"1.40"), "{mend}");
    let mut other = known.clone();
    (other.effects[0].values[0], other.effects[1].values[0]) = (0.75 * 6.0, 1.3 * 2.0);
    assert_eq!(doubted(&known, &turn(&other, |turn| turn)), None);
}

#[test]
fn phases_of_another_convention_are_told_of_two_waves() {
    let (known, mut meant) = (rotary("1 rpm"), rotary("1 rpm"));
    for term in &mut meant.effects {
        let phase = term.parameters.iter().position(|what| what.role == Role::Phase);
        term.values[phase.expect("a wave")] += 90.0;
    }
    let table = turn(&meant, |turn| turn);
    let (what, mend) = doubted(&known, &table).expect("a doubt");
    assert!(what == "phase" && mend.contains("add 90°"), "{mend}");
    let (mut one, mut wave) = (known, meant);
    one.effects.truncate(1);
    wave.effects.truncate(1);
    assert_eq!(doubted(&one, &turn(&wave, |turn| turn)), None);
}

/// A tape that was stretched, a belt, a lead that is in no list.
#[test]
fn places_that_are_all_longer_are_told() {
    let known = machine(150, WAVES);
    for (factor, unit) in [(1.008, 0.992_063), (0.97, 1.030_928)] {
        let table = changed(measured(&known), "position_mm", |place| factor * place);
        let (what, mend) = doubted(&known, &table).expect("a doubt");
        assert_eq!(what, "scale", "{mend}");
        let written = mend.rsplit('"').nth(1).and_then(|unit| unit.strip_suffix(" mm"));
        let written: f64 = written.and_then(|unit| unit.parse().ok()).expect("a unit");
        assert!((written - unit).abs() < 2e-4, "{mend}");
    }
    // Of an axis whose angle follows from its clock it is the speed, and where no clock was read the angle.
    let known = rotary("1 rpm");
    let mut untimed = turn(&known, |turn| 1.01 * turn);
    untimed.columns.remove(0);
    let (what, mend) = doubted(&known, &untimed).expect("a doubt");
    assert!(what == "scale" && mend.contains("angle_rev") && mend.contains("\"0.990"), "{mend}");
    let mut table = turn(&known, |turn| turn);
    table.columns.remove(1);
    let table = changed(table, "time_s", |time_s| 60.0 / 60.5 * 0.99 * time_s);
    let (what, mend) = doubted(&known, &table).expect("a doubt");
    assert!(what == "scale" && mend.starts_with("[spindle]\nspeed = \"1.010"), "{mend}");
}

/// A row each millimetre, there and back where it is asked, of a screw without effects.
fn along(shown: impl Fn(f64, f64) -> f64, returns: bool) -> Option<(&'static str, String)> {
    let text = "lead_screw.lead = '14 mm'\nspindle.speed = '6 rpm'\n";
    let bare = Model::parse(text, Path::new("machine.toml")).expect("a machine");
    let there = (0..300_u32).map(f64::from);
    let places: Vec<f64> =
        if returns { there.clone().chain(there.rev()).collect() } else { there.collect() };
    let mut chance = ChaCha8Rng::seed_from_u64(7);
    let mut noise = || -> f64 { StandardNormal.sample(&mut chance) };
    let (mut error, mut time_s) = (Vec::new(), Vec::new());
    for (row, place) in places.iter().enumerate() {
        time_s.push(crate::numerics::count(row));
        error.push(shown(*place, time_s[row]) + 0.3 * noise());
    }
    let column = |name: &str, values: Vec<f64>| Column { name: name.to_owned(), values };
    let table =
        vec![column("time_s", time_s), column("position_mm", places), column("error_um", error)];
    doubted(&bare, &Table::new(table))
}

#[test]
fn an_error_that_runs_straight_along_the_travel_is_another_scale() {
    for returns in [true, false] {
        let (what, mend) =
            along(|place, _| 3.0 * place + libm::sin(place), returns).expect("a doubt");
        assert!(what == "scale" && mend.contains("0.9970"), "{mend}");
    }
    // Where the axis goes back, no drift is as steep; where it does not, one may be.
    let slope = |place: f64, _: f64| 0.6 * place;
    assert_eq!(along(slope, true).map(|(what, _)| what), Some("scale"));
    assert_eq!(along(slope, false), None);
    assert_eq!(along(|place, _| 0.4 * place, true), None);
    assert_eq!(along(|_, time_s| 0.6 * time_s, true), None);
    // An arc, a part of a wave and a kink are no straight line, though one explains nine tenths of them.
    assert_eq!(along(|place, _| 500.0 * libm::sin(place / 250.0), true), None);
    assert_eq!(along(|place, _| 0.01 * place * place, true), None);
    assert_eq!(along(|place, _| 3.0 * (place - 100.0).max(0.0), true), None);
}

/// Whatever its waves come by: ratios on either side of the file's, near and far.
#[test]
fn a_gear_and_a_screw_that_come_otherwise_are_told() {
    let known = machine(150, WAVES);
    let said = |mend: &str| mend.rsplit(' ').next().and_then(|number| number.parse::<f64>().ok());
    for order in [2.7, 2.45, 1.3] {
        let other = machine(150, &WAVES.replace("2.5", &order.to_string()));
        let (what, mend) = doubted(&known, &measured(&other)).expect("a doubt");
        let told = said(&mend).expect("an order");
        assert!(what == "gear" && (told - order).abs() < 1e-3, "{order}: {what} {mend}");
    }
    let mut other = machine(150, WAVES);
    other.machine.lead_screw = Some("17.3 mm".parse().expect("a lead"));
    let (what, mend) = doubted(&known, &measured(&other)).expect("a doubt");
    let told: f64 =
        mend[mend.find('"').expect("a lead") + 1..].trim_end_matches(" mm\"").parse().expect("mm");
    assert!(what == "lead" && (told - 17.3).abs() < 2e-3, "{what} {mend}");
}

/// One wave that was mended and another, half as large again, that nobody knows: the gear has its teeth.
#[test]
fn a_wave_of_another_size_is_no_other_gear() {
    let known = machine(150, WAVES);
    let other = WAVES.replace("2.5", "2.7").replace("1.1 um", "1.7 um");
    assert_eq!(doubted(&known, &measured(&machine(150, &other))), None);
    let more =
        format!("{WAVES}[[effect]]\nkind = 'gear-error'\norder = 2.7\namplitude = '1.1 um'\n");
    assert_eq!(doubted(&known, &measured(&machine(150, &more))), None);
}
