//! What is told by whether passes agree, and by whether a part has turned once.

use std::f64::consts::TAU;

use helixlock_lab::{Diagnosis, Verdict};

use crate::support::diagnosed::{diagnosed, diagnosed_on, names};
use crate::support::passes::white;

/// A stepping motor of fifty poles with an encoder.
const MOTOR: &str = r#"
output.rotary = true
spindle.speed = "60 rpm"
gear = [{ name = "rotor poles", order = 50 }]
grating = { lines = 4096, diameter = "20 mm" }
"#;

/// A line of the grating on the workpiece.
const LINE_UM: f64 = 8000.0 / 13906.0;

/// A joint whose wheel turns once in a turn and a quarter.
const JOINT: &str = r#"
output.rotary = true
spindle.speed = "6 rpm"
gear = [{ name = "wheel", order = 0.8 }]
grating = { lines = 36000, diameter = "200 mm" }
"#;

/// Rows of so many passes, of time and place each, with white noise.
fn columns<const N: usize>(
    [passes, rows]: [u16; 2],
    noise: f64,
    row: impl Fn(u16, u16) -> [f64; N],
) -> [Vec<f64>; N] {
    let mut noise = white(7, noise);
    let mut columns = [const { Vec::new() }; N];
    for (pass, at) in (0..passes).flat_map(|pass| (0..rows).map(move |at| (pass, at))) {
        let mut values = row(pass, at);
        values[N - 1] += noise();
        columns.iter_mut().zip(values).for_each(|(column, value)| column.push(value));
    }
    columns
}

/// One pass of the motor over so many turns; noise of 10 arcsec.
fn motor(turns: f64, error_arcsec: impl Fn(f64) -> f64) -> Diagnosis {
    let [angle, error] = columns([1, 1200], 10.0, |_, row| {
        let at = turns * f64::from(row) / 1200.0;
        [at, error_arcsec(at)]
    });
    diagnosed_on(MOTOR, vec![("angle_rev", angle), ("error_arcsec", error)])
}

/// Four passes of 300 mm with a wave of the change gear, of a phase of its own each.
fn gear(phase: impl Fn(u16) -> f64) -> Diagnosis {
    let [pass, position, error] = columns([4, 500], 0.3, |pass, row| {
        let at_mm = 0.6 * f64::from(row);
        let wave = libm::sin(TAU * 2.5 * at_mm / 8.0 + phase(pass));
        [f64::from(pass), at_mm, wave]
    });
    diagnosed(vec![("pass", pass), ("position_mm", position), ("error_um", error)])
}

/// The detent of a motor turns twice as often as its poles, and nothing at the poles' own order.
#[test]
fn a_detent_is_named_without_its_poles() {
    let found = motor(2.0, |at| 40.0 * libm::sin(TAU * 100.0 * at));
    assert_eq!((names(&found), found.verdict), (vec!["gear-error"], Verdict::Explained));
}

/// A pawl that falls in eight times a turn makes waves of eight, sixteen and twenty-four: no circle is divided so.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn what_falls_in_several_times_a_turn_is_no_division() {
    let pawl = |at: f64| 60.0 * libm::exp(3.0 * (libm::cos(TAU * 8.0 * at) - 1.0));
    let found = motor(4.0, pawl);
    assert!(names(&found).is_empty(), "{:?}", names(&found));
    assert_eq!(found.verdict, Verdict::Unexplained);
    let comb = found.residual.iter().find(|one| one.shape.starts_with("comes again evenly"));
    assert_eq!(comb.and_then(|one| one.at), Some(8.0), "{:?}", found.residual.len());
}

/// On half a turn waves of 1.3 and 2.1 a turn are followed by whole ones that are not there.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn whole_waves_a_turn_need_a_whole_turn() {
    let wave = |at: f64| 300.0 * libm::sin(TAU * 1.3 * at) + 200.0 * libm::sin(TAU * 2.1 * at);
    let found = motor(0.5, wave);
    assert!(names(&found).is_empty(), "{:?}", names(&found));
    assert_eq!(found.verdict, Verdict::Unexplained);
}

