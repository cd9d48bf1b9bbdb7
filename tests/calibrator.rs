//! The calibrator puts 180°, 90° and 135° on the outputs, and never 225°.

use crate::support::bench::Bench;

/// Share of the lines for which T1 is high, in degrees, from any eighth the clamp finds.
#[test]
fn phases_of_the_three_positions() {
    for (calibrate, expected_deg) in [(1, 180), (2, 90), (3, 135)] {
        for start in 0..8 {
            let mut bench = Bench::new("calibrator");
            bench.force(&[("eighth_q", start)]);
            bench.set(&[("calibrate", calibrate)]);
            let mut high = 0;
            for _ in 0..80 {
                bench.pulse(&["line"]);
                high += bench.get("t1");
                assert_eq!(bench.get("t2"), 1 - bench.get("t1"));
            }
            assert_eq!(360 * high / 80, expected_deg);
        }
    }
}

/// The clamp: whatever eighth was left behind, a calibration starts high.
#[test]
fn starts_clamped() {
    for start in 0..8 {
        let mut bench = Bench::new("calibrator");
        bench.force(&[("eighth_q", start)]);
        bench.clock();
        bench.set(&[("calibrate", 3)]);
        let levels: Vec<_> = (0..8)
            .map(|_| {
                let level = bench.get("t1");
                bench.pulse(&["line"]);
                level
            })
            .collect();
        assert_eq!(levels, [1, 1, 1, 0, 0, 0, 0, 0]);
    }
}

#[test]
fn off_shows_the_meter() {
    let mut bench = Bench::new("calibrator");
    for meter in [1, 0, 1] {
        bench.set(&[("meter", meter)]);
        bench.pulse(&["line"]);
        assert_eq!((bench.get("t1"), bench.get("t2")), (meter, 1 - meter));
    }
}
