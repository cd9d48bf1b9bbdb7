//! Glitches and bouncing do not pass; what stands long enough does, and off everything does.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::properties::kept_beside_source;
use crate::support::bench::Bench;

proptest! {
    #![proptest_config(kept_beside_source())]

    /// Against a model that looks back: a new level is one that was seen for so many clocks.
    #[test]
    fn a_level_passes_once_it_has_stood(
        ticks in 1_u64..16,
        runs in vec((any::<bool>(), 1_usize..40), 1..20),
    ) {
        let mut bench = Bench::new("input_conditioner");
        bench.set(&[("tick", 1), ("ticks", ticks)]);
        let (mut seen, mut level) = (vec![false; 3], false);
        for (pin, clocks) in runs {
            for _ in 0..clocks {
                bench.set(&[("pin", pin.into())]);
                bench.clock();
                seen.push(pin);
                let before = &seen[..seen.len() - 2];
                let stands = before.iter().rev().take(usize::try_from(ticks).unwrap());
                let changed = stands.clone().count() == usize::try_from(ticks).unwrap()
                    && stands.into_iter().all(|past| *past != level);
                level ^= changed;
                prop_assert_eq!(bench.high("level"), level);
                prop_assert_eq!(bench.high("steady"), level);
            }
        }
    }

    #[test]
    fn off_the_pin_passes(pins in vec(any::<(bool, bool)>(), 1..60)) {
        let mut bench = Bench::new("input_conditioner");
        for (pin, low) in pins {
            bench.set(&[("pin", pin.into()), ("active_low", low.into())]);
            prop_assert_eq!(bench.high("level"), pin != low);
            bench.clock();
        }
    }
}

/// A press that bounces, and a release that does, are one edge each.
#[test]
fn a_bouncing_button_is_pressed_once() {
    let mut bench = Bench::new("input_conditioner");
    bench.set(&[("ticks", 10)]);
    let (mut edges, mut before) = (0, false);
    for clock in 0..4000_u32 {
        let bounces = (1000..1200).contains(&clock) || (2000..2200).contains(&clock);
        let pressed = if bounces { clock % 37 < 20 } else { (1200..2000).contains(&clock) };
        bench.set(&[("pin", pressed.into()), ("tick", (clock % 50 == 0).into())]);
        bench.clock();
        edges += u32::from(bench.high("level") != before);
        before = bench.high("level");
    }
    assert_eq!(edges, 2);
}