/// Of a shaft that turns half a turn any curve is a piece of a wave.
#[test]
fn a_gear_needs_a_turn_of_its_own() {
    let named = |turns: f64| {
        let [angle, error] = columns([1, 600], 10.0, |_, row| {
            let at = turns * f64::from(row) / 600.0;
            [at, 200.0 * libm::sin(TAU * 0.8 * at)]
        });
        let found = diagnosed_on(JOINT, vec![("angle_rev", angle), ("error_arcsec", error)]);
        names(&found).contains(&"gear-error")
    };
    assert!(named(3.0) && !named(0.6));
}

/// A gear that was lifted out and put in again half a radian on between the second and third pass.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn an_effect_that_passes_disagree_on_is_told() {
    let agreed = gear(|_| 0.0);
    assert_eq!((names(&agreed), agreed.verdict), (vec!["gear-error"], Verdict::Explained));
    let moved = gear(|pass| if pass < 2 { 0.0 } else { 0.5 });
    assert_eq!(moved.verdict, Verdict::Unexplained);
    let told = moved.residual.iter().any(|one| one.along == "passes");
    assert!(told, "{:?}", moved.residual);
}

/// Three passes at three speeds, 200 rows each, with noise of 0.1 µm on what is there at every time; what is found.
fn over_three_speeds(error_um: impl Fn(f64) -> f64) -> Diagnosis {
    let [pass, time, position, error] = columns([3, 200], 0.1, |pass, row| {
        let at_mm = 1.5 * f64::from(row);
        let time_s = 120.0 * f64::from(pass) + at_mm / (4.0 - f64::from(pass) / 2.0);
        [f64::from(pass), time_s, at_mm, error_um(time_s)]
    });
    let (pass, time) = (("pass", pass), ("time_s", time));
    diagnosed(vec![pass, time, ("position_mm", position), ("error_um", error)])
}

/// A relay that was late between 120 and 240 s is no vibration, which has one phase throughout.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_vibration_keeps_time() {
    let late = |by_rad: f64| {
        over_three_speeds(|time_s| {
            let late_rad = if (120.0..240.0).contains(&time_s) { by_rad } else { 0.0 };
            0.5 * libm::sin(TAU * 0.31 * time_s - late_rad)
        })
    };
    assert_eq!(names(&late(0.0)), ["vibration"]);
    let unsteady = late(1.0);
    assert_eq!((names(&unsteady), unsteady.verdict), (vec![], Verdict::Unexplained));
}

/// A window that was opened, and whose step a slip of the grating would have had; but a slip does not come back.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_slip_stays() {
    let jumped = |within_s: f64| {
        over_three_speeds(|time_s| {
            let since_s = time_s - 150.0;
            if since_s < 0.0 { 0.0 } else { 2.0 * LINE_UM * libm::exp(-since_s / within_s) }
        })
    };
    let stayed = jumped(f64::INFINITY);
    assert_eq!((names(&stayed), stayed.verdict), (vec!["grating-slip"], Verdict::Explained));
    let gone = jumped(40.0);
    assert_eq!((names(&gone), gone.verdict), (vec![], Verdict::Unexplained));
}

/// A warming-up that is over after a tenth of the record shows in no row that may be held out.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_warming_up_at_the_start_is_named() {
    let [time, position, error] = columns([1, 1200], 1.0, |_, row| {
        let t = 8.0 * f64::from(row);
        [t, 0.5 * f64::from(row), 100.0 * (1.0 - libm::exp(-t / 300.0))]
    });
    let found = diagnosed(vec![("time_s", time), ("position_mm", position), ("error_um", error)]);
    assert!(names(&found).contains(&"headstock-growth"), "{:?}", names(&found));
}

/// An axis whose screw and slope the file has, so that it says which fringe the meter stands on.
const AXIS: &str = r#"
spindle.speed = "100 rpm"
lead_screw.lead = "10 mm"
laser.wavelength = "0.633 um"
[[effect]]
kind = "screw-progressive"
linear = "12 um/m"
quadratic = "20 um/m^2"
[[effect]]
kind = "screw-periodic"
amplitude = "0.4 um"
phase = "30 deg"
"#;

