use std::path::Path;

use super::{Edge, Edges, Source};
use crate::Model;
use crate::motion::{Leg, Pass};

const MACHINE: &str = r#"
workpiece = { lead = "6 mm", length = "12 mm" }
spindle.speed = "15 rpm"
lead_screw.lead = "12 mm"
grating.lines = 13906
laser.wavelength = "0.63281983 um"
dividers = { a = 110, b = 150 }
drive = { step = "0.0125 um", frequency = "160 Hz" }
"#;

fn machine(effects: &str) -> Model {
    Model::parse(&format!("{MACHINE}{effects}"), Path::new("machine.toml")).expect("a machine")
}

const EFFECTS: &str = r#"
[[effect]]
kind = "screw-periodic"
amplitude = "1.5 um"
phase = "30 deg"
[[effect]]
kind = "screw-progressive"
linear = "35 um/m"
quadratic = "-50 um/m^2"
[[effect]]
kind = "gear-error"
order = 120
amplitude = "0.3 um"
[[effect]]
kind = "grating-eccentricity"
eccentricity = "10 um"
"#;

fn count(edges: &[Edge], source: Source) -> usize {
    edges.iter().filter(|edge| edge.source == source).count()
}

#[test]
fn every_edge_is_a_root_of_its_reading() {
    let machine = machine(EFFECTS);
    let mut edges = Edges::new(&machine, &Pass::forward(&machine)).expect("a pass");
    let (mut fringes, mut lines) = (0.5, 0.5);
    let zero = edges.motion().deltas(&edges.motion().at(0.0), 0.0);
    while let Some(edge) = edges.next() {
        let now = edges.motion().at(edge.time_s);
        let sums = edges.motion().deltas(&now, 0.0);
        let travel_um = 1000.0 * now.position_mm;
        let miss_um = match edge.source {
            Source::Fringe => {
                fringes += 1.0;
                travel_um + sums.motion_um - zero.motion_um - (fringes - 1.0) * 0.316_409_915
            }
            Source::Line => {
                lines += 1.0;
                travel_um + sums.angle_um - zero.angle_um - (lines - 1.0) * 6000.0 / 13_906.0
            }
        };
        // 1e-10 s at 1500 µm/s.
        assert!(miss_um.abs() < 1.5e-7, "{edge:?} is off by {miss_um} µm");
    }
    // 12 mm are 37 925 fringes and 27 812 lines, but for the error of half a µm.
    assert!((fringes - 37_925.5_f64).abs() < 3.0 && (lines - 27_812.5_f64).abs() < 3.0);
}

#[test]
fn a_step_moves_the_fringes_and_not_the_lines() {
    let machine = machine("");
    let mut edges = Edges::new(&machine, &Pass::forward(&machine)).expect("a pass");
    let (fringe_s, line_s) = (edges.next_fringe_s(), edges.next_line_s());
    edges.step(1e-6, true);
    let earlier_s = 0.0125 / 1500.0;
    assert!((fringe_s - edges.next_fringe_s() - earlier_s).abs() < 1e-12);
    assert!((line_s - edges.next_line_s()).abs() < 1e-15);
    // A step that carries the table past the fringe makes it come at once.
    let just_before_s = edges.next_fringe_s() - 1e-6;
    edges.step(just_before_s, true);
    assert!((edges.next_fringe_s() - just_before_s).abs() < 1e-12);
    assert!((edges.place(1.0).lead_error_um - 0.025).abs() < 1e-12);
}

#[test]
fn going_back_gives_the_same_pulses_again() {
    let machine = machine("");
    let leg = |forward| Leg { length_mm: 1.0, speed_rpm: 15.0, forward };
    let pass = Pass { number: 0, start_mm: 0.0, legs: vec![leg(true), leg(false)] };
    let edges: Vec<_> = Edges::new(&machine, &pass).expect("a pass").collect();
    let (out, back): (Vec<_>, Vec<_>) = edges.iter().partition(|edge| edge.time_s < 1.0 / 1.5);
    for source in [Source::Fringe, Source::Line] {
        assert_eq!(count(&out, source), count(&back, source));
    }
    assert_eq!(count(&out, Source::Fringe), 3160);
}

#[test]
fn pulses_owed_by_a_jump_come_one_by_one() {
    // A table that leaps 2 µm ahead at 0.1 s: a steep ramp of 1 ns.
    let machine = machine(
        r#"
        [[effect]]
        kind = "custom"
        entry = "motion"
        formula = "a*(1+sign(time_s-0.1))"
        parameters = { a = 1.0 }
        "#,
    );
    let edges: Vec<_> = Edges::new(&machine, &Pass::forward(&machine)).expect("a pass").collect();
    let owed = edges
        .iter()
        .filter(|edge| edge.source == Source::Fringe)
        .filter(|edge| (0.0..1e-5).contains(&(edge.time_s - 0.1)))
        .count();
    assert_eq!(owed, 6, "2 µm are six fringes and a third");
    assert!(edges.windows(2).all(|pair| pair[0].time_s <= pair[1].time_s));
    let fringes = count(&edges, Source::Fringe);
    assert_eq!(fringes, 37_932, "12 002 µm over λ/2, and a half");
}
