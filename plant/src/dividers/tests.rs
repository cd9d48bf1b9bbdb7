use super::{
    METRIC_TRACK, MODULE_TRACK, Setting, Task, centre_phase, find_line_counts, phase_deg, solve,
};
use crate::{Lead, Range};

const WAVELENGTH_UM: f64 = 0.632_819_83;

fn setting(lead: &str, lines: u32) -> Option<Setting> {
    let lead = lead.parse().expect(lead);
    solve(&Task { lead, lines, wavelength_um: WAVELENGTH_UM, range_um: 47.5 })
}

/// The three worked examples of document 1.
#[test]
fn worked_examples() {
    for (lead, lines, a, b, residual_ppm) in [
        ("6 mm", METRIC_TRACK, 110, 150, -0.846),
        ("1/6 in", METRIC_TRACK, 132, 127, -0.846),
        ("0.5 pi mm", MODULE_TRACK, 352, 158, -0.56),
    ] {
        let found = setting(lead, lines).expect(lead);
        assert_eq!((found.a, found.b), (a, b), "{lead}");
        assert!((found.residual_ppm - residual_ppm).abs() < 0.005, "{lead}: {found:?}");
    }
}

/// Nothing that the wheels can show is nearer: every pair, by whole numbers.
#[test]
#[allow(clippy::cast_precision_loss, reason = "a rounding of 1e-16 against a bound of 1e-9")]
fn no_other_pair_leaves_less() {
    for lead in ["6 mm", "7.3 mm", "1/11 in", "12.345 mm"] {
        let found = setting(lead, METRIC_TRACK).expect(lead);
        let exact: Lead = lead.parse().expect(lead);
        let (n, d) = (i128::from(*exact.rational().numer()), i128::from(*exact.rational().denom()));
        // M·B·λ·d − 2·S·A·n with λ = 63 281 983e-11 mm, over 2·S·A·n.
        let off = |a: i128, b: i128| {
            let turn = 2 * n * a * 100_000_000_000;
            ((13_906 * b * 63_281_983 * d - turn).abs(), turn)
        };
        let (least, turn) = off(i128::from(found.a), i128::from(found.b));
        for a in 1..=999 {
            for b in 1..=999 {
                let (other, other_turn) = off(a, b);
                assert!(least * other_turn <= other * turn, "{lead}: {a}, {b} against {found:?}");
            }
        }
        let ppm = 1e6 * least as f64 / turn as f64;
        assert!((found.residual_ppm.abs() - ppm).abs() < 1e-9, "{lead}: {ppm}");
    }
}

#[test]
fn the_residual_can_be_compensated() {
    let found = setting("6 mm", METRIC_TRACK).expect("the example");
    let (rate, cycle) = found.compensation().expect("within reach");
    assert_eq!(cycle, 1_182_000);
    assert!((found.residual_ppm + rate).abs() < 0.001);
}

#[test]
fn leads_out_of_reach_are_refused() {
    assert_eq!(setting("0.001 mm", METRIC_TRACK), None);
    assert_eq!(setting("1000 mm", 100), None);
}

#[test]
fn the_phase_of_the_print_is_not_quite_half_a_turn() {
    // Document 1: m = 126 at B = 127 and ×2 is called 180°; it is 178.58°.
    assert!((phase_deg(126, 127, Range::X2) - 178.583).abs() < 0.001);
    let centre = centre_phase(127, Range::X2);
    assert!((phase_deg(centre, 127, Range::X2) - 180.0).abs() < 1e-12);
}

#[test]
fn the_tracks_of_document_1_are_found() {
    let parse = |leads: &[&str]| leads.iter().map(|lead| lead.parse().expect(lead)).collect();
    let metric: Vec<Lead> = parse(&["1 mm", "2 mm", "6 mm", "12 mm", "1/4 in", "1/6 in"]);
    let found = find_line_counts(&metric, WAVELENGTH_UM, 5_000..=20_000, 1.0);
    let outer = found.iter().find(|count| count.lines == METRIC_TRACK).expect("the outer track");
    assert_eq!(outer.ratio.to_string(), "5/22");
    let module: Vec<Lead> = parse(&["0.5 pi mm", "1 pi mm", "2 pi mm"]);
    let found = find_line_counts(&module, WAVELENGTH_UM, 5_000..=20_000, 1.0);
    let inner = found.iter().find(|count| count.lines == MODULE_TRACK).expect("the inner track");
    assert_eq!(inner.ratio.to_string(), "79/88");
}