/// A pass out and one back, which begins elsewhere. The laser counts on: its ripple has one phase over what it
/// reads, and another one over what each pass has gone since its own beginning.
#[test]
fn a_ripple_of_the_fringes_goes_on_from_pass_to_pass() {
    let [pass, position, error] = columns([2, 300], 0.01, |pass, row| {
        let way_mm = 1.6 * f64::from(row);
        let at_mm = if pass == 0 { 10.0 + way_mm } else { 490.0 - way_mm };
        let (at_m, turns) = (at_mm / 1000.0, at_mm / 10.0);
        let moved_um =
            12.0 * at_m + 20.0 * at_m * at_m + 0.4 * libm::sin(TAU * turns + 30.0_f64.to_radians());
        let ripple_um = 0.015 * libm::sin(2.0 * TAU * -moved_um / 0.633 + 0.7);
        [f64::from(pass), at_mm, ripple_um - moved_um]
    });
    let columns = vec![("pass", pass), ("position_mm", position), ("error_um", error)];
    let found = diagnosed_on(AXIS, columns);
    assert_eq!((names(&found), found.verdict), (vec!["fringe-nonlinearity"], Verdict::Explained));
}

/// A table whose wheel turns twenty-two times and a half in one turn of it.
const TABLE: &str = r#"
output.rotary = true
spindle.speed = "2 rpm"
gear = [{ name = "worm", order = 90 }, { name = "intermediate", order = 22.5 }]
grating = { lines = 36000, diameter = "150 mm" }
"#;

/// A wheel whose wave swells twice in a turn has lines at 20.5 and 24.5. In a log of one turn the whole orders
/// about them draw them nearly as well, and the disc's divisions err at any of those.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_wheel_that_swells_with_the_table_is_no_division_of_its_disc() {
    let wheel = |swells: f64| {
        let [pass, angle, error] = columns([2, 350], 1.0, |pass, row| {
            let turn = f64::from(row) / 350.0;
            let size = 4.0 * (1.0 + swells * libm::sin(TAU * 2.0 * turn + 1.0));
            [f64::from(pass), turn, size * libm::sin(TAU * 22.5 * turn)]
        });
        diagnosed_on(TABLE, vec![("pass", pass), ("angle_rev", angle), ("error_arcsec", error)])
    };
    let even = wheel(0.0);
    assert_eq!((names(&even), even.verdict), (vec!["gear-error"], Verdict::Explained));
    let swelling = wheel(0.8);
    assert!(!names(&swelling).contains(&"grating-graduation"), "{:?}", names(&swelling));
    assert_eq!(swelling.verdict, Verdict::Unexplained);
}

/// Five passes with a ram drawn out from pass to pass, which bows as far as it stands out: no screw's lead does. A
/// bow of one size has its name beside a column that hardly changes.
#[test]
#[ignore = "long: `cargo xtask campaign` runs it"]
fn a_bow_as_large_as_a_column_is_no_screw() {
    let over = |height_mm: [f64; 5], bow_um: fn(f64) -> f64| {
        let [pass, position, height, error] = columns([5, 60], 1.0, |pass, row| {
            let (at, height_mm) = (f64::from(row) / 60.0, height_mm[usize::from(pass)]);
            let bow_um = bow_um(height_mm) * 4.0 * at * (1.0 - at);
            [f64::from(pass), 600.0 * at, height_mm, bow_um]
        });
        let (pass, position) = (("pass", pass), ("position_mm", position));
        let (height, error) = (("z_mm", height), ("error_um", error));
        diagnosed(vec![pass, position, height, error])
    };
    let drawn_out = over([0.0, 200.0, 50.0, 250.0, 100.0], |height_mm| 0.02 * height_mm);
    assert_eq!((names(&drawn_out), drawn_out.verdict), (vec![], Verdict::Unexplained));
    let still = over([200.0, 204.0, 198.0, 202.0, 203.0], |_| 4.0);
    assert_eq!(names(&still), ["screw-progressive"]);
}
